// The elements: one row each, and everything that documents, schema and help say of them follows from the
// row.
#pragma once

#include <span>
#include <string_view>

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
};

// All rows, by code.
std::span<const ElementInfo> element_table();
// By name or decimal code, case, `_` and `-` disregarded in names; null when unknown.
const ElementInfo* find_element(std::string_view name_or_code);

}  // namespace popup
