// Mistakes that are easily made, and that passed without a word or were told as something else.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "support/background.h"
#include "support/run_program.h"

namespace popup::test {
namespace {

namespace fs = std::filesystem;

class Mistakes : public testing::Test {
 protected:
    Mistakes() {
        fs::copy_file(fs::path(POPUP_SOURCE_DIR) / "samples/bird.xml", scratch / "bird.xml");
        here.directory = scratch.path();
    }
    void told(const std::vector<std::string>& words, int exit, const std::string& said) const {
        const RunResult result = popupc(words, here);
        EXPECT_EQ(result.exit, exit) << result.err;
        EXPECT_NE(result.err.find(said), std::string::npos) << result.err;
    }
    ScratchDirectory scratch;
    RunOptions here;
};

TEST_F(Mistakes, AKeyTwiceInARowOfAManifest) {
    write_file(scratch / "jobs.jsonl", R"({"input": "bird.xml", "input": "x.xml", "output": "a.svg"})");
    told({"batch", "jobs.jsonl"}, 2, "jobs.jsonl:1:1: error: \"input\" stands twice in the row");
    EXPECT_FALSE(fs::exists(scratch / "a.svg"));
    // In what an object holds it is another's affair.
    write_file(scratch / "good.jsonl", R"({"input": ["bird.xml"], "output": "a.svg"})");
    told({"batch", "good.jsonl", "-j1"}, 0, "1 done; 1 tried");
}

TEST_F(Mistakes, ResultsInNoFile) {
    write_file(scratch / "jobs.jsonl", R"({"input": "bird.xml", "output": "a.svg"})");
    told({"batch", "jobs.jsonl", "--results", "-"}, 2, "hint: write ./- if that is its name");
    EXPECT_FALSE(fs::exists(scratch / "-"));
    told({"batch", "jobs.jsonl", "--results", "./-"}, 0, "1 done; 1 tried");
    EXPECT_TRUE(fs::exists(scratch / "-"));
}

TEST_F(Mistakes, AnInputWithoutAName) {
    told({"check", ""}, 2, "an input has an empty name");
    told({"build", "", "-o", "a.svg"}, 2, "an input has an empty name");
    told({"fix", ""}, 2, "an input has an empty name");
    told({"show", "bird.xml", ""}, 2, "the element to show has an empty name");
}

TEST_F(Mistakes, TooManyAngles) {
    told({"check", "bird.xml", "--angles", "0:180:0.001"}, 2, "is 180001 angles; the most is 100000");
    told({"check", "bird.xml", "--angles", "0:190:1"}, 2, "takes degrees from 0 to 180");
}

TEST_F(Mistakes, AProgramInUtf16) {
    using namespace std::string_literals;
    for (const std::string& text : {"\xFF\xFE"s + "a\0=\0"s, "\xFE\xFF"s + "\0a\0="s, "a\0=\0001\0"s}) {
        write_file(scratch / "wide.fl", text);
        const RunResult result = popupc({"check", "wide.fl"}, here);
        EXPECT_EQ(result.exit, 1);
        EXPECT_NE(result.err.find("wide.fl:1:1: error: the program is in UTF-16 or UTF-32"),
                  std::string::npos)
            << result.err;
        EXPECT_EQ(result.err.find("error:"), result.err.rfind("error:")) << "one error says it";
    }
}

TEST_F(Mistakes, AProgramThatLoadsItself) {
    write_file(scratch / "self.fl", "load(\"self.fl\")\n");
    told({"check", "self.fl"}, 1, "self.fl:1:1: error: loaded files");
}

TEST_F(Mistakes, VariablesThatSetNothing) {
    here.environment["POPUPC_NOSUCH"] = "1";
    told({"check", "bird.xml"}, 0, "warning: the variable POPUPC_NOSUCH sets no option\n");
    here.environment = {{"POPUPC_SHEEET", "a4"}};
    told({"check", "bird.xml"}, 0, "POPUPC_SHEEET sets no option; did you mean POPUPC_SHEET?\n");
    // An option of the program, and none that a variable sets.
    here.environment = {{"POPUPC_TILE", "a4"}};
    told({"check", "bird.xml"}, 0,
         "the variable POPUPC_TILE sets nothing: --tile belongs to one run, and is given on the command "
         "line\n");
    here.environment.clear();
    for (const std::string wrong : {"abc", "-1", "1.5", "99999999999999"}) {
        here.environment["SOURCE_DATE_EPOCH"] = wrong;
        told({"build", "bird.xml", "-o", "a.pdf"}, 2, "SOURCE_DATE_EPOCH is \"" + wrong + "\"");
        EXPECT_FALSE(fs::exists(scratch / "a.pdf"));
    }
    here.environment["SOURCE_DATE_EPOCH"] = "1700000000";
    EXPECT_EQ(popupc({"build", "bird.xml", "-o", "a.pdf"}, here).exit, 0);
}

// What a run that was killed left is taken away by the next that writes there; what a running one has stays.
TEST_F(Mistakes, WhatAKilledRunLeft) {
    // The name of a temporary file of this machine, as a run has it that is killed while it writes.
    ASSERT_EQ(::mkfifo((scratch / "pipe").c_str(), 0600), 0);
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
        ::chdir(scratch.path().c_str());
        // It waits at the pipe, after the files beside it have been written.
        ::execl(kPopupc, "popupc", "build", "bird.xml", "-q", "-o", "a.svg", "-o", "a.pdf", "--to", "svg",
                "-o", "pipe", nullptr);
        ::_exit(127);
    }
    const auto litter = [this] {
        const std::vector<std::string> names = scratch.names();
        return std::count_if(names.begin(), names.end(),
                             [](const std::string& name) { return name.starts_with(".popup-"); });
    };
    EXPECT_TRUE(eventually([&] { return litter() >= 2; }));
    EXPECT_EQ(popupc({"check", "bird.xml", "--diagnostics", "out"}, here).exit, 0);
    EXPECT_GE(litter(), 1) << "it is still running";
    ::kill(child, SIGKILL);
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_GE(litter(), 1);
    EXPECT_EQ(popupc({"build", "bird.xml", "-o", "b.svg"}, here).exit, 0);
    EXPECT_EQ(litter(), 0);
}

TEST_F(Mistakes, AFileWithTwoNamesMendedInPlace) {
    const fs::path wrong = fs::path(POPUP_SOURCE_DIR) / "tests/cases/repair/apex-off-fold.xml";
    fs::copy_file(wrong, scratch / "card.xml");
    fs::create_hard_link(scratch / "card.xml", scratch / "twin.xml");
    fs::create_hard_link(scratch / "bird.xml", scratch / "same.xml");
    told({"fix", "--in-place", "card.xml"}, 0,
         "card.xml has 1 more name (hard links), which keeps the document");
    EXPECT_EQ(read_file(scratch / "twin.xml"), read_file(wrong));
    EXPECT_NE(read_file(scratch / "card.xml"), read_file(wrong));
    EXPECT_EQ(popupc({"fix", "--in-place", "bird.xml"}, here).err, "") << "it stays as it is";
    EXPECT_EQ(fs::hard_link_count(scratch / "bird.xml"), 2U);
    // Whichever verb replaces it.
    write_file(scratch / "loose.xml", read_file(scratch / "bird.xml") + "\n\n\n");
    fs::create_hard_link(scratch / "loose.xml", scratch / "tight.xml");
    told({"fmt", "--in-place", "loose.xml"}, 0, "loose.xml has 1 more name (hard links)");
    fs::create_hard_link(scratch / "card.xml", scratch / "other.xml");
    told({"edit", "card.xml", "--in-place", "rename", "bird", "first"}, 0,
         "card.xml has 1 more name (hard links)");
}

}  // namespace
}  // namespace popup::test
