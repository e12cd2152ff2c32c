#include "output/sheet_legend.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>

#include "base/nth.h"
#include "base/text/utf8.h"
#include "fabrication/broken_score.h"

namespace popup {
namespace {

constexpr double kRowMm = 5.0;
constexpr double kPadMm = 2.5;
constexpr double kSampleMm = 14.0;  // how long the lines are that show how lines look
constexpr double kTextAtMm = kPadMm + kSampleMm + 2.5;
constexpr double kBarMm = 50.0;
constexpr double kLegendFrameMm = 0.15;
constexpr double kRoundLegendMm = 2.0;
constexpr double kCellMm = 2.0;
constexpr std::size_t kLongestTitle = 60;  // characters
constexpr Color kFrame{0x7a, 0x7a, 0x7a};

// How wide the characters of ASCII are in DejaVu Sans, whose capitals are 1493 high.
constexpr std::array<std::uint16_t, 95> kAdvances{
    651,  821,  942,  1716, 1303, 1946, 1597, 563,  799,  799,  1024, 1716, 651,  739,  651,  690,
    1303, 1303, 1303, 1303, 1303, 1303, 1303, 1303, 1303, 1303, 690,  690,  1716, 1716, 1716, 1087,
    2048, 1401, 1405, 1430, 1577, 1294, 1178, 1587, 1540, 604,  604,  1343, 1141, 1767, 1532, 1612,
    1235, 1612, 1423, 1300, 1251, 1499, 1401, 2025, 1403, 1251, 1403, 799,  690,  799,  1716, 1024,
    1024, 1255, 1300, 1126, 1300, 1260, 721,  1300, 1298, 569,  569,  1186, 569,  1995, 1298, 1253,
    1300, 1300, 842,  1067, 803,  1298, 1212, 1675, 1212, 1212, 1075, 1303, 690,  1303, 1716,
};

double width_of(std::string_view text) {
    constexpr double kCapitals = 1493.0;
    constexpr double kOther = 1400.0;
    double sum = 0.0;
    while (!text.empty()) {
        const Character one = first_character(text);
        text.remove_prefix(one.bytes);
        const bool known = one.code >= U' ' && one.code <= U'~';
        sum += known ? kAdvances.at(static_cast<std::size_t>(one.code - U' ')) : kOther;
    }
    return kLegendTextMm * sum / kCapitals;
}

std::string shortened(std::string_view text) {
    std::string kept;
    for (std::size_t i = 0; i < kLongestTitle && !text.empty(); ++i) {
        const std::size_t bytes = first_character(text).bytes;
        kept += text.substr(0, bytes);
        text.remove_prefix(bytes);
    }
    return text.empty() ? kept : kept + "...";
}

// What stands in one row: how the line looks, if one is shown, and what it is.
struct Row {
    enum class Sample { none, line, target, bar };
    Sample sample = Sample::none;
    Operation operation = Operation::outer_cut;
    std::string text;
};

std::vector<Row> rows_of(const SheetDrawing& drawing, const Layout& layout, int sheet) {
    std::array<bool, kOperations.size()> drawn{};
    for (const SheetShape& shape : drawing.shapes) nth(drawn, shape.operation) = true;
    const std::string title =
        shortened(layout_title(layout)) + fmt::format(", sheet {} of {}", sheet + 1, layout.sheets.size());
    std::vector<Row> rows{{Row::Sample::none, {}, title}, {Row::Sample::none, {}, "this side up"}};
    const auto line = [&](Operation operation, std::string_view text) {
        if (nth(drawn, operation)) rows.push_back({Row::Sample::line, operation, std::string(text)});
    };
    // Slits and cuts of holes look like outer cuts where people cut.
    const auto cut = std::find_if(kOperations.rbegin(), kOperations.rend(), [&](Operation operation) {
        return is_cut(operation) && nth(drawn, operation);
    });
    if (cut != kOperations.rend()) line(*cut, "cut");
    line(Operation::valley, "valley fold: towards you");
    line(Operation::mountain, "mountain fold: away from you");
    line(Operation::seam, "fold of a glue tab");
    line(Operation::perforation, "perforation: fold here");
    if (nth(drawn, Operation::glue))
        rows.push_back({Row::Sample::target, Operation::glue, "glue the tab with the same number here"});
    rows.push_back({Row::Sample::bar, Operation::legend, fmt::format("{:g} mm: print at 100 %", kBarMm)});
    return rows;
}

double width_of(const Row& row) {
    const double text = width_of(row.text);
    switch (row.sample) {
        case Row::Sample::none:
            return kPadMm + text + kPadMm;
        case Row::Sample::line:
        case Row::Sample::target:
            return kTextAtMm + text + kPadMm;
        case Row::Sample::bar:
            return kPadMm + kBarMm + kPadMm + text + kPadMm;
    }
    return 0.0;
}

// Which cells of a sheet are free of pieces and margins.
class FreeSpace {
 public:
    FreeSpace(const LayoutSheet& sheet, double margin) {
        constexpr double kMostCells = 600.0;
        cell_ = std::max(kCellMm, std::max(sheet.width_mm, sheet.height_mm) / kMostCells);
        origin_ = {margin, margin};
        columns_ = static_cast<int>(std::floor((sheet.width_mm - 2.0 * margin) / cell_));
        rows_ = static_cast<int>(std::floor((sheet.height_mm - 2.0 * margin) / cell_));
        columns_ = std::max(columns_, 0);
        rows_ = std::max(rows_, 0);
        taken_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), 0);
    }

    // All that the outline goes round, holes too.
    void take(std::span<const Vec2> outline) {
        std::vector<std::vector<double>> crossings(static_cast<std::size_t>(rows_));
        for (std::size_t i = 0; i < outline.size(); ++i) {
            const Vec2 a = in_cells(outline[i]);
            const Vec2 b = in_cells(outline[(i + 1) % outline.size()]);
            const int first = row_of(std::min(a.y, b.y));
            const int last = row_of(std::max(a.y, b.y));
            for (int row = std::max(first, 0); row <= std::min(last, rows_ - 1); ++row) {
                const auto x_at = [&](double y) {
                    return a.y == b.y ? a.x : lerp(a, b, std::clamp((y - a.y) / (b.y - a.y), 0.0, 1.0)).x;
                };
                const bool level = a.y == b.y;
                const double x0 = level ? a.x : x_at(row);
                const double x1 = level ? b.x : x_at(row + 1.0);
                fill(row, std::min(x0, x1), std::max(x0, x1));
                const double middle = row + 0.5;
                if ((a.y > middle) != (b.y > middle)) nth(crossings, row).push_back(x_at(middle));
            }
        }
        for (int row = 0; row < rows_; ++row) {
            std::vector<double>& xs = nth(crossings, row);
            std::sort(xs.begin(), xs.end());
            for (std::size_t i = 0; i + 1 < xs.size(); i += 2) fill(row, xs[i], xs[i + 1]);
        }
    }

    // The lower left corner of the lowest, then leftmost place for a box of this size.
    [[nodiscard]] std::optional<Vec2> place_for(double width, double height) const {
        const int wide = static_cast<int>(std::ceil(width / cell_));
        const int high = static_cast<int>(std::ceil(height / cell_));
        if (wide > columns_ || high > rows_) return std::nullopt;
        // Of each cell, how many are taken below and left of its upper right corner.
        const auto at = [this](int row, int column) {
            return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_ + 1) +
                   static_cast<std::size_t>(column);
        };
        std::vector<int> sums(static_cast<std::size_t>(rows_ + 1) * static_cast<std::size_t>(columns_ + 1));
        for (int row = 0; row < rows_; ++row) {
            for (int column = 0; column < columns_; ++column) {
                sums[at(row + 1, column + 1)] = taken_[cell(row, column)] + sums[at(row, column + 1)] +
                                                sums[at(row + 1, column)] - sums[at(row, column)];
            }
        }
        const int around = static_cast<int>(std::ceil(kRoundLegendMm / cell_));
        for (int row = 0; row + high <= rows_; ++row) {
            for (int column = 0; column + wide <= columns_; ++column) {
                const int low = std::max(row - around, 0);
                const int left = std::max(column - around, 0);
                const int top = std::min(row + high + around, rows_);
                const int right = std::min(column + wide + around, columns_);
                if (sums[at(top, right)] - sums[at(low, right)] - sums[at(top, left)] + sums[at(low, left)] ==
                    0)
                    return origin_ + cell_ * Vec2{static_cast<double>(column), static_cast<double>(row)};
            }
        }
        return std::nullopt;
    }

 private:
    [[nodiscard]] Vec2 in_cells(Vec2 p) const { return (1.0 / cell_) * (p - origin_); }
    static int row_of(double y) { return static_cast<int>(std::floor(std::clamp(y, -1e6, 1e6))); }
    [[nodiscard]] std::size_t cell(int row, int column) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
               static_cast<std::size_t>(column);
    }
    // A hair of room, so that rounding decides nothing.
    void fill(int row, double from, double to) {
        constexpr double kHair = 1e-6;
        const int first = std::max(row_of(from - kHair), 0);
        const int last = std::min(row_of(to + kHair), columns_ - 1);
        for (int column = first; column <= last; ++column) taken_[cell(row, column)] = 1;
    }

    double cell_ = kCellMm;
    Vec2 origin_;
    int columns_ = 0;
    int rows_ = 0;
    std::vector<char> taken_;
};

LegendLine sample_of(const Row& row, const Profile& profile, ScoreSide side, Vec2 left) {
    const Pen& pen = profile.pen(row.operation);
    LegendLine line{{}, pen.color, pen.width_mm, false};
    if (is_broken(row.operation, profile, side)) {
        for (const Segment& part : broken_score({left, left + Vec2{kSampleMm, 0.0}}))
            line.strokes.push_back({part.a, part.b});
        return line;
    }
    if (!profile.dashes(row.operation)) {
        line.strokes.push_back({left, left + Vec2{kSampleMm, 0.0}});
        return line;
    }
    const Dashes dashes = fitted_dashes(row.operation, kSampleMm);
    double at = 0.0;
    for (std::size_t i = 0; at < kSampleMm - 1e-6 && dashes.count > 0; ++i) {
        const double length = dashes.pattern()[i % dashes.count];
        if (i % 2 == 0) line.strokes.push_back({left + Vec2{at, 0.0}, left + Vec2{at + length, 0.0}});
        at += length;
    }
    return line;
}

Ring box_at(Vec2 low, Vec2 size) {
    return {low, low + Vec2{size.x, 0.0}, low + size, low + Vec2{0.0, size.y}};
}

void add_row(const Row& row, const Profile& profile, ScoreSide side, Vec2 left, LegendBox& legend) {
    double text_at = kTextAtMm;
    switch (row.sample) {
        case Row::Sample::none:
            text_at = kPadMm;
            break;
        case Row::Sample::line:
            legend.lines.push_back(sample_of(row, profile, side, left + Vec2{kPadMm, 0.0}));
            break;
        case Row::Sample::target: {
            const Vec2 size{kSampleMm, 0.7 * kRowMm};
            const Ring box = box_at(left + Vec2{kPadMm, -0.5 * size.y}, size);
            const Pen& pen = profile.pen(Operation::glue);
            legend.lines.push_back(
                {{{box[0], box[1], box[2], box[3], box[0]}}, pen.color, pen.width_mm, false});
            break;
        }
        case Row::Sample::bar: {
            const Vec2 a = left + Vec2{kPadMm, 0.0};
            const Vec2 b = a + Vec2{kBarMm, 0.0};
            const Vec2 tick{0.0, 1.0};
            const Pen& pen = profile.pen(Operation::legend);
            legend.lines.push_back(
                {{{a, b}, {a - tick, a + tick}, {b - tick, b + tick}}, pen.color, pen.width_mm, false});
            text_at = kPadMm + kBarMm + kPadMm;
            break;
        }
    }
    legend.texts.push_back({row.text, left + Vec2{text_at + 0.5 * width_of(row.text), 0.0}});
}

}  // namespace

bool is_folded_or_glued(const OperationCounts& counts) {
    return std::any_of(kOperations.begin(), kOperations.end(), [&](Operation operation) {
        return (is_fold(operation) || operation == Operation::glue) && nth(counts, operation) > 0;
    });
}

std::optional<LegendBox> legend_of(const SheetDrawing& drawing, const Layout& layout,
                                   std::span<const Placement> placements, const SheetView& view,
                                   const OutputOptions& options) {
    const Profile& profile = drawing.profile;
    if (placements.empty()) return std::nullopt;
    const auto is_wanted = [&] {
        return view.folded_or_glued ? *view.folded_or_glued
                                    : is_folded_or_glued(count_operations(layout, profile));
    };
    if (options.legend == Legend::automatic && !is_wanted()) return std::nullopt;
    const std::vector<Row> rows = rows_of(drawing, layout, view.sheet);
    FreeSpace free(nth(layout.sheets, view.sheet), layout.margin_mm);
    for (const Placement& placement : placements) {
        const Pattern& pattern = nth(layout.designs, placement.design).pattern;
        for (const Polygon& part : nth(pattern.pieces, placement.piece).silhouette) {
            std::vector<Vec2> outline;
            for (const Vec2 p : part.outer) outline.push_back(placement.apply(p));
            free.take(outline);
        }
    }
    // In one column, or where that is too high in two, then three.
    for (const std::size_t columns : {1U, 2U, 3U}) {
        const std::size_t each = (rows.size() + columns - 1) / columns;
        std::vector<double> widths;
        double width = 0.0;
        for (std::size_t first = 0; first < rows.size(); first += each) {
            double widest = 0.0;
            for (std::size_t i = first; i < std::min(first + each, rows.size()); ++i)
                widest = std::max(widest, width_of(rows[i]));
            widths.push_back(widest);
            width += widest;
        }
        const double height = static_cast<double>(each) * kRowMm + kPadMm;
        const std::optional<Vec2> corner = free.place_for(width, height);
        if (!corner) continue;
        LegendBox legend;
        legend.bounds = {*corner, *corner + Vec2{width, height}};
        const Ring frame = box_at(*corner, {width, height});
        legend.lines.push_back(
            {{{frame[0], frame[1], frame[2], frame[3], frame[0]}}, kFrame, kLegendFrameMm, false});
        double left = corner->x;
        for (std::size_t column = 0; column < widths.size(); ++column) {
            double y = corner->y + height - 0.5 * (kRowMm + kPadMm);
            for (std::size_t i = column * each; i < std::min((column + 1) * each, rows.size()); ++i) {
                add_row(rows[i], profile, options.score_side, {left, y}, legend);
                y -= kRowMm;
            }
            left += widths[column];
        }
        return legend;
    }
    return std::nullopt;
}

}  // namespace popup
