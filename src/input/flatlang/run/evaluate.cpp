// Expressions, and what every step of a program costs.
#include <fmt/format.h>

#include <algorithm>
#include <boost/container/small_vector.hpp>
#include <cmath>
#include <limits>
#include <utility>

#include "input/flatlang/run/state.h"
#include "input/text.h"

namespace popup::flatlang {
namespace {

std::string shown_value(const Value& value, const Symbols& symbols) {
    constexpr std::size_t kMost = 40;
    std::string text = to_text(value, symbols, kMost + 1);
    if (text.size() > kMost) text = text.substr(0, kMost) + "…";
    return fmt::format("{} ({})", type_name(value->type), text);
}

}  // namespace

void Evaluation::tick(const Node& at) {
    state_.at = &at;
    const ProgramLimits& limits = state_.options.program.limits;
    state_.steps += 1 + in_.heap.take_work();
    if (state_.steps > limits.steps) {
        state_.steps = limits.steps;
        in_.fail_limit(at.place, fmt::format("the program has taken {} steps", limits.steps), "--max-steps");
    }
    if (in_.heap.size() + state_.nodes > limits.values) {
        in_.fail_limit(
            at.place,
            fmt::format("the program holds {} values, where 64 bytes of text count as one", limits.values),
            "--max-values");
    }
    if (state_.nesting > kLevelsPerCall * limits.depth + kLevelsBesides) {
        in_.fail_limit(at.place, "calls and expressions stand too deep within each other", "--max-depth");
    }
}

const Node& Evaluation::node(int index) const { return state_.unit->nodes[static_cast<std::size_t>(index)]; }

// A part that recovery has not found is missing in 2008 mode.
int Evaluation::need(const Node& parent, std::size_t child) {
    const int index = child < parent.children.size() ? parent.children[child] : kMissing;
    if (index == kMissing) in_.fail(parent.place, "here something is missing that could not be read");
    return index;
}

bool Evaluation::truth_text(int index) {
    const Value value = evaluate(index);
    if (value->type == Type::truth) return value->number != 0.0;
    return to_text(value, in_.symbols, 5) == "true";
}

std::string Evaluation::text_of(int index) { return in_.text_of(evaluate(index), node(index).place); }

double Evaluation::number_of(int index) { return to_number(evaluate(index), in_.symbols); }

Value Evaluation::evaluate(int index) {
    const Level level(state_);
    const Node& at = node(index);
    tick(at);
    switch (at.kind) {
        case NodeKind::number:
            return in_.heap.number(at.number);
        case NodeKind::text:
            return in_.heap.text(at.text);
        case NodeKind::truth:
            return in_.heap.truth(at.number != 0.0);
        case NodeKind::infinity:
            return in_.heap.number(std::numeric_limits<double>::max());
        case NodeKind::object:
            return in_.heap.object();
        case NodeKind::name:
            return in_.lookup(at.symbol);
        case NodeKind::call:
            return call(at);
        case NodeKind::index:
            return element(at);
        case NodeKind::list:
            return list(at);
        case NodeKind::member:
            return member(at);
        case NodeKind::negate:
            return negated(at);
        case NodeKind::plus:
            return evaluate(need(at, 0));
        case NodeKind::add:
        case NodeKind::subtract:
        case NodeKind::multiply:
        case NodeKind::divide:
        case NodeKind::remainder:
            return arithmetic(at);
        case NodeKind::less:
        case NodeKind::less_equal:
        case NodeKind::greater:
        case NodeKind::greater_equal:
        case NodeKind::equal:
        case NodeKind::unequal:
            return comparison(at);
        case NodeKind::both:
        case NodeKind::either: {
            // Both sides are evaluated, whatever the first is.
            const bool a = truth_text(need(at, 0));
            const bool b = truth_text(need(at, 1));
            return in_.heap.truth(at.kind == NodeKind::both ? a && b : a || b);
        }
        case NodeKind::assign:
            return assign(at);
        default:
            return in_.fail(at.place, "here a value is needed");
    }
}

Value Evaluation::assign(const Node& at) {
    Value value = evaluate(need(at, 1));
    int target = need(at, 0);
    const Value old = evaluate(target);
    if (old->extras && old->extras->referent_symbol >= 0) {
        Cell* owner = old->extras->referent;
        if (owner->serial == old->extras->referent_serial) {
            in_.set_member(*owner, old->extras->referent_symbol, value);
        }
        old->clear_referent();
        return value;
    }
    // An element or a call stands for the name that it begins with.
    while (true) {
        const Node& left = node(target);
        if (left.kind == NodeKind::name || left.kind == NodeKind::call) {
            if (in_.keeps_definition(left.symbol)) return value;
            in_.assign(left.symbol, value);
            return value;
        }
        if (left.kind == NodeKind::member) return value;  // of nothing that lives
        if (left.children.empty() || left.children.front() == kMissing) {
            return in_.fail(at.place, "what stands left of = cannot be assigned to",
                            "a variable or a member stands there");
        }
        target = left.children.front();
    }
}

Value Evaluation::call(const Node& at) {
    if (at.symbol == state_.quote) return in_.heap.nil();
    const Value found = in_.lookup(at.symbol);
    const bool defined = found->type == Type::function;
    const Builtin* builtin = defined ? nullptr : state_.builtin_of(at.symbol, in_.symbols);
    if (!defined && builtin == nullptr) {
        in_.warn_unknown_function(at.symbol, at.place);
        return in_.heap.nil();
    }
    boost::container::small_vector<Value, 6> arguments;
    for (const int child : at.children) {
        if (child == kMissing) in_.fail(at.place, "here an argument is missing that could not be read");
        arguments.push_back(evaluate(child));
        arguments.back()->clear_referent();
    }
    if (defined) return call_function(at, found, {arguments.data(), arguments.size()});
    const auto given = static_cast<int>(arguments.size());
    if (given < builtin->least) {
        const bool of_value = !state_.objects.empty();
        in_.fail(at.place,
                 fmt::format("{}() takes {}{} argument{}, not {}", builtin->name,
                             builtin->most == builtin->least ? "" : "at least ", builtin->least,
                             builtin->least == 1 ? "" : "s", given),
                 of_value ? fmt::format("what stands before the dot is {} and has no {}() of its own",
                                        shown_value(state_.objects.back(), in_.symbols), builtin->name)
                          : std::string());
    }
    if (builtin->most >= 0 && given > builtin->most) {
        in_.warn("flatlang-argument-count", at.place,
                 fmt::format("{}() takes {}{} argument{}, not {}; those beyond are disregarded",
                             builtin->name, builtin->most == builtin->least ? "" : "at most ", builtin->most,
                             builtin->most == 1 ? "" : "s", given));
    }
    state_.scopes.push();
    const bool of_prelude = state_.unit == state_.prelude && !state_.callers.empty();
    const std::string_view name = of_prelude && state_.callers.back().function >= 0
                                      ? in_.symbols.name(state_.callers.back().function)
                                      : builtin->name;
    Value value =
        builtin->run({in_, {arguments.data(), arguments.size()}, at, at.place, name, builtin->data});
    in_.assign(state_.returned, value);
    state_.scopes.pop();
    return value;
}

Value Evaluation::call_function(const Node& at, const Value& function, std::span<Value> arguments) {
    const FunctionBody body = function->extras->function;
    const Node& definition = body.syntax->nodes[static_cast<std::size_t>(body.node)];
    if (definition.parameters.size() == 1 && definition.parameters.front() == state_.arguments) {
        Value all = list_of(arguments, at.place);
        return run_function(at, body, {&all, 1});
    }
    if (arguments.size() != definition.parameters.size()) {
        in_.warn("flatlang-argument-count", at.place,
                 fmt::format("{}() takes {} argument{}, not {}; it is not called",
                             shown(in_.symbols.name(at.symbol >= 0 ? at.symbol : definition.symbol)),
                             definition.parameters.size(), definition.parameters.size() == 1 ? "" : "s",
                             arguments.size()));
        return in_.heap.nil();
    }
    return run_function(at, body, arguments);
}

Value Evaluation::run_function(const Node& at, const FunctionBody& body, std::span<const Value> arguments) {
    const Node& definition = body.syntax->nodes[static_cast<std::size_t>(body.node)];
    const ProgramLimits& limits = state_.options.program.limits;
    if (state_.calls >= limits.depth) {
        in_.fail_limit(at.place, fmt::format("calls stand {} deep within each other", limits.depth),
                       "--max-depth");
    }
    Scopes& scopes = state_.scopes;
    ++state_.calls;
    scopes.push();
    const std::size_t hidden = scopes.hidden_below();
    if (in_.as_2008()) {
        scopes.hide_below_newest(definition.safe);
    } else {
        scopes.hide_below(definition.safe ? scopes.depth() : 0);
    }
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        scopes.bind(definition.parameters[i], in_.heap.nil());
        in_.assign(definition.parameters[i], arguments[i]);
    }
    state_.callers.push_back({state_.unit, at.place, &at, definition.symbol});
    state_.unit = body.syntax;
    const int block = definition.children.empty() ? kMissing : definition.children.front();
    if (block == kMissing) {
        in_.fail(definition.place,
                 fmt::format("{}() is called, and there is nothing between its name and done",
                             in_.symbols.name(definition.symbol)),
                 "a function that shall do nothing has a value at least, such as 0");
    }
    run_block(block);
    state_.unit = state_.callers.back().unit;
    state_.callers.pop_back();
    state_.at = &at;
    // What was returned may stand in a scope that the caller does not see.
    scopes.hide_below_newest(false);
    scopes.hide_below(0);
    Value value = in_.lookup_returned();
    scopes.hide_below(hidden);
    scopes.pop();
    --state_.calls;
    return value;
}

void Evaluation::run_at_end() {
    const Value function = in_.lookup(state_.at_end);
    if (function->type != Type::function) return;
    const Node nowhere;
    state_.unit = state_.program;
    call_function(nowhere, function, {});
    state_.unit = nullptr;
}

Value Evaluation::element(const Node& at) {
    Value value = evaluate(need(at, 0));
    if (value->type != Type::list) return in_.heap.nil();
    for (std::size_t i = 1; i < at.children.size(); ++i) {
        const int index = whole_number(number_of(need(at, in_.as_2008() ? 1 : i)));
        if (value->type != Type::list) {
            in_.fail(at.place, fmt::format("only a list has elements, and this is {}",
                                           shown_value(value, in_.symbols)));
        }
        Value next = value->first;
        for (int j = 0; j < index; ++j) {
            if (!next) return in_.heap.nil();
            in_.spend(1);
            next = Value(next->next);
        }
        if (!next) {
            in_.fail(at.place, fmt::format("there is no element {}: the list has {}, counted from 0",
                                           std::max(index, 0), length(value)));
        }
        value = std::move(next);
    }
    return value;
}

// What a call is given, as a list of it would be.
Value Evaluation::list_of(std::span<const Value> values, Place place) {
    Value made = in_.heap.list({});
    Value last;
    for (const Value& value : values) {
        Value element = in_.copied(value, place);
        (last ? last->next : made->first) = element;
        last = std::move(element);
    }
    return made;
}

Value Evaluation::list(const Node& at) {
    Value made = in_.heap.list({});
    Value last;
    for (const int child : at.children) {
        if (child == kMissing) in_.fail(at.place, "here an element is missing that could not be read");
        Value element = in_.copied(evaluate(child), at.place);
        (last ? last->next : made->first) = element;
        last = std::move(element);
    }
    return made;
}

Value Evaluation::member(const Node& at) {
    const int left_index = need(at, 0);
    const int right = need(at, 1);
    Value left = evaluate(left_index);
    if (left->type == Type::nil) {
        left = in_.heap.text("{object}");
        const Node& named = node(left_index);
        if (named.kind == NodeKind::name) {
            state_.scopes.bind(named.symbol, in_.heap.nil());
            in_.assign(named.symbol, left);
        }
    }
    state_.objects.push_back(left);
    Value value = evaluate(right);
    state_.objects.pop_back();
    if (node(right).kind == NodeKind::name) value->set_referent(node(right).symbol, left->owner());
    return value;
}

Value Evaluation::negated(const Node& at) {
    const Value value = evaluate(need(at, 0));
    if (in_.as_2008()) {
        // The text with a minus before it is read as a number, and "--5.0" is none.
        return in_.heap.number(text_number("-" + to_text(value, in_.symbols, 4096)));
    }
    const double number = to_number(value, in_.symbols);
    // What is no number is 0, also with a minus before it, and not -0.
    return in_.heap.number(number == 0.0 && value->type != Type::number ? 0.0 : -number);
}

Value Evaluation::arithmetic(const Node& at) {
    const Value a = evaluate(need(at, 0));
    const Value b = evaluate(need(at, 1));
    if (a->type == Type::number && b->type == Type::number) {
        const auto x = static_cast<float>(a->number);
        const auto y = static_cast<float>(b->number);
        switch (at.kind) {
            case NodeKind::add:
                return in_.heap.number(static_cast<double>(x + y));
            case NodeKind::subtract:
                return in_.heap.number(static_cast<double>(x - y));
            case NodeKind::multiply:
                return in_.heap.number(static_cast<double>(x * y));
            case NodeKind::divide:
                return in_.heap.number(static_cast<double>(x / y));
            default: {
                const int divisor = whole_number(static_cast<double>(y));
                if (divisor == 0)
                    return in_.fail(at.place, "the remainder of a division by zero is asked for");
                if (divisor == -1) return in_.heap.number(0.0);
                return in_.heap.number(whole_number(static_cast<double>(x)) % divisor);
            }
        }
    }
    const bool vec_a = a->type == Type::vec;
    const bool vec_b = b->type == Type::vec;
    const auto scaled = [&](const Value& v, double by) {
        const std::array<double, 9>& n = v->extras->numbers;
        return in_.heap.vec({n[0] * by, n[1] * by, n[2] * by});
    };
    if ((vec_a && b->type == Type::number) || (vec_b && a->type == Type::number)) {
        const Value& v = vec_a ? a : b;
        const double n = (vec_a ? b : a)->number;
        if (at.kind == NodeKind::multiply) return scaled(v, n);
        if (at.kind == NodeKind::divide) return scaled(v, 1.0 / n);
        return in_.heap.nil();
    }
    if (vec_a && vec_b) {
        if (at.kind != NodeKind::add && at.kind != NodeKind::subtract) return in_.heap.nil();
        const double sign = at.kind == NodeKind::add ? 1.0 : -1.0;
        const std::array<double, 9>& m = a->extras->numbers;
        const std::array<double, 9>& n = b->extras->numbers;
        return in_.heap.vec({m[0] + sign * n[0], m[1] + sign * n[1], m[2] + sign * n[2]});
    }
    if (at.kind != NodeKind::add) return in_.heap.nil();
    std::string text = in_.text_of(a, at.place) + in_.text_of(b, at.place);
    in_.check_text(text, at.place);
    return in_.heap.text(std::move(text));
}

Value Evaluation::comparison(const Node& at) {
    const Value a = evaluate(need(at, 0));
    const Value b = evaluate(need(at, 1));
    const auto equality = [&](bool same) {
        return in_.heap.truth((at.kind == NodeKind::equal && same) ||
                              (at.kind == NodeKind::unequal && !same));
    };
    if (a->type != b->type) {
        const bool one_is_nil = (a->type == Type::nil) != (b->type == Type::nil);
        return one_is_nil ? equality(false) : in_.heap.truth(false);
    }
    switch (a->type) {
        case Type::number: {
            const auto x = static_cast<float>(a->number);
            const auto y = static_cast<float>(b->number);
            switch (at.kind) {
                case NodeKind::less:
                    return in_.heap.truth(x < y);
                case NodeKind::less_equal:
                    return in_.heap.truth(x <= y);
                case NodeKind::greater:
                    return in_.heap.truth(x > y);
                case NodeKind::greater_equal:
                    return in_.heap.truth(x >= y);
                case NodeKind::equal:
                    return in_.heap.truth(x == y);
                default:
                    return in_.heap.truth(x != y);
            }
        }
        case Type::text:
            return equality(in_.same_text(a, b, at.place));
        case Type::truth:
            return equality(a->number == b->number);
        case Type::object:
            return equality(a->first == b->first);
        case Type::nil:
        case Type::list:
        case Type::function:
        case Type::vec:
        case Type::matrix:
            break;
    }
    // Neither equal nor unequal: so the language has it.
    return in_.heap.truth(false);
}

}  // namespace popup::flatlang
