#include "folded/carton/closing_angles.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

namespace popup::folded {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kDegree = kPi / 180.0;
constexpr double kRightDeg = 90.0;
constexpr double kLeastDeg = 0.5;      // folds that go by less, or by nearly 180°, are no corners
constexpr double kAsWide = 0.02;       // walls that differ by less are as wide as each other
constexpr double kAsLong = 0.06;       // sides of an end may be shorter than their wall by this share,
constexpr double kAsLongWallMm = 1.5;  // and by this: they go inside
constexpr double kSameEndMm = 0.5;     // a side of an end and its fold
constexpr double kNearlyRegularDeg = 10.0;
constexpr int kHalvings = 100;
constexpr int kSteps = 20;

using Angles = std::vector<double>;

double sum(const Angles& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

bool are_corners(const Angles& deg) {
    return std::all_of(deg.begin(), deg.end(),
                       [](double one) { return one > kLeastDeg && one < 180.0 - kLeastDeg; });
}

bool meet(const std::vector<double>& widths, const Angles& deg) {
    return gap_of(widths, deg) <= kMeets * sum(widths) && std::abs(sum(deg) - 360.0) < 1e-6;
}

Angles of_triangle(const std::vector<double>& widths) {
    Angles deg;
    for (std::size_t i = 0; i < 3; ++i) {
        const double a = widths[i];
        const double b = widths[(i + 1) % 3];
        const double c = widths[(i + 2) % 3];
        const double cosine = (a * a + b * b - c * c) / (2.0 * a * b);
        if (std::abs(cosine) >= 1.0) return {};
        deg.push_back(180.0 - std::acos(cosine) / kDegree);
    }
    return deg;
}

// Half of what each side is seen by from the middle of the circle, radians; empty: one is longer than the
// others together.
std::vector<double> seen_from_middle(const std::vector<double>& sides) {
    const double all = sum(sides);
    const std::size_t longest =
        static_cast<std::size_t>(std::max_element(sides.begin(), sides.end()) - sides.begin());
    if (2.0 * sides[longest] >= all * (1.0 - 1e-9)) return {};
    const auto half = [&](std::size_t i, double radius) {
        return std::asin(std::min(1.0, sides[i] / (2.0 * radius)));
    };
    const auto others = [&](double radius) {
        double seen = 0.0;
        for (std::size_t i = 0; i < sides.size(); ++i) seen += i == longest ? 0.0 : half(i, radius);
        return seen;
    };
    double low = sides[longest] / 2.0;
    double high = low;
    // The middle is inside, or beyond the longest side.
    const bool inside = others(low) + half(longest, low) >= kPi;
    const auto is_small = [&](double radius) {
        return inside ? others(radius) + half(longest, radius) > kPi : others(radius) < half(longest, radius);
    };
    do {
        high *= 2.0;
    } while (is_small(high) && high < 1e9 * all);
    for (int i = 0; i < kHalvings; ++i) {
        const double middle = 0.5 * (low + high);
        (is_small(middle) ? low : high) = middle;
    }
    std::vector<double> halves;
    for (std::size_t i = 0; i < sides.size(); ++i) halves.push_back(half(i, high));
    if (!inside) halves[longest] = kPi - halves[longest];
    return halves;
}

Angles on_circle(const std::vector<double>& sides) {
    const std::vector<double> halves = seen_from_middle(sides);
    Angles deg;
    for (std::size_t i = 0; i < halves.size(); ++i)
        deg.push_back((halves[i] + halves[(i + 1) % halves.size()]) / kDegree);
    return deg;
}

// The nearest angles at which the walls meet.
std::optional<Angles> nearest_that_meet(const std::vector<double>& widths, const Angles& from) {
    const auto count = static_cast<Eigen::Index>(widths.size());
    Eigen::VectorXd turn(count);
    for (Eigen::Index i = 0; i < count; ++i) turn[i] = from[static_cast<std::size_t>(i)] * kDegree;
    const double all = sum(widths);
    for (int step = 0; step < kSteps; ++step) {
        Eigen::Vector3d open(0.0, 0.0, turn.sum() - 2.0 * kPi);
        Eigen::MatrixXd by = Eigen::MatrixXd::Zero(3, count);
        by.row(2).setOnes();
        double way = 0.0;
        for (Eigen::Index wall = 0; wall < count; ++wall) {
            const double width = widths[static_cast<std::size_t>(wall)] / all;
            open[0] += width * std::cos(way);
            open[1] += width * std::sin(way);
            for (Eigen::Index fold = 0; fold < wall; ++fold) {
                by(0, fold) -= width * std::sin(way);
                by(1, fold) += width * std::cos(way);
            }
            way += turn[wall];
        }
        if (open.lpNorm<Eigen::Infinity>() < 1e-12) break;
        turn -= by.completeOrthogonalDecomposition().solve(open);
    }
    Angles deg;
    for (const double one : turn) deg.push_back(one / kDegree);
    if (!are_corners(deg) || gap_of(widths, deg) > 1e-6 * all) return std::nullopt;
    return deg;
}

double around_from(double deg) { return deg - 360.0 * std::floor(deg / 360.0); }

// So many right angles one after another, from a wall on; what is left goes from the far end of the last wall
// between them back to the first, all of it on a circle.
std::optional<Angles> with_right_angles(const std::vector<double>& widths, std::size_t first,
                                        std::size_t right) {
    const std::size_t count = widths.size();
    if (count < right + 2) return std::nullopt;
    const auto at = [&](std::size_t i) { return (first + i) % count; };
    Vec2 end{0.0, 0.0};
    Angles deg(count, kRightDeg);
    for (std::size_t i = 0; i <= right; ++i) {
        const double way = 0.5 * kPi * static_cast<double>(i);
        end = end + widths[at(i)] * Vec2{std::cos(way), std::sin(way)};
    }
    const double across = around_from(std::atan2(-end.y, -end.x) / kDegree);
    double leave = around_from(across - kRightDeg * static_cast<double>(right));
    double come = around_from(-across);
    std::vector<double> rest{length(end)};
    for (std::size_t i = right + 1; i < count; ++i) rest.push_back(widths[at(i)]);
    if (rest.size() == 2) {
        if (std::abs(rest[0] - rest[1]) > kMeets * sum(widths)) return std::nullopt;
    } else {
        const double one = widths[first];
        const double other = widths[at(right)];
        if (right != 2 || std::abs(one - other) > kAsWide * std::max(one, other)) return std::nullopt;
        const Angles round = on_circle(rest);
        if (round.empty()) return std::nullopt;
        // The way across is a side of what lies on the circle, and is inside: the corners at its ends are
        // those of both shapes.
        leave -= 180.0 - round.front();
        come -= 180.0 - round.back();
        for (std::size_t i = 1; i + 1 < round.size(); ++i) deg[at(right + i)] = round[i];
    }
    deg[at(right)] = leave;
    deg[at(count - 1)] = come;
    if (!are_corners(deg)) return std::nullopt;
    return deg;
}

// The most right angles count, and then how wide the wall between the first two of them is.
std::optional<Angles> with_most_right_angles(const std::vector<double>& widths) {
    std::optional<Angles> best;
    std::pair<std::size_t, double> most{0, 0.0};
    for (const std::size_t right : {std::size_t{3}, std::size_t{2}}) {
        for (std::size_t first = 0; first < widths.size(); ++first) {
            auto deg = with_right_angles(widths, first, right);
            const std::pair score{right, widths[(first + 1) % widths.size()]};
            if (!deg || (best && score <= most)) continue;
            most = score;
            best = std::move(deg);
        }
    }
    return best;
}

}  // namespace

double gap_of(const std::vector<double>& widths, const std::vector<double>& deg) {
    Vec2 end{0.0, 0.0};
    double way = 0.0;
    for (std::size_t i = 0; i < widths.size(); ++i) {
        end = end + widths[i] * Vec2{std::cos(way * kDegree), std::sin(way * kDegree)};
        way += deg[i];
    }
    return length(end);
}

std::vector<ClosingAngles> closing_angles(const std::vector<double>& widths,
                                          const std::optional<std::vector<double>>& of_end) {
    if (widths.size() < 3) return {};
    if (widths.size() == 3) {
        const Angles deg = of_triangle(widths);
        if (deg.empty()) return {};
        return {{deg, {}}};
    }
    const double share = 360.0 / static_cast<double>(widths.size());
    const Angles alike(widths.size(), share);
    if (meet(widths, alike)) return {{alike, {}}};
    std::vector<ClosingAngles> found;
    if (of_end) {
        if (auto deg = nearest_that_meet(widths, *of_end))
            found.push_back({std::move(*deg), "as the panel has it that closes an end"});
    }
    const Angles round = on_circle(widths);
    const bool nearly_regular = std::all_of(
        round.begin(), round.end(), [&](double one) { return std::abs(one - share) < kNearlyRegularDeg; });
    if (round.empty()) return found;
    if (widths.size() == 4 || !nearly_regular) {
        if (auto deg = with_most_right_angles(widths))
            found.push_back({std::move(*deg), "with as many right angles as they can have"});
    }
    found.push_back({round, "in the shape that has the most room"});
    return found;
}

std::optional<std::vector<double>> fold_angles_of_end(const Ring& outline, const Segment& fold,
                                                      const std::vector<double>& widths, std::size_t wall) {
    const std::size_t count = widths.size();
    if (outline.size() != count) return std::nullopt;
    const auto corner = [&](std::size_t i) { return outline[i % count]; };
    const auto is_fold = [&](std::size_t i) {
        const auto near = [](Vec2 a, Vec2 b) { return distance(a, b) <= kSameEndMm; };
        return (near(corner(i), fold.a) && near(corner(i + 1), fold.b)) ||
               (near(corner(i), fold.b) && near(corner(i + 1), fold.a));
    };
    std::size_t first = 0;
    while (first < count && !is_fold(first)) ++first;
    if (first == count) return std::nullopt;
    // Side i of the outline is that of a wall; which way the walls go on, their widths say.
    for (const bool onwards : {true, false}) {
        std::vector<double> deg(count, 0.0);
        bool fits = true;
        for (std::size_t i = 0; i < count && fits; ++i) {
            const std::size_t side = first + i;
            const std::size_t number = onwards ? (wall + i) % count : (wall + count - i) % count;
            const Vec2 way = corner(side + 1) - corner(side);
            const Vec2 next = corner(side + 2) - corner(side + 1);
            fits = std::abs(length(way) - widths[number]) <= kAsLongWallMm + kAsLong * widths[number];
            deg[onwards ? number : (number + count - 1) % count] =
                std::abs(std::atan2(cross(way, next), dot(way, next))) / kDegree;
        }
        if (fits && are_corners(deg)) return deg;
    }
    return std::nullopt;
}

}  // namespace popup::folded
