#include "support/dielines.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <numbers>
#include <vector>

#include "popup/geometry.h"

namespace popup::test {
namespace {

// A panel hangs on an edge of another by its own edge 0; its edges 1, 2 and 3 follow counterclockwise.
struct Panel {
    std::array<Vec2, 4> corners;
    struct Child {
        int edge;
        double from, to;  // mm along it
        double deg;
    };
    std::vector<Child> children;
};

// What hangs on an edge: where, in mm from both of its ends, how far it reaches, by how much it is narrower
// there at each end, and how far it is folded.
struct Flap {
    double depth, deg;
    double begin = 0.0, end = 0.0;
    double taper = 0.0;
};

class Dieline {
 public:
    Dieline(double wide, double high) {
        panels_.push_back({{Vec2{0, 0}, Vec2{wide, 0}, Vec2{wide, high}, Vec2{0, high}}, {}});
    }

    // The number of the new panel.
    int hang(int on, int edge, const Flap& flap) {
        const auto [a, b] = ends(on, edge);
        const Vec2 along = unit(b - a);
        const Vec2 out{along.y, -along.x};
        const double wide = distance(a, b);
        const Vec2 from = a + flap.begin * along;
        const Vec2 to = b - flap.end * along;
        // Seen from the flap, its own edge goes the other way.
        const Vec2 far_from = from + flap.depth * out + flap.taper * along;
        const Vec2 far_to = to + flap.depth * out - flap.taper * along;
        at(on).children.push_back({edge, flap.begin, wide - flap.end, flap.deg});
        panels_.push_back({{to, from, far_from, far_to}, {}});
        return static_cast<int>(panels_.size()) - 1;
    }

    // With `angles` folds say how far they go.
    [[nodiscard]] std::string svg(bool angles = true) const {
        std::string lines;
        Vec2 least{HUGE_VAL, HUGE_VAL};
        Vec2 most{-HUGE_VAL, -HUGE_VAL};
        for (std::size_t i = 0; i < panels_.size(); ++i) {
            for (const Vec2 p : panels_[i].corners) {
                least = {std::min(least.x, p.x), std::min(least.y, p.y)};
                most = {std::max(most.x, p.x), std::max(most.y, p.y)};
            }
            for (int edge = i == 0 ? 0 : 1; edge < 4; ++edge)
                add_edge(static_cast<int>(i), edge, angles, lines);
        }
        const Vec2 size = most - least;
        return fmt::format(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.4f}mm\" height=\"{1:.4f}mm\" "
            "viewBox=\"{2:.4f} {3:.4f} {0:.4f} {1:.4f}\">\n{4}</svg>\n",
            size.x, size.y, least.x, -most.y, lines);
    }

 private:
    Panel& at(int panel) { return panels_[static_cast<std::size_t>(panel)]; }
    [[nodiscard]] std::pair<Vec2, Vec2> ends(int panel, int edge) const {
        const auto& corners = panels_[static_cast<std::size_t>(panel)].corners;
        return {corners.at(static_cast<std::size_t>(edge)),
                corners.at(static_cast<std::size_t>(edge + 1) % 4)};
    }

    static void add_line(Vec2 a, Vec2 b, const std::string& kind, std::string& lines) {
        if (distance(a, b) < 1e-6) return;
        fmt::format_to(std::back_inserter(lines), "  <path d=\"M{:.4f} {:.4f}L{:.4f} {:.4f}\" {}/>\n", a.x,
                       -a.y, b.x, -b.y, kind);
    }

    // Folds where something hangs, cuts elsewhere.
    void add_edge(int panel, int edge, bool angles, std::string& lines) const {
        const auto [a, b] = ends(panel, edge);
        const Vec2 along = unit(b - a);
        const std::string cut = "class=\"cut\" stroke=\"#000\"";
        std::vector<Panel::Child> here;
        for (const Panel::Child& one : panels_[static_cast<std::size_t>(panel)].children) {
            if (one.edge == edge) here.push_back(one);
        }
        std::sort(here.begin(), here.end(), [](const auto& p, const auto& q) { return p.from < q.from; });
        double done = 0.0;
        for (const Panel::Child& one : here) {
            add_line(a + done * along, a + one.from * along, cut, lines);
            const char* const way =
                one.deg < 0.0 ? "class=\"mountain\" stroke=\"#f00\"" : "class=\"valley\" stroke=\"#00f\"";
            const std::string deg =
                angles ? fmt::format(" data-fold-angle=\"{:g}\"", std::abs(one.deg)) : std::string();
            add_line(a + one.from * along, a + one.to * along, way + deg, lines);
            done = one.to;
        }
        add_line(a + done * along, b, cut, lines);
    }

    std::vector<Panel> panels_;
};

// Walls side by side, each on edge 1 of the one before; of the glue flap comes last.
std::vector<int> add_walls(Dieline& sheet, int sides, double wide) {
    const double deg = std::round(360.0 / sides);
    std::vector<int> walls{0};
    for (int i = 1; i < sides; ++i) walls.push_back(sheet.hang(walls.back(), i == 1 ? 1 : 2, {wide, deg}));
    sheet.hang(walls.back(), 2, {14.0, deg, 0.0, 0.0, 6.0});
    return walls;
}

}  // namespace

std::string pointed_tube(int sides) {
    constexpr double kWide = 30.0;
    Dieline sheet(kWide, 120.0);
    const double high = 0.5 * kWide / std::tan(std::numbers::pi / sides);
    const double clear = 0.1;  // flaps are a little narrower than their walls, and blunt
    for (const int wall : add_walls(sheet, sides, kWide)) {
        for (const bool top : {false, true}) {
            const int edge = wall == 0 ? (top ? 2 : 0) : (top ? 1 : 3);
            const double half = 0.5 * kWide - clear;
            const double blunt = 0.2;
            sheet.hang(wall, edge, {high * (1.0 - (clear + blunt) / half), 90.0, clear, clear, half - blunt});
        }
    }
    return sheet.svg();
}

std::string locked_tube(int sides) {
    constexpr double kWide = 40.0;
    Dieline sheet(kWide, 90.0);
    for (const int wall : add_walls(sheet, sides, kWide)) {
        for (const bool top : {false, true}) {
            const int edge = wall == 0 ? (top ? 2 : 0) : (top ? 1 : 3);
            const double taper = 12.0 * std::tan(std::numbers::pi / sides);
            const int flap = sheet.hang(wall, edge, {12.0, 90.0, 0.3, 0.3, taper});
            sheet.hang(flap, 2, {15.0, 90.0, 1.0, 1.0, 4.0});
        }
    }
    return sheet.svg();
}

std::string locked_tray() {
    constexpr double kWide = 200.0;
    constexpr double kDeep = 140.0;
    constexpr double kHigh = 50.0;
    constexpr double kRoll = 1.5;  // the top of a wall that is rolled in
    Dieline sheet(kWide, kDeep);
    const int front = sheet.hang(0, 0, {kHigh, 90.0});
    const int back = sheet.hang(0, 2, {kHigh, 90.0});
    for (const int wall : {front, back}) {
        for (const int side : {1, 3}) sheet.hang(wall, side, {30.0, 90.0, 1.0, 1.0, 3.0});
    }
    // Three walls are rolled in, with flaps on the base that lock there.
    for (const int side : {1, 3, 0}) {
        const bool is_front = side == 0;
        const int outer = is_front ? front : sheet.hang(0, side, {kHigh, 90.0, 0.5, 0.5});
        const double in = is_front ? 4.0 : 1.0;  // the sides are in front of it
        const int roll = sheet.hang(outer, 2, {kRoll, 90.0, in, in});
        const int inner = sheet.hang(roll, 2, {kHigh - (is_front ? 2.0 : 1.0), 90.0, 0.5, 0.5});
        const double wide = is_front ? kWide - 9.0 : kDeep - 4.0;
        const double end = is_front ? 20.0 : 0.5;
        const int flange = sheet.hang(inner, 2, {15.0, -90.0, end, end, is_front ? 4.0 : 15.0});
        const double edge = wide - 2.0 * (end + (is_front ? 4.0 : 15.0));
        for (const double at : {0.1, 0.4, 0.7})
            sheet.hang(flange, 2, {8.0, -10.0, at * edge, (0.8 - at) * edge, 3.0});
    }
    const int lid = sheet.hang(back, 2, {kDeep - 2.0, 90.0, 2.5, 2.5});
    const int lip = sheet.hang(lid, 2, {30.0, 90.0, 0.5, 0.5});
    for (const int side : {1, 3}) {
        sheet.hang(lip, side, {20.0, 90.0, 1.0, 1.0, 3.0});
        const double beside_back = 16.0;
        const double beside_lip = 1.0;
        const bool first = side == 1;  // its edge begins at the back
        const int flap = sheet.hang(
            lid, side, {25.0, 90.0, first ? beside_back : beside_lip, first ? beside_lip : beside_back, 2.0});
        sheet.hang(flap, first ? 1 : 3, {12.0, 90.0, 3.0, 3.0, 3.0});
        for (const double at : {20.0, 72.0}) sheet.hang(flap, 2, {8.0, 10.0, at, 117.0 - at - 25.0, 3.0});
    }
    for (const double at : {25.0, 82.0, 139.0}) sheet.hang(lip, 2, {10.0, 10.0, at, 194.0 - at - 30.0, 3.0});
    return sheet.svg();
}

std::string rolled_tray(double roll, bool angles) {
    constexpr double kHigh = 40.0;
    Dieline sheet(160.0, 120.0);
    for (const int edge : {0, 1, 2, 3}) {
        const int outer = sheet.hang(0, edge, {kHigh, 90.0});
        const int top = sheet.hang(outer, 2, {roll, 90.0, roll, roll});
        sheet.hang(top, 2, {kHigh, 90.0});
    }
    return sheet.svg(angles);
}

std::string tucked_mailer(bool angles, bool ears) {
    constexpr double kWide = 180.0;
    constexpr double kDeep = 110.0;
    constexpr double kHigh = 45.0;
    Dieline sheet(kWide, kDeep);
    const int front = sheet.hang(0, 0, {kHigh, 90.0});
    const int back = sheet.hang(0, 2, {kHigh, 90.0});
    for (const int wall : {front, back}) {
        for (const int side : {1, 3}) sheet.hang(wall, side, {40.0, 90.0, 1.0, 1.0, 2.0});
    }
    for (const int edge : {1, 3}) {
        const int outer = sheet.hang(0, edge, {kHigh, 90.0, 0.5, 0.5});
        const int top = sheet.hang(outer, 2, {2.0, 90.0, 0.5, 0.5});
        sheet.hang(top, 2, {kHigh - 1.0, 90.0, 0.5, 0.5});
    }
    const int lid = sheet.hang(back, 2, {kDeep - 1.0, 90.0, 3.0, 3.0});
    const int tuck = sheet.hang(lid, 2, {35.0, 90.0, 0.5, 0.5});
    for (const int side : {1, 3}) {
        if (!ears) continue;
        sheet.hang(tuck, side, {22.0, 90.0, 1.0, 1.0, 5.0});
        sheet.hang(lid, side, {30.0, 90.0, 2.0, 2.0, 6.0});
    }
    return sheet.svg(angles);
}

std::string tray_with_corners() {
    Dieline sheet(120.0, 80.0);
    for (const int edge : {0, 2}) {
        const int wall = sheet.hang(0, edge, {30.0, 90.0});
        for (const int side : {1, 3}) sheet.hang(wall, side, {18.0, 90.0, 0.0, 0.0, 3.0});
    }
    for (const int edge : {1, 3}) sheet.hang(0, edge, {30.0, 90.0});
    return sheet.svg();
}

}  // namespace popup::test
