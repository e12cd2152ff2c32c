#include "motion/cells.h"

#include <algorithm>
#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <limits>

namespace popup {
namespace {

namespace bg = boost::geometry;
using TreePoint = bg::model::point<double, 3, bg::cs::cartesian>;
using TreeBox = bg::model::box<TreePoint>;

constexpr double kWidestDeg = 10.5;
constexpr double kHalvedBelowDeg = 12.0;

// Each turn's line in the world, and how far it goes to either end of the cell.
std::vector<Arm> world_arms(const Cell& cell, const Linkage& linkage) {
    const auto turns = linkage.turns();
    const auto before = [&](int n) {
        return Bends{cell.first[static_cast<std::size_t>(n)], cell.middle[static_cast<std::size_t>(n)]};
    };
    const auto after = [&](int n) {
        return Bends{cell.middle[static_cast<std::size_t>(n)], cell.last[static_cast<std::size_t>(n)]};
    };
    std::vector<Arm> arms;
    arms.reserve(turns.size());
    for (std::size_t i = 0; i < turns.size(); ++i) {
        const Turn& t = turns[i];
        const int n = static_cast<int>(i);
        const Frame& frame = cell.frames[static_cast<std::size_t>(t.plate)];
        arms.push_back({frame.point(t.at), frame.direction(t.dir),
                        travel_from_middle(linkage, n, cell.from, cell.to, before, after)});
    }
    return arms;
}

// By turn: how what it drives moves against the world, where all turns up to there have laws.
std::vector<std::optional<Drift>> world_drifts(const Cell& cell, const Linkage& linkage,
                                               std::span<const Arm> arms) {
    const auto turns = linkage.turns();
    const double half = Angle::degrees(0.5 * (cell.to - cell.from)).rad();
    std::vector<std::optional<Drift>> drifts(turns.size());
    std::vector<char> known(turns.size(), 0);
    std::vector<int> open;
    const auto above = [&](int turn) {
        const int base = turns[static_cast<std::size_t>(turn)].other;
        return base < 0 ? -1 : linkage.drive_turn(base);
    };
    for (std::size_t plate = 0; plate < cell.frames.size(); ++plate) {
        for (int turn = linkage.drive_turn(static_cast<int>(plate));
             turn >= 0 && known[static_cast<std::size_t>(turn)] == 0; turn = above(turn)) {
            open.push_back(turn);
        }
        while (!open.empty()) {
            const int number = open.back();
            const auto turn = static_cast<std::size_t>(number);
            open.pop_back();
            known[turn] = 1;
            const auto rate = linkage.rate(number, cell.from, cell.to);
            if (!rate) continue;
            const int base = above(number);
            if (base < 0) {
                drifts[turn].emplace(half);
            } else {
                drifts[turn] = drifts[static_cast<std::size_t>(base)];
            }
            if (drifts[turn]) drifts[turn]->turn(arms[turn].at, arms[turn].dir, *rate, 1.0);
        }
    }
    return drifts;
}

}  // namespace

std::vector<double> cell_ends(const Sweep& sweep, std::span<const double> range_ends) {
    std::vector<double> ends;
    double above = sweep.to_deg - sweep.from_deg;  // the beginning
    const double halved_below = sweep.closed_flat ? kHalvedBelowDeg : 0.0;
    while (above > halved_below) {
        ends.push_back(sweep.from_deg + above);
        above -= kWidestDeg;
    }
    while (sweep.closed_flat && above > kLeastOpeningDeg) {
        ends.push_back(sweep.from_deg + above);
        above *= 0.5;
    }
    ends.push_back(least_opening(sweep));
    std::reverse(ends.begin(), ends.end());
    const std::size_t even = ends.size();
    for (const double deg : range_ends) {
        if (deg > ends.front() && deg < ends[even - 1]) ends.push_back(deg);
    }
    std::inplace_merge(ends.begin(), ends.begin() + static_cast<std::ptrdiff_t>(even), ends.end());
    ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
    return ends;
}

bool fill_cell(const Assembly& assembly, const Linkage& linkage, double from, double to, Cell& cell) {
    cell.from = from;
    cell.to = to;
    cell.frames.resize(assembly.plates.size());
    const auto take = [&](double deg, std::vector<double>& bends) {
        if (!place(assembly, Angle::degrees(deg), cell.frames)) return false;
        bends.resize(linkage.turns().size());
        for (std::size_t i = 0; i < bends.size(); ++i)
            bends[i] = linkage.bend(static_cast<int>(i), cell.frames);
        return true;
    };
    return take(from, cell.first) && take(to, cell.last) && take(0.5 * (from + to), cell.middle);
}

std::vector<std::pair<int, int>> near_pairs(const Cell& cell, const Linkage& linkage,
                                            std::span<const PlateShape> shapes, double distance_mm,
                                            std::size_t most) {
    const std::vector<Arm> arms = world_arms(cell, linkage);
    const std::vector<std::optional<Drift>> drifts = world_drifts(cell, linkage, arms);
    const auto turns = linkage.turns();
    std::vector<std::pair<TreeBox, int>> boxes;
    boxes.reserve(shapes.size());
    for (std::size_t i = 0; i < shapes.size(); ++i) {
        const double inf = std::numeric_limits<double>::infinity();
        Vec3 low{inf, inf, inf};
        Vec3 high{-inf, -inf, -inf};
        const std::optional<Drift>& drift =
            drifts[static_cast<std::size_t>(linkage.drive_turn(static_cast<int>(i)))];
        for (const Vec2 corner : shapes[i].hull) {
            const Vec3 p = cell.frames[i].point(corner);
            double reach = 0.0;
            for (int plate = static_cast<int>(i); plate >= 0;) {
                const auto turn = static_cast<std::size_t>(linkage.drive_turn(plate));
                reach += arms[turn].turn * (length(cross(p - arms[turn].at, arms[turn].dir)) + reach);
                plate = turns[turn].other;
            }
            if (drift) reach = std::min(reach, drift->of(p));
            reach += 0.5 * distance_mm;
            low = {std::min(low.x, p.x - reach), std::min(low.y, p.y - reach), std::min(low.z, p.z - reach)};
            high = {std::max(high.x, p.x + reach), std::max(high.y, p.y + reach),
                    std::max(high.z, p.z + reach)};
        }
        boxes.emplace_back(TreeBox{{low.x, low.y, low.z}, {high.x, high.y, high.z}}, static_cast<int>(i));
    }
    const bg::index::rtree<std::pair<TreeBox, int>, bg::index::rstar<16>> tree(boxes.begin(), boxes.end());
    std::vector<std::pair<int, int>> pairs;
    for (const auto& [box, number] : boxes) {
        for (auto it = tree.qbegin(bg::index::intersects(box)); it != tree.qend(); ++it) {
            if (it->second > number) pairs.emplace_back(number, it->second);
        }
        if (pairs.size() > most) break;
    }
    std::sort(pairs.begin(), pairs.end());
    return pairs;
}

}  // namespace popup
