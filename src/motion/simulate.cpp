// The simulation is the judge: whatever formulas promise, every sampled angle is looked at.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "motion/examine.h"
#include "motion/findings.h"
#include "motion/passage.h"
#include "motion/sweep.h"
#include "motion/whole_way.h"
#include "popup/motion.h"

namespace popup {
namespace {

constexpr double kFullOpeningDeg = 180.0;
constexpr double kSameAngleDeg = 1e-9;

std::vector<Angle> default_angles(const Sweep& sweep) {
    std::vector<Angle> angles;
    for (int deg = 0; deg <= 180; deg += 5) angles.push_back(Angle::degrees(opening_at(sweep, deg)));
    return angles;
}

// Those of the sweep. What is asked for beyond it is where the sweep ends.
std::vector<Angle> angles_within(const Sweep& sweep, std::vector<Angle> angles) {
    for (Angle& angle : angles) angle.deg = std::clamp(angle.deg, sweep.from_deg, sweep.to_deg);
    angles.erase(std::unique(angles.begin(), angles.end()), angles.end());
    return angles;
}

struct Judge {
    const Assembly& assembly;
    const Tolerances& tolerances;
    Diagnostics& diagnostics;
    Linkage linkage;
    std::vector<Frame> here;

    Judge(const Assembly& a, const Tolerances& t, Diagnostics& d)
        : assembly(a), tolerances(t), diagnostics(d), linkage(a), here(a.plates.size()) {}

    bool closes(Angle at, double& largest) {
        int worst = 0;
        const double open = closure_error(assembly, here, &worst);
        largest = std::max(largest, open);
        if (open <= tolerances.closure_mm) return true;
        const Hinge& hinge = assembly.hinges[static_cast<std::size_t>(worst)];
        const auto name = [&](int plate) { return assembly.plates[static_cast<std::size_t>(plate)].name; };
        const Joint& joint = linkage.element(hinge.b);
        diagnostics
            .error("seam-open", joint.place,
                   fmt::format("the {} between \"{}\" and \"{}\" opens by {:.2g} mm at {:.2f}°, {:.0e} mm is "
                               "the most allowed",
                               hinge.glued ? "seam" : "fold", name(hinge.a), name(hinge.b), open, at.deg,
                               tolerances.closure_mm))
            .hint("the element is too close to a shape that cannot fold: make its angles or widths larger")
            .about(joint.name);
        return false;
    }

    // The largest angle of a plate to the closed card, degrees, and that plate.
    [[nodiscard]] std::pair<double, std::size_t> flat_error() const {
        std::pair<double, std::size_t> worst{0.0, 0};
        if (assembly.covers.empty()) return worst;
        const Frame& cover = here[static_cast<std::size_t>(assembly.covers[0])];
        for (std::size_t i = 0; i < here.size(); ++i) {
            // At the closed card every plate lies in the plane of its covers.
            const Vec3 n = here[i].normal();
            const double aside = std::hypot(dot(n, cover.axes[1]), dot(n, cover.axes[0]));
            const double off = Angle::radians(std::atan2(aside, std::abs(dot(n, cover.normal())))).deg;
            worst = std::max(worst, {off, i});
        }
        return worst;
    }

    bool is_flat(Motion& motion) {
        const auto [error, worst] = flat_error();
        motion.flat_error_deg = error;
        motion.flat_closed = motion.flat_error_deg <= tolerances.flat_deg;
        if (motion.flat_closed) return true;
        const Joint& joint = linkage.element(static_cast<int>(worst));
        diagnostics
            .error("not-flat", joint.place,
                   fmt::format("\"{}\" stands {:.3f}° off the closed card, {:.3f}° is the most allowed",
                               assembly.plates[worst].name, motion.flat_error_deg, tolerances.flat_deg))
            .hint("its angles do not fold flat; let popupc repair the element")
            .about(joint.name);
        return false;
    }
};

bool by_degrees(Angle a, Angle b) { return a.deg < b.deg; }

bool is_driven(const Linkage& linkage) {
    return std::any_of(linkage.turns().begin(), linkage.turns().end(),
                       [](const Turn& turn) { return turn.other < 0 && !turn.still; });
}

// The first and last angle of each contact are looked at like those asked for. Where one is at the end of the
// sweep, it is that up to rounding.
void add_witnesses(Motion& motion) {
    const std::vector<Angle> asked = motion.angles;
    for (const Contact& contact : motion.examination->contacts) {
        for (const double deg : {contact.from_deg, contact.to_deg}) {
            const bool is_there = std::any_of(asked.begin(), asked.end(), [&](Angle angle) {
                return std::abs(angle.deg - deg) < kSameAngleDeg;
            });
            if (!is_there) motion.angles.push_back(Angle::degrees(deg));
        }
    }
    std::sort(motion.angles.begin(), motion.angles.end(), by_degrees);
    motion.angles.erase(std::unique(motion.angles.begin(), motion.angles.end()), motion.angles.end());
}

// `sheet`: the assembly, if its folds may be put in an order; null: they may not.
std::optional<Motion> run(const Assembly& assembly, Assembly* sheet, const MotionOptions& options,
                          Diagnostics& diagnostics) {
    Motion motion;
    motion.angles = options.angles.empty() ? default_angles(assembly.sweep)
                                           : angles_within(assembly.sweep, options.angles);
    motion.solver = options.solver;
    Judge judge(assembly, options.tolerances, diagnostics);
    const Angle beginning = Angle::degrees(assembly.sweep.from_deg);
    if (options.solver == Solver::iterative) {
        IterativePlacer placer(assembly);
        for (const Angle at : motion.angles) {
            placer.place(at, judge.here);
            motion.max_closure_mm = std::max(motion.max_closure_mm, closure_error(assembly, judge.here));
        }
        IterativePlacer closed(assembly);
        closed.place(beginning, judge.here);
        motion.flat_error_deg = judge.flat_error().first;
        motion.flat_closed = motion.flat_error_deg <= options.tolerances.flat_deg;
        return motion;
    }
    int stuck = 0;
    if (!place(assembly, beginning, judge.here, &stuck)) {
        report_lock(assembly.joints[static_cast<std::size_t>(stuck)], -1.0, beginning.deg, diagnostics);
        return std::nullopt;
    }
    if (assembly.sweep.closed_flat && !judge.is_flat(motion)) return std::nullopt;
    const bool examine_too = options.examine && !assembly.sweep.bends;
    std::optional<Recall> recall;
    if (options.memory != nullptr && sheet == nullptr && examine_too)
        recall.emplace(*options.memory, assembly, judge.linkage, options);
    const auto way = pass_whole_way(assembly, judge.linkage, motion.angles, options.tolerances,
                                    recall ? &*recall : nullptr, diagnostics);
    if (!way) return std::nullopt;
    motion.max_closure_mm = way->most_open_mm;
    // Most of the angles that are asked for lie on the way.
    for (const Angle at : motion.angles) {
        if (std::binary_search(way->closed_at.begin(), way->closed_at.end(), at.deg)) continue;
        if (!place(assembly, at, judge.here, &stuck)) {
            report_lock(assembly.joints[static_cast<std::size_t>(stuck)], -1.0, at.deg, diagnostics);
            return std::nullopt;
        }
        if (!judge.closes(at, motion.max_closure_mm)) return std::nullopt;
    }
    // A sheet that nothing drives is not forced at all.
    if (is_driven(judge.linkage)) motion.not_forced = free_plates(assembly);
    report_not_forced(assembly, judge.linkage, motion.not_forced, diagnostics);
    if (!examine_too) return motion;
    std::vector<PlateShape> shapes = recall ? recall->take_shapes() : plate_shapes(assembly, options);
    bool crossed = false;
    if (sheet != nullptr) {
        const Sweep& sweep = assembly.sweep;
        const bool whole = sweep.from_deg == 0.0 && sweep.to_deg == kFullOpeningDeg;
        // What crosses is put in an order first, and then mostly looked at in that order alone.
        motion.examination = examine_until_crossed(assembly, judge.linkage, shapes, options, &crossed);
        if (order_folds(*sheet, options, diagnostics, whole ? &*motion.examination : nullptr))
            return run(assembly, nullptr, options, diagnostics);
    }
    if (sheet == nullptr || crossed)
        motion.examination = examine(assembly, judge.linkage, shapes, options, recall ? &*recall : nullptr);
    motion.moves =
        report_findings(assembly, judge.linkage, shapes, *motion.examination, options, diagnostics);
    if (recall) recall->keep(std::move(shapes));
    add_witnesses(motion);
    return motion;
}

}  // namespace

std::optional<Motion> simulate(const Assembly& assembly, const MotionOptions& options,
                               Diagnostics& diagnostics) {
    return run(assembly, nullptr, options, diagnostics);
}

std::optional<Motion> simulate_sheet(Assembly& assembly, const MotionOptions& options,
                                     Diagnostics& diagnostics) {
    const bool examined = options.examine && options.solver == Solver::closed_form;
    if (!examined) order_folds(assembly, options, diagnostics);
    return run(assembly, examined ? &assembly : nullptr, options, diagnostics);
}

}  // namespace popup
