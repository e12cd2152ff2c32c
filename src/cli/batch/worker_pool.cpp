#include "cli/batch/worker_pool.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <system_error>
#include <vector>

namespace popup::cli {
namespace {

constexpr std::array kSignals{SIGINT, SIGTERM, SIGHUP};

std::atomic<int> g_signals{0};       // how many have come
std::atomic<int> g_first_signal{0};  // which was the first
static_assert(std::atomic<int>::is_always_lock_free);

extern "C" void popup_note_signal(int signal) {
    int none = 0;
    g_first_signal.compare_exchange_strong(none, signal);
    g_signals.fetch_add(1);
}

// While it lives, signals are counted and may only come during poll(). What is ignored (nohup) stays ignored.
class SignalCounter {
 public:
    SignalCounter() {
        g_signals.store(0);
        g_first_signal.store(0);
        sigset_t set;
        sigemptyset(&set);
        struct sigaction action {};
        action.sa_handler = popup_note_signal;
        sigemptyset(&action.sa_mask);
        for (std::size_t i = 0; i < kSignals.size(); ++i) {
            ::sigaction(kSignals[i], nullptr, &before_[i]);
            if (before_[i].sa_handler == SIG_IGN) continue;
            ::sigaction(kSignals[i], &action, nullptr);
            sigaddset(&set, kSignals[i]);
        }
        ::pthread_sigmask(SIG_BLOCK, &set, &open_);
    }
    SignalCounter(const SignalCounter&) = delete;
    SignalCounter& operator=(const SignalCounter&) = delete;
    ~SignalCounter() {
        for (std::size_t i = 0; i < kSignals.size(); ++i) ::sigaction(kSignals[i], &before_[i], nullptr);
        ::pthread_sigmask(SIG_SETMASK, &open_, nullptr);
    }
    // The signals that were let through before.
    [[nodiscard]] const sigset_t& open() const { return open_; }

 private:
    std::array<struct sigaction, kSignals.size()> before_{};
    sigset_t open_{};
};

bool send_all(int fd, const void* data, std::size_t size) {
    const char* at = static_cast<const char*>(data);
    while (size > 0) {
        const ssize_t put = ::send(fd, at, size, MSG_NOSIGNAL);
        if (put < 0 && errno == EINTR) continue;
        if (put <= 0) return false;
        at += put;
        size -= static_cast<std::size_t>(put);
    }
    return true;
}

bool receive_all(int fd, void* data, std::size_t size) {
    char* at = static_cast<char*>(data);
    while (size > 0) {
        const ssize_t got = ::recv(fd, at, size, 0);
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) return false;
        at += got;
        size -= static_cast<std::size_t>(got);
    }
    return true;
}

struct Worker {
    pid_t process = -1;  // -1: none
    int socket = -1;
    std::size_t begun = 0;           // jobs given to this process
    std::optional<std::size_t> job;  // it is at; a place in `jobs`
    bool counted = false;            // may_start() allowed it
};

// The life of a worker: a job in, a reply out, until nobody asks any more.
[[noreturn]] void serve(int socket, const std::function<std::string(std::size_t)>& work) {
    for (std::uint64_t job = 0; receive_all(socket, &job, sizeof job);) {
        const std::string reply = work(static_cast<std::size_t>(job));
        const std::uint64_t size = reply.size();
        if (!send_all(socket, &size, sizeof size) || !send_all(socket, reply.data(), reply.size())) break;
    }
    std::_Exit(0);
}

class Pool {
 public:
    Pool(std::span<const std::size_t> jobs, const PoolOptions& options,
         const std::function<std::string(std::size_t)>& work, const std::function<bool(const JobEnd&)>& ended,
         const sigset_t& open)
        : jobs_(jobs), options_(options), work_(work), ended_(ended), open_(open) {
        workers_.resize(
            std::min(std::max<std::size_t>(options.workers, 1), std::max<std::size_t>(jobs.size(), 1)));
    }
    Pool(const Pool&) = delete;
    Pool& operator=(const Pool&) = delete;
    ~Pool() {
        for (Worker& worker : workers_) retire(worker);
    }

    int run() {
        while (true) {
            const int signals = g_signals.load();
            if (signals == 0) give_work();
            if (signals > 1) stop_all();
            if (busy() == 0) break;
            wait();
        }
        return g_first_signal.load();
    }

 private:
    [[nodiscard]] std::size_t busy() const {
        return static_cast<std::size_t>(std::count_if(workers_.begin(), workers_.end(),
                                                      [](const Worker& one) { return one.job.has_value(); }));
    }
    [[nodiscard]] bool work_left() const { return !again_.empty() || next_ < jobs_.size(); }
    std::size_t next_place() {
        if (again_.empty()) return next_++;
        const std::size_t place = again_.back();
        again_.pop_back();
        return place;
    }

    void give_work() {
        for (Worker& worker : workers_) {
            if (worker.job) continue;
            if (!work_left()) {
                release(worker);
                continue;
            }
            // One of them always works; each other one needs leave.
            const bool first = std::none_of(workers_.begin(), workers_.end(), [](const Worker& one) {
                return one.job.has_value() && !one.counted;
            });
            if (!worker.counted && !first && options_.may_start) {
                if (!options_.may_start()) break;
                worker.counted = true;
            }
            if (worker.process < 0 && !start(worker)) {
                release(worker);
                // The system gives no more processes: those there are do the work.
                if (busy() == 0) throw std::system_error(errno, std::generic_category(), "fork");
                break;
            }
            const std::size_t place = next_place();
            const std::uint64_t job = jobs_[place];
            worker.job = place;
            ++worker.begun;
            // A worker that is dead already is found out by wait().
            send_all(worker.socket, &job, sizeof job);
        }
    }

    void release(Worker& worker) {
        if (!worker.counted) return;
        worker.counted = false;
        if (options_.stopped) options_.stopped();
    }

    bool start(Worker& worker) {
        std::array<int, 2> ends{};
        if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) return false;
        const pid_t parent = ::getpid();
        const pid_t child = ::fork();
        if (child < 0) {
            ::close(ends[0]);
            ::close(ends[1]);
            return false;
        }
        if (child == 0) {
            ::close(ends[0]);
            for (const Worker& other : workers_) {
                if (other.socket >= 0) ::close(other.socket);
            }
            become_worker(parent);
            if (options_.begun) options_.begun();
            serve(ends[1], work_);
        }
        ::close(ends[1]);
        worker = {child, ends[0], 0, worker.job, worker.counted};
        return true;
    }

    static void become_worker(pid_t parent) {
        // A terminal sends its interrupt to all of them; the first process decides what it means. SIGTERM is
        // how it ends a worker, and how a worker learns that it is gone: then files half written are taken
        // away.
        std::signal(SIGINT, SIG_IGN);
        std::signal(SIGHUP, SIG_IGN);
        std::signal(SIGTERM, SIG_DFL);
        sigset_t all;
        sigfillset(&all);
        ::pthread_sigmask(SIG_UNBLOCK, &all, nullptr);
        ::prctl(PR_SET_PDEATHSIG, SIGTERM);
        if (::getppid() != parent) std::_Exit(0);
        const int nothing = ::open("/dev/null", O_RDONLY);
        if (nothing >= 0 && nothing != STDIN_FILENO) {
            ::dup2(nothing, STDIN_FILENO);
            ::close(nothing);
        }
    }

    void stop_all() {
        for (const Worker& worker : workers_) {
            if (worker.process >= 0) ::kill(worker.process, SIGTERM);
        }
    }

    // Waits until a worker has something to say, then hears all that have.
    void wait() {
        std::vector<pollfd> wanted;
        for (const Worker& worker : workers_) {
            wanted.push_back({worker.job ? worker.socket : -1, POLLIN, 0});
        }
        const bool more = work_left() && busy() < workers_.size() && g_signals.load() == 0;
        wanted.push_back({more ? options_.wake_on : -1, POLLIN, 0});
        // Others may take what wake_on promised, so that it stays readable and gives nothing.
        timespec pause{};
        pause.tv_nsec = 20'000'000;
        if (more && options_.wake_on >= 0 && starved_) {
            wanted.back().fd = -1;
            ::ppoll(wanted.data(), wanted.size(), &pause, &open_);
        } else {
            ::ppoll(wanted.data(), wanted.size(), nullptr, &open_);
        }
        starved_ = (wanted.back().revents & POLLIN) != 0;
        for (std::size_t i = 0; i < workers_.size(); ++i) {
            if (wanted[i].revents != 0 && workers_[i].job) hear(workers_[i]);
        }
    }

    void hear(Worker& worker) {
        std::uint64_t size = 0;
        std::string reply;
        bool good = receive_all(worker.socket, &size, sizeof size);
        if (good) {
            reply.resize(size);
            good = receive_all(worker.socket, reply.data(), reply.size());
        }
        const std::size_t place = *worker.job;
        worker.job.reset();
        if (good) {
            tell({jobs_[place], std::move(reply), 0});
            if (worker.begun >= options_.jobs_per_worker) retire(worker);
            return;
        }
        const int status = retire(worker);
        if (g_signals.load() > 1) return;  // we stopped it
        const bool twice = std::find(crashed_.begin(), crashed_.end(), place) != crashed_.end();
        if (!twice) {
            crashed_.push_back(place);
            again_.push_back(place);
            return;
        }
        tell({jobs_[place], std::nullopt, WIFSIGNALED(status) ? WTERMSIG(status) : 0});
    }

    void tell(const JobEnd& end) {
        if (ended_(end)) return;
        again_.clear();
        next_ = jobs_.size();
    }

    // Ends the process and returns its status.
    static int retire(Worker& worker) {
        int status = 0;
        if (worker.process < 0) return status;
        ::close(worker.socket);
        while (::waitpid(worker.process, &status, 0) < 0 && errno == EINTR) {
        }
        worker.process = -1;
        worker.socket = -1;
        worker.begun = 0;
        return status;
    }

    std::span<const std::size_t> jobs_;
    const PoolOptions& options_;
    const std::function<std::string(std::size_t)>& work_;
    const std::function<bool(const JobEnd&)>& ended_;
    const sigset_t& open_;  // the signals that waiting lets through are those not in it
    std::vector<Worker> workers_;
    std::size_t next_ = 0;
    std::vector<std::size_t> again_;    // jobs whose worker died, to be tried once more
    std::vector<std::size_t> crashed_;  // jobs whose worker died
    bool starved_ = false;
};

}  // namespace

int run_pool(std::span<const std::size_t> jobs, const PoolOptions& options,
             const std::function<std::string(std::size_t)>& work,
             const std::function<bool(const JobEnd&)>& ended) {
    const SignalCounter signals;
    return Pool(jobs, options, work, ended, signals.open()).run();
}

}  // namespace popup::cli
