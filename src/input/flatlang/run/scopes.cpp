#include "input/flatlang/run/scopes.h"

#include <utility>

namespace popup::flatlang {

// Depth 0 is that of functions, depth 1 that of globals.
Scopes::Scopes() { push(); }

void Scopes::push() { starts_.push_back(bound_.size()); }

void Scopes::pop() {
    for (std::size_t i = bound_.size(); i > starts_.back(); --i) {
        variables_[static_cast<std::size_t>(bound_[i - 1])].pop_back();
    }
    bound_.resize(starts_.back());
    starts_.pop_back();
}

Scopes::Stack& Scopes::stack(int symbol) {
    const auto index = static_cast<std::size_t>(symbol);
    if (index >= variables_.size()) variables_.resize(index + 1);
    return variables_[index];
}

const Value* Scopes::find(int symbol) const {
    const auto index = static_cast<std::size_t>(symbol);
    if (index >= variables_.size() || variables_[index].empty()) return nullptr;
    const Stack& all = variables_[index];
    if (all.back().depth >= floor()) return &all.back().value;
    for (std::size_t i = all.size(); i > 0; --i) {
        if (all[i - 1].value->type == Type::function) return &all[i - 1].value;
    }
    return nullptr;
}

void Scopes::assign(int symbol, Value value) {
    Stack& all = stack(symbol);
    if (!all.empty() && all.back().depth >= floor()) {
        all.back().value = std::move(value);
        return;
    }
    bind(symbol, std::move(value));
}

void Scopes::bind(int symbol, Value value) {
    Stack& all = stack(symbol);
    if (!all.empty() && all.back().depth == depth()) {
        all.back().value = std::move(value);
        return;
    }
    all.push_back({depth(), std::move(value)});
    bound_.push_back(symbol);
}

void Scopes::bind_function(int symbol, Value value) {
    Stack& all = stack(symbol);
    if (!all.empty() && all.front().depth == 0) {
        all.front().value = std::move(value);
        return;
    }
    all.insert(all.begin(), {0, std::move(value)});
}

}  // namespace popup::flatlang
