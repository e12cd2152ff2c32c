// A binary glTF file as any viewer sees it: read by tinygltf, moved by glTF's own rules. Nothing of the
// library under test is used here, so that what it promises of a model can be measured from the file's
// numbers alone.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace popup::test {

using Point3 = std::array<double, 3>;  // metres

// A picture as it is laid on triangles.
struct GlbTexture {
    int width = 0, height = 0;
    std::vector<unsigned char> rgba;  // rows from the top, four bytes a pixel
};

struct GlbPart {
    Point3 color{};                             // linear light, 0 to 1
    int texture = -1;                           // index into GlbScene::textures; -1: it has one colour
    std::vector<std::array<double, 2>> places;  // of each point in its texture, from its upper left corner
    bool double_sided = false;
    std::vector<Point3> points;
    std::vector<Point3> normals;  // of each point; lines have none
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::vector<std::array<std::uint32_t, 2>> lines;  // of a part that is lines
};

struct GlbNode {
    std::string name;
    std::string plate, piece, part;  // of its extras
    int parent = -1;
    Point3 translation{};
    std::array<double, 4> rotation{0, 0, 0, 1};
    std::vector<GlbPart> parts;
    std::vector<std::array<double, 4>> turns;  // at each key; empty: does not turn
    // Where its origin is at which seconds, in place of `translation`; empty: always there.
    std::vector<std::pair<double, Point3>> places;
};

struct GlbScene {
    std::string generator;
    std::vector<GlbNode> nodes;
    std::vector<int> order;          // nodes, parents first
    std::vector<double> times;       // of the keys, seconds
    std::vector<double> angles_deg;  // of the keys, by the animation's extras
    std::vector<GlbTexture> textures;
    int channels = 0;
    int materials = 0;
};

// Reads the first scene and the animation `open`. Nothing when the file is no GLB, or breaks a rule that all
// other questions here rely on (a node with a matrix or a scale, channels of other kinds, turns with
// other times); *error then says which.
std::optional<GlbScene> read_glb(const std::string& bytes, std::string* error);

// Where a node stands in the world.
struct GlbPose {
    std::array<Point3, 3> axes{};
    Point3 origin{};
    [[nodiscard]] Point3 point(const Point3& local) const;
    [[nodiscard]] Point3 direction(const Point3& local) const;
};

// Of all nodes: at rest, at a time of the animation, at an opening angle (between keys the angle grows
// evenly).
std::vector<GlbPose> rest_pose(const GlbScene& scene);
std::vector<GlbPose> pose_at_time(const GlbScene& scene, double seconds);
std::vector<GlbPose> pose_at_angle(const GlbScene& scene, double angle_deg);

// A point that two nodes share: a corner of one's mesh that lies on the other's. Found from the file alone:
// the two are within 0.02 mm of each other at rest and at three out of four keys on the way.
struct GlbJoint {
    int a = 0, b = 0;
    Point3 in_a{}, in_b{};
};
std::vector<GlbJoint> find_joints(const GlbScene& scene);

// The largest distance, in mm, between the two images of any of the joints: at the keys, and at seven angles
// between every two keys.
struct GlbOpenings {
    double at_keys_mm = 0.0, between_keys_mm = 0.0;
    double at_deg = 0.0;  // where it is largest between
    int joint = -1;       // and which
};
GlbOpenings measure_openings(const GlbScene& scene, const std::vector<GlbJoint>& joints);

}  // namespace popup::test
