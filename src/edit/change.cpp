// Edits of one element: its measures and values, its place, its points.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "edit/session.h"
#include "mechanism/measures.h"

namespace popup::edit {
namespace {

// The measures of an element, on what it stands on; an error where it stands on nothing.
std::optional<std::vector<double>> measures(Session& session, std::size_t n) {
    const Structure& structure = session.design.structures[n];
    const Standing& standing = session.standing(n);
    auto made = measures_of(Session::info_of(structure), standing.seen, 1,
                            Session::points_of(structure, standing.seen), structure.arguments);
    if (made) return made;
    session.fail("bad-edit",
                 fmt::format("\"{}\" has no measures: {}", structure.id,
                             standing.on.empty() ? "nothing is there that it could stand on"
                                                 : "its points are no such element"),
                 "popupc check tells what is wrong with it; points can be given their places one by one");
    return std::nullopt;
}

// Whether each measure that is to change does; an error where one stays: such as the width of an outline, of
// an element that has none.
bool all_change(Session& session, const Structure& structure, const std::vector<double>& was,
                const std::vector<double>& wanted, const std::vector<double>& now) {
    constexpr double kSame = 1e-9;
    const auto measures = Session::info_of(structure).measures;
    for (std::size_t i = 0; i < measures.size(); ++i) {
        const bool stays = std::abs(wanted[i] - was[i]) > kSame && std::abs(now[i] - was[i]) <= kSame;
        if (measures[i].relative || !stays) continue;
        return session.fail("bad-edit",
                            fmt::format("the {} of \"{}\" cannot be set", measures[i].name, structure.id),
                            fmt::format("it is the {}", measures[i].about));
    }
    return true;
}

bool give_measures(Session& session, std::size_t n, const std::vector<double>& values,
                   const std::vector<bool>& given = {}) {
    const Structure& structure = session.design.structures[n];
    const Standing standing = session.standing(n);
    const ElementInfo& info = Session::info_of(structure);
    const std::vector<Vec2> points = Session::points_of(structure, standing.seen);
    auto made = shaped(info, standing.seen, 1, points, structure.arguments, values, given);
    if (!made) {
        return session.fail("bad-edit", fmt::format("no {} has such measures", structure.type),
                            "give widths, lengths and angles above 0");
    }
    const auto was = measures_of(info, standing.seen, 1, points, structure.arguments);
    const auto now = measures_of(info, standing.seen, 1, made->points, made->arguments);
    if (was && now && !all_change(session, structure, *was, values, *now)) return false;
    Session::on_pages(structure, standing.seen, made->points);
    return session.write(n, *made);
}

// The fold as a structure sees it, along the line that the document gives for it where that lies on it. An
// element on a fold that a repair has moved sees that where its author did or, beyond its end there, where it
// is: lines that differ by a little, of which a move along the one must not be taken back along the other.
PageFold fold_as_given(const Structure& structure, PageFold seen, double rounding_mm) {
    if (structure.plate || structure.finds_ground || structure.named().given()) return seen;
    Segment given{structure.fold.begin.at, structure.fold.end.at};
    const bool on_left = structure.fold.page == seen.left_page;
    if ((!on_left && structure.fold.page != seen.right_page) || distance(given.a, given.b) <= 0.0)
        return seen;
    const auto take = [&](Segment& line) {
        if (dot(line.b - line.a, given.b - given.a) < 0.0) std::swap(given.a, given.b);
        const Vec2 along = unit(given.b - given.a);
        const double off =
            std::max(std::abs(cross(along, line.a - given.a)), std::abs(cross(along, line.b - given.a)));
        if (off <= rounding_mm) line = given;
    };
    // A fold that is no seam has one line, on one page.
    if (on_left || !seen.seam) take(seen.on_left);
    if (!on_left || !seen.seam) take(seen.on_right);
    return seen;
}

// Moves an element so far along the fold that it stands on, towards the fold's end. Its shape stays as it is
// to the last digit, which its measures may not tell: they know nothing of a piece that has been pulled
// askew.
bool shift_along(Session& session, std::size_t n, double mm) {
    const Structure& structure = session.design.structures[n];
    const ElementInfo& info = Session::info_of(structure);
    const PageFold on = fold_as_given(structure, session.standing(n).seen, session.tolerances().rounding_mm);
    const auto by = [mm, &on, ground = structure.ground_page()](std::optional<int> page) {
        const Segment& fold = page.value_or(ground) == on.left_page ? on.on_left : on.on_right;
        return (mm / distance(fold.a, fold.b)) * (fold.b - fold.a);
    };
    Shaped moved{Session::points_of(structure), structure.arguments};
    for (std::size_t i = 0; i < moved.points.size(); ++i) {
        if (info.points[i].page == PointPage::fold)
            moved.points[i] = moved.points[i] + by(structure.points[i].page);
    }
    for (std::size_t i = 0; i < moved.arguments.size(); ++i) {
        Argument& argument = moved.arguments[i];
        if (info.parameters[i].page != PointPage::fold || !is_drawn(argument)) continue;
        const Vec2 d = by(argument.page);
        move_argument(argument, {1, 0, 0, 1, d.x, d.y});
        argument.changed = true;
    }
    return session.write(n, moved);
}

// The place in its measures of the first that it has of these.
std::optional<std::size_t> first_of(const ElementInfo& info, std::initializer_list<std::string_view> names) {
    for (const std::string_view name : names) {
        if (const auto found = find_measure(info, name)) return found;
    }
    return std::nullopt;
}

// A change of its place, and the measures that it changes.
struct Shift {
    std::string_view option;
    std::initializer_list<std::string_view> measures;
    bool to = false;  // the measure becomes this, and does not grow by it
    bool turns = false;
};
const Shift kShifts[] = {{"along", {"at"}, false, false}, {"across", {"offset"}, false, false},
                         {"to", {"at"}, true, false},     {"x", {"x"}, false, false},
                         {"y", {"y"}, false, false},      {"turn", {"turn"}, false, true}};

}  // namespace

bool set(Session& session, const Command& command) {
    const auto n = session.find(command.words.front());
    if (!n) return false;
    std::vector<std::pair<std::string, std::string>> values;
    for (const auto& option : command.options) {
        if (option.first != "follow") values.push_back(option);
    }
    for (std::size_t i = 1; i < command.words.size(); ++i) {
        const std::size_t equals = command.words[i].find('=');
        if (equals == std::string::npos)
            return session.fail("bad-edit", fmt::format("'{}' is no value", command.words[i]),
                                "values are such as --width 40 or width=40");
        values.emplace_back(command.words[i].substr(0, equals), command.words[i].substr(equals + 1));
    }
    if (values.empty())
        return session.fail("bad-edit", "nothing is set", "values are such as --width 40 or width=40");
    std::optional<Followers> followers;
    if (command.has("follow")) followers.emplace(session, *n);
    const ElementInfo& info = Session::info_of(session.design.structures[*n]);
    std::vector<double> all(info.measures.size(), 0.0);
    bool any = false;
    for (const auto& value : values) any = any || find_measure(info, value.first).has_value();
    if (any) {
        auto measured = measures(session, *n);
        if (!measured) return false;
        all = std::move(*measured);
    }
    std::vector<bool> given(all.size(), false);
    for (const auto& [name, text] : values) {
        bool of_shape = false;
        if (!session.set_value(*n, name, text, all, of_shape)) return false;
        if (of_shape) given[*find_measure(info, name)] = true;
    }
    if (any && !give_measures(session, *n, all, given)) return false;
    session.touch(*n);
    if (followers) followers->follow(session);
    return true;
}

bool move(Session& session, const Command& command) {
    const auto n = session.find(command.words.front());
    if (!n) return false;
    const ElementInfo& info = Session::info_of(session.design.structures[*n]);
    std::optional<Followers> followers;
    if (command.has("follow")) followers.emplace(session, *n);
    if (command.has("along") && command.has("to"))
        return session.fail("bad-edit", "an element is moved along its fold by a way or to a place",
                            "write --along 12 or --to 0");
    auto values = measures(session, *n);
    if (!values) return false;
    bool any = false;
    bool measured = false;
    double along = 0.0;
    for (const Shift& shift : kShifts) {
        const std::string* text = command.find(shift.option);
        if (text == nullptr) continue;
        const auto measure = first_of(info, shift.measures);
        if (!measure) {
            std::string known;
            for (const Shift& other : kShifts) {
                if (first_of(info, other.measures))
                    known += fmt::format("{}--{}", known.empty() ? "" : ", ", other.option);
            }
            return session.fail("bad-edit",
                                fmt::format("{} is not moved by --{}", with_article(info.name), shift.option),
                                fmt::format("it is by {}", known));
        }
        const auto by = shift.turns ? session.angle("--turn", *text)
                                    : session.length(fmt::format("--{}", shift.option), *text);
        if (!by) return false;
        any = true;
        if (info.measures[*measure].name == "at") {
            along += shift.to ? *by - (*values)[*measure] : *by;
        } else {
            (*values)[*measure] += *by;
            measured = true;
        }
    }
    if (!any)
        return session.fail("bad-edit", "nothing says where it is to be moved",
                            "such as --along 12 or --to 0; on a plate --x 5 --y -3");
    if (measured && !give_measures(session, *n, *values)) return false;
    if (along != 0.0 && !shift_along(session, *n, along)) return false;
    if (followers) followers->follow(session);
    return true;
}

bool move_point(Session& session, const Command& command) {
    const std::string& name = command.words.front();
    const std::size_t full_stop = std::min(name.rfind('.'), name.size());
    const auto n = session.find(std::string_view(name).substr(0, full_stop));
    if (!n) return false;
    Structure& structure = session.design.structures[*n];
    const ElementInfo& info = Session::info_of(structure);
    const std::string letter = full_stop < name.size() ? name.substr(full_stop + 1) : std::string();
    std::size_t i = 0;
    while (i < info.points.size() && info.points[i].letter != letter) ++i;
    if (i == info.points.size()) {
        std::string letters;
        for (const PointInfo& point : info.points)
            letters += (letters.empty() ? "" : " ") + std::string(point.letter);
        return session.fail("bad-edit",
                            fmt::format("\"{}\" ({}) has no point '{}'", structure.id, info.name, letter),
                            letters.empty() ? std::string("it is drawn: edit its outline")
                                            : fmt::format("its points are {}; write {}.{}", letters,
                                                          structure.id, info.points.front().letter));
    }
    const std::string* to_text = command.find("to");
    const std::string* by_text = command.find("by");
    if ((to_text == nullptr) == (by_text == nullptr))
        return session.fail("bad-edit", "a point is moved to a place or by a way",
                            "write --to 12,30 or --by 0,5");
    const auto given =
        session.point(to_text != nullptr ? "--to" : "--by", to_text != nullptr ? *to_text : *by_text);
    if (!given) return false;
    std::optional<Followers> followers;
    if (command.has("follow")) followers.emplace(session, *n);
    const Standing standing = session.standing(*n);
    DesignPoint& point = structure.points[i];
    Vec2 by = to_text != nullptr ? *given - point.at : *given;
    const bool on_fold = info.points[i].page == PointPage::fold;
    const PageFold fold = fold_as_given(structure, standing.seen, session.tolerances().rounding_mm);
    const auto partner = static_cast<std::size_t>(info.partners[i]);
    // A point of the fold slides on it.
    if (on_fold && partner == i && info.points[i].side == '-' && standing.fold && !info.grounds.found) {
        const bool left = point.page.value_or(structure.ground_page()) == fold.left_page;
        const Segment& line = left ? fold.on_left : fold.on_right;
        const Vec2 along = unit(line.b - line.a);
        by = dot(along, by) * along;
    }
    if (!command.has("alone") && partner != i) {
        DesignPoint& other = structure.points[partner];
        Vec2 mirrored_by;
        if (on_fold && standing.fold) {
            const bool right = info.points[i].side == 'R';
            const Segment& own = right ? fold.on_right : fold.on_left;
            const Segment& its = right ? fold.on_left : fold.on_right;
            const Vec2 along = unit(own.b - own.a);
            const Vec2 its_along = unit(its.b - its.a);
            mirrored_by = dot(along, by) * its_along - dot(left_of(along), by) * left_of(its_along);
        } else {
            const Vec2 across = other.at - point.at;
            const Vec2 axis = length(across) > 0.0 ? unit(across) : Vec2{1, 0};
            mirrored_by = by - 2.0 * dot(axis, by) * axis;
        }
        other.at = other.at + mirrored_by;
        other.changed = true;
    }
    point.at = point.at + by;
    point.changed = true;
    session.touch(*n);
    if (followers) followers->follow(session);
    return true;
}

}  // namespace popup::edit
