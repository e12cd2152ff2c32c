// Elements in one place, and the moves that are told of: who obeys one has moved it off everything.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "popup/motion.h"
#include "support/designs.h"

namespace popup {
namespace {

struct Span {
    double low = 0.0, high = 0.0;
};

// Tents on the gutter of a card of 200 × 300 mm, from `low` to `high` along it.
Design tents(const std::vector<Span>& spans) {
    Design design = test::card(200, 300);
    for (const Span& one : spans)
        test::add(design, "tent",
                  {{-25, one.low},
                   {-25, one.high},
                   {25, one.low},
                   {25, one.high},
                   {-36, one.low},
                   {-36, one.high},
                   {36, one.low},
                   {36, one.high}});
    return design;
}

// "e2 on e1: hint" of each pair that is told of, a line each.
std::string told(const std::vector<Span>& spans) {
    test::Built built = test::build(tents(spans));
    if (!built.assembly) return test::findings(built.diagnostics);
    Diagnostics diagnostics;
    simulate(*built.assembly, {}, diagnostics);
    std::string text;
    for (const Diagnostic& one : diagnostics.sorted()) {
        if (one.code != "lies-on-another") continue;
        text += one.element + ":";
        for (const std::string& hint : one.hints) text += " " + hint;
        text += "\n";
    }
    return text;
}

std::string move(const std::string& name, double mm) {
    return fmt::format(
        "moving \"{}\" {:.2f} mm along its fold, by (0.00, {:.2f}) mm on the page, parts the two", name,
        std::abs(mm), mm);
}

TEST(Lying, TheShortestMoveIsToldWhereNothingElseIsNear) {
    EXPECT_EQ(told({{0, 40}, {20, 60}}), "e2: " + move("e2", 20) + "\n");
    EXPECT_EQ(told({{0, 40}, {40, 60}}), "");
}

// Down from the one the first tent would lie on the third, up from the other the second on the fourth.
TEST(Lying, AMoveGoesPastAThirdElement) {
    const std::vector<Span> spans{{0, 40}, {20, 60}, {-30, -5}, {62, 100}};
    EXPECT_EQ(told(spans), "e2: " + move("e1", -70.02) + "\n");
    EXPECT_EQ(told({{-70.02, -30.02}, {20, 60}, {-30, -5}, {62, 100}}), "");
}

// Of three in one place the one that lies on both others is moved, not, by half as far, one of them.
TEST(Lying, AMoveOffOneOfTwoIsOffTheOtherToo) {
    const std::vector<Span> spans{{-40, 0}, {0, 40}, {-20, 30}};
    EXPECT_EQ(told(spans), "e3: " + move("e3", 60) + "\n");
    EXPECT_EQ(told({{-40, 0}, {0, 40}, {40, 90}}), "");
}

TEST(Lying, WhereNoMoveWorksThatIsSaid) {
    EXPECT_EQ(
        told({{-140, -60}, {-90, 10}, {5, 70}, {71, 145}}),
        "e2: make one of the two smaller, or take it out: no move of one along what it stands on was found "
        "that leaves it on nothing\n"
        "e3: make one of the two smaller, or take it out: no move of one along what it stands on was found "
        "that leaves it on nothing\n");
}

}  // namespace
}  // namespace popup
