#include "output/hinge_tree.h"

#include <cmath>

#include "base/text/numbers.h"
#include "popup/diagnostics.h"

namespace popup {
namespace {

constexpr int kLengthDecimals = 6;
constexpr int kTurnDecimals = 9;
// Plates that lie on one another are shown this far apart, or a viewer could not tell which is above.
constexpr double kGluedApartMm = 0.2;

Vec3 in_axes(const Frame& frame, Vec3 v) {
    return {dot(frame.axes[0], v), dot(frame.axes[1], v), dot(frame.axes[2], v)};
}

Vec3 turned(const Frame& frame, Vec3 v) {
    return v.x * frame.axes[0] + v.y * frame.axes[1] + v.z * frame.axes[2];
}

std::array<Vec3, 3> axes_of(const Quaternion& q) {
    // A viewer takes any quaternion for a unit one; 32 bits keep it one to 1e-7.
    const auto [x, y, z, w] = q;
    return {Vec3{1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)},
            Vec3{2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)},
            Vec3{2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)}};
}

}  // namespace

HingeTree hinge_tree(const Assembly& assembly, std::span<const Frame> rest) {
    const std::size_t count = assembly.plates.size();
    // Children of plate p - 1 stand from first[p] to first[p + 1]; plates without parent come first of all.
    std::vector<std::size_t> first(count + 2, 0);
    for (const Plate& plate : assembly.plates) ++first[static_cast<std::size_t>(plate.parent) + 2];
    for (std::size_t i = 1; i < first.size(); ++i) first[i] += first[i - 1];
    std::vector<int> children(count);
    std::vector<std::size_t> next(first.begin(), first.end() - 1);
    for (std::size_t i = 0; i < count; ++i) {
        children[next[static_cast<std::size_t>(assembly.plates[i].parent) + 1]++] = static_cast<int>(i);
    }

    HingeTree tree;
    tree.order.assign(children.begin(), children.begin() + static_cast<std::ptrdiff_t>(first[1]));
    for (std::size_t i = 0; i < tree.order.size(); ++i) {
        const auto plate = static_cast<std::size_t>(tree.order[i]);
        tree.order.insert(tree.order.end(), children.begin() + static_cast<std::ptrdiff_t>(first[plate + 1]),
                          children.begin() + static_cast<std::ptrdiff_t>(first[plate + 2]));
    }
    POPUP_INVARIANT(tree.order.size() == count);  // no plate is its own ancestor

    tree.offset.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        const Plate& plate = assembly.plates[i];
        Vec3 at = rest[i].point(plate.pivot);
        if (plate.parent >= 0) {
            const auto parent = static_cast<std::size_t>(plate.parent);
            at = in_axes(rest[parent], at - rest[parent].point(assembly.plates[parent].pivot));
            if (plate.lying == Lying::on_front) at.z += kGluedApartMm;
            if (plate.lying == Lying::on_back) at.z -= kGluedApartMm;
        }
        tree.offset[i] = {rounded(at.x, kLengthDecimals), rounded(at.y, kLengthDecimals),
                          rounded(at.z, kLengthDecimals)};
    }
    return tree;
}

void local_turns(const Assembly& assembly, std::span<const Frame> frames, std::span<Quaternion> turns) {
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const int parent = assembly.plates[i].parent;
        Frame local = frames[i];
        if (parent >= 0) {
            const Frame& base = frames[static_cast<std::size_t>(parent)];
            for (std::size_t k = 0; k < 3; ++k) local.axes[k] = in_axes(base, frames[i].axes[k]);
        }
        turns[i] = quaternion(local);
        for (double& value : turns[i]) value = static_cast<float>(rounded(value, kTurnDecimals));
    }
}

void compose(const Assembly& assembly, const HingeTree& tree, std::span<const Quaternion> turns,
             std::span<Frame> frames) {
    // While this goes on an origin is the image of the pivot: a node's own place.
    for (const int number : tree.order) {
        const auto i = static_cast<std::size_t>(number);
        Frame& frame = frames[i];
        frame.axes = axes_of(turns[i]);
        frame.origin = tree.offset[i];
        const int parent = assembly.plates[i].parent;
        if (parent < 0) continue;
        const Frame& base = frames[static_cast<std::size_t>(parent)];
        for (Vec3& axis : frame.axes) axis = turned(base, axis);
        frame.origin = base.origin + turned(base, frame.origin);
    }
    for (std::size_t i = 0; i < frames.size(); ++i) {
        frames[i].origin = frames[i].origin - frames[i].direction(assembly.plates[i].pivot);
    }
}

Quaternion product(const Quaternion& a, const Quaternion& b) {
    const auto [ax, ay, az, aw] = a;
    const auto [bx, by, bz, bw] = b;
    return {aw * bx + ax * bw + ay * bz - az * by, aw * by - ax * bz + ay * bw + az * bx,
            aw * bz + ax * by - ay * bx + az * bw, aw * bw - ax * bx - ay * by - az * bz};
}

Quaternion halfway(const Quaternion& a, const Quaternion& b) {
    double product = 0.0;
    for (std::size_t i = 0; i < 4; ++i) product += a.at(i) * b.at(i);
    const double sign = product < 0.0 ? -1.0 : 1.0;
    const double scale = 1.0 / std::sqrt(2.0 + 2.0 * std::abs(product));
    Quaternion middle{};
    for (std::size_t i = 0; i < 4; ++i) middle.at(i) = scale * (a.at(i) + sign * b.at(i));
    return middle;
}

}  // namespace popup
