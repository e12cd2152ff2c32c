#include "cli/files/file_changes.h"

#include <fmt/format.h>
#include <poll.h>
#include <sys/inotify.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <climits>
#include <cstddef>
#include <deque>
#include <filesystem>
#include <system_error>
#include <utility>

#include "base/system/reason.h"
#include "cli/options/options.h"

namespace popup::cli {
namespace {

// Of a directory on the way: that it goes away.
constexpr unsigned kSelf = IN_DELETE_SELF | IN_MOVE_SELF | IN_ONLYDIR;
// Of one with an entry that matters: what becomes of its entries.
constexpr unsigned kEntries =
    IN_CREATE | IN_DELETE | IN_MOVED_FROM | IN_MOVED_TO | IN_CLOSE_WRITE | IN_ATTRIB;
// Events that mean a change even where the file looks the same.
constexpr unsigned kSure = IN_CREATE | IN_DELETE | IN_MOVED_FROM | IN_MOVED_TO | IN_CLOSE_WRITE;

constexpr int kMostLinks = 40;
constexpr int kMostLooks = 10;

std::string joined(const std::string& directory, const std::string& name) {
    return directory.ends_with('/') ? directory + name : directory + "/" + name;
}

std::deque<std::string> components(const std::string& path) {
    std::deque<std::string> parts;
    for (std::size_t at = 0; at < path.size();) {
        const std::size_t slash = std::min(path.find('/', at), path.size());
        if (slash > at) parts.push_back(path.substr(at, slash - at));
        at = slash + 1;
    }
    return parts;
}

std::optional<std::string> link_target(const std::string& path) {
    std::array<char, PATH_MAX> text{};
    const ssize_t length = ::readlink(path.c_str(), text.data(), text.size());
    if (length < 0) return std::nullopt;
    return std::string(text.data(), static_cast<std::size_t>(length));
}

[[noreturn]] void refuse(int error, bool watches) {
    const std::string why = reason_of(error);
    if (error == ENOSPC || (error == EMFILE && !watches)) {
        const char* setting = watches ? "fs.inotify.max_user_watches" : "fs.inotify.max_user_instances";
        throw UsageError(
            fmt::format("files cannot be watched: the limit {} is reached", setting),
            {fmt::format("\"sysctl {0}\" tells it, and \"sysctl {0}=N\" as root raises it", setting)});
    }
    throw UsageError("files cannot be watched: " + why);
}

}  // namespace

bool FileChanges::Fingerprint::same(const Fingerprint& other) const {
    if (!exists || !other.exists) return exists == other.exists;
    const struct stat& a = status;
    const struct stat& b = other.status;
    return a.st_dev == b.st_dev && a.st_ino == b.st_ino && a.st_size == b.st_size && a.st_mode == b.st_mode &&
           a.st_mtim.tv_sec == b.st_mtim.tv_sec && a.st_mtim.tv_nsec == b.st_mtim.tv_nsec;
}

FileChanges::FileChanges() : inotify_(::inotify_init1(IN_NONBLOCK | IN_CLOEXEC)) {
    if (inotify_ < 0) refuse(errno, false);
}

FileChanges::~FileChanges() { ::close(inotify_); }

FileChanges::Fingerprint FileChanges::fingerprint(const std::string& file) {
    Fingerprint print;
    print.exists = ::stat(file.c_str(), &print.status) == 0;
    return print;
}

// Follows the path from the root on. Directories that are there need only tell when they go; a link, and the
// first thing that is missing, are looked for by name in the directory they are in.
void FileChanges::watch_way(const std::string& file, std::map<std::string, unsigned>& masks,
                            std::map<std::string, std::set<std::string>>& names) {
    std::error_code error;
    std::deque<std::string> parts = components(std::filesystem::absolute(file, error).string());
    std::string directory = "/";
    masks[directory] |= kSelf;
    for (int links = 0; !parts.empty();) {
        const std::string part = parts.front();
        parts.pop_front();
        if (part == ".") continue;
        const std::string path = joined(directory, part);
        const std::optional<std::string> link = link_target(path);
        const bool last = parts.empty();
        struct stat status {};
        const bool is_directory = ::stat(path.c_str(), &status) == 0 && S_ISDIR(status.st_mode);
        if (link || last || !is_directory) {
            masks[directory] |= kSelf | kEntries;
            names[directory].insert(part);
            of_entry_[{directory, part}] = file;
        }
        if (link) {
            if (++links > kMostLinks) return;
            const std::deque<std::string> target = components(*link);
            parts.insert(parts.begin(), target.begin(), target.end());
            if (link->starts_with('/')) directory = "/";
            continue;
        }
        if (!is_directory) return;
        directory = part == ".." ? std::filesystem::path(directory).parent_path().string() : path;
        masks[directory] |= kSelf;
    }
}

void FileChanges::renew() {
    // What comes to be between the look and the watch is found by the second look.
    std::map<std::string, unsigned> before;
    for (int looks = 0; looks < kMostLooks; ++looks) {
        std::map<std::string, unsigned> masks;
        std::map<std::string, std::set<std::string>> names;
        of_entry_.clear();
        for (const std::string& file : files_) watch_way(file, masks, names);
        if (masks == before) return;
        std::map<int, Directory> now;
        for (const auto& [path, mask] : masks) {
            const int watch = ::inotify_add_watch(inotify_, path.c_str(), mask);
            if (watch >= 0) {
                now[watch] = {path, names[path]};
            } else if (errno != ENOENT && errno != ENOTDIR && errno != EACCES) {
                refuse(errno, true);
            }
        }
        for (const auto& [watch, directory] : directories_) {
            if (!now.contains(watch)) ::inotify_rm_watch(inotify_, watch);
        }
        directories_ = std::move(now);
        before = std::move(masks);
    }
}

void FileChanges::look_at(const std::vector<std::string>& files) {
    files_ = files;
    renew();
    std::map<std::string, Fingerprint> prints;
    for (const std::string& file : files_) {
        const auto known = prints_.find(file);
        prints[file] = known != prints_.end() ? known->second : fingerprint(file);
    }
    prints_ = std::move(prints);
    // Events of directories that are not looked at any more are lost, and what they told of with them.
    unsure_ = true;
}

// The first file that does not look as before.
std::optional<std::string> FileChanges::changed_file() {
    std::optional<std::string> changed;
    for (auto& [file, before] : prints_) {
        Fingerprint now = fingerprint(file);
        if (now.same(before)) continue;
        before = now;
        if (!changed) changed = file;
    }
    return changed;
}

std::optional<std::string> FileChanges::read_events() {
    alignas(inotify_event) std::array<char, 16384> buffer{};
    std::optional<std::string> changed;
    bool unsure = std::exchange(unsure_, false);
    bool ways = false;
    for (;;) {
        const ssize_t got = ::read(inotify_, buffer.data(), buffer.size());
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) break;
        for (std::size_t at = 0; at < static_cast<std::size_t>(got);) {
            const auto* event = reinterpret_cast<const inotify_event*>(buffer.data() + at);
            at += sizeof(inotify_event) + event->len;
            if ((event->mask & IN_Q_OVERFLOW) != 0) {
                if (!files_.empty()) changed = files_.front();
                ways = true;
                continue;
            }
            const auto directory = directories_.find(event->wd);
            if (directory == directories_.end()) continue;
            if ((event->mask & (IN_DELETE_SELF | IN_MOVE_SELF | IN_IGNORED | IN_UNMOUNT)) != 0) {
                ways = unsure = true;
                continue;
            }
            const std::string name = event->len > 0 ? event->name : "";
            if (!directory->second.names.contains(name)) continue;
            if ((event->mask & (IN_CREATE | IN_DELETE | IN_MOVED_FROM | IN_MOVED_TO)) != 0) ways = true;
            const auto file = of_entry_.find({directory->second.path, name});
            if (file == of_entry_.end() || (event->mask & IN_ISDIR) != 0 || (event->mask & kSure) == 0) {
                unsure = true;
            } else if (!changed) {
                changed = file->second;
            }
        }
    }
    if (ways) {
        renew();
        unsure = true;
    }
    if (changed) {
        static_cast<void>(changed_file());  // what has been told once
    } else if (unsure) {
        changed = changed_file();
    }
    return changed;
}

std::optional<std::string> FileChanges::wait(int wake, std::optional<std::chrono::milliseconds> longest) {
    using Clock = std::chrono::steady_clock;
    const Clock::time_point end = Clock::now() + longest.value_or(std::chrono::milliseconds(0));
    if (unsure_) {
        if (auto changed = read_events()) return changed;
    }
    for (;;) {
        int left = -1;
        if (longest) {
            const auto rest = std::chrono::ceil<std::chrono::milliseconds>(end - Clock::now());
            left = static_cast<int>(std::max<std::chrono::milliseconds::rep>(rest.count(), 0));
        }
        std::array<pollfd, 2> waiting{pollfd{inotify_, POLLIN, 0}, pollfd{wake, POLLIN, 0}};
        const int ready = ::poll(waiting.data(), waiting.size(), left);
        if (ready < 0 && errno != EINTR) return std::nullopt;
        if (ready > 0 && waiting[1].revents != 0) return std::nullopt;
        if (ready > 0) {
            if (auto changed = read_events()) return changed;
        }
        if (longest && Clock::now() >= end) return std::nullopt;
    }
}

}  // namespace popup::cli
