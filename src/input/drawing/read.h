// Drawings as input languages: SVG, and what all formats of drawings share.
#pragma once

#include <optional>
#include <string_view>

#include "parts/flat_parts.h"
#include "parts/tracing.h"
#include "popup/language.h"

namespace popup::drawing {

// The row's functions, as language.h promises them. Every outermost closed contour is a part, with what lies
// in it; see "Drawings" in popupc(1). The origin is the drawing's lower left corner. Errors, located: those
// of XML, `bad-number`, `bad-path`, `bad-transform`, `bad-reference`, `no-contours`, `contours-overlap`,
// `document-too-large`.
std::optional<FlatParts> read_parts(const Source& source, const ReadOptions& options,
                                    Diagnostics& diagnostics);
// The flat lines of a drawing, whatever they mean; nullopt after an error.
std::optional<Tracing> read_tracing(const Source& source, const ReadOptions& options,
                                    Diagnostics& diagnostics);
// A drawing of any format as flat parts.
std::optional<Assembly> flat_assembly(Tracing&& tracing, Diagnostics& diagnostics);
// What a drawing shows where nobody says it.
DrawnAs shown_by(const Tracing& tracing);
bool recognises(std::string_view text);

}  // namespace popup::drawing
