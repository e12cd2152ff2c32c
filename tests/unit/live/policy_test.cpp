// Who is answered what, and what pages are told.
#include "live/policy.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include "live/news.h"
#include "live/token.h"

namespace popup::live {
namespace {

const std::string kToken = "0123456789abcdef0123456789abcdef";
const Door kDoor{kToken, 8123};
const std::string kPath = "/" + kToken + "/";

Request good() {
    return {.method = "GET",
            .target = kPath,
            .host = "127.0.0.1:8123",
            .origin = "",
            .fetch_site = "",
            .has_body = false};
}

int status_of(const Request& request, const Door& door = kDoor) {
    const Verdict verdict = judge(request, door);
    const auto* refused = std::get_if<Refused>(&verdict);
    if (refused == nullptr) return 200;
    EXPECT_FALSE(refused->why.empty());
    return refused->status;
}

TEST(LivePolicy, AnswersWhoHasTheAddress) {
    EXPECT_EQ(kDoor.address(), "http://127.0.0.1:8123" + kPath);
    Request request = good();
    EXPECT_EQ(std::get<Asked>(judge(request, kDoor)), (Asked{Wanted::page, 0, false}));
    for (const char* host : {"127.0.0.1:8123", "localhost:8123", "LocalHost:8123"}) {
        request.host = host;
        EXPECT_EQ(status_of(request), 200) << host;
    }
    for (const char* site : {"none", "same-origin"}) {
        request.fetch_site = site;
        EXPECT_EQ(status_of(request), 200) << site;
    }
    for (const char* origin : {"http://127.0.0.1:8123", "http://localhost:8123"}) {
        request.origin = origin;
        EXPECT_EQ(status_of(request), 200) << origin;
    }
    const std::string next = kPath + "next?after=12";
    request.target = next;
    EXPECT_EQ(std::get<Asked>(judge(request, kDoor)), (Asked{Wanted::next, 12, false}));
    const std::string now = kPath + "now?after=18446744073709551615";
    request.target = now;
    request.method = "HEAD";
    EXPECT_EQ(std::get<Asked>(judge(request, kDoor)), (Asked{Wanted::now, ~std::uint64_t{0}, true}));
}

TEST(LivePolicy, RefusesOtherNames) {
    for (const char* host :
         {"", "127.0.0.1", "localhost", "127.0.0.1:8124", "evil.example", "evil.example:8123",
          "127.0.0.1:8123.evil.example", "127.0.0.1.evil.example:8123", "localhost.:8123", "[::1]:8123",
          "127.1:8123", "127.0.0.2:8123", "0.0.0.0:8123", "127.0.0.1:08123", " 127.0.0.1:8123",
          "127.0.0.1:8123 ", "user@127.0.0.1:8123", "127.0.0.1:8123,evil.example", "(several)"}) {
        Request request = good();
        request.host = host;
        EXPECT_EQ(status_of(request), 421) << host;
    }
    Request request = good();
    request.host = "localhost";
    EXPECT_EQ(status_of(request, {kToken, 80}), 200) << "browsers leave this port out";
}

TEST(LivePolicy, RefusesOtherSites) {
    for (const char* origin :
         {"null", "http://evil.example", "https://127.0.0.1:8123", "http://127.0.0.1:8124",
          "http://127.0.0.1", "http://127.0.0.1:8123/", "127.0.0.1:8123",
          "http://127.0.0.1:8123.evil.example", "file://", "(several)"}) {
        Request request = good();
        request.origin = origin;
        EXPECT_EQ(status_of(request), 403) << origin;
    }
    for (const char* site : {"cross-site", "same-site", "None", "same-origin,none", "x", "(several)"}) {
        Request request = good();
        request.fetch_site = site;
        EXPECT_EQ(status_of(request), 403) << site;
    }
}

TEST(LivePolicy, RefusesOtherPathsAndTokensAlike) {
    const std::string other(32, '0');
    const std::vector<std::string> targets{"/",
                                           "//",
                                           "/favicon.ico",
                                           "/" + kToken,
                                           "/" + other + "/",
                                           "/" + kToken.substr(1) + "/",
                                           "/" + kToken + "0/",
                                           "/0123456789ABCDEF0123456789ABCDEF/",
                                           "//" + kToken + "/",
                                           kPath + "?",
                                           kPath + "/",
                                           kPath + "index.html",
                                           kPath + "../" + kToken + "/",
                                           kPath + "..%2f..%2fetc/passwd",
                                           kPath + "../../../../etc/passwd",
                                           "/../" + kToken + "/",
                                           "/%2e%2e/etc/passwd",
                                           kPath + "next",
                                           kPath + "next?",
                                           kPath + "next?after=",
                                           kPath + "next?after=-1",
                                           kPath + "next?after=+1",
                                           kPath + "next?after=1x",
                                           kPath + "next?after=1&after=2",
                                           kPath + "next?after=18446744073709551616",
                                           kPath + "next?before=1",
                                           kPath + "later?after=1",
                                           kPath + "next/?after=1",
                                           kPath + std::string("next?after=1\0", 13)};
    for (const std::string& target : targets) {
        Request request = good();
        request.target = target;
        EXPECT_EQ(std::get<Refused>(judge(request, kDoor)), (Refused{404, "There is nothing here."}))
            << target;
    }
}

TEST(LivePolicy, RefusesWhatIsNoPathOrTooMuch) {
    const std::string whole = "http://127.0.0.1:8123" + kPath;
    for (const std::string& target : {std::string(), std::string("*"), whole, kToken}) {
        Request request = good();
        request.target = target;
        EXPECT_EQ(status_of(request), 400) << target;
    }
    const std::string length(kMostTarget + 1, '/');
    Request request = good();
    request.target = length;
    EXPECT_EQ(status_of(request), 414);
    request = good();
    request.has_body = true;
    EXPECT_EQ(status_of(request), 413);
    for (const char* method :
         {"POST", "PUT", "DELETE", "OPTIONS", "TRACE", "CONNECT", "PROPFIND", "get", ""}) {
        request = good();
        request.method = method;
        EXPECT_EQ(status_of(request), 405) << method;
    }
    // Nobody learns from a refusal whether the token was right.
    request.target = "/";
    EXPECT_EQ(status_of(request), 405);
}

TEST(LiveToken, IsLongAndNewEachTime) {
    std::set<std::string> seen;
    for (int i = 0; i < 100; ++i) {
        const std::string token = new_token();
        EXPECT_EQ(token.size(), 32U);
        EXPECT_EQ(token.find_first_not_of("0123456789abcdef"), std::string::npos) << token;
        EXPECT_TRUE(seen.insert(token).second);
    }
}

TEST(LiveToken, IsComparedWhole) {
    EXPECT_TRUE(same_secret(kToken, kToken));
    EXPECT_TRUE(same_secret("", ""));
    EXPECT_FALSE(same_secret("", kToken));
    for (std::size_t i = 0; i < kToken.size(); ++i) {
        std::string other = kToken;
        other[i] = 'x';
        EXPECT_FALSE(same_secret(other, kToken)) << i;
        EXPECT_FALSE(same_secret(kToken.substr(0, i), kToken)) << i;
    }
}

nlohmann::json told(const Board& board, std::uint64_t after) {
    const auto text = board.newer_than(after);
    return text ? nlohmann::json::parse(*text) : nlohmann::json();
}

TEST(LiveNews, PagesAreToldWhatTheyDoNotHave) {
    Board board;
    EXPECT_EQ(board.newer_than(0), nullptr) << "nothing was put yet";
    board.put({.errors = 2, .trouble = "<ul></ul>", .stale = true, .finding_count = 3, .findings = "f"});
    EXPECT_EQ(told(board, 0), nlohmann::json::parse(R"({"version": 1, "errors": 2, "trouble": "<ul></ul>",
                                                        "stale": true, "finding_count": 3, "findings": "f"})"));
    EXPECT_EQ(board.newer_than(1), nullptr);
    board.put({.model = R"({"title": "a"})"});
    EXPECT_EQ(told(board, 1).at("model"), nlohmann::json::parse(R"({"title": "a"})"));
    EXPECT_FALSE(told(board, 1).contains("sheets"));
    board.put({.sheets = "[1]"});
    EXPECT_FALSE(told(board, 2).contains("model")) << "the page has it";
    EXPECT_EQ(told(board, 2).at("sheets"), nlohmann::json::parse("[1]"));
    EXPECT_TRUE(told(board, 1).contains("model")) << "it was away";
    board.put({.errors = 1, .stale = true});
    EXPECT_FALSE(told(board, 3).contains("model"));
    EXPECT_FALSE(told(board, 3).contains("sheets"));
    EXPECT_TRUE(told(board, 2).contains("sheets"));
    EXPECT_EQ(told(board, 0).at("model"), nlohmann::json::parse(R"({"title": "a"})")) << "a new page";
    EXPECT_EQ(told(board, 0).at("errors"), 1);
    EXPECT_EQ(told(board, 99), told(board, 0)) << "a page of another time";
    EXPECT_EQ(told(board, 4), nlohmann::json());
    // One text for all that have the same.
    EXPECT_EQ(board.newer_than(3), board.newer_than(3));
    board.put({.findings = "\xff"});
    EXPECT_EQ(told(board, 4).at("findings"), "\xef\xbf\xbd");
}

}  // namespace
}  // namespace popup::live
