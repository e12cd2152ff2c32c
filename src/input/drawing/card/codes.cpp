#include "input/drawing/card/codes.h"

#include <array>

namespace popup {
namespace {

constexpr std::array kDrawnCardCodes = std::to_array<CodeInfo>({
    {"card-of-no-elements", Severity::remark, "a drawn card that is folded as it is drawn",
     "Not all of this card can be told by elements, the words of popup documents: it has flaps that stand up "
     "at a fold, figures taller than what they stand on, strips that share a cut, or a front on columns. All "
     "its folds run along the gutter, though, and everything stays parallel to one half of the page as it "
     "opens, so it is made, examined and shown as it is drawn. A document cannot be written of it; change "
     "the "
     "drawing to change the card."},
    {"cut-beyond-fold", Severity::warning, "an outline that goes on beyond the folds that hold it",
     "The outline of a feature is drawn as one closed cut, with its side folds inside of it. Cut so, nothing "
     "would hold it in the card, and it would fall out. What lies beyond the side folds is therefore not cut "
     "and stays with the page, as the Foldlings do it. End the outline at its side folds to say the same in "
     "the drawing."},
    {"cut-on-fold", Severity::warning, "a cut that is drawn on a fold",
     "A stretch of a fold is drawn as a cut as well, and the cut encloses nothing. The sheet can have one of "
     "them there: the fold stayed, and the cut was left out. Draw the cut beside the fold if it is to part "
     "something; if the fold is to be slit, end the fold where the slit begins. What is cut all around may "
     "have folds drawn on its outline, and is not meant."},
    {"end-moved", Severity::warning, "an end of a line that misses what it meets",
     "A cut or a fold ends up to half a millimetre before, behind or beside the line that it was meant to "
     "meet. The end was moved: along its own line where that meets the other, or to where two loose ends "
     "meet. The message has the place and the size. Switch on snapping in the drawing program and draw the "
     "line to the other; ends that miss by more are not moved."},
    {"fold-added", Severity::warning, "a feature whose middle fold is not drawn",
     "A feature has three folds: one on either side that holds it, and one in the middle, which lets it "
     "fold. "
     "The drawing has the two outer ones and the cuts between them. The middle fold was added: as far from "
     "the "
     "one side fold as the other side fold lies from the fold that the feature stands on, which alone folds "
     "flat. Draw it, so that drawing and sheet are the same."},
    {"fold-drawn-on", Severity::warning, "a fold that is drawn on through what stands on it",
     "A fold is interrupted where a feature stands on it: between the feature's cuts the paper moves out of "
     "the fold. This one is drawn as a whole line, so that the sheet would be folded in a plane that must "
     "stay flat. The same holds where a flap or a figure goes on over the fold. The stretch between the cuts "
     "was left "
     "out; leave it out of the drawing, too."},
    {"fold-other-way", Severity::warning, "folds drawn as valleys that are mountains, or the other way",
     "Which way a fold of a pop-up goes follows from the others: the folds that hold a feature go the way of "
     "the fold that it stands on, and its middle fold goes the other way. Some folds of the drawing have the "
     "colour, the dashes or the layer of the other kind. They were taken for what they must be. See whether "
     "the lines are drawn as they should be, or say with --lines what is what."},
    {"fold-straightened", Severity::warning, "folds that lie beside where they can fold",
     "A feature folds flat only where its middle fold lies as far from the one side fold as the other side "
     "fold lies from the fold it stands on, or where its folds meet in one point of that fold. The folds as "
     "drawn are off by up to half a millimetre. They were moved to where they fold; the message has by how "
     "much. Draw them there, with the numbers of the message."},
    {"folds-exchanged", Severity::remark, "mountain and valley folds that are the other way round",
     "All folds of the drawing are drawn as the opposite of what they are when the card is seen from the "
     "side "
     "to which it opens: the gutter as a mountain fold. Some people and programs use the colours that way, "
     "and some draw the back of the sheet. The card is made as seen from the front; mirror the drawing if it "
     "shows the back."},
    {"folds-found", Severity::remark, "an outline across a fold without its own folds",
     "A closed outline that lies across a fold is a feature that pops up. This one has no folds inside that "
     "say where it is held, so they were found: where it is two millimetres wide, seen from its far ends. "
     "Draw the folds to have them elsewhere. If the outline is a hole that goes over the fold, end the fold "
     "at "
     "it, or say so with the name of its layer, class or id: hole or window."},
    {"gutter-off-middle", Severity::error, "a gutter that is not in the middle of the page",
     "The two halves of a card are equally wide, so that they lie on each other when it is closed. The fold "
     "that goes from edge to edge lies more than half a millimetre beside the middle of the border. Move the "
     "fold, or the border of the page, until both halves are the same."},
    {"hole-beside-fold", Severity::remark, "a closed cut with a side on a fold",
     "A side of this closed cut lies on a fold. What is cut all around falls out, so it is a hole that ends "
     "at the fold, as a door does that reaches down to the ground. Leave that side out of the cut if the "
     "paper is to stay, and hang on the fold. If it is meant as a hole, a layer, class or id called hole or "
     "window says so, and nothing is told."},
    {"hole-over-fold", Severity::remark, "an outline across a fold that is a hole",
     "A closed outline that lies across a fold is a feature that pops up if there are folds in it: its own, "
     "or "
     "the fold that it lies across, drawn on through it. This one has none, so it is cut out and falls out, "
     "as "
     "a window over a corner does. Draw the folds that hold it if it is to pop up."},
    {"island", Severity::warning, "something drawn in a hole",
     "A hole falls out with all that lies in it, so what is drawn there can neither be cut nor fold. It was "
     "left out. Join it to the paper around it by a bridge that is not cut, or take it out of the drawing."},
    {"line-meaning", Severity::remark, "lines whose meaning was guessed",
     "What the lines of a drawing are is told by rules of --lines, by the names of layers, classes and ids, "
     "by colours (red mountain, blue valley, magenta fold, yellow nothing) and by dashes, in this order; "
     "lines drawn as the border of the page and all others are cuts. Each kind that was guessed is told "
     "once, "
     "with how many lines it took. Say with --lines what is meant where the guess is wrong."},
    {"may-be-card", Severity::remark, "a folded sheet that may be a pop-up card",
     "DXF drawings whose layers say what is cut and what is folded are read as folded sheets, each fold of "
     "which goes its own way. This one has a page, a fold through its middle and nothing but what pop-up "
     "cards "
     "are made of, so that it may be meant as one: then --as card reads it, and shows how it opens, what "
     "collides and what sticks out. --as folded says that it is a folded sheet."},
    {"no-gutter", Severity::error, "a drawn card without a fold in its middle",
     "A card is a page that folds in its middle, and its gutter is a fold from the middle of one side of the "
     "page to that of the opposite side, interrupted only by what stands on it. None is there, or it has a "
     "gap beside all features. Draw it dashed, in the colour of folds or on a layer called folds, from edge "
     "to edge; or say with --lines which lines are folds."},
    {"no-page", Severity::error, "a drawn card without a border",
     "The border of a drawn card is what surrounds everything else: a closed rectangle of cuts. The drawing "
     "has no line that encloses anything, or what encloses most has folds for sides; so it is not known how "
     "large the page is. Draw the page's border, or let the lines that make it end at one another; ends that "
     "miss by more than half a millimetre are not joined."},
    {"not-understood", Severity::error, "lines of a drawn card that make nothing that pops up",
     "The lines at this place of the drawing cut or fold something that no element of one sheet is: a flap "
     "that nothing moves, folds that do not close flat, a cut that ends in the paper, or an outline over "
     "several folds. A sheet without them would be another than the drawn one, so none is made. Mend the "
     "lines as the message says, or take them out of what is read: --lines ignore=#rrggbb."},
    {"outside-page", Severity::warning, "elements outside of the page",
     "A drawing is read as one card, and its page is what surrounds the largest area. These elements lie "
     "outside of it, as notes or second cards do, and are no part of the card. Put each card into a drawing "
     "of its own, and notes on a layer called notes, or on a hidden one."},
    {"page-mended", Severity::warning, "a page whose border or gutter is slightly off",
     "The border of the page is a rectangle with the gutter in its middle. The drawn lines are off by up to "
     "half a millimetre; they were moved to where they should be. The message has the place and the size. "
     "Draw the page with numbers, or align its lines in the drawing program."},
    {"page-not-rectangle", Severity::error, "a border that is no rectangle, or no page's size",
     "The page of a card is a rectangle, and the border of this drawing has other corners, or none; or it is "
     "larger or smaller than pages are. Cards with rounded or shaped borders cannot be made of a drawing. "
     "Draw "
     "a rectangle around everything, and let no line leave it; holes near the edge may shape the paper "
     "within "
     "it."},
});

}  // namespace

std::span<const CodeInfo> drawn_card_codes() { return kDrawnCardCodes; }

}  // namespace popup
