#include "popup/diagnostics.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <tuple>
#include <utility>

#include "base/diagnostics/further_findings.h"

namespace popup {
namespace {

constexpr std::size_t kLimit = 100;

Severity under_policy(const DiagnosticPolicy& policy, Severity severity, std::string_view code) {
    if (policy.deny.contains(code)) return Severity::error;
    if (severity == Severity::warning && policy.warnings_are_errors) return Severity::error;
    return severity;
}

std::shared_ptr<const DiagnosticPolicy> no_policy() {
    static const auto none = std::make_shared<const DiagnosticPolicy>();
    return none;
}

bool concerns(const Allowance& allowance, const Diagnostic& found) {
    if (!allowance.element.empty() && found.element == allowance.element) return true;
    const auto& [begin, end] = *allowance.within;
    const auto inside = [&, begin = begin, end = end](Place place) {
        const auto key = [](Place at) { return std::pair(at.line, at.column); };
        return place.line > 0 && key(begin) <= key(place) && key(place) < key(end);
    };
    return inside(found.place) || std::any_of(found.related.begin(), found.related.end(),
                                              [&](const Related& one) { return inside(one.place); });
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

Diagnostics::Diagnostics(std::string file) : file_(std::move(file)), policy_(no_policy()) {}

Diagnostics::Diagnostics(std::string file, DiagnosticPolicy policy)
    : file_(std::move(file)), policy_(std::make_shared<const DiagnosticPolicy>(std::move(policy))) {}

Diagnostic& Diagnostics::add(Severity severity, std::string_view code, Place place, std::string message) {
    if (find_code(code) == nullptr) {
        std::fprintf(stderr, "popup: unknown diagnostic code \"%.*s\"\n", static_cast<int>(code.size()),
                     code.data());
        broken_invariant("every diagnostic code has a row in code_table()", __FILE__, __LINE__);
    }
    if (severity == Severity::error) ++given_errors_;
    // Allowing a code hides what it says of doubtful things; it never turns an error into silence.
    const bool may_go = severity != Severity::error && !policy_->deny.contains(code);
    Allowance* for_all = severity != Severity::error ? allowance_for_all(code) : nullptr;
    if (for_all != nullptr) for_all->used = true;
    const bool allowed = may_go && (policy_->allow.contains(code) || for_all != nullptr);
    if (!allowed) severity = under_policy(*policy_, severity, code);
    // Messages quote inputs and libraries, which may have line breaks; readers of findings count on lines.
    std::replace_if(
        message.begin(), message.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
    Diagnostic made{severity, std::string(code), file_, place, std::move(message), {}, {}, {}, {}};
    if (!allowed) count(severity, 1);
    if (++counts_[{made.code, severity}] > kLimit) {
        // In its place for good: somebody may still hold the one before.
        if (overflow_.empty()) overflow_.emplace_back();
        return overflow_.front() = std::move(made);
    }
    return list_
        .emplace_back(Entry{std::move(made), may_go, allowed, !places_file_.empty() && places_file_ != file_})
        .diagnostic;
}

void Diagnostics::count(Severity severity, int step) {
    if (severity == Severity::error) errors_ += static_cast<std::size_t>(step);
    if (severity != Severity::remark) findings_ += static_cast<std::size_t>(step);
}

Allowance* Diagnostics::allowance_for_all(std::string_view code) {
    const auto at = for_all_.find(code);
    return at == for_all_.end() ? nullptr : &allowances_[at->second];
}

void Diagnostics::allow(Allowance allowance) {
    if (!allowance.within) for_all_.emplace(allowance.code, allowances_.size());
    allowances_.push_back(std::move(allowance));
}

void Diagnostics::apply_allowances() {
    std::multimap<std::string_view, Allowance*> for_elements;
    for (Allowance& one : allowances_) {
        if (one.within) for_elements.emplace(one.code, &one);
    }
    if (for_elements.empty()) return;
    for (Entry& entry : list_) {
        // What the policy has dropped still shows that an allowance is for something.
        if (!entry.may_go && !policy_->deny.contains(entry.diagnostic.code)) continue;
        const auto [first, last] = for_elements.equal_range(entry.diagnostic.code);
        for (auto at = first; at != last; ++at) {
            if (!concerns(*at->second, entry.diagnostic)) continue;
            at->second->used = true;
            if (!entry.may_go || entry.allowed) continue;
            entry.allowed = true;
            count(entry.diagnostic.severity, -1);
        }
    }
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

namespace {

// Places of another file, in words.
void say_places(const std::string& file, Diagnostic& told) {
    const auto at = [&file](Place place) {
        return file + ":" + std::to_string(place.line) + ":" + std::to_string(place.column);
    };
    for (Related& other : told.related) {
        if (other.place.line > 0) other.text += " (" + at(other.place) + ")";
        other.place = {};
    }
    if (told.place.line > 0) told.hints.insert(told.hints.begin(), "its source is at " + at(told.place));
    told.place = {};
}

}  // namespace

std::vector<Diagnostic> Diagnostics::sorted() const {
    std::vector<Diagnostic> result;
    for (const Entry& entry : list_) {
        if (entry.allowed) continue;
        result.push_back(entry.diagnostic);
        if (entry.elsewhere) say_places(places_file_, result.back());
    }
    std::stable_sort(result.begin(), result.end(), [](const Diagnostic& a, const Diagnostic& b) {
        return std::tuple(-static_cast<int>(a.severity), a.place.line, a.place.column) <
               std::tuple(-static_cast<int>(b.severity), b.place.line, b.place.column);
    });
    for (const auto& [key, count] : counts_) {
        const auto& [code, severity] = key;
        if (count <= kLimit) continue;
        if (severity != Severity::error && (policy_->allow.contains(code) || for_all_.contains(code)))
            continue;
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
