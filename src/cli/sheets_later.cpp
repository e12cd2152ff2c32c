#include "cli/sheets_later.h"

#include <sys/resource.h>
#include <unistd.h>

#include <utility>

#include "output/viewer/live.h"

namespace popup::cli {
namespace {

constexpr int kPatience = 10;  // as nice(1) has it

}  // namespace

SheetsLater::SheetsLater(Done done) : done_(std::move(done)), thread_([this] { run(); }) {}

SheetsLater::~SheetsLater() {
    {
        const std::lock_guard lock(mutex_);
        over_ = true;
        stop_ = true;
    }
    changed_.notify_one();
    thread_.join();
}

void SheetsLater::start(std::unique_ptr<SheetsJob> job) {
    {
        const std::lock_guard lock(mutex_);
        next_ = std::move(job);
        stop_ = true;
    }
    changed_.notify_one();
}

void SheetsLater::forget() {
    const std::lock_guard lock(mutex_);
    next_.reset();
    stop_ = true;
}

void SheetsLater::run() {
    // The browser draws the model meanwhile. On Linux this holds for a thread, and for those that it starts.
    ::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), kPatience);
    for (;;) {
        std::unique_ptr<SheetsJob> job;
        {
            std::unique_lock lock(mutex_);
            changed_.wait(lock, [this] { return over_ || next_ != nullptr; });
            if (over_) return;
            job = std::move(next_);
            stop_ = false;
        }
        CompileOptions options = job->options.compile;
        options.layout.nesting.stop = &stop_;
        Compilation& run = job->build.run.compilation;
        lay_out_run(run, options);
        std::optional<std::string> sheets;
        if (!stop_) {
            sheets = live_sheets(run.layout ? &*run.layout : nullptr, options.output, run.run_diagnostics);
            // Those of the card before must not stay beside the new model.
            if (!sheets) sheets = live_sheets(nullptr, options.output, run.run_diagnostics);
        }
        // Whoever starts or forgets a job from now on waits, and what it tells comes after this.
        const std::lock_guard lock(mutex_);
        if (!stop_) done_(*job, std::move(sheets));
    }
}

}  // namespace popup::cli
