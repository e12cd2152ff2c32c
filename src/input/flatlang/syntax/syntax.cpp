#include "input/flatlang/syntax/syntax.h"

namespace popup::flatlang {

int Symbols::of(std::string_view name) {
    const auto [at, fresh] = numbers_.try_emplace(std::string(name), static_cast<int>(names_.size()));
    if (fresh) names_.emplace_back(name);
    return at->second;
}

std::optional<int> Symbols::find(std::string_view name) const {
    const auto known = numbers_.find(std::string(name));
    if (known == numbers_.end()) return std::nullopt;
    return known->second;
}

}  // namespace popup::flatlang
