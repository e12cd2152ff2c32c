#include "batch/kept_lines.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <system_error>
#include <utility>

#include "base/system/reason.h"
#include "base/system/signal_cleanup.h"
#include "popup/files.h"

namespace popup {
namespace {

// Appends all of it in one call where the system lets it.
bool append(int fd, std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t put = ::write(fd, bytes.data(), bytes.size());
        if (put < 0 && errno == EINTR) continue;
        if (put < 0) return false;
        bytes.remove_prefix(static_cast<std::size_t>(put));
    }
    return true;
}

}  // namespace

bool KeptLines::fail(std::string why) {
    trouble_ = std::move(why);
    return false;
}

bool KeptLines::open(const std::string& name, std::string_view begin) {
    fd_ = ::open(name.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
    if (fd_ < 0) return fail(reason_of(errno));
    if (::flock(fd_, LOCK_EX | LOCK_NB) != 0) {
        return fail(errno == EWOULDBLOCK ? "another run is writing its results there" : reason_of(errno));
    }
    // A run that finished in between may have put another file in its place.
    struct stat held {};
    struct stat named {};
    if (::fstat(fd_, &held) != 0 || ::stat(name.c_str(), &named) != 0 || held.st_ino != named.st_ino ||
        held.st_dev != named.st_dev) {
        return fail("another run has just written its results there");
    }
    if (!S_ISREG(held.st_mode)) return fail("it is no file");
    // Somebody's file is not written to, let alone put in order.
    std::string first(begin.size(), '\0');
    const ssize_t read = ::pread(fd_, first.data(), first.size(), 0);
    if (read > 0 && first != begin) return fail("it holds something else than results");
    char last = '\n';
    if (held.st_size > 0 && ::pread(fd_, &last, 1, held.st_size - 1) != 1) return fail(reason_of(errno));
    if (last != '\n' && !append(fd_, "\n")) return fail(reason_of(errno));
    std::error_code error;
    const std::filesystem::path path = std::filesystem::canonical(name, error);
    name_ = error ? name : path.string();
    return true;
}

bool KeptLines::add(std::string_view line) { return append(fd_, line) || fail(reason_of(errno)); }

bool KeptLines::settle(const std::function<std::optional<std::string>()>& next) {
    const SignalPause pause;
    std::ifstream old(name_, std::ios::binary);
    NewFile made(name_);
    bool same = true;
    while (const std::optional<std::string> line = next()) {
        std::string there;
        same = same && std::getline(old, there) && there + "\n" == *line;
        if (!made.write(*line)) return fail(made.trouble());
    }
    if (same && old.peek() == std::ifstream::traits_type::eof()) {
        if (::fsync(fd_) != 0 && errno != EINVAL) return fail(reason_of(errno));
        return ::futimens(fd_, nullptr) == 0 || fail(reason_of(errno));
    }
    struct stat now {};
    if (::fstat(fd_, &now) == 0) made.keep_mode(now.st_mode);
    return made.commit() || fail(made.trouble());
}

void KeptLines::close() {
    if (fd_ >= 0) ::close(fd_);
    fd_ = -1;
}

}  // namespace popup
