#include "support/brute_force.h"

#ifdef POPUP_HAVE_CGAL

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/intersections.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "popup/diagnostics.h"
#include "popup/motion.h"
#include "support/brute_mesh.h"

namespace popup::test {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

constexpr double kParallel = 1e-9;  // sine of the angle between planes that have no line in common
constexpr double kStepDeg = 0.01;   // in which the end of a contact is looked for
constexpr double kAngleDeg = 1e-4;  // to which it is found
constexpr double kCircleMm = 1e-6;  // to which the largest circle is found

// ---- Plates in the world ----

struct Box3 {
    Vec3 min{HUGE_VAL, HUGE_VAL, HUGE_VAL};
    Vec3 max{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};

    void extend(Vec3 p) {
        min = {std::min(min.x, p.x), std::min(min.y, p.y), std::min(min.z, p.z)};
        max = {std::max(max.x, p.x), std::max(max.y, p.y), std::max(max.z, p.z)};
    }
    // Boxes are of the very numbers that are tested exactly, so this is exact as well.
    [[nodiscard]] bool meets(const Box3& o) const {
        return min.x <= o.max.x && o.min.x <= max.x && min.y <= o.max.y && o.min.y <= max.y &&
               min.z <= o.max.z && o.min.z <= max.z;
    }
    // No two points of the boxes are nearer than this, squared.
    [[nodiscard]] double apart_squared(const Box3& o) const {
        const auto gap = [](double a, double b) { return std::max({a, b, 0.0}); };
        const Vec3 gaps{gap(min.x - o.max.x, o.min.x - max.x), gap(min.y - o.max.y, o.min.y - max.y),
                        gap(min.z - o.max.z, o.min.z - max.z)};
        return dot(gaps, gaps);
    }
};

// A mesh in the world.
struct Placed {
    const Mesh* mesh = nullptr;
    std::vector<Vec3> points;
    std::vector<Box3> boxes;  // of each triangle
    Box3 box;

    Placed(const Mesh& of, const Frame& frame) : mesh(&of) {
        points.reserve(of.points.size());
        for (const Vec2 p : of.points) points.push_back(frame.point(p));
        boxes.resize(of.corners.size());
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            for (const int corner : of.corners[i]) boxes[i].extend(points[static_cast<std::size_t>(corner)]);
            box.extend(boxes[i].min);
            box.extend(boxes[i].max);
        }
    }
    [[nodiscard]] std::array<Vec3, 3> triangle(std::size_t i) const {
        const auto& c = mesh->corners[i];
        return {points[static_cast<std::size_t>(c[0])], points[static_cast<std::size_t>(c[1])],
                points[static_cast<std::size_t>(c[2])]};
    }
    [[nodiscard]] Kernel::Triangle_3 exact(std::size_t i) const {
        const auto [a, b, c] = triangle(i);
        return {{a.x, a.y, a.z}, {b.x, b.y, b.z}, {c.x, c.y, c.z}};
    }
};

// A plate at one angle: as it is, and shrunk.
struct Body {
    int plate;
    Frame frame;
    Placed whole, inner;
};

// Heights of a plate's corners over another's plane.
std::vector<double> heights(const Placed& plate, const Frame& over) {
    std::vector<double> result;
    result.reserve(plate.points.size());
    for (const Vec3 p : plate.points) result.push_back(dot(over.normal(), p - over.origin));
    return result;
}

// Whether a plate has paper further than kThroughMm over and under a plane, somewhere.
bool on_both_sides(const std::vector<double>& height) {
    const auto [low, high] = std::minmax_element(height.begin(), height.end());
    return std::min(-*low, *high) > kThroughMm;
}

using Stretch = std::pair<double, double>;

// Where a line of a plate's plane runs over the plate, as stretches of the line. The line is where the
// heights are nought.
std::vector<Stretch> stretches_of(const Placed& plate, const std::vector<double>& height, Vec3 along) {
    std::vector<Stretch> found;
    for (const auto& corners : plate.mesh->corners) {
        double lo = HUGE_VAL;
        double hi = -HUGE_VAL;
        const auto take = [&](double t) {
            lo = std::min(lo, t);
            hi = std::max(hi, t);
        };
        for (std::size_t k = 0; k < 3; ++k) {
            const auto a = static_cast<std::size_t>(corners[k]);
            const auto b = static_cast<std::size_t>(corners[(k + 1) % 3]);
            const double ta = dot(along, plate.points[a]);
            if (height[a] == 0.0) take(ta);
            if ((height[a] < 0.0) == (height[b] < 0.0)) continue;
            const double tb = dot(along, plate.points[b]);
            take(ta + height[a] / (height[a] - height[b]) * (tb - ta));
        }
        if (lo <= hi) found.emplace_back(lo, hi);
    }
    std::sort(found.begin(), found.end());
    std::vector<Stretch> joined;
    for (const Stretch& s : found) {
        // Triangles of one plate leave no gaps but of rounding and of slivers.
        if (!joined.empty() && s.first <= joined.back().second + 10.0 * kSliverMm) {
            joined.back().second = std::max(joined.back().second, s.second);
        } else {
            joined.push_back(s);
        }
    }
    return joined;
}

// Takes from stretches of a line on a page whatever is no further than `by` from the edges of a plate there.
void keep_inside(const Polygon& outline, Vec2 at, Vec2 along, double by, std::vector<Stretch>& stretches) {
    // Where the line is within `by` of an edge is one stretch: from there on it is near an end, or the side.
    const auto near = [&](Vec2 a, Vec2 b) {
        double lo = HUGE_VAL;
        double hi = -HUGE_VAL;
        const auto take = [&](double t) {
            lo = std::min(lo, t);
            hi = std::max(hi, t);
        };
        for (const Vec2 end : {a, b}) {
            const double off = cross(along, end - at);
            if (std::abs(off) > by) continue;
            const double half = std::sqrt(by * by - off * off);
            take(dot(along, end - at) - half);
            take(dot(along, end - at) + half);
        }
        const Vec2 way = unit(b - a);
        const double slope = cross(along, way);
        for (const double side : {by, -by}) {
            if (slope == 0.0) continue;
            const double t = (side - cross(at - a, way)) / slope;
            const double on_edge = dot(way, at + t * along - a);
            if (on_edge >= 0.0 && on_edge <= distance(a, b)) take(t);
        }
        return Stretch{lo, hi};
    };
    const auto cut = [&](const Ring& ring) {
        for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
            if (ring[i] == ring[j]) continue;
            const auto [lo, hi] = near(ring[j], ring[i]);
            std::vector<Stretch> left;
            for (const Stretch& s : stretches) {
                if (hi < s.first || lo > s.second) {
                    left.push_back(s);
                    continue;
                }
                if (s.first < lo) left.emplace_back(s.first, lo);
                if (hi < s.second) left.emplace_back(hi, s.second);
            }
            stretches = std::move(left);
        }
    };
    cut(outline.outer);
    std::for_each(outline.holes.begin(), outline.holes.end(), cut);
}

// What two plates have in common: the line in which their planes meet, as far as it lies on both.
struct Common {
    double sine = 0.0;  // of the angle between the planes
    Vec3 at, along;     // along: unit
    std::vector<Stretch> stretches;

    Common(const Body& a, const Body& b) {
        const Vec3 normals = cross(a.frame.normal(), b.frame.normal());
        sine = length(normals);
        if (sine < kParallel) return;
        along = (1.0 / sine) * normals;
        const double p = dot(a.frame.normal(), a.frame.origin);
        const double q = dot(b.frame.normal(), b.frame.origin);
        const double cosine = dot(a.frame.normal(), b.frame.normal());
        at = (1.0 / (sine * sine)) *
             ((p - q * cosine) * a.frame.normal() + (q - p * cosine) * b.frame.normal());
        const auto on_b = stretches_of(b.whole, heights(b.whole, a.frame), along);
        for (const Stretch& s : stretches_of(a.whole, heights(a.whole, b.frame), along)) {
            for (const Stretch& t : on_b) {
                const Stretch both{std::max(s.first, t.first), std::min(s.second, t.second)};
                if (both.first < both.second) stretches.push_back(both);
            }
        }
    }
};

}  // namespace

struct BruteForce::Impl {
    const Assembly& assembly;
    std::vector<Mesh> whole, inner;
    std::size_t tests = 0;

    explicit Impl(const Assembly& of) : assembly(of) {
        for (const Plate& plate : of.plates) {
            whole.push_back(triangulated({plate.outline}));
            inner.push_back(triangulated(shrunk(plate.outline, kInsideMm)));
        }
    }

    [[nodiscard]] std::vector<Frame> frames(double deg) const {
        std::vector<Frame> result(assembly.plates.size());
        POPUP_INVARIANT(place(assembly, Angle::degrees(deg), result));
        return result;
    }
    [[nodiscard]] Body body(int plate, const std::vector<Frame>& frames) const {
        const auto i = static_cast<std::size_t>(plate);
        return {plate, frames[i], Placed(whole[i], frames[i]), Placed(inner[i], frames[i])};
    }

    bool meet(const Placed& a, const Placed& b) {
        for (std::size_t i = 0; i < a.boxes.size(); ++i) {
            if (a.mesh->sliver[i] || !a.boxes[i].meets(b.box)) continue;
            const Kernel::Triangle_3 one = a.exact(i);
            for (std::size_t k = 0; k < b.boxes.size(); ++k) {
                if (b.mesh->sliver[k] || !a.boxes[i].meets(b.boxes[k])) continue;
                ++tests;
                if (CGAL::do_intersect(one, b.exact(k))) return true;
            }
        }
        return false;
    }

    // Whether a circle of paper on both plates, round a common point, stands that far out of both.
    [[nodiscard]] bool circle_stands_out(const Body& a, const Body& b, const Common& common,
                                         double mm) const {
        std::vector<Stretch> left = common.stretches;
        for (const Body* body : {&a, &b}) {
            const Frame& f = body->frame;
            const Vec2 at{dot(f.axes[0], common.at - f.origin), dot(f.axes[1], common.at - f.origin)};
            const Vec2 along{dot(f.axes[0], common.along), dot(f.axes[1], common.along)};
            const Polygon& outline = assembly.plates[static_cast<std::size_t>(body->plate)].outline;
            keep_inside(outline, at, along, mm / common.sine, left);
        }
        return !left.empty();
    }
    [[nodiscard]] bool in_contact(const Body& a, const Body& b, double deg) const {
        return circle_stands_out(a, b, Common(a, b), end_mm(deg));
    }
    [[nodiscard]] double through(const Body& a, const Body& b) const {
        const Common common(a, b);
        if (common.stretches.empty()) return 0.0;
        double in = 0.0;
        double out = 1.0;
        while (circle_stands_out(a, b, common, out)) out *= 2.0;
        while (out - in > kCircleMm) {
            const double middle = 0.5 * (in + out);
            (circle_stands_out(a, b, common, middle) ? in : out) = middle;
        }
        return in;
    }

    bool cross_each_other(const Body& a, const Body& b) {
        return a.whole.box.meets(b.whole.box) && on_both_sides(heights(a.whole, b.frame)) &&
               on_both_sides(heights(b.whole, a.frame)) && meet(a.inner, b.inner) &&
               circle_stands_out(a, b, Common(a, b), kThroughMm);
    }
};

bool BruteForce::available() { return true; }

BruteForce::BruteForce(const Assembly& assembly) : impl_(std::make_unique<Impl>(assembly)) {}
BruteForce::~BruteForce() = default;
BruteForce::BruteForce(BruteForce&&) noexcept = default;

std::vector<BruteContact> BruteForce::crossing_at(double deg) const {
    const auto frames = impl_->frames(deg);
    std::vector<Body> bodies;
    const int count = static_cast<int>(frames.size());
    for (int i = 0; i < count; ++i) bodies.push_back(impl_->body(i, frames));
    std::vector<BruteContact> found;
    for (const Body& a : bodies) {
        for (int b = a.plate + 1; b < count; ++b) {
            if (impl_->cross_each_other(a, bodies[static_cast<std::size_t>(b)]))
                found.push_back({a.plate, b});
        }
    }
    return found;
}

bool BruteForce::crosses(int a, int b, double deg) const {
    const auto frames = impl_->frames(deg);
    return impl_->cross_each_other(impl_->body(a, frames), impl_->body(b, frames));
}

double BruteForce::through(int a, int b, double deg) const {
    const auto frames = impl_->frames(deg);
    return impl_->through(impl_->body(a, frames), impl_->body(b, frames));
}

std::optional<std::pair<double, double>> BruteForce::contact_around(int a, int b, double deg) const {
    const auto holds = [&](double at) {
        const auto frames = impl_->frames(at);
        return impl_->in_contact(impl_->body(a, frames), impl_->body(b, frames), at);
    };
    if (!holds(deg)) return std::nullopt;
    const auto last = [&](double step, double limit) {
        double in = deg;
        double out = deg;
        while (holds(out)) {
            in = out;
            if (in == limit) return limit;
            out = std::clamp(in + step, 0.0, 180.0);
        }
        while (std::abs(out - in) > kAngleDeg) {
            const double middle = 0.5 * (in + out);
            (holds(middle) ? in : out) = middle;
        }
        return in;
    };
    return std::pair{last(-kStepDeg, 0.0), last(kStepDeg, 180.0)};
}

std::optional<double> BruteForce::closest(int a, int b, double deg) const {
    const auto frames = impl_->frames(deg);
    const Placed one = impl_->body(a, frames).whole;
    const Placed other = impl_->body(b, frames).whole;
    if (one.boxes.empty() || other.boxes.empty()) return std::nullopt;
    double least = HUGE_VAL;
    for (std::size_t i = 0; i < one.boxes.size(); ++i) {
        for (std::size_t k = 0; k < other.boxes.size(); ++k) {
            if (one.mesh->sliver[i] || other.mesh->sliver[k]) continue;
            if (one.boxes[i].apart_squared(other.boxes[k]) >= least) continue;
            const Kernel::Triangle_3 s = one.exact(i);
            const Kernel::Triangle_3 t = other.exact(k);
            ++impl_->tests;
            if (CGAL::do_intersect(s, t)) return 0.0;
            least = std::min(least, CGAL::squared_distance(s, t));
        }
    }
    return std::sqrt(least);
}

bool BruteForce::meet_when_moved(int a, int b, double deg, Vec3 b_by, bool shrunk) const {
    auto frames = impl_->frames(deg);
    Frame& moved = frames[static_cast<std::size_t>(b)];
    moved.origin = moved.origin + b_by;
    const Body one = impl_->body(a, frames);
    const Body other = impl_->body(b, frames);
    return shrunk ? impl_->meet(one.inner, other.inner) : impl_->meet(one.whole, other.whole);
}

std::size_t BruteForce::triangle_tests() const { return impl_->tests; }

}  // namespace popup::test

#else

#include "popup/diagnostics.h"

namespace popup::test {

struct BruteForce::Impl {};

namespace {
[[noreturn]] void missing() { broken_invariant(BruteForce::kMissing, __FILE__, __LINE__); }
}  // namespace

bool BruteForce::available() { return false; }
BruteForce::BruteForce(const Assembly& /*assembly*/) { missing(); }
BruteForce::~BruteForce() = default;
BruteForce::BruteForce(BruteForce&&) noexcept = default;
std::vector<BruteContact> BruteForce::crossing_at(double /*deg*/) const { missing(); }
bool BruteForce::crosses(int /*a*/, int /*b*/, double /*deg*/) const { missing(); }
double BruteForce::through(int /*a*/, int /*b*/, double /*deg*/) const { missing(); }
std::optional<std::pair<double, double>> BruteForce::contact_around(int /*a*/, int /*b*/,
                                                                    double /*deg*/) const {
    missing();
}
std::optional<double> BruteForce::closest(int /*a*/, int /*b*/, double /*deg*/) const { missing(); }
bool BruteForce::meet_when_moved(int /*a*/, int /*b*/, double /*deg*/, Vec3 /*b_by*/, bool /*shrunk*/) const {
    missing();
}
std::size_t BruteForce::triangle_tests() const { missing(); }

}  // namespace popup::test

#endif
