#include "run/codes.h"

#include <array>

namespace popup {
namespace {

constexpr std::array kRunCodes = std::to_array<CodeInfo>({
    {"unused-allow", Severity::warning, "a comment allows what is not there",
     "A comment of the document allows a diagnostic, and where it stands nothing of the kind was found, "
     "although everything was looked at. The reason for it may have gone, or the comment has lost the "
     "element that it was written for. Left alone it would hide the next such finding, which nobody has "
     "looked at. Take the code out of the comment, or the comment out of the document."},
});

}  // namespace

std::span<const CodeInfo> run_codes() { return kRunCodes; }

}  // namespace popup
