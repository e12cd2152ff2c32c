#include "motion/joints/four_bar.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "motion/joints/joint.h"

namespace popup {
namespace {

// Below this a negative discriminant is rounding; beyond it the linkage is stuck.
constexpr double kStuck = 1e-9;

// What an angled bar contributes: cosines and sines of near (a) and far (g), without trigonometry.
struct BarAngles {
    double cos_near, sin_near, cos_far, sin_far;
};
BarAngles angles(const Bar& bar) {
    return {dot(bar.seam_dir, bar.fold_dir), dot(bar.seam_dir, bar.fold_out),
            dot(bar.own_seam, bar.own_centre), std::abs(cross(bar.own_seam, bar.own_centre))};
}

std::optional<Vec3> angled_centre(const FourBar& bars, const FoldFrame& fold) {
    const BarAngles l = angles(bars.left);
    const BarAngles r = angles(bars.right);
    const double e = bars.closing == Closing::outside ? -1.0 : 1.0;
    const double c = e * fold.c;  // ≥ 0 on the whole way
    const double s = fold.s;
    const double cos_sigma = l.cos_near * l.cos_far - e * l.sin_near * l.sin_far;
    const double sin_sigma = e * l.sin_near * l.cos_far + l.cos_near * l.sin_far;
    const double cot_l = e * l.cos_near / l.sin_near;
    const double cot_r = e * r.cos_near / r.sin_near;
    const double k1 = 0.5 * (cot_l - cot_r);
    const double k2 = 0.5 * (cot_l + cot_r);
    const double near = l.sin_near * r.sin_near;
    const double room = (l.sin_far * r.sin_far - near) / near + c * c;
    if (room < -kStuck) return std::nullopt;
    const double root = std::sqrt(std::max(room, 0.0));
    // Nought over nought only where the piece is straight (σ = 180°) on the open card: it lies along the
    // fold.
    const double below = k2 * sin_sigma - c * c * cos_sigma + fold.c * root;
    const double v = below == 0.0 ? 0.0 : sin_sigma * sin_sigma / below;
    const double x = cos_sigma + s * s * v;
    const double z = e * k1 * s * v;
    double y = 0.0;
    if (c >= 0.5) {
        y = (sin_sigma - k2 * s * s * v) / c;
    } else {
        const double divisor = (c * c + k2 * k2) * s * s + k1 * k1 * c * c;
        y = (c * (sin_sigma * (s * s + k1 * k1) + k2 * s * s * cos_sigma) + e * k2 * s * s * root) / divisor;
    }
    return x * fold.along + y * fold.bisector + z * fold.across;
}

// (bisector, across) of the centre fold, from the parent fold's point.
std::optional<Vec2> parallel_centre(const FourBar& bars, const FoldFrame& fold) {
    const double e = bars.closing == Closing::outside ? -1.0 : 1.0;
    const double c = e * fold.c;
    const double s = fold.s;
    const double p = e * bars.left.near;
    const double q = e * bars.right.near;
    const double sigma = 0.5 * (p + bars.left.far + q + bars.right.far);
    const double size = std::abs(p) + std::abs(q);
    if (std::abs(sigma) < 1e-12 * size) return Vec2{0.0, 0.0};  // the piece lies on its planes
    const double k1 = 0.5 * (1.0 / p - 1.0 / q);
    const double k2 = 0.5 * (1.0 / p + 1.0 / q);
    const double room = (bars.left.far * bars.right.far - p * q) / (p * q) + c * c;
    if (room < -kStuck) return std::nullopt;
    const double root = std::sqrt(std::max(room, 0.0));
    const double v = sigma * sigma / (c * c - sigma * k2 - fold.c * root);
    const double z = -e * k1 * s * v;
    double y = 0.0;
    if (c >= 0.5) {
        y = (sigma + k2 * s * s * v) / c;
    } else {
        const double divisor = k2 * k2 * s * s + k1 * k1 * c * c;
        y = (c * (sigma * k1 * k1 + k2 * s * s) + e * k2 * s * s * root) / divisor;
    }
    return Vec2{y, z};
}

}  // namespace

Frame plate_frame(const Bar& bar, Vec3 seam, Vec3 centre, Vec3 at) {
    const Vec3 e1 = unit(seam);
    const Vec3 e2 = unit(centre - dot(centre, e1) * e1);
    const Vec3 e3 = cross(e1, e2);
    const Vec2 f1 = bar.own_seam;
    const double side = cross(f1, bar.own_centre) < 0.0 ? -1.0 : 1.0;
    const Vec2 f2 = side * left_of(f1);
    Frame frame;
    frame.axes = {f1.x * e1 + f2.x * e2, f1.y * e1 + f2.y * e2, side * e3};
    frame.origin = at - frame.direction(bar.own_at);
    return frame;
}

std::optional<PlatePair> solve(const FourBar& bars, const Frame& left, const Frame& right) {
    const Bar& l = bars.left;
    const Bar& r = bars.right;
    const Vec3 seam_l = left.direction(l.seam_dir);
    const Vec3 seam_r = right.direction(r.seam_dir);
    Vec3 centre_l;
    Vec3 centre_r;
    switch (bars.closing) {
        case Closing::half_turn:
            if (bars.parallel) {
                // A parallelogram: each side is parallel to the opposite plane.
                centre_l = right.direction(r.fold_out);
                centre_r = left.direction(l.fold_out);
            } else {
                const Vec3 middle = seam_l + seam_r;
                const Vec3 along = left.direction(l.fold_dir);
                centre_l = centre_r = (2.0 * dot(along, middle) / dot(middle, middle)) * middle - along;
            }
            break;
        case Closing::inside:
        case Closing::outside: {
            const FoldFrame fold = fold_frame({left, l.fold_dir, l.fold_out}, {right, r.fold_dir, r.fold_out},
                                              bars.closing == Closing::outside);
            if (bars.parallel) {
                const auto centre = parallel_centre(bars, fold);
                if (!centre) return std::nullopt;
                const auto from = [&](double near, double sign) {
                    return (centre->x - fold.c * near) * fold.bisector +
                           (centre->y - sign * fold.s * near) * fold.across;
                };
                centre_l = from(l.near, -1.0);
                centre_r = from(r.near, 1.0);
            } else {
                const auto centre = angled_centre(bars, fold);
                if (!centre) return std::nullopt;
                centre_l = centre_r = *centre;
            }
            break;
        }
    }
    return PlatePair{plate_frame(l, seam_l, centre_l, left.point(l.seam_at)),
                     plate_frame(r, seam_r, centre_r, right.point(r.seam_at))};
}

JointPlates plates_of(const FourBar& how) {
    JointPlates result;
    for (const Bar* bar : {&how.left, &how.right}) {
        result.places.push_back({bar->plate, bar->drive, bar->own_at, Lying::free});
        result.needs.push_back(bar->drive);
    }
    return result;
}

// A cycle of four turns: about the parent fold, the left seam, the centre fold and the right seam. The rates
// of the four are angular velocities that add up to nought, so one of them vanishes only when the axes of the
// other three lie in one plane, which is when the turn opposite passes 0° or 180°.
JointTurns turns_of(const FourBar& how) {
    enum { kLeftSeam, kRightSeam, kCentre };
    const Bar& l = how.left;
    const Bar& r = how.right;
    JointTurns result;
    result.stands_on = {l.drive, r.drive};
    const std::array<int, 2> beside{JointTurn::kParent, kCentre};
    result.turns.push_back({l.plate, l.drive, l.own_at, l.own_seam, kRightSeam, beside});
    result.turns.push_back({r.plate, r.drive, r.own_at, r.own_seam, kLeftSeam, beside});
    JointTurn centre{l.plate, r.plate, l.own_at, l.own_centre, JointTurn::kParent, {kLeftSeam, kRightSeam}};
    if (how.parallel) {
        centre.at = l.own_at + l.far * l.own_centre;
        centre.dir = l.own_seam;
    }
    result.turns.push_back(centre);
    result.ways = {{kLeftSeam, kCentre}, {kRightSeam, kCentre}};
    return result;
}

bool place_plates(const FourBar& how, Angle /*theta*/, std::span<Frame> frames) {
    const auto pair = solve(how, frames[static_cast<std::size_t>(how.left.drive)],
                            frames[static_cast<std::size_t>(how.right.drive)]);
    if (!pair) return false;
    frames[static_cast<std::size_t>(how.left.plate)] = pair->left;
    frames[static_cast<std::size_t>(how.right.plate)] = pair->right;
    return true;
}

// What drives them, how, and from where on the fold. Where a parallel linkage stands along its fold makes no
// difference.
Likeness likeness(const FourBar& how) {
    const Bar& l = how.left;
    const Bar& r = how.right;
    const Vec2 at = how.parallel ? Vec2{} : l.fold_at;
    return {static_cast<long long>(how.closing) * 2 + (how.parallel ? 1 : 0),
            l.drive,
            r.drive,
            to_compare(l.near),
            to_compare(l.far),
            to_compare(r.near),
            to_compare(r.far),
            to_compare(at.x),
            to_compare(at.y),
            how.parallel ? 0 : to_compare(std::atan2(l.fold_dir.y, l.fold_dir.x))};
}

std::optional<Slid> slid(const FourBar& how, double mm) {
    FourBar moved = how;
    for (Bar* bar : {&moved.left, &moved.right}) {
        bar->fold_at = bar->fold_at + mm * bar->fold_dir;
        bar->seam_at = bar->seam_at + mm * bar->fold_dir;
    }
    const Vec2 by = mm * how.left.fold_dir;
    return Slid{moved, by, "fold"};
}

std::optional<Parallelism> parallelism(const FourBar& /*how*/) { return std::nullopt; }

namespace {

double in_degrees(double radians) { return radians * 180.0 / std::numbers::pi; }
double angle_between(Vec2 a, Vec2 b) { return std::abs(std::atan2(cross(a, b), dot(a, b))); }

std::optional<std::string> fault_of(const Bar& bar, bool parallel) {
    for (const auto& [name, direction] :
         {std::pair("fold_dir", bar.fold_dir), std::pair("fold_out", bar.fold_out),
          std::pair("seam_dir", bar.seam_dir), std::pair("own_seam", bar.own_seam),
          std::pair("own_centre", bar.own_centre)}) {
        if (!is_unit(direction)) return fmt::format("{} is no unit vector", name);
    }
    if (!are_square(bar.fold_dir, bar.fold_out)) return "fold_out is not square to fold_dir";
    if (!(bar.near > 0.0)) return "its near side is not more than 0";
    if (!(bar.far > 0.0)) return "its far side is not more than 0";
    if (!parallel) {
        if (!same_length(distance(bar.seam_at, bar.fold_at), 0.0)) return "seam_at is not the apex, fold_at";
        const double near = std::atan2(dot(bar.seam_dir, bar.fold_out), dot(bar.seam_dir, bar.fold_dir));
        if (!same_angle(near, bar.near))
            return fmt::format("near_deg is {:.7f}, but fold_dir and seam_dir make {:.7f}",
                               in_degrees(bar.near), in_degrees(near));
        const double far = angle_between(bar.own_seam, bar.own_centre);
        if (!same_angle(far, bar.far))
            return fmt::format("far_deg is {:.7f}, but own_seam and own_centre make {:.7f}",
                               in_degrees(bar.far), in_degrees(far));
        // Flat, or folded onto itself: it has no turn of its own.
        if (same_angle(std::sin(near), 0.0) || same_angle(std::sin(far), 0.0))
            return "its lines lie on one another";
        return std::nullopt;
    }
    if (!same_length(distance(bar.seam_dir, bar.fold_dir), 0.0)) return "seam_dir is not fold_dir";
    if (!are_square(bar.own_seam, bar.own_centre)) return "own_centre is not square to own_seam";
    const double near = dot(bar.seam_at - bar.fold_at, bar.fold_out);
    if (!same_length(near, bar.near))
        return fmt::format("near_mm is {:.6f}, but the seam is {:.6f} from the fold", bar.near, near);
    return std::nullopt;
}

}  // namespace

// It folds flat as it says: motion/joints/four_bar.h.
std::optional<std::string> fault_of(const FourBar& how) {
    const Bar& l = how.left;
    const Bar& r = how.right;
    if (l.drive == r.drive || l.plate == r.plate) return "its left and its right side are one plate";
    for (const auto& [side, bar] : {std::pair("left", &l), std::pair("right", &r)}) {
        if (const auto fault = fault_of(*bar, how.parallel)) return fmt::format("{}: {}", side, *fault);
    }
    const double sign = how.closing == Closing::outside ? -1.0 : 1.0;
    const bool half_turn = how.closing == Closing::half_turn;
    const double a = half_turn ? l.near - r.far : l.near + sign * l.far;
    const double b = half_turn ? l.far - r.near : r.near + sign * r.far;
    const double off = half_turn ? std::max(std::abs(a), std::abs(b)) : std::abs(a - b);
    if (how.parallel ? same_length(off, 0.0) : same_angle(off, 0.0)) return std::nullopt;
    return fmt::format("it does not fold flat: its sides differ by {:.6f}{}",
                       how.parallel ? off : in_degrees(off), how.parallel ? " mm" : "°");
}

}  // namespace popup
