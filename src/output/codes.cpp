#include "output/codes.h"

#include <array>

namespace popup {
namespace {

constexpr std::array kOutputCodes = std::to_array<CodeInfo>({
    {"fold-left-out", Severity::remark, "the FOLD file lacks something of the file that was read",
     "What a FOLD file says beside its crease pattern is written back: titles, authors, keys that popupc "
     "does "
     "not know, and lists with a value for each vertex, edge or face, whose values go to the elements in the "
     "same place. Not written are the file's other frames, which popupc's own folded frames take the place "
     "of; "
     "edgeOrders, lists with another number of values, and, where faces were divided or joined or --flat has "
     "found an order, faceOrders, because they speak of elements by numbers that have changed; and, where "
     "several designs go into one file, all keys, because they would "
     "speak of the others too. Write each design into a file of its own, or copy what is missing."},
    {"backs-to-mark", Severity::remark, "sheets have backs that are to be marked before the fronts are cut",
     "A piece that is glued flat has no tab for its number. The number is marked on its back, where the glue "
     "covers it. What is glued to the back of a plate has its place marked there. Such sheets have a "
     "mirrored "
     "back, drawn as the sheet is seen when it is turned over from left to right: a second file whose name "
     "ends "
     "in -back, in PDF the page after the front. Mark it first, then turn the sheet over and cut the front. "
     "--marks-on front marks the numbers where they are seen; --marks-on none leaves all marks out."},
    {"font-missing", Severity::error, "the font of the labels cannot be read",
     "A PDF carries the font of its labels with it, and that font is read from one known file, DejaVu "
     "Sans, so that sheets look the same on every machine. The file named in the message is not there, may "
     "not be read, or is no font. Nothing has been written. Install the font where the message says (on "
     "Debian the package fonts-dejavu-core brings it), or write SVG, which only names the font."},
    {"glue-marks-left-out", Severity::remark, "the sheets do not say what is glued where",
     "Profiles of lasers and cutters do not print; they mark the places of tabs and the numbers of tabs and "
     "places with a pen of their own, \"mark\". By default only what is covered later is marked: places "
     "under glued tabs, and the backs of pieces that are glued flat. Here something that the "
     "gluing needs is neither printed nor marked. What is glued to the back of a plate has its target there, "
     "and "
     "only sheets with backs show it: --sides both prints them, --marks-on back marks them. Else take "
     "--marks-on front, which marks all of it on the front, "
     "or --marks-on back; give the pen \"mark\" a layer in a profile of your own; or print sheets by the "
     "profile workshop as well and glue by them."},
    {"legend-left-out", Severity::warning, "a sheet has no room for its legend",
     "With --legend always each sheet says what its lines mean, in space that no piece lies on. On the "
     "sheets "
     "in the message no place is large enough. Choose a larger sheet, or leave --legend away: then sheets "
     "with room have a legend, and others none."},
    {"model-coarse", Severity::warning, "the model's animation has fewer keys than it needs",
     "Between two keys of the animation a viewer turns every plate on its own, and keys are added until no "
     "fold visibly opens on the way. Here the file would have grown beyond half a gigabyte first. The "
     "model is right at every key and a little open between some. Write fewer designs into one model; "
     "pages many metres wide also cause this, so check the document's units."},
    {"model-too-large", Severity::error, "the model has more data than its file format holds",
     "Every plate has a turn at every key of the animation, and together with the shapes they must stay "
     "below two gigabytes, and a page to look at (.html) below 400 megabytes with its pictures. Ask for "
     "fewer angles or fewer keys a second, or write the designs into several models."},
    {"pdf-failed", Severity::error, "the PDF library gave up",
     "The library that makes PDF documents reported the error in the message, for example that memory ran "
     "out or that the font of the labels is damaged. Nothing has been written. Reinstall the font, or "
     "write SVG instead and print that; both show the same drawing."},
    {"pdf-page-size", Severity::error, "a sheet is larger than a PDF page can be",
     "A page of a PDF has at most 14400 points a side, which is 5080 mm; programs that read PDF refuse or "
     "shrink larger ones, and a sheet that is shrunk is useless. Choose a smaller sheet with --sheet, so "
     "that the pieces are spread over several pages, or write SVG, which has no such limit."},
    {"picture-failed", Severity::error, "a picture could not be made",
     "The library that makes pictures gave up: there was no memory for so many pixels. Choose a smaller "
     "--dpi or a smaller --sheet, or write a format that is not made of pixels, such as SVG or PDF."},
    {"picture-too-large", Severity::error, "a picture has too many pixels",
     "A picture of a sheet has at most 32767 pixels on a side and 300 million in all, a view of the model "
     "100 "
     "million, and a moving picture 400 million from the first picture to the last; a WebP has at most 16383 "
     "pixels on a side. More would take gigabytes of memory. Of sheets choose a smaller --dpi or --sheet, of "
     "the "
     "model a smaller --size, and of moving pictures a smaller --fps or --duration."},
    {"plotter-range", Severity::remark, "a sheet is larger than what old plotters count to",
     "HP-GL counts in units of 0.025 mm, and the plotters it was made for count no further than 32767, "
     "which is 819 mm. Most machines of today take larger numbers; one that does not stops there, or draws "
     "in the wrong place. Plot the sheet once with the pen or the knife up, or choose a smaller sheet with "
     "--sheet."},
    {"prints-left-out", Severity::remark, "the machine profile or the format leaves out what is printed",
     "Profiles of lasers and cutters leave out what is printed, so that no machine burns it: pictures, "
     "printed texts, registration marks, the bar to measure, and all that is on printed backs. The colours "
     "of plates and drawn lines are left out, too, but of them nothing is said. --print-and-cut writes all "
     "of it to files of its own, which are for a printer; a profile of your own can give the pens of what is "
     "printed a layer. .dxf, .lbrn2 and .plt hold lines: whatever the profile, they have no pictures, nor "
     "the "
     "colours of areas. Write .svg, .pdf or .png beside them."},
    {"reference-too-long", Severity::error, "the bar to measure does not fit on the sheet",
     "--reference draws a bar of a known length below the pieces, with its figure beside it and clear of "
     "registration marks. The sheet is too narrow for a bar of this length. Ask for a shorter one, or "
     "choose a wider --sheet."},
    {"tile-too-small", Severity::error, "the paper of --tile has too little room inside its margins",
     "Each page shows its part of the sheet inside the free edge that --tile-margin gives. Marks and labels "
     "are in the inner 5 mm of that edge, so it is at least as wide. Neighbouring pages both show a strip of "
     "5 mm, where they are glued; so that there is more to a page than its strips, 30 mm must be left both "
     "ways. Choose a larger paper, or a margin that fits."},
    {"tiles-impossible", Severity::error, "what is asked for needs its sheet in one piece",
     "With --tile a sheet is printed on several pages, which are glued together before anything is cut. "
     "Machines and print shops take sheets in one piece, so --print-and-cut, profiles of machines and spot "
     "colours do not go with it. Printed backs do not either: where pages are glued, the margin of one "
     "covers the back of the other. The message says which of these was asked for; leave it out, or leave "
     "out --tile."},
    {"time-unknown", Severity::remark, "the report does not say how long the machine takes",
     "The report of a build has a time when the profile or --speed says how fast everything goes that the "
     "machine does: each kind of line that it follows, and the way between lines, which --speed calls "
     "travel. "
     "The message names what is missing."},
    {"too-few-joints", Severity::warning, "a piece would fall out of its sheet",
     "With --joints the outer cut of each piece is left uncut at two places or more, so that the piece stays "
     "in its sheet. A joint lies on a straight stretch, at least half a millimetre from corners and from "
     "folds. The piece in the message is too small, or its outline too uneven, for two of this width. Ask "
     "for "
     "narrower joints, or hold the sheet down so that small pieces cannot move."},
    {"too-many-tiles", Severity::error, "the sheets need more pages than a document may have",
     "A document has at most 10000 tiles, counting those on which nothing is drawn. Nobody glues so many "
     "pages together: check the units of the design and --scale, or choose a larger paper with --tile."},
    {"view-beyond", Severity::remark, "a view at an opening that no card reaches",
     "--at asks for a picture at an opening that no card of the run reaches: a page may have opens=\"90\", "
     "and "
     "--opens limits all. The picture shows the cards as far as they open. Leave the opening out of --at, or "
     "let them open further."},
});

}  // namespace

std::span<const CodeInfo> output_codes() { return kOutputCodes; }

}  // namespace popup
