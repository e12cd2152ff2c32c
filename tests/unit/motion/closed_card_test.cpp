// The closed card: what sticks out of it, and how its plates lie on one another. Positions are known on
// paper: closed, a point at distance c from the gutter is c away from it, and every plate lies between the
// covers.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "support/designs.h"

namespace popup::test {
namespace {

constexpr double kDeg = std::numbers::pi / 180.0;

struct Closed {
    Built built;
    Examination found;
    [[nodiscard]] int plate(const std::string& name) const {
        const auto& plates = built.assembly->plates;
        for (std::size_t i = 0; i < plates.size(); ++i) {
            if (plates[i].name == name) return static_cast<int>(i);
        }
        ADD_FAILURE() << "no plate " << name;
        return 0;
    }
    [[nodiscard]] std::map<std::string, Protrusion> protrusions() const {
        std::map<std::string, Protrusion> result;
        for (const Protrusion& one : found.closed.protrusions) {
            result[built.assembly->plates[static_cast<std::size_t>(one.plate)].name] = one;
        }
        return result;
    }
    // Where a plate stands in the order; fails the test when there is none.
    [[nodiscard]] long place(const std::string& name) const {
        if (!found.closed.order) {
            ADD_FAILURE() << "no order";
            return 0;
        }
        const auto& order = *found.closed.order;
        return std::find(order.begin(), order.end(), plate(name)) - order.begin();
    }
};

Closed closed(const Design& design, const MotionOptions& options = {}) {
    Closed result{build(design), {}};
    if (result.built.assembly) result.found = examine(*result.built.assembly, options);
    return result;
}

std::vector<Vec2> tent(double y, double half_base, double half_width, double half_length = 10.0) {
    return {{-half_base, y - half_length}, {-half_base, y + half_length}, {half_base, y - half_length},
            {half_base, y + half_length},  {-half_width, -half_length},   {-half_width, half_length},
            {half_width, -half_length},    {half_width, half_length}};
}

// A tent's ridge is p + s from the gutter on the closed card.
TEST(ClosedCard, TentThatIsTooHighSticksOutOppositeTheGutterByWhatItIsTooHigh) {
    Design design = card(200, 150);
    add(design, "tent", tent(0, 30, 82.5));
    const Closed card = closed(design);
    const auto out = card.protrusions();
    ASSERT_EQ(out.size(), 2u);
    for (const std::string name : {"e1/left", "e1/right"}) {
        EXPECT_NEAR(out.at(name).by_mm, 30 + 82.5 - 100, 1e-6);
        EXPECT_NEAR(out.at(name).direction.z, 1.0, 1e-9);
        EXPECT_NEAR(out.at(name).point.z, 112.5, 1e-6);
    }
}

TEST(ClosedCard, WhatReachesExactlyToTheEdgeDoesNotStickOut) {
    Design design = card(200, 150);
    add(design, "tent", tent(0, 30, 70));
    EXPECT_TRUE(closed(design).found.closed.protrusions.empty());
    Design more = card(200, 150);
    add(more, "tent", tent(0, 30, 70.03));
    EXPECT_EQ(closed(more).protrusions().size(), 2u);
}

// A v-fold's centre fold lies at a + g from the gutter's direction on the closed card.
TEST(ClosedCard, VFoldThatLeansBackSticksOutAtTheBottomAndItsInverseAtTheTop) {
    for (const double way : {1.0, -1.0}) {
        const double a = 50;
        const double g = 60;
        const double apex = -40 * way;
        const Vec2 seam{-30 * std::sin(a * kDeg), apex + way * 30 * std::cos(a * kDeg)};
        const Vec2 own{-30 * std::sin(g * kDeg), 30 * std::cos(g * kDeg)};
        Design design = card(300, 150);
        add(design, way > 0 ? "v-fold" : "inverted-v-fold",
            {seam, {0, apex}, {-seam.x, seam.y}, own, {0, 0}, {-own.x, own.y}, {0.5, 120}, {-0.5, 120}});
        const auto out = closed(design).protrusions();
        ASSERT_EQ(out.size(), 2u);
        const Protrusion& left = out.at("e1/left");
        EXPECT_NEAR(left.by_mm, 40 - 120 * std::cos((a + g) * kDeg) - 75, 1e-6);
        EXPECT_NEAR(left.direction.y, -way, 1e-9);
    }
}

TEST(ClosedCard, TentLiesInFourLayers) {
    Design design = card(200, 150);
    add(design, "tent", tent(0, 30, 50));
    const Closed card = closed(design);
    EXPECT_EQ(card.found.closed.max_layers, 4);
    EXPECT_LT(card.place("page/left"), card.place("e1/left"));
    EXPECT_LT(card.place("e1/left"), card.place("e1/right"));
    EXPECT_LT(card.place("e1/right"), card.place("page/right"));
    EXPECT_FALSE(card.found.closed.thickness_mm.has_value());
    MotionOptions options;
    options.paper_mm = 0.25;
    EXPECT_DOUBLE_EQ(closed(design, options).found.closed.thickness_mm.value(), 1.0);
    EXPECT_EQ(closed(::popup::test::card(200, 150)).found.closed.max_layers, 2);
}

// Counts and heights at points of the card, by nothing but the plates' outlines and frames.
TEST(ClosedCard, LayersAgreeWithCountingAtManyPoints) {
    int ordered = 0;
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        const Design design = generate(seed, 2 + static_cast<int>(seed % 9));
        const Closed card = closed(design);
        const Assembly& assembly = *card.built.assembly;
        std::vector<Frame> frames(assembly.plates.size());
        ASSERT_TRUE(popup::place(assembly, Angle::degrees(0.01), frames));
        // Plates over a point (z, y), with their heights.
        const auto over = [&](Vec3 p) {
            std::vector<std::pair<double, int>> plates;
            for (std::size_t i = 0; i < frames.size(); ++i) {
                const Vec3 n = frames[i].normal();
                const double x = (dot(n, frames[i].origin) - n.y * p.y - n.z * p.z) / n.x;
                const Vec3 d = Vec3{x, p.y, p.z} - frames[i].origin;
                const Vec2 at{dot(frames[i].axes[0], d), dot(frames[i].axes[1], d)};
                if (contains(assembly.plates[i].outline, at)) plates.emplace_back(x, static_cast<int>(i));
            }
            std::sort(plates.begin(), plates.end());
            return plates;
        };
        const ClosedCard& found = card.found.closed;
        EXPECT_EQ(static_cast<int>(over(found.thickest).size()), found.max_layers) << "seed " << seed;
        std::vector<long> place(frames.size());
        for (std::size_t i = 0; found.order && i < place.size(); ++i)
            place[static_cast<std::size_t>((*found.order)[i])] = static_cast<long>(i);
        if (found.order) ++ordered;
        for (int k = 0; k < 4000; ++k) {
            // Spread evenly over the card, never on a line twice.
            const Vec3 p{0, -107 + 214 * std::fmod(0.5 + k * 0.7548776662466927, 1.0),
                         0.5 + 138 * std::fmod(0.5 + k * 0.5698402909980532, 1.0)};
            const auto plates = over(p);
            EXPECT_LE(static_cast<int>(plates.size()), found.max_layers) << "seed " << seed;
            for (std::size_t i = 1; found.order && i < plates.size(); ++i) {
                if (plates[i].first - plates[i - 1].first < 1e-7) continue;
                EXPECT_LT(place[static_cast<std::size_t>(plates[i - 1].second)],
                          place[static_cast<std::size_t>(plates[i].second)])
                    << "seed " << seed << ": "
                    << assembly.plates[static_cast<std::size_t>(plates[i - 1].second)].name << " "
                    << assembly.plates[static_cast<std::size_t>(plates[i].second)].name;
            }
        }
    }
    EXPECT_GE(ordered, 10);
}

// A plate of the world that turns like the left page (way -1) or the right one about an axis `x` beside the
// gutter. Its corners are given by their distance from the axis, and along it.
void add_cover(Assembly& assembly, const std::string& name, double way, double x, Ring ring) {
    Plate plate;
    plate.name = name;
    for (Vec2& p : ring) p = {x + way * p.x, p.y};
    if (signed_area(ring) < 0.0) std::reverse(ring.begin(), ring.end());
    plate.outline.outer = plate.uncut = ring;
    plate.pivot = {x, 0};
    plate.piece = 0;
    const int number = static_cast<int>(assembly.plates.size());
    assembly.joints.push_back({name,
                               {static_cast<int>(assembly.joints.size()) + 10, 3},
                               Drive{number, {x, 0}, {0, 1}, way < 0.0 ? -1 : 1}});
    assembly.plates.push_back(plate);
    assembly.covers.push_back(number);
}

// Three plates of which each lies over the next: "a" over "b" near the gutter, where b has not risen yet, "b"
// over "c" far from it, and "c" over "a", both of which sink alike.
TEST(ClosedCard, PlatesThatLieRoundInARingHaveNoOrder) {
    Assembly assembly;
    assembly.pieces.push_back({"page", {0, 1, 2}});
    add_cover(assembly, "a", -1, 0.006, {{10, 0}, {60, 0}, {60, 10}, {10, 10}});
    add_cover(assembly, "b", 1, 0.0,
              {{15, -20}, {25, -20}, {25, 12}, {85, 12}, {85, -20}, {95, -20}, {95, 20}, {15, 20}});
    add_cover(assembly, "c", -1, 0.007, {{45, 0}, {100, 0}, {100, 10}, {45, 10}});
    const Examination found = examine(assembly, {});
    EXPECT_FALSE(found.closed.order.has_value());
    ASSERT_EQ(found.closed.cycle.size(), 3u);
    // Each lies below the next: a below c, c below b, b below a.
    const auto next = [&](int plate) {
        const auto at = std::find(found.closed.cycle.begin(), found.closed.cycle.end(), plate);
        return at + 1 == found.closed.cycle.end() ? found.closed.cycle.front() : *(at + 1);
    };
    EXPECT_EQ(next(0), 2);
    EXPECT_EQ(next(2), 1);
    EXPECT_EQ(next(1), 0);
    Diagnostics diagnostics;
    ASSERT_TRUE(simulate(assembly, {}, diagnostics)) << findings(diagnostics);
    EXPECT_NE(findings(diagnostics)
                  .find("warning layer-order: the closed card has no order of layers: \"a\" lies "
                        "under \"c\", which lies under \"b\", and that under the first again"),
              std::string::npos)
        << findings(diagnostics);
}

}  // namespace
}  // namespace popup::test
