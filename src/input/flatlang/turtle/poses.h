// How a turtle's pose changes. Axes are right, heading and up; angles turn right-handed about them.
#pragma once

#include "input/flatlang/turtle/trail.h"

namespace popup::flatlang {

enum class Axis { right, heading, up };

// A forward step of `inches`.
void move(Pose& pose, double inches);
// A turn on the spot by `degrees`.
void turn(Pose& pose, Axis axis, double degrees);
// The change that leads from one pose to another, as seen from the first: applying it to `from` gives `to`.
// Precondition: the directions of `from` are units and perpendicular.
Pose change(const Pose& from, const Pose& to);
// The same by the original interpreter's arithmetic, to the last bit: the planes of loops whose points lie on
// a line hang on it there. `from` need not be square.
Pose change_of_2008(const Pose& from, const Pose& to);
void apply(Pose& pose, const Pose& change);

// Makes the directions units and perpendicular again; keeps the heading, and turns right and up as little as
// that needs. Directions that cannot be told (zero, parallel, not finite) become those of a new turtle.
void square_up(Pose& pose);
// The same when rounding has moved them noticeably (1e-13), so that poses stay square over any number of
// turns.
void keep_square(Pose& pose);

}  // namespace popup::flatlang
