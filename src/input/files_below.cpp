#include "input/files_below.h"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>

#include "popup/files.h"

namespace popup {
namespace {

namespace fs = std::filesystem;

// True when `path` names something below `folder`. Both are canonical, or both normal as text.
bool lies_below(const fs::path& path, const fs::path& folder) {
    auto rest = path.begin();
    if (folder == ".") {
        if (path.is_absolute()) return false;
    } else {
        const auto ends = std::mismatch(folder.begin(), folder.end(), path.begin(), path.end());
        if (ends.first != folder.end()) return false;
        rest = ends.second;
    }
    // What is left of a normal name begins with ".." when it leads out again.
    return rest != path.end() && *rest != ".." && *rest != ".";
}

}  // namespace

InputFolder input_folder(std::string shown, bool disk) {
    while (shown.size() > 1 && shown.ends_with('/')) shown.pop_back();
    const std::string place = shown.empty() ? "." : shown;
    std::error_code trouble;
    std::string canonical = disk ? fs::canonical(place, trouble).string() : normal_path(place);
    if (trouble) canonical.clear();
    if (shown == ".") shown.clear();
    return {std::move(shown), std::move(canonical)};
}

std::string folder_of(const std::string& file) { return fs::path(file).parent_path().string(); }

std::string normal_path(const std::string& path) {
    std::string text = fs::path(path).lexically_normal().string();
    while (text.size() > 1 && text.ends_with('/')) text.pop_back();
    return text;
}

bool is_below(const std::string& path, const std::vector<InputFolder>& folders) {
    return std::any_of(folders.begin(), folders.end(), [&](const InputFolder& folder) {
        return !folder.canonical.empty() && lies_below(path, folder.canonical);
    });
}

FileBelow read_file_below(const std::string& shown, const std::vector<InputFolder>& folders,
                          std::string_view out_of, std::size_t most_mib) {
    FileBelow file;
    const std::string quoted = "\"" + shown + "\"";
    std::error_code error;
    const fs::path path = fs::canonical(shown, error);
    if (error == std::errc::no_such_file_or_directory || error == std::errc::not_a_directory ||
        error == std::errc::filename_too_long)
        return file;
    if (error) {
        file.trouble = quoted + " cannot be read: " + error.message();
        return file;
    }
    if (!is_below(path.string(), folders)) {
        file.trouble = quoted + " leads out of " + std::string(out_of);
        file.leads_out = true;
        return file;
    }
    // Looked at before it is opened: a pipe would keep the program waiting, and some devices act when opened.
    if (!fs::is_regular_file(path, error)) {
        file.trouble =
            quoted + (fs::is_directory(path, error) ? " is a directory" : " is not a regular file");
        return file;
    }
    Diagnostics unread;
    const std::size_t most = most_mib << 20;
    std::optional<Source> source = read_source(path.string(), unread, most);
    if (!source) {
        file.too_large = fs::file_size(path, error) > most && !error;
        const std::vector<Diagnostic> found = unread.sorted();
        file.trouble = file.too_large ? quoted + " has more than " + std::to_string(most_mib) + " MiB"
                                      : quoted + " " + found.front().message;
        return file;
    }
    file.path = path.string();
    file.text = std::move(source->text);
    return file;
}

}  // namespace popup
