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

}  // namespace popup::lsp
