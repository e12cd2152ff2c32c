#include "motion/bodies.h"

#include "base/nth.h"
#include "base/sets.h"
#include "motion/joints/joint.h"

namespace popup {

std::vector<int> bodies_of(const Assembly& assembly) {
    Sets glued(assembly.plates.size());
    for (const Joint& joint : assembly.joints) {
        for (const PlacedPlate& one : plates_of(joint).places) {
            if (one.parent >= 0 && one.lying != Lying::free && !nth(assembly.plates, one.plate).rivet)
                glued.unite(one.plate, one.parent);
        }
    }
    for (const GluedArea& area : assembly.glued_areas) glued.unite(area.plate, area.base_plate);
    std::vector<int> bodies;
    for (std::size_t i = 0; i < assembly.plates.size(); ++i)
        bodies.push_back(glued.find(static_cast<int>(i)));
    return bodies;
}

}  // namespace popup
