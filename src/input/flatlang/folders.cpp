#include "input/flatlang/folders.h"

#include <algorithm>
#include <utility>

#include "input/flatlang/kit_table.h"
#include "popup/files.h"

namespace popup::flatlang {
namespace {

constexpr std::string_view kKitPrefix = "kit/";
constexpr std::size_t kLargestMiB = 4;
constexpr std::size_t kLargest = kLargestMiB << 20;
constexpr std::string_view kOutOf = "the folders that programs may load from";

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

Folders::Folders(const Source& program, const ProgramOptions& options)
    : read_(options.read_file), overlay_(options.overlay) {
    folders_.push_back(input_folder(folder_of(program.name), !read_));
    for (const std::string& folder : options.folders) folders_.push_back(input_folder(folder, !read_));
    if (!overlay_) return;
    for (const InputFolder& folder : folders_) as_named_.push_back(input_folder(folder.shown, false));
}

std::optional<LoadedFile> Folders::load(const std::string& shown, std::string& trouble,
                                        std::set<std::string>* missing) const {
    if (overlay_) {
        const std::string path = normal_path(shown);
        std::optional<std::string> text = is_below(path, as_named_) ? overlay_(path) : std::nullopt;
        if (text) return LoadedFile{shown, std::move(*text)};
    }
    if (!read_) {
        FileBelow file = read_file_below(shown, folders_, kOutOf, kLargestMiB);
        trouble = std::move(file.trouble);
        if (file.text) return LoadedFile{shown, std::move(*file.text)};
        // What is not there is not worth a word of its own: other folders may have it.
        if (trouble.empty() && missing != nullptr) missing->insert(shown);
        return std::nullopt;
    }
    const std::string path = normal_path(shown);
    if (!is_below(path, folders_)) {
        trouble = in_quotes(shown) + " leads out of " + std::string(kOutOf);
        return std::nullopt;
    }
    std::optional<Source> source = read_(path);
    if (!source) return std::nullopt;
    if (source->text.size() > kLargest) {
        trouble = in_quotes(shown) + " has more than " + std::to_string(kLargestMiB) + " MiB";
        return std::nullopt;
    }
    return LoadedFile{path, std::move(source->text)};
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
    for (const InputFolder& folder : folders_) {
        std::string shown = joined(folder.shown, name);
        std::string place =
            folder.shown.empty() ? std::string("the working directory") : in_quotes(folder.shown);
        if (std::find(places.begin(), places.end(), place) == places.end()) {
            places.push_back(std::move(place));
        }
        std::string what;
        std::optional<LoadedFile> file = load(shown, what, missing);
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
