// Baselines: what they accept fails nothing, until somebody touches it; and nobody's findings get lost.
#include "findings/baseline.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "support/random.h"
#include "support/run_program.h"

namespace popup::test {
namespace {

namespace fs = std::filesystem;

// A tent that is `inner` mm wide to each side, and its seams 25: narrower is a finding.
std::string tent(const std::string& id, int y, int inner) {
    return fmt::format(R"(    <structure type="tent" id="{0}"><outerpoints>
      <point x="-25" y="{1}"/> <point x="-25" y="{2}"/> <point x="25" y="{1}"/> <point x="25" y="{2}"/>
      <point x="-{3}" y="-10"/> <point x="-{3}" y="10"/> <point x="{3}" y="-10"/> <point x="{3}" y="10"/>
      </outerpoints><parentfold><begin x="0" y="-100"/><end x="0" y="100"/></parentfold></structure>
)",
                       id, y, y + 20, inner);
}

std::string card(const std::string& structures) {
    return "<popup version=\"2.0\" units=\"mm\">\n  <mainpage width=\"200\" height=\"200\"/>\n  "
           "<structurelist>\n" +
           structures + "  </structurelist>\n</popup>\n";
}

class BaselineFiles : public testing::Test {
 protected:
    void SetUp() override {
        options.directory = scratch.path();
        fs::create_directory(scratch / "designs");
        write_file(scratch / "designs/a.xml", card(tent("left", -90, 22) + tent("right", 20, 21)));
        write_file(scratch / "designs/b.xml", card(tent("alone", -90, 22)));
        write_file(scratch / "designs/good.xml", card(tent("fine", -90, 30)));
    }
    RunResult check(std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), {"check", "--baseline", "base.json"});
        return test::popupc(std::move(arguments), options);
    }
    // Accepts all findings of both designs.
    void accept_all() {
        const RunResult result = check({"designs/a.xml", "designs/b.xml", "--write-baseline"});
        ASSERT_EQ(result.exit, 0) << result.err;
    }
    [[nodiscard]] std::size_t accepted() const {
        return nlohmann::json::parse(read_file(scratch / "base.json"))["findings"].size();
    }
    ScratchDirectory scratch;
    RunOptions options;
};

TEST_F(BaselineFiles, WhatIsAcceptedFailsNothingAndIsNotTold) {
    EXPECT_EQ(check({"designs/a.xml"}).exit, 2) << "there is no baseline yet";
    const RunResult written = check({"designs/a.xml", "designs/b.xml", "--write-baseline", "-q"});
    EXPECT_EQ(written.exit, 0);
    EXPECT_EQ(written.out + written.err, "");
    EXPECT_EQ(accepted(), 3U);
    const RunResult result = check({"designs/a.xml", "designs/b.xml", "-q"});
    EXPECT_EQ(result.exit, 0);
    EXPECT_EQ(result.out + result.err, "");
    const RunResult verbose = check({"designs/a.xml", "designs/b.xml", "-v"});
    EXPECT_NE(verbose.err.find("popupc: 3 findings are accepted by base.json\n"), std::string::npos)
        << verbose.err;
    EXPECT_NE(verbose.err.find(": nothing new to report\n"), std::string::npos) << verbose.err;
    EXPECT_EQ(check({"designs/a.xml", "--werror"}).exit, 0);
    for (const std::string format : {"text", "short", "json"})
        EXPECT_EQ(check({"designs/a.xml", "--message-format", format}).out, "") << format;
    // Without it they fail as ever.
    EXPECT_EQ(test::popupc({"check", "designs/a.xml"}, options).exit, 1);
}

TEST_F(BaselineFiles, MovingLinesChangesNothing) {
    accept_all();
    std::string moved = read_file(scratch / "designs/a.xml");
    moved.insert(moved.find("  <structurelist>"), "<!-- more\n\n lines -->\n\n");
    write_file(scratch / "designs/a.xml", moved);
    EXPECT_EQ(check({"designs/a.xml"}).exit, 0);
    // The order of elements does not count either.
    write_file(scratch / "designs/a.xml", card(tent("right", 20, 21) + tent("left", -90, 22)));
    EXPECT_EQ(check({"designs/a.xml"}).exit, 0);
}

TEST_F(BaselineFiles, TouchingAnElementMakesItsFindingsNew) {
    accept_all();
    write_file(scratch / "designs/a.xml", card(tent("left", -90, 23) + tent("right", 20, 21)));
    const RunResult result = check({"designs/a.xml", "designs/b.xml", "--message-format", "json"});
    EXPECT_EQ(result.exit, 1);
    std::vector<std::string> told;
    std::string text = result.out;
    for (std::size_t end = text.find('\n'); end != std::string::npos; end = text.find('\n')) {
        const auto one = nlohmann::json::parse(text.substr(0, end));
        told.push_back(one["code"].get<std::string>() + " " + one.value("severity", ""));
        text.erase(0, end + 1);
    }
    EXPECT_EQ(told, (std::vector<std::string>{"tent-too-narrow warning", "baseline-outdated remark"}));
    // The same finding on another element is another one.
    write_file(scratch / "designs/a.xml", card(tent("other", -90, 22) + tent("right", 20, 21)));
    EXPECT_EQ(check({"designs/a.xml"}).exit, 1);
}

TEST_F(BaselineFiles, OfAFileWithANewErrorNothingIsSaidToBeGone) {
    accept_all();
    write_file(scratch / "designs/a.xml", "<popup><structurelist>");
    const RunResult result = check({"designs/a.xml"});
    EXPECT_EQ(result.exit, 1);
    EXPECT_EQ(result.err.find("baseline-outdated"), std::string::npos) << result.err;
}

TEST_F(BaselineFiles, WritingKeepsWhatAnErrorHides) {
    accept_all();
    const std::string mended = read_file(scratch / "designs/a.xml");
    const std::size_t before = accepted();
    write_file(scratch / "designs/a.xml", "<popup><structurelist>");
    const RunResult result = check({"designs/a.xml", "designs/b.xml", "--write-baseline"});
    EXPECT_EQ(result.exit, 0);
    EXPECT_NE(result.err.find("2 accepted findings of files with errors, which keep them from being looked "
                              "for, stay in base.json\n"),
              std::string::npos)
        << result.err;
    EXPECT_GT(accepted(), before) << "the error is accepted, too";
    // Nor does it take a second time to lose them.
    EXPECT_EQ(check({"designs/a.xml", "--write-baseline"}).exit, 0);
    EXPECT_EQ(check({"designs/a.xml"}).err.find("baseline-outdated"), std::string::npos);
    write_file(scratch / "designs/a.xml", mended);
    EXPECT_EQ(check({"designs/a.xml", "designs/b.xml"}).exit, 0);
    EXPECT_EQ(check({"designs/a.xml", "--write-baseline"}).exit, 0);
    EXPECT_EQ(accepted(), before) << "and the error is mended";
}

TEST_F(BaselineFiles, WhatIsMendedIsRemarkedOnAndTakenOutByWriting) {
    accept_all();
    write_file(scratch / "designs/a.xml", card(tent("left", -90, 30) + tent("right", 20, 21)));
    // Of a file that is not looked at nothing is known.
    EXPECT_EQ(check({"designs/b.xml"}).err, "");
    const RunResult result = check({"designs/a.xml"});
    EXPECT_EQ(result.exit, 0) << "a remark fails nothing";
    EXPECT_TRUE(result.err.starts_with(
        "base.json: remark: 1 finding of the baseline is no longer there [baseline-outdated]\n"))
        << result.err;
    EXPECT_EQ(check({"designs/a.xml", "--allow", "baseline-outdated"}).err, "");
    EXPECT_EQ(check({"designs/a.xml", "--deny", "baseline-outdated"}).exit, 1);
    EXPECT_EQ(check({"designs/a.xml", "--write-baseline"}).exit, 0);
    EXPECT_EQ(accepted(), 2U) << "the finding of b.xml, which was not looked at, stays";
    EXPECT_EQ(check({"designs/a.xml", "designs/b.xml", "-q"}).err, "");
    // What is gone altogether needs no entries.
    fs::remove(scratch / "designs/b.xml");
    EXPECT_EQ(check({"designs/a.xml", "--write-baseline"}).exit, 0);
    EXPECT_EQ(accepted(), 1U);
}

TEST_F(BaselineFiles, NamesFilesFromTheirOwnDirectory) {
    accept_all();
    EXPECT_NE(read_file(scratch / "base.json").find("\"designs/a.xml\""), std::string::npos);
    options.directory = scratch / "designs";
    const RunResult result =
        test::popupc({"check", "--baseline", "../base.json", "a.xml", "./b.xml"}, options);
    EXPECT_EQ(result.exit, 0) << result.err;
    options.directory = "/";
    const RunResult absolute = test::popupc(
        {"check", "--baseline", (scratch / "base.json").string(), (scratch / "designs/a.xml").string()},
        options);
    EXPECT_EQ(absolute.exit, 0) << absolute.err;
}

TEST_F(BaselineFiles, WritingAgainChangesNoByteAndLeavesTheTime) {
    accept_all();
    const std::string bytes = read_file(scratch / "base.json");
    const auto old = fs::file_time_type::clock::now() - std::chrono::hours(1);
    fs::last_write_time(scratch / "base.json", old);
    const auto kept = fs::last_write_time(scratch / "base.json");
    EXPECT_EQ(check({"designs/b.xml", "designs/a.xml", "--write-baseline", "-j", "1"}).exit, 0);
    EXPECT_EQ(read_file(scratch / "base.json"), bytes);
    EXPECT_EQ(fs::last_write_time(scratch / "base.json"), kept);
}

TEST_F(BaselineFiles, UnreadableInputsAreNeverAcceptedAndWriteNothing) {
    accept_all();
    const std::string bytes = read_file(scratch / "base.json");
    const RunResult result = check({"designs/a.xml", "designs/missing.xml", "--write-baseline"});
    EXPECT_EQ(result.exit, 2);
    EXPECT_NE(result.err.find("[unreadable-input]"), std::string::npos);
    EXPECT_EQ(read_file(scratch / "base.json"), bytes);
    EXPECT_EQ(check({"designs/missing.xml"}).exit, 2);
}

TEST_F(BaselineFiles, MalformedDesignsAreAcceptedWhereverTheirLinesAre) {
    write_file(scratch / "broken.xml", "<popup>\n");
    EXPECT_EQ(check({"broken.xml", "--write-baseline"}).exit, 0);
    write_file(scratch / "broken.xml", "\n\n<popup>\n\n");
    EXPECT_EQ(check({"broken.xml"}).exit, 0) << "the message names the line of the start tag";
}

TEST_F(BaselineFiles, FindingsOfTheSheetAreAcceptedToo) {
    const std::vector<std::string> words{"designs/good.xml", "--sheet", "60x60", "-q"};
    std::vector<std::string> writing = words;
    writing.emplace_back("--write-baseline");
    EXPECT_EQ(check(writing).exit, 0);
    EXPECT_GE(accepted(), 1U);
    EXPECT_EQ(check(words).exit, 0);
    EXPECT_EQ(test::popupc({"check", "designs/good.xml", "--sheet", "60x60"}, options).exit, 1);
}

TEST_F(BaselineFiles, HostileNamesSurvive) {
    for (const std::string name : {"a \"b\"\n.xml", "\xff\xfe.xml", "%41 \xc3\xbc.xml"}) {
        write_file(scratch / name, card(tent("left", -90, 22)));
        EXPECT_EQ(check({name, "--write-baseline"}).exit, 0);
        EXPECT_EQ(check({name}).exit, 0) << name;
        EXPECT_TRUE(nlohmann::json::accept(read_file(scratch / "base.json"))) << name;
    }
    EXPECT_EQ(accepted(), 3U);
}

TEST_F(BaselineFiles, ABrokenOneIsALocatedErrorAndIsNotOverwritten) {
    const std::string good =
        R"({"file": "a", "code": "c", "element": "", "digest": "0123456789abcdef", "count": 1})";
    const auto list = [](const std::string& entries) {
        return "{\n  \"version\": 1,\n  \"findings\": [\n" + entries + "\n  ]\n}\n";
    };
    const auto changed = [&good](const std::string& what, const std::string& with) {
        std::string text = good;
        return text.replace(text.find(what), what.size(), with);
    };
    const std::vector<std::pair<std::string, std::string>> broken{
        {"", ":1:1: error: this is not JSON"},
        {"{\n  \"version\": 1,\n<<<<<<< HEAD\n", ":3:1: error: this is not JSON"},
        {list(good + ",\n" + good + "x"), ":5:84: error: this is not JSON"},
        {list("\"\xff\""), ":4:2: error: this is not JSON"},
        {list("1e999"), ": error: a number in it is too large"},
        {"[]", ":1:1: error: this is not a baseline"},
        {"{\"version\": 1}", ":1:1: error: this is not a baseline"},
        {"{\"version\": 2, \"findings\": []}", ":1:1: error: this baseline is not of version 1"},
        {"{\"version\": 1, \"findings\": {}}", ":1:1: error: a baseline has"},
        {"{\"version\": 1, \"findings\": [], \"more\": 1}", ":1:1: error: a baseline has"},
        {list(good + ",\n 7"), ":5:2: error: a finding is an object"},
        {list(good + ",\n  " + good), ":5:3: error: the finding stands in the file twice"},
        {list(good + ",\n" + changed("\"file\"", "\"fil\"")),
         ":5:1: error: the finding has no text \"file\""},
        {list(changed("\"c\"", "3")), ":4:1: error: the finding has no text \"code\""},
        {list(changed("0123456789abcdef", "0123456789ABCDEF")), ":4:1: error: the digest is"},
        {list(changed("\"count\": 1", "\"count\": 0")), ":4:1: error: the finding has no \"count\""},
        {list(changed("\"count\": 1", "\"count\": -1")), ":4:1: error: the finding has no \"count\""},
        {list(changed("\"count\": 1", "\"count\": 1, \"why\": 2")), ":4:1: error: a finding has no \"why\""}};
    for (const auto& [text, message] : broken) {
        write_file(scratch / "base.json", text);
        for (const bool writing : {false, true}) {
            std::vector<std::string> words{"designs/a.xml", "--message-format", "short"};
            if (writing) words.emplace_back("--write-baseline");
            const RunResult result = check(words);
            EXPECT_EQ(result.exit, 2) << text;
            EXPECT_TRUE(result.err.starts_with("base.json" + message)) << text << "\n" << result.err;
            EXPECT_TRUE(result.err.ends_with("[bad-baseline]\n")) << result.err;
            EXPECT_EQ(read_file(scratch / "base.json"), text);
        }
    }
    // Depth costs no stack.
    write_file(scratch / "base.json", std::string(1000000, '['));
    EXPECT_EQ(check({"designs/a.xml"}).exit, 2);
}

TEST_F(BaselineFiles, WrongUsageIsRefused) {
    const auto refused = [this](const std::vector<std::string>& words) {
        const auto before = scratch.names();
        const RunResult result = test::popupc(words, options);
        EXPECT_EQ(result.exit, 2) << result.err;
        EXPECT_TRUE(result.err.starts_with("popupc: error: ")) << result.err;
        EXPECT_EQ(scratch.names(), before);
    };
    refused({"check", "designs/a.xml", "--write-baseline"});
    refused({"check", "designs/a.xml", "--baseline", ""});
    refused({"check", "designs/a.xml", "--baseline", "-"});
    refused({"check", "designs/a.xml", "--baseline", "x", "--write-baseline", "--diagnostics", "./x"});
    const std::string before = read_file(scratch / "designs/a.xml");
    refused({"check", "designs/a.xml", "--baseline", "./designs/a.xml", "--write-baseline"});
    refused({"check", "designs/a.xml", "--diagnostics", "designs/../designs/a.xml"});
    EXPECT_EQ(read_file(scratch / "designs/a.xml"), before);
    refused({"build", "designs/a.xml", "-o", "x.svg", "--baseline", "x"});
}

// In the program's memory.

BaselinePlaces places() { return {"/srv", "/srv"}; }

Findings findings_of(std::vector<Diagnostic> list) {
    Findings findings;
    findings.files.push_back({"a.xml", {}, true, std::move(list), {}});
    return findings;
}

Diagnostic warning(const std::string& message, int line = 1) {
    return {Severity::warning, "collision", "a.xml", {line, 1}, message, {}, "front", {}, {}};
}

Baseline accepting(const Findings& findings) {
    return baseline_of(findings, {}, places(), [](const std::string&) { return true; });
}

TEST(Baseline, AcceptsNoMoreThanThereWere) {
    const Baseline two = accepting(findings_of({warning("x", 1), warning("x", 2)}));
    ASSERT_EQ(two.size(), 1U);
    EXPECT_EQ(two.begin()->second, 2U);
    Findings three = findings_of({warning("x", 5), warning("x", 6), warning("x", 7)});
    EXPECT_EQ(accept(three, two, places()), 0U);
    EXPECT_EQ(three.accepted(), 2U);
    ASSERT_EQ(three.files[0].told.size(), 1U);
    EXPECT_EQ(three.files[0].told[0].place.line, 7);
    EXPECT_TRUE(three.fail());
    Findings one = findings_of({warning("x", 1)});
    EXPECT_EQ(accept(one, two, places()), 1U) << "one of two is gone";
    EXPECT_FALSE(one.fail());
}

TEST(Baseline, TheNumberOfALineIsNoPartOfWhatIsSaid) {
    const Baseline baseline = accepting(findings_of({warning("begun on line 12, 12 mm wide")}));
    Findings moved = findings_of({warning("begun on line 7, 12 mm wide")});
    accept(moved, baseline, places());
    EXPECT_FALSE(moved.fail());
    Findings wider = findings_of({warning("begun on line 12, 13 mm wide")});
    accept(wider, baseline, places());
    EXPECT_TRUE(wider.fail());
}

TEST(Baseline, RemarksAreToldAndNotAccepted) {
    Diagnostic remark = warning("by the way");
    remark.severity = Severity::remark;
    Findings findings = findings_of({remark});
    const Baseline baseline = accepting(findings);
    EXPECT_TRUE(baseline.empty());
    accept(findings, baseline, places());
    EXPECT_EQ(findings.files[0].told.size(), 1U);
}

TEST(Baseline, FindingsBeyondTheLimitCountAsWell) {
    const auto many = [](int count) {
        Diagnostics diagnostics("a.xml");
        for (int i = 0; i < count; ++i) diagnostics.warning("collision", {i + 1, 1}, "w");
        return collect({{&diagnostics, {}}}, Diagnostics());
    };
    const Baseline baseline = accepting(many(150));
    Findings same = many(150);
    accept(same, baseline, places());
    EXPECT_FALSE(same.fail());
    Findings more = many(151);
    accept(more, baseline, places());
    EXPECT_TRUE(more.fail());
    EXPECT_TRUE(without_remarks(more).fail()) << "--quiet does not hide it";
}

TEST(Baseline, ReadsWhatItWritesSortedAndALineEach) {
    Random random(5);
    for (int round = 0; round < 50; ++round) {
        Baseline baseline;
        for (std::size_t n = random.below(20); n > 0; --n) {
            const auto text = [&random] {
                std::string made(random.below(8), ' ');
                for (char& c : made) c = static_cast<char>(1 + random.below(126));
                return made + (random.below(2) == 0 ? "\u00fc\"\\" : "");
            };
            baseline[{text(), text(), text(), fmt::format("{:016x}", random.below(1000))}] =
                1 + random.below(9);
        }
        const std::string written = write_baseline(baseline);
        Diagnostics diagnostics("base.json");
        const auto read = read_baseline({"base.json", written}, diagnostics);
        ASSERT_TRUE(read) << written;
        EXPECT_EQ(*read, baseline);
        EXPECT_EQ(std::count(written.begin(), written.end(), '\n'),
                  static_cast<std::ptrdiff_t>(baseline.size() + (baseline.empty() ? 4 : 5)))
            << written;
    }
}

}  // namespace
}  // namespace popup::test
