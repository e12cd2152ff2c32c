// Batches: what a run makes, what a rerun does, and what is left when any part is killed at any moment.
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <set>
#include <sstream>
#include <thread>

#include "support/background.h"
#include "support/pictures.h"
#include "support/run_program.h"
#include "support/sanitized.h"

namespace popup::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

std::string card(int width, int height) {
    return "<popup version=\"2.0\" units=\"mm\"><mainpage width=\"200\" height=\"140\"/><structurelist>\n"
           "<structure type=\"step\" id=\"box\"><outerpoints><point x=\"-" +
           std::to_string(width) + "\" y=\"" + std::to_string(height) + "\"/><point x=\"-" +
           std::to_string(width) + "\" y=\"-" + std::to_string(height) + "\"/><point x=\"" +
           std::to_string(width) + "\" y=\"" + std::to_string(height) + "\"/><point x=\"" +
           std::to_string(width) + "\" y=\"-" + std::to_string(height) +
           "\"/></outerpoints><parentfold><begin x=\"0\" y=\"-70\"/><end x=\"0\" y=\"70\"/></parentfold>"
           "</structure></structurelist></popup>\n";
}

// A manifest of `count` cards with their outputs in out/, and the cards.
void make_library(const fs::path& directory, int count) {
    fs::create_directories(directory / "designs");
    std::ofstream manifest(directory / "jobs.jsonl");
    for (int i = 0; i < count; ++i) {
        const std::string name = "card" + std::to_string(i);
        write_file(directory / ("designs/" + name + ".xml"), card(15 + i % 23, 20 + i / 23 % 31));
        manifest << R"({"input": "designs/)" << name << R"(.xml", "output": ["out/)" << name << R"(.svg"]})"
                 << "\n";
    }
}

std::map<std::string, std::string> files_below(const fs::path& directory) {
    std::map<std::string, std::string> files;
    if (!fs::exists(directory)) return files;
    for (const auto& entry : fs::recursive_directory_iterator(directory)) {
        if (entry.is_regular_file()) files[fs::relative(entry.path(), directory)] = read_file(entry.path());
    }
    return files;
}

// The names of the files that only one of them has, or that differ.
std::set<std::string> differing(const std::map<std::string, std::string>& a,
                                const std::map<std::string, std::string>& b) {
    std::set<std::string> names;
    for (const auto* one : {&a, &b}) {
        const auto& other = one == &a ? b : a;
        for (const auto& [name, bytes] : *one) {
            const auto at = other.find(name);
            if (at == other.end() || at->second != bytes) names.insert(name);
        }
    }
    return names;
}

std::vector<json> lines_of(const fs::path& path) {
    std::vector<json> lines;
    std::istringstream text(read_file(path));
    for (std::string line; std::getline(text, line);) lines.push_back(json::parse(line));
    return lines;
}

RunResult batch(const fs::path& directory, std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "batch");
    RunOptions options;
    options.directory = directory;
    return popupc(arguments, options);
}

TEST(Batch, MakesWhatSingleBuildsMake) {
    const ScratchDirectory scratch;
    make_library(scratch.path(), 6);
    write_file(scratch / "more.csv",
               "input,output,options,copies\ndesigns/card1.xml,deep/er/two.svg,--sheet a3 --rotate any,2\n");
    ASSERT_EQ(batch(scratch.path(), {"jobs.jsonl", "-j2", "--", "--sheet", "a4"}).exit, 0);
    ASSERT_EQ(batch(scratch.path(), {"more.csv"}).exit, 0);
    RunOptions here;
    here.directory = scratch.path();
    for (int i = 0; i < 6; ++i) {
        const std::string name = "card" + std::to_string(i);
        ASSERT_EQ(popupc({"build", "designs/" + name + ".xml", "--sheet", "a4", "-o", "one.svg"}, here).exit,
                  0);
        EXPECT_EQ(read_file(scratch / ("out/" + name + ".svg")), read_file(scratch / "one.svg"));
    }
    ASSERT_EQ(popupc({"build", "designs/card1.xml", "--sheet", "a3", "--rotate", "any", "--copies", "2", "-o",
                      "two.svg"},
                     here)
                  .exit,
              0);
    EXPECT_EQ(read_file(scratch / "deep/er/two.svg"), read_file(scratch / "two.svg"));
}

TEST(Batch, GoesOnPastFailuresAndSaysWhatBecameOfEachJob) {
    const ScratchDirectory scratch;
    make_library(scratch.path(), 5);
    write_file(scratch / "designs/card1.xml", "<popup><broken");
    fs::remove(scratch / "designs/card2.xml");
    write_file(
        scratch / "jobs.jsonl",
        read_file(scratch / "jobs.jsonl") +
            "{\"input\": \"designs/card0.xml\", \"output\": \"x.svg\", \"options\": [\"--shet\", \"a4\"]}\n");
    const RunResult first = batch(scratch.path(), {"jobs.jsonl"});
    EXPECT_EQ(first.exit, 2);
    EXPECT_NE(first.err.find("designs/card1.xml:1:"), std::string::npos) << first.err;
    EXPECT_NE(first.err.find("jobs.jsonl:6:1: error: there is no option --shet [bad-job]"), std::string::npos)
        << first.err;
    EXPECT_NE(first.err.find(" s: 3 done, 1 failed, 2 unusable; 6 tried"), std::string::npos) << first.err;
    std::vector<std::string> states;
    for (const json& line : lines_of(scratch / "jobs.results.jsonl")) states.push_back(line["status"]);
    EXPECT_EQ(states, (std::vector<std::string>{"done", "failed", "unusable", "done", "done", "unusable"}));

    // What is wrong stays wrong, and is told again; what can be done now is.
    write_file(scratch / "designs/card2.xml", card(20, 30));
    const RunResult second = batch(scratch.path(), {"jobs.jsonl"});
    EXPECT_EQ(second.exit, 2);
    EXPECT_NE(second.err.find("designs/card1.xml:1:"), std::string::npos) << second.err;
    EXPECT_NE(second.err.find(" s: 4 done, 1 failed, 1 unusable; 4 as they were; 2 tried"), std::string::npos)
        << second.err;
}

// The names of the outputs that a run wrote anew.
std::set<std::string> rebuilt(const fs::path& directory, const std::vector<std::string>& arguments) {
    for (const auto& entry : fs::directory_iterator(directory / "out")) {
        fs::last_write_time(entry.path(), fs::file_time_type::clock::now() - std::chrono::hours(48));
    }
    EXPECT_EQ(batch(directory, arguments).exit, 0);
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(directory / "out")) {
        if (entry.last_write_time() > fs::file_time_type::clock::now() - std::chrono::hours(24)) {
            names.insert(entry.path().stem());
        }
    }
    return names;
}

TEST(Batch, ARerunDoesWhatIsMissingOrStaleAndNothingElse) {
    const ScratchDirectory scratch;
    make_library(scratch.path(), 6);
    write_file(scratch / "fold.toml", "base = \"workshop\"\n");
    const std::vector<std::string> plain{"jobs.jsonl", "-j2"};
    ASSERT_EQ(batch(scratch.path(), plain).exit, 0);
    const auto first = files_below(scratch.path());
    using Names = std::set<std::string>;
    EXPECT_EQ(rebuilt(scratch.path(), plain), Names{});
    EXPECT_EQ(differing(files_below(scratch.path()), first), Names{});

    fs::last_write_time(scratch / "designs/card0.xml", fs::file_time_type::clock::now());
    write_file(scratch / "designs/card1.xml", card(33, 44));  // other content
    fs::remove(scratch / "out/card2.svg");                    // missing
    write_file(scratch / "out/card3.svg", "scribbled over");  // not what was written
    EXPECT_EQ(rebuilt(scratch.path(), plain), (Names{"card1", "card2", "card3"}));

    // A row more changes nothing for the others, wherever it stands.
    write_file(scratch / "jobs.jsonl", "{\"input\": \"designs/card0.xml\", \"output\": \"out/new.svg\"}\n" +
                                           read_file(scratch / "jobs.jsonl"));
    EXPECT_EQ(rebuilt(scratch.path(), plain), Names{"new"});
    EXPECT_EQ(lines_of(scratch / "jobs.results.jsonl").size(), 7U);

    // Other options: everything; then the profile's own file counts as an input.
    EXPECT_EQ(rebuilt(scratch.path(), {"jobs.jsonl", "--", "--profile", "fold.toml"}).size(), 7U);
    EXPECT_EQ(rebuilt(scratch.path(), {"jobs.jsonl", "--", "--profile", "fold.toml"}), Names{});
    write_file(scratch / "fold.toml", "base = \"workshop\"\nfolds = \"score\"\n");
    EXPECT_EQ(rebuilt(scratch.path(), {"jobs.jsonl", "--", "--profile", "fold.toml"}).size(), 7U);
}

TEST(Batch, AnOutlineThatIsTracedAgainIsStale) {
    const ScratchDirectory scratch;
    make_library(scratch.path(), 2);
    RunOptions there;
    there.directory = scratch.path();
    const auto trace = [&](int height) {
        write_file(scratch / "shape.png", png_of(60, height));
        const RunResult traced =
            popupc({"trace", "shape.png", "--threshold", "128", "--width", "60mm", "-o", "designs/shape.svg"},
                   there);
        EXPECT_EQ(traced.exit, 0) << traced.err;
    };
    trace(40);
    write_file(scratch / "designs/card1.xml",
               "<popup version='3.0' units='mm'><mainpage width='170' height='130'/><structurelist>"
               "<structure type='hole'><outline href='shape.svg' x='10' y='-30'/></structure>"
               "</structurelist></popup>");
    const std::vector<std::string> plain{"jobs.jsonl"};
    ASSERT_EQ(batch(scratch.path(), plain).exit, 0);
    using Names = std::set<std::string>;
    trace(40);  // the same again
    EXPECT_EQ(rebuilt(scratch.path(), plain), Names{});
    trace(20);
    EXPECT_EQ(rebuilt(scratch.path(), plain), Names{"card1"});
}

TEST(Batch, WhereSettingsComeFromIsPartOfAJob) {
    const ScratchDirectory scratch;
    make_library(scratch.path(), 3);
    RunOptions here;
    here.directory = scratch.path();
    here.environment["POPUPC_NO_CONFIG"] = "";
    const auto built = [&] {
        const RunResult result = popupc({"batch", "jobs.jsonl"}, here);
        EXPECT_EQ(result.exit, 0) << result.err;
        // "popupc: 3 jobs in 0.1 s: 3 done; 2 as they were; 1 tried, 20.1 a second"
        const std::size_t at = result.err.find(" tried");
        return at == std::string::npos ? 0 : std::stoi(result.err.substr(result.err.rfind(' ', at - 1) + 1));
    };
    EXPECT_EQ(built(), 3);
    EXPECT_EQ(built(), 0);
    const std::string plain = read_file(scratch / "out/card0.svg");
    write_file(scratch / "designs/popupc.toml", "sheet = 'a3'\n");  // comes to be
    EXPECT_EQ(built(), 3);
    EXPECT_NE(read_file(scratch / "out/card0.svg"), plain);
    EXPECT_EQ(built(), 0);
    write_file(scratch / "designs/popupc.toml", "sheet = 'a4'\n");  // says something else
    EXPECT_EQ(built(), 3);
    here.environment["POPUPC_SHEET"] = "a2";
    EXPECT_EQ(built(), 3);
    here.environment.erase("POPUPC_SHEET");
    fs::remove(scratch / "designs/popupc.toml");
    EXPECT_EQ(built(), 3);
    EXPECT_EQ(read_file(scratch / "out/card0.svg"), plain);
}

// Names of further sheets and dependency files are known only when they are written.
TEST(Batch, NoJobWritesOverWhatOthersHave) {
    const ScratchDirectory scratch;
    make_library(scratch.path(), 3);
    const auto row = [](const std::string& input, const std::string& output, const std::string& options) {
        return json{{"input", input}, {"output", output}, {"options", options}}.dump() + "\n";
    };
    const std::string two_sheets = "--copies 2 --sheet 215x155";
    const std::string design = read_file(scratch / "designs/card1.xml");
    const auto refused = [&](const std::string& manifest, const std::string& part) {
        write_file(scratch / "m.jsonl", manifest);
        const RunResult result = batch(scratch.path(), {"m.jsonl", "-j1"});
        EXPECT_EQ(result.exit, 2) << result.err;
        EXPECT_NE(result.err.find(part), std::string::npos) << result.err;
        EXPECT_EQ(read_file(scratch / "m.jsonl"), manifest);
        EXPECT_EQ(read_file(scratch / "designs/card1.xml"), design);
        fs::remove(scratch / "m.results.jsonl");
    };
    refused(row("designs/card0.xml", "a.svg", two_sheets) + row("designs/card1.xml", "a-2.svg", ""),
            "a-2.svg would be written, and the job of line 2 has a file of that name");
    refused(row("designs/card0.xml", "a.svg", "-MD -MF m.jsonl"),
            "this job would overwrite m.jsonl, the manifest");
    refused(row("designs/card0.xml", "a.svg", "-MD -MF designs/card1.xml") +
                row("designs/card1.xml", "b.svg", ""),
            "this job would overwrite designs/card1.xml, an input of the batch");
    refused(row("designs/card0.xml", "a.svg", "-MD") + row("designs/card1.xml", "a.pdf", "-MD"),
            "a.d is written by another job, too");
    refused(row("designs/card0.xml", "a.svg b.svg", ""), "\"a.svg b.svg\" looks like several names");
    // Names count from the manifest's directory, wherever the run begins.
    fs::create_directories(scratch / "jobs");
    write_file(scratch / "jobs/m.jsonl", row("../designs/card0.xml", "a.svg", "-MD -MF b.svg") +
                                             row("../designs/card1.xml", "b.svg", ""));
    const RunResult below = batch(scratch.path(), {"jobs/m.jsonl", "-j1"});
    EXPECT_EQ(below.exit, 2);
    EXPECT_NE(below.err.find("b.svg would be written, and the job of line 2 has a file of that name"),
              std::string::npos)
        << below.err;
    refused(row("designs/card0.xml", "a.svg", "-MD -MF -"), "is no file that a job could write");
    // A single build does not write further sheets over its inputs, either.
    RunOptions here;
    here.directory = scratch.path();
    fs::copy_file(scratch / "designs/card0.xml", scratch / "in-2.svg");
    const RunResult single = popupc(
        {"build", "in-2.svg", "--from", "xml", "--copies", "2", "--sheet", "215x155", "-o", "in.svg"}, here);
    EXPECT_EQ(single.exit, 2);
    EXPECT_NE(single.err.find("in-2.svg is an input, and a further sheet would be written over it"),
              std::string::npos)
        << single.err;
    EXPECT_EQ(read_file(scratch / "in-2.svg"), read_file(scratch / "designs/card0.xml"));
}

TEST(Batch, ADryRunPrintsTheRowsThatAreDueAndDoesNothing) {
    const ScratchDirectory scratch;
    make_library(scratch.path(), 4);
    ASSERT_EQ(batch(scratch.path(), {"jobs.jsonl"}).exit, 0);
    fs::remove(scratch / "out/card2.svg");
    const auto before = files_below(scratch.path());
    const RunResult dry = batch(scratch.path(), {"jobs.jsonl", "--dry-run"});
    EXPECT_EQ(dry.exit, 0);
    EXPECT_EQ(dry.out, "{\"input\": \"designs/card2.xml\", \"output\": [\"out/card2.svg\"]}\n");
    EXPECT_EQ(differing(files_below(scratch.path()), before), std::set<std::string>());
}

TEST(Batch, TakesNoResultsThatAreNoneAndNoTaskThatHasNoNumber) {
    const ScratchDirectory scratch;
    make_library(scratch.path(), 2);
    RunOptions here;
    here.directory = scratch.path();
    ASSERT_EQ(popupc({"batch", "jobs.jsonl"}, here).exit, 0);
    const RunResult other = popupc({"merge-reports", "jobs.jsonl", "designs/card1.xml"}, here);
    EXPECT_EQ(other.exit, 2);
    EXPECT_NE(other.err.find("card1.xml holds no results of a batch"), std::string::npos) << other.err;
    // What was cut off is the beginning of a result.
    write_file(scratch / "jobs.results.1-of-3.jsonl", "{\"ke");
    EXPECT_EQ(popupc({"merge-reports", "jobs.jsonl"}, here).exit, 0);
    for (const char* name : {"SLURM_ARRAY_TASK_ID", "SLURM_ARRAY_TASK_COUNT"}) {
        here.environment = {{"SLURM_ARRAY_TASK_ID", "1"}, {"SLURM_ARRAY_TASK_COUNT", "3"}};
        here.environment[name] = "2x";
        const RunResult task = popupc({"batch", "jobs.jsonl"}, here);
        EXPECT_EQ(task.exit, 2);
        EXPECT_NE(task.err.find(std::string(name) + " is \"2x\""), std::string::npos) << task.err;
    }
}

TEST(Batch, ShardsTogetherDoAllOnceAndMergeToOneReport) {
    const ScratchDirectory scratch;
    const ScratchDirectory whole;
    make_library(scratch.path(), 10);
    make_library(whole.path(), 10);
    ASSERT_EQ(batch(whole.path(), {"jobs.jsonl"}).exit, 0);
    RunOptions here;
    here.directory = scratch.path();

    ASSERT_EQ(batch(scratch.path(), {"jobs.jsonl", "--shard", "1/3"}).exit, 0);
    // As a task of a Slurm job array that counts from 0 in steps of 2.
    here.environment = {{"SLURM_ARRAY_TASK_ID", "4"},
                        {"SLURM_ARRAY_TASK_COUNT", "3"},
                        {"SLURM_ARRAY_TASK_MIN", "0"},
                        {"SLURM_ARRAY_TASK_STEP", "2"}};
    ASSERT_EQ(popupc({"batch", "jobs.jsonl"}, here).exit, 0);
    here.environment.clear();
    EXPECT_EQ(lines_of(scratch / "jobs.results.1-of-3.jsonl").size(), 4U);
    EXPECT_EQ(lines_of(scratch / "jobs.results.3-of-3.jsonl").size(), 3U);

    const RunResult part =
        popupc({"merge-reports", "jobs.jsonl", "-o", "report.json", "--missing", "again.jsonl"}, here);
    EXPECT_EQ(part.exit, 1);
    EXPECT_NE(part.err.find("jobs.jsonl:2:1: error: designs/card1.xml has not been built [job-missing]"),
              std::string::npos)
        << part.err;
    EXPECT_NE(part.err.find("popupc: 10 jobs: 7 done, 3 missing"), std::string::npos) << part.err;
    const json report = json::parse(read_file(scratch / "report.json"));
    EXPECT_EQ(report["done"], 7);
    EXPECT_EQ(report["missing"], 3);
    EXPECT_EQ(report["results"].size(), 10U);
    EXPECT_EQ(report["results"][1]["state"], "missing");
    EXPECT_EQ(lines_of(scratch / "again.jsonl").size(), 3U);

    // With another number of shards nothing that is done is done again.
    ASSERT_EQ(rebuilt(scratch.path(), {"jobs.jsonl", "--shard", "1/1"}),
              (std::set<std::string>{"card1", "card4", "card7"}));
    EXPECT_EQ(popupc({"merge-reports", "jobs.jsonl", "-o", "report.json"}, here).exit, 0);
    EXPECT_EQ(differing(files_below(scratch / "out"), files_below(whole / "out")), std::set<std::string>());
    EXPECT_EQ(read_file(scratch / "jobs.results.jsonl"), read_file(whole / "jobs.results.jsonl"));

    // A byte that is another: as long as before, and not as it was.
    std::string damaged = read_file(scratch / "out/card5.svg");
    damaged.back() = ' ';
    write_file(scratch / "out/card5.svg", damaged);
    EXPECT_EQ(popupc({"merge-reports", "jobs.jsonl"}, here).exit, 1);
    fs::remove(scratch / "out/card5.svg");
    EXPECT_EQ(popupc({"merge-reports", "jobs.jsonl"}, here).exit, 1);
    ASSERT_EQ(batch(scratch.path(), {"jobs.jsonl"}).exit, 0);

    // The newest run counts: one that failed in shards, and then one that finds all as it was.
    EXPECT_EQ(batch(scratch.path(), {"jobs.jsonl", "--shard", "2/2", "--", "--sheet", "10x10"}).exit, 1);
    EXPECT_EQ(popupc({"merge-reports", "jobs.jsonl"}, here).exit, 1);
    ASSERT_EQ(batch(scratch.path(), {"jobs.jsonl"}).exit, 0);
    EXPECT_EQ(popupc({"merge-reports", "jobs.jsonl"}, here).exit, 0);
    for (const std::vector<std::string>& words :
         std::vector<std::vector<std::string>>{{"-o", "designs/card1.xml"},
                                               {"-o", "jobs.results.jsonl"},
                                               {"--missing", "jobs.jsonl"},
                                               {"--missing", "out/again.jsonl"}}) {
        std::vector<std::string> line{"merge-reports", "jobs.jsonl"};
        line.insert(line.end(), words.begin(), words.end());
        EXPECT_EQ(popupc(line, here).exit, 2) << words.back();
    }
}

// Neither shard sees what the other writes; who joins their results does.
TEST(Batch, ShardsThatWriteOneFileAreToldWhenTheyAreMerged) {
    const ScratchDirectory scratch;
    make_library(scratch.path(), 2);
    write_file(scratch / "m.jsonl",
               "{\"input\": \"designs/card0.xml\", \"output\": \"a.svg\"}\n"
               "{\"input\": \"designs/card0.xml\", \"output\": \"a.pdf\"}\n");
    for (const char* shard : {"1/2", "2/2"})
        ASSERT_EQ(batch(scratch.path(), {"m.jsonl", "--shard", shard, "--", "-MD"}).exit, 0);
    RunOptions here;
    here.directory = scratch.path();
    const RunResult merged = popupc({"merge-reports", "m.jsonl"}, here);
    EXPECT_EQ(merged.exit, 1);
    EXPECT_NE(merged.err.find("m.jsonl:2:1: error: a.d is written by another job, too"), std::string::npos)
        << merged.err;
}

TEST(Batch, WhatFailedIsToldWithItsFirstError) {
    const ScratchDirectory scratch;
    make_library(scratch.path(), 1);
    write_file(scratch / "m.jsonl",
               "{\"input\": \"designs/card0.xml\", \"output\": \"a.svg\", \"options\": \"--sheeet a4\"}\n");
    EXPECT_EQ(batch(scratch.path(), {"m.jsonl"}).exit, 2);
    RunOptions here;
    here.directory = scratch.path();
    const RunResult merged = popupc({"merge-reports", "m.jsonl"}, here);
    EXPECT_EQ(merged.exit, 1);
    EXPECT_NE(merged.err.find("designs/card0.xml was not built: there is no option --sheeet"),
              std::string::npos)
        << merged.err;
}

TEST(Batch, TheInputThatFailedIsNamed) {
    const ScratchDirectory scratch;
    make_library(scratch.path(), 1);
    write_file(scratch / "designs/broken.xml", "<popup>");
    write_file(scratch / "m.jsonl",
               "{\"input\": [\"designs/card0.xml\", \"designs/broken.xml\"], \"output\": \"a.svg\"}\n"
               "{\"input\": \"designs/broken.xml\", \"output\": \"b.svg\"}\n");
    EXPECT_EQ(batch(scratch.path(), {"m.jsonl"}).exit, 1);
    RunOptions here;
    here.directory = scratch.path();
    const RunResult merged = popupc({"merge-reports", "m.jsonl"}, here);
    EXPECT_NE(merged.err.find("designs/card0.xml was not built: designs/broken.xml: "), std::string::npos)
        << merged.err;
    EXPECT_EQ(merged.err.find("designs/broken.xml was not built: designs/broken.xml: "), std::string::npos)
        << merged.err;
}

// An option without its value takes no word that nobody has written.
TEST(Batch, OptionsOfAJobStandLast) {
    const ScratchDirectory scratch;
    make_library(scratch.path(), 1);
    write_file(scratch / "m.jsonl",
               "{\"input\": \"designs/card0.xml\", \"output\": \"a.svg\", \"options\": \"--sheet\"}\n");
    const RunResult made = batch(scratch.path(), {"m.jsonl"});
    EXPECT_EQ(made.exit, 2);
    EXPECT_EQ(made.err.find("--output=a.svg"), std::string::npos) << made.err;
}

TEST(Batch, WhatCannotBeAskedForIsWrongUsage) {
    const ScratchDirectory scratch;
    make_library(scratch.path(), 1);
    for (const std::vector<std::string>& arguments :
         std::vector<std::vector<std::string>>{{"jobs.jsonl", "--shard", "0/3"},
                                               {"jobs.jsonl", "--shard", "4/3"},
                                               {"jobs.jsonl", "--shard", "3"},
                                               {"missing.jsonl"},
                                               {"jobs.jsonl", "--", "--shet", "a4"},
                                               {"jobs.jsonl", "--", "card.xml"},
                                               {"jobs.jsonl", "--", "-o", "all.svg"},
                                               {"jobs.jsonl", "--sheet", "a4"},
                                               {"jobs.jsonl", "--results", "designs/card0.xml"},
                                               {"jobs.jsonl", "--results", "nowhere/at/all.jsonl"}}) {
        const RunResult result = batch(scratch.path(), arguments);
        EXPECT_EQ(result.exit, 2) << result.err;
        EXPECT_NE(result.err.find("error: "), std::string::npos) << result.err;
    }
    EXPECT_FALSE(fs::exists(scratch / "out"));
}

// popupc batch in the background.
class Running : public Background {
 public:
    Running(const fs::path& directory, const std::vector<std::string>& arguments)
        : Background(words(arguments), in(directory)) {}
    [[nodiscard]] std::vector<pid_t> workers() const {
        const std::string id = std::to_string(pid());
        std::istringstream list(read_file("/proc/" + id + "/task/" + id + "/children"));
        std::vector<pid_t> all;
        for (pid_t one = 0; list >> one;) all.push_back(one);
        return all;
    }

 private:
    static std::vector<std::string> words(std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), {kPopupc, "batch"});
        return arguments;
    }
    static RunOptions in(const fs::path& directory) {
        RunOptions options;
        options.directory = directory;
        return options;
    }
};

const int kDesigns = sanitized_count(1000, 16);
const int kKills = sanitized_count(220);

// Workers, the first process, or all of them are killed at random moments, the batch begun again each time;
// in between finished files are taken away, so that there is always something to do.
TEST(Batch, KillingAnyPartAtAnyMomentLosesNothingAndLeavesNothingHalfWritten) {
    const ScratchDirectory scratch;
    const ScratchDirectory whole;
    make_library(scratch.path(), kDesigns);
    make_library(whole.path(), kDesigns);
    ASSERT_EQ(batch(whole.path(), {"jobs.jsonl", "-j2"}).exit, 0);
    const auto expected = files_below(whole.path());

    std::mt19937 random(20261122);
    const auto below = [&random](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
    int kills = 0;
    int begun = 0;
    while (kills < kKills) {
        Running run(scratch.path(), {"jobs.jsonl", "-j2"});
        ++begun;
        const int before_parent = 1 + below(6);  // workers that die before the first process does
        for (int i = 0; i < before_parent && run.running(); ++i) {
            std::this_thread::sleep_for(std::chrono::microseconds(2000 + below(30000)));
            const std::vector<pid_t> workers = run.workers();
            if (workers.empty()) continue;
            ::kill(workers[static_cast<std::size_t>(below(static_cast<int>(workers.size())))], SIGKILL);
            ++kills;
        }
        if (!run.running()) {
            // All done: some of it is to be done again.
            for (int i = 0; i < kDesigns; i += 1 + below(4)) {
                fs::remove(scratch / ("out/card" + std::to_string(i) + ".svg"));
            }
            continue;
        }
        const std::vector<pid_t> workers = below(2) == 0 ? run.workers() : std::vector<pid_t>();
        run.send(SIGKILL);
        ++kills;
        for (const pid_t worker : workers) kills += ::kill(worker, SIGKILL) == 0 ? 1 : 0;
        run.wait();
        // Whatever has a name is complete.
        for (const auto& [name, bytes] : files_below(scratch / "out")) {
            if (name.starts_with(".popup-")) continue;
            ASSERT_EQ(bytes, expected.at("out/" + name)) << "after " << kills << " kills";
        }
    }
    // Workers whose parent is gone may still be at their last job.
    ASSERT_TRUE(eventually([&] { return batch(scratch.path(), {"jobs.jsonl", "-j2"}).exit == 0; }));
    std::set<std::string> others;
    eventually([&] {
        others = differing(files_below(scratch.path()), expected);
        return others.empty();
    });
    EXPECT_EQ(others, std::set<std::string>()) << "after " << kills << " kills of " << begun << " runs";
    RecordProperty("kills", kills);
    RecordProperty("runs", begun);
}

TEST(Batch, AnInterruptLetsRunningJobsEndAndTheNextRunGoesOn) {
    const ScratchDirectory scratch;
    make_library(scratch.path(), kDesigns);
    for (const int signal : {SIGINT, SIGTERM}) {
        Running run(scratch.path(), {"jobs.jsonl", "-j2"});
        while (!fs::exists(scratch / "out") && run.running())
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        run.send(signal);
        ASSERT_EQ(run.wait(), 128 + signal) << run.err();
        // What was written is known to be.
        EXPECT_EQ(lines_of(scratch / "jobs.results.jsonl").size(), files_below(scratch / "out").size());
        fs::remove_all(scratch / "out");
        fs::remove(scratch / "jobs.results.jsonl");
    }
}

TEST(Batch, OneRunAtATimeWritesAResultsFile) {
    const ScratchDirectory scratch;
    make_library(scratch.path(), kDesigns);
    Running run(scratch.path(), {"jobs.jsonl", "-j1"});
    while (!fs::exists(scratch / "out") && run.running())
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    // It does not come to its end before the other has begun, however slowly that starts.
    run.send(SIGSTOP);
    const RunResult second = batch(scratch.path(), {"jobs.jsonl"});
    run.send(SIGTERM);
    run.send(SIGCONT);
    run.wait();
    EXPECT_EQ(second.exit, 2);
    EXPECT_NE(second.err.find("another run is writing its results there"), std::string::npos) << second.err;
}

}  // namespace
}  // namespace popup::test
