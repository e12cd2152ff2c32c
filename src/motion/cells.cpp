#include "motion/cells.h"

#include <algorithm>

#include "motion/joints/joint.h"

namespace popup {
namespace {

constexpr double kWidestDeg = 10.5;
constexpr double kHalvedBelowDeg = 12.0;

// A turn's line in the world, and how far it goes to either end of the cell.
Arm world_arm(const Cell& cell, const Linkage& linkage, std::size_t turn) {
    const auto before = [&](int n) {
        return Bends{cell.first[static_cast<std::size_t>(n)], cell.middle[static_cast<std::size_t>(n)]};
    };
    const auto after = [&](int n) {
        return Bends{cell.middle[static_cast<std::size_t>(n)], cell.last[static_cast<std::size_t>(n)]};
    };
    const Turn& t = linkage.turns()[turn];
    const Frame& frame = cell.frames[static_cast<std::size_t>(t.plate)];
    return {frame.point(t.at), frame.direction(t.dir),
            travel_from_middle(linkage, static_cast<int>(turn), cell.from, cell.to, before, after)};
}

std::vector<Arm> world_arms(const Cell& cell, const Linkage& linkage) {
    std::vector<Arm> arms;
    arms.reserve(linkage.turns().size());
    for (std::size_t i = 0; i < linkage.turns().size(); ++i) arms.push_back(world_arm(cell, linkage, i));
    return arms;
}

// Round all that corners of a plate's page can reach. `arm`: of a turn.
template <typename ArmOf>
SpaceBox box_round(const Cell& cell, const Linkage& linkage, int plate, std::span<const Vec2> corners,
                   double distance_mm, const ArmOf& arm, const std::optional<Drift>& drift) {
    const auto turns = linkage.turns();
    SpaceBox box;
    for (const Vec2 corner : corners) {
        const Vec3 p = cell.frames[static_cast<std::size_t>(plate)].point(corner);
        double reach = 0.0;
        for (int at = plate; at >= 0;) {
            const int turn = linkage.drive_turn(at);
            const Arm& by = arm(turn);
            reach += by.turn * (length(cross(p - by.at, by.dir)) + reach);
            at = turns[static_cast<std::size_t>(turn)].other;
        }
        if (drift) reach = std::min(reach, drift->of(p));
        box.extend(p, reach + 0.5 * distance_mm);
    }
    return box;
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

bool fill_cell(const Assembly& assembly, const Linkage& linkage, std::span<const std::size_t> joints,
               double from, double to, Cell& cell) {
    cell.from = from;
    cell.to = to;
    cell.frames.resize(assembly.plates.size());
    const auto take = [&](double deg, std::vector<double>& bends) {
        bends.resize(linkage.turns().size());
        for (const std::size_t joint : joints) {
            if (!place_plates(assembly.joints[joint], Angle::degrees(deg), cell.frames)) return false;
        }
        for (const std::size_t joint : joints) {
            const auto [first, end] = linkage.turns_of_joint(joint);
            for (std::size_t i = first; i < end; ++i)
                bends[i] = linkage.bend(static_cast<int>(i), cell.frames);
        }
        return true;
    };
    return take(from, cell.first) && take(to, cell.last) && take(0.5 * (from + to), cell.middle);
}

std::vector<SpaceBox> reach_boxes(const Cell& cell, const Linkage& linkage,
                                  std::span<const PlateShape> shapes, double distance_mm) {
    const std::vector<Arm> arms = world_arms(cell, linkage);
    const std::vector<std::optional<Drift>> drifts = world_drifts(cell, linkage, arms);
    const auto arm = [&](int turn) -> const Arm& { return arms[static_cast<std::size_t>(turn)]; };
    std::vector<SpaceBox> boxes;
    boxes.reserve(shapes.size());
    for (std::size_t i = 0; i < shapes.size(); ++i) {
        const int plate = static_cast<int>(i);
        boxes.push_back(box_round(cell, linkage, plate, shapes[i].hull, distance_mm, arm,
                                  drifts[static_cast<std::size_t>(linkage.drive_turn(plate))]));
    }
    return boxes;
}

SpaceBox reach_box(const Cell& cell, const Linkage& linkage, int plate, std::span<const Vec2> corners,
                   double distance_mm) {
    const auto arm = [&](int turn) { return world_arm(cell, linkage, static_cast<std::size_t>(turn)); };
    return box_round(cell, linkage, plate, corners, distance_mm, arm, std::nullopt);
}

}  // namespace popup
