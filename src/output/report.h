// The report of a run: what was read, repaired, found, simulated and laid out, as JSON.
#pragma once

#include <optional>
#include <string>

#include "popup/output.h"

namespace popup {

// The report's structure:
//   version, inputs: [{file, elements, plates, pieces, repairs, diagnostics, motion}], layout,
//   cut (as cut_report() has it; null without a layout)
// and, only where there are any, `outputs` (names of the other files of the run) and `diagnostics` (of the
// run as a whole). `motion` has angles, max_closure_error_mm, flat_closed, flat_error_deg, `not_forced` as
// not_forced_json() has it, left out where the opening forces every plate, and then the members of
// examination_json(). What was not examined, or not reached, is null, and never an empty list.
// Diagnostics are the objects of to_json(Diagnostic). Sheets and copies count from 1. Lengths are rounded to
// 1e-6 mm, angles to 1e-7°, the closure error to 1e-9 mm; what the examination found, as examination_json()
// says.
std::optional<std::string> write_report(const Compilation& run, const OutputOptions& options,
                                        Diagnostics& diagnostics);

}  // namespace popup
