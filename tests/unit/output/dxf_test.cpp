// DXF: read by a reader of group codes of this test's own, and by ezdxf where that is installed.
#include "output/dxf.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "support/run_program.h"
#include "support/sheet_example.h"

namespace popup {
namespace {

using Json = nlohmann::json;

struct Group {
    int code = 0;
    std::string value;
};

// Two lines a group. What is not that fails the test.
std::vector<Group> groups_of(const std::string& text) {
    std::vector<Group> groups;
    std::istringstream lines(text);
    std::string code;
    std::string value;
    while (std::getline(lines, code)) {
        if (!std::getline(lines, value)) {
            ADD_FAILURE() << "a group without a value";
            break;
        }
        groups.push_back({std::stoi(code), value});
    }
    return groups;
}

struct Entity {
    std::string type;
    std::string layer;
    int color = 0;
    bool closed = false;
    std::vector<Vec2> points;
    std::string text;

    [[nodiscard]] double length() const {
        double sum = 0.0;
        for (std::size_t i = 1; i < points.size(); ++i) sum += distance(points[i - 1], points[i]);
        return closed ? sum + distance(points.back(), points.front()) : sum;
    }
};

struct Dxf {
    std::map<std::string, std::string> header;  // each variable's first value
    std::vector<std::string> sections;
    std::map<std::string, int> layers;
    std::vector<Entity> entities;
    std::vector<std::string> handles;
    std::vector<std::string> owners;
};

Dxf parsed(const std::string& text) {
    Dxf dxf;
    std::string section;
    std::string type;
    std::string table;
    std::string name;
    const std::vector<Group> groups = groups_of(text);
    for (std::size_t i = 0; i < groups.size(); ++i) {
        const auto& [code, value] = groups[i];
        if (code == 0) {
            type = value;
            if (value == "ENDSEC") section.clear();
            if (section == "ENTITIES") dxf.entities.push_back({value, "", 0, false, {}, ""});
            continue;
        }
        if (code == 2 && type == "SECTION") {
            section = value;
            dxf.sections.push_back(value);
        }
        if (code == 9) dxf.header[value] = groups.at(i + 1).value;
        if (section == "HEADER") continue;
        if (code == 5) dxf.handles.push_back(value);
        if (code == 330) dxf.owners.push_back(value);
        if (code == 2 && type == "LAYER") name = value;
        if (code == 62 && type == "LAYER") dxf.layers[name] = std::stoi(value);
        if (section != "ENTITIES" || dxf.entities.empty()) continue;
        Entity& entity = dxf.entities.back();
        if (code == 8) entity.layer = value;
        if (code == 62) entity.color = std::stoi(value);
        if (code == 70) entity.closed = value == "1";
        if (code == 10 || code == 11) entity.points.push_back({std::stod(value), 0.0});
        if (code == 20 || code == 21) entity.points.back().y = std::stod(value);
        if (code == 1) entity.text = value;
    }
    return dxf;
}

std::vector<std::string> written(const Layout& layout, const Profile& profile) {
    OutputOptions options;
    options.profile = profile;
    Diagnostics diagnostics;
    return test::bytes_of(write_dxf(layout, options, diagnostics));
}

// What a layer must hold, from the example's own numbers.
struct Share {
    std::size_t count = 0;
    double length = 0.0;
};
std::map<std::string, Share> shares(const Dxf& dxf) {
    std::map<std::string, Share> all;
    for (const Entity& entity : dxf.entities) {
        if (entity.type == "TEXT") continue;
        ++all[entity.layer].count;
        all[entity.layer].length += entity.length();
    }
    return all;
}

TEST(Dxf, IsAnAutoCad2000DrawingInMillimetres) {
    for (const std::string& text : written(test::example_layout(), profile_table().front())) {
        const Dxf dxf = parsed(text);
        EXPECT_EQ(dxf.sections,
                  (std::vector<std::string>{"HEADER", "CLASSES", "TABLES", "BLOCKS", "ENTITIES", "OBJECTS"}));
        EXPECT_EQ(dxf.header.at("$ACADVER"), "AC1015");
        EXPECT_EQ(dxf.header.at("$INSUNITS"), "4");
        EXPECT_EQ(dxf.header.at("$EXTMAX"), "297.0");
        EXPECT_TRUE(text.ends_with("\n0\nEOF\n"));
    }
}

TEST(Dxf, HandlesAreUniqueAndBelowTheSeedAndOwnersExist) {
    for (const std::string& text : written(test::example_layout(), profile_table().front())) {
        const Dxf dxf = parsed(text);
        const std::set<std::string> unique(dxf.handles.begin(), dxf.handles.end());
        EXPECT_EQ(unique.size(), dxf.handles.size());
        const auto number = [](const std::string& hex) { return std::stoul(hex, nullptr, 16); };
        for (const std::string& handle : dxf.handles)
            EXPECT_LT(number(handle), number(dxf.header.at("$HANDSEED")));
        for (const std::string& owner : dxf.owners)
            EXPECT_TRUE(owner == "0" || unique.contains(owner)) << owner;
    }
}

// Sheet 1 holds the page: two slits of 45 mm, an outline of 720 mm, valley folds of 70, 60 and √1.25 mm, and
// a mountain fold of 30 mm, which has four gaps of a millimetre.
TEST(Dxf, LayersHoldTheLinesOfTheirOperations) {
    const Dxf dxf = parsed(written(test::example_layout(), *find_profile("lightburn")).front());
    const auto found = shares(dxf);
    EXPECT_EQ(found.size(), 4U);
    EXPECT_GE(found.at("mark").count, 6U);  // the corners of a target, and its number
    EXPECT_EQ(found.at("outer-cut").count, 1U);
    EXPECT_NEAR(found.at("outer-cut").length, 720.0, 1e-5);
    EXPECT_EQ(found.at("inner-cut").count, 2U);
    EXPECT_NEAR(found.at("inner-cut").length, 90.0, 1e-5);
    EXPECT_EQ(found.at("score").count, 8U);
    EXPECT_NEAR(found.at("score").length, 70.0 + 60.0 + std::sqrt(1.25) + 26.0, 1e-5);
    for (const Entity& entity : dxf.entities) {
        EXPECT_TRUE(dxf.layers.contains(entity.layer));
        EXPECT_EQ(entity.color, entity.layer == "mark"        ? 6
                                : entity.layer == "score"     ? 1
                                : entity.layer == "inner-cut" ? 5
                                                              : 7);
        EXPECT_EQ(entity.closed, entity.layer == "outer-cut");
    }
    // Marks first, the outline last.
    EXPECT_EQ(dxf.entities.front().layer, "mark");
    EXPECT_EQ(dxf.entities.back().layer, "outer-cut");
    EXPECT_EQ(dxf.entities.back().type, "LWPOLYLINE");
}

TEST(Dxf, LiesWhereTheLayoutPutsIt) {
    const Dxf dxf = parsed(written(test::example_layout(), *find_profile("k40")).front());
    Box box;
    for (const Vec2 p : dxf.entities.back().points) box.extend(p);
    EXPECT_NEAR(box.min.x, 48.5, 1e-6);
    EXPECT_NEAR(box.min.y, 25.0, 1e-6);
    EXPECT_NEAR(box.max.x, 248.5, 1e-6);
    EXPECT_NEAR(box.max.y, 185.0, 1e-6);
    // K40 Whisperer: red is index 1, blue 5, and the scores' layer says so.
    for (const Entity& entity : dxf.entities) EXPECT_EQ(entity.color, entity.layer == "ENGRAVE" ? 5 : 1);
}

TEST(Dxf, PerforationsAreLinesOfTheirOwn) {
    const Dxf dxf = parsed(written(test::example_layout(), *find_profile("cricut")).back());
    std::size_t lines = 0;
    for (const Entity& entity : dxf.entities) {
        if (entity.layer != "perforation") continue;
        ++lines;
        EXPECT_EQ(entity.type, "LINE");
        EXPECT_LT(entity.length(), 3.0);
    }
    EXPECT_EQ(lines, 2U * (25U + 13U));
}

TEST(Dxf, NamesStayWithinAscii) {
    Layout layout = test::example_layout();
    layout.designs[0].pattern.pieces[0].labels[0].text = "Möwe\n🦆";
    Profile profile = profile_table().front();
    profile.pens[static_cast<std::size_t>(Operation::outer_cut)].layer = "Schnitt: außen\n";
    const std::string text = written(layout, profile).front();
    for (const char c : text) EXPECT_TRUE((c >= ' ' && c <= '~') || c == '\n');
    const Dxf dxf = parsed(text);
    std::set<std::string> texts;
    for (const Entity& entity : dxf.entities) {
        if (entity.type == "TEXT") texts.insert(entity.text);
        EXPECT_TRUE(dxf.layers.contains(entity.layer)) << entity.layer;
    }
    EXPECT_TRUE(std::any_of(texts.begin(), texts.end(), [](const std::string& one) {
        return one.starts_with("M\\U+00F6we") && one.ends_with("\\U+D83E\\U+DD86");
    }));
}

TEST(Dxf, TextsHoldNoCodesOfTheFormat) {
    Layout layout = test::example_layout();
    layout.designs[0].pattern.pieces[0].labels[0].text = "50%%c x^2 7%";
    const Dxf dxf = parsed(written(layout, profile_table().front()).front());
    // As a reader has it that knows %%c as a diameter and ^2 as a character of control.
    EXPECT_TRUE(std::any_of(dxf.entities.begin(), dxf.entities.end(), [](const Entity& entity) {
        return entity.type == "TEXT" && entity.text == "50% %c x^ 2 7%";
    }));
}

// Another's reader finds the same, and nothing to complain of.
TEST(Dxf, EzdxfReadsAllProfilesWithoutAComplaint) {
    const test::ScratchDirectory scratch;
    std::vector<std::string> words{"python3", std::string(POPUP_SOURCE_DIR) + "/tests/tools/read_dxf.py"};
    // A Python of the user's own need not have what Debian's has.
    if (test::run({"/usr/bin/python3", "-c", "import ezdxf"}).exit == 0) words[0] = "/usr/bin/python3";
    std::vector<Dxf> own;
    for (const Profile& profile : profile_table()) {
        const std::vector<std::string> sheets = written(test::example_layout(), profile);
        for (std::size_t i = 0; i < sheets.size(); ++i) {
            const auto path = scratch / (profile.name + std::to_string(i) + ".dxf");
            test::write_file(path, sheets[i]);
            words.push_back(path);
            own.push_back(parsed(sheets[i]));
        }
    }
    const test::RunResult result = test::run(words);
    if (result.exit == 77 || result.exit == 127) GTEST_SKIP() << "ezdxf is not installed";
    ASSERT_EQ(result.exit, 0) << result.err;
    std::istringstream lines(result.out);
    std::size_t i = 0;
    for (std::string line; std::getline(lines, line); ++i) {
        const Json theirs = Json::parse(line);
        ASSERT_LT(i, own.size());
        EXPECT_EQ(theirs["version"], "AC1015");
        EXPECT_EQ(theirs["units"], 4);
        EXPECT_EQ(theirs["extent"], Json({297.0, 210.0}));
        EXPECT_TRUE(theirs["errors"].empty()) << theirs["errors"];
        EXPECT_TRUE(theirs["fixes"].empty()) << theirs["fixes"];
        std::size_t k = 0;
        for (const Entity& entity : own[i].entities) {
            if (entity.type == "TEXT") continue;
            const Json& one = theirs["lines"].at(k++);
            EXPECT_EQ(one["type"], entity.type);
            EXPECT_EQ(one["layer"], entity.layer);
            EXPECT_EQ(one["color"], entity.color);
            EXPECT_EQ(one["closed"], entity.closed);
            EXPECT_NEAR(one["length"].get<double>(), entity.length(), 1e-6);
        }
        EXPECT_EQ(theirs["lines"].size(), k);
        EXPECT_EQ(theirs["texts"].size() + k, own[i].entities.size());
    }
    EXPECT_EQ(i, own.size());
}

}  // namespace
}  // namespace popup
