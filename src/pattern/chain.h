// Lines of a pattern made tidy: nothing drawn twice, cuts joined into paths, inner paths before outer ones.
#pragma once

#include <span>
#include <vector>

#include "base/geometry/tolerances.h"
#include "popup/geometry.h"
#include "popup/pattern.h"

namespace popup {

// A segment and whose it is: any number; only equality counts.
struct TaggedSegment {
    Segment at;
    int tag = -1;
};

// The same set of points with every part of it once: doubled segments and overlapping collinear ones become
// one, which keeps the tag of the longest. Segments that only meet end to end and in line become one if their
// tags are equal. Keeps the order of what remains. Segments shorter than kSameLineMm are dropped. Cost: near
// linear.
std::vector<TaggedSegment> merged(std::vector<TaggedSegment> segments);

// `segments` without what lies on any of `taken` (collinear overlaps only). Cost: near linear.
std::vector<TaggedSegment> without(std::vector<TaggedSegment> segments, std::span<const Segment> taken);

// Says of each how deep it lies. Outer contours run counter-clockwise, those inside them clockwise, and so on
// inwards; inner ones come first, then the lower, then the more to the left; closed contours start at their
// leftmost, then lowest, corner. Precondition: no two closed contours cross.
void put_in_order(std::vector<Contour>& contours);

// Joins merged segments into as few paths as possible in which every loop is a closed contour of its own and
// no path passes a point twice; where more than two meet, the straightest continue. Each segment is used
// exactly once. They are put in order. Cost: near linear.
std::vector<Contour> chained(const std::vector<TaggedSegment>& segments);

// The paths of cuts: merged and chained. Two segments in line are not joined over a corner where a third one
// ends. So an outline stays closed where a slit goes straight on from one of its edges, and holes that touch
// in a corner stay two. Cost: near linear.
std::vector<Contour> cut_paths(const std::vector<TaggedSegment>& cuts);

}  // namespace popup
