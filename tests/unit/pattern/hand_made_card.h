// A card made by hand, without the code that makes assemblies of designs, and what tests ask of outlines.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "popup/assembly.h"
#include "popup/pattern.h"

namespace popup::test {

struct HandMadeCard {
    Assembly assembly;

    // A base page of two plates, 200 × 160 mm, with the gutter as its only fold.
    HandMadeCard() {
        assembly.file = "card.xml";
        assembly.pieces.push_back({"page", {0, 1}});
        Plate left;
        left.name = "page/left";
        left.outline.outer = {{-100, -80}, {0, -80}, {0, 80}, {-100, 80}};
        Plate right;
        right.name = "page/right";
        right.outline.outer = {{0, -80}, {100, -80}, {100, 80}, {0, 80}};
        assembly.plates = {left, right};
        const Ring corners{{-100, -80}, {100, -80}, {100, 80}, {-100, 80}};
        for (std::size_t i = 0; i < 4; ++i) cut(0, {corners[i], corners[(i + 1) % 4]});
        assembly.lines.push_back({LineKind::valley, {{0, -80}, {0, 80}}, 0, 0, 1});
    }

    void cut(int piece, Segment at) { assembly.lines.push_back({LineKind::cut, at, piece, -1, -1}); }

    // A symmetric v-fold: apex on the gutter, seams of this length at angle `a` from it, the piece's halves
    // `g` wide.
    void v_fold(double apex_y, double seam, double a, double g, double height) {
        const int piece = static_cast<int>(assembly.pieces.size());
        const int plate = static_cast<int>(assembly.plates.size());
        const std::string id = "v" + std::to_string(piece);
        const Vec2 apex{0, apex_y};
        const Vec2 end_left = apex + seam * Vec2{-std::sin(a), std::cos(a)};
        const Vec2 end_right = apex + seam * Vec2{std::sin(a), std::cos(a)};
        const Vec2 e{0, 0};
        const Vec2 g_at = seam * Vec2{-std::sin(g), std::cos(g)};
        const Vec2 h_at = seam * Vec2{std::sin(g), std::cos(g)};
        const double top = std::max(0.0, g_at.y) + height;
        const Vec2 i_at{g_at.x, top};
        const Vec2 j_at{h_at.x, top};
        const Vec2 f{0, top};
        assembly.pieces.push_back({id, {plate, plate + 1}});
        Plate left;
        left.name = id + "/left";
        left.piece = piece;
        left.outline.outer = {g_at, e, f, i_at};
        left.fill = Color{255, 0, 0};
        Plate right;
        right.name = id + "/right";
        right.piece = piece;
        right.outline.outer = {e, h_at, j_at, f};
        assembly.plates.push_back(left);
        assembly.plates.push_back(right);
        cut(piece, {h_at, j_at});
        cut(piece, {j_at, f});
        cut(piece, {f, i_at});
        cut(piece, {i_at, g_at});
        // The waist may call a glued edge a seam; the pattern then draws it once.
        assembly.lines.push_back({LineKind::seam, {g_at, e}, piece, plate, -1});
        assembly.lines.push_back({LineKind::mountain, {e, f}, piece, plate, plate + 1});
        const std::string label = std::to_string(piece);
        assembly.glue.push_back(
            {plate, 0, {e, g_at}, {apex, end_left}, label + "L", Color{1, 2, 3}, id, {7, 3}});
        assembly.glue.push_back({plate + 1, 1, {h_at, e}, {end_right, apex}, label + "R", {}, id, {7, 3}});
    }

    Pattern pattern(const PatternOptions& options = {}) {
        diagnostics = Diagnostics("card.xml");
        auto result = make_pattern(assembly, options, diagnostics);
        EXPECT_TRUE(result.has_value());
        return result.value_or(Pattern{});
    }
    Diagnostics diagnostics;
};

inline std::vector<Segment> sides_of(const Ring& ring) {
    std::vector<Segment> result;
    for (std::size_t i = 0; i < ring.size(); ++i) result.push_back({ring[i], ring[(i + 1) % ring.size()]});
    return result;
}

inline std::vector<Segment> sides_of(const Contour& contour) {
    auto result = sides_of(contour.points);
    if (!contour.closed) result.pop_back();
    return result;
}

}  // namespace popup::test
