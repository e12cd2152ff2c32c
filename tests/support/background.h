// Programs that run beside a test, which looks at what they do and sends them signals.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "support/run_program.h"

namespace popup::test {

// Asks every few milliseconds until the answer is yes. False after `longest`, which only a test that fails
// waits for.
bool eventually(const std::function<bool()>& answer,
                std::chrono::milliseconds longest = std::chrono::seconds(60));

// A program in the background, with an empty standard input. It is killed when this goes and it still runs.
class Background {
 public:
    Background(const std::vector<std::string>& words, const RunOptions& options = {});
    Background(const Background&) = delete;
    Background& operator=(const Background&) = delete;
    ~Background();

    [[nodiscard]] pid_t pid() const { return pid_; }
    void send(int signal) const;
    [[nodiscard]] bool running();
    // Waits for the end: exit status, or 128 + number when a signal ended it.
    int wait();
    // What it has said so far.
    [[nodiscard]] std::string out() const;
    [[nodiscard]] std::string err() const;
    // How many threads it has now; 0 when it has ended.
    [[nodiscard]] int threads() const;

 private:
    void take(int status);

    ScratchDirectory scratch_;
    pid_t pid_ = -1;
    int exit_ = -1;
};

}  // namespace popup::test
