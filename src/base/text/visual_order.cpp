#include "base/text/visual_order.h"

#include <fribidi.h>

#include <algorithm>
#include <vector>

namespace popup {
namespace {

// The lead byte of the first character that may stand in a script that runs to the left, or that says which
// way text runs: U+0580, just before Hebrew.
constexpr unsigned char kFirstLead = 0xD6;

}  // namespace

std::string in_visual_order(std::string_view text) {
    const auto may_turn = [](char c) { return static_cast<unsigned char>(c) >= kFirstLead; };
    if (std::none_of(text.begin(), text.end(), may_turn)) return std::string(text);
    std::string bytes(text);
    std::vector<FriBidiChar> logical(bytes.size() + 1);
    const FriBidiStrIndex length = fribidi_charset_to_unicode(
        FRIBIDI_CHAR_SET_UTF8, bytes.c_str(), static_cast<FriBidiStrIndex>(bytes.size()), logical.data());
    std::vector<FriBidiChar> visual(static_cast<std::size_t>(length) + 1);
    FriBidiParType direction = FRIBIDI_PAR_ON;
    const FriBidiLevel levels =
        fribidi_log2vis(logical.data(), length, &direction, visual.data(), nullptr, nullptr, nullptr);
    // One level, and that of text that runs to the right: nothing has changed. None: there was no memory.
    if (levels <= 1 && direction != FRIBIDI_PAR_RTL) return bytes;
    visual.resize(static_cast<std::size_t>(length));
    // Where two letters have become one, the place of the second is filled.
    std::erase(visual, static_cast<FriBidiChar>(FRIBIDI_CHAR_FILL));
    std::string result(4 * visual.size() + 1, '\0');
    const FriBidiStrIndex written = fribidi_unicode_to_charset(
        FRIBIDI_CHAR_SET_UTF8, visual.data(), static_cast<FriBidiStrIndex>(visual.size()), result.data());
    result.resize(static_cast<std::size_t>(written));
    return result;
}

}  // namespace popup
