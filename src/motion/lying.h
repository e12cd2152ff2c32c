// Plates of two elements in one place: they lie on one another while the card stands half open.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "motion/linkage.h"
#include "motion/plate_shape.h"
#include "popup/assembly.h"

namespace popup {

// Two plates that have one plane at two openings, and more than a square millimetre of it in common.
struct LyingPair {
    int a = 0, b = 0;  // a < b
    double area_mm2 = 0.0;
    Vec2 point;   // the middle of the largest part that they share, on the page of b
    Vec2 size{};  // width and height of that part, on the page of b
};

// Such pairs of plates of two elements, by a, b: of each element the one that shares most with an earlier
// one, among the 200 earlier plates, at most, that each of its plates is held against. Two openings tell what
// lies there from what only passes. Plates that lie flat on another by what they are (layers, discs), or are
// turned by hand, are not meant, nor two that are glued flat to one plate. None of an assembly without
// covers, and none where the joints do not reach. Cost: n log n in plates, and in pairs of parallel plates
// that are near each other.
std::vector<LyingPair> find_lying(const Assembly& assembly, const Linkage& linkage,
                                  std::span<const PlateShape> shapes);

// Such pairs of a plate that is `moved` (by number) and one that is not: all of them, by a, b.
std::vector<std::pair<int, int>> lying_with(const Assembly& assembly, const Linkage& linkage,
                                            std::span<const PlateShape> shapes,
                                            const std::vector<char>& moved);

// Whether any of some pairs of plates shares a plane and any paper at all.
bool any_lies(const Assembly& assembly, std::span<const PlateShape> shapes,
              std::span<const std::pair<int, int>> pairs);

}  // namespace popup
