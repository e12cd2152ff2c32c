#include "parts/codes.h"

#include <array>

namespace popup {
namespace {

constexpr std::array kPartsCodes = std::to_array<CodeInfo>({
    {"contour-crosses-itself", Severity::warning, "a contour that crosses itself",
     "The path of a contour runs across itself, so what it encloses can be understood in several ways. All "
     "that it goes round was taken for inside, and the outline of that is cut. Mostly this is a slip of a "
     "node, or a loop that an offset has left. Draw the outline without the crossing."},
    {"contours-overlap", Severity::error, "two contours that overlap partly",
     "Neither contour lies in the other, but they have an area in common. If they are two parts they "
     "cannot both be cut from one sheet as they are drawn, and if they are one part its outline is not "
     "drawn. Move the parts apart, or unite the contours, or subtract one from the other. Contours that "
     "only touch, or overlap by a hundredth of a millimetre, are two parts."},
    {"doubled-line", Severity::remark, "lines that are drawn twice",
     "Some lines lie exactly on others: a contour that is drawn once for its stroke and once for its fill, "
     "or an edge that two parts share in the drawing. A cutter would go over them twice and burn or fray "
     "the edge, so each is cut once. There is nothing to do, but the drawing is tidier without them."},
    {"line-outside", Severity::warning, "an open line that lies outside of every part",
     "Lines that do not close are slits or folds of the part they lie in. This one lies in none, or not "
     "wholly, and what lies outside is left out. Often it is the side of an outline that does not close: "
     "the ends of lines must be within 0.02 mm of each other to be one corner. Join them, end the line at "
     "the outline, or take it out."},
    {"no-contours", Severity::error, "a drawing without any closed contour",
     "Parts are what closed contours enclose, and the drawing has no contour that closes. Perhaps its "
     "outlines have gaps of more than 0.02 mm at the corners, are texts that were not made into paths, are "
     "hidden, or have neither stroke nor fill. Close the outlines: in Inkscape by joining selected nodes."},
    {"page-frame", Severity::remark, "a contour as large as the page that holds all else",
     "The outermost contour has the size of the drawing's page, and everything lies in it, so the whole "
     "drawing is one part. If it is a frame, the edge of the sheet or of the picture, take it out: then "
     "what lies in it are parts, and can be placed anew."},
    {"part-divided", Severity::warning, "a cut that divides a part",
     "An open cut runs from a part's edge to the same edge. Each outermost contour is one part, and is "
     "placed as one, but this one will come off the machine in two pieces. If they are meant to be two "
     "parts that share an edge, draw each as a closed contour of its own."},
    {"shape-outside", Severity::warning, "a painted shape that is not cut",
     "In a drawing that has stroked contours, these are what is cut, and shapes that have a fill and no "
     "stroke are printed on the parts they lie on. This one lies on none. Give it a stroke if it is a "
     "part, or take it out. In a drawing without any stroked contour the painted shapes are the parts."},
});

}  // namespace

std::span<const CodeInfo> parts_codes() { return kPartsCodes; }

}  // namespace popup
