#include "input/flatlang/pieces/outlines.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <unordered_map>

#include "base/geometry/edge_index.h"
#include "base/geometry/regions.h"
#include "base/text/numbers.h"
#include "parts/contours.h"

namespace popup::flatlang {
namespace {

// Of one plane are loops within 1e-4 inch an axis of it.
constexpr double kPlaneMm = 1.75e-4 * kMmPerInch;
// Loops are flat as the turtle has it, by their first points; further ones may stray as these are close.
constexpr double kAskewMm = 1e-3 * kMmPerInch;
// Cells in which planes are looked up: a normal's coordinate, a distance in mm.
constexpr double kNormalCell = 2e-3;
constexpr double kDistanceCell = 0.5;

// Of loops that overlap, so many are told of each part, and how many there are besides.
constexpr std::size_t kUnclearTold = 3;

constexpr std::string_view kLiftPen = "lift the pen with up() on the way from one outline to the next";

std::size_t at(int number) { return static_cast<std::size_t>(number); }

bool is_finite(Vec3 p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

std::string spot(Vec3 mm) {
    const Vec3 p = (1.0 / kMmPerInch) * mm;
    return fmt::format("({:.3f}, {:.3f}, {:.3f}) inches", rounded(p.x, 3), rounded(p.y, 3), rounded(p.z, 3));
}

// "this part"; with its name where it has one.
std::string part_text(const Trail& trail, int part) {
    const std::string& name = trail.parts[at(part)].name;
    if (part == 0) return "what is drawn before the first part";
    return name.empty() ? std::string("this part") : fmt::format("part \"{}\"", name);
}

// The direction that is perpendicular to all of a flat loop; zero when it has no width.
Vec3 normal_of(const std::vector<Vec3>& points) {
    const Vec3 a = points.front();
    const auto farthest = [&](auto&& measure) {
        return *std::max_element(points.begin(), points.end(),
                                 [&](Vec3 p, Vec3 q) { return measure(p) < measure(q); });
    };
    const Vec3 b = farthest([&](Vec3 p) { return distance(a, p); });
    if (!(distance(a, b) > 0.0)) return {};
    const Vec3 along = unit(b - a);
    const Vec3 c = farthest([&](Vec3 p) { return length(cross(along, p - a)); });
    const Vec3 corner = cross(b - a, c - a);
    if (length(cross(along, c - a)) <= 0.5 * kDeepMm) return {};
    // The sum over all corners errs less, but for loops that go round as much to the left as to the right.
    Vec3 sum;
    for (std::size_t i = 0; i < points.size(); ++i) {
        sum = sum + cross(points[i] - a, points[i + 1 == points.size() ? 0 : i + 1] - a);
    }
    return unit(length(sum) > 0.1 * length(corner) ? sum : corner);
}

// Takes what is only the rounding of turns out of directions along the axes.
Vec3 straightened(Vec3 n) {
    constexpr double kStraight = 1e-9;
    for (double* one : {&n.x, &n.y, &n.z}) {
        if (std::abs(*one) < kStraight) *one = 0.0;
    }
    return unit(n);
}

bool faces_front(Vec3 n) {
    constexpr double kUpright = 1e-4;
    if (std::abs(n.z) > kUpright) return n.z > 0.0;
    if (std::abs(n.y) > kUpright) return n.y < 0.0;
    return n.x > 0.0;
}

// The frame of the plane with this normal through p, seen from its front.
Frame frame_of(Vec3 normal, Vec3 p) {
    Vec3 n = straightened(normal);
    if (!faces_front(n)) n = -n;
    Frame frame;
    constexpr double kRising = 0.5;
    if (n.z > kRising) {
        frame.axes[0] = unit(Vec3{1, 0, 0} - n.x * n);
        frame.axes[1] = cross(n, frame.axes[0]);
    } else {
        frame.axes[1] = unit(Vec3{0, 0, 1} - n.z * n);
        frame.axes[0] = cross(frame.axes[1], n);
    }
    frame.axes[2] = n;
    frame.origin = dot(n, p) * n;
    return frame;
}

double off_plane(const Frame& plane, const std::vector<Vec3>& points) {
    double most = 0.0;
    for (const Vec3 p : points) most = std::max(most, std::abs(dot(plane.axes[2], p - plane.origin)));
    return most;
}

struct PlaneKey {
    int part = 0;
    std::array<std::int64_t, 4> cell{};
    bool operator==(const PlaneKey&) const = default;
};
struct PlaneKeyHash {
    std::size_t operator()(const PlaneKey& key) const {
        auto h = static_cast<std::uint64_t>(key.part);
        for (const std::int64_t one : key.cell) {
            h = (h ^ (h >> 29U)) * 0x9E3779B97F4A7C15ULL + static_cast<std::uint64_t>(one);
        }
        return static_cast<std::size_t>((h ^ (h >> 31U)) * 0xBF58476D1CE4E5B9ULL);
    }
};

// Planes found by part, direction and place.
class Planes {
 public:
    explicit Planes(Work& work) : work_(work) {}

    // The plane of this part that holds these points, a new one where there is none; -1: too much work.
    int find(int part, Vec3 normal, const std::vector<Vec3>& points) {
        // Distances are from where the part is drawn: far from it a small turn moves a plane much.
        const Vec3 middle = middles_.try_emplace(part, points.front()).first->second;
        for (const Vec3 n : {normal, -normal}) {
            const std::array<double, 4> place = coordinates(n, points.front() - middle);
            for (unsigned corner = 0; corner < 16U; ++corner) {
                PlaneKey key{part, {}};
                for (unsigned k = 0; k < 4U; ++k) {
                    const double low = std::floor(place.at(k) - 0.5);
                    key.cell.at(k) = static_cast<std::int64_t>(low) + ((corner >> k) & 1U);
                }
                const auto cell = cells_.find(key);
                if (cell == cells_.end()) continue;
                for (const int plane : cell->second) {
                    if (!work_.looks(points.size())) return -1;
                    if (off_plane(frames[at(plane)], points) <= kPlaneMm) return plane;
                }
            }
        }
        PlaneKey key{part, {}};
        const std::array<double, 4> place = coordinates(normal, points.front() - middle);
        for (std::size_t k = 0; k < 4; ++k)
            key.cell.at(k) = static_cast<std::int64_t>(std::floor(place.at(k)));
        cells_[key].push_back(static_cast<int>(frames.size()));
        frames.push_back(frame_of(normal, points.front()));
        return static_cast<int>(frames.size()) - 1;
    }

    std::vector<Frame> frames;

 private:
    static std::array<double, 4> coordinates(Vec3 n, Vec3 p) {
        return {n.x / kNormalCell, n.y / kNormalCell, n.z / kNormalCell, dot(n, p) / kDistanceCell};
    }

    Work& work_;
    std::map<int, Vec3> middles_;
    std::unordered_map<PlaneKey, std::vector<int>, PlaneKeyHash> cells_;
};

class Finder {
 public:
    Finder(const Trail& trail, Work& work, Diagnostics& diagnostics)
        : in_(trail), work_(work), diagnostics_(diagnostics), planes_(work) {}

    std::optional<Outlines> run() {
        if (!check_numbers()) return std::nullopt;
        out_.polygon_face.assign(in_.polygons.size(), -1);
        if (!find_planes()) return too_large();
        for (const std::vector<int>& polygons : in_plane_) {
            if (!add_faces(polygons)) return too_large();
        }
        tell_loose();
        tell_further_unclear();
        if (bad_) return std::nullopt;
        put_in_order();
        return std::move(out_);
    }

 private:
    std::nullopt_t too_large() {
        diagnostics_.error("document-too-large", {},
                           "the drawing is too much work: its loops cross, touch or surround one another too "
                           "often");
        return std::nullopt;
    }

    Diagnostic& error(int part, std::string message) {
        bad_ = true;
        return diagnostics_.error("flatlang-bad-outline", in_.parts[at(part)].place, std::move(message));
    }

    // --- all numbers are numbers

    bool check_numbers() {
        for (const TrailSegment& one : in_.segments) {
            if (!check(one.from, one.part) || !check(one.to, one.part)) return false;
        }
        for (const TrailPolygon& one : in_.polygons) {
            for (const Vec3 p : one.points) {
                if (!check(p, one.part)) return false;
            }
        }
        return true;
    }

    bool check(Vec3 p, int part) {
        if (!is_finite(p)) {
            error(part,
                  fmt::format("{} has a line that leads nowhere: a coordinate is infinite, or no number",
                              part_text(in_, part)))
                .hint("a division by zero, or the root of a negative number, makes such lengths");
            return false;
        }
        if (!is_near(p)) {
            error(part, fmt::format("{} reaches ({:.6g}, {:.6g}, {:.6g}) inches, {:.0f} from the middle are "
                                    "the most",
                                    part_text(in_, part), p.x, p.y, p.z, kFarthestMm / kMmPerInch))
                .hint("lengths are in inches");
            return false;
        }
        return true;
    }

    // --- planes

    bool find_planes() {
        for (std::size_t i = 0; i < in_.polygons.size(); ++i) {
            const TrailPolygon& polygon = in_.polygons[i];
            std::vector<Vec3> points;
            points.reserve(polygon.points.size());
            for (const Vec3 p : polygon.points) points.push_back(kMmPerInch * p);
            const Vec3 normal = points.size() < 3 ? Vec3{} : normal_of(points);
            if (normal == Vec3{}) continue;
            Vec3 middle;
            for (const Vec3 p : points) middle = middle + (1.0 / static_cast<double>(points.size())) * p;
            Frame own;
            own.axes[2] = normal;
            own.origin = middle;
            const double askew = off_plane(own, points);
            if (askew > kAskewMm) {
                error(polygon.part,
                      fmt::format("{} has a loop at {} that does not lie in a plane: its points are up to "
                                  "{:.3f} mm off",
                                  part_text(in_, polygon.part), spot(points.back()), askew))
                    .hint("turn only left and right on the way round, or make flat loops of it");
                continue;
            }
            const int plane = planes_.find(polygon.part, normal, points);
            if (plane < 0) return false;
            if (at(plane) == in_plane_.size()) in_plane_.emplace_back();
            in_plane_[at(plane)].push_back(static_cast<int>(i));
        }
        return true;
    }

    // --- what lies in what

    bool add_faces(const std::vector<int>& polygons) {
        const int part = in_.polygons[at(polygons.front())].part;
        const int plane = static_cast<int>(&polygons - in_plane_.data());
        const Frame& frame = planes_.frames[at(plane)];
        std::vector<ClosedLine> lines;
        for (const int number : polygons) {
            ClosedLine line;
            for (const Vec3 p : in_.polygons[at(number)].points) {
                const Vec3 from = kMmPerInch * p - frame.origin;
                line.points.push_back({dot(frame.axes[0], from), dot(frame.axes[1], from)});
            }
            line.elements = {number};
            lines.push_back(std::move(line));
        }
        auto contours = sort_contours(std::move(lines), work_);
        if (!contours) return false;
        tell(*contours, part, frame);
        const auto covered = out_.covered;
        const bool bad = bad_;
        if (!make_faces(*contours, part, plane, frame)) return false;
        // Where nothing is left, that has been said.
        if (out_.covered == covered && bad_ == bad) tell_holes_on_edges(contours->all, part, frame);
        return true;
    }

    void tell(const Contours& contours, int part, const Frame& frame) {
        for (const CrossedContour& one : contours.crossed) {
            const Vec3 where = frame.point(one.at);
            if (part == 0) {
                if (crossed_++ == 0) crossed_at_ = where;
                continue;
            }
            tell_unclear(part, fmt::format("{} has a loop that crosses or touches itself at {}",
                                           part_text(in_, part), spot(where)));
        }
        for (const ContourOverlap& one : contours.overlaps) {
            const ClosedContour& a = contours.all[at(one.a)];
            const ClosedContour& b = contours.all[at(one.b)];
            const std::string message =
                fmt::format("{} has two loops that overlap partly, by {:.2f} mm², at {}",
                            part_text(in_, part), one.area_mm2, spot(frame.point(one.at)));
            if (a.parent >= 0 && b.parent >= 0 && a.root == b.root) {
                diagnostics_.warning("holes-overlap", in_.parts[at(part)].place,
                                     message + "; what is left of the part is what both leave");
                continue;
            }
            if (part != 0) {
                tell_unclear(part, message);
            } else if (overlaps_++ == 0 || one.area_mm2 > largest_mm2_) {
                largest_mm2_ = one.area_mm2;
                largest_at_ = frame.point(one.at);
            }
        }
    }

    // Of each part the first few; how many there are more is told at the end.
    void tell_unclear(int part, const std::string& message) {
        bad_ = true;
        if (++unclear_[part] > kUnclearTold) return;
        error(part, message)
            .hint(std::string(kLiftPen))
            .hint("begin a part for each piece with part(), if they are several");
    }

    void tell_further_unclear() {
        for (const auto& [part, count] : unclear_) {
            if (count <= kUnclearTold) continue;
            error(part, fmt::format("{} has {} further loops that overlap, cross or touch like these",
                                    part_text(in_, part), count - kUnclearTold));
        }
    }

    void tell_covered(int part, Vec3 where) {
        if (part == 0) {
            if (out_.covered++ == 0) covered_at_ = where;
            return;
        }
        error(part,
              fmt::format("{} has a loop at {} of which the loops in it, which are holes, leave nothing",
                          part_text(in_, part), spot(where)))
            .hint("begin a part for each piece with part(), if they are several");
    }

    // Of what is drawn before the first part, once: it may be all of a program of many pieces.
    void tell_loose() {
        if (crossed_ > 0) {
            diagnostics_
                .warning(
                    "flatlang-outlines-overlap", {},
                    crossed_ == 1
                        ? fmt::format("a loop drawn before the first part crosses or touches itself, at {}; "
                                      "all that it goes round was taken for paper",
                                      spot(crossed_at_))
                        : fmt::format("{} loops drawn before the first part cross or touch themselves, the "
                                      "first at {}; all that each goes round was taken for paper",
                                      crossed_, spot(crossed_at_)))
                .hint(std::string(kLiftPen));
        }
        if (overlaps_ > 0) {
            diagnostics_
                .warning(
                    "flatlang-outlines-overlap", {},
                    fmt::format(
                        "{} drawn before the first part overlap partly, by {}{:.2f} mm², at {}; each loop "
                        "makes a piece of its own",
                        overlaps_ == 1 ? "two loops" : fmt::format("{} pairs of loops", overlaps_),
                        overlaps_ == 1 ? "" : "up to ", largest_mm2_, spot(largest_at_)))
                .hint(std::string(kLiftPen))
                .hint("name what belongs together with part()");
        }
        if (out_.covered > 0) {
            diagnostics_
                .warning("flatlang-outlines-overlap", {},
                         out_.covered == 1
                             ? fmt::format("of a loop drawn before the first part, at {}, the loops in it, "
                                           "which are holes, leave nothing",
                                           spot(covered_at_))
                             : fmt::format("of {} loops drawn before the first part, the first at {}, the "
                                           "loops in them, which are holes, leave nothing",
                                           out_.covered, spot(covered_at_)))
                .hint("begin a part for each piece with part()");
        }
    }

    // A flap that is folded onto a wall lies in its plane, and would be cut out of it.
    void tell_holes_on_edges(const std::vector<ClosedContour>& all, int part, const Frame& frame) {
        constexpr double kOnEdgeMm = 0.01;
        std::map<int, EdgeIndex> edges;
        std::size_t found = 0;
        Vec3 first;
        for (const ClosedContour& one : all) {
            if (one.depth % 2 == 0) continue;
            const auto parent = edges.try_emplace(one.parent, edges_of({all[at(one.parent)].ring, {}})).first;
            for (std::size_t i = 0; i < one.ring.size(); ++i) {
                const Vec2 middle = lerp(one.ring[i], one.ring[(i + 1) % one.ring.size()], 0.5);
                if (parent->second.clearance(middle, 2.0 * kOnEdgeMm) > kOnEdgeMm) continue;
                if (found++ == 0) first = frame.point(middle);
                break;
            }
        }
        if (found == 0) return;
        diagnostics_
            .warning(
                "flatlang-outlines-overlap", in_.parts[at(part)].place,
                fmt::format(
                    "{} has {} in a loop of the same plane, with an edge on its edge, at {}; {} cut out "
                    "of it",
                    part_text(in_, part), found == 1 ? std::string("a loop") : fmt::format("{} loops", found),
                    spot(first), found == 1 ? "it is" : "they are"))
            .hint("a flap that is folded onto a face is kept when it is drawn a little open, by a degree");
    }

    bool make_faces(const Contours& contours, int part, int plane, const Frame& frame) {
        const std::vector<ClosedContour>& all = contours.all;
        std::vector<std::vector<Polygon>> holes(all.size());
        std::vector<int> face_of(all.size(), -1);
        const int first_face = all.empty() ? -1 : static_cast<int>(out_.faces.size());
        for (std::size_t i = 0; i < all.size(); ++i) {
            if (all[i].depth % 2 == 1) holes[at(all[i].parent)].push_back({all[i].ring, {}});
            if (all[i].parent >= 0) continue;
            face_of[i] = static_cast<int>(out_.faces.size());
            out_.faces.push_back({part, plane, static_cast<int>(in_.polygons.size()), frame, {}});
        }
        std::set<int> overlapping;
        for (const ContourOverlap& one : contours.overlaps) overlapping.insert(all[at(one.a)].root);
        for (std::size_t i = 0; i < all.size(); ++i) {
            const int number = face_of[at(all[i].root)];
            Face& face = out_.faces[at(number)];
            for (const int polygon : all[i].elements) {
                out_.polygon_face[at(polygon)] = number;
                face.first_polygon = std::min(face.first_polygon, polygon);
            }
            if (all[i].depth % 2 == 1) continue;
            if (holes[i].empty()) {
                face.paper.push_back({all[i].ring, {}});
                continue;
            }
            if (!work_.sweep(all[i].ring) || !work_.sweep(holes[i])) return false;
            const std::vector<Polygon> left = subtract({{all[i].ring, {}}}, holes[i]);
            face.paper.insert(face.paper.end(), left.begin(), left.end());
        }
        // What is drawn twice within the rounding is as good as the outline itself.
        for (const std::vector<int>& doubled : contours.doubled) {
            for (const int polygon : doubled) {
                if (out_.polygon_face[at(polygon)] < 0) out_.polygon_face[at(polygon)] = first_face;
            }
        }
        for (const int root : overlapping) {
            std::vector<Polygon>& paper = out_.faces[at(face_of[at(root)])].paper;
            paper = unite(paper);
        }
        for (std::size_t i = 0; i < all.size(); ++i) {
            if (all[i].parent >= 0 || !out_.faces[at(face_of[i])].paper.empty()) continue;
            tell_covered(part, frame.point(all[i].ring.front()));
        }
        return true;
    }

    void put_in_order() {
        std::vector<int> order;
        for (std::size_t i = 0; i < out_.faces.size(); ++i) {
            // Of a loop that others cover wholly nothing is left.
            if (!out_.faces[i].paper.empty()) order.push_back(static_cast<int>(i));
        }
        std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
            const Face& p = out_.faces[at(a)];
            const Face& q = out_.faces[at(b)];
            return std::pair(p.part, p.first_polygon) < std::pair(q.part, q.first_polygon);
        });
        std::vector<int> number(out_.faces.size(), -1);
        std::vector<Face> faces;
        for (const int i : order) {
            number[at(i)] = static_cast<int>(faces.size());
            faces.push_back(std::move(out_.faces[at(i)]));
        }
        out_.faces = std::move(faces);
        for (int& face : out_.polygon_face) {
            if (face >= 0) face = number[at(face)];
        }
    }

    const Trail& in_;
    Work& work_;
    Diagnostics& diagnostics_;
    Planes planes_;
    std::vector<std::vector<int>> in_plane_;
    Outlines out_;
    bool bad_ = false;
    std::map<int, std::size_t> unclear_;  // loops that overlap, cross or touch, of each part
    // Of what is drawn before the first part:
    int crossed_ = 0;   // loops that cross themselves
    Vec3 crossed_at_;   // the first of them
    int overlaps_ = 0;  // pairs of loops
    Vec3 covered_at_;   // the first loop of which nothing is left
    double largest_mm2_ = 0.0;
    Vec3 largest_at_;
};

}  // namespace

bool is_near(Vec3 inches) {
    constexpr double kMost = kFarthestMm / kMmPerInch;
    return std::abs(inches.x) <= kMost && std::abs(inches.y) <= kMost && std::abs(inches.z) <= kMost;
}

std::optional<Outlines> find_outlines(const Trail& trail, Work& work, Diagnostics& diagnostics) {
    return Finder(trail, work, diagnostics).run();
}

}  // namespace popup::flatlang
