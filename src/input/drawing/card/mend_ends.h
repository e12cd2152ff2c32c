// Ends of lines that miss what they mean to meet.
#pragma once

#include <optional>
#include <vector>

#include "input/drawing/card/sheet_graph.h"
#include "popup/diagnostics.h"

namespace popup::drawing::card {

// Ends are moved by no more than this, in mm.
inline constexpr double kSnapMm = 0.5;
// Of moves up to this, in mm, nothing is said: it is the rounding of a drawing.
inline constexpr double kSilentMm = 0.02;

// Moves ends that lie at no other line, by kSnapMm at most: two loose ends to where their lines meet, one end
// along its line to what it stops short of or runs over, else to what is nearest. Each is an `end-moved`
// repair with its place and size. Returns the graph of the lines, and appends to `moves` from where to where
// ends have moved; nullopt after an error (`document-too-large`).
std::optional<SheetGraph> mend_ends(const Tracing& tracing, std::vector<CardLine>& lines,
                                    std::vector<Segment>& moves, Diagnostics& diagnostics);

}  // namespace popup::drawing::card
