// A PDF drawn with Cairo.
#pragma once

#include <cairo.h>

#include <functional>
#include <optional>
#include <string>

#include "output/painted_pictures.h"
#include "popup/diagnostics.h"
#include "popup/geometry.h"

namespace popup {

// Shows pages, setting their sizes. The context's unit is the millimetre. Pages have their pictures in
// common.
using PdfPages = std::function<void(cairo_surface_t*, cairo_t*, PaintedPictures&)>;

// The document that the pages are: with a title, the program's name, and the date of SOURCE_DATE_EPOCH or
// none. Text is set in the font until pages choose another. Errors: `pdf-failed`.
std::optional<std::string> draw_document(const std::string& title, Vec2 first_page_mm,
                                         cairo_font_face_t* font, const PdfPages& pages,
                                         Diagnostics& diagnostics);

}  // namespace popup
