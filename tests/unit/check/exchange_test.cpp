// Points in each other's places: the hint names the fewest exchanges, and who obeys it has an element that
// needs no repair.
#include "check/exchange.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "support/designs.h"

namespace popup::test {
namespace {

// The numbers of the points that such a hint names: "exchange A with B, then G with H: …".
std::vector<Exchange> named_in(const std::string& hint, const ElementInfo& info) {
    const auto number = [&](char letter) {
        const auto found = std::find_if(info.points.begin(), info.points.end(), [&](const PointInfo& point) {
            return point.letter == std::string_view(&letter, 1);
        });
        return static_cast<std::size_t>(found - info.points.begin());
    };
    std::vector<Exchange> named;
    for (auto at = hint.find(" with "); at != std::string::npos; at = hint.find(" with ", at + 1))
        named.emplace_back(number(hint[at - 1]), number(hint[at + 6]));
    return named;
}

void exchange(Structure& structure, const Exchange& points) {
    std::swap(structure.points[points.first], structure.points[points.second]);
}

// Exchanges these points, and obeys what check() says of that. True if it said it.
bool obeyed(Design design, const std::vector<Exchange>& exchanged) {
    const ElementInfo& info = *find_element(design.structures.front().type);
    for (const Exchange& one : exchanged) exchange(design.structures.front(), one);
    Diagnostics told;
    check(design, {}, told);
    for (const Diagnostic& finding : told.sorted()) {
        if (finding.code != "points-exchanged") continue;
        const auto named = named_in(finding.hints.at(0), info);
        EXPECT_FALSE(named.empty());
        EXPECT_LE(named.size(), exchanged.size());
        for (const Exchange& one : named) exchange(design.structures.front(), one);
        Diagnostics left;
        EXPECT_TRUE(check(design, {}, left));
        EXPECT_EQ(findings(left), "") << finding.hints.at(0);
        return true;
    }
    return false;
}

TEST(Exchange, OfTwoPointsOfAnyElementIsNamedSoThatItCanBeObeyed) {
    for (const ElementInfo& info : element_table()) {
        if (!info.grounds.fold || info.points.size() < 2) continue;
        int named = 0, failed = 0;
        for (std::uint64_t seed = 1; seed <= 4; ++seed) {
            const Design design = generate_of(info, seed, 1);
            if (design.structures.empty()) continue;
            for (std::size_t i = 0; i < info.points.size(); ++i) {
                for (std::size_t j = i + 1; j < info.points.size(); ++j) {
                    if (info.points[i].page != info.points[j].page) continue;
                    SCOPED_TRACE(std::string(info.name) + " " + std::to_string(seed) + " " +
                                 to_text({{i, j}}, info));
                    Design wrong = design;
                    exchange(wrong.structures.front(), {i, j});
                    Diagnostics told;
                    failed += check(wrong, {}, told) ? 0 : 1;
                    named += obeyed(design, {{i, j}}) ? 1 : 0;
                }
            }
        }
        EXPECT_EQ(named, failed) << info.name << ": whatever one exchange broke, one mends";
    }
}

TEST(Exchange, OfTwiceTwoPointsIsFoundToo) {
    const ElementInfo& tent = *find_element("tent");
    Design design = card();
    add_tent(design, 0, 20, 25, 30);
    // A with B and K with L: what is left of either exchange alone would be a tent with crossed edges.
    EXPECT_TRUE(obeyed(design, {{0, 1}, {6, 7}})) << to_text({{0, 1}, {6, 7}}, tent);
}

TEST(Exchange, IsNotNamedWhereItMendsNothing) {
    Design design = card();
    Structure& tent = add_tent(design, 0, 20, 25, 30);
    for (std::size_t i = 0; i < 4; ++i) tent.points[i].at.y = 5;  // seams without length, in any order
    Diagnostics told;
    EXPECT_FALSE(check(design, {}, told));
    EXPECT_EQ(findings(told).find("points-exchanged"), std::string::npos) << findings(told);
    EXPECT_NE(findings(told).find("degenerate"), std::string::npos) << findings(told);
}

}  // namespace
}  // namespace popup::test
