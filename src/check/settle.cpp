// How a structure settles on the fold or plate that was found for it.
#include <fmt/format.h>

#include <algorithm>

#include "check/placing.h"
#include "mechanism/arguments.h"
#include "mechanism/site_lines.h"

namespace popup {
namespace {

Placed placed_by(const RigidMove& move) {
    const Vec2 at = move.apply({});
    const Vec2 x = move.apply({1, 0}) - at;
    const Vec2 y = move.apply({0, 1}) - at;
    return {x.x, x.y, y.x, y.y, at.x, at.y};
}

}  // namespace

// Every point of the fold's page must lie on one of the pages that meet there.
bool Placing::points_are_on_pages_of_ground(Diagnostics& diagnostics) const {
    const Site& site = element.site;
    for (std::size_t i = 0; i < points_.size(); ++i) {
        const int page = points_[i].page;
        if (element.info->points[i].page == PointPage::extra || page == site.left_page ||
            page == site.right_page)
            continue;
        diagnostics
            .error("wrong-page", structure_->points[i].place,
                   fmt::format("point {} of \"{}\" is on page {}, but its parent {} is on page{} {}",
                               letters_[i], structure_->id, page, site.on_plate ? "plate" : "fold",
                               site.seam ? "s" : "",
                               site.seam ? fmt::format("{} and {}", site.left_page, site.right_page)
                                         : fmt::format("{}", site.left_page)))
            .hint("leave out the point's page, or give the page its plane is drawn on")
            .about(structure_->id);
        return false;
    }
    for (std::size_t i = 0; i < element.arguments.size(); ++i) {
        const Argument& argument = element.arguments[i];
        const bool extra = element.info->parameters[i].page == PointPage::extra;
        const int page = argument.page.value_or(extra ? element.extra_page : site.left_page);
        if (extra ? page == element.extra_page : page == site.left_page || page == site.right_page) continue;
        diagnostics
            .error("wrong-page", argument.place,
                   fmt::format("the {} of \"{}\" is on page {}, and must be on page {}",
                               element.info->parameters[i].name, structure_->id, page,
                               extra ? element.extra_page : site.left_page))
            .hint("leave out its page")
            .about(structure_->id);
        return false;
    }
    return true;
}

// Reads an element whose gutter was given downwards the other way round.
void Placing::turn(Diagnostics& diagnostics) {
    exchange(true);
    for (auto* list : {&points_, &authored_}) {
        for (std::size_t i = 0; i < list->size(); ++i) {
            if (element.info->points[i].page == PointPage::extra) (*list)[i].at = mirrored((*list)[i].at);
        }
    }
    exchange_arguments();
    std::swap(element.paint.left, element.paint.right);
    std::swap(element.paint.left_tab, element.paint.right_tab);
    if (element.info->glued && has_inverse(*element.info)) element.inverted = !element.inverted;
    diagnostics
        .remark("fold-turned", structure_->fold.place,
                fmt::format(
                    "\"{}\" gives the gutter downwards; it is read upwards, with left and right exchanged",
                    structure_->id))
        .about(structure_->id);
}

void Placing::exchange_arguments() {
    const auto parameters = element.info->parameters;
    for (std::size_t i = 0; i < parameters.size(); ++i) {
        if (parameters[i].page == PointPage::extra) move_argument(element.arguments[i], kMirrored);
        const auto partner = find_parameter(*element.info, parameters[i].partner);
        if (partner && *partner > i) std::swap(element.arguments[i], element.arguments[*partner]);
        if (partner && *partner == i) {
            const auto words = parameters[i].words;
            const bool first = choice_of(element, parameters[i].name) == words[0];
            element.arguments[i].value = std::string(words[first ? 1 : 0]);
        }
    }
}

// What stands on a fold or plate that a repair has moved moves with it.
void Placing::move_with(const RigidMove& left, int left_page, const RigidMove& right) {
    for (std::size_t i = 0; i < points_.size(); ++i) {
        if (element.info->points[i].page == PointPage::fold)
            points_[i].at = (points_[i].page == left_page ? left : right).apply(points_[i].at);
    }
    for (std::size_t i = 0; i < element.arguments.size(); ++i) {
        Argument& argument = element.arguments[i];
        const int page = argument.page.value_or(structure_->ground_page());
        const RigidMove& move = page == left_page ? left : right;
        if (!is_drawn(argument) || move.identity || element.info->parameters[i].page == PointPage::extra)
            continue;
        move_argument(argument, placed_by(move));
        argument.changed = true;
    }
}

bool Placing::points_moved(const Tolerances& tolerances) const {
    const auto now = page_points();
    for (std::size_t i = 0; i < now.size(); ++i) {
        if (distance(now[i].at, reported_[i].at) > tolerances.rounding_mm) return true;
    }
    return false;
}

bool Placing::drawn_moved() const {
    return std::any_of(element.arguments.begin(), element.arguments.end(),
                       [](const Argument& a) { return a.changed && is_drawn(a); });
}

void Placing::snap_to(const FoldMatch& match, const Fold& fold, const Tolerances& tolerances) {
    if (match.off <= tolerances.rounding_mm) return;
    const Site& site = element.site;
    const bool given_left =
        structure_->fold.page == site.left_page && !(site.seam && match.right_page != site.reversed);
    const Side side = given_left ? Side::left : Side::right;
    const auto onto = [&](Vec2 p) {
        const SitePoint at = site.from_page(side, p);
        return site.on_page(side, {std::clamp(at.s, 0.0, site.length), 0.0});
    };
    const std::string before = text(structure_->fold.begin.at) + " to " + text(structure_->fold.end.at);
    fold_begin_ = onto(fold_begin_);
    fold_end_ = onto(fold_end_);
    fold_moved_ = true;
    element.repaired(
        "fold-snapped",
        fmt::format("its parent fold was given as {}, {} off the {} of \"{}\"; it now runs from {} to {}",
                    before, mm(match.off), fold.seam ? "seam" : "fold", fold.owner, text(fold_begin_),
                    text(fold_end_)),
        "give two points of the fold itself");
}

bool Placing::all_on_wrong_side(const Tolerances& tolerances) const {
    const Site& site = element.site;
    bool any = false;
    for (std::size_t i = 0; i < points_.size(); ++i) {
        const PointInfo& info = element.info->points[i];
        if (info.page == PointPage::extra || info.side == '-') continue;
        any = true;
        const bool left = info.side == 'L';
        if (site.seam) {
            if (points_[i].page != (left ? site.right_page : site.left_page)) return false;
        } else if (element.on[index_on(i)].w > -tolerances.rounding_mm) {
            return false;
        }
    }
    return any;
}

// What the author gave one side is now given the other, and is written so. Whether there was any.
bool Placing::exchange_values() {
    const auto parameters = element.info->parameters;
    bool any = false;
    for (std::size_t i = 0; i < parameters.size(); ++i) {
        const auto partner = find_parameter(*element.info, parameters[i].partner);
        if (!partner || *partner <= i || *partner >= element.arguments.size()) continue;
        Argument& one = element.arguments[i];
        Argument& other = element.arguments[*partner];
        if (is_drawn(one) || is_drawn(other) || (!one.given() && !other.given())) continue;
        std::swap(one.value, other.value);
        one.changed = other.changed = any = true;
    }
    std::swap(element.paint.left, element.paint.right);
    std::swap(element.paint.left_tab, element.paint.right_tab);
    return any;
}

// Points are where they are; their names may have to change. What is between them keeps its colour: of an
// element that is drawn the other way round, the plate that was its left one is its right one now.
void Placing::exchange_sides(const Tolerances& tolerances) {
    if (!all_on_wrong_side(tolerances)) return;
    const ElementRow& row = element_row(*element.info);
    const bool extra_too = row.front != nullptr && row.front(element) < 0.0;
    exchange(extra_too);
    to_site();
    const bool coloured = (extra_too || !element.info->glued) && exchange_values();
    element.repaired("sides-exchanged",
                     fmt::format("its left points lie right of the parent fold and its right points left of "
                                 "it; they were exchanged{}",
                                 coloured ? ", with the colours of the two sides" : ""),
                     "left is the left-hand side when looking from the fold's begin to its end");
}

bool Placing::points_are_on_pages_of_seam(Diagnostics& diagnostics) const {
    const Site& site = element.site;
    for (std::size_t i = 0; i < points_.size(); ++i) {
        const PointInfo& info = element.info->points[i];
        if (info.page == PointPage::extra || info.side == '-' || !site.seam) continue;
        const int page = info.side == 'L' ? site.left_page : site.right_page;
        if (points_[i].page == page) continue;
        diagnostics
            .error("wrong-page", structure_->points[i].place,
                   fmt::format("point {} of \"{}\" is on page {}, but the {} side of its seam is on page {}",
                               letters_[i], structure_->id, points_[i].page,
                               info.side == 'L' ? "left" : "right", page))
            .hint(fmt::format("give the point page=\"{}\", in that page's coordinates", page))
            .about(structure_->id);
        return false;
    }
    return true;
}

void Placing::correct_form() {
    const Site& site = element.site;
    if (element.info->glued || element.inverted == site.mountain || !has_inverse(*element.info)) return;
    element.inverted = site.mountain;
    element.repaired("wrong-form",
                     fmt::format("it is a{} {} on a {} fold; its form was corrected",
                                 element.info->inverted ? "n inverted" : "", element.info->family,
                                 site.mountain ? "mountain" : "valley"),
                     "inverted forms stand on mountain folds, the others on valley folds");
}

bool Placing::settle(const FoldMatch& match, const Fold& fold, const Tolerances& tolerances,
                     Diagnostics& diagnostics) {
    if (!points_are_on_pages_of_ground(diagnostics)) return false;
    if (turned) turn(diagnostics);
    move_with(match.left, fold.left_page, match.right);
    const RigidMove& fold_move = match.right_page ? match.right : match.left;
    fold_begin_ = fold_move.apply(fold_begin_);
    fold_end_ = fold_move.apply(fold_end_);
    const Vec2 written = read_mirrored(structure_->fold.page) ? mirrored(fold_begin_) : fold_begin_;
    fold_moved_ = distance(written, structure_->fold.begin.at) > 0.0 || !fold_move.identity;
    to_site();
    if (match.follows_mm > 0.0) {
        element.repaired(
            "moved-with-fold",
            fmt::format("the fold of \"{}\" that it stood on now lies {} away; it follows as a whole",
                        fold.owner, mm(match.follows_mm)),
            fmt::format("move what stands on \"{}\" along with it, as popupc edit does with "
                        "--follow",
                        fold.owner));
    } else if (points_moved(tolerances) || drawn_moved()) {
        element.repaired(
            "moved-with-fold",
            fmt::format("the fold of \"{}\" it stands on was moved by a repair; it keeps its place on it",
                        fold.owner),
            fmt::format("mend \"{}\" first", fold.owner));
    }
    snap_to(match, fold, tolerances);
    exchange_sides(tolerances);
    if (!points_are_on_pages_of_seam(diagnostics)) return false;
    correct_form();
    return true;
}

bool Placing::settle(const PlateMatch& match, const std::string& owner, const Tolerances& tolerances,
                     Diagnostics& diagnostics) {
    if (!points_are_on_pages_of_ground(diagnostics)) return false;
    const int page = element.site.left_page;
    move_with(match.move, page, match.move);
    fold_begin_ = fold_end_ = match.move.apply(fold_begin_);
    const Vec2 written = read_mirrored(page) ? mirrored(fold_begin_) : fold_begin_;
    fold_moved_ = distance(written, structure_->plate->at.at) > 0.0;
    to_site();
    if (points_moved(tolerances) || drawn_moved() || !match.move.identity) {
        element.repaired(
            "moved-with-fold",
            fmt::format("the plate of \"{}\" it stands on was moved by a repair; it keeps its place on it",
                        owner),
            fmt::format("mend \"{}\" first", owner));
    }
    return true;
}

}  // namespace popup
