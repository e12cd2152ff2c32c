#include "input/drawing/conditions.h"

#include <algorithm>
#include <string>

#include "input/text.h"

namespace popup::drawing {
namespace {

// Whether any word between commas is so.
template <typename Question>
bool any_of_list(std::string_view list, Question question) {
    while (!list.empty()) {
        const std::size_t end = std::min(list.find(','), list.size());
        if (question(lower(trimmed(list.substr(0, end))))) return true;
        list.remove_prefix(std::min(end + 1, list.size()));
    }
    return false;
}

}  // namespace

bool conditions_hold(const Attributes& attributes) {
    if (attributes.find("requiredExtensions") != nullptr) return false;
    if (attributes.find("systemLanguage") == nullptr) return true;
    return any_of_list(attributes.value("systemLanguage"), [](const std::string& language) {
        return language == "en" || language.starts_with("en-");
    });
}

bool is_style_for_us(std::string_view media, std::string_view type) {
    if (!trimmed(type).empty() && lower(trimmed(type)) != "text/css") return false;
    if (trimmed(media).empty()) return true;
    return any_of_list(
        media, [](const std::string& one) { return one.starts_with("all") || one.starts_with("screen"); });
}

}  // namespace popup::drawing
