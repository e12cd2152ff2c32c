#include "edit/codes.h"

#include <array>

namespace popup {
namespace {

constexpr std::array kEditCodes = std::to_array<CodeInfo>({
    {"bad-edit", Severity::error, "an edit that cannot be carried out",
     "A verb that there is not, a value that the element does not have, a length that is none, or a change "
     "that "
     "makes no element. The message says which, and what would be understood. Nothing is written: of several "
     "edits all are carried out or none."},
    {"edit-refused", Severity::error, "an edit that would break the card",
     "After an edit the document is checked as always. This one would have an error that it did not have "
     "before, "
     "which is told with it, so nothing is written. Often something stands on what was moved: --follow takes "
     "it "
     "along. With --force the document is written all the same."},
    {"no-such-element", Severity::error, "an id that no element has",
     "An edit, or `popupc show`, names an element by its id, and there is none of that name. An element "
     "without "
     "an id of its own is called e and its number in the list, counted from 1. `popupc show` lists them."},
});

}  // namespace

std::span<const CodeInfo> edit_codes() { return kEditCodes; }

}  // namespace popup
