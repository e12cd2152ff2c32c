// The files of the gallery's pages, as they stand in this folder. The build makes them part of the library.
#pragma once

#include <span>

#include "output/html_page.h"

namespace popup {

// By name.
std::span<const PageFile> gallery_files();

}  // namespace popup
