// The page that shows models: what stands in it, and what a browser makes of it.
#include "output/viewer/viewer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/system/digest.h"
#include "base/text/base64.h"
#include "output/viewer/page_files.h"
#include "support/designs.h"
#include "support/pictures.h"
#include "support/run_program.h"
#include "support/viewer_page.h"

namespace popup {
namespace {

namespace fs = std::filesystem;
using test::between;
using test::popupc;
using test::RunResult;
using test::scene_of;
using test::scene_text;
using test::ScratchDirectory;

const fs::path kRoot = POPUP_SOURCE_DIR;
constexpr std::size_t kMostBytes = 150'000;

std::size_t count_of(const std::string& text, const std::string& word) {
    std::size_t count = 0;
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++count;
    return count;
}

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

std::string page_of(const Model& model, const std::string& prefix = {}, const OutputOptions& options = {}) {
    const SceneCard card{&model.assembly, &model.motion, prefix};
    Diagnostics diagnostics;
    const auto page = write_viewer({{&card, 1}, nullptr, {}}, options, diagnostics);
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

TEST(Viewer, HasTheSameBytesWithAnyNumberOfThreads) {
    const Model model = model_of(small_design());
    const std::string alone = page_of(model);
    OutputOptions options;
    options.threads = 2;
    for (int i = 0; i < 20; ++i) ASSERT_EQ(page_of(model, {}, options), alone);
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
    EXPECT_EQ(count_of(page, " src=\"data:image/jpeg;base64,"), 1U);
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

TEST(ViewerOfSamples, EachIsSmallAndTheSameTwice) {
    const ScratchDirectory scratch;
    const std::vector<std::string> all = samples();
    EXPECT_GT(all.size(), 35U);
    for (const std::string& sample : all) {
        std::vector<std::string> pages;
        for (const char* threads : {"1", "2"}) {
            std::vector<std::string> words = test::words_for_sample(sample, scratch / "a.html");
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

}  // namespace
}  // namespace popup
