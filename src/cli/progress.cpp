#include "cli/progress.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <string>

#include "cli/progress_line.h"

namespace popup::cli {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kUsualColumns = 80;

// Of the terminal now: its window may have been made larger or smaller.
std::size_t columns_of_terminal() {
    winsize size{};
    const bool known = ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
    return known ? size.ws_col : kUsualColumns;
}

void show(const std::string& text) {
    std::fwrite(text.data(), 1, text.size(), stderr);
    std::fflush(stderr);
}

class Meter {
 public:
    explicit Meter(bool terminal) : terminal_(terminal) {}

    void operator()(std::size_t done, std::size_t total) {
        const auto now = Clock::now();
        const bool over = done == total;
        const auto pause = std::chrono::milliseconds(terminal_ ? 100 : 1000);
        if (!over && now - shown_ < pause) return;
        shown_ = now;
        const ProgressState state{done, total, std::chrono::duration<double>(now - begun_).count()};
        if (!terminal_) {
            show("popupc: " + progress_text(state) + "\n");
        } else if (!over) {
            drawn_ = true;
            show("\r" + progress_bar(state, columns_of_terminal()) + "\x1b[K");
        } else if (drawn_) {
            show("\r\x1b[K");
        }
    }

 private:
    bool terminal_;
    bool drawn_ = false;
    Clock::time_point begun_ = Clock::now();
    Clock::time_point shown_ = begun_;
};

}  // namespace

std::function<void(std::size_t, std::size_t)> progress_meter(const MessageOptions& options,
                                                             std::size_t inputs) {
    const bool terminal = ::isatty(STDERR_FILENO) != 0;
    if (options.progress == When::never) return {};
    if (options.progress == When::automatic && (inputs < 2 || !terminal || options.quiet)) return {};
    return Meter(terminal);
}

}  // namespace popup::cli
