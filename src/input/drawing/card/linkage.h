// Whether folds that go from one plate of a fold over others to its other plate can move: they are parallel
// to it, or meet in one point of it, and the middle one lies where it closes flat.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "popup/geometry.h"

namespace popup::drawing::card {

// A fold that features stand on, with a plate on its left and one on its right.
struct Drive {
    int left = 0, right = 0;    // plates
    Vec2 at, dir;               // unit
    double lo = 0.0, hi = 0.0;  // along it, from `at`
    bool mountain = false;
    int element = 0;

    // Along it, and away from it to the left.
    [[nodiscard]] Vec2 there(Vec2 p) const { return {dot(dir, p - at), cross(dir, p - at)}; }
    [[nodiscard]] Vec2 back(Vec2 sw) const { return at + sw.x * dir + sw.y * left_of(dir); }
};

// A straight fold between two plates, drawn in one or several stretches.
struct FoldLine {
    Segment line;            // from its first point to its last
    std::vector<int> edges;  // of the graph
};

// Which fold a line between the plates of a feature is.
enum class MidFold { centre, drive };

struct Linkage {
    bool parallel = true;
    // Of parallel folds: distances of the side folds from the drive, both above 0.
    double left = 0.0, right = 0.0;
    // Of folds that meet: where on the drive, which way they run (1: along it), and their angles to it.
    double apex = 0.0;
    int way = 1;
    double left_angle = 0.0, right_angle = 0.0;
    double off = 0.0;           // how far what is drawn is from it, mm
    std::vector<MidFold> mids;  // of what is drawn between the side folds, from left to right

    // The line on which a fold lies, as far as it was drawn. It runs as the drive does, so that the plate of
    // the feature that is nearer to the drive's left is on its left.
    [[nodiscard]] Segment left_line(const Drive& drive, const Segment& drawn) const;
    [[nodiscard]] Segment right_line(const Drive& drive, const Segment& drawn) const;
    [[nodiscard]] Segment centre_line(const Drive& drive, const Segment& drawn) const;
};

// Why lines make no linkage, for people.
struct NoLinkage {
    std::string what;
    double off = HUGE_VAL;  // mm
};

// The side folds lie on the left and on the right of the drive; what is drawn between them, from left to
// right, may be the centre fold, and the drive's own line where it was drawn on and on. Lines may be off by
// kSnapMm. Where there is none, `why` says what is nearest to one.
std::optional<Linkage> find_linkage(const Drive& drive, const Segment& left, const std::vector<Segment>& mids,
                                    const Segment& right, NoLinkage& why);

// True of a line that lies within kSnapMm of the drive's, up to its ends and beyond.
bool runs_along(const Drive& drive, const Segment& line);

}  // namespace popup::drawing::card
