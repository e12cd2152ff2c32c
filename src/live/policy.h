// What is answered to which request. A page of this machine is open to every program and every web page on
// it; only who has its address shall see it.
//
//     const Door door{new_token(), port};
//     const Verdict verdict = judge({.method = "GET", .target = "/TOKEN/", .host = "127.0.0.1:8123"}, door);
//     // Asked{Wanted::page}
//
// The token is a part of the path, "http://127.0.0.1:PORT/TOKEN/": the address alone opens the page, also a
// second time and in a second window. A cookie would be sent to every other server of this machine, whatever
// its port, and a fragment would have to be sent by a script, from a page that everybody gets. What stands in
// the path goes to other sites as a referrer only, which the answers forbid, and the page links to none.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

namespace popup::live {

// What is asked for; all but the method and target may be empty, where a request does not say it.
struct Request {
    std::string_view method;
    std::string_view target;
    std::string_view host;        // empty also where there are several
    std::string_view origin;      // Origin
    std::string_view fetch_site;  // Sec-Fetch-Site
    bool has_body = false;
};

// Where it is asked.
struct Door {
    std::string token;
    std::uint16_t port = 0;
    [[nodiscard]] std::string address() const;  // "http://127.0.0.1:PORT/TOKEN/"
};

enum class Wanted {
    page,
    next,  // what is newer than `after`, as soon as there is something
    now,   // what is newer than `after`, if there is something
};
struct Asked {
    Wanted what = Wanted::page;
    std::uint64_t after = 0;
    bool head = false;  // the headers only
    friend bool operator==(const Asked&, const Asked&) = default;
};
struct Refused {
    int status = 404;
    std::string_view why;  // a line for people
    friend bool operator==(const Refused&, const Refused&) = default;
};
using Verdict = std::variant<Asked, Refused>;

inline constexpr std::size_t kMostTarget = 256;  // bytes of a target; ours are shorter

// Who may see what. In this order: targets that are too long (414) or no path (400), bodies (413), a Host
// that is not 127.0.0.1 or localhost with the door's port (421: names that others let point here have this
// one), an Origin that is not this server's, or a Sec-Fetch-Site of another site's (403), methods but GET and
// HEAD (405), and paths but "/TOKEN/", "/TOKEN/next?after=N" and "/TOKEN/now?after=N" (404, the same for a
// wrong token as for a wrong path). No path is looked up anywhere. Cost: the length of the target; the time
// tells nothing of the token.
Verdict judge(const Request& request, const Door& door);

// What every answer says of itself, whatever it is: not to be kept, guessed at, framed, read by or referred
// to other sites.
inline constexpr std::array<std::pair<std::string_view, std::string_view>, 7> kHeaders{{
    {"Cache-Control", "no-store"},
    {"Cross-Origin-Opener-Policy", "same-origin"},
    {"Cross-Origin-Resource-Policy", "same-origin"},
    {"Referrer-Policy", "no-referrer"},
    {"Vary", "Origin, Sec-Fetch-Site"},
    {"X-Content-Type-Options", "nosniff"},
    {"X-Frame-Options", "DENY"},
}};

}  // namespace popup::live
