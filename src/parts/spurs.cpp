#include "parts/spurs.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "base/geometry/tolerances.h"
#include "parts/joining.h"

namespace popup {
namespace {

// A closed line from which spurs are taken off, tip by tip.
class Peeler {
 public:
    explicit Peeler(const std::vector<Vec2>& points)
        : points_(points), before_(points.size()), after_(points.size()), left_(points.size()) {
        const std::size_t n = points.size();
        for (std::size_t i = 0; i < n; ++i) {
            before_[i] = (i + n - 1) % n;
            after_[i] = (i + 1) % n;
        }
    }

    std::vector<std::vector<Vec2>> run() {
        std::size_t at = 0;
        for (std::size_t unchanged = 0; left_ >= 3 && unchanged <= left_; ++unchanged) {
            if (is_doubled(at)) {
                at = take_out(at, after_[at]);
                unchanged = 0;
            } else if (is_tip(at)) {
                at = peel(at);
                unchanged = 0;
            } else {
                at = after_[at];
            }
        }
        std::erase_if(spurs_, [](const std::vector<Vec2>& spur) {
            return drawing::length_of(spur) < drawing::kJoinMm;
        });
        return std::move(spurs_);
    }

 private:
    [[nodiscard]] bool is_doubled(std::size_t i) const {
        return distance(points_[i], points_[after_[i]]) <= kSameLineMm;
    }

    // Whether the line turns back at a corner, and both ways lie on each other as far as the shorter one
    // goes.
    [[nodiscard]] bool is_tip(std::size_t i) const {
        const Vec2 to = points_[before_[i]] - points_[i];
        const Vec2 fro = points_[after_[i]] - points_[i];
        if (!(dot(to, fro) > 0.0)) return false;
        return std::abs(cross(to, fro)) <= kSameLineMm * std::max(length(to), length(fro));
    }

    // Takes off a tip as far as the shorter way goes; returns the corner there.
    std::size_t peel(std::size_t tip) {
        const std::size_t a = before_[tip];
        const std::size_t b = after_[tip];
        const std::size_t base =
            distance(points_[a], points_[tip]) <= distance(points_[b], points_[tip]) ? a : b;
        if (spurs_.empty() || distance(spurs_.back().back(), points_[tip]) > kSameLineMm)
            spurs_.push_back({points_[tip]});
        spurs_.back().push_back(points_[base]);
        return take_out(tip, base);
    }

    std::size_t take_out(std::size_t corner, std::size_t next) {
        after_[before_[corner]] = after_[corner];
        before_[after_[corner]] = before_[corner];
        --left_;
        return next;
    }

    const std::vector<Vec2>& points_;
    std::vector<std::size_t> before_, after_;
    std::size_t left_;
    std::vector<std::vector<Vec2>> spurs_;
};

}  // namespace

std::vector<std::vector<Vec2>> spurs_of(const std::vector<Vec2>& closed) { return Peeler(closed).run(); }

}  // namespace popup
