// The lines of a sheet as a planar graph: corners where lines meet, edges between them, and the faces that
// these enclose, with the folds that join them.
//
// Edges have two halves: number 2 e runs from its first corner to its second, 2 e + 1 back; a face lies on
// the left of each of its halves.
//
//   const auto graph = make_graph(lines);
//   for (int half : graph->halves_of(face)) graph->face_of(half ^ 1) …   // the neighbours of a face
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "popup/geometry.h"

namespace popup {

// What a line is drawn for; of edges where several lie on each other a set.
enum Ink : unsigned {
    kCut = 1U,
    kMountain = 2U,
    kValley = 4U,
    kFold = 8U,     // that does not say which way
    kCutOut = 16U,  // a cut around what is to fall out
    kBend = 32U,    // no line: where a panel may bend
};
inline constexpr unsigned kAnyFold = kMountain | kValley | kFold;

struct SheetLine {
    std::vector<Vec2> points;  // mm; at least two
    bool closed = false;
    unsigned ink = kCut;  // one of Ink
    int element = 0;      // what drew it, in the caller's own list
};

// Corners this near to one another, in mm, are one, and a corner this near to an edge lies on it.
inline constexpr double kOnePointMm = 0.002;

struct GraphEdge {
    int a = 0, b = 0;               // corners
    unsigned ink = 0;               // a set of Ink
    int line = 0;                   // the first that drew it
    int element = 0;                // of that line
    std::array<int, 2> of{-1, -1};  // chords of lines that it is a part of, the first two
    bool doubled = false;           // two elements drew it
};

inline bool is_fold(const GraphEdge& edge) { return (edge.ink & kAnyFold) != 0; }

class SheetGraph {
 public:
    std::vector<Vec2> corners;
    std::vector<GraphEdge> edges;
    std::vector<std::array<int, 2>> ends;  // of each line its first and last corner; of closed ones the same
    std::vector<Segment> merged;           // points of lines that corners took in: where they were and are

    [[nodiscard]] int from(int half) const { return half % 2 == 0 ? edge(half).a : edge(half).b; }
    [[nodiscard]] int to(int half) const { return half % 2 == 0 ? edge(half).b : edge(half).a; }
    [[nodiscard]] Vec2 at(int corner) const { return corners[static_cast<std::size_t>(corner)]; }
    [[nodiscard]] const GraphEdge& edge(int half) const { return edges[static_cast<std::size_t>(half / 2)]; }
    [[nodiscard]] Segment segment(int half) const { return {at(from(half)), at(to(half))}; }
    // The half that follows on the border of the face.
    [[nodiscard]] int next(int half) const { return next_[static_cast<std::size_t>(half)]; }
    [[nodiscard]] int face_of(int half) const { return face_[static_cast<std::size_t>(half)]; }
    // Faces count from 0, which is what is outside of everything.
    [[nodiscard]] int faces() const { return static_cast<int>(halves_.size()); }
    [[nodiscard]] const std::vector<int>& halves_of(int face) const {
        return halves_[static_cast<std::size_t>(face)];
    }
    // Halves that begin at a corner, counter-clockwise.
    [[nodiscard]] const std::vector<int>& around(int corner) const {
        return around_[static_cast<std::size_t>(corner)];
    }

 private:
    friend class GraphMaker;
    std::vector<int> next_, face_;
    std::vector<std::vector<int>> halves_, around_;
};

// Lines that meet more often than this are no drawing that somebody made: each of two that cross counts.
inline constexpr std::size_t kMostMeetings = 200'000;

// Nullopt when lines meet more often than `most_meetings`, or are so near to one another that too many would
// have to be looked at. `one_point_mm` > 0, as kOnePointMm. Cost: near linear in chords and crossings.
std::optional<SheetGraph> make_graph(const std::vector<SheetLine>& lines, double one_point_mm = kOnePointMm,
                                     std::size_t most_meetings = kMostMeetings);

}  // namespace popup
