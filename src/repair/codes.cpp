#include "repair/codes.h"

#include <array>

namespace popup {
namespace {

constexpr std::array kRepairCodes = std::to_array<CodeInfo>({
    {"moved-clear", Severity::warning,
     "an element was moved so that it no longer goes through another or lies on it",
     "Two elements went through each other as the card opened, or lay on one another. \"popupc fix "
     "--collisions\" moved one of "
     "them along its fold or plate by the shortest distance that was tried and works, together with "
     "everything that stands on it. popupc examined the new document: these two no longer meet, no "
     "other pair does that did not before, and there is no other new warning. Prints on the page "
     "did not move. If the two are meant to touch, take the change back and write <!-- popupc: allow "
     "collision --> or <!-- popupc: allow lies-on-another --> before one of them."},
});

}  // namespace

std::span<const CodeInfo> repair_codes() { return kRepairCodes; }

}  // namespace popup
