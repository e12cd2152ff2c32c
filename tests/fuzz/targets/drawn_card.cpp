// SVG drawings as sheets of pop-up cards, whose elements are found.
#include "fuzz/targets/target.h"

namespace popup::fuzz {

void look_at_drawn_card(std::string_view bytes) {
    ReadOptions options;
    options.drawing.as = DrawnAs::card;
    look_at_design("fuzz.svg", bytes, options);
}

}  // namespace popup::fuzz
