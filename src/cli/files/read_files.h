// What a run reads, so that nothing it writes takes its place.
//
//     const ReadFiles read = files_read(options, files.names, files.ignore_files);
//     spare(read, options);                             // before anything is read, let alone written
//     for (const PendingFile& file : further) read.spare(file.path, "a further sheet");
#pragma once

#include <sys/types.h>

#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/options/options.h"

namespace popup::cli {

// What else there is to do than to replace an input; the latter for verbs that write documents.
inline constexpr std::string_view kAnotherFileHint = "name another file";
inline constexpr std::string_view kInPlaceHint = "--in-place writes it over its input; or name another file";

// Files by what they are, through links and whatever they are called. A file that is not there, a device or a
// pipe cannot be lost, and is left out.
class ReadFiles {
 public:
    // `as` says what it is read as: "an input". Of several names of a file the first is told.
    void add(const std::string& name, std::string_view as);
    // UsageError when writing `output` would replace one of them, or make a file that later runs would
    // read; `by` is the option that asks for it, or what is written; `hint` says what else there is where a
    // file would be replaced. Cost: one look at the disk.
    void spare(const std::string& output, std::string_view by,
               std::string_view hint = kAnotherFileHint) const;

 private:
    struct Reading {
        std::string name;
        std::string_view as;
    };
    std::map<std::pair<dev_t, ino_t>, Reading> files_;
};

// All that is known to be read before the first input is: inputs, ignore files, settings, the profile, and
// the baseline unless it is to be written.
ReadFiles files_read(const Options& options, const std::vector<std::string>& inputs,
                     const std::vector<std::string>& ignore_files = {});

// UsageError when an output that the options name would replace one of them: outputs, findings, what programs
// print, the dependency file, the baseline.
void spare(const ReadFiles& read, const Options& options);

}  // namespace popup::cli
