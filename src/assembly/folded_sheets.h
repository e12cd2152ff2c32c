// What several rooms have to know of sheets that are folded: the laws of folds, and the names of panels that
// are glued, and of lids.
#pragma once

#include <algorithm>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "popup/assembly.h"
#include "popup/joints.h"

namespace popup {

// Panels with these in their names, which name_panels() gives, are glued to what they lie on in the end.
inline constexpr std::string_view kGlueFlapName = "glue-flap";
inline constexpr std::string_view kGlueCornerName = "glue-corner";
// What closes a tray is called so, and begins what hangs on it is called: "lid-tuck".
inline constexpr std::string_view kLidName = "lid";

// Whether an assembly is a sheet that is folded: a plate of it stays where it is.
inline bool is_folded_sheet(const Assembly& assembly) {
    return std::any_of(assembly.joints.begin(), assembly.joints.end(),
                       [](const Joint& joint) { return std::holds_alternative<Still>(joint.how); });
}

using Law = std::vector<Vec2>;  // as Folded has it

// The law by which a joint folds. Null: it is no fold.
inline const Law* law_of(const Joint& joint) {
    if (const auto* const folded = std::get_if<Folded>(&joint.how)) return &folded->law;
    if (const auto* const closing = std::get_if<LoopFold>(&joint.how)) return &closing->law;
    return nullptr;
}
inline Law* law_of(Joint& joint) { return const_cast<Law*>(law_of(std::as_const(joint))); }

}  // namespace popup
