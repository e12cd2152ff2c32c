#include "input/picture_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <variant>

#include "base/diagnostics/picture_hints.h"
#include "input/text.h"
#include "popup/files.h"

namespace popup {
namespace {

constexpr std::size_t kMostMiB = kMostImageBytes >> 20;
// Of all pictures of a document: each is kept whole, and decoded to be sure of it.
constexpr std::size_t kMostMiBTogether = 256;

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

// "https:", "data:", "C:".
bool has_scheme(std::string_view href) {
    const auto is_more = [](char c) {
        return is_letter(c) || (c >= '0' && c <= '9') || c == '+' || c == '-' || c == '.';
    };
    const std::size_t colon = std::min(href.find(':'), href.size());
    return colon < href.size() && colon > 0 && is_letter(href.front()) &&
           std::all_of(href.begin(), href.begin() + static_cast<std::ptrdiff_t>(colon), is_more);
}

// Whether a step of the way lies above where it begins; `separators` part the steps.
bool goes_above(std::string_view href, std::string_view separators) {
    int depth = 0;
    while (!href.empty()) {
        const std::size_t end = std::min(href.find_first_of(separators), href.size());
        const std::string_view step = href.substr(0, end);
        if (step == "..") {
            if (--depth < 0) return true;
        } else if (!step.empty() && step != ".") {
            ++depth;
        }
        href.remove_prefix(std::min(end + 1, href.size()));
    }
    return false;
}

// On every system alike, whether or not a backslash parts names there.
bool leads_out(std::string_view href) { return goes_above(href, "/") || goes_above(href, "/\\"); }

PictureRefusal outside(std::string message) {
    return {"picture-outside", std::move(message),
            "put the file beside the document, and name it by its file name"};
}

}  // namespace

PictureFiles::PictureFiles(const Source& document, const ReadOptions& options)
    : folder_{input_folder(folder_of(document.name), !options.program.read_file)},
      read_(options.program.read_file),
      overlay_(options.program.overlay) {}

std::optional<std::string> PictureFiles::name(std::string_view href, std::string_view what,
                                              PictureRefusal& refusal) {
    const std::string quoted = "\"" + shown(href) + "\"";
    if (href.starts_with('/') || href.starts_with('\\')) {
        refusal = outside(
            fmt::format("{} is an absolute path, and {} lie below the folder of the document", quoted, what));
        return std::nullopt;
    }
    if (has_scheme(href)) {
        refusal = outside(
            fmt::format("{} is a URL, and {} are files below the folder of the document", quoted, what));
        return std::nullopt;
    }
    if (leads_out(href)) {
        refusal = outside(quoted + " leads out of the folder of the document");
        return std::nullopt;
    }
    const std::string& folder = folder_.front().shown;
    return normal_path(folder.empty() ? std::string(href) : folder + "/" + std::string(href));
}

std::optional<FileBelow> PictureFiles::bytes(const std::string& named, std::string_view what,
                                             std::string_view hint, PictureRefusal& refusal) {
    FileBelow file;
    if (overlay_) file.text = overlay_(named);
    if (file.text) {
        file.path = named;
    } else if (!read_) {
        file = read_file_below(named, folder_, "the folder of the document", kMostMiB);
    } else if (std::optional<Source> source = read_(named)) {
        file.text = std::move(source->text);
        file.path = named;
    }
    if (file.text) {
        files_.push_back(named);
        return file;
    }
    if (file.leads_out) {
        refusal = outside(std::move(file.trouble));
    } else if (!file.trouble.empty()) {
        refusal = {fmt::format("{}-unreadable", what), std::move(file.trouble), std::string(hint)};
    } else {
        missing_.insert(named);
        refusal = {"picture-missing", "there is no file \"" + shown(named) + "\"",
                   "file names are looked for from the folder of the document, and case counts"};
    }
    return std::nullopt;
}

bool PictureFiles::count(const FileBelow& file, const std::string& named, PictureRefusal& refusal) {
    bytes_ += file.text->size();
    if (bytes_ <= kMostMiBTogether << 20) return true;
    refusal = {"document-too-large",
               fmt::format("with \"{}\" the pictures of the document have more than {} MiB", shown(named),
                           kMostMiBTogether),
               "make the pictures smaller: 300 pixels an inch are enough for paper"};
    return false;
}

const Image* PictureFiles::open(std::string_view href, PictureRefusal& refusal) {
    const std::optional<std::string> named = name(href, "pictures", refusal);
    if (!named) return nullptr;
    auto known = by_name_.find(*named);
    if (known == by_name_.end()) known = by_name_.emplace(*named, read(*named)).first;
    refusal = known->second.refusal;
    return known->second.image;
}

PictureFiles::Entry PictureFiles::read(const std::string& named) {
    PictureRefusal refusal;
    std::optional<FileBelow> file = bytes(named, "picture", "name a PNG or a JPEG file", refusal);
    if (!file) return {nullptr, refusal};
    const auto known = by_path_.find(file->path);
    if (known != by_path_.end()) return {&known->second, {}};
    if (!count(*file, named, refusal)) return {nullptr, refusal};
    std::variant<Image, ImageFault> image = open_image(std::move(*file->text));
    if (const auto* fault = std::get_if<ImageFault>(&image)) {
        const bool large = *fault == ImageFault::too_many_bytes || *fault == ImageFault::too_many_pixels;
        return {nullptr,
                {"picture-unreadable", fmt::format("\"{}\": {}", shown(named), to_string(*fault)),
                 std::string(large ? kPictureSmaller : kPictureAnew)}};
    }
    return {&by_path_.emplace(file->path, std::move(std::get<Image>(image))).first->second, {}};
}

const std::string* PictureFiles::text(std::string_view href, std::string_view what, PictureRefusal& refusal) {
    const std::optional<std::string> named = name(href, what, refusal);
    if (!named) return nullptr;
    auto known = texts_.find(*named);
    if (known == texts_.end()) {
        Text read;
        std::optional<FileBelow> file = bytes(*named, "outline", "name an SVG file", read.refusal);
        if (file && count(*file, *named, read.refusal)) read.text = std::move(*file->text);
        known = texts_.emplace(*named, std::move(read)).first;
    }
    refusal = known->second.refusal;
    return known->second.text ? &*known->second.text : nullptr;
}

}  // namespace popup
