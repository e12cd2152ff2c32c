#include "check/crossed.h"

#include <fmt/format.h>

#include <algorithm>

#include "mechanism/element.h"
#include "mechanism/site_lines.h"

namespace popup {
namespace {

// How often the element's outline crosses what is left of the fold.
int times_crossed(const FoldsSoFar& folds, const FoldMatch& match, Placing& placing) {
    const Fold& fold = folds.fold_of(match);
    placing.look_along(match, fold);
    const Element seen = placing.authored_element();
    const std::vector<double> crossings = element_row(*seen.info).crossings(seen);
    return static_cast<int>(std::count_if(crossings.begin(), crossings.end(), [&](double s) {
        const double slack = folds.tolerances.rounding_mm;
        return s >= -slack && s <= fold.length() + slack &&
               fold.alive_around(std::clamp(s, 0.0, fold.length()));
    }));
}

std::string name_of(const FoldsSoFar& folds, const FoldMatch& match) {
    const Fold& fold = folds.fold_of(match);
    if (fold.owner == "page") return "the gutter";
    const ElementInfo* info = nullptr;
    for (const Structure& structure : folds.design.structures) {
        if (structure.id == fold.owner) info = find_element(structure.type);
    }
    const auto first = std::find_if(folds.skeleton.folds.begin(), folds.skeleton.folds.end(),
                                    [&](const Fold& one) { return one.owner == fold.owner; });
    const auto number = static_cast<std::size_t>(match.fold - (first - folds.skeleton.folds.begin()));
    if (match.ghost || info == nullptr || number >= info->folds.size())
        return fmt::format("a fold of \"{}\"", fold.owner);
    return fmt::format("the {} fold of \"{}\"", info->folds[number].name, fold.owner);
}

}  // namespace

std::optional<FoldMatch> find_crossed(const FoldsSoFar& folds, const Structure& structure, Placing& placing,
                                      Diagnostics& diagnostics) {
    std::vector<FoldMatch> twice;
    std::vector<std::pair<FoldMatch, int>> others;
    for (const FoldMatch& match : folds.index.crossed(structure.ground_page(), placing.drawn_box())) {
        const auto same = [&](const FoldMatch& one) {
            return one.fold == match.fold && one.ghost == match.ghost;
        };
        if (std::any_of(twice.begin(), twice.end(), same)) continue;
        const int times = times_crossed(folds, match, placing);
        if (times == 2) {
            if (match.ghost) return match;  // what is wrong there has been said
            twice.push_back(match);
        } else if (times > 0 && others.size() < 6) {
            others.emplace_back(match, times);
        }
    }
    if (twice.size() == 1) {
        placing.look_along(twice.front(), folds.fold_of(twice.front()));
        return twice.front();
    }
    if (twice.empty()) {
        const Box box = placing.drawn_box();
        const Vec2 middle = box.empty() ? Vec2{} : box.centre();
        std::string what;
        for (const auto& [match, times] : others)
            what += fmt::format("{}{} {}", what.empty() ? "it crosses " : ", ", name_of(folds, match),
                                times == 1 ? "once" : fmt::format("{} times", times));
        if (what.empty()) {
            what = "no fold is within 500 mm of it";
            if (const auto near = folds.index.nearest(structure.ground_page(), middle, middle, 500.0)) {
                FoldMatch match;
                match.fold = near->fold;
                match.ghost = near->ghost;
                what = fmt::format("the nearest to its middle is {}, {} away", name_of(folds, match),
                                   mm(near->distance));
            }
        }
        diagnostics
            .error("no-fold-crossed", structure.place,
                   fmt::format("the outline of \"{}\" crosses no fold on page {} exactly twice; {}",
                               structure.id, structure.ground_page(), what))
            .hint("draw it across the fold that it stands on, so that it lies on both sides of it")
            .about(structure.id);
        return std::nullopt;
    }
    std::string names;
    for (std::size_t i = 0; i < twice.size() && i < 6; ++i) {
        names += (i == 0 ? "" : i + 1 == twice.size() ? " and " : ", ") + name_of(folds, twice[i]);
    }
    if (twice.size() > 6) names += fmt::format(" and {} more", twice.size() - 6);
    diagnostics
        .error("folds-crossed", structure.place,
               fmt::format("the outline of \"{}\" crosses {} folds twice: {}", structure.id, twice.size(),
                           names))
        .hint("name the one that it stands on: parentfold, with its begin and end")
        .about(structure.id);
    return std::nullopt;
}

}  // namespace popup
