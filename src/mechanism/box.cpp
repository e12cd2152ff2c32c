// The box: two walls glued parallel to the fold, both at the distance p, and two ends that fold in their
// middle; one strip of paper, closed by a tab (Glassner, section 9, names it; its geometry:
// motion/joints/prism.cpp).
//
// Its own page, seen from outside, from left to right: the left wall, the front end (where the fold begins),
// the right wall, the back end, the tab. Feet at y = 0, the left wall from x = 0.
//
//     0      l     l+p   l+2p        2l+2p 2l+3p 2l+4p
//     | left | front     |   right   |   back    | tab
//
// Each half of an end is p wide. On a mountain fold its foot rises by p towards the middle fold, or the fold
// would be in its way as it closes.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "mechanism/measures.h"
#include "mechanism/rows.h"
#include "mechanism/shapes.h"
#include "mechanism/site_lines.h"
#include "mechanism/two_seams.h"
#include "mechanism/walls.h"

namespace popup {
namespace {

using two_seams::A, two_seams::B, two_seams::E, two_seams::F;

constexpr std::array<std::string_view, 2> kEnds{"in", "out"};
constexpr std::array<ParameterInfo, 7> kParameters{
    {kHalfColours[0],
     kHalfColours[1],
     kHalfColours[2],
     kHalfColours[3],
     {.name = "endcolor", .about = "colour of both ends; without it each half has its wall\'s"},
     walls::kHeight,
     {.name = "ends",
      .kind = ParameterKind::choice,
      .about = "way in which its ends fold as the card closes",
      .words = kEnds}}};

enum BoxFolds : std::size_t {
    kLeft,
    kRight,
    kFrontLeft,
    kFront,
    kFrontRight,
    kBackRight,
    kBack,
    kBackLeft,  // the seam of the tab: no fold to stand on
};
constexpr std::array<FoldInfo, 7> kFolds{{{"left", PointPage::fold, PointPage::extra},
                                          {"right", PointPage::extra, PointPage::fold},
                                          {"frontleft"},
                                          {"front"},
                                          {"frontright"},
                                          {"backright"},
                                          {"back"}}};

constexpr std::array<PlateInfo, 6> kPlates{{{"left", kLeft, true},
                                            {"right", kRight, false},
                                            {"frontleft", kFrontLeft, true},
                                            {"frontright", kFrontRight, false},
                                            {"backright", kBackRight, true},
                                            {"backleft", kBack, true}}};

// The measures that all of it follows from.
struct Measures {
    double lo, hi;  // along the fold
    double near;    // p
    double height;
    double rise;  // of the ends' feet, at their middle folds
    bool inwards;

    [[nodiscard]] double length() const { return hi - lo; }
    // x of the folds on its own page.
    [[nodiscard]] double front_left() const { return length(); }
    [[nodiscard]] double front() const { return length() + near; }
    [[nodiscard]] double front_right() const { return length() + 2.0 * near; }
    [[nodiscard]] double back_right() const { return 2.0 * length() + 2.0 * near; }
    [[nodiscard]] double back() const { return 2.0 * length() + 3.0 * near; }
    [[nodiscard]] double back_left() const { return 2.0 * length() + 4.0 * near; }
};

Measures measures(const Element& e) {
    const auto [lo, hi] = two_seams::common_stretch(e);
    const double near = 0.5 * (e.on[A].w + e.on[E].w);
    return {
        lo, hi, near, number_of(e, "height"), e.site.mountain ? near : 0.0, choice_of(e, "ends") == kEnds[0]};
}

void set_stretch(Element& e, double lo, double hi) {
    const bool along = two_seams::runs_along(e);
    e.on[A].s = e.on[E].s = along ? lo : hi;
    e.on[B].s = e.on[F].s = along ? hi : lo;
}

bool make_opposite(Element& e) {
    const auto [lo, hi] = two_seams::common_stretch(e);
    if (hi - lo < e.tolerances->min_length_mm) {
        e.failed(
            "degenerate",
            fmt::format("its walls A–B and E–F stand opposite each other along {} of the fold; the least "
                        "is {}",
                        mm(std::max(0.0, hi - lo)), mm(e.tolerances->min_length_mm)),
            "draw A–B and E–F opposite each other, on either side of the fold");
        return false;
    }
    double off = 0.0;
    for (const SitePoint& p : e.on) off = std::max(off, std::min(std::abs(p.s - lo), std::abs(p.s - hi)));
    set_stretch(e, lo, hi);
    if (off > e.tolerances->rounding_mm) {
        e.repaired(
            "walls-not-opposite",
            fmt::format("one of its walls begins or ends {} further along the fold than the other; both "
                        "now have the stretch that they have in common, {} long",
                        mm(off), mm(hi - lo)),
            "make A–B as long as E–F, and let them begin at the same place along the fold");
    }
    return true;
}

// The ends meet in the middle of the closed box where its walls are not as long as two halves are wide.
void keep_ends_apart(Element& e) {
    const Measures m = measures(e);
    if (!m.inwards || 2.0 * m.near <= m.length()) return;
    const double near = 0.5 * m.length();
    for (SitePoint& p : e.on) p.w = near;
    if (m.near - near <= 0.5 * e.tolerances->rounding_mm) return;
    e.repaired(
        "ends-meet",
        fmt::format("its ends fold inwards by {} each, and its walls are {} long, so that the ends would "
                    "meet in the closed box; its walls now stand {} away from the fold",
                    mm(m.near), mm(m.length()), mm(near)),
        "make the walls longer, put them nearer to the fold, or let the ends fold outwards: ends=\"out\"");
}

bool constrain(Element& e) {
    const auto stand = [](Element& box) {
        two_seams::make_even(box, "fold, and its walls fold flat only at the same distance");
        if (!make_opposite(box)) return false;
        keep_ends_apart(box);
        return true;
    };
    if (!two_seams::constrain_page(e, stand,
                                   "there is no paper under both of its walls where they stand opposite"))
        return false;
    const Measures m = measures(e);
    if (m.near < e.tolerances->min_length_mm) {
        e.failed("degenerate",
                 fmt::format("its walls stand {} away from the fold; the least is {}", mm(m.near),
                             mm(e.tolerances->min_length_mm)),
                 "put A, B left and E, F right of the fold");
        return false;
    }
    if (m.rise > 0.0 && m.height - m.rise < e.tolerances->min_length_mm) {
        e.failed("degenerate",
                 fmt::format("it is {} high, and on a mountain fold its ends are cut out {} high at their "
                             "middle folds, so that it can close over the fold",
                             mm(m.height), mm(m.rise)),
                 fmt::format("make it higher than {}, or put its walls nearer to the fold",
                             mm(m.rise + e.tolerances->min_length_mm)));
        return false;
    }
    return true;
}

FoldLines fold_lines(const Element& e) {
    const Measures m = measures(e);
    const auto upright = [&](double x, double from) { return Segment{{x, from}, {x, m.height}}; };
    const auto plain = [](const Segment& at, int closed) { return FoldLine{at, at, closed}; };
    const int seams = e.site.mountain ? 180 : 0;
    const int corners = m.inwards ? 360 : 180;
    const int middles = m.inwards ? 0 : 360;
    return {{walls::foot_line(e, Side::left, m.lo, m.hi), {{m.front_left(), 0.0}, {0.0, 0.0}}, seams},
            {{{m.front_right(), 0.0}, {m.back_right(), 0.0}},
             walls::foot_line(e, Side::right, m.lo, m.hi),
             seams},
            plain(upright(m.front_left(), 0.0), corners),
            plain(upright(m.front(), m.rise), middles),
            plain(upright(m.front_right(), 0.0), corners),
            plain(upright(m.back_right(), 0.0), corners),
            plain(upright(m.back(), m.rise), middles)};
}

struct Plates {
    int left, right, front_left, front_right, back_right, back_left;
};

Plates add_plates(const Element& e, const Measures& m, int piece, Builder& builder) {
    const auto plate = [&](std::string_view name, double from, double to, double foot_from, double foot_to,
                           std::optional<Color> color) {
        const Ring ring{{from, foot_from}, {to, foot_to}, {to, m.height}, {from, m.height}};
        return builder.add_plate(fmt::format("{}/{}", e.paint.id, name), piece, e.extra_page, {ring, {}},
                                 color);
    };
    Plates made{};
    made.left = plate("left", 0.0, m.front_left(), 0.0, 0.0, e.paint.left);
    const auto end = color_of(e, "endcolor");
    const auto left_end = end ? end : e.paint.left;
    const auto right_end = end ? end : e.paint.right;
    made.front_left = plate("front-left", m.front_left(), m.front(), 0.0, m.rise, left_end);
    made.front_right = plate("front-right", m.front(), m.front_right(), m.rise, 0.0, right_end);
    made.right = plate("right", m.front_right(), m.back_right(), 0.0, 0.0, e.paint.right);
    made.back_right = plate("back-right", m.back_right(), m.back(), 0.0, m.rise, right_end);
    made.back_left = plate("back-left", m.back(), m.back_left(), m.rise, 0.0, left_end);
    return made;
}

void add_cuts(const Measures& m, int piece, Builder& builder) {
    builder.add_cut(piece, {{0.0, m.height}, {m.back_left(), m.height}});
    builder.add_cut(piece, {{0.0, 0.0}, {0.0, m.height}});
    builder.add_cut(piece, {{m.front_left(), 0.0}, {m.front(), m.rise}});
    builder.add_cut(piece, {{m.front(), m.rise}, {m.front_right(), 0.0}});
    builder.add_cut(piece, {{m.back_right(), 0.0}, {m.back(), m.rise}});
    builder.add_cut(piece, {{m.back(), m.rise}, {m.back_left(), 0.0}});
}

void lower(const Element& e, Builder& builder) {
    const Measures m = measures(e);
    const FoldLines lines = fold_lines(e);
    const Site& site = e.site;
    const std::string& id = e.paint.id;
    const int piece = builder.add_piece(id);
    const Plates plates = add_plates(e, m, piece, builder);
    add_cuts(m, piece, builder);

    const auto fold = [&](BoxFolds which, int left, int right) {
        add_fold_of(e, builder, lines, which, {left, right});
    };
    fold(kLeft, site.left_plate, plates.left);
    fold(kRight, plates.right, site.right_plate);
    fold(kFrontLeft, plates.left, plates.front_left);
    fold(kFront, plates.front_left, plates.front_right);
    fold(kFrontRight, plates.front_right, plates.right);
    fold(kBackRight, plates.right, plates.back_right);
    fold(kBack, plates.back_right, plates.back_left);
    glue_seams(e, builder, {lines[kLeft], plates.left}, {lines[kRight], plates.right});
    builder.add_foot({plates.back_left,
                      plates.left,
                      {{m.back_left(), m.height}, {m.back_left(), 0.0}},
                      {{0.0, m.height}, {0.0, 0.0}},
                      e.label + "B",
                      e.paint.left_tab,
                      id,
                      e.paint.place,
                      true});

    Prism prism;
    prism.outside = site.mountain;
    prism.left = walls::upright(site, Side::left, {m.lo, m.near}, {m.front_left(), 0}, {-1, 0}, {0, 1});
    prism.right = walls::upright(site, Side::right, {m.lo, m.near}, {m.front_right(), 0}, {1, 0}, {0, 1});
    prism.left.plate = plates.left;
    prism.right.plate = plates.right;
    const int into = m.inwards ? 1 : -1;
    prism.begin = {0.0,
                   into,
                   {plates.front_left, {m.front_left(), 0}, {0, 1}, {1, 0}},
                   {plates.front_right, {m.front_right(), 0}, {0, 1}, {-1, 0}}};
    prism.end = {m.length(),
                 -into,
                 {plates.back_left, {m.back_left(), 0}, {0, 1}, {-1, 0}},
                 {plates.back_right, {m.back_right(), 0}, {0, 1}, {1, 0}}};
    builder.add_joint({id, e.paint.place, prism});
}

constexpr MeasureInfo kBoxWidth{.name = "width", .about = "how far its walls are apart", .share = 0.2};
constexpr std::array<MeasureInfo, 3> kMeasures{{measure::kAt, measure::kLength, kBoxWidth}};

std::vector<double> measured(const Element& e) {
    const measure::TwoSides m = measure::two_sides(e);
    return {m.at, m.length, m.width};
}

void shape(Element& e, std::span<const double> v) { measure::set_two_sides(e, {v[0], v[1], v[2]}); }

}  // namespace

const ElementRow kBox = {
    {.name = "box",
     .code = -1,
     .family = "box",
     .inverted = false,
     .glued = true,
     .about = "four upright walls on two planes, open above; its ends fold in the middle",
     .points = walls::kPoints,
     .partners = walls::kPartners,
     .grounds = {.seam = true},
     .parameters = kParameters,
     .folds = kFolds,
     .since = "3.0",
     .measures = kMeasures,
     .plates = kPlates},
    two_seams::stands_on,
    constrain,
    fold_lines,
    drawn_from_front,
    lower,
    nullptr,
    measured,
    shape};

}  // namespace popup
