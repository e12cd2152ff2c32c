#include "popup/files.h"

#include <fcntl.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <climits>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string_view>
#include <system_error>
#include <utility>

#include "base/system/digest.h"
#include "base/system/reason.h"
#include "base/system/signal_cleanup.h"

namespace popup {
namespace {

// A file descriptor that closes itself.
class Descriptor {
 public:
    explicit Descriptor(int fd) : fd_(fd) {}
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    ~Descriptor() {
        if (fd_ >= 0) ::close(fd_);
    }
    [[nodiscard]] int get() const { return fd_; }
    [[nodiscard]] bool open() const { return fd_ >= 0; }
    // Closes now; some file systems tell only here that a write has failed.
    int close() {
        const int result = ::close(fd_);
        fd_ = -1;
        return result;
    }

 private:
    int fd_;
};

// Reads to the end, or one byte past the limit. Returns 0 or errno.
int read_all(int fd, std::size_t limit, std::size_t expected, std::string& text) {
    std::size_t used = 0;
    text.resize(std::min(limit, std::max<std::size_t>(expected, 4096)) + 1);
    for (;;) {
        if (used == text.size()) {
            if (used > limit) break;
            text.resize(std::min(limit + 1, 2 * used));
        }
        const ssize_t got = ::read(fd, text.data() + used, text.size() - used);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) return errno;
        if (got == 0) break;
        used += static_cast<std::size_t>(got);
    }
    text.resize(used);
    return 0;
}

// Writes everything. Returns 0 or errno.
int write_fully(int fd, std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t put = ::write(fd, bytes.data(), std::min<std::size_t>(bytes.size(), 1u << 30));
        if (put < 0 && errno == EINTR) continue;
        if (put < 0) return errno;
        bytes.remove_prefix(static_cast<std::size_t>(put));
    }
    return 0;
}

// Temporary files of the running write_all(). The names are listed before any file is made, so no signal
// finds a file it does not know of. It may be called at any moment: unlink() and nothing else.
void remove_litter(void* names) {
    for (const char* name : *static_cast<const std::vector<const char*>*>(names)) ::unlink(name);
}

std::string directory_of(const std::string& path) {
    const std::size_t slash = path.rfind('/');
    if (slash == std::string::npos) return ".";
    return slash == 0 ? "/" : path.substr(0, slash);
}

std::string beside(const std::string& path, const std::string& name) {
    const std::size_t slash = path.rfind('/');
    return slash == std::string::npos ? name : path.substr(0, slash + 1) + name;
}

constexpr std::size_t kMachineDigits = 8;

// What tells the processes of this machine, and of this space of process numbers in it, from others that
// share the disk.
const std::string& machine() {
    static const std::string id = [] {
        std::array<char, 256> name{};
        ::gethostname(name.data(), name.size() - 1);
        std::array<char, 64> space{};
        const ssize_t length = ::readlink("/proc/self/ns/pid", space.data(), space.size() - 1);
        std::string text = std::string(name.data()) + '/';
        text.append(space.data(), length > 0 ? static_cast<std::size_t>(length) : 0);
        // Machines of one name are not alike in this; and what ran before the machine was started anew is
        // dead.
        const Descriptor boot(::open("/proc/sys/kernel/random/boot_id", O_RDONLY | O_CLOEXEC));
        std::string id;
        if (boot.open() && read_all(boot.get(), 64, 0, id) == 0) text += '/' + id;
        return sha256(text).substr(0, kMachineDigits);
    }();
    return id;
}

// False for a process that has ended and waits for its parent to hear of it, too.
bool is_running(pid_t process) {
    if (::kill(process, 0) != 0 && errno == ESRCH) return false;
    const Descriptor file(
        ::open(("/proc/" + std::to_string(process) + "/stat").c_str(), O_RDONLY | O_CLOEXEC));
    std::string text;
    if (!file.open() || read_all(file.get(), 4096, 512, text) != 0) return true;
    // "17 (name) S …": the name may hold anything.
    const std::size_t close = text.rfind(')');
    const char state = close != std::string::npos && close + 2 < text.size() ? text[close + 2] : 'R';
    return state != 'Z' && state != 'X';
}

constexpr std::string_view kTemporary = ".popup-";
constexpr std::string_view kTemporaryEnd = ".tmp";
constexpr std::string_view kKeptEnd = ".old";
constexpr std::size_t kNoiseBytes = 8;

// ".popup-MACHINE-PROCESS-NOISE.tmp". Random, so that no other file, not even one another machine makes in a
// shared directory, has this name.
std::string temporary_name() {
    static std::atomic<unsigned> counter{0};
    std::array<unsigned char, kNoiseBytes> noise{};
    if (::getrandom(noise.data(), noise.size(), 0) != static_cast<ssize_t>(noise.size())) {
        const unsigned number = counter++;
        std::memcpy(noise.data(), &number, sizeof number);
    }
    std::string name = std::string(kTemporary) + machine() + '-' + std::to_string(::getpid()) + '-';
    for (const unsigned char byte : noise) {
        name += "0123456789abcdef"[byte >> 4U];
        name += "0123456789abcdef"[byte & 15U];
    }
    return name.append(kTemporaryEnd);
}

// What the name of a temporary file says of who made it.
struct Temporary {
    std::string_view machine;
    pid_t process = 0;
};

// Nullopt for a name that temporary_name() does not give: that is somebody's own file. The result points into
// `name`.
std::optional<Temporary> temporary_of(std::string_view name) {
    if (!name.starts_with(kTemporary) || !name.ends_with(kTemporaryEnd)) return std::nullopt;
    name.remove_prefix(kTemporary.size());
    name.remove_suffix(std::min(name.size(), kTemporaryEnd.size()));
    if (name.size() < kMachineDigits + 1 || name[kMachineDigits] != '-') return std::nullopt;
    Temporary made{name.substr(0, kMachineDigits)};
    name.remove_prefix(kMachineDigits + 1);
    const char* const end = name.data() + name.size();
    const auto [stop, wrong] = std::from_chars(name.data(), end, made.process);
    if (wrong != std::errc() || stop == end || *stop != '-' || made.process <= 0) return std::nullopt;
    const std::string_view noise(stop + 1, static_cast<std::size_t>(end - stop - 1));
    if (noise.size() != 2 * kNoiseBytes) return std::nullopt;
    return made;
}

// Whether nothing has changed about a file for so long: not what is in it, nor its names. The latter tells of
// an old file that waits under such a name for a run to succeed. The two clocks may be those of two machines.
bool has_lain(const std::string& path, std::chrono::system_clock::time_point now,
              std::chrono::seconds keeps) {
    struct stat status {};
    if (::lstat(path.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return false;
    const std::int64_t seconds = std::chrono::floor<std::chrono::seconds>(now.time_since_epoch()).count();
    return seconds - static_cast<std::int64_t>(status.st_ctim.tv_sec) > keeps.count();
}

bool same_file(const struct stat& a, const struct stat& b) {
    return a.st_dev == b.st_dev && a.st_ino == b.st_ino;
}

// One output on its way.
struct Target {
    const PendingFile* file = nullptr;
    std::string path;  // links followed
    std::string temporary;
    bool stream = false;     // written through at the end, not replaced
    bool unchanged = false;  // holds these bytes already
    bool exists = false;
    struct stat old {};
    bool renamed = false;
    // Holds the old file once the new one is in place: the temporary one where names can be exchanged.
    std::string saved;
};

// Follows symbolic links of the last path component by hand, because the last one may lead to a file that
// does not exist yet. Returns 0 or errno; `magic` tells that a link was one of /proc's, which names an open
// file.
int follow_links(std::string& path, bool& magic) {
    for (int hops = 0; hops < 40; ++hops) {
        std::array<char, PATH_MAX> link{};
        const ssize_t length = ::readlink(path.c_str(), link.data(), link.size() - 1);
        if (length < 0) return errno == EINVAL || errno == ENOENT ? 0 : errno;
        if (path.starts_with("/proc/") || path.starts_with("/dev/fd/")) magic = true;
        const std::string to(link.data(), static_cast<std::size_t>(length));
        path = to.starts_with('/') ? to : beside(path, to);
    }
    return ELOOP;
}

// Finds out what is to be done for one output. Returns an empty string, or why it cannot be done.
std::string prepare(Target& target) {
    const std::string& path = target.file->path;
    if (path == "-") {
        target.stream = true;
        return {};
    }
    if (path.empty()) return "the name is empty";
    struct stat now {};
    if (::stat(path.c_str(), &now) == 0) {
        if (S_ISDIR(now.st_mode)) return reason_of(EISDIR);
        struct stat standard_output {};
        const bool is_stdout =
            ::fstat(STDOUT_FILENO, &standard_output) == 0 && same_file(now, standard_output);
        target.exists = true;
        target.old = now;
        target.stream = !S_ISREG(now.st_mode) || is_stdout;
    } else if (errno != ENOENT) {
        return reason_of(errno);
    }
    target.path = path;
    if (target.stream) return {};
    bool magic = false;
    if (const int error = follow_links(target.path, magic); error != 0) return reason_of(error);
    if (magic) {
        target.stream = true;
        target.path = path;
        return {};
    }
    const std::string directory = directory_of(target.path);
    struct stat where {};
    if (::stat(directory.c_str(), &where) != 0) return "directory " + directory + ": " + reason_of(errno);
    if (!S_ISDIR(where.st_mode)) return directory + " is not a directory";
    if (target.path.ends_with('/')) return "it names a directory";
    // Renaming would replace a read-only file without asking; its owner meant something else.
    if (target.exists && ::access(target.path.c_str(), W_OK) != 0) return reason_of(errno);
    target.temporary = beside(target.path, temporary_name());
    if (target.exists) target.saved = beside(target.path, temporary_name());
    return {};
}

bool holds(const Target& target) {
    const std::string& bytes = target.file->bytes;
    if (!target.exists || target.stream || static_cast<std::size_t>(target.old.st_size) != bytes.size()) {
        return false;
    }
    const Descriptor in(::open(target.path.c_str(), O_RDONLY | O_CLOEXEC));
    std::string text;
    return in.open() && read_all(in.get(), bytes.size(), bytes.size(), text) == 0 && text == bytes;
}

// Writes the temporary file and sees it safely to the disk. Returns 0 or errno.
int write_temporary(const Target& target) {
    // 0666 lets the umask decide; what exists keeps its permissions.
    Descriptor out(::open(target.temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
    if (!out.open()) return errno;
    if (const int error = write_fully(out.get(), target.file->bytes); error != 0) return error;
    if (target.exists) {
        mode_t mode = target.old.st_mode & 07777U;
        struct stat made {};
        if (::fstat(out.get(), &made) != 0) return errno;
        if ((made.st_uid != target.old.st_uid || made.st_gid != target.old.st_gid) &&
            ::fchown(out.get(), target.old.st_uid, target.old.st_gid) != 0) {
            mode &= 0777U;  // not ours to give away: then without set-id bits
        }
        if (::fchmod(out.get(), mode) != 0) return errno;
    }
    if (::fsync(out.get()) != 0 && errno != EINVAL) return errno;
    return out.close() == 0 ? 0 : errno;
}

int write_stream(const Target& target) {
    if (target.file->path == "-") return write_fully(STDOUT_FILENO, target.file->bytes);
    struct stat standard_output {};
    if (target.exists && ::fstat(STDOUT_FILENO, &standard_output) == 0 &&
        same_file(target.old, standard_output)) {
        return write_fully(STDOUT_FILENO, target.file->bytes);
    }
    Descriptor out(::open(target.path.c_str(), O_WRONLY | O_CLOEXEC));
    if (!out.open()) return errno;
    if (const int error = write_fully(out.get(), target.file->bytes); error != 0) return error;
    return out.close() == 0 ? 0 : errno;
}

// Keeps the old file under a second name, or a copy of it where a file can have but one. Returns 0 or errno.
int save_old(const Target& target) {
    if (::link(target.path.c_str(), target.saved.c_str()) == 0) return 0;
    const Descriptor in(::open(target.path.c_str(), O_RDONLY | O_CLOEXEC));
    if (!in.open()) return errno;
    std::string text;
    if (const int error = read_all(in.get(), std::string().max_size() - 1,
                                   static_cast<std::size_t>(target.old.st_size), text);
        error != 0) {
        return error;
    }
    Descriptor out(::open(target.saved.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600));
    if (!out.open()) return errno;
    if (const int error = write_fully(out.get(), text); error != 0) return error;
    if (::fchmod(out.get(), target.old.st_mode & 07777U) != 0) return errno;
    return out.close() == 0 ? 0 : errno;
}

// Moves the new file into place. Where the file system can, old and new change places in one step; elsewhere
// the old one is saved first where a failure of others, `among_others`, may have to bring it back. Returns 0
// or errno.
int move_into_place(Target& target, bool among_others) {
    if (target.exists && ::renameat2(AT_FDCWD, target.temporary.c_str(), AT_FDCWD, target.path.c_str(),
                                     RENAME_EXCHANGE) == 0) {
        target.renamed = true;
        target.saved = target.temporary;
        return 0;
    }
    if (target.exists && among_others) {
        if (const int error = save_old(target); error != 0) return error;
    }
    if (::rename(target.temporary.c_str(), target.path.c_str()) != 0) return errno;
    target.renamed = true;
    return 0;
}

// Sees names in the directory safely to the disk: a file is there after a power cut once its name is, too.
// What cannot be synced, such as a directory of a network, has been told to the system at least.
void sync_names(const std::string& directory) {
    const Descriptor held(::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (held.open()) ::fsync(held.get());
}

// An old file that cannot be brought back is all that is left of it: under the name of a temporary file the
// next run would clear it away. Returns the name that it has then.
std::string keep_saved(const Target& target, bool& clears) {
    std::string kept = target.saved;
    kept.replace(kept.size() - kTemporaryEnd.size(), kTemporaryEnd.size(), kKeptEnd);
    clears = ::rename(target.saved.c_str(), kept.c_str()) != 0 &&
             (::link(target.saved.c_str(), kept.c_str()) != 0 || ::unlink(target.saved.c_str()) != 0);
    return clears ? target.saved : kept;
}

// Brings the old file back, or takes the new one away where there was none. Returns 0 or errno.
int undo(const Target& target) {
    if (!target.renamed) return 0;
    const int result =
        target.exists ? ::rename(target.saved.c_str(), target.path.c_str()) : ::unlink(target.path.c_str());
    return result == 0 ? 0 : errno;
}

}  // namespace

std::string Source::stem() const {
    if (name == "-") return "stdin";
    const std::size_t slash = name.rfind('/');
    std::string last = slash == std::string::npos ? name : name.substr(slash + 1);
    const std::size_t dot = last.rfind('.');
    if (dot != std::string::npos && dot > 0) last.resize(dot);
    // Of an assembly's two.
    constexpr std::string_view kAssembly = ".assembly";
    if (name.ends_with(".assembly.json") && last.size() > kAssembly.size())
        last.resize(last.size() - kAssembly.size());
    return last;
}

std::optional<Source> read_source(const std::string& name, Diagnostics& diagnostics,
                                  std::size_t limit_bytes) {
    const bool standard = name == "-";
    // Who gathers troubles of several files has no name on them.
    const std::string unread = diagnostics.file().empty()
                                   ? (standard ? "standard input" : name) + " cannot be read: "
                                   : "cannot be read: ";
    const auto refuse = [&](const std::string& why) {
        diagnostics.error("unreadable-input", {}, unread + why);
        return std::nullopt;
    };
    const Descriptor file(standard ? -1 : ::open(name.c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY));
    if (!standard && !file.open()) return refuse(reason_of(errno));
    const int fd = standard ? STDIN_FILENO : file.get();
    struct stat status {};
    if (::fstat(fd, &status) != 0) return refuse(reason_of(errno));
    if (S_ISDIR(status.st_mode)) {
        diagnostics.error("unreadable-input", {}, unread + reason_of(EISDIR))
            .hint("name the files in it; only check, fix and gallery look into directories");
        return std::nullopt;
    }
    const auto too_large = [&](const std::string& size) {
        return refuse("it holds " + size + " bytes, the limit is " + std::to_string(limit_bytes));
    };
    const auto size = S_ISREG(status.st_mode) ? static_cast<std::size_t>(status.st_size) : 0;
    if (size > limit_bytes) return too_large(std::to_string(size));
    Source source{name, {}};
    if (const int error = read_all(fd, limit_bytes, size, source.text); error != 0) {
        return refuse(reason_of(error));
    }
    if (source.text.size() > limit_bytes) return too_large("more than " + std::to_string(limit_bytes));
    return source;
}

bool write_all(const std::vector<PendingFile>& files, bool keep_identical, Diagnostics& diagnostics) {
    bool good = true;
    const auto fail = [&](const Target& target, const std::string& why) {
        const std::string name = target.file->path == "-" ? "standard output" : target.file->path;
        diagnostics.error("unwritable-output", {}, name + " cannot be written: " + why);
        good = false;
    };

    std::vector<Target> targets(files.size());
    std::map<std::string, const Target*> names;
    for (std::size_t i = 0; i < files.size(); ++i) {
        Target& target = targets[i];
        target.file = &files[i];
        const std::string why = prepare(target);
        if (!why.empty()) {
            fail(target, why);
            continue;
        }
        if (keep_identical && !files[i].fresh) target.unchanged = holds(target);
        if (target.stream) continue;
        struct stat where {};
        const std::string directory = directory_of(target.path);
        if (::stat(directory.c_str(), &where) != 0) continue;  // prepare() has just seen it; open() will tell
        const std::string identity = std::to_string(where.st_dev) + ":" + std::to_string(where.st_ino) + ":" +
                                     target.path.substr(target.path.rfind('/') + 1);
        const auto [other, is_new] = names.emplace(identity, &target);
        if (is_new) continue;
        const std::string& taken = other->second->file->path;
        fail(target, taken == files[i].path ? "two outputs of this run would have this name"
                                            : "it is the same file as " + taken);
    }
    if (!good) return false;

    std::vector<const char*> litter;
    std::vector<std::string> saved;
    for (const Target& target : targets) {
        if (target.stream || target.unchanged) continue;
        litter.push_back(target.temporary.c_str());
        if (target.exists) saved.push_back(target.saved);
    }
    for (const std::string& name : saved) litter.push_back(name.c_str());
    const bool among_others = litter.size() - saved.size() > 1;
    const SignalCleanup guard(remove_litter, &litter);
    for (const Target& target : targets) {
        if (target.stream || target.unchanged) continue;
        if (const int error = write_temporary(target); error != 0) {
            fail(target, reason_of(error));
            break;
        }
    }
    // What cannot be taken back comes after everything that is likely to fail.
    for (const Target& target : targets) {
        if (!good) break;
        if (!target.stream) continue;
        if (const int error = write_stream(target); error != 0) fail(target, reason_of(error));
    }
    const SignalPause pause;
    for (Target& target : targets) {
        if (!good) break;
        if (target.stream || target.unchanged) continue;
        if (const int error = move_into_place(target, among_others); error != 0)
            fail(target, reason_of(error));
    }
    if (good) {
        std::set<std::string> directories;
        for (const Target& target : targets) {
            if (target.renamed) directories.insert(directory_of(target.path));
        }
        for (const std::string& directory : directories) sync_names(directory);
    } else {
        for (const Target& target : targets) {
            const int error = undo(target);
            if (error == 0) continue;
            std::string why = "the old version cannot be brought back, either: " + reason_of(error);
            if (target.exists) {
                // Nobody may take it away. A signal may look at the names now.
                for (const char*& name : litter) {
                    if (name == target.saved) name = "";
                }
                bool clears = false;
                why += "; it is in " + keep_saved(target, clears);
                if (clears) why += ", which the next run clears: move it elsewhere before";
            }
            fail(target, why);
        }
    }
    for (const char* name : litter) ::unlink(name);
    return good;
}

NewFile::NewFile(std::string path) : path_(std::move(path)) {}

NewFile::~NewFile() {
    if (fd_ < 0) return;
    ::close(fd_);
    ::unlink(temporary_.c_str());
}

bool NewFile::fail() {
    trouble_ = reason_of(errno);
    return false;
}

bool NewFile::open() {
    temporary_ = beside(path_, temporary_name());
    fd_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC,
                 static_cast<mode_t>(mode_.value_or(0666U) & 0777U));
    if (fd_ < 0) return fail();
    // open() takes away what the mask of the process does not allow.
    if (mode_) keep_mode(*mode_);
    return true;
}

bool NewFile::write(std::string_view bytes) {
    if (fd_ < 0 && !open()) return false;
    errno = write_fully(fd_, bytes);
    return errno == 0 || fail();
}

void NewFile::keep_mode(unsigned mode) {
    mode_ = mode;
    if (fd_ >= 0) ::fchmod(fd_, static_cast<mode_t>(mode & 0777U));
}

bool NewFile::commit() {
    if (fd_ < 0 && !open()) return false;
    if (::fsync(fd_) != 0 && errno != EINVAL) return fail();
    if (::rename(temporary_.c_str(), path_.c_str()) != 0) return fail();
    sync_names(directory_of(path_));
    ::close(std::exchange(fd_, -1));
    return true;
}

std::size_t remove_litter(const std::string& directory, std::chrono::system_clock::time_point now) {
    std::size_t removed = 0;
    std::error_code error;
    std::vector<std::string> stale;
    for (std::filesystem::directory_iterator at(directory.empty() ? "." : directory, error), end;
         !error && at != end; at.increment(error)) {
        const std::string path = at->path().string();
        const std::string name = at->path().filename().string();
        const std::optional<Temporary> made = temporary_of(name);
        if (!made) continue;
        const bool has_ended = made->machine == machine() && !is_running(made->process);
        if (has_ended || has_lain(path, now, kLitterKeeps)) stale.push_back(path);
    }
    for (const std::string& name : stale) {
        if (::unlink(name.c_str()) == 0) ++removed;
    }
    return removed;
}

}  // namespace popup
