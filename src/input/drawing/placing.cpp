#include "input/drawing/placing.h"

#include "input/text.h"

namespace popup::drawing {

Placing placing_of(const Declarations& declared, const Attributes& attributes, Vec2 view) {
    Placing made;
    made.not_read = declared.not_read();
    const std::string* said = declared.find(Property::transform);
    if (said == nullptr || sets_nothing(*said)) return made;
    auto map = parse_transform(*said);
    const xml::Attribute* attribute = attributes.find("transform");
    if (!map && (attribute == nullptr || trimmed(attribute->value.decoded) != *said)) {
        made.not_read.emplace_back("transform");
        if (attribute == nullptr) return made;
        map = parse_transform(attribute->value.decoded);
    }
    if (!map) {
        made.fault = attribute;
        return made;
    }
    Vec2 about;
    const std::string* origin = declared.find(Property::transform_origin);
    if (origin != nullptr && !sets_nothing(*origin)) {
        const auto read = parse_origin(*origin, view);
        if (!read) made.not_read.emplace_back("transform-origin");
        about = read.value_or(about);
    }
    const Affine there{1.0, 0.0, 0.0, 1.0, about.x, about.y};
    made.map = there.after(*map).after({1.0, 0.0, 0.0, 1.0, -about.x, -about.y});
    return made;
}

}  // namespace popup::drawing
