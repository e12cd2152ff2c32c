// The assembly as its text: docs/assembly.md.
#include <map>
#include <string>

#include "assembly/fields.h"
#include "assembly/settle.h"
#include "base/system/digest.h"
#include "base/text/base64.h"
#include "base/text/json_text.h"
#include "output/emit.h"
#include "output/emit_json.h"
#include "popup/image.h"

namespace popup {
namespace {

using emitted::Json;

Json number(double mm) { return settled(mm, kLengthsPerMm); }
Json part(double value) { return settled(value, kDirectionsPerUnit); }

Json text_of(Vec2 p) { return Json::array({number(p.x), number(p.y)}); }
Json text_of(Vec3 p) { return Json::array({number(p.x), number(p.y), number(p.z)}); }
Json text_of(const Segment& s) { return Json::array({text_of(s.a), text_of(s.b)}); }
Json text_of(Color color) { return to_string(color); }
Json text_of(Place place) { return Json::array({place.line, place.column}); }
Json direction_text(Vec2 d) { return Json::array({part(d.x), part(d.y)}); }
Json text_of(const Frame& frame) {
    Json axes = Json::array();
    for (const Vec3 axis : frame.axes)
        axes.push_back(Json::array({part(axis.x), part(axis.y), part(axis.z)}));
    return {{"axes", std::move(axes)}, {"origin", text_of(frame.origin)}};
}
Json text_of(const Affine& place) {
    return Json::array({direction_text(place.x), direction_text(place.y), text_of(place.origin)});
}
Json text_of(const Cubic& c) {
    return Json::array({text_of(c.from), text_of(c.control_1), text_of(c.control_2), text_of(c.to)});
}
Json text_of(const FlatCurve::Corner& corner) {
    return Json::array({number(corner.at.x), number(corner.at.y), part(corner.t)});
}
Json text_of(const Polygon& polygon);
template <typename T>
Json text_of(const std::optional<T>& value) {
    return value ? text_of(*value) : Json();
}
template <typename T>
Json text_of(const std::vector<T>& values) {
    Json list = Json::array();
    for (const T& value : values) list.push_back(text_of(value));
    return list;
}
Json text_of(const Polygon& polygon) {
    return {{"outer", text_of(polygon.outer)}, {"holes", text_of(polygon.holes)}};
}

template <typename T>
bool is_none(const std::vector<T>& values) {
    return values.empty();
}
template <typename T>
bool is_none(const std::optional<T>& value) {
    return !value;
}
bool is_none(Place place) { return place == Place{}; }
bool is_none(Vec2 p) { return p == Vec2{}; }

// The files of the images, each once, by their digests.
using Pictures = std::map<std::string, const Image*>;

// Writes what fields() names.
struct Writer {
    const Assembly& assembly;
    Pictures& pictures;
    Json& to;

    void text(const char* name, const std::string& value) { to[name] = value; }
    void flag(const char* name, bool value) { to[name] = value; }
    void flag_if_set(const char* name, bool value) {
        if (value) flag(name, value);
    }
    void sign(const char* name, int value) { to[name] = value; }
    template <typename Word, typename Words>
    void word(const char* name, Word value, const Words& words) {
        to[name] = words.at(static_cast<std::size_t>(value));
    }
    template <typename Word, typename Words>
    void word_if_any(const char* name, Word value, const Words& words) {
        if (static_cast<std::size_t>(value) != 0) word(name, value, words);
    }
    template <typename Names, typename Variant>
    void kind(const char* name, const Names& names, const Variant& value) {
        to[name] = names.at(value.index());
    }

    void length(const char* name, double value) { to[name] = number(value); }
    void degrees(const char* name, double value) { to[name] = settled(value, kAnglesPerDegree); }
    void angle(const char* name, double radians) { to[name] = settled_degrees(radians); }
    void angle_if_any(const char* name, std::optional<double> radians) {
        if (radians) angle(name, *radians);
    }
    void point(const char* name, Vec2 at) { to[name] = text_of(at); }
    void direction(const char* name, Vec2 along) { to[name] = direction_text(along); }
    template <typename T>
    void value(const char* name, const T& value) {
        to[name] = text_of(value);
    }
    template <typename T>
    void value_if_any(const char* name, const T& value) {
        if (!is_none(value)) to[name] = text_of(value);
    }
    template <typename T>
    void value_unless(const char* name, const T& value, const T& other) {
        if (!value.empty() && value != other) to[name] = text_of(value);
    }

    void plate(const char* name, int index) {
        to[name] = assembly.plates.at(static_cast<std::size_t>(index)).name;
    }
    void plate_or_none(const char* name, int index) {
        if (index < 0) {
            to[name] = nullptr;
        } else {
            plate(name, index);
        }
    }
    void piece(const char* name, int index) {
        to[name] = assembly.pieces.at(static_cast<std::size_t>(index)).name;
    }
    void piece_or_none(const char* name, int index) {
        if (index < 0) {
            to[name] = nullptr;
        } else {
            piece(name, index);
        }
    }
    void plates(const char* name, const std::vector<int>& all) {
        Json names = Json::array();
        for (const int one : all) names.push_back(assembly.plates.at(static_cast<std::size_t>(one)).name);
        to[name] = std::move(names);
    }
    void picture(const char* name, const Image& image) {
        std::string digest = sha256(*image.bytes);
        pictures.emplace(digest, &image);
        to[name] = std::move(digest);
    }

    template <typename Inside>
    void object(const char* name, const Inside& inside) {
        Json value = Json::object();
        Writer fields{assembly, pictures, value};
        inside(fields);
        to[name] = std::move(value);
    }
    template <typename T>
    void list(const char* name, const std::vector<T>& all) {
        Json values = Json::array();
        for (const T& one : all) {
            values.push_back(Json::object());
            Writer inside{assembly, pictures, values.back()};
            assembly_text::fields(one, inside);
        }
        to[name] = std::move(values);
    }
    template <typename T>
    void list_if_any(const char* name, const std::vector<T>& all) {
        if (!all.empty()) list(name, all);
    }
    void curves_if_any(const char* name, const CurveTable& table) {
        if (!table.empty()) list(name, table.curves());
    }
};

}  // namespace

std::string emit_assembly(const Assembly& assembly) {
    Pictures pictures;
    Json whole{{"assembly", assembly_text::kVersion}};
    Writer writer{assembly, pictures, whole};
    assembly_text::fields(assembly, writer);
    for (const auto& [digest, image] : pictures) {
        whole["pictures"].push_back({{"sha256", digest},
                                     {"format", mime_type(image->format)},
                                     {"pixels", Json::array({image->width, image->height})},
                                     {"base64", base64(*image->bytes)}});
    }
    return json_text(whole);
}

}  // namespace popup
