// Finds the fold that a document means: by where its author saw it, not by where repairs have moved it since.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "base/geometry/edge_index.h"
#include "mechanism/builder.h"

namespace popup {

// Moves a page's points with a fold that moved: a turn and a shift. Identity unless the fold moved.
struct RigidMove {
    bool identity = true;
    Vec2 from, to;  // the fold's begin, before and after
    double c = 1.0, s = 0.0;
    [[nodiscard]] Vec2 apply(Vec2 p) const;
    [[nodiscard]] Vec2 undone(Vec2 p) const;  // its inverse
};
RigidMove move_of(const Segment& before, const Segment& after);

// A fold that a given line may mean.
struct FoldMatch {
    int fold = -1;            // index into Skeleton::folds, or of the ghost
    bool ghost = false;       // the fold of an element that could not be made
    bool right_page = false;  // the line was given on the fold's right page
    bool reversed = false;    // against the fold's own direction
    double off = 0.0;         // mm between the line given and the fold
    double follows_mm = 0.0;  // > 0: how far the fold has been moved away from the line given
    RigidMove left, right;    // of points on the left and on the right page
};

class FoldIndex {
 public:
    // `authored`: where the author's document has it; the same as the fold's own lines unless a repair moved
    // it.
    void add(int fold, const Fold& exact, const FoldLine& authored, bool ghost, double rounding_mm);

    // All folds on `page` whose line lies within `reach` mm of begin–end, of those near `place`; nearest
    // first, younger before older where they are equally near. A fold that a repair has moved comes where its
    // author saw it or where it is, whichever is nearer, wherever `place` is; twice where both are equally
    // near.
    [[nodiscard]] std::vector<FoldMatch> matches(int page, Vec2 begin, Vec2 end, const Box& place,
                                                 double reach) const;
    // The fold that suits on `page` that the line was drawn along before it was moved: it is as long as the
    // line, and turned from it by less than 17°. Its ends are at most `reach` mm away, and those of other
    // such folds half as far again at least. `left` and `right` bring the line onto it; on a seam that of the
    // page alone.
    [[nodiscard]] std::optional<FoldMatch> moved_from(int page, Vec2 begin, Vec2 end, double reach,
                                                      const std::function<bool(int)>& suits) const;
    // All folds on `page` whose lines come into the box, as they run; youngest first. A fold that a repair
    // has moved comes once where its author saw it, and once where it is.
    [[nodiscard]] std::vector<FoldMatch> crossed(int page, const Box& box) const;
    // Distance to the nearest fold on the page from the middle of begin–end, and that fold; within `limit`.
    struct Nearest {
        int fold;
        bool ghost;
        double distance;
    };
    [[nodiscard]] std::optional<Nearest> nearest(int page, Vec2 begin, Vec2 end, double limit) const;

 private:
    struct Entry {
        int fold;
        bool ghost, right_page;
        RigidMove left, right;
        int twin = -1;  // the same fold where its author saw it, or where it is, by its number on the page
    };
    struct PageFolds {
        EdgeIndex lines;
        std::vector<Entry> entries;
    };
    struct Beside;
    static std::optional<Beside> beside(const Segment& line, Vec2 begin, Vec2 end, double reach);
    int insert(int page, const Segment& line, Entry entry);
    std::vector<PageFolds> pages_;
};

}  // namespace popup
