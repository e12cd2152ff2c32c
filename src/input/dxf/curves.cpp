#include "input/dxf/curves.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/nth.h"

namespace popup::dxf {
namespace {

constexpr double kPieceRad = std::numbers::pi / 6.0;
// Bulges less than this, which leave the chord by half as much of its length, are straight.
constexpr double kStraightBulge = 1e-9;
constexpr double kOfSize = 1e-6;
constexpr int kMostHalvings = 12;

// A point of a rational curve, times its weight.
struct Weighted {
    double x = 0.0, y = 0.0, w = 1.0;

    [[nodiscard]] Vec2 point() const { return {x / w, y / w}; }
};
Weighted mix(const Weighted& a, const Weighted& b, double t) {
    return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), a.w + t * (b.w - a.w)};
}

// The Bézier curves of a B-spline, one a span of knots.
class Spans {
 public:
    Spans(const Spline& spline, double tolerance) : spline_(spline), tolerance_(tolerance) {}

    void add_to(Path& path) {
        const std::size_t degree = at(spline_.degree);
        std::size_t before = 0;  // the last span that is one; 0: none
        for (std::size_t span = degree; span < spline_.controls.size(); ++span) {
            if (!(spline_.knots[span] < spline_.knots[span + 1])) continue;
            take(span);
            // Where more knots than its degree lie on one another, it may begin anew elsewhere.
            const Vec2 from = bezier_.front().point();
            const bool anew = span - before > degree && distance(from, path.at()) > tolerance_;
            if (before == 0 || anew) path.move(from);
            before = span;
            append(path);
            if (path.size() > kStepsLimit) return;
        }
    }

 private:
    static std::size_t at(int number) { return static_cast<std::size_t>(number); }

    [[nodiscard]] Weighted control(std::size_t i) const {
        const double w = spline_.weights.empty() ? 1.0 : spline_.weights[i];
        return {w * spline_.controls[i].x, w * spline_.controls[i].y, w};
    }

    // The j-th control of a span's curve is the spline's blossom at j times its last and else its first knot.
    void take(std::size_t span) {
        const std::size_t degree = at(spline_.degree);
        const std::vector<double>& knots = spline_.knots;
        bezier_.resize(degree + 1);
        for (std::size_t j = 0; j <= degree; ++j) {
            work_.clear();
            for (std::size_t i = span - degree; i <= span; ++i) work_.push_back(control(i));
            for (std::size_t r = 1; r <= degree; ++r) {
                const double value = r <= j ? knots[span + 1] : knots[span];
                for (std::size_t i = degree; i >= r; --i) {
                    const std::size_t left = span - degree + i;
                    const double from = knots[left];
                    const double to = knots[left + degree + 1 - r];
                    work_[i] = mix(work_[i - 1], work_[i], (value - from) / (to - from));
                }
            }
            bezier_[j] = work_[degree];
        }
    }

    void append(Path& path) {
        const auto p = [this](std::size_t i) { return bezier_[i].point(); };
        if (spline_.weights.empty() && spline_.degree <= 3) {
            if (spline_.degree == 1) return path.line(p(1));
            if (spline_.degree == 2) return path.quadratic(p(1), p(2));
            return path.cubic(p(1), p(2), p(3));
        }
        approximate(path);
    }

    struct Sample {
        Vec2 at, speed;
    };
    Sample sample(double t) {
        work_ = bezier_;
        const std::size_t degree = at(spline_.degree);
        for (std::size_t r = degree; r > 1; --r) {
            for (std::size_t i = 0; i < r; ++i) work_[i] = mix(work_[i], work_[i + 1], t);
        }
        const Weighted a = work_[0];
        const Weighted b = work_[1];
        const Weighted c = mix(a, b, t);
        const Vec2 point = c.point();
        const double n = static_cast<double>(degree);
        const Vec2 speed{n * ((b.x - a.x) - (b.w - a.w) * point.x) / c.w,
                         n * ((b.y - a.y) - (b.w - a.w) * point.y) / c.w};
        return {point, speed};
    }

    // By cubics with the curve's points and tangents, of halves until they are near enough.
    void approximate(Path& path) {
        struct Part {
            double from, to;
            int halvings;
        };
        std::vector<Part> parts{{0.0, 1.0, 0}};
        while (!parts.empty() && path.size() <= kStepsLimit) {
            const Part part = parts.back();
            parts.pop_back();
            const double width = part.to - part.from;
            const Sample a = sample(part.from);
            const Sample b = sample(part.to);
            const Cubic cubic{a.at, a.at + (width / 3.0) * a.speed, b.at - (width / 3.0) * b.speed, b.at};
            double off = 0.0;
            for (const double t : {0.25, 0.5, 0.75})
                off = std::max(off, distance(cubic.at(t), sample(part.from + t * width).at));
            if (off <= tolerance_ || part.halvings >= kMostHalvings || !std::isfinite(off)) {
                path.cubic(cubic.control_1, cubic.control_2, cubic.to);
                continue;
            }
            const double half = part.from + 0.5 * width;
            parts.push_back({half, part.to, part.halvings + 1});
            parts.push_back({part.from, half, part.halvings + 1});
        }
    }

    const Spline& spline_;
    double tolerance_;
    std::vector<Weighted> bezier_, work_;
};

// Solves a tridiagonal system with 1-based neighbours: below[i] x[i-1] + middle[i] x[i] + above[i] x[i+1] =
// right[i]. The middle outweighs its neighbours.
std::vector<Vec2> solve(const std::vector<double>& below, std::vector<double> middle,
                        const std::vector<double>& above, std::vector<Vec2> right) {
    const std::size_t n = right.size();
    for (std::size_t i = 1; i < n; ++i) {
        const double by = below[i] / middle[i - 1];
        middle[i] -= by * above[i - 1];
        right[i] = right[i] - by * right[i - 1];
    }
    for (std::size_t i = n; i-- > 0;) {
        if (i + 1 < n) right[i] = right[i] - above[i] * right[i + 1];
        right[i] = (1.0 / middle[i]) * right[i];
    }
    return right;
}

// Tangents at the points of the cubic spline through them, by parameter.
std::vector<Vec2> tangents(const Spline& spline, const std::vector<Vec2>& p, const std::vector<double>& h) {
    const std::size_t n = p.size();
    std::vector<double> below(n, 0.0);
    std::vector<double> middle(n, 1.0);
    std::vector<double> above(n, 0.0);
    std::vector<Vec2> right(n);
    for (std::size_t i = 1; i + 1 < n; ++i) {
        below[i] = h[i];
        middle[i] = 2.0 * (h[i - 1] + h[i]);
        above[i] = h[i - 1];
        right[i] = 3.0 * ((h[i] / h[i - 1]) * (p[i] - p[i - 1]) + (h[i - 1] / h[i]) * (p[i + 1] - p[i]));
    }
    const auto end = [&](std::size_t i, double& beside, const std::optional<Vec2>& way, Vec2 chord,
                         double step) {
        // Programs write tangents of any length, and mean the direction.
        if (way && length(*way) > 0.0) {
            right[i] = unit(*way);
            return;
        }
        middle[i] = 2.0;
        beside = 1.0;
        right[i] = (3.0 / step) * chord;
    };
    end(0, above[0], spline.first_way, p[1] - p[0], h[0]);
    end(n - 1, below[n - 1], spline.last_way, p[n - 1] - p[n - 2], h[n - 2]);
    return solve(below, middle, above, std::move(right));
}

void add_through(const Spline& spline, Path& path) {
    std::vector<Vec2> p;
    for (const Vec2 at : spline.through) {
        if (p.empty() || at != p.back()) p.push_back(at);
    }
    if (spline.closed && p.size() > 2 && p.front() == p.back()) p.pop_back();
    if (p.size() < 2) return;
    const bool ring = spline.closed && p.size() > 2;
    // What is said at the ends of a row is a 10^13th of it 24 points on: a ring is such a row, run on both
    // ways.
    constexpr std::size_t kRound = 24;
    const std::size_t count = p.size();
    std::vector<Vec2> all = p;
    const std::size_t lead = ring ? kRound : 0;
    if (ring) {
        all.clear();
        for (std::size_t i = 0; i < count + 2 * lead + 1; ++i)
            all.push_back(p[(i + count * lead - lead) % count]);
    }
    std::vector<double> h;
    for (std::size_t i = 0; i + 1 < all.size(); ++i) h.push_back(distance(all[i], all[i + 1]));
    const std::vector<Vec2> way = tangents(spline, all, h);
    const std::size_t last = ring ? lead + count : all.size() - 1;
    path.move(all[lead]);
    for (std::size_t i = lead; i < last; ++i) {
        // The ring's ends are one point, with one tangent.
        const Vec2 next = ring && i + 1 == last ? way[lead] : way[i + 1];
        path.cubic(all[i] + (h[i] / 3.0) * way[i], all[i + 1] - (h[i] / 3.0) * next, all[i + 1]);
    }
    if (ring) path.close();
}

}  // namespace

void add_arc(Path& path, Vec2 centre, Vec2 u, Vec2 v, double from, double to, Vec2 end) {
    const double sweep = to - from;
    const int pieces = std::max(1, static_cast<int>(std::ceil(std::abs(sweep) / kPieceRad - 1e-9)));
    const double step = sweep / pieces;
    const double reach = 4.0 / 3.0 * std::tan(0.25 * step);
    Vec2 begin = path.at();
    double c = std::cos(from);
    double s = std::sin(from);
    for (int i = 1; i <= pieces; ++i) {
        const double t = from + i * step;
        const double next_c = std::cos(t);
        const double next_s = std::sin(t);
        const Vec2 to_at = i == pieces ? end : centre + next_c * u + next_s * v;
        path.cubic(begin + reach * (c * v - s * u), to_at - reach * (next_c * v - next_s * u), to_at);
        begin = to_at;
        c = next_c;
        s = next_s;
    }
}

void add_bulge(Path& path, double bulge, Vec2 to) {
    const Vec2 from = path.at();
    if (!(std::abs(bulge) > kStraightBulge) || from == to) return path.line(to);
    const Vec2 half = 0.5 * (to - from);
    // From the chord's middle to the centre, to the left where less than half a turn runs counter-clockwise.
    const Vec2 centre = from + half + ((1.0 - bulge * bulge) / (2.0 * bulge)) * left_of(half);
    const Vec2 u = from - centre;
    add_arc(path, centre, u, left_of(u), 0.0, 4.0 * std::atan(bulge), to);
}

std::string add_spline(const Spline& spline, Path& path) {
    if (spline.controls.empty() && spline.through.size() >= 2) {
        add_through(spline, path);
        return {};
    }
    if (spline.degree < 1 || spline.degree > kMostDegree)
        return fmt::format("a spline's degree is {}, and not from 1 to {}", spline.degree, kMostDegree);
    const std::size_t order = static_cast<std::size_t>(spline.degree) + 1;
    if (spline.controls.size() < order) {
        return fmt::format("a spline of degree {} needs {} control points, and has {}", spline.degree, order,
                           spline.controls.size());
    }
    if (spline.knots.size() != spline.controls.size() + order) {
        return fmt::format("a spline of degree {} with {} control points has {} knots, and here are {}",
                           spline.degree, spline.controls.size(), spline.controls.size() + order,
                           spline.knots.size());
    }
    if (!std::is_sorted(spline.knots.begin(), spline.knots.end())) return "the knots of a spline go back";
    if (!(spline.knots[order - 1] < spline.knots[spline.controls.size()]))
        return "the knots of a spline are all one";
    if (!spline.weights.empty() && spline.weights.size() != spline.controls.size()) {
        return fmt::format("a spline with {} control points has {} weights", spline.controls.size(),
                           spline.weights.size());
    }
    if (std::any_of(spline.weights.begin(), spline.weights.end(), [](double w) { return !(w > 0.0); }))
        return "a weight of a spline is not above zero";
    Box box;
    for (const Vec2 p : spline.controls) box.extend(p);
    Spans(spline, kOfSize * std::max(box.width(), box.height())).add_to(path);
    return {};
}

}  // namespace popup::dxf
