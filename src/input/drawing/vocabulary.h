// The words of drawings: what elements are to the reader, and the notation of lines.
#pragma once

#include <optional>
#include <string_view>

#include "input/drawing/style.h"
#include "input/xml/locate.h"
#include "parts/tracing.h"

namespace popup::drawing {

enum class Role {
    shape,
    container,
    use,
    skipped,  // drawn, but no outline: texts, images
    silent,   // draws nothing where it stands: definitions, metadata
    unknown,
};
Role role_of(std::string_view tag);

// What stands before the names of a drawing's elements, "" or such as "svg:". Nullopt if its root is no svg.
std::optional<std::string_view> svg_prefix(const xml::Located& located);

// The layers of a sheet that this program writes (output/sheet_drawing.h); `machine`: one that a profile
// names.
enum class Layer { none, fill, draw, glue, label, valley, mountain, seam, cut, machine };
Layer layer_named(std::string_view name);

// What a stroke means: a dashed one in the colour of a fold is that fold, any other is a cut. The colours are
// those of the notation `workshop` (output/sheet_drawing.h).
Use use_of(const Style& style);

}  // namespace popup::drawing
