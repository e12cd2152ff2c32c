#include "input/drawing/card/outlines.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/geometry/mend_ends.h"
#include "base/nth.h"
#include "input/drawing/card/boundary.h"

namespace popup::drawing::card {
namespace {

// Corners no further from a straight line, in mm, are none.
constexpr double kInLineMm = 1e-5;

enum class Part { cut, left, right };

// A corner of the outline, and what follows it.
struct Corner {
    Vec2 at;
    Part part = Part::cut;
    int edge = -1;  // -1: a line over what stands on a side fold
};

bool have_common(const GraphEdge& a, const GraphEdge& b) {
    for (const int of : a.of) {
        if (of >= 0 && (of == b.of[0] || of == b.of[1])) return true;
    }
    return false;
}

// Without corners that lines only share with others that meet them there.
Ring simple(const SheetGraph& graph, const std::vector<Corner>& corners) {
    std::vector<Vec2> kept;
    const std::size_t count = corners.size();
    for (std::size_t i = 0; i < count; ++i) {
        const Corner& before = corners[(i + count - 1) % count];
        const Corner& here = corners[i];
        if (before.edge >= 0 && here.edge >= 0 && before.part == here.part &&
            have_common(nth(graph.edges, before.edge), nth(graph.edges, here.edge)))
            continue;
        if (here.part != Part::cut && before.part == here.part) continue;
        kept.push_back(here.at);
    }
    // One pass over what is left: a corner goes when it is straight between the last one kept and the next.
    Ring ring;
    for (std::size_t i = 0; i < kept.size(); ++i) {
        const Vec2 before = ring.empty() ? kept.back() : ring.back();
        const Vec2 after = kept[(i + 1) % kept.size()];
        const Vec2 along = after - before;
        const double size = length(along);
        const bool straight = size > 0.0 && std::abs(cross(along, kept[i] - before)) <= kInLineMm * size &&
                              dot(kept[i] - before, after - kept[i]) > 0.0;
        if (!straight) ring.push_back(kept[i]);
    }
    return ring;
}

std::vector<int> elements_of(const SheetGraph& graph, const std::vector<int>& halves) {
    std::vector<int> elements;
    elements.reserve(halves.size());
    for (const int half : halves) elements.push_back(graph.edge(half).element);
    std::sort(elements.begin(), elements.end());
    elements.erase(std::unique(elements.begin(), elements.end()), elements.end());
    return elements;
}

class OutlineMaker {
 public:
    OutlineMaker(const SheetGraph& graph, const Features& features, const DrawnFeature& feature)
        : graph_(graph),
          features_(features),
          feature_(feature),
          drive_(nth(features.drives, feature.drive)),
          halves_(outer_boundary(graph, feature.faces)) {}

    Outline run(std::vector<Segment>& moves) {
        label();
        std::vector<Corner> corners = without_notches();
        put_on_folds(corners, moves);
        Outline made;
        made.ring = simple(graph_, corners);
        made.elements = elements_of(graph_, halves_);
        return made;
    }

 private:
    void label() {
        const auto has = [](const FoldLine& line, int edge) {
            return std::find(line.edges.begin(), line.edges.end(), edge) != line.edges.end();
        };
        for (const int half : halves_) {
            Part part = Part::cut;
            if (has(feature_.left, half / 2)) part = Part::left;
            if (has(feature_.right, half / 2)) part = Part::right;
            parts_.push_back(part);
        }
        // Begun with a side fold, so that no stretch between two of them goes over the end.
        const auto first = std::find_if(parts_.begin(), parts_.end(), [](Part p) { return p != Part::cut; });
        const auto by = first == parts_.end() ? 0 : first - parts_.begin();
        std::rotate(parts_.begin(), parts_.begin() + by, parts_.end());
        std::rotate(halves_.begin(), halves_.begin() + by, halves_.end());
    }

    // True of a stretch between two parts of one side fold that something else has cut out of the feature,
    // and not its own shape.
    [[nodiscard]] bool is_notch(std::size_t from, std::size_t to, Part side) const {
        const int ground = side == Part::left ? drive_.left : drive_.right;
        for (std::size_t i = from; i < to; ++i) {
            if (nth(features_.plate_of, graph_.face_of(halves_[i] ^ 1)) != ground) return true;
        }
        return false;
    }

    [[nodiscard]] std::vector<Corner> without_notches() const {
        std::vector<Corner> corners;
        const std::size_t count = halves_.size();
        for (std::size_t i = 0; i < count;) {
            corners.push_back({graph_.at(graph_.from(halves_[i])), parts_[i], halves_[i] / 2});
            ++i;
            if (parts_[i - 1] == Part::cut) continue;
            std::size_t end = i;
            while (end < count && parts_[end] == Part::cut) ++end;
            const Part side = parts_[i - 1];
            if (end == i || parts_[end % count] != side || !is_notch(i, end, side)) continue;
            corners.push_back({graph_.at(graph_.from(halves_[i])), side, -1});
            i = end;
        }
        return corners;
    }

    void put_on_folds(std::vector<Corner>& corners, std::vector<Segment>& moves) const {
        if (feature_.outlined) return;
        const Linkage& linkage = feature_.linkage;
        const Segment left = linkage.left_line(drive_, feature_.left.line);
        const Segment right = linkage.right_line(drive_, feature_.right.line);
        const Vec2 apex = drive_.back({linkage.apex, 0.0});
        const std::size_t count = corners.size();
        for (std::size_t i = 0; i < count; ++i) {
            const Part before = corners[(i + count - 1) % count].part;
            const Part after = corners[i].part;
            const Part part = after == Part::cut ? before : after;
            if (part == Part::cut) continue;
            const Segment& line = part == Part::left ? left : right;
            const Vec2 along = unit(line.b - line.a);
            Vec2 to = line.a + dot(along, corners[i].at - line.a) * along;
            if (before != Part::cut && after != Part::cut && before != after && !linkage.parallel) to = apex;
            if (to == corners[i].at) continue;
            moves.push_back({corners[i].at, to});
            corners[i].at = to;
        }
    }

    const SheetGraph& graph_;
    const Features& features_;
    const DrawnFeature& feature_;
    const Drive& drive_;
    std::vector<int> halves_;
    std::vector<Part> parts_;
};

}  // namespace

Outline outline_of(const SheetGraph& graph, const Features& features, const DrawnFeature& feature,
                   std::vector<Segment>& moves) {
    return OutlineMaker(graph, features, feature).run(moves);
}

Outline outline_of(const SheetGraph& graph, const DrawnHole& hole) {
    const std::vector<int> halves = outer_boundary(graph, hole.faces);
    std::vector<Corner> corners;
    corners.reserve(halves.size());
    for (const int half : halves) corners.push_back({graph.at(graph.from(half)), Part::cut, half / 2});
    return {simple(graph, corners), elements_of(graph, halves)};
}

}  // namespace popup::drawing::card
