// What a browser makes of a gallery: search and filters by hand and by key, and all of it without scripts.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "support/run_program.h"
#include "support/viewer_page.h"

namespace popup {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::drive;
using test::messages_of;

const fs::path kSamples = fs::path(POPUP_SOURCE_DIR) / "samples";
const std::string kShown =
    "[...document.querySelectorAll('#tiles > li:not([hidden]) h2')].map((one) => one.textContent)";

class GalleryInABrowser : public testing::Test {
 protected:
    void SetUp() override {
        if (!test::have_browser()) GTEST_SKIP() << test::kNoBrowser;
        fs::create_directories(scratch_ / "designs/<b>");
        for (const char* name : {"castle.xml", "house.xml", "swallow.xml"})
            fs::copy_file(kSamples / name, scratch_ / "designs" / name);
        fs::copy_file(fs::path(POPUP_SOURCE_DIR) / "tests/cases/allow/whole-document.xml",
                      scratch_ / "designs/<b>/\"crossed\".xml");
        test::write_file(scratch_ / "designs/<script>wrong.xml",
                         "<popup version=\"2.0\"><mainpage width=\"ten\"/></popup>");
        const test::RunResult made =
            test::popupc({"gallery", scratch_ / "designs", "-o", scratch_ / "gallery"});
        ASSERT_EQ(made.exit, 1) << made.err;
    }
    [[nodiscard]] std::string page(const std::string& hash = "") const {
        return (scratch_ / "gallery/index.html").string() + hash;
    }
    json ask(const std::vector<std::string>& expressions, const std::string& hash = "",
             const std::string& scheme = "light", int width = 800) {
        const json driven = drive(scratch_, page(hash), "-", expressions, scheme, width);
        EXPECT_TRUE(driven.is_object());
        if (!driven.is_object()) return {};
        EXPECT_EQ(messages_of(driven), std::vector<std::string>{});
        return driven.at("values");
    }

    test::ScratchDirectory scratch_;
};

const json kAll{"\"crossed\"", "<script>wrong", "castle", "house", "swallow"};

TEST_F(GalleryInABrowser, IsSearchedAndFilteredByKeys) {
    const json values = ask({kShown,
                             "document.activeElement.id",
                             "press Tab",
                             "document.activeElement.id",
                             "type CAST",
                             kShown,
                             "document.getElementById('shown').textContent",
                             "location.hash",
                             "press Enter",
                             "document.activeElement.textContent",
                             "press Shift+Tab",
                             "press Shift+Tab",
                             "press Shift+Tab",
                             "press Shift+Tab",
                             "press Shift+Tab",
                             "press Shift+Tab",
                             "document.activeElement.id",
                             "press t",
                             "document.activeElement.value",
                             kShown});
    ASSERT_EQ(values.size(), 20U);
    EXPECT_EQ(values[0], kAll);
    EXPECT_EQ(values[1], "");
    EXPECT_EQ(values[3], "words") << "the search is the first that has the focus";
    EXPECT_EQ(values[5], json{"castle"});
    EXPECT_EQ(values[6], "1 of 5 shown");
    EXPECT_EQ(values[7], "#words=CAST");
    EXPECT_EQ(values[9], "castle") << "Enter leads to the first that is found";
    EXPECT_EQ(values[16], "element");
    EXPECT_EQ(values[18], "tent");
    EXPECT_EQ(values[19], json::array()) << "the castle has no tent";
}

TEST_F(GalleryInABrowser, AddressesSayWhatIsLookedFor) {
    const auto shown = [this](const std::string& hash) { return ask({kShown}, hash)[0]; };
    EXPECT_EQ(shown("#element=tent"), (json{"\"crossed\"", "house"}));
    EXPECT_EQ(shown("#element=tent&words=hous"), json{"house"});
    EXPECT_EQ(shown("#finding=error"), json{"<script>wrong"});
    EXPECT_EQ(shown("#from=300"), json::array());
    EXPECT_EQ(shown("#from=253&to=255"), (json{"castle", "house"}));
    EXPECT_EQ(shown("#element=<img src=x>"), kAll) << "what the gallery does not have is not asked for";
    EXPECT_EQ(shown("#finding=none"), (json{"castle", "house", "swallow"}));
    EXPECT_EQ(shown("#finding=warning"), (json{"\"crossed\"", "<script>wrong"}));
    EXPECT_EQ(shown("#order=pieces")[0], "house");
    EXPECT_EQ(shown("#words=step+castle"), json{"castle"});
}

TEST_F(GalleryInABrowser, ClearShowsAllAndTilesLeadToTheirPages) {
    const json values =
        ask({"document.querySelector('button[type=reset]').click(); " +
                 test::when(kShown + ".length > 1", kShown),
             "location.hash",
             // Those that lie further down would wait until they are looked at.
             "Promise.all([...document.images].map((one) => { one.loading = 'eager'; "
             "return one.decode().then(() => one.naturalWidth); }))",
             "document.querySelector('#none').hidden",
             "(() => { const picture = document.querySelector('img[src*=castle]'); picture.scrollIntoView(); "
             "const "
             "box = picture.getBoundingClientRect(); return document.elementFromPoint(box.x + box.width / 2, "
             "box.y + "
             "box.height / 2).getAttribute('href'); })()"},
            "#words=castle&element=step");
    EXPECT_EQ(values[0], kAll);
    EXPECT_EQ(values[1], "");
    EXPECT_EQ(values[2], (json{480, 480, 480, 480}));
    EXPECT_EQ(values[3], true);
    EXPECT_EQ(values[4], "designs/castle.html") << "all of a tile is its link";
}

TEST_F(GalleryInABrowser, WithoutScriptsAllTilesAreThere) {
    const json values =
        ask({kShown, "getComputedStyle(document.getElementById('filter')).display",
             "[...document.querySelectorAll('#tiles a')].every((one) => one.offsetParent !== null)"},
            "#words=castle", "light,no-script");
    EXPECT_EQ(values[0], kAll);
    EXPECT_EQ(values[1], "none");
    EXPECT_EQ(values[2], true);
}

TEST_F(GalleryInABrowser, FitsIntoTheWidthOfAPhone) {
    for (const int width : {320, 390, 1280}) {
        const json values =
            ask({"document.documentElement.scrollWidth",
                 "[...document.querySelectorAll('input, select, button, #tiles > li')].every((one) => "
                 "one.getBoundingClientRect().right <= innerWidth)"},
                "", "light", width);
        EXPECT_LE(values[0].get<int>(), width);
        EXPECT_EQ(values[1], true) << width;
    }
}

// axe-core looks for what people who see, hear or move less cannot use. POPUP_AXE: where npm has put it.
TEST_F(GalleryInABrowser, HasNothingThatAxeCallsSerious) {
    const char* folder = std::getenv("POPUP_AXE");
    const fs::path axe = fs::path(folder == nullptr ? "" : folder) / "node_modules/axe-core/axe.min.js";
    if (folder == nullptr || !fs::exists(axe)) GTEST_SKIP() << "POPUP_AXE names no folder with axe-core";
    const std::string look =
        "axe.run().then((found) => [found.passes.length > 10, found.violations.map((one) => `${one.impact}: "
        "${one.id}: ${one.nodes.map((node) => node.html)}`)])";
    const json clean{true, json::array()};
    fs::path wrong;
    for (const auto& entry : fs::directory_iterator(scratch_ / "gallery/designs")) {
        if (entry.path().filename().string().starts_with("script-wrong")) wrong = entry.path();
    }
    for (const char* scheme : {"light", "dark"}) {
        EXPECT_EQ(ask({"@" + axe.string(), look}, "", scheme)[1], clean) << scheme;
        EXPECT_EQ(ask({"@" + axe.string(), look}, "#words=nothing", scheme, 390)[1], clean) << scheme;
        const json driven = drive(scratch_, wrong, "-", {"@" + axe.string(), look}, scheme);
        EXPECT_EQ(driven.at("values")[1], clean) << scheme;
        EXPECT_EQ(messages_of(driven), std::vector<std::string>{});
    }
}

}  // namespace
}  // namespace popup
