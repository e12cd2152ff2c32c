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
#include "popup/output.h"
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

    // Runs the words and kills them so many seconds later; says when.
    std::string kill_at(double seconds, const std::vector<std::string>& words, int number) const {
        Background run(words, options());
        std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
        run.send(SIGKILL);
        run.wait();
        return fmt::format("killed after {} s, number {}", seconds, number);
    }

    // At moments of the clock: `times` of them over a little more than a run takes.
    void at_any_time(const Files& before, const std::vector<std::string>& arguments, int times) {
        const Files after = made(before, arguments);
        std::vector<std::string> words{kPopupc};
        words.insert(words.end(), arguments.begin(), arguments.end());
        const double took = seconds_of(before, arguments);
        Random random(static_cast<std::uint64_t>(times));
        for (int i = 0; i < times; ++i) {
            begin(before);
            const std::string said = kill_at(1.2 * random.unit() * took, words, i);
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

    // What stands after a batch was killed, but for its results, which are neither old nor new in between;
    // and the next batch succeeds.
    void expect_batch_goes_on(const Files& before, const Files& whole,
                              const std::vector<std::string>& arguments, const std::string& moment) {
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
            next = popupc(arguments, options());
            return next.exit == 0;
        })) << next.err
            << moment;
    }

    // At moments of the clock while jobs are done side by side; the next batch goes on from there.
    void batch_at_any_time(const Files& before, const std::vector<std::string>& arguments, int times) {
        Files whole = made(before, arguments);
        whole.erase("r");
        std::vector<std::string> words{kPopupc};
        words.insert(words.end(), arguments.begin(), arguments.end());
        const double took = seconds_of(before, arguments);
        Random random(static_cast<std::uint64_t>(times));
        for (int i = 0; i < times && !HasFailure(); ++i) {
            begin(before);
            const std::string said = kill_at(1.2 * random.unit() * took, words, i);
            expect_batch_goes_on(before, whole, arguments, said);
            Files now;
            EXPECT_TRUE(eventually([&] {
                now = files_in(scratch_ / "here", true);
                return now.erase("r") == 1 && now == whole;
            })) << said;
            EXPECT_EQ(now, whole) << said;
        }
    }

    // At moments of the clock while a watch builds for the first time, or again after its input has changed.
    void watch_at_any_time(const Files& before, const std::vector<std::string>& once, int times) {
        Files changed = before;
        changed[once.at(1)] = read_file(fs::path(POPUP_SOURCE_DIR) / "samples/boat.xml");
        const Files first = made(before, once);
        const Files second = made(changed, once);
        ASSERT_NE(first, second);
        std::vector<std::string> words{kPopupc};
        words.insert(words.end(), once.begin(), once.end());
        words.emplace_back("--watch");
        const double took = seconds_of(before, once);
        Random random(static_cast<std::uint64_t>(times));
        for (int i = 0; i < times && !HasFailure(); ++i) {
            begin(before);
            const bool again = i % 2 != 0;
            // What a watch waits after a change, so that it sees all of it, comes on top.
            const std::chrono::duration<double> moment(random.unit() * (1.2 * took + (again ? 0.2 : 0.0)));
            const std::string said = fmt::format("killed {} s into its {} build, number {}", moment.count(),
                                                 again ? "second" : "first", i);
            Background watch(words, options());
            if (again) {
                ASSERT_TRUE(eventually([&] { return files_in(scratch_ / "here", true) == first; })) << said;
                write_file(scratch_ / "new", changed.at(once.at(1)));
                fs::rename(scratch_ / "new", scratch_ / "here" / once.at(1));
            }
            std::this_thread::sleep_for(moment);
            watch.send(SIGKILL);
            watch.wait();
            if (again) {
                expect_old_or_new(first, second, said);
            } else {
                expect_old_or_new(before, first, said);
            }
            expect_mended(again ? second : first, once, said);
        }
    }

    // How long a run takes.
    double seconds_of(const Files& before, const std::vector<std::string>& arguments) {
        begin(before);
        const auto started = std::chrono::steady_clock::now();
        popupc(arguments, options());
        const std::chrono::duration<double> took = std::chrono::steady_clock::now() - started;
        return took.count();
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
        expect_batch_goes_on(before, whole, kBatch, moment);
        Files now = files_in(scratch_ / "here", true);
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

// Outputs of every format, of the inputs' stem; every second one is there before, old.
std::vector<std::string> all_outputs(const std::string& stem) {
    std::vector<std::string> names;
    for (const Format& format : format_table()) names.push_back(stem + std::string(format.suffix));
    return names;
}
void add_old(Files& files, const std::vector<std::string>& names) {
    for (std::size_t i = 0; i < names.size(); i += 2) files[names[i]] = "old " + names[i];
}
// So that pictures take no longer than all else.
const std::vector<std::string> kSmallPictures{"--size", "64x48", "--duration", "0.5",      "--fps",
                                              "4",      "--dpi", "20",         "--angles", "0,90"};

Files card_and_all_old() {
    Files files{{"bird.xml", sample("bird.xml")}, {"kept", "not ours"}};
    add_old(files, all_outputs("all"));
    return files;
}
std::vector<std::string> build_all() {
    std::vector<std::string> words{"build", "bird.xml", "--quiet", "-MD", "--diagnostics", "told.json"};
    for (const std::string& name : all_outputs("all")) words.insert(words.end(), {"-o", name});
    words.insert(words.end(), kSmallPictures.begin(), kSmallPictures.end());
    return words;
}

// A job of all outputs, and three of a few.
Files all_jobs() {
    Files files{{"bird.xml", sample("bird.xml")}, {"kept", "not ours"}};
    std::string manifest;
    for (const std::string stem : {"first", "all", "second", "third"}) {
        std::vector<std::string> names = all_outputs(stem);
        if (stem != "all")
            std::erase_if(names, [&](const std::string& name) { return name.size() > stem.size() + 4; });
        add_old(files, names);
        std::string listed;
        for (const std::string& name : names) listed += (listed.empty() ? "\"" : ", \"") + name + "\"";
        manifest += fmt::format("{{\"input\": \"bird.xml\", \"output\": [{}]}}\n", listed);
    }
    files["jobs"] = manifest;
    return files;
}
std::vector<std::string> batch_all() {
    std::vector<std::string> words{"batch", "jobs", "--manifest-format", "jsonl", "--results", "r",
                                   "-j",    "2",    "--quiet",           "--"};
    words.insert(words.end(), kSmallPictures.begin(), kSmallPictures.end());
    return words;
}

TEST_F(Kills, AtAnyTimeLeaveOldOrNew) {
    at_any_time(card_and_old(), kBuild, 12);
    at_any_time(torn_document(), kFix, 8);
}
TEST_F(Kills, OfABatchAtAnyTimeLoseNothingThatIsDone) { batch_at_any_time(all_jobs(), batch_all(), 5); }
TEST_F(Kills, OfAWatchAtAnyTimeLeaveOldOrNew) { watch_at_any_time(card_and_all_old(), build_all(), 5); }

class LongKills : public Kills {};

TEST_F(LongKills, AtManyTimesLeaveOldOrNew) {
    at_any_time(card_and_old(), kBuild, 400);
    at_any_time(torn_document(), kFix, 400);
}
TEST_F(LongKills, OfAllOutputsAtManyTimesLeaveOldOrNew) { at_any_time(card_and_all_old(), build_all(), 250); }
TEST_F(LongKills, OfABatchAtManyTimesLoseNothingThatIsDone) {
    batch_at_any_time(all_jobs(), batch_all(), 250);
}
TEST_F(LongKills, OfAWatchAtManyTimesLeaveOldOrNew) {
    watch_at_any_time(card_and_all_old(), build_all(), 250);
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
