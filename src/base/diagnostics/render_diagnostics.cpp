#include "base/diagnostics/render_diagnostics.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/text/utf8.h"

namespace popup {
namespace {

constexpr int kWindow = 96;       // columns of source shown at most
constexpr int kBeforeCaret = 56;  // of these, at most this many before the caret when a line is cut

constexpr std::string_view kCut = "\u2026";  // where a line goes on

constexpr std::size_t kMarkEvery = 1U << 16U;  // bytes between two places that are remembered

struct Range {
    char32_t first, last;
};

template <std::size_t N>
bool in(const std::array<Range, N>& ranges, char32_t code) {
    return std::any_of(ranges.begin(), ranges.end(),
                       [code](const Range& r) { return code >= r.first && code <= r.last; });
}

// Characters that change how a terminal shows the others, or that cannot be seen.
bool treacherous(char32_t code) {
    static constexpr auto kRanges = std::to_array<Range>({{0x00, 0x1F},
                                                          {0x7F, 0x9F},
                                                          {0x061C, 0x061C},
                                                          {0x200B, 0x200F},
                                                          {0x2028, 0x202E},
                                                          {0x2060, 0x206F},
                                                          {0xFEFF, 0xFEFF},
                                                          {0xFFFE, 0xFFFF},
                                                          {0xE0000, 0xE007F}});
    return in(kRanges, code);
}

// Terminal columns of a character that is shown as it is.
int columns(char32_t code) {
    static constexpr auto kNone = std::to_array<Range>({{0x0300, 0x036F},
                                                        {0x1AB0, 0x1AFF},
                                                        {0x1DC0, 0x1DFF},
                                                        {0x20D0, 0x20FF},
                                                        {0xFE00, 0xFE0F},
                                                        {0xFE20, 0xFE2F}});
    static constexpr auto kWide = std::to_array<Range>({{0x1100, 0x115F},
                                                        {0x2E80, 0x303E},
                                                        {0x3041, 0xA4CF},
                                                        {0xAC00, 0xD7A3},
                                                        {0xF900, 0xFAFF},
                                                        {0xFE30, 0xFE6F},
                                                        {0xFF00, 0xFF60},
                                                        {0xFFE0, 0xFFE6},
                                                        {0x1F300, 0x1F64F},
                                                        {0x1F680, 0x1F6FF},
                                                        {0x1F900, 0x1F9FF},
                                                        {0x20000, 0x3FFFD}});
    if (code < 0x300) return 1;
    return in(kNone, code) ? 0 : in(kWide, code) ? 2 : 1;
}

// What a reader is shown of one character, and how many columns that takes.
struct Shown {
    std::string text;
    int columns = 0;
};

Shown show(std::string_view text, const Character& character, int tab) {
    Shown shown;
    if (!character.valid) {
        shown.text = fmt::format("\\x{:02x}", static_cast<unsigned>(character.code));
    } else if (character.code == '\t' || (tab == 1 && (character.code == '\n' || character.code == '\r'))) {
        shown.text.assign(static_cast<std::size_t>(tab), ' ');
    } else if (treacherous(character.code)) {
        shown.text = character.code < 0x80 ? fmt::format("\\x{:02x}", static_cast<unsigned>(character.code))
                                           : fmt::format("\\u{:04x}", static_cast<unsigned>(character.code));
    } else {
        return {std::string(text.substr(0, character.bytes)), columns(character.code)};
    }
    shown.columns = static_cast<int>(shown.text.size());
    return shown;
}

// Start of the character before `at`, not before `limit`. Precondition: at > limit.
std::size_t step_back(std::string_view text, std::size_t at, std::size_t limit) {
    for (std::size_t length = 2; length <= 4 && at >= limit + length; ++length) {
        const Character character = first_character(text.substr(at - length, length));
        if (character.valid && character.bytes == length) return at - length;
    }
    return at - 1;
}

struct Painter {
    bool color;
    [[nodiscard]] std::string operator()(std::string_view style, std::string_view text) const {
        return color ? fmt::format("\x1b[{}m{}\x1b[0m", style, text) : std::string(text);
    }
};

std::string_view style_of(Severity severity) {
    switch (severity) {
        case Severity::remark:
            return "1;36";
        case Severity::warning:
            return "1;35";
        case Severity::error:
            return "1;31";
    }
    return "1";
}

// The part of the source line around the caret, and the line with the caret.
std::pair<std::string, std::string> excerpt(std::string_view text, std::size_t line_start,
                                            std::size_t caret) {
    // Never look further than a window can show: a line may hold the whole document.
    const std::size_t reach = std::min(text.size(), caret + 4 * kWindow + 4);
    std::size_t end = std::min(text.substr(0, reach).find('\n', caret), reach);
    if (end > caret && text[end - 1] == '\r' && (end == text.size() || text[end] == '\n')) --end;

    std::vector<Shown> before;
    int width_before = 0;
    std::size_t begin = caret;
    while (begin > line_start && width_before < kWindow) {
        const std::size_t previous = step_back(text, begin, line_start);
        before.push_back(show(text.substr(previous), first_character(text.substr(previous)), 4));
        width_before += before.back().columns;
        begin = previous;
    }
    std::vector<Shown> after;
    int width_after = 0;
    std::size_t at = caret;
    while (at < end && width_after < kWindow) {
        const Character character = first_character(text.substr(at));
        after.push_back(show(text.substr(at), character, 4));
        width_after += after.back().columns;
        at += character.bytes;
    }
    const bool whole = begin == line_start && at >= end;
    std::string shown;
    int caret_column = 0;
    std::size_t kept = before.size();
    bool cut_front = begin > line_start;
    if (!whole || width_before + width_after > kWindow) {
        // The caret keeps its surroundings; what is left of the window goes to the other side.
        const int room = std::max(kBeforeCaret, kWindow - width_after);
        int width = 0;
        for (kept = 0; kept < before.size() && width + before[kept].columns <= room; ++kept) {
            width += before[kept].columns;
        }
        cut_front = cut_front || kept < before.size();
    }
    if (cut_front) {
        shown += kCut;
        caret_column += 1;
    }
    for (std::size_t i = kept; i-- > 0;) {
        shown += before[i].text;
        caret_column += before[i].columns;
    }
    int width = caret_column;
    std::size_t used = 0;
    for (; used < after.size() && (width + after[used].columns <= kWindow || used == 0); ++used) {
        shown += after[used].text;
        width += after[used].columns;
    }
    if (used < after.size() || at < end) shown += kCut;
    return {std::move(shown), std::string(static_cast<std::size_t>(caret_column), ' ') + "^"};
}

// "FILE:LINE:COLUMN:", as far as there is a line and a column.
std::string located(std::string_view file, Place place) {
    std::string where = file.empty() ? "popupc" : file == "-" ? "<stdin>" : visible(file);
    if (place.line > 0) {
        where += fmt::format(":{}", place.line);
        if (place.column > 0) where += fmt::format(":{}", place.column);
    }
    return where + ":";
}

// The source line and a caret under the column; nothing for a place without a column.
std::string pointed_at(Place place, PlaceFinder& source, const Painter& paint) {
    std::size_t line_start = 0;
    std::size_t caret = 0;
    if (place.column <= 0 || !source.find(place, line_start, caret)) return {};
    const auto [line, pointer] = excerpt(source.text(), line_start, caret);
    return fmt::format("{:>5} | {}\n      | {}\n", place.line, line, paint("1;32", pointer));
}

}  // namespace

std::string visible(std::string_view text) {
    std::string result;
    result.reserve(text.size());
    while (!text.empty()) {
        const Character character = first_character(text);
        result += show(text, character, 1).text;
        text.remove_prefix(character.bytes);
    }
    return result;
}

bool PlaceFinder::find(Place place, std::size_t& line_start, std::size_t& caret) {
    if (place.line < 1) return false;
    const auto behind = [](Place wanted, const Mark& mark) {
        return wanted.line < mark.line || (wanted.line == mark.line && wanted.column < mark.column);
    };
    const auto next = std::upper_bound(marks_.begin(), marks_.end(), place, behind);
    const Mark nearest = next == marks_.begin() ? Mark{} : *std::prev(next);
    if (behind(place, at_) || nearest.caret > at_.caret) at_ = nearest;
    const auto remember = [this] {
        const std::size_t last = marks_.empty() ? 0 : marks_.back().caret;
        if (at_.caret >= last + kMarkEvery) marks_.push_back(at_);
    };
    while (at_.line < place.line) {
        const std::size_t next = text_.find('\n', at_.caret);
        if (next == std::string_view::npos) return false;
        at_ = {next + 1, next + 1, at_.line + 1, 1};
        remember();
    }
    while (at_.column < place.column && at_.caret < text_.size() && text_[at_.caret] != '\n') {
        at_.caret += first_character(text_.substr(at_.caret)).bytes;
        ++at_.column;
        remember();
    }
    line_start = at_.line_start;
    caret = at_.caret;
    return true;
}

std::string render_short(const Diagnostic& diagnostic, bool color) {
    const Painter paint{color};
    const std::string severity = fmt::format("{}:", to_string(diagnostic.severity));
    return fmt::format("{} {} {} [{}]\n", paint("1", located(diagnostic.file, diagnostic.place)),
                       paint(style_of(diagnostic.severity), severity), visible(diagnostic.message),
                       diagnostic.code);
}

std::string render_text(const Diagnostic& diagnostic, PlaceFinder& source, bool color) {
    const Painter paint{color};
    std::string text = render_short(diagnostic, color);
    text += pointed_at(diagnostic.place, source, paint);
    if (diagnostic.change && !diagnostic.change->after.empty()) {
        text += fmt::format("   {} {}\n   {} {}\n", paint("36", "was:"), visible(diagnostic.change->before),
                            paint("36", "now:"), visible(diagnostic.change->after));
    }
    for (const Related& other : diagnostic.related) {
        text += fmt::format("  {} {} {}\n", paint("36", "with:"), located(diagnostic.file, other.place),
                            visible(other.text));
        text += pointed_at(other.place, source, paint);
    }
    for (const std::string& hint : diagnostic.hints) {
        text += fmt::format("  {} {}\n", paint("36", "hint:"), visible(hint));
    }
    return text;
}

std::string render_excerpt(Place place, PlaceFinder& source) { return pointed_at(place, source, {false}); }

nlohmann::ordered_json to_json(const Diagnostic& diagnostic) {
    nlohmann::ordered_json json;
    const auto or_null = [](const auto& value, bool present) {
        return present ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
    };
    json["file"] = or_null(diagnostic.file, !diagnostic.file.empty());
    json["line"] = or_null(diagnostic.place.line, diagnostic.place.line > 0);
    json["column"] = or_null(diagnostic.place.column, diagnostic.place.column > 0);
    json["severity"] = to_string(diagnostic.severity);
    json["code"] = diagnostic.code;
    json["element"] = or_null(diagnostic.element, !diagnostic.element.empty());
    json["message"] = diagnostic.message;
    json["hints"] = diagnostic.hints;
    const Change change = diagnostic.change.value_or(Change{});
    json["before"] = or_null(change.before, diagnostic.change.has_value());
    json["after"] = or_null(change.after, diagnostic.change.has_value());
    for (const Related& other : diagnostic.related) {
        json["related"].push_back({{"line", or_null(other.place.line, other.place.line > 0)},
                                   {"column", or_null(other.place.column, other.place.column > 0)},
                                   {"text", other.text}});
    }
    return json;
}

std::string render_json(const Diagnostic& diagnostic) {
    return to_json(diagnostic).dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace popup
