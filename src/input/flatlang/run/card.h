// Pop-up cards that programs write: what popup() and the builtins of elements make of their arguments.
//
// Lengths are millimetres here. Every fold is a gutter of its own: places beside it have x to its right and y
// along it, from its begin to its end, and its middle as origin. On the gutter that is the base page's own
// coordinates. Points of a glued piece have the coordinates of the piece's page.
#pragma once

#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include "popup/design.h"
#include "popup/files.h"
#include "popup/mechanism.h"

namespace popup::flatlang {

// The card of a program, if it makes one.
struct Card {
    std::optional<Design> design;  // from the call of popup() on; ids that are not given are empty
    Place place;                   // of that call
    std::vector<PageFold> folds;   // on which elements can stand, the gutter first
    std::vector<int> pages;        // of each structure: of its piece, or the one it is cut from
    int glued = 0;                 // structures with a page of their own
    std::size_t points = 0;        // of all structures and lines
    std::set<std::string> ids;     // that are given
};

// Why something cannot be had: a sentence without its subject ("is 12 m wide …"), and what would mend it.
struct Refusal {
    std::string what;
    std::string hint = {};
};

struct NewCard {
    double width_mm = 279.4, height_mm = 215.9;
    std::optional<Color> left, right;
    Place place;
};
// Begins the card; its gutter is fold 0. Precondition: there is none yet.
std::optional<Refusal> begin_card(Card& card, const NewCard& wanted);

// Colours of an element's halves and of the tabs of its piece.
struct Paint {
    std::optional<Color> left, right, left_tab, right_tab;
};

// Where an element stands that stands on a plate: its page, and any point of the plate.
struct PlatePlace {
    int page = 0;
    Vec2 at;
};

// A value for a parameter of an element: a number (mm for lengths), or a text, which is a word of a choice,
// path data in inches (beside its fold, where it lies on the fold's page), or a colour.
struct NewValue {
    std::string parameter;  // empty: the first that takes it and has none, colours aside
    std::variant<double, std::string> value;
};

struct NewElement {
    const ElementInfo* info = nullptr;
    std::size_t fold = 0;  // of Card::folds
    // In place of the fold. Points are then in the coordinates of the plate's page.
    std::optional<PlatePlace> plate = {};
    // In place of either, of rows that lie on a page as a whole.
    std::optional<int> page = {};
    // In the row's order: all of them, or all but those with a partner on their left, whose mirror images
    // these then are (about the fold; on a piece's page about x = 0). Of a row without points they are the
    // value of its parameter that is a list of points.
    std::vector<Vec2> points;
    Paint paint;
    std::vector<NewValue> values = {};
    Place place;
};
// Appends the structure; on success `folds` is the first of its row's folds in Card::folds. Empty: it makes
// none. Precondition: the card has begun, and its fold is there.
std::optional<Refusal> add_element(Card& card, const NewElement& wanted, std::optional<std::size_t>& folds);

// True of a text that can only be path data: it begins with M and a number.
bool is_path_data(std::string_view text);

// How many points a call may give if it leaves out what is mirrored.
std::size_t points_without_mirrored(const ElementInfo& info);
// "A (left), B (left), G (right), H (right)".
std::string letters_of(const ElementInfo& info);

// Where a line is drawn: a page, or beside a fold.
struct NewLine {
    std::optional<std::size_t> fold;
    int page = 0;
    std::vector<Vec2> points;
    double thickness_pt = 1.0;
    Color color{0, 0, 0};
    Place place;
};
// Precondition: the card has begun, and its fold or page is there.
std::optional<Refusal> add_line(Card& card, const NewLine& wanted);

void paint_element(Card& card, std::size_t structure, const Paint& paint);

// Gives a structure its id. `numbered`: the call has given a number besides, which is in it.
std::optional<Refusal> name_element(Card& card, std::size_t structure, const std::string& id, bool numbered);

// The card as other languages would have written it: named as its source, and every structure with an id.
// Precondition: the card has begun.
Design finished(Card card, const Source& source);

}  // namespace popup::flatlang
