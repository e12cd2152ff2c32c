// What has to be done before a signal ends the process: temporary files to remove, tokens to give back.
#pragma once

#include <csignal>
#include <cstddef>

namespace popup {

// As long as one lives, a signal that would end the process (interrupt, termination, hang-up, quit and the
// like, aborts and faults too) first calls `act(context)`, and then has its usual effect. Signals that the
// program handles otherwise, or ignores, are left alone; see end_by_signal() for those it handles.
//
// `act` must be async-signal-safe, and may be called from any thread, by several of them at once. It is not
// called in a child that was forked while this lived: what is to be cleaned up belongs to the parent. After
// the destructor it is not running any more.
//
// At most eight live at a time; more are a broken invariant.
class SignalCleanup {
 public:
    using Act = void (*)(void* context);
    SignalCleanup(Act act, void* context);
    SignalCleanup(const SignalCleanup&) = delete;
    SignalCleanup& operator=(const SignalCleanup&) = delete;
    ~SignalCleanup();

 private:
    std::size_t slot_ = 0;
};

// For handlers of the program's own: does all cleanups that are asked for, then lets the signal end the
// process. Async-signal-safe.
void end_by_signal(int signal);

// The same, but the process ends with this exit status. What is open is not flushed.
[[noreturn]] void end_with(int status);

// Holds signals back in this thread that would end the process, but for faults.
class SignalPause {
 public:
    SignalPause();
    SignalPause(const SignalPause&) = delete;
    SignalPause& operator=(const SignalPause&) = delete;
    ~SignalPause();

 private:
    sigset_t before_{};
};

}  // namespace popup
