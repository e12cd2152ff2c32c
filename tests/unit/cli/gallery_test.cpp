// Galleries: what a run makes, what the next one makes again, and what neither touches.
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "support/background.h"
#include "support/run_program.h"
#include "support/sanitized.h"

namespace popup::test {
namespace {

namespace fs = std::filesystem;
using Files = std::map<std::string, std::string>;

// A card with a box of this size.
std::string card(int width, int height = 30) {
    std::string points;
    for (const auto& [x, y] :
         {std::pair(-width, height), {-width, -height}, {width, height}, {width, -height}})
        points += "<point x=\"" + std::to_string(x) + "\" y=\"" + std::to_string(y) + "\"/>";
    return "<popup version=\"2.0\" units=\"mm\"><mainpage width=\"200\" height=\"140\"/><structurelist>\n"
           "<structure type=\"step\" id=\"box\"><outerpoints>" +
           points +
           "</outerpoints><parentfold><begin x=\"0\" y=\"-70\"/><end x=\"0\" y=\"70\"/></parentfold>"
           "</structure></structurelist></popup>\n";
}

// Its tent is widened: a warning.
std::string doubtful_card() {
    std::string points;
    for (const auto& [x, y] :
         {std::pair(-25, 0), {-25, 40}, {25, 0}, {25, 40}, {-22, -20}, {-22, 20}, {22, -20}, {22, 20}})
        points += "<point x=\"" + std::to_string(x) + "\" y=\"" + std::to_string(y) + "\"/>";
    return "<popup version=\"2.0\" units=\"mm\"><mainpage width=\"200\" height=\"140\"/><structurelist>\n"
           "<structure type=\"tent\" id=\"tent\"><outerpoints>" +
           points +
           "</outerpoints><parentfold><begin x=\"0\" y=\"-70\"/><end x=\"0\" y=\"70\"/></parentfold>"
           "</structure></structurelist></popup>\n";
}
const std::string kWrongCard = "<popup version=\"2.0\"><mainpage width=\"ten\" height=\"5\"/></popup>\n";

Files files_below(const fs::path& directory) {
    Files files;
    if (!fs::exists(directory)) return files;
    for (const auto& entry : fs::recursive_directory_iterator(directory)) {
        if (entry.is_regular_file()) files[fs::relative(entry.path(), directory)] = read_file(entry.path());
    }
    return files;
}

std::set<std::string> names_of(const Files& files) {
    std::set<std::string> names;
    for (const auto& [name, bytes] : files) names.insert(name);
    return names;
}

std::size_t count_of(const std::string& text, const std::string& word) {
    std::size_t count = 0;
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++count;
    return count;
}

// The last line, without how long it took.
std::string summary_of(const RunResult& result) {
    const std::string text = result.err.substr(0, result.err.find_last_not_of('\n') + 1);
    return std::regex_replace(text.substr(text.rfind('\n') + 1), std::regex(", in [0-9.]+ s"), "");
}

class Gallery : public testing::Test {
 protected:
    void SetUp() override {
        fs::create_directory(scratch_ / "designs");
        write("a.xml", card(20));
        write("b.xml", card(30));
    }
    void write(const std::string& name, const std::string& text) {
        write_file(scratch_ / "designs" / name, text);
    }
    RunResult make(std::vector<std::string> more = {}) {
        std::vector<std::string> words{"gallery", "designs", "-o", "gallery"};
        words.insert(words.end(), more.begin(), more.end());
        RunOptions options;
        options.directory = scratch_.path();
        return popupc(words, options);
    }
    [[nodiscard]] Files files() const { return files_below(scratch_ / "gallery"); }
    [[nodiscard]] std::string index() const { return read_file(scratch_ / "gallery/index.html"); }

    ScratchDirectory scratch_;
};

TEST_F(Gallery, HasATileAPageAndAPictureOfEachDesign) {
    const RunResult made = make();
    EXPECT_EQ(made.exit, 0) << made.err;
    EXPECT_EQ(summary_of(made), "popupc: gallery/index.html: 2 designs; 2 made");
    EXPECT_EQ(made.out, "");
    EXPECT_EQ(names_of(files()),
              (std::set<std::string>{".popupc-gallery.jsonl", "designs/a.html", "designs/a.jpg",
                                     "designs/b.html", "designs/b.jpg", "index.html"}));
    const std::string page = index();
    EXPECT_NE(page.find("<h2><a href=\"designs/a.html\">a</a></h2>"), std::string::npos);
    EXPECT_NE(page.find("<img src=\"designs/b.jpg\" alt=\"\" width=\"480\" height=\"360\" loading=\"lazy\""),
              std::string::npos);
    EXPECT_NE(page.find("200\u00a0×\u00a0140\u00a0mm, 1\u00a0piece, 1\u00a0sheet"), std::string::npos);
    EXPECT_NE(page.find("<h1>designs</h1>"), std::string::npos);
    // The page is the one that a build makes.
    const RunResult built = popupc({"build", scratch_ / "designs/a.xml", "-o", scratch_ / "a.html"});
    EXPECT_EQ(built.exit, 0) << built.err;
    EXPECT_EQ(read_file(scratch_ / "a.html"), files()["designs/a.html"]);
}

TEST_F(Gallery, MakesWhatHasChangedAndNothingElse) {
    ASSERT_EQ(make().exit, 0);
    const Files before = files();
    const auto changed = fs::last_write_time(scratch_ / "gallery/index.html");
    EXPECT_EQ(summary_of(make()), "popupc: gallery/index.html: 2 designs; 2 as they were");
    EXPECT_EQ(files(), before);
    EXPECT_EQ(fs::last_write_time(scratch_ / "gallery/index.html"), changed);
    // Times do not count, contents do.
    write("a.xml", card(20));
    EXPECT_EQ(summary_of(make()), "popupc: gallery/index.html: 2 designs; 2 as they were");
    write("a.xml", card(25));
    EXPECT_EQ(make({"--dry-run"}).out, "designs/a.xml\n");
    EXPECT_EQ(files(), before);
    EXPECT_EQ(summary_of(make()), "popupc: gallery/index.html: 2 designs; 1 made; 1 as they were");
    EXPECT_NE(files()["designs/a.html"], before.at("designs/a.html"));
    EXPECT_EQ(files()["designs/b.html"], before.at("designs/b.html"));
    // What is lost is made again.
    fs::remove(scratch_ / "gallery/designs/b.jpg");
    EXPECT_EQ(summary_of(make()), "popupc: gallery/index.html: 2 designs; 1 made; 1 as they were");
    EXPECT_EQ(files()["designs/b.jpg"], before.at("designs/b.jpg"));
}

TEST_F(Gallery, OptionsThatChangePagesMakeThemAgainAndOthersDoNot) {
    ASSERT_EQ(make().exit, 0);
    for (const std::vector<std::string>& same :
         std::vector<std::vector<std::string>>{{"-j", "3"},
                                               {"--verbose"},
                                               {"--color", "always"},
                                               {"--title", "Cards"},
                                               {"--message-format", "short"}}) {
        EXPECT_NE(summary_of(make(same)).find("; 2 as they were"), std::string::npos) << same.front();
    }
    EXPECT_EQ(count_of(index(), "<h1>designs</h1>"), 1U);
    EXPECT_NE(summary_of(make({"--sheet", "a3"})).find("; 2 made"), std::string::npos);
    EXPECT_NE(summary_of(make({"--sheet", "a3"})).find("; 2 as they were"), std::string::npos);
    EXPECT_NE(summary_of(make({"--sheet", "a3", "--profile", "k40"})).find("; 2 made"), std::string::npos);
    // A configuration counts by what it says.
    write_file(scratch_ / "designs/popupc.toml", "sheet = \"a4\"\n");
    RunOptions options;
    options.directory = scratch_.path();
    options.environment["POPUPC_NO_CONFIG"] = "";
    const std::vector<std::string> words{"gallery", "designs", "-o", "gallery"};
    EXPECT_NE(summary_of(popupc(words, options)).find("; 2 made"), std::string::npos);
    EXPECT_NE(summary_of(popupc(words, options)).find("; 2 as they were"), std::string::npos);
    EXPECT_NE(summary_of(make({"--sheet", "a4"})).find("; 2 as they were"), std::string::npos)
        << "it does not matter where a setting stands";
}

TEST_F(Gallery, WhatDesignsLoadCounts) {
    write(
        "lib.fl",
        "define part(w)\n  forward(w) left(90) forward(10) left(90) forward(w) left(90) forward(10)\ndone\n");
    write("p.fl", "load(\"lib.fl\")\npart(40)\n");
    const RunResult first = make();
    EXPECT_EQ(first.exit, 0) << first.err;
    // What only defines functions is no design.
    EXPECT_EQ(summary_of(first), "popupc: gallery/index.html: 3 designs; 4 made");
    EXPECT_EQ(summary_of(make()), "popupc: gallery/index.html: 3 designs; 4 as they were");
    write(
        "lib.fl",
        "define part(w)\n  forward(w) left(90) forward(20) left(90) forward(w) left(90) forward(20)\ndone\n");
    EXPECT_EQ(summary_of(make()), "popupc: gallery/index.html: 3 designs; 2 made; 2 as they were");
}

// Folders are what they are, wherever they are named from.
TEST_F(Gallery, FoldersThatProgramsLoadFromCount) {
    const auto library = [](int height) {
        return "define part(w)\n  forward(w) left(90) forward(" + std::to_string(height) +
               ") left(90) forward(w) left(90) forward(" + std::to_string(height) + ")\ndone\n";
    };
    write("p.fl", "load(\"lib.fl\")\npart(40)\n");
    for (const int height : {10, 20}) {
        const fs::path folder = scratch_ / ("from" + std::to_string(height));
        fs::create_directories(folder / "inc");
        write_file(folder / "inc/lib.fl", library(height));
    }
    const auto made_from = [&](const std::string& folder, const std::string& include) {
        RunOptions options;
        options.directory = scratch_ / folder;
        return summary_of(popupc({"gallery", "../designs", "-o", "../gallery", "-I", include}, options));
    };
    EXPECT_NE(made_from("from10", "inc").find("; 3 made"), std::string::npos);
    EXPECT_NE(made_from("from10", "../from10/./inc").find("; 3 as they were"), std::string::npos);
    EXPECT_EQ(made_from("from20", "inc").find("; 3 as they were"), std::string::npos) << "another library";
}

TEST_F(Gallery, DesignsThatAreGoneLoseTheirFiles) {
    write_file(scratch_ / "gallery-of-mine.txt", "mine");
    ASSERT_EQ(make().exit, 0);
    write_file(scratch_ / "gallery/notes.txt", "mine");
    write_file(scratch_ / "gallery/designs/c.html", "mine");
    fs::remove(scratch_ / "designs/a.xml");
    EXPECT_EQ(summary_of(make()),
              "popupc: gallery/index.html: 1 design; 1 as they were; 2 old files taken away");
    EXPECT_EQ(names_of(files()),
              (std::set<std::string>{".popupc-gallery.jsonl", "designs/b.html", "designs/b.jpg",
                                     "designs/c.html", "index.html", "notes.txt"}));
    EXPECT_EQ(index().find("designs/a.html"), std::string::npos);
    // A page that was changed by hand is somebody's.
    write_file(scratch_ / "gallery/designs/b.html", "mine");
    fs::remove(scratch_ / "designs/b.xml");
    write("d.xml", card(22));
    const RunResult kept = make();
    EXPECT_NE(
        kept.err.find("gallery/designs/b.html is no page of the gallery any more, and stays: it was changed"),
        std::string::npos)
        << kept.err;
    EXPECT_EQ(files()["designs/b.html"], "mine");
    EXPECT_EQ(names_of(files()).count("designs/b.jpg"), 0U);
}

TEST_F(Gallery, DesignsWithErrorsShowThem) {
    write("c.xml", kWrongCard);
    const RunResult made = make();
    EXPECT_EQ(made.exit, 1);
    EXPECT_EQ(count_of(made.err, "designs/c.xml:1:"), 1U) << made.err;
    EXPECT_EQ(summary_of(made), "popupc: gallery/index.html: 3 designs, 1 with errors; 3 made");
    EXPECT_EQ(names_of(files()).count("designs/c.jpg"), 0U);
    EXPECT_NE(index().find("<div class=\"told\"><p>"), std::string::npos);
    EXPECT_NE(index().find("<h2><a href=\"designs/c.html\">c</a></h2>"), std::string::npos);
    EXPECT_NE(files()["designs/c.html"].find("<span class=\"error\">error</span>"), std::string::npos);
    EXPECT_NE(files()["designs/c.html"].find("<a href=\"../index.html\">"), std::string::npos);
    // An error is told again until it is mended.
    const RunResult again = make();
    EXPECT_EQ(again.exit, 1);
    EXPECT_EQ(count_of(again.err, "designs/c.xml:1:"), 1U);
    EXPECT_EQ(summary_of(again), "popupc: gallery/index.html: 3 designs, 1 with errors; 3 as they were");
    write("c.xml", card(24));
    EXPECT_EQ(make().exit, 0);
    EXPECT_EQ(names_of(files()).count("designs/c.jpg"), 1U);
    write("c.xml", kWrongCard);
    EXPECT_EQ(make().exit, 1);
    EXPECT_EQ(names_of(files()).count("designs/c.jpg"), 0U) << "its picture is of another card";
}

TEST_F(Gallery, WarningsAreToldOnceAndToMachinesAlways) {
    write("w.xml", doubtful_card());
    const RunResult first = make();
    EXPECT_EQ(first.exit, 0);
    EXPECT_EQ(count_of(first.err, "warning: "), 1U) << first.err;
    EXPECT_NE(index().find("<p class=\"findings\">1 warning</p>"), std::string::npos);
    EXPECT_EQ(count_of(make().err, "warning: "), 0U);
    EXPECT_EQ(make({"--verbose"}).err.find(first.err.substr(0, first.err.find("popupc: "))), 0U)
        << "as it was the first time";
    EXPECT_EQ(count_of(make({"--message-format", "json"}).out, "\"severity\":\"warning\""), 1U);
    EXPECT_EQ(make({"--werror"}).exit, 1);
}

TEST_F(Gallery, UnreadableDesignsAreExitTwoAndNothingIsTakenForGone) {
    if (::geteuid() == 0) {
        // Nothing is unreadable for root, but for links that lead nowhere.
        fs::create_symlink("nowhere", scratch_ / "designs/l.xml");
    } else {
        write("l.xml", card(20));
        fs::permissions(scratch_ / "designs/l.xml", fs::perms::none);
    }
    const RunResult made = make();
    EXPECT_EQ(made.exit, 2);
    EXPECT_NE(made.err.find("designs/l.xml: error: cannot be read"), std::string::npos) << made.err;
    EXPECT_EQ(count_of(index(), "<h2>"), 3U);
}

TEST_F(Gallery, AnEmptyLibraryLeavesTheGalleryAsItWas) {
    ASSERT_EQ(make().exit, 0);
    const Files before = files();
    fs::rename(scratch_ / "designs", scratch_ / "elsewhere");
    fs::create_directory(scratch_ / "designs");
    const RunResult none = make();
    EXPECT_EQ(none.exit, 1);
    EXPECT_NE(none.err.find("[no-designs]"), std::string::npos) << none.err;
    EXPECT_NE(none.err.find("gallery/index.html stays as it was"), std::string::npos) << none.err;
    EXPECT_EQ(files(), before);
}

TEST_F(Gallery, NothingOfAnybodysIsOverwritten) {
    fs::create_directories(scratch_ / "gallery/designs");
    write_file(scratch_ / "gallery/index.html", "mine");
    RunResult refused = make();
    EXPECT_EQ(refused.exit, 2);
    EXPECT_EQ(refused.err,
              "popupc: error: gallery/index.html is there, and no gallery of popupc's has written it\n"
              "  hint: move the file away, or name another directory\n");
    fs::remove(scratch_ / "gallery/index.html");
    write_file(scratch_ / "gallery/designs/b.jpg", "mine");
    refused = make();
    EXPECT_EQ(refused.exit, 2);
    EXPECT_EQ(files(), (Files{{"designs/b.jpg", "mine"}}));
    fs::remove(scratch_ / "gallery/designs/b.jpg");
    write_file(scratch_ / "gallery/.popupc-gallery.jsonl", "mine\n");
    refused = make();
    EXPECT_EQ(refused.exit, 2);
    EXPECT_EQ(files(), (Files{{".popupc-gallery.jsonl", "mine\n"}}));
    fs::remove(scratch_ / "gallery/.popupc-gallery.jsonl");

    ASSERT_EQ(make().exit, 0);
    write_file(scratch_ / "gallery/index.html", "mine");
    refused = make();
    EXPECT_EQ(refused.exit, 2);
    EXPECT_NE(
        refused.err.find("gallery/index.html was changed since the gallery was made, and is not overwritten"),
        std::string::npos);
    EXPECT_EQ(index(), "mine");
    fs::remove(scratch_ / "gallery/index.html");
    write_file(scratch_ / "gallery/designs/b.html", "mine");
    refused = make();
    EXPECT_EQ(refused.exit, 2);
    EXPECT_NE(refused.err.find(
                  "gallery/designs/b.html was changed since the gallery was made, and is not overwritten "
                  "[unwritable-output]"),
              std::string::npos)
        << refused.err;
    EXPECT_EQ(files()["designs/b.html"], "mine");
    EXPECT_EQ(count_of(index(), "<h2>"), 2U) << "its tile is there, and leads to what is there";
}

TEST_F(Gallery, WrongUsageIsRefused) {
    const auto refused = [this](const std::vector<std::string>& words, const std::string& why) {
        RunOptions options;
        options.directory = scratch_.path();
        std::vector<std::string> all{"gallery"};
        all.insert(all.end(), words.begin(), words.end());
        const RunResult result = popupc(all, options);
        EXPECT_EQ(result.exit, 2) << why;
        EXPECT_NE(result.err.find(why), std::string::npos) << result.err;
        EXPECT_FALSE(fs::exists(scratch_ / "gallery"));
    };
    refused({"designs"}, "a gallery needs a directory: name one with -o");
    refused({"designs", "-o", ""}, "a gallery needs a directory");
    refused({"-", "-o", "gallery"}, "a gallery is made of files, and standard input is none");
    refused({"designs", "-o", "designs"},
            "designs/a.xml is an input, and lies in designs, where the gallery would be");
    refused({"designs", "-o", "."}, "is an input, and lies in .");
    refused({"designs", "-o", "designs/a.xml"}, "this is no directory");
    refused({"designs", "-o", "gallery", "--diagnostics", "designs/a.xml"}, "--diagnostics would overwrite");
    write_file(scratch_ / "nothing.txt", "");
    refused({"designs", "nothing.txt", "-o", "gallery"}, "nothing.txt");
    refused({"designs", "-o", "gallery", "--dpi", "300"}, "--dpi");
    EXPECT_EQ(read_file(scratch_ / "designs/a.xml"), card(20));
}

TEST_F(Gallery, MayLieAmongTheDesigns) {
    RunOptions options;
    options.directory = scratch_ / "designs";
    EXPECT_EQ(popupc({"gallery", ".", "-o", "gallery"}, options).exit, 0);
    const RunResult again = popupc({"gallery", ".", "-o", "gallery"}, options);
    EXPECT_EQ(summary_of(again), "popupc: gallery/index.html: 2 designs; 2 as they were");
}

TEST_F(Gallery, TheSameLibraryGivesTheSameBytes) {
    fs::create_directories(scratch_ / "designs/deep/er");
    write("deep/er/c.xml", card(26));
    write("deep/w.xml", doubtful_card());
    write("wrong.xml", kWrongCard);
    write("p.fl",
          "print(\"hello\")\nforward(40) left(90) forward(10) left(90) forward(40) left(90) forward(10)\n");
    EXPECT_EQ(make({"-j1"}).exit, 1);
    const Files first = files();
    // From elsewhere, with more processes, with the inputs in other words, and by another way there.
    RunOptions options;
    options.directory = scratch_ / "designs/deep";
    const std::string top = scratch_.path();
    EXPECT_EQ(popupc({"gallery", "-j3", ".", "..", "-o", top + "/other"}, options).exit, 1);
    const Files second = files_below(scratch_ / "other");
    EXPECT_EQ(names_of(second), names_of(first));
    for (const auto& [name, bytes] : first) EXPECT_TRUE(second.at(name) == bytes) << name;
    write("a.xml", card(33));
    write("extra.xml", card(34));
    EXPECT_EQ(make().exit, 1);
    write("a.xml", card(20));
    fs::remove(scratch_ / "designs/extra.xml");
    EXPECT_EQ(make().exit, 1);
    for (const auto& [name, bytes] : first) EXPECT_TRUE(files()[name] == bytes) << name;
    EXPECT_EQ(names_of(files()), names_of(first));
}

TEST_F(Gallery, HostileNamesAreTextAndNeverCollide) {
    const std::vector<std::string> names{"<script>alert(1)<\xe2\x81\x84script>.xml",
                                         "\"onload=alert(1) x=\".xml",
                                         "line\nbreak.xml",
                                         "\xff\xfe.xml",
                                         "A.xml",

                                         "{{tiles}}.xml",
                                         "&amp;.xml",
                                         "-.xml",
                                         "--help.xml",
                                         "a.b.xml",
                                         "\xe2\x80\xae.xml"};
    for (const std::string& name : names) write(name, card(20));
    fs::create_directories(scratch_ / "designs/<b>");
    write("<b>/a.xml", card(20));
    const RunResult made = make();
    EXPECT_EQ(made.exit, 0) << made.err;
    const std::string page = index();
    EXPECT_EQ(count_of(page, "<h2>"), names.size() + 3);
    EXPECT_EQ(count_of(page, "<script>"), 1U);
    EXPECT_EQ(count_of(page, "<b>"), 0U);
    EXPECT_EQ(count_of(page, "\"onload"), 0U);
    EXPECT_EQ(page.find('\xff'), std::string::npos);
    std::set<std::string> addresses;
    const std::regex link("<a href=\"([^\"]*)\">");
    for (std::sregex_iterator at(page.begin(), page.end(), link), end; at != end; ++at) {
        EXPECT_TRUE(addresses.insert((*at)[1]).second) << (*at)[1];
        EXPECT_TRUE(std::regex_match((*at)[1].str(), std::regex("designs/[a-z0-9_-]+\\.html"))) << (*at)[1];
        EXPECT_TRUE(fs::exists(scratch_ / "gallery" / (*at)[1].str())) << (*at)[1];
    }
    EXPECT_EQ(addresses.size(), names.size() + 3);
    EXPECT_NE(summary_of(make()).find("; 14 as they were"), std::string::npos) << "whatever their bytes";
}

TEST_F(Gallery, FilesAndDirectoriesAreTakenAsCheckTakesThem) {
    fs::create_directories(scratch_ / "designs/drafts");
    write("drafts/d.xml", card(20));
    write(".popupcignore", "drafts/\n");
    write(".hidden.xml", card(20));
    EXPECT_EQ(summary_of(make()), "popupc: gallery/index.html: 2 designs; 2 made");
    EXPECT_EQ(summary_of(make({"designs/drafts/d.xml"})),
              "popupc: gallery/index.html: 3 designs; 1 made; 2 as they were");
    EXPECT_EQ(summary_of(make({"--exclude", "b.*"})),
              "popupc: gallery/index.html: 1 design; 1 as they were; 4 old files taken away");
}

// Killed at some moment of its run, a gallery has what it had or what it gets, and the next run ends the
// same.
TEST_F(Gallery, AKilledRunLeavesAGalleryThatWorks) {
    const int designs = sanitized_count(30, 3);
    for (int i = 0; i < designs; ++i) write("n" + std::to_string(i) + ".xml", card(20 + i));
    ASSERT_EQ(make().exit, 0);
    for (int i = 0; i < designs; ++i) write("n" + std::to_string(i) + ".xml", card(21 + i, 31));
    fs::remove(scratch_ / "designs/n3.xml");
    write("new.xml", card(33));
    fs::copy(scratch_ / "gallery", scratch_ / "other", fs::copy_options::recursive);
    RunOptions options;
    options.directory = scratch_.path();
    ASSERT_EQ(popupc({"gallery", "designs", "-o", "other"}, options).exit, 0);
    const Files wanted = files_below(scratch_ / "other");
    for (const int signal : {SIGKILL, SIGTERM, SIGINT, SIGKILL}) {
        Background running({kPopupc, "gallery", scratch_ / "designs", "-o", scratch_ / "gallery"});
        std::this_thread::sleep_for(std::chrono::milliseconds(400));
        running.send(signal);
        running.wait();
        const std::string page = index();
        const std::regex link("(?:href|src)=\"(designs/[^\"]*)\"");
        std::size_t links = 0;
        for (std::sregex_iterator at(page.begin(), page.end(), link), end; at != end; ++at, ++links)
            EXPECT_TRUE(fs::exists(scratch_ / "gallery" / (*at)[1].str())) << (*at)[1];
        EXPECT_GE(links, static_cast<std::size_t>(2 * designs + 2));
    }
    const RunResult last = make();
    EXPECT_EQ(last.exit, 0) << last.err;
    EXPECT_EQ(names_of(files()), names_of(wanted));
    for (const auto& [name, bytes] : wanted) EXPECT_TRUE(files()[name] == bytes) << name;
}

}  // namespace
}  // namespace popup::test
