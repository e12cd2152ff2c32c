// The jobserver of make, played by a server that knows each of its tokens, and by make itself.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/ioctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <iterator>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "support/background.h"
#include "support/run_program.h"

namespace popup::test {
namespace {

const std::filesystem::path kSource = POPUP_SOURCE_DIR;

// A server that has put these bytes into its pipe or FIFO.
class Server {
 public:
    enum class Kind { pipe, fifo };
    Server(Kind kind, const std::string& tokens) : tokens_(tokens) {
        if (kind == Kind::fifo) {
            fifo_ = scratch_ / "server";
            if (::mkfifo(fifo_.c_str(), 0600) != 0) throw std::runtime_error("no FIFO");
            read_ = write_ = ::open(fifo_.c_str(), O_RDWR | O_CLOEXEC);
        } else {
            int ends[2];
            if (::pipe(ends) != 0) throw std::runtime_error("no pipe");
            // Away from the numbers that a shell uses, and inherited.
            read_ = ::fcntl(ends[0], F_DUPFD, 20);
            write_ = ::fcntl(ends[1], F_DUPFD, 20);
            ::close(ends[0]);
            ::close(ends[1]);
        }
        if (::write(write_, tokens_.data(), tokens_.size()) < 0) throw std::runtime_error("no tokens");
    }
    Server(const Server&) = delete;
    Server& operator=(const Server&) = delete;
    ~Server() {
        ::close(read_);
        if (write_ != read_) ::close(write_);
    }
    [[nodiscard]] std::string place() const {
        return fifo_.empty() ? std::to_string(read_) + "," + std::to_string(write_) : "fifo:" + fifo_;
    }
    [[nodiscard]] RunOptions options(const std::string& name = "--jobserver-auth=") const {
        RunOptions options;
        options.environment["MAKEFLAGS"] = " -j9 " + name + place();
        return options;
    }
    // How many are there now.
    [[nodiscard]] int there() const {
        int count = 0;
        ::ioctl(read_, FIONREAD, &count);
        return count;
    }
    // Every token is there again, and nothing else.
    [[nodiscard]] bool complete() const {
        std::string bytes(1024, '\0');
        const int count = there();
        const ssize_t got = count > 0 ? ::read(read_, bytes.data(), bytes.size()) : 0;
        bytes.resize(static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
        const bool blocking = (::fcntl(read_, F_GETFL) & O_NONBLOCK) == 0;
        if (::write(write_, bytes.data(), bytes.size()) < 0) return false;
        std::string wanted = tokens_;
        std::sort(wanted.begin(), wanted.end());
        std::sort(bytes.begin(), bytes.end());
        return bytes == wanted && blocking;
    }

 private:
    ScratchDirectory scratch_;
    std::string tokens_;
    std::string fifo_;
    int read_ = -1;
    int write_ = -1;
};

// A check of so many designs that there is time to look.
std::vector<std::string> long_check(int designs, const std::string& option = "-q") {
    std::vector<std::string> words{kPopupc, "check", option, "--solver", "iterative"};
    for (int i = 0; i < designs; ++i) words.push_back(kSource / "samples/castle.xml");
    return words;
}

class JobserverOf : public testing::TestWithParam<Server::Kind> {
 protected:
    // Some of the signals would leave an image of the memory.
    void SetUp() override {
        const rlimit none{0, 0};
        ::setrlimit(RLIMIT_CORE, &none);
    }
};
INSTANTIATE_TEST_SUITE_P(Kinds, JobserverOf, testing::Values(Server::Kind::pipe, Server::Kind::fifo),
                         [](const auto& info) { return info.param == Server::Kind::pipe ? "Pipe" : "Fifo"; });

TEST_P(JobserverOf, TokensAreTakenForThreadsAndAllGivenBack) {
    const Server server(GetParam(), "abc");
    Background check(long_check(120), server.options());
    int least = 3;
    int most = 0;
    EXPECT_TRUE(eventually([&] {
        least = std::min(least, server.there());
        most = std::max(most, check.threads());
        return !check.running();
    }));
    EXPECT_EQ(check.wait(), 0) << check.err();
    EXPECT_EQ(least, 0);
    EXPECT_EQ(most, 4) << "one thread of its own and one for each token";
    EXPECT_TRUE(server.complete());
}

TEST_P(JobserverOf, WithoutTokensThereIsOneThread) {
    const Server server(GetParam(), "");
    Background check(long_check(10), server.options());
    int most = 0;
    EXPECT_TRUE(eventually([&] {
        most = std::max(most, check.threads());
        return !check.running();
    }));
    EXPECT_EQ(check.wait(), 0) << check.err();
    EXPECT_EQ(check.err(), "");
    EXPECT_EQ(most, 1);
    EXPECT_TRUE(server.complete());
}

TEST_P(JobserverOf, TokensComeBackAfterSignals) {
    for (const int signal : {SIGTERM, SIGINT, SIGHUP, SIGQUIT, SIGUSR1, SIGABRT}) {
        const Server server(GetParam(), "wxyz");
        Background check(long_check(200), server.options());
        ASSERT_TRUE(eventually([&] { return server.there() == 0; }));
        check.send(signal);
        EXPECT_EQ(check.wait(), 128 + signal);
        EXPECT_TRUE(server.complete()) << signal;
    }
}

// A batch has a process for each token, and one; whoever of them dies.
TEST_P(JobserverOf, ABatchHasAProcessForEachToken) {
    const ScratchDirectory scratch;
    std::string manifest;
    for (int i = 0; i < 60; ++i) {
        manifest += R"({"input": ")" + (kSource / "samples/castle.xml").string() + R"(", "output": "out/)" +
                    std::to_string(i) + R"(.svg"})" + "\n";
    }
    write_file(scratch / "jobs.jsonl", manifest);
    for (const int signal : {0, SIGKILL, SIGTERM}) {
        std::filesystem::remove_all(scratch / "out");
        const Server server(GetParam(), "ab");
        RunOptions options = server.options();
        options.directory = scratch.path();
        Background batch({kPopupc, "batch", "jobs.jsonl", "-q"}, options);
        const std::string id = std::to_string(batch.pid());
        std::vector<pid_t> workers;
        ASSERT_TRUE(eventually([&] {
            std::istringstream list(read_file("/proc/" + id + "/task/" + id + "/children"));
            workers.assign(std::istream_iterator<pid_t>(list), {});
            return workers.size() == 3 || !batch.running();
        }));
        EXPECT_EQ(workers.size(), 3U);
        EXPECT_EQ(server.there(), 0);
        if (signal == SIGKILL) {
            for (const pid_t worker : workers) ::kill(worker, SIGKILL);
        } else if (signal != 0) {
            batch.send(signal);
        }
        EXPECT_EQ(batch.wait(), signal == SIGTERM ? 128 + SIGTERM : 0) << batch.err();
        EXPECT_TRUE(server.complete()) << signal;
    }
}

// The search for places asks for a thread too, and ends at the first interrupt with what it has.
TEST_P(JobserverOf, ASearchThatIsStoppedGivesItsTokenBack) {
    const ScratchDirectory scratch;
    for (const auto& [signal, exit] : {std::pair(SIGINT, 0), std::pair(SIGTERM, 128 + SIGTERM)}) {
        const Server server(GetParam(), "abc");
        RunOptions options = server.options();
        options.directory = scratch.path();
        Background build({kPopupc, "build", "-q", "--nest-time", "600", "--sheet", "a1", "--copies", "5",
                          kSource / "samples/castle.xml", "-o", "a.svg"},
                         options);
        ASSERT_TRUE(eventually([&] { return server.there() < 3; }));
        EXPECT_EQ(server.there(), 2) << "there is work for two";
        build.send(signal);
        EXPECT_EQ(build.wait(), exit) << build.err();
        EXPECT_TRUE(server.complete());
    }
}

// At whatever moment the signal comes: while tokens are on their way, too.
TEST_P(JobserverOf, TokensComeBackWhenSignalsComeEarly) {
    const Server server(GetParam(), "0123456789");
    for (int round = 0; round < 40; ++round) {
        Background check(long_check(200), server.options());
        ASSERT_TRUE(eventually([&] { return server.there() < 10 - round % 10; }));
        check.send(round % 2 == 0 ? SIGTERM : SIGINT);
        EXPECT_GT(check.wait(), 128);
        ASSERT_TRUE(server.complete()) << round;
    }
}

TEST_P(JobserverOf, TokensComeBackAfterEveryEnd) {
    const Server server(GetParam(), "abc");
    const ScratchDirectory scratch;
    RunOptions options = server.options();
    options.directory = scratch.path();
    const std::string castle = kSource / "samples/castle.xml";
    const std::string bird = kSource / "samples/bird.xml";
    EXPECT_EQ(popupc({"build", castle, bird, castle, "-o", "a.svg"}, options).exit, 0);
    EXPECT_TRUE(server.complete());
    EXPECT_EQ(popupc({"build", castle, bird, "--sheet", "20x20", "-o", "a.svg"}, options).exit, 1);
    EXPECT_TRUE(server.complete());
    EXPECT_EQ(popupc({"check", castle, "missing.xml", bird}, options).exit, 2);
    EXPECT_TRUE(server.complete());
    EXPECT_EQ(popupc({"build", castle, bird, "-o", "a.unknown"}, options).exit, 2);
    EXPECT_TRUE(server.complete());
}

TEST_P(JobserverOf, IsNotAskedWhereThreadsAreNamed) {
    const Server server(GetParam(), "abc");
    std::vector<std::string> words = long_check(20);
    words.emplace_back("-j2");
    Background check(words, server.options());
    int most = 0;
    int least = 3;
    EXPECT_TRUE(eventually([&] {
        most = std::max(most, check.threads());
        least = std::min(least, server.there());
        return !check.running();
    }));
    EXPECT_LE(most, 2);
    EXPECT_EQ(least, 3);
}

TEST_P(JobserverOf, ResultsDoNotDependOnTokens) {
    const Server none(GetParam(), "");
    const Server many(GetParam(), "abcdefgh");
    const ScratchDirectory scratch;
    for (const auto& [server, name] : {std::pair(&none, "none"), std::pair(&many, "many")}) {
        RunOptions options = server->options();
        options.directory = scratch.path();
        std::vector<std::string> words{
            "build", "--copies", "3", "--sheet", "a2", "-o", std::string(name) + ".svg"};
        for (const char* sample : {"castle", "bird", "house", "stairs"}) {
            words.push_back(kSource / "samples" / (std::string(sample) + ".xml"));
        }
        const RunResult result = popupc(words, options);
        EXPECT_EQ(result.exit, 0) << result.err;
    }
    EXPECT_TRUE(read_file(scratch / "none.svg") == read_file(scratch / "many.svg"));
    EXPECT_TRUE(many.complete());
}

TEST(Jobserver, TheOldSpellingIsKnownAndTheLastCounts) {
    const Server server(Server::Kind::pipe, "abc");
    const Server other(Server::Kind::fifo, "uvw");
    for (const std::string& flags :
         {"--jobserver-fds=" + server.place(),
          "--jobserver-auth=" + other.place() + " --jobserver-auth=" + server.place(),
          "k --jobserver-auth=-2,-2 -j8 --jobserver-auth=" + server.place() + " -- --jobserver-auth=77,78"}) {
        RunOptions options;
        options.environment["MAKEFLAGS"] = flags;
        Background check(long_check(400), options);
        EXPECT_TRUE(eventually([&] { return server.there() == 0; })) << flags;
        EXPECT_EQ(other.there(), 3) << flags;
        check.send(SIGTERM);
        EXPECT_EQ(check.wait(), 128 + SIGTERM);
        EXPECT_TRUE(server.complete());
    }
}

TEST(Jobserver, WhatCannotBeUsedMeansOneThread) {
    const Server server(Server::Kind::pipe, "abc");
    const Server other(Server::Kind::pipe, "abc");
    const ScratchDirectory scratch;
    write_file(scratch / "file", "abc");
    const std::string read_end = server.place().substr(0, server.place().find(','));
    const std::string write_end = other.place().substr(other.place().find(',') + 1);
    for (const std::string& place :
         {std::string("-2,-2"), std::string("900,901"), std::string("0,1"), std::string("3"),
          std::string("a,b"), std::string("99999999999999999999,1"), read_end + "," + read_end,
          read_end + "," + write_end, "fifo:" + (scratch / "nothing").string(),
          "fifo:" + (scratch / "file").string(), std::string("fifo:"), std::string("fifo:/dev/null"),
          std::string("sem:something")}) {
        RunOptions options;
        options.environment["MAKEFLAGS"] = "-j4 --jobserver-auth=" + place;
        Background check(long_check(3, "-v"), options);
        int most = 0;
        EXPECT_TRUE(eventually([&] {
            most = std::max(most, check.threads());
            return !check.running();
        }));
        EXPECT_EQ(check.wait(), 0);
        EXPECT_EQ(most, 1) << place;
        const std::string err = check.err();
        EXPECT_NE(err.find("jobserver (" + place + ") cannot be used"), std::string::npos) << err;
        EXPECT_NE(err.find("begin the recipe with \"+\""), std::string::npos) << err;
        EXPECT_TRUE(server.complete() && other.complete()) << place;
        // And nothing of it without --verbose.
        EXPECT_EQ(run(long_check(1), options).err, "") << place;
    }
}

TEST(Jobserver, GarbageInMakeflagsIsNoServer) {
    for (const std::string flags :
         {"", " ", "-j", "-j4 -k", "\\", "\\\\ \\", "--jobserver-auth", "w -- A=--jobserver-auth=3,4"}) {
        RunOptions options;
        options.environment["MAKEFLAGS"] = flags;
        const RunResult result = popupc({"check", "-v", kSource / "samples/bird.xml"}, options);
        EXPECT_EQ(result.exit, 0) << flags;
        EXPECT_EQ(result.err.find("jobserver"), std::string::npos) << result.err;
    }
}

// GNU make counts its tokens at the end, and says so when one is lost.
TEST(Jobserver, RealMakeLosesNoToken) {
    if (!have_program("make")) GTEST_SKIP() << "make is not installed";
    const ScratchDirectory scratch;
    write_file(
        scratch / "Makefile",
        "names := 1 2 3 4 5 6\nall: $(names) plain\n$(names):\n\t+$(POPUPC) check -v $(DESIGNS) 2> $@.err\n"
        "plain:\n\t$(POPUPC) check -v $(DESIGNS) 2> $@.err\n.PHONY: all $(names)\n");
    std::string designs = "DESIGNS=";
    for (int i = 0; i < 8; ++i) designs += (kSource / "samples/castle.xml").string() + " ";
    RunOptions options;
    options.environment["MAKEFLAGS"] = "";
    const RunResult result =
        run({"make", "-C", scratch.path(), "-j8", std::string("POPUPC=") + kPopupc, designs}, options);
    EXPECT_EQ(result.exit, 0) << result.err;
    EXPECT_EQ(result.err, "");
    for (int i = 1; i <= 6; ++i) {
        const std::string err = read_file(scratch / (std::to_string(i) + ".err"));
        EXPECT_EQ(err.find("jobserver"), std::string::npos) << err;
    }
    EXPECT_NE(read_file(scratch / "plain.err").find("begin the recipe with \"+\""), std::string::npos);
}

}  // namespace
}  // namespace popup::test
