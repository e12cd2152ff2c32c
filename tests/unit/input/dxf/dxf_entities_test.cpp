// The entities of DXF against what their definitions say, computed here in other ways.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "popup/curves.h"
#include "support/dxf_text.h"

namespace popup {
namespace {

using drawing::TracedLine;

constexpr double kPi = std::numbers::pi;
// Chords stray by 0.01 mm; their ends lie on the curve, but for the grid and the cubics of arcs.
constexpr double kOnCurve = 1e-5;

using Traced = test::TracedDxf;

Traced entities(std::string_view rows) { return test::traced_dxf(test::dxf_file(rows)); }

double far_from_circle(const TracedLine& line, Vec2 centre, double radius) {
    double off = 0.0;
    for (const Vec2 p : line.points) off = std::max(off, std::abs(distance(p, centre) - radius));
    return off;
}

// Where it goes around the centre from beginning to end, in degrees, counter-clockwise.
double swept_deg(const TracedLine& line, Vec2 centre) {
    double sum = 0.0;
    const std::size_t count = line.points.size();
    for (std::size_t i = 0; i + (line.closed ? 0 : 1) < count; ++i) {
        const Vec2 a = line.points[i] - centre;
        const Vec2 b = line.points[(i + 1) % count] - centre;
        sum += std::atan2(a.x * b.y - a.y * b.x, dot(a, b));
    }
    return sum * 180.0 / kPi;
}

void expect_at(Vec2 p, double x, double y, double within = 2e-6) {
    EXPECT_NEAR(p.x, x, within);
    EXPECT_NEAR(p.y, y, within);
}

TEST(DxfEntities, ALine) {
    const Traced one = entities("0 LINE|8 0|10 1.5|20 -2|30 0|11 7|21 3.25|31 0");
    ASSERT_TRUE(one.tracing) << one.told;
    ASSERT_EQ(one.line().points.size(), 2U);
    expect_at(one.line().points[0], 1.5, -2.0);
    expect_at(one.line().points[1], 7.0, 3.25);
    EXPECT_EQ(one.told, "");
}

TEST(DxfEntities, ArcsRunCounterClockwise) {
    for (const auto& [from, to, sweep] : {std::tuple{30.0, 75.0, 45.0},
                                          {300.0, 60.0, 120.0},
                                          {90.0, 89.0, 359.0},
                                          {-45.0, 45.0, 90.0},
                                          {10.0, 730.0, 0.0}}) {
        const Traced one =
            entities(fmt::format("0 ARC|8 0|10 5|20 -3|40 20|50 {}|51 {}", from, sweep == 0.0 ? from : to));
        ASSERT_TRUE(one.tracing) << one.told;
        EXPECT_LT(far_from_circle(one.line(), {5, -3}, 20), kOnCurve);
        EXPECT_NEAR(swept_deg(one.line(), {5, -3}), sweep == 0.0 ? 360.0 : sweep, 1e-4);
        EXPECT_EQ(one.line().closed, sweep == 0.0);
        const double a = from * kPi / 180.0;
        expect_at(one.line().points[0], 5 + 20 * std::cos(a), -3 + 20 * std::sin(a));
    }
}

TEST(DxfEntities, ACircleIsClosed) {
    const Traced one = entities("0 CIRCLE|8 0|10 5|20 -3|40 20");
    ASSERT_TRUE(one.tracing) << one.told;
    EXPECT_TRUE(one.line().closed);
    EXPECT_LT(far_from_circle(one.line(), {5, -3}, 20), kOnCurve);
    EXPECT_NEAR(swept_deg(one.line(), {5, -3}), 360.0, 1e-4);
}

TEST(DxfEntities, AnEllipseIsWhereTheSumOfDistancesIsTheAxis) {
    const Traced one = entities("0 ELLIPSE|8 0|10 1|20 2|11 3|21 4|40 0.5|41 0|42 6.283185307179586");
    ASSERT_TRUE(one.tracing) << one.told;
    EXPECT_TRUE(one.line().closed);
    const double focus = std::sqrt(1.0 - 0.25);
    for (const Vec2 p : one.line().points) {
        const Vec2 off = focus * Vec2{3, 4};
        EXPECT_NEAR(distance(p, Vec2{1, 2} + off) + distance(p, Vec2{1, 2} - off), 10.0, kOnCurve);
    }
    // A quarter from the end of the major axis to that of the minor, which lies to its left.
    const Traced part = entities("0 ELLIPSE|8 0|10 1|20 2|11 3|21 4|40 0.5|41 0|42 1.5707963267948966");
    ASSERT_TRUE(part.tracing) << part.told;
    EXPECT_FALSE(part.line().closed);
    expect_at(part.line().points.front(), 4, 6);
    expect_at(part.line().points.back(), 1 - 2, 2 + 1.5);
    // Seen from behind the minor axis lies to its right.
    const Traced behind =
        entities("0 ELLIPSE|8 0|10 1|20 2|11 3|21 4|40 0.5|41 0|42 1.5707963267948966|210 0|220 0|230 -1");
    ASSERT_TRUE(behind.tracing) << behind.told;
    expect_at(behind.line().points.back(), 1 + 2, 2 - 1.5);
}

// A bulge is the tangent of a quarter of the angle: the sagitta is half the chord times it.
TEST(DxfEntities, BulgesAreArcsThroughTheirSagitta) {
    for (const double bulge : {1.0, -1.0, 0.41421356237, -0.2, 3.0, 1e-4, -0.02}) {
        const Traced one =
            entities(fmt::format("0 LWPOLYLINE|8 0|90 2|70 0|10 10|20 5|42 {}|10 40|20 45", bulge));
        ASSERT_TRUE(one.tracing) << one.told;
        const Vec2 a{10, 5};
        const Vec2 b{40, 45};
        // To the right of the way for a bulge above zero.
        const Vec2 top = 0.5 * (a + b) + (-bulge * 25.0) * Vec2{-0.8, 0.6};
        // The circle through three points.
        const Vec2 u = b - a;
        const Vec2 v = top - a;
        const double d = 2.0 * (u.x * v.y - u.y * v.x);
        const Vec2 centre =
            a + (1.0 / d) * Vec2{v.y * dot(u, u) - u.y * dot(v, v), u.x * dot(v, v) - v.x * dot(u, u)};
        EXPECT_LT(far_from_circle(one.line(), centre, distance(a, centre)), 1e-4) << bulge;
        EXPECT_NEAR(swept_deg(one.line(), centre), 4.0 * std::atan(bulge) * 180.0 / kPi, 1e-3) << bulge;
        expect_at(one.line().points.front(), 10, 5);
        expect_at(one.line().points.back(), 40, 45);
    }
}

TEST(DxfEntities, APolylineClosesByItsLastBulge) {
    const Traced one =
        entities("0 LWPOLYLINE|8 0|90 4|70 1|43 0.7|10 0|20 0|10 30|20 0|42 1|10 30|20 20|10 0|20 20|42 1");
    ASSERT_TRUE(one.tracing) << one.told;
    EXPECT_TRUE(one.line().closed);
    // A slot: a rectangle and two half discs.
    EXPECT_NEAR(signed_area(one.line().points), 30 * 20 + kPi * 100, 0.5);
    Box box;
    for (const Vec2 p : one.line().points) box.extend(p);
    EXPECT_NEAR(box.min.x, -10, 1e-2);
    EXPECT_NEAR(box.max.x, 40, 1e-2);
}

TEST(DxfEntities, WhatEndsWhereItBeginsIsClosed) {
    const Traced one = entities("0 LWPOLYLINE|8 0|90 4|70 0|10 0|20 0|10 30|20 0|10 30|20 20|10 0|20 0");
    ASSERT_TRUE(one.tracing) << one.told;
    EXPECT_TRUE(one.line().closed);
    EXPECT_EQ(one.line().points.size(), 3U);
    const Traced there_and_back = entities("0 LWPOLYLINE|8 0|90 3|70 0|10 0|20 0|10 30|20 0|10 0|20 0");
    ASSERT_TRUE(there_and_back.tracing);
    EXPECT_FALSE(there_and_back.line().closed);
}

TEST(DxfEntities, OldPolylinesAreTheSame) {
    const Traced old = entities(
        "0 POLYLINE|8 0|66 1|70 1|0 VERTEX|8 0|10 0|20 0|0 VERTEX|8 0|10 30|20 0|42 1|0 VERTEX|8 0|10 30|20 "
        "20|0 "
        "VERTEX|8 0|10 0|20 20|42 1|0 SEQEND|8 0");
    const Traced now =
        entities("0 LWPOLYLINE|8 0|90 4|70 1|10 0|20 0|10 30|20 0|42 1|10 30|20 20|10 0|20 20|42 1");
    ASSERT_TRUE(old.tracing && now.tracing) << old.told << now.told;
    EXPECT_EQ(old.line().points, now.line().points);
    EXPECT_TRUE(old.line().closed);
    // The controls of a curve are no corners of it.
    const Traced fitted = entities(
        "0 POLYLINE|8 0|66 1|70 4|0 VERTEX|8 0|10 0|20 0|70 16|0 VERTEX|8 0|10 1|20 0|70 8|0 VERTEX|8 0|10 "
        "2|20 "
        "1|70 8|0 SEQEND|8 0");
    ASSERT_TRUE(fitted.tracing) << fitted.told;
    ASSERT_EQ(fitted.line().points.size(), 2U);
    expect_at(fitted.line().points[0], 1, 0);
}

// De Boor's recursion, as the definition of B-splines has it.
double basis(int i, int degree, double t, const std::vector<double>& knots) {
    const auto k = [&](int n) { return knots[static_cast<std::size_t>(n)]; };
    if (degree == 0) return k(i) <= t && t < k(i + 1) ? 1.0 : 0.0;
    double sum = 0.0;
    if (k(i + degree) > k(i)) sum += (t - k(i)) / (k(i + degree) - k(i)) * basis(i, degree - 1, t, knots);
    if (k(i + degree + 1) > k(i + 1))
        sum += (k(i + degree + 1) - t) / (k(i + degree + 1) - k(i + 1)) * basis(i + 1, degree - 1, t, knots);
    return sum;
}

struct Nurbs {
    int degree = 3;
    std::vector<double> knots;
    std::vector<Vec2> controls;
    std::vector<double> weights;

    [[nodiscard]] Vec2 at(double t) const {
        Vec2 sum;
        double weight = 0.0;
        for (std::size_t i = 0; i < controls.size(); ++i) {
            const double b =
                basis(static_cast<int>(i), degree, t, knots) * (weights.empty() ? 1.0 : weights[i]);
            sum = sum + b * controls[i];
            weight += b;
        }
        return (1.0 / weight) * sum;
    }
    [[nodiscard]] std::string text() const {
        std::string rows =
            fmt::format("0 SPLINE|8 0|70 8|71 {}|72 {}|73 {}|74 0", degree, knots.size(), controls.size());
        for (const double k : knots) rows += fmt::format("|40 {}", k);
        for (const double w : weights) rows += fmt::format("|41 {}", w);
        for (const Vec2 p : controls) rows += fmt::format("|10 {}|20 {}|30 0", p.x, p.y);
        return rows;
    }
};

double to_line(Vec2 p, const TracedLine& line) {
    double best = HUGE_VAL;
    const std::size_t count = line.points.size();
    for (std::size_t i = 0; i + (line.closed ? 0 : 1) < count; ++i) {
        const Vec2 a = line.points[i];
        const Vec2 d = line.points[(i + 1) % count] - a;
        const double t = std::clamp(dot(p - a, d) / dot(d, d), 0.0, 1.0);
        best = std::min(best, distance(p, a + t * d));
    }
    return best;
}

TEST(DxfEntities, SplinesAreWhereDeBoorHasThem) {
    const std::vector<Vec2> wild{{0, 0}, {10, 30}, {40, -20}, {60, 10}, {70, 50}, {20, 70}, {-10, 40}};
    const double half = std::sqrt(0.5);
    const std::vector<Nurbs> all{
        {1, {0, 0, 1, 2, 3, 3}, {{0, 0}, {10, 30}, {40, -20}, {60, 10}}, {}},
        {2, {0, 0, 0, 1, 2, 3, 4, 5, 5, 5}, wild, {}},
        {3, {0, 0, 0, 0, 1, 1, 4, 5, 5, 5, 5}, wild, {}},
        // Knots that are not doubled at the ends.
        {3, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10}, wild, {}},
        {3, {0, 0, 0, 0, 1, 2, 3, 4, 4, 4, 4}, wild, {1, 2, 0.5, 3, 1, 1, 4}},
        {5, {0, 0, 0, 0, 0, 0, 1, 2, 2, 2, 2, 2, 2}, wild, {}},
        // A quarter of a circle of 50 mm.
        {2, {0, 0, 0, 1, 1, 1}, {{50, 0}, {50, 50}, {0, 50}}, {1, half, 1}},
    };
    for (const Nurbs& one : all) {
        const Traced read = entities(one.text());
        ASSERT_TRUE(read.tracing) << read.told << one.degree;
        const TracedLine& line = read.line();
        const double from = one.knots[static_cast<std::size_t>(one.degree)];
        const double to = one.knots[one.controls.size()];
        constexpr int kSteps = 2100;  // each knot is one of them
        TracedLine dense;
        for (int i = 0; i < kSteps; ++i) dense.points.push_back(one.at(from + (to - from) * i / kSteps));
        for (int i = 0; i < kSteps; i += 20)
            EXPECT_LT(to_line(dense.points[static_cast<std::size_t>(i)], line), 0.0101);
        // And no corner of it is elsewhere.
        for (const Vec2 p : line.points) {
            if (distance(p, line.points.back()) > 0.5) {
                EXPECT_LT(to_line(p, dense), 2e-3);
            }
        }
        expect_at(line.points.front(), one.at(from).x, one.at(from).y);
        const Vec2 end = one.at(to - 1e-12 * (to - from));
        expect_at(line.points.back(), end.x, end.y, 1e-5);
    }
    const Traced quarter = entities(all.back().text());
    EXPECT_LT(far_from_circle(quarter.line(), {0, 0}, 50), 1e-4);
}

TEST(DxfEntities, CubicSplinesStayCurves) {
    // Two Bézier curves: what a sheet writer may write as they are.
    const Traced one = entities(Nurbs{
        3,
        {0, 0, 0, 0, 1, 1, 1, 2, 2, 2, 2},
        {{0, 0}, {10, 30}, {40, -20}, {60, 10}, {80, 40}, {90, 0}, {100, 0}},
        {}}.text());
    ASSERT_TRUE(one.tracing) << one.told;
    const Restored whole = one.tracing->curves.restored(one.line().points, false, true);
    ASSERT_EQ(whole.steps.size(), 2U);
    EXPECT_TRUE(whole.steps[0].curve && whole.steps[1].curve);
    expect_at(whole.steps[0].control_1, 10, 30);
    expect_at(one.line().points.at(whole.steps[0].to), 60, 10);
}

TEST(DxfEntities, SplinesBeginAnewWhereKnotsSayIt) {
    const std::vector<Vec2> apart{{10, 10}, {20, 20}, {50, 20}, {60, 10}};
    const Traced lines = entities(Nurbs{1, {0, 0, 1, 1, 2, 2}, apart, {}}.text());
    ASSERT_TRUE(lines.tracing) << lines.told;
    ASSERT_EQ(lines.tracing->lines.size(), 2U);
    expect_at(lines.tracing->lines[0].points.back(), 20, 20);
    expect_at(lines.tracing->lines[1].points.front(), 50, 20);
    const std::vector<Vec2> curves{{0, 0}, {10, 30}, {20, 0}, {40, 0}, {50, 30}, {60, 0}};
    const Traced two = entities(Nurbs{2, {0, 0, 0, 1, 1, 1, 2, 2, 2}, curves, {}}.text());
    ASSERT_TRUE(two.tracing) << two.told;
    EXPECT_EQ(two.tracing->lines.size(), 2U);
    // One that goes on where it was is one line.
    const std::vector<Vec2> on{{0, 0}, {10, 30}, {20, 0}, {20, 0}, {50, 30}, {60, 0}};
    const Traced one = entities(Nurbs{2, {0, 0, 0, 1, 1, 1, 2, 2, 2}, on, {}}.text());
    ASSERT_TRUE(one.tracing) << one.told;
    EXPECT_EQ(one.tracing->lines.size(), 1U);
}

TEST(DxfEntities, SplinesThroughPointsGoThroughThem) {
    const Traced open =
        entities("0 SPLINE|8 0|70 8|71 3|74 4|11 0|21 0|11 20|21 30|11 50|21 25|11 80|21 0|12 0|22 1");
    ASSERT_TRUE(open.tracing) << open.told;
    for (const Vec2 p : {Vec2{0, 0}, {20, 30}, {50, 25}, {80, 0}}) EXPECT_LT(to_line(p, open.line()), 1e-5);
    const auto& points = open.line().points;
    // It sets out upwards.
    EXPECT_LT(std::abs(points[1].x), 0.2 * points[1].y);
    // A ring through the corners of a square is the same seen from each.
    const Traced ring = entities("0 SPLINE|8 0|70 1|71 3|74 4|11 10|21 0|11 0|21 10|11 -10|21 0|11 0|21 -10");
    ASSERT_TRUE(ring.tracing) << ring.told;
    EXPECT_TRUE(ring.line().closed);
    for (const Vec2 p : ring.line().points) EXPECT_LT(to_line(left_of(p), ring.line()), 0.0101);
    EXPECT_NEAR(swept_deg(ring.line(), {}), 360.0, 1e-6);
}

TEST(DxfEntities, MirroredOnesAreSeenFromBehind) {
    const Traced one = entities("0 LWPOLYLINE|8 0|90 2|70 0|10 10|20 5|42 1|10 30|20 5|210 0|220 0|230 -1");
    ASSERT_TRUE(one.tracing) << one.told;
    expect_at(one.line().points.front(), -10, 5);
    expect_at(one.line().points.back(), -30, 5);
    // Counter-clockwise from behind is clockwise from the front; below the chord all the same.
    EXPECT_NEAR(swept_deg(one.line(), {-20, 5}), -180.0, 1e-3);
    for (const Vec2 p : one.line().points) EXPECT_LT(p.y, 5.000001);
    // Lines do not heed it.
    const Traced line = entities("0 LINE|8 0|10 1|20 2|11 3|21 4|230 -1");
    ASSERT_TRUE(line.tracing) << line.told;
    expect_at(line.line().points[0], 1, 2);
    // What leans is not in the drawing's plane.
    const Traced leaning =
        entities("0 CIRCLE|8 0|10 1|20 2|40 3|210 1|220 0|230 0|0 LINE|8 0|10 1|20 2|11 3|21 4");
    ASSERT_TRUE(leaning.tracing);
    EXPECT_EQ(leaning.tracing->lines.size(), 1U);
    EXPECT_NE(leaning.told.find("1 tilted CIRCLE element is not cut"), std::string::npos) << leaning.told;
}

TEST(DxfEntities, OthersAreToldOnceAKind) {
    const Traced one = entities(
        "0 TEXT|8 0|10 0|20 0|40 5|1 Hello|0 TEXT|8 0|10 0|20 9|40 5|1 you|0 HATCH|8 0|10 0|20 0|0 LINE|8 "
        "0|10 1|20 "
        "2|11 3|21 4");
    ASSERT_TRUE(one.tracing);
    EXPECT_EQ(one.tracing->lines.size(), 1U);
    EXPECT_NE(one.told.find("1 HATCH element is not cut"), std::string::npos) << one.told;
    EXPECT_NE(one.told.find("2 TEXT elements are not cut"), std::string::npos) << one.told;
}

}  // namespace
}  // namespace popup
