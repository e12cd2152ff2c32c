// A client of GNU make's jobserver, which says how many things may be done at a time in all of a build.
//
// The server is a pipe, or since make 4.4 a FIFO, that holds a byte for each job that may be begun. A process
// may always do one thing at a time; for every further one it takes a byte, a token, and puts the very same
// byte back when that is over. Nobody else gives them back: a token that is lost slows the whole build down.
#pragma once

#include <array>
#include <atomic>
#include <memory>
#include <string>
#include <string_view>

#include "base/system/signal_cleanup.h"
#include "cli/batch/worker_pool.h"
#include "popup/compile.h"

namespace popup::cli {

// Where MAKEFLAGS says that the server is.
struct JobserverPlace {
    std::string text;  // as it stands there, such as "3,4" or "fifo:/tmp/GMfifo17"; empty: no server is named
    std::string fifo;  // the path of the FIFO; empty: the two descriptors below
    int read_end = -1;
    int write_end = -1;
};

// The last --jobserver-auth (or --jobserver-fds, as make called it before 4.2) of `makeflags`; definitions of
// variables after "--" are not looked at. What it cannot read has a text, no fifo and no descriptors.
JobserverPlace find_jobserver(std::string_view makeflags);

// One client. All functions may be called from several threads at once. Tokens that are held go back when it
// is destroyed and when a signal ends the process. In a child that was forked while it lived it does nothing:
// the tokens are the parent's. SIGKILL alone loses what is held.
class Jobserver {
 public:
    // `makeflags` as the environment has it; null: there is none. Cost: a few system calls. Call it before
    // files are opened: descriptors that make has closed may get other files.
    explicit Jobserver(const char* makeflags);
    Jobserver(const Jobserver&) = delete;
    Jobserver& operator=(const Jobserver&) = delete;
    ~Jobserver();

    // True when a server is named, whether it can be used or not: then one thing may be done at a time and
    // as many more as there are tokens. False: nobody says how many.
    [[nodiscard]] bool named() const { return !place_.text.empty(); }
    // True when it can be asked for tokens.
    [[nodiscard]] bool usable() const { return read_ >= 0; }
    // Why it cannot be used, and what would mend it, in a sentence; empty when it can or none is named.
    [[nodiscard]] const std::string& trouble() const { return trouble_; }

    // Takes a token. Never waits. False when there is none now, when kMost are held, and when the server
    // cannot be used.
    bool acquire();
    // Gives one back. Precondition: one is held.
    void release();
    // Gives all back.
    void release_all();
    [[nodiscard]] int held() const;

    // Becomes readable (poll(): POLLIN) when a token may be had; another process may be faster. -1 when the
    // server cannot be used. Not to be read.
    [[nodiscard]] int descriptor() const { return read_; }

    static constexpr int kMost = 1024;

 private:
    void open_server();
    void give_back_in_handler();

    JobserverPlace place_;
    std::string trouble_;
    int read_ = -1;   // our own, non-blocking: the flags of make's descriptors are shared with everybody
    int write_ = -1;  // likewise
    pid_t owner_ = 0;
    // A token is its byte, 0 to 255; free places hold -1. A signal handler takes them from here, so they are
    // lock-free, and `busy_` counts who is between the pipe and here.
    std::array<std::atomic<int>, kMost> tokens_;
    std::atomic<int> busy_{0};
    std::atomic<bool> ending_{false};
    std::unique_ptr<SignalCleanup> cleanup_;
};

// Where a jobserver is named, threads are started as it allows, however many processors there are; each gives
// its token back when it ends. The jobserver must outlive the compilation.
void ask_before_threads(Jobserver& jobserver, CompileOptions& options);
// The same of worker processes; the jobserver must outlive the pool.
void ask_before_workers(Jobserver& jobserver, PoolOptions& options);

}  // namespace popup::cli
