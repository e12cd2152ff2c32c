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
    {"fill-opacity", Property::fill_opacity},
    {"color", Property::color},
    {"stroke-width", Property::width},
    {"fill-rule", Property::fill_rule},
    {"clip-path", Property::clip},
    {"mask", Property::mask},
    {"transform", Property::transform},
    {"transform-origin", Property::transform_origin},
}};

bool is_word(std::string_view text) {
    return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) {
        const auto byte = static_cast<unsigned char>(c);
        return byte >= 0x80U || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
               c == '-' || c == '_';
    });
}

constexpr std::string_view kRoot = ":root";

// How much a selector of one element weighs; -1 when it is none.
int weight_of(std::string_view selector) {
    if (selector == "*") return Declarations::kAny;
    if (selector == kRoot) return Declarations::kClass;
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

// Calls `use` with the declarations of a list. Semicolons within brackets and strings are none of its own, as
// in "--mark: url('data:image/png;base64,…')".
template <typename Use>
void each_declaration(std::string_view list, Use use) {
    int depth = 0;
    char quote = '\0';
    std::size_t begin = 0;
    for (std::size_t i = 0; i <= list.size(); ++i) {
        const char c = i < list.size() ? list[i] : ';';
        const bool ends = i == list.size() || (c == ';' && depth == 0 && quote == '\0');
        if (ends) {
            use(trimmed(list.substr(begin, i - begin)));
            begin = i + 1;
        } else if (quote != '\0') {
            if (c == '\\') ++i;
            if (c == quote) quote = '\0';
        } else if (c == '"' || c == '\'') {
            quote = c;
        } else if (c == '(' || c == '[' || c == '{') {
            ++depth;
        } else if (c == ')' || c == ']' || c == '}') {
            depth = std::max(depth - 1, 0);
        }
    }
}

// Words that mean the same for every property: its inherited value, if it is inherited at all, or its
// kInitial.
bool says_inherit(std::string_view text) {
    const std::string word = lower(text);
    return word == "inherit" || word == "unset" || word == "revert" || word == "revert-layer";
}
bool says_initial(std::string_view text) { return lower(text) == "initial"; }

// Lengths of dashes and gaps in turn; of an odd number twice.
void take_dashes(std::string_view text, Style& style) {
    NumberScanner scanner(text);
    std::vector<double> lengths;
    double sum = 0.0;
    while (const auto number = scanner.number()) {
        lengths.push_back(*number);
        sum += *number;
        while (scanner.peek() == '%' || (scanner.peek() | 0x20) >= 'a') scanner.skip(1);  // a unit
    }
    // What is no list of lengths leaves things as they are.
    if (lengths.empty() && lower(trimmed(text)) != "none" && !says_initial(text)) return;
    style.dash = Dash::none;
    style.dash_length = style.gap_length = 0.0;
    if (!(sum > 0.0)) return;
    bool mixed = false;
    const std::size_t period = lengths.size() % 2 == 0 ? lengths.size() : 2 * lengths.size();
    for (std::size_t i = 0; i < period; ++i) {
        const double here = lengths[i % lengths.size()];
        double& longest = i % 2 == 0 ? style.dash_length : style.gap_length;
        longest = std::max(longest, here);
        if (i % 2 == 0 && here != lengths[0]) mixed = true;
    }
    // Dashes that nothing parts are a line.
    if (style.gap_length > 0.0) style.dash = mixed ? Dash::mixed : Dash::even;
}

std::string scan_word(NumberScanner& scanner) {
    if (scanner.peek() == '\0') return {};
    const std::string_view rest = scanner.rest();
    const auto is_letter = [](char c) { return (c | 0x20) >= 'a' && (c | 0x20) <= 'z'; };
    const auto end = std::find_if_not(rest.begin(), rest.end(), is_letter);
    scanner.skip(static_cast<std::size_t>(end - rest.begin()));
    return std::string(rest.begin(), end);
}

// A number; "none" is 0 (CSS Color Module Level 4, 4.4).
std::optional<double> scan_number(NumberScanner& scanner) {
    if (const auto number = scanner.number()) return number;
    return scan_word(scanner) == "none" ? std::optional(0.0) : std::nullopt;
}

// "255, 0, 0" or "100% 0% 0%" or "none 0 0", what follows a third value disregarded.
std::optional<Color> parse_components(std::string_view text) {
    NumberScanner scanner(text);
    std::array<std::uint8_t, 3> parts{};
    for (std::uint8_t& part : parts) {
        auto value = scan_number(scanner);
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
    const auto number = scan_number(scanner);
    const std::string unit = scan_word(scanner);
    return !number || unit.empty() ? number : degrees_of(*number, unit);
}

// A percentage as a share of 1; the mark may be missing.
std::optional<double> scan_percent(NumberScanner& scanner) {
    const auto number = scan_number(scanner);
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

// Of "255, 0, 0, 0" or "255 0 0 / 0%".
bool is_transparent(std::string_view parts) {
    std::size_t mark = parts.find('/');
    if (mark == std::string_view::npos && std::count(parts.begin(), parts.end(), ',') == 3)
        mark = parts.rfind(',');
    if (mark == std::string_view::npos) return false;
    NumberScanner scanner(parts.substr(mark + 1));
    const auto alpha = scan_number(scanner);
    return alpha && *alpha <= 0.0;
}

bool is_current_color(std::string_view text) { return lower(trimmed(text)) == "currentcolor"; }

// The length or the path data that a style has for one of kGeometry; empty: none that can be read.
std::string_view geometry_in(std::string_view name, std::string_view text) {
    if (!among(kGeometry, name)) return {};
    if (name != "d") return parse_length(text, 1.0) ? text : std::string_view{};
    const std::size_t begin = text.find_first_of("\"'");  // path("M0 0h9")
    const std::size_t end = text.find_last_of("\"'");
    return text.starts_with("path(") && begin < end ? text.substr(begin + 1, end - begin - 1)
                                                    : std::string_view{};
}

}  // namespace

bool sets_nothing(std::string_view value) { return says_inherit(value) || says_initial(value); }

std::optional<Property> find_property(std::string_view name) {
    const auto* row =
        std::find_if(kNames.begin(), kNames.end(), [&](const auto& r) { return r.first == name; });
    return row == kNames.end() ? std::nullopt : std::optional(row->second);
}

void Declarations::set(Property property, const Value& value) {
    std::optional<Value>& mine = values_.at(static_cast<std::size_t>(property));
    if (!mine || std::pair(value.weight, value.order) >= std::pair(mine->weight, mine->order)) mine = value;
}

void Declarations::set(Named& named, std::string_view name, const Value& value) {
    const auto [mine, fresh] = named.try_emplace(std::string(name), value);
    if (!fresh && std::pair(value.weight, value.order) >= std::pair(mine->second.weight, mine->second.order))
        mine->second = value;
}

void Declarations::set(Property property, std::string_view value, int weight, std::uint32_t order) {
    const Value one = weighed(value, weight, order);
    if (!one.text.empty()) set(property, one);
}

Declarations::Value Declarations::weighed(std::string_view value, int weight, std::uint32_t order) {
    value = trimmed(value);
    const std::size_t mark = value.rfind('!');
    if (mark != std::string_view::npos && is_word(trimmed(value.substr(mark + 1)))) {
        if (lower(trimmed(value.substr(mark + 1))) == "important") weight += kImportant;
        value = trimmed(value.substr(0, mark));
    }
    return {std::string(value), weight, order};
}

void Declarations::set_all(std::string_view list, int weight, std::uint32_t order) {
    each_declaration(list, [&](std::string_view one) {
        const std::size_t colon = one.find(':');
        if (colon == std::string_view::npos) return;
        const std::string_view name = trimmed(one.substr(0, colon));
        const std::string_view value = one.substr(colon + 1);
        if (name.starts_with("--")) return set(variables_, name, weighed(value, weight, order));
        const std::string word = lower(name);
        if (const auto property = find_property(word)) return set(*property, value, weight, order);
        if (among(kGeometry, word) || among(kNotRead, word))
            set(others_, word, weighed(value, weight, order));
    });
}

void Declarations::add(const Declarations& other) {
    for (std::size_t i = 0; i < kProperties; ++i) {
        if (other.values_.at(i)) set(static_cast<Property>(i), *other.values_.at(i));
    }
    for (const auto& [name, value] : other.variables_) set(variables_, name, value);
    for (const auto& [name, value] : other.others_) set(others_, name, value);
}

const std::string* Declarations::find(Property property) const {
    const std::optional<Value>& value = values_.at(static_cast<std::size_t>(property));
    return value ? &value->text : nullptr;
}

VariableTexts Declarations::variables() const {
    VariableTexts texts;
    for (const auto& [name, value] : variables_) texts.emplace_hint(texts.end(), name, value.text);
    return texts;
}

std::vector<std::pair<std::string_view, std::string_view>> Declarations::geometry() const {
    std::vector<std::pair<std::string_view, std::string_view>> found;
    for (const auto& [name, value] : others_) {
        const std::string_view text = geometry_in(name, value.text);
        if (!text.empty()) found.emplace_back(name, text);
    }
    return found;
}

std::vector<std::string_view> Declarations::not_read() const {
    constexpr std::array<std::string_view, 9> kNothing{"none", "auto", "view-box", "0",  "0px",
                                                       "0deg", "1",    "1 1",      "0 0"};
    const bool turns = find(Property::transform) != nullptr && find(Property::transform_origin) != nullptr;
    std::vector<std::string_view> found;
    for (const auto& [name, value] : others_) {
        const std::string word = lower(value.text);
        if (sets_nothing(word) || !geometry_in(name, value.text).empty()) continue;
        // It says of which box the percentages of an origin are.
        if ((name == "transform-box" && !turns) || among(kNothing, word)) continue;
        found.push_back(name);
    }
    return found;
}

std::vector<std::string> Declarations::put_in(const Variables& variables) {
    std::vector<std::string> not_set;
    for (auto& [name, value] : others_) value.text = variables.put_into(value.text).value_or("");
    for (std::size_t i = 0; i < kProperties; ++i) {
        std::optional<Value>& value = values_.at(i);
        if (!value || !has_variable(value->text)) continue;
        std::string missing;
        if (std::optional<std::string> text = variables.put_into(value->text, &missing)) {
            value->text = *std::move(text);
        } else if (static_cast<Property>(i) != Property::stroke) {
            value.reset();
            if (!missing.empty()) not_set.push_back(std::move(missing));
        }
    }
    return not_set;
}

void StyleSheet::add(std::string_view css) {
    const std::string text = without_comments(css);
    std::string_view rest = text;
    while (!rest.empty()) {
        const std::size_t open = rest.find_first_of("{;");
        if (open == std::string_view::npos) return;
        if (rest[open] == ';') {
            if (lower(trimmed(rest.substr(0, open))).starts_with("@import")) ++imports_;
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
    // Rules within rules.
    if (body.find('{') != std::string_view::npos) ++not_read_;
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
        matters = matters || !declarations.geometry().empty() || !declarations.not_read().empty();
        if (matters) ++not_read_;
    });
}

void StyleSheet::apply(std::string_view tag, std::string_view id, std::string_view classes, bool is_root,
                       Declarations& declarations) const {
    if (rules_.empty()) return;
    const auto take = [&](std::string_view selector) {
        const auto rule = rules_.find(selector);
        if (rule != rules_.end()) declarations.add(rule->second);
    };
    take("*");
    take(tag);
    if (is_root) take(kRoot);
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
        if (color && is_transparent(parts)) return {};
        return color ? Paint{Paint::Kind::color, *color} : Paint{Paint::Kind::other, {0, 0, 0}};
    }
    std::string_view plain = text;
    // #rgba, #rrggbbaa
    if (plain.starts_with('#') && (plain.size() == 5 || plain.size() == 9))
        plain = plain.substr(0, plain.size() == 5 ? 4 : 7);
    const auto color = parse_color(plain);
    const std::string_view alpha = text.substr(plain.size());
    if (color && (alpha == "0" || alpha == "00")) return {};
    return color ? Paint{Paint::Kind::color, *color} : Paint{Paint::Kind::other, {0, 0, 0}};
}

std::vector<std::string> Style::take(Declarations& declarations) {
    static const Style kInitial;  // the initial value of each property
    variables = variables.within(declarations.variables());
    std::vector<std::string> not_set = declarations.put_in(variables);
    const auto value = [&](Property property) -> const std::string* {
        const std::string* found = declarations.find(property);
        return found != nullptr && !says_inherit(*found) ? found : nullptr;
    };
    if (const auto* text = value(Property::color); text != nullptr && !is_current_color(*text))
        color = says_initial(*text) ? kInitial.color : parse_paint(*text);
    const auto* text_of_stroke = value(Property::stroke);
    if (text_of_stroke != nullptr && has_variable(*text_of_stroke) && stroke.kind != Paint::Kind::none) {
        std::string missing;
        if (!variables.put_into(*text_of_stroke, &missing) && !missing.empty()) not_set.push_back(missing);
    } else if (const auto* text = text_of_stroke) {
        stroke = says_initial(*text) ? kInitial.stroke : parse_paint(*text);
        stroke_text = *text;
        stroke_is_color = is_current_color(*text);
    }
    if (const auto* text = value(Property::fill)) {
        fill_written = !says_initial(*text);
        fill = fill_written ? parse_paint(*text) : kInitial.fill;
        fill_is_color = is_current_color(*text);
    }
    // It is the word that is handed down: each element has its own.
    if (stroke_is_color) stroke = color;
    if (fill_is_color) fill = color;
    if (const auto* text = value(Property::visibility)) visible = *text == "visible" || says_initial(*text);
    if (const auto* text = value(Property::dashes)) take_dashes(*text, *this);
    if (const auto* text = value(Property::width)) {
        const std::optional<double> length = says_initial(*text) ? kInitial.width : parse_length(*text, 1.0);
        if (length && *length >= 0.0) width = *length;
    }
    if (const auto* text = value(Property::fill_rule)) even_odd = *text == "evenodd";
    const auto share = [&](Property property) -> std::optional<double> {
        const auto* text = value(property);
        if (text == nullptr) return std::nullopt;
        const std::optional<double> length = says_initial(*text) ? 1.0 : parse_length(*text, 1.0);
        return length ? std::optional(std::clamp(*length, 0.0, 1.0)) : std::nullopt;
    };
    if (const auto own = share(Property::stroke_opacity)) stroke_opacity = *own;
    if (const auto own = share(Property::fill_opacity)) fill_opacity = *own;
    // What it is drawn in fades as well.
    if (const auto own = share(Property::opacity)) opacity *= *own;
    // Not inherited: an element that is not displayed is not looked into.
    const std::string* display = declarations.find(Property::display);
    displayed = display == nullptr || *display != "none";
    return not_set;
}

}  // namespace popup::drawing
