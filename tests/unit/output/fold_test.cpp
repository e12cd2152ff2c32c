// Guarantees of FOLD files: the mesh is a manifold that is the paper, holds together where the paper does and
// nowhere else, and in every folded frame each face is the rigid plate that it is in the pattern.
#include "output/fold.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>

#include "popup/compile.h"
#include "support/designs.h"

namespace popup::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct Model {
    std::string name;
    Assembly assembly;
    Motion motion;
};

Model model_of(const std::string& name, const Design& design, std::vector<Angle> angles = {}) {
    MotionOptions options;
    options.angles = std::move(angles);
    options.examine = false;
    Built built = build(design);
    Model model{name, std::move(*built.assembly), {}};
    auto motion = simulate(model.assembly, options, built.diagnostics);
    if (!motion) ADD_FAILURE() << findings(built.diagnostics);
    if (motion) model.motion = *motion;
    return model;
}

Design two_elements() {
    Design design = card(200, 200);
    add(design, "step", {{-40, 40}, {-40, 90}, {20, 40}, {20, 90}});
    add(design, "v-fold", {{-60, 20}, {0, -20}, {60, 20}, {-62, 36}, {0, 0}, {62, 36}, {62, 80}, {-62, 80}});
    return design;
}

// The file's content, read without the writer's help.
struct Edge {
    std::size_t u = 0, v = 0;
    std::string letter;
    int left = -1, right = -1;  // faces that have it as u → v and as v → u
};
struct FoldFile {
    std::unique_ptr<const json> text;
    std::vector<std::vector<double>> flat;
    std::vector<Edge> edges;
    std::vector<std::vector<std::size_t>> faces;
    std::vector<std::string> plates, pieces;
};

std::string fold_of(const std::vector<SceneCard>& cards) {
    Diagnostics diagnostics;
    const auto text = write_fold(cards, {}, diagnostics);
    EXPECT_TRUE(text.has_value()) << findings(diagnostics);
    EXPECT_FALSE(diagnostics.has_findings());
    return text.value_or("{}");
}

// Reads, and checks what any reader relies on: numbers of vertices, one edge a pair, faces on its sides.
FoldFile read(const std::string& text) {
    FoldFile file;
    file.text = std::make_unique<const json>(json::parse(text));
    file.flat = file.text->at("vertices_coords").get<std::vector<std::vector<double>>>();
    for (const auto& p : file.flat) EXPECT_EQ(p.size(), 2U);
    std::map<std::pair<std::size_t, std::size_t>, std::size_t> known;
    for (const auto& row : file.text->at("edges_vertices")) {
        Edge edge;
        EXPECT_EQ(row.size(), 2U);
        edge.u = row.at(0).get<std::size_t>();
        edge.v = row.at(1).get<std::size_t>();
        EXPECT_LT(std::max(edge.u, edge.v), file.flat.size());
        EXPECT_TRUE(known.emplace(std::minmax({edge.u, edge.v}), file.edges.size()).second)
            << "edge " << edge.u << ' ' << edge.v << " twice";
        edge.letter = file.text->at("edges_assignment").at(file.edges.size()).get<std::string>();
        file.edges.push_back(edge);
    }
    EXPECT_EQ(file.text->at("edges_assignment").size(), file.edges.size());
    file.faces = file.text->at("faces_vertices").get<std::vector<std::vector<std::size_t>>>();
    file.plates = file.text->at("faces_popupc:plate").get<std::vector<std::string>>();
    file.pieces = file.text->at("faces_popupc:piece").get<std::vector<std::string>>();
    EXPECT_EQ(file.plates.size(), file.faces.size());
    EXPECT_EQ(file.pieces.size(), file.faces.size());
    for (std::size_t f = 0; f < file.faces.size(); ++f) {
        const auto& face = file.faces[f];
        EXPECT_GE(face.size(), 3U);
        for (std::size_t i = 0; i < face.size(); ++i) {
            const std::size_t u = face[i];
            const std::size_t v = face[(i + 1) % face.size()];
            const auto found = known.find(std::minmax({u, v}));
            if (found == known.end()) {
                ADD_FAILURE() << "no edge " << u << ' ' << v;
                continue;
            }
            Edge& edge = file.edges[found->second];
            int& side = edge.u == u ? edge.left : edge.right;
            EXPECT_EQ(side, -1) << "two faces on one side of " << u << ' ' << v;
            side = static_cast<int>(f);
        }
    }
    return file;
}

Vec2 flat(const FoldFile& file, std::size_t v) { return {file.flat[v][0], file.flat[v][1]}; }

double flat_area(const FoldFile& file, std::size_t f) {
    double twice = 0.0;
    const auto& face = file.faces[f];
    for (std::size_t i = 0; i < face.size(); ++i)
        twice += cross(flat(file, face[i]), flat(file, face[(i + 1) % face.size()]));
    return 0.5 * twice;
}

// Marks for union and find, the short way.
std::size_t root(std::vector<std::size_t>& same, std::size_t i) {
    while (same[i] != i) i = same[i] = same[same[i]];
    return i;
}

// A surface of faces, sides and boundary loops: V - E + F = 2 - loops for every sheet of paper.
void check_topology(const FoldFile& file) {
    std::vector<std::size_t> sheet(file.faces.size());
    for (std::size_t f = 0; f < sheet.size(); ++f) sheet[f] = f;
    std::map<std::size_t, std::size_t> after;  // along the boundary, paper on the left
    for (const Edge& edge : file.edges) {
        const bool border = edge.letter == "B";
        if (border) {
            EXPECT_NE(edge.left < 0, edge.right < 0) << "a B edge has one face";
            const bool forward = edge.left >= 0;
            // One boundary goes through a vertex at most: sheets that only touch in a point do not share it.
            EXPECT_TRUE(after.emplace(forward ? edge.u : edge.v, forward ? edge.v : edge.u).second);
        } else {
            EXPECT_TRUE(edge.letter == "M" || edge.letter == "V" || edge.letter == "F") << edge.letter;
            ASSERT_TRUE(edge.left >= 0 && edge.right >= 0) << "an inner edge has two faces";
            const auto a = root(sheet, static_cast<std::size_t>(edge.left));
            sheet[a] = root(sheet, static_cast<std::size_t>(edge.right));
            EXPECT_EQ(edge.letter == "F", file.plates[static_cast<std::size_t>(edge.left)] ==
                                              file.plates[static_cast<std::size_t>(edge.right)]);
        }
        EXPECT_GE(distance(flat(file, edge.u), flat(file, edge.v)), 0.9e-6);
    }
    std::map<std::size_t, int> euler;
    std::vector<std::set<std::size_t>> sheets_of(file.flat.size());
    std::vector<std::map<std::size_t, std::size_t>> fan(file.flat.size());
    for (std::size_t f = 0; f < file.faces.size(); ++f) {
        ++euler[root(sheet, f)];
        for (const std::size_t v : file.faces[f]) sheets_of[v].insert(root(sheet, f));
    }
    for (std::size_t v = 0; v < sheets_of.size(); ++v) {
        ASSERT_EQ(sheets_of[v].size(), 1U) << "a vertex belongs to one sheet of paper";
        ++euler[*sheets_of[v].begin()];
    }
    for (const Edge& edge : file.edges) --euler[*sheets_of[edge.u].begin()];
    std::set<std::size_t> seen;
    for (const auto& [start, unused] : after) {
        if (seen.contains(start)) continue;
        for (std::size_t v = start; seen.insert(v).second;) {
            ASSERT_TRUE(after.contains(v)) << "the boundary breaks off";
            v = after.at(v);
        }
        ++euler[*sheets_of[start].begin()];
    }
    for (const auto& [unused, sum] : euler) EXPECT_EQ(sum, 2);
    // Sheets are the pieces.
    std::map<std::size_t, std::string> piece_of;
    for (std::size_t f = 0; f < file.faces.size(); ++f) {
        EXPECT_EQ(piece_of.emplace(root(sheet, f), file.pieces[f]).first->second, file.pieces[f]);
    }
    EXPECT_EQ(piece_of.size(), std::set(file.pieces.begin(), file.pieces.end()).size());
}

double around_ring(const Ring& ring) {
    double sum = 0.0;
    for (std::size_t i = 0; i < ring.size(); ++i) sum += distance(ring[i], ring[(i + 1) % ring.size()]);
    return sum;
}

void check_paper(const FoldFile& file, const std::vector<SceneCard>& cards) {
    std::map<std::string, double> areas;
    std::map<std::string, Box> boxes;
    for (std::size_t f = 0; f < file.faces.size(); ++f) {
        EXPECT_GT(flat_area(file, f), 0.0) << "counter-clockwise";
        areas[file.plates[f]] += flat_area(file, f);
        for (const std::size_t v : file.faces[f]) boxes[file.pieces[f]].extend(flat(file, v));
    }
    double folds = 0.0;
    double around = 0.0;
    std::size_t plates = 0;
    for (const SceneCard& card : cards) {
        for (const Plate& plate : card.assembly->plates) {
            const double wanted = area(plate.outline);
            EXPECT_NEAR(areas[card.prefix + plate.name], wanted, 1e-3) << plate.name;
            around += around_ring(plate.outline.outer);
            for (const Ring& hole : plate.outline.holes) around += around_ring(hole);
        }
        plates += card.assembly->plates.size();
        for (const Line& line : card.assembly->lines) {
            if (line.kind == LineKind::mountain || line.kind == LineKind::valley)
                folds += distance(line.at.a, line.at.b);
        }
    }
    EXPECT_EQ(areas.size(), plates);
    // Two faces hold together along all that is a fold, and nothing else; borders are all the rest of the
    // outlines, so that there is no crack within a plate.
    around -= 2.0 * folds;
    for (const Edge& edge : file.edges) {
        const double size = distance(flat(file, edge.u), flat(file, edge.v));
        if (edge.letter == "M" || edge.letter == "V") folds -= size;
        if (edge.letter == "B") around -= size;
    }
    EXPECT_NEAR(folds, 0.0, 1e-4);
    EXPECT_NEAR(around, 0.0, 1e-3);
    std::vector<std::pair<double, double>> spans;
    spans.reserve(boxes.size());
    for (const auto& [unused, box] : boxes) spans.emplace_back(box.min.x, box.max.x);
    std::sort(spans.begin(), spans.end());
    for (std::size_t i = 1; i < spans.size(); ++i)
        EXPECT_NEAR(spans[i].first - spans[i - 1].second, 10, 1e-4);
}

std::vector<Vec3> places(const json& frame) {
    std::vector<Vec3> all;
    for (const auto& p : frame.at("vertices_coords")) {
        EXPECT_EQ(p.size(), 3U);
        all.push_back({p.at(0).get<double>(), p.at(1).get<double>(), p.at(2).get<double>()});
    }
    return all;
}

Vec3 normal_of(const std::vector<std::size_t>& face, const std::vector<Vec3>& at) {
    Vec3 sum;
    for (std::size_t i = 1; i + 1 < face.size(); ++i)
        sum = sum + cross(at[face[i]] - at[face[0]], at[face[i + 1]] - at[face[0]]);
    return unit(sum);
}

// How far the right face turns up over the left one's front, from lying flat beside it.
double dihedral_deg(const FoldFile& file, const Edge& edge, const std::vector<Vec3>& at) {
    const Vec3 along = unit(at[edge.v] - at[edge.u]);
    const Vec3 left = normal_of(file.faces[static_cast<std::size_t>(edge.left)], at);
    const Vec3 right = normal_of(file.faces[static_cast<std::size_t>(edge.right)], at);
    const Vec3 into_left = cross(left, along);
    const Vec3 into_right = cross(right, -along);
    return std::atan2(dot(into_right, left), -dot(into_right, into_left)) * 180.0 / std::numbers::pi;
}

void check_folded(const FoldFile& file, const json& frame) {
    const double angle = frame.at("popupc:angle_deg").get<double>();
    SCOPED_TRACE(angle);
    EXPECT_EQ(frame.at("frame_classes"), json::array({"foldedForm"}));
    EXPECT_EQ(frame.at("frame_parent"), 0);
    EXPECT_EQ(frame.at("frame_inherit"), true);
    const std::vector<Vec3> at = places(frame);
    ASSERT_EQ(at.size(), file.flat.size());
    // Every face is where a rigid motion takes it: all its distances are those of the pattern.
    double stray = 0.0;
    double bent = 0.0;
    double highest = 0.0;
    for (const auto& face : file.faces) {
        const Vec3 normal = normal_of(face, at);
        for (std::size_t i = 0; i < face.size(); ++i) {
            bent = std::max(bent, std::abs(dot(normal, at[face[i]] - at[face[0]])));
            highest = std::max(highest, std::abs(at[face[i]].z));
            for (std::size_t k = 0; k < i; ++k) {
                const double now = distance(at[face[i]], at[face[k]]);
                stray = std::max(stray, std::abs(now - distance(flat(file, face[i]), flat(file, face[k]))));
            }
        }
    }
    EXPECT_LE(stray, 1e-5);
    EXPECT_LE(bent, 1e-5);
    EXPECT_EQ(frame.at("frame_attributes").at(0), highest == 0.0 ? "2D" : "3D");
    const auto& told = frame.at("edges_foldAngle");
    ASSERT_EQ(told.size(), file.edges.size());
    for (std::size_t i = 0; i < file.edges.size(); ++i) {
        const Edge& edge = file.edges[i];
        const double fold = told.at(i).get<double>();
        if (edge.letter != "M" && edge.letter != "V") {
            EXPECT_EQ(fold, 0.0);
            continue;
        }
        const double sign = edge.letter == "V" ? 1.0 : -1.0;
        EXPECT_GE(sign * fold, 0.0);
        const double measured = dihedral_deg(file, edge, at);
        EXPECT_NEAR(std::remainder(measured - fold, 360.0), 0.0, 2e-3);
        if (angle > 30.0 && angle < 150.0) {
            EXPECT_GT(sign * measured, 0.0) << edge.u << ' ' << edge.v;
        }
    }
}

// The base planes go where the card's definition says; open they lie as in the pattern, with all that is cut
// out of them.
void check_card(const FoldFile& file, const json& frame, const Model& model) {
    const double half = frame.at("popupc:angle_deg").get<double>() * std::numbers::pi / 360.0;
    const std::vector<Vec3> at = places(frame);
    const Box page = [&] {
        Box box;
        for (const Plate& plate : model.assembly.plates) {
            if (plate.piece != 0) continue;
            for (const Vec2 p : plate.outline.outer) box.extend(p);
        }
        return box;
    }();
    for (std::size_t f = 0; f < file.faces.size(); ++f) {
        const bool base = file.plates[f] == "page/left" || file.plates[f] == "page/right";
        if (!base && !(file.pieces[f] == "page" && half == 0.5 * std::numbers::pi)) continue;
        for (const std::size_t v : file.faces[f]) {
            const Vec2 p = flat(file, v) + page.min;
            const Vec3 wanted{p.x * std::sin(half), p.y, std::abs(p.x) * std::cos(half)};
            EXPECT_LE(distance(at[v], wanted), 1e-5) << file.plates[f];
        }
    }
}

void check_all(const Model& model) {
    SCOPED_TRACE(model.name);
    const std::vector<SceneCard> cards{{&model.assembly, &model.motion, ""}};
    const FoldFile file = read(fold_of(cards));
    check_topology(file);
    check_paper(file, cards);
    if (testing::Test::HasFatalFailure()) return;
    ASSERT_EQ(file.text->at("file_frames").size(), model.motion.angles.size());
    for (const json& frame : file.text->at("file_frames")) {
        check_folded(file, frame);
        check_card(file, frame, model);
    }
}

TEST(Fold, EverySampleIsAManifoldThatFoldsRigidly) {
    int seen = 0;
    for (const auto& entry : fs::directory_iterator(fs::path(POPUP_SOURCE_DIR) / "samples")) {
        if (entry.path().extension() != ".xml") continue;
        Diagnostics diagnostics;
        auto source = read_source(entry.path(), diagnostics);
        ASSERT_TRUE(source);
        CompileOptions options;
        options.until = Stage::motion;
        options.motion.examine = false;
        Compilation all = compile({*source}, options, {});
        ASSERT_TRUE(all.designs[0].motion) << findings(all.designs[0].diagnostics);
        check_all({entry.path().filename(), *all.designs[0].assembly, *all.designs[0].motion});
        ++seen;
    }
    EXPECT_GE(seen, 12);
}

TEST(Fold, GeneratedDesignsAreManifoldsThatFoldRigidly) {
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
        check_all(model_of("seed " + std::to_string(seed), generate(seed, 20)));
    }
    check_all(model_of("row", row(30)));
}

TEST(Fold, KeyFrameIsTheCreasePatternAndTheFileSaysWhatItIs) {
    const Model model = model_of("two", two_elements(), {{0.0}, {22.5}, {180.0}});
    const json file = json::parse(fold_of({{&model.assembly, &model.motion, ""}}));
    EXPECT_EQ(file.at("file_spec"), 1.2);
    EXPECT_TRUE(file.at("file_creator").get<std::string>().starts_with("popupc "));
    EXPECT_EQ(file.at("file_title"), "card");
    EXPECT_EQ(file.at("file_classes"), json::array({"singleModel"}));
    EXPECT_EQ(file.at("frame_classes"), json::array({"creasePattern"}));
    EXPECT_EQ(file.at("frame_attributes"),
              json::array({"2D", "manifold", "orientable", "noCuts", "noJoins", "nonConvexFaces"}));
    EXPECT_EQ(file.at("frame_unit"), "mm");
    EXPECT_EQ(file.at("edges_foldAngle"), file.at("file_frames").at(0).at("edges_foldAngle"));
    std::vector<std::string> titles;
    for (const json& frame : file.at("file_frames")) titles.push_back(frame.at("frame_title"));
    EXPECT_EQ(titles, (std::vector<std::string>{"open 0°", "open 22.5°", "open 180°"}));
    for (const auto& [key, value] : file.items()) {
        EXPECT_TRUE(key.find("author") == std::string::npos && key.find("date") == std::string::npos) << key;
    }
}

// A step on the gutter: three folds and what is left of the gutter, and two slits that end at its side folds.
TEST(Fold, StepHasTheVerticesItsPaperHas) {
    Design design = card(200, 200);
    add(design, "step", {{-40, -30}, {-40, 30}, {40, -30}, {40, 30}});
    const Model model = model_of("step", design);
    const FoldFile file = read(fold_of({{&model.assembly, &model.motion, ""}}));
    // The page's four corners and the gutter's two ends; four corners of the step; and where both slits cross
    // the gutter, one vertex of the gutter and one of the centre fold, which lies on it in the pattern.
    EXPECT_EQ(file.flat.size(), 14U);
    EXPECT_EQ(file.faces.size(), 4U);
    std::map<std::string, int> letters;
    for (const Edge& edge : file.edges) ++letters[edge.letter];
    EXPECT_EQ(letters, (std::map<std::string, int>{{"B", 14}, {"M", 1}, {"V", 4}}));
    check_all(model);
}

TEST(Fold, GluedSeamsAreBordersOfTheirPieceAndItsVerticesAreItsOwn) {
    Design design = card();
    add(design, "v-fold", {{-60, 20}, {0, -20}, {60, 20}, {-62, 36}, {0, 0}, {62, 36}, {62, 80}, {-62, 80}});
    const Model model = model_of("v-fold", design);
    const FoldFile file = read(fold_of({{&model.assembly, &model.motion, ""}}));
    // Two rectangles with a gutter, and two quadrilaterals with a fold; glue adds no edges.
    EXPECT_EQ(file.flat.size(), 12U);
    EXPECT_EQ(file.edges.size(), 14U);
    // Two points of the piece lie on the base all the same, in every frame: both ends of each seam.
    const auto frame = file.text->at("file_frames").at(18);
    const auto at = places(frame);
    int on_base = 0;
    for (std::size_t f = 0; f < 2; ++f) {
        ASSERT_TRUE(file.pieces[f] == "page");
        const Vec3 normal = normal_of(file.faces[f], at);
        for (std::size_t v = 6; v < 12; ++v) {
            on_base += std::abs(dot(normal, at[v] - at[file.faces[f][0]])) < 1e-5 ? 1 : 0;
        }
    }
    EXPECT_EQ(on_base, 4) << "the apex lies on both sides";
}

// A wide plate that holds two narrower ones, each along a part of its one long edge.
Assembly comb() {
    Assembly assembly;
    assembly.stem = "comb";
    assembly.pieces = {{"comb", {0, 1, 2}}};
    const auto plate = [](const char* name, Ring outer) {
        Plate made;
        made.name = name;
        made.outline.outer = std::move(outer);
        return made;
    };
    assembly.plates = {plate("back", {{0, 0}, {10, 0}, {10, 5}, {0, 5}}),
                       plate("left", {{0, -5}, {4, -5}, {4, 0}, {0, 0}}),
                       plate("right", {{6, -5}, {12, -5}, {12, 0}, {6, 0}})};
    assembly.hinges = {{0, 1, {{0, 0}, {4, 0}}, {{0, 0}, {4, 0}}, false},
                       {2, 0, {{0, 0}, {12, 0}}, {{0, 0}, {12, 0}}, false}};
    assembly.lines = {{LineKind::valley, {{0, 0}, {4, 0}}, 0, 0, 1},
                      {LineKind::mountain, {{6, 0}, {10, 0}}, 0, 2, 0}};
    return assembly;
}

TEST(Fold, EdgesThatShareAPartOfAFoldAreSplitThere) {
    const Assembly assembly = comb();
    const std::vector<SceneCard> cards{{&assembly, nullptr, ""}};
    const FoldFile file = read(fold_of(cards));
    check_topology(file);
    check_paper(file, cards);
    EXPECT_FALSE(file.text->contains("file_frames"));
    std::vector<std::size_t> sizes;
    for (const auto& face : file.faces) sizes.push_back(face.size());
    EXPECT_EQ(sizes, (std::vector<std::size_t>{6, 4, 5}));
    EXPECT_EQ(file.flat.size(), 11U);
}

// A plate with two holes whose outer edge is a fold: triangles that are one plate again by their joins.
TEST(Fold, PlatesWithHolesAreJoinedTriangles) {
    Assembly assembly = comb();
    assembly.plates[0].outline.holes = {{{1, 1}, {1, 2}, {3, 2}, {3, 1}}, {{5, 1}, {5, 4}, {8, 4}, {8, 1}}};
    const std::vector<SceneCard> cards{{&assembly, nullptr, ""}};
    const FoldFile file = read(fold_of(cards));
    check_topology(file);
    check_paper(file, cards);
    EXPECT_GT(file.faces.size(), 10U);
    EXPECT_EQ(file.flat.size(), 19U);
    EXPECT_EQ(file.text->at("frame_attributes").at(4), "noJoins");
}

// So large a polygon is cut along lines before it is triangulated, with corners inside other triangles'
// edges.
TEST(Fold, LargePlatesWithHolesHaveNoCracks) {
    Assembly assembly = comb();
    Polygon& outline = assembly.plates[0].outline;
    outline.outer.assign({{0, 0}, {10, 0}});
    for (int i = 0; i <= 400; ++i) {
        const double t = std::numbers::pi * i / 400;
        outline.outer.push_back({5 + 5 * std::cos(t), 3 + (3 + 0.3 * std::cos(40 * t)) * std::sin(t) + 1e-7});
    }
    for (int n = 0; n < 3; ++n) {
        Ring hole;
        for (int i = 0; i < 150; ++i) {
            const double t = -2.0 * std::numbers::pi * i / 150;
            hole.push_back({2 + 2.5 * n + 0.9 * std::cos(t), 2 + 0.7 * std::sin(t)});
        }
        outline.holes.push_back(std::move(hole));
    }
    const std::vector<SceneCard> cards{{&assembly, nullptr, ""}};
    const FoldFile file = read(fold_of(cards));
    check_topology(file);
    check_paper(file, cards);
}

TEST(Fold, CornersThatDifferByRoundingAreOneAndNoEdgeIsWithoutLength) {
    Assembly assembly = comb();
    assembly.plates[1].outline.outer = {{0, -5}, {4, -5}, {4, -1e-9}, {4, 1e-9}, {1e-9, 0}};
    const std::vector<SceneCard> cards{{&assembly, nullptr, ""}};
    const FoldFile file = read(fold_of(cards));
    check_topology(file);
    check_paper(file, cards);
    EXPECT_EQ(file.flat.size(), 11U);
}

TEST(Fold, SeveralCardsStandSideBySideInEveryFrame) {
    const Model a = model_of("a", two_elements(), {{0.0}, {90.0}});
    const Model b = model_of("b", generate(3, 8), {{90.0}, {180.0}});
    const Assembly c = comb();
    const std::vector<SceneCard> cards{{&a.assembly, &a.motion, "a:"}, {&b.assembly, &b.motion, "b:\xff"}};
    const FoldFile file = read(fold_of(cards));
    check_topology(file);
    EXPECT_EQ(file.text->at("file_classes"), json::array({"multiModel"}));
    EXPECT_EQ(file.text->at("file_title"), "card, card");
    EXPECT_EQ(file.plates.front(), "a:page/left");
    EXPECT_EQ(file.plates[a.assembly.plates.size()], "b:\xEF\xBF\xBDpage/left");
    double nearest = HUGE_VAL;
    std::vector<double> angles;
    double right = -HUGE_VAL;
    double left = HUGE_VAL;
    for (const json& frame : file.text->at("file_frames")) {
        check_folded(file, frame);
        angles.push_back(frame.at("popupc:angle_deg"));
        const auto at = places(frame);
        for (std::size_t f = 0; f < file.faces.size(); ++f) {
            for (const std::size_t v : file.faces[f]) {
                if (file.plates[f].starts_with("a:")) right = std::max(right, at[v].x);
                if (file.plates[f].starts_with("b:")) left = std::min(left, at[v].x);
            }
        }
        nearest = std::min(nearest, left - right);
    }
    EXPECT_EQ(angles, (std::vector<double>{0.0, 90.0, 180.0}));
    EXPECT_NEAR(nearest, 20.0, 1e-4);
}

TEST(Fold, CardsWithoutMotionAreCreasePatterns) {
    Model model = model_of("two", two_elements());
    model.motion.angles.clear();
    for (const Motion* motion : {static_cast<const Motion*>(nullptr), &std::as_const(model.motion)}) {
        const std::vector<SceneCard> cards{{&model.assembly, motion, ""}};
        const FoldFile file = read(fold_of(cards));
        check_topology(file);
        check_paper(file, cards);
        EXPECT_FALSE(file.text->contains("file_frames"));
    }
}

TEST(Fold, SameInputGivesTheSameBytes) {
    const Model model = model_of("seed 5", generate(5, 16));
    const SceneCard card{&model.assembly, &model.motion, ""};
    const std::string text = fold_of({card, card});
    EXPECT_EQ(text, fold_of({card, card}));
    EXPECT_EQ(text.find("-0.0,"), std::string::npos);
    EXPECT_EQ(text.find("null"), std::string::npos);
}

TEST(Fold, LinkageThatCannotReachAnAngleAndTooManyAnglesAreErrors) {
    Design design = card(200, 200);
    add(design, "tent", {{-20, 30}, {-20, 55}, {20, 30}, {20, 55}, {-30, 0}, {-30, 25}, {30, 0}, {30, 25}});
    Model model = model_of("tent", design);
    const SceneCard scene{&model.assembly, &model.motion, ""};
    const auto code_of = [&scene] {
        Diagnostics diagnostics;
        EXPECT_FALSE(write_fold({&scene, 1}, {}, diagnostics).has_value());
        return diagnostics.sorted().at(0).code;
    };
    auto& bars = std::get<FourBar>(model.assembly.joints.back().how);
    const Bar kept = bars.left;
    bars.left.far = 0.01;
    EXPECT_EQ(code_of(), "locks");
    bars.left = kept;
    model.motion.angles.clear();
    for (int i = 0; i < 4000000; ++i) model.motion.angles.push_back({i * 4e-5});
    EXPECT_EQ(code_of(), "model-too-large");
}

}  // namespace
}  // namespace popup::test
