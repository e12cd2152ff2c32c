// A plate as flat triangles: its paper, and what is printed on it.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "popup/assembly.h"

namespace popup {

// How far before the paper prints lie, in mm: far enough for viewers to tell which is before which.
inline constexpr double kPaintedLiftMm = 0.01;
inline constexpr double kClearLiftMm = 0.015;  // of pictures that may be transparent
inline constexpr double kDrawnLiftMm = 0.02;
inline constexpr double kWrittenLiftMm = 0.025;  // of texts

// Triangles of one colour, or of a picture, in the plane of the plate, counter-clockwise seen from the front.
struct MeshPart {
    Color color;
    std::optional<Color> back;     // of paper that is bare behind: its colour there; else that of both sides
    const Image* image = nullptr;  // instead of the colour; one of the plate's prints
    bool drawn = false;            // printed, so it lies on the paper's front; else the paper
    double lift_mm = 0.0;          // how far before the paper's front
    std::vector<Vec2> points;      // mm from the plate's pivot
    std::vector<std::uint32_t> indices;
};

// The paper first, white where the plate has no fill. A fill is printed on the front: behind, the paper is
// bare and white, unless `printed_backs`. Then its areas and pictures in their order, each cut
// off at the plate's outline and without what later ones cover, then its drawn lines, one part a colour in
// the order of their first use, and last its texts that have a colour, and those of its piece (`of_piece`), a
// part each. A text is the outlines of its letters, cut off at the plate's outline; a line is as wide as it
// is drawn, with round ends and corners, cut off at the
// plate's outline. Where lines of several colours cross, only the last is there, so that no two parts
// overlap; plates with more than fifty crossings a line are left as they are. Parts without triangles are
// left out. Cost: near linear in the corners of the outline and of the lines, times the colours of lines at
// the outline, and in areas and pictures and the pairs of them whose boxes meet.
std::vector<MeshPart> plate_mesh(const Plate& plate, bool printed_backs,
                                 std::span<const Print> of_piece = {});

}  // namespace popup
