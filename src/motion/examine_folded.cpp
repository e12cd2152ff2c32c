// A folded sheet where its motion ends.
#include "assembly/folded_sheets.h"
#include "popup/motion.h"

namespace popup {
namespace {

constexpr double kFlatDeg = 180.0;
constexpr double kStandingDeg = 1.0;  // a sweep of what stands still

}  // namespace

Examination examine_folded(Assembly assembly, const MotionOptions& options) {
    for (Joint& joint : assembly.joints) {
        Law* const law = law_of(joint);
        if (law == nullptr) continue;
        const double folded = law->front().y;
        *law = {{0.0, folded}, {kFlatDeg, folded}};
    }
    // It is the same over the whole sweep.
    assembly.sweep = {0.0, kStandingDeg, false};
    return examine(assembly, options);
}

}  // namespace popup
