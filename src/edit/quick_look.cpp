#include "edit/quick_look.h"

#include <cstddef>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <variant>
#include <vector>

#include "input/xml/number.h"
#include "input/xml/read.h"
#include "popup/diagnostics.h"
#include "popup/mechanism.h"
#include "popup/motion.h"

namespace popup::edit {
namespace {

using Numbers = std::unordered_map<std::string_view, std::size_t>;

Numbers numbers_of(const Design& design) {
    Numbers made;
    for (std::size_t i = 0; i < design.structures.size(); ++i) made.emplace(design.structures[i].id, i);
    return made;
}

bool same_points(const std::vector<DesignPoint>& a, const std::vector<DesignPoint>& b) {
    if (a.size() != b.size()) return false;
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (!(a[i].at == b[i].at)) return false;
    }
    return true;
}

// Of each structure after the edits, its number before.
using Before = std::vector<std::optional<std::size_t>>;

// What is named, by its number before; the name may be another one.
bool same_ground(const NamedGround& was, const NamedGround& is, const Before& before) {
    if (was.given() != is.given() || was.which != is.which) return false;
    return is.owner ? before[*is.owner] && was.owner == before[*is.owner] : !was.owner;
}

// Pages may have other numbers: that moves nothing.
bool is_changed(const Structure& was, const Structure& is, const Before& before) {
    if (is.type != was.type || !same_points(was.points, is.points)) return true;
    const ElementInfo& info = *find_element(is.type);
    for (std::size_t i = 0; i < is.arguments.size(); ++i) {
        if (is.arguments[i].changed && info.parameters[i].kind != ParameterKind::colour) return true;
    }
    if (!same_ground(was.named(), is.named(), before) || is.plate.has_value() != was.plate.has_value())
        return true;
    if (is.plate) return !(is.plate->at.at == was.plate->at.at);
    return !(is.fold.begin.at == was.fold.begin.at && is.fold.end.at == was.fold.end.at);
}

// The structure that a plate is of; none: the page.
std::optional<std::size_t> structure_of(const Plate& plate, const Numbers& numbers) {
    const std::string_view name(plate.name);
    const auto found = numbers.find(name.substr(0, name.rfind('/')));
    return found == numbers.end() ? std::nullopt : std::optional(found->second);
}

// What carries each structure; what carries comes first.
using Carriers = std::vector<std::vector<std::size_t>>;

// Of an edited design as it was read again; elements without an id may have other names there. nullopt: it
// cannot be told.
std::optional<Carriers> carriers_after(const Design& read, const Assembly& assembly) {
    const Numbers numbers = numbers_of(read);
    Carriers carriers(read.structures.size());
    for (const Plate& plate : assembly.plates) {
        if (plate.parent < 0) continue;
        const auto own = structure_of(plate, numbers);
        const auto on = structure_of(assembly.plates[static_cast<std::size_t>(plate.parent)], numbers);
        if (!own || !on || *own == *on) continue;
        if (*on > *own) return std::nullopt;
        carriers[*own].push_back(*on);
    }
    return carriers;
}

std::optional<Carriers> carriers_before(const std::vector<std::optional<std::size_t>>& owners) {
    Carriers carriers(owners.size());
    for (std::size_t i = 0; i < carriers.size(); ++i) {
        if (!owners[i]) continue;
        if (*owners[i] >= i) return std::nullopt;
        carriers[i].push_back(*owners[i]);
    }
    return carriers;
}

void mark_carried(const Carriers& carriers, std::vector<bool>& marked) {
    for (std::size_t i = 0; i < marked.size(); ++i) {
        for (const std::size_t carrier : carriers[i]) marked[i] = marked[i] || marked[carrier];
    }
}

void mark_carriers(const Carriers& carriers, std::vector<bool>& marked) {
    for (std::size_t i = marked.size(); i-- > 0;) {
        if (!marked[i]) continue;
        for (const std::size_t carrier : carriers[i]) marked[carrier] = true;
    }
}

// Which structures have to be moved.
struct Concerned {
    std::vector<bool> before, after;

    // Marks those of either design that are marked in the other one; whether there were any.
    bool share(const Before& number) {
        bool any = false;
        for (std::size_t i = 0; i < after.size(); ++i) {
            if (!number[i] || after[i] == before[*number[i]]) continue;
            after[i] = before[*number[i]] = true;
            any = true;
        }
        return any;
    }
};

// What the edits have changed themselves; none: they moved nothing.
std::optional<Concerned> changed(const Edits& edits, const Before& number) {
    Concerned made{std::vector<bool>(edits.before.structures.size(), true),
                   std::vector<bool>(edits.after.structures.size(), true)};
    bool any = false;
    for (std::size_t i = 0; i < number.size(); ++i) {
        if (number[i]) {
            made.after[i] = made.before[*number[i]] =
                is_changed(edits.before.structures[*number[i]], edits.after.structures[i], number);
        }
        any = any || made.after[i];
    }
    // What is still marked without a number after was taken out.
    for (std::size_t i = 0; !any && i < made.before.size(); ++i) any = made.before[i];
    return any ? std::optional(std::move(made)) : std::nullopt;
}

Design part_of(Design design, const std::vector<bool>& kept) {
    std::vector<std::size_t> number(kept.size(), 0);
    std::size_t next = 0;
    for (std::size_t i = 0; i < kept.size(); ++i) {
        design.structures[i].dropped = !kept[i];
        number[i] = next;
        next += kept[i] ? 1 : 0;
    }
    close_up_pages(design);
    design.lines.clear();
    design.prints.clear();
    std::vector<Structure> structures;
    for (Structure& structure : design.structures) {
        if (structure.dropped) continue;
        if (std::optional<std::size_t>& owner = structure.named().owner) owner = number[*owner];
        structures.push_back(std::move(structure));
    }
    design.structures = std::move(structures);
    return design;
}

}  // namespace

// What is written has six decimals, and is read again so: then nothing of it has been changed.
Design as_read(Design design) {
    const auto rounded = [](double& value, double unit) {
        const xml::ParsedNumber number = xml::parse_number(xml::format_number(value / unit));
        if (number.fault == xml::NumberFault::none) value = number.value * unit;
    };
    const auto round_point = [&](DesignPoint& point) {
        if (!point.changed) return;
        rounded(point.at.x, design.unit.mm);
        rounded(point.at.y, design.unit.mm);
    };
    for (Structure& structure : design.structures) {
        for (DesignPoint& point : structure.points) {
            point.changed = point.changed || structure.added;
            round_point(point);
        }
        round_point(structure.fold.begin);
        round_point(structure.fold.end);
        if (structure.plate) round_point(structure.plate->at);
        for (DesignPoint& point : structure.points) point.changed = false;
        const ElementInfo& info = *find_element(structure.type);
        for (std::size_t i = 0; i < structure.arguments.size(); ++i) {
            Argument& argument = structure.arguments[i];
            double* number = std::get_if<double>(&argument.value);
            if (argument.changed && number != nullptr)
                rounded(*number, info.parameters[i].kind == ParameterKind::length ? design.unit.mm : 1.0);
            argument.changed = false;
        }
    }
    xml::name_structures(design);
    return design;
}

bool is_as_it_was(const Edits& edits) {
    return !edits.after.version_changed && !changed(edits, numbers_before(edits.before, edits.after));
}

Owners owners_of(const CardFolds& card) {
    Owners made{{}, card.as_written};
    for (const Standing& one : card.standing) made.owners.push_back(one.owner);
    return made;
}

std::vector<std::optional<std::size_t>> numbers_before(const Design& before, const Design& after) {
    Before made(after.structures.size());
    // Edits leave their order as it is.
    std::size_t next = 0;
    for (std::size_t i = 0; i < made.size(); ++i) {
        const Structure& one = after.structures[i];
        if (one.added) continue;
        while (next < before.structures.size() &&
               before.structures[next].tag_text.offset != one.tag_text.offset)
            ++next;
        if (next < before.structures.size()) made[i] = next++;
    }
    return made;
}

bool moves_without_findings(Edits& edits, const CheckedDesign& checked, std::span<const Diagnostic> repairs,
                            const Assembly& assembly, const CheckOptions& options) {
    const Design& after_repairs = checked.design();
    if (after_repairs.structures.size() != edits.after.structures.size()) return false;
    const Before number = numbers_before(edits.before, edits.after);
    auto marked = changed(edits, number);
    if (!marked) return true;
    if (!repairs.empty()) {
        const Numbers numbers = numbers_of(after_repairs);
        for (const Diagnostic& repair : repairs) {
            const auto repaired = numbers.find(repair.element);
            if (repaired == numbers.end()) return false;
            marked->after[repaired->second] = true;
        }
        marked->share(number);
    }
    if (!edits.owners) edits.owners = owners_of(folds_of_card(edits.before, options.tolerances));
    if (!edits.owners->as_written) return false;
    const auto before = carriers_before(edits.owners->owners);
    const auto after = carriers_after(after_repairs, assembly);
    if (!before || !after) return false;
    do {
        mark_carried(*before, marked->before);
        mark_carried(*after, marked->after);
    } while (marked->share(number));
    do {
        mark_carriers(*before, marked->before);
        mark_carriers(*after, marked->after);
    } while (marked->share(number));
    MotionOptions motion;
    motion.examine = false;
    const auto moves = [&](const Design& design, const std::vector<bool>& kept, Diagnostics& found) {
        const auto part = check(part_of(design, kept), options, found);
        const auto small = part ? assemble(*part, {}, found) : std::nullopt;
        return small && simulate(*small, motion, found);
    };
    // Of what was there before, it only counts that an error has hidden nothing.
    Diagnostics of_before(after_repairs.file);
    if (!moves(edits.before, marked->before, of_before)) return false;
    Diagnostics found(after_repairs.file);
    return moves(after_repairs, marked->after, found) && found.sorted().empty();
}

bool finds_nothing(Edits& edits, const CheckOptions& options) {
    const Design written = as_read(edits.after);
    Diagnostics found(written.file);
    const auto checked = check(written, options, found);
    if (!checked || !found.sorted().empty()) return false;
    const auto assembly = assemble(*checked, {}, found);
    return assembly && found.sorted().empty() &&
           moves_without_findings(edits, *checked, {}, *assembly, options);
}

}  // namespace popup::edit
