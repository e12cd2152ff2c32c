#include "input/xml/codes.h"

#include <array>

namespace popup {
namespace {

constexpr std::array kXmlCodes = std::to_array<CodeInfo>({
    {"bad-allow", Severity::warning, "a comment to popupc that is not understood",
     "A comment that begins with popupc: is meant for this program, and <!-- popupc: allow CODE, CODE: "
     "reason --> is the only one it knows. This one has another word, names no code, names one that does "
     "not exist, or one that is always an error, which nothing can allow. It has no effect as it is, so "
     "that findings may be told that it was meant to allow. Correct it, or take the word popupc: out of it."},
    {"bad-character", Severity::error, "a character that XML forbids",
     "The document holds a NUL byte, a control character, or a reference such as &#0; that stands for one. "
     "XML allows no control characters but tab and line breaks, so other programs will refuse the file as "
     "well. It has usually been damaged on its way or is not a text at all; take the character out, or "
     "export the document anew."},
    {"bad-choice", Severity::error, "a word that is not one of those a value can be",
     "Some values of elements are one word out of a few, like the side of a plate that is glued. The message "
     "names the words there are. Write one of them, in either case, or leave the value out where one of them "
     "holds without it."},
    {"bad-color", Severity::error, "a colour that cannot be read",
     "Colours are written #rrggbb. Also read are #rgb, three whole numbers r,g,b from 0 to 255, the colour "
     "names of CSS, and the signed 32-bit number that a Java program stores for a colour (-65536 is red; "
     "its transparency is disregarded, because paper has none). Write the colour in one of these ways, or "
     "leave the field out for bare paper."},
    {"bad-id", Severity::error, "an id that may not be used",
     "The id of a structure names its plates and pieces in every output, so it is kept simple: a letter or "
     "an underscore first, then letters, digits, underscores, full stops and hyphens. The id \"page\" is "
     "kept for the base page. Choose another id, or leave it out: the n-th structure is then called e "
     "followed by n."},
    {"bad-page", Severity::error, "a page number that cannot be read, or contradicts another",
     "Pages are counted by whole numbers: 0 is the base page, and each v-fold or tent adds one page for "
     "its own piece, numbered from 1 in the order of the list. All of a parent fold, and all of a drawn "
     "line, lies on one page; where a page is written more than once in it, the numbers must agree. "
     "Correct the number."},
    {"bad-point", Severity::error, "a point that is not two numbers",
     "A point has two coordinates, written as attributes x and y, as child elements of these names, or as "
     "the text x,y. A list of points written as text needs an even number of numbers, with commas or "
     "blanks between them; a decimal comma looks like one more number there. Write the missing number, or "
     "a decimal point for the comma."},
    {"bad-unit", Severity::error, "a unit that is not known",
     "The units of a document are in (inches, when nothing is said), mm, cm, pt or px, the last two both "
     "being a 72nd of an inch. Every length of the document is in that unit, but for the thickness of "
     "drawn lines, which is always in points. Name one of these units."},
    {"doctype", Severity::error, "a document type declaration",
     "The document has a DTD, or another declaration that begins with \"<!\". Popup documents need none, "
     "and entities that a DTD defines can be made to unfold into gigabytes or to read other files, so none "
     "is ever processed. Take the declaration out and write what its entities stand for."},
    {"duplicate-id", Severity::error, "two structures with the same id",
     "Every structure has an id of its own, because plates, pieces and glue tabs are named after it in "
     "every output. Two structures of this document were given the same one; the message names the line of "
     "the first. Rename one of them, or leave its id out."},
    {"duplicate-value", Severity::error, "a value that is given twice",
     "A value stands as an attribute, as a child element or as text, and it stands once. Here it is given "
     "a second time, perhaps in another spelling (names are compared without regard to case, hyphens and "
     "underscores), and it cannot be told which is meant. Take one of the two out. A text with a comment "
     "or CDATA in it counts as two."},
    {"empty-input", Severity::error, "a file with nothing in it",
     "The file is empty or holds nothing but blanks. It may have been cut off while it was copied or "
     "written, or the program before this one in a pipe has failed without a word; fetch it again from "
     "where it came from."},
    {"encoding", Severity::error, "a text that is not UTF-8",
     "Documents are read as UTF-8, of which plain ASCII is a part. This one declares another encoding, "
     "begins with the byte order mark of UTF-16 or UTF-32, or holds bytes that are no UTF-8. Save it as "
     "UTF-8, and let its first line say encoding=\"UTF-8\" or nothing at all."},
    {"ground-not-yet", Severity::error, "a structure names a fold or plate of one that comes later",
     "The list of structures is in build order: a structure comes before those that stand on it, and "
     "no structure stands on itself. This one names a fold or plate of itself, or of a structure that "
     "comes later. Move the other structure further up in the list. Pages are numbered by the order of "
     "glued elements, so when you move a glued element, check the page numbers too."},
    {"missing-value", Severity::error, "a value that must be given",
     "A structure needs its type, its outer points and a parentfold with a begin and an end; a point needs "
     "x and y; and a field that is written must not be empty. What is optional (ids, colours, the base "
     "page) may be left out altogether. Write the value, or take the empty field out."},
    {"newer-element", Severity::warning, "an element that the document's version does not have",
     "The document says it is of version 2.0, or says nothing, and uses an element that Popup Workshop did "
     "not have. It is read all the same. Write version=\"3.0\" at the root, so that other programs know "
     "what to expect."},
    {"page-size", Severity::error, "a base page of an impossible size",
     "The width and the height of the base page must be positive: at least 1 mm, and at most 10 m. The "
     "numbers are in the document's unit, which is inches when nothing is said; a size like 279 without "
     "units=\"mm\" is a page of seven metres. Correct the size or the unit; without either the page has 11 "
     "by 8.5 inches."},
    {"page-size-unlikely", Severity::warning, "a card as large as a table, or as small as a stamp",
     "The open card is longer than 1.2 m or shorter than 30 mm. Most often the document names no unit, "
     "so that its numbers are read as inches, or it names the wrong unit. The attribute units of "
     "<popup> sets the unit of all numbers; the hint names the unit that gives a card of a usual size. "
     "If the card is meant to have this size, allow this warning."},
    {"point-count", Severity::error, "too few or too many points",
     "Every type of structure has a fixed number of outer points in a fixed order, called by the letters "
     "in the message; the corners that follow from them are computed. A drawn line has at least two "
     "points. Add the missing points or take the doubled ones out; `popupc list elements` shows what each "
     "type takes."},
    {"slit-not-cut", Severity::warning, "a slit in an outline or a hole of a card's element",
     "A line of the path runs out and straight back, or is nothing but a line. It encloses no area, and what "
     "an element cuts are the edges of areas, so the slit is not on the sheet. Draw it as a hole or a notch "
     "of some width, such as 0.3 mm. In a drawing of flat parts slits are cut as they are."},
    {"unknown-ground", Severity::error, "a name that no fold or plate has",
     "A structure can name what it stands on: gutter, or the id of an earlier structure, a full stop "
     "and one of its folds, such as bird.centre; for a plate, page.left or bird.left. The message says "
     "whether the structure or its fold does not exist. `popupc show` lists the names of a card."},
    {"unknown-markup", Severity::warning, "an element, attribute or text that has no meaning",
     "The document holds markup that the reader does not know in that place, and disregards with all that "
     "is in it. Often it is a slip in a name, and then something that you meant is missing from the "
     "result. Correct the name, or take the markup out. With --strict this is an error."},
    {"unknown-type", Severity::error, "a structure of an unknown type",
     "The type of a structure is the name of an element, such as beak or inverted-step, or its number in "
     "Popup Workshop, from 0 to 8. Case, hyphens and underscores do not matter. `popupc list elements` "
     "shows all of them."},
    {"unknown-version", Severity::warning, "a document version that is not known",
     "Known versions of the popup document are 2.0, the one of the last Popup Workshop, and 3.0. The "
     "document names another, and is read as 2.0; what a later version has added would be reported as "
     "unknown. Correct the version, or see whether there is a newer popupc."},
    {"wrong-root", Severity::error, "an XML document of another kind",
     "The file is XML, but its outermost element is not the one that its language begins with: <popup> of "
     "a popup document, <svg> of a drawing. Perhaps it is another kind of file with a wrong name, or an "
     "output of this program in place of its input. Name the right file, or its language with --from."},
    {"xml-syntax", Severity::error, "a text that is not well-formed XML",
     "Tags must be closed in the order they were opened, values stand in quotes, no attribute stands twice "
     "in a tag, the characters < and & are written &lt; and &amp; in texts and values, and nesting is at "
     "most 100 deep. The place given is where reading could not go on; the mistake may lie before it. A "
     "document that ends inside an element has probably been cut off. Reading stops at the first such "
     "mistake, since what follows cannot be trusted."},
});

}  // namespace

std::span<const CodeInfo> xml_codes() { return kXmlCodes; }

}  // namespace popup
