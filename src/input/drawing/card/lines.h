// The lines of a drawing that is a card: what each is, found by the cascade of rules, names, colours, dashes
// and the outline.
#pragma once

#include <string>
#include <vector>

#include "parts/tracing.h"
#include "popup/diagnostics.h"

namespace popup::drawing::card {

// What a line is drawn for; of edges where several lie on each other a set.
enum Ink : unsigned {
    kCut = 1U,
    kMountain = 2U,
    kValley = 4U,
    kFold = 8U,   // that does not say which way
    kHole = 16U,  // a cut around what is to fall out
};
inline constexpr unsigned kAnyFold = kMountain | kValley | kFold;

struct CardLine {
    std::vector<Vec2> points;  // in mm of the drawing, y up
    bool closed = false;
    unsigned ink = kCut;  // one of Ink
    int element = 0;      // index into Tracing::elements
};

struct CardLines {
    std::vector<CardLine> lines;
    std::vector<const TracedLine*> printed;
};

// Sorts the lines of a drawing, which must outlive the result. Rules and names come first, then colours: red
// mountain, blue valley, magenta fold, yellow nothing (in the notation `workshop` dashed blue is mountain and
// dashed magenta valley); then dashes, of which all are folds and those with
// dots are mountains. What is left is cut, and so is all that is drawn as the drawing's frame is. Each guess
// is a `line-meaning` remark with how many lines it took.
CardLines card_lines(const Tracing& tracing, Diagnostics& diagnostics);

// A point of a drawing in words, from its upper left corner: "(12.00, 30.50) mm".
std::string shown_point(const Tracing& tracing, Vec2 at);

}  // namespace popup::drawing::card
