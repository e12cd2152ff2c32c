#include "folded/carton/lying_panels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>

#include "base/geometry/regions.h"
#include "base/nth.h"

namespace popup::folded {
namespace {

constexpr double kParallel = 0.9999;  // cosine

struct Reach {
    int panel = 0;
    std::array<double, 3> min{HUGE_VAL, HUGE_VAL, HUGE_VAL};
    std::array<double, 3> max{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    void extend(Vec3 at, double by) {
        const std::array<double, 3> along{at.x, at.y, at.z};
        for (std::size_t i = 0; i < 3; ++i) {
            min.at(i) = std::min(min.at(i), along.at(i) - by);
            max.at(i) = std::max(max.at(i), along.at(i) + by);
        }
    }
    [[nodiscard]] bool meets(const Reach& other) const {
        for (std::size_t i = 0; i < 3; ++i) {
            if (max.at(i) < other.min.at(i) || other.max.at(i) < min.at(i)) return false;
        }
        return true;
    }
};

// A corner of a panel in the frame of another, in which that lies as on the sheet.
Vec3 in_frame(const Rigid3& frame, Vec3 at) {
    const Vec3 d = at - frame.shift;
    return {dot(frame.axes[0], d), dot(frame.axes[1], d), dot(frame.axes[2], d)};
}

}  // namespace

double LyingFlap::off() const { return std::max(std::abs(near), std::abs(far)); }

LyingFlap lying_in(const FoldedState& state, int flap, int panel) {
    const Sheet& sheet = state.sheet();
    LyingFlap made{flap, panel, dot(state.normal(flap), state.normal(panel)) > 0.0, HUGE_VAL, -HUGE_VAL,
                   0.0,  0.0};
    const Polygon under = sheet.outline_of(nth(sheet.panels, panel));
    Polygon shadow;
    for (const int corner : nth(sheet.panels, flap).outer) {
        const Vec3 at = in_frame(state.frame(panel), state.place({flap, corner}));
        made.near = std::min(made.near, at.z);
        made.far = std::max(made.far, at.z);
        shadow.outer.push_back({at.x, at.y});
    }
    if (signed_area(shadow.outer) < 0.0) std::reverse(shadow.outer.begin(), shadow.outer.end());
    made.outside = area(subtract({shadow}, {under}));
    for (const Vec2 corner : shadow.outer) {
        if (contains(under, corner)) continue;
        double beside = HUGE_VAL;
        for (std::size_t i = 0; i < under.outer.size(); ++i)
            beside = std::min(
                beside, distance(corner, Segment{under.outer[i], under.outer[(i + 1) % under.outer.size()]}));
        made.beside = std::max(made.beside, beside);
    }
    return made;
}

std::vector<LyingFlap> lying_panels(const Vertices& shape) {
    const FoldedState& state = shape.state();
    const Sheet& sheet = shape.sheet();
    std::vector<Reach> all;
    for (const int panel : shape.tree().order) {
        Reach& one = all.emplace_back();
        one.panel = panel;
        for (const int corner : nth(sheet.panels, panel).outer)
            one.extend(state.place({panel, corner}), shape.meet_mm());
    }
    std::sort(all.begin(), all.end(), [](const Reach& a, const Reach& b) {
        return std::pair(a.min[0], a.panel) < std::pair(b.min[0], b.panel);
    });
    std::map<int, LyingFlap> best;  // by flap
    const auto look = [&](int flap, int panel) {
        if (shape.parent(flap) == panel) return;
        const LyingFlap one = lying_in(state, flap, panel);
        if (one.off() > shape.meet_mm()) return;
        const double size = area(sheet.outline_of(nth(sheet.panels, flap)));
        if (one.outside >= 0.5 * size) return;
        const auto [at, fresh] = best.try_emplace(flap, one);
        if (!fresh && one.outside < at->second.outside) at->second = one;
    };
    std::vector<Reach> open;
    for (const Reach& one : all) {
        std::erase_if(open, [&](const Reach& other) { return other.max[0] < one.min[0]; });
        for (const Reach& other : open) {
            if (!one.meets(other)) continue;
            if (std::abs(dot(state.normal(one.panel), state.normal(other.panel))) < kParallel) continue;
            look(one.panel, other.panel);
            look(other.panel, one.panel);
        }
        open.push_back(one);
    }
    std::vector<LyingFlap> found;
    found.reserve(best.size());
    for (const auto& [flap, one] : best) found.push_back(one);
    return found;
}

}  // namespace popup::folded
