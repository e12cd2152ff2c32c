// Colours: what is read is read again as it is written.
#include "input/color.h"

#include <fmt/format.h>

#include "fuzz/targets/target.h"

namespace popup::fuzz {

void look_at_color(std::string_view bytes) {
    // It compares with all names, which takes a hundred times as long as all else.
    if (bytes.size() == 7) nearest_color_name(bytes);
    const auto color = parse_color(bytes);
    if (!color) return;
    const std::string written = fmt::format("#{:02x}{:02x}{:02x}", color->r, color->g, color->b);
    expect(parse_color(written) == color, written + " is the same colour");
}

}  // namespace popup::fuzz
