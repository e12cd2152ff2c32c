#include "mechanism/codes.h"

#include <array>

namespace popup {
namespace {

constexpr std::array kMechanismCodes = std::to_array<CodeInfo>({
    {"apex-off-fold", Severity::warning, "an apex lies beside its parent fold",
     "The folds of a beak, an angled step or a v-fold meet in one point, and that point must lie on the "
     "fold the element stands on: only then do its sides stay the same length while the card moves. The "
     "apex was moved onto the fold, the shortest way. Choose it on the fold to begin with."},
    {"curve-too-tight", Severity::remark, "an outline turns more tightly than a knife can follow",
     "A drag knife, and most lasers, round off curves with a radius under a tenth of a millimetre, and paper "
     "tears where they begin. The outline is cut as it is drawn. Where a sharp corner is meant draw two "
     "curves that meet in one; else draw a wider curve."},
    {"degenerate", Severity::error, "an element is too small to fold",
     "A seam, side fold or width is under 1 mm, or an angle under 1°. No paper folds that small, and small "
     "errors of the knife would decide how it moves. Give the element room; where a point lies on the "
     "wrong side of the fold, move it over. With `popupc fix --drop` such elements are taken out instead."},
    {"does-not-fit", Severity::warning, "an element is larger than the paper it stands on",
     "Each half of a cut element must lie wholly in its own plane, with 1 mm of paper left around it and "
     "no earlier seam under it; each seam of a glued element must lie wholly on one plane. The element was "
     "pulled towards its fold, or shortened along it, until it fits. Where even the smallest form finds no "
     "room it is an error. Make the element smaller or move it. A hole is never moved: it lies 1 mm off the "
     "edges of its page, and off seams and glued areas, or it is an error."},
    {"fold-too-short", Severity::error, "an element's apex lies beyond the end of its fold",
     "The apex of a beak, angled step or v-fold must lie on the stretch of the parent fold that is still "
     "there; earlier elements may have cut part of it away. Move the apex along the fold, or make the fold "
     "longer."},
    {"drawn-off-page", Severity::warning, "nothing of what is drawn lies on the paper of its page",
     "A line, an area, a picture or a text is printed where it lies on the paper of its page. None of this "
     "one does, "
     "so nothing of it is printed. Points are measured from the middle of the page, with y upwards, in the "
     "unit of the document. Often the page is another one, the unit is another one, or the points were "
     "measured from a corner. A line that begins and ends in one point prints nothing either. Move it onto "
     "the paper, give it the page it is meant for, or take it out."},
    {"ends-meet", Severity::warning, "the ends of a box would meet inside it",
     "The ends of a box fold in their middle as the card closes, and the middle folds move inwards by as "
     "much "
     "as its walls are away from the fold. Walls that are not twice as long as that leave no room for both "
     "ends. The walls were moved nearer to the fold, as far as they need. Make them longer, or let the ends "
     "fold outwards: ends=\"out\"."},
    {"hole-off-piece", Severity::error, "a hole that leaves its piece, or no fold to hold it together",
     "Holes of a v-fold, tent or layer are cut out of the paper inside its edges, and leave it one piece: "
     "each "
     "lies inside the outline, off its edges and seams, and has no island in it. A hole may cross the centre "
     "fold, which then is folded before and behind it; it crosses it twice, runs nowhere along it, and 1 mm "
     "of the fold is left at "
     "both ends and between two holes. What opens to the edge belongs into the outline."},
    {"holes-cross", Severity::warning, "holes of one path that overlap",
     "Where two holes of one path overlap, the cuts of both would run through the part that they share, and "
     "it "
     "would fall out. They are cut as one hole, which has no cut inside of it. A hole that lies wholly "
     "inside "
     "another is no overlap: it is an island. Draw such holes as one line, or take over what `popupc fix` "
     "writes."},
    {"layer-width", Severity::warning, "a layer's piece is not as wide as its seams are apart",
     "A layer lies flat on the open card, so its piece is exactly as wide as the seams on the page are "
     "apart. A "
     "narrower one stops the card from opening, and a wider one is a tent. The piece was widened or narrowed "
     "alike on both sides."},
    {"letters-missing", Severity::warning, "a text has characters that its font lacks",
     "Texts are set in the fonts of DejaVu, which have the letters of Latin, Greek, Cyrillic and some other "
     "scripts, and not those of Chinese or Japanese. A character that the font lacks is printed as an empty "
     "box, on sheets and in models alike. The message lists such characters. Take another font where one has "
     "them all, or print the text as a picture, or draw its letters as an area."},
    {"no-outline", Severity::error, "a shape cut from one sheet has no border",
     "A freeform is drawn as an outline, which is SVG path data, or as three or more touch points that its "
     "border goes through in a smooth closed curve. This one has neither, or touch points that lie on fewer "
     "than three places, and so there is nothing to cut."},
    {"not-parallel", Severity::warning, "a side fold or seam does not run along its parent fold",
     "The folds of a step and the seams of a tent must be parallel to the fold they stand on, and the two "
     "seams of a tent's piece to each other; otherwise the plates would have to bend. Each line was turned "
     "about its midpoint, its length kept."},
    {"opening-too-wide", Severity::warning, "an angled element opens too far",
     "The sides of a beak or angled step may open by at most 175° about the apex, and the V of a v-fold by "
     "at most 170°: beyond that the element hardly leaves the page, and its solution is lost when the card "
     "lies open. Both sides were turned in alike."},
    {"outline-crosses", Severity::error, "an outline crosses itself",
     "Where the drawn border of a box fold, polygon, freeform, v-fold cut or hole crosses or touches itself, "
     "or "
     "the outline of a glued piece does, or a hole or window in one, the loop of larger area is kept and the "
     "other left out: a repair, with the place and the size of what went. What crosses itself too often to "
     "tell, or encloses several areas, is an error, and so is what then has under 4 mm² and is cut from one "
     "sheet. Where no border is drawn: "
     "the points of an element, in the order of its type, do not go round a piece of paper: two edges "
     "cross where the message says, so there is no telling which side of them is paper. Usually two points "
     "are exchanged; the manual page popup(5) gives the order for each type."},
    {"outline-off-fold", Severity::error, "a drawn outline that its centre fold does not divide",
     "What is cut from one sheet lies across its parent fold, and crosses it exactly twice, so that one part "
     "of "
     "it lies on either side; its side folds, where they are given, lie within its outline. The outline of a "
     "v-fold, tent or layer is cut as drawn and folded along the centre fold, whose line "
     "follows "
     "from the seams. That line must cross the outline exactly twice, with one seam on each side, so that "
     "two "
     "halves come of it. Draw the outline so that each side of the fold "
     "is "
     "one area."},
    {"outline-off-seam", Severity::error, "a drawn outline that does not run along a seam",
     "A piece is glued along its seams, so these must be part of its border: the outline goes through both "
     "ends "
     "of each seam, with a straight line between them. Points that miss an end by up to 0.5 mm are moved "
     "there. "
     "Draw the outline through the points that the message names, or move these."},
    {"outline-snapped", Severity::warning, "points of a drawn outline that miss the ends of a seam",
     "An outline goes through the ends of the piece's seams. Points of it that missed them by up to 0.5 mm "
     "were "
     "moved there, and curves that end in them with them. Draw them where the seams end, or take over what "
     "`popupc fix` writes."},
    {"paper-too-thin", Severity::warning, "a drawn piece has a neck of paper that tears",
     "Two parts of a piece hang together by less than 0.5 mm of paper, or less is left between a hole and an "
     "edge or another hole. It tears when the piece is taken out of its sheet, and a laser burns it away. "
     "The "
     "message has the narrowest place; a neck has at least 4 mm² of paper on both sides. It is cut as drawn. "
     "Draw it wider."},
    {"piece-mirrored", Severity::warning, "an extra piece was drawn from the back",
     "Pieces are drawn with their printed side up. This one runs the wrong way round (a v-fold's G E H J I "
     "clockwise, or a tent's K–L on the wrong side of G–H), so it was mirrored, and with it what stands "
     "and is drawn on its page."},
    {"piece-too-narrow", Severity::warning, "a v-fold's piece is too narrow for its V",
     "The angles of the piece at E must be at least 10° more than those of the V on the page, or the piece "
     "stays flat on the page and blocks the card from opening. The piece was widened alike on both sides, "
     "which leaves its seams as they are."},
    {"piece-too-wide", Severity::warning, "a v-fold's piece is too wide for its V",
     "The angles of the piece and of the V must not exceed 350° together. At 360° all of the paper round "
     "the apex lies in one plane before the card is open, and the card stops there. The piece was narrowed "
     "alike on both sides."},
    {"points-reordered", Severity::warning, "the points of an angled step were given outside in",
     "The points of an angled step are written with the one nearer to the apex first on each side: B "
     "before C, G before F. Here both pairs stood the other way round, which describes the same cuts; they "
     "were exchanged in the checked design, and fix writes them in order."},
    {"seam-length", Severity::warning, "the seams of a piece do not match those on the page",
     "What is glued together must be the same length, end for end. The page's seams rule, since other "
     "elements may stand on them; the ends of the piece's seams were moved along their lines until they "
     "fit. Draw both seams equally long."},
    {"seams-uneven", Severity::warning, "seams that must be at the same distance from the fold are not",
     "A layer that is wrapped round a mountain fold must not slide on it, and the walls of a box fold flat "
     "only "
     "where both seams are at the same distance from the fold. The farther seam was moved to the nearer "
     "one's "
     "distance, and the piece of a layer narrowed with it. Put both at one distance to begin with."},
    {"should-be-step", Severity::error, "an angled step has parallel sides",
     "The side folds of an angled step meet in an apex on the parent fold. Here they are parallel to it, "
     "or meet further away than 20 page heights, so that rounding would decide where. An element with "
     "parallel side folds is a step."},
    {"sides-do-not-meet", Severity::warning, "the sides of an angled step meet the fold in two points",
     "All folds of an angled step run through one apex on the parent fold. The apex was put halfway "
     "between the two crossings, and the inner points moved onto the lines from it to the outer points, "
     "which stay."},
    {"tent-too-narrow", Severity::warning, "a tent's piece is narrower than its seams are apart",
     "The piece of a tent must be at least as wide as the distance between its two seams on the open page, "
     "or it stops the card from opening. It was widened alike on both sides, to lie flat on the open page."},
    {"text-cut", Severity::remark, "a text is longer than its paper",
     "Letters beside the paper of their page are not printed. This text is centred where it was put, and one "
     "end of it, or both, lies beyond the edge. The message says how long the text is in its font, how much "
     "of it is lost, and how long the paper is along it. Make the letters lower, move the text, turn it, or "
     "part it into lines."},
    {"walls-not-opposite", Severity::warning, "the walls of a box do not stand opposite each other",
     "The ends of a box run straight from one wall to the other, square to the fold, so both walls begin and "
     "end at the same places along it. What one wall reached further than the other was taken off. Draw A–B "
     "and E–F as mirror images in the fold."},
    {"wrong-form", Severity::warning, "an element's form does not match its fold",
     "Inverted steps, beaks and angled steps are those that stand on mountain folds. A v-fold's V opens "
     "towards the end of its parent fold, an inverted one's towards its begin. The type was corrected; no "
     "point moved."},
});

}  // namespace

std::span<const CodeInfo> mechanism_codes() { return kMechanismCodes; }

}  // namespace popup
