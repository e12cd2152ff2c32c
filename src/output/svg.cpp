#include "output/svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string_view>

#include "base/diagnostics/render_diagnostics.h"
#include "base/text/base64.h"
#include "base/text/numbers.h"
#include "output/sheet_drawing.h"
#include "popup/image.h"

namespace popup {
namespace {

constexpr int kDecimals = 4;
constexpr int kAngleDecimals = 6;
// By which folds of drawings go that do not say it (CreasePattern::fold_deg).
constexpr std::string_view kUnsaidDegrees = "90";
constexpr int kDashDecimals = 3;

class SvgText {
 public:
    explicit SvgText(const SheetDrawing& drawing) : drawing_(drawing), profile_(drawing.profile) {}

    std::string sheet(int index);

 private:
    void raw(std::string_view text) { out_.append(text.data(), text.data() + text.size()); }
    void escaped(std::string_view text);
    void number(double value) { append_number(out_, value, kDecimals); }
    void point(Vec2 p);  // "x,y"
    void color(Color c) { fmt::format_to(fmt::appender(out_), "#{:02x}{:02x}{:02x}", c.r, c.g, c.b); }

    void layer(const SheetLayer& layer);
    [[nodiscard]] std::string attributes(Operation operation) const;
    void shapes(std::span<const SheetShape> shapes);
    void texts(std::span<const SheetText> texts);
    void begin_piece(int piece);
    void end_piece(int piece);
    void shape(const SheetShape& shape);
    void paint(const SheetShape& shape);
    void geometry(const SheetShape& shape);
    void curves(const Subpath& path);
    void text(const SheetText& text);
    void image(const SheetShape& shape);
    std::string fresh_id(const std::string& wanted);
    void plate(const SheetShape& shape);
    void fold_angle(const SheetShape& shape);

    const SheetDrawing& drawing_;
    const Profile& profile_;
    std::vector<std::string> ids_;                        // given so far
    std::map<const std::string*, std::string> pictures_;  // ids of those that stand in the file already
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

void SvgText::curves(const Subpath& path) {
    out_.push_back('M');
    point(path.start);
    for (const PathStep& step : path.steps) {
        out_.push_back(step.curve ? 'C' : 'L');
        if (step.curve) {
            point(step.control_1);
            out_.push_back(' ');
            point(step.control_2);
            out_.push_back(' ');
        }
        point(step.to);
    }
    if (path.closed) out_.push_back('Z');
}

void SvgText::geometry(const SheetShape& shape) {
    raw("d=\"");
    for (const Run& run : drawing_.runs_of(shape)) {
        if (run.steps > 0) {
            curves(drawing_.path_of(run));
            continue;
        }
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
    if (shape.filled) {
        if (shape.operation == Operation::registration || shape.operation == Operation::draw)
            raw("stroke=\"none\" ");
        const bool as_layer =
            shape.operation == Operation::label && shape.color == profile_.pen(Operation::label).color;
        if (as_layer) return;
        raw("fill=\"");
        color(shape.color);
        raw("\" ");
    } else if (profile_.styled_paths) {
        raw("style=\"fill:none;stroke:");
        color(shape.color);
        raw(";stroke-width:");
        number(shape.width_mm);
        raw("\" ");
    } else if (shape.operation == Operation::draw || shape.operation == Operation::legend) {
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

void SvgText::plate(const SheetShape& shape) {
    if (shape.plate < 0) return;
    const SheetPiece& piece = drawing_.pieces[static_cast<std::size_t>(shape.piece)];
    raw("data-plate=\"");
    escaped(piece.prefix);
    escaped(piece.plate_names[static_cast<std::size_t>(shape.plate)]);
    raw("\" ");
}

// Where who reads the drawing would take another angle.
void SvgText::fold_angle(const SheetShape& shape) {
    if (!shape.fold_angle) return;
    const std::string degrees = number_text(*shape.fold_angle * 180.0 / std::numbers::pi, kAngleDecimals);
    if (degrees == kUnsaidDegrees) return;
    raw("data-fold-angle=\"");
    raw(degrees);
    raw("\" ");
}

std::string SvgText::fresh_id(const std::string& wanted) {
    std::string id = wanted;
    for (int i = 2; std::find(ids_.begin(), ids_.end(), id) != ids_.end(); ++i)
        id = fmt::format("{}-{}", wanted, i);
    ids_.push_back(id);
    return id;
}

// The file of a picture stands where it is first used, and is named by others that show parts of it.
void SvgText::image(const SheetShape& shape) {
    const SheetImage& shown = drawing_.images[static_cast<std::size_t>(shape.image)];
    const Image& image = *shown.image;
    constexpr std::string_view kLinks = "xmlns:xlink=\"http://www.w3.org/1999/xlink\" xlink:href=\"";
    const auto [picture, fresh] = pictures_.try_emplace(image.bytes.get());
    if (fresh) {
        picture->second = fresh_id(fmt::format("picture-{}", pictures_.size()));
        fmt::format_to(fmt::appender(out_),
                       "   <defs><image id=\"{}\" width=\"{}\" height=\"{}\" "
                       "preserveAspectRatio=\"none\" {}data:{};base64,",
                       picture->second, image.width, image.height, kLinks, mime_type(image.format));
        raw(base64(*image.bytes));
        raw("\"/></defs>\n");
    }
    const std::string clip = fresh_id(fmt::format("clip-{}", shape.image + 1));
    fmt::format_to(fmt::appender(out_), "   <g clip-path=\"url(#{0})\" ", clip);
    plate(shape);
    fmt::format_to(fmt::appender(out_), "><clipPath id=\"{}\"><path clip-rule=\"evenodd\" ", clip);
    geometry(shape);
    fmt::format_to(fmt::appender(out_), "/></clipPath><use {}#{}\" transform=\"matrix(", kLinks,
                   picture->second);
    const Affine& place = shown.place;
    // Of pixels, of which there may be many thousand in a row.
    constexpr int kPixelDecimals = 9;
    for (const double value : {place.x.x, -place.x.y, place.y.x, -place.y.y}) {
        append_number(out_, value, kPixelDecimals);
        out_.push_back(' ');
    }
    number(place.origin.x);
    out_.push_back(' ');
    number(drawing_.height_mm - place.origin.y);
    raw(")\"/></g>\n");
}

void SvgText::shape(const SheetShape& shape) {
    if (shape.image >= 0) return image(shape);
    raw("   <path ");
    plate(shape);
    fold_angle(shape);
    paint(shape);
    geometry(shape);
    raw("/>\n");
}

// Of a printed text; labels have those of their layer.
std::string_view font_attributes(TextFont font) {
    switch (font) {
        case TextFont::sans:
            return "text-anchor=\"middle\" font-family=\"DejaVu Sans\" ";
        case TextFont::sans_bold:
            return "text-anchor=\"middle\" font-family=\"DejaVu Sans\" font-weight=\"bold\" ";
        case TextFont::serif:
            return "text-anchor=\"middle\" font-family=\"DejaVu Serif\" ";
        case TextFont::serif_bold:
            return "text-anchor=\"middle\" font-family=\"DejaVu Serif\" font-weight=\"bold\" ";
        case TextFont::mono:
            return "text-anchor=\"middle\" font-family=\"DejaVu Sans Mono\" ";
        case TextFont::mono_bold:
            return "text-anchor=\"middle\" font-family=\"DejaVu Sans Mono\" font-weight=\"bold\" ";
    }
    broken_invariant("a font is one of its enumerators", __FILE__, __LINE__);
}

// The text is set on its base line, half the capitals' height below its middle, and turned about the middle.
void SvgText::text(const SheetText& text) {
    const Vec2 middle{text.at.x, drawing_.height_mm - text.at.y};
    const std::string degrees = number_text(-text.angle * 180.0 / std::numbers::pi, kDecimals);
    raw("   <text ");
    if (text.operation != Operation::label) {
        raw("stroke=\"none\" fill=\"");
        color(text.color);
        raw("\" ");
    }
    if (text.operation == Operation::label && text.color != profile_.pen(Operation::label).color) {
        raw("fill=\"");
        color(text.color);
        raw("\" ");
    }
    if (text.operation == Operation::draw) raw(font_attributes(text.font));
    raw("x=\"");
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

void SvgText::begin_piece(int piece) {
    if (piece < 0) return;
    const SheetPiece& one = drawing_.pieces[static_cast<std::size_t>(piece)];
    raw("  <g data-piece=\"");
    escaped(one.name);
    raw("\" data-design=\"");
    escaped(one.design);
    if (one.copy > 0) {
        raw("\" data-copy=\"");
        raw(fmt::format_int(one.copy + 1).c_str());
    }
    raw("\">\n");
}

void SvgText::end_piece(int piece) {
    if (piece >= 0) raw("  </g>\n");
}

// What follows each other and is of one piece stands in a group of it.
void SvgText::shapes(std::span<const SheetShape> shapes) {
    const SheetShape* last = nullptr;
    for (const SheetShape& one : shapes) {
        // Who reads the file again would take it for an area of the design.
        if (one.halo) continue;
        if (last == nullptr || one.piece != last->piece) {
            if (last != nullptr) end_piece(last->piece);
            begin_piece(one.piece);
        }
        shape(one);
        last = &one;
    }
    if (last != nullptr) end_piece(last->piece);
}

void SvgText::texts(std::span<const SheetText> texts) {
    for (std::size_t i = 0; i < texts.size(); ++i) {
        if (i == 0 || texts[i].piece != texts[i - 1].piece) begin_piece(texts[i].piece);
        text(texts[i]);
        if (i + 1 == texts.size() || texts[i].piece != texts[i + 1].piece) end_piece(texts[i].piece);
    }
}

std::string SvgText::attributes(Operation operation) const {
    const Pen& pen = profile_.pen(operation);
    if (operation == Operation::fill) return " fill-rule=\"evenodd\" stroke=\"none\"";
    if (operation == Operation::draw)
        return " fill=\"none\" stroke-linecap=\"round\" stroke-linejoin=\"round\"";
    if (operation == Operation::legend)
        return " fill=\"none\" stroke-linecap=\"butt\" font-family=\"DejaVu Sans\" text-anchor=\"middle\"";
    if (operation == Operation::label) {
        return fmt::format(" fill=\"{}\" stroke=\"none\" font-family=\"DejaVu Sans\" text-anchor=\"middle\"",
                           to_string(pen.color));
    }
    // The figure of the bar to measure.
    const std::string_view font =
        operation == Operation::registration ? " font-family=\"DejaVu Sans\" text-anchor=\"middle\"" : "";
    return fmt::format(
        " fill=\"none\" stroke=\"{}\" stroke-width=\"{}\"{}{}", to_string(pen.color),
        number_text(pen.width_mm, kDecimals),
        profile_.dashes(operation) ? "" : " stroke-linecap=\"round\" stroke-linejoin=\"round\"", font);
}

// The things of operations [first, last]; they stand together.
template <typename Thing>
std::span<const Thing> stretch(std::span<const Thing> things, Operation first, Operation last) {
    const auto is = [first, last](const Thing& one) {
        return one.operation >= first && one.operation <= last;
    };
    const auto begin = std::find_if(things.begin(), things.end(), is);
    return {begin, std::find_if_not(begin, things.end(), is)};
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

// Operations that look alike stand together: in the layer's group itself when all do, else in groups in it.
void SvgText::layer(const SheetLayer& layer) {
    struct Group {
        std::string look;
        std::string operations;
        Operation first, last;
    };
    std::vector<Group> groups;
    for (const Operation one : kOperations) {
        if (one < layer.first || one > layer.last || !profile_.draws(one)) continue;
        std::string look = attributes(one);
        if (!groups.empty() && groups.back().look == look) {
            groups.back().last = one;
            groups.back().operations += fmt::format(" {}", to_string(one));
        } else {
            groups.push_back({std::move(look), std::string(to_string(one)), one, one});
        }
    }
    raw(" <g id=\"");
    raw(fresh_id(id_of(layer.name)));
    raw("\" inkscape:groupmode=\"layer\" inkscape:label=\"");
    escaped(visible(layer.name));
    raw("\"");
    if (groups.size() == 1) raw(groups.front().look);
    raw(">\n");
    std::size_t left = layer.shapes + layer.texts;
    for (const Group& group : groups) {
        if (groups.size() > 1) {
            raw(" <g class=\"");
            raw(group.operations);
            raw("\"");
            raw(group.look);
            raw(">\n");
        }
        const auto shown = stretch(drawing_.shapes_of(layer), group.first, group.last);
        const auto written = stretch(drawing_.texts_of(layer), group.first, group.last);
        shapes(shown);
        texts(written);
        left -= shown.size() + written.size();
        if (groups.size() > 1) raw(" </g>\n");
    }
    POPUP_INVARIANT(left == 0);  // a sheet without some of its lines must not be cut
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
    for (const SheetLayer& one : drawing_.layers) layer(one);
    raw("</g>\n</svg>\n");
    return fmt::to_string(out_);
}

}  // namespace

std::optional<std::vector<SheetFile>> write_svg(const Layout& layout, const OutputOptions& options,
                                                Diagnostics& diagnostics) {
    OutputOptions wanted = options;
    // Other programs cut what they find in it, and popupc reads it again.
    if (wanted.legend == Legend::automatic) wanted.legend = Legend::never;
    return file_per_view(layout, wanted, diagnostics, [](const SheetDrawing& drawing, const SheetView& view) {
        return SvgText(drawing).sheet(view.sheet);
    });
}

}  // namespace popup
