#include "motion/lying.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "base/geometry/pages.h"
#include "base/geometry/regions.h"
#include "base/geometry/tolerances.h"
#include "motion/cells.h"
#include "popup/motion.h"

namespace popup {
namespace {

// Where it is looked, as shares of the sweep: half open, and once more at an angle that means nothing.
constexpr std::array kShares{0.5, 0.37};
constexpr double kSameSine = 1e-5;      // between planes that are one
constexpr double kLeastMm2 = 1.0;       // of paper on paper
constexpr double kFreeMm2 = 1e-3;       // less is left by a move that parts two
constexpr double kInnerPointMm = 0.1;   // to which its middle is found
constexpr std::size_t kMostNear = 200;  // earlier plates that one is held against
constexpr double kWhole = 0.999;        // of a plate

Angle opening_of(const Sweep& sweep, double share) {
    return Angle::degrees(sweep.from_deg + share * (sweep.to_deg - sweep.from_deg));
}

const Frame& frame_of(std::span<const Frame> frames, int plate) {
    return frames[static_cast<std::size_t>(plate)];
}

const PlateShape& shape_of(std::span<const PlateShape> shapes, int plate) {
    return shapes[static_cast<std::size_t>(plate)];
}

bool in_one_plane(const Frame& a, const Frame& b, const PlateShape& of_b) {
    const Vec3 normal = a.normal();
    if (length(cross(normal, b.normal())) > kSameSine) return false;
    return std::all_of(of_b.hull.begin(), of_b.hull.end(),
                       [&](Vec2 p) { return std::abs(dot(b.point(p) - a.origin, normal)) <= kTouchMm; });
}

// What they share, on the page of b.
std::vector<Polygon> common_paper(const Assembly& assembly, int a, int b, std::span<const Frame> frames) {
    const auto outline = [&](int plate) -> const Polygon& {
        return assembly.plates[static_cast<std::size_t>(plate)].outline;
    };
    return intersect({on_other_page(outline(a), frame_of(frames, a), frame_of(frames, b))}, {outline(b)});
}

std::optional<LyingPair> shared(const Assembly& assembly, int a, int b, std::span<const Frame> frames,
                                double least_mm2) {
    LyingPair found{a, b, 0.0, {}, {}};
    const std::vector<Polygon> parts = common_paper(assembly, a, b, frames);
    const Polygon* largest = nullptr;
    double most = 0.0;
    for (const Polygon& part : parts) {
        const double here = area(part);
        found.area_mm2 += here;
        if (here <= most) continue;
        most = here;
        largest = &part;
    }
    if (largest == nullptr || found.area_mm2 <= least_mm2) return std::nullopt;
    const Box box = bounds(largest->outer);
    found.size = {box.width(), box.height()};
    found.point = inner_point(*largest, kInnerPointMm).at;
    return found;
}

// Whether there is such a pair. A point within takes most of the time that shared() does.
bool do_share(const Assembly& assembly, int a, int b, std::span<const Frame> frames, double least_mm2) {
    double sum = 0.0;
    for (const Polygon& part : common_paper(assembly, a, b, frames)) sum += area(part);
    return sum > least_mm2;
}

// The pairs that share a plane at all openings that are looked at.
std::vector<std::pair<int, int>> in_plane_pairs(const Assembly& assembly, std::span<const PlateShape> shapes,
                                                std::vector<std::pair<int, int>> pairs,
                                                std::vector<Frame> frames) {
    for (const double share : kShares) {
        if (share != kShares.front() && !place(assembly, opening_of(assembly.sweep, share), frames))
            return {};
        std::erase_if(pairs, [&](const std::pair<int, int>& one) {
            return !in_one_plane(frame_of(frames, one.first), frame_of(frames, one.second),
                                 shape_of(shapes, one.second));
        });
        if (pairs.empty()) return {};
    }
    return pairs;
}

std::optional<std::vector<Frame>> half_open(const Assembly& assembly) {
    std::vector<Frame> frames(assembly.plates.size());
    if (!place(assembly, opening_of(assembly.sweep, kShares.front()), frames)) return std::nullopt;
    return frames;
}

bool may_lie(const Plate& plate) { return plate.lying != Lying::free || plate.rivet; }

// What is glued to a plate along a seam may lie flat on it, and two pieces that both do are a collage.
class Seams {
 public:
    Seams(const Assembly& assembly, std::span<const PlateShape> shapes, std::span<const Frame> frames) {
        for (const Hinge& hinge : assembly.hinges) {
            joined_.insert(std::minmax(hinge.a, hinge.b));
            if (!hinge.glued) continue;
            if (in_one_plane(frame_of(frames, hinge.a), frame_of(frames, hinge.b),
                             shape_of(shapes, hinge.b))) {
                bases_[hinge.a].insert(hinge.b);
                bases_[hinge.b].insert(hinge.a);
            }
        }
    }

    [[nodiscard]] bool join(int a, int b) const {
        if (joined_.contains(std::minmax(a, b))) return true;
        const auto of_a = bases_.find(a);
        const auto of_b = bases_.find(b);
        return of_a != bases_.end() && of_b != bases_.end() &&
               std::any_of(of_a->second.begin(), of_a->second.end(),
                           [&](int base) { return of_b->second.contains(base); });
    }

 private:
    std::set<std::pair<int, int>> joined_;
    std::map<int, std::set<int>> bases_;
};

// Pairs of plates of two elements that may not lie on one another, are near each other and share a plane.
template <typename Wanted>
std::vector<std::pair<int, int>> lying_candidates(const Assembly& assembly, const Linkage& linkage,
                                                  std::span<const PlateShape> shapes,
                                                  const std::vector<Frame>& frames, const Wanted& is_wanted) {
    std::vector<SpaceBox> boxes(shapes.size());
    for (std::size_t i = 0; i < shapes.size(); ++i) {
        for (const Vec2 corner : shapes[i].hull) boxes[i].extend(frames[i].point(corner));
    }
    std::vector<std::pair<int, int>> pairs = near_earlier(boxes, kMostNear);
    const Seams seams(assembly, shapes, frames);
    std::erase_if(pairs, [&](const std::pair<int, int>& one) {
        const auto plate = [&](int i) -> const Plate& {
            return assembly.plates[static_cast<std::size_t>(i)];
        };
        return !is_wanted(one.first, one.second) || seams.join(one.first, one.second) ||
               linkage.joint_of(one.first) == linkage.joint_of(one.second) || may_lie(plate(one.first)) ||
               may_lie(plate(one.second));
    });
    return in_plane_pairs(assembly, shapes, std::move(pairs), frames);
}

}  // namespace

std::vector<LyingPair> find_lying(const Assembly& assembly, const Linkage& linkage,
                                  std::span<const PlateShape> shapes) {
    if (assembly.covers.empty()) return {};
    const auto frames = half_open(assembly);
    if (!frames) return {};
    const auto pairs =
        lying_candidates(assembly, linkage, shapes, *frames, [](int /*a*/, int /*b*/) { return true; });
    std::map<int, LyingPair> worst;  // by the later joint
    std::set<int> whole;             // joints of which a plate is covered: nothing is worse
    for (const auto& [a, b] : pairs) {
        const int later = std::max(linkage.joint_of(a), linkage.joint_of(b));
        if (whole.contains(later)) continue;
        const auto one = shared(assembly, a, b, *frames, kLeastMm2);
        if (!one) continue;
        const auto [at, is_new] = worst.try_emplace(later, *one);
        if (!is_new && one->area_mm2 > at->second.area_mm2) at->second = *one;
        const int own = linkage.joint_of(b) == later ? b : a;
        if (one->area_mm2 >= kWhole * area(assembly.plates[static_cast<std::size_t>(own)].outline))
            whole.insert(later);
    }
    std::vector<LyingPair> found;
    found.reserve(worst.size());
    for (const auto& [joint, one] : worst) found.push_back(one);
    std::sort(found.begin(), found.end(), [](const LyingPair& p, const LyingPair& q) {
        return std::pair(p.a, p.b) < std::pair(q.a, q.b);
    });
    return found;
}

std::vector<std::pair<int, int>> lying_with(const Assembly& assembly, const Linkage& linkage,
                                            std::span<const PlateShape> shapes,
                                            const std::vector<char>& moved) {
    if (assembly.covers.empty()) return {};
    const auto frames = half_open(assembly);
    if (!frames) return {};
    const auto is_moved = [&](int plate) { return moved[static_cast<std::size_t>(plate)] != 0; };
    auto pairs = lying_candidates(assembly, linkage, shapes, *frames,
                                  [&](int a, int b) { return is_moved(a) != is_moved(b); });
    std::erase_if(pairs, [&](const std::pair<int, int>& one) {
        return !do_share(assembly, one.first, one.second, *frames, kLeastMm2);
    });
    std::sort(pairs.begin(), pairs.end());
    return pairs;
}

bool any_lies(const Assembly& assembly, std::span<const PlateShape> shapes,
              std::span<const std::pair<int, int>> pairs) {
    if (assembly.covers.empty()) return false;
    const auto frames = half_open(assembly);
    if (!frames) return true;
    const auto in_plane = in_plane_pairs(assembly, shapes, {pairs.begin(), pairs.end()}, *frames);
    return std::any_of(in_plane.begin(), in_plane.end(), [&](const std::pair<int, int>& one) {
        return do_share(assembly, one.first, one.second, *frames, kFreeMm2);
    });
}

}  // namespace popup
