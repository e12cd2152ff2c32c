#include "nest/exact.h"

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <tuple>

#include "base/nth.h"

namespace popup {
namespace {

using Huge = boost::multiprecision::int512_t;

Huge huge(Wide value) {
    const bool negative = value < 0;
    const auto magnitude = static_cast<UnsignedWide>(negative ? -value : value);
    Huge result = static_cast<std::uint64_t>(magnitude >> 64);
    result <<= 64;
    result += static_cast<std::uint64_t>(magnitude);
    return negative ? Huge(-result) : result;
}

// Whether an edge of a has all of b on its right, or on it.
bool edge_divides(const GridRing& a, GridPoint at_a, const GridRing& b, GridPoint at_b) {
    const GridPoint shift = at_b - at_a;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const GridPoint from = a[i];
        const GridPoint along = a[(i + 1) % a.size()] - from;
        if (std::all_of(b.begin(), b.end(),
                        [&](GridPoint p) { return cross(along, p + shift - from) <= 0; })) {
            return true;
        }
    }
    return false;
}

// Whether p is at least `least` away from the segment. Decided in doubles where they suffice.
bool is_far(GridPoint p, GridPoint a, GridPoint b, GridLength least) {
    const GridPoint along = b - a;
    const GridPoint to = p - a;
    const Wide reach = static_cast<Wide>(along.x) * along.x + static_cast<Wide>(along.y) * along.y;
    const Wide inner = static_cast<Wide>(to.x) * along.x + static_cast<Wide>(to.y) * along.y;
    const Wide wanted = static_cast<Wide>(least) * least;
    if (inner <= 0) return static_cast<Wide>(to.x) * to.x + static_cast<Wide>(to.y) * to.y >= wanted;
    if (inner >= reach) {
        const GridPoint end = p - b;
        return static_cast<Wide>(end.x) * end.x + static_cast<Wide>(end.y) * end.y >= wanted;
    }
    const Wide area = cross(along, to);
    const double away = std::abs(static_cast<double>(area)) / std::sqrt(static_cast<double>(reach));
    if (std::abs(away - static_cast<double>(least)) > 1.0 + 1e-9 * away) {
        return away > static_cast<double>(least);
    }
    return huge(area) * huge(area) >= huge(wanted) * huge(reach);
}

bool corners_far(const GridRing& a, GridPoint at_a, const GridRing& b, GridPoint at_b, GridLength least) {
    const GridPoint shift = at_a - at_b;
    for (const GridPoint p : a) {
        for (std::size_t i = 0; i < b.size(); ++i) {
            if (!is_far(p + shift, b[i], b[(i + 1) % b.size()], least)) return false;
        }
    }
    return true;
}

}  // namespace

ExactShapes::ExactShapes(const std::vector<TurnedShape>& shapes) {
    shapes_.reserve(shapes.size());
    for (const TurnedShape& shape : shapes) {
        Exact exact;
        for (const GridRing& ring : shape.exact) {
            GridBox box;
            for (const GridPoint p : ring) box.extend(p);
            exact.box.extend({box.x0, box.y0});
            exact.box.extend({box.x1, box.y1});
            exact.parts.push_back({ring, box});
        }
        shapes_.push_back(std::move(exact));
    }
}

bool ExactShapes::apart(int a, GridPoint at_a, int b, GridPoint at_b, GridLength spacing) const {
    const auto clear = [&](const GridBox& one, const GridBox& other) {
        return one.x1 + at_a.x + spacing <= other.x0 + at_b.x ||
               other.x1 + at_b.x + spacing <= one.x0 + at_a.x ||
               one.y1 + at_a.y + spacing <= other.y0 + at_b.y ||
               other.y1 + at_b.y + spacing <= one.y0 + at_a.y;
    };
    const Exact& one = nth(shapes_, a);
    const Exact& other = nth(shapes_, b);
    if (clear(one.box, other.box)) return true;
    for (const Part& p : one.parts) {
        for (const Part& q : other.parts) {
            if (clear(p.box, q.box)) continue;
            if (!edge_divides(p.ring, at_a, q.ring, at_b) && !edge_divides(q.ring, at_b, p.ring, at_a))
                return false;
            if (spacing > 0 && !(corners_far(p.ring, at_a, q.ring, at_b, spacing) &&
                                 corners_far(q.ring, at_b, p.ring, at_a, spacing))) {
                return false;
            }
        }
    }
    return true;
}

std::optional<std::pair<int, int>> ExactShapes::first_conflict(const std::vector<ExactPlace>& places,
                                                               GridLength spacing) const {
    struct Extent {
        GridLength x0, x1, y0, y1;
        int sheet, item;
    };
    std::vector<Extent> extents;
    extents.reserve(places.size());
    for (std::size_t i = 0; i < places.size(); ++i) {
        const ExactPlace& place = places[i];
        const GridBox& box = bounds(place.shape);
        extents.push_back({box.x0 + place.at.x, box.x1 + place.at.x, box.y0 + place.at.y, box.y1 + place.at.y,
                           place.sheet, static_cast<int>(i)});
    }
    std::sort(extents.begin(), extents.end(), [](const Extent& a, const Extent& b) {
        return std::tie(a.sheet, a.x0, a.item) < std::tie(b.sheet, b.x0, b.item);
    });
    std::optional<std::pair<int, int>> first;
    for (std::size_t i = 0; i < extents.size(); ++i) {
        const Extent& e = extents[i];
        for (std::size_t k = i + 1; k < extents.size(); ++k) {
            const Extent& f = extents[k];
            if (f.sheet != e.sheet || f.x0 >= e.x1 + spacing) break;
            if (f.y0 >= e.y1 + spacing || e.y0 >= f.y1 + spacing) continue;
            const ExactPlace& a = nth(places, e.item);
            const ExactPlace& b = nth(places, f.item);
            if (apart(a.shape, a.at, b.shape, b.at, spacing)) continue;
            const std::pair<int, int> found = std::minmax(e.item, f.item);
            if (!first || found < *first) first = found;
        }
    }
    return first;
}

}  // namespace popup
