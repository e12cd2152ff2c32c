#include "lsp/frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace popup::lsp {
namespace {

constexpr std::string_view kLength = "content-length:";

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

// Where the field stands, whatever its case; npos: nowhere.
std::size_t find_length(std::string_view text) {
    const auto at = std::search(text.begin(), text.end(), kLength.begin(), kLength.end(),
                                [](char a, char b) { return lower(a) == b; });
    return at == text.end() ? std::string_view::npos : static_cast<std::size_t>(at - text.begin());
}

// The end of a head behind its blank line, and where the field's line ends; npos: not there yet. Some clients
// end lines with "\n" alone.
std::size_t end_of_head(std::string_view head) {
    const std::size_t both = head.find("\r\n\r\n");
    const std::size_t alone = head.find("\n\n");
    if (both != std::string_view::npos && (alone == std::string_view::npos || both < alone)) return both + 4;
    return alone == std::string_view::npos ? alone : alone + 2;
}

// The number behind the field; nullopt: that is none. What no size_t holds is as large as one may be.
std::optional<std::size_t> length_of(std::string_view text) {
    while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
    std::size_t length = 0;
    std::size_t digits = 0;
    for (; digits < text.size() && text[digits] >= '0' && text[digits] <= '9'; ++digits) {
        constexpr std::size_t kMost = std::size_t{1} << 60U;
        length = std::min(kMost, length * 10 + static_cast<std::size_t>(text[digits] - '0'));
    }
    text.remove_prefix(digits);
    while (!text.empty() && (text.front() == ' ' || text.front() == '\t' || text.front() == '\r'))
        text.remove_prefix(1);
    if (digits == 0 || text.empty() || text.front() != '\n') return std::nullopt;
    return length;
}

}  // namespace

void FrameReader::push(std::string_view bytes) {
    const std::size_t skipped = std::min(to_skip_, bytes.size());
    bytes.remove_prefix(skipped);
    to_skip_ -= skipped;
    // What was taken goes once it is more than what is left, so that each byte is moved a bounded number of
    // times.
    if (begin_ > waiting_.size() / 2) {
        waiting_.erase(0, begin_);
        begin_ = 0;
    }
    waiting_ += bytes;
}

std::optional<Frame> FrameReader::refuse(std::size_t drop, std::string fault) {
    begin_ += drop;
    if (lost_) return std::nullopt;
    lost_ = true;
    return Frame{{}, std::move(fault)};
}

std::optional<Frame> FrameReader::next() {
    for (;;) {
        const std::string_view rest = std::string_view(waiting_).substr(begin_);
        if (rest.empty()) return std::nullopt;
        const std::string_view window = rest.substr(0, kMostHeadBytes);
        const std::size_t field = find_length(window);
        const std::size_t blank = end_of_head(window.substr(0, field));
        if (blank != std::string_view::npos) {
            if (auto frame = refuse(blank, "a message has no Content-Length")) return frame;
            continue;
        }
        if (field == std::string_view::npos) {
            if (rest.size() < kMostHeadBytes) return std::nullopt;
            // The end of what is looked at may be the beginning of the field.
            const std::size_t drop = window.size() - (kLength.size() - 1);
            if (auto frame = refuse(drop, "a message has no Content-Length")) return frame;
            continue;
        }
        const std::string_view head = rest.substr(field, kMostHeadBytes);
        const std::size_t end = end_of_head(head);
        if (end == std::string_view::npos) {
            if (head.size() < kMostHeadBytes) return std::nullopt;
            if (auto frame = refuse(field + kLength.size(), "the head of a message does not end"))
                return frame;
            continue;
        }
        const auto length = length_of(head.substr(kLength.size()));
        if (!length) {
            if (auto frame = refuse(field + kLength.size(), "Content-Length is no number")) return frame;
            continue;
        }
        const std::size_t body = field + end;
        if (*length > kMostMessageBytes) {
            const std::size_t there = std::min(*length, rest.size() - body);
            begin_ += body + there;
            to_skip_ = *length - there;
            lost_ = false;
            return Frame{
                {}, fmt::format("a message has {} bytes, and the most are {}", *length, kMostMessageBytes)};
        }
        if (rest.size() - body < *length) return std::nullopt;
        lost_ = false;
        Frame frame{std::string(rest.substr(body, *length)), {}};
        begin_ += body + *length;
        return frame;
    }
}

std::string framed(std::string_view body) {
    return fmt::format("Content-Length: {}\r\n\r\n{}", body.size(), body);
}

}  // namespace popup::lsp
