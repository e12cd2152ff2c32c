// Pages of the viewer, and a browser that opens them.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "support/run_program.h"

namespace popup::test {

// What stands between the two, of which the first is there once.
std::string between(const std::string& page, const std::string& begin, const std::string& end);

// The page's block of data: as it stands there, and read.
std::string scene_text(const std::string& page);
nlohmann::json scene_of(const std::string& page);

// What makes `output` of a sample ("castle.xml", "folded/town.svg").
std::vector<std::string> words_for_sample(const std::string& sample, const std::filesystem::path& output);

// Debian's Chromium, and node, which drives it.
bool have_browser();
inline constexpr const char* kNoBrowser = "there is no /usr/bin/chromium, or no node";

// What tests/tools/drive_page.mjs says of a page and of these expressions; `picture` takes what is seen at
// the end, or what is printed of it (*.pdf); "-": nothing. Null, and a failure, when the browser fails.
nlohmann::json drive(const ScratchDirectory& scratch, const std::string& page, const std::string& picture,
                     const std::vector<std::string>& expressions, const std::string& scheme = "light",
                     int width = 800, int height = 600);

// An expression for drive() that is what `then` is when `question` is true, or after ten seconds: what a page
// does of itself takes as long as the machine lets it.
std::string when(const std::string& question, const std::string& then);
// All sheets of the viewer's page are unpacked and drawn.
inline constexpr const char* kSheetsDrawn =
    "[...document.querySelectorAll('#sheets-panel img')].every((i) => i.complete && i.naturalWidth > 0)";

// What the browser says, but for the speed of pictures that it copies where there is no graphics card.
std::vector<std::string> messages_of(const nlohmann::json& driven);

}  // namespace popup::test
