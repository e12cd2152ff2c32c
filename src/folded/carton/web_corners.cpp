#include "folded/carton/web_corners.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>

#include "base/nth.h"
#include "folded/asked.h"

namespace popup::folded {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr std::size_t kFolds = 5;
constexpr double kSameRad = 2e-3;  // angles on the sheet, and of folds, that differ by less are one

bool is_same(double a, double b) { return std::abs(a - b) < kSameRad; }

// Away from a corner.
Vec2 away(const Sheet& sheet, const Fold& fold, Vec2 corner) {
    const Segment line = sheet.line_of(fold);
    return distance(line.a, corner) < distance(line.b, corner) ? unit(line.b - line.a)
                                                               : unit(line.a - line.b);
}

std::optional<WebCorner> web_at(const Sheet& sheet, const Loop& loop) {
    if (!loop.corner || loop.steps.size() != kFolds) return std::nullopt;
    double sum = 0.0;
    const auto sense = [&](std::size_t i) {
        const double target = nth(sheet.folds, loop.steps[i % kFolds].fold).target;
        return target < 0.0 ? -1.0 : target > 0.0 ? 1.0 : 0.0;
    };
    for (std::size_t i = 0; i < kFolds; ++i) sum += sense(i);
    if (std::abs(sum) != kFolds - 2.0) return std::nullopt;
    std::size_t diagonal = 0;
    while (diagonal < kFolds && sense(diagonal) * sum >= 0.0) ++diagonal;
    if (diagonal == kFolds) return std::nullopt;
    // By their places after the diagonal: a web, a wall, a wall, a web.
    const auto fold = [&](std::size_t i) { return loop.steps[(diagonal + i) % kFolds].fold; };
    const auto between = [&](std::size_t i) {
        const Vec2 a = away(sheet, nth(sheet.folds, fold(i)), loop.at);
        const Vec2 b = away(sheet, nth(sheet.folds, fold(i + 1)), loop.at);
        return std::acos(std::clamp(dot(a, b), -1.0, 1.0));
    };
    const double base = between(2);
    if (!is_same(between(0), between(4)) || !is_same(between(1), 0.5 * kPi) ||
        !is_same(between(3), 0.5 * kPi) || !is_same(base + kPi + 2.0 * between(0), 2.0 * kPi))
        return std::nullopt;
    for (const std::size_t wall : {2, 3}) {
        if (!is_same(std::abs(nth(sheet.folds, fold(wall)).target), 0.5 * kPi)) return std::nullopt;
    }
    WebCorner web;
    web.walls = {fold(2), fold(3)};
    web.webs = {fold(1), fold(4)};
    web.diagonal = fold(0);
    web.web_angle = kPi - 0.5 * base;
    return web;
}

}  // namespace

std::vector<WebCorner> find_web_corners(const Sheet& sheet) {
    std::vector<WebCorner> found;
    for (std::size_t i = 0; i < sheet.loops.size(); ++i) {
        std::optional<WebCorner> web = web_at(sheet, sheet.loops[i]);
        if (!web) continue;
        web->loop = static_cast<int>(i);
        found.push_back(*web);
    }
    return found;
}

void fold_web_corners(const CreasePattern& pattern, const FoldOptions& options, Sheet& sheet,
                      Diagnostics& diagnostics) {
    std::vector<WebCorner> folded;
    for (const WebCorner& web : find_web_corners(sheet)) {
        Fold& diagonal = nth(sheet.folds, web.diagonal);
        const bool other_diagonal =
            is_asked(pattern, options, diagonal) && !is_same(std::abs(diagonal.target), kPi);
        const bool other_webs = std::any_of(web.webs.begin(), web.webs.end(), [&](int fold) {
            return is_asked(pattern, options, nth(sheet.folds, fold));
        });
        if (other_diagonal || other_webs) continue;
        diagonal.target = std::copysign(kPi, diagonal.target);
        for (const int fold : web.webs) {
            double& target = nth(sheet.folds, fold).target;
            target = std::copysign(web.web_angle, target);
        }
        folded.push_back(web);
    }
    if (folded.empty()) return;
    const WebCorner& first = folded.front();
    diagnostics.remark(
        "web-corners", nth(pattern.lines, nth(sheet.folds, first.diagonal).line).place,
        fmt::format("{} of this sheet {} closed by {}, the first at {}: {} folded flat, and the folds beside "
                    "{} by {:.1f}°, so that walls at right angles meet",
                    folded.size() == 1 ? "a corner" : fmt::format("{} corners", folded.size()),
                    folded.size() == 1 ? "is" : "are", folded.size() == 1 ? "a web" : "webs",
                    shown_point(pattern.ruler, nth(sheet.loops, first.loop).at),
                    folded.size() == 1 ? "its diagonal is" : "their diagonals are",
                    folded.size() == 1 ? "it" : "them", first.web_angle * 180.0 / kPi));
}

}  // namespace popup::folded
