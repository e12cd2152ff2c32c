#include "findings/codes.h"

#include <array>

namespace popup {
namespace {

constexpr std::array kFindingsCodes = std::to_array<CodeInfo>({
    {"bad-baseline", Severity::error, "a baseline that cannot be read",
     "The file that --baseline names is not a list of accepted findings as --write-baseline makes it. A "
     "baseline is a JSON file with a finding on each line: its file, code, element, digest and count. "
     "Nothing is checked against a broken one, since findings would fail, or pass, for no reason. Mend the "
     "line, which a merge of two branches may have broken, or take the file away and write it anew."},
});

}  // namespace

std::span<const CodeInfo> findings_codes() { return kFindingsCodes; }

}  // namespace popup
