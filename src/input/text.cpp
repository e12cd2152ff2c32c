#include "input/text.h"

#include <algorithm>
#include <cstddef>

namespace popup {

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
    return text;
}

bool is_id(std::string_view text) {
    const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
    const auto more = [&](char c) { return letter(c) || (c >= '0' && c <= '9') || c == '.' || c == '-'; };
    return !text.empty() && letter(text.front()) && std::all_of(text.begin(), text.end(), more);
}

bool is_wide_text(std::string_view text) {
    using namespace std::string_view_literals;
    if (text.starts_with("\xFF\xFE"sv) || text.starts_with("\xFE\xFF"sv)) return true;
    const std::string_view begin = text.substr(0, 4);
    const auto zeros = std::count(begin.begin(), begin.end(), '\0');
    return begin.size() >= 2 && zeros * 2 >= static_cast<std::ptrdiff_t>(begin.size()) &&
           zeros < static_cast<std::ptrdiff_t>(begin.size());
}

std::string lower(std::string_view text) {
    std::string out(text);
    for (char& c : out) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    return out;
}

std::string short_name(std::string_view name) {
    constexpr std::size_t kLongest = 80;
    name = trimmed(name);
    std::size_t length = std::min(name.size(), kLongest);
    while (length > 0 && length < name.size() && (static_cast<unsigned char>(name[length]) & 0xc0U) == 0x80) {
        --length;
    }
    return std::string(name.substr(0, length));
}

}  // namespace popup
