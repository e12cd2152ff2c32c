// The cartons of the kit: each folds closed, in an order in which nothing passes through anything, with the
// room inside that was asked for, and with what is glued a board apart.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "popup/compile.h"
#include "popup/crease_pattern.h"
#include "popup/motion.h"
#include "support/brute_force.h"
#include "support/designs.h"
#include "support/sanitized.h"

namespace popup {
namespace {

struct CartonSize {
    double length, width, depth, board;
};
constexpr CartonSize kCartonSizes[]{
    {80, 50, 30, 0.5}, {150, 150, 150, 1.5}, {300, 200, 100, 3.0}, {120, 31.7, 87.3, 0.45}};
// Sanitized, each takes many seconds, in code that is the same.
std::span<const CartonSize> carton_sizes() {
    return std::span(kCartonSizes).first(test::sanitized_count(std::size(kCartonSizes)));
}

CompiledDesign compiled_carton(const std::string& call) {
    CompileOptions options;
    options.until = Stage::motion;
    Compilation run =
        compile({{"box.fl", "load(\"kit/carton.fl\")\n" + call + "\n"}}, options, DiagnosticPolicy{});
    return std::move(run.designs.front());
}

// A carton in its closed state.
class Closed {
 public:
    explicit Closed(const Assembly& assembly) : assembly_(assembly), frames_(assembly.plates.size()) {
        EXPECT_TRUE(place(assembly, Angle::degrees(0.0), frames_));
        EXPECT_LE(closure_error(assembly, frames_), 1e-6 * size());
    }
    // The plate that has this point of the sheet.
    [[nodiscard]] std::size_t at(Vec2 p) const {
        for (std::size_t i = 0; i < assembly_.plates.size(); ++i) {
            if (contains(assembly_.plates[i].outline, p)) return i;
        }
        ADD_FAILURE() << "no panel at " << p.x << ", " << p.y;
        return 0;
    }
    // The least and the largest distance of a plate's corners from the plane of another.
    [[nodiscard]] std::pair<double, double> apart(std::size_t plate, std::size_t other) const {
        const Frame& plane = frames_[other];
        const Vec3 at = plane.point({0, 0});
        const Vec3 normal = unit(cross(plane.point({1, 0}) - at, plane.point({0, 1}) - at));
        std::pair<double, double> range{1e9, 0.0};
        for (const Vec2 p : assembly_.plates[plate].outline.outer) {
            const double far = std::abs(dot(normal, frames_[plate].point(p) - at));
            range = {std::min(range.first, far), std::max(range.second, far)};
        }
        return range;
    }
    // Panels that are parallel, with this much between their middles, and lie over each other.
    void expect_apart(Vec2 on_plate, Vec2 on_other, double mm, const std::string& what) const {
        const std::size_t plate = at(on_plate);
        const std::size_t other = at(on_other);
        const auto [least, most] = apart(plate, other);
        EXPECT_NEAR(least, mm, 0.01) << what;
        EXPECT_NEAR(most, mm, 0.01) << what;
    }
    // Glued panels are a board apart, and the flap's middle lies over its panel.
    void expect_glued(Vec2 on_flap, Vec2 on_panel, double board) const {
        expect_apart(on_flap, on_panel, board, "what is glued");
        const Frame& panel = frames_[at(on_panel)];
        const Vec3 origin = panel.point({0, 0});
        const Vec3 to = frames_[at(on_flap)].point(on_flap) - origin;
        const Vec2 seen{dot(to, panel.point({1, 0}) - origin), dot(to, panel.point({0, 1}) - origin)};
        EXPECT_TRUE(contains(assembly_.plates[at(on_panel)].outline, seen))
            << "the flap lies beside its panel";
    }

 private:
    [[nodiscard]] double size() const {
        Box box;
        for (const Plate& plate : assembly_.plates) {
            for (const Vec2 p : plate.outline.outer) box.extend(p);
        }
        return std::max(box.width(), box.height());
    }
    const Assembly& assembly_;
    std::vector<Frame> frames_;
};

CompiledDesign expect_closes(const std::string& call) {
    CompiledDesign one = compiled_carton(call);
    // That its folds go in an order is a remark; nothing else is found.
    for (const Diagnostic& found : one.diagnostics.sorted())
        EXPECT_EQ(found.code, "folds-in-order") << call << ": " << found.message;
    EXPECT_TRUE(one.motion && one.motion->examination) << call;
    if (one.motion && one.motion->examination) {
        EXPECT_TRUE(one.motion->examination->contacts.empty()) << call;
        EXPECT_TRUE(one.motion->examination->undecided.empty()) << call;
    }
    return one;
}

// Tubes of four panels: front, right, back, left, from x = 0 on.
struct TubeCase {
    const char* function;
    bool ends;  // it has flaps on the right panel at either end
};
class FlatLangTubes : public testing::TestWithParam<TubeCase> {};

TEST_P(FlatLangTubes, CloseWithTheRoomThatWasAskedFor) {
    for (const CartonSize& of : carton_sizes()) {
        const std::string call =
            fmt::format("{}({}, {}, {}, {})", GetParam().function, of.length, of.width, of.depth, of.board);
        SCOPED_TRACE(call);
        const CompiledDesign one = expect_closes(call);
        if (!one.assembly) continue;
        const Closed box(*one.assembly);
        const double mid = of.depth / 2 + 2 * of.board;
        const double front = of.length / 2;
        const double right = of.length + of.width / 2;
        const double back = of.length + of.width + of.length / 2;
        const double left = 2 * of.length + 1.5 * of.width;
        box.expect_apart({front, mid}, {back, mid}, of.width + of.board, "front and back");
        box.expect_apart({right, mid}, {left, mid}, of.length + of.board, "right and left");
        box.expect_glued({-2, mid}, {left, mid}, of.board);
        if (!GetParam().ends) continue;
        // Not at the lower end: there are bottoms of several layers.
        const double high = of.depth + 5 * of.board;
        box.expect_apart({right, high}, {left, high}, 0.0, "dust flaps");
    }
}

INSTANTIATE_TEST_SUITE_P(, FlatLangTubes,
                         testing::Values(TubeCase{"straight_tuck_end", true},
                                         TubeCase{"reverse_tuck_end", true}, TubeCase{"sleeve", false},
                                         TubeCase{"auto_lock_bottom", true}, TubeCase{"fefco_0201", true},
                                         TubeCase{"fefco_0215", true}),
                         [](const auto& one) { return std::string(one.param.function); });

TEST(FlatLangCartons, AreAsDeepInsideAsAskedFor) {
    for (const std::string function : {"straight_tuck_end", "reverse_tuck_end", "fefco_0201"}) {
        const CompiledDesign one = expect_closes(function + "(80, 50, 30, 0.5)");
        ASSERT_TRUE(one.assembly);
        // Between the flaps of the right panel, which lie innermost.
        Closed(*one.assembly).expect_apart({105, -4}, {105, 36}, 30.5, function);
    }
    const CompiledDesign lock = expect_closes("auto_lock_bottom(80, 50, 30, 0.5)");
    Closed(*lock.assembly).expect_apart({105, -2}, {105, 36}, 30.5, "auto_lock_bottom");
    const CompiledDesign case_0215 = expect_closes("fefco_0215(80, 50, 30, 0.5)");
    // The flap of the back lies innermost.
    Closed(*case_0215.assembly).expect_apart({145, -4}, {105, 36}, 30.5, "fefco_0215");
}

TEST(FlatLangCartons, AutoLockBottomsAreGluedAtTheirCorners) {
    const CompiledDesign one = expect_closes("auto_lock_bottom(80, 50, 30, 0.5)");
    ASSERT_TRUE(one.assembly);
    const Closed box(*one.assembly);
    // Beyond the creases of the right and the left flap: on those of back and front.
    box.expect_glued({129, -12}, {140, -12}, 0.5);
    box.expect_glued({260, -12}, {10, -12}, 0.5);
    EXPECT_NE(box.at({129, -12}), box.at({100, -8}));
}

TEST(FlatLangCartons, TraysHaveTheirFlapsInsideTheirWalls) {
    for (const CartonSize& of : carton_sizes()) {
        const double lid = of.depth / 2;
        const CompiledDesign one = expect_closes(
            fmt::format("tray_with_lid({}, {}, {}, {}, {})", of.length, of.width, of.depth, lid, of.board));
        ASSERT_TRUE(one.assembly);
        EXPECT_EQ(one.assembly->pieces.size(), 2u);
        const Closed box(*one.assembly);
        const double long_mid = of.length + of.board;
        const double wide_mid = of.width + of.board;
        const double side = of.depth / 2;
        box.expect_apart({long_mid / 2, -side}, {long_mid / 2, wide_mid + side}, wide_mid, "front and back");
        box.expect_apart({-side, wide_mid / 2}, {long_mid + side, wide_mid / 2}, long_mid, "sides");
        box.expect_glued({-side, -2}, {long_mid / 2, -side}, of.board);
        box.expect_glued({long_mid + side, wide_mid + 2}, {long_mid / 2, wide_mid + side}, of.board);
        // The lid goes over the tray with a board of play all round.
        const double x = of.length + 2 * of.depth + 2 * lid + 20 * of.board + 10;
        box.expect_apart({x + of.length / 2, -lid / 2},
                         {x + of.length / 2, of.width + 4 * of.board + lid / 2}, of.width + 4 * of.board,
                         "walls of the lid");
    }
}

TEST(FlatLangCartons, HexagonalBoxesClose) {
    for (const CartonSize& of : carton_sizes()) {
        const CompiledDesign one =
            expect_closes(fmt::format("hexagonal_box({}, {}, {})", of.length, of.depth, of.board));
        ASSERT_TRUE(one.assembly);
        const Closed box(*one.assembly);
        const double side = (of.length + of.board) / std::sqrt(3.0);
        const double short_of = of.board * 2.0 / std::sqrt(3.0);
        const double mid = of.depth / 2 + 1.5 * of.board;
        const auto panel = [&](int i) { return Vec2{(i + 0.5) * side - short_of, mid}; };
        for (const int i : {0, 1, 2})
            box.expect_apart(panel(i), panel(i + 3), of.length + of.board, "opposite panels");
        box.expect_glued({-6, mid}, panel(5), of.board);
    }
}

TEST(FlatLangCartons, GiftBagsClose) {
    for (const CartonSize& of : {CartonSize{180, 80, 240, 0.2}, CartonSize{100, 50, 120, 0.3}}) {
        const CompiledDesign one =
            expect_closes(fmt::format("gift_bag({}, {}, {}, {})", of.length, of.width, of.depth, of.board));
        ASSERT_TRUE(one.assembly);
        const Closed bag(*one.assembly);
        const double front = of.length / 2;
        const double back = 1.5 * of.length + of.width;
        const double left = 2 * of.length + 1.75 * of.width;
        bag.expect_apart({front, 20}, {back, 20}, of.width + of.board, "front and back");
        bag.expect_glued({-2, 40}, {left, 40}, of.board);
        // The two flaps of the bottom that are glued, and the hem.
        bag.expect_glued({front, -0.6 * of.width}, {back, -0.6 * of.width}, of.board);
        bag.expect_apart({front, of.depth + 4}, {front, 20}, 0.0, "hem");
    }
}

// The tray and the case, which has a lid besides.
TEST(FlatLangCartons, Fefco0421And0427HaveDoubleWallsWithAFlapBetweenThem) {
    for (const bool lid : {false, true}) {
        for (const CartonSize& of : {CartonSize{300, 200, 100, 3.0}, CartonSize{200, 150, 60, 1.6},
                                     CartonSize{100, 31.7, 45, 0.45}}) {
            const CompiledDesign one = expect_closes(fmt::format(
                "fefco_{}({}, {}, {}, {})", lid ? "0427" : "0421", of.length, of.width, of.depth, of.board));
            ASSERT_TRUE(one.assembly);
            const Closed box(*one.assembly);
            const double wide = of.width + of.board;
            const double out = of.length + of.board + 4.5 * of.board;
            const double inner = 1.5 * of.depth;
            box.expect_apart({-inner, wide / 2}, {out + inner, wide / 2}, of.length + of.board,
                             "inner walls");
            box.expect_apart({out / 2, -of.depth / 2}, {out / 2, wide + of.depth / 2}, wide,
                             "front and back");
            box.expect_apart({-inner, wide / 2}, {-of.depth / 2, wide / 2}, 2.25 * of.board, "double wall");
            for (const double y : {-of.depth / 2, wide + of.depth / 2})
                box.expect_apart({-2, y}, {-of.depth / 2, wide / 2}, 1.125 * of.board, "flap in the wall");
            if (lid)
                box.expect_apart({out / 2, wide + of.depth + 5}, {out / 2, wide / 2}, of.depth + of.board,
                                 "lid");
        }
    }
}

// By code that knows no folds. Flaps that are tucked in go in upright, with their lids, at any opening.
TEST(FlatLangCartons, TuckTheirFlapsInWithoutPassingThroughAnything) {
    if (test::kSanitized) GTEST_SKIP() << "left to the ordinary build";
    const char* const upright = "\xC2\xB0; then";
    const std::pair<const char*, const char*> calls[]{{"straight_tuck_end(80, 50, 30, 0.5)", upright},
                                                      {"reverse_tuck_end(60, 40, 90, 0.5)", upright},
                                                      {"fefco_0421(300, 200, 80, 1.6)", "; then"},
                                                      {"fefco_0427(200, 150, 60, 1.6)", upright}};
    for (const auto& [call, order] : calls) {
        SCOPED_TRACE(call);
        const CompiledDesign one = expect_closes(call);
        ASSERT_TRUE(one.assembly);
        EXPECT_NE(test::findings(one.diagnostics).find(order), std::string::npos);
        if (!test::BruteForce::available()) GTEST_SKIP() << test::BruteForce::kMissing;
        const test::BruteForce brute(*one.assembly);
        for (double deg = 0.0; deg <= 180.0; deg += 1.5) EXPECT_TRUE(brute.crossing_at(deg).empty()) << deg;
    }
}

// The sizes that are just admitted, and some that are odd: tucks have no more depth than the box.
TEST(FlatLangCartons, ShallowBoxesCloseAsWell) {
    for (const std::string call :
         {"straight_tuck_end(80, 50, 6, 0.5)", "straight_tuck_end(20, 80, 10, 0.5)",
          "straight_tuck_end(10, 10, 5, 0.5)", "reverse_tuck_end(80, 50, 5, 0.5)",
          "auto_lock_bottom(80, 50, 5, 0.5)", "auto_lock_bottom(30, 80, 10, 0.5)",
          "fefco_0215(80, 50, 5, 0.5)", "fefco_0215(300, 10, 5, 0.5)", "hexagonal_box(60, 5, 0.5)",
          "hexagonal_box(20, 5, 0.5)", "fefco_0201(80, 50, 5, 0.5)", "fefco_0421(80, 50, 5, 0.5)",
          "fefco_0427(80, 50, 5, 0.5)", "tray_with_lid(10, 10, 5, 5, 0.5)", "gift_bag(10, 80, 5, 0.5)"})
        expect_closes(call);
}

// Of each piece of the carton, its panels' names, with blanks around them.
std::vector<std::string> panels_by_piece(const std::string& call) {
    CompileOptions options;
    options.until = Stage::assembly;
    const CompiledDesign one =
        compile({{"box.fl", "load(\"kit/carton.fl\")\n" + call + "\n"}}, options, {}).designs.front();
    std::map<std::string, std::string> pieces;
    if (!one.assembly) return {};
    for (const Plate& plate : one.assembly->plates) {
        const std::size_t end = plate.name.find('/');
        pieces[plate.name.substr(0, end)] += " " + plate.name.substr(end + 1) + " ";
    }
    std::vector<std::string> made;
    for (const auto& [piece, panels] : pieces) made.push_back(panels);
    return made;
}

TEST(FlatLangCartons, HaveTheirPanelsInOnePieceWhateverTheirSize) {
    const double board = 0.5;
    for (const double length : {20.0, 25.0, 31.0, 60.0, 200.0}) {
        for (const double width : {10.0, 20.0, 30.0, 60.0, 150.0}) {
            for (const double depth : {15.0, 80.0, 300.0}) {
                const std::string size = fmt::format("({}, {}, {}, {})", length, width, depth, board);
                for (const std::string tube : {"straight_tuck_end", "reverse_tuck_end", "auto_lock_bottom",
                                               "fefco_0201", "fefco_0215", "gift_bag"}) {
                    const auto pieces = panels_by_piece(tube + size);
                    ASSERT_EQ(pieces.size(), 1U) << tube << size;
                    EXPECT_NE(pieces[0].find(" glue-flap "), std::string::npos) << tube << size << pieces[0];
                    EXPECT_EQ(pieces[0].find(" base "), std::string::npos) << tube << size;
                }
            }
        }
    }
}

TEST(FlatLangCartons, DeepTraysStandOnTheirBottoms) {
    for (const double depth : {20.0, 60.0, 80.0, 100.0, 120.0, 200.0}) {
        const std::string call = fmt::format("tray_with_lid(60, 80, {}, 15, 0.6)", depth);
        const auto pieces = panels_by_piece(call);
        ASSERT_EQ(pieces.size(), 2U) << call;
        for (const std::string& panels : pieces) {
            for (const std::string name : {" base ", " front ", " back ", " left ", " right ", "-corner-"})
                EXPECT_NE(panels.find(name), std::string::npos) << call << panels;
            EXPECT_EQ(panels.find(" lid "), std::string::npos) << call << panels;
        }
    }
}

TEST(FlatLangCartons, RefuseWhatIsNoBox) {
    const CompiledDesign one = compiled_carton("straight_tuck_end(80, 5, 30, 0.5)");
    ASSERT_EQ(one.diagnostics.sorted().size(), 1u);
    EXPECT_EQ(one.diagnostics.sorted().front().message,
              "the width of a carton (in mm) is 5; it lies between 10 and 3000");
}

}  // namespace
}  // namespace popup
