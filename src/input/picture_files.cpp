#include "input/picture_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <variant>

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

bool goes_up(std::string_view href) {
    while (!href.empty()) {
        const std::size_t slash = std::min(href.find_first_of("/\\"), href.size());
        if (href.substr(0, slash) == "..") return true;
        href.remove_prefix(std::min(slash + 1, href.size()));
    }
    return false;
}

PictureRefusal outside(std::string message) {
    return {"picture-outside", std::move(message),
            "put the picture beside the document, and name it by its file name"};
}

}  // namespace

PictureFiles::PictureFiles(const Source& document, const ReadOptions& options)
    : folder_{input_folder(folder_of(document.name), !options.program.read_file)},
      read_(options.program.read_file) {}

const Image* PictureFiles::open(std::string_view href, PictureRefusal& refusal) {
    const std::string quoted = "\"" + shown(href) + "\"";
    if (href.starts_with('/') || href.starts_with('\\')) {
        refusal = outside(quoted + " is an absolute path, and pictures lie below the folder of the document");
        return nullptr;
    }
    if (has_scheme(href)) {
        refusal = outside(quoted + " is a URL, and pictures are files below the folder of the document");
        return nullptr;
    }
    if (goes_up(href)) {
        refusal = outside(quoted + " leads out of the folder of the document");
        return nullptr;
    }
    const std::string& folder = folder_.front().shown;
    const std::string named =
        normal_path(folder.empty() ? std::string(href) : folder + "/" + std::string(href));
    auto known = by_name_.find(named);
    if (known == by_name_.end()) known = by_name_.emplace(named, read(named)).first;
    refusal = known->second.refusal;
    return known->second.image;
}

PictureFiles::Entry PictureFiles::read(const std::string& named) {
    const std::string quoted = "\"" + shown(named) + "\"";
    FileBelow file;
    if (!read_) {
        file = read_file_below(named, folder_, "the folder of the document", kMostMiB);
    } else if (std::optional<Source> source = read_(named)) {
        file.text = std::move(source->text);
        file.path = named;
    }
    if (file.text) return opened(named, std::move(*file.text), file.path);
    if (file.leads_out) return {nullptr, outside(std::move(file.trouble))};
    if (!file.trouble.empty())
        return {nullptr, {"picture-unreadable", std::move(file.trouble), "name a PNG or a JPEG file"}};
    missing_.insert(named);
    return {nullptr,
            {"picture-missing", "there is no file " + quoted,
             "file names are looked for from the folder of the document, and case counts"}};
}

PictureFiles::Entry PictureFiles::opened(const std::string& named, std::string bytes,
                                         const std::string& path) {
    files_.push_back(named);
    const auto known = by_path_.find(path);
    if (known != by_path_.end()) return {&known->second, {}};
    bytes_ += bytes.size();
    if (bytes_ > kMostMiBTogether << 20) {
        return {nullptr,
                {"document-too-large",
                 fmt::format("with \"{}\" the pictures of the document have more than {} MiB", shown(named),
                             kMostMiBTogether),
                 "make the pictures smaller: 300 pixels an inch are enough for paper"}};
    }
    std::variant<Image, ImageFault> image = open_image(std::move(bytes));
    if (const auto* fault = std::get_if<ImageFault>(&image)) {
        return {nullptr,
                {"picture-unreadable", fmt::format("\"{}\": {}", shown(named), to_string(*fault)),
                 "export the picture anew, as a PNG or as a JPEG in RGB"}};
    }
    return {&by_path_.emplace(path, std::move(std::get<Image>(image))).first->second, {}};
}

}  // namespace popup
