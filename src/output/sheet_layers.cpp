#include "output/sheet_layers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "assembly/folded_sheets.h"
#include "base/geometry/pages.h"
#include "base/geometry/regions.h"
#include "base/nth.h"
#include "output/common_paper.h"
#include "output/layer_levels.h"
#include "output/space_mesh.h"
#include "popup/motion.h"

namespace popup {
namespace {

constexpr std::size_t kMostPlates = 1000;
constexpr std::size_t kMostPairs = 20'000;  // that are looked at, at one opening
constexpr double kInOnePlaneMm = 0.1;       // this near they lie on one another
constexpr double kTellsSideMm = 0.02;       // from so far apart on it is told which is in front
constexpr double kParallelSine = 0.01;
constexpr double kStepDeg = 1.0;       // back to where panels come from
constexpr double kMostLayersMm = 3.0;  // of layers together
constexpr double kOfSheet = 1.0 / 4000.0;

// How far a panel reaches along x, y and z, and which way it faces: by how much of its normal is along a
// fixed direction, whichever of its sides is in front. Panels in one plane have ranges that meet, in all
// four.
using Reach = std::array<std::pair<double, double>, 4>;
constexpr Vec3 kSkew{0.48, 0.6, 0.64};

Reach reach_of(const Plate& plate, const Frame& frame) {
    Reach reach;
    reach.fill({HUGE_VAL, -HUGE_VAL});
    for (const Vec2 corner : plate.outline.outer) {
        const Vec3 p = frame.point(corner);
        const std::array<double, 3> at{p.x, p.y, p.z};
        for (std::size_t i = 0; i < at.size(); ++i)
            reach[i] = {std::min(reach[i].first, at[i]), std::max(reach[i].second, at[i] + kInOnePlaneMm)};
    }
    const double facing = std::abs(dot(frame.normal(), kSkew));
    reach[3] = {facing, facing + kParallelSine};
    return reach;
}

bool meet(const Reach& a, const Reach& b) {
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (a[i].first > b[i].second || b[i].first > a[i].second) return false;
    }
    return true;
}

// Along which of the four the ranges overlap least.
std::size_t sparsest(const std::vector<Reach>& reaches) {
    std::size_t best = 0;
    double least = HUGE_VAL;
    for (std::size_t i = 0; i < Reach{}.size(); ++i) {
        double low = HUGE_VAL;
        double high = -HUGE_VAL;
        double sum = 0.0;
        for (const Reach& one : reaches) {
            low = std::min(low, one[i].first);
            high = std::max(high, one[i].second);
            sum += one[i].second - one[i].first;
        }
        const double overlap = sum / (high - low);
        if (overlap >= least) continue;
        least = overlap;
        best = i;
    }
    return best;
}

// How far points of b are before the front of a.
struct Heights {
    double mean = 0.0, farthest = 0.0;
};
Heights heights_of(const std::vector<Vec2>& on_a, const Frame& a, const std::vector<Vec2>& on_b,
                   const Frame& b) {
    Heights heights;
    const Vec3 front = a.normal();
    for (std::size_t i = 0; i < on_a.size(); ++i) {
        const double height = dot(b.point(on_b[i]) - a.point(on_a[i]), front);
        heights.mean += height / static_cast<double>(on_a.size());
        heights.farthest = std::max(heights.farthest, std::abs(height));
    }
    return heights;
}
int side_of(const Heights& heights) {
    return heights.mean > kTellsSideMm ? 1 : heights.mean < -kTellsSideMm ? -1 : 0;
}

// The first of those that hang together, for each; `bonds`: pairs of them.
std::vector<int> groups_of(std::size_t count, std::span<const std::pair<int, int>> bonds) {
    std::vector<int> group(count);
    std::iota(group.begin(), group.end(), 0);
    const auto first = [&group](int one) {
        while (nth(group, one) != one) one = nth(group, one) = nth(group, nth(group, one));
        return one;
    };
    for (const auto& [a, b] : bonds) {
        const int one = first(a);
        const int other = first(b);
        nth(group, std::max(one, other)) = std::min(one, other);
    }
    for (std::size_t i = 0; i < count; ++i) group[i] = first(static_cast<int>(i));
    return group;
}

}  // namespace

SheetLayers::SheetLayers(const Assembly& assembly)
    : assembly_(assembly),
      is_sheet_(assembly.plates.size() <= kMostPlates && is_folded_sheet(assembly)),
      layer_mm_(kLayerMm) {
    if (!is_sheet_) return;
    Box box;
    for (const Plate& plate : assembly.plates) {
        for (const Vec2 p : plate.outline.outer) box.extend(p);
    }
    if (!box.empty()) layer_mm_ = std::max(kLayerMm, kOfSheet * std::hypot(box.width(), box.height()));
}

void SheetLayers::look_at(int a, int b, std::span<const Frame> frames, std::vector<Lying>& lying) const {
    const Frame& at_a = nth(frames, a);
    const Frame& at_b = nth(frames, b);
    if (length(cross(at_a.normal(), at_b.normal())) > kParallelSine) return;
    Lying one{a,
              b,
              {},
              common_paper(on_other_page(nth(assembly_.plates, a).outline, at_a, at_b),
                           nth(assembly_.plates, b).outline)};
    if (one.on_b.empty()) return;
    for (const Vec2 p : one.on_b) {
        const Vec3 off = at_b.point(p) - at_a.origin;
        one.on_a.push_back({dot(off, at_a.axes[0]), dot(off, at_a.axes[1])});
    }
    const Heights heights = heights_of(one.on_a, at_a, one.on_b, at_b);
    if (heights.farthest > kInOnePlaneMm) return;
    one.side = side_of(heights);
    lying.push_back(std::move(one));
}

std::vector<SheetLayers::Lying> SheetLayers::lying_at(std::span<const Frame> frames) const {
    std::vector<Reach> reaches;
    for (std::size_t i = 0; i < frames.size(); ++i)
        reaches.push_back(reach_of(assembly_.plates[i], frames[i]));
    const std::size_t axis = sparsest(reaches);
    std::vector<std::pair<double, int>> order;
    for (std::size_t i = 0; i < reaches.size(); ++i)
        order.emplace_back(reaches[i].at(axis).first, static_cast<int>(i));
    std::sort(order.begin(), order.end());
    std::vector<std::pair<int, int>> near;
    for (std::size_t i = 0; i < order.size(); ++i) {
        const Reach& one = nth(reaches, order[i].second);
        for (std::size_t k = i + 1; k < order.size() && order[k].first <= one.at(axis).second; ++k) {
            if (meet(one, nth(reaches, order[k].second)))
                near.emplace_back(std::minmax(order[i].second, order[k].second));
            if (near.size() > kMostPairs) return {};
        }
    }
    std::sort(near.begin(), near.end());
    std::vector<Lying> lying;
    for (const auto& [a, b] : near) look_at(a, b, frames, lying);
    return lying;
}

const std::vector<Frame>& SheetLayers::placed(int step) {
    if (nth(placed_, step).empty()) {
        std::vector<Frame> frames(assembly_.plates.size());
        const double there = assembly_.sweep.from_deg + step * kStepDeg;
        const double opening = std::min(there, assembly_.sweep.to_deg);
        if (place(assembly_, Angle::degrees(opening), frames)) nth(placed_, step) = std::move(frames);
    }
    return nth(placed_, step);
}

void SheetLayers::find_sides(double opening_deg, std::vector<Lying>& lying) {
    const Sweep& sweep = assembly_.sweep;
    const int steps = static_cast<int>(std::ceil((sweep.to_deg - sweep.from_deg) / kStepDeg));
    placed_.resize(static_cast<std::size_t>(steps) + 1);
    const auto is_open = [](const Lying& one) { return one.side == 0; };
    const double since = std::max(0.0, (opening_deg - sweep.from_deg) / kStepDeg);
    for (int step = static_cast<int>(since) + 1; step <= steps; ++step) {
        if (std::none_of(lying.begin(), lying.end(), is_open)) return;
        const std::vector<Frame>& frames = placed(step);
        if (frames.empty()) return;
        for (Lying& one : lying) {
            if (is_open(one))
                one.side = side_of(heights_of(one.on_a, nth(frames, one.a), one.on_b, nth(frames, one.b)));
        }
    }
}

std::vector<double> SheetLayers::at(double opening_deg, std::span<const Frame> frames) {
    if (!is_sheet_) return {};
    std::vector<Lying> lying = lying_at(frames);
    find_sides(opening_deg, lying);
    std::erase_if(lying, [](const Lying& one) { return one.side == 0; });
    if (lying.empty()) return {};
    const std::size_t count = frames.size();
    std::vector<std::pair<int, int>> over;
    over.reserve(lying.size());
    for (const Lying& one : lying) over.emplace_back(one.a, one.b);
    const std::vector<int> group = groups_of(count, over);
    // Each is seen with the front of the first of its group up.
    const auto up = [&](int plate) {
        return dot(nth(frames, plate).normal(), nth(frames, nth(group, plate)).normal()) > 0.0 ? 1 : -1;
    };
    for (std::size_t i = 0; i < lying.size(); ++i) {
        if (lying[i].side * up(lying[i].a) < 0) std::swap(over[i].first, over[i].second);
    }
    const std::vector<int> levels = layer_levels(count, over);
    // The largest of each group stays where it is.
    std::vector<int> still(count, -1);
    std::vector<double> most(count, 0.0);
    for (std::size_t i = 0; i < count; ++i) {
        const auto of = static_cast<std::size_t>(group[i]);
        const double paper = std::round(area(assembly_.plates[i].outline));
        if (still[of] >= 0 && paper <= most[of]) continue;
        still[of] = static_cast<int>(i);
        most[of] = paper;
    }
    const int highest = *std::max_element(levels.begin(), levels.end());
    const double share = std::min(1.0, kMostLayersMm / (layer_mm_ * highest));
    std::vector<double> result(count, 0.0);
    for (std::size_t i = 0; i < count; ++i) {
        const int above = levels[i] - nth(levels, nth(still, group[i]));
        if (above != 0) result[i] = share * up(static_cast<int>(i)) * above;
    }
    return result;
}

}  // namespace popup
