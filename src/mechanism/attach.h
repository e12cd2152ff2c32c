// A flat piece glued on a plate, over an area: what the attached plane and the pivot share.
//
// The row has the parameters `outline` (required, on the piece's own page), `glue` (on the plate's page) and
// `color`, and its first two points of the extra page are G and H: the line G–H of the piece lies on a line
// of the plate.
//
//     const Bed bed = ...;
//     if (!constrain_line(e, bed, "A–B") || !constrain_attached(e, bed)) return false;  // in constrain()
//     lower_attached(e, bed, builder, plate);                                            // in lower()
#pragma once

#include <array>
#include <functional>
#include <string_view>
#include <vector>

#include "mechanism/measures.h"

namespace popup {

inline constexpr ParameterInfo kAttachedColor{.name = "color", .about = "colour of the piece"};
inline constexpr ParameterInfo kAttachedOutline{.name = "outline",
                                                .kind = ParameterKind::path,
                                                .about = "shape of the piece, on its own page",
                                                .required = true};
inline constexpr ParameterInfo kAttachedGlue{
    .name = "glue",
    .kind = ParameterKind::path,
    .about = "where it is glued, on the plate's page; else all of it that lies on the plate",
    .page = PointPage::fold};

// The measures of the piece: how large its outline is, and where its line G–H is drawn.
struct AttachedMeasures {
    double width = 0.0, height = 0.0;  // aside of the line and along it
    measure::Spot line;
};
AttachedMeasures attached_measures(const Element& e);
// Sets G and H on a line that long, and the outline with them; a piece without an outline gets an ellipse
// whose middle lies `beside` times its width to the right of the line's, and `beyond` times its height
// further on. Returns by how much the outline grew. What is drawn on the plate's page is left to the caller.
measure::Scale shape_attached(Element& e, const AttachedMeasures& wanted, double line_mm, double beside = 0.0,
                              double beyond = 0.0);

// Where the piece lies. Page coordinates of the plate.
struct Bed {
    Segment line;       // that G–H lies on, from G's end
    bool back = false;  // it lies on the plate's back
    // The plate's paper at least so many mm away from its folds and edges, as far as `near` reaches.
    std::function<std::vector<Polygon>(double inset, const Box& near)> paper;
};

// Makes G–H as long as the bed's line, which is called `name` in messages; false after failed().
bool constrain_line(Element& e, const Bed& bed, std::string_view name);
// Mends its outline (mend_outline()), warns of where it is too thin, and looks whether it is one area and
// enough of it is glued; false after failed().
bool constrain_attached(Element& e, const Bed& bed);
// The piece with its plate, its joint and its glue, on the plate `base`.
void lower_attached(const Element& e, const Bed& bed, Builder& builder, int base);

}  // namespace popup
