// Folded parts: that their nets, folded along their creases by their angles, are what the turtle drew.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <string>
#include <vector>

#include "base/geometry/regions.h"
#include "input/flatlang/pieces/pieces.h"
#include "support/designs.h"
#include "support/random.h"
#include "support/trails.h"

namespace popup {
namespace {

using test::Random;
using test::TrailMaker;

constexpr double kInch = 25.4;
constexpr double kNearMm = 0.05;

using Solid = std::vector<std::vector<Vec3>>;  // faces, in inches

// --- folding paper, without anything of the code that unfolds

// A turn about a line and a shift, as a function of points.
struct Motion3 {
    std::array<Vec3, 3> axes{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
    Vec3 shift;
    [[nodiscard]] Vec3 turn(Vec3 p) const { return p.x * axes[0] + p.y * axes[1] + p.z * axes[2]; }
    [[nodiscard]] Vec3 operator()(Vec3 p) const { return turn(p) + shift; }
};

// Rodrigues' formula.
Vec3 turned(Vec3 p, Vec3 axis, double angle) {
    return std::cos(angle) * p + std::sin(angle) * cross(axis, p) +
           (1 - std::cos(angle)) * dot(axis, p) * axis;
}

Motion3 about(Vec2 a, Vec2 b, double angle) {
    const Vec3 from{a.x, a.y, 0};
    const Vec3 axis = unit(Vec3{b.x - a.x, b.y - a.y, 0});
    Motion3 motion;
    for (Vec3& one : motion.axes) one = turned(one, axis, angle);
    motion.shift = from - motion.turn(from);
    return motion;
}

Motion3 after(const Motion3& first, const Motion3& then) {
    Motion3 both;
    for (std::size_t k = 0; k < 3; ++k) both.axes.at(k) = then.turn(first.axes.at(k));
    both.shift = then(first.shift);
    return both;
}

// The faces of a piece: its paper without hairs along its creases and cuts.
std::vector<Polygon> faces_of(const FlatPart& part, double hair) {
    std::vector<Polygon> hairs;
    const auto add = [&](Vec2 a, Vec2 b) {
        const Vec2 along = unit(b - a);
        const Vec2 aside = hair * left_of(along);
        const Vec2 on = 5.0 * hair * along;
        hairs.push_back({{a - on - aside, b + on - aside, b + on + aside, a - on + aside}, {}});
    };
    for (const FlatLine& line : part.lines) add(line.points.front(), line.points.back());
    for (const auto& slit : part.slits) add(slit.front(), slit.back());
    return subtract(part.paper, hairs);
}

int face_at(const std::vector<Polygon>& faces, Vec2 p) {
    for (std::size_t i = 0; i < faces.size(); ++i) {
        if (contains(faces[i], p)) return static_cast<int>(i);
    }
    return -1;
}

// The corners of a ring where it turns; those that hairs have left beside one another are one.
std::vector<Vec2> corners_of(const Ring& ring, double hair) {
    const double blunt = std::max(0.01, 8.0 * hair);
    std::vector<Vec2> apart;
    for (const Vec2 p : ring) {
        if (apart.empty() || distance(apart.back(), p) > blunt) apart.push_back(p);
    }
    while (apart.size() > 1 && distance(apart.back(), apart.front()) <= blunt) apart.pop_back();
    std::vector<Vec2> corners;
    for (std::size_t i = 0; i < apart.size(); ++i) {
        const Vec2 before = apart[(i + apart.size() - 1) % apart.size()];
        const Vec2 after = apart[(i + 1) % apart.size()];
        if (distance(apart[i], {before, after}) > blunt) corners.push_back(apart[i]);
    }
    return corners;
}

// Each face's outline as it stands when `first`, which holds a point of the page, stands as `frame` has it.
std::vector<std::vector<Vec3>> folded(const FlatPart& part, Vec2 inside_first, const Frame& frame,
                                      double hair) {
    const std::vector<Polygon> faces = faces_of(part, hair);
    std::vector<Motion3> motions(faces.size());
    std::vector<char> known(faces.size(), 0);
    const int first = face_at(faces, inside_first);
    EXPECT_GE(first, 0);
    if (first < 0) return {};
    std::deque<int> waiting{first};
    known[static_cast<std::size_t>(first)] = 1;
    while (!waiting.empty()) {
        const int from = waiting.front();
        waiting.pop_front();
        for (const FlatLine& line : part.lines) {
            Vec2 a = line.points.front();
            Vec2 b = line.points.back();
            const Vec2 aside = 0.02 * left_of(unit(b - a));
            const Vec2 middle = lerp(a, b, 0.5);
            int left = face_at(faces, middle + aside);
            int right = face_at(faces, middle - aside);
            if (right == from) {
                std::swap(left, right);
                std::swap(a, b);
            }
            if (left != from || right < 0 || known[static_cast<std::size_t>(right)] != 0) continue;
            // What lies on the right of a line comes up when it is turned against the line's direction.
            const double angle = line.fold_angle.value_or(0.0) * (line.kind == LineKind::valley ? -1.0 : 1.0);
            motions[static_cast<std::size_t>(right)] =
                after(about(a, b, angle), motions[static_cast<std::size_t>(from)]);
            known[static_cast<std::size_t>(right)] = 1;
            waiting.push_back(right);
        }
    }
    std::vector<std::vector<Vec3>> result;
    for (std::size_t i = 0; i < faces.size(); ++i) {
        EXPECT_NE(known[i], 0) << "a face hangs on nothing";
        std::vector<Vec3> points;
        for (const Vec2 p : corners_of(faces[i].outer, hair)) {
            const Vec3 at = motions[i]({p.x, p.y, 0});
            points.push_back(frame.origin + at.x * frame.axes[0] + at.y * frame.axes[1] +
                             at.z * frame.axes[2]);
        }
        result.push_back(std::move(points));
    }
    return result;
}

bool same_points(const std::vector<Vec3>& a, const std::vector<Vec3>& inches) {
    if (a.size() != inches.size()) return false;
    return std::all_of(inches.begin(), inches.end(), [&](Vec3 p) {
        return std::any_of(a.begin(), a.end(), [&](Vec3 q) { return distance(kInch * p, q) < kNearMm; });
    });
}

double area_of(const std::vector<Vec3>& points) {
    Vec3 sum;
    for (std::size_t i = 0; i < points.size(); ++i) {
        sum = sum + cross(points[i] - points[0], points[(i + 1) % points.size()] - points[0]);
    }
    return 0.5 * length(sum);
}

struct Checked {
    std::size_t parts = 0;
    std::size_t folds = 0;
};

// That the nets of these faces fold to them, each once, and have their area.
Checked check_net(const Solid& solid, const std::string& about_it, double hair = 1e-4) {
    SCOPED_TRACE(about_it);
    TrailMaker maker;
    double drawn = 0.0;
    for (const auto& face : solid) {
        maker.loop(face);
        drawn += area_of(face) * kInch * kInch;
    }
    Diagnostics diagnostics("net.fl");
    const auto list = flatlang::make_parts(maker.trail, diagnostics);
    EXPECT_TRUE(list) << test::findings(diagnostics);
    if (!list) return {};
    EXPECT_TRUE(diagnostics.sorted().empty()) << test::findings(diagnostics);
    Checked checked;
    checked.parts = list->parts.size();
    double paper = 0.0;
    std::vector<int> found(solid.size(), 0);
    for (std::size_t i = 0; i < list->parts.size(); ++i) {
        const FlatPart& part = list->parts[i];
        checked.folds += part.lines.size();
        paper += area(part.paper);
        for (const FlatLine& line : part.lines) {
            EXPECT_TRUE(line.fold_angle);
            EXPECT_GT(*line.fold_angle, 0.0);
            EXPECT_LE(*line.fold_angle, M_PI);
        }
        const Vec2 inside = inner_point(part.faces.front().shape, 0.1).at;
        for (const std::vector<Vec3>& face : folded(part, inside, part.faces.front().frame, hair)) {
            int matches = 0;
            for (std::size_t k = 0; k < solid.size(); ++k) {
                if (!same_points(face, solid[k])) continue;
                ++found[k];
                ++matches;
            }
            EXPECT_EQ(matches, 1) << "a folded face of " << face.size() << " corners is none that was drawn";
        }
    }
    EXPECT_NEAR(paper, drawn, 1e-4 * drawn + 0.05);
    for (const int count : found) EXPECT_EQ(count, 1);
    return checked;
}

// --- solids

Solid moved(Solid solid, Random& random) {
    const Vec3 axis = unit(Vec3{random.unit() - 0.5, random.unit() - 0.5, random.unit() - 0.5});
    const double angle = 6.0 * random.unit();
    const Vec3 shift{20 * random.unit(), 20 * random.unit(), 20 * random.unit()};
    for (auto& face : solid) {
        for (Vec3& p : face) p = turned(p, axis, angle) + shift;
    }
    return solid;
}

// What a prism over this outline has for faces.
Solid prism(const std::vector<Vec3>& outline, Vec3 up) {
    Solid solid{outline};
    std::vector<Vec3> top;
    for (const Vec3 p : outline) top.push_back(p + up);
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const std::size_t j = (i + 1) % outline.size();
        solid.push_back({outline[i], outline[j], top[j], top[i]});
    }
    solid.push_back(top);
    return solid;
}

Solid pyramid(const std::vector<Vec3>& outline, Vec3 tip) {
    Solid solid{outline};
    for (std::size_t i = 0; i < outline.size(); ++i) {
        solid.push_back({outline[i], outline[(i + 1) % outline.size()], tip});
    }
    return solid;
}

std::vector<Vec3> ring(std::size_t corners, double radius, Random* wobble = nullptr) {
    std::vector<Vec3> points;
    for (std::size_t i = 0; i < corners; ++i) {
        const double angle = 2.0 * M_PI * static_cast<double>(i) / static_cast<double>(corners);
        const double r = wobble == nullptr ? radius : radius * (0.5 + wobble->unit());
        points.push_back({r * std::cos(angle), r * std::sin(angle), 0});
    }
    return points;
}

// The triangles of the hull of points in general position.
Solid hull(const std::vector<Vec3>& points) {
    Solid solid;
    for (std::size_t i = 0; i < points.size(); ++i) {
        for (std::size_t j = i + 1; j < points.size(); ++j) {
            for (std::size_t k = j + 1; k < points.size(); ++k) {
                const Vec3 normal = cross(points[j] - points[i], points[k] - points[i]);
                int above = 0;
                int below = 0;
                for (const Vec3 p : points) {
                    const double side = dot(normal, p - points[i]);
                    above += side > 1e-9 ? 1 : 0;
                    below += side < -1e-9 ? 1 : 0;
                }
                if (above == 0 || below == 0) solid.push_back({points[i], points[j], points[k]});
            }
        }
    }
    return solid;
}

TEST(FlatLangNets, ACubeIsACrossOfSixSquares) {
    const Checked checked = check_net(prism({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}}, {0, 0, 2}), "cube");
    EXPECT_EQ(checked.parts, 1U);
    EXPECT_EQ(checked.folds, 5U);
}

// Figure 4 of the paper.
TEST(FlatLangNets, APentahedronIsAStar) {
    const Checked checked = check_net(pyramid(ring(4, 2), {0, 0, 2}), "pentahedron");
    EXPECT_EQ(checked.parts, 1U);
    EXPECT_EQ(checked.folds, 4U);
}

TEST(FlatLangNets, PrismsAndPyramidsFoldBack) {
    Random random(7);
    for (std::size_t corners = 3; corners < 12; ++corners) {
        const Checked straight = check_net(moved(prism(ring(corners, 2), {0, 0, 3}), random), "prism");
        EXPECT_EQ(straight.parts, 1U);
        EXPECT_EQ(straight.folds, corners + 1);
        check_net(moved(prism(ring(corners, 2), {0.7, 0.3, 1.5}), random), "leaning prism");
        check_net(moved(pyramid(ring(corners, 2), {0.1, 0.2, 1 + 3 * random.unit()}), random), "pyramid");
    }
}

// Bases that are not convex: walls meet in valleys and mountains.
TEST(FlatLangNets, SolidsWithInnerCornersFoldBack) {
    Random random(11);
    check_net(prism({{0, 0, 0}, {4, 0, 0}, {4, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}}, {0, 0, 2}), "L");
    for (int i = 0; i < 40; ++i) {
        const std::size_t corners = 5 + random.below(8);
        check_net(moved(prism(ring(corners, 2, &random), {0, 0, 0.5 + 2 * random.unit()}), random),
                  "star prism " + std::to_string(i));
    }
}

TEST(FlatLangNets, RandomHullsFoldBack) {
    Random random(3);
    std::size_t folds = 0;
    std::size_t faces = 0;
    for (int i = 0; i < 40; ++i) {
        std::vector<Vec3> points;
        const std::size_t count = 4 + random.below(20);
        while (points.size() < count) {
            const Vec3 p{random.unit() - 0.5, random.unit() - 0.5, random.unit() - 0.5};
            if (length(p) > 0.1) points.push_back(3.0 * unit(p));
        }
        const Solid solid = hull(points);
        const Checked checked = check_net(solid, "hull " + std::to_string(i));
        folds += checked.folds;
        faces += solid.size();
    }
    // Most hang together.
    EXPECT_GT(folds, faces * 8 / 10);
}

// A sheet that is folded round a corner in its middle comes flat again with all of its creases.
TEST(FlatLangNets, AFoldedSheetUnfoldsWithAllCreasesRoundAnInnerCorner) {
    // The corner of a Miura fold: four quarters whose angles are 360 degrees together.
    const double a = 1.1;  // the acute angle of each, in radians
    const double fold = 0.8;
    const Vec3 x{1, 0, 0};
    // Directions of the four creases from the corner, found by turning: two quarters lie in planes that are
    // turned about x by fold, the others are their mirror images.
    const Vec3 up = turned({std::cos(a), std::sin(a), 0}, x, fold);
    const Vec3 down = turned({std::cos(a), -std::sin(a), 0}, x, -fold);
    // The fourth crease makes the angle pi - a with both and lies in the plane between them.
    const double s = (std::cos(M_PI - a) - 0.0);
    const double up_x = up.x;
    const double up_z = up.z;
    // unit (p, 0, q) with p up_x + q up_z = s
    const double n = up_x * up_x + up_z * up_z;
    const double root = std::sqrt(n - s * s);
    const Vec3 one{(s * up_x + root * up_z) / n, 0, (s * up_z - root * up_x) / n};
    const Vec3 other{(s * up_x - root * up_z) / n, 0, (s * up_z + root * up_x) / n};
    // The sheet is flat along -x: that is the one that is not meant.
    const Vec3 back = distance(one, -x) > 0.1 ? one : other;
    const auto quarter = [](Vec3 p, Vec3 q) {
        return std::vector<Vec3>{{0, 0, 0}, 2 * p, 2 * p + 2 * q, 2 * q};
    };
    const Solid sheet{quarter(x, up), quarter(up, back), quarter(back, down), quarter(down, x)};
    const Checked checked = check_net(sheet, "miura");
    EXPECT_EQ(checked.parts, 1U);
    EXPECT_EQ(checked.folds, 4U);
}

TEST(FlatLangNets, FacesThatFindNoPlaceArePiecesOfTheirOwn) {
    // The mantle of a blunt cone finds room, for a ring of it is less than a full turn on the page.
    Solid band;
    for (int i = 0; i < 30; ++i) {
        const double t = 0.3 * i;
        const auto point = [](double u, double r, double z) {
            return Vec3{r * std::cos(u), r * std::sin(u), z};
        };
        band.push_back({point(t, 2, 0), point(t + 0.3, 2, 0), point(t + 0.3, 1, 1.5), point(t, 1, 1.5)});
        if (t + 0.6 > 2 * M_PI) break;
    }
    const Checked checked = check_net(band, "band");
    EXPECT_EQ(checked.parts, 1U);
    // Round this corner there are more than 360 degrees, and no face has an edge elsewhere.
    Solid saddle;
    constexpr int kLeaves = 8;
    for (int i = 0; i < kLeaves; ++i) {
        const auto spoke = [](int k) {
            const double angle = 2 * M_PI * k / kLeaves;
            return Vec3{2 * std::cos(angle), 2 * std::sin(angle), k % 2 == 0 ? 2.5 : -2.5};
        };
        saddle.push_back({{0, 0, 0}, spoke(i), spoke((i + 1) % kLeaves)});
    }
    const Checked several = check_net(saddle, "saddle");
    EXPECT_GT(several.parts, 1U);
}

TEST(FlatLangNets, WindowsOfWallsStayInThem) {
    TrailMaker maker;
    Solid house = prism({{0, 0, 0}, {6, 0, 0}, {6, 4, 0}, {0, 4, 0}}, {0, 0, 3});
    for (const auto& face : house) maker.loop(face);
    maker.loop({{1, 0, 1}, {2, 0, 1}, {2, 0, 2}, {1, 0, 2}});
    maker.loop({{4, 0, 1}, {5, 0, 1}, {5, 0, 2}, {4, 0, 2}});
    Diagnostics diagnostics("house.fl");
    const auto list = flatlang::make_parts(maker.trail, diagnostics);
    ASSERT_TRUE(list) << test::findings(diagnostics);
    ASSERT_EQ(list->parts.size(), 1U);
    ASSERT_EQ(list->parts[0].paper.size(), 1U);
    EXPECT_EQ(list->parts[0].paper[0].holes.size(), 2U);
    for (const Ring& hole : list->parts[0].paper[0].holes) {
        EXPECT_NEAR(std::abs(signed_area(hole)), kInch * kInch, 0.01);
    }
}

// Numbers of the turtle are rounded: edges that should be the same are off by what its loops may be.
TEST(FlatLangNets, RoundedNumbersFoldAsWell) {
    Random random(5);
    for (int i = 0; i < 20; ++i) {
        Solid solid = moved(prism(ring(5, 2), {0, 0, 2}), random);
        TrailMaker maker;
        for (auto& face : solid) {
            const Vec3 off{1e-4 * (random.unit() - 0.5), 1e-4 * (random.unit() - 0.5),
                           1e-4 * (random.unit() - 0.5)};
            for (Vec3& p : face) p = p + off;
        }
        const Checked checked = check_net(solid, "rounded", 4e-3);
        EXPECT_EQ(checked.parts, 1U);
        EXPECT_EQ(checked.folds, 6U);
    }
}

}  // namespace
}  // namespace popup
