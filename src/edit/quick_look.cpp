#include "edit/quick_look.h"

#include <cstddef>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "input/xml/number.h"
#include "popup/diagnostics.h"
#include "popup/mechanism.h"
#include "popup/motion.h"

namespace popup::edit {
namespace {

// What is written has six decimals, and is read again so: then nothing of it has been changed.
Design as_written(Design design) {
    const double mm = design.unit.mm;
    const auto rounded = [mm](double& length) {
        const xml::ParsedNumber number = xml::parse_number(xml::format_number(length / mm));
        if (number.fault == xml::NumberFault::none) length = number.value * mm;
    };
    const auto round_point = [&](DesignPoint& point) {
        if (!point.changed) return;
        rounded(point.at.x);
        rounded(point.at.y);
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
        for (Argument& argument : structure.arguments) argument.changed = false;
    }
    return design;
}

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

// Pages may have other numbers: that moves nothing.
bool is_changed(const Structure& was, const Structure& is) {
    if (is.added || is.type != was.type || !same_points(was.points, is.points)) return true;
    for (const Argument& argument : is.arguments) {
        if (argument.changed) return true;
    }
    if (is.named().text != was.named().text || is.plate.has_value() != was.plate.has_value()) return true;
    if (is.plate) return !(is.plate->at.at == was.plate->at.at);
    return !(is.fold.begin.at == was.fold.begin.at && is.fold.end.at == was.fold.end.at);
}

// The structure that a plate is of; none: the page.
std::optional<std::size_t> structure_of(const Plate& plate, const Numbers& numbers) {
    const std::string_view name(plate.name);
    const auto found = numbers.find(name.substr(0, name.rfind('/')));
    return found == numbers.end() ? std::nullopt : std::optional(found->second);
}

// Which structures have to be moved; nullopt: it cannot be told. `read`: the edited design, as it was read
// again; elements without an id may have other numbers there.
std::optional<std::vector<bool>> concerned(const Edits& edits, const Design& read, const Assembly& assembly) {
    const Design& before = edits.before;
    const Design& edited = edits.after;
    if (read.structures.size() != edited.structures.size()) return std::nullopt;
    const Numbers numbers = numbers_of(read);
    const Numbers old = numbers_of(before);
    const std::size_t count = edited.structures.size();
    std::vector<std::vector<std::size_t>> carriers(count);
    for (const Plate& plate : assembly.plates) {
        if (plate.parent < 0) continue;
        const auto own = structure_of(plate, numbers);
        const auto on = structure_of(assembly.plates[static_cast<std::size_t>(plate.parent)], numbers);
        if (!own || !on || *own == *on) continue;
        if (*on > *own) return std::nullopt;  // what carries comes first
        carriers[*own].push_back(*on);
    }
    std::vector<bool> changed(count, false);
    for (std::size_t i = 0; i < count; ++i) {
        const auto was = old.find(edited.structures[i].id);
        changed[i] = was == old.end() || is_changed(before.structures[was->second], edited.structures[i]);
        for (const std::size_t carrier : carriers[i]) changed[i] = changed[i] || changed[carrier];
    }
    for (std::size_t i = count; i-- > 0;) {
        if (!changed[i]) continue;
        for (const std::size_t carrier : carriers[i]) changed[carrier] = true;
    }
    return changed;
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

bool moves_without_findings(const Edits& edits, const Design& read, const Assembly& assembly,
                            const CheckOptions& options) {
    MotionOptions motion;
    motion.examine = false;
    const auto finds_nothing_in = [&](const Assembly& made) {
        Diagnostics found(read.file);
        return simulate(made, motion, found) && found.sorted().empty();
    };
    // What is taken out may have held what it did not stand on.
    if (edits.taken_out) return finds_nothing_in(assembly);
    const auto moved = concerned(edits, read, assembly);
    if (!moved) return false;
    Diagnostics told(read.file);
    const auto part = check(part_of(read, *moved), options, told);
    const auto small = part ? assemble(*part, {}, told) : std::nullopt;
    return small && finds_nothing_in(*small);
}

bool finds_nothing(const Edits& edits, const CheckOptions& options) {
    const Design written = as_written(edits.after);
    Diagnostics found(written.file);
    const auto checked = check(written, options, found);
    if (!checked || !found.sorted().empty()) return false;
    const auto assembly = assemble(*checked, {}, found);
    return assembly && found.sorted().empty() && moves_without_findings(edits, written, *assembly, options);
}

}  // namespace popup::edit
