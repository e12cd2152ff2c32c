// What is shown of a run's progress, and where.
#include <gtest/gtest.h>
#include <pty.h>
#include <sys/ioctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "cli/progress_line.h"
#include "support/run_program.h"
#include "support/sanitized.h"

namespace popup {
namespace {

TEST(Progress, TextHasCountRateAndTimeLeft) {
    EXPECT_EQ(progress_text({0, 100, 0.0}), "0 of 100 designs");
    EXPECT_EQ(progress_text({0, 100, 3.0}), "0 of 100 designs");
    EXPECT_EQ(progress_text({25, 100, 2.0}), "25 of 100 designs, 12.5/s, 6 s left");
    EXPECT_EQ(progress_text({1, 100, 1.0}), "1 of 100 designs, 1.0/s, 1:39 left");
    EXPECT_EQ(progress_text({1, 10'000, 1.0}), "1 of 10000 designs, 1.0/s, 2:46:39 left");
    EXPECT_EQ(progress_text({5000, 10'000, 10.0}), "5000 of 10000 designs, 500/s, 10 s left");
    EXPECT_EQ(progress_text({100, 100, 8.0}), "100 of 100 designs, 12.5/s");
    EXPECT_LT(progress_text({1, 1'000'000'000, 1e6}).size(), 80U);
}

TEST(Progress, ABarNeverReachesTheLastColumn) {
    const ProgressState half{50, 100, 5.0};
    for (std::size_t columns = 0; columns < 200; ++columns) {
        EXPECT_LE(progress_bar(half, columns).size(), columns == 0 ? 0 : columns - 1);
    }
    const std::string text = progress_text(half);
    EXPECT_EQ(progress_bar(half, 1000),
              "[" + std::string(30, '=') + ">" + std::string(29, ' ') + "] " + text);
    EXPECT_EQ(progress_bar(half, text.size() + 1), text);
    EXPECT_EQ(progress_bar(half, 5), text.substr(0, 4));
    EXPECT_TRUE(progress_bar({100, 100, 5.0}, 1000).starts_with("[" + std::string(60, '=') + "] "));
}

// Runs popupc on a terminal with so many columns; what the terminal gets to show.
std::string on_terminal(std::vector<std::string> words, unsigned short columns) {
    winsize size{};
    size.ws_col = columns;
    size.ws_row = 24;
    int terminal = -1;
    words.insert(words.begin(), test::kPopupc);
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    const pid_t child = ::forkpty(&terminal, nullptr, nullptr, &size);
    if (child == 0) {
        ::execv(pointers[0], pointers.data());
        ::_exit(127);
    }
    EXPECT_GT(child, 0);
    std::string shown;
    std::array<char, 4096> buffer{};
    for (ssize_t got = 0; (got = ::read(terminal, buffer.data(), buffer.size())) > 0;) {
        shown.append(buffer.data(), static_cast<std::size_t>(got));
    }
    ::close(terminal);
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_TRUE(WIFEXITED(status));
    EXPECT_NE(WEXITSTATUS(status), 127);
    return shown;
}

void make_designs(const std::filesystem::path& where, int count, const std::string& sample) {
    const std::string text = test::read_file(std::string(POPUP_SOURCE_DIR) + sample);
    for (int i = 0; i < count; ++i) test::write_file(where / ("card" + std::to_string(i) + ".xml"), text);
}

TEST(Progress, OnATerminalThereIsABarThatFitsAndIsTakenAway) {
    const test::ScratchDirectory designs;
    // Its examination takes long enough for a bar to be drawn at least once.
    const int kCount = test::sanitized_count(10, 5);
    const std::string all = std::to_string(kCount);
    make_designs(designs.path(), kCount, "/samples/whale.xml");
    for (const unsigned short columns : {40, 100}) {
        const std::string shown = on_terminal({"check", "-j1", "--color", "never", designs.path()}, columns);
        const std::string erased = "\r\x1b[K";
        const std::size_t last = shown.rfind(erased);
        ASSERT_NE(last, std::string::npos) << shown;
        EXPECT_NE(shown.find(" of " + all + " designs"), std::string::npos) << shown;
        EXPECT_EQ(shown.find(all + " of " + all + " designs"), std::string::npos) << shown;
        EXPECT_EQ(shown.find(" designs,", last), std::string::npos) << "the bar is left standing: " << shown;
        for (std::size_t at = shown.find('\r'); at < last;) {
            const std::size_t end = shown.find('\r', at + 1);
            const std::string drawn = shown.substr(at + 1, shown.find("\x1b[K", at) - at - 1);
            EXPECT_LT(drawn.size(), columns);
            EXPECT_EQ(drawn.find('\n'), std::string::npos);
            at = end;
        }
        EXPECT_EQ(shown.find('[') < last && columns == 100, columns == 100);
    }
    EXPECT_EQ(on_terminal({"check", "-j1", "-q", "--color", "never", designs.path()}, 80).find(" designs,"),
              std::string::npos);
}

TEST(Progress, WithoutATerminalThereAreLinesOnlyOnRequestAndTheLastIsForAll) {
    const test::ScratchDirectory designs;
    make_designs(designs.path(), 2, "/samples/castle.xml");
    const auto run = [&](const char* when) {
        return test::popupc({"check", "--progress", when, designs.path()}).err;
    };
    EXPECT_EQ(run("auto").find(" designs,"), std::string::npos);
    EXPECT_EQ(run("never").find(" designs,"), std::string::npos);
    const std::string lines = run("always");
    EXPECT_NE(lines.find("popupc: 2 of 2 designs, "), std::string::npos) << lines;
    EXPECT_EQ(lines.find('\r'), std::string::npos);
    EXPECT_EQ(lines.find('\x1b'), std::string::npos);
}

}  // namespace
}  // namespace popup
