#include "lsp/text.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <unordered_map>
#include <utility>

#include "base/text/utf8.h"

namespace popup::lsp {
namespace {

struct EncodingName {
    Encoding encoding;
    std::string_view name;
};
constexpr std::array<EncodingName, 3> kEncodings{
    {{Encoding::utf16, "utf-16"}, {Encoding::utf8, "utf-8"}, {Encoding::utf32, "utf-32"}}};
constexpr std::string_view kMark = "\xEF\xBB\xBF";

// How far apart there are counts.
constexpr std::size_t kCountedBytes = 1024;

// Over the character at `here`.
template <class Counted>
void step(std::string_view text, Counted& here) {
    const bool ascii = static_cast<unsigned char>(text[here.at]) < 0x80U;
    const Character character = ascii ? Character{0, 1} : first_character(text.substr(here.at));
    here.at += character.bytes;
    here.utf16 += character.code > 0xFFFF ? 2 : 1;
    ++here.utf32;
}

// Whether a text is cut between the "\r" and the "\n" of a line's end.
bool parts_line_end(std::string_view text, std::size_t at) {
    return at > 0 && at < text.size() && text[at - 1] == '\r' && text[at] == '\n';
}

bool continues(char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; }

// The number of the line that a byte is in.
std::size_t line_of(const std::vector<std::size_t>& starts, std::size_t at) {
    return static_cast<std::size_t>(std::upper_bound(starts.begin(), starts.end(), at) - starts.begin()) - 1;
}

std::vector<std::string_view> lines_of(std::string_view text) {
    std::vector<std::string_view> lines;
    while (!text.empty()) {
        const std::size_t end = text.find('\n');
        const std::size_t size = end == std::string_view::npos ? text.size() : end + 1;
        lines.push_back(text.substr(0, size));
        text.remove_prefix(size);
    }
    return lines;
}

}  // namespace

std::string_view to_string(Encoding encoding) {
    for (const EncodingName& row : kEncodings) {
        if (row.encoding == encoding) return row.name;
    }
    return {};
}

std::optional<Encoding> find_encoding(std::string_view name) {
    for (const EncodingName& row : kEncodings) {
        if (row.name == name) return row.encoding;
    }
    return std::nullopt;
}

Text::Text(std::string bytes) : bytes_(std::move(bytes)) { find_lines(); }

void Text::find_lines() {
    starts_.assign(1, 0);
    feeds_.assign(1, 0);
    for (std::size_t i = 0; i < bytes_.size(); ++i) {
        // find_first_of() asks for each byte by a call.
        if (bytes_[i] != '\n' && bytes_[i] != '\r') continue;
        const bool feed = bytes_[i] == '\n';
        if (feed || i + 1 == bytes_.size() || bytes_[i + 1] != '\n') starts_.push_back(i + 1);
        if (feed) feeds_.push_back(i + 1);
    }
    count_units();
}

// Before what ends it.
std::size_t Text::end_of_line(std::size_t line) const {
    if (line + 1 == starts_.size()) return bytes_.size();
    std::size_t end = starts_[line + 1] - 1;
    if (bytes_[end] == '\n' && end > starts_[line] && bytes_[end - 1] == '\r') --end;
    return end;
}

std::size_t Text::Counted::units(Encoding encoding) const {
    switch (encoding) {
        case Encoding::utf8:
            return at;
        case Encoding::utf16:
            return utf16;
        case Encoding::utf32:
            return utf32;
    }
    return at;
}

void Text::count_units() {
    counts_.assign(1, {});
    Counted here;
    while (here.at < bytes_.size()) {
        step(bytes_, here);
        if (here.at >= counts_.back().at + kCountedBytes) counts_.push_back(here);
    }
}

Text::Counted Text::counted(std::size_t at) const {
    const auto behind =
        std::upper_bound(counts_.begin(), counts_.end(), at,
                         [](std::size_t place, const Counted& one) { return place < one.at; });
    Counted here = *std::prev(behind);
    while (here.at < at) {
        Counted next = here;
        step(bytes_, next);
        if (next.at > at) break;
        here = next;
    }
    return here;
}

std::size_t Text::ahead(std::size_t from, std::size_t units, Encoding encoding, std::size_t limit) const {
    Counted here = counted(from);
    const std::size_t wanted = here.units(encoding) + units;
    const auto behind = std::upper_bound(
        counts_.begin(), counts_.end(), wanted,
        [encoding](std::size_t count, const Counted& one) { return count < one.units(encoding); });
    const Counted& near = *std::prev(behind);
    if (near.at > limit) return limit;
    if (near.at > here.at) here = near;
    while (here.at < limit && here.units(encoding) < wanted) {
        Counted next = here;
        step(bytes_, next);
        if (next.units(encoding) > wanted) break;
        here = next;
    }
    return std::min(here.at, limit);
}

std::size_t Text::offset(Position position, Encoding encoding) const {
    if (position.line < 0) return 0;
    const auto line = static_cast<std::size_t>(position.line);
    if (line >= starts_.size()) return bytes_.size();
    const auto units = static_cast<std::size_t>(std::max(position.character, 0));
    return ahead(starts_[line], units, encoding, end_of_line(line));
}

Position Text::position(std::size_t at, Encoding encoding) const {
    const std::size_t line = line_of(starts_, at);
    const std::size_t here = counted(std::min(at, end_of_line(line))).units(encoding);
    const std::size_t start = counted(starts_[line]).units(encoding);
    return {static_cast<int>(line), static_cast<int>(here - start)};
}

std::size_t Text::offset(Place place) const {
    if (place.line <= 0) return 0;
    const auto line = static_cast<std::size_t>(place.line) - 1;
    if (line >= feeds_.size()) return bytes_.size();
    std::size_t start = feeds_[line];
    if (line == 0 && bytes_.starts_with(kMark)) start += kMark.size();
    const std::size_t end = line + 1 < feeds_.size() ? feeds_[line + 1] - 1 : bytes_.size();
    const auto units = static_cast<std::size_t>(std::max(place.column - 1, 0));
    return ahead(start, units, Encoding::utf32, end);
}

void Text::replace(Span at, std::string_view text) {
    bytes_.replace(at.begin, at.size(), text);
    find_lines();
}

std::string with_edits(std::string_view text, std::vector<TextEdit> edits) {
    std::stable_sort(edits.begin(), edits.end(),
                     [](const TextEdit& a, const TextEdit& b) { return a.at.begin < b.at.begin; });
    std::string out;
    std::size_t done = 0;
    for (const TextEdit& edit : edits) {
        POPUP_INVARIANT(edit.at.begin >= done && edit.at.end >= edit.at.begin && edit.at.end <= text.size());
        out += text.substr(done, edit.at.begin - done);
        out += edit.text;
        done = edit.at.end;
    }
    out += text.substr(done);
    return out;
}

TextEdit difference(std::string_view before, std::string_view after) {
    const std::size_t most = std::min(before.size(), after.size());
    std::size_t front = 0;
    while (front < most && before[front] == after[front]) ++front;
    while (front > 0 && ((front < before.size() && continues(before[front])) ||
                         (front < after.size() && continues(after[front]))))
        --front;
    if (parts_line_end(before, front) || parts_line_end(after, front)) --front;
    std::size_t back = 0;
    while (back < most - front && before[before.size() - 1 - back] == after[after.size() - 1 - back]) ++back;
    while (back > 0 && continues(before[before.size() - back])) --back;
    if (parts_line_end(before, before.size() - back) || parts_line_end(after, after.size() - back)) --back;
    return {{front, before.size() - back}, std::string(after.substr(front, after.size() - front - back))};
}

std::vector<TextEdit> differences(std::string_view before, std::string_view after) {
    const std::vector<std::string_view> old_lines = lines_of(before);
    const std::vector<std::string_view> new_lines = lines_of(after);
    std::vector<TextEdit> edits;
    std::size_t at = 0;  // byte of `before`
    std::size_t i = 0;
    std::size_t j = 0;
    const auto change = [&](std::size_t old_end, std::size_t new_end) {
        std::string_view old_part = before.substr(at, 0);
        std::string_view new_part = after.substr(after.size(), 0);
        if (old_end > i)
            old_part = {old_lines[i].data(),
                        static_cast<std::size_t>(old_lines[old_end - 1].data() - old_lines[i].data()) +
                            old_lines[old_end - 1].size()};
        if (new_end > j)
            new_part = {new_lines[j].data(),
                        static_cast<std::size_t>(new_lines[new_end - 1].data() - new_lines[j].data()) +
                            new_lines[new_end - 1].size()};
        if (old_part != new_part) {
            TextEdit edit = difference(old_part, new_part);
            edit.at.begin += at;
            edit.at.end += at;
            edits.push_back(std::move(edit));
        }
        at += old_part.size();
        i = old_end;
        j = new_end;
    };
    // Repairs change words of lines and take lines out; looking a little ahead finds where the texts meet
    // again.
    constexpr std::size_t kAhead = 64;
    while (i < old_lines.size() || j < new_lines.size()) {
        if (i < old_lines.size() && j < new_lines.size() && old_lines[i] == new_lines[j]) {
            at += old_lines[i].size();
            ++i;
            ++j;
            continue;
        }
        bool met = false;
        for (std::size_t apart = 1; apart <= 2 * kAhead && !met; ++apart) {
            for (std::size_t old_ahead = 0; old_ahead <= apart && !met; ++old_ahead) {
                const std::size_t p = i + old_ahead;
                const std::size_t q = j + apart - old_ahead;
                if (p >= old_lines.size() || q >= new_lines.size() || old_lines[p] != new_lines[q]) continue;
                change(p, q);
                met = true;
            }
        }
        if (!met) change(old_lines.size(), new_lines.size());
    }
    return edits;
}

}  // namespace popup::lsp
