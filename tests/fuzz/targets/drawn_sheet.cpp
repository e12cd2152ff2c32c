// SVG drawings as sheets with cuts and folds, of which nothing else is known.
#include "fuzz/targets/target.h"

namespace popup::fuzz {

void look_at_drawn_sheet(std::string_view bytes) {
    ReadOptions options;
    options.drawing.as = DrawnAs::folded;
    look_at_design("fuzz.svg", bytes, options);
}

}  // namespace popup::fuzz
