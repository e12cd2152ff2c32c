#include "repair/short_numbers.h"

#include <charconv>
#include <cmath>
#include <optional>
#include <variant>
#include <vector>

#include "base/text/numbers.h"
#include "popup/mechanism.h"

namespace popup {
namespace {

constexpr double kRoundedOffMm = 0.005;
constexpr double kSlack = 1.0 + 1e-9;  // 0.5 · 0.01 is no double

class Shortener {
 public:
    Shortener(const Design& design, std::string_view text) : unit_mm_(design.unit.mm), text_(text) {}

    void point(DesignPoint& one) const {
        if (!one.changed) return;
        one.at.x = shortened(one.at.x, one.x_text);
        one.at.y = shortened(one.at.y, one.y_text);
    }

    void structure(Structure& one, int decimals) {
        decimals_ = decimals;
        for (DesignPoint& p : one.points) point(p);
        point(one.fold.begin);
        point(one.fold.end);
        if (one.plate) point(one.plate->at);
        const ElementInfo* info = find_element(one.type);
        for (std::size_t i = 0; i < one.arguments.size(); ++i) {
            Argument& argument = one.arguments[i];
            if (!argument.changed) continue;
            if (auto* points = std::get_if<std::vector<DesignPoint>>(&argument.value)) {
                for (DesignPoint& p : *points) point(p);
            } else if (auto* value = std::get_if<double>(&argument.value)) {
                const bool is_length = info != nullptr && info->parameters[i].kind == ParameterKind::length;
                if (is_length) *value = shortened(*value, argument.text);
            }
        }
    }

 private:
    [[nodiscard]] double shortened(double mm, TextRange written) const {
        const double value = mm / unit_mm_;
        if (written.present()) {
            const std::string_view digits = text_.substr(written.offset, written.length);
            double old = 0.0;
            const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), old);
            if (read.ec == std::errc() && rounded(old, kMostDecimals) == rounded(value, kMostDecimals))
                return mm;
        }
        return rounded(value, decimals_) * unit_mm_;
    }

    double unit_mm_;
    std::string_view text_;
    int decimals_ = kMostDecimals;
};

}  // namespace

int short_decimals(const Unit& unit) {
    int decimals = 0;
    for (double step = unit.mm; 0.5 * step > kRoundedOffMm * kSlack && decimals < kMostDecimals; step *= 0.1)
        ++decimals;
    return decimals;
}

void shorten_numbers(Design& design, std::string_view text, const DecimalsOf& decimals) {
    Shortener shortener(design, text);
    for (Structure& one : design.structures) {
        if (one.dropped || one.added) continue;
        const auto own = decimals.find(one.id);
        shortener.structure(one, own == decimals.end() ? short_decimals(design.unit) : own->second);
    }
}

}  // namespace popup
