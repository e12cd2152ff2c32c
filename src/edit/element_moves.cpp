#include "edit/element_moves.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

namespace popup::edit {
namespace {

constexpr double kJoinedBesideMm = 0.06;  // a corner of an element, and the line that dashes were joined to
constexpr double kReadCornerMm = 2e-3;    // a corner of an element, and of the lines that were read from it
constexpr double kOnSideMm = 5e-3;
constexpr double kSameDeg = 1e-6;

// One word for all where they are alike.
std::string joined(const std::vector<std::string>& words) {
    if (std::adjacent_find(words.begin(), words.end(), std::not_equal_to<>()) == words.end())
        return words.front();
    return fmt::format("{}", fmt::join(words, " "));
}

}  // namespace

void ElementMoves::add(const CreaseLine& line, const EditedSheet::Line& to) {
    for (std::size_t i = 0; i < line.points.size(); ++i) rows_.push_back({line.points[i], to.points[i]});
    if (!line.closed) {
        ends_.push_back({line.points.front(), line.points[1]});
        ends_.push_back({line.points.back(), line.points[line.points.size() - 2]});
    }
    for (const auto& [stretch, at] : to.through) {
        const auto from = static_cast<std::size_t>(stretch);
        through_.push_back({line.points[from], line.points[(from + 1) % line.points.size()], at});
    }
    moved_ = moved_ || to.moved;
    const bool apart = !to.parted.empty() && to.fold_deg.empty();
    goes_apart_ = goes_apart_ || apart;
    has_angles_ = has_angles_ || !to.fold_deg.empty();
    angles_differ_ = angles_differ_ || to.fold_deg.size() > 1;
    Drawn& drawn = lines_.emplace_back();
    drawn.fold_deg = to.fold_deg;
    drawn.parted = to.parted;
    one_stretch_each_ = one_stretch_each_ && !line.closed && line.points.size() == 2;
    auto next = to.through.begin();
    for (std::size_t i = 0; !apart && i + (line.closed ? 0U : 1U) < line.points.size(); ++i) {
        Vec2 at = to.points[i];
        for (; next != to.through.end() && next->first == static_cast<int>(i); ++next)
            drawn.straight.push_back({std::exchange(at, next->second), next->second});
        drawn.straight.push_back({at, to.points[(i + 1) % to.points.size()]});
    }
}

bool ElementMoves::goes_beyond(const Path& path) const {
    std::vector<Vec2> corners;
    for (const Subpath& subpath : path.subpaths()) {
        corners.push_back(subpath.start);
        for (const PathStep& step : subpath.steps) corners.push_back(step.to);
    }
    return std::any_of(ends_.begin(), ends_.end(), [&](const Segment& end) {
        return std::none_of(corners.begin(), corners.end(),
                            [&](Vec2 p) { return distance(p, end.a) <= kReadCornerMm; }) &&
               std::any_of(corners.begin(), corners.end(),
                           [&](Vec2 p) { return distance(p, end) <= kJoinedBesideMm; });
    });
}

void ElementMoves::sort() {
    std::sort(rows_.begin(), rows_.end(), [](const Segment& a, const Segment& b) {
        return std::pair(a.a.x, a.a.y) < std::pair(b.a.x, b.a.y);
    });
}

std::vector<Vec2> ElementMoves::through(Vec2 from, Vec2 to) const {
    std::vector<Vec2> found;
    for (const Through& one : through_) {
        if (distance(one.from, from) <= kReadCornerMm && distance(one.to, to) <= kReadCornerMm)
            found.push_back(one.at);
    }
    if (!found.empty()) return found;
    for (auto one = through_.rbegin(); one != through_.rend(); ++one) {
        if (distance(one->from, to) <= kReadCornerMm && distance(one->to, from) <= kReadCornerMm)
            found.push_back(one->at);
    }
    return found;
}

std::vector<Segment> ElementMoves::edges() const {
    std::vector<Segment> all;
    for (const Drawn& one : lines_) {
        if (one.parted.empty()) all.insert(all.end(), one.straight.begin(), one.straight.end());
    }
    for (const Drawn& one : lines_) all.insert(all.end(), one.parted.begin(), one.parted.end());
    return all;
}

std::string ElementMoves::angles(const Said& said, bool of_edges) const {
    std::vector<std::string> words;
    const auto add = [&](std::size_t line, std::size_t times) {
        const std::vector<double>& deg = lines_[line].fold_deg;
        std::optional<double> same;
        if (deg.size() == 1) {
            same = deg.front();
        } else if (!said.empty()) {
            same = said[line];
        }
        words.insert(words.end(), times, same ? shown_number(*same) : "auto");
    };
    for (std::size_t i = 0; i < lines_.size(); ++i) {
        if (!of_edges || lines_[i].parted.empty()) add(i, of_edges ? lines_[i].straight.size() : 1);
    }
    for (const Drawn& one : lines_) {
        for (std::size_t i = 0; of_edges && i < one.parted.size(); ++i)
            words.push_back(i < one.fold_deg.size() ? shown_number(one.fold_deg[i]) : "auto");
    }
    return joined(words);
}

std::optional<Vec2> ElementMoves::find(Vec2 p) const {
    auto at = std::lower_bound(rows_.begin(), rows_.end(), p.x - kReadCornerMm,
                               [](const Segment& row, double x) { return row.a.x < x; });
    double nearest = kReadCornerMm;
    std::optional<Vec2> found;
    for (; at != rows_.end() && at->a.x <= p.x + kReadCornerMm; ++at) {
        if (const double far = distance(p, at->a); far <= nearest) {
            nearest = far;
            found = p + (at->b - at->a);
        }
    }
    return found;
}

std::optional<std::string> ElementMoves::angle_of_side(const Drawn& line, const Segment& side) {
    if (line.fold_deg.size() == 1) return shown_number(line.fold_deg.front());
    std::optional<double> deg;
    const Vec2 way = unit(side.b - side.a);
    for (std::size_t i = 0; i < line.fold_deg.size(); ++i) {
        const Vec2 middle = lerp(line.parted[i].a, line.parted[i].b, 0.5) - side.a;
        const double along = dot(way, middle);
        if (std::abs(cross(way, middle)) > kOnSideMm || along < 0.0 || along > distance(side.a, side.b))
            continue;
        if (deg && std::abs(*deg - line.fold_deg[i]) > kSameDeg) return std::nullopt;
        deg = line.fold_deg[i];
    }
    return deg ? shown_number(*deg) : "auto";
}

std::optional<std::string> ElementMoves::angles_of_sides(const Said& said, std::size_t sides) const {
    std::vector<std::string> words;
    for (std::size_t i = 0; i < lines_.size(); ++i) {
        for (const Segment& side : lines_[i].straight) {
            std::optional<std::string> word;
            if (lines_[i].fold_deg.empty()) {
                word = !said.empty() && said[i] ? shown_number(*said[i]) : "auto";
            } else {
                word = angle_of_side(lines_[i], side);
            }
            if (!word) return std::nullopt;
            words.push_back(std::move(*word));
        }
    }
    if (words.empty() || words.size() != sides) return std::nullopt;
    return joined(words);
}

}  // namespace popup::edit
