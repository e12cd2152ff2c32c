// `popupc build --watch`: what starts a build, what does not, and how it ends.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "base/text/base64.h"
#include "support/background.h"
#include "support/pictures.h"
#include "support/run_program.h"
#include "support/sanitized.h"

namespace popup::test {
namespace {

namespace fs = std::filesystem;

const fs::path kSource = POPUP_SOURCE_DIR;

// A card that is watched in a scratch directory. What a build writes tells which document it has read: the
// bytes of the two cards differ.
class Watch : public testing::Test {
 protected:
    Watch() {
        options.directory = scratch.path();
        bird = read_file(kSource / "samples/bird.xml");
        boat = read_file(kSource / "samples/boat.xml");
        of_bird = model_of(bird);
        of_boat = model_of(boat);
    }
    ~Watch() override {
        if (!watching) return;
        watching->send(SIGTERM);
        EXPECT_EQ(watching->wait(), 0) << watching->err();
        const std::vector<std::string> names = scratch.names();
        EXPECT_TRUE(std::none_of(names.begin(), names.end(), [](const std::string& name) {
            return name.starts_with(".popup-");
        })) << "no litter";
    }
    std::string model_of(const std::string& card) {
        const ScratchDirectory apart;
        write_file(apart / "card.xml", card);
        RunOptions there;
        there.directory = apart.path();
        EXPECT_EQ(popupc({"build", "card.xml", "-o", "card.glb"}, there).exit, 0);
        return read_file(apart / "card.glb");
    }
    void start(std::vector<std::string> arguments = {"card.xml", "-o", "card.glb"}) {
        arguments.insert(arguments.begin(), {kPopupc, "build", "--watch"});
        watching = std::make_unique<Background>(arguments, options);
    }
    bool comes(const std::string& bytes, const std::string& name = "card.glb") {
        return eventually([&] { return read_file(scratch / name) == bytes; });
    }
    bool says(const std::string& text) {
        return eventually([&] { return watching->err().find(text) != std::string::npos; });
    }
    // How many builds it has told of under --verbose.
    [[nodiscard]] int builds() const {
        std::istringstream lines(watching->err());
        int count = 0;
        for (std::string line; std::getline(lines, line);) count += line.starts_with("popupc: ") ? 1 : 0;
        return count;
    }
    // Puts a new file in the place of the old one, as editors do.
    void replace(const std::string& name, const std::string& bytes) {
        write_file(scratch / "new", bytes);
        fs::rename(scratch / "new", scratch / name);
    }

    ScratchDirectory scratch;
    RunOptions options;
    std::unique_ptr<Background> watching;
    std::string bird, boat, of_bird, of_boat;
};

TEST_F(Watch, BuildsAtOnceAndAgainWhenADocumentChanges) {
    write_file(scratch / "card.xml", bird);
    start();
    ASSERT_TRUE(comes(of_bird));
    write_file(scratch / "card.xml", boat);
    ASSERT_TRUE(comes(of_boat));
    replace("card.xml", bird);
    ASSERT_TRUE(comes(of_bird));
    // Moved away and another put there: as editors do that keep a copy.
    fs::rename(scratch / "card.xml", scratch / "card.xml~");
    write_file(scratch / "card.xml", boat);
    ASSERT_TRUE(comes(of_boat));
    EXPECT_EQ(watching->out(), "");
}

TEST_F(Watch, BuildsAgainWhenTheProfileChanges) {
    write_file(scratch / "card.xml", bird);
    write_file(scratch / "mine.toml", "name = \"mine\"\n[pens.outer-cut]\ncolor = \"#123456\"\n");
    start({"card.xml", "--profile", "mine.toml", "-o", "card.svg"});
    const auto has = [&](const std::string& text) {
        return eventually([&] { return read_file(scratch / "card.svg").find(text) != std::string::npos; });
    };
    ASSERT_TRUE(has("#123456"));
    replace("mine.toml", "name = \"mine\"\n[pens.outer-cut]\ncolor = \"#654321\"\n");
    EXPECT_TRUE(has("#654321"));
}

TEST_F(Watch, BuildsAgainWhenAPictureComesOrChanges) {
    write_file(scratch / "card.xml",
               "<popup version='3.0' units='mm'><drawnlinelist>"
               "<image href='sea.png' x='0' y='0' width='20'/></drawnlinelist></popup>");
    start({"card.xml", "-o", "card.svg"});
    ASSERT_TRUE(says("picture-missing"));
    const auto shows = [&](const std::string& file) {
        return eventually(
            [&] { return read_file(scratch / "card.svg").find(base64(file)) != std::string::npos; });
    };
    write_file(scratch / "sea.png", png_of(8, 4));
    ASSERT_TRUE(shows(png_of(8, 4)));
    replace("sea.png", png_of(4, 4));
    EXPECT_TRUE(shows(png_of(4, 4)));
}

// A picture that is traced again changes the cards that take its outline.
TEST_F(Watch, BuildsAgainWhenAnOutlineIsTracedAgain) {
    options.directory = scratch.path();
    const auto trace = [&](int width, int height) {
        write_file(scratch / "shape.png", png_of(width, height));
        const RunResult traced = popupc(
            {"trace", "shape.png", "--threshold", "128", "--width", "60mm", "-o", "shape.svg"}, options);
        ASSERT_EQ(traced.exit, 0) << traced.err;
    };
    trace(60, 40);
    write_file(scratch / "card.xml",
               "<popup version='3.0' units='mm'><mainpage width='170' height='130'/><structurelist>"
               "<structure type='hole'><outline href='shape.svg' x='10' y='-30'/></structure>"
               "</structurelist></popup>");
    start({"card.xml", "-o", "card.svg"});
    ASSERT_TRUE(eventually([&] { return fs::exists(scratch / "card.svg"); }));
    const std::string before = read_file(scratch / "card.svg");
    trace(60, 20);
    EXPECT_TRUE(eventually([&] { return read_file(scratch / "card.svg") != before; }));
}

TEST_F(Watch, AConfigurationMayComeToBe) {
    options.environment["POPUPC_NO_CONFIG"] = "";
    fs::create_directories(scratch / "designs");
    write_file(scratch / "designs/card.xml", bird);
    start({"designs/card.xml", "-o", "card.svg"});
    const auto has = [&](const std::string& text) {
        return eventually([&] { return read_file(scratch / "card.svg").find(text) != std::string::npos; });
    };
    ASSERT_TRUE(has("</svg>"));
    write_file(scratch / "popupc.toml", "sheet = '777x777'\n");
    ASSERT_TRUE(has("777mm"));
    write_file(scratch / "designs/popupc.toml", "sheet = '555x555'\n");
    EXPECT_TRUE(has("555mm"));
}

TEST_F(Watch, GoesOnAfterErrorsAndSaysNothingElse) {
    write_file(scratch / "card.xml", "<popup");
    start();
    ASSERT_TRUE(says("card.xml:1:"));
    EXPECT_FALSE(fs::exists(scratch / "card.glb"));
    write_file(scratch / "card.xml", bird);
    ASSERT_TRUE(comes(of_bird));
    const std::string before = watching->err();
    write_file(scratch / "card.xml", boat);
    ASSERT_TRUE(comes(of_boat));
    EXPECT_EQ(watching->err(), before) << "nothing is wrong, so nothing is said";
}

TEST_F(Watch, AnInputMayVanishAndComeBack) {
    fs::create_directories(scratch / "a/b");
    write_file(scratch / "a/b/card.xml", bird);
    start({"a/b/card.xml", "-o", "card.glb"});
    ASSERT_TRUE(comes(of_bird));
    fs::remove(scratch / "a/b/card.xml");
    ASSERT_TRUE(says("a/b/card.xml: error: cannot be read"));
    write_file(scratch / "a/b/card.xml", boat);
    ASSERT_TRUE(comes(of_boat));
    // The directory it is in goes, and another comes.
    fs::rename(scratch / "a", scratch / "gone");
    fs::create_directories(scratch / "a/b");
    write_file(scratch / "a/b/card.xml", bird);
    ASSERT_TRUE(comes(of_bird));
    fs::remove_all(scratch / "a");
    fs::rename(scratch / "gone", scratch / "a");
    ASSERT_TRUE(comes(of_boat));
}

// While a build ends as well, when directories are looked at anew.
TEST_F(Watch, NoChangeIsLostWhereverItFalls) {
    fs::create_directories(scratch / "a");
    write_file(scratch / "a/card.xml", bird);
    start({"a/card.xml", "-o", "card.glb"});
    ASSERT_TRUE(comes(of_bird));
    for (int round = 0; round < sanitized_count(12, 3); ++round) {
        // The output comes just before the build ends; each round a little later.
        ::usleep(static_cast<useconds_t>(200 * round));
        fs::rename(scratch / "a", scratch / ("old" + std::to_string(round)));
        fs::create_directories(scratch / "a");
        write_file(scratch / "a/card.xml", round % 2 == 0 ? boat : bird);
        ASSERT_TRUE(comes(round % 2 == 0 ? of_boat : of_bird)) << round;
    }
}

TEST_F(Watch, LinksAreFollowed) {
    fs::create_directories(scratch / "store/one");
    fs::create_directories(scratch / "store/two");
    write_file(scratch / "store/one/card.xml", bird);
    write_file(scratch / "store/two/card.xml", boat);
    fs::create_symlink("store/one", scratch / "now");
    fs::create_symlink("now/card.xml", scratch / "card.xml");
    start();
    ASSERT_TRUE(comes(of_bird));
    write_file(scratch / "store/one/card.xml", boat);
    ASSERT_TRUE(comes(of_boat));
    write_file(scratch / "store/two/card.xml", bird);
    fs::create_symlink("store/two", scratch / "next");
    fs::rename(scratch / "next", scratch / "now");
    ASSERT_TRUE(comes(of_bird));
}

TEST_F(Watch, MayWaitForAFileThatIsNotThereYet) {
    start();
    ASSERT_TRUE(says("card.xml: error: cannot be read: no such file"));
    replace("card.xml", bird);
    ASSERT_TRUE(comes(of_bird));
}

TEST_F(Watch, OtherFilesAndItsOwnStartNothing) {
    write_file(scratch / "card.xml", bird);
    start({"-v", "card.xml", "-o", "card.glb", "-o", "card.svg", "-MD"});
    ASSERT_TRUE(says("wrote card.glb and 2 more files"));
    write_file(scratch / "other.xml", boat);
    replace("other.xml", bird);
    fs::remove(scratch / "card.glb");
    static_cast<void>(read_file(scratch / "card.xml"));
    ASSERT_EQ(::chmod((scratch / "card.xml").c_str(), 0644), 0);
    // Events come in order: when this change has led to a build, all before it have been seen.
    write_file(scratch / "card.xml", boat);
    ASSERT_TRUE(comes(of_boat));
    ASSERT_TRUE(eventually([&] { return builds() >= 2; }));
    EXPECT_EQ(builds(), 2) << watching->err();
    EXPECT_NE(watching->err().find("popupc: card.xml has changed: wrote card.glb and "), std::string::npos)
        << watching->err();
}

TEST_F(Watch, ManyChangesAreOneBuild) {
    write_file(scratch / "card.xml", bird);
    start({"-v", "card.xml", "-o", "card.glb"});
    ASSERT_TRUE(says("wrote card.glb"));
    // Far less than the quiet time apart, so that no build begins among them; a slow machine may begin a few.
    for (int i = 0; i < 200; ++i) replace("card.xml", i % 2 == 0 ? boat : bird);
    write_file(scratch / "card.xml", boat);
    ASSERT_TRUE(comes(of_boat));
    EXPECT_LT(builds(), 20) << watching->err();
}

TEST_F(Watch, ChangesDuringABuildLeadToOneMore) {
    write_file(scratch / "card.xml", bird);
    start({"-v", "card.xml", "-o", "card.glb"});
    // Whenever it comes, the last change is built.
    for (int i = 0; i < 10; ++i) {
        write_file(scratch / "card.xml", i % 2 == 0 ? boat : bird);
        ASSERT_TRUE(eventually([&, seen = builds()] { return builds() > seen || i % 3 != 0; }));
    }
    write_file(scratch / "card.xml", boat);
    EXPECT_TRUE(comes(of_boat));
}

TEST_F(Watch, WaitsWithoutWork) {
    write_file(scratch / "card.xml", bird);
    start({"-v", "card.xml", "-o", "card.glb"});
    ASSERT_TRUE(says("wrote card.glb"));
    const std::string stat = "/proc/" + std::to_string(watching->pid()) + "/stat";
    // Asleep in poll(), and not woken: voluntary switches stay the same.
    const auto switches = [&] {
        const std::string status = read_file("/proc/" + std::to_string(watching->pid()) + "/status");
        return status.substr(status.find("voluntary_ctxt_switches"));
    };
    const auto sleeps = [&] {
        const std::string text = read_file(stat);
        return text.substr(text.rfind(')') + 2, 1) == "S";
    };
    ASSERT_TRUE(eventually([&] {
        const std::string before = switches();
        ::usleep(100000);
        return sleeps() && switches() == before;
    }));
}

TEST_F(Watch, SignalsEndItWithSuccess) {
    for (const int signal : {SIGINT, SIGTERM}) {
        for (const std::string& card : {bird, std::string("<popup")}) {
            write_file(scratch / "card.xml", card);
            start({"-v", "card.xml", "-o", "card.glb"});
            ASSERT_TRUE(eventually([&] { return builds() == 1; }));
            watching->send(signal);
            EXPECT_EQ(watching->wait(), 0);
            watching.reset();
        }
    }
}

TEST_F(Watch, ASignalDuringABuildLetsItComeToItsEnd) {
    write_file(scratch / "card.xml", bird);
    std::vector<std::string> words(3, "card.xml");
    words.insert(words.end(), {"-o", "card.json", "--solver", "iterative"});
    for (int round = 0; round < 3; ++round) {
        fs::remove(scratch / "card.json");
        start(words);
        // It has begun when its handlers are there.
        ASSERT_TRUE(eventually([&] {
            const std::string status = read_file("/proc/" + std::to_string(watching->pid()) + "/status");
            const std::size_t at = status.find("SigCgt:");
            if (at == std::string::npos) return false;
            const auto caught = std::stoull(status.substr(at + 7), nullptr, 16);
            return (caught >> (SIGTERM - 1) & 1U) != 0 && (caught >> (SIGINT - 1) & 1U) != 0;
        }));
        watching->send(SIGTERM);
        EXPECT_EQ(watching->wait(), 0);
        EXPECT_TRUE(fs::exists(scratch / "card.json")) << "all or nothing, and it had begun";
        watching.reset();
    }
}

TEST_F(Watch, DiagnosticsInAFileAreThoseOfTheLastBuild) {
    write_file(scratch / "card.xml", "<popup");
    start({"card.xml", "-o", "card.glb", "--message-format", "json", "--diagnostics", "found.jsonl"});
    ASSERT_TRUE(eventually([&] { return !read_file(scratch / "found.jsonl").empty(); }));
    write_file(scratch / "card.xml", bird);
    ASSERT_TRUE(comes(of_bird));
    EXPECT_TRUE(eventually([&] { return read_file(scratch / "found.jsonl").empty(); }));
}

TEST_F(Watch, StandardStreamsAndWrongUsageAreRefused) {
    write_file(scratch / "card.xml", bird);
    ASSERT_EQ(::mkfifo((scratch / "pipe.xml").c_str(), 0600), 0);
    const std::vector<std::pair<std::vector<std::string>, std::string>> cases{
        {{"-", "-o", "a.svg"}, "standard input can be read only once"},
        {{"pipe.xml", "-o", "a.svg"}, "pipe.xml can be read only once"},
        {{"card.xml", "-o", "-", "--to", "svg"}, "standard output takes one result"},
        {{"card.xml", "-o", "/dev/stdout", "--to", "svg"}, "standard output takes one result"},
        {{"card.xml", "--emit", "design"}, "standard output takes one result"},
        {{"card.xml", "-o", "a.svg", "--message-format", "json"}, "standard output takes one result"},
        {{"card.xml", "-o", "a.svg", "--diagnostics", "-"}, "standard output takes one result"},
        {{"card.xml", "-o", "a.svg", "-MD", "-MF", "-"}, "standard output takes one result"},
        {{"card.xml"}, "nothing to build"},
        {{"card.xml", "-o", "a.none"}, "the suffix names no format"},
    };
    for (const auto& [words, message] : cases) {
        std::vector<std::string> arguments{"build", "--watch"};
        arguments.insert(arguments.end(), words.begin(), words.end());
        const RunResult result = popupc(arguments, options);
        EXPECT_EQ(result.exit, 2) << message;
        EXPECT_NE(result.err.find(message), std::string::npos) << message << "\n" << result.err;
    }
}

// In a name space of its own, where the limits are ours to set.
TEST_F(Watch, ALimitOfInotifyIsNamed) {
    write_file(scratch / "card.xml", bird);
    for (const auto& [limit, setting] : {std::pair("max_inotify_instances", "fs.inotify.max_user_instances"),
                                         std::pair("max_inotify_watches", "fs.inotify.max_user_watches")}) {
        const RunResult result = run({"unshare", "--user", "--map-root-user", "sh", "-c",
                                      std::string("echo 0 > /proc/sys/user/") + limit + " || exit 77; exec " +
                                          kPopupc + " build --watch card.xml -o card.glb"},
                                     options);
        if (result.exit != 2) GTEST_SKIP() << "no name space can be had here: " << result.err;
        EXPECT_NE(result.err.find(std::string("the limit ") + setting + " is reached"), std::string::npos)
            << result.err;
        EXPECT_NE(result.err.find(std::string("sysctl ") + setting + "=N"), std::string::npos) << result.err;
    }
}

}  // namespace
}  // namespace popup::test
