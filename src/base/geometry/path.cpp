#include "popup/path.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/geometry/regions.h"
#include "base/text/number_scanner.h"

namespace popup {

PathStep& Path::step(Vec2 to) {
    if (moved_) {
        subpaths_.push_back({at_, {}, false});
        moved_ = false;
    }
    ++size_;
    at_ = to;
    return subpaths_.back().steps.emplace_back(PathStep{to, false, {}, {}});
}

void Path::move(Vec2 to) {
    at_ = to;
    moved_ = true;
}

void Path::line(Vec2 to) { step(to); }

void Path::cubic(Vec2 control_1, Vec2 control_2, Vec2 to) {
    PathStep& made = step(to);
    made.curve = true;
    made.control_1 = control_1;
    made.control_2 = control_2;
}

void Path::quadratic(Vec2 control, Vec2 to) {
    cubic(lerp(at_, control, 2.0 / 3.0), lerp(to, control, 2.0 / 3.0), to);
}

std::vector<Segment> Path::snap(std::span<const Vec2> to, double within) {
    std::vector<Segment> moves;
    const auto moved = [&](Vec2& at) {
        const Vec2* nearest = nullptr;
        for (const Vec2& p : to) {
            if (distance(p, at) <= within && (nearest == nullptr || distance(p, at) < distance(*nearest, at)))
                nearest = &p;
        }
        if (nearest == nullptr || *nearest == at) return Vec2{};
        const Vec2 by = *nearest - at;
        moves.push_back({at, *nearest});
        at = *nearest;
        return by;
    };
    for (Subpath& subpath : subpaths_) {
        Vec2 by = moved(subpath.start);
        for (PathStep& step : subpath.steps) {
            step.control_1 = step.control_1 + by;
            by = moved(step.to);
            step.control_2 = step.control_2 + by;
        }
    }
    const std::size_t count = moves.size();
    moved(at_);
    moves.resize(count);
    return moves;
}

void Path::close() {
    if (moved_) return;
    subpaths_.back().closed = true;
    move(subpaths_.back().start);
}

void Path::arc(double rx, double ry, double turn, bool large, bool sweep, Vec2 to) {
    rx = std::abs(rx);
    ry = std::abs(ry);
    if (rx == 0.0 || ry == 0.0) return line(to);
    if (to == at_) return;
    // In coordinates in which the ellipse is the unit circle, and the middle of the chord the origin.
    const double angle = std::fmod(turn, 360.0) * std::numbers::pi / 180.0;
    const Vec2 half = rotated(0.5 * (at_ - to), -angle);
    Vec2 from{half.x / rx, half.y / ry};
    const double chord = dot(from, from);  // (half a chord)²
    if (!std::isfinite(chord)) return line({HUGE_VAL, HUGE_VAL});
    if (chord > 1.0) {
        const double grow = std::sqrt(chord);
        rx *= grow;
        ry *= grow;
        from = (1.0 / grow) * from;
    }
    const double squared = dot(from, from);
    if (squared < 1e-24) return line(to);  // too short a chord to say where the middle is
    const double away = std::sqrt(std::max(0.0, 1.0 / squared - 1.0));
    const Vec2 centre = (large == sweep ? -away : away) * Vec2{from.y, -from.x};
    const Vec2 start = from - centre;
    const Vec2 end = -1.0 * from - centre;
    double sweep_angle = std::atan2(cross(start, end), dot(start, end));
    if (sweep && sweep_angle < 0.0) sweep_angle += 2.0 * std::numbers::pi;
    if (!sweep && sweep_angle > 0.0) sweep_angle -= 2.0 * std::numbers::pi;

    const Vec2 middle = 0.5 * (at_ + to) + rotated({centre.x * rx, centre.y * ry}, angle);
    const auto in_place = [&](Vec2 p) { return middle + rotated({p.x * rx, p.y * ry}, angle); };
    // Of 30° at most: then the cubic strays from the arc by less than a two-millionth of the radius.
    const double pieces = std::max(1.0, std::ceil(std::abs(sweep_angle) * 6.0 / std::numbers::pi - 1e-9));
    const double each = sweep_angle / pieces;
    const double reach = 4.0 / 3.0 * std::tan(0.25 * each);
    Vec2 a = start;
    for (double i = 1.0; i <= pieces; ++i) {
        const Vec2 b = i == pieces ? end : rotated(start, i * each);
        cubic(in_place(a + reach * left_of(a)), in_place(b - reach * left_of(b)),
              i == pieces ? to : in_place(b));
        a = b;
    }
}

namespace {

class PathParser {
 public:
    PathParser(std::string_view text, Path& path) : scanner_(text), path_(path) {}

    std::optional<PathFault> run() {
        char command = '\0';
        while (char next = scanner_.peek()) {
            if (next == ',') {
                // A comma may stand between the arguments of repeated commands only.
                if (command == '\0' || (command | 0x20) == 'z') return fault();
            } else if (const bool letter = (next | 0x20) >= 'a' && (next | 0x20) <= 'z'; letter) {
                if (command == '\0' && (next | 0x20) != 'm') return fault();
                if (std::string_view("mzlhvcsqta").find(static_cast<char>(next | 0x20)) ==
                    std::string_view::npos) {
                    return fault();
                }
                command = next;
                scanner_.skip(1);
            } else if (command == '\0' || (command | 0x20) == 'z') {
                return fault();
            }
            if (path_.size() >= kStepsLimit) return PathFault{scanner_.position(), true};
            if (!one(command)) return fault();
            // More points after a move are lines.
            if (command == 'M') command = 'L';
            if (command == 'm') command = 'l';
        }
        return std::nullopt;
    }

 private:
    PathFault fault() {
        scanner_.peek();  // skips blanks
        return {scanner_.position(), false};
    }

    // Reads `count` numbers into values_.
    bool take(std::size_t count) {
        for (std::size_t i = 0; i < count; ++i) {
            const auto number = scanner_.number();
            if (!number) return false;
            values_.at(i) = *number;
        }
        return true;
    }
    [[nodiscard]] Vec2 point(std::size_t i) const {
        return origin_ + Vec2{values_.at(2 * i), values_.at(2 * i + 1)};
    }
    // The control point of before, mirrored, where one of the same kind of curve went before.
    [[nodiscard]] Vec2 mirrored(bool same_kind) const {
        return same_kind ? path_.at() + (path_.at() - control_) : path_.at();
    }

    bool one(char command) {
        const bool relative = command >= 'a';
        origin_ = relative ? path_.at() : Vec2{};
        const char kind = static_cast<char>(command | 0x20);
        const char before = before_;
        before_ = kind;
        switch (kind) {
            case 'm':
                if (!take(2)) return false;
                path_.move(point(0));
                return true;
            case 'z':
                path_.close();
                return true;
            case 'l':
                if (!take(2)) return false;
                path_.line(point(0));
                return true;
            case 'h':
                if (!take(1)) return false;
                path_.line({origin_.x + values_[0], path_.at().y});
                return true;
            case 'v':
                if (!take(1)) return false;
                path_.line({path_.at().x, origin_.y + values_[0]});
                return true;
            case 'c':
                if (!take(6)) return false;
                control_ = point(1);
                path_.cubic(point(0), point(1), point(2));
                return true;
            case 's': {
                if (!take(4)) return false;
                const Vec2 first = mirrored(before == 'c' || before == 's');
                control_ = point(0);
                path_.cubic(first, point(0), point(1));
                return true;
            }
            case 'q':
                if (!take(4)) return false;
                control_ = point(0);
                path_.quadratic(point(0), point(1));
                return true;
            case 't':
                if (!take(2)) return false;
                control_ = mirrored(before == 'q' || before == 't');
                path_.quadratic(control_, point(0));
                return true;
            case 'a':
                return arc();
            default:
                return false;
        }
    }

    bool arc() {
        if (!take(3)) return false;
        const double rx = values_[0];
        const double ry = values_[1];
        const double turn = values_[2];
        const auto large = scanner_.flag();
        const auto sweep = large ? scanner_.flag() : std::nullopt;
        if (!sweep || !take(2)) return false;
        path_.arc(rx, ry, turn, *large, *sweep, point(0));
        return true;
    }

    NumberScanner scanner_;
    Path& path_;
    std::array<double, 6> values_{};
    Vec2 origin_;
    Vec2 control_;
    char before_ = '\0';
};

bool near_enough(Vec2 p) { return std::abs(p.x) <= kReachMm && std::abs(p.y) <= kReachMm; }

// How many chords keep a cubic within the tolerance: its second differences bound how it bends.
double chords_for(const Cubic& c) {
    const double bend = std::max(length(c.from - 2.0 * c.control_1 + c.control_2),
                                 length(c.control_1 - 2.0 * c.control_2 + c.to));
    return std::max(1.0, std::ceil(std::sqrt(0.75 * bend / kFlatMm) - 1e-9));
}

bool is_straight(const Cubic& c) {
    const Segment chord{c.from, c.to};
    return distance(c.control_1, chord) <= kStraightMm && distance(c.control_2, chord) <= kStraightMm;
}

// Makes one subpath a polygon.
class Flattener {
 public:
    Flattener(const Subpath& subpath, Flattened& into) : subpath_(subpath), into_(into) {}

    FlatteningFault run() {
        if (!near_enough(subpath_.start)) return FlatteningFault::too_far;
        line_.points.push_back(on_grid(subpath_.start));
        Vec2 at = subpath_.start;
        for (const PathStep& step : subpath_.steps) {
            if (!near_enough(step.to)) return FlatteningFault::too_far;
            if (step.curve) {
                if (!near_enough(step.control_1) || !near_enough(step.control_2)) {
                    return FlatteningFault::too_far;
                }
                curve({at, step.control_1, step.control_2, step.to});
            } else {
                add(step.to);
            }
            at = step.to;
            if (into_.points > kFlatPointsLimit) return FlatteningFault::too_many;
        }
        ++into_.points;
        line_.closed = subpath_.closed;
        std::vector<Vec2>& points = line_.points;
        if (line_.closed && points.size() > 1 && points.back() == points.front()) points.pop_back();
        if (points.size() >= 2) into_.lines.push_back(std::move(line_));
        return FlatteningFault::none;
    }

 private:
    void add(Vec2 p) {
        const Vec2 rounded = on_grid(p);
        if (rounded == line_.points.back()) return;
        line_.points.push_back(rounded);
        ++into_.points;
    }

    void curve(const Cubic& cubic) {
        const double chords = chords_for(cubic);
        const bool known = !is_straight(cubic);
        if (known) into_.curves.push_back({cubic, {{line_.points.back(), 0.0}}});
        for (double i = 1.0; i <= chords; ++i) {
            const double t = i / chords;
            add(i == chords ? cubic.to : cubic.at(t));
            if (known) into_.curves.back().corners.push_back({line_.points.back(), t});
        }
    }

    const Subpath& subpath_;
    Flattened& into_;
    Polyline line_;
};

}  // namespace

Vec2 Cubic::at(double t) const {
    const Vec2 ab = lerp(from, control_1, t);
    const Vec2 bc = lerp(control_1, control_2, t);
    const Vec2 cd = lerp(control_2, to, t);
    return lerp(lerp(ab, bc, t), lerp(bc, cd, t), t);
}

Cubic Cubic::part(double t0, double t1) const {
    // The curve's blossom: each of three steps of de Casteljau's with a parameter of its own.
    const auto blossom = [this](double a, double b, double c) {
        const Vec2 ab = lerp(from, control_1, a);
        const Vec2 bc = lerp(control_1, control_2, a);
        const Vec2 cd = lerp(control_2, to, a);
        return lerp(lerp(ab, bc, b), lerp(bc, cd, b), c);
    };
    return {at(t0), blossom(t0, t0, t1), blossom(t0, t1, t1), at(t1)};
}

std::optional<PathFault> parse_path(std::string_view text, Path& path) {
    const std::size_t last = text.find_last_not_of(" \t\r\n");
    if (text.substr(0, last + 1) == "none") return std::nullopt;
    return PathParser(text, path).run();
}

FlatteningFault flatten(const Path& path, Flattened& into) {
    for (const Subpath& subpath : path.subpaths()) {
        const FlatteningFault fault = Flattener(subpath, into).run();
        if (fault != FlatteningFault::none) return fault;
    }
    return FlatteningFault::none;
}

FlatteningFault enclose(const Path& path, Enclosed& into) {
    into = {};
    Flattened flat;
    if (const FlatteningFault fault = flatten(path, flat); fault != FlatteningFault::none) return fault;
    std::vector<Ring> rings;
    rings.reserve(flat.lines.size());
    for (Polyline& line : flat.lines) rings.push_back(std::move(line.points));
    into = {filled(rings, FillRule::even_odd), std::move(flat.curves)};
    return FlatteningFault::none;
}

}  // namespace popup
