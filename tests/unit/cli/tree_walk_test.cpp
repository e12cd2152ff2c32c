// Which files of a directory are designs to look at, and what patterns of paths mean: held against git, which
// does not share our code.
#include "cli/files/tree_walk.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <regex>
#include <string>
#include <vector>

#include "support/random.h"
#include "support/run_program.h"

namespace popup {
namespace {

namespace fs = std::filesystem;
using test::Random;
using test::ScratchDirectory;

using Names = std::vector<std::string>;

void make(const fs::path& root, const Names& files) {
    for (const std::string& file : files) {
        fs::create_directories((root / file).parent_path());
        test::write_file(root / file, "<popup/>");
    }
}

WalkOptions all_xml() {
    WalkOptions options;
    options.wants = [](std::string_view name) { return name.ends_with(".xml"); };
    return options;
}

// The files found, relative to `root`.
Names found(const fs::path& root, const WalkOptions& options = all_xml()) {
    const TreeWalk walk = walk_tree(root, options, {});
    EXPECT_TRUE(walk.unreadable.empty());
    Names names;
    for (const std::string& file : walk.files) names.push_back(file.substr(root.string().size() + 1));
    return names;
}

std::optional<bool> says(std::string_view patterns, std::string_view path, bool directory = false) {
    return PathPatterns(patterns).says(path, directory);
}

TEST(TreeWalk, FindsFilesOfAllDepthsInTheOrderOfTheirNames) {
    const ScratchDirectory root;
    make(root.path(),
         {"b.xml", "a/z.xml", "a.xml", "a/b/c.xml", "Z.xml", "a-b.xml", "\xC3\xA4.xml", "note.txt"});
    EXPECT_EQ(found(root.path()),
              (Names{"Z.xml", "a/b/c.xml", "a/z.xml", "a-b.xml", "a.xml", "b.xml", "\xC3\xA4.xml"}));
}

TEST(TreeWalk, LeavesOutHiddenNamesAndLinksToDirectories) {
    const ScratchDirectory root;
    make(root.path(), {"a.xml", ".hidden.xml", ".git/b.xml", "real/c.xml"});
    fs::create_directory_symlink("real", root / "linked");
    fs::create_directory_symlink(".", root / "real/round.xml");
    fs::create_symlink("a.xml", root / "link.xml");
    fs::create_symlink("nowhere", root / "broken.xml");
    ::mkfifo((root / "pipe.xml").c_str(), 0600);
    EXPECT_EQ(found(root.path()), (Names{"a.xml", "broken.xml", "link.xml", "real/c.xml"}));
}

TEST(TreeWalk, NamesFilesAsTheRootIsNamed) {
    const ScratchDirectory root;
    make(root.path(), {"a/b.xml"});
    const std::string path = root.path();
    const std::vector<std::string> expected{path + "/a/b.xml"};
    EXPECT_EQ(walk_tree(path + "//", all_xml(), {}).files, expected);
    const fs::path before = fs::current_path();
    fs::current_path(root.path());
    EXPECT_EQ(walk_tree(".", all_xml(), {}).files, (Names{"a/b.xml"}));
    EXPECT_EQ(walk_tree("a", all_xml(), {}).files, (Names{"a/b.xml"}));
    EXPECT_EQ(walk_tree("./a/", all_xml(), {}).files, (Names{"./a/b.xml"}));
    fs::current_path(before);
}

TEST(TreeWalk, IgnoreFilesAreForTheirDirectoryAndBelowAndTheInnermostDecides) {
    const ScratchDirectory root;
    make(root.path(), {"draft.xml", "a/draft.xml", "a/b/draft.xml", "a/keep.xml", "old/keep.xml"});
    test::write_file(root / ".popupcignore", "draft.xml\n/old/\n");
    test::write_file(root / "a/b/.popupcignore", "!draft.xml\n");
    test::write_file(root / "old/.popupcignore", "!keep.xml\n");
    EXPECT_EQ(found(root.path()), (Names{"a/b/draft.xml", "a/keep.xml"}));
}

TEST(TreeWalk, PatternsOfTheCommandLineComeBeforeIgnoreFiles) {
    const ScratchDirectory root;
    make(root.path(), {"a.xml", "b.xml", "x/a.xml", "x/b.xml"});
    test::write_file(root / ".popupcignore", "b.xml\n!a.xml\n");
    WalkOptions options = all_xml();
    options.exclude.add("/a.xml");
    options.exclude.add("!x/b.xml");
    EXPECT_EQ(found(root.path(), options), (Names{"x/a.xml", "x/b.xml"}));
    options = all_xml();
    options.include.add("x/*");
    EXPECT_EQ(found(root.path(), options), (Names{"x/a.xml"}));
}

TEST(TreeWalk, TellsWhatCannotBeReadAndGoesOn) {
    if (::geteuid() == 0) {
        // Root may read everything; what is not there it cannot read either.
        const TreeWalk walk = walk_tree("/nowhere", all_xml(), {});
        ASSERT_EQ(walk.unreadable.size(), 1U);
        EXPECT_EQ(walk.unreadable[0].file(), "/nowhere");
        EXPECT_TRUE(walk.unreadable[0].has_errors());
    }
    const ScratchDirectory root;
    make(root.path(), {"a.xml", "b/c.xml"});
    fs::create_directory(root / "b/.popupcignore");
    const TreeWalk walk = walk_tree(root.path(), all_xml(), {});
    EXPECT_EQ(walk.files.size(), 2U);
    ASSERT_EQ(walk.unreadable.size(), 1U);
    EXPECT_EQ(walk.unreadable[0].file(), root.path().string() + "/b/.popupcignore");
    EXPECT_EQ(walk.unreadable[0].sorted().front().code, "unreadable-input");
}

TEST(TreeWalk, ACheckOfADirectoryTellsTheSameWithAnyNumberOfThreads) {
    const ScratchDirectory root;
    const std::string cases = std::string(POPUP_SOURCE_DIR) + "/tests/cases/";
    for (int i = 0; i < 12; ++i) {
        const std::string design = i % 3 == 0 ? "found/sticks-out.xml" : "found/too-close.xml";
        const fs::path file = root.path() / ("s" + std::to_string(i % 4)) / (std::to_string(i) + ".xml");
        fs::create_directories(file.parent_path());
        test::write_file(file, i == 7 ? "<popup" : test::read_file(cases + design));
    }
    fs::create_directory(root / "empty");
    test::RunOptions options;
    options.directory = root.path();
    const test::RunResult one = test::popupc({"check", "-v", "-j1", "s2", "empty", "."}, options);
    const test::RunResult many = test::popupc({"check", "-v", "-j5", "s2", "empty", "."}, options);
    EXPECT_EQ(one.exit, 1);
    // But for how long it took.
    const std::regex time(" in [0-9.]+ s:");
    EXPECT_EQ(std::regex_replace(one.err, time, ""), std::regex_replace(many.err, time, ""));
    EXPECT_NE(one.err.find("s3/7.xml:1:1: error"), std::string::npos) << one.err;
    EXPECT_LT(one.err.find("no-designs"), one.err.find("s0/0.xml:4")) << one.err;
}

TEST(PathPatterns, LinesReadAsInAGitignoreFile) {
    EXPECT_EQ(says("# a\n\n  \na.xml\r\n", "a.xml"), true);
    EXPECT_EQ(says("#a\n", "#a"), std::nullopt);
    EXPECT_EQ(says("\\#a\n", "#a"), true);
    EXPECT_EQ(says("\\!a", "!a"), true);
    EXPECT_EQ(says("\xEF\xBB\xBF"
                   "a",
                   "a"),
              true);
    EXPECT_EQ(says("a   ", "a"), true);
    EXPECT_EQ(says("a\\ ", "a "), true);
    EXPECT_EQ(says("a\n!a", "a"), false);
    EXPECT_EQ(says("!a\na", "a"), true);
    EXPECT_EQ(says("a/", "a"), std::nullopt);
    EXPECT_EQ(says("a/", "a", true), true);
    EXPECT_EQ(says("/\n!\n!/\n", "a", true), std::nullopt);
}

TEST(PathPatterns, StarsStayInTheirPartAndDoubledOnesDoNot) {
    EXPECT_EQ(says("a/*.xml", "a/b.xml"), true);
    EXPECT_EQ(says("a/*.xml", "a/b/c.xml"), std::nullopt);
    EXPECT_EQ(says("*.xml", "a/b/c.xml"), true);
    EXPECT_EQ(says("/*.xml", "a/b/c.xml"), std::nullopt);
    EXPECT_EQ(says("a/**/c", "a/c"), true);
    EXPECT_EQ(says("a/**/c", "a/b/b/c"), true);
    EXPECT_EQ(says("a/**", "a", true), std::nullopt);
    EXPECT_EQ(says("a/**", "a/b/c"), true);
    EXPECT_EQ(says("**/c", "c"), true);
    EXPECT_EQ(says("**/a/**/a/b", "a/x/a/a/c/a/b"), true);
    EXPECT_EQ(says("a[b/c", "a[b/c"), std::nullopt);
    EXPECT_EQ(says("[[:digit:]]?", "7x"), true);
}

TEST(PathPatterns, HostilePatternsTakeNoTimeToSpeakOf) {
    std::string stars;
    std::string parts;
    std::string path;
    for (int i = 0; i < 300; ++i) {
        stars += "*a";
        parts += "**/a/";
        path += "a/";
    }
    const auto begin = std::chrono::steady_clock::now();
    EXPECT_EQ(says(stars + "b", std::string(255, 'a')), std::nullopt);
    EXPECT_EQ(says(parts + "b", path + "c"), std::nullopt);
    // Exponential would be longer than anybody waits.
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(30));
}

// A pattern of few letters, so that it matches often.
std::string random_pattern(Random& random) {
    static const Names kPieces{"a",    "b",           "ab",  "*",      "*",    "**",   "?",   "[ab]",
                               "[!a]", "[^b]",        "/",   "/",      "/",    "\\a",  "\\*", "[a-b]*",
                               "a b",  " ",           "**/", "/**",    "[]",   "[]a]", "[b",  "\\",
                               "a\\ ", "[[:alpha:]]", "***", "[\\]a]", ".xml", "*.xml"};
    std::string text = random.below(4) == 0 ? "!" : "";
    if (random.below(3) == 0) text += "/";
    const std::size_t count = 1 + random.below(5);
    for (std::size_t i = 0; i < count; ++i) text += kPieces[random.below(kPieces.size())];
    if (random.below(4) == 0) text += "/";
    return text;
}

TEST(PathPatterns, AgreeWithGitOnGeneratedTrees) {
    if (!test::have_program("git")) GTEST_SKIP() << "git is not there to compare with";
    Random random(7);
    std::size_t ignored = 0;
    for (int round = 0; round < 25; ++round) {
        const ScratchDirectory root;
        ASSERT_EQ(test::run({"git", "init", "-q", root.path()}).exit, 0);
        Names directories{"", "a/", "b/", "a/b/", "a/ab/", "b/a b/", "a/b/a/"};
        Names files;
        for (const std::string& directory : directories) {
            for (const char* name : {"a", "b", "ab", "a b", "ba.xml", "*", "]"}) {
                const std::string path = directory + name;
                if (std::find(directories.begin(), directories.end(), path + "/") == directories.end()) {
                    files.push_back(path);
                }
            }
        }
        make(root.path(), files);
        std::string told;
        for (const char* where : {"", "a/", "a/b/"}) {
            if (random.below(3) == 0) continue;
            std::string lines;
            const std::size_t count = 1 + random.below(3);
            for (std::size_t i = 0; i < count; ++i) lines += random_pattern(random) + "\n";
            test::write_file(root.path() / where / ".popupcignore", lines);
            told += std::string("--- ") + where + "\n" + lines;
        }
        const test::RunResult git = test::run({"git", "-C", root.path(), "ls-files", "-z", "--others",
                                               "--exclude-per-directory=.popupcignore"});
        ASSERT_EQ(git.exit, 0) << git.err;
        Names expected;
        for (std::size_t begin = 0; begin < git.out.size();) {
            const std::size_t end = git.out.find('\0', begin);
            const std::string name = git.out.substr(begin, end - begin);
            if (fs::path(name).filename() != ".popupcignore") expected.push_back(name);
            begin = end + 1;
        }
        WalkOptions all;
        all.wants = [](std::string_view) { return true; };
        Names ours = found(root.path(), all);
        std::sort(ours.begin(), ours.end());
        std::sort(expected.begin(), expected.end());
        ignored += files.size() - expected.size();
        ASSERT_EQ(ours, expected) << told;
    }
    EXPECT_GT(ignored, 150U) << "the patterns hardly ever match";
}

}  // namespace
}  // namespace popup
