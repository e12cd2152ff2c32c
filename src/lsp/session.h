// A language server on two streams: bytes in, bytes out, and the threads that look at documents meanwhile.
#pragma once

#include "lsp/server_options.h"

namespace popup::lsp {

// Serves until `exit` comes or the input ends, and returns the exit code: 0 after `shutdown` and `exit`,
// else 1. Requests are answered by the calling thread, while one thread checks documents and another examines
// motions, so that no answer waits for an examination. `in` and `out` are file descriptors; a client that
// reads no more ends the session. An examination that has not ended is not waited for: its thread goes on
// until it is, or the process ends.
int serve(int in, int out, const ServerOptions& options);

}  // namespace popup::lsp
