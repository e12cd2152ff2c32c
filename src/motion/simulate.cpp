// The simulation is the judge: whatever formulas promise, every sampled angle is looked at.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "popup/motion.h"

namespace popup {
namespace {

constexpr double kStepDeg = 0.1;  // jumps are looked for across steps of this size
constexpr double kSuspiciousDeg =
    5.0;                       // a plate that turns further than this in one step is looked at closely
constexpr int kHalvings = 14;  // 0.1° / 2^14: a motion that still turns this far there is a jump

std::vector<Angle> default_angles() {
    std::vector<Angle> angles;
    for (int deg = 0; deg <= 180; deg += 5) angles.push_back(Angle::degrees(deg));
    return angles;
}

// The angle between two frames' rotations, degrees.
double turn_between(const Frame& a, const Frame& b) {
    // |A − B|² = 8 sin²(φ/2): exact for small turns, where the trace is not.
    double squared = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 d = a.axes[i] - b.axes[i];
        squared += dot(d, d);
    }
    return Angle::radians(2.0 * std::asin(std::min(1.0, std::sqrt(squared / 8.0)))).deg;
}

// How far a plate turns against the plate it is hinged to, from one set of frames to another.
double relative_turn(const Assembly& assembly, std::size_t plate, std::span<const Frame> before,
                     std::span<const Frame> after) {
    const int parent = assembly.plates[plate].parent;
    if (parent < 0) return turn_between(before[plate], after[plate]);
    const auto relative = [&](std::span<const Frame> frames) {
        const Frame& base = frames[static_cast<std::size_t>(parent)];
        const Frame& own = frames[plate];
        Frame result;
        for (std::size_t i = 0; i < 3; ++i) {
            result.axes[i] = {dot(base.axes[0], own.axes[i]), dot(base.axes[1], own.axes[i]),
                              dot(base.axes[2], own.axes[i])};
        }
        return result;
    };
    return turn_between(relative(before), relative(after));
}

const Joint* joint_of(const Assembly& assembly, int plate) {
    for (const Joint& joint : assembly.joints) {
        if (joint.left.plate == plate || joint.right.plate == plate) return &joint;
    }
    return nullptr;
}

struct Judge {
    const Assembly& assembly;
    const Tolerances& tolerances;
    Diagnostics& diagnostics;
    std::vector<Frame> here, there, between;

    Judge(const Assembly& a, const Tolerances& t, Diagnostics& d)
        : assembly(a),
          tolerances(t),
          diagnostics(d),
          here(a.plates.size()),
          there(a.plates.size()),
          between(a.plates.size()) {}

    void locks(int stuck, Angle at) {
        const Joint& joint = assembly.joints[static_cast<std::size_t>(stuck)];
        diagnostics
            .error("locks", joint.place,
                   fmt::format("\"{}\" locks: its linkage cannot reach an opening of {:.2f}°", joint.name,
                               at.deg))
            .hint("make its piece wider than the place it is glued to, or close its V")
            .about(joint.name);
    }

    // False when the plates at `at` move through more than a mechanism can between two near angles.
    bool moves_smoothly(Angle at) {
        Angle lo = at;
        Angle hi = Angle::degrees(at.deg + kStepDeg <= 180.0 ? at.deg + kStepDeg : at.deg - kStepDeg);
        int stuck = 0;
        if (!place(assembly, hi, there, &stuck)) return locks(stuck, hi), false;
        std::size_t worst = 0;
        double turn = 0.0;
        const auto measure = [&](std::span<const Frame> a, std::span<const Frame> b) {
            turn = 0.0;
            for (std::size_t i = 0; i < assembly.plates.size(); ++i) {
                const double t = relative_turn(assembly, i, a, b);
                if (t > turn) {
                    turn = t;
                    worst = i;
                }
            }
        };
        measure(here, there);
        if (turn <= kSuspiciousDeg) return true;
        // Halve the step, each time into the half that turns more: a fast motion calms down, a jump does not.
        std::vector<Frame> low = here;
        std::vector<Frame> high = there;
        for (int i = 0; i < kHalvings; ++i) {
            const Angle mid = Angle::degrees(0.5 * (lo.deg + hi.deg));
            if (!place(assembly, mid, between, &stuck)) return locks(stuck, mid), false;
            measure(low, between);
            const double first = turn;
            measure(between, high);
            if (std::max(first, turn) <= 0.5 * kSuspiciousDeg) return true;
            if (first >= turn) {
                high = between;
                hi = mid;
            } else {
                low = between;
                lo = mid;
            }
        }
        measure(low, high);
        const Joint* joint = joint_of(assembly, static_cast<int>(worst));
        diagnostics
            .error("jumps", joint != nullptr ? joint->place : Place{},
                   fmt::format("\"{}\" jumps by {:.1f}° at an opening of {:.2f}°",
                               assembly.plates[worst].name, turn, lo.deg))
            .hint("give its linkage more room: a wider piece, or a narrower V")
            .about(joint != nullptr ? joint->name : "");
        return false;
    }

    bool closes(Angle at, double& largest) {
        int worst = 0;
        const double open = closure_error(assembly, here, &worst);
        largest = std::max(largest, open);
        if (open <= tolerances.closure_mm) return true;
        const Hinge& hinge = assembly.hinges[static_cast<std::size_t>(worst)];
        const auto name = [&](int plate) { return assembly.plates[static_cast<std::size_t>(plate)].name; };
        const Joint* joint = joint_of(assembly, hinge.b);
        diagnostics
            .error("seam-open", joint != nullptr ? joint->place : Place{},
                   fmt::format("the {} between \"{}\" and \"{}\" opens by {:.2g} mm at {:.2f}°, {:.0e} mm is "
                               "the most allowed",
                               hinge.glued ? "seam" : "fold", name(hinge.a), name(hinge.b), open, at.deg,
                               tolerances.closure_mm))
            .hint("the element is too close to a shape that cannot fold: make its angles or widths larger")
            .about(joint != nullptr ? joint->name : "");
        return false;
    }

    // The largest angle of a plate to the closed card, degrees, and that plate.
    [[nodiscard]] std::pair<double, std::size_t> flat_error() const {
        std::pair<double, std::size_t> worst{0.0, 0};
        for (std::size_t i = 0; i < here.size(); ++i) {
            // At the closed card every plate lies in the plane x = 0.
            const Vec3 n = here[i].normal();
            const double off = Angle::radians(std::atan2(std::hypot(n.y, n.z), std::abs(n.x))).deg;
            worst = std::max(worst, {off, i});
        }
        return worst;
    }

    bool is_flat(Motion& motion) {
        const auto [error, worst] = flat_error();
        motion.flat_error_deg = error;
        motion.flat_closed = motion.flat_error_deg <= tolerances.flat_deg;
        if (motion.flat_closed) return true;
        const Joint* joint = joint_of(assembly, static_cast<int>(worst));
        diagnostics
            .error("not-flat", joint != nullptr ? joint->place : Place{},
                   fmt::format("\"{}\" stands {:.3f}° off the closed card, {:.3f}° is the most allowed",
                               assembly.plates[worst].name, motion.flat_error_deg, tolerances.flat_deg))
            .hint("its angles do not fold flat; let popupc repair the element")
            .about(joint != nullptr ? joint->name : "");
        return false;
    }
};

}  // namespace

std::optional<Motion> simulate(const Assembly& assembly, const MotionOptions& options,
                               Diagnostics& diagnostics) {
    Motion motion;
    motion.angles = options.angles.empty() ? default_angles() : options.angles;
    motion.solver = options.solver;
    Judge judge(assembly, options.tolerances, diagnostics);
    if (options.solver == Solver::iterative) {
        IterativePlacer placer(assembly);
        for (const Angle at : motion.angles) {
            placer.place(at, judge.here);
            motion.max_closure_mm = std::max(motion.max_closure_mm, closure_error(assembly, judge.here));
        }
        IterativePlacer closed(assembly);
        closed.place(Angle{}, judge.here);
        motion.flat_error_deg = judge.flat_error().first;
        motion.flat_closed = motion.flat_error_deg <= options.tolerances.flat_deg;
        return motion;
    }
    int stuck = 0;
    if (!place(assembly, Angle{}, judge.here, &stuck)) {
        judge.locks(stuck, Angle{});
        return std::nullopt;
    }
    if (!judge.is_flat(motion)) return std::nullopt;
    for (const Angle at : motion.angles) {
        if (!place(assembly, at, judge.here, &stuck)) {
            judge.locks(stuck, at);
            return std::nullopt;
        }
        if (!judge.closes(at, motion.max_closure_mm) || !judge.moves_smoothly(at)) return std::nullopt;
    }
    return motion;
}

}  // namespace popup
