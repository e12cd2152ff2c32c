#include "output/emit.h"

#include <fmt/format.h>

#include <cmath>
#include <span>
#include <string_view>
#include <variant>

#include "base/system/digest.h"
#include "base/text/json_text.h"
#include "base/text/numbers.h"
#include "output/emit_json.h"
#include "output/examination_json.h"
#include "popup/image.h"

namespace popup {
namespace {

using namespace emitted;
using emitted::json;  // joins those below

// The file itself is left out: it is told by its length and digest.
Json json(const Image& image) {
    const Affine& place = image.place;
    return {{"format", mime_type(image.format)},
            {"bytes", image.bytes->size()},
            {"sha256", sha256(*image.bytes)},
            {"pixels", Json::array({image.width, image.height})},
            {"place", Json::array({json(place.x), json(place.y), json(place.origin)})},
            {"clip", list(image.clip, [](const Polygon& polygon) { return json(polygon); })}};
}

// --- motion, written straight into text: a value of it all would take many times the text's memory

void append(fmt::memory_buffer& out, std::string_view text) {
    out.append(text.data(), text.data() + text.size());
}

// The iterative solver may run away; JSON has no word for what it then gives.
void append_value(fmt::memory_buffer& out, double value, int decimals) {
    if (std::isfinite(value)) {
        append_number(out, value, decimals);
    } else {
        append(out, "null");
    }
}

void append_point(fmt::memory_buffer& out, Vec3 p, int decimals) {
    out.push_back('[');
    append_value(out, p.x, decimals);
    append(out, ", ");
    append_value(out, p.y, decimals);
    append(out, ", ");
    append_value(out, p.z, decimals);
    out.push_back(']');
}

void append_plate(fmt::memory_buffer& out, const Plate& plate, const Frame& frame) {
    append(out, "{\"name\": ");
    append(out, Json(plate.name).dump(-1, ' ', false, Json::error_handler_t::replace));
    append(out, ", \"frame\": {\"axes\": [");
    for (std::size_t i = 0; i < frame.axes.size(); ++i) {
        if (i > 0) append(out, ", ");
        append_point(out, frame.axes.at(i), kDirection);
    }
    append(out, "], \"origin\": ");
    append_point(out, frame.origin, kLength);
    append(out, "}, \"outline\": [");
    std::string_view before;
    for (const Vec2 p : plate.outline.outer) {
        append(out, before);
        append_point(out, frame.point(p), kLength);
        before = ", ";
    }
    append(out, "]}");
}

// Places all plates at the angles of a motion, by the way the motion was found.
class Placer {
 public:
    Placer(const Assembly& assembly, Solver solver) : assembly_(assembly), frames_(assembly.plates.size()) {
        if (solver == Solver::iterative) iterative_.emplace(assembly);
    }
    bool place(Angle angle) {
        if (!iterative_) return popup::place(assembly_, angle, frames_);
        iterative_->place(angle, frames_);
        return true;
    }
    [[nodiscard]] std::span<const Frame> frames() const { return frames_; }

 private:
    const Assembly& assembly_;
    std::vector<Frame> frames_;
    std::optional<IterativePlacer> iterative_;
};

// --- pattern and layout

std::string_view to_string(LabelKind kind) {
    switch (kind) {
        case LabelKind::piece:
            return "piece";
        case LabelKind::tab:
            return "tab";
        case LabelKind::target:
            return "target";
    }
    broken_invariant("a label kind is one of its enumerators", __FILE__, __LINE__);
}

Json json(const Label& label) {
    Json one{{"kind", to_string(label.kind)},
             {"text", label.text},
             {"at", json(label.at)},
             {"height_mm", mm(label.height_mm)},
             {"angle_deg", degrees(label.angle)}};
    if (label.on_back) one["on_back"] = true;
    return one;
}

// A text of the source without a colour stands among the labels: it is printed as they are.
Json labels(const PatternPiece& piece) {
    Json result = Json::array();
    for (const PatternPrint& one : piece.prints) {
        const auto* text = std::get_if<Text>(&one.print);
        if (text == nullptr || text->color) continue;
        result.push_back(json(Label{LabelKind::piece, text->text, text->at, text->height_mm, text->angle}));
    }
    for (const Label& label : piece.labels) result.push_back(json(label));
    return result;
}

Json json(const PatternPiece& piece, const std::vector<std::string>& plates) {
    const auto plate = [&plates](int index) {
        return index < 0 ? Json() : Json(plates.at(static_cast<std::size_t>(index)));
    };
    Json fills = Json::array();
    Json strokes = Json::array();
    for (const PatternPrint& one : piece.prints) {
        if (const auto* area = std::get_if<Area>(&one.print)) {
            fills.push_back(
                {{"plate", plate(one.plate)}, {"color", json(area->color)}, {"area", json(area->shape)}});
        } else if (const auto* stroke = std::get_if<Stroke>(&one.print)) {
            strokes.push_back({{"plate", plate(one.plate)},
                               {"points", json(stroke->points)},
                               {"width_mm", mm(stroke->width_mm)},
                               {"color", json(stroke->color)}});
        }
    }
    const bool empty = piece.bounds.empty();
    Json one{
        {"name", piece.name},
        {"bounds", empty ? Json() : Json::array({json(piece.bounds.min), json(piece.bounds.max)})},
        {"cuts", list(piece.cuts,
                      [](const Contour& c) {
                          return Json{{"closed", c.closed}, {"depth", c.depth}, {"points", json(c.points)}};
                      })},
        {"lines", list(piece.lines,
                       [&](const PatternLine& line) {
                           Json one{{"kind", to_string(line.kind)},
                                    {"at", json(line.at)},
                                    {"plate", plate(line.plate)},
                                    {"glued_on", line.glued_on}};
                           if (line.fold_angle) one["fold_deg"] = degrees(*line.fold_angle);
                           return one;
                       })},
        {"fills", std::move(fills)},
        {"strokes", std::move(strokes)},
        {"targets", list(piece.targets,
                         [&](const GlueTarget& target) {
                             Json one{{"plate", plate(target.plate)}, {"outline", json(target.outline)}};
                             if (target.on_back) one["on_back"] = true;
                             return one;
                         })},
        {"labels", labels(piece)},
        {"silhouette", list(piece.silhouette, [](const Polygon& polygon) { return json(polygon); })}};
    for (const PatternPrint& print : piece.prints) {
        const auto* image = std::get_if<Image>(&print.print);
        if (image == nullptr) continue;
        one["images"].push_back(json(*image));
        one["images"].back()["plate"] = plate(print.plate);
    }
    for (const PatternPrint& print : piece.prints) {
        const auto* text = std::get_if<Text>(&print.print);
        if (text == nullptr || !text->color) continue;
        one["texts"].push_back({{"text", text->text},
                                {"at", json(text->at)},
                                {"height_mm", mm(text->height_mm)},
                                {"angle_deg", degrees(text->angle)},
                                {"color", json(*text->color)},
                                {"font", to_string(text->font)}});
    }
    return one;
}

Json json(const Pattern& pattern) {
    return {{"pieces", list(pattern.pieces, [&pattern](const PatternPiece& piece) {
                 return json(piece, pattern.plate_names);
             })}};
}

Json json(const Placement& placement, const Layout& layout) {
    return {{"piece", layout.piece_name(placement)},
            {"design", layout.designs.at(static_cast<std::size_t>(placement.design)).stem},
            {"copy", placement.copy + 1},
            {"sheet", placement.sheet + 1},
            {"offset", json(placement.offset)},
            {"angle_deg", rounded(placement.angle.deg, kAngle)}};
}

}  // namespace

std::string emit_motion(const Assembly& assembly, const Motion& motion) {
    fmt::memory_buffer out;
    append(out, "{\n  \"stem\": ");
    append(out, Json(assembly.stem).dump(-1, ' ', false, Json::error_handler_t::replace));
    append(out, motion.solver == Solver::iterative ? ",\n  \"solver\": \"iterative\""
                                                   : ",\n  \"solver\": \"closed-form\"");
    append(out, ",\n  \"max_closure_error_mm\": ");
    append_value(out, motion.max_closure_mm, kClosure);
    if (assembly.sweep.closed_flat) {
        append(out, motion.flat_closed ? ",\n  \"flat_closed\": true" : ",\n  \"flat_closed\": false");
        append(out, ",\n  \"flat_error_deg\": ");
        append_value(out, motion.flat_error_deg, kAngle);
    } else {
        append(out, ",\n  \"flat_closed\": null,\n  \"flat_error_deg\": null");
    }
    if (!motion.not_forced.empty()) {
        append(out, ",\n  \"not_forced\": ");
        append(out, json_text_within(not_forced_json(assembly, motion.not_forced), 1));
    }
    append(out, ",\n  \"examination\": ");
    append(out, motion.examination ? json_text_within(examination_json(assembly, motion.examination), 1)
                                   : std::string("null"));
    append(out, ",\n  \"frames\": [");
    Placer placer(assembly, motion.solver);
    std::string_view before = "\n    {";
    for (const Angle angle : motion.angles) {
        append(out, before);
        append(out, "\n      \"angle_deg\": ");
        append_value(out, angle.deg, kAngle);
        const bool reached = placer.place(angle);
        append(out, ",\n      \"closure_error_mm\": ");
        if (reached) {
            append_value(out, closure_error(assembly, placer.frames()), kClosure);
            append(out, ",\n      \"plates\": [");
            for (std::size_t i = 0; i < assembly.plates.size(); ++i) {
                append(out, i == 0 ? "\n        " : ",\n        ");
                append_plate(out, assembly.plates[i], placer.frames()[i]);
            }
            append(out, "\n      ]\n    }");
        } else {
            append(out, "null,\n      \"plates\": null\n    }");
        }
        before = ",\n    {";
    }
    append(out, "\n  ]\n}\n");
    return fmt::to_string(out);
}

std::string emit_pattern(const Pattern& pattern) { return json_text(json(pattern)); }

std::string emit_layout(const Layout& layout) {
    return json_text(
        {{"margin_mm", mm(layout.margin_mm)},
         {"sheets", list(layout.sheets,
                         [](const LayoutSheet& sheet) {
                             return Json{{"size_mm", json(Vec2{sheet.width_mm, sheet.height_mm})},
                                         {"utilisation", rounded(sheet.utilisation, kLength)},
                                         {"used_mm", json(sheet.used_mm)}};
                         })},
         {"leftover_mm", layout.leftover.empty()
                             ? Json()
                             : Json::array({json(layout.leftover.min), json(layout.leftover.max)})},
         {"placements", list(layout.placements, [&layout](const Placement& p) { return json(p, layout); })},
         {"designs", list(layout.designs, [](const DesignPattern& one) {
              return Json{{"file", one.file}, {"stem", one.stem}, {"pattern", json(one.pattern)}};
          })}});
}

}  // namespace popup
