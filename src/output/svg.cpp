#include "output/svg.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string_view>

#include "output/numbers.h"
#include "output/sheet_drawing.h"

namespace popup {
namespace {

constexpr int kDecimals = 4;
constexpr int kDashDecimals = 3;

class SvgText {
 public:
    explicit SvgText(const SheetDrawing& drawing) : drawing_(drawing) {}

    std::string sheet(int index);

 private:
    void raw(std::string_view text) { out_.append(text.data(), text.data() + text.size()); }
    void escaped(std::string_view text);
    void number(double value) { append_number(out_, value, kDecimals); }
    void point(Vec2 p);  // "x,y"
    void color(Color c) { fmt::format_to(fmt::appender(out_), "#{:02x}{:02x}{:02x}", c.r, c.g, c.b); }

    void layer(SheetLayer layer);
    void layer_attributes(SheetLayer layer);
    void piece(const SheetPiece& piece, SheetLayer layer);
    void shape(const SheetPiece& piece, const SheetShape& shape);
    void geometry(const SheetShape& shape);
    void text(const SheetText& text);

    const SheetDrawing& drawing_;
    fmt::memory_buffer out_;
};

// For text and for attributes in double quotes. The names are free of control characters already; of what is
// left XML forbids only the two non-characters at the end of the basic plane.
void SvgText::escaped(std::string_view text) {
    for (std::size_t i = 0; i < text.size(); ++i) {
        switch (text[i]) {
            case '&':
                raw("&amp;");
                break;
            case '<':
                raw("&lt;");
                break;
            case '>':
                raw("&gt;");
                break;
            case '"':
                raw("&quot;");
                break;
            case '\xef':
                if (const std::string_view c = text.substr(i, 3);
                    c == "\xef\xbf\xbe" || c == "\xef\xbf\xbf") {
                    raw("\xef\xbf\xbd");
                    i += 2;
                    break;
                }
                [[fallthrough]];
            default:
                out_.push_back(text[i]);
        }
    }
}

void SvgText::point(Vec2 p) {
    number(p.x);
    out_.push_back(',');
    number(drawing_.height_mm - p.y);
}

void SvgText::geometry(const SheetShape& shape) {
    raw("d=\"");
    for (const Run& run : drawing_.runs_of(shape)) {
        char command = 'M';
        for (const Vec2 p : drawing_.points_of(run)) {
            out_.push_back(command);
            point(p);
            command = 'L';
        }
        if (run.closed) out_.push_back('Z');
    }
    out_.push_back('"');
}

void SvgText::shape(const SheetPiece& piece, const SheetShape& shape) {
    raw("   <path ");
    if (shape.plate >= 0) {
        raw("data-plate=\"");
        escaped(piece.prefix);
        escaped(piece.plate_names[static_cast<std::size_t>(shape.plate)]);
        raw("\" ");
    }
    if (shape.layer == SheetLayer::fill) {
        raw("fill=\"");
        color(shape.color);
        raw("\" ");
    } else if (shape.layer == SheetLayer::draw) {
        raw("stroke=\"");
        color(shape.color);
        raw("\" stroke-width=\"");
        number(shape.width_mm);
        raw("\" ");
    } else if (const Dashes dashes = layer_style(shape.layer).dashed
                                         ? fitted_dashes(shape.layer, drawing_.length_of(shape))
                                         : Dashes{};
               dashes.count > 0) {
        char separator = '"';
        raw("stroke-dasharray=");
        for (const double mm : dashes.pattern()) {
            out_.push_back(separator);
            append_number(out_, mm, kDashDecimals);
            separator = ' ';
        }
        raw("\" ");
    }
    geometry(shape);
    raw("/>\n");
}

// The text is set on its base line, half the capitals' height below its middle, and turned about the middle.
void SvgText::text(const SheetText& text) {
    const Vec2 middle{text.at.x, drawing_.height_mm - text.at.y};
    const std::string degrees = number_text(-text.angle * 180.0 / std::numbers::pi, kDecimals);
    raw("   <text x=\"");
    number(middle.x);
    raw("\" y=\"");
    number(middle.y + 0.5 * text.cap_mm);
    raw("\" font-size=\"");
    number(text.cap_mm / kCapHeight);
    if (degrees != "0") {
        raw("\" transform=\"rotate(");
        raw(degrees);
        raw(" ");
        number(middle.x);
        raw(" ");
        number(middle.y);
        raw(")");
    }
    raw("\">");
    escaped(text.text);
    raw("</text>\n");
}

void SvgText::piece(const SheetPiece& piece, SheetLayer layer) {
    raw("  <g data-piece=\"");
    escaped(piece.name);
    raw("\" data-design=\"");
    escaped(piece.design);
    if (piece.copy > 0) {
        raw("\" data-copy=\"");
        raw(fmt::format_int(piece.copy + 1).c_str());
    }
    raw("\">\n");
    for (const SheetShape& one : drawing_.shapes_of(piece, layer)) shape(piece, one);
    if (layer == SheetLayer::label) {
        for (const SheetText& one : drawing_.texts_of(piece)) text(one);
    }
    raw("  </g>\n");
}

void SvgText::layer_attributes(SheetLayer layer) {
    switch (layer) {
        case SheetLayer::fill:
            raw(" fill-rule=\"evenodd\" stroke=\"none\"");
            return;
        case SheetLayer::draw:
            raw(" fill=\"none\" stroke-linecap=\"round\" stroke-linejoin=\"round\"");
            return;
        case SheetLayer::label:
            raw(" fill=\"");
            color(layer_style(layer).color);
            raw("\" stroke=\"none\" font-family=\"DejaVu Sans\" text-anchor=\"middle\"");
            return;
        case SheetLayer::glue:
        case SheetLayer::valley:
        case SheetLayer::mountain:
        case SheetLayer::seam:
        case SheetLayer::cut:
            raw(" fill=\"none\" stroke=\"");
            color(layer_style(layer).color);
            raw("\" stroke-width=\"");
            number(layer_style(layer).width_mm);
            raw("\"");
            if (!layer_style(layer).dashed) raw(" stroke-linecap=\"round\" stroke-linejoin=\"round\"");
            return;
    }
}

void SvgText::layer(SheetLayer layer) {
    const std::string_view name = to_string(layer);
    raw(" <g id=\"");
    raw(name);
    raw("\" inkscape:groupmode=\"layer\" inkscape:label=\"");
    raw(name);
    raw("\"");
    layer_attributes(layer);
    raw(">\n");
    for (const SheetPiece& one : drawing_.pieces) {
        const bool holds_text = layer == SheetLayer::label && one.texts > 0;
        if (holds_text || !drawing_.shapes_of(one, layer).empty()) piece(one, layer);
    }
    raw(" </g>\n");
}

std::string SvgText::sheet(int index) {
    const std::string width = number_text(drawing_.width_mm, kDecimals);
    const std::string height = number_text(drawing_.height_mm, kDecimals);
    fmt::format_to(fmt::appender(out_),
                   "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
                   "<svg xmlns=\"http://www.w3.org/2000/svg\" "
                   "xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\" version=\"1.1\" "
                   "width=\"{0}mm\" height=\"{1}mm\" viewBox=\"0 0 {0} {1}\">\n<title>",
                   width, height);
    escaped(drawing_.title);
    raw("</title>\n<desc>");
    escaped(generator());
    fmt::format_to(fmt::appender(out_), "</desc>\n<g class=\"sheet\" id=\"sheet-{}\">\n", index + 1);
    for (const SheetLayer one : kSheetLayers) layer(one);
    raw("</g>\n</svg>\n");
    return fmt::to_string(out_);
}

}  // namespace

std::optional<std::vector<std::string>> write_svg(const Layout& layout, const OutputOptions& /*options*/,
                                                  Diagnostics& /*diagnostics*/) {
    std::vector<std::string> sheets;
    const int count = static_cast<int>(layout.sheets.size());
    sheets.reserve(layout.sheets.size());
    for (int i = 0; i < count; ++i) sheets.push_back(SvgText(draw_sheet(layout, i)).sheet(i));
    return sheets;
}

}  // namespace popup
