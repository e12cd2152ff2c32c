// Outlines across a fold that nobody would draw: curves, near tangents, stretches that lie on one another,
// lines that cross themselves. Seeded, so that a failure comes again.
//
// Whatever is drawn, it is refused with a reason, or what comes of it shares the page out: the plates have
// the page's area, by rational numbers, and nothing in common, by Boost.Geometry; what was cut has the area
// that Boost.Geometry finds between the two side folds.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <string>
#include <string_view>

#include "mechanism/border.h"
#include "popup/check.h"
#include "support/designs.h"
#include "support/paper_balance.h"
#include "support/random.h"
#include "support/sanitized.h"

namespace popup {
namespace {

using test::Random;
using test::sanitized_count;

constexpr double kPage = 200.0 * 150.0;

// Points on a coarse grid lie on one another, on the fold and on levels of others more often than not.
double coordinate(Random& random, double most, bool coarse) {
    const double value = (2.0 * random.unit() - 1.0) * most;
    return coarse ? std::round(value / 5.0) * 5.0 : value;
}

std::string random_outline(Random& random) {
    const bool coarse = random.below(2) == 0;
    const std::size_t corners = 3 + random.below(9);
    const bool round = random.below(3) != 0;
    std::string d;
    Vec2 first;
    Vec2 at;
    const auto write = [&](Vec2 p) { return fmt::format("{:.6g} {:.6g} ", p.x, p.y); };
    for (std::size_t i = 0; i <= corners; ++i) {
        Vec2 to = first;
        if (i < corners) {
            const double turn =
                2.0 * 3.141592653589793 * static_cast<double>(i) / static_cast<double>(corners);
            const double reach = 15.0 + 30.0 * random.unit();
            to = round ? Vec2{reach * std::cos(turn), reach * std::sin(turn)}
                       : Vec2{coordinate(random, 50, coarse), coordinate(random, 50, coarse)};
            if (round && coarse) to = {std::round(to.x / 5.0) * 5.0, std::round(to.y / 5.0) * 5.0};
        }
        const auto near = [&](double t) {
            const double off = random.below(4) == 0 ? 1e-3 : 20.0;
            return lerp(at, to, t) + Vec2{coordinate(random, off, false), coordinate(random, off, false)};
        };
        if (i == 0) {
            d += "M " + write(first = to);
        } else {
            switch (random.below(6)) {
                case 0:
                    d += "C " + write(near(0.3)) + write(near(0.7)) + write(to);
                    break;
                case 1:
                    d += "Q " + write(near(0.5)) + write(to);
                    break;
                case 2:  // back along the way it came, and on
                    d += "L " + write(to) + "L " + write(lerp(at, to, 0.5)) + "L " + write(to);
                    break;
                case 3:  // an arc, tangent to what comes next as likely as not
                    d += fmt::format("A {0:.6g} {0:.6g} 0 {1} {2} ", 5.0 + 40.0 * random.unit(),
                                     random.below(2), random.below(2)) +
                         write(to);
                    break;
                default:
                    d += "L " + write(to);
            }
        }
        at = to;
    }
    return d + "Z";
}

struct Tally {
    int accepted = 0, refused = 0, repaired = 0;
};

void look_at(std::uint64_t seed, Tally& tally) {
    Random random(seed);
    const std::string d = random_outline(random);
    const std::string folds = random.below(4) == 0 ? fmt::format("<folds top='{}' bottom='{}'/>",
                                                                 2 + random.below(30), 2 + random.below(30))
                                                   : std::string();
    const std::string parent = random.below(2) == 0
                                   ? "<parentfold><begin x='0' y='-75'/><end x='0' y='75'/></parentfold>"
                                   : std::string();
    const std::string again = random.below(3) == 0 ? "<structure type='freeform' id='g'><outline d='" +
                                                         random_outline(random) + "'/></structure>"
                                                   : std::string();
    SCOPED_TRACE(fmt::format("seed {}: {}", seed, d));
    const auto begin = std::chrono::steady_clock::now();
    const test::FromXml made = test::from_xml("<structure type='freeform' id='f'>" + folds + "<outline d='" +
                                              d + "'/>" + parent + "</structure>" + again);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    EXPECT_LT(took.count(), 1.0);
    if (!made.assembly) {
        ++tally.refused;
        EXPECT_NE(made.text.find("error "), std::string::npos);
        return;
    }
    ++tally.accepted;
    const test::Balance balance = test::balance_of(*made.assembly, 0);
    EXPECT_NEAR(balance.plates, kPage, 1e-5);
    EXPECT_LT(balance.overlap, 2e-3);
    if (made.text.find("outline-crosses") != std::string::npos) {
        ++tally.repaired;
        return;
    }
    if (!again.empty()) return;
    // Between the side folds, the part that lies over the fold.
    Path path;
    ASSERT_FALSE(parse_path(d, path));
    Border border;
    ASSERT_EQ(border_of(path.subpaths().at(0), border), FlatteningFault::none);
    double own = 0.0;
    double lo = 0.0;
    double hi = 0.0;
    for (const Plate& plate : made.assembly->plates) {
        if (!plate.name.starts_with("f/")) continue;
        own += area(plate.outline);
        for (const Vec2 p : plate.outline.outer) {
            if (p.x < lo) lo = p.x;
            if (p.x > hi) hi = p.x;
        }
    }
    // The stretch of the gutter that was cut away.
    double from = -75.0;
    double to = 75.0;
    for (const Line& line : made.assembly->lines) {
        if (line.kind != LineKind::valley || line.plate != 0 || line.other_plate != 1) continue;
        const auto [low, high] = std::minmax(line.at.a.y, line.at.b.y);
        (low <= from + 1e-9 ? from : to) = low <= from + 1e-9 ? high : low;
    }
    test::BoostPolygons parts;
    const Polygon band{{{lo, -200}, {hi, -200}, {hi, 200}, {lo, 200}}, {}};
    test::BoostPolygon outline = test::boost_polygon({ring_of(border), {}});
    test::bg::remove_spikes(outline);
    test::bg::intersection(outline, test::boost_polygon(band), parts);
    double wanted = 0.0;
    for (const auto& part : parts) {
        if (test::bg::within(test::BoostXy(0.0, 0.5 * (from + to)), part)) wanted = test::bg::area(part);
    }
    // Corners that were put on curves lie up to 0.01 mm beside the chords.
    EXPECT_NEAR(own, wanted, 0.5);
}

TEST(OutlineFuzz, WhatIsCutFromOneSheetSharesItOut) {
    Tally tally;
    const auto last = sanitized_count<std::uint64_t>(2000);
    for (std::uint64_t seed = 1; seed <= last; ++seed) look_at(seed, tally);
    EXPECT_GT(tally.accepted, sanitized_count(300));
    EXPECT_GT(tally.repaired, sanitized_count(50));
    EXPECT_GT(tally.refused, sanitized_count(300));
}

// Silhouettes of pieces whose seams have no length, or lie in one another.
TEST(OutlineFuzz, PiecesOfPointsThatCoincideAreRefusedOrMended) {
    const auto last = sanitized_count<std::uint64_t>(2000);
    int refused = 0;
    for (std::uint64_t seed = 1; seed <= last; ++seed) {
        Random random(seed);
        constexpr std::array<std::string_view, 4> kTypes{"v-fold", "inverted-v-fold", "tent", "layer"};
        // Few places, so that many points have the same.
        const double most = random.below(3) == 0 ? 0.0 : 20.0;
        std::string points;
        for (int i = 0; i < 8; ++i) {
            const double x = std::round(coordinate(random, most, true) / 20.0) * 20.0;
            const double y = std::round(coordinate(random, most, true) / 20.0) * 20.0;
            points += fmt::format("<point x=\"{}\" y=\"{}\"/>", x, y);
        }
        const test::FromXml made = test::from_xml(
            fmt::format("<structure type=\"{}\" id=\"t\" outline=\"{}\"><outerpoints>{}</outerpoints>"
                        "<parentfold on=\"gutter\"/></structure>",
                        kTypes[random.below(kTypes.size())], random_outline(random), points));
        if (made.assembly) continue;
        EXPECT_NE(made.text, "") << seed;
        ++refused;
    }
    EXPECT_GT(refused, static_cast<int>(last / 2));
}

TEST(LongOutlineFuzz, WhatIsCutFromOneSheetSharesItOut) {
    Tally tally;
    for (std::uint64_t seed = 10'001; seed <= 40'000; ++seed) look_at(seed, tally);
    EXPECT_GT(tally.accepted, 3000);
}

}  // namespace
}  // namespace popup
