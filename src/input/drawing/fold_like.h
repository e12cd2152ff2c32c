// Lines of a drawing of flat parts that look like folds.
#pragma once

#include "parts/tracing.h"
#include "popup/diagnostics.h"

namespace popup::drawing {

// True of drawings with the colours of Origami Simulator: red or green lines beside outlines of another
// colour, and no dashed magenta.
bool has_simulator_colors(const Tracing& tracing);

// True where a line is a fold by a rule or a name, or looks like one.
bool has_folds(const Tracing& tracing);

// A `folds-as-cuts` warning for those that are cuts: called folds, dashed, or red, blue or magenta beside
// outlines of another colour, whether these are closed or made of open lines. Another for dashed black ones,
// which are seams, in drawings without folds of this program's notation. Both name the options that read
// them. Cost: near linear.
void tell_fold_like(const Tracing& tracing, Diagnostics& diagnostics);

}  // namespace popup::drawing
