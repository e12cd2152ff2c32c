#include "input/dxf/entities.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "input/dxf/curves.h"

namespace popup::dxf {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kTurn = 2.0 * std::numbers::pi;
// Flags of group 70.
constexpr int kClosed = 1;
constexpr int kSplineFitted = 4;
constexpr int kMesh = 16 | 64;
constexpr int kFrameVertex = 16;

std::string line(Record& record, Path& path) {
    path.move(record.point(10));
    path.line(record.point(11));
    return {};
}

// From `from` to `to`, counter-clockwise; a whole turn where they are one.
void add_part(Vec2 centre, Vec2 u, Vec2 v, double from, double to, Path& path) {
    from = std::remainder(from, kTurn);
    to = std::remainder(to, kTurn);
    const auto at = [&](double t) { return centre + std::cos(t) * u + std::sin(t) * v; };
    constexpr double kSame = 1e-9;
    if (to <= from + kSame) to += kTurn;
    const bool whole = to - from >= kTurn - kSame;
    path.move(at(from));
    add_arc(path, centre, u, v, from, whole ? from + kTurn : to, whole ? path.at() : at(to));
    if (whole) path.close();
}

std::string arc(Record& record, Path& path) {
    const double radius = record.number(40);
    if (radius < 0.0) return "the radius of this ARC is below zero";
    if (radius == 0.0) return {};
    add_part(record.point(10), {radius, 0.0}, {0.0, radius}, kDegree * record.number(50),
             kDegree * record.number(51), path);
    return {};
}

std::string circle(Record& record, Path& path) {
    const double radius = record.number(40);
    if (radius < 0.0) return "the radius of this CIRCLE is below zero";
    if (radius == 0.0) return {};
    add_part(record.point(10), {radius, 0.0}, {0.0, radius}, 0.0, 0.0, path);
    return {};
}

// In the drawing's coordinates, whichever way it is seen from; that decides which way it runs.
std::string ellipse(Record& record, Path& path) {
    const Vec2 major = record.point(11);
    const double ratio = record.number(40, 1.0);
    if (length(major) == 0.0 || ratio == 0.0) return {};
    const double side = record.number(230, 1.0) < 0.0 ? -1.0 : 1.0;
    add_part(record.point(10), major, side * ratio * left_of(major), record.number(41),
             record.number(42, kTurn), path);
    return {};
}

std::string polyline(Record& record, Path& path) {
    struct Corner {
        Vec2 at;
        double bulge = 0.0;
    };
    std::vector<Corner> corners;
    for (const Group& group : record.groups()) {
        if (group.code == 10) corners.push_back({{record.value(group), 0.0}});
        if (corners.empty()) continue;
        if (group.code == 20) corners.back().at.y = record.value(group);
        if (group.code == 42) corners.back().bulge = record.value(group);
    }
    if (corners.empty() || !record.sound()) return {};
    const bool closed = (record.whole(70) & kClosed) != 0;
    path.move(corners[0].at);
    for (std::size_t i = 1; i < corners.size(); ++i) add_bulge(path, corners[i - 1].bulge, corners[i].at);
    if (closed) {
        if (path.at() != corners[0].at) add_bulge(path, corners.back().bulge, corners[0].at);
        path.close();
    }
    return {};
}

std::string spline(Record& record, Path& path) {
    Spline made;
    for (const Group& group : record.groups()) {
        switch (group.code) {
            case 40:
                made.knots.push_back(record.value(group));
                break;
            case 41:
                made.weights.push_back(record.value(group));
                break;
            case 10:
                made.controls.push_back({record.value(group), 0.0});
                break;
            case 20:
                if (!made.controls.empty()) made.controls.back().y = record.value(group);
                break;
            case 11:
                made.through.push_back({record.value(group), 0.0});
                break;
            case 21:
                if (!made.through.empty()) made.through.back().y = record.value(group);
                break;
            case 12:
                made.first_way = record.point(12);
                break;
            case 13:
                made.last_way = record.point(13);
                break;
            default:
                break;
        }
    }
    made.degree = record.whole(71, 3);
    made.closed = (record.whole(70) & kClosed) != 0;
    if (!record.sound()) return {};
    // Weights that are all one are none.
    const std::vector<double>& weights = made.weights;
    const bool alike = std::all_of(weights.begin(), weights.end(), [&](double w) { return w == weights[0]; });
    if (!weights.empty() && weights.size() == made.controls.size() && alike && weights[0] > 0.0)
        made.weights.clear();
    return add_spline(made, path);
}

struct Row {
    std::string_view kind;
    std::string (*make)(Record&, Path&);
};
constexpr std::array<Row, 6> kRows{{{"LINE", line},
                                    {"ARC", arc},
                                    {"CIRCLE", circle},
                                    {"ELLIPSE", ellipse},
                                    {"LWPOLYLINE", polyline},
                                    {"SPLINE", spline}}};

const Row* find_row(std::string_view kind) {
    const auto* const row =
        std::find_if(kRows.begin(), kRows.end(), [&](const Row& r) { return r.kind == kind; });
    return row == kRows.end() ? nullptr : row;
}

}  // namespace

bool is_line(std::string_view kind) { return find_row(kind) != nullptr; }

std::string make_line(Record& record, Path& path) {
    const Row* row = find_row(record.kind());
    if (row == nullptr) return {};
    std::string trouble = row->make(record, path);
    if (!record.sound()) path = {};
    return trouble;
}

bool OldPolyline::begin(Record& record) {
    *this = {};
    const int flags = record.whole(70);
    closed_ = (flags & kClosed) != 0;
    spline_ = (flags & kSplineFitted) != 0;
    return (flags & kMesh) == 0;
}

void OldPolyline::corner(Record& vertex) {
    // The controls of a curve that its other corners are.
    if (spline_ && (vertex.whole(70) & kFrameVertex) != 0) return;
    const Vec2 at = vertex.point(10);
    if (begun_) {
        add_bulge(path_, bulge_, at);
    } else {
        path_.move(at);
        first_ = at;
        begun_ = true;
    }
    bulge_ = vertex.number(42);
}

void OldPolyline::end(Path& path) {
    if (!begun_) return;
    if (closed_) {
        if (path_.at() != first_) add_bulge(path_, bulge_, first_);
        path_.close();
    }
    path = std::move(path_);
}

}  // namespace popup::dxf
