// One structure on its way from the document to its fold or plate: its points on their pages, then in site
// coordinates.
#pragma once

#include <vector>

#include "check/fold_index.h"
#include "check/plate_index.h"
#include "mechanism/element.h"
#include "popup/design.h"

namespace popup {

struct NamedPlace;

// Pages that are not read as they are written.
struct PageTurns {
    const std::vector<bool>& mirrored;  // read mirrored, written as they were: the piece of a turned element
    const std::vector<bool>& redrawn;   // mirrored for good: the piece was drawn from its back
};

inline Vec2 mirrored(Vec2 p) { return {-p.x, p.y}; }
// True when the table has the same element the other way.
bool has_inverse(const ElementInfo& info);

struct Placing {
    Element element;
    // The ends of the parent fold, or twice the point of the parent plate, as given (on a page mirrored back:
    // mirrored).
    Vec2 begin, end;
    // Of a structure that names what it stands on: changes are told as its points are written.
    const NamedPlace* beside = nullptr;
    std::optional<FoldMatch> found;  // the fold that it stands on, or would
    // The fold as the structure's points see it; for Standing.
    [[nodiscard]] PageFold seen() const;
    bool turned = false;  // the gutter was given downwards: left and right have changed places

    Placing(const Design& design, const Structure& structure, const ElementInfo& info, int extra_page,
            const PageTurns& pages);

    // A point in the document's unit: "(1.25, 0.5)".
    [[nodiscard]] std::string text(Vec2 mm_point) const;

    // The box, on the parent fold's page, of the part of the given line beside which the element's points
    // lie.
    [[nodiscard]] Box place_on_line() const;

    // The box of all that is drawn on the page of what it stands on.
    [[nodiscard]] Box drawn_box() const;

    // Tries a fold: fills element.site and the points' site coordinates from it. Nothing is reported.
    void look_along(const FoldMatch& match, const Fold& fold);
    // The same along the line as given, when no fold was found; also when no plate was.
    void look_along_given_line();
    // The same on a plate, along the line that element.site describes.
    void look_on(const PlateMatch& match);
    // The same on a page as a whole.
    void look_on_page();
    // The stretch (on the fold's own direction) that is still there.
    void stand_between(std::pair<double, double> alive, double fold_length);

    // Decides orientation, sides and form, and reports: fold-turned, fold-snapped, moved-with-fold,
    // sides-exchanged, wrong-form, wrong-page. False when the structure cannot go on.
    bool settle(const FoldMatch& match, const Fold& fold, const Tolerances& tolerances,
                Diagnostics& diagnostics);
    // The same on a plate: moved-with-plate, wrong-page. `owner` is whose plate it is.
    bool settle(const PlateMatch& match, const std::string& owner, const Tolerances& tolerances,
                Diagnostics& diagnostics);
    // The same on a page as a whole: wrong-page.
    bool settle_on_page(Diagnostics& diagnostics) { return points_are_on_pages_of_ground(diagnostics); }

    // The element as its author drew it, before anything was moved: where its folds were meant to be.
    [[nodiscard]] Element authored_element() const;

    // What has moved since the last call, in words.
    Change take_change(const Tolerances& tolerances);
    // Writes moved points and a changed form into the document's structure.
    void write_back(Structure& structure) const;

 private:
    struct PagePoint {
        Vec2 at;
        int page = 0;
    };
    [[nodiscard]] std::vector<PagePoint> page_points() const;
    // All points that are drawn on that page: outer points, paths' corners, lists of points.
    [[nodiscard]] std::vector<Vec2> drawn_on(int page) const;
    [[nodiscard]] Side side_of(std::size_t point) const;
    // Steps of settle().
    bool points_are_on_pages_of_ground(Diagnostics& diagnostics) const;
    void turn(Diagnostics& diagnostics);
    void move_with(const RigidMove& left, int left_page, const RigidMove& right);
    [[nodiscard]] bool points_moved(const Tolerances& tolerances) const;
    [[nodiscard]] bool drawn_moved() const;
    void snap_to(const FoldMatch& match, const Fold& fold, const Tolerances& tolerances);
    [[nodiscard]] bool all_on_wrong_side(const Tolerances& tolerances) const;
    void exchange_sides(const Tolerances& tolerances);
    bool points_are_on_pages_of_seam(Diagnostics& diagnostics) const;
    void correct_form();

    void write_ground(Structure& structure) const;
    void exchange(bool extra_too);
    void exchange_arguments();
    bool exchange_values();
    void to_site();
    [[nodiscard]] std::size_t index_on(std::size_t point) const;
    [[nodiscard]] std::size_t index_extra(std::size_t point) const;

    [[nodiscard]] bool read_mirrored(int page) const;
    [[nodiscard]] bool ends_inverted() const;

    const Structure* structure_;
    PageTurns pages_;
    double unit_mm_;
    std::string unit_;                 // " in": behind points
    std::vector<PagePoint> points_;    // the author's, on their pages; moved with their fold once it is known
    std::vector<PagePoint> authored_;  // the author's, never moved
    std::vector<PagePoint> reported_;  // as of the last take_change()
    std::vector<std::string_view> letters_;
    Site authored_site_;
    // The ends of the parent fold as they should be written, or the point of the parent plate (begin).
    Vec2 fold_begin_, fold_end_;
    bool fold_moved_ = false;
    bool repaired_ = false;
};

}  // namespace popup
