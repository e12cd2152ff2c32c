// The disc: a piece that is turned by hand about a rivet in a plate, often behind a window (Glassner, section
// 9, names it).
//
// A is its middle and B its rivet, both on the plate's page. On its own page its middle is the origin, and
// the page lies as the plate's does. It stands still as the card opens; how it is turned then is anybody's
// guess, so it is examined at all its turns.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/geometry/regions.h"
#include "mechanism/drawn_lines.h"
#include "mechanism/measures.h"
#include "mechanism/rows.h"
#include "mechanism/site_lines.h"
#include "mechanism/thin_places.h"

namespace popup {
namespace {

enum { A, B };  // of `on`

constexpr std::array<PointInfo, 2> kPoints{{{"A", PointPage::fold, '-'}, {"B", PointPage::fold, '-'}}};
constexpr std::array<int, 2> kPartners{0, 1};
constexpr std::array<std::string_view, 1> kOtherNames{"wheel"};
constexpr std::array<std::string_view, 2> kSides{"front", "back"};
constexpr std::array<ParameterInfo, 6> kParameters{
    {{.name = "color", .about = "colour of the disc"},
     {.name = "outline",
      .kind = ParameterKind::path,
      .about = "shape of the disc, on its own page, about its middle at (0, 0); else a circle"},
     {.name = "radius",
      .kind = ParameterKind::length,
      .about = "radius of the disc, where it has no outline",
      .least = 5.0,
      .most = 1000.0,
      .standard = 25.0},
     {.name = "window",
      .kind = ParameterKind::path,
      .about = "window in the plate that shows the disc, on the plate's page",
      .page = PointPage::fold},
     {.name = "rivet",
      .kind = ParameterKind::length,
      .about = "diameter of the rivet's hole, in the disc and in the plate",
      .least = 0.5,
      .most = 20.0,
      .standard = 3.0},
     {.name = "side",
      .kind = ParameterKind::choice,
      .about = "side of the plate on which it turns; without it front, and back where there is a window",
      .words = kSides}}};

constexpr double kAroundMm = 1.0;  // paper round the rivet's hole, and round the window
// A circle, with the curves that its chords stand for.
Enclosed circle(Vec2 middle, double radius) {
    Path path;
    const Vec2 across{radius, 0.0};
    path.move(middle + across);
    path.arc(radius, radius, 0.0, false, true, middle - across);
    path.arc(radius, radius, 0.0, false, true, middle + across);
    path.close();
    Enclosed made;
    POPUP_INVARIANT(enclose(path, made) == FlatteningFault::none && made.areas.size() == 1);
    return made;
}

Vec2 on_plate(const Element& e, std::size_t point) { return e.site.on_page(Side::left, e.on[point]); }
// The rivet on the disc's own page.
Vec2 own_rivet(const Element& e) { return on_plate(e, B) - on_plate(e, A); }
double hole_radius(const Element& e) { return 0.5 * number_of(e, "rivet"); }

bool is_behind(const Element& e) {
    const Argument* given = find_argument(*e.info, e.arguments, "side");
    if (given == nullptr) return !areas_of(e, "window").empty();
    return choice_of(e, "side") == kSides[1];
}

// The disc without the rivet's hole.
Enclosed drawn(const Element& e) {
    const std::span<const Polygon> areas = areas_of(e, "outline");
    if (areas.empty()) return circle({0.0, 0.0}, number_of(e, "radius"));
    const std::span<const FlatCurve> curves = curves_of(e, "outline");
    Enclosed made;
    made.areas.assign(areas.begin(), areas.end());
    made.curves.assign(curves.begin(), curves.end());
    return made;
}

// Whether a ring with paper round it lies wholly on the paper.
bool lies_on(const Ring& ring, const std::vector<Polygon>& paper) {
    const std::vector<Polygon> wanted = offset({{ring, {}}}, kAroundMm, Corners::rounded);
    return area(subtract(wanted, paper)) < 1e-3;
}

// Whether the paper has room for a rivet's hole. No path leads as far out as this, and no plate does.
bool has_room(Vec2 rivet, double radius, const std::vector<Polygon>& paper) {
    constexpr double kFarMm = 50'000.0;
    if (!(std::abs(rivet.x) < kFarMm && std::abs(rivet.y) < kFarMm)) return false;
    return lies_on(circle(rivet, radius).areas.front().outer, paper);
}

// What is cut from the plate, and the paper round it.
Box cut_from(const Element& e) {
    const double around = hole_radius(e) + kAroundMm;
    Box box;
    box.extend(on_plate(e, B) - Vec2{around, around});
    box.extend(on_plate(e, B) + Vec2{around, around});
    for (const Polygon& part : areas_of(e, "window")) {
        for (const Vec2 p : part.outer) {
            box.extend(p - Vec2{kAroundMm, kAroundMm});
            box.extend(p + Vec2{kAroundMm, kAroundMm});
        }
    }
    return box;
}

bool constrain(Element& e) {
    if (!mend_outline(e) || !mend_holes(e, "window", "its window")) return false;
    const std::vector<Polygon> disc = drawn(e).areas;
    if (disc.size() != 1) {
        e.failed("outline-crosses",
                 fmt::format("its outline encloses {} areas that do not hang together", disc.size()),
                 "draw one area, with holes where it has any");
        return false;
    }
    if (!areas_of(e, "outline").empty()) tell_thin(e, disc.front());
    if (!has_room(own_rivet(e), hole_radius(e), disc)) {
        e.failed(
            "does-not-fit",
            fmt::format("its rivet at {} on its own page is not on the disc with {} of paper round its hole "
                        "of {}",
                        at_mm(own_rivet(e)), mm(kAroundMm), mm(number_of(e, "rivet"))),
            "move B towards A, or make the disc larger there");
        return false;
    }
    const std::span<const Polygon> window = areas_of(e, "window");
    std::vector<Polygon> paper = e.paper->paper(Side::left, 0.0, cut_from(e));
    for (const Polygon& part : window) {
        if (!part.holes.empty()) {
            e.failed("outline-crosses", "its window has an island, which would fall out",
                     "draw the window as one area, or as several beside one another");
            return false;
        }
        if (!lies_on(part.outer, paper)) {
            e.failed("does-not-fit",
                     fmt::format("its window is not on the plate with {} of paper round it", mm(kAroundMm)),
                     "draw the window inside the plate, off its folds and edges and what is cut out of it");
            return false;
        }
        if (e.paper->is_glued(Side::left, part.outer)) {
            e.failed("does-not-fit", "its window would be cut through a seam or a glued area",
                     "draw the window beside what is glued to the plate");
            return false;
        }
        paper = subtract(paper, {part});
    }
    if (!has_room(on_plate(e, B), hole_radius(e), paper)) {
        e.failed("does-not-fit",
                 fmt::format("its rivet at {} is not on the plate with {} of paper round its hole of {}",
                             at_mm(on_plate(e, B)), mm(kAroundMm), mm(number_of(e, "rivet"))),
                 "move B onto the plate, off its folds and edges and off the window");
        return false;
    }
    if (e.paper->is_glued(Side::left, circle(on_plate(e, B), hole_radius(e)).areas.front().outer)) {
        e.failed("does-not-fit",
                 fmt::format("its rivet's hole at {} would be cut through a seam or a glued area",
                             at_mm(on_plate(e, B))),
                 "move B beside what is glued to the plate");
        return false;
    }
    return true;
}

void lower(const Element& e, Builder& builder) {
    const int piece = builder.add_piece(e.paint.id);
    const Enclosed disc = drawn(e);
    const Enclosed hole = circle(own_rivet(e), hole_radius(e));
    Polygon outline = disc.areas.front();
    const Ring& around = hole.areas.front().outer;
    outline.holes.emplace_back(around.rbegin(), around.rend());
    const int plate =
        builder.add_cut_plate(e.paint.id, piece, e.extra_page, std::move(outline), color_of(e, "color"));
    builder.skeleton().draft.plates[static_cast<std::size_t>(plate)].rivet = own_rivet(e);
    builder.add_curves(disc.curves);
    builder.add_curves(hole.curves);
    builder.add_curves(curves_of(e, "window"));
    const int base = e.site.left_plate;
    const Enclosed below = circle(on_plate(e, B), hole_radius(e));
    builder.add_curves(below.curves);
    builder.add_hole(base, below.areas.front().outer);
    for (const Polygon& part : areas_of(e, "window")) builder.add_hole(base, part.outer);
    Rigid lies{plate, base, on_plate(e, A), {0, 1}, {0, 0}, {0, 1}};
    lies.behind = is_behind(e);
    builder.add_joint({e.paint.id, e.paint.place, lies});
}

constexpr MeasureInfo kRivetX{
    .name = "rivetx", .about = "how far right of its middle the rivet is", .said = Said::unless_zero};
constexpr MeasureInfo kRivetY{
    .name = "rivety", .about = "how far above its middle the rivet is", .said = Said::unless_zero};
constexpr MeasureInfo kWidth{
    .name = "width", .about = "width of its outline, where it has one", .said = Said::unless_zero};
constexpr MeasureInfo kHeight{
    .name = "height", .about = "height of its outline, where it has one", .said = Said::unless_zero};
constexpr std::array<MeasureInfo, 6> kMeasures{{measure::kX, measure::kY, kRivetX, kRivetY, kWidth, kHeight}};

std::vector<double> measured(const Element& e) {
    const Vec2 at = on_plate(e, A);
    const Vec2 rivet = own_rivet(e);
    const Box box = measure::drawn_box(e, "outline", {});
    return {at.x, at.y, rivet.x, rivet.y, box.width(), box.height()};
}

void shape(Element& e, std::span<const double> v) {
    const Vec2 was = on_plate(e, A);
    const Box box = measure::drawn_box(e, "outline", {});
    const Vec2 at{v[0], v[1]};
    e.on[A] = e.site.from_page(Side::left, at);
    e.on[B] = e.site.from_page(Side::left, at + Vec2{v[2], v[3]});
    const measure::Scale scale = measure::scale_of(box.width(), box.height(), v[4], v[5]);
    measure::move_drawn(e, PointPage::extra, measure::moved_to({}, {}, scale.aside, scale.along));
    measure::move_drawn(e, PointPage::fold, measure::moved_to({was, 0.0}, {at, 0.0}));
}

}  // namespace

const ElementRow kDisc = {{.name = "disc",
                           .code = -1,
                           .family = "disc",
                           .inverted = false,
                           .glued = true,
                           .about = "a piece that is turned by hand about a rivet in a plate",
                           .points = kPoints,
                           .partners = kPartners,
                           .grounds = {.fold = false, .plate = true},
                           .parameters = kParameters,
                           .folds = {},
                           .since = "3.0",
                           .also = kOtherNames,
                           .measures = kMeasures,
                           .plates = kOnePlate},
                          stands_on_no_fold,
                          constrain,
                          makes_no_folds,
                          drawn_from_front,
                          lower,
                          nullptr,
                          measured,
                          shape};

}  // namespace popup
