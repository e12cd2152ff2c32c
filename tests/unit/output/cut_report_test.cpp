// What a machine has to do: against the written SVG, followed path by path by a reader of this test's own,
// and against times worked out by hand.
#include "output/cut_report.h"

#include <gtest/gtest.h>
#include <tinyxml2.h>

#include <cmath>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "output/svg.h"
#include "popup/compile.h"
#include "support/profiles.h"
#include "support/sheet_example.h"

namespace popup {
namespace {

using test::pen_of;

using Json = nlohmann::ordered_json;

// Null when there is none.
Json reported(const Layout& layout, const OutputOptions& options) {
    Diagnostics diagnostics;
    const auto report = cut_report(layout, options, diagnostics);
    EXPECT_NE(report.has_value(), diagnostics.has_errors());
    return report.value_or(nullptr);
}

using test::rectangle;

// --- a reader of sheets

struct Walk {
    std::map<std::string, double> lengths;  // by layer
    std::map<std::string, std::size_t> paths;
    double travel = 0.0;
    std::size_t points = 0;
    Vec2 at;

    [[nodiscard]] std::size_t pierces() const {
        std::size_t sum = 0;
        for (const auto& [layer, count] : paths) sum += count;
        return sum;
    }
};

// "M1,2L3,4Z", absolute and straight.
void follow(const std::string& d, const std::string& layer, Walk& walk) {
    std::istringstream in(d);
    in.imbue(std::locale::classic());
    Vec2 begin;
    char command = 0;
    while (in >> command) {
        if (command == 'Z') {
            walk.lengths[layer] += distance(walk.at, begin);
            walk.at = begin;
            continue;
        }
        Vec2 p;
        char comma = 0;
        in >> p.x >> comma >> p.y;
        ASSERT_TRUE(in && comma == ',') << d;
        ++walk.points;
        if (command == 'M') {
            walk.travel += distance(walk.at, p);
            ++walk.paths[layer];
            begin = p;
        } else {
            ASSERT_EQ(command, 'L') << d;
            walk.lengths[layer] += distance(walk.at, p);
        }
        walk.at = p;
    }
}

void follow(const tinyxml2::XMLElement& group, const std::string& layer, Walk& walk) {
    for (const auto* one = group.FirstChildElement(); one != nullptr; one = one->NextSiblingElement()) {
        const std::string tag = one->Name();
        if (tag == "path") {
            follow(one->Attribute("d"), layer, walk);
        } else if (tag == "g") {
            follow(*one, layer, walk);
        }
    }
}

// Through a sheet's file as a machine goes, which leaves out these layers; from the lower left corner on.
Walk walk_through(const std::string& svg, const std::set<std::string>& printed) {
    Walk walk;
    tinyxml2::XMLDocument document;
    EXPECT_EQ(document.Parse(svg.data(), svg.size()), tinyxml2::XML_SUCCESS);
    const tinyxml2::XMLElement* root = document.FirstChildElement("svg");
    const tinyxml2::XMLElement* sheet = root->FirstChildElement("g");
    walk.at = {0.0, std::stod(root->Attribute("height"))};
    for (const auto* one = sheet->FirstChildElement("g"); one != nullptr;
         one = one->NextSiblingElement("g")) {
        const std::string layer = one->Attribute("inkscape:label");
        if (!printed.contains(layer)) follow(*one, layer, walk);
    }
    return walk;
}

std::set<std::string> printed_layers(const Profile& profile) {
    std::set<std::string> all;
    for (const Operation operation : kOperations) {
        if (is_printed(operation)) all.insert(profile.pen(operation).layer);
    }
    return all;
}

std::vector<SheetFile> svg_files(const Layout& layout, const OutputOptions& options) {
    Diagnostics diagnostics;
    return write_svg(layout, options, diagnostics).value();
}

// --- against the files

void expect_same(const Json& row, const Walk& walk) {
    // Each coordinate of the file is rounded to four decimals.
    const double tolerance = 1.5e-4 * static_cast<double>(walk.points + 1);
    std::map<std::string, double> lengths;
    std::map<std::string, std::size_t> paths;
    for (const Json& share : row.at("operations")) {
        lengths[share.at("layer")] += share.at("length_mm").get<double>();
        paths[share.at("layer")] += share.at("paths").get<std::size_t>();
    }
    EXPECT_EQ(paths, walk.paths);
    ASSERT_EQ(lengths.size(), walk.lengths.size());
    for (const auto& [layer, mm] : walk.lengths) EXPECT_NEAR(lengths[layer], mm, tolerance) << layer;
    EXPECT_NEAR(row.at("travel_mm").get<double>(), walk.travel, tolerance);
    EXPECT_EQ(row.at("pierces").get<std::size_t>(), walk.pierces());
}

// The report's sheets are those files in which a machine does anything, in their order.
void expect_same(const Layout& layout, const OutputOptions& options) {
    const Json report = reported(layout, options);
    EXPECT_EQ(report.at("profile"), options.profile.name);
    std::vector<Walk> walks;
    for (const SheetFile& file : svg_files(layout, options)) {
        // What is printed alone has no cuts, whatever its layers are called.
        if (file.suffix.ends_with("-print")) continue;
        walks.push_back(walk_through(file.bytes, printed_layers(options.profile)));
        if (walks.back().pierces() == 0) walks.pop_back();
    }
    const Json& sheets = report.at("sheets");
    ASSERT_EQ(sheets.size(), walks.size());
    double travel = 0.0;
    std::size_t pierces = 0;
    std::map<std::string, double> lengths;
    for (std::size_t i = 0; i < walks.size(); ++i) {
        expect_same(sheets[i], walks[i]);
        travel += sheets[i].at("travel_mm").get<double>();
        pierces += sheets[i].at("pierces").get<std::size_t>();
        for (const Json& share : sheets[i].at("operations"))
            lengths[share.at("operation")] += share.at("length_mm").get<double>();
    }
    EXPECT_NEAR(report.at("travel_mm").get<double>(), travel, 1e-5);
    EXPECT_EQ(report.at("pierces").get<std::size_t>(), pierces);
    ASSERT_EQ(report.at("operations").size(), lengths.size());
    for (const Json& share : report.at("operations"))
        EXPECT_NEAR(share.at("length_mm").get<double>(), lengths[share.at("operation")], 1e-5);
}

TEST(CutReport, SaysWhatTheFilesHave) {
    for (const Profile& profile : profile_table()) {
        for (const ScoreSide side : {ScoreSide::front, ScoreSide::back, ScoreSide::both}) {
            for (const bool apart : {false, true}) {
                SCOPED_TRACE(profile.name + (apart ? " apart" : ""));
                OutputOptions options;
                options.profile = profile;
                options.score_side = side;
                options.print_and_cut = apart;
                options.profile.marks = Marks::corners;
                expect_same(test::example_layout(), options);
            }
        }
    }
}

TEST(CutReport, SaysWhatTheFilesOfASampleHave) {
    Diagnostics unheard;
    const auto source = read_source(std::string(POPUP_SOURCE_DIR) + "/samples/castle.xml", unheard);
    CompileOptions compiling;
    compiling.motion.angles = {Angle::degrees(0), Angle::degrees(180)};
    const Compilation run = compile({source.value()}, compiling, {});
    for (const char* name : {"workshop", "lightburn", "silhouette"}) {
        for (const FoldStyle style : kFoldStyles) {
            SCOPED_TRACE(name);
            OutputOptions options;
            options.profile = *find_profile(name);
            options.profile.folds = style;
            expect_same(run.layout.value(), options);
        }
    }
}

TEST(CutReport, TellsFrontsFromBacks) {
    OutputOptions options;
    options.score_side = ScoreSide::both;
    const Json report = reported(test::example_layout(), options);
    std::vector<std::string> sides;
    for (const Json& sheet : report.at("sheets"))
        sides.push_back(std::to_string(sheet.at("sheet").get<int>()) + sheet.at("side").get<std::string>());
    // The houses of the second sheet have no valley folds.
    EXPECT_EQ(sides, (std::vector<std::string>{"1front", "1back", "2front"}));
    const Json& back = report.at("sheets")[1];
    ASSERT_EQ(back.at("operations").size(), 1U);
    EXPECT_EQ(back.at("operations")[0].at("operation"), "valley");
}

// --- by hand

// A square of 40 mm with a window of 10 mm and a fold across it of 40 mm, its lower left corner at 30, 40.
Layout square_layout() {
    Layout layout;
    layout.margin_mm = 5;
    layout.sheets = {{200, 100, 0.1, {40, 40}}};
    layout.designs = {{"square.xml", "square", {}}};
    PatternPiece& piece = layout.designs[0].pattern.pieces.emplace_back();
    piece.name = "square";
    piece.cuts = {{rectangle(10, 10, 20, 20), true, 1}, {rectangle(0, 0, 40, 40), true, 0}};
    piece.lines = {{LineKind::mountain, {{40, 30}, {0, 30}}}};
    piece.silhouette = {{rectangle(0, 0, 40, 40), {}}};
    piece.bounds = {{0, 0}, {40, 40}};
    layout.placements = {{0, 0, 0, 0, {30, 40}, Angle::degrees(0)}};
    return layout;
}

// Piece by piece, so that the order is known: the fold, the window, the square.
OutputOptions timed_options() {
    OutputOptions options;
    pen_of(options.profile, Operation::mountain).speed_mm_s = 20.0;
    pen_of(options.profile, Operation::inner_cut).speed_mm_s = 8.0;
    pen_of(options.profile, Operation::outer_cut).speed_mm_s = 10.0;
    options.profile.travel_mm_s = 100.0;
    options.profile.pierce_s = 0.25;
    return options;
}

// From 0, 0 to 70, 70; from 30, 70 to 40, 50; from there to 30, 40.
const double kTravel = std::hypot(70, 70) + std::hypot(10, 20) + std::hypot(10, 10);

TEST(CutReport, WorksOutTheTime) {
    const Json report = reported(square_layout(), timed_options());
    EXPECT_EQ(report.at("pierces"), 3);
    EXPECT_NEAR(report.at("travel_mm").get<double>(), kTravel, 1e-6);
    EXPECT_NEAR(report.at("time_s").get<double>(),
                40.0 / 20.0 + 40.0 / 8.0 + 160.0 / 10.0 + kTravel / 100.0 + 3 * 0.25, 5e-4);
    EXPECT_EQ(report.at("sheets")[0].at("time_s"), report.at("time_s"));
    const Json& rows = report.at("operations");
    ASSERT_EQ(rows.size(), 3U);
    EXPECT_EQ(rows[0],
              (Json{{"operation", "mountain"}, {"layer", "mountain"}, {"paths", 1}, {"length_mm", 40.0}}));
    EXPECT_EQ(rows[1],
              (Json{{"operation", "inner-cut"}, {"layer", "cut"}, {"paths", 1}, {"length_mm", 40.0}}));
    EXPECT_EQ(rows[2],
              (Json{{"operation", "outer-cut"}, {"layer", "cut"}, {"paths", 1}, {"length_mm", 160.0}}));
}

TEST(CutReport, KnowsNoTimeWhereASpeedThatItNeedsIsMissing) {
    for (const Operation operation : kOperations) {
        const bool needed = operation == Operation::mountain || operation == Operation::inner_cut ||
                            operation == Operation::outer_cut;
        OutputOptions options = timed_options();
        pen_of(options.profile, operation).speed_mm_s = 0.0;
        EXPECT_EQ(reported(square_layout(), options).at("time_s").is_null(), needed) << to_string(operation);
    }
    OutputOptions options = timed_options();
    options.profile.travel_mm_s = 0.0;
    const Json report = reported(square_layout(), options);
    EXPECT_TRUE(report.at("time_s").is_null());
    EXPECT_TRUE(report.at("sheets")[0].at("time_s").is_null());
    EXPECT_FALSE(report.at("travel_mm").is_null());
    pen_of(options.profile, Operation::inner_cut).speed_mm_s = 0.0;
    Diagnostics diagnostics("report");
    EXPECT_TRUE(cut_report(square_layout(), options, diagnostics));
    EXPECT_EQ(test::findings(diagnostics),
              "remark time-unknown: the report has no time: no speed is known for travel, inner-cut\n");
    // A pierce that takes no time is known.
    options = timed_options();
    options.profile.pierce_s = 0.0;
    EXPECT_FALSE(reported(square_layout(), options).at("time_s").is_null());
}

// Of one sheet all may be known and of another not.
TEST(CutReport, KnowsTheTimeSheetBySheet) {
    OutputOptions options = timed_options();
    pen_of(options.profile, Operation::valley).speed_mm_s = 0.0;
    Layout layout = square_layout();
    layout.sheets.push_back(layout.sheets[0]);
    layout.designs[0].pattern.pieces.push_back(layout.designs[0].pattern.pieces[0]);
    layout.designs[0].pattern.pieces[1].lines[0].kind = LineKind::valley;
    layout.placements.push_back({0, 1, 0, 1, {30, 40}, Angle::degrees(0)});
    const Json report = reported(layout, options);
    EXPECT_TRUE(report.at("time_s").is_null());
    EXPECT_TRUE(report.at("sheets")[0].at("time_s").is_number());
    EXPECT_TRUE(report.at("sheets")[1].at("time_s").is_null());
    pen_of(options.profile, Operation::valley).speed_mm_s = 20.0;
    const Json known = reported(layout, options);
    EXPECT_NEAR(known.at("time_s").get<double>(), 2.0 * known.at("sheets")[0].at("time_s").get<double>(),
                1e-3);
}

// Each cut of a perforated line is begun on its own.
TEST(CutReport, CountsEveryCutOfAPerforatedFold) {
    OutputOptions options = timed_options();
    options.profile.folds = FoldStyle::perforated;
    options.profile.perforation = {2.0, 2.0, 1.0};
    pen_of(options.profile, Operation::perforation).speed_mm_s = 19.0;
    const Json report = reported(square_layout(), options);
    // 40 mm, a millimetre clear at each end: ten cuts and nine gaps, all of 2 mm.
    const Json& row = report.at("operations")[0];
    EXPECT_EQ(row.at("operation"), "perforation");
    EXPECT_EQ(row.at("paths"), 10);
    EXPECT_NEAR(row.at("length_mm").get<double>(), 20.0, 1e-6);
    EXPECT_EQ(report.at("pierces"), 12);
    const double travel = std::hypot(69, 70) + 9 * 2.0 + std::hypot(9, 20) + std::hypot(10, 10);
    EXPECT_NEAR(report.at("travel_mm").get<double>(), travel, 1e-6);
    EXPECT_NEAR(report.at("time_s").get<double>(),
                20.0 / 19.0 + 40.0 / 8.0 + 160.0 / 10.0 + travel / 100.0 + 12 * 0.25, 5e-4);
}

TEST(CutReport, IsNullWhereTheSheetsCannotBeDrawn) {
    OutputOptions options = timed_options();
    options.reference_mm = 500.0;
    EXPECT_TRUE(reported(square_layout(), options).is_null());
}

TEST(CutReport, OfSheetsWithNothingToCutHasNoSheets) {
    Layout layout = square_layout();
    layout.placements.clear();
    const Json report = reported(layout, timed_options());
    EXPECT_TRUE(report.at("sheets").empty());
    EXPECT_TRUE(report.at("operations").empty());
    EXPECT_EQ(report.at("pierces"), 0);
    EXPECT_EQ(report.at("time_s"), 0.0);
}

}  // namespace
}  // namespace popup
