#include "popup/diagnostics.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <tuple>
#include <utility>

#include "base/further_findings.h"

namespace popup {
namespace {

constexpr std::size_t kLimit = 100;

Severity under_policy(const DiagnosticPolicy& policy, Severity severity, std::string_view code) {
    if (policy.deny.contains(code)) return Severity::error;
    if (severity == Severity::warning && policy.warnings_are_errors) return Severity::error;
    return severity;
}

}  // namespace

std::string_view to_string(Severity severity) {
    switch (severity) {
        case Severity::remark:
            return "remark";
        case Severity::warning:
            return "warning";
        case Severity::error:
            return "error";
    }
    broken_invariant("a severity is one of its enumerators", __FILE__, __LINE__);
}

Diagnostic& Diagnostic::hint(std::string text) {
    hints.push_back(std::move(text));
    return *this;
}

Diagnostic& Diagnostic::about(std::string id) {
    element = std::move(id);
    return *this;
}

Diagnostic& Diagnostic::with(Place at, std::string what) {
    related.push_back({at, std::move(what)});
    return *this;
}

Diagnostic& Diagnostic::changed(std::string before, std::string after) {
    change = Change{std::move(before), std::move(after)};
    return *this;
}

Diagnostics::Diagnostics(std::string file, DiagnosticPolicy policy)
    : file_(std::move(file)), policy_(std::move(policy)) {}

Diagnostic& Diagnostics::add(Severity severity, std::string_view code, Place place, std::string message) {
    if (find_code(code) == nullptr) {
        std::fprintf(stderr, "popup: unknown diagnostic code \"%.*s\"\n", static_cast<int>(code.size()),
                     code.data());
        broken_invariant("every diagnostic code has a row in code_table()", __FILE__, __LINE__);
    }
    // Allowing a code hides what it says of doubtful things; it never turns an error into silence.
    const bool allowed =
        severity != Severity::error && policy_.allow.contains(code) && !policy_.deny.contains(code);
    if (!allowed) severity = under_policy(policy_, severity, code);
    Diagnostic made{severity, std::string(code), file_, place, std::move(message), {}, {}, {}, {}};
    if (!allowed) {
        errors_ += severity == Severity::error ? 1 : 0;
        findings_ += severity != Severity::remark ? 1 : 0;
    }
    if (++counts_[{made.code, severity}] > kLimit) {
        overflow_ = std::move(made);
        return overflow_;
    }
    return list_.emplace_back(Entry{std::move(made), allowed}).diagnostic;
}

Diagnostic& Diagnostics::error(std::string_view code, Place place, std::string message) {
    return add(Severity::error, code, place, std::move(message));
}

Diagnostic& Diagnostics::warning(std::string_view code, Place place, std::string message) {
    return add(Severity::warning, code, place, std::move(message));
}

Diagnostic& Diagnostics::remark(std::string_view code, Place place, std::string message) {
    return add(Severity::remark, code, place, std::move(message));
}

std::vector<Diagnostic> Diagnostics::sorted() const {
    std::vector<Diagnostic> result;
    for (const Entry& entry : list_) {
        if (!entry.allowed) result.push_back(entry.diagnostic);
    }
    std::stable_sort(result.begin(), result.end(), [](const Diagnostic& a, const Diagnostic& b) {
        return std::tuple(-static_cast<int>(a.severity), a.place.line, a.place.column) <
               std::tuple(-static_cast<int>(b.severity), b.place.line, b.place.column);
    });
    for (const auto& [key, count] : counts_) {
        const auto& [code, severity] = key;
        if (count <= kLimit) continue;
        if (severity != Severity::error && policy_.allow.contains(code)) continue;
        result.push_back(further_findings(code, file_, {count - kLimit, severity}));
    }
    return result;
}

std::vector<Diagnostic> Diagnostics::repairs() const {
    std::vector<Diagnostic> result;
    for (const Entry& entry : list_) {
        if (entry.diagnostic.change) result.push_back(entry.diagnostic);
    }
    return result;
}

void broken_invariant(const char* what, const char* file, int line) {
    std::fprintf(stderr, "popup: broken invariant: %s (%s:%d)\n", what, file, line);
    std::abort();
}

}  // namespace popup
