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

bool is_folded(const CompiledDesign& one, const ReadOptions& /*read*/) { return one.creases.has_value(); }

bool is_drawn(const CompiledDesign& one, const ReadOptions& read) {
    const Language* language = find_language(one.source, read.language);
    return language == nullptr || language->drawn;
}

bool has_frames(const CompiledDesign& one, const ReadOptions& read) {
    const Language* language = find_language(one.source, read.language);
    return language == nullptr || language->name == "fold";
}

// What of the inputs an option is for.
struct ReadingUse {
    std::string_view key;
    bool (*uses)(const CompiledDesign&, const ReadOptions&);
    std::string_view inputs;  // in "no input is ..."
};
constexpr std::string_view kFoldedInput = "a folded sheet";
constexpr std::string_view kDrawnInput = "a drawing";
constexpr ReadingUse kRead[] = {
    {"as", is_drawn, kDrawnInput},        {"lines", is_drawn, kDrawnInput},
    {"frame", has_frames, "a FOLD file"}, {"fold-angle", is_folded, kFoldedInput},
    {"fold-to", is_folded, kFoldedInput}, {"flat", is_folded, kFoldedInput},
    {"board", is_folded, kFoldedInput},   {"merge", is_folded, kFoldedInput},
    {"snap", is_folded, kFoldedInput},
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

void tell_unused_readings(const Options& options, const std::vector<CompiledDesign>& designs,
                          Diagnostics& diagnostics) {
    const bool all_read = std::all_of(designs.begin(), designs.end(), [](const CompiledDesign& one) {
        return one.design || one.creases || one.assembly;
    });
    if (!all_read) return;
    const bool drawn = std::any_of(designs.begin(), designs.end(), [&options](const CompiledDesign& one) {
        return is_drawn(one, options.compile.read);
    });
    for (const ReadingUse& one : kRead) {
        if (!options.given.contains(std::string(one.key))) continue;
        const bool used = std::any_of(designs.begin(), designs.end(), [&](const CompiledDesign& design) {
            return one.uses(design, options.compile.read);
        });
        if (used) continue;
        diagnostics
            .remark("option-unused", {},
                    fmt::format("--{} changes nothing in this run: no input is {}", one.key, one.inputs))
            .hint(one.uses == is_folded && drawn
                      ? fmt::format("read drawings with --as folded, or leave out --{}", one.key)
                      : fmt::format("leave out --{}", one.key));
    }
}

}  // namespace

void tell_unused_options(const Options& options, const OutputPlan& plan,
                         const std::vector<CompiledDesign>& designs, Diagnostics& diagnostics) {
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
    tell_unused_readings(options, designs, diagnostics);
}

}  // namespace popup::cli
