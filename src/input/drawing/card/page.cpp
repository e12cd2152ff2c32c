#include "input/drawing/card/page.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/geometry/mend_ends.h"
#include "base/geometry/regions.h"
#include "base/nth.h"

namespace popup::drawing::card {
namespace {

// Corners of the border no further from a straight line, in mm, are none.
constexpr double kStraightSideMm = 0.02;
// Sides that lean less than this, in mm over their length, stand straight on the drawing.
constexpr double kUprightMm = 1e-3;

struct Rectangle {
    Vec2 middle, across, up;  // unit
    double width = 0.0, height = 0.0;
    double off = 0.0;  // how far its worst corner is from the rectangle
    Vec2 worst;
};

// Where the gutter ends at the border.
struct End {
    double along = 0.0;  // from the middle of the side
    int corner = 0;
    int half = 0;  // into the page
};

class PageFinder {
 public:
    PageFinder(const Tracing& tracing, const SheetGraph& graph, Diagnostics& diagnostics)
        : tracing_(tracing), graph_(graph), diagnostics_(diagnostics) {}

    std::optional<CardPage> run() {
        if (!find_border()) return std::nullopt;
        const auto rectangle = fit_rectangle();
        if (!rectangle || !is_cut()) return std::nullopt;
        return find_gutter(*rectangle);
    }

 private:
    [[nodiscard]] Place place_of(int element) const { return nth(tracing_.elements, element).place; }
    [[nodiscard]] bool is_border(int half) const {
        return graph_.face_of(half) == 0 && graph_.face_of(half ^ 1) != 0;
    }

    // The outermost loop around the largest area.
    bool find_border() {
        std::vector<char> seen(2 * graph_.edges.size(), 0);
        double best = 0.0;
        for (const int first : graph_.halves_of(0)) {
            if (nth(seen, first) != 0 || !is_border(first)) continue;
            std::vector<int> loop;
            Ring ring;
            for (int half = first; nth(seen, half) == 0;) {
                nth(seen, half) = 1;
                loop.push_back(half);
                ring.push_back(graph_.at(graph_.from(half)));
                half = graph_.next(half);
                while (!is_border(half)) half = graph_.next(half ^ 1);
            }
            const double area = std::abs(signed_area(ring));
            if (area <= best) continue;
            best = area;
            border_ = std::move(loop);
            ring_ = std::move(ring);
        }
        if (!border_.empty()) return true;
        diagnostics_
            .error("no-page", {}, "nothing in the drawing encloses an area, so there is no page to fold")
            .hint("draw the border of the page as a rectangle, solid and not in the colour of folds");
        return false;
    }

    // A rectangle that folds enclose is of a drawing whose border was forgotten.
    bool is_cut() {
        const auto fold = std::find_if(border_.begin(), border_.end(), [this](int half) {
            return (graph_.edge(half).ink & (kCut | kCutOut)) == 0;
        });
        if (fold == border_.end()) return true;
        diagnostics_
            .error("no-page", place_of(graph_.edge(*fold).element),
                   "this fold is a side of the largest rectangle of the drawing, so there is no page to fold")
            .hint("draw the border of the page as a rectangle, solid and not in the colour of folds");
        return false;
    }

    std::optional<Rectangle> fit_rectangle() {
        std::reverse(ring_.begin(), ring_.end());  // the outside lies on its left
        const Ring corners = tidied(ring_, kStraightSideMm);
        std::size_t longest = 0;
        const auto side = [&](std::size_t i) { return corners[(i + 1) % corners.size()] - corners[i]; };
        for (std::size_t i = 0; i < corners.size(); ++i) {
            if (length(side(i)) > length(side(longest)) + 1e-6) longest = i;
        }
        Rectangle made;
        if (corners.size() < 3) return not_rectangle(made, corners);
        made.across = unit(side(longest));
        const Vec2 lean = length(side(longest)) * made.across;
        if (std::abs(lean.y) <= kUprightMm) made.across = {lean.x < 0.0 ? -1.0 : 1.0, 0.0};
        if (std::abs(lean.x) <= kUprightMm) made.across = {0.0, lean.y < 0.0 ? -1.0 : 1.0};
        made.up = left_of(made.across);
        Box box;
        for (const Vec2 p : corners) box.extend({dot(made.across, p), dot(made.up, p)});
        made.width = box.width();
        made.height = box.height();
        made.middle = box.centre().x * made.across + box.centre().y * made.up;
        if (corners.size() != 4) return not_rectangle(made, corners);
        for (const Vec2 p : corners) {
            const Vec2 at{dot(made.across, p), dot(made.up, p)};
            const double off = std::max(std::min(at.x - box.min.x, box.max.x - at.x),
                                        std::min(at.y - box.min.y, box.max.y - at.y));
            if (off > made.off) {
                made.off = off;
                made.worst = p;
            }
        }
        if (made.off > kSnapMm) return not_rectangle(made, corners);
        if (made.off > kSilentMm) {
            diagnostics_
                .warning("page-mended", place_of(border_element()),
                         fmt::format("a corner of the page is {:.2f} mm off a rectangle, at {}", made.off,
                                     shown_point(tracing_.ruler, made.worst)))
                .hint("draw the page as a rectangle")
                .changed("a border of four sides",
                         fmt::format("a page of {:.2f} × {:.2f} mm", made.width, made.height));
        }
        return made;
    }

    std::optional<Rectangle> not_rectangle(const Rectangle& around, const Ring& corners) {
        diagnostics_
            .error("page-not-rectangle", place_of(border_element()),
                   fmt::format("the border of the drawing has {} corners; a page is a rectangle",
                               corners.size()))
            .hint(fmt::format(
                "draw the page as a rectangle around everything: what is there is {:.2f} × {:.2f} mm "
                "large",
                around.width, around.height))
            .hint("lines that leave the page must end at its border");
        return std::nullopt;
    }

    [[nodiscard]] int border_element() const {
        int first = graph_.edge(border_.front()).element;
        for (const int half : border_) first = std::min(first, graph_.edge(half).element);
        return first;
    }

    // True of a border that no other line meets, with another area inside.
    [[nodiscard]] bool is_frame() const {
        return graph_.faces() > 2 && std::all_of(border_.begin(), border_.end(), [this](int half) {
                   return graph_.around(graph_.from(half)).size() == 2;
               });
    }

    // Folds that end at a side of the rectangle, in its middle or not.
    [[nodiscard]] std::vector<End> ends_at(const Rectangle& page, Vec2 out, double reach) const {
        std::vector<End> ends;
        for (const int half : border_) {
            const int corner = graph_.from(half);
            if (std::abs(dot(out, graph_.at(corner) - page.middle) - reach) > kSnapMm) continue;
            for (const int away : graph_.around(corner)) {
                const GraphEdge& edge = graph_.edge(away);
                if ((edge.ink & kAnyFold) == 0 || is_border(away) || is_border(away ^ 1)) continue;
                const Vec2 way = unit(graph_.at(graph_.to(away)) - graph_.at(corner));
                if (dot(way, out) > -0.99) continue;
                ends.push_back({dot(left_of(out), graph_.at(corner) - page.middle), corner, away});
            }
        }
        return ends;
    }

    // A fold between opposite sides, as near to their middles as there is one.
    struct Gutter {
        End from, to;
        Vec2 up;
        double off = HUGE_VAL;  // from the middle
    };
    [[nodiscard]] std::optional<Gutter> gutter_along(const Rectangle& page, Vec2 up, double reach) const {
        std::optional<Gutter> best;
        for (const End& from : ends_at(page, -up, reach)) {
            for (const End& to : ends_at(page, up, reach)) {
                // Both are measured to the left of the way out.
                if (std::abs(from.along + to.along) > 2.0 * kSnapMm) continue;
                const double off = std::max(std::abs(from.along), std::abs(to.along));
                if (!best || off < best->off) best = Gutter{from, to, up, off};
            }
        }
        return best;
    }

    void tell_moved(const Rectangle& page, const Gutter& gutter, const CardPage& made) {
        const auto shown = [&](Vec2 p) { return shown_point(tracing_.ruler, p); };
        const double beside = distance(page.middle, made.centre);
        if (beside > 0.5 * gutter.off) {
            diagnostics_
                .warning(
                    "page-mended", place_of(made.element),
                    fmt::format("the gutter lies {:.2f} mm beside the middle of the page; the border was "
                                "moved by as much",
                                gutter.off))
                .hint("the halves of a card are equally wide")
                .changed("a page about " + shown(page.middle), "a page about " + shown(made.centre));
            return;
        }
        const Vec2 reach = 0.5 * made.height * made.up;
        diagnostics_
            .warning(
                "page-mended", place_of(made.gutter_element),
                fmt::format("the gutter leans: its ends lie up to {:.2f} mm beside the middle of the page, "
                            "on either side; it was turned into the middle",
                            gutter.off))
            .hint("the halves of a card are equally wide")
            .changed(shown(graph_.at(gutter.from.corner)) + " to " + shown(graph_.at(gutter.to.corner)),
                     shown(made.centre - reach) + " to " + shown(made.centre + reach));
    }

    std::optional<CardPage> find_gutter(const Rectangle& page) {
        // Up, or to the right and then turned upright.
        const auto way = [](Vec2 v) {
            const bool level = std::abs(v.x) > std::abs(v.y);
            return (level ? v.x : v.y) < 0.0 ? -v : v;
        };
        auto gutter = gutter_along(page, way(page.up), 0.5 * page.height);
        const auto other = gutter_along(page, way(page.across), 0.5 * page.width);
        const bool turned = other && (!gutter || other->off < gutter->off);
        if (turned) gutter = other;
        if (!gutter) {
            Diagnostic& told = diagnostics_.error(
                "no-gutter", place_of(border_element()),
                "no fold goes from the middle of one side of the page to that of the opposite side");
            told.hint(
                "draw the fold in the middle of the card, from edge to edge, dashed or in the colour of "
                "folds");
            told.hint("--lines says which lines are folds: --lines fold=#0000ff");
            if (is_frame())
                told.hint(
                    "nothing ends at this border; if it is a frame around the card, leave it out: "
                    "--lines ignore=NAME, of its layer, class, id or colour");
            return std::nullopt;
        }
        CardPage made;
        made.up = gutter->up;
        made.width = turned ? page.height : page.width;
        made.height = turned ? page.width : page.height;
        made.element = border_element();
        made.gutter_element = graph_.edge(gutter->from.half).element;
        // The gutter stays where it is drawn, for features stand on it, and the border moves.
        const Vec2 aside = left_of(gutter->up);
        const Vec2 drawn = lerp(graph_.at(gutter->from.corner), graph_.at(gutter->to.corner), 0.5);
        made.centre = page.middle + dot(aside, drawn - page.middle) * aside;
        if (gutter->off > kSnapMm) {
            diagnostics_
                .error("gutter-off-middle", place_of(made.gutter_element),
                       fmt::format("the gutter lies {:.2f} mm beside the middle of the page", gutter->off))
                .hint("the halves of a card are equally wide: move the gutter, or the border");
            return std::nullopt;
        }
        if (gutter->off > kSilentMm) tell_moved(page, *gutter, made);
        // Looking up, the left face lies on the left of the half that runs up.
        made.left = graph_.face_of(gutter->from.half);
        made.right = graph_.face_of(gutter->from.half ^ 1);
        return made;
    }

    const Tracing& tracing_;
    const SheetGraph& graph_;
    Diagnostics& diagnostics_;
    std::vector<int> border_;  // halves with the outside on their left
    Ring ring_;
};

}  // namespace

std::optional<CardPage> find_page(const Tracing& tracing, const SheetGraph& graph, Diagnostics& diagnostics) {
    return PageFinder(tracing, graph, diagnostics).run();
}

}  // namespace popup::drawing::card
