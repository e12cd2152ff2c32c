#include "lsp/analysis.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string_view>
#include <tuple>
#include <utility>

#include "input/text.h"
#include "input/xml/read.h"
#include "lsp/uri.h"
#include "repair/mend_document.h"
#include "repair/move_element.h"

namespace popup::lsp {
namespace {

std::vector<TextEdit> edits_of(const std::vector<xml::PatchEdit>& patch) {
    std::vector<TextEdit> edits;
    edits.reserve(patch.size());
    for (const xml::PatchEdit& edit : patch) edits.push_back({{edit.begin, edit.end}, edit.text});
    return edits;
}

// Fixes of findings on a document.
class Fixer {
 public:
    Fixer(const CompiledDesign& one, const Design& design, const Footings& standing)
        : one_(one), design_(design), standing_(standing) {
        if (one.checked) repairs_ = edits_of(xml::patch_edits(one.source, one.checked->design()));
    }

    void add_to(Finding& finding) {
        if (finding.diagnostic.change) add_repair(finding);
        const std::string_view code = finding.diagnostic.code;
        if ((code == "collision" || code == "lies-on-another") && one_.motion) add_move(finding);
    }

 private:
    // What the repair wrote into the element, and into those that stand on it and move with it.
    void add_repair(Finding& finding) {
        const std::string& id = finding.diagnostic.element;
        const auto& all = design_.structures;
        const auto found =
            std::find_if(all.begin(), all.end(), [&](const Structure& s) { return s.id == id; });
        if (found == all.end()) return;
        std::vector<bool> concerned(all.size(), false);
        std::vector<TextEdit> edits;
        const auto first = static_cast<std::size_t>(found - all.begin());
        for (std::size_t i = first; i < all.size(); ++i) {
            const int owner = standing_.ground[i].owner;
            concerned[i] = i == first || (owner >= 0 && concerned[static_cast<std::size_t>(owner)]);
            if (!concerned[i]) continue;
            const TextRange& tag = all[i].tag_text;
            for (const TextEdit& edit : repairs_) {
                if (edit.at.begin >= tag.offset && edit.at.end <= tag.offset + tag.length)
                    edits.push_back(edit);
            }
        }
        if (edits.empty()) return;
        finding.fixes.push_back(
            {fmt::format("Mend \"{}\": {}", id, finding.diagnostic.code), std::move(edits)});
    }

    void add_move(Finding& finding) {
        const Diagnostic& said = finding.diagnostic;
        for (const FreeingMove& move : one_.motion->moves) {
            if (move.place != said.place || said.related.empty() ||
                said.related.front().place != move.other_place)
                continue;
            Design moved = design_;
            if (!move_element(moved, standing_, move)) continue;
            std::vector<TextEdit> edits = edits_of(xml::patch_edits(one_.source, moved));
            if (edits.empty()) continue;
            finding.fixes.push_back({fmt::format("Move \"{}\" {:.2f} mm along its {}, clear of \"{}\"",
                                                 move.element, moved_mm(move), move.along, move.other),
                                     std::move(edits)});
        }
    }

    const CompiledDesign& one_;
    const Design& design_;
    std::vector<TextEdit> repairs_;
    const Footings& standing_;
};

}  // namespace

Span underlined(const Text& text, std::size_t at) {
    const std::string_view bytes = text.bytes();
    at = std::min(at, bytes.size());
    const auto ends = [&](std::size_t i) {
        return is_blank(bytes[i]) || std::string_view("<>\"'=/,();").find(bytes[i]) != std::string_view::npos;
    };
    std::size_t end = at;
    if (end < bytes.size() && bytes[end] == '<') ++end;
    if (end < bytes.size() && bytes[end] == '/') ++end;
    while (end < bytes.size() && !ends(end)) ++end;
    if (end == at && end < bytes.size() && bytes[end] != '\n' && bytes[end] != '\r') ++end;
    return {at, end};
}

namespace {

bool ends_a_program(const Finding& one) {
    constexpr std::array<std::string_view, 4> kEnding{"flatlang-syntax", "flatlang-too-deep",
                                                      "flatlang-runtime", "flatlang-limit"};
    return std::find(kEnding.begin(), kEnding.end(), one.diagnostic.code) != kEnding.end();
}

}  // namespace

Analysis analyse(const Source& source, const AnalysisOptions& options, Depth depth, const Stages& stages) {
    Analysis made;
    made.depth = depth;
    const bool goes_on = stages && depth == Depth::whole;
    made.text = goes_on ? stages->text : std::make_shared<const Text>(source.text);
    const Text& text = *made.text;
    CompileOptions compile_options = options.compile;
    compile_options.read.language = options.language->name;
    compile_options.until = depth == Depth::check ? Stage::check : Stage::pattern;
    compile_options.threads = 1;
    compile_options.progress = {};
    CompiledDesign one;
    if (goes_on) {
        one = stages->design;
        made.card = stages->card;
        find_further(one, compile_options);
    } else {
        one = std::move(compile({source}, compile_options, options.policy).designs.front());
    }
    std::optional<Fixer> fixer;
    const bool document = options.language->name == "xml";
    const ExaminationMemory* memory = compile_options.motion.memory;
    if (memory != nullptr && one.motion && one.motion->examination) made.examined = memory->share();
    if (document && one.design) {
        made.standing = goes_on ? stages->standing : footings_of(*one.design);
        fixer.emplace(one, *one.design, made.standing);
    }
    if (depth == Depth::check && document && one.checked)
        made.stages = std::make_shared<Checked>(Checked{one, made.standing, made.text, made.card});
    for (Diagnostic& diagnostic : one.diagnostics.sorted()) {
        Finding& finding = made.findings.emplace_back();
        finding.at = underlined(text, text.offset(diagnostic.place));
        for (const Related& related : diagnostic.related)
            finding.related.push_back({underlined(text, text.offset(related.place)), related.text});
        finding.diagnostic = std::move(diagnostic);
        if (fixer) fixer->add_to(finding);
    }
    made.may_load_more = std::any_of(made.findings.begin(), made.findings.end(), ends_a_program);
    std::set<std::string> known{real_path(source.name)};
    for (const std::vector<std::string>* list : {&one.further_files, &one.missing_files}) {
        for (const std::string& path : *list) {
            std::string real = real_path(path);
            if (known.insert(real).second) made.files.push_back({whole_path(path), std::move(real)});
        }
    }
    fixer.reset();
    made.design = std::move(one.design);
    return made;
}

std::optional<Fix> all_repairs(const Source& source, const AnalysisOptions& options) {
    if (options.language->patch == nullptr) return std::nullopt;
    CompileOptions compile_options = options.compile;
    compile_options.read.language = options.language->name;
    compile_options.until = Stage::check;
    compile_options.threads = 1;
    compile_options.progress = {};
    const Compilation run = compile({source}, compile_options, options.policy);
    const CompiledDesign& one = run.designs.front();
    if (run.has_errors() || !one.checked || one.diagnostics.repairs().empty()) return std::nullopt;
    const auto text = mended_document(one, *options.language, compile_options);
    if (!text || *text == source.text) return std::nullopt;
    return Fix{"Make all repairs", differences(source.text, *text)};
}

void mark_late(Analysis& whole, const Analysis& checked) {
    std::multiset<std::tuple<std::string_view, int, int>> early;
    for (const Finding& one : checked.findings)
        early.emplace(one.diagnostic.code, one.diagnostic.place.line, one.diagnostic.place.column);
    for (Finding& one : whole.findings) {
        const auto same =
            early.find({one.diagnostic.code, one.diagnostic.place.line, one.diagnostic.place.column});
        one.late = same == early.end();
        if (!one.late) early.erase(same);
    }
}

void carry_over(const Analysis& before, Analysis& now) {
    if (!now.design) return;
    std::map<std::string_view, Place> places;
    for (const Structure& structure : now.design->structures) places[structure.id] = structure.place;
    for (const Finding& old : before.findings) {
        const auto place = places.find(old.diagnostic.element);
        if (!old.late || place == places.end()) continue;
        Finding& kept = now.findings.emplace_back();
        kept.diagnostic = old.diagnostic;
        kept.diagnostic.place = place->second;
        kept.at = underlined(*now.text, now.text->offset(place->second));
        kept.late = true;
    }
}

}  // namespace popup::lsp
