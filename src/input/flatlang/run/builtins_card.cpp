// popup(), what names and draws on a card, and one builtin for each row of the element table.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "input/color.h"
#include "input/flatlang/run/card.h"
#include "input/flatlang/run/interpreter.h"
#include "input/text.h"

namespace popup::flatlang {
namespace {

constexpr double kInch = 25.4;
constexpr double kFlat = 1e-4;  // inches: as far as a vector may leave the page's plane

// What objects stand for is kept in members whose names no program can write.
constexpr std::string_view kFoldNumber = "fold number";
constexpr std::string_view kElementNumber = "element number";
constexpr std::string_view kFoldHint =
    "the gutter is the .gutter of what popup() returns; an element has the folds .left, .centre and .right";

// Ends the program; does not return. `what` goes on behind the builtin's name: "has 4 points …".
void refuse(const Call& call, const Refusal& refusal) {
    call.in.fail(call.place, fmt::format("{}() {}", call.name, refusal.what), refusal.hint);
}

// The same of one argument, or of a point in it.
void refuse_argument(const Call& call, std::size_t i, const Value& value, std::string_view wanted,
                     std::string hint = {}) {
    call.in.fail_argument(call, i,
                          fmt::format("argument {} of {}() is {}, where {} is expected", i + 1, call.name,
                                      type_name(value->type), wanted),
                          std::move(hint));
}

// The card; the program ends where there is none.
Card& card_of(const Call& call) {
    if (!call.in.card.design) refuse(call, {"has no card to go to", "call popup() before it"});
    return call.in.card;
}

std::optional<std::size_t> hidden_number(const Call& call, const Value& value, std::string_view name) {
    if (value->type != Type::object) return std::nullopt;
    const Value* found = value->first->member(call.in.symbols.of(name));
    if (found == nullptr) return std::nullopt;
    return static_cast<std::size_t>((*found)->number);
}

void set(const Call& call, const Value& object, std::string_view name, Value value) {
    object->first->set_member(call.in.symbols.of(name), std::move(value));
}

// Rounded as all numbers of the language are. volatile: gcc 12 forgets the rounding of two numbers side by
// side where it makes one vector of them (-ftree-slp-vectorize).
double rounded(double number) {
    const volatile auto narrow = static_cast<float>(number);
    return static_cast<double>(narrow);
}

void set_number(const Call& call, const Value& object, std::string_view name, double number) {
    set(call, object, name, call.in.heap.number(rounded(number)));
}

Value object_of(const Call& call, std::string text) {
    Value made = call.in.heap.object();
    set(call, made, "__str__", call.in.heap.text(std::move(text)));
    return made;
}

Value point_value(const Call& call, Vec2 mm) {
    return call.in.heap.vec({rounded(mm.x / kInch), rounded(mm.y / kInch), 0.0});
}

Value fold_value(const Call& call, std::size_t number, const std::string& text) {
    const PageFold& fold = call.in.card.folds[number];
    Value made = object_of(call, text);
    set_number(call, made, kFoldNumber, static_cast<double>(number));
    set_number(call, made, "page", fold.left_page);
    set(call, made, "begin", point_value(call, fold.on_left.a));
    set(call, made, "end", point_value(call, fold.on_left.b));
    set_number(call, made, "length", distance(fold.on_left.a, fold.on_left.b) / kInch);
    return made;
}

// Arguments in the order in which they are taken: what the call begins with, points, numbers, colours.
class Arguments {
 public:
    explicit Arguments(const Call& call) : call_(call) {}

    [[nodiscard]] bool more() const { return next_ < call_.arguments.size(); }
    [[nodiscard]] std::size_t position() const { return next_; }
    [[nodiscard]] bool next_is(Type type) const { return more() && peek()->type == type; }
    [[nodiscard]] const Value& peek() const { return call_.arguments[next_]; }
    const Value& take() { return call_.arguments[next_++]; }

    // All points that come next, in mm: vectors, lists of two numbers, and lists of points.
    std::vector<Vec2> take_points() {
        std::vector<Vec2> points;
        while (next_is(Type::list) || next_is(Type::vec)) {
            const Value& value = take();
            const bool of_points = value->type == Type::list && value->first &&
                                   (value->first->type == Type::list || value->first->type == Type::vec);
            if (!of_points) {
                points.push_back(point(value));
                continue;
            }
            for (const Value* one = &value->first; *one; one = &(*one)->next) points.push_back(point(*one));
        }
        call_.in.spend(points.size());
        return points;
    }

    std::optional<double> take_number() {
        if (!next_is(Type::number)) return std::nullopt;
        return take()->number;
    }

    // Numbers (lengths in mm), words and path data that come next, for parameters of the row.
    // A text that is a parameter's name says that the next is its value.
    std::vector<NewValue> take_values(const ElementInfo& info) {
        std::vector<NewValue> values;
        std::size_t lengths = 0;
        for (; more(); ++next_) {
            if (peek()->type == Type::text && find_parameter(info, peek()->text)) {
                values.push_back(named_value(info));
            } else if (peek()->type == Type::number) {
                const ParameterInfo* parameter = number_parameter(info, lengths++);
                if (parameter == nullptr) break;
                values.push_back({{}, peek()->number * unit_of(*parameter)});
            } else if (peek()->type == Type::text && is_value(info, peek()->text)) {
                values.push_back({{}, peek()->text});
            } else {
                break;
            }
        }
        return values;
    }

    std::vector<Color> take_colors() {
        std::vector<Color> colors;
        while (next_is(Type::text)) {
            const std::string& text = take()->text;
            const auto color = parse_color(text);
            if (!color) {
                const std::string near = nearest_color_name(text);
                call_.in.fail_argument(call_, next_ - 1,
                                       fmt::format("argument {} of {}() is \"{}\", which is not a colour",
                                                   next_, call_.name, shown(text)),
                                       near.empty() ? "write #rrggbb, r,g,b or a CSS colour name"
                                                    : fmt::format("perhaps '{}' is meant", near));
            }
            colors.push_back(color.value_or(Color{}));
        }
        return colors;
    }

    // Nothing may be left. `wanted` is what could have come.
    void end(std::string_view wanted, std::string hint = {}) {
        if (more()) refuse_argument(call_, next_, peek(), wanted, std::move(hint));
    }

 private:
    static double unit_of(const ParameterInfo& parameter) {
        return parameter.kind == ParameterKind::length ? kInch : 1.0;
    }

    // A parameter's name, and the value behind it, which is the argument that comes next then.
    NewValue named_value(const ElementInfo& info) {
        const std::string& name = take()->text;
        const ParameterInfo& parameter = info.parameters[find_parameter(info, name).value()];
        if (next_is(Type::number)) return {name, peek()->number * unit_of(parameter)};
        if (next_is(Type::text)) return {name, peek()->text};
        if (more()) refuse_argument(call_, next_, peek(), fmt::format("the value of \"{}\"", name));
        refuse(call_, {fmt::format("ends with \"{}\", which wants a value behind it", name), ""});
        return {};
    }

    // The n-th parameter that is a number.
    static const ParameterInfo* number_parameter(const ElementInfo& info, std::size_t n) {
        for (const ParameterInfo& parameter : info.parameters) {
            const bool number =
                parameter.kind == ParameterKind::length || parameter.kind == ParameterKind::number;
            if (number && n-- == 0) return &parameter;
        }
        return nullptr;
    }

    // A word of one of its choices, or path data where it has a path.
    static bool is_value(const ElementInfo& info, const std::string& text) {
        return std::any_of(info.parameters.begin(), info.parameters.end(), [&](const ParameterInfo& p) {
            return (p.kind == ParameterKind::path && is_path_data(text)) ||
                   std::find(p.words.begin(), p.words.end(), text) != p.words.end();
        });
    }

    // Of the argument taken last.
    Vec2 point(const Value& value) {
        constexpr std::string_view kWanted = "a point [x, y]";
        Vec2 at;
        if (value->type == Type::vec) {
            const auto& numbers = value->extras->numbers;
            if (!(std::abs(numbers[2]) <= kFlat)) {
                refuse(call_, {fmt::format("has a point {:.6g} inches above the page in argument {}",
                                           numbers[2], next_),
                               "points of a card lie in its pages, where z is 0"});
            }
            at = {numbers[0], numbers[1]};
        } else if (value->type == Type::list) {
            std::array<double, 2> numbers{};
            std::size_t count = 0;
            for (const Value* one = &value->first; *one; one = &(*one)->next, ++count) {
                if ((*one)->type != Type::number) {
                    call_.in.fail_argument(
                        call_, next_ - 1,
                        fmt::format("argument {} of {}() has {} in a point, where numbers are expected",
                                    next_, call_.name, type_name((*one)->type)),
                        "a point is [x, y], in inches");
                }
                if (count < 2) numbers[count] = (*one)->number;
            }
            if (count != 2) {
                call_.in.fail_argument(
                    call_, next_ - 1,
                    fmt::format("argument {} of {}() is a list of {} numbers, where {} is expected", next_,
                                call_.name, count, kWanted));
            }
            at = {numbers[0], numbers[1]};
        } else {
            refuse_argument(call_, next_ - 1, value, kWanted);
        }
        return kInch * at;
    }

    const Call& call_;
    std::size_t next_ = 0;
};

// popup([width, height] [, colour [, colour of the right half]])
Value popup_card(const Call& call) {
    Interpreter& in = call.in;
    if (in.as_2008()) return in.heap.nil();
    if (in.card.design) {
        refuse(call, {fmt::format("was called before, on line {}", in.card.place.line),
                      "a program makes one card; write another program for another card"});
    }
    Arguments arguments(call);
    NewCard wanted;
    wanted.place = call.in.program_place(call.place);
    if (arguments.next_is(Type::number)) {
        wanted.width_mm = kInch * arguments.take()->number;
        const auto height = arguments.take_number();
        if (!height) refuse(call, {"has a width and no height", "popup(11, 8.5) is a sheet of letter paper"});
        wanted.height_mm = kInch * height.value_or(0.0);
    }
    const std::vector<Color> colors = arguments.take_colors();
    arguments.end(arguments.position() == 0 ? "the page's width" : "a colour");
    if (colors.size() > 2) refuse(call, {"has more than two colours, of the page's left and right half"});
    if (!colors.empty()) {
        wanted.left = colors.front();
        wanted.right = colors.back();
    }
    if (const auto refusal = begin_card(in.card, wanted)) refuse(call, *refusal);

    Value made = object_of(call, "card");
    set_number(call, made, kFoldNumber, 0);
    set(call, made, "gutter", fold_value(call, 0, "gutter"));
    set_number(call, made, "page", 0);
    set_number(call, made, "width", wanted.width_mm / kInch);
    set_number(call, made, "height", wanted.height_mm / kInch);
    return made;
}

// Up to four colours: of both halves, or of each; of both tabs, or of each.
Paint paint(const Call& call, Arguments& arguments) {
    const std::vector<Color> colors = arguments.take_colors();
    if (colors.size() > 4)
        refuse(call, {"has more than four colours, of its left and right half and of their tabs"});
    Paint made;
    if (!colors.empty()) {
        made.left = colors.front();
        made.right = colors.size() > 1 ? colors[1] : colors.front();
    }
    if (colors.size() > 2) {
        made.left_tab = colors[2];
        made.right_tab = colors.back();
    }
    return made;
}

// What an element stands on, and its points: a fold; or the card or an element, and then first a point of the
// plate on its page.
void take_ground(const Call& call, Arguments& arguments, NewElement& wanted) {
    const Value& parent = arguments.take();
    const Grounds& grounds = wanted.info->grounds;
    const auto element = hidden_number(call, parent, kElementNumber);
    const auto fold = hidden_number(call, parent, kFoldNumber);
    if (grounds.page && (element || fold)) {
        wanted.page = element ? call.in.card.pages[*element] : call.in.card.folds[*fold].left_page;
        return;
    }
    if (grounds.plate && (element || (fold && !grounds.fold && !grounds.seam))) {
        wanted.points = arguments.take_points();
        if (wanted.points.empty())
            refuse(call, {"is given no point of the plate it stands on", "it comes before the other points"});
        const int page = element ? call.in.card.pages[*element] : call.in.card.folds[*fold].left_page;
        wanted.plate = PlatePlace{page, wanted.points.front()};
        wanted.points.erase(wanted.points.begin());
        return;
    }
    if (!fold && element) {
        refuse(call, {"is given an element to stand on, where one of its folds is expected",
                      std::string(kFoldHint)});
    }
    if (!fold) refuse_argument(call, 0, parent, "a fold to stand on", std::string(kFoldHint));
    wanted.fold = fold.value_or(0);
    wanted.points = arguments.take_points();
}

// step(fold, points… [, colours of the halves [, colours of their tabs]]), and so for every row.
Value element(const Call& call) {
    Interpreter& in = call.in;
    if (in.as_2008()) return in.heap.nil();
    Card& card = card_of(call);
    // As long as these take about what it takes to make one.
    constexpr std::uint64_t kStepsPerElement = 100;
    in.spend(kStepsPerElement);
    NewElement wanted;
    wanted.info = static_cast<const ElementInfo*>(call.data);
    wanted.place = call.in.program_place(call.place);
    Arguments arguments(call);
    take_ground(call, arguments, wanted);
    wanted.values = arguments.take_values(*wanted.info);
    wanted.paint = paint(call, arguments);
    arguments.end(wanted.paint.left ? "a colour" : "a point or a colour",
                  fmt::format("the points are {}", letters_of(*wanted.info)));
    std::optional<std::size_t> folds;
    if (const auto refusal = add_element(card, wanted, folds)) refuse(call, *refusal);

    const std::size_t number = card.pages.size() - 1;
    const std::string text = fmt::format("{} {}", wanted.info->name, number + 1);
    Value made = object_of(call, text);
    set_number(call, made, kElementNumber, static_cast<double>(number));
    set_number(call, made, "page", card.pages[number]);
    // Without a member of that name .left would be the function left().
    for (std::size_t i = 0; i < wanted.info->folds.size(); ++i) {
        const std::string_view name = wanted.info->folds[i].name;
        set(call, made, name,
            folds ? fold_value(call, *folds + i, fmt::format("{} fold of {}", name, text)) : in.heap.nil());
    }
    return made;
}

// painted(element, colours of the halves [, colours of their tabs]): the element.
Value painted(const Call& call) {
    if (call.in.as_2008()) return call.in.heap.nil();
    Card& card = card_of(call);
    Arguments arguments(call);
    const Value& value = arguments.take();
    const auto number = hidden_number(call, value, kElementNumber);
    if (!number) refuse_argument(call, 0, value, "an element of the card");
    const Paint wanted = paint(call, arguments);
    arguments.end("a colour");
    paint_element(card, number.value_or(0), wanted);
    return value;
}

// named(element, name [, number]): the element. With a number the name is "name-number".
Value named(const Call& call) {
    if (call.in.as_2008()) return call.in.heap.nil();
    Card& card = card_of(call);
    const auto number = hidden_number(call, call.arguments[0], kElementNumber);
    if (!number) refuse_argument(call, 0, call.arguments[0], "an element of the card");
    if (call.arguments[1]->type != Type::text) {
        refuse_argument(call, 1, call.arguments[1], "its name, a text,");
    }
    std::string name = call.arguments[1]->text;
    const bool numbered = call.arguments.size() > 2;
    if (numbered) {
        const Value& value = call.arguments[2];
        const double count = value->number;
        if (value->type != Type::number || !(std::abs(count) < 1e9) || count != std::floor(count)) {
            refuse_argument(call, 2, value, "a whole number, which is joined to the name,");
        }
        name += fmt::format("-{:.0f}", count);
    }
    if (const auto refusal = name_element(card, number.value_or(0), name, numbered)) {
        refuse(call, *refusal);
    }
    return call.arguments[0];
}

// drawline(where, points… [, thickness] [, colour])
Value draw_line(const Call& call) {
    if (call.in.as_2008()) return call.in.heap.nil();
    Card& card = card_of(call);
    NewLine wanted;
    wanted.place = call.in.program_place(call.place);
    Arguments arguments(call);
    const Value& where = arguments.take();
    if (where->type == Type::number) {
        const double page = where->number;
        wanted.page = page >= 0.0 && page <= card.glued ? static_cast<int>(page) : -1;
        if (wanted.page != page) {
            const std::string pages =
                card.glued == 0 ? "only page 0" : fmt::format("pages 0 to {}", card.glued);
            refuse(call, {fmt::format("is to draw on page {}, and the card has {} so far",
                                      fmt::format("{:.6g}", page), pages),
                          "page 0 is the base page; each glued element adds one, its .page"});
        }
    } else if (const auto number = hidden_number(call, where, kElementNumber)) {
        wanted.page = card.pages[*number];
    } else if (const auto fold = hidden_number(call, where, kFoldNumber)) {
        wanted.fold = fold;
    } else {
        refuse_argument(call, 0, where, "the card, an element, a fold or a page's number");
    }
    wanted.points = arguments.take_points();
    bool colored = false;
    bool thick = false;
    while (arguments.more() && !(thick && colored)) {
        if (const auto thickness = thick ? std::nullopt : arguments.take_number()) {
            wanted.thickness_pt = *thickness;
            thick = true;
            continue;
        }
        if (colored || !arguments.next_is(Type::text)) break;
        const std::vector<Color> colors = arguments.take_colors();
        if (colors.size() > 1) refuse(call, {"has more than one colour"});
        wanted.color = colors.front();
        colored = true;
    }
    arguments.end(thick && colored ? "nothing more"
                  : thick          ? "a colour"
                  : colored        ? "a thickness, in points of 1/72 inch,"
                                   : "a point [x, y], a thickness in points of 1/72 inch or a colour",
                  "points come first, then one thickness and one colour");
    if (const auto refusal = add_line(card, wanted)) refuse(call, *refusal);
    return call.in.heap.nil();
}

// What a row's builtin is called: its name, of which each hyphen is "_" or left out.
std::vector<std::string> names_of(std::string_view element) {
    std::vector<std::string> names{""};
    for (const char c : element) {
        const std::size_t count = names.size();
        for (std::size_t i = 0; i < count; ++i) {
            if (c == '-') names.push_back(names[i]);
            names[i] += c == '-' ? '_' : c;
        }
    }
    return names;
}

struct Rows {
    std::deque<std::string> names;  // stay where they are
    std::vector<Builtin> rows;

    Rows() {
        rows.push_back(
            {"popup", 0, 4, popup_card, nullptr,
             "popup(), popup(width, height), popup(width, height, left, right): begins a card, in inches, "
             "with the colours of its halves; the gutter is its .gutter"});
        rows.push_back({"named", 2, 3, named, nullptr,
                        "named(element, name), named(element, name, number): gives an element its id"});
        rows.push_back({"painted", 2, 5, painted, nullptr,
                        "painted(element, left, right, left tab, right tab): gives an element its colours"});
        rows.push_back({"drawline", 1, -1, draw_line, nullptr,
                        "drawline(where, [x, y], [x, y], ..., thickness, colour): prints a line on a page, "
                        "an element or "
                        "beside a fold"});
        for (const ElementInfo& info : element_table()) {
            std::vector<std::string> spellings = names_of(info.name);
            for (const std::string_view also : info.also) {
                for (std::string& name : names_of(also)) spellings.push_back(std::move(name));
            }
            for (std::string& name : spellings) {
                names.push_back(std::move(name));
                rows.push_back({names.back(), 1, -1, element, &info, info.about});
            }
        }
    }
};

}  // namespace

std::span<const Builtin> card_builtins() {
    static const Rows rows;
    return rows.rows;
}

}  // namespace popup::flatlang
