#include "support/wire.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cctype>
#include <stdexcept>

namespace popup::test {
namespace {

constexpr int kLongest = 60000;  // ms

}  // namespace

HttpPlace place_of(const std::string& address) {
    const std::string begin = "http://127.0.0.1:";
    if (!address.starts_with(begin)) throw std::runtime_error("no address: " + address);
    const std::size_t slash = address.find('/', begin.size());
    return {static_cast<std::uint16_t>(std::stoi(address.substr(begin.size(), slash - begin.size()))),
            address.substr(slash)};
}

Wire::Wire(std::uint16_t port) : fd_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in place{};
    place.sin_family = AF_INET;
    place.sin_port = htons(port);
    place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (::connect(fd_, reinterpret_cast<const sockaddr*>(&place), sizeof place) != 0) {
        ::close(fd_);
        throw std::runtime_error("nobody listens on port " + std::to_string(port));
    }
}

Wire::~Wire() { ::close(fd_); }

bool Wire::send(std::string_view bytes) const {
    while (!bytes.empty()) {
        const ssize_t sent = ::send(fd_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
        if (sent <= 0) return false;
        bytes.remove_prefix(static_cast<std::size_t>(sent));
    }
    return true;
}

bool Wire::more() {
    pollfd waiting{fd_, POLLIN, 0};
    if (::poll(&waiting, 1, kLongest) != 1) throw std::runtime_error("nothing comes over the wire");
    std::array<char, 65536> buffer{};
    const ssize_t got = ::recv(fd_, buffer.data(), buffer.size(), 0);
    if (got <= 0) return false;
    rest_.append(buffer.data(), static_cast<std::size_t>(got));
    return true;
}

std::optional<HttpAnswer> Wire::answer(bool has_body) {
    std::size_t end = 0;
    while ((end = rest_.find("\r\n\r\n")) == std::string::npos) {
        if (!more()) return std::nullopt;
    }
    HttpAnswer answer;
    answer.status = std::stoi(rest_.substr(9, 3));
    for (std::size_t at = rest_.find("\r\n"); at < end; at = rest_.find("\r\n", at + 2)) {
        const std::size_t colon = rest_.find(": ", at);
        std::string name = rest_.substr(at + 2, colon - at - 2);
        for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        answer.headers[name] = rest_.substr(colon + 2, rest_.find("\r\n", at + 2) - colon - 2);
    }
    rest_.erase(0, end + 4);
    const auto length = answer.headers.find("content-length");
    const std::size_t bytes =
        has_body && length != answer.headers.end() ? std::stoul(length->second) : std::size_t{0};
    while (rest_.size() < bytes) {
        if (!more()) return std::nullopt;
    }
    answer.body = rest_.substr(0, bytes);
    rest_.erase(0, bytes);
    return answer;
}

bool Wire::ends() {
    try {
        while (more()) {
        }
    } catch (const std::runtime_error&) {
        return false;
    }
    return true;
}

std::string get_request(const HttpPlace& place, const std::string& more_path,
                        const std::vector<std::string>& lines) {
    std::string text = "GET " + place.path + more_path +
                       " HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(place.port) + "\r\n";
    for (const std::string& line : lines) text += line + "\r\n";
    return text + "\r\n";
}

HttpAnswer get(const std::string& address, const std::string& more_path,
               const std::vector<std::string>& lines) {
    const HttpPlace place = place_of(address);
    Wire wire(place.port);
    wire.send(get_request(place, more_path, lines));
    return wire.answer().value_or(HttpAnswer{});
}

}  // namespace popup::test
