// Lines that end where others begin made into contours: drawings from CAD programs have an outline as many
// lines and arcs.
#pragma once

#include <vector>

#include "popup/geometry.h"

namespace popup::drawing {

// Ends that are this near to each other, in mm, are one point.
inline constexpr double kJoinMm = 0.02;

struct OpenLine {
    std::vector<Vec2> points;  // at least two
    int element = 0;
};

struct JoinedLine {
    std::vector<Vec2> points;  // of a closed one, each corner once
    bool closed = false;
    std::vector<int> elements;  // whose lines it is made of, ascending
};

struct Joined {
    std::vector<JoinedLine> lines;  // in the order of their first element
    std::vector<int> doubled;       // elements of lines that were left out, for another is the same
};

// Uses every line once. What closes is closed: dead ends are set aside first, then lines are followed, the
// straightest way where more than two meet, and every loop on the way is a contour of its own. Points move by
// less than kJoinMm. Cost: near linear.
Joined join_lines(std::vector<OpenLine> lines);

// Length of a polyline.
double length_of(const std::vector<Vec2>& points);

}  // namespace popup::drawing
