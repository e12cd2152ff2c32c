// Lists: chains of elements that several lists may share.
#include <fmt/format.h>

#include <array>
#include <functional>
#include <vector>

#include "input/flatlang/run/interpreter.h"

namespace popup::flatlang {
namespace {

// Grows at its end.
class Chain {
 public:
    explicit Chain(Heap& heap) : list_(heap.list({})) {}
    void add(Value element) {
        (last_ ? last_->next : list_->first) = element;
        last_ = std::move(element);
    }
    Value take() { return std::move(list_); }

 private:
    Value list_;
    Value last_;
};

const Value& need_list(const Call& call, std::size_t i) {
    const Value& value = call.arguments[i];
    if (value->type != Type::list) call.in.fail_type(call, i, "a list");
    return value;
}

bool same(const Call& call, const Value& a, const Value& b) {
    call.in.spend(1);
    return call.in.same_text(a, b, call.place);
}

// -1 where it is no sensible number of elements.
std::int64_t count(const Call& call, std::size_t i) {
    const double value = to_number(call.arguments[i], call.in.symbols);
    if (!(value >= 0.0)) return value > -1.0 ? 0 : -1;
    return value < 1e9 ? static_cast<std::int64_t>(value) : 1'000'000'000;
}

// A copy of a value, or of each element of a list.
void add_copies(const Call& call, const Value& from, Chain& to) {
    if (from->type != Type::list) return to.add(call.in.copied(from, call.place));
    for (Value at = from->first; at; at = Value(at->next)) to.add(call.in.copied(at, call.place));
}

Value join(const Call& call) {
    Chain joined(call.in.heap);
    for (const Value& argument : call.arguments) add_copies(call, argument, joined);
    return joined.take();
}

Value cons(const Call& call) {
    Value element = call.in.copied(call.arguments[0], call.place);
    const Value& rest = call.arguments[1];
    element->next = rest->type == Type::list ? rest->first : rest;
    return call.in.heap.list(std::move(element));
}

Value first(const Call& call) {
    const Value& list = call.arguments[0];
    if (list->type != Type::list) return list;
    return list->first ? list->first : call.in.heap.nil();
}

Value rest(const Call& call) {
    const Value& list = call.arguments[0];
    if (list->type != Type::list || !list->first) return call.in.heap.list({});
    return call.in.heap.list(list->first->next);
}

Value last(const Call& call) {
    const Value& list = call.arguments[0];
    if (list->type != Type::list) return list;
    if (!list->first) return call.in.heap.nil();
    Value at = list->first;
    while (at->next) {
        call.in.spend(1);
        at = Value(at->next);
    }
    return at;
}

Value element(const Call& call) {
    const Value& list = call.arguments[0];
    if (list->type != Type::list) return call.in.heap.nil();
    Value at = list->first;
    for (std::int64_t i = count(call, 1); i > 0 && at; --i) {
        call.in.spend(1);
        at = Value(at->next);
    }
    return at ? at : call.in.heap.nil();
}

Value reversed(const Call& call) {
    Value made = call.in.heap.list({});
    const Value& list = call.arguments[0];
    if (list->type != Type::list) return call.in.copied(list, call.place);
    for (Value at = list->first; at; at = Value(at->next)) {
        Value copy = call.in.copied(at, call.place);
        copy->next = std::move(made->first);
        made->first = std::move(copy);
    }
    return made;
}

Value flatten(const Call& call) {
    if (call.arguments[0]->type != Type::list) return call.in.copied(call.arguments[0], call.place);
    Chain flat(call.in.heap);
    std::vector<Value> after{call.arguments[0]->first};
    while (!after.empty()) {
        Value at = std::move(after.back());
        after.pop_back();
        if (!at) continue;
        call.in.spend(1);
        after.push_back(at->next);
        if (at->type == Type::list) {
            after.push_back(at->first);
        } else {
            flat.add(call.in.copied(at, call.place));
        }
    }
    return flat.take();
}

Value equal(const Call& call) {
    return call.in.heap.truth(call.arguments.size() == 2 && same(call, call.arguments[0], call.arguments[1]));
}

// What stands before the searched element, and it with what follows, as a list of two.
Value split_at(const Call& call, const Value& list, const std::function<bool(const Value&)>& here) {
    Chain before(call.in.heap);
    Chain after(call.in.heap);
    bool found = false;
    for (Value at = list->first; at; at = Value(at->next)) {
        found = found || here(at);
        (found ? after : before).add(call.in.copied(at, call.place));
    }
    Chain both(call.in.heap);
    both.add(before.take());
    both.add(after.take());
    return both.take();
}

// Is this the searched element, after `skip` others that equal it?
std::function<bool(const Value&)> search(const Call& call, const Value& wanted, std::int64_t skip) {
    return [&call, &wanted, skip](const Value& at) mutable { return same(call, at, wanted) && skip-- == 0; };
}

Value split(const Call& call) {
    if (call.arguments.size() != 3) return call.in.heap.nil();
    return split_at(call, need_list(call, 1), search(call, call.arguments[0], count(call, 2)));
}

Value split_at_index(const Call& call) {
    if (call.arguments.size() != 2) return call.in.heap.nil();
    std::int64_t left = count(call, 0);
    return split_at(call, need_list(call, 1), [left](const Value&) mutable { return left-- <= 0; });
}

Value find(const Call& call) {
    return split_at(call, need_list(call, 1), search(call, call.arguments[0], count(call, 2)))->first->next;
}

Value remove(const Call& call) {
    Chain kept(call.in.heap);
    std::int64_t times = count(call, 2);
    for (Value at = need_list(call, 1)->first; at; at = Value(at->next)) {
        if (times > 0 && same(call, at, call.arguments[0])) {
            --times;
        } else {
            kept.add(call.in.copied(at, call.place));
        }
    }
    return kept.take();
}

Value copy_list(const Call& call) {
    Chain made(call.in.heap);
    const std::int64_t begin = count(call, 0);
    const std::int64_t end = count(call, 1);
    std::int64_t i = 0;
    for (Value at = need_list(call, 2)->first; at && i < end; at = Value(at->next), ++i) {
        call.in.spend(1);
        if (i >= begin) made.add(call.in.copied(at, call.place));
    }
    return made.take();
}

// Of the lists within a list, the one whose first element is wanted, after `skip` others: its index and
// value.
std::pair<std::int64_t, Value> find_first(const Call& call, std::int64_t skip, std::int64_t start) {
    std::int64_t i = 0;
    for (Value at = need_list(call, 1)->first; at; at = Value(at->next), ++i) {
        call.in.spend(1);
        if (i < start || at->type != Type::list || !at->first) continue;
        if (same(call, at->first, call.arguments[0]) && skip-- == 0) return {i, at};
    }
    return {-1, {}};
}

Value find_list_index(const Call& call) {
    return call.in.heap.number(static_cast<double>(find_first(call, count(call, 2), count(call, 3)).first));
}

Value find_list(const Call& call) {
    auto [index, found] = find_first(call, count(call, 2), 0);
    call.in.print("index is " + number_text(static_cast<double>(index)), call.place);
    call.in.print(fmt::format("evals to {}", index >= 0), call.place);
    return found ? found : call.in.heap.truth(false);
}

// Takes `list` itself apart wherever an element equals the first argument: what all see that share it.
template <bool kInsert, bool kUnpack>
Value modify(const Call& call) {
    if (call.arguments.size() != 3 || call.arguments[2]->type != Type::list) return call.in.heap.nil();
    const Value& wanted = call.arguments[0];
    const Value& with = call.arguments[1];
    const Value& list = call.arguments[2];
    // Puts copies of what replaces it where `place` leads; returns the last of them.
    const auto put = [&](Value& place) {
        Chain copies(call.in.heap);
        if (kUnpack) {
            add_copies(call, with, copies);
        } else {
            copies.add(call.in.copied(with, call.place));
        }
        const Value made = copies.take();
        if (!made->first) {
            call.in.fail_argument(call, 1,
                                  fmt::format("argument 2 of {}() is an empty list: there is nothing to put "
                                              "into the other",
                                              call.name));
        }
        Value after = kInsert ? place : Value(place->next);
        place = made->first;
        Value end = made->first;
        while (end->next) end = Value(end->next);
        end->next = std::move(after);
        return end;
    };
    if (list->first && same(call, wanted, list->first)) put(list->first);
    for (Value at = list->first; at; at = Value(at->next)) {
        if (at->next && same(call, wanted, at->next)) at = put(at->next);
    }
    return list;
}

constexpr std::array kBuiltins{
    Builtin{"__join", 0, -1, join},
    Builtin{"__cons", 2, 2, cons},
    Builtin{"__first", 1, 1, first},
    Builtin{"__rest", 1, 1, rest},
    Builtin{"__last", 1, 1, last},
    Builtin{"__element", 2, 2, element},
    Builtin{"__reversed", 1, 1, reversed},
    Builtin{"__flatten", 1, 1, flatten},
    Builtin{"__eq", 0, -1, equal},
    Builtin{"__split", 0, -1, split},
    Builtin{"__splitAtIndex", 0, -1, split_at_index},
    Builtin{"__find", 3, 3, find},
    Builtin{"__find_list", 3, 3, find_list},
    Builtin{"__find_list_index", 4, 4, find_list_index},
    Builtin{"__copy_list", 3, 3, copy_list},
    Builtin{"__remove", 3, 3, remove},
    Builtin{"__replaceNode", 0, -1, modify<false, false>},
    Builtin{"__replaceList", 0, -1, modify<false, true>},
    Builtin{"__insertNode", 0, -1, modify<true, false>},
    Builtin{"__insertList", 0, -1, modify<true, true>},
};

}  // namespace

std::span<const Builtin> list_builtins() { return kBuiltins; }

}  // namespace popup::flatlang
