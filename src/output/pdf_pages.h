// What the writers of PDF have in common: units, the size of pages, and the date.
#pragma once

#include <ctime>
#include <optional>

#include "popup/diagnostics.h"
#include "popup/layout.h"

namespace popup {

inline constexpr double kPointsPerMm = 72.0 / 25.4;

// False when a sheet is larger than a PDF page can be (14400 points a side, 5080 mm; ISO 32000-1, annex C.2).
// Error then: `pdf-page-size`.
bool fits_pages(const Layout& layout, Diagnostics& diagnostics);
// The same of one page.
bool fits_page(double width_mm, double height_mm, Diagnostics& diagnostics);

// SOURCE_DATE_EPOCH in UTC; nothing when it is not set, or no whole number of seconds from 1970 to 9999.
std::optional<std::tm> source_date();

}  // namespace popup
