#include "mechanism/shapes.h"

#include <fmt/format.h>

#include <cmath>
#include <tuple>

#include "mechanism/silhouette.h"

namespace popup {

Bar angled_bar(const Site& site, Side side, double apex_s, int dir, SitePoint seam_end, Vec2 own_apex,
               Vec2 own_seam_end, Vec2 own_centre_end) {
    const Vec2 along = site.line(side).dir;
    Bar bar;
    bar.drive = site.plate(side);
    bar.fold_at = site.on_page(side, {apex_s, 0.0});
    bar.fold_dir = static_cast<double>(dir) * along;
    bar.fold_out = site.out(side);
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
    const Vec2 along = site.line(side).dir;
    Bar bar;
    bar.drive = site.plate(side);
    bar.fold_at = site.on_page(side, {seam_point.s, 0.0});
    bar.fold_dir = along;
    bar.fold_out = site.out(side);
    bar.seam_at = site.on_page(side, seam_point);
    bar.seam_dir = along;
    bar.own_at = own_point;
    bar.own_seam = own_along;
    bar.own_centre = own_across;
    bar.near = seam_point.w;
    bar.far = far;
    return bar;
}

int add_fold_of(const Element& element, Builder& builder, const FoldLines& folds, std::size_t which,
                PlatesOfFold plates) {
    const FoldInfo& info = element.info->folds[which];
    const FoldLine& line = folds[which];
    Fold fold;
    fold.left_plate = plates.left;
    fold.right_plate = plates.right;
    std::tie(fold.left_page, fold.right_page) = pages_of_fold(element, info);
    fold.on_left = line.on_left;
    fold.on_right = line.on_right;
    fold.closed_deg = line.closed_deg;
    fold.seam = is_seam(*element.info, info);
    fold.owner = element.paint.id;
    return builder.add_fold(std::move(fold));
}

void glue_seams(const Element& element, Builder& builder, const SeamOfPlate& left, const SeamOfPlate& right) {
    const Site& site = element.site;
    const ElementPaint& paint = element.paint;
    // Glue looks along the seam with the piece on its right: the tab then lies on the left of it on the
    // piece's page, and covers the right of it on the base.
    const auto turned = [](const Segment& s) { return Segment{s.b, s.a}; };
    builder.add_glue({left.plate, site.left_plate, left.line.on_right, left.line.on_left, element.label + "L",
                      paint.left_tab, paint.id, paint.place});
    builder.add_glue({right.plate, site.right_plate, turned(right.line.on_left), turned(right.line.on_right),
                      element.label + "R", paint.right_tab, paint.id, paint.place});
}

FoldLines slit_folds(const Site& site, Segment left, Segment centre, Segment right) {
    const int like = site.mountain ? 360 : 0;
    return {{left, left, like}, {centre, centre, 360 - like}, {right, right, like}};
}

namespace {

void lower_more(const Element& element, Builder& builder, const FoldLines& folds, SlitShape& shape,
                SlitPlates first) {
    const Site& site = element.site;
    const int piece = builder.skeleton().draft.plates[static_cast<std::size_t>(site.left_plate)].piece;
    const bool on_left = shape.more_on == Side::left;
    const int base = on_left ? first.left : first.right;
    std::vector<int> plates{first.left, first.right};
    for (Ring& ring : shape.more) {
        const std::string name =
            fmt::format("{}/{}-{}", element.paint.id, on_left ? "left" : "right", plates.size());
        const int plate = builder.add_plate(name, piece, site.left_page, {std::move(ring), {}},
                                            on_left ? element.paint.left : element.paint.right);
        const Vec2 at = folds[on_left ? kLeftFold : kRightFold].on_left.a;
        Rigid lies{plate, base, at, site.left.dir, at, site.left.dir};
        lies.beside = true;
        builder.add_joint({element.paint.id, element.paint.place, lies});
        plates.push_back(plate);
    }
    for (const SlitFold& fold : shape.more_folds) {
        FoldLines lines = folds;
        lines[fold.which].on_left = lines[fold.which].on_right = fold.line;
        const int own = plates[fold.plate];
        const PlatesOfFold between = fold.which == kLeftFold    ? PlatesOfFold{site.left_plate, own}
                                     : fold.which == kRightFold ? PlatesOfFold{own, site.right_plate}
                                                                : PlatesOfFold{own, plates[fold.other]};
        add_fold_of(element, builder, lines, fold.which, between);
    }
}

}  // namespace

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

    add_fold_of(element, builder, folds, kLeftFold, {site.left_plate, left});
    add_fold_of(element, builder, folds, kCentreFold, {left, right});
    add_fold_of(element, builder, folds, kRightFold, {right, site.right_plate});

    FourBar bars{Closing::half_turn, shape.parallel, shape.left_bar, shape.right_bar};
    bars.left.plate = left;
    bars.right.plate = right;
    builder.add_joint({id, element.paint.place, bars});
    if (!shape.more.empty() || !shape.more_folds.empty())
        lower_more(element, builder, folds, shape, {left, right});
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

    add_fold_of(element, builder, folds, kLeftFold, {site.left_plate, left});
    const int centre = add_fold_of(element, builder, folds, kCentreFold, {left, right});
    for (HoleAcross& hole : shape.holes.across) {
        builder.add_cut_out(left, centre, std::move(hole.left));
        builder.add_cut_out(right, centre, std::move(hole.right));
        builder.add_gone(centre, hole.from, hole.to, id);
    }
    add_fold_of(element, builder, folds, kRightFold, {right, site.right_plate});
    glue_seams(element, builder, {folds[kLeftFold], left}, {folds[kRightFold], right});

    const Closing closing = shape.right_angle ? Closing::half_turn
                            : site.mountain   ? Closing::outside
                                              : Closing::inside;
    FourBar bars{closing, shape.parallel, shape.left_bar, shape.right_bar};
    bars.left.plate = left;
    bars.right.plate = right;
    builder.add_joint({id, element.paint.place, bars});
}

}  // namespace popup
