// The assembly book as a page to read beside the table.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "output/book/book.h"
#include "popup/output.h"

namespace popup {

// One HTML file without a script: the parts of output/book/book.h, with a table of contents. Its policy (CSP)
// allows its own style, by its SHA-256, and pictures that are in it; no text of a document is read as markup.
// Light and dark as the system is, and fit to be printed. The same bytes with the same version of libjpeg.
//
// Errors: `picture-failed`, `locks`, and `model-too-large` for a page of more than 400 MB. Precondition: as
// of book::make_book(). Cost: that of make_book(), and two pictures a step.
std::optional<std::string> write_book_html(const RunPage& page, const OutputOptions& options,
                                           Diagnostics& diagnostics);

// The same of a book that somebody else has made; its scenes show these cards.
namespace book {
std::optional<std::string> html_of(const Book& book, std::span<const SceneCard> cards,
                                   Diagnostics& diagnostics);
}  // namespace book

}  // namespace popup
