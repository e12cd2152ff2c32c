// The lines of a drawing that is a card: what each is, found by the cascade of rules, names, colours, dashes
// and the outline.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/geometry/sheet_graph.h"
#include "parts/tracing.h"
#include "popup/diagnostics.h"

namespace popup::drawing::card {

struct CardLines {
    std::vector<SheetLine> lines;             // in mm of the drawing, y up; elements are those of the tracing
    std::vector<const TracedLine*> drawn_by;  // by line
    std::vector<const TracedLine*> printed;
};

// Sorts the lines of a drawing, which must outlive the result. Rules and names come first, then colours: red
// mountain, blue valley, magenta fold, yellow nothing (in the notation `workshop` dashed blue is mountain and
// dashed magenta valley); then dashes, of which all are folds and those with
// dots are mountains. What is left is cut, and so is all that is drawn as the drawing's frame is. Each guess
// is a `line-meaning` remark with how many lines it took.
CardLines card_lines(const Tracing& tracing, Diagnostics& diagnostics);

// Moves ends that miss what they mean to meet (base/geometry/mend_ends.h), and gives the graph of the lines.
// Each is an `end-moved` repair with its place and size; where they were and are is appended to `moves`.
// Nullopt after an error (`document-too-large`).
std::optional<SheetGraph> join_ends(const Tracing& tracing, std::vector<SheetLine>& lines,
                                    std::vector<Segment>& moves, Diagnostics& diagnostics);

// The lines that a graph was made of, without what drew some of its folds: edges. Cost: edges times folds.
std::vector<SheetLine> without(const std::vector<SheetLine>& lines, const SheetGraph& graph,
                               const std::vector<int>& edges);

}  // namespace popup::drawing::card
