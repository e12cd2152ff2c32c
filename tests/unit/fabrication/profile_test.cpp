// Machine profiles: what their rows promise, what a user's own file may say, and what becomes of folds.
#include "popup/profile.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "fabrication/perforate.h"
#include "output/svg.h"
#include "support/run_program.h"
#include "support/sheet_example.h"

namespace popup {
namespace {

using Json = nlohmann::json;

struct Reading {
    std::optional<Profile> profile;
    std::vector<Diagnostic> findings;
};

Reading read(const std::string& text) {
    Diagnostics diagnostics("mine.toml");
    Reading reading{read_profile({"mine.toml", text}, diagnostics), {}};
    reading.findings = diagnostics.sorted();
    return reading;
}

std::size_t count(const std::string& text, const std::string& what) {
    std::size_t n = 0;
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++n;
    return n;
}

std::vector<std::string> svg_of(const Profile& profile) {
    OutputOptions options;
    options.profile = profile;
    Diagnostics diagnostics;
    return test::bytes_of(write_svg(test::example_layout(), options, diagnostics));
}

// --- the table

TEST(Profiles, HaveNamesOfTheirOwnAndTheFirstIsWorkshop) {
    EXPECT_EQ(profile_table().front().name, "workshop");
    std::set<std::string> names;
    for (const Profile& row : profile_table()) {
        EXPECT_TRUE(names.insert(row.name).second) << row.name;
        EXPECT_EQ(find_profile(row.name), &row);
        EXPECT_FALSE(row.about.empty());
    }
    EXPECT_EQ(find_profile("Workshop"), nullptr);
}

TEST(Profiles, AlwaysDrawCutsAndFolds) {
    for (const Profile& row : profile_table()) {
        EXPECT_TRUE(row.draws(Operation::inner_cut)) << row.name;
        EXPECT_TRUE(row.draws(Operation::outer_cut)) << row.name;
        for (const FoldStyle style :
             {FoldStyle::dashed, FoldStyle::score, FoldStyle::perforated, FoldStyle::both}) {
            Profile changed = row;
            changed.folds = style;
            EXPECT_TRUE(changed.draws(Operation::valley) || changed.draws(Operation::perforation))
                << row.name << " " << to_string(style);
        }
    }
}

// A laser takes what it is given: a colour that stands for a cut must not stand for a score too.
TEST(Profiles, CutsAndScoresHaveColoursOfTheirOwn) {
    for (const Profile& row : profile_table()) {
        for (const Operation fold : {Operation::valley, Operation::mountain, Operation::seam}) {
            for (const Operation cut : {Operation::inner_cut, Operation::outer_cut, Operation::perforation}) {
                if (row.folds == FoldStyle::dashed) continue;
                EXPECT_NE(row.pen(fold).color, row.pen(cut).color) << row.name;
            }
        }
    }
}

// LightBurn is sure of these palette values only; K40 Whisperer rasters any colour but red and blue.
TEST(Profiles, UseTheColoursThatTheirProgramsKnow) {
    const auto colors = [](std::string_view name) {
        std::set<std::string> used;
        const Profile& profile = *find_profile(name);
        for (const Operation operation : kOperations) {
            if (!profile.pen(operation).layer.empty()) used.insert(to_string(profile.pen(operation).color));
        }
        return used;
    };
    EXPECT_EQ(colors("k40"), (std::set<std::string>{"#ff0000", "#0000ff"}));
    EXPECT_EQ(colors("generic-laser"), (std::set<std::string>{"#ff0000", "#0000ff", "#00ff00"}));
    const std::set<std::string> palette{"#000000", "#0000ff", "#ff0000", "#00e000", "#d0d000",
                                        "#ff8000", "#00e0e0", "#ff00ff", "#b4b4b4"};
    for (const std::string& color : colors("lightburn")) EXPECT_TRUE(palette.contains(color)) << color;
    for (const Pen& pen : find_profile("generic-laser")->pens) {
        if (!pen.layer.empty()) {
            EXPECT_LE(pen.width_mm, 0.0254);
        }
    }
}

// --- perforations

// Along an arc of many chords cuts are as long as on a line of its length, and as far apart.
TEST(Profile, PerforationsOfCurvedFoldsDoNotShowTheirChords) {
    std::vector<Vec2> chain;
    constexpr int kChords = 83;
    for (int i = 0; i <= kChords; ++i)
        chain.push_back({30.0 * std::cos(0.02 * i), 30.0 * std::sin(0.02 * i)});
    double whole = 0.0;
    for (std::size_t i = 1; i < chain.size(); ++i) whole += distance(chain[i - 1], chain[i]);
    const Perforation perforation{2.0, 1.0, 1.0};
    const auto cuts = perforated_along(chain, perforation);
    const std::vector<Segment> straight = perforated({{0, 0}, {whole, 0}}, perforation);
    ASSERT_EQ(cuts.size(), straight.size());
    // How far along the arc, by the angle: chords are 0.6 mm.
    const auto along = [](Vec2 p) { return 30.0 * std::atan2(p.y, p.x); };
    for (std::size_t i = 0; i < cuts.size(); ++i) {
        EXPECT_NEAR(along(cuts[i].front()), straight[i].a.x, 0.01);
        EXPECT_NEAR(along(cuts[i].back()), straight[i].b.x, 0.01);
        double length = 0.0;
        for (std::size_t k = 1; k < cuts[i].size(); ++k) {
            length += distance(cuts[i][k - 1], cuts[i][k]);
            EXPECT_NEAR(popup::length(cuts[i][k]), 30.0, 0.01);
        }
        EXPECT_NEAR(length, straight[i].b.x - straight[i].a.x, 1e-9);
    }
}

TEST(Perforations, BeginAndEndWithACutClearOfTheCorners) {
    for (double length = 0.05; length < 60.0; length += 0.37) {
        for (const Perforation& perforation :
             {Perforation{}, Perforation{0.5, 0.5, 0.0}, Perforation{3.0, 0.4, 2.5},
              Perforation{0.5, 50.0, 0.0}, Perforation{10.0, 1.0, 0.0}, Perforation{2.0, 1.0, 50.0}}) {
            const Segment line{{1.0, 2.0}, {1.0 + 0.6 * length, 2.0 + 0.8 * length}};
            const std::vector<Segment> cuts = perforated(line, perforation);
            ASSERT_FALSE(cuts.empty());
            const auto along = [&](Vec2 p) { return 0.6 * (p.x - 1.0) + 0.8 * (p.y - 2.0); };
            double before = 0.0;
            const bool fits = cuts.size() > 1;
            for (std::size_t i = 0; i < cuts.size(); ++i) {
                EXPECT_NEAR(0.8 * (cuts[i].a.x - 1.0), 0.6 * (cuts[i].a.y - 2.0), 1e-9);
                const double from = along(cuts[i].a);
                const double to = along(cuts[i].b);
                EXPECT_LT(from, to);
                EXPECT_GT(from, before - 1e-9);
                if (fits) {
                    EXPECT_GE(from, perforation.clear_mm - 1e-9);
                    EXPECT_LE(to, length - perforation.clear_mm + 1e-9);
                    EXPECT_GT(to - from, 0.499 * perforation.cut_mm);
                    EXPECT_LT(to - from, 1.501 * perforation.cut_mm);
                    if (i > 0) {
                        EXPECT_GT(from - before, 0.499 * perforation.gap_mm);
                    }
                }
                before = to;
            }
            if (fits) {
                EXPECT_NEAR(along(cuts.front().a), perforation.clear_mm, 1e-9);
                EXPECT_NEAR(along(cuts.back().b), length - perforation.clear_mm, 1e-9);
            } else {
                const double cut = along(cuts[0].b) - along(cuts[0].a);
                EXPECT_NEAR(cut, std::min(perforation.cut_mm, length / 3.0), 1e-9);
                EXPECT_NEAR(along(cuts[0].a) + along(cuts[0].b), length, 1e-9);
                EXPECT_LT(length - 2.0 * perforation.clear_mm, 2.0 * perforation.cut_mm + perforation.gap_mm);
            }
        }
    }
}

// Several importers take a dash pattern as a whole line, so what a machine follows has none.
TEST(FoldStyles, OnlyDashedOnesHaveADashPattern) {
    for (const Profile& row : profile_table()) {
        for (const FoldStyle style :
             {FoldStyle::dashed, FoldStyle::score, FoldStyle::perforated, FoldStyle::both}) {
            Profile profile = row;
            profile.folds = style;
            for (const std::string& sheet : svg_of(profile))
                EXPECT_EQ(sheet.find("stroke-dasharray") != std::string::npos, style == FoldStyle::dashed);
        }
    }
}

// The house has one mountain fold of 75 mm and one seam of 40 mm: 25 and 13 cuts of 2 mm, 1 mm apart.
TEST(FoldStyles, PerforatedFoldsAreSegmentsOfOnePath) {
    Profile profile = *find_profile("cricut");
    Layout layout = test::example_layout();
    layout.placements.erase(layout.placements.begin());
    for (Placement& placement : layout.placements) placement.sheet = 0;
    layout.placements.pop_back();
    OutputOptions options;
    options.profile = profile;
    Diagnostics diagnostics;
    const std::string sheet = test::bytes_of(write_svg(layout, options, diagnostics)).front();
    const std::size_t begin = sheet.find("inkscape:label=\"perforation\"");
    ASSERT_NE(begin, std::string::npos);
    const std::string layer = sheet.substr(begin, sheet.find("\n </g>", begin) - begin);
    EXPECT_EQ(count(layer, "<path"), 2U);
    const std::size_t second = layer.rfind("<path");
    EXPECT_EQ(count(layer, "M"), 25U + 13U);
    const std::size_t first = count(layer.substr(0, second), "M");
    EXPECT_TRUE(first == 25U || first == 13U) << first;
}

// Where a piece is glued on, the paper stays whole.
TEST(FoldStyles, SeamsOnTheBaseAreNotFolded) {
    Layout layout = test::example_layout();
    PatternLine& seam = layout.designs[0].pattern.pieces[1].lines[1];
    ASSERT_EQ(seam.kind, LineKind::seam);
    const auto paths = [&](const char* name, FoldStyle style) {
        OutputOptions options;
        options.profile = *find_profile(name);
        options.profile.folds = style;
        Diagnostics diagnostics;
        return count(test::bytes_of(write_svg(layout, options, diagnostics))[1], "<path");
    };
    for (const FoldStyle style : {FoldStyle::score, FoldStyle::perforated, FoldStyle::both}) {
        seam.glued_on = false;
        const std::size_t laser = paths("k40", style);
        const std::size_t printed = paths("silhouette", style);
        seam.glued_on = true;
        // Of each of the two houses on the sheet; under `both` it was there twice.
        const std::size_t lines = style == FoldStyle::both ? 4U : 2U;
        EXPECT_EQ(paths("k40", style), laser - lines);
        EXPECT_EQ(paths("silhouette", style), printed - lines + 2U) << "drawn as a place instead";
    }
    const std::size_t drawn = paths("workshop", FoldStyle::dashed);
    seam.glued_on = false;
    EXPECT_EQ(paths("workshop", FoldStyle::dashed), drawn);
}

TEST(FoldStyles, InnerCutsComeBeforeOuterOnesInLayersOfTheirOwn) {
    const std::string sheet = svg_of(*find_profile("lightburn")).front();
    const std::size_t score = sheet.find("inkscape:label=\"score\"");
    const std::size_t inner = sheet.find("inkscape:label=\"inner-cut\"");
    const std::size_t outer = sheet.find("inkscape:label=\"outer-cut\"");
    ASSERT_NE(outer, std::string::npos);
    EXPECT_LT(score, inner);
    EXPECT_LT(inner, outer);
    // The two slits of the page, and its outline.
    EXPECT_EQ(count(sheet.substr(inner, outer - inner), "<path"), 2U);
    EXPECT_EQ(count(sheet.substr(outer), "<path"), 1U);
    EXPECT_EQ(sheet.find("inkscape:label=\"fill\""), std::string::npos);
    EXPECT_EQ(sheet.find("<text"), std::string::npos);
}

TEST(FoldStyles, StyledPathsSayTheirColourThemselves) {
    for (const std::string& sheet : svg_of(*find_profile("k40")))
        EXPECT_EQ(count(sheet, "<path"), count(sheet, "style=\"fill:none;stroke:#"));
}

TEST(OneSided, MachinesAreRemarkedOnWhenFoldsGoBothWays) {
    const auto findings = [](const Profile& profile) {
        Diagnostics diagnostics;
        examine_profile(test::example_layout(), profile, ScoreSide::front, diagnostics);
        return diagnostics.sorted();
    };
    Profile laser = *find_profile("k40");
    const std::vector<Diagnostic> found = findings(laser);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].code, "one-sided-folds");
    EXPECT_EQ(found[0].severity, Severity::remark);
    EXPECT_EQ(
        found[0].message,
        "the sheets have 3 mountain and 3 valley folds, and the profile k40 scores all of them from one "
        "side");
    laser.folds = FoldStyle::perforated;
    EXPECT_TRUE(findings(laser).empty());
    EXPECT_TRUE(findings(*find_profile("workshop")).empty());
}

TEST(LeftOut, CutsAndFoldsAreWarnedOf) {
    const auto findings = [](const Profile& profile) {
        Diagnostics diagnostics;
        examine_profile(test::example_layout(), profile, ScoreSide::front, diagnostics);
        return diagnostics.sorted();
    };
    const auto pen = [](Profile& profile, Operation operation) -> Pen& {
        return profile.pens[static_cast<std::size_t>(operation)];
    };
    for (const Profile& row : profile_table()) {
        for (const Diagnostic& one : findings(row)) EXPECT_EQ(one.code, "one-sided-folds") << row.name;
    }
    Profile profile = *find_profile("lightburn");
    profile.folds = FoldStyle::perforated;
    pen(profile, Operation::perforation).layer.clear();
    std::vector<Diagnostic> found = findings(profile);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].code, "lines-left-out");
    // Three valley folds and a mountain fold of the page; a mountain fold and a seam of each of two houses.
    EXPECT_EQ(found[0].message, "the profile lightburn leaves out 8 folds");
    pen(profile, Operation::outer_cut).layer.clear();
    EXPECT_EQ(findings(profile)[0].message, "the profile lightburn leaves out 3 cuts and 8 folds");

    profile = *find_profile("cricut");
    pen(profile, Operation::mountain).layer.clear();
    EXPECT_EQ(findings(profile)[0].message, "the profile cricut leaves out 3 folds");
    const std::string sheet = svg_of(profile)[1];
    const std::size_t layer = sheet.find("inkscape:label=\"perforation\"");
    EXPECT_EQ(count(sheet.substr(layer, sheet.find("\n </g>", layer) - layer), "<path"), 2U) << "two seams";
}

TEST(Layers, HaveIdsOfTheirOwn) {
    Profile profile = profile_table().front();
    for (const Operation operation : kOperations) {
        profile.pens[static_cast<std::size_t>(operation)].layer =
            static_cast<int>(operation) % 2 == 0 ? "sheet-1" : "1 ü";
    }
    const std::string sheet = svg_of(profile).front();
    std::set<std::string> ids;
    std::size_t n = 0;
    for (std::size_t at = sheet.find(" id=\""); at != std::string::npos; at = sheet.find(" id=\"", at + 1)) {
        ids.insert(sheet.substr(at, sheet.find('"', at + 5) - at));
        ++n;
    }
    EXPECT_GT(n, 8U);
    EXPECT_EQ(ids.size(), n);
}

TEST(Profiles, LeftOutPensCanBeSeenOnceTheyHaveALayer) {
    for (const Profile& row : profile_table()) {
        for (const Operation operation : kOperations) {
            if (operation == Operation::fill || operation == Operation::draw) continue;
            EXPECT_NE(to_string(row.pen(operation).color), "#ffffff") << row.name;
            if (operation != Operation::label) {
                EXPECT_GT(row.pen(operation).width_mm, 0.0) << row.name;
            }
        }
    }
}

// --- files

TEST(ProfileFiles, ChangeWhatTheySayAndNothingElse) {
    const Reading reading = read(
        "base = 'k40'\nfolds = 'both'\n[perforation]\ncut = 1\n[pens.seam]\nlayer = ''\n"
        "[pens.outer-cut]\ncolor = '#00FF7f'\n");
    ASSERT_TRUE(reading.profile);
    const Profile& mine = *reading.profile;
    const Profile& base = *find_profile("k40");
    EXPECT_EQ(mine.name, "mine");
    EXPECT_EQ(mine.folds, FoldStyle::both);
    EXPECT_EQ(mine.perforation.cut_mm, 1.0);
    EXPECT_EQ(mine.perforation.gap_mm, base.perforation.gap_mm);
    EXPECT_EQ(mine.one_sided, base.one_sided);
    EXPECT_EQ(mine.styled_paths, base.styled_paths);
    EXPECT_FALSE(mine.draws(Operation::seam));
    EXPECT_EQ(to_string(mine.pen(Operation::outer_cut).color), "#00ff7f");
    EXPECT_EQ(mine.pen(Operation::outer_cut).layer, base.pen(Operation::outer_cut).layer);
    EXPECT_EQ(to_string(mine.pen(Operation::inner_cut).color), "#ff0000");
}

TEST(ProfileFiles, AnEmptyOneIsWorkshopUnderItsOwnName) {
    const Reading reading = read("");
    ASSERT_TRUE(reading.profile);
    EXPECT_EQ(reading.profile->name, "mine");
    EXPECT_EQ(svg_of(*reading.profile), svg_of(profile_table().front()));
}

TEST(ProfileFiles, WhatIsWrongIsSaidWithItsPlace) {
    const auto expect = [](const std::string& text, Place place, const std::string& message,
                           const std::string& hint = {}) {
        const Reading reading = read(text);
        EXPECT_FALSE(reading.profile) << text;
        ASSERT_EQ(reading.findings.size(), 1U) << text;
        EXPECT_EQ(reading.findings[0].code, "bad-profile");
        EXPECT_EQ(reading.findings[0].place, place) << text;
        EXPECT_EQ(reading.findings[0].message, message);
        if (!hint.empty()) {
            ASSERT_FALSE(reading.findings[0].hints.empty()) << text;
            EXPECT_EQ(reading.findings[0].hints[0], hint);
        }
    };
    expect("folds = 'score'\nfolded = 1\n", {2, 1}, "there is no key \"folded\"", "did you mean \"folds\"?");
    expect("[pens.cut]\n", {1, 7}, "there is no key \"cut\" in \"pens\"");
    expect("[pens.glue]\ncolour = '#ffffff'\n", {2, 1}, "there is no key \"colour\" in a pen",
           "did you mean \"color\"?");
    expect("folds = 'creased'\n", {1, 9},
           "\"folds\" takes one of dashed, score, perforated, both, not \"creased\"");
    expect("folds = 3\n", {1, 9}, "\"folds\" takes one of dashed, score, perforated, both, not a number");
    expect("base = 'k41'\n", {1, 8}, "there is no profile \"k41\" to begin with");
    expect("name = true\n", {1, 8}, "\"name\" takes a string, not true or false");
    expect("one-sided = 1\n", {1, 13}, "\"one-sided\" takes true or false, not a number");
    expect("perforation = 2\n", {1, 15}, "\"perforation\" takes a table, not a number");
    expect("joints = 0.001\n", {1, 10}, "\"joints\" is 0.001 mm; it must be 0 or from 0.05 to 10");
    EXPECT_TRUE(read("joints = 0\n").profile);
    expect("[perforation]\ngap = 0\n", {2, 7}, "\"gap\" is 0 mm; it must be from 0.01 to 1000");
    expect("[perforation]\ncut = nan\n", {2, 7}, "\"cut\" is nan mm; it must be from 0.01 to 1000");
    expect("[perforation]\ncut = '2'\n", {2, 7}, "\"cut\" takes a number of millimetres, not a string");
    expect("[pens.label]\ncolor = 'red'\n", {2, 9},
           "\"color\" takes six hexadecimal digits after a #, not \"red\"", "such as \"#ff0000\"");
    expect("[pens.valley]\nwidth = 0\n", {2, 9}, "\"width\" is 0 mm; it must be from 0.001 to 1000");
    expect("[pens.valley]\nwidth = 9007199254740993\n", {2, 9},
           "\"width\" is 9007199254740992 mm; it must be from 0.001 to 1000");
    std::string deep = "base = 'k40'\na";
    for (int i = 0; i < 30000; ++i) deep += ".a";
    expect(deep + " = 1\n", {2, 1}, "this line has more than 256 dots");
    expect(std::string(70000, '#'), {}, "a profile has at most 65536 bytes, not 70000");
    EXPECT_FALSE(read("name = \n").profile);
    EXPECT_FALSE(read(std::string(100000, '[')).profile);
    EXPECT_FALSE(read("\xff\xfe\n").profile);
}

// The schema and the reader know the same keys, names and styles.
TEST(ProfileFiles, AreWhatTheSchemaSays) {
    const Json schema =
        Json::parse(test::read_file(std::string(POPUP_SOURCE_DIR) + "/schemas/profile.schema.json"));
    std::set<std::string> bases;
    for (const Profile& row : profile_table()) bases.insert(row.name);
    EXPECT_EQ(schema["properties"]["base"]["enum"].get<std::set<std::string>>(), bases);
    for (const Json& style : schema["properties"]["folds"]["enum"])
        EXPECT_TRUE(read("folds = '" + style.get<std::string>() + "'").profile) << style;
    const Json sample{{"string", "'x'"}, {"boolean", "true"}, {"number", "1.0"}, {"array", "['svg']"}};
    const auto resolved = [&schema](Json node) {
        while (node.contains("$ref"))
            node = schema["$defs"][node["$ref"].get<std::string>().substr(std::string("#/$defs/").size())];
        return node;
    };
    const auto value = [&](const Json& given) {
        const Json property = resolved(given);
        if (property.contains("enum")) return "'" + property["enum"][0].get<std::string>() + "'";
        if (property.contains("pattern")) return std::string("'#123456'");
        return sample[property["type"].get<std::string>()].get<std::string>();
    };
    std::set<std::string> operations;
    for (const auto& [key, property] : schema["properties"].items()) {
        if (key == "pens") {
            for (const auto& [operation, pen] : property["properties"].items()) {
                operations.insert(operation);
                const Json keys = resolved(pen)["properties"];
                for (const auto& [name, one] : keys.items()) {
                    const std::string text = "[pens." + operation + "]\n" + name + " = " + value(one);
                    EXPECT_TRUE(read(text).profile) << text;
                }
            }
        } else if (property.contains("properties")) {
            std::string required = "[" + key + "]\n";
            if (property.contains("required")) {
                for (const auto& [name, one] : property["properties"].items())
                    required += name + " = " + value(one) + "\n";
                EXPECT_TRUE(read(required).profile) << required;
                continue;
            }
            for (const auto& [name, one] : property["properties"].items())
                EXPECT_TRUE(read("[" + key + "]\n" + name + " = " + value(one)).profile) << name;
        } else {
            EXPECT_TRUE(read(key + " = " + value(property)).profile) << key;
        }
    }
    std::set<std::string> known;
    for (const Operation operation : kOperations) known.insert(std::string(to_string(operation)));
    EXPECT_EQ(operations, known);
}

TEST(ProfileFiles, TheSampleIsOne) {
    const std::string path = std::string(POPUP_SOURCE_DIR) + "/samples/card-cutter.toml";
    Diagnostics diagnostics(path);
    const auto source = read_source(path, diagnostics);
    ASSERT_TRUE(source);
    const auto profile = read_profile(*source, diagnostics);
    ASSERT_TRUE(profile);
    EXPECT_TRUE(diagnostics.sorted().empty());
    const std::string sheet = svg_of(*profile).front();
    EXPECT_NE(sheet.find("inkscape:label=\"Folds\""), std::string::npos);
    EXPECT_EQ(sheet.find("<text"), std::string::npos);
}

}  // namespace
}  // namespace popup
