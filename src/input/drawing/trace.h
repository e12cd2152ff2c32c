// From an SVG document to its flat lines: elements, styles, transforms, units.
#pragma once

#include <optional>

#include "input/xml/locate.h"
#include "parts/tracing.h"
#include "popup/diagnostics.h"
#include "popup/language.h"

namespace popup::drawing {

// More elements than this, or text of tags, that come of use elements are refused: a few of them that use one
// another can stand for any number.
inline constexpr std::size_t kUsedElementsLimit = 1'000'000;
inline constexpr std::size_t kUsedBytesLimit = std::size_t{256} << 20U;
// More variables than this, set by all elements, are refused: a rule with many of them can be for any number
// of elements.
inline constexpr std::size_t kDeclaredVariablesLimit = 1'000'000;

// Walks the whole document; y points up in what it gives. What is not drawn (hidden, texts, images) is told
// of once a kind. Nullopt after an error. No recursion.
std::optional<Tracing> trace(const xml::Located& located, const ReadOptions& options,
                             Diagnostics& diagnostics);

}  // namespace popup::drawing
