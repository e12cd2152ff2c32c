// The pictures, and the drawings of outlines, that a document names.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "input/files_below.h"
#include "popup/image.h"
#include "popup/language.h"

namespace popup {

// Why there is no picture: a diagnostic, but for its place.
struct PictureRefusal {
    std::string code, message, hint;
};

// Opens the pictures of one document, each file once.
class PictureFiles {
 public:
    PictureFiles(const Source& document, const ReadOptions& options);

    // The picture of a file below the document's folder (of standard input: the working directory); null
    // with a refusal. Never read are absolute paths, URLs, and what "..", or a symbolic link, leads out of
    // the folder.
    const Image* open(std::string_view href, PictureRefusal& refusal);

    // The whole text of such a file, of which `what` ("outlines") are read; null with a refusal.
    const std::string* text(std::string_view href, std::string_view what, PictureRefusal& refusal);

    // Files that were read, in the order in which they were; and those that are not there, sorted.
    [[nodiscard]] const std::vector<std::string>& files() const { return files_; }
    [[nodiscard]] const std::set<std::string>& missing() const { return missing_; }

 private:
    struct Entry {
        const Image* image = nullptr;
        PictureRefusal refusal;
    };
    // Where the file is, as named from the working directory; nullopt with a refusal.
    std::optional<std::string> name(std::string_view href, std::string_view what, PictureRefusal& refusal);
    // Its bytes; nullopt with a refusal. `hint` says what could be read.
    std::optional<FileBelow> bytes(const std::string& named, std::string_view what, std::string_view hint,
                                   PictureRefusal& refusal);
    bool count(const FileBelow& file, const std::string& named, PictureRefusal& refusal);
    Entry read(const std::string& named);

    std::vector<InputFolder> folder_;
    std::function<std::optional<Source>(const std::string& path)> read_;
    std::function<std::optional<std::string>(const std::string& path)> overlay_;
    std::map<std::string, Entry, std::less<>> by_name_;  // as named from the working directory
    std::map<std::string, Image> by_path_;               // canonical
    struct Text {
        std::optional<std::string> text;
        PictureRefusal refusal;
    };
    std::map<std::string, Text, std::less<>> texts_;  // as named from the working directory
    std::size_t bytes_ = 0;                           // of all of them
    std::vector<std::string> files_;
    std::set<std::string> missing_;
};

}  // namespace popup
