// Where FlatLang programs load from, and that they read nothing else.
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "input/flatlang/folders.h"
#include "support/run_program.h"

namespace popup::flatlang {
namespace {

namespace fs = std::filesystem;

// Files that stand only in a map; tells what was asked for.
struct Shelf {
    std::map<std::string, std::string> files;
    std::vector<std::string> asked;

    ProgramOptions options(std::vector<std::string> folders = {}) {
        ProgramOptions options;
        options.folders = std::move(folders);
        options.read_file = [this](const std::string& path) -> std::optional<Source> {
            asked.push_back(path);
            const auto at = files.find(path);
            if (at == files.end()) return std::nullopt;
            return Source{path, at->second};
        };
        return options;
    }
};

TEST(FlatlangFolders, TheProgramsOwnFolderComesFirstThenTheOthersInOrder) {
    Shelf shelf{{{"cards/a.fl", "own"}, {"one/a.fl", "1"}, {"one/b.fl", "2"}, {"two/b.fl", "3"}}, {}};
    const Folders folders({"cards/main.fl", ""}, shelf.options({"one", "two/"}));
    std::string why;
    EXPECT_EQ(folders.find("a.fl", why)->text, "own");
    const auto second = folders.find("b.fl", why);
    ASSERT_TRUE(second);
    EXPECT_EQ(second->text, "2");
    EXPECT_EQ(second->name, "one/b.fl");
    EXPECT_FALSE(second->of_kit);
    EXPECT_FALSE(folders.find("c.fl", why));
    EXPECT_EQ(why, "there is no \"c.fl\" in \"cards\", \"one\" or \"two\"");
    EXPECT_EQ(shelf.asked, (std::vector<std::string>{"cards/a.fl", "cards/b.fl", "one/b.fl", "cards/c.fl",
                                                     "one/c.fl", "two/c.fl"}));
}

TEST(FlatlangFolders, OfStandardInputTheFolderIsTheWorkingDirectory) {
    Shelf shelf{{{"a.fl", "here"}}, {}};
    const Folders folders({"-", ""}, shelf.options());
    std::string why;
    const auto file = folders.find("./a.fl", why);
    ASSERT_TRUE(file);
    EXPECT_EQ(file->name, "a.fl");
    EXPECT_FALSE(folders.find("b.fl", why));
    EXPECT_EQ(why, "there is no \"b.fl\" in the working directory");
}

TEST(FlatlangFolders, AbsoluteNamesAreLookedForBelowTheFolders) {
    Shelf shelf{{{"cards/etc/a.fl", "below"}, {"/etc/a.fl", "outside"}}, {}};
    const Folders folders({"cards/main.fl", ""}, shelf.options());
    std::string why;
    EXPECT_EQ(folders.find("/etc/a.fl", why)->text, "below");
}

TEST(FlatlangFolders, NamesThatLeadOutAreNotEvenAskedFor) {
    Shelf shelf;
    for (const char* name :
         {"../a.fl", "x/../../a.fl", "/../a.fl", "..", ".", "", "x/..", "../cardsmith/a.fl"}) {
        const Folders folders({"cards/main.fl", ""}, shelf.options({"lib/deep"}));
        std::string why;
        EXPECT_FALSE(folders.find(name, why)) << name;
        EXPECT_FALSE(why.empty()) << name;
    }
    EXPECT_TRUE(shelf.asked.empty()) << shelf.asked.front();
    // A folder above: names may lead up to it and no further.
    shelf.files = {{"../a.fl", "up"}, {"../../a.fl", "further"}};
    const Folders folders({"main.fl", ""}, shelf.options({".."}));
    std::string why;
    EXPECT_EQ(folders.find("../a.fl", why)->text, "up");
    EXPECT_FALSE(folders.find("../../a.fl", why));
    EXPECT_EQ(why, "\"../../a.fl\" leads out of the folders that programs may load from");
}

TEST(FlatlangFolders, NamesWithNulAreRefused) {
    Shelf shelf{{{"a.fl", "x"}}, {}};
    const Folders folders({"main.fl", ""}, shelf.options());
    std::string why;
    EXPECT_FALSE(folders.find(std::string_view("a.fl\0b", 6), why));
    EXPECT_EQ(why, "the name of the file to load has a NUL byte");
    EXPECT_TRUE(shelf.asked.empty());
}

TEST(FlatlangFolders, OnTheDiskNothingOutsideIsRead) {
    const test::ScratchDirectory scratch;
    const fs::path root = scratch.path();
    fs::create_directories(root / "in/sub");
    fs::create_directories(root / "inside-out");
    fs::create_directories(root / "other");
    const auto put = [&](const char* name, const std::string& text) {
        test::write_file((root / name).string(), text);
    };
    put("in/a.fl", "a");
    put("in/sub/b.fl", "b");
    put("inside-out/a.fl", "secret");
    put("secret.fl", "secret");
    put("other/c.fl", "c");
    fs::create_symlink(root / "secret.fl", root / "in/link.fl");
    fs::create_directory_symlink(root, root / "in/up");
    fs::create_directory_symlink(root / "other", root / "in/other");
    fs::create_symlink("sub/b.fl", root / "in/inner.fl");
    fs::create_symlink("loop.fl", root / "in/loop.fl");

    const std::string program = (root / "in/main.fl").string();
    const Folders alone({program, ""}, {});
    std::string why;
    EXPECT_EQ(alone.find("a.fl", why)->text, "a");
    EXPECT_EQ(alone.find("a.fl", why)->name, (root / "in/a.fl").string());
    EXPECT_EQ(alone.find("sub/../a.fl", why)->text, "a");
    EXPECT_EQ(alone.find("inner.fl", why)->text, "b") << "links within the folder are followed";
    for (const std::string& name :
         std::vector<std::string>{"link.fl", "../secret.fl", "up/secret.fl", "up/in/../secret.fl",
                                  "sub/../../secret.fl", "../inside-out/a.fl", "other/c.fl"}) {
        EXPECT_FALSE(alone.find(name, why)) << name;
        EXPECT_NE(why.find("leads out of the folders"), std::string::npos) << name << ": " << why;
    }
    EXPECT_FALSE(alone.find((root / "secret.fl").string(), why));
    EXPECT_NE(why.find("there is no "), std::string::npos) << why;
    EXPECT_FALSE(alone.find("loop.fl", why));
    EXPECT_EQ(alone.find("up/in/a.fl", why)->text, "a") << "it leads back in";

    // A link may lead to another folder that was named.
    ProgramOptions options;
    options.folders = {(root / "other").string(), (root / "missing").string()};
    const Folders both({program, ""}, options);
    EXPECT_EQ(both.find("other/c.fl", why)->text, "c");
    EXPECT_EQ(both.find("c.fl", why)->text, "c");
    EXPECT_FALSE(both.find("up/secret.fl", why));
}

TEST(FlatlangFolders, OnTheDiskOnlyRegularFilesOfAtMostFourMebibytesAreRead) {
    const test::ScratchDirectory scratch;
    const fs::path root = scratch.path();
    fs::create_directories(root / "dir.fl");
    fs::create_directories(root / "second");
    ASSERT_EQ(::mkfifo((root / "pipe.fl").c_str(), 0600), 0);
    fs::create_symlink("/dev/zero", root / "zero.fl");
    test::write_file((root / "full.fl").string(), std::string(4 << 20, ';'));
    test::write_file((root / "large.fl").string(), std::string((4 << 20) + 1, ';'));
    test::write_file((root / "second/dir.fl").string(), "found");

    const Folders folders({(root / "main.fl").string(), ""}, {});
    std::string why;
    EXPECT_EQ(folders.find("full.fl", why)->text.size(), std::size_t{4} << 20);
    const std::string beginning = "\"" + root.string() + "/";
    EXPECT_FALSE(folders.find("large.fl", why));
    EXPECT_EQ(why, beginning + "large.fl\" has more than 4 MiB");
    EXPECT_FALSE(folders.find("dir.fl", why));
    EXPECT_EQ(why, beginning + "dir.fl\" is a directory");
    EXPECT_FALSE(folders.find("pipe.fl", why));
    EXPECT_EQ(why, beginning + "pipe.fl\" is not a regular file");
    EXPECT_FALSE(folders.find("zero.fl", why));
    EXPECT_FALSE(folders.find("full.fl/x", why));
    EXPECT_FALSE(folders.find(std::string(5000, 'x'), why));

    // The first that can be read is taken.
    ProgramOptions options;
    options.folders = {(root / "second").string()};
    EXPECT_EQ(Folders({(root / "main.fl").string(), ""}, options).find("dir.fl", why)->text, "found");
}

TEST(FlatlangKit, IsFoundByItsNameWhereverTheProgramStands) {
    Shelf shelf{{{"kit/polygon.fl", "mine"}, {"kit/other.fl", "other"}}, {}};
    const Folders folders({"main.fl", ""}, shelf.options());
    std::string why;
    const auto file = folders.find("kit/polygon.fl", why);
    ASSERT_TRUE(file);
    EXPECT_TRUE(file->of_kit);
    EXPECT_EQ(file->name, "kit/polygon.fl");
    EXPECT_EQ(file->text, *kit_file("polygon.fl"));
    EXPECT_EQ(folders.find("kit/other.fl", why)->text, "other") << "what the kit has not, a folder may have";
    EXPECT_FALSE(folders.find("kit/geer.fl", why));
    EXPECT_NE(why.find("the kit has none either; it has "), std::string::npos) << why;
    EXPECT_NE(why.find("polygon.fl"), std::string::npos) << why;
    EXPECT_FALSE(folders.find("kit/../main2.fl", why)) << "the kit's names are names, not paths";
}

// What is embedded is what stands in the sources, byte for byte, and all of it.
TEST(FlatlangKit, HasEveryFileOfItsFolder) {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(fs::path(POPUP_SOURCE_DIR) / "src/input/flatlang/kit")) {
        if (entry.path().extension() == ".fl") names.push_back(entry.path().filename());
    }
    std::sort(names.begin(), names.end());
    const std::vector<std::string_view> embedded = kit_files();
    EXPECT_EQ(std::vector<std::string>(embedded.begin(), embedded.end()), names);
    for (const std::string& name : names) {
        ASSERT_NE(kit_file(name), nullptr) << name;
        EXPECT_TRUE(*kit_file(name) ==
                    test::read_file(fs::path(POPUP_SOURCE_DIR) / "src/input/flatlang/kit" / name))
            << name;
    }
    EXPECT_EQ(kit_file("nothing.fl"), nullptr);
    EXPECT_EQ(kit_file(""), nullptr);
}

}  // namespace
}  // namespace popup::flatlang
