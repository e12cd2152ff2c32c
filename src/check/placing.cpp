#include "check/placing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "check/named_place.h"
#include "mechanism/arguments.h"
#include "mechanism/site_lines.h"

namespace popup {
namespace {

constexpr double kWrittenMm = 5e-5;  // about what six decimals of an inch can tell apart

DirectedLine directed(const Segment& s, bool reversed) {
    return reversed ? DirectedLine{s.b, unit(s.a - s.b)} : DirectedLine{s.a, unit(s.b - s.a)};
}

// The line before the fold moved.
DirectedLine undone(const RigidMove& move, const DirectedLine& line) {
    if (move.identity) return line;
    const auto back = [&](Vec2 d) { return Vec2{move.c * d.x + move.s * d.y, move.c * d.y - move.s * d.x}; };
    return {move.from + back(line.at - move.to), back(line.dir)};
}

}  // namespace

bool has_inverse(const ElementInfo& info) {
    const auto table = element_table();
    return std::any_of(table.begin(), table.end(), [&](const ElementInfo& other) {
        return other.family == info.family && other.inverted != info.inverted;
    });
}

Placing::Placing(const Design& design, const Structure& structure, const ElementInfo& info, int extra_page,
                 const PageTurns& pages)
    : structure_(&structure),
      pages_(pages),
      unit_mm_(design.unit.mm),
      unit_(fmt::format(" {}", design.unit.name)) {
    element.info = &info;
    element.arguments = structure.arguments;
    element.arguments.resize(info.parameters.size());
    element.paint = {structure.id,
                     structure.place,
                     color_of(structure, "leftcolor"),
                     color_of(structure, "rightcolor"),
                     color_of(structure, "lefttabcolor"),
                     color_of(structure, "righttabcolor")};
    element.extra_page = extra_page;
    element.page_height = design.height_mm;
    element.label = extra_page < 0 ? std::string() : fmt::format("{}", extra_page);
    element.inverted = info.inverted;
    const auto is_mirrored = [&](int page) {
        const bool redrawn = page >= 0 && static_cast<std::size_t>(page) < pages_.redrawn.size() &&
                             pages_.redrawn[static_cast<std::size_t>(page)];
        return redrawn != read_mirrored(page);
    };
    const auto on_page = [&](Vec2 at, int page) { return is_mirrored(page) ? mirrored(at) : at; };
    const int ground = structure.ground_page();
    for (std::size_t i = 0; i < info.parameters.size(); ++i) {
        if (info.parameters[i].page == PointPage::extra || !is_drawn(element.arguments[i]) ||
            !is_mirrored(ground))
            continue;
        move_argument(element.arguments[i], kMirrored);
        element.arguments[i].changed = !read_mirrored(ground);  // the page was mended: so must this be
    }
    const std::size_t count = info.points.size();
    points_.reserve(count);
    reported_.reserve(count);
    letters_.reserve(count);
    element.on.reserve(count);
    element.extra.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const DesignPoint& point = structure.points[i];
        const bool extra = info.points[i].page == PointPage::extra;
        const int page = extra ? extra_page : point.page.value_or(ground);
        points_.push_back({on_page(point.at, page), page});
        reported_.push_back({point.at, page});
        letters_.push_back(info.points[i].letter);
        if (extra)
            element.extra.push_back(point.at);
        else
            element.on.push_back({});
    }
    authored_ = points_;
    begin = on_page(structure.plate ? structure.plate->at.at : structure.fold.begin.at, ground);
    end = on_page(structure.plate ? structure.plate->at.at : structure.fold.end.at, ground);
    fold_begin_ = begin;
    fold_end_ = end;
}

bool Placing::read_mirrored(int page) const {
    return page >= 0 && static_cast<std::size_t>(page) < pages_.mirrored.size() &&
           pages_.mirrored[static_cast<std::size_t>(page)];
}

// The form as the document should name it: a turned v-fold is read as its inverse.
bool Placing::ends_inverted() const {
    return turned && element.info->glued && has_inverse(*element.info) ? !element.inverted : element.inverted;
}

std::string Placing::text(Vec2 p) const {
    const auto number = [&](double value) {
        std::string text = fmt::format("{:.4f}", value / unit_mm_);
        while (text.back() == '0') text.pop_back();
        if (text.back() == '.') text.pop_back();
        return text == "-0" ? std::string("0") : text;
    };
    return fmt::format("({}, {})", number(p.x), number(p.y));
}

std::vector<Vec2> Placing::drawn_on(int page) const {
    std::vector<Vec2> made;
    made.reserve(points_.size());
    for (std::size_t i = 0; i < points_.size(); ++i) {
        if (element.info->points[i].page == PointPage::fold && points_[i].page == page)
            made.push_back(points_[i].at);
    }
    // Where points say where it stands, what else is drawn does not.
    if (!element.info->grounds.found) return made;
    for (std::size_t i = 0; i < element.arguments.size(); ++i) {
        const Argument& argument = element.arguments[i];
        if (element.info->parameters[i].page == PointPage::extra || argument.page.value_or(page) != page)
            continue;
        if (const auto* path = std::get_if<DrawnPath>(&argument.value)) {
            for (const Polygon& area : path->inside.areas)
                made.insert(made.end(), area.outer.begin(), area.outer.end());
        } else if (const auto* list = std::get_if<std::vector<DesignPoint>>(&argument.value)) {
            for (const DesignPoint& point : *list) made.push_back(point.at);
        }
    }
    return made;
}

Box Placing::drawn_box() const {
    Box box;
    for (const Vec2 p : drawn_on(structure_->ground_page())) box.extend(p);
    return box;
}

Box Placing::place_on_line() const {
    const Vec2 dir = unit(end - begin);
    Box box;
    for (const Vec2 p : drawn_on(structure_->ground_page())) box.extend(begin + dot(dir, p - begin) * dir);
    if (box.empty()) {
        box.extend(begin);
        box.extend(end);
    }
    return box;
}

std::size_t Placing::index_on(std::size_t point) const {
    return static_cast<std::size_t>(std::count_if(
        element.info->points.begin(), element.info->points.begin() + static_cast<std::ptrdiff_t>(point),
        [](const PointInfo& p) { return p.page == PointPage::fold; }));
}

std::size_t Placing::index_extra(std::size_t point) const { return point - index_on(point); }

Side Placing::side_of(std::size_t point) const {
    switch (element.info->points[point].side) {
        case 'L':
            return Side::left;
        case 'R':
            return Side::right;
        default:
            return points_[point].page == element.site.left_page ? Side::left : Side::right;
    }
}

void Placing::to_site() {
    for (std::size_t i = 0; i < points_.size(); ++i) {
        if (element.info->points[i].page == PointPage::extra) {
            element.extra[index_extra(i)] = points_[i].at;
        } else {
            element.on[index_on(i)] = element.site.from_page(side_of(i), points_[i].at);
        }
    }
}

void Placing::look_along(const FoldMatch& match, const Fold& fold) {
    turned = match.reversed && !match.ghost && match.fold == 0;
    Site& site = element.site;
    const bool reversed = match.reversed && !turned;
    site.left = directed(reversed ? fold.on_right : fold.on_left, reversed);
    site.right = directed(reversed ? fold.on_left : fold.on_right, reversed);
    site.left_page = reversed ? fold.right_page : fold.left_page;
    site.right_page = reversed ? fold.left_page : fold.right_page;
    site.left_plate = reversed ? fold.right_plate : fold.left_plate;
    site.right_plate = reversed ? fold.left_plate : fold.right_plate;
    site.fold = match.ghost ? -1 : match.fold;
    site.length = fold.length();
    site.mountain = fold.closed_deg == 360;
    site.seam = fold.seam;
    site.reversed = reversed;
    authored_site_ = site;
    authored_site_.left = undone(reversed ? match.right : match.left, site.left);
    authored_site_.right = undone(reversed ? match.left : match.right, site.right);
    // Only where it stands is asked yet: positions along the fold, as its author saw them.
    const Site exact = site;
    site = authored_site_;
    to_site();
    site = exact;
}

PageFold Placing::seen() const {
    const Site& site = authored_site_;
    const auto line = [&](const DirectedLine& one) {
        return Segment{one.at, one.at + site.length * one.dir};
    };
    PageFold made{site.left_page,   site.right_page, line(site.left),
                  line(site.right), site.seam,       site.mountain ? 360 : 0};
    if (!beside) return made;
    const Segment along{{0, -0.5 * site.length}, {0, 0.5 * site.length}};
    made.on_left = made.on_right = along;
    return made;
}

void Placing::look_along_given_line() {
    Site& site = element.site;
    site.left = site.right = {begin, distance(begin, end) > 0.0 ? unit(end - begin) : Vec2{0, 1}};
    site.left_page = site.right_page = structure_->ground_page();
    site.length = distance(begin, end);
    authored_site_ = site;
    to_site();
}

void Placing::look_on(const PlateMatch& match) {
    Site& site = element.site;
    site.left_page = site.right_page = structure_->ground_page();
    site.left_plate = site.right_plate = match.plate;
    site.on_plate = true;
    // Its line is that of the points, wherever they will have moved with the plate.
    std::vector<Vec2> own;
    for (std::size_t i = 0; i < points_.size() && own.size() < 2; ++i) {
        if (element.info->points[i].page == PointPage::fold) own.push_back(points_[i].at);
    }
    const Vec2 at = own.empty() ? begin : own.front();
    const bool directed = own.size() > 1 && distance(own[0], own[1]) > 0.0;
    const Vec2 dir = directed ? unit(own[1] - own[0]) : Vec2{0, 1};
    site.length = directed ? distance(own[0], own[1]) : 0.0;
    authored_site_ = site;
    authored_site_.left = authored_site_.right = {at, dir};
    const Vec2 to = match.move.apply(at);
    site.left = site.right = {to, unit(match.move.apply(at + dir) - to)};
    const Site exact = site;
    site = authored_site_;
    to_site();
    site = exact;
}

void Placing::look_on_page() {
    Site& site = element.site;
    site.left_page = site.right_page = structure_->ground_page();
    site.left = site.right = {{0, 0}, {0, 1}};
    site.on_plate = true;
    authored_site_ = site;
    to_site();
}

void Placing::stand_between(std::pair<double, double> alive, double fold_length) {
    const auto [lo, hi] = alive;
    element.alive_lo = element.site.reversed ? fold_length - hi : lo;
    element.alive_hi = element.site.reversed ? fold_length - lo : hi;
}

void Placing::exchange(bool extra_too) {
    const auto partners = element.info->partners;
    for (std::size_t i = 0; i < partners.size(); ++i) {
        const auto j = static_cast<std::size_t>(partners[i]);
        if (j <= i || (!extra_too && element.info->points[i].page == PointPage::extra)) continue;
        std::swap(points_[i], points_[j]);
        std::swap(authored_[i], authored_[j]);
    }
}

Element Placing::authored_element() const {
    Element copy = element;
    copy.site = authored_site_;
    copy.repaired = nullptr;
    copy.failed = nullptr;
    static const Tolerances kTolerances;
    copy.tolerances = &kTolerances;
    for (std::size_t i = 0; i < authored_.size(); ++i) {
        if (element.info->points[i].page == PointPage::extra) {
            copy.extra[index_extra(i)] = authored_[i].at;
        } else {
            copy.on[index_on(i)] = authored_site_.from_page(side_of(i), authored_[i].at);
        }
    }
    return copy;
}

std::vector<Placing::PagePoint> Placing::page_points() const {
    std::vector<PagePoint> now(points_.size());
    const auto partners = element.info->partners;
    for (std::size_t i = 0; i < points_.size(); ++i) {
        // A turned element is written as its author wrote it: the other way round.
        const std::size_t to = turned ? static_cast<std::size_t>(partners[i]) : i;
        if (element.info->points[i].page == PointPage::extra) {
            const Vec2 at = element.extra[index_extra(i)];
            now[to] = {turned ? mirrored(at) : at, points_[i].page};
        } else {
            const Side side = side_of(i);
            const int page = side == Side::left ? element.site.left_page : element.site.right_page;
            const Vec2 at = element.site.on_page(side, element.on[index_on(i)]);
            now[to] = {read_mirrored(page) ? mirrored(at) : at, page};
        }
    }
    return now;
}

Change Placing::take_change(const Tolerances& tolerances) {
    repaired_ = true;
    const auto now = page_points();
    Change change;
    for (std::size_t i = 0; i < now.size(); ++i) {
        if (now[i].page == reported_[i].page &&
            distance(now[i].at, reported_[i].at) <= tolerances.rounding_mm)
            continue;
        const std::string_view space = change.before.empty() ? "" : " ";
        const auto as_written = [&](Vec2 p) {
            const PointInfo& point = element.info->points[i];
            return beside && point.page == PointPage::fold ? beside->written(p, point.side == 'R') : p;
        };
        change.before += fmt::format("{}{} {}", space, letters_[i], text(as_written(reported_[i].at)));
        change.after += fmt::format("{}{} {}", space, letters_[i], text(as_written(now[i].at)));
        reported_[i] = now[i];
    }
    for (const Segment& snapped : std::exchange(element.snapped, {})) {
        const std::string_view space = change.before.empty() ? "" : " ";
        change.before += fmt::format("{}{}", space, text(snapped.a));
        change.after += fmt::format("{}{}", space, text(snapped.b));
    }
    // Findings speak of millimetres, and points are as they are written.
    if (!change.before.empty() && unit_mm_ != 1.0) {
        change.before += unit_;
        change.after += unit_;
    }
    if (change.before.empty() && element.redrawn) {
        change = *std::exchange(element.redrawn, std::nullopt);
    } else if (change.before.empty()) {  // a repair of the form, or of the fold
        change.before = std::string(element.info->name);
        const bool inverted = ends_inverted();
        change.after =
            std::string(inverted && !element.info->inverted ? "inverted-" : "") +
            std::string(inverted == element.info->inverted ? element.info->name : element.info->family);
        if (change.before == change.after && structure_->plate) {
            change.before = text(structure_->plate->at.at);
            change.after = text(fold_begin_);
        } else if (change.before == change.after) {
            change.before = text(structure_->fold.begin.at) + " to " + text(structure_->fold.end.at);
            change.after = text(fold_begin_) + " to " + text(fold_end_);
        }
    }
    return change;
}

void Placing::write_ground(Structure& structure) const {
    const auto write = [&](DesignPoint& point, Vec2 internal) {
        const Vec2 at = read_mirrored(structure.ground_page()) ? mirrored(internal) : internal;
        if (distance(point.at, at) <= kWrittenMm) return;
        point.at = at;
        point.changed = true;
    };
    if (structure.plate) {
        write(structure.plate->at, fold_begin_);
    } else {
        write(structure.fold.begin, fold_begin_);
        write(structure.fold.end, fold_end_);
    }
}

void Placing::write_back(Structure& structure) const {
    if (!repaired_) return;
    // A repaired element is written as it is, the mended rounding of its other points included: else the next
    // run would measure slightly different angles and find something again.
    const auto now = page_points();
    for (std::size_t i = 0; i < now.size(); ++i) {
        DesignPoint& point = structure.points[i];
        const bool extra = element.info->points[i].page == PointPage::extra;
        const int page = point.page.value_or(structure.ground_page());
        const bool new_page = !extra && page != now[i].page;
        if (!new_page && distance(point.at, now[i].at) <= kWrittenMm) continue;
        point.at = now[i].at;
        if (new_page) point.page = now[i].page;
        point.changed = true;
    }
    for (std::size_t i = 0; i < element.arguments.size(); ++i) {
        if (!element.arguments[i].changed) continue;
        Argument& written = structure.argument(i) = element.arguments[i];
        const bool extra = element.info->parameters[i].page == PointPage::extra;
        if (extra ? turned : read_mirrored(structure.ground_page())) move_argument(written, kMirrored);
    }
    if (fold_moved_) write_ground(structure);
    const bool inverted = ends_inverted();
    if (inverted == element.info->inverted) return;
    for (const ElementInfo& info : element_table()) {
        if (info.family == element.info->family && info.inverted == inverted) structure.type = info.name;
    }
    structure.type_changed = true;
}

}  // namespace popup
