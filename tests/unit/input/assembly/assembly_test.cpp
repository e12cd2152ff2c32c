// Assemblies as an input: what is read of the text of one is that one, and what breaks a promise is refused
// where it stands.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <ostream>
#include <string>
#include <vector>

#include "assembly/settle.h"
#include "input/assembly/guarantees.h"
#include "input/assembly/read.h"
#include "output/emit.h"
#include "parts/flat_parts.h"
#include "popup/compile.h"
#include "popup/image.h"
#include "popup/write.h"
#include "support/designs.h"
#include "support/pictures.h"
#include "support/run_program.h"

namespace popup {
namespace {

using Json = nlohmann::ordered_json;

struct Read {
    std::optional<Assembly> assembly;
    std::vector<Diagnostic> findings;
    [[nodiscard]] std::string told() const {
        std::string all;
        for (const Diagnostic& d : findings) all += d.code + ": " + d.message + "\n";
        return all;
    }
};

Read read(const std::string& text, bool strict = false) {
    Diagnostics diagnostics("card.assembly.json");
    ReadOptions options;
    options.strict = strict;
    Reading reading = read_source_text(Source{"card.assembly.json", text}, options, diagnostics);
    return {std::move(reading.assembly), diagnostics.sorted()};
}

Assembly tent_card() {
    Design design = test::card(100, 80);
    test::add(design, "tent",
              {{-18, -15}, {-18, 15}, {18, -15}, {18, 15}, {-30, -15}, {-30, 15}, {30, -15}, {30, 15}})
        .id = "tent";
    Assembly assembly = *test::build(design).assembly;
    assembly.file = "card.xml";
    assembly.stem = "card";
    return assembly;
}

// --- there and back

void expect_same_after_reading(const Assembly& assembly) {
    const std::string text = emit_assembly(assembly);
    const Read back = read(text);
    ASSERT_TRUE(back.assembly) << back.told();
    EXPECT_EQ(back.told(), "");
    EXPECT_EQ(emit_assembly(*back.assembly), text);
}

TEST(AssemblyReading, GeneratedCardsComeBackAndHoldWhatIsPromised) {
    for (std::uint64_t seed = 1; seed <= 30; ++seed) {
        const test::Built built =
            test::build(seed % 2 == 0 ? test::generate(seed, 8) : test::generate_any(seed, 8));
        const std::vector<AssemblyFault> faults = faults_of(*built.assembly);
        EXPECT_TRUE(faults.empty()) << "seed " << seed << ": " << faults.front().what;
        expect_same_after_reading(*built.assembly);
    }
}

// Everything that no element makes yet.
TEST(AssemblyReading, PrintsPicturesTracesAndCurvesComeBack) {
    Assembly card = tent_card();
    auto opened = open_image(test::png_of(40, 20, false));
    Image image = std::get<Image>(opened);
    image.place = {{0.123456789, 0.01}, {0.01, -0.2}, {-20.5, 10.25}};
    card.plates[2].prints = {Area{{{{-20, -5}, {-10, -5}, {-10, 5}}, {}}, Color{1, 2, 3}},
                             Stroke{{{-20, 0}, {-10, 1}}, 0.35, Color{4, 5, 6}},
                             Text{"f\xC3\xBCr \"dich\"", {-15, 3}, 4.5, 0.3}, image};
    image.clip = {{{{-18, 0}, {-10, 0}, {-10, 8}}, {}}};
    card.pieces[1].prints = {image};
    settle_numbers(card);
    expect_same_after_reading(card);
    const Read back = read(emit_assembly(card));
    ASSERT_TRUE(back.assembly);
    const auto& pictured = std::get<Image>(back.assembly->pieces[1].prints.front());
    EXPECT_EQ(*pictured.bytes, *image.bytes);
    EXPECT_EQ(pictured.width, 40);
    EXPECT_EQ(pictured.bytes, std::get<Image>(back.assembly->plates[2].prints.back()).bytes)
        << "the file is held once";

    FlatParts parts;
    FlatPart& part = parts.parts.emplace_back();
    part.name = "gear";
    part.place = {3, 4};
    part.paper = {{{{0, 0}, {20, 0}, {20, 20}, {0, 20}}, {{{5, 5}, {5, 10}, {10, 10}}}}};
    part.slits = {{{12, 12}, {15, 15}, {16, 12}}};
    part.lines = {{LineKind::valley, {{0, 0}, {4, 4}}, 1.25}};
    Frame frame;
    frame.axes = {Vec3{0.6, 0.8, 0}, Vec3{-0.8, 0.6, 0}, Vec3{0, 0, 1}};
    frame.origin = {1, 2, 3};
    part.faces = {{{{{0, 0}, {20, 0}, {20, 20}, {0, 20}}, {}}, frame}};
    part.traces = {{{0, 0, 0}, {1, 2, 3}}};
    parts.traces = {{"line", -1, {{{0, 0, 1}, {0, 1, 1}}}}};
    const Cubic cubic{{0, 0}, {5, 1}, {15, 1}, {20, 0}};
    parts.curves = CurveTable({FlatCurve{cubic, {{{0, 0}, 0.0}, {cubic.at(0.3), 0.3}, {{20, 0}, 1.0}}}});
    Assembly flat = assembly_of(std::move(parts));
    settle_numbers(flat);
    expect_same_after_reading(flat);
    EXPECT_EQ(read(emit_assembly(flat)).assembly->curves.size(), 1U);
}

std::vector<PendingFile> files_of(const Source& source, const std::vector<std::string>& outputs) {
    Diagnostics told;
    const auto plan = plan_outputs({.outputs = outputs, .inputs = {source.name}}, told);
    EXPECT_TRUE(plan) << test::findings(told);
    CompileOptions options;
    options.output.dpi = 40;
    fit_layout(options);
    Compilation run = compile({source}, options, {});
    EXPECT_FALSE(run.has_errors()) << source.name << test::findings(run.designs.front().diagnostics);
    return make_files(*plan, options.output, run).value_or(std::vector<PendingFile>{});
}

std::string assembly_text(const Source& source) {
    CompileOptions options;
    options.until = Stage::assembly;
    const Compilation run = compile({source}, options, {});
    EXPECT_TRUE(run.designs.front().assembly);
    return emit_assembly(run.designs.front().assembly.value_or(Assembly{}));
}

TEST(AssemblyReading, EveryOutputOfASampleHasTheSameBytes) {
    const std::vector<std::string> sheets{"x.svg", "x.pdf", "x.dxf", "x.lbrn2", "x.plt", "x.png", "x.jpg"};
    std::vector<std::string> with_model = sheets;
    with_model.insert(with_model.end(), {"x.glb", "x.gltf", "x.html"});
    std::vector<std::string> all = with_model;
    all.emplace_back("x.fold");
    // Its folds go in an order; that they do is a finding, which pages have, of the first alone.
    const std::vector<std::string> models{"x.svg", "x.glb", "x.gltf"};
    for (const auto& [sample, outputs] :
         {std::pair("tree.xml", all), std::pair("parts.svg", sheets),
          std::pair("flatlang/box.fl", with_model), std::pair("cartons/straight-tuck-end.fl", models)}) {
        const std::string name = std::string(sample).substr(std::string(sample).rfind('/') + 1);
        const Source source{name, test::read_file(std::string(POPUP_SOURCE_DIR) + "/samples/" + sample)};
        const Source again{source.stem() + ".assembly.json", assembly_text(source)};
        EXPECT_EQ(again.stem(), source.stem());
        EXPECT_EQ(assembly_text(again), again.text) << sample;
        const std::vector<PendingFile> first = files_of(source, outputs);
        const std::vector<PendingFile> second = files_of(again, outputs);
        ASSERT_GE(first.size(), outputs.size()) << sample;
        ASSERT_EQ(first.size(), second.size()) << sample;
        for (std::size_t i = 0; i < first.size(); ++i) {
            EXPECT_EQ(first[i].path, second[i].path);
            EXPECT_TRUE(first[i].bytes == second[i].bytes) << sample << " " << first[i].path;
        }
    }
}

TEST(AssemblyReading, PlacesOfLaterFindingsAreSaidInWords) {
    Json whole = Json::parse(emit_assembly(tent_card()));
    // The seam is a hundredth of a millimetre off.
    for (Json& hinge : whole["hinges"]) {
        if (hinge["glued"] == true && hinge["a"] == "page/left")
            for (Json& end : hinge["a_line"]) end[0] = end[0].get<double>() + 0.01;
    }
    whole["joints"][2]["place"] = {7, 9};
    const Source source{"card.assembly.json", whole.dump(2)};
    const Compilation run = compile({source}, {}, {});
    ASSERT_TRUE(run.has_errors());
    const Diagnostic first = run.designs.front().diagnostics.sorted().front();
    EXPECT_EQ(first.code, "seam-open") << first.message;
    EXPECT_EQ(first.file, "card.assembly.json");
    EXPECT_EQ(first.place, Place{});
    ASSERT_FALSE(first.hints.empty());
    EXPECT_EQ(first.hints.front(), "its source is at card.xml:7:9");
}

// --- what is refused

struct Mistake {
    std::string pointer;  // JSON pointer
    std::string value;    // what is put there; empty: it is taken out
    std::string code;
    std::string said;  // part of the message
};

void PrintTo(const Mistake& mistake, std::ostream* out) { *out << mistake.pointer << " " << mistake.value; }

class AssemblyMistakes : public testing::TestWithParam<Mistake> {};

TEST_P(AssemblyMistakes, IsRefusedWhereItStands) {
    const Mistake& mistake = GetParam();
    Json whole = Json::parse(emit_assembly(tent_card()));
    const Json::json_pointer at(mistake.pointer);
    if (mistake.value.empty()) {
        Json& around = whole.at(at.parent_pointer());
        if (around.is_array()) {
            around.erase(std::stoul(at.back()));
        } else {
            around.erase(at.back());
        }
    } else {
        whole[at] = Json::parse(mistake.value);
    }
    const Read result = read(whole.dump(1));
    EXPECT_FALSE(result.assembly);
    ASSERT_FALSE(result.findings.empty());
    const auto told = std::find_if(result.findings.begin(), result.findings.end(), [&](const Diagnostic& d) {
        return d.code == mistake.code && d.message.find(mistake.said) != std::string::npos;
    });
    ASSERT_NE(told, result.findings.end()) << result.told();
    EXPECT_GE(told->place.line, 1);
    EXPECT_GE(told->place.column, 1);
}

INSTANTIATE_TEST_SUITE_P(
    All, AssemblyMistakes,
    testing::Values(
        Mistake{"/assembly", "2", "assembly-value", "the version of the format"},
        Mistake{"/plates", "", "assembly-value", "\"plates\" is missing"},
        Mistake{
            "/plates/-",
            R"({"name":"page/right","piece":"page","outline":{"outer":[[0,0],[1,0],[0,1]],"holes":[]},"fill":null})",
            "assembly-fault", "two plates \"page/right\""},
        Mistake{"/plates/0/name", "\"a\\u0007b\"", "assembly-value", "control characters"},
        Mistake{"/plates/0/piece", "\"tent\"", "assembly-fault", "not its own"},
        Mistake{"/plates/0/outline/outer/0", "[1, 2, 3]", "assembly-value", "\"outer\": a ring"},
        Mistake{"/plates/0/outline/outer/0/0", "2e6", "assembly-fault", "an outline reaches further out"},
        Mistake{"/plates/0/outline/outer", "[[0,0],[0,9],[9,9]]", "assembly-fault",
                "an outline does not run counter-clockwise"},
        Mistake{"/plates/0/outline/outer", "[[0,0],[12,0],[0,9],[9,9]]", "assembly-fault",
                "the areas cross or overlap"},
        Mistake{"/plates/0/outline/holes", "[[[-200,0],[-200,9],[-190,9]]]", "assembly-fault",
                "the areas cross or overlap"},
        Mistake{"/plates/3/outline/outer", "[[20,-15],[20,15],[-20,15],[-20,-15]]", "assembly-fault",
                "has wrong plates: the areas cross or overlap"},
        Mistake{"/plates/0/fill", "\"red\"", "assembly-value", "a colour"},
        Mistake{"/plates/0/stands", R"({"axes":[[1,0,0],[0,1,0],[0,0,-1]],"origin":[0,0,0]})",
                "assembly-fault", "three unit vectors"},
        Mistake{"/plates/0/stands", R"({"axes":[[1,0,0],[0,1,0],[0,0,1]],"origin":[0,0,0]})",
                "assembly-fault", "a joint moves it"},
        Mistake{"/pieces/0/plates/0", "\"left\"", "assembly-name", "no plate \"left\""},
        Mistake{"/pieces/0/plates", "[\"page/left\"]", "assembly-fault", "not among the plates of its piece"},
        Mistake{"/lines/0/kind", "\"score\"", "assembly-value", "one of: cut, mountain"},
        Mistake{"/hinges/0/b", "\"page/left\"", "assembly-fault", "joins a plate to itself"},
        Mistake{"/hinges/0/a_line", "[[0,-40],[0,41]]", "assembly-fault", "mm long on the one"},
        Mistake{"/hinges/0/a_line", "[[1,-40],[1,40]]", "assembly-fault", "not the same line"},
        Mistake{"/hinges/0/glued", "1", "assembly-value", "true or false"},
        Mistake{"/glue", "[]", "assembly-fault", "has no glue"},
        Mistake{"/joints/0/turns", "2", "assembly-value", "-1 or 1"},
        Mistake{"/joints/0/axis_dir", "[0, 2]", "assembly-fault", "no unit vector"},
        Mistake{"/joints/0/kind", "\"slider\"", "assembly-value", "one of: drive, four-bar, rigid"},
        Mistake{"/joints/0", "", "assembly-fault", "no joint before it places"},
        Mistake{"/joints/2", "", "assembly-fault", "no joint places plate \"tent"},
        Mistake{"/joints/2/left/far_mm", "31", "assembly-fault", "does not fold flat"},
        Mistake{"/joints/2/left/near_mm", "17", "assembly-fault", "from the fold"},
        Mistake{"/joints/2/left/near_mm", "-18", "assembly-fault", "not more than 0"},
        Mistake{"/joints/2/left/fold_out", "[0, 1]", "assembly-fault", "not square"},
        Mistake{"/joints/2/right/plate", "\"tent/left\"", "assembly-fault", "are one plate"},
        Mistake{"/sweep/to_deg", "0", "assembly-fault", "the sweep goes from 0"},
        Mistake{"/covers/1", "\"page/left\"", "assembly-fault", "covers twice"}));

TEST(AssemblyReading, WhatHasNoMeaningIsTold) {
    Json whole = Json::parse(emit_assembly(tent_card()));
    whole["plates"][1]["colour"] = "#ffffff";
    const Read lenient = read(whole.dump(1));
    EXPECT_TRUE(lenient.assembly);
    ASSERT_EQ(lenient.findings.size(), 1U) << lenient.told();
    EXPECT_EQ(lenient.findings.front().code, "unknown-member");
    EXPECT_NE(lenient.findings.front().message.find("\"colour\""), std::string::npos);
    EXPECT_FALSE(read(whole.dump(1), true).assembly);
}

TEST(AssemblyReading, TextsThatAreNoJsonAreRefusedWhereTheyEnd) {
    const auto place = [](const std::string& text) {
        const Read result = read(text);
        EXPECT_FALSE(result.assembly);
        EXPECT_EQ(result.findings.front().code, "assembly-syntax") << result.told();
        return result.findings.front().place;
    };
    EXPECT_EQ(place("{\"assembly\": 1,\n  \"file\" \"a\"}"), (Place{2, 12}));
    EXPECT_EQ(place("{\"assembly\": 1, \"stem\": \"a\",\n \"stem\": \"b\"}"), (Place{2, 2}));
    EXPECT_EQ(place("{\"assembly\": 1,\n\n"), (Place{3, 1}));
    EXPECT_EQ(place(std::string(100, '[')), (Place{1, 33}));
    const Read list = read("[" + emit_assembly(tent_card()) + "]");
    EXPECT_NE(list.told().find("a list of 1; a file holds one assembly"), std::string::npos) << list.told();
}

// Where a value stands is what the library does not say: it is counted.
TEST(AssemblyReading, ValuesStandWhereTheyBegin) {
    const std::string text =
        "{\"assembly\": 1, \"file\": 7,\n \"stem\":\t\"a\", \"pieces\" :\n[ {\"name\": true}, "
        "\n\"\xC3\xA4\", 5 ]}";
    const Read result = read(text);
    const auto at = [&](const std::string& said) {
        const auto found =
            std::find_if(result.findings.begin(), result.findings.end(),
                         [&](const Diagnostic& d) { return d.message.find(said) != std::string::npos; });
        EXPECT_NE(found, result.findings.end()) << said << "\n" << result.told();
        return found == result.findings.end() ? Place{} : found->place;
    };
    EXPECT_EQ(at("\"file\" must be a text"), (Place{1, 25}));
    EXPECT_EQ(at("\"name\" must be a text"), (Place{3, 12}));
    EXPECT_EQ(at("a list of objects"), (Place{4, 1}));
    EXPECT_EQ(at("\"lines\" is missing"), (Place{1, 1}));
}

TEST(AssemblyReading, IsKnownByItsSuffixAndItsFirstMember) {
    EXPECT_EQ(find_language(Source{"a/card.assembly.json", ""}, "")->name, "assembly");
    EXPECT_EQ(find_language(Source{"card.json", ""}, ""), nullptr);
    EXPECT_EQ(find_language(Source{"-", " {\n \"assembly\": 1"}, "")->name, "assembly");
    EXPECT_NE(find_language(Source{"-", "{\"plates\": []}"}, "")->name, "assembly");
    EXPECT_EQ((Source{"a/.assembly.json", ""}.stem()), ".assembly");
}

}  // namespace
}  // namespace popup
