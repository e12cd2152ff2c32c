// HTTP as it goes over the wire, so that tests can also send what no client would.
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace popup::test {

struct HttpAnswer {
    int status = 0;
    std::map<std::string, std::string> headers;  // names in lower case
    std::string body;
};

// Where a server is: "http://127.0.0.1:8123/x/" has the port 8123 and the path "/x/".
struct HttpPlace {
    std::uint16_t port = 0;
    std::string path;
};
HttpPlace place_of(const std::string& address);

// A connection to a port of this machine. Whoever waits does so for a minute at most.
class Wire {
 public:
    explicit Wire(std::uint16_t port);
    Wire(const Wire&) = delete;
    Wire& operator=(const Wire&) = delete;
    ~Wire();

    // False when the other side has closed.
    bool send(std::string_view bytes) const;
    // The next answer; nullopt when the connection ends before it is whole, or nothing comes.
    std::optional<HttpAnswer> answer(bool has_body = true);
    // Whether the other side ends it, whatever it says before.
    bool ends();

 private:
    bool more();
    int fd_ = -1;
    std::string rest_;
};

// "GET PATH HTTP/1.1", Host, and these further lines.
std::string get_request(const HttpPlace& place, const std::string& more_path = {},
                        const std::vector<std::string>& lines = {});
// What comes back for it on a connection of its own; status 0: nothing.
HttpAnswer get(const std::string& address, const std::string& more_path = {},
               const std::vector<std::string>& lines = {});

}  // namespace popup::test
