// Cards that FlatLang programs write.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "mechanism/builder.h"
#include "popup/mechanism.h"
#include "support/designs.h"
#include "support/random.h"

namespace popup {
namespace {

constexpr double kNear = 2e-4;  // mm: what rounding to float leaves of a number in inches

Reading run(const std::string& program, Diagnostics& diagnostics, const ReadOptions& options = {}) {
    return read_source_text({"card.fl", program}, options, diagnostics);
}

// The card; the test fails where the program has findings.
Design design_of(const std::string& program) {
    Diagnostics diagnostics;
    const Reading reading = run(program, diagnostics);
    EXPECT_EQ(test::findings(diagnostics), "") << program;
    EXPECT_TRUE(reading.design) << program;
    return reading.design.value_or(Design{});
}

void expect_point(const DesignPoint& a, const DesignPoint& b, int fold_page, const std::string& what) {
    EXPECT_NEAR(a.at.x, b.at.x, kNear) << what;
    EXPECT_NEAR(a.at.y, b.at.y, kNear) << what;
    EXPECT_EQ(a.page.value_or(fold_page), b.page.value_or(fold_page)) << what;
}

// All but ids, places and what only texts have.
void expect_same(const Design& a, const Design& b) {
    EXPECT_EQ(a.version, b.version);
    EXPECT_NEAR(a.width_mm, b.width_mm, kNear);
    EXPECT_NEAR(a.height_mm, b.height_mm, kNear);
    EXPECT_EQ(a.left, b.left);
    EXPECT_EQ(a.right, b.right);
    ASSERT_EQ(a.structures.size(), b.structures.size());
    for (std::size_t n = 0; n < a.structures.size(); ++n) {
        const Structure& s = a.structures[n];
        const Structure& t = b.structures[n];
        const std::string what = fmt::format("{} {}", t.type, n + 1);
        EXPECT_EQ(s.type, t.type);
        EXPECT_EQ(color_of(s, "leftcolor"), color_of(t, "leftcolor")) << what;
        EXPECT_EQ(color_of(s, "rightcolor"), color_of(t, "rightcolor")) << what;
        EXPECT_EQ(color_of(s, "lefttabcolor"), color_of(t, "lefttabcolor")) << what;
        EXPECT_EQ(color_of(s, "righttabcolor"), color_of(t, "righttabcolor")) << what;
        EXPECT_EQ(s.fold.page, t.fold.page) << what;
        expect_point(s.fold.begin, t.fold.begin, 0, what);
        expect_point(s.fold.end, t.fold.end, 0, what);
        ASSERT_EQ(s.points.size(), t.points.size()) << what;
        for (std::size_t i = 0; i < s.points.size(); ++i) {
            const bool extra = find_element(t.type)->points[i].page == PointPage::extra;
            expect_point(s.points[i], t.points[i], extra ? 0 : t.fold.page,
                         fmt::format("{}, point {}", what, i));
        }
    }
    ASSERT_EQ(a.lines.size(), b.lines.size());
    for (std::size_t n = 0; n < a.lines.size(); ++n) {
        EXPECT_EQ(a.lines[n].page, b.lines[n].page);
        EXPECT_EQ(a.lines[n].color, b.lines[n].color);
        EXPECT_NEAR(a.lines[n].thickness_pt, b.lines[n].thickness_pt, 1e-5);
        ASSERT_EQ(a.lines[n].points.size(), b.lines[n].points.size());
        for (std::size_t i = 0; i < a.lines[n].points.size(); ++i)
            expect_point(a.lines[n].points[i], b.lines[n].points[i], 0, fmt::format("line {}", n));
    }
}

std::string point_text(Vec2 inches) { return fmt::format("[{:.9f}, {:.9f}]", inches.x, inches.y); }

// The name of the row's builtin with each hyphen as `joint`.
std::string builtin_name(const ElementInfo& info, std::string_view joint) {
    std::string name;
    for (const char c : info.name) name += c == '-' ? std::string(joint) : std::string(1, c);
    return name;
}

// The rows that ask for nothing but points of a fold; what others ask for is tested with the rows.
std::vector<ElementInfo> elements_of_points() {
    std::vector<ElementInfo> rows;
    for (const ElementInfo& info : element_table()) {
        const bool more = std::any_of(info.parameters.begin(), info.parameters.end(),
                                      [](const ParameterInfo& one) { return one.required; });
        if (info.grounds.fold && !more) rows.push_back(info);
    }
    return rows;
}

// Any points, no two alike, left ones on the left: reading asks no more of them.
std::vector<Vec2> some_points(const ElementInfo& info) {
    std::vector<Vec2> points;
    for (std::size_t i = 0; i < info.points.size(); ++i) {
        const double side = info.points[i].side == 'L' ? -1.0 : info.points[i].side == 'R' ? 1.0 : 0.0;
        const auto n = static_cast<double>(i);
        points.push_back({side * (1.0 + 0.25 * n), 0.125 * n * n - 1.0});
    }
    return points;
}

// Every element has a builtin because it has a row, and it says what the XML document of these points says.
TEST(FlatLangCard, EveryRowOfTheElementTableIsABuiltin) {
    for (const ElementInfo& info : elements_of_points()) {
        const std::vector<Vec2> points = some_points(info);
        std::string arguments;
        std::string xml = fmt::format(
            "<popup version=\"{}\"><mainpage width=\"9\" height=\"7\"><leftcolor>#ffffff</leftcolor>"
            "<rightcolor>#abcdef</rightcolor></mainpage><structurelist><structure type=\"{}\">"
            "<leftcolor>#ff0000</leftcolor><rightcolor>#00ff00</rightcolor><lefttabcolor>#0000ff</"
            "lefttabcolor>"
            "<righttabcolor>#010203</righttabcolor><parentfold page=\"0\"><begin x=\"0\" y=\"-3.5\"/>"
            "<end x=\"0\" y=\"3.5\"/></parentfold><outerpoints>",
            info.code < 0 ? "3.0" : "2.0", info.name);
        for (const Vec2 p : points) {
            arguments += point_text(p) + ", ";
            xml += fmt::format("<point x=\"{}\" y=\"{}\"/>", p.x, p.y);
        }
        xml += "</outerpoints></structure></structurelist></popup>";
        Diagnostics diagnostics;
        const auto wanted = read_design({"card.xml", xml}, {}, diagnostics);
        ASSERT_TRUE(wanted) << test::findings(diagnostics);
        for (const std::string_view joint : {"_", ""}) {
            SCOPED_TRACE(builtin_name(info, joint));
            expect_same(design_of(fmt::format("card = popup(9, 7, \"white\", \"#abcdef\")\n"
                                              "{}(card.gutter, {}\"red\", \"#0f0\", \"blue\", \"1,2,3\")",
                                              builtin_name(info, joint), arguments)),
                        *wanted);
        }
    }
    EXPECT_EQ(design_of("vfold(popup(), [-1, 1], [0, 0], [-2, 2], [0, 1], [-1, 4])").structures[0].type,
              "v-fold");
    EXPECT_EQ(
        design_of("inverted_vfold(popup(), [-1, 1], [0, 0], [-2, 2], [0, 1], [-1, 4])").structures[0].type,
        "inverted-v-fold");
}

TEST(FlatLangCard, OfAnEvenElementTheLeftSideIsEnough) {
    for (const ElementInfo& info : elements_of_points()) {
        SCOPED_TRACE(info.name);
        std::vector<Vec2> all = some_points(info);
        std::string half;
        std::string whole;
        for (std::size_t i = 0; i < all.size(); ++i) {
            const Vec2 partner = all[static_cast<std::size_t>(info.partners[i])];
            if (info.points[i].side == 'R') all[i] = {-partner.x, partner.y};
        }
        for (std::size_t i = 0; i < all.size(); ++i) {
            whole += ", " + point_text(all[i]);
            if (info.points[i].side != 'R') half += ", " + point_text(all[i]);
        }
        const std::string call = "c = popup()\n" + builtin_name(info, "_") + "(c.gutter";
        expect_same(design_of(call + half + ")"), design_of(call + whole + ")"));
    }
}

TEST(FlatLangCard, ColoursAreOfBothHalvesOrEachAndOfTheirTabs) {
    const auto colors = [](std::string_view arguments) {
        const std::string beak = "c = popup() e = beak(c, [0, 1], [-1, 0]";
        const Design made = design_of(fmt::format("{}, {})", beak, arguments));
        expect_same(design_of(fmt::format("{}, \"gold\") painted(e, {})", beak, arguments)), made);
        std::string text;
        const Structure& s = made.structures.at(0);
        for (const auto& color : {color_of(s, "leftcolor"), color_of(s, "rightcolor"),
                                  color_of(s, "lefttabcolor"), color_of(s, "righttabcolor")})
            text += (color ? to_string(*color) : "none") + " ";
        return text;
    };
    EXPECT_EQ(colors("\"#111\""), "#111111 #111111 none none ");
    EXPECT_EQ(colors("\"#111\", \"#222\""), "#111111 #222222 none none ");
    EXPECT_EQ(colors("\"#111\", \"#222\", \"#333\""), "#111111 #222222 #333333 #333333 ");
    EXPECT_EQ(colors("\"#111\", \"#222\", \"#333\", \"#444\""), "#111111 #222222 #333333 #444444 ");
}

TEST(FlatLangCard, PointsAreVectorsListsOfTwoNumbersOrListsOfPoints) {
    const Design wanted = design_of("beak(popup(), [0, 1.5], [-1.25, 0.5], [1.25, 0.5])");
    expect_same(design_of("up() forward(1.5) c = popup() beak(c, pos(), [-1.25, 0.5])"), wanted);
    expect_same(design_of("beak(popup(), [[0, 1.5], [-1.25, 0.5], [1.25, 0.5]])"), wanted);
    expect_same(design_of("beak(popup(), [[0, 1.5]], [-1.25, 0.5])"), wanted);
}

// The program that writes this design. Its points are told from their folds, which are found among those that
// check() makes of it.
std::string program_of(const Design& design) {
    const auto unit = [](const DesignPoint& p) { return (1 / 25.4) * p.at; };
    std::string text =
        fmt::format("card = popup({:.9f}, {:.9f})\n", design.width_mm / 25.4, design.height_mm / 25.4);
    struct Known {
        std::string name;
        PageFold fold;
    };
    const double h = 0.5 * design.height_mm;
    std::vector<Known> known{{"card.gutter", {0, 0, {{0, -h}, {0, h}}, {{0, -h}, {0, h}}, false, 0}}};
    int glued = 0;
    for (std::size_t n = 0; n < design.structures.size(); ++n) {
        const Structure& s = design.structures[n];
        const ElementInfo& info = *find_element(s.type);
        const auto fold = std::find_if(known.begin(), known.end(), [&](const Known& k) {
            return k.fold.left_page == s.fold.page && distance(k.fold.on_left.a, s.fold.begin.at) < 1e-3 &&
                   distance(k.fold.on_left.b, s.fold.end.at) < 1e-3;
        });
        if (fold == known.end()) {
            ADD_FAILURE() << "nothing made the fold of structure " << n + 1;
            return text;
        }
        text += fmt::format("e{} = {}({}", n + 1, builtin_name(info, "_"), fold->name);
        std::vector<Vec2> on_pages;
        for (std::size_t i = 0; i < s.points.size(); ++i) {
            Vec2 at = unit(s.points[i]);
            on_pages.push_back(s.points[i].at);
            if (info.points[i].page == PointPage::fold) {
                const Segment& line = info.points[i].side == 'R' ? fold->fold.on_right : fold->fold.on_left;
                const Vec2 along = (1 / distance(line.a, line.b)) * (line.b - line.a);
                const Vec2 from = (1 / 25.4) * (s.points[i].at - lerp(line.a, line.b, 0.5));
                at = {dot(from, right_of(along)), dot(from, along)};
            }
            text += ", " + point_text(at);
        }
        text += ")\n";
        if (info.glued) ++glued;
        const auto made = folds_of(info, fold->fold, glued, on_pages);
        if (!made) {
            ADD_FAILURE() << "structure " << n + 1 << " makes no folds";
            return text;
        }
        const char* const names[] = {"left", "centre", "right"};
        for (std::size_t i = 0; i < 3; ++i)
            known.push_back({fmt::format("e{}.{}", n + 1, names[i]), (*made)[i]});
    }
    return text;
}

// Elements of all kinds, on gutters, folds and seams, valleys and mountains: what check() finds where the
// design says a fold is, the program finds by the element's name.
TEST(FlatLangCard, AnyDesignCanBeWrittenAsAProgram) {
    std::size_t nested = 0;
    std::size_t on_two_pages = 0;
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        SCOPED_TRACE(seed);
        const Design design = test::generate(seed, 14);
        for (const Structure& s : design.structures) {
            nested += s.fold.page != 0 || std::abs(s.fold.begin.at.x) > 1e-6 ? 1U : 0U;
            for (const DesignPoint& p : s.points) on_two_pages += p.page ? 1U : 0U;
        }
        const std::string program = program_of(design);
        const Design made = design_of(program);
        expect_same(made, design);
        if (testing::Test::HasFailure()) {
            FAIL() << program;
        }
        // No repair is needed after the rounding of numbers, either.
        Diagnostics diagnostics;
        EXPECT_TRUE(check(made, {}, diagnostics));
        EXPECT_EQ(test::findings(diagnostics), "");
    }
    EXPECT_GT(nested, 100U);
    EXPECT_GT(on_two_pages, 10U);
}

// folds_of() and check() say the same of every fold: where it is, its pages, and how it closes.
TEST(FlatLangCard, FoldsAreWhereCheckMakesThem) {
    for (std::uint64_t seed = 41; seed <= 60; ++seed) {
        SCOPED_TRACE(seed);
        const Design design = test::generate(seed, 12);
        Diagnostics diagnostics;
        const auto checked = check(design, {}, diagnostics);
        ASSERT_TRUE(checked);
        const auto& folds = checked->skeleton().folds;
        ASSERT_EQ(folds.size(), 1 + 3 * design.structures.size());
        const auto as_page_fold = [](const Fold& f) {
            return PageFold{f.left_page, f.right_page, f.on_left, f.on_right, f.seam, f.closed_deg};
        };
        int glued = 0;
        for (std::size_t n = 0; n < design.structures.size(); ++n) {
            const Structure& s = design.structures[n];
            const ElementInfo& info = *find_element(s.type);
            if (info.glued) ++glued;
            const auto parent = std::find_if(folds.begin(), folds.end(), [&](const Fold& f) {
                return f.left_page == s.fold.page && distance(f.on_left.a, s.fold.begin.at) < 1e-6 &&
                       distance(f.on_left.b, s.fold.end.at) < 1e-6;
            });
            ASSERT_NE(parent, folds.end());
            std::vector<Vec2> points;
            for (const DesignPoint& p : s.points) points.push_back(p.at);
            const auto made = folds_of(info, as_page_fold(*parent), glued, points);
            ASSERT_TRUE(made);
            for (std::size_t i = 0; i < 3; ++i) {
                const PageFold wanted = as_page_fold(folds[1 + 3 * n + i]);
                const PageFold& got = (*made)[i];
                EXPECT_EQ(got.left_page, wanted.left_page);
                EXPECT_EQ(got.right_page, wanted.right_page);
                EXPECT_EQ(got.seam, wanted.seam);
                EXPECT_EQ(got.closed_deg, wanted.closed_deg);
                for (const auto& [a, b] :
                     {std::pair{got.on_left, wanted.on_left}, {got.on_right, wanted.on_right}}) {
                    EXPECT_LT(distance(a.a, b.a), 1e-3);
                    EXPECT_LT(distance(a.b, b.b), 1e-3);
                }
            }
        }
    }
}

// Values go to the first parameter that takes them, or to the one that is named.
TEST(FlatLangCard, ElementsHaveAllTheirValues) {
    const Design made = design_of(
        "c = popup(8, 6)\n"
        "box(c, [-0.7, 0.2], [-0.7, 2.2], 1.1, \"out\", \"endcolor\", \"tan\", \"red\")\n"
        "floating_layer(c, [-1, -2.5], [-1, -0.9], \"topcolor\", \"#010203\", 0.9)\n"
        "disc(c, [2, 0], [2, 0], [2, 0], \"window\", \"M 1 1 H 2 V 2 Z\", \"rivet\", 0.1, 2, \"blue\")\n"
        "wheel(c, [2, 0], [2, 0], [2, 0], \"M 0 0 H 1 V 1 Z\")\n");
    ASSERT_EQ(made.structures.size(), 4U);
    const auto value = [&](std::size_t n, std::string_view name) -> const Argument& {
        static const Argument kNone;
        const ElementInfo& info = *find_element(made.structures[n].type);
        const Argument* found = find_argument(info, made.structures[n].arguments, name);
        return found ? *found : kNone;
    };
    EXPECT_NEAR(std::get<double>(value(0, "height").value), 1.1 * 25.4, 1e-5);
    EXPECT_EQ(std::get<std::string>(value(0, "ends").value), "out");
    EXPECT_EQ(std::get<Color>(value(0, "endcolor").value), (Color{210, 180, 140}));
    EXPECT_EQ(std::get<Color>(value(0, "leftcolor").value), (Color{255, 0, 0}));
    EXPECT_EQ(std::get<Color>(value(1, "topcolor").value), (Color{1, 2, 3}));
    EXPECT_NEAR(std::get<double>(value(1, "height").value), 0.9 * 25.4, 1e-5);
    EXPECT_NEAR(area(std::get<DrawnPath>(value(2, "window").value).inside.areas[0]), 0.5 * 25.4 * 25.4, 1e-3);
    EXPECT_FALSE(value(2, "outline").given());
    EXPECT_NEAR(std::get<double>(value(2, "rivet").value), 2.54, 1e-5);
    EXPECT_NEAR(std::get<double>(value(2, "radius").value), 50.8, 1e-5);
    EXPECT_EQ(std::get<Color>(value(2, "color").value), (Color{0, 0, 255}));
    EXPECT_EQ(made.structures[3].type, "disc");
    EXPECT_TRUE(value(3, "outline").given());
}

// What is drawn across a fold is drawn beside it: the same numbers make the same shape there.
TEST(FlatLangCard, OutlinesAreSeenFromTheirFold) {
    const Design made = design_of(
        "c = popup(8, 6)\n"
        "b = box_fold(c, [-1, -1], [2, 1])\n"
        "polygon(c, \"M 0.5 -2.5 H -0.5 V -1.5 H 0.5 Z\", \"top\", 0.4)\n"
        "polygon(b.right, \"M 0.5 -0.5 H -0.5 V 0.5 H 0.5 Z\")\n"
        "freeform(b.left, [-0.25, -0.5], [0.25, -0.5], [0.25, 0.5], [-0.25, 0.5])\n"
        "hole(b, \"M -3 -2 h 0.5 v 0.5 Z\")\n");
    ASSERT_EQ(made.structures.size(), 5U);
    const auto box_of = [&](std::size_t n) {
        Box box;
        for (const Argument& argument : made.structures[n].arguments) {
            if (const auto* path = std::get_if<DrawnPath>(&argument.value))
                box = bounds(path->inside.areas.at(0).outer);
            if (const auto* points = std::get_if<std::vector<DesignPoint>>(&argument.value)) {
                for (const DesignPoint& point : *points) box.extend(point.at);
            }
        }
        return box;
    };
    const auto expect_box = [&](std::size_t n, Vec2 min, Vec2 max) {
        EXPECT_LT(distance(box_of(n).min, 25.4 * min), 1e-4) << n;
        EXPECT_LT(distance(box_of(n).max, 25.4 * max), 1e-4) << n;
    };
    expect_box(1, {-0.5, -2.5}, {0.5, -1.5});
    expect_box(2, {1.5, -0.5}, {2.5, 0.5});
    expect_box(3, {-1.25, -0.5}, {-0.75, 0.5});
    expect_box(4, {-3, -2}, {-2.5, -1.5});
    EXPECT_TRUE(made.structures[4].finds_ground);
    Diagnostics diagnostics;
    EXPECT_TRUE(check(made, {}, diagnostics));
    EXPECT_EQ(test::findings(diagnostics), "");
}

TEST(FlatLangCard, ObjectsTellWhatTheyAre) {
    Diagnostics diagnostics;
    const Reading reading =
        run("c = popup(11, 8.5)\nprint(c, c.width, c.height, c.page, c.gutter.begin, c.gutter.length)\n"
            "s = step(c, [-2, -1], [-2, 1])\nprint(s, s.page, s.left, s.left.begin, s.centre.end)\n"
            "t = tent(s.left, [-0.5, -0.5], [-0.5, 0.5], [-1, -1], [-1, 1])\n"
            "print(t, t.page, t.left.page, t.centre.page)",
            diagnostics);
    EXPECT_EQ(test::findings(diagnostics), "");
    EXPECT_EQ(reading.printed,
              "card 11.0 8.5 0.0 {0.0, -4.25, 0.0} 8.5\n"
              "step 1 0.0 left fold of step 1 {-2.0, -1.0, 0.0} {0.0, 1.0, 0.0}\n"
              "tent 2 1.0 0.0 1.0\n");
}

TEST(FlatLangCard, ElementsHaveTheNamesThatTheyAreGivenOrTheirNumber) {
    const Design design = design_of(
        "c = popup()\nrepeat (2) beak(c, [0, 1], [-1, 0]) done\nnamed(beak(c, [0, 3], [-1, 2]), \"e2\")\n"
        "n = 1\nrepeat (2) named(named(beak(c, [0, -3], [-1, -4]), \"old\"), \"mouth\", n) n = n + 1 done");
    std::vector<std::string> ids;
    for (const Structure& s : design.structures) ids.push_back(s.id);
    EXPECT_EQ(ids, (std::vector<std::string>{"e1", "e6", "e2", "mouth-1", "mouth-2"}));
    EXPECT_EQ(design.file, "card.fl");
    EXPECT_EQ(design.stem, "card");
}

TEST(FlatLangCard, LinesAreDrawnOnPagesPiecesAndBesideFolds) {
    const Design design = design_of(
        "c = popup()\nt = tent(c, [-1, -1], [-1, 1], [-2, -1], [-2, 1])\n"
        "drawline(c, [1, 2], [3, 4])\ndrawline(t, [[0, 0], [1, 1]], 2.5, \"red\")\ndrawline(1, [5, 5], [6, "
        "6], \"#00f\", 3)\n"
        "drawline(t.centre, [0, 0], [0, 0.5])\ndrawline(t.left, [-0.25, 0], [-0.5, 0])\n"
        "drawline(t.left, [0.25, 0], [0.5, 0])\ndrawline(t.right, [0, 0.5], [1, 0.5])");
    ASSERT_EQ(design.lines.size(), 7U);
    const auto expect_line = [&](std::size_t n, int page, Vec2 from, Vec2 to) {
        EXPECT_EQ(design.lines[n].page, page) << n;
        EXPECT_LT(distance(design.lines[n].points.front().at, 25.4 * from), kNear) << n;
        EXPECT_LT(distance(design.lines[n].points.back().at, 25.4 * to), kNear) << n;
    };
    expect_line(0, 0, {1, 2}, {3, 4});
    EXPECT_EQ(design.lines[0].thickness_pt, 1.0);
    EXPECT_EQ(design.lines[0].color, (Color{0, 0, 0}));
    expect_line(1, 1, {0, 0}, {1, 1});
    EXPECT_EQ(design.lines[1].thickness_pt, 2.5);
    EXPECT_EQ(design.lines[1].color, (Color{255, 0, 0}));
    expect_line(2, 1, {5, 5}, {6, 6});
    EXPECT_EQ(design.lines[2].thickness_pt, 3.0);
    EXPECT_EQ(design.lines[2].color, (Color{0, 0, 255}));
    expect_line(3, 1, {0, 0}, {0, 0.5});
    // The left seam: the base on its left, the piece on its right.
    expect_line(4, 0, {-1.25, 0}, {-1.5, 0});
    expect_line(5, 1, {-1.75, 0}, {-1.5, 0});
    expect_line(6, 0, {1, 0.5}, {2, 0.5});
}

// Elements of any points, many of them alike or far out, on any folds: each program is a design or has an
// error, and check() has an answer to every design.
TEST(FlatLangCard, AnyPointsAndFoldsComeToAnAnswer) {
    constexpr std::string_view kNumbers[] = {"0",  "0",    "1",      "-1",    "0.5",
                                             "-2", "4.25", "0.0001", "30000", "-infinity"};
    constexpr std::string_view kFolds[] = {"left", "centre", "right"};
    int designs = 0;
    int sound = 0;
    const std::vector<ElementInfo> table = elements_of_points();
    for (std::uint64_t seed = 1; seed <= 400; ++seed) {
        test::Random random(seed);
        const std::size_t numbers = seed % 2 == 0 ? std::size(kNumbers) : 6;
        const auto point = [&] {
            return fmt::format(", [{}, {}]", kNumbers[random.below(numbers)],
                               kNumbers[random.below(numbers)]);
        };
        std::string program = "e0 = popup()\ne0.left = e0 e0.centre = e0.gutter e0.right = e0\n";
        for (std::size_t n = 1; n <= 6; ++n) {
            const ElementInfo& info = table[random.below(table.size())];
            program += fmt::format("e{} = {}(e{}.{}", n, builtin_name(info, "_"), random.below(n),
                                   kFolds[random.below(std::size(kFolds))]);
            for (const PointInfo& at : info.points) {
                if (at.side != 'R') program += point();
            }
            program += fmt::format(")\ndrawline(e{}.centre{}{})\n", random.below(n + 1), point(), point());
        }
        Diagnostics diagnostics;
        const Reading reading = run(program, diagnostics);
        EXPECT_NE(reading.design.has_value(), diagnostics.has_errors()) << program;
        if (!reading.design) continue;
        ++designs;
        EXPECT_EQ(reading.design->structures.size(), 6U);
        Diagnostics found;
        const auto checked = check(*reading.design, {}, found);
        EXPECT_NE(checked.has_value(), found.has_errors()) << program;
        sound += checked ? 1 : 0;
    }
    EXPECT_GT(designs, 20);
    EXPECT_LT(sound, designs);
}

TEST(FlatLangCard, FindingsPointIntoTheProgram) {
    const Design design = design_of("c = popup()\n\n  beak(c, [0.5, 1], [-1, 0], [1, 0])");
    Diagnostics diagnostics;
    check(design, {}, diagnostics);
    const auto all = diagnostics.sorted();
    ASSERT_EQ(all.size(), 1U);
    EXPECT_EQ(all[0].code, "apex-off-fold");
    EXPECT_EQ(all[0].place, (Place{3, 3}));
    EXPECT_EQ(all[0].element, "e1");
}

// The original had no cards: its programs may call what they define themselves.
TEST(FlatLangCard, TheEditionOf2008HasNone) {
    ReadOptions options;
    options.program.as_2008 = true;
    Diagnostics diagnostics;
    const Reading reading =
        run("print(popup(11, 8.5))\nprint(step(7))\nprint(named(1, 2))\nprint(drawline(3))", diagnostics,
            options);
    EXPECT_FALSE(reading.design);
    EXPECT_EQ(reading.printed, "nil\nnil\nnil\nnil\n");
}

// Whatever their sizes, they fold: check() has nothing to mend.
TEST(FlatLangCard, ElementsOfTheKitNeedNoRepair) {
    const Design design = design_of(
        "c = popup(10, 30) load(\"kit/card.fl\")\n"
        "b = card_box(c, -12, 3, 2.5, 1.5) card_inverted_box(b.centre, 0.2, 1, 0.4, 0.3)\n"
        "m = card_mouth(c, -9, 50, 1.7) card_inverted_mouth(m.centre, 0, 40, 0.3) card_mouth(c, -4, 120, "
        "1.2)\n"
        "p = card_peak(c, -2, 30, 1.5, 7, 2, 0) card_peak(p.left, 0, 60, 0.5, 15, 0.6, 0.1)\n"
        "card_inverted_peak(c, 2, 60, 1.2, 20, 1.5, 1)\n"
        "t = card_roof(c, 7, 3, 2, 2.5) card_inverted_box(t.centre, 0, 1, 0.3, 0.3) card_roof(t.right, 0.5, "
        "1, 0.4, 0.7)\n"
        "at = 10 angle = 20\n"
        "while (angle < 85) card_mouth(c, at, angle, 0.4) at = at + 0.7 angle = angle + 13 done");
    Diagnostics diagnostics;
    EXPECT_TRUE(check(design, {}, diagnostics));
    EXPECT_EQ(test::findings(diagnostics), "");
}

}  // namespace
}  // namespace popup
