#include "output/halos.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "popup/geometry.h"

namespace popup {
namespace {

constexpr Color kBarePaper{0xff, 0xff, 0xff};
constexpr Color kDarkText{0, 0, 0};
constexpr double kTextContrast = 4.5;  // at least, as the guidelines have it
constexpr double kLineContrast = 3.0;
constexpr double kAroundLineMm = 0.25;
constexpr double kAroundTextCaps = 0.25;    // in heights of capitals
constexpr double kWidestLetterCaps = 0.85;  // of the letters of labels, on average at most

double channel(int value) {
    const double part = value / 255.0;
    return part <= 0.03928 ? part / 12.92 : std::pow((part + 0.055) / 1.055, 2.4);
}

double luminance(Color color) {
    return 0.2126 * channel(color.r) + 0.7152 * channel(color.g) + 0.0722 * channel(color.b);
}

bool is_line(Operation operation) {
    return operation == Operation::valley || operation == Operation::mountain ||
           operation == Operation::seam || operation == Operation::glue;
}

// What is painted on the piece, in the order of painting.
struct Painted {
    std::size_t shape;
    Box box;
};

class Halos {
 public:
    Halos(SheetDrawing& drawing, std::size_t first_shape) : drawing_(drawing) {
        bool any = false;
        for (std::size_t i = first_shape; i < drawing.shapes.size(); ++i) {
            const SheetShape& shape = drawing.shapes[i];
            if (shape.operation != Operation::fill || !shape.filled) continue;
            Box box;
            for (const Run& run : drawing.runs_of(shape)) {
                for (const Vec2 p : drawing.points_of(run)) box.extend(p);
            }
            painted_.push_back({i, box});
            any = any || shape.image >= 0 || contrast(shape.color, kBarePaper) > 1.0;
        }
        if (!any) painted_.clear();
    }

    [[nodiscard]] bool any() const { return !painted_.empty(); }

    // Whether something in this colour cannot be told from what is painted at one of the points.
    [[nodiscard]] bool hides(Color color, double least, std::span<const Vec2> points) const {
        return std::any_of(points.begin(), points.end(), [&](Vec2 p) {
            const SheetShape* under = top_at(p);
            return under != nullptr && (under->image >= 0 || contrast(color, under->color) < least);
        });
    }

    // The colour of a text that can be read there: its own if it may be, else black or white; nullopt: none.
    [[nodiscard]] std::optional<Color> seen_on(Color own, std::span<const Vec2> points) const {
        for (const Color color : {own, kDarkText, kBarePaper}) {
            if (!hides(color, kTextContrast, points)) return color;
        }
        return std::nullopt;
    }

    void paint(std::span<const std::array<Vec2, 4>> boxes, int piece, int plate) {
        if (boxes.empty()) return;
        SheetShape shape;
        shape.operation = Operation::fill;
        shape.first_run = drawing_.runs.size();
        shape.piece = piece;
        shape.plate = plate;
        shape.filled = true;
        shape.halo = true;
        shape.color = kBarePaper;
        for (const std::array<Vec2, 4>& corners : boxes) {
            drawing_.runs.push_back({drawing_.points.size(), corners.size(), true});
            drawing_.points.insert(drawing_.points.end(), corners.begin(), corners.end());
            ++shape.runs;
        }
        drawing_.shapes.push_back(shape);
    }

    // The same of a label that is drawn as the outlines of its letters.
    void show_letters(std::size_t number) {
        const SheetShape label = drawing_.shapes[number];
        Box box;
        for (const Run& run : drawing_.runs_of(label)) {
            for (const Vec2 p : drawing_.points_of(run)) box.extend(p);
        }
        if (box.empty()) return;
        const std::array seen{box.min, box.max, 0.5 * (box.min + box.max)};
        if (const auto fit = seen_on(label.color, seen)) {
            drawing_.shapes[number].color = *fit;
            return;
        }
        const double out = kAroundTextCaps * std::min(box.width(), box.height());
        const std::array<std::array<Vec2, 4>, 1> boxes{
            std::array{box.min + Vec2{-out, -out}, Vec2{box.max.x + out, box.min.y - out},
                       box.max + Vec2{out, out}, Vec2{box.min.x - out, box.max.y + out}}};
        paint(boxes, label.piece, -1);
    }

 private:
    [[nodiscard]] bool covers(const SheetShape& shape, Vec2 p) const {
        bool inside = false;
        for (const Run& run : drawing_.runs_of(shape)) {
            const auto points = drawing_.points_of(run);
            inside = inside != contains(Polygon{Ring(points.begin(), points.end()), {}}, p);
        }
        return inside;
    }
    [[nodiscard]] const SheetShape* top_at(Vec2 p) const {
        for (auto it = painted_.rbegin(); it != painted_.rend(); ++it) {
            const bool near =
                p.x >= it->box.min.x && p.x <= it->box.max.x && p.y >= it->box.min.y && p.y <= it->box.max.y;
            if (near && covers(drawing_.shapes[it->shape], p)) return &drawing_.shapes[it->shape];
        }
        return nullptr;
    }

    SheetDrawing& drawing_;
    std::vector<Painted> painted_;
};

std::array<Vec2, 4> around(Vec2 from, Vec2 to, double half) {
    const double length = distance(from, to);
    const Vec2 along = length > 0.0 ? (1.0 / length) * (to - from) : Vec2{1.0, 0.0};
    const Vec2 out = half * along;
    const Vec2 side{-out.y, out.x};
    return {from - out - side, to + out - side, to + out + side, from - out + side};
}

}  // namespace

double contrast(Color a, Color b) {
    const double one = luminance(a);
    const double other = luminance(b);
    return (std::max(one, other) + 0.05) / (std::min(one, other) + 0.05);
}

void put_halos(SheetDrawing& drawing, std::size_t first_shape, std::size_t first_text, bool folds_printed) {
    Halos halos(drawing, first_shape);
    if (!halos.any()) return;
    const std::size_t shapes = drawing.shapes.size();
    for (std::size_t i = first_shape; i < shapes; ++i) {
        const SheetShape shape = drawing.shapes[i];
        if (shape.operation == Operation::label && shape.filled) {
            halos.show_letters(i);
            continue;
        }
        if (!is_line(shape.operation) || shape.filled) continue;
        if (shape.operation != Operation::glue && !folds_printed) continue;
        const double half = 0.5 * shape.width_mm + kAroundLineMm;
        std::vector<std::array<Vec2, 4>> boxes;
        for (const Run& run : drawing.runs_of(shape)) {
            const std::span<const Vec2> points = drawing.points_of(run);
            for (std::size_t k = run.closed ? 0 : 1; k < points.size(); ++k) {
                const Vec2 from = points[k == 0 ? points.size() - 1 : k - 1];
                const Vec2 to = points[k];
                // Folds lie where two plates meet: look a little to either side, and along.
                const Vec2 aside = 0.01 * Vec2{from.y - to.y, to.x - from.x};
                const Vec2 middle = 0.5 * (from + to);
                const std::array seen{middle + aside, middle - aside, 0.75 * from + 0.25 * to + aside,
                                      0.25 * from + 0.75 * to - aside};
                if (halos.hides(shape.color, kLineContrast, seen)) boxes.push_back(around(from, to, half));
            }
        }
        halos.paint(boxes, shape.piece, shape.plate);
    }
    for (std::size_t i = first_text; i < drawing.texts.size(); ++i) {
        SheetText& text = drawing.texts[i];
        if (text.operation != Operation::label) continue;
        const double letters = static_cast<double>(text.text.size());
        const double reach = 0.5 * std::max(letters - 1.0, 0.0) * kWidestLetterCaps * text.cap_mm;
        const Vec2 along{std::cos(text.angle), std::sin(text.angle)};
        const Vec2 from = text.at - reach * along;
        const Vec2 to = text.at + reach * along;
        const std::array seen{from, text.at, to};
        if (const auto fit = halos.seen_on(text.color, seen)) {
            text.color = *fit;
            continue;
        }
        const double half = (0.5 + kAroundTextCaps) * text.cap_mm;
        const std::array<std::array<Vec2, 4>, 1> boxes{around(from, to, half)};
        halos.paint(boxes, text.piece, -1);
    }
}

}  // namespace popup
