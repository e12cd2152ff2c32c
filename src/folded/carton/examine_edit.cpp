#include "folded/carton/examine_edit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <set>
#include <string>
#include <utility>

#include "assembly/folded_sheets.h"
#include "base/geometry/regions.h"
#include "base/nth.h"
#include "folded/carton/lying_panels.h"

namespace popup::folded {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kOverlapMm2 = 0.01;
constexpr double kSquare = 0.02;     // cosine: a crease that leans by more turns nothing parallel
constexpr double kSameAngle = 1e-9;  // radians: what turns by less stays as it was, to the last digit

class Examiner {
 public:
    Examiner(const CreasePattern& pattern, const Vertices& shape, const MovedVertices& moved,
             std::vector<Vec2> corners, Diagnostics& diagnostics)
        : pattern_(pattern), shape_(shape), moved_(moved), diagnostics_(diagnostics), sheet_(shape.sheet()) {
        sheet_.corners = std::move(corners);
    }

    std::optional<ExaminedEdit> run() {
        if (!stands() || !has_panels() || !lies_flat()) return std::nullopt;
        const std::vector<LyingFlap> lying = lying_panels(shape_);
        fold_panels();
        fold_flaps(lying);
        if (!meets() || !lies_glued(lying)) return std::nullopt;
        const double turn_deg = most_turn_deg();
        return ExaminedEdit{std::move(sheet_), std::move(angles_), turn_deg};
    }

 private:
    bool refuse(int panel, std::string why, std::string hint) {
        diagnostics_.error("edit-refused", place_of(pattern_, shape_, panel), std::move(why))
            .hint(std::move(hint));
        return false;
    }

    bool has_panels() {
        for (std::size_t i = 0; i < sheet_.panels.size(); ++i) {
            Ring ring;
            for (const int corner : sheet_.panels[i].outer) ring.push_back(sheet_.at(corner));
            if (signed_area(ring) > 0.0 && is_simple(sheet_.panels[i])) continue;
            return refuse(static_cast<int>(i),
                          fmt::format("{} would have no area, or cross itself, near {}",
                                      shape_.name_of(static_cast<int>(i)),
                                      shown_point(pattern_.ruler, bounds(ring).centre())),
                          "move it less far");
        }
        return true;
    }
    [[nodiscard]] bool is_simple(const Panel& panel) const {
        const Polygon outline = sheet_.outline_of(panel);
        return std::abs(area(unite({outline})) - area(outline)) <= kOverlapMm2;
    }

    // No two panels lie over each other that did not before.
    bool lies_flat() {
        struct Flat {
            Box box;
            int panel = 0;
        };
        std::vector<Flat> all;
        for (std::size_t i = 0; i < sheet_.panels.size(); ++i) {
            Flat& one = all.emplace_back();
            one.panel = static_cast<int>(i);
            for (const int corner : sheet_.panels[i].outer) one.box.extend(sheet_.at(corner));
        }
        std::sort(all.begin(), all.end(), [](const Flat& a, const Flat& b) {
            return std::pair(a.box.min.x, a.panel) < std::pair(b.box.min.x, b.panel);
        });
        std::vector<Flat> open;
        for (const Flat& one : all) {
            std::erase_if(open, [&](const Flat& other) { return other.box.max.x <= one.box.min.x; });
            for (const Flat& other : open) {
                if (other.box.max.y <= one.box.min.y || one.box.max.y <= other.box.min.y) continue;
                const auto over = intersect({sheet_.outline_of(nth(sheet_.panels, one.panel))},
                                            {sheet_.outline_of(nth(sheet_.panels, other.panel))});
                if (const double size = area(over); size > kOverlapMm2) {
                    return refuse(
                        one.panel,
                        fmt::format("{} and {} would lie over each other on the sheet by {:.2f} mm², near {}",
                                    shape_.name_of(other.panel), shape_.name_of(one.panel), size,
                                    shown_point(pattern_.ruler, bounds(over.front().outer).centre())),
                        "move it less far, or make room in the drawing");
                }
            }
            open.push_back(one);
        }
        return true;
    }

    // No panel has gone through what is opposite.
    bool stands() {
        for (const int panel : shape_.tree().order) {
            const Vec3 normal = nth(moved_.normals, panel);
            if (nth(moved_.solved, panel) == 0 || length(normal) == 0.0) continue;
            if (dot(normal, shape_.state().normal(panel)) > 0.0) continue;
            return refuse(panel,
                          fmt::format("{} would turn over: what moves goes through what is opposite",
                                      shape_.name_of(panel)),
                          "move it less far");
        }
        return true;
    }

    // Folds as the panels on both sides stand in space.
    void fold_panels() {
        angles_ = shape_.state().angles();
        for (std::size_t i = 0; i < sheet_.folds.size(); ++i) {
            const Fold& fold = sheet_.folds[i];
            const Vec3 left = nth(moved_.normals, fold.left);
            const Vec3 right = nth(moved_.normals, fold.right);
            if (length(left) == 0.0 || length(right) == 0.0) continue;
            const auto at = [&](int corner) { return shape_.place(corner) + nth(moved_.by, corner); };
            const Vec3 way = at(fold.stretches.back().b) - at(fold.stretches.front().a);
            if (length(way) > 0.0) angles_[i] = angle_of(right, left, unit(way), angles_[i]);
        }
    }
    // As FoldedState has it; of half a turn the sign that it had.
    static double angle_of(Vec3 right, Vec3 left, Vec3 way, double was) {
        constexpr double kHalf = std::numbers::pi - 1e-6;
        const double angle = std::atan2(dot(cross(right, left), way), dot(right, left));
        if (std::abs(angle - was) < kSameAngle) return was;
        return std::abs(angle) > kHalf && angle * was < 0.0 ? -angle : angle;
    }

    // Flaps that lay on a panel are parallel to it again, if turning their crease can do that.
    void fold_flaps(const std::vector<LyingFlap>& lying) {
        const FoldedState state(sheet_, shape_.tree(), angles_);
        for (const LyingFlap& one : lying) {
            const int up = shape_.parent(one.flap);
            if (nth(moved_.solved, one.flap) != 0 || up < 0 || nth(moved_.solved, up) == 0) continue;
            const int number = nth(shape_.tree().fold_of, one.flap);
            const Fold& fold = nth(sheet_.folds, number);
            const Vec3 way = unit(state.place({up, fold.stretches.back().b}) -
                                  state.place({up, fold.stretches.front().a}));
            const Vec3 wanted = one.same_way ? state.normal(one.panel) : -state.normal(one.panel);
            if (std::abs(dot(way, wanted)) > kSquare) continue;
            const bool is_left = fold.left == one.flap;
            const Vec3 other = state.normal(up);
            double& angle = nth(angles_, number);
            angle = angle_of(is_left ? other : wanted, is_left ? wanted : other, way, angle);
        }
    }

    // What met in the folded shape meets again.
    bool meets() {
        const FoldedState& before = shape_.state();
        const FoldedState after(sheet_, shape_.tree(), angles_);
        for (const PanelJoin& join : met(before)) {
            const double apart = after.apart(join);
            if (apart <= kMeetsMm) continue;
            const CornerOf first = join.merged.front();
            const CornerOf last = join.merged.back();
            return refuse(
                first.panel,
                fmt::format("{} at {} and {} at {} meet in the folded shape, and would be {:.2f} mm apart",
                            shape_.name_of(first.panel),
                            shown_point(pattern_.ruler, shape_.sheet().at(first.corner)),
                            shape_.name_of(last.panel),
                            shown_point(pattern_.ruler, shape_.sheet().at(last.corner)), apart),
                "move it less far, or what is opposite as well");
        }
        return true;
    }

    [[nodiscard]] double most_turn_deg() const {
        double most = 0.0;
        const std::vector<double>& before = shape_.state().angles();
        for (std::size_t i = 0; i < angles_.size(); ++i)
            most = std::max(most, std::abs(angles_[i] - before[i]) / kDegree);
        return most;
    }

    // Vertices at which corners of different panels are in one place.
    [[nodiscard]] std::vector<PanelJoin> met(const FoldedState& before) const {
        std::vector<PanelJoin> joins;
        for (const std::vector<CornerOf>& members : shape_.members()) {
            std::vector<char> taken(members.size(), 0);
            for (std::size_t i = 0; i < members.size(); ++i) {
                if (taken[i] != 0) continue;
                PanelJoin join;
                std::set<int> corners;
                for (std::size_t j = i; j < members.size(); ++j) {
                    if (taken[j] != 0 ||
                        distance(before.place(members[i]), before.place(members[j])) > kMeetsMm)
                        continue;
                    taken[j] = 1;
                    if (corners.insert(members[j].corner).second) join.merged.push_back(members[j]);
                }
                if (join.merged.size() > 1) joins.push_back(std::move(join));
            }
        }
        return joins;
    }

    // Glue flaps lie on what they lay on, as far from it, and stick out no further.
    bool lies_glued(const std::vector<LyingFlap>& lying) {
        const FoldedState after(sheet_, shape_.tree(), angles_);
        for (const LyingFlap& one : lying) {
            const std::string& flap = shape_.name_of(one.flap);
            if (flap.find(kGlueFlapName) == std::string::npos) continue;
            const std::string& panel = shape_.name_of(one.panel);
            const LyingFlap now = lying_in(after, one.flap, one.panel);
            if (std::max(one.near - now.near, now.far - one.far) > kMeetsMm) {
                return refuse(
                    one.flap,
                    fmt::format("{} lies {:.2f} to {:.2f} mm above {}, and would be {:.2f} to {:.2f} "
                                "mm above it",
                                flap, one.near, one.far, panel, now.near, now.far),
                    "move both ends of an edge alike, or a whole panel with extrude");
            }
            if (now.beside - one.beside > kMeetsMm) {
                return refuse(one.flap,
                              fmt::format("{} would reach {:.2f} mm beside {}, which it is glued to", flap,
                                          now.beside, panel),
                              "move it less far, or draw a narrower flap");
            }
        }
        return true;
    }

    const CreasePattern& pattern_;
    const Vertices& shape_;
    const MovedVertices& moved_;
    Diagnostics& diagnostics_;
    Sheet sheet_;
    std::vector<double> angles_;  // by fold, radians: those that close it
};

}  // namespace

std::optional<ExaminedEdit> examine_edit(const CreasePattern& pattern, const Vertices& shape,
                                         const MovedVertices& moved, std::vector<Vec2> corners,
                                         Diagnostics& diagnostics) {
    return Examiner(pattern, shape, moved, std::move(corners), diagnostics).run();
}

Place place_of(const CreasePattern& pattern, const Vertices& shape, int panel) {
    const std::vector<Fold>& folds = shape.sheet().folds;
    const int own = nth(shape.tree().fold_of, panel);
    if (own >= 0) return nth(pattern.lines, nth(folds, own).line).place;
    const auto any = std::find_if(folds.begin(), folds.end(), [&](const Fold& fold) {
        return fold.left == panel || fold.right == panel;
    });
    return any != folds.end() ? nth(pattern.lines, any->line).place : Place{};
}

}  // namespace popup::folded
