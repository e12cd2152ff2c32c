#include "input/drawing/style.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "base/text/number_scanner.h"
#include "input/color.h"
#include "input/drawing/size.h"
#include "input/text.h"

namespace popup::drawing {
namespace {

constexpr int kImportant = 1'000'000;

constexpr std::array<std::pair<std::string_view, Property>, kProperties> kNames{{
    {"stroke", Property::stroke},
    {"fill", Property::fill},
    {"display", Property::display},
    {"visibility", Property::visibility},
    {"stroke-dasharray", Property::dashes},
    {"opacity", Property::opacity},
    {"stroke-opacity", Property::stroke_opacity},
    {"color", Property::color},
    {"stroke-width", Property::width},
    {"fill-rule", Property::fill_rule},
    {"clip-path", Property::clip},
    {"mask", Property::mask},
}};

bool is_word(std::string_view text) {
    return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) {
        const auto byte = static_cast<unsigned char>(c);
        return byte >= 0x80U || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
               c == '-' || c == '_';
    });
}

// How much a selector of one element weighs; -1 when it is none.
int weight_of(std::string_view selector) {
    if (selector == "*") return Declarations::kAny;
    if (selector.starts_with('#')) return is_word(selector.substr(1)) ? Declarations::kId : -1;
    const std::size_t dot = selector.find('.');
    const std::string_view tag = selector.substr(0, dot);
    if (!tag.empty() && !is_word(tag)) return -1;
    if (dot == std::string_view::npos) return tag.empty() ? -1 : Declarations::kTag;
    if (!is_word(selector.substr(dot + 1))) return -1;
    return Declarations::kClass + (tag.empty() ? 0 : Declarations::kTag);
}

std::string without_comments(std::string_view css) {
    std::string out;
    while (!css.empty()) {
        const std::size_t begin = css.find("/*");
        out += css.substr(0, begin);
        if (begin == std::string_view::npos) break;
        out += ' ';
        const std::size_t end = css.find("*/", begin + 2);
        css = end == std::string_view::npos ? std::string_view{} : css.substr(end + 2);
    }
    return out;
}

// Calls `use` with the words of a list.
template <typename Use>
void split(std::string_view text, std::string_view separators, Use use) {
    while (!text.empty()) {
        const std::size_t end = text.find_first_of(separators);
        const std::string_view word = trimmed(text.substr(0, end));
        if (!word.empty()) use(word);
        text = end == std::string_view::npos ? std::string_view{} : text.substr(end + 1);
    }
}

// Lengths of dashes and gaps in turn; of an odd number twice.
void take_dashes(std::string_view text, Style& style) {
    style.dash = Dash::none;
    style.dash_length = style.gap_length = 0.0;
    NumberScanner scanner(text);
    std::vector<double> lengths;
    double sum = 0.0;
    while (const auto number = scanner.number()) {
        lengths.push_back(*number);
        sum += *number;
        while (scanner.peek() == '%' || (scanner.peek() | 0x20) >= 'a') scanner.skip(1);  // a unit
    }
    if (!(sum > 0.0)) return;
    style.dash = Dash::even;
    const std::size_t period = lengths.size() % 2 == 0 ? lengths.size() : 2 * lengths.size();
    for (std::size_t i = 0; i < period; ++i) {
        const double here = lengths[i % lengths.size()];
        double& longest = i % 2 == 0 ? style.dash_length : style.gap_length;
        longest = std::max(longest, here);
        if (i % 2 == 0 && here != lengths[0]) style.dash = Dash::mixed;
    }
}

// "255, 0, 0" or "100% 0% 0%", what follows a third value disregarded.
std::optional<Color> parse_components(std::string_view text) {
    NumberScanner scanner(text);
    std::array<std::uint8_t, 3> parts{};
    for (std::uint8_t& part : parts) {
        auto value = scanner.number();
        if (!value) return std::nullopt;
        if (scanner.peek() == '%') {
            scanner.skip(1);
            *value *= 2.55;
        }
        part = static_cast<std::uint8_t>(std::lround(std::clamp(*value, 0.0, 255.0)));
    }
    return Color{parts[0], parts[1], parts[2]};
}

Color of_shares(const std::array<double, 3>& shares) {
    const auto part = [](double share) {
        // Halves are rounded up, whatever the digits of percentages have lost.
        constexpr double kLost = 1e-9;
        return static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(share, 0.0, 1.0) + kLost));
    };
    return {part(shares[0]), part(shares[1]), part(shares[2])};
}

// Degrees, or with a unit of CSS; "none" is 0.
std::optional<double> scan_hue(NumberScanner& scanner) {
    const auto is_letter = [&] { return (scanner.peek() | 0x20) >= 'a' && (scanner.peek() | 0x20) <= 'z'; };
    const auto word = [&] {
        std::string found;
        for (; is_letter(); scanner.skip(1)) found += static_cast<char>(scanner.peek());
        return found;
    };
    const auto number = scanner.number();
    if (!number) return word() == "none" ? std::optional(0.0) : std::nullopt;
    const std::string unit = word();
    if (unit.empty() || unit == "deg") return number;
    if (unit == "grad") return 0.9 * *number;
    if (unit == "rad") return *number * 180.0 / std::numbers::pi;
    return unit == "turn" ? std::optional(360.0 * *number) : std::nullopt;
}

// A percentage as a share of 1; the mark may be missing.
std::optional<double> scan_percent(NumberScanner& scanner) {
    const auto number = scanner.number();
    if (!number) return std::nullopt;
    if (scanner.peek() == '%') scanner.skip(1);
    return std::clamp(*number / 100.0, 0.0, 1.0);
}

// CSS Color Module Level 4, 7: of a hue, a saturation and a lightness.
std::array<double, 3> from_hsl(double hue, double saturation, double lightness) {
    const double reach = saturation * std::min(lightness, 1.0 - lightness);
    std::array<double, 3> shares{};
    const std::array<double, 3> begins{0.0, 8.0, 4.0};
    const double turn = hue / 360.0 - std::floor(hue / 360.0);
    for (std::size_t i = 0; i < shares.size(); ++i) {
        const double k = std::fmod(begins.at(i) + 12.0 * turn, 12.0);
        shares.at(i) = lightness - reach * std::clamp(std::min(k - 3.0, 9.0 - k), -1.0, 1.0);
    }
    return shares;
}

// What stands in the brackets of hsl() and hsla(), and of hwb().
std::optional<Color> parse_hue(std::string_view text, bool is_hwb) {
    NumberScanner scanner(text);
    const auto hue = scan_hue(scanner);
    const auto second = hue ? scan_percent(scanner) : std::nullopt;
    const auto third = second ? scan_percent(scanner) : std::nullopt;
    if (!third || !std::isfinite(*hue)) return std::nullopt;
    if (!is_hwb) return of_shares(from_hsl(*hue, *second, *third));
    const double sum = *second + *third;
    if (sum >= 1.0) return of_shares({*second / sum, *second / sum, *second / sum});
    std::array<double, 3> shares = from_hsl(*hue, 1.0, 0.5);
    for (double& share : shares) share = share * (1.0 - sum) + *second;
    return of_shares(shares);
}

bool is_current_color(std::string_view text) { return lower(trimmed(text)) == "currentcolor"; }

}  // namespace

std::optional<Property> find_property(std::string_view name) {
    const auto* row =
        std::find_if(kNames.begin(), kNames.end(), [&](const auto& r) { return r.first == name; });
    return row == kNames.end() ? std::nullopt : std::optional(row->second);
}

void Declarations::set(Property property, const Value& value) {
    std::optional<Value>& mine = values_.at(static_cast<std::size_t>(property));
    if (!mine || std::pair(value.weight, value.order) >= std::pair(mine->weight, mine->order)) mine = value;
}

void Declarations::set(Property property, std::string_view value, int weight, std::uint32_t order) {
    value = trimmed(value);
    if (const std::size_t mark = value.find('!'); mark != std::string_view::npos) {
        if (trimmed(value.substr(mark + 1)) == "important") weight += kImportant;
        value = trimmed(value.substr(0, mark));
    }
    if (!value.empty()) set(property, Value{std::string(value), weight, order});
}

void Declarations::set_all(std::string_view list, int weight, std::uint32_t order) {
    split(list, ";", [&](std::string_view one) {
        const std::size_t colon = one.find(':');
        if (colon == std::string_view::npos) return;
        const auto property = find_property(lower(trimmed(one.substr(0, colon))));
        if (property) set(*property, one.substr(colon + 1), weight, order);
    });
}

void Declarations::add(const Declarations& other) {
    for (std::size_t i = 0; i < kProperties; ++i) {
        if (other.values_.at(i)) set(static_cast<Property>(i), *other.values_.at(i));
    }
}

const std::string* Declarations::find(Property property) const {
    const std::optional<Value>& value = values_.at(static_cast<std::size_t>(property));
    return value ? &value->text : nullptr;
}

void StyleSheet::add(std::string_view css) {
    const std::string text = without_comments(css);
    std::string_view rest = text;
    while (!rest.empty()) {
        const std::size_t open = rest.find_first_of("{;");
        if (open == std::string_view::npos) return;
        if (rest[open] == ';') {  // "@import …;"
            rest.remove_prefix(open + 1);
            continue;
        }
        const std::string_view selectors = trimmed(rest.substr(0, open));
        std::size_t end = open + 1;
        for (int depth = 1; end < rest.size(); ++end) {
            if (rest[end] == '{') ++depth;
            if (rest[end] == '}' && --depth == 0) break;
        }
        if (selectors.starts_with('@')) {
            if (!selectors.starts_with("@font-face")) ++not_read_;
        } else {
            add_rule(selectors, rest.substr(open + 1, end - open - 1));
        }
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
}

void StyleSheet::add_rule(std::string_view selectors, std::string_view body) {
    ++order_;
    split(selectors, ",", [&](std::string_view selector) {
        const int weight = weight_of(selector);
        Declarations declarations;
        declarations.set_all(body, weight, order_);
        if (weight >= 0) {
            rules_[std::string(selector)].add(declarations);
            return;
        }
        bool matters = false;
        for (std::size_t i = 0; i < kProperties; ++i) {
            // That of texts is hardly ever what strokes are drawn in.
            const auto property = static_cast<Property>(i);
            matters = matters || (property != Property::color && declarations.find(property) != nullptr);
        }
        if (matters) ++not_read_;
    });
}

void StyleSheet::apply(std::string_view tag, std::string_view id, std::string_view classes,
                       Declarations& declarations) const {
    if (rules_.empty()) return;
    const auto take = [&](std::string_view selector) {
        const auto rule = rules_.find(selector);
        if (rule != rules_.end()) declarations.add(rule->second);
    };
    take("*");
    take(tag);
    split(classes, " \t\r\n", [&](std::string_view name) {
        const std::string selector = "." + std::string(name);
        take(selector);
        take(std::string(tag) + selector);
    });
    if (!id.empty()) take("#" + std::string(id));
}

Paint parse_paint(std::string_view text) {
    text = trimmed(text);
    const std::string word = lower(text);
    if (word == "none" || word == "transparent") return {};
    if (const std::size_t open = word.find('('); open != std::string::npos) {
        const std::string_view name = trimmed(std::string_view(word).substr(0, open));
        const std::string_view parts = std::string_view(word).substr(open + 1);
        std::optional<Color> color;
        if (name == "rgb" || name == "rgba") color = parse_components(parts);
        if (name == "hsl" || name == "hsla") color = parse_hue(parts, false);
        if (name == "hwb") color = parse_hue(parts, true);
        return color ? Paint{Paint::Kind::color, *color} : Paint{Paint::Kind::other, {0, 0, 0}};
    }
    std::string_view plain = text;
    // Transparency is disregarded: #rgba, #rrggbbaa.
    if (plain.starts_with('#') && plain.size() == 5) plain = plain.substr(0, 4);
    if (plain.starts_with('#') && plain.size() == 9) plain = plain.substr(0, 7);
    const auto color = parse_color(plain);
    return color ? Paint{Paint::Kind::color, *color} : Paint{Paint::Kind::other, {0, 0, 0}};
}

void Style::take(const Declarations& declarations) {
    const auto value = [&](Property property) -> const std::string* {
        const std::string* found = declarations.find(property);
        return found != nullptr && *found != "inherit" ? found : nullptr;
    };
    if (const auto* text = value(Property::color); text != nullptr && !is_current_color(*text))
        color = parse_paint(*text);
    if (const auto* text = value(Property::stroke)) {
        stroke = parse_paint(*text);
        stroke_text = *text;
        stroke_is_color = is_current_color(*text);
    }
    if (const auto* text = value(Property::fill)) {
        fill = parse_paint(*text);
        fill_written = true;
        fill_is_color = is_current_color(*text);
    }
    // It is the word that is handed down: each element has its own.
    if (stroke_is_color) stroke = color;
    if (fill_is_color) fill = color;
    if (const auto* text = value(Property::visibility)) visible = *text == "visible";
    if (const auto* text = value(Property::dashes)) take_dashes(*text, *this);
    if (const auto* text = value(Property::width)) {
        if (const auto length = parse_length(*text, 1.0); length && *length >= 0.0) width = *length;
    }
    if (const auto* text = value(Property::fill_rule)) even_odd = *text == "evenodd";
    const auto share = [&](Property property) -> std::optional<double> {
        const auto* text = value(property);
        const auto length = text == nullptr ? std::nullopt : parse_length(*text, 1.0);
        return length ? std::optional(std::clamp(*length, 0.0, 1.0)) : std::nullopt;
    };
    if (const auto own = share(Property::stroke_opacity)) stroke_opacity = *own;
    // What it is drawn in fades as well.
    if (const auto own = share(Property::opacity)) opacity *= *own;
    // Not inherited: an element that is not displayed is not looked into.
    const std::string* display = declarations.find(Property::display);
    displayed = display == nullptr || *display != "none";
}

}  // namespace popup::drawing
