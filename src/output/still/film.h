// Pictures one after another, and files of them.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "output/png.h"

namespace popup::still {

struct Film {
    int width = 0, height = 0;
    std::vector<Pixels> pictures;  // all of that size
    struct Frame {
        std::size_t picture = 0;
        int ms = 0;  // how long it is shown, > 0
    };
    std::vector<Frame> frames;  // shown again and again; at least one
};

// Return false if the library fails, for lack of memory or because a side is too long for the format.
bool to_webp(const Film& film, std::string& bytes);
bool to_gif(const Film& film, std::string& bytes);

}  // namespace popup::still
