#include "pattern/codes.h"

#include <array>

namespace popup {
namespace {

constexpr std::array kPatternCodes = std::to_array<CodeInfo>({
    {"glue-overlaps", Severity::warning, "two elements are glued in the same place",
     "Each glue tab needs its own place on the plate it is glued to. Here more than 5 mm, or a quarter, of a "
     "seam "
     "lies where the tab of an earlier element is glued, so nothing is left there of the later tab, and the "
     "joint may not hold. The message says which tabs these are and where they meet. Where the hint names a "
     "move, it has been tried: the tabs are clear of all others then, and nothing else is found. Else move "
     "one of the two elements, turn the seam so that its tab lies on the other side, or make the tabs less "
     "deep with "
     "--tab-depth. A piece that is glued flat, and was written twice, is told likewise: take one of the two "
     "out."},
    {"target-covered", Severity::remark, "a mark of where to glue lies under another piece",
     "Paper may be glued on paper that is glued flat, if both are on one side of one plate: they move as "
     "one, "
     "and it holds. But the mark is printed on the plate, and the other piece, which must be glued first, "
     "covers it: a wall of paper rises out of that piece, so that it could not be laid down later; or it is "
     "listed first, and what is listed later lies on top. The message says what is covered, by what, and "
     "where. Move one of the two; let what is glued flat stand on the plate of the other, where its area is "
     "marked then; or measure the place. The assembly book glues them in the order that can be done."},
    {"tab-too-small", Severity::warning, "little is left of a glue tab",
     "A glue tab runs along each seam of a piece, and its target on the plate it is glued to. Both are "
     "trimmed so that they stay 1 mm clear of folds, cuts, edges and earlier tabs. Of this one less than 3 "
     "mm of depth are left along half its seam or more, so the joint will hold badly, or the seam has no "
     "tab at all. Move the element away from what is near its seam, make the seam longer, or add paper by "
     "hand and glue from behind; --allow tab-too-small accepts it. A --scale below 1 makes tabs smaller with "
     "all "
     "else: they are judged as they are made, too, and so is what is glued flat, which needs 25 mm²."},
});

}  // namespace

std::span<const CodeInfo> pattern_codes() { return kPatternCodes; }

}  // namespace popup
