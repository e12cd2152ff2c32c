// The planes of a drawn card whose folds all run along the gutter: each plate stays parallel to one half of
// the page, so it stands or lies, and has one distance from that half.
#pragma once

#include <optional>
#include <vector>

#include "input/drawing/card/features.h"

namespace popup::drawing::card {

struct Plane {
    bool known = false;  // folds lead there from the page
    bool upright = false;
    double offset = 0.0;  // mm from the half of the page that it is parallel to
};

struct Planes {
    std::vector<Plane> of;      // by face
    std::vector<int> order;     // faces that are known, as folds lead to them; first the two of the page
    std::vector<int> drawn_on;  // edges of folds within one plane
};

// Whether folds that go on beyond cuts that cross them are taken as they are drawn.
enum class DrawnOn { taken, looked_for };

// Whether paper is folded there: not so beside a hole, nor where the paper ends.
bool folds_paper(const SheetGraph& graph, const Features& features, int half);

// `corners`: of the graph, on the page. Nullopt if a fold does not run along the gutter, if folds that lead
// round something do not come back to the plane they left (by more than kSnapMm), or if there are more than
// 500 plates; then `why` says which, and where. Looked for, a stretch of a fold between two cuts across it is
// drawn on where other folds lead to one plane on both sides of it, or to one side only. Cost: linear in
// edges, and in stretches times plates where looked for.
std::optional<Planes> find_planes(const SheetGraph& graph, const CardPage& page, const Features& features,
                                  const std::vector<Vec2>& corners, DrawnOn drawn_on, NotUnderstood& why);

}  // namespace popup::drawing::card
