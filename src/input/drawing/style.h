// What of CSS decides whether, and as what, a shape is drawn.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "input/drawing/variables.h"
#include "parts/tracing.h"
#include "popup/print.h"

namespace popup::drawing {

// Whether a list has the word.
template <typename List>
bool among(const List& list, std::string_view word) {
    return std::find(list.begin(), list.end(), word) != list.end();
}

enum class Property {
    stroke,
    fill,
    display,
    visibility,
    dashes,
    width,
    fill_rule,
    clip,
    mask,
    opacity,
    stroke_opacity,
    fill_opacity,
    color,
    transform,
    transform_origin
};
inline constexpr std::size_t kProperties = 15;
// The property called `name` in CSS and as an attribute.
std::optional<Property> find_property(std::string_view name);

// Values for an element, each with how much it weighs against others of the same property.
class Declarations {
 public:
    // Weights of SVG's own attributes, of style sheets by what their selectors name, and of style="…".
    static constexpr int kAttribute = -1, kAny = 0, kTag = 1, kClass = 10, kId = 100, kElement = 1000;

    // Takes `value` where no heavier one is there; of equal ones the later counts (by `order`). A value that
    // ends in "!important" outweighs all without it.
    void set(Property property, std::string_view value, int weight, std::uint32_t order);
    // "stroke: red; fill: none; --fold: blue"; what is neither a property of ours, nor a variable, nor one of
    // kGeometry and kNotRead is disregarded.
    void set_all(std::string_view list, int weight, std::uint32_t order);
    // Those of `other` are taken in the same way.
    void add(const Declarations& other);
    [[nodiscard]] const std::string* find(Property property) const;
    // Custom properties, as they are written.
    [[nodiscard]] VariableTexts variables() const;
    [[nodiscard]] std::size_t variable_count() const { return variables_.size(); }
    // Where a style sheet or style="…" places a shape: by name what it says of kGeometry that can be read.
    // Each is a length, or path data.
    [[nodiscard]] std::vector<std::pair<std::string_view, std::string_view>> geometry() const;
    // The names of what else places it: of kNotRead, and of kGeometry such as calc(1px + 1mm). Those that
    // change nothing are left out.
    [[nodiscard]] std::vector<std::string_view> not_read() const;
    // Puts variables into all values. A value that nothing can be put into is as if it were not there, but
    // for that of strokes, which stays as it is written. Returns the variables that are not set, which these
    // would have needed.
    std::vector<std::string> put_in(const Variables& variables);

 private:
    struct Value {
        std::string text;
        int weight = 0;
        std::uint32_t order = 0;
    };
    static Value weighed(std::string_view value, int weight, std::uint32_t order);
    void set(Property property, const Value& value);
    using Named = std::map<std::string, Value, std::less<>>;
    static void set(Named& named, std::string_view name, const Value& value);
    std::array<std::optional<Value>, kProperties> values_;
    Named variables_, others_;
};

// Words that set no value of a property: inherit, initial and their like.
bool sets_nothing(std::string_view value);

// What SVG 2 calls geometry properties: each is an attribute, too, which it outweighs.
inline constexpr std::array<std::string_view, 10> kGeometry{"x",  "y", "width", "height", "cx",
                                                            "cy", "r", "rx",    "ry",     "d"};
// What places shapes as well, and is not read.
inline constexpr std::array<std::string_view, 5> kNotRead{"transform-box", "translate", "rotate", "scale",
                                                          "offset-path"};

// The rules of all style elements. Read are selectors of one element (*, tag, .class, #id, tag.class, :root);
// others, such as "g > path", are counted.
class StyleSheet {
 public:
    void add(std::string_view css);
    // Adds what the rules say of an element. `is_root`: of the drawing.
    void apply(std::string_view tag, std::string_view id, std::string_view classes, bool is_root,
               Declarations& declarations) const;
    [[nodiscard]] int not_read() const { return not_read_; }
    // Counts one for others, such as for printers, as a rule that is not read.
    void leave_out() { ++not_read_; }
    // "@import …;": sheets in other files.
    [[nodiscard]] int imports() const { return imports_; }

 private:
    void add_rule(std::string_view selectors, std::string_view body);
    std::map<std::string, Declarations, std::less<>> rules_;
    std::uint32_t order_ = 0;
    int not_read_ = 0;
    int imports_ = 0;
};

struct Paint {
    enum class Kind { none, color, other };  // other: a gradient, a pattern, a colour that is not understood
    Kind kind = Kind::none;
    Color color{0, 0, 0};
    friend bool operator==(const Paint&, const Paint&) = default;
};
// What CSS Color 4 calls a colour of sRGB: names, #rgb and its like, rgb(), hsl() and hwb(), with commas or
// without. One that is wholly transparent is none; any other is taken as opaque.
Paint parse_paint(std::string_view text);

// How a shape is drawn; children of an element begin with its values.
struct Style {
    Paint color{Paint::Kind::color, {0, 0, 0}};  // what currentColor stands for
    Paint stroke;
    std::string stroke_text;                              // as it was written; empty: nowhere
    bool stroke_is_color = false, fill_is_color = false;  // currentColor
    Paint fill{Paint::Kind::color, {0, 0, 0}};
    bool fill_written = false;  // the black that is meant when nothing is said is not
    Dash dash = Dash::none;
    double dash_length = 0.0, gap_length = 0.0;  // the longest, in user units
    bool visible = true;
    bool displayed = true;  // false for an element and all that is in it
    bool even_odd = false;
    double width = 1.0;  // of the stroke, in user units
    // 0 to 1; `opacity` is that of the element times those of all groups around it.
    double stroke_opacity = 1.0, fill_opacity = 1.0, opacity = 1.0;
    Variables variables;

    // Takes what is declared for an element, after its variables were put in there. Returns those that would
    // have been needed, and are not set. A stroke of such is one that is not understood, unless one is
    // inherited.
    std::vector<std::string> take(Declarations& declarations);
};

}  // namespace popup::drawing
