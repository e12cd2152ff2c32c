#include "input/drawing/numbers.h"

#include <cmath>

#include "input/text.h"
#include "input/xml/number.h"

namespace popup::drawing {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

// Length of the number at the start of `text`; 0: there is none.
std::size_t number_length(std::string_view text) {
    std::size_t at = !text.empty() && (text[0] == '-' || text[0] == '+') ? 1 : 0;
    const auto digits = [&] {
        const std::size_t from = at;
        while (at < text.size() && is_digit(text[at])) ++at;
        return at - from;
    };
    std::size_t seen = digits();
    if (at < text.size() && text[at] == '.') {
        ++at;
        seen += digits();
    }
    if (seen == 0) return 0;
    const std::size_t whole = at;
    if (at < text.size() && (text[at] == 'e' || text[at] == 'E')) {
        ++at;
        if (at < text.size() && (text[at] == '-' || text[at] == '+')) ++at;
        if (digits() == 0) return whole;  // a unit: "1em"
    }
    return at;
}

}  // namespace

void NumberScanner::skip_blanks() {
    while (at_ < text_.size() && (is_blank(text_[at_]) || text_[at_] == '\f')) ++at_;
}

void NumberScanner::skip_separator() {
    skip_blanks();
    if (at_ >= text_.size() || text_[at_] != ',') return;
    ++at_;
    skip_blanks();
}

char NumberScanner::peek() {
    skip_blanks();
    return at_ < text_.size() ? text_[at_] : '\0';
}

std::optional<double> NumberScanner::number() {
    const std::size_t before = at_;
    skip_separator();
    const std::size_t length = number_length(text_.substr(at_));
    if (length == 0) {
        at_ = before;
        return std::nullopt;
    }
    const std::string_view token = text_.substr(at_, length);
    at_ += length;
    const xml::ParsedNumber parsed = xml::parse_number(token);
    return parsed.fault == xml::NumberFault::none ? parsed.value : HUGE_VAL;
}

std::optional<bool> NumberScanner::flag() {
    const std::size_t before = at_;
    skip_separator();
    if (at_ < text_.size() && (text_[at_] == '0' || text_[at_] == '1')) return text_[at_++] == '1';
    at_ = before;
    return std::nullopt;
}

std::optional<std::vector<double>> parse_numbers(std::string_view text) {
    NumberScanner scanner(text);
    std::vector<double> numbers;
    while (scanner.peek() != '\0') {
        const auto number = scanner.number();
        if (!number) return std::nullopt;
        numbers.push_back(*number);
    }
    return numbers;
}

}  // namespace popup::drawing
