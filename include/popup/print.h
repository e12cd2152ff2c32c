// Print: what is painted on paper, and never cut or folded.
//
// One notion for all stages: plates and pieces of an Assembly carry it, a Pattern hands it on, writers paint
// it. Coordinates are those of the page it lies on, in millimetres, y up.
//
// Order of painting, on sheets and on models: first areas and images, over them strokes, over these texts;
// things of one kind in the order of their list, a later one over an earlier one.
//
//   Plate plate;
//   plate.prints.push_back(Area{{{{0, 0}, {20, 0}, {0, 20}}, {}}, Color{255, 204, 0}});
//   plate.prints.push_back(Stroke{{{0, 0}, {20, 0}}, 0.5, Color{0, 0, 0}});
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "popup/diagnostics.h"
#include "popup/geometry.h"

namespace popup {

struct Color {
    std::uint8_t r = 255;
    std::uint8_t g = 255;
    std::uint8_t b = 255;
    friend bool operator==(const Color&, const Color&) = default;
};
// "#rrggbb", lower case.
std::string to_string(Color color);
// The colour of "#rrggbb", in either case; nullopt when it is not that.
std::optional<Color> hex_color(std::string_view text);

// An area that is printed, without a line around it.
struct Area {
    Polygon shape;
    Color color;
};

// A line that is drawn, with round ends and corners.
struct Stroke {
    std::vector<Vec2> points;  // at least two
    double width_mm = 0.0;     // ≥ 0
    Color color;
};

// The fonts that texts are set in, all of DejaVu, so that no output depends on what a system chooses.
enum class TextFont { sans, sans_bold, serif, serif_bold, mono, mono_bold };
inline constexpr std::array<std::string_view, 6> kTextFontNames{"sans",       "sans-bold", "serif",
                                                                "serif-bold", "mono",      "mono-bold"};
// "serif-bold".
constexpr std::string_view to_string(TextFont font) {
    return kTextFontNames.at(static_cast<std::size_t>(font));
}

// A line of text. `at` is its middle: half its length, half the height of its capitals.
struct Text {
    std::string text;  // UTF-8; writers replace what is not
    Vec2 at;
    double height_mm = 4.0;  // of the capitals, > 0
    double angle = 0.0;      // radians, counter-clockwise
    // Of a text that is a part of the picture: it is drawn in this colour, as strokes are, and models show
    // it. None: a note for who builds the piece, in the colour that the profile has for labels.
    std::optional<Color> color = {};
    TextFont font = TextFont::sans;
};

enum class ImageFormat { png, jpeg };

// p ↦ origin + p.x * x + p.y * y.
struct Affine {
    Vec2 x{1.0, 0.0};
    Vec2 y{0.0, 1.0};
    Vec2 origin;
    [[nodiscard]] Vec2 point(Vec2 p) const { return origin + p.x * x + p.y * y; }
    friend bool operator==(const Affine&, const Affine&) = default;
};

// The horizon of a picture, before it is levelled: level_horizons() of popup/motion.h takes it away.
struct Horizon {
    std::optional<double> row;        // of the picture, 0 its lower edge, 1 its upper one; none: all of them
    std::optional<double> height_mm;  // above the open card; none: where it is on the fold
    int number = 0;                   // the same of all copies of one picture on the plates of a piece
    Place place;                      // of the picture in the source
};

struct ImagePixels;  // popup/image.h

// A picture. Its file is kept as it is and shared by all copies, so that cutting a picture at folds costs
// nothing, and writers that can put the file itself into theirs lose nothing.
struct Image {
    std::shared_ptr<const std::string> bytes;  // never null; a whole file of the format
    ImageFormat format = ImageFormat::png;
    int width = 0;  // pixels, > 0, as the file has them
    int height = 0;
    // From pixels to the page: pixels count from the upper left corner of the picture, x to the right and y
    // down, each a square of side 1. Not degenerate.
    Affine place;
    // What of the picture is to be seen, as regions of the page that do not overlap; empty: all of it.
    std::vector<Polygon> clip;
    // Set of pictures that are still to be levelled. Then `place` and `clip` are as they were drawn, and
    // plates of the page have the picture that it does not reach yet.
    std::optional<Horizon> horizon = {};
    // Those of the file, where they were kept when it was opened; null: pixels_of() decodes it.
    std::shared_ptr<const ImagePixels> pixels = {};
};

// What is printed.
using Print = std::variant<Area, Stroke, Text, Image>;

}  // namespace popup
