// The attached plane: a flat piece of any shape glued on a plate, with which it moves (Glassner, section 6).
//
// The line G–H of the piece lies on the line A–B of the plate. What of the piece lies on the plate's paper, 1
// mm away from its folds and edges, is glued, or the area that is given; the rest may stick out of it, and of
// the card.
#include <fmt/format.h>

#include <algorithm>

#include "base/geometry/regions.h"
#include "mechanism/rows.h"
#include "mechanism/site_lines.h"

namespace popup {
namespace {

enum { A, B };  // of `on`
enum { G, H };  // of `extra`

constexpr std::array<PointInfo, 4> kPoints{{{"A", PointPage::fold, '-'},
                                            {"B", PointPage::fold, '-'},
                                            {"G", PointPage::extra, '-'},
                                            {"H", PointPage::extra, '-'}}};
constexpr std::array<int, 4> kPartners{0, 1, 2, 3};
constexpr std::array<std::string_view, 2> kSides{"front", "back"};
constexpr std::array<ParameterInfo, 4> kParameters{
    {{.name = "color", .about = "colour of the piece"},
     {.name = "outline",
      .kind = ParameterKind::path,
      .about = "shape of the piece, on its own page",
      .required = true},
     {.name = "glue",
      .kind = ParameterKind::path,
      .about = "where it is glued, on the plate's page; else all of it that lies on the plate",
      .page = PointPage::fold},
     {.name = "side",
      .kind = ParameterKind::choice,
      .about = "on which side of the plate it is glued",
      .words = kSides}}};

constexpr double kGlueInsetMm = 1.0;  // glue stays this far away from folds and edges
constexpr double kLeastGlueMm2 = 25.0;
constexpr double kLostGlueMm2 = 0.5;  // more of a given area may not lie beside the paper

bool on_back(const Element& e) { return choice_of(e, "side") == kSides[1]; }

// Where points of the piece's page lie on the plate's page.
struct Laid {
    Vec2 from, own_dir, to, base_dir;
    bool back;

    [[nodiscard]] Vec2 operator()(Vec2 p) const {
        const Vec2 d = p - from;
        const double aside = cross(own_dir, d);
        return to + dot(own_dir, d) * base_dir + (back ? -aside : aside) * left_of(base_dir);
    }
};

Laid laid(const Element& e) {
    const Vec2 a = e.site.on_page(Side::left, e.on[A]);
    const Vec2 b = e.site.on_page(Side::left, e.on[B]);
    return {e.extra[G], unit(e.extra[H] - e.extra[G]), a, unit(b - a), on_back(e)};
}

std::vector<Polygon> glued_area(const Element& e) {
    const Laid lay = laid(e);
    std::vector<Polygon> piece;
    for (Polygon part : areas_of(e, "outline")) {
        for (Vec2& p : part.outer) p = lay(p);
        for (Ring& hole : part.holes) {
            for (Vec2& p : hole) p = lay(p);
        }
        piece.push_back(std::move(part));
    }
    const std::span<const Polygon> given = areas_of(e, "glue");
    if (given.empty()) return intersect(piece, e.paper->paper(Side::left, kGlueInsetMm));
    const std::vector<Polygon> on_piece = intersect(piece, {given.begin(), given.end()});
    return intersect(on_piece, e.paper->paper(Side::left, 0.0));
}

bool constrain_line(Element& e) {
    const double least = e.tolerances->min_length_mm;
    const double base = std::hypot(e.on[B].s - e.on[A].s, e.on[B].w - e.on[A].w);
    const double own = distance(e.extra[G], e.extra[H]);
    if (std::min(base, own) < least) {
        e.failed("degenerate",
                 fmt::format("the lines A–B and G–H are {} and {} long; the least is {}", mm(base), mm(own),
                             mm(least)),
                 "draw both at least that long, so that they say how the piece is turned");
        return false;
    }
    e.extra[H] = e.extra[G] + (base / own) * (e.extra[H] - e.extra[G]);
    if (std::abs(base - own) > e.tolerances->rounding_mm) {
        e.repaired("seam-length",
                   fmt::format("G–H is {} long and A–B, on which it lies, {}; H was moved along the line",
                               mm(own), mm(base)),
                   "make G–H as long as A–B");
    }
    return true;
}

bool constrain(Element& e) {
    if (!constrain_line(e)) return false;
    const std::span<const Polygon> outline = areas_of(e, "outline");
    if (outline.size() != 1) {
        e.failed("outline-crosses",
                 fmt::format("its outline encloses {} areas that do not hang together", outline.size()),
                 "draw one area, with holes where it has any");
        return false;
    }
    const std::vector<Polygon> glue = glued_area(e);
    const double good = area(glue);
    double given = 0.0;
    for (const Polygon& part : areas_of(e, "glue")) given += area(part);
    if (given - good > kLostGlueMm2) {
        e.failed(
            "does-not-fit",
            fmt::format("{:.1f} mm² of its glue area of {:.1f} mm² lie beside the plate or beside the piece",
                        given - good, given),
            "draw the glue area where the piece lies on the plate's paper, or leave it out");
        return false;
    }
    if (good >= kLeastGlueMm2) return true;
    e.failed("does-not-fit",
             fmt::format(
                 "only {:.1f} mm² of it lie on its plate, {} away from folds and edges; {:.0f} mm² are the "
                 "least that holds",
                 good, mm(kGlueInsetMm), kLeastGlueMm2),
             "move A and B further onto the plate, or make the piece larger there");
    return false;
}

void lower(const Element& e, Builder& builder) {
    const Laid lay = laid(e);
    const int piece = builder.add_piece(e.paint.id);
    const int plate = builder.add_cut_plate(e.paint.id, piece, e.extra_page, areas_of(e, "outline").front(),
                                            color_of(e, "color"));
    builder.add_curves(curves_of(e, "outline"));
    builder.add_curves(curves_of(e, "glue"));
    builder.add_joint(
        {e.paint.id, e.paint.place,
         Rigid{plate, e.site.left_plate, lay.to, lay.base_dir, lay.from, lay.own_dir, lay.back}});
    builder.add_glued_area({plate, e.site.left_plate, glued_area(e), e.label, e.paint.id, e.paint.place});
}

}  // namespace

const ElementRow kAttachedPlane = {
    {.name = "attached-plane",
     .code = -1,
     .family = "attached-plane",
     .inverted = false,
     .glued = true,
     .about = "a flat piece of any shape glued on a plate, with which it moves",
     .points = kPoints,
     .partners = kPartners,
     .grounds = {.fold = false, .plate = true},
     .parameters = kParameters,
     .folds = {},
     .since = "3.0"},
    [](const Element&) {
        return std::pair{0.0, 0.0};
    },
    constrain,
    [](const Element&) { return FoldLines{}; },
    [](const Element&) { return 1.0; },
    lower};

}  // namespace popup
