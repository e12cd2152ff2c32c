#include "input/assembly/read.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "assembly/fields.h"
#include "assembly/settle.h"
#include "base/system/digest.h"
#include "base/text/base64.h"
#include "base/text/json_tree.h"
#include "base/text/place_at.h"
#include "input/assembly/guarantees.h"
#include "input/text.h"
#include "popup/image.h"

namespace popup::assembly_text {
namespace {

// What all of a document is read with.
class Context {
 public:
    Context(const Source& source, const ReadOptions& options, Diagnostics& diagnostics)
        : text_(source.text), strict_(options.strict), diagnostics_(diagnostics) {}

    void error(std::string_view code, const JsonValue& at, std::string what) {
        sound_ = false;
        // Beyond what is told it is only counted, and no place is looked for.
        diagnostics_.error(code, ++told_ <= kToldPlaces ? place_at(text_, at.at) : Place{}, std::move(what));
    }
    void unknown(const JsonValue& object, const std::string& name) {
        const Severity severity = strict_ ? Severity::error : Severity::warning;
        if (strict_) sound_ = false;
        diagnostics_
            .add(severity, "unknown-member", ++told_ <= kToldPlaces ? place_at(text_, object.at) : Place{},
                 fmt::format("\"{}\" is no member of this, and is not read", shown(name)))
            .hint("take it out, or correct its name");
    }
    [[nodiscard]] bool sound() const { return sound_; }

    std::map<std::string, int, std::less<>> pieces, plates;  // by their names
    std::map<std::string, Image, std::less<>> pictures;      // by their digests

 private:
    static constexpr std::size_t kToldPlaces = 1000;
    std::string_view text_;
    bool strict_;
    Diagnostics& diagnostics_;
    std::size_t told_ = 0;
    bool sound_ = true;
};

// --- values that are made of numbers; false where they are not

bool get(const JsonValue& json, double& value) {
    if (json.number() == nullptr) return false;
    value = *json.number();
    return true;
}
bool get(const JsonValue& json, Vec2& p);
bool get(const JsonValue& json, Vec3& p);
template <typename... Numbers>
bool get_numbers(const JsonValue& json, Numbers&... numbers) {
    const JsonList* list = json.list();
    if (list == nullptr || list->size() != sizeof...(numbers)) return false;
    auto at = list->begin();
    return (get(*at++, numbers) && ...);
}
bool get(const JsonValue& json, Vec2& p) { return get_numbers(json, p.x, p.y); }
bool get(const JsonValue& json, Vec3& p) { return get_numbers(json, p.x, p.y, p.z); }
bool get(const JsonValue& json, Segment& s) { return get_numbers(json, s.a, s.b); }
bool get(const JsonValue& json, Cubic& c) {
    return get_numbers(json, c.from, c.control_1, c.control_2, c.to);
}
bool get(const JsonValue& json, Affine& a) { return get_numbers(json, a.x, a.y, a.origin); }
bool get(const JsonValue& json, FlatCurve::Corner& c) { return get_numbers(json, c.at.x, c.at.y, c.t); }
bool get(const JsonValue& json, Color& color) {
    const auto read = json.text() == nullptr ? std::nullopt : hex_color(*json.text());
    color = read.value_or(Color{});
    return read.has_value();
}
bool get(const JsonValue& json, Place& place) {
    constexpr double kMost = 2e9;
    double line = 0.0;
    double column = 0.0;
    if (!get_numbers(json, line, column)) return false;
    for (const double one : {line, column}) {
        if (!(one >= 0.0 && one <= kMost && one == std::floor(one))) return false;
    }
    place = {static_cast<int>(line), static_cast<int>(column)};
    return true;
}
bool get(const JsonValue& json, Frame& frame) {
    const JsonValue* axes = json.member("axes");
    const JsonValue* origin = json.member("origin");
    return axes != nullptr && origin != nullptr && json.object()->size() == 2 &&
           get_numbers(*axes, frame.axes[0], frame.axes[1], frame.axes[2]) && get(*origin, frame.origin);
}
bool get(const JsonValue& json, Polygon& polygon);
template <typename T>
bool get(const JsonValue& json, std::vector<T>& values) {
    const JsonList* list = json.list();
    if (list == nullptr) return false;
    values.resize(list->size());
    for (std::size_t i = 0; i < list->size(); ++i) {
        if (!get((*list)[i], values[i])) return false;
    }
    return true;
}
bool get(const JsonValue& json, Polygon& polygon) {
    const JsonValue* outer = json.member("outer");
    const JsonValue* holes = json.member("holes");
    return outer != nullptr && holes != nullptr && json.object()->size() == 2 && get(*outer, polygon.outer) &&
           get(*holes, polygon.holes);
}
template <typename T>
bool get(const JsonValue& json, std::optional<T>& value) {
    if (json.null()) {
        value.reset();
        return true;
    }
    return get(json, value.emplace());
}

// What a value of the type looks like, for messages.
constexpr std::string_view looks(const Vec2& /*of*/) { return "a point, [x, y]"; }
constexpr std::string_view looks(const std::optional<Vec2>& /*of*/) { return "a point, [x, y]"; }
constexpr std::string_view looks(const Segment& /*of*/) { return "a line, [[x, y], [x, y]]"; }
constexpr std::string_view looks(const Ring& /*of*/) { return "a list of points, [[x, y], ...]"; }
constexpr std::string_view looks(const Polygon& /*of*/) { return R"({"outer": a ring, "holes": [rings]})"; }
constexpr std::string_view looks(const std::vector<Polygon>& /*of*/) {
    return R"(a list of areas, [{"outer": a ring, "holes": [rings]}, ...])";
}
constexpr std::string_view looks(const std::vector<Ring>& /*of*/) { return "a list of lists of points"; }
constexpr std::string_view looks(const std::vector<std::vector<Vec3>>& /*of*/) {
    return "a list of lists of points, each [x, y, z]";
}
constexpr std::string_view looks(const std::vector<FlatCurve::Corner>& /*of*/) {
    return "a list of corners, each [x, y, t]";
}
constexpr std::string_view looks(const Color& /*of*/) { return "a colour, \"#rrggbb\""; }
constexpr std::string_view looks(const std::optional<Color>& /*of*/) {
    return "a colour, \"#rrggbb\", or null";
}
constexpr std::string_view looks(const Place& /*of*/) { return "a place, [line, column]"; }
constexpr std::string_view looks(const std::optional<Frame>& /*of*/) {
    return R"({"axes": [[x, y, z] three times], "origin": [x, y, z]})";
}
constexpr std::string_view looks(const Affine& /*of*/) { return "three points, [[x, y], [x, y], [x, y]]"; }
constexpr std::string_view looks(const Cubic& /*of*/) { return "four points, [[x, y], ...]"; }

// XML can hold no others, and nobody can read them.
bool can_be_printed(const std::string& text) {
    return std::none_of(text.begin(), text.end(),
                        [](char c) {
                            const auto byte = static_cast<unsigned char>(c);
                            return byte < 0x20 || byte == 0x7F;
                        }) &&
           text.find("\xEF\xBF\xBE") == std::string::npos && text.find("\xEF\xBF\xBF") == std::string::npos;
}

// Fills in what fields() names, from one object.
class Reader {
 public:
    Reader(Context& context, const JsonValue& object) : context_(context), object_(object) {}

    void text(const char* name, std::string& value) {
        const JsonValue* json = needed(name);
        if (json == nullptr) return;
        if (json->text() == nullptr) return wrong(name, *json, "a text");
        if (!can_be_printed(*json->text())) return wrong(name, *json, "a text without control characters");
        value = *json->text();
    }
    void flag(const char* name, bool& value) {
        const JsonValue* json = needed(name);
        if (json == nullptr) return;
        if (json->flag() == nullptr) return wrong(name, *json, "true or false");
        value = *json->flag();
    }
    void flag_if_set(const char* name, bool& value) {
        if (found(name) != nullptr) flag(name, value);
    }
    void sign(const char* name, int& value) {
        const JsonValue* json = needed(name);
        if (json == nullptr) return;
        if (json->number() == nullptr || std::abs(*json->number()) != 1.0)
            return wrong(name, *json, "-1 or 1");
        value = static_cast<int>(*json->number());
    }
    template <typename Word, typename Words>
    void word(const char* name, Word& value, const Words& words) {
        if (const auto number = one_of(name, words)) value = static_cast<Word>(*number);
    }
    template <typename Word, typename Words>
    void word_if_any(const char* name, Word& value, const Words& words) {
        if (found(name) != nullptr) word(name, value, words);
    }
    template <typename Names, typename Variant>
    void kind(const char* name, const Names& names, Variant& value) {
        if (const auto number = one_of(name, names)) emplace(value, *number);
    }

    void length(const char* name, double& value) { this->value(name, value, "a length in mm"); }
    void degrees(const char* name, double& value) { this->value(name, value, "an angle in degrees"); }
    void angle(const char* name, double& radians) {
        double deg = 0.0;
        degrees(name, deg);
        radians = radians_of(deg);
    }
    void angle_if_any(const char* name, std::optional<double>& radians) {
        if (found(name) != nullptr) angle(name, radians.emplace());
    }
    void point(const char* name, Vec2& at) { value(name, at); }
    void direction(const char* name, Vec2& along) { value(name, along, "a unit vector, [x, y]"); }
    template <typename T>
    void value(const char* name, T& value) {
        this->value(name, value, looks(value));
    }
    template <typename T>
    void value_if_any(const char* name, T& value) {
        if (found(name) != nullptr) this->value(name, value);
    }
    template <typename T>
    void value_unless(const char* name, T& value, const T& other) {
        if (found(name) != nullptr) {
            this->value(name, value);
        } else {
            value = other;
        }
    }

    void plate(const char* name, int& index) { named(name, index, context_.plates, "plate"); }
    void piece(const char* name, int& index) { named(name, index, context_.pieces, "piece"); }
    void plate_or_none(const char* name, int& index) {
        if (!none(name, index)) plate(name, index);
    }
    void piece_or_none(const char* name, int& index) {
        if (!none(name, index)) piece(name, index);
    }
    void plates(const char* name, std::vector<int>& all) {
        const JsonValue* json = needed(name);
        if (json == nullptr) return;
        if (json->list() == nullptr) return wrong(name, *json, "a list of names of plates");
        for (const JsonValue& one : *json->list())
            look_up(one, all.emplace_back(0), context_.plates, "plate");
    }
    void picture(const char* name, Image& image) {
        const JsonValue* json = needed(name);
        if (json == nullptr) return;
        const auto known =
            json->text() == nullptr ? context_.pictures.end() : context_.pictures.find(*json->text());
        if (known == context_.pictures.end())
            return context_.error("assembly-name", *json, "there is no picture with this digest");
        image = known->second;
    }

    template <typename Inside>
    void object(const char* name, const Inside& inside) {
        const JsonValue* json = needed(name);
        if (json == nullptr) return;
        if (json->object() == nullptr) return wrong(name, *json, "an object");
        Reader reader(context_, *json);
        inside(reader);
        reader.end();
    }
    template <typename T>
    void list(const char* name, std::vector<T>& all) {
        const JsonValue* json = needed(name);
        if (json == nullptr) return;
        if (json->list() == nullptr) return wrong(name, *json, "a list");
        all.resize(json->list()->size());
        for (std::size_t i = 0; i < all.size(); ++i) {
            const JsonValue& one = (*json->list())[i];
            if (one.object() == nullptr) return wrong(name, one, "a list of objects");
            Reader reader(context_, one);
            fields(all[i], reader);
            reader.end();
        }
    }
    template <typename T>
    void list_if_any(const char* name, std::vector<T>& all) {
        if (found(name) != nullptr) list(name, all);
    }
    void curves_if_any(const char* name, CurveTable& table) {
        std::vector<FlatCurve> curves;
        list_if_any(name, curves);
        table = CurveTable(curves);
    }

    // Names what nobody asked for.
    void end() {
        if (asked_.size() >= object_.object()->size() && missed_ == 0) return;
        for (const auto& [name, value] : *object_.object()) {
            if (std::find(asked_.begin(), asked_.end(), name) == asked_.end()) context_.unknown(value, name);
        }
    }
    void ask(std::string_view name) { asked_.push_back(name); }

 private:
    const JsonValue* found(const char* name) {
        const JsonValue* json = object_.member(name);
        if (json != nullptr && std::find(asked_.begin(), asked_.end(), name) == asked_.end()) ask(name);
        return json;
    }
    const JsonValue* needed(const char* name) {
        const JsonValue* json = found(name);
        if (json == nullptr) {
            ++missed_;
            context_.error("assembly-value", object_, fmt::format("\"{}\" is missing here", name));
        }
        return json;
    }
    void wrong(const char* name, const JsonValue& json, std::string_view wanted) {
        context_.error("assembly-value", json, fmt::format("\"{}\" must be {}", name, wanted));
    }
    template <typename T>
    void value(const char* name, T& value, std::string_view wanted) {
        const JsonValue* json = needed(name);
        if (json != nullptr && !get(*json, value)) wrong(name, *json, wanted);
    }
    template <typename Words>
    std::optional<std::size_t> one_of(const char* name, const Words& words) {
        const JsonValue* json = needed(name);
        if (json == nullptr) return std::nullopt;
        const auto word =
            json->text() == nullptr ? words.end() : std::find(words.begin(), words.end(), *json->text());
        if (word == words.end()) {
            wrong(name, *json, fmt::format("one of: {}", fmt::join(words, ", ")));
            return std::nullopt;
        }
        return static_cast<std::size_t>(word - words.begin());
    }
    template <typename Variant, std::size_t I = 0>
    static void emplace(Variant& value, std::size_t number) {
        if constexpr (I < std::variant_size_v<Variant>) {
            if (number == I) {
                value.template emplace<I>();
            } else {
                emplace<Variant, I + 1>(value, number);
            }
        }
    }
    bool none(const char* name, int& index) {
        const JsonValue* json = found(name);
        if (json != nullptr && !json->null()) return false;
        index = -1;
        return true;
    }
    using Names = std::map<std::string, int, std::less<>>;
    void named(const char* name, int& index, const Names& names, std::string_view what) {
        index = 0;
        if (const JsonValue* json = needed(name)) look_up(*json, index, names, what);
    }
    void look_up(const JsonValue& json, int& index, const Names& names, std::string_view what) {
        const auto known = json.text() == nullptr ? names.end() : names.find(*json.text());
        if (known != names.end()) {
            index = known->second;
        } else if (json.text() == nullptr) {
            context_.error("assembly-value", json, fmt::format("the name of a {} stands here", what));
        } else {
            context_.error("assembly-name", json,
                           fmt::format("there is no {} \"{}\"", what, shown(*json.text())));
        }
    }

    Context& context_;
    const JsonValue& object_;
    std::vector<std::string_view> asked_;
    std::size_t missed_ = 0;
};

void learn_names(const JsonValue& root, const char* list, std::map<std::string, int, std::less<>>& names) {
    const JsonValue* all = root.member(list);
    if (all == nullptr || all->list() == nullptr) return;
    int number = 0;
    for (const JsonValue& one : *all->list()) {
        const JsonValue* name = one.member("name");
        if (name != nullptr && name->text() != nullptr) names.emplace(*name->text(), number);
        ++number;
    }
}

// What the text says of a picture besides its bytes follows from them.
void learn_pictures(const JsonValue& root, Context& context) {
    const JsonValue* all = root.member("pictures");
    if (all == nullptr) return;
    if (all->list() == nullptr) return context.error("assembly-value", *all, "\"pictures\" is a list");
    for (const JsonValue& one : *all->list()) {
        const JsonValue* digest = one.member("sha256");
        const JsonValue* data = one.member("base64");
        if (digest == nullptr || digest->text() == nullptr || data == nullptr || data->text() == nullptr) {
            context.error("assembly-value", one, "a picture has its \"sha256\" and its bytes as \"base64\"");
            continue;
        }
        std::optional<std::string> bytes = from_base64(*data->text());
        if (!bytes) {
            context.error("assembly-value", *data, "this is not base64");
            continue;
        }
        if (sha256(*bytes) != *digest->text()) {
            context.error("assembly-value", *digest, "the picture has another digest");
            continue;
        }
        const auto opened = open_image(std::move(*bytes));
        if (const auto* fault = std::get_if<ImageFault>(&opened)) {
            context.error("assembly-value", *data, std::string(to_string(*fault)));
        } else {
            context.pictures.emplace(*digest->text(), std::get<Image>(opened));
        }
    }
}

// Where the part stands that a fault is about.
const JsonValue& part_of(const JsonValue& root, const AssemblyFault& fault) {
    using Of = AssemblyFault::Of;
    static const std::map<Of, std::string_view> lists{
        {Of::piece, "pieces"}, {Of::plate, "plates"},           {Of::line, "lines"},   {Of::hinge, "hinges"},
        {Of::glue, "glue"},    {Of::glued_area, "glued_areas"}, {Of::joint, "joints"}, {Of::layer, "layers"}};
    const auto list = lists.find(fault.part);
    const JsonValue* all = list == lists.end() ? nullptr : root.member(list->second);
    if (all == nullptr || all->list() == nullptr || fault.number >= all->list()->size()) return root;
    return (*all->list())[fault.number];
}

bool is_ours(const JsonValue& root, Context& context) {
    if (const JsonList* list = root.list()) {
        context.error("assembly-value", root,
                      fmt::format("this is a list of {}; a file holds one assembly", list->size()));
        return false;
    }
    const JsonValue* version = root.member("assembly");
    if (version == nullptr || version->number() == nullptr || *version->number() != kVersion) {
        context.error(
            "assembly-value", version == nullptr ? root : *version,
            fmt::format("an assembly begins with \"assembly\": {}, the version of the format", kVersion));
        return false;
    }
    return true;
}

}  // namespace

std::optional<Assembly> read(const Source& source, const ReadOptions& options, Diagnostics& diagnostics) {
    const std::optional<JsonValue> root = read_json(source.text, "assembly-syntax", diagnostics);
    if (!root) return std::nullopt;
    Context context(source, options, diagnostics);
    if (!is_ours(*root, context)) return std::nullopt;
    learn_names(*root, "pieces", context.pieces);
    learn_names(*root, "plates", context.plates);
    learn_pictures(*root, context);

    Assembly assembly;
    Reader reader(context, *root);
    reader.ask("assembly");
    reader.ask("pictures");
    fields(assembly, reader);
    reader.end();
    if (!context.sound()) return std::nullopt;
    for (const Joint& joint : assembly.joints) hang_plates(joint, assembly.plates);
    settle_numbers(assembly);
    for (const AssemblyFault& fault : faults_of(assembly))
        context.error("assembly-fault", part_of(*root, fault), fault.what);
    if (!context.sound()) return std::nullopt;
    return assembly;
}

bool recognises(std::string_view text) {
    constexpr std::string_view kBlanks = " \t\r\n";
    const auto take = [&](std::string_view word) {
        text.remove_prefix(std::min(text.find_first_not_of(kBlanks), text.size()));
        if (!text.starts_with(word)) return false;
        text.remove_prefix(word.size());
        return true;
    };
    return take("{") && take("\"assembly\"");
}

}  // namespace popup::assembly_text
