#include "check/exchange.h"

#include <fmt/format.h>

#include <algorithm>

namespace popup {
namespace {

void apply(const Exchange& exchange, Structure& structure) {
    std::swap(structure.points[exchange.first], structure.points[exchange.second]);
}

}  // namespace

std::vector<Exchange> exchanges_that_help(const ElementInfo& info, const Structure& structure,
                                          const std::function<bool(const Structure&)>& makes_sense) {
    std::vector<Exchange> all;
    for (std::size_t i = 0; i < info.points.size(); ++i) {
        for (std::size_t j = i + 1; j < info.points.size(); ++j) {
            if (info.points[i].page == info.points[j].page) all.emplace_back(i, j);
        }
    }
    Structure trial = structure;
    const auto helps = [&](const std::vector<Exchange>& exchanges) {
        for (const Exchange& one : exchanges) apply(one, trial);
        const bool made = makes_sense(trial);
        // Backwards, because two exchanges may share a point.
        std::for_each(exchanges.rbegin(), exchanges.rend(), [&](const Exchange& one) { apply(one, trial); });
        return made;
    };
    for (const Exchange& one : all) {
        if (helps({one})) return {one};
    }
    for (std::size_t i = 0; i < all.size(); ++i) {
        for (std::size_t j = i + 1; j < all.size(); ++j) {
            if (helps({all[i], all[j]})) return {all[i], all[j]};
        }
    }
    return {};
}

std::string to_text(const std::vector<Exchange>& exchanges, const ElementInfo& info) {
    std::string text;
    for (const auto& [first, second] : exchanges) {
        if (!text.empty()) text += ", then ";
        text += fmt::format("{} with {}", info.points[first].letter, info.points[second].letter);
    }
    return text;
}

}  // namespace popup
