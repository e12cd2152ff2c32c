// What holds for all documents of a language server.
#pragma once

#include <chrono>
#include <functional>
#include <string>

#include "popup/compile.h"

namespace popup::lsp {

struct ServerOptions {
    CompileOptions compile;
    DiagnosticPolicy policy;
    // How long nothing must have been typed before the motion is examined.
    std::chrono::milliseconds pause{150};
    // Opens the live view of a file, beside the server; why not, as a sentence without its full stop, or
    // empty. Empty: there is no view to be opened, and none is offered.
    std::function<std::string(const std::string& path)> open_view = {};
};

}  // namespace popup::lsp
