#include "motion/touching.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "base/geometry/pages.h"
#include "base/geometry/regions.h"
#include "base/nth.h"
#include "motion/cells.h"
#include "motion/nearness.h"
#include "popup/motion.h"

namespace popup {
namespace {

constexpr double kSameSine = 1e-3;             // of planes that are one: refined angles are rounded
constexpr double kSamePlaneMm = 2 * kTouchMm;  // how far corners are off such a plane
constexpr double kLeastMm2 = 1.0;              // of paper on paper
constexpr double kMiddleMm = 0.1;              // to which the middle of it is found
constexpr double kMuchSmaller = 0.99;          // of an area
constexpr double kInnerMm = 0.1;               // a plane nearer to the middle of the box has no inner side
constexpr std::size_t kMostNear = 200;         // earlier plates that one is held against
// How far into a step, in shares of it, plates that touched at its end have a side, if they go as far as
// kTouchMm apart; and where on the way plates that lie on one another still do.
constexpr std::array kBegun{5e-6, 5e-5, 5e-4, 5e-3, 0.03};
constexpr std::array kNearlyOver{1.0 - 5e-6, 1.0 - 5e-5, 1.0 - 5e-4, 1.0 - 5e-3, 0.97};
constexpr std::array kOnTheWay{0.25, 0.5, 0.75};

bool in_one_plane(const Frame& a, const Frame& b, const PlateShape& of_b) {
    const Vec3 normal = a.normal();
    if (length(cross(normal, b.normal())) > kSameSine) return false;
    return std::all_of(of_b.hull.begin(), of_b.hull.end(),
                       [&](Vec2 p) { return std::abs(dot(b.point(p) - a.origin, normal)) <= kSamePlaneMm; });
}

bool share_a_fold(const Assembly& assembly, int a, int b) {
    return std::any_of(assembly.hinges.begin(), assembly.hinges.end(), [&](const Hinge& hinge) {
        return (hinge.a == a && hinge.b == b) || (hinge.a == b && hinge.b == a);
    });
}

std::optional<Touching> touching_at(const Assembly& assembly, int a, int b, const Frame& of_a,
                                    const Frame& of_b) {
    double shared = 0.0;
    std::optional<InnerPoint> best;
    for (const Polygon& part : intersect({nth(assembly.plates, a).outline},
                                         {on_other_page(nth(assembly.plates, b).outline, of_b, of_a)})) {
        shared += area(part);
        const InnerPoint inner = inner_point(part, kMiddleMm);
        if (!best || inner.clearance > best->clearance) best = inner;
    }
    if (!best || shared <= kLeastMm2) return std::nullopt;
    return Touching{best->at, on_page(relative(of_a, of_b), {best->at.x, best->at.y, 0.0})};
}

Vec3 middle_of_paper(const Assembly& assembly, std::span<const Frame> frames) {
    Vec3 sum{};
    double paper = 0.0;
    for (std::size_t i = 0; i < assembly.plates.size(); ++i) {
        const Polygon& outline = assembly.plates[i].outline;
        const double share = area(outline);
        sum = sum + share * frames[i].point(inner_point(outline, kMiddleMm).at);
        paper += share;
    }
    return paper > 0.0 ? (1.0 / paper) * sum : sum;
}

// Whether a plate lies folded in on one that it hangs on over a fold or two, and so does `between`.
bool is_lining_of_what_lies_under(const Assembly& assembly, const TouchingPlates& touching, int plate,
                                  int between) {
    int wall = nth(assembly.plates, plate).parent;
    for (int folds = 0; folds < 2 && wall >= 0; ++folds, wall = nth(assembly.plates, wall).parent) {
        if (wall == between) return false;
        if (folds == 0) continue;  // what shares a fold is not among them
        if (touching.contains(std::minmax(plate, wall)) && touching.contains(std::minmax(between, wall)))
            return true;
    }
    return false;
}

// The side of a pair in the first of these poses in which it has one; 0: in none.
int first_side(std::span<const PlateShape> shapes, std::span<const PlateFrames> poses,
               std::pair<int, int> pair, const Touching& one) {
    const auto [a, b] = pair;
    for (const PlateFrames& frames : poses) {
        if (frames.empty()) continue;
        const int side = side_of(nth(shapes, a), nth(shapes, b), relative(nth(frames, a), nth(frames, b)),
                                 one.of_a, one.of_b);
        if (side != 0) return side;
    }
    return 0;
}

// Whether two plates lie on one another, at their middle, in all of these poses.
bool lie_on(std::span<const PlateFrames> poses, std::pair<int, int> pair, const Touching& one) {
    return std::all_of(poses.begin(), poses.end(), [&](const PlateFrames& frames) {
        return !frames.empty() &&
               std::abs(relative(nth(frames, pair.first), nth(frames, pair.second)).point(one.of_b).z) <=
                   kSamePlaneMm;
    });
}

std::vector<PlateFrames> frames_at_all(const Assembly& assembly, std::span<const double> shares) {
    std::vector<PlateFrames> poses;
    poses.reserve(shares.size());
    for (const double share : shares) poses.push_back(frames_at(assembly, share));
    return poses;
}

}  // namespace

int side_of(const PlateShape& a, const PlateShape& b, const Frame& b_in_a, Vec2 of_a, Vec2 of_b) {
    const Vec3 b_at = b_in_a.point(of_b);
    // What has slipped round an edge has not gone through.
    if (!a.covers({b_at.x, b_at.y}) || !b.covers(on_page(b_in_a, {of_a.x, of_a.y, 0.0}))) return 0;
    const double b_over_a = b_at.z;
    const double a_over_b = dot(Vec3{of_a.x, of_a.y, 0.0} - b_in_a.origin, b_in_a.normal());
    if (std::abs(b_over_a) < kTouchMm || std::abs(a_over_b) < kTouchMm) return 0;
    // The planes face the same way or not; a is behind b when b is before a only if they do.
    const bool same = b_in_a.normal().z > 0.0;
    const int first = b_over_a > 0.0 ? 1 : -1;
    const int second = (a_over_b < 0.0) == same ? 1 : -1;
    return first == second ? first : 0;
}

TouchingPlates touching_plates(const Assembly& assembly, std::span<const PlateShape> shapes,
                               std::span<const Frame> frames) {
    std::vector<SpaceBox> boxes(shapes.size());
    for (std::size_t i = 0; i < shapes.size(); ++i) {
        for (const Vec2 corner : shapes[i].hull) boxes[i].extend(frames[i].point(corner), kSamePlaneMm);
    }
    TouchingPlates found;
    for (const auto& [a, b] : near_earlier(boxes, kMostNear)) {
        if (!in_one_plane(nth(frames, a), nth(frames, b), nth(shapes, b)) || share_a_fold(assembly, a, b))
            continue;
        if (const auto one = touching_at(assembly, a, b, nth(frames, a), nth(frames, b)))
            found.emplace(std::pair(a, b), *one);
    }
    return found;
}

PlateFrames frames_at(const Assembly& assembly, double share) {
    PlateFrames frames(assembly.plates.size());
    const Sweep& sweep = assembly.sweep;
    const Angle at = Angle::degrees(sweep.from_deg + share * (sweep.to_deg - sweep.from_deg));
    if (!place(assembly, at, frames)) frames.clear();
    return frames;
}

bool leave_to_their_sides(const Assembly& assembly, std::span<const PlateShape> shapes,
                          const TouchingPlates& touching) {
    const std::vector<PlateFrames> poses = frames_at_all(assembly, kBegun);
    return std::all_of(touching.begin(), touching.end(), [&](const auto& known) {
        const auto& [pair, one] = known;
        return one.side == 0 || first_side(shapes, poses, pair, one) != -one.side;
    });
}

TouchingPlates touching_at_end(const Assembly& assembly, std::span<const PlateShape> shapes,
                               const TouchingPlates& touching) {
    TouchingPlates there = touching_plates(assembly, shapes, frames_at(assembly, 1.0));
    const std::vector<PlateFrames> before = frames_at_all(assembly, kNearlyOver);
    const std::vector<PlateFrames> on_the_way = frames_at_all(assembly, kOnTheWay);
    for (auto& [pair, one] : there) {
        const auto known = touching.find(pair);
        const bool stays = known != touching.end() && lie_on(on_the_way, pair, known->second);
        one.side = stays ? known->second.side : first_side(shapes, before, pair, one);
        one.wished = stays && known->second.wished;
    }
    return there;
}

void wish_sides(const Assembly& assembly, std::span<const Frame> frames, TouchingPlates& touching) {
    const Vec3 middle = middle_of_paper(assembly, frames);
    for (auto& [pair, one] : touching) {
        const auto [a, b] = pair;
        const double of_a = area(nth(assembly.plates, a).outline);
        const double of_b = area(nth(assembly.plates, b).outline);
        if (std::min(of_a, of_b) > kMuchSmaller * std::max(of_a, of_b)) continue;
        const bool a_is_larger = of_a > of_b;
        const int larger = a_is_larger ? a : b;
        const Frame& ground = nth(frames, larger);
        const double inner = dot(middle - ground.origin, ground.normal());
        if (std::abs(inner) < kInnerMm) continue;
        // Of the larger one's front, on which the smaller is.
        int side = inner > 0.0 ? 1 : -1;
        if (is_lining_of_what_lies_under(assembly, touching, larger, a_is_larger ? b : a)) side = -side;
        const bool same = dot(nth(frames, a).normal(), nth(frames, b).normal()) > 0.0;
        one.side = a_is_larger || !same ? side : -side;
        one.wished = true;
    }
}

}  // namespace popup
