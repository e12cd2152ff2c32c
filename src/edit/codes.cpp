#include "edit/codes.h"

#include <array>

namespace popup {
namespace {

constexpr std::array kEditCodes = std::to_array<CodeInfo>({
    {"bad-edit", Severity::error, "an edit that cannot be carried out",
     "The edit has an unknown verb, names a measure or value that the element does not have, gives a "
     "length that is not one, or asks for a shape that the element cannot have. The message says "
     "which, and what is possible. Nothing is written: popupc carries out all edits or none."},
    {"drawing-cut", Severity::remark, "a drawn silhouette that was cut off at its lower end",
     "`popupc edit card.xml outline ID --from FILE` stands a drawing on the seams of the piece. One "
     "with a straight lower edge stands on that. Of a round one the lowest part is cut off, at the first "
     "level that is half as wide as the drawing. A straight edge along its lower end keeps all of it. An "
     "edge "
     "or a corner that lies deeper than the seams is cut off where they are."},
    {"drawing-twice", Severity::remark, "a line that a drawing has twice",
     "`popupc edit card.xml outline ID --from FILE` takes what a drawing encloses. A line that lies on "
     "another one, all along, such as a copy left in its place, would take away what the first encloses. "
     "It is taken once."},
    {"edit-refused", Severity::error, "an edit that would break the card or carton",
     "popupc checks the document that the edits make. It would have an error that it does not have now; "
     "another message names that error. Nothing is written. Often "
     "something stands on the element that was moved: --follow takes it along. --force writes the "
     "document all the same. An edit of a folded sheet is refused where a panel would have to bend, would "
     "have no area, would turn over or lie over another one on the sheet, where what met would not meet "
     "again, where a glue flap would not lie on its panel, and where an element of the drawing cannot be "
     "written anew; --force does not help then. Where panels would pass through each other that did not, it "
     "does."},
    {"folds-turn", Severity::remark, "an edited carton whose folds have other angles",
     "`popupc edit box.svg` has moved a vertex or an edge of a folded shape so that folds go further, or "
     "less far, than the drawing said: a slanted wall stands at no right angle. The sheet is that of the "
     "shape, and closes with the angles that popupc found. The drawing says them with data-fold-angle, which "
     "other programs pass over. An element has one for each of its straight sides, and a path is parted "
     "where one side has folds of different angles; where that is too few, or an element is drawn elsewhere "
     "than it stands, another remark tells it. "
     "`--fold-angle` counts before what drawings say: leave it out then."},
    {"no-such-element", Severity::error, "an id that no element has",
     "An edit, or `popupc show`, names an element by its id, and no element has that id. An element "
     "without an id is called e and its number in the list, counted from 1. `popupc show` lists all "
     "ids."},
    {"page-outgrown", Severity::remark, "an edited drawing that is larger than its page",
     "`popupc edit box.svg` enlarges the page with the drawing where the picture has a width, a height and a "
     "viewBox of one scale. This one has not, so that programs may show only a part of it. popupc reads "
     "all."},
});

}  // namespace

std::span<const CodeInfo> edit_codes() { return kEditCodes; }

}  // namespace popup
