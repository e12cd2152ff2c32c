#include <fmt/format.h>

#include <string_view>
#include <utility>

#include "input/flatlang/run/state.h"
#include "input/text.h"

namespace popup::flatlang {

void Evaluation::run_statements(const Syntax& unit, int block) {
    const Syntax* before = std::exchange(state_.unit, &unit);
    run_block(block);
    state_.unit = before;
}

void Evaluation::run_block(int index) {
    if (index == kMissing) return;
    for (const int statement : node(index).children) {
        if (statement == kMissing) {
            in_.fail(node(index).place, "here a statement is missing that could not be read");
        }
        run(statement);
    }
}

void Evaluation::run(int index) {
    const Level level(state_);
    const Node& at = node(index);
    tick(at);
    switch (at.kind) {
        case NodeKind::expression: {
            Value value = evaluate(need(at, 0));
            in_.assign(state_.returned, std::move(value));
            return;
        }
        case NodeKind::define:
            return define(index);
        case NodeKind::choose:
            return choose(at);
        case NodeKind::loop_while:
            return loop_while(at);
        case NodeKind::repeat:
            return repeat(at);
        case NodeKind::for_each:
            return for_each(at);
        case NodeKind::shape:
            return shape(at);
        case NodeKind::from:
            return from(at);
        case NodeKind::replace:
        case NodeKind::replace_all:
            return replace(at);
        case NodeKind::block:
            return run_block(index);
        default:
            evaluate(index);
    }
}

void Evaluation::define(int index) {
    const Node& at = node(index);
    in_.assign(at.symbol, in_.heap.function({state_.unit, index}));
    if (state_.evaluating > 0) {
        in_.print(fmt::format("Defined function '{}'", in_.symbols.name(at.symbol)), at.place);
    }
}

void Evaluation::choose(const Node& at) {
    const std::size_t pairs = at.children.size() / 2;
    for (std::size_t i = 0; i < pairs; ++i) {
        if (is_true(evaluate(need(at, 2 * i)))) return run_block(at.children[2 * i + 1]);
    }
    if (at.has_else) run_block(at.children.back());
}

void Evaluation::loop_while(const Node& at) {
    const Round round(state_, at);
    while (truth_text(need(at, 0))) {
        tick(at);
        run_block(at.children.size() > 1 ? at.children[1] : kMissing);
    }
}

void Evaluation::repeat(const Node& at) {
    const Round round(state_, at);
    const int times = whole_number(number_of(need(at, 0)));
    for (int i = 0; i < times; ++i) {
        tick(at);
        run_block(at.children.size() > 1 ? at.children[1] : kMissing);
    }
}

void Evaluation::for_each(const Node& at) {
    const Round round(state_, at);
    const Value list = evaluate(need(at, 0));
    if (list->type != Type::list) {
        static constexpr std::string_view kNames[] = {"NIL",      "BOOLEAN",    "NUMBER", "STR",   "LIST",
                                                      "FUNCTION", "OBJECT_REF", "VEC",    "MATRIX"};
        in_.print(
            fmt::format("expected list in foreach but got {}", kNames[static_cast<std::size_t>(list->type)]),
            at.place);
        in_.warn("flatlang-not-a-list", at.place,
                 "\"for each\" goes over the elements of a list, and this is none: its block is not run");
        return;
    }
    const int condition = at.children.size() > 1 ? at.children[1] : kMissing;
    const int block = at.children.size() > 2 ? at.children[2] : kMissing;
    for (Value element = list->first; element; element = element->next) {
        tick(at);
        state_.scopes.push();
        state_.scopes.bind(at.symbol, in_.heap.nil());
        in_.assign(at.symbol, element);
        if (condition == kMissing || is_true(evaluate(condition))) run_block(block);
        state_.scopes.pop();
    }
}

void Evaluation::shape(const Node& at) {
    in_.turtle.begin_shape(text_of(need(at, 0)));
    run_block(at.children.size() > 1 ? at.children[1] : kMissing);
    in_.turtle.end_shape();
    in_.check_trail(at.place);
}

void Evaluation::from(const Node& at) {
    if (at.children.empty()) return;
    std::vector<Turtle::Cursor> places;
    const Turtle::Cursor before = in_.turtle.cursor();
    for (std::size_t i = 0; i + 1 < at.children.size(); ++i) {
        const std::string mark = text_of(need(at, i));
        const std::optional<Turtle::Cursor> place = in_.turtle.find_above(mark);
        in_.spend_looks();
        if (!place) {
            in_.fail(
                node(at.children[i]).place,
                fmt::format("there is no mark \"{}\" on the way back to the beginning", shown(mark)),
                "a mark is found from where the turtle stands back along its way; backto() leaves others");
        }
        places.push_back(*place);
    }
    for (const Turtle::Cursor place : places) {
        in_.turtle.set_cursor(place);
        run_block(at.children.back());
    }
    in_.turtle.set_cursor(before);
}

void Evaluation::replace(const Node& at) {
    const std::string start = text_of(need(at, 0));
    const std::string end = text_of(need(at, 1));
    in_.turtle.begin_replacement(start, end, at.kind == NodeKind::replace_all);
    run_block(at.children.size() > 2 ? at.children[2] : kMissing);
    const Outcome outcome = in_.turtle.end_replacement();
    in_.spend_looks();
    switch (outcome) {
        case Outcome::done:
            in_.check_trail(at.place);
            return;
        case Outcome::too_large:
            in_.fail_limit(at.place, "the turtle's trail would grow too long", "--max-trail");
            return;
        case Outcome::no_such_mark:
        case Outcome::no_such_shape:
            in_.fail(
                at.place,
                fmt::format("there is no mark \"{}\" with a mark \"{}\" before it, on the way back to the "
                            "beginning",
                            shown(end), shown(start)));
    }
}

}  // namespace popup::flatlang
