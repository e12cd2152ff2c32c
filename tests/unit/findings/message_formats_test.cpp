// The formats of findings: each is valid whatever it is given, and says what others need to show it.
#include "findings/message_formats.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <tinyxml2.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "base/diagnostics/further_findings.h"
#include "base/diagnostics/render_diagnostics.h"
#include "findings/repository.h"
#include "findings/statistics.h"
#include "support/message_readers.h"
#include "support/random.h"
#include "support/run_program.h"

namespace popup::test {
namespace {

using nlohmann::json;

TEST(MessageFormats, AreNamedOnceAndFoundByName) {
    std::set<std::string_view> names;
    for (const MessageFormat& row : message_format_table()) {
        EXPECT_TRUE(names.insert(row.name).second) << row.name;
        EXPECT_EQ(find_message_format(row.name), &row);
        EXPECT_FALSE(row.about.empty());
    }
    EXPECT_EQ(names, (std::set<std::string_view>{"text", "short", "json", "sarif", "junit", "github"}));
    EXPECT_EQ(find_message_format("sari"), nullptr);
}

TEST(MessageFormats, NothingToReportIsValidInEach) {
    expect_all_valid({});
    Findings clean;
    clean.files = {told("a.xml", {}), told("b/c.xml", {})};
    expect_all_valid(clean);
    EXPECT_EQ(rendered("text", clean) + rendered("json", clean), "");
    EXPECT_EQ(rendered("github", clean), "popupc: 2 designs: nothing to report\n");
    EXPECT_TRUE(json::parse(rendered("sarif", clean))["runs"][0]["results"].is_array());
}

TEST(MessageFormats, HostileNamesAndMessagesKeepEachValid) {
    const std::vector<std::string> evil{"a\nb::error::c.xml",
                                        "::error file=x,line=1::y",
                                        "\"'<&>]]>--\\",
                                        "%0A%3A%25,:=%",
                                        std::string("\x01\x02\x1b[31m\x7f\0z", 11),
                                        "\xff\xfe\xc3(\xed\xa0\x80",
                                        "\xef\xbf\xbe\xef\xbf\xbf\xe2\x80\xae\xf0\x9f\x8f\x95",
                                        "{0} [a](b) {{x}}",
                                        "##[error]x",
                                        "../../..//etc/./x\r\n",
                                        std::string(3000, '{')};
    for (const std::string& name : evil) {
        Findings findings;
        Diagnostic one = found(Severity::error, name, {1, 1}, "collision", name);
        one.hints = evil;
        one.change = Change{name, name};
        one.related = {{{2, 3}, name}, {{}, name}};
        findings.files = {told(name, {one, found(Severity::remark, name)})};
        findings.files.front().text = name;
        findings.run = {one, found(Severity::warning, name)};
        findings.run.front().file = name;
        findings.run_accepted = {found(Severity::warning, name)};
        findings.compared = true;
        SCOPED_TRACE(visible(name));
        expect_all_valid(findings);
    }
}

TEST(MessageFormats, AnyBytesKeepEachValid) {
    Random random(11);
    const auto bytes = [&random](std::size_t most) {
        // Half of what there is are characters that mean something somewhere.
        constexpr std::string_view kMeaning = "%:,=[](){}<>&\"'\n\r\\#/.";
        std::string text(1 + random.below(most), 'x');
        for (char& c : text)
            c = random.below(2) == 0 ? kMeaning[random.below(kMeaning.size())]
                                     : static_cast<char>(1 + random.below(255));
        return text;
    };
    for (int round = 0; round < 40; ++round) {
        Findings findings;
        for (std::size_t i = random.below(4); i > 0; --i) {
            std::vector<Diagnostic> list;
            for (std::size_t n = random.below(30); n > 0; --n) {
                list.push_back(found(static_cast<Severity>(random.below(3)), bytes(30),
                                     {static_cast<int>(random.below(9)), static_cast<int>(random.below(9))},
                                     random.below(2) == 0 ? "collision" : "unreadable-input", bytes(8)));
                if (random.below(3) == 0) list.back().hint(bytes(20)).changed(bytes(9), bytes(9));
                if (random.below(3) == 0) list.back().with({3, 4}, bytes(9));
            }
            std::stable_sort(list.begin(), list.end(), [](const Diagnostic& a, const Diagnostic& b) {
                return a.severity > b.severity;
            });
            findings.files.push_back(told(bytes(20), std::move(list)));
        }
        SCOPED_TRACE(round);
        expect_all_valid(findings);
    }
}

TEST(Sarif, SaysWhatTheFindingSays) {
    Findings findings;
    Diagnostic one = found(Severity::warning, "{a} goes [so](far)", {4, 7});
    one.hint("move it").changed("(1, 2)", "(3, 4)").with({17, 5}, "\"back\"");
    findings.files = {told("two tents/ü#1.xml", {one})};
    findings.run = {found(Severity::error, "of the run", {}, "unknown-piece", "")};
    const json run = json::parse(rendered("sarif", findings))["runs"][0];
    EXPECT_EQ(sarif_trouble(json::parse(rendered("sarif", findings))), "");
    ASSERT_EQ(run["results"].size(), 1U);
    const json& result = run["results"][0];
    EXPECT_EQ(result["level"], "warning");
    EXPECT_EQ(result["message"]["text"], "{{a}} goes \\[so\\](far)\nhint: move it");
    const json& physical = result["locations"][0]["physicalLocation"];
    EXPECT_EQ(physical["artifactLocation"]["uri"], "shop/two%20tents/%C3%BC%231.xml");
    EXPECT_EQ(physical["region"], (json{{"startLine", 4}, {"startColumn", 7}}));
    EXPECT_EQ(result["locations"][0]["logicalLocations"][0]["name"], "front");
    ASSERT_EQ(result["relatedLocations"].size(), 1U);
    EXPECT_EQ(result["relatedLocations"][0]["message"]["text"], "\"back\"");
    EXPECT_EQ(result["relatedLocations"][0]["physicalLocation"]["region"]["startLine"], 17);
    EXPECT_EQ(result["properties"], (json{{"before", "(1, 2)"}, {"after", "(3, 4)"}}));
    EXPECT_FALSE(result.contains("baselineState"));
    // What has no place in a file says something of the run.
    const json& notes = run["invocations"][0]["toolExecutionNotifications"];
    ASSERT_EQ(notes.size(), 1U);
    EXPECT_EQ(notes[0]["message"]["text"], "of the run");
    EXPECT_EQ(run["invocations"][0]["executionSuccessful"], false);
    std::vector<std::string> rules;
    for (const json& rule : run["tool"]["driver"]["rules"]) rules.push_back(rule["id"]);
    EXPECT_EQ(rules, (std::vector<std::string>{"collision", "unknown-piece"}));
}

TEST(Sarif, ABaselineTellsNewFromOld) {
    Findings findings;
    findings.files = {told("a.xml", {found(Severity::warning, "new")})};
    findings.files.front().accepted = told("a.xml", {found(Severity::warning, "old")}).told;
    findings.compared = true;
    const json results = json::parse(rendered("sarif", findings))["runs"][0]["results"];
    ASSERT_EQ(results.size(), 2U);
    EXPECT_EQ(results[0]["baselineState"], "new");
    EXPECT_FALSE(results[0].contains("suppressions"));
    EXPECT_EQ(results[1]["baselineState"], "unchanged");
    EXPECT_EQ(results[1]["suppressions"][0]["kind"], "external");
}

class FormatsOfRuns : public testing::Test {
 protected:
    void SetUp() override {
        std::filesystem::create_directories(scratch / "repository/.git");
        std::filesystem::create_directories(scratch / "repository/cards/my designs");
        options.directory = scratch / "repository/cards";
        // Where the tests run on GitHub, the program must not see it.
        options.environment["GITHUB_WORKSPACE"] = "";
    }
    RunResult popupc(std::vector<std::string> arguments) {
        return test::popupc(std::move(arguments), options);
    }
    json sarif(std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), "check");
        arguments.insert(arguments.end(), {"--message-format", "sarif"});
        const RunResult result = popupc(arguments);
        EXPECT_EQ(result.err, "");
        json log = json::parse(result.out);
        EXPECT_EQ(sarif_trouble(log), "");
        EXPECT_EQ(result.out.find(scratch.path().string()), std::string::npos) << "an absolute path";
        return log["runs"][0]["results"];
    }
    ScratchDirectory scratch;
    RunOptions options;
};

std::string uri_of(const json& result) {
    return result["locations"][0]["physicalLocation"]["artifactLocation"]["uri"];
}

TEST_F(FormatsOfRuns, SarifNamesFilesAsTheRepositoryDoes) {
    write_file(scratch / "repository/cards/my designs/a.xml", camp());
    write_file(scratch / "repository/b.xml", camp());
    write_file(scratch / "outside.xml", camp());
    const json results = sarif(
        {"my designs/a.xml", "./../b.xml", (scratch / "repository/b.xml").string(), "../../outside.xml"});
    ASSERT_EQ(results.size(), 4U);
    EXPECT_EQ(uri_of(results[0]), "cards/my%20designs/a.xml");
    EXPECT_EQ(uri_of(results[1]), "b.xml");
    EXPECT_EQ(uri_of(results[2]), "b.xml");
    EXPECT_EQ(uri_of(results[3]), "../outside.xml");
    // The file is reached by another name of its directory.
    std::filesystem::create_directory_symlink(scratch / "repository", scratch / "other");
    EXPECT_EQ(uri_of(sarif({(scratch / "other/b.xml").string()})[0]), "b.xml");
    // Without a repository the working directory counts.
    std::filesystem::remove(scratch / "repository/.git");
    EXPECT_EQ(uri_of(sarif({"my designs/a.xml"})[0]), "my%20designs/a.xml");
}

TEST_F(FormatsOfRuns, SarifFingerprintsStayWhenLinesMove) {
    const auto fingerprints = [this](const std::string& document) {
        write_file(scratch / "repository/cards/a.xml", document);
        std::vector<std::string> found;
        for (const json& result : sarif({"a.xml"}))
            found.push_back(result["partialFingerprints"].begin()->get<std::string>());
        return found;
    };
    const std::vector<std::string> before = fingerprints(camp(2));
    ASSERT_EQ(before.size(), 2U);
    EXPECT_NE(before[0], before[1]);
    std::string moved = camp(2);
    moved.insert(moved.find("<structurelist>"), "<!-- one\n two\n three -->\n");
    EXPECT_EQ(fingerprints(moved), before);
    EXPECT_EQ(fingerprints(camp(2, "23")), before) << "the same trouble, of other numbers";
    EXPECT_EQ(fingerprints(camp(1)), std::vector<std::string>{before[0]});
}

TEST(Sarif, FingerprintsOfEqualFindingsAreNumbered) {
    const auto fingerprints = [](int line) {
        Findings findings;
        findings.files = {told("a.xml", {found(Severity::warning, "x", {line, 1}),
                                         found(Severity::warning, "y", {line + 1, 1}),
                                         found(Severity::warning, "z", {line + 2, 1})}),
                          told("b.xml", {found(Severity::warning, "x", {line, 1})})};
        std::vector<std::string> all;
        const json log = json::parse(rendered("sarif", findings));
        for (const json& one : log["runs"][0]["results"])
            all.push_back(one["partialFingerprints"].begin()->get<std::string>());
        return all;
    };
    const auto all = fingerprints(3);
    EXPECT_EQ(std::set<std::string>(all.begin(), all.end()).size(), 4U);
    EXPECT_EQ(fingerprints(30), all);
}

TEST_F(FormatsOfRuns, TheSchemaOfSarifAcceptsLogs) {
    if (std::getenv("POPUP_SARIF_SCHEMA") == nullptr || !have_program("node")) {
        GTEST_SKIP() << "POPUP_SARIF_SCHEMA does not say where the schema is, or there is no node";
    }
    write_file(scratch / "repository/cards/a.xml", camp(3));
    write_file(scratch / "repository/cards/b.xml", camp(1, "30"));
    write_file(scratch / "repository/cards/c.xml", "<popup>");
    const std::vector<std::vector<std::string>> runs{
        {"b.xml"},
        {"a.xml", "b.xml", "c.xml", "missing.xml"},
        {"a.xml", "b.xml", "--sheet", "60x60"},
        {"b.xml", "--lock", "nothing=1,1"},
        {"a.xml", "b.xml", "--baseline", "base.json", "--write-baseline"},
        {"a.xml", "b.xml", "c.xml", "--baseline", "base.json"}};
    std::vector<std::string> words{"node", std::string(POPUP_SOURCE_DIR) + "/tests/tools/validate_sarif.mjs"};
    for (const auto& arguments : runs) {
        std::vector<std::string> all = arguments;
        all.insert(all.begin(), "check");
        const std::string log = fmt::format("{}.sarif", words.size());
        all.insert(all.end(), {"--message-format", "sarif", "--diagnostics", log});
        popupc(all);
        words.push_back((options.directory / log).string());
    }
    Findings hostile;
    hostile.files = {told("\xff %\n", {found(Severity::error, "{0} [a](b)\x01\xff", {1, 1})})};
    write_file(scratch / "hostile.sarif", rendered("sarif", hostile));
    words.push_back((scratch / "hostile.sarif").string());
    write_file(scratch / "empty.sarif", rendered("sarif", {}));
    words.push_back((scratch / "empty.sarif").string());
    const RunResult result = run(words);
    EXPECT_EQ(result.exit, 0) << result.out << result.err;
}

TEST_F(FormatsOfRuns, JunitHasACaseADesign) {
    write_file(scratch / "repository/cards/my designs/bad.xml", camp(2));
    write_file(scratch / "repository/cards/good.xml", camp(1, "30"));
    const RunResult result =
        popupc({"check", "my designs/bad.xml", "good.xml", "missing.xml", "--message-format", "junit"});
    EXPECT_EQ(result.exit, 2);
    EXPECT_EQ(result.err, "");
    tinyxml2::XMLDocument document;
    ASSERT_EQ(document.Parse(result.out.c_str()), tinyxml2::XML_SUCCESS);
    const auto* suite = document.RootElement()->FirstChildElement("testsuite");
    const auto* bad = suite->FirstChildElement("testcase");
    EXPECT_STREQ(bad->Attribute("classname"), "my designs");
    EXPECT_STREQ(bad->Attribute("name"), "bad.xml");
    const auto* failure = bad->FirstChildElement("failure");
    ASSERT_NE(failure, nullptr);
    EXPECT_STREQ(failure->Attribute("type"), "tent-too-narrow");
    EXPECT_TRUE(std::string(failure->Attribute("message")).ends_with("(and 1 more)"));
    const std::string text = failure->GetText();
    EXPECT_NE(text.find("\"tent-0\""), std::string::npos);
    EXPECT_NE(text.find("\"tent-1\""), std::string::npos);
    EXPECT_NE(text.find("\n  hint: "), std::string::npos);
    const auto* good = bad->NextSiblingElement();
    EXPECT_STREQ(good->Attribute("name"), "good.xml");
    EXPECT_EQ(good->FirstChildElement(), nullptr);
    const auto* missing = good->NextSiblingElement();
    ASSERT_NE(missing->FirstChildElement("error"), nullptr);
    EXPECT_STREQ(missing->FirstChildElement("error")->Attribute("type"), "unreadable-input");

    if (run({"/usr/bin/python3", "-c", "import junitparser"}).exit != 0)
        GTEST_SKIP() << "Debian's python3-junitparser is not installed: it was not asked to read the report";
    write_file(scratch / "report.xml", result.out);
    const RunResult read = run({"/usr/bin/python3", "-c", R"(
import sys, junitparser
report = junitparser.JUnitXml.fromfile(sys.argv[1])
for suite in report:
    print(suite.name, suite.tests, suite.failures, suite.errors)
    for case in suite:
        print(case.classname, case.name, [(type(r).__name__, r.type) for r in case.result])
)",
                                (scratch / "report.xml").string()});
    EXPECT_EQ(read.out,
              "popupc 3 1 1\n"
              "my designs bad.xml [('Failure', 'tent-too-narrow')]\n"
              "popupc good.xml []\n"
              "popupc missing.xml [('Error', 'unreadable-input')]\n")
        << read.err;
}

// What is not shown decides a run's status, and so it is no remark to programs.
TEST(MessageFormats, FurtherFindingsAreAsSevereAsThey) {
    Findings findings;
    findings.files = {
        told("card.xml", {further_findings("unknown-markup", "card.xml", {31, Severity::warning})})};
    EXPECT_NE(rendered("junit", findings).find("failures=\"1\""), std::string::npos);
    const json run = json::parse(rendered("sarif", findings))["runs"][0];
    EXPECT_EQ(run["results"][0]["level"], "warning");
}

TEST(Junit, RemarksFailNothingAndStandInTheOutput) {
    Findings findings;
    findings.files = {told("a.xml", {found(Severity::remark, "by the way")})};
    findings.run = {found(Severity::error, "of the run", {}, "unknown-piece", "")};
    tinyxml2::XMLDocument document;
    ASSERT_EQ(document.Parse(rendered("junit", findings).c_str()), tinyxml2::XML_SUCCESS);
    const auto* suite = document.RootElement()->FirstChildElement("testsuite");
    const auto* one = suite->FirstChildElement("testcase");
    EXPECT_EQ(one->FirstChildElement("failure"), nullptr);
    ASSERT_NE(one->FirstChildElement("system-out"), nullptr);
    EXPECT_NE(std::string(one->FirstChildElement("system-out")->GetText()).find("by the way"),
              std::string::npos);
    const auto* run = one->NextSiblingElement();
    ASSERT_NE(run, nullptr);
    EXPECT_STREQ(run->Attribute("name"), "run");
    EXPECT_NE(run->FirstChildElement("failure"), nullptr);
}

TEST(GitHub, UndoingTheEscapesGivesWhatWasSaid) {
    Findings findings;
    Diagnostic one = found(Severity::error, "50% :: a,b\nc", {4, 7});
    one.hint("100%25, so");
    findings.files = {told("a,b:c%0A\n.xml", {one})};
    const Log log = parse_log(rendered("github", findings));
    ASSERT_EQ(log.annotations.size(), 1U);
    const Annotation& read = log.annotations.front();
    EXPECT_EQ(read.kind, "error");
    EXPECT_EQ(read.message, "50% :: a,b\nc\nhint: 100%25, so");
    EXPECT_EQ(read.properties,
              (std::map<std::string, std::string>{
                  {"file", "shop/a,b:c%0A\n.xml"}, {"line", "4"}, {"col", "7"}, {"title", "collision"}}));
    EXPECT_EQ(log.others, std::vector<std::string>{"popupc: 1 design: 1 error (1 collision)"});
}

TEST(GitHub, TheWorstComeFirstAndTenOfAKind) {
    Findings findings;
    for (int file = 0; file < 4; ++file) {
        std::vector<Diagnostic> list;
        for (int i = 0; i < 4; ++i) list.push_back(found(Severity::error, fmt::format("e{}{}", file, i)));
        for (int i = 0; i < 3; ++i) list.push_back(found(Severity::warning, fmt::format("w{}{}", file, i)));
        for (int i = 0; i < 3; ++i) list.push_back(found(Severity::remark, fmt::format("r{}{}", file, i)));
        findings.files.push_back(told(fmt::format("{}.xml", file), std::move(list)));
    }
    const Log log = parse_log(rendered("github", findings));
    std::string order;
    for (const Annotation& one : log.annotations) order += one.kind.front();
    // The last of the ten notices says what is left out.
    EXPECT_EQ(order, std::string(10, 'e') + std::string(10, 'w') + std::string(10, 'n'));
    EXPECT_EQ(log.annotations.back().message.substr(0, 42), "6 errors, 2 warnings and 3 remarks more: G");
    EXPECT_EQ(log.annotations.front().message, "e00");
    ASSERT_EQ(log.others.size(), 2U);
    EXPECT_TRUE(log.others[0].starts_with("popupc: 6 errors, 2 warnings and 3 remarks more"));
    EXPECT_EQ(log.others[1], "popupc: 4 designs: 16 errors, 12 warnings (28 collision)");
}

TEST(GitHub, TenOfAKindAreAllShown) {
    Findings findings;
    std::vector<Diagnostic> list;
    for (const Severity severity : {Severity::error, Severity::warning, Severity::remark}) {
        for (int i = 0; i < 10; ++i) list.push_back(found(severity, "x"));
    }
    findings.files.push_back(told("a.xml", std::move(list)));
    const Log log = parse_log(rendered("github", findings));
    EXPECT_EQ(log.annotations.size(), 30U);
    EXPECT_EQ(log.others.size(), 1U);
}

TEST_F(FormatsOfRuns, GitHubNamesFilesFromItsWorkspace) {
    write_file(scratch / "repository/cards/a.xml", camp());
    const auto file = [this] {
        const Log log = parse_log(popupc({"check", "a.xml", "--message-format", "github"}).out);
        return log.annotations.empty() ? "" : log.annotations.front().properties.at("file");
    };
    EXPECT_EQ(file(), "cards/a.xml");
    options.environment["GITHUB_WORKSPACE"] = scratch.path().string();
    EXPECT_EQ(file(), "repository/cards/a.xml");
    options.environment["GITHUB_WORKSPACE"] = "nonsense";
    EXPECT_EQ(file(), "cards/a.xml");
    options.input = camp();
    const RunResult piped = popupc({"check", "-", "--message-format", "github"});
    const Log log = parse_log(piped.out);
    ASSERT_EQ(log.annotations.size(), 1U);
    EXPECT_FALSE(log.annotations.front().properties.contains("file"));
    EXPECT_TRUE(log.annotations.front().message.starts_with("<stdin>:4:5: ")) << piped.out;
}

TEST_F(FormatsOfRuns, AreTheSameWhateverTheNumberOfThreads) {
    for (int i = 0; i < 6; ++i)
        write_file(scratch / fmt::format("repository/cards/{}.xml", i), camp(1 + i % 3));
    const std::vector<std::string> files{"0.xml", "1.xml", "2.xml", "3.xml", "4.xml", "5.xml"};
    for (const MessageFormat& row : message_format_table()) {
        std::vector<std::string> texts;
        for (const std::string jobs : {"1", "4"}) {
            std::vector<std::string> words{"check", "-j", jobs, "--diagnostics", "d"};
            words.insert(words.end(), {"--message-format", std::string(row.name)});
            words.insert(words.end(), files.begin(), files.end());
            const RunResult result = popupc(words);
            EXPECT_EQ(result.out + result.err, "") << row.name;
            texts.push_back(read_file(options.directory / "d"));
        }
        EXPECT_FALSE(texts[0].empty()) << row.name;
        EXPECT_EQ(texts[0], texts[1]) << row.name;
    }
}

TEST_F(FormatsOfRuns, TheSummaryNamesATimeOnlyWhereItIsNotKept) {
    for (const char* name : {"a.xml", "b.xml"}) write_file(options.directory / name, camp());
    const std::string counts = ": 2 warnings (2 tent-too-narrow)\n";
    const std::string shown = popupc({"check", "a.xml", "b.xml"}).err;
    EXPECT_TRUE(std::regex_search(
        shown, std::regex("popupc: 2 designs in [0-9]+\\.[0-9] s: 2 warnings \\(2 tent-too-narrow\\)\n$")))
        << shown;
    popupc({"check", "a.xml", "b.xml", "--diagnostics", "d"});
    EXPECT_TRUE(read_file(options.directory / "d").ends_with("popupc: 2 designs" + counts));
    EXPECT_TRUE(popupc({"check", "a.xml", "b.xml", "--diagnostics", "-"})
                    .out.ends_with("popupc: 2 designs" + counts));
    EXPECT_EQ(popupc({"check", "a.xml", "b.xml", "-q"}).err.find("designs"), std::string::npos);
}

TEST(Summary, NamesTheWorstKindsFirstAndEightAtMost) {
    Findings findings;
    std::vector<Diagnostic> list{found(Severity::error, "x", {1, 1}, "xml-syntax"),
                                 found(Severity::warning, "x", {1, 1}, "xml-syntax")};
    std::size_t kinds = 0;
    for (const CodeInfo& row : code_table()) {
        if (row.code == "xml-syntax") continue;
        for (std::size_t i = 0; i <= kinds; ++i)
            list.push_back(found(Severity::warning, "x", {1, 1}, std::string(row.code)));
        if (++kinds == 8) break;
    }
    list.push_back(found(Severity::remark, "x"));
    findings.files = {told("a.xml", std::move(list))};
    const std::string line = summary_line(findings, 2.04);
    EXPECT_TRUE(line.starts_with("popupc: 1 design in 2.0 s: 1 error, 37 warnings (2 xml-syntax, 8 "))
        << line;
    const std::string second(code_table()[1].code);
    EXPECT_TRUE(line.ends_with(", 2 " + second + ", \u2026)\n")) << line;
}

TEST_F(FormatsOfRuns, StatisticsCountTheWorstAndMostFrequentFirst) {
    write_file(options.directory / "a.xml", camp(3));
    write_file(options.directory / "b.xml", camp(1));
    write_file(options.directory / "c.xml", "<popup>");
    const RunResult text = popupc({"check", "a.xml", "b.xml", "c.xml", "--statistics", "-q"});
    EXPECT_EQ(text.exit, 1);
    EXPECT_EQ(
        text.err,
        "1  error    xml-syntax       in 1 design   a text that is not well-formed XML\n"
        "4  warning  tent-too-narrow  in 2 designs  a tent's piece is narrower than its seams are apart\n");
    const RunResult objects =
        popupc({"check", "a.xml", "b.xml", "c.xml", "--statistics", "--message-format", "json"});
    EXPECT_EQ(objects.err, "");
    const std::vector<std::string> rows = lines_of(objects.out);
    ASSERT_EQ(rows.size(), 2U);
    EXPECT_EQ(json::parse(rows[1]),
              (json{{"severity", "warning"},
                    {"code", "tent-too-narrow"},
                    {"count", 4},
                    {"designs", 2},
                    {"summary", "a tent's piece is narrower than its seams are apart"}}));
    for (const std::string format : {"sarif", "junit", "github"}) {
        const RunResult refused = popupc({"check", "a.xml", "--statistics", "--message-format", format});
        EXPECT_EQ(refused.exit, 2);
        EXPECT_EQ(refused.out, "");
    }
}

TEST(Statistics, CountWhatIsNotShown) {
    Diagnostics diagnostics("a.xml");
    for (int i = 0; i < 250; ++i) diagnostics.warning("collision", {i + 1, 1}, "w");
    for (int i = 0; i < 101; ++i) diagnostics.error("collision", {i + 1, 1}, "e");
    diagnostics.remark("collision", {}, "5 more");
    const std::vector<CodeCount> rows = count_findings(collect({{&diagnostics, {}}}, Diagnostics()));
    ASSERT_EQ(rows.size(), 3U);
    EXPECT_EQ(rows[0].count, 101U);
    EXPECT_EQ(rows[1].count, 250U);
    EXPECT_EQ(rows[1].severity, Severity::warning);
    EXPECT_EQ(rows[1].designs, 1U);
    EXPECT_EQ(rows[2].count, 1U);
}

TEST(Repository, PathsAreSeenFromTheRoot) {
    EXPECT_EQ(path_from("/a/b", "/a/b/c", "d.xml"), "c/d.xml");
    EXPECT_EQ(path_from("/a/b/", "/a/b/c/", "./../d.xml"), "d.xml");
    EXPECT_EQ(path_from("/a/b", "/a", "d.xml"), "../d.xml");
    EXPECT_EQ(path_from("/a/b", "/a/b", "/a/b/c//d.xml"), "c/d.xml");
    EXPECT_EQ(path_from("/", "/a", "d.xml"), "a/d.xml");
    EXPECT_EQ(path_from("/a", "/a", "..d/e.xml"), "..d/e.xml");
    EXPECT_EQ(path_from("/a", "/a", "-"), "<stdin>");
    EXPECT_EQ(percent_encoded("a/b c:%\xff.xml"), "a/b%20c%3A%25%FF.xml");
    EXPECT_EQ(percent_decoded("a/b%20c%3A%25%FF.xml"), "a/b c:%\xff.xml");
    EXPECT_EQ(percent_decoded("%4%zz%4g%-1%"), "%4%zz%4g%-1%");
}

}  // namespace
}  // namespace popup::test
