// A sheet folded by certain angles: where its panels are, what joins are left open by, and the way to angles
// that close them.
#pragma once

#include <span>
#include <vector>

#include "folded/carton/shape.h"
#include "folded/lower.h"
#include "folded/rigid.h"
#include "folded/sheet.h"

namespace popup::folded {

// A corner as one of the panels that share it has it.
struct CornerOf {
    int panel = 0;
    int corner = 0;  // of the sheet
    friend bool operator==(const CornerOf&, const CornerOf&) = default;
    friend auto operator<=>(const CornerOf&, const CornerOf&) = default;  // NOLINT(modernize-use-nullptr)
};

// A join by numbers: corners that are to be in one place, or two panels in one plane.
struct PanelJoin {
    std::vector<CornerOf> merged;  // empty: it is a pair of panels
    int a = -1, b = -1;            // panels
    bool stays = false;            // they are where they should be: no angle changes for it
};

class FoldedState {
 public:
    // `angles`: by fold, radians. The sheet and the tree must outlive it.
    FoldedState(const Sheet& sheet, const Tree& tree, std::vector<double> angles);

    [[nodiscard]] const Sheet& sheet() const { return *sheet_; }
    [[nodiscard]] const Tree& tree() const { return *tree_; }
    [[nodiscard]] const std::vector<double>& angles() const { return angles_; }
    [[nodiscard]] Vec3 place(CornerOf one) const;
    [[nodiscard]] Vec3 normal(int panel) const;
    [[nodiscard]] const Rigid3& frame(int panel) const { return frames_[static_cast<std::size_t>(panel)]; }

    // mm: of merged corners how far the two furthest are apart; of two panels how far a corner of the one is
    // from the plane of the other, whichever is more; 0 of such as stay, up to kMostGlueGapMm.
    [[nodiscard]] double apart(const PanelJoin& join) const;
    // How far the folds gape that close loops, mm.
    [[nodiscard]] double gape() const;

 private:
    const Sheet* sheet_;
    const Tree* tree_;
    std::vector<double> angles_;
    std::vector<Rigid3> frames_;  // by panel
};

struct Closed {
    std::vector<double> angles;    // by fold
    std::vector<double> apart_mm;  // by join: what is left, with all panels rigid
    double residual_mm = 0.0;      // the most of these, and of how far loops gape
    int worst = -1;                // join
    int steps = 0;
    std::size_t panels = 0;      // that may move
    bool settled = true;         // false: it might come nearer still
    double turn = 0.0;           // the most that a fold turns on the way there, radians
    int turned = -1;             // that fold
    double were_apart_mm = 0.0;  // the most that a join is open in the state
    bool swings = false;  // it turns far although next to nothing is open, or from one side to the other
};

// Folds turn by at most that, or what they move goes hardly further than the joins are apart: else what is
// found swings. Where a corner moves square to a join, it goes about sqrt(2 * apart * reach).
inline constexpr double kMostTurnRad = 0.2617993877991494;  // 15°
inline constexpr double kMostWay = 4.0;

// Angles near those of the state that close the joins, as far as panels allow that stay rigid. Only panels on
// the way between what is joined move against one another, unless `all` of them may. Cost: that of
// solve_shape().
Closed close_joins(const FoldedState& state, std::span<const PanelJoin> joins, bool all);

}  // namespace popup::folded
