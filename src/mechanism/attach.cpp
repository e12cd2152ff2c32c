#include "mechanism/attach.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/geometry/laid.h"
#include "base/geometry/regions.h"
#include "mechanism/drawn_lines.h"
#include "mechanism/site_lines.h"
#include "mechanism/thin_places.h"

namespace popup {
namespace {

enum { G, H };  // of `extra`

constexpr double kGlueInsetMm = 1.0;  // glue stays this far away from folds and edges
constexpr double kLeastGlueMm2 = 25.0;
constexpr double kLostGlueMm2 = 0.5;  // more of a given area may not lie beside the paper

// The piece's page on the plate's.
Laid laid(const Element& e, const Bed& bed) {
    return {e.extra[G], unit(e.extra[H] - e.extra[G]), bed.line.a, unit(bed.line.b - bed.line.a), bed.back};
}

std::vector<Polygon> glued_area(const Element& e, const Bed& bed) {
    const Laid lay = laid(e, bed);
    std::vector<Polygon> piece;
    for (const Polygon& part : areas_of(e, "outline")) piece.push_back(lay(part));
    Box near;
    for (const Polygon& part : piece) {
        for (const Vec2 p : part.outer) near.extend(p);
    }
    const std::span<const Polygon> given = areas_of(e, "glue");
    if (given.empty()) return intersect(piece, bed.paper(kGlueInsetMm, near));
    const std::vector<Polygon> on_piece = intersect(piece, {given.begin(), given.end()});
    return intersect(on_piece, bed.paper(0.0, near));
}

}  // namespace

AttachedMeasures attached_measures(const Element& e) {
    const measure::Spot line = measure::spot_of(e.extra[G], e.extra[H]);
    const Box box = measure::drawn_box(e, "outline", line);
    return {box.width(), box.height(), line};
}

measure::Scale shape_attached(Element& e, const AttachedMeasures& wanted, double line_mm, double beside,
                              double beyond) {
    const AttachedMeasures was = attached_measures(e);
    e.extra[G] = wanted.line.place(0.0, -0.5 * line_mm);
    e.extra[H] = wanted.line.place(0.0, 0.5 * line_mm);
    const auto outline = find_parameter(*e.info, "outline");
    POPUP_INVARIANT(outline);
    if (!e.arguments[*outline].given()) {
        const measure::Spot middle{wanted.line.place(beside * wanted.width, beyond * wanted.height),
                                   wanted.line.turn};
        e.arguments[*outline] = measure::ellipse(middle, wanted.width, wanted.height);
        return {};
    }
    const measure::Scale scale = measure::scale_of(was.width, was.height, wanted.width, wanted.height);
    measure::move_drawn(e, PointPage::extra,
                        measure::moved_to(was.line, wanted.line, scale.aside, scale.along));
    return scale;
}

bool constrain_line(Element& e, const Bed& bed, std::string_view name) {
    const double least = e.tolerances->min_length_mm;
    const double base = distance(bed.line.a, bed.line.b);
    const double own = distance(e.extra[G], e.extra[H]);
    if (std::min(base, own) < least) {
        e.failed("degenerate",
                 fmt::format("the lines {} and G–H are {} and {} long; the least is {}", name, mm(base),
                             mm(own), mm(least)),
                 "draw both at least that long, so that they say how the piece is turned");
        return false;
    }
    e.extra[H] = e.extra[G] + (base / own) * (e.extra[H] - e.extra[G]);
    if (std::abs(base - own) > e.tolerances->rounding_mm) {
        e.repaired("seam-length",
                   fmt::format("G–H is {} long and {}, on which it lies, {}; H was moved along the line",
                               mm(own), name, mm(base)),
                   fmt::format("make G–H as long as {}", name));
    }
    return true;
}

bool constrain_attached(Element& e, const Bed& bed) {
    if (!mend_outline(e)) return false;
    const std::span<const Polygon> outline = areas_of(e, "outline");
    if (outline.size() != 1) {
        e.failed("outline-crosses",
                 fmt::format("its outline encloses {} areas that do not hang together", outline.size()),
                 "draw one area, with holes where it has any");
        return false;
    }
    tell_thin(e, outline.front());
    const std::vector<Polygon> glue = glued_area(e, bed);
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
             "move its line further onto the plate, or make the piece larger there");
    return false;
}

void lower_attached(const Element& e, const Bed& bed, Builder& builder, int base) {
    const Laid lay = laid(e, bed);
    const int piece = builder.add_piece(e.paint.id);
    const int plate = builder.add_cut_plate(e.paint.id, piece, e.extra_page, areas_of(e, "outline").front(),
                                            color_of(e, "color"));
    builder.add_curves(curves_of(e, "outline"));
    builder.add_curves(curves_of(e, "glue"));
    builder.add_joint({e.paint.id, e.paint.place,
                       Rigid{plate, base, lay.to, lay.base_dir, lay.from, lay.own_dir, lay.back}});
    builder.add_glued_area({plate, base, glued_area(e, bed), e.label, e.paint.id, e.paint.place});
}

}  // namespace popup
