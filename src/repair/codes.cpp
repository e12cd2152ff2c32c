#include "repair/codes.h"

#include <array>

namespace popup {
namespace {

constexpr std::array kRepairCodes = std::to_array<CodeInfo>({
    {"moved-clear", Severity::warning, "an element was moved so that it no longer goes through another",
     "Two elements went through each other on the way from the closed to the open card. The shortest move of "
     "one of them along what it stands on was tried, after which they touch at no angle; \"popupc fix "
     "--collisions\" has written it into the document, with what stands on the element. The document was "
     "examined again: this pair is clear, no other collides that did not before, and nothing else became "
     "wrong. What is printed on the page where the element stood is where it was. If the two are meant to "
     "touch, take the change back and write <!-- popupc: allow collision --> before one of them."},
});

}  // namespace

std::span<const CodeInfo> repair_codes() { return kRepairCodes; }

}  // namespace popup
