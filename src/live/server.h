// Serves one page on this machine, and tells it what is new.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>

#include "live/news.h"

namespace popup::live {

// How much the server lets happen.
struct Limits {
    std::size_t connections = 64;               // at a time; more wait until one of these has ended
    std::size_t header = 8192;                  // bytes of a request
    std::chrono::milliseconds request{10'000};  // until a request is there, from the end of the last answer
    std::chrono::milliseconds wait{25'000};     // until "nothing new" is said to who waits for news
    std::chrono::milliseconds answer{30'000};   // until an answer is taken
};

struct Serving {
    std::string page;                     // HTML
    std::string policy;                   // its CSP
    std::uint16_t port = 0;               // 0: one that is free
    std::chrono::milliseconds idle{0};    // > 0: how long nobody may ask until `forsaken` is called
    std::function<void()> forsaken = {};  // called once, by the server's thread
    Limits limits = {};
};

// Why there is no server: the port cannot be had.
class CannotServe : public std::runtime_error {
 public:
    CannotServe(const std::string& what, bool in_use) : std::runtime_error(what), in_use_(in_use) {}
    [[nodiscard]] bool in_use() const { return in_use_; }  // by another program

 private:
    bool in_use_;
};

// An HTTP/1.1 server on 127.0.0.1, with a token in its address (policy.h has who may ask for what). All
// connections share one thread, so that who sends or takes slowly, or not at all, holds up nobody, and is cut
// off by the limits. Pages ask for what is newer than they have, and are answered when there is something: a
// page that was away a while gets the last news only.
class Server {
 public:
    // Listens from now on. CannotServe.
    explicit Server(Serving serving);
    Server(const Server&) = delete;
    Server& operator=(const Server&) = delete;
    // Tells who waits that it is over, and ends every connection at once.
    ~Server();

    [[nodiscard]] const std::string& address() const;  // "http://127.0.0.1:PORT/TOKEN/"
    // From now on this is what pages are told. From any thread, never waits.
    void put(News news);

 private:
    class Room;
    std::unique_ptr<Room> room_;
};

}  // namespace popup::live
