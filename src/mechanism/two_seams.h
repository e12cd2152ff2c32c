// What elements share that are a piece of their own, glued along two seams parallel to the fold: the tent and
// the layer.
//
// On the fold's page A B (left seam) and E F (right seam); on the extra page G H (glued to A B) and K L
// (glued to E F), outline G K L H. With p, q the seams' distances from the fold and s1, s2 the piece's sides,
// its centre fold I–J follows from folding flat: on a valley fold p + s1 = q + s2, on a mountain fold
// s1 − p = s2 − q.
#pragma once

#include <array>
#include <functional>
#include <utility>

#include "mechanism/measures.h"

namespace popup::two_seams {

// Element::on and Element::extra, by the points' letters.
enum : std::size_t { A, B, E, F };
enum : std::size_t { G, H, K, L };

inline constexpr std::array<PointInfo, 8> kPoints{{{"A", PointPage::fold, 'L'},
                                                   {"B", PointPage::fold, 'L'},
                                                   {"E", PointPage::fold, 'R'},
                                                   {"F", PointPage::fold, 'R'},
                                                   {"G", PointPage::extra, 'L'},
                                                   {"H", PointPage::extra, 'L'},
                                                   {"K", PointPage::extra, 'R'},
                                                   {"L", PointPage::extra, 'R'}}};
inline constexpr std::array<int, 8> kPartners{2, 3, 0, 1, 6, 7, 4, 5};

// The measures that the tent and the layer share; of a tent `height` comes behind the offset.
inline constexpr std::array<MeasureInfo, 9> kMeasures{
    {measure::kAt, measure::kLength, measure::kWidth, measure::kOffset, measure::kShift, measure::kTaper,
     measure::kPieceX, measure::kPieceY, measure::kPieceTurn}};
std::vector<double> measured(const Element& e);
// `wide`: the width of the piece.
void shape(Element& e, std::span<const double> values, double wide);

// The middle of the seams, as a point of the fold.
std::pair<double, double> stands_on(const Element& e);

// Width of the piece, across its seams; negative when it is drawn from its back.
double width(const Element& e);
// p + q: how far the seams on the page are apart, across the fold.
double apart(const Element& e);

// Makes the page's seams parallel and puts them on paper; false after failed().
bool constrain_page(Element& e);
// The same, and then moves them by `move`, which may take the paper from under them: then both are done
// again, a few times. False after failed(), or where `move` is false; `no_paper` says what was not found.
bool constrain_page(Element& e, const std::function<bool(Element&)>& move, std::string_view no_paper);
// Makes the piece face up, its seams parallel, and its ends match the page's; false after failed().
bool constrain_piece(Element& e);
// Makes the outline that is drawn, if any, fit the seams as they are then; false after failed().
bool constrain_outline(Element& e);
// Over a fold that needs both seams at one distance, the farther comes as near as the other, where there is
// most likely paper. `why` ends the sentence "its seams are 10.00 mm and 12.00 mm away from the".
void make_even(Element& e, std::string_view why);
// The stretch along the fold that both seams on the page have in common: from, to. Empty where to < from.
std::pair<double, double> common_stretch(const Element& e);
// Whether A–B runs in the fold's direction.
bool runs_along(const Element& e);
// Moves both seams of the piece apart, or together, alike.
void set_width(Element& e, double wide);

// Left, centre and right fold, from the points as they are.
FoldLines fold_lines(const Element& e);
// `right_angle`: the piece is as wide as its seams are apart, over a valley fold. It then moves as a
// parallelogram, which is flat on the open card as well as on the closed one.
void lower(const Element& e, Builder& builder, bool right_angle);

}  // namespace popup::two_seams
