#include "input/drawing/card/leftovers.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "base/geometry/mend_ends.h"
#include "base/nth.h"
#include "input/drawing/card/boundary.h"

namespace popup::drawing::card {
namespace {

class LeftoverFinder {
 public:
    LeftoverFinder(const SheetGraph& graph, const Features& features) : graph_(graph), features_(features) {
        for (std::size_t i = 0; i < features.drives.size(); ++i) {
            const Drive& drive = features.drives[i];
            drives_of_[std::minmax(drive.left, drive.right)].push_back(static_cast<int>(i));
        }
        owner_.assign(static_cast<std::size_t>(graph.faces()), -1);
        for (std::size_t i = 0; i < features.features.size(); ++i) {
            for (const int face : features.features[i].faces) nth(owner_, face) = static_cast<int>(i);
        }
    }

    Leftovers run() {
        sort_loose();
        in_hole_.assign(static_cast<std::size_t>(graph_.faces()), 0);
        for (const DrawnHole& hole : out_.holes) {
            for (const int face : hole.faces) nth(in_hole_, face) = 1;
        }
        look_at_features();
        look_at_lines();
        look_at_plates();
        look_at_cuts_on_folds();
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
        std::erase_if(elsewhere, [&](const Loose& one) { return nth(outside_, one.faces.front()) != 0; });
        take_overlaps(elsewhere);
        for (const Loose& one : elsewhere) {
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

    // Where closed cuts overlap, what both enclose falls out as well. It is no island: an island lies in one
    // hole, and this has two holes beside it. All three become one hole.
    void take_overlaps(std::vector<Loose>& loose) {
        const auto group = [&](int face) { return nth(features_.group_of, face); };
        std::map<int, std::size_t> number;  // in `loose`, by group
        for (std::size_t i = 0; i < loose.size(); ++i) number[group(loose[i].faces.front())] = i;
        std::vector<std::size_t> joined(out_.holes.size());  // to the first of those that are one with a hole
        std::iota(joined.begin(), joined.end(), std::size_t{0});
        const auto first_of = [&](std::size_t hole) {
            while (joined[hole] != hole) hole = joined[hole];
            return hole;
        };
        struct Beside {
            int group = -1;
            std::size_t hole = 0;
        };
        std::vector<Beside> known(loose.size());
        std::vector<char> taken(loose.size(), 0);
        std::vector<std::pair<std::vector<int>, std::size_t>> ahead;  // faces, and the hole they are of
        for (std::size_t i = out_.holes.size(); i-- > 0;) ahead.emplace_back(out_.holes[i].faces, i);
        while (!ahead.empty()) {
            const auto [faces, hole] = std::move(ahead.back());
            ahead.pop_back();
            for (const int face : faces) {
                for (const int half : graph_.halves_of(face)) {
                    const auto found = number.find(group(graph_.face_of(half ^ 1)));
                    if (found == number.end()) continue;
                    const std::size_t one = found->second;
                    if (known[one].group < 0) known[one] = {group(face), hole};
                    if (known[one].group == group(face)) continue;
                    const std::size_t a = first_of(known[one].hole);
                    const std::size_t b = first_of(hole);
                    joined[std::max(a, b)] = std::min(a, b);
                    if (taken[one] == 0) ahead.emplace_back(loose[one].faces, std::min(a, b));
                    taken[one] = 1;
                }
            }
        }
        for (std::size_t i = 0; i < loose.size(); ++i) {
            if (taken[i] != 0) append(out_.holes[first_of(known[i].hole)].faces, loose[i].faces);
        }
        for (std::size_t i = 0; i < joined.size(); ++i) {
            if (joined[i] == i) continue;
            append(out_.holes[first_of(i)].faces, out_.holes[i].faces);
            out_.holes[i].faces.clear();
        }
        std::erase_if(out_.holes, [](const DrawnHole& hole) { return hole.faces.empty(); });
        std::erase_if(loose, [&](const Loose& one) { return taken[number[group(one.faces.front())]] != 0; });
    }

    static void append(std::vector<int>& faces, const std::vector<int>& more) {
        faces.insert(faces.end(), more.begin(), more.end());
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
                // The fold that an outline lies across was drawn on through it as what it is elsewhere.
                const bool drawn_on =
                    feature.outlined && !line->edges.empty() && runs_along(drive, line->line);
                for (const int edge : line->edges) {
                    if (!drawn_on) tell_way(edge, mountain);
                }
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
        const Segment s = graph_.segment(2 * edge);
        // Shorter ones are ends that run over.
        if (ink == 0 || distance(s.a, s.b) <= kSnapMm) return;
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

    // What stretches of lines do that are no part of anything.
    enum class Idle { fold_in_paper, fold_of_nothing, cut, cut_in_feature };

    void look_at_lines() {
        for (std::size_t i = 0; i < graph_.edges.size(); ++i) {
            const int number = static_cast<int>(i);
            if (!is_fold(graph_.edges[i]))
                look_at_cut(number);
            else if (!is_rounding(number))
                look_at_fold(number);
        }
        tell_idle();
    }

    void look_at_cut(int number) {
        const int a = graph_.face_of(2 * number);
        const int b = graph_.face_of(2 * number + 1);
        if (a == b) return add_idle(number, Idle::cut);
        if (plate_of(a) < 0 || plate_of(b) < 0 || is_rounding(number)) return;
        // An element is what its border encloses: it has no other cut.
        const int mine = nth(owner_, a);
        const int other = nth(owner_, b);
        if (mine == other) return add_idle(number, Idle::cut_in_feature);
        if (mine < 0 || other < 0 || stands_on(mine, other) || stands_on(other, mine)) return;
        const Segment s = graph_.segment(2 * number);
        shared_ += distance(s.a, s.b);
        if (shared_ > kSnapMm) out_.beyond_elements = true;
    }

    // Whether a feature stands on a fold of another.
    [[nodiscard]] bool stands_on(int feature, int other) const {
        const Drive& drive = nth(features_.drives, nth(features_.features, feature).drive);
        const std::vector<int>& faces = nth(features_.features, other).faces;
        return std::any_of(faces.begin(), faces.end(), [&](int face) {
            return plate_of(face) == drive.left || plate_of(face) == drive.right;
        });
    }

    // A plate of a feature in several parts, with a hole between them.
    void look_at_plates() {
        for (const DrawnHole& hole : out_.holes) {
            std::map<int, std::set<int>> beside;  // by plate its faces beside the hole
            for (const int face : hole.faces) {
                for (const int half : graph_.halves_of(face)) {
                    const int next = graph_.face_of(half ^ 1);
                    if (plate_of(next) >= 0 && nth(owner_, next) >= 0) beside[plate_of(next)].insert(next);
                }
            }
            for (const auto& [plate, faces] : beside) {
                if (faces.size() > 1 && !hang_together(faces)) out_.beyond_elements = true;
            }
        }
    }

    // Whether faces of one plate are parted by no more than folds that are drawn on through it.
    [[nodiscard]] bool hang_together(const std::set<int>& faces) const {
        const int plate = plate_of(*faces.begin());
        std::set<int> reached{*faces.begin()};
        std::vector<int> ahead{*faces.begin()};
        while (!ahead.empty()) {
            const int face = ahead.back();
            ahead.pop_back();
            for (const int half : graph_.halves_of(face)) {
                const int next = graph_.face_of(half ^ 1);
                if (is_fold(graph_.edge(half)) && plate_of(next) == plate && reached.insert(next).second)
                    ahead.push_back(next);
            }
        }
        return std::includes(reached.begin(), reached.end(), faces.begin(), faces.end());
    }

    void look_at_fold(int number) {
        const int a = graph_.face_of(2 * number);
        const int b = graph_.face_of(2 * number + 1);
        if (a == 0 || b == 0 || used_.count(number) > 0) return;
        if (a == b) return add_idle(number, Idle::fold_in_paper);
        const int p = plate_of(a);
        const int q = plate_of(b);
        if (p < 0 || q < 0) return look_at_fold_in_hole(number);
        if (p == q || !is_drive(p, q, graph_.segment(2 * number)))
            return add_idle(number, Idle::fold_of_nothing);
        if (p + q == 1) tell_way(number, false);
    }

    // Others that no plate has are told with what hangs there, and a fold may be drawn on over a hole.
    void look_at_fold_in_hole(int number) {
        const Segment s = graph_.segment(2 * number);
        const bool inside = in_hole(graph_.face_of(2 * number)) && in_hole(graph_.face_of(2 * number + 1));
        if (!inside || distance(s.a, s.b) <= kSnapMm) return;
        const bool drawn_on = std::any_of(features_.drives.begin(), features_.drives.end(),
                                          [&](const Drive& drive) { return runs_along(drive, s); });
        const GraphEdge& edge = nth(graph_.edges, number);
        if (!drawn_on) out_.islands.push_back({edge.element, {}, graph_.at(edge.a)});
    }

    [[nodiscard]] bool in_hole(int face) const { return nth(in_hole_, face) != 0; }

    // A cut on a fold is the outline of what it cuts all around, with the fold drawn on top of it. Else it
    // parts paper that hangs together elsewhere.
    void look_at_cuts_on_folds() {
        constexpr unsigned any_cut = kCut | kCutOut;
        std::vector<int> joined(static_cast<std::size_t>(graph_.faces()));
        std::iota(joined.begin(), joined.end(), 0);
        const auto root = [&](int face) {
            while (nth(joined, face) != face) face = nth(joined, face) = nth(joined, nth(joined, face));
            return face;
        };
        const auto both = [&](std::size_t edge) {
            const int half = static_cast<int>(2 * edge);
            return std::pair{root(graph_.face_of(half)), root(graph_.face_of(half ^ 1))};
        };
        for (std::size_t i = 0; i < graph_.edges.size(); ++i) {
            const auto [a, b] = both(i);
            if ((graph_.edges[i].ink & any_cut) == 0) nth(joined, std::max(a, b)) = std::min(a, b);
        }
        struct OnFold {
            double size = 0.0;
            int edge = 0;  // the first
        };
        std::map<int, OnFold> found;  // by line
        for (std::size_t i = 0; i < graph_.edges.size(); ++i) {
            const GraphEdge& edge = graph_.edges[i];
            const auto [a, b] = both(i);
            if (!is_fold(edge) || (edge.ink & any_cut) == 0 || a != b) continue;
            OnFold& one = found.try_emplace(edge.line, OnFold{0.0, static_cast<int>(i)}).first->second;
            one.size += distance(graph_.at(edge.a), graph_.at(edge.b));
        }
        for (const auto& [line, one] : found) {
            if (one.size <= kSnapMm) continue;  // an end that runs over
            const GraphEdge& edge = nth(graph_.edges, one.edge);
            out_.cuts_on_folds.push_back(
                {edge.element, fmt::format("{:.2f} mm", one.size), graph_.at(edge.a)});
        }
    }

    struct IdleLine {
        int element = 0;
        double size = 0.0;
        Vec2 at;
        double gap = HUGE_VAL;  // from a loose end of it to the nearest other line
        int face = 0;           // that it lies in
    };
    static constexpr double kNeighbourMm = 5.0;

    void add_idle(int number, Idle kind) {
        const int face = graph_.face_of(2 * number);
        if (nth(outside_, face) != 0) return;
        const GraphEdge& edge = nth(graph_.edges, number);
        const Segment s = graph_.segment(2 * number);
        IdleLine& line = idle_.try_emplace({edge.line, kind}, IdleLine{edge.element, 0.0, s.a}).first->second;
        line.face = face;
        line.size += distance(s.a, s.b);
        constexpr int kMostGaps = 100;
        for (const int corner : {edge.a, edge.b}) {
            if (graph_.around(corner).size() != 1 || gaps_++ > kMostGaps) continue;
            for (const int half : graph_.halves_of(face)) {
                const GraphEdge& other = graph_.edge(half);
                if (other.line == edge.line) continue;
                const double gap = distance(graph_.at(corner), graph_.segment(half));
                if (gap >= line.gap) continue;
                line.gap = gap;
                if (gap <= kNeighbourMm) line.at = graph_.at(corner);
            }
            if (kind == Idle::fold_in_paper && line.gap <= kNeighbourMm) torn_.insert(face);
        }
    }

    void tell_idle() {
        for (const auto& [key, line] : idle_) {
            // The ends of a line may both be rounded.
            if (line.size <= 2.0 * kSilentMm) continue;
            // It does part the paper, as soon as the fold that nearly ends at another line does.
            if (key.second == Idle::fold_in_paper && line.gap > kNeighbourMm && torn_.contains(line.face))
                continue;
            // Where the same cut ends in the paper, a feature is not cut out that it was to bound.
            if (key.second == Idle::cut_in_feature && idle_.contains({key.first, Idle::cut})) continue;
            std::string what;
            switch (key.second) {
                case Idle::fold_in_paper:
                    what = fmt::format("this fold ends in the paper, {:.2f} mm of it", line.size);
                    break;
                case Idle::fold_of_nothing:
                    what = fmt::format("{:.2f} mm of this fold belong to nothing that moves", line.size);
                    break;
                case Idle::cut:
                    what = fmt::format("this cut ends in the paper, {:.2f} mm of it, and parts nothing",
                                       line.size);
                    break;
                case Idle::cut_in_feature:
                    what = fmt::format(
                        "{:.2f} mm of this cut lie within {}, and no element of a card has such a cut",
                        line.size, nth(owner_, line.face) < 0 ? "the page" : "one feature");
                    break;
            }
            if (line.gap <= kNeighbourMm)
                what += fmt::format(", and the nearest line is {:.2f} mm away", line.gap);
            const bool within = key.second == Idle::cut_in_feature;
            std::vector<NotUnderstood>& faults = within ? out_.cuts_within : out_.faults;
            faults.push_back({line.element, std::move(what), line.at});
            if (within)
                faults.back().hint =
                    "a flap that stands up at a fold is read where all folds of the card run along the "
                    "gutter, each "
                    "plate is held by two of them, and nothing is cut all around across a fold; --as folded "
                    "makes a "
                    "model of any sheet";
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
        NoLinkage why{"no folds lead from it to both sides of a fold", HUGE_VAL};
        bool tried = false;
        bool on_torn = false;
        int element = -1;
        Vec2 at;
        for (std::size_t i = 0; i < part.size(); ++i) {
            const auto found = features_.why.find(part[i]);
            if (found != features_.why.end() && (!tried || found->second.off < why.off) &&
                !found->second.what.empty()) {
                why = found->second;
                tried = true;
            }
            for (const int half : graph_.halves_of(part[i])) {
                const GraphEdge& edge = graph_.edge(half);
                const int next = graph_.face_of(half ^ 1);
                if (!is_fold(edge) || next == 0) continue;
                on_torn = on_torn || torn_.contains(next);
                if (element < 0 || edge.element < element) {
                    element = edge.element;
                    at = graph_.at(edge.a);
                }
                if (plate_of(next) >= 0 || nth(seen, next) != 0) continue;
                nth(seen, next) = 1;
                part.push_back(next);
            }
        }
        // What hangs on paper that a fold fails to part is told with that fold.
        if (element >= 0 && (tried || !on_torn))
            out_.faults.push_back({element, "what is cut out here cannot pop up: " + why.what, at});
    }

    const SheetGraph& graph_;
    const Features& features_;
    std::map<std::pair<int, int>, std::vector<int>> drives_of_;
    std::vector<int> owner_;                         // of each face its feature; -1: the page, or none
    std::vector<char> outside_, in_hole_;            // faces
    std::set<int> used_;                             // folds
    std::map<std::pair<int, Idle>, IdleLine> idle_;  // by line
    std::set<int> torn_;                             // faces in which a fold nearly ends at another line
    int gaps_ = 0;
    double shared_ = 0.0;  // of cuts, by features beside one another
    Leftovers out_;
};

}  // namespace

Leftovers find_leftovers(const SheetGraph& graph, const Features& features) {
    return LeftoverFinder(graph, features).run();
}

}  // namespace popup::drawing::card
