// Features of one sheet as documents have them, and what must hold of the card that they make.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "popup/motion.h"
#include "support/designs.h"
#include "support/paper_balance.h"

namespace popup::test {

inline constexpr double kPage = 200.0 * 150.0;

inline std::string freeform(const std::string& d, const std::string& more = "", const std::string& id = "f") {
    return "<structure type='freeform' id='" + id + "'><outline d='" + d + "'/>" + more + "</structure>";
}
inline std::string hole(const std::string& d, const std::string& id = "hole") {
    return "<structure type='hole' id='" + id + "'><outline d='" + d + "'/></structure>";
}
inline std::string box(double u, double v, double x, double y, const std::string& id) {
    return "<structure type='box-fold' id='" + id + "'><point x='" + std::to_string(u) + "' y='" +
           std::to_string(v) + "'/><point x='" + std::to_string(x) + "' y='" + std::to_string(y) +
           "'/></structure>";
}

// The plates share the paper out, less what holes take; and all seams close at every degree.
inline void expect_sound(const FromXml& made, double holes = 0.0) {
    ASSERT_TRUE(made.assembly) << made.text;
    const Balance balance = balance_of(*made.assembly, 0);
    EXPECT_NEAR(balance.plates, kPage - holes, 1e-6);
    EXPECT_LT(balance.overlap, 5e-4);  // Boost rounds corners to some 1e-6 mm
    MotionOptions options;
    for (int deg = 0; deg <= 180; ++deg) options.angles.push_back(Angle::degrees(deg));
    options.examine = false;
    Diagnostics diagnostics;
    const auto motion = simulate(*made.assembly, options, diagnostics);
    ASSERT_TRUE(motion) << findings(diagnostics);
    EXPECT_LE(motion->max_closure_mm, 1e-6);
    EXPECT_LE(motion->flat_error_deg, 1e-6);
}

inline std::vector<Segment> lines_of(const Assembly& assembly, LineKind kind) {
    std::vector<Segment> lines;
    for (const Line& line : assembly.lines) {
        if (line.kind == kind) lines.push_back(line.at);
    }
    return lines;
}

inline double length_of(const std::vector<Segment>& lines) {
    double sum = 0.0;
    for (const Segment& line : lines) sum += distance(line.a, line.b);
    return sum;
}

}  // namespace popup::test
