// A design of webOAcard as its file has it: a card of one sheet, and what is to stand on it.
//
// The file is JSON: {"settings": {"cardW": 120, "cardH": 100}, "faces": [...]}. Each face is an area of the
// unfolded sheet that stands parallel to the back when the card is open by 90°. Numbers are millimetres: its
// author's own cards are 120 and 89 wide, and nothing in the file says otherwise.
//
// In the file X runs along the gutter from 0 to cardW, Y down the sheet: -cardH is the upper edge of the
// back, 0 the gutter, cardH the front edge of the floor. Here a point is (Y, X - cardW / 2), which is the
// sheet turned counter-clockwise by a quarter: x to the right over the gutter from back to floor, y along it.
#pragma once

#include <optional>
#include <vector>

#include "popup/diagnostics.h"
#include "popup/files.h"
#include "popup/geometry.h"
#include "popup/language.h"

namespace popup::oa {

enum class Mode {
    face,  // stands, and a horizontal plate runs back from its upper edges
    hole,  // is cut out of faces and pulls that stand as far out or less
    pull,  // stands, and nothing runs back from its outer edges
};

struct Contour {
    std::vector<Polygon> area;  // what it encloses, not empty
};

struct Face {
    int number = 0;  // in the list of faces, from 0
    Mode mode = Mode::face;
    // From the back, as the card stands open by 90°: 0 < depth <= the height of the card.
    double depth = 0.0;
    // It is a text ("contoursType": "expolygons"): of each contour only the topmost edge holds a plate.
    bool text = false;
    double timestamp = 0.0;  // when it was made; 0: not known
    std::vector<Contour> contours;
    Place place;  // in the file
};

struct Card {
    double width = 0.0;       // along the gutter, > 0
    double height = 0.0;      // of the back, and of the floor, > 0
    std::vector<Face> faces;  // by number

    [[nodiscard]] Place place_of(int face) const;  // of none where there is no such face
};

// Reads the file. Coordinates stand on the grid of base/geometry/regions.h. Errors, located: `oa-syntax`,
// `oa-value`, `document-too-large`. Warnings: `unknown-member` (strict: an error), `contour-crosses-itself`,
// `oa-contour-empty`, `oa-depth`; contours and faces that they concern are mended, or have no area.
std::optional<Card> read_card(const Source& source, const ReadOptions& options, Diagnostics& diagnostics);

}  // namespace popup::oa
