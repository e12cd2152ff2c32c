// Which names of files mean the same one.
#include <sys/stat.h>

#include <filesystem>
#include <system_error>

#include "popup/files.h"

namespace popup {
namespace {

std::string canonical(const std::string& path) {
    std::error_code error;
    const std::filesystem::path whole = std::filesystem::absolute(path, error);
    if (error) return path;
    const std::filesystem::path result = std::filesystem::weakly_canonical(whole, error);
    return error ? path : result.string();
}

}  // namespace

bool is_standard_output(const std::string& path) {
    return path == "-" || path == "/dev/stdout" || path == "/dev/fd/1" || path == "/proc/self/fd/1";
}

bool same_place(const std::string& a, const std::string& b) {
    if (a == b || (is_standard_output(a) && is_standard_output(b))) return true;
    if (a == "-" || b == "-") return false;
    struct stat one {};
    struct stat two {};
    if (::stat(a.c_str(), &one) == 0 && ::stat(b.c_str(), &two) == 0) {
        return one.st_dev == two.st_dev && one.st_ino == two.st_ino;
    }
    return canonical(a) == canonical(b);
}

bool overwrites(const std::string& output, const std::string& input) {
    if (input == "-" || is_standard_output(output)) return false;
    struct stat status {};
    // A device, such as a terminal, may well be both.
    if (::stat(input.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return false;
    return same_place(output, input);
}

}  // namespace popup
