#include "input/drawing/card/leftovers.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/nth.h"
#include "input/drawing/card/boundary.h"
#include "input/drawing/card/mend_ends.h"

namespace popup::drawing::card {
namespace {

class LeftoverFinder {
 public:
    LeftoverFinder(const SheetGraph& graph, const Features& features) : graph_(graph), features_(features) {
        for (std::size_t i = 0; i < features.drives.size(); ++i) {
            const Drive& drive = features.drives[i];
            drives_of_[std::minmax(drive.left, drive.right)].push_back(static_cast<int>(i));
        }
    }

    Leftovers run() {
        sort_loose();
        look_at_features();
        look_at_folds();
        look_at_cuts();
        look_at_hanging();
        return std::move(out_);
    }

 private:
    struct Loose {
        std::vector<int> faces, ring;
    };

    [[nodiscard]] int plate_of(int face) const { return nth(features_.plate_of, face); }

    // Holes, and what lies in them or outside of the page.
    void sort_loose() {
        std::vector<Loose> elsewhere;
        for (auto& [group, faces] : loose_groups(graph_, features_)) {
            if (features_.refused.count(group) > 0) continue;
            std::vector<int> ring = outer_boundary(graph_, faces);
            if (ring.empty()) continue;
            // Some of the border may be that of others that fall out.
            if (*plates_around(graph_, features_, ring).rbegin() >= 0)
                out_.holes.push_back({faces});
            else
                elsewhere.push_back({faces, std::move(ring)});
        }
        find_outside(elsewhere);
        for (const Loose& one : elsewhere) {
            if (nth(outside_, one.faces.front()) != 0) continue;
            out_.islands.push_back(
                {first_element(graph_, one.ring), {}, graph_.at(graph_.from(one.ring.front()))});
        }
        std::set<int> told;
        for (std::size_t i = 0; i < graph_.edges.size(); ++i) {
            const int half = static_cast<int>(2 * i);
            const GraphEdge& edge = graph_.edges[i];
            if (nth(outside_, graph_.face_of(half)) == 0 || nth(outside_, graph_.face_of(half ^ 1)) == 0)
                continue;
            if (told.insert(edge.element).second)
                out_.outside.push_back({edge.element, {}, graph_.at(edge.a)});
        }
    }

    void find_outside(const std::vector<Loose>& loose) {
        outside_.assign(static_cast<std::size_t>(graph_.faces()), 0);
        outside_[0] = 1;
        for (bool more = true; more;) {
            more = false;
            for (const Loose& one : loose) {
                const bool beside = std::any_of(one.ring.begin(), one.ring.end(), [&](int half) {
                    return nth(outside_, graph_.face_of(half ^ 1)) != 0;
                });
                if (!beside || nth(outside_, one.faces.front()) != 0) continue;
                for (const int face : one.faces) nth(outside_, face) = 1;
                more = true;
            }
        }
    }

    void look_at_features() {
        for (const DrawnFeature& feature : features_.features) {
            const Drive& drive = nth(features_.drives, feature.drive);
            for (const FoldLine* line : {&feature.left, &feature.right, &feature.centre}) {
                const bool mountain = (line == &feature.centre) != drive.mountain;
                for (const int edge : line->edges) tell_way(edge, mountain);
                used_.insert(line->edges.begin(), line->edges.end());
            }
            used_.insert(feature.run_on.begin(), feature.run_on.end());
            if (feature.run_on.empty() || feature.outlined) continue;
            const GraphEdge& edge = nth(graph_.edges, feature.run_on.front());
            out_.run_on.push_back({edge.element, {}, graph_.at(edge.a)});
        }
    }

    // Where the end of a line and the chord of a curve that it meets are not quite one.
    [[nodiscard]] bool is_rounding(int edge) const {
        const Segment s = graph_.segment(2 * edge);
        return distance(s.a, s.b) <= kSilentMm;
    }

    void tell_way(int edge, bool mountain) {
        const unsigned ink = nth(graph_.edges, edge).ink & (kMountain | kValley);
        if (ink == 0 || is_rounding(edge)) return;
        const bool right = (ink & (mountain ? kMountain : kValley)) != 0;
        (right ? out_.as_drawn : out_.other_way).push_back(edge);
    }

    // Whether a fold between two plates is a stretch of one that features stand on.
    [[nodiscard]] bool is_drive(int a, int b, const Segment& s) const {
        const auto drives = drives_of_.find(std::minmax(a, b));
        if (drives == drives_of_.end()) return false;
        return std::any_of(drives->second.begin(), drives->second.end(),
                           [&](int drive) { return runs_along(nth(features_.drives, drive), s); });
    }

    void look_at_folds() {
        for (std::size_t i = 0; i < graph_.edges.size(); ++i) {
            const int half = static_cast<int>(2 * i);
            const GraphEdge& edge = graph_.edges[i];
            const int a = graph_.face_of(half);
            const int b = graph_.face_of(half ^ 1);
            if (!is_fold(edge) || a == 0 || b == 0 || used_.count(static_cast<int>(i)) > 0 ||
                is_rounding(static_cast<int>(i)))
                continue;
            const int p = plate_of(a);
            const int q = plate_of(b);
            const bool hangs = p < 0 || q < 0;
            if (a != b && hangs) continue;  // told with what hangs there
            const Segment s = graph_.segment(half);
            if (p != q && is_drive(p, q, s)) {
                if (p + q == 1) tell_way(static_cast<int>(i), false);
                continue;
            }
            const double size = distance(s.a, s.b);
            out_.faults.push_back(
                {edge.element,
                 a == b ? fmt::format("this fold ends in the paper, {:.2f} mm of it", size)
                        : fmt::format("{:.2f} mm of this fold belong to nothing that moves", size),
                 s.a});
        }
    }

    // Cuts with one face on both sides.
    void look_at_cuts() {
        for (std::size_t i = 0; i < graph_.edges.size(); ++i) {
            const int half = static_cast<int>(2 * i);
            const GraphEdge& edge = graph_.edges[i];
            const int face = graph_.face_of(half);
            if (is_fold(edge) || face != graph_.face_of(half ^ 1) || nth(outside_, face) != 0 ||
                is_rounding(static_cast<int>(i)))
                continue;
            const Segment s = graph_.segment(half);
            out_.faults.push_back(
                {edge.element,
                 fmt::format("this cut parts nothing, {:.2f} mm of it: it ends in the paper",
                             distance(s.a, s.b)),
                 s.a});
        }
    }

    // Faces that hang on plates and are no features, once a group.
    void look_at_hanging() {
        std::set<int> loose;
        for (const auto& [group, faces] : loose_groups(graph_, features_)) loose.insert(group);
        std::vector<char> seen(static_cast<std::size_t>(graph_.faces()), 0);
        for (int first = 1; first < graph_.faces(); ++first) {
            if (nth(seen, first) != 0 || plate_of(first) >= 0 || nth(outside_, first) != 0 ||
                loose.count(nth(features_.group_of, first)) > 0)
                continue;
            tell_hanging(first, seen);
        }
    }

    void tell_hanging(int first, std::vector<char>& seen) {
        std::vector<int> part{first};
        nth(seen, first) = 1;
        NoLinkage why{"it stands on no fold that moves", HUGE_VAL};
        bool tried = false;
        int element = -1;
        Vec2 at;
        for (std::size_t i = 0; i < part.size(); ++i) {
            const auto found = features_.why.find(part[i]);
            if (found != features_.why.end() && (!tried || found->second.off < why.off)) {
                why = found->second;
                tried = true;
            }
            for (const int half : graph_.halves_of(part[i])) {
                const GraphEdge& edge = graph_.edge(half);
                const int next = graph_.face_of(half ^ 1);
                if (!is_fold(edge) || next == 0) continue;
                if (element < 0 || edge.element < element) {
                    element = edge.element;
                    at = graph_.at(edge.a);
                }
                if (plate_of(next) >= 0 || nth(seen, next) != 0) continue;
                nth(seen, next) = 1;
                part.push_back(next);
            }
        }
        if (element >= 0)
            out_.faults.push_back({element, "what is cut out here cannot pop up: " + why.what, at});
    }

    const SheetGraph& graph_;
    const Features& features_;
    std::map<std::pair<int, int>, std::vector<int>> drives_of_;
    std::vector<char> outside_;  // faces
    std::set<int> used_;         // folds
    Leftovers out_;
};

}  // namespace

Leftovers find_leftovers(const SheetGraph& graph, const Features& features) {
    return LeftoverFinder(graph, features).run();
}

}  // namespace popup::drawing::card
