// The assembly book as a value: what the writers of .book.pdf and .book.html both say and show.
//
// Parts in the order in which they are read: a cover, what is needed, an overview of the sheets, then the
// steps of each card, and how it must open. Words are sentences for somebody who holds the print in one hand;
// names are those of the document, and numbers those that are printed on tabs, targets and pieces.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "output/book/figure.h"
#include "output/book/scene.h"
#include "popup/output.h"

namespace popup::book {

struct PartRow {
    std::string number;  // as on the sheets; empty: it has none
    std::string name;
    std::string sheets;  // "1", "1, 2"
    std::string folds;   // "2 mountain, 1 valley"
    std::string tabs;    // "3L, 3R"
};

struct Step {
    std::string title;                 // "Step 4: 3. roof"
    std::string lies;                  // how the card lies; may be empty
    std::vector<std::string> actions;  // one after another
    std::vector<std::string> notes;
    std::vector<Scene> scenes;          // before, after; may be one, or none
    std::vector<std::string> captions;  // of each scene
    std::vector<Figure> figures;
    std::string key;             // what the numbers on them are; may be empty
    bool large_figures = false;  // there is much on them
    bool lettered = false;       // actions are what pictures show with letters: a, b, c
};

struct Chapter {
    std::string title;
    std::string intro;  // may be empty
    std::vector<Step> steps;
};

// How one card is made.
struct CardPart {
    std::string title;
    std::vector<PartRow> parts;
    std::vector<Chapter> chapters;
    // Last.
    std::string closing_title = "How it must open";
    std::vector<Scene> opening;
    std::vector<std::string> opening_captions;
    std::vector<std::string> opens;    // how it opens
    std::vector<std::string> trouble;  // what to look at when it does not
    std::vector<std::string> found;    // what the tool remarked
};

struct SheetPart {
    std::string title;
    Figure figure;
    std::string key;  // what the numbers on it are; may be empty
};

struct Book {
    std::string kind = "assembly book";  // after the title
    std::string needs_title = "What is needed";
    std::string title;
    std::string subtitle;
    std::vector<Scene> cover;                                // one of each card that can be seen
    std::vector<std::pair<std::string, std::string>> needs;  // what, and how much or which
    std::vector<std::string> first;                          // before anything is cut
    std::vector<SheetPart> sheets;
    std::vector<CardPart> cards;
    bool letter = false;         // pages of letter paper, else A4
    bool printed_backs = false;  // as of plate_mesh()
};

// The book of a run. Precondition: every card moves, is folded, or is glued. Cost: that of gluing_order(),
// and near linear in what is on the sheets.
Book make_book(const RunPage& page, const OutputOptions& options);

}  // namespace popup::book
