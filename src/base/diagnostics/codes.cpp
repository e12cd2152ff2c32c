#include "base/diagnostics/codes.h"

#include <array>

namespace popup {
namespace {

constexpr std::array kBaseCodes = std::to_array<CodeInfo>({
    {"unreadable-input", Severity::error, "an input file cannot be read",
     "The file does not exist, is larger than 64 MiB, may not be opened by this user, or is a directory, "
     "which only check, fix and gallery look into. Nothing of it has been looked at. Check the path and the "
     "permissions; paths are taken relative to the directory the program was started in, and \"-\" stands "
     "for standard input."},
    {"unwritable-output", Severity::error, "an output file cannot be written",
     "The directory does not exist, is not writable, or the disk is full. Outputs are written to temporary "
     "files first and moved into place together, so no older file of this run has been touched. Create the "
     "directory or choose another place with -o."},
});

}  // namespace

std::span<const CodeInfo> base_codes() { return kBaseCodes; }

}  // namespace popup
