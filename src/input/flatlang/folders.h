// Where programs are loaded from: the program's own folder, folders that were named, and the kit. Nothing
// else can be read.
#pragma once

#include <functional>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "input/files_below.h"
#include "popup/language.h"

namespace popup::flatlang {

struct LoadedFile {
    std::string name;  // to show in findings: a path as the user would write it, or "kit/gear.fl"
    std::string text;
    bool of_kit = false;
};

class Folders {
 public:
    // `program`: the source that is run; of standard input the folder is the working directory. Folders are
    // looked up now: one that is not there never has a file.
    Folders(const Source& program, const ProgramOptions& options);

    // The file that load(name) means: "kit/…" of the kit, else the first of that name below the program's
    // folder or one of the named folders, in their order. A name that begins with "/" is looked for below
    // them too. nullopt: there is none, and `why` is a sentence without its full stop that tells the places
    // that were looked at, or that the name leads out of all of these ("..", symbolic links), where nothing
    // is ever read, or that what is there is no regular file, cannot be read, or has more than 4 MiB.
    //
    // Files before it in the order that are not there, and all when there is none, are added to `missing`.
    //
    // With ProgramOptions::read_file folders are beginnings of names and nothing else: the disk is not asked
    // for anything, ".." is taken out of names as text, and nothing is added to `missing`.
    std::optional<LoadedFile> find(std::string_view name, std::string& why,
                                   std::set<std::string>* missing = nullptr) const;

 private:
    // The file at a path, from the disk or from what the options read with; else what kept it from being
    // read, or nothing of what is not there.
    std::optional<LoadedFile> load(const std::string& shown, std::string& trouble,
                                   std::set<std::string>* missing) const;

    std::vector<InputFolder> folders_;
    std::vector<InputFolder> as_named_;  // the same by their names alone, for the overlay
    std::function<std::optional<Source>(const std::string& path)> read_;
    std::function<std::optional<std::string>(const std::string& path)> overlay_;
};

// A file of the kit by its name without "kit/" ("gear.fl"); null: there is none.
const std::string_view* kit_file(std::string_view name);
// Their names, sorted.
std::vector<std::string_view> kit_files();

}  // namespace popup::flatlang
