#include "gluing/bonds.h"

#include "base/nth.h"
#include "popup/motion.h"

namespace popup {
namespace {

constexpr double kIntoTargetMm = 3.0;  // from the seam

}  // namespace

std::vector<Bond> bonds_of(const Assembly& assembly) {
    std::vector<Bond> bonds;
    for (std::size_t i = 0; i < assembly.glue.size(); ++i) {
        const Glue& glue = assembly.glue[i];
        bonds.push_back(
            {Bond::Kind::tab, static_cast<int>(i), glue.piece_plate, glue.base_plate, glue.on_back});
    }
    for (std::size_t i = 0; i < assembly.glued_areas.size(); ++i) {
        const GluedArea& glued = assembly.glued_areas[i];
        const bool back = nth(assembly.plates, glued.plate).lying == Lying::on_back;
        bonds.push_back({Bond::Kind::area, static_cast<int>(i), glued.plate, glued.base_plate, back});
    }
    for (std::size_t i = 0; i < assembly.plates.size(); ++i) {
        const Plate& plate = assembly.plates[i];
        if (!plate.rivet || plate.parent < 0) continue;
        bonds.push_back({Bond::Kind::rivet, static_cast<int>(i), static_cast<int>(i), plate.parent,
                         plate.lying == Lying::on_back});
    }
    return bonds;
}

std::vector<Vec2> target_places(const Assembly& assembly, const Bond& bond) {
    std::vector<Vec2> places;
    switch (bond.kind) {
        case Bond::Kind::tab: {
            const Glue& glue = nth(assembly.glue, bond.number);
            const Segment& seam = bond.theirs ? glue.on_piece : glue.on_base;
            const Vec2 along = unit(seam.b - seam.a);
            const bool left = bond.theirs || bond.on_back;
            const Vec2 in = kIntoTargetMm * (left ? left_of(along) : right_of(along));
            for (const double t : {0.5, 0.15, 0.85}) places.push_back(lerp(seam.a, seam.b, t) + in);
            break;
        }
        case Bond::Kind::area: {
            for (const Polygon& part : nth(assembly.glued_areas, bond.number).on_base) {
                const Vec2 inner = inner_point(part, 0.5).at;
                places.push_back(inner);
                for (std::size_t k = 0; k < 4; ++k) {
                    const Ring& outer = part.outer;
                    places.push_back(lerp(inner, outer[k * outer.size() / 4], 0.7));
                }
            }
            break;
        }
        case Bond::Kind::rivet:
            POPUP_INVARIANT(false && "a rivet has no target");
    }
    return places;
}

std::vector<Vec3> target_points(const Assembly& assembly, const Bond& bond,
                                const std::vector<Frame>& frames) {
    if (bond.kind == Bond::Kind::rivet)
        return {nth(frames, bond.plate).point(*nth(assembly.plates, bond.number).rivet)};
    std::vector<Vec3> points;
    for (const Vec2 p : target_places(assembly, bond)) points.push_back(nth(frames, bond.mate).point(p));
    return points;
}

GluePoses poses_of(const Assembly& assembly) {
    if (!moves(assembly)) return {};
    const auto at = [&](double share) {
        const Sweep& sweep = assembly.sweep;
        std::vector<Frame> frames(assembly.plates.size());
        const bool placed =
            place(assembly, Angle::degrees(sweep.from_deg + share * (sweep.to_deg - sweep.from_deg)), frames);
        if (!placed) frames.clear();
        return frames;
    };
    GluePoses poses{at(1.0), at(0.97), at(0.5), at(0.08)};
    if (poses.reach.empty() || poses.half.empty() || poses.ajar.empty()) poses.open.clear();
    return poses;
}

}  // namespace popup
