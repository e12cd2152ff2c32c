#include "input/flatlang/read.h"

namespace popup::flatlang {

Reading read(const Source& /*source*/, const ReadOptions& /*options*/, Diagnostics& diagnostics) {
    diagnostics.error("flatlang-syntax", {}, "programs are not run yet");
    return {};
}

std::string trail(const Source& /*source*/, const ReadOptions& /*options*/, Diagnostics& /*diagnostics*/) {
    return {};
}

}  // namespace popup::flatlang
