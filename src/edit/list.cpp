// Edits of the list of elements: what comes, goes, and gets another name.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "base/text/nearest.h"
#include "edit/defaults.h"
#include "edit/session.h"
#include "input/text.h"
#include "mechanism/measures.h"

namespace popup::edit {
namespace {

constexpr int kMostCopies = 1000;

bool is_taken(const Design& design, std::string_view id) {
    return std::any_of(design.structures.begin(), design.structures.end(),
                       [&](const Structure& one) { return one.id == id; });
}

// "tent", or "tent-2" where that is taken.
std::string free_id(const Design& design, std::string_view wanted) {
    std::string id(wanted);
    for (int number = 2; is_taken(design, id) || id == kBasePage; ++number)
        id = fmt::format("{}-{}", wanted, number);
    return id;
}

bool check_id(Session& session, const std::string& id) {
    if (!is_id(id))
        return session.fail("bad-edit", fmt::format("'{}' cannot be an id", shown(id)), std::string(kIdHint));
    if (id == kBasePage || id == kGutter)
        return session.fail("bad-edit", fmt::format("the id '{}' is kept for the base page", id));
    if (is_taken(session.design, id))
        return session.fail("bad-edit", fmt::format("there is an element \"{}\" already", id));
    return true;
}

// What a new element stands on, written into it; the fold as its points see it.
std::optional<PageFold> stand(Session& session, Structure& made, const ElementInfo& info,
                              const Command& command) {
    const Design& design = session.design;
    const Segment up{{0, 0}, {0, 1}};
    if (info.grounds.page) {
        made.finds_ground = true;
        if (const std::string* page = command.find("page")) {
            const auto number = session.count("--page", *page, 0, 100'000);
            if (!number) return std::nullopt;
            made.fold.page = *number;
            made.argument(0).page = *number;
        }
        return PageFold{made.fold.page, made.fold.page, up, up, false, 0};
    }
    const std::string* given = command.find("on");
    const bool plate = info.grounds.plate;
    const std::string name = given != nullptr ? *given : std::string(plate ? kPagePlates[1] : kGutter);
    const CardFolds& card = session.card();
    NamedGround& on = plate ? made.plate.emplace().on : made.fold.on;
    if (plate && std::find(kPagePlates.begin(), kPagePlates.end(), name) != kPagePlates.end()) {
        on.text = name;
        on.which = name == kPagePlates[1] ? 1 : 0;
        return PageFold{0, 0, up, up, false, 0};
    }
    const std::size_t dot = std::min(name.rfind('.'), name.size());
    const auto owner =
        std::find_if(design.structures.begin(), design.structures.end(),
                     [&](const Structure& one) { return one.id == std::string_view(name).substr(0, dot); });
    if (plate || name != kGutter) {
        std::optional<FoundName> found;
        if (owner != design.structures.end() && dot < name.size()) {
            const ElementInfo& carries = Session::info_of(*owner);
            found = plate ? find_plate_name(carries, owner->id, name.substr(dot + 1))
                          : find_fold_name(carries, owner->id, name.substr(dot + 1));
        }
        if (!found) {
            std::vector<std::string_view> names;
            for (const CardFold& fold : card.folds) {
                if (!plate) names.push_back(fold.name);
            }
            for (const std::string& one : card.plates) {
                if (plate) names.push_back(one);
            }
            const std::vector<std::string> near = nearest(name, names, 1);
            session.fail("bad-edit",
                         fmt::format("there is no {} '{}'", plate ? "plate" : "fold", shown(name)),
                         near.empty() ? std::string("popupc show lists the names that there are")
                                      : fmt::format("perhaps '{}' is meant", near.front()));
            return std::nullopt;
        }
        on.text = found->text;
        on.which = found->which;
        on.owner = static_cast<std::size_t>(owner - design.structures.begin());
    }
    if (plate) return PageFold{0, 0, up, up, false, 0};
    on.text = on.owner ? on.text : std::string(kGutter);
    const auto fold = std::find_if(card.folds.begin(), card.folds.end(),
                                   [&](const CardFold& one) { return one.name == on.text; });
    if (fold == card.folds.end()) {
        session.fail("bad-edit", fmt::format("nothing can stand on {}: what makes it has errors", on.text));
        return std::nullopt;
    }
    // By its two points where the document has no names yet, and needs them for nothing else.
    if (design.version < "3.0" && info.since < "3.0" && fold->at.closed_deg != 180) {
        made.fold.page = fold->at.left_page;
        made.fold.begin.at = fold->at.on_left.a;
        made.fold.end.at = fold->at.on_left.b;
        on = {};
        return fold->at;
    }
    const double half = 0.5 * distance(fold->at.on_left.a, fold->at.on_left.b);
    PageFold seen = fold->at;
    seen.on_left = seen.on_right = {{0, -half}, {0, half}};
    return seen;
}

// Appends a structure; it is where its points are.
void append(Session& session, Structure made) {
    if (made.named().given()) session.need_version("3.0");
    const ElementInfo& info = Session::info_of(made);
    session.need_version(version_needed(info, made.arguments));
    made.added = true;
    session.design.structures.push_back(std::move(made));
    session.forget();
}

// A new element has the place and the sizes of what is drawn for it, where it is not `given` others. Of that
// a single point at 0 is the apex; other points are put first, and what is drawn stays. False: nothing has
// such measures.
bool take_from_drawing(const ElementInfo& info, const PageFold& seen, Structure& made,
                       const std::vector<bool>& given, std::vector<double>& measures) {
    if (made.points.size() > 1) {
        std::vector<Argument> others = made.arguments;
        for (Argument& one : others) {
            if (is_drawn(one)) one = {};
        }
        const auto placed = shaped(info, seen, 1, Session::points_of(made), others, measures);
        if (!placed) return false;
        for (std::size_t i = 0; i < made.points.size(); ++i) made.points[i].at = placed->points[i];
    }
    const auto drawn = measures_of(info, seen, 1, Session::points_of(made), made.arguments);
    if (!drawn) return false;
    for (std::size_t i = 0; i < measures.size(); ++i) {
        if (!given[i] && !info.measures[i].relative) measures[i] = (*drawn)[i];
    }
    return true;
}

// The length of which the measures of a new element are shares: that of --room, else of its fold, else of the
// page. nullopt after an error.
std::optional<double> size_wanted(Session& session, const Command& command, const PageFold& seen,
                                  bool on_fold) {
    if (const std::string* room = command.find("room")) return session.length("--room", *room);
    return on_fold ? distance(seen.on_left.a, seen.on_left.b) : session.design.height_mm;
}

// Gives a new element the measures, and the sizes that it must have, that follow from the `size`. `enlarge`:
// tabs and glued areas are made large enough to hold.
std::vector<double> first_measures(const Session& session, const ElementInfo& info, const PageFold& seen,
                                   double size, bool enlarge, Structure& made) {
    const auto room = [&](std::string_view name) { return enlarge ? room_for(info, name, size) : size; };
    std::vector<double> measures;
    for (const MeasureInfo& measure : info.measures) {
        measures.push_back(measure.share * room(measure.name) * smaller_on(info, measure.name, seen) +
                           measure.standard);
    }
    if (made.plate && made.plate->on.owner == std::nullopt) {
        // In the middle of that half of the page, for the present.
        if (const auto x = find_measure(info, "x"))
            measures[*x] = (made.plate->on.which == 1 ? 0.25 : -0.25) * session.design.width_mm;
    }
    for (std::size_t i = 0; i < info.parameters.size(); ++i) {
        const ParameterInfo& parameter = info.parameters[i];
        if (parameter.kind != ParameterKind::length || !parameter.required) continue;
        made.argument(i).value =
            std::clamp(kHeightShare * room(parameter.name), parameter.least, parameter.most);
    }
    return measures;
}

// Sets what the command gives of the element. `given`: the measures that it gives. False after an error.
bool set_given(Session& session, const Command& command, const ElementInfo& info, Structure& made,
               std::vector<double>& measures, std::vector<bool>& given) {
    session.design.structures.push_back(std::move(made));
    const std::size_t n = session.design.structures.size() - 1;
    const auto set = [&](std::string_view name, const std::string& value) {
        bool is_measure = false;
        const bool done = session.set_value(n, name, value, measures, is_measure);
        if (is_measure) given[*find_measure(info, name)] = true;
        return done;
    };
    bool ok = true;
    for (std::size_t i = 0; ok && i < command.options.size(); ++i) {
        const auto& [name, value] = command.options[i];
        if (name != "id" && name != "on" && name != "page" && name != "room") ok = set(name, value);
    }
    for (std::size_t i = 1; ok && i < command.words.size(); ++i) {
        const std::string& word = command.words[i];
        const std::size_t equals = std::min(word.find('='), word.size());
        ok = equals < word.size() ? set(word.substr(0, equals), word.substr(equals + 1))
                                  : session.fail("bad-edit", fmt::format("'{}' is no value", shown(word)),
                                                 "values are such as --width 40 or width=40");
    }
    made = std::move(session.design.structures.back());
    session.design.structures.pop_back();
    return ok;
}

bool no_such_element(Session& session, const std::string& type) {
    std::vector<std::string_view> names;
    for (const ElementInfo& row : element_table()) names.push_back(row.name);
    const std::vector<std::string> near = nearest(type, names, 1);
    return session.fail("bad-edit", fmt::format("there is no kind of element '{}'", shown(type)),
                        near.empty() ? std::string("popupc list elements shows them all")
                                     : fmt::format("perhaps '{}' is meant", near.front()));
}

}  // namespace

bool add(Session& session, const Command& command) {
    const std::string& type = command.words.front();
    const ElementInfo* info = find_element(type);
    if (info == nullptr) return no_such_element(session, type);
    Structure made;
    const std::string* id = command.find("id");
    if (id != nullptr && !check_id(session, *id)) return false;
    const auto seen = stand(session, made, *info, command);
    if (!seen) return false;
    if (!made.plate && !info->grounds.page) info = &form_on(*info, *seen);
    made.type = info->name;
    made.id = id != nullptr ? *id : free_id(session.design, info->name);
    made.id_given = true;
    made.points.resize(info->points.size());
    const bool on_fold = !made.plate && !info->grounds.page;
    const auto size = size_wanted(session, command, *seen, on_fold);
    if (!size) return false;
    std::vector<double> measures =
        first_measures(session, *info, *seen, *size, on_fold && !command.has("room"), made);
    std::vector<bool> given(measures.size(), false);
    if (!set_given(session, command, *info, made, measures, given)) return false;
    if (made.plate) put_on_plate(session, made, *info, given, measures);
    const bool by_hand = std::any_of(made.arguments.begin(), made.arguments.end(), is_drawn);
    const bool sound = !by_hand || take_from_drawing(*info, *seen, made, given, measures);
    const auto drawn =
        sound ? shaped(*info, *seen, 1, Session::points_of(made), made.arguments, measures, given)
              : std::nullopt;
    if (!drawn) {
        return session.fail("bad-edit", fmt::format("no {} has such measures", info->name),
                            "give widths, lengths and angles above 0");
    }
    for (std::size_t i = 0; i < made.points.size(); ++i) {
        made.points[i].at = drawn->points[i];
        const bool right = info->points[i].side == 'R' && info->points[i].page == PointPage::fold;
        if (right && !made.named().given() && !made.plate && seen->right_page != seen->left_page)
            made.points[i].page = seen->right_page;
    }
    made.arguments = drawn->arguments;
    append(session, std::move(made));
    return true;
}

namespace {

// A place beside a line: how far right of it, and how far along it from its middle; and back.
Vec2 place_beside(const Segment& line, Vec2 p) {
    const measure::Spot spot = measure::spot_of(line.a, line.b);
    return {dot(p - spot.at, spot.right()), dot(p - spot.at, spot.up())};
}
Vec2 place_onto(const Segment& line, Vec2 p) { return measure::spot_of(line.a, line.b).place(p.x, p.y); }

// The other way round: what was on the left of the fold is on its right.
void mirror(Structure& made, const ElementInfo& info, const PageFold& seen) {
    const std::vector<DesignPoint> was = made.points;
    for (std::size_t i = 0; i < was.size(); ++i) {
        const auto to = static_cast<std::size_t>(info.partners[i]);
        if (info.points[i].page == PointPage::extra) {
            made.points[to].at = {-was[i].at.x, was[i].at.y};
            continue;
        }
        const bool right = info.points[i].side == 'R';
        const Vec2 at = place_beside(right ? seen.on_right : seen.on_left, was[i].at);
        const bool to_right = info.points[to].side == 'R';
        made.points[to].at = place_onto(to_right ? seen.on_right : seen.on_left, {-at.x, at.y});
    }
    for (std::size_t i = 0; i < made.arguments.size() && i < info.parameters.size(); ++i) {
        Argument& argument = made.arguments[i];
        const ParameterInfo& parameter = info.parameters[i];
        if (is_drawn(argument)) {
            if (parameter.page == PointPage::extra) {
                move_argument(argument, kMirrored);
            } else {
                const measure::Spot line = measure::spot_of(seen.on_left.a, seen.on_left.b);
                move_argument(argument, measure::moved_to(line, line, -1.0, 1.0));
            }
        }
        const auto partner = find_parameter(info, parameter.partner);
        if (!partner) continue;
        if (*partner == i) {
            const auto* word = std::get_if<std::string>(&argument.value);
            const bool first = word == nullptr || *word == parameter.words[0];
            argument.value = std::string(parameter.words[first ? 1 : 0]);
        } else if (*partner > i) {
            std::swap(argument, made.argument(*partner));
        }
    }
}

// "bird-%n" of the third copy: "bird-3".
std::string numbered(const std::string& pattern, int number) {
    std::string made = pattern;
    for (std::size_t at = made.find("%n"); at != std::string::npos; at = made.find("%n", at)) {
        const std::string digits = std::to_string(number);
        made.replace(at, 2, digits);
        at += digits.size();
    }
    return made;
}

}  // namespace

namespace {

// Puts its points, and what it draws there, beside another fold as they were beside one; from their middles.
void carry(Structure& made, const ElementInfo& info, const PageFold& from, const PageFold& to) {
    for (std::size_t i = 0; i < made.points.size(); ++i) {
        if (info.points[i].page != PointPage::fold) continue;
        const bool right = info.points[i].side == 'R';
        made.points[i].at = place_onto(right ? to.on_right : to.on_left,
                                       place_beside(right ? from.on_right : from.on_left, made.points[i].at));
    }
    const Placed by = measure::moved_to(measure::spot_of(from.on_left.a, from.on_left.b),
                                        measure::spot_of(to.on_left.a, to.on_left.b));
    for (std::size_t i = 0; i < made.arguments.size() && i < info.parameters.size(); ++i) {
        if (info.parameters[i].page == PointPage::fold && is_drawn(made.arguments[i]))
            move_argument(made.arguments[i], by);
    }
}

// Gives a structure other ground, by its name, on which it has these measures: from one fold to the other, as
// they are seen from their middles. Its points are those beside `from`. The ground, as they see it.
std::optional<PageFold> stand_on(Session& session, Structure& made, const ElementInfo& info,
                                 const PageFold& from, const std::string& name,
                                 const std::vector<double>& measures) {
    Structure there;
    there.type = made.type;
    const auto ground = stand(session, there, info, {"copy", {}, {{"on", name}}});
    if (!ground) return std::nullopt;
    carry(made, info, from, *ground);
    const auto placed = shaped(info, *ground, 1, Session::points_of(made), made.arguments, measures);
    if (!placed) {
        session.fail("bad-edit", fmt::format("\"{}\" cannot be copied to {}", made.id, name));
        return std::nullopt;
    }
    for (std::size_t k = 0; k < made.points.size(); ++k) {
        made.points[k].at = placed->points[k];
        made.points[k].page.reset();
        if (info.points[k].side == 'R' && info.points[k].page == PointPage::fold && !there.named().given() &&
            !there.plate && ground->right_page != ground->left_page)
            made.points[k].page = ground->right_page;
    }
    Session::take_arguments(made, placed->arguments);
    made.fold = there.fold;
    made.plate = there.plate;
    made.finds_ground = there.finds_ground;
    return ground;
}

// What stands on an element, itself or by way of others.
struct Child {
    Structure original;  // its points beside `seen`
    PageFold seen;
    std::string owner;  // the id of what it stands on
    std::string which;  // of its folds or plates: ".centre"
    std::vector<double> measures;
};

// In build order; nullopt after an error.
std::optional<std::vector<Child>> children_of(Session& session, std::size_t n) {
    std::vector<Child> all;
    std::vector<bool> carried(session.design.structures.size(), false);
    carried[n] = true;
    const CardFolds& card = session.card();
    for (std::size_t i = n + 1; i < carried.size(); ++i) {
        const Standing& standing = card.standing[i];
        if (!standing.owner || !carried[*standing.owner]) continue;
        carried[i] = true;
        const Structure& one = session.design.structures[i];
        const std::string& owner = session.design.structures[*standing.owner].id;
        const std::vector<Vec2> points = Session::points_of(one, standing.seen);
        const auto values = measures_of(Session::info_of(one), standing.seen, 1, points, one.arguments);
        if (!values || !standing.on.starts_with(owner + ".")) {
            session.fail("bad-edit", fmt::format("\"{}\" cannot be copied with what carries it", one.id));
            return std::nullopt;
        }
        Child child{one, standing.seen, owner, standing.on.substr(owner.size()), *values};
        for (std::size_t k = 0; k < points.size(); ++k) child.original.points[k].at = points[k];
        all.push_back(std::move(child));
    }
    return all;
}

// Each on the copy of what it stands on, with ids "flag-2" or, where that is taken, another number.
bool copy_children(Session& session, const std::vector<Child>& children, const std::string& owner,
                   int number) {
    std::map<std::string, std::string> copies;  // ids
    for (const Child& child : children) {
        Structure made = child.original;
        made.id = free_id(session.design, fmt::format("{}-{}", child.original.id, number + 1));
        made.id_given = true;
        const auto copied = copies.find(child.owner);
        const std::string on = (copied == copies.end() ? owner : copied->second) + child.which;
        if (!stand_on(session, made, Session::info_of(made), child.seen, on, child.measures)) return false;
        copies[child.original.id] = made.id;
        append(session, std::move(made));
    }
    return true;
}

}  // namespace

bool copy(Session& session, const Command& command) {
    const auto n = session.find(command.words.front());
    if (!n) return false;
    const Structure original = session.design.structures[*n];
    const ElementInfo& info = Session::info_of(original);
    const auto times = command.has("times") ? session.count("--times", *command.find("times"), 1, kMostCopies)
                                            : std::optional(1);
    if (!times) return false;
    std::optional<double> step = 0.0;
    if (command.has("step")) step = session.length("--step", *command.find("step"));
    if (!step) return false;
    if (!command.has("step") && !command.has("on") && !command.has("mirror")) {
        return session.fail("bad-edit", "copies would lie where the original is",
                            "--step 25 puts each so far along the fold, --on another.centre on another fold");
    }
    const std::string* ids = command.find("ids");
    if (ids != nullptr && *times > 1 && ids->find("%n") == std::string::npos)
        return session.fail("bad-edit", "several copies would have one id",
                            "write %n where the number goes: bird-%n");
    const Standing standing = session.standing(*n);
    const auto values =
        measures_of(info, standing.seen, 1, Session::points_of(original, standing.seen), original.arguments);
    const auto along = find_measure(info, find_measure(info, "at") ? "at" : "x");
    if (!values || standing.on.empty() || !along)
        return session.fail("bad-edit",
                            fmt::format("\"{}\" cannot be copied: it stands on nothing", original.id));
    std::vector<Child> children;
    if (command.has("with-children")) {
        if (command.has("mirror"))
            return session.fail("bad-edit", "what an element carries is not mirrored with it",
                                "copy the element with --mirror, and what it carries with --on");
        auto found = children_of(session, *n);
        if (!found) return false;
        children = std::move(*found);
    }
    for (int i = 1; i <= *times; ++i) {
        Structure made = original;
        made.id = ids != nullptr ? numbered(*ids, i)
                                 : free_id(session.design, fmt::format("{}-{}", original.id, i + 1));
        if (ids != nullptr && !check_id(session, made.id)) return false;
        made.id_given = true;
        std::vector<double> measures = *values;
        PageFold seen = standing.seen;
        const std::vector<Vec2> points = Session::points_of(original, seen);
        for (std::size_t k = 0; k < points.size(); ++k) made.points[k].at = points[k];
        if (command.has("mirror")) {
            mirror(made, info, seen);
            const auto mirrored = measures_of(info, seen, 1, Session::points_of(made), made.arguments);
            if (mirrored) measures = *mirrored;
        }
        if (const std::string* on = command.find("on")) {
            const auto ground = stand_on(session, made, info, seen, *on, measures);
            if (!ground) return false;
            seen = *ground;
        }
        measures[*along] += *step * i;
        auto placed = shaped(info, seen, 1, Session::points_of(made), made.arguments, measures);
        if (!placed) return session.fail("bad-edit", "it cannot be copied there");
        Session::on_pages(made, seen, placed->points);
        for (std::size_t k = 0; k < made.points.size(); ++k) made.points[k].at = placed->points[k];
        Session::take_arguments(made, placed->arguments);
        const std::string id = made.id;
        append(session, std::move(made));
        if (!copy_children(session, children, id, i)) return false;
    }
    return true;
}

bool take_out(Session& session, const Command& command) {
    const auto n = session.find(command.words.front());
    if (!n) return false;
    const CardFolds& card = session.card();
    std::vector<std::size_t> all{*n};
    std::vector<bool> goes(session.design.structures.size(), false);
    goes[*n] = true;
    for (std::size_t i = *n + 1; i < goes.size(); ++i) {
        // What names an element that cannot be made stands on nothing, and cannot stay without it either.
        const auto named = session.design.structures[i].named().owner;
        const auto owner = named ? named : card.standing[i].owner;
        if (!owner || !goes[*owner]) continue;
        goes[i] = true;
        all.push_back(i);
    }
    if (all.size() > 1 && !command.has("with-children")) {
        constexpr std::size_t kMostNamed = 6;
        std::vector<std::string> named;
        for (std::size_t i = 1; i < all.size() && named.size() < kMostNamed; ++i)
            named.push_back(fmt::format("\"{}\"", session.design.structures[all[i]].id));
        if (all.size() - 1 > kMostNamed) named.push_back(fmt::format("{} more", all.size() - 1 - kMostNamed));
        const std::string last = named.back();
        named.pop_back();
        return session.fail(
            "bad-edit",
            fmt::format("\"{}\" carries {}{}{}, which would stand on nothing", command.words.front(),
                        fmt::join(named, ", "), named.empty() ? "" : " and ", last),
            "--with-children takes them out with it");
    }
    for (auto i = all.rbegin(); i != all.rend(); ++i) session.take_out(*i);
    return true;
}

bool rename(Session& session, const Command& command) {
    const auto n = session.find(command.words[0]);
    const std::string& id = command.words[1];
    if (!n) return false;
    Structure& structure = session.design.structures[*n];
    if (structure.id == id && structure.id_given) return true;
    if (structure.id != id && !check_id(session, id)) return false;
    structure.id = id;
    structure.id_given = structure.id_changed = true;
    for (Structure& other : session.design.structures) {
        NamedGround& on = other.named();
        if (on.owner != *n) continue;
        const ElementInfo& info = Session::info_of(structure);
        on.text = other.plate ? plate_name(id, info.plates[on.which]) : fold_name(id, info.folds[on.which]);
        on.changed = true;
    }
    session.forget();
    return true;
}

}  // namespace popup::edit
