// Manifests and results that no program writes: what is said of them, and that the run goes on.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "batch/manifest.h"
#include "popup/diagnostics.h"
#include "popup/files.h"
#include "support/run_program.h"

namespace popup::test {
namespace {

// The first error, as "line: message".
std::string refusal(ManifestForm form, const std::string& text) {
    Diagnostics diagnostics("jobs");
    if (read_manifest(Source{"jobs", text}, form, diagnostics)) return "nothing";
    const Diagnostic first = diagnostics.sorted().front();
    EXPECT_EQ(first.code, "bad-manifest");
    return std::to_string(first.place.line) + ": " + first.message;
}

TEST(StrangeManifests, ANumberThatNothingHoldsIsToldAtItsLine) {
    const std::string row = "{\"input\": \"a.xml\", \"output\": \"a.svg\"}\n";
    EXPECT_EQ(refusal(ManifestForm::json_lines, row + "{\"copies\": 1e329}\n"),
              "2: the line has a number that is too large");
}

// It ends a row, where a line feed does not follow it, too: what stands behind it is not lost.
TEST(StrangeManifests, NothingStandsBehindACarriageReturn) {
    const std::string said = "2: the row has a carriage return in its middle";
    for (const std::string rest : {"b.xml", "b.xml,b.svg", "b.xml,b.svg\n", "\"b\"\r\n"})
        EXPECT_EQ(refusal(ManifestForm::csv, "input,output\na.xml,a.svg\r" + rest), said) << rest;
    EXPECT_EQ(refusal(ManifestForm::csv, "input,output\na.xml,a.svg\r\n"), "nothing");
    EXPECT_EQ(refusal(ManifestForm::csv, "input,output\na.xml\rb.svg\n"), said) << "two rows are not one";
}

TEST(StrangeManifests, AColumnWithALineBreakIsToldOnOneLine) {
    const std::string said = refusal(ManifestForm::csv, "input,\"out\nput\"\na.xml,a.svg\n");
    EXPECT_NE(said.find("\"out put\""), std::string::npos) << said;
    EXPECT_EQ(said.find('\n'), std::string::npos) << said;
}

// Results of a job that failed are told again; what is no finding among them is passed over.
TEST(StrangeResults, AFindingWithoutAWordForItsSeverityIsPassedOver) {
    const ScratchDirectory scratch;
    write_file(scratch / "a.xml", "<popup version=\"2.0\"><nonsense</popup>\n");
    write_file(scratch / "jobs.jsonl", "{\"input\": \"a.xml\", \"output\": \"a.svg\"}\n");
    RunOptions here;
    here.directory = scratch.path();
    EXPECT_EQ(popupc({"batch", "jobs.jsonl"}, here).exit, 1);
    std::string results = read_file(scratch / "jobs.results.jsonl");
    const std::string error = "\"severity\":\"error\"";
    const std::size_t at = results.find(error);
    ASSERT_NE(at, std::string::npos) << results;
    results.replace(at, error.size(), "\"severity\":1");
    write_file(scratch / "jobs.results.jsonl", results);
    const RunResult again = popupc({"batch", "jobs.jsonl"}, here);
    EXPECT_EQ(again.exit, 1) << again.err;
    EXPECT_EQ(again.err.find("died"), std::string::npos) << again.err;
}

}  // namespace
}  // namespace popup::test
