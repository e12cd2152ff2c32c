#include "edit/trial.h"

#include <algorithm>

namespace popup::edit {

bool can_be_tried(const CompiledDesign& design, const CompileOptions& options) {
    const Language* language = find_language(design.source, options.read.language);
    return design.design && design.checked && language != nullptr && language->patch != nullptr &&
           !language->drawn;
}

CompileOptions without_hints(CompileOptions options) {
    options.fitting_size = {};
    options.clearing_move = {};
    options.move_command = {};
    options.move_holds = {};
    options.motion.find_moves = false;
    options.motion.memory = nullptr;
    options.progress = {};
    return options;
}

std::optional<Assembly> assembled(const Source& source, const CompileOptions& options, Diagnostics& found) {
    const auto design = read_design(source, options.read, found);
    if (!design) return std::nullopt;
    const auto checked = check(*design, options.check, found);
    return checked ? assemble(*checked, options.assemble, found) : std::nullopt;
}

FindingCounts count_findings(const Diagnostics& found) {
    FindingCounts counts;
    for (const Diagnostic& one : found.sorted()) {
        // Allowances are looked at when all has been found, as it has not been in a design that is compiled.
        if (one.severity != Severity::remark && one.code != "unused-allow")
            ++counts[{std::string(one.code), one.element}];
    }
    return counts;
}

bool finds_more(const FindingCounts& before, const FindingCounts& after) {
    return std::any_of(after.begin(), after.end(), [&](const auto& row) {
        const auto was = before.find(row.first);
        return row.second > (was == before.end() ? 0 : was->second);
    });
}

}  // namespace popup::edit
