// How much a machine, and a printer, would have to do on the sheets of a layout.
#pragma once

#include <array>
#include <cstddef>

#include "popup/profile.h"

namespace popup {

// By operation, in the order of kOperations.
using OperationCounts = std::array<std::size_t, kOperations.size()>;

// Areas, lines, targets, labels and cuts of all placed pieces, by what is done with them; folds that the
// profile perforates count as perforations, too. Whether a pen draws them does not matter. The sheets' own
// marks are not counted. Cost: linear in what is counted.
OperationCounts count_operations(const Layout& layout, const Profile& profile);

}  // namespace popup
