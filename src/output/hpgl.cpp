#include "output/hpgl.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>

#include "output/pictures_left_out.h"
#include "output/sheet_drawing.h"

namespace popup {
namespace {

constexpr double kUnitsPerMm = 40.0;
constexpr std::int64_t kLargestUnit = 32767;
constexpr std::size_t kPointsPerCommand = 40;
constexpr int kPens = 8;

struct PlotterPoint {
    std::int64_t x = 0;
    std::int64_t y = 0;
    friend bool operator==(const PlotterPoint&, const PlotterPoint&) = default;
};

// Rounding on the sheet's lower or left edge must not give -1.
PlotterPoint plotter_point(Vec2 p) {
    const auto units = [](double mm) { return std::max<std::int64_t>(0, std::llround(mm * kUnitsPerMm)); };
    return {units(p.x), units(p.y)};
}

using PenNumbers = std::array<int, kOperations.size()>;  // 0: no lines are drawn like that

bool has_lines(Operation operation, const Profile& profile, const OutputOptions& options) {
    if (!profile.draws(operation) || operation == Operation::fill || operation == Operation::legend)
        return false;
    if (operation == Operation::mark) return profile.marks_glue();
    if (operation == Operation::label) return profile.outlined_text;
    if (operation == Operation::registration)
        return profile.marks != Marks::none || options.reference_mm > 0.0;
    return true;
}

PenNumbers pen_numbers(const Profile& profile, const OutputOptions& options) {
    PenNumbers pens{};
    const auto number = [&](bool printed_is_one) {
        std::vector<std::string> layers;
        for (const Operation operation : kOperations) {
            if (!has_lines(operation, profile, options)) continue;
            // No layer has an empty name.
            const std::string layer =
                printed_is_one && is_printed(operation) ? std::string() : profile.pen(operation).layer;
            auto at = std::find(layers.begin(), layers.end(), layer);
            if (at == layers.end()) at = layers.insert(at, layer);
            pens.at(static_cast<std::size_t>(operation)) = static_cast<int>(at - layers.begin()) + 1;
        }
        return static_cast<int>(layers.size());
    };
    if (number(false) > kPens) number(true);
    return pens;
}

class Plot {
 public:
    Plot(const SheetDrawing& drawing, const OutputOptions& options)
        : drawing_(drawing), pens_(pen_numbers(drawing.profile, options)) {}

    std::string sheet() {
        raw("IN;PA;\n");
        for (const SheetLayer& layer : drawing_.layers) {
            for (const SheetShape& shape : drawing_.shapes_of(layer)) {
                const int pen = pens_.at(static_cast<std::size_t>(shape.operation));
                if (pen == 0) continue;
                for (const Run& run : drawing_.runs_of(shape)) line(pen, run);
            }
        }
        raw("PU;SP0;\n");
        return fmt::to_string(out_);
    }
    // The largest coordinate that is drawn.
    [[nodiscard]] std::int64_t reach() const { return reach_; }

 private:
    void raw(std::string_view text) { out_.append(text.data(), text.data() + text.size()); }

    void take(int pen) {
        if (pen == pen_) return;
        fmt::format_to(fmt::appender(out_), "PU;SP{};\n", pen);
        pen_ = pen;
    }

    void line(int pen, const Run& run) {
        path_.clear();
        for (const Vec2 p : drawing_.points_of(run)) {
            const PlotterPoint point = plotter_point(p);
            if (path_.empty() || path_.back() != point) path_.push_back(point);
        }
        if (path_.size() < 2) return;
        if (run.closed && path_.back() != path_.front()) path_.push_back(path_.front());
        take(pen);
        fmt::format_to(fmt::appender(out_), "PU{},{};", path_.front().x, path_.front().y);
        for (std::size_t i = 1; i < path_.size(); ++i) {
            const std::size_t place = (i - 1) % kPointsPerCommand;
            if (place == 0 && i > 1) raw(";\n");
            fmt::format_to(fmt::appender(out_), "{}{},{}", place == 0 ? "PD" : ",", path_[i].x, path_[i].y);
        }
        raw(";\n");
        for (const PlotterPoint& point : path_) reach_ = std::max({reach_, point.x, point.y});
    }

    const SheetDrawing& drawing_;
    PenNumbers pens_;
    int pen_ = 0;
    std::int64_t reach_ = 0;
    std::vector<PlotterPoint> path_;  // of the line at hand
    fmt::memory_buffer out_;
};

}  // namespace

std::optional<std::vector<SheetFile>> write_hpgl(const Layout& layout, const OutputOptions& options,
                                                 Diagnostics& diagnostics) {
    std::int64_t reach = 0;
    OutputOptions outlined = options;
    outlined.outlined_print = true;
    outlined.legend = Legend::never;
    tell_pictures_left_out(layout, options, ".plt", diagnostics);
    auto files =
        file_per_view(layout, outlined, diagnostics, [&](const SheetDrawing& drawing, const SheetView&) {
            Plot plot(drawing, options);
            std::string text = plot.sheet();
            reach = std::max(reach, plot.reach());
            return text;
        });
    if (reach > kLargestUnit) {
        diagnostics
            .remark(
                "plotter-range", {},
                fmt::format("lines reach {:.1f} mm from the origin, and plotters of the first HP-GL go no "
                            "further than {:.1f} mm",
                            static_cast<double>(reach) / kUnitsPerMm,
                            static_cast<double>(kLargestUnit) / kUnitsPerMm))
            .hint("if the machine stops short, choose a smaller sheet with --sheet");
    }
    return files;
}

}  // namespace popup
