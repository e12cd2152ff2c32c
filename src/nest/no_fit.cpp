#include "nest/no_fit.h"

#include <algorithm>
#include <cmath>

#include "base/nth.h"

namespace popup {
namespace {

// A plane that all points are behind, whichever way a line crosses it.
void add_nothing(double nx, double* plane, std::size_t count) {
    plane[0] = nx;
    plane[count] = nx * HUGE_VAL;
    plane[2 * count] = 0.0;
}

}  // namespace

void make_boxes(const TurnedShape& a, const TurnedShape& b, double slack, NoFit& result) {
    result.parts.clear();
    result.planes.clear();
    result.x0 = HUGE_VAL;
    result.y0 = HUGE_VAL;
    result.x1 = -HUGE_VAL;
    result.y1 = -HUGE_VAL;
    for (const PartEdges& part_b : b.edges) {
        for (const PartEdges& part_a : a.edges) {
            const RingEdges& one = part_a.mirrored;
            const RingEdges& other = part_b.plain;
            NoFitPart part{};
            part.first = NoFitPart::kNotMade;
            // Corners are whole numbers, so that the box of all sums is the sum of the boxes.
            const auto slack_at = [&](int side) {
                return nth(one.counts, side) + nth(other.counts, side) == 0 ? slack : 0.0;
            };
            part.x0 = one.x0 + other.x0 - slack_at(6);
            part.y0 = one.y0 + other.y0 - slack_at(0);
            part.x1 = one.x1 + other.x1 + slack_at(2);
            part.y1 = one.y1 + other.y1 + slack_at(4);
            result.x0 = std::min(result.x0, part.x0);
            result.y0 = std::min(result.y0, part.y0);
            result.x1 = std::max(result.x1, part.x1);
            result.y1 = std::max(result.y1, part.y1);
            result.parts.push_back(part);
        }
    }
}

void make_part(const TurnedShape& a, const TurnedShape& b, double slack, std::size_t number, NoFit& result) {
    // The edges of the sum of two convex rings are the edges of both, by direction. Before an edge of one the
    // other stands where its own next edge begins.
    const RingEdges& ring_a = a.edges[number % a.edges.size()].mirrored;
    const RingEdges& ring_b = b.edges[number / a.edges.size()].plain;
    const std::vector<PartEdge>& one = ring_a.edges;
    const std::vector<PartEdge>& other = ring_b.edges;
    const auto of = [&](int eighth) { return nth(ring_a.counts, eighth) + nth(ring_b.counts, eighth); };
    const auto even = [](std::uint32_t count) { return (count + 1) & ~1U; };
    NoFitPart& part = result.parts[number];
    part.first = static_cast<std::uint32_t>(result.planes.size());
    part.third = of(1);
    part.half = even(of(1) + of(3));
    part.last = part.half + of(5);
    part.count = part.half + even(of(5) + of(7));
    const std::size_t count = part.count;
    result.planes.resize(part.first + 3 * count);
    double* const planes = result.planes.data() + part.first;
    if (of(1) + of(3) < part.half) add_nothing(1.0, planes + part.half - 1, count);
    if (part.last + of(7) < part.count) add_nothing(-1.0, planes + part.count - 1, count);
    std::uint32_t next = 0;
    std::size_t i = 0;
    std::size_t j = 0;
    while (i < one.size() || j < other.size()) {
        const bool first = j == other.size() || (i < one.size() && one[i].direction < other[j].direction);
        const PartEdge& of_one = one[i == one.size() ? 0 : i];
        const PartEdge& of_other = other[j == other.size() ? 0 : j];
        const PartEdge& edge = first ? of_one : of_other;
        if (edge.slanted) {
            const double x = of_one.x + of_other.x;
            const double y = of_one.y + of_other.y;
            if (edge.eighth >= 5) next = std::max(next, part.half);
            double* const plane = planes + next;
            plane[0] = edge.nx;
            plane[count] = (edge.nx * x + edge.ny * y + slack) / edge.nx;
            plane[2 * count] = edge.ny / edge.nx;
            ++next;
        }
        ++(first ? i : j);
    }
}

void make_no_fit(const TurnedShape& a, const TurnedShape& b, double slack, NoFit& result) {
    make_boxes(a, b, slack, result);
    for (std::size_t part = 0; part < result.parts.size(); ++part) make_part(a, b, slack, part, result);
}

bool covers(const NoFit& fit, const NoFitBox& box, int cuts) {
    constexpr int kMostCuts = 10;
    const auto has = [&](const NoFitPart& part, const NoFitBox& all) {
        if (all.x0 <= part.x0 || all.x1 >= part.x1 || all.y0 <= part.y0 || all.y1 >= part.y1) return false;
        const double* nx = fit.planes.data() + part.first;
        const double* at_zero = nx + part.count;
        const double* slope = at_zero + part.count;
        for (std::uint32_t i = 0; i < part.count; ++i) {
            // The corner that is furthest out.
            const double x = nx[i] > 0.0 ? all.x1 : all.x0;
            const double y = nx[i] * slope[i] > 0.0 ? all.y1 : all.y0;
            if (nx[i] * (at_zero[i] - slope[i] * y - x) <= 0.0) return false;
        }
        return true;
    };
    const auto covered = [&](const NoFitBox& all) {
        return std::any_of(fit.parts.begin(), fit.parts.end(),
                           [&](const NoFitPart& part) { return has(part, all); });
    };
    if (covered(box)) return true;
    const double x = 0.5 * (box.x0 + box.x1);
    const double y = 0.5 * (box.y0 + box.y1);
    if (cuts == kMostCuts || !covered({x, y, x, y})) return false;
    const bool wide = box.x1 - box.x0 > box.y1 - box.y0;
    const NoFitBox low{box.x0, box.y0, wide ? x : box.x1, wide ? box.y1 : y};
    const NoFitBox high{wide ? x : box.x0, wide ? box.y0 : y, box.x1, box.y1};
    return covers(fit, low, cuts + 1) && covers(fit, high, cuts + 1);
}

namespace {

// What the no-fit polygons of all pairs take: a part for each pair of parts, with the edges of both.
double bytes_of_all(const std::vector<TurnedShape>& shapes) {
    double parts = 0.0;
    double edges = 0.0;
    for (const TurnedShape& shape : shapes) {
        parts += static_cast<double>(shape.parts.size());
        for (const GridRing& part : shape.parts) edges += static_cast<double>(part.size());
    }
    const auto pairs = static_cast<double>(shapes.size()) * static_cast<double>(shapes.size());
    return pairs * static_cast<double>(sizeof(NoFit) + sizeof(void*)) +
           parts * parts * static_cast<double>(sizeof(NoFitPart)) +
           2.0 * parts * edges * 3.0 * static_cast<double>(sizeof(double));
}

}  // namespace

NoFitTable::NoFitTable(const std::vector<TurnedShape>& shapes, double slack)
    : shapes_(shapes),
      slack_(slack),
      table_(bytes_of_all(shapes) <= kMostBytes ? shapes.size() * shapes.size() : 0) {}

NoFitTable::~NoFitTable() {
    for (const auto& entry : table_) delete entry.load();
}

void NoFitTable::make(int a, int b, NoFit& result) const {
    make_no_fit(nth(shapes_, a), nth(shapes_, b), slack_, result);
}

void NoFitTable::make_boxes(int a, int b, NoFit& result) const {
    popup::make_boxes(nth(shapes_, a), nth(shapes_, b), slack_, result);
}

void NoFitTable::make_part(int a, int b, std::size_t part, NoFit& result) const {
    popup::make_part(nth(shapes_, a), nth(shapes_, b), slack_, part, result);
}

const NoFit& NoFitTable::keep(int a, int b) {
    NoFit fit;
    make(a, b, fit);
    auto made = std::make_unique<const NoFit>(std::move(fit));
    const NoFit* expected = nullptr;
    // Another thread may have been faster; both made the same.
    if (table_[index(a, b)].compare_exchange_strong(expected, made.get(), std::memory_order_acq_rel)) {
        return *made.release();
    }
    return *expected;
}

}  // namespace popup
