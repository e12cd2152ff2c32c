#include "batch/codes.h"

#include <array>

namespace popup {
namespace {

constexpr std::array kBatchCodes = std::to_array<CodeInfo>({
    {"bad-manifest", Severity::error, "a row of a manifest that is no job",
     "The list of a batch's jobs is read whole before any job begins. Each row needs at least one input "
     "and one output; a row of JSON lines is an object with the keys input, output, options and copies, a "
     "row of CSV has these columns. No two jobs may write the same file, and none may read what another "
     "writes, because jobs have no order. Mend the row at the place given."},
});

}  // namespace

std::span<const CodeInfo> batch_codes() { return kBatchCodes; }

}  // namespace popup
