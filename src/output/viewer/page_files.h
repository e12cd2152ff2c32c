// The files of the viewer's page, as they stand in this folder. The build makes them part of the library.
#pragma once

#include <span>
#include <string_view>

namespace popup {

struct PageFile {
    std::string_view name;  // "page.html"
    std::string_view text;
};
// By name.
std::span<const PageFile> viewer_files();

}  // namespace popup
