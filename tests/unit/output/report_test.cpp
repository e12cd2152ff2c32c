#include "output/report.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/text/json_text.h"
#include "output/emit.h"
#include "output/emit_design.h"
#include "popup/compile.h"
#include "support/sheet_example.h"

namespace popup {
namespace {

using Json = nlohmann::ordered_json;

std::vector<std::string> keys(const Json& object) {
    std::vector<std::string> names;
    for (const auto& [key, value] : object.items()) names.push_back(key);
    return names;
}
using Keys = std::vector<std::string>;

// Two square plates on a gutter, driven apart.
Assembly example_assembly() {
    Assembly assembly;
    assembly.file = "castle.xml";
    assembly.stem = "castle";
    assembly.pieces = {{"page", {0, 1}}};
    Plate left;
    left.name = "page/left";
    left.outline.outer = test::rectangle(-10, -5, 0, 5);
    left.fill = Color{1, 2, 255};
    Plate right = left;
    right.name = "page/right";
    right.outline.outer = test::rectangle(0, -5, 10, 5);
    right.fill.reset();
    right.prints = {Stroke{{{1, 1}, {2, 2}}, 0.5, {0, 0, 0}}};
    assembly.plates = {left, right};
    assembly.lines = {{LineKind::valley, {{0, -5}, {0, 5}}, 0, 0, 1}};
    assembly.hinges = {{0, 1, {{0, -5}, {0, 5}}, {{0, -5}, {0, 5}}, false}};
    for (int i = 0; i < 2; ++i) {
        assembly.joints.push_back({"page", {}, Drive{i, {}, {0, 1}, i == 0 ? -1 : 1}});
        assembly.covers.push_back(i);
    }
    return assembly;
}

Motion example_motion() {
    Motion motion;
    motion.angles = {Angle::degrees(0), Angle::degrees(90), Angle::degrees(180)};
    motion.max_closure_mm = 1.23456789e-8;
    motion.flat_error_deg = 1e-9;
    motion.flat_closed = true;
    return motion;
}

// Everything an examination can find, on two plates; no number is round.
Examination example_examination() {
    Examination found;
    found.undecided_below_deg = 0.0123;
    found.contacts.push_back(
        {0, 1, 12.34567, 98.7654321, 1.23456, 45.6789, 0.123456, 1, {1.23456, -2, 1e-9}, {7, -8.5}});
    found.undecided.push_back({0, 1, 3.00004, 3.00006});
    found.approaches.emplace();
    found.approaches->push_back({0, 1, 100.00049, 110, 0.43219, 105.55551, {4, 5, 6.00049}});
    found.closed.protrusions.push_back({0, 3.141592, {0, 0.6000000001, 0.8}, {0, 3.00044, 4}, {-4, 3.00044}});
    found.closed.protrusions.push_back({1, 5.00004, {0, 0, 1}, {0, 0, 15}, {15, 0}});
    found.closed.max_layers = 7;
    found.closed.order = std::vector<int>{1, 0};
    found.closed.thickness_mm = 1.40000001;
    return found;
}

Compilation example_run() {
    Compilation run;
    CompiledDesign& one = run.designs.emplace_back();
    one.source = {"in/castle.xml", ""};
    one.stem = "castle";
    one.diagnostics = Diagnostics("in/castle.xml");
    one.diagnostics.warning("unreadable-input", {7, 3}, "something was mended")
        .about("bird")
        .changed("(1.00, 2.00) mm", "(1.00, 2.50) mm");
    one.design.emplace();
    one.design->structures.resize(3);
    one.design->structures[1].dropped = true;
    one.assembly = example_assembly();
    one.motion = example_motion();
    run.layout = test::example_layout();
    return run;
}

std::string text_of(const Compilation& run, const OutputOptions& options = {}) {
    Diagnostics diagnostics;
    return write_report(run, options, diagnostics).value();
}

// --- the report

TEST(Report, HasExactlyTheStructureThatIsPromised) {
    const Json report = Json::parse(text_of(example_run()));
    EXPECT_EQ(keys(report), (Keys{"version", "inputs", "layout", "cut"}));
    const Json& input = report["inputs"][0];
    EXPECT_EQ(keys(input),
              (Keys{"file", "elements", "plates", "pieces", "repairs", "diagnostics", "motion"}));
    EXPECT_EQ(keys(input["repairs"][0]), (Keys{"code", "element", "line", "column", "before", "after"}));
    EXPECT_EQ(keys(input["motion"]),
              (Keys{"angles", "max_closure_error_mm", "flat_closed", "flat_error_deg", "collisions",
                    "undecided_below_deg", "decided_up_to_deg", "undecided", "clearance", "protrusion_mm",
                    "protrusions", "max_layers", "layer_order", "closed_thickness_mm"}));
    EXPECT_EQ(keys(report["layout"]),
              (Keys{"sheet_mm", "sheets", "utilisation", "used_mm", "leftover_mm", "placements"}));
    EXPECT_EQ(keys(report["layout"]["placements"][0]),
              (Keys{"piece", "design", "copy", "sheet", "x_mm", "y_mm", "rotation_deg"}));
}

TEST(Report, SaysWhatWasFoundMadeAndLaidOut) {
    const Json report = Json::parse(text_of(example_run()));
    const Json& input = report["inputs"][0];
    EXPECT_EQ(input["file"], "in/castle.xml");
    EXPECT_EQ(input["elements"], 2);
    EXPECT_EQ(input["plates"], 2);
    EXPECT_EQ(input["pieces"], 1);
    EXPECT_EQ(input["repairs"][0]["element"], "bird");
    EXPECT_EQ(input["repairs"][0]["line"], 7);
    EXPECT_EQ(input["repairs"][0]["after"], "(1.00, 2.50) mm");
    EXPECT_EQ(input["diagnostics"].size(), 1U);
    EXPECT_EQ(input["motion"]["angles"], Json::array({0.0, 90.0, 180.0}));
    EXPECT_EQ(input["motion"]["max_closure_error_mm"], 1.2e-8);
    EXPECT_EQ(input["motion"]["flat_closed"], true);
    EXPECT_EQ(input["motion"]["flat_error_deg"], 0.0);
    const Json& layout = report["layout"];
    EXPECT_EQ(layout["sheet_mm"], Json::array({297.0, 210.0}));
    EXPECT_EQ(layout["sheets"], 2);
    EXPECT_EQ(layout["used_mm"][0], Json::array({200.0, 160.0}));
    EXPECT_EQ(layout["placements"][2]["piece"], "house");
    EXPECT_EQ(layout["placements"][2]["design"], "castle");
    EXPECT_EQ(layout["placements"][2]["sheet"], 2);
    EXPECT_EQ(layout["placements"][2]["copy"], 2);
    EXPECT_EQ(layout["placements"][2]["x_mm"], 200.0);
    EXPECT_EQ(layout["placements"][2]["rotation_deg"], 90.0);
}

TEST(Report, SaysWhatTheExaminationFoundWithPlatesByNameAndRounded) {
    Compilation run = example_run();
    run.designs[0].motion->examination = example_examination();
    const Json motion = Json::parse(text_of(run))["inputs"][0]["motion"];
    EXPECT_EQ(motion["collisions"], Json::parse(R"([{
        "plates": ["page/left", "page/right"], "from_deg": 12.346, "to_deg": 98.765, "angle_deg": 98.765,
        "depth_mm": 1.2346, "deepest_deg": 45.679, "excess_mm": 0.1235, "longer": "page/right",
        "at_fold": false,
        "corner_mm": [7.0, -8.5], "point_mm": [1.235, -2.0, 0.0]}])"));
    EXPECT_EQ(motion["undecided"],
              Json::parse(R"([{"plates": ["page/left", "page/right"], "from_deg": 3.0, "to_deg": 3.0}])"));
    EXPECT_EQ(motion["clearance"], Json::parse(R"([{
        "plates": ["page/left", "page/right"], "from_deg": 100.0, "to_deg": 110.0, "least_mm": 0.4322,
        "least_deg": 105.556, "point_mm": [4.0, 5.0, 6.0]}])"));
    EXPECT_EQ(motion["protrusion_mm"], 5.0);
    EXPECT_EQ(motion["protrusions"], Json::parse(R"([
        {"plate": "page/left", "by_mm": 3.1416, "direction": [0.0, 0.6, 0.8], "point_mm": [0.0, 3.0, 4.0],
         "corner_mm": [-4.0, 3.0]},
        {"plate": "page/right", "by_mm": 5.0, "direction": [0.0, 0.0, 1.0], "point_mm": [0.0, 0.0, 15.0],
         "corner_mm": [15.0, 0.0]}])"));
    EXPECT_EQ(motion["max_layers"], 7);
    EXPECT_EQ(motion["layer_order"], Json::array({"page/right", "page/left"}));
    EXPECT_FALSE(motion.contains("layer_cycle"));
    EXPECT_EQ(motion["closed_thickness_mm"], 1.4);
    // Rounded upwards: 0.0122 is not claimed to be decided.
    EXPECT_EQ(motion["undecided_below_deg"], 0.013);
}

TEST(Report, WhatWasExaminedAndNotFoundIsEmptyOrZero) {
    Compilation run = example_run();
    Examination& found = run.designs[0].motion->examination.emplace();
    found.undecided_below_deg = 0.05;
    found.closed.max_layers = 2;
    Json motion = Json::parse(text_of(run))["inputs"][0]["motion"];
    for (const char* key : {"collisions", "undecided", "protrusions"}) {
        EXPECT_EQ(motion[key], Json::array()) << key;
    }
    EXPECT_EQ(motion["undecided_below_deg"], 0.05);
    EXPECT_EQ(motion["protrusion_mm"], 0.0);
    for (const char* key : {"clearance", "layer_order", "closed_thickness_mm"}) {
        EXPECT_TRUE(motion[key].is_null()) << key;
    }
    EXPECT_FALSE(motion.contains("layer_cycle"));
    found.approaches.emplace();
    found.closed.cycle = {1, 0};
    motion = Json::parse(text_of(run))["inputs"][0]["motion"];
    EXPECT_EQ(motion["clearance"], Json::array());
    EXPECT_EQ(motion["layer_cycle"], Json::array({"page/right", "page/left"}));
}

TEST(Report, NamesPlatesThatTheOpeningDoesNotForce) {
    Compilation run = example_run();
    EXPECT_FALSE(Json::parse(text_of(run))["inputs"][0]["motion"].contains("not_forced"));
    run.designs[0].motion->not_forced = {{{1}, 1, 1, true}, {{0, 1}, 12, 3, false}};
    const Json expected = Json::parse(
        R"([{"plates": ["page/right"], "free": 1}, {"plates": ["page/left", "page/right"], "free": 12}])");
    EXPECT_EQ(Json::parse(text_of(run))["inputs"][0]["motion"]["not_forced"], expected);
    const std::string stage = emit_motion(*run.designs[0].assembly, *run.designs[0].motion);
    EXPECT_EQ(Json::parse(stage)["not_forced"], expected);
}

TEST(Report, WhatWasNotExaminedIsNull) {
    const Json motion = Json::parse(text_of(example_run()))["inputs"][0]["motion"];
    for (const char* key :
         {"collisions", "undecided_below_deg", "decided_up_to_deg", "undecided", "clearance", "protrusion_mm",
          "protrusions", "max_layers", "layer_order", "closed_thickness_mm"}) {
        EXPECT_TRUE(motion[key].is_null()) << key;
    }
    EXPECT_FALSE(motion.contains("layer_cycle"));
    Compilation early = example_run();
    early.designs[0].design.reset();
    early.designs[0].assembly.reset();
    early.designs[0].motion.reset();
    early.layout.reset();
    const Json report = Json::parse(text_of(early));
    for (const char* key : {"elements", "plates", "pieces", "motion"}) {
        EXPECT_TRUE(report["inputs"][0][key].is_null()) << key;
    }
    EXPECT_TRUE(report["layout"].is_null());
}

TEST(Report, PlacementsCarryTheirCopyOnlyWhereThereAreCopies) {
    Compilation run = example_run();
    run.layout->placements.pop_back();
    const Json report = Json::parse(text_of(run));
    ASSERT_EQ(report["layout"]["placements"].size(), 2U);
    for (const Json& one : report["layout"]["placements"]) {
        EXPECT_FALSE(one.contains("copy"));
    }
}

TEST(Report, NamesTheFilesOfTheRunAndWhatConcernsItAsAWhole) {
    Compilation run = example_run();
    run.run_diagnostics.warning("unwritable-output", {}, "of the run");
    OutputOptions options;
    options.files = {"card.svg", "card-2.svg"};
    const Json report = Json::parse(text_of(run, options));
    EXPECT_EQ(report["outputs"], Json::array({"card.svg", "card-2.svg"}));
    EXPECT_EQ(report["diagnostics"][0]["message"], "of the run");
}

TEST(Report, IsUtf8WithTwoSpacesAndAFinalLineBreak) {
    Compilation run = example_run();
    run.designs[0].source.name = "caf\xc3\xa9-\xff.xml";
    const std::string text = text_of(run);
    EXPECT_TRUE(text.starts_with("{\n  \"version\": \""));
    EXPECT_TRUE(text.ends_with("}\n"));
    EXPECT_NE(text.find("caf\xc3\xa9-\xef\xbf\xbd.xml"), std::string::npos);
    EXPECT_EQ(text, text_of(run));
}

TEST(JsonText, PutsListsOfNumbersOnOneLineAndIsTheSameValue) {
    const Json value = Json::parse(
        R"({"a": [1.5, 2, null], "b": [], "c": {}, "d": [[1], {"x": "\"\n"}], "e": true, "f": [[[]]]})");
    const std::string text = json_text(value);
    EXPECT_EQ(Json::parse(text), value);
    EXPECT_NE(text.find("\n  \"a\": [1.5, 2, null],\n"), std::string::npos);
    EXPECT_NE(text.find("\n  \"b\": [],\n"), std::string::npos);
    EXPECT_NE(text.find("\n    [1],\n"), std::string::npos);
}

// --- the stages

TEST(Emit, AssemblyNamesPlatesAndPieces) {
    const Json value = Json::parse(emit_assembly(example_assembly()));
    EXPECT_EQ(keys(value), (Keys{"assembly", "file", "stem", "pieces", "plates", "lines", "hinges", "glue",
                                 "joints", "sweep", "covers"}));
    EXPECT_EQ(value["pieces"][0]["plates"], Json::array({"page/left", "page/right"}));
    EXPECT_EQ(value["plates"][0]["piece"], "page");
    EXPECT_EQ(value["plates"][0]["fill"], "#0102ff");
    EXPECT_TRUE(value["plates"][1]["fill"].is_null());
    EXPECT_TRUE(value["plates"][1]["parent"].is_null());
    EXPECT_EQ(value["plates"][1]["prints"][0]["points"], Json::array({{1.0, 1.0}, {2.0, 2.0}}));
    EXPECT_EQ(value["lines"][0]["kind"], "valley");
    EXPECT_EQ(value["lines"][0]["other_plate"], "page/right");
    EXPECT_EQ(value["hinges"][0]["b"], "page/right");
    EXPECT_EQ(value["joints"][0]["kind"], "drive");
    EXPECT_EQ(value["joints"][0]["plate"], "page/left");
    EXPECT_EQ(value["joints"][0]["turns"], -1);
    EXPECT_EQ(value["covers"], Json::array({"page/left", "page/right"}));
    EXPECT_EQ(value["sweep"]["to_deg"], 180.0);
}

TEST(Emit, AJointsMeasuresCarryTheirUnit) {
    Assembly assembly = example_assembly();
    FourBar bars;
    bars.closing = Closing::inside;
    bars.left = {0, 1, {}, {0, 1}, {1, 0}, {}, {}, {}, {}, {}, std::acos(-1.0) / 3, 0.5};
    bars.right = bars.left;
    FourBar parallel = bars;
    parallel.parallel = true;
    assembly.joints = {{"one", {}, bars}, {"two", {}, parallel}};
    const Json joints = Json::parse(emit_assembly(assembly))["joints"];
    EXPECT_EQ(joints[0]["kind"], "four-bar");
    EXPECT_EQ(joints[0]["closing"], "inside");
    EXPECT_EQ(joints[0]["left"]["near_deg"], 60.0);
    EXPECT_FALSE(joints[0]["left"].contains("near_mm"));
    EXPECT_EQ(joints[1]["right"]["far_mm"], 0.5);
    EXPECT_EQ(joints[1]["right"]["drive"], "page/left");
}

TEST(Emit, MotionGivesFramesAndOutlinesInTheWorldThatAgree) {
    const Assembly assembly = example_assembly();
    const Json value = Json::parse(emit_motion(assembly, example_motion()));
    EXPECT_EQ(keys(value), (Keys{"stem", "solver", "max_closure_error_mm", "flat_closed", "flat_error_deg",
                                 "examination", "frames"}));
    EXPECT_TRUE(value["examination"].is_null());
    ASSERT_EQ(value["frames"].size(), 3U);
    for (const Json& frame : value["frames"]) {
        EXPECT_EQ(keys(frame), (Keys{"angle_deg", "closure_error_mm", "plates"}));
        EXPECT_EQ(frame["closure_error_mm"], 0.0);
        ASSERT_EQ(frame["plates"].size(), 2U);
        for (std::size_t i = 0; i < 2; ++i) {
            const Json& plate = frame["plates"][i];
            EXPECT_EQ(plate["name"], assembly.plates[i].name);
            const Ring& outline = assembly.plates[i].outline.outer;
            ASSERT_EQ(plate["outline"].size(), outline.size());
            for (std::size_t k = 0; k < outline.size(); ++k) {
                for (std::size_t c = 0; c < 3; ++c) {
                    const double expected = plate["frame"]["origin"][c].get<double>() +
                                            outline[k].x * plate["frame"]["axes"][0][c].get<double>() +
                                            outline[k].y * plate["frame"]["axes"][1][c].get<double>();
                    EXPECT_NEAR(plate["outline"][k][c].get<double>(), expected, 2e-6);
                }
            }
        }
    }
    // Half open, the far edges stand at 45° on either side of the upright.
    const Json& half = value["frames"][1]["plates"];
    const double reach = 10 * std::sqrt(0.5);
    EXPECT_NEAR(half[0]["outline"][0][0].get<double>(), -reach, 1e-6);
    EXPECT_NEAR(half[0]["outline"][0][2].get<double>(), reach, 1e-6);
    EXPECT_NEAR(half[1]["outline"][1][0].get<double>(), reach, 1e-6);
    EXPECT_NEAR(half[1]["outline"][1][2].get<double>(), reach, 1e-6);
}

TEST(Emit, TheExaminationOfAMotionIsThatOfTheReport) {
    Compilation run = example_run();
    run.designs[0].motion->examination = example_examination();
    Json reported = Json::parse(text_of(run))["inputs"][0]["motion"];
    for (const char* key : {"angles", "max_closure_error_mm", "flat_closed", "flat_error_deg"})
        reported.erase(key);
    const std::string text = emit_motion(*run.designs[0].assembly, *run.designs[0].motion);
    const Json value = Json::parse(text);
    EXPECT_EQ(value["examination"], reported);
    EXPECT_EQ(keys(value["examination"]), keys(reported));
    EXPECT_NE(text.find("\n  \"examination\": {\n    \"collisions\": [\n      {\n"), std::string::npos);
    EXPECT_NE(text.find("\n    \"closed_thickness_mm\": 1.4\n  },\n  \"frames\": ["), std::string::npos);
}

TEST(Emit, PatternAndLayoutHoldEveryLine) {
    const Json pattern = Json::parse(emit_pattern(test::example_pattern()));
    const Json& page = pattern["pieces"][0];
    EXPECT_EQ(keys(page), (Keys{"name", "bounds", "cuts", "lines", "fills", "strokes", "targets", "labels",
                                "silhouette"}));
    EXPECT_EQ(page["cuts"].size(), 3U);
    EXPECT_EQ(page["cuts"][2]["closed"], true);
    EXPECT_EQ(page["lines"].size(), 5U);
    EXPECT_EQ(page["lines"][2]["kind"], "mountain");
    EXPECT_EQ(page["lines"][2]["plate"], "page/right");
    EXPECT_EQ(page["fills"][1]["area"]["holes"].size(), 1U);
    EXPECT_EQ(page["labels"][1]["kind"], "target");
    EXPECT_EQ(page["labels"][1]["angle_deg"], -90.0);
    EXPECT_EQ(page["bounds"], Json::array({{-100.0, -80.0}, {100.0, 80.0}}));
    EXPECT_TRUE(pattern["pieces"][1]["fills"][1]["plate"].is_null());

    const Json layout = Json::parse(emit_layout(test::example_layout()));
    EXPECT_EQ(layout["placements"].size(), 3U);
    EXPECT_EQ(layout["placements"][1]["offset"], Json::array({60.25, 40.125}));
    EXPECT_EQ(layout["placements"][2]["copy"], 2);
    EXPECT_EQ(layout["designs"][0]["pattern"], pattern);
}

TEST(Emit, DesignHoldsPointsPagesAndPlaces) {
    Design design;
    design.file = "a.xml";
    design.stem = "a";
    design.right = Color{0, 16, 0};
    Structure& beak = design.structures.emplace_back();
    beak.type = "beak";
    beak.id = "bird";
    beak.place = {3, 5};
    beak.points.resize(2);
    beak.points[1].at = {1.0 / 3.0, -1e-12};
    beak.points[1].page = 2;
    beak.fold.end.at = {0, 10};
    design.lines.emplace_back().points.resize(2);
    const Json value = Json::parse(emit_design(design));
    EXPECT_EQ(value["unit"], "in");
    EXPECT_EQ(value["right"], "#001000");
    EXPECT_TRUE(value["left"].is_null());
    const Json& one = value["structures"][0];
    EXPECT_EQ(one["id"], "bird");
    EXPECT_EQ(one["place"], Json::array({3, 5}));
    EXPECT_EQ(one["points"][1]["at"].dump(), "[0.333333,0.0]");
    EXPECT_EQ(one["points"][1]["page"], 2);
    EXPECT_TRUE(one["points"][0]["page"].is_null());
    EXPECT_EQ(one["fold"]["end"]["at"], Json::array({0.0, 10.0}));
    EXPECT_EQ(value["lines"][0]["points"].size(), 2U);
}

}  // namespace
}  // namespace popup
