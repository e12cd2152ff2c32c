// Where the lines that one element of a drawing draws go.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "base/text/numbers.h"
#include "popup/curves.h"
#include "popup/sheet_edit.h"

namespace popup::edit {

// As coordinates and angles of drawings are written: a finite one.
inline std::string shown_number(double value) { return number_text(value, 6); }

// Add all lines of the element in the order in which it draws them, then sort() before find().
class ElementMoves {
 public:
    void add(const CreaseLine& line, const EditedSheet::Line& to);
    void sort();
    // Whether a line goes on beyond the corners of the element's path, straight on: dashes of its ends are
    // elements of their own, and were joined to it when it was read.
    [[nodiscard]] bool goes_beyond(const Path& path) const;
    [[nodiscard]] bool moved() const { return moved_; }
    [[nodiscard]] bool bends() const { return !through_.empty(); }
    // Lines that were sides of the element, which said an angle of each, have corners now.
    [[nodiscard]] bool sides_bend() const { return bends() && one_stretch_each_; }
    // What a straight step of the element goes through now, in its own direction.
    [[nodiscard]] std::vector<Vec2> through(Vec2 from, Vec2 to) const;
    // What is cut goes apart on its two sides.
    [[nodiscard]] bool goes_apart() const { return goes_apart_; }
    [[nodiscard]] bool has_angles() const { return has_angles_; }
    [[nodiscard]] bool angles_differ() const { return angles_differ_; }  // of folds of one line
    [[nodiscard]] std::size_t lines() const { return lines_.size(); }
    // All edges, of what has parted.
    [[nodiscard]] std::vector<Segment> edges() const;
    // What data-fold-angle says then, of lines or of these edges, given what it said of the lines, if it did.
    using Said = std::vector<std::optional<double>>;
    [[nodiscard]] std::string angles(const Said& said, bool of_edges) const;
    // The same of the straight sides of the lines, where they go; nullopt where the folds on one of them go
    // by different angles, or there are not so many sides.
    [[nodiscard]] std::optional<std::string> angles_of_sides(const Said& said, std::size_t sides) const;
    // Where a corner of the element goes.
    [[nodiscard]] std::optional<Vec2> find(Vec2 p) const;

 private:
    struct Through {
        Vec2 from, to;  // the stretch, where it was
        Vec2 at;
    };
    struct Drawn {
        std::vector<Segment> straight, parted;  // where it goes, through what it goes through
        std::vector<double> fold_deg;
    };
    // nullopt: folds on this side go by different angles.
    [[nodiscard]] static std::optional<std::string> angle_of_side(const Drawn& line, const Segment& side);

    std::vector<Segment> rows_;  // from where to where
    std::vector<Segment> ends_;  // of open lines, from the end to the point before, where they were
    std::vector<Through> through_;
    std::vector<Drawn> lines_;
    bool moved_ = false, goes_apart_ = false, has_angles_ = false, angles_differ_ = false;
    bool one_stretch_each_ = true;  // the lines
};

}  // namespace popup::edit
