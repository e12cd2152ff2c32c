// From a DXF file to its flat lines: blocks where they are put, layers, units.
#pragma once

#include <optional>

#include "input/dxf/document.h"
#include "parts/tracing.h"
#include "popup/diagnostics.h"
#include "popup/language.h"

namespace popup::dxf {

// More entities than this that come of blocks are refused: a few of them that put one another can stand for
// any number.
inline constexpr int kPutEntitiesLimit = 1'000'000;
// Drawings that begin further from their origin than this, in mm, are moved to it, by whole mm.
inline constexpr double kFarOffMm = 1e4;

// Everything that is drawn in model space. What is not (texts, dimensions, layers that are off) is told of
// once a kind. Nullopt after an error. No recursion.
std::optional<drawing::Tracing> trace(const Document& document, const ReadOptions& options,
                                      Diagnostics& diagnostics);

}  // namespace popup::dxf
