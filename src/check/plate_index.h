// Finds the plate that a document means by a point on it: by where its author saw it, not by where repairs
// have moved it since.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/geometry/edge_index.h"
#include "check/fold_index.h"
#include "mechanism/builder.h"

namespace popup {

// A plate that a given point may mean.
struct PlateMatch {
    int plate = -1;      // index into the skeleton's plates; -1: of an element that could not be made
    bool ghost = false;  // then that
    RigidMove move;      // of points on the plate, from where the author saw it
};

// Grows with the skeleton. Cost a question: logarithmic in the page's plates, linear in those near.
class PlateIndex {
 public:
    // Plates from `first` on, which the last element made (or the base page); `moves`: of each, how a repair
    // moved it on its page. `owner` is the element's id, or "page".
    void add(const Skeleton& skeleton, std::size_t first, const std::vector<RigidMove>& moves,
             const std::string& owner);
    // Where the plates of an element would have been that could not be made.
    void add_ghost(int page, const Ring& area);
    // The same of a whole page, that of its piece.
    void add_ghost_page(int page);

    // The plate under `at`, off what has been cut out of it; of several the youngest. An edge counts with
    // `slack` mm around.
    [[nodiscard]] std::optional<PlateMatch> find(const Skeleton& skeleton, int page, Vec2 at,
                                                 double slack) const;
    // All plates of the page whose boxes come into the box, ascending; where they are, not where they were
    // seen.
    [[nodiscard]] std::vector<int> in(int page, const Box& box) const;
    // The plate on the page that is nearest to `at`, what is cut out disregarded.
    struct Nearest {
        std::string owner;
        double distance;  // mm
    };
    [[nodiscard]] std::optional<Nearest> nearest(const Skeleton& skeleton, int page, Vec2 at) const;

 private:
    struct Entry {
        int plate;  // -1: a ghost
        Ring ghost;
        RigidMove move;
        std::string owner;
    };
    struct PagePlates {
        EdgeIndex boxes;  // diagonals
        std::vector<Entry> entries;
        bool ghost = false;
    };
    PagePlates& page(int number);
    static void insert(PagePlates& plates, const Ring& around, Entry entry);
    std::vector<PagePlates> pages_;
};

// A plate's paper, less what has been cut out of it and less a rim of `inset` mm along folds and edges.
// Canonical, as base/geometry/regions.h has it.
std::vector<Polygon> paper_of(const Skeleton& skeleton, int plate, double inset);

}  // namespace popup
