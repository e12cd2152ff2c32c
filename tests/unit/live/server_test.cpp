// The server against clients that are slow, many, rude or gone.
#include "live/server.h"

#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "live/policy.h"
#include "support/background.h"
#include "support/sanitized.h"
#include "support/wire.h"

namespace popup::live {
namespace {

using std::chrono::milliseconds;
using test::get;
using test::get_request;
using test::HttpAnswer;
using test::HttpPlace;
using test::place_of;
using test::Wire;

constexpr milliseconds kNever{1'000'000};

class LiveServer : public testing::Test {
 protected:
    void start(const Limits& limits = {}, milliseconds idle = milliseconds(0)) {
        Serving serving{.page = "<!doctype html>", .policy = "default-src 'none'"};
        serving.limits = limits;
        serving.idle = idle;
        serving.forsaken = [this] { forsaken = true; };
        server = std::make_unique<Server>(std::move(serving));
        place = place_of(server->address());
    }
    int status(const std::string& request) const {
        Wire wire(place.port);
        wire.send(request);
        const auto answer = wire.answer(!request.starts_with("HEAD"));
        return answer ? answer->status : 0;
    }

    // More than the system takes of an answer that nobody reads.
    static std::string large() {
        std::string text = "\"";
        text.resize(50'000'000, 'x');
        return text + "\"";
    }

    std::atomic<bool> forsaken{false};
    std::unique_ptr<Server> server;
    HttpPlace place;
};

TEST_F(LiveServer, ServesThePageAndNothingElse) {
    start();
    const HttpAnswer page = get(server->address());
    EXPECT_EQ(page.status, 200);
    EXPECT_EQ(page.body, "<!doctype html>");
    EXPECT_EQ(page.headers.at("content-type"), "text/html; charset=utf-8");
    EXPECT_EQ(page.headers.at("content-security-policy"), "default-src 'none'; frame-ancestors 'none'");
    const HttpAnswer none = get(server->address(), "other");
    EXPECT_EQ(none.status, 404);
    for (const HttpAnswer& answer : {page, none}) {
        for (const auto& [name, value] : kHeaders) {
            std::string lower(name);
            for (char& c : lower) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
            ASSERT_TRUE(answer.headers.contains(lower)) << name;
            EXPECT_EQ(answer.headers.at(lower), value);
        }
        EXPECT_NE(answer.headers.at("content-security-policy").find("frame-ancestors 'none'"),
                  std::string::npos);
    }
    Wire wire(place.port);
    std::string head = get_request(place);
    head.replace(0, 3, "HEAD");
    ASSERT_TRUE(wire.send(head));
    const auto answer = wire.answer(false);
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->status, 200);
    EXPECT_EQ(answer->headers.at("content-length"), "15");
    ASSERT_TRUE(wire.send(get_request(place))) << "the connection goes on";
    EXPECT_EQ(wire.answer()->body, "<!doctype html>") << "and had no body in between";
}

TEST_F(LiveServer, RefusesWhatIsNotForIt) {
    start();
    const std::string host = "Host: 127.0.0.1:" + std::to_string(place.port) + "\r\n";
    const std::string line = "GET " + place.path + " HTTP/1.1\r\n";
    EXPECT_EQ(status(line + host + "\r\n"), 200);
    EXPECT_EQ(status(line + "\r\n"), 421) << "no host";
    EXPECT_EQ(status(line + host + host + "\r\n"), 421) << "two hosts";
    EXPECT_EQ(status(line + "Host: evil.example\r\n\r\n"), 421);
    EXPECT_EQ(status(line + host + "Origin: http://evil.example\r\n\r\n"), 403);
    EXPECT_EQ(status(line + host + "Sec-Fetch-Site: cross-site\r\n\r\n"), 403);
    EXPECT_EQ(status(line + host + "Sec-Fetch-Site: none\r\nSec-Fetch-Site: none\r\n\r\n"), 403);
    EXPECT_EQ(status("GET / HTTP/1.1\r\n" + host + "\r\n"), 404);
    EXPECT_EQ(status("GET /../../etc/passwd HTTP/1.1\r\n" + host + "\r\n"), 404);
    EXPECT_EQ(status("POST " + place.path + " HTTP/1.1\r\n" + host + "\r\n"), 405);
    EXPECT_EQ(status("POST " + place.path + " HTTP/1.1\r\n" + host + "Content-Length: 3\r\n\r\nabc"), 413);
    EXPECT_EQ(
        status("POST " + place.path + " HTTP/1.1\r\n" + host + "Content-Length: 99999999999\r\n\r\nabc"),
        413);
    EXPECT_EQ(status(line + host + "Transfer-Encoding: chunked\r\n\r\n3\r\nabc\r\n0\r\n\r\n"), 413);
    EXPECT_EQ(status("GET /" + std::string(1000, 'a') + " HTTP/1.1\r\n" + host + "\r\n"), 414);
    EXPECT_EQ(status(line + host + "X: " + std::string(100'000, 'a') + "\r\n\r\n"), 431);
    EXPECT_EQ(status("GET /" + std::string(1'000'000, 'a')), 431);
    std::string many;
    for (int i = 0; i < 2000; ++i) many += "X" + std::to_string(i) + ": y\r\n";
    EXPECT_EQ(status(line + host + many + "\r\n"), 431);
    EXPECT_EQ(status("\x16\x03\x01\x02\r\n\r\n"), 400) << "TLS";
    EXPECT_EQ(status("SSH-2.0-x\r\n\r\n"), 400);
    EXPECT_EQ(status("GET " + place.path + " HTTP/9.9\r\n" + host + "\r\n"), 400);
    EXPECT_EQ(status(line + host + "Content-Length: x\r\n\r\n"), 400);
    // It is still there.
    EXPECT_EQ(get(server->address()).status, 200);
}

TEST_F(LiveServer, ThePortIsItsOwn) {
    start();
    Serving second{.page = "x", .policy = "y"};
    second.port = place.port;
    try {
        const Server other(std::move(second));
        FAIL() << "two listen on one port";
    } catch (const CannotServe& error) {
        EXPECT_TRUE(error.in_use());
    }
    // Once it has ended the port can be had at once, also after it had connections.
    const std::uint16_t port = place.port;
    EXPECT_EQ(get(server->address()).status, 200);
    server.reset();
    EXPECT_THROW(Wire{port}, std::runtime_error) << "nobody listens any more";
    Serving again{.page = "x", .policy = "y"};
    again.port = port;
    const Server other(std::move(again));
    EXPECT_EQ(get(other.address()).status, 200);
}

TEST_F(LiveServer, WhoWaitsIsToldOfWhatIsNew) {
    start();
    std::vector<std::unique_ptr<Wire>> wires;
    for (int i = 0; i < 20; ++i) {
        wires.push_back(std::make_unique<Wire>(place.port));
        ASSERT_TRUE(wires.back()->send(get_request(place, "next?after=0")));
    }
    EXPECT_EQ(get(server->address(), "now?after=0").status, 204);
    for (int round = 1; round <= 5; ++round) {
        server->put({.model = "[" + std::to_string(round) + "]"});
        for (const auto& wire : wires) {
            const auto answer = wire->answer();
            ASSERT_TRUE(answer);
            EXPECT_EQ(answer->status, 200);
            EXPECT_EQ(nlohmann::json::parse(answer->body).at("model"), nlohmann::json::array({round}));
            ASSERT_TRUE(wire->send(get_request(place, "next?after=" + std::to_string(round))));
        }
    }
    EXPECT_EQ(nlohmann::json::parse(get(server->address(), "now?after=4").body).at("version"), 5);
}

TEST_F(LiveServer, SaysThatThereIsNothingNew) {
    start({.wait = milliseconds(50)});
    const HttpAnswer answer = get(server->address(), "next?after=0");
    EXPECT_EQ(answer.status, 204);
    EXPECT_FALSE(answer.headers.contains("content-length"));
}

// Half a request, drop by drop: each drop is in time, and the whole is not.
TEST_F(LiveServer, CutsOffWhoTakesTooLongToAsk) {
    start({.request = milliseconds(300)});
    Wire silent(place.port);
    Wire half(place.port);
    ASSERT_TRUE(half.send("GET " + place.path));
    Wire dripping(place.port);
    std::atomic<bool> stop{false};
    std::thread drip([&] {
        dripping.send("GET / HTTP/1.1\r\nX: ");
        while (!stop && dripping.send("y")) std::this_thread::sleep_for(milliseconds(20));
    });
    EXPECT_TRUE(silent.ends());
    EXPECT_TRUE(half.ends());
    EXPECT_TRUE(dripping.ends());
    stop = true;
    drip.join();
    EXPECT_EQ(get(server->address()).status, 200);
}

TEST_F(LiveServer, CutsOffWhoDoesNotTakeAnswers) {
    start({.connections = 1, .answer = milliseconds(300)});
    server->put({.model = large()});
    Wire lazy(place.port);
    ASSERT_TRUE(lazy.send(get_request(place, "now?after=0")));
    // The only connection is free again some time.
    EXPECT_EQ(get(server->address()).status, 200);
}

// Two hundred that say nothing, and one that asks.
TEST_F(LiveServer, HoldsAStatedNumberOfConnections) {
    start({.connections = 16, .request = milliseconds(500)});
    std::vector<std::unique_ptr<Wire>> silent;
    silent.reserve(200);
    for (int i = 0; i < 200; ++i) silent.push_back(std::make_unique<Wire>(place.port));
    const auto descriptors = [] {
        return std::distance(std::filesystem::directory_iterator("/proc/self/fd"),
                             std::filesystem::directory_iterator());
    };
    EXPECT_LT(descriptors(), 200 + 16 + 40) << "what it does not serve it has not taken in";
    EXPECT_EQ(get(server->address()).status, 200) << "it comes to its turn";
    for (const auto& wire : silent) EXPECT_TRUE(wire->ends());
}

TEST_F(LiveServer, ServesTwoHundredAtATimeThatAsk) {
    start({.connections = 8});
    std::vector<std::unique_ptr<Wire>> wires;
    for (int i = 0; i < 200; ++i) {
        wires.push_back(std::make_unique<Wire>(place.port));
        ASSERT_TRUE(wires.back()->send(get_request(place, "", {"Connection: close"})));
    }
    // Who has an answer goes, as browsers do: the server waits a second for those who do not.
    for (auto& wire : wires) {
        const auto answer = wire->answer();
        ASSERT_TRUE(answer);
        EXPECT_EQ(answer->status, 200);
        wire.reset();
    }
}

TEST_F(LiveServer, ForgetsWhoHasGone) {
    start({.connections = 4, .request = kNever, .wait = kNever});
    for (int round = 0; round < 50; ++round) {
        Wire wire(place.port);
        ASSERT_TRUE(wire.send(get_request(place, "next?after=0")));
    }
    EXPECT_EQ(get(server->address()).status, 200) << "none of fifty holds one of four places";
}

TEST_F(LiveServer, EndsAtOnceWhateverIsOpen) {
    start({.request = kNever, .wait = kNever, .answer = kNever});
    server->put({.model = large()});
    Wire silent(place.port);
    Wire lazy(place.port);
    ASSERT_TRUE(lazy.send(get_request(place, "now?after=0")));
    Wire waiting(place.port);
    ASSERT_TRUE(waiting.send(get_request(place, "next?after=1")));
    ASSERT_EQ(get(server->address(), "now?after=1").status, 204) << "all were heard";
    server.reset();
    const auto farewell = waiting.answer();
    ASSERT_TRUE(farewell);
    EXPECT_EQ(farewell->body, "{\"over\":true}");
    EXPECT_TRUE(waiting.ends());
    EXPECT_TRUE(silent.ends());
}

TEST_F(LiveServer, TellsWhenNobodyHasAskedForLong) {
    start({}, milliseconds(1));
    EXPECT_TRUE(test::eventually([this] { return forsaken.load(); }));
}

TEST_F(LiveServer, WhoWaitsIsSomebody) {
    start({.wait = kNever}, milliseconds(100));
    auto waiting = std::make_unique<Wire>(place.port);
    ASSERT_TRUE(waiting->send(get_request(place, "next?after=0")));
    ASSERT_EQ(get(server->address(), "now?after=0").status, 204);
    // Several times as long as it has patience; no more can be said of what does not happen.
    std::this_thread::sleep_for(milliseconds(400));
    EXPECT_FALSE(forsaken);
    waiting.reset();
    EXPECT_TRUE(test::eventually([this] { return forsaken.load(); }));
}

// What it holds does not grow with what it has told.
TEST_F(LiveServer, TenThousandNewsTakeNoMoreRoom) {
    start();
    const auto memory = [] {
        const std::string status = test::read_file("/proc/self/status");
        return std::stol(status.substr(status.find("VmRSS:") + 6));
    };
    Wire page(place.port);
    const std::string model = "\"" + std::string(20'000, 'x') + "\"";
    const auto round = [&](int version) {
        server->put({.model = model, .sheets = model, .findings = model});
        ASSERT_TRUE(page.send(get_request(place, "next?after=" + std::to_string(version - 1))));
        const auto answer = page.answer();
        ASSERT_TRUE(answer);
        ASSERT_NE(answer->body.find("{\"version\":" + std::to_string(version) + ","), std::string::npos);
    };
    const int rounds = test::sanitized_count(10'000, 4);
    for (int i = 1; i <= 1000; ++i) ASSERT_NO_FATAL_FAILURE(round(i));
    const long before = memory();
    for (int i = 1001; i <= rounds; ++i) ASSERT_NO_FATAL_FAILURE(round(i));
    EXPECT_LT(memory() - before, 20'000) << "kB; kept, ten thousand would be 500 MB";
}

}  // namespace
}  // namespace popup::live
