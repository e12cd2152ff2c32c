#include "mechanism/drawn_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "base/geometry/edge_index.h"
#include "base/geometry/regions.h"
#include "base/sets.h"
#include "mechanism/site_lines.h"
#include "mechanism/thin_places.h"

namespace popup {
namespace {

// Areas that differ by less are the same, rounded.
constexpr double kSpeckMm2 = 0.01;

const DrawnPath* drawn_of(const Element& e, std::string_view name) {
    const auto number = find_parameter(*e.info, name);
    return number ? std::get_if<DrawnPath>(&e.arguments[*number].value) : nullptr;
}

// The lines of a path; nullopt: one of them is longer than anybody draws.
std::optional<std::vector<Border>> lines_of(const Path& path) {
    std::vector<Border> lines;
    for (const Subpath& subpath : path.subpaths()) {
        Border line;
        if (border_of(subpath, line) != FlatteningFault::none) return std::nullopt;
        if (line.edges.size() >= 3) lines.push_back(std::move(line));
    }
    return lines;
}

Path path_of_all(std::span<const Border> lines) {
    Path path;
    for (const Border& line : lines) {
        const Path one = path_of(line);
        for (const Subpath& subpath : one.subpaths()) {
            path.move(subpath.start);
            for (const PathStep& step : subpath.steps) {
                if (step.curve)
                    path.cubic(step.control_1, step.control_2, step.to);
                else
                    path.line(step.to);
            }
            path.close();
        }
    }
    return path;
}

double size_of(const Border& line) { return std::abs(signed_area(ring_of(line))); }

// Whether a line alone encloses one area that touches itself nowhere.
bool is_simple(const Border& line) {
    const std::vector<Polygon> areas = filled({ring_of(line)}, FillRule::even_odd);
    return areas.size() == 1 && !touching(areas);
}

// Takes the loops out of each line, and sets whether that was told; false after failed().
bool mend_loops(Element& e, std::string_view what, std::vector<Border>& lines, bool& told) {
    std::vector<DroppedLoop> dropped;
    std::size_t edges = 0;
    for (Border& line : lines) {
        edges += line.edges.size();
        if (is_simple(line)) continue;
        const LoopRepair loops = without_loops(line);
        if (loops.hopeless) {
            e.failed("outline-crosses",
                     fmt::format("{} crosses itself at {} and in more than {} places", what,
                                 at_mm(loops.dropped.front().at), loops.dropped.size() - 1),
                     "draw a line that goes round once and nowhere meets itself");
            return false;
        }
        dropped.insert(dropped.end(), loops.dropped.begin(), loops.dropped.end());
    }
    std::erase_if(lines, [](const Border& line) { return line.edges.size() < 3; });
    double left = 0.0;
    for (const Border& line : lines) left = std::max(left, size_of(line));
    told = tell_loops(e, what, dropped, edges, left);
    return true;
}

// A ring of regions as a border again: its edges are parts of these lines, and know which curve they were.
Border border_of_ring(const Ring& ring, std::span<const Border> lines) {
    struct Chord {
        BorderEdge edge;
        int first_curve;
    };
    Border made;
    std::vector<Chord> chords;
    std::vector<Segment> segments;
    for (const Border& line : lines) {
        const int first = static_cast<int>(made.cubics.size());
        made.cubics.insert(made.cubics.end(), line.cubics.begin(), line.cubics.end());
        for (std::size_t i = 0; i < line.edges.size(); ++i) {
            if (line.edges[i].curve < 0) continue;
            chords.push_back({line.edges[i], first});
            segments.push_back(line.chord(i));
        }
    }
    const EdgeIndex index({}, segments);
    // How far along the curve, at its ends exactly: so stretches of a curve stay one curve.
    const auto along = [](const Chord& chord, const Segment& s, Vec2 p) {
        if (distance(p, s.a) <= kOnGridLineMm) return chord.edge.t0;
        if (distance(p, s.b) <= kOnGridLineMm) return chord.edge.t1;
        const Vec2 way = s.b - s.a;
        return std::lerp(chord.edge.t0, chord.edge.t1, dot(way, p - s.a) / dot(way, way));
    };
    std::vector<int> near;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Vec2 from = ring[i];
        const Vec2 to = ring[i + 1 == ring.size() ? 0 : i + 1];
        BorderEdge edge{from, -1, 0.0, 0.0};
        Box box;
        box.extend(from);
        box.extend(to);
        near.clear();
        index.query(box, near);
        for (const int n : near) {
            const Segment& s = segments[static_cast<std::size_t>(n)];
            if (distance(from, s) > kOnGridLineMm || distance(to, s) > kOnGridLineMm) continue;
            const Chord& chord = chords[static_cast<std::size_t>(n)];
            edge = {from, chord.first_curve + chord.edge.curve, along(chord, s, from), along(chord, s, to)};
            break;
        }
        made.edges.push_back(edge);
    }
    return made;
}

struct Overlaps {
    std::size_t lines = 0;  // that overlap others
    double area_mm2 = 0.0;  // of the largest overlap, and its middle
    Vec2 at;
};

// Lines that cross others become one with them. Of two that are one in the other, with their borders apart or
// in common, neither changes; lines that are the same are one. Cost: quadratic in lines whose boxes overlap.
Overlaps merge(std::vector<Border>& lines) {
    const std::size_t n = lines.size();
    std::vector<std::vector<Polygon>> areas;
    std::vector<Box> boxes;
    for (const Border& line : lines) {
        areas.push_back(filled({ring_of(line)}, FillRule::non_zero));
        boxes.push_back(bounds(ring_of(line)));
    }
    std::vector<std::size_t> order(n);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return std::pair(boxes[a].min.x, a) < std::pair(boxes[b].min.x, b);
    });
    Sets groups(n);
    Overlaps found;
    for (auto one = order.begin(); one != order.end(); ++one) {
        for (auto two = one + 1; two != order.end() && boxes[*two].min.x <= boxes[*one].max.x; ++two) {
            const auto [i, j] = std::minmax(*one, *two);
            if (boxes[i].max.y < boxes[j].min.y || boxes[j].max.y < boxes[i].min.y) continue;
            const std::vector<Polygon> both = intersect(areas[i], areas[j]);
            const double shared = area(both);
            const double only_i = area(areas[i]) - shared;
            const double only_j = area(areas[j]) - shared;
            if (shared <= kSpeckMm2 || (only_i <= kSpeckMm2) != (only_j <= kSpeckMm2)) continue;
            if (shared > found.area_mm2) {
                found.area_mm2 = shared;
                found.at = bounds(both.front().outer).centre();
            }
            groups.unite(static_cast<int>(i), static_cast<int>(j));
        }
    }
    if (found.area_mm2 == 0.0) return found;
    std::vector<Border> made;
    for (std::size_t first = 0; first < n; ++first) {
        std::vector<Polygon> members;
        std::vector<Border> of;
        for (std::size_t i = first; i < n; ++i) {
            if (groups.find(static_cast<int>(i)) != static_cast<int>(first)) continue;
            members.insert(members.end(), areas[i].begin(), areas[i].end());
            of.push_back(lines[i]);
        }
        if (of.size() <= 1) {
            made.insert(made.end(), of.begin(), of.end());
            continue;
        }
        found.lines += of.size();
        for (const Polygon& part : unite(members)) {
            made.push_back(border_of_ring(part.outer, of));
            for (const Ring& island : part.holes) made.push_back(border_of_ring(island, of));
        }
    }
    lines = std::move(made);
    return found;
}

void tell_overlaps(Element& e, const Overlaps& found, std::size_t before, std::size_t after) {
    e.redrawn = Change{fmt::format("{} lines of holes", before), fmt::format("{} of them", after)};
    e.repaired("holes-cross",
               fmt::format("{} of its holes overlap, at {} by {:.2f} mm², which would fall out; they are cut "
                           "as one",
                           found.lines, at_mm(found.at), found.area_mm2),
               "draw them as one, or apart from one another");
}

}  // namespace

void write_path(Element& e, std::string_view name, Path path) {
    Argument& argument = e.arguments[*find_parameter(*e.info, name)];
    DrawnPath drawn;
    drawn.path = std::move(path);
    drawn.moved = true;
    if (enclose(drawn.path, drawn.inside) != FlatteningFault::none) return;
    argument.value = std::move(drawn);
    argument.changed = true;
}

bool tell_loops(Element& e, std::string_view what, std::span<const DroppedLoop> dropped, std::size_t edges,
                double left) {
    const DroppedLoop* largest = nullptr;
    std::size_t seen = 0;
    for (const DroppedLoop& loop : dropped) {
        if (loop.size_mm <= e.tolerances->rounding_mm) continue;
        ++seen;
        if (largest == nullptr || loop.area_mm2 > largest->area_mm2) largest = &loop;
    }
    if (largest == nullptr) return false;
    e.redrawn =
        Change{fmt::format("an outline of {} edges with {} loop{}", edges, seen, seen == 1 ? "" : "s"),
               fmt::format("an outline that encloses {:.2f} mm²", left)};
    e.repaired(
        "outline-crosses",
        fmt::format("{} crosses or touches itself {}; the smaller loop, of {:.2f} mm², is no part of it now",
                    what,
                    seen == 1 ? "at " + at_mm(largest->at)
                              : fmt::format("in {} places, the largest loop at {}", seen, at_mm(largest->at)),
                    largest->area_mm2),
        "draw a line that goes round once and nowhere meets itself");
    return true;
}

bool mend_outline(Element& e) {
    const DrawnPath* drawn = drawn_of(e, "outline");
    if (drawn == nullptr || (drawn->inside.areas.size() == 1 && !touching(drawn->inside.areas))) return true;
    auto lines = lines_of(drawn->path);
    if (!lines || lines->empty()) return true;
    bool told = false;
    if (!mend_loops(e, "its outline", *lines, told)) return false;
    if (lines->size() > 2) {
        const auto around =
            std::max_element(lines->begin(), lines->end(),
                             [](const Border& a, const Border& b) { return size_of(a) < size_of(b); });
        std::vector<Border> holes(lines->begin(), around);
        holes.insert(holes.end(), around + 1, lines->end());
        const std::size_t before = holes.size();
        if (const Overlaps found = merge(holes); found.lines > 0) {
            Border outer = std::move(*around);
            lines = std::move(holes);
            lines->insert(lines->begin(), std::move(outer));
            tell_overlaps(e, found, before, lines->size() - 1);
            told = true;
        }
    }
    // Loops that are only rounding go where they would be areas of their own.
    if (told || drawn->inside.areas.size() != 1) write_path(e, "outline", path_of_all(*lines));
    return true;
}

bool mend_holes(Element& e, std::string_view name, std::string_view what) {
    const DrawnPath* drawn = drawn_of(e, name);
    if (drawn == nullptr) return true;
    auto lines = lines_of(drawn->path);
    if (!lines || lines->empty()) return true;
    double each = 0.0;
    for (const Border& line : *lines) each += size_of(line);
    const bool apart = std::abs(each - area(drawn->inside.areas)) <= kSpeckMm2;
    if (apart && !touching(drawn->inside.areas)) return true;
    bool told = false;
    if (!mend_loops(e, what, *lines, told)) return false;
    const std::size_t before = lines->size();
    if (const Overlaps found = merge(*lines); found.lines > 0) {
        tell_overlaps(e, found, before, lines->size());
        told = true;
    }
    if (told) write_path(e, name, path_of_all(*lines));
    return true;
}

}  // namespace popup
