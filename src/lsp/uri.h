// Names of documents as the protocol has them, and as files.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace popup::lsp {

// The path of a "file:" URI, percent signs decoded; nullopt of others, of other hosts, and of what has a NUL
// byte.
std::optional<std::string> path_of(std::string_view uri);
// The URI of an absolute path.
std::string uri_of(std::string_view path);

// The path that all names of a file lead to: absolute, without "." and "..", its links followed as far as it
// exists. Relative paths are of the working directory. Asks the disk.
std::string real_path(const std::string& path);
// A name of the file that is absolute and has no "." or "..": the path itself where it is one, so that
// editors see the links that they know.
std::string whole_path(const std::string& path);

}  // namespace popup::lsp
