// The elements: one row each, and everything that documents, schema and help say of them follows from the
// row.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>

#include "popup/geometry.h"

namespace popup {

// On which page a point of an element is written.
enum class PointPage {
    fold,   // the parent fold's page (on a seam: the page of its side)
    extra,  // the page that holds the element's own piece
};

struct PointInfo {
    std::string_view letter;  // the thesis's letter
    PointPage page = PointPage::fold;
    char side = '-';  // 'L', 'R', or '-' for points of the fold or of both
};

// One row an element name; a form and its inverse are two rows with one family.
struct ElementInfo {
    std::string_view name;    // "inverted-v-fold"
    int code;                 // Popup Workshop's number; -1: none
    std::string_view family;  // "v-fold"
    bool inverted;
    bool glued;              // 180°: brings a piece and a page of its own; else cut from the page
    std::string_view about;  // one line
    std::span<const PointInfo> points;
    // For each point its partner on the other side, by index; of points of the fold, themselves.
    std::span<const int> partners;
};

// All rows, by code.
std::span<const ElementInfo> element_table();
// By name or decimal code, case, `_` and `-` disregarded in names; null when unknown.
const ElementInfo* find_element(std::string_view name_or_code);

// A fold or seam as its pages show it: one line of paper, with a plane on its left and one on its right.
struct PageFold {
    int left_page = 0, right_page = 0;
    Segment on_left, on_right;  // begin to end on each page, mm; one and the same unless it is a seam
    bool seam = false;
    int closed_deg = 0;  // dihedral angle on the front side at the closed card: 0 (a valley), 180 or 360
};

// The left, the centre and the right fold of an element that stands on `parent`, for others to stand on:
// where its points, as they are given, mean them to be. check() may move them, and then moves along what
// stands on them. `extra_page` is the page of its own piece, of cut elements without meaning. nullopt: points
// like these make no folds. Preconditions: as many points as the row has, in its order, each in the
// coordinates of its page (a point of the fold: of the left one); the parent has a length.
std::optional<std::array<PageFold, 3>> folds_made(const ElementInfo& info, const PageFold& parent,
                                                  int extra_page, std::span<const Vec2> points);

}  // namespace popup
