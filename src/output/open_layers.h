// What lies on the pages of an open card: pictures tell it apart from them.
#pragma once

#include <span>
#include <vector>

#include "popup/assembly.h"

namespace popup {

// Between a page and what lies on it, and between what lies there, in pictures of an open card.
inline constexpr double kOpenLayerMm = 0.1;
// From so far before the card is open on, pictures raise what will lie on its pages.
inline constexpr double kOpenedDeg = 2.0;

struct OpenLayer {
    int page = -1;    // the plate of the assembly's covers on which it lies; -1: it lies on none
    double mm = 0.0;  // how far pictures raise it, along the front of that page
};

// By plate: where it lies when the card is as far open as it gets. What is higher a degree before lies on
// what is lower then. Plates that are glued on others lie on none: they go with those. Empty: nothing lies on
// a page. What lies there beside all other paper, as the steps of a card of one sheet, lies on none. Cost:
// two placings, near linear in corners, and in pairs of plates that touch on a page, of which 200 000 are
// looked at; a look at the box of each hole of the page for each plate that lies there.
std::vector<OpenLayer> open_layers(const Assembly& assembly);

// How much of that is to be seen in this state, 0 to 1: all of it when the card is open.
double share_of_open(const Assembly& assembly, std::span<const Frame> frames);

}  // namespace popup
