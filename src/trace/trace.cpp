#include "popup/trace.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/text/numbers.h"
#include "trace/cells.h"
#include "trace/contours.h"

namespace popup {
namespace {

constexpr int kDecimals = 3;
// Cells are larger than what coordinates are rounded to, or contours beside one another would meet.
constexpr double kLeastCellMm = 0.01;
// A clean silhouette of the largest picture has a tenth of this.
constexpr std::size_t kMostBorder = 4'000'000;
constexpr std::size_t kMostNecks = 100;
// A contour that loses fewer cells than this stays smooth.
constexpr double kLostCells = 3.0;

// Where cells lie in mm.
struct Scale {
    double cell_mm = 0.0;
    double lowest_mm = 0.0;  // the lower edge of the lowest cells
    [[nodiscard]] Vec2 operator()(Vec2 p) const {
        return {rounded(p.x * cell_mm, kDecimals), rounded(lowest_mm + p.y * cell_mm, kDecimals)};
    }
};

class Following {
 public:
    Following(const CellGrid& cells, const Scale& scale, double tolerance)
        : cells_(cells), scale_(scale), curves_(curves_of(cells, Closeness::smooth, tolerance)) {
        for (const CellContour& curve : curves_) paths_.push_back(curve.path.mapped(scale_));
        keep_strokes();
    }

    // False where there are too many points, or what crosses cannot be parted.
    bool part() {
        for (const Closeness closeness : {Closeness::corners, Closeness::straight}) {
            if (!find_crossing()) return false;
            if (found_.empty()) return true;
            const std::vector<CellContour> closer = curves_of(cells_, closeness, 0.0);
            for (const std::size_t i : found_) {
                if (!kept_[i]) paths_[i] = closer[i].path.mapped(scale_);
            }
            if (closeness == Closeness::straight) straight_ = closer;
        }
        // What is replaced may meet what was not: so until nothing does, and at last by all.
        const CellBorders borders(cells_);
        std::vector<bool> replaced(paths_.size());
        while (find_crossing()) {
            if (found_.empty()) return true;
            bool any = false;
            for (const std::size_t i : found_) {
                const CellContour* border = replaced[i] ? nullptr : borders.of(straight_[i]);
                if (border == nullptr) continue;
                replaced[i] = any = true;
                paths_[i] = border->path.mapped(scale_);
            }
            // Borders do not cross: some were taken for others', as can be where strokes wind into one
            // another.
            if (!any) return false;
        }
        return false;
    }

    [[nodiscard]] std::vector<TracedShape> shapes() const {
        std::vector<TracedShape> made;
        const double cell_mm2 = scale_.cell_mm * scale_.cell_mm;
        for (std::size_t i = 0; i < paths_.size(); ++i) {
            if (curves_[i].area > 0) made.emplace_back();
            TracedShape& shape = made.back();
            shape.area_mm2 += static_cast<double>(curves_[i].area) * cell_mm2;
            const Subpath& subpath = paths_[i].subpaths().front();
            shape.path.move(subpath.start);
            for (const PathStep& step : subpath.steps) {
                if (step.curve) {
                    shape.path.cubic(step.control_1, step.control_2, step.to);
                } else {
                    shape.path.line(step.to);
                }
            }
            shape.path.close();
        }
        return made;
    }

 private:
    // Smooth curves make a needle of a stroke that is one cell wide, and lose most of its length. Such
    // contours go along the cells.
    void keep_strokes() {
        constexpr double kMostLost = 0.25;
        kept_.resize(paths_.size());
        const auto error = [](const CellContour& curve, std::int64_t area) {
            return std::abs(enclosed_area(curve) - static_cast<double>(area));
        };
        std::optional<CellBorders> borders;
        for (std::size_t i = 0; i < curves_.size(); ++i) {
            const std::int64_t area = curves_[i].area;
            const double lost = error(curves_[i], area);
            // Specks are a matter of taste.
            if (lost <= kMostLost * std::abs(static_cast<double>(area)) || lost < kLostCells) continue;
            if (!borders) borders.emplace(cells_);
            const CellContour* border = borders->about(curves_[i]);
            if (border == nullptr || error(*border, area) >= lost) continue;
            kept_[i] = true;
            paths_[i] = border->path.mapped(scale_);
        }
    }
    bool find_crossing() {
        auto found = crossing(paths_);
        if (found) found_ = std::move(*found);
        return found.has_value();
    }
    const CellGrid& cells_;
    Scale scale_;
    std::vector<CellContour> curves_, straight_;
    std::vector<Path> paths_;
    std::vector<bool> kept_;  // along the cells from the beginning
    std::vector<std::size_t> found_;
};

std::string square_mm(double area) { return fmt::format("{} mm²", number_text(area, 2)); }

std::string things(std::size_t count, std::string_view one) {
    return fmt::format("{} {}{}", count, one, count == 1 ? "" : "s");
}

LeftOut left_out(const Cleaned::Dropped& dropped, double cell_mm) {
    return {dropped.count, static_cast<double>(dropped.largest) * cell_mm * cell_mm};
}

void tell_left_out(const Traced& traced, double least_mm, Diagnostics& diagnostics) {
    const std::string least = fmt::format("a square of {} mm", number_text(least_mm, 3));
    if (traced.specks.count > 0) {
        diagnostics
            .remark("trace-specks", {},
                    fmt::format("left out {} smaller than {}; the largest has {}",
                                things(traced.specks.count, "speck"), least,
                                square_mm(traced.specks.largest_mm2)))
            .hint("a smaller --min-feature keeps them");
    }
    if (traced.filled_holes.count > 0) {
        diagnostics
            .remark("trace-holes-filled", {},
                    fmt::format("filled {} smaller than {}; the largest has {}",
                                things(traced.filled_holes.count, "hole"), least,
                                square_mm(traced.filled_holes.largest_mm2)))
            .hint("a smaller --min-feature keeps them");
    }
    if (traced.others.count > 0) {
        diagnostics.remark(
            "trace-others", {},
            fmt::format("left out {} beside the largest, which has {}; the largest of them "
                        "has {}",
                        things(traced.others.count, "shape"), square_mm(traced.shapes.front().area_mm2),
                        square_mm(traced.others.largest_mm2)));
    }
}

// Shown once what is left out has been told.
void tell_thin(const Traced& traced, std::size_t necks, const std::vector<ThinPlace>& shapes, double least_mm,
               const Scale& scale, const CellGrid& cells, Diagnostics& diagnostics) {
    const auto tell = [&](std::string what, double width_mm, Vec2 at) {
        diagnostics
            .warning("trace-thin", {},
                     fmt::format("{} narrower than {} mm; the narrowest is about {} mm wide, at ({}, {}) mm",
                                 what, number_text(least_mm, 3), number_text(width_mm, 2),
                                 number_text(at.x, 1), number_text(at.y, 1)))
            .hint("make it wider in the picture, or trace the picture at a larger size");
    };
    if (necks > 0) {
        tell(fmt::format("parts hang together by {} of paper", things(necks, "neck")),
             traced.necks.front().width_mm, traced.necks.front().at);
    }
    if (!shapes.empty()) {
        const ThinPlace& first = shapes.front();
        tell(fmt::format("{} everywhere",
                         shapes.size() == 1 ? "a shape is" : fmt::format("{} shapes are", shapes.size())),
             first.width * scale.cell_mm, scale({first.x - 0.5, cells.height - 1.5 - first.y}));
    }
}

}  // namespace

std::optional<Traced> trace_outlines(const PixelMask& mask, const TraceOptions& options,
                                     Diagnostics& diagnostics) {
    POPUP_INVARIANT(options.pixel_mm > 0.0 && mask.width > 0 && mask.height > 0);
    // Half the tolerance is for the cells, and the other half for the curves.
    const double pixels = std::max(options.simplify_mm / (2.0 * options.pixel_mm), 1.0);
    const double least = std::max(std::floor(pixels), std::ceil(kLeastCellMm / options.pixel_mm));
    const int side = static_cast<int>(std::min(least, 1.0 * std::max(mask.width, mask.height)));
    CellGrid cells = cells_of(mask, side);
    Traced traced;
    traced.width_mm = mask.width * options.pixel_mm;
    traced.height_mm = mask.height * options.pixel_mm;
    Scale scale;
    scale.cell_mm = side * options.pixel_mm;
    scale.lowest_mm = traced.height_mm - (cells.height - 2) * scale.cell_mm;
    const double feature = options.min_feature_mm / scale.cell_mm;
    if (std::ranges::count(cells.inside, 1) == 0 || (mask.even && mask.inside.front() == 0)) {
        diagnostics.error("trace-empty", {},
                          mask.by_alpha ? "nothing in the picture is opaque enough to be the figure"
                                        : "nothing in the picture is dark enough to be the figure");
        return std::nullopt;
    }
    const Cleaned cleaned = clean(cells, {feature * feature, options.largest});
    traced.specks = left_out(cleaned.specks, scale.cell_mm);
    traced.filled_holes = left_out(cleaned.holes, scale.cell_mm);
    traced.others = left_out(cleaned.others, scale.cell_mm);
    if (std::ranges::count(cells.inside, 1) == 0) {
        diagnostics
            .error("trace-empty", {},
                   fmt::format("all {} in the picture are smaller than a square of {} mm; the largest has {}",
                               things(traced.specks.count, "shape"), number_text(options.min_feature_mm, 3),
                               square_mm(traced.specks.largest_mm2)))
            .hint("give a smaller --min-feature, or a larger size");
        return std::nullopt;
    }
    const auto too_complex = [&diagnostics](std::size_t edges) {
        diagnostics
            .error("trace-too-complex", {},
                   fmt::format("the outlines go along {} edges of pixels, and are too many to follow", edges))
            .hint("give a larger --min-feature and --simplify, or a picture with clear areas");
        return std::nullopt;
    };
    const std::size_t border = border_length(cells);
    if (border > kMostBorder) return too_complex(border);
    const double tolerance = std::clamp(0.5 * options.simplify_mm / scale.cell_mm, 0.0, 2.0);
    Following following(cells, scale, tolerance);
    if (!following.part()) return too_complex(border);
    traced.shapes = following.shapes();
    const ThinPaper thin = thin_paper(cells, feature);
    traced.thin_shapes = thin.shapes.size();
    for (const ThinPlace& neck : thin.necks) {
        if (traced.necks.size() == kMostNecks) break;
        traced.necks.push_back(
            {scale({neck.x - 0.5, cells.height - 1.5 - neck.y}), neck.width * scale.cell_mm});
    }
    if (mask.few_clear) {
        diagnostics
            .remark(
                "trace-few-clear", {},
                "less than a hundredth of the picture is clear, so the figure is what is dark in it, and not "
                "what is opaque")
            .hint("where all that is opaque is the figure, paint it in one colour");
    }
    tell_left_out(traced, options.min_feature_mm, diagnostics);
    tell_thin(traced, thin.necks.size(), thin.shapes, options.min_feature_mm, scale, cells, diagnostics);
    return traced;
}

std::string svg_of(const Traced& traced) {
    fmt::memory_buffer out;
    const auto number = [&out](double value) { append_number(out, value, kDecimals); };
    const auto point = [&](char command, Vec2 p) {
        out.push_back(command);
        number(p.x);
        out.push_back(' ');
        number(traced.height_mm - p.y);
    };
    fmt::format_to(fmt::appender(out),
                   "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
                   "<svg xmlns=\"http://www.w3.org/2000/svg\" version=\"1.1\" width=\"{0}mm\" "
                   "height=\"{1}mm\" viewBox=\"0 0 {0} {1}\">\n",
                   number_text(traced.width_mm, kDecimals), number_text(traced.height_mm, kDecimals));
    for (std::size_t i = 0; i < traced.shapes.size(); ++i) {
        fmt::format_to(fmt::appender(out),
                       "<path id=\"shape-{}\" fill=\"none\" stroke=\"#000000\" stroke-width=\"0.1\" d=\"",
                       i + 1);
        for (const Subpath& subpath : traced.shapes[i].path.subpaths()) {
            point('M', subpath.start);
            for (const PathStep& step : subpath.steps) {
                if (step.curve) {
                    point('C', step.control_1);
                    point(' ', step.control_2);
                    point(' ', step.to);
                } else {
                    point('L', step.to);
                }
            }
            out.push_back('Z');
        }
        fmt::format_to(fmt::appender(out), "\"/>\n");
    }
    fmt::format_to(fmt::appender(out), "</svg>\n");
    return fmt::to_string(out);
}

}  // namespace popup
