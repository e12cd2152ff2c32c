#include "input/xml/values.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string>
#include <utility>

#include "base/text/nearest.h"
#include "input/color.h"
#include "input/text.h"
#include "input/xml/encoding.h"
#include "input/xml/number.h"
#include "input/xml/units.h"

namespace popup::xml {
namespace {

// A point that is still to be given its numbers.
DesignPoint begun(const Node& node) {
    DesignPoint made;
    made.place = node.place();
    made.tag_text = node.start_tag();
    return made;
}

bool parts_numbers(char c) { return is_blank(c) || c == ',' || c == ';'; }

}  // namespace

TextRange Values::tight(const Text& text) const {
    std::string_view raw = source_.substr(text.raw.offset, text.raw.length);
    const std::string_view inner = trimmed(raw);
    return {static_cast<std::size_t>(inner.data() - source_.data()), inner.size()};
}

std::optional<double> Values::number(std::string_view text, std::string_view what, Place place) {
    const ParsedNumber parsed = parse_number(text);
    const auto wrong = [&](std::string_view why) -> Diagnostic& {
        return reporter_.error("bad-number", place,
                               fmt::format("{} is '{}', which {}", what, shown(trimmed(text)), why));
    };
    switch (parsed.fault) {
        case NumberFault::none:
            return parsed.value;
        case NumberFault::empty:
        case NumberFault::malformed: {
            Diagnostic& made = wrong("is not a number");
            if (const Unit* unit = unit_behind_number(text)) {
                made.hint(
                    fmt::format("write the number alone; units=\"{}\" in <popup> is the unit of all numbers",
                                unit->name));
            }
            break;
        }
        case NumberFault::comma:
            wrong("is not a number").hint("write a decimal point, not a comma");
            break;
        case NumberFault::hexadecimal:
            wrong("is not a decimal number");
            break;
        case NumberFault::not_finite:
            wrong("is not a finite number");
            break;
        case NumberFault::too_large:
            wrong("is too large a number");
            break;
    }
    return std::nullopt;
}

std::optional<double> Values::length(std::string_view text, std::string_view what, Place place) {
    const std::optional<double> value = number(text, what, place);
    if (!value) return std::nullopt;
    const double mm = *value * unit_.mm;
    if (std::abs(mm) <= kCoordinateLimit) return mm;
    reporter_.error("bad-number", place,
                    fmt::format("{} is {} {}, further out than {} mm", what, shown(trimmed(text)), unit_.name,
                                format_number(kCoordinateLimit)));
    return std::nullopt;
}

std::optional<double> Values::length(const Field& field) {
    const std::optional<Text> text = value_of(field, reporter_);
    return text ? length(text->decoded, field.word(), text->place) : std::nullopt;
}

std::optional<double> Values::number(const Field& field) {
    const std::optional<Text> text = value_of(field, reporter_);
    return text ? number(text->decoded, field.word(), text->place) : std::nullopt;
}

std::optional<Color> Values::color(const Field* field) {
    if (!field) return std::nullopt;
    const std::optional<Text> text = value_of(*field, reporter_);
    return text ? color(*text, field->word()) : std::nullopt;
}

std::optional<Color> Values::color(const Text& text, std::string_view what) {
    const std::optional<Color> color = parse_color(text.decoded);
    if (color) return color;
    Diagnostic& error =
        reporter_.error("bad-color", text.place,
                        fmt::format("{} is '{}', which is not a colour", what, shown(trimmed(text.decoded))));
    const std::string near = nearest_color_name(text.decoded);
    error.hint(near.empty() ? "write #rrggbb, r,g,b or a CSS colour name"
                            : fmt::format("perhaps '{}' is meant", near));
    return std::nullopt;
}

std::optional<int> Values::page(const Field* field, TextRange* range) {
    if (!field) return std::nullopt;
    const std::optional<Text> text = value_of(*field, reporter_);
    if (!text) return std::nullopt;
    const std::string_view digits = trimmed(text->decoded);
    // Older documents have no such names, and no other messages than before.
    if (is_id(digits) && (newer_ || is_page(digits))) {
        const auto named = named_page(*text, digits);
        if (named && range) *range = tight(*text);
        return named;
    }
    int page = -1;
    const auto [stop, error] = std::from_chars(digits.data(), digits.data() + digits.size(), page);
    if (error != std::errc{} || stop != digits.data() + digits.size() || page < 0 || page > kPageLimit) {
        reporter_
            .error("bad-page", text->place, fmt::format("'{}' is not the number of a page", shown(digits)))
            .hint(
                "page 0 is the base page; each v-fold or tent adds one, counted from 1 in the order of the "
                "list");
        return std::nullopt;
    }
    if (range) *range = tight(*text);
    return page;
}

bool Values::is_page(std::string_view name) const {
    return name == kBasePage || (pages_ != nullptr && pages_->contains(std::string(name)));
}

std::optional<int> Values::named_page(const Text& text, std::string_view name) {
    if (!newer_) {
        reporter_.warning("newer-element", text.place, "pages are numbers in version 2.0, and have no names")
            .hint("write version=\"3.0\"");
    }
    if (name == kBasePage) return 0;
    const auto found = pages_->find(std::string(name));
    if (found != pages_->end() && found->second > 0) return found->second;
    if (found != pages_->end()) {
        reporter_
            .error("bad-page", text.place,
                   fmt::format("\"{}\" is no page: it is cut from the page that it stands on", name))
            .hint("pages are those of glued elements, and the base page, which is 0");
        return std::nullopt;
    }
    const std::string near = page_like(name);
    reporter_
        .error("bad-page", text.place,
               fmt::format("there is no page '{}': no element up to here has that id", shown(name)))
        .hint(near.empty() ? "a page is a number, or the id of an earlier element that has a piece of its own"
                           : fmt::format("perhaps '{}' is meant", near));
    return std::nullopt;
}

// The page whose name is most like this one; empty: none is, or there are too many to look through.
std::string Values::page_like(std::string_view name) {
    constexpr std::size_t kMostNames = 2'000;
    constexpr int kMostTimes = 100;  // findings that are told
    if (pages_->size() > kMostNames || ++pages_missed_ > kMostTimes) return {};
    std::vector<std::string_view> names{kBasePage};
    for (const auto& [id, page] : *pages_) {
        if (page > 0) names.push_back(id);
    }
    std::sort(names.begin(), names.end());  // equally good ones are taken as they stand
    const std::vector<std::string> near = nearest(name, names, 1);
    return near.empty() ? std::string() : near.front();
}

std::vector<Values::Token> Values::tokens(const Text& text, std::size_t most) const {
    const std::string_view decoded = text.decoded;
    const std::string_view raw = source_.substr(text.raw.offset, text.raw.length);
    // As long as nothing was decoded, every byte stands for itself.
    const bool same = decoded.size() == raw.size();
    const std::vector<Offset> offsets = same ? std::vector<Offset>{} : decoded_offsets(raw, text.references);
    const auto raw_at = [&](std::size_t i) { return same ? i : std::size_t{offsets[i]}; };

    // An attribute's tokens stand where the attribute stands; those of a text, each at its own place.
    PlaceCounter counter(raw.substr(std::min(raw.find_first_not_of(" \t\r\n"), raw.size())));
    const std::size_t counted_from = raw.size() - counter.size();
    std::vector<Token> out;
    for (std::size_t at = 0; at < decoded.size() && out.size() <= most;) {
        if (parts_numbers(decoded[at])) {
            ++at;
            continue;
        }
        const std::size_t begin = at;
        while (at < decoded.size() && !parts_numbers(decoded[at])) ++at;
        Token token{decoded.substr(begin, at - begin),
                    {text.raw.offset + raw_at(begin), raw_at(at) - raw_at(begin)},
                    text.place};
        if (!text.attribute && raw_at(begin) >= counted_from) {
            const Place step = counter.at(raw_at(begin) - counted_from);
            token.place = step.line == 1 ? Place{text.place.line, text.place.column + step.column - 1}
                                         : Place{text.place.line + step.line - 1, step.column};
        }
        out.push_back(token);
    }
    return out;
}

DesignPoint Values::point_of(const Token& x, const Token& y) {
    DesignPoint made;
    made.place = x.place;
    made.x_text = x.raw;
    made.y_text = y.raw;
    made.at.x = length(x.decoded, "x", x.place).value_or(0.0);
    made.at.y = length(y.decoded, "y", y.place).value_or(0.0);
    return made;
}

std::optional<DesignPoint> Values::point_of(const Text& text, std::string_view what) {
    constexpr std::size_t kMost = 9;
    const std::vector<Token> numbers = tokens(text, kMost);
    if (numbers.size() == 2) return point_of(numbers[0], numbers[1]);
    Diagnostic& error = reporter_.error(
        "bad-point", text.place,
        fmt::format("{} is '{}', {} number{} where x and y are expected", what, shown(trimmed(text.decoded)),
                    numbers.size(), numbers.size() == 1 ? "" : "s"));
    if (numbers.size() == 4) error.hint("write decimal points, not commas");
    return std::nullopt;
}

// What nearly all points are, of which documents have the most: <point x="1" y="2"/>, perhaps with a page.
// nullopt: it is written in another way, and names have to be looked up.
std::optional<DesignPoint> Values::plain_point(Node node, Name context) {
    std::array<Attribute, 3> room;
    Field x;
    Field y;
    Field on;
    for (const Attribute& one : node.few_attributes(room)) {
        const auto is = [&](Field& field, Name name, std::string_view spelling) {
            if (one.name != spelling || field.name == name) return false;
            field = {name, one.place, one.value, {}, {}};
            return true;
        };
        if (is(x, Name::x, "x") || is(y, Name::y, "y") ||
            (context == Name::point && is(on, Name::page, "page")))
            continue;
        return std::nullopt;
    }
    if (x.name == Name::unknown || y.name == Name::unknown) return std::nullopt;
    DesignPoint made = begun(node);
    if (on.name == Name::page) made.page = page(&on, &made.page_text);
    read_coordinate(x, made.at.x, made.x_text);
    read_coordinate(y, made.at.y, made.y_text);
    return made;
}

void Values::read_coordinate(const Field& field, double& value, TextRange& range) {
    const std::optional<Text> text = value_of(field, reporter_);
    if (!text) return;
    value = length(text->decoded, field.name == Name::x ? "x" : "y", text->place).value_or(0.0);
    range = tight(*text);
}

DesignPoint Values::point(Node node, Name context) {
    if (auto plain = plain_point(node, context)) return *plain;
    Fields fields(node, context, reporter_);
    DesignPoint made = begun(node);
    made.page = page(fields.find(Name::page), &made.page_text);

    const Field* x = fields.find(Name::x);
    const Field* y = fields.find(Name::y);
    if (x || y) {
        fields.refuse_text();
        for (const Name name : {Name::x, Name::y}) {
            const Field* field = fields.find(name);
            if (!field) {
                reporter_.error("missing-value", node.place(),
                                fmt::format("this {} has no {}", canonical(context), canonical(name)));
                continue;
            }
            read_coordinate(*field, name == Name::x ? made.at.x : made.at.y,
                            name == Name::x ? made.x_text : made.y_text);
        }
        return made;
    }

    std::vector<Text> texts(fields.texts().begin(), fields.texts().end());
    if (texts.size() > 1) {
        reporter_.in_parts(canonical(context), texts);
        return made;
    }
    if (const Field* value = fields.find(Name::value)) {
        if (const std::optional<Text> text = value_of(*value, reporter_)) texts.push_back(*text);
    }
    if (texts.empty()) {
        reporter_.error("missing-value", node.place(),
                        fmt::format("this {} has no x and no y", canonical(context)));
        return made;
    }
    if (texts.size() > 1) {
        reporter_.twice(canonical(context), texts[1].place, texts[0].place);
        return made;
    }
    if (const auto numbers = point_of(texts.front(), canonical(context))) {
        made.at = numbers->at;
        made.x_text = numbers->x_text;
        made.y_text = numbers->y_text;
    }
    return made;
}

std::optional<DesignPoint> Values::point(const Field& field) {
    if (field.node) return point(field.node, field.name);
    return point_of(field.text, field.word());
}

bool Values::count_point(Place place) {
    if (++points_ <= kPointsLimit) return true;
    if (points_ == kPointsLimit + 1) {
        reporter_.error("document-too-large", place,
                        fmt::format("the document has more than {} points", kPointsLimit));
    }
    return false;
}

void Values::points(const Text& text, std::vector<DesignPoint>& out) {
    const std::vector<Token> numbers = tokens(text, 2 * kPointsLimit + 1);
    if (numbers.size() % 2 != 0 && numbers.size() <= 2 * kPointsLimit) {
        reporter_.error(
            "bad-point", text.place,
            fmt::format("this list of points has {} numbers, and each point takes two", numbers.size()));
    }
    for (std::size_t i = 0; i + 1 < numbers.size() && count_point(numbers[i].place); i += 2) {
        out.push_back(point_of(numbers[i], numbers[i + 1]));
    }
}

void Values::points(const Fields& fields, std::vector<DesignPoint>& out) {
    for (const Node& node : fields.repeated()) {
        if (!count_point(node.place())) return;
        out.push_back(point(node, Name::point));
    }
    for (const Text& text : fields.texts()) {
        // Words between elements are a slip, not a list.
        if (fields.repeated().empty()) {
            points(text, out);
        } else {
            reporter_.unknown_text(fields.context(), text);
        }
    }
}

}  // namespace popup::xml
