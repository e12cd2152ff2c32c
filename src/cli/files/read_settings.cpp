#include "cli/files/read_settings.h"

#include <sys/stat.h>

namespace popup::cli {

std::optional<Source> read_settings(const std::string& name, Diagnostics& diagnostics,
                                    std::size_t limit_bytes) {
    struct stat status {};
    // Looked at before it is opened, because opening a pipe waits for its writer.
    const bool special = name != "-" && ::stat(name.c_str(), &status) == 0 && !S_ISREG(status.st_mode) &&
                         !S_ISDIR(status.st_mode);
    if (!special) return read_source(name, diagnostics, limit_bytes);
    diagnostics.error("unreadable-input", {},
                      "cannot be read: it is a pipe, a socket or a device, not a file");
    return std::nullopt;
}

}  // namespace popup::cli
