// From what a turtle drew to parts: what lies in what, what belongs together, names, and findings.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "input/flatlang/pieces/pieces.h"
#include "popup/pattern.h"
#include "support/designs.h"
#include "support/sanitized.h"
#include "support/trails.h"

namespace popup {
namespace {

using test::TrailMaker;

constexpr double kInch = 25.4;

struct Made {
    std::optional<FlatParts> list;
    Diagnostics diagnostics{"program.fl"};
    [[nodiscard]] const FlatPart& part(std::size_t i) const { return list->parts.at(i); }
    [[nodiscard]] std::vector<std::string> names() const {
        std::vector<std::string> all;
        if (!list) return all;
        for (const FlatPart& part : list->parts) all.push_back(part.name);
        return all;
    }
    [[nodiscard]] std::vector<std::string> codes() const {
        std::vector<std::string> all;
        for (const Diagnostic& one : diagnostics.sorted()) all.push_back(one.code);
        return all;
    }
    [[nodiscard]] std::string told() const { return test::findings(diagnostics); }
};

Made make(const TrailMaker& maker) {
    Made made;
    made.list = flatlang::make_parts(maker.trail, made.diagnostics);
    return made;
}

std::vector<Vec3> regular(int corners, double radius, Vec3 middle, double turn = 0.0) {
    std::vector<Vec3> points;
    for (int i = 0; i < corners; ++i) {
        const double angle = turn + 2.0 * M_PI * i / corners;
        points.push_back(middle + Vec3{radius * std::cos(angle), radius * std::sin(angle), 0});
    }
    return points;
}

TEST(FlatLangPieces, ALoopIsAPartInMillimetres) {
    TrailMaker maker;
    maker.square(1, 2, 3);
    const Made made = make(maker);
    ASSERT_TRUE(made.list) << made.told();
    EXPECT_EQ(made.names(), std::vector<std::string>{"piece"});
    ASSERT_EQ(made.part(0).paper.size(), 1U);
    const Box box = bounds(made.part(0).paper[0].outer);
    EXPECT_NEAR(box.min.x, 1 * kInch, 1e-5);
    EXPECT_NEAR(box.min.y, 2 * kInch, 1e-5);
    EXPECT_NEAR(box.max.x, 4 * kInch, 1e-5);
    EXPECT_NEAR(area(made.part(0).paper), 9 * kInch * kInch, 1e-3);
    EXPECT_TRUE(made.codes().empty()) << made.told();
}

TEST(FlatLangPieces, LoopsInLoopsAreHolesAndPaperAgain) {
    TrailMaker maker;
    maker.part("nest");
    for (const double side : {10.0, 8.0, 6.0, 4.0}) maker.square(-side / 2, -side / 2, side);
    const Made made = make(maker);
    ASSERT_TRUE(made.list) << made.told();
    ASSERT_EQ(made.list->parts.size(), 1U);
    EXPECT_EQ(made.part(0).paper.size(), 2U);
    EXPECT_NEAR(area(made.part(0).paper), (100 - 64 + 36 - 16) * kInch * kInch, 1e-2);
}

// As a person draws two things one after the other.
TEST(FlatLangPieces, BeforeTheFirstPartEveryOutermostLoopIsAPiece) {
    TrailMaker maker;
    maker.square(0, 0, 3);
    maker.square(5, 0, 3);
    maker.square(6, 1, 1);  // in the second
    const Made made = make(maker);
    ASSERT_TRUE(made.list) << made.told();
    EXPECT_EQ(made.names(), (std::vector<std::string>{"piece", "piece 2"}));
    EXPECT_TRUE(made.part(0).paper.at(0).holes.empty());
    EXPECT_EQ(made.part(1).paper.at(0).holes.size(), 1U);
}

TEST(FlatLangPieces, ANamedPartKeepsItsLoopsAsTheyLieBesideEachOther) {
    TrailMaker maker;
    maker.part("letters");
    maker.square(0, 0, 1);
    maker.square(3, 0, 1);
    const Made made = make(maker);
    ASSERT_TRUE(made.list) << made.told();
    ASSERT_EQ(made.names(), std::vector<std::string>{"letters"});
    ASSERT_EQ(made.part(0).paper.size(), 2U);
    Box box;
    for (const Polygon& region : made.part(0).paper) {
        for (const Vec2 p : region.outer) box.extend(p);
    }
    EXPECT_NEAR(box.width(), 4 * kInch, 1e-5);
    EXPECT_EQ(made.part(0).place, (Place{2, 1}));
}

TEST(FlatLangPieces, PlanesOfANamedPartThatDoNotMeetAreNumberedParts) {
    TrailMaker maker;
    maker.part("shelf");
    maker.square(0, 0, 2);
    maker.rectangle({0, 0, 4}, {2, 0, 0}, {0, 2, 0});
    const Made made = make(maker);
    EXPECT_EQ(made.names(), (std::vector<std::string>{"shelf", "shelf 2"}));
}

TEST(FlatLangPieces, NamesAreGivenOnceAndNeverTakenFromAPart) {
    TrailMaker maker;
    double x = 0;
    for (const char* name : {"gear", "gear", "gear 2", "", "two\nlines", "gear", "piece"}) {
        maker.part(name);
        maker.square(x += 5, 0, 1);
    }
    const Made made = make(maker);
    ASSERT_TRUE(made.list) << made.told();
    EXPECT_EQ(made.names(), (std::vector<std::string>{"gear", "gear 3", "gear 2", "piece", "two lines",
                                                      "gear 4", "piece 2"}));
}

// Programs draw one outline over another, and go there and back.
TEST(FlatLangPieces, LoopsDrawnTwiceCountOnceAndLinesThereAndBackAreNone) {
    TrailMaker maker;
    maker.part("plate");
    maker.square(0, 0, 2);
    maker.loop({{2, 2, 0}, {0, 2, 0}, {0, 0, 0}, {2, 0, 0}});
    maker.loop({{5, 0, 0}, {6, 0, 0}, {7, 0, 0}, {6, 0, 0}});
    const Made made = make(maker);
    ASSERT_TRUE(made.list) << made.told();
    ASSERT_EQ(made.list->parts.size(), 1U);
    EXPECT_EQ(made.part(0).paper.size(), 1U);
    ASSERT_EQ(made.codes(), std::vector<std::string>{"flatlang-open-lines"}) << made.told();
    // 4 lines of an inch
    EXPECT_NE(made.told().find("4 lines"), std::string::npos) << made.told();
    EXPECT_NE(made.told().find("101.6 mm, 4.00 inches"), std::string::npos) << made.told();
}

// An L that is drawn to the right lies on its page as it lies on the ground, and so does one drawn to the
// left.
TEST(FlatLangPieces, WhatIsDrawnOnTheGroundIsSeenFromAbove) {
    const std::vector<Vec3> letter{{0, 0, 0}, {3, 0, 0}, {3, 1, 0}, {1, 1, 0}, {1, 5, 0}, {0, 5, 0}};
    for (const bool right : {false, true}) {
        TrailMaker maker;
        maker.loop(right ? std::vector<Vec3>(letter.rbegin(), letter.rend()) : letter);
        const Made made = make(maker);
        ASSERT_TRUE(made.list);
        EXPECT_TRUE(contains(made.part(0).paper.at(0), {2.5 * kInch, 0.5 * kInch}));
        EXPECT_FALSE(contains(made.part(0).paper.at(0), {2.5 * kInch, 4 * kInch}));
        EXPECT_TRUE(contains(made.part(0).paper.at(0), {0.5 * kInch, 4 * kInch}));
        EXPECT_EQ(made.part(0).faces.at(0).frame.normal(), (Vec3{0, 0, 1}));
    }
}

TEST(FlatLangPieces, FlatNeighboursArePiecesOfTheirOwnUnlessAPartJoinsThem) {
    for (const bool named : {false, true}) {
        TrailMaker maker;
        if (named) maker.part("cover");
        maker.square(0, 0, 2);
        maker.square(2, 0, 2);
        maker.square(0, 2, 2);
        maker.square(2, 2, 2);
        const Made made = make(maker);
        ASSERT_TRUE(made.list) << made.told();
        if (!named) {
            EXPECT_EQ(made.list->parts.size(), 4U);
            continue;
        }
        ASSERT_EQ(made.list->parts.size(), 1U);
        EXPECT_EQ(made.part(0).paper.size(), 1U);
        EXPECT_NEAR(area(made.part(0).paper), 16 * kInch * kInch, 1e-3);
        // Four creases meet in the middle; none of them is folded.
        ASSERT_EQ(made.part(0).lines.size(), 4U);
        EXPECT_TRUE(made.part(0).slits.empty());
        for (const FlatLine& line : made.part(0).lines) {
            EXPECT_EQ(line.kind, LineKind::valley);
            EXPECT_FALSE(line.fold_angle);
            EXPECT_NEAR(distance(line.points.at(0), line.points.at(1)), 2 * kInch, 1e-4);
        }
    }
}

TEST(FlatLangPieces, FoldsAreOfOnePart) {
    TrailMaker maker;
    maker.part("floor");
    maker.square(0, 0, 2);
    maker.part("wall");
    maker.rectangle({0, 0, 0}, {2, 0, 0}, {0, 0, 2});
    const Made made = make(maker);
    EXPECT_EQ(made.names(), (std::vector<std::string>{"floor", "wall"}));
    EXPECT_TRUE(made.part(0).lines.empty());
}

TEST(FlatLangPieces, AnEdgeOfThreeFacesIsCut) {
    TrailMaker maker;
    maker.square(0, 0, 2);
    maker.rectangle({0, 0, 0}, {2, 0, 0}, {0, 0, 2});
    maker.rectangle({0, 0, 0}, {2, 0, 0}, {0, -1, 1});
    const Made made = make(maker);
    EXPECT_EQ(made.names().size(), 3U);
}

// Two flaps on one edge of a base, side by side in one plane: each is folded, and between them there is a
// cut.
TEST(FlatLangPieces, WhatTouchesOnThePageWithoutAFoldIsCutApart) {
    TrailMaker maker;
    maker.square(0, 0, 2);
    maker.rectangle({0, 0, 0}, {1, 0, 0}, {0, 0, 3});
    maker.rectangle({1, 0, 0}, {1, 0, 0}, {0, 0, 3});
    const Made made = make(maker);
    ASSERT_TRUE(made.list) << made.told();
    ASSERT_EQ(made.list->parts.size(), 1U);
    EXPECT_EQ(made.part(0).lines.size(), 2U);
    ASSERT_EQ(made.part(0).slits.size(), 1U);
    EXPECT_NEAR(distance(made.part(0).slits[0].front(), made.part(0).slits[0].back()), 3 * kInch, 1e-4);
    EXPECT_NEAR(area(made.part(0).paper), 10 * kInch * kInch, 1e-2);
}

// The sign of a fold: from the front, which is seen from above, the wall comes up or goes down.
TEST(FlatLangPieces, ValleysComeUpAndMountainsGoDown) {
    for (const double up : {1.0, -1.0}) {
        TrailMaker maker;
        maker.square(0, 0, 2);
        maker.rectangle({2, 0, 0}, {0, 2, 0}, {1, 0, up * std::sqrt(3.0)});
        const Made made = make(maker);
        ASSERT_TRUE(made.list) << made.told();
        ASSERT_EQ(made.part(0).lines.size(), 1U);
        EXPECT_EQ(made.part(0).lines[0].kind, up > 0 ? LineKind::valley : LineKind::mountain);
        ASSERT_TRUE(made.part(0).lines[0].fold_angle);
        EXPECT_NEAR(*made.part(0).lines[0].fold_angle, M_PI / 3, 1e-9);
        // The wall lies flat beside the floor.
        EXPECT_NEAR(bounds(made.part(0).paper.at(0).outer).max.x, 4 * kInch, 1e-4);
    }
}

// A flap in the hole that it was cut from.
TEST(FlatLangPieces, AFlapFoldsIntoTheHoleOfItsWall) {
    TrailMaker maker;
    maker.square(0, 0, 6);
    maker.square(2, 2, 2);
    maker.rectangle({2, 2, 0}, {2, 0, 0}, {0, 0, 2});
    const Made made = make(maker);
    ASSERT_TRUE(made.list) << made.told();
    ASSERT_EQ(made.list->parts.size(), 1U) << made.told();
    EXPECT_EQ(made.part(0).lines.size(), 1U);
    EXPECT_NEAR(area(made.part(0).paper), 36 * kInch * kInch, 0.1);
    // The other three sides of the flap, which touch the wall, are cuts.
    double cut = 0;
    for (const auto& slit : made.part(0).slits) cut += distance(slit.front(), slit.back());
    EXPECT_NEAR(cut, 6 * kInch, 0.1);
}

TEST(FlatLangPieces, StretchesOfEdgesThatFacesShareAreFolds) {
    TrailMaker maker;
    maker.square(0, 0, 4);
    maker.rectangle({1, 0, 0}, {2, 0, 0}, {0, 0, 1});  // on the middle of an edge
    maker.rectangle({4, 3, 0}, {0, 4, 0}, {0, 0, 1});  // over the end of another
    const Made made = make(maker);
    ASSERT_TRUE(made.list) << made.told();
    ASSERT_EQ(made.list->parts.size(), 1U);
    std::multiset<int> inches;
    for (const FlatLine& line : made.part(0).lines) {
        inches.insert(static_cast<int>(std::lround(distance(line.points[0], line.points[1]) / kInch)));
    }
    EXPECT_EQ(inches, (std::multiset<int>{1, 2}));
}

// --- findings

TEST(FlatLangPieces, LoopsOfAPartThatOverlapAreAnErrorWhereThePartBegins) {
    TrailMaker maker;
    maker.part("good");
    maker.square(10, 10, 2);
    maker.part("bad");
    maker.square(0, 0, 2);
    maker.square(1, 1, 2);
    const Made made = make(maker);
    EXPECT_FALSE(made.list);
    ASSERT_EQ(made.codes(), std::vector<std::string>{"flatlang-bad-outline"}) << made.told();
    const Diagnostic one = made.diagnostics.sorted().front();
    EXPECT_EQ(one.place, (Place{3, 1}));
    EXPECT_NE(one.message.find("\"bad\""), std::string::npos) << one.message;
    EXPECT_NE(one.message.find("645.16 mm²"), std::string::npos) << one.message;
    EXPECT_FALSE(one.hints.empty());
}

TEST(FlatLangPieces, ALoopOfAPartThatCrossesItselfIsAnError) {
    TrailMaker maker;
    maker.part("bow");
    maker.loop({{0, 0, 0}, {2, 2, 0}, {2, 0, 0}, {0, 2, 0}});
    const Made made = make(maker);
    EXPECT_FALSE(made.list);
    ASSERT_EQ(made.codes(), std::vector<std::string>{"flatlang-bad-outline"});
    EXPECT_NE(made.told().find("(1.000, 1.000, 0.000)"), std::string::npos) << made.told();
}

TEST(FlatLangPieces, BeforeTheFirstPartOverlapsAreToldAndCutApart) {
    TrailMaker maker;
    for (const double x : {0.0, 1.0, 2.0, 3.0}) maker.square(x, 0, 1.5);
    const Made made = make(maker);
    ASSERT_TRUE(made.list) << made.told();
    EXPECT_EQ(made.list->parts.size(), 4U);
    ASSERT_EQ(made.codes(), std::vector<std::string>{"flatlang-outlines-overlap"}) << made.told();
    EXPECT_NE(made.told().find("3 pairs of loops"), std::string::npos) << made.told();
}

TEST(FlatLangPieces, HolesThatOverlapAreToldAndOpenedTogether) {
    TrailMaker maker;
    maker.part("plate");
    maker.square(0, 0, 10);
    maker.square(2, 2, 2);
    maker.square(3, 3, 2);
    const Made made = make(maker);
    ASSERT_TRUE(made.list) << made.told();
    EXPECT_EQ(made.codes(), std::vector<std::string>{"holes-overlap"});
    EXPECT_NEAR(area(made.part(0).paper), (100 - 7) * kInch * kInch, 1e-2);
}

TEST(FlatLangPieces, WithoutALoopThereIsNoPart) {
    TrailMaker maker;
    EXPECT_FALSE(make(maker).list);
    EXPECT_EQ(make(maker).codes(), std::vector<std::string>{"flatlang-no-parts"});
    // A slip of a hundredth of an inch is told.
    const std::vector<Vec3> path{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {0, 0.01, 0}};
    for (std::size_t i = 0; i + 1 < path.size(); ++i) maker.line(path[i], path[i + 1]);
    const Made made = make(maker);
    EXPECT_FALSE(made.list);
    ASSERT_EQ(made.codes(), std::vector<std::string>{"flatlang-no-parts"});
    EXPECT_NE(made.diagnostics.sorted().front().hints.at(0).find("0.0100 inches"), std::string::npos)
        << made.told();
}

TEST(FlatLangPieces, NumbersThatAreNoPlacesAreErrorsAndNoCrash) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double infinite = std::numeric_limits<double>::infinity();
    for (const double bad : {nan, infinite, -infinite, 1e300, 4000.0}) {
        for (const bool loop : {false, true}) {
            TrailMaker maker;
            maker.square(0, 0, 2);
            maker.part("far");
            if (loop) {
                maker.loop({{0, 0, 0}, {bad, 0, 0}, {bad, 1, 0}});
            } else {
                maker.line({0, 0, 0}, {0, bad, 0});
            }
            const Made made = make(maker);
            EXPECT_FALSE(made.list) << bad;
            EXPECT_EQ(made.codes(), std::vector<std::string>{"flatlang-bad-outline"}) << bad;
            EXPECT_EQ(made.diagnostics.sorted().front().place, (Place{2, 1}));
        }
    }
}

TEST(FlatLangPieces, LoopsThatLieInNoPlaneAreErrors) {
    TrailMaker maker;
    maker.part("saddle");
    maker.loop({{0, 0, 0}, {2, 0, 0.5}, {2, 2, 0}, {0, 2, 0.5}});
    const Made made = make(maker);
    EXPECT_FALSE(made.list);
    EXPECT_EQ(made.codes(), std::vector<std::string>{"flatlang-bad-outline"});
}

// Anybody's program may draw this: it ends soon, and says why.
TEST(FlatLangPieces, TooManyOverlapsAreAnErrorOfTheirOwn) {
    TrailMaker maker;
    for (int i = 0; i < 3000; ++i) maker.square(1e-3 * i, 2e-3 * i, 2);
    const Made made = make(maker);
    EXPECT_FALSE(made.list);
    EXPECT_EQ(made.codes(), std::vector<std::string>{"document-too-large"});
}

// A rectangle and its halves: two holes that leave nothing.
TEST(FlatLangPieces, NoOutlineIsLostUntold) {
    TrailMaker named;
    named.part("lid");
    named.loop({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}});
    named.square(0, 0, 1);
    named.square(1, 0, 1);
    named.part("disc");
    named.square(5, 0, 1);
    const Made made = make(named);
    EXPECT_FALSE(made.list);
    ASSERT_EQ(made.codes().front(), "flatlang-bad-outline") << made.told();
    EXPECT_NE(made.told().find("part \"lid\" has a loop at (0.000, 0.000, 0.000) inches of which"),
              std::string::npos)
        << made.told();
    TrailMaker loose;
    loose.loop({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}});
    loose.square(0, 0, 1);
    loose.square(1, 0, 1);
    EXPECT_EQ(make(loose).codes(),
              (std::vector<std::string>{"flatlang-no-parts", "flatlang-outlines-overlap"}));
    loose.square(5, 0, 1);
    EXPECT_TRUE(make(loose).list);
    EXPECT_EQ(make(loose).codes(),
              (std::vector<std::string>{"flatlang-outlines-overlap", "flatlang-open-lines"}));
}

TEST(FlatLangPieces, APartThatIsNotCutIsTold) {
    TrailMaker maker;
    maker.part("plate");
    maker.square(0, 0, 2);
    maker.part("wheel");
    maker.line({5, 0, 0}, {6, 0, 0});
    maker.line({6, 0, 0}, {6, 1, 0});
    maker.part("empty");
    const Made made = make(maker);
    ASSERT_TRUE(made.list);
    EXPECT_NE(made.told().find("part \"wheel\" has 2 lines and no closed outline, so it is not cut"),
              std::string::npos)
        << made.told();
    EXPECT_EQ(made.told().find("empty"), std::string::npos) << made.told();
}

// All teeth stand at one height, where a boolean takes them in one by one.
TEST(FlatLangPieces, ACombOfVeryManyTeethIsToldInTime) {
    std::vector<Vec3> comb;
    constexpr double kTooth = 1e-2;
    for (int i = 0; i < 30000; ++i) {
        comb.push_back({i * kTooth, 0, 0});
        comb.push_back({i * kTooth, 1, 0});
        comb.push_back({(i + 0.5) * kTooth, 1, 0});
        comb.push_back({(i + 0.5) * kTooth, 0, 0});
    }
    comb.push_back({300, 0, 0});
    comb.push_back({300, -1, 0});
    comb.push_back({0, -1, 0});
    TrailMaker maker;
    maker.loop(comb);
    const Made made = make(maker);
    EXPECT_FALSE(made.list);
    EXPECT_EQ(made.codes(), std::vector<std::string>{"document-too-large"});
}

TEST(FlatLangPieces, ALineThatNearlyClosesIsPointedOut) {
    TrailMaker maker;
    maker.square(0, 0, 2);
    const std::vector<Vec3> path{{5, 0, 0}, {7, 0, 0}, {7, 2, 0}, {5, 2, 0}, {5, 0.003, 0}};
    for (std::size_t i = 0; i + 1 < path.size(); ++i) maker.line(path[i], path[i + 1]);
    const Made made = make(maker);
    ASSERT_TRUE(made.list);
    ASSERT_EQ(made.codes(), (std::vector<std::string>{"flatlang-open-lines", "flatlang-open-lines"}));
    EXPECT_EQ(made.diagnostics.sorted().front().severity, Severity::warning);
    EXPECT_NE(made.diagnostics.sorted().front().message.find("an outline of 4 lines that ends 0.0030 inches"),
              std::string::npos);
}

// A flap that is folded onto a wall lies in its plane.
TEST(FlatLangPieces, ALoopOnTheEdgeOfAnotherIsPointedOut) {
    TrailMaker maker;
    maker.part("box");
    maker.square(0, 0, 3);
    maker.square(0, 1, 1);
    const Made made = make(maker);
    ASSERT_TRUE(made.list);
    ASSERT_EQ(made.codes(), std::vector<std::string>{"flatlang-outlines-overlap"});
    EXPECT_NE(made.told().find("at (0.000, 1.500, 0.000) inches"), std::string::npos) << made.told();
    TrailMaker inside;
    inside.part("box");
    inside.square(0, 0, 3);
    inside.square(1, 1, 1);
    EXPECT_EQ(make(inside).codes(), std::vector<std::string>{});
}

// Fine outlines have many edges within any tolerance that is looked at.
TEST(FlatLangPieces, NoEdgeOfAFineOutlineIsAnOpenLine) {
    for (const int corners : {500, 5000}) {
        TrailMaker maker;
        maker.part("disc");
        maker.loop(regular(corners, 0.5, {0, 0, 0}));
        maker.loop(regular(corners, 0.1, {0, 0, 0}));
        const Made made = make(maker);
        ASSERT_TRUE(made.list) << made.told();
        EXPECT_TRUE(made.codes().empty()) << made.told();
    }
}

// --- the model

TEST(FlatLangPieces, TheModelHasANodeAPartAndOneOfLooseLines) {
    TrailMaker maker;
    maker.line({-3, 0, 0}, {-2, 0, 0});
    maker.line({-2, 0, 0}, {-1, 0, 1});
    maker.line({7, 7, 7}, {8, 8, 8});
    maker.part("lid");
    maker.rectangle({0, 0, 3}, {2, 0, 0}, {0, 2, 1});
    maker.line({0, 0, 3}, {1, 1, 4});
    maker.part("scribble");
    maker.line({0, 0, 0}, {1, 0, 0});
    const Made made = make(maker);
    ASSERT_TRUE(made.list) << made.told();
    ASSERT_EQ(made.list->parts.size(), 1U);
    const FlatPart& lid = made.part(0);
    EXPECT_EQ(lid.name, "lid");
    ASSERT_EQ(lid.faces.size(), 1U);
    // Its outline is one line, and the loose one, which goes on from its beginning, is in it.
    EXPECT_EQ(lid.traces.size(), 1U);
    EXPECT_EQ(lid.traces[0].size(), 6U);
    const std::vector<Trace>& loose = made.list->traces;
    ASSERT_EQ(loose.size(), 2U);
    EXPECT_EQ(loose[0].name, "trail");
    ASSERT_EQ(loose[0].lines.size(), 2U);
    EXPECT_EQ(loose[0].lines[0],
              (std::vector<Vec3>{kInch * Vec3{-3, 0, 0}, kInch * Vec3{-2, 0, 0}, kInch * Vec3{-1, 0, 1}}));
    EXPECT_EQ(loose[1].name, "scribble");
    // The face stands where it was drawn.
    for (const Vec2 p : lid.faces[0].shape.outer) {
        const Vec3 at = lid.faces[0].frame.point(p);
        double nearest = HUGE_VAL;
        for (const Vec3 corner : maker.trail.polygons[0].points) {
            nearest = std::min(nearest, distance(kInch * corner, at));
        }
        EXPECT_LT(nearest, 1e-5);
    }
    // One of them of the part that has nothing else.
    EXPECT_EQ(made.codes(), (std::vector<std::string>{"flatlang-open-lines", "flatlang-open-lines"}));
    EXPECT_NE(made.told().find("5 lines"), std::string::npos) << made.told();
}

// --- very many

TEST(FlatLangPieces, TensOfThousandsOfLoopsArePieces) {
    TrailMaker maker;
    const int side = test::sanitized_count(130, 4);
    const int leaves = test::sanitized_count(2999);
    for (int x = 0; x < side; ++x) {
        for (int y = 0; y < side; ++y) maker.loop(regular(6, 0.4, {1.0 * x, 1.0 * y, 0.0}));
    }
    maker.part("book");
    for (int i = 0; i < leaves; ++i) {
        // Leaves round one edge, which is of all of them.
        const double angle = 2.0 * M_PI * i / leaves;
        maker.rectangle({-9, 0, 0}, {0, 5, 0}, {3 * std::cos(angle), 0, 3 * std::sin(angle)});
    }
    const Made made = make(maker);
    ASSERT_TRUE(made.list) << made.told();
    EXPECT_EQ(made.list->parts.size(), static_cast<std::size_t>(side * side + leaves));
}

TEST(FlatLangPieces, ALongStripUnfolds) {
    TrailMaker maker;
    constexpr int kFaces = 1500;
    for (int i = 0; i < kFaces; ++i) {
        const double z = i % 2 == 0 ? 0.0 : 0.5;
        maker.rectangle({0.5 * i, 0, z}, {0.5, 0, 0.5 - 2 * z}, {0, 4, 0});
    }
    const Made made = make(maker);
    ASSERT_TRUE(made.list) << made.told();
    ASSERT_EQ(made.list->parts.size(), 1U);
    EXPECT_EQ(made.part(0).lines.size(), kFaces - 1U);
    EXPECT_NEAR(area(made.part(0).paper), kFaces * 4 * std::sqrt(0.5) * kInch * kInch, 10.0);
}

TEST(FlatLangPieces, ThePatternKeepsTheAnglesOfFolds) {
    TrailMaker maker;
    maker.part("tray");
    maker.square(0, 0, 4);
    maker.rectangle({4, 0, 0}, {0, 4, 0}, {1, 0, 1});
    maker.rectangle({0, 0, 0}, {0, 4, 0}, {0, 0, -1});
    maker.square(0, 4, 4);
    Made made = make(maker);
    ASSERT_TRUE(made.list) << made.told();
    const auto pattern = make_pattern(assembly_of(*made.list), PatternOptions{}, made.diagnostics);
    ASSERT_TRUE(pattern);
    ASSERT_EQ(pattern->pieces.size(), 1U);
    std::multiset<std::pair<LineKind, int>> folds;
    for (const PatternLine& line : pattern->pieces[0].lines) {
        folds.emplace(line.kind,
                      line.fold_angle ? static_cast<int>(std::lround(*line.fold_angle * 180 / M_PI)) : -1);
    }
    EXPECT_EQ(folds, (std::multiset<std::pair<LineKind, int>>{
                         {LineKind::valley, 45}, {LineKind::mountain, 90}, {LineKind::valley, -1}}));
}

}  // namespace
}  // namespace popup
