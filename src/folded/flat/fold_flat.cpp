// What is found of a pattern that is to fold flat, at each corner and of the whole.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "base/nth.h"
#include "folded/flat/flat_corners.h"
#include "folded/flat/flat_state.h"
#include "folded/sheet.h"
#include "folded/straighten.h"
#include "folded/work.h"
#include "popup/flat_folding.h"

namespace popup {
namespace {

using folded::Fold;
using folded::Loop;
using folded::Sheet;

constexpr std::size_t kToldAtMost = 10;
constexpr double kOnePlaceMm = 0.002;  // in the flat state one place
constexpr double kNearShare = 2e-5;    // of the sheet's longer side
constexpr double kOffShare = 5e-4;     // so far may panels miss each other: what a drawing rounds
constexpr double kStraightenMm = 0.2;
constexpr double kStraightenShare = 1e-3;
constexpr std::size_t kMostConditions = 4'000'000;
constexpr std::size_t kMostWork = 60'000'000;
constexpr std::size_t kPanelsTold = 6;

class FlatCheck {
 public:
    FlatCheck(const CreasePattern& pattern, Sheet sheet, Diagnostics& diagnostics)
        : pattern_(pattern), sheet_(std::move(sheet)), diagnostics_(diagnostics) {}

    std::optional<FlatFolding> run() {
        const double size = sheet_.size();
        for (const Loop& loop : sheet_.loops) {
            if (loop.corner) look_at(loop);
        }
        if (wrong_ > 0) return std::nullopt;
        const double straighten_mm = std::max(kStraightenMm, kStraightenShare * size);
        const folded::Refined refined = folded::straighten(sheet_, straighten_mm, work_);
        const folded::Tree tree = folded::make_tree(pattern_, sheet_);
        const folded::FlatState state = folded::lay_flat(sheet_, tree);
        const double near = std::max({kOnePlaceMm, kNearShare * size, 2.0 * state.off_mm});
        if (state.off_mm > std::max(kOnePlaceMm, kOffShare * size)) {
            const Fold& fold = nth(sheet_.folds, state.off_fold);
            diagnostics_
                .warning("flat-loop", nth(pattern_.lines, fold.line).place,
                         fmt::format("folded flat, the two panels of this fold miss each other by {:.2f} mm "
                                     "at {}",
                                     state.off_mm, shown(sheet_.line_of(fold).a)))
                .hint(
                    "the folds around a hole, one after another, must lead back to where they began: look at "
                    "those around the hole beside it");
            return std::nullopt;
        }
        FlatFolding result;
        result.panels = sheet_.panels.size();
        const auto layers = folded::order_conditions(sheet_, state, near, kMostConditions, result.layers);
        if (!layers) return undecided();
        result.overlaps = layers->pairs();
        const folded::Layers::Solution solution = layers->solve(kMostWork);
        switch (solution.kind) {
            case folded::Layers::Solution::found:
                diagnostics_.remark(
                    "folds-flat", {},
                    fmt::format("the sheet folds flat: {} panels in up to {} layers, with an "
                                "order for {} that lie on each other",
                                result.panels, result.layers,
                                result.overlaps == 1 ? std::string("the two")
                                                     : fmt::format("all {} pairs", result.overlaps)));
                if (refined.closes) folded::tell(refined, pattern_, sheet_, diagnostics_);
                result.assembly = folded::stacked(pattern_, sheet_, tree, state, *layers, solution);
                return result;
            case folded::Layers::Solution::none:
                tell_panels(solution.panels);
                return std::nullopt;
            case folded::Layers::Solution::undecided:
                break;
        }
        return undecided();
    }

 private:
    [[nodiscard]] std::string shown(Vec2 at) const { return shown_point(pattern_.ruler, at); }

    std::optional<FlatFolding> undecided() {
        diagnostics_
            .warning("flat-undecided", {},
                     "so many panels lie on one another that no order of them was found, and none ruled out")
            .hint("look at a part of the pattern");
        return std::nullopt;
    }

    Diagnostic* tell(std::string_view code, const Loop& loop, std::string text) {
        if (++wrong_ > kToldAtMost) return nullptr;
        return &diagnostics_.warning(code, nth(pattern_.lines, loop.line).place, std::move(text));
    }

    void look_at(const Loop& loop) {
        const folded::FlatCorner corner = folded::flat_corner(sheet_, loop);
        if (!corner.even()) {
            if (Diagnostic* told = tell("flat-odd", loop,
                                        fmt::format("{} folds meet at {}; where all is folded flat, their "
                                                    "number is even",
                                                    corner.folds, shown(loop.at))))
                told->hint("add a fold there, or take one out");
            return;
        }
        look_at_angles(loop, corner);
        look_at_kinds(loop, corner);
    }

    void look_at_angles(const Loop& loop, const folded::FlatCorner& corner) {
        if (corner.angles_fit()) return;
        const double every_other = corner.every_other_deg;
        if (Diagnostic* told =
                tell("flat-angles", loop,
                     fmt::format("the angles between the {} folds that meet at {}, taken in turn, add up to "
                                 "{:.2f}° and {:.2f}°, and not to 180° each",
                                 corner.folds, shown(loop.at), std::min(every_other, 360.0 - every_other),
                                 std::max(every_other, 360.0 - every_other))))
            told->hint(
                fmt::format("turn one of the folds by {:.2f}° about that corner, so that an angle "
                            "of the smaller sum grows",
                            std::abs(every_other - 180.0)));
    }

    void look_at_kinds(const Loop& loop, const folded::FlatCorner& corner) {
        if (corner.kinds_fit()) return;
        const int apart = std::abs(corner.mountains - corner.valleys);
        if (Diagnostic* told = tell("flat-kinds", loop,
                                    fmt::format("{} mountains and {} valleys meet at {}; folded flat, they "
                                                "differ in number by two",
                                                corner.mountains, corner.valleys, shown(loop.at)))) {
            const bool too_alike = apart < 2;
            const int change = too_alike ? 1 : (apart - corner.open - 2) / 2;
            told->hint(fmt::format("make {} of the {} {}", change,
                                   too_alike || corner.mountains > corner.valleys ? "mountains" : "valleys",
                                   change == 1 ? "the other kind" : "of the other kind"));
        }
    }

    [[nodiscard]] Vec2 middle_of(int panel) const {
        Box box;
        for (const int corner : nth(sheet_.panels, panel).outer) box.extend(sheet_.at(corner));
        return 0.5 * (box.min + box.max);
    }

    void tell_panels(const std::vector<int>& panels) {
        std::string names;
        for (std::size_t i = 0; i < panels.size() && i < kPanelsTold; ++i)
            names += (i == 0 ? "" : ", ") + shown(middle_of(panels[i]));
        if (panels.size() > kPanelsTold) names += ", …";
        Place place;
        for (const Fold& fold : sheet_.folds) {
            if (!panels.empty() && (fold.left == panels.front() || fold.right == panels.front())) {
                place = nth(pattern_.lines, fold.line).place;
                break;
            }
        }
        diagnostics_
            .warning(
                "flat-order", place,
                fmt::format("folded flat, {} panels would have to pass through one another: those about {}",
                            panels.size(), names))
            .hint("change which folds between them are mountains, or make one of them narrower");
    }

    const CreasePattern& pattern_;
    Sheet sheet_;
    Diagnostics& diagnostics_;
    folded::Work work_;
    std::size_t wrong_ = 0;
};

}  // namespace

std::optional<FlatFolding> fold_flat(const CreasePattern& pattern, const FoldOptions& options,
                                     Diagnostics& diagnostics) {
    std::optional<Sheet> sheet = folded::make_sheet(pattern, options, diagnostics);
    if (!sheet) return std::nullopt;
    return FlatCheck(pattern, std::move(*sheet), diagnostics).run();
}

}  // namespace popup
