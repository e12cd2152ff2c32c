// The places of glue tabs, on their pieces and on the plates that they are glued to.
//
//     TabPlaces places(assembly, rules);
//     for (const Glue& glue : assembly.glue) {
//         const std::vector<Ring> parts = places.place(glue);
//         judge_tab(assembly, rules, glue, parts, diagnostics);
//     }
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "base/geometry/edge_index.h"
#include "pattern/tabs.h"
#include "popup/assembly.h"
#include "popup/diagnostics.h"
#include "popup/pattern.h"

namespace popup {

// A tab with less depth than this along half its seam holds badly.
inline constexpr double kWeakTabMm = 3.0;

// The rules that all tabs of a pattern keep to.
TabRules tab_rules(const PatternOptions& options);

class TabPlaces {
 public:
    // `assembly` must outlive it.
    TabPlaces(const Assembly& assembly, const TabRules& rules);

    // What is left of a tab, in the coordinates of its seam, after what was placed before it. It takes its
    // place on both sides. Precondition: no glue twice.
    std::vector<Ring> place(const Glue& glue);

    // Everything on one side of a plate that tabs and texts must stay off: its edges, lines on it, and what
    // has taken a place there.
    EdgeIndex& on_plate(int plate, bool back = false);
    // Takes a place for an area, whose ring is counter-clockwise as seen from the front.
    void take(int plate, bool back, Ring ring);

    // The paper of a piece, without tabs. Valid as long as this object.
    const std::vector<Polygon>& paper(int piece);

 private:
    EdgeIndex& off_piece(int piece);
    std::vector<Segment> near(const EdgeIndex& index, const SeamFrame& frame, const Ring& tab);

    const Assembly& in_;
    TabRules rules_;
    std::vector<std::vector<int>> lines_on_;  // of each plate: folds and cuts that name it
    // Of the fronts and the backs of all plates, and of all pieces, those that were asked for.
    std::array<std::vector<std::optional<EdgeIndex>>, 2> plates_;
    std::vector<std::optional<EdgeIndex>> outside_;
    std::vector<std::optional<std::vector<Polygon>>> papers_;
    std::vector<int> found_;
};

// Adds `tab-too-small` where a tab has too little depth along too much of its seam.
void judge_tab(const Assembly& assembly, const TabRules& rules, const Glue& glue, std::span<const Ring> parts,
               Diagnostics& diagnostics);

}  // namespace popup
