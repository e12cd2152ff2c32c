// Flat drawings of a book: a piece, or a sheet with its pieces. Lines and letters have sizes of the page they
// are shown on, however small the drawing is made.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "popup/layout.h"
#include "popup/print.h"

namespace popup::book {

enum class Ink { edge, mountain, valley, seam, faint, accent };
struct InkLook {
    Color color;
    double width_mm = 0.2;
    std::array<double, 4> dashes_mm{};  // on, off, on, off; all 0: solid
};
// Edges and folds as the sheets have them.
const InkLook& look_of(Ink ink);

struct Figure {
    struct Shape {
        std::vector<std::vector<Vec2>> lines;
        bool closed = false;
        std::optional<Color> fill = {};
        std::optional<Ink> ink = {};
    };
    struct Label {
        std::string text;
        Vec2 at;                        // its middle
        std::string brief;              // in its place where it is wider than its room
        double room_mm = 0.0;           // of the drawing; 0: as wide as it is
        std::vector<Vec2> others = {};  // places that would do, too
    };
    std::string alt;                         // for those who cannot see it
    double width_mm = 0.0, height_mm = 0.0;  // in true size; x to the right, y down
    std::vector<Shape> shapes;               // painted in their order
    std::vector<Label> labels;
    bool letters_only = false;  // numbers would be taken for those of pieces: settle_labels()
};

// A piece with its folds, its tabs and the targets on it. Targets with one of the labels in `wanted` are
// strong, others faint.
Figure piece_figure(const PatternPiece& piece, const std::vector<std::string>& wanted);
// What is folded of a sheet, and what its panels are called.
struct FoldedSheet {
    struct Fold {
        Segment at;
        bool mountain = false;
    };
    std::vector<Fold> folds;
    std::vector<std::pair<std::string, Polygon>> panels;  // names, and what has them
    std::vector<Polygon> marked = {};                     // that are painted
};
// A sheet with some of its folds, or all where none is named; the others are faint. Labels may lie on one
// another: settle_labels().
Figure fold_figure(const PatternPiece& piece, const FoldedSheet& sheet);
// The outlines of the pieces on a sheet, with their names as they are printed on it. Labels may lie on one
// another: settle_labels().
Figure sheet_figure(const Layout& layout, int sheet);

}  // namespace popup::book
