#include "cli/files/line_diff.h"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <random>
#include <string>

#include "base/text/nearest.h"
#include "support/run_program.h"

namespace popup {
namespace {

TEST(UnifiedDiff, OfEqualTextsIsEmpty) {
    EXPECT_EQ(unified_diff("f", "", ""), "");
    EXPECT_EQ(unified_diff("f", "a\nb", "a\nb"), "");
}

TEST(UnifiedDiff, ShowsThreeLinesOfContext) {
    EXPECT_EQ(unified_diff("f", "1\n2\n3\n4\n5\n6\n7\n8\n9\n", "1\n2\n3\n4\nfive\n6\n7\n8\n9\n"),
              "--- f\n+++ f\n@@ -2,7 +2,7 @@\n 2\n 3\n 4\n-5\n+five\n 6\n 7\n 8\n");
}

TEST(UnifiedDiff, MarksAMissingLineBreak) {
    EXPECT_EQ(unified_diff("f", "a", "b\n"),
              "--- f\n+++ f\n@@ -1 +1 @@\n-a\n\\ No newline at end of file\n+b\n");
}

// patch(1) finds the file by the name, and ends it at a blank unless a tab does.
TEST(UnifiedDiff, NamesFilesWithBlanksAsPatchTakesThem) {
    const std::string diff = unified_diff("a b/c d.xml", "1\n2\n", "1\n3\n");
    EXPECT_TRUE(diff.starts_with("--- a b/c d.xml\t\n+++ a b/c d.xml\t\n@@")) << diff;
    if (!test::have_program("patch")) GTEST_SKIP() << "needs patch";
    const test::ScratchDirectory scratch;
    std::filesystem::create_directories(scratch / "a b");
    test::write_file(scratch / "a b/c d.xml", "1\n2\n");
    test::RunOptions options;
    options.directory = scratch.path();
    options.input = diff;
    ASSERT_EQ(test::run({"patch", "-s", "-p0"}, options).exit, 0);
    EXPECT_EQ(test::read_file(scratch / "a b/c d.xml"), "1\n3\n");
}

// patch(1) is the judge: what it makes of `before` and the diff must be `after`.
TEST(UnifiedDiff, IsWhatPatchTakes) {
    if (!test::have_program("patch")) GTEST_SKIP() << "needs patch";
    std::mt19937 random(7);
    const auto below = [&random](std::size_t n) { return n == 0 ? 0 : random() % n; };
    for (int round = 0; round < 150; ++round) {
        std::string before;
        for (std::size_t i = below(40); i > 0; --i)
            before += std::to_string(below(round % 2 == 0 ? 5 : 100)) + "\n";
        if (!before.empty() && below(3) == 0) before.pop_back();
        std::string after = before;
        for (std::size_t edits = below(6); edits > 0; --edits) {
            if (below(2) == 0) {
                after.insert(below(after.size() + 1), "x\n");
            } else {
                after.erase(below(after.size()), below(6));
            }
        }
        const std::string diff = unified_diff("f", before, after);
        EXPECT_EQ(diff.empty(), before == after);
        if (diff.empty() || before.empty() || after.empty()) continue;
        const test::ScratchDirectory scratch;
        test::write_file(scratch / "f", before);
        test::RunOptions options;
        options.directory = scratch.path();
        options.input = diff;
        ASSERT_EQ(test::run({"patch", "-s", "--fuzz=0", "f"}, options).exit, 0) << diff;
        ASSERT_EQ(test::read_file(scratch / "f"), after) << diff;
    }
}

TEST(UnifiedDiff, OfLongTextsIsQuick) {
    std::string before;
    std::string other;
    for (int i = 0; i < 300000; ++i) {
        before += "line " + std::to_string(i % 1000) + "\n";
        other += "other " + std::to_string(i % 1000) + "\n";
    }
    std::string after = before;
    after.replace(after.find("line 500"), 8, "changed!");
    const auto start = std::chrono::steady_clock::now();
    EXPECT_LT(unified_diff("f", before, after).size(), 300U);
    EXPECT_GT(unified_diff("f", before, other).size(), before.size());
    // A quadratic comparison would take hours; the bound is loose enough for a sanitized build on a busy
    // machine.
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
}

TEST(Nearest, FindsTheWordThatWasMeant) {
    const std::vector<std::string_view> words{"build", "check", "fix", "explain", "list"};
    EXPECT_EQ(nearest("biuld", words), std::vector<std::string>{"build"});
    EXPECT_EQ(nearest("explian", words), std::vector<std::string>{"explain"});
    EXPECT_EQ(nearest("che", words), std::vector<std::string>{"check"});
    EXPECT_TRUE(nearest("transmogrify", words).empty());
    EXPECT_TRUE(nearest("", words).empty());
    EXPECT_TRUE(nearest(std::string(100000, 'b'), words).empty());
    EXPECT_EQ(edit_distance("abcd", "acbd"), 1U);
    EXPECT_EQ(edit_distance("", "abc"), 3U);
}

}  // namespace
}  // namespace popup
