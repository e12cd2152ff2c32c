#include "input/oa/codes.h"

#include <array>

namespace popup {
namespace {

constexpr std::array kOaCodes = std::to_array<CodeInfo>({
    {"oa-clipped", Severity::remark, "a face of webOAcard that reaches beyond the card",
     "Part of the face lies outside of the sheet: above the back, before the floor, or beside the card. It "
     "is cut off at the edge, as webOAcard does. What lies below the floor (Y above t) is cut off without a "
     "word, for faces are drawn through the floor on purpose."},
    {"oa-contour-empty", Severity::warning, "a contour of webOAcard that encloses nothing",
     "The points of the contour make no area: there are fewer than three of them, or they lie in one line. "
     "Or its holes leave nothing of it. It is left out, for there is nothing to cut. Mostly a click too many "
     "has made it: take it out of the file, or draw it anew."},
    {"oa-depth", Severity::warning, "a face of webOAcard that cannot stand where it should",
     "The depth t of a face says how far from the back it stands when the card is open by 90 degrees. It is "
     "more than 0, for at 0 it would be the back itself, and no more than the height of the card, for there "
     "the floor ends. This face is left out. Correct its t."},
    {"oa-hidden", Severity::warning, "a face of webOAcard of which nothing is left",
     "All cards of this kind are one sheet, and each point of it can be in one plate only. Of what "
     "would have the same paper the highest has it, of standing plates the nearest, and holes leave nothing. "
     "Nothing of this face remains, so it is neither cut nor folded. Take it out, or move "
     "what covers it on the sheet."},
    {"oa-loose", Severity::warning, "paper of a webOAcard design that nothing holds",
     "The part is cut on all sides: no path of folds leads from it to the back or to the floor, so it falls "
     "out when the sheet is cut. A plate stands when its lower edge lies on the floor or on a horizontal "
     "plate, or when a horizontal plate runs back from its upper edge to one that is held. Paper of back and "
     "floor that a hole cuts out is not told, for that is what a hole is for."},
    {"oa-no-card", Severity::error, "a webOAcard design without a back or without a floor",
     "Plates cover all of the back or all of the floor on the sheet, so there is nothing left to open and to "
     "close the card with. The designs of webOAcard are cut from one sheet, twice as high as the card: what "
     "stands on it must leave paper round it. Make the card larger or the faces smaller."},
    {"oa-snapped", Severity::warning, "a face of webOAcard that misses what it should stand on",
     "The lower edge of the face ends half a millimetre or less above the floor or above a horizontal "
     "plate, which happens where a face was drawn with another grid or another card height. As it is drawn "
     "there would be a cut, a sliver of paper, and a plate that stands on nothing; so the edge was drawn "
     "down, and there is a fold. Correct its Y in the file to say so yourself."},
    {"oa-syntax", Severity::error, "a webOAcard file that is not JSON",
     "Files of webOAcard (.oa) hold one JSON object with \"settings\" and \"faces\". This text breaks the "
     "rules of JSON at the place named, has two members of one name in an object, or is nested deeper than "
     "any design. A file that was cut off while it was copied ends like this; save it again."},
    {"oa-value", Severity::error, "a value of a webOAcard file that is missing or of the wrong sort",
     "Settings have cardW and cardH; each face has contours of points {\"X\", \"Y\"}, a depth t, and may "
     "have "
     "mode (0 face, 1 hole, 2 pull), contoursType, type (\"VFACE\") and timestamp. Lengths are millimetres. "
     "The value named is missing, is something else, or is out of range; the message says what belongs "
     "there."},
});

}  // namespace

std::span<const CodeInfo> oa_codes() { return kOaCodes; }

}  // namespace popup
