// Points, polygons and rigid frames: the few shapes every stage speaks.
//
// Unless said otherwise lengths are millimetres and angles radians. A pattern page has x right and y up; its
// front faces the viewer (+z).
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace popup {

struct Vec2 {
    double x = 0.0;
    double y = 0.0;

    friend constexpr bool operator==(const Vec2&, const Vec2&) = default;
    friend constexpr Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.y + b.y}; }
    friend constexpr Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
    friend constexpr Vec2 operator-(Vec2 a) { return {-a.x, -a.y}; }
    friend constexpr Vec2 operator*(double s, Vec2 a) { return {s * a.x, s * a.y}; }
    friend constexpr Vec2 operator*(Vec2 a, double s) { return s * a; }
};

struct Vec3 {
    double x = 0.0;
    double y = 0.0;
    double z = 0.0;

    friend constexpr bool operator==(const Vec3&, const Vec3&) = default;
    friend constexpr Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
    friend constexpr Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
    friend constexpr Vec3 operator-(Vec3 a) { return {-a.x, -a.y, -a.z}; }
    friend constexpr Vec3 operator*(double s, Vec3 a) { return {s * a.x, s * a.y, s * a.z}; }
    friend constexpr Vec3 operator*(Vec3 a, double s) { return s * a; }
};

constexpr double dot(Vec2 a, Vec2 b) { return a.x * b.x + a.y * b.y; }
constexpr double dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
// Positive when b lies counter-clockwise of a.
constexpr double cross(Vec2 a, Vec2 b) { return a.x * b.y - a.y * b.x; }
constexpr Vec3 cross(Vec3 a, Vec3 b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(Vec2 a) { return std::hypot(a.x, a.y); }
inline double length(Vec3 a) { return std::sqrt(dot(a, a)); }
inline double distance(Vec2 a, Vec2 b) { return length(b - a); }
inline double distance(Vec3 a, Vec3 b) { return length(b - a); }
// The direction of a. Precondition: a is not zero.
inline Vec2 unit(Vec2 a) { return (1.0 / length(a)) * a; }
inline Vec3 unit(Vec3 a) { return (1.0 / length(a)) * a; }
// a turned by a quarter, counter-clockwise: what lies on the left of direction a.
constexpr Vec2 left_of(Vec2 a) { return {-a.y, a.x}; }
constexpr Vec2 right_of(Vec2 a) { return {a.y, -a.x}; }
constexpr Vec2 lerp(Vec2 a, Vec2 b, double t) { return a + t * (b - a); }
// a turned counter-clockwise by `angle` radians about the origin.
Vec2 rotated(Vec2 a, double angle);

struct Segment {
    Vec2 a;
    Vec2 b;

    friend constexpr bool operator==(const Segment&, const Segment&) = default;
};

// Distance from p to the closest point of s (a degenerate segment is its point).
double distance(Vec2 p, const Segment& s);
// Smallest distance between two segments; 0 where they cross.
double distance(const Segment& s, const Segment& t);

// Axis-aligned box. A default box is empty; extending it by a point makes it that point.
struct Box {
    Vec2 min{HUGE_VAL, HUGE_VAL};
    Vec2 max{-HUGE_VAL, -HUGE_VAL};

    void extend(Vec2 p);
    [[nodiscard]] bool empty() const { return min.x > max.x; }
    [[nodiscard]] double width() const { return empty() ? 0.0 : max.x - min.x; }
    [[nodiscard]] double height() const { return empty() ? 0.0 : max.y - min.y; }
    [[nodiscard]] Vec2 centre() const { return 0.5 * (min + max); }
};

using Ring = std::vector<Vec2>;  // closed, the last point joins the first

// A region: an outer ring, counter-clockwise, and holes, clockwise.
struct Polygon {
    Ring outer;
    std::vector<Ring> holes;
};

// Signed area, positive when the ring runs counter-clockwise.
double signed_area(const Ring& ring);
// Area of the outer ring less its holes. Never negative for a well-formed polygon.
double area(const Polygon& polygon);
// The sum of their areas.
double area(const std::vector<Polygon>& polygons);
double perimeter(const Ring& ring);
Box bounds(const Ring& ring);
// True inside and on the edge, by winding number; holes are outside.
bool contains(const Polygon& polygon, Vec2 p);
// A point well inside the polygon, for labels: the best of a deterministic search (pole of inaccessibility to
// `precision` mm), and its distance to the nearest edge. Precondition: the outer ring has an area.
struct InnerPoint {
    Vec2 at;
    double clearance;
};
InnerPoint inner_point(const Polygon& polygon, double precision);

// A rigid pose: x ↦ r x + t, with r a rotation. Maps a plate's page coordinates (z = 0) into the world.
struct Frame {
    std::array<Vec3, 3> axes{Vec3{1, 0, 0}, Vec3{0, 1, 0},
                             Vec3{0, 0, 1}};  // images of the page's x, y and front
    Vec3 origin{};                            // image of the page's origin

    [[nodiscard]] Vec3 direction(Vec2 d) const { return d.x * axes[0] + d.y * axes[1]; }
    [[nodiscard]] Vec3 point(Vec2 p) const { return origin + direction(p); }
    [[nodiscard]] Vec3 normal() const { return axes[2]; }
};

// Unit quaternion (x, y, z, w) of a frame's rotation, with w ≥ 0.
std::array<double, 4> quaternion(const Frame& frame);

// The tolerances that decisions use; one set a run, passed on explicitly.
struct Tolerances {
    double rounding_mm = 0.02;   // deviations up to this are the rounding of a drawing, mended without a word
    double rounding_deg = 0.02;  // the same for angles
    double snap_mm = 5.0;        // how far a named fold may lie from the real one
    double paper_mm = 1.0;       // paper that must remain around a cut
    double min_length_mm = 1.0;  // seams and widths below are degenerate
    double min_angle_deg = 1.0;  // angles below are degenerate
    double closure_mm = 1e-6;    // a seam that opens further than this does not close
    double flat_deg = 1e-3;      // normals further apart than this at 0° are not flat
};

// How points are told to an author who knows them in other coordinates: (p - origin) times `per_mm`, y turned
// over where it runs down.
struct Ruler {
    Vec2 origin;  // mm
    double per_mm = 1.0;
    bool y_down = false;
    std::string unit = "mm";  // behind the numbers; may be empty
};
// "(12.00, 30.50) mm".
std::string shown_point(const Ruler& ruler, Vec2 at);

}  // namespace popup
