// The makefile and the ninja file of the samples, with the real programs: a change of one file builds what
// depends on it, once, and nothing else.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "support/run_program.h"

namespace popup::test {
namespace {

namespace fs = std::filesystem;

const fs::path kSamples = fs::path(POPUP_SOURCE_DIR) / "samples";

using Names = std::multiset<std::string>;

// The inputs of all runs of popupc that a tool says it has begun.
Names built(const std::string& output) {
    Names names;
    std::istringstream words(output);
    for (std::string word, before; words >> word; before = word) {
        if (before == "build") names.insert(word);
    }
    return names;
}

// A scratch copy of the samples with a few of the cards and the drawing.
class SampleBuild : public testing::Test {
 protected:
    SampleBuild() {
        for (const char* name : {"Makefile", "build.ninja", "bird.xml", "boat.xml", "house.xml", "parts.svg",
                                 "card-cutter.toml"}) {
            fs::copy_file(kSamples / name, scratch / name);
        }
        options.directory = scratch.path();
        options.environment["PATH"] = fs::path(kPopupc).parent_path().string() + ":/usr/bin:/bin";
        options.environment["MAKEFLAGS"] = "";
    }
    // What the tool built. It must have succeeded.
    Names run_tool(const std::vector<std::string>& words) {
        const RunResult result = run(words, options);
        EXPECT_EQ(result.exit, 0) << result.out << result.err;
        EXPECT_EQ(result.err, "") << "make counts its tokens, and says so when one is lost";
        return built(result.out);
    }
    void touch(const std::string& name) const {
        fs::last_write_time(scratch / name, fs::file_time_type::clock::now());
    }
    ScratchDirectory scratch;
    RunOptions options;
};

class SamplesWithMake : public SampleBuild {
 protected:
    void SetUp() override {
        if (!have_program("make")) GTEST_SKIP() << "make is not installed";
    }
    Names make(std::vector<std::string> words = {}) {
        words.insert(words.begin(), {"make", "-j8", "FLAGS=-q --profile card-cutter.toml --sheet a3"});
        return run_tool(words);
    }
    const Names all{"bird.xml", "boat.xml", "house.xml", "parts.svg"};
};

TEST_F(SamplesWithMake, AChangeBuildsWhatDependsOnItOnce) {
    EXPECT_EQ(make(), all);
    EXPECT_EQ(make(), Names());
    touch("boat.xml");
    EXPECT_EQ(make(), Names{"boat.xml"});
    EXPECT_EQ(make(), Names());
    touch("card-cutter.toml");
    EXPECT_EQ(make(), all);
    EXPECT_EQ(make(), Names());
    touch("bird.xml");
    EXPECT_EQ(make({"out/boat.pdf", "out/bird.glb"}), Names{"bird.xml"});
    EXPECT_EQ(make(), Names());
}

TEST_F(SamplesWithMake, ALostOutputIsBuiltAgain) {
    make();
    fs::remove(scratch / "out/house.glb");
    EXPECT_EQ(make(), Names{"house.xml"});
    EXPECT_EQ(make(), Names());
}

TEST_F(SamplesWithMake, AFailedBuildIsTriedAgainAndAnInputMayGo) {
    make();
    const std::string boat = read_file(scratch / "boat.xml");
    write_file(scratch / "boat.xml", "<popup");
    EXPECT_EQ(run({"make", "-k", "-j8"}, options).exit, 2);
    write_file(scratch / "boat.xml", boat);
    EXPECT_EQ(make(), Names{"boat.xml"});
    // -MP: a rule for what is not there any more.
    fs::remove(scratch / "card-cutter.toml");
    const RunResult other = run({"make", "-j8", "FLAGS=-q --profile silhouette --sheet a3"}, options);
    EXPECT_EQ(other.exit, 0) << other.err;
    EXPECT_EQ(built(other.out), all);
    fs::remove(scratch / "boat.xml");
    EXPECT_EQ(run({"make", "-q"}, options).exit, 0);
}

// What the manual says of --if-changed: a stamp stands for the run.
TEST_F(SamplesWithMake, AStampMakesIfChangedWork) {
    write_file(scratch / "GNUmakefile",
               "all: out/bird.count\n"
               "out/%.stamp: %.xml\n\t@mkdir -p out\n\t+popupc build $< -o out/$*.glb --if-changed -MD -MF "
               "out/$*.d -MT $@\n"
               "\t@touch $@\n"
               "out/%.glb: out/%.stamp ;\n"
               "out/%.count: out/%.glb\n\t@wc -c < $< > $@\n\t@echo build count\n"
               ".SECONDARY:\n-include $(wildcard out/*.d)\n");
    EXPECT_EQ(run_tool({"make", "-j8"}), (Names{"bird.xml", "count"}));
    EXPECT_EQ(run_tool({"make", "-j8"}), Names());
    const std::string bird = read_file(scratch / "bird.xml");
    write_file(scratch / "bird.xml", bird + "\n<!-- nothing new -->\n");
    EXPECT_EQ(run_tool({"make", "-j8"}), Names{"bird.xml"}) << "what it makes is the same";
    EXPECT_EQ(run_tool({"make", "-j8"}), Names());
    fs::copy_file(scratch / "boat.xml", scratch / "bird.xml", fs::copy_options::overwrite_existing);
    EXPECT_EQ(run_tool({"make", "-j8"}), (Names{"bird.xml", "count"}));
    EXPECT_EQ(run_tool({"make", "-j8"}), Names());
}

// The several outputs of an explicit rule: make 4.3's grouped targets.
TEST_F(SamplesWithMake, GroupedTargetsAreBuiltByOneRun) {
    write_file(scratch / "GNUmakefile",
               "all: out/run.svg out/run.glb out/run.json\n"
               "out/run.svg out/run.glb out/run.json &: bird.xml boat.xml\n\t@mkdir -p out\n"
               "\t+popupc build -q bird.xml boat.xml --sheet a2 -o out/run.svg -o out/run.glb -o "
               "out/run.json -MD -MP\n"
               "-include out/run.d\n");
    EXPECT_EQ(run_tool({"make", "-j8"}), Names{"-q"});
    EXPECT_EQ(run_tool({"make", "-j8"}), Names());
    touch("boat.xml");
    EXPECT_EQ(run_tool({"make", "-j8"}), Names{"-q"});
    EXPECT_EQ(run_tool({"make", "-j8"}), Names());
}

class SamplesWithNinja : public SampleBuild {
 protected:
    void SetUp() override {
        if (!have_program("ninja")) GTEST_SKIP() << "ninja is not installed";
        std::string text = read_file(scratch / "build.ninja");
        const std::string flags = "\nflags =\n";
        ASSERT_NE(text.find(flags), std::string::npos);
        text.replace(text.find(flags), flags.size(), "\nflags = --profile card-cutter.toml --sheet a3\n");
        write_file(scratch / "build.ninja", text);
    }
    Names ninja(std::vector<std::string> words = {"out/bird.glb", "out/boat.pdf", "out/house.pdf",
                                                  "out/parts.pdf"}) {
        words.insert(words.begin(), {"ninja", "-v", "-j8"});
        return run_tool(words);
    }
    const Names all{"bird.xml", "boat.xml", "house.xml", "parts.svg"};
};

TEST_F(SamplesWithNinja, AChangeBuildsWhatDependsOnItOnce) {
    EXPECT_EQ(ninja(), all);
    EXPECT_EQ(ninja(), Names());
    touch("boat.xml");
    EXPECT_EQ(ninja(), Names{"boat.xml"});
    EXPECT_EQ(ninja(), Names());
    touch("card-cutter.toml");
    EXPECT_EQ(ninja(), all);
    EXPECT_EQ(ninja(), Names());
    fs::remove(scratch / "out/house.glb");
    EXPECT_EQ(ninja(), Names{"house.xml"});
    EXPECT_EQ(ninja(), Names());
}

TEST_F(SamplesWithNinja, WhatComesOutTheSameBuildsNothingElse) {
    write_file(scratch / "build.ninja", read_file(scratch / "build.ninja") +
                                            "rule count\n  command = wc -c < $in > $out && : build count\n"
                                            "build out/bird.count: count out/bird.glb\n");
    const std::vector<std::string> goal{"out/bird.count"};
    EXPECT_EQ(ninja(goal), (Names{"bird.xml", "count"}));
    EXPECT_EQ(ninja(goal), Names());
    write_file(scratch / "bird.xml", read_file(scratch / "bird.xml") + "\n<!-- nothing new -->\n");
    EXPECT_EQ(ninja(goal), Names{"bird.xml"});
    EXPECT_EQ(ninja(goal), Names());
    fs::copy_file(scratch / "boat.xml", scratch / "bird.xml", fs::copy_options::overwrite_existing);
    EXPECT_EQ(ninja(goal), (Names{"bird.xml", "count"}));
    EXPECT_EQ(ninja(goal), Names());
}

TEST(SampleNinjaFile, NamesEverySample) {
    const std::string text = read_file(kSamples / "build.ninja");
    std::size_t seen = 0;
    for (const auto& entry : fs::directory_iterator(kSamples)) {
        const std::string stem = entry.path().stem();
        std::string line;
        const std::string suffix = entry.path().extension();
        if (suffix == ".xml" || suffix == ".fl")
            line = "build out/" + stem + ".pdf out/" + stem + ".glb: card " + stem + suffix + "\n";
        if (suffix == ".svg") line = "build out/" + stem + ".pdf: drawing " + stem + ".svg\n";
        if (line.empty()) continue;
        ++seen;
        EXPECT_NE(text.find(line), std::string::npos) << line;
    }
    for (const auto& entry : fs::directory_iterator(kSamples / "flatlang")) {
        if (entry.path().extension() != ".fl") continue;
        const std::string stem = "flatlang/" + entry.path().stem().string();
        const std::string line = "build out/" + stem + ".pdf out/" + stem + ".glb: card " + stem + ".fl\n";
        EXPECT_NE(text.find(line), std::string::npos) << line;
    }
    EXPECT_GT(seen, 10U);
}

}  // namespace
}  // namespace popup::test
