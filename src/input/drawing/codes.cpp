#include "input/drawing/codes.h"

#include <array>

namespace popup {
namespace {

constexpr std::array kDrawingCodes = std::to_array<CodeInfo>({
    {"bad-path", Severity::error, "path data that cannot be read",
     "The d of a path, or the points of a polygon or polyline, is not what SVG allows: a letter that is no "
     "command, a command without all its numbers, an arc's flag that is neither 0 nor 1, or a point with "
     "one coordinate. Browsers draw such a path up to the mistake; a cut must not end there. Correct the "
     "path, or draw it anew."},
    {"bad-reference", Severity::error, "a reference to what cannot be drawn",
     "A use element names something that is not in the drawing, is in another file, or holds the use "
     "itself. What it should have drawn would be missing from the sheets, or never come to an end. Correct "
     "the id, or take the element out; in Inkscape Edit > Clone > Unlink makes a plain shape of it."},
    {"bad-transform", Severity::error, "a transform that cannot be read",
     "A transform is a list of matrix, translate, scale, rotate, skewX and skewY, each with its numbers in "
     "brackets. This one has another word, or a wrong count of numbers, so it is not known where the "
     "shapes below it are. Correct it, or let a drawing program apply the transforms to the shapes."},
    {"clip-ignored", Severity::warning, "a clip path or a mask that is not applied",
     "The drawing hides parts of its shapes behind clip paths or masks. A cutter follows whole contours, "
     "so these shapes are cut as they are, hidden parts included. Intersect the shapes with what clips "
     "them, and take the clip paths out."},
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
    {"hidden-shape", Severity::remark, "shapes that are hidden",
     "Elements with display:none or visibility:hidden, such as layers that are switched off, are not cut. "
     "That is mostly what is meant. Show them in the drawing program, or take the properties out, if they "
     "are to be cut."},
    {"line-outside", Severity::warning, "an open line that lies outside of every part",
     "Lines that do not close are slits or folds of the part they lie in. This one lies in none, or not "
     "wholly, and what lies outside is left out. Often it is the side of an outline that does not close: "
     "the ends of lines must be within 0.02 mm of each other to be one corner. Join them, end the line at "
     "the outline, or take it out."},
    {"no-contours", Severity::error, "a drawing without any closed contour",
     "Parts are what closed contours enclose, and the drawing has no contour that closes. Perhaps its "
     "outlines have gaps of more than 0.02 mm at the corners, are texts that were not made into paths, are "
     "hidden, or have neither stroke nor fill. Close the outlines: in Inkscape by joining selected nodes."},
    {"not-cut", Severity::warning, "texts, images and the like in a drawing",
     "A text is not an outline until a font is chosen, and an image has none at all, so neither is cut or "
     "printed. Letters that are to be cut must be converted to paths (in Inkscape: Path > Object to Path), "
     "images traced. If they are only notes, accept this with --allow not-cut, or put them on a hidden "
     "layer."},
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
    {"size-in-pixels", Severity::remark, "a drawing whose size is in pixels",
     "Pixels are taken for 96 to the inch, as CSS has it. Programs have used 72 and 90 as well, so that "
     "parts may come out too small by a quarter. Compare the size in the message with what it should be, "
     "and set the document's units to millimetres if it is not."},
    {"size-missing", Severity::warning, "a drawing that does not say how large it is",
     "The drawing has no width and height with a length in them, only numbers without a unit. They are "
     "taken for pixels, 96 to the inch, but programs that export such drawings often mean points, 72 to "
     "the inch. Look at the size in the message. Write width and height with mm, export the drawing with "
     "its size, or use --scale."},
    {"style-ignored", Severity::warning, "style rules that are not understood",
     "Rules of style elements are read when they are for a tag, a class, an id, or a class of a tag. "
     "Others, such as those for elements inside of others, and conditions such as @media, are not. What "
     "they say of strokes, fills and hidden shapes may be missed. Let the drawing program write styles as "
     "attributes, or inline."},
});

}  // namespace

std::span<const CodeInfo> drawing_codes() { return kDrawingCodes; }

}  // namespace popup
