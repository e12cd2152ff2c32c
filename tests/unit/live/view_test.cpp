// `popupc view`: what it shows of saves, how it ends, and what it leaves behind: nothing.
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "base/text/base64.h"
#include "support/live_view.h"
#include "support/pictures.h"
#include "support/sanitized.h"

namespace popup::test {
namespace {

namespace fs = std::filesystem;

const fs::path kSource = POPUP_SOURCE_DIR;

// A tent of this width, which the plates' points tell; the page it stands on is 100 mm wide.
std::string card(int width) {
    const std::string half = std::to_string(width / 2);
    return "<popup version='2.0' units='mm'><mainpage width='200' height='140'/><structurelist>"
           "<structure type='tent' id='w" +
           std::to_string(width) +
           "'><outerpoints><point x='-25' y='0'/><point x='-25' y='40'/><point x='25' y='0'/>"
           "<point x='25' y='40'/><point x='-" +
           half + "' y='-20'/><point x='-" + half + "' y='20'/><point x='" + half + "' y='-20'/><point x='" +
           half +
           "' y='20'/></outerpoints><parentfold><begin x='0' y='-70'/><end x='0' y='70'/></parentfold>"
           "</structure></structurelist></popup>\n";
}
std::string name_of(int width) { return "\"w" + std::to_string(width) + "/"; }

class View : public testing::Test {
 protected:
    View() { write_file(view.scratch / "card.xml", card(60)); }
    ~View() override {
        if (!view.program) return;
        EXPECT_EQ(view.end(SIGTERM), 0) << view.program->err();
        EXPECT_EQ(view.program->out(), view.address + "\n") << "the address on one line, and nothing else";
    }
    // On standard error, where it stands a moment after pages were told.
    bool says(const std::string& text) {
        return eventually([&] { return view.program->err().find(text) != std::string::npos; });
    }
    LiveView view;
};

TEST_F(View, ShowsWhatEditorsSave) {
    view.start();
    view.until_model_with(name_of(60));
    // Written over.
    write_file(view.scratch / "card.xml", card(62));
    view.until_model_with(name_of(62));
    // A new file in its place.
    view.replace("card.xml", card(64));
    view.until_model_with(name_of(64));
    // Moved away and made anew: as editors do that keep a copy.
    fs::rename(view.scratch / "card.xml", view.scratch / "card.xml~");
    write_file(view.scratch / "card.xml", card(66));
    view.until_model_with(name_of(66));
    // Deleted and made anew.
    fs::remove(view.scratch / "card.xml");
    write_file(view.scratch / "card.xml", card(68));
    view.until_model_with(name_of(68));
    // Emptied first, and written in parts.
    {
        std::ofstream file(view.scratch / "card.xml", std::ios::trunc);
        const std::string text = card(70);
        file << text.substr(0, 100) << std::flush << text.substr(100);
    }
    view.until_model_with(name_of(70));
    EXPECT_EQ(view.program->err(), "");
}

TEST_F(View, TheLastOfManySavesWins) {
    view.start();
    for (int round = 0; round < 5; ++round) {
        for (int i = 0; i < 20; ++i) view.replace("card.xml", card(60 + 2 * i));
        view.replace("card.xml", card(120 + 2 * round));
        view.until_model_with(name_of(120 + 2 * round));
    }
}

TEST_F(View, ErrorsComeAndGoAndTheModelStays) {
    view.start({"card.xml", "--verbose"});
    const nlohmann::json first = view.until_model_with(name_of(60));
    EXPECT_EQ(first.at("stale"), false);
    write_file(view.scratch / "card.xml", "<popup version='2.0'>\n  <tent x='<'/>\n</popup>\n");
    const nlohmann::json wrong = view.until_errors(1);
    EXPECT_EQ(wrong.at("stale"), true);
    EXPECT_EQ(wrong.at("model"), first.at("model"));
    const std::string trouble = wrong.at("trouble");
    EXPECT_NE(trouble.find("<code>card.xml:2"), std::string::npos) << trouble;
    EXPECT_NE(trouble.find("&lt;tent x="), std::string::npos) << "its line, as text: " << trouble;
    EXPECT_EQ(trouble.find("<tent"), std::string::npos) << trouble;
    EXPECT_NE(wrong.at("findings").get<std::string>().find("card.xml:2"), std::string::npos);
    EXPECT_EQ(wrong.at("finding_count"), 1);
    EXPECT_TRUE(says("card.xml:2:")) << "as with --watch";
    // A page that comes now is shown the last model, too.
    const auto late = nlohmann::json::parse(get(view.address, "now?after=0").body);
    EXPECT_EQ(late.at("model"), first.at("model"));
    EXPECT_EQ(late.at("errors"), 1);
    view.replace("card.xml", card(62));
    EXPECT_EQ(view.until_model_with(name_of(62)).at("trouble"), "");
    EXPECT_EQ(view.shown.at("stale"), false);
    fs::remove(view.scratch / "card.xml");
    EXPECT_NE(view.until_errors(1).at("trouble").get<std::string>().find("cannot be read"),
              std::string::npos);
    write_file(view.scratch / "card.xml", card(64));
    view.until_model_with(name_of(64));
    EXPECT_TRUE(says("popupc: card.xml has changed: shown\n"));
    EXPECT_TRUE(says("it has errors, and the last picture stays\n"));
}

TEST_F(View, MayBeginWithErrorsOrWithoutTheFile) {
    fs::remove(view.scratch / "card.xml");
    view.start();
    EXPECT_FALSE(view.until_errors(1).contains("model"));
    write_file(view.scratch / "card.xml", "<popup");
    view.until([](const nlohmann::json& news) {
        return news.value("trouble", "").find("card.xml:1:") != std::string::npos;
    });
    write_file(view.scratch / "card.xml", card(62));
    view.until_model_with(name_of(62));
}

TEST_F(View, WhatTheDesignLoadsIsWatched) {
    write_file(view.scratch / "card.xml",
               "<popup version='3.0' units='mm'><drawnlinelist>"
               "<image href='sea.png' x='0' y='0' width='20'/></drawnlinelist></popup>");
    view.start();
    view.until([](const nlohmann::json& news) { return news.contains("findings"); });
    EXPECT_NE(view.shown.at("findings").get<std::string>().find("picture-missing"), std::string::npos);
    write_file(view.scratch / "sea.png", png_of(8, 4));
    view.until_model_with(base64(png_of(8, 4)));
    view.replace("sea.png", png_of(4, 4));
    view.until_model_with(base64(png_of(4, 4)));
}

TEST_F(View, ProgramsAndWhatTheyLoadAreWatched) {
    fs::create_directory(view.scratch / "parts");
    fs::copy(kSource / "samples/valley.fl", view.scratch / "valley.fl");
    write_file(view.scratch / "own.fl", "load(\"more.fl\")\n" + read_file(kSource / "samples/valley.fl"));
    write_file(view.scratch / "parts/more.fl", "print(\"first\")\n");
    view.start({"own.fl", "-I", "parts"});
    view.until([](const nlohmann::json& news) { return news.contains("model"); });
    const auto version = view.shown.at("version").get<int>();
    write_file(view.scratch / "parts/more.fl", "print(\"second\")\n");
    view.until([&](const nlohmann::json& news) { return news.at("version").get<int>() > version; });
    EXPECT_TRUE(says("second"));
}

TEST_F(View, FlatPartsOfProgramsAreShownToo) {
    fs::copy(kSource / "samples/flatlang/gear.fl", view.scratch / "gear.fl");
    view.start({"gear.fl"});
    view.until([](const nlohmann::json& news) { return news.contains("sheets"); });
    const nlohmann::json& scene = view.shown.at("model").at("scene");
    EXPECT_FALSE(scene.contains("opening"));
    const nlohmann::json& standing = scene.at("cards").at(0).at("standing");
    ASSERT_EQ(standing.size(), 1U);
    EXPECT_EQ(standing.at(0).at("name"), "gear");
    EXPECT_FALSE(standing.at(0).at("meshes").empty());
    EXPECT_EQ(view.shown.at("errors"), 0);
}

TEST_F(View, SheetsFollowTheModel) {
    view.start();
    view.until([](const nlohmann::json& news) { return news.contains("sheets"); });
    EXPECT_EQ(view.shown.at("sheets").at("count"), 1);
    // What does not fit is an error, and the model is shown all the same.
    LiveView small;
    write_file(small.scratch / "card.xml", card(60));
    small.start({"card.xml", "--sheet", "100x100"});
    small.until([](const nlohmann::json& news) { return news.contains("model") && news.at("errors") == 1; });
    EXPECT_EQ(small.shown.at("stale"), false);
    EXPECT_NE(small.shown.at("trouble").get<std::string>().find("piece-too-large"), std::string::npos);
    EXPECT_EQ(small.end(SIGINT), 0);
}

TEST_F(View, SheetsOfTheCardBeforeAreTakenAway) {
    view.start({"card.xml", "--sheet", "210x150"});
    view.until([](const nlohmann::json& news) { return news.contains("sheets"); });
    std::string wide = card(80);
    wide.replace(wide.find("'200'"), 5, "'400'");
    view.replace("card.xml", wide);
    view.until([](const nlohmann::json& news) { return news.at("sheets").at("count") == 0; });
    EXPECT_EQ(view.shown.at("errors"), 1);
    EXPECT_NE(view.shown.at("model").dump().find("w80"), std::string::npos) << "the new model";
    view.replace("card.xml", card(60));
    view.until([](const nlohmann::json& news) { return news.at("sheets").at("count") != 0; });
}

TEST_F(View, SeveralInputsAndDrawingsAreShownAsABuildTakesThem) {
    fs::copy(kSource / "samples/folded/town.svg", view.scratch / "town.svg");
    view.start({"card.xml", "town.svg", "--as", "folded"});
    EXPECT_EQ(view.until_model_with("\"card:w60/").at("model").at("title"), "card, town");
    EXPECT_EQ(view.shown.at("model").at("scene").at("cards").size(), 2U);
}

TEST_F(View, AConfigurationThatIsWrongIsShownToo) {
    view.options.environment["POPUPC_NO_CONFIG"] = "";
    view.start();
    view.until_model_with(name_of(60));
    write_file(view.scratch / "popupc.toml", "paper-thickness = '0.4'\nsheeet = 'a4'\n");
    EXPECT_NE(view.until_errors(1).at("trouble").get<std::string>().find("<code>popupc.toml:2"),
              std::string::npos)
        << view.shown;
    write_file(view.scratch / "popupc.toml", "paper-thickness = '0.4'\n");
    view.until_model_with("\"paper_mm\":0.4");
}

TEST_F(View, EndsAtOnceWithOpenConnections) {
    for (const int signal : {SIGINT, SIGTERM}) {
        LiveView ending;
        write_file(ending.scratch / "card.xml", card(60));
        const std::vector<std::string> before = ending.scratch.names();
        ending.start();
        ending.until([](const nlohmann::json& news) { return news.contains("sheets"); });
        const HttpPlace place = place_of(ending.address);
        Wire silent(place.port);
        std::vector<std::unique_ptr<Wire>> waiting;
        for (int i = 0; i < 10; ++i) {
            waiting.push_back(std::make_unique<Wire>(place.port));
            ASSERT_TRUE(
                waiting.back()->send(get_request(place, "next?after=" + ending.shown.at("version").dump())));
        }
        EXPECT_EQ(get(ending.address, "now?after=" + ending.shown.at("version").dump()).status, 204);
        EXPECT_EQ(ending.end(signal), 0);
        for (const auto& wire : waiting) EXPECT_TRUE(wire->ends());
        EXPECT_TRUE(silent.ends());
        EXPECT_EQ(ending.scratch.names(), before) << "it has written nothing";
    }
}

// A program that would run for hours.
TEST_F(View, EndsAtOnceWhileItCompiles) {
    fs::copy(kSource / "samples/valley.fl", view.scratch / "own.fl");
    LiveView& busy = view;
    busy.start({"own.fl", "--max-steps", "1000000000000"});
    busy.until([](const nlohmann::json& news) { return news.contains("model"); });
    busy.replace("own.fl", "print(\"begun\")\nwhile (true)\n    x = 1\ndone\n");
    const std::string stat = "/proc/" + std::to_string(busy.program->pid()) + "/stat";
    // Its processor time grows: it runs.
    const auto spent = [&] {
        const std::string text = read_file(stat);
        std::istringstream words(text.substr(text.rfind(')') + 2));
        std::string word;
        for (int i = 0; i < 12; ++i) words >> word;
        return std::stol(word);
    };
    const long before = spent();
    ASSERT_TRUE(eventually([&] { return spent() > before + 10; })) << busy.program->err();
    EXPECT_EQ(busy.end(SIGINT), 0);
    busy.program.reset();
}

TEST_F(View, EndsWhenNobodyLooks) {
    for (const char* time : {"0.05s", "0.001m"}) {
        LiveView idle;
        write_file(idle.scratch / "card.xml", card(60));
        idle.start({"card.xml", "--idle", time});
        EXPECT_EQ(idle.program->wait(), 0) << idle.program->err();
        EXPECT_EQ(idle.program->err(), "");
    }
}

TEST_F(View, OpensABrowser) {
    write_file(view.scratch / "see", "#!/bin/sh\necho \"$1\" > " + (view.scratch / "seen").string() + "\n");
    fs::permissions(view.scratch / "see", fs::perms::owner_all);
    view.options.environment["BROWSER"] = (view.scratch / "see").string();
    Background program({kPopupc, "view", "card.xml"}, view.options);
    ASSERT_TRUE(eventually([&] { return read_file(view.scratch / "seen").ends_with('\n'); }))
        << program.err();
    EXPECT_EQ(read_file(view.scratch / "seen"), program.out());
    program.send(SIGINT);
    EXPECT_EQ(program.wait(), 0);
    view.options.environment["BROWSER"] = "no-such-browser";
    view.options.environment["PATH"] = view.scratch.path().string();
    Background without({kPopupc, "view", "card.xml"}, view.options);
    ASSERT_TRUE(eventually([&] { return !without.err().empty(); }));
    EXPECT_EQ(without.err(), "popupc: no browser could be started: open the address above in one\n");
    without.send(SIGINT);
    EXPECT_EQ(without.wait(), 0);
}

TEST_F(View, APortThatIsTakenOrNotAllowedIsNamed) {
    view.start();
    const std::string port = std::to_string(place_of(view.address).port);
    const RunResult taken = popupc({"view", "card.xml", "--no-browser", "--port", port}, view.options);
    EXPECT_EQ(taken.exit, 2);
    EXPECT_EQ(taken.out, "");
    EXPECT_EQ(taken.err, "popupc: error: --port " + port +
                             ": another program has this port\n"
                             "  hint: without --port one is taken that is free\n");
    const RunResult low = run({"setpriv", "--reuid", "65534", "--bounding-set", "-all", "--inh-caps", "-all",
                               kPopupc, "view", "card.xml", "--no-browser", "--port", "1"},
                              view.options);
    if (low.exit != 2 || low.err.find("--port 1: ") == std::string::npos)
        GTEST_SKIP() << "as another user: " << low.err;
    EXPECT_NE(low.err.find("ports below 1024 are the system's"), std::string::npos) << low.err;
}

TEST_F(View, OnlyThisMachineIsListenedTo) {
    view.start();
    // 127.0.0.1 in the kernel's own words, and this program's port.
    std::istringstream table(read_file("/proc/net/tcp"));
    char place[32];
    std::snprintf(place, sizeof place, "0100007F:%04X", place_of(view.address).port);
    std::set<std::string> listening;
    for (std::string line; std::getline(table, line);) {
        std::istringstream words(line);
        std::string number;
        std::string local;
        std::string remote;
        std::string state;
        words >> number >> local >> remote >> state;
        if (state == "0A" && local.ends_with(std::string(place).substr(8))) listening.insert(local);
    }
    EXPECT_EQ(listening, std::set<std::string>{place});
    EXPECT_EQ(read_file("/proc/net/tcp6")
                  .find(std::string(place).substr(8) + " 00000000000000000000000000000000:0000 0A"),
              std::string::npos);
}

TEST_F(View, StreamsThatCannotBeReadAgainAreRefused) {
    ASSERT_EQ(::mkfifo((view.scratch / "pipe.xml").c_str(), 0600), 0);
    const RunResult pipe = popupc({"view", "pipe.xml", "--no-browser"}, view.options);
    EXPECT_EQ(pipe.exit, 2);
    EXPECT_NE(pipe.err.find("pipe.xml can be read only once"), std::string::npos) << pipe.err;
    // Nobody reads the address.
    const RunResult gone =
        run({"sh", "-c", std::string(kPopupc) + " view card.xml --no-browser >&-"}, view.options);
    EXPECT_EQ(gone.exit, 2);
}

}  // namespace
}  // namespace popup::test
