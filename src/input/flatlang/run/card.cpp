#include "input/flatlang/run/card.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "input/color.h"
#include "input/design_limits.h"
#include "input/text.h"
#include "input/xml/path_text.h"
#include "input/xml/read.h"

namespace popup::flatlang {
namespace {

std::string inches(double mm) { return fmt::format("{:.6g}", mm / 25.4); }

Vec2 mirrored(Vec2 p) { return {-p.x, p.y}; }

// A place beside a fold, on the page of its left or of its right side.
Vec2 on_page(const Segment& fold, Vec2 at) {
    const Vec2 along = unit(fold.b - fold.a);
    return lerp(fold.a, fold.b, 0.5) + at.y * along + at.x * right_of(along);
}

DesignPoint design_point(Vec2 at, Place place) {
    DesignPoint point;
    point.at = at;
    point.place = place;
    return point;
}

bool within_limits(Vec2 p) { return std::abs(p.x) <= kCoordinateLimit && std::abs(p.y) <= kCoordinateLimit; }

std::optional<Refusal> too_far(const std::vector<Vec2>& points) {
    for (const Vec2 p : points) {
        if (within_limits(p)) continue;
        if (std::isnan(p.x) || std::isnan(p.y))
            return Refusal{"has a point whose coordinate is not a number"};
        return Refusal{fmt::format("has the point [{}, {}]; coordinates are at most {} inches", inches(p.x),
                                   inches(p.y), inches(kCoordinateLimit))};
    }
    return std::nullopt;
}

std::optional<Refusal> count_points(Card& card, std::size_t more) {
    card.points += more;
    if (card.points <= kPointsLimit) return std::nullopt;
    return Refusal{
        fmt::format("would be the card's {}th point, and it can have {}", kPointsLimit + 1, kPointsLimit)};
}

// Its partner comes before it in the row: it may be left out.
bool is_mirror(const ElementInfo& info, std::size_t point) {
    return info.points[point].side == 'R' && info.partners[point] >= 0 &&
           static_cast<std::size_t>(info.partners[point]) != point;
}

// All points in the row's order.
std::optional<std::vector<Vec2>> all_points(const ElementInfo& info, const std::vector<Vec2>& given) {
    if (given.size() == info.points.size()) return given;
    if (given.size() != points_without_mirrored(info)) return std::nullopt;
    std::vector<Vec2> all(info.points.size());
    std::size_t next = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (!is_mirror(info, i)) all[i] = given[next++];
    }
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (is_mirror(info, i)) all[i] = mirrored(all[static_cast<std::size_t>(info.partners[i])]);
    }
    return all;
}

Refusal wrong_count(const ElementInfo& info, std::size_t given) {
    const std::size_t fewest = points_without_mirrored(info);
    std::string least;
    for (std::size_t i = 0; i < info.points.size(); ++i) {
        if (!is_mirror(info, i)) least += (least.empty() ? "" : ", ") + std::string(info.points[i].letter);
    }
    Refusal refusal{fmt::format("has {} points, {}, and {} {} given", info.points.size(), letters_of(info),
                                given, given == 1 ? "is" : "are")};
    if (info.grounds.plate) {
        refusal.hint = "before them comes a point of the plate it stands on";
    } else if (fewest < info.points.size()) {
        refusal.hint =
            fmt::format("of an even one give {} alone: the right side then mirrors the left", least);
    }
    return refusal;
}

// A value for one parameter, in its limits.
std::optional<Refusal> give_value(Argument& argument, const ParameterInfo& parameter,
                                  const std::variant<double, std::string>& value) {
    if (const double* number = std::get_if<double>(&value)) {
        argument.value = *number;
        if (*number >= parameter.least && *number <= parameter.most) return std::nullopt;
        const double unit = parameter.kind == ParameterKind::length ? 25.4 : 1.0;
        const std::string_view name = parameter.kind == ParameterKind::length ? " inches" : "";
        return Refusal{fmt::format("has {:.6g}{} as {}, which must be from {:.6g} to {:.6g}", *number / unit,
                                   name, parameter.name, parameter.least / unit, parameter.most / unit)};
    }
    const std::string& text = std::get<std::string>(value);
    if (parameter.kind == ParameterKind::choice) {
        argument.value = text;
        return std::nullopt;
    }
    if (parameter.kind == ParameterKind::colour) {
        argument.value = parse_color(text).value();
        return std::nullopt;
    }
    DrawnPath path;
    const auto refusal = xml::read_path(text, Unit{}, path);
    argument.value = std::move(path);
    if (!refusal) return std::nullopt;
    return Refusal{fmt::format("has path data as {} that {}", parameter.name, refusal->what)};
}

// True when the parameter is what such a value can be.
bool takes(const ParameterInfo& parameter, const std::variant<double, std::string>& value) {
    if (std::holds_alternative<double>(value))
        return parameter.kind == ParameterKind::length || parameter.kind == ParameterKind::number;
    const std::string& text = std::get<std::string>(value);
    if (parameter.kind == ParameterKind::choice)
        return std::find(parameter.words.begin(), parameter.words.end(), text) != parameter.words.end();
    if (parameter.kind == ParameterKind::colour) return parse_color(text).has_value();
    return parameter.kind == ParameterKind::path && is_path_data(text);
}

std::string shown_value(const std::variant<double, std::string>& value) {
    const auto* number = std::get_if<double>(&value);
    return number ? fmt::format("{:.6g}", *number)
                  : fmt::format("\"{}\"", shown(std::get<std::string>(value)));
}

// What a parameter takes, in words.
std::string wanted_of(const ParameterInfo& parameter) {
    switch (parameter.kind) {
        case ParameterKind::colour:
            return "a colour";
        case ParameterKind::length:
            return "a length in inches";
        case ParameterKind::number:
            return "a number";
        case ParameterKind::choice:
            return fmt::format("one of {}", fmt::join(parameter.words, ", "));
        case ParameterKind::path:
            return "path data";
        case ParameterKind::points:
            break;
    }
    return "points";
}

// The parameter that a value is for: the one that is named, or the first that takes it and has none. Colours
// have an order of their own, for Paint.
std::variant<std::size_t, Refusal> parameter_of(Structure& made, const ElementInfo& info,
                                                const NewValue& one) {
    if (!one.parameter.empty()) {
        const std::size_t i = find_parameter(info, one.parameter).value();
        if (takes(info.parameters[i], one.value)) return i;
        return Refusal{fmt::format("is given {} as {}, where {} is expected", shown_value(one.value),
                                   one.parameter, wanted_of(info.parameters[i]))};
    }
    for (std::size_t i = 0; i < info.parameters.size(); ++i) {
        if (info.parameters[i].kind != ParameterKind::colour && !made.argument(i).given() &&
            takes(info.parameters[i], one.value))
            return i;
    }
    return Refusal{fmt::format("is given {}, which none of its parameters takes", shown_value(one.value))};
}

std::optional<Refusal> give_values(Structure& made, const ElementInfo& info, const NewElement& wanted) {
    for (const NewValue& one : wanted.values) {
        const auto found = parameter_of(made, info, one);
        if (const auto* refusal = std::get_if<Refusal>(&found)) return *refusal;
        const std::size_t i = std::get<std::size_t>(found);
        made.argument(i).place = wanted.place;
        if (auto refusal = give_value(made.argument(i), info.parameters[i], one.value)) return refusal;
    }
    for (std::size_t i = 0; i < info.parameters.size(); ++i) {
        const bool missing = info.parameters[i].required && !made.argument(i).given();
        if (missing) return Refusal{fmt::format("has no {}", info.parameters[i].name)};
    }
    return std::nullopt;
}

// What is drawn on the page of the fold was given beside it, and with its points in between.
std::optional<Refusal> place_values(Structure& made, const ElementInfo& info, const NewElement& wanted,
                                    const PageFold& fold) {
    if (wanted.plate || wanted.page) return std::nullopt;
    if (info.points.empty() && !wanted.points.empty()) {
        const auto list = std::find_if(info.parameters.begin(), info.parameters.end(), [](const auto& one) {
            return one.kind == ParameterKind::points && one.page == PointPage::fold;
        });
        if (list == info.parameters.end()) return wrong_count(info, wanted.points.size());
        std::vector<DesignPoint> points;
        for (const Vec2 p : wanted.points)
            points.push_back(design_point(on_page(fold.on_left, p), wanted.place));
        made.argument(static_cast<std::size_t>(list - info.parameters.begin())).value = std::move(points);
    }
    if (!info.grounds.found) return std::nullopt;
    for (Argument& argument : made.arguments) {
        auto* drawn = std::get_if<DrawnPath>(&argument.value);
        if (drawn == nullptr) continue;
        drawn->path = drawn->path.mapped([&](Vec2 p) { return on_page(fold.on_left, p); });
        drawn->moved = true;
        if (enclose(drawn->path, drawn->inside) != FlatteningFault::none)
            return Refusal{"has path data that leads too far out"};
    }
    return std::nullopt;
}

// The fold it stands on, or a line of the plate; written into the structure.
PageFold ground_of(const Card& card, const NewElement& wanted, Structure& made) {
    if (wanted.page) {
        made.finds_ground = true;
        made.fold.page = *wanted.page;
        const Segment up{{0, 0}, {0, 1}};
        return {*wanted.page, *wanted.page, up, up, false, 0};
    }
    if (wanted.plate) {
        ParentPlate& plate = made.plate.emplace();
        plate.page = wanted.plate->page;
        plate.place = wanted.place;
        plate.at = design_point(wanted.plate->at, wanted.place);
        const Segment up{plate.at.at, plate.at.at + Vec2{0, 1}};
        return {plate.page, plate.page, up, up, false, 0};
    }
    const PageFold& fold = card.folds[wanted.fold];
    made.fold.page = fold.left_page;
    made.fold.begin = design_point(fold.on_left.a, wanted.place);
    made.fold.end = design_point(fold.on_left.b, wanted.place);
    return fold;
}

}  // namespace

bool is_path_data(std::string_view text) {
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    if (first == std::string_view::npos || (text[first] != 'M' && text[first] != 'm')) return false;
    const std::size_t next = text.find_first_not_of(" \t\r\n", first + 1);
    return next != std::string_view::npos &&
           std::string_view("+-.0123456789").find(text[next]) != std::string_view::npos;
}

std::size_t points_without_mirrored(const ElementInfo& info) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < info.points.size(); ++i) count += is_mirror(info, i) ? 0 : 1;
    return count;
}

std::string letters_of(const ElementInfo& info) {
    std::string text;
    PointPage page = PointPage::fold;
    for (const PointInfo& point : info.points) {
        if (!text.empty()) text += ", ";
        if (point.page != page) text += "and on its own page ";
        page = point.page;
        text += point.letter;
        if (point.side != '-') text += point.side == 'L' ? " (left)" : " (right)";
    }
    return text;
}

std::optional<Refusal> begin_card(Card& card, const NewCard& wanted) {
    for (const auto& [name, size] : {std::pair{"wide", wanted.width_mm}, {"high", wanted.height_mm}}) {
        if (size >= kSmallestPage && size <= kLargestPage) continue;
        return Refusal{fmt::format("is {} inches {}, and must be from {} to {}", inches(size), name,
                                   inches(kSmallestPage), inches(kLargestPage))};
    }
    Design& design = card.design.emplace();
    design.width_mm = wanted.width_mm;
    design.height_mm = wanted.height_mm;
    design.left = wanted.left;
    design.right = wanted.right;
    design.page_place = card.place = wanted.place;
    const Segment gutter{{0, -0.5 * design.height_mm}, {0, 0.5 * design.height_mm}};
    card.folds.push_back({0, 0, gutter, gutter, false, 0});
    return std::nullopt;
}

std::optional<Refusal> add_element(Card& card, const NewElement& wanted, std::optional<std::size_t>& folds) {
    const ElementInfo& info = *wanted.info;
    Design& design = *card.design;
    const bool as_value = info.points.empty();
    const auto beside = all_points(info, as_value ? std::vector<Vec2>() : wanted.points);
    if (!beside) return wrong_count(info, wanted.points.size());
    if (auto refusal = too_far(as_value ? wanted.points : *beside)) return refusal;
    if (design.structures.size() >= kItemsLimit) {
        return Refusal{fmt::format("would be the card's {}th element, and it can have {}", kItemsLimit + 1,
                                   kItemsLimit)};
    }
    if (auto refusal = count_points(card, std::max(beside->size(), wanted.points.size()))) return refusal;

    Structure made;
    made.type = info.name;
    made.place = made.type_place = made.fold.place = wanted.place;
    if (auto refusal = give_values(made, info, wanted)) return refusal;
    const PageFold fold = ground_of(card, wanted, made);
    if (auto refusal = place_values(made, info, wanted, fold)) return refusal;
    if (info.glued) ++card.glued;
    if (const std::string_view needed = version_needed(info, made.arguments); needed > design.version)
        design.version = needed;
    std::vector<Vec2> on_pages;
    for (std::size_t i = 0; i < beside->size(); ++i) {
        const bool right = info.points[i].side == 'R';
        const bool beside_fold = info.points[i].page == PointPage::fold && !wanted.plate;
        const bool extra = info.points[i].page == PointPage::extra;
        const Vec2 at =
            beside_fold ? on_page(right ? fold.on_right : fold.on_left, (*beside)[i]) : (*beside)[i];
        on_pages.push_back(at);
        DesignPoint& point = made.points.emplace_back(design_point(at, wanted.place));
        if (!extra && right && fold.right_page != fold.left_page) point.page = fold.right_page;
    }
    card.pages.push_back(info.glued ? card.glued : fold.left_page);
    design.structures.push_back(std::move(made));
    // Without colours in their order those that are named stay.
    if (wanted.paint.left || wanted.paint.right || wanted.paint.left_tab || wanted.paint.right_tab)
        paint_element(card, design.structures.size() - 1, wanted.paint);

    folds.reset();
    const Structure& added = design.structures.back();
    if (const auto lines = folds_of(info, fold, card.glued, on_pages, added.arguments)) {
        folds = card.folds.size();
        card.folds.insert(card.folds.end(), lines->begin(), lines->end());
    }
    return std::nullopt;
}

std::optional<Refusal> add_line(Card& card, const NewLine& wanted) {
    Design& design = *card.design;
    if (wanted.points.size() < 2) {
        return Refusal{fmt::format("has at least 2 points, and {} {} given", wanted.points.size(),
                                   wanted.points.size() == 1 ? "is" : "are")};
    }
    if (auto refusal = too_far(wanted.points)) return refusal;
    if (!(wanted.thickness_pt >= 0.0 && wanted.thickness_pt <= kThickestLine)) {
        return Refusal{fmt::format("is {:.6g} points thick, and must be from 0 to {:.6g}",
                                   wanted.thickness_pt, kThickestLine)};
    }
    if (design.lines.size() >= kItemsLimit) {
        return Refusal{
            fmt::format("would be the card's {}th line, and it can have {}", kItemsLimit + 1, kItemsLimit)};
    }
    DrawnLine made;
    made.page = wanted.page;
    const Segment* fold_line = nullptr;
    if (wanted.fold) {
        const PageFold& fold = card.folds[*wanted.fold];
        const bool left =
            std::all_of(wanted.points.begin(), wanted.points.end(), [](Vec2 p) { return p.x <= 0.0; });
        const bool right =
            std::all_of(wanted.points.begin(), wanted.points.end(), [](Vec2 p) { return p.x >= 0.0; });
        if (fold.left_page != fold.right_page && !left && !right) {
            return Refusal{"crosses a seam, where one page ends and another begins",
                           "draw what lies on the left (x below 0) and on the right as two lines"};
        }
        const bool on_right = right && !left;
        made.page = on_right ? fold.right_page : fold.left_page;
        fold_line = on_right ? &fold.on_right : &fold.on_left;
    }
    if (auto refusal = count_points(card, wanted.points.size())) return refusal;
    made.thickness_pt = wanted.thickness_pt;
    made.color = wanted.color;
    made.place = wanted.place;
    for (const Vec2 p : wanted.points) {
        made.points.push_back(design_point(fold_line ? on_page(*fold_line, p) : p, wanted.place));
    }
    design.lines.push_back(std::move(made));
    return std::nullopt;
}

void paint_element(Card& card, std::size_t structure, const Paint& paint) {
    Structure& made = card.design->structures[structure];
    const ElementInfo& info = *find_element(made.type);
    for (const auto& [name, color] :
         {std::pair<std::string_view, std::optional<Color>>{"leftcolor", paint.left},
          {"rightcolor", paint.right},
          {"lefttabcolor", paint.left_tab},
          {"righttabcolor", paint.right_tab}}) {
        auto number = find_parameter(info, name);
        // Of an element without halves the first colour is that of its one piece.
        if (!number && name == "leftcolor") number = find_parameter(info, "color");
        if (!number) continue;
        Argument& argument = made.argument(*number);
        argument.value = {};
        if (color) argument.value = *color;
    }
}

std::optional<Refusal> name_element(Card& card, std::size_t structure, const std::string& id, bool numbered) {
    if (!is_id(id)) return Refusal{fmt::format("cannot give the name '{}'", shown(id)), std::string(kIdHint)};
    if (id == kBasePage) return Refusal{"cannot give the name 'page', which is kept for the base page"};
    Structure& made = card.design->structures[structure];
    if (made.id == id) return std::nullopt;
    if (!card.ids.insert(id).second) {
        return Refusal{
            fmt::format("cannot give the name '{}', which another element has", id),
            numbered ? "give each a number of its own, as one that counts on through all calls"
                     : "in a loop or function give a number besides, as in named(house, \"house\", 3) for "
                       "house-3"};
    }
    if (made.id_given) card.ids.erase(made.id);
    made.id = id;
    made.id_given = true;
    return std::nullopt;
}

Design finished(Card card, const Source& source) {
    Design design = std::move(*card.design);
    design.file = source.name;
    design.stem = source.stem();
    xml::name_structures(design);
    return design;
}

}  // namespace popup::flatlang
