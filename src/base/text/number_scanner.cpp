#include "base/text/number_scanner.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace popup {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f'; }

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

// Whether a number that no double holds is too large, and not too small: by the power of ten of its first
// digit that counts.
bool is_large(std::string_view number) {
    const std::size_t e = std::min(number.find_first_of("eE"), number.size());
    const std::string_view digits = number.substr(0, e);
    const std::size_t leading = digits.find_first_of("123456789");
    if (leading == std::string_view::npos) return false;
    const std::size_t point = std::min(digits.find('.'), digits.size());
    long power = static_cast<long>(point) - static_cast<long>(leading);
    if (e == number.size()) return power > 0;
    const bool down = number[e + 1] == '-';
    long exponent = 0;
    for (const char c : number.substr(e + 1)) {
        if (is_digit(c)) exponent = std::min(exponent * 10 + (c - '0'), 1L << 40);
    }
    power += down ? -exponent : exponent;
    return power > 0;
}

// What a number's text says.
double value_of(std::string_view number) {
    const bool negative = number.front() == '-';
    if (negative || number.front() == '+') number.remove_prefix(1);
    double value = 0.0;
    const auto [stop, error] = std::from_chars(number.data(), number.data() + number.size(), value);
    if (error == std::errc::result_out_of_range) value = is_large(number) ? HUGE_VAL : 0.0;
    return negative ? -value : value;
}

}  // namespace

void NumberScanner::skip_blanks() {
    while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
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
    const double value = value_of(text_.substr(at_, length));
    at_ += length;
    return value;
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

}  // namespace popup
