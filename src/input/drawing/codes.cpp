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
     "A use element, or an INSERT of a DXF drawing, names something that is not in the drawing, is in "
     "another "
     "file, or holds the use itself. What it should have drawn would be missing from the sheets, or never "
     "come to an end. Correct "
     "the id, or take the element out; in Inkscape Edit > Clone > Unlink makes a plain shape of it."},
    {"bad-transform", Severity::error, "a transform that cannot be read",
     "A transform is a list of matrix, translate, scale, rotate, skewX and skewY, each with its numbers in "
     "brackets. This one has another word, or a wrong count of numbers, so it is not known where the "
     "shapes below it are. Its transform-origin is two lengths, or words such as left and top. Correct it, "
     "or let "
     "a drawing program apply the transforms to the shapes."},
    {"clip-ignored", Severity::warning, "a clip path or a mask that is not applied",
     "The drawing hides parts of its shapes behind clip paths or masks. A cutter follows whole contours, "
     "so these shapes are cut as they are, hidden parts included. Intersect the shapes with what clips "
     "them, and take the clip paths out."},
    {"color-not-read", Severity::warning, "strokes in a colour that is not understood",
     "Colours of strokes say what lines are. Read are the names of CSS, #rrggbb and shorter, rgb(), hsl() "
     "and "
     "hwb(), currentColor, which stands for the property color, and variables (var(--fold)) that the drawing "
     "sets. A variable that nothing sets, as it may be where a page around the drawing does, or a colour of "
     "another space such as lab() or color(), is not: its lines are taken for black ones, and black lines "
     "are cut where nothing else, such as a class, an id or --lines, says what they are. Write the colour in "
     "one of these ways, or let the drawing program export it with styles as attributes."},
    {"dashes-joined", Severity::remark, "dashed lines that were drawn in pieces",
     "Illustrator aligns dashes to the ends and corners of lines. In SVG the first and the last dash of such "
     "a "
     "line, or what goes round a corner, are then lines of their own, solid ones, a gap away from the rest. "
     "Short solid lines that go on where a dashed line of the same colour and width ends, one of its gaps "
     "away, and are no longer than its dashes, are taken for dashes of it. If they are cuts, give them "
     "another colour."},
    {"fill-not-printed", Severity::warning, "fills that are not printed",
     "Printed are fills in one colour. These are gradients or patterns, or in a colour that is not "
     "understood, "
     "such as lab(); their shapes are cut or not as all others are, but nothing is printed. Fill them with a "
     "colour that is written as #rrggbb, or place a picture on the design."},
    {"folds-as-cuts", Severity::warning, "lines that look like folds, and are cut",
     "The drawing has dashed lines, lines in the colours that folds often have (red, blue, magenta), or "
     "layers "
     "and classes called folds, and it is read as flat parts, where these are cuts: the sheet would fall "
     "apart along them. Dashed black lines are seams, which nothing folds. If the drawing is a pop-up card "
     "that is cut from one sheet, read it with --as card; if it is a carton, or another sheet that is "
     "folded, with --as folded. "
     "If they are folds of a flat part, say so by --lines, such as --lines valley=#0000ff,mountain=#ff0000; "
     "if they are cuts, say that: --lines cut=#0000ff."},
    {"hidden-shape", Severity::remark, "shapes that are hidden",
     "Elements with display:none or visibility:hidden, such as layers that are switched off, are not cut, "
     "nor "
     "those for other languages than English (systemLanguage) or for extensions of other programs, and "
     "neither is what DXF drawings have on layers that are off, frozen or not plotted, or in a layout. "
     "That is mostly what is meant. Show them in the drawing program, or take the properties out, if they "
     "are to be cut."},
    {"lines-not-found", Severity::remark, "a rule for lines that fits none of the drawing",
     "--lines, or lines in popupc.toml, says what lines of a colour mean, or of a layer, a class or an id "
     "with a "
     "word in its name; the first rule that fits a line counts. Nothing of this drawing is so, or an earlier "
     "rule has taken it all: the word may be spelt otherwise, or the colour be another shade. The hints "
     "have the names of layers, classes and groups, and the colours, that are there. Rules for a whole "
     "library need not fit each of its drawings."},
    {"machine-sheet", Severity::warning, "a sheet made for a machine, read back",
     "popupc has written this sheet with the profile of a machine. Its layers are called as the machine "
     "wants them, several kinds of lines may share one, folds may be broken into dashes or perforations, "
     "and cuts stand off by half a kerf. Read back, each line is what its stroke says, which most often is "
     "a cut. Read the design itself, or a sheet of the profile workshop, in which everything is as it was; "
     "or say by --lines what the layers mean."},
    {"not-cut", Severity::warning, "texts, images and the like in a drawing",
     "A text is not an outline until a font is chosen, and an image has none at all, so neither is cut or "
     "printed. Letters that are to be cut must be converted to paths (in Inkscape: Path > Object to Path; in "
     "AutoCAD: TXTEXP), "
     "images traced. If they are only notes, accept this with --allow not-cut, or put them on a hidden "
     "layer."},
    {"size-in-pixels", Severity::remark, "a drawing whose size is in pixels",
     "Pixels are taken for 96 to the inch, as CSS has it. Programs have used 72 and 90 as well, so that "
     "parts may come out too small by a quarter. Compare the size in the message with what it should be, "
     "and set the document's units to millimetres if it is not. Adobe Illustrator counts in points, 72 to "
     "the inch, and calls them pixels: its drawings have their size with --scale 1.333333."},
    {"size-missing", Severity::warning, "a drawing that does not say how large it is",
     "The drawing has no width and height with a length in them, only numbers without a unit. They are "
     "taken for pixels, 96 to the inch, but programs that export such drawings often mean points, 72 to "
     "the inch. Look at the size in the message. Write width and height with mm, export the drawing with "
     "its size, or use --scale."},
    {"style-ignored", Severity::warning, "style rules that are not understood",
     "Rules of style elements are read when they are for a tag, a class, an id, a class of a tag, or :root. "
     "Others, such as those for elements inside of others, and conditions such as @media, are not. What "
     "they say of strokes, fills and hidden shapes may be missed. Let the drawing program write styles as "
     "attributes, or inline. A style sheet in another file is not read at all, and neither is what moves "
     "shapes otherwise than a transform does, such as the properties rotate and translate. A value with a "
     "variable (var(--dashes)) that nothing sets, and that has no "
     "fallback, is left out, too, as browsers do."},
});

}  // namespace

std::span<const CodeInfo> drawing_codes() { return kDrawingCodes; }

}  // namespace popup
