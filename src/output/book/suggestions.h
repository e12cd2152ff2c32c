// Suggestions of joins as a book to look through: an entry and a picture each.
#pragma once

#include <optional>
#include <string>

#include "popup/geometry.h"
#include "popup/output.h"
#include "popup/refinement.h"

namespace popup::book {

struct Book;

struct SuggestionsOf {
    const Suggestions& found;
    const SceneCard& card;  // the sheet as it is folded at the opening from which it sweeps
    Ruler ruler;            // of the drawing
    std::string title;
    bool letter = false;  // as Book::letter has it
};

// Of each suggestion: how far apart its parts are, what accepting it would leave open, what they are, a
// picture of the folded sheet on which they are marked, and the sheet with the same panels. Panels that the
// card does not have are not marked. Cost: linear in suggestions times the panels of the sheet.
Book book_of(const SuggestionsOf& suggestions);

// That book as a page, or as a PDF, as output/book/book_html.h and book_pdf.h say; nullopt: an error was
// told.
std::optional<std::string> suggestions_html(const SuggestionsOf& suggestions, Diagnostics& diagnostics);
std::optional<std::string> suggestions_pdf(const SuggestionsOf& suggestions, Diagnostics& diagnostics);

}  // namespace popup::book
