// The Design as JSON, for `--emit design`; apart from the other stages' values, for those who write these
// know no design.
#pragma once

#include <string>

namespace popup {

struct Design;

// {file, stem, version, unit, width_mm, height_mm, left, right, place,
//  structures: [{id, id_given, type, type_changed, dropped, place,
//    points: [{at, page, place, changed}],
//    fold: {page, begin: {at, page, place, changed}, end: {…}, place},
//    left, right, left_tab, right_tab,
//    arguments: {name: word, number (mm), path data or points}}],   left out when there are none
//  lines: [{page, thickness_pt, color, points: [{at, page, place, changed}], dropped, place}],
//  opens_deg,      left out where it is 180
//  orientation,    left out where it is guessed
//  prints: [{kind: "area", "text" or "image", page, dropped, place, and what that kind has}]}   likewise
// Of a structure on a plate, plate: {page, at: {at, page, place, changed}} stands in place of fold; of one
// whose ground has a name, fold or plate is {on}; of one that names none, page stands in place of fold. Byte
// ranges of the source are left out: they are the reader's own. Numbers are as emit.h has them.
std::string emit_design(const Design& design);

}  // namespace popup
