// Group codes and their order are those of the DXF reference of AutoCAD 2000.
#include "output/dxf.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numbers>
#include <string_view>

#include "base/diagnostics/render_diagnostics.h"
#include "base/text/numbers.h"
#include "base/text/utf8.h"
#include "output/arcs.h"
#include "output/pictures_left_out.h"
#include "output/sheet_drawing.h"

namespace popup {
namespace {

constexpr int kDecimals = 6;

// The colours that every program numbers alike. 7 is drawn black on white and white on black.
struct IndexColor {
    int index;
    Color color;
};
constexpr std::array kIndexColors{
    IndexColor{1, {0xff, 0x00, 0x00}}, IndexColor{2, {0xff, 0xff, 0x00}}, IndexColor{3, {0x00, 0xff, 0x00}},
    IndexColor{4, {0x00, 0xff, 0xff}}, IndexColor{5, {0x00, 0x00, 0xff}}, IndexColor{6, {0xff, 0x00, 0xff}},
    IndexColor{7, {0x00, 0x00, 0x00}}, IndexColor{8, {0x80, 0x80, 0x80}}, IndexColor{9, {0xc0, 0xc0, 0xc0}}};

int color_index(Color color) {
    const auto apart = [color](const IndexColor& row) {
        const int r = row.color.r - color.r;
        const int g = row.color.g - color.g;
        const int b = row.color.b - color.b;
        return r * r + g * g + b * b;
    };
    return std::min_element(kIndexColors.begin(), kIndexColors.end(),
                            [&](const IndexColor& a, const IndexColor& b) { return apart(a) < apart(b); })
        ->index;
}

// ASCII as it is, the rest as \U+XXXX in UTF-16. DXF spells a caret "^ ", for ^X is a code. %%X is one too,
// and programs do not agree on how two per cent signs are spelt: a space parts them. Precondition: valid
// UTF-8 without control characters.
std::string dxf_text(std::string_view text) {
    std::string out;
    while (!text.empty()) {
        const Character character = first_character(text);
        text.remove_prefix(character.bytes);
        auto code = static_cast<std::uint32_t>(character.code);
        if (code < 0x80U) {
            out += static_cast<char>(code);
            if (code == '^' || (code == '%' && text.starts_with('%'))) out += ' ';
            continue;
        }
        if (code >= 0x10000U) {
            out += fmt::format("\\U+{:04X}", 0xd800U + ((code - 0x10000U) >> 10U));
            code = 0xdc00U + ((code - 0x10000U) & 0x3ffU);
        }
        out += fmt::format("\\U+{:04X}", code);
    }
    return out;
}

// A layer's name has none of the characters that DXF gives a meaning of their own.
std::string layer_text(std::string_view name) {
    std::string text = visible(name);
    for (char& c : text) {
        if (std::string_view("<>/\\\":;?*|=`,'").find(c) != std::string_view::npos) c = '-';
    }
    return dxf_text(text);
}

class DxfText {
 public:
    explicit DxfText(const SheetDrawing& drawing) : drawing_(drawing), profile_(drawing.profile) {}

    std::string sheet() {
        for (const SheetLayer& one : drawing_.layers) {
            const std::string layer = layer_text(one.name);
            if (std::find(layers_.begin(), layers_.end(), layer) != layers_.end()) continue;
            layers_.push_back(layer);
            colors_.push_back(color_index(profile_.pen(one.first).color));
        }
        // The entities first: the header names the first handle that is free.
        for (const SheetLayer& layer : drawing_.layers) entities(layer);
        fmt::memory_buffer drawn;
        std::swap(out_, drawn);
        tables();
        blocks();
        section("ENTITIES");
        out_.append(drawn.data(), drawn.data() + drawn.size());
        group(0, "ENDSEC");
        objects();
        group(0, "EOF");
        fmt::memory_buffer rest;
        std::swap(out_, rest);
        header();
        out_.append(rest.data(), rest.data() + rest.size());
        return fmt::to_string(out_);
    }

 private:
    // Handles of what every document has.
    enum Handle : unsigned {
        kModelRecord = 0x10,
        kPaperRecord,
        kModelBlock,
        kModelEnd,
        kPaperBlock,
        kPaperEnd,
        kRoot,
        kGroups,
        kFree = 0x20
    };

    void group(int code, std::string_view value) {
        fmt::format_to(fmt::appender(out_), "{}\n{}\n", code, value);
    }
    void group(int code, int value) { group(code, std::string_view(fmt::format_int(value).c_str())); }
    void group(int code, std::size_t value) { group(code, std::string_view(fmt::format_int(value).c_str())); }
    void group(int code, double value) {
        std::string text = number_text(value, kDecimals);
        if (text.find('.') == std::string::npos) text += ".0";
        group(code, std::string_view(text));
    }
    // A bulge counts for the more the longer its chord is.
    void bulge(double value) {
        constexpr int kBulgeDecimals = 9;
        group(42, std::string_view(number_text(value, kBulgeDecimals)));
    }
    void handle(int code, unsigned value) { fmt::format_to(fmt::appender(out_), "{}\n{:X}\n", code, value); }
    // Groups code, code + 10 and code + 20.
    void point(int code, Vec2 p) {
        group(code, p.x);
        group(code + 10, p.y);
        group(code + 20, 0.0);
    }
    void section(std::string_view name) {
        group(0, "SECTION");
        group(2, name);
    }

    void header() {
        section("HEADER");
        const auto variable = [this](std::string_view name, int code, const auto& value) {
            group(9, name);
            group(code, value);
        };
        variable("$ACADVER", 1, "AC1015");
        variable("$DWGCODEPAGE", 3, "ANSI_1252");
        variable("$INSUNITS", 70, 4);
        variable("$MEASUREMENT", 70, 1);
        group(9, "$EXTMIN");
        point(10, {0.0, 0.0});
        group(9, "$EXTMAX");
        point(10, {drawing_.width_mm, drawing_.height_mm});
        group(9, "$HANDSEED");
        handle(5, next_);
        group(0, "ENDSEC");
        section("CLASSES");
        group(0, "ENDSEC");
    }

    void begin_table(std::string_view name, std::size_t rows) {
        group(0, "TABLE");
        group(2, name);
        table_ = next_++;
        handle(5, table_);
        handle(330, 0);
        group(100, "AcDbSymbolTable");
        group(70, rows);
    }
    void row(std::string_view type, std::string_view subclass, std::string_view name, unsigned own) {
        group(0, type);
        handle(5, own);
        handle(330, table_);
        group(100, "AcDbSymbolTableRecord");
        group(100, subclass);
        group(2, name);
    }
    void row(std::string_view type, std::string_view subclass, std::string_view name) {
        row(type, subclass, name, next_++);
        group(70, 0);
    }

    void tables() {
        section("TABLES");
        begin_table("VPORT", 0);
        group(0, "ENDTAB");
        begin_table("LTYPE", 3);
        for (const std::string_view name : {"ByBlock", "ByLayer", "Continuous"}) {
            row("LTYPE", "AcDbLinetypeTableRecord", name);
            group(3, name == "Continuous" ? "Solid line" : "");
            group(72, 65);
            group(73, 0);
            group(40, 0.0);
        }
        group(0, "ENDTAB");
        const bool has_zero = std::find(layers_.begin(), layers_.end(), "0") != layers_.end();
        begin_table("LAYER", layers_.size() + (has_zero ? 0U : 1U));
        const auto layer = [this](std::string_view name, int color) {
            row("LAYER", "AcDbLayerTableRecord", name);
            group(62, color);
            group(6, "Continuous");
        };
        if (!has_zero) layer("0", 7);
        for (std::size_t i = 0; i < layers_.size(); ++i) layer(layers_[i], colors_[i]);
        group(0, "ENDTAB");
        begin_table("STYLE", 1);
        row("STYLE", "AcDbTextStyleTableRecord", "Standard");
        group(40, 0.0);
        group(41, 1.0);
        group(50, 0.0);
        group(71, 0);
        group(42, 2.5);
        group(3, "txt");
        group(4, "");
        group(0, "ENDTAB");
        for (const std::string_view name : {"VIEW", "UCS"}) {
            begin_table(name, 0);
            group(0, "ENDTAB");
        }
        begin_table("APPID", 1);
        row("APPID", "AcDbRegAppTableRecord", "ACAD");
        group(0, "ENDTAB");
        begin_table("DIMSTYLE", 0);
        group(100, "AcDbDimStyleTable");
        group(71, 0);
        group(0, "ENDTAB");
        begin_table("BLOCK_RECORD", 2);
        row("BLOCK_RECORD", "AcDbBlockTableRecord", "*Model_Space", kModelRecord);
        row("BLOCK_RECORD", "AcDbBlockTableRecord", "*Paper_Space", kPaperRecord);
        group(0, "ENDTAB");
        group(0, "ENDSEC");
    }

    void block(std::string_view name, unsigned record, unsigned begin, unsigned end) {
        group(0, "BLOCK");
        handle(5, begin);
        handle(330, record);
        group(100, "AcDbEntity");
        group(8, "0");
        group(100, "AcDbBlockBegin");
        group(2, name);
        group(70, 0);
        point(10, {0.0, 0.0});
        group(3, name);
        group(1, "");
        group(0, "ENDBLK");
        handle(5, end);
        handle(330, record);
        group(100, "AcDbEntity");
        group(8, "0");
        group(100, "AcDbBlockEnd");
    }
    void blocks() {
        section("BLOCKS");
        block("*Model_Space", kModelRecord, kModelBlock, kModelEnd);
        block("*Paper_Space", kPaperRecord, kPaperBlock, kPaperEnd);
        group(0, "ENDSEC");
    }

    void objects() {
        section("OBJECTS");
        group(0, "DICTIONARY");
        handle(5, kRoot);
        handle(330, 0);
        group(100, "AcDbDictionary");
        group(3, "ACAD_GROUP");
        handle(350, kGroups);
        group(0, "DICTIONARY");
        handle(5, kGroups);
        handle(330, kRoot);
        group(100, "AcDbDictionary");
        group(0, "ENDSEC");
    }

    void begin_entity(std::string_view type, Operation operation, Color color) {
        group(0, type);
        handle(5, next_++);
        handle(330, kModelRecord);
        group(100, "AcDbEntity");
        group(8, layer_text(profile_.pen(operation).layer));
        group(62, color_index(color));
    }

    void entities(const SheetLayer& layer) {
        for (const SheetShape& shape : drawing_.shapes_of(layer)) {
            if (shape.operation == Operation::fill) continue;
            for (const Run& run : drawing_.runs_of(shape)) path(shape, run);
        }
        for (const SheetText& text : drawing_.texts_of(layer)) label(text);
    }

    void path(const SheetShape& shape, const Run& run) {
        if (run.steps > 0) return curves(shape, drawing_.path_of(run));
        const std::span<const Vec2> points = drawing_.points_of(run);
        if (points.size() == 2 && !run.closed) {
            begin_entity("LINE", shape.operation, shape.color);
            group(100, "AcDbLine");
            point(10, points[0]);
            point(11, points[1]);
            return;
        }
        begin_entity("LWPOLYLINE", shape.operation, shape.color);
        group(100, "AcDbPolyline");
        group(90, points.size());
        group(70, run.closed ? 1 : 0);
        for (const Vec2 p : points) {
            group(10, p.x);
            group(20, p.y);
        }
    }

    void curves(const SheetShape& shape, const Subpath& path) {
        const auto arcs = as_arcs(path);
        if (!arcs) return spline(shape, path);
        begin_entity("LWPOLYLINE", shape.operation, shape.color);
        group(100, "AcDbPolyline");
        group(90, arcs->size());
        group(70, path.closed ? 1 : 0);
        for (const ArcCorner& corner : *arcs) {
            group(10, corner.at.x);
            group(20, corner.at.y);
            if (corner.bulge != 0.0) bulge(corner.bulge);
        }
    }

    // One spline of third degree: each curve, and each line as a curve with its controls on it, is a span
    // between knots of multiplicity three. The flag for closed splines is left out, for those that read it
    // take the knots for periodic ones; a closed path ends where it begins.
    void spline(const SheetShape& shape, const Subpath& path) {
        std::vector<Vec2> controls{path.start};
        const auto line = [&controls](Vec2 to) {
            const Vec2 from = controls.back();
            controls.insert(controls.end(), {lerp(from, to, 1.0 / 3.0), lerp(from, to, 2.0 / 3.0), to});
        };
        for (const PathStep& step : path.steps) {
            if (step.curve) {
                controls.insert(controls.end(), {step.control_1, step.control_2, step.to});
            } else {
                line(step.to);
            }
        }
        if (path.closed && controls.back() != path.start) line(path.start);
        const std::size_t spans = controls.size() / 3;
        begin_entity("SPLINE", shape.operation, shape.color);
        group(100, "AcDbSpline");
        group(70, 8);  // planar
        group(71, 3);
        group(72, controls.size() + 4);
        group(73, controls.size());
        group(74, 0);
        for (std::size_t knot = 0; knot <= spans; ++knot) {
            const int times = knot == 0 || knot == spans ? 4 : 3;
            for (int i = 0; i < times; ++i) group(40, static_cast<double>(knot));
        }
        for (const Vec2 p : controls) point(10, p);
    }

    void label(const SheetText& text) {
        begin_entity("TEXT", text.operation, text.color);
        group(100, "AcDbText");
        point(10, text.at);
        group(40, text.cap_mm);
        group(1, dxf_text(text.text));
        group(50, text.angle * 180.0 / std::numbers::pi);
        group(72, 1);  // centred
        point(11, text.at);
        group(100, "AcDbText");
        group(73, 2);  // half way up
    }

    const SheetDrawing& drawing_;
    const Profile& profile_;
    fmt::memory_buffer out_;
    unsigned next_ = kFree;
    unsigned table_ = 0;
    std::vector<std::string> layers_;
    std::vector<int> colors_;
};

}  // namespace

std::optional<std::vector<SheetFile>> write_dxf(const Layout& layout, const OutputOptions& options,
                                                Diagnostics& diagnostics) {
    OutputOptions machine = options;
    machine.legend = Legend::never;
    tell_pictures_left_out(layout, options, ".dxf", diagnostics);
    return file_per_view(layout, machine, diagnostics, [](const SheetDrawing& drawing, const SheetView&) {
        return DxfText(drawing).sheet();
    });
}

}  // namespace popup
