// Cards that are made and not read: a valid design out of the generators of the unit tests, changed in what
// it means, and taken through the whole pipeline.
//
// What is accepted keeps the promises of docs/guarantees.md: it closes at openings between those that were
// looked at, its pieces lie inside their sheets, its document and its assembly are read as they are written,
// what is written is read by those who read such files, and `fix` twice is `fix` once.
#include <fmt/format.h>
#include <tinyxml2.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "fuzz/targets/target.h"
#include "output/xml.h"
#include "popup/compile.h"
#include "popup/output.h"
#include "repair/mend_document.h"
#include "support/designs.h"

namespace popup::fuzz {
namespace {

// Valid designs of up to five elements, made once each: making one costs a hundred times its check.
const Design& base(std::size_t kind, std::uint64_t seed) {
    static std::map<std::pair<std::size_t, std::uint64_t>, Design> made;
    const auto [at, is_new] = made.try_emplace({kind, seed});
    if (is_new) {
        const std::span<const ElementInfo> rows = element_table();
        at->second = kind == 0   ? test::generate(seed, 2)
                     : kind == 1 ? test::generate_any(seed, 2)
                     : kind == 2 ? test::generate_of(rows[seed % rows.size()], seed, 1)
                                 : test::row(5);
    }
    return at->second;
}

// A step that is mostly small, sometimes none at all, and sometimes too far.
double step_mm(Choices& choices) {
    constexpr std::array<double, 8> kSizes{1e-9, 1e-6, 1e-3, 0.01, 0.3, 5.0, 60.0, 1e4};
    const double size = kSizes.at(choices.below(kSizes.size()));
    return choices.between(-size, size);
}

void nudge(DesignPoint& point, Choices& choices) {
    point.at = point.at + Vec2{step_mm(choices), step_mm(choices)};
}

void change_argument(Structure& structure, Choices& choices) {
    if (structure.arguments.empty()) return;
    Argument& one = structure.arguments[choices.below(structure.arguments.size())];
    if (auto* number = std::get_if<double>(&one.value)) {
        *number += step_mm(choices);
    } else if (auto* points = std::get_if<std::vector<DesignPoint>>(&one.value)) {
        if (!points->empty()) nudge((*points)[choices.below(points->size())], choices);
    } else if (choices.byte() % 2 == 0) {
        one.value = std::monostate{};
    }
}

// One change of what the design means; of points, most often.
void change(Design& design, Choices& choices) {
    std::vector<Structure>& all = design.structures;
    const unsigned what = choices.byte() % 16;
    if (all.empty() || what == 0) {
        design.width_mm = std::max(1.0, design.width_mm + step_mm(choices));
        design.height_mm = std::max(1.0, design.height_mm + step_mm(choices));
        return;
    }
    Structure& one = all[choices.below(all.size())];
    switch (what) {
        case 1:
            if (all.size() < 8) {
                Structure copy = one;
                copy.id = fmt::format("copy{}", all.size());
                all.push_back(std::move(copy));
            }
            break;
        case 2:
            all.erase(all.begin() + (&one - all.data()));
            break;
        case 3:
            std::swap(one.points, all[choices.below(all.size())].points);
            break;
        case 4:
            std::swap(one.type, all[choices.below(all.size())].type);
            break;
        case 5:
            one.type = element_table()[choices.below(element_table().size())].name;
            break;
        case 6:
            std::swap(one.fold, all[choices.below(all.size())].fold);
            break;
        case 7:
            nudge(choices.byte() % 2 == 0 ? one.fold.begin : one.fold.end, choices);
            break;
        case 8:
            one.fold.page = static_cast<int>(choices.below(8)) - 1;
            break;
        case 9:
            design.opens_deg = choices.between(1.0, 180.0);
            break;
        case 10:
            change_argument(one, choices);
            break;
        case 11:
            if (!one.points.empty()) {
                // On another point, or on the line through two others.
                DesignPoint& point = one.points[choices.below(one.points.size())];
                const Vec2 a = one.points[choices.below(one.points.size())].at;
                const Vec2 b = one.points[choices.below(one.points.size())].at;
                point.at = lerp(a, b, static_cast<double>(choices.below(3)) * 0.5);
            }
            break;
        case 12:
            if (one.points.size() > 1)
                std::swap(one.points[choices.below(one.points.size())],
                          one.points[choices.below(one.points.size())]);
            break;
        default:
            if (!one.points.empty()) nudge(one.points[choices.below(one.points.size())], choices);
    }
}

bool writable(const Design& design) {
    return std::all_of(design.structures.begin(), design.structures.end(), [](const Structure& one) {
        const ElementInfo* row = find_element(one.type);
        return row != nullptr && row->points.size() == one.points.size() &&
               one.arguments.size() <= row->parameters.size();
    });
}

// Which of the promises an input is held against: all at once are four times as slow.
enum class Look { moved, written, laid_out, mended };

void expect_inside_sheets(const Layout& layout) {
    for (const Placement& placement : layout.placements) {
        const auto& pieces = layout.designs[static_cast<std::size_t>(placement.design)].pattern.pieces;
        const PatternPiece& piece = pieces[static_cast<std::size_t>(placement.piece)];
        const LayoutSheet& sheet = layout.sheets[static_cast<std::size_t>(placement.sheet)];
        const double least = layout.margin_mm - 2e-6;
        for (const Polygon& paper : piece.silhouette) {
            for (const Vec2 corner : paper.outer) {
                const Vec2 at = placement.apply(corner);
                expect(at.x >= least && at.y >= least && at.x <= sheet.width_mm - least &&
                           at.y <= sheet.height_mm - least,
                       [&] {
                           return fmt::format("piece {} is inside its sheet: ({}, {})", piece.name, at.x,
                                              at.y);
                       });
            }
        }
    }
}

// Files of this kind are read by who reads such files.
void expect_read(std::string_view suffix, const std::string& bytes) {
    expect(!bytes.empty(), [&] { return fmt::format("{} is not empty", suffix); });
    if (suffix == ".svg") {
        tinyxml2::XMLDocument document;
        expect(document.Parse(bytes.data(), bytes.size()) == tinyxml2::XML_SUCCESS, "a .svg is XML");
    }
    if (suffix == ".json" || suffix == ".gltf" || suffix == ".fold")
        expect(nlohmann::json::accept(bytes), [&] { return fmt::format("a {} is JSON", suffix); });
    if (suffix == ".pdf") expect(bytes.starts_with("%PDF-"), "a .pdf is a PDF");
    if (suffix == ".dxf" || suffix == ".fold" || suffix == ".svg" || suffix == ".xml") {
        const std::string name = "again" + std::string(suffix);
        Diagnostics told(name);
        read_source_text({name, bytes}, {}, told);
        std::string what;
        for (const Diagnostic& one : told.sorted()) {
            // A card without cuts has no parts in it.
            if (one.severity == Severity::error && one.code != "no-parts")
                what = one.code + ": " + one.message;
        }
        expect(what.empty(), [&] { return fmt::format("a {} is read again: {}", suffix, what); });
    }
}

void write(const Compilation& run, const Format& format) {
    const CompiledDesign& one = run.designs.front();
    OutputOptions options;
    options.dpi = 10;  // at 300, pictures take forty times as long as all else
    Diagnostics told("out");
    const SceneCard card{
        .assembly = &*one.assembly,
        .motion = one.motion ? &*one.motion : nullptr,
        .prefix = {},
        .creases = nullptr,
        .pattern = &*one.pattern,
    };
    if (const auto* sheets = std::get_if<SheetWriter>(&format.write)) {
        if (const auto files = (*sheets)(*run.layout, options, told)) {
            for (const SheetFile& file : *files) expect_read(format.suffix, file.bytes);
        }
    } else if (const auto* scene = std::get_if<SceneWriter>(&format.write)) {
        if (const auto bytes = (*scene)(std::span(&card, 1), options, told))
            expect_read(format.suffix, *bytes);
    } else if (const auto* document = std::get_if<DocumentWriter>(&format.write)) {
        if (const auto bytes = (*document)(*one.checked, options, told)) expect_read(format.suffix, *bytes);
    } else if (const auto* report = std::get_if<ReportWriter>(&format.write)) {
        if (const auto bytes = (*report)(run, options, told)) expect_read(format.suffix, *bytes);
    } else {
        return;  // pictures and pages: they take a hundred times as long as all else
    }
}

void expect_mended(const CompiledDesign& one, const CompileOptions& how) {
    const Language& xml = *find_language({}, "xml");
    const std::optional<std::string> once = mended_document(one, xml, how);
    if (!once) return;  // `fix-unsettled`
    CompileOptions check = how;
    check.until = Stage::motion;
    check.motion.examine = false;
    const Compilation again = compile({Source{"card.xml", *once}}, check, {});
    const CompiledDesign& mended = again.designs.front();
    expect(!mended.diagnostics.has_errors(), "what fix writes has no errors");
    expect(mended.diagnostics.repairs().empty(), "what fix writes has nothing to repair");
    expect(mended_document(mended, xml, how) == once, "fix twice is fix once");
}

}  // namespace

void look_at_card(std::string_view bytes) {
    Choices choices(bytes);
    const std::size_t kind = choices.below(4);
    Design design = base(kind, choices.below(24));
    const Format& format = format_table()[choices.below(format_table().size())];
    const auto look = static_cast<Look>(choices.below(4));
    const bool examined = choices.below(8) == 7;
    for (int i = 0; i < 12 && choices.left(); ++i) {
        const Design before = design;
        change(design, choices);
        if (!writable(design)) design = before;
    }
    const std::string text = write_document(design);
    CompileOptions how;
    how.layout.nesting.work = 1e4;
    how.layout.nesting.shortening = 1e4;
    how.motion.examine = examined;
    if (look == Look::written || look == Look::mended) how.until = Stage::check;
    const Compilation run = compile({Source{"card.xml", text}}, how, {});
    const CompiledDesign& one = run.designs.front();
    try {
        expect_told(one.diagnostics, text);
        if (look == Look::moved) look_at_design("card.xml", text);
        if (run.has_errors()) return;
        if (look == Look::written) {
            const std::string written = write_document(one.checked->design());
            Diagnostics told("card.xml");
            const auto again = read_design({"card.xml", written}, {}, told);
            expect(again && write_document(*again) == written, "a written document is written the same");
        }
        if (look == Look::laid_out && run.layout) {
            expect_inside_sheets(*run.layout);
            write(run, format);
        }
        if (look == Look::mended) expect_mended(one, how);
    } catch (const Broken& broken) {
        throw Broken(std::string(broken.what()) + "\n" + text);
    }
}

}  // namespace popup::fuzz
