// Printing, loading, evaluating, objects, and what the original's windows and files were told.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>

#include "input/flatlang/run/interpreter.h"
#include "input/flatlang/run/source_text.h"

namespace popup::flatlang {
namespace {

std::string_view trimmed_line(std::string_view text) {
    const auto is_space = [](char c) { return static_cast<unsigned char>(c) <= ' '; };
    while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
    return text;
}

Value print(const Call& call) {
    std::string line;
    for (const Value& argument : call.arguments) {
        line += call.in.text_of(argument, call.place) + " ";
        call.in.check_text(trimmed_line(line), call.place);
    }
    call.in.print(trimmed_line(line), call.place);
    return call.in.heap.nil();
}

// Numbers and some others are left out: so the language has it. True after a list.
bool pretty_print(const Value& value, const Call& call, int level, bool after_list, std::string& out) {
    call.in.check_text(out, call.place);
    if (!out.empty()) out += ' ';
    const std::string indent(2 * static_cast<std::size_t>(level), ' ');
    switch (value->type) {
        case Type::function:
            out += pretty(value->extras->function, call.in.symbols);
            return false;
        case Type::text:
        case Type::nil:
            out += call.in.text_of(value, call.place);
            return false;
        case Type::list: {
            out += "\n" + indent + "[";
            bool list_last = after_list;
            for (Value at = value->first; at; at = Value(at->next)) {
                list_last = pretty_print(at, call, level + 1, list_last, out);
            }
            out += (list_last ? "\n" + indent + "]" : std::string(" ]")) + indent;
            return true;
        }
        case Type::truth:
        case Type::number:
        case Type::object:
        case Type::vec:
        case Type::matrix:
            break;
    }
    return false;
}

Value pprint(const Call& call) {
    std::string text;
    for (const Value& argument : call.arguments) pretty_print(argument, call, 0, false, text);
    call.in.print(text, call.place);
    return call.in.heap.text(std::move(text));
}

std::string_view register_name(Type type) {
    static constexpr std::string_view kNames[] = {"Nil",      "Boolean", "Num", "Str", "List",
                                                  "Function", "ObjRef",  "Vec", "Mat"};
    return kNames[static_cast<std::size_t>(type)];
}

// With its kind; addresses, which the original had there, are left out. Ends when `out` is too long.
void append_tagged(const Value& value, const Call& call, std::string& out) {
    call.in.check_text(out, call.place);
    if (value->type == Type::list) {
        out += "[";
        for (const Value* at = &value->first; *at; at = &(*at)->next) {
            if (at != &value->first) out += ", ";
            append_tagged(*at, call, out);
        }
        out += "]";
    } else {
        out += call.in.text_of(value, call.place);
    }
    out.append("(#/Register$").append(register_name(value->type)).append(")");
}

// Members in the order in which Java's HashMap keeps them.
std::vector<std::size_t> in_hash_order(const std::vector<std::pair<int, Value>>& members,
                                       const Symbols& symbols) {
    std::uint32_t buckets = 16;
    while (members.size() > buckets / 4 * 3) buckets *= 2;
    std::vector<std::uint32_t> bucket;
    for (const auto& [symbol, value] : members) {
        std::uint32_t hash = 0;
        for (const char c : symbols.name(symbol)) hash = 31 * hash + static_cast<unsigned char>(c);
        bucket.push_back((hash ^ (hash >> 16)) & (buckets - 1));
    }
    std::vector<std::size_t> order(members.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return bucket[a] < bucket[b]; });
    return order;
}

Value debug(const Call& call) {
    const Symbols& symbols = call.in.symbols;
    for (const Value& argument : call.arguments) {
        std::string line;
        append_tagged(argument, call, line);
        line += "_members={";
        if (const auto& extras = argument->owner().extras) {
            for (const std::size_t i : in_hash_order(extras->members, symbols)) {
                const auto& [symbol, value] = extras->members[i];
                line += "{" + symbols.name(symbol) + " = " + call.in.text_of(value, call.place) + "} ";
                call.in.check_text(line, call.place);
            }
        }
        line += "}";
        if (argument->next) {
            line += "--->";
            append_tagged(argument->next, call, line);
        }
        call.in.print(line, call.place);
    }
    return call.in.heap.nil();
}

Value evaluate(const Call& call) {
    Value value = call.in.heap.nil();
    for (const Value& argument : call.arguments) {
        value = call.in.evaluate_text(call.in.text_of(argument, call.place), call.place);
    }
    return value;
}

Value source(const Call& call) {
    const Value& value = call.arguments[0];
    if (value->type == Type::list) {
        std::string text = words_of(value, call.in.symbols, call.in.longest_text() + 1);
        call.in.check_text(text, call.place);
        return call.in.heap.text(std::move(text));
    }
    if (value->type != Type::function) return call.in.heap.nil();
    const std::uint64_t before = call.in.heap.size();
    Value list = source_list(value->extras->function, call.in.heap, call.in.symbols);
    // A word takes longer than a step.
    constexpr std::uint64_t kStepsPerWord = 4;
    call.in.spend(kStepsPerWord * (call.in.heap.size() - before));
    return list;
}

Value load(const Call& call) {
    call.in.load(to_text(call.arguments[0], call.in.symbols, 4096), call.place);
    return call.in.heap.nil();
}

Value object(const Call& call) {
    Value made = call.in.heap.object();
    made->owner().set_member(call.in.symbols.of("__str__"), call.arguments[0]);
    return made;
}

Value clear(const Call& call) {
    call.in.turtle.clear();
    call.in.result.hpgl.clear();
    call.in.result.laser.clear();
    call.in.result.part_mode = false;
    return call.in.heap.nil();
}

template <std::vector<AskedFile> ProgramRun::*kFiles>
Value ask_for(const Call& call) {
    std::string name = to_text(call.arguments[0], call.in.symbols, 4096);
    call.in.spend(name.size());
    (call.in.result.*kFiles).push_back({std::move(name), call.in.program_place(call.place)});
    return call.in.heap.nil();
}

Value set_part_mode(const Call& call) {
    const Value& value = call.arguments[0];
    if (value->type != Type::truth) return call.in.fail_type(call, 0, "true or false");
    call.in.result.part_mode = value->number != 0.0;
    return value;
}

Value show_soup(const Call& call) {
    const std::string text = call.in.turtle.describe();
    call.in.spend_looks();
    call.in.print(text, call.place);
    return call.in.heap.nil();
}

Value nothing(const Call& call) { return call.in.heap.nil(); }

// "number", "list", "nil" …
Value type_of(const Call& call) {
    std::string_view name = type_name(call.arguments[0]->type);
    const std::size_t space = name.find(' ');
    if (space != std::string_view::npos) name.remove_prefix(space + 1);
    return call.in.heap.text(std::string(name));
}

// Numbers as messages have them, "0.2" and "3"; all else as print() has it.
Value shown_builtin(const Call& call) {
    const Value& value = call.arguments[0];
    if (value->type != Type::number) return call.in.heap.text(to_text(value, call.in.symbols, 1000));
    return call.in.heap.text(fmt::format("{:.6g}", value->number));
}

// Where in the program the call stands that led here, as [line, column].
Value site(const Call& call) {
    const Place place = call.in.program_place(call.place);
    Value line = call.in.heap.number(place.line);
    line->next = call.in.heap.number(place.column);
    return call.in.heap.list(std::move(line));
}

// What goes wrong from now on at the end of the program is told there.
Value blame(const Call& call) {
    const Value& list = call.arguments[0];
    if (list->type != Type::list || length(list) != 2) return call.in.heap.nil();
    const auto whole = [&](const Value& value) {
        const double number = to_number(value, call.in.symbols);
        return number >= 0 && number < 1e7 ? static_cast<int>(number) : 0;
    };
    call.in.blame({whole(list->first), whole(list->first->next)});
    return call.in.heap.nil();
}

Value fail(const Call& call) {
    constexpr std::size_t kMost = 1000;
    const auto text = [&](std::size_t i) {
        return i < call.arguments.size() ? to_text(call.arguments[i], call.in.symbols, kMost) : std::string();
    };
    return call.in.fail_program(call.place, text(0), text(1));
}

constexpr std::array kBuiltins{
    Builtin{"print", 0, -1, print, nullptr, "print(a, b, ...): prints a line"},
    Builtin{"pprint", 0, -1, pprint, nullptr,
            "pprint(a, ...): prints a list with a line for each list in it"},
    Builtin{"debug", 0, -1, debug, nullptr, "debug(a, ...): prints a value with its type and members"},
    Builtin{"__eval", 0, -1, evaluate},
    Builtin{"source", 1, 1, source, nullptr, "source(f): the words of a function, as lists"},
    Builtin{"load", 1, 1, load, nullptr,
            "load(file): runs another file: of the kit (\"kit/gear.fl\"), or below the program's folder"},
    Builtin{"__named_object", 1, 1, object},
    Builtin{"__type", 1, 1, type_of},
    Builtin{"__fail", 1, 2, fail},
    Builtin{"__shown", 1, 1, shown_builtin},
    Builtin{"__site", 0, 0, site},
    Builtin{"__blame", 1, 1, blame},
    Builtin{"clear", 0, -1, clear, nullptr, "clear(): takes back all that was drawn"},
    Builtin{"__hpgl", 1, 1, ask_for<&ProgramRun::hpgl>},
    Builtin{"laser", 1, 1, ask_for<&ProgramRun::laser>, nullptr,
            "laser(file): asks for a file for a laser; -o does that here"},
    Builtin{"__setPartMode", 1, 1, set_part_mode},
    Builtin{"__showSoup", 0, -1, show_soup},
    Builtin{"__showPolygons", 0, -1, nothing},
    Builtin{"__showMachine", 0, -1, nothing},
    Builtin{"__jitter", 0, -1, nothing},
    Builtin{"outputMatrix", 0, -1, nothing, nullptr, "outputMatrix(...): is accepted, and does nothing"},
    Builtin{"pause", 1, 1, nothing, nullptr, "pause(s): is accepted, and does nothing"},
    Builtin{"redraw", 0, -1, nothing, nullptr, "redraw(): is accepted, and does nothing"},
    Builtin{"animate", 1, 1, clear, nullptr, "animate(x): takes back all that was drawn, as clear() does"},
    Builtin{"sketchup", 1, 1, nothing, nullptr, "sketchup(file): is accepted, and does nothing"},
};

}  // namespace

std::span<const Builtin> program_builtins() { return kBuiltins; }

}  // namespace popup::flatlang
