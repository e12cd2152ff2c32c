// What an element row must provide, and the value that check() hands it.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mechanism/builder.h"
#include "mechanism/site.h"
#include "popup/diagnostics.h"
#include "popup/mechanism.h"

namespace popup {

// How closely to look: what an author drew may be off by rounding; what a repair makes must be right, so that
// it still is when its numbers have been rounded in the document.
enum class Fit { as_drawn, exact };

// What a hole through a sheet takes, and why it must not be (empty: it may be).
struct Pierced {
    std::vector<int> plates;
    struct Span {
        int fold = -1;
        double from = 0.0, to = 0.0;  // mm along it
    };
    std::vector<Span> folds;  // stretches that are still there
    // The narrowest paper between the hole and another that it does not meet, where that tears.
    struct Narrow {
        Vec2 at;  // its middle
        double width_mm = 0.0;
    };
    std::optional<Narrow> narrow;
    std::string code, what, hint;
};

// Is this footprint free to be cut, or this seam free to be glued? Asked of the paper as it is so far. An
// element on a plate has that plate on both sides.
struct PaperQuery {
    // A footprint (page coordinates) on a plate: inside it, with `paper_mm` left around but along the
    // parent fold, and no earlier seam under it.
    std::function<bool(Side, const Ring&, Fit)> may_cut;
    // The same of a footprint that reaches a straight edge of the plate, where no paper need be left.
    std::function<bool(Side, const Ring&, const Segment& edge, Fit)> may_cut_to;
    // A straight edge of the plate, or of what has been cut out of it, on which both ends of a segment (page
    // coordinates) lie, up to rounding.
    std::function<std::optional<Segment>(Side, const Segment&)> edge_along;
    // A seam (page coordinates) wholly on its plate, off what has been cut out of it.
    std::function<bool(Side, const Segment&, Fit)> may_glue;
    // The plate's paper (page coordinates) at least `inset` mm away from its folds and edges, cut-outs
    // regarded. Outside of `near` there may be more of it: only what is cut out near there is looked at.
    std::function<std::vector<Polygon>(Side, double inset, const Box& near)> paper;
    // Whether a seam or a glued area lies within the ring or on it (page coordinates).
    std::function<bool(Side, const Ring&)> is_glued;
    // What a hole through the whole sheet takes, on the page of the left side.
    std::function<Pierced(const Ring&)> pierce;
};

// An element on its site. `constrain` moves its points until all constraints hold and reports what moved.
struct Element {
    const ElementInfo* info = nullptr;
    ElementPaint paint;
    Site site;
    double alive_lo = 0.0, alive_hi = 0.0;  // the stretch of the fold it stands on
    int extra_page = -1;                    // of its own piece
    double page_height = 0.0;
    std::string label;          // number of its tabs: "1"
    std::vector<SitePoint> on;  // the points of the fold's page, in the row's order
    std::vector<Vec2> extra;    // the points of the extra page, in the row's order
    // The other values, in the row's order, one a parameter. Paths and points are in page coordinates.
    // constrain() may change them, and then sets `changed`.
    std::vector<Argument> arguments;
    std::vector<Segment> snapped;  // ends of a path's lines that were moved, and are not yet told
    bool inverted = false;         // the form it turned out to be; constrain() may correct it
    bool piece_mirrored = false;   // constrain() has mirrored the extra points (x to -x)

    // Services of check().
    const Tolerances* tolerances = nullptr;
    const PaperQuery* paper = nullptr;
    // Reports a repair, after it was made: `what` says what was wrong, with its numbers. check() adds where
    // the points stood before and stand now.
    std::function<void(std::string_view code, std::string what, std::string hint)> repaired;
    // Reports what cannot be repaired. The element is then left out.
    std::function<void(std::string_view code, std::string what, std::string hint)> failed;
    // Warns of what stays as it is.
    std::function<void(std::string_view code, std::string what, std::string hint)> warned;
    // Reports what is as it should be, and worth knowing.
    std::function<void(std::string_view code, std::string what, std::string hint)> remarked;
    // What a repair changed that no point tells of, for the next repaired().
    std::optional<Change> redrawn;
};

// One row: facts and functions. Adding an element is one file and one such row.
struct ElementRow {
    ElementInfo info;
    // The stretch [lo, hi] of the parent fold that must still be there, from unrepaired points.
    std::pair<double, double> (*stands_on)(const Element&);
    // Repairs; false after failed().
    bool (*constrain)(Element&);
    // The folds the element makes, from its points as they are (repaired or not): as many as the row names.
    FoldLines (*fold_lines)(const Element&);
    // Glued elements: positive when the piece is drawn from its front; null for cut ones.
    double (*front)(const Element&);
    // Plates, lines, joints. Precondition: constrain() returned true.
    void (*lower)(const Element&, Builder&);
    // Where its outline crosses the line of the fold that it stands on, as the author drew it (mm along it):
    // of rows that find their fold themselves, else null.
    std::vector<double> (*crossings)(const Element&) = nullptr;
    // The values of `info.measures`, in mm and degrees, of an element on its site; of one on a plate or page
    // the site is the line upwards through the page's origin.
    std::vector<double> (*measured)(const Element&) = nullptr;
    // Sets all points from such values: see mechanism/measures.h. Of an element that is still to be made all
    // points are 0.
    void (*shape)(Element&, std::span<const double>) = nullptr;
};

// What rows answer of elements that stand on plates, that make no folds, and whose piece has no back.
inline std::pair<double, double> stands_on_no_fold(const Element& /*element*/) { return {0.0, 0.0}; }
inline FoldLines makes_no_folds(const Element& /*element*/) { return {}; }
inline double drawn_from_front(const Element& /*element*/) { return 1.0; }

// All rows, in the order of element_table().
std::span<const ElementRow> element_rows();
const ElementRow& element_row(const ElementInfo& info);

// Other rows in place of the table's, everywhere, for as long as this lives: for tests of what follows from a
// row. Only one at a time, and only while one thread runs.
class RowsForTest {
 public:
    // `rows` must outlive this.
    explicit RowsForTest(std::span<const ElementRow> rows);
    ~RowsForTest();
    RowsForTest(const RowsForTest&) = delete;
    RowsForTest& operator=(const RowsForTest&) = delete;
};

// The element that these points make, on a fold as its pages show it; preconditions as of folds_of().
Element element_on(const ElementInfo& info, const PageFold& parent, int extra_page,
                   std::span<const Vec2> points, std::span<const Argument> arguments);

// On which pages one of the element's folds is drawn, on its left and on its right.
std::pair<int, int> pages_of_fold(const Element& element, const FoldInfo& fold);
// True when the fold joins a piece to what it is glued to.
bool is_seam(const ElementInfo& info, const FoldInfo& fold);

// Arguments by the names of their parameters. Preconditions: the row has such a parameter, of that kind.
std::optional<Color> color_of(const Element& element, std::string_view name);
double number_of(const Element& element, std::string_view name);  // of lengths, too; else the row's standard
std::string_view choice_of(const Element& element, std::string_view name);  // else the row's first word
// What a path encloses, curves as chords; empty when it was not given.
std::span<const Polygon> areas_of(const Element& element, std::string_view name);
// Moves ends of lines and curves of a path that is given to the nearest of these points, if that is within
// `within` mm; returns by how much the furthest moved. More than rounding is a change.
double snap_path(Element& element, std::string_view name, std::span<const Vec2> to, double within);
// What its chords stand for: for Builder::add_curves(), where they become edges of paper.
std::span<const FlatCurve> curves_of(const Element& element, std::string_view name);

// Mirrors the element's own piece (x to -x), with everything that is drawn on its page.
void mirror_piece(Element& element);

}  // namespace popup
