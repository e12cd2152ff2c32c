#include "input/drawing/card/origamic_card.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <utility>

#include "assembly/settle.h"
#include "base/geometry/mend_ends.h"
#include "base/geometry/regions.h"
#include "base/geometry/tolerances.h"
#include "base/nth.h"
#include "input/design_limits.h"
#include "input/drawing/card/planes.h"
#include "input/origamic/folds.h"
#include "input/origamic/make_assembly.h"

namespace popup::drawing::card {
namespace {

using origamic::Fold;
using origamic::Holding;
using origamic::Region;

constexpr double kOpenCardDeg = 180.0;
// Areas that differ by less are one.
constexpr double kSpeckMm2 = 1e-3;

double rounded(double mm) { return on_grid({mm, 0.0}).x; }

std::vector<Vec2> on_page_of(const SheetGraph& graph, const CardPage& page) {
    std::vector<Vec2> made;
    made.reserve(graph.corners.size());
    for (const Vec2 corner : graph.corners) made.push_back(on_grid(page.to_page(corner)));
    return made;
}

class CardMaker {
 public:
    CardMaker(const Tracing& tracing, const SheetGraph& graph, const CardPage& page, const Features& features,
              NotUnderstood& why)
        : tracing_(tracing), graph_(graph), page_(page), features_(features), why_(why) {}

    std::optional<OrigamicCard> run(const std::vector<const TracedLine*>& printed,
                                    const std::vector<Segment>& moves) {
        // What is cut all around has folds that are not drawn.
        const auto outlined = std::find_if(features_.features.begin(), features_.features.end(),
                                           [](const DrawnFeature& feature) { return feature.outlined; });
        if (outlined != features_.features.end()) {
            refuse(graph_.halves_of(outlined->faces.front()).front(),
                   "this is cut all around, across a fold");
            return std::nullopt;
        }
        if (!features_.refused.empty() || !has_room()) return std::nullopt;
        corners_ = on_page_of(graph_, page_);
        std::optional<Planes> planes = find_planes(graph_, page_, features_, corners_, DrawnOn::taken, why_);
        if (!planes) return std::nullopt;
        planes_ = std::move(*planes);
        if (!is_all_paper() || !put_on_lines()) return std::nullopt;
        if (!add_regions()) return std::nullopt;
        add_folds();
        const Holding held = origamic::holding(regions_, folds_);
        if (held.back < 0 || held.floor < 0 || held.order.size() != regions_.size() || !moves_one_way(held)) {
            refuse(graph_.halves_of(planes_.order.back()).front(),
                   "the card does not hold all plates as it opens: something hangs on a single fold, or is a "
                   "strip of "
                   "more than two plates");
            return std::nullopt;
        }
        out_.assembly =
            origamic::make_assembly({rounded(page_.height), 0.5 * rounded(page_.width), kOpenCardDeg},
                                    regions_, folds_, held, names(held));
        out_.assembly.curves = curves(moves);
        add_prints(printed);
        settle_numbers(out_.assembly);
        return std::move(out_);
    }

 private:
    [[nodiscard]] bool folds(int half) const { return folds_paper(graph_, features_, half); }
    [[nodiscard]] const Plane& plane(int half) const { return nth(planes_.of, graph_.face_of(half)); }
    [[nodiscard]] Vec2 at(int corner) const { return nth(corners_, corner); }
    [[nodiscard]] Segment segment(int half) const { return {at(graph_.from(half)), at(graph_.to(half))}; }

    bool refuse(int half, std::string what) {
        why_ = {graph_.edge(half).element, std::move(what), graph_.at(graph_.edge(half).a)};
        return false;
    }

    [[nodiscard]] bool has_room() const {
        const auto fits = [](double mm) { return mm >= kSmallestPage && mm <= kLargestPage; };
        return fits(page_.width) && fits(page_.height);
    }

    // Whether no line is lost: none ends in the paper or in a hole, and no hole opens to the border of the
    // page. A fold in a hole falls out with it, and is told.
    bool is_all_paper() {
        std::map<int, double> ends;  // how much of a line lies in one face
        const Vec2 reach{0.5 * page_.width - kSnapMm, 0.5 * page_.height - kSnapMm};
        const auto on_border = [&](Vec2 a, Vec2 b) {
            return std::min(std::abs(a.x), std::abs(b.x)) >= reach.x ||
                   std::min(std::abs(a.y), std::abs(b.y)) >= reach.y;
        };
        for (std::size_t i = 0; i < graph_.edges.size(); ++i) {
            const int half = static_cast<int>(2 * i);
            const int a = graph_.face_of(half);
            const int b = graph_.face_of(half ^ 1);
            const Segment line = segment(half);
            const double size = distance(line.a, line.b);
            // What is no longer than this is rounding.
            if (a == b && a != 0 && (ends[graph_.edges[i].line] += size) > 2.0 * kSilentMm)
                return refuse(half, "this line ends in the paper");
            const bool outside = a == 0 || b == 0;
            if (outside && a != b && !nth(planes_.of, std::max(a, b)).known && size > kSnapMm &&
                on_border(line.a, line.b))
                return refuse(half, "paper at the border of the page is cut off");
        }
        return true;
    }

    [[nodiscard]] double line_of(const Plane& a, const Plane& b) const {
        return rounded(a.upright ? a.offset - b.offset : b.offset - a.offset);
    }

    // Moves the ends of folds to the lines where their planes meet, and the border to that of the page.
    bool put_on_lines() {
        std::map<int, double> to;  // x, by corner
        for (std::size_t i = 0; i < graph_.edges.size(); ++i) {
            const int half = static_cast<int>(2 * i);
            if (!folds(half) || !plane(half).known) continue;
            const double x = line_of(plane(half), plane(half ^ 1));
            for (const int corner : {graph_.from(half), graph_.to(half)}) {
                const auto [known, fresh] = to.try_emplace(corner, x);
                const double off = std::abs(at(corner).x - x);
                if ((!fresh && std::abs(known->second - x) > kGridMm) || off > kSnapMm)
                    return refuse(half, fmt::format("this fold lies {:.2f} mm beside where it can fold",
                                                    std::max(off, std::abs(known->second - x))));
                if (off > out_.off) {
                    out_.off = off;
                    out_.off_element = graph_.edges[i].element;
                }
            }
        }
        const Vec2 reach{0.5 * rounded(page_.width), 0.5 * rounded(page_.height)};
        const auto onto = [](double& v, double border) {
            if (std::abs(std::abs(v) - border) <= kSnapMm) v = std::copysign(border, v);
        };
        for (std::size_t i = 0; i < corners_.size(); ++i) {
            Vec2 moved = corners_[i];
            const auto& around = graph_.around(static_cast<int>(i));
            const bool border = std::any_of(around.begin(), around.end(),
                                            [&](int half) { return graph_.face_of(half) == 0; });
            if (border) {
                onto(moved.x, reach.x);
                onto(moved.y, reach.y);
            }
            if (const auto found = to.find(static_cast<int>(i)); found != to.end()) moved.x = found->second;
            if (moved == corners_[i]) continue;
            snaps_.push_back({corners_[i], moved});
            corners_[i] = moved;
        }
        return true;
    }

    // The loops of a face's border, without what ends in it.
    [[nodiscard]] Polygon area_of(int face) const {
        Polygon made;
        std::map<int, bool> seen;
        for (const int first : graph_.halves_of(face)) {
            if (seen[first]) continue;
            Ring ring;
            for (int half = first; !seen[half]; half = graph_.next(half)) {
                seen[half] = true;
                if (graph_.face_of(half ^ 1) != face) ring.push_back(at(graph_.from(half)));
            }
            if (ring.size() < 3) continue;
            if (signed_area(ring) > 0.0)
                made.outer = std::move(ring);
            else
                made.holes.push_back(std::move(ring));
        }
        return made;
    }

    // False if the border of one crosses itself: corners were moved over others.
    bool add_regions() {
        region_of_.assign(static_cast<std::size_t>(graph_.faces()), -1);
        for (const int face : planes_.order) {
            nth(region_of_, face) = static_cast<int>(regions_.size());
            const Plane& plane = nth(planes_.of, face);
            const bool of_cover = face == page_.left || face == page_.right;
            Polygon made = area_of(face);
            std::vector<Ring> rings = made.holes;
            rings.push_back(made.outer);
            if (std::abs(area(filled(rings, FillRule::even_odd)) - area(made)) > kSpeckMm2) return false;
            regions_.push_back({plane.upright, plane.offset, std::move(made), of_cover});
        }
        return true;
    }

    // Those that follow each other are one.
    void add_folds() {
        std::vector<std::pair<Fold, int>> all;  // and the edge
        for (std::size_t i = 0; i < graph_.edges.size(); ++i) {
            int half = static_cast<int>(2 * i);
            if (!folds(half) || nth(region_of_, graph_.face_of(half)) < 0) continue;
            // With what is above, at smaller x, on the left of it.
            if (segment(half).a.y > segment(half).b.y) half ^= 1;
            const Segment line = segment(half);
            if (!(line.b.y > line.a.y)) continue;
            const int above = nth(region_of_, graph_.face_of(half));
            const int below = nth(region_of_, graph_.face_of(half ^ 1));
            const Fold fold{above, below, line.a.x, line.a.y, line.b.y, nth(regions_, above).upright};
            note_way(static_cast<int>(i), fold);
            all.emplace_back(fold, static_cast<int>(i));
        }
        std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) {
            return std::tie(a.first.x, a.first.above, a.first.below, a.first.y0) <
                   std::tie(b.first.x, b.first.above, b.first.below, b.first.y0);
        });
        for (const auto& [fold, edge] : all) {
            Fold* last = folds_.empty() ? nullptr : &folds_.back();
            if (last != nullptr && last->above == fold.above && last->below == fold.below &&
                last->x == fold.x && last->y1 == fold.y0)
                last->y1 = fold.y1;
            else
                folds_.push_back(fold);
        }
        std::stable_sort(folds_.begin(), folds_.end(), [](const Fold& a, const Fold& b) {
            return std::tie(a.x, a.y0) < std::tie(b.x, b.y0);
        });
    }

    void note_way(int edge, const Fold& fold) {
        const unsigned ink = nth(graph_.edges, edge).ink & (kMountain | kValley);
        if (ink == 0 || fold.y1 - fold.y0 <= kSnapMm) return;
        ((ink & (fold.valley ? kValley : kMountain)) != 0 ? out_.as_drawn : out_.other_way).push_back(edge);
    }

    // Whether nothing but the parallel motion is left to the plates when the card opens. Seen along the
    // gutter, each turns in its plane about the points where it is folded. The speeds of turning, with the
    // back held, are found from the loops of folds at 90°, where no two of these points lie on one another
    // unless they are on one line of the sheet: all but that of the floor must follow.
    [[nodiscard]] bool moves_one_way(const Holding& held) const {
        const std::size_t plates = held.order.size();
        std::vector<int> number(regions_.size(), -1);
        for (std::size_t i = 0; i < plates; ++i) nth(number, held.order[i].region) = static_cast<int>(i);
        const auto place = [&](const Fold& fold) {
            const Region& above = nth(regions_, fold.above);
            const Region& below = nth(regions_, fold.below);
            const Region& upright = above.upright ? above : below;
            const Region& lying = above.upright ? below : above;
            return Vec2{upright.offset, lying.offset};
        };
        // The speed of a plate at the origin is a sum over the speeds of turning on its way from the back.
        struct Speed {
            std::map<int, Vec2> of;
        };
        std::vector<Speed> speed(plates);
        std::vector<char> is_tree(folds_.size(), 0);
        const auto add = [](Speed& to, int plate, Vec2 by) { to.of[plate] = to.of[plate] + by; };
        // v(p) = v(0) + w left_of(p). Two plates have one speed where they are folded.
        const auto follow = [&](std::size_t plate, int base, Vec2 p) {
            speed[plate] = nth(speed, base);
            add(speed[plate], base, left_of(p));
            add(speed[plate], static_cast<int>(plate), -left_of(p));
        };
        const auto gutter = std::find_if(folds_.begin(), folds_.end(), [&](const Fold& fold) {
            return fold.above == held.back && fold.below == held.floor;
        });
        if (gutter == folds_.end()) return false;
        is_tree[static_cast<std::size_t>(gutter - folds_.begin())] = 1;
        for (std::size_t i = 0; i < plates; ++i) {
            const Holding::Step& step = held.order[i];
            if (step.fold < 0) {
                if (step.region == held.floor) follow(i, nth(number, held.back), place(*gutter));
                continue;
            }
            const Fold& fold = nth(folds_, step.fold);
            nth(is_tree, step.fold) = 1;
            follow(i, nth(number, fold.above == step.region ? fold.below : fold.above), place(fold));
        }
        std::vector<std::map<int, Vec2>> rows;
        std::set<std::pair<int, int>> known;  // all folds between two plates lie on one line
        for (std::size_t i = 0; i < folds_.size(); ++i) {
            if (is_tree[i] != 0) known.insert({folds_[i].above, folds_[i].below});
        }
        for (std::size_t i = 0; i < folds_.size(); ++i) {
            const Fold& fold = folds_[i];
            if (is_tree[i] != 0 || !known.insert({fold.above, fold.below}).second) continue;
            const Vec2 p = place(fold);
            Speed row = nth(speed, nth(number, fold.above));
            add(row, nth(number, fold.above), left_of(p));
            for (const auto& [plate, by] : nth(speed, nth(number, fold.below)).of) add(row, plate, -by);
            add(row, nth(number, fold.below), -left_of(p));
            rows.push_back(std::move(row.of));
        }
        // All but the back may turn, and the floor does: two less than there are must be held.
        const Eigen::Index free = static_cast<Eigen::Index>(plates) - 2;
        if (free == 0) return true;
        Eigen::MatrixXd loops = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(2 * rows.size()), free);
        for (std::size_t i = 0; i < rows.size(); ++i) {
            for (const auto& [plate, by] : rows[i]) {
                if (plate < 2) continue;  // the covers come first
                loops(static_cast<Eigen::Index>(2 * i), plate - 2) = by.x / page_.width;
                loops(static_cast<Eigen::Index>(2 * i + 1), plate - 2) = by.y / page_.width;
            }
        }
        if (loops.rows() < free) return false;
        Eigen::ColPivHouseholderQR<Eigen::MatrixXd> solver(loops);
        solver.setThreshold(1e-6);
        return solver.rank() == free;
    }

    [[nodiscard]] std::vector<origamic::Named> names(const Holding& held) const {
        std::vector<origamic::Named> made(regions_.size());
        int count = 0;
        for (const Holding::Step& step : held.order) {
            origamic::Named& named = nth(made, step.region);
            if (step.fold < 0) {
                named.plate = step.region == held.back ? "page/left" : "page/right";
                continue;
            }
            named.plate = named.joint = fmt::format("plate-{}", ++count);
            named.place = nth(tracing_.elements, element_of(nth(planes_.order, step.region))).place;
        }
        return made;
    }

    // That drew its border: of several the last, for what is drawn later stands on what is drawn before.
    [[nodiscard]] int element_of(int face) const {
        int last = 0;
        for (const int half : graph_.halves_of(face)) last = std::max(last, graph_.edge(half).element);
        return last;
    }

    [[nodiscard]] CurveTable curves(const std::vector<Segment>& moves) const {
        CurveTable drawn = tracing_.curves;
        drawn.move(graph_.merged);
        drawn.move(moves);
        std::vector<FlatCurve> on_page = drawn.curves();
        for (FlatCurve& curve : on_page) {
            for (Vec2* p :
                 {&curve.cubic.from, &curve.cubic.control_1, &curve.cubic.control_2, &curve.cubic.to})
                *p = on_grid(page_.to_page(*p));
            for (FlatCurve::Corner& corner : curve.corners) corner.at = on_grid(page_.to_page(corner.at));
        }
        CurveTable made(on_page);
        made.move(snaps_);
        return made;
    }

    [[nodiscard]] Ring on_page(Ring ring) const {
        for (Vec2& p : ring) p = on_grid(page_.to_page(p));
        return ring;
    }

    // What is printed, on the plates that it lies on.
    void add_prints(const std::vector<const TracedLine*>& printed) {
        constexpr Color kPaper{255, 255, 255};
        for (const TracedFill& fill : tracing_.fills) {
            if (fill.color == kPaper || fill.owner > 0 || !fill.is_printed) continue;
            std::vector<Polygon> shape;
            for (const Polygon& part :
                 filled(fill.rings, fill.even_odd ? FillRule::even_odd : FillRule::non_zero)) {
                Polygon& made = shape.emplace_back(Polygon{on_page(part.outer), {}});
                for (const Ring& hole : part.holes) made.holes.push_back(on_page(hole));
            }
            for (Plate& plate : out_.assembly.plates) {
                for (Polygon& part : intersect(shape, {plate.outline}))
                    plate.prints.emplace_back(std::in_place_type<Area>, Area{std::move(part), fill.color});
            }
        }
        for (const TracedLine* line : printed) {
            std::vector<Vec2> points = on_page(line->points);
            if (line->closed) points.push_back(points.front());
            for (Plate& plate : out_.assembly.plates) {
                for (std::vector<Vec2>& part : clip_line(points, plate.outline))
                    plate.prints.emplace_back(std::in_place_type<Stroke>,
                                              Stroke{std::move(part), line->width_mm, line->color});
            }
        }
    }

    const Tracing& tracing_;
    const SheetGraph& graph_;
    const CardPage& page_;
    const Features& features_;
    NotUnderstood& why_;
    std::vector<Vec2> corners_;   // on the page
    std::vector<Segment> snaps_;  // of them, on the page
    Planes planes_;               // the faces of their order are the regions
    std::vector<int> region_of_;  // by face; -1: none
    std::vector<Region> regions_;
    std::vector<Fold> folds_;
    OrigamicCard out_;
};

}  // namespace

std::optional<OrigamicCard> origamic_card(const Tracing& tracing, const SheetGraph& graph,
                                          const CardPage& page, const Features& features,
                                          const std::vector<const TracedLine*>& printed,
                                          const std::vector<Segment>& moves, NotUnderstood& why) {
    return CardMaker(tracing, graph, page, features, why).run(printed, moves);
}

std::vector<int> folds_drawn_on(const SheetGraph& graph, const CardPage& page, const Features& features) {
    NotUnderstood why;
    auto planes = find_planes(graph, page, features, on_page_of(graph, page), DrawnOn::looked_for, why);
    return planes ? std::move(planes->drawn_on) : std::vector<int>{};
}

}  // namespace popup::drawing::card
