#include "mechanism/shapes.h"

#include <cmath>

#include "mechanism/silhouette.h"

namespace popup {

Bar angled_bar(const Site& site, Side side, double apex_s, int dir, SitePoint seam_end, Vec2 own_apex,
               Vec2 own_seam_end, Vec2 own_centre_end) {
    const DirectedLine& line = side == Side::left ? site.left : site.right;
    Bar bar;
    bar.drive = side == Side::left ? site.left_plate : site.right_plate;
    bar.fold_at = site.on_page(side, {apex_s, 0.0});
    bar.fold_dir = static_cast<double>(dir) * line.dir;
    bar.fold_out = side == Side::left ? left_of(line.dir) : right_of(line.dir);
    bar.seam_at = bar.fold_at;
    bar.seam_dir = unit(site.on_page(side, seam_end) - bar.fold_at);
    bar.own_at = own_apex;
    bar.own_seam = unit(own_seam_end - own_apex);
    bar.own_centre = unit(own_centre_end - own_apex);
    bar.near = angle_at(apex_s, dir, seam_end);
    bar.far = std::abs(std::atan2(cross(bar.own_seam, bar.own_centre), dot(bar.own_seam, bar.own_centre)));
    return bar;
}

Bar parallel_bar(const Site& site, Side side, SitePoint seam_point, Vec2 own_point, Vec2 own_along,
                 Vec2 own_across, double far) {
    const DirectedLine& line = side == Side::left ? site.left : site.right;
    Bar bar;
    bar.drive = side == Side::left ? site.left_plate : site.right_plate;
    bar.fold_at = site.on_page(side, {seam_point.s, 0.0});
    bar.fold_dir = line.dir;
    bar.fold_out = side == Side::left ? left_of(line.dir) : right_of(line.dir);
    bar.seam_at = site.on_page(side, seam_point);
    bar.seam_dir = line.dir;
    bar.own_at = own_point;
    bar.own_seam = own_along;
    bar.own_centre = own_across;
    bar.near = seam_point.w;
    bar.far = far;
    return bar;
}

FoldLines slit_folds(const Site& site, Segment left, Segment centre, Segment right) {
    const int like = site.mountain ? 360 : 0;
    return {{left, left, like}, {centre, centre, 360 - like}, {right, right, like}};
}

SlitPlates lower_slit(const Element& element, Builder& builder, const FoldLines& folds, SlitShape shape) {
    const Site& site = element.site;
    const int page = site.left_page;
    const int piece = builder.skeleton().draft.plates[static_cast<std::size_t>(site.left_plate)].piece;
    const std::string& id = element.paint.id;
    const int left =
        builder.add_plate(id + "/left", piece, page, {std::move(shape.left), {}}, element.paint.left);
    const int right =
        builder.add_plate(id + "/right", piece, page, {std::move(shape.right), {}}, element.paint.right);
    builder.add_cut_out(site.left_plate, site.fold, std::move(shape.gone_left));
    builder.add_cut_out(site.right_plate, site.fold, std::move(shape.gone_right));
    for (const Segment& cut : shape.cuts) builder.add_cut(piece, cut);
    const auto [lo, hi] = shape.span;
    builder.add_gone(site.fold, site.reversed ? site.length - hi : lo, site.reversed ? site.length - lo : hi,
                     id);

    const auto fold = [&](ThreeFolds role, int left_plate, int right_plate) {
        const FoldLine& line = folds[role];
        builder.add_fold({left_plate,
                          right_plate,
                          page,
                          page,
                          line.on_left,
                          line.on_right,
                          line.closed_deg,
                          false,
                          id,
                          {}});
    };
    fold(kLeftFold, site.left_plate, left);
    fold(kCentreFold, left, right);
    fold(kRightFold, right, site.right_plate);

    FourBar bars{Closing::half_turn, shape.parallel, shape.left_bar, shape.right_bar};
    bars.left.plate = left;
    bars.right.plate = right;
    builder.add_joint({id, element.paint.place, bars});
    return {left, right};
}

void lower_glued(const Element& element, Builder& builder, const FoldLines& folds, GluedShape shape) {
    const Site& site = element.site;
    const std::string& id = element.paint.id;
    const int page = element.extra_page;
    const int piece = builder.add_piece(id);
    Halves& halves = shape.halves;
    halves.left.holes = std::move(shape.holes.left);
    halves.right.holes = std::move(shape.holes.right);
    halves.edges.insert(halves.edges.end(), shape.holes.edges.begin(), shape.holes.edges.end());
    const int left = builder.add_plate(id + "/left", piece, page, std::move(halves.left), element.paint.left);
    const int right =
        builder.add_plate(id + "/right", piece, page, std::move(halves.right), element.paint.right);
    builder.add_curves(curves_of(element, "outline"));
    builder.add_curves(curves_of(element, "hole"));
    for (const Segment& edge : halves.edges) builder.add_cut(piece, edge);

    const FoldLine& l = folds[kLeftFold];
    const FoldLine& c = folds[kCentreFold];
    const FoldLine& r = folds[kRightFold];
    builder.add_fold(
        {site.left_plate, left, site.left_page, page, l.on_left, l.on_right, l.closed_deg, true, id, {}});
    const int centre =
        builder.add_fold({left, right, page, page, c.on_left, c.on_right, c.closed_deg, false, id, {}});
    for (HoleAcross& hole : shape.holes.across) {
        builder.add_cut_out(left, centre, std::move(hole.left));
        builder.add_cut_out(right, centre, std::move(hole.right));
        builder.add_gone(centre, hole.from, hole.to, id);
    }
    builder.add_fold(
        {right, site.right_plate, page, site.right_page, r.on_left, r.on_right, r.closed_deg, true, id, {}});

    // Glue looks along the seam with the piece on its right: the tab then lies on the left of it on the
    // piece's page, and covers the right of it on the base.
    const auto turned = [](const Segment& s) { return Segment{s.b, s.a}; };
    builder.add_glue({left, site.left_plate, l.on_right, l.on_left, element.label + "L",
                      element.paint.left_tab, id, element.paint.place});
    builder.add_glue({right, site.right_plate, turned(r.on_left), turned(r.on_right), element.label + "R",
                      element.paint.right_tab, id, element.paint.place});

    const Closing closing = shape.right_angle ? Closing::half_turn
                            : site.mountain   ? Closing::outside
                                              : Closing::inside;
    FourBar bars{closing, shape.parallel, shape.left_bar, shape.right_bar};
    bars.left.plate = left;
    bars.right.plate = right;
    builder.add_joint({id, element.paint.place, bars});
}

}  // namespace popup
