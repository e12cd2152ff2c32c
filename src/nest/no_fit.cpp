#include "nest/no_fit.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/nth.h"

namespace popup {
void make_no_fit(const TurnedShape& a, const TurnedShape& b, double slack, NoFit& result) {
    result.parts.clear();
    result.planes.clear();
    double x0 = HUGE_VAL;
    double y0 = HUGE_VAL;
    double x1 = -HUGE_VAL;
    double y1 = -HUGE_VAL;
    for (const PartEdges& part_b : b.edges) {
        for (const PartEdges& part_a : a.edges) {
            // The edges of the sum of two convex rings are the edges of both, by direction. Before an edge of
            // one the other stands where its own next edge begins.
            const std::vector<PartEdge>& one = part_a.mirrored;
            const std::vector<PartEdge>& other = part_b.plain;
            NoFitPart part{
                HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL, static_cast<std::uint32_t>(result.planes.size()),
                {}};
            for (const std::vector<PartEdge>* edges : {&one, &other}) {
                for (const PartEdge& edge : *edges) ++part.begins.at(index(edge.eighth) + 1);
            }
            std::partial_sum(part.begins.begin(), part.begins.end(), part.begins.begin());
            const std::size_t padded = part.padded();
            result.planes.resize(part.first + 3 * padded);
            double* plane = result.planes.data() + part.first;
            std::size_t i = 0;
            std::size_t j = 0;
            while (i < one.size() || j < other.size()) {
                const bool first =
                    j == other.size() || (i < one.size() && one[i].direction < other[j].direction);
                const PartEdge& of_one = one[i == one.size() ? 0 : i];
                const PartEdge& of_other = other[j == other.size() ? 0 : j];
                const PartEdge& edge = first ? of_one : of_other;
                const double x = of_one.x + of_other.x;
                const double y = of_one.y + of_other.y;
                part.x0 = std::min(part.x0, x);
                part.y0 = std::min(part.y0, y);
                part.x1 = std::max(part.x1, x);
                part.y1 = std::max(part.y1, y);
                const double c = edge.nx * x + edge.ny * y;
                plane[0] = edge.nx;
                plane[padded] = edge.ny;
                plane[2 * padded] = edge.slanted ? c + slack : c;
                ++plane;
                ++(first ? i : j);
            }
            if (padded > part.count()) {
                plane[0] = 0.0;
                plane[padded] = 0.0;
                plane[2 * padded] = HUGE_VAL;
            }
            part.x0 -= slack;
            part.y0 -= slack;
            part.x1 += slack;
            part.y1 += slack;
            x0 = std::min(x0, part.x0);
            y0 = std::min(y0, part.y0);
            x1 = std::max(x1, part.x1);
            y1 = std::max(y1, part.y1);
            result.parts.push_back(part);
        }
    }
    result.x0 = x0;
    result.y0 = y0;
    result.x1 = x1;
    result.y1 = y1;
}

bool covers(const NoFit& fit, const NoFitBox& box, int cuts) {
    constexpr int kMostCuts = 10;
    const auto has = [&](const NoFitPart& part, const NoFitBox& all) {
        const double* nx = fit.planes.data() + part.first;
        const double* ny = nx + part.padded();
        const double* c = ny + part.padded();
        for (std::uint32_t i = 0; i < part.count(); ++i) {
            if (nx[i] * (nx[i] > 0.0 ? all.x1 : all.x0) + ny[i] * (ny[i] > 0.0 ? all.y1 : all.y0) >= c[i])
                return false;
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
