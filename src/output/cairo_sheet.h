// A sheet drawn with Cairo: what pages and raster pictures have in common.
#pragma once

#include <cairo.h>

#include <map>
#include <memory>
#include <string>

#include "output/sheet_drawing.h"
#include "output/tile_parts.h"

namespace popup {

template <auto release>
struct Release {
    template <typename T>
    void operator()(T* thing) const {
        release(thing);
    }
};
using Surface = std::unique_ptr<cairo_surface_t, Release<cairo_surface_destroy>>;
using Context = std::unique_ptr<cairo_t, Release<cairo_destroy>>;
using FontFace = std::unique_ptr<cairo_font_face_t, Release<cairo_font_face_destroy>>;

// Null when the file cannot be read as a font. Cairo keeps font faces in its cache after their last user has
// gone, so it is the face that owns the file and gives it back.
FontFace open_font(const std::string& file);

// Text is set in this font, as its designer measured it, not fitted to some device's pixels.
void set_font(cairo_t* context, cairo_font_face_t* font);

// Draws the sheet. The context's unit is the millimetre, y down from the sheet's upper edge.
void paint_sheet(cairo_t* context, const SheetDrawing& drawing);

// Pictures as Cairo has them, by their bytes, so that several pages decode one once.
using PaintedPictures = std::map<const std::string*, Surface>;
// Draws only a part of it, in the same order.
void paint_part(cairo_t* context, const SheetDrawing& drawing, const SheetPart& part,
                PaintedPictures& pictures);

// The error `font-missing` for a file that open_font() cannot read.
void report_missing_font(const std::string& file, Diagnostics& diagnostics);

}  // namespace popup
