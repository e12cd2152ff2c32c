#include "input/dxf/codes.h"

#include <array>

namespace popup {
namespace {

constexpr std::array kDxfCodes = std::to_array<CodeInfo>({
    {"dxf-binary", Severity::error, "a drawing of AutoCAD that is not ASCII DXF",
     "popupc reads DXF as text, of any version from R12 to 2018. This file is a binary DXF, a DWG, or a text "
     "in "
     "UTF-16. Save it as ASCII DXF from the program that made it; in AutoCAD that is \"Save as\" with the "
     "type "
     "DXF. For DWG files there are dwg2dxf of LibreDWG, QCAD and the ODA File Converter."},
    {"dxf-curve", Severity::error, "a curve of a DXF file that cannot be drawn",
     "A circle or an arc has a radius below zero, or the numbers of a spline do not go together: a "
     "spline of degree n with m control points has m + n + 1 knots that never go back, and as many weights "
     "as "
     "controls, all above zero, if it has any. A cut must not end there. Draw the curve anew, or explode it "
     "to "
     "polylines in the program that made it."},
    {"dxf-no-end", Severity::warning, "a DXF file without its end",
     "A DXF file ends with 0 and EOF. This one ends earlier, though behind a whole section. Files that were "
     "cut "
     "off when they were copied look like this, and so do those of simple programs. Compare what was read "
     "with "
     "the drawing; export it anew if something is missing."},
    {"dxf-size", Severity::warning, "a DXF drawing that is larger than five metres",
     "The file says its unit in $INSUNITS, and with it the drawing is larger than anything that is cut from "
     "board. Several programs write metres or inches, whatever the drawing is in. Set the unit to "
     "millimetres "
     "where the drawing was made (UNITS in AutoCAD), or use --scale: 0.001 for metres that are millimetres, "
     "0.03937 for inches that are."},
    {"dxf-syntax", Severity::error, "a DXF file that cannot be read",
     "A DXF file is pairs of lines: a group code, which is a whole number, and a value. Its sections begin "
     "with "
     "0 and SECTION and end with 0 and ENDSEC. From the line named on, this file is not like that, or it "
     "ends "
     "in the middle of a section. Files that were cut off when they were copied, and files that are no DXF "
     "at "
     "all, are the common cases. Export the file anew."},
    {"dxf-unit", Severity::remark, "a DXF drawing that does not say its unit",
     "DXF files say what a unit of their numbers is with $INSUNITS. This one does not, as files of R12 and "
     "of "
     "simple programs. It is taken for inches where $MEASUREMENT is 0, and else for millimetres. Look at the "
     "size in the message. Set the units in the program that made it (UNITS in AutoCAD), or use --scale, "
     "such "
     "as --scale 25.4 for inches."},
});

}  // namespace

std::span<const CodeInfo> dxf_codes() { return kDxfCodes; }

}  // namespace popup
