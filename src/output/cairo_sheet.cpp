#include "output/cairo_sheet.h"

#include <cairo-ft.h>
#include <fmt/format.h>

#include <array>
#include <memory>
#include <set>

#include "base/text/font_file.h"
#include "base/text/visual_order.h"

namespace popup {
namespace {

using FontOptions = std::unique_ptr<cairo_font_options_t, Release<cairo_font_options_destroy>>;

class Painter {
 public:
    Painter(cairo_t* context, const SheetDrawing& drawing, PaintedPictures& pictures)
        : cairo_(context), drawing_(drawing), profile_(drawing.profile), pictures_(pictures) {}

    void draw() {
        for (const SheetLayer& layer : drawing_.layers) {
            for (const SheetShape& one : drawing_.shapes_of(layer)) shape(one);
            for (const SheetText& one : drawing_.texts_of(layer)) colored(one);
        }
    }

    void draw(const SheetPart& part) {
        auto next_shape = part.shapes.begin();
        auto next_text = part.texts.begin();
        for (const SheetLayer& layer : drawing_.layers) {
            const std::size_t shapes_end = layer.first_shape + layer.shapes;
            for (; next_shape != part.shapes.end() && *next_shape < shapes_end; ++next_shape)
                shape(drawing_.shapes[*next_shape]);
            const std::size_t texts_end = layer.first_text + layer.texts;
            for (; next_text != part.texts.end() && *next_text < texts_end; ++next_text)
                colored(drawing_.texts[*next_text]);
        }
    }

 private:
    void colored(const SheetText& one) {
        color(one.color);
        text(one);
    }
    void color(Color c) { cairo_set_source_rgb(cairo_, c.r / 255.0, c.g / 255.0, c.b / 255.0); }

    void curves(const Subpath& path) {
        const double height = drawing_.height_mm;
        cairo_move_to(cairo_, path.start.x, height - path.start.y);
        for (const PathStep& step : path.steps) {
            if (step.curve) {
                cairo_curve_to(cairo_, step.control_1.x, height - step.control_1.y, step.control_2.x,
                               height - step.control_2.y, step.to.x, height - step.to.y);
            } else {
                cairo_line_to(cairo_, step.to.x, height - step.to.y);
            }
        }
        if (path.closed) cairo_close_path(cairo_);
    }

    void trace(const SheetShape& shape) {
        for (const Run& run : drawing_.runs_of(shape)) {
            cairo_new_sub_path(cairo_);
            if (run.steps > 0) {
                curves(drawing_.path_of(run));
                continue;
            }
            for (const Vec2 p : drawing_.points_of(run)) {
                cairo_line_to(cairo_, p.x, drawing_.height_mm - p.y);
            }
            if (run.closed) cairo_close_path(cairo_);
        }
    }

    void image(const SheetShape& shape) {
        const SheetImage& shown = drawing_.images[static_cast<std::size_t>(shape.image)];
        const PaintedPictures::Picture& picture = pictures_.of(*shown.image);
        cairo_surface_t* surface = picture.surface.get();
        if (surface == nullptr) return;
        const Affine& place = shown.place;
        cairo_matrix_t matrix;
        cairo_matrix_init(&matrix, place.x.x, -place.x.y, place.y.x, -place.y.y, place.origin.x,
                          drawing_.height_mm - place.origin.y);
        cairo_save(cairo_);
        trace(shape);
        cairo_set_fill_rule(cairo_, CAIRO_FILL_RULE_EVEN_ODD);
        cairo_clip(cairo_);
        // Each use of a picture names it among the resources of what is painted on, and a page must not name
        // a thing twice: later uses are on a page within the page.
        const bool again = !painted_.insert(surface).second;
        const bool apart =
            again && cairo_surface_get_type(cairo_get_target(cairo_)) == CAIRO_SURFACE_TYPE_PDF;
        if (apart) cairo_push_group(cairo_);
        cairo_transform(cairo_, &matrix);
        cairo_scale(cairo_, picture.pixel.x, picture.pixel.y);
        cairo_set_source_surface(cairo_, surface, 0.0, 0.0);
        cairo_paint(cairo_);
        if (apart) {
            cairo_pop_group_to_source(cairo_);
            cairo_paint(cairo_);
        }
        cairo_restore(cairo_);
    }

    void shape(const SheetShape& shape) {
        if (shape.image >= 0) return image(shape);
        color(shape.color);
        trace(shape);
        if (shape.filled) {
            // Letters are filled by the other rule than areas with holes.
            cairo_set_fill_rule(cairo_, shape.operation == Operation::fill ? CAIRO_FILL_RULE_EVEN_ODD
                                                                           : CAIRO_FILL_RULE_WINDING);
            cairo_fill(cairo_);
            return;
        }
        const bool whole = !profile_.dashes(shape.operation);
        cairo_set_line_cap(cairo_, whole ? CAIRO_LINE_CAP_ROUND : CAIRO_LINE_CAP_BUTT);
        cairo_set_line_join(cairo_, whole ? CAIRO_LINE_JOIN_ROUND : CAIRO_LINE_JOIN_MITER);
        const Dashes dashes = whole ? Dashes{} : fitted_dashes(shape.operation, drawing_.length_of(shape));
        cairo_set_dash(cairo_, dashes.mm.data(), static_cast<int>(dashes.count), 0.0);
        cairo_set_line_width(cairo_, shape.width_mm);
        cairo_stroke(cairo_);
    }

    // A font other than the labels'; in its place theirs, where there is none: views_of() has told.
    cairo_font_face_t* face_of(TextFont font) {
        FontFace& face = fonts_.at(static_cast<std::size_t>(font));
        if (face == nullptr) face = open_font(font_path(font));
        return face == nullptr ? cairo_get_font_face(cairo_) : face.get();
    }

    void text(const SheetText& text) {
        cairo_save(cairo_);
        cairo_translate(cairo_, text.at.x, drawing_.height_mm - text.at.y);
        cairo_rotate(cairo_, -text.angle);
        if (text.font != TextFont::sans) cairo_set_font_face(cairo_, face_of(text.font));
        cairo_set_font_size(cairo_, text.cap_mm / kCapHeight);
        const std::string set = in_visual_order(text.text);
        cairo_text_extents_t extents{};
        cairo_text_extents(cairo_, set.c_str(), &extents);
        cairo_move_to(cairo_, -0.5 * extents.x_advance, 0.5 * text.cap_mm);
        cairo_show_text(cairo_, set.c_str());
        cairo_restore(cairo_);
        cairo_new_path(cairo_);
    }

    cairo_t* cairo_;
    const SheetDrawing& drawing_;
    const Profile& profile_;
    PaintedPictures& pictures_;
    std::set<const cairo_surface_t*> painted_;
    std::array<FontFace, kTextFontNames.size()> fonts_;
};

}  // namespace

FontFace open_font(const std::string& file) {
    static const cairo_user_data_key_t kOwner{};
    std::unique_ptr<FontFile> owned = FontFile::open(file);
    if (owned == nullptr) return nullptr;
    FontFace font(cairo_ft_font_face_create_for_ft_face(owned->face, FT_LOAD_NO_HINTING | FT_LOAD_NO_BITMAP));
    const auto give_back = [](void* data) { delete static_cast<FontFile*>(data); };
    if (cairo_font_face_set_user_data(font.get(), &kOwner, owned.get(), give_back) != CAIRO_STATUS_SUCCESS) {
        return nullptr;
    }
    static_cast<void>(owned.release());
    return font;
}

void set_font(cairo_t* context, cairo_font_face_t* font) {
    const FontOptions options(cairo_font_options_create());
    cairo_font_options_set_hint_style(options.get(), CAIRO_HINT_STYLE_NONE);
    cairo_font_options_set_hint_metrics(options.get(), CAIRO_HINT_METRICS_OFF);
    cairo_set_font_options(context, options.get());
    cairo_set_font_face(context, font);
}

void paint_sheet(cairo_t* context, const SheetDrawing& drawing, PaintedPictures& pictures) {
    Painter(context, drawing, pictures).draw();
}

void paint_part(cairo_t* context, const SheetDrawing& drawing, const SheetPart& part,
                PaintedPictures& pictures) {
    Painter(context, drawing, pictures).draw(part);
}

void report_missing_font(const std::string& file, Diagnostics& diagnostics) {
    diagnostics
        .error("font-missing", {}, fmt::format("the font of the labels cannot be read from \"{}\"", file))
        .hint(
            "install DejaVu Sans (on Debian the package fonts-dejavu-core), or write SVG with the profile "
            "workshop, which needs no font file");
}

}  // namespace popup
