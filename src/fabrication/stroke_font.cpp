#include "fabrication/stroke_font.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "fabrication/stroke_font_files.h"
#include "popup/diagnostics.h"

namespace popup {
namespace {

// The letters of each character from the space to the tilde, from the lines of the file: five characters that
// say nothing, three that count pairs, and the pairs. A pair of letters is a point, right of and below R by
// its place in the alphabet of ASCII; " R" lifts the pen. The first pair is where the character begins and
// ends.
constexpr std::size_t kPairs = 8;
constexpr std::size_t kCount = 95;

std::array<std::string_view, kCount> letters_of_file() {
    std::array<std::string_view, kCount> letters;
    std::string_view text = stroke_font_files()[0].text;
    for (std::string_view& letter : letters) {
        const std::string_view line = text.substr(0, text.find('\n'));
        POPUP_INVARIANT(line.size() >= kPairs + 2);
        letter = line.substr(kPairs);
        text.remove_prefix(std::min(line.size() + 1, text.size()));
    }
    return letters;
}

// Capitals reach from 12 above the middle to 9 below it.
constexpr double kBase = 9.0;
constexpr double kCapitals = 21.0;
// A little narrower than drawn, so that text is never wider than pattern/labels.h reckons with.
constexpr double kNarrow = 0.92;

}  // namespace

bool has_stroke_letter(char32_t character) { return character >= U' ' && character <= U'~'; }

StrokeLetter stroke_letter(char32_t character) {
    static const std::array<std::string_view, kCount> kLetters = letters_of_file();
    const std::string_view pairs = kLetters.at(static_cast<std::size_t>(character - U' '));
    const auto units = [](char c) { return static_cast<double>(c - 'R'); };
    const double left = units(pairs[0]);
    StrokeLetter letter;
    letter.advance = kNarrow * (units(pairs[1]) - left) / kCapitals;
    letter.lines.emplace_back();
    for (std::size_t i = 2; i + 1 < pairs.size(); i += 2) {
        if (pairs[i] == ' ') {
            letter.lines.emplace_back();
            continue;
        }
        letter.lines.back().push_back(
            {kNarrow * (units(pairs[i]) - left) / kCapitals, (kBase - units(pairs[i + 1])) / kCapitals});
    }
    std::erase_if(letter.lines, [](const std::vector<Vec2>& line) { return line.size() < 2; });
    return letter;
}

}  // namespace popup
