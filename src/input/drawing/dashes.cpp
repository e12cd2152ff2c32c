#include "input/drawing/dashes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "base/geometry/cells.h"
#include "base/nth.h"

namespace popup::drawing {
namespace {

// Dashes are stretched until a line has a whole number of them; pieces at its ends are half a dash, or one.
constexpr double kLongestDash = 1.2;
constexpr double kLeastGap = 0.25, kMostGap = 1.6;
// How far pieces of one line lie beside each other, mm: drawings are rounded to hundredths of a unit.
constexpr double kPieceBesideMm = 0.05;
// No dash is longer.
constexpr double kDashReachMm = 25.0;
// Of ends in one place no more are looked at: there no line is drawn in pieces.
constexpr std::size_t kMostInPlace = 64;

bool is_piece(const TracedLine& line) {
    return line.dash == Dash::none && !line.closed && line.use != Use::shape && line.owner == 0 &&
           (line.points.size() == 2 || line.points.size() == 3);
}

bool is_dashed(const TracedLine& line) {
    return line.dash != Dash::none && !line.closed && line.use != Use::shape && line.owner == 0 &&
           line.dash_mm > 0.0 && line.gap_mm > 0.0;
}

bool same_pen(const TracedLine& a, const TracedLine& b) {
    return a.color == b.color && a.named == b.named && a.ruled == b.ruled &&
           std::abs(a.width_mm - b.width_mm) <= 0.01 * std::max(a.width_mm, b.width_mm);
}

class DashJoiner {
 public:
    explicit DashJoiner(Tracing& tracing) : lines_(tracing.lines) {}

    // How many pieces were joined.
    int run() {
        double reach = 0.0;
        for (const TracedLine& line : lines_) {
            if (is_dashed(line)) reach = std::max(reach, kMostGap * line.gap_mm);
        }
        if (reach == 0.0) return 0;
        cell_mm_ = std::min(reach, kDashReachMm);
        for (std::size_t i = 0; i < lines_.size(); ++i) {
            if (!is_piece(lines_[i])) continue;
            place(i, false);
            place(i, true);
        }
        for (std::size_t i = 0; i < lines_.size(); ++i) {
            if (!is_dashed(lines_[i])) continue;
            lengthen(i, false);
            lengthen(i, true);
        }
        std::erase_if(lines_, [](const TracedLine& line) { return line.points.size() < 2; });
        return joined_;
    }
    [[nodiscard]] int first_element() const { return first_element_; }

 private:
    struct End {
        std::size_t line = 0;
        bool last = false;
    };

    // The n-th point from an end of a line.
    [[nodiscard]] Vec2 point(End end, std::size_t n) const {
        const std::vector<Vec2>& points = nth(lines_, end.line).points;
        return end.last ? points[points.size() - 1 - n] : points[n];
    }
    [[nodiscard]] PlaneCell cell_of(Vec2 p) const {
        return {static_cast<std::int64_t>(std::floor(p.x / cell_mm_)),
                static_cast<std::int64_t>(std::floor(p.y / cell_mm_))};
    }
    void place(std::size_t line, bool last) {
        std::vector<End>& ends = ends_[cell_of(point({line, last}, 0))];
        if (ends.size() < kMostInPlace) ends.push_back({line, last});
    }

    // How far behind the end of a dashed line a piece goes on, in its direction; nullopt when it does not.
    [[nodiscard]] std::optional<double> gap_to(End dashed, End piece) const {
        const TracedLine& line = nth(lines_, dashed.line);
        const TracedLine& other = nth(lines_, piece.line);
        if (other.points.size() < 2 || !same_pen(line, other)) return std::nullopt;
        const Vec2 end = point(dashed, 0);
        const Vec2 way = unit(end - point(dashed, 1));
        const Vec2 near = point(piece, 0) - end;
        const Vec2 far = point(piece, 1) - end;
        const double gap = dot(way, near);
        const double long_mm = dot(way, far) - gap;
        if (gap < kLeastGap * line.gap_mm || gap > std::min(kMostGap * line.gap_mm, kDashReachMm) ||
            long_mm <= 0.0 || long_mm > std::min(kLongestDash * line.dash_mm, kDashReachMm) ||
            std::abs(cross(way, near)) > kPieceBesideMm || std::abs(cross(way, far)) > kPieceBesideMm) {
            return std::nullopt;
        }
        return gap;
    }

    void lengthen(std::size_t line, bool last) {
        const End dashed{line, last};
        std::optional<double> nearest;
        End best;
        const PlaneCell at = cell_of(point(dashed, 0));
        for (std::int64_t x = at.x - 1; x <= at.x + 1; ++x) {
            for (std::int64_t y = at.y - 1; y <= at.y + 1; ++y) {
                const auto ends = ends_.find({x, y});
                if (ends == ends_.end()) continue;
                for (const End& end : ends->second) {
                    const auto gap = gap_to(dashed, end);
                    if (!gap || (nearest && *nearest <= *gap)) continue;
                    nearest = gap;
                    best = end;
                }
            }
        }
        if (nearest) take(dashed, best);
    }

    // The dashed line goes on to the end of the piece, of which a second leg is left.
    void take(End dashed, End piece) {
        const Vec2 to = point(piece, 1);
        TracedLine& from = nth(lines_, piece.line);
        if (joined_++ == 0 || from.element < first_element_) first_element_ = from.element;
        from.points.erase(piece.last ? from.points.end() - 1 : from.points.begin());
        TracedLine& line = nth(lines_, dashed.line);
        // A longer line may be a curve, whose chords stay as they are.
        if (line.points.size() == 2) {
            (dashed.last ? line.points.back() : line.points.front()) = to;
        } else {
            line.points.insert(dashed.last ? line.points.end() : line.points.begin(), to);
        }
    }

    std::vector<TracedLine>& lines_;
    double cell_mm_ = 0.0;
    std::unordered_map<PlaneCell, std::vector<End>, PlaneCellHash> ends_;
    int joined_ = 0;
    int first_element_ = 0;
};

}  // namespace

void join_dashes(Tracing& tracing, Diagnostics& diagnostics) {
    DashJoiner joiner(tracing);
    const int joined = joiner.run();
    if (joined == 0) return;
    const bool one = joined == 1;
    diagnostics
        .remark(
            "dashes-joined", nth(tracing.elements, joiner.first_element()).place,
            fmt::format("{} short solid line{} a gap behind the end of a dashed line {} taken for {} of it",
                        joined, one ? "" : "s", one ? "is" : "are", one ? "a dash" : "dashes"))
        .hint("cuts need another colour, or a name such as \"cut\" on their layer, class or id");
}

}  // namespace popup::drawing
