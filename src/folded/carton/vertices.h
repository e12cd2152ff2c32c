// The vertices of a folded shape: corners of panels that are in one place and move together.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "folded/carton/cut_apart.h"
#include "folded/carton/folded_state.h"

namespace popup::folded {

inline constexpr double kMeetsMm = 0.01;  // corners that are no further apart are in one place

// A sheet cut apart and folded, with its vertices. Corners are those of the sheet cut apart.
class Vertices {
 public:
    explicit Vertices(ApartShape apart);
    Vertices(const Vertices&) = delete;
    Vertices& operator=(const Vertices&) = delete;

    [[nodiscard]] const Sheet& sheet() const { return apart_.shape.sheet; }
    [[nodiscard]] const Tree& tree() const { return apart_.shape.tree; }
    [[nodiscard]] const FoldedState& state() const { return state_; }
    [[nodiscard]] const std::string& name_of(int panel) const;  // "front" or, of several pieces, "sheet-1/3"
    [[nodiscard]] const std::vector<std::vector<int>>& corners() const { return apart_.corners; }
    [[nodiscard]] const std::string& full_name_of(int panel) const;  // "sheet/front"
    // The number of its vertex; -1: it is only part of an outline.
    [[nodiscard]] int vertex_of(int corner) const;
    [[nodiscard]] const std::vector<std::vector<CornerOf>>& members() const { return members_; }
    // It is a corner of one panel alone, and no end of a fold.
    [[nodiscard]] bool is_free(int vertex) const;
    // Of a panel: one corner of each of its vertices, counter-clockwise. Their places in it, counted from 1,
    // are their names.
    [[nodiscard]] const std::vector<int>& named(int panel) const;
    [[nodiscard]] Vec3 place(int corner) const;
    [[nodiscard]] int parent(int panel) const;
    // The panel of this name, with or without that of its piece; -1: there is none.
    [[nodiscard]] int find(std::string_view name) const;
    // The way out of the shape, square to a panel; unit.
    [[nodiscard]] Vec3 out(int panel) const;
    [[nodiscard]] double meet_mm() const { return meet_mm_; }

 private:
    class Grid;
    void find_vertices();
    Grid join_near(const std::vector<int>& some, int& count,
                   const std::function<bool(int, int)>& go_together);
    void name_corners();

    ApartShape apart_;
    FoldedState state_;
    double meet_mm_ = 0.0;
    std::vector<Vec3> places_;    // by corner
    std::vector<int> vertex_of_;  // by corner
    std::vector<std::vector<CornerOf>> members_;
    std::vector<char> free_;               // by vertex
    std::vector<std::vector<int>> named_;  // by panel
    std::vector<std::string> names_;       // by panel
    Vec3 middle_;
};

// The rough shape of a pattern, refined by the joins, with its vertices; nullptr after an error of
// rough_shape() or resolve().
std::unique_ptr<const Vertices> vertices_of(const CreasePattern& pattern, const FoldOptions& options,
                                            const std::vector<Join>& joins, Diagnostics& diagnostics);

}  // namespace popup::folded
