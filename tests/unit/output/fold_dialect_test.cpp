// Guarantees of the two dialects of FOLD, and of what a FOLD file says beside its pattern: read with a JSON
// reader alone, and measured on the corners that the file gives.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "output/fold.h"
#include "popup/compile.h"
#include "support/designs.h"

namespace popup::test {
namespace {

using nlohmann::json;
using Pair = std::pair<std::size_t, std::size_t>;

constexpr auto kStrict = FoldDialect::strict;
constexpr auto kSimulator = FoldDialect::simulator;

struct Written {
    json file;
    std::string told;
};

// Of FOLD files read as such, all of them in one.
Written write(const std::vector<std::string>& texts, FoldDialect dialect = kSimulator) {
    std::vector<Source> sources;
    for (std::size_t i = 0; i < texts.size(); ++i)
        sources.push_back({"sheet-" + std::to_string(i + 1) + ".fold", texts[i]});
    CompileOptions options;
    options.until = Stage::motion;
    options.motion.examine = false;
    options.motion.angles = {{0.0}, {60.0}, {180.0}};
    const Compilation run = compile(std::move(sources), options, {});
    std::vector<SceneCard> cards;
    Written result;
    for (const CompiledDesign& one : run.designs) {
        EXPECT_FALSE(one.diagnostics.has_errors()) << findings(one.diagnostics);
        cards.push_back({&*one.assembly, &*one.motion, "", &*one.creases});
    }
    OutputOptions output;
    output.fold_dialect = dialect;
    Diagnostics diagnostics;
    const auto text = write_fold(cards, output, diagnostics);
    EXPECT_TRUE(text.has_value());
    result.file = json::parse(text.value_or("{}"));
    result.told = findings(diagnostics);
    return result;
}

json of_card(const Design& design, FoldDialect dialect) {
    Built built = build(design);
    MotionOptions options;
    options.examine = false;
    options.angles = {{0.0}, {60.0}, {180.0}};
    const auto motion = simulate(*built.assembly, options, built.diagnostics);
    EXPECT_TRUE(motion.has_value());
    const std::vector<SceneCard> cards{{&*built.assembly, &*motion, ""}};
    OutputOptions output;
    output.fold_dialect = dialect;
    return json::parse(write_fold(cards, output, built.diagnostics).value_or("{}"));
}

Design two_steps() {
    Design design = card(200, 200);
    add(design, "step", {{-40, -30}, {-40, 30}, {40, -30}, {40, 30}});
    add(design, "step", {{-20, 50}, {-20, 80}, {20, 50}, {20, 80}});
    return design;
}

// A frame with what it inherits.
json whole(const json& file, std::size_t number) {
    if (number == 0) return file;
    const json& frame = file.at("file_frames").at(number - 1);
    json result = whole(file, frame.at("frame_parent").get<std::size_t>());
    EXPECT_EQ(frame.at("frame_inherit"), true);
    result.update(frame);
    return result;
}

// How many faces each edge has; every side of a face is an edge.
std::vector<int> faces_of_edges(const json& frame) {
    std::map<Pair, std::size_t> known;
    const auto edges = frame.at("edges_vertices").get<std::vector<Pair>>();
    for (std::size_t i = 0; i < edges.size(); ++i)
        EXPECT_TRUE(known.emplace(std::minmax(edges[i].first, edges[i].second), i).second) << "twice: " << i;
    std::vector<int> faces(edges.size(), 0);
    for (const auto& face : frame.at("faces_vertices").get<std::vector<std::vector<std::size_t>>>()) {
        for (std::size_t i = 0; i < face.size(); ++i) {
            const auto found = known.find(std::minmax(face[i], face[(i + 1) % face.size()]));
            if (found == known.end()) {
                ADD_FAILURE() << "a side that is no edge";
            } else {
                ++faces[found->second];
            }
        }
    }
    return faces;
}

std::vector<Vec3> corners(const json& frame) {
    std::vector<Vec3> all;
    for (const json& p : frame.at("vertices_coords"))
        all.push_back({p.at(0), p.at(1), p.size() > 2 ? p.at(2).get<double>() : 0.0});
    return all;
}

// What the specification says of letters, faces and angles, whatever the dialect.
void check_letters(const json& frame) {
    const std::vector<int> faces = faces_of_edges(frame);
    const json& letters = frame.at("edges_assignment");
    const json& angles = frame.at("edges_foldAngle");
    ASSERT_EQ(letters.size(), faces.size());
    ASSERT_EQ(angles.size(), faces.size());
    for (std::size_t i = 0; i < faces.size(); ++i) {
        const std::string letter = letters[i];
        const double angle = angles[i];
        EXPECT_EQ(faces[i], letter == "B" ? 1 : 2) << letter << i;
        EXPECT_LE(std::abs(angle), 180.0);
        if (letter == "V") {
            EXPECT_GE(angle, 0.0);
        }
        if (letter == "M") {
            EXPECT_LE(angle, 0.0);
        }
        if (letter != "M" && letter != "V") {
            EXPECT_EQ(angle, 0.0);
        }
    }
}

std::set<std::string> letters_of(const json& frame) {
    return frame.at("edges_assignment").get<std::set<std::string>>();
}

double length_of(const json& frame, const std::string& letter) {
    const std::vector<Vec3> at = corners(frame);
    double sum = 0.0;
    for (std::size_t i = 0; i < frame.at("edges_vertices").size(); ++i) {
        const auto [a, b] = frame.at("edges_vertices").at(i).get<Pair>();
        if (frame.at("edges_assignment").at(i) == letter) sum += distance(at[a], at[b]);
    }
    return sum;
}

TEST(FoldDialect, StrictHasTheSheetWithItsSlitsAndThenThePatternThatOpens) {
    const json strict = of_card(two_steps(), kStrict);
    const json simulator = of_card(two_steps(), kSimulator);
    check_letters(strict);
    check_letters(simulator);
    EXPECT_EQ(letters_of(strict), (std::set<std::string>{"B", "C", "M", "V"}));
    EXPECT_EQ(letters_of(simulator), (std::set<std::string>{"B", "M", "V"}));
    // Two slits a step; the border is that of the sheet.
    EXPECT_NEAR(length_of(strict, "C"), 2 * 80.0 + 2 * 40.0, 1e-6);
    EXPECT_NEAR(length_of(strict, "B"), length_of(simulator, "B") - 2.0 * length_of(strict, "C"), 1e-6);
    EXPECT_EQ(strict.at("frame_attributes").at(3), "cuts");
    // A disc, each of whose places is one vertex.
    const auto v = static_cast<int>(strict.at("vertices_coords").size());
    const auto e = static_cast<int>(strict.at("edges_vertices").size());
    const auto f = static_cast<int>(strict.at("faces_vertices").size());
    EXPECT_EQ(v - e + f, 1);
    EXPECT_EQ(strict.at("vertices_coords").get<std::set<std::vector<double>>>().size(),
              static_cast<std::size_t>(v));
    // The frame after it is the other dialect's pattern, on which the folded frames stand.
    const json open = whole(strict, 1);
    for (const char* key : {"vertices_coords", "edges_vertices", "edges_assignment", "edges_foldAngle",
                            "faces_vertices", "faces_popupc:plate", "frame_attributes"})
        EXPECT_EQ(open.at(key), simulator.at(key)) << key;
    ASSERT_EQ(strict.at("file_frames").size(), simulator.at("file_frames").size() + 1);
    for (std::size_t i = 1; i <= simulator.at("file_frames").size(); ++i) {
        const json one = whole(strict, i + 1);
        const json other = whole(simulator, i);
        check_letters(one);
        for (const char* key : {"frame_title", "vertices_coords", "edges_vertices", "edges_foldAngle"})
            EXPECT_EQ(one.at(key), other.at(key)) << key;
    }
}

// How far the face on the right of an edge turns up from lying beside the one on its left, by their corners.
double measured_deg(const json& frame, std::size_t edge) {
    const std::vector<Vec3> at = corners(frame);
    const auto [u, v] = frame.at("edges_vertices").at(edge).get<Pair>();
    Vec3 left;
    Vec3 right;
    for (const auto& face : frame.at("faces_vertices").get<std::vector<std::vector<std::size_t>>>()) {
        Vec3 normal;
        for (std::size_t i = 1; i + 1 < face.size(); ++i)
            normal = normal + cross(at[face[i]] - at[face[0]], at[face[i + 1]] - at[face[0]]);
        for (std::size_t i = 0; i < face.size(); ++i) {
            const std::size_t next = face[(i + 1) % face.size()];
            if (face[i] == u && next == v) left = unit(normal);
            if (face[i] == v && next == u) right = unit(normal);
        }
    }
    const Vec3 along = unit(at[v] - at[u]);
    return std::atan2(dot(along, cross(right, left)), dot(left, right)) * 180.0 / std::numbers::pi;
}

constexpr const char* kTray = R"({"frame_unit": "mm",
"vertices_coords": [[0,0],[10,0],[40,0],[50,0],[0,10],[10,10],[40,10],[50,10],[0,40],[10,40],[40,40],[50,40],
 [0,50],[10,50],[40,50],[50,50]],
"edges_vertices": [[5,6],[6,10],[10,9],[9,5],[1,2],[1,5],[2,6],[7,11],[6,7],[10,11],[13,14],[9,13],[10,14],[4,8],
 [4,5],[8,9]],
"edges_assignment": ["V","U","M","V","B","B","B","B","B","B","B","B","B","B","B","B"],
"edges_foldAngle": [90,null,-30,120,0,0,0,0,0,0,0,0,0,0,0,0]})";

TEST(FoldDialect, KeyFrameHasTheAnglesInWhichTheMotionEnds) {
    for (const FoldDialect dialect : {kSimulator, kStrict}) {
        const Written tray = write({kTray}, dialect);
        check_letters(tray.file);
        const json last = whole(tray.file, 1);
        ASSERT_EQ(last.at("popupc:angle_deg"), 0);
        std::multiset<double> angles;
        for (std::size_t i = 0; i < tray.file.at("edges_vertices").size(); ++i) {
            const double angle = tray.file.at("edges_foldAngle").at(i);
            if (tray.file.at("edges_assignment").at(i) == "B") continue;
            EXPECT_NEAR(measured_deg(last, i), angle, 1e-3);
            angles.insert(std::round(angle));
        }
        EXPECT_TRUE(angles.contains(90) && angles.contains(-30) && angles.contains(120));
        EXPECT_EQ(angles.size(), 4U);
        EXPECT_EQ(tray.told, "");
    }
}

TEST(FoldDialect, WhatIsWrittenIsReadAsTheSameSheet) {
    for (const FoldDialect dialect : {kSimulator, kStrict}) {
        const Written once = write({kTray}, dialect);
        const Written again = write({once.file.dump()}, dialect);
        for (const char* key :
             {"vertices_coords", "edges_vertices", "edges_assignment", "edges_foldAngle", "faces_vertices"})
            EXPECT_EQ(once.file.at(key), again.file.at(key)) << key;
    }
}

// A plate with a hole is triangles; an assembly need not say which way a hinge goes.
TEST(FoldDialect, SimulatorHasOnlyLettersThatAreHinges) {
    Built built = build(two_steps());
    Assembly& assembly = *built.assembly;
    assembly.plates[0].outline.holes = {{{-90, -90}, {-90, -80}, {-80, -80}, {-80, -90}}};
    std::erase_if(assembly.lines, [](const Line& line) { return line.kind == LineKind::mountain; });
    const SceneCard scene{&assembly, nullptr, ""};
    OutputOptions options;
    std::map<FoldDialect, json> files;
    for (const FoldDialect dialect : {kSimulator, kStrict}) {
        options.fold_dialect = dialect;
        files[dialect] = json::parse(write_fold(std::span(&scene, 1), options, built.diagnostics).value());
        check_letters(files[dialect]);
    }
    EXPECT_EQ(letters_of(files[kSimulator]), (std::set<std::string>{"B", "F", "M", "V"}));
    EXPECT_EQ(letters_of(files[kStrict]), (std::set<std::string>{"B", "C", "J", "U", "V"}));
    EXPECT_NEAR(length_of(files[kSimulator], "M"), length_of(files[kStrict], "U"), 1e-6);
}

// --- what a file says beside

std::string id_of(const Vec3 p) {
    return std::to_string(std::lround(p.x)) + "," + std::to_string(std::lround(p.y));
}

// A comb of lines that cross, touch and end on one another, each vertex with its place and each edge with its
// line as its value: what comes out is looked at by its own places.
TEST(FoldDialect, ColumnsGoWithTheElementsInTheSamePlace) {
    json in = {{"frame_unit", "mm"}};
    const auto vertex = [&](int x, int y) {
        in["vertices_coords"].push_back({x, y});
        in["vertices_abc:id"].push_back(id_of({double(x), double(y), 0.0}));
        return in["vertices_coords"].size() - 1;
    };
    const auto edge = [&](std::size_t a, std::size_t b, const char* letter) {
        in["edges_vertices"].push_back({a, b});
        in["edges_assignment"].push_back(letter);
        in["edges_foldAngle"].push_back(*letter == 'B' || *letter == 'C' ? 0 : 60);
        in["edges_abc:line"].push_back({in["vertices_coords"][a], in["vertices_coords"][b]});
    };
    const std::size_t a = vertex(0, 0);
    const std::size_t b = vertex(300, 0);
    const std::size_t c = vertex(300, 200);
    const std::size_t d = vertex(0, 200);
    edge(a, b, "B");
    edge(b, c, "B");
    edge(c, d, "B");
    edge(d, a, "B");
    // Folds end on the border, which has no corners there, and a slit crosses them.
    for (int x = 30; x < 300; x += 30) edge(vertex(x, 0), vertex(x, 200), "V");
    edge(vertex(45, 100), vertex(255, 100), "C");
    for (const FoldDialect dialect : {kSimulator, kStrict}) {
        const Written out = write({in.dump()}, dialect);
        EXPECT_EQ(out.told, "");
        std::size_t slits = 0;
        std::size_t nowhere = 0;
        for (std::size_t frame : {std::size_t{0}, std::size_t{1}}) {
            const json one = whole(out.file, frame);
            if (one.at("frame_classes").at(0) != "creasePattern") continue;
            const std::vector<Vec3> at = corners(one);
            ASSERT_EQ(one.at("vertices_abc:id").size(), at.size());
            for (std::size_t i = 0; i < at.size(); ++i) {
                const json& id = one.at("vertices_abc:id").at(i);
                nowhere += id.is_null() ? 1 : 0;
                // Where the slit crosses a fold there was no corner.
                if (id.is_null()) {
                    EXPECT_EQ(at[i].y, 100.0);
                }
                if (!id.is_null()) {
                    EXPECT_EQ(id, id_of(at[i]));
                }
            }
            ASSERT_EQ(one.at("edges_abc:line").size(), one.at("edges_vertices").size());
            for (std::size_t i = 0; i < one.at("edges_vertices").size(); ++i) {
                const auto [u, v] = one.at("edges_vertices").at(i).get<Pair>();
                ASSERT_FALSE(one.at("edges_abc:line").at(i).is_null()) << id_of(at[u]) << ' ' << id_of(at[v]);
                const auto line = one.at("edges_abc:line").at(i).get<std::vector<std::vector<double>>>();
                const Segment whole_line{{line[0][0], line[0][1]}, {line[1][0], line[1][1]}};
                EXPECT_LE(distance(Vec2{at[u].x, at[u].y}, whole_line), 1e-6);
                EXPECT_LE(distance(Vec2{at[v].x, at[v].y}, whole_line), 1e-6);
                slits += line[0][1] == 100.0 ? 1 : 0;
            }
        }
        EXPECT_GT(slits, 7U);
        EXPECT_GT(nowhere, 6U);
    }
}

TEST(FoldDialect, FacesThatShareAPlaceOfCornersKeepTheirOwn) {
    // Two halves drawn with a slit between them open: its corners and edges are there twice.
    const json in = json::parse(R"({"frame_unit": "mm",
"vertices_coords": [[0,0],[40,0],[40,30],[40,60],[0,60],[40,0],[80,0],[80,60]],
"vertices_abc:id": ["a","left","top","b","c","right","d","e"],
"edges_vertices": [[0,1],[1,2],[2,3],[3,4],[4,0],[5,6],[6,7],[7,3],[5,2]],
"edges_abc:id": ["p","left","fold","q","r","s","t","u","right"],
"edges_assignment": ["B","B","V","B","B","B","B","B","B"],
"faces_vertices": [[0,1,2,3,4],[5,6,7,3,2]], "faces_abc:id": ["left","right"]})");
    const json out = write({in.dump()}).file;
    const auto ids = out.at("vertices_abc:id").get<std::multiset<std::string>>();
    EXPECT_EQ(ids, in.at("vertices_abc:id").get<std::multiset<std::string>>());
    EXPECT_EQ(out.at("edges_abc:id").get<std::multiset<std::string>>(),
              in.at("edges_abc:id").get<std::multiset<std::string>>());
    const std::vector<Vec3> at = corners(out);
    for (std::size_t f = 0; f < 2; ++f) {
        const auto face = out.at("faces_vertices").at(f).get<std::vector<std::size_t>>();
        for (const std::size_t v : face) {
            const json& id = out.at("vertices_abc:id").at(v);
            if (id == "left" || id == "right") {
                EXPECT_EQ(id, out.at("faces_abc:id").at(f));
            }
        }
    }
}

TEST(FoldDialect, ValuesComeOutAsTheyWereWritten) {
    const std::string values = R"({"x": [1e5, 1.50, "a b\" ,]}", {}, [], true, null], "y": -0})";
    const std::string text = std::string(R"({"abc:v" :  )") + values +
                             R"( , "file_note": "n" ,"frame_unit": "mm", "frame_author": "Ann",
"vertices_coords": [[0,0],[8,0],[8,8],[0,8],[4,0],[4,8]],
"edges_vertices": [[0,4],[4,1],[1,2],[2,5],[5,3],[3,0],[4,5]],
"edges_assignment": ["B","B","B","B","B","B","V"], "faces_abc:none": [1]})";
    std::vector<Source> sources{{"sheet.fold", text}};
    CompileOptions options;
    options.until = Stage::assembly;
    const Compilation run = compile(std::move(sources), options, {});
    const CompiledDesign& one = run.designs.front();
    const SceneCard scene{&*one.assembly, nullptr, "", &*one.creases};
    Diagnostics diagnostics;
    const std::string out = write_fold(std::span(&scene, 1), {}, diagnostics).value();
    EXPECT_NE(out.find(R"("abc:v": {"x":[1e5,1.50,"a b\" ,]}",{},[],true,null],"y":-0})"), std::string::npos);
    EXPECT_NE(out.find(R"("file_note": "n")"), std::string::npos);
    EXPECT_NE(out.find(R"("frame_author": "Ann")"), std::string::npos);
    EXPECT_NE(findings(diagnostics).find("faces_abc:none"), std::string::npos);
}

TEST(FoldDialect, SeveralFilesInOneLoseTheirKeysAndAreTold) {
    const std::string keyed = std::string(R"({"abc:key": 1, )") + (kTray + 1);
    const Written out = write({keyed, kTray});
    EXPECT_FALSE(out.file.contains("abc:key"));
    EXPECT_NE(out.told.find("sheet-1.fold"), std::string::npos);
    EXPECT_NE(out.told.find("abc:key"), std::string::npos);
    EXPECT_EQ(out.told.find("sheet-2.fold"), std::string::npos);
}

// Three folds in a corner: the panels bend, and a program that reads the file is to fold what was drawn.
TEST(FoldDialect, BendsOfPanelsAreNoFolds) {
    const std::string text = R"({"frame_unit": "mm",
"vertices_coords": [[0,0],[80,0],[80,80],[0,80],[40,40],[40,0]],
"edges_vertices": [[0,5],[5,1],[1,2],[2,3],[3,0],[4,5],[4,2],[4,3]],
"edges_assignment": ["B","B","B","B","B","V","V","M"]})";
    for (const FoldDialect dialect : {kSimulator, kStrict}) {
        const json file = write({text}, dialect).file;
        int folds = 0;
        int bends = 0;
        for (std::size_t i = 0; i < file.at("edges_assignment").size(); ++i) {
            const std::string letter = file.at("edges_assignment")[i];
            folds += letter == "M" || letter == "V" ? 1 : 0;
            bends += letter == "F" ? 1 : 0;
            EXPECT_NE(letter, "U");
            if (letter == "F") {
                EXPECT_EQ(file.at("edges_foldAngle")[i], 0.0);
            }
        }
        EXPECT_EQ(folds, 3);
        EXPECT_GT(bends, 0);
        double most = 0.0;  // as it is folded
        const json& last = file.at("file_frames").front().at("edges_foldAngle");
        for (std::size_t i = 0; i < last.size(); ++i) {
            if (file.at("edges_assignment")[i] == "F") most = std::max(most, std::abs(last[i].get<double>()));
        }
        EXPECT_GT(most, 20.0);
    }
}

}  // namespace
}  // namespace popup::test
