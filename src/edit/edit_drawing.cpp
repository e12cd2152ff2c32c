// Edits of folded sheets that are drawings.
#include "popup/edit_drawing.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/text/numbers.h"
#include "base/text/shown.h"
#include "edit/denied_of_drawing.h"
#include "edit/first_edit.h"
#include "edit/sheet_drawing.h"
#include "input/text.h"
#include "input/xml/number.h"
#include "input/xml/units.h"
#include "popup/sheet_edit.h"

namespace popup {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kFurthestMoveMm = 1e5;
constexpr double kReadAgainMm = 0.005;  // numbers have six decimals, of pixels

constexpr std::array kSheetVerbs{
    EditVerb{"vertex", "PANEL.N | PANEL+PANEL+PANEL --by X,Y,Z | --to X,Y,Z",
             "move a vertex of the folded shape; what meets there goes along"},
    EditVerb{"edge", "PANEL.N-M | PANEL+PANEL --by X,Y,Z | --to X,Y,Z",
             "move an edge; --to is where its middle goes"},
    EditVerb{"extrude", "PANEL --by LENGTH", "move the face that a panel lies in outwards"},
};

class SheetEditReader {
 public:
    SheetEditReader(const EditLine& line, Diagnostics& diagnostics)
        : line_(line), diagnostics_(diagnostics) {}

    std::optional<SheetEdit> run() {
        if (line_.words.empty()) return fail("there is no edit", "edits are vertex, edge and extrude");
        const auto* row = std::find_if(kSheetVerbs.begin(), kSheetVerbs.end(),
                                       [&](const EditVerb& one) { return one.name == line_.words.front(); });
        if (row == kSheetVerbs.end()) {
            return fail(fmt::format("there is no edit '{}' of folded sheets", shown(line_.words.front())),
                        "edits are vertex, edge and extrude");
        }
        usage_ = fmt::format("write {} {}", row->name, row->usage);
        SheetEdit edit;
        edit.kind = static_cast<SheetEdit::Kind>(row - kSheetVerbs.begin());
        std::optional<std::string> amount;
        for (std::size_t i = 1; i < line_.words.size(); ++i) {
            const std::string& word = line_.words[i];
            if (!word.starts_with("--")) {
                if (!edit.name.empty())
                    return fail(
                        fmt::format("{} takes one name, and not '{}' as well", row->name, shown(word)),
                        usage_);
                edit.name = word;
                continue;
            }
            const std::size_t equals = std::min(word.find('='), word.size());
            const std::string name = word.substr(0, equals);
            const bool is_to = name == "--to" && edit.kind != SheetEdit::Kind::extrude;
            if (name != "--by" && !is_to)
                return fail(fmt::format("{} has no option {}", row->name, shown(name)), usage_);
            if (amount) return fail(fmt::format("{} says twice how far", row->name), usage_);
            edit.to = is_to;
            if (equals == word.size() && i + 1 == line_.words.size())
                return fail(fmt::format("{} has no value", name), usage_);
            amount = equals < word.size() ? word.substr(equals + 1) : line_.words[++i];
        }
        if (edit.name.empty()) return fail(fmt::format("{} names nothing", row->name), usage_);
        if (!amount) return fail(fmt::format("{} does not say how far", row->name), usage_);
        return read(*amount, edit) ? std::optional(edit) : std::nullopt;
    }

 private:
    std::nullopt_t fail(std::string what, std::string hint) {
        diagnostics_.error("bad-edit", line_.place, std::move(what)).hint(std::move(hint));
        return std::nullopt;
    }

    bool read(std::string_view text, SheetEdit& edit) {
        if (edit.kind == SheetEdit::Kind::extrude) {
            const auto out = length(text);
            if (out) edit.out_mm = *out;
            return out.has_value();
        }
        const std::size_t first = std::min(text.find(','), text.size());
        const std::size_t second = std::min(text.find(',', first + 1), text.size());
        if (second == text.size()) {
            fail(fmt::format("a place in space is three lengths, not '{}'", shown(std::string(text))),
                 usage_);
            return false;
        }
        const auto x = length(text.substr(0, first));
        const auto y = x ? length(text.substr(first + 1, second - first - 1)) : std::nullopt;
        const auto z = y ? length(text.substr(second + 1)) : std::nullopt;
        if (!z) return false;
        edit.by = {*x, *y, *z};
        return true;
    }

    std::optional<double> length(std::string_view text) {
        text = trimmed(text);
        const std::size_t end = std::min(text.find_last_of("0123456789.") + 1, text.size());
        const xml::ParsedNumber number = xml::parse_number(text.substr(0, end));
        const std::string_view unit = trimmed(text.substr(end));
        const Unit* in = unit.empty() ? nullptr : xml::find_unit(unit);
        const double mm = number.value * (in != nullptr ? in->mm : 1.0);
        if (number.fault == xml::NumberFault::none && (unit.empty() || in != nullptr) &&
            std::abs(mm) <= kFurthestMoveMm)
            return mm;
        return fail(fmt::format("'{}' is no length", shown(std::string(text))),
                    "write 5, or with a unit 5mm, 0.5cm or 0.2in; without one it is in millimetres");
    }

    const EditLine& line_;
    Diagnostics& diagnostics_;
    std::string usage_;
};

ReadOptions as_folded(ReadOptions read) {
    read.drawing.as = DrawnAs::folded;
    return read;
}

// What speaks against an edit is told where the edit stands; what is told of the drawing as that has it.
// Whether the policy makes an error of something that was none.
bool tell(const Diagnostics& heard, const EditLine& line, Diagnostics& of_edits, Diagnostics& of_document) {
    bool raised = false;
    for (const Diagnostic& one : heard.sorted()) {
        if (one.code == "line-meaning") continue;
        const bool of_edit = one.place.line == 0;
        Diagnostic& told =
            (of_edit ? of_edits : of_document).add(one.severity, one.code, one.place, one.message);
        const Severity severity = told.severity;
        const Place place = of_edit ? line.place : one.place;
        std::string file = std::move(told.file);
        told = one;
        told.file = std::move(file);
        told.place = place;
        told.severity = severity;
        raised = raised || severity != one.severity;
        if (!of_edit && one.code == "edit-refused" && line.place.line > 0)
            told.hint(fmt::format("the edit is line {} of {}", line.place.line, of_edits.file()));
    }
    return raised;
}

// The place of the edit that brings what a policy denies of the drawing that all of them make.
Place place_of_denied(const Source& source, std::span<const EditLine> edits,
                      const DrawingEditOptions& options, const DiagnosticPolicy& policy) {
    DrawingEditOptions forced = options;
    forced.force = true;
    return edit::place_of_first(edits, [&](std::size_t count) {
        DrawingEditOptions trial = forced;
        Diagnostics unheard(source.name);
        Diagnostics found(source.name, policy);
        const auto made = edit_drawing(source, edits.first(count), trial, unheard, unheard);
        return made && edit::brings_denied(source, made->text, *options.all, found);
    });
}

void refuse(Edited& made, Place place, Diagnostics& of_edits) {
    of_edits
        .error("edit-refused", place,
               "the drawing would have an error that it does not have now; nothing is written")
        .hint("--force writes it all the same");
    made.refused = true;
}

// Panels that joins name have the names that they have then, and corners are where their edges have gone.
void follow(std::vector<Join>& joins, const CreasePattern& pattern, const EditedSheet& edited, Vec2 shift) {
    for (Join& join : joins) {
        for (JoinPart& part : join.parts) {
            double nearest = HUGE_VAL;
            Vec2 to = part.corner;
            for (std::size_t i = 0; i < pattern.lines.size(); ++i) {
                for (std::size_t k = 0; k < pattern.lines[i].points.size(); ++k) {
                    const double far = distance(part.corner, pattern.lines[i].points[k]);
                    if (far >= nearest) continue;
                    nearest = far;
                    to = part.corner + (edited.lines[i].points[k] - pattern.lines[i].points[k]);
                }
            }
            part.corner = to + shift;
            const auto name =
                std::find_if(edited.names.begin(), edited.names.end(),
                             [&](const EditedSheet::Name& one) { return one.was == part.panel; });
            if (name != edited.names.end()) part.panel = name->is;
        }
    }
}

// By how much a drawing that was written lies elsewhere than it was to, because its page has grown; nullopt:
// not each point of its lines is where it was to be, to kReadAgainMm.
std::optional<Vec2> shift_of(const Reading& reading, const CreasePattern& pattern,
                             const EditedSheet& edited) {
    if (!reading.creases) return std::nullopt;
    std::vector<Vec2> is;
    for (const CreaseLine& line : reading.creases->lines)
        is.insert(is.end(), line.points.begin(), line.points.end());
    std::vector<Vec2> meant;
    std::vector<Vec2> maybe;
    for (std::size_t i = 0; i < pattern.lines.size(); ++i) {
        const EditedSheet::Line& line = edited.lines[i];
        // Folds whose angles differ may have parted their line, and are on it if not.
        const bool apart = !line.parted.empty() && line.fold_deg.empty();
        std::vector<Vec2>& parted = apart ? meant : maybe;
        for (const Segment& one : line.parted) parted.insert(parted.end(), {one.a, one.b});
        for (const auto& [stretch, at] : line.through) meant.push_back(at);
        if (!apart) meant.insert(meant.end(), line.points.begin(), line.points.end());
    }
    if (is.empty() || meant.empty()) return std::nullopt;
    const Vec2 shift = bounds(is).min - bounds(meant).min;
    for (Vec2& p : meant) p = p + shift;
    std::vector<Vec2> known = meant;
    for (const Vec2 p : maybe) known.push_back(p + shift);
    const auto before = [](Vec2 a, Vec2 b) { return std::pair(a.x, a.y) < std::pair(b.x, b.y); };
    std::sort(is.begin(), is.end(), before);
    std::sort(meant.begin(), meant.end(), before);
    std::sort(known.begin(), known.end(), before);
    const auto all_in = [](const std::vector<Vec2>& some, const std::vector<Vec2>& all) {
        return std::all_of(some.begin(), some.end(), [&](Vec2 p) {
            auto at = std::lower_bound(all.begin(), all.end(), p.x - kReadAgainMm,
                                       [](Vec2 q, double x) { return q.x < x; });
            for (; at != all.end() && at->x <= p.x + kReadAgainMm; ++at) {
                if (distance(*at, p) <= kReadAgainMm) return true;
            }
            return false;
        });
    };
    return all_in(meant, is) && all_in(is, known) ? std::optional(shift) : std::nullopt;
}

// Of the first line that an edit changes.
Place place_of_change(const CreasePattern& pattern, const EditedSheet& edited) {
    for (std::size_t i = 0; i < pattern.lines.size(); ++i) {
        if (edited.lines[i].moved || !edited.lines[i].fold_deg.empty()) return pattern.lines[i].place;
    }
    return {};
}

// Panels pass through each other that did not: told as an error.
bool crosses_anew(const EditedSheet& edited, const CreasePattern& pattern, const DrawingEditOptions& options,
                  const std::string& what, Diagnostics& heard) {
    const Crossings after = crossings_in(edited.after, true, options.fold, options.motion);
    if (after.empty()) return false;
    const Crossings before = crossings_in(edited.before, true, options.fold, options.motion);
    // Panels may have other names afterwards, and cross as they did.
    if (after.size() <= before.size()) return false;
    const auto fresh =
        std::find_if(after.begin(), after.end(), [&](const auto& pair) { return !before.contains(pair); });
    if (fresh == after.end()) return false;
    const auto& one = fresh->first;
    const auto& other = fresh->second;
    const auto named = std::find_if(edited.names.begin(), edited.names.end(),
                                    [&](const EditedSheet::Name& name) { return name.is == one; });
    heard
        .error("edit-refused", named != edited.names.end() ? named->place : place_of_change(pattern, edited),
               one.empty() ? fmt::format("after {} the sheet could not be folded all the way", what)
                           : fmt::format("after {} \"{}\" would pass through \"{}\", and nothing did there "
                                         "before",
                                         what, shown(one), shown(other)))
        .hint("move it less far; --force writes it all the same, and popupc check says how far they cross");
    return true;
}

std::string shown_place(Vec3 at) {
    const auto number = [](double value) {
        return fmt::format("{:.2f}", std::round(value * 100.0) / 100.0 + 0.0);
    };
    return fmt::format("({}, {}, {}) mm", number(at.x), number(at.y), number(at.z));
}

std::string as_text(const ShownSheet& sheet, const Ruler& ruler) {
    std::string text;
    for (const ShownSheet::Panel& panel : sheet.panels) {
        text += panel.name + "\n";
        for (std::size_t i = 0; i < panel.vertices.size(); ++i) {
            const ShownSheet::Vertex& vertex = panel.vertices[i];
            text += fmt::format("  {:<12} {} on the sheet, {} folded", vertex.name,
                                shown_point(ruler, vertex.flat), shown_place(vertex.at));
            if (!vertex.meets.empty()) text += fmt::format("; with {}", fmt::join(vertex.meets, ", "));
            text += "\n";
        }
        for (const ShownSheet::Edge& edge : panel.edges) {
            text += fmt::format("  {:<12} {:.2f} mm", edge.name, edge.length_mm);
            if (!edge.other.empty()) text += fmt::format(", {}+{}", panel.name, edge.other);
            text += "\n";
        }
    }
    return text;
}

Json as_json(const ShownSheet& sheet, const Ruler& ruler) {
    Json panels = Json::array();
    for (const ShownSheet::Panel& panel : sheet.panels) {
        Json vertices = Json::array();
        for (const ShownSheet::Vertex& one : panel.vertices) {
            const Vec2 flat = corner_as_shown(ruler, one.flat);
            vertices.push_back(
                {{"name", one.name},
                 {"flat", {rounded(flat.x, 4), rounded(flat.y, 4)}},
                 {"folded_mm", {rounded(one.at.x, 4), rounded(one.at.y, 4), rounded(one.at.z, 4)}},
                 {"meets", one.meets}});
        }
        Json edges = Json::array();
        for (const ShownSheet::Edge& one : panel.edges) {
            Json& edge =
                edges.emplace_back(Json{{"name", one.name}, {"length_mm", rounded(one.length_mm, 4)}});
            if (!one.other.empty()) edge["fold"] = panel.name + "+" + one.other;
        }
        panels.push_back(
            {{"name", panel.name},
             {"out", {rounded(panel.out.x, 4), rounded(panel.out.y, 4), rounded(panel.out.z, 4)}},
             {"vertices", std::move(vertices)},
             {"edges", std::move(edges)}});
    }
    return {{"unit", ruler.unit}, {"panels", std::move(panels)}};
}

}  // namespace

std::span<const EditVerb> sheet_edit_verbs() { return kSheetVerbs; }

Crossings crossings_in(const CreasePattern& sheet, bool whole_way, FoldOptions fold,
                       const MotionOptions& motion) {
    Diagnostics heard;
    fold.fold_angles.clear();  // the sheet says them all, and their share
    fold.to = 1.0;
    fold.board_mm.reset();
    auto assembly = fold_sheet(sheet, fold, heard);
    if (!assembly || !moves(*assembly)) return {};
    std::vector<Contact> contacts;
    if (whole_way) {
        const auto made = simulate_sheet(*assembly, motion, heard);
        if (!made) return {{"", "stops"}};
        if (made->examination) contacts = made->examination->contacts;
    } else {
        contacts = examine_folded(*assembly, motion).contacts;
    }
    Crossings found;
    const auto name = [&](int plate) { return assembly->plates[static_cast<std::size_t>(plate)].name; };
    for (const Contact& one : contacts) found.insert(std::minmax(name(one.a), name(one.b)));
    return found;
}

bool is_sheet_drawing(const Source& source, const ReadOptions& options) {
    const Language* language = find_language(source, options.language);
    if (language == nullptr) return false;
    return language->name == "fold" || language->name == "cp" ||
           (language->drawn && options.drawing.as.value_or(DrawnAs::folded) == DrawnAs::folded);
}

std::optional<Edited> edit_drawing(const Source& source, std::span<const EditLine> edits,
                                   DrawingEditOptions& options, Diagnostics& of_edits,
                                   Diagnostics& of_document) {
    const Language* language = find_language(source, options.read.language);
    if (language == nullptr || language->name != "svg") {
        of_document.error("edit-refused", {}, "only SVG drawings of folded sheets can be edited")
            .hint("popupc build writes other drawings as SVG");
        return std::nullopt;
    }
    const ReadOptions read = as_folded(options.read);
    const DrawingEditOptions before_edits = options;  // joins follow the edits
    Edited made;
    made.text = source.text;
    for (const EditLine& line : edits) {
        const auto edit = SheetEditReader(line, of_edits).run();
        if (!edit) return std::nullopt;
        Diagnostics heard(source.name);
        const Source now{source.name, made.text};
        const Reading reading = read_source_text(now, read, heard);
        std::optional<EditedSheet> edited;
        std::optional<Diagnostic> turned;  // told once it is known what the drawing says of it
        if (reading.creases) {
            Diagnostics again(source.name);  // mends are told by whatever folds the drawing
            edited = edit_sheet(*reading.creases, options.fold, options.joins, *edit, again);
            for (const Diagnostic& one : again.sorted()) {
                if (one.severity == Severity::error)
                    heard.add(one.severity, one.code, one.place, one.message) = one;
                if (one.code == "folds-turn") turned = one;
            }
        }
        std::optional<std::string> text;
        const std::string what = fmt::format("{}", fmt::join(line.words, " "));
        if (edited &&
            (options.force || !crosses_anew(*edited, *reading.creases, options, shown(what), heard)))
            text = edit::write_moved(now, *reading.creases, *edited, heard);
        if (text) {
            Diagnostics unheard(source.name);
            const Reading again = read_source_text({source.name, *text}, read, unheard);
            const auto shift = shift_of(again, *reading.creases, *edited);
            if (shift) {
                follow(options.joins, *reading.creases, *edited, *shift);
                options.ruler = again.creases->ruler;
            } else {
                heard
                    .error("edit-refused", place_of_change(*reading.creases, *edited),
                           fmt::format("after {} the drawing would be read otherwise than it is meant",
                                       shown(what)))
                    .hint(
                        "a drawing reaches no further than 100 m, and its lines are drawn where they stand");
                text.reset();
            }
        }
        if (turned) {
            // The writer has named what cannot say it.
            const std::vector<Diagnostic> named = heard.sorted();
            const bool all_say = text && turned->hints.empty() &&
                                 std::none_of(named.begin(), named.end(),
                                              [](const Diagnostic& one) { return one.code == "folds-turn"; });
            if (all_say) turned->hints.emplace_back("the drawing says so now, with data-fold-angle");
            heard.add(turned->severity, turned->code, turned->place, turned->message) = *turned;
        }
        const bool denied = tell(heard, line, of_edits, of_document);
        if (!text) return std::nullopt;
        made.text = std::move(*text);
        if (denied && !options.force) {
            refuse(made, line.place, of_edits);
            return made;
        }
    }
    const DiagnosticPolicy& policy = of_document.policy();
    if (options.all != nullptr && edit::denies(policy) &&
        edit::brings_denied(source, made.text, *options.all, of_document) && !options.force)
        refuse(made, place_of_denied(source, edits, before_edits, policy), of_edits);
    return made;
}

std::optional<std::string> show_drawing(const Source& source, const DrawingEditOptions& options, bool json,
                                        Diagnostics& diagnostics) {
    const Reading reading = read_source_text(source, as_folded(options.read), diagnostics);
    if (!reading.creases) return std::nullopt;
    const auto sheet = show_sheet(*reading.creases, options.fold, options.joins, diagnostics);
    if (!sheet) return std::nullopt;
    const Ruler& ruler = reading.creases->ruler;
    return json ? as_json(*sheet, ruler).dump(2) + "\n" : as_text(*sheet, ruler);
}

}  // namespace popup
