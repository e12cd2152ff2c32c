// Reading inputs and writing outputs, the only place that touches the disk.
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "popup/diagnostics.h"

namespace popup {

// Bytes and a name. The name is what the user typed ("-" for standard input); stages never open it.
struct Source {
    std::string name;
    std::string text;

    // The name's last part without its suffix: "designs/castle.xml" is "castle", so is
    // "castle.assembly.json", and standard input "stdin".
    [[nodiscard]] std::string stem() const;
};

// Reads a whole file, or standard input for "-". Files above `limit_bytes` are refused.
// nullopt after an `unreadable-input` error (missing, a directory, no permission, too large) with its name.
std::optional<Source> read_source(const std::string& name, Diagnostics& diagnostics,
                                  std::size_t limit_bytes = 64u << 20);

// True for "-" and for the other names of standard output.
bool is_standard_output(const std::string& path);

// True when both names are the same file now, or would be once written.
bool same_place(const std::string& a, const std::string& b);

// True when writing `output` would replace the file `input`.
bool overwrites(const std::string& output, const std::string& input);

// A file to be written. "-" is standard output.
struct PendingFile {
    std::string path;
    std::string bytes;
    bool fresh = false;  // written even where `keep_identical` finds the same bytes
};

// Writes all of them, or none: each goes to a temporary file in its own directory, is flushed, and only when
// all are safely there are they renamed into place. On failure an `unwritable-output` error is added, no old
// file has changed, and no temporary file is left. Signals that end the process also leave no litter. Devices
// and pipes (/dev/stdout, /dev/null, a fifo) are written through, not replaced. Symbolic links are followed.
// Where the file system cannot exchange two names, old files have a second name, or a copy, until all new
// ones are in place. Should the disk refuse to bring an old file back, the error says where it is, under a
// name that remove_litter() passes over. With `keep_identical`, a file that already holds these bytes is left
// alone, modification time included.
bool write_all(const std::vector<PendingFile>& files, bool keep_identical, Diagnostics& diagnostics);

// A file written piece by piece, which replaces the old one when it is complete, and never before.
class NewFile {
 public:
    // Nothing is made before the first write().
    explicit NewFile(std::string path);
    NewFile(const NewFile&) = delete;
    NewFile& operator=(const NewFile&) = delete;
    ~NewFile();  // without commit(): no trace is left
    // False: it cannot be written; trouble() says why.
    bool write(std::string_view bytes);
    // The permissions it shall have from then on; without, those of a new file. Where that cannot be done
    // they stay.
    void keep_mode(unsigned mode);
    // Flushes what was written and moves it into place.
    bool commit();
    [[nodiscard]] const std::string& trouble() const { return trouble_; }

 private:
    bool open();
    bool fail();
    std::string path_;
    std::string temporary_;
    std::optional<unsigned> mode_;
    std::string trouble_;
    int fd_ = -1;
};

// How long a temporary file is left alone whose process cannot be asked after. None is on its way for longer
// than it takes to write one run's files; a day is more than clocks of machines that share a disk differ.
inline constexpr std::chrono::hours kLitterKeeps{24};

// Takes away the temporary files that runs left in the directory because they were killed: those of this
// machine, since it was started last, whose process has ended; and whatever else has such a name and has not
// changed for kLitterKeeps before `now`. So goes what was left before the machine was started anew, by
// another machine that shares the disk, or in a container whose processes cannot be seen from here, and what
// has the number of a process that runs by now. Returns how many there were.
std::size_t remove_litter(const std::string& directory,
                          std::chrono::system_clock::time_point now = std::chrono::system_clock::now());

}  // namespace popup
