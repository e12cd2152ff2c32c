// Divides the border of something cut from a sheet along a straight line.
//
// Where the paper lies on both sides of the line, it is divided there: each such stretch is a chord, and
// belongs to the part above it, on the left of the line's direction, and to the one below it. A border
// without holes makes a tree of parts and chords.
//
//     const Division made = divide(border, level_line(12.5), EdgeOf::centre);
//     for (std::size_t i = 0; i < made.chords.size(); ++i) …   // made.chords[i].above: a part
//     Border part = made.part(made.chords[0].above);
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "mechanism/border.h"
#include "mechanism/site.h"

namespace popup {

// Corners this near to the line lie on it.
inline constexpr double kOnLineMm = 1e-6;

// y = level, to the right.
inline DirectedLine level_line(double level) { return {{0.0, level}, {1.0, 0.0}}; }

class Division {
 public:
    // A stretch of the line along which the paper is divided.
    struct Chord {
        double from = 0.0, to = 0.0;  // along the line, from its `at`
        int above = -1, below = -1;   // parts
    };
    std::vector<Chord> chords;  // as they lie along it

    [[nodiscard]] std::size_t parts() const { return first_.size(); }
    [[nodiscard]] bool is_above(int part) const { return above_[static_cast<std::size_t>(part)]; }
    // Whether a part has edges of a kind.
    [[nodiscard]] std::vector<bool> with(EdgeOf kind) const;
    // The parts that chords join which are not `folded` (one a chord), as one border each: the first holds
    // part 0. `group_of`: of each part its number among them.
    [[nodiscard]] std::vector<Border> joined(const std::vector<bool>& folded,
                                             std::vector<int>& group_of) const;
    // One part alone.
    [[nodiscard]] Border part(int number) const;

 private:
    friend Division divide(const Border& border, const DirectedLine& line, EdgeOf made);
    // Finds the parts that the edges make up, and where they lie.
    void number_parts(const DirectedLine& line);
    std::vector<BorderEdge> edges_;
    std::vector<Cubic> cubics_;
    std::vector<int> next_;
    std::vector<int> part_;        // of each edge
    std::vector<int> first_;       // an edge of each part
    std::vector<bool> above_;      // of each part
    std::vector<int> chord_edge_;  // of each chord: its edge above; that below is the next one
};

// The border with corners wherever it crosses the line, as divide() puts them.
Border with_corners_on(const Border& border, const DirectedLine& line);

// Where it crosses the line, corners are put on its curves: exactly on the line, and on the curve up to
// rounding; all other corners keep their values. Precondition: the border touches itself nowhere and runs
// counter-clockwise. The edges that are made are of kind `made`. Cost: linear in edges, but for sorting what
// lies on the line.
Division divide(const Border& border, const DirectedLine& line, EdgeOf made);

// How far up the paper has a stretch at least this wide: the largest y at which it has one just below.
// nullopt: nowhere. Cost: near linear in edges for what people draw.
std::optional<double> highest_wide(const Border& border, double least_mm);

}  // namespace popup
