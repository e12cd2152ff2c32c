#include "gluing/in_the_way.h"

#include <algorithm>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <cmath>
#include <iterator>
#include <utility>

#include "base/geometry/hull.h"
#include "base/nth.h"

namespace popup {

namespace bg = boost::geometry;
namespace bgi = boost::geometry::index;

namespace {

constexpr double kArmsLengthMm = 150.0;
constexpr double kOffMm = 0.05;  // what is nearer lies on it

using Point = bg::model::point<double, 3, bg::cs::cartesian>;
using SpaceBox = bg::model::box<Point>;

SpaceBox box_round(const std::vector<Vec3>& points) {
    Vec3 low = points.front();
    Vec3 high = low;
    for (const Vec3 p : points) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    return {Point(low.x, low.y, low.z), Point(high.x, high.y, high.z)};
}

}  // namespace

struct InTheWay::Boxes {
    bgi::rtree<std::pair<SpaceBox, int>, bgi::quadratic<16>> tree;
};

InTheWay::InTheWay(const Assembly& assembly, const std::vector<Bond>& bonds, const GluingOrder& order,
                   const GluePoses& poses)
    : in_(assembly), bonds_(bonds), order_(order), poses_(poses), boxes_(std::make_unique<Boxes>()) {
    for (const Bond& bond : bonds)
        glued_to_.insert({nth(in_.plates, bond.plate).piece, bond.mate, bond.on_back});
    if (poses.empty()) return;
    std::vector<std::pair<SpaceBox, int>> boxes;
    for (std::size_t i = 0; i < assembly.plates.size(); ++i) {
        std::vector<Vec3> corners;
        for (const Vec2 p : assembly.plates[i].outline.outer) corners.push_back(poses.reach[i].point(p));
        if (!corners.empty()) boxes.emplace_back(box_round(corners), static_cast<int>(i));
    }
    boxes_->tree = decltype(boxes_->tree)(boxes);
}

InTheWay::~InTheWay() = default;

// The piece on this ground that is the piece, or bears it; -1: none.
int InTheWay::member(int piece, int ground) const {
    while (piece >= 0 && nth(order_.bearers, piece) != ground) piece = nth(order_.bearers, piece);
    return piece;
}

std::set<int> InTheWay::above(const Bond& bond, int ground) const {
    if (poses_.empty() || bond.theirs) return {};
    const int own = member(nth(in_.plates, bond.plate).piece, ground);
    const int mates = member(nth(in_.plates, bond.mate).piece, ground);
    const Vec3 up = (bond.on_back ? -1.0 : 1.0) * nth(poses_.reach, bond.mate).normal();
    const std::vector<Vec3> places = target_points(in_, bond, poses_.reach);
    std::map<int, std::size_t> hidden;  // how many of the places, by what stands before them
    for (const Vec3 p : places) {
        std::set<int> here;
        const std::vector<Vec3> ends{p - kOffMm * up, p + kArmsLengthMm * up};
        std::vector<std::pair<SpaceBox, int>> found;
        boxes_->tree.query(bgi::intersects(box_round(ends)), std::back_inserter(found));
        for (const auto& [box, number] : found) {
            const Plate& plate = nth(in_.plates, number);
            const int of = member(plate.piece, ground);
            if (of < 0 || of == own || of == mates || here.contains(of)) continue;
            if (ground != order_.card && !glued_to_.contains({of, bond.mate, bond.on_back})) continue;
            const Frame& frame = nth(poses_.reach, number);
            const double slope = dot(up, frame.normal());
            if (std::abs(slope) < 1e-9) continue;
            const double away = dot(frame.origin - p, frame.normal()) / slope;
            if (away < -kOffMm || away > kArmsLengthMm) continue;
            const Lying side = bond.on_back ? Lying::on_back : Lying::on_front;
            if (away < kOffMm && (plate.parent != bond.mate || plate.lying != side)) continue;
            const Vec3 from = p + away * up - frame.origin;
            if (contains(plate.outline, {dot(from, frame.axes[0]), dot(from, frame.axes[1])}))
                here.insert(of);
        }
        for (const int of : here) ++hidden[of];
    }
    std::set<int> result;
    for (const auto& [of, count] : hidden) {
        if (2 * count >= places.size()) result.insert(of);
    }
    return result;
}

std::map<int, std::set<int>> InTheWay::wants() const {
    std::map<int, std::set<int>> all;
    for (const Bond& bond : bonds_) {
        const int piece = nth(in_.plates, bond.plate).piece;
        const int ground = nth(order_.bearers, piece);
        if (ground < 0 || nth(in_.plates, bond.mate).piece == piece) continue;
        for (const int above_it : above(bond, ground)) all[above_it].insert(piece);
    }
    add_enclosed(all);
    return all;
}

void InTheWay::add_enclosed(std::map<int, std::set<int>>& wants) const {
    using PagePoint = bg::model::point<double, 2, bg::cs::cartesian>;
    using PageBox = bg::model::box<PagePoint>;
    // Tabs by what they are glued to and on which side, and then by their piece.
    using Side = std::pair<int, bool>;
    std::map<Side, std::map<int, std::vector<Bond>>> feet;
    for (const Bond& bond : bonds_) {
        if (bond.kind != Bond::Kind::tab || bond.theirs) continue;
        const int piece = nth(in_.plates, bond.plate).piece;
        const int mates = nth(in_.plates, bond.mate).piece;
        if (piece != mates) feet[{mates, bond.on_back}][piece].push_back(bond);
    }
    for (const auto& [side, pieces] : feet) {
        std::vector<std::pair<PageBox, int>> boxes;
        std::map<int, Ring> hulls;
        for (const auto& [piece, tabs] : pieces) {
            std::vector<Vec2> ends;
            for (const Bond& bond : tabs) {
                const Segment& seam = nth(in_.glue, bond.number).on_base;
                ends.insert(ends.end(), {seam.a, seam.b});
            }
            Ring hull = convex_hull(std::move(ends));
            if (hull.size() < 3) continue;
            const Box box = bounds(hull);
            boxes.emplace_back(PageBox{PagePoint(box.min.x, box.min.y), PagePoint(box.max.x, box.max.y)},
                               piece);
            hulls[piece] = std::move(hull);
        }
        const bgi::rtree<std::pair<PageBox, int>, bgi::quadratic<16>> tree(boxes);
        for (const auto& [piece, tabs] : pieces) {
            std::vector<Vec2> places;
            for (const Bond& bond : tabs) {
                const std::vector<Vec2> of_bond = target_places(in_, bond);
                places.insert(places.end(), of_bond.begin(), of_bond.end());
            }
            std::vector<std::pair<PageBox, int>> found;
            tree.query(bgi::intersects(PagePoint(places.front().x, places.front().y)),
                       std::back_inserter(found));
            for (const auto& [box, round] : found) {
                if (round == piece || nth(order_.bearers, round) != nth(order_.bearers, piece)) continue;
                const Polygon hull{hulls.at(round), {}};
                if (std::all_of(places.begin(), places.end(), [&](Vec2 p) { return contains(hull, p); }))
                    wants[round].insert(piece);
            }
        }
    }
}

}  // namespace popup
