#include "live/policy.h"

#include <charconv>
#include <optional>
#include <system_error>

#include "live/token.h"

namespace popup::live {
namespace {

// Of ASCII letters only, whatever the locale.
std::string lower(std::string_view text) {
    std::string result(text);
    for (char& c : result) {
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    }
    return result;
}

// "127.0.0.1:PORT" or "localhost:PORT"; browsers leave out the port 80.
bool is_own_host(std::string_view host, std::uint16_t port) {
    const std::string given = lower(host);
    const std::string behind = ":" + std::to_string(port);
    for (const std::string name : {"127.0.0.1", "localhost"}) {
        if (given == name + behind || (port == 80 && given == name)) return true;
    }
    return false;
}

// "after=N" in decimal digits.
std::optional<std::uint64_t> after_of(std::string_view query) {
    constexpr std::string_view kName = "after=";
    if (!query.starts_with(kName)) return std::nullopt;
    query.remove_prefix(kName.size());
    std::uint64_t number = 0;
    const auto [end, error] = std::from_chars(query.data(), query.data() + query.size(), number);
    if (query.empty() || error != std::errc() || end != query.data() + query.size()) return std::nullopt;
    return number;
}

// What a target asks for whose token is right.
std::optional<Asked> asked_by(std::string_view target, std::string_view token) {
    target.remove_prefix(1);
    const std::size_t slash = target.find('/');
    if (slash == std::string_view::npos || !same_secret(target.substr(0, slash), token)) return std::nullopt;
    target.remove_prefix(slash + 1);
    if (target.empty()) return Asked{};
    const std::size_t mark = target.find('?');
    if (mark == std::string_view::npos) return std::nullopt;
    const std::string_view word = target.substr(0, mark);
    const std::optional<std::uint64_t> after = after_of(target.substr(mark + 1));
    if (!after || (word != "next" && word != "now")) return std::nullopt;
    return Asked{word == "next" ? Wanted::next : Wanted::now, *after, false};
}

}  // namespace

std::string Door::address() const { return "http://127.0.0.1:" + std::to_string(port) + "/" + token + "/"; }

Verdict judge(const Request& request, const Door& door) {
    if (request.target.size() > kMostTarget) return Refused{414, "This address is too long."};
    if (!request.target.starts_with('/')) return Refused{400, "This is no path."};
    if (request.has_body) return Refused{413, "Nothing can be sent here."};
    if (!is_own_host(request.host, door.port)) return Refused{421, "This server has another name."};
    constexpr std::string_view kScheme = "http://";
    const bool own_origin =
        request.origin.empty() || (request.origin.starts_with(kScheme) &&
                                   is_own_host(request.origin.substr(kScheme.size()), door.port));
    if (!own_origin) return Refused{403, "This page is not for other sites."};
    // "none": somebody has typed it, or opened it from another program.
    if (!request.fetch_site.empty() && request.fetch_site != "same-origin" && request.fetch_site != "none") {
        return Refused{403, "This page is not for other sites. Open its address in a window of its own."};
    }
    if (request.method != "GET" && request.method != "HEAD") return Refused{405, "This can only be read."};
    std::optional<Asked> asked = asked_by(request.target, door.token);
    if (!asked) return Refused{404, "There is nothing here."};
    asked->head = request.method == "HEAD";
    return *asked;
}

}  // namespace popup::live
