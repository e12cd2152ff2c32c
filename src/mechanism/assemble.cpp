// The skeleton finished: cut-outs taken away, folds interrupted, what is printed spread over the plates it
// lies on.
#include <algorithm>
#include <map>

#include "assembly/settle.h"
#include "base/geometry/edge_index.h"
#include "base/geometry/regions.h"
#include "base/geometry/tolerances.h"
#include "mechanism/builder.h"
#include "mechanism/spread_prints.h"
#include "popup/assembly.h"
#include "popup/check.h"

namespace popup {
namespace {

// Takes out corners at which the ring goes back the way it came: a cut-out that reaches an edge of its plate
// goes to the end of its fold, where the edge takes it back.
void without_spikes(Ring& ring) {
    constexpr double kOnWayMm = 1e-6;
    for (std::size_t i = 0; i < ring.size() && ring.size() > 3;) {
        const std::size_t n = ring.size();
        const Vec2 to = ring[(i + n - 1) % n] - ring[i];
        const Vec2 from = ring[(i + 1) % n] - ring[i];
        const double reach = std::max(length(to), length(from));
        const bool doubled = length(from) <= kOnWayMm;
        const bool back = dot(to, from) > 0.0 && std::abs(cross(to, from)) <= kOnWayMm * reach;
        if (!doubled && !back) {
            ++i;
            continue;
        }
        ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(i));
        i = i == 0 ? 0 : i - 1;
    }
}

// A plate's outline with its cut-outs taken away. They are disjoint and touch the rest of it only along
// folds, so each edge that is a fold is replaced by the way round its cut-outs, whose own side folds may be
// interrupted in turn. Exact, and linear but for sorting.
Ring without_cut_outs(const Skeleton& skeleton, int plate, const Ring& outline) {
    std::vector<CutOut> cuts = skeleton.cut_outs[static_cast<std::size_t>(plate)];
    std::sort(cuts.begin(), cuts.end(), [](const CutOut& a, const CutOut& b) {
        return a.fold != b.fold ? a.fold < b.fold : a.begin < b.begin;
    });
    // The outline runs counter-clockwise: along a fold on its left side, against it on its right. So an edge
    // is known by the corner it starts from.
    struct FoldEdge {
        Vec2 to;
        bool along;
        std::size_t first, last;
    };
    std::map<std::pair<double, double>, FoldEdge> fold_edges;
    for (std::size_t first = 0, last = 0; first < cuts.size(); first = last) {
        while (last < cuts.size() && cuts[last].fold == cuts[first].fold) ++last;
        const Fold& fold = skeleton.folds[static_cast<std::size_t>(cuts[first].fold)];
        const bool along = plate == fold.left_plate;
        const Segment edge = along ? fold.on_left : Segment{fold.on_right.b, fold.on_right.a};
        fold_edges[{edge.a.x, edge.a.y}] = {edge.b, along, first, last};
    }
    Ring ring;
    std::size_t used = 0;
    std::vector<Segment> ahead;  // edges still to walk, the next one last
    for (std::size_t i = outline.size(); i-- > 0;)
        ahead.push_back({outline[i], outline[(i + 1) % outline.size()]});
    std::vector<Vec2> way;
    while (!ahead.empty()) {
        const Segment edge = ahead.back();
        ahead.pop_back();
        const auto found = fold_edges.find({edge.a.x, edge.a.y});
        if (found == fold_edges.end() || found->second.to != edge.b) {
            ring.push_back(edge.a);
            continue;
        }
        const FoldEdge& fold = found->second;
        way = {edge.a};
        for (std::size_t n = 0; n < fold.last - fold.first; ++n) {
            const Ring& path = cuts[fold.along ? fold.first + n : fold.last - 1 - n].path;
            if (fold.along)
                way.insert(way.end(), path.begin(), path.end());
            else
                way.insert(way.end(), path.rbegin(), path.rend());
        }
        way.push_back(edge.b);
        for (std::size_t n = way.size() - 1; n-- > 0;) ahead.push_back({way[n], way[n + 1]});
        used += fold.last - fold.first;
    }
    POPUP_INVARIANT(used == cuts.size());
    without_spikes(ring);
    return ring;
}

// Cuts the holes that go through whole sheets out of the plates, and their borders into the pieces. What was
// cut there before goes: it is no longer paper.
void cut_windows(const Skeleton& skeleton, Assembly& assembly) {
    if (skeleton.windows.empty()) return;
    for (std::size_t i = 0; i < assembly.plates.size(); ++i) {
        std::vector<Polygon> through;
        for (const int hole : skeleton.holes_of[i]) {
            const Hole& one = skeleton.holes[static_cast<std::size_t>(hole)];
            if (one.through) through.push_back({{one.ring.rbegin(), one.ring.rend()}, {}});
        }
        if (through.empty()) continue;
        std::vector<Polygon> left = subtract({assembly.plates[i].outline}, through);
        POPUP_INVARIANT(!left.empty());
        assembly.plates[i].outline = *std::max_element(
            left.begin(), left.end(), [](const Polygon& a, const Polygon& b) { return area(a) < area(b); });
    }
    std::map<int, std::vector<Polygon>> of_piece;
    for (const Window& window : skeleton.windows) {
        const auto on_page = std::find(skeleton.plate_page.begin(), skeleton.plate_page.end(), window.page);
        const auto plate = static_cast<std::size_t>(on_page - skeleton.plate_page.begin());
        of_piece[assembly.plates[plate].piece].push_back({window.ring, {}});
    }
    std::vector<Line> lines;
    std::map<int, std::pair<std::vector<Polygon>, EdgeIndex>> indexed;
    for (auto& [piece, windows] : of_piece) {
        auto& [joined, boxes] = indexed[piece];
        joined = unite(windows);
        for (const Polygon& one : joined) {
            const Box box = bounds(one.outer);
            boxes.insert({box.min, box.max}, false);
        }
    }
    std::vector<int> found;
    for (const Line& line : assembly.lines) {
        const auto windows = indexed.find(line.piece);
        if (line.kind != LineKind::cut || windows == indexed.end()) {
            lines.push_back(line);
            continue;
        }
        Box box;
        box.extend(line.at.a);
        box.extend(line.at.b);
        found.clear();
        windows->second.second.query(box, found);
        const double size = distance(line.at.a, line.at.b);
        std::vector<std::pair<double, double>> inside;
        for (const int number : found) {
            const Polygon& window = windows->second.first[static_cast<std::size_t>(number)];
            for (const auto& part : clip_line({line.at.a, line.at.b}, window))
                inside.emplace_back(distance(line.at.a, part.front()), distance(line.at.a, part.back()));
        }
        if (inside.empty()) {
            lines.push_back(line);
            continue;
        }
        std::sort(inside.begin(), inside.end());
        inside.emplace_back(size, size);
        double from = 0.0;
        for (const auto& [begin, end] : inside) {
            if (begin - from > kGridMm) {
                Line rest = line;
                rest.at = {from <= 0.0 ? line.at.a : lerp(line.at.a, line.at.b, from / size),
                           begin >= size ? line.at.b : lerp(line.at.a, line.at.b, begin / size)};
                lines.push_back(rest);
            }
            from = std::max(from, end);
        }
    }
    for (const auto& [piece, windows] : indexed) {
        for (const Polygon& window : windows.first) {
            for (const Segment& edge : edges_of(window))
                lines.push_back({LineKind::cut, edge, piece, -1, -1});
        }
    }
    assembly.lines = std::move(lines);
}

void add_fold_lines(const Skeleton& skeleton, Assembly& assembly) {
    const auto piece_of = [&](int plate) { return assembly.plates[static_cast<std::size_t>(plate)].piece; };
    for (const Fold& fold : skeleton.folds) {
        if (fold.seam) {
            assembly.lines.push_back(
                {LineKind::seam, fold.on_left, piece_of(fold.left_plate), fold.left_plate, -1});
            assembly.lines.push_back(
                {LineKind::seam, fold.on_right, piece_of(fold.right_plate), fold.right_plate, -1});
            continue;
        }
        // A fold that is flat in the closed card is bent back on the way there: else nothing would hold it.
        const LineKind kind = fold.closed_deg == 0 ? LineKind::valley : LineKind::mountain;
        const double size = fold.length();
        const auto stretch = [&](double lo, double hi) {
            // A rest this short is the rounding of two things that end in one place.
            if (hi - lo < kSameLineMm) return;
            const Segment at{lo <= 0.0 ? fold.on_left.a : lerp(fold.on_left.a, fold.on_left.b, lo / size),
                             hi >= size ? fold.on_left.b : lerp(fold.on_left.a, fold.on_left.b, hi / size)};
            assembly.lines.push_back(
                {kind, at, piece_of(fold.left_plate), fold.left_plate, fold.right_plate});
        };
        double from = 0.0;
        for (const auto& [begin, span] : fold.gone) {
            stretch(from, begin);
            from = span.end;
        }
        stretch(from, size);
    }
}

}  // namespace

std::string_view to_string(LineKind kind) {
    switch (kind) {
        case LineKind::cut:
            return "cut";
        case LineKind::mountain:
            return "mountain";
        case LineKind::valley:
            return "valley";
        case LineKind::seam:
            return "seam";
        case LineKind::mark:
            return "mark";
    }
    return "";
}

std::optional<Assembly> assemble(const CheckedDesign& design, const AssembleOptions& options,
                                 Diagnostics& diagnostics) {
    const Skeleton& skeleton = design.skeleton();
    Assembly assembly = skeleton.draft;
    for (std::size_t i = 0; i < assembly.plates.size(); ++i) {
        Ring& outline = assembly.plates[i].outline.outer;
        assembly.plates[i].uncut = outline;
        if (!skeleton.cut_outs[i].empty()) outline = without_cut_outs(skeleton, static_cast<int>(i), outline);
    }
    for (const Hole& hole : skeleton.holes) {
        if (!hole.through)
            assembly.plates[static_cast<std::size_t>(hole.plate)].outline.holes.push_back(hole.ring);
    }
    cut_windows(skeleton, assembly);
    add_fold_lines(skeleton, assembly);
    spread_prints(skeleton, design.design(), options, assembly, diagnostics);
    assembly.curves = CurveTable(skeleton.curves);
    assembly.sweep.to_deg = design.design().opens_deg;
    settle_numbers(assembly);
    return assembly;
}

}  // namespace popup
