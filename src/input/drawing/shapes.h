// The shapes of SVG as paths.
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "input/drawing/entities.h"
#include "input/xml/tree.h"
#include "popup/path.h"

namespace popup::drawing {

// The attributes of an element, by name.
class Attributes {
 public:
    explicit Attributes(std::vector<xml::Attribute> all) : all_(std::move(all)) {}
    // With entities expanded, but for values that have an escaped "&", too. `text`: what they stand in.
    Attributes(std::vector<xml::Attribute> all, Entities& entities, std::string_view text);
    Attributes(const Attributes&) = delete;
    Attributes& operator=(const Attributes&) = delete;
    Attributes(Attributes&&) = default;
    Attributes& operator=(Attributes&&) = default;
    ~Attributes() = default;
    [[nodiscard]] const xml::Attribute* find(std::string_view name) const;
    // Its value; empty when it is missing.
    [[nodiscard]] std::string_view value(std::string_view name) const;
    [[nodiscard]] const std::vector<xml::Attribute>& all() const { return all_; }
    // Takes what a style says of one in its place.
    void put(std::string_view name, std::string_view value, Place place);

 private:
    std::vector<xml::Attribute> all_;
    std::deque<std::string> expanded_;  // names and values that stand for others
};

// What is wrong with an attribute.
struct ShapeProblem {
    const xml::Attribute* attribute = nullptr;
    std::string_view code;
    std::string message;
    std::optional<std::size_t> at;  // a byte of the value
};

// True of path, rect, circle, ellipse, line, polyline and polygon.
bool is_shape(std::string_view tag);
// The shape as a path, in user units; lengths in percent are of `view`. A shape without size is an empty
// path.
std::optional<ShapeProblem> make_shape(std::string_view tag, const Attributes& attributes, Vec2 view,
                                       Path& path);
// The length in `name`, or `otherwise` where it is missing or auto; a fault goes to `problem` if that is
// free.
double length_of(const Attributes& attributes, std::string_view name, double whole, double otherwise,
                 std::optional<ShapeProblem>& problem);

}  // namespace popup::drawing
