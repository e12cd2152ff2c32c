// Names of pieces, numbers of tabs and of what is glued flat.
#include "pattern/labels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "pattern/tabs.h"
#include "popup/compile.h"
#include "support/prints.h"
#include "unit/pattern/hand_made_card.h"

namespace popup {
namespace {

using test::sides_of;
using Card = test::HandMadeCard;
constexpr double kPi = std::numbers::pi;

double ring_distance(const Ring& a, const Ring& b) {
    if (contains({a, {}}, b[0]) || contains({b, {}}, a[0])) return 0.0;
    double best = HUGE_VAL;
    for (const Segment& s : sides_of(a)) {
        for (const Segment& t : sides_of(b)) best = std::min(best, distance(s, t));
    }
    return best;
}

TEST(Labels, LabelsOfTabsFitIntoThem) {
    const auto parts = trimmed_tab(40, {10, 0.5, 1}, std::vector<Segment>{{{12, 6}, {70, 6}}}, {});
    const auto spot = place_in_tab(parts, "12L");
    ASSERT_TRUE(spot.has_value());
    const Vec2 half{0.5 * text_width("12L", spot->height), 0.5 * spot->height};
    for (const Vec2 corner : {half, -half, Vec2{half.x, -half.y}, Vec2{-half.x, half.y}}) {
        EXPECT_TRUE(std::any_of(parts.begin(), parts.end(), [&](const Ring& part) {
            return contains({part, {}}, spot->at + corner);
        }));
    }
    EXPECT_GE(spot->height, 2.0);
}

// A frame about a window: whatever the sizes, its sides have room for as large a number as fits between them.
TEST(Labels, FindTheRoomBetweenTwoEdges) {
    constexpr double kPad = 1.0;  // of each side of a text
    for (double outer = 10.0; outer <= 24.0; outer += 0.5) {
        for (double side = 4.0; side <= std::min(6.5, outer - 3.0); side += 0.5) {
            const double inner = outer - side;
            const Polygon frame{{{-outer, -outer}, {outer, -outer}, {outer, outer}, {-outer, outer}},
                                {{{-inner, -inner}, {-inner, inner}, {inner, inner}, {inner, -inner}}}};
            const auto spot = place_on_plate(EdgeIndex(edges_of(frame), {}), {}, bounds(frame.outer), "3");
            ASSERT_TRUE(spot) << outer << ' ' << side;
            EXPECT_GE(spot->height, std::min(4.0, side - 2.0 * kPad - 0.5)) << outer << ' ' << side;
        }
    }
}

// Lines may lie below a name where there is no other place; a text below it, and nobody reads either.
TEST(Labels, AreNeverWrittenAcrossTexts) {
    const Polygon plate{{{0, 0}, {30, 0}, {30, 10}, {0, 10}}, {}};
    const EdgeIndex edges(edges_of(plate), {});
    const std::vector<Segment> middle{{{0, 5}, {30, 5}}};
    const auto place = [&](bool text) {
        Drawing drawing;
        drawing.all = {EdgeIndex({}, middle), 4.0};
        if (text) drawing.texts = {EdgeIndex({}, middle), 4.0};
        return place_on_plate(edges, drawing, bounds(plate.outer), "2. sign");
    };
    EXPECT_TRUE(place(false).has_value());
    EXPECT_FALSE(place(true).has_value());
}

TEST(Labels, NamesInTabsHaveRoomBelowTheirLine) {
    for (const double depth : {3.6, 5.0, 7.0, 10.0}) {
        const std::vector<Ring> parts{{{0, 0}, {80, 0}, {80, depth}, {0, depth}}};
        const auto spot = place_if_it_fits(parts, "2L jumpy");
        ASSERT_TRUE(spot) << depth;
        EXPECT_GE(spot->at.y - (0.5 + 0.34) * spot->height, 0.39) << depth;
    }
    EXPECT_FALSE(place_if_it_fits(std::vector<Ring>{{{0, 0}, {80, 0}, {80, 2.5}, {0, 2.5}}}, "2L jumpy"));
}

TEST(Labels, NamesOfPiecesStandClearOfFoldsCutsAndTargets) {
    Card card;
    card.v_fold(-30, 60, 50 * kPi / 180, 70 * kPi / 180, 40);
    const Pattern pattern = card.pattern();
    for (const PatternPiece& piece : pattern.pieces) {
        const auto label = std::find_if(piece.labels.begin(), piece.labels.end(),
                                        [](const Label& l) { return l.kind == LabelKind::piece; });
        ASSERT_NE(label, piece.labels.end());
        // The base has no tabs; the v-fold's are 1L and 1R.
        EXPECT_EQ(label->text, (piece.name == "page" ? "" : "1. ") + piece.name);
        const double c = std::cos(label->angle);
        const double s = std::sin(label->angle);
        const Vec2 x = 0.5 * text_width(label->text, label->height_mm) * Vec2{c, s};
        const Vec2 y = 0.5 * label->height_mm * Vec2{-s, c};
        const Ring box{label->at - x - y, label->at + x - y, label->at + x + y, label->at - x + y};
        EXPECT_TRUE(contains({piece.silhouette[0].outer, {}}, label->at));
        for (const GlueTarget& target : piece.targets) EXPECT_GT(ring_distance(box, target.outline), 0.0);
        for (const Segment& side : sides_of(box)) {
            for (const PatternLine& line : piece.lines) EXPECT_GT(distance(side, line.at), 0.5);
            for (const Contour& contour : piece.cuts) {
                for (const Segment& cut : sides_of(contour)) EXPECT_GT(distance(side, cut), 0.5);
            }
        }
    }
}

// On printed backs a name stands where it does on the front, seen from behind.
TEST(Labels, NamesOfPiecesStandClearOfTargetsOnTheirBacksWhereTheyCan) {
    const Compilation made = compile({{"box.xml", R"(<popup version="3.0" units="mm">
  <mainpage width="120" height="80"/>
  <structurelist>
    <structure type="box" id="bx" height="15"><outerpoints>
      <point x="-20" y="-22"/><point x="-20" y="23"/><point x="20" y="-22"/><point x="20" y="23"/>
    </outerpoints><parentfold on="gutter"/></structure>
  </structurelist>
</popup>)"}},
                                     {}, {});
    ASSERT_TRUE(made.layout.has_value());
    int backs = 0;
    for (const PatternPiece& piece : made.layout->designs[0].pattern.pieces) {
        for (const GlueTarget& target : piece.targets) {
            if (!target.on_back) continue;
            ++backs;
            for (const Label& label : piece.labels) {
                if (label.kind != LabelKind::piece) continue;
                EXPECT_FALSE(contains({target.outline, {}}, label.at) ||
                             contains({Ring(target.outline.rbegin(), target.outline.rend()), {}}, label.at));
            }
        }
    }
    EXPECT_EQ(backs, 1);
}

TEST(Labels, NamesOfPiecesStandClearOfDrawnLinesWhereTheyCan) {
    Card card;
    const Vec2 before = card.pattern().pieces[0].labels[0].at;
    card.assembly.plates[0].prints.emplace_back(Stroke{{before - Vec2{3, 3}, before + Vec2{3, 3}}, 2.0, {}});
    card.assembly.plates[1].prints.emplace_back(Stroke{{{50, -80}, {50, 80}}, 90.0, {}});
    const Label label = card.pattern().pieces[0].labels[0];
    for (const Plate& plate : card.assembly.plates) {
        for (const Stroke& stroke : test::prints_of<Stroke>(plate.prints)) {
            const Segment line{stroke.points[0], stroke.points[1]};
            EXPECT_GT(distance(label.at, line), 0.5 * stroke.width_mm + 0.5 * label.height_mm);
        }
    }
    card.assembly.plates[0].prints.emplace_back(Stroke{{{-50, -80}, {-50, 80}}, 100.0, {}});
    EXPECT_EQ(card.pattern().pieces[0].labels.size(),
              1U);  // no room left beside them, but never without a name
}

// Two pieces may be glued to one place of a plate, if it is on both sides of it.
TEST(Labels, WhatIsGluedToABackHasItsTargetThere) {
    Card card;
    for (const bool back : {true, false}) {
        Plate flat;
        flat.name = back ? "behind" : "before";
        flat.piece = static_cast<int>(card.assembly.pieces.size());
        flat.outline.outer = {{0, 0}, {40, 0}, {40, 30}, {0, 30}};
        flat.lying = back ? Lying::on_back : Lying::on_front;
        const int plate = static_cast<int>(card.assembly.plates.size());
        card.assembly.pieces.push_back({flat.name, {plate}});
        card.assembly.plates.push_back(flat);
        card.assembly.glued_areas.push_back(
            {plate, 1, {{{{40, -20}, {80, -20}, {80, 10}, {40, 10}}, {}}}, back ? "1" : "2", flat.name, {}});
    }
    card.v_fold(-40, 30, kPi / 4, kPi / 5, 20);
    card.assembly.glue.back().on_back = true;
    const Pattern pattern = card.pattern();
    const PatternPiece& page = pattern.pieces[0];
    std::map<std::string, bool> targets;
    for (const GlueTarget& one : page.targets) targets[one.label] = one.on_back;
    const std::map<std::string, bool> expected{{"1", true}, {"2", false}, {"3L", false}, {"3R", true}};
    EXPECT_EQ(targets, expected);
    std::map<std::string, bool> labels;
    for (const Label& one : page.labels) {
        if (one.kind == LabelKind::target) labels[one.text] = one.on_back;
    }
    EXPECT_EQ(labels, expected);
}

// It has no tab that says where it is glued.
TEST(Labels, SmallPiecesThatAreGluedFlatHaveTheirNumberAtLeast) {
    Card card;
    for (const double width : {10.0, 60.0}) {
        Plate flat;
        flat.name = width < 20.0 ? "small one" : "large one";
        flat.piece = static_cast<int>(card.assembly.pieces.size());
        flat.outline.outer = {{0, 0}, {width, 0}, {width, 12}, {0, 12}};
        flat.lying = Lying::on_front;
        const int plate = static_cast<int>(card.assembly.plates.size());
        card.assembly.pieces.push_back({flat.name, {plate}});
        card.assembly.plates.push_back(flat);
        card.assembly.glued_areas.push_back(
            {plate,
             1,
             {{{{20, width}, {30, width}, {30, 6 + width}, {20, 6 + width}}, {}}},
             std::to_string(plate),
             flat.name,
             {}});
    }
    const Pattern pattern = card.pattern();
    ASSERT_EQ(pattern.pieces[1].labels.size(), 1U);
    EXPECT_EQ(pattern.pieces[1].labels[0].text, "2");
    ASSERT_EQ(pattern.pieces[2].labels.size(), 1U);
    EXPECT_EQ(pattern.pieces[2].labels[0].text, "3. large one");
}

// Nobody holds a loose piece the right way up.
TEST(Labels, NumbersThatAreOthersUpsideDownEndWithAStop) {
    const std::map<std::string, std::string> expected{
        {"1", "1"},   {"2", "2"},     {"6", "6."},     {"7", "7"},     {"8", "8"},
        {"9", "9."},  {"10", "10"},   {"11", "11"},    {"16", "16."},  {"18", "18."},
        {"26", "26"}, {"60", "60"},   {"66", "66."},   {"69", "69"},   {"88", "88"},
        {"6L", "6L"}, {"100", "100"}, {"106", "106."}, {"186", "186."}};
    for (const auto& [number, text] : expected) EXPECT_EQ(upright_number(number), text);
}

// On the place, on the back that is glued, and where it is all that a small piece says.
TEST(Labels, NumbersOfWhatIsGluedFlatCanBeTurned) {
    Card card;
    Plate flat;
    flat.name = "small one";
    flat.piece = 1;
    flat.outline.outer = {{0, 0}, {10, 0}, {10, 12}, {0, 12}};
    flat.lying = Lying::on_front;
    card.assembly.pieces.push_back({flat.name, {2}});
    card.assembly.plates.push_back(flat);
    card.assembly.glued_areas.push_back(
        {2, 1, {{{{20, 20}, {30, 20}, {30, 32}, {20, 32}}, {}}}, "9", flat.name, {}});
    const Pattern pattern = card.pattern();
    ASSERT_EQ(pattern.pieces[1].labels.size(), 1U);
    EXPECT_EQ(pattern.pieces[1].labels[0].text, "9.");
    const auto& on_page = pattern.pieces[0].labels;
    EXPECT_TRUE(std::any_of(on_page.begin(), on_page.end(), [](const Label& one) {
        return one.kind == LabelKind::target && one.text == "9.";
    }));
    EXPECT_EQ(pattern.pieces[0].targets.at(0).label, "9");
}

}  // namespace
}  // namespace popup
