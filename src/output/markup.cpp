#include "output/markup.h"

#include "base/diagnostics/render_diagnostics.h"

namespace popup {

std::string as_markup(std::string_view text) {
    std::string result;
    for (const char c : text) {
        switch (c) {
            case '&':
                result += "&amp;";
                break;
            case '<':
                result += "&lt;";
                break;
            case '>':
                result += "&gt;";
                break;
            case '"':
                result += "&quot;";
                break;
            default:
                result += c;
        }
    }
    return result;
}

std::string told_html(std::string_view text) { return as_markup(visible(text)); }

}  // namespace popup
