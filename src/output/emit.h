// The stages' values as JSON, for `--emit`: stable, complete, what golden tests compare.
//
// Common to all: lengths in mm rounded to 1e-6, angles in degrees rounded to 1e-7, directions rounded to
// 1e-9. A point is [x, y] (in the world [x, y, z]), a segment [[x, y], [x, y]], a ring a list of points (the
// last joins the first), a polygon {outer, holes}, a colour "#rrggbb", a place in the source [line, column]
// (from 1; [0, 0]: the whole file). What there is not is null. Plates and pieces are named, not numbered,
// wherever something refers to them. Keys keep their order. Names of members are those of the headers in
// include/popup/, but for the units they carry.
#pragma once

#include <string>

#include "popup/assembly.h"
#include "popup/layout.h"
#include "popup/motion.h"
#include "popup/pattern.h"

namespace popup {

// As docs/assembly.md describes it, and input/assembly/read.h reads it: with the digits of
// assembly/settle.h, so that what is read is the same assembly. Files of pictures are in it.
std::string emit_assembly(const Assembly& assembly);

// {stem, solver: "closed-form" or "iterative", max_closure_error_mm, flat_closed, flat_error_deg,
//  not_forced: as not_forced_json() says, left out where there is nothing of it,
//  examination: as examination_json() says, null when there was none,
//  frames: [{angle_deg, closure_error_mm,
//    plates: [{name, frame: {axes: [x, y, front], origin}, outline: [[x, y, z] …]}]}]}
// Closure errors are rounded to 1e-9 mm. A frame maps a point (x, y) of the plate's page to
// origin + x axes[0] + y axes[1]; `outline` is the outer ring so mapped. `plates` is null at an angle the
// mechanism cannot reach. One plate a line. Cost and length: angles × corners; memory: one angle and the
// text.
std::string emit_motion(const Assembly& assembly, const Motion& motion);

// {pieces: [{name, bounds: [min, max] or null,
//    cuts: [{closed, depth, points}], lines: [{kind, at, plate, glued_on, fold_deg where it is known}],
//    fills: [{plate, color, area: polygon}], strokes: [{plate, points, width_mm, color}], targets: [{plate,
//    outline}], labels: [{kind, text, at, height_mm, angle_deg}], silhouette: [polygon]; targets and their
//    labels that are on backs have on_back: true,
//    images where there are any: as of plates, with plate}]}
std::string emit_pattern(const Pattern& pattern);

// {margin_mm, sheets: [{size_mm, utilisation, used_mm}], leftover_mm: [min, max] or null,
//  placements: [{piece, design, copy, sheet, offset, angle_deg}],
//  designs: [{file, stem, pattern: as in emit_pattern, scaled}]}
// Copies and sheets count from 1, as in the report.
std::string emit_layout(const Layout& layout);

}  // namespace popup
