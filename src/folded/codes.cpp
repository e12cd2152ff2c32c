#include "folded/codes.h"

#include <array>

namespace popup {
namespace {

constexpr std::array kFoldedCodes = std::to_array<CodeInfo>({
    {"angle-not-found", Severity::remark, "an angle for folds that are not there",
     "--fold-angle, or fold-angle in popupc.toml, gives an angle to folds by the name of their lines. No "
     "fold of "
     "this sheet is called so: the name may be spelt otherwise, the colour be another shade, or the lines be "
     "taken for cuts, which --lines says. Angles for a whole library need not fit each of its drawings."},
    {"bad-refinement", Severity::error, "a refinement file that cannot be read",
     "A refinement file says which corners and panels of a sheet are joined. It is JSON: an object with a "
     "list called joins, each of which is a merge of corners, or a paste or a coplanar of two panels. The "
     "message says what is none of these. popupc suggest --accept writes such files."},
    {"board-left-out", Severity::remark, "a sheet whose creases were not moved for the board",
     "The option --board looks for panels that lie on each other in the closed carton, nearer than the board "
     "is thick. That is known of sheets that fold as they are drawn. Loops of this one do not close, so "
     "nothing was moved. Mend what popupc check says of its loops first."},
    {"carton-size", Severity::remark, "how large a carton is, flat and closed",
     "With --board popupc says of each piece how large its blank is, the board that it takes without its "
     "waste, the size of the closed carton outside, and what it holds. Sizes go along the longest edge of "
     "the panel that stands still, across it, and upright on it. What it holds is the hull of its panels, "
     "less half a caliper on all sides: of a carton with ears or handles that stand out it is too much."},
    {"corners-refined", Severity::remark, "corners of a crease pattern that were moved a little",
     "Around a corner or a hole the folds must fit together exactly, or the sheet cannot be folded at all; "
     "and a "
     "drawing has only so many decimals. Where loops close to within its rounding, and not exactly, popupc "
     "moves "
     "corners so that they do, by 0.2 mm at most. The message says how many moved, and how far the furthest. "
     "What is cut is the sheet with the corners moved."},
    {"crease-moved", Severity::warning, "a crease that lacked room for the board",
     "Board has a thickness. Where two panels lie on each other in the closed carton, the one that goes "
     "inside must stand a caliper further in, a tuck flap a caliper and a half, or the carton bulges or does "
     "not close. So its crease was moved into the panel that it hangs on, by what the message says, and all "
     "that is beyond it came along. Files that are written are of the sheet with its creases moved; the "
     "drawing stays as it is. Move the crease there, or build without --board."},
    {"dangling-fold", Severity::warning, "a fold that ends in the middle of a panel",
     "A fold divides the sheet: on either side of it there is another panel. This one, or a stretch of it, "
     "has "
     "the same panel on both sides, because it ends before it meets a cut or another fold, or leads to "
     "nothing "
     "else. Nothing can be folded there without bending the paper, so the stretch is left out. Draw it on, "
     "or "
     "take it out of the drawing. Ends that miss by up to half a millimetre are joined by themselves."},
    {"falls-out", Severity::warning, "something that lies in a hole of a folded sheet",
     "It is cut out on all sides of the sheet around it, and so it falls out when the sheet is cut. If it "
     "has "
     "folds, they hold it to nothing but itself. It is neither cut nor folded here. If it is meant to be a "
     "piece of its own, draw it beside the sheet; if it belongs to the sheet, one of its cuts should be a "
     "fold, or a bridge of paper should lead to it."},
    {"flat-angles", Severity::warning, "a corner whose angles do not let it fold flat",
     "Around an inner corner that is folded flat the paper goes to and fro, and must come back to where it "
     "began: "
     "the angles between its folds, every other one of them, add up to 180 degrees (Kawasaki's theorem). "
     "Here they "
     "do not. The message says what they add up to. Turn one of the folds about the corner by the "
     "difference; then "
     "look at its other end, where the angles change as well. Differences below 0.1 degrees are taken for "
     "rounding."},
    {"flat-kinds", Severity::warning, "a corner with too many or too few mountains",
     "Around an inner corner that is folded flat mountains and valleys differ in number by two (Maekawa's "
     "theorem): "
     "of four folds three are of one kind. Here they do not. The message says how many there are of each. "
     "Folds that "
     "do not say which way they go may go either way. Make a mountain a valley, or a valley a mountain; the "
     "corner at "
     "the other end of that fold changes with it."},
    {"flat-loop", Severity::warning, "panels that do not meet again around a hole",
     "Folded flat, every panel has one place. Going around a hole or a cut from panel to panel one must come "
     "back to "
     "where one began, and here one does not: two panels that a fold joins miss each other, by as much as "
     "the message "
     "says. Around a hole nothing has to be so at each corner; it is the folds that lead around it, all "
     "together, that "
     "must undo one another."},
    {"flat-odd", Severity::warning, "a corner with an odd number of folds",
     "Around an inner corner that is folded flat each fold turns the paper over, so it takes an even number "
     "of them to "
     "come back to the same side. Here the number is odd, so the corner cannot be folded flat, whatever the "
     "angles. Add "
     "a fold, as one that halves the largest angle, or take one out; a line that is only a mark should be of "
     "another "
     "colour."},
    {"flat-order", Severity::warning, "panels that have no order of layers",
     "Folded flat, of two panels that lie on each other one is above. Mountains and valleys say it of "
     "neighbours; no "
     "panel may pass through the fold of two others; and who lies above whom must be an order. Here these "
     "contradict "
     "one another. The message names panels that have no order among themselves, by their middles on the "
     "sheet, as few "
     "as were found. Corners may all be right, and there be no order nevertheless: a long panel between two "
     "short ones "
     "that are folded over it to the same side is the usual reason."},
    {"flat-undecided", Severity::warning, "layers that are too many to be put in order",
     "So many panels lie on one another that the search for an order of them was given up. It may be that "
     "there is "
     "one, and it may be that there is none; nothing is said of it. The corners were looked at and are "
     "right. Look at "
     "a part of the pattern, or say of more folds whether they are mountains or valleys: that leaves less to "
     "search."},
    {"fold-drawn-twice", Severity::warning, "a fold that is a mountain and a valley",
     "Two lines lie on each other, one drawn as a mountain fold and the other as a valley fold. The fold "
     "goes "
     "the way that its neighbours make it go, as folds do that say no way at all. Take one of the two lines "
     "out; drawing programs leave such doubles behind when shapes with a common edge are copied."},
    {"fold-on-cut", Severity::warning, "a fold on a cut that parts the sheet",
     "A fold and a cut are drawn on each other, and the cut goes from edge to edge: what the fold was to "
     "hold is a piece of its own, which lies beside the rest and is not folded with it. Outlines of panels "
     "that were drawn one by one, as closed shapes, leave such cuts behind. Take the cut out. A slit over a "
     "part of a crease is not told of, because the rest of the crease holds the panel."},
    {"fold-stays-flat", Severity::warning, "a fold that does not move though the sheet folds",
     "The sheet can be folded, but only with this fold flat: around the corners at its ends, or the holes "
     "beside "
     "it, the other folds leave it no turn. Folds that cannot go together are tried one after another, and "
     "this "
     "one could not go in any stage. Around a corner of four folds, three must be of one kind and one of the "
     "other if all are to move; where two lines cross, the line that is folded second changes from mountain "
     "to "
     "valley at the first. Draw it so, or leave the fold out if it is a mark."},
    {"folding-undecided", Severity::warning, "a sheet whose folds are too many for the way to be found",
     "Folds around inner corners and holes go together, and how they go is searched for: that takes the more "
     "steps the more of them hang together, and the less they fit. What may be spent on a sheet is bounded, "
     "in "
     "steps that are the same on every machine, so that no drawing keeps popupc busy for ever; some thousand "
     "folds are within the bound. Beyond it the folds that hang together are left as far as they had come, "
     "mostly flat, and all else of the sheet is folded; collisions are not looked for. Sheets for cutting "
     "are as they would be. Lines that "
     "are no folds are the usual reason, such as hatching or a drawing in the colour of folds."},
    {"folds-flat", Severity::remark, "a sheet that folds flat, with an order of its layers",
     "Asked by --flat, popupc laid all panels of the sheet into one plane, each fold turned by half a turn, "
     "and found "
     "an order of all that lie on one another, in which no panel passes through another or through a fold. "
     "The message "
     "says how many panels there are and how many lie on one place at most. A build writes the sheet as it "
     "lies, "
     "and into FOLD files the order, as faceOrders. Whether the sheet gets there without bending is another "
     "question, and answered without --flat."},
    {"glue-corners", Severity::remark, "flaps with an oblique crease that lies flat when the box stands",
     "From where the fold of a flap and that of the wall beside it meet, an oblique crease leads across the "
     "flap, and what is beyond it hangs on nothing else. So crash-lock bottoms are made, and trays that are "
     "sold glued and flat: the corner is glued to the panel beside the flap, and the crease folds it over "
     "only while the box is flat. In the box that stands it lies flat. The drawing says no angle for it, and "
     "so it is folded so. data-fold-angle says otherwise."},
    {"join-left", Severity::remark, "suggestions that were not accepted",
     "Of what was to be accepted, the named suggestions do not go together with the others: panels would "
     "have to bend, or to turn far although next to nothing is open, or would pass through others that they "
     "do not pass through now. Nor is of \"all\" what turns a fold by more than 15 degrees from the angle "
     "that it "
     "had, or by more than --most-turn says: it closes, but is hardly what was drawn, as where the narrow "
     "strip at "
     "the top of a rolled wall lies down. The rest was accepted. A suggestion that is accepted by its own "
     "name is kept "
     "nevertheless, and then the shape is a compromise."},
    {"join-open", Severity::warning, "joins that cannot all close",
     "Corners are to meet, or panels to lie in one plane, and no angles of the folds bring them there while "
     "all panels stay flat. The shape is the one that leaves the least open, in least squares; the message "
     "names the join that is open most, and by how much. Lengths that should agree and do not are the usual "
     "reason: board takes up room, and drawings allow for it. Leave the join out, or mend the lengths."},
    {"join-swings", Severity::warning, "joins that swing folds far",
     "Corners or panels are next to each other already, and to bring them wholly together a fold turns by "
     "more than 15 degrees, and moves what hangs on it many times as far as they were apart. That is seldom "
     "meant: mostly they are a board apart because they lie upon each other, or another join is missing that "
     "says where the fold should be. The message names the fold."},
    {"no-folds", Severity::remark, "a sheet of which nothing folds",
     "No line of this sheet is a fold, so that it stays flat. In a drawing mostly the folds were taken for "
     "cuts: "
     "their layer, class or id has no word for folds in it that popupc knows, and they are black and solid "
     "as "
     "the others. `--lines fold=NAME` says which they are."},
    {"no-border", Severity::warning, "a sheet whose edge is drawn as folds",
     "The outermost lines of a sheet are where its paper ends, so they must be cuts. Here folds lie at the "
     "outside, with paper on one side only; they are taken for cuts. Or there are no cuts, and the folds "
     "enclose nothing: then the sheet ends at the outermost lines that are drawn as flat, or else is the "
     "rectangle around the folds. A pattern whose border is missing folds "
     "into something else, or into nothing, and so this is said. Draw the outline of the sheet as a cut."},
    {"no-sheet", Severity::error, "a crease pattern that encloses no paper",
     "The lines of the pattern make no closed outline: there is no sheet to be folded. The border must be "
     "closed, as one line or as several whose ends meet; ends that miss by up to half a millimetre are "
     "joined. "
     "Look for a border that is drawn with a wide gap, or in a colour that means something else."},
    {"no-rigid-way", Severity::warning, "a closed shape that folding alone does not lead to",
     "The drawing says how far every one of these folds goes, and at these angles the panels meet around all "
     "corners and holes: that is the closed shape, and it is shown and written. But no way was found on "
     "which "
     "the folds get there from the flat sheet while every panel stays plane, as with the gable of a milk "
     "carton, whose board bends while it is pressed shut. The motion goes along the way that was found while "
     "no fold goes beyond its angle, and at its end to the closed shape at once, which no paper does: "
     "collisions are not looked for. Creases along which the board bends would show a way."},
    {"no-room-for-board", Severity::warning, "panels that lie nearer to each other than the board is thick",
     "In the closed carton the two panels of the message lie on each other, and their middles are nearer "
     "than "
     "a caliper. No crease can be moved that would part them: it is part of a loop, something else hangs in "
     "the way, or the panel does not hang on one that goes that way. Change the drawing there, or give a "
     "thinner --board."},
    {"no-such-panel", Severity::error, "a join of something that is not there",
     "A join names panels by the names that findings give them, and corners by where they are drawn. This "
     "one names a panel or a corner that the sheet does not have, or one panel twice. Drawings change: "
     "suggestions are found anew for them."},
    {"no-such-suggestion", Severity::error, "a suggestion that was not made",
     "--accept takes suggestions by their names, as popupc suggest lists them: merge 3, paste 1, coplanar 2, "
     "or all. Numbers are those of the same drawing with the same joins accepted before and the same "
     "--near."},
    {"not-refined", Severity::error, "a sheet whose shape cannot be refined",
     "A shape is refined from the state in which its folds all have their angles. This sheet does not get "
     "there, because folds around a corner or a hole do not let one another go on. Mend what popupc check "
     "says of its loops first."},
    {"not-rigid", Severity::warning, "a sheet that cannot be folded without bending its panels",
     "Around an inner corner, and around a hole, the folds make a loop: turning from panel to panel by each "
     "of "
     "them must lead back to the first. When no angles near those that are asked for do so, the panels would "
     "have to bend or tear. The message says which loop stays open, and by how much. Where the sheet folds "
     "rigidly a part of the way it is folded as far as that. Where it cannot leave the flat state at all, "
     "panels "
     "are shown bent, along lines that the pattern draws as flat or along diagonals, and the message says "
     "where "
     "they bend most; paper would bend in curves, and collisions are not looked for. Mountains and valleys "
     "that "
     "do not go together are the usual reason: at each inner corner that folds flat, they differ in number "
     "by "
     "two. Else add the creases along which the paper bends."},
    {"other-angle", Severity::warning, "folds that end at other angles than they are to",
     "Folds around a corner or a hole go together, so that not all of their angles can be chosen. Those that "
     "are asked for, or 90° in boxes and 180° in FOLD files where nothing is said, do not close these loops, "
     "and the sheet was folded to angles near them that do. The message says how many folds end elsewhere, "
     "and names the one that ends furthest off. Write the angles of a shape that closes: data-fold-angle in "
     "SVG, edges_foldAngle in FOLD. A FOLD file that popupc writes has the angles at which the folds end."},
    {"ring-open", Severity::remark, "walls that would meet if their folds went to another angle",
     "Folds of drawings that do not say how far they go are folded by 90°, as those of boxes are. This "
     "drawing "
     "has a row of walls with a glue flap at its end, and its panels then go through one another, or the "
     "walls "
     "do not meet, or coil up. At other angles they do: 60° for six walls, 120° for three of one width. "
     "Walls of "
     "different "
     "widths meet in many shapes: that of a panel that closes their end is taken, else one with right "
     "angles, "
     "as of a house, else the one with the most room, all corners of which lie on a circle; the message says "
     "which. popupc has tried it: the glue flap lies on the first wall, and nothing goes through anything. "
     "The "
     "message says if other folds go otherwise too. The hint says how to give the angles, as options or in "
     "the "
     "drawing; other angles may be given just so."},
    {"web-corners", Severity::remark, "corners of a tray where folded webs stand between the walls",
     "Between two walls the sheet goes on, and a diagonal of the other kind parts it in halves. Such a web "
     "is "
     "folded flat when the walls stand at right angles: its diagonal goes to 180°, and the folds at its "
     "sides "
     "to 135° where the corner of the tray is square, so that it stands inside, half way between the walls. "
     "The drawing says no angle of its own for them, and so they are folded so. data-fold-angle says "
     "otherwise."},
});

}  // namespace

std::span<const CodeInfo> folded_codes() { return kFoldedCodes; }

}  // namespace popup
