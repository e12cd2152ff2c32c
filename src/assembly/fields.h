// What the values of an assembly are called in its text: one description for who writes it, who reads it and
// who settles its numbers (assembly/settle.h). docs/assembly.md describes the same in words.
//
// fields(part, to) names the values of a part in the order of the text. `to` has one function a sort of
// value; whether it writes them or fills them in is its own affair:
//
//     struct Lengths {                                  // adds up all lengths
//         double sum = 0.0;
//         void length(const char*, const double& mm) { sum += mm; }
//         ...
//     };
//
//   text, flag, sign, word      as they are; a sign is -1 or 1, a word one of a list
//   kind                        which of a variant's it is; its own values come after it
//   length, angle, degrees      mm; radians, in degrees in the text; degrees
//   point, direction, value     a point in mm; a unit vector; anything made of points, colours and places
//   plate, piece, plates        indices, names in the text
//   object, list                parts within parts
//   picture                     the file of an image
//
// `flag_if_set` leaves out what is false, `word_if_any` the first word of the list. What ends in `_if_any` is
// left out of the text where there is nothing of it, what ends in `_unless` where it is the same as another
// value; what ends in `_or_none` is then null.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <string_view>
#include <type_traits>

#include "assembly/orientation_names.h"
#include "popup/assembly.h"
#include "popup/joints.h"
#include "popup/print.h"

namespace popup::assembly_text {

// Of the text; one that a reader does not know it does not read.
inline constexpr int kVersion = 1;

// By the enumerators' values, and by the index in the variant.
inline constexpr std::array<std::string_view, 5> kLineNames{"cut", "mountain", "valley", "seam", "mark"};
inline constexpr std::array<std::string_view, std::variant_size_v<Print>> kPrintNames{"area", "stroke",
                                                                                      "text", "image"};
inline constexpr std::array<std::string_view, 3> kUnitSystemNames{"unknown", "metric", "inches"};

// A T, whether it may be changed or not.
template <typename Self, typename T>
concept Of = std::same_as<std::remove_const_t<Self>, T>;

template <Of<Area> Self, typename To>
void fields(Self& area, To& to) {
    to.value("shape", area.shape);
    to.value("color", area.color);
}

template <Of<Stroke> Self, typename To>
void fields(Self& stroke, To& to) {
    to.value("points", stroke.points);
    to.length("width_mm", stroke.width_mm);
    to.value("color", stroke.color);
}

template <Of<Text> Self, typename To>
void fields(Self& text, To& to) {
    to.text("text", text.text);
    to.point("at", text.at);
    to.length("height_mm", text.height_mm);
    to.angle("angle_deg", text.angle);
    to.value_if_any("color", text.color);
    to.word_if_any("font", text.font, kTextFontNames);
}

template <Of<Image> Self, typename To>
void fields(Self& image, To& to) {
    to.picture("picture", image);
    to.value("place", image.place);
    to.value_if_any("clip", image.clip);
}

template <Of<Print> Self, typename To>
void fields(Self& print, To& to) {
    to.kind("kind", kPrintNames, print);
    std::visit([&](auto& what) { fields(what, to); }, print);
}

template <Of<Piece> Self, typename To>
void fields(Self& piece, To& to) {
    to.text("name", piece.name);
    to.plates("plates", piece.plates);
    to.value_if_any("place", piece.place);
    to.value_if_any("paper", piece.paper);
    to.value_if_any("slits", piece.slits);
    to.list_if_any("prints", piece.prints);
}

template <Of<Plate> Self, typename To>
void fields(Self& plate, To& to) {
    to.text("name", plate.name);
    to.piece("piece", plate.piece);
    to.value("outline", plate.outline);
    to.value_unless("uncut", plate.uncut, plate.outline.outer);
    to.value("fill", plate.fill);
    to.list_if_any("prints", plate.prints);
    to.value_if_any("rivet", plate.rivet);
    to.value_if_any("stands", plate.stands);
    to.plate_or_none("parent", plate.parent);
    to.value_if_any("pivot", plate.pivot);
}

template <Of<Line> Self, typename To>
void fields(Self& line, To& to) {
    to.word("kind", line.kind, kLineNames);
    to.value("at", line.at);
    to.piece("piece", line.piece);
    to.plate_or_none("plate", line.plate);
    to.plate_or_none("other_plate", line.other_plate);
    to.angle_if_any("fold_deg", line.fold_angle);
}

template <Of<Hinge> Self, typename To>
void fields(Self& hinge, To& to) {
    to.plate("a", hinge.a);
    to.plate("b", hinge.b);
    to.value("a_line", hinge.a_line);
    to.value("b_line", hinge.b_line);
    to.flag("glued", hinge.glued);
}

template <Of<Glue> Self, typename To>
void fields(Self& glue, To& to) {
    to.plate("piece_plate", glue.piece_plate);
    to.plate("base_plate", glue.base_plate);
    to.value("on_piece", glue.on_piece);
    to.value("on_base", glue.on_base);
    to.text("label", glue.label);
    to.value("fill", glue.fill);
    to.text("element", glue.element);
    to.value("place", glue.place);
    to.flag_if_set("on_back", glue.on_back);
}

template <Of<GluedArea> Self, typename To>
void fields(Self& area, To& to) {
    to.plate("plate", area.plate);
    to.plate("base_plate", area.base_plate);
    to.value("on_base", area.on_base);
    to.text("label", area.label);
    to.text("element", area.element);
    to.value("place", area.place);
}

template <Of<Joint> Self, typename To>
void fields(Self& joint, To& to) {
    to.kind("kind", kJointNames, joint.how);
    to.text("name", joint.name);
    to.value("place", joint.place);
    std::visit([&](auto& how) { how.fields(how, to); }, joint.how);
}

template <Of<Sweep> Self, typename To>
void fields(Self& sweep, To& to) {
    to.degrees("from_deg", sweep.from_deg);
    to.degrees("to_deg", sweep.to_deg);
    to.flag("closed_flat", sweep.closed_flat);
    to.flag_if_set("bends", sweep.bends);
}

template <Of<PlateOrder> Self, typename To>
void fields(Self& order, To& to) {
    to.plate("plate", order.plate);
    to.plate("base", order.base);
    to.flag("on_front", order.on_front);
}

template <Of<Trace> Self, typename To>
void fields(Self& trace, To& to) {
    to.text("name", trace.name);
    to.piece_or_none("piece", trace.piece);
    to.value("lines", trace.lines);
}

template <Of<FlatCurve> Self, typename To>
void fields(Self& curve, To& to) {
    to.value("cubic", curve.cubic);
    to.value("corners", curve.corners);
}

// All of it. `version` and the pictures are the writer's and the reader's own.
template <Of<Assembly> Self, typename To>
void fields(Self& assembly, To& to) {
    to.text("file", assembly.file);
    to.text("stem", assembly.stem);
    to.word_if_any("units", assembly.units, kUnitSystemNames);
    to.word_if_any("orientation", assembly.orientation, kOrientationNames);
    to.list("pieces", assembly.pieces);
    to.list("plates", assembly.plates);
    to.list("lines", assembly.lines);
    to.list("hinges", assembly.hinges);
    to.list("glue", assembly.glue);
    to.list("joints", assembly.joints);
    to.object("sweep", [&](auto& inside) { fields(assembly.sweep, inside); });
    to.plates("covers", assembly.covers);
    to.list_if_any("glued_areas", assembly.glued_areas);
    to.list_if_any("layers", assembly.layers);
    to.list_if_any("traces", assembly.traces);
    to.curves_if_any("curves", assembly.curves);
}

}  // namespace popup::assembly_text
