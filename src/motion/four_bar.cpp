#include "motion/four_bar.h"

#include <cmath>

#include "popup/units.h"

namespace popup {
namespace {

// Below this a negative discriminant is rounding; beyond it the linkage is stuck.
constexpr double kStuck = 1e-9;

struct HalfAngle {
    double c, s;
};

// Cosine and sine of half an angle in degrees; exact at 0°, 90°, 180° and 360°.
HalfAngle half_angle(double deg) {
    if (deg == 0.0) return {1.0, 0.0};
    if (deg == 180.0) return {0.0, 1.0};
    if (deg == 90.0) return {std::sqrt(0.5), std::sqrt(0.5)};
    const double half = 0.5 * Angle::degrees(deg).rad();
    return {std::cos(half), std::sin(half)};
}

// What an angled bar contributes: cosines and sines of near (a) and far (g), without trigonometry.
struct BarAngles {
    double cos_near, sin_near, cos_far, sin_far;
};
BarAngles angles(const Bar& bar) {
    return {dot(bar.seam_dir, bar.fold_dir), dot(bar.seam_dir, bar.fold_out),
            dot(bar.own_seam, bar.own_centre), std::abs(cross(bar.own_seam, bar.own_centre))};
}

std::optional<Vec3> angled_centre(const Joint& joint, const FoldFrame& fold) {
    const BarAngles l = angles(joint.left);
    const BarAngles r = angles(joint.right);
    const double e = joint.kind == JointKind::outside ? -1.0 : 1.0;
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
std::optional<Vec2> parallel_centre(const Joint& joint, const FoldFrame& fold) {
    const double e = joint.kind == JointKind::outside ? -1.0 : 1.0;
    const double c = e * fold.c;
    const double s = fold.s;
    const double p = e * joint.left.near;
    const double q = e * joint.right.near;
    const double sigma = 0.5 * (p + joint.left.far + q + joint.right.far);
    const double size = std::abs(p) + std::abs(q);
    if (std::abs(sigma) < 1e-12 * size) return Vec2{0.0, 0.0};  // the piece lies on its planes
    const double k1 = 0.5 * (1.0 / p - 1.0 / q);
    const double k2 = 0.5 * (1.0 / p + 1.0 / q);
    const double room = (joint.left.far * joint.right.far - p * q) / (p * q) + c * c;
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

FoldFrame fold_frame(const Joint& joint, const Frame& left, const Frame& right) {
    const Vec3 out_l = left.direction(joint.left.fold_out);
    const Vec3 out_r = right.direction(joint.right.fold_out);
    const Vec3 normals = left.normal() + right.normal();
    const Vec3 outs = out_l + out_r;
    FoldFrame fold;
    fold.along = left.direction(joint.left.fold_dir);
    fold.s = 0.5 * length(out_r - out_l);
    // Near 0° and 360° the normals' sum vanishes: there the kind of closing says which of the two it is.
    if (fold.s > 0.5) {
        fold.c = 0.5 * dot(outs, unit(normals));
    } else {
        fold.c = 0.5 * length(outs) * (joint.kind == JointKind::outside ? -1.0 : 1.0);
    }
    fold.bisector = 0.5 * (fold.s * normals + fold.c * outs);
    fold.across = 0.5 * (fold.s * (out_r - out_l) + fold.c * (left.normal() - right.normal()));
    return fold;
}

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

std::optional<PlatePair> solve(const Joint& joint, const Frame& left, const Frame& right) {
    const Bar& l = joint.left;
    const Bar& r = joint.right;
    const Vec3 seam_l = left.direction(l.seam_dir);
    const Vec3 seam_r = right.direction(r.seam_dir);
    Vec3 centre_l;
    Vec3 centre_r;
    switch (joint.kind) {
        case JointKind::drive:
            return std::nullopt;
        case JointKind::half_turn:
            if (joint.parallel) {
                // A parallelogram: each side is parallel to the opposite plane.
                centre_l = right.direction(r.fold_out);
                centre_r = left.direction(l.fold_out);
            } else {
                const Vec3 middle = seam_l + seam_r;
                const Vec3 along = left.direction(l.fold_dir);
                centre_l = centre_r = (2.0 * dot(along, middle) / dot(middle, middle)) * middle - along;
            }
            break;
        case JointKind::inside:
        case JointKind::outside: {
            const FoldFrame fold = fold_frame(joint, left, right);
            if (joint.parallel) {
                const auto centre = parallel_centre(joint, fold);
                if (!centre) return std::nullopt;
                const auto from = [&](double near, double sign) {
                    return (centre->x - fold.c * near) * fold.bisector +
                           (centre->y - sign * fold.s * near) * fold.across;
                };
                centre_l = from(l.near, -1.0);
                centre_r = from(r.near, 1.0);
            } else {
                const auto centre = angled_centre(joint, fold);
                if (!centre) return std::nullopt;
                centre_l = centre_r = *centre;
            }
            break;
        }
    }
    return PlatePair{plate_frame(l, seam_l, centre_l, left.point(l.seam_at)),
                     plate_frame(r, seam_r, centre_r, right.point(r.seam_at))};
}

Frame drive_frame(const Bar& bar, double theta_deg) {
    const HalfAngle half = half_angle(theta_deg);
    const Vec2 across = right_of(bar.fold_dir);
    const double turn = bar.near;
    // The page's across axis goes to (s, ±c) in (across, up), its front to (∓c, s).
    const Vec3 across_to{half.s * across.x, half.s * across.y, turn * half.c};
    const Vec3 front_to{-turn * half.c * across.x, -turn * half.c * across.y, half.s};
    const Vec3 along{bar.fold_dir.x, bar.fold_dir.y, 0.0};
    Frame frame;
    frame.axes = {across.x * across_to + bar.fold_dir.x * along,
                  across.y * across_to + bar.fold_dir.y * along, front_to};
    frame.origin = Vec3{bar.fold_at.x, bar.fold_at.y, 0.0} - frame.direction(bar.fold_at);
    return frame;
}

}  // namespace popup
