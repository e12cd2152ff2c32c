#include "input/flatlang/run/unknown_names.h"

#include <algorithm>
#include <set>

#include "base/text/nearest.h"
#include "input/flatlang/run/builtin.h"

namespace popup::flatlang {
namespace {

const Node& node(const Syntax& unit, int index) { return unit.nodes[static_cast<std::size_t>(index)]; }

bool is_private(std::string_view name) { return name.starts_with("__"); }

// What an assignment sets: a variable, or a member.
void add_target(const Syntax& unit, int index, std::set<int>& known) {
    while (index != kMissing) {
        const Node& at = node(unit, index);
        if (at.kind == NodeKind::name || at.kind == NodeKind::call) {
            known.insert(at.symbol);
            return;
        }
        if (at.children.empty()) return;
        index = at.kind == NodeKind::member ? at.children.back() : at.children.front();
    }
}

bool add_known(const Syntax& unit, int eval, std::set<int>& known) {
    for (const Node& at : unit.nodes) {
        switch (at.kind) {
            case NodeKind::assign:
                if (!at.children.empty()) add_target(unit, at.children.front(), known);
                break;
            case NodeKind::define:
                known.insert(at.symbol);
                known.insert(at.parameters.begin(), at.parameters.end());
                break;
            case NodeKind::for_each:
                known.insert(at.symbol);
                break;
            case NodeKind::call:
                if (at.symbol == eval) return false;
                break;
            case NodeKind::member:
                // a.b makes an object of a where there is none.
                if (at.children.front() != kMissing) add_target(unit, at.children.front(), known);
                break;
            default:
                break;
        }
    }
    return true;
}

}  // namespace

std::vector<UnknownName> unknown_names(const Syntax& program, const std::deque<Syntax>& units,
                                       const std::vector<int>& defined, const Symbols& symbols) {
    std::set<int> known(defined.begin(), defined.end());
    const int eval = symbols.find("eval").value_or(-1);
    for (const Syntax& unit : units) {
        const bool is_prelude = &unit == &units.front();
        if (!add_known(unit, is_prelude ? -1 : eval, known)) return {};
    }
    // Members are read where they are missing, to see whether they are there.
    std::vector<bool> is_member(program.nodes.size(), false);
    for (const Node& at : program.nodes) {
        if (at.kind == NodeKind::member && at.children.back() != kMissing) {
            is_member[static_cast<std::size_t>(at.children.back())] = true;
        }
    }
    std::vector<UnknownName> found;
    std::set<int> told;
    for (std::size_t i = 0; i < program.nodes.size(); ++i) {
        const Node& at = program.nodes[i];
        if (at.kind != NodeKind::name || is_member[i] || known.contains(at.symbol)) continue;
        const std::string& name = symbols.name(at.symbol);
        if (name == "nil" || is_private(name) || find_builtin(name) != nullptr) continue;
        if (told.insert(at.symbol).second) found.push_back({at.symbol, at.place, {}});
    }
    if (found.empty()) return found;
    // A variable is hardly ever meant to be one of the language's own functions.
    std::set<int> own;
    add_known(units.front(), -1, own);
    std::vector<std::string_view> names;
    for (const int symbol : known) {
        if (!own.contains(symbol) && !is_private(symbols.name(symbol))) names.push_back(symbols.name(symbol));
    }
    std::sort(names.begin(), names.end());
    for (UnknownName& one : found) one.like = nearest(symbols.name(one.symbol), names, 2);
    std::sort(found.begin(), found.end(), [](const UnknownName& a, const UnknownName& b) {
        return std::pair(a.place.line, a.place.column) < std::pair(b.place.line, b.place.column);
    });
    return found;
}

std::vector<std::string> variables_like(std::string_view name, const std::deque<Syntax>& units,
                                        const Symbols& symbols) {
    std::vector<std::string_view> names;
    for (const Syntax& unit : units) {
        if (&unit == &units.front()) continue;
        for (const Node& at : unit.nodes) {
            std::set<int> set;
            if (at.kind == NodeKind::assign && !at.children.empty())
                add_target(unit, at.children.front(), set);
            for (const int symbol : set) names.push_back(symbols.name(symbol));
        }
    }
    std::erase_if(names, is_private);
    std::sort(names.begin(), names.end());
    names.erase(std::unique(names.begin(), names.end()), names.end());
    return nearest(name, names, 2);
}

std::vector<std::string> functions_like(std::string_view name, const std::deque<Syntax>& units,
                                        const Symbols& symbols) {
    std::vector<std::string_view> names = builtin_names();
    for (const Syntax& unit : units) {
        for (const Node& at : unit.nodes) {
            if (at.kind == NodeKind::define) names.push_back(symbols.name(at.symbol));
        }
    }
    std::erase_if(names, is_private);
    std::sort(names.begin(), names.end());
    names.erase(std::unique(names.begin(), names.end()), names.end());
    return nearest(name, names, 2);
}

}  // namespace popup::flatlang
