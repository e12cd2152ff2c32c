// Messages out of a stream of bytes: each has a head, `Content-Length: N` and a blank line, then N bytes.
//
//     FrameReader frames;
//     frames.push(bytes);
//     while (std::optional<Frame> frame = frames.next()) ...
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace popup::lsp {

// Longer messages are passed over.
inline constexpr std::size_t kMostMessageBytes = std::size_t{64} << 20;
// Heads that do not end within this are none.
inline constexpr std::size_t kMostHeadBytes = std::size_t{16} << 10;

struct Frame {
    std::string body;
    std::string fault;  // why there is no body, as a sentence without its full stop; empty: there is one
};

// Takes bytes in whatever pieces they come. What is no head is passed over up to the next "Content-Length:",
// wherever in a line that stands, and told once; so a message whose length was wrong costs that message and
// perhaps the one behind it, and never the rest. Memory: at most that of one message and what was pushed.
class FrameReader {
 public:
    void push(std::string_view bytes);
    // The next message; nullopt: more bytes are needed.
    std::optional<Frame> next();

 private:
    std::optional<Frame> refuse(std::size_t drop, std::string fault);
    std::string waiting_;
    std::size_t begin_ = 0;    // of what has not been taken
    std::size_t to_skip_ = 0;  // bytes of a message that was refused
    bool lost_ = false;        // told already that what comes is no head
};

// The message as it is sent.
std::string framed(std::string_view body);

}  // namespace popup::lsp
