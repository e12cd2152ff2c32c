// What the command line does with inputs that are programs: their variables, folders and limits, what they
// print and draw, and the files that they load.
#include <gtest/gtest.h>

#include <cmath>
#include <csignal>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "support/background.h"
#include "support/run_program.h"

namespace popup::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

// Draws a square of `size` inches, which is 1 where nothing else is said.
constexpr std::string_view kSquare =
    "size = 1\n"
    "print(\"size\", size)\n"
    "repeat (4) forward(size) left(90) done\n";

class Programs : public testing::Test {
 protected:
    Programs() {
        options.directory = scratch.path();
        write_file(scratch / "square.fl", kSquare);
    }
    // Runs popupc; the first word is the verb.
    RunResult ran(std::vector<std::string> arguments, int exit = 0) {
        RunResult result = popupc(arguments, options);
        EXPECT_EQ(result.exit, exit) << result.out << result.err;
        return result;
    }
    // What a program prints with these options.
    std::string prints(const std::string& program, std::vector<std::string> arguments = {}) {
        write_file(scratch / "asked.fl", program + "\nrepeat (4) forward(1) left(90) done\n");
        arguments.insert(arguments.begin(), {"check", "asked.fl"});
        return ran(std::move(arguments)).err;
    }
    [[nodiscard]] std::string text(const std::string& name) const { return read_file(scratch / name); }
    // Width of the only sheet's only piece, in mm.
    double width(const std::string& report) {
        return json::parse(text(report)).at("layout").at("used_mm").at(0).at(0).get<double>();
    }

    ScratchDirectory scratch;
    RunOptions options;
};

bool has(const std::string& text, std::string_view part) { return text.find(part) != std::string::npos; }

TEST_F(Programs, DefinitionsAreVariables) {
    EXPECT_EQ(prints("print(n, t, b, e)", {"-D", "n=3", "-Dt=two words", "--define=b", "-D", "e="}),
              "3.0 two words true\n");
    EXPECT_EQ(
        prints("print(n)", {"-D", "n=1", "-D", "m=5", "-D", "n=-2.5", "--allow=flatlang-unused-definition"}),
        "-2.5\n");
    EXPECT_EQ(prints("print(n + 1)", {"-D", "n=1=2"}), "1=21.0\n");
    ran({"build", "square.fl", "-D", "size=3", "-o", "three.json", "-q"});
    ran({"build", "square.fl", "-o", "one.json", "-q"});
    EXPECT_NEAR(width("three.json"), 76.2, 1e-3);
    EXPECT_NEAR(width("one.json"), 25.4, 1e-3);
}

TEST_F(Programs, WhatIsNoNameCannotBeDefined) {
    for (const std::string wrong : {"9a=1", "a-b=1", "=3", "", "\xc3\xa4=1", "a b"}) {
        const RunResult result = ran({"check", "square.fl", "-D", wrong}, 2);
        EXPECT_TRUE(has(result.err, "-D takes NAME=VALUE")) << wrong << "\n" << result.err;
        EXPECT_TRUE(has(result.err, "hint: names are letters")) << wrong << "\n" << result.err;
    }
}

TEST_F(Programs, EachLimitEndsTheProgramItIsFor) {
    const std::vector<std::pair<std::string, std::string>> limits{
        {"--max-steps", "while (true) a = 1 done"},
        {"--max-depth", "define f(n) f(n + 1) done f(0)"},
        {"--max-values", "l = [] while (true) l = cons(1, l) done"},
        {"--max-text", "t = \"xxxxxxxx\" while (true) t = t + t done"},
        {"--max-trail", "while (true) forward(1) done"},
    };
    for (const auto& [option, program] : limits) {
        write_file(scratch / "endless.fl", program);
        const RunResult result = ran({"check", "endless.fl", option, "500"}, 1);
        EXPECT_TRUE(has(result.err, "[flatlang-limit]")) << option << "\n" << result.err;
        EXPECT_TRUE(has(result.err, option)) << result.err;
        for (const std::string wrong : {"0", "-1", "1.5", "many", "", "1e400"}) {
            EXPECT_TRUE(has(ran({"check", "square.fl", option, wrong}, 2).err, option)) << wrong;
        }
    }
    EXPECT_TRUE(has(ran({"check", "square.fl", "--max-depth", "100001"}, 2).err, "from 1 to 100000"));
    // Also where they leave no room for what stands before the program.
    for (const std::string option : {"--max-steps", "--max-values"}) {
        EXPECT_TRUE(has(ran({"check", "square.fl", option, "1"}, 1).err, "[flatlang-limit]")) << option;
    }
}

TEST_F(Programs, FoldersAreLookedIntoInTheirOrder) {
    for (const std::string folder : {"a", "b"}) {
        fs::create_directory(scratch / folder);
        write_file(scratch / (folder + "/who.fl"), "print(\"" + folder + "\")");
    }
    write_file(scratch / "b/only.fl", "print(\"only b\")");
    EXPECT_EQ(prints("load(\"who.fl\")", {"-I", "a", "-Ib"}), "a\n");
    EXPECT_EQ(prints("load(\"who.fl\")", {"-I", "b", "--include-dir", "a"}), "b\n");
    EXPECT_EQ(prints("load(\"only.fl\")", {"-I", "a", "-I", "b"}), "only b\n");
    write_file(scratch / "who.fl", "print(\"own\")");
    EXPECT_EQ(prints("load(\"who.fl\")", {"-I", "a"}), "own\n");
    EXPECT_TRUE(has(ran({"check", "square.fl", "-I", ""}, 2).err, "-I takes the name of a directory"));
}

TEST_F(Programs, TheEditionOf2008HasItsOddities) {
    const std::string program = "a = 0 - 5 print(-a)";
    EXPECT_EQ(prints(program), "5.0\n");
    EXPECT_EQ(prints(program, {"--flatlang", "2008"}), "0.0\n");
    EXPECT_EQ(prints(program, {"--flatlang=2008", "--flatlang=mended"}), "5.0\n");
    EXPECT_TRUE(has(ran({"check", "square.fl", "--flatlang=2009"}, 2).err, "takes mended, 2008, not"));
}

TEST_F(Programs, ConfigurationsAndVariablesSetThem) {
    options.environment["POPUPC_NO_CONFIG"] = "";
    fs::create_directories(scratch / "parts/lib");
    write_file(scratch / "parts/lib/lib.fl", "print(\"lib\")");
    write_file(scratch / "parts/popupc.toml",
               "define = ['a=7', 'b=x, y']\ninclude-dir = 'lib'\nmax-steps = 100000\nflatlang = 2008\n");
    write_file(scratch / "parts/p.fl", "load(\"lib.fl\") print(a, b, -(0 - 1)) " + std::string(kSquare));
    EXPECT_EQ(ran({"check", "parts/p.fl"}).err, "lib\n7.0 x, y 0.0\nsize 1.0\n");
    // What is given stands in place of what is configured, as with every option.
    EXPECT_EQ(ran({"check", "parts/p.fl", "-D", "a=8", "--flatlang", "mended"}).err,
              "lib\n8.0 nil 1.0\nsize 1.0\n");
    // A definition for all programs of a directory need not be used by each.
    write_file(scratch / "parts/q.fl", kSquare);
    EXPECT_EQ(ran({"check", "parts/q.fl", "--flatlang=mended"}).err, "size 1.0\n");
    EXPECT_TRUE(has(ran({"check", "parts/q.fl", "--flatlang=mended", "-D", "a=8"}, 1).err,
                    "[flatlang-unused-definition]"));
    EXPECT_TRUE(
        has(ran({"check", "parts/q.fl", "--flatlang=mended", "--deny", "flatlang-unused-definition"}, 1).err,
            "q.fl: error: "));
    options.environment["POPUPC_DEFINE"] = "a=1,b=2";
    EXPECT_EQ(ran({"check", "parts/p.fl"}).err, "lib\n1.0 2.0 0.0\nsize 1.0\n");
}

TEST_F(Programs, WhatIsPrintedStandsBeforeTheFindings) {
    EXPECT_EQ(ran({"check", "square.fl", "--quiet"}).err, "size 1.0\n");
    EXPECT_EQ(ran({"build", "square.fl", "-q", "-o", "a.svg"}).err, "size 1.0\n");
    write_file(scratch / "bad.fl",
               "print(\"so far\")\nfrom (\"nowhere\") forward(1) done\nprint(\"not reached\")\n");
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{"check", "bad.fl"}, {"build", "bad.fl", "-o", "b.svg"}}) {
        const RunResult result = ran(words, 1);
        EXPECT_TRUE(result.err.starts_with("so far\nbad.fl:2:7: error: ")) << result.err;
        EXPECT_EQ(result.out, "");
    }
    EXPECT_FALSE(fs::exists(scratch / "b.svg"));
    const RunResult several = ran({"check", "square.fl", "bad.fl", "square.fl", "-q", "-j2"}, 1);
    EXPECT_TRUE(
        several.err.starts_with("== square.fl ==\nsize 1.0\n== bad.fl ==\nso far\n== square.fl ==\nsize 1.0\n"
                                "bad.fl:2:7: error: "))
        << several.err;
    EXPECT_EQ(ran({"check", "bad.fl", "--message-format=json"}, 1).err, "so far\n");
}

TEST_F(Programs, ATerminalIsNotToldWhatToDoByAProgram) {
    EXPECT_EQ(prints("print(\"a\x1b[2Jb\tc\")"), "a\\x1b[2Jb\tc\n");
    EXPECT_EQ(prints("print(\"a\x1b[2Jb\tc\")", {"--print", "raw.txt"}), "");
    EXPECT_EQ(text("raw.txt"), "a\x1b[2Jb\tc\n");
}

TEST_F(Programs, WhatIsPrintedMayGoToAFile) {
    EXPECT_EQ(ran({"build", "square.fl", "-q", "-o", "a.svg", "--print", "said.txt"}).err, "");
    EXPECT_EQ(text("said.txt"), "size 1.0\n");
    EXPECT_EQ(ran({"build", "square.fl", "-q", "-o", "a.svg", "--print", "-"}).out, "size 1.0\n");
    EXPECT_EQ(ran({"check", "square.fl", "square.fl", "-q", "--print", "-"}).out,
              "== square.fl ==\nsize 1.0\n== square.fl ==\nsize 1.0\n");
    write_file(scratch / "bad.fl", "print(\"so far\") from (\"nowhere\") forward(1) done");
    ran({"build", "bad.fl", "-o", "b.svg", "--print", "said.txt"}, 1);
    EXPECT_EQ(text("said.txt"), "so far\n");
    EXPECT_EQ(ran({"check", "bad.fl", "--print", "-"}, 1).out, "so far\n");
    // All or nothing.
    fs::create_directory(scratch / "taken");
    ran({"build", "square.fl", "-o", "c.svg", "--print", "taken"}, 2);
    EXPECT_FALSE(fs::exists(scratch / "c.svg"));
    EXPECT_TRUE(has(ran({"check", "square.fl", "--print", "taken"}, 2).err, "unwritable-output"));
}

TEST_F(Programs, ThePrintedFileHasAPlaceOfItsOwn) {
    const auto refuse = [&](std::vector<std::string> words, std::string_view part) {
        const RunResult result = ran(std::move(words), 2);
        EXPECT_TRUE(has(result.err, part)) << result.err;
        EXPECT_EQ(text("square.fl"), kSquare);
    };
    refuse({"build", "square.fl", "-o", "a.svg", "--print", "a.svg"}, "a.svg is named twice");
    refuse({"build", "square.fl", "-o", "a.svg", "--print", "./square.fl"}, "is an input");
    refuse({"build", "square.fl", "--to", "svg", "-o", "-", "--print", "-"}, "more than one user");
    refuse({"build", "square.fl", "--emit", "pattern", "--print", "-"}, "more than one user");
    refuse({"check", "square.fl", "--print", "square.fl"}, "overwrite square.fl, an input");
    refuse({"check", ".", "--print", "square.fl"}, "overwrite square.fl, an input");
    refuse({"check", "square.fl", "--print", "-", "--message-format", "json"}, "two users");
    refuse({"check", "square.fl", "--print", "x", "--diagnostics", "x"}, "named twice");
    refuse({"check", "square.fl", "--print", ""}, "--print takes the name of a file");
}

TEST_F(Programs, TheTrailIsPrintedAlsoOfProgramsThatFail) {
    const RunResult good = ran({"build", "square.fl", "--emit", "trail"});
    const json trail = json::parse(good.out);
    EXPECT_EQ(trail.at("status"), "ok");
    EXPECT_EQ(trail.at("stdout"), "size 1.0\n");
    EXPECT_EQ(trail.at("segments").size(), 4U);
    EXPECT_EQ(trail.at("polygons").size(), 1U);
    EXPECT_EQ(good.err, "");
    // Open lines make no part, but a trail.
    write_file(scratch / "open.fl", "forward(1)");
    EXPECT_EQ(json::parse(ran({"build", "open.fl", "--emit", "trail"}).out).at("segments").size(), 1U);
    write_file(scratch / "bad.fl", "forward(1)\nfrom (\"nowhere\") forward(1) done");
    const RunResult bad = ran({"build", "bad.fl", "--emit", "trail"}, 1);
    EXPECT_EQ(json::parse(bad.out).at("status"), "runtime-fail");
    EXPECT_EQ(json::parse(bad.out).at("segments").size(), 1U);
    EXPECT_TRUE(has(bad.err, "[flatlang-runtime]")) << bad.err;
    const RunResult both = ran({"build", "bad.fl", "square.fl", "--emit", "trail"}, 1);
    ASSERT_EQ(json::parse(both.out).size(), 2U);
    EXPECT_EQ(json::parse(both.out).at(1), trail);
}

TEST_F(Programs, TheTrailMayBePrintedBesideOutputs) {
    const RunResult alone = ran({"build", "square.fl", "--emit", "trail"});
    const RunResult good = ran({"build", "square.fl", "--emit", "trail", "-o", "a.svg", "-q"});
    EXPECT_EQ(good.out, alone.out);
    EXPECT_EQ(good.err, "size 1.0\n");
    EXPECT_TRUE(fs::exists(scratch / "a.svg"));
    write_file(scratch / "bad.fl", "print(1)\nfrom (\"nowhere\") forward(1) done");
    const RunResult bad = ran({"build", "bad.fl", "--emit", "trail", "-o", "b.svg", "--print", "said"}, 1);
    EXPECT_EQ(json::parse(bad.out).at("status"), "runtime-fail");
    EXPECT_EQ(text("said"), "1.0\n");
    EXPECT_FALSE(fs::exists(scratch / "b.svg"));
}

TEST_F(Programs, WhatIsNoProgramHasNoTrail) {
    const std::string castle = (fs::path(POPUP_SOURCE_DIR) / "samples/castle.xml").string();
    const RunResult result = ran({"build", "square.fl", castle, "--emit", "trail"}, 2);
    EXPECT_TRUE(has(result.err, "this is no program, and has no trail")) << result.err;
    EXPECT_EQ(result.out, "");
    EXPECT_TRUE(has(ran({"build", "square.fl", "--emit", "trail", "--print", "x"}, 2).err, "\"stdout\""));
    EXPECT_TRUE(has(ran({"build", "square.fl", "--emit", "track"}, 2).err, "did you mean"));
}

TEST_F(Programs, StandardInputMayBeAProgram) {
    options.input = kSquare;
    EXPECT_EQ(ran({"check", "-", "--from", "flatlang"}).err, "size 1.0\n");
    const RunResult sheet =
        ran({"build", "-", "--from=flatlang", "-D", "size=2", "--to", "svg", "-o", "-", "-q"});
    EXPECT_TRUE(has(sheet.out, "</svg>"));
    EXPECT_EQ(sheet.err, "size 2.0\n");
    EXPECT_EQ(json::parse(ran({"build", "-", "--from", "flatlang", "--emit", "trail"}).out).at("status"),
              "ok");
}

// A program that loads one file, of a folder that -I names.
class LoadedFiles : public Programs {
 protected:
    LoadedFiles() {
        fs::create_directory(scratch / "lib");
        write_file(scratch / "lib/size.fl", kSize);
        write_file(scratch / "part.fl", "load(\"size.fl\") repeat (4) forward(size()) left(90) done");
    }
    const std::string kSize = "define size() 1 done";
    const std::vector<std::string> build{"build", "part.fl", "-q", "-I", "lib", "-o", "part.svg"};
    std::vector<std::string> with(std::vector<std::string> more) {
        more.insert(more.begin(), build.begin(), build.end());
        return more;
    }
};

TEST_F(LoadedFiles, StandInDependencyFiles) {
    ran(with({"-MD"}));
    EXPECT_EQ(text("part.d"), "part.svg: part.fl lib/size.fl\n");
    write_file(scratch / "part.fl", "load(\"size.fl\") from (\"nowhere\") forward(1) done");
    ran(with({"-MD", "--deps-format", "json"}), 1);
    EXPECT_EQ(json::parse(text("part.d.json")).at("inputs"), json({"part.fl", "lib/size.fl"}));
}

TEST_F(LoadedFiles, AreNotWrittenOver) {
    fs::create_hard_link(scratch / "lib/size.fl", scratch / "size.svg");
    const auto refuse = [&](std::vector<std::string> words) {
        const RunResult result = ran(std::move(words), 2);
        EXPECT_TRUE(has(result.err, "lib/size.fl is read by an input of this run")) << result.err;
        EXPECT_EQ(text("lib/size.fl"), kSize);
        EXPECT_FALSE(fs::exists(scratch / "part.svg"));
    };
    refuse({"build", "part.fl", "-I", "lib", "-o", "size.svg"});
    refuse(with({"--print", "lib/size.fl"}));
    refuse(with({"--diagnostics", "lib/size.fl"}));
    refuse(with({"-MD", "-MF", "lib/size.fl"}));
    refuse({"build", "part.fl", "-I", "lib", "--emit", "trail", "--diagnostics", "lib/size.fl"});
    refuse({"check", "part.fl", "-I", "lib", "--print", "lib/size.fl"});
    refuse({"check", "part.fl", "-I", "lib", "--diagnostics", "lib/size.fl"});
}

TEST_F(LoadedFiles, MakeJobsOfABatchStale) {
    write_file(scratch / "jobs.jsonl",
               "{\"input\": \"part.fl\", \"output\": \"a.json\", \"options\": \"-I lib --print a.txt\"}\n"
               "{\"input\": \"square.fl\", \"output\": \"b.json\", \"options\": \"-D size=2\"}\n");
    const RunResult first = ran({"batch", "jobs.jsonl", "-j1"});
    EXPECT_TRUE(has(first.err, "2 tried")) << first.err;
    EXPECT_TRUE(first.err.starts_with("size 2.0\n")) << first.err;
    EXPECT_EQ(text("a.txt"), "");
    EXPECT_TRUE(has(ran({"batch", "jobs.jsonl"}).err, "2 as they were"));
    write_file(scratch / "lib/size.fl", "define size() 3 done");
    EXPECT_TRUE(has(ran({"batch", "jobs.jsonl"}).err, "1 as they were; 1 tried"));
    EXPECT_NEAR(width("a.json"), 76.2, 1e-3);
    // What failed is tried again when a file that it has loaded is mended, and not before.
    write_file(scratch / "lib/size.fl", "define size() from (\"nowhere\") 1 done done");
    EXPECT_TRUE(has(ran({"batch", "jobs.jsonl"}, 1).err, "1 tried"));
    EXPECT_TRUE(has(ran({"batch", "jobs.jsonl"}, 1).err, "2 as they were"));
    write_file(scratch / "lib/size.fl", kSize);
    EXPECT_TRUE(has(ran({"batch", "jobs.jsonl"}).err, "1 tried"));
    EXPECT_NEAR(width("a.json"), 25.4, 1e-3);
    // A file that comes to be in a folder that is looked into before.
    write_file(scratch / "size.fl", "define size() 2 done");
    EXPECT_TRUE(has(ran({"batch", "jobs.jsonl"}).err, "1 tried"));
    EXPECT_NEAR(width("a.json"), 50.8, 1e-3);
    EXPECT_TRUE(has(ran({"batch", "jobs.jsonl"}).err, "2 as they were"));
    fs::remove(scratch / "size.fl");
    EXPECT_TRUE(has(ran({"batch", "jobs.jsonl"}).err, "1 tried"));
    // A file of prints is an output like others.
    fs::remove(scratch / "a.txt");
    EXPECT_TRUE(has(ran({"batch", "jobs.jsonl"}).err, "1 tried"));
    EXPECT_TRUE(fs::exists(scratch / "a.txt"));
}

TEST_F(LoadedFiles, JobsOfABatchPrintToFilesOfTheirOwn) {
    const std::string row =
        "{\"input\": \"square.fl\", \"output\": \"N.svg\", \"options\": \"--print TO\"}\n";
    const auto job = [&](const std::string& name, const std::string& to) {
        std::string one = row;
        one.replace(one.find("N.svg"), 1, name);
        return one.replace(one.find("TO"), 2, to);
    };
    write_file(scratch / "jobs.jsonl", job("a", "-"));
    EXPECT_TRUE(has(ran({"batch", "jobs.jsonl"}, 2).err, "a job of a batch has no output but its files"));
    write_file(scratch / "jobs.jsonl", job("a", "said") + job("b", "said"));
    EXPECT_TRUE(has(ran({"batch", "jobs.jsonl", "-j1"}, 2).err, "said is written by another job"));
    write_file(scratch / "jobs.jsonl", job("a", "b.svg") + job("b", "said"));
    EXPECT_TRUE(has(ran({"batch", "jobs.jsonl", "-j1"}, 2).err, "has a file of that name"));
}

TEST_F(LoadedFiles, AreWatched) {
    Background watching({kPopupc, "build", "--watch", "-q", "part.fl", "-I", "lib", "-o", "part.json"},
                        options);
    const auto comes = [&](double wanted) {
        return eventually(
            [&] { return fs::exists(scratch / "part.json") && std::abs(width("part.json") - wanted) < 0.1; });
    };
    EXPECT_TRUE(comes(25.4));
    write_file(scratch / "lib/size.fl", "define size() 2 done");
    EXPECT_TRUE(comes(50.8));
    // Also what a program has loaded that then fails.
    write_file(scratch / "lib/size.fl", "define size() from (\"nowhere\") 1 done done");
    EXPECT_TRUE(eventually([&] { return has(watching.err(), "flatlang-runtime"); }));
    write_file(scratch / "lib/size.fl", "define size() 3 done");
    EXPECT_TRUE(comes(76.2));
    // And what comes to be in a folder that is looked into before.
    write_file(scratch / "size.fl", "define size() 4 done");
    EXPECT_TRUE(comes(101.6));
    watching.send(SIGTERM);
    EXPECT_EQ(watching.wait(), 0) << watching.err();
}

TEST_F(LoadedFiles, AreNoFindingsOfACheckThoughTheyDrawNothing) {
    write_file(scratch / "part.fl", "load(\"lib/size.fl\") repeat (4) forward(size()) left(90) done");
    fs::remove(scratch / "square.fl");
    write_file(scratch / "all.fl", "load(\"lib/size.fl\")");
    EXPECT_EQ(ran({"check", ".", "-q"}).err, "");
    EXPECT_EQ(ran({"check", "lib/size.fl"}).err, "");
    EXPECT_EQ(ran({"check", ".", "-q", "--sheet", "a4"}).err, "");
    EXPECT_EQ(ran({"check", "lib", "-q", "--sheet", "a4"}).err, "");
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{"-o", "x.svg"}, {"--emit", "pattern"}}) {
        std::vector<std::string> all{"build", "lib/size.fl"};
        all.insert(all.end(), words.begin(), words.end());
        const RunResult result = ran(all, 1);
        EXPECT_TRUE(has(result.err, "lib/size.fl: error: the program defines functions and draws nothing"))
            << result.err;
        EXPECT_EQ(result.out, "");
    }
    // What draws, but closes nothing, is one.
    write_file(scratch / "lib/size.fl", "forward(1)");
    EXPECT_TRUE(has(ran({"check", "lib"}, 1).err, "[flatlang-no-parts]"));
}

TEST_F(Programs, AreNotMended) {
    const RunResult named = ran({"fix", "square.fl"}, 2);
    EXPECT_TRUE(has(named.err, "square.fl: fix mends popup documents, and this is a program")) << named.err;
    EXPECT_FALSE(has(named.err, "size 1.0")) << "it is not run";
    options.input = kSquare;
    EXPECT_TRUE(has(ran({"fix", "-", "--from", "flatlang"}, 2).err, "this is a program"));
    // In directories they are passed over.
    fs::copy_file(fs::path(POPUP_SOURCE_DIR) / "samples/bird.xml", scratch / "bird.xml");
    const RunResult walked = ran({"fix", "--diff", "."});
    EXPECT_EQ(walked.out + walked.err, "");
    fs::remove(scratch / "bird.xml");
    EXPECT_TRUE(has(ran({"fix", "--diff", "."}).err, "designs are .xml files;"));
    EXPECT_TRUE(has(ran({"check", ".", "--exclude", "*.fl"}, 1).err, "--exclude leave nothing"));
}

}  // namespace
}  // namespace popup::test
