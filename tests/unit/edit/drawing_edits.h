// Edits of folded drawings, as tests carry them out: a tray, and where its vertices are then.
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "popup/crease_pattern.h"
#include "popup/diagnostics.h"
#include "popup/edit_drawing.h"
#include "popup/geometry.h"
#include "popup/language.h"
#include "popup/sheet_edit.h"

namespace popup::test {

inline std::vector<std::string> words_of(const std::string& text) {
    std::istringstream in(text);
    std::vector<std::string> words;
    for (std::string word; in >> word;) words.push_back(word);
    return words;
}

struct Done {
    std::optional<std::string> text;
    std::string told;
};

inline Done edit(const std::string& drawing, const std::vector<std::string>& edits,
                 DrawingEditOptions options = {}) {
    std::vector<EditLine> lines;
    for (const std::string& one : edits) lines.push_back({words_of(one), {}});
    Diagnostics said("box.svg");
    const auto edited = edit_drawing({"box.svg", drawing}, lines, options, said, said);
    Done done;
    if (edited) done.text = edited->text;
    for (const Diagnostic& one : said.sorted()) done.told += one.message + " [" + one.code + "]\n";
    return done;
}

inline CreasePattern pattern_of(const std::string& drawing) {
    Diagnostics said("box.svg");
    ReadOptions read;
    read.drawing.as = DrawnAs::folded;
    Reading reading = read_source_text({"box.svg", drawing}, read, said);
    EXPECT_TRUE(reading.creases) << drawing;
    return reading.creases ? std::move(*reading.creases) : CreasePattern{};
}

// Where the vertices of a folded drawing are.
inline std::map<std::string, Vec3> vertices_of(const std::string& drawing) {
    Diagnostics said("box.svg");
    std::map<std::string, Vec3> places;
    const auto sheet = show_sheet(pattern_of(drawing), {}, {}, said);
    if (!sheet) return places;
    for (const ShownSheet::Panel& panel : sheet->panels) {
        for (const ShownSheet::Vertex& one : panel.vertices) places[one.name] = one.at;
    }
    return places;
}

// Four walls of 40 mm around a base of 100 mm, with a window.
inline const std::string kTray =
    R"(<svg xmlns="http://www.w3.org/2000/svg" width="200mm" height="200mm" viewBox="0 0 200 200">
 <g fill="none" stroke-width="0.3">
  <!-- the outline -->
  <path class="cut" stroke="#000000" d="M50 10H150V50H190V150H150V190H50V150H10V50H50Z"/>
  <path id="crease" class="mountain" stroke="#ff0000" d="M50 50H150V150H50Z"/>
  <circle class="cut" stroke="#000000" cx="100" cy="100" r="12"/>
 </g>
</svg>
)";

inline const std::string kRectangle =
    "<rect id=\"crease\" class=\"mountain\" stroke=\"#ff0000\" x=\"50\" y=\"50\" width=\"100\" "
    "height=\"100\"/>";

}  // namespace popup::test
