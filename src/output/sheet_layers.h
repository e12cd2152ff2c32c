// Panels of a folded sheet that lie on one another, as the flaps of a box on its walls: which is in front.
#pragma once

#include <span>
#include <vector>

#include "popup/assembly.h"

namespace popup {

// Which of two panels in one plane is in front is told by how they came there: by the side on which one was
// of the other when the sheet was a little less folded. So an inner flap lies on the inner side.
//
//     SheetLayers layers(assembly);
//     const std::vector<double> levels = layers.at(0.0, frames);
//
// Nothing lies on anything where the assembly is no folded sheet, nor in sheets of more than 1000 panels.
class SheetLayers {
 public:
    explicit SheetLayers(const Assembly& assembly);

    // Whether it is a sheet of which panels may come to lie on one another.
    [[nodiscard]] bool any() const { return is_sheet_; }
    // How far apart layers are shown, mm: kLayerMm, and in large sheets a 4000th of their size.
    [[nodiscard]] double layer_mm() const { return layer_mm_; }
    // By plate: how many layers it lies before its place, along its own front, at an opening of which
    // `frames` are the places, turned in whatever way. Of what lies on one another the largest panel stays in
    // its place. Empty: nothing lies on anything. Layers of more than 3 mm together count for less. Cost: n
    // log n in plates, and in pairs of them that lie near each other; a placing of all plates for each degree
    // to where they come from, once for all openings.
    std::vector<double> at(double opening_deg, std::span<const Frame> frames);

 private:
    // Two panels in one plane, and the same points of what they share, on the page of each.
    struct Lying {
        int a = 0, b = 0;
        std::vector<Vec2> on_a, on_b;
        int side = 0;  // 1: b lies on the front of a, -1: on its back, 0: nobody knows
    };
    [[nodiscard]] std::vector<Lying> lying_at(std::span<const Frame> frames) const;
    void look_at(int a, int b, std::span<const Frame> frames, std::vector<Lying>& lying) const;
    void find_sides(double opening_deg, std::vector<Lying>& lying);
    // The places after so many degrees of the sweep; empty: the linkages do not get there.
    const std::vector<Frame>& placed(int step);

    const Assembly& assembly_;
    bool is_sheet_ = false;
    double layer_mm_ = 0.0;
    std::vector<std::vector<Frame>> placed_;  // by step; empty: not looked at
};

}  // namespace popup
