// DXF drawings as a whole: blocks, layers, units, what they show, and what is wrong with them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "popup/language.h"
#include "support/dxf_text.h"

namespace popup {
namespace {

using drawing::Dash;
using drawing::Named;
using test::dxf_file;

using Traced = test::TracedDxf;

Traced traced(const std::string& text, const ReadOptions& options = {}) {
    return test::traced_dxf(text, options);
}

Reading read(const std::string& text, Diagnostics& diagnostics, const ReadOptions& options = {}) {
    return read_source_text(Source{"box.dxf", text}, options, diagnostics);
}

void expect_at(Vec2 p, double x, double y) {
    EXPECT_NEAR(p.x, x, 2e-6);
    EXPECT_NEAR(p.y, y, 2e-6);
}

// --- blocks

constexpr std::string_view kFlag =
    "0 BLOCK|8 0|2 FLAG|70 0|10 1|20 0|0 LINE|8 0|62 0|10 1|20 0|11 3|21 0|0 LINE|8 FLAGPOLE|10 1|20 0|11 "
    "1|21 "
    "1|0 ENDBLK";

TEST(DxfBlocks, ArePutScaledTurnedAndMirrored) {
    const Traced one = traced(dxf_file("0 INSERT|8 CUT|62 5|2 flag|10 100|20 50|41 2|42 3|50 90", {}, kFlag));
    ASSERT_TRUE(one.tracing) << one.told;
    // From the base at (1, 0): two to the right become four upwards, one up three to the left.
    expect_at(one.line(0).points[0], 100, 50);
    expect_at(one.line(0).points[1], 100, 54);
    expect_at(one.line(1).points[1], 97, 50);
    // Colour and layer by block: those of the insert; the other has a layer of its own.
    EXPECT_EQ(one.line(0).color, (Color{0, 0, 255}));
    EXPECT_EQ(one.line(0).named, Named::cut);
    EXPECT_EQ(one.line(1).named, Named::nothing);
    const Traced mirrored =
        traced(dxf_file("0 INSERT|8 CUT|2 FLAG|10 100|20 50|41 2|42 3|210 0|220 0|230 -1", {}, kFlag));
    ASSERT_TRUE(mirrored.tracing) << mirrored.told;
    expect_at(mirrored.line(0).points[0], -100, 50);
    expect_at(mirrored.line(0).points[1], -104, 50);
}

TEST(DxfBlocks, StandInRowsAndColumns) {
    const Traced one =
        traced(dxf_file("0 INSERT|8 0|2 FLAG|10 0|20 0|70 3|71 2|44 10|45 20|50 90", {}, kFlag));
    ASSERT_TRUE(one.tracing) << one.told;
    ASSERT_EQ(one.tracing->lines.size(), 12U);
    // The grid turns with them.
    expect_at(one.line(2).points[0], 0, 10);
    expect_at(one.line(6).points[0], -20, 0);
    expect_at(one.line(10).points[0], -20, 20);
}

TEST(DxfBlocks, NestInOneAnother) {
    const Traced one = traced(dxf_file(
        "0 INSERT|8 0|2 TWO|10 10|20 0|41 2|42 2", {},
        std::string(kFlag) + "|0 BLOCK|2 TWO|10 0|20 0|0 INSERT|8 0|2 FLAG|10 5|20 5|50 90|0 ENDBLK"));
    ASSERT_TRUE(one.tracing) << one.told;
    expect_at(one.line(0).points[0], 20, 10);
    expect_at(one.line(0).points[1], 20, 14);
}

TEST(DxfBlocks, CyclesAndBombsAreRefused) {
    const Traced cycle = traced(dxf_file("0 INSERT|8 0|2 A|10 0|20 0", {},
                                         "0 BLOCK|2 A|10 0|20 0|0 INSERT|8 0|2 B|10 0|20 0|0 ENDBLK|0 "
                                         "BLOCK|2 B|10 0|20 0|0 INSERT|8 0|2 A|10 0|20 0|0 "
                                         "ENDBLK"));
    EXPECT_FALSE(cycle.tracing);
    EXPECT_NE(cycle.told.find("error bad-reference: the block \"A\" is put inside itself"), std::string::npos)
        << cycle.told;
    std::string blocks = "0 BLOCK|2 B0|10 0|20 0|0 LINE|8 0|10 0|20 0|11 1|21 1|0 ENDBLK";
    for (int i = 1; i < 12; ++i) {
        blocks += fmt::format("|0 BLOCK|2 B{}|10 0|20 0|0 INSERT|8 0|2 B{}|10 0|20 0|70 10|44 1|0 ENDBLK", i,
                              i - 1);
    }
    const Traced bomb = traced(dxf_file("0 INSERT|8 0|2 B11|10 0|20 0", {}, blocks));
    EXPECT_FALSE(bomb.tracing);
    EXPECT_NE(bomb.told.find("error document-too-large"), std::string::npos) << bomb.told;
    // Nothing, very often.
    const Traced empty = traced(
        dxf_file("0 INSERT|8 0|2 A|10 0|20 0|70 30000|71 30000", {}, "0 BLOCK|2 A|10 0|20 0|0 ENDBLK"));
    EXPECT_FALSE(empty.tracing);
    EXPECT_NE(empty.told.find("error document-too-large"), std::string::npos) << empty.told;
}

TEST(DxfBlocks, ThoseThatAreNotThereAreTold) {
    const Traced one = traced(dxf_file("0 INSERT|8 0|2 GONE|10 0|20 0|0 INSERT|8 0|2 OUT|10 0|20 0", {},
                                       "0 BLOCK|2 OUT|70 4|10 0|20 0|1 other.dxf|0 ENDBLK"));
    EXPECT_FALSE(one.tracing);
    EXPECT_EQ(one.told,
              "error bad-reference: the block \"GONE\" is not there\n"
              "error bad-reference: the block \"OUT\" is in another file, which is not read\n");
    EXPECT_EQ(one.findings[0].place.line, 36);
}

// --- layers

constexpr std::string_view kTables =
    "0 TABLE|2 LTYPE|0 LTYPE|2 KNIFE|73 0|0 LTYPE|2 RILL|73 2|49 3|49 -1.5|0 LTYPE|2 CHAIN|73 4|49 3|49 "
    "-1|49 0|49 "
    "-1|0 ENDTAB|0 TABLE|2 LAYER|0 LAYER|2 CUT|70 0|62 1|6 KNIFE|0 LAYER|2 CREASE|70 0|62 3|420 1193046|6 "
    "RILL|0 "
    "LAYER|2 Off|70 0|62 -7|0 LAYER|2 Cold|70 1|62 7|0 LAYER|2 Quiet|70 0|62 7|290 0|0 ENDTAB";

std::string on(std::string_view layer, std::string_view more = {}) {
    return "0 LINE|8 " + std::string(layer) + (more.empty() ? "" : "|") + std::string(more) +
           "|10 0|20 0|11 5|21 5";
}

TEST(DxfLayers, GiveColoursDashesAndMeanings) {
    const Traced one =
        traced(dxf_file(on("CUT") + "|" + on("crease") + "|" + on("CUT", "62 4|6 CHAIN") + "|" +
                            on("CREASE", "420 255|6 DASHDOT2") + "|" + on("0", "6 HIDDEN"),
                        kTables));
    ASSERT_TRUE(one.tracing) << one.told;
    EXPECT_EQ(one.line(0).color, (Color{255, 0, 0}));
    EXPECT_EQ(one.line(0).dash, Dash::none);
    EXPECT_EQ(one.line(0).named, Named::cut);
    EXPECT_EQ(one.line(1).color, (Color{0x12, 0x34, 0x56}));
    EXPECT_EQ(one.line(1).dash, Dash::even);
    EXPECT_EQ(one.line(1).named, Named::fold);
    EXPECT_EQ(one.line(2).color, (Color{0, 255, 255}));
    EXPECT_EQ(one.line(2).dash, Dash::mixed);
    EXPECT_EQ(one.line(3).color, (Color{0, 0, 255}));
    EXPECT_EQ(one.line(3).dash, Dash::mixed);
    EXPECT_EQ(one.line(4).dash, Dash::even);
    EXPECT_EQ(one.line(4).color, (Color{0, 0, 0}));
}

TEST(DxfLayers, ThatAreNotSeenAreToldOf) {
    const Traced one =
        traced(dxf_file(on("Off") + "|" + on("Cold") + "|" + on("Quiet") + "|" + on("DEFPOINTS") + "|" +
                            on("CUT", "60 1") + "|" + on("CUT", "67 1") + "|" + on("CUT"),
                        std::string(kTables) + "|0 TABLE|2 LAYER|0 LAYER|2 Defpoints|62 7|0 ENDTAB"));
    ASSERT_TRUE(one.tracing) << one.told;
    EXPECT_EQ(one.tracing->lines.size(), 1U);
    EXPECT_EQ(one.told, "remark hidden-shape: 6 hidden elements are not cut\n");
}

TEST(DxfLayers, HaveTheNamesOfDielines) {
    const auto named = [](std::string_view layer) { return traced(dxf_file(on(layer))).line().named; };
    for (const std::string_view name :
         {"CUT", "Cuts", "DIECUT", "through cut", "IV_OUTER_PROFILE", "TRIM", "Slits"})
        EXPECT_EQ(named(name), Named::cut) << name;
    for (const std::string_view name : {"CREASE", "SCORE", "FOLD", "HALFCUT", "HALF-CUT", "Half Cut", "PERF",
                                        "CREASING", "BEND", "IV_BEND", "SCORE_LINES", "Bend Lines"})
        EXPECT_EQ(named(name), Named::fold) << name;
    for (const std::string_view name : {"MOUNTAIN", "FOLD_MOUNTAIN", "BEND_DOWN", "IV_BEND_DOWN"})
        EXPECT_EQ(named(name), Named::mountain) << name;
    for (const std::string_view name : {"VALLEY", "Valley-Fold", "BEND_UP"})
        EXPECT_EQ(named(name), Named::valley) << name;
    for (const std::string_view name : {"BLEED", "DIMENSIONS", "DIM", "Glue Area", "IV_TANGENT"})
        EXPECT_EQ(named(name), Named::ignore) << name;
    for (const std::string_view name : {"0", "Layer 1", "UP", "DIELINE", "cut and crease"})
        EXPECT_EQ(named(name), Named::nothing) << name;
}

TEST(DxfLayers, MayHaveNamesOfAnyAge) {
    ReadOptions options;
    options.drawing.lines.push_back({"Größe", DrawnUse::print});
    const std::vector<std::pair<std::string_view, std::string>> names{
        {"9 $ACADVER|1 AC1015|9 $DWGCODEPAGE|3 ANSI_1252",
         "Gr\xF6\xDF"
         "e"},
        {"9 $ACADVER|1 AC1027",
         "Gr\xC3\xB6\xC3\x9F"
         "e"},
        {"9 $ACADVER|1 AC1015", "Gr\\U+00F6\\U+00DFe"}};
    for (const auto& [header, name] : names) {
        const Traced one = traced(dxf_file(on(name), {}, {}, header), options);
        ASSERT_TRUE(one.tracing) << one.told;
        EXPECT_EQ(one.line().named, Named::print) << name;
    }
}

// The colours that everybody knows by their number, and the way the rest goes round.
TEST(DxfLayers, HaveColoursByNumber) {
    const auto color = [](int index) {
        return to_string(traced(dxf_file(on("0", fmt::format("62 {}", index)))).line().color);
    };
    EXPECT_EQ(color(1), "#ff0000");
    EXPECT_EQ(color(2), "#ffff00");
    EXPECT_EQ(color(3), "#00ff00");
    EXPECT_EQ(color(4), "#00ffff");
    EXPECT_EQ(color(5), "#0000ff");
    EXPECT_EQ(color(6), "#ff00ff");
    EXPECT_EQ(color(7), "#000000");
    EXPECT_EQ(color(8), "#808080");
    EXPECT_EQ(color(10), "#ff0000");
    EXPECT_EQ(color(11), "#ff7f7f");
    EXPECT_EQ(color(20), "#ff3f00");
    EXPECT_EQ(color(30), "#ff7f00");
    EXPECT_EQ(color(50), "#ffff00");
    EXPECT_EQ(color(92), "#00a500");
    EXPECT_EQ(color(130), "#00ffff");
    EXPECT_EQ(color(170), "#0000ff");
    EXPECT_EQ(color(210), "#ff00ff");
    EXPECT_EQ(color(240), "#ff003f");
    EXPECT_EQ(color(255), "#ffffff");
}

// --- units

TEST(DxfUnits, AreThoseOfTheFile) {
    for (const auto& [header, mm] : {std::pair{"9 $INSUNITS|70 4", 1.0},
                                     {"9 $INSUNITS|70 1", 25.4},
                                     {"9 $INSUNITS|70 5", 10.0},
                                     {"9 $INSUNITS|70 6", 1000.0},
                                     {"9 $INSUNITS|70 0|9 $MEASUREMENT|70 0", 25.4},
                                     {"9 $INSUNITS|70 0|9 $MEASUREMENT|70 1", 1.0},
                                     {"", 1.0}}) {
        const Traced one = traced(dxf_file("0 LINE|8 0|10 0|20 0|11 2|21 1", {}, {}, header));
        ASSERT_TRUE(one.tracing) << one.told;
        expect_at(one.line().points[1], 2 * mm, mm);
        const bool said = std::string_view(header).size() == 16 && header[15] != '0';
        EXPECT_EQ(one.told.find("dxf-unit") == std::string::npos, said) << header << one.told;
        EXPECT_EQ(shown_point(one.tracing->ruler, one.line().points[1]).substr(0, 12), "(2.00, 1.00)");
    }
}

TEST(DxfUnits, LargeDrawingsAreToldOf) {
    const Traced one = traced(dxf_file("0 LINE|8 0|10 0|20 0|11 60|21 40", {}, {}, "9 $INSUNITS|70 6"));
    EXPECT_NE(one.told.find("warning dxf-size: with m for its unit the drawing is 60000.00 × 40000.00 mm"),
              std::string::npos)
        << one.told;
    const Traced far = traced(dxf_file("0 LINE|8 0|10 0|20 0|11 600|21 40", {}, {}, "9 $INSUNITS|70 6"));
    EXPECT_FALSE(far.tracing);
    EXPECT_NE(far.told.find("error bad-number: with m for the unit this reaches further"), std::string::npos)
        << far.told;
}

TEST(DxfUnits, DrawingsFarFromTheirOriginAreMoved) {
    const Traced one = traced(dxf_file("0 LINE|8 0|10 500000.25|20 -700000|11 500010.25|21 -700020"));
    ASSERT_TRUE(one.tracing) << one.told;
    expect_at(one.line().points[0], 0.25, 20);
    EXPECT_EQ(shown_point(one.tracing->ruler, one.line().points[0]), "(500000.25, -700000.00) mm");
}

// --- what they show

constexpr std::string_view kCarton =
    "0 LWPOLYLINE|8 CUT|90 4|70 1|10 0|20 0|10 90|20 0|10 90|20 40|10 0|20 40|0 LINE|8 CREASE|10 30|20 0|11 "
    "30|21 40|0 "
    "LINE|8 CREASE|10 60|20 0|11 60|21 40";

TEST(DxfDrawing, IsFoldedWhereLayersNameFolds) {
    Diagnostics diagnostics("box.dxf");
    const Reading reading = read(dxf_file(kCarton), diagnostics);
    ASSERT_TRUE(reading.creases) << test::findings(diagnostics);
    ASSERT_EQ(reading.creases->lines.size(), 3U);
    EXPECT_EQ(reading.creases->lines[1].use, CreaseUse::fold);
    EXPECT_FALSE(reading.creases->lines[1].fold_deg);
    const auto assembly = fold_sheet(*reading.creases, {}, diagnostics);
    ASSERT_TRUE(assembly) << test::findings(diagnostics);
    EXPECT_EQ(assembly->plates.size(), 3U);

    Diagnostics of_parts("box.dxf");
    ReadOptions options;
    options.drawing.as = DrawnAs::parts;
    const Reading parts = read(dxf_file(kCarton), of_parts, options);
    ASSERT_TRUE(parts.assembly) << test::findings(of_parts);
    EXPECT_EQ(test::findings(of_parts), "");
    // The creases are folds of the part, and not cuts through it.
    ASSERT_EQ(parts.assembly->pieces.size(), 1U);
}

TEST(DxfDrawing, IsPartsWhereNothingIsAFold) {
    Diagnostics diagnostics("box.dxf");
    // Lines and arcs whose ends meet; red, as laser cutters like it.
    const Reading reading = read(
        dxf_file(
            "0 LINE|8 0|62 1|10 0|20 0|11 30|21 0|0 ARC|8 0|62 1|10 30|20 10|40 10|50 270|51 90|0 LINE|8 "
            "0|62 1|10 "
            "30|20 20|11 0|21 20|0 LINE|8 0|62 1|10 0|20 20|11 0|21 0|0 CIRCLE|8 0|62 1|10 15|20 10|40 4"),
        diagnostics);
    ASSERT_TRUE(reading.assembly) << test::findings(diagnostics);
    EXPECT_EQ(reading.assembly->pieces.size(), 1U);
}

// Standard red is what a crease has in CAD: nothing says that it is folded flat, as in Origami Simulator.
TEST(DxfDrawing, RedFoldsAreNoHalfTurns) {
    Diagnostics diagnostics("box.dxf");
    ReadOptions options;
    options.drawing.as = DrawnAs::folded;
    const Reading reading =
        read(dxf_file("0 LWPOLYLINE|8 0|90 4|70 1|10 0|20 0|10 90|20 0|10 90|20 40|10 0|20 40|0 "
                      "LINE|8 0|62 1|10 30|20 0|11 30|21 40"),
             diagnostics, options);
    ASSERT_TRUE(reading.creases) << test::findings(diagnostics);
    EXPECT_EQ(reading.creases->lines[1].use, CreaseUse::mountain);
    EXPECT_FALSE(reading.creases->lines[1].fold_deg);
    EXPECT_EQ(reading.creases->fold_deg, 90.0);
}

// Drawn twice, once with y down: the same crease pattern.
TEST(DxfDrawing, AndSvgOfItAreTheSamePattern) {
    const std::string svg =
        "<svg xmlns='http://www.w3.org/2000/svg' width='90mm' height='40mm' viewBox='0 0 90 40' fill='none'>"
        "<path id='cut' stroke='#000' d='M0 40H90V0H0Z'/>"
        "<path id='cut-2' stroke='#000' d='M10 30A5 5 0 0 0 10 20'/>"
        "<path id='crease' stroke='#f00' d='M30 40V0'/><path id='crease-2' stroke='#f00' d='M60 40V0'/>"
        "<path id='valley' stroke='#00f' d='M30 20C40 0 50 40 60 20'/></svg>";
    const std::string dxf = dxf_file(
        "0 LWPOLYLINE|8 CUT|90 4|70 1|10 0|20 0|10 90|20 0|10 90|20 40|10 0|20 40|0 ARC|8 CUT|10 10|20 15|40 "
        "5|50 "
        "270|51 90|0 LINE|8 CREASE|62 1|10 30|20 0|11 30|21 40|0 LINE|8 CREASE|62 1|10 60|20 0|11 60|21 40|0 "
        "SPLINE|8 "
        "VALLEY|62 5|70 8|71 3|40 0|40 0|40 0|40 0|40 1|40 1|40 1|40 1|10 30|20 20|10 40|20 40|10 50|20 0|10 "
        "60|20 20");
    ReadOptions options;
    options.drawing.as = DrawnAs::folded;
    Diagnostics of_svg("box.svg");
    Diagnostics of_dxf("box.dxf");
    const Reading a = read_source_text(Source{"box.svg", svg}, options, of_svg);
    const Reading b = read(dxf, of_dxf, options);
    ASSERT_TRUE(a.creases && b.creases) << test::findings(of_svg) << test::findings(of_dxf);
    ASSERT_EQ(a.creases->lines.size(), b.creases->lines.size());
    for (std::size_t i = 0; i < a.creases->lines.size(); ++i) {
        const CreaseLine& one = a.creases->lines[i];
        CreaseLine other = b.creases->lines[i];
        EXPECT_EQ(one.use, other.use);
        EXPECT_EQ(one.closed, other.closed);
        EXPECT_EQ(one.name, other.name);
        ASSERT_EQ(one.points.size(), other.points.size()) << i;
        if (distance(one.points[0], other.points[0]) > 1e-6)
            std::reverse(other.points.begin(), other.points.end());
        for (std::size_t k = 0; k < one.points.size(); ++k)
            EXPECT_LT(distance(one.points[k], other.points[k]), 2e-6);
    }
}

// --- what is wrong

std::string wrong(const std::string& text) {
    const Traced one = traced(text);
    EXPECT_FALSE(one.tracing);
    if (one.findings.empty()) return "";
    const Diagnostic& first = one.findings.front();
    return std::to_string(first.place.line) + " " + first.code + ": " + first.message;
}

TEST(DxfBad, FilesThatAreNoTextOfDxf) {
    EXPECT_EQ(wrong(""), "0 empty-input: the file is empty");
    EXPECT_EQ(wrong(" \r\n\r\n"), "0 empty-input: the file holds only blanks");
    EXPECT_EQ(wrong("AutoCAD Binary DXF\r\n\x1a"),
              "0 dxf-binary: this is a binary DXF file, and not an ASCII DXF file");
    EXPECT_EQ(wrong(std::string("AC1015\0\0\0\0\0", 11)),
              "0 dxf-binary: this is a DWG file, and not an ASCII DXF file");
    EXPECT_EQ(wrong("hello"), "1 dxf-syntax: here stands a group code, a whole number, and not \"hello\"");
    EXPECT_EQ(wrong("0\nLINE\n0\nEOF\n"),
              "2 dxf-syntax: a section begins here with 0 and SECTION, and not 0 and \"LINE\"");
}

TEST(DxfBad, FilesThatWereCutOff) {
    const std::string whole = dxf_file(kCarton);
    EXPECT_EQ(wrong("0\nSECTION\n2\nENTITIES\n0\nLINE\n8\n"),
              "7 dxf-syntax: the file ends behind the group code 8, without its value");
    EXPECT_EQ(wrong("0\nSECTION\n2\nENTITIES\n0\nLINE\n8\nCUT\n"),
              "8 dxf-syntax: the file ends in the section ENTITIES");
    const Traced no_end = traced(whole.substr(0, whole.size() - 6));
    ASSERT_TRUE(no_end.tracing);
    EXPECT_EQ(no_end.told,
              "warning dxf-no-end: the file ends without 0 and EOF, so something may be missing\n");
    // Wherever it is cut, the reader says so or has what is whole.
    for (std::size_t i = 0; i < whole.size(); ++i) {
        const Traced one = traced(whole.substr(0, i));
        EXPECT_FALSE(one.findings.empty() && i + 1 < whole.size()) << i;
    }
}

TEST(DxfBad, NumbersThatAreNone) {
    const auto line = [](std::string_view x) {
        return dxf_file("0 LINE|8 0|10 " + std::string(x) + "|20 0|11 1|21 1");
    };
    for (const std::string_view x : {"abc", "", "nan", "inf", "1e999", "1,5", "0x10"})
        EXPECT_EQ(wrong(line(x)),
                  fmt::format("20 bad-number: group 10 of this LINE is \"{}\", which is no number", x));
    EXPECT_TRUE(traced(line("+1.5")).tracing);
    EXPECT_TRUE(traced(line("  1.5E+01  ")).tracing);
    EXPECT_EQ(wrong(line("1e30")).substr(0, 17), "16 bad-number: wi");
    EXPECT_EQ(wrong(dxf_file("0 CIRCLE|8 0|62 2.5|10 0|20 0|40 1")),
              "20 bad-number: group 62 of this CIRCLE is \"2.5\", which is no whole number");
    EXPECT_EQ(wrong("0\nSECTION\nzwei\nENTITIES\n"),
              "3 dxf-syntax: here stands a group code, a whole number, and not \"zwei\"");
}

TEST(DxfBad, CurvesThatCannotBe) {
    EXPECT_EQ(wrong(dxf_file("0 CIRCLE|8 0|10 0|20 0|40 -2")),
              "16 dxf-curve: the radius of this CIRCLE is below zero");
    EXPECT_EQ(wrong(dxf_file("0 ARC|8 0|10 0|20 0|40 -1|50 0|51 9")),
              "16 dxf-curve: the radius of this ARC is below zero");
    EXPECT_EQ(wrong(dxf_file("0 SPLINE|8 0|71 3|10 0|20 0|10 1|20 1")),
              "16 dxf-curve: a spline of degree 3 needs 4 control points, and has 2");
    EXPECT_EQ(wrong(dxf_file("0 SPLINE|8 0|71 1|40 0|40 1|10 0|20 0|10 1|20 1")),
              "16 dxf-curve: a spline of degree 1 with 2 control points has 4 knots, and here are 2");
    EXPECT_EQ(wrong(dxf_file("0 SPLINE|8 0|71 1|40 0|40 2|40 1|40 3|10 0|20 0|10 1|20 1")),
              "16 dxf-curve: the knots of a spline go back");
    EXPECT_EQ(wrong(dxf_file("0 SPLINE|8 0|71 1|40 1|40 1|40 1|40 1|10 0|20 0|10 1|20 1")),
              "16 dxf-curve: the knots of a spline are all one");
    EXPECT_EQ(wrong(dxf_file("0 SPLINE|8 0|71 99|10 0|20 0|10 1|20 1")),
              "16 dxf-curve: a spline's degree is 99, and not from 1 to 25");
    EXPECT_EQ(wrong(dxf_file("0 SPLINE|8 0|71 1|40 0|40 0|40 1|40 1|41 1|41 0|10 0|20 0|10 1|20 1")),
              "16 dxf-curve: a weight of a spline is not above zero");
}

// As in SVG, what has no size draws nothing.
TEST(DxfBad, NothingIsDrawnOfCurvesWithoutSize) {
    const Traced one =
        traced(dxf_file("0 CIRCLE|8 0|10 0|20 0|40 0|0 ARC|8 0|10 0|20 0|40 0|50 0|51 9|0 ELLIPSE|8 0|10 "
                        "0|20 0|11 0|21 0|40 1|0 LWPOLYLINE|8 0|90 0|0 LINE|8 0|10 3|20 3|11 3|21 3"));
    ASSERT_TRUE(one.tracing) << one.told;
    EXPECT_TRUE(one.tracing->lines.empty());
    EXPECT_EQ(one.told, "");
}

TEST(DxfBad, LinesMayEndInAnyWay) {
    const std::string text = dxf_file(kCarton);
    std::string crlf;
    std::string cr;
    for (const char c : text) {
        crlf += c == '\n' ? "\r\n" : std::string(1, c);
        cr += c == '\n' ? '\r' : c;
    }
    const Traced plain = traced(text);
    for (const std::string& other :
         {crlf, cr, "999\nby hand\n" + text, text + "\n\n\x1a", "\xEF\xBB\xBF" + text}) {
        const Traced one = traced(other);
        ASSERT_TRUE(one.tracing) << one.told;
        ASSERT_EQ(one.tracing->lines.size(), plain.tracing->lines.size());
        EXPECT_EQ(one.line(0).points, plain.line(0).points);
        EXPECT_EQ(one.told, "");
    }
}

TEST(DxfDrawing, IsRecognised) {
    EXPECT_TRUE(dxf::recognises(dxf_file(kCarton)));
    EXPECT_TRUE(dxf::recognises("999\nby hand\n  0\r\nSECTION\r\n"));
    EXPECT_TRUE(dxf::recognises("AutoCAD Binary DXF\r\n\x1a"));
    EXPECT_FALSE(dxf::recognises("<svg/>"));
    EXPECT_FALSE(dxf::recognises(""));
    EXPECT_FALSE(dxf::recognises("0\n1\n"));
}

}  // namespace
}  // namespace popup
