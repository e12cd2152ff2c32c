#include "motion/codes.h"

#include <array>

namespace popup {
namespace {

constexpr std::array kMotionCodes = std::to_array<CodeInfo>({
    {"across-fold", Severity::warning, "what is glued flat reaches across a fold that closes on it",
     "A plate that is glued flat on another, or turned on it by hand, reaches over a fold of the paper that "
     "it "
     "lies on, and that fold turns to its side. Flat, the plate lies in front of the paper beyond the fold; "
     "folded, it would be behind it, and paper would have to go through paper. The message says which fold "
     "it "
     "is, how far the plate reaches beyond it, and where. A plate that is turned by hand is looked at for "
     "all "
     "its turns, and what is glued down on its way is told of too. End the plate at the fold; or glue it on "
     "the other side of the paper, where the fold turns away from it and it sticks out into the air."},
    {"clearance-low", Severity::warning, "two plates come closer than was asked for",
     "With --clearance LENGTH the examination names plates that come closer to each other than that length "
     "without crossing. Plates that share a fold, a seam or a corner are not meant, nor those that never "
     "move against each other, are only brought together by folding flat, below 45°, or touch when the card "
     "is open. The message gives the smallest distance, and the "
     "angle where it is reached. Real paper is thick, bends, and is cut and glued a little off, so that "
     "such plates may rub or catch. Move the elements further apart, make one of them smaller, or ask for "
     "less."},
    {"collision", Severity::warning, "two plates go through each other",
     "At some opening angle two plates would need the same room. This is looked for at every angle between "
     "the smallest one looked at and 180°, by bounds on how far plates can move, not at samples. Plates "
     "cross where a common point of both lies more than 0.01 mm inside the edges of both, and the paper "
     "round it stands out of the other plate on either side; plates that only touch, along folds, seams, "
     "corners and edges or flat on one another, do not. A plate in whose plane a fold lies goes through the "
     "paper that is folded there, though it only touches either half; that has no depth. The message gives "
     "the first and last angle, and "
     "how deep they are in each other: how far one must move, square to itself or to the other, until they "
     "are apart. Real paper would bend, catch or tear there. Move one of the elements as the hint says, or "
     "make one of them smaller."},
    {"horizon-flat", Severity::remark, "a picture with a horizon lies flat on the open card",
     "The horizon of a picture is levelled where its paper stands up when the card is open: there, lines of "
     "one height have one direction, and the picture is sheared until its rows have it. A plate that lies "
     "flat then, as the base page, straps and what is cut from the page do, has no such direction, so the "
     "picture stays as it was drawn. Leave the horizon out, or print the picture on a piece that stands."},
    {"horizon-upright", Severity::remark, "a picture's rows run too steeply to be levelled",
     "To level its horizon a picture is sheared along the centre fold of its piece, whose points stay. That "
     "cannot turn rows that run along the fold, or nearly so, and pictures are not sheared by more than ten "
     "times their width. The picture stays as it was drawn. Turn it, so that its rows run across the fold, "
     "or leave the horizon out."},
    {"folds-in-order", Severity::remark, "a folded sheet whose folds go one after another",
     "Turned all at once, the panels of this sheet would pass through one another, as the flaps of a box do "
     "that close while its walls still lean; or they are those of a box, and nobody could reach into one "
     "that "
     "closes everywhere at a time. popupc looked for an order in which they do not, and found one; "
     "the message says which panels move in each step, by the names that they have in the model. The motion "
     "shows the steps one after another, and each is certified to be free of collisions as any motion is. "
     "Of panels that lie on one another in the end the smaller is taken to be the inner one, and goes first. "
     "Cartons are folded as packers do it: walls first, then the bottom, and the top or the lid of a tray "
     "last. Flaps that are alike go with those opposite. "
     "What is cut does not change."},
    {"jumps", Severity::error, "an element jumps while the card opens",
     "At some opening angle a plate would have to turn through a large angle at once. Real paper cannot: "
     "the linkage passes from one of its two solutions to the other, its mirror image, or is so close to "
     "locking that a hair's breadth decides. This is looked for all the way from closed to open, not only "
     "at the angles that --angles names. Give it more room: a wider piece, a narrower V, less extreme "
     "angles."},
    {"layer-order", Severity::warning, "the plates of the closed card cannot lie on one another",
     "In the closed card all plates lie in layers between the left cover and the right one. Here there is "
     "no order in which all of them can lie: one lies partly under and partly over another, or several "
     "each lie below the next and the last below the first; the message names them. Paper would have to be "
     "woven, and the card bulges or does not close. Make one of the plates smaller, so that it no longer "
     "reaches over the next, or move its element."},
    {"lies-on-another", Severity::warning, "two elements are in one place",
     "Two plates of two elements lie on one another while the card is open: they are in one plane, and have "
     "more than a square millimetre of it in common, so that one of the two hides the other. Pieces that are "
     "glued flat on one plate, as layers and attached planes are, may lie over one another and are not "
     "meant: "
     "of these glue-overlaps tells what was written twice. Often two tents share their seams, or one was "
     "written twice. The message says which plates it is, how large the place is that they share, and "
     "where its middle is. Move one of the two, as the hint says, which has been tried with all others, or "
     "take one of them out."},
    {"locks", Severity::error, "an element's linkage cannot reach an angle",
     "The sides of the element are too short for the place they are glued to (or, for a v-fold, the angles "
     "of piece and page together exceed 360°), so that the card stops before it is open. This is looked "
     "for all the way from closed to open, not only at the angles that --angles names; the message gives "
     "one that cannot be reached. Widen the piece, or bring its seams closer to the fold."},
    {"not-flat", Severity::error, "a plate is not flat when the card is closed",
     "At the closed card every plate must lie in one plane, or the card does not shut. An element of this "
     "design does not fold flat; usually its angles were taken as they are because a repair was not "
     "allowed."},
    {"not-forced", Severity::remark, "the opening does not force where a plate is",
     "Every fold and seam of these plates holds, and still they can be pushed to and fro while the card "
     "stands "
     "still: the loops of folds and seams leave so many ways open. This is known from the rank of the "
     "equations by which the loops close, at three openings, and not from the names of elements. The model "
     "shows one of the motions that the plates may have, and the examination for collisions knows only that "
     "one; in paper, gravity, stiff folds and whoever opens the card decide. What is meant to be moved by "
     "hand "
     "needs nothing. A further wall that is parallel to those that are there, and as high, forces nothing, "
     "because it leans over with them; and what stands on one of its folds moves as that fold does, unless "
     "the "
     "fold is slit: a v-fold across a slit holds both its sides. In a document nothing can be glued to a "
     "second "
     "element. So take a box, a tent or a step in place of a floating layer, keep it from leaning by what "
     "stands close to it, or accept the remark with --allow not-forced. An assembly can have one linkage "
     "more "
     "for each way, such as a wall of another height between the ground and the plate. A plate that turns "
     "about one line only wants a second edge glued."},
    {"opens-too-little", Severity::error, "a card that would open before it begins",
     "The sweep of an assembly says at which opening its motion begins. --opens says where it ends, and that "
     "is not beyond the beginning, so there would be no motion. Ask for a larger opening, or change the "
     "sweep in the assembly."},
    {"protrusion", Severity::warning, "a plate sticks out of the closed card",
     "When the card is closed, every plate should lie between its covers. This one reaches over their "
     "edge: the message says how far, and on which side. It will be seen there before the card is opened, "
     "and bent and torn in its envelope. Make the plate smaller by as much, or move the element away from "
     "that edge. A move or a size that a hint names was tried, and keeps the element inside. Where it is "
     "meant, --allow protrusion accepts it."},
    {"seam-open", Severity::error, "a fold or seam comes apart while the card opens",
     "At one of the sampled angles two plates that share a line no longer meet along it. Paper cannot do "
     "that: the geometry is so extreme that rounding decides. Make the angles and widths of the element "
     "larger."},
    {"undecided", Severity::remark, "it is not decided whether two plates cross",
     "The examination divides the range of angles until it can prove that two plates are clear of each "
     "other, or finds where they cross. Between the angles in the message it could do neither within the "
     "work allowed, mostly because the plates graze each other there by less than can be told apart. "
     "Nothing is claimed of these two plates at these angles. Look at them in the model, or move one of "
     "them by a tenth of a millimetre and check again."},
});

}  // namespace

std::span<const CodeInfo> motion_codes() { return kMotionCodes; }

}  // namespace popup
