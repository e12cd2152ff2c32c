// Every diagnostic code, with the paragraph that `popupc explain` prints. Sorted by code; a test keeps it so.
// Those of programs stand in program_codes.cpp.
#include <algorithm>
#include <array>
#include <iterator>
#include <vector>

#include "base/diagnostics/program_codes.h"
#include "popup/diagnostics.h"

namespace popup {
namespace {

constexpr std::array kCodes = std::to_array<CodeInfo>({
    {"apex-off-fold", Severity::warning, "an apex lies beside its parent fold",
     "The folds of a beak, an angled step or a v-fold meet in one point, and that point must lie on the fold "
     "the element stands on: only then do its sides stay the same length while the card moves. The apex was "
     "moved onto the fold, the shortest way. Choose it on the fold to begin with."},
    {"bad-allow", Severity::warning, "a comment to popupc that is not understood",
     "A comment that begins with popupc: is meant for this program, and <!-- popupc: allow CODE, CODE: "
     "reason "
     "--> is the only one it knows. This one has another word, names no code, names one that does not exist, "
     "or one that is always an error, which nothing can allow. It has no effect as it is, so that findings "
     "may be told that it was meant to allow. Correct it, or take the word popupc: out of it."},
    {"bad-baseline", Severity::error, "a baseline that cannot be read",
     "The file that --baseline names is not a list of accepted findings as --write-baseline makes it. A "
     "baseline is a JSON file with a finding on each line: its file, code, element, digest and count. "
     "Nothing is checked against a broken one, since findings would fail, or pass, for no reason. Mend the "
     "line, which a merge of two branches may have broken, or take the file away and write it anew."},
    {"bad-character", Severity::error, "a character that XML forbids",
     "The document holds a NUL byte, a control character, or a reference such as &#0; that stands for one. "
     "XML allows no control characters but tab and line breaks, so other programs will refuse the file as "
     "well. It has usually been damaged on its way or is not a text at all; take the character out, or "
     "export the document anew."},
    {"bad-choice", Severity::error, "a word that is not one of those a value can be",
     "Some values of elements are one word out of a few, like the side of a plate that is glued. The message "
     "names the words there are."},
    {"bad-color", Severity::error, "a colour that cannot be read",
     "Colours are written #rrggbb. Also read are #rgb, three whole numbers r,g,b from 0 to 255, the colour "
     "names of CSS, and the signed 32-bit number that a Java program stores for a colour (-65536 is red; its "
     "transparency is disregarded, because paper has none). Write the colour in one of these ways, or leave "
     "the field out for bare paper."},
    {"bad-config", Severity::error, "a configuration is not what it should be",
     "A popupc.toml has the long names of options as keys: at its top for every verb that has the option, in "
     "a "
     "table such as [build] for that verb alone. Flags are true or false, repeatable options lists, and all "
     "else is written as on the command line. A key that no verb has is refused, so that a slip of the pen "
     "is "
     "not a setting that is silently not made; so are options that belong to one run, such as output. "
     "\"popupc check --print-config\" shows what is set, and where."},
    {"bad-id", Severity::error, "an id that may not be used",
     "The id of a structure names its plates and pieces in every output, so it is kept simple: a letter or "
     "an underscore first, then letters, digits, underscores, full stops and hyphens. The id \"page\" is "
     "kept for the base page. Choose another id, or leave it out: the n-th structure is then called e "
     "followed by n."},
    {"bad-job", Severity::error, "a job of a batch that cannot be run as it is written",
     "The words that a row of the manifest makes of its inputs, outputs, options and copies are no build: "
     "an option is not known, an output has a suffix that names no format, or the job asks for standard "
     "input or output, which batches do not have. The job is not done; the others are. Mend the row, then "
     "run the batch again: only what is missing is done."},
    {"bad-manifest", Severity::error, "a row of a manifest that is no job",
     "The list of a batch's jobs is read whole before any job begins. Each row needs at least one input "
     "and one output; a row of JSON lines is an object with the keys input, output, options and copies, a "
     "row of CSV has these columns. No two jobs may write the same file, and none may read what another "
     "writes, because jobs have no order. Mend the row at the place given."},
    {"bad-number", Severity::error, "a number that cannot be read, or is out of range",
     "Numbers are decimal, with a full stop before the decimals and an optional exponent: 1.5, -0.25, 1e-3. "
     "Hexadecimal numbers, decimal commas, NaN and infinity are not read, and coordinates further than a "
     "million millimetres from the middle of the page are taken for mistakes, as are lines thicker than 1000 "
     "points or thinner than none. Correct the number, or the unit of the document."},
    {"bad-page", Severity::error, "a page number that cannot be read, or contradicts another",
     "Pages are counted by whole numbers: 0 is the base page, and each v-fold or tent adds one page for its "
     "own piece, numbered from 1 in the order of the list. All of a parent fold, and all of a drawn line, "
     "lies on one page; where a page is written more than once in it, the numbers must agree. Correct the "
     "number."},
    {"bad-path", Severity::error, "path data that cannot be read",
     "The d of a path, or the points of a polygon or polyline, is not what SVG allows: a letter that is no "
     "command, a command without all its numbers, an arc's flag that is neither 0 nor 1, or a point with "
     "one coordinate. Browsers draw such a path up to the mistake; a cut must not end there. Correct the "
     "path, or draw it anew."},
    {"bad-point", Severity::error, "a point that is not two numbers",
     "A point has two coordinates, written as attributes x and y, as child elements of these names, or as "
     "the text x,y. A list of points written as text needs an even number of numbers, with commas or blanks "
     "between them; a decimal comma looks like one more number there. Write the missing number, or a decimal "
     "point for the comma."},
    {"bad-profile", Severity::error, "a profile's file is not what it should be",
     "A profile of your own is a TOML file with the keys name, about, base, folds, one-sided, styled-paths, "
     "and the "
     "tables perforation and pens; \"man popupc\" says what each takes. A key that is not known is refused, "
     "so "
     "that a slip of the pen does not end in a wrong colour on a machine."},
    {"bad-reference", Severity::error, "a reference to what cannot be drawn",
     "A use element names something that is not in the drawing, is in another file, or holds the use "
     "itself. What it should have drawn would be missing from the sheets, or never come to an end. Correct "
     "the id, or take the element out; in Inkscape Edit > Clone > Unlink makes a plain shape of it."},
    {"bad-response-file", Severity::error, "a file of arguments cannot be read",
     "An argument @FILE stands for the words of FILE, with blanks or line breaks between them. Quotes keep "
     "the "
     "blanks of a word together and must be closed; a backslash takes away the meaning of the character "
     "after "
     "it. Files may name other files, but not one that names them. To name an input that begins with @, "
     "write "
     "./ before it."},
    {"bad-transform", Severity::error, "a transform that cannot be read",
     "A transform is a list of matrix, translate, scale, rotate, skewX and skewY, each with its numbers in "
     "brackets. This one has another word, or a wrong count of numbers, so it is not known where the "
     "shapes below it are. Correct it, or let a drawing program apply the transforms to the shapes."},
    {"bad-unit", Severity::error, "a unit that is not known",
     "The units of a document are in (inches, when nothing is said), mm, cm, pt or px, the last two both "
     "being a 72nd of an inch. Every length of the document is in that unit, but for the thickness of drawn "
     "lines, which is always in points. Name one of these units."},
    {"baseline-outdated", Severity::remark, "accepted findings that are no longer there",
     "The baseline accepts findings that did not occur in the designs that were checked: they have been "
     "mended, or changed so that they count as new. Nothing is wrong, but an entry that is left would "
     "accept the same mistake if it were made again. Run the check with --write-baseline to take them out; "
     "entries of designs that were not checked stay."},
    {"clearance-low", Severity::warning, "two plates come closer than was asked for",
     "With --clearance LENGTH the examination names plates that come closer to each other than that length "
     "without crossing. Plates that share a fold, a seam or a corner are not meant, nor those that are only "
     "brought together by folding flat, below 45°. The message gives the smallest distance, and the angle "
     "where it is reached. Real paper is thick, bends, and is cut and glued a little off, so that such "
     "plates may rub or catch. "
     "Move the elements further apart, make one of them smaller, or ask for less."},
    {"clip-ignored", Severity::warning, "a clip path or a mask that is not applied",
     "The drawing hides parts of its shapes behind clip paths or masks. A cutter follows whole contours, "
     "so these shapes are cut as they are, hidden parts included. Intersect the shapes with what clips "
     "them, and take the clip paths out."},
    {"collision", Severity::warning, "two plates go through each other",
     "At some opening angle two plates would need the same room. This is looked for at every angle between "
     "the smallest one looked at and 180°, by bounds on how far plates can move, not at samples. Plates "
     "cross where a common point of both lies more than 0.01 mm inside the edges of both, and the paper "
     "round it stands out of the other plate on either side; plates that only touch, along folds, seams, "
     "corners "
     "and edges or flat on one another, do not. The message gives the first and last angle, and how far "
     "one goes through the other. Real paper would bend, catch or tear there. Move one of the "
     "elements as the hint says, or make one of them smaller."},
    {"config-ignored", Severity::remark, "a popupc.toml that this run does not look at",
     "A run has one configuration, and of a directory that is walked it is found from that directory upward. "
     "This one lies below it, so its settings do not hold for the designs beside it, as they would if these "
     "were checked alone. Check its directory in a run of its own, or name one configuration for all with "
     "--config, or take the file away."},
    {"contour-crosses-itself", Severity::warning, "a contour that crosses itself",
     "The path of a contour runs across itself, so what it encloses can be understood in several ways. All "
     "that it goes round was taken for inside, and the outline of that is cut. Mostly this is a slip of a "
     "node, or a loop that an offset has left. Draw the outline without the crossing."},
    {"contours-overlap", Severity::error, "two contours that overlap partly",
     "Neither contour lies in the other, but they have an area in common. If they are two parts they "
     "cannot both be cut from one sheet as they are drawn, and if they are one part its outline is not "
     "drawn. Move the parts apart, or unite the contours, or subtract one from the other. Contours that "
     "only touch, or overlap by a hundredth of a millimetre, are two parts."},
    {"cut-on-seam", Severity::error, "a 90° element stands on a glued seam",
     "Steps, beaks and angled steps are cut across the fold they stand on. A seam is two pieces of paper "
     "glued together, so the cut would go through the glue and part what holds the design together. Stand a "
     "tent or a v-fold on the seam instead, or cut a fold of the piece."},
    {"degenerate", Severity::error, "an element is too small to fold",
     "A seam, side fold or width is under 1 mm, or an angle under 1°. No paper folds that small, and small "
     "errors of the knife would decide how it moves. Give the element room; where a point lies on the wrong "
     "side of the fold, move it over. With `popupc fix --drop` such elements are taken out instead."},
    {"dependency-name", Severity::warning, "a name that ninja does not read in a dependency file",
     "A dependency file names the inputs and outputs of a build as makefiles write names. GNU make reads "
     "this "
     "one, but ninja knows fewer characters and ways to protect them, and takes it for another name or for "
     "several: it would build again every time, or miss a change. Rename the file; letters, digits, blanks "
     "and most marks are no trouble. Where only make reads the dependency file, allow this warning."},
    {"doctype", Severity::error, "a document type declaration",
     "The document has a DTD, or another declaration that begins with \"<!\". Popup documents need none, and "
     "entities that a DTD defines can be made to unfold into gigabytes or to read other files, so none is "
     "ever processed. Take the declaration out and write what its entities stand for."},
    {"document-too-large", Severity::error, "more markup than is read",
     "The document has more markup than any design that could be made of paper: over 250 000 structures or "
     "lines, a million points, a million elements, attributes and texts in a single structure or line, or "
     "eight million altogether. The limits keep hostile documents from filling the memory. Split the design "
     "into several documents."},
    {"does-not-fit", Severity::warning, "an element is larger than the paper it stands on",
     "Each half of a cut element must lie wholly in its own plane, with 1 mm of paper left around it and no "
     "earlier seam under it; each seam of a glued element must lie wholly on one plane. The element was "
     "pulled towards its fold, or shortened along it, until it fits. Where even the smallest form finds no "
     "room it is an error. Make the element smaller or move it."},
    {"doubled-line", Severity::remark, "lines that are drawn twice",
     "Some lines lie exactly on others: a contour that is drawn once for its stroke and once for its fill, "
     "or an edge that two parts share in the drawing. A cutter would go over them twice and burn or fray "
     "the edge, so each is cut once. There is nothing to do, but the drawing is tidier without them."},
    {"dropped", Severity::warning, "an element was taken out",
     "With --drop, elements that are too small to fold are taken out of the document, and with them "
     "everything that stands on them; pages of pieces that went are closed up. The document before is "
     "unchanged unless it is written over."},
    {"duplicate-id", Severity::error, "two structures with the same id",
     "Every structure has an id of its own, because plates, pieces and glue tabs are named after it in every "
     "output. Two structures of this document were given the same one; the message names the line of the "
     "first. Rename one of them, or leave its id out."},
    {"duplicate-value", Severity::error, "a value that is given twice",
     "A value stands as an attribute, as a child element or as text, and it stands once. Here it is given a "
     "second time, perhaps in another spelling (names are compared without regard to case, hyphens and "
     "underscores), and it cannot be told which is meant. Take one of the two out."},
    {"empty-input", Severity::error, "a file with nothing in it",
     "The file is empty or holds nothing but blanks. It may have been cut off while it was copied or "
     "written, or the program before this one in a pipe has failed without a word; fetch it again from where "
     "it came from."},
    {"encoding", Severity::error, "a text that is not UTF-8",
     "Documents are read as UTF-8, of which plain ASCII is a part. This one declares another encoding, "
     "begins with the byte order mark of UTF-16 or UTF-32, or holds bytes that are no UTF-8. Save it as "
     "UTF-8, and let its first line say encoding=\"UTF-8\" or nothing at all."},
    {"fix-unsettled", Severity::error, "repairs that undo one another",
     "Each repair is the least change that mends one thing, and what it moves is looked at again. Here the "
     "repaired document was read again several times and still had something to repair, or had become one "
     "that cannot be made: two constraints pull the same points in different directions, most often because "
     "an element is too large for the fold it stands on. Nothing has been written. Make the elements that "
     "the warnings name smaller, or move them, and run fix again."},
    {"fold-cut-away", Severity::error, "the parent fold has been cut away where the element stands",
     "A 90° element takes away the stretch of its parent fold that lies between its cuts; what remains there "
     "are its own side folds and centre fold. An element that comes later in the list can stand on those, or "
     "beside them, but not on the fold that is gone. Its parent fold may lie on the same line as the old "
     "one: then only the place along it counts."},
    {"fold-not-found", Severity::error, "there is no fold where an element should stand",
     "A structure names its parent fold by two points of it. No fold or seam of the page or of an earlier "
     "structure lies within 5 mm of that line beside the element. The list is in build order, parents first, "
     "and the points are in the coordinates of the page given. The message names the nearest fold and its "
     "distance."},
    {"fold-snapped", Severity::warning, "the parent fold was given a little beside the real one",
     "The two points given for the parent fold lie up to 5 mm beside a fold or seam, so that one is meant. "
     "The element's own points stay where they are; its parent fold now runs along the real fold."},
    {"fold-too-short", Severity::error, "an element's apex lies beyond the end of its fold",
     "The apex of a beak, angled step or v-fold must lie on the stretch of the parent fold that is still "
     "there; earlier elements may have cut part of it away. Move the apex along the fold, or make the fold "
     "longer."},
    {"fold-turned", Severity::remark, "the gutter was given downwards",
     "Left and right are seen from a fold's begin to its end. The gutter always runs upwards, so a structure "
     "that gives it downwards is read with its sides exchanged, and a v-fold as its inverse. The document "
     "stays as it is; nothing needs mending."},
    {"fold-without-direction", Severity::error, "a parent fold begins and ends in the same point",
     "A parent fold is named by two distinct points of it. They say which fold is meant and in which "
     "direction it is looked along, and so which side is left. Here both points are the same, to within the "
     "rounding of a drawing. Give the two ends of the fold."},
    {"font-missing", Severity::error, "the font of the labels cannot be read",
     "A PDF carries the font of its labels with it, and that font is read from one known file, DejaVu Sans, "
     "so that sheets look the same on every machine. The file named in the message is not there, may not be "
     "read, or is no font. Nothing has been written. Install the font where the message says (on Debian the "
     "package fonts-dejavu-core brings it), or write SVG, which only names the font."},
    {"group-too-large", Severity::error, "the pieces of a design do not fit on one sheet together",
     "Under --group design all pieces of one copy of a design are put on the same sheet, so that a kit can "
     "be handed out as one. No arrangement of these pieces was found that fits on a single sheet. Take a "
     "larger sheet, a smaller --scale, or leave --group out."},
    {"hidden-shape", Severity::remark, "shapes that are hidden",
     "Elements with display:none or visibility:hidden, such as layers that are switched off, are not cut. "
     "That is mostly what is meant. Show them in the drawing program, or take the properties out, if they "
     "are to be cut."},
    {"holes-overlap", Severity::warning, "two holes of a part that overlap partly",
     "Two contours within one part have an area in common though neither lies in the other. The paper that "
     "is left is what both leave, and the outline of that is cut. Unite the two contours if one opening is "
     "meant, or move them apart if they are two."},
    {"job-crashed", Severity::error, "a job whose process died",
     "The process that did a job of a batch ended without an answer, and so did a second one that tried "
     "the job again. Often the system had no memory left: run fewer processes at a time with -j. Otherwise "
     "it is a mistake in this program; please report it with the input. All other jobs went on, and a "
     "rerun tries this one anew."},
    {"job-failed", Severity::error, "a job of a batch that ended with errors",
     "The input of the job has errors, or a file could not be read or written, so nothing of it was "
     "written. The report has the findings of the job itself, with their places. When the input is mended, "
     "or the file can be used again, run the batch once more: only what is missing or has changed is done."},
    {"job-missing", Severity::error, "a job of a batch whose files are not there",
     "No result says that the job was done, or a file that it wrote has been removed or changed since. A "
     "shard may not have run, or its machine went down. Run the batch again, or the shard: what was "
     "finished stays as it is, and only what is missing is done."},
    {"jumps", Severity::error, "an element jumps while the card opens",
     "At some opening angle a plate would have to turn through a large angle at once. Real paper cannot: the "
     "linkage passes from one of its two solutions to the other, its mirror image, or is so close to locking "
     "that a hair's breadth decides. This is looked for all the way from closed to open, not only at the "
     "angles that --angles names. Give it more room: a wider piece, a narrower V, less extreme angles."},
    {"kerf-shares-color", Severity::remark, "cuts that are moved for the kerf share their colour with others",
     "With --kerf closed cuts are moved out of the paper by half of what the tool burns away; slits, and "
     "cuts "
     "that no kerf was given for, are not. Programs that move cuts themselves do so by colour or layer, and "
     "would do it twice to some of them. Let the program move nothing, or give the pens different colours in "
     "a "
     "profile of your own."},
    {"kerf-too-wide", Severity::error, "a cut is narrower than what the tool burns away",
     "With --kerf cuts are moved out of the paper by half the width that a laser burns away, or a knife "
     "tears, so that pieces have the size they were drawn with. A hole, a notch, or a gap between two "
     "contours that is no wider than the kerf then closes, and no path of the tool could make it; nor may "
     "pieces be laid nearer to each other than the kerf is wide, for their cuts would cross, or nearer to "
     "the "
     "edge of the sheet than half of it. Cut without "
     "--kerf, or with a narrower one, make the design larger with --scale, draw a narrow slot as an open "
     "line, which is cut as it is, or raise --spacing."},
    {"layer-order", Severity::warning, "the plates of the closed card cannot lie on one another",
     "In the closed card all plates lie in layers between the left cover and the right one. Here there is no "
     "order in which all of them can lie: one lies partly under and partly over another, or several each lie "
     "below the next and the last below the first; the message names them. Paper would have to be woven, and "
     "the card bulges or does not close. Make one of the plates smaller, so that it no longer reaches over "
     "the next, or move its element."},
    {"layer-width", Severity::warning, "a layer's piece is not as wide as its seams are apart",
     "A layer lies flat on the open card, so its piece is exactly as wide as the seams on the page are "
     "apart. A "
     "narrower one stops the card from opening, and a wider one is a tent. The piece was widened or narrowed "
     "alike on both sides."},
    {"line-outside", Severity::warning, "an open line that lies outside of every part",
     "Lines that do not close are slits or folds of the part they lie in. This one lies in none, or not "
     "wholly, and what lies outside is left out. Often it is the side of an outline that does not close: "
     "the ends of lines must be within 0.02 mm of each other to be one corner. Join them, end the line at "
     "the outline, or take it out."},
    {"lines-left-out", Severity::warning, "a profile leaves out cuts or folds",
     "The pens of these lines have no layer, or folds are to be perforated and the pen of perforations has "
     "none, so "
     "that the files lack them. A file without its cuts is seldom what is wanted; without folds it may be, "
     "where "
     "they are made by hand: then --allow lines-left-out says so."},
    {"lock-impossible", Severity::error, "a piece cannot stay where it is locked",
     "--lock keeps a piece in a place, given as a report gives it: where the origin of the piece's page goes "
     "on the sheet, in millimetres from its lower left corner, and by how much the piece is turned. There, "
     "the piece would reach over the margin or come too close to another locked piece, or it is locked "
     "twice, or apart from what --group or --grain puts with it. Lock it elsewhere, or leave it free."},
    {"locks", Severity::error, "an element's linkage cannot reach an angle",
     "The sides of the element are too short for the place they are glued to (or, for a v-fold, the angles "
     "of piece and page together exceed 360°), so that the card stops before it is open. This is looked for "
     "all the way from closed to open, not only at the angles that --angles names; the message gives one "
     "that cannot be reached. Widen the piece, or bring its seams closer to the fold."},
    {"missing-value", Severity::error, "a value that must be given",
     "A structure needs its type, its outer points and a parentfold with a begin and an end; a point needs x "
     "and y; and a field that is written must not be empty. What is optional (ids, colours, the base page) "
     "may be left out altogether. Write the value, or take the empty field out."},
    {"model-coarse", Severity::warning, "the model's animation has fewer keys than it needs",
     "Between two keys of the animation a viewer turns every plate on its own, and keys are added until no "
     "fold visibly opens on the way. Here the file would have grown beyond half a gigabyte first. The model "
     "is right at every key and a little open between some. Write fewer designs into one model; pages many "
     "metres wide also cause this, so check the document's units."},
    {"model-too-large", Severity::error, "the model has more data than its file format holds",
     "Every plate has a turn at every key of the animation, and together with the shapes they must stay "
     "below two gigabytes. Ask for fewer angles or fewer keys a second, or write the designs into several "
     "models."},
    {"moved-with-fold", Severity::warning, "an element moved because its fold was repaired",
     "Elements keep their place relative to the fold they stand on. A repair moved that fold, so the element "
     "was moved, or turned, with it. Mending the element below makes this repair unnecessary."},
    {"nest-stopped", Severity::remark, "the search for places was interrupted",
     "With --nest-time an interrupt (Ctrl-C) ends the search and the best layout found so far is written, "
     "checked as any other. Let it run on for a tighter one, or use --nest-effort for one that is the same "
     "every time."},
    {"newer-element", Severity::warning, "an element that the document's version does not have",
     "The document says it is of version 2.0, or says nothing, and uses an element that Popup Workshop did "
     "not have. It is read all the same. Write version=\"3.0\" at the root, so that other programs know what "
     "to expect."},
    {"no-contours", Severity::error, "a drawing without any closed contour",
     "Parts are what closed contours enclose, and the drawing has no contour that closes. Perhaps its "
     "outlines have gaps of more than 0.02 mm at the corners, are texts that were not made into paths, are "
     "hidden, or have neither stroke nor fill. Close the outlines: in Inkscape by joining selected nodes."},
    {"no-design", Severity::error, "an input that is not the design of a card",
     "The input describes flat parts that do not move: a drawing. What was asked for needs the design of a "
     "pop-up card, which a drawing is not. Give it to popupc build for sheets (.svg, .pdf) or the report "
     "(.json), or name a popup document."},
    {"no-designs", Severity::warning, "a directory in which there is nothing to look at",
     "A directory was named as an input, and in it and below it there is no design: no file whose suffix is "
     "that of a popup document, or none that --include asks for, or all of them are left out by --exclude, "
     "by a .popupcignore file, or because their names begin with a full stop. Nothing has been checked, "
     "which is seldom what was meant. Correct the path or the patterns."},
    {"not-cut", Severity::warning, "texts, images and the like in a drawing",
     "A text is not an outline until a font is chosen, and an image has none at all, so neither is cut or "
     "printed. Letters that are to be cut must be converted to paths (in Inkscape: Path > Object to Path), "
     "images traced. If they are only notes, accept this with --allow not-cut, or put them on a hidden "
     "layer."},
    {"not-flat", Severity::error, "a plate is not flat when the card is closed",
     "At the closed card every plate must lie in one plane, or the card does not shut. An element of this "
     "design does not fold flat; usually its angles were taken as they are because a repair was not "
     "allowed."},
    {"not-parallel", Severity::warning, "a side fold or seam does not run along its parent fold",
     "The folds of a step and the seams of a tent must be parallel to the fold they stand on, and the two "
     "seams of a tent's piece to each other; otherwise the plates would have to bend. Each line was turned "
     "about its midpoint, its length kept."},
    {"one-sided-folds", Severity::remark, "mountain and valley folds are scored from the same side",
     "A laser, and most plotters, score the front of the paper only, and paper folds best away from its "
     "score: "
     "mountain folds come out crisp, valley folds less so. Take --score-side both, "
     "which puts the valley folds on a mirrored sheet for the back, or --fold-style perforated, which folds "
     "either way, or crease them by hand with a ruler."},
    {"opening-too-wide", Severity::warning, "an angled element opens too far",
     "The sides of a beak or angled step may open by at most 175° about the apex, and the V of a v-fold by "
     "at most 170°: beyond that the element hardly leaves the page, and its solution is lost when the card "
     "lies open. Both sides were turned in alike."},
    {"outline-crosses", Severity::error, "an outline crosses itself",
     "The points of an element, in the order of its type, do not go round a piece of paper: two edges cross "
     "where the message says, so there is no telling which side of them is paper. Usually two points are "
     "exchanged; the manual page popup(5) gives the order for each type."},
    {"page-frame", Severity::remark, "a contour as large as the page that holds all else",
     "The outermost contour has the size of the drawing's page, and everything lies in it, so the whole "
     "drawing is one part. If it is a frame, the edge of the sheet or of the picture, take it out: then "
     "what lies in it are parts, and can be placed anew."},
    {"page-not-there", Severity::error, "a page is named that does not exist yet",
     "Page 0 is the base page. Every v-fold and every tent adds one page for its own piece: page 1 for the "
     "first of them in the list, 2 for the second. An element or a drawn line can only be on a page whose "
     "piece is listed before it."},
    {"page-size", Severity::error, "a base page of an impossible size",
     "The width and the height of the base page must be positive: at least 1 mm, and at most 10 m. The "
     "numbers are in the document's unit, which is inches when nothing is said; a size like 279 without "
     "units=\"mm\" is a page of seven metres. Correct the size or the unit; without either the page has 11 "
     "by 8.5 inches."},
    {"part-divided", Severity::warning, "a cut that divides a part",
     "An open cut runs from a part's edge to the same edge. Each outermost contour is one part, and is "
     "placed as one, but this one will come off the machine in two pieces. If they are meant to be two "
     "parts that share an edge, draw each as a closed contour of its own."},
    {"pdf-failed", Severity::error, "the PDF library gave up",
     "The library that makes PDF documents reported the error in the message, for example that memory ran "
     "out or that the font of the labels is damaged. Nothing has been written. Reinstall the font, or write "
     "SVG instead and print that; both show the same drawing."},
    {"pdf-page-size", Severity::error, "a sheet is larger than a PDF page can be",
     "A page of a PDF has at most 14400 points a side, which is 5080 mm; programs that read PDF refuse or "
     "shrink larger ones, and a sheet that is shrunk is useless. Choose a smaller sheet with --sheet, so "
     "that the pieces are spread over several pages, or write SVG, which has no such limit."},
    {"picture-failed", Severity::error, "a picture could not be made",
     "The library that makes pictures gave up: there was no memory for so many pixels. Choose a smaller "
     "--dpi or a smaller --sheet, or write a format that is not made of pixels, such as SVG or PDF."},
    {"picture-too-large", Severity::error, "a sheet has too many pixels",
     "A picture has at most 32767 pixels on a side and 300 million in all, which is what the libraries that "
     "make it take without gigabytes of memory. Choose a smaller --dpi, or a smaller --sheet."},
    {"piece-mirrored", Severity::warning, "an extra piece was drawn from the back",
     "Pieces are drawn with their printed side up. This one runs the wrong way round (a v-fold's G E H J I "
     "clockwise, or a tent's K–L on the wrong side of G–H), so it was mirrored, and with it what stands and "
     "is drawn on its page."},
    {"piece-too-large", Severity::error, "a piece does not fit on the sheet",
     "A piece of the design, tabs included, is larger than what is left of the sheet inside its margins, in "
     "every way it may be turned. Pieces are never cut apart, so nothing was written. Choose a larger sheet, "
     "a smaller margin, or a smaller --scale; the message gives both sizes, and the hint a paper or a scale "
     "that would do. A piece that is a little too long may also fit across the sheet with --rotate any."},
    {"piece-too-narrow", Severity::warning, "a v-fold's piece is too narrow for its V",
     "The angles of the piece at E must be at least 10° more than those of the V on the page, or the piece "
     "stays flat on the page and blocks the card from opening. The piece was widened alike on both sides, "
     "which leaves its seams as they are."},
    {"piece-too-wide", Severity::warning, "a v-fold's piece is too wide for its V",
     "The angles of the piece and of the V must not exceed 350° together. At 360° all of the paper round the "
     "apex lies in one plane before the card is open, and the card stops there. The piece was narrowed alike "
     "on both sides."},
    {"plate-not-found", Severity::error, "there is no plate where an element should stand",
     "A structure names its parent plate by any point of it. Neither the page nor an earlier structure has "
     "paper there: the point lies beside all plates of that page, or where one has been cut out. The list is "
     "in build order, parents first, and the point is in the coordinates of the page given."},
    {"plotter-range", Severity::remark, "a sheet is larger than what old plotters count to",
     "HP-GL counts in units of 0.025 mm, and the plotters it was made for count no further than 32767, which "
     "is 819 mm. Most machines of today take larger numbers; one that does not stops there, or draws in the "
     "wrong place. Plot the sheet once with the pen or the knife up, or choose a smaller sheet with "
     "--sheet."},
    {"point-count", Severity::error, "too few or too many points",
     "Every type of structure has a fixed number of outer points in a fixed order, called by the letters in "
     "the message; the corners that follow from them are computed. A drawn line has at least two points. Add "
     "the missing points or take the doubled ones out; `popupc list elements` shows what each type takes."},
    {"points-reordered", Severity::warning, "the points of an angled step were given outside in",
     "The points of an angled step are written with the one nearer to the apex first on each side: B before "
     "C, G before F. Here both pairs stood the other way round, which describes the same cuts; they were "
     "exchanged in the checked design, and fix writes them in order."},
    {"prints-left-out", Severity::remark, "the machine profile leaves out what was asked for",
     "Profiles of lasers and cutters leave out what is printed, so that no machine burns it: registration "
     "marks, "
     "the bar to measure, and all that is on printed backs. --print-and-cut writes it to files of its own, "
     "which "
     "are for a printer; a profile of your own can give the pens of what is printed a layer."},
    {"protrusion", Severity::warning, "a plate sticks out of the closed card",
     "When the card is closed, every plate should lie between its covers. This one reaches over their edge: "
     "the message says how far, and on which side. It will be seen there before the card is opened, and bent "
     "and torn in its envelope. Make the plate smaller by as much, or move the element away from that edge. "
     "Where it is meant, --allow protrusion accepts it."},
    {"reference-too-long", Severity::error, "the bar to measure does not fit on the sheet",
     "--reference draws a bar of a known length below the pieces, with its figure beside it and clear of "
     "registration marks. The sheet is too narrow for a bar of this length. Ask for a shorter one, or choose "
     "a "
     "wider --sheet."},
    {"seam-length", Severity::warning, "the seams of a piece do not match those on the page",
     "What is glued together must be the same length, end for end. The page's seams rule, since other "
     "elements may stand on them; the ends of the piece's seams were moved along their lines until they fit. "
     "Draw both seams equally long."},
    {"seam-open", Severity::error, "a fold or seam comes apart while the card opens",
     "At one of the sampled angles two plates that share a line no longer meet along it. Paper cannot do "
     "that: the geometry is so extreme that rounding decides. Make the angles and widths of the element "
     "larger."},
    {"seam-stays-flat", Severity::error, "an element stands on a seam that does not fold",
     "The plates on both sides of this seam lie in one plane, facing the same way, when the card is closed. "
     "Nothing that stands across such a seam can fold flat. Seams of v-folds and tents on valley folds do "
     "open and close."},
    {"seams-uneven", Severity::warning, "seams that must be at the same distance from the fold are not",
     "A layer is wrapped round a mountain fold and must not slide on it, which it does not where both seams "
     "are "
     "at the same distance from the fold. The farther seam was moved to the nearer one's distance, and the "
     "piece "
     "narrowed with it."},
    {"shape-outside", Severity::warning, "a painted shape that is not cut",
     "In a drawing that has stroked contours, these are what is cut, and shapes that have a fill and no "
     "stroke are printed on the parts they lie on. This one lies on none. Give it a stroke if it is a "
     "part, or take it out. In a drawing without any stroked contour the painted shapes are the parts."},
    {"sheet-too-large", Severity::error, "a sheet is larger than the machine's bed",
     "The machine profile says how large a sheet the machine takes, either way round, and the sheet that was "
     "chosen is larger. Choose a smaller --sheet; with --sheet auto the largest paper that goes into the "
     "machine is taken, or its whole bed."},
    {"sheet-too-small", Severity::error, "the margins leave nothing of the sheet",
     "The margin is kept free along all four edges of a sheet. When twice the margin is as much as the "
     "sheet's width or height, no paper is left to put pieces on. Choose a larger --sheet or a smaller "
     "--margin."},
    {"should-be-step", Severity::error, "an angled step has parallel sides",
     "The side folds of an angled step meet in an apex on the parent fold. Here they are parallel to it, or "
     "meet further away than 20 page heights, so that rounding would decide where. An element with parallel "
     "side folds is a step."},
    {"sides-do-not-meet", Severity::warning, "the sides of an angled step meet the fold in two points",
     "All folds of an angled step run through one apex on the parent fold. The apex was put halfway between "
     "the two crossings, and the inner points moved onto the lines from it to the outer points, which stay."},
    {"sides-exchanged", Severity::warning, "left and right points were exchanged",
     "Left is the left-hand side when looking from the parent fold's begin to its end. All points given as "
     "left lie right of it and the other way round, so the points changed places; the colours stay with the "
     "sides they are named for."},
    {"size-in-pixels", Severity::remark, "a drawing whose size is in pixels",
     "Pixels are taken for 96 to the inch, as CSS has it. Programs have used 72 and 90 as well, so that "
     "parts may come out too small by a quarter. Compare the size in the message with what it should be, "
     "and set the document's units to millimetres if it is not."},
    {"size-missing", Severity::warning, "a drawing that does not say how large it is",
     "The drawing has no width and height with a length in them, only numbers without a unit. They are "
     "taken for pixels, 96 to the inch, but programs that export such drawings often mean points, 72 to "
     "the inch. Look at the size in the message. Write width and height with mm, export the drawing with "
     "its size, or use --scale."},
    {"stock-used-up", Severity::error, "there are not enough sheets in the stock",
     "--stock says how many sheets of which sizes there are. All of them were filled and pieces were left, "
     "even after a search for a tighter arrangement. Add sheets, or let the search look longer with a higher "
     "--nest-effort; it may find room if only little is missing."},
    {"style-ignored", Severity::warning, "style rules that are not understood",
     "Rules of style elements are read when they are for a tag, a class, an id, or a class of a tag. "
     "Others, such as those for elements inside of others, and conditions such as @media, are not. What "
     "they say of strokes, fills and hidden shapes may be missed. Let the drawing program write styles as "
     "attributes, or inline."},
    {"tab-too-small", Severity::warning, "little is left of a glue tab",
     "A glue tab runs along each seam of a piece, and its target on the plate it is glued to. Both are "
     "trimmed so that they stay 1 mm clear of folds, cuts, edges and earlier tabs. Of this one less than 3 "
     "mm of depth are left along half its seam or more, so the joint will hold badly, or the seam has no tab "
     "at all. Move the element away from what is near its seam, make the seam longer, or add paper by hand "
     "and glue from behind; --allow tab-too-small accepts it."},
    {"tent-too-narrow", Severity::warning, "a tent's piece is narrower than its seams are apart",
     "The piece of a tent must be at least as wide as the distance between its two seams on the open page, "
     "or it stops the card from opening. It was widened alike on both sides, to lie flat on the open page."},
    {"too-many-pieces", Severity::error, "the run has more pieces than can be laid out",
     "One run lays out at most a million pieces, all copies of all designs together; more is nearly always a "
     "slip in --copies. Ask for fewer copies, or split the run."},
    {"undecided", Severity::remark, "it is not decided whether two plates cross",
     "The examination divides the range of angles until it can prove that two plates are clear of each "
     "other, or finds where they cross. Between the angles in the message it could do neither within the "
     "work allowed, mostly because the plates graze each other there by less than can be told apart. Nothing "
     "is claimed of these two plates at these angles. Look at them in the model, or move one of them by a "
     "tenth of a millimetre and check again."},
    {"unknown-language", Severity::error, "an input whose language is not known",
     "The language of an input is told by the suffix of its name. This name has none that is known, or it is "
     "standard input, which has no suffix. Rename the file, or name the language with --from; `popupc list "
     "languages` shows all of them."},
    {"unknown-markup", Severity::warning, "an element, attribute or text that has no meaning",
     "The document holds markup that the reader does not know in that place, and disregards with all that is "
     "in it. Often it is a slip in a name, and then something that you meant is missing from the result. "
     "Correct the name, or take the markup out. With --strict this is an error."},
    {"unknown-piece", Severity::error, "an option names a piece that is not there",
     "--lock and --rotate PIECE=… name pieces as the outputs do: \"page\" for the base page, the id of an "
     "element for its extra piece, the name of a part of a drawing, and with several inputs the file's stem "
     "before a colon, such as \"castle:roof\". No piece of the run has this name, or not so many copies. "
     "The labels on the sheets and the report list the names."},
    {"unknown-type", Severity::error, "a structure of an unknown type",
     "The type of a structure is the name of an element, such as beak or inverted-step, or its number in "
     "Popup Workshop, from 0 to 8. Case, hyphens and underscores do not matter. `popupc list elements` shows "
     "all of them."},
    {"unknown-version", Severity::warning, "a document version that is not known",
     "Known versions of the popup document are 2.0, the one of the last Popup Workshop, and 3.0. The "
     "document names another, and is read as 2.0; what a later version has added would be reported as "
     "unknown. Correct the version, or see whether there is a newer popupc."},
    {"unreadable-input", Severity::error, "an input file cannot be read",
     "The file does not exist, is larger than 64 MiB, may not be opened by this user, or is a directory, "
     "which only check and fix look into. Nothing of it has been looked at. Check the path and the "
     "permissions; paths are taken relative to the directory the program was started in, and \"-\" stands "
     "for standard input."},
    {"unused-allow", Severity::warning, "a comment allows what is not there",
     "A comment of the document allows a diagnostic, and where it stands nothing of the kind was found, "
     "although everything was looked at. The reason for it may have gone, or the comment has lost the "
     "element that it was written for. Left alone it would hide the next such finding, which nobody has "
     "looked at. Take the code out of the comment, or the comment out of the document."},
    {"unusual-format", Severity::remark, "the machine's program is not known to take this format",
     "A machine profile names the formats that the machine or its program takes. A file of another format "
     "was "
     "asked for. It is written all the same, with the profile's layers and colours."},
    {"unwritable-output", Severity::error, "an output file cannot be written",
     "The directory does not exist, is not writable, or the disk is full. Outputs are written to temporary "
     "files first and moved into place together, so no older file of this run has been touched. Create the "
     "directory or choose another place with -o."},
    {"wrong-form", Severity::warning, "an element's form does not match its fold",
     "Inverted steps, beaks and angled steps are those that stand on mountain folds. A v-fold's V opens "
     "towards the end of its parent fold, an inverted one's towards its begin. The type was corrected; no "
     "point moved."},
    {"wrong-ground", Severity::error, "an element stands on what it cannot stand on",
     "Some elements stand on folds or seams, which parentfold names, and some on plates, which parentplate "
     "names by any point of them. `popupc list elements` and popup(5) say which."},
    {"wrong-page", Severity::error, "a point lies on a page that its parent fold is not on",
     "Points of an element lie on the planes beside its parent fold. On a seam these planes are on two "
     "pages: each point must name the page of its side. On a fold both sides are on one page."},
    {"wrong-root", Severity::error, "an XML document of another kind",
     "The file is XML, but its outermost element is not the one that its language begins with: <popup> of a "
     "popup document, <svg> of a drawing. Perhaps it is another kind of file with a wrong name, or an output "
     "of "
     "this program in place of its input. Name the right file, or its language with --from."},
    {"xml-syntax", Severity::error, "a text that is not well-formed XML",
     "Tags must be closed in the order they were opened, values stand in quotes, no attribute stands twice "
     "in a tag, the characters < and & are written &lt; and &amp; in texts and values, and nesting is at "
     "most 100 deep. The place given is where reading could not go on; the mistake may lie before it. A "
     "document that ends inside an element has probably been cut off. Reading stops at the first such "
     "mistake, since what follows cannot be trusted."},
});

}  // namespace

std::span<const CodeInfo> code_table() {
    static const std::vector<CodeInfo> table = [] {
        std::vector<CodeInfo> rows;
        const auto by_code = [](const CodeInfo& a, const CodeInfo& b) { return a.code < b.code; };
        std::ranges::merge(kCodes, program_codes(), std::back_inserter(rows), by_code);
        return rows;
    }();
    return table;
}

const CodeInfo* find_code(std::string_view code) {
    const std::span<const CodeInfo> table = code_table();
    const auto row = std::lower_bound(table.begin(), table.end(), code,
                                      [](const CodeInfo& a, std::string_view b) { return a.code < b; });
    return row != table.end() && row->code == code ? &*row : nullptr;
}

}  // namespace popup
