// What a browser makes of the live view.
#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "support/live_view.h"
#include "support/pictures.h"
#include "support/viewer_page.h"

namespace popup::test {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot = POPUP_SOURCE_DIR;

// Before all else: until(question) waits until the answer is yes.
const std::string kUntil =
    "window.until = async (question) => { for (let i = 0; i < 3000 && !question(); ++i) await new "
    "Promise((r) => "
    "setTimeout(r, 20)); return question(); }; window.byId = (id) => document.getElementById(id); "
    "until(() => popupcLive.version() > 0 && scene()); function scene() { return popupc.names().length > 0; "
    "}";
const std::string kState =
    "({viewpoint: popupcLive.viewpoint(), opening: popupc.opening(), edges: byId('edges').checked, tab: "
    "document.querySelector('[role=tab][aria-selected=true]').id})";

class LivePage : public testing::Test {
 protected:
    LivePage() {
        castle = read_file(kRoot / "samples/castle.xml");
        boat = read_file(kRoot / "samples/boat.xml");
        write_file(view.scratch / "card.xml", castle);
        write_file(view.scratch / "castle", castle);
        write_file(view.scratch / "boat", boat);
        write_file(view.scratch / "wrong", "<popup>\n  <wrong\n");
    }
    void SetUp() override {
        if (!have_browser()) GTEST_SKIP() << kNoBrowser;
        ASSERT_NO_FATAL_FAILURE(view.start());
    }
    ~LivePage() override {
        if (view.program) {
            EXPECT_EQ(view.end(SIGTERM), 0);
        }
    }
    // An expression that saves one of these as the card, by a rename.
    [[nodiscard]] std::string save(const std::string& name) const {
        return "$ cd " + view.scratch.path().string() + " && cp " + name + " new && mv new card.xml";
    }
    nlohmann::json look(std::vector<std::string> expressions, const std::string& scheme = "light") {
        expressions.insert(expressions.begin(), kUntil);
        const nlohmann::json driven = drive(profile, view.address, "-", expressions, scheme);
        if (!driven.is_object()) return nlohmann::json::array();
        EXPECT_EQ(messages_of(driven), std::vector<std::string>{});
        return driven.at("values");
    }

    LiveView view;
    ScratchDirectory profile;
    std::string castle, boat;
};

TEST_F(LivePage, ASaveIsShownAndNothingElseChanges) {
    const std::string key = "document.dispatchEvent(new KeyboardEvent('keydown', {";
    const nlohmann::json values =
        look({"document.title",
              key + "key: 'ArrowLeft', shiftKey: true})); " + key +
                  "key: '+'})); byId('edges').click(); "
                  "popupc.setOpening(60); popupc.look; 0",
              kState, save("boat"), "until(() => document.title === 'card' && popupc.names().length < 20)",
              kState, "byId('tab-sheets').click(); " + kState + ".tab", save("castle"),
              "until(() => popupc.names().length > 20)", kState + ".tab",
              "until(() => document.querySelector('#sheets-panel img').src.startsWith('data:image/svg+xml'))",
              "byId('link').hidden && byId('trouble').hidden"});
    ASSERT_EQ(values.size(), 13U);
    EXPECT_EQ(values[0], true);
    EXPECT_EQ(values[1], "card");
    const nlohmann::json& before = values[3];
    EXPECT_EQ(before.at("opening"), 60);
    EXPECT_EQ(before.at("edges"), false);
    EXPECT_EQ(values[5], true);
    EXPECT_EQ(values[6], before) << "viewpoint, opening, switches and tab";
    EXPECT_EQ(values[7], "tab-sheets");
    EXPECT_EQ(values[9], true);
    EXPECT_EQ(values[10], "tab-sheets");
    EXPECT_EQ(values[11], true);
    EXPECT_EQ(values[12], true);
}

TEST_F(LivePage, ErrorsStandOverTheLastPictureUntilTheyAreMended) {
    const std::string trouble =
        "({hidden: byId('trouble').hidden, text: byId('trouble').innerText, stale: "
        "document.documentElement.classList.contains('stale'), plates: popupc.names().length})";
    const std::string place =
        "(({top, bottom}) => [top > 0, bottom < byId('panel').getBoundingClientRect().top])("
        "byId('trouble').getBoundingClientRect())";
    const std::string on_top =
        "(({left, width, top, height}) => byId('trouble').contains(document.elementFromPoint(left + width / "
        "2, "
        "top + height / 2)))(byId('trouble').getBoundingClientRect())";
    const nlohmann::json values =
        look({trouble, save("wrong"), "until(() => !byId('trouble').hidden)", trouble, "document.title",
              place, "byId('tab-findings').click(); byId('findings-panel').innerText.includes('card.xml:2')",
              "$ rm " + (view.scratch / "card.xml").string(),
              "until(() => byId('trouble').innerText.includes('cannot be read'))", save("castle"),
              "until(() => byId('trouble').hidden)", trouble, "document.title", save("wrong"),
              "until(() => !byId('trouble').hidden)", on_top});
    ASSERT_EQ(values.size(), 17U);
    EXPECT_EQ(values[1].at("hidden"), true);
    EXPECT_EQ(values[3], true);
    EXPECT_EQ(values[4].at("stale"), true);
    EXPECT_EQ(values[4].at("plates"), values[1].at("plates")) << "the picture stays";
    const std::string text = values[4].at("text");
    EXPECT_EQ(text.rfind("1 error. The last good picture is shown.", 0), 0U) << text;
    EXPECT_NE(text.find("card.xml:2"), std::string::npos) << text;
    EXPECT_NE(text.find("<wrong"), std::string::npos) << "the line itself: " << text;
    EXPECT_EQ(values[5], "\xe2\x9a\xa0 card");
    EXPECT_EQ(values[6], nlohmann::json({true, true})) << "clear of the slider";
    EXPECT_EQ(values[7], true);
    EXPECT_EQ(values[9], true);
    EXPECT_EQ(values[11], true);
    EXPECT_EQ(values[12].at("stale"), false);
    EXPECT_EQ(values[13], "card");
    EXPECT_EQ(values[16], true) << "seen, and not below the picture";
}

// From a card to a pile of parts that stand, and back; and a design with pictures.
TEST_F(LivePage, OneKindOfDesignFollowsAnother) {
    write_file(view.scratch / "sea.png", png_of(8, 4));
    write_file(view.scratch / "picture",
               "<popup version='3.0' units='mm'><drawnlinelist>"
               "<image href='sea.png' x='0' y='0' width='20'/></drawnlinelist></popup>");
    const nlohmann::json values =
        look({save("picture"), "until(() => popupc.names().length === 2)", save("castle"),
              "until(() => popupc.names().length > 20)", save("picture"),
              "until(() => popupc.names().length === 2)", "popupc.setOpening(10); popupc.opening()",
              "byId('play').click(); until(() => popupc.opening() > 11)", save("castle"),
              "until(() => popupc.names().length > 20)",
              "(async (before) => until(() => popupc.opening() !== before))(popupc.opening())"});
    ASSERT_EQ(values.size(), 12U);
    for (const std::size_t i : {2U, 4U, 6U, 8U, 10U, 11U}) EXPECT_EQ(values[i], true) << i;
    EXPECT_EQ(values[7], 10);
}

TEST_F(LivePage, ManySavesLeaveOneContextAndNoMoreBuffers) {
    // What the page has made and not deleted, in its own context.
    const std::string count =
        "(() => { window.alive = 0; window.made = 0; const gl = byId('model').getContext('webgl2'); for "
        "(const kind of "
        "['Buffer', "
        "'VertexArray', 'Texture', 'Program']) { const make = "
        "WebGL2RenderingContext.prototype[`create${kind}`]; const "
        "drop = WebGL2RenderingContext.prototype[`delete${kind}`]; "
        "WebGL2RenderingContext.prototype[`create${kind}`] = function () { ++alive; ++made; return "
        "make.call(this); "
        "}; "
        "WebGL2RenderingContext.prototype[`delete${kind}`] = function (one) { --alive; return "
        "drop.call(this, one); }; } "
        "return gl !== null; })()";
    std::vector<std::string> expressions{count};
    for (int i = 0; i < 12; ++i) {
        expressions.push_back(save(i % 2 == 0 ? "boat" : "castle"));
        expressions.push_back(i % 2 == 0 ? "until(() => popupc.names().length < 20)"
                                         : "until(() => popupc.names().length > 20)");
        expressions.emplace_back("alive");
    }
    expressions.emplace_back("made");
    const nlohmann::json values = look(expressions);
    ASSERT_EQ(values.size(), expressions.size() + 1);
    EXPECT_EQ(values[1], true);
    EXPECT_EQ(values[7], values[4]) << "each painter gives back what the one before it had";
    EXPECT_EQ(values[37], values[7]);
    EXPECT_GT(values[38].get<int>(), 12 * 5) << "or this counts nothing";
}

TEST_F(LivePage, SaysWhenItsServerHasEnded) {
    const nlohmann::json values =
        look({"byId('link').hidden", "$ kill -INT " + std::to_string(view.program->pid()),
              "until(() => !byId('link').hidden)", "byId('link').textContent"});
    ASSERT_EQ(values.size(), 5U);
    EXPECT_EQ(values[1], true);
    EXPECT_EQ(values[3], true);
    EXPECT_EQ(values[4], "popupc view has ended. What is shown here does not change any more.");
    EXPECT_EQ(view.program->wait(), 0);
}

// A page of somebody else's that knows the address: it cannot read, frame or include what is there.
TEST_F(LivePage, OtherPagesCannotReadIt) {
    write_file(view.scratch / "evil.html", "<!doctype html><title>evil</title>");
    const std::string news = "'" + view.address + "now?after=0'";
    const nlohmann::json driven = drive(
        profile, view.scratch / "evil.html", "-",
        {"fetch(" + news + ").then((r) => r.text(), () => 'refused')",
         "fetch(" + news + ", {mode: 'no-cors'}).then((r) => `${r.type} ${r.status}`, () => 'refused')",
         "new Promise((done) => { const s = document.createElement('script'); s.src = " + news +
             "; s.onload = () => done('loaded'); s.onerror = () => done('refused'); document.head.append(s); "
             "})",
         "new Promise((done) => { const f = document.createElement('iframe'); f.src = '" + view.address +
             "'; f.onload = () => { let seen = 'refused'; try { seen = f.contentDocument ? 'read' : "
             "'refused'; } catch (e) "
             "{} done(seen); }; document.body.append(f); })",
         "window.length"});
    ASSERT_TRUE(driven.is_object());
    const auto& values = driven.at("values");
    for (const std::size_t i : {0U, 1U, 2U, 3U}) EXPECT_EQ(values[i], "refused") << i;
}

TEST_F(LivePage, HasNothingThatAxeCallsSerious) {
    const char* folder = std::getenv("POPUP_AXE");
    const fs::path axe = fs::path(folder == nullptr ? "" : folder) / "node_modules/axe-core/axe.min.js";
    if (folder == nullptr || !fs::exists(axe)) GTEST_SKIP() << "POPUP_AXE names no folder with axe-core";
    const std::string run =
        "axe.run().then((found) => [found.passes.length > 10, found.violations.map((one) => `${one.impact}: "
        "${one.id}: ${one.nodes.map((node) => node.html)}`)])";
    for (const char* scheme : {"light", "dark"}) {
        const nlohmann::json values =
            look({"@" + axe.string(), run, save("wrong"), "until(() => !byId('trouble').hidden)", run,
                  "byId('tab-findings').click()", run, save("castle"), "until(() => byId('trouble').hidden)"},
                 scheme);
        ASSERT_EQ(values.size(), 10U);
        for (const std::size_t i : {2U, 5U, 7U}) {
            EXPECT_EQ(values[i], nlohmann::json({true, nlohmann::json::array()})) << scheme << " " << i;
        }
    }
}

}  // namespace
}  // namespace popup::test
