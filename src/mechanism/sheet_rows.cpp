#include "mechanism/sheet_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/geometry/edge_index.h"
#include "base/geometry/regions.h"
#include "mechanism/catmull_rom.h"
#include "mechanism/drawn_lines.h"
#include "mechanism/site_lines.h"
#include "mechanism/thin_places.h"

namespace popup {
namespace {

// A knife cannot turn more tightly.
constexpr double kLeastRadiusMm = 0.1;
// Longer borders are no drawings.
constexpr std::size_t kMostEdges = 20'000;

const DrawnPath* outline_of(const Element& e) {
    const auto number = find_parameter(*e.info, "outline");
    return number ? std::get_if<DrawnPath>(&e.arguments[*number].value) : nullptr;
}

bool same(const Subpath& one, const Subpath& other) {
    const auto same_step = [](const PathStep& a, const PathStep& b) {
        return a.to == b.to && a.curve == b.curve && a.control_1 == b.control_1 && a.control_2 == b.control_2;
    };
    return one.start == other.start && one.closed == other.closed &&
           std::equal(one.steps.begin(), one.steps.end(), other.steps.begin(), other.steps.end(), same_step);
}

// The border that a line makes, if it makes one. Checking an element asks for it five times in a row, so the
// last one of each thread is kept.
const std::optional<Border>& border_without_loops(const Subpath& line) {
    struct Last {
        Subpath line;
        std::optional<Border> border;
    };
    thread_local Last last;
    if (!last.border || !same(last.line, line)) {
        last.border.reset();
        last.line = line;
        std::optional<Border> border = border_of_line(line);
        if (border && !without_loops(*border).hopeless && border->edges.size() >= 3)
            last.border = std::move(border);
    }
    return last.border;
}

Border to_site(const Element& e, const Border& border) {
    return mapped(border, [&](Vec2 p) {
        const SitePoint at = e.site.from_page(Side::left, p);
        return Vec2{at.s, at.w};
    });
}

SideFolds given_folds(const Element& e) {
    SideFolds given;
    for (const auto& [name, value] : {std::pair{"top", &given.left}, std::pair{"bottom", &given.right}}) {
        const Argument* argument = find_argument(*e.info, e.arguments, name);
        if (argument != nullptr) *value = std::get<double>(argument->value);
    }
    return given;
}

// How far the footprint leaves the paper on that side, in words.
std::string way_off(const Element& e, Side side, const Ring& footprint) {
    const std::vector<Polygon> paper = e.paper->paper(side, 0.0, bounds(footprint));
    double most = 0.0;
    for (const Vec2 p : footprint) {
        double off = HUGE_VAL;
        for (const Polygon& part : paper) {
            if (contains(part, p)) {
                off = 0.0;
                break;
            }
            for (const Segment& edge : edges_of(part)) off = std::min(off, distance(p, edge));
        }
        if (std::isfinite(off)) most = std::max(most, off);
    }
    const std::string_view name = side == Side::left ? "left" : "right";
    if (most > e.tolerances->rounding_mm)
        return fmt::format("it leaves the paper on the {} of its fold by {}", name, mm(most));
    return fmt::format(
        "on the {} of its fold it comes nearer than {} to an edge of the paper, a cut or a seam", name,
        mm(e.tolerances->paper_mm));
}

}  // namespace

std::optional<Path> drawn_path(const Element& e) {
    if (const DrawnPath* outline = outline_of(e)) return outline->path;
    const auto number = find_parameter(*e.info, "touchpoints");
    if (!number) return std::nullopt;
    const auto* points = std::get_if<std::vector<DesignPoint>>(&e.arguments[*number].value);
    if (points == nullptr) return std::nullopt;
    Ring at;
    for (const DesignPoint& point : *points) at.push_back(point.at);
    return catmull_rom(at);
}

std::optional<Border> border_of_line(const Subpath& line) {
    Border border;
    if (border_of(line, border) != FlatteningFault::none || border.edges.size() > kMostEdges)
        return std::nullopt;
    return border;
}

std::optional<Border> drawn_border(const Element& e) {
    const auto path = drawn_path(e);
    if (!path || path->subpaths().size() != 1) return std::nullopt;
    return border_of_line(path->subpaths().front());
}

std::optional<Border> site_border(const Element& e) {
    const auto path = drawn_path(e);
    if (!path || path->subpaths().size() != 1) return std::nullopt;
    const std::optional<Border>& border = border_without_loops(path->subpaths().front());
    if (!border) return std::nullopt;
    return to_site(e, *border);
}

bool constrain_border(Element& e, std::optional<Border> (*border_of_drawn)(const Element&)) {
    const auto path = drawn_path(e);
    if (!path) {
        e.failed("no-outline", fmt::format("this {} has no outline", e.info->name),
                 "draw its border: outline, with path data, or at least three touchpoints");
        return false;
    }
    if (path->subpaths().size() != 1) {
        e.failed(
            "outline-crosses",
            fmt::format("its outline is drawn as {} lines; it is one that closes", path->subpaths().size()),
            "draw one line; holes are structures of the type hole, after it");
        return false;
    }
    auto border = border_of_drawn(e);
    if (!border) {
        e.failed("outline-crosses",
                 fmt::format("its outline makes more than {} chords, too many to look at", kMostEdges),
                 "draw it with fewer points");
        return false;
    }
    const std::size_t edges = border->edges.size();
    const LoopRepair loops = without_loops(*border);
    const double left = std::abs(signed_area(ring_of(*border)));
    if (loops.hopeless || border->edges.size() < 3 || left < kLeastPaperMm2) {
        const bool crosses = !loops.dropped.empty();
        e.failed("outline-crosses",
                 loops.hopeless
                     ? fmt::format("its outline crosses itself at {} and in more than {} places",
                                   at_mm(loops.dropped.front().at), loops.dropped.size() - 1)
                     : fmt::format("its outline encloses {:.2f} mm²{}, and {:.0f} mm² are the least", left,
                                   crosses ? " without its loops" : "", kLeastPaperMm2),
                 loops.hopeless || crosses ? "draw a line that goes round once and nowhere meets itself"
                                           : "draw it larger");
        return false;
    }
    if (tell_loops(e, "its outline", loops.dropped, edges, left)) write_path(e, "outline", path_of(*border));
    if (const auto tight = tightest(*border); tight && tight->radius_mm < kLeastRadiusMm) {
        e.remarked(
            "curve-too-tight",
            fmt::format("its outline turns with a radius of {:.3f} mm at {}; a knife cannot follow below "
                        "{:.1f} mm",
                        tight->radius_mm, at_mm(tight->at), kLeastRadiusMm),
            "draw a corner there, or a wider curve");
    }
    return true;
}

bool constrain_room(Element& e, const SlitShape& slit) {
    const double paper = e.tolerances->paper_mm - e.tolerances->rounding_mm;
    const auto [lo, hi] = slit.span;
    const double over = std::max(e.alive_lo + paper - lo, hi - (e.alive_hi - paper));
    if (over > 0.0) {
        e.failed(
            "does-not-fit",
            fmt::format("it reaches {} over the end of what is left of its fold, with {} of paper around "
                        "it",
                        mm(over), mm(e.tolerances->paper_mm)),
            "move it along the fold, or draw it narrower where it crosses it");
        return false;
    }
    for (const auto& [side, footprint] :
         {std::pair{Side::left, &slit.gone_left}, {Side::right, &slit.gone_right}}) {
        if (e.paper->may_cut(side, *footprint, Fit::as_drawn)) continue;
        e.failed("does-not-fit", way_off(e, side, *footprint),
                 "draw it smaller, or move it; nothing may be cut off that holds something else");
        return false;
    }
    return true;
}

FoldLines no_fold_lines() {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    const Segment none{{kNone, kNone}, {kNone, kNone}};
    return FoldLines(kThreeFolds.size(), FoldLine{none, none, 0});
}

namespace sheet {

std::pair<double, double> span(const Element& e) {
    const auto border = site_border(e);
    if (!border) return {0.0, e.site.length};
    const auto stretches = on_fold(*border);
    if (stretches.size() == 1) return stretches.front();
    Box box;
    for (const BorderEdge& edge : border->edges) box.extend(edge.from);
    return {box.min.x, box.max.x};
}

std::vector<double> crossings(const Element& e) {
    std::vector<double> made;
    const auto border = site_border(e);
    if (!border) return made;
    for (const auto& [from, to] : on_fold(*border)) made.insert(made.end(), {from, to});
    return made;
}

bool constrain(Element& e) {
    if (!constrain_border(e)) return false;
    const auto border = site_border(e);
    POPUP_INVARIANT(border);
    CutShape shape;
    if (const auto fault = shape_of(e, *border, given_folds(e), shape)) {
        e.failed(fault->code, fault->what, fault->hint);
        return false;
    }
    return constrain_room(e, shape.slit);
}

FoldLines fold_lines(const Element& e) {
    const auto border = site_border(e);
    CutShape shape;
    if (!border || shape_of(e, *border, given_folds(e), shape)) return no_fold_lines();
    return shape.folds;
}

void lower(const Element& e, Builder& builder) {
    const auto border = site_border(e);
    CutShape shape;
    POPUP_INVARIANT(border && !shape_of(e, *border, given_folds(e), shape));
    builder.add_curves(shape.curves);
    lower_slit(e, builder, shape.folds, std::move(shape.slit));
}

namespace {

// Upwards along the fold, at the fold's begin.
measure::Spot fold_spot(const Element& e) { return {e.site.left.at, measure::turn_of(e.site.left.dir)}; }

Box box_on_fold(const Element& e) {
    Box box;
    for (const std::string_view name : {"outline", "touchpoints"}) {
        const Box one = measure::drawn_box(e, name, fold_spot(e));
        if (one.empty()) continue;
        box.extend(one.min);
        box.extend(one.max);
    }
    return box;
}

}  // namespace

std::vector<double> measured(const Element& e) {
    const Box box = box_on_fold(e);
    if (box.empty()) return {0.0, 0.0, 0.0, 0.0, 0.0};
    return {measure::from_middle(e, box.centre().y), box.height(), box.width(), box.centre().x, 0.0};
}

void shape(Element& e, std::span<const double> v, std::span<const Vec2> fresh) {
    const measure::Spot fold = fold_spot(e);
    const Box box = box_on_fold(e);
    const measure::Spot to{fold.place(v[3], measure::along(e, v[0])), fold.turn};
    if (!box.empty()) {
        return measure::place_drawn(e, fold, box, to,
                                    measure::scale_of(box.width(), box.height(), v[2], v[1]), v[4]);
    }
    const auto outline = find_parameter(*e.info, "outline");
    POPUP_INVARIANT(outline);
    Ring at;
    for (const Vec2 p : fresh) at.push_back({p.x * v[2], p.y * v[1]});
    e.arguments[*outline] = at.empty() ? measure::ellipse(to, v[2], v[1]) : measure::corners(to, at);
}

}  // namespace sheet

}  // namespace popup
