#include "repair/free_collisions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "mechanism/footings.h"
#include "repair/short_numbers.h"

namespace popup {
namespace {

using Pair = std::pair<std::string, std::string>;
using Pairs = std::set<Pair>;

// In one order, whichever of the two is told of.
Pair sorted(Pair pair) {
    if (pair.second < pair.first) std::swap(pair.first, pair.second);
    return pair;
}

// "front/left" is of "front".
std::string owner_of(const std::string& plate) { return plate.substr(0, plate.rfind('/')); }

// What a move may mend.
bool may_be_freed(const Diagnostic& finding) {
    return finding.code == "collision" || finding.code == "lies-on-another";
}

// The two elements that such a finding names: related are such as "\"front\"".
Pair pair_of(const Diagnostic& finding) {
    std::string other = finding.related.empty() ? finding.element : finding.related.front().text;
    if (other.size() > 2 && other.front() == '"') other = other.substr(1, other.size() - 2);
    return {finding.element, other};
}

// A document that was looked at.
struct Looked {
    CompiledDesign design;
    Pairs colliding;                    // of elements, also those that are allowed to
    Pairs lying;                        // on one another, of those that are told
    std::map<std::string, int> others;  // warnings of other kinds, by code
    bool accepted = false;              // without errors and repairs, and its motion was examined
};

class Freer {
 public:
    Freer(const Source& source, const Language& language, const CompileOptions& options,
          const DiagnosticPolicy& policy)
        : name_(source.name), language_(language), options_(options), policy_(policy) {
        options_.read.language = language.name;
        options_.until = Stage::check;
        options_.motion.examine = true;
        options_.threads = 1;
        options_.progress = {};
        options_.fitting_size = {};  // nobody reads the hints
        options_.move_command = {};
        // The motion knows nothing of tabs: a move that costs some is passed over, and another one looked
        // for.
        options_.move_holds = [this, holds = options.move_holds](const CompiledDesign& one,
                                                                 const CompileOptions& all,
                                                                 const std::string& element, Vec2 by) {
            return (!holds || holds(one, all, element, by)) && keeps_tabs(one, element, by);
        };
    }
    Freer(const Freer&) = delete;
    Freer& operator=(const Freer&) = delete;

    FreedDocument run(const std::string& text) {
        FreedDocument made{text, {}, {}};
        Looked now = look(text);
        while (now.accepted && step(now, made)) {
        }
        for (const Diagnostic& one : now.design.diagnostics.sorted()) {
            if (may_be_freed(one)) made.left.push_back(pair_of(one));
        }
        return made;
    }

 private:
    Looked look(std::string text) const {
        Compilation run = compile({Source{name_, std::move(text)}}, options_, policy_);
        // What tabs have to say, too, but no sheets.
        find_further(run.designs.front(), options_);
        Looked made{std::move(run.designs.front()), {}, {}, {}, false};
        const CompiledDesign& design = made.design;
        for (const Diagnostic& one : design.diagnostics.sorted()) {
            if (one.code == "lies-on-another") made.lying.insert(sorted(pair_of(one)));
            // An allowance that is no longer needed is no harm done.
            if (!may_be_freed(one) && one.severity != Severity::remark && one.code != "unused-allow")
                ++made.others[one.code];
        }
        if (!design.motion || !design.motion->examination) return made;
        for (const Contact& contact : design.motion->examination->contacts) {
            const auto name = [&](int plate) {
                return owner_of(design.assembly->plates[static_cast<std::size_t>(plate)].name);
            };
            made.colliding.insert(std::minmax(name(contact.a), name(contact.b)));
        }
        made.accepted = !design.diagnostics.has_errors() && design.diagnostics.repairs().empty();
        return made;
    }

    // Findings of tabs, by code.
    [[nodiscard]] std::map<std::string, int> told_of_tabs(const Assembly& assembly) const {
        Diagnostics found(name_, policy_);
        judge_tabs(assembly, options_.pattern, found);
        std::map<std::string, int> told;
        for (const Diagnostic& one : found.sorted()) ++told[one.code];
        return told;
    }

    // Whether no more is to be said of tabs once the element is moved.
    [[nodiscard]] bool keeps_tabs(const CompiledDesign& one, const std::string& element, Vec2 by) const {
        Design moved = *one.design;
        FreeingMove move;
        move.element = element;
        move.by = by;
        if (!move_element(moved, footings_of(*one.design), move)) return false;
        CompileOptions options = options_;
        options.until = Stage::assembly;
        options.move_holds = {};
        const Compilation run =
            compile({Source{name_, language_.patch(one.source, moved)}}, options, policy_);
        const std::optional<Assembly>& after = run.designs.front().assembly;
        return after && no_more(told_of_tabs(*one.assembly), told_of_tabs(*after));
    }

    // One move, if any helps.
    bool step(Looked& now, FreedDocument& made) const {
        std::vector<FreeingMove> moves = told(now.design);
        std::stable_sort(moves.begin(), moves.end(), [](const FreeingMove& a, const FreeingMove& b) {
            return length(a.by) < length(b.by);
        });
        const Footings standing = footings_of(*now.design.design);
        for (const FreeingMove& move : moves) {
            Design moved = *now.design.design;
            if (!move_element(moved, standing, move)) continue;
            std::string text = language_.patch(now.design.source, moved);
            Looked next = look(text);
            const Pair pair = sorted({move.element, move.other});
            if (!helps(now, next, pair)) continue;
            shorten(now, pair, moved, next, text);
            MadeMove record{move, {}, {}};
            points(*now.design.design, moved, move.element, record);
            made.moves.push_back(std::move(record));
            made.text = std::move(text);
            now = std::move(next);
            return true;
        }
        return false;
    }

    // Writes the move in fewer digits where it helps as much.
    void shorten(const Looked& before, const Pair& pair, Design& moved, Looked& after,
                 std::string& text) const {
        Design brief = moved;
        shorten_numbers(brief, before.design.source.text, {});
        std::string shorter = language_.patch(before.design.source, brief);
        if (shorter == text) return;
        Looked looked = look(shorter);
        if (!helps(before, looked, pair)) return;
        moved = std::move(brief);
        after = std::move(looked);
        text = std::move(shorter);
    }

    // Those whose finding is told: others are allowed.
    static std::vector<FreeingMove> told(const CompiledDesign& design) {
        std::vector<FreeingMove> moves;
        const std::vector<Diagnostic> findings = design.diagnostics.sorted();
        for (const FreeingMove& move : design.motion->moves) {
            const bool is_told = std::any_of(findings.begin(), findings.end(), [&](const Diagnostic& one) {
                return may_be_freed(one) && one.place == move.place && !one.related.empty() &&
                       one.related.front().place == move.other_place;
            });
            if (is_told) moves.push_back(move);
        }
        return moves;
    }

    static bool helps(const Looked& before, const Looked& after, const Pair& pair) {
        if (!after.accepted || after.colliding.contains(pair) || after.lying.contains(pair)) return false;
        const auto brings_none = [](const Pairs& had, const Pairs& has) {
            return std::includes(had.begin(), had.end(), has.begin(), has.end());
        };
        return brings_none(before.colliding, after.colliding) && brings_none(before.lying, after.lying) &&
               no_more(before.others, after.others);
    }

    // Whether nothing is found more often than before.
    static bool no_more(const std::map<std::string, int>& before, const std::map<std::string, int>& after) {
        return std::all_of(after.begin(), after.end(), [&](const auto& one) {
            const auto had = before.find(one.first);
            return had != before.end() && had->second >= one.second;
        });
    }

    // "A (-3, -4) B (-3, 0.2) in", before and after.
    static void points(const Design& before, const Design& after, const std::string& id, MadeMove& made) {
        const auto find = [&id](const Design& design) -> const Structure& {
            return *std::find_if(design.structures.begin(), design.structures.end(),
                                 [&](const Structure& one) { return one.id == id; });
        };
        const Structure& old = find(before);
        const Structure& now = find(after);
        const ElementInfo* info = find_element(old.type);
        const auto text = [&](Vec2 p) {
            const auto number = [&](double mm) { return std::round(mm / before.unit.mm * 1e4) / 1e4 + 0.0; };
            return fmt::format("({}, {})", number(p.x), number(p.y));
        };
        for (std::size_t i = 0; i < old.points.size(); ++i) {
            if (!now.points[i].changed) continue;
            const char* gap = made.before.empty() ? "" : " ";
            made.before += fmt::format("{}{} {}", gap, info->points[i].letter, text(old.points[i].at));
            made.after += fmt::format("{}{} {}", gap, info->points[i].letter, text(now.points[i].at));
        }
        // Findings speak of millimetres, and points are as they are written.
        if (made.before.empty() || before.unit.mm == 1.0) return;
        made.before += fmt::format(" {}", before.unit.name);
        made.after += fmt::format(" {}", before.unit.name);
    }

    std::string name_;
    const Language& language_;
    CompileOptions options_;
    const DiagnosticPolicy& policy_;
};

}  // namespace

FreedDocument free_collisions(const Source& source, const Language& language, const CompileOptions& options,
                              const DiagnosticPolicy& policy) {
    return Freer(source, language, options, policy).run(source.text);
}

Diagnostics with_moves(const Diagnostics& found, const Design& design, const FreedDocument& freed) {
    Diagnostics made(found.file(), found.policy());
    Pairs moved;
    for (const MadeMove& one : freed.moves) moved.insert(sorted({one.move.element, one.move.other}));
    Pairs lay;  // of these on one another
    for (const Diagnostic& finding : found.sorted()) {
        if (may_be_freed(finding) && moved.contains(sorted(pair_of(finding)))) {
            if (finding.code == "lies-on-another") lay.insert(sorted(pair_of(finding)));
            continue;
        }
        made.add(finding.severity, finding.code, finding.place, finding.message) = finding;
    }
    for (const MadeMove& made_move : freed.moves) {
        const FreeingMove& move = made_move.move;
        // Where it stands in the document as it was given: repairs may have moved it in its line.
        Place place = move.place;
        for (const Structure& structure : design.structures) {
            if (structure.id == move.element) place = structure.place;
        }
        made.warning("moved-clear", place,
                     fmt::format("\"{}\" {} \"{}\"; it was moved {:.2f} mm along its {}", move.element,
                                 lay.contains(sorted({move.element, move.other})) ? "lay on" : "went through",
                                 move.other, moved_mm(move), move.along))
            .about(move.element)
            .changed(made_move.before, made_move.after);
    }
    return made;
}

}  // namespace popup
