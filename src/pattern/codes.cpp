#include "pattern/codes.h"

#include <array>

namespace popup {
namespace {

constexpr std::array kPatternCodes = std::to_array<CodeInfo>({
    {"tab-too-small", Severity::warning, "little is left of a glue tab",
     "A glue tab runs along each seam of a piece, and its target on the plate it is glued to. Both are "
     "trimmed so that they stay 1 mm clear of folds, cuts, edges and earlier tabs. Of this one less than 3 "
     "mm of depth are left along half its seam or more, so the joint will hold badly, or the seam has no "
     "tab at all. Move the element away from what is near its seam, make the seam longer, or add paper by "
     "hand and glue from behind; --allow tab-too-small accepts it."},
});

}  // namespace

std::span<const CodeInfo> pattern_codes() { return kPatternCodes; }

}  // namespace popup
