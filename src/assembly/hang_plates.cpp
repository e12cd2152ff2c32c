#include "popup/assembly.h"

namespace popup {

void hang_plates(const Joint& joint, std::vector<Plate>& plates) {
    for (const PlacedPlate& one : plates_of(joint).places) {
        Plate& plate = plates[static_cast<std::size_t>(one.plate)];
        plate.parent = one.parent;
        plate.pivot = one.pivot;
        plate.lying = one.lying;
    }
}

}  // namespace popup
