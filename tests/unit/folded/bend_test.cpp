// Sheets that cannot be folded with flat panels, shown with panels that bend.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "folded/path.h"
#include "folded/sheet.h"
#include "folded/step_plan.h"
#include "folded/work.h"
#include "popup/crease_pattern.h"
#include "popup/motion.h"
#include "support/designs.h"

namespace popup {
namespace {

constexpr double kPi = std::numbers::pi;

CreaseLine fold(Vec2 a, Vec2 b, bool mountain) {
    return {{a, b}, false, mountain ? CreaseUse::mountain : CreaseUse::valley, 90.0};
}

Ring circle(double radius, int corners) {
    Ring ring;
    for (int i = 0; i < corners; ++i) {
        const double at = 2.0 * kPi * i / corners;
        ring.push_back({radius * std::cos(at), radius * std::sin(at)});
    }
    return ring;
}

// A ring of paper with circles for folds, mountains and valleys in turn.
CreasePattern circles(int folds, int corners) {
    CreasePattern pattern;
    for (int k = 0; k <= folds + 1; ++k) {
        const Ring ring = circle(20.0 + 10.0 * k, corners);
        if (k == 0 || k == folds + 1) {
            pattern.lines.push_back({ring, true, CreaseUse::cut});
            continue;
        }
        for (std::size_t i = 0; i < ring.size(); ++i)
            pattern.lines.push_back(fold(ring[i], ring[(i + 1) % ring.size()], k % 2 == 1));
    }
    return pattern;
}

// Squares one in the other, pleated: what is known as a hyperbolic paraboloid, although it is none.
CreasePattern pleated_squares(int rings) {
    CreasePattern pattern;
    const auto corner = [&](int k, int i) {
        const double r = 10.0 * k;
        return Vec2{i == 0 || i == 3 ? -r : r, i < 2 ? -r : r};
    };
    for (int k = 1; k <= rings; ++k) {
        for (int i = 0; i < 4; ++i) {
            const Vec2 a = corner(k, i);
            const Vec2 b = corner(k, (i + 1) % 4);
            if (k == rings) {
                pattern.lines.push_back({{a, b}, false, CreaseUse::cut});
            } else {
                pattern.lines.push_back(fold(a, b, k % 2 == 0));
            }
            pattern.lines.push_back(fold(corner(k - 1, i), a, k % 2 == 1));
        }
    }
    return pattern;
}

Assembly folded(const CreasePattern& pattern, std::string& told) {
    Diagnostics diagnostics("bent");
    auto assembly = fold_sheet(pattern, {}, diagnostics);
    told = test::findings(diagnostics);
    EXPECT_TRUE(assembly) << told;
    return assembly ? std::move(*assembly) : Assembly{};
}

std::vector<Frame> frames_at(const Assembly& assembly, double deg) {
    std::vector<Frame> frames(assembly.plates.size());
    EXPECT_TRUE(place(assembly, Angle::degrees(deg), frames));
    return frames;
}

// What the plates beside a hinge make of its ends.
double torn(const Assembly& assembly, const std::vector<Frame>& frames) {
    double largest = 0.0;
    for (const Hinge& hinge : assembly.hinges) {
        const Frame& a = frames[static_cast<std::size_t>(hinge.a)];
        const Frame& b = frames[static_cast<std::size_t>(hinge.b)];
        for (const Vec2 p : {hinge.a_line.a, hinge.a_line.b})
            largest = std::max(largest, distance(a.point(p), b.point(p)));
    }
    return largest;
}

// Paper of the plates, whatever divides them.
double paper(const Assembly& assembly) {
    double sum = 0.0;
    for (const Plate& plate : assembly.plates) sum += area(plate.outline);
    return sum;
}

double height(const Assembly& assembly, const std::vector<Frame>& frames) {
    double low = HUGE_VAL;
    double high = -HUGE_VAL;
    for (std::size_t i = 0; i < assembly.plates.size(); ++i) {
        for (const Vec2 p : assembly.plates[i].outline.outer) {
            const double z = frames[i].point(p).z;
            low = std::min(low, z);
            high = std::max(high, z);
        }
    }
    return high - low;
}

void expect_bends(const CreasePattern& pattern, std::size_t folds, double sheet_area) {
    std::string told;
    const Assembly bent = folded(pattern, told);
    EXPECT_NE(told.find("not-rigid"), std::string::npos) << told;
    EXPECT_NE(told.find("shown bent, by "), std::string::npos) << told;
    EXPECT_TRUE(bent.sweep.bends);
    EXPECT_NEAR(paper(bent), sheet_area, 1e-6 * sheet_area);
    // Folds go the way that they are drawn, and nothing is scored where panels bend.
    EXPECT_EQ(told.find("fold-other-way"), std::string::npos) << told;
    const auto is_fold = [](const Line& line) { return line.kind != LineKind::cut; };
    EXPECT_EQ(static_cast<std::size_t>(std::count_if(bent.lines.begin(), bent.lines.end(), is_fold)), folds);
    EXPECT_GT(bent.hinges.size(), folds);
    for (int deg = 0; deg <= 180; deg += 9) EXPECT_LT(torn(bent, frames_at(bent, deg)), 1e-6) << deg;
    EXPECT_LT(height(bent, frames_at(bent, 180.0)), 1e-9);
    EXPECT_GT(height(bent, frames_at(bent, 0.0)), 10.0);
}

TEST(Bends, OfCirclesThatAreFolded) {
    const CreasePattern pattern = circles(3, 24);
    const double sheet_area = 0.5 * 24.0 * std::sin(2.0 * kPi / 24.0) * (60.0 * 60.0 - 20.0 * 20.0);
    expect_bends(pattern, 3U * 24U, sheet_area);
}

// Two folds that meet at an angle, and a rectangle around them that is not drawn.
TEST(Bends, EndAtTheBorderThatAPatternLacks) {
    CreasePattern pattern;
    pattern.lines.push_back(fold({0, 0}, {50, 100}, false));
    pattern.lines.push_back(fold({-100, -100}, {0, 0}, false));
    std::string told;
    const Assembly bent = folded(pattern, told);
    EXPECT_NE(told.find("no-border"), std::string::npos) << told;
    EXPECT_TRUE(bent.sweep.bends) << told;
    EXPECT_NEAR(paper(bent), 150.0 * 200.0, 1e-6);
    for (int deg = 0; deg <= 180; deg += 9) EXPECT_LT(torn(bent, frames_at(bent, deg)), 1e-6) << deg;
}

TEST(Bends, OfPleatedSquares) {
    const CreasePattern pattern = pleated_squares(5);
    expect_bends(pattern, 4U * 4U + 4U * 5U, 100.0 * 100.0);
    // A saddle: two opposite corners go up, and the others down.
    std::string told;
    const Assembly bent = folded(pattern, told);
    const std::vector<Frame> frames = frames_at(bent, 0.0);
    std::vector<Vec3> corners(4);
    for (std::size_t i = 0; i < bent.plates.size(); ++i) {
        for (const Vec2 p : bent.plates[i].outline.outer) {
            if (std::abs(p.x) < 50.0 - 1e-9 || std::abs(p.y) < 50.0 - 1e-9) continue;
            corners[(p.x > 0.0 ? 1U : 0U) + (p.y > 0.0 ? 2U : 0U)] = frames[i].point(p);
        }
    }
    const Vec3 across = 0.5 * (corners[0] + corners[3]) - 0.5 * (corners[1] + corners[2]);
    EXPECT_GT(length(across), 20.0);
}

// Steps that lead back to the flat sheet come to it by halves: before it is known of all ways that they do,
// no more is spent than on so many factorisations. From a smaller share than one from which they do, they are
// not tried.
TEST(Bends, AreLookedForSoonWhereNothingMovesWithout) {
    Diagnostics diagnostics;
    const folded::Sheet sheet = *folded::make_sheet(pleated_squares(5), {}, diagnostics);
    folded::Work work;
    const folded::Paths paths = folded::find_paths(sheet, {}, work);
    ASSERT_EQ(paths.reached, 0.0);
    std::vector<int> folds(sheet.folds.size());
    std::vector<int> loops(sheet.loops.size());
    std::iota(folds.begin(), folds.end(), 0);
    std::iota(loops.begin(), loops.end(), 0);
    const folded::StepPlan plan = folded::plan_steps(sheet, folds, loops, folded::Work());
    EXPECT_LT(work.spent(), 45.0 * plan.work);
}

// The panels beside a fold that bends to both sides crumple, and ranges become narrower and narrower.
TEST(Bends, EndWhereTheirMotionCrawls) {
    CreasePattern pattern;
    pattern.fold_deg = 90.0;
    pattern.lines.push_back({{{0, 0}, {180, 0}, {180, 180}, {0, 180}}, true, CreaseUse::cut});
    CreaseLine curve{{}, false, CreaseUse::mountain};
    constexpr int kChords = 80;
    for (int i = 0; i <= kChords; ++i) {
        const double t = static_cast<double>(i) / kChords;
        const double u = 1.0 - t;
        curve.points.push_back({150.0 * u * u * t + 390.0 * u * t * t + 180.0 * t * t * t,
                                90.0 + 120.0 * u * u * t - 120.0 * u * t * t});
    }
    pattern.lines.push_back(curve);
    std::string told;
    const Assembly bent = folded(pattern, told);
    EXPECT_TRUE(bent.sweep.bends) << told;
    EXPECT_EQ(told.find("folding-undecided"), std::string::npos) << told;
    EXPECT_LT(bent.sweep.from_deg, 0.9 * 180.0);
    for (const Joint& joint : bent.joints) {
        const auto* fold = std::get_if<Folded>(&joint.how);
        if (fold == nullptr) continue;
        EXPECT_LE(fold->law.size(), 100U * Folded::kLawSteps + 1U) << joint.name;
    }
}

TEST(Bends, AreWhereThePatternDrawsThem) {
    // Three folds that meet in a corner make their panels bend. Of a square panel either diagonal would do.
    const auto pattern_with = [](Vec2 a, Vec2 b) {
        CreasePattern pattern;
        pattern.lines = {{{{0, 0}, {80, 0}, {80, 80}, {0, 80}}, true, CreaseUse::cut},
                         fold({40, 40}, {40, 0}, false),
                         fold({40, 40}, {80, 40}, false),
                         fold({40, 40}, {0, 80}, true)};
        pattern.lines.push_back({{a, b}, false, CreaseUse::flat});
        return pattern;
    };
    const auto bends_along = [&](Vec2 a, Vec2 b) {
        std::string told;
        const Assembly bent = folded(pattern_with(a, b), told);
        return std::any_of(bent.hinges.begin(), bent.hinges.end(), [&](const Hinge& hinge) {
            return std::min(distance(hinge.a_line.a, a) + distance(hinge.a_line.b, b),
                            distance(hinge.a_line.a, b) + distance(hinge.a_line.b, a)) < 1e-9;
        });
    };
    EXPECT_TRUE(bends_along({40, 40}, {80, 0}));
    EXPECT_TRUE(bends_along({40, 0}, {80, 40}));
}

// A panel with a notch, on three folds around a corner, which cannot be folded. Lines that are drawn as flat
// across the notch, or along its edge, are no lines to bend it along: there is no paper.
TEST(Bends, StayOnThePaper) {
    const std::vector<Vec2> at{{0, 0},    {100, 0}, {100, 60}, {100, 100},  {70, 100},  {70, 30},  {30, 30},
                               {30, 100}, {0, 100}, {0, 60},   {100, -100}, {50, -100}, {0, -100}, {50, -15}};
    const Ring border{at[0], at[12], at[11], at[10], at[1], at[2], at[3],
                      at[4], at[5],  at[6],  at[7],  at[8], at[9]};
    for (const auto& flat : std::vector<std::vector<std::pair<int, int>>>{
             {}, {{9, 2}}, {{9, 5}, {9, 3}, {8, 2}}, {{7, 4}}, {{0, 8}}, {{9, 6}, {2, 5}}}) {
        CreasePattern pattern;
        pattern.lines.push_back({border, true, CreaseUse::cut});
        for (const int end : {0, 1, 11})
            pattern.lines.push_back(fold(at[13], at[static_cast<std::size_t>(end)], true));
        for (const auto& [a, b] : flat)
            pattern.lines.push_back(
                {{at[static_cast<std::size_t>(a)], at[static_cast<std::size_t>(b)]}, false, CreaseUse::flat});
        Diagnostics diagnostics("bends");
        const auto sheet = fold_sheet(pattern, {}, diagnostics);
        ASSERT_TRUE(sheet.has_value()) << test::findings(diagnostics);
        EXPECT_TRUE(sheet->sweep.bends);
        double paper = 0.0;
        for (const Plate& plate : sheet->plates) {
            const double own = signed_area(plate.outline.outer);
            EXPECT_GT(own, 0.0);
            paper += own;
        }
        EXPECT_NEAR(paper, std::abs(signed_area(border)), 1e-6) << flat.size();
    }
}

TEST(Bends, AreNotWhereASheetFoldsWithout) {
    CreasePattern pattern;
    pattern.lines = {{{{0, 0}, {90, 0}, {90, 40}, {0, 40}}, true, CreaseUse::cut},
                     fold({30, 0}, {30, 40}, false),
                     fold({60, 0}, {60, 40}, true)};
    pattern.lines.push_back({{{0, 0}, {30, 40}}, false, CreaseUse::flat});
    std::string told;
    const Assembly assembly = folded(pattern, told);
    EXPECT_EQ(told, "");
    EXPECT_FALSE(assembly.sweep.bends);
    EXPECT_EQ(assembly.plates.size(), 3U);
}

TEST(Bends, AreNotExaminedForCollisions) {
    std::string told;
    const Assembly bent = folded(circles(2, 24), told);
    Diagnostics diagnostics("bent");
    const auto motion = simulate(bent, {}, diagnostics);
    ASSERT_TRUE(motion) << test::findings(diagnostics);
    EXPECT_FALSE(motion->examination);
    EXPECT_LT(motion->max_closure_mm, 1e-6);
}

}  // namespace
}  // namespace popup
