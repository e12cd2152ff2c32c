// Papers, and what the command line says of sheets and turns.
#include <charconv>
#include <cmath>

#include "popup/layout.h"

namespace popup {
namespace {

bool same_word(std::string_view a, std::string_view b) {
    if (a.size() != b.size()) return false;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const char c = a[i] >= 'A' && a[i] <= 'Z' ? static_cast<char>(a[i] - 'A' + 'a') : a[i];
        if (c != b[i]) return false;
    }
    return true;
}

// Takes a positive number off the front of the text.
bool take_number(std::string_view& text, double& value) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || !std::isfinite(value) || value <= 0.0) return false;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    return true;
}

}  // namespace

std::vector<Paper> const& paper_table() {
    static const std::vector<Paper> papers{
        {"a6", 105.0, 148.0, false},
        {"a5", 148.0, 210.0, false},
        {"letter", 215.9, 279.4, true, true},
        {"a4", 210.0, 297.0},
        {"legal", 215.9, 355.6, false, true},
        {"tabloid", 279.4, 431.8, true, true},
        {"a3", 297.0, 420.0},
        {"a2", 420.0, 594.0},
        {"a1", 594.0, 841.0},
        {"a0", 841.0, 1189.0},
    };
    return papers;
}

std::vector<Paper> papers_of(PaperFamily family) {
    std::vector<Paper> papers;
    for (const Paper& paper : paper_table()) {
        const bool small = paper.name == "a4" || paper.name == "a3";
        if (!paper.automatic) continue;
        if (family == PaperFamily::iso && paper.american) continue;
        if (family == PaperFamily::us && small) continue;
        papers.push_back(paper);
    }
    return papers;
}

PaperFamily papers_for(UnitSystem units) {
    switch (units) {
        case UnitSystem::metric:
            return PaperFamily::iso;
        case UnitSystem::inches:
            return PaperFamily::us;
        case UnitSystem::unknown:
            break;
    }
    return PaperFamily::any;
}

std::optional<SheetChoice> parse_sheet(std::string_view text) {
    if (same_word(text, "auto")) return SheetChoice{};
    for (const Paper& paper : paper_table()) {
        if (same_word(text, paper.name))
            return SheetChoice{std::string(paper.name), paper.width_mm, paper.height_mm};
    }
    constexpr double kLongestSideMm = 1e6;
    SheetChoice choice{"", 0.0, 0.0};
    if (!take_number(text, choice.width_mm)) return std::nullopt;
    if (text.empty() || (text[0] != 'x' && text[0] != 'X')) return std::nullopt;
    text.remove_prefix(1);
    if (!take_number(text, choice.height_mm)) return std::nullopt;
    double unit = 1.0;
    if (same_word(text, "in")) {
        unit = 25.4;
    } else if (!text.empty() && !same_word(text, "mm")) {
        return std::nullopt;
    }
    choice.width_mm *= unit;
    choice.height_mm *= unit;
    if (choice.width_mm > kLongestSideMm || choice.height_mm > kLongestSideMm) return std::nullopt;
    return choice;
}

std::optional<std::vector<StockRow>> parse_stock(std::string_view text) {
    std::vector<StockRow> stock;
    for (;;) {
        const std::size_t end = text.find(',');
        std::string_view row = text.substr(0, end);
        StockRow& next = stock.emplace_back();
        if (const std::size_t colon = row.find(':'); colon != std::string_view::npos) {
            const std::string_view count = row.substr(colon + 1);
            const auto [stop, error] = std::from_chars(count.data(), count.data() + count.size(), next.count);
            if (error != std::errc{} || stop != count.data() + count.size() || next.count < 1)
                return std::nullopt;
            row = row.substr(0, colon);
        }
        const std::optional<SheetChoice> size = parse_sheet(row);
        if (!size || size->name == "auto") return std::nullopt;
        next.size = *size;
        if (end == std::string_view::npos) return stock;
        text.remove_prefix(end + 1);
    }
}

std::optional<Rotation> parse_rotation(std::string_view text) {
    if (same_word(text, "none")) return Rotation{1};
    if (same_word(text, "180")) return Rotation{2};
    if (same_word(text, "90")) return Rotation{4};
    if (same_word(text, "any")) return Rotation{0};
    int count = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
    if (error != std::errc{} || end != text.data() + text.size() || count < 1) return std::nullopt;
    return Rotation{count};
}

}  // namespace popup
