// The assembly book as pages to print.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "output/book/book.h"
#include "popup/output.h"

namespace popup {

// A PDF of A4 or letter pages, upright: cover, what is needed, the sheets, the steps, and how the card must
// open (output/book/book.h). Fonts are embedded; texts can be searched; the document's outline has chapters
// and steps. A step is not broken over pages where a page has room for it. Pictures are JPEG of some 150 dots
// an inch. The same bytes with the same versions of Cairo, FreeType and libjpeg.
//
// Errors: `font-missing`, `pdf-failed`, `picture-failed`, `locks`. Precondition: as of book::make_book().
// Cost: that of make_book(), and two pictures a step.
std::optional<std::string> write_book_pdf(const RunPage& page, const OutputOptions& options,
                                          Diagnostics& diagnostics);

// The same of a book that somebody else has made; its scenes show these cards.
namespace book {
std::optional<std::string> pdf_of(const Book& book, std::span<const SceneCard> cards,
                                  Diagnostics& diagnostics);
}  // namespace book

}  // namespace popup
