#include "input/cp/codes.h"

#include <array>

namespace popup {
namespace {

constexpr std::array kCpCodes = std::to_array<CodeInfo>({
    {"cp-no-pattern", Severity::error, "a .cp file without lines",
     "A crease pattern is lines that are cut and folded, one a line of the file, and this file has none. "
     "Export the crease pattern anew from the program that made it."},
    {"cp-size", Severity::remark, "a .cp file, which does not say how large the sheet is",
     "Files of ORIPA and its like have numbers without a unit: most programs draw on a square of 400, and "
     "the "
     "numbers say the shape of the sheet, not its size. popupc makes the longer side 200 mm long. Use "
     "--scale "
     "for another size, or exchange the pattern as FOLD, which has \"frame_unit\"."},
    {"cp-value", Severity::error, "a line of a .cp file that cannot be read",
     "Each line of the file is a line of the pattern: its kind, and the x and y of its two ends, five "
     "numbers "
     "with blanks between them. The kinds are 1, an edge of the paper or a cut; 2, a mountain; 3, a valley; "
     "4 "
     "or 0, an auxiliary line, which is not folded. The message says what stands there instead."},
});

}  // namespace

std::span<const CodeInfo> cp_codes() { return kCpCodes; }

}  // namespace popup
