#include "edit/session.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "base/text/nearest.h"
#include "input/color.h"
#include "input/text.h"
#include "input/xml/number.h"
#include "input/xml/path_text.h"
#include "input/xml/units.h"
#include "mechanism/given_points.h"

namespace popup::edit {
namespace {

// What a document of six decimals can tell apart.
constexpr double kWritten = 0.5e-6;
// What is drawn is measured by points of six decimals: it moves by less than this without being meant to.
constexpr double kDrawnMm = 1e-5;

// Whether a path lies where another one does, as far as anybody can tell.
bool same_place(const DrawnPath& a, const DrawnPath& b) {
    const auto near = [](Vec2 p, Vec2 q) { return distance(p, q) <= kDrawnMm; };
    const auto same_step = [&](const PathStep& p, const PathStep& q) {
        return p.curve == q.curve && near(p.to, q.to) &&
               (!p.curve || (near(p.control_1, q.control_1) && near(p.control_2, q.control_2)));
    };
    return std::equal(a.path.subpaths().begin(), a.path.subpaths().end(), b.path.subpaths().begin(),
                      b.path.subpaths().end(), [&](const Subpath& p, const Subpath& q) {
                          return near(p.start, q.start) &&
                                 std::equal(p.steps.begin(), p.steps.end(), q.steps.begin(), q.steps.end(),
                                            same_step);
                      });
}

// In place of a value: it is taken out, and what holds when none is given holds again.
constexpr std::string_view kNone = "none";

struct Measured {
    double value = 0.0;
    std::string_view unit;
};

// A number, and what stands behind it.
std::optional<Measured> number_and_unit(std::string_view text) {
    text = trimmed(text);
    std::size_t end = text.size();
    while (end > 0 && (text[end - 1] < '0' || text[end - 1] > '9') && text[end - 1] != '.') --end;
    const xml::ParsedNumber number = xml::parse_number(text.substr(0, end));
    if (number.fault != xml::NumberFault::none) return std::nullopt;
    return Measured{number.value, trimmed(text.substr(end))};
}

}  // namespace

const std::string* Command::find(std::string_view name) const {
    const auto found =
        std::find_if(options.begin(), options.end(), [&](const auto& o) { return o.first == name; });
    return found == options.end() ? nullptr : &found->second;
}

bool Session::fail(std::string_view code, std::string what, std::string hint) {
    Diagnostic& error = said_.error(code, place, std::move(what));
    if (!hint.empty()) error.hint(std::move(hint));
    return false;
}

void Session::remark(std::string_view code, std::string what, std::string hint) {
    said_.remark(code, place, std::move(what)).hint(std::move(hint));
}

std::optional<std::size_t> Session::find(std::string_view id) {
    std::vector<std::string_view> ids;
    for (std::size_t n = 0; n < design.structures.size(); ++n) {
        if (design.structures[n].id == id) return n;
        ids.push_back(design.structures[n].id);
    }
    const std::vector<std::string> near = nearest(id, ids, 1);
    fail("no-such-element", fmt::format("there is no element \"{}\"", shown(std::string(id))),
         near.empty() ? std::string("popupc show lists the elements of a card")
                      : fmt::format("perhaps \"{}\" is meant", near.front()));
    return std::nullopt;
}

void Session::look() {
    card_ = folds_of_card(design, tolerances_);
    touched_.clear();
    if (is_as_read_) owners_ = owners_of(*card_);
}

const CardFolds& Session::card() {
    if (!card_ || !touched_.empty()) look();
    return *card_;
}

const Standing& Session::standing(std::size_t n) {
    bool stale = !card_ || n >= card_->standing.size();
    for (std::size_t at = n; !stale && card_->standing[at].owner;) {
        at = *card_->standing[at].owner;
        stale = touched_.contains(at);
    }
    if (stale) look();
    return card_->standing[n];
}

void Session::take_out(std::size_t n) {
    Structure& structure = design.structures[n];
    structure.dropped = true;
    close_up_pages(design);
    // Numbers that names of others begin with, and that would become other ones, are theirs from now on.
    for (const Structure& other : design.structures) {
        if (other.dropped || !other.named().owner || *other.named().owner < n) continue;
        Structure& owner = design.structures[*other.named().owner];
        if (!owner.id_given) owner.id_given = owner.id_changed = true;
    }
    if (!structure.added) gone.push_back(structure.tag_text);
    design.structures.erase(design.structures.begin() + static_cast<std::ptrdiff_t>(n));
    for (Structure& other : design.structures) {
        std::optional<std::size_t>& owner = other.named().owner;
        if (owner && *owner > n) --*owner;
    }
    forget();
}

void Session::need_version(std::string_view version) {
    if (design.version >= version) return;
    design.version = version;
    design.version_changed = true;
}

const ElementInfo& Session::info_of(const Structure& structure) {
    const ElementInfo* info = find_element(structure.type);
    POPUP_INVARIANT(info != nullptr);
    return *info;
}

std::vector<Vec2> Session::points_of(const Structure& structure) {
    std::vector<Vec2> points;
    for (const DesignPoint& point : structure.points) points.push_back(point.at);
    return points;
}

std::vector<Vec2> Session::points_of(const Structure& structure, const PageFold& seen) {
    return points_seen(structure, info_of(structure), seen);
}

void Session::on_pages(const Structure& structure, const PageFold& seen, std::vector<Vec2>& points) {
    points_as_given(structure, info_of(structure), seen, points);
}

void Session::take_arguments(Structure& structure, std::vector<Argument> arguments) {
    for (std::size_t i = 0; i < std::min(structure.arguments.size(), arguments.size()); ++i) {
        const auto* was = std::get_if<DrawnPath>(&structure.arguments[i].value);
        const auto* is = std::get_if<DrawnPath>(&arguments[i].value);
        if (was != nullptr && is != nullptr && same_place(*was, *is)) arguments[i] = structure.arguments[i];
    }
    structure.arguments = std::move(arguments);
}

bool Session::write(std::size_t n, const Shaped& shaped) {
    Structure& structure = design.structures[n];
    for (std::size_t i = 0; i < shaped.points.size(); ++i) {
        DesignPoint& point = structure.points[i];
        if (distance(point.at, shaped.points[i]) <= kWritten * design.unit.mm) continue;
        point.at = shaped.points[i];
        point.changed = true;
    }
    for (std::size_t i = 0; i < shaped.arguments.size(); ++i) {
        const Argument& argument = shaped.arguments[i];
        if (i < structure.arguments.size()) {
            const auto* was = std::get_if<DrawnPath>(&structure.arguments[i].value);
            const auto* is = std::get_if<DrawnPath>(&argument.value);
            if (was != nullptr && is != nullptr && same_place(*was, *is)) continue;
        }
        const bool is_new =
            argument.changed && !(i < structure.arguments.size() && structure.arguments[i].changed);
        if (is_new && !argument.text.present() && argument.tag_text.present()) {
            return fail("bad-edit",
                        fmt::format("the {} of \"{}\" is drawn in a file, which an edit leaves as it is",
                                    info_of(structure).parameters[i].name, structure.id),
                        "change x, y, width and height of the outline in the document");
        }
        if (argument.changed) structure.argument(i) = argument;
    }
    touch(n);
    return true;
}

std::optional<double> Session::length(std::string_view name, std::string_view text) {
    const auto read = number_and_unit(text);
    const Unit* unit = &design.unit;
    if (read && !read->unit.empty()) unit = xml::find_unit(read->unit);
    if (read && unit != nullptr && std::abs(read->value * unit->mm) <= kReachMm)
        return read->value * unit->mm;
    fail("bad-edit", fmt::format("{} takes a length, not '{}'", name, shown(std::string(text))),
         fmt::format("write 5, or with a unit 5mm, 0.5cm or 0.2in; without one it is in the document's, {}",
                     design.unit.name));
    return std::nullopt;
}

std::optional<double> Session::angle(std::string_view name, std::string_view text) {
    const auto read = number_and_unit(text);
    if (read && (read->unit.empty() || read->unit == "deg" || read->unit == "°") &&
        std::abs(read->value) <= 3600.0)
        return read->value;
    fail("bad-edit", fmt::format("{} takes an angle in degrees, not '{}'", name, shown(std::string(text))));
    return std::nullopt;
}

std::optional<Vec2> Session::point(std::string_view name, std::string_view text) {
    const std::size_t comma = text.find(',');
    if (comma == std::string_view::npos) {
        fail("bad-edit",
             fmt::format("{} takes a point such as 12,30, not '{}'", name, shown(std::string(text))));
        return std::nullopt;
    }
    const auto x = length(name, text.substr(0, comma));
    const auto y = x ? length(name, text.substr(comma + 1)) : std::nullopt;
    if (!x || !y) return std::nullopt;
    return Vec2{*x, *y};
}

std::optional<int> Session::count(std::string_view name, std::string_view text, int least, int most) {
    const auto read = number_and_unit(text);
    if (read && read->unit.empty() && read->value == std::floor(read->value) && read->value >= least &&
        read->value <= most)
        return static_cast<int>(read->value);
    fail("bad-edit", fmt::format("{} takes a whole number from {} to {}, not '{}'", name, least, most,
                                 shown(std::string(text))));
    return std::nullopt;
}

bool Session::set_parameter(Structure& structure, const ElementInfo& info, std::size_t number,
                            const std::string& text) {
    const ParameterInfo& parameter = info.parameters[number];
    Argument& argument = structure.argument(number);
    if (text == kNone &&
        std::find(parameter.words.begin(), parameter.words.end(), kNone) == parameter.words.end()) {
        if (parameter.required)
            return fail("bad-edit",
                        fmt::format("{} must have a {}", with_article(info.name), parameter.name));
        argument.changed = argument.changed || argument.given();
        argument.value = std::monostate();
        return true;
    }
    switch (parameter.kind) {
        case ParameterKind::colour: {
            const auto color = parse_color(text);
            if (!color) {
                const std::string near = nearest_color_name(text);
                return fail("bad-edit",
                            fmt::format("{} takes a colour, not '{}'", parameter.name, shown(text)),
                            near.empty() ? "write #ffcc00, or a colour's name in CSS such as gold"
                                         : fmt::format("perhaps '{}' is meant", near));
            }
            argument.value = *color;
            break;
        }
        case ParameterKind::length:
        case ParameterKind::number: {
            const bool is_length = parameter.kind == ParameterKind::length;
            const auto value = is_length ? length(parameter.name, text) : angle(parameter.name, text);
            if (!value) return false;
            const double unit = is_length ? design.unit.mm : 1.0;
            if (*value < parameter.least || *value > parameter.most) {
                return fail("bad-edit", fmt::format("{} is {}{}, and must be from {} to {}", parameter.name,
                                                    xml::format_number(*value / unit),
                                                    is_length ? " " + std::string(design.unit.name) : "",
                                                    xml::format_number(parameter.least / unit),
                                                    xml::format_number(parameter.most / unit)));
            }
            argument.value = *value;
            break;
        }
        case ParameterKind::choice: {
            if (std::find(parameter.words.begin(), parameter.words.end(), text) == parameter.words.end()) {
                return fail("bad-edit", fmt::format("{} is one of {}, not '{}'", parameter.name,
                                                    fmt::join(parameter.words, ", "), shown(text)));
            }
            argument.value = text;
            break;
        }
        case ParameterKind::path: {
            DrawnPath path;
            if (const auto refusal = xml::read_path(text, design.unit, path)) {
                return fail("bad-edit", fmt::format("the path data of {} {}", parameter.name, refusal->what));
            }
            path.text = text;
            argument.value = std::move(path);
            break;
        }
        case ParameterKind::points:
            return fail("bad-edit", fmt::format("{} are changed in the document itself", parameter.name),
                        "an outline may stand in their place: --outline 'M …'");
    }
    argument.changed = true;
    need_version(version_needed(info, structure.arguments));
    return true;
}

bool Session::set_value(std::size_t n, std::string_view name, const std::string& text,
                        std::vector<double>& measures, bool& measured) {
    Structure& structure = design.structures[n];
    const ElementInfo& info = info_of(structure);
    if (const auto number = find_measure(info, name)) {
        const MeasureInfo& measure = info.measures[*number];
        std::optional<double> value;
        switch (measure.kind) {
            case MeasureKind::length:
                value = length(measure.name, text);
                break;
            case MeasureKind::angle:
                value = angle(measure.name, text);
                break;
            case MeasureKind::choice: {
                const auto word = std::find(measure.words.begin(), measure.words.end(), text);
                if (word != measure.words.end()) {
                    value = static_cast<double>(word - measure.words.begin());
                } else {
                    fail("bad-edit", fmt::format("{} is one of {}, not '{}'", measure.name,
                                                 fmt::join(measure.words, ", "), shown(text)));
                }
                break;
            }
        }
        if (!value) return false;
        // What has a size when it is new has one. A document may have it the other way round already.
        const bool is_size = measure.share > 0.0 || measure.standard > 0.0;
        if (is_size && *value <= 0.0 && measures[*number] > 0.0) {
            const bool is_length = measure.kind == MeasureKind::length;
            return fail("bad-edit",
                        fmt::format("{} is {}{}, and must be more than 0", measure.name,
                                    xml::format_number(*value / (is_length ? design.unit.mm : 1.0)),
                                    is_length ? " " + std::string(design.unit.name) : "°"));
        }
        constexpr double kStraightDeg = 180.0;
        if (is_size && measure.kind == MeasureKind::angle && *value >= kStraightDeg) {
            return fail("bad-edit", fmt::format("{} is {}°, and must be less than 180°", measure.name,
                                                xml::format_number(*value)));
        }
        measures[*number] = *value;
        measured = true;
        return true;
    }
    std::string plain;
    for (const char c : name) {
        if (c != '-' && c != '_') plain += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    }
    if (const auto number = find_parameter(info, plain)) return set_parameter(structure, info, *number, text);
    std::vector<std::string_view> names;
    for (const MeasureInfo& measure : info.measures) names.push_back(measure.name);
    for (const ParameterInfo& parameter : info.parameters) names.push_back(parameter.name);
    const std::vector<std::string> near = nearest(plain, names, 1);
    return fail("bad-edit", fmt::format("{} has no {}", with_article(info.name), shown(std::string(name))),
                near.empty() ? fmt::format("it has {}", fmt::join(names, ", "))
                             : fmt::format("perhaps {} is meant", near.front()));
}

std::string with_article(std::string_view kind) {
    constexpr std::string_view kVowels = "aeio";
    return fmt::format("{} {}", kVowels.find(kind.front()) != std::string_view::npos ? "an" : "a", kind);
}

}  // namespace popup::edit
