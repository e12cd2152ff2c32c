#include "input/drawing/size.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "base/text/number_scanner.h"
#include "input/text.h"

namespace popup::drawing {
namespace {

constexpr std::array<std::pair<std::string_view, double>, 9> kUnits{{
    {"", 1.0},
    {"px", 1.0},
    {"mm", 96.0 / 25.4},
    {"cm", 960.0 / 25.4},
    {"in", 96.0},
    {"pt", 96.0 / 72.0},
    {"pc", 16.0},
    {"q", 24.0 / 25.4},
    {"%", 0.0},
}};

// The row of the unit behind the number, and the number.
std::pair<const std::pair<std::string_view, double>*, double> split_length(std::string_view text) {
    NumberScanner scanner(trimmed(text));
    const auto number = scanner.number();
    if (!number) return {nullptr, 0.0};
    const std::string unit = lower(scanner.rest());
    const auto* row =
        std::find_if(kUnits.begin(), kUnits.end(), [&](const auto& r) { return r.first == unit; });
    return {row == kUnits.end() ? nullptr : row, *number};
}

}  // namespace

std::optional<double> parse_length(std::string_view text, double whole) {
    const auto [unit, number] = split_length(text);
    if (unit == nullptr) return std::nullopt;
    const double pixels = number * (unit->first == "%" ? 0.01 * whole : unit->second);
    return std::isfinite(pixels) ? std::optional(pixels) : std::nullopt;
}

bool has_real_unit(std::string_view text) {
    const auto* unit = split_length(text).first;
    return unit != nullptr && !unit->first.empty() && unit->first != "px" && unit->first != "%";
}

bool is_by_illustrator(std::string_view text) {
    return text.substr(0, text.find("<svg")).find("Generator: Adobe Illustrator") != std::string_view::npos;
}

void tell_size(Place place, Vec2 mm, const SizeSaid& said, Diagnostics& diagnostics) {
    const std::string in_points =
        said.by_illustrator
            ? fmt::format(
                  "Adobe Illustrator, which wrote it, counts 72 to the inch: --scale 1.333333 makes "
                  "it {:.2f} × {:.2f} mm",
                  mm.x * 96.0 / 72.0, mm.y * 96.0 / 72.0)
            : std::string("if the program that made it counts 72 to the inch, --scale 1.333333 is right");
    if (!said.sized) {
        diagnostics
            .warning("size-missing", place,
                     mm.x > 0.0
                         ? fmt::format("the drawing does not say how large it is; with a 96th of an inch for "
                                       "its unit it is {:.2f} × {:.2f} mm",
                                       mm.x, mm.y)
                         : std::string("the drawing does not say how large it is; its unit is taken for a "
                                       "96th of an inch"))
            .hint("write its width and height with their unit, such as width=\"210mm\"")
            .hint(in_points);
    } else if (!said.has_unit) {
        diagnostics
            .remark(
                "size-in-pixels", place,
                fmt::format("the drawing's size is in pixels, taken for 96 to the inch: {:.2f} × {:.2f} mm",
                            mm.x, mm.y))
            .hint("write it with a unit, such as width=\"210mm\", if that is not what it should be")
            .hint(in_points);
    }
}

std::optional<ViewBox> parse_view_box(std::string_view text) {
    const auto numbers = parse_numbers(text);
    if (!numbers || numbers->size() != 4) return std::nullopt;
    const ViewBox box{{(*numbers)[0], (*numbers)[1]}, (*numbers)[2], (*numbers)[3]};
    const bool finite = std::isfinite(box.corner.x) && std::isfinite(box.corner.y) &&
                        std::isfinite(box.width) && std::isfinite(box.height);
    return finite && box.width > 0.0 && box.height > 0.0 ? std::optional(box) : std::nullopt;
}

Affine fitted(const ViewBox& box, double width, double height, std::string_view preserve) {
    double x_scale = width / box.width;
    double y_scale = height / box.height;
    double x_share = 0.5;
    double y_share = 0.5;
    if (preserve.find("none") == std::string_view::npos) {
        const bool slice = preserve.find("slice") != std::string_view::npos;
        x_scale = y_scale = slice ? std::max(x_scale, y_scale) : std::min(x_scale, y_scale);
        const auto share = [&](std::string_view least, std::string_view most) {
            if (preserve.find(least) != std::string_view::npos) return 0.0;
            return preserve.find(most) != std::string_view::npos ? 1.0 : 0.5;
        };
        x_share = share("xMin", "xMax");
        y_share = share("YMin", "YMax");
    }
    return {x_scale,
            0.0,
            0.0,
            y_scale,
            x_share * (width - x_scale * box.width) - x_scale * box.corner.x,
            y_share * (height - y_scale * box.height) - y_scale * box.corner.y};
}

}  // namespace popup::drawing
