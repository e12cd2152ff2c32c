// A PDF drawn with Cairo.
#pragma once

#include <cairo.h>

#include <functional>
#include <string>

#include "popup/geometry.h"

namespace popup {

// Shows pages, setting their sizes. The context's unit is the millimetre.
using PdfPages = std::function<void(cairo_surface_t*, cairo_t*)>;

// The document that the pages are: with a title, the program's name, and the date of SOURCE_DATE_EPOCH or
// none. Text is set in the font until pages choose another. What is not CAIRO_STATUS_SUCCESS is why there is
// none.
cairo_status_t draw_document(const std::string& title, Vec2 first_page_mm, cairo_font_face_t* font,
                             const PdfPages& pages, std::string& bytes);

}  // namespace popup
