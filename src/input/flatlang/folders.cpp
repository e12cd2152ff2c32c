#include "input/flatlang/folders.h"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>

#include "input/flatlang/kit_table.h"
#include "popup/files.h"

namespace popup::flatlang {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kKitPrefix = "kit/";
constexpr std::size_t kLargestMiB = 4;
constexpr std::size_t kLargest = kLargestMiB << 20;

// True when `path` names something below `folder`. Both are canonical, or both normal as text.
bool is_below(const fs::path& path, const fs::path& folder) {
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

std::string normal(const std::string& path) {
    std::string text = fs::path(path).lexically_normal().string();
    while (text.size() > 1 && text.ends_with('/')) text.pop_back();
    return text;
}

// The path of a name below a folder, as the user would write it. Always below, as far as the text goes:
// names that begin with "/" too.
std::string joined(const std::string& folder, std::string_view name) {
    if (!folder.empty()) return folder + "/" + std::string(name);
    name.remove_prefix(std::min(name.find_first_not_of('/'), name.size()));
    return name.empty() ? "." : std::string(name);
}

std::string in_quotes(std::string_view text) { return "\"" + std::string(text) + "\""; }

std::string list_of(const std::vector<std::string>& names) {
    std::string text;
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (i > 0) text += i + 1 == names.size() ? " or " : ", ";
        text += names[i];
    }
    return text;
}

}  // namespace

Folders::Folders(const Source& program, const ProgramOptions& options) : read_(options.read_file) {
    std::vector<std::string> shown{fs::path(program.name).parent_path().string()};
    shown.insert(shown.end(), options.folders.begin(), options.folders.end());
    for (std::string& folder : shown) {
        while (folder.size() > 1 && folder.ends_with('/')) folder.pop_back();
        const std::string place = folder.empty() ? "." : folder;
        std::error_code trouble;
        std::string canonical = read_ ? normal(place) : fs::canonical(place, trouble).string();
        if (trouble) canonical.clear();
        if (folder == ".") folder.clear();
        folders_.push_back({std::move(folder), std::move(canonical)});
    }
}

bool Folders::allows(const std::string& path) const {
    return std::any_of(folders_.begin(), folders_.end(), [&](const Folder& folder) {
        return !folder.canonical.empty() && is_below(path, folder.canonical);
    });
}

std::optional<LoadedFile> Folders::from_disk(const Folder& folder, const std::string& shown,
                                             std::string& trouble, bool& there) const {
    std::error_code error;
    const fs::path path = fs::canonical(shown, error);
    // What is not there is not worth a word of its own: other folders may have it.
    if (error == std::errc::no_such_file_or_directory || error == std::errc::not_a_directory ||
        error == std::errc::filename_too_long || folder.canonical.empty()) {
        there = false;
        return std::nullopt;
    }
    if (error) {
        trouble = in_quotes(shown) + " cannot be read: " + error.message();
        return std::nullopt;
    }
    if (!allows(path.string())) {
        trouble = in_quotes(shown) + " leads out of the folders that programs may load from";
        return std::nullopt;
    }
    // Looked at before it is opened: a pipe would keep the program waiting, and some devices act when opened.
    if (!fs::is_regular_file(path, error)) {
        trouble =
            in_quotes(shown) + (fs::is_directory(path, error) ? " is a directory" : " is not a regular file");
        return std::nullopt;
    }
    Diagnostics unread;
    std::optional<Source> source = read_source(path.string(), unread, kLargest);
    if (!source) {
        const bool large = fs::file_size(path, error) > kLargest && !error;
        const std::vector<Diagnostic> found = unread.sorted();
        trouble = large ? in_quotes(shown) + " has more than " + std::to_string(kLargestMiB) + " MiB"
                        : in_quotes(shown) + " " + found.front().message;
        return std::nullopt;
    }
    return LoadedFile{shown, std::move(source->text)};
}

std::optional<LoadedFile> Folders::find(std::string_view name, std::string& why,
                                        std::set<std::string>* missing) const {
    if (name.empty() || name.find('\0') != std::string_view::npos) {
        why = name.empty() ? "the name of the file to load is empty"
                           : "the name of the file to load has a NUL byte";
        return std::nullopt;
    }
    const bool kit_name = name.starts_with(kKitPrefix);
    if (kit_name) {
        if (const std::string_view* text = kit_file(name.substr(kKitPrefix.size()))) {
            return LoadedFile{std::string(name), std::string(*text), true};
        }
    }
    std::string trouble;
    std::vector<std::string> places;
    for (const Folder& folder : folders_) {
        std::string shown = joined(folder.shown, name);
        std::string place =
            folder.shown.empty() ? std::string("the working directory") : in_quotes(folder.shown);
        if (std::find(places.begin(), places.end(), place) == places.end()) {
            places.push_back(std::move(place));
        }
        std::string what;
        std::optional<LoadedFile> file;
        if (!read_) {
            bool there = true;
            file = from_disk(folder, shown, what, there);
            if (!there && missing != nullptr) missing->insert(shown);
        } else if (const std::string path = normal(shown); !allows(path)) {
            what = in_quotes(shown) + " leads out of the folders that programs may load from";
        } else if (std::optional<Source> source = read_(path); source && source->text.size() > kLargest) {
            what = in_quotes(shown) + " has more than " + std::to_string(kLargestMiB) + " MiB";
        } else if (source) {
            file = LoadedFile{path, std::move(source->text)};
        }
        if (file) {
            return file;
        }
        if (trouble.empty()) trouble = std::move(what);
    }
    if (!trouble.empty()) {
        why = std::move(trouble);
        return std::nullopt;
    }
    why = "there is no " + in_quotes(name) + " in " + list_of(places);
    if (kit_name) {
        why += ", and the kit has none either; it has ";
        std::string names;
        for (const std::string_view file : kit_files()) {
            names += (names.empty() ? "" : ", ") + std::string(file);
        }
        why += names;
    }
    return std::nullopt;
}

const std::string_view* kit_file(std::string_view name) {
    const std::span<const KitFile> table = kit_table();
    const auto at =
        std::lower_bound(table.begin(), table.end(), name,
                         [](const KitFile& file, std::string_view wanted) { return file.name < wanted; });
    return at != table.end() && at->name == name ? &at->text : nullptr;
}

std::vector<std::string_view> kit_files() {
    std::vector<std::string_view> names;
    for (const KitFile& file : kit_table()) names.push_back(file.name);
    return names;
}

}  // namespace popup::flatlang
