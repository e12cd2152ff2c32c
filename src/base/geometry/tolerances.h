// How near is near: the lengths, in mm, by which stages tell the same from the different, in one place.
//
// They stand by size. Each has a name that says what it is for, also where two have one value: change the one
// and look at who uses it. What documents are mended by is Tolerances, in popup/geometry.h; what is asked of
// paper, such as the least width of a tab, stands with the stage that asks it.
#pragma once

namespace popup {

// Rounding. Distances that are nought by construction are less than this.
inline constexpr double kRoundingMm = 1e-9;
// Corners of plates in the closed card no further apart are one.
inline constexpr double kSameCornerMm = kRoundingMm;

// The grid of regions, to which every corner of a cut outline is rounded. Nothing finer is kept.
inline constexpr double kGridMm = 1e-6;
// Steps of the grid in a millimetre.
inline constexpr double kPerMm = 1e6;
// Coordinates further out have no place on the grid: they are no drawing's.
inline constexpr double kRangeMm = 1e9;
// A point of the grid no further from a line than this counts as lying on it.
inline constexpr double kOnGridLineMm = 2.0 * kGridMm;
// Heights of two plates over a third no further apart are equal.
inline constexpr double kSameHeightMm = kGridMm;
// A tour that is shorter by less than this is no better.
inline constexpr double kGainMm = kGridMm;
// Vertices of a FOLD file no further apart are one. Two corners that were one before each was rounded are
// never further apart; others stay apart.
inline constexpr double kSameVertexMm = 2.0 * kGridMm;

// Lines of a pattern whose ends, or which all along, are no further apart are the same: far above rounding,
// far below any blade.
inline constexpr double kSameLineMm = 1e-5;
// A part of a region smaller than this, which cannot be cut into triangles, is left out.
inline constexpr double kSpeckMm = 1e-5;
// Corners of a ring whose distances to a point differ by no more are as near.
inline constexpr double kTieMm = 1e-5;
// Corners of a tab no further from a straight line are none.
inline constexpr double kTidyMm = 1e-4;
// The end of a seam and an obstacle no further from it coincide: a tab begins where the obstacle ends.
inline constexpr double kSeamEndMm = 1e-3;

// A hundredth of a millimetre: no machine keeps it and no paper shows it. Chords stray from curves by at most
// this.
inline constexpr double kCurveMm = 0.01;
// What two plates have in common nearer than this to an edge of either only touches.
inline constexpr double kTouchMm = 0.01;
// What lies this deep in another thing is not just the rounding of a drawing.
inline constexpr double kDeepMm = 0.01;
// Lines closer than this, all along, are cut as one. Layouts place pieces to a thousandth.
inline constexpr double kSharedMm = 0.01;
// A corner is lost to the kerf when it is buried this deep.
inline constexpr double kLostMm = 0.01;

// Points of a machine's path closer than this are one: machines stutter over very short segments.
inline constexpr double kTinyMm = 0.02;

}  // namespace popup
