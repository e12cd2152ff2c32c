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
     "eight million altogether; or a text of more than 2000 bytes, or pictures of more than 256 MiB. The "
     "limits keep hostile documents from filling the memory. Split the "
     "design into several documents."},
    {"holes-overlap", Severity::warning, "two holes of a part that overlap partly",
     "Two contours within one part have an area in common though neither lies in the other. The paper that "
     "is left is what both leave, and the outline of that is cut. Unite the two contours if one opening is "
     "meant, or move them apart if they are two."},
    {"no-design", Severity::error, "an input that is not the design of a card",
     "The input is a drawing of flat parts, or an assembly. What was asked for needs the design of a pop-up "
     "card, which these do not have. Give it to popupc build for sheets (.svg, .pdf) or the report "
     "(.json), or name a popup document."},
    {"outline-unreadable", Severity::error, "an outline out of a file that cannot be used",
     "The href of an outline or a hole names an SVG drawing, whose closed lines are taken. This file cannot "
     "be "
     "read as one, has no closed line, or has several shapes where an outline is a single one. The message "
     "says where in the drawing the trouble is. \"popupc trace --largest\" makes such a drawing of a "
     "picture."},
    {"picture-missing", Severity::error, "a picture whose file is not there",
     "An image of the document names a file that does not exist. Names are looked for from the folder in "
     "which the document lies (of standard input: from the working directory), and capital letters are not "
     "small ones there, even where the computer on which the card was drawn took them for the same. Put the "
     "file where the document says, or correct href."},
    {"picture-outside", Severity::error, "a picture that is not below the folder of the document",
     "Pictures are files below the folder of their document. An absolute path, a name that \"..\" leads out, "
     "a URL, and a symbolic link that ends elsewhere are never followed, so that a document from somewhere "
     "else can neither read other files of yours nor tell anybody that it was opened. Copy the picture into "
     "the folder and name it from there."},
    {"picture-unreadable", Severity::error, "a picture that cannot be used",
     "The file that an image names is a directory or a device, cannot be read, is neither a PNG nor a JPEG, "
     "ends early or is broken, has printers' colours (CMYK), or has more than 64 million pixels or 64 MB. "
     "Pictures are decoded to the end before anything is made of them, for half a picture would be found "
     "only on the printed sheet. Export it anew from the program that made it."},
    {"unknown-language", Severity::error, "an input whose language is not known",
     "The language of an input is told by the suffix of its name. This name has none that is known, or it "
     "is standard input, which has no suffix. Rename the file, or name the language with --from; `popupc "
     "list languages` shows all of them."},
    {"unknown-member", Severity::warning, "a member of a JSON input that has no meaning",
     "The object has a member that popupc does not know, so it is not read. Mostly its name is misspelt, or "
     "it comes from a later version of the format. Correct the name or take the member out; --strict makes "
     "this an error."},
});

}  // namespace

std::span<const CodeInfo> input_codes() { return kInputCodes; }

}  // namespace popup
