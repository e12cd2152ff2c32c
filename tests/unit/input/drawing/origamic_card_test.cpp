// Drawn cards of which no elements are found: what is drawn is cut and folded, and each corner is where the
// rules of origamic architecture have it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "input/assembly/guarantees.h"
#include "popup/compile.h"
#include "popup/motion.h"
#include "support/drawn_cards.h"
#include "support/line_sets.h"
#include "support/random.h"
#include "support/sanitized.h"

namespace popup {
namespace {

using test::Hand;
using test::InkedCard;
using test::Pen;

CompiledDesign compiled(std::string text, Stage until = Stage::pattern) {
    CompileOptions options;
    options.read.drawing.as = DrawnAs::card;
    options.until = until;
    options.motion.examine = false;
    return compile({Source{"card.svg", std::move(text)}}, options, {}).designs.front();
}

std::string findings(const CompiledDesign& one) {
    std::string text;
    for (const Diagnostic& told : one.diagnostics.sorted()) {
        if (told.code == "line-meaning" || told.code == "protrusion") continue;
        text += std::string(told.code) + ": " + told.message + "\n";
    }
    return text;
}

constexpr std::string_view kToldAlways = "card-of-no-elements: this card is not made of elements; ";

// A point of the sheet, and where it is in the card that is open by 90°: so far before the back, so high over
// the floor.
struct Spot {
    Vec2 on_sheet;
    double depth, height;
};

struct Skyline {
    InkedCard card;
    std::vector<Spot> spots;
};

// Strips beside one another, each as deep and as high as it likes, with figures that stand up at its front
// edge, or that reach forwards from it. The gutter and the folds of the strips may be drawn as whole lines.
enum class Folds { up_to_cuts, whole };
Skyline skyline(std::uint64_t seed, Folds folds = Folds::up_to_cuts) {
    std::mt19937 random(static_cast<std::mt19937::result_type>(seed));
    const auto tenths = [&](int low, int high) {
        return 0.1 * static_cast<double>(
                         10 * low + static_cast<int>(random() % static_cast<unsigned>(10 * (high - low))));
    };
    Skyline made;
    InkedCard& card = made.card;
    card.width = 240;
    card.height = 200;
    const auto fold = [&](Pen pen, double x, double from, double to) {
        card.line(pen, {{x, from}, {x, to}});
    };
    double y = -0.5 * card.height;
    double gutter = y;
    while (y + 50 < 0.5 * card.height) {
        const double from = y + tenths(2, 8);
        const double to = from + tenths(24, 36);
        const double depth = tenths(15, 40);
        const double high = tenths(15, 40);
        const double edge = depth - high;
        y = to;
        if (folds == Folds::up_to_cuts) fold(Pen::valley, 0, gutter, from);
        if (folds == Folds::up_to_cuts) gutter = to;
        for (const double cut : {from, to}) card.line(Pen::cut, {{-high, cut}, {depth, cut}});
        // The figure: with a shoulder, so that it has corners that nobody else has.
        const double left = from + tenths(4, 8);
        const double right = to - tenths(4, 8);
        const bool up = random() % 3 != 0;
        const double way = up ? -1.0 : 1.0;
        const double size = tenths(5, 60);
        const double over =
            up ? size - (edge + high) : size - (depth - edge);  // beyond the far fold of the strip
        const double shoulder = 0.5 * (left + right);
        const double tip = edge + way * size;
        // Lines that are near to one another may be meant as one.
        const double beside_gutter = std::min({std::abs(edge), std::abs(tip), std::abs(tip - 1.5 * way)});
        if (std::abs(over) < 3.0 || beside_gutter < 1.0) return skyline(seed + 1000, folds);
        card.line(Pen::cut,
                  {{edge, left}, {tip, left}, {tip, shoulder}, {tip - 1.5 * way, right}, {edge, right}});
        fold(Pen::mountain, edge, from, left);
        fold(Pen::mountain, edge, right, to);
        const auto side = [&](double x, bool crossed) {
            const bool parted = crossed && folds == Folds::up_to_cuts;
            fold(Pen::valley, x, from, parted ? left : to);
            if (parted) fold(Pen::valley, x, right, to);
        };
        side(-high, up && over > 0.0);
        side(depth, !up && over > 0.0);
        // What stands up is at the depth of the strip's front, what reaches forwards at the height of its
        // top.
        for (const Vec2 at : {Vec2{tip, left}, Vec2{tip, shoulder}})
            made.spots.push_back({at, up ? depth : at.x + high, up ? depth - at.x : high});
    }
    fold(Pen::valley, 0, gutter, 0.5 * card.height);
    return made;
}

TEST(OrigamicCard, RandomSkylinesAreCutAsTheyAreDrawnAndStandWhereTheyMust) {
    for (std::uint64_t seed = 1; seed <= test::sanitized_count<std::uint64_t>(120, 6); ++seed) {
        const Skyline drawn = skyline(seed);
        test::HandOptions options;
        options.lying = seed % 2 == 0;
        options.doubled = seed % 5 == 0;
        const bool whole = seed % 3 == 1;
        const InkedCard& card = whole ? skyline(seed, Folds::whole).card : drawn.card;
        const std::string text = test::draw_card(card, test::kHands.at(seed % 6), options, seed);
        const CompiledDesign one = compiled(text);
        const std::string what = fmt::format("seed {}\n{}\n", seed, findings(one));
        ASSERT_TRUE(one.pattern && one.assembly) << what << text;
        EXPECT_EQ(findings(one).find(whole ? "fold-drawn-on: " : kToldAlways), 0U) << what;
        ASSERT_EQ(one.pattern->pieces.size(), 1U) << what;
        EXPECT_LE(test::apart(drawn.card.sets(), test::lines_of(one.pattern->pieces.front())), 0.01) << what;
        EXPECT_TRUE(faults_of(*one.assembly).empty()) << what;
        std::vector<Frame> frames(one.assembly->plates.size());
        for (const double deg : {0.0, 20.0, 90.0, 133.0, 180.0}) {
            ASSERT_TRUE(place(*one.assembly, Angle::degrees(deg), frames)) << what;
            EXPECT_LE(closure_error(*one.assembly, frames), 1e-6) << what << deg;
        }
        ASSERT_TRUE(place(*one.assembly, Angle::degrees(90.0), frames));
        for (const Spot& spot : drawn.spots) {
            int owners = 0;
            for (std::size_t i = 2; i < one.assembly->plates.size(); ++i) {
                for (const Vec2 corner : one.assembly->plates[i].outline.outer) {
                    if (distance(corner, spot.on_sheet) > 0.01) continue;
                    // The back goes up to the left of the spine, the floor forwards to the right.
                    const double half = std::numbers::sqrt2 / 2.0;
                    const Vec3 wanted{half * (spot.depth - spot.height), corner.y,
                                      half * (spot.depth + spot.height)};
                    const Vec3 got = frames[i].point(corner);
                    // Beside the figure is the paper that it was cut out of.
                    if (length(got - wanted) <= 0.02) ++owners;
                }
            }
            EXPECT_EQ(owners, 1) << what << spot.on_sheet.x << ' ' << spot.on_sheet.y;
        }
        if (HasFailure()) return;
    }
}

constexpr std::string_view kHead =
    R"(<svg xmlns="http://www.w3.org/2000/svg" width="200mm" height="140mm" viewBox="0 0 200 140" fill="none" stroke="#000">
<path d="M0 0H200V140H0Z"/>
)";

std::string drawing(std::string_view lines) { return std::string(kHead) + std::string(lines) + "</svg>\n"; }

TEST(OrigamicCard, WhatDoesNotMoveInOneWayIsAnError) {
    // A strip of four plates between the halves of the page, which nothing else holds.
    const std::string strip = drawing(R"(<path stroke="#00f" d="M100 0V30M100 60V140"/>
<path d="M70 30H120M70 60H120"/>
<path stroke="#00f" d="M70 30V60M95 30V60M120 30V60"/><path stroke="#f00" d="M80 30V60M105 30V60"/>)");
    EXPECT_NE(findings(compiled(strip)).find("not-understood"), std::string::npos)
        << findings(compiled(strip));
    // A flap that hangs on one fold.
    const std::string flap = drawing(R"(<path stroke="#00f" d="M100 0V30M100 110V140"/>
<path d="M60 30H130M60 110H130"/><path stroke="#00f" d="M60 30V110M130 30V110"/><path stroke="#f00" d="M90 30V110"/>
<path d="M90 50H100V60H90"/>)");
    EXPECT_NE(findings(compiled(flap)).find("not-understood"), std::string::npos);
    // The same flap without the fold at its foot is read.
    std::string stands = flap;
    stands.replace(stands.find("M90 30V110"), 10, "M90 30V50M90 60V110");
    EXPECT_EQ(findings(compiled(stands)).find(kToldAlways), 0U) << findings(compiled(stands));
}

// Elements leave paper between them, and no element is parted by a hole.
TEST(OrigamicCard, WhatElementsCannotShareIsFoldedAsItIsDrawn) {
    const std::string comb = drawing(R"(<path stroke="#00f" d="M100 0V20M100 80V140"/>
<path d="M80 20H120M60 40H140M60 60H140M80 80H120"/>
<path stroke="#00f" d="M80 20V40M120 20V40M60 40V60M140 40V60M80 60V80M120 60V80"/>
<path stroke="#f00" d="M100 20V80"/>)");
    // A front on two columns: an opening from its fold on the page to its upper edge.
    const std::string columns = drawing(R"(<path stroke="#00f" d="M100 0V30M100 110V140"/>
<path d="M60 30H130M60 110H130"/><path stroke="#00f" d="M60 30V110M130 30V50M130 90V110"/>
<path stroke="#f00" d="M90 30V50M90 90V110"/><path d="M90 50H130V90H90Z"/>)");
    for (const auto& [text, plates] : {std::pair{comb, 6U}, {columns, 3U}}) {
        const CompiledDesign one = compiled(text);
        EXPECT_EQ(findings(one).find(kToldAlways), 0U) << findings(one);
        ASSERT_TRUE(one.assembly && one.pattern);
        EXPECT_EQ(one.assembly->plates.size(), plates + 2);
        EXPECT_EQ(one.pattern->pieces.size(), 1U);
        std::vector<Frame> frames(one.assembly->plates.size());
        ASSERT_TRUE(place(*one.assembly, Angle::degrees(70.0), frames));
        EXPECT_LE(closure_error(*one.assembly, frames), 1e-6);
    }
}

TEST(OrigamicCard, WhatIsInTheWayIsTold) {
    // A gable that stands up at a fold, and a v-fold beside it.
    const std::string both = drawing(R"(<path stroke="#00f" d="M100 0V15M100 65V85M100 115V140"/>
<path d="M85 15H130M85 65H130M115 25H105L95 40L105 55H115"/>
<path stroke="#00f" d="M85 15V65M130 15V65"/><path stroke="#f00" d="M115 15V25M115 55V65M100 85V115"/>
<path stroke="#00f" d="M100 85L75 115M100 85L125 115"/><path d="M75 115H125"/>)");
    EXPECT_NE(findings(compiled(both)).find("but this fold does not run along the gutter"), std::string::npos)
        << findings(compiled(both));
}

// Whoever scores with one colour has not said which way folds go.
TEST(OrigamicCard, FoldsOfOneKindAreFolds) {
    const std::string text = drawing(R"(<path stroke="#00f" d="M100 0V30M100 110V140"/>
<path d="M60 30H130M60 110H130"/><path stroke="#00f" d="M60 30V110M130 30V110M90 30V50M90 60V110"/>
<path d="M90 50H100V60H90"/>)");
    EXPECT_EQ(findings(compiled(text)).find("fold-other-way"), std::string::npos) << findings(compiled(text));
}

TEST(OrigamicCard, FoldsThatAreDrawnTheOtherWayAreTold) {
    const std::string text = drawing(R"(<path stroke="#00f" d="M100 0V30M100 110V140"/>
<path d="M60 30H130M60 110H130"/><path stroke="#00f" d="M60 30V110M130 30V110M90 30V50"/><path stroke="#f00" d="M90 60V110"/>
<path d="M90 50H100V60H90"/>)");
    EXPECT_NE(findings(compiled(text)).find("fold-other-way: 1 of 6 stretches"), std::string::npos)
        << findings(compiled(text));
}

TEST(OrigamicCard, FoldsThatAreDrawnALittleOffAreMovedTogether) {
    const std::string text = drawing(R"(<path stroke="#00f" d="M100 0V30M100 110V140"/>
<path d="M60 30H130M60 110H130"/><path stroke="#00f" d="M60 30V110M130.2 30V110"/>
<path stroke="#f00" d="M90 30V50M90 60V110"/><path d="M90 50H100V60H90"/>)");
    const CompiledDesign one = compiled(text);
    EXPECT_NE(findings(one).find("fold-straightened: folds of this card are up to 0.20 mm off"),
              std::string::npos)
        << findings(one);
    ASSERT_TRUE(one.assembly);
    std::vector<Frame> frames(one.assembly->plates.size());
    ASSERT_TRUE(place(*one.assembly, Angle::degrees(70.0), frames));
    EXPECT_LE(closure_error(*one.assembly, frames), 1e-6);
}

}  // namespace
}  // namespace popup
