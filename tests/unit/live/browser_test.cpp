// How a browser is started.
#include "live/browser.h"

#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "support/background.h"
#include "support/run_program.h"

namespace popup::live {
namespace {

namespace fs = std::filesystem;

const std::string kAddress = "http://127.0.0.1:8123/$(touch hit);x/";

class LiveBrowser : public testing::Test {
 protected:
    LiveBrowser() {
        write("browser",
              "for word; do echo \"[$word]\"; done > out.new; ls /proc/self/fd | wc -l >> out.new; mv "
              "out.new out");
        ::setenv("PATH", (scratch.path().string() + ":/usr/bin:/bin").c_str(), 1);
    }
    ~LiveBrowser() override {
        ::unsetenv("BROWSER");
        ::setenv("PATH", path.c_str(), 1);
        ::signal(SIGCHLD, SIG_DFL);  // other tests wait for their programs
    }
    void write(const std::string& name, const std::string& commands) const {
        test::write_file(scratch / name, "#!/bin/sh\ncd " + scratch.path().string() + "\n" + commands + "\n");
        fs::permissions(scratch / name, fs::perms::owner_all);
    }
    // The words that it was started with, and how many files it had open.
    [[nodiscard]] std::string started() const {
        EXPECT_TRUE(test::eventually([this] { return fs::exists(scratch / "out"); }));
        return test::read_file(scratch / "out");
    }

    test::ScratchDirectory scratch;
    std::string path = std::getenv("PATH");
};

TEST_F(LiveBrowser, IsTheFirstThatCanBeStarted) {
    ::setenv("BROWSER", "no-such-browser:browser:another", 1);
    ASSERT_TRUE(open_browser(kAddress));
    // 0, 1, 2, and the directory that ls looks into.
    EXPECT_EQ(started(), "[" + kAddress + "]\n4\n");
    EXPECT_FALSE(fs::exists(scratch / "hit")) << "no shell has seen it";
}

TEST_F(LiveBrowser, TakesArguments) {
    ::setenv("BROWSER", "browser --new 'x' --app=%s y", 1);
    ASSERT_TRUE(open_browser(kAddress));
    EXPECT_EQ(started(), "[--new]\n['x']\n[--app=" + kAddress + "]\n[y]\n4\n");
}

TEST_F(LiveBrowser, IsTheDesktopsElse) {
    ::setenv("BROWSER", "", 1);
    write("xdg-open", "exec ./browser desktop \"$@\"");
    ASSERT_TRUE(open_browser(kAddress));
    EXPECT_EQ(started(), "[desktop]\n[" + kAddress + "]\n4\n");
}

TEST_F(LiveBrowser, MayBeMissing) {
    ::setenv("BROWSER", "no-such-browser: :", 1);
    ::setenv("PATH", scratch.path().c_str(), 1);
    EXPECT_FALSE(open_browser(kAddress));
}

}  // namespace
}  // namespace popup::live
