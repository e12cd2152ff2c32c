#include "edit/denied_of_drawing.h"

#include <algorithm>
#include <map>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "edit/trial.h"

namespace popup::edit {
namespace {

std::vector<Diagnostic> errors_of(const Source& source, const CompileOptions& options,
                                  const DiagnosticPolicy& policy) {
    CompileOptions plain = without_hints(options);
    plain.read.drawing.as = DrawnAs::folded;
    plain.until = Stage::pattern;
    plain.threads = 1;
    const Compilation run = compile({source}, plain, policy);
    std::vector<Diagnostic> errors = run.designs.front().diagnostics.sorted();
    std::erase_if(errors, [](const Diagnostic& one) { return one.severity != Severity::error; });
    return errors;
}

}  // namespace

bool denies(const DiagnosticPolicy& policy) { return policy.warnings_are_errors || !policy.deny.empty(); }

bool brings_denied(const Source& before, const std::string& after, const CompileOptions& options,
                   Diagnostics& of_document) {
    const DiagnosticPolicy& policy = of_document.policy();
    const std::vector<Diagnostic> now = errors_of({before.name, after}, options, policy);
    if (now.empty()) return false;
    // Panels may have other names afterwards: what is counted is of one code.
    std::map<std::string_view, int> more;
    for (const Diagnostic& one : now) ++more[one.code];
    std::set<std::pair<std::string_view, std::string>> had;
    const std::vector<Diagnostic> then = errors_of(before, options, policy);
    for (const Diagnostic& one : then) {
        --more[one.code];
        had.emplace(one.code, one.message);
    }
    bool any = false;
    for (const Diagnostic& one : now) {
        if (more[one.code] <= 0) continue;
        any = true;
        if (!had.contains({one.code, one.message}))
            of_document.add(one.severity, one.code, one.place, one.message) = one;
    }
    return any;
}

}  // namespace popup::edit
