// The floating layer: a top that stays parallel to the planes it floats over, on two walls and a pillar that
// stands on the fold, all equally high (Glassner, section 6, names it; its geometry: motion/joints/lift.cpp).
//
// Its own page, seen from above, x across the fold and y along it: the left wall, the two halves of the top,
// the right wall, with the feet on the outside. The pillar is a piece of its own, beyond the end of the
// strip.
//
//     0    h     h+p     h+p+q   2h+p+q
//     | wall | top | top | wall |
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "mechanism/rows.h"
#include "mechanism/shapes.h"
#include "mechanism/site_lines.h"
#include "mechanism/step.h"
#include "mechanism/two_seams.h"
#include "mechanism/walls.h"

namespace popup {
namespace {

using two_seams::A, two_seams::B, two_seams::E, two_seams::F;

constexpr std::array<ParameterInfo, 7> kParameters{
    {kHalfColours[0],
     kHalfColours[1],
     kHalfColours[2],
     kHalfColours[3],
     {.name = "topcolor", .about = "colour of the top; without it each half has its wall's"},
     {.name = "pillarcolor", .about = "colour of the pillar and of its tabs"},
     walls::kHeight}};

enum LayerFolds : std::size_t { kLeft, kTopLeft, kCentre, kTopRight, kRight };
constexpr std::array<FoldInfo, 5> kFolds{{{"left", PointPage::fold, PointPage::extra},
                                          {"topleft"},
                                          {"centre"},
                                          {"topright"},
                                          {"right", PointPage::extra, PointPage::fold}}};

constexpr std::array<PlateInfo, 4> kPlates{{{"left", kLeft, true},
                                            {"topleft", kTopLeft, true},
                                            {"topright", kCentre, true},
                                            {"right", kRight, false}}};

constexpr double kBesideMm = 10.0;  // from the strip to the pillar, on their page

struct Span {
    double lo, hi;
};

// The measures that all of it follows from; along the fold as its site has it.
struct Measures {
    Span left, right, centre, pillar;
    double near_left, near_right, height;

    // x and y on its own page.
    [[nodiscard]] double top_left() const { return height; }
    [[nodiscard]] double middle() const { return height + near_left; }
    [[nodiscard]] double top_right() const { return height + near_left + near_right; }
    [[nodiscard]] double far_right() const { return 2.0 * height + near_left + near_right; }
    [[nodiscard]] double y(double s) const { return s - std::min(left.lo, right.lo); }
    [[nodiscard]] double pillar_foot() const { return y(std::max(left.hi, right.hi)) + kBesideMm; }
};

Measures measures(const Element& e) {
    Measures m{};
    const auto span = [&](std::size_t i, std::size_t j) {
        const auto [lo, hi] = std::minmax(e.on[i].s, e.on[j].s);
        return Span{lo, hi};
    };
    m.left = span(A, B);
    m.right = span(E, F);
    m.near_left = 0.5 * (e.on[A].w + e.on[B].w);
    m.near_right = 0.5 * (e.on[E].w + e.on[F].w);
    m.height = number_of(e, "height");
    const double t = m.near_left / std::max(1e-9, m.near_left + m.near_right);
    m.centre = {std::lerp(m.left.lo, m.right.lo, t), std::lerp(m.left.hi, m.right.hi, t)};
    const auto [lo, hi] = two_seams::common_stretch(e);
    m.pillar = {lo, hi};
    if (e.alive_lo < e.alive_hi) m.pillar = {std::max(lo, e.alive_lo), std::min(hi, e.alive_hi)};
    return m;
}

bool constrain(Element& e) {
    if (!two_seams::constrain_page(e)) return false;
    const Measures m = measures(e);
    const double room = m.pillar.hi - m.pillar.lo;
    if (room >= e.tolerances->min_length_mm) return true;
    e.failed(
        "does-not-fit",
        fmt::format("its walls have {} of the fold between them, where its pillar stands; the least is {}",
                    mm(std::max(0.0, room)), mm(e.tolerances->min_length_mm)),
        "draw A–B and E–F opposite each other, where the fold has not been cut away");
    return false;
}

FoldLines fold_lines(const Element& e) {
    const Measures m = measures(e);
    const auto line = [&](double x, Span s) { return Segment{{x, m.y(s.lo)}, {x, m.y(s.hi)}}; };
    const auto plain = [](const Segment& at, int closed) { return FoldLine{at, at, closed}; };
    const int seams = e.site.mountain ? 180 : 0;
    const int edges = e.site.mountain ? 180 : 360;
    return {{walls::foot_line(e, Side::left, m.left.lo, m.left.hi), line(0.0, m.left), seams},
            plain(line(m.top_left(), m.left), edges),
            plain(line(m.middle(), m.centre), e.site.mountain ? 360 : 0),
            plain(line(m.top_right(), m.right), edges),
            {line(m.far_right(), m.right), walls::foot_line(e, Side::right, m.right.lo, m.right.hi), seams}};
}

Ring strip(const Segment& left, const Segment& right) { return {left.a, right.a, right.b, left.b}; }

// The pillar's plate, glued on the left plane along the fold and under the left half of the top.
int add_pillar(const Element& e, const Measures& m, int top_left, Builder& builder) {
    const std::string name = e.paint.id + "/pillar";
    const int piece = builder.add_piece(name);
    const double foot = m.pillar_foot();
    const double head = foot + m.height;
    const double wide = m.pillar.hi - m.pillar.lo;
    const auto color = color_of(e, "pillarcolor");
    const int plate = builder.add_plate(name, piece, e.extra_page,
                                        {{{0.0, foot}, {wide, foot}, {wide, head}, {0.0, head}}, {}}, color);
    builder.add_cut(piece, {{0.0, foot}, {0.0, head}});
    builder.add_cut(piece, {{wide, foot}, {wide, head}});
    builder.add_foot({plate,
                      e.site.left_plate,
                      {{wide, foot}, {0.0, foot}},
                      e.site.segment(Side::left, {m.pillar.hi, 0.0}, {m.pillar.lo, 0.0}),
                      e.label + "P",
                      color,
                      e.paint.id,
                      e.paint.place});
    builder.add_foot({plate,
                      top_left,
                      {{0.0, head}, {wide, head}},
                      {{m.middle(), m.y(m.pillar.lo)}, {m.middle(), m.y(m.pillar.hi)}},
                      e.label + "T",
                      color,
                      e.paint.id,
                      e.paint.place,
                      true});
    return plate;
}

void lower(const Element& e, Builder& builder) {
    const Measures m = measures(e);
    const FoldLines lines = fold_lines(e);
    const Site& site = e.site;
    const std::string& id = e.paint.id;
    const int piece = builder.add_piece(id);
    const auto plate = [&](std::string_view name, LayerFolds from, LayerFolds to,
                           std::optional<Color> color) {
        const Segment& left = from == kLeft ? lines[from].on_right : lines[from].on_left;
        return builder.add_plate(fmt::format("{}/{}", id, name), piece, e.extra_page,
                                 {strip(left, lines[to].on_left), {}}, color);
    };
    const int left = plate("left", kLeft, kTopLeft, e.paint.left);
    const auto top = color_of(e, "topcolor");
    const int top_left = plate("top-left", kTopLeft, kCentre, top ? top : e.paint.left);
    const int top_right = plate("top-right", kCentre, kTopRight, top ? top : e.paint.right);
    const int right = plate("right", kTopRight, kRight, e.paint.right);
    const std::array<Segment, 5> across{lines[kLeft].on_right, lines[kTopLeft].on_left,
                                        lines[kCentre].on_left, lines[kTopRight].on_left,
                                        lines[kRight].on_left};
    for (std::size_t i = 0; i + 1 < across.size(); ++i) {
        builder.add_cut(piece, {across[i].a, across[i + 1].a});
        builder.add_cut(piece, {across[i].b, across[i + 1].b});
    }

    const auto fold = [&](LayerFolds which, int before, int after) {
        add_fold_of(e, builder, lines, which, {before, after});
    };
    fold(kLeft, site.left_plate, left);
    fold(kTopLeft, left, top_left);
    fold(kCentre, top_left, top_right);
    fold(kTopRight, top_right, right);
    fold(kRight, right, site.right_plate);
    glue_seams(e, builder, {lines[kLeft], left}, {lines[kRight], right});

    Lift lift;
    lift.outside = site.mountain;
    lift.height = m.height;
    lift.left =
        walls::upright(site, Side::left, {m.left.lo, m.near_left}, {0.0, m.y(m.left.lo)}, {0, 1}, {1, 0});
    lift.right = walls::upright(site, Side::right, {m.right.lo, m.near_right},
                                {m.far_right(), m.y(m.right.lo)}, {0, 1}, {-1, 0});
    lift.left.plate = left;
    lift.right.plate = right;
    lift.top_left = {top_left, {m.top_left(), m.y(m.left.lo)}, {0, 1}, {1, 0}};
    lift.top_right = {top_right, {m.top_right(), m.y(m.right.lo)}, {0, 1}, {-1, 0}};
    lift.pillar = {
        add_pillar(e, m, top_left, builder), {m.left.lo - m.pillar.lo, m.pillar_foot()}, {1, 0}, {0, 1}};
    builder.add_joint({id, e.paint.place, lift});
}

}  // namespace

const ElementRow kFloatingLayer = {
    {.name = "floating-layer",
     .code = -1,
     .family = "floating-layer",
     .inverted = false,
     .glued = true,
     .about = "a top that stays parallel to the planes under it, on two walls and a pillar",
     .points = walls::kPoints,
     .partners = walls::kPartners,
     .grounds = {.seam = true},
     .parameters = kParameters,
     .folds = kFolds,
     .since = "3.0",
     .measures = step::kMeasures,
     .plates = kPlates},
    two_seams::stands_on,
    constrain,
    fold_lines,
    drawn_from_front,
    lower,
    nullptr,
    step::measured,
    step::shape};

}  // namespace popup
