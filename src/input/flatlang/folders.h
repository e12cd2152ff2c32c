// Where programs are loaded from: the program's own folder, folders that were named, and the kit. Nothing
// else can be read.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "popup/language.h"

namespace popup::flatlang {

struct LoadedFile {
    std::string name;  // to show in findings: a path as the user would write it, or "kit/gear.fl"
    std::string text;
    bool of_kit = false;
};

class Folders {
 public:
    // `program`: the source that is run; of standard input the folder is the working directory.
    Folders(const Source& program, const ProgramOptions& options);

    // The file that load(name) means: "kit/…" of the kit, else the first of that name below the program's
    // folder or one of the named folders. nullopt: there is none, and `why` says so in a sentence, with the
    // places that were looked at, or that the name leads out of these ("..", links, absolute names that lead
    // elsewhere), which is never followed.
    std::optional<LoadedFile> find(std::string_view name, std::string& why) const;

 private:
    std::vector<std::string> folders_;
    std::function<std::optional<Source>(const std::string& path)> read_;
};

// A file of the kit by its name without "kit/" ("gear.fl"); null: there is none.
const std::string_view* kit_file(std::string_view name);
// Their names, sorted.
std::vector<std::string_view> kit_files();

}  // namespace popup::flatlang
