// A program's run as JSON, for --emit trail.
#pragma once

#include <string>

#include "input/flatlang/run/interpreter.h"

namespace popup::flatlang {

// {status: "ok", "parse-fail", "runtime-fail" or "timeout", stdout,
//  segments: [[x1, y1, z1, x2, y2, z2] or, in a part, [x1, y1, z1, x2, y2, z2, name] …],
//  polygons: [[[x, y, z] …] …], final_pose: {pos, right_x, heading_y, up_z}, part_mode,
//  hpgl: {file: text}: of the calls of hpgl(), what the original would have written}
// Inches, rounded to 1e-9. What is not finite is null.
std::string trail_json(const ProgramRun& run);

}  // namespace popup::flatlang
