// Whether the plates of one sheet share its paper out: by Boost.Geometry and rational numbers, neither of
// which popupc cuts with.
#pragma once

// Boost's own buffers, in which GCC 12 sees what is not set.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#include <boost/geometry.hpp>
#include <boost/geometry/geometries/multi_polygon.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>
#include <boost/multiprecision/cpp_int.hpp>
#pragma GCC diagnostic pop
#include <cmath>
#include <vector>

#include "popup/assembly.h"

namespace popup::test {

namespace bg = boost::geometry;
using BoostXy = bg::model::d2::point_xy<double>;
using BoostPolygon = bg::model::polygon<BoostXy, false, false>;  // counter-clockwise, open
using BoostPolygons = bg::model::multi_polygon<BoostPolygon>;

inline BoostPolygon boost_polygon(const Polygon& polygon) {
    BoostPolygon made;
    for (const Vec2 p : polygon.outer) bg::append(made.outer(), BoostXy(p.x, p.y));
    for (const Ring& hole : polygon.holes) {
        auto& inner = made.inners().emplace_back();
        for (const Vec2 p : hole) bg::append(inner, BoostXy(p.x, p.y));
    }
    bg::correct(made);
    return made;
}

// Exactly, of the coordinates as they are.
inline double exact_area(const std::vector<Polygon>& polygons) {
    using Rational = boost::multiprecision::cpp_rational;
    Rational sum = 0;
    const auto add = [&sum](const Ring& ring) {
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const Vec2 a = ring[i];
            const Vec2 b = ring[i + 1 == ring.size() ? 0 : i + 1];
            sum += Rational(a.x) * Rational(b.y) - Rational(a.y) * Rational(b.x);
        }
    };
    for (const Polygon& polygon : polygons) {
        add(polygon.outer);
        for (const Ring& hole : polygon.holes) add(hole);
    }
    return 0.5 * static_cast<double>(sum);
}

struct Balance {
    double plates = 0.0;   // the sum of the areas of all plates of the piece, exactly
    double overlap = 0.0;  // the most that two of them have in common
};
inline Balance balance_of(const Assembly& assembly, int piece) {
    std::vector<Polygon> plates;
    for (const Plate& plate : assembly.plates) {
        if (plate.piece == piece) plates.push_back(plate.outline);
    }
    Balance made{exact_area(plates), 0.0};
    for (std::size_t i = 0; i < plates.size(); ++i) {
        for (std::size_t k = i + 1; k < plates.size(); ++k) {
            BoostPolygons common;
            bg::intersection(boost_polygon(plates[i]), boost_polygon(plates[k]), common);
            made.overlap = std::max(made.overlap, std::abs(bg::area(common)));
        }
    }
    return made;
}

}  // namespace popup::test
