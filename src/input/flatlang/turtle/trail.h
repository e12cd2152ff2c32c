// What a turtle drew. Lengths in inches.
#pragma once

#include <string>
#include <vector>

#include "popup/diagnostics.h"
#include "popup/geometry.h"

namespace popup::flatlang {

// Where a turtle stands and which way it faces. The directions are units and perpendicular to each other;
// right × heading = up.
struct Pose {
    Vec3 at{0, 0, 0};
    Vec3 right{1, 0, 0};
    Vec3 heading{0, 1, 0};
    Vec3 up{0, 0, 1};
};

struct TrailPart {
    std::string name;
    Place place;  // of the call that began it
};

// Drawn with the pen down. `part` is an index into Trail::parts.
struct TrailSegment {
    Vec3 from, to;
    int part = 0;
};

// A closed loop of the trail whose points lie in one plane (within 1e-4 per axis). At least three points; the
// last joins the first; the newest of them stands first. It belongs to the part in which it was closed.
struct TrailPolygon {
    std::vector<Vec3> points;
    int part = 0;
};

struct Trail {
    std::vector<TrailPart> parts;        // the first has no name: what was drawn before any part was begun
    std::vector<TrailSegment> segments;  // in the order of drawing
    std::vector<TrailPolygon> polygons;  // in the order in which they were closed
    Pose last;                           // of the cursor
};

}  // namespace popup::flatlang
