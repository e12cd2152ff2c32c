// Fails one call of a program that is under test: loaded before the C library by LD_PRELOAD.
//
//   POPUP_FAULT=CALL:N:ERRNO[+]   the N-th call of this kind (from 1) fails with this number of errno; with a
//   plus, all
//                                 from there on do, as on a disk that stays full. CALL is open (of a file to
//                                 write), write, sync, close (of a file that was written), rename, link,
//                                 chmod, map or allocate.
//   POPUP_FAULT_SEEN=FILE         the file is made once a call has failed, so that a test knows when N is
//   beyond the end POPUP_NO_EXCHANGE=1           the file system cannot exchange two names, as many network
//   file systems cannot
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
#include <cstdarg>
#include <cstddef>
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
const char* seen = nullptr;
std::atomic<unsigned long> calls{0};

__attribute__((constructor)) void setup() {
    const char* const fault = std::getenv("POPUP_FAULT");
    no_exchange = std::getenv("POPUP_NO_EXCHANGE") != nullptr;
    seen = std::getenv("POPUP_FAULT_SEEN");
    if (fault == nullptr) return;
    const char* const colon = std::strchr(fault, ':');
    if (colon == nullptr || static_cast<std::size_t>(colon - fault) >= sizeof wanted) std::_Exit(126);
    char* end = nullptr;
    at = std::strtoul(colon + 1, &end, 10);
    error_number = static_cast<int>(std::strtol(end + 1, &end, 10));
    onwards = *end == '+';
    std::memcpy(wanted, fault, static_cast<std::size_t>(colon - fault));
    wanted_length = static_cast<std::size_t>(colon - fault);
}

// Whether this call of this kind is to fail; errno is set then.
bool fails(const char* kind) {
    if (wanted_length == 0 || std::strcmp(kind, wanted) != 0) return false;
    const unsigned long number = ++calls;
    if (onwards ? number < at : number != at) return false;
    if (seen != nullptr)
        ::syscall(SYS_close, ::syscall(SYS_openat, AT_FDCWD, seen, O_WRONLY | O_CREAT, 0666));
    errno = error_number;
    return true;
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
    return fails("write") ? -1 : ::syscall(SYS_write, fd, bytes, length);
}

int fsync(int fd) { return fails("sync") ? -1 : static_cast<int>(::syscall(SYS_fsync, fd)); }
int fdatasync(int fd) { return fails("sync") ? -1 : static_cast<int>(::syscall(SYS_fdatasync, fd)); }

// The descriptor is gone even where close() fails.
int close(int fd) {
    const bool counts = wanted_length != 0 && std::strcmp(wanted, "close") == 0 && is_written_file(fd);
    const int result = static_cast<int>(::syscall(SYS_close, fd));
    return counts && fails("close") ? -1 : result;
}

int rename(const char* from, const char* to) {
    return fails("rename") ? -1 : static_cast<int>(::syscall(SYS_rename, from, to));
}

int renameat2(int from_in, const char* from, int to_in, const char* to, unsigned flags) {
    if (no_exchange && (flags & RENAME_EXCHANGE) != 0) {
        errno = EINVAL;
        return -1;
    }
    return fails("rename") ? -1 : static_cast<int>(::syscall(SYS_renameat2, from_in, from, to_in, to, flags));
}

int link(const char* from, const char* to) {
    return fails("link") ? -1 : static_cast<int>(::syscall(SYS_link, from, to));
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
