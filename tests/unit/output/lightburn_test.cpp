// LightBurn projects: read by tinyxml2 and by a reader of vertex and line lists of this test's own; what must
// be there is counted in the layout's pattern.
#include "output/lightburn.h"

#include <gtest/gtest.h>
#include <tinyxml2.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "support/profiles.h"
#include "support/run_program.h"
#include "support/sheet_example.h"

namespace popup {
namespace {

using test::pattern_lengths;
using test::pen_of;
using test::windowed_layout;
using test::with_slits;

struct Setting {
    std::string type;
    std::string name;
    int index = -1;
    int priority = -1;
    std::map<std::string, std::string> values;  // of all children
};

struct Shape {
    int index = -1;
    bool closed = false;
    std::vector<Vec2> points;

    [[nodiscard]] double length() const {
        double sum = 0.0;
        for (std::size_t i = 1; i < points.size(); ++i) sum += distance(points[i - 1], points[i]);
        return closed ? sum + distance(points.back(), points.front()) : sum;
    }
};

struct Project {
    std::vector<Setting> settings;
    std::vector<Shape> shapes;
    std::string notes;

    [[nodiscard]] const Setting* named(const std::string& name) const {
        for (const Setting& one : settings) {
            if (one.name == name) return &one;
        }
        return nullptr;
    }
    [[nodiscard]] std::string name_of(const Shape& shape) const {
        for (const Setting& one : settings) {
            if (one.index == shape.index) return one.name;
        }
        return "?";
    }
    // By the names of the settings.
    [[nodiscard]] std::map<std::string, double> lengths() const {
        std::map<std::string, double> all;
        for (const Shape& shape : shapes) all[name_of(shape)] += shape.length();
        return all;
    }
};

// "V1 2c0x1c1x1V3 4c0x1c1x1". A vertex may have control points; a straight line has none ("c0x1c1x1").
std::vector<Vec2> vertices_of(const std::string& list) {
    std::vector<Vec2> all;
    std::istringstream in(list);
    in.imbue(std::locale::classic());
    char letter = 0;
    while (in >> letter) {
        EXPECT_EQ(letter, 'V') << list;
        Vec2 p;
        in >> p.x;
        EXPECT_EQ(in.get(), ' ');
        in >> p.y;
        std::string controls(8, '\0');
        in.read(controls.data(), 8);
        EXPECT_EQ(controls, "c0x1c1x1");
        all.push_back(p);
        if (!in) break;
    }
    EXPECT_TRUE(in.eof()) << list;
    return all;
}

// True for LineClosed, false for "L0 1L1 2…" through all vertices.
bool is_closed(const std::string& list, std::size_t vertices) {
    if (list == "LineClosed") return true;
    std::istringstream in(list);
    std::size_t next = 0;
    char letter = 0;
    while (in >> letter) {
        std::size_t from = 0;
        std::size_t to = 0;
        in >> from >> to;
        EXPECT_EQ(letter, 'L');
        EXPECT_EQ(from, next);
        EXPECT_EQ(to, next + 1);
        next = to;
    }
    EXPECT_EQ(next + 1, vertices) << list;
    return false;
}

std::string child_text(const tinyxml2::XMLElement& element, const char* name) {
    const tinyxml2::XMLElement* child = element.FirstChildElement(name);
    if (child == nullptr || child->GetText() == nullptr) return "";
    return child->GetText();
}

Project parsed(const std::string& text) {
    Project project;
    tinyxml2::XMLDocument document;
    EXPECT_EQ(document.Parse(text.data(), text.size()), tinyxml2::XML_SUCCESS) << document.ErrorStr();
    const tinyxml2::XMLElement* root = document.FirstChildElement("LightBurnProject");
    if (root == nullptr) {
        ADD_FAILURE() << "no project";
        return project;
    }
    EXPECT_STREQ(root->Attribute("FormatVersion"), "1");
    EXPECT_STREQ(root->Attribute("MirrorX"), "False");
    EXPECT_STREQ(root->Attribute("MirrorY"), "False");
    std::set<int> ids;
    for (const auto* one = root->FirstChildElement(); one != nullptr; one = one->NextSiblingElement()) {
        const std::string tag = one->Name();
        if (tag == "CutSetting") {
            EXPECT_TRUE(project.shapes.empty()) << "settings stand before shapes";
            Setting& setting = project.settings.emplace_back();
            setting.type = one->Attribute("type");
            for (const auto* child = one->FirstChildElement(); child != nullptr;
                 child = child->NextSiblingElement())
                setting.values[child->Name()] = child->Attribute("Value");
            setting.name = setting.values.at("name");
            setting.index = std::stoi(setting.values.at("index"));
            setting.priority = std::stoi(setting.values.at("priority"));
        } else if (tag == "Shape") {
            EXPECT_STREQ(one->Attribute("Type"), "Path");
            EXPECT_EQ(child_text(*one, "XForm"), "1 0 0 1 0 0");
            Shape& shape = project.shapes.emplace_back();
            shape.index = one->IntAttribute("CutIndex", -1);
            shape.points = vertices_of(child_text(*one, "VertList"));
            shape.closed = is_closed(child_text(*one, "PrimList"), shape.points.size());
            EXPECT_TRUE(ids.insert(one->IntAttribute("VertID", -1)).second) << "lists of the same number";
            EXPECT_EQ(one->IntAttribute("PrimID", -1), one->IntAttribute("VertID", -2));
        } else {
            EXPECT_EQ(tag, "Notes");
            project.notes = one->Attribute("Notes");
        }
    }
    return project;
}

std::vector<std::string> written(const Layout& layout, const Profile& profile) {
    OutputOptions options;
    options.profile = profile;
    Diagnostics diagnostics;
    std::vector<std::string> texts;
    const std::vector<SheetFile> files = write_lightburn(layout, options, diagnostics).value();
    texts.reserve(files.size());
    for (const SheetFile& file : files) texts.push_back(file.bytes);
    return texts;
}

TEST(LightBurn, HoldsWhatThePatternHasOfEachOperation) {
    const Layout layout = windowed_layout();
    for (const Profile& row : profile_table()) {
        Profile profile = with_slits(row.name);
        profile.marks_on = MarksOn::none;  // no lines of the pattern
        profile.away_folds = AwayFolds::whole;
        const std::vector<std::string> sheets = written(layout, profile);
        ASSERT_EQ(sheets.size(), 2U);
        for (int sheet = 0; sheet < 2; ++sheet) {
            const Project project = parsed(sheets[static_cast<std::size_t>(sheet)]);
            const std::map<std::string, double> found = project.lengths();
            double total = 0.0;
            double expected = 0.0;
            std::map<std::string, double> layers;
            for (const auto& [operation, mm] : pattern_lengths(layout, sheet)) {
                if (!profile.draws(operation)) continue;
                expected += mm;
                layers[profile.pen(operation).layer] += mm;
            }
            for (const auto& [name, mm] : found) {
                if (name == "T1" || name == "perforation" || name == "Perforating") continue;
                total += mm;
                // A perforation may share the layer of cuts.
                if (layers.contains(name) && !profile.draws(Operation::perforation)) {
                    EXPECT_NEAR(mm, layers.at(name), 1e-4) << profile.name << " " << name;
                }
            }
            if (profile.draws(Operation::perforation)) continue;
            EXPECT_NEAR(total, expected, 1e-4) << profile.name;
            EXPECT_FALSE(found.contains("?")) << "a shape without a setting";
        }
    }
}

TEST(LightBurn, LinesLieWhereTheLayoutPutsThem) {
    const Project project = parsed(written(windowed_layout(), with_slits("lightburn")).front());
    Box outline;
    Box window;
    for (const Shape& shape : project.shapes) {
        EXPECT_EQ(shape.closed,
                  project.name_of(shape) == "inner-cut" || project.name_of(shape) == "outer-cut");
        for (const Vec2 p : shape.points) {
            if (project.name_of(shape) == "outer-cut") outline.extend(p);
            if (project.name_of(shape) == "inner-cut") window.extend(p);
        }
    }
    // The page's origin is at (148.5, 105); y is up, so the window is in the upper half.
    EXPECT_NEAR(outline.min.x, 48.5, 1e-6);
    EXPECT_NEAR(outline.min.y, 25.0, 1e-6);
    EXPECT_NEAR(outline.max.x, 248.5, 1e-6);
    EXPECT_NEAR(outline.max.y, 185.0, 1e-6);
    EXPECT_NEAR(window.min.x, 58.489, 1e-6);
    EXPECT_NEAR(window.min.y, 135.007, 1e-6);
    EXPECT_NEAR(window.max.x, 88.497, 1e-6);
    EXPECT_NEAR(window.max.y, 165.019, 1e-6);
}

TEST(LightBurn, FoldsComeBeforeInnerCutsAndOutlinesLast) {
    const Project project = parsed(written(windowed_layout(), with_slits("lightburn")).front());
    std::vector<std::string> names;
    for (const Setting& setting : project.settings) {
        EXPECT_EQ(setting.priority, static_cast<int>(names.size()));
        EXPECT_EQ(setting.type, "Cut");
        names.push_back(setting.name);
    }
    EXPECT_EQ(names, (std::vector<std::string>{"mark", "score", "slit", "inner-cut", "outer-cut"}));
    std::vector<std::string> order;
    for (const Shape& shape : project.shapes) {
        const std::string name = project.name_of(shape);
        if (order.empty() || order.back() != name) order.push_back(name);
    }
    EXPECT_EQ(order, names);
}

TEST(LightBurn, IndicesAreThoseOfThePensColours) {
    const Project project = parsed(written(windowed_layout(), with_slits("lightburn")).front());
    EXPECT_EQ(project.named("score")->index, 2);      // #ff0000
    EXPECT_EQ(project.named("slit")->index, 5);       // #ff8000
    EXPECT_EQ(project.named("inner-cut")->index, 1);  // #0000ff
    EXPECT_EQ(project.named("outer-cut")->index, 0);  // #000000
}

TEST(LightBurn, NoTwoLayersShareAnIndexAndColoursOfItsOwnComeFirst) {
    Profile profile = with_slits("lightburn");
    // Nearly black stands before black, and two layers are red.
    pen_of(profile, Operation::valley) = {"a", {1, 1, 1}, 0.1};
    pen_of(profile, Operation::mountain) = {"b", {0xff, 0, 0}, 0.1};
    pen_of(profile, Operation::seam) = {"c", {0xff, 0, 0}, 0.1};
    for (const std::string& text : written(windowed_layout(), profile)) {
        const Project project = parsed(text);
        std::set<int> indices;
        for (const Setting& setting : project.settings) EXPECT_TRUE(indices.insert(setting.index).second);
        EXPECT_EQ(project.named("outer-cut")->index, 0);
        EXPECT_EQ(project.named("b")->index, 2);
        // #004754 is nearer to black than any other colour that is left.
        if (const Setting* a = project.named("a")) {
            EXPECT_EQ(a->index, 27);
        }
        // And #d33f6a, or #a00000, to red: 95² is less than 44² + 63² + 106².
        if (const Setting* c = project.named("c")) {
            EXPECT_EQ(c->index, 10);
        }
    }
    for (const Profile& row : profile_table()) {
        for (const std::string& text : written(windowed_layout(), row)) {
            std::set<int> indices;
            for (const Setting& setting : parsed(text).settings) {
                EXPECT_TRUE(indices.insert(setting.index).second) << row.name;
                EXPECT_EQ(setting.index == 30, setting.type == "Tool");
                EXPECT_LE(setting.index, 30);
            }
        }
    }
}

TEST(LightBurn, SpeedAndPowerAreThereWhereTheProfileKnowsThem) {
    Profile profile = with_slits("lightburn");
    pen_of(profile, Operation::outer_cut).speed_mm_s = 12.5;
    pen_of(profile, Operation::outer_cut).power_percent = 40.0;
    pen_of(profile, Operation::slit).speed_mm_s = 20.0;
    const Project project = parsed(written(windowed_layout(), profile).front());
    const auto values = [&project](const char* name) { return project.named(name)->values; };
    EXPECT_EQ(values("outer-cut").at("speed"), "12.5");
    EXPECT_EQ(values("outer-cut").at("maxPower"), "40");
    EXPECT_EQ(values("outer-cut").at("minPower"), "40");
    EXPECT_EQ(values("slit").at("speed"), "20");
    EXPECT_FALSE(values("slit").contains("maxPower"));
    EXPECT_FALSE(values("slit").contains("minPower"));
    for (const char* name : {"speed", "maxPower", "minPower"}) {
        EXPECT_FALSE(values("score").contains(name));
        EXPECT_FALSE(values("inner-cut").contains(name));
    }
}

TEST(LightBurn, PensOfOneLayerThatDifferHaveSettingsOfTheirOwn) {
    Profile profile = with_slits("k40");
    pen_of(profile, Operation::outer_cut).power_percent = 70.0;
    const Layout layout = windowed_layout();
    const Project project = parsed(written(layout, profile).front());
    ASSERT_EQ(project.settings.size(), 3U);
    EXPECT_EQ(project.settings[1].name, "CUT");
    EXPECT_EQ(project.settings[2].name, "CUT (outer-cut)");
    EXPECT_EQ(project.settings[2].values.at("maxPower"), "70");
    EXPECT_NEAR(project.lengths().at("CUT (outer-cut)"), pattern_lengths(layout, 0).at(Operation::outer_cut),
                1e-4);
}

// The piece's name stands in the middle of the page's upper left quarter; the glue target is as it was drawn.
TEST(LightBurn, WhatIsPrintedIsOnTheToolLayer) {
    const Project project = parsed(written(windowed_layout(), profile_table().front()).front());
    const Setting* tool = project.named("T1");
    ASSERT_NE(tool, nullptr);
    EXPECT_EQ(tool->type, "Tool");
    EXPECT_EQ(tool->index, 30);
    bool target = false;
    bool stroke = false;
    Box name;
    std::size_t letters = 0;
    for (const Shape& shape : project.shapes) {
        if (shape.index != 30) continue;
        const Vec2 first = shape.points.front();
        if (std::abs(first.x - 68.5) < 10.0 && std::abs(first.y - 175.0) < 4.0) {
            ++letters;
            EXPECT_TRUE(shape.closed);
            for (const Vec2 p : shape.points) name.extend(p);
        }
        const auto has = [&shape](Vec2 p) {
            return std::any_of(shape.points.begin(), shape.points.end(),
                               [p](Vec2 q) { return distance(p, q) < 1e-5; });
        };
        target = target || (shape.closed && shape.points.size() == 4 && has({188.5, 45}) && has({198.5, 81}));
        stroke = stroke || (!shape.closed && shape.points.size() == 3 && has({58.5, 45}) && has({98.5, 40}));
    }
    EXPECT_TRUE(target);
    EXPECT_TRUE(stroke);
    // "page": each of p, a, g and e is an outline and a hole, and the word's middle is where it was put.
    EXPECT_EQ(letters, 8U);
    EXPECT_NEAR(0.5 * (name.min.x + name.max.x), 68.5, 0.5);
    EXPECT_GT(name.max.x - name.min.x, 8.0);
    // The target, and none of the rectangles that are areas of colour.
    const auto rectangles = std::count_if(
        project.shapes.begin(), project.shapes.end(),
        [](const Shape& shape) { return shape.index == 30 && shape.closed && shape.points.size() == 4; });
    EXPECT_EQ(rectangles, 1);
}

TEST(LightBurn, IsWellFormedWhateverTheNames) {
    Layout layout = windowed_layout();
    layout.designs[0].stem = "a\"<b>&amp;'\x01\n\xff\xef\xbf\xbe]]>";
    Profile profile = with_slits("lightburn");
    pen_of(profile, Operation::outer_cut).layer = "\"/><x>&#0;'\x02\t\xfe\xef\xbf\xbf";
    const std::string text = written(layout, profile).front();
    EXPECT_EQ(text.find("\xef\xbf\xbe"), std::string::npos);
    EXPECT_EQ(text.find("\xef\xbf\xbf"), std::string::npos);
    for (const char c : text) EXPECT_TRUE(static_cast<unsigned char>(c) >= ' ' || c == '\n');
    const Project project = parsed(text);
    ASSERT_FALSE(project.settings.empty());
    EXPECT_TRUE(project.settings.back().name.starts_with("\"/><x>&#0;'\\x02 \\xfe\\uffff"))
        << project.settings.back().name;
    EXPECT_TRUE(project.notes.starts_with("a\"<b>&amp;'\\x01 \\xff\\ufffe]]>")) << project.notes;
    if (!test::have_program("xmllint")) return;
    const test::ScratchDirectory scratch;
    test::write_file(scratch / "a.lbrn2", text);
    const test::RunResult result = test::run({"xmllint", "--noout", scratch / "a.lbrn2"});
    EXPECT_EQ(result.exit, 0) << result.err;
}

TEST(LightBurn, IsTheSameEachTime) {
    for (const Profile& profile : profile_table())
        EXPECT_EQ(written(windowed_layout(), profile), written(windowed_layout(), profile));
}

}  // namespace
}  // namespace popup
