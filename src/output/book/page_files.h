// The files of the book's page, as they stand in this folder. The build makes them part of the library.
#pragma once

#include <span>

#include "output/html_page.h"

namespace popup::book {

std::span<const PageFile> book_files();

}  // namespace popup::book
