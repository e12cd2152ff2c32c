// Names of a run's designs that no two of them share.
#pragma once

#include <string>
#include <vector>

namespace popup {

// Equal stems become "castle", "castle~2"; a stem that somebody really has is never given to another.
std::vector<std::string> unique_stems(std::vector<std::string> stems);

}  // namespace popup
