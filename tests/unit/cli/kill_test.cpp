// Killed at any moment, a run leaves each file old or new and never a part of one, and the next run mends
// what was left: nothing lies beside the files then, and nothing that was called done is missing. By
// faults/fault_shim.cpp the moments are all that can be told apart: before each call that changes a disk.
// What a power cut would take is read off the trace of these calls.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <chrono>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <thread>
#include <tuple>
#include <vector>

#include "batch/results.h"
#include "support/background.h"
#include "support/random.h"
#include "support/run_program.h"
#include "support/sanitized.h"

namespace popup::test {
namespace {

namespace fs = std::filesystem;

using Files = std::map<std::string, std::string>;

constexpr int kKilled = 128 + SIGKILL;
// Runs do not have so many calls that change a disk.
constexpr int kMostCalls = 1000;

bool is_litter(const std::string& name) { return name.starts_with(".popup-"); }

// All that is in a directory, by name; without what a killed run has left of its own.
Files files_in(const fs::path& directory, bool litter = false) {
    Files files;
    for (const fs::directory_entry& entry : fs::directory_iterator(directory)) {
        const std::string name = entry.path().filename().string();
        if (litter || !is_litter(name)) files[name] = read_file(entry.path());
    }
    return files;
}

class Kills : public testing::Test {
 protected:
    void SetUp() override {
        if (kSanitized)
            GTEST_SKIP() << "a library that is loaded first has no place beside AddressSanitizer's";
    }

    fs::path begin(const Files& files) {
        fs::remove_all(scratch_ / "here");
        fs::create_directory(scratch_ / "here");
        for (const auto& [name, bytes] : files) write_file(scratch_ / "here" / name, bytes);
        fs::remove(scratch_ / "shared");
        fs::remove(scratch_ / "trace");
        return scratch_ / "here";
    }

    [[nodiscard]] RunOptions options() const {
        return {.directory = scratch_ / "here", .input = {}, .environment = {}};
    }
    // Before the n-th call that changes a disk, of whatever process, the run is killed.
    [[nodiscard]] RunOptions killed_before(int n) const {
        RunOptions made = options();
        made.environment["LD_PRELOAD"] = POPUP_TOOLS_DIR "/fault_shim.so";
        made.environment["POPUP_FAULT"] = fmt::format("any:{}:kill", n);
        made.environment["POPUP_FAULT_SHARED"] = (scratch_ / "shared").string();
        return made;
    }

    Files made(const Files& before, const std::vector<std::string>& arguments) {
        const fs::path here = begin(before);
        const RunResult result = popupc(arguments, options());
        EXPECT_EQ(result.exit, 0) << result.err;
        return files_in(here);
    }

    // What stands after a kill, and after the next run.
    void expect_old_or_new(const Files& before, const Files& after, const std::string& moment) {
        for (const auto& [name, bytes] : files_in(scratch_ / "here")) {
            const auto old = before.find(name);
            const auto made = after.find(name);
            EXPECT_TRUE((old != before.end() && bytes == old->second) ||
                        (made != after.end() && bytes == made->second))
                << name << " is neither old nor new, " << moment;
        }
        for (const auto& [name, bytes] : before)
            EXPECT_TRUE(fs::exists(scratch_ / "here" / name)) << name << " is gone, " << moment;
    }
    void expect_mended(const Files& after, const std::vector<std::string>& arguments,
                       const std::string& moment) {
        const RunResult next = popupc(arguments, options());
        EXPECT_EQ(next.exit, 0) << next.err << moment;
        EXPECT_EQ(files_in(scratch_ / "here", true), after) << moment;
    }

    // Before each call, to the last; returns how many there were.
    int at_every_call(const Files& before, const std::vector<std::string>& arguments) {
        const Files after = made(before, arguments);
        for (int n = 1; n < kMostCalls; ++n) {
            begin(before);
            const std::string moment = fmt::format("killed before call {}", n);
            const RunResult result = popupc(arguments, killed_before(n));
            if (result.exit != kKilled) {
                EXPECT_EQ(result.exit, 0) << result.err;
                return n - 1;
            }
            expect_old_or_new(before, after, moment);
            expect_mended(after, arguments, moment);
        }
        ADD_FAILURE() << "the calls do not end";
        return kMostCalls;
    }

    // At moments of the clock: `times` of them over a little more than a run takes.
    void at_any_time(const Files& before, const std::vector<std::string>& arguments, int times) {
        const Files after = made(before, arguments);
        std::vector<std::string> words{kPopupc};
        words.insert(words.end(), arguments.begin(), arguments.end());
        begin(before);
        const auto started = std::chrono::steady_clock::now();
        popupc(arguments, options());
        const std::chrono::duration<double> took = std::chrono::steady_clock::now() - started;
        Random random(static_cast<std::uint64_t>(times));
        for (int i = 0; i < times; ++i) {
            begin(before);
            Background run(words, options());
            const std::chrono::duration<double> moment = 1.2 * random.unit() * took;
            std::this_thread::sleep_for(moment);
            run.send(SIGKILL);
            run.wait();
            const std::string said = fmt::format("killed after {} s, number {}", moment.count(), i);
            expect_old_or_new(before, after, said);
            expect_mended(after, arguments, said);
        }
    }

    // The last line of each job that says that it is done; its outputs must be there and whole.
    void expect_done_is_there(const Files& whole, const std::string& moment) {
        std::istringstream lines(read_file(scratch_ / "here/r"));
        for (std::string line; std::getline(lines, line);) {
            const std::optional<JobResult> result = result_of(line);
            if (!result || result->status != JobStatus::done) continue;
            for (const FileDigest& output : result->outputs)
                EXPECT_EQ(read_file(scratch_ / "here" / output.file), whole.at(output.file))
                    << output.file << " is called done, " << moment;
        }
    }

    ScratchDirectory scratch_;
};

std::string sample(const std::string& name) {
    return read_file(fs::path(POPUP_SOURCE_DIR) / "samples" / name);
}

Files card_and_old() {
    return {
        {"bird.xml", sample("bird.xml")}, {"a.svg", "old svg"}, {"a.glb", "old glb"}, {"kept", "not ours"}};
}
const std::vector<std::string> kBuild{"build", "bird.xml", "--quiet", "-o",    "a.svg",
                                      "-o",    "a.glb",    "-o",      "b.dxf", "-MD"};

Files torn_document() {
    return {{"card.xml", read_file(fs::path(POPUP_SOURCE_DIR) / "tests/cases/repair/fold-snapped.xml")}};
}
const std::vector<std::string> kFix{"fix", "--in-place", "card.xml"};

Files two_jobs() {
    return {{"bird.xml", sample("bird.xml")},
            {"two",
             "{\"input\": \"bird.xml\", \"output\": [\"a.svg\", \"a.glb\"]}\n"
             "{\"input\": \"bird.xml\", \"output\": [\"b.svg\", \"b.glb\"]}\n"},
            {"a.svg", "old svg"},
            {"b.glb", "old glb"}};
}
const std::vector<std::string> kBatch{"batch", "two", "--manifest-format", "jsonl", "--results", "r",
                                      "-j",    "1"};

TEST_F(Kills, OfABuildLeaveOldOrNew) { EXPECT_GT(at_every_call(card_and_old(), kBuild), 15); }

TEST_F(Kills, OfARepairLeaveTheDocument) { EXPECT_GT(at_every_call(torn_document(), kFix), 4); }

TEST_F(Kills, OfABatchLoseNothingThatIsDone) {
    const Files before = two_jobs();
    Files whole = made(before, kBatch);
    // Results grow line by line: they are neither old nor new in between, and have other times in them.
    whole.erase("r");
    int n = 1;
    for (; n < kMostCalls; ++n) {
        begin(before);
        const std::string moment = fmt::format("killed before call {}", n);
        const RunResult first = popupc(kBatch, killed_before(n));
        if (first.exit != kKilled) {
            EXPECT_EQ(first.exit, 0) << first.err;
            break;
        }
        Files now = files_in(scratch_ / "here");
        now.erase("r");
        for (const auto& [name, bytes] : now) {
            const auto old = before.find(name);
            EXPECT_TRUE(bytes == whole.at(name) || (old != before.end() && bytes == old->second))
                << name << " is neither old nor new, " << moment;
        }
        expect_done_is_there(whole, moment);
        // A worker may outlive the first process by a moment.
        RunResult next;
        EXPECT_TRUE(eventually([&] {
            next = popupc(kBatch, options());
            return next.exit == 0;
        })) << next.err;
        now = files_in(scratch_ / "here", true);
        EXPECT_EQ(now.erase("r"), 1U);
        EXPECT_EQ(now, whole) << moment;
    }
    EXPECT_GT(n, 20);
    EXPECT_LT(n, kMostCalls);
}

// The second build of a watch, after its input has changed.
TEST_F(Kills, OfAWatchLeaveOldOrNew) {
    const Files before{{"card.xml", sample("bird.xml")}};
    const std::vector<std::string> once{"build", "card.xml", "--quiet", "-o", "a.pdf", "-o", "a.glb"};
    const Files first = made(before, once);
    const Files second = made({{"card.xml", sample("boat.xml")}}, once);
    std::vector<std::string> words{kPopupc};
    words.insert(words.end(), once.begin(), once.end());
    words.emplace_back("--watch");
    for (int n = 1;; ++n) {
        begin(before);
        const std::string moment = fmt::format("killed before call {}", n);
        Background watch(words, killed_before(n));
        ASSERT_TRUE(eventually([&] { return !watch.running() || files_in(scratch_ / "here") == first; }))
            << moment;
        // Its input is exchanged as editors do it.
        write_file(scratch_ / "new", second.at("card.xml"));
        fs::rename(scratch_ / "new", scratch_ / "here/card.xml");
        ASSERT_TRUE(eventually([&] {
            return !watch.running() || files_in(scratch_ / "here", true) == second;
        })) << moment;
        const bool ended = watch.running();
        watch.send(SIGTERM);
        watch.wait();
        for (const auto& [name, bytes] : files_in(scratch_ / "here"))
            EXPECT_TRUE(bytes == first.at(name) || bytes == second.at(name)) << name << ", " << moment;
        expect_mended(second, once, moment);
        if (ended) {
            EXPECT_GT(n, 15);
            break;
        }
    }
}

TEST_F(Kills, AtAnyTimeLeaveOldOrNew) {
    at_any_time(card_and_old(), kBuild, 12);
    at_any_time(torn_document(), kFix, 8);
}

class LongKills : public Kills {};

TEST_F(LongKills, AtManyTimesLeaveOldOrNew) {
    at_any_time(card_and_old(), kBuild, 400);
    at_any_time(torn_document(), kFix, 400);
}

std::string inode_of(const fs::path& path) {
    struct stat status {};
    return ::stat(path.c_str(), &status) == 0 ? std::to_string(status.st_ino) : "none";
}

// What the trace of a run says of a power cut: of files whose bytes had not been synced these may be lost,
// and of directories that had not been synced the last names.
struct PowerCut {
    // Adds what the lines of a trace say. `results` is the file that jobs are called done in; what it names
    // is in `directory`.
    void read(const std::string& trace, const fs::path& directory, const std::string& results) {
        const std::string here = inode_of(directory);
        const std::string told = inode_of(directory / results);
        std::istringstream lines(trace);
        for (std::string call, inode, name; lines >> call >> inode;) {
            if (call == "write") {
                unsynced.insert(inode);
                if (inode == told && !names.empty())
                    faults.push_back("results before the names " + *names.begin());
                if (inode != told && placed.contains(inode))
                    faults.push_back("a write to " + placed.at(inode));
            } else if (call == "sync") {
                ++syncs;
                unsynced.erase(inode);
                if (inode == here) names.clear();
            } else {
                lines >> name;
                if (unsynced.contains(inode)) faults.push_back(name + " before its bytes");
                const std::string last = fs::path(name).filename().string();
                if (is_litter(last)) continue;
                names.insert(last);
                placed[inode] = last;
            }
        }
        for (const std::string& one : names) faults.push_back("at the end the name " + one);
    }
    std::set<std::string> unsynced;             // files, by inode
    std::set<std::string> names;                // that the directory has, and the disk may not
    std::map<std::string, std::string> placed;  // names of files that are in their place, by inode
    std::vector<std::string> faults;
    int syncs = 0;
};

TEST_F(Kills, ByAPowerCutLoseNothingThatIsDone) {
    for (const auto& [before, arguments, results] :
         {std::tuple(card_and_old(), kBuild, std::string()), std::tuple(torn_document(), kFix, std::string()),
          std::tuple(two_jobs(), kBatch, std::string("r"))}) {
        const fs::path here = begin(before);
        RunOptions traced = options();
        traced.environment["LD_PRELOAD"] = POPUP_TOOLS_DIR "/fault_shim.so";
        traced.environment["POPUP_FAULT_TRACE"] = (scratch_ / "trace").string();
        const RunResult run = popupc(arguments, traced);
        EXPECT_EQ(run.exit, 0) << run.err;
        PowerCut cut;
        const std::string trace = read_file(scratch_ / "trace");
        cut.read(trace, here, results);
        EXPECT_EQ(cut.faults, std::vector<std::string>()) << trace;
        EXPECT_GT(cut.syncs, 1) << trace;
    }
}

}  // namespace
}  // namespace popup::test
