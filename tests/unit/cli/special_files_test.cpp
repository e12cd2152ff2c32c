// What is no design is read from files only: a pipe that nobody writes to must not keep a run waiting.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <string>
#include <vector>

#include "support/run_program.h"

namespace popup::test {
namespace {

namespace fs = std::filesystem;

// 124 where it had to be ended.
RunResult in_time(std::vector<std::string> arguments, const RunOptions& options) {
    std::vector<std::string> words{"timeout", "60", kPopupc};
    words.insert(words.end(), arguments.begin(), arguments.end());
    return run(words, options);
}

TEST(SpecialFiles, AreRefusedWhereSettingsAreRead) {
    const ScratchDirectory scratch;
    const RunOptions here{
        .directory = scratch.path(), .input = {}, .environment = {{"POPUPC_NO_CONFIG", ""}}};
    fs::copy_file(fs::path(POPUP_SOURCE_DIR) / "samples/bird.xml", scratch / "bird.xml");
    fs::create_directory(scratch / "lib");
    fs::create_directory(scratch / "below");
    fs::copy_file(scratch / "bird.xml", scratch / "lib/bird.xml");
    fs::copy_file(scratch / "bird.xml", scratch / "below/bird.xml");
    for (const std::string name : {"pipe.toml", "lib/.popupcignore", "below/popupc.toml"})
        ASSERT_EQ(::mkfifo((scratch / name).c_str(), 0600), 0);
    for (const std::vector<std::string>& words :
         std::vector<std::vector<std::string>>{{"check", "lib"},
                                               {"check", "below/bird.xml"},
                                               {"build", "bird.xml", "-o", "a.svg", "--profile", "pipe.toml"},
                                               {"build", "bird.xml", "-o", "a.svg", "--config", "pipe.toml"},
                                               {"check", "bird.xml", "--baseline", "pipe.toml"},
                                               {"batch", "pipe.toml", "--manifest-format", "jsonl"},
                                               {"batch", "/dev/zero", "--results", "r.jsonl"}}) {
        SCOPED_TRACE(words.back());
        const RunResult result = in_time(words, here);
        EXPECT_EQ(result.exit, 2);
        EXPECT_NE(result.err.find("cannot be read: it is a pipe, a socket or a device"), std::string::npos)
            << result.err;
        EXPECT_FALSE(fs::exists(scratch / "a.svg"));
    }
}

// A tree may be deeper than a path may be long; what cannot be looked at is told.
TEST(SpecialFiles, DirectoriesTooDeepForTheSystemAreTold) {
    const ScratchDirectory scratch;
    const fs::path start = fs::current_path();
    fs::create_directory(scratch / "deep");
    fs::current_path(scratch / "deep");
    for (int i = 0; i < 30; ++i) {
        fs::create_directory(std::string(200, 'd'));
        fs::current_path(std::string(200, 'd'));
    }
    write_file("card.xml", "<popup/>");
    fs::current_path(start);
    const RunResult result =
        in_time({"check", "deep"}, {.directory = scratch.path(), .input = {}, .environment = {}});
    EXPECT_EQ(result.exit, 2);
    EXPECT_NE(result.err.find("this cannot be looked at: File name too long"), std::string::npos)
        << result.err;
    EXPECT_EQ(run({"rm", "-rf", scratch / "deep"}).exit, 0);
}

}  // namespace
}  // namespace popup::test
