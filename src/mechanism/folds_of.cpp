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

Element element_on(const ElementInfo& info, const PageFold& parent, int extra_page,
                   std::span<const Vec2> points, std::span<const Argument> arguments) {
    POPUP_INVARIANT(points.size() == info.points.size());
    static const Tolerances kTolerances;
    Element element;
    element.info = &info;
    element.site = site_on(parent);
    element.extra_page = extra_page;
    element.inverted = info.inverted;
    element.tolerances = &kTolerances;
    element.arguments.assign(arguments.begin(), arguments.end());
    element.arguments.resize(info.parameters.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (info.points[i].page == PointPage::extra) {
            element.extra.push_back(points[i]);
        } else {
            const Side side = info.points[i].side == 'R' ? Side::right : Side::left;
            element.on.push_back(element.site.from_page(side, points[i]));
        }
    }
    return element;
}

std::pair<int, int> pages_of_fold(const Element& element, const FoldInfo& fold) {
    const Site& site = element.site;
    if (!element.info->glued) return {site.left_page, site.left_page};
    return {fold.on_left == PointPage::fold ? site.left_page : element.extra_page,
            fold.on_right == PointPage::fold ? site.right_page : element.extra_page};
}

bool is_seam(const ElementInfo& info, const FoldInfo& fold) {
    return info.glued && fold.on_left != fold.on_right;
}

std::optional<std::vector<PageFold>> folds_of(const ElementInfo& info, const PageFold& parent, int extra_page,
                                              std::span<const Vec2> points,
                                              std::span<const Argument> arguments) {
    const Element element = element_on(info, parent, extra_page, points, arguments);
    const FoldLines lines = element_row(info).fold_lines(element);
    POPUP_INVARIANT(lines.size() == info.folds.size());
    std::vector<PageFold> made;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        PageFold& fold = made.emplace_back();
        fold.on_left = lines[i].on_left;
        fold.on_right = lines[i].on_right;
        if (!is_line(fold.on_left) || !is_line(fold.on_right)) return std::nullopt;
        std::tie(fold.left_page, fold.right_page) = pages_of_fold(element, info.folds[i]);
        fold.seam = is_seam(info, info.folds[i]);
        fold.closed_deg = lines[i].closed_deg;
    }
    return made;
}

}  // namespace popup
