// Motion: where every plate is at every opening angle, and whether it may be.
//
// Opening angle: 0° closed, 180° flat open. The spine stays still and both base planes move alike
// (Hendrix 5.4.4): a point at distance c from the gutter goes to x = ±c sin(θ/2), z = c cos(θ/2).
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "popup/assembly.h"
#include "popup/units.h"

namespace popup {

enum class Solver {
    closed_form,  // one closed-form solve a linkage; exact to rounding at every angle
    iterative,    // Hendrix's placement by distances (thesis, figure 5.16), 5000 repeats: baseline and
                  // cross-check
};

struct MotionOptions {
    std::vector<Angle> angles;  // empty: 0, 5, … 180. Each in [0°, 180°], ascending
    Solver solver = Solver::closed_form;
    Tolerances tolerances;
};

// What the simulation found. Frames are not stored (they cost 96 bytes a plate and angle): ask for them
// again.
struct Motion {
    std::vector<Angle> angles;
    Solver solver = Solver::closed_form;
    double max_closure_mm = 0.0;  // largest opening of any fold or seam at any of the angles
    double flat_error_deg = 0.0;  // largest angle of a plate to the closed card, at 0°
    bool flat_closed = false;     // flat_error_deg within tolerance
};

// Frames of all plates at one angle, in closed form. `frames` has one entry a plate.
// False when a linkage cannot reach the angle; *stuck (if given) is then the index of the joint. Frames of
// plates placed after it are unspecified. Cost: one square root and two dozen products a four-bar; no
// allocation.
bool place(const Assembly& assembly, Angle theta, std::span<Frame> frames, int* stuck = nullptr);

// The iterative baseline. Keeps the last positions as starting points, as Popup Workshop does; the first call
// starts from its heuristic guess. `repeats` is the limit of figure 5.16, `precision` its "close enough" in
// mm.
class IterativePlacer {
 public:
    explicit IterativePlacer(const Assembly& assembly, int repeats = 5000, double precision = 1e-3);
    void place(Angle theta, std::span<Frame> frames);

 private:
    const Assembly* assembly_;
    int repeats_;
    double precision_;
    std::vector<std::array<Vec3, 2>> centres_;  // of each joint, from the last call
    bool started_ = false;
};

// Largest distance between the two images of a hinge's ends over all hinges of the assembly.
// *worst (if given) is the index of that hinge.
double closure_error(const Assembly& assembly, std::span<const Frame> frames, int* worst = nullptr);

// Simulates and judges: an error names the element that is not flat at 0° (`not-flat`), whose seams do not
// meet
// (`seam-open`), that jumps between angles (`jumps`), or that stops before the card is open (`locks`).
// With Solver::iterative only figures are taken; its inaccuracy is not held against the design.
// Cost: angles × plates.
std::optional<Motion> simulate(const Assembly& assembly, const MotionOptions& options,
                               Diagnostics& diagnostics);

}  // namespace popup
