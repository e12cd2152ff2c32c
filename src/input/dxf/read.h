// DXF drawings as an input language.
#pragma once

#include <optional>
#include <string_view>

#include "parts/tracing.h"
#include "popup/diagnostics.h"
#include "popup/files.h"
#include "popup/language.h"

namespace popup::dxf {

// The flat lines of an ASCII DXF file of R12 to 2018, whatever they mean: LINE, ARC, CIRCLE, ELLIPSE,
// LWPOLYLINE, POLYLINE and SPLINE of model space, and blocks where an INSERT puts them. What is a fold is
// said by layers, colours and line types, in the cascade of drawings. y runs up, and the drawing is seen from
// the side to which z runs. Curves become cubics, and these chords, as those of SVG.
//
// Units are those of $INSUNITS, else inches where $MEASUREMENT says so, else millimetres (remark `dxf-unit`).
// Errors, located: `dxf-binary`, `empty-input`, `dxf-syntax`, `dxf-curve`, `bad-number`, `bad-reference`,
// `document-too-large`. Cost: linear in groups, and in entities of blocks as often as they are put.
std::optional<drawing::Tracing> read_tracing(const Source& source, const ReadOptions& options,
                                             Diagnostics& diagnostics);
// True of a text that begins as a DXF file, or is a binary one.
bool recognises(std::string_view text);

}  // namespace popup::dxf
