// What rows share that are cut from one sheet with a drawn border.
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "mechanism/measures.h"
#include "mechanism/sheet_shape.h"

namespace popup {

// They find the fold that they are drawn across, valley or mountain.
inline constexpr Grounds kFoundFold{.found = true};
inline constexpr ParameterInfo kSheetOutline{.name = "outline",
                                             .kind = ParameterKind::path,
                                             .about = "border, on the page of the fold that it lies across",
                                             .required = true,
                                             .page = PointPage::fold};
inline constexpr ParameterInfo kTopFold{.name = "top",
                                        .kind = ParameterKind::length,
                                        .about = "distance of the left fold from the fold it stands on",
                                        .partner = "bottom",
                                        .least = 1.0,
                                        .most = 5000.0,
                                        .group = "folds"};
inline constexpr ParameterInfo kBottomFold{.name = "bottom",
                                           .kind = ParameterKind::length,
                                           .about = "distance of the right fold from the fold it stands on",
                                           .partner = "top",
                                           .least = 1.0,
                                           .most = 5000.0,
                                           .group = "folds"};

// What was drawn, on its page: as its outline, or through its touch points.
std::optional<Path> drawn_path(const Element& e);
// A line as a border, closed; nothing is repaired in it yet. nullopt: it is longer than anybody draws.
std::optional<Border> border_of_line(const Subpath& line);
// The same of what was drawn; nullopt where that is not one line, too.
std::optional<Border> drawn_border(const Element& e);
// In coordinates of the site, repaired without a word.
std::optional<Border> site_border(const Element& e);
// Takes the loops out of the border, and tells of it; false after failed(): `no-outline`, `outline-crosses`.
// `border` makes it of what is drawn.
bool constrain_border(Element& e, std::optional<Border> (*border)(const Element&) = drawn_border);
// Whether both footprints lie on the paper, with paper around them, and the span on the fold; false after
// failed().
bool constrain_room(Element& e, const SlitShape& slit);

// Of rows with parallel folds: polygon and freeform.
namespace sheet {
std::pair<double, double> span(const Element& e);
bool constrain(Element& e);
FoldLines fold_lines(const Element& e);
void lower(const Element& e, Builder& builder);
std::vector<double> crossings(const Element& e);

// Of what is drawn, whatever its border: the box that it fills. Sizes keep its shape, unless both are asked
// for.
inline constexpr std::array<MeasureInfo, 5> kMeasures{
    {measure::kAt, measure::kLength, measure::kWidth, measure::kOffset, measure::kTurnBy}};
std::vector<double> measured(const Element& e);
// A new one gets these corners, aside of the fold and along it, in shares of its width and length; without
// any an ellipse.
void shape(Element& e, std::span<const double> values, std::span<const Vec2> fresh);
}  // namespace sheet

// Lines that cannot be had: as many as the row has folds.
FoldLines no_fold_lines();

}  // namespace popup
