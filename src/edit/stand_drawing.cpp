// Feet of a drawing, and what becomes of it on the seams of a piece.
#include "edit/stand_drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

#include "edit/drawn_feet.h"
#include "popup/diagnostics.h"

namespace popup::edit {
namespace {

// The outline with the chains in place of its feet. What begins or ends as near to the end of a seam as makes
// it that end, lies there: the check would move it, and speak of it as of something that the author drew.
Subpath joined(const DrawnOutline& outline, std::span<const Foot> feet, std::span<const GlueChain> chains) {
    Subpath made;
    made.start = chains.front().points.front();
    made.closed = true;
    Vec2 last = made.start;
    const auto line_to = [&](Vec2 p) {
        if (distance(p, last) <= 1e-9) return;
        made.steps.push_back({p, false, {}, {}});
        last = p;
    };
    const auto is_meant = [](Vec2 p, Vec2 end) { return distance(p, end) <= kMeantMm; };
    const auto lies_at = [&](const DrawnStep& step, Vec2 end) {
        return is_meant(step.line.from, end) && is_meant(step.line.to, end) &&
               (!step.curve || (is_meant(step.line.control_1, end) && is_meant(step.line.control_2, end)));
    };
    for (std::size_t k = 0; k < feet.size(); ++k) {
        for (const Vec2 p : chains[k].points) line_to(p);
        const Foot& next = feet[(k + 1) % feet.size()];
        const Vec2 next_point = chains[(k + 1) % feet.size()].points.front();
        const DrawnOutline rest = between(outline, feet[k].end, next.begin);
        std::size_t first = 0;
        std::size_t end = rest.size();
        while (first < end && lies_at(rest[first], last)) ++first;
        while (end > first && lies_at(rest[end - 1], next_point)) --end;
        if (first == end) continue;
        if (!is_meant(rest[first].line.from, last)) line_to(rest[first].line.from);
        for (std::size_t i = first; i < end; ++i) {
            const Vec2 from = rest[i].line.from;
            const bool ends = i + 1 == end && is_meant(rest[i].line.to, next_point);
            const Vec2 to = ends ? next_point : rest[i].line.to;
            if (!rest[i].curve) {
                line_to(to);
                continue;
            }
            made.steps.push_back({to, true, rest[i].line.control_1 + (last - from),
                                  rest[i].line.control_2 + (to - rest[i].line.to)});
            last = to;
        }
    }
    line_to(made.start);
    return made;
}

// A drawing as one outline with holes.
struct Shape {
    DrawnOutline outline;
    std::vector<Subpath> holes;
};

StoodDrawing refused(std::string what, std::string hint) {
    StoodDrawing made;
    made.refusal = {std::move(what), std::move(hint)};
    return made;
}

// Points that are no further from a line belong to it.
constexpr double kStraightLineMm = 0.05;

constexpr std::string_view kUnite = "unite its shapes into one, in Inkscape by Path, Union";

// Why it is none, or nothing.
std::optional<StoodDrawing> take_apart(const Path& drawn, Shape& shape) {
    Enclosed inside;
    if (enclose(drawn, inside) != FlatteningFault::none || inside.areas.empty())
        return refused("encloses nothing", "draw a closed line that has an area");
    if (inside.areas.size() != 1) {
        return refused(fmt::format("has {} areas that do not hang together", inside.areas.size()),
                       std::string(kUnite) + "; or draw one of them alone");
    }
    double largest = 0.0;
    std::size_t outer = 0;
    const std::vector<Subpath>& lines = drawn.subpaths();
    for (std::size_t i = 0; i < lines.size(); ++i) {
        DrawnOutline outline = outline_of(lines[i]);
        const double area = area_of(outline);
        if (std::abs(area) <= largest) continue;
        largest = std::abs(area);
        outer = i;
        shape.outline = area > 0.0 ? std::move(outline) : reversed(outline);
    }
    const double enclosed = std::abs(signed_area(inside.areas.front().outer));
    if (std::abs(enclosed - largest) > 0.01 * largest)
        return refused("has lines that cross each other", std::string(kUnite));
    for (std::size_t i = 0; i < lines.size(); ++i) {
        if (i != outer) shape.holes.push_back(lines[i]);
    }
    return std::nullopt;
}

double scale_of(DrawingFit fit, const Box& box, const Box& place) {
    switch (fit) {
        case DrawingFit::width:
            return box.width() > 0.0 ? place.width() / box.width() : 1.0;
        case DrawingFit::height:
            return box.height() > 0.0 ? place.height() / box.height() : 1.0;
        case DrawingFit::seams:
        case DrawingFit::both:
        case DrawingFit::none:
            return 1.0;
    }
    return 1.0;
}

// The drawing where it is to be, with its feet.
struct Stood {
    Shape shape;
    std::vector<Foot> feet;
    std::vector<double>
        lost;  // of each foot: how far it goes below its chain, or below itself where it is round
    bool round = false;
};

Stood moved(const Shape& shape, std::vector<Foot> feet, const PlaneMap& map) {
    Stood made;
    made.shape.outline = mapped(shape.outline, map);
    for (const Subpath& hole : shape.holes) {
        Subpath& there = made.shape.holes.emplace_back(hole);
        there.start = map(there.start);
        for (PathStep& step : there.steps)
            step = {map(step.to), step.curve, map(step.control_1), map(step.control_2)};
    }
    for (Foot& foot : feet) {
        foot.begin.at = map(foot.begin.at);
        foot.end.at = map(foot.end.at);
    }
    made.feet = std::move(feet);
    return made;
}

std::string mm_text(double mm) { return fmt::format("{:.1f} mm", mm); }

// The drawing, with a foot of it turned onto the chain.
Stood stood_on(const Shape& shape, const Foot& foot, const GlueChain& chain, DrawingFit fit, const Box& box,
               const Box& place) {
    const Vec2 begin = chain.points.front();
    const Vec2 end = chain.points.back();
    if (fit == DrawingFit::both) {
        PlaneMap map;
        map.x.x = place.width() / box.width();
        map.y.y = place.height() / box.height();
        Stood stretched = moved(shape, {foot}, map);
        const Foot& on = stretched.feet.front();
        return moved(stretched.shape, {on}, onto(on.begin.at, on.end.at, begin, end, 1.0));
    }
    const double scale = fit == DrawingFit::seams
                             ? distance(begin, end) / distance(foot.begin.at, foot.end.at)
                             : scale_of(fit, box, place);
    return moved(shape, {foot}, onto(foot.begin.at, foot.end.at, begin, end, scale));
}

std::optional<StoodDrawing> on_one(const Shape& shape, const GlueChain& chain, DrawingFit fit,
                                   const Box& place, Stood& made) {
    const Box box = box_of(shape.outline);
    // About how large it will be.
    const double scale = fit == DrawingFit::seams
                             ? distance(chain.points.front(), chain.points.back()) / box.width()
                             : scale_of(fit, box, place);
    auto foot = corner_of(shape.outline, box, chain.points, kStraightLineMm / scale);
    if (!foot) {
        // An edge of a large drawing may be a round end: what of it is not straight would be lost.
        double within = kEdgeShare * box.height();
        for (int attempt = 0; attempt < 3; ++attempt) {
            foot = base_of(shape.outline, box, within);
            if (!foot) break;
            made = stood_on(shape, *foot, chain, fit, box, place);
            const auto [above, below] = strays(made.shape.outline, made.feet.front());
            if (below <= kMeantMm || above > kMeantMm) break;
            within *= 0.9 * kMeantMm / below;
            foot.reset();
        }
    }
    const bool round = !foot;
    if (!foot) foot = cut_of(shape.outline, box);
    if (!foot) {
        return refused(
            fmt::format("has nothing to stand on: its lower quarter is nowhere half as wide as it is, {}",
                        mm_text(box.width())),
            "draw a straight edge along its lower end; " + chain.name + " will be glued there");
    }
    made = stood_on(shape, *foot, chain, fit, box, place);
    const Foot& stands = made.feet.front();
    const auto [above, below] = strays(made.shape.outline, stands);
    if (above > kMeantMm) {
        return refused(
            fmt::format("is open at its lower end: between its feet it rises {} above them, and {} must be "
                        "glued from end to end",
                        mm_text(above), chain.name),
            "draw a line across between the feet, so that the gap becomes a hole with a strip of paper "
            "below");
    }
    made.round = round;
    made.lost.push_back(round ? below : lost_beyond(made.shape.outline, stands, chain.points));
    return std::nullopt;
}

// From below to above.
struct Stretch {
    double low = 0.0, high = 0.0;
};

// How many times as high edges must be at least, so that both reach over their seams.
double least_height(std::span<const Stretch, 2> edges, std::span<const Stretch, 2> seams) {
    double made = 0.0;
    for (std::size_t j = 0; j < 2; ++j) {
        for (std::size_t k = 0; k < 2; ++k) {
            const double drawn = edges[j].high - edges[k].low;
            if (drawn > 0.0) made = std::max(made, (seams[j].high - seams[k].low) / drawn);
        }
    }
    return made;
}

std::optional<StoodDrawing> on_two(const Shape& shape, std::span<const GlueChain> chains, DrawingFit fit,
                                   const Box& place, Stood& made) {
    const Box box = box_of(shape.outline);
    const double within =
        std::min(kEdgeShare * box.width(),
                 0.9 * kMeantMm * box.width() / distance(chains[0].points.front(), chains[1].points.front()));
    const auto left = left_edge(shape.outline, within);
    const auto right = right_edge(shape.outline, within);
    for (const auto& [edge, chain, side] :
         {std::tuple(&left, &chains[0], "left"), std::tuple(&right, &chains[1], "right")}) {
        if (*edge) continue;
        return refused(fmt::format("has no straight edge on its {}, where {} is glued", side, chain->name),
                       fmt::format("draw it with an upright straight edge at its {} end, and at the other "
                                   "one too",
                                   side));
    }
    // Upwards on the page of the piece is along its seams.
    const Vec2 along = unit(unit(chains[1].points.back() - chains[1].points.front()) +
                            unit(chains[0].points.front() - chains[0].points.back()));
    const Vec2 across = right_of(along);
    const std::array<Stretch, 2> edges{
        {{left->end.at.y, left->begin.at.y}, {right->begin.at.y, right->end.at.y}}};
    std::array<Stretch, 2> seams;
    for (std::size_t k = 0; k < 2; ++k) {
        const double one = dot(along, chains[k].points.front());
        const double other = dot(along, chains[k].points.back());
        seams[k] = {std::min(one, other), std::max(one, other)};
    }
    const double from = left->begin.at.x;
    const double wide = dot(across, chains[1].points.front() - chains[0].points.front());
    const double drawn_wide = right->begin.at.x - from;
    const double scale = wide / drawn_wide;
    if (fit == DrawingFit::height || fit == DrawingFit::none) {
        const double wanted = fit == DrawingFit::none ? 1.0 : scale_of(fit, box, place);
        if (std::abs(wanted - scale) * drawn_wide > kMeantMm) {
            return refused(
                fmt::format("would be {} wide from edge to edge, and {} and {} are {} apart",
                            mm_text(wanted * drawn_wide), chains[0].name, chains[1].name, mm_text(wide)),
                "leave --fit out, or write --fit both");
        }
    }
    const double high = fit == DrawingFit::both ? least_height(edges, seams) : scale;
    // How far up it can go so that both edges reach over their seams.
    const double least = std::max(seams[0].high - high * edges[0].high, seams[1].high - high * edges[1].high);
    const double most = std::min(seams[0].low - high * edges[0].low, seams[1].low - high * edges[1].low);
    if (least - most > 2.0 * kMeantMm) {
        const std::size_t k = edges[0].high - edges[0].low < edges[1].high - edges[1].low ? 0 : 1;
        return refused(
            fmt::format("is too low: its {} edge becomes {} long, and {} is {}", k == 0 ? "left" : "right",
                        mm_text(high * (edges[k].high - edges[k].low)), chains[k].name,
                        mm_text(seams[k].high - seams[k].low)),
            "draw both edges longer, or make the element shorter; --fit both stretches the drawing");
    }
    PlaneMap map;
    map.x = scale * across;
    map.y = high * along;
    map.origin = dot(across, chains[0].points.front()) * across + 0.5 * (least + most) * along - from * map.x;
    made = moved(shape, {*left, *right}, map);
    for (std::size_t k = 0; k < 2; ++k) {
        const Foot& foot = made.feet[k];
        if (const double gap = strays(made.shape.outline, foot).first; gap > kMeantMm) {
            return refused(fmt::format("has a gap of {} in its {} edge, and {} must be glued from end to end",
                                       mm_text(gap), k == 0 ? "left" : "right", chains[k].name),
                           "draw that edge straight, without a gap");
        }
        made.lost.push_back(lost_beyond(made.shape.outline, foot, chains[k].points));
    }
    return std::nullopt;
}

}  // namespace

std::vector<GlueChain> glue_chains(std::string_view id, const ElementInfo& info,
                                   std::span<const PageFold> folds) {
    std::vector<GlueChain> made;
    for (std::size_t i = 0; i < folds.size(); ++i) {
        if (!folds[i].seam) continue;
        const bool on_right = info.folds[i].on_right == PointPage::extra;
        const Segment& line = on_right ? folds[i].on_right : folds[i].on_left;
        const Vec2 from = on_right ? line.b : line.a;
        const Vec2 to = on_right ? line.a : line.b;
        const std::string name = fmt::format("{}.{}", id, info.folds[i].name);
        if (!made.empty() && distance(made.back().points.back(), from) <= 1e-6) {
            made.back().points.push_back(to);
            made.back().name += " and " + name;
        } else {
            made.push_back({{from, to}, name});
        }
    }
    return made;
}

StoodDrawing stand_drawing(const Path& drawn, std::span<const GlueChain> chains, DrawingFit fit,
                           const Box& place) {
    POPUP_INVARIANT(chains.size() == 1 || chains.size() == 2);
    Shape shape;
    if (auto refusal = take_apart(drawn, shape)) return *refusal;
    Stood stood;
    auto refusal = chains.size() == 1 ? on_one(shape, chains.front(), fit, place, stood)
                                      : on_two(shape, chains, fit, place, stood);
    if (refusal) return *refusal;
    StoodDrawing made;
    for (std::size_t k = 0; k < stood.feet.size(); ++k)
        made.cuts.push_back(
            {stood.lost[k], stood.round, stood.feet[k].begin.at, stood.feet[k].end.at, chains[k].name});
    const auto append = [&](const Subpath& line) {
        made.path.move(line.start);
        for (const PathStep& step : line.steps) {
            if (step.curve) {
                made.path.cubic(step.control_1, step.control_2, step.to);
            } else {
                made.path.line(step.to);
            }
        }
        made.path.close();
    };
    append(joined(stood.shape.outline, stood.feet, chains));
    for (const Subpath& hole : stood.shape.holes) append(hole);
    Enclosed inside;
    if (enclose(made.path, inside) != FlatteningFault::none)
        return refused("becomes too large", "give another --fit");
    if (inside.areas.size() != 1 || inside.areas.front().holes.size() != stood.shape.holes.size()) {
        return refused(
            fmt::format(
                "does not become one area on {}: a hole of it, or a part that hangs down, lies across "
                "the seams",
                chains.front().name),
            "keep holes above the lower end, and parts at the sides above it too");
    }
    return made;
}

}  // namespace popup::edit
