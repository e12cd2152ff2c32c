// A library of designs as pages: one with a tile a design, and pages of designs that the viewer cannot show.
//
//     GalleryTile tile{.title = "castle", .file = "spring/castle.xml", .page = "designs/castle.html"};
//     tile.elements = {{"tent", 2}};
//     const std::string page = write_gallery("Spring cards", std::vector{tile});
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "popup/output.h"

namespace popup {

// How often one diagnostic was given.
struct FindingCount {
    std::string code;
    Severity severity = Severity::remark;
    std::size_t count = 0;
};

// What the gallery says of one design. Texts may hold anything; addresses are of letters, digits, '-', '.'
// and '/'.
struct GalleryTile {
    std::string title;    // what it is called: the name of its file without the suffix
    std::string file;     // its file, as it is named in the library
    std::string page;     // the address of its page, counted from the gallery's
    std::string picture;  // likewise, of its picture of kTileSize; empty: there is none
    std::vector<std::pair<std::string, std::size_t>> elements;  // names and how many, by name
    double width_mm = 0.0, height_mm = 0.0;  // of the open card, or of the largest piece; 0: not known
    std::size_t pieces = 0, sheets = 0;      // 0: not known
    std::vector<FindingCount> findings;      // worst first, then by code
    std::vector<std::string> errors;         // what is told in place of the picture, at most kTileErrors
};
inline constexpr PictureSize kTileSize{480, 360};
inline constexpr std::size_t kTileErrors = 3;

// The tile's findings, and of errors the first messages.
void tell_findings(std::span<const Diagnostic> findings, GalleryTile& tile);

// The page of the whole gallery, its tiles in the order given. Search and filters (by element, finding and
// size) are a small script; without it all tiles are there. The policy lets in its own style and script, by
// their SHA-256, and pictures that stand beside it. No text of a design is read as markup or script. The
// address says what is searched for, behind "#": "index.html#words=castle&element=tent".
//
// The same input gives the same bytes. Length: some 12 KB, and 400 bytes to 1 KB a tile.
std::string write_gallery(const std::string& title, std::span<const GalleryTile> tiles);

// The page of a design without a model: its sheets, as the SVG output draws them (null: there are none), and
// its findings. It leads back to the gallery at the address `gallery`. No script. Errors: those of
// write_svg().
std::optional<std::string> write_plain_page(const GalleryTile& tile, const std::string& gallery,
                                            const Layout* layout, std::span<const Diagnostic> findings,
                                            const OutputOptions& options, Diagnostics& diagnostics);

// What is used of the first sheet as a PNG that fits into kTileSize. Errors: those of write_png().
std::optional<std::string> sheet_picture(const Layout& layout, const OutputOptions& options,
                                         Diagnostics& diagnostics);

}  // namespace popup
