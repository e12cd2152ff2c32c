// libnest2d on our instances, for comparison: present only where the build has it (libnest2d-dev,
// libnlopt-cxx-dev).
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "support/nest_instances.h"

namespace popup::test {

// A layout that libnest2d made, as a plan of the instance's job.
struct ForeignLayout {
    NestPlan plan;
    std::string settings;  // in words
    double seconds = 0.0;  // for this one layout
};

// The best of what libnest2d makes of a strip or bins within `seconds`: fewest sheets, then the shortest last
// one. Pieces go in as their convex hulls, as it lets concave ones overlap. First each of its settings is
// tried once: how pieces are selected, where it starts and aligns, which goal placing has, its accuracy; that
// is `settled`, nullopt when time was up before the first layout. In the time that is left the settings that
// did best are tried with random orders of the pieces: `shuffled` is the best of both. A run that is under
// way when the time is up is not counted. Orders come from a fixed seed; how many there is time for depends
// on the clock. Progress gets a line now and then; may be empty.
struct ForeignBest {
    std::optional<ForeignLayout> settled;
    std::optional<ForeignLayout> shuffled;
    int settings_tried = 0;
    int orders_tried = 0;
};
ForeignBest libnest2d_best(const NestInstance& instance, double seconds,
                           const std::function<void(const std::string&)>& progress = {});

}  // namespace popup::test
