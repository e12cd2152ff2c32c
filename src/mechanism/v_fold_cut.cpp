// The v-fold cut: a beak whose cut is drawn (Foldlings), such as a bird's body with its wings, or a leaf.
//
// A is the apex on the fold. The outline is the cut from one side of the fold to the other; its ends are
// joined to A. Or it is the whole border, and A lies on it. Where the border leaves A in a straight line,
// that is the side fold; where it is curved the side fold runs as far out as there are kLeastEdgeMm of it.
// The centre fold is the beak's, and what of a wavy shape hangs on no fold stays level with what it hangs on,
// as of a freeform.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "mechanism/angled.h"
#include "mechanism/measures.h"
#include "mechanism/rows.h"
#include "mechanism/sheet_parts.h"
#include "mechanism/sheet_rows.h"
#include "mechanism/site_lines.h"

namespace popup {
namespace {

enum { A };  // of `on`

constexpr std::array<PointInfo, 1> kPoints{{{"A", PointPage::fold, '-'}}};
constexpr std::array<int, 1> kPartners{0};
constexpr std::array<ParameterInfo, 5> kParameters{
    {kHalfColours[0], kHalfColours[1], kHalfColours[2], kHalfColours[3], kSheetOutline}};

// An outline that passes A by no more goes through it.
constexpr double kSnapMm = 0.5;
// A centre fold this near to the fold lies in it.
constexpr double kEvenRad = 1e-9;

// With A as a corner: where the border passes it, or between the ends of an open line. nullopt: it passes A
// further away.
std::optional<Border> border_through(const Element& e) {
    auto drawn = drawn_path(e);
    if (!drawn || drawn->subpaths().size() != 1) return std::nullopt;
    Subpath line = drawn->subpaths().front();
    const Vec2 apex = e.site.on_page(Side::left, {e.on[A].s, 0.0});
    const bool open =
        !line.closed && !line.steps.empty() && distance(line.start, line.steps.back().to) > kSnapMm;
    if (open) {
        line.steps.insert(line.steps.begin(), PathStep{line.start, false, {}, {}});
        line.start = apex;
        line.steps.push_back({apex, false, {}, {}});
    }
    line.closed = true;
    auto border = border_of_line(line);
    if (!border) return std::nullopt;
    std::size_t nearest = 0;
    for (std::size_t i = 0; i < border->edges.size(); ++i) {
        if (distance(border->edges[i].from, apex) < distance(border->edges[nearest].from, apex)) nearest = i;
    }
    if (border->edges.empty() || distance(border->edges[nearest].from, apex) > kSnapMm) return std::nullopt;
    border->edges[nearest].from = apex;
    return border;
}

std::optional<Border> site_border_through(const Element& e) {
    auto border = border_through(e);
    if (!border || without_loops(*border).hopeless || border->edges.size() < 3) return std::nullopt;
    return mapped(*border, [&](Vec2 p) {
        const SitePoint at = e.site.from_page(Side::left, p);
        return Vec2{at.s, at.w};
    });
}

// Seen from the apex along the fold with one side of it above: x from the apex, y from the fold.
struct View {
    double apex = 0.0;
    double along = 1.0, aside = 1.0;  // 1 or -1
    [[nodiscard]] Vec2 there(Vec2 p) const { return {along * (p.x - apex), aside * p.y}; }
    [[nodiscard]] Vec2 back(Vec2 p) const { return {apex + along * p.x, aside * p.y}; }
    template <typename Way>
    [[nodiscard]] Border turned(const Border& border, const Way& way) const {
        Border made = mapped(border, way);
        if (along * aside < 0.0) reverse(made);
        begin_at_drive(made);
        return made;
    }
    [[nodiscard]] Border there(const Border& border) const {
        return turned(border, [this](Vec2 p) { return there(p); });
    }
    [[nodiscard]] Border back(const Border& border) const {
        Border made = mapped(border, [this](Vec2 p) { return back(p); });
        if (along * aside < 0.0) reverse(made);
        return made;
    }
};

// How far the border opens from the fold near the apex; begun with its edge along the fold, from the apex.
double opening(const Border& border) {
    double least = std::numbers::pi;
    for (std::size_t i = border.edges.size() - 1; i > 0; --i) {
        const Vec2 p = border.edges[i].from;
        const Vec2 before = border.edges[(i + 1) % border.edges.size()].from;
        const double reach = length(p);
        if (reach <= kLeastEdgeMm) {
            least = std::min(least, std::atan2(p.y, p.x));
            continue;
        }
        // Where it leaves the circle that the shortest side fold reaches.
        double lo = 0.0;
        double hi = 1.0;
        for (int halving = 0; halving < 50; ++halving) {
            const double middle = 0.5 * (lo + hi);
            (length(lerp(before, p, middle)) > kLeastEdgeMm ? hi : lo) = middle;
        }
        const Vec2 at = lerp(before, p, hi);
        return std::min(least, std::atan2(at.y, at.x));
    }
    return least;
}

// What the side fold leaves of one side.
std::optional<SheetFault> truncate(const Element& e, Border& side, double& angle, std::string_view name) {
    angle = opening(side);
    const double least = e.tolerances->min_angle_deg * kDegree;
    if (angle < least) {
        return SheetFault{"degenerate",
                          fmt::format("on the {} its outline leaves the fold at {}; {} are the least", name,
                                      degrees(angle), degrees(least)),
                          "draw it further away from the fold near A"};
    }
    const DirectedLine line{{0.0, 0.0}, {std::cos(angle), std::sin(angle)}};
    side = part_with_drive(divide(side, line, EdgeOf::side));
    const Vec2 start = side.edges.front().from;
    if (put_stretches(side, line) && start == Vec2{} && side.edges.back().of == EdgeOf::side)
        return std::nullopt;
    return SheetFault{"degenerate",
                      fmt::format("on the {} its side fold is not {} long", name, mm(kLeastEdgeMm)),
                      "draw it wider near A"};
}

std::optional<SheetFault> shape_of(const Element& e, const Border& border, CutShape& into) {
    const Division halves = divide(border, level_line(0.0), EdgeOf::drive);
    if (halves.chords.size() != 1) return crosses_otherwise(halves.chords.size());
    const auto [lo, hi] = std::pair(halves.chords[0].from, halves.chords[0].to);
    const double apex = e.on[A].s;
    const double off = std::min(std::abs(lo - apex), std::abs(hi - apex));
    if (off > e.tolerances->rounding_mm) {
        return SheetFault{"outline-off-fold",
                          fmt::format("its outline crosses the fold {} from A, and must end there", mm(off)),
                          "draw the border through A, or as a line from one side of the fold to the other"};
    }
    const bool onwards = std::abs(lo - apex) <= std::abs(hi - apex);
    View view{onwards ? lo : hi, onwards ? 1.0 : -1.0, 1.0};
    View mirrored = view;
    mirrored.aside = -1.0;
    Border upper = view.there(halves.part(halves.chords[0].above));
    Border lower = mirrored.there(halves.part(halves.chords[0].below));
    double a = 0.0;
    double b = 0.0;
    if (auto fault = truncate(e, upper, a, "left")) return fault;
    if (auto fault = truncate(e, lower, b, "right")) return fault;
    if (a + b > kWidestSlit * kDegree) {
        return SheetFault{"opening-too-wide",
                          fmt::format("its sides open by {}; the widest is {}", degrees(a + b),
                                      degrees(kWidestSlit * kDegree)),
                          "draw it narrower near A"};
    }
    // The beak's: it leaves the left side fold at the angle of the right one. What is taken from the page has
    // the corners of the plates.
    const double centre = a - b;
    const auto centre_line = [&](double angle) {
        return DirectedLine{{0.0, 0.0}, {std::cos(angle), std::sin(angle)}};
    };
    if (std::abs(centre) > kEvenRad) {
        upper = with_corners_on(upper, centre_line(centre));
        lower = with_corners_on(lower, centre_line(-centre));
    }
    SheetParts parts;
    parts.upper = view.back(upper);
    parts.lower = mirrored.back(lower);
    begin_at_drive(parts.upper);
    begin_at_drive(parts.lower);
    parts.span = {lo, hi};
    parts.far_left = centre >= 0.0;
    const View& wide_view = parts.far_left ? view : mirrored;
    if (std::abs(centre) <= kEvenRad) {
        parts.plates = {parts.upper, parts.lower};
        for (Border& plate : parts.plates) fold_in_the_middle(plate);
    } else {
        Border narrow = wide_view.there(parts.far_left ? parts.lower : parts.upper);
        auto panels = panels_of(parts.far_left ? upper : lower, narrow, centre_line(std::abs(centre)));
        if (!panels) return not_divided();
        std::vector<Border> plates{panels->far.front(), panels->near};
        if (!parts.far_left) std::swap(plates[0], plates[1]);
        plates.insert(plates.end(), panels->far.begin() + 1, panels->far.end());
        for (const Border& plate : plates) parts.plates.push_back(wide_view.back(plate));
    }
    // Folds run along the fold that they stand on: away from the apex, or towards it.
    const Vec2 at{view.apex, 0.0};
    const auto along = [&](const Segment& s) { return (distance(s.a, at) <= distance(s.b, at)) == onwards; };
    if (auto fault = finish(e, parts, along, into)) return fault;
    SlitShape& slit = into.slit;
    const Vec2 own = e.site.on_page(Side::left, {view.apex, 0.0});
    const auto tip = [&](std::size_t fold) {
        const Segment& line = into.folds[fold].on_left;
        return onwards ? line.b : line.a;
    };
    const int dir = onwards ? 1 : -1;
    slit.left_bar =
        angled_bar(e.site, Side::left, view.apex, dir, e.site.from_page(Side::left, tip(kLeftFold)), own,
                   tip(kLeftFold), tip(kCentreFold));
    slit.right_bar =
        angled_bar(e.site, Side::right, view.apex, dir, e.site.from_page(Side::right, tip(kRightFold)), own,
                   tip(kRightFold), tip(kCentreFold));
    return std::nullopt;
}

std::pair<double, double> span(const Element& e) {
    const auto border = site_border_through(e);
    if (!border) return {e.on[A].s, e.on[A].s};
    const auto stretches = on_fold(*border);
    if (stretches.size() == 1) return stretches.front();
    return {e.on[A].s, e.on[A].s};
}

std::vector<double> crossings(const Element& e) {
    std::vector<double> made;
    // A lies on the fold that is meant.
    if (std::abs(e.on[A].w) > e.tolerances->snap_mm) return made;
    auto border = site_border_through(e);
    if (!border) border = site_border(e);
    if (!border) return made;
    for (const auto& [from, to] : on_fold(*border)) made.insert(made.end(), {from, to});
    return made;
}

bool constrain(Element& e) {
    if (!put_apex_on_fold(e, A, "A")) return false;
    if (!border_through(e)) {
        e.failed("outline-off-fold", "its outline does not go through A",
                 "draw the border through A, or as a line from one side of the fold to the other");
        return false;
    }
    if (!constrain_border(e, border_through)) return false;
    const auto border = site_border_through(e);
    POPUP_INVARIANT(border);
    CutShape shape;
    if (const auto fault = shape_of(e, *border, shape)) {
        e.failed(fault->code, fault->what, fault->hint);
        return false;
    }
    return constrain_room(e, shape.slit);
}

FoldLines fold_lines(const Element& e) {
    const auto border = site_border_through(e);
    CutShape shape;
    if (!border || shape_of(e, *border, shape)) return no_fold_lines();
    return shape.folds;
}

void lower(const Element& e, Builder& builder) {
    const auto border = site_border_through(e);
    CutShape shape;
    POPUP_INVARIANT(border && !shape_of(e, *border, shape));
    builder.add_curves(shape.curves);
    lower_slit(e, builder, shape.folds, std::move(shape.slit));
}

constexpr std::array<MeasureInfo, 4> kMeasures{
    {measure::kApexAt, measure::kLength, measure::kWidth, measure::kTurnBy}};

measure::Spot apex_spot(const Element& e) {
    return {e.site.on_page(Side::left, {e.on[A].s, 0.0}), measure::turn_of(e.site.left.dir)};
}

std::vector<double> measured(const Element& e) {
    const Box box = measure::drawn_box(e, "outline", apex_spot(e));
    return {measure::from_middle(e, e.on[A].s), box.height(), box.width(), 0.0};
}

void shape(Element& e, std::span<const double> v) {
    const measure::Spot from = apex_spot(e);
    const Box box = measure::drawn_box(e, "outline", from);
    e.on[A] = {measure::along(e, v[0]), 0.0};
    measure::Spot to = apex_spot(e);
    const auto outline = find_parameter(*e.info, "outline");
    POPUP_INVARIANT(outline);
    if (!e.arguments[*outline].given()) {
        // Two wings, the apex behind them.
        const std::array<Vec2, 6> wings{{{0.0, 0.0},
                                         {-0.5 * v[2], 0.6 * v[1]},
                                         {-0.4 * v[2], v[1]},
                                         {0.0, 0.7 * v[1]},
                                         {0.4 * v[2], v[1]},
                                         {0.5 * v[2], 0.6 * v[1]}}};
        e.arguments[*outline] = measure::corners(to, wings);
        return;
    }
    const measure::Scale scale = measure::scale_of(box.width(), box.height(), v[2], v[1]);
    to.turn += v[3];
    measure::move_drawn(e, PointPage::fold, measure::moved_to(from, to, scale.aside, scale.along));
}

}  // namespace

const ElementRow kVFoldCut = {
    {.name = "v-fold-cut",
     .code = -1,
     .family = "v-fold-cut",
     .inverted = false,
     .glued = false,
     .about = "a beak whose cut is drawn, such as a bird or a leaf, cut from one sheet",
     .points = kPoints,
     .partners = kPartners,
     .grounds = kFoundFold,
     .parameters = kParameters,
     .since = "3.0",
     .measures = kMeasures},
    span,
    constrain,
    fold_lines,
    nullptr,
    lower,
    crossings,
    measured,
    shape};

}  // namespace popup
