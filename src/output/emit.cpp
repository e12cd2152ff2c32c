#include "output/emit.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <span>
#include <string_view>

#include "base/text/json_text.h"
#include "base/text/numbers.h"
#include "output/examination_json.h"
#include "popup/mechanism.h"

namespace popup {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kLength = 6;     // decimals of a millimetre
constexpr int kAngle = 7;      // of a degree
constexpr int kDirection = 9;  // of a unit vector
constexpr int kClosure = 9;    // of a millimetre

Json mm(double value) { return rounded(value, kLength); }
Json degrees(double radians) { return rounded(radians * 180.0 / std::numbers::pi, kAngle); }
Json json(Vec2 p) { return Json::array({mm(p.x), mm(p.y)}); }
Json unit_vector(Vec2 d) { return Json::array({rounded(d.x, kDirection), rounded(d.y, kDirection)}); }
Json json(const Segment& s) { return Json::array({json(s.a), json(s.b)}); }
Json json(Place place) { return Json::array({place.line, place.column}); }
Json json(Color color) { return to_string(color); }

template <typename T>
Json json(const std::optional<T>& value) {
    return value ? json(*value) : Json();
}

Json json(const std::vector<Vec2>& points) {
    Json list = Json::array();
    for (const Vec2 p : points) list.push_back(json(p));
    return list;
}

Json json(const Polygon& polygon) {
    Json holes = Json::array();
    for (const Ring& hole : polygon.holes) holes.push_back(json(hole));
    return {{"outer", json(polygon.outer)}, {"holes", std::move(holes)}};
}

// A JSON list of `make` of each.
template <typename T, typename Make>
Json list(const std::vector<T>& values, Make make) {
    Json result = Json::array();
    for (const T& value : values) result.push_back(make(value));
    return result;
}

// --- design

Json json(const DesignPoint& point) {
    return {{"at", json(point.at)},
            {"page", point.page ? Json(*point.page) : Json()},
            {"place", json(point.place)},
            {"changed", point.changed}};
}

Json json(const std::vector<DesignPoint>& points) {
    return list(points, [](const DesignPoint& p) { return json(p); });
}

// The values of its element's parameters, but for the colours of its halves and tabs.
Json arguments(const Structure& one) {
    Json made = Json::object();
    const ElementInfo* info = find_element(one.type);
    for (std::size_t i = 0; info != nullptr && i < one.arguments.size(); ++i) {
        const Argument& argument = one.arguments[i];
        Json value;
        if (const auto* word = std::get_if<std::string>(&argument.value)) value = *word;
        if (const auto* number = std::get_if<double>(&argument.value)) value = mm(*number);
        if (const auto* points = std::get_if<std::vector<DesignPoint>>(&argument.value))
            value = json(*points);
        if (const auto* path = std::get_if<DrawnPath>(&argument.value)) value = path->text;
        if (!value.is_null()) made[std::string(info->parameters[i].name)] = std::move(value);
    }
    return made;
}

Json json(const Structure& one) {
    Json made{{"id", one.id},
              {"id_given", one.id_given},
              {"type", one.type},
              {"type_changed", one.type_changed},
              {"dropped", one.dropped},
              {"place", json(one.place)},
              {"points", json(one.points)},
              {"fold",
               {{"page", one.fold.page},
                {"begin", json(one.fold.begin)},
                {"end", json(one.fold.end)},
                {"place", json(one.fold.place)}}},
              {"left", json(color_of(one, "leftcolor"))},
              {"right", json(color_of(one, "rightcolor"))},
              {"left_tab", json(color_of(one, "lefttabcolor"))},
              {"right_tab", json(color_of(one, "righttabcolor"))}};
    if (one.plate) {
        made.erase("fold");
        made["plate"] = {{"page", one.plate->page}, {"at", json(one.plate->at)}};
    }
    if (Json values = arguments(one); !values.empty()) made["arguments"] = std::move(values);
    return made;
}

Json json(const DrawnLine& line) {
    return {{"page", line.page},         {"thickness_pt", mm(line.thickness_pt)},
            {"color", json(line.color)}, {"points", json(line.points)},
            {"dropped", line.dropped},   {"place", json(line.place)}};
}

// --- assembly

// The name of the plate or piece that `index` means, null for none.
template <typename T>
Json named(const std::vector<T>& all, int index) {
    return index < 0 ? Json() : Json(all.at(static_cast<std::size_t>(index)).name);
}

Json json(const Stroke& stroke) {
    return {
        {"points", json(stroke.points)}, {"width_mm", mm(stroke.width_mm)}, {"color", json(stroke.color)}};
}

Json json(const Plate& plate, const Assembly& assembly) {
    return {{"name", plate.name},
            {"piece", named(assembly.pieces, plate.piece)},
            {"outline", json(plate.outline)},
            {"fill", json(plate.fill)},
            {"strokes", list(plate.strokes, [](const Stroke& s) { return json(s); })},
            {"parent", named(assembly.plates, plate.parent)},
            {"pivot", json(plate.pivot)}};
}

Json json(const Line& line, const Assembly& assembly) {
    return {{"kind", to_string(line.kind)},
            {"at", json(line.at)},
            {"piece", named(assembly.pieces, line.piece)},
            {"plate", named(assembly.plates, line.plate)},
            {"other_plate", named(assembly.plates, line.other_plate)}};
}

Json json(const Hinge& hinge, const Assembly& assembly) {
    return {{"a", named(assembly.plates, hinge.a)},
            {"b", named(assembly.plates, hinge.b)},
            {"a_line", json(hinge.a_line)},
            {"b_line", json(hinge.b_line)},
            {"glued", hinge.glued}};
}

Json json(const Glue& glue, const Assembly& assembly) {
    return {{"piece_plate", named(assembly.plates, glue.piece_plate)},
            {"base_plate", named(assembly.plates, glue.base_plate)},
            {"on_piece", json(glue.on_piece)},
            {"on_base", json(glue.on_base)},
            {"label", glue.label},
            {"fill", json(glue.fill)},
            {"element", glue.element},
            {"place", json(glue.place)}};
}

// The values of a joint, by the names its kind gives them.
struct JointJson {
    const Assembly& assembly;
    Json& to;

    void plate(const char* name, int index) { to[name] = named(assembly.plates, index); }
    void point(const char* name, Vec2 at) { to[name] = json(at); }
    void direction(const char* name, Vec2 along) { to[name] = unit_vector(along); }
    void length(const char* name, double value) { to[name] = mm(value); }
    void angle(const char* name, double radians) { to[name] = degrees(radians); }
    void sign(const char* name, int value) { to[name] = value; }
    void flag(const char* name, bool value) { to[name] = value; }
    template <typename Word, std::size_t N>
    void word(const char* name, Word value, const std::array<std::string_view, N>& words) {
        to[name] = words.at(static_cast<std::size_t>(value));
    }
    template <typename Inside>
    void object(const char* name, const Inside& inside) {
        Json value = Json::object();
        JointJson fields{assembly, value};
        inside(fields);
        to[name] = std::move(value);
    }
};

Json json(const Joint& joint, const Assembly& assembly) {
    Json result{
        {"kind", kJointNames.at(joint.how.index())}, {"name", joint.name}, {"place", json(joint.place)}};
    JointJson fields{assembly, result};
    std::visit([&](const auto& how) { how.fields(how, fields); }, joint.how);
    return result;
}

Json json(const Sweep& sweep) {
    return {{"from_deg", rounded(sweep.from_deg, kAngle)},
            {"to_deg", rounded(sweep.to_deg, kAngle)},
            {"closed_flat", sweep.closed_flat}};
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
    return {{"kind", to_string(label.kind)},
            {"text", label.text},
            {"at", json(label.at)},
            {"height_mm", mm(label.height_mm)},
            {"angle_deg", degrees(label.angle)}};
}

Json json(const PatternPiece& piece, const std::vector<std::string>& plates) {
    const auto plate = [&plates](int index) {
        return index < 0 ? Json() : Json(plates.at(static_cast<std::size_t>(index)));
    };
    const bool empty = piece.bounds.empty();
    return {
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
        {"fills", list(piece.fills,
                       [&](const Fill& fill) {
                           return Json{{"plate", plate(fill.plate)},
                                       {"color", json(fill.color)},
                                       {"area", json(fill.area)}};
                       })},
        {"strokes", list(piece.strokes,
                         [&](const PatternStroke& one) {
                             return Json{{"plate", plate(one.plate)},
                                         {"points", json(one.stroke.points)},
                                         {"width_mm", mm(one.stroke.width_mm)},
                                         {"color", json(one.stroke.color)}};
                         })},
        {"targets", list(piece.targets,
                         [&](const GlueTarget& target) {
                             return Json{{"plate", plate(target.plate)}, {"outline", json(target.outline)}};
                         })},
        {"labels", list(piece.labels, [](const Label& label) { return json(label); })},
        {"silhouette", list(piece.silhouette, [](const Polygon& polygon) { return json(polygon); })}};
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

std::string emit_design(const Design& design) {
    return json_text({{"file", design.file},
                      {"stem", design.stem},
                      {"version", design.version},
                      {"unit", design.unit.name},
                      {"width_mm", mm(design.width_mm)},
                      {"height_mm", mm(design.height_mm)},
                      {"left", json(design.left)},
                      {"right", json(design.right)},
                      {"place", json(design.page_place)},
                      {"structures", list(design.structures, [](const Structure& s) { return json(s); })},
                      {"lines", list(design.lines, [](const DrawnLine& l) { return json(l); })}});
}

std::string emit_assembly(const Assembly& assembly) {
    const auto member = [&assembly](const auto& value) { return json(value, assembly); };
    const auto piece = [&assembly](const Piece& one) {
        const auto name = [&assembly](int plate) { return named(assembly.plates, plate); };
        return Json{{"name", one.name}, {"plates", list(one.plates, name)}};
    };
    return json_text(
        {{"file", assembly.file},
         {"stem", assembly.stem},
         {"pieces", list(assembly.pieces, piece)},
         {"plates", list(assembly.plates, member)},
         {"lines", list(assembly.lines, member)},
         {"hinges", list(assembly.hinges, member)},
         {"glue", list(assembly.glue, member)},
         {"joints", list(assembly.joints, member)},
         {"sweep", json(assembly.sweep)},
         {"covers", list(assembly.covers, [&](int cover) { return named(assembly.plates, cover); })}});
}

std::string emit_motion(const Assembly& assembly, const Motion& motion) {
    fmt::memory_buffer out;
    append(out, "{\n  \"stem\": ");
    append(out, Json(assembly.stem).dump(-1, ' ', false, Json::error_handler_t::replace));
    append(out, motion.solver == Solver::iterative ? ",\n  \"solver\": \"iterative\""
                                                   : ",\n  \"solver\": \"closed-form\"");
    append(out, ",\n  \"max_closure_error_mm\": ");
    append_value(out, motion.max_closure_mm, kClosure);
    append(out, motion.flat_closed ? ",\n  \"flat_closed\": true" : ",\n  \"flat_closed\": false");
    append(out, ",\n  \"flat_error_deg\": ");
    append_value(out, motion.flat_error_deg, kAngle);
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
