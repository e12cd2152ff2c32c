// What a machine does on a sheet, as lines: worked out from the pattern, and read off a drawing.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <vector>

#include "fabrication/broken_score.h"
#include "output/sheet_drawing.h"
#include "support/profiles.h"

namespace popup::test {

// Every profile that wants machine order, and two that have more kinds of lines.
inline std::vector<Profile> machine_profiles() {
    std::vector<Profile> all;
    for (const Profile& row : profile_table()) {
        if (row.machine_order) all.push_back(row);
    }
    // Every kind of line at once, slits too.
    Profile every = *find_profile("lightburn");
    every.name = "every kind";
    every.folds = FoldStyle::both;
    pen_of(every, Operation::inner_cut).kerf_mm = 0.1;
    all.push_back(every);
    // Folds that no two pens draw alike.
    Profile workshop = *find_profile("workshop");
    workshop.name = "workshop in machine order";
    workshop.machine_order = true;
    all.push_back(workshop);
    return all;
}

inline SheetDrawing drawn(const Layout& layout, const Profile& profile, int sheet = 0) {
    OutputOptions options;
    options.profile = profile;
    SheetView view;
    view.sheet = sheet;
    return draw_sheet(layout, options, view);
}

struct Line {
    Operation operation = Operation::outer_cut;
    bool closed = false;
    std::vector<Vec2> points;

    [[nodiscard]] std::vector<Segment> segments() const {
        std::vector<Segment> all;
        for (std::size_t i = 1; i < points.size(); ++i) all.push_back({points[i - 1], points[i]});
        if (closed) all.push_back({points.back(), points.front()});
        return all;
    }
    [[nodiscard]] double length() const {
        double sum = 0.0;
        for (const Segment& one : segments()) sum += std::hypot(one.b.x - one.a.x, one.b.y - one.a.y);
        return sum;
    }
};

// Of each line of a piece, where it lies in its fold.
inline std::vector<FoldPart> parts_of_folds_of(const PatternPiece& piece) {
    std::vector<FoldPart> all(piece.lines.size());
    for (const LineKind kind : {LineKind::valley, LineKind::mountain, LineKind::seam}) {
        std::vector<std::size_t> numbers;
        std::vector<Segment> lines;
        for (std::size_t i = 0; i < piece.lines.size(); ++i) {
            const PatternLine& fold = piece.lines[i];
            if (fold.kind != kind || (kind == LineKind::seam && fold.glued_on)) continue;
            numbers.push_back(i);
            lines.push_back(fold.at);
        }
        const std::vector<FoldPart> parts = parts_of_folds(lines);
        for (std::size_t i = 0; i < parts.size(); ++i) all[numbers[i]] = parts[i];
    }
    return all;
}

// What is cut of a line of a perforated fold: cuts lie along the whole fold as they would on a straight one.
inline std::vector<Segment> perforated_part(const Segment& line, const FoldPart& part,
                                            const Perforation& perforation) {
    const double length = std::hypot(line.b.x - line.a.x, line.b.y - line.a.y);
    std::vector<Segment> cuts;
    for (const Segment& cut : perforated({{0.0, 0.0}, {part.whole, 0.0}}, perforation)) {
        const double from = std::max(cut.a.x - part.before, 0.0);
        const double to = std::min(cut.b.x - part.before, length);
        if (to - from < 1e-9) continue;
        const auto at = [&](double mm) {
            return lerp(line.a, line.b, part.back ? 1.0 - mm / length : mm / length);
        };
        cuts.push_back({at(from), at(to)});
    }
    return cuts;
}

// What a machine does on a sheet, straight from the pattern.
inline std::vector<Line> expected_lines(const Layout& layout, const Profile& profile, int sheet) {
    std::vector<Line> all;
    const bool slits = profile.pen(Operation::inner_cut).kerf_mm > 0.0;
    for (const Placement& placement : layout.placements) {
        if (placement.sheet != sheet) continue;
        const double turn = placement.angle.deg * std::acos(-1.0) / 180.0;
        const auto placed = [&](Vec2 p) {
            return Vec2{std::cos(turn) * p.x - std::sin(turn) * p.y + placement.offset.x,
                        std::sin(turn) * p.x + std::cos(turn) * p.y + placement.offset.y};
        };
        const PatternPiece& piece = layout.designs[static_cast<std::size_t>(placement.design)]
                                        .pattern.pieces[static_cast<std::size_t>(placement.piece)];
        for (const Contour& cut : piece.cuts) {
            Line& line = all.emplace_back();
            line.closed = cut.closed;
            line.operation = !cut.closed && slits            ? Operation::slit
                             : !cut.closed || cut.depth != 0 ? Operation::inner_cut
                                                             : Operation::outer_cut;
            for (const Vec2 p : cut.points) line.points.push_back(placed(p));
        }
        const std::vector<FoldPart> parts = parts_of_folds_of(piece);
        for (std::size_t n = 0; n < piece.lines.size(); ++n) {
            const PatternLine& fold = piece.lines[n];
            if (fold.kind == LineKind::mark) continue;
            // Where another piece is glued on nothing is folded.
            if (fold.kind == LineKind::seam && fold.glued_on) continue;
            const Operation operation = fold.kind == LineKind::valley     ? Operation::valley
                                        : fold.kind == LineKind::mountain ? Operation::mountain
                                                                          : Operation::seam;
            // From the front, from which all is scored here.
            const bool broken = profile.folds == FoldStyle::score && operation != Operation::valley &&
                                profile.away_folds == AwayFolds::broken;
            const auto scored = broken ? broken_score(fold.at, parts[n]) : std::vector<Segment>{fold.at};
            for (const Segment& one : scored) {
                if (profile.folds != FoldStyle::perforated)
                    all.push_back({operation, false, {placed(one.a), placed(one.b)}});
            }
            if (profile.folds == FoldStyle::perforated || profile.folds == FoldStyle::both) {
                for (const Segment& cut : perforated_part(fold.at, parts[n], profile.perforation))
                    all.push_back({Operation::perforation, false, {placed(cut.a), placed(cut.b)}});
            }
        }
    }
    return all;
}

// What it does in the drawing, in its order; not what it marks.
inline std::vector<Line> lines_of(const SheetDrawing& drawing) {
    std::vector<Line> all;
    for (const SheetShape& shape : drawing.shapes) {
        if (is_printed(shape.operation) || shape.operation == Operation::mark) continue;
        for (const popup::Run& run : drawing.runs_of(shape)) {
            const auto points = drawing.points_of(run);
            all.push_back({shape.operation, run.closed, {points.begin(), points.end()}});
        }
    }
    return all;
}

inline std::map<Operation, double> lengths_of(const std::vector<Line>& lines) {
    std::map<Operation, double> all;
    for (const Line& line : lines) all[line.operation] += line.length();
    return all;
}

// Folds, perforations, slits, inner cuts, outer cuts.
inline int turn_of(Operation operation) {
    if (is_fold(operation)) return 0;
    return static_cast<int>(operation);
}

inline bool lies_in(const Line& inner, const Line& outer) {
    const Box a = bounds(inner.points);
    const Box b = bounds(outer.points);
    if (a.min.x < b.min.x || a.min.y < b.min.y || a.max.x > b.max.x || a.max.y > b.max.y) return false;
    // Crossings of a ray from a corner upwards.
    const Vec2 p = inner.points.front();
    bool inside = false;
    for (const Segment& edge : outer.segments()) {
        if ((edge.a.x > p.x) == (edge.b.x > p.x)) continue;
        if (edge.a.y + (p.x - edge.a.x) / (edge.b.x - edge.a.x) * (edge.b.y - edge.a.y) > p.y)
            inside = !inside;
    }
    return inside;
}

// Kinds in the order of being done, and of cuts what lies in others before them.
inline void expect_order(const std::vector<Line>& lines) {
    for (std::size_t i = 1; i < lines.size(); ++i)
        EXPECT_LE(turn_of(lines[i - 1].operation), turn_of(lines[i].operation));
    for (std::size_t i = 0; i < lines.size(); ++i) {
        if (!is_cut(lines[i].operation) || !lines[i].closed) continue;
        for (std::size_t j = i + 1; j < lines.size(); ++j) {
            if (!is_cut(lines[j].operation)) continue;
            EXPECT_FALSE(lies_in(lines[j], lines[i])) << "line " << j << " lies in line " << i;
        }
    }
}

}  // namespace popup::test
