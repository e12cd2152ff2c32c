#include "output/pdf_pages.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <string>
#include <string_view>
#include <utility>

namespace popup {

namespace {

constexpr double kLargestPageMm = 5080.0;

bool refuse(std::string_view what, double width_mm, double height_mm, std::string hint,
            Diagnostics& diagnostics) {
    diagnostics
        .error(
            "pdf-page-size", {},
            fmt::format("{} of {:.1f} × {:.1f} mm is too large for a PDF page, which has at most 5080 mm a "
                        "side",
                        what, width_mm, height_mm))
        .hint(std::move(hint));
    return false;
}

}  // namespace

bool fits_pages(const Layout& layout, Diagnostics& diagnostics) {
    for (const LayoutSheet& sheet : layout.sheets) {
        if (std::max(sheet.width_mm, sheet.height_mm) <= kLargestPageMm) continue;
        return refuse("a sheet", sheet.width_mm, sheet.height_mm,
                      "choose a smaller sheet with --sheet, or write SVG", diagnostics);
    }
    return true;
}

bool fits_page(double width_mm, double height_mm, Diagnostics& diagnostics) {
    if (std::max(width_mm, height_mm) <= kLargestPageMm) return true;
    return refuse("paper", width_mm, height_mm, "give a smaller paper with --tile", diagnostics);
}

std::optional<std::tm> source_date() {
    const char* text = std::getenv("SOURCE_DATE_EPOCH");
    if (text == nullptr) return std::nullopt;
    const std::string_view digits = text;
    long long seconds = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), seconds);
    constexpr long long kYear10000 = 253402300800;
    if (error != std::errc() || end != digits.data() + digits.size()) return std::nullopt;
    if (seconds < 0 || seconds >= kYear10000) return std::nullopt;
    const auto when = static_cast<std::time_t>(seconds);
    std::tm utc{};
    gmtime_r(&when, &utc);
    return utc;
}

}  // namespace popup
