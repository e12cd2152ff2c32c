// What pages with the viewer in them have in common, beside what all pages have (output/html_page.h).
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>

namespace popup {

// Files of this folder with these names as they stand in a page: style sheets one after another, and scripts
// in one function, so that they share their names with nobody else.
std::string viewer_style(std::span<const std::string_view> names);
std::string viewer_script(std::span<const std::string_view> names);

// The scripts of every page, in the order in which they build on each other.
inline constexpr std::array<std::string_view, 5> kViewerScripts{"scene.js", "poses.js", "camera.js",
                                                                "draw.js", "page.js"};

// The policy (CSP) of a page with this script and this style: it allows them, pictures that are in the page,
// what `more` says ("; connect-src 'self'"), and nothing else.
std::string viewer_policy(std::string_view script, std::string_view style, std::string_view more = {});

// JSON as it may stand in an element of a page: it cannot end it, nor begin a comment there.
std::string json_in_page(std::string_view json);

}  // namespace popup
