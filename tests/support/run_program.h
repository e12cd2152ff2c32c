// Running programs from tests, and directories to run them in.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace popup::test {

struct RunResult {
    int exit = -1;  // exit status; 128 + number when a signal ended the program
    std::string out;
    std::string err;
};

struct RunOptions {
    std::filesystem::path directory;  // empty: this process's own
    std::string input;                // what standard input holds
    // Set on top of this process's own, from which all POPUPC_* are taken out. POPUPC_NO_CONFIG is 1 unless
    // it is set here (empty, to look for a popupc.toml): none above the tests' directories disturbs them.
    // Sanitized, ASAN_OPTIONS is detect_leaks=0:exitcode=86 where nobody has set it.
    std::map<std::string, std::string> environment;
};

// Runs a program to its end. words[0] is the program, found in PATH when it has no slash; 127 when there is
// none. Standard output and error go through files, so that no amount of output blocks.
RunResult run(const std::vector<std::string>& words, const RunOptions& options = {});

// Where the popupc is that tests start. Set before anything that is initialized at run time.
extern const char* const kPopupc;

// Runs popupc with these arguments.
RunResult popupc(std::vector<std::string> arguments, const RunOptions& options = {});

// True when PATH has this program.
bool have_program(const std::string& name);

// An empty directory that goes away with everything in it.
class ScratchDirectory {
 public:
    ScratchDirectory();
    ScratchDirectory(const ScratchDirectory&) = delete;
    ScratchDirectory& operator=(const ScratchDirectory&) = delete;
    ~ScratchDirectory();
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    [[nodiscard]] std::filesystem::path operator/(std::string_view name) const { return path_ / name; }
    // Names of everything in it, sorted; hidden files too.
    [[nodiscard]] std::vector<std::string> names() const;

 private:
    std::filesystem::path path_;
};

// The whole file; empty when it cannot be read.
std::string read_file(const std::filesystem::path& path);
// Makes or replaces the file; throws when that cannot be done.
void write_file(const std::filesystem::path& path, std::string_view bytes);

}  // namespace popup::test
