#include "input/fold/codes.h"

#include <array>

namespace popup {
namespace {

constexpr std::array kFoldCodes = std::to_array<CodeInfo>({
    {"fold-angle-sign", Severity::warning, "a fold angle of a FOLD file that its assignment contradicts",
     "In FOLD the angle of a valley fold is positive and that of a mountain fold negative. The edge is "
     "assigned "
     "one way and its edges_foldAngle has the sign of the other. The assignment counts, with the size of the "
     "angle. Correct whichever of the two is wrong; programs that exchange front and back of the paper often "
     "exchange one of them only."},
    {"fold-frame", Severity::remark, "a FOLD file whose first frame is no crease pattern",
     "A FOLD file has one frame or several; the first is often the folded form, for viewers. popupc folds "
     "the "
     "flat sheet itself, so it reads the first frame whose corners lie in one plane, of equal z or "
     "equal y, and that is not called a "
     "foldedForm. The option --frame chooses a frame by its number: 0 is the file's own, 1 the first of "
     "file_frames."},
    {"fold-no-pattern", Severity::error, "a FOLD file without a crease pattern",
     "What is cut and folded is the flat sheet: corners in one plane (vertices_coords), and edges between "
     "them "
     "(edges_vertices, or faces_vertices, whose sides they are). This file, or the frame that --frame names, "
     "has folded forms only, or no corners or edges at all. Export the crease pattern from the program that "
     "made it."},
    {"fold-size", Severity::remark, "a crease pattern that does not say how large it is",
     "Most FOLD files have frame_unit \"unit\", or none: the numbers say the shape of the sheet, and not its "
     "size. popupc makes the longer side 200 mm long. Say how long a unit is with \"frame_unit\", one of mm, "
     "cm, m, in, pt, um and nm, and give the coordinates in it."},
    {"fold-syntax", Severity::error, "a FOLD file that is no JSON",
     "FOLD files are JSON texts. This one cannot be read as JSON from the place named on, or an object in it "
     "has two members of one name. Files that were cut off when they were copied end in the middle of a "
     "list. "
     "Export the file anew, or mend it there."},
    {"fold-value", Severity::error, "a value of a FOLD file that cannot be what it says",
     "The lists of a FOLD file go together: edges_vertices and faces_vertices name corners by their number "
     "in "
     "vertices_coords, from 0; edges_assignment and edges_foldAngle have one entry for each edge, a letter "
     "of "
     "B, C, M, V, U, F and J, and an angle in degrees. The message names the value that does not fit. A file "
     "that was edited by hand often has one entry too many or too few."},
    {"fold-version", Severity::remark, "a FOLD file of a version that popupc does not know",
     "The member file_spec of a FOLD file says which version of the format it keeps to. popupc knows 1, 1.1 "
     "and 1.2, and reads all files as the last of these: a list that a later version calls by another name, "
     "or "
     "in which numbers mean something else, is passed over or misread. Look at the sheet before you cut it."},
});

}  // namespace

std::span<const CodeInfo> fold_codes() { return kFoldCodes; }

}  // namespace popup
