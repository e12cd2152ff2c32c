#include "base/text/numbers.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <string_view>

#include "popup/diagnostics.h"

namespace popup {
namespace {

constexpr std::array<std::uint64_t, 10> kPowers{1,       10,        100,        1000,        10000,
                                                100'000, 1'000'000, 10'000'000, 100'000'000, 1'000'000'000};

// Beyond this a double has no decimals worth the name, and the scaled value would not fit 64 bits.
constexpr double kLargest = 9e9;

void append(fmt::memory_buffer& out, std::string_view text) {
    out.append(text.data(), text.data() + text.size());
}

// The rare large number, through fmt: slower, and it leaves zeros to take away.
void append_large(fmt::memory_buffer& out, double value, int decimals) {
    std::string text = fmt::format("{:.{}f}", value, decimals);
    if (decimals > 0) {
        text.erase(text.find_last_not_of('0') + 1);
        if (text.back() == '.') text.pop_back();
    }
    append(out, text);
}

}  // namespace

void append_number(fmt::memory_buffer& out, double value, int decimals) {
    POPUP_INVARIANT(std::isfinite(value));
    if (std::abs(value) > kLargest) return append_large(out, value, decimals);
    const std::uint64_t power = kPowers.at(static_cast<std::size_t>(decimals));
    const auto scaled =
        static_cast<std::uint64_t>(std::llround(std::abs(value) * static_cast<double>(power)));
    if (scaled == 0) return out.push_back('0');
    if (value < 0) out.push_back('-');
    append(out, std::string_view(fmt::format_int(scaled / power).c_str()));
    std::uint64_t rest = scaled % power;
    if (rest == 0) return;
    out.push_back('.');
    // From the first place down, until nothing is left.
    for (std::uint64_t place = power / 10; rest != 0; rest %= place, place /= 10) {
        out.push_back(static_cast<char>('0' + rest / place));
    }
}

std::string number_text(double value, int decimals) {
    fmt::memory_buffer out;
    append_number(out, value, decimals);
    return fmt::to_string(out);
}

double rounded(double value, int decimals) {
    const auto power = static_cast<double>(kPowers.at(static_cast<std::size_t>(decimals)));
    if (!(std::abs(value) <= kLargest)) return value;
    return std::round(value * power) / power + 0.0;  // + 0.0 makes -0 a 0
}

}  // namespace popup
