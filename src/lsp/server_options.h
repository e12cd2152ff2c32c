// What holds for all documents of a language server.
#pragma once

#include <chrono>

#include "popup/compile.h"

namespace popup::lsp {

struct ServerOptions {
    CompileOptions compile;
    DiagnosticPolicy policy;
    // How long nothing must have been typed before the motion is examined.
    std::chrono::milliseconds pause{150};
};

}  // namespace popup::lsp
