// Guarantees of what follows from an element's row: its parameters are read, checked, patched and written, it
// stands on what the row says, and it makes as many folds as the row names. With rows that exist only here.
#include <gtest/gtest.h>

#include <cmath>

#include "input/flatlang/run/card.h"
#include "input/xml/read.h"
#include "input/xml/schema.h"
#include "mechanism/element.h"
#include "output/xml.h"
#include "popup/check.h"
#include "popup/mechanism.h"
#include "support/designs.h"

namespace popup::test {
namespace {

// --- a flag: a flat piece glued on a plate, A–B under G–H

constexpr std::array<PointInfo, 4> kFlagPoints{{{"A", PointPage::fold, '-'},
                                                {"B", PointPage::fold, '-'},
                                                {"G", PointPage::extra, '-'},
                                                {"H", PointPage::extra, '-'}}};
constexpr std::array<std::string_view, 1> kFlagNames{"banner"};
constexpr std::array<int, 4> kFlagPartners{0, 1, 2, 3};
constexpr std::array<std::string_view, 2> kSides{"front", "back"};
constexpr std::array<ParameterInfo, 6> kFlagParameters{
    {{.name = "color", .about = "colour of the flag"},
     {.name = "outline", .kind = ParameterKind::path, .about = "shape of the flag", .required = true},
     {.name = "glue", .kind = ParameterKind::path, .about = "area that is glued", .page = PointPage::fold},
     {.name = "side", .kind = ParameterKind::choice, .about = "side of the plate", .words = kSides},
     {.name = "height",
      .kind = ParameterKind::length,
      .about = "height",
      .least = 1,
      .most = 50,
      .standard = 5},
     {.name = "marks", .kind = ParameterKind::points, .about = "marks on the flag"}}};

// What constrain() saw last.
struct Seen {
    SitePoint a, b;
    int plate = -1;
    bool may_glue = false;
    double paper = 0.0, outline = 0.0, height = 0.0;
    std::string side;
    std::size_t holes = 0;
};
Seen seen;

const Box kAnywhere{{-1e6, -1e6}, {1e6, 1e6}};

bool flag_constrain(Element& e) {
    seen = {};
    seen.a = e.on[0];
    seen.b = e.on[1];
    seen.plate = e.site.left_plate;
    seen.may_glue =
        e.paper->may_glue(Side::left, e.site.segment(Side::left, e.on[0], e.on[1]), Fit::as_drawn);
    for (const Polygon& part : e.paper->paper(Side::left, 1.0, kAnywhere)) seen.paper += area(part);
    seen.height = number_of(e, "height");
    seen.side = choice_of(e, "side");
    for (const Polygon& part : areas_of(e, "outline")) {
        seen.outline += area(part);
        seen.holes += part.holes.size();
    }
    if (!seen.may_glue) {
        e.failed("does-not-fit", "no paper under A–B", "move it");
        return false;
    }
    // A repair of a number and of a point.
    const auto height = find_parameter(*e.info, "height").value();
    if (number_of(e, "height") > 40.0) {
        e.arguments[height].value = 40.0;
        e.arguments[height].changed = true;
        e.repaired("does-not-fit", "too high", "make it lower");
    }
    if (e.extra[0].x > e.extra[1].x) {
        mirror_piece(e);
        e.repaired("piece-mirrored", "drawn from its back", "draw its front");
    }
    return true;
}

void flag_lower(const Element& e, Builder& builder) {
    const int piece = builder.add_piece(e.paint.id);
    builder.add_cut_plate(e.paint.id, piece, e.extra_page, areas_of(e, "outline").front(),
                          color_of(e, "color"));
}

const ElementRow kFlag = {{.name = "flag",
                           .code = -1,
                           .family = "flag",
                           .inverted = false,
                           .glued = true,
                           .about = "a flat piece glued on a plate",
                           .points = kFlagPoints,
                           .partners = kFlagPartners,
                           .grounds = {.fold = false, .plate = true},
                           .parameters = kFlagParameters,
                           .folds = {},
                           .since = "3.0",
                           .also = kFlagNames},
                          [](const Element&) {
                              return std::pair{0.0, 0.0};
                          },
                          flag_constrain,
                          [](const Element&) { return FoldLines{}; },
                          nullptr,
                          flag_lower};

// --- a fan: five folds from one point of the fold

constexpr std::array<PointInfo, 2> kFanPoints{{{"A", PointPage::fold, '-'}, {"G", PointPage::extra, '-'}}};
constexpr std::array<int, 2> kFanPartners{0, 1};
constexpr std::array<FoldInfo, 5> kFanFolds{{{"first", PointPage::fold, PointPage::extra},
                                             {"second"},
                                             {"third"},
                                             {"fourth"},
                                             {"last", PointPage::extra, PointPage::fold}}};

Segment ray(Vec2 from, int n) { return {from, from + rotated({40.0, 0.0}, (1.0 - 0.25 * n) * 3.0)}; }

FoldLines fan_folds(const Element& e) {
    FoldLines lines;
    for (int n = 0; n < 5; ++n)
        lines.push_back({ray(e.extra[0], n), ray(e.extra[0], n), n % 2 == 0 ? 0 : 360});
    const Vec2 a = e.site.on_page(Side::left, e.on[0]);
    lines.front().on_left = ray(a, 0);
    lines.back().on_right = ray(a, 4);
    return lines;
}

void fan_lower(const Element& e, Builder& builder) {
    const FoldLines lines = fan_folds(e);
    const int piece = builder.add_piece(e.paint.id);
    std::vector<int> plates{e.site.left_plate};
    for (std::size_t n = 0; n + 1 < lines.size(); ++n) {
        const Ring ring{e.extra[0], lines[n].on_right.b, lines[n + 1].on_left.b};
        plates.push_back(builder.add_plate(e.paint.id + "/x", piece, e.extra_page, {ring, {}}, std::nullopt));
    }
    plates.push_back(e.site.right_plate);
    for (std::size_t n = 0; n < lines.size(); ++n) {
        const auto [left, right] = pages_of_fold(e, e.info->folds[n]);
        builder.add_fold({plates[n],
                          plates[n + 1],
                          left,
                          right,
                          lines[n].on_left,
                          lines[n].on_right,
                          lines[n].closed_deg,
                          is_seam(*e.info, e.info->folds[n]),
                          e.paint.id,
                          {}});
    }
}

const ElementRow kFan = {{.name = "fan",
                          .code = -1,
                          .family = "fan",
                          .inverted = false,
                          .glued = true,
                          .about = "five folds",
                          .points = kFanPoints,
                          .partners = kFanPartners,
                          .parameters = {},
                          .folds = kFanFolds,
                          .since = "3.0"},
                         [](const Element& e) {
                             return std::pair{e.on[0].s, e.on[0].s};
                         },
                         [](Element&) { return true; },
                         fan_folds,
                         nullptr,
                         fan_lower};

// The table's rows and these two.
class Rows : public ::testing::Test {
    static std::vector<ElementRow> with_ours() {
        const auto rows = element_rows();
        std::vector<ElementRow> all(rows.begin(), rows.end());
        all.push_back(kFlag);
        all.push_back(kFan);
        return all;
    }
    std::vector<ElementRow> all_ = with_ours();
    RowsForTest in_place_{all_};
};

constexpr std::string_view kStep =
    "<structure type='step' id='s'><outerpoints><point x='-30' y='-20'/><point x='-30' y='20'/>"
    "<point x='30' y='-20'/><point x='30' y='20'/></outerpoints>"
    "<parentfold page='0'><begin x='0' y='-75'/><end x='0' y='75'/></parentfold></structure>";

std::string document(std::string_view structures, std::string_view version = "3.0") {
    return "<popup version='" + std::string(version) +
           "' units='mm'><mainpage width='200' height='150'/><structurelist>" + std::string(structures) +
           "</structurelist></popup>";
}

std::string flag(std::string_view plate, std::string_view more = "", std::string_view attributes = "") {
    return "<structure type='flag' id='f' " + std::string(attributes) +
           "><outerpoints><point x='-60' y='0'/><point x='-50' y='0'/><point x='-5' y='0'/><point x='5' "
           "y='0'/></outerpoints><outline d='M -20 -5 H 20 V 25 H -20 Z M -5 5 h 10 v 10 h -10 z'/>" +
           std::string(more) + std::string(plate) + "</structure>";
}

struct Outcome {
    std::optional<Design> design;
    std::optional<CheckedDesign> checked;
    std::string text;
};

Outcome run(const std::string& xml, const CheckOptions& options = {}) {
    Outcome outcome;
    Diagnostics diagnostics;
    outcome.design = xml::read({"card.xml", xml}, {}, diagnostics);
    if (outcome.design) outcome.checked = check(*outcome.design, options, diagnostics);
    outcome.text = findings(diagnostics);
    return outcome;
}

TEST_F(Rows, AnElementOnAPlateGetsThatPlateALineAndItsOutlineWithHoles) {
    const Outcome on_page =
        run(document(std::string(kStep) + flag("<parentplate page='0' x='-60' y='50'/>")));
    ASSERT_TRUE(on_page.checked) << on_page.text;
    EXPECT_EQ(on_page.text, "");
    EXPECT_EQ(seen.plate, 0);
    EXPECT_NEAR(seen.a.s, 0, 1e-9);
    EXPECT_NEAR(seen.b.s, 10, 1e-9);
    EXPECT_NEAR(seen.a.w, 0, 1e-9);
    EXPECT_TRUE(seen.may_glue);
    EXPECT_NEAR(seen.outline, 40.0 * 30.0 - 100.0, 1e-6);
    EXPECT_EQ(seen.holes, 1U);
    EXPECT_EQ(seen.side, "front");
    EXPECT_EQ(seen.height, 5.0);
    // The left half less the step's half, both less 1 mm along folds and edges.
    EXPECT_NEAR(seen.paper, 98.0 * 148.0 - 31.0 * 42.0 + 1.0 * 42.0, 1.0);
    const Plate& plate = on_page.checked->skeleton().draft.plates.back();
    EXPECT_EQ(plate.name, "f");
    EXPECT_EQ(plate.outline.holes.size(), 1U);
}

TEST_F(Rows, ThePlateIsTheOneUnderThePointCutOutsRegarded) {
    // Under the step there is none of the page's paper.
    const std::string on_step = flag("<parentplate page='0' x='-10' y='0'/>");
    const Outcome refused = run(document(std::string(kStep) + on_step));
    EXPECT_FALSE(refused.checked);
    EXPECT_EQ(seen.plate, 2) << "the step's left plate";
    EXPECT_EQ(refused.text, "error does-not-fit: \"f\": no paper under A–B\n");
    const Outcome nowhere = run(document(flag("<parentplate page='0' x='-103.5' y='0'/>")));
    EXPECT_EQ(
        nowhere.text,
        "error plate-not-found: there is no plate where \"f\" should stand, on page 0 at (-103.5, 0); the "
        "nearest edge of a plate is one of \"page\", 3.50 mm away\n");
    EXPECT_EQ(
        run(document(flag("<parentplate page='3' x='0' y='0'/>"))).text,
        "error page-not-there: \"f\" stands on page 3, but when it is built there are pages 0 to 0 only\n");
}

TEST_F(Rows, ElementsStandOnlyOnWhatTheirRowsSay) {
    const std::string fold = "<parentfold page='0'><begin x='0' y='-75'/><end x='0' y='75'/></parentfold>";
    EXPECT_EQ(run(document(flag(fold))).text,
              "error wrong-ground: \"f\" (flag) stands on a plate, and a fold is given\n");
    std::string step(kStep);
    step.replace(step.find("<parentfold"), std::string::npos,
                 "<parentplate page='0' x='1' y='1'/></structure>");
    EXPECT_EQ(run(document(step)).text,
              "error wrong-ground: \"s\" (step) stands on a fold, and a plate is given\n");
    EXPECT_EQ(run(document(flag(""))).text, "error missing-value: this structure has no parentplate\n");
    EXPECT_EQ(
        run(document(flag(fold + "<parentplate x='1' y='1'/>"))).text,
        "error duplicate-value: a structure stands on a plate or on a fold; its parentfold is on line 1\n");
}

TEST_F(Rows, WhatStandsOnThePlateOfABrokenElementIsLeftInPeaceOrDroppedWithIt) {
    std::string broken(kStep);  // 0.2 mm from its fold
    for (const auto& [from, to] : {std::pair{"x='-30'", "x='-0.2'"}, {"x='30'", "x='0.2'"}}) {
        for (std::size_t at; (at = broken.find(from)) != std::string::npos;)
            broken.replace(at, std::string(from).size(), to);
    }
    const std::string on_it = flag("<parentplate page='0' x='-0.1' y='0'/>");
    const Outcome told = run(document(broken + on_it));
    EXPECT_FALSE(told.checked);
    EXPECT_EQ(told.text.find("\"f\""), std::string::npos) << told.text;
    CheckOptions drop;
    drop.drop = true;
    const Outcome dropped = run(document(broken + on_it), drop);
    ASSERT_TRUE(dropped.checked) << dropped.text;
    EXPECT_TRUE(dropped.checked->design().structures[0].dropped);
    EXPECT_TRUE(dropped.checked->design().structures[1].dropped);
}

TEST_F(Rows, ARepairChangesOnlyTheNumbersItMended) {
    const std::string xml =
        document(flag("<parentplate page='0' x='-60' y='50'/>", "<!-- kept -->", "height='44' side='back'"));
    const Outcome outcome = run(xml);
    ASSERT_TRUE(outcome.checked) << outcome.text;
    std::string wanted = xml;
    wanted.replace(wanted.find("'44'"), 4, "'40'");
    EXPECT_EQ(xml::patch({"card.xml", xml}, outcome.checked->design()), wanted);
    EXPECT_EQ(seen.side, "back");
}

TEST_F(Rows, AMirroredPieceIsMirroredInItsPathData) {
    std::string xml = document(flag("<parentplate page='0' x='-60' y='50'/>"));
    for (const auto& [from, to] :
         {std::pair{"x='-5' y='0'", "x='9' y='0'"}, {"M -20 -5 H 20", "M -19 -5 H 20"}})
        xml.replace(xml.find(from), std::string(from).size(), to);
    const Outcome outcome = run(xml);
    ASSERT_TRUE(outcome.checked) << outcome.text;
    const std::string patched = xml::patch({"card.xml", xml}, outcome.checked->design());
    EXPECT_NE(patched.find("d='M 19 -5 L -20 -5 L -20 25 L 20 25 Z M 5 5 L -5 5 L -5 15 L 5 15 Z'"),
              std::string::npos)
        << patched;
    const Outcome again = run(patched);
    EXPECT_EQ(again.text, "");
    EXPECT_TRUE(again.checked);
}

TEST_F(Rows, ValuesAreReadGenerouslyWrittenCanonicallyAndReadAgain) {
    const Outcome outcome = run(document(flag("<ParentPlate>-60,50</ParentPlate>",
                                              "<Colour>red</Colour><Height>7</Height><glue page='0'>M -60 -1 "
                                              "h 5 v 2 z</glue><marks>1,2 3,4</marks>",
                                              "Side='BACK'")));
    ASSERT_TRUE(outcome.checked) << outcome.text;
    EXPECT_EQ(outcome.text, "");
    const std::string written = write_document(outcome.checked->design());
    EXPECT_NE(written.find("<structure type=\"flag\" id=\"f\" side=\"back\" height=\"7\">"),
              std::string::npos)
        << written;
    EXPECT_NE(written.find("      <color>#ff0000</color>\n"), std::string::npos) << written;
    EXPECT_NE(written.find("      <glue page=\"0\" d=\"M -60 -1 h 5 v 2 z\"/>\n"), std::string::npos);
    EXPECT_NE(written.find("      <parentplate page=\"0\" x=\"-60\" y=\"50\"/>\n"), std::string::npos);
    const Outcome again = run(written);
    ASSERT_TRUE(again.checked) << again.text;
    EXPECT_EQ(write_document(again.checked->design()), written);
    const std::string schema = xml::render_schema();
    EXPECT_NE(schema.find("<xs:attribute name=\"height\" type=\"number\"/>"), std::string::npos);
    EXPECT_NE(schema.find("<xs:element name=\"outline\" type=\"path\" minOccurs=\"0\"/>"), std::string::npos);
}

TEST_F(Rows, ValuesThatAreWrongAreErrorsInTheirPlace) {
    const std::string plate = "<parentplate page='0' x='-60' y='50'/>";
    EXPECT_EQ(run(document(flag(plate, "", "height='51'"))).text,
              "error bad-number: height is 51 mm, and must be from 1 to 50 mm\n");
    EXPECT_EQ(run(document(flag(plate, "", "side='top'"))).text,
              "error bad-choice: side is 'top', which is not one of its words\n");
    EXPECT_EQ(run(document(flag(plate, "<glue d='M 0 0 L 1'/>"))).text,
              "error bad-path: the path data of glue ends where a number is missing\n");
    EXPECT_EQ(run(document(flag(plate, "<glue d='M 0 0 L 1 1'/>"))).text,
              "error bad-path: the path data of glue encloses nothing\n");
    EXPECT_EQ(run(document(flag(plate, "<leftcolor>red</leftcolor>"))).text,
              "warning unknown-markup: the element 'leftcolor' has no meaning in a structure of type flag\n");
    EXPECT_EQ(run(document(flag(plate, "<glue page='1' d='M 0 0 h 9 v 9 z'/>"))).text,
              "error wrong-page: the glue of \"f\" is on page 1, and must be on page 0\n");
    EXPECT_EQ(run(document(flag(plate), "2.0")).text,
              "warning newer-element: 'flag' is not an element of version 2.0\n");
}

TEST_F(Rows, AnElementMakesAsManyFoldsAsItsRowNamesAndOthersStandOnEach) {
    const std::string fan =
        "<structure type='fan'><outerpoints>0,0 0,0</outerpoints><parentfold page='0'><begin x='0' "
        "y='-75'/><end "
        "x='0' y='75'/></parentfold></structure>";
    const Outcome outcome = run(document(fan));
    ASSERT_TRUE(outcome.checked) << outcome.text;
    EXPECT_EQ(outcome.checked->skeleton().folds.size(), 6U);
    const Vec2 points[] = {{0, 0}, {0, 0}};
    const Segment gutter{{0, -75}, {0, 75}};
    const auto made = folds_of(*find_element("fan"), {0, 0, gutter, gutter, false, 0}, 1, points);
    ASSERT_TRUE(made);
    ASSERT_EQ(made->size(), 5U);
    EXPECT_TRUE(made->front().seam);
    EXPECT_EQ(made->front().left_page, 0);
    EXPECT_EQ(made->front().right_page, 1);
    for (const std::size_t n : {1U, 2U, 3U}) {
        const PageFold& fold = (*made)[n];
        EXPECT_FALSE(fold.seam);
        EXPECT_EQ(fold.left_page, 1);
        const Fold& real = outcome.checked->skeleton().folds[n + 1];
        EXPECT_EQ(fold.on_left.b, real.on_left.b);
        EXPECT_EQ(fold.closed_deg, real.closed_deg);
    }
}

// A tent's piece that is 10 mm too narrow is widened: its left half moves 5 mm to the left, and the flag on
// it too.
TEST_F(Rows, WhatStandsOnAPlateThatARepairMovedMovesWithIt) {
    const std::string tent =
        "<structure type='tent' id='t'><outerpoints>-40,-50 -40,50 40,-50 40,50 -35,-50 -35,50 35,-50 35,50"
        "</outerpoints><parentfold page='0'><begin x='0' y='-75'/><end x='0' "
        "y='75'/></parentfold></structure>";
    const std::string on_it =
        "<structure type='flag' id='f'><outerpoints><point x='-30' y='0'/><point x='-20' y='0'/><point "
        "x='-5' "
        "y='0'/><point x='5' y='0'/></outerpoints><outline d='M -9 0 H 9 V 9 Z'/><glue d='M -30 0 h 9 v 9 "
        "z'/>"
        "<parentplate page='1' x='-25' y='3'/></structure>";
    const std::string xml = document(tent + on_it);
    const Outcome outcome = run(xml);
    ASSERT_TRUE(outcome.checked) << outcome.text;
    EXPECT_NE(outcome.text.find(
                  "warning moved-with-fold: \"f\": the plate of \"t\" it stands on was moved by a "
                  "repair; it keeps its place on it [A (-30, 0) B (-20, 0) -> A (-35, 0) B (-25, 0)]"),
              std::string::npos)
        << outcome.text;
    EXPECT_EQ(seen.plate, 2);
    const std::string patched = xml::patch({"card.xml", xml}, outcome.checked->design());
    EXPECT_NE(patched.find("<point x='-35' y='0'/><point x='-25' y='0'/><point x='-5' y='0'/>"),
              std::string::npos)
        << patched;
    EXPECT_NE(patched.find("<parentplate page='1' x='-30' y='3'/>"), std::string::npos) << patched;
    EXPECT_NE(patched.find("<glue d='M -35 0 L -26 0 L -26 9 Z'/>"), std::string::npos) << patched;
    EXPECT_EQ(run(patched).text, "");
}

// In a program an element's values follow its points, and a plate is a page and a point of it.
TEST_F(Rows, ProgramsGiveTheSameValues) {
    flatlang::Card card;
    ASSERT_FALSE(flatlang::begin_card(card, {200, 150, {}, {}, {1, 1}}));
    flatlang::NewElement wanted;
    wanted.info = find_element("banner");
    wanted.plate = flatlang::PlatePlace{0, {-60, 50}};
    wanted.points = {{-60, 0}, {-50, 0}, {-5, 0}, {5, 0}};
    wanted.values = {{{}, 7.0}, {{}, "back"}, {{}, "M -1 -1 H 1 V 1 Z"}};
    std::optional<std::size_t> folds;
    ASSERT_FALSE(flatlang::add_element(card, wanted, folds));
    const Design design = flatlang::finished(card, {"card.fl", ""});
    EXPECT_EQ(design.version, "3.0");
    Diagnostics diagnostics;
    ASSERT_TRUE(check(design, {}, diagnostics)) << findings(diagnostics);
    EXPECT_EQ(seen.height, 7.0);
    EXPECT_EQ(seen.side, "back");
    EXPECT_NEAR(seen.outline, 2 * 25.4 * 25.4, 1e-3);
    EXPECT_EQ(seen.plate, 0);

    wanted.values = {{{}, "back"}};
    EXPECT_EQ(flatlang::add_element(card, wanted, folds)->what, "has no outline");
    wanted.values = {{{}, 100.0}, {{}, "M -1 -1 H 1 V 1 Z"}};
    EXPECT_EQ(flatlang::add_element(card, wanted, folds)->what,
              "has 3.93701 inches as height, which must be from 0.0393701 to 1.9685");
    wanted.values = {{{}, 1.0}, {{}, 2.0}};
    EXPECT_EQ(flatlang::add_element(card, wanted, folds)->what,
              "is given 2, which none of its parameters takes");
}

}  // namespace
}  // namespace popup::test
