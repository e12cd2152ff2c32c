// The files of the viewer's page, as they stand in this folder. The build makes them part of the library.
#pragma once

#include <span>

#include "output/html_page.h"

namespace popup {

// By name.
std::span<const PageFile> viewer_files();

}  // namespace popup
