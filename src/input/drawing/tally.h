// What a drawing has that is not cut: told of once a kind, with how many there are and where the first is.
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "input/drawing/style.h"
#include "popup/diagnostics.h"

namespace popup::drawing {

class Tally {
 public:
    void skipped(std::string_view tag, Place place) { count(skipped_, tag, place); }  // texts, images
    void clipped(Place place) { count(clipped_, "", place); }  // by a clip path or mask, which is not applied
    void hidden(Place place) { count(hidden_, "", place); }
    void unknown(std::string_view tag, Place place) { count(unknown_, tag, place); }
    // Strokes in a colour that is not read, and so taken for black.
    void color(std::string_view text, Place place) { count(colors_, text, place); }
    // Variables that a value needs, and that no element around sets.
    void not_set(std::string_view name, Place place) { count(variables_, name, place); }
    // Properties of style="…" and of style sheets that place shapes.
    void not_read(std::string_view name, Place place) { count(not_read_, name, place); }
    // Fills with gradients, patterns and colours that are not read.
    void fill(Place place) { count(fills_, "", place); }
    // `strict`: elements that are not known are errors.
    void tell(bool strict, Diagnostics& diagnostics) const;

 private:
    struct Row {
        int count = 0;
        Place first;
    };
    using Rows = std::map<std::string, Row, std::less<>>;
    static void count(Rows& rows, std::string_view kind, Place place);
    Rows skipped_, clipped_, hidden_, unknown_, colors_, variables_, not_read_, fills_;
};

// What of the style sheets of a drawing is not read. `before`: the text before its root.
void tell_style_sheets(const StyleSheet& sheet, std::string_view before, Place root,
                       Diagnostics& diagnostics);

}  // namespace popup::drawing
