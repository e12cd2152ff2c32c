#include "output/production_pdf.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <map>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "output/pdf.h"
#include "support/profiles.h"
#include "support/run_program.h"
#include "support/separated_pdf.h"
#include "support/sheet_example.h"

namespace popup {
namespace {

using test::pen_of;

using test::Cmyk;
using test::example_layout;
using test::Painted;
using test::ReadDocument;

constexpr double kPoint = 25.4 / 72.0;  // mm

OutputOptions production() {
    OutputOptions options;
    options.profile = *find_profile("print-and-cut");
    return options;
}

std::string written(const Layout& layout, const OutputOptions& options = production()) {
    Diagnostics diagnostics;
    const auto documents = write_production_pdf(layout, options, diagnostics);
    EXPECT_FALSE(diagnostics.has_findings());
    if (!documents) return {};
    EXPECT_EQ(documents->size(), 1U);
    return documents->front().bytes;
}

// A card without any colour of its own.
Layout plain_layout() {
    Layout layout = example_layout();
    for (PatternPiece& piece : layout.designs[0].pattern.pieces) {
        piece.prints.clear();
    }
    return layout;
}

std::map<std::string, double> lengths(const ReadDocument& document) {
    std::map<std::string, double> mm;
    for (const Painted& one : document.painted()) {
        if (!one.spot.empty()) mm[one.spot] += one.mm;
    }
    return mm;
}

std::set<std::string> names(const std::map<std::string, std::string>& plates) {
    std::set<std::string> all;
    for (const auto& [name, pixels] : plates) all.insert(name);
    return all;
}

void expect_sound(const std::string& pdf) {
    const test::ScratchDirectory scratch;
    test::write_file(scratch / "a.pdf", pdf);
    const auto checked = test::run({"qpdf", "--check", (scratch / "a.pdf").string()});
    EXPECT_EQ(checked.exit, 0) << checked.out << checked.err;
}

#define NEEDS(program, package) \
    if (!test::have_program(program)) GTEST_SKIP() << program " is not installed (Debian package " package ")"

// --- what is guaranteed

TEST(ProductionPdf, QpdfFindsNothingWrong) {
    NEEDS("qpdf", "qpdf");
    OutputOptions everything = production();
    everything.profile.folds = FoldStyle::both;
    everything.profile.marks = Marks::corners;
    everything.reference_mm = 50;
    everything.backs = true;
    expect_sound(written(example_layout()));
    expect_sound(written(example_layout(), everything));
}

TEST(ProductionPdf, HasAPageASheetInItsTrueSize) {
    Layout layout = example_layout();
    layout.sheets[1].width_mm = 320.5;
    layout.sheets[1].height_mm = 450.0;
    const ReadDocument document = test::read_separations(written(layout));
    ASSERT_EQ(document.pages.size(), 2U);
    for (const auto& box : {document.pages[0].media, document.pages[0].trim}) {
        EXPECT_NEAR(box[2], 841.8898, 1e-4);
        EXPECT_NEAR(box[3], 595.2756, 1e-4);
    }
    EXPECT_NEAR(document.pages[1].media[2], 908.5039, 1e-4);
    EXPECT_NEAR(document.pages[1].trim[3], 1275.5906, 1e-4);
    EXPECT_EQ(document.title, "castle");
}

TEST(ProductionPdf, DrawsEveryLineInItsLengthPlaceAndSpotColour) {
    const ReadDocument document = test::read_separations(written(example_layout()));
    const double house = 2 * std::hypot(5, 10) + 30 + 2 * 60 + 2 * std::hypot(40, 15) + 40;
    const std::map<std::string, double> mm = lengths(document);
    ASSERT_EQ(mm.size(), 3U);
    EXPECT_NEAR(mm.at("CutContour"), 45 + 45 + 2 * (200 + 160) + 2 * house, 0.01);
    EXPECT_NEAR(mm.at("Crease"), 70 + 60 + std::hypot(1, 0.5) + 2 * 40, 0.01);
    EXPECT_NEAR(mm.at("ReverseCrease"), 30 + 2 * 75, 0.01);
    const auto expect_cuts = [&document](std::size_t page, const Box& expected) {
        Box cuts;
        for (const Painted& one : document.pages[page].painted) {
            if (one.spot != "CutContour") continue;
            cuts.extend(one.box.min);
            cuts.extend(one.box.max);
        }
        EXPECT_NEAR(cuts.min.x, expected.min.x, 0.001);
        EXPECT_NEAR(cuts.min.y, expected.min.y, 0.001);
        EXPECT_NEAR(cuts.max.x, expected.max.x, 0.001);
        EXPECT_NEAR(cuts.max.y, expected.max.y, 0.001);
    };
    expect_cuts(0, {{48.5, 25}, {248.5, 185}});
    expect_cuts(1, {{20.25, 30.125}, {210, 140}});
}

TEST(ProductionPdf, PerforationsAreLinesInASpotColourOfTheirOwn) {
    OutputOptions options = production();
    options.profile.folds = FoldStyle::perforated;
    const Layout layout = example_layout();
    const auto mm = lengths(test::read_separations(written(layout, options)));
    EXPECT_FALSE(mm.contains("Crease"));
    double expected = 0.0;
    for (const Placement& placement : layout.placements) {
        const auto& piece = layout.designs[0].pattern.pieces[static_cast<std::size_t>(placement.piece)];
        for (const PatternLine& line : piece.lines) {
            if (line.kind == LineKind::mark) continue;
            for (const Segment& cut : perforated(line.at, options.profile.perforation))
                expected += distance(cut.a, cut.b);
        }
    }
    EXPECT_NEAR(mm.at("PerfCutContour"), expected, 0.01);
}

TEST(ProductionPdf, SpotColoursOverprintInTheirWidthAndProcessColoursDoNot) {
    std::size_t spots = 0, process = 0;
    for (const Painted& one : test::read_separations(written(example_layout())).painted()) {
        EXPECT_EQ(one.overprint, !one.spot.empty()) << one.layer;
        EXPECT_EQ(one.dashes, 0U);
        if (one.spot.empty()) {
            ++process;
            continue;
        }
        ++spots;
        EXPECT_TRUE(one.stroke);
        EXPECT_NEAR(one.width_mm, 0.25 * kPoint, 1e-4);
    }
    EXPECT_EQ(spots, 5U + 3U + 3U + 2U);  // cuts, valleys, mountains, seams
    EXPECT_GE(process, 10U);
}

TEST(ProductionPdf, ArtIsInProcessColoursWithGreysOnBlackAlone) {
    std::set<Cmyk> fills, strokes;
    for (const Painted& one : test::read_separations(written(example_layout())).painted()) {
        if (one.spot.empty()) (one.stroke ? strokes : fills).insert(one.tints);
    }
    // #ffcc00, #cc6600, #d0e8ff, #a0c8f0, and labels in #737373, which are black on #a0c8f0.
    EXPECT_EQ(fills, (std::set<Cmyk>{{0, 200, 1000, 0},
                                     {0, 500, 1000, 200},
                                     {184, 90, 0, 0},
                                     {333, 167, 0, 59},
                                     {0, 0, 0, 549},
                                     {0, 0, 0, 1000}}));
    // #009933, the mark in #808080, the target in #8c8c8c.
    EXPECT_EQ(strokes, (std::set<Cmyk>{{1000, 0, 667, 400}, {0, 0, 0, 498}, {0, 0, 0, 451}}));
}

TEST(ProductionPdf, HolesOfFillsAreBareAndLettersAreFilledByTheOtherRule) {
    for (const Painted& one : test::read_separations(written(example_layout())).painted())
        EXPECT_EQ(one.even_odd, one.layer == "fill") << one.layer;
}

TEST(ProductionPdf, SpotColoursHaveThePensColourAsAlternate) {
    const auto alternates = test::read_separations(written(example_layout())).alternates;
    ASSERT_EQ(alternates.size(), 3U);
    EXPECT_EQ(alternates.at("CutContour"), (std::array<double, 4>{0, 1, 0, 0}));
    EXPECT_EQ(alternates.at("Crease"), (std::array<double, 4>{1, 1, 0, 0}));
    EXPECT_EQ(alternates.at("ReverseCrease"), (std::array<double, 4>{1, 0, 1, 0}));
}

TEST(ProductionPdf, APageNamesOnlyTheSpotColoursItUses) {
    Layout layout = example_layout();
    layout.designs[0].pattern.pieces[0].lines.clear();
    const ReadDocument document = test::read_separations(written(layout));
    EXPECT_EQ(document.pages[0].spots, (std::set<std::string>{"CutContour"}));
    EXPECT_EQ(document.pages[1].spots, (std::set<std::string>{"Crease", "CutContour", "ReverseCrease"}));
}

TEST(ProductionPdf, GhostscriptMakesThePlatesOfTheColoursAndSpots) {
    NEEDS("gs", "ghostscript");
    const std::set<std::string> spots{"1(Crease)", "1(CutContour)", "1(ReverseCrease)",
                                      "2(Crease)", "2(CutContour)", "2(ReverseCrease)"};
    std::set<std::string> plain = spots, colored = spots;
    plain.insert({"1(Black)", "2(Black)"});
    colored.insert({"1(Black)", "1(Cyan)", "1(Magenta)", "1(Yellow)", "2(Black)", "2(Cyan)", "2(Magenta)"});
    EXPECT_EQ(names(test::inked_plates(written(plain_layout()))), plain);
    EXPECT_EQ(names(test::inked_plates(written(example_layout()))), colored);
}

TEST(ProductionPdf, LinesOfMachinesKnockNothingOutOfTheArt) {
    NEEDS("gs", "ghostscript");
    OutputOptions art = production();
    for (const Operation operation : kOperations) {
        if (!is_printed(operation)) pen_of(art.profile, operation).layer.clear();
    }
    Layout layout = example_layout();
    // Lines straight across a fill.
    PatternPiece& page = layout.designs[0].pattern.pieces[0];
    page.prints.push_back({Area{{test::rectangle(-95, -75, 95, 75), {}}, {0x33, 0x66, 0x99}}, 0});
    const auto all = test::inked_plates(written(layout));
    for (const auto& [name, pixels] : test::inked_plates(written(layout, art)))
        EXPECT_EQ(all.at(name), pixels) << name;
    // A process colour in the same place does.
    OutputOptions process = production();
    for (Pen& pen : process.profile.pens) {
        pen.spot.clear();
        pen.width_mm = 1.0;
    }
    EXPECT_NE(test::inked_plates(written(layout, process)).at("1(Cyan)"), all.at("1(Cyan)"));
}

TEST(ProductionPdf, LayersSayWhatIsDoneWithTheirLines) {
    const ReadDocument document = test::read_separations(written(example_layout()));
    const std::vector<std::pair<std::string, std::string>> expected{{"fill", ""},
                                                                    {"draw", ""},
                                                                    {"glue", "/Gluing"},
                                                                    {"label", ""},
                                                                    {"Creasing", "/Creasing"},
                                                                    {"Reverse creasing", "/ReverseCreasing"},
                                                                    {"Creasing of tabs", "/Creasing"},
                                                                    {"Cutting", "/Cutting"}};
    EXPECT_EQ(document.layers, expected);
    const std::map<std::string, std::string> steps{
        {"CutContour", "/Cutting"}, {"Crease", "/Creasing"}, {"ReverseCrease", "/ReverseCreasing"}};
    for (const Painted& one : document.painted()) {
        EXPECT_EQ(one.step, one.spot.empty() ? one.layer == "glue" ? "/Gluing" : "" : steps.at(one.spot));
    }
}

TEST(ProductionPdf, PerforationAndMarksHaveLayersOfTheirOwn) {
    OutputOptions options = production();
    options.profile.folds = FoldStyle::both;
    options.profile.marks = Marks::corners;
    const auto layers = test::read_separations(written(example_layout(), options)).layers;
    const auto has = [&layers](const char* name, const char* step) {
        return std::count(layers.begin(), layers.end(), std::pair<std::string, std::string>(name, step)) == 1;
    };
    EXPECT_TRUE(has("Perforating", "/Perforating"));
    EXPECT_TRUE(has("registration", ""));
    EXPECT_EQ(layers.size(), 10U);
}

TEST(ProductionPdf, ALayerOfSeveralStepsIsAGroupEach) {
    OutputOptions options = production();
    for (const Operation operation : kOperations) pen_of(options.profile, operation).layer = "all";
    const ReadDocument document = test::read_separations(written(example_layout(), options));
    const std::vector<std::pair<std::string, std::string>> expected{{"all", ""},
                                                                    {"all", "/Gluing"},
                                                                    {"all", "/Creasing"},
                                                                    {"all", "/ReverseCreasing"},
                                                                    {"all", "/Cutting"}};
    EXPECT_EQ(document.layers, expected);
    EXPECT_EQ(lengths(document), lengths(test::read_separations(written(example_layout()))));
}

TEST(ProductionPdf, ArtCanHaveASpotColourToo) {
    OutputOptions options = production();
    pen_of(options.profile, Operation::fill).spot = "White ink";
    pen_of(options.profile, Operation::glue).spot = "Glue";
    const ReadDocument document = test::read_separations(written(example_layout(), options));
    std::size_t fills = 0;
    for (const Painted& one : document.painted()) {
        if (one.layer == "fill") {
            ++fills;
            EXPECT_EQ(one.spot, "White ink");
            EXPECT_TRUE(one.overprint);
        }
        if (one.layer == "glue") {
            EXPECT_EQ(one.spot, "Glue");
        }
    }
    EXPECT_EQ(fills, 6U);
    EXPECT_NEAR(lengths(document).at("Glue"), 40 + 32 + 2 * std::hypot(10, 4), 0.01);
}

TEST(ProductionPdf, FoldsAreDashedWhereTheProfileSaysSo) {
    OutputOptions options = production();
    options.profile.folds = FoldStyle::dashed;
    const ReadDocument document = test::read_separations(written(example_layout(), options));
    for (const Painted& one : document.painted()) {
        EXPECT_EQ(one.dashes, one.spot == "Crease" ? 2U : one.spot == "ReverseCrease" ? 4U : 0U);
    }
    EXPECT_NEAR(lengths(document).at("ReverseCrease"), 30 + 2 * 75, 0.01);
}

TEST(ProductionPdf, TextIsOutlinesWhateverTheProfileSays) {
    OutputOptions options = production();
    const std::string outlined = written(example_layout(), options);
    options.profile.outlined_text = false;
    EXPECT_EQ(written(example_layout(), options), outlined);
    std::size_t labels = 0;
    for (const Painted& one : test::read_separations(outlined).painted())
        labels += one.layer == "label" && !one.stroke;
    EXPECT_EQ(labels, 2U + 2 * 2U);
}

TEST(ProductionPdf, PrintAndCutAreDocumentsOfTheirOwn) {
    OutputOptions options = production();
    options.print_and_cut = true;
    Diagnostics diagnostics;
    const auto files = write_production_pdf(example_layout(), options, diagnostics);
    ASSERT_TRUE(files.has_value());
    ASSERT_EQ(files->size(), 2U);
    EXPECT_EQ((*files)[0].suffix, "-print");
    EXPECT_EQ((*files)[1].suffix, "-cut");
    const ReadDocument print = test::read_separations((*files)[0].bytes);
    const ReadDocument cut = test::read_separations((*files)[1].bytes);
    EXPECT_TRUE(print.alternates.empty());
    EXPECT_EQ(cut.alternates.size(), 3U);
    for (const Painted& one : cut.painted()) EXPECT_FALSE(one.spot.empty());
    EXPECT_EQ(print.painted().size() + cut.painted().size(),
              test::read_separations(written(example_layout())).painted().size());
}

TEST(ProductionPdf, TakesAnyNames) {
    OutputOptions options = production();
    const std::string layer = "Schnitt (✂) \\ 折り <<";
    const std::string spot = "Cut #1/(é) %[]<> ✂";
    for (const Operation cut : {Operation::slit, Operation::inner_cut, Operation::outer_cut}) {
        pen_of(options.profile, cut).layer = layer;
        pen_of(options.profile, cut).spot = spot;
    }
    pen_of(options.profile, Operation::valley).layer = "\xff\x01)";
    pen_of(options.profile, Operation::valley).spot = std::string("a\0b\xff", 4);
    Layout layout = example_layout("Шлосс) /Evil \\");
    layout.designs[0].pattern.pieces[0].labels[0].text = "\xff\x01)";
    const std::string pdf = written(layout, options);
    const ReadDocument document = test::read_separations(pdf);
    EXPECT_EQ(document.title, "Шлосс) /Evil \\");
    EXPECT_EQ(document.layers.back(), (std::pair<std::string, std::string>(layer, "/Cutting")));
    EXPECT_TRUE(lengths(document).contains(spot));
    EXPECT_TRUE(lengths(document).contains("a\\x00b\\xff"));
    if (test::have_program("qpdf")) expect_sound(pdf);
}

TEST(ProductionPdf, IsTheSameByteForByteWheneverAndWhateverWasWrittenBefore) {
    const std::string first = written(example_layout());
    EXPECT_NE(written(example_layout("bird")), first);
    // Into the next second: a PDF's identifier is a matter of time where nothing is done about it.
    const std::time_t then = std::time(nullptr);
    while (std::time(nullptr) == then) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    EXPECT_EQ(written(example_layout()), first);
}

TEST(ProductionPdf, BearsADateOnlyWhereSourceDateEpochIsSet) {
    ASSERT_EQ(setenv("SOURCE_DATE_EPOCH", "951827696", 1), 0);
    const std::string dated = written(example_layout());
    ASSERT_EQ(unsetenv("SOURCE_DATE_EPOCH"), 0);
    const std::string undated = written(example_layout());
    EXPECT_NE(dated.find("/CreationDate (D:20000229123456Z)"), std::string::npos);
    EXPECT_EQ(undated.find("Date"), std::string::npos);
}

TEST(ProductionPdf, ASheetLargerThanAPageCanBeIsAnError) {
    Layout layout = example_layout();
    layout.sheets[1].height_mm = 5081;
    Diagnostics diagnostics;
    EXPECT_FALSE(write_production_pdf(layout, production(), diagnostics).has_value());
    ASSERT_EQ(diagnostics.sorted().size(), 1U);
    EXPECT_EQ(diagnostics.sorted()[0].code, "pdf-page-size");
}

TEST(ProductionPdf, ASheetWithNothingOnItIsAnEmptyPage) {
    Layout layout = example_layout();
    layout.placements.clear();
    const ReadDocument document = test::read_separations(written(layout));
    EXPECT_EQ(document.pages.size(), 2U);
    EXPECT_TRUE(document.painted().empty());
    EXPECT_TRUE(document.layers.empty());
}

TEST(ProductionPdf, IsWhatWritePdfWritesForProfilesWithSpotColours) {
    Diagnostics diagnostics;
    const auto files = write_pdf(example_layout(), production(), diagnostics);
    ASSERT_TRUE(files.has_value());
    EXPECT_EQ(files->front().bytes, written(example_layout()));
    OutputOptions options;
    EXPECT_FALSE(has_spot_colors(options.profile));
    // The folds of workshop are dashed: there is nothing to perforate.
    pen_of(options.profile, Operation::perforation).spot = "Perforation";
    EXPECT_FALSE(has_spot_colors(options.profile));
    options.profile.folds = FoldStyle::both;
    EXPECT_TRUE(has_spot_colors(options.profile));
}

}  // namespace
}  // namespace popup
