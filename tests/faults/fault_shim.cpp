// Fails one call of a program that is under test: loaded before the C library by LD_PRELOAD.
//
//   POPUP_FAULT=CALL:N:ERRNO[+]   the N-th call of this kind (from 1) fails with this number of errno; with a
//   plus, all
//                                 from there on do, as on a disk that stays full. CALL is open (of a file to
//                                 write), write, sync, close (of a file that was written), rename, link,
//                                 unlink, chmod, map, allocate, or any: each of these but the last two, in
//                                 one count.
//   POPUP_FAULT=CALL:N:kill       before this call, the program is killed: what it had begun stands as it is
//   POPUP_FAULT_SEEN=FILE         the file is made once a call has failed, so that a test knows when N is
//                                 beyond the end
//   POPUP_FAULT_SHARED=FILE       calls of all processes that have it count together, and what is killed is
//   this
//                                 process and the one that had it first. FILE is empty at first.
//   POPUP_FAULT_TRACE=FILE        a line for each call that a power cut could undo: "write INODE", "sync
//   INODE",
//                                 "rename INODE TO", "exchange INODE TO", "link INODE TO". INODE is the
//                                 number of the file, of a directory too; for the last three that of the name
//                                 TO as the program has it, once it is done.
//   POPUP_NO_EXCHANGE=1           the file system cannot exchange two names, as many network file systems
//   cannot
//
// Only what the program and its libraries call by name can fail: not what the C library does for itself.
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/types.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdarg>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>

extern "C" {
// What malloc() and the like are inside the C library: dlsym() may allocate itself.
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* old, std::size_t size);
}

namespace {

// Zero until setup() has run: nothing fails before main()'s libraries are there.
char wanted[16];
std::size_t wanted_length = 0;
unsigned long at = 0;
int error_number = 0;
bool onwards = false;
bool no_exchange = false;
bool kills = false;
const char* seen = nullptr;
int trace = -1;
struct Shared {
    std::atomic<unsigned long> calls{0};
    std::atomic<int> first{0};  // process
};
Shared own;
Shared* shared = &own;

// The file of that name, which several processes have.
Shared* in_file(const char* name) {
    const long fd = ::syscall(SYS_openat, AT_FDCWD, name, O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (fd < 0 || ::ftruncate(static_cast<int>(fd), sizeof(Shared)) != 0) std::_Exit(126);
    const long at = ::syscall(SYS_mmap, nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED, fd, 0L);
    if (at < 0 && at > -4096) std::_Exit(126);
    ::syscall(SYS_close, fd);
    return reinterpret_cast<Shared*>(at);  // NOLINT(performance-no-int-to-ptr)
}

__attribute__((constructor)) void setup() {
    const char* const fault = std::getenv("POPUP_FAULT");
    no_exchange = std::getenv("POPUP_NO_EXCHANGE") != nullptr;
    seen = std::getenv("POPUP_FAULT_SEEN");
    if (const char* const name = std::getenv("POPUP_FAULT_TRACE"); name != nullptr)
        trace = static_cast<int>(
            ::syscall(SYS_openat, AT_FDCWD, name, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666));
    if (fault == nullptr) return;
    if (const char* const name = std::getenv("POPUP_FAULT_SHARED"); name != nullptr) shared = in_file(name);
    int none = 0;
    shared->first.compare_exchange_strong(none, ::getpid());
    const char* const colon = std::strchr(fault, ':');
    if (colon == nullptr || static_cast<std::size_t>(colon - fault) >= sizeof wanted) std::_Exit(126);
    char* end = nullptr;
    at = std::strtoul(colon + 1, &end, 10);
    kills = std::strcmp(end, ":kill") == 0;
    error_number = static_cast<int>(std::strtol(end + 1, &end, 10));
    onwards = *end == '+';
    std::memcpy(wanted, fault, static_cast<std::size_t>(colon - fault));
    wanted_length = static_cast<std::size_t>(colon - fault);
}

// Whether this call of this kind is to fail; errno is set then.
bool fails(const char* kind) {
    if (wanted_length == 0) return false;
    const bool any = std::strcmp(wanted, "any") == 0 && std::strcmp(kind, "map") != 0 &&
                     std::strcmp(kind, "allocate") != 0;
    if (!any && std::strcmp(kind, wanted) != 0) return false;
    const unsigned long number = ++shared->calls;
    if (onwards ? number < at : number != at) return false;
    if (seen != nullptr)
        ::syscall(SYS_close, ::syscall(SYS_openat, AT_FDCWD, seen, O_WRONLY | O_CREAT, 0666));
    if (kills) {
        if (shared->first != ::getpid()) ::kill(shared->first, SIGKILL);
        ::kill(::getpid(), SIGKILL);
    }
    errno = error_number;
    return true;
}

// A line of the trace, of what has been done.
template <class... Values>
void note(long result, const char* format, Values... values) {
    if (trace < 0 || result < 0) return;
    char line[512];
    const int length = std::snprintf(line, sizeof line, format, values...);
    if (length < 0 || static_cast<std::size_t>(length) >= sizeof line) std::_Exit(126);
    ::syscall(SYS_write, trace, line, static_cast<std::size_t>(length));
}

unsigned long inode(int fd) {
    struct stat status {};
    return trace >= 0 && ::fstat(fd, &status) == 0 ? status.st_ino : 0;
}

unsigned long inode(const char* name) {
    struct stat status {};
    return trace >= 0 && ::stat(name, &status) == 0 ? status.st_ino : 0;
}

template <class Function>
Function* real(Function* /*like*/, const char* name) {
    return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

bool to_write(int flags) { return (flags & O_ACCMODE) != O_RDONLY; }

bool is_written_file(int fd) {
    struct stat status {};
    const int flags = ::fcntl(fd, F_GETFL);
    return flags != -1 && to_write(flags) && ::fstat(fd, &status) == 0 && S_ISREG(status.st_mode);
}

}  // namespace

// NOLINTBEGIN(readability-inconsistent-declaration-parameter-name,cert-dcl50-cpp,cppcoreguidelines-pro-type-vararg)
extern "C" {

int open(const char* path, int flags, ...) {
    std::va_list rest;
    va_start(rest, flags);
    const mode_t mode = (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(rest, mode_t) : 0;
    va_end(rest);
    if (to_write(flags) && fails("open")) return -1;
    return static_cast<int>(::syscall(SYS_openat, AT_FDCWD, path, flags, mode));
}

int open64(const char* path, int flags, ...) {
    std::va_list rest;
    va_start(rest, flags);
    const mode_t mode = (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(rest, mode_t) : 0;
    va_end(rest);
    return open(path, flags, mode);
}

ssize_t write(int fd, const void* bytes, std::size_t length) {
    if (fails("write")) return -1;
    const ssize_t result = ::syscall(SYS_write, fd, bytes, length);
    note(result, "write %lu\n", inode(fd));
    return result;
}

int fsync(int fd) {
    if (fails("sync")) return -1;
    const long result = ::syscall(SYS_fsync, fd);
    note(result, "sync %lu\n", inode(fd));
    return static_cast<int>(result);
}
int fdatasync(int fd) { return fsync(fd); }

// The descriptor is gone even where close() fails.
int close(int fd) {
    const bool counts = wanted_length != 0 &&
                        (std::strcmp(wanted, "close") == 0 || std::strcmp(wanted, "any") == 0) &&
                        is_written_file(fd);
    const int result = static_cast<int>(::syscall(SYS_close, fd));
    return counts && fails("close") ? -1 : result;
}

int rename(const char* from, const char* to) {
    if (fails("rename")) return -1;
    const long result = ::syscall(SYS_rename, from, to);
    note(result, "rename %lu %s\n", inode(to), to);
    return static_cast<int>(result);
}

int renameat2(int from_in, const char* from, int to_in, const char* to, unsigned flags) {
    if (no_exchange && (flags & RENAME_EXCHANGE) != 0) {
        errno = EINVAL;
        return -1;
    }
    if (fails("rename")) return -1;
    const long result = ::syscall(SYS_renameat2, from_in, from, to_in, to, flags);
    note(result, (flags & RENAME_EXCHANGE) != 0 ? "exchange %lu %s\n" : "rename %lu %s\n", inode(to), to);
    return static_cast<int>(result);
}

int link(const char* from, const char* to) {
    if (fails("link")) return -1;
    const long result = ::syscall(SYS_link, from, to);
    note(result, "link %lu %s\n", inode(to), to);
    return static_cast<int>(result);
}

int unlink(const char* name) {
    if (fails("unlink")) return -1;
    return static_cast<int>(::syscall(SYS_unlink, name));
}

int fchmod(int fd, mode_t mode) {
    return fails("chmod") ? -1 : static_cast<int>(::syscall(SYS_fchmod, fd, mode));
}

void* mmap(void* where, std::size_t length, int protection, int flags, int fd, off_t offset) {
    static auto* const next = real(&mmap, "mmap");
    return fails("map") ? MAP_FAILED : next(where, length, protection, flags, fd, offset);
}

void* malloc(std::size_t size) { return fails("allocate") ? nullptr : __libc_malloc(size); }
void* calloc(std::size_t count, std::size_t size) {
    return fails("allocate") ? nullptr : __libc_calloc(count, size);
}
void* realloc(void* old, std::size_t size) { return fails("allocate") ? nullptr : __libc_realloc(old, size); }

}  // extern "C"
// NOLINTEND(readability-inconsistent-declaration-parameter-name,cert-dcl50-cpp,cppcoreguidelines-pro-type-vararg)
