// The Skeleton: what elements lower themselves into, before cut-outs are made and decoration is spread.
//
// check() builds it element by element; assemble() finishes it.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "mechanism/site.h"
#include "popup/assembly.h"
#include "popup/design.h"

namespace popup {

// A stretch of a fold that a cut took away.
struct CutSpan {
    double end = 0.0;
    std::string by;  // id of the element that cut it
};

// A fold or seam that elements can stand on. `left` lies on its left, seen from begin to end on the left
// page.
struct Fold {
    int left_plate = -1, right_plate = -1;
    int left_page = 0, right_page = 0;
    Segment on_left, on_right;  // begin → end on each page; one and the same segment unless it is a seam
    int closed_deg = 0;         // dihedral angle on the front side at the closed card: 0, 180 or 360
    bool seam = false;
    std::string owner;               // element's id, or "page"
    std::map<double, CutSpan> gone;  // by begin, mm along the fold, disjoint

    [[nodiscard]] double length() const { return distance(on_left.a, on_left.b); }
    // The cut that takes away some of [lo, hi], if any.
    [[nodiscard]] const CutSpan* cut_within(double lo, double hi) const;
    // The stretch that is still there around s; nullopt where it is cut away.
    [[nodiscard]] std::optional<std::pair<double, double>> alive_around(double s) const;
};

// What a 90° element takes from one plane: the region between a fold and a path that leaves it and comes
// back.
struct CutOut {
    int fold = -1;
    double begin = 0.0;  // where the path leaves the fold, mm along it
    Ring path;  // page coordinates; its first and last points lie on the fold, in the fold's direction
};

// Geometry only: one fold an element makes, as `fold_lines` of its row derives it from its points.
struct FoldLine {
    Segment on_left, on_right;
    int closed_deg = 0;  // as of Fold
};
// All that an element makes, in the order of its row's `folds`.
using FoldLines = std::vector<FoldLine>;

// A seam that nothing can stand on: that of a pillar, which may lie along a fold of the plate that it is
// glued to. `inside` lies beside it on that plate.
struct Foot {
    int plate = -1;
    Segment seam;
    Segment inside;
};

// A hole in a plate.
struct Hole {
    int plate = -1;
    Ring ring;  // page coordinates, clockwise
    // It goes through a whole sheet, and may cross edges and folds of the plate.
    bool through = false;
};

// A hole through all plates of a page that it lies on.
struct Window {
    int page = 0;
    Ring ring;  // page coordinates, counter-clockwise
};

struct Skeleton {
    Assembly draft;  // plates with raw outlines; lines: cuts only
    std::vector<Fold> folds;
    std::vector<Foot> feet;
    std::vector<Hole> holes;
    std::vector<Window> windows;
    std::vector<std::vector<int>> holes_of;     // of each plate: numbers of its holes
    std::vector<int> plate_page;                // of each plate
    std::vector<std::vector<CutOut>> cut_outs;  // of each plate; disjoint, with paper between them
    std::vector<bool> page_mirrored;            // of each page: the author drew it mirrored
    std::vector<FlatCurve> curves;              // what chords of outlines stand for
};

// The names and colours of the two plates an element makes.
struct ElementPaint {
    std::string id;
    Place place;
    std::optional<Color> left, right, left_tab, right_tab;
};

// Adds plates, lines and joints to a skeleton. All coordinates are page coordinates.
class Builder {
 public:
    explicit Builder(Skeleton& skeleton) : skeleton_(skeleton) {}

    // The base page: its two plates, its edge as cuts, its gutter as fold 0.
    void add_base_page(double width_mm, double height_mm, std::optional<Color> left,
                       std::optional<Color> right);
    int add_piece(const std::string& name);
    // Adds a plate; its outline is made counter-clockwise, its holes clockwise.
    int add_plate(const std::string& name, int piece, int page, Polygon outline, std::optional<Color> fill);
    // The same of a plate whose whole edge is cut.
    int add_cut_plate(const std::string& name, int piece, int page, Polygon outline,
                      std::optional<Color> fill);
    void add_cut(int piece, Segment at);
    // Outlines have chords of these, on whatever page: sheets show the curves where nobody has cut them.
    void add_curves(std::span<const FlatCurve> curves);
    // Adds a fold between two plates; it becomes a hinge and, where it is not cut away, a line.
    int add_fold(Fold fold);
    void add_glue(Glue glue);
    // Glues a plate of a piece on along a line that is no fold for others: its hinge, its tab, and the paper
    // that it takes.
    void add_foot(Glue glue);
    void add_glued_area(GluedArea area);
    // Cuts a hole into a plate, off its edges and folds. Its ring may run either way round.
    void add_hole(int plate, Ring ring);
    // Cuts a hole through a sheet: these are the plates that lose paper. What folds lose is told by
    // add_gone().
    void add_window(int page, Ring ring, std::span<const int> plates);
    // `path` runs from the fold through the plate back to the fold, either way round.
    void add_cut_out(int plate, int fold, Ring path);
    void add_gone(int fold, double lo, double hi, const std::string& by);
    void add_joint(Joint joint);

    [[nodiscard]] Skeleton& skeleton() { return skeleton_; }

 private:
    Skeleton& skeleton_;
};

}  // namespace popup
