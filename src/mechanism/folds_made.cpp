// Where elements make folds, for who lets others stand on them before anything is checked.
#include <cmath>
#include <tuple>

#include "mechanism/element.h"

namespace popup {
namespace {

Site site_on(const PageFold& fold) {
    Site site;
    site.left = {fold.on_left.a, unit(fold.on_left.b - fold.on_left.a)};
    site.right = {fold.on_right.a, unit(fold.on_right.b - fold.on_right.a)};
    site.left_page = fold.left_page;
    site.right_page = fold.right_page;
    site.length = distance(fold.on_left.a, fold.on_left.b);
    site.mountain = fold.closed_deg == 360;
    site.seam = fold.seam;
    return site;
}

// Long enough to have a direction; false of what is not a number, too.
bool is_line(const Segment& s) {
    const double size = distance(s.a, s.b);
    return size > 1e-9 && std::isfinite(size);
}

}  // namespace

std::pair<int, int> pages_of_fold(const Element& element, FoldRole role) {
    const Site& site = element.site;
    if (!element.info->glued) return {site.left_page, site.left_page};
    return {role == kLeftFold ? site.left_page : element.extra_page,
            role == kRightFold ? site.right_page : element.extra_page};
}

std::optional<std::array<PageFold, 3>> folds_made(const ElementInfo& info, const PageFold& parent,
                                                  int extra_page, std::span<const Vec2> points) {
    POPUP_INVARIANT(points.size() == info.points.size());
    static const Tolerances kTolerances;
    Element element;
    element.info = &info;
    element.site = site_on(parent);
    element.extra_page = extra_page;
    element.inverted = info.inverted;
    element.tolerances = &kTolerances;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (info.points[i].page == PointPage::extra) {
            element.extra.push_back(points[i]);
        } else {
            const Side side = info.points[i].side == 'R' ? Side::right : Side::left;
            element.on.push_back(element.site.from_page(side, points[i]));
        }
    }
    const FoldLines lines = element_row(info).fold_lines(element);
    std::array<PageFold, 3> made;
    for (const FoldRole role : {kLeftFold, kCentreFold, kRightFold}) {
        PageFold& fold = made[role];
        fold.on_left = lines[role].on_left;
        fold.on_right = lines[role].on_right;
        if (!is_line(fold.on_left) || !is_line(fold.on_right)) return std::nullopt;
        std::tie(fold.left_page, fold.right_page) = pages_of_fold(element, role);
        fold.seam = info.glued && role != kCentreFold;
        fold.closed_deg = lines[role].closed_deg;
    }
    return made;
}

}  // namespace popup
