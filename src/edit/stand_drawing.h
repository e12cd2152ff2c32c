// A drawing of any place and size becomes the silhouette of a piece: stood on its seams.
//
//     const std::vector<GlueChain> chains = glue_chains(info, folds, page);
//     StoodDrawing stood = stand_drawing(drawn, chains, DrawingFit::seams, place);
//     if (!stood.refusal.what.empty()) return session.fail("bad-edit", ...);
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "popup/geometry.h"
#include "popup/mechanism.h"
#include "popup/path.h"

namespace popup::edit {

// Seams that meet, end to end, in mm on the page of the piece: the piece lies on their left. At least two
// points.
struct GlueChain {
    std::vector<Vec2> points;
    std::string name;  // "bird.left and bird.right"
};
// The chains of an element's seams, in the order of its folds; none of an element without seams of a piece
// of its own. Precondition: as many folds as the row has.
std::vector<GlueChain> glue_chains(std::string_view id, const ElementInfo& info,
                                   std::span<const PageFold> folds);

// How large a drawing becomes: so that it stands on the ends of the seams; as wide, or as high, as what it
// takes the place of; both; as large as it is drawn.
enum class DrawingFit { seams, width, height, both, none };

struct StoodDrawing {
    Path path;  // on the page of the piece
    // What was left out at each chain: of a drawing that is round there, its lowest part; of an edge or
    // corner, how far that would reach beyond the seams.
    struct Cut {
        double mm = 0.0;
        bool round = false;
        Vec2 from, to;   // where it began and ended, on the page of the piece
        std::string on;  // the name of the chain
    };
    std::vector<Cut> cuts;
    struct Refusal {
        std::string what, hint;  // "has no straight edge on its left, where tent.left is glued"
    } refusal;                   // empty: there is a path
};

// One chain: the drawing stands on it. What it stands with is, where there is one, the three corners that
// lie as the seams do, or a wide V; else its straight lower edge; else the lowest level without a gap that is
// half as wide as the drawing, at most a quarter of its height up. What is below becomes the seams. A
// straight edge or line may have any number of points; what of it is more than 0.5 mm off, once it is there,
// is no part of it. Two chains: its straight edges on the left and right lie on them. Where the drawing ends
// beside the ends of the seams, a straight line joins them; what ends within 0.5 mm of one ends on it. Holes
// stay. `place` is the box of what it takes the place of; `drawn` has y up, in mm. Precondition: one or two
// chains. Cost: n log n in the chords of the path, where they do not cross.
StoodDrawing stand_drawing(const Path& drawn, std::span<const GlueChain> chains, DrawingFit fit,
                           const Box& place);

}  // namespace popup::edit
