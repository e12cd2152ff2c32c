// Sheets of a live view: laying pieces out may take longer than all the rest, and nobody waits for it to see
// the model.
#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "cli/build.h"

namespace popup::cli {

// What was compiled as far as its patterns, and with what.
struct SheetsJob {
    Options options;
    Build build;
};

// Lays out the last job that it is given, in a thread of its own; jobs before it are forgotten.
class SheetsLater {
 public:
    // Called by that thread when the sheets of a job are there, with what live_sheets() made of them. Where
    // there are none it is what live_sheets() makes of none, and the findings of the run say why. It must not
    // throw. Not called for jobs that were forgotten.
    using Done = std::function<void(const SheetsJob&, std::optional<std::string> sheets)>;
    explicit SheetsLater(Done done);
    SheetsLater(const SheetsLater&) = delete;
    SheetsLater& operator=(const SheetsLater&) = delete;
    // What is going on ends as soon as the search for places can be stopped.
    ~SheetsLater();

    void start(std::unique_ptr<SheetsJob> job);
    void forget();  // whatever was started

 private:
    void run();

    Done done_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::unique_ptr<SheetsJob> next_;
    std::atomic<bool> stop_{false};  // what is going on
    bool over_ = false;
    std::thread thread_;
};

}  // namespace popup::cli
