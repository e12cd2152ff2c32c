// How far apart plates are shown that lie on one another: in pictures, in the viewer and in models.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "output/open_layers.h"
#include "output/sheet_layers.h"
#include "popup/output.h"

namespace popup {

// Plates have no thickness, so what lies on one another would be in one place, and nobody could tell what is
// in front. They are shown a little beside their places:
//
// * what is glued flat on another, on its side of it, several one over the other;
// * what lies on the pages of an open card, as open_layers() has it;
// * all plates of a card that is as good as closed, one over the other;
// * panels of folded sheets, as SheetLayers has it.
class Apart {
 public:
    explicit Apart(const SceneCard& card);

    // In models nothing is told apart, at any opening.
    [[nodiscard]] bool none_in_models() const { return open_.empty() && !sheet_.any(); }
    [[nodiscard]] const std::vector<OpenLayer>& open() const { return open_; }
    // By plate: mm towards the front of the first cover, on the closed card; empty: it does not close flat.
    [[nodiscard]] const std::vector<double>& closed() const { return closed_; }
    [[nodiscard]] SheetLayers& sheet() { return sheet_; }

    struct State {
        std::span<const Frame> frames;      // of each plate
        std::optional<double> opening_deg;  // none: of none, so that neither sheets nor closed cards are told
        double paper_mm = 0.0;              // how thick the paper is shown
        // Of models, in which what is glued flat on others hangs on these a little before them, and whose
        // closed cards are as an examination leaves them: none of both is told.
        bool in_model = false;
    };
    // By plate: how far it is shown beside its place, in mm of the frames' directions. What hangs on a plate
    // goes with it, where it is not told apart itself.
    [[nodiscard]] std::vector<Vec3> lifts(const State& state);

 private:
    const Assembly& assembly_;
    std::vector<OpenLayer> open_;
    std::vector<double> closed_;
    SheetLayers sheet_;
    std::vector<int> order_;  // of plates, parents first
    std::vector<int> glued_;  // by plate: 1, 2, … of those on the front of one, -1, -2, … on its back, else 0
};

}  // namespace popup
