// What a browser makes of the viewer's page.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "popup/image.h"
#include "support/run_program.h"
#include "support/viewer_page.h"

namespace popup {
namespace {

namespace fs = std::filesystem;
using test::drive;
using test::messages_of;
using test::popupc;
using test::RunResult;
using test::scene_of;
using test::ScratchDirectory;

const fs::path kRoot = POPUP_SOURCE_DIR;

// How many colours of 32 a channel a picture shows within these parts of its width and height.
std::size_t colours_of(const fs::path& png) {
    const auto opened = open_image(test::read_file(png));
    if (!std::holds_alternative<Image>(opened)) return 0;
    const auto pixels = pixels_of(std::get<Image>(opened));
    if (!pixels) return 0;
    std::vector<bool> seen(32 * 32 * 32, false);
    for (int y = pixels->height / 5; y < 4 * pixels->height / 5; ++y) {
        for (int x = pixels->width / 5; x < 4 * pixels->width / 5; ++x) {
            const std::uint8_t* p = &pixels->rgba[4 * static_cast<std::size_t>(y * pixels->width + x)];
            seen[static_cast<std::size_t>((p[0] / 8 * 32 + p[1] / 8) * 32 + p[2] / 8)] = true;
        }
    }
    return static_cast<std::size_t>(std::count(seen.begin(), seen.end(), true));
}

class ViewerInABrowser : public testing::TestWithParam<std::string> {
 protected:
    void SetUp() override {
        if (!test::have_browser()) GTEST_SKIP() << test::kNoBrowser;
    }
};

TEST_P(ViewerInABrowser, PlatesAreWhereTheMotionSaysAndThePictureIsNotBlank) {
    const ScratchDirectory scratch;
    const std::string& sample = GetParam();
    std::vector<std::string> words = test::words_for_sample(sample, scratch / "a.html");
    const RunResult built = popupc(words);
    ASSERT_EQ(built.exit, 0) << built.err;
    words = test::words_for_sample(sample, "");
    words.erase(std::find(words.begin(), words.end(), "-o"), std::find(words.begin(), words.end(), "") + 1);
    words.insert(words.end(), {"--angles", "12.5,47,83", "--emit", "motion"});
    const RunResult told = popupc(words);
    ASSERT_EQ(told.exit, 0) << told.err;
    const auto motion = nlohmann::json::parse(told.out);

    // Keys are those of the page's own run, so these openings lie between them.
    std::vector<std::string> expressions;
    std::vector<const nlohmann::json*> frames;
    for (const auto& frame : motion.at("frames")) {
        expressions.push_back("popupc.setOpening(" + frame.at("angle_deg").dump() +
                              "); Object.fromEntries(popupc.names().map((n) => [n, popupc.frameOf(n)]))");
        frames.push_back(&frame);
    }
    ASSERT_GE(frames.size(), 3U);
    const nlohmann::json driven = drive(scratch, scratch / "a.html", scratch / "a.png", expressions);
    ASSERT_TRUE(driven.is_object());
    EXPECT_EQ(messages_of(driven), std::vector<std::string>{});
    EXPECT_GT(colours_of(scratch / "a.png"), 20U);
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const auto& plates = driven.at("values").at(i);
        ASSERT_EQ(plates.size(), frames[i]->at("plates").size());
        for (const auto& plate : frames[i]->at("plates")) {
            const auto& shown = plates.at(plate.at("name").get<std::string>());
            const auto& frame = plate.at("frame");
            double furthest = 0.0;
            // The origin, and points 100 mm along the axes.
            for (int k = -1; k < 3; ++k) {
                double square = 0.0;
                for (std::size_t j = 0; j < 3; ++j) {
                    double there = frame.at("origin")[j].get<double>();
                    double here = shown.at("origin")[j].get<double>();
                    if (k >= 0) {
                        const auto axis = static_cast<std::size_t>(k);
                        there += 100.0 * frame.at("axes")[axis][j].get<double>();
                        here += 100.0 * shown.at("axes")[3 * axis + j].get<double>();
                    }
                    square += (here - there) * (here - there);
                }
                furthest = std::max(furthest, std::sqrt(square));
            }
            EXPECT_LT(furthest, 0.5) << plate.at("name") << " at " << frames[i]->at("angle_deg");
        }
    }
}

std::string test_name(const testing::TestParamInfo<std::string>& info) {
    std::string name = info.param;
    std::replace_if(
        name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
    return name;
}
INSTANTIATE_TEST_SUITE_P(Samples, ViewerInABrowser,
                         testing::Values("castle.xml", "harbour.xml", "villa.oa", "folded/town.svg"),
                         test_name);

TEST(ViewerKeys, OpenPlayTurnAndReset) {
    if (!test::have_browser()) GTEST_SKIP() << test::kNoBrowser;
    const ScratchDirectory scratch;
    ASSERT_EQ(popupc({"build", "-q", kRoot / "tests/cases/allow/whole-document.xml", "--allow", "collision",
                      "-o", scratch / "a.html"})
                  .exit,
              0);
    const std::string press = "document.dispatchEvent(new KeyboardEvent('keydown', {key: '";
    const std::string named = "document.querySelector('#name').textContent === popupc.nameAt(400, 290)";
    const nlohmann::json driven =
        drive(scratch, (scratch / "a.html").string() + "#view=front&at=30", "-",
              {"popupc.opening()", press + "ArrowRight'})); popupc.opening()",
               press + "ArrowLeft'})); popupc.opening()",
               press + " '})); " + test::when("popupc.opening() > 31", "popupc.opening() > 31"),
               press + "r'})); popupc.opening()", "document.querySelectorAll('#marks button').length",
               "document.querySelector('#marks button').click(); popupc.names().filter((n) => "
               "popupc.collides(n)).length",
               "popupc.setOpening(90); popupc.look('top'); popupc.nameAt(400, 60 + 230) !== null",
               "popupc.nameAt(2, 70)",
               "document.querySelector('#opening').value = 120; "
               "document.querySelector('#opening').dispatchEvent(new "
               "Event('input')); popupc.opening()",
               "document.querySelector('#degrees').textContent",
               "document.querySelector('#model').dispatchEvent(new PointerEvent('pointermove', {clientX: "
               "400, clientY: "
               "290})); " +
                   test::when(named, named)},
              "dark");
    ASSERT_TRUE(driven.is_object());
    EXPECT_EQ(messages_of(driven), std::vector<std::string>{});
    const auto& values = driven.at("values");
    EXPECT_EQ(values[0], 30);
    EXPECT_EQ(values[1], 31);
    EXPECT_EQ(values[2], 30);
    EXPECT_EQ(values[3], true);
    EXPECT_EQ(values[4], 130);
    EXPECT_GE(values[5].get<int>(), 1);
    EXPECT_GE(values[6].get<int>(), 2);
    EXPECT_EQ(values[7], true);
    EXPECT_EQ(values[8], nullptr);
    EXPECT_EQ(values[9], 120);
    EXPECT_EQ(values[10], "120°");
    EXPECT_EQ(values[11], true);
}

TEST(ViewerKeys, ASpaceOnASwitchSwitches) {
    if (!test::have_browser()) GTEST_SKIP() << test::kNoBrowser;
    const ScratchDirectory scratch;
    ASSERT_EQ(popupc({"build", "-q", kRoot / "samples/castle.xml", "-o", scratch / "a.html"}).exit, 0);
    const std::string playing = "document.querySelector('#play').getAttribute('aria-label')";
    const nlohmann::json driven =
        drive(scratch, scratch / "a.html", "-",
              {"document.querySelector('#edges').focus(); document.querySelector('#edges').checked",
               "press  ", "document.querySelector('#edges').checked", playing,
               "document.querySelector('#opening').focus(); 0", "press  ", playing});
    ASSERT_TRUE(driven.is_object());
    const auto& values = driven.at("values");
    EXPECT_EQ(values[0], true);
    EXPECT_EQ(values[2], false);
    EXPECT_EQ(values[3], "Play");
    EXPECT_EQ(values[6], "Pause");
}

// Of the page in this size: whether all buttons above the model end before it begins, whether anything of the
// model comes to the edges of where it is drawn, and whether any of it is seen.
constexpr const char* kFreePart = R"js((() => {
  const box = document.getElementById('model').getBoundingClientRect();
  const above = [...document.querySelectorAll('#tools button, #tools label, #tools summary, header *')];
  const ends = above.map((one) => one.getBoundingClientRect().bottom);
  const meets = (x, y) => popupc.nameAt(box.left + x, box.top + y) !== null;
  let edge = 0;
  let seen = 0;
  for (let x = 0; x < box.width; x += 4) edge += meets(x, 1) + meets(x, box.height - 2);
  for (let y = 0; y < box.height; y += 4) edge += meets(1, y) + meets(box.width - 2, y);
  for (let y = 0; y < box.height; y += 10) for (let x = 0; x < box.width; x += 10) seen += meets(x, y);
  return [Math.max(...ends) <= box.top + 0.5, edge, seen > 20, box.bottom <= innerHeight];
})())js";

TEST(ViewerWindow, HasTheModelInTheFreePartWhateverItsSize) {
    if (!test::have_browser()) GTEST_SKIP() << test::kNoBrowser;
    const ScratchDirectory scratch;
    // Whatever its title, too.
    std::string title;
    for (int i = 0; i < 20; ++i) title += "long words ";
    test::write_file(scratch / (title + ".fl"),
                     test::read_file(kRoot / "samples/cartons/straight-tuck-end.fl"));
    ASSERT_EQ(popupc({"build", "-q", scratch / (title + ".fl"), "-o", scratch / "a.html"}).exit, 0);
    const std::vector<std::pair<int, int>> sizes{{1200, 800}, {400, 700}, {800, 350}};
    for (const auto& [width, height] : sizes) {
        const nlohmann::json driven =
            drive(scratch, (scratch / "a.html").string() + "#view=front&at=0", "-",
                  {kFreePart, std::string("popupc.setOpening(180); ") + kFreePart}, "light", width, height);
        ASSERT_TRUE(driven.is_object());
        for (const auto& value : driven.at("values"))
            EXPECT_EQ(value.dump(), "[true,0,true,true]") << width << " × " << height;
    }
}

// ---- what is there beside the model

TEST(ViewerTabs, ShowTheSheetsOfTheSvgOutputAndTheFindings) {
    if (!test::have_browser()) GTEST_SKIP() << test::kNoBrowser;
    const ScratchDirectory scratch;
    ASSERT_EQ(
        popupc({"build", "-q", kRoot / "samples/cake.xml", "-o", scratch / "a.html", "-o", scratch / "a.svg"})
            .exit,
        0);
    const std::string shown =
        "['model', 'sheets', 'findings'].filter((n) => !document.getElementById(`${n}-panel`).hidden)";
    const std::string press =
        "document.activeElement.dispatchEvent(new KeyboardEvent('keydown', {bubbles: true, key: '";
    const nlohmann::json driven =
        drive(scratch, scratch / "a.html", "-",
              {shown, "document.querySelector('#tab-model').focus(); " + press + "ArrowRight'})); " + shown,
               test::when(test::kSheetsDrawn,
                          "[...document.querySelectorAll('#sheets-panel img')].map((i) => [i.naturalWidth > "
                          "100, decodeURIComponent(i.src.slice(i.src.indexOf(',') + 1))])"),
               "popupc.opening()", press + "ArrowRight'})); " + shown, "document.activeElement.id",
               press + "ArrowRight'})); " + shown});
    ASSERT_TRUE(driven.is_object());
    EXPECT_EQ(messages_of(driven), std::vector<std::string>{});
    const auto& values = driven.at("values");
    EXPECT_EQ(values[0], nlohmann::json({"model"}));
    EXPECT_EQ(values[1], nlohmann::json({"sheets"}));
    ASSERT_EQ(values[2].size(), 2U);
    EXPECT_EQ(values[2][0], nlohmann::json({true, test::read_file(scratch / "a.svg")}));
    EXPECT_EQ(values[2][1], nlohmann::json({true, test::read_file(scratch / "a-2.svg")}));
    EXPECT_EQ(values[3], 130) << "arrows on tabs open nothing";
    EXPECT_EQ(values[4], nlohmann::json({"findings"}));
    EXPECT_EQ(values[5], "tab-findings");
    EXPECT_EQ(values[6], nlohmann::json({"model"}));
}

// Pages of a PDF, as pictures.
std::vector<fs::path> pages_of(const ScratchDirectory& scratch, const fs::path& pdf) {
    EXPECT_EQ(test::run({"pdftoppm", "-r", "40", "-png", pdf, scratch / "page"}).exit, 0);
    std::vector<fs::path> made;
    for (const auto& entry : fs::directory_iterator(scratch.path())) {
        if (entry.path().extension() == ".png") made.push_back(entry.path());
    }
    return made;
}

TEST(ViewerPrint, HasTheModelAsItStandsOrAllSheets) {
    if (!test::have_browser()) GTEST_SKIP() << test::kNoBrowser;
    if (!test::have_program("pdftoppm")) GTEST_SKIP() << "no pdftoppm (Debian package poppler-utils)";
    const ScratchDirectory scratch;
    ASSERT_EQ(popupc({"build", "-q", kRoot / "samples/castle.xml", "-o", scratch / "a.html"}).exit, 0);
    ASSERT_TRUE(drive(scratch, scratch / "a.html", scratch / "model.pdf", {}).is_object());
    const std::vector<fs::path> model = pages_of(scratch, scratch / "model.pdf");
    ASSERT_EQ(model.size(), 1U);
    EXPECT_GE(colours_of(model.front()), 20U) << "plates, as the light falls on them";
    fs::remove(model.front());
    const nlohmann::json sheets =
        drive(scratch, scratch / "a.html", scratch / "sheets.pdf",
              {"document.querySelector('#tab-sheets').click(); 0",
               test::when(test::kSheetsDrawn, "document.querySelectorAll('#sheets-panel img').length")},
              "dark");
    ASSERT_TRUE(sheets.is_object());
    EXPECT_EQ(pages_of(scratch, scratch / "sheets.pdf").size(), sheets.at("values")[1]);
}

TEST(ViewerStill, IsShownWhereThereIsNoWebGlAndWhereThereAreNoScripts) {
    if (!test::have_browser()) GTEST_SKIP() << test::kNoBrowser;
    const ScratchDirectory scratch;
    ASSERT_EQ(popupc({"build", "-q", kRoot / "samples/castle.xml", "-o", scratch / "a.html"}).exit, 0);
    const std::string seen =
        "(() => { const still = document.getElementById('still'); return [still.naturalWidth, "
        "still.clientHeight > 100, still.alt, document.getElementById('message').hidden, "
        "document.getElementById('model').hidden, document.querySelectorAll('section[hidden]').length]; })()";
    const nlohmann::json plain = drive(scratch, scratch / "a.html", "-", {seen});
    const nlohmann::json no_webgl = drive(scratch, scratch / "a.html", "-", {seen}, "light,no-webgl");
    const nlohmann::json no_script = drive(scratch, scratch / "a.html", "-", {seen}, "light,no-script");
    ASSERT_TRUE(plain.is_object() && no_webgl.is_object() && no_script.is_object());
    const char* text = "A picture of the model, open at 90 degrees";
    EXPECT_EQ(plain.at("values")[0], nlohmann::json({480, false, text, true, false, 2}));
    EXPECT_EQ(no_webgl.at("values")[0], nlohmann::json({480, true, text, false, true, 2}));
    EXPECT_EQ(no_script.at("values")[0], nlohmann::json({480, true, text, true, true, 0}));
}

TEST(ViewerLooks, ThickPaperAndEdgesAreSwitchesAndTheCardStands) {
    if (!test::have_browser()) GTEST_SKIP() << test::kNoBrowser;
    const ScratchDirectory scratch;
    ASSERT_EQ(popupc({"build", "-q", kRoot / "samples/castle.xml", "-o", scratch / "a.html",
                      "--paper-thickness", "2mm"})
                  .exit,
              0);
    std::vector<std::string> pictures;
    for (const std::vector<std::string>& clicks :
         {std::vector<std::string>{"document.getElementById('thick').checked"},
          {"document.getElementById('thick').click()"},
          {"document.getElementById('edges').click()"}}) {
        const nlohmann::json driven =
            drive(scratch, (scratch / "a.html").string() + "#view=left&at=60", scratch / "a.png", clicks);
        ASSERT_TRUE(driven.is_object());
        EXPECT_EQ(messages_of(driven), std::vector<std::string>{});
        pictures.push_back(test::read_file(scratch / "a.png"));
        if (pictures.size() == 1) {
            EXPECT_EQ(driven.at("values")[0], true);
        }
    }
    EXPECT_NE(pictures[0], pictures[1]);
    EXPECT_NE(pictures[0], pictures[2]);
    const auto scene = scene_of(test::read_file(scratch / "a.html"));
    EXPECT_EQ(scene.at("paper_mm"), 2.0);
    const auto& card = scene.at("cards")[0];
    const auto& ground = card.at("plates").at(card.at("ground").get<std::size_t>());
    EXPECT_EQ(ground.at("name"), "page/right");
}

// Where the page says that a plate is seen, the picture has one of the plate's colours, lit by some light:
// what is drawn is where it is picked. Some points lie on edges.
TEST(ViewerColours, AreThoseOfThePlatesWhereTheyAreSeen) {
    if (!test::have_browser()) GTEST_SKIP() << test::kNoBrowser;
    const ScratchDirectory scratch;
    ASSERT_EQ(popupc({"build", "-q", kRoot / "samples/castle.xml", "-o", scratch / "a.html"}).exit, 0);
    const nlohmann::json driven =
        drive(scratch, (scratch / "a.html").string() + "#view=iso&at=75", scratch / "a.png",
              {"[...Array(2400).keys()].map((i) => [10 + 13 * (i % 60), 100 + 10 * Math.floor(i / 60)])"
               ".map(([x, y]) => [x, y, popupc.nameAt(x, y)]).filter((one) => one[2] !== null)"});
    ASSERT_TRUE(driven.is_object());
    std::map<std::string, std::vector<Color>> colours;
    const nlohmann::json scene = scene_of(test::read_file(scratch / "a.html"));
    for (const auto& plate : scene.at("cards")[0].at("plates")) {
        for (const auto& mesh : plate.at("meshes")) {
            const std::string text = mesh.value("color", "#ffffff");
            const int rgb = std::stoi(text.substr(1), nullptr, 16);
            colours[plate.at("name")].push_back({static_cast<std::uint8_t>(rgb >> 16),
                                                 static_cast<std::uint8_t>(rgb >> 8 & 255),
                                                 static_cast<std::uint8_t>(rgb & 255)});
        }
    }
    const auto pixels = pixels_of(std::get<Image>(open_image(test::read_file(scratch / "a.png"))));
    ASSERT_TRUE(pixels);
    std::size_t right = 0;
    std::set<std::string> seen;
    const auto& points = driven.at("values")[0];
    for (const auto& point : points) {
        const auto at = static_cast<std::size_t>(point[1].get<int>() * pixels->width + point[0].get<int>());
        const std::uint8_t* p = &pixels->rgba[4 * at];
        const std::vector<Color>& own = colours.at(point[2]);
        const bool is_own = std::any_of(own.begin(), own.end(), [&](Color c) {
            // The light that a channel may have had, with rounding; all three had the same.
            double least = 0.7;
            double most = 1.0;
            for (const auto& [is, was] : {std::pair{p[0], c.r}, {p[1], c.g}, {p[2], c.b}}) {
                if (was < 8) continue;
                least = std::max(least, (is - 1.5) / was);
                most = std::min(most, (is + 1.5) / was);
            }
            return least <= most;
        });
        right += is_own ? 1 : 0;
        if (is_own) seen.insert(point[2]);
    }
    EXPECT_GT(points.size(), 500U);
    EXPECT_GT(static_cast<double>(right), 0.85 * static_cast<double>(points.size()));
    EXPECT_GT(seen.size(), 8U);
}

TEST(ViewerRow, CardsStandSideBySideEachAsItsStillShowsIt) {
    if (!test::have_browser()) GTEST_SKIP() << test::kNoBrowser;
    const ScratchDirectory scratch;
    const fs::path samples = kRoot / "samples";
    ASSERT_EQ(
        popupc({"build", "-q", samples / "castle.xml", samples / "swallow.xml", "-o", scratch / "a.html"})
            .exit,
        0);
    const nlohmann::json driven =
        drive(scratch, (scratch / "a.html").string() + "#view=front&at=90", "-",
              {"[...Array(80 * 46).keys()].map((i) => [10 * (i % 80), 60 + 10 * Math.floor(i / 80)])"
               ".map(([x, y]) => [x, y, popupc.nameAt(x, y)]).filter((one) => one[2] !== null)"});
    ASSERT_TRUE(driven.is_object());
    int castle_right = 0;
    int swallow_left = 800;
    int wall_low = 0;
    int floor_low = 0;
    for (const auto& point : driven.at("values")[0]) {
        const std::string name = point[2];
        const int x = point[0];
        const int y = point[1];
        if (name.starts_with("castle:")) castle_right = std::max(castle_right, x);
        if (name.starts_with("swallow:")) swallow_left = std::min(swallow_left, x);
        if (name == "castle:page/left") wall_low = std::max(wall_low, y);
        if (name == "castle:page/right") floor_low = std::max(floor_low, y);
    }
    EXPECT_GT(castle_right, 0);
    EXPECT_LT(castle_right, swallow_left);
    EXPECT_GT(wall_low, 0) << "the back wall is seen from the front";
    EXPECT_GT(floor_low, wall_low) << "and what it stands on below it";
}

// Two fingers that draw apart bring the card nearer, one turns it.
TEST(ViewerTouch, TurnsAndZooms) {
    if (!test::have_browser()) GTEST_SKIP() << test::kNoBrowser;
    const ScratchDirectory scratch;
    ASSERT_EQ(popupc({"build", "-q", kRoot / "samples/castle.xml", "-o", scratch / "a.html"}).exit, 0);
    const std::string begin =
        "const touch = (kind, id, x, y) => document.getElementById('model').dispatchEvent(new PointerEvent("
        "'pointer' + kind, {pointerId: id, pointerType: 'touch', clientX: x, clientY: y, button: 0})); "
        "document.getElementById('model').setPointerCapture = () => {}; "
        "const seen = () => [...Array(1200).keys()].filter((i) => popupc.nameAt(20 * (i % 40), 50 + 15 * "
        "Math.floor(i / 40)) !== null).length; globalThis.test = {touch, seen}; 0";
    const nlohmann::json driven = drive(
        scratch, (scratch / "a.html").string() + "#view=front&at=90", "-",
        {begin, "test.seen()",
         "test.touch('down', 1, 350, 300); test.touch('down', 2, 450, 300); test.touch('move', 2, 550, "
         "300); test.touch('up', 1, 350, 300); test.touch('up', 2, 550, 300); test.seen()",
         "popupc.look('front'); test.seen()",
         "test.touch('down', 1, 400, 300); test.touch('move', 1, 570, 300); test.touch('up', 1, 570, 300); "
         "test.seen()",
         "popupc.look('front'); (() => { const all = [...Array(1200).keys()].map((i) => [20 * (i % 40), 50 + "
         "15 * "
         "Math.floor(i / 40)]).filter(([x, y]) => popupc.nameAt(x, y) !== null); const at = all[all.length "
         ">> 1]; "
         "test.touch('down', 1, ...at); return document.getElementById('name').textContent === "
         "popupc.nameAt(...at); })()"});
    ASSERT_TRUE(driven.is_object());
    EXPECT_EQ(messages_of(driven), std::vector<std::string>{});
    const auto& values = driven.at("values");
    EXPECT_GT(values[2].get<int>(), values[1].get<int>() * 5 / 4) << "two fingers";
    // A quarter turn: the back wall is seen from its edge.
    EXPECT_EQ(values[3], values[1]);
    EXPECT_LT(values[4].get<int>(), values[3].get<int>() * 3 / 4) << "one finger";
    EXPECT_EQ(values[5], true) << "a finger on a plate names it";
}

// axe-core looks for what people who see, hear or move less cannot use. POPUP_AXE: where npm has put it.
TEST(ViewerAccess, HasNothingThatAxeCallsSerious) {
    if (!test::have_browser()) GTEST_SKIP() << test::kNoBrowser;
    const char* folder = std::getenv("POPUP_AXE");
    const fs::path axe = fs::path(folder == nullptr ? "" : folder) / "node_modules/axe-core/axe.min.js";
    if (folder == nullptr || !fs::exists(axe)) GTEST_SKIP() << "POPUP_AXE names no folder with axe-core";
    const ScratchDirectory scratch;
    ASSERT_EQ(popupc({"build", "-q", kRoot / "tests/cases/allow/whole-document.xml", "--allow", "collision",
                      "-o", scratch / "a.html"})
                  .exit,
              0);
    const std::string look =
        "axe.run().then((found) => [found.passes.length > 10, found.violations.map((one) => `${one.impact}: "
        "${one.id}: ${one.nodes.map((node) => node.html)}`)])";
    for (const char* scheme : {"light", "dark"}) {
        const nlohmann::json driven = drive(
            scratch, scratch / "a.html", "-",
            {"@" + axe.string(), look, "document.getElementById('tab-sheets').click()",
             test::when(test::kSheetsDrawn, look), "document.getElementById('tab-findings').click()", look},
            scheme);
        ASSERT_TRUE(driven.is_object());
        for (const std::size_t i : {1U, 3U, 5U}) {
            EXPECT_EQ(driven.at("values")[i], nlohmann::json({true, nlohmann::json::array()})) << scheme;
        }
    }
}

}  // namespace
}  // namespace popup
