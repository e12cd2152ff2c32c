#include "input/drawing/card/to_design.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "base/geometry/mend_ends.h"
#include "base/geometry/regions.h"
#include "base/nth.h"
#include "input/design_limits.h"
#include "input/drawing/card/outlines.h"
#include "popup/curves.h"
#include "popup/mechanism.h"
#include "popup/units.h"

namespace popup::drawing::card {
namespace {

// Corners no further from a rectangle, in mm, make one.
constexpr double kOnCornerMm = 0.005;
// What reaches no further over a side fold is rounding.
constexpr double kOverMm = 0.02;
constexpr double kPointsPerMm = 72.0 / 25.4;

class DesignMaker {
 public:
    DesignMaker(const Tracing& tracing, const SheetGraph& graph, const CardPage& page,
                const Features& features, Diagnostics& diagnostics)
        : tracing_(tracing), graph_(graph), page_(page), features_(features), diagnostics_(diagnostics) {}

    Design run(const std::vector<DrawnHole>& holes, const std::vector<const TracedLine*>& printed,
               std::vector<Segment> moves) {
        design_.version = "3.0";
        design_.unit = {"mm", 1.0};
        design_.width_mm = rounded(page_.width);
        design_.height_mm = rounded(page_.height);
        design_.page_place = place_of(page_.element);
        check_size();
        std::vector<Outline> outlines;
        for (const DrawnFeature& feature : features_.features)
            outlines.push_back(outline_of(graph_, features_, feature, moves));
        curves_ = tracing_.curves;
        curves_.move(graph_.merged);
        curves_.move(moves);
        for (std::size_t i = 0; i < outlines.size(); ++i) add(features_.features[i], outlines[i]);
        for (const DrawnHole& hole : holes) add(outline_of(graph_, hole));
        if (design_.structures.size() > kItemsLimit) {
            diagnostics_.error("document-too-large", {},
                               fmt::format("the drawing has more than {} features and holes", kItemsLimit));
        }
        for (const TracedFill& fill : tracing_.fills) add_area(fill);
        for (const TracedLine* line : printed) add_line(*line);
        return std::move(design_);
    }

 private:
    static double rounded(double mm) { return on_grid({mm, 0.0}).x; }
    [[nodiscard]] Place place_of(int element) const { return nth(tracing_.elements, element).place; }
    [[nodiscard]] Place place_of(const Outline& outline) const {
        return outline.elements.empty() ? Place{} : place_of(outline.elements.front());
    }
    [[nodiscard]] Vec2 to_page(Vec2 p) const { return on_grid(page_.to_page(p)); }

    void check_size() {
        for (const double size : {design_.width_mm, design_.height_mm}) {
            if (size >= kSmallestPage && size <= kLargestPage) continue;
            diagnostics_
                .error("page-not-rectangle", design_.page_place,
                       fmt::format("the page is {:.2f} × {:.2f} mm large; sides are from {:.0f} to {:.0f} mm",
                                   design_.width_mm, design_.height_mm, kSmallestPage, kLargestPage))
                .hint("write the drawing's width and height with their unit, such as width=\"210mm\"");
            return;
        }
    }

    DesignPoint point(Vec2 at, Place place) const {
        DesignPoint made;
        made.at = to_page(at);
        made.place = place;
        return made;
    }

    Structure& begin(std::string_view type, Place place) {
        Structure& made = design_.structures.emplace_back();
        made.type = type;
        made.id = fmt::format("e{}", design_.structures.size());
        made.place = made.type_place = made.fold.place = place;
        return made;
    }

    void stand(Structure& made, const Drive& drive) const {
        made.fold.begin = point(drive.at + drive.lo * drive.dir, made.place);
        made.fold.end = point(drive.at + drive.hi * drive.dir, made.place);
    }

    // The ring with the curves that it was drawn with, on the page.
    [[nodiscard]] DrawnPath path_of(const Ring& ring, bool& curved) const {
        DrawnPath drawn;
        drawn.moved = true;
        curved = add_ring(ring, drawn.path);
        return drawn;
    }

    // False with an error: it encloses nothing, or leaves the page far behind.
    bool give_outline(Structure& made, const ElementInfo& info, DrawnPath drawn) {
        if (enclose(drawn.path, drawn.inside) != FlatteningFault::none || drawn.inside.areas.empty()) {
            fault(made.place, "this outline encloses nothing", {});
            return false;
        }
        Argument& argument = made.argument(*find_parameter(info, "outline"));
        argument.value = std::move(drawn);
        argument.place = made.place;
        return true;
    }

    void give_length(Structure& made, const ElementInfo& info, std::string_view name, double mm) {
        Argument& argument = made.argument(*find_parameter(info, name));
        argument.value = rounded(mm);
        argument.place = made.place;
    }

    Diagnostic& fault(Place place, const std::string& what, std::optional<Vec2> at) {
        Diagnostic& told = diagnostics_.error("not-understood", place,
                                              at ? what + ", at " + shown_point(tracing_.ruler, *at) : what);
        return told.hint(
            "draw it otherwise, or leave it out with --lines ignore=NAME, of a layer, class, id or colour");
    }

    // --- features

    void add(const DrawnFeature& feature, const Outline& outline) {
        const Drive& drive = nth(features_.drives, feature.drive);
        if (outline.ring.size() < 3) {
            fault(place_of(outline), "what is cut out here has no area", {});
            return;
        }
        if (feature.outlined || feature.linkage.parallel)
            add_parallel(feature, drive, outline);
        else
            add_meeting(feature, drive, outline);
        tell_mended(feature);
    }

    // How far the outline reaches over a level, seen along the drive.
    static double reach(const Drive& drive, const Ring& ring, double aside) {
        double most = 0.0;
        for (const Vec2 p : ring) most = std::max(most, aside * drive.there(p).y);
        return most;
    }

    // Opposite corners, one on the left of the drive, where the ring is a rectangle along it.
    static std::optional<std::array<Vec2, 2>> box_of(const Drive& drive, const Ring& ring) {
        if (ring.size() != 4) return std::nullopt;
        Box box;
        for (const Vec2 p : ring) box.extend(drive.there(p));
        for (const Vec2 p : ring) {
            const Vec2 at = drive.there(p);
            if (std::min(at.x - box.min.x, box.max.x - at.x) > kOnCornerMm ||
                std::min(at.y - box.min.y, box.max.y - at.y) > kOnCornerMm)
                return std::nullopt;
        }
        return std::array{drive.back({box.min.x, box.max.y}), drive.back({box.max.x, box.min.y})};
    }

    void add_parallel(const DrawnFeature& feature, const Drive& drive, const Outline& outline) {
        const Place place = place_of(outline);
        const auto box = box_of(drive, outline.ring);
        // Its side folds are its far edges.
        const bool whole =
            !feature.outlined ||
            ((!feature.has_left || reach(drive, outline.ring, 1.0) - feature.linkage.left <= kOverMm) &&
             (!feature.has_right || reach(drive, outline.ring, -1.0) - feature.linkage.right <= kOverMm));
        if (box && whole) {
            Structure& made = begin("box-fold", place);
            for (const Vec2 corner : *box) made.points.push_back(point(corner, place));
            stand(made, drive);
            if (feature.outlined) tell_found(made, feature);
            return;
        }
        if (!feature.outlined) {
            for (const auto& [aside, fold] :
                 {std::pair{1.0, feature.linkage.left}, {-1.0, feature.linkage.right}}) {
                const double over = reach(drive, outline.ring, aside) - fold;
                if (over <= kSnapMm) continue;
                Diagnostic& told = fault(
                    place, fmt::format("this feature reaches {:.2f} mm beyond the fold that holds it", over),
                    {});
                const auto at_end = [this](Vec2 p) {
                    return std::abs(page_.to_page(p).y) >= 0.5 * page_.height - kSnapMm;
                };
                if (std::any_of(outline.ring.begin(), outline.ring.end(), at_end))
                    told.hint(
                        "it reaches the end of the card, where a card's features do not: end it before the "
                        "border, or fold the drawing with --as folded");
                return;
            }
        }
        bool curved = false;
        DrawnPath drawn = path_of(outline.ring, curved);
        Structure& made = begin(curved ? "freeform" : "polygon", place);
        const ElementInfo& info = *find_element(made.type);
        stand(made, drive);
        if (!give_outline(made, info, std::move(drawn))) return;
        if (!feature.outlined || feature.has_left) give_length(made, info, "top", feature.linkage.left);
        if (!feature.outlined || feature.has_right) give_length(made, info, "bottom", feature.linkage.right);
        if (feature.outlined) {
            tell_found(made, feature);
            if (!whole) tell_dropped(feature, drive, outline);
        }
    }

    void tell_found(const Structure& made, const DrawnFeature& feature) {
        if (feature.has_left && feature.has_right) return;
        diagnostics_
            .remark(
                "folds-found", made.place,
                feature.has_left || feature.has_right
                    ? "this outline lies across a fold, and one of its side folds is drawn; the other was "
                      "found"
                    : "this outline lies across a fold and has no folds of its own; they were found")
            .about(made.id)
            .hint(
                "draw the folds that hold it, or call its layer, class or id \"hole\" if it is to fall out");
    }

    void tell_dropped(const DrawnFeature& feature, const Drive& drive, const Outline& outline) {
        const double over =
            std::max(feature.has_left ? reach(drive, outline.ring, 1.0) - feature.linkage.left : 0.0,
                     feature.has_right ? reach(drive, outline.ring, -1.0) - feature.linkage.right : 0.0);
        diagnostics_
            .warning(
                "cut-beyond-fold", place_of(outline),
                fmt::format("this outline is cut all around and would fall out: what reaches up to {:.2f} mm "
                            "beyond its side folds is not cut",
                            over))
            .hint("end the outline at the folds that hold it");
    }

    // The corners that are not at the apex, as they lie from the left to the right, away from it.
    void add_meeting(const DrawnFeature& feature, const Drive& drive, const Outline& outline) {
        const Place place = place_of(outline);
        const Linkage& linkage = feature.linkage;
        const Vec2 apex = drive.back({linkage.apex, 0.0});
        const Ring& ring = outline.ring;
        const bool at_apex =
            std::any_of(ring.begin(), ring.end(), [&](Vec2 p) { return distance(p, apex) <= kOnCornerMm; });
        if (ring.size() == 3 && at_apex) {
            Structure& made = begin(drive.mountain ? "inverted-beak" : "beak", place);
            Vec2 left = apex;
            Vec2 right = apex;
            for (const Vec2 p : ring) {
                const double w = drive.there(p).y;
                if (w > drive.there(left).y) left = p;
                if (w < drive.there(right).y) right = p;
            }
            for (const Vec2 p : {apex, left, right}) made.points.push_back(point(p, place));
            stand(made, drive);
            return;
        }
        if (at_apex) {
            bool curved = false;
            DrawnPath drawn = path_of(ring, curved);
            Structure& made = begin("v-fold-cut", place);
            made.points.push_back(point(apex, place));
            stand(made, drive);
            give_outline(made, *find_element(made.type), std::move(drawn));
            return;
        }
        if (ring.size() != 4) {
            fault(place, "the folds of this feature meet outside of it, and its cuts are not straight", {});
            return;
        }
        std::vector<Vec2> left;
        std::vector<Vec2> right;
        for (const Vec2 p : ring) (drive.there(p).y > 0.0 ? left : right).push_back(p);
        if (left.size() != 2 || right.size() != 2) {
            fault(place, "this feature has no two corners on either side of the fold that it stands on", {});
            return;
        }
        const auto nearer = [&](Vec2 a, Vec2 b) { return distance(a, apex) < distance(b, apex); };
        std::sort(left.begin(), left.end(), nearer);
        std::sort(right.begin(), right.end(), nearer);
        Structure& made = begin(drive.mountain ? "inverted-angled-step" : "angled-step", place);
        for (const Vec2 p : {left[0], left[1], right[0], right[1]}) made.points.push_back(point(p, place));
        stand(made, drive);
    }

    // Folds that were drawn a little beside where they fold.
    void tell_mended(const DrawnFeature& feature) {
        if (feature.outlined) return;
        const Drive& drive = nth(features_.drives, feature.drive);
        if (feature.centre.edges.empty()) tell_added(feature, drive);
        if (feature.linkage.off <= kSilentMm) return;
        const FoldLine& centre = feature.centre.edges.empty() ? feature.left : feature.centre;
        const Segment drawn = centre.line;
        Segment exact = feature.centre.edges.empty() ? feature.linkage.left_line(drive, drawn)
                                                     : feature.linkage.centre_line(drive, drawn);
        if (dot(exact.b - exact.a, drawn.b - drawn.a) < 0.0) std::swap(exact.a, exact.b);
        diagnostics_
            .warning(
                "fold-straightened", place_of(nth(graph_.edges, centre.edges.front()).element),
                fmt::format("the folds of this feature are up to {:.2f} mm off those that fold flat; they "
                            "were moved there",
                            feature.linkage.off))
            .about(design_.structures.empty() ? std::string() : design_.structures.back().id)
            .changed(shown_point(tracing_.ruler, drawn.a) + " to " + shown_point(tracing_.ruler, drawn.b),
                     shown_point(tracing_.ruler, exact.a) + " to " + shown_point(tracing_.ruler, exact.b));
    }

    void tell_added(const DrawnFeature& feature, const Drive& drive) {
        const Segment added = feature.linkage.centre_line(drive, feature.left.line);
        diagnostics_
            .warning("fold-added", place_of(nth(graph_.edges, feature.left.edges.front()).element),
                     "the middle fold of this feature is not drawn; it was added where it folds flat")
            .about(design_.structures.empty() ? std::string() : design_.structures.back().id)
            .hint("draw it, so that the drawing shows what is folded")
            .changed("no middle fold",
                     fmt::format("one in the line from {} to {}", shown_point(tracing_.ruler, added.a),
                                 shown_point(tracing_.ruler, added.b)));
    }

    void add(const Outline& outline) {
        const Place place = place_of(outline);
        if (outline.ring.size() < 3) return;
        bool curved = false;
        DrawnPath drawn = path_of(outline.ring, curved);
        Structure& made = begin("hole", place);
        made.finds_ground = true;
        give_outline(made, *find_element(made.type), std::move(drawn));
    }

    // --- prints

    void add_area(const TracedFill& fill) {
        constexpr Color kPaper{255, 255, 255};
        if (fill.color == kPaper || fill.owner > 0 || !fill.is_printed) return;
        DrawnArea area;
        area.fill = fill.color;
        area.shape.moved = true;
        Path& path = area.shape.path;
        const std::vector<Polygon> inside =
            filled(fill.rings, fill.even_odd ? FillRule::even_odd : FillRule::non_zero);
        for (const Polygon& polygon : inside) {
            for (std::size_t i = 0; i <= polygon.holes.size(); ++i)
                add_ring(i == 0 ? polygon.outer : polygon.holes[i - 1], path);
        }
        if (path.empty()) return;
        if (enclose(path, area.shape.inside) != FlatteningFault::none || area.shape.inside.areas.empty())
            return;
        DrawnPrint& made = design_.prints.emplace_back();
        made.what = std::move(area);
        made.place = place_of(fill.element);
    }

    // True when a part of it is a curve.
    bool add_ring(const Ring& ring, Path& path) const {
        const Restored restored = curves_.restored(ring, true, false);
        path.move(to_page(ring[restored.start]));
        if (restored.steps.empty()) {
            for (std::size_t i = 1; i < ring.size(); ++i) path.line(to_page(ring[i]));
        }
        for (const CurveStep& step : restored.steps) {
            const Vec2 to = to_page(ring[step.to]);
            if (step.curve)
                path.cubic(to_page(step.control_1), to_page(step.control_2), to);
            else if (step.to != restored.start)
                path.line(to);
        }
        path.close();
        return !restored.steps.empty();
    }

    void add_line(const TracedLine& line) {
        DrawnLine& made = design_.lines.emplace_back();
        made.place = place_of(line.element);
        made.color = line.color;
        made.thickness_pt = std::clamp(line.width_mm * kPointsPerMm, 0.0, kThickestLine);
        for (const Vec2 p : line.points) made.points.push_back(point(p, made.place));
        if (line.closed) made.points.push_back(made.points.front());
    }

    const Tracing& tracing_;
    const SheetGraph& graph_;
    const CardPage& page_;
    const Features& features_;
    Diagnostics& diagnostics_;
    CurveTable curves_;
    Design design_;
};

}  // namespace

Design make_design(const Tracing& tracing, const SheetGraph& graph, const CardPage& page,
                   const Features& features, const std::vector<DrawnHole>& holes,
                   const std::vector<const TracedLine*>& printed, std::vector<Segment> moves,
                   Diagnostics& diagnostics) {
    return DesignMaker(tracing, graph, page, features, diagnostics).run(holes, printed, std::move(moves));
}

}  // namespace popup::drawing::card
