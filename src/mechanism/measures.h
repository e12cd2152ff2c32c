// Measures of elements: the words that rows share, and how points follow from measures and back.
//
// A row names its measures in ElementInfo::measures, and gives two functions that know their order:
//
//     std::vector<double> measured(const Element& e) { return {at(e, e.on[A].s), ...}; }
//     void shape(Element& e, std::span<const double> values) { ... }
//
// shape() reads from the element what no measure tells (which way its letters run), and then sets all points
// of the row. Values are millimetres and degrees. Whatever is drawn on the element's pages goes along.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "mechanism/arguments.h"
#include "mechanism/element.h"

namespace popup::measure {

inline constexpr std::array<std::string_view, 2> kTowards{"end", "begin"};

inline constexpr MeasureInfo kAt{.name = "at",
                                 .about = "place of its middle along the fold, from the fold's"};
inline constexpr MeasureInfo kApexAt{.name = "at",
                                     .about = "place of its apex along the fold, from the fold's middle"};
inline constexpr MeasureInfo kLength{
    .name = "length", .about = "how long it is along the fold", .share = 0.3};
inline constexpr MeasureInfo kWidth{.name = "width", .about = "how wide it is across the fold", .share = 0.3};
inline constexpr MeasureInfo kOffset{
    .name = "offset", .about = "how far right of the fold its middle lies", .said = Said::unless_zero};
inline constexpr MeasureInfo kShift{.name = "shift",
                                    .about = "how much further along the fold its right side lies",
                                    .said = Said::unless_zero};
inline constexpr MeasureInfo kTaper{.name = "taper",
                                    .about = "how much longer its right side is than its left one",
                                    .said = Said::unless_zero};
inline constexpr MeasureInfo kAngle{.name = "angle",
                                    .kind = MeasureKind::angle,
                                    .about = "angle between its two sides, at the apex on the fold",
                                    .standard = 80.0};
inline constexpr MeasureInfo kSkew{.name = "skew",
                                   .kind = MeasureKind::angle,
                                   .about = "how much more its right side is turned away from the fold",
                                   .said = Said::unless_zero};
inline constexpr MeasureInfo kOpens{.name = "opens",
                                    .kind = MeasureKind::choice,
                                    .about = "end of the fold towards which it opens",
                                    .words = kTowards};
inline constexpr MeasureInfo kPieceX{.name = "piecex",
                                     .about = "where its piece is drawn on its own page, to the right",
                                     .said = Said::drawing};
inline constexpr MeasureInfo kPieceY{
    .name = "piecey", .about = "where its piece is drawn on its own page, upwards", .said = Said::drawing};
inline constexpr MeasureInfo kPieceTurn{.name = "pieceturn",
                                        .kind = MeasureKind::angle,
                                        .about = "how far its piece is drawn turned, counter-clockwise",
                                        .said = Said::drawing};
inline constexpr MeasureInfo kX{.name = "x", .about = "place of its middle, to the right"};
inline constexpr MeasureInfo kY{.name = "y", .about = "place of its middle, upwards"};
inline constexpr MeasureInfo kTurnBy{.name = "turn",
                                     .kind = MeasureKind::angle,
                                     .about = "by how much to turn what is drawn, counter-clockwise",
                                     .said = Said::drawing,
                                     .relative = true};

// Along the fold from its middle, and back.
inline double from_middle(const Element& e, double s) { return s - 0.5 * e.site.length; }
inline double along(const Element& e, double at) { return at + 0.5 * e.site.length; }

// Two sides along the fold, each with two points at one distance from it: on[0], on[1] left and on[2], on[3]
// right. Which way the letters run along the fold stays as it is.
struct TwoSides {
    double at = 0.0, length = 0.0, width = 0.0, offset = 0.0, shift = 0.0, taper = 0.0;

    [[nodiscard]] double left() const { return 0.5 * width - offset; }
    [[nodiscard]] double right() const { return 0.5 * width + offset; }
};
TwoSides two_sides(const Element& e);
void set_two_sides(Element& e, const TwoSides& sides);

// Two sides that open from an apex on the fold, to one point on the left and one on the right of it.
struct TwoRays {
    double at = 0.0, width = 0.0, offset = 0.0, angle = 0.0, skew = 0.0;
    int dir = 1;  // 1: they open towards the fold's end, -1: towards its begin

    // The point of a side, where its apex is.
    [[nodiscard]] SitePoint left(double apex) const;
    [[nodiscard]] SitePoint right(double apex) const;
};
TwoRays two_rays(double length, double apex, int dir, SitePoint left, SitePoint right);

// A place and a direction on a page.
struct Spot {
    Vec2 at;
    double turn = 0.0;  // degrees from upwards, counter-clockwise

    [[nodiscard]] Vec2 up() const;
    [[nodiscard]] Vec2 right() const { return right_of(up()); }
    [[nodiscard]] Vec2 place(double aside, double along) const { return at + aside * right() + along * up(); }
};
// The middle of a line, and its direction.
Spot spot_of(Vec2 from, Vec2 to);
// Degrees from upwards, counter-clockwise, in (-180, 180].
double turn_of(Vec2 direction);

// The map that takes one spot to another, with what is aside of it and along it scaled.
Placed moved_to(const Spot& from, const Spot& to, double aside = 1.0, double along = 1.0);
// The affine map that takes three points to three others; nullopt where the first lie on one line.
std::optional<Placed> mapped_to(const std::array<Vec2, 3>& from, const std::array<Vec2, 3>& to);
// Moves all paths and points that are drawn on that page of the element, and marks them as changed, unless
// the map leaves everything where it is.
void move_drawn(Element& e, PointPage page, const Placed& by);

// The box of a parameter's path or points, seen from a spot: x aside, y along.
Box drawn_box(const Element& e, std::string_view name, const Spot& from);
// How drawn sizes change: one that is asked for changes the other, so that shapes are kept; both change as
// they are asked for.
struct Scale {
    double aside = 1.0, along = 1.0;
};
Scale scale_of(double width, double height, double new_width, double new_height);
// Where one of the measures that are given changes, those of them that are as they were change as well, by
// less than is written: each is asked for. Of so many measures each.
void ask_for(const std::vector<bool>& given, std::span<const double> was, std::span<double> wanted);

// The same for what is drawn on the fold's page: its box, seen from a spot, is given a place and a size, and
// then it is turned about the middle of its corners.
void place_drawn(Element& e, const Spot& from, const Box& box, const Spot& to, const Scale& scale,
                 double turn_deg);

// A new path: an ellipse about a spot, so wide aside of it and so high along it; a ring of corners, given
// aside and along.
Argument ellipse(const Spot& about, double width, double height);
Argument corners(const Spot& about, std::span<const Vec2> at);

}  // namespace popup::measure
