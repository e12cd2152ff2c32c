// The files of batches: what manifests say, and what records of results give back.
#include <gtest/gtest.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/system/digest.h"
#include "batch/manifest.h"
#include "batch/results.h"
#include "support/run_program.h"

namespace popup::test {
namespace {

std::optional<Manifest> manifest_of(const std::string& name, const std::string& text,
                                    Diagnostics& diagnostics) {
    return read_manifest(Source{name, text}, std::nullopt, diagnostics);
}

TEST(Digest, IsWhatFips180SaysOfItsExamples) {
    EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
}

TEST(Manifest, BothFormsSayTheSame) {
    Diagnostics diagnostics("jobs");
    const auto lines = manifest_of("jobs.jsonl",
                                   "{\"input\": [\"a b.xml\", \"c.xml\"], \"output\": \"x,y.svg\", "
                                   "\"options\": \"--sheet a4 --scale '0.5'\", \"copies\": 3}\n"
                                   "\n{\"input\": \"d.xml\", \"output\": [\"d.svg\", \"d.pdf\"]}\n",
                                   diagnostics);
    const auto table = manifest_of("jobs.csv",
                                   "input,input,output,output,options,copies\r\n"
                                   "a b.xml,c.xml,\"x,y.svg\",,--sheet a4 --scale '0.5',3\r\n"
                                   "\r\nd.xml,,d.svg,d.pdf,,\r\n",
                                   diagnostics);
    ASSERT_TRUE(lines && table) << diagnostics.sorted().front().message;
    ASSERT_EQ(lines->size(), 2U);
    ASSERT_EQ(table->size(), 2U);
    for (const Manifest* one : {&*lines, &*table}) {
        const BatchJob job = one->job(0);
        EXPECT_EQ(job.inputs, (std::vector<std::string>{"a b.xml", "c.xml"}));
        EXPECT_EQ(job.outputs, (std::vector<std::string>{"x,y.svg"}));
        EXPECT_EQ(job.options, (std::vector<std::string>{"--sheet", "a4", "--scale", "0.5"}));
        EXPECT_EQ(job.copies, 3);
        EXPECT_EQ(one->job(1).outputs.size(), 2U);
        EXPECT_FALSE(one->job(1).copies);
    }
    EXPECT_EQ(job_key(lines->job(0)), job_key(table->job(0)));
    EXPECT_NE(job_key(lines->job(0)), job_key(lines->job(1)));
    EXPECT_EQ(lines->place(1).line, 3);
    EXPECT_EQ(table->place(1).line, 4);
}

// Two inputs, two outputs and two words make three pairs, which a list of JSON could take for an object.
TEST(Manifest, JobsWithPairsOfEverythingHaveKeysToo) {
    BatchJob pairs;
    pairs.inputs = {"a.xml", "b.xml"};
    pairs.outputs = {"ab.svg", "ab.json"};
    pairs.options = {"--sheet", "a3"};
    BatchJob others = pairs;
    others.options = {"--sheet", "a4"};
    EXPECT_EQ(job_key(pairs).size(), job_key({}).size());
    EXPECT_NE(job_key(pairs), job_key(others));
}

TEST(Manifest, AFieldMayGoOnOverLines) {
    Diagnostics diagnostics("jobs.csv");
    const auto manifest = manifest_of(
        "jobs.csv", "input,output,options\na.xml,\"a\nb.svg\",\"--sheet\na4\"\nc.xml,c.svg,\n", diagnostics);
    ASSERT_TRUE(manifest);
    EXPECT_EQ(manifest->job(0).outputs.front(), "a\nb.svg");
    EXPECT_EQ(manifest->job(0).options, (std::vector<std::string>{"--sheet", "a4"}));
    EXPECT_EQ(manifest->job(1).inputs.front(), "c.xml");
    EXPECT_EQ(manifest->place(1).line, 5);
}

// What is wrong with a manifest, as "line:column: message".
std::string complaint(const std::string& name, const std::string& text) {
    Diagnostics diagnostics(name);
    EXPECT_FALSE(manifest_of(name, text, diagnostics)) << text;
    if (!diagnostics.has_errors()) return "nothing";
    const Diagnostic first = diagnostics.sorted().front();
    EXPECT_EQ(first.code, "bad-manifest");
    return std::to_string(first.place.line) + ":" + std::to_string(first.place.column) + ": " + first.message;
}

TEST(Manifest, WhatIsNoJobIsToldAtItsPlace) {
    const std::string good = "{\"input\": \"a.xml\", \"output\": \"a.svg\"}\n";
    EXPECT_EQ(complaint("m.jsonl", good + "{\"input\": \"b.xml\"}"), "2:1: the job has no \"output\"");
    EXPECT_EQ(complaint("m.jsonl", good + "{\"output\": \"b.svg\"}"), "2:1: the job has no \"input\"");
    EXPECT_EQ(complaint("m.jsonl", "{\"input\": \"ä\", oops}"), "1:16: the line is not JSON");
    EXPECT_EQ(complaint("m.jsonl", good + "{\"inputs\": \"b.xml\"}"), "2:1: there is no key \"inputs\"");
    EXPECT_EQ(complaint("m.jsonl", "{\"input\": \"a\", \"output\": \"b.svg\", \"copies\": 0}"),
              "1:1: \"copies\" takes a whole number from 1 to 10000");
    EXPECT_EQ(complaint("m.jsonl", "{\"input\": \"a\", \"output\": []}"),
              "1:1: \"output\" takes the name of a file or a list of names");
    EXPECT_EQ(complaint("m.jsonl", "{\"input\": \"a\", \"output\": \"b.svg\", \"options\": \"'open\"}"),
              "1:1: \"options\" takes a list of words, or one string of words whose quotes are closed");
    EXPECT_EQ(complaint("m.jsonl", "\n\n"), "0:0: the manifest has no job");
    EXPECT_EQ(complaint("m.jsonl", good + "{\"input\": \"b.xml\", \"output\": \"./a.svg\"}"),
              "2:1: \"a.svg\" is written by two jobs");
    EXPECT_EQ(complaint("m.jsonl", good + "{\"input\": \"a.svg\", \"output\": \"b.svg\"}"),
              "2:1: \"a.svg\" is written by another job of this batch");
    EXPECT_EQ(complaint("m.jsonl", "{\"input\": \"a.xml\", \"output\": \"x/../a.xml\"}"),
              "1:1: \"a.xml\" is an input and an output of this job");
    EXPECT_EQ(complaint("m.jsonl", "{\"input\": \"a.xml\", \"output\": \"a\\u0000.svg\"}"),
              "1:1: \"output\" takes the name of a file or a list of names");
    EXPECT_EQ(complaint("m.csv", "input;output\na.xml;b.svg\n"),
              "1:1: the columns are not separated by commas");
    EXPECT_EQ(complaint("m.csv", "input,out\na,b"), "1:1: there is no column \"out\"");
    EXPECT_EQ(complaint("m.csv", "input,output\na.xml,b.svg,c\n"),
              "2:1: the row has 3 fields, and there are 2 columns");
    EXPECT_EQ(complaint("m.csv", "input,output\na.xml,\"b.svg\n"), "2:1: the row's quotes do not pair");
    EXPECT_EQ(complaint("m.csv", "input,output,copies\na.xml,b.svg,two\n"),
              "2:1: \"copies\" takes a whole number from 1 to 10000");
    EXPECT_EQ(complaint("m.csv", "input,output\na\xff.xml,b.svg\n"), "2:1: the row is not UTF-8");
}

// However a file is called: by its whole name, or through a link to its directory, there yet or not.
TEST(Manifest, OneFileByTwoNamesIsWrittenByTwoJobs) {
    const ScratchDirectory scratch;
    std::filesystem::create_directories(scratch / "real");
    std::filesystem::create_directory_symlink("real", scratch / "link");
    const std::string whole = scratch.path().string();
    const auto row = [](const std::string& output) {
        return "{\"input\": \"a.xml\", \"output\": \"" + output + "\"}\n";
    };
    EXPECT_EQ(complaint("m.jsonl", row(whole + "/real/x.svg") + row(whole + "/link/x.svg")),
              "2:1: \"" + whole + "/link/x.svg\" is written by two jobs");
    EXPECT_EQ(
        complaint("m.jsonl", row("not-there/x.svg") +
                                 row(std::filesystem::current_path().string() + "/not-there/x.svg")),
        "2:1: \"" + std::filesystem::current_path().string() + "/not-there/x.svg\" is written by two jobs");
    Diagnostics diagnostics("m.jsonl");
    EXPECT_TRUE(manifest_of("m.jsonl", row(whole + "/real/x.svg") + row(whole + "/link/y.svg"), diagnostics));
    EXPECT_EQ(file_number(whole + "/real/x.svg"), file_number(whole + "/link/../link/x.svg"));
}

TEST(Results, ALineReadsBackAndATornOneIsPassedOver) {
    const ScratchDirectory scratch;
    JobResult result;
    result.key = std::string(32, 'a');
    result.command = std::string(64, 'b');
    result.inputs = {{"a.xml", 3, sha256("abc")}, {"popupc.toml", 0, ""}};
    result.warnings = 1;
    result.diagnostics = R"([{"code":"x"}])";
    const std::string line = to_line(result);
    ASSERT_TRUE(result_of(line));
    EXPECT_EQ(to_line(*result_of(line)), line);
    for (std::size_t cut = 0; cut + 1 < line.size(); cut += 7) {
        write_file(scratch / "r.jsonl", line + line.substr(0, cut) + "\n");
        Diagnostics trouble;
        ResultIndex index;
        ASSERT_TRUE(index.add(scratch / "r.jsonl", trouble));
        ASSERT_EQ(index.of(result.key).size(), 1U) << cut;
        EXPECT_EQ(to_line(index.of(result.key).front()), line);
    }
}

TEST(Results, ALineWhoseCountsAreNoCountsIsNone) {
    JobResult result;
    result.inputs = {{"a.xml", 3, sha256("abc")}};
    const std::string line = to_line(result);
    ASSERT_TRUE(result_of(line));
    for (const char* count : {"\"bytes\":3", "\"errors\":0", "\"warnings\":0"}) {
        const std::size_t end = line.find(count) + std::string_view(count).size();
        for (const char* other : {"-3.3", "-1", "1e300", "\"0\""}) {
            std::string wrong = line;
            wrong.replace(end - 1, 1, other);
            EXPECT_FALSE(result_of(wrong)) << wrong;
        }
    }
}

}  // namespace
}  // namespace popup::test
