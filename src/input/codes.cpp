#include "input/codes.h"

#include <array>

namespace popup {
namespace {

constexpr std::array kInputCodes = std::to_array<CodeInfo>({
    {"bad-number", Severity::error, "a number that cannot be read, or is out of range",
     "Numbers are decimal, with a full stop before the decimals and an optional exponent: 1.5, -0.25, "
     "1e-3. Hexadecimal numbers, decimal commas, NaN and infinity are not read, and coordinates further "
     "than a million millimetres from the middle of the page are taken for mistakes, as are lines thicker "
     "than 1000 points or thinner than none. Correct the number, or the unit of the document."},
    {"document-too-large", Severity::error, "more markup than is read",
     "The document has more markup than any design that could be made of paper: over 250 000 structures or "
     "lines, a million points, a million elements, attributes and texts in a single structure or line, or "
     "eight million altogether. The limits keep hostile documents from filling the memory. Split the "
     "design into several documents."},
    {"holes-overlap", Severity::warning, "two holes of a part that overlap partly",
     "Two contours within one part have an area in common though neither lies in the other. The paper that "
     "is left is what both leave, and the outline of that is cut. Unite the two contours if one opening is "
     "meant, or move them apart if they are two."},
    {"no-design", Severity::error, "an input that is not the design of a card",
     "The input is a drawing of flat parts, or an assembly. What was asked for needs the design of a pop-up "
     "card, which these do not have. Give it to popupc build for sheets (.svg, .pdf) or the report "
     "(.json), or name a popup document."},
    {"unknown-language", Severity::error, "an input whose language is not known",
     "The language of an input is told by the suffix of its name. This name has none that is known, or it "
     "is standard input, which has no suffix. Rename the file, or name the language with --from; `popupc "
     "list languages` shows all of them."},
});

}  // namespace

std::span<const CodeInfo> input_codes() { return kInputCodes; }

}  // namespace popup
