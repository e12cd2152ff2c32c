// The page that shows models: what stands in it, and what a browser makes of it.
#include "output/viewer/viewer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/system/digest.h"
#include "base/text/base64.h"
#include "output/viewer/page_files.h"
#include "popup/image.h"
#include "support/designs.h"
#include "support/pictures.h"
#include "support/run_program.h"

namespace popup {
namespace {

namespace fs = std::filesystem;
using test::popupc;
using test::RunResult;
using test::ScratchDirectory;

const fs::path kRoot = POPUP_SOURCE_DIR;
constexpr std::size_t kMostBytes = 150'000;

// What stands between the two, which are there once.
std::string between(const std::string& page, const std::string& begin, const std::string& end) {
    const std::size_t from = page.find(begin);
    if (from == std::string::npos) return "(no " + begin + ")";
    EXPECT_EQ(page.find(begin, from + 1), std::string::npos) << begin << " is there twice";
    const std::size_t to = page.find(end, from + begin.size());
    return page.substr(from + begin.size(), to - from - begin.size());
}

std::size_t count_of(const std::string& text, const std::string& word) {
    std::size_t count = 0;
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++count;
    return count;
}

std::string scene_text(const std::string& page) {
    return between(page, "<script type=\"application/json\" id=\"scene\">", "</script>");
}
nlohmann::json scene_of(const std::string& page) { return nlohmann::json::parse(scene_text(page)); }

std::string source_of(const std::string& text) {
    const std::string digits = sha256(text);
    std::string bytes;
    for (std::size_t i = 0; i < digits.size(); i += 2) {
        bytes += static_cast<char>(std::stoi(digits.substr(i, 2), nullptr, 16));
    }
    return "'sha256-" + base64(bytes) + "'";
}

struct Model {
    Assembly assembly;
    Motion motion;
};

Model model_of(const Design& design) {
    test::Built built = test::build(design);
    Model model{std::move(*built.assembly), {}};
    auto motion = simulate(model.assembly, {}, built.diagnostics);
    EXPECT_TRUE(motion) << test::findings(built.diagnostics);
    if (motion) model.motion = *motion;
    return model;
}

std::string page_of(const Model& model, const std::string& prefix = {}) {
    const SceneCard card{&model.assembly, &model.motion, prefix};
    Diagnostics diagnostics;
    const auto page = write_viewer({{&card, 1}, nullptr, {}}, {}, diagnostics);
    EXPECT_TRUE(page) << test::findings(diagnostics);
    return page.value_or("");
}

Design small_design() {
    Design design = test::card();
    test::add(design, "v-fold",
              {{-60, 20}, {0, -20}, {60, 20}, {-62, 36}, {0, 0}, {62, 36}, {62, 80}, {-62, 80}});
    test::add(design, "step", {{-30, 60}, {-30, 90}, {20, 60}, {20, 90}});
    return design;
}

// The numbers of a text, as scene_json.h says.
std::vector<double> numbers(const nlohmann::json& scene, const nlohmann::json& list, std::size_t stride,
                            double unit) {
    const std::string text = scene.at("lists").at(list.get<std::size_t>());
    const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::vector<long long> values;
    long long sum = 0;
    int bits = 0;
    for (const char c : text) {
        const auto digit = static_cast<long long>(digits.find(c));
        sum |= (digit & 31) << bits;
        bits += 5;
        if ((digit & 32) != 0) continue;
        const long long step = (sum & 1) != 0 ? -(sum >> 1) : sum >> 1;
        values.push_back(step + (values.size() < stride ? 0 : values[values.size() - stride]));
        sum = bits = 0;
    }
    std::vector<double> result;
    for (const long long value : values) result.push_back(static_cast<double>(value) * unit);
    return result;
}

// Doubled area of the triangles of a mesh.
double area_of(const nlohmann::json& scene, const nlohmann::json& mesh) {
    const std::vector<double> at = numbers(scene, mesh.at("points"), 2, 0.01);
    const std::vector<double> corners = numbers(scene, mesh.at("triangles"), 1, 1.0);
    const auto point = [&](std::size_t i) {
        const auto corner = static_cast<std::size_t>(corners.at(i));
        return Vec2{at.at(2 * corner), at.at(2 * corner + 1)};
    };
    double sum = 0.0;
    for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
        sum += 0.5 * cross(point(i + 1) - point(i), point(i + 2) - point(i));
    }
    return sum;
}

TEST(Viewer, IsOneFileWhosePolicyAllowsItsOwnScriptAndStyleOnly) {
    const std::string page = page_of(model_of(small_design()));
    const std::string policy =
        between(page, "<meta http-equiv=\"Content-Security-Policy\" content=\"", "\">");
    EXPECT_EQ(policy, "default-src 'none'; script-src " + source_of(between(page, "<script>", "</script>")) +
                          "; style-src " + source_of(between(page, "<style>", "</style>")) +
                          "; img-src data:; base-uri 'none'; form-action 'none'");
    EXPECT_LT(page.find("Content-Security-Policy"), page.find("<style>"));
    for (const char* outside : {"http:", "https:", "url(", "@import", "import(", "fetch(", "XMLHttp",
                                " onclick", " onload", " style=", "eval(", "innerHTML", "{{"}) {
        EXPECT_EQ(page.find(outside), std::string::npos) << outside;
    }
    EXPECT_EQ(count_of(page, " src="), 1U);
    EXPECT_EQ(count_of(page, " src=\"data:image/webp;base64,"), 1U);
    EXPECT_EQ(count_of(page, "<script"), 2U);
    EXPECT_EQ(count_of(page, "</script"), 2U);
}

TEST(Viewer, HasTheFindingsAndNoMarkupOfTheirs) {
    const Model model = model_of(small_design());
    const SceneCard card{&model.assembly, &model.motion, {}};
    Diagnostics diagnostics;
    RunPage told{{&card, 1}, nullptr, {}};
    EXPECT_NE(write_viewer(told, {}, diagnostics)->find("Nothing was found"), std::string::npos);
    Diagnostics found("folder/<a>.xml");
    found.warning("collision", {3, 7}, "<b>wall</b> & roof cross\x1b")
        .with({9, 2}, "the \"roof\"")
        .hint("move <it>");
    Diagnostics of_run;
    of_run.remark("prints-left-out", {}, "something is left out");
    told.findings = {found.sorted().front(), of_run.sorted().front()};
    const auto page = write_viewer(told, {}, diagnostics);
    ASSERT_TRUE(page) << test::findings(diagnostics);
    EXPECT_EQ(between(*page, "<ul class=\"findings\">\n", "</ul>\n</section>"),
              "<li><span class=\"warning\">warning</span> &lt;b&gt;wall&lt;/b&gt; &amp; roof cross\\x1b "
              "<code>&lt;a&gt;.xml:3:7 [collision]</code><ul><li>with &lt;a&gt;.xml:9:2 the "
              "&quot;roof&quot;</li><li>move &lt;it&gt;</li></ul></li>\n"
              "<li><span class=\"remark\">remark</span> something is left out <code>popupc "
              "[prints-left-out]</code></li>\n");
    EXPECT_EQ(between(*page, "Findings (", ")"), "2");
}

TEST(Viewer, NoNameOfADocumentLeavesItsPlace) {
    const std::string hostile =
        "</script><script>alert(1)</script><!--<script>&quot;\" onload='x' \xff\x01{{scene}}";
    Model model = model_of(small_design());
    const std::string plain = page_of(model);
    for (Plate& plate : model.assembly.plates) plate.name += hostile;
    for (Piece& piece : model.assembly.pieces) piece.name += hostile;
    model.assembly.stem = hostile;
    for (const std::string& prefix : {std::string(), hostile + ":"}) {
        const std::string page = page_of(model, prefix);
        for (const char* tag : {"<script", "</script", "<!--", "<title", "</title", "<h1", "<"}) {
            EXPECT_EQ(count_of(page, tag), count_of(plain, tag)) << tag;
        }
        EXPECT_EQ(scene_text(page).find_first_of("<>&\x01\xff"), std::string::npos);
        const auto scene = scene_of(page);
        const std::string name = scene.at("cards")[0].at("plates")[0].at("name");
        EXPECT_NE(name.find("</script><script>alert(1)</script><!--"), std::string::npos) << name;
        EXPECT_EQ(between(page, "<script>", "</script>"), between(plain, "<script>", "</script>"));
    }
}

TEST(Viewer, HasThePlatesAndTheirTurns) {
    const Model model = model_of(small_design());
    const auto scene = scene_of(page_of(model));
    const auto& plates = scene.at("cards").at(0).at("plates");
    ASSERT_EQ(plates.size(), model.assembly.plates.size());
    EXPECT_EQ(scene.at("opening").at("from_deg"), 0.0);
    EXPECT_EQ(scene.at("opening").at("to_deg"), 180.0);
    // The still is of this opening: a card that lies is seen best when it is open wide.
    EXPECT_EQ(scene.at("opening").at("rest_deg"), 130.0);
    EXPECT_FALSE(scene.contains("ground"));
    for (std::size_t i = 0; i < plates.size(); ++i) {
        const auto& row = plates[i];
        const auto plate = std::find_if(model.assembly.plates.begin(), model.assembly.plates.end(),
                                        [&](const Plate& one) { return one.name == row.at("name"); });
        ASSERT_NE(plate, model.assembly.plates.end());
        EXPECT_NEAR(area_of(scene, row.at("meshes").at(0)), area(plate->outline), 2.0) << plate->name;
        if (plate->parent >= 0) {
            const int parent = row.at("parent").get<int>();
            EXPECT_LT(parent, static_cast<int>(i));
            EXPECT_EQ(plates[static_cast<std::size_t>(parent)].at("name"),
                      model.assembly.plates[static_cast<std::size_t>(plate->parent)].name);
        }
        std::vector<double> turns = numbers(scene, row.at("turns"), 4, 5e-6);
        ASSERT_EQ(turns.size() % 4, 0U);
        EXPECT_TRUE(turns.size() == 4 || turns.size() == 4 * scene.at("angles").size());
        for (std::size_t k = 4; k < turns.size(); ++k) turns[k] += turns[k - 4];
        for (std::size_t k = 0; k < turns.size(); k += 4) {
            double square = 0.0;
            for (std::size_t j = 0; j < 4; ++j) square += turns[k + j] * turns[k + j];
            EXPECT_NEAR(square, 1.0, 3e-5);
        }
        // All of the outline is drawn: its folds lighter.
        EXPECT_TRUE(row.contains("cuts")) << plate->name;
        EXPECT_TRUE(row.contains("folds")) << plate->name;
    }
}

TEST(Viewer, ToldOfCollisionsWhereTheExaminationFoundThem) {
    const ScratchDirectory scratch;
    const fs::path input = kRoot / "tests/cases/allow/whole-document.xml";
    const RunResult result =
        popupc({"build", input, "--allow", "collision", "-o", scratch / "a.html", "-o", scratch / "a.json"});
    ASSERT_EQ(result.exit, 0) << result.err;
    const auto scene = scene_of(test::read_file(scratch / "a.html"));
    const auto report = nlohmann::json::parse(test::read_file(scratch / "a.json"));
    const auto& card = scene.at("cards").at(0);
    std::vector<std::string> found;
    for (const auto& one : card.at("collisions")) {
        std::string names;
        for (const auto& plate : one.at("plates")) {
            names += card.at("plates").at(plate.get<std::size_t>()).at("name").get<std::string>() + " ";
        }
        found.push_back(names + one.at("from_deg").dump() + " " + one.at("to_deg").dump());
    }
    ASSERT_FALSE(found.empty());
    std::vector<std::string> wanted;
    for (const auto& one : report.at("inputs").at(0).at("motion").at("collisions")) {
        wanted.push_back(one.at("plates").at(0).get<std::string>() + " " +
                         one.at("plates").at(1).get<std::string>() + " " + one.at("from_deg").dump() + " " +
                         one.at("to_deg").dump());
    }
    EXPECT_EQ(found, wanted);
}

TEST(Viewer, PartsThatStandHaveNoOpening) {
    const ScratchDirectory scratch;
    const fs::path program = kRoot / "samples/flatlang/box.fl";
    const RunResult result = popupc({"build", program, "-o", scratch / "a.html"});
    ASSERT_EQ(result.exit, 0) << result.err;
    const auto scene = scene_of(test::read_file(scratch / "a.html"));
    EXPECT_FALSE(scene.contains("opening"));
    EXPECT_FALSE(scene.contains("angles"));
    ASSERT_FALSE(scene.at("cards").at(0).at("standing").empty());
    EXPECT_FALSE(scene.at("cards").at(0).contains("plates"));
}

TEST(Viewer, CardsOfOneRunStandSideBySideAndShareTheirPictures) {
    const ScratchDirectory scratch;
    fs::copy(kRoot / "samples/pictures", scratch / "pictures");
    for (const char* name : {"a.xml", "b.xml"}) fs::copy_file(kRoot / "samples/harbour.xml", scratch / name);
    const RunResult result =
        popupc({"build", scratch / "a.xml", scratch / "b.xml", "-o", scratch / "two.html"});
    ASSERT_EQ(result.exit, 0) << result.err;
    const std::string page = test::read_file(scratch / "two.html");
    EXPECT_EQ(between(page, "<title>", "</title>"), "a, b");
    const auto scene = scene_of(page);
    ASSERT_EQ(scene.at("cards").size(), 2U);
    EXPECT_FALSE(scene.at("cards")[0].contains("shift"));
    EXPECT_GT(scene.at("cards")[1].at("shift").get<double>(), 100.0);
    EXPECT_EQ(scene.at("cards")[1].at("plates")[0].at("name").get<std::string>().substr(0, 2), "b:");
    EXPECT_EQ(scene.at("pictures").size(), 2U);
    for (const auto& picture : scene.at("pictures")) {
        EXPECT_TRUE(picture.get<std::string>().starts_with("data:image/")) << picture;
    }
}

// ---- every sample

std::vector<std::string> samples() {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(kRoot / "samples")) {
        const std::string end = entry.path().extension();
        if (end == ".xml" || end == ".oa" || end == ".fl") names.push_back(entry.path().filename());
    }
    for (const auto& entry : fs::directory_iterator(kRoot / "samples/folded")) {
        names.push_back("folded/" + entry.path().filename().string());
    }
    std::sort(names.begin(), names.end());
    return names;
}

std::vector<std::string> build_words(const std::string& sample, const fs::path& output) {
    std::vector<std::string> words{"build", "-q", kRoot / "samples" / sample, "-o", output};
    if (sample.starts_with("folded/") && sample.ends_with(".svg")) {
        words.insert(words.end(), {"--as", "folded"});
    }
    return words;
}

TEST(ViewerOfSamples, EachIsSmallAndTheSameTwice) {
    const ScratchDirectory scratch;
    const std::vector<std::string> all = samples();
    EXPECT_GT(all.size(), 35U);
    for (const std::string& sample : all) {
        std::vector<std::string> pages;
        for (const char* threads : {"1", "2"}) {
            std::vector<std::string> words = build_words(sample, scratch / "a.html");
            words.insert(words.end(), {"-j", threads});
            const RunResult result = popupc(words);
            ASSERT_EQ(result.exit, 0) << sample << ": " << result.err;
            pages.push_back(test::read_file(scratch / "a.html"));
        }
        EXPECT_TRUE(pages[0] == pages[1]) << sample << " differs between two runs";
        const auto scene = scene_of(pages[0]);
        std::size_t pictures = 0;
        for (const auto& one : scene.value("pictures", nlohmann::json::array())) {
            pictures += one.get_ref<const std::string&>().size();
        }
        pictures += between(pages[0], " src=\"", "\"").size();
        EXPECT_LT(pages[0].size() - pictures, kMostBytes) << sample;
    }
}

// ---- in a browser

const char* const kChromium = "/usr/bin/chromium";

bool have_browser() { return fs::exists(kChromium) && test::have_program("node"); }

// What tests/tools/drive_page.mjs says of a page and of these expressions.
nlohmann::json drive(const ScratchDirectory& scratch, const std::string& page, const std::string& picture,
                     const std::vector<std::string>& expressions, const std::string& scheme = "light") {
    const fs::path profile = scratch / "profile";
    fs::remove_all(profile);
    fs::create_directory(profile);
    std::vector<std::string> words{
        "node", kRoot / "tests/tools/drive_page.mjs", kChromium, profile, page, picture, "800", "600",
        scheme};
    words.insert(words.end(), expressions.begin(), expressions.end());
    test::RunOptions options;
    options.environment["HOME"] = profile;
    const RunResult result = test::run(words, options);
    EXPECT_EQ(result.exit, 0) << result.err;
    return result.exit == 0 ? nlohmann::json::parse(result.out) : nlohmann::json();
}

// What the browser says, but for the speed of pictures that it copies where there is no graphics card.
std::vector<std::string> messages_of(const nlohmann::json& driven) {
    std::vector<std::string> all;
    for (const std::string one : driven.at("messages")) {
        if (one.find("GPU stall due to ReadPixels") == std::string::npos) all.push_back(one);
    }
    return all;
}

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
        if (!have_browser()) GTEST_SKIP() << "there is no " << kChromium << ", or no node";
    }
};

TEST_P(ViewerInABrowser, PlatesAreWhereTheMotionSaysAndThePictureIsNotBlank) {
    const ScratchDirectory scratch;
    const std::string& sample = GetParam();
    std::vector<std::string> words = build_words(sample, scratch / "a.html");
    const RunResult built = popupc(words);
    ASSERT_EQ(built.exit, 0) << built.err;
    words = build_words(sample, "");
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
    if (!have_browser()) GTEST_SKIP() << "there is no " << kChromium << ", or no node";
    const ScratchDirectory scratch;
    ASSERT_EQ(popupc({"build", "-q", kRoot / "tests/cases/allow/whole-document.xml", "--allow", "collision",
                      "-o", scratch / "a.html"})
                  .exit,
              0);
    const std::string press = "document.dispatchEvent(new KeyboardEvent('keydown', {key: '";
    const std::string wait = "new Promise((done) => setTimeout(done, 400)).then(() => ";
    const nlohmann::json driven =
        drive(scratch, (scratch / "a.html").string() + "#view=front&at=30", "-",
              {"popupc.opening()", press + "ArrowRight'})); popupc.opening()",
               press + "ArrowLeft'})); popupc.opening()", press + " '})); " + wait + "popupc.opening() > 31)",
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
               "290})); new Promise((done) => setTimeout(done, 200)).then(() => "
               "document.querySelector('#name').textContent === popupc.nameAt(400, 290))"},
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

// ---- what is there beside the model

const char* const kWait = "new Promise((done) => setTimeout(done, 300)).then(() => ";

TEST(ViewerTabs, ShowTheSheetsOfTheSvgOutputAndTheFindings) {
    if (!have_browser()) GTEST_SKIP() << "there is no " << kChromium << ", or no node";
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
               std::string(kWait) +
                   "[...document.querySelectorAll('#sheets-panel img')].map((i) => [i.naturalWidth > 100, "
                   "decodeURIComponent(i.src.slice(i.src.indexOf(',') + 1))]))",
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

TEST(ViewerStill, IsShownWhereThereIsNoWebGlAndWhereThereAreNoScripts) {
    if (!have_browser()) GTEST_SKIP() << "there is no " << kChromium << ", or no node";
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
    if (!have_browser()) GTEST_SKIP() << "there is no " << kChromium << ", or no node";
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
    const auto& ground = scene.at("cards")[0].at("plates").at(scene.at("ground").get<std::size_t>());
    EXPECT_EQ(ground.at("name"), "page/right");
}

// axe-core looks for what people who see, hear or move less cannot use. POPUP_AXE: where npm has put it.
TEST(ViewerAccess, HasNothingThatAxeCallsSerious) {
    if (!have_browser()) GTEST_SKIP() << "there is no " << kChromium << ", or no node";
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
        const nlohmann::json driven =
            drive(scratch, scratch / "a.html", "-",
                  {"@" + axe.string(), look, "document.getElementById('tab-sheets').click()",
                   std::string(kWait) + look + ")", "document.getElementById('tab-findings').click()", look},
                  scheme);
        ASSERT_TRUE(driven.is_object());
        for (const std::size_t i : {1U, 3U, 5U}) {
            EXPECT_EQ(driven.at("values")[i], nlohmann::json({true, nlohmann::json::array()})) << scheme;
        }
    }
}

}  // namespace
}  // namespace popup
