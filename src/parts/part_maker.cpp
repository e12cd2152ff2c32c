#include "parts/part_maker.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "base/geometry/edge_index.h"
#include "base/geometry/regions.h"
#include "parts/contours.h"
#include "parts/joining.h"
#include "parts/work.h"

namespace popup::drawing {
namespace {

// What of a line lies outside by less than this is the rounding of a drawing.
constexpr double kOutsideMm = 0.05;
// Of pairs of contours that overlap, so many are told one by one.
constexpr std::size_t kToldOverlaps = 20;

std::size_t at(int number) { return static_cast<std::size_t>(number); }

Box box_of(const std::vector<Vec2>& points) {
    Box box;
    for (const Vec2 p : points) box.extend(p);
    return box;
}

LineKind kind_of(Use use) {
    switch (use) {
        case Use::mountain:
            return LineKind::mountain;
        case Use::valley:
            return LineKind::valley;
        case Use::seam:
            return LineKind::seam;
        case Use::cut:
        case Use::shape:
            return LineKind::cut;
        case Use::print:
            return LineKind::mark;
    }
    broken_invariant("a use is one of its enumerators", __FILE__, __LINE__);
}

// An open line of a drawing, on its way into parts.
struct LooseLine {
    std::vector<Vec2> points;
    LineKind kind = LineKind::cut;
    int element = 0;
};

// The parts of one owner: of all that has none, or of one piece of a sheet.
class PartMaker {
 public:
    PartMaker(const Tracing& tracing, int owner, Work& work, std::vector<Segment>& moves,
              Diagnostics& diagnostics)
        : in_(tracing), owner_(owner), work_(work), moves_(moves), diagnostics_(diagnostics) {}

    void add(const TracedLine& line) {
        switch (line.use) {
            case Use::cut:
                return add_cut(line);
            case Use::shape:
                shapes_.push_back(&line);
                return;
            case Use::print:
                prints_.push_back(&line);
                return;
            case Use::mountain:
            case Use::valley:
            case Use::seam:
                loose_.push_back({line.points, kind_of(line.use), line.element});
                if (line.closed) loose_.back().points.push_back(line.points.front());
                return;
        }
    }
    void add(const TracedFill& fill) { fills_.push_back(&fill); }
    void add(const TracedText& text) { texts_.push_back(&text); }

    // Empty when there is no contour, or after an error.
    std::vector<FlatPart> run() {
        join();
        if (closed_.empty() && owner_ == 0) take_shapes();
        auto contours = sort_contours(std::move(closed_), work_);
        if (!contours) {
            too_large("its contours cross, touch or surround one another too often");
            return {};
        }
        contours_ = std::move(*contours);
        tell_contours();
        if (stopped_) return {};
        if (!make_paper()) too_large("its contours have too many holes");
        if (parts_.empty() || stopped_) return {};
        tell_frame();
        add_loose();
        if (!stopped_) add_fills();
        add_printed();
        tell_doubled();
        if (stopped_) return {};
        return std::move(parts_);
    }

 private:
    [[nodiscard]] const TracedElement& element(int number) const { return in_.elements[at(number)]; }
    [[nodiscard]] Place place(const std::vector<int>& elements) const { return element(elements[0]).place; }

    // Where a point is, as a drawing program shows it.
    [[nodiscard]] std::string spot(Vec2 p) const { return shown_point(in_.ruler, p); }

    void too_large(std::string_view why) {
        diagnostics_.error("document-too-large", {}, fmt::format("the drawing is too much work: {}", why));
        stopped_ = true;
    }

    // --- contours

    void add_cut(const TracedLine& line) {
        const bool meets = distance(line.points.front(), line.points.back()) <= kJoinMm;
        const bool closes = line.closed || (meets && length_of(line.points) > 4.0 * kJoinMm);
        if (!closes) {
            open_.push_back({line.points, line.element});
            return;
        }
        closed_.push_back({line.points, {line.element}});
        if (meets && !line.closed && line.points.size() > 2) closed_.back().points.pop_back();
    }

    void join() {
        Joined joined = join_lines(std::move(open_));
        for (JoinedLine& line : joined.lines) {
            if (line.closed) {
                closed_.push_back({std::move(line.points), std::move(line.elements)});
            } else {
                loose_.push_back({std::move(line.points), LineKind::cut, line.elements.front()});
            }
        }
        moves_.insert(moves_.end(), joined.moves.begin(), joined.moves.end());
        doubled_.insert(joined.doubled.begin(), joined.doubled.end());
    }

    // A drawing without any drawn contour: its painted shapes are meant.
    void take_shapes() {
        for (const TracedLine* shape : shapes_) closed_.push_back({shape->points, {shape->element}});
        shapes_.clear();
        std::erase_if(fills_, [](const TracedFill* fill) { return fill->without_stroke; });
    }

    void tell_contours() {
        for (const CrossedContour& one : contours_.crossed) {
            diagnostics_
                .warning(
                    "contour-crosses-itself", place(one.elements),
                    fmt::format("this contour crosses itself at {}; what is inside of it was taken for one "
                                "area",
                                spot(one.at)))
                .about(element(one.elements[0]).name)
                .hint("in Inkscape Path > Union does the same; look whether that is what was meant");
        }
        tell_overlaps();
        for (const std::vector<int>& elements : contours_.doubled) doubled_.insert(elements[0]);
        for (auto& [points, elements] : contours_.hairs) {
            loose_.push_back({std::move(points), LineKind::cut, elements[0]});
        }
    }

    // Two holes of one part that overlap are one hole.
    [[nodiscard]] bool are_holes(const ContourOverlap& one) const {
        const ClosedContour& a = contours_.all[at(one.a)];
        const ClosedContour& b = contours_.all[at(one.b)];
        return a.parent >= 0 && b.parent >= 0 && a.root == b.root;
    }

    // One misplaced line can overlap a thousand others: the first few say what is wrong.
    void tell_overlaps() {
        std::size_t errors = 0;
        const ContourOverlap* untold = nullptr;
        for (const ContourOverlap& one : contours_.overlaps) {
            if (are_holes(one) || ++errors <= kToldOverlaps) {
                tell_overlap(one);
            } else {
                untold = &one;
            }
        }
        if (untold == nullptr) return;
        const std::size_t more = errors - kToldOverlaps;
        diagnostics_.error("contours-overlap", place(contours_.all[at(untold->a)].elements),
                           fmt::format("{} more pair{} of contours overlap{} partly", more,
                                       more == 1 ? "" : "s", more == 1 ? "s" : ""));
    }

    void tell_overlap(const ContourOverlap& one) {
        const ClosedContour& a = contours_.all[at(one.a)];
        const ClosedContour& b = contours_.all[at(one.b)];
        const bool inside = are_holes(one);
        const std::string& first = element(a.elements[0]).name;
        const std::string& second = element(b.elements[0]).name;
        const bool named = !first.empty() && !second.empty();
        const std::string message = fmt::format(
            "{} overlap partly, by {:.2f} mm², at {}",
            named ? fmt::format("\"{}\" and \"{}\"", first, second) : std::string("this contour and another"),
            one.area_mm2, spot(one.at));
        const std::string other = named ? fmt::format("\"{}\"", second) : std::string("the other contour");
        if (inside) {
            diagnostics_
                .warning("holes-overlap", place(a.elements),
                         message +
                             "; what is left of the part is what both "
                             "leave")
                .with(place(b.elements), other);
            return;
        }
        diagnostics_.error("contours-overlap", place(a.elements), message)
            .with(place(b.elements), other)
            .hint("move them apart if they are two parts")
            .hint("make one contour of them if they are one (in Inkscape: Path > Union or Difference)");
        stopped_ = true;
    }

    bool make_paper() {
        const std::vector<ClosedContour>& all = contours_.all;
        std::vector<std::vector<Polygon>> holes(all.size());
        for (const ClosedContour& one : all) {
            if (one.depth % 2 == 1) holes[at(one.parent)].push_back({one.ring, {}});
        }
        std::vector<int> roots;
        for (std::size_t i = 0; i < all.size(); ++i) {
            if (all[i].parent < 0) roots.push_back(static_cast<int>(i));
        }
        std::stable_sort(roots.begin(), roots.end(),
                         [&](int a, int b) { return all[at(a)].elements[0] < all[at(b)].elements[0]; });
        part_of_.assign(all.size(), -1);
        for (const int root : roots) {
            part_of_[at(root)] = static_cast<int>(parts_.size());
            FlatPart& part = parts_.emplace_back();
            part.place = place(all[at(root)].elements);
            part.name = owner_ > 0 ? in_.owners[at(owner_)].name : name_of(all[at(root)].elements);
            outlines_.push_back({all[at(root)].ring, {}});
            boxes_.push_back(bounds(all[at(root)].ring));
        }
        // Islands of a part may overlap only where their contours do.
        std::set<int> overlapping;
        for (const ContourOverlap& one : contours_.overlaps) overlapping.insert(all[at(one.a)].root);
        for (std::size_t i = 0; i < all.size(); ++i) {
            if (all[i].depth % 2 == 1) continue;
            std::vector<Polygon>& paper = parts_[at(part_of_[at(all[i].root)])].paper;
            if (!work_.sweep(all[i].ring) || !work_.sweep(holes[i])) return false;
            std::vector<Polygon> left = subtract({{all[i].ring, {}}}, holes[i]);
            if (!all[i].grazed.empty() && !keep_apart(i, left)) return false;
            paper.insert(paper.end(), left.begin(), left.end());
        }
        for (const int root : overlapping) {
            std::vector<Polygon>& paper = parts_[at(part_of_[at(root)])].paper;
            paper = unite(paper);
        }
        edges_of_part_.resize(parts_.size());
        return true;
    }

    // Keeps the paper of an island within the hole it lies in and off the islands before it, where contours
    // poke over one another: each is cut out on its own. False when that is too much work.
    bool keep_apart(std::size_t i, std::vector<Polygon>& left) {
        const ClosedContour& island = contours_.all[i];
        if (island.parent < 0) return true;
        std::vector<Polygon> taken;
        for (const int other : island.grazed) {
            const ClosedContour& one = contours_.all[at(other)];
            if (!work_.sweep(one.ring)) return false;
            if (other == island.parent) left = intersect(left, {{one.ring, {}}});
            if (one.parent == island.parent && at(other) < i) taken.push_back({one.ring, {}});
        }
        if (!taken.empty()) left = subtract(left, taken);
        return true;
    }

    // A rectangle as large as the page that holds everything is hardly a part.
    void tell_frame() {
        constexpr double kAlikeMm = 1.0;
        if (parts_.size() != 1 || contours_.all.size() < 3 || outlines_[0].outer.size() != 4) return;
        if (std::abs(boxes_[0].width() - in_.page.x) > kAlikeMm ||
            std::abs(boxes_[0].height() - in_.page.y) > kAlikeMm) {
            return;
        }
        diagnostics_
            .remark("page-frame", parts_[0].place,
                    "this contour is as large as the page and holds all others, so the drawing is one part")
            .hint("if it is a frame, take it out; what lies in it then are parts");
    }

    // The name of an element, else of the group that all of them stand in; empty where there is neither.
    [[nodiscard]] std::string name_of(const std::vector<int>& elements) const {
        if (elements.size() == 1 && !element(elements[0]).name.empty()) return element(elements[0]).name;
        const std::string& group = element(elements[0]).group;
        const bool one_group =
            std::all_of(elements.begin(), elements.end(), [&](int e) { return element(e).group == group; });
        return one_group ? group : std::string();
    }

    // --- what lies in the parts

    // The parts whose boxes touch a box.
    void parts_near(const Box& box, std::vector<int>& found) {
        if (!part_index_) {
            std::vector<Segment> diagonals;
            for (const Box& own : boxes_) diagonals.push_back({own.min, own.max});
            part_index_.emplace(std::vector<Segment>{}, diagonals);
        }
        const Vec2 margin{kJoinMm, kJoinMm};
        part_index_->query({box.min - margin, box.max + margin}, found);
    }

    // All edges of a part's paper, with the number of the ring each is of.
    struct PartEdges {
        std::optional<EdgeIndex> index;
        std::vector<int> ring;
    };
    const PartEdges& edges_of_part(int part) {
        PartEdges& edges = edges_of_part_[at(part)];
        if (edges.index) return edges;
        std::vector<Segment> all;
        int ring_number = 0;
        const auto add = [&](const Ring& ring) {
            for (std::size_t i = 0; i < ring.size(); ++i) {
                all.push_back({ring[i], ring[i + 1 == ring.size() ? 0 : i + 1]});
                edges.ring.push_back(ring_number);
            }
            ++ring_number;
        };
        for (const Polygon& paper : parts_[at(part)].paper) {
            add(paper.outer);
            for (const Ring& hole : paper.holes) add(hole);
        }
        edges.index.emplace(std::move(all));
        return edges;
    }

    // Lines are compared with the edges near them here, and with one another when the pattern is made.
    [[nodiscard]] bool loose_affordable() {
        std::vector<Segment> lines;
        for (const LooseLine& line : loose_) {
            for (std::size_t i = 1; i < line.points.size(); ++i) {
                lines.push_back({line.points[i - 1], line.points[i]});
            }
        }
        std::vector<Segment> all = lines;
        for (const ClosedContour& one : contours_.all) {
            if (one.depth > 0) continue;
            const std::vector<Segment> edges = edges_of({one.ring, {}});
            all.insert(all.end(), edges.begin(), edges.end());
        }
        return work_.crossings(EdgeIndex({}, all), lines);
    }

    void add_loose() {
        if (loose_.empty()) return;
        if (!loose_affordable()) return too_large("its lines cross one another, or contours, too often");
        std::vector<std::vector<int>> lines_in(parts_.size());
        std::vector<int> found;
        for (std::size_t i = 0; i < loose_.size(); ++i) {
            parts_near(box_of(loose_[i].points), found);
            if (!work_.looks(found.size() * loose_[i].points.size()))
                return too_large("its lines pass too many parts");
            for (const int part : found) lines_in[at(part)].push_back(static_cast<int>(i));
        }
        std::vector<double> inside(loose_.size(), 0.0);
        for (std::size_t part = 0; part < parts_.size(); ++part) {
            if (lines_in[part].empty()) continue;
            std::vector<std::vector<Vec2>> lines;
            for (const int i : lines_in[part]) lines.push_back(loose_[at(i)].points);
            // What ends on the outline, or a little beyond it, is inside.
            if (!work_.sweep(outlines_[part].outer)) return too_large("its lines lie in too many contours");
            const std::vector<Polygon> grown = offset({outlines_[part]}, kJoinMm, Corners::sharp);
            for (const Polygon& area : grown) {
                const auto clipped = clip_lines(lines, {area.outer, {}});
                for (std::size_t i = 0; i < clipped.size(); ++i) {
                    const auto line = at(lines_in[part][i]);
                    for (const std::vector<Vec2>& piece : clipped[i]) {
                        const double length = length_of(piece);
                        inside[line] += length;
                        if (length > kOutsideMm || length >= 0.5 * length_of(loose_[line].points)) {
                            add_line(static_cast<int>(part), loose_[line], piece);
                        }
                    }
                }
            }
        }
        for (std::size_t i = 0; i < loose_.size(); ++i) tell_outside(loose_[i], inside[i]);
    }

    void add_line(int part, const LooseLine& line, const std::vector<Vec2>& points) {
        if (line.kind != LineKind::cut) {
            parts_[at(part)].lines.push_back({line.kind, points});
            return;
        }
        if (lies_on_edges(part, points)) {
            doubled_.insert(line.element);
            return;
        }
        parts_[at(part)].slits.push_back(points);
        tell_divided(part, line, points);
    }

    [[nodiscard]] bool lies_on_edges(int part, const std::vector<Vec2>& points) {
        const EdgeIndex& index = *edges_of_part(part).index;
        const auto on_edge = [&](Vec2 p) { return index.clearance(p, 2.0 * kJoinMm) <= 1.5 * kJoinMm; };
        for (std::size_t i = 0; i < points.size(); ++i) {
            if (!on_edge(points[i])) return false;
            if (i > 0 && !on_edge(lerp(points[i - 1], points[i], 0.5))) return false;
        }
        return true;
    }

    // A cut from an edge to the same edge parts the part.
    void tell_divided(int part, const LooseLine& line, const std::vector<Vec2>& points) {
        const PartEdges& edges = edges_of_part(part);
        const auto rings_at = [&](Vec2 p) {
            std::set<int> rings;
            std::vector<int> found;
            const Vec2 margin{1.5 * kJoinMm, 1.5 * kJoinMm};
            edges.index->query({p - margin, p + margin}, found);
            for (const int edge : found) {
                if (distance(p, (*edges.index)[edge]) <= 1.5 * kJoinMm) rings.insert(edges.ring[at(edge)]);
            }
            return rings;
        };
        const std::set<int> first = rings_at(points.front());
        if (first.empty()) return;
        const std::set<int> last = rings_at(points.back());
        const bool same = std::any_of(first.begin(), first.end(), [&](int r) { return last.contains(r); });
        const std::size_t middle = points.size() / 2;
        const Vec2 inner = lerp(points[middle - 1], points[middle], 0.5);
        const bool in_paper = std::any_of(parts_[at(part)].paper.begin(), parts_[at(part)].paper.end(),
                                          [&](const Polygon& paper) { return contains(paper, inner); });
        if (!same || !in_paper) return;
        diagnostics_
            .warning(
                "part-divided", element(line.element).place,
                fmt::format("this cut goes through \"{}\" from edge to edge, from {} to {}, and divides it",
                            shown_name(part), spot(points.front()), spot(points.back())))
            .hint("draw each part as a closed contour of its own if they are to be placed apart");
    }

    [[nodiscard]] std::string shown_name(int part) const {
        return parts_[at(part)].name.empty() ? fmt::format("part-{}", part + 1) : parts_[at(part)].name;
    }

    void tell_outside(const LooseLine& line, double inside) {
        const double length = length_of(line.points);
        const double outside = length - inside;
        if (outside <= kOutsideMm) return;
        const bool cut = line.kind == LineKind::cut;
        const std::string from_to =
            fmt::format("from {} to {}", spot(line.points.front()), spot(line.points.back()));
        if (inside <= kOutsideMm) {
            diagnostics_
                .warning("line-outside", element(line.element).place,
                         fmt::format("this open line, {}, lies outside of every part, and is not {}", from_to,
                                     cut ? "cut" : "drawn"))
                .hint(fmt::format("an outline has to close: its ends must be within {} mm of each other",
                                  kJoinMm));
            return;
        }
        diagnostics_
            .warning(
                "line-outside", element(line.element).place,
                fmt::format("{:.1f} of {:.1f} mm of this line, {}, lie outside of every part, and are not {}",
                            outside, length, from_to, cut ? "cut" : "drawn"))
            .hint("end it at the outline");
    }

    [[nodiscard]] bool fill_affordable(const TracedFill& fill) {
        std::vector<const Ring*> rings;
        std::vector<Segment> edges;
        for (const Ring& ring : fill.rings) {
            rings.push_back(&ring);
            const std::vector<Segment> own = edges_of({ring, {}});
            edges.insert(edges.end(), own.begin(), own.end());
        }
        return work_.sweep(rings) && work_.crossings(EdgeIndex(edges), edges);
    }

    void add_fills() {
        for (const TracedFill* fill : fills_) {
            if (!fill_affordable(*fill)) return too_large("its painted areas cross themselves too often");
            const std::vector<Polygon> area =
                filled(fill->rings, fill->even_odd ? FillRule::even_odd : FillRule::non_zero);
            if (area.empty()) continue;
            if (owner_ > 0) {
                FlatPart& part = parts_[at(part_at(fill->rings[0][0]))];
                for (const Polygon& one : area) part.fills.push_back({one, fill->color});
            } else if (!print(*fill, area)) {
                return too_large("its painted areas lie on too many parts");
            }
        }
    }

    // Prints what of the area lies on paper. False when that is too much work.
    [[nodiscard]] bool print(const TracedFill& fill, const std::vector<Polygon>& area) {
        Box box;
        std::vector<Segment> edges;
        for (const Polygon& one : area) {
            const std::vector<Segment> own = edges_of(one);
            edges.insert(edges.end(), own.begin(), own.end());
            for (const Vec2 p : one.outer) box.extend(p);
        }
        std::vector<int> found;
        parts_near(box, found);
        bool printed = false;
        for (const int part : found) {
            const std::vector<Polygon>& paper = parts_[at(part)].paper;
            constexpr std::size_t kBooleanLooks = 1000;  // what a boolean costs at least
            if (!work_.looks(kBooleanLooks) || !work_.crossings(*edges_of_part(part).index, edges) ||
                !work_.sweep(area) || !work_.sweep(paper)) {
                return false;
            }
            for (Polygon& one : intersect(area, paper)) {
                if (popup::area(one) <= 1e-3) continue;
                printed = true;
                if (fill.is_printed) parts_[at(part)].fills.push_back({std::move(one), fill.color});
            }
        }
        if (!printed && fill.without_stroke) tell_shape_outside(fill.element);
        return true;
    }

    void tell_shape_outside(int number) {
        diagnostics_
            .warning("shape-outside", element(number).place,
                     "this painted shape has no stroke and lies outside of every part, and is not cut")
            .about(element(number).name)
            .hint("in a drawing that has stroked contours only these are cut; give it a stroke");
    }

    // The part that a point lies in, or the first.
    [[nodiscard]] int part_at(Vec2 p) const {
        for (std::size_t i = 0; i < outlines_.size(); ++i) {
            if (contains(outlines_[i], p)) return static_cast<int>(i);
        }
        return 0;
    }

    void add_printed() {
        for (const TracedLine* line : prints_) {
            Stroke stroke{line->points, line->width_mm, line->color};
            if (line->closed) stroke.points.push_back(line->points.front());
            parts_[at(part_at(line->points[0]))].strokes.push_back(std::move(stroke));
        }
        for (const TracedText* text : texts_) parts_[at(part_at(text->text.at))].texts.push_back(text->text);
    }

    void tell_doubled() {
        if (doubled_.empty()) return;
        diagnostics_.remark(
            "doubled-line", element(*doubled_.begin()).place,
            fmt::format("{} line{} drawn twice, and {} cut once", doubled_.size(),
                        doubled_.size() == 1 ? " is" : "s are", doubled_.size() == 1 ? "is" : "are"));
    }

    const Tracing& in_;
    int owner_;
    Work& work_;
    std::vector<Segment>& moves_;
    Diagnostics& diagnostics_;
    std::vector<OpenLine> open_;
    std::vector<ClosedLine> closed_;
    std::vector<LooseLine> loose_;
    std::vector<const TracedLine*> shapes_, prints_;
    std::vector<const TracedFill*> fills_;
    std::vector<const TracedText*> texts_;
    std::set<int> doubled_;  // elements
    Contours contours_;
    std::vector<FlatPart> parts_;
    std::vector<Polygon> outlines_;  // of each part
    std::vector<Box> boxes_;
    std::vector<int> part_of_;  // of each contour that is a root
    std::vector<PartEdges> edges_of_part_;
    std::optional<EdgeIndex> part_index_;
    bool stopped_ = false;
};

}  // namespace

std::vector<FlatPart> make_parts_of(const Tracing& tracing, int owner, const OwnedLines& owned, Work& work,
                                    std::vector<Segment>& moves, Diagnostics& diagnostics) {
    PartMaker maker(tracing, owner, work, moves, diagnostics);
    for (const TracedLine* line : owned.lines) maker.add(*line);
    for (const TracedFill* fill : owned.fills) maker.add(*fill);
    for (const TracedText* text : owned.texts) maker.add(*text);
    return maker.run();
}

}  // namespace popup::drawing
