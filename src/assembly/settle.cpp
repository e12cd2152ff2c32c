#include "assembly/settle.h"

#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "assembly/fields.h"

namespace popup {
namespace {

// Below this a double that is multiplied or divided by a power of ten is off by less than a quarter of a
// step.
constexpr double kSteps = 1125899906842624.0;  // 2^50
constexpr double kWhole = 6755399441055744.0;  // 1.5 * 2^52

double mm(double value) { return settled(value, kLengthsPerMm); }
double part(double value) { return settled(value, kDirectionsPerUnit); }

void settle(Vec2& p) { p = {mm(p.x), mm(p.y)}; }
void settle(Vec3& p) { p = {mm(p.x), mm(p.y), mm(p.z)}; }
void settle(Segment& s) {
    settle(s.a);
    settle(s.b);
}
void settle(Color& /*color*/) {}
void settle(Place& /*place*/) {}
void settle(Frame& frame) {
    for (Vec3& axis : frame.axes) axis = {part(axis.x), part(axis.y), part(axis.z)};
    settle(frame.origin);
}
// Of thousands of pixels: as fine as a direction.
void settle(Affine& place) {
    for (Vec2* one : {&place.x, &place.y}) *one = {part(one->x), part(one->y)};
    settle(place.origin);
}
void settle(Cubic& cubic) {
    for (Vec2* one : {&cubic.from, &cubic.control_1, &cubic.control_2, &cubic.to}) settle(*one);
}
void settle(FlatCurve::Corner& corner) {
    settle(corner.at);
    corner.t = part(corner.t);
}
void settle(Polygon& polygon);
template <typename T>
void settle(std::optional<T>& value) {
    if (value) settle(*value);
}
template <typename T>
void settle(std::vector<T>& values) {
    for (T& value : values) settle(value);
}
void settle(Polygon& polygon) {
    settle(polygon.outer);
    settle(polygon.holes);
}

struct Settler {
    void text(const char* /*name*/, std::string& /*value*/) {}
    void flag(const char* /*name*/, bool /*value*/) {}
    void flag_if_set(const char* /*name*/, bool /*value*/) {}
    void sign(const char* /*name*/, int /*value*/) {}
    template <typename Word, typename Words>
    void word(const char* /*name*/, Word /*value*/, const Words& /*words*/) {}
    template <typename Word, typename Words>
    void word_if_any(const char* /*name*/, Word /*value*/, const Words& /*words*/) {}
    template <typename Names, typename Variant>
    void kind(const char* /*name*/, const Names& /*names*/, Variant& /*value*/) {}
    void plate(const char* /*name*/, int /*index*/) {}
    void plate_or_none(const char* /*name*/, int /*index*/) {}
    void piece(const char* /*name*/, int /*index*/) {}
    void piece_or_none(const char* /*name*/, int /*index*/) {}
    void plates(const char* /*name*/, const std::vector<int>& /*all*/) {}
    void picture(const char* /*name*/, const Image& /*image*/) {}

    void length(const char* /*name*/, double& value) { value = mm(value); }
    void degrees(const char* /*name*/, double& value) { value = settled(value, kAnglesPerDegree); }
    void angle(const char* /*name*/, double& value) { value = radians_of(settled_degrees(value)); }
    void angle_if_any(const char* name, std::optional<double>& value) {
        if (value) angle(name, *value);
    }
    void point(const char* /*name*/, Vec2& at) { settle(at); }
    void direction(const char* /*name*/, Vec2& along) { along = {part(along.x), part(along.y)}; }
    template <typename T>
    void value(const char* /*name*/, T& value) {
        settle(value);
    }
    template <typename T>
    void value_if_any(const char* /*name*/, T& value) {
        settle(value);
    }
    template <typename T>
    void value_unless(const char* /*name*/, T& value, const T& /*other*/) {
        settle(value);
    }
    template <typename Inside>
    void object(const char* /*name*/, const Inside& inside) {
        inside(*this);
    }
    template <typename T>
    void list(const char* /*name*/, std::vector<T>& all) {
        for (T& one : all) assembly_text::fields(one, *this);
    }
    template <typename T>
    void list_if_any(const char* name, std::vector<T>& all) {
        list(name, all);
    }
    void curves_if_any(const char* name, CurveTable& table) {
        if (table.empty()) return;
        std::vector<FlatCurve> curves = table.curves();
        list(name, curves);
        table = CurveTable(curves);
    }
};

}  // namespace

double settled(double value, double per_unit) {
    const double scaled = value * per_unit;
    if (!(std::abs(scaled) < kSteps)) return value;
    // To the nearest whole number, ties to even: beyond 2^52 doubles have no parts.
    return ((scaled + kWhole) - kWhole) / per_unit + 0.0;  // + 0.0 makes -0 a 0
}

double settled_degrees(double radians) {
    return settled(radians * 180.0 / std::numbers::pi, kAnglesPerDegree);
}

double radians_of(double settled_degrees) { return settled_degrees * std::numbers::pi / 180.0; }

void settle_numbers(Assembly& assembly) {
    Settler settler;
    assembly_text::fields(assembly, settler);
}

}  // namespace popup
