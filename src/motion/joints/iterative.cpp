// Hendrix's iterative placement (thesis, figure 5.16): a point with three known distances to three known
// points is moved to and fro until the worst of them fits.
//
// Kept as the baseline of the benchmark and as a check of the closed form that shares nothing with it but the
// input. What is no four-bar is placed as its own kind says.
#include <array>
#include <cmath>

#include "motion/joints/four_bar.h"
#include "motion/joints/joint.h"
#include "popup/motion.h"

namespace popup {
namespace {

struct Anchors {
    std::array<Vec3, 3> at;
    std::array<double, 3> distance;
};

Vec3 approach(Vec3 point, const Anchors& anchors, int repeats, double precision) {
    for (int n = 0; n < repeats; ++n) {
        std::size_t worst = 0;
        double off_worst = -1.0;
        std::array<double, 3> now{};
        for (std::size_t i = 0; i < 3; ++i) {
            now[i] = distance(point, anchors.at[i]);
            const double off = std::abs(now[i] - anchors.distance[i]);
            if (off > off_worst) {
                off_worst = off;
                worst = i;
            }
        }
        if (off_worst <= precision) return point;
        if (now[worst] < 1e-12)
            point.z += anchors.distance[worst];  // on the anchor: any way out will do
        else
            point = anchors.at[worst] + (anchors.distance[worst] / now[worst]) * (point - anchors.at[worst]);
    }
    return point;
}

constexpr double kArm = 50.0;  // mm: how far along fold and seams the anchors of an angled linkage lie

}  // namespace

IterativePlacer::IterativePlacer(const Assembly& assembly, int repeats, double precision)
    : assembly_(&assembly), repeats_(repeats), precision_(precision), centres_(assembly.joints.size()) {}

void IterativePlacer::place(Angle theta, std::span<Frame> frames) {
    for (std::size_t i = 0; i < assembly_->joints.size(); ++i) {
        const Joint& joint = assembly_->joints[i];
        const auto* bars = std::get_if<FourBar>(&joint.how);
        if (bars == nullptr) {
            place_plates(joint, theta, frames);
            continue;
        }
        const Bar& l = bars->left;
        const Bar& r = bars->right;
        const Frame& left = frames[static_cast<std::size_t>(l.drive)];
        const Frame& right = frames[static_cast<std::size_t>(r.drive)];
        const Vec3 fold = left.point(l.fold_at);
        const Vec3 along = left.direction(l.fold_dir);
        // The heuristic guess: straight out of the fold, as far as the element reaches when the card is
        // closed. Cut elements stand where their planes lean, glued ones in front.
        const Vec3 lean = left.direction(l.fold_out) + right.direction(r.fold_out);
        Vec3 front = left.normal() + right.normal();
        if (bars->closing == Closing::half_turn ? length(lean) > 1e-6 : length(front) < 1e-6) {
            front = (bars->closing == Closing::outside ? -1.0 : 1.0) * lean;
        }
        front = unit(front);
        const double reach = bars->closing == Closing::outside ? l.far - l.near : l.far + l.near;
        auto& centres = centres_[i];
        Vec3 seam_l;
        Vec3 seam_r;
        Vec3 to_l;
        Vec3 to_r;
        if (bars->parallel) {
            // Two points of the centre fold, one arm apart, each from its own seam points and the other
            // end's.
            const Vec3 at_l = fold + l.near * left.direction(l.fold_out);
            const Vec3 at_r = fold + r.near * right.direction(r.fold_out);
            if (!started_) centres = {fold + reach * front, fold + reach * front + kArm * along};
            const double diagonal = std::hypot(l.far, kArm);
            centres[0] = approach(centres[0], {{at_l, at_r, at_l + kArm * along}, {l.far, r.far, diagonal}},
                                  repeats_, precision_);
            centres[1] = approach(
                centres[1], {{at_l + kArm * along, at_r + kArm * along, at_l}, {l.far, r.far, diagonal}},
                repeats_, precision_);
            seam_l = left.direction(l.seam_dir);
            seam_r = right.direction(r.seam_dir);
            to_l = centres[0] - at_l;
            to_r = centres[0] - at_r;
        } else {
            // One point of the centre fold, from the apex and one point of either seam.
            seam_l = left.direction(l.seam_dir);
            seam_r = right.direction(r.seam_dir);
            const auto chord = [](double angle) { return 2.0 * kArm * std::sin(0.5 * angle); };
            if (!started_) centres[0] = fold + kArm * (std::sin(reach) * front + std::cos(reach) * along);
            centres[0] = approach(
                centres[0],
                {{fold, fold + kArm * seam_l, fold + kArm * seam_r}, {kArm, chord(l.far), chord(r.far)}},
                repeats_, precision_);
            to_l = to_r = centres[0] - fold;
        }
        frames[static_cast<std::size_t>(l.plate)] = plate_frame(l, seam_l, to_l, left.point(l.seam_at));
        frames[static_cast<std::size_t>(r.plate)] = plate_frame(r, seam_r, to_r, right.point(r.seam_at));
    }
    started_ = true;
}

}  // namespace popup
