// The README and the pages of docs/ are true: what they show runs and prints what they say, and what they
// name is there. tests/support/doc_page.h says how a page tells what runs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "popup/mechanism.h"
#include "support/doc_page.h"
#include "support/run_program.h"

namespace popup::test {
namespace {

namespace fs = std::filesystem;

const fs::path kSource = POPUP_SOURCE_DIR;

// Pages of Markdown, from the root of the repository, sorted.
std::vector<std::string> pages(const std::vector<std::string>& folders) {
    std::vector<std::string> found{"README.md", "CONTRIBUTING.md"};
    for (const std::string& folder : folders) {
        for (const auto& entry : fs::recursive_directory_iterator(kSource / folder)) {
            if (entry.path().extension() == ".md") found.push_back(fs::relative(entry.path(), kSource));
        }
    }
    std::sort(found.begin(), found.end());
    return found;
}

class DocPage : public testing::TestWithParam<std::string> {};

TEST_P(DocPage, DoesAndPrintsWhatItShows) {
    const fs::path page = kSource / GetParam();
    const DocRun run = run_doc_page(page);
    const char* update = std::getenv("POPUP_UPDATE");
    if (update != nullptr && std::string(update) == "1" && run.text != read_file(page)) {
        write_file(page, run.text);
    }
    for (const std::string& fault : run.wrong) ADD_FAILURE() << fault;
    if (!run.skipped.empty()) {
        std::string all;
        for (const std::string& one : run.skipped) all += "\n" + GetParam() + ", " + one;
        GTEST_SKIP() << "not all of the page ran:" << all;
    }
}

INSTANTIATE_TEST_SUITE_P(Docs, DocPage, testing::ValuesIn(pages({"docs", "samples"})), [](const auto& info) {
    std::string name = info.param;
    std::replace_if(
        name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
    return name;
});

// The runner itself is able to fail.
TEST(DocRunner, SaysWhatIsNotAsThePageSays) {
    const ScratchDirectory scratch;
    write_file(scratch / "page.md",
               "<!-- test: file a.txt -->\n```toml\nx = 1\n```\n"
               "```console\n$ cat a.txt\nx = 1\n$ echo two\nthree\n```\n"
               "```sh\nfalse\n```\n"
               "```json\n{}\n```\n"
               "<!-- test: needs no-such-program -->\n```sh\nfalse\n```\n"
               "<!-- test: not run: it would fail -->\n```sh\nfalse\n```\n"
               "<!-- test: prints echo 5 -->\n```json\n6\n```\n"
               "<!-- test: run false -->\n"
               "<!-- test: dance -->\n");
    const DocRun run = run_doc_page(scratch / "page.md");
    ASSERT_EQ(run.wrong.size(), 6U);
    EXPECT_EQ(run.wrong[0], "page.md:8: `echo two` prints\ntwo\nand the page says\nthree\n");
    EXPECT_TRUE(run.wrong[1].starts_with("page.md:11: the block fails")) << run.wrong[1];
    EXPECT_EQ(run.wrong[2], "page.md:14: nothing says how this block of json is used");
    EXPECT_EQ(run.wrong[3], "page.md:26: `echo 5` prints\n5\nand the page says\n6\n");
    EXPECT_TRUE(run.wrong[4].starts_with("page.md:29: false\nfails")) << run.wrong[4];
    EXPECT_TRUE(run.wrong[5].starts_with("page.md:30: there is no test \"dance\"")) << run.wrong[5];
    EXPECT_EQ(run.skipped, std::vector<std::string>{"line 18: no-such-program is not installed"});
    EXPECT_NE(run.text.find("$ echo two\ntwo\n```"), std::string::npos) << run.text;
    EXPECT_NE(run.text.find("```json\n5\n```"), std::string::npos) << run.text;
}

TEST(Docs, WhatDoesNotRunSaysWhyAndNamesWhatIsThere) {
    const std::string dev = run({(kSource / "dev").string(), "help"}).out;
    const std::string presets = read_file(kSource / "CMakePresets.json");
    static const std::regex kDev(R"(\./dev( [a-z]+)?( long| cluster)?)");
    static const std::regex kPreset(R"(--preset ([a-z]+))");
    static const std::regex kProgram(R"((samples|tests)/[A-Za-z0-9_./-]+\.(sh|py))");
    const auto all = [](const std::string& line, const std::regex& what, const auto& check) {
        for (std::sregex_iterator at(line.begin(), line.end(), what), end; at != end; ++at) check(*at);
    };
    for (const std::string& page : pages({"docs", "samples"})) {
        for (const DocStep& step : doc_steps(read_file(kSource / page))) {
            const DocNote* note = step.note("not run");
            if (note == nullptr) continue;
            EXPECT_GT(note->rest.size(), 10U) << page << ":" << note->line << " gives no reason";
            for (const std::string& line : step.lines) {
                all(line, kDev, [&](const auto& match) {
                    EXPECT_NE(dev.find(match.str()), std::string::npos) << page << ": " << line;
                });
                all(line, kPreset, [&](const auto& match) {
                    EXPECT_NE(presets.find("\"name\": \"" + match[1].str() + "\""), std::string::npos)
                        << page << ": " << line;
                });
                all(line, kProgram, [&](const auto& match) {
                    EXPECT_TRUE(fs::exists(kSource / match.str())) << page << ": " << line;
                });
            }
        }
    }
}

TEST(Docs, EveryLinkLeadsSomewhere) {
    std::size_t seen = 0;
    for (const std::string& page : pages({"docs", "samples", "tests"})) {
        const std::string text = read_file(kSource / page);
        for (const DocLink& link : doc_links(text)) {
            if (link.target.starts_with("http")) continue;
            ++seen;
            const std::size_t hash = link.target.find('#');
            const std::string path = link.target.substr(0, hash);
            const fs::path to = path.empty() ? kSource / page : (kSource / page).parent_path() / path;
            EXPECT_TRUE(fs::exists(to)) << page << ":" << link.line << ": " << link.target;
            if (hash == std::string::npos || to.extension() != ".md") continue;
            const std::vector<std::string> anchors = doc_anchors(read_file(to));
            EXPECT_NE(std::find(anchors.begin(), anchors.end(), link.target.substr(hash + 1)), anchors.end())
                << page << ":" << link.line << ": " << link.target;
        }
    }
    EXPECT_GT(seen, 50U);
}

// Names of files in backquotes; NAME and ROOM stand for others, and so do "*" and "…".
TEST(Docs, FilesThatPagesNameAreThere) {
    static const std::regex kFile(
        R"(`((src|include|tests|samples|schemas|man|docs|cmake)/[A-Za-z0-9_./-]+)`)");
    std::size_t seen = 0;
    for (const std::string& page : pages({"docs", "samples"})) {
        const std::string text = read_file(kSource / page);
        for (std::sregex_iterator at(text.begin(), text.end(), kFile), end; at != end; ++at) {
            const std::string name = (*at)[1];
            if (name.find("NAME") != std::string::npos || name.find("ROOM") != std::string::npos) continue;
            ++seen;
            EXPECT_TRUE(fs::exists(kSource / name)) << page << " names " << name;
        }
    }
    EXPECT_GT(seen, 20U);
}

TEST(Docs, TheReadmeIsReadInThreeMinutesAndLeadsToEveryPage) {
    const std::string text = read_file(kSource / "README.md");
    EXPECT_LT(std::count(text.begin(), text.end(), '\n'), 200);
    std::set<std::string> linked;
    for (const DocLink& link : doc_links(text)) linked.insert(link.target.substr(0, link.target.find('#')));
    for (const std::string& page : pages({"docs"})) {
        EXPECT_TRUE(page == "README.md" || linked.contains(page)) << page << " is found by nobody";
    }
}

TEST(Docs, NameEveryElementTypeAndFormat) {
    const std::string elements = read_file(kSource / "docs/elements.md");
    for (const ElementInfo& info : element_table())
        EXPECT_NE(elements.find("`" + std::string(info.name) + "`"), std::string::npos) << info.name;
    const std::string formats = read_file(kSource / "docs/formats.md");
    for (const auto& row : nlohmann::json::parse(popupc({"list", "formats", "--json"}).out)) {
        const auto suffix = row["suffix"].get<std::string>();
        EXPECT_NE(formats.find("`" + suffix + "`"), std::string::npos) << suffix;
    }
}

}  // namespace
}  // namespace popup::test
