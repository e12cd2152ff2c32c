// Frames of all plates at one angle: joint by joint, in the order in which they stand.
#include "motion/hinge_gap.h"
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
        const double open = gap_of(assembly.hinges[i], frames);
        if (open > largest) {
            largest = open;
            if (worst != nullptr) *worst = static_cast<int>(i);
        }
    }
    return largest;
}

}  // namespace popup
