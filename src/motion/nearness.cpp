#include "motion/nearness.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/geometry/near_boxes.h"

namespace popup {
namespace {

// A triangle whose corners stray so unequally is looked at in quarters: near a common apex everything is
// near, but nothing moves far.
constexpr double kUneven = 0.6;
constexpr int kMostQuarterings = 12;
constexpr double kParallel = 1e-12;  // sine of the angle between lines of one direction

Triangle3 lifted(const Triangle2& t) {
    return {Vec3{t[0].x, t[0].y, 0}, {t[1].x, t[1].y, 0}, {t[2].x, t[2].y, 0}};
}

Triangle3 placed(const Triangle2& t, const Frame& frame) {
    return {frame.point(t[0]), frame.point(t[1]), frame.point(t[2])};
}

// Whether what lies between two heights over a plane lies on one side of it.
Sides side_from(double lowest, double highest) {
    const double less = std::min(-lowest, highest);
    return less <= kRoundingMm ? Sides::one : less <= kFirmMm ? Sides::one_nearly : Sides::both;
}

double level_length(Vec3 v) { return std::sqrt(v.x * v.x + v.y * v.y); }

// Whether the first lies further than `distance` beyond an edge of the second, both seen from above.
bool beyond_an_edge(const Triangle3& first, const Triangle3& second, double distance) {
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 from = second.at(i);
        const Vec3 along = second.at((i + 1) % 3) - from;
        const auto off = [&](Vec3 p) { return along.x * (p.y - from.y) - along.y * (p.x - from.x); };
        // The side on which the third corner is not.
        const double inside = off(second.at((i + 2) % 3));
        const double sign = inside > 0.0 ? -1.0 : 1.0;
        const double least = std::min({sign * off(first[0]), sign * off(first[1]), sign * off(first[2])});
        if (least > 0.0 && least * least > distance * distance * (along.x * along.x + along.y * along.y))
            return true;
    }
    return false;
}

// True only if they are further apart than `distance`, seen from above.
bool level_apart(const Triangle3& a, const Triangle3& b, double distance) {
    return beyond_an_edge(a, b, distance) || beyond_an_edge(b, a, distance);
}

}  // namespace

double Moves::turns() const {
    double sum = 0.0;
    for (const Arm& arm : arms) sum += arm.turn;
    return drift ? std::min(sum, drift->turns()) : sum;
}

double stray(Vec3 point, const Moves& moves) {
    double moved = 0.0;
    for (const Arm& arm : moves.arms) moved += arm.turn * (length(cross(point - arm.at, arm.dir)) + moved);
    return moves.drift ? std::min(moved, moves.drift->of(point)) : moved;
}

double stray(const Triangle3& triangle, const Moves& moves) {
    return std::max({stray(triangle[0], moves), stray(triangle[1], moves), stray(triangle[2], moves)});
}

// A turn by t about a line of direction u moves what is at w from the line by sin t (u × w), and by at most
// t² / 2 times its distance from the line besides.
double level_stray(Vec3 point, const Moves& moves) {
    double moved = 0.0;  // whichever way
    double level = 0.0;
    for (const Arm& arm : moves.arms) {
        const Vec3 from_line = point - arm.at;
        const double away = length(cross(from_line, arm.dir)) + moved;
        const double along = level_length(arm.dir) * (std::abs(from_line.z) + moved) +
                             std::abs(arm.dir.z) * (level_length(from_line) + level);
        level += arm.turn * (along + 0.5 * arm.turn * away);
        moved += arm.turn * away;
    }
    return level;
}

double level_stray(const Triangle3& triangle, const Moves& moves) {
    return std::max(
        {level_stray(triangle[0], moves), level_stray(triangle[1], moves), level_stray(triangle[2], moves)});
}

Vec3 direction_in_frame(const Frame& frame, Vec3 d) {
    return {dot(frame.axes[0], d), dot(frame.axes[1], d), dot(frame.axes[2], d)};
}

Vec3 in_frame(const Frame& frame, Vec3 point) { return direction_in_frame(frame, point - frame.origin); }

Frame relative(const Frame& a, const Frame& b) {
    Frame result;
    for (std::size_t i = 0; i < 3; ++i) result.axes.at(i) = direction_in_frame(a, b.axes.at(i));
    result.origin = in_frame(a, b.origin);
    return result;
}

// Plates that only turn about lines of one direction do not move along it: true when they do not lie beside
// each other there, but for what touches.
bool apart_along_arms(const PairPose& pose) {
    const std::span<const Arm> arms = pose.from_b.arms;
    if (arms.empty()) return false;
    const Vec3 way = arms[0].dir;
    for (const Arm& arm : arms) {
        if (length(cross(arm.dir, way)) > kParallel) return false;
    }
    double a_least = HUGE_VAL;
    double a_most = -HUGE_VAL;
    double b_least = HUGE_VAL;
    double b_most = -HUGE_VAL;
    for (const Vec2 p : pose.a->hull) {
        const double along = p.x * way.x + p.y * way.y;
        a_least = std::min(a_least, along);
        a_most = std::max(a_most, along);
    }
    for (const Vec2 p : pose.b->hull) {
        const double along = dot(pose.b_in_a.point(p), way);
        b_least = std::min(b_least, along);
        b_most = std::max(b_most, along);
    }
    return std::min(a_most, b_most) - std::max(a_least, b_least) <= kTouchMm;
}

Sides sides_of(const PairPose& pose) {
    if (apart_along_arms(pose)) return Sides::one;
    const Ring& of_b = pose.b->hull;
    double lowest = 0.0;
    double highest = 0.0;
    Box reached;
    for (const Vec2 corner : of_b) {
        const Vec3 p = pose.b_in_a.point(corner);
        const double reach = stray(p, pose.from_b);
        lowest = std::min(lowest, p.z - reach);
        highest = std::max(highest, p.z + reach);
        reached.extend({p.x - reach, p.y - reach});
        reached.extend({p.x + reach, p.y + reach});
    }
    if (!touch(reached, pose.a->box)) return Sides::one;
    const Sides b = side_from(lowest, highest);
    if (b == Sides::one) return b;
    const Ring& of_a = pose.a->hull;
    const Vec3 normal = pose.b_in_a.normal();
    lowest = 0.0;
    highest = 0.0;
    for (std::size_t i = 0; i < of_a.size() && (lowest >= -kFirmMm || highest <= kFirmMm); ++i) {
        const Vec3 p{of_a[i].x, of_a[i].y, 0.0};
        const double height = dot(p - pose.b_in_a.origin, normal);
        const double reach = stray(p, pose.from_a);
        lowest = std::min(lowest, height - reach);
        highest = std::max(highest, height + reach);
    }
    return std::max(b, side_from(lowest, highest));
}

bool NearnessTest::cleared(const Triangle3& fixed, const Triangle3& moving, const Moves& moves,
                           double distance_mm, Found& found) {
    const Vec3 square = cross(fixed[1] - fixed[0], fixed[2] - fixed[0]);
    const double size = length(square);
    pieces_.clear();
    pieces_.push_back(
        {moving, {stray(moving[0], moves), stray(moving[1], moves), stray(moving[2], moves)}, 0});
    while (!pieces_.empty()) {
        const Piece piece = pieces_.back();
        pieces_.pop_back();
        double most = 0.0;
        double least = std::numeric_limits<double>::infinity();
        // How far the piece stays from the plane of the fixed triangle, in front of it and behind. Wherever
        // the piece moves, its points are as high over that plane as something between its corners. Without
        // this test, plates that nearly touch along an edge are quartered along the whole edge.
        double before = std::numeric_limits<double>::infinity();
        double behind = before;
        for (std::size_t i = 0; i < 3; ++i) {
            const double s = piece.strays.at(i);
            most = std::max(most, s);
            least = std::min(least, s);
            const double height = dot(square, piece.corners.at(i) - fixed[0]);
            before = std::min(before, height - s * size);
            behind = std::min(behind, -height - s * size);
        }
        if (std::max(before, behind) > distance_mm * size) continue;
        // The whole triangle has been looked at so.
        if (piece.level > 0 &&
            level_apart(fixed, piece.corners, distance_mm + level_stray(piece.corners, moves) + kRoundingMm))
            continue;
        if (piece.level > 0 && surely_apart(fixed, piece.corners, distance_mm + most)) continue;
        const ClosestPoints closest = closest_points(fixed, piece.corners);
        if (closest.distance > distance_mm + most) continue;
        found.least_mm = std::min(found.least_mm, closest.distance);
        if (distance_mm > 0.0 ? closest.distance + most < distance_mm : closest.distance == 0.0) {
            found.nearness = Nearness::within;
            return false;
        }
        if (least > kUneven * most || piece.level == kMostQuarterings) {
            found.nearness = Nearness::unknown;
            return false;
        }
        const auto& [p, q, r] = piece.corners;
        const Vec3 pq = 0.5 * (p + q);
        const Vec3 qr = 0.5 * (q + r);
        const Vec3 rp = 0.5 * (r + p);
        // Each corner of a quarter is one of three others, too.
        const auto& [of_p, of_q, of_r] = piece.strays;
        const double of_pq = stray(pq, moves);
        const double of_qr = stray(qr, moves);
        const double of_rp = stray(rp, moves);
        const int level = piece.level + 1;
        pieces_.push_back({{p, pq, rp}, {of_p, of_pq, of_rp}, level});
        pieces_.push_back({{pq, q, qr}, {of_pq, of_q, of_qr}, level});
        pieces_.push_back({{rp, qr, r}, {of_rp, of_qr, of_r}, level});
        pieces_.push_back({{pq, qr, rp}, {of_pq, of_qr, of_rp}, level});
    }
    return true;
}

// Calls `use(triangle of the plate with fewer, triangle of the other, whether that plate is a)` for triangles
// whose boxes come within `margin(triangle)` of each other, until it gives false; the number of the former
// then, else 0. Begins with the triangle of that number.
template <typename Margin, typename Use>
std::size_t NearnessTest::each_near(const PairPose& pose, bool whole, const Margin& margin, const Use& use,
                                    std::size_t first) {
    const Patches& a = whole ? pose.a->whole : pose.a->core;
    const Patches& b = whole ? pose.b->whole : pose.b->core;
    const bool few_is_a = b.all().size() > a.all().size();
    const Patches& few = few_is_a ? a : b;
    const Patches& many = few_is_a ? b : a;
    const std::vector<Triangle2>& all = few.all();
    for (std::size_t i = 0; i < all.size(); ++i) {
        const std::size_t at = (first + i) % all.size();
        const Triangle2& flat = all[at];
        const Triangle3 triangle = few_is_a ? lifted(flat) : placed(flat, pose.b_in_a);
        const double reach = margin(triangle, few_is_a);
        Box box;
        double low = std::numeric_limits<double>::infinity();
        double high = -low;
        for (const Vec3 p : triangle) {
            const Vec3 local = few_is_a ? in_frame(pose.b_in_a, p) : p;
            box.extend({local.x, local.y});
            low = std::min(low, local.z);
            high = std::max(high, local.z);
        }
        if (low > reach || high < -reach) continue;
        box.min = box.min - Vec2{reach, reach};
        box.max = box.max + Vec2{reach, reach};
        many.query(box, near_);
        for (const int number : near_) {
            const Triangle2& other = many.all()[static_cast<std::size_t>(number)];
            if (!use(triangle, few_is_a ? placed(other, pose.b_in_a) : lifted(other), few_is_a)) return at;
        }
    }
    return 0;
}

// Begins with the triangle of that number, and sets it to the one at which it ended: the first that is not
// clear, or, `to_the_end`, the first that is within the distance.
Found NearnessTest::look(const PairPose& pose, double distance_mm, bool whole, bool to_the_end,
                         std::size_t& first) {
    Found found;
    double reach = 0.0;  // of the moving triangle that is looked at, and the distance
    double level = 0.0;
    first = each_near(
        pose, whole,
        [&](const Triangle3& moving, bool moving_is_a) {
            const Moves& moves = moving_is_a ? pose.from_a : pose.from_b;
            reach = stray(moving, moves) + distance_mm;
            level = level_stray(moving, moves) + distance_mm + kRoundingMm;
            return reach;
        },
        [&](const Triangle3& moving, const Triangle3& fixed, bool moving_is_a) {
            // Most are; cleared() relies on it.
            if (level_apart(fixed, moving, level) || surely_apart(fixed, moving, reach)) return true;
            Found here;
            if (cleared(fixed, moving, moving_is_a ? pose.from_a : pose.from_b, distance_mm, here))
                return true;
            if (found.nearness == Nearness::clear || here.nearness == Nearness::within ||
                here.least_mm < found.least_mm) {
                found = here;
            }
            return to_the_end && found.nearness != Nearness::within;
        },
        first);
    return found;
}

bool NearnessTest::clear(const PairPose& pose) {
    return look(pose, 0.0, false, false, not_cleared_).nearness == Nearness::clear;
}

Found NearnessTest::operator()(const PairPose& pose, double distance_mm, bool whole) {
    std::size_t first = 0;
    return look(pose, distance_mm, whole, true, first);
}

double NearnessTest::stray_of_near(const PairPose& pose) {
    double most = 0.0;
    const auto of = [&](const Triangle3& moving, bool moving_is_a) {
        return stray(moving, moving_is_a ? pose.from_a : pose.from_b);
    };
    each_near(pose, false, of, [&](const Triangle3& moving, const Triangle3&, bool moving_is_a) {
        most = std::max(most, of(moving, moving_is_a));
        return true;
    });
    return most;
}

ClosestPoints NearnessTest::least(const PairPose& pose, double limit_mm) {
    ClosestPoints found{limit_mm, {}, {}};
    each_near(
        pose, true, [&](const Triangle3&, bool) { return found.distance; },
        [&](const Triangle3& moving, const Triangle3& fixed, bool moving_is_a) {
            const ClosestPoints closest =
                moving_is_a ? closest_points(moving, fixed) : closest_points(fixed, moving);
            if (closest.distance < found.distance) found = closest;
            return true;
        });
    return found;
}

}  // namespace popup
