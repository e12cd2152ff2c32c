#include "fabrication/tour.h"

#include <algorithm>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <iterator>
#include <utility>

#include "base/geometry/tolerances.h"

namespace popup {
namespace {

namespace bgi = boost::geometry::index;
using Point = boost::geometry::model::point<double, 2, boost::geometry::cs::cartesian>;
// A place where a stop may be begun: the stop and the corner.
using Door = std::pair<Point, std::pair<std::size_t, std::size_t>>;
using Doors = bgi::rtree<Door, bgi::quadratic<16>>;

// Of a closed contour so many corners are looked at; the others would save next to nothing.
constexpr std::size_t kMostDoors = 64;
// Neighbours looked at for an exchange, and the longest part of a tour that one turns round.
constexpr std::size_t kNeighbours = 8;
constexpr std::size_t kLongestTurn = 1000;

Vec2 begin_of(const Stop& stop, const Visit& visit) {
    if (stop.closed) return stop.corners[visit.corner];
    return visit.reversed ? stop.corners.back() : stop.corners.front();
}

Vec2 end_of(const Stop& stop, const Visit& visit) {
    if (stop.closed) return stop.corners[visit.corner];
    return visit.reversed ? stop.corners.front() : stop.corners.back();
}

std::vector<std::size_t> door_corners(const Stop& stop) {
    const std::size_t n = stop.corners.size();
    if (!stop.closed) return {0, n - 1};
    const std::size_t step = (n + kMostDoors - 1) / kMostDoors;
    std::vector<std::size_t> corners;
    for (std::size_t i = 0; i < n; i += step) corners.push_back(i);
    return corners;
}

Door door(const Stop& stop, std::size_t number, std::size_t corner) {
    return {Point(stop.corners[corner].x, stop.corners[corner].y), {number, corner}};
}

std::vector<Visit> by_nearest(std::span<const Stop> stops, Vec2 from) {
    std::vector<Door> all;
    for (std::size_t i = 0; i < stops.size(); ++i) {
        for (const std::size_t corner : door_corners(stops[i])) all.push_back(door(stops[i], i, corner));
    }
    Doors doors(all);
    std::vector<Visit> visits;
    visits.reserve(stops.size());
    for (Vec2 at = from; !doors.empty();) {
        // Of equally near ones the first by number, whatever the tree's order.
        std::vector<Door> found;
        doors.query(bgi::nearest(Point(at.x, at.y), 4), std::back_inserter(found));
        const auto key = [at](const Door& one) {
            return std::pair(distance(at, Vec2{one.first.get<0>(), one.first.get<1>()}), one.second);
        };
        const Door next = *std::min_element(found.begin(), found.end(),
                                            [&key](const Door& a, const Door& b) { return key(a) < key(b); });
        const auto [number, corner] = next.second;
        const Stop& stop = stops[number];
        visits.push_back({number, !stop.closed && corner != 0, stop.closed ? corner : 0});
        for (const std::size_t other : door_corners(stop)) doors.remove(door(stop, number, other));
        at = end_of(stop, visits.back());
    }
    return visits;
}

class Shortening {
 public:
    Shortening(std::span<const Stop> stops, std::vector<Visit>& visits, Vec2 from)
        : stops_(stops), visits_(visits), from_(from), place_(visits.size()) {
        std::vector<Door> ends;
        for (std::size_t i = 0; i < visits.size(); ++i) {
            place_[visits[i].stop] = i;
            const Stop& stop = stops[visits[i].stop];
            for (const Vec2 p : {begin_of(stop, visits[i]), end_of(stop, visits[i])})
                ends.push_back({Point(p.x, p.y), {visits[i].stop, 0}});
        }
        ends_ = Doors(ends);
    }

    // Until a whole round finds nothing, or has gone on for very long.
    void run() {
        constexpr int kMostRounds = 50;
        for (int round = 0; round < kMostRounds; ++round) {
            bool better = false;
            for (std::size_t i = 0; i < visits_.size(); ++i) better = improve(i) || better;
            if (!better) return;
        }
    }

 private:
    [[nodiscard]] Vec2 begin(std::size_t i) const { return begin_of(stops_[visits_[i].stop], visits_[i]); }
    // Of the visit before i; before the first lies where all begins.
    [[nodiscard]] Vec2 end_before(std::size_t i) const {
        return i == 0 ? from_ : end_of(stops_[visits_[i - 1].stop], visits_[i - 1]);
    }
    // The way saved when visits [i, j] are turned round.
    [[nodiscard]] double gain(std::size_t i, std::size_t j) const {
        const Vec2 before = end_before(i);
        const Vec2 last = end_before(j + 1);
        double saved = distance(before, begin(i)) - distance(before, last);
        if (j + 1 < visits_.size()) saved += distance(last, begin(j + 1)) - distance(begin(i), begin(j + 1));
        return saved;
    }
    void turn_round(std::size_t i, std::size_t j) {
        const auto at = [this](std::size_t k) { return visits_.begin() + static_cast<std::ptrdiff_t>(k); };
        std::reverse(at(i), at(j + 1));
        for (std::size_t k = i; k <= j; ++k) {
            if (!stops_[visits_[k].stop].closed) visits_[k].reversed = !visits_[k].reversed;
            place_[visits_[k].stop] = k;
        }
    }
    bool turn_if_better(std::size_t i, std::size_t j) {
        if (i > j) std::swap(i, j);
        if (j - i >= kLongestTurn || gain(i, j) <= kGainMm) return false;
        turn_round(i, j);
        return true;
    }
    // Looks for a better way to the i-th visit: something near its predecessor's end, or near its own begin.
    bool improve(std::size_t i) {
        bool better = false;
        near_.clear();
        const Vec2 before = end_before(i);
        ends_.query(bgi::nearest(Point(before.x, before.y), kNeighbours), std::back_inserter(near_));
        const Vec2 here = begin(i);
        ends_.query(bgi::nearest(Point(here.x, here.y), kNeighbours), std::back_inserter(near_));
        std::sort(near_.begin(), near_.end(),
                  [](const Door& a, const Door& b) { return a.second < b.second; });
        for (const Door& one : near_) {
            const std::size_t j = place_[one.second.first];
            // i and j as ends of what is turned, each counted in or out.
            better = turn_if_better(i, j) || better;
            if (j > 0) better = turn_if_better(i, j - 1) || better;
        }
        return better;
    }

    std::span<const Stop> stops_;
    std::vector<Visit>& visits_;
    Vec2 from_;
    std::vector<std::size_t> place_;  // of each stop among the visits
    Doors ends_;
    std::vector<Door> near_;
};

// Each closed contour begins where the way in and the way on are shortest together.
void choose_corners(std::span<const Stop> stops, std::vector<Visit>& visits, Vec2 from) {
    Vec2 before = from;
    for (std::size_t i = 0; i < visits.size(); ++i) {
        const Stop& stop = stops[visits[i].stop];
        if (stop.closed) {
            const auto way = [&](std::size_t corner) {
                const Vec2 p = stop.corners[corner];
                double sum = distance(before, p);
                if (i + 1 < visits.size())
                    sum += distance(p, begin_of(stops[visits[i + 1].stop], visits[i + 1]));
                return sum;
            };
            double least = way(visits[i].corner) - kGainMm;
            for (std::size_t corner = 0; corner < stop.corners.size(); ++corner) {
                if (way(corner) >= least) continue;
                least = way(corner);
                visits[i].corner = corner;
            }
        }
        before = end_of(stop, visits[i]);
    }
}

}  // namespace

std::vector<Visit> tour(std::span<const Stop> stops, Vec2 from) {
    std::vector<Visit> visits = by_nearest(stops, from);
    if (visits.size() > 1) Shortening(stops, visits, from).run();
    choose_corners(stops, visits, from);
    return visits;
}

double way_between(std::span<const Stop> stops, std::span<const Visit> visits, Vec2 from) {
    double sum = 0.0;
    Vec2 at = from;
    for (const Visit& visit : visits) {
        sum += distance(at, begin_of(stops[visit.stop], visit));
        at = end_of(stops[visit.stop], visit);
    }
    return sum;
}

}  // namespace popup
