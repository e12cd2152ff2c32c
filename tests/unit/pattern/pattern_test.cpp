#include "popup/pattern.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>

#include "base/nth.h"
#include "pattern/tabs.h"
#include "support/designs.h"
#include "support/prints.h"
#include "unit/pattern/hand_made_card.h"

namespace popup {
namespace {

using test::sides_of;
using Card = test::HandMadeCard;

constexpr double kPi = 3.14159265358979323846;

double number(std::mt19937& random, double low, double high) {
    return low + (high - low) * (static_cast<double>(random()) / 4294967295.0);
}

// ---- checks that use nothing of the code under test
// -------------------------------------------------------------

bool strictly_crosses(const Segment& s, const Segment& t) {
    const auto side = [](const Segment& line, Vec2 p) {
        return cross(line.b - line.a, p - line.a) / distance(line.a, line.b);
    };
    constexpr double kFar = 1e-5;
    const double a = side(s, t.a);
    const double b = side(s, t.b);
    const double c = side(t, s.a);
    const double d = side(t, s.b);
    return ((a > kFar && b < -kFar) || (a < -kFar && b > kFar)) &&
           ((c > kFar && d < -kFar) || (c < -kFar && d > kFar));
}

bool is_simple(const Ring& ring) {
    const auto all = sides_of(ring);
    for (std::size_t i = 0; i < all.size(); ++i) {
        for (std::size_t j = i + 2; j < all.size(); ++j) {
            if (i == 0 && j + 1 == all.size()) continue;
            if (distance(all[i], all[j]) < 1e-6) return false;
        }
    }
    return ring.size() >= 3 && std::abs(signed_area(ring)) > 0.01;
}

bool overlap(const Ring& a, const Ring& b) {
    for (const Segment& s : sides_of(a)) {
        for (const Segment& t : sides_of(b)) {
            if (strictly_crosses(s, t)) return true;
        }
    }
    const auto inside = [](const Ring& ring, Vec2 p) {
        double off = HUGE_VAL;
        for (const Segment& s : sides_of(ring)) off = std::min(off, distance(p, s));
        return contains({ring, {}}, p) && off > 1e-4;
    };
    return std::any_of(a.begin(), a.end(), [&](Vec2 p) { return inside(b, p); }) ||
           std::any_of(b.begin(), b.end(), [&](Vec2 p) { return inside(a, p); });
}

// The part of an edge on the tab's side of its seam: what lies behind the seam is no concern of the tab's.
std::optional<Segment> beside(const Segment& edge, const Segment& seam) {
    const Vec2 out = right_of(unit(seam.b - seam.a));
    Segment s = edge;
    double a = dot(s.a - seam.a, out);
    double b = dot(s.b - seam.a, out);
    if (std::max(a, b) < 2e-3) return std::nullopt;
    if (a < 0) s.a = lerp(s.a, s.b, a / (a - b));
    if (b < 0) s.b = lerp(s.b, s.a, b / (b - a));
    return s;
}

std::map<std::string, std::vector<const GlueTarget*>> targets_by_plate(const Pattern& pattern) {
    std::map<std::string, std::vector<const GlueTarget*>> result;
    for (const PatternPiece& piece : pattern.pieces) {
        for (const GlueTarget& target : piece.targets) {
            result[pattern.plate_names.at(static_cast<std::size_t>(target.plate))].push_back(&target);
        }
    }
    return result;
}

// Which glue a target belongs to: the one whose seam it stands on.
const Glue* glue_of(const Assembly& assembly, const GlueTarget& target) {
    for (const Glue& glue : assembly.glue) {
        if (glue.base_plate != target.plate) continue;
        int touching = 0;
        for (const Vec2 p : target.outline) touching += distance(p, glue.on_base) < 1e-5 ? 1 : 0;
        if (touching >= 2) return &glue;
    }
    return nullptr;
}

void expect_targets_in_order(const Assembly& assembly, const Pattern& pattern) {
    for (const auto& [name, targets] : targets_by_plate(pattern)) {
        for (std::size_t i = 0; i < targets.size(); ++i) {
            const Ring& ring = targets[i]->outline;
            EXPECT_TRUE(is_simple(ring));
            EXPECT_GT(signed_area(ring), 0.0);
            const Polygon& plate = assembly.plates[static_cast<std::size_t>(targets[i]->plate)].outline;
            for (const Vec2 p : ring) EXPECT_TRUE(contains(plate, p)) << name << " " << p.x << " " << p.y;
            const Glue* glue = glue_of(assembly, *targets[i]);
            ASSERT_NE(glue, nullptr);
            std::vector<Segment> all = sides_of(plate.outer);
            for (const Ring& hole : plate.holes) {
                const auto more = sides_of(hole);
                all.insert(all.end(), more.begin(), more.end());
            }
            for (const Segment& edge : all) {
                const auto near = beside(edge, glue->on_base);
                if (!near) continue;
                for (const Segment& own : sides_of(ring)) EXPECT_GE(distance(own, *near), 0.999) << name;
            }
            for (std::size_t j = 0; j < i; ++j) {
                EXPECT_FALSE(overlap(ring, targets[j]->outline)) << name;
                if (glue_of(assembly, *targets[j]) == glue) continue;  // parts of one tab
                for (const Segment& edge : sides_of(targets[j]->outline)) {
                    const auto near = beside(edge, glue->on_base);
                    if (!near) continue;
                    for (const Segment& own : sides_of(ring)) EXPECT_GE(distance(own, *near), 0.999) << name;
                }
            }
        }
    }
}

void expect_tabs_clear_of_paper(const Assembly& assembly, const Pattern& pattern) {
    for (std::size_t i = 0; i < pattern.pieces.size(); ++i) {
        const PatternPiece& piece = pattern.pieces[i];
        // All cuts and seams of a piece, two by two: none crosses another.
        std::vector<Segment> all;
        for (const Contour& contour : piece.cuts) {
            const auto own = sides_of(contour);
            all.insert(all.end(), own.begin(), own.end());
        }
        for (const PatternLine& line : piece.lines) all.push_back(line.at);
        for (std::size_t a = 0; a < all.size(); ++a) {
            for (std::size_t b = 0; b < a; ++b) EXPECT_FALSE(strictly_crosses(all[a], all[b])) << piece.name;
        }
        if (assembly.pieces[i].plates.size() != 2 || i == 0) continue;
        // The cut outline holds exactly the plates and the tabs.
        double paper = 0.0;
        for (const int plate : assembly.pieces[i].plates) {
            paper += area(assembly.plates[static_cast<std::size_t>(plate)].outline);
        }
        for (const PatternPiece& other : pattern.pieces) {
            for (const GlueTarget& target : other.targets) {
                const Glue* glue = glue_of(assembly, target);
                const auto plate = static_cast<std::size_t>(glue->piece_plate);
                if (assembly.plates[plate].piece == static_cast<int>(i)) paper += signed_area(target.outline);
            }
        }
        ASSERT_EQ(piece.cuts.size(), 1U) << piece.name;
        EXPECT_TRUE(piece.cuts[0].closed);
        EXPECT_NEAR(signed_area(piece.cuts[0].points), paper, 1e-4) << piece.name;
        ASSERT_EQ(piece.silhouette.size(), 1U);
        EXPECT_NEAR(area(piece.silhouette[0]), paper, 1e-2) << piece.name;
    }
}

// ---- tabs
// -------------------------------------------------------------------------------------------------------

TEST(Pattern, AVFoldHasOneClosedOutlineWithTabsAndNumberedTargets) {
    Card card;
    card.v_fold(-30, 60, 50 * kPi / 180, 70 * kPi / 180, 40);
    const Pattern pattern = card.pattern();
    EXPECT_FALSE(card.diagnostics.has_findings());
    ASSERT_EQ(pattern.pieces.size(), 2U);
    ASSERT_EQ(pattern.pieces[0].cuts.size(), 1U);
    EXPECT_EQ(pattern.pieces[0].cuts[0].points.size(), 4U);
    ASSERT_EQ(pattern.pieces[1].cuts.size(), 1U);
    expect_targets_in_order(card.assembly, pattern);
    expect_tabs_clear_of_paper(card.assembly, pattern);

    std::multiset<std::string> on_tabs;
    std::multiset<std::string> on_targets;
    for (const PatternPiece& piece : pattern.pieces) {
        for (const Label& label : piece.labels) {
            if (label.kind == LabelKind::tab) on_tabs.insert(label.text);
            if (label.kind == LabelKind::target) on_targets.insert(label.text);
            EXPECT_GE(label.height_mm, 1.5);
            EXPECT_LE(label.height_mm, 5.0);
            EXPECT_GT(label.angle, -kPi / 2 - 1e-9);
            EXPECT_LE(label.angle, kPi / 2 + 1e-9);
        }
    }
    EXPECT_EQ(on_tabs, (std::multiset<std::string>{"1L", "1R"}));
    EXPECT_EQ(on_targets, on_tabs);
}

TEST(Pattern, TheTargetIsTheTabMirrored) {
    Card card;
    card.v_fold(-30, 60, 50 * kPi / 180, 70 * kPi / 180, 40);
    const Pattern pattern = card.pattern();
    for (const GlueTarget& target : pattern.pieces[0].targets) {
        const Glue* glue = glue_of(card.assembly, target);
        ASSERT_NE(glue, nullptr);
        // A mirrored point keeps its distances to the seam's ends; each must be a corner of the piece's
        // outline.
        for (const Vec2 p : target.outline) {
            bool found = false;
            for (const Vec2 q : pattern.pieces[1].cuts[0].points) {
                found =
                    found || (std::abs(distance(p, glue->on_base.a) - distance(q, glue->on_piece.a)) < 1e-5 &&
                              std::abs(distance(p, glue->on_base.b) - distance(q, glue->on_piece.b)) < 1e-5);
            }
            EXPECT_TRUE(found) << p.x << " " << p.y;
        }
    }
}

TEST(Pattern, AnUntrimmedTabIsTenDeepWithEndsOffBy30Degrees) {
    const double taper = 30 * kPi / 180;
    const auto parts = trimmed_tab(50, {10, taper, 1}, {}, {});
    ASSERT_EQ(parts.size(), 1U);
    ASSERT_EQ(parts[0].size(), 4U);
    const double inset = 10 * std::tan(taper);
    const Ring expected{{0, 0}, {50, 0}, {50 - inset, 10}, {inset, 10}};
    for (std::size_t i = 0; i < 4; ++i) EXPECT_LT(distance(parts[0][i], expected[i]), 1e-9);
}

TEST(Pattern, AShortSeamHasAProperTabThatIsLessDeep) {
    for (const double seam : {1.5, 3.0, 6.0, 11.0}) {
        const auto parts = trimmed_tab(seam, {10, 30 * kPi / 180, 1}, {}, {});
        ASSERT_EQ(parts.size(), 1U) << seam;
        EXPECT_TRUE(is_simple(parts[0]));
        EXPECT_GT(bounds(parts[0]).height(), 0.3 * seam);
        EXPECT_LE(bounds(parts[0]).width(), seam + 1e-9);
    }
}

TEST(Pattern, SeamsAreDrawnOnceAndAreNoCuts) {
    Card card;
    card.v_fold(-30, 60, 50 * kPi / 180, 70 * kPi / 180, 40);
    const Pattern pattern = card.pattern();
    double seams = 0.0;
    for (const PatternLine& line : pattern.pieces[1].lines) {
        if (line.kind != LineKind::seam) continue;
        seams += distance(line.at.a, line.at.b);
        for (const Segment& cut : sides_of(pattern.pieces[1].cuts[0])) {
            // The middle of a seam is never on a cut.
            EXPECT_GT(distance(lerp(line.at.a, line.at.b, 0.5), cut), 0.1);
        }
    }
    // Each tab keeps 1 mm off the gutter, measured across the fold; that much of the seam is a cut instead.
    EXPECT_NEAR(seams, 2 * (60 - 1 / std::sin(50 * kPi / 180)), 0.05);
}

TEST(Pattern, TabsOfRandomDesignsCrossNothing) {
    std::mt19937 random(42);
    int trimmed = 0;
    for (int round = 0; round < 60; ++round) {
        Card card;
        const int holes = static_cast<int>(random() % 4);
        for (int i = 0; i < holes; ++i) {
            const bool right = random() % 2 == 0;
            const double x = (right ? 1 : -1) * number(random, 10, 80);
            const double y = number(random, -60, 60);
            const double w = number(random, 1, 8);
            const double h = number(random, 1, 8);
            card.assembly.plates[right ? 1 : 0].outline.holes.push_back(
                {{x - w, y - h}, {x - w, y + h}, {x + w, y + h}, {x + w, y - h}});
            if (i > 0) card.assembly.plates[right ? 1 : 0].outline.holes.pop_back();  // they must not overlap
        }
        const int count = 1 + static_cast<int>(random() % 5);
        for (int i = 0; i < count; ++i) {
            card.v_fold(number(random, -70, 20), number(random, 8, 55), number(random, 15, 80) * kPi / 180,
                        number(random, 85, 150) * kPi / 180, number(random, 10, 60));
        }
        const Pattern pattern = card.pattern();
        expect_targets_in_order(card.assembly, pattern);
        expect_tabs_clear_of_paper(card.assembly, pattern);
        trimmed += static_cast<int>(card.diagnostics.has_findings());
        Diagnostics judged;
        judge_tabs(card.assembly, {}, judged);
        EXPECT_EQ(test::findings(judged), test::findings(card.diagnostics));
        if (HasFailure()) FAIL() << "round " << round;
    }
    EXPECT_GT(trimmed, 5);
}

TEST(Pattern, GeneratedDesignsOfAllElementsUnfoldSoundly) {
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        const auto built = test::build(test::generate(seed, 4 + static_cast<int>(seed % 20)));
        ASSERT_TRUE(built.assembly.has_value());
        Diagnostics diagnostics;
        const auto pattern = make_pattern(*built.assembly, {}, diagnostics);
        ASSERT_TRUE(pattern.has_value());
        expect_targets_in_order(*built.assembly, *pattern);
        for (const PatternPiece& piece : pattern->pieces) {
            std::vector<Segment> all;
            double within = 0.0;
            for (const Contour& contour : piece.cuts) {
                const auto own = sides_of(contour);
                all.insert(all.end(), own.begin(), own.end());
                if (contour.closed) within += signed_area(contour.points);
            }
            for (const PatternLine& line : piece.lines) {
                if (line.kind != LineKind::seam) all.push_back(line.at);  // seams of two elements may cross
            }
            for (std::size_t a = 0; a < all.size(); ++a) {
                for (std::size_t b = 0; b < a; ++b)
                    EXPECT_FALSE(strictly_crosses(all[a], all[b])) << piece.name;
            }
            // The last contour is the piece's edge, and what all of them enclose is its paper.
            ASSERT_FALSE(piece.cuts.empty());
            EXPECT_TRUE(piece.cuts.back().closed);
            ASSERT_EQ(piece.silhouette.size(), 1U);
            EXPECT_NEAR(area(piece.silhouette[0]), within, 0.02) << piece.name;
        }
        if (HasFailure()) FAIL() << "seed " << seed;
    }
}

// Even-odd, of points that are off the edges.
bool is_on_paper(const Polygon& plate, Vec2 at) {
    bool in = false;
    const auto count = [&](const Ring& ring) {
        for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
            const Vec2 a = ring[i];
            const Vec2 b = ring[j];
            if ((a.y > at.y) != (b.y > at.y) && at.x < a.x + (at.y - a.y) / (b.y - a.y) * (b.x - a.x))
                in = !in;
        }
    };
    count(plate.outer);
    for (const Ring& hole : plate.holes) count(hole);
    return in;
}

TEST(Pattern, SeamsLieOnThePaperThatTheyAreGluedTo) {
    constexpr double kBeside = 0.02;  // either side will do: seams may lie along folds
    int seams = 0;
    for (std::uint64_t seed = 1; seed <= 150; ++seed) {
        const auto built =
            test::build(seed % 3 == 0 ? test::generate(seed, 16) : test::generate_any(seed, 20));
        ASSERT_TRUE(built.assembly.has_value());
        for (const Glue& glue : built.assembly->glue) {
            ++seams;
            const Segment& seam = glue.on_base;
            const Vec2 aside = kBeside * left_of(unit(seam.b - seam.a));
            const Polygon& plate = nth(built.assembly->plates, glue.base_plate).outline;
            for (int i = 1; i < 20; ++i) {
                const Vec2 at = seam.a + (i / 20.0) * (seam.b - seam.a);
                EXPECT_TRUE(is_on_paper(plate, at + aside) || is_on_paper(plate, at - aside))
                    << "seed " << seed << ", tab " << glue.label << " of " << glue.element;
            }
        }
    }
    EXPECT_GT(seams, 1000);
}

TEST(Pattern, ATabWithTooLittleLeftIsAWarningThatNamesIt) {
    Card card;
    card.v_fold(-30, 60, 4 * kPi / 180, 70 * kPi / 180, 40);  // so close to the gutter that no depth is left
    const Pattern pattern = card.pattern();
    const auto found = card.diagnostics.sorted();
    ASSERT_EQ(found.size(), 2U);
    EXPECT_EQ(found[0].code, "tab-too-small");
    EXPECT_EQ(found[0].severity, Severity::warning);
    EXPECT_EQ(found[0].element, "v1");
    EXPECT_EQ(found[0].place, (Place{7, 3}));
    EXPECT_NE(found[0].message.find("1L"), std::string::npos);
    EXPECT_NE(found[0].message.find("60.00 mm"), std::string::npos);
    EXPECT_FALSE(found[0].hints.empty());
    expect_tabs_clear_of_paper(card.assembly, pattern);
}

TEST(Pattern, ATabIsNotGluedWhereThereIsNoPaper) {
    Card card;
    card.v_fold(-30, 60, 50 * kPi / 180, 70 * kPi / 180, 40);
    // The left plate ends at the seam, and lies on its other side.
    const Segment seam = card.assembly.glue[0].on_base;
    card.assembly.plates[0].outline.outer = {{-100, -80}, {0, -80}, seam.a, seam.b, {-100, 80}};
    const Pattern pattern = card.pattern();
    for (const GlueTarget& target : pattern.pieces[0].targets) EXPECT_EQ(target.plate, 1);
    EXPECT_TRUE(card.diagnostics.has_findings());
}

TEST(Pattern, ATabOnTheEdgeOfItsPlateKeepsItsSeam) {
    Card card;
    card.v_fold(-30, 60, 50 * kPi / 180, 70 * kPi / 180, 40);
    const Segment seam = card.assembly.glue[0].on_base;
    // The plate begins at the seam and lies on the tab's side.
    card.assembly.plates[0].outline.outer = {seam.a, {0, 80}, {-100, 80}, seam.b};
    const Pattern pattern = card.pattern();
    EXPECT_FALSE(card.diagnostics.has_findings());
    EXPECT_EQ(pattern.pieces[0].targets.size(), 2U);
    expect_targets_in_order(card.assembly, pattern);
}

TEST(Pattern, AnObstacleUnderTheMiddleSplitsATab) {
    const std::vector<Segment> post{{{25, -2}, {25, 5}}};
    const auto parts = trimmed_tab(50, {10, 0.5, 1}, post, {});
    ASSERT_EQ(parts.size(), 2U);
    for (const Ring& part : parts) {
        EXPECT_TRUE(is_simple(part));
        for (const Segment& edge : sides_of(part)) EXPECT_GE(distance(edge, post[0]), 0.999);
    }
    EXPECT_NEAR(seam_stretches(parts)[0].to, 24.0, 1e-3);
    EXPECT_NEAR(seam_stretches(parts)[1].from, 26.0, 1e-3);
    EXPECT_NEAR(length_with_depth(parts, 3.0), 50 - 2 - 2 * 3 * std::tan(0.5), 1e-3);
}

TEST(Pattern, AnObstacleThatIsAHairTooNearTakesAHair) {
    // Beside the seam's end, nearer than the gap by less than any machine keeps.
    for (int i = 0; i <= 200; ++i) {
        const double by = 1e-5 * i;
        for (const double taper : {0.0, 15 * kPi / 180, 30 * kPi / 180}) {
            const Ring full = full_tab(26, {10, taper, 1});
            for (const double x : {-1.0 + by, 27.0 - by}) {
                const auto parts =
                    trimmed_tab(26, {10, taper, 1}, std::vector<Segment>{{{x, -3}, {x, 16}}}, {});
                ASSERT_EQ(parts.size(), 1U) << by << ' ' << taper;
                EXPECT_NEAR(signed_area(parts[0]), signed_area(full), 0.05) << by << ' ' << taper;
            }
        }
    }
}

TEST(Pattern, SmallBumpsBetweenObstaclesAreCutOff) {
    // A row of needle tips: the bays between them are not worth their corners.
    std::vector<Segment> tips;
    for (int i = 0; i < 40; ++i) tips.push_back({{2.2 * i, 5}, {2.2 * i, 20}});
    const auto parts = trimmed_tab(80, {10, 0.5, 1}, tips, {});
    ASSERT_EQ(parts.size(), 1U);
    EXPECT_LE(parts[0].size(), 8U);
    EXPECT_GT(length_with_depth(parts, 3.9), 70);
    for (const Segment& edge : sides_of(parts[0])) {
        for (const Segment& tip : tips) EXPECT_GE(distance(edge, tip), 0.999);
    }
}

TEST(Pattern, WhatLiesBehindTheSeamTrimsNothing) {
    const std::vector<Segment> behind{{{-10, -0.3}, {60, -0.3}}, {{0, 0}, {50, 0}}, {{10, 0}, {10, -5}}};
    const auto parts = trimmed_tab(50, {10, 0.5, 1}, behind, behind);
    ASSERT_EQ(parts.size(), 1U);
    EXPECT_EQ(parts[0].size(), 4U);
}

TEST(Pattern, FillsStrokesAndPlateNamesAreCarried) {
    Card card;
    card.v_fold(-30, 60, 50 * kPi / 180, 70 * kPi / 180, 40);
    card.assembly.plates[2].prints.emplace_back(Stroke{{{0, 1}, {1, 2}}, 0.5, {}});
    const Pattern pattern = card.pattern();
    EXPECT_EQ(pattern.plate_names,
              (std::vector<std::string>{"page/left", "page/right", "v1/left", "v1/right"}));
    const PatternPiece& piece = pattern.pieces[1];
    const auto fills = test::prints_of<Area>(piece.prints);
    ASSERT_EQ(fills.size(), 2U);  // one plate, one tab
    EXPECT_EQ(fills[0].plate, 2);
    EXPECT_EQ(fills[1].plate, -1);
    EXPECT_EQ(fills[1].print.color, (Color{1, 2, 3}));
    const auto strokes = test::prints_of<Stroke>(piece.prints);
    ASSERT_EQ(strokes.size(), 1U);
    EXPECT_EQ(strokes[0].plate, 2);
}

TEST(Pattern, BoundsAreThoseOfTheBarePage) {
    Card card;
    const Pattern pattern = card.pattern();
    EXPECT_EQ(pattern.pieces[0].bounds.min, (Vec2{-100, -80}));
    EXPECT_EQ(pattern.pieces[0].bounds.max, (Vec2{100, 80}));
    ASSERT_EQ(pattern.pieces[0].silhouette.size(), 1U);
    EXPECT_EQ(pattern.pieces[0].silhouette[0].outer.size(), 4U);  // the gutter is not part of it
}

TEST(Pattern, LinesOfOneKindAreDrawnOnce) {
    Card card;
    card.assembly.lines.push_back({LineKind::valley, {{0, 80}, {0, -80}}, 0, 1, 0});
    card.assembly.lines.push_back({LineKind::valley, {{0, 10}, {0, 90}}, 0, 1, 0});
    card.assembly.lines.push_back({LineKind::mountain, {{5, 0}, {5, 9}}, 0, 1, 1});
    const Pattern pattern = card.pattern();
    ASSERT_EQ(pattern.pieces[0].lines.size(), 2U);
    double valley = 0.0;
    for (const PatternLine& line : pattern.pieces[0].lines) {
        if (line.kind == LineKind::valley) valley += distance(line.at.a, line.at.b);
    }
    EXPECT_DOUBLE_EQ(valley, 170.0);
}

}  // namespace
}  // namespace popup
