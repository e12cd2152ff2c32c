// What an assembly of a sheet has however the sheet is folded: its pieces with their cuts, and a plate of
// each panel.
#pragma once

#include <vector>

#include "folded/sheet.h"
#include "popup/assembly.h"

namespace popup::folded {

// By panel: the folds at which it ends, ascending.
std::vector<std::vector<int>> folds_by_panel(const Sheet& sheet);

// How panels hang on one another: breadth first, from the one of each piece that stays while the others are
// folded. That is the largest, but of cartons (folded/carton/names.h)
//
// * the base of a tray, even where its lid or a wall is larger;
// * of a tube whose largest panels are as large as one another, to a hundredth, not its top, and the one at
//   which most panels hang, as lids do on the back.
struct Tree {
    std::vector<int> order;     // panels, each after the one that it hangs on
    std::vector<int> fold_of;   // by panel: the fold that it hangs on; -1: it stands still
    std::vector<int> plate_of;  // by panel: its place in `order`
};
Tree make_tree(const CreasePattern& pattern, const Sheet& sheet);

// Pieces "sheet", or "sheet-1", "sheet-2"; their edges and slits as cuts; plates "sheet/1" in the order of
// the tree, those of cartons "sheet/front" and the like (folded/carton/names.h). No folds, joints or hinges.
Assembly assembly_of_panels(const CreasePattern& pattern, const Sheet& sheet, const Tree& tree);

}  // namespace popup::folded
