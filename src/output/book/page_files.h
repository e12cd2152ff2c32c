// The files of the book's page, as they stand in this folder. The build makes them part of the library.
#pragma once

#include <span>
#include <string_view>

namespace popup::book {

struct BookFile {
    std::string_view name;  // "book.css"
    std::string_view text;
};
std::span<const BookFile> book_files();

}  // namespace popup::book
