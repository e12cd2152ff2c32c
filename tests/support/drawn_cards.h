// Cards as lines, drawn in the ways of several programs, for tests of their reader.
#pragma once

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "popup/geometry.h"
#include "popup/path.h"
#include "support/line_sets.h"
#include "support/random.h"

namespace popup::test {

enum class Pen { cut, mountain, valley };
inline constexpr std::array<std::string_view, 3> kPenNames{"cut", "mountain", "valley"};

// A line of a card, on its page: x across the gutter, y along it, the origin in the middle.
struct InkedLine {
    Pen pen = Pen::cut;
    std::vector<Vec2> points;  // of straight lines; of a curve four: a cubic
    bool curve = false;
    bool closed = false;
};

struct InkedCard {
    double width = 200.0, height = 160.0;
    std::vector<InkedLine> lines;  // without the border
    int features = 0;

    void line(Pen pen, std::vector<Vec2> points, bool closed = false) {
        lines.push_back({pen, std::move(points), false, closed});
    }
    void cubic(Pen pen, Vec2 a, Vec2 b, Vec2 c, Vec2 d) { lines.push_back({pen, {a, b, c, d}, true, false}); }

    // What is to be on the sheet, by its own formulas.
    [[nodiscard]] LineSets sets() const {
        LineSets sets;
        const double x = 0.5 * width;
        const double y = 0.5 * height;
        add_polyline(sets, "cut", {{-x, -y}, {x, -y}, {x, y}, {-x, y}}, true);
        for (const InkedLine& line : lines) {
            const std::string kind(kPenNames.at(static_cast<std::size_t>(line.pen)));
            if (!line.curve) {
                add_polyline(sets, kind, line.points, line.closed);
                continue;
            }
            std::vector<Vec2> points;
            const std::vector<Vec2>& p = line.points;
            for (int i = 0; i <= 100; ++i) {
                const double t = i / 100.0;
                const double u = 1.0 - t;
                points.push_back(u * u * u * p[0] + 3.0 * u * u * t * p[1] + 3.0 * u * t * t * p[2] +
                                 t * t * t * p[3]);
            }
            add_polyline(sets, kind, points);
        }
        return sets;
    }
};

// How a drawing program would write it.
enum class Hand {
    simulator,    // solid colours, one element a line, size in mm
    illustrator,  // classes of a style sheet in Illustrator's colours, points
    corel,        // classes fil0 str0, hundredths of mm in a viewBox
    inkscape,     // layers with labels, styles inline, a transform a layer, black
    dashes,       // black: dashes for valleys, dots among dashes for mountains
    workshop,     // this program's own colours, without its layers
};
inline constexpr std::array<Hand, 6> kHands{Hand::simulator, Hand::illustrator, Hand::corel,
                                            Hand::inkscape,  Hand::dashes,      Hand::workshop};

struct HandOptions {
    bool lying = false;    // the gutter goes across the drawing
    double jitter = 0.0;   // of ends, at most, mm
    bool doubled = false;  // every third line is drawn twice
    bool reversed = true;  // some lines are drawn backwards
};

class CardDrawer {
 public:
    CardDrawer(const InkedCard& card, Hand hand, const HandOptions& options, std::uint64_t seed)
        : card_(card), hand_(hand), options_(options), random_(seed) {}

    std::string run() {
        // Units of the drawing a millimetre.
        scale_ = hand_ == Hand::illustrator ? 72.0 / 25.4 : hand_ == Hand::corel ? 100.0 : 1.0;
        const double w = 20.0 + (options_.lying ? card_.height : card_.width);
        const double h = 20.0 + (options_.lying ? card_.width : card_.height);
        std::string size = fmt::format("width=\"{}mm\" height=\"{}mm\"", w, h);
        if (hand_ == Hand::illustrator)
            size = fmt::format("width=\"{:.6f}pt\" height=\"{:.6f}pt\"", scale_ * w, scale_ * h);
        text_ = fmt::format(
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" "
            "xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\" {} viewBox=\"0 0 {:.6f} "
            "{:.6f}\">\n",
            size, scale_ * w, scale_ * h);
        begin();
        for (const Pen pen : {Pen::cut, Pen::mountain, Pen::valley}) layer(pen);
        text_ += "</svg>\n";
        return text_;
    }

 private:
    void begin() {
        if (hand_ == Hand::illustrator) {
            text_ +=
                "<defs><style>.cls-1,.cls-2,.cls-3{fill:none;stroke-miterlimit:10;}.cls-1{stroke:#231f20;}"
                ".cls-2{stroke:#ed1c24;}.cls-3{stroke:#2e3192;}</style></defs>\n";
        }
        if (hand_ == Hand::corel) {
            text_ +=
                "<defs><style type=\"text/css\"><![CDATA[ .str0 {stroke:#2B2A29;stroke-width:20} "
                ".str1 {stroke:#E31E24;stroke-width:20} .str2 {stroke:#0000FF;stroke-width:20} "
                ".fil0 {fill:none} ]]></style></defs>\n<g id=\"Layer_x0020_1\">\n"
                "<metadata id=\"CorelCorpID_0Corel-Layer\"/>\n</g>\n";
        }
    }

    void layer(Pen pen) {
        constexpr std::array<std::string_view, 3> kLayers{"Cuts", "Mountain folds", "Valley folds"};
        const bool inkscape = hand_ == Hand::inkscape;
        if (inkscape) {
            shift_ = {random_.unit() * 30.0 - 15.0, random_.unit() * 30.0 - 15.0};
            text_ += fmt::format(
                "<g inkscape:groupmode=\"layer\" inkscape:label=\"{}\" id=\"layer{}\" "
                "transform=\"translate({:.6f},{:.6f})\" "
                "style=\"fill:none;stroke:#000000;stroke-width:0.2\">\n",
                kLayers.at(static_cast<std::size_t>(pen)), static_cast<int>(pen) + 1, -shift_.x, -shift_.y);
        }
        if (pen == Pen::cut) {
            const double x = 0.5 * card_.width;
            const double y = 0.5 * card_.height;
            write({Pen::cut, {{-x, -y}, {x, -y}, {x, y}, {-x, y}}, false, true});
        }
        int count = 0;
        for (const InkedLine& line : card_.lines) {
            if (line.pen != pen) continue;
            write(jittered(line));
            if (options_.doubled && ++count % 3 == 0) write(line);
        }
        if (inkscape) text_ += "</g>\n";
    }

    InkedLine jittered(InkedLine line) {
        if (options_.jitter == 0.0 || line.closed || line.curve) return line;
        // Along the line, so that it stops short of what it meets or runs over it.
        std::vector<Vec2>& p = line.points;
        const Vec2 first = unit(p[1] - p[0]);
        const Vec2 last = unit(p[p.size() - 1] - p[p.size() - 2]);
        p.front() = p.front() + options_.jitter * (2.0 * random_.unit() - 1.0) * first;
        p.back() = p.back() + options_.jitter * (2.0 * random_.unit() - 1.0) * last;
        return line;
    }

    [[nodiscard]] std::string stroke(Pen pen) const {
        const auto of = [&](std::array<std::string_view, 3> texts) {
            return std::string(texts.at(static_cast<std::size_t>(pen)));
        };
        switch (hand_) {
            case Hand::simulator:
                return of({"fill=\"none\" stroke=\"#000000\"", "fill=\"none\" stroke=\"#FF0000\"",
                           "fill=\"none\" stroke=\"#0000FF\""});
            case Hand::illustrator:
                return of({"class=\"cls-1\"", "class=\"cls-2\"", "class=\"cls-3\""});
            case Hand::corel:
                return of({"class=\"fil0 str0\"", "class=\"fil0 str1\"", "class=\"fil0 str2\""});
            case Hand::inkscape:
                return "";
            case Hand::dashes:
                return of({"style=\"fill:none;stroke:black\"",
                           "style=\"fill:none;stroke:black;stroke-dasharray:4,1,1,1\"",
                           "style=\"fill:none;stroke:black;stroke-dasharray:2,1\""});
            case Hand::workshop:
                return of({"fill=\"none\" stroke=\"#ff0000\"",
                           "fill=\"none\" stroke=\"#0000ff\" stroke-dasharray=\"5 1 1 1\"",
                           "fill=\"none\" stroke=\"#ff00ff\" stroke-dasharray=\"3 1.5\""});
        }
        return "";
    }

    // On the drawing, whose y points down.
    [[nodiscard]] std::string at(Vec2 p) const {
        Vec2 d = options_.lying ? Vec2{0.5 * card_.height + p.y, 0.5 * card_.width + p.x}
                                : Vec2{0.5 * card_.width + p.x, 0.5 * card_.height - p.y};
        d = d + Vec2{10.0, 10.0} + shift_;
        return fmt::format("{:.6f} {:.6f}", scale_ * d.x, scale_ * d.y);
    }

    void write(InkedLine line) {
        if (options_.reversed && random_.below(2) == 0) std::reverse(line.points.begin(), line.points.end());
        const std::string pen = stroke(line.pen);
        const std::vector<Vec2>& p = line.points;
        if (line.curve) {
            text_ +=
                fmt::format("<path {} d=\"M{}C{} {} {}\"/>\n", pen, at(p[0]), at(p[1]), at(p[2]), at(p[3]));
            return;
        }
        std::string points;
        for (const Vec2 q : p) points += (points.empty() ? "" : " ") + at(q);
        if (line.closed && random_.below(2) == 0)
            text_ += fmt::format("<polygon {} points=\"{}\"/>\n", pen, points);
        else if (!line.closed && random_.below(2) == 0)
            text_ += fmt::format("<polyline {} points=\"{}\"/>\n", pen, points);
        else
            text_ += fmt::format("<path {} d=\"M{}{}\"/>\n", pen, points, line.closed ? "z" : "");
    }

    const InkedCard& card_;
    Hand hand_;
    HandOptions options_;
    Random random_;
    double scale_ = 1.0;
    Vec2 shift_;
    std::string text_;
};

inline std::string draw_card(const InkedCard& card, Hand hand, const HandOptions& options = {},
                             std::uint64_t seed = 1) {
    return CardDrawer(card, hand, options, seed).run();
}

// Cards at random: features on the gutter, and on the folds of features, to a depth of four. Every fold is
// where the parallelogram's and the beak's rules have it.
class CardMaker {
 public:
    explicit CardMaker(std::uint64_t seed) : random_(seed) {}

    InkedCard run() {
        card_.width = 2.0 * std::round(uniform(80.0, 140.0));
        card_.height = std::round(uniform(120.0, 220.0));
        Ground gutter;
        gutter.dir = {0.0, 1.0};
        gutter.at = {0.0, -0.5 * card_.height};
        gutter.length = card_.height;
        gutter.left = gutter.right = 0.5 * card_.width;
        fill(gutter, 0);
        if (random_.below(2) == 0) {
            const double x = 0.5 * card_.width - 3.0;
            card_.line(Pen::cut, {{x, 0.0}, {x - 4.0, 1.0}, {x - 2.0, 4.0}}, true);
        }
        return card_;
    }

 private:
    // A fold with the paper on its two sides, as wide as it is free.
    struct Ground {
        Vec2 at, dir;
        double length = 0.0;
        double left = 0.0, right = 0.0;
        bool mountain = false;

        [[nodiscard]] Vec2 point(double s, double w) const { return at + s * dir + w * left_of(dir); }
    };

    double uniform(double lo, double hi) { return lo + (hi - lo) * random_.unit(); }

    [[nodiscard]] static Pen pen(bool mountain) { return mountain ? Pen::mountain : Pen::valley; }

    // Draws the fold, with what stands on it in between.
    void fill(const Ground& ground, int depth) {
        constexpr double kLeast = 14.0;
        constexpr double kRoom = 3.0;
        double s = kRoom;
        double from = 0.0;
        const bool deep = ground.left > 12.0 && ground.right > 12.0 && depth < 4;
        while (deep && s + kLeast + kRoom < ground.length && card_.features < 12) {
            const double lo = s + uniform(0.0, 6.0);
            const double hi = std::min(lo + uniform(kLeast, 50.0), ground.length - kRoom);
            if (hi - lo < kLeast) break;
            const auto [on, off] =
                random_.below(4) == 0 ? beak(ground, lo, hi) : feature(ground, lo, hi, depth);
            card_.line(pen(ground.mountain), {ground.point(from, 0.0), ground.point(on, 0.0)});
            from = off;
            s = hi + kRoom;
            if (depth > 0) break;
        }
        card_.line(pen(ground.mountain), {ground.point(from, 0.0), ground.point(ground.length, 0.0)});
    }

    // Where it begins and ends on the fold.
    std::pair<double, double> beak(const Ground& g, double lo, double hi) {
        ++card_.features;
        const double most = std::min({g.left, g.right, hi - lo}) - 3.0;
        const double p = uniform(4.0, std::max(5.0, most));
        const double q = uniform(4.0, std::max(5.0, most));
        const bool back = random_.below(2) == 0;
        const double apex = back ? hi : lo;
        const double base = back ? lo : hi;
        const double a = std::atan2(p, hi - lo);
        const double b = std::atan2(q, hi - lo);
        const Vec2 top = g.point(apex, 0.0);
        const Vec2 left = g.point(base, p);
        const Vec2 right = g.point(base, -q);
        // The centre fold lies at the angle a - b, where it meets the cut.
        const Vec2 centre = g.point(base, (hi - lo) * std::tan(a - b));
        card_.line(Pen::cut, {left, right});
        card_.line(pen(g.mountain), {top, left});
        card_.line(pen(g.mountain), {right, top});
        card_.line(pen(!g.mountain), {top, centre});
        return {lo, hi};
    }

    std::pair<double, double> feature(const Ground& g, double lo, double hi, int depth) {
        ++card_.features;
        const double p = uniform(5.0, std::min(g.left - 3.0, 60.0));
        const double q =
            random_.below(4) == 0 ? std::min(p, g.right - 3.0) : uniform(5.0, std::min(g.right - 3.0, 60.0));
        // Cuts are straight, or lean, or are curves that bend once.
        const auto kind = random_.below(3);
        const double lean = kind == 0 ? 0.0 : uniform(-2.0, 2.0);
        const double bend = kind == 2 ? uniform(0.5, 2.0) : 0.0;
        const auto edge = [&](double s, double w, double out) {
            // A parabola through its ends, which a cubic draws exactly.
            const double t = (w + q) / (p + q);
            return g.point(s + lean * (t - 0.5) + out * bend * 4.0 * t * (1.0 - t), w);
        };
        for (const auto& [s, out] : {std::pair{lo + 1.0, 1.0}, {hi - 1.0, -1.0}}) {
            const Vec2 a = edge(s, p, out);
            const Vec2 b = edge(s, -q, out);
            if (bend == 0.0) {
                card_.line(Pen::cut, {a, b});
                continue;
            }
            // The control point of the parabola is where its end tangents meet.
            const Vec2 apex = 2.0 * edge(s, 0.5 * (p - q), out) - 0.5 * (a + b);
            card_.cubic(Pen::cut, a, lerp(a, apex, 2.0 / 3.0), lerp(b, apex, 2.0 / 3.0), b);
        }
        const auto fold = [&](double w, double left, double right, bool mountain) {
            Ground made;
            made.at = edge(lo + 1.0, w, 1.0);
            const Vec2 end = edge(hi - 1.0, w, -1.0);
            made.dir = g.dir;
            made.length = distance(made.at, end);
            made.left = left;
            made.right = right;
            made.mountain = mountain;
            return made;
        };
        // One of them may have something stand on it, and the others are plain.
        const Ground none = fold(p, 0.0, 0.0, g.mountain);
        const auto chosen = random_.below(3);
        fill(chosen == 0 ? fold(p, g.left - p, q, g.mountain) : none, depth + 1);
        fill(chosen == 1 ? fold(p - q, q, p, !g.mountain) : fold(p - q, 0.0, 0.0, !g.mountain), depth + 1);
        fill(chosen == 2 ? fold(-q, p, g.right - q, g.mountain) : fold(-q, 0.0, 0.0, g.mountain), depth + 1);
        const auto crossing = [&](double s, double out) { return dot(g.dir, edge(s, 0.0, out) - g.at); };
        return {crossing(lo + 1.0, 1.0), crossing(hi - 1.0, -1.0)};
    }

    Random random_;
    InkedCard card_;
};

}  // namespace popup::test
