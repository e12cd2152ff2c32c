#include "folded/sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string_view>
#include <tuple>
#include <utility>

#include "base/geometry/mend_ends.h"
#include "base/nth.h"
#include "base/sets.h"
#include "folded/carton/glue_corners.h"
#include "folded/carton/web_corners.h"
#include "folded/folds_on_cuts.h"
#include "folded/in_holes.h"
#include "folded/loops.h"

namespace popup::folded {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
// A corner at which an outline turns by less is none.
constexpr double kInLineRad = 1e-9;
constexpr double kSliverMm2 = 1e-3;
constexpr double kMergeMm = 0.002;
// What tolerances are of large sheets.
constexpr double kMergeShare = 2e-6;
constexpr double kSnapShare = 1.0 / 400.0;
// A border that is not drawn is no strip narrower than this share of its length.
constexpr double kLeastOfBox = 0.01;
// What more panels take, until they are outlines on sheets, grows faster than their number.
constexpr int kMostPanels = 50'000;
// Between two panels so many folds are looked at for one that a stretch goes on in.
constexpr std::size_t kMostBetween = 500;
// Of one kind so many findings are told.
constexpr std::size_t kToldAtMost = 10;

unsigned ink_of(CreaseUse use) {
    switch (use) {
        case CreaseUse::cut:
            return kCut;
        case CreaseUse::mountain:
            return kMountain;
        case CreaseUse::valley:
            return kValley;
        case CreaseUse::fold:
        case CreaseUse::flat:
            return kFold;
    }
    return kFold;
}

bool is_cut(const GraphEdge& edge) { return (edge.ink & kCut) != 0; }

class Maker {
 public:
    Maker(const CreasePattern& pattern, const FoldOptions& options, Diagnostics& diagnostics)
        : pattern_(pattern), options_(options), diagnostics_(diagnostics) {}

    // Whether it was told that the lines enclose no paper.
    [[nodiscard]] bool is_without_paper() const { return without_paper_; }

    // With a rectangle around all folds for the border that is not drawn.
    std::optional<Sheet> run_in_box(std::span<const Stretch> bends) {
        Box box;
        for (const CreaseLine& line : pattern_.lines) {
            if (line.use == CreaseUse::flat) continue;
            for (const Vec2 p : line.points) box.extend(p);
        }
        if (std::min(box.width(), box.height()) > kLeastOfBox * std::max(box.width(), box.height())) {
            const Ring border{box.min, {box.max.x, box.min.y}, box.max, {box.min.x, box.max.y}};
            lines_.push_back({border, true, ink_of(CreaseUse::cut), 0});
            diagnostics_
                .warning(
                    "no-border", {},
                    fmt::format("the pattern has no border; the rectangle around its folds was taken for "
                                "it, from {} to {}",
                                shown(box.min), shown(box.max)))
                .hint("draw the border of the sheet as cuts");
        }
        return run(bends);
    }

    // The pattern with the flat lines at its outside as cuts; nullopt if there are none.
    std::optional<CreasePattern> with_flat_border() {
        for (std::size_t i = 0; i < pattern_.lines.size(); ++i) {
            const CreaseLine& line = pattern_.lines[i];
            lines_.push_back({line.points, line.closed, ink_of(line.use), static_cast<int>(i)});
        }
        set_tolerances();
        std::vector<MovedEnd> moved;
        const std::optional<SheetGraph> graph = mend_ends(lines_, {snap_mm_, merge_mm_}, moved);
        if (!graph) return std::nullopt;
        CreasePattern bordered = pattern_;
        std::size_t count = 0;
        for (std::size_t i = 0; i < graph->edges.size(); ++i) {
            const int half = static_cast<int>(2 * i);
            const int element = graph->edges[i].element;
            // Of a line that leads nowhere both sides are outside.
            if ((graph->face_of(half) == 0) == (graph->face_of(half + 1) == 0)) continue;
            if (nth(pattern_.lines, element).use != CreaseUse::flat) continue;
            if (std::exchange(nth(bordered.lines, element).use, CreaseUse::cut) != CreaseUse::cut) ++count;
        }
        if (count == 0) return std::nullopt;
        diagnostics_
            .warning("no-border", {},
                     fmt::format("the pattern has no border; {} flat line{} at its outside {} taken for it",
                                 count, count == 1 ? "" : "s", count == 1 ? "was" : "were"))
            .hint("draw the border of the sheet as cuts (in FOLD files: \"B\")");
        return bordered;
    }

    std::optional<Sheet> run(std::span<const Stretch> bends) {
        for (std::size_t i = 0; i < pattern_.lines.size(); ++i) {
            const CreaseLine& line = pattern_.lines[i];
            // What is never folded is no line of the sheet.
            if (line.use == CreaseUse::flat) continue;
            lines_.push_back({line.points, line.closed, ink_of(line.use), static_cast<int>(i)});
        }
        set_tolerances();
        if (!mend() || !take_out_dangling() || !divide(bends)) return std::nullopt;
        find_paper();
        if (panels_ == 0) {
            without_paper_ = true;
            diagnostics_.error("no-sheet", {}, "no line of the pattern encloses paper")
                .hint("draw the border of the sheet as a closed line");
            return std::nullopt;
        }
        if (panels_ > kMostPanels) {
            diagnostics_
                .error("document-too-large", {},
                       fmt::format("the lines of the pattern enclose {} panels, the limit is {}", panels_,
                                   kMostPanels))
                .hint("draw the pattern as several, or leave out lines that are neither cuts nor folds");
            return std::nullopt;
        }
        out_.corners = graph_.corners;
        one_line_mm_ = std::max(kSilentMm, kOneLine * out_.size());
        make_panels();
        tell_folds_on_cuts(graph_, halves_.panel_of, out_.panels, pattern_, diagnostics_);
        make_folds();
        make_cuts();
        out_.loops = find_loops(graph_, halves_, out_.folds, out_.panels);
        fold_free();
        fold_web_corners(pattern_, options_, out_, diagnostics_);
        lay_glue_corners(pattern_, options_, out_, diagnostics_);
        return std::move(out_);
    }

 private:
    void set_tolerances() {
        Box box;
        for (const SheetLine& line : lines_) {
            for (const Vec2 p : line.points) box.extend(p);
        }
        const double size = box.empty() ? 0.0 : std::max(box.width(), box.height());
        merge_mm_ = options_.merge_mm.value_or(std::max(kMergeMm, kMergeShare * size));
        snap_mm_ = std::max(options_.snap_mm.value_or(std::max(kSnapMm, kSnapShare * size)), kSilentMm);
    }

    [[nodiscard]] Place place_of(int line) const { return nth(pattern_.lines, line).place; }
    [[nodiscard]] std::string shown(Vec2 at) const { return shown_point(pattern_.ruler, at); }

    bool too_many() {
        diagnostics_
            .error(
                "document-too-large", {},
                fmt::format("the lines of the pattern cross one another more than {} times, or lie so close "
                            "together that too many would have to be compared",
                            kMostMeetings / 2))
            .hint(
                "leave out hatching and other lines that are neither cuts nor folds, or draw the pattern as "
                "several");
        return false;
    }

    bool mend() {
        std::vector<MovedEnd> moved;
        std::optional<SheetGraph> graph = mend_ends(lines_, {snap_mm_, merge_mm_}, moved);
        if (!graph) return too_many();
        for (const MovedEnd& end : moved) {
            const double size = distance(end.from, end.to);
            if (size <= kSilentMm) continue;
            const SheetLine& line = nth(lines_, end.line);
            diagnostics_
                .warning("end-moved", place_of(line.element),
                         fmt::format(
                             "the end of this {} misses what it meets by {:.2f} mm at {}; it was moved there",
                             (line.ink & kAnyFold) != 0 ? "fold" : "cut", size, shown(end.to)))
                .hint("let ends snap to the lines that they meet in the drawing program")
                .changed(shown(end.from), shown(end.to));
        }
        graph_ = std::move(*graph);
        return true;
    }

    // Folds that have one panel on both sides fold nothing. Taking them out may leave others like them.
    bool take_out_dangling() {
        while (true) {
            std::map<int, Vec2> dangling;  // line of the pattern: where
            std::vector<SheetLine> kept;
            bool any = false;
            for (std::size_t i = 0; i < graph_.edges.size(); ++i) {
                const GraphEdge& edge = graph_.edges[i];
                const int half = static_cast<int>(2 * i);
                if (is_cut(edge) || graph_.face_of(half) != graph_.face_of(half + 1)) {
                    const Segment at = graph_.segment(half);
                    kept.push_back({{at.a, at.b}, false, edge.ink, edge.element});
                    continue;
                }
                any = true;
                if (graph_.face_of(half) != 0) dangling.try_emplace(edge.element, graph_.at(edge.a));
            }
            if (!any) return true;
            std::size_t told = 0;
            for (const auto& [line, at] : dangling) {
                if (++told > kToldAtMost) break;
                diagnostics_
                    .warning("dangling-fold", place_of(line),
                             "this fold ends in the middle of a panel, at " + shown(at) +
                                 "; that stretch was left out")
                    .hint("draw it on to a cut or another fold, or take it out");
            }
            lines_ = std::move(kept);
            std::optional<SheetGraph> graph = make_graph(lines_, merge_mm_);
            if (!graph) return too_many();
            graph_ = std::move(*graph);
        }
    }

    // Bends are lines of the graph, and no lines of the pattern.
    bool divide(std::span<const Stretch> bends) {
        if (bends.empty()) return true;
        lines_.clear();
        for (const GraphEdge& edge : graph_.edges)
            lines_.push_back({{graph_.at(edge.a), graph_.at(edge.b)}, false, edge.ink, edge.element});
        for (const Stretch bend : bends) {
            const int element = graph_.edge(graph_.around(bend.a).front()).element;
            lines_.push_back({{graph_.at(bend.a), graph_.at(bend.b)}, false, kBend, element});
        }
        std::optional<SheetGraph> graph = make_graph(lines_, merge_mm_);
        if (!graph) return too_many();
        graph_ = std::move(*graph);
        return true;
    }

    // Faces that folds hold together are all paper or none. What lies at the outside is paper; what lies at
    // paper, but not at the outside, is a hole, if it has no fold.
    void find_paper() {
        const auto faces = static_cast<std::size_t>(graph_.faces());
        find_slivers();
        Sets parts(faces);
        std::vector<char> folded(faces, 0);
        std::map<int, Vec2> open;  // folds at the outside
        for (std::size_t i = 0; i < graph_.edges.size(); ++i) {
            const GraphEdge& edge = graph_.edges[i];
            if (is_cut(edge)) continue;
            const int left = graph_.face_of(static_cast<int>(2 * i));
            const int right = graph_.face_of(static_cast<int>(2 * i + 1));
            if (left == 0 || right == 0) {
                open.try_emplace(edge.element, graph_.at(edge.a));
                continue;
            }
            if (nth(sliver_, left) != 0 || nth(sliver_, right) != 0) continue;
            parts.unite(left, right);
            nth(folded, left) = nth(folded, right) = 1;
        }
        if (!open.empty()) {
            const auto& [line, at] = *open.begin();
            diagnostics_
                .warning("no-border", place_of(line),
                         fmt::format("the sheet has no border here: {} of its folds {} at the outside, the "
                                     "first at {}; they were taken for cuts",
                                     open.size(), open.size() == 1 ? "lies" : "lie", shown(at)))
                .hint("draw the border of the sheet as cuts");
        }
        // How many cuts lie between a part and the outside.
        std::vector<int> level(faces, -1);
        std::vector<std::vector<int>> beside(faces);
        const auto part = [&](int face) { return face == 0 ? 0 : parts.find(face); };
        for (std::size_t i = 0; i < graph_.edges.size(); ++i) {
            const int a = part(graph_.face_of(static_cast<int>(2 * i)));
            const int b = part(graph_.face_of(static_cast<int>(2 * i + 1)));
            if (a == b) continue;
            nth(beside, a).push_back(b);
            nth(beside, b).push_back(a);
        }
        std::vector<char> any_fold(faces, 0);
        for (int face = 1; face < graph_.faces(); ++face) {
            if (nth(folded, face) != 0) nth(any_fold, part(face)) = 1;
        }
        std::vector<int> order{0};
        level[0] = 0;
        for (std::size_t done = 0; done < order.size(); ++done) {
            for (const int other : nth(beside, order[done])) {
                if (nth(level, other) >= 0) continue;
                nth(level, other) = nth(level, order[done]) + 1;
                order.push_back(other);
            }
        }
        halves_.panel_of.assign(faces, -1);
        piece_of_.assign(faces, -1);
        std::map<int, int> piece_of_part;
        for (int face = 1; face < graph_.faces(); ++face) {
            const int of = part(face);
            if (nth(level, of) != 1 || nth(sliver_, face) != 0) {
                if (nth(level, of) != 1 && nth(any_fold, of) != 0 && of == face)
                    tell_part_in_hole(graph_, face, pattern_, diagnostics_);
                continue;
            }
            nth(halves_.panel_of, face) = panels_++;
            const auto [at, fresh] = piece_of_part.try_emplace(of, static_cast<int>(piece_of_part.size()));
            nth(piece_of_, face) = at->second;
        }
        pieces_ = static_cast<int>(piece_of_part.size());
        std::vector<int> level_of(faces, 0);
        for (int face = 1; face < graph_.faces(); ++face) nth(level_of, face) = nth(level, part(face));
        tell_cuts_in_holes(graph_, level_of, pattern_, diagnostics_);
    }

    void find_slivers() {
        sliver_.assign(static_cast<std::size_t>(graph_.faces()), 0);
        for (int face = 1; face < graph_.faces(); ++face) nth(sliver_, face) = is_sliver(face) ? 1 : 0;
    }

    // Where lines nearly lie on each other there is paper between them, and no panel.
    [[nodiscard]] bool is_sliver(int face) const {
        double twice = 0.0;
        const Vec2 origin = graph_.at(graph_.from(graph_.halves_of(face).front()));
        for (const int half : graph_.halves_of(face)) {
            const Segment at = graph_.segment(half);
            twice += cross(at.a - origin, at.b - origin);
        }
        return twice <= 2.0 * kSliverMm2;
    }

    // The rings of a face, without what is gone along there and back.
    void make_panels() {
        out_.panels.resize(static_cast<std::size_t>(panels_));
        for (int face = 1; face < graph_.faces(); ++face) {
            const int number = nth(halves_.panel_of, face);
            if (number < 0) continue;
            Panel& panel = nth(out_.panels, number);
            panel.piece = nth(piece_of_, face);
            std::vector<char> done(graph_.halves_of(face).size(), 0);
            std::map<int, std::size_t> index;
            for (std::size_t i = 0; i < done.size(); ++i) index[graph_.halves_of(face)[i]] = i;
            for (std::size_t i = 0; i < done.size(); ++i) {
                if (done[i] != 0) continue;
                std::vector<int> ring;
                for (int half = graph_.halves_of(face)[i]; done[index.at(half)] == 0;
                     half = graph_.next(half)) {
                    done[index.at(half)] = 1;
                    ring.push_back(half);
                }
                add_rings(ring, panel);
            }
        }
    }

    // Splits a walk at corners that it comes back to.
    void add_rings(const std::vector<int>& walk, Panel& panel) {
        std::vector<int> open;  // corners
        std::map<int, std::size_t> at;
        const auto close = [&](std::size_t begin) {
            std::vector<int> corners(open.begin() + static_cast<std::ptrdiff_t>(begin), open.end());
            for (const int corner : corners) at.erase(corner);
            open.resize(begin);
            Ring ring;
            ring.reserve(corners.size());
            for (const int corner : corners) ring.push_back(graph_.at(corner));
            if (signed_area(ring) > 0.0) {
                panel.outer = std::move(corners);
            } else if (signed_area(ring) < 0.0) {
                panel.holes.push_back(std::move(corners));
            }
        };
        for (const int half : walk) {
            const int corner = graph_.from(half);
            const auto known = at.find(corner);
            if (known != at.end()) close(known->second);
            at[corner] = open.size();
            open.push_back(corner);
        }
        close(0);
    }

    void make_folds() {
        halves_.fold.assign(graph_.edges.size(), -1);
        // By the panels on both sides: folds, of which those on one line are one.
        std::map<std::pair<int, int>, std::vector<int>> between;
        for (std::size_t i = 0; i < graph_.edges.size(); ++i) {
            const GraphEdge& edge = graph_.edges[i];
            if (is_cut(edge)) continue;
            int half = static_cast<int>(2 * i);
            int left = nth(halves_.panel_of, graph_.face_of(half));
            int right = nth(halves_.panel_of, graph_.face_of(half + 1));
            if (left < 0 || right < 0) continue;
            if (left > right) {
                std::swap(left, right);
                ++half;
            }
            const Stretch stretch{graph_.from(half), graph_.to(half)};
            std::vector<int>& known = between[{left, right}];
            // Curves have very many between two panels; what goes on in one line is not far from where it
            // ended.
            const auto recent =
                known.end() - static_cast<std::ptrdiff_t>(std::min(known.size(), kMostBetween));
            const auto same = std::find_if(recent, known.end(), [&](int number) {
                return in_line(nth(out_.folds, number).stretches.front(), stretch);
            });
            if (same != known.end()) {
                halves_.fold[i] = *same;
                Fold& fold = nth(out_.folds, *same);
                fold.stretches.push_back(stretch);
                fold.ink |= edge.ink;
                continue;
            }
            halves_.fold[i] = static_cast<int>(out_.folds.size());
            known.push_back(halves_.fold[i]);
            Fold fold;
            fold.left = left;
            fold.right = right;
            fold.stretches = {stretch};
            fold.ink = edge.ink;
            fold.line = edge.element;
            out_.folds.push_back(std::move(fold));
        }
        for (Fold& fold : out_.folds) finish(fold);
    }

    // Whether two stretches lie on one line, in one direction: the ends of the shorter one on the line of the
    // longer.
    [[nodiscard]] bool in_line(Stretch one, Stretch other) const {
        Segment s{graph_.at(one.a), graph_.at(one.b)};
        Segment t{graph_.at(other.a), graph_.at(other.b)};
        if (distance(s.a, s.b) < distance(t.a, t.b)) std::swap(s, t);
        const Vec2 dir = unit(s.b - s.a);
        return dot(dir, t.b - t.a) > 0.0 && std::abs(cross(dir, t.a - s.a)) <= one_line_mm_ &&
               std::abs(cross(dir, t.b - s.a)) <= one_line_mm_;
    }

    // Puts its stretches in their order, and says how far it is folded.
    void finish(Fold& fold) {
        const Vec2 at = graph_.at(fold.stretches.front().a);
        const Vec2 dir = graph_.at(fold.stretches.front().b) - at;
        const auto along = [&](int corner) { return dot(dir, graph_.at(corner) - at); };
        std::sort(fold.stretches.begin(), fold.stretches.end(),
                  [&](Stretch s, Stretch t) { return along(s.a) < along(t.a); });
        const bool both = (fold.ink & kMountain) != 0 && (fold.ink & kValley) != 0;
        if (both) {
            diagnostics_
                .warning("fold-drawn-twice", place_of(fold.line),
                         "this fold is drawn as a mountain and as a valley, at " +
                             shown(graph_.at(fold.stretches.front().a)) + "; it goes as the others make it")
                .hint("take one of its lines out");
            return;
        }
        const unsigned way = fold.ink & (kMountain | kValley);
        if (way == 0) return;
        fold.target = angle_of(fold, way == kMountain ? CreaseUse::mountain : CreaseUse::valley);
    }

    // What does not say which way it goes, and hangs together by no loop with a fold that does, goes to the
    // front, as walls of a box do.
    void fold_free() {
        Sets groups(out_.folds.size());
        for (const Loop& loop : out_.loops) {
            for (const Step& step : loop.steps) groups.unite(step.fold, loop.steps.front().fold);
        }
        std::vector<char> says(out_.folds.size(), 0);
        for (std::size_t i = 0; i < says.size(); ++i) {
            if ((out_.folds[i].ink & (kMountain | kValley)) != 0)
                nth(says, groups.find(static_cast<int>(i))) = 1;
        }
        for (std::size_t i = 0; i < says.size(); ++i) {
            Fold& fold = out_.folds[i];
            if (!fold.is_bend() && nth(says, groups.find(static_cast<int>(i))) == 0)
                fold.target = angle_of(fold, CreaseUse::valley);
        }
    }

    // How far it is folded in the end, radians, as a mountain or a valley.
    [[nodiscard]] double angle_of(const Fold& fold, CreaseUse use) const {
        const CreaseLine& line = nth(pattern_.lines, fold.line);
        double deg = line.fold_deg.value_or(pattern_.fold_deg);
        const std::string_view kind = kCreaseUseNames.at(static_cast<std::size_t>(use));
        for (const FoldOptions::NamedAngle& one : options_.fold_angles) {
            if (one.name.empty() || one.name == line.name || one.name == kind) deg = one.angle.deg;
        }
        return (use == CreaseUse::mountain ? -deg : deg) * kDegree;
    }

    void make_cuts() {
        out_.cuts.resize(static_cast<std::size_t>(pieces_));
        for (std::size_t i = 0; i < graph_.edges.size(); ++i) {
            const int half = static_cast<int>(2 * i);
            if (halves_.fold[i] >= 0) continue;
            const int left = nth(piece_of_, graph_.face_of(half));
            const int right = nth(piece_of_, graph_.face_of(half + 1));
            if (left >= 0) nth(out_.cuts, left).push_back({graph_.from(half), graph_.to(half)});
            if (right >= 0 && right != left)
                nth(out_.cuts, right).push_back({graph_.from(half), graph_.to(half)});
        }
    }

    const CreasePattern& pattern_;
    const FoldOptions& options_;
    double merge_mm_ = 0.0;
    double snap_mm_ = 0.0;
    Diagnostics& diagnostics_;
    std::vector<SheetLine> lines_;
    SheetGraph graph_;
    HalfFolds halves_;
    std::vector<char> sliver_;   // by face
    std::vector<int> piece_of_;  // by face
    double one_line_mm_ = kSilentMm;
    bool without_paper_ = false;
    int panels_ = 0, pieces_ = 0;
    Sheet out_;
};

// Corners at which nothing turns say nothing of the outline.
Ring straightened(const Ring& ring) {
    Ring kept;
    const std::size_t count = ring.size();
    for (std::size_t i = 0; i < count; ++i) {
        const Vec2 in = ring[i] - ring[(i + count - 1) % count];
        const Vec2 out = ring[(i + 1) % count] - ring[i];
        if (std::abs(cross(in, out)) > kInLineRad * length(in) * length(out) || dot(in, out) < 0.0)
            kept.push_back(ring[i]);
    }
    return kept.size() >= 3 ? kept : ring;
}

}  // namespace

double Sheet::size() const {
    Box box;
    for (const Vec2 p : corners) box.extend(p);
    return std::max({box.width(), box.height(), kSilentMm});
}

bool Sheet::bends() const {
    return std::any_of(folds.begin(), folds.end(), [](const Fold& fold) { return fold.is_bend(); });
}

std::vector<Segment> Sheet::stretches_of(const Fold& fold) const {
    std::vector<Segment> joined;
    int end = -1;
    for (const Stretch one : fold.stretches) {
        if (one.a == end) {
            joined.back().b = at(one.b);
        } else {
            joined.push_back(segment(one));
        }
        end = one.b;
    }
    return joined;
}

Polygon Sheet::outline_of(const Panel& panel) const {
    const auto ring_of = [this](const std::vector<int>& numbers) {
        Ring ring;
        ring.reserve(numbers.size());
        for (const int corner : numbers) ring.push_back(at(corner));
        return straightened(ring);
    };
    Polygon outline{ring_of(panel.outer), {}};
    for (const std::vector<int>& hole : panel.holes) outline.holes.push_back(ring_of(hole));
    return outline;
}

std::optional<Sheet> make_sheet(const CreasePattern& pattern, const FoldOptions& options,
                                Diagnostics& diagnostics, std::span<const Stretch> bends) {
    // Folds alone may enclose paper; where they do not, a border is missing. It is made first: bends end at
    // corners of the sheet that has it.
    const bool has_cuts = std::any_of(pattern.lines.begin(), pattern.lines.end(),
                                      [](const CreaseLine& line) { return line.use == CreaseUse::cut; });
    if (!has_cuts) {
        Diagnostics untold;
        Maker without(pattern, options, untold);
        if (!without.run({}) && without.is_without_paper()) {
            if (const auto bordered = Maker(pattern, options, diagnostics).with_flat_border())
                return Maker(*bordered, options, diagnostics).run(bends);
            return Maker(pattern, options, diagnostics).run_in_box(bends);
        }
    }
    return Maker(pattern, options, diagnostics).run(bends);
}

}  // namespace popup::folded
