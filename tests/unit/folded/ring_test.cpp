// Walls that a glue flap closes to a tube: how far their folds are to go, told where the sheet collides.
#include "folded/carton/ring.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "popup/motion.h"

namespace popup {
namespace {

void add(CreasePattern& pattern, std::vector<Vec2> points, bool closed, CreaseUse use, std::string name) {
    CreaseLine line;
    line.points = std::move(points);
    line.closed = closed;
    line.use = use;
    line.name = std::move(name);
    line.place = {static_cast<int>(pattern.lines.size()) + 1, 1};
    pattern.lines.push_back(std::move(line));
}

// Walls so wide side by side, the glue flap last, 50 mm high; the border is line 0.
CreasePattern strip(const std::vector<double>& widths) {
    CreasePattern pattern;
    pattern.file = "strip.svg";
    const double all = std::accumulate(widths.begin(), widths.end(), 0.0);
    add(pattern, {{0, 0}, {all, 0}, {all, 50}, {0, 50}}, true, CreaseUse::cut, "#000000");
    double x = 0.0;
    for (std::size_t i = 0; i + 1 < widths.size(); ++i) {
        x += widths[i];
        add(pattern, {{x, 0}, {x, 50}}, false, CreaseUse::mountain, "#ff0000");
    }
    return pattern;
}

// The same with a lid on the second wall, whose fold has that colour, and goes to 90°.
CreasePattern strip_with_lid(const std::vector<double>& widths, const std::string& colour) {
    CreasePattern pattern = strip(widths);
    const double a = widths[0];
    const double b = a + widths[1];
    std::vector<Vec2>& border = pattern.lines[0].points;
    border = {border[0], border[1], border[2], {b, 50}, {b - 2.0, 80}, {a + 2.0, 80}, {a, 50}, border[3]};
    add(pattern, {{a, 50}, {b, 50}}, false, CreaseUse::mountain, colour);
    return pattern;
}

bool simulated(Assembly& sheet, Diagnostics& found) { return simulate_sheet(sheet, {}, found).has_value(); }

// What is told of a sheet that collides.
std::vector<Diagnostic> told_of(const CreasePattern& pattern) {
    Diagnostics told(pattern.file);
    folded::tell_open_ring(pattern, {}, simulated, told);
    return told.sorted();
}

std::size_t collisions(const CreasePattern& pattern, const FoldOptions& options) {
    Diagnostics found;
    auto sheet = fold_sheet(pattern, options, found);
    if (!sheet) return 0;
    simulate_sheet(*sheet, {}, found);
    std::size_t all = 0;
    for (const Diagnostic& one : found.sorted()) all += one.code == "collision" ? 1 : 0;
    return all;
}

TEST(OpenRing, SixWallsGoBySixtyDegrees) {
    const auto ring = folded::open_ring(strip({40, 40, 40, 40, 40, 40, 12}), {});
    ASSERT_TRUE(ring);
    EXPECT_EQ(ring->lines, (std::vector<int>{1, 2, 3, 4, 5, 6}));
    for (const double deg : ring->deg) EXPECT_DOUBLE_EQ(deg, 60.0);
}

TEST(OpenRing, TheGlueFlapMayComeFirst) {
    const auto ring = folded::open_ring(strip({12, 30, 30, 30, 30, 30}), {});
    ASSERT_TRUE(ring);
    EXPECT_EQ(ring->lines, (std::vector<int>{5, 4, 3, 2, 1}));
    for (const double deg : ring->deg) EXPECT_DOUBLE_EQ(deg, 72.0);
}

TEST(OpenRing, OppositeWallsMayBeWiderThanOthers) {
    const auto ring = folded::open_ring(strip({60, 30, 25, 60, 30, 25, 12}), {});
    ASSERT_TRUE(ring);
    for (const double deg : ring->deg) EXPECT_DOUBLE_EQ(deg, 60.0);
}

TEST(OpenRing, ThreeWallsGoAsTheTriangleHasIt) {
    const auto ring = folded::open_ring(strip({30, 40, 50, 12}), {});
    ASSERT_TRUE(ring);
    ASSERT_EQ(ring->deg.size(), 3U);
    EXPECT_NEAR(ring->deg[0], 90.0, 1e-9);  // between the legs
    EXPECT_NEAR(ring->deg[1], 180.0 - 36.8699, 1e-4);
    EXPECT_NEAR(ring->deg[2], 180.0 - 53.1301, 1e-4);
}

TEST(OpenRing, NothingIsSaidOfWhatIsNoneOrIsKnown) {
    const std::vector<double> six{40, 40, 40, 40, 40, 40, 12};
    EXPECT_FALSE(folded::open_ring(strip({50, 30, 50, 30, 12}), {})) << "a box";
    EXPECT_FALSE(folded::open_ring(strip({40, 40, 40, 40, 40, 40}), {})) << "the last is no glue flap";
    EXPECT_FALSE(folded::open_ring(strip({40, 60, 30, 45, 20, 12}), {})) << "by no angle alone do they meet";
    EXPECT_FALSE(folded::open_ring(strip({20, 90, 30, 12}), {})) << "no triangle";
    CreasePattern says_it = strip(six);
    for (CreaseLine& line : says_it.lines) line.fold_deg = 90.0;
    EXPECT_FALSE(folded::open_ring(says_it, {})) << "the drawing says how far";
    FoldOptions options;
    options.fold_angles.push_back({"", Angle::degrees(90.0)});
    EXPECT_FALSE(folded::open_ring(strip(six), options)) << "the options do";
    CreasePattern back = strip(six);
    back.lines[3].use = CreaseUse::valley;
    EXPECT_FALSE(folded::open_ring(back, {})) << "one goes the other way";
    CreasePattern folds_right = strip(six);
    folds_right.fold_deg = 60.0;
    EXPECT_FALSE(folded::open_ring(folds_right, {})) << "they go so already";
}

// Whoever gives the option no longer sees a collision.
TEST(OpenRing, TheHintIsAnOptionWhereANameIsOfTheseFoldsAlone) {
    const CreasePattern pattern = strip_with_lid({60, 30, 25, 60, 30, 25, 12}, "#00ff00");
    EXPECT_GT(collisions(pattern, {}), 0U);
    const auto told = told_of(pattern);
    ASSERT_EQ(told.size(), 1U);
    EXPECT_EQ(told[0].message,
              "6 walls side by side, with a glue flap at their end, meet if their 6 folds go by 60° instead "
              "of 90°; nothing goes through anything then");
    EXPECT_EQ(told[0].hints, (std::vector<std::string>{"fold them so: --fold-angle '#ff0000=60'"}));
    EXPECT_EQ(told[0].place.line, 2);
    FoldOptions options;
    options.fold_angles.push_back({"#ff0000", Angle::degrees(60.0)});
    EXPECT_EQ(collisions(pattern, options), 0U);
}

TEST(OpenRing, TheHintIsTheirKindWhereOnlyTheyAreOfIt) {
    CreasePattern pattern = strip_with_lid({60, 30, 25, 60, 30, 25, 12}, "#ff0000");
    pattern.lines.back().use = CreaseUse::valley;  // the lid opens
    const auto told = told_of(pattern);
    ASSERT_EQ(told.size(), 1U);
    EXPECT_EQ(told[0].hints, (std::vector<std::string>{"fold them so: --fold-angle mountain=60"}));
}

TEST(OpenRing, TheHintIsForTheDrawingWhereNoOptionTellsThemApart) {
    CreasePattern pattern = strip_with_lid({60, 30, 25, 60, 30, 25, 12}, "#ff0000");
    const auto hint = [&] {
        const auto told = told_of(pattern);
        return told.size() == 1 && told[0].hints.size() == 1 ? told[0].hints[0] : "";
    };
    EXPECT_EQ(
        hint(),
        "write data-fold-angle=\"60\" into their elements, in lines 2, 3, 4, 5, 6 and 7, or draw them in "
        "a colour that no other fold has, and give --fold-angle for that colour");
    pattern.file = "strip.dxf";
    EXPECT_EQ(
        hint(),
        "draw them, their middles at (60.00, 25.00) mm, (90.00, 25.00) mm, (115.00, 25.00) mm, (175.00, "
        "25.00) mm, (205.00, 25.00) mm and (230.00, 25.00) mm, in a colour that no other fold has, and "
        "give --fold-angle for that colour");
    // An attribute would be of the lid, too.
    pattern.file = "strip.svg";
    for (CreaseLine& line : pattern.lines) line.place = {2, 3};
    EXPECT_EQ(
        hint(),
        "draw them, in line 2, in a colour that no other fold has, and give --fold-angle for that colour");
}

// Their angles differ, so that each needs a colour of its own, or all need one.
TEST(OpenRing, ThreeWallsAreToldWithThreeAngles) {
    CreasePattern pattern = strip({30, 40, 50, 12});
    auto told = told_of(pattern);
    ASSERT_EQ(told.size(), 1U);
    EXPECT_NE(told[0].message.find("by 90°, 143.13° and 126.87°, in this order"), std::string::npos)
        << told[0].message;
    for (std::size_t i = 1; i < pattern.lines.size(); ++i) pattern.lines[i].name = fmt::format("#00000{}", i);
    told = told_of(pattern);
    ASSERT_EQ(told.size(), 1U);
    EXPECT_EQ(told[0].hints, (std::vector<std::string>{"fold them so: --fold-angle '#000001=90' --fold-angle "
                                                       "'#000002=143.13' --fold-angle '#000003=126.87'"}));
}

// Pure red and blue are the colours of Origami Simulator, whose folds go to 180° unless they are pale.
TEST(OpenRing, ColoursThatSay180DoNotStandInTheWay) {
    CreasePattern box = strip_with_lid({50, 30, 50, 30, 12}, "#ff0000");
    for (CreaseLine& line : box.lines) line.fold_deg = 180.0;
    EXPECT_GT(collisions(box, {}), 0U);
    auto told = told_of(box);
    ASSERT_EQ(told.size(), 1U);
    EXPECT_EQ(told[0].message,
              "4 walls side by side, with a glue flap at their end, meet if their 4 folds go by 90° instead "
              "of 180°, and all other folds by 90°; nothing goes through anything then");
    EXPECT_EQ(told[0].hints, (std::vector<std::string>{"fold them so: --fold-angle 90"}));
    FoldOptions options;
    options.fold_angles.push_back({"", Angle::degrees(90.0)});
    EXPECT_EQ(collisions(box, options), 0U);
    // Another angle that the drawing says is not to be overruled.
    CreasePattern leaning = box;
    leaning.lines.back().fold_deg = 100.0;
    EXPECT_TRUE(folded::open_ring(leaning, {}));
    for (const Diagnostic& one : told_of(leaning)) EXPECT_NE(one.hints[0], "fold them so: --fold-angle 90");
    CreasePattern six = strip_with_lid({60, 30, 25, 60, 30, 25, 12}, "#0000ff");
    for (CreaseLine& line : six.lines) line.fold_deg = 180.0;
    told = told_of(six);
    ASSERT_EQ(told.size(), 1U);
    EXPECT_EQ(told[0].hints,
              (std::vector<std::string>{"fold them so: --fold-angle 90 --fold-angle '#ff0000=60'"}));
    options.fold_angles.push_back({"#ff0000", Angle::degrees(60.0)});
    EXPECT_EQ(collisions(six, options), 0U);
}

TEST(OpenRing, NothingIsToldThatDoesNotMend) {
    const CreasePattern pattern = strip({60, 30, 25, 60, 30, 25, 12});
    Diagnostics told(pattern.file);
    const auto collides = [](Assembly& /*sheet*/, Diagnostics& found) {
        found.warning("collision", {}, "two walls go through each other");
        return true;
    };
    folded::tell_open_ring(pattern, {}, collides, told);
    const auto locks = [](Assembly& /*sheet*/, Diagnostics& /*found*/) { return false; };
    folded::tell_open_ring(pattern, {}, locks, told);
    EXPECT_TRUE(told.sorted().empty());
    folded::tell_open_ring(pattern, {}, simulated, told);
    EXPECT_EQ(told.sorted().size(), 1U);
}

}  // namespace
}  // namespace popup
