// Frames of all plates at one angle: joint by joint, in the order in which they stand.
#include <algorithm>

#include "motion/joints/joint.h"
#include "popup/motion.h"

namespace popup {

bool place(const Assembly& assembly, Angle theta, std::span<Frame> frames, int* stuck) {
    POPUP_INVARIANT(frames.size() == assembly.plates.size());
    for (std::size_t i = 0; i < assembly.joints.size(); ++i) {
        if (place_plates(assembly.joints[i], theta, frames)) continue;
        if (stuck != nullptr) *stuck = static_cast<int>(i);
        return false;
    }
    return true;
}

double closure_error(const Assembly& assembly, std::span<const Frame> frames, int* worst) {
    double largest = 0.0;
    for (std::size_t i = 0; i < assembly.hinges.size(); ++i) {
        const Hinge& hinge = assembly.hinges[i];
        const Frame& a = frames[static_cast<std::size_t>(hinge.a)];
        const Frame& b = frames[static_cast<std::size_t>(hinge.b)];
        const double open = std::max(distance(a.point(hinge.a_line.a), b.point(hinge.b_line.a)),
                                     distance(a.point(hinge.a_line.b), b.point(hinge.b_line.b)));
        if (open > largest) {
            largest = open;
            if (worst != nullptr) *worst = static_cast<int>(i);
        }
    }
    return largest;
}

}  // namespace popup
