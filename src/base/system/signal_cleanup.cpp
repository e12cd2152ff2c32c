#include "base/system/signal_cleanup.h"

#include <poll.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <mutex>

#include "popup/diagnostics.h"

namespace popup {
namespace {

constexpr std::array kAsked{SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGXCPU, SIGALRM, SIGUSR1, SIGUSR2};
constexpr std::array kFaults{SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL};

// What a handler reads: lock-free atomics only.
struct Slot {
    std::atomic<SignalCleanup::Act> act{nullptr};
    std::atomic<void*> context{nullptr};
    std::atomic<pid_t> owner{0};
    std::atomic<bool> taken{false};
};
std::array<Slot, 8> g_slots;
std::atomic<int> g_acting{0};  // handlers that are at work
static_assert(std::atomic<SignalCleanup::Act>::is_always_lock_free &&
              std::atomic<pid_t>::is_always_lock_free);

// Who installs and who removes the handlers.
std::mutex g_installing;
int g_alive = 0;

void act_all() {
    const int saved = errno;
    g_acting.fetch_add(1);
    const pid_t self = ::getpid();
    for (Slot& slot : g_slots) {
        const SignalCleanup::Act act = slot.act.load();
        if (act != nullptr && slot.owner.load() == self) act(slot.context.load());
    }
    g_acting.fetch_sub(1);
    errno = saved;
}

extern "C" void popup_clean_up(int signal) {
    act_all();
    // Installed with SA_RESETHAND: now the signal has its ordinary effect.
    ::raise(signal);
}

template <typename Do>
void for_each_signal(Do what) {
    for (const int signal : kAsked) what(signal);
    for (const int signal : kFaults) what(signal);
}

void install(int signal) {
    struct sigaction before {};
    ::sigaction(signal, nullptr, &before);
    if ((before.sa_flags & SA_SIGINFO) != 0 || before.sa_handler != SIG_DFL) return;
    struct sigaction action {};
    action.sa_handler = popup_clean_up;
    action.sa_flags = static_cast<int>(SA_RESETHAND);
    sigemptyset(&action.sa_mask);
    ::sigaction(signal, &action, nullptr);
}

void uninstall(int signal) {
    struct sigaction now {};
    ::sigaction(signal, nullptr, &now);
    // Somebody may have put another handler in its place meanwhile.
    if ((now.sa_flags & SA_SIGINFO) == 0 && now.sa_handler == popup_clean_up) ::signal(signal, SIG_DFL);
}

}  // namespace

SignalCleanup::SignalCleanup(Act act, void* context) {
    while (slot_ < g_slots.size() && g_slots[slot_].taken.exchange(true)) ++slot_;
    POPUP_INVARIANT(slot_ < g_slots.size());
    Slot& slot = g_slots[slot_];
    slot.context.store(context);
    slot.owner.store(::getpid());
    slot.act.store(act);
    const std::lock_guard lock(g_installing);
    // Also when it is not the first: a handler that stood in the way may be gone.
    for_each_signal(install);
    ++g_alive;
}

SignalCleanup::~SignalCleanup() {
    {
        const std::lock_guard lock(g_installing);
        if (--g_alive == 0) for_each_signal(uninstall);
    }
    Slot& slot = g_slots[slot_];
    slot.act.store(nullptr);
    // A handler in another thread may still use what this object's owner is about to take away; it will end
    // the process.
    while (g_acting.load() != 0 && slot.owner.load() == ::getpid()) ::poll(nullptr, 0, 1);
    slot.taken.store(false);
}

void end_by_signal(int signal) {
    act_all();
    ::signal(signal, SIG_DFL);
    sigset_t set;
    sigemptyset(&set);
    sigaddset(&set, signal);
    ::raise(signal);
    ::pthread_sigmask(SIG_UNBLOCK, &set, nullptr);
}

void end_with(int status) {
    act_all();
    ::_exit(status);
}

SignalPause::SignalPause() {
    sigset_t set;
    sigemptyset(&set);
    for (const int signal : kAsked) sigaddset(&set, signal);
    ::pthread_sigmask(SIG_BLOCK, &set, &before_);
}

SignalPause::~SignalPause() { ::pthread_sigmask(SIG_SETMASK, &before_, nullptr); }

}  // namespace popup
