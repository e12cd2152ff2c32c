#include "popup/files.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "support/background.h"
#include "support/run_program.h"

namespace popup {
namespace {

namespace fs = std::filesystem;
using test::read_file;
using test::ScratchDirectory;
using test::write_file;

mode_t mode_of(const fs::path& path) {
    struct stat status {};
    return ::stat(path.c_str(), &status) == 0 ? status.st_mode & 07777U : 0;
}

bool wrote(const std::vector<PendingFile>& files, bool keep_identical = false) {
    Diagnostics diagnostics;
    const bool good = write_all(files, keep_identical, diagnostics);
    EXPECT_EQ(good, !diagnostics.has_errors());
    return good;
}

std::string complaint(const std::vector<PendingFile>& files) {
    Diagnostics diagnostics;
    EXPECT_FALSE(write_all(files, false, diagnostics));
    const auto all = diagnostics.sorted();
    EXPECT_EQ(all.size(), 1U);
    if (all.empty()) return {};
    EXPECT_EQ(all.front().code, "unwritable-output");
    return all.front().message;
}

TEST(ReadSource, GivesTheBytesAsTheyAre) {
    const ScratchDirectory scratch;
    const std::string bytes = std::string("a\0b\r\n\xff", 6) + std::string(100000, 'x');
    write_file(scratch / "in.xml", bytes);
    Diagnostics diagnostics;
    const auto source = read_source(scratch / "in.xml", diagnostics);
    ASSERT_TRUE(source);
    EXPECT_EQ(source->text, bytes);
    EXPECT_EQ(source->name, (scratch / "in.xml").string());
}

TEST(ReadSource, RefusesWhatCannotBeRead) {
    const ScratchDirectory scratch;
    for (const std::string& name : {(scratch / "missing").string(), scratch.path().string(), std::string()}) {
        Diagnostics diagnostics;
        EXPECT_FALSE(read_source(name, diagnostics)) << name;
        ASSERT_EQ(diagnostics.sorted().size(), 1U) << name;
        EXPECT_EQ(diagnostics.sorted().front().code, "unreadable-input") << name;
    }
}

TEST(ReadSource, TakesFilesUpToTheLimitAndNoLarger) {
    const ScratchDirectory scratch;
    write_file(scratch / "in", std::string(1000, 'x'));
    Diagnostics diagnostics;
    EXPECT_TRUE(read_source(scratch / "in", diagnostics, 1000));
    EXPECT_FALSE(diagnostics.has_errors());
    EXPECT_FALSE(read_source(scratch / "in", diagnostics, 999));
    EXPECT_TRUE(diagnostics.has_errors());
}

TEST(ReadSource, AnEndlessDeviceEndsAtTheLimit) {
    Diagnostics diagnostics;
    EXPECT_FALSE(read_source("/dev/zero", diagnostics, 1 << 16));
    EXPECT_TRUE(diagnostics.has_errors());
}

TEST(Source, StemIsTheLastPartWithoutItsSuffix) {
    EXPECT_EQ((Source{"designs/castle.xml", {}}.stem()), "castle");
    EXPECT_EQ((Source{"a.b/castle", {}}.stem()), "castle");
    EXPECT_EQ((Source{"castle.old.xml", {}}.stem()), "castle.old");
    EXPECT_EQ((Source{".hidden", {}}.stem()), ".hidden");
    EXPECT_EQ((Source{"-", {}}.stem()), "stdin");
}

TEST(WriteAll, WritesEveryFileAndLeavesNoLitter) {
    const ScratchDirectory scratch;
    write_file(scratch / "old", "before");
    EXPECT_TRUE(wrote({{scratch / "old", "after"}, {scratch / "new", "made"}, {scratch / "empty", ""}}));
    EXPECT_EQ(read_file(scratch / "old"), "after");
    EXPECT_EQ(read_file(scratch / "new"), "made");
    EXPECT_EQ(scratch.names(), (std::vector<std::string>{"empty", "new", "old"}));
}

TEST(WriteAll, ChangesNothingWhenOneFileCannotBeWritten) {
    const ScratchDirectory scratch;
    write_file(scratch / "old", "before");
    fs::create_directory(scratch / "directory");
    const std::vector<std::string> impossible = {scratch / "directory",
                                                 scratch / "nowhere/file",
                                                 scratch / "old/file",
                                                 scratch / "directory/",
                                                 "",
                                                 "/dev/full"};
    for (const std::string& path : impossible) {
        complaint({{scratch / "old", "after"}, {scratch / "new", "made"}, {path, "x"}});
        EXPECT_EQ(read_file(scratch / "old"), "before") << path;
        EXPECT_EQ(scratch.names(), (std::vector<std::string>{"directory", "old"})) << path;
    }
}

TEST(WriteAll, RefusesAReadOnlyFile) {
    if (::geteuid() == 0) GTEST_SKIP() << "the superuser may write everything";
    const ScratchDirectory scratch;
    write_file(scratch / "old", "before");
    ::chmod((scratch / "old").c_str(), 0444);
    EXPECT_NE(complaint({{scratch / "old", "after"}}).find("permission denied"), std::string::npos);
    EXPECT_EQ(read_file(scratch / "old"), "before");
}

TEST(WriteAll, RefusesTwoNamesOfOneFile) {
    const ScratchDirectory scratch;
    complaint({{scratch / "a", "1"}, {(scratch.path() / "." / "a").string(), "2"}});
    fs::create_symlink("a", scratch / "link");
    complaint({{scratch / "a", "1"}, {scratch / "link", "2"}});
    EXPECT_EQ(scratch.names(), (std::vector<std::string>{"link"}));
}

TEST(WriteAll, KeepsPermissionsAndHonoursTheUmask) {
    const ScratchDirectory scratch;
    write_file(scratch / "old", "before");
    ::chmod((scratch / "old").c_str(), 0751);
    const mode_t before = ::umask(027);
    EXPECT_TRUE(wrote({{scratch / "old", "after"}, {scratch / "new", "made"}}));
    ::umask(before);
    EXPECT_EQ(mode_of(scratch / "old"), 0751U);
    EXPECT_EQ(mode_of(scratch / "new"), 0640U);
}

TEST(WriteAll, FollowsSymbolicLinks) {
    const ScratchDirectory scratch;
    fs::create_directory(scratch / "there");
    write_file(scratch / "there/file", "before");
    fs::create_symlink("there/file", scratch / "link");
    fs::create_symlink("there/later", scratch / "dangling");
    fs::create_symlink("loop", scratch / "loop");
    EXPECT_TRUE(wrote({{scratch / "link", "after"}, {scratch / "dangling", "made"}}));
    EXPECT_TRUE(fs::is_symlink(scratch / "link"));
    EXPECT_TRUE(fs::is_symlink(scratch / "dangling"));
    EXPECT_EQ(read_file(scratch / "there/file"), "after");
    EXPECT_EQ(read_file(scratch / "there/later"), "made");
    complaint({{scratch / "loop", "x"}});
}

TEST(WriteAll, WritesThroughDevicesAndPipes) {
    const ScratchDirectory scratch;
    EXPECT_TRUE(wrote({{"/dev/null", "gone"}}));
    struct stat status {};
    ASSERT_EQ(::stat("/dev/null", &status), 0);
    EXPECT_TRUE(S_ISCHR(status.st_mode));

    const std::string pipe = scratch / "pipe";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    std::string got;
    std::thread reader([&] { got = read_file(pipe); });
    EXPECT_TRUE(wrote({{pipe, "through"}}));
    reader.join();
    EXPECT_EQ(got, "through");
    EXPECT_EQ(scratch.names(), (std::vector<std::string>{"pipe"}));
}

TEST(WriteAll, LeavesIdenticalFilesAloneWhenAsked) {
    const ScratchDirectory scratch;
    write_file(scratch / "same", "bytes");
    write_file(scratch / "other", "bytez");
    const auto past = fs::file_time_type::clock::now() - std::chrono::hours(1);
    fs::last_write_time(scratch / "same", past);
    fs::last_write_time(scratch / "other", past);
    EXPECT_TRUE(wrote({{scratch / "same", "bytes"}, {scratch / "other", "bytes"}}, true));
    EXPECT_EQ(fs::last_write_time(scratch / "same"), past);
    EXPECT_NE(fs::last_write_time(scratch / "other"), past);
    EXPECT_EQ(read_file(scratch / "other"), "bytes");
    EXPECT_TRUE(wrote({{scratch / "same", "bytes"}}, false));
    EXPECT_NE(fs::last_write_time(scratch / "same"), past);
}

// A fifo that nobody reads holds the run when its temporary files are already there; there the signal finds
// it.
TEST(WriteAll, ASignalLeavesTheOldFilesAndNoLitter) {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        const ScratchDirectory scratch;
        write_file(scratch / "old", "before");
        const std::string pipe = scratch / "pipe";
        ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
        const pid_t child = ::fork();
        ASSERT_GE(child, 0);
        if (child == 0) {
            std::signal(signal, SIG_DFL);
            Diagnostics diagnostics;
            write_all({{scratch / "old", "after"}, {pipe, "never read"}}, false, diagnostics);
            ::_exit(0);
        }
        EXPECT_TRUE(test::eventually([&] { return scratch.names().size() == 3; }))
            << "the temporary file was never seen";
        ::kill(child, signal);
        int status = 0;
        ::waitpid(child, &status, 0);
        EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == signal);
        EXPECT_EQ(scratch.names(), (std::vector<std::string>{"old", "pipe"}));
        EXPECT_EQ(read_file(scratch / "old"), "before");
    }
}

// The names say which machine made a file, and which process. That of another machine, or of this one before
// it was started anew, cannot be asked after.
TEST(RemoveLitter, TakesWhatHasLainForADayWhoeverMadeIt) {
    using std::chrono::hours;
    using std::chrono::minutes;
    const ScratchDirectory scratch;
    const std::string other = ".popup-00c0ffee-1-0123456789abcdef.tmp";  // process 1 always runs
    write_file(scratch / other, "half of a sheet");
    const auto now = std::chrono::system_clock::now();
    EXPECT_EQ(remove_litter(scratch.path(), now), 0U);
    EXPECT_EQ(remove_litter(scratch.path(), now + kLitterKeeps - minutes(5)), 0U);
    EXPECT_EQ(remove_litter(scratch.path(), now - hours(1000)), 0U) << "a clock that is slow";
    EXPECT_EQ(scratch.names(), std::vector<std::string>{other});
    EXPECT_EQ(remove_litter(scratch.path(), now + kLitterKeeps + minutes(5)), 1U);
    EXPECT_EQ(scratch.names(), std::vector<std::string>());
}

TEST(NewFile, HasTheModeThatItWasGivenBeforeItsFirstByteToo) {
    const ScratchDirectory scratch;
    for (const bool before : {true, false}) {
        const fs::path path = scratch / (before ? "before" : "after");
        NewFile file(path.string());
        if (before) file.keep_mode(0600);
        ASSERT_TRUE(file.write("private"));
        if (!before) file.keep_mode(0600);
        ASSERT_TRUE(file.commit());
        EXPECT_EQ(mode_of(path), 0600U) << path;
        EXPECT_EQ(read_file(path), "private");
    }
}

// An old file may wait under such a name to be brought back: when it was written says nothing then.
TEST(RemoveLitter, AsksWhenANameWasGivenAndNotWhenTheFileWasWritten) {
    const ScratchDirectory scratch;
    write_file(scratch / "old", "of last year");
    fs::last_write_time(scratch / "old", fs::file_time_type::clock::now() - std::chrono::hours(9000));
    fs::rename(scratch / "old", scratch / ".popup-00c0ffee-1-0123456789abcdef.tmp");
    EXPECT_EQ(remove_litter(scratch.path()), 0U);
}

TEST(RemoveLitter, TakesNothingElse) {
    const ScratchDirectory scratch;
    const std::vector<std::string> names{".popup-",
                                         ".popup-.tmp",
                                         ".popup-00c0ffee-.tmp",
                                         ".popup-00c0ffee-1-.tmp",
                                         ".popup-00c0ffee-1-0123456789abcde.tmp",
                                         ".popup-00c0ffee-1-0123456789abcdef.old",
                                         ".popup-00c0ffee-1-0123456789abcdef.tmp.svg",
                                         ".popup-notes.tmp",
                                         "popup-00c0ffee-1-0123456789abcdef.tmp"};
    for (const std::string& name : names) write_file(scratch / name, "mine");
    fs::create_directory(scratch / ".popup-00c0ffee-1-0123456789abcdef.tmp");
    const auto later = std::chrono::system_clock::now() + 10 * kLitterKeeps;
    EXPECT_EQ(remove_litter(scratch.path(), later), 0U);
    EXPECT_EQ(scratch.names().size(), names.size() + 1);
}

}  // namespace
}  // namespace popup
