// What could not be seen on dark paint or pictures, made visible: numbers, names, folds and places for glue.
#pragma once

#include <cstddef>

#include "output/sheet_drawing.h"

namespace popup {

// How well two colours can be told apart, from 1 (not at all) to 21 (black on white): the contrast ratio of
// the Web Content Accessibility Guidelines 2.1, "relative luminance".
double contrast(Color a, Color b);

// Makes the labels, folds and glue targets of one piece seen on what is painted there. A label whose colour
// has a contrast below 4.5 with the area that it lies on becomes black or white; where neither would do,
// and on pictures, a white area is put under it, and so it is under folds and targets below 3. Such areas
// are painted over areas and pictures, and under all else; not in SVG, which is read again.
// `folds_printed`: else a machine makes them, and they need none. The piece's shapes and texts are those
// from `first_shape` and `first_text` to the end. Cost: nothing where it has no such areas; else linear in
// its labels and lines, times the areas and pictures of the piece.
void put_halos(SheetDrawing& drawing, std::size_t first_shape, std::size_t first_text, bool folds_printed);

}  // namespace popup
