// Whatever call fails, of those that make files: afterwards the files are all old or all new, nothing lies
// beside them, and the exit status says which. The disk of these tests is faults/fault_shim.cpp.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cerrno>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "support/run_program.h"
#include "support/sanitized.h"

namespace popup::test {
namespace {

namespace fs = std::filesystem;

using Files = std::map<std::string, std::string>;

// All that is in a directory, by name.
Files files_of(const fs::path& directory) {
    Files files;
    for (const fs::directory_entry& entry : fs::directory_iterator(directory))
        files[entry.path().filename().string()] = entry.is_regular_file() ? read_file(entry.path()) : "";
    return files;
}

// What can go wrong, at the n-th of its kind.
struct Fault {
    std::string_view call;
    int error = EIO;
    bool onwards = false;
    bool no_exchange = false;  // on a file system that cannot exchange names
};

std::ostream& operator<<(std::ostream& out, const Fault& fault) {
    return out << fault.call << (fault.onwards ? " and all after it" : "")
               << (fault.no_exchange ? ", names cannot be exchanged" : "");
}

const std::vector<Fault> kFaults{{"open"},
                                 {"open", EMFILE, true},
                                 {"write"},
                                 {"write", ENOSPC, true},
                                 {"sync"},
                                 {"close"},
                                 {"chmod"},
                                 {"rename"},
                                 {"open", EACCES, false, true},
                                 {"write", ENOSPC, true, true},
                                 {"rename", EIO, false, true},
                                 {"link", EPERM, true, true},
                                 {"map", ENOMEM, true}};

class Faults : public testing::Test {
 protected:
    void SetUp() override {
        if (kSanitized)
            GTEST_SKIP() << "a library that is loaded first has no place beside AddressSanitizer's";
        for (const std::string name : {"castle.xml", "bird.xml"})
            fs::copy_file(fs::path(POPUP_SOURCE_DIR) / "samples" / name, scratch_ / name);
    }

    // A directory as it is before the run.
    fs::path begin(const Files& files) {
        fs::remove_all(scratch_ / "here");
        fs::create_directory(scratch_ / "here");
        for (const auto& [name, bytes] : files) write_file(scratch_ / "here" / name, bytes);
        return scratch_ / "here";
    }

    // Runs with the n-th call failing; false in `reached` where there were fewer.
    RunResult run_with(const Fault& fault, int n, std::vector<std::string> arguments,
                       const fs::path& directory, bool& reached) {
        const fs::path seen = scratch_ / "seen";
        fs::remove(seen);
        RunOptions options{.directory = directory, .input = {}, .environment = {}};
        options.environment["LD_PRELOAD"] = POPUP_TOOLS_DIR "/fault_shim.so";
        options.environment["POPUP_FAULT"] =
            fmt::format("{}:{}:{}{}", fault.call, n, fault.error, fault.onwards ? "+" : "");
        options.environment["POPUP_FAULT_SEEN"] = seen.string();
        if (fault.no_exchange) options.environment["POPUP_NO_EXCHANGE"] = "1";
        const RunResult result = popupc(std::move(arguments), options);
        reached = fs::exists(seen);
        return result;
    }

    // What a run makes of a directory where nothing fails.
    Files made(const Files& before, const std::vector<std::string>& arguments) {
        const fs::path here = begin(before);
        const RunResult result = popupc(arguments, {.directory = here, .input = {}, .environment = {}});
        EXPECT_EQ(result.exit, 0) << result.err;
        return files_of(here);
    }

    // Every n to the last: all old or all new. Returns how often a call failed.
    int all_or_nothing(const Files& before, const std::vector<std::string>& arguments) {
        const Files after = made(before, arguments);
        EXPECT_NE(before, after);
        int failed = 0;
        for (const Fault& fault : kFaults) {
            bool reached = true;
            for (int n = 1; reached && n < 500; ++n) {
                const fs::path here = begin(before);
                const RunResult result = run_with(fault, n, arguments, here, reached);
                const Files now = files_of(here);
                failed += reached && result.exit != 0 ? 1 : 0;
                EXPECT_EQ(now == after, result.exit == 0) << fault << ", number " << n << ": " << result.err;
                EXPECT_TRUE(now == after || now == before)
                    << fault << ", number " << n << ": exit " << result.exit << ", " << result.err;
                if (result.exit != 0) {
                    EXPECT_EQ(result.exit, 2) << fault << ", number " << n << ": " << result.err;
                    EXPECT_NE(result.err.find("error: "), std::string::npos) << fault << ", number " << n;
                }
            }
            EXPECT_FALSE(reached) << fault << " does not end";
        }
        return failed;
    }

    // Allocations are too many to fail each: those at the beginning, and then ever fewer.
    void out_of_memory(const Files& before, const std::vector<std::string>& arguments) {
        const Files after = made(before, arguments);
        bool reached = true;
        for (int n = 1; reached; n += 1 + n / 8) {
            const fs::path here = begin(before);
            const RunResult result = run_with({"allocate", ENOMEM}, n, arguments, here, reached);
            const Files now = files_of(here);
            EXPECT_TRUE(result.exit == 0 ? now == after : now == before)
                << "allocation " << n << ": exit " << result.exit << ", " << result.err;
            // Before main(), where libraries allocate some nine hundred times, the C++ library ends the
            // process itself.
            EXPECT_TRUE(result.exit == 0 || result.exit == 2 || (result.exit == 134 && n < 220))
                << "allocation " << n << ": exit " << result.exit << ", " << result.err;
        }
    }

    ScratchDirectory scratch_;
};

const std::vector<std::string> kBuild{
    "build", "../castle.xml", "--quiet", "-o",     "a.svg", "-o",    "a.pdf",
    "-o",    "a.glb",         "-o",      "a.json", "-o",    "a.dxf", "-MD"};
const Files kOld{{"a.svg", "old svg"}, {"a.pdf", "old pdf"}, {"a.glb", "old glb"}, {"kept", "not ours"}};

// Whichever file cannot be made or written: a gallery says so in the words of the other writers.
TEST_F(Faults, AGalleryOnAFullDiskSpeaksAsOthersDo) {
    int failed = 0;
    for (const std::string_view call : {"open", "write"}) {
        bool reached = true;
        for (int n = 1; reached && n < 200; ++n) {
            const fs::path here = begin({{"card.xml", read_file(scratch_ / "castle.xml")}});
            const RunResult result = run_with({call, ENOSPC, true}, n,
                                              {"gallery", "card.xml", "-o", "out", "-j", "1"}, here, reached);
            if (!reached) break;
            ++failed;
            EXPECT_EQ(result.exit, 2) << call << ' ' << n;
            EXPECT_NE(result.err.find("no space is left on the disk"), std::string::npos)
                << call << ' ' << n << ": " << result.err;
            EXPECT_EQ(result.err.find("No space"), std::string::npos) << result.err;
            EXPECT_EQ(result.err.find("out/index.html: ") != std::string::npos,
                      fs::exists(here / "out" / "index.html"))
                << call << ' ' << n << ": " << result.err;
        }
    }
    EXPECT_GT(failed, 3);
}

TEST_F(Faults, OfABuildLeaveAllOrNothing) {
    EXPECT_GT(all_or_nothing({}, kBuild), 20);
    EXPECT_GT(all_or_nothing(kOld, kBuild), 30);
}

TEST_F(Faults, OfARepairLeaveTheDocument) {
    Files before{{"card.xml", read_file(fs::path(POPUP_SOURCE_DIR) / "tests/cases/repair/fold-snapped.xml")}};
    EXPECT_GT(all_or_nothing(before, {"fix", "--in-place", "card.xml"}), 5);
}

TEST_F(Faults, OfACheckLeaveItsResults) {
    const Files before{{"told.json", "old"}};
    EXPECT_GT(all_or_nothing(before, {"check", "../castle.xml", "--diagnostics", "told.json"}), 3);
}

// The next run mends what a batch could not do, and no job that was called done lacks its files.
TEST_F(Faults, OfABatchAreMendedByTheNext) {
    Files before{{"two", ""}};
    before["two"] =
        "{\"input\": \"../bird.xml\", \"output\": [\"a.svg\", \"a.glb\"]}\n"
        "{\"input\": \"../bird.xml\", \"output\": [\"b.svg\", \"b.glb\"]}\n";
    before["a.svg"] = "old svg";
    before["a.glb"] = "old glb";
    const std::vector<std::string> batch{"batch", "two", "--manifest-format", "jsonl", "--results", "r",
                                         "-j",    "1"};
    Files whole = made(before, batch);
    const auto results = whole.extract("r").mapped();
    for (const Fault& fault : kFaults) {
        bool reached = true;
        for (int n = 1; reached && n < 200; n += 1 + n / 8) {
            const fs::path here = begin(before);
            const RunResult first = run_with(fault, n, batch, here, reached);
            Files now = files_of(here);
            const std::string told = now["r"];
            now.erase("r");
            for (const std::string job : {"a", "b"}) {
                const std::string svg = job + ".svg";
                const std::string glb = job + ".glb";
                const bool done = now[svg] == whole[svg] && now[glb] == whole[glb];
                EXPECT_TRUE(done || (now[svg] == before[svg] && now[glb] == before[glb]))
                    << fault << ", number " << n << ", job " << job << ": " << first.err;
                EXPECT_TRUE(done || first.exit != 0) << fault << ", number " << n << ": " << first.err;
            }
            const RunResult second = popupc(batch, {.directory = here, .input = {}, .environment = {}});
            EXPECT_EQ(second.exit, 0) << fault << ", number " << n << ": " << second.err;
            now = files_of(here);
            EXPECT_EQ(now.count("r"), 1U);
            now.erase("r");
            EXPECT_EQ(now, whole) << fault << ", number " << n << ": after " << told;
        }
        EXPECT_FALSE(reached) << fault << " does not end";
    }
    EXPECT_FALSE(results.empty());
}

// The disk refuses all renames from the second on: one new file is in its place and cannot be taken back.
TEST_F(Faults, AnOldFileThatCannotBeBroughtBackOutlivesTheNextRun) {
    for (const bool no_exchange : {false, true}) {
        const fs::path here = begin(kOld);
        bool reached = false;
        const RunResult result = run_with({"rename", EIO, true, no_exchange}, 2, kBuild, here, reached);
        EXPECT_TRUE(reached);
        EXPECT_EQ(result.exit, 2);
        const std::string told = "the old version cannot be brought back, either: ";
        EXPECT_NE(result.err.find(told), std::string::npos) << result.err;
        EXPECT_NE(result.err.find(".old"), std::string::npos) << result.err;
        Files now = files_of(here);
        std::string kept;
        for (const auto& [name, bytes] : now) {
            if (name.ends_with(".old")) kept = name;
        }
        ASSERT_FALSE(kept.empty());
        EXPECT_EQ(now[kept], "old svg");
        EXPECT_EQ(popupc(kBuild, {.directory = here, .input = {}, .environment = {}}).exit, 0);
        EXPECT_EQ(files_of(here)[kept], "old svg");
    }
}

TEST_F(Faults, OfMemoryLeaveAllOrNothing) { out_of_memory(kOld, kBuild); }

}  // namespace
}  // namespace popup::test
