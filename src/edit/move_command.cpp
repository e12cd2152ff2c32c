// Moves that hints tell, as the edits that make them.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "edit/session.h"
#include "edit/trial.h"
#include "mechanism/footings.h"
#include "popup/edit.h"

namespace popup {
namespace {

constexpr double kAsToldMm = 0.02;

// To the hundredth, never "-0.00".
std::string in_hundredths(double mm) { return fmt::format("{:.2f}mm", std::round(mm * 100.0) / 100.0 + 0.0); }

// The words that may make the move, the likeliest first.
std::vector<std::vector<std::string>> ways(const Design& design, std::size_t n, Vec2 by) {
    const std::string& id = design.structures[n].id;
    std::vector<std::vector<std::string>> made;
    const Footings footings = footings_of(design);
    const Ground& ground = footings.ground[n];
    if (ground.fold >= 0) {
        const StandingFold& fold = footings.folds[static_cast<std::size_t>(ground.fold)];
        const double mm = dot(by, along_left(fold, ground.reversed));
        made.push_back({"move", id, "--along=" + in_hundredths(mm), "--follow"});
    }
    made.push_back({"move", id, "--x=" + in_hundredths(by.x), "--y=" + in_hundredths(by.y), "--follow"});
    return made;
}

// The design with the element moved by the words; nullopt: they do not move it so. Where its points lie
// beside a named fold, they say themselves how far it goes along that.
std::optional<Design> moved_by_words(const CompiledDesign& one, const Tolerances& tolerances, std::size_t n,
                                     const std::vector<std::string>& words, Vec2 by) {
    Diagnostics unheard(one.source.name);
    edit::Session session(*one.design, one.source.name, tolerances, unheard);
    edit::Command command{words[0], {words[1]}, {}};
    for (std::size_t i = 2; i < words.size(); ++i) {
        const std::size_t equals = std::min(words[i].find('='), words[i].size());
        command.options.emplace_back(words[i].substr(2, equals - 2),
                                     words[i].substr(std::min(equals + 1, words[i].size())));
    }
    if (!edit::move(session, command)) return std::nullopt;
    const Structure& was = one.design->structures[n];
    const Structure& now = session.design.structures[n];
    if (was.points.empty()) return std::nullopt;
    const Vec2 moved = now.points.front().at - was.points.front().at;
    const bool so = was.named().given() ? std::abs(length(moved) - length(by)) <= kAsToldMm
                                        : distance(moved, by) <= kAsToldMm;
    if (!so) return std::nullopt;
    return std::move(session.design);
}

// An edit that makes a move.
struct MoveEdit {
    std::vector<std::string> words;
    Design design;  // as it is then
};
std::optional<MoveEdit> edit_that_moves(const CompiledDesign& design, const CompileOptions& options,
                                        const std::string& element, Vec2 by) {
    if (!edit::can_be_tried(design, options)) return std::nullopt;
    const std::vector<Structure>& all = design.design->structures;
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const Structure& s) { return s.id == element; });
    if (found == all.end()) return std::nullopt;
    const auto n = static_cast<std::size_t>(found - all.begin());
    for (std::vector<std::string>& words : ways(*design.design, n, by)) {
        if (auto moved = moved_by_words(design, options.check.tolerances, n, words, by))
            return MoveEdit{std::move(words), std::move(*moved)};
    }
    return std::nullopt;
}

// Whether the plates have the same names, and are as large.
bool are_alike(const Assembly& a, const Assembly& b) {
    return std::equal(a.plates.begin(), a.plates.end(), b.plates.begin(), b.plates.end(),
                      [](const Plate& p, const Plate& q) {
                          return p.name == q.name &&
                                 std::abs(perimeter(p.uncut) - perimeter(q.uncut)) <= kAsToldMm;
                      });
}

}  // namespace

std::optional<std::string> move_command(const CompiledDesign& design, const CompileOptions& options,
                                        const std::string& element, Vec2 by) {
    const auto edit = edit_that_moves(design, options, element, by);
    if (!edit) return std::nullopt;
    return fmt::format("popupc edit … {}", fmt::join(edit->words, " "));
}

bool move_holds(const CompiledDesign& design, const CompileOptions& options, const std::string& element,
                Vec2 by) {
    const auto edit = edit_that_moves(design, options, element, by);
    if (!edit || !design.assembly) return !edit::can_be_tried(design, options);
    Diagnostics found(design.source.name);
    const auto checked = check(edit->design, options.check, found);
    if (!checked || found.has_errors()) return false;
    const auto assembly = assemble(*checked, options.assemble, found);
    return assembly && are_alike(*design.assembly, *assembly);
}

}  // namespace popup
