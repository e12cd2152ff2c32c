// The assembly of an origamic architecture.
#pragma once

#include <string>
#include <vector>

#include "input/origamic/folds.h"
#include "popup/assembly.h"

namespace popup::origamic {

struct Card {
    double width = 0.0;   // along the gutter, > 0
    double height = 0.0;  // of the back, and of the floor, > 0
    double opens_deg = 90.0;
};

// What is said of a region that becomes a plate.
struct Named {
    std::string plate;  // unique among them
    std::string joint = "page";
    Place place = {};
};

// One piece, its plates in the order of `held`, the covers first; paper that no fold holds is not among them.
// Every edge of a plate is cut where it is not folded. `named` is by region. Precondition: there are covers.
// Numbers are not settled. Cost: near linear in corners.
Assembly make_assembly(const Card& card, const std::vector<Region>& regions, const std::vector<Fold>& folds,
                       const Holding& held, const std::vector<Named>& named);

}  // namespace popup::origamic
