// A sheet drawn with Cairo: what pages and raster pictures have in common.
#pragma once

#include <cairo.h>

#include <string>

#include "output/cairo_handles.h"
#include "output/painted_pictures.h"
#include "output/sheet_drawing.h"
#include "output/tile_parts.h"

namespace popup {

// Null when the file cannot be read as a font. Cairo keeps font faces in its cache after their last user has
// gone, so it is the face that owns the file and gives it back.
FontFace open_font(const std::string& file);

// Text is set in this font, as its designer measured it, not fitted to some device's pixels.
void set_font(cairo_t* context, cairo_font_face_t* font);

// Draws the sheet. The context's unit is the millimetre, y down from the sheet's upper edge. Several sheets
// of one document share their pictures.
void paint_sheet(cairo_t* context, const SheetDrawing& drawing, PaintedPictures& pictures);
// Draws only a part of it, in the same order.
void paint_part(cairo_t* context, const SheetDrawing& drawing, const SheetPart& part,
                PaintedPictures& pictures);

// The error `font-missing` for a file that open_font() cannot read.
void report_missing_font(const std::string& file, Diagnostics& diagnostics);

}  // namespace popup
