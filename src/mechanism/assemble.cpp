// The skeleton finished: cut-outs taken away, folds interrupted, drawn lines spread over the plates they lie
// on.
#include <fmt/format.h>

#include <algorithm>

#include "base/edge_index.h"
#include "base/regions.h"
#include "mechanism/builder.h"
#include "popup/assembly.h"
#include "popup/check.h"
#include "popup/units.h"

namespace popup {
namespace {

constexpr double kSliver = 0.01;  // mm²: less is rounding along a cut, not paper

bool cut_out(const Skeleton& skeleton, Assembly& assembly, Diagnostics& diagnostics) {
    bool ok = true;
    for (std::size_t i = 0; i < assembly.plates.size(); ++i) {
        const auto& rings = skeleton.cut_outs[i];
        if (rings.empty()) continue;
        Plate& plate = assembly.plates[i];
        std::vector<Polygon> gone;
        gone.reserve(rings.size());
        for (const Ring& ring : rings) gone.push_back({ring, {}});
        std::vector<Polygon> left = subtract({plate.outline}, gone);
        std::erase_if(left, [](const Polygon& p) { return area(p) < kSliver; });
        if (left.size() != 1) {
            diagnostics
                .error("plane-falls-apart", {},
                       fmt::format(
                           "what is cut from {} leaves {} parts of it, where one piece of paper must remain",
                           plate.name, left.size()))
                .hint("leave paper between the elements that stand on it");
            ok = false;
            continue;
        }
        plate.outline = std::move(left.front());
    }
    return ok;
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
        const LineKind kind = fold.closed_deg == 360 ? LineKind::mountain : LineKind::valley;
        const double size = fold.length();
        const auto stretch = [&](double lo, double hi) {
            if (hi - lo < kGridMm) return;
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

// Each page's lines go to the plates whose paper they cross; a plate's lines are clipped together.
void spread_lines(const Skeleton& skeleton, const Design& design, Assembly& assembly) {
    if (design.lines.empty()) return;
    std::vector<EdgeIndex> boxes(skeleton.page_mirrored.size());
    std::vector<std::vector<int>> plates(boxes.size());
    for (std::size_t i = 0; i < assembly.plates.size(); ++i) {
        const Box box = bounds(assembly.plates[i].outline.outer);
        const auto page = static_cast<std::size_t>(skeleton.plate_page[i]);
        boxes[page].insert({box.min, box.max}, false);
        plates[page].push_back(static_cast<int>(i));
    }
    std::vector<std::vector<std::vector<Vec2>>> paths(assembly.plates.size());
    std::vector<std::vector<const DrawnLine*>> sources(assembly.plates.size());
    std::vector<int> found;
    for (const DrawnLine& line : design.lines) {
        if (line.dropped) continue;
        const auto page = static_cast<std::size_t>(line.page);
        std::vector<Vec2> path;
        Box box;
        for (const DesignPoint& point : line.points) {
            path.push_back(skeleton.page_mirrored[page] ? Vec2{-point.at.x, point.at.y} : point.at);
            box.extend(path.back());
        }
        found.clear();
        boxes[page].query(box, found);
        for (const int number : found) {
            const auto plate = static_cast<std::size_t>(plates[page][static_cast<std::size_t>(number)]);
            paths[plate].push_back(path);
            sources[plate].push_back(&line);
        }
    }
    for (std::size_t i = 0; i < paths.size(); ++i) {
        if (paths[i].empty()) continue;
        auto parts = clip_lines(paths[i], assembly.plates[i].outline);
        for (std::size_t k = 0; k < parts.size(); ++k) {
            const double width = Length::points(sources[i][k]->thickness_pt).mm;
            for (auto& part : parts[k]) {
                assembly.plates[i].strokes.push_back({std::move(part), width, sources[i][k]->color});
            }
        }
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

std::optional<Assembly> assemble(const CheckedDesign& design, const AssembleOptions& /*options*/,
                                 Diagnostics& diagnostics) {
    const Skeleton& skeleton = design.skeleton();
    Assembly assembly = skeleton.draft;
    if (!cut_out(skeleton, assembly, diagnostics)) return std::nullopt;
    add_fold_lines(skeleton, assembly);
    spread_lines(skeleton, design.design(), assembly);
    return assembly;
}

}  // namespace popup
