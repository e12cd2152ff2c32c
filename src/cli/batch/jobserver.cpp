#include "cli/batch/jobserver.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <optional>

#include "popup/diagnostics.h"

namespace popup::cli {
namespace {

constexpr std::string_view kAuth = "--jobserver-auth=";
constexpr std::string_view kOldAuth = "--jobserver-fds=";

// A word of MAKEFLAGS, where make has put a backslash before blanks and backslashes.
std::optional<std::string> next_word(std::string_view& text) {
    const auto is_blank = [](char c) { return c == ' ' || c == '\t' || c == '\n'; };
    while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
    if (text.empty()) return std::nullopt;
    std::string word;
    while (!text.empty() && !is_blank(text.front())) {
        if (text.front() == '\\' && text.size() > 1) text.remove_prefix(1);
        word += text.front();
        text.remove_prefix(1);
    }
    return word;
}

std::optional<int> number(std::string_view text) {
    int value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return value;
}

void read_place(std::string_view text, JobserverPlace& place) {
    place = {};
    place.text = text;
    if (text.starts_with("fifo:")) {
        place.fifo = text.substr(5);
        return;
    }
    const std::size_t comma = text.find(',');
    if (comma == std::string_view::npos) return;
    const auto read_end = number(text.substr(0, comma));
    const auto write_end = number(text.substr(comma + 1));
    if (!read_end || !write_end) return;
    place.read_end = *read_end;
    place.write_end = *write_end;
}

// A FIFO or an end of a pipe, anew, so that its flags are ours alone. -1 when it is none or cannot be opened.
int open_pipe(const std::string& path, int access) {
    struct stat status {};
    // A look before the opening: opening a device can have effects.
    if (::stat(path.c_str(), &status) != 0 || !S_ISFIFO(status.st_mode)) return -1;
    const int fd = ::open(path.c_str(), access | O_NONBLOCK | O_CLOEXEC | O_NOCTTY);
    if (fd < 0) return -1;
    if (::fstat(fd, &status) == 0 && S_ISFIFO(status.st_mode)) return fd;
    ::close(fd);
    return -1;
}

bool can(int fd, int access) {
    const int flags = ::fcntl(fd, F_GETFL);
    return flags >= 0 && ((flags & O_ACCMODE) == access || (flags & O_ACCMODE) == O_RDWR);
}

// Async-signal-safe.
void put_byte(int fd, int token) {
    const auto byte = static_cast<unsigned char>(token);
    for (int tries = 0; tries < 100; ++tries) {
        const ssize_t put = ::write(fd, &byte, 1);
        if (put == 1 || (put < 0 && errno != EINTR && errno != EAGAIN)) return;
        // A pipe takes back what came out of it, unless somebody puts in more than was there.
        pollfd out{fd, POLLOUT, 0};
        if (put < 0 && errno == EAGAIN) ::poll(&out, 1, 10);
    }
}

}  // namespace

JobserverPlace find_jobserver(std::string_view makeflags) {
    JobserverPlace place;
    while (const auto word = next_word(makeflags)) {
        if (*word == "--") break;
        for (const std::string_view name : {kAuth, kOldAuth}) {
            if (word->starts_with(name)) read_place(std::string_view(*word).substr(name.size()), place);
        }
    }
    return place;
}

Jobserver::Jobserver(const char* makeflags) : owner_(::getpid()) {
    for (std::atomic<int>& token : tokens_) token.store(-1);
    if (makeflags != nullptr) place_ = find_jobserver(makeflags);
    if (!named()) return;
    open_server();
    if (!usable()) return;
    cleanup_ = std::make_unique<SignalCleanup>(
        [](void* self) { static_cast<Jobserver*>(self)->give_back_in_handler(); }, this);
}

void Jobserver::open_server() {
    if (!place_.fifo.empty()) {
        read_ = open_pipe(place_.fifo, O_RDONLY);
        if (read_ >= 0) write_ = open_pipe(place_.fifo, O_WRONLY);
    } else if (place_.read_end >= 0 && place_.write_end >= 0) {
        struct stat in {};
        struct stat out {};
        // The two ends of one pipe: a descriptor that make closed may be anything by now.
        const bool one_pipe = ::fstat(place_.read_end, &in) == 0 && ::fstat(place_.write_end, &out) == 0 &&
                              in.st_dev == out.st_dev && in.st_ino == out.st_ino;
        if (one_pipe && can(place_.read_end, O_RDONLY) && can(place_.write_end, O_WRONLY)) {
            read_ = open_pipe(fmt::format("/proc/self/fd/{}", place_.read_end), O_RDONLY);
            if (read_ >= 0) write_ = open_pipe(fmt::format("/proc/self/fd/{}", place_.write_end), O_WRONLY);
        }
    }
    if (read_ >= 0 && write_ >= 0) return;
    if (read_ >= 0) ::close(read_);
    read_ = -1;
    trouble_ = fmt::format(
        "make's jobserver ({}) cannot be used, so one thing is done at a time; in a makefile, begin the "
        "recipe with \"+\" to share it",
        place_.text);
}

Jobserver::~Jobserver() {
    release_all();
    cleanup_.reset();
    if (read_ >= 0) ::close(read_);
    if (write_ >= 0) ::close(write_);
}

bool Jobserver::acquire() {
    if (!usable() || owner_ != ::getpid()) return false;
    // From here to the end no signal can end this thread, and a handler in another waits for it.
    const SignalPause pause;
    busy_.fetch_add(1);
    bool taken = false;
    unsigned char byte = 0;
    if (!ending_.load() && held() < kMost && ::read(read_, &byte, 1) == 1) {
        for (std::atomic<int>& token : tokens_) {
            int free_place = -1;
            taken = token.compare_exchange_strong(free_place, byte);
            if (taken) break;
        }
        // Other threads may have filled the last places meanwhile.
        if (!taken) put_byte(write_, byte);
    }
    busy_.fetch_sub(1);
    return taken;
}

void Jobserver::release() {
    if (owner_ != ::getpid()) return;
    const SignalPause pause;
    busy_.fetch_add(1);
    bool given = ending_.load();  // the handler has them all
    for (std::size_t i = tokens_.size(); i > 0 && !given; --i) {
        const int token = tokens_[i - 1].exchange(-1);
        given = token >= 0;
        if (given) put_byte(write_, token);
    }
    busy_.fetch_sub(1);
    POPUP_INVARIANT(given);
}

void Jobserver::release_all() {
    if (owner_ != ::getpid()) return;
    const SignalPause pause;
    busy_.fetch_add(1);
    for (std::atomic<int>& token : tokens_) {
        if (const int byte = token.exchange(-1); byte >= 0) put_byte(write_, byte);
    }
    busy_.fetch_sub(1);
}

int Jobserver::held() const {
    int count = 0;
    for (const std::atomic<int>& token : tokens_) count += token.load() >= 0 ? 1 : 0;
    return count;
}

void Jobserver::give_back_in_handler() {
    ending_.store(true);
    // Who is at it has signals blocked, so it is another thread and soon done.
    for (int tries = 0; busy_.load() != 0 && tries < 1000; ++tries) ::poll(nullptr, 0, 1);
    for (std::atomic<int>& token : tokens_) {
        if (const int byte = token.exchange(-1); byte >= 0) put_byte(write_, byte);
    }
}

void ask_before_threads(Jobserver& jobserver, CompileOptions& options) {
    if (!jobserver.named()) return;
    options.threads = jobserver.usable() ? Jobserver::kMost : 1;
    options.may_start_thread = [&jobserver] { return jobserver.acquire(); };
    options.thread_ended = [&jobserver] { jobserver.release(); };
}

void ask_before_workers(Jobserver& jobserver, PoolOptions& options) {
    if (!jobserver.named()) return;
    options.workers = jobserver.usable() ? Jobserver::kMost : 1;
    options.may_start = [&jobserver] { return jobserver.acquire(); };
    options.stopped = [&jobserver] { jobserver.release(); };
    options.wake_on = jobserver.descriptor();
}

}  // namespace popup::cli
