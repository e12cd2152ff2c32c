// The attached plane: a flat piece of any shape glued on a plate, with which it moves (Glassner, section 6).
//
// The line G–H of the piece lies on the line A–B of the plate. What of the piece lies on the plate's paper, 1
// mm away from its folds and edges, is glued, or the area that is given; the rest may stick out of it, and of
// the card.
#include <array>

#include "mechanism/attach.h"
#include "mechanism/measures.h"
#include "mechanism/rows.h"

namespace popup {
namespace {

enum { A, B };  // of `on`

constexpr std::array<PointInfo, 4> kPoints{{{"A", PointPage::fold, '-'},
                                            {"B", PointPage::fold, '-'},
                                            {"G", PointPage::extra, '-'},
                                            {"H", PointPage::extra, '-'}}};
constexpr std::array<int, 4> kPartners{0, 1, 2, 3};
constexpr std::array<std::string_view, 2> kSides{"front", "back"};
constexpr std::array<ParameterInfo, 4> kParameters{{kAttachedColor,
                                                    kAttachedOutline,
                                                    kAttachedGlue,
                                                    {.name = "side",
                                                     .kind = ParameterKind::choice,
                                                     .about = "on which side of the plate it is glued",
                                                     .words = kSides}}};

Bed bed_of(const Element& e) {
    return {e.site.segment(Side::left, e.on[A], e.on[B]), choice_of(e, "side") == kSides[1],
            [&e](double inset, const Box& near) { return e.paper->paper(Side::left, inset, near); }};
}

bool constrain(Element& e) {
    const Bed bed = bed_of(e);
    return constrain_line(e, bed, "A–B") && constrain_attached(e, bed);
}

void lower(const Element& e, Builder& builder) { lower_attached(e, bed_of(e), builder, e.site.left_plate); }

constexpr MeasureInfo kWidth{.name = "width", .about = "width of its outline, across its line", .share = 0.2};
constexpr MeasureInfo kHeight{
    .name = "height", .about = "height of its outline, along its line", .share = 0.25};
constexpr MeasureInfo kTurn{.name = "turn",
                            .kind = MeasureKind::angle,
                            .about = "direction of its line on the plate, from upwards, counter-clockwise"};
constexpr MeasureInfo kLine{
    .name = "line", .about = "length of its line", .share = 0.1, .said = Said::drawing};
constexpr std::array<MeasureInfo, 9> kMeasures{{measure::kX, measure::kY, kTurn, kWidth, kHeight, kLine,
                                                measure::kPieceX, measure::kPieceY, measure::kPieceTurn}};

Vec2 on_plate(const Element& e, std::size_t point) { return e.site.on_page(Side::left, e.on[point]); }

std::vector<double> measured(const Element& e) {
    const measure::Spot line = measure::spot_of(on_plate(e, A), on_plate(e, B));
    const AttachedMeasures piece = attached_measures(e);
    return {line.at.x,       line.at.y,       line.turn,
            piece.width,     piece.height,    distance(on_plate(e, A), on_plate(e, B)),
            piece.line.at.x, piece.line.at.y, piece.line.turn};
}

void shape(Element& e, std::span<const double> v) {
    const measure::Spot was = measure::spot_of(on_plate(e, A), on_plate(e, B));
    const measure::Spot line{{v[0], v[1]}, v[2]};
    e.on[A] = e.site.from_page(Side::left, line.place(0.0, -0.5 * v[5]));
    e.on[B] = e.site.from_page(Side::left, line.place(0.0, 0.5 * v[5]));
    const measure::Scale scale = shape_attached(e, {v[3], v[4], {{v[6], v[7]}, v[8]}}, v[5]);
    measure::move_drawn(e, PointPage::fold, measure::moved_to(was, line, scale.aside, scale.along));
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
     .since = "3.0",
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
