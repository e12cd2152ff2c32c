#include "input/xml/encoding.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "input/text.h"

namespace popup::xml {
namespace {

// Length of the UTF-8 sequence at the start of `text`; 0 when there is none (RFC 3629: no overlong forms, no
// surrogates, nothing above U+10FFFF). Precondition: not empty.
std::size_t sequence_length(std::string_view text) {
    const auto byte = [&](std::size_t i) {
        return i < text.size() ? static_cast<unsigned char>(text[i]) : std::uint8_t{0};
    };
    const auto follows = [&](std::size_t i) { return (byte(i) & 0xc0U) == 0x80; };
    const unsigned first = byte(0);
    if (first < 0x80) return 1;
    if (first >= 0xc2 && first <= 0xdf) return follows(1) ? 2 : 0;
    if (first >= 0xe0 && first <= 0xef) {
        if (!follows(1) || !follows(2)) return 0;
        if (first == 0xe0 && byte(1) < 0xa0) return 0;
        if (first == 0xed && byte(1) > 0x9f) return 0;
        return 3;
    }
    if (first >= 0xf0 && first <= 0xf4) {
        if (!follows(1) || !follows(2) || !follows(3)) return 0;
        if (first == 0xf0 && byte(1) < 0x90) return 0;
        if (first == 0xf4 && byte(1) > 0x8f) return 0;
        return 4;
    }
    return 0;
}

bool begins_character(char c) { return (static_cast<unsigned char>(c) & 0xc0U) != 0x80U; }

constexpr std::string_view kSaveAsUtf8 = "save the document as UTF-8";

}  // namespace

Place PlaceCounter::at(std::size_t offset) {
    for (; at_ < offset; ++at_) {
        if (text_[at_] == '\n') {
            ++place_.line;
            place_.column = 1;
        } else if (begins_character(text_[at_])) {
            ++place_.column;
        }
    }
    return place_;
}

PlaceTable::PlaceTable(std::string_view text)
    : text_(text), lines_{text.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0} {
    for (std::size_t at = text.find('\n'); at != std::string_view::npos; at = text.find('\n', at + 1))
        lines_.push_back(at + 1);
}

std::optional<Place> PlaceTable::place_of(std::size_t offset) const {
    const auto behind = std::upper_bound(lines_.begin(), lines_.end(), offset);
    if (behind == lines_.begin() || offset > text_.size()) return std::nullopt;
    const std::string_view passed = text_.substr(*(behind - 1), offset - *(behind - 1));
    const auto column = std::count_if(passed.begin(), passed.end(), begins_character);
    return Place{static_cast<int>(behind - lines_.begin()), static_cast<int>(column) + 1};
}

std::optional<std::size_t> PlaceTable::offset_of(Place place) const {
    if (place.line <= 0 || static_cast<std::size_t>(place.line) > lines_.size()) return std::nullopt;
    std::size_t at = lines_[static_cast<std::size_t>(place.line) - 1];
    for (int column = 1; column < place.column && at < text_.size() && text_[at] != '\n'; ++column) {
        ++at;
        while (at < text_.size() && !begins_character(text_[at])) ++at;
    }
    return at;
}

bool check_encoding(std::string_view text, Diagnostics& diagnostics) {
    if (is_wide_text(text)) {
        diagnostics.error("encoding", {1, 1}, "the document is in UTF-16 or UTF-32, and only UTF-8 is read")
            .hint(std::string(kSaveAsUtf8));
        return false;
    }
    const std::size_t start = text.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0;
    if (text.find_first_not_of(" \t\r\n", start) == std::string_view::npos) {
        diagnostics.error("empty-input", {},
                          text.empty() ? "the file is empty" : "the file holds only blanks");
        return false;
    }
    for (std::size_t at = start; at < text.size();) {
        const auto byte = static_cast<unsigned char>(text[at]);
        if (byte >= 0x20 && byte < 0x80) {
            ++at;
            continue;
        }
        if (byte < 0x20) {
            if (byte == 0x09 || byte == 0x0a || byte == 0x0d) {
                ++at;
                continue;
            }
            diagnostics.error("bad-character", PlaceCounter(text).at(at),
                              byte == 0
                                  ? "a NUL byte is no text"
                                  : fmt::format("the control character U+{:04X} may not stand in XML", byte));
            return false;
        }
        const std::size_t length = sequence_length(text.substr(at, 4));
        if (length == 0) {
            diagnostics
                .error("encoding", PlaceCounter(text).at(at),
                       fmt::format("the byte 0x{:02x} is not UTF-8 here", byte))
                .hint(std::string(kSaveAsUtf8));
            return false;
        }
        const std::string_view sequence = text.substr(at, length);
        if (sequence == "\xEF\xBF\xBE" || sequence == "\xEF\xBF\xBF") {
            diagnostics.error("bad-character", PlaceCounter(text).at(at),
                              "the characters U+FFFE and U+FFFF may not stand in XML");
            return false;
        }
        at += length;
    }
    return true;
}

}  // namespace popup::xml
