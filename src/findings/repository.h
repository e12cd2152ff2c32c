// Where files are in a repository, so that findings name them alike on every machine.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace popup {

// The nearest directory, from this absolute one upward, that has a ".git"; without one the directory itself.
std::filesystem::path repository_of(const std::filesystem::path& directory);

// The file `name`, which is relative to `working` or absolute, as seen from `root`: "designs/camp.xml", and
// "../camp.xml" for what is not below it. Symbolic links are followed only where the name as it is written
// does not lead there. Standard input ("-") is "<stdin>". `root` and `working` are absolute.
std::string path_from(const std::filesystem::path& root, const std::filesystem::path& working,
                      const std::string& name);

// The path as a relative URI reference: every byte but letters, digits, "-", ".", "_", "~" and "/" as "%20".
std::string percent_encoded(std::string_view path);
// The other way; "%" without two hexadecimal digits stays.
std::string percent_decoded(std::string_view text);

}  // namespace popup
