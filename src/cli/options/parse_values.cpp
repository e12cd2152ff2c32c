// Values of options: numbers, lengths, angles. No locale has a say in how they are read.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>
#include <utility>

#include "base/text/nearest.h"
#include "cli/options/options.h"

namespace popup::cli {
namespace {

std::vector<std::string_view> split(std::string_view text, char separator) {
    std::vector<std::string_view> parts;
    for (;;) {
        const std::size_t end = text.find(separator);
        parts.push_back(text.substr(0, end));
        if (end == std::string_view::npos) return parts;
        text.remove_prefix(end + 1);
    }
}

}  // namespace

std::optional<double> parse_number(std::string_view text) {
    if (text.starts_with('+')) text.remove_prefix(1);
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
        return std::nullopt;
    return value;
}

std::optional<Length> parse_length(std::string_view text) {
    struct Unit {
        std::string_view name;
        double mm;
    };
    static constexpr Unit kUnits[] = {{"mm", 1.0}, {"cm", 10.0}, {"in", 25.4}, {"pt", 25.4 / 72.0}};
    double scale = 1.0;
    for (const Unit& unit : kUnits) {
        if (!text.ends_with(unit.name)) continue;
        text.remove_suffix(unit.name.size());
        scale = unit.mm;
        break;
    }
    const std::optional<double> value = parse_number(text);
    if (!value) return std::nullopt;
    return Length::millimetres(*value * scale);
}

std::optional<std::chrono::milliseconds> parse_time(std::string_view text) {
    if (text == "0") return std::chrono::milliseconds(0);
    constexpr double kMostSeconds = 3'600'000.0;
    for (const auto& [unit, seconds] : {std::pair('s', 1.0), std::pair('m', 60.0), std::pair('h', 3600.0)}) {
        if (!text.ends_with(unit)) continue;
        const std::optional<double> value = parse_number(text.substr(0, text.size() - 1));
        if (!value || *value < 0.0 || *value * seconds > kMostSeconds) return std::nullopt;
        return std::chrono::milliseconds(std::llround(1000.0 * *value * seconds));
    }
    return std::nullopt;
}

std::optional<PieceRule> parse_turn_rule(std::string_view text) {
    PieceRule rule;
    if (const std::size_t equals = text.rfind('='); equals != std::string_view::npos) {
        rule.piece = text.substr(0, equals);
        if (rule.piece.empty()) return std::nullopt;
        text.remove_prefix(equals + 1);
    }
    rule.rotation = parse_rotation(text);
    if (!rule.rotation) return std::nullopt;
    return rule;
}

namespace {

// What follows the last `mark` of the text, as a whole number from 1; takes both off. True when there is no
// mark; false when what follows is no such number.
bool take_ordinal(std::string_view& text, char mark, int& number) {
    const std::size_t at = text.rfind(mark);
    if (at == std::string_view::npos) return true;
    const std::optional<double> value = parse_number(text.substr(at + 1));
    if (!value || *value < 1.0 || *value > 1e6 || *value != std::floor(*value)) return false;
    number = static_cast<int>(*value) - 1;
    text = text.substr(0, at);
    return true;
}

}  // namespace

std::optional<PieceRule> parse_lock_rule(std::string_view text) {
    const std::size_t equals = text.rfind('=');
    if (equals == std::string_view::npos) return std::nullopt;
    std::string_view name = text.substr(0, equals);
    std::string_view place = text.substr(equals + 1);
    PieceRule rule;
    rule.lock.emplace();
    if (!take_ordinal(name, '#', rule.copy) || !take_ordinal(place, '@', rule.lock->sheet))
        return std::nullopt;
    rule.piece = name;
    const std::vector<std::string_view> parts = split(place, ',');
    if (rule.piece.empty() || parts.size() < 2 || parts.size() > 3) return std::nullopt;
    const std::optional<Length> x = parse_length(parts[0]);
    const std::optional<Length> y = parse_length(parts[1]);
    const std::optional<double> turn = parts.size() == 3 ? parse_number(parts[2]) : 0.0;
    constexpr double kFurthestLockMm = 1e6;
    if (!x || !y || !turn || std::abs(x->mm) > kFurthestLockMm || std::abs(y->mm) > kFurthestLockMm ||
        std::abs(*turn) > 360.0) {
        return std::nullopt;
    }
    rule.lock->offset = {x->mm, y->mm};
    rule.lock->angle = Angle::degrees(*turn < 0.0 ? *turn + 360.0 : *turn == 360.0 ? 0.0 : *turn);
    return rule;
}

namespace {

struct AngleRange {
    double first = 0.0, last = 0.0, step = 0.0;  // degrees
    [[nodiscard]] double count() const { return std::floor((last - first) / step + 1e-9) + 1.0; }
};

std::optional<AngleRange> parse_range(std::string_view text) {
    const std::vector<std::string_view> parts = split(text, ':');
    if (parts.size() != 3) return std::nullopt;
    const auto first = parse_number(parts[0]);
    const auto last = parse_number(parts[1]);
    const auto step = parse_number(parts[2]);
    if (!first || !last || !step || *first > *last || *last > 180.0 || *step <= 0.0) return std::nullopt;
    return AngleRange{*first, *last, *step};
}

}  // namespace

double count_angles(std::string_view text) {
    const std::optional<AngleRange> range = parse_range(text);
    return range ? range->count() : 0.0;
}

std::optional<std::vector<Angle>> parse_angles(std::string_view text) {
    std::vector<double> degrees;
    if (text.find(':') != std::string_view::npos) {
        const std::optional<AngleRange> range = parse_range(text);
        if (!range || !(range->count() <= kMostAngles)) return std::nullopt;
        for (int i = 0; i < static_cast<int>(range->count()); ++i)
            degrees.push_back(std::min(range->first + i * range->step, range->last));
    } else {
        for (const std::string_view part : split(text, ',')) {
            const auto value = parse_number(part);
            if (!value) return std::nullopt;
            degrees.push_back(*value);
        }
    }
    std::sort(degrees.begin(), degrees.end());
    degrees.erase(std::unique(degrees.begin(), degrees.end()), degrees.end());
    if (degrees.front() < 0.0 || degrees.back() > 180.0) return std::nullopt;
    std::vector<Angle> angles;
    angles.reserve(degrees.size());
    for (const double value : degrees) angles.push_back(Angle::degrees(value + 0.0));
    return angles;
}

double number_option(std::string_view option, std::string_view text, double least, double most) {
    const std::optional<double> value = parse_number(text);
    if (!value || *value < least || *value > most) {
        throw UsageError(
            fmt::format("{} takes a number from {} to {}, not \"{}\"", option, least, most, text));
    }
    return *value;
}

std::vector<std::string> did_you_mean(std::string_view word,
                                      const std::vector<std::string_view>& candidates) {
    const std::vector<std::string> names = nearest(word, candidates);
    if (names.empty()) return {};
    std::string text = "did you mean ";
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (i > 0) text += i + 1 == names.size() ? " or " : ", ";
        text += names[i];
    }
    return {text + "?"};
}

}  // namespace popup::cli
