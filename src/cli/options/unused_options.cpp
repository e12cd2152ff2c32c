#include "cli/options/unused_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>

namespace popup::cli {
namespace {

constexpr std::pair<std::string_view, bool OptionUses::*> kRegarded[] = {
    {"view", &OptionUses::view},     {"at", &OptionUses::openings},
    {"size", &OptionUses::size},     {"fps", &OptionUses::rate},
    {"duration", &OptionUses::rate}, {"dpi", &OptionUses::dpi},
    {"speed", &OptionUses::speeds},  {"fold-dialect", &OptionUses::fold_dialect},
    {"legend", &OptionUses::legend}, {"edge-lines", &OptionUses::edge_lines},
};

// ".webp or .gif"
std::string suffixes_of(bool OptionUses::*use) {
    std::vector<std::string_view> suffixes;
    for (const Format& format : format_table()) {
        if (format.uses.*use) suffixes.push_back(format.suffix);
    }
    if (suffixes.size() == 1) return std::string(suffixes.front());
    const std::string_view last = suffixes.back();
    suffixes.pop_back();
    return fmt::format("{} or {}", fmt::join(suffixes, ", "), last);
}

}  // namespace

void tell_unused_options(const Options& options, const OutputPlan& plan, Diagnostics& diagnostics) {
    for (const auto& [key, use] : kRegarded) {
        if (!options.given.contains(std::string(key))) continue;
        const bool used =
            std::any_of(plan.outputs.begin(), plan.outputs.end(),
                        [use = use](const PlannedOutput& one) { return one.format->uses.*use; });
        if (used) continue;
        diagnostics
            .remark("option-unused", {},
                    fmt::format("--{} changes nothing in this run: no output is a {}", key, suffixes_of(use)))
            .hint(fmt::format("add such an output, or leave out --{}", key));
    }
}

}  // namespace popup::cli
