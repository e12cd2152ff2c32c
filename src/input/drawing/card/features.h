// The features of a drawn card: what stands on which fold.
//
// Faces of the sheet become plates. The two halves of the page are the plates of the gutter. A feature on a
// fold is what folds join to both of its plates, so that the four folds make a linkage (linkage.h); its own
// three folds are folds to stand on, and so on to any depth. What is cut all around makes a feature where it
// lies across a fold, and is a hole elsewhere. So is what has one side on a fold: that fold joins nothing
// there, unless all that it joins is drawn as closed cuts with folds on top.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "base/geometry/sheet_graph.h"
#include "input/drawing/card/linkage.h"
#include "input/drawing/card/page.h"

namespace popup::drawing::card {

struct DrawnFeature {
    int drive = 0;  // that it stands on
    // Its faces; folds around and in it. Outlined: cut all around, its folds inside or left to the program.
    bool outlined = false;
    std::vector<int> faces;
    Linkage linkage;
    FoldLine left, right, centre;            // without edges where none was drawn
    std::vector<int> run_on;                 // edges of the drive's line that were drawn through it
    bool has_left = true, has_right = true;  // of an outlined one: the side fold is known
};

// What is not understood, once each.
struct NotUnderstood {
    int element = 0;
    std::string what;
    Vec2 at;
    std::string hint = {};  // if there is one beside the usual
};

struct Features {
    std::vector<Drive> drives;           // the gutter first
    std::vector<DrawnFeature> features;  // parents first
    std::vector<NotUnderstood> faults;
    std::vector<int> plate_of;  // of each face; -1: of none
    std::vector<int> group_of;  // faces that folds join have one number
    // Outlines across folds without a fold in them: holes, as any that nothing holds. Groups, and each once.
    std::set<int> holes_over_folds;
    std::vector<NotUnderstood> over_folds;
    std::vector<NotUnderstood> beside_folds;  // closed cuts with a side on a fold: holes that end there
    std::map<int, NoLinkage> why;             // faces that make no feature, and why
    std::set<int> refused;                    // groups that are outlined and make none: told in `faults`
};

// Finds all but holes. Cost: near linear in edges for what people draw.
Features find_features(const SheetGraph& graph, const CardPage& page);

// Groups of faces that no plate's group holds, each with its faces.
std::map<int, std::vector<int>> loose_groups(const SheetGraph& graph, const Features& features);
// The plates on the other side of a border; -1 for what is none.
std::set<int> plates_around(const SheetGraph& graph, const Features& features, const std::vector<int>& ring);
// The first element that drew one of the halves. Precondition: there is one.
int first_element(const SheetGraph& graph, const std::vector<int>& halves);

}  // namespace popup::drawing::card
