// Pictures as Cairo paints them.
//
// To make a PDF, Cairo takes the files of JPEGs as they are, but packs all other pictures anew, which costs
// more than all else of a document. A PNG has its picture in the very form that a PDF has. So Cairo is given
// a stand-in of a few pixels, whose place the PNG's own rows take when the document is complete:
//
//   PaintedPictures pictures(PaintedPictures::For::document);
//   draw(context, pictures);  // takes each picture from of()
//   ...                       // Cairo has finished the document
//   put_rows(pictures, document);
#pragma once

#include <map>
#include <optional>
#include <string>

#include "output/cairo_handles.h"
#include "output/png_rows.h"

namespace popup {

class PaintedPictures {
 public:
    enum class For { pixels, document };
    explicit PaintedPictures(For use) : use_(use) {}

    // The picture with its upper left corner at the origin, its pixels as large as the whole picture's place
    // asks for: scale it by `pixel`, and it covers image.width × image.height. `surface` is null where it
    // cannot be decoded.
    struct Picture {
        Surface surface;
        Vec2 pixel{1.0, 1.0};
    };
    // Decodes a picture once, however often it is painted. The same one has the same surface.
    const Picture& of(const Image& image);

 private:
    friend void put_rows(const PaintedPictures& pictures, std::string& document);
    struct Rows {
        PngRows rows;
        int width = 0;
        int height = 0;
    };
    std::optional<Picture> stand_in(const Image& image);

    For use_;
    std::map<const std::string*, Picture> made_;  // by the bytes of their files
    std::map<std::string, Rows> rows_;            // by the pixels of their stand-ins, which are digests
};

// Replaces the stand-ins of a document; as it was where it has none. The same bytes with the same version of
// qpdf. Throws std::runtime_error where qpdf cannot read the document.
void put_rows(const PaintedPictures& pictures, std::string& document);

}  // namespace popup
