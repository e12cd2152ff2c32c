#include "input/drawing/dashes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <tuple>
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
// By how much of itself the width of a stroke may differ.
constexpr double kWidth = 0.01;
// Where one place has more ends, none are looked at: there no line is drawn in pieces.
constexpr std::size_t kMostInPlace = 64;

struct End {
    std::size_t line = 0;
    bool last = false;
};

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
           std::abs(a.width_mm - b.width_mm) <= kWidth * std::max(a.width_mm, b.width_mm);
}

// Dashed lines of one colour and name, and the ends of what may be pieces of them.
class Pen {
 public:
    void add_dashed(const TracedLine& line) {
        reach_mm_ = std::max(reach_mm_, kMostGap * line.gap_mm);
        longest_mm_ = std::max(longest_mm_, kLongestDash * line.dash_mm);
        widths_mm_.push_back(line.width_mm);
    }
    void settle() {
        // A gap may be as small as a number can be: cells are never so small that they cannot be counted.
        cell_mm_ = std::clamp(reach_mm_, kPieceBesideMm, kDashReachMm);
        std::sort(widths_mm_.begin(), widths_mm_.end());
    }
    // Whether no dashed line is too thin or too thick to have a piece of that width.
    [[nodiscard]] bool is_as_wide(double width_mm) const {
        const auto at =
            std::lower_bound(widths_mm_.begin(), widths_mm_.end(), width_mm * (1.0 - 2.0 * kWidth));
        return at != widths_mm_.end() && *at <= width_mm * (1.0 + 2.0 * kWidth);
    }
    [[nodiscard]] bool is_as_long(double length_mm) const {
        return length_mm <= std::min(longest_mm_, kDashReachMm);
    }
    void place(End end, Vec2 at) {
        std::vector<End>& ends = ends_[cell_of(at)];
        if (ends.size() <= kMostInPlace) ends.push_back(end);
    }
    // Calls `use` with all ends near a point, and with some that are further away.
    template <typename Use>
    void each_near(Vec2 p, Use use) const {
        const PlaneCell at = cell_of(p);
        for (std::int64_t x = at.x - 1; x <= at.x + 1; ++x) {
            for (std::int64_t y = at.y - 1; y <= at.y + 1; ++y) {
                const auto ends = ends_.find({x, y});
                // Not some of too many, lest it be told by their order which.
                if (ends == ends_.end() || ends->second.size() > kMostInPlace) continue;
                for (const End end : ends->second) use(end);
            }
        }
    }

 private:
    [[nodiscard]] PlaneCell cell_of(Vec2 p) const {
        return {static_cast<std::int64_t>(std::floor(p.x / cell_mm_)),
                static_cast<std::int64_t>(std::floor(p.y / cell_mm_))};
    }

    double reach_mm_ = 0.0, longest_mm_ = 0.0, cell_mm_ = 0.0;
    std::vector<double> widths_mm_;  // of the dashed lines
    std::unordered_map<PlaneCell, std::vector<End>, PlaneCellHash> ends_;
};

class DashJoiner {
 public:
    explicit DashJoiner(Tracing& tracing) : lines_(tracing.lines) {}

    // How many pieces were joined.
    int run() {
        for (const TracedLine& line : lines_) {
            if (is_dashed(line)) pens_[key_of(line)].add_dashed(line);
        }
        if (pens_.empty()) return 0;
        for (auto& [key, pen] : pens_) pen.settle();
        for (std::size_t i = 0; i < lines_.size(); ++i) {
            if (is_piece(lines_[i])) place(i);
        }
        for (std::size_t i = 0; i < lines_.size(); ++i) {
            if (!is_dashed(lines_[i])) continue;
            lengthen({i, false});
            lengthen({i, true});
        }
        for (const auto& [line, taken] : taken_) shorten(line, taken);
        std::erase_if(lines_, [](const TracedLine& line) { return line.points.size() < 2; });
        return joined_;
    }
    [[nodiscard]] int first_element() const { return first_element_; }

 private:
    using Key = std::tuple<int, int, int, Named, bool>;
    struct Taken {
        bool first = false, last = false;  // the leg at that end
    };

    static Key key_of(const TracedLine& line) {
        return {line.color.r, line.color.g, line.color.b, line.named, line.ruled};
    }
    // The n-th point from an end of a line.
    [[nodiscard]] Vec2 point(End end, std::size_t n) const {
        const std::vector<Vec2>& points = nth(lines_, end.line).points;
        return end.last ? points[points.size() - 1 - n] : points[n];
    }
    // Only what may be a piece by itself takes room among the ends of a place.
    void place(std::size_t line) {
        const auto pen = pens_.find(key_of(nth(lines_, line)));
        if (pen == pens_.end() || !pen->second.is_as_wide(nth(lines_, line).width_mm)) return;
        for (const bool last : {false, true}) {
            const End end{line, last};
            if (pen->second.is_as_long(distance(point(end, 0), point(end, 1))))
                pen->second.place(end, point(end, 0));
        }
    }
    [[nodiscard]] bool is_taken(End piece) const {
        const auto taken = taken_.find(piece.line);
        return taken != taken_.end() && (piece.last ? taken->second.last : taken->second.first);
    }

    // How far behind the end of a dashed line a piece goes on, in its direction; nullopt when it does not.
    [[nodiscard]] std::optional<double> gap_to(End dashed, End piece) const {
        const TracedLine& line = nth(lines_, dashed.line);
        if (is_taken(piece) || !same_pen(line, nth(lines_, piece.line))) return std::nullopt;
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

    void lengthen(End dashed) {
        std::optional<double> nearest;
        End best;
        pens_.at(key_of(nth(lines_, dashed.line))).each_near(point(dashed, 0), [&](End end) {
            const auto gap = gap_to(dashed, end);
            if (!gap || (nearest && *nearest <= *gap)) return;
            nearest = gap;
            best = end;
        });
        if (nearest) take(dashed, best);
    }

    // The dashed line goes on to the end of that leg of the piece. Of a piece between two dashed lines the
    // second ends where the first does now.
    void take(End dashed, End piece) {
        const TracedLine& from = nth(lines_, piece.line);
        const bool between = from.points.size() == 2 && is_taken({piece.line, !piece.last});
        const Vec2 to = point(piece, between ? 0 : 1);
        if (!between && (joined_++ == 0 || from.element < first_element_)) first_element_ = from.element;
        Taken& taken = taken_[piece.line];
        (piece.last ? taken.last : taken.first) = true;
        TracedLine& line = nth(lines_, dashed.line);
        // A longer line may be a curve, whose chords stay as they are.
        if (line.points.size() == 2) {
            (dashed.last ? line.points.back() : line.points.front()) = to;
        } else {
            line.points.insert(dashed.last ? line.points.end() : line.points.begin(), to);
        }
    }

    // What is left of a piece: of a corner the other leg, else a point that is no line.
    void shorten(std::size_t piece, Taken taken) {
        std::vector<Vec2>& points = nth(lines_, piece).points;
        if (taken.first) points.erase(points.begin());
        if (taken.last) points.pop_back();
    }

    std::vector<TracedLine>& lines_;
    std::map<Key, Pen> pens_;
    std::unordered_map<std::size_t, Taken> taken_;  // by the piece
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
