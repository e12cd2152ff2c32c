#include "support/nest_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "support/nest_exact.h"

namespace popup::test {
namespace {

constexpr double kStepsPerMm = 1e6;
// What a double may be off a number of the grid that it stands for, in steps.
constexpr double kOffGrid = 1e-3;

std::int64_t steps(double mm) { return std::llround(mm * kStepsPerMm); }
double mm(std::int64_t steps) { return static_cast<double>(steps) / kStepsPerMm; }
bool stands_on_grid(double length) {
    return std::abs(length * kStepsPerMm - std::round(length * kStepsPerMm)) <= kOffGrid;
}

Vec2 turned_point(Vec2 p, double deg) {
    double turn = std::fmod(deg, 360.0);
    if (turn < 0.0) turn += 360.0;
    if (turn == 0.0) return p;
    if (turn == 90.0) return {-p.y, p.x};
    if (turn == 180.0) return {-p.x, -p.y};
    if (turn == 270.0) return {p.y, -p.x};
    const double c = std::cos(Angle::degrees(deg).rad());
    const double s = std::sin(Angle::degrees(deg).rad());
    return {c * p.x - s * p.y, s * p.x + c * p.y};
}

struct StepBox {
    std::int64_t x0 = INT64_MAX, y0 = INT64_MAX, x1 = INT64_MIN, y1 = INT64_MIN;
    void extend(GridSpot p) {
        x0 = std::min(x0, p.x);
        y0 = std::min(y0, p.y);
        x1 = std::max(x1, p.x);
        y1 = std::max(y1, p.y);
    }
    [[nodiscard]] bool within(const StepBox& other, std::int64_t reach) const {
        return x0 - reach <= other.x1 && other.x0 - reach <= x1 && y0 - reach <= other.y1 &&
               other.y0 - reach <= y1;
    }
};

struct Placed {
    int item = 0;
    PlacedPiece rings;
    StepBox box;
};

std::vector<GridSpot> placed_ring(const Ring& ring, const NestSpot& spot, bool counter_clockwise) {
    std::vector<GridSpot> result;
    for (const Vec2 p : ring) {
        const Vec2 q = turned_point(p, spot.angle.deg);
        result.push_back({steps(q.x) + steps(spot.offset.x), steps(q.y) + steps(spot.offset.y)});
    }
    if ((signed_area(ring) > 0.0) != counter_clockwise) std::reverse(result.begin(), result.end());
    return result;
}

Placed placed(const NestJob& job, int item, const NestSpot& spot) {
    Placed result;
    result.item = item;
    const auto kind = static_cast<std::size_t>(job.items[static_cast<std::size_t>(item)].kind);
    for (const Polygon& polygon : job.kinds[kind].outline) {
        result.rings.push_back(placed_ring(polygon.outer, spot, true));
        if (!job.use_holes) continue;
        for (const Ring& hole : polygon.holes) result.rings.push_back(placed_ring(hole, spot, false));
    }
    for (const auto& ring : result.rings) {
        for (const GridSpot p : ring) result.box.extend(p);
    }
    return result;
}

struct Edge {
    GridSpot from, to;
    [[nodiscard]] StepBox box() const {
        StepBox result;
        result.extend(from);
        result.extend(to);
        return result;
    }
};

// Edges of the piece that come near the box.
std::vector<Edge> edges_near(const Placed& piece, const StepBox& box, std::int64_t reach) {
    std::vector<Edge> result;
    for (const auto& ring : piece.rings) {
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const Edge edge{ring[i], ring[(i + 1) % ring.size()]};
            if (edge.box().within(box, reach)) result.push_back(edge);
        }
    }
    return result;
}

// In steps, to about a thousandth of one: for words, and to leave out what is far away.
double rough_distance(GridSpot p, const Edge& edge) {
    const auto from_p = [p](GridSpot q) {
        return Vec2{static_cast<double>(q.x - p.x), static_cast<double>(q.y - p.y)};
    };
    return distance(Vec2{}, Segment{from_p(edge.from), from_p(edge.to)});
}

// The distance in mm of two pieces, no inner point of which is common, when it is less than the spacing.
std::optional<double> too_close(const Placed& a, const Placed& b, std::int64_t spacing) {
    const std::vector<Edge> of_a = edges_near(a, b.box, spacing);
    const std::vector<Edge> of_b = edges_near(b, a.box, spacing);
    std::optional<double> closest;
    const auto look = [&](GridSpot p, const Edge& edge) {
        const double rough = rough_distance(p, edge);
        if (rough > static_cast<double>(spacing) + 1.0 || (closest && rough >= *closest)) return;
        if (closer_than(p, edge.from, edge.to, spacing)) closest = rough;
    };
    for (const Edge& one : of_a) {
        const StepBox box = one.box();
        for (const Edge& other : of_b) {
            if (!box.within(other.box(), spacing)) continue;
            for (const GridSpot p : {one.from, one.to}) look(p, other);
            for (const GridSpot p : {other.from, other.to}) look(p, one);
        }
    }
    return closest ? std::optional(*closest / kStepsPerMm) : std::nullopt;
}

class Check {
 public:
    Check(const NestJob& job, const NestPlan& plan) : job_(job), plan_(plan) {}

    std::vector<std::string> run() {
        if (!counts_fit()) return faults_;
        rows();
        turns();
        groups();
        locks();
        for (std::size_t sheet = 0; sheet < plan_.sheets.size(); ++sheet) look_at(static_cast<int>(sheet));
        return faults_;
    }

 private:
    template <class... Values>
    void fault(fmt::format_string<Values...> words, Values&&... values) {
        faults_.push_back(fmt::format(words, std::forward<Values>(values)...));
    }

    // Without these nothing else can be looked at.
    bool counts_fit() {
        if (plan_.spots.size() != job_.items.size()) {
            fault("{} items have {} places", job_.items.size(), plan_.spots.size());
        }
        if (plan_.used.size() != plan_.sheets.size()) {
            fault("{} sheets, but {} used sizes", plan_.sheets.size(), plan_.used.size());
        }
        for (std::size_t i = 0; i < plan_.spots.size(); ++i) {
            const int sheet = plan_.spots[i].sheet;
            if (sheet < 0 || static_cast<std::size_t>(sheet) >= plan_.sheets.size()) {
                fault("item {} is on sheet {} of {}", i, sheet, plan_.sheets.size());
            }
        }
        for (std::size_t i = 0; i < plan_.sheets.size(); ++i) {
            const int row = plan_.sheets[i];
            if (row < 0 || static_cast<std::size_t>(row) >= job_.stock.size()) {
                fault("sheet {} is from row {} of {}", i, row, job_.stock.size());
            }
        }
        return faults_.empty();
    }

    void rows() {
        for (std::size_t row = 0; row < job_.stock.size(); ++row) {
            const auto taken = std::count(plan_.sheets.begin(), plan_.sheets.end(), static_cast<int>(row));
            const int there = job_.stock[row].count;
            if (there >= 0 && taken > there) fault("{} sheets of row {}, which has {}", taken, row, there);
        }
    }

    void turns() {
        std::map<int, std::size_t> first;  // item of a kind that has one turn
        for (std::size_t i = 0; i < job_.items.size(); ++i) {
            const NestItem& item = job_.items[i];
            const NestKind& kind = job_.kinds[static_cast<std::size_t>(item.kind)];
            const Angle angle = plan_.spots[i].angle;
            if (!item.locked && std::find(kind.turns.begin(), kind.turns.end(), angle) == kind.turns.end()) {
                fault("item {} is turned by {}°, which its kind does not allow", i, angle.deg);
            }
            if (!kind.one_turn) continue;
            const auto [it, fresh] = first.try_emplace(item.kind, i);
            const Angle other = plan_.spots[it->second].angle;
            if (!(other == angle)) {
                fault("items {} and {} of one kind are turned by {}° and {}°", it->second, i, other.deg,
                      angle.deg);
            }
        }
    }

    void groups() {
        std::map<int, std::size_t> first;
        for (std::size_t i = 0; i < job_.items.size(); ++i) {
            const int group = job_.items[i].group;
            if (group < 0) continue;
            const auto [it, fresh] = first.try_emplace(group, i);
            const int other = plan_.spots[it->second].sheet;
            if (other != plan_.spots[i].sheet) {
                fault("items {} and {} of group {} are on sheets {} and {}", it->second, i, group, other,
                      plan_.spots[i].sheet);
            }
        }
    }

    void locks() {
        for (std::size_t i = 0; i < job_.items.size(); ++i) {
            const auto& lock = job_.items[i].locked;
            if (!lock) continue;
            const NestSpot& spot = plan_.spots[i];
            if (spot.sheet != lock->sheet || steps(spot.offset.x) != steps(lock->offset.x) ||
                steps(spot.offset.y) != steps(lock->offset.y) || !(spot.angle == lock->angle)) {
                fault("item {} is locked on sheet {} at ({}, {}), {}°, but lies on sheet {} at ({}, {}), {}°",
                      i, lock->sheet, lock->offset.x, lock->offset.y, lock->angle.deg, spot.sheet,
                      spot.offset.x, spot.offset.y, spot.angle.deg);
            }
        }
    }

    void look_at(int sheet) {
        std::vector<Placed> pieces;
        StepBox all;
        for (std::size_t i = 0; i < plan_.spots.size(); ++i) {
            const NestSpot& spot = plan_.spots[i];
            if (spot.sheet != sheet) continue;
            if (!stands_on_grid(spot.offset.x) || !stands_on_grid(spot.offset.y)) {
                fault("item {} is at ({:.9f}, {:.9f}), off the grid", i, spot.offset.x, spot.offset.y);
            }
            pieces.push_back(placed(job_, static_cast<int>(i), spot));
            all.extend({pieces.back().box.x0, pieces.back().box.y0});
            all.extend({pieces.back().box.x1, pieces.back().box.y1});
        }
        const auto at = static_cast<std::size_t>(sheet);
        if (pieces.empty()) {
            if (at + 1 == plan_.sheets.size()) fault("sheet {}, the last one, is empty", sheet);
            return;
        }
        inside(pieces, job_.stock[static_cast<std::size_t>(plan_.sheets[at])], sheet);
        const Vec2 used = plan_.used[at];
        if (steps(used.x) != all.x1 || steps(used.y) != all.y1) {
            fault("sheet {} is used to ({:.6f}, {:.6f}), not to ({:.6f}, {:.6f})", sheet, mm(all.x1),
                  mm(all.y1), used.x, used.y);
        }
        if (nest_check_available()) apart(pieces, sheet);
    }

    void inside(const std::vector<Placed>& pieces, const NestStock& stock, int sheet) {
        for (const Placed& piece : pieces) {
            const std::int64_t out =
                std::max({-piece.box.x0, -piece.box.y0, piece.box.x1 - steps(stock.width),
                          piece.box.y1 - steps(stock.height)});
            if (out > 0) fault("item {} stands {:.6f} mm out of sheet {}", piece.item, mm(out), sheet);
        }
    }

    void apart(const std::vector<Placed>& pieces, int sheet) {
        std::vector<PlacedPiece> rings;
        rings.reserve(pieces.size());
        for (const Placed& piece : pieces) rings.push_back(piece.rings);
        std::map<std::pair<int, int>, bool> overlap;
        for (const PieceOverlap& one : piece_overlaps(rings)) {
            overlap[{one.a, one.b}] = true;
            fault(
                "items {} and {} on sheet {} overlap by {:.3g} mm², in ({:.6f}, {:.6f}) to ({:.6f}, {:.6f})",
                pieces[static_cast<std::size_t>(one.a)].item, pieces[static_cast<std::size_t>(one.b)].item,
                sheet, one.area / (kStepsPerMm * kStepsPerMm), one.x0 / kStepsPerMm, one.y0 / kStepsPerMm,
                one.x1 / kStepsPerMm, one.y1 / kStepsPerMm);
        }
        const std::int64_t spacing = steps(job_.spacing);
        if (spacing <= 0) return;
        std::vector<int> by_left(pieces.size());
        for (std::size_t i = 0; i < by_left.size(); ++i) by_left[i] = static_cast<int>(i);
        const auto piece = [&](int i) -> const Placed& { return pieces[static_cast<std::size_t>(i)]; };
        std::stable_sort(by_left.begin(), by_left.end(),
                         [&](int a, int b) { return piece(a).box.x0 < piece(b).box.x0; });
        for (std::size_t i = 0; i < by_left.size(); ++i) {
            for (std::size_t k = i + 1; k < by_left.size(); ++k) {
                const auto [a, b] = std::minmax(by_left[i], by_left[k]);
                if (piece(by_left[k]).box.x0 - spacing > piece(by_left[i]).box.x1) break;
                if (!piece(a).box.within(piece(b).box, spacing) || overlap.contains({a, b})) continue;
                if (const auto gap = too_close(piece(a), piece(b), spacing)) {
                    fault("items {} and {} on sheet {} are {:.6f} mm apart, {:.3g} mm less than {:.6f} mm",
                          piece(a).item, piece(b).item, sheet, *gap, mm(spacing) - *gap, mm(spacing));
                }
            }
        }
    }

    const NestJob& job_;
    const NestPlan& plan_;
    std::vector<std::string> faults_;
};

}  // namespace

#ifdef POPUP_HAVE_CGAL
bool nest_check_available() { return true; }
#else
bool nest_check_available() { return false; }
std::vector<PieceOverlap> piece_overlaps(const std::vector<PlacedPiece>&) { return {}; }
bool closer_than(GridSpot, GridSpot, GridSpot, std::int64_t) { return false; }
#endif

std::vector<std::string> nest_faults(const NestJob& job, const NestPlan& plan) {
    return Check(job, plan).run();
}

}  // namespace popup::test
