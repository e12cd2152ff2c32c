#include "popup/curves.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

#include "popup/diagnostics.h"

namespace popup {
namespace {

// A corner has moved by less than this where it is still the same: chains take points for one that are this
// near.
constexpr double kFoundMm = 2e-5;
// What grids and chains move corners by, and joined ends by no more.
constexpr double kRoundedMm = 1e-4;
// At a point where more curves meet than this nobody can tell them apart.
constexpr std::size_t kMostMeeting = 16;

std::int64_t column_of(double x) { return std::llround(x / kFoundMm); }

// How far a cubic whose controls lie this far from the thirds of its chord strays from the chord, at most.
double stray_of(double a, double b) {
    const double most = std::max(std::abs(a), std::abs(b));
    return (a * b > 0.0 ? 3.0 / 4.0 : 4.0 / 9.0) * most;
}

// How far the curve and the segment are apart, at most, whichever of them one starts from.
double stray_of(const Cubic& curve, const Segment& chord) {
    const Vec2 start = curve.from - chord.a;
    const Vec2 end = curve.to - chord.b;
    const double ends = std::max(length(start), length(end));
    // By parameter: the point at t of the one from that at t of the other.
    const Vec2 bend_1 = curve.from - 2.0 * curve.control_1 + curve.control_2;
    const Vec2 bend_2 = curve.control_1 - 2.0 * curve.control_2 + curve.to;
    const double by_parameter = 0.75 * std::max(length(bend_1), length(bend_2)) + ends;
    // Across the segment, where the curve runs along it from end to end.
    const double span = distance(chord.a, chord.b);
    if (span == 0.0) return by_parameter;
    const Vec2 along = (1.0 / span) * (chord.b - chord.a);
    for (const Vec2 p : {curve.control_1, curve.control_2}) {
        const double place = dot(along, p - chord.a);
        if (place < 0.0 || place > span) return by_parameter;
    }
    const Vec2 third_1 = lerp(curve.from, curve.to, 1.0 / 3.0);
    const Vec2 third_2 = lerp(curve.from, curve.to, 2.0 / 3.0);
    const double across =
        stray_of(cross(along, curve.control_1 - third_1), cross(along, curve.control_2 - third_2)) + ends;
    return std::min(by_parameter, across);
}

// The curve with its ends moved, and its controls with them.
Cubic between(const Cubic& curve, Vec2 from, Vec2 to) {
    return {from, curve.control_1 + (from - curve.from), curve.control_2 + (to - curve.to), to};
}

}  // namespace

// Finds the curves of one polygon.
class CurveFinder {
 public:
    CurveFinder(const CurveTable& table, std::span<const Vec2> points, bool closed)
        : table_(table), points_(points), edges_(points.size() - (closed ? 0 : 1)) {
        for (const Vec2 p : points) hits_.push_back(hits_at(p));
    }

    Restored run(bool keep_start) {
        Restored made = from(0);
        if (!any_) return {};
        if (keep_start || !joined_ || edges_ < points_.size()) return made;
        // The first and the last step are two parts of one curve.
        return from(made.steps.front().to);
    }

 private:
    struct Hit {
        int curve = 0;
        double t = 0.0;
    };
    // Edges [first, first + edges) along a curve.
    struct Stretch {
        int curve = 0;
        double t0 = 0.0, t1 = 0.0;
        std::size_t edges = 0;
        double stray = 0.0;  // of the curve from the edges, at most
    };

    [[nodiscard]] double tolerance() const { return table_.scale_ * kFlatMm + kRoundedMm; }
    [[nodiscard]] Vec2 point(std::size_t i) const { return points_[i % points_.size()]; }
    [[nodiscard]] const std::vector<Hit>& hits(std::size_t i) const { return hits_[i % points_.size()]; }
    [[nodiscard]] const Cubic& cubic(int number) const {
        return table_.cubics_[static_cast<std::size_t>(number)];
    }

    [[nodiscard]] std::vector<Hit> hits_at(Vec2 p) const {
        std::vector<Hit> found;
        const std::int64_t home = column_of(p.x);
        for (std::int64_t column = home - 1; column <= home + 1; ++column) {
            auto at = table_.first_from(column, p.y - kFoundMm);
            for (; at != table_.corners_.end() && at->column == column && at->at.y <= p.y + kFoundMm; ++at) {
                if (distance(at->at, p) > kFoundMm) continue;
                if (found.size() == kMostMeeting) return {};
                found.push_back({at->curve, at->t});
            }
        }
        return found;
    }

    // How far the edge from corner i is from the curve there.
    [[nodiscard]] double stray_at(std::size_t i, int curve, double t0, double t1) const {
        return stray_of(cubic(curve).part(t0, t1), {point(i), point(i + 1)});
    }

    // Goes on along the curve as far as the polygon does.
    void extend(std::size_t first, std::size_t most, Stretch& stretch) const {
        const double way = stretch.t1 - stretch.t0;
        while (stretch.edges < most) {
            const std::size_t at = first + stretch.edges;
            std::optional<double> next;
            for (const Hit& hit : hits(at + 1)) {
                if (hit.curve != stretch.curve || (hit.t - stretch.t1) * way <= 0.0) continue;
                if (!next || std::abs(hit.t - stretch.t1) < std::abs(*next - stretch.t1)) next = hit.t;
            }
            if (!next) return;
            const double stray = stray_at(at, stretch.curve, stretch.t1, *next);
            if (stray > tolerance()) return;
            stretch.stray = std::max(stretch.stray, stray);
            stretch.t1 = *next;
            ++stretch.edges;
        }
    }

    // The longest curve that begins with the edge from corner `first` and has at most so many edges.
    [[nodiscard]] std::optional<Stretch> longest(std::size_t first, std::size_t most) const {
        std::optional<Stretch> best;
        for (const Hit& here : hits(first)) {
            for (const Hit& there : hits(first + 1)) {
                if (here.curve != there.curve || here.t == there.t) continue;
                const double stray = stray_at(first, here.curve, here.t, there.t);
                if (stray > tolerance()) continue;
                Stretch stretch{here.curve, here.t, there.t, 1, stray};
                extend(first, most, stretch);
                if (!best ||
                    std::tuple(stretch.edges, -stretch.stray) > std::tuple(best->edges, -best->stray))
                    best = stretch;
            }
        }
        return best;
    }

    // The stretch as one curve, where that stays near the polygon; the stretch is made shorter until it does.
    [[nodiscard]] std::optional<Cubic> drawn(std::size_t first, Stretch& stretch) const {
        while (stretch.edges > 0) {
            const Cubic part = cubic(stretch.curve).part(stretch.t0, stretch.t1);
            const Vec2 from = point(first);
            const Vec2 to = point(first + stretch.edges);
            const double start = distance(part.from, from);
            const double end = distance(part.to, to);
            if (stretch.stray + std::max(start, end) <= tolerance()) return between(part, from, to);
            if (start >= end) return std::nullopt;  // the next edge may begin better
            if (!shorten(first, stretch)) return std::nullopt;
        }
        return std::nullopt;
    }

    bool shorten(std::size_t first, Stretch& stretch) const {
        const std::size_t most = stretch.edges - 1;
        const std::optional<Stretch> shorter = most == 0 ? std::nullopt : longest(first, most);
        if (!shorter || shorter->edges > most) return false;
        stretch = *shorter;
        return true;
    }

    Restored from(std::size_t start) {
        Restored made{start, {}};
        any_ = false;
        joined_ = false;
        std::optional<Stretch> head;
        std::optional<Stretch> tail;
        for (std::size_t i = 0; i < edges_;) {
            std::optional<Stretch> stretch = longest(start + i, edges_ - i);
            const std::optional<Cubic> curve = stretch ? drawn(start + i, *stretch) : std::nullopt;
            const std::size_t edges = curve ? stretch->edges : 1;
            const bool bent = curve && !is_straight(*curve);
            tail = bent ? stretch : std::nullopt;
            if (i == 0) head = tail;
            if (bent) {
                any_ = true;
                made.steps.push_back(
                    {(start + i + edges) % points_.size(), true, curve->control_1, curve->control_2});
            } else {
                for (std::size_t k = 1; k <= edges; ++k)
                    made.steps.push_back({(start + i + k) % points_.size(), false, {}, {}});
            }
            i += edges;
        }
        joined_ = head && tail && made.steps.size() > 1 && head->curve == tail->curve &&
                  tail->t1 == head->t0 && (head->t1 - head->t0) * (tail->t1 - tail->t0) > 0.0;
        return made;
    }

    [[nodiscard]] bool is_straight(const Cubic& curve) const {
        const double least = table_.scale_ * kStraightMm;
        const Segment chord{curve.from, curve.to};
        return distance(curve.control_1, chord) <= least && distance(curve.control_2, chord) <= least;
    }

    const CurveTable& table_;
    std::span<const Vec2> points_;
    std::size_t edges_;
    std::vector<std::vector<Hit>> hits_;  // of each corner
    bool any_ = false;                    // a curve was found
    bool joined_ = false;                 // the last step goes on in the first
};

CurveTable::CurveTable(const std::vector<FlatCurve>& curves) {
    for (const FlatCurve& one : curves) {
        const int number = static_cast<int>(cubics_.size());
        cubics_.push_back(one.cubic);
        for (const FlatCurve::Corner& corner : one.corners)
            corners_.push_back({0, corner.at, number, corner.t});
    }
    sort();
}

std::vector<FlatCurve> CurveTable::curves() const {
    POPUP_INVARIANT(scale_ == 1.0);
    std::vector<FlatCurve> all;
    for (const Cubic& cubic : cubics_) all.push_back({cubic, {}});
    for (const Corner& corner : corners_)
        all[static_cast<std::size_t>(corner.curve)].corners.push_back({corner.at, corner.t});
    for (FlatCurve& one : all) {
        std::sort(one.corners.begin(), one.corners.end(), [](const auto& a, const auto& b) {
            return std::tuple(a.t, a.at.x, a.at.y) < std::tuple(b.t, b.at.x, b.at.y);
        });
    }
    return all;
}

void CurveTable::sort() {
    for (Corner& corner : corners_) corner.column = column_of(corner.at.x);
    std::sort(corners_.begin(), corners_.end(), [](const Corner& a, const Corner& b) {
        return std::tuple(a.column, a.at.y, a.curve, a.t, a.at.x) <
               std::tuple(b.column, b.at.y, b.curve, b.t, b.at.x);
    });
}

std::vector<CurveTable::Corner>::const_iterator CurveTable::first_from(std::int64_t column, double y) const {
    return std::lower_bound(
        corners_.begin(), corners_.end(), std::pair(column, y),
        [](const Corner& corner, const auto& key) { return std::pair(corner.column, corner.at.y) < key; });
}

void CurveTable::move(std::span<const Segment> moves) {
    if (corners_.empty()) return;
    std::vector<Corner> more;
    for (const Segment& move : moves) {
        const std::int64_t column = column_of(move.a.x);
        for (auto at = first_from(column, move.a.y); at != corners_.end() && at->column == column; ++at) {
            if (at->at.y > move.a.y) break;
            if (at->at == move.a) more.push_back({0, move.b, at->curve, at->t});
        }
    }
    corners_.insert(corners_.end(), more.begin(), more.end());
    sort();
}

void CurveTable::scale(double by) {
    for (Cubic& c : cubics_) c = {by * c.from, by * c.control_1, by * c.control_2, by * c.to};
    for (Corner& corner : corners_) corner.at = by * corner.at;
    scale_ *= by;
    sort();
}

Restored CurveTable::restored(std::span<const Vec2> points, bool closed, bool keep_start) const {
    if (corners_.empty() || points.size() < 2) return {};
    return CurveFinder(*this, points, closed).run(keep_start);
}

}  // namespace popup
