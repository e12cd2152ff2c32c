#include "input/drawing/vocabulary.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "input/drawing/shapes.h"

namespace popup::drawing {
namespace {

constexpr std::array<std::pair<std::string_view, Layer>, 8> kLayers{{{"fill", Layer::fill},
                                                                     {"draw", Layer::draw},
                                                                     {"glue", Layer::glue},
                                                                     {"label", Layer::label},
                                                                     {"valley", Layer::valley},
                                                                     {"mountain", Layer::mountain},
                                                                     {"seam", Layer::seam},
                                                                     {"cut", Layer::cut}}};

constexpr std::array<std::pair<Color, Use>, 3> kFoldColors{
    {{{0xff, 0x00, 0xff}, Use::valley}, {{0x00, 0x00, 0xff}, Use::mountain}, {{0, 0, 0}, Use::seam}}};

constexpr std::array<std::string_view, 4> kContainers{"g", "svg", "a", "switch"};
constexpr std::array<std::string_view, 8> kSkipped{"text",     "image", "foreignObject", "flowRoot",
                                                   "textArea", "video", "iframe",        "canvas"};
constexpr std::array<std::string_view, 26> kSilent{"defs",           "symbol",
                                                   "clipPath",       "mask",
                                                   "marker",         "pattern",
                                                   "hatch",          "linearGradient",
                                                   "radialGradient", "meshgradient",
                                                   "solidcolor",     "filter",
                                                   "style",          "script",
                                                   "metadata",       "title",
                                                   "desc",           "view",
                                                   "cursor",         "font",
                                                   "font-face",      "color-profile",
                                                   "animate",        "animateTransform",
                                                   "animateMotion",  "set"};

}  // namespace

Role role_of(std::string_view tag) {
    if (is_shape(tag)) return Role::shape;
    if (among(kContainers, tag)) return Role::container;
    if (tag == "use") return Role::use;
    if (among(kSkipped, tag)) return Role::skipped;
    return among(kSilent, tag) ? Role::silent : Role::unknown;
}

std::optional<std::string_view> svg_prefix(const xml::Located& located) {
    constexpr std::string_view kNamespace = "http://www.w3.org/2000/svg";
    const std::string_view name = located.name(0);
    const std::size_t colon = name.find(':');
    if (colon == std::string_view::npos)
        return name == "svg" ? std::optional(name.substr(0, 0)) : std::nullopt;
    if (name.substr(colon + 1) != "svg") return std::nullopt;
    const std::string wanted = "xmlns:" + std::string(name.substr(0, colon));
    const std::size_t end =
        located.elements.size() > 1 ? located.elements[1].first_attribute : located.attributes.size();
    for (std::size_t i = 0; i < end; ++i) {
        const xml::LocatedAttribute& a = located.attributes[i];
        if (located.text.substr(a.name, a.name_length) == wanted &&
            located.text.substr(a.value, a.value_length) == kNamespace)
            return name.substr(0, colon + 1);
    }
    return std::nullopt;
}

Layer layer_named(std::string_view name) {
    const auto* row =
        std::find_if(kLayers.begin(), kLayers.end(), [&](const auto& r) { return r.first == name; });
    return row == kLayers.end() ? Layer::none : row->second;
}

Use use_of(const Style& style) {
    if (style.dash == Dash::none || style.stroke.kind != Paint::Kind::color) return Use::cut;
    const auto* row = std::find_if(kFoldColors.begin(), kFoldColors.end(),
                                   [&](const auto& r) { return r.first == style.stroke.color; });
    return row == kFoldColors.end() ? Use::cut : row->second;
}

}  // namespace popup::drawing
