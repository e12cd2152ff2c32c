// Runs every case of tests/cases (see the README there) with the real program.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "support/run_program.h"

namespace popup::test {
namespace {

namespace fs = std::filesystem;

struct Case {
    fs::path directory;
    std::string name;
    std::string input;  // file name; empty: none
    [[nodiscard]] fs::path beside(const std::string& suffix) const { return directory / (name + suffix); }
};

// What a failure names.
void PrintTo(const Case& one, std::ostream* out) { *out << (one.directory / one.name).string(); }

// Sorted, so that the order does not depend on the disk.
std::vector<Case> all_cases() {
    std::map<fs::path, Case> cases;
    const fs::path root = fs::path(POPUP_SOURCE_DIR) / "tests/cases";
    for (const auto& entry : fs::recursive_directory_iterator(root)) {
        const fs::path& path = entry.path();
        // By their names alone: the disk need not be asked, each time that a program with these tests starts.
        const fs::path inside = path.lexically_relative(root).parent_path();
        const bool part = std::find(inside.begin(), inside.end(), "parts") != inside.end();
        if (!entry.is_regular_file() || part || path.filename() == "README.md") continue;
        Case& one = cases[path.parent_path() / path.stem()];
        one.directory = path.parent_path();
        one.name = path.stem();
        if (path.extension() != ".args" && path.extension() != ".expected") one.input = path.filename();
    }
    std::vector<Case> list;
    for (const auto& [key, one] : cases) list.push_back(one);
    return list;
}

std::string replaced(std::string text, const std::string& what, const std::string& with) {
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + with.size())) {
        text.replace(at, what.size(), with);
    }
    return text;
}

std::vector<std::string> arguments_of(const Case& one, const std::string& out) {
    std::istringstream words(fs::exists(one.beside(".args")) ? read_file(one.beside(".args")) : "check IN");
    std::vector<std::string> arguments;
    for (std::string word; words >> word;) {
        if (word == "IN") word = one.input;
        if (word == "OUT" || word.starts_with("OUT/")) word = out + word.substr(3);
        arguments.push_back(word);
    }
    return arguments;
}

// How long a run took is nobody's promise.
std::string without_times(const std::string& text) {
    static const std::regex time("( designs? in )[0-9]+\\.[0-9] s");
    return std::regex_replace(text, time, "$1N s");
}

class CaseTest : public testing::TestWithParam<Case> {};

TEST_P(CaseTest, SaysAndDoesWhatItsExpectationSays) {
    const Case& one = GetParam();
    const ScratchDirectory out;
    RunOptions options;
    options.directory = one.directory;
    options.environment["NO_COLOR"] = "1";
    options.environment["ASAN_OPTIONS"] = "detect_leaks=1:exitcode=86";  // where it is built to look
    const RunResult result = popupc(arguments_of(one, out.path()), options);

    std::string text = "exit " + std::to_string(result.exit) + "\n";
    const auto section = [&text](const std::string& title, const std::string& body) {
        if (!body.empty()) text += "=== " + title + "\n" + body + (body.ends_with('\n') ? "" : "\n");
    };
    section("stderr", without_times(replaced(result.err, out.path(), "OUT")));
    section("stdout", replaced(result.out, out.path(), "OUT"));
    std::string left;
    for (const std::string& name : out.names()) left += name + "\n";
    section("files", left);

    if (one.name.starts_with("bad-")) {
        EXPECT_TRUE(result.exit == 1 || result.exit == 2) << text;
        EXPECT_NE(text.find("error"), std::string::npos) << text;
        EXPECT_EQ(left, "") << "a failed run left files";
    } else {
        EXPECT_LE(result.exit, 1) << text;
        EXPECT_EQ(result.err.find(" error: "), std::string::npos) << text;
    }
    const fs::path expected = one.beside(".expected");
    if (std::getenv("POPUP_UPDATE") != nullptr) {
        write_file(expected, text);
        return;
    }
    ASSERT_TRUE(fs::exists(expected)) << "no expectation yet; POPUP_UPDATE=1 writes it:\n" << text;
    EXPECT_EQ(text, read_file(expected));
}

INSTANTIATE_TEST_SUITE_P(Cases, CaseTest, testing::ValuesIn(all_cases()), [](const auto& info) {
    const fs::path root = fs::path(POPUP_SOURCE_DIR) / "tests/cases";
    std::string name = info.param.directory.lexically_relative(root) / info.param.name;
    std::replace_if(
        name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
    return name;
});
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(CaseTest);

}  // namespace
}  // namespace popup::test
