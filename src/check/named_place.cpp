#include "check/named_place.h"

#include "mechanism/arguments.h"

namespace popup {
namespace {

bool is_set(const std::vector<bool>& pages, int page) {
    return page >= 0 && static_cast<std::size_t>(page) < pages.size() &&
           pages[static_cast<std::size_t>(page)];
}

// From beside a line to its page: x to its right, y along it.
Placed onto(Vec2 middle, Vec2 along) {
    const Vec2 right = right_of(along);
    return {right.x, right.y, along.x, along.y, middle.x, middle.y};
}

Placed inverse(const Placed& m) {  // of a turn with a shift
    return {m[0], m[2], m[1], m[3], -(m[0] * m[4] + m[1] * m[5]), -(m[2] * m[4] + m[3] * m[5])};
}

Vec2 image_of(const Placed& m, Vec2 p) {
    return {m[0] * p.x + m[2] * p.y + m[4], m[1] * p.x + m[3] * p.y + m[5]};
}

}  // namespace

NamedPlace::NamedPlace(const Structure& structure, const ElementInfo& info, const PageFold& fold,
                       const PageTurns& turns)
    : info_(&info), fold_(fold), points_(structure.points), arguments_(structure.arguments) {
    const auto side = [&](const Segment& line, int page) {
        return Side{page, lerp(line.a, line.b, 0.5), unit(line.b - line.a), is_set(turns.mirrored, page),
                    is_set(turns.redrawn, page)};
    };
    left_ = side(fold.on_left, fold.left_page);
    right_ = side(fold.on_right, fold.right_page);
}

const NamedPlace::Side& NamedPlace::side_of(std::size_t point) const {
    return info_->points[point].side == 'R' ? right_ : left_;
}

Vec2 NamedPlace::written(Vec2 on_page, bool right) const {
    const Side& side = right ? right_ : left_;
    return image_of(inverse(onto(side.middle, side.along)), on_page);
}

void NamedPlace::lay(Structure& structure) const {
    // As a document has it: mirrored where its page is read or mended so.
    const auto drawn = [](const Side& side, Vec2 p) { return side.turned != side.mended ? mirrored(p) : p; };
    for (std::size_t i = 0; i < structure.points.size(); ++i) {
        if (info_->points[i].page == PointPage::extra) continue;
        const Side& side = side_of(i);
        structure.points[i].at = drawn(side, image_of(onto(side.middle, side.along), points_[i].at));
        structure.points[i].page.reset();
        structure.points[i].changed = false;
        if (side.page != fold_.left_page) structure.points[i].page = side.page;
    }
    for (std::size_t i = 0; i < structure.arguments.size(); ++i) {
        if (info_->parameters[i].page == PointPage::extra || !is_drawn(structure.arguments[i])) continue;
        move_argument(structure.arguments[i], onto(left_.middle, left_.along));
        structure.arguments[i].changed = false;
        if (left_.turned != left_.mended) move_argument(structure.arguments[i], kMirrored);
    }
    if (structure.plate) {
        structure.plate->page = fold_.left_page;
        structure.plate->at.at = drawn(left_, left_.middle);
    } else {
        structure.fold.page = fold_.left_page;
        structure.fold.begin.at = drawn(left_, fold_.on_left.a);
        structure.fold.end.at = drawn(left_, fold_.on_left.b);
    }
}

void NamedPlace::take_up(Structure& structure) const {
    for (std::size_t i = 0; i < structure.points.size(); ++i) {
        if (info_->points[i].page == PointPage::extra) continue;
        DesignPoint& point = structure.points[i];
        const Side& side = side_of(i);
        const Vec2 at = side.turned ? mirrored(point.at) : point.at;
        if (point.changed) {
            point.at = written(at, info_->points[i].side == 'R');
            point.page = points_[i].page;
        } else {
            point = points_[i];
        }
    }
    for (std::size_t i = 0; i < structure.arguments.size(); ++i) {
        Argument& argument = structure.arguments[i];
        if (info_->parameters[i].page == PointPage::extra || !is_drawn(argument)) continue;
        if (!argument.changed && i < arguments_.size()) {
            argument = arguments_[i];
            continue;
        }
        if (left_.turned) move_argument(argument, kMirrored);
        move_argument(argument, inverse(onto(left_.middle, left_.along)));
    }
    if (structure.plate) {
        structure.plate->page = 0;
        structure.plate->at.at = {};
        structure.plate->at.changed = false;
        structure.plate->page_changed = false;
    } else {
        structure.fold.page = 0;
        structure.fold.begin.at = structure.fold.end.at = {};
        structure.fold.begin.changed = structure.fold.end.changed = false;
        structure.fold.page_changed = false;
    }
}

}  // namespace popup
