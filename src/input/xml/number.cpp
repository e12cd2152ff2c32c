#include "input/xml/number.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "input/text.h"
#include "popup/diagnostics.h"

namespace popup::xml {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

bool starts_without_case(std::string_view text, std::string_view prefix) {
    if (text.size() < prefix.size()) return false;
    for (std::size_t i = 0; i < prefix.size(); ++i) {
        if ((text[i] | 0x20) != prefix[i]) return false;
    }
    return true;
}

std::size_t skip_digits(std::string_view text, std::size_t at) {
    while (at < text.size() && is_digit(text[at])) ++at;
    return at;
}

// Why an unsigned text that is no number is none.
NumberFault fault_of(std::string_view text) {
    if (starts_without_case(text, "nan") || starts_without_case(text, "inf")) return NumberFault::not_finite;
    if (starts_without_case(text, "0x")) return NumberFault::hexadecimal;
    const std::size_t comma = text.find(',');
    if (comma != std::string_view::npos && skip_digits(text, 0) == comma) return NumberFault::comma;
    return NumberFault::malformed;
}

}  // namespace

ParsedNumber parse_number(std::string_view text) {
    text = trimmed(text);
    if (text.empty()) return {0.0, NumberFault::empty};
    const bool negative = text.front() == '-';
    if (negative || text.front() == '+') text.remove_prefix(1);

    // The grammar first: from_chars alone would take "inf" and "nan(…)".
    const std::size_t whole = skip_digits(text, 0);
    std::size_t at = whole;
    std::size_t digits = whole;
    if (at < text.size() && text[at] == '.') {
        const std::size_t stop = skip_digits(text, at + 1);
        digits += stop - at - 1;
        at = stop;
    }
    if (digits == 0) return {0.0, fault_of(text)};
    long exponent = 0;
    if (at < text.size() && (text[at] | 0x20) == 'e') {
        const std::size_t sign = at + 1;
        const bool down = sign < text.size() && text[sign] == '-';
        const std::size_t first = sign + (down || (sign < text.size() && text[sign] == '+') ? 1 : 0);
        const std::size_t stop = skip_digits(text, first);
        if (stop == first) return {0.0, fault_of(text)};
        for (std::size_t i = first; i < stop; ++i)
            exponent = std::min(exponent * 10 + (text[i] - '0'), 1L << 40);
        if (down) exponent = -exponent;
        at = stop;
    }
    if (at != text.size()) return {0.0, fault_of(text)};

    double value = 0.0;
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error == std::errc::result_out_of_range) {
        // from_chars does not say at which end. The power of ten of the first digit that counts does.
        const std::size_t leading = text.find_first_not_of("0.");
        const long power = static_cast<long>(whole) - static_cast<long>(leading) + exponent;
        if (power <= 0) return {};
        return {0.0, NumberFault::too_large};
    }
    if (error != std::errc{} || stop != text.data() + text.size()) return {0.0, NumberFault::malformed};
    return {negative ? -value : value, NumberFault::none};
}

std::string format_number(double value) {
    POPUP_INVARIANT(std::isfinite(value));
    std::string text = fmt::format("{:.6f}", value);
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
    return text == "-0" ? "0" : text;
}

}  // namespace popup::xml
