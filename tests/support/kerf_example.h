// Pieces for tests of kerf compensation, and what becomes of them.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "fabrication/kerf.h"

namespace popup::test {

inline Contour closed(Ring points, int depth = 0) { return {std::move(points), true, depth}; }

inline Ring reversed(Ring ring) {
    std::reverse(ring.begin() + 1, ring.end());
    return ring;
}

inline Ring turned(Ring ring, double angle, Vec2 by = {}) {
    for (Vec2& p : ring) p = rotated(p, angle) + by;
    return ring;
}

inline Ring rectangle_at(double x, double y, double w, double h) {
    return {{x, y}, {x + w, y}, {x + w, y + h}, {x, y + h}};
}

inline PatternPiece piece_of(std::vector<Contour> cuts) {
    PatternPiece piece;
    piece.name = "page";
    piece.cuts = std::move(cuts);
    return piece;
}

struct Outcome {
    std::optional<std::vector<Contour>> cuts;
    std::vector<Diagnostic> found;
};

inline Outcome attempt(const PatternPiece& piece, const KerfWidths& kerf) {
    Diagnostics diagnostics("card.xml");
    Outcome result{compensated(piece, "castle:page", kerf, diagnostics), {}};
    result.found = diagnostics.sorted();
    return result;
}

// The moved hole, which is given and returned clockwise, of a large sheet.
inline Outcome move_hole(const Ring& hole, double kerf) {
    return attempt(piece_of({closed(hole, 1), closed(rectangle_at(-500, -500, 1000, 1000))}), {kerf, kerf});
}

inline void expect_error(const Outcome& result, const std::string& words) {
    EXPECT_FALSE(result.cuts.has_value()) << words;
    ASSERT_EQ(result.found.size(), 1U) << words;
    const Diagnostic& finding = result.found[0];
    EXPECT_EQ(finding.code, "kerf-too-wide");
    EXPECT_EQ(finding.severity, Severity::error);
    EXPECT_NE(finding.message.find("castle:page"), std::string::npos) << finding.message;
    EXPECT_NE(finding.message.find(words), std::string::npos) << finding.message;
    EXPECT_FALSE(finding.hints.empty());
}

inline std::vector<Segment> edges(const Ring& ring) {
    std::vector<Segment> result;
    for (std::size_t i = 0; i < ring.size(); ++i) result.push_back({ring[i], ring[(i + 1) % ring.size()]});
    return result;
}

inline double distance_to(const Ring& ring, Vec2 p) {
    double best = HUGE_VAL;
    for (const Segment& s : edges(ring)) best = std::min(best, distance(p, s));
    return best;
}

}  // namespace popup::test
