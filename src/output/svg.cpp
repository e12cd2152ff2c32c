#include "output/svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

#include "base/render_diagnostics.h"
#include "output/numbers.h"
#include "output/sheet_drawing.h"

namespace popup {
namespace {

constexpr int kDecimals = 4;
constexpr int kDashDecimals = 3;

class SvgText {
 public:
    SvgText(const SheetDrawing& drawing, const Profile& profile) : drawing_(drawing), profile_(profile) {}

    std::string sheet(int index);

 private:
    void raw(std::string_view text) { out_.append(text.data(), text.data() + text.size()); }
    void escaped(std::string_view text);
    void number(double value) { append_number(out_, value, kDecimals); }
    void point(Vec2 p);  // "x,y"
    void color(Color c) { fmt::format_to(fmt::appender(out_), "#{:02x}{:02x}{:02x}", c.r, c.g, c.b); }

    void layer(const SheetLayer& layer);
    [[nodiscard]] std::string attributes(Operation operation) const;
    void pieces(Operation first, Operation last);
    void piece(const SheetPiece& piece, Operation first, Operation last);
    void shape(const SheetPiece& piece, const SheetShape& shape);
    void paint(const SheetShape& shape);
    void geometry(const SheetShape& shape);
    void text(const SheetText& text);

    const SheetDrawing& drawing_;
    const Profile& profile_;
    std::vector<std::string> ids_;  // given so far
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

void SvgText::paint(const SheetShape& shape) {
    if (shape.operation == Operation::fill) {
        raw("fill=\"");
        color(shape.color);
        raw("\" ");
    } else if (profile_.styled_paths) {
        raw("style=\"fill:none;stroke:");
        color(shape.color);
        raw(";stroke-width:");
        number(shape.width_mm);
        raw("\" ");
    } else if (shape.operation == Operation::draw) {
        raw("stroke=\"");
        color(shape.color);
        raw("\" stroke-width=\"");
        number(shape.width_mm);
        raw("\" ");
    }
    if (!profile_.dashes(shape.operation)) return;
    const Dashes dashes = fitted_dashes(shape.operation, drawing_.length_of(shape));
    if (dashes.count == 0) return;
    char separator = '"';
    raw("stroke-dasharray=");
    for (const double mm : dashes.pattern()) {
        out_.push_back(separator);
        append_number(out_, mm, kDashDecimals);
        separator = ' ';
    }
    raw("\" ");
}

void SvgText::shape(const SheetPiece& piece, const SheetShape& shape) {
    raw("   <path ");
    if (shape.plate >= 0) {
        raw("data-plate=\"");
        escaped(piece.prefix);
        escaped(piece.plate_names[static_cast<std::size_t>(shape.plate)]);
        raw("\" ");
    }
    paint(shape);
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

void SvgText::piece(const SheetPiece& piece, Operation first, Operation last) {
    raw("  <g data-piece=\"");
    escaped(piece.name);
    raw("\" data-design=\"");
    escaped(piece.design);
    if (piece.copy > 0) {
        raw("\" data-copy=\"");
        raw(fmt::format_int(piece.copy + 1).c_str());
    }
    raw("\">\n");
    for (const SheetShape& one : drawing_.shapes_of(piece, first, last)) shape(piece, one);
    if (first == Operation::label) {
        for (const SheetText& one : drawing_.texts_of(piece)) text(one);
    }
    raw("  </g>\n");
}

void SvgText::pieces(Operation first, Operation last) {
    for (const SheetPiece& one : drawing_.pieces) {
        const bool holds_text = first == Operation::label && one.texts > 0;
        if (holds_text || !drawing_.shapes_of(one, first, last).empty()) piece(one, first, last);
    }
}

std::string SvgText::attributes(Operation operation) const {
    const Pen& pen = profile_.pen(operation);
    if (operation == Operation::fill) return " fill-rule=\"evenodd\" stroke=\"none\"";
    if (operation == Operation::draw)
        return " fill=\"none\" stroke-linecap=\"round\" stroke-linejoin=\"round\"";
    if (operation == Operation::label) {
        return fmt::format(" fill=\"{}\" stroke=\"none\" font-family=\"DejaVu Sans\" text-anchor=\"middle\"",
                           to_string(pen.color));
    }
    return fmt::format(
        " fill=\"none\" stroke=\"{}\" stroke-width=\"{}\"{}", to_string(pen.color),
        number_text(pen.width_mm, kDecimals),
        profile_.dashes(operation) ? "" : " stroke-linecap=\"round\" stroke-linejoin=\"round\"");
}

// An XML name that looks like the layer's.
std::string id_of(std::string_view layer) {
    std::string id;
    for (const char c : layer) {
        const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
        const bool later = (c >= '0' && c <= '9') || c == '-' || c == '.';
        if (id.empty() && !letter) id += '_';
        id += letter || later ? c : '-';
    }
    return id;
}

// What is drawn alike stands in the layer's group piece by piece; else each operation has a group in it.
void SvgText::layer(const SheetLayer& layer) {
    std::vector<Operation> drawn;
    for (const Operation one : kOperations) {
        if (one >= layer.first && one <= layer.last && profile_.draws(one)) drawn.push_back(one);
    }
    const std::string look = attributes(layer.first);
    const bool alike =
        std::all_of(drawn.begin(), drawn.end(), [&](Operation one) { return attributes(one) == look; });
    raw(" <g id=\"");
    std::string id = id_of(layer.name);
    for (int i = 2; std::find(ids_.begin(), ids_.end(), id) != ids_.end(); ++i)
        id = fmt::format("{}-{}", id_of(layer.name), i);
    raw(id);
    ids_.push_back(std::move(id));
    raw("\" inkscape:groupmode=\"layer\" inkscape:label=\"");
    escaped(visible(layer.name));
    raw("\"");
    if (alike) {
        raw(look);
        raw(">\n");
        pieces(layer.first, layer.last);
    } else {
        raw(">\n");
        for (const Operation one : drawn) {
            raw(" <g class=\"");
            raw(to_string(one));
            raw("\"");
            raw(attributes(one));
            raw(">\n");
            pieces(one, one);
            raw(" </g>\n");
        }
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
    ids_ = {fmt::format("sheet-{}", index + 1)};
    for (const SheetLayer& one : layers_of(profile_)) layer(one);
    raw("</g>\n</svg>\n");
    return fmt::to_string(out_);
}

}  // namespace

std::optional<std::vector<std::string>> write_svg(const Layout& layout, const OutputOptions& options,
                                                  Diagnostics& /*diagnostics*/) {
    std::vector<std::string> sheets;
    const int count = static_cast<int>(layout.sheets.size());
    sheets.reserve(layout.sheets.size());
    for (int i = 0; i < count; ++i) {
        const SheetDrawing drawing = draw_sheet(layout, options.profile, i);
        sheets.push_back(SvgText(drawing, options.profile).sheet(i));
    }
    return sheets;
}

}  // namespace popup
