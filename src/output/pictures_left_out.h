// Formats that hold lines say which pictures they leave out.
#pragma once

#include <string_view>

#include "popup/layout.h"
#include "popup/output.h"

namespace popup {

// Remark `prints-left-out`: the pictures that files of this suffix do not have. Those that the profile leaves
// out are told of by examine_prints(), whatever the format; under print_and_cut no profile does.
void tell_pictures_left_out(const Layout& layout, const OutputOptions& options, std::string_view suffix,
                            Diagnostics& diagnostics);

}  // namespace popup
