// Cut sheets as PDF in true size: a page a sheet, or several that are glued together.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "popup/output.h"

namespace popup {

// One PDF document of all sheets: the same drawing as the SVG, page sizes exact, labels as text in an
// embedded subset of DejaVu Sans. It carries no date unless SOURCE_DATE_EPOCH is set, and is the same byte
// for byte with the same versions of Cairo and FreeType. Coordinates are Cairo's: whole 1/256 points (0.0014
// mm). Errors: `font-missing`, `pdf-page-size` (a PDF page has at most 14400 points, 5080 mm, a side),
// `pdf-failed`. With OutputOptions::tile the pages are those of tiled_pdf.h instead, of the size of that
// paper; its errors, and those of can_tile(), then are errors here. Profiles whose pens have spot colours get
// the document of production_pdf.h instead.
std::optional<std::vector<SheetFile>> write_pdf(const Layout& layout, const OutputOptions& options,
                                                Diagnostics& diagnostics);

// The same with the labels' font from `font_file`.
std::optional<std::vector<SheetFile>> write_pdf_with_font(const Layout& layout, const OutputOptions& options,
                                                          const std::string& font_file,
                                                          Diagnostics& diagnostics);

}  // namespace popup
