// Pictures become outlines: from pixels to smooth curves that a machine can cut.
//
//   std::variant<Image, ImageFault> opened = open_image(bytes_of_a_file);              // popup/image.h
//   const PixelMask mask = mask_of(*pixels_of(std::get<Image>(opened)), {});
//   TraceOptions options;
//   options.pixel_mm = 80.0 / mask.width;                                               // 80 mm wide
//   if (const auto traced = trace_outlines(mask, options, diagnostics)) svg_of(*traced);
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "popup/diagnostics.h"
#include "popup/image.h"
#include "popup/path.h"

namespace popup {

// What of a picture is the figure, and what is the ground around it.
struct PixelMask {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> inside;  // rows from the top; 1 belongs to the figure, 0 does not
    bool by_alpha = false;             // opacity told them apart, else brightness
    bool few_clear = false;            // brightness, though some pixels are clear
    int threshold = 0;                 // 1 to 255: which value did
    bool even = false;                 // all pixels have the same value: no threshold could be found
};

struct MaskOptions {
    // 1 to 255. Pixels at least as opaque are the figure; or, where the whole picture is opaque, or less than
    // a hundredth of it is clear and what is opaque is dark here and light there, pixels that are darker.
    // Without: 128 for opacity; for brightness the threshold that separates two classes best (N. Otsu, "A
    // threshold selection method from gray-level histograms", 1979), in the middle of those that do so
    // equally well.
    std::optional<int> threshold;
    bool invert = false;  // the ground is the figure
};
// Precondition: the pixels are those of a picture with at least one. Brightness is
// (299 r + 587 g + 114 b) / 1000, rounded down, on white where a pixel is not opaque. Cost: linear in pixels.
PixelMask mask_of(const ImagePixels& pixels, const MaskOptions& options);

struct TraceOptions {
    double pixel_mm = 25.4 / 300.0;  // width and height of a pixel; more than 0
    // How far the outline may stray for the sake of smoothness, beyond the steps of pixels; at least 0.01.
    double simplify_mm = 0.1;
    double min_feature_mm = 1.0;  // shapes and holes with less area than a square of this side are dropped
    bool largest = false;         // of several shapes that with the most paper alone is kept
};

// One piece of paper. Its first subpath is its outline, counter-clockwise; the others are its holes,
// clockwise. All are closed.
struct TracedShape {
    Path path;
    double area_mm2 = 0.0;  // of its pixels
};

// What was left out, and the largest of it.
struct LeftOut {
    std::size_t count = 0;
    double largest_mm2 = 0.0;
};

// Where paper is narrower than the least feature, between two parts that are not.
struct Neck {
    Vec2 at;
    double width_mm = 0.0;  // to within a pixel
};

// In mm, x to the right and y up from the lower left corner of the picture.
struct Traced {
    double width_mm = 0.0;  // of the whole picture
    double height_mm = 0.0;
    std::vector<TracedShape> shapes;  // never none; from the top of the picture down
    LeftOut specks, filled_holes, others;
    std::vector<Neck> necks;      // the narrowest first, at most 100
    std::size_t thin_shapes = 0;  // that are nowhere as wide as the least feature
};

// The outlines of the figure. Guarantees: no outline crosses or touches itself or another, and holes lie in
// their outlines, also when curves are read as chords within kFlatMm. Where `simplify_mm` is less than a
// pixel, outlines stray by at most a pixel from the borders of pixels, but for what is said to be left out
// and for sharp tips, which may be up to three pixels shorter; else they stray by about as much as
// `simplify_mm` more. Pixels that touch at a corner belong together. Coordinates are rounded to 0.001 mm.
// Adds `trace-specks`, `trace-holes-filled`, `trace-others`, `trace-thin`, `trace-few-clear`; nullopt after
// `trace-empty` or `trace-too-complex`. Precondition: the mask has a pixel. Cost: near linear in pixels and
// in the length of outlines.
std::optional<Traced> trace_outlines(const PixelMask& mask, const TraceOptions& options,
                                     Diagnostics& diagnostics);

// The outlines as an SVG drawing of the picture's size, in mm: a path a shape, which are cut lines to
// whatever reads it. The same bytes on every machine.
std::string svg_of(const Traced& traced);

}  // namespace popup
