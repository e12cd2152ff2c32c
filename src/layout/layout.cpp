#include "popup/layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "layout/pack.h"
#include "layout/scale.h"
#include "layout/turns.h"

namespace popup {

Vec2 Placement::apply(Vec2 p) const { return turned(p, angle) + offset; }

std::string Layout::piece_name(const Placement& placement) const {
    const DesignPattern& design = designs[static_cast<std::size_t>(placement.design)];
    const std::string& name = design.pattern.pieces[static_cast<std::size_t>(placement.piece)].name;
    return prefix_names ? design.stem + ":" + name : name;
}

namespace {

constexpr std::size_t kMostPieces = 1'000'000;
constexpr double kMostMm = 1e8;

struct Sheet {
    double width = 0.0;
    double height = 0.0;
    [[nodiscard]] SheetArea usable(double margin) const {
        return {width - 2.0 * margin, height - 2.0 * margin};
    }
};

// A piece of a design, before it is copied.
struct Source {
    int design = 0;
    int piece = 0;
};

bool takes_all(const std::vector<Shape>& shapes, const Sheet& sheet, const LayoutOptions& options) {
    const SheetArea area = sheet.usable(options.margin.mm);
    return area.width > 0.0 && area.height > 0.0 &&
           std::all_of(shapes.begin(), shapes.end(),
                       [&](const Shape& s) { return fits(s, area, options.rotation); });
}

// The paper landscape or portrait, as takes all shapes; nullopt when neither does.
std::optional<Sheet> oriented(const Paper& paper, const std::vector<Shape>& shapes,
                              const LayoutOptions& options) {
    for (const Sheet& sheet :
         {Sheet{paper.height_mm, paper.width_mm}, Sheet{paper.width_mm, paper.height_mm}}) {
        if (takes_all(shapes, sheet, options)) return sheet;
    }
    return std::nullopt;
}

// The sheet to use. Where no choice takes all shapes it is one on which to say what does not fit.
Sheet choose_sheet(const std::vector<Shape>& shapes, const LayoutOptions& options) {
    const SheetChoice& choice = options.sheet;
    if (choice.name.empty()) return {choice.width_mm, choice.height_mm};
    for (const Paper& paper : paper_table()) {
        if (choice.name != "auto" && choice.name != paper.name) continue;
        if (const auto sheet = oriented(paper, shapes, options)) return *sheet;
    }
    const Paper* last = &paper_table().back();
    for (const Paper& paper : paper_table()) {
        if (choice.name == paper.name) last = &paper;
    }
    return {last->height_mm, last->width_mm};
}

// The largest scale at which a box fits.
double scale_that_fits(const Box& bounds, const SheetArea& area, Rotation rotation) {
    double scale = std::min(area.width / bounds.width(), area.height / bounds.height());
    if (rotation.count == 0 || rotation.count % 4 == 0) {
        scale = std::max(scale, std::min(area.width / bounds.height(), area.height / bounds.width()));
    }
    return scale;
}

// A placed piece's box on the grid.
struct GridBox {
    int sheet;
    GridLength x0, y0, x1, y1;
};

// Turned corners are rounded to the grid once when a place is looked for and once when it is checked.
constexpr GridLength kSlack = 2;

// Whether no two boxes of a sheet are closer than the spacing: a sweep from left to right over the boxes,
// each widened by the spacing, that keeps those under the sweep ordered from bottom to top.
bool are_apart(std::vector<GridBox> boxes, GridLength spacing) {
    std::sort(boxes.begin(), boxes.end(), [](const GridBox& a, const GridBox& b) {
        return std::tuple(a.sheet, a.x0, a.y0) < std::tuple(b.sheet, b.x0, b.y0);
    });
    const GridLength widened = spacing - kSlack;
    std::map<GridLength, GridLength> under;         // from bottom to top
    std::multimap<GridLength, GridLength> leaving;  // right end, bottom
    int sheet = -1;
    for (const GridBox& box : boxes) {
        if (box.sheet != sheet) {
            sheet = box.sheet;
            under.clear();
            leaving.clear();
        }
        for (; !leaving.empty() && leaving.begin()->first <= box.x0; leaving.erase(leaving.begin())) {
            under.erase(leaving.begin()->second);
        }
        const GridLength top = box.y1 + widened;
        if (top <= box.y0 || box.x1 + widened <= box.x0) continue;
        const auto above = under.lower_bound(box.y0);
        if (above != under.end() && above->first < top) return false;
        if (above != under.begin() && std::prev(above)->second > box.y0) return false;
        under.emplace(box.y0, top);
        leaving.emplace(box.x1 + widened, box.y0);
    }
    return true;
}

class Layouter {
 public:
    Layouter(std::vector<DesignPattern> designs, const LayoutOptions& options, Diagnostics& diagnostics)
        : options_(options), diagnostics_(diagnostics) {
        layout_.designs = std::move(designs);
        layout_.margin_mm = options.margin.mm;
        layout_.prefix_names = layout_.designs.size() > 1;
    }

    std::optional<Layout> run() {
        if (!gather()) return std::nullopt;
        const Sheet sheet = choose_sheet(shapes_, options_);
        const SheetArea area = sheet.usable(options_.margin.mm);
        layout_.width_mm = sheet.width;
        layout_.height_mm = sheet.height;
        if (to_grid(area.width) <= 0 || to_grid(area.height) <= 0) {
            diagnostics_
                .error("sheet-too-small", {},
                       fmt::format("margins of {:.2f} mm leave nothing of a sheet of {:.2f} × {:.2f} mm",
                                   options_.margin.mm, sheet.width, sheet.height))
                .hint("choose a larger --sheet or a smaller --margin");
            return std::nullopt;
        }
        bool all_fit = true;
        for (std::size_t i = 0; i < shapes_.size(); ++i) {
            if (fits(shapes_[i], area, options_.rotation)) continue;
            complain(i, area);
            all_fit = false;
        }
        if (!all_fit) return std::nullopt;
        place(area);
        verify();
        account(area);
        return std::move(layout_);
    }

 private:
    [[nodiscard]] const PatternPiece& piece_of(const Source& source) const {
        return layout_.designs[static_cast<std::size_t>(source.design)]
            .pattern.pieces[static_cast<std::size_t>(source.piece)];
    }

    [[nodiscard]] std::string name_of(const Source& source) const {
        return layout_.piece_name({source.design, source.piece, 0, 0, {}, {}});
    }

    bool gather() {
        bool in_range = true;
        for (std::size_t d = 0; d < layout_.designs.size(); ++d) {
            Pattern& pattern = layout_.designs[d].pattern;
            if (options_.scale != 1.0) scale_pattern(pattern, options_.scale);
            for (std::size_t p = 0; p < pattern.pieces.size(); ++p) {
                const Source source{static_cast<int>(d), static_cast<int>(p)};
                const PatternPiece& piece = pattern.pieces[p];
                POPUP_INVARIANT(!piece.silhouette.empty());
                sources_.push_back(source);
                const Box& b = piece.bounds;
                const double reach =
                    std::max({std::abs(b.min.x), std::abs(b.min.y), std::abs(b.max.x), std::abs(b.max.y)});
                if (reach <= kMostMm) continue;
                in_range = false;
                diagnostics_
                    .error("piece-too-large", {},
                           fmt::format(
                               "piece \"{}\" reaches {:.3g} mm from the middle of its page, which is further "
                               "than {:.0f} km",
                               name_of(source), reach, kMostMm / 1e6))
                    .hint("choose a smaller --scale")
                    .about(piece.name);
            }
        }
        if (!in_range) return false;
        if (sources_.size() * static_cast<std::size_t>(options_.copies) > kMostPieces) {
            diagnostics_
                .error("too-many-pieces", {},
                       fmt::format("{} copies of {} pieces are more than {} pieces", options_.copies,
                                   sources_.size(), kMostPieces))
                .hint("ask for fewer --copies, or split the run");
            return false;
        }
        for (const Source& source : sources_) shapes_.push_back(make_shape(piece_of(source).silhouette));
        return true;
    }

    void complain(std::size_t number, const SheetArea& area) {
        const PatternPiece& piece = piece_of(sources_[number]);
        Diagnostic& finding =
            diagnostics_.error("piece-too-large", {},
                               fmt::format("piece \"{}\" of {:.2f} × {:.2f} mm does not fit on the sheet, of "
                                           "which {:.2f} × {:.2f} mm are "
                                           "usable",
                                           name_of(sources_[number]), piece.bounds.width(),
                                           piece.bounds.height(), area.width, area.height));
        finding.about(piece.name);
        finding.file = layout_.designs[static_cast<std::size_t>(sources_[number].design)].file;
        for (const Paper& paper : paper_table()) {
            if (oriented(paper, {shapes_[number]}, options_)) {
                finding.hint(fmt::format("--sheet {} would take it", paper.name));
                break;
            }
        }
        const double scale = options_.scale * scale_that_fits(piece.bounds, area, options_.rotation);
        const double rounded = std::floor(100.0 * scale + 1e-6) / 100.0;
        if (rounded > 0.0) finding.hint(fmt::format("--scale {:.2f} would make it fit", rounded));
    }

    void place(const SheetArea& area) {
        std::vector<int> items;
        items.reserve(sources_.size() * static_cast<std::size_t>(options_.copies));
        for (int copy = 0; copy < options_.copies; ++copy) {
            for (std::size_t i = 0; i < sources_.size(); ++i) items.push_back(static_cast<int>(i));
        }
        const auto spots = pack(shapes_, items, area, {options_.spacing.mm, options_.rotation});
        POPUP_INVARIANT(spots.has_value());
        const double margin = from_grid(to_grid(options_.margin.mm));
        for (std::size_t i = 0; i < items.size(); ++i) {
            const Spot& spot = (*spots)[i];
            const Source& source = sources_[static_cast<std::size_t>(items[i])];
            const int copy = static_cast<int>(i / sources_.size());
            layout_.placements.push_back({source.design, source.piece, copy, spot.sheet,
                                          spot.offset + Vec2{margin, margin}, spot.angle});
            layout_.sheets = std::max(layout_.sheets, spot.sheet + 1);
        }
        std::sort(layout_.placements.begin(), layout_.placements.end(),
                  [](const Placement& a, const Placement& b) {
                      return std::tuple(a.sheet, a.design, a.copy, a.piece) <
                             std::tuple(b.sheet, b.design, b.copy, b.piece);
                  });
    }

    [[nodiscard]] GridBox box_of(const Placement& placement) const {
        Box box;
        for (const Polygon& part : piece_of({placement.design, placement.piece}).silhouette) {
            for (const Vec2 p : part.outer) box.extend(placement.apply(p));
        }
        return {placement.sheet, to_grid(box.min.x), to_grid(box.min.y), to_grid(box.max.x),
                to_grid(box.max.y)};
    }

    // A layout in which something overlaps must not leave this room, whoever made it. Also keeps the boxes.
    void verify() {
        const GridLength margin = to_grid(layout_.margin_mm) - kSlack;
        const GridLength width = to_grid(layout_.width_mm);
        const GridLength height = to_grid(layout_.height_mm);
        for (const Placement& placement : layout_.placements) {
            const GridBox box = box_of(placement);
            boxes_.push_back(box);
            POPUP_INVARIANT(box.x0 >= margin && box.y0 >= margin && box.x1 <= width - margin &&
                            box.y1 <= height - margin);
        }
        POPUP_INVARIANT(are_apart(boxes_, to_grid(options_.spacing.mm)));
    }

    void account(const SheetArea& area) {
        const auto count = static_cast<std::size_t>(layout_.sheets);
        layout_.utilisation.assign(count, 0.0);
        layout_.used_mm.assign(count, {0.0, 0.0});
        const GridLength margin = to_grid(layout_.margin_mm);
        std::vector<double> areas;
        std::vector<std::size_t> first_of_design{0};
        for (const DesignPattern& design : layout_.designs) {
            for (const PatternPiece& piece : design.pattern.pieces) {
                double sum = 0.0;
                for (const Polygon& part : piece.silhouette) sum += popup::area(part);
                areas.push_back(sum);
            }
            first_of_design.push_back(areas.size());
        }
        for (std::size_t i = 0; i < layout_.placements.size(); ++i) {
            const Placement& placement = layout_.placements[i];
            const auto sheet = static_cast<std::size_t>(placement.sheet);
            const std::size_t piece = first_of_design[static_cast<std::size_t>(placement.design)] +
                                      static_cast<std::size_t>(placement.piece);
            layout_.utilisation[sheet] += areas[piece] / (area.width * area.height);
            Vec2& used = layout_.used_mm[sheet];
            used.x = std::max(used.x, from_grid(boxes_[i].x1 - margin));
            used.y = std::max(used.y, from_grid(boxes_[i].y1 - margin));
        }
    }

    const LayoutOptions& options_;
    Diagnostics& diagnostics_;
    Layout layout_;
    std::vector<Source> sources_;
    std::vector<Shape> shapes_;   // of each source
    std::vector<GridBox> boxes_;  // of each placement
};

}  // namespace

std::optional<Layout> lay_out(std::vector<DesignPattern> designs, const LayoutOptions& options,
                              Diagnostics& diagnostics) {
    return Layouter(std::move(designs), options, diagnostics).run();
}

}  // namespace popup
