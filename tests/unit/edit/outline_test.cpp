// Drawings of any place and size become silhouettes that stand on the seams of their piece.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "output/xml.h"
#include "popup/edit.h"
#include "support/designs.h"
#include "support/run_program.h"
#include "support/sanitized.h"

namespace popup::test {
namespace {

constexpr const char* kCard = R"(<popup version="3.0" units="mm">
  <mainpage width="200" height="140"/>
  <structurelist>
    <structure type="tent" id="tent">
      <outerpoints>
        <point x="-25" y="25"/> <point x="-25" y="45"/> <point x="25" y="25"/> <point x="25" y="45"/>
        <point x="-35" y="-10"/> <point x="-35" y="10"/> <point x="35" y="-10"/> <point x="35" y="10"/>
      </outerpoints>
      <parentfold on="gutter"/>
    </structure>
    <structure type="v-fold" id="bird">
      <outerpoints>
        <point x="-20" y="-13.218007"/> <point x="0" y="-30"/> <point x="20" y="-13.218007"/>
        <point x="-25.711504" y="4.533632"/> <point x="0" y="0"/> <point x="25.711504" y="4.533632"/>
        <point x="20" y="35"/> <point x="-20" y="35"/>
      </outerpoints>
      <parentfold on="gutter"/>
    </structure>
  </structurelist>
</popup>
)";

// y is down, as in every SVG drawing.
constexpr const char* kHouse =
    "m 60,200 v -50 h -8 l 48,-35 48,35 h -8 v 50 z m 20,-20 h 14 v -14 h -14 z m 26,0 h 14 v -14 h -14 z";
constexpr const char* kBird =
    "M 30,90 C 40,60 80,50 110,70 C 140,90 190,80 230,60 L 280,40 L 250,90 C 230,130 200,160 150,165 "
    "C 100,170 60,150 50,110 L 20,100 Z M 70,85 a 5,5 0 1 0 10,0 a 5,5 0 1 0 -10,0 Z";
constexpr const char* kWave =
    "M 10,50 L 10,20 C 25,0 40,0 55,20 S 85,40 110,15 L 110,50 C 90,60 70,40 50,50 S 30,45 10,50 Z";
constexpr const char* kFlower = "M 20,50 L 0.5,44 C -10,20 20,10 20,0 C 20,10 50,20 39.5,44 Z";
constexpr const char* kArch = "M 10,50 L 10,20 L 60,2 L 110,20 V 50 H 70 V 30 H 50 V 50 Z";
constexpr const char* kTwo = "M 0,0 h 30 v 20 h -30 z M 60,0 h 9 v 9 h -9 z";
constexpr const char* kCrossing = "M 0,0 h 30 v 20 h -30 z M 20,5 h 30 v 9 h -30 z";
constexpr const char* kStrip = "M 0,30 V 0 C 20,20 50,-20 70,5 V 30 C 50,20 20,45 0,30 Z";

std::string svg(const std::string& d, const std::string& transform = "") {
    return fmt::format(
        "<svg xmlns='http://www.w3.org/2000/svg' width='210mm' height='297mm' viewBox='0 0 210 297'>"
        "<g transform='{}'><path style='fill:#336699' d='{}'/></g></svg>",
        transform, d);
}

struct Done {
    std::string text, said;  // text: empty where it was refused
};

Done outlined(const std::string& card, const std::string& id, const std::string& drawing,
              const std::string& fit = "") {
    const ScratchDirectory scratch;
    write_file(scratch / "drawing.svg", drawing);
    EditLine line{{"outline", id, "--from", (scratch / "drawing.svg").string()}, {}};
    if (!fit.empty()) line.words.insert(line.words.end(), {"--fit", fit});
    Diagnostics of_edits("edits.txt");
    Diagnostics of_document("card.xml");
    const auto edited =
        edit_document({"card.xml", card}, std::vector<EditLine>{line}, {}, of_edits, of_document);
    Done done;
    if (edited && !edited->refused) done.text = edited->text;
    done.said = findings(of_edits) + findings(of_document);
    for (std::size_t at = 0; (at = done.said.find(scratch.path().string() + "/")) != std::string::npos;)
        done.said.erase(at, scratch.path().string().size() + 1);
    return done;
}

// The area of a piece, with its seams in its border, in order: seen with nothing but points.
struct Seen {
    Polygon area;
    double width = 0.0, height = 0.0;
};

Seen silhouette(const std::string& card, const std::string& id) {
    Diagnostics trouble("card.xml");
    const auto design = read_design({"card.xml", card}, {}, trouble);
    EXPECT_TRUE(design) << findings(trouble);
    for (const Structure& one : design->structures) {
        if (one.id != id) continue;
        const auto number = find_parameter(*find_element(one.type), "outline");
        const auto& path = std::get<DrawnPath>(one.arguments.at(number.value()).value);
        EXPECT_EQ(path.inside.areas.size(), 1U);
        Seen seen{path.inside.areas.front(), 0.0, 0.0};
        Box box;
        for (const Vec2 p : seen.area.outer) box.extend(p);
        seen.width = box.width();
        seen.height = box.height();
        return seen;
    }
    ADD_FAILURE() << "no " << id;
    return {};
}

// Whether the ring runs straight through these, one after the other.
bool goes_through(const Ring& ring, const std::vector<Vec2>& points) {
    const auto on_it = [&](Vec2 p) {
        for (std::size_t i = 0; i < ring.size(); ++i) {
            if (distance(p, Segment{ring[i], ring[(i + 1) % ring.size()]}) < 1e-5) return true;
        }
        return false;
    };
    for (std::size_t k = 0; k + 1 < points.size(); ++k) {
        for (int part = 0; part <= 20; ++part) {
            if (!on_it(lerp(points[k], points[k + 1], part / 20.0))) return false;
        }
    }
    return true;
}

const std::vector<Vec2> kSeams{{-25.711504, 4.533632}, {0, 0}, {25.711504, 4.533632}};

void expect_built(const std::string& card) {
    Diagnostics trouble("card.xml");
    const auto design = read_design({"card.xml", card}, {}, trouble);
    ASSERT_TRUE(design) << findings(trouble);
    const Built built = build(*design);
    ASSERT_TRUE(built.assembly);
    EXPECT_FALSE(built.diagnostics.has_errors()) << findings(built.diagnostics);
}

TEST(DrawnOutline, StandsOnTheSeamsOfItsPiece) {
    for (const auto& [drawing, holes] :
         {std::pair(kHouse, 2U), std::pair(kBird, 1U), std::pair(kWave, 0U), std::pair(kFlower, 0U)}) {
        for (const char* fit : {"", "seams", "width", "height", "both", "none"}) {
            SCOPED_TRACE(fmt::format("{} {}", drawing, fit));
            const Done done = outlined(kCard, "bird", svg(drawing), fit);
            ASSERT_NE(done.text, "") << done.said;
            const Seen seen = silhouette(done.text, "bird");
            EXPECT_TRUE(goes_through(seen.area.outer, kSeams));
            EXPECT_EQ(seen.area.holes.size(), holes);
            expect_built(done.text);
        }
    }
}

// What is drawn keeps its shape: a house of walls 80 apart and 50 high, eaves 96 and a ridge 85 above.
TEST(DrawnOutline, KeepsTheProportionsOfTheDrawing) {
    const double walls = 2 * 25.711504;
    const Seen house = silhouette(outlined(kCard, "bird", svg(kHouse)).text, "bird");
    EXPECT_NEAR(house.width, walls * 96 / 80, 1e-4);
    EXPECT_NEAR(house.height, 4.533632 + walls * 85 / 80, 1e-4);
    EXPECT_NEAR(area(house.area),
                walls * 4.533632 / 2 + (walls / 80) * (walls / 80) * (80 * 50 + 96 * 35 / 2.0 - 2 * 14 * 14),
                0.01);
    EXPECT_NEAR(silhouette(outlined(kCard, "bird", svg(kHouse), "width").text, "bird").width, 2 * 25.711504,
                1e-4);
    EXPECT_NEAR(silhouette(outlined(kCard, "bird", svg(kHouse), "none").text, "bird").width, 96.0, 1e-4);
}

// Wherever and however large it is drawn, also turned over by its group, it becomes the same.
TEST(DrawnOutline, DoesNotDependOnWhereItIsDrawn) {
    for (const char* drawing : {kHouse, kBird, kWave, kFlower}) {
        const Seen one = silhouette(outlined(kCard, "bird", svg(drawing)).text, "bird");
        for (const char* transform : {"translate(-300 40)", "scale(0.125)", "translate(7 9) scale(3.5)"}) {
            const Done done = outlined(kCard, "bird", svg(drawing, transform));
            const Seen other = silhouette(done.text, "bird");
            EXPECT_NEAR(area(one.area), area(other.area), 0.01 * one.width) << drawing << transform;
            EXPECT_NEAR(one.width, other.width, 0.02) << drawing << transform;
            EXPECT_NEAR(one.height, other.height, 0.02) << drawing << transform;
        }
    }
}

TEST(DrawnOutline, LiesBetweenTheSeamsOfATent) {
    const Done strip = outlined(kCard, "tent", svg(kStrip));
    ASSERT_NE(strip.text, "") << strip.said;
    const Ring ring = silhouette(strip.text, "tent").area.outer;
    EXPECT_TRUE(goes_through(ring, {{-35, 10}, {-35, -10}}));
    EXPECT_TRUE(goes_through(ring, {{35, -10}, {35, 10}}));
    expect_built(strip.text);
    // One that is too low is stretched where that is asked for.
    const std::string low = svg("M 0,10 V 0 C 20,8 50,-8 70,0 V 10 C 50,6 20,14 0,10 Z");
    const Done refused = outlined(kCard, "tent", low);
    EXPECT_EQ(refused.text, "");
    EXPECT_EQ(refused.said,
              "error bad-edit: the drawing in drawing.svg is too low: its right edge becomes 10.0 mm "
              "long, and tent.right is 20.0 mm\n");
    const Done stretched = outlined(kCard, "tent", low, "both");
    ASSERT_NE(stretched.text, "") << stretched.said;
    EXPECT_TRUE(goes_through(silhouette(stretched.text, "tent").area.outer, {{35, -10}, {35, 10}}));
    expect_built(stretched.text);
}

TEST(DrawnOutline, SaysWhatItCannotStandOn) {
    for (const auto& [id, drawing, said] :
         {std::tuple("bird", kArch, "is open at its lower end: between its feet it rises 10.3 mm above them"),
          std::tuple("bird", kTwo, "has 2 areas that do not hang together"),
          std::tuple("bird", kCrossing, "has lines that cross each other"),
          std::tuple("bird", "M 0,0 L 30,0 L 15,100 Z", "has nothing to stand on"),
          std::tuple("bird", "M 0,0 L 30,0", "has no outline"),
          std::tuple("tent", kBird, "has no straight edge on its left, where tent.left is glued")}) {
        const Done done = outlined(kCard, id, svg(drawing));
        EXPECT_EQ(done.text, "") << said;
        EXPECT_NE(done.said.find(said), std::string::npos) << done.said;
    }
    EXPECT_NE(outlined(kCard, "bird", svg(kBird))
                  .said.find("remark drawing-cut: the drawing in drawing.svg has "
                             "no straight edge to stand on that is a fifth as wide as it is; its lowest"),
              std::string::npos);
}

// An ellipse as a polyline of so many points.
std::string fine_ellipse(int points, double rx, double ry) {
    std::string d = "M";
    for (int i = 0; i < points; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / points;
        d += fmt::format(" {:.4f},{:.4f}", 100.0 + rx * std::cos(angle), 150.0 + ry * std::sin(angle));
    }
    return d + " Z";
}

// However finely it is drawn, a round end is not taken for an edge or a corner; what is lost is told, with
// its size and place. Corners beside the ends of seams are the program's own: nobody is asked to draw better.
TEST(DrawnOutline, TellsOfRoundEndsHoweverFineTheyAre) {
    for (const auto& [points, rx, ry, lost] :
         {std::tuple(60, 30.0, 40.0, "its lowest 9.2 mm were cut off"),
          std::tuple(1000, 30.0, 40.0, "its lowest 9.2 mm were cut off"),
          std::tuple(50'000, 30.0, 40.0, "its lowest 9.2 mm were cut off"),
          std::tuple(400, 10.0, 120.0, "its lowest 83.0 mm were cut off"),
          std::tuple(12, 30.0, 40.0, "reaches 4.7 mm beyond bird.left and bird.right")}) {
        if (test::kSanitized && points > 1000) continue;
        const Done done = outlined(kCard, "bird", svg(fine_ellipse(points, rx, ry)));
        ASSERT_NE(done.text, "") << done.said;
        EXPECT_NE(done.said.find(lost), std::string::npos) << done.said;
        EXPECT_NE(done.said.find("between (-25.7, 4.5) and (25.7, 4.5) mm on its page"), std::string::npos)
            << done.said;
        EXPECT_EQ(done.said.find("outline-snapped"), std::string::npos) << done.said;
        EXPECT_TRUE(goes_through(silhouette(done.text, "bird").area.outer, kSeams));
        expect_built(done.text);
    }
}

// Fine points along straight walls and a straight base are that base.
TEST(DrawnOutline, TakesAFineLineForALine) {
    std::string d = "M 0,0";
    for (int i = 1; i <= 4000; ++i) d += fmt::format(" {:.4f},{:.4f}", i * 0.02, 1e-4 * (i % 3));
    for (int i = 1; i <= 2000; ++i) d += fmt::format(" {:.4f},{:.4f}", 80.0, -i * 0.02);
    const Done done = outlined(kCard, "bird", svg(d + " L 0,-40 Z"));
    ASSERT_NE(done.text, "") << done.said;
    EXPECT_EQ(done.said, "");
    EXPECT_NEAR(silhouette(done.text, "bird").width, 2 * 25.711504, 1e-3);
    expect_built(done.text);
}

TEST(DrawnOutline, TakesALineOnceThatIsDrawnTwice) {
    const std::string house = "M60,200 v-50 h-8 l48,-35 48,35 h-8 v50 z";
    const std::string other_way = "M140,150 h8 L100,115 L52,150 h8 v50 h80 z";
    const Done once = outlined(kCard, "bird", svg(house));
    for (const std::string& again : {house, other_way}) {
        const Done twice = outlined(kCard, "bird", svg(fmt::format("{} {}", house, again)));
        EXPECT_EQ(twice.text, once.text);
        EXPECT_EQ(twice.said.substr(0, 68),
                  "remark drawing-twice: the drawing in drawing.svg has a line twice, 8");
    }
    // The same hole drawn twice is a hole.
    const Done hole = outlined(kCard, "bird", svg(house + " M80,180 h9 v9 h-9 z M80,180 h9 v9 h-9 z"));
    EXPECT_EQ(silhouette(hole.text, "bird").area.holes.size(), 1U) << hole.said;
}

// What bulges beyond the ends of its curves counts: the piece is as wide as its drawing is to be.
TEST(DrawnOutline, MeasuresCurvesByWhatTheyReach) {
    const std::string card = R"(<popup version="3.0" units="mm">
  <mainpage width="200" height="140"/>
  <structurelist>
    <structure type="hole" id="sun"><outline d="M 20 0 H 60 V 30 H 20 Z"/></structure>
  </structurelist>
</popup>
)";
    const Done done = outlined(card, "sun", svg("M 50,100 C 10,60 130,60 90,100 Z"), "width");
    ASSERT_NE(done.text, "") << done.said;
    EXPECT_NEAR(silhouette(done.text, "sun").width, 40.0, 0.01);
}

// Pieces of all shapes: a drawing stands on them, or it is said why not; never a broken card.
TEST(DrawnOutline, NeverBreaksACard) {
    int tried = 0;
    int stood = 0;
    for (std::uint64_t seed = 1; seed <= sanitized_count<std::uint64_t>(60, 8); ++seed) {
        const Design design = generate(seed, 5);
        const std::string text = write_document(design);
        for (const Structure& one : design.structures) {
            const ElementInfo& info = *find_element(one.type);
            if (!find_parameter(info, "outline") || info.points.empty()) continue;
            for (const char* drawing : {kHouse, kBird, kStrip}) {
                ++tried;
                const Done done = outlined(text, one.id, svg(drawing));
                if (done.text.empty()) {
                    EXPECT_NE(done.said, "");
                } else {
                    ++stood;
                    expect_built(done.text);
                }
            }
        }
    }
    EXPECT_GT(tried, 50);
    EXPECT_GT(stood, tried / 4);
    ::testing::Test::RecordProperty("tried", tried);
    ::testing::Test::RecordProperty("stood", stood);
}

}  // namespace
}  // namespace popup::test
