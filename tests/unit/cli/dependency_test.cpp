// Dependency files: what they say, and that make and ninja read in them the names that were meant.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "support/random.h"
#include "support/run_program.h"

namespace popup::test {
namespace {

namespace fs = std::filesystem;

const fs::path kSource = POPUP_SOURCE_DIR;

// A scratch directory with two cards and a profile, where popupc is run.
class Dependencies : public testing::Test {
 protected:
    Dependencies() {
        fs::copy_file(kSource / "samples/bird.xml", scratch / "bird.xml");
        fs::copy_file(kSource / "samples/boat.xml", scratch / "boat.xml");
        fs::copy_file(kSource / "samples/card-cutter.toml", scratch / "cutter.toml");
        options.directory = scratch.path();
    }
    // What `name` holds after a build that must succeed.
    std::string built(std::vector<std::string> arguments, const std::string& name) {
        arguments.insert(arguments.begin(), {"build", "-q"});
        const RunResult result = popupc(arguments, options);
        EXPECT_EQ(result.exit, 0) << result.err;
        EXPECT_EQ(result.err, "");
        return read_file(scratch / name);
    }
    ScratchDirectory scratch;
    RunOptions options;
};

TEST_F(Dependencies, AFileStandsBesideTheFirstOutput) {
    fs::create_directory(scratch / "out.d");
    EXPECT_EQ(built({"bird.xml", "-o", "out.d/a.b.pdf", "-o", "x.glb", "-MD"}, "out.d/a.b.d"),
              "out.d/a.b.pdf x.glb: bird.xml\n");
    EXPECT_EQ(built({"bird.xml", "--to", "svg", "-o", "out.d/a", "-MD"}, "out.d/a.d"), "out.d/a: bird.xml\n");
    EXPECT_EQ(built({"bird.xml", "--to", "svg", "-o", ".a", "-MD"}, ".a.d"), ".a: bird.xml\n");
}

TEST_F(Dependencies, EveryInputAndEverySheetIsNamedOnce) {
    EXPECT_EQ(built({"bird.xml", "boat.xml", "bird.xml", "--sheet", "letter", "--copies", "2", "--profile",
                     "cutter.toml", "-o", "c.svg", "-o", "c.json", "-MD"},
                    "c.d")
                  .substr(0, 24),
              "c.svg c-2.svg c-3.svg c-");
    const std::string text = read_file(scratch / "c.d");
    EXPECT_NE(text.find(" c.json: bird.xml boat.xml cutter.toml\n"), std::string::npos) << text;
    std::istringstream words(text.substr(0, text.find(':')));
    for (std::string word; words >> word;) {
        if (word == "\\") continue;
        EXPECT_TRUE(fs::exists(scratch / word)) << word;
    }
}

TEST_F(Dependencies, LongRulesAreFolded) {
    std::vector<std::string> words{"bird.xml", "-o", "c.json", "-MD"};
    for (int i = 0; i < 20; ++i) words.push_back("-MTcard-number-" + std::to_string(i) + ".svg");
    std::istringstream lines(built(words, "c.d"));
    int count = 0;
    for (std::string line; std::getline(lines, line); ++count) EXPECT_LE(line.size(), 100U);
    EXPECT_GT(count, 2);
}

TEST_F(Dependencies, TargetsFilesAndPhonyRulesAreAsWithGcc) {
    EXPECT_EQ(
        built({"bird.xml", "-MD", "-MF", "x.dep", "-MT", "one", "-MTtwo words", "-o", "b.svg"}, "x.dep"),
        "one two\\ words: bird.xml\n");
    EXPECT_EQ(built({"-MFy.dep", "-MD", "-MP", "bird.xml", "boat.xml", "-o", "b.json"}, "y.dep"),
              "b.json: bird.xml boat.xml\n\nbird.xml boat.xml:\n");
    EXPECT_EQ(built({"-MF=z.dep", "-MD", "bird.xml", "-o", "b.json"}, "=z.dep"), "b.json: bird.xml\n");
    const RunResult standard = popupc({"build", "bird.xml", "-MD", "-MF", "-", "-o", "b.json"}, options);
    EXPECT_EQ(standard.out, "b.json: bird.xml\n");
}

TEST_F(Dependencies, StandardInputIsNoFileToDependOn) {
    options.input = read_file(scratch / "bird.xml");
    EXPECT_EQ(built({"-", "--profile", "cutter.toml", "-o", "b.svg", "-MD"}, "b.d"), "b.svg: cutter.toml\n");
    EXPECT_EQ(built({"-", "-o", "b.svg", "-MD"}, "b.d"), "");
}

TEST_F(Dependencies, AsJsonTheyNameTheSame) {
    const auto json = nlohmann::json::parse(built({"bird.xml", "--profile", "cutter.toml", "-o", "b.svg",
                                                   "-o", "b.json", "-MD", "--deps-format", "json"},
                                                  "b.d.json"));
    EXPECT_EQ(json,
              (nlohmann::json{{"inputs", {"bird.xml", "cutter.toml"}}, {"outputs", {"b.svg", "b.json"}}}));
    const std::string odd = "a;b|c\n\t\"&'\\";
    fs::copy_file(scratch / "bird.xml", scratch / odd);
    const auto other = nlohmann::json::parse(
        built({odd, "--from", "xml", "-o", "b.json", "-MD", "--deps-format", "json", "-MF", "o"}, "o"));
    EXPECT_EQ(other["inputs"], nlohmann::json::array({odd}));
}

TEST_F(Dependencies, PicturesAreInputs) {
    fs::copy_file(kSource / "samples/harbour.xml", scratch / "harbour.xml");
    fs::copy(kSource / "samples/pictures", scratch / "pictures");
    const std::string rule =
        built({"harbour.xml", "bird.xml", "-o", "b.svg", "-MD", "-MT", "all", "-MF", "b.d"}, "b.d");
    EXPECT_EQ(rule, "all: harbour.xml bird.xml pictures/water.jpg pictures/sea.png\n");
    const RunResult result = popupc({"build", "harbour.xml", "-o", "pictures/sea.png"}, options);
    EXPECT_EQ(result.exit, 2) << "it is not written over";
    EXPECT_NE(result.err.find("pictures/sea.png is read by an input of this run"), std::string::npos)
        << result.err;
}

TEST_F(Dependencies, AFailedBuildKeepsTheOldRuleAndTellsItsInputsAsJson) {
    write_file(scratch / "b.d", "as it was");
    write_file(scratch / "bad.xml", "<popup");
    for (const auto& [input, exit] : {std::pair("bad.xml", 1), std::pair("missing.xml", 2)}) {
        EXPECT_EQ(popupc({"build", "bird.xml", input, "-o", "b.svg", "-MD"}, options).exit, exit);
        EXPECT_EQ(read_file(scratch / "b.d"), "as it was");
        EXPECT_EQ(
            popupc({"build", "bird.xml", input, "-o", "b.svg", "-MD", "--deps-format", "json"}, options).exit,
            exit);
        const auto json = nlohmann::json::parse(read_file(scratch / "b.d.json"));
        EXPECT_EQ(json["inputs"], (nlohmann::json{"bird.xml", input}));
        EXPECT_TRUE(json["outputs"].is_null());
        EXPECT_FALSE(fs::exists(scratch / "b.svg"));
    }
    EXPECT_EQ(
        popupc({"build", "bird.xml", "--profile", "no.toml", "-o", "b.svg", "-MD", "--deps-format", "json"},
               options)
            .exit,
        2);
    EXPECT_EQ(nlohmann::json::parse(read_file(scratch / "b.d.json"))["inputs"],
              (nlohmann::json{"bird.xml", "no.toml"}));
}

TEST_F(Dependencies, RuleAndOutputsAreWrittenTogetherOrNotAtAll) {
    EXPECT_EQ(popupc({"build", "bird.xml", "-o", "b.svg", "-MD", "-MF", "nowhere/b.d"}, options).exit, 2);
    EXPECT_EQ(popupc({"build", "bird.xml", "-o", "nowhere/b.svg", "-MD", "-MF", "b.d"}, options).exit, 2);
    EXPECT_EQ(popupc({"build", "bird.xml", "--to", "svg", "-o", "a;b", "-MD"}, options).exit, 2);
    EXPECT_EQ(scratch.names(), (std::vector<std::string>{"bird.xml", "boat.xml", "cutter.toml"}));
}

TEST_F(Dependencies, AFileThatCannotBeWrittenIsToldOnce) {
    const RunResult result =
        popupc({"build", "bird.xml", "-o", "b.svg", "-MD", "--deps-format", "json", "-MF", "nowhere/b.json"},
               options);
    EXPECT_EQ(result.exit, 2);
    EXPECT_EQ(result.err,
              "popupc: error: nowhere/b.json cannot be written: directory nowhere: no such file or directory "
              "[unwritable-output]\n");
}

TEST_F(Dependencies, WrongUsageIsRefusedAndNothingIsWritten) {
    const std::vector<std::pair<std::vector<std::string>, std::string>> cases{
        {{"-o", "a.svg", "-MF", "x"}, "-MF says how a dependency file is to be, and none is asked for"},
        {{"-o", "a.svg", "-MT", "x"}, "-MT says how"},
        {{"-o", "a.svg", "-MP"}, "-MP says how"},
        {{"-o", "a.svg", "--deps-format", "make"}, "--deps-format says how"},
        {{"-o", "a.svg", "-MD", "--deps-format", "yaml"}, "--deps-format takes make, json, not \"yaml\""},
        {{"-o", "a.svg", "-MD", "--deps-format", "json", "-MP"}, "-MP is about rules, which JSON has not"},
        {{"-o", "a.svg", "-MD", "-MF"}, "-MF takes the name of a file"},
        {{"-o", "a.svg", "-MD", "-MF", ""}, "-MF takes the name of a file"},
        {{"-o", "a.svg", "-MD", "-MT"}, "-MT takes the name of a target"},
        {{"-o", "-", "--to", "svg", "-MD"}, "-o - goes to standard output"},
        {{"-o", "a.svg", "-o", "/dev/stdout", "--to", "svg", "-MD", "-MF", "x"},
         "-o /dev/stdout goes to standard output"},
        {{"--emit", "design", "-MD"}, "--emit goes to standard output"},
        {{"-o", "a.svg", "-MD", "-MF", "-", "--message-format", "json"},
         "standard output has more than one user"},
        {{"-o", "a.svg", "-MD", "-MF", "bird.xml"}, "bird.xml is an input"},
        {{"-o", "a.svg", "-MD", "-MF", "./a.svg"}, "a.svg and ./a.svg are the same output"},
        {{"-o", "a.svg", "--profile", "cutter.toml", "-MD", "-MF", "cutter.toml"},
         "overwrite cutter.toml, the profile"},
        {{"-o", "a.svg", "-MX"}, "there is no option"},
    };
    for (const auto& [words, message] : cases) {
        std::vector<std::string> arguments{"build", "bird.xml"};
        arguments.insert(arguments.end(), words.begin(), words.end());
        const RunResult result = popupc(arguments, options);
        EXPECT_EQ(result.exit, 2) << message;
        EXPECT_NE(result.err.find(message), std::string::npos) << message << "\n" << result.err;
    }
    const RunResult check = popupc({"check", "bird.xml", "-MD"}, options);
    EXPECT_NE(check.err.find("there is no option -MD"), std::string::npos) << check.err;
    EXPECT_EQ(scratch.names(), (std::vector<std::string>{"bird.xml", "boat.xml", "cutter.toml"}));
}

TEST_F(Dependencies, IfChangedKeepsTheTimesOfOutputsAndRenewsTheRule) {
    const std::vector<std::string> words{"bird.xml", "-o", "b.svg", "-o", "b.glb", "-MD", "--if-changed"};
    built(words, "b.d");
    const auto old = fs::file_time_type::clock::now() - std::chrono::hours(1);
    for (const char* name : {"b.svg", "b.glb", "b.d"}) fs::last_write_time(scratch / name, old);
    built(words, "b.d");
    EXPECT_EQ(fs::last_write_time(scratch / "b.svg"), old);
    EXPECT_EQ(fs::last_write_time(scratch / "b.glb"), old);
    EXPECT_GT(fs::last_write_time(scratch / "b.d"), old);
}

// Names that are hard to write in a makefile: each mark at the beginning, in the middle and at the end, some
// words that mean something, and random mixtures.
std::vector<std::string> hard_names() {
    std::vector<std::string> names{
        "a b",      "a  b",        "$(x)",   "$$",        "a$",      "a#b#",  "a\\ b",
        "a\\\\ b",  "a\\#b",       "a\\:b",  "a\\b\\c",   "a: b",    "a :b",  "include",
        "export",   "define",      ".PHONY", ".SUFFIXES", "a=b",     "=b",    "a+=b",
        "a[b]",     "a[1]",        "a*b?c",  "a%b",       "%",       "a\\%b", "card (copy)",
        "x(y)",     "(x)",         "~root",  "a~",        "-n",      "@a",    "\xc3\xa9t\xc3\xa9",
        "a\tb",     "Anna's card", "\"a\"",  "a&",        "C:\\a b", "a\nb",  "a\rb",
        "\xff\xfe", "a, b",        "{a,b}",  "a!b",       "..a",     "a\\"};
    for (const char mark : std::string("!\"#$%&'()*+,:;<=>?@[\\]^`{|}~ ")) {
        names.push_back(std::string(1, mark) + "z");
        names.push_back(std::string("z") + mark + "z");
        names.push_back(std::string("z") + mark);
    }
    Random random(7);
    for (int i = 0; i < 15; ++i) {
        std::string name = "q";
        const std::size_t length = 3 + random.below(6);
        for (std::size_t k = 0; k < length; ++k)
            name += std::string("ab #$:\\[]%=*(){}'~,")[random.below(19)];
        names.push_back(name);
    }
    std::sort(names.begin(), names.end());
    names.erase(std::unique(names.begin(), names.end()), names.end());
    return names;
}

// Every name is read back by make as it was, and by ninja where nothing warns of it; or it is refused.
TEST_F(Dependencies, MakeAndNinjaReadTheVeryNames) {
    if (!have_program("make") || !have_program("ninja")) GTEST_SKIP() << "make or ninja is not installed";
    // What wildcards would match.
    for (const char* name : {"a", "b", "a1", "azb", "zz", "a b", "zzz"}) write_file(scratch / name, "");
    const std::string card = read_file(scratch / "bird.xml");
    const auto past = fs::file_time_type::clock::now() - std::chrono::hours(3);
    write_file(scratch / "GNUmakefile", "all:\ninclude x.d\n%: ; @echo made\n");
    std::map<std::string, std::size_t> told{{"read", 0}, {"not by ninja", 0}, {"refused", 0}};
    std::string ninja = "rule r\n  command = cp $from $to && touch $out\n  depfile = $to\n  deps = gcc\n";
    std::map<std::string, std::string> in_ninja;  // by the output that stands for it
    for (const std::string& name : hard_names()) {
        SCOPED_TRACE(name);
        const std::string target = "o" + name;
        write_file(scratch / name, card);
        fs::last_write_time(scratch / name, past);
        const std::string here =
            "./" + name;  // not taken for an option or a response file; the name in the file is the plain one
        const bool option = name.starts_with('-') || name.starts_with('@');
        const RunResult result = popupc({"build", "--from", "xml", "--to", "svg", "-o", target, "-MD", "-MF",
                                         "x.d", "-MP", "--", option ? here : name},
                                        options);
        if (result.exit != 0) {
            ++told["refused"];
            EXPECT_EQ(result.exit, 2);
            EXPECT_NE(result.err.find("x.d cannot be written: "), std::string::npos) << result.err;
            EXPECT_NE(result.err.find("--deps-format json"), std::string::npos) << result.err;
            continue;
        }
        const std::vector<std::string> make{"make", "-r", "-q", "--", target};
        fs::last_write_time(scratch / target, past + std::chrono::hours(1));
        const RunResult before = run(make, options);
        EXPECT_EQ(before.exit, 0) << before.out << before.err << read_file(scratch / "x.d");
        fs::last_write_time(scratch / name, past + std::chrono::hours(2));
        const RunResult after = run(make, options);
        EXPECT_EQ(after.exit, 1) << after.out << after.err << read_file(scratch / "x.d");
        EXPECT_EQ(before.err + after.err, "");
        if (result.err.find("[dependency-name]") != std::string::npos) {
            ++told["not by ninja"];
            continue;
        }
        EXPECT_EQ(result.err, "");
        ++told["read"];
        const std::string number = std::to_string(in_ninja.size());
        fs::copy_file(scratch / "x.d", scratch / ("from" + number));
        ninja += "build t" + number + ": r\n  from = from" + number + "\n  to = to" + number + "\n";
        in_ninja["t" + number] = option ? here : name;
    }
    write_file(scratch / "build.ninja", ninja);
    const RunResult made = run({"ninja"}, options);
    ASSERT_EQ(made.exit, 0) << made.out;
    std::map<std::string, std::string> read;
    std::istringstream lines(run({"ninja", "-t", "deps"}, options).out);
    std::string output;
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("    ")) {
            read[output] += (read[output].empty() ? "" : "\n") + line.substr(4);
        } else if (!line.empty()) {
            output = line.substr(0, line.find(':'));
        }
    }
    // Ninja makes "./-n" plain.
    for (auto& [key, name] : in_ninja) {
        if (name.starts_with("./")) name = name.substr(2);
    }
    EXPECT_EQ(read, in_ninja);
    EXPECT_GT(told["read"], 50U);
    EXPECT_GT(told["not by ninja"], 10U);
    EXPECT_GT(told["refused"], 10U);
}

}  // namespace
}  // namespace popup::test
