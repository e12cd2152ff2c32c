// What a machine has to do: how long its lines are, how far it goes between them, how long it takes.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>

#include "popup/output.h"

namespace popup {

// Of each sheet view in which lines are scored or cut, and of all together: `operations` (of each its layer,
// its paths, which are also its pierces, and their length), `travel_mm` between paths in the order of the
// file, from the lower left corner on, `pierces`, and `time_s`: lengths and travel by their speeds, and the
// profile's time a pierce. The time is null where a speed that it needs is not known; where others are, the
// remark `time-unknown` names those that are not. Nothing, and an error, when the sheets cannot be drawn
// (views_of()). Cost: that of drawing the sheets once.
std::optional<nlohmann::ordered_json> cut_report(const Layout& layout, const OutputOptions& options,
                                                 Diagnostics& diagnostics);

}  // namespace popup
