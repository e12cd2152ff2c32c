// The elements: one row each, and everything that documents, schema and help say of them follows from the
// row.
//
//     for (const ElementInfo& row : element_table())
//         fmt::print("{} has {} points and makes {} folds\n", row.name, row.points.size(), row.folds.size());
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "popup/design.h"
#include "popup/geometry.h"

namespace popup {

// On which page a point of an element is written.
enum class PointPage {
    fold,   // the parent fold's page (on a seam: the page of its side), or the parent plate's
    extra,  // the page that holds the element's own piece
};

// An outer point. They come as one list without names, so they stand apart from the other parameters.
struct PointInfo {
    std::string_view letter;  // the thesis's letter
    PointPage page = PointPage::fold;
    char side = '-';  // 'L', 'R', or '-' for points of the fold or of both
};

// What a parameter's value is. A closed set: reader, writer, patch, schema and FlatLang switch over it.
enum class ParameterKind {
    colour,
    length,  // in the document's unit; mm inside
    number,  // plain
    choice,  // a word of a list
    path,    // SVG path data: the closed areas that it encloses, by the even-odd rule
    points,  // any number of points, on one page
};

// A named parameter. Colours, paths and points are child elements of that name in the canonical document,
// the others attributes; they are read either way.
struct ParameterInfo {
    std::string_view name;  // lower case, without "_" and "-": "leftcolor"
    ParameterKind kind = ParameterKind::colour;
    std::string_view about;  // one line
    bool required = false;
    PointPage page = PointPage::extra;  // of a path or of points, where they name none
    // The parameter that mirroring swaps it with; of a choice between left and right, itself, for its words
    // swap.
    std::string_view partner = {};
    double least = 0.0, most = 0.0;                // of a length (mm) or number, both included
    double standard = 0.0;                         // where none is given
    std::span<const std::string_view> words = {};  // of a choice; the first is what holds where none is given
    std::string_view since =
        "2.0";  // the version of the document that has it first, if that is later than the row's
    // The child element whose attribute it is in the canonical document; empty: an attribute of the
    // structure.
    std::string_view group = {};
};

// Of nearly all elements: the colours of both halves and of their tabs.
inline constexpr std::array<ParameterInfo, 4> kHalfColours{
    {{.name = "leftcolor", .about = "colour of the left half", .partner = "rightcolor"},
     {.name = "rightcolor", .about = "colour of the right half", .partner = "leftcolor"},
     {.name = "lefttabcolor", .about = "colour of the left tab", .partner = "righttabcolor"},
     {.name = "righttabcolor", .about = "colour of the right tab", .partner = "lefttabcolor"}}};

// What a measure's value is.
enum class MeasureKind {
    length,  // mm
    angle,   // degrees
    choice,  // the number of a word
};

// When a measure is worth a word.
enum class Said {
    always,
    unless_zero,  // what is uneven, or moved aside
    drawing,      // of how it is drawn alone: nothing of the card changes with it
};

// An element in the words of people: how wide it is, at what angle, and where along its fold. All measures of
// a row together say where its points are; paths that are drawn go along with them.
struct MeasureInfo {
    std::string_view name;  // lower case, without "_" and "-"; none of the row's parameters has it
    MeasureKind kind = MeasureKind::length;
    std::string_view about;  // one line
    // Of a new element: this share of its fold's length, and this besides.
    double share = 0.0, standard = 0.0;
    Said said = Said::always;
    // A change of what is there, as a turn: it always measures 0.
    bool relative = false;
    std::span<const std::string_view> words = {};  // of a choice
};

// A fold or seam that an element makes, for others to stand on.
struct FoldInfo {
    std::string_view name;  // "left": what FlatLang calls it
    // Whose page lies on its left and on its right: that of what the element stands on, or its own piece's.
    // One of each makes a seam, if the element has a piece of its own.
    PointPage on_left = PointPage::extra, on_right = PointPage::extra;
};

// Of all linkages of four folds: what lies between the two halves, and at their outer ends.
inline constexpr std::array<FoldInfo, 3> kThreeFolds{{{"left", PointPage::fold, PointPage::extra},
                                                      {"centre", PointPage::extra, PointPage::extra},
                                                      {"right", PointPage::extra, PointPage::fold}}};

// A plate that an element makes, for others to stand on. What names it gives its points beside one of the
// element's folds, as that lies on the plate; of a piece without folds on the page of the piece.
struct PlateInfo {
    std::string_view name;  // as of folds; in its assembly "front-left" is "ID/front-left"
    int fold = -1;          // number of the fold; -1: none
    bool right = false;     // the plate lies on the right of the fold
};
// Of all linkages of four folds.
inline constexpr std::array<PlateInfo, 2> kTwoPlates{{{"left", 0, true}, {"right", 2, false}}};
inline constexpr std::array<PlateInfo, 1> kOnePlate{{{"plate"}}};

// What an element may stand on.
struct Grounds {
    bool fold = true;
    bool seam = false;
    bool plate = false;  // named by <parentplate>, where the others are named by <parentfold>
    // The fold need not be named: it is the one that the element's outline crosses exactly twice.
    bool found = false;
    bool page = false;  // a page as a whole; it names neither fold nor plate
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
    Grounds grounds = {};
    std::span<const ParameterInfo> parameters = kHalfColours;
    std::span<const FoldInfo> folds = kThreeFolds;
    std::string_view since = "2.0";               // the version of the document that has it first
    std::span<const std::string_view> also = {};  // other names that are read
    std::span<const MeasureInfo> measures = {};
    std::span<const PlateInfo> plates = kTwoPlates;
};

// All rows, by code.
std::span<const ElementInfo> element_table();
// By name or decimal code, case, `_` and `-` disregarded in names; null when unknown.
const ElementInfo* find_element(std::string_view name_or_code);
// The number of a row's parameter; nullopt when it has none of that name (canonical).
std::optional<std::size_t> find_parameter(const ElementInfo& info, std::string_view name);
// The argument of that name; null when the row has no such parameter or nothing was given.
const Argument* find_argument(const ElementInfo& info, std::span<const Argument> arguments,
                              std::string_view name);
// The version of the document that has the element and all values that are given.
std::string_view version_needed(const ElementInfo& info, std::span<const Argument> arguments);
// The folds and plates that everything can stand on by their names: "gutter", "page.left", "bird.centre".
// Words are compared as people spell them: "front-left", and of a seam "right-seam".
struct FoundName {
    std::size_t which = 0;
    std::string text;  // the canonical name
};
// Of an element, by what stands behind its id; nullopt: it has none of that name.
std::optional<FoundName> find_fold_name(const ElementInfo& info, std::string_view id, std::string_view word);
std::optional<FoundName> find_plate_name(const ElementInfo& info, std::string_view id, std::string_view word);
std::string fold_name(std::string_view id, const FoldInfo& fold);
std::string plate_name(std::string_view id, const PlateInfo& plate);
inline constexpr std::string_view kGutter = "gutter";
inline constexpr std::array<std::string_view, 2> kPagePlates{"page.left", "page.right"};

// The colour that a structure gives under that name.
std::optional<Color> color_of(const Structure& structure, std::string_view parameter);

// A fold or seam as its pages show it: one line of paper, with a plane on its left and one on its right.
struct PageFold {
    int left_page = 0, right_page = 0;
    Segment on_left, on_right;  // begin to end on each page, mm; one and the same unless it is a seam
    bool seam = false;
    int closed_deg = 0;  // dihedral angle on the front side at the closed card: 0 (a valley), 180 or 360
};

// The folds of an element that stands on `parent`, in the order of its row's `folds`, for others to stand on:
// where its points, as they are given, mean them to be. check() may move them, and then moves along what
// stands on them. `extra_page` is the page of its own piece, of cut elements without meaning. nullopt: points
// like these make no folds. Preconditions: as many points as the row has, in its order, each in the
// coordinates of its page (a point of the fold: of the left one); the parent has a length. Of an element on a
// plate the parent is any line of the plate's page. `arguments`: in the order of the row's parameters; what
// lies behind the end was not given.
std::optional<std::vector<PageFold>> folds_of(const ElementInfo& info, const PageFold& parent, int extra_page,
                                              std::span<const Vec2> points,
                                              std::span<const Argument> arguments = {});

// The measures of an element, in the order of its row's `measures`; preconditions as of folds_of(). nullopt:
// points like these have none.
//
//     auto values = measures_of(info, parent, page, points, arguments).value();
//     values[*find_measure(info, "width")] = 40.0;
//     const auto wider = shaped(info, parent, page, points, arguments, values);
std::optional<std::vector<double>> measures_of(const ElementInfo& info, const PageFold& parent,
                                               int extra_page, std::span<const Vec2> points,
                                               std::span<const Argument> arguments = {});
// The points and arguments that an element has with these measures. What its measures do not tell stays as it
// is: which way letters run, and by how much points stray from what the element's constraints would have.
// What is drawn on its pages goes along, `changed` where that moves it; a path that must be there and is not,
// is made. Measures that were measured and not changed give back the points, within 1e-9 mm. An element that
// is still to be made has all its points at 0. nullopt: nothing has such measures. `given`, if it is not
// empty, tells by measure which are asked for: beside others that change, one that has its value already
// keeps it, and is not changed along with them.
struct Shaped {
    std::vector<Vec2> points;
    std::vector<Argument> arguments;
};
std::optional<Shaped> shaped(const ElementInfo& info, const PageFold& parent, int extra_page,
                             std::span<const Vec2> points, std::span<const Argument> arguments,
                             std::span<const double> measures, const std::vector<bool>& given = {});
// The number of a row's measure, its name spelt as people like; nullopt when it has none of that name.
std::optional<std::size_t> find_measure(const ElementInfo& info, std::string_view name);

}  // namespace popup
