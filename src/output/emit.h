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
#include "popup/design.h"
#include "popup/layout.h"
#include "popup/motion.h"
#include "popup/pattern.h"

namespace popup {

// {file, stem, version, unit, width_mm, height_mm, left, right, place,
//  structures: [{id, id_given, type, type_changed, dropped, place,
//    points: [{at, page, place, changed}],
//    fold: {page, begin: {at, page, place, changed}, end: {…}, place},
//    left, right, left_tab, right_tab,
//    arguments: {name: word, number (mm), path data or points}}],   left out when there are none
//  lines: [{page, thickness_pt, color, points: [{at, page, place, changed}], dropped, place}]}
// Of a structure on a plate, plate: {page, at: {at, page, place, changed}} stands in place of fold.
// Byte ranges of the source are left out: they are the reader's own.
std::string emit_design(const Design& design);

// {file, stem,
//  pieces: [{name, plates}],
//  plates: [{name, piece, outline: polygon, fill, strokes: [{points, width_mm, color}], parent, pivot}],
//  lines: [{kind, at, piece, plate, other_plate}],
//  hinges: [{a, b, a_line, b_line, glued}],
//  glue: [{piece_plate, base_plate, on_piece, on_base, label, fill, element, place}],
//  joints: [{kind, name, place, and what fields() of the kind in popup/joints.h names}],
//  sweep: {from_deg, to_deg, closed_flat}, covers: [names of plates]}
std::string emit_assembly(const Assembly& assembly);

// {stem, solver: "closed-form" or "iterative", max_closure_error_mm, flat_closed, flat_error_deg,
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
//    outline}], labels: [{kind, text, at, height_mm, angle_deg}], silhouette: [polygon]}]}
std::string emit_pattern(const Pattern& pattern);

// {margin_mm, sheets: [{size_mm, utilisation, used_mm}], leftover_mm: [min, max] or null,
//  placements: [{piece, design, copy, sheet, offset, angle_deg}],
//  designs: [{file, stem, pattern: as in emit_pattern, scaled}]}
// Copies and sheets count from 1, as in the report.
std::string emit_layout(const Layout& layout);

}  // namespace popup
