#include "lsp/session.h"

#include <poll.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <thread>

#include "lsp/frames.h"
#include "lsp/server.h"

namespace popup::lsp {
namespace {

class Session : public std::enable_shared_from_this<Session> {
 public:
    Session(int in, int out, const ServerOptions& options) : in_(in), out_(out), server_(options) {}

    int run() {
        for (const Depth depth : {Depth::check, Depth::whole})
            std::thread([self = shared_from_this(), depth] { self->work(depth); }).detach();
        read();
        const std::lock_guard lock(mutex_);
        over_ = true;
        changed_.notify_all();
        return server_.exit_code();
    }

 private:
    // The calling thread: bytes come, messages are handled, answers go. All that has come is taken in before
    // the next message is handled, so that what is cancelled in it need not be done.
    void read() {
        std::array<char, 1 << 16> bytes{};
        bool open = true;
        for (;;) {
            bool more = false;
            {
                const std::lock_guard lock(mutex_);
                more = server_.step();
                if (!send() || server_.ended()) return;
            }
            changed_.notify_all();
            if (!more && !open) return;
            pollfd ready{in_, POLLIN, 0};
            // With messages waiting it only looks whether there is more.
            const int count = open ? ::poll(&ready, 1, more ? 0 : -1) : 0;
            if (count <= 0) continue;
            const ssize_t size = ::read(in_, bytes.data(), bytes.size());
            if (size < 0 && errno == EINTR) continue;
            if (size <= 0) {
                open = false;
                continue;
            }
            frames_.push({bytes.data(), static_cast<std::size_t>(size)});
            const std::lock_guard lock(mutex_);
            while (std::optional<Frame> frame = frames_.next()) {
                if (frame->fault.empty()) {
                    server_.receive(frame->body, Clock::now());
                } else {
                    server_.receive_fault(frame->fault);
                }
            }
        }
    }

    void work(Depth depth) {
        std::unique_lock lock(mutex_);
        while (!over_) {
            const std::optional<Work> next = server_.next_work(depth, Clock::now());
            send();
            if (!next) {
                const auto due = depth == Depth::whole ? server_.next_due() : std::nullopt;
                // What is due at once is the other thread's, which will tell when it is done.
                if (due && *due > Clock::now()) {
                    changed_.wait_until(lock, *due);
                } else {
                    changed_.wait(lock);
                }
                continue;
            }
            lock.unlock();
            const Clock::time_point begin = Clock::now();
            Analysis found = lsp::run(*next);
            const Clock::duration took = Clock::now() - begin;
            lock.lock();
            if (over_) return;
            server_.finish(*next, std::move(found), took);
            send();
            changed_.notify_all();
        }
    }

    // False when nobody reads any more.
    bool send() {
        for (const std::string& body : server_.take_sent()) {
            const std::string message = framed(body);
            std::string_view rest(message);
            while (!rest.empty() && !gone_) {
                const ssize_t size = ::write(out_, rest.data(), rest.size());
                if (size < 0 && errno == EINTR) continue;
                if (size <= 0) {
                    gone_ = true;
                } else {
                    rest.remove_prefix(static_cast<std::size_t>(size));
                }
            }
        }
        return !gone_;
    }

    int in_, out_;
    FrameReader frames_;
    std::mutex mutex_;  // of all that follows
    std::condition_variable changed_;
    Server server_;
    bool over_ = false;
    bool gone_ = false;
};

}  // namespace

int serve(int in, int out, const ServerOptions& options) {
    return std::make_shared<Session>(in, out, options)->run();
}

}  // namespace popup::lsp
