#include "output/book/figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/geometry/regions.h"
#include "base/nth.h"
#include "base/text/numbers.h"

namespace popup::book {
namespace {

constexpr double kFigureRimMm = 1.0;
constexpr double kTint = 0.6;  // how far colours are mixed with white, so that lines show
constexpr Color kPaper{253, 252, 249};
constexpr Color kTargetFill{208, 211, 216};
constexpr Color kWantedFill{255, 196, 87};

Color tinted(Color color) {
    const auto mix = [](std::uint8_t c) {
        return static_cast<std::uint8_t>(std::lround(c + kTint * (255.0 - c)));
    };
    return {mix(color.r), mix(color.g), mix(color.b)};
}

std::vector<std::vector<Vec2>> rings_of(const Polygon& polygon) {
    std::vector<std::vector<Vec2>> rings{polygon.outer};
    rings.insert(rings.end(), polygon.holes.begin(), polygon.holes.end());
    return rings;
}

Ink ink_of(LineKind kind) {
    switch (kind) {
        case LineKind::mountain:
            return Ink::mountain;
        case LineKind::valley:
            return Ink::valley;
        case LineKind::seam:
            return Ink::seam;
        case LineKind::mark:
            return Ink::faint;
        case LineKind::cut:
            break;
    }
    return Ink::edge;
}

// Into the figure's own coordinates.
template <typename Place>
void place_points(Figure& figure, const Place& place) {
    for (Figure::Shape& shape : figure.shapes) {
        for (auto& line : shape.lines) std::transform(line.begin(), line.end(), line.begin(), place);
    }
    for (Figure::Label& label : figure.labels) {
        label.at = place(label.at);
        std::transform(label.others.begin(), label.others.end(), label.others.begin(), place);
    }
}

}  // namespace

const InkLook& look_of(Ink ink) {
    static constexpr std::array<InkLook, 6> kLooks{{{{40, 40, 46}, 0.3, {}},
                                                    {{20, 60, 220}, 0.35, {2.2, 0.7, 0.6, 0.7}},
                                                    {{205, 0, 190}, 0.35, {1.4, 0.9, 1.4, 0.9}},
                                                    {{40, 40, 46}, 0.25, {0.7, 0.6, 0.7, 0.6}},
                                                    {{150, 154, 160}, 0.15, {}},
                                                    {{190, 96, 0}, 0.4, {}}}};
    return kLooks.at(static_cast<std::size_t>(ink));
}

namespace {

// Its paper and what is printed on it.
void add_paper(const PatternPiece& piece, Figure& figure) {
    for (const Polygon& part : piece.silhouette) figure.shapes.push_back({rings_of(part), true, kPaper, {}});
    for (const PatternPrint& one : piece.prints) {
        if (const Area* area = std::get_if<Area>(&one.print))
            figure.shapes.push_back({rings_of(area->shape), true, tinted(area->color), {}});
    }
    for (const PatternPrint& one : piece.prints) {
        const Image* image = std::get_if<Image>(&one.print);
        if (image == nullptr) continue;
        for (const Polygon& part : image->clip)
            figure.shapes.push_back({rings_of(part), true, Color{232, 236, 240}, Ink::faint});
    }
    for (const PatternPrint& one : piece.prints) {
        if (const Stroke* stroke = std::get_if<Stroke>(&one.print))
            figure.shapes.push_back({{stroke->points}, false, {}, Ink::faint});
    }
}

// How wide a text may be that has its middle there, and lies in the shape.
double room_at(const Polygon& shape, Vec2 at) {
    double room = std::numeric_limits<double>::infinity();
    for (const auto& ring : rings_of(shape)) {
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const Vec2 a = ring[i], b = ring[(i + 1) % ring.size()];
            if ((a.y < at.y) == (b.y < at.y)) continue;
            const double x = a.x + (at.y - a.y) / (b.y - a.y) * (b.x - a.x);
            room = std::min(room, 2.0 * std::abs(x - at.x));
        }
    }
    return std::isfinite(room) ? room : 0.0;
}

// Moves it to its own corner.
void settle(const PatternPiece& piece, Figure& figure) {
    const Box box = piece.bounds;
    figure.width_mm = box.width() + 2.0 * kFigureRimMm;
    figure.height_mm = box.height() + 2.0 * kFigureRimMm;
    place_points(figure, [&box](Vec2 p) {
        return Vec2{p.x - box.min.x + kFigureRimMm, box.max.y - p.y + kFigureRimMm};
    });
    figure.alt = fmt::format("The piece {} before it is folded, {} × {} mm", piece.name,
                             number_text(box.width(), 0), number_text(box.height(), 0));
}

}  // namespace

Figure fold_figure(const PatternPiece& piece, const FoldedSheet& sheet) {
    Figure figure;
    add_paper(piece, figure);
    for (const Polygon& part : sheet.marked) figure.shapes.push_back({rings_of(part), true, kWantedFill, {}});
    for (const PatternLine& line : piece.lines)
        figure.shapes.push_back(
            {{{line.at.a, line.at.b}}, false, {}, sheet.folds.empty() ? ink_of(line.kind) : Ink::faint});
    for (const FoldedSheet::Fold& fold : sheet.folds)
        figure.shapes.push_back(
            {{{fold.at.a, fold.at.b}}, false, {}, fold.mountain ? Ink::mountain : Ink::valley});
    for (const Contour& cut : piece.cuts) figure.shapes.push_back({{cut.points}, cut.closed, {}, Ink::edge});
    for (const auto& [name, outline] : sheet.panels) {
        const Vec2 middle = inner_point(outline, 0.5).at;
        Figure::Label& label =
            figure.labels.emplace_back(Figure::Label{name, middle, {}, room_at(outline, middle)});
        for (const double share : {0.35, 0.7}) {
            for (const Vec2 p : outline.outer) label.others.push_back(lerp(middle, p, share));
        }
    }
    settle(piece, figure);
    return figure;
}

Figure piece_figure(const PatternPiece& piece, const std::vector<std::string>& wanted) {
    Figure figure;
    add_paper(piece, figure);
    const auto is_wanted = [&wanted](const std::string& label) {
        return std::find(wanted.begin(), wanted.end(), label) != wanted.end();
    };
    for (const GlueTarget& target : piece.targets) {
        const bool strong = is_wanted(target.label);
        if (target.on_back && !strong) continue;
        figure.shapes.push_back(
            {{target.outline}, true, strong ? kWantedFill : kTargetFill, strong ? Ink::accent : Ink::faint});
    }
    for (const PatternLine& line : piece.lines) {
        // Places where others are glued on are shown by their targets.
        if (line.kind == LineKind::seam && line.glued_on) continue;
        figure.shapes.push_back({{{line.at.a, line.at.b}}, false, {}, ink_of(line.kind)});
    }
    for (const Contour& cut : piece.cuts) figure.shapes.push_back({{cut.points}, cut.closed, {}, Ink::edge});
    for (const Label& label : piece.labels) {
        if (label.kind == LabelKind::piece) continue;
        if (label.kind == LabelKind::target && !is_wanted(label.text)) continue;
        figure.labels.push_back({label.text, label.at, {}, 0.0});
    }
    settle(piece, figure);
    return figure;
}

Figure sheet_figure(const Layout& layout, int number) {
    const LayoutSheet& sheet = nth(layout.sheets, number);
    Figure figure;
    figure.width_mm = sheet.width_mm;
    figure.height_mm = sheet.height_mm;
    figure.letters_only = layout.prefix_names;  // several designs have a piece 2
    const auto upright = [&sheet](Vec2 p) { return Vec2{p.x, sheet.height_mm - p.y}; };
    figure.shapes.push_back(
        {{{{0, 0}, {sheet.width_mm, 0}, {sheet.width_mm, sheet.height_mm}, {0, sheet.height_mm}}},
         true,
         Color{255, 255, 255},
         Ink::faint});
    for (const Placement& placement : layout.placements) {
        if (placement.sheet != number) continue;
        const PatternPiece& piece =
            nth(nth(layout.designs, placement.design).pattern.pieces, placement.piece);
        Polygon largest;
        for (const Polygon& part : piece.silhouette) {
            if (largest.outer.empty() || area(part) > area(largest)) largest = part;
        }
        std::vector<Figure::Shape> shapes;
        Color paper{238, 240, 243};
        for (const PatternPrint& one : piece.prints) {
            const Area* area = std::get_if<Area>(&one.print);
            if (area == nullptr || paper != Color{238, 240, 243}) continue;
            paper = tinted(area->color);
        }
        for (const Polygon& part : piece.silhouette) shapes.push_back({rings_of(part), true, paper, {}});
        for (const PatternLine& line : piece.lines) {
            if (line.kind == LineKind::mountain || line.kind == LineKind::valley)
                shapes.push_back({{{line.at.a, line.at.b}}, false, {}, ink_of(line.kind)});
        }
        for (const Contour& cut : piece.cuts) shapes.push_back({{cut.points}, cut.closed, {}, Ink::edge});
        Box box;
        for (Figure::Shape& shape : shapes) {
            for (auto& line : shape.lines) {
                for (Vec2& p : line) {
                    p = upright(placement.apply(p));
                    box.extend(p);
                }
            }
            figure.shapes.push_back(std::move(shape));
        }
        std::string name = layout.piece_name(placement);
        for (const Label& label : piece.labels) {
            if (label.kind == LabelKind::piece && label.text.ends_with(piece.name))
                name = layout.prefix_names
                           ? fmt::format("{}: {}", nth(layout.designs, placement.design).stem, label.text)
                           : label.text;
        }
        if (largest.outer.empty()) continue;
        // "2" of "2. castle".
        const std::size_t dot = name.find(". ");
        const bool is_numbered = dot != std::string::npos && name.find_first_not_of("0123456789") == dot;
        const Vec2 middle = inner_point(largest, 0.5).at;
        Figure::Label& label = figure.labels.emplace_back(
            Figure::Label{name, upright(placement.apply(middle)),
                          is_numbered ? name.substr(0, dot) : std::string(), box.width()});
        for (const double share : {0.35, 0.7}) {
            for (const Vec2 p : largest.outer)
                label.others.push_back(upright(placement.apply(lerp(middle, p, share))));
        }
    }
    return figure;
}

}  // namespace popup::book
