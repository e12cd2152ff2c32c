// The formats: one row each. What `popupc list formats` and `-o` know of them follows from the rows.
#include <algorithm>
#include <array>

#include "output/book/book_html.h"
#include "output/book/book_pdf.h"
#include "output/dxf.h"
#include "output/fold.h"
#include "output/gltf.h"
#include "output/hpgl.h"
#include "output/lightburn.h"
#include "output/pdf.h"
#include "output/raster.h"
#include "output/report.h"
#include "output/still/animation.h"
#include "output/still/still.h"
#include "output/svg.h"
#include "output/viewer/viewer.h"
#include "output/xml.h"
#include "popup/output.h"

namespace popup {
namespace {

constexpr OptionUses kMoving{.view = true, .size = true, .rate = true};

const std::array kFormats{
    Format{".svg",
           "cut sheets, one file a sheet, with a layer for each kind of line",
           SheetWriter{write_svg},
           Stills::none,
           {.legend = true}},
    Format{".book.pdf", "the assembly book: the steps in their order, with pictures, to print",
           PageWriter{write_book_pdf}, Stills::made},
    Format{".book.html", "the same, as a page to read", PageWriter{write_book_html}, Stills::made},
    Format{".pdf",
           "cut sheets in true size, a page a sheet",
           SheetWriter{write_pdf},
           Stills::none,
           {.legend = true}},
    Format{".dxf", "cut sheets as AutoCAD 2000 drawings in mm, one file a sheet", SheetWriter{write_dxf}},
    Format{".lbrn2",
           "cut sheets as LightBurn projects, one file a sheet, with a cut setting a layer",
           SheetWriter{write_lightburn},
           Stills::none,
           {.speeds = true}},
    Format{".plt", "cut sheets as HP-GL for plotters, one file a sheet, a pen a layer",
           SheetWriter{write_hpgl}},
    Format{".view.png",
           "pictures of the model, one file a --view and opening (--at)",
           StillWriter{write_view_png},
           Stills::all,
           {.view = true, .size = true, .openings = true}},
    Format{".png",
           "pictures of cut sheets, one file a sheet, in true size at --dpi",
           SheetWriter{write_png},
           Stills::none,
           {.dpi = true, .legend = true}},
    Format{".jpg", "pictures of 800 × 650 pixels, one file a piece's pattern page", SheetWriter{write_jpg}},
    Format{".webp", "the card opening and closing, as a moving picture, one file a --view",
           StillWriter{write_webp}, Stills::none, kMoving},
    Format{".gif", "the same as a GIF, for what shows no WebP", StillWriter{write_gif}, Stills::none,
           kMoving},
    Format{".glb",
           "the model, in one binary glTF file: cards move, parts stand",
           SceneWriter{write_glb},
           Stills::all,
           {.rate = true, .edge_lines = true}},
    Format{".gltf",
           "the model, as glTF text",
           SceneWriter{write_gltf},
           Stills::all,
           {.rate = true, .edge_lines = true}},
    Format{".html",
           "the model, in a page to turn it, and to open and close it",
           PageWriter{write_viewer},
           Stills::all,
           {.rate = true},
           begin_viewer},
    Format{".fold",
           "the crease pattern and the sampled poses, as FOLD 1.2",
           SceneWriter{write_fold},
           Stills::sheets,
           {.fold_dialect = true}},
    Format{".xml", "the popup document, with what was repaired", DocumentWriter{write_xml}},
    Format{".json",
           "the report: repairs, findings, motion and layout",
           ReportWriter{write_report},
           Stills::none,
           {.speeds = true}},
};

// Of ASCII letters only, whatever the locale.
char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

bool same_letters(std::string_view a, std::string_view b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](char x, char y) { return lower(x) == lower(y); });
}

}  // namespace

std::span<const Format> format_table() { return kFormats; }

const Format* find_format(std::string_view path) {
    for (const Format& row : kFormats) {
        if (same_letters(path, row.suffix.substr(1))) return &row;
        if (path.size() < row.suffix.size()) continue;
        if (same_letters(path.substr(path.size() - row.suffix.size()), row.suffix)) return &row;
    }
    return nullptr;
}

}  // namespace popup
