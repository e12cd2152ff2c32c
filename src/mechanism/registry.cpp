// The table of elements, and how rows, parameters and arguments are found in it.
#include <algorithm>
#include <array>
#include <charconv>
#include <string>

#include "mechanism/rows.h"

namespace popup {
namespace {

// Names are compared without regard to case, `_` and `-`.
std::string plain(std::string_view text) {
    std::string out;
    for (const char c : text) {
        if (c == '_' || c == '-') continue;
        out += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    }
    return out;
}

struct Table {
    std::span<const ElementRow> rows;
    std::vector<ElementInfo> infos;

    explicit Table(std::span<const ElementRow> all) : rows(all) {
        for (const ElementRow& row : all) infos.push_back(row.info);
    }
};

const Table& whole_table() {
#define POPUP_ELEMENT(row) row,
    static const std::vector<ElementRow> rows{
#include "mechanism/elements.inc"
    };
#undef POPUP_ELEMENT
    static const Table table(rows);
    return table;
}

std::optional<Table>& table_for_test() {
    static std::optional<Table> table;
    return table;
}

const Table& table() { return table_for_test() ? *table_for_test() : whole_table(); }

const Argument& argument_of(const Element& element, std::string_view name) {
    const auto number = find_parameter(*element.info, name);
    POPUP_INVARIANT(number && *number < element.arguments.size());
    return element.arguments[*number];
}

}  // namespace

RowsForTest::RowsForTest(std::span<const ElementRow> rows) { table_for_test().emplace(rows); }
RowsForTest::~RowsForTest() { table_for_test().reset(); }

std::span<const ElementRow> element_rows() { return table().rows; }

std::span<const ElementInfo> element_table() { return table().infos; }

const ElementInfo* find_element(std::string_view name_or_code) {
    // As the rows have it, which is how designs name their elements.
    for (const ElementInfo& info : element_table()) {
        if (info.name == name_or_code) return &info;
    }
    int code = -1;
    const char* end = name_or_code.data() + name_or_code.size();
    const auto parsed = std::from_chars(name_or_code.data(), end, code);
    const bool number = parsed.ec == std::errc() && parsed.ptr == end && code >= 0;
    const std::string name = plain(name_or_code);
    for (const ElementInfo& info : element_table()) {
        if (number ? info.code == code
                   : plain(info.name) == name ||
                         std::any_of(info.also.begin(), info.also.end(),
                                     [&](std::string_view also) { return plain(also) == name; }))
            return &info;
    }
    return nullptr;
}

const ElementRow& element_row(const ElementInfo& info) {
    const auto rows = element_rows();
    const auto row =
        std::find_if(rows.begin(), rows.end(), [&](const ElementRow& r) { return r.info.name == info.name; });
    POPUP_INVARIANT(row != rows.end());
    return *row;
}

std::optional<std::size_t> find_parameter(const ElementInfo& info, std::string_view name) {
    const auto found = std::find_if(info.parameters.begin(), info.parameters.end(),
                                    [&](const ParameterInfo& p) { return p.name == name; });
    if (found == info.parameters.end()) return std::nullopt;
    return static_cast<std::size_t>(found - info.parameters.begin());
}

std::optional<std::size_t> find_measure(const ElementInfo& info, std::string_view name) {
    const std::string wanted = plain(name);
    const auto found = std::find_if(info.measures.begin(), info.measures.end(),
                                    [&](const MeasureInfo& m) { return m.name == wanted; });
    if (found == info.measures.end()) return std::nullopt;
    return static_cast<std::size_t>(found - info.measures.begin());
}

std::string fold_name(std::string_view id, const FoldInfo& fold) {
    return std::string(id) + "." + std::string(fold.name);
}

std::string plate_name(std::string_view id, const PlateInfo& plate) {
    return std::string(id) + "." + std::string(plate.name);
}

std::optional<FoundName> find_fold_name(const ElementInfo& info, std::string_view id, std::string_view word) {
    const std::string wanted = plain(word);
    for (std::size_t i = 0; i < info.folds.size(); ++i) {
        const FoldInfo& fold = info.folds[i];
        if (wanted == fold.name || (is_seam(info, fold) && wanted == std::string(fold.name) + "seam"))
            return FoundName{i, fold_name(id, fold)};
    }
    return std::nullopt;
}

std::optional<FoundName> find_plate_name(const ElementInfo& info, std::string_view id,
                                         std::string_view word) {
    const std::string wanted = plain(word);
    for (std::size_t i = 0; i < info.plates.size(); ++i) {
        if (wanted == info.plates[i].name) return FoundName{i, plate_name(id, info.plates[i])};
    }
    return std::nullopt;
}

std::string_view version_needed(const ElementInfo& info, std::span<const Argument> arguments) {
    std::string_view needed = info.since;
    for (std::size_t i = 0; i < arguments.size() && i < info.parameters.size(); ++i) {
        if (arguments[i].given()) needed = std::max(needed, info.parameters[i].since);
    }
    return needed;
}

const Argument* find_argument(const ElementInfo& info, std::span<const Argument> arguments,
                              std::string_view name) {
    const auto number = find_parameter(info, name);
    return number && *number < arguments.size() && arguments[*number].given() ? &arguments[*number] : nullptr;
}

std::optional<Color> color_of(const Structure& structure, std::string_view parameter) {
    const ElementInfo* info = find_element(structure.type);
    const Argument* found = info ? find_argument(*info, structure.arguments, parameter) : nullptr;
    return found ? std::optional(std::get<Color>(found->value)) : std::nullopt;
}

std::optional<Color> color_of(const Element& element, std::string_view name) {
    const Argument& argument = argument_of(element, name);
    return argument.given() ? std::optional(std::get<Color>(argument.value)) : std::nullopt;
}

double number_of(const Element& element, std::string_view name) {
    const Argument& argument = argument_of(element, name);
    if (argument.given()) return std::get<double>(argument.value);
    return element.info->parameters[*find_parameter(*element.info, name)].standard;
}

std::string_view choice_of(const Element& element, std::string_view name) {
    const Argument& argument = argument_of(element, name);
    if (argument.given()) return std::get<std::string>(argument.value);
    return element.info->parameters[*find_parameter(*element.info, name)].words.front();
}

std::span<const Polygon> areas_of(const Element& element, std::string_view name) {
    const Argument& argument = argument_of(element, name);
    if (!argument.given()) return {};
    return std::get<DrawnPath>(argument.value).inside.areas;
}

double snap_path(Element& element, std::string_view name, std::span<const Vec2> to, double within) {
    const auto number = find_parameter(*element.info, name);
    POPUP_INVARIANT(number && *number < element.arguments.size());
    Argument& argument = element.arguments[*number];
    DrawnPath snapped = std::get<DrawnPath>(argument.value);
    const std::vector<Segment> moves = snapped.path.snap(to, within);
    double most = 0.0;
    for (const Segment& move : moves) most = std::max(most, distance(move.a, move.b));
    if (most == 0.0 || enclose(snapped.path, snapped.inside) != FlatteningFault::none) return 0.0;
    snapped.moved = true;
    argument.value = std::move(snapped);
    if (most > element.tolerances->rounding_mm) argument.changed = true;
    for (const Segment& move : moves) {
        if (distance(move.a, move.b) > element.tolerances->rounding_mm) element.snapped.push_back(move);
    }
    return most;
}

std::span<const FlatCurve> curves_of(const Element& element, std::string_view name) {
    const Argument& argument = argument_of(element, name);
    if (!argument.given()) return {};
    return std::get<DrawnPath>(argument.value).inside.curves;
}

}  // namespace popup
