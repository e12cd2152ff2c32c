// The point of a stretch of a line that is furthest from edges near it.
#pragma once

#include <cstddef>
#include <vector>

#include "popup/geometry.h"

namespace popup {

// Memory is kept for the next stretch; one caller at a time.
class FurthestInside {
 public:
    // Forgets the edges.
    void clear() { walls_.clear(); }
    // An edge in coordinates in which the line is the x axis.
    void add(Segment edge);

    struct Found {
        double at = 0.0;
        double inside_mm =
            0.0;  // distance of that point from the nearest edge, or `far_mm` when none is nearer
        double at_most_mm = 0.0;  // no point of the stretch is further inside; larger by a five-hundredth or
                                  // 1e-6 mm, seldom more
    };
    // The middle of the stretch, if no other point is better for certain. Precondition: from <= to.
    //
    // The distance from one edge bends upwards along a line, so that between two points it is below its
    // chord, and the distance from all edges is below the lowest chord. What is highest there is looked at
    // next, and splits the stretch. Where edges are met at right angles to them, that is it: a few looks are
    // enough. Cost: edges times looks.
    Found find(double from, double to, double far_mm);

 private:
    // An edge from (at, off) on; cosine and sine of its direction.
    struct Wall {
        double at, off, cosine, sine, length;
        [[nodiscard]] double distance(double t) const;
    };
    // How far points of a part are from one wall at most, from the part's begin to its end.
    struct Chord {
        double first, last;
        [[nodiscard]] double mm(double share) const { return first + share * (last - first); }
        [[nodiscard]] double rise() const { return last - first; }
    };
    // `peak`: where in the part the lowest chord is highest; `bound`: how high that is.
    struct Part {
        double from, to, peak, bound;
    };
    [[nodiscard]] double inside(double t, double far_mm) const;
    [[nodiscard]] std::size_t lowest(double share) const;
    Part look(double from, double to, double far_mm);

    std::vector<Wall> walls_, near_;
    std::vector<Chord> chords_;
    std::vector<Part> parts_;
};

}  // namespace popup
