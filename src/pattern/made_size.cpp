#include "popup/made_size.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/nth.h"
#include "pattern/tab_places.h"

namespace popup {
namespace {

// Less than this does not hold what is glued flat.
constexpr double kLeastGlueMm2 = 25.0;
constexpr double kJudgedMm = 1e-6;

// A size that is told so that it does: never less than it is.
double rounded_up(double value) { return std::ceil(value * 100.0 - 1e-6) / 100.0; }

// The tabs that hold as they are drawn, and are not deep enough as they are made.
void judge_each_tab(const Assembly& assembly, const PatternOptions& options, double scale,
                    Diagnostics& diagnostics) {
    const double wanted = std::min(kWeakTabMm, options.tab_depth.mm);
    TabPlaces places(assembly, tab_rules(options));
    for (const Glue& glue : assembly.glue) {
        const std::vector<Ring> parts = places.place(glue);
        const double seam = SeamFrame(glue.on_piece, true).length();
        const auto deep = [&](double depth) { return length_with_depth(parts, depth - kJudgedMm); };
        const double good = deep(wanted / scale);
        if (deep(wanted) <= 0.5 * seam || good > 0.5 * seam) continue;
        diagnostics
            .warning("tab-too-small", glue.place,
                     fmt::format(
                         "at a scale of {:.4g} glue tab {} is at least {:.4g} mm deep ({:.4g} mm as drawn) "
                         "along only {:.2f} mm of its seam of {:.2f} mm ({:.2f} mm of {:.2f} mm)",
                         scale, glue.label, wanted, wanted / scale, good * scale, seam * scale, good, seam))
            .about(glue.element)
            .hint(fmt::format("take a larger --scale, or move the element so that {:.4g} mm of {}, as drawn, "
                              "are clear beside the seam",
                              wanted / scale + tab_rules(options).gap,
                              nth(assembly.plates, glue.base_plate).name));
    }
}

void judge_tabs_made(const Assembly& assembly, const PatternOptions& options, double scale,
                     Diagnostics& diagnostics) {
    if (assembly.glue.empty()) return;
    const double depth = options.tab_depth.mm;
    // Who asks for tabs of 2 mm wants them no smaller.
    const double wanted = std::min(kWeakTabMm, depth);
    if (depth * scale >= wanted - kJudgedMm) return judge_each_tab(assembly, options, scale, diagnostics);
    const Glue& first = assembly.glue.front();
    diagnostics
        .warning("tab-too-small", first.place,
                 fmt::format("glue tabs of {:.4g} mm are made {:.3g} mm deep at a scale of {:.4g}; with less "
                             "than {:.4g} mm they hold badly",
                             depth, depth * scale, scale, wanted))
        .about(first.element)
        .hint(fmt::format("take --scale {:.4g} or more, or --tab-depth {:.4g}mm where there is room for it",
                          rounded_up(wanted / depth), rounded_up(wanted / scale)));
}

void judge_areas_made(const Assembly& assembly, double scale, Diagnostics& diagnostics) {
    const GluedArea* smallest = nullptr;
    double least = 0.0;
    for (const GluedArea& one : assembly.glued_areas) {
        const double drawn = area(one.on_base);
        if (drawn < kLeastGlueMm2 - kJudgedMm || drawn * scale * scale >= kLeastGlueMm2 - kJudgedMm) continue;
        if (smallest != nullptr && drawn >= least) continue;
        smallest = &one;
        least = drawn;
    }
    if (smallest == nullptr) return;
    diagnostics
        .warning(
            "tab-too-small", smallest->place,
            fmt::format("\"{}\" is glued over {:.1f} mm², which are {:.1f} mm² at a scale of {:.4g}; {:.0f} "
                        "mm² are the least that holds",
                        smallest->element, least, least * scale * scale, scale, kLeastGlueMm2))
        .about(smallest->element)
        .hint(fmt::format("take --scale {:.4g} or more, or make the piece larger where it is glued",
                          rounded_up(std::sqrt(kLeastGlueMm2 / least))));
}

}  // namespace

void judge_made_size(const Assembly& assembly, const PatternOptions& options, double scale,
                     Diagnostics& diagnostics) {
    if (scale >= 1.0) return;
    judge_tabs_made(assembly, options, scale, diagnostics);
    judge_areas_made(assembly, scale, diagnostics);
}

}  // namespace popup
