// Layouts of nested pieces, judged from their job alone.
//
// Nothing is shared with the search but the headers: outlines are turned and rounded here, and whether they
// overlap is decided by CGAL (under the GPL: for tests only) in exact arithmetic. Where the build has no CGAL
// (libcgal-dev), nest_check_available() says so and overlaps and distances are not looked at.
#pragma once

#include <string>
#include <vector>

#include "popup/nest.h"

namespace popup::test {

bool nest_check_available();
// The word to skip a test with where it is not.
inline constexpr const char* kNestCheckMissing =
    "built without CGAL (libcgal-dev): overlaps of nested pieces cannot be checked";

// Everything in which the plan is not a layout of the job, one sentence each, with its amount; empty when it
// is one. Lengths of the job are rounded to the grid first, to the nearest step; from there on every
// comparison is exact:
//   - every item has one place, on a sheet that the stock has, and lies within it;
//   - its turn is one of its kind's, the same for all of a kind that must have one turn; groups share a
//   sheet;
//   - a locked item is where it is locked, in whatever turn;
//   - no two pieces of a sheet have a common inner point;
//   - none is closer to another than the spacing, hole edges included; where holes may not be used they count
//     as paper;
//   - offsets stand on the grid, `used` is what the pieces use, and the last sheet has a piece.
// Cost: near linear in edges of a sheet, with the pairs of edges closer to each other than the spacing.
std::vector<std::string> nest_faults(const NestJob& job, const NestPlan& plan);

}  // namespace popup::test
