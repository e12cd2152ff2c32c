// Files that an input names, of the folders that it may read from and of no others.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace popup {

// A folder that an input may read from.
struct InputFolder {
    std::string shown;      // as the user named it; empty: the working directory
    std::string canonical;  // empty: there is none
};
// `disk`: looked up there now; else the name is one of nothing but text.
InputFolder input_folder(std::string shown, bool disk);
// The folder that a file of this name is in.
std::string folder_of(const std::string& file);

// A path as text, without "." and "a/..", and without a slash at its end.
std::string normal_path(const std::string& path);
// True when a path, canonical or normal as text, is below one of the folders.
bool is_below(const std::string& path, const std::vector<InputFolder>& folders);

struct FileBelow {
    std::optional<std::string> text;
    std::string path;        // canonical, where it was found
    std::string trouble;     // why there is no text, a sentence without its full stop; empty: it is not there
    bool too_large = false;  // that is why
    bool leads_out = false;  // likewise
};
// A whole file of the disk. Read is nothing but a regular file below one of the folders, once all symbolic
// links are followed, of at most `most_mib`. `shown` is its path as the user would write it; `out_of` ends
// the sentence `"a/b" leads out of …`.
FileBelow read_file_below(const std::string& shown, const std::vector<InputFolder>& folders,
                          std::string_view out_of, std::size_t most_mib);

}  // namespace popup
