// FlatLang programs run within a test, and their outlines as flat polygons.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <polyclipping/clipper.hpp>
#include <string>
#include <vector>

#include "input/flatlang/run/interpreter.h"

namespace popup::flatlang {

// Runs it; any finding is a failure.
inline ProgramRun ran(const std::string& text, const ReadOptions& options = {}) {
    Diagnostics diagnostics("test.fl");
    ProgramRun run = run_program({"test.fl", text}, options, diagnostics);
    for (const Diagnostic& one : diagnostics.sorted()) {
        ADD_FAILURE() << text << "\n" << one.place.line << ": " << one.code << ": " << one.message;
    }
    EXPECT_EQ(run.status, RunStatus::ok);
    return run;
}

// The worst finding of a program that has loaded the kit in its first line, as "LINE: message".
inline std::string trouble(const std::string& text) {
    Diagnostics diagnostics("test.fl");
    run_program({"test.fl", "load(\"kit/all.fl\")\n" + text}, {}, diagnostics);
    const std::vector<Diagnostic> found = diagnostics.sorted();
    if (found.empty()) return "";
    return std::to_string(found.front().place.line) + ": " + found.front().message;
}

using Points = std::vector<Vec2>;

inline Points flat(const TrailPolygon& polygon) {
    Points points;
    for (const Vec3& p : polygon.points) points.push_back({p.x, p.y});
    return points;
}

inline Points moved(const Points& points, double turn, Vec2 by) {
    Points result;
    for (const Vec2& p : points) {
        result.push_back({by.x + p.x * std::cos(turn) - p.y * std::sin(turn),
                          by.y + p.x * std::sin(turn) + p.y * std::cos(turn)});
    }
    return result;
}

inline constexpr double kScale = 1e8;

inline ClipperLib::Path path_of(const Points& points) {
    ClipperLib::Path path;
    for (const Vec2& p : points) {
        path.emplace_back(static_cast<ClipperLib::cInt>(std::llround(p.x * kScale)),
                          static_cast<ClipperLib::cInt>(std::llround(p.y * kScale)));
    }
    if (!ClipperLib::Orientation(path)) std::reverse(path.begin(), path.end());
    return path;
}

inline double area_of(ClipperLib::ClipType type, const Points& a, const Points& b) {
    ClipperLib::Clipper clipper;
    clipper.AddPath(path_of(a), ClipperLib::ptSubject, true);
    clipper.AddPath(path_of(b), ClipperLib::ptClip, true);
    ClipperLib::Paths result;
    clipper.Execute(type, result, ClipperLib::pftNonZero, ClipperLib::pftNonZero);
    double area = 0.0;
    for (const ClipperLib::Path& path : result) area += ClipperLib::Area(path);
    return std::abs(area) / kScale / kScale;
}
inline double overlap(const Points& a, const Points& b) { return area_of(ClipperLib::ctIntersection, a, b); }

inline Vec2 middle_of_bore(const TrailPolygon& bore) {
    Vec2 sum{0, 0};
    for (const Vec3& p : bore.points) sum = {sum.x + p.x / 4, sum.y + p.y / 4};
    return sum;
}

}  // namespace popup::flatlang
