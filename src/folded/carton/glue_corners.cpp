#include "folded/carton/glue_corners.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "base/nth.h"
#include "folded/asked.h"
#include "folded/lower.h"

namespace popup::folded {
namespace {

constexpr double kOblique = 0.3;      // sine and cosine of what is neither along nor across
constexpr double kSquare = 0.05;      // cosine of folds that are called square
constexpr double kAlong = 0.05;       // sine of such as are called parallel
constexpr double kBesideShare = 0.1;  // of the crease: flaps may begin that far beside the fold of their wall

class Finder {
 public:
    Finder(const CreasePattern& pattern, const FoldOptions& options, const Sheet& sheet)
        : pattern_(pattern), options_(options), sheet_(sheet), folds_(folds_by_panel(sheet)) {}

    std::vector<int> run() const {
        std::vector<int> found;
        for (std::size_t i = 0; i < sheet_.folds.size(); ++i) {
            const auto crease = static_cast<int>(i);
            if (is_asked(pattern_, options_, sheet_.folds[i])) continue;
            if (is_across(crease, sheet_.folds[i].left, sheet_.folds[i].right) ||
                is_across(crease, sheet_.folds[i].right, sheet_.folds[i].left))
                found.push_back(crease);
        }
        return found;
    }

 private:
    [[nodiscard]] Segment line(int fold) const { return sheet_.line_of(nth(sheet_.folds, fold)); }
    [[nodiscard]] Vec2 way(int fold) const { return unit(line(fold).b - line(fold).a); }
    [[nodiscard]] int beyond(int fold, int panel) const {
        const Fold& one = nth(sheet_.folds, fold);
        return one.left == panel ? one.right : one.left;
    }
    [[nodiscard]] bool ends_at(int fold, Vec2 at, double near) const {
        return distance(line(fold).a, at) <= near || distance(line(fold).b, at) <= near;
    }

    [[nodiscard]] bool is_across(int crease, int flap, int corner) const {
        if (nth(folds_, corner).size() != 1) return false;
        const double near = kBesideShare * distance(line(crease).a, line(crease).b);
        return std::any_of(nth(folds_, flap).begin(), nth(folds_, flap).end(), [&](int own) {
            if (own == crease || !is_oblique(crease, own)) return false;
            return std::any_of(
                nth(folds_, beyond(own, flap)).begin(), nth(folds_, beyond(own, flap)).end(),
                [&](int between) { return meets_next_flap(crease, own, between, beyond(own, flap), near); });
        });
    }
    [[nodiscard]] bool is_oblique(int one, int other) const {
        return std::abs(cross(way(one), way(other))) > kOblique &&
               std::abs(dot(way(one), way(other))) > kOblique;
    }

    // Whether the wall ends at the crease's own end with a fold that is square to the flap's, and the next
    // wall has a flap beside this one.
    [[nodiscard]] bool meets_next_flap(int crease, int own, int between, int wall, double near) const {
        if (between == own || std::abs(dot(way(between), way(own))) > kSquare) return false;
        for (const Vec2 at : {line(crease).a, line(crease).b}) {
            if (!ends_at(own, at, near) || !ends_at(between, at, near)) continue;
            const int next = beyond(between, wall);
            return std::any_of(nth(folds_, next).begin(), nth(folds_, next).end(), [&](int fold) {
                return fold != between && ends_at(fold, at, near) &&
                       std::abs(cross(way(fold), way(own))) < kAlong;
            });
        }
        return false;
    }

    const CreasePattern& pattern_;
    const FoldOptions& options_;
    const Sheet& sheet_;
    std::vector<std::vector<int>> folds_;
};

}  // namespace

void lay_glue_corners(const CreasePattern& pattern, const FoldOptions& options, Sheet& sheet,
                      Diagnostics& diagnostics) {
    const std::vector<int> creases = Finder(pattern, options, sheet).run();
    if (creases.empty()) return;
    for (const int crease : creases) {
        Fold& fold = nth(sheet.folds, crease);
        fold.ink = fold.target < 0.0 ? kMountain : kValley;
        fold.target = 0.0;
    }
    const Fold& first = nth(sheet.folds, creases.front());
    const bool one = creases.size() == 1;
    const std::string lead =
        one ? std::string("an oblique crease leads across a flap,")
            : fmt::format("{} oblique creases lead across flaps, the first", creases.size());
    diagnostics
        .remark(
            "glue-corners", nth(pattern.lines, first.line).place,
            fmt::format("{} from {} to {}; {} flat when the box stands, because the corner beyond is glued "
                        "to the panel beside the flap",
                        lead, shown_point(pattern.ruler, sheet.line_of(first).a),
                        shown_point(pattern.ruler, sheet.line_of(first).b), one ? "it lies" : "they lie"))
        .hint("data-fold-angle says otherwise");
}

}  // namespace popup::folded
