// What the compiler has to say, collected; nothing here prints.
//
// A diagnostic has a severity, a stable kebab-case code, a place in a source, one sentence with the numbers
// in it, and hints that say what would mend it. Stages collect; a stage that must not go on returns nullopt.
#pragma once

#include <cstddef>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace popup {

enum class Severity { remark, warning, error };
std::string_view to_string(Severity severity);

// Where something stands. Line and column count from 1; 0 means the whole file. Columns count characters
// (code points), so that editors agree.
struct Place {
    int line = 0;
    int column = 0;
    friend bool operator==(const Place&, const Place&) = default;
};

// What a repair did, in words a person can compare ("(10.00, 25.40) mm").
struct Change {
    std::string before;
    std::string after;
};

// Another place that a finding concerns: "fire" at 12:5.
struct Related {
    Place place;
    std::string text;  // what stands there, a few words
};

struct Diagnostic {
    Severity severity = Severity::error;
    std::string code;  // a code of code_table()
    std::string file;  // as named on the command line
    Place place;
    std::string message;  // one sentence, no final full stop, no line break
    std::vector<std::string> hints;
    std::string element;           // id of the element concerned; empty when there is none
    std::optional<Change> change;  // present exactly on repairs
    std::vector<Related> related;  // in the same file

    // Chainable, so that a finding reads as one expression.
    Diagnostic& hint(std::string text);
    Diagnostic& about(std::string id);
    Diagnostic& with(Place place, std::string text);  // adds to `related`
    Diagnostic& changed(std::string before, std::string after);
};

// How severities are raised or dropped: --deny, --allow, --werror.
struct DiagnosticPolicy {
    std::set<std::string, std::less<>> deny;   // these become errors
    std::set<std::string, std::less<>> allow;  // these are dropped, unless they are errors
    bool warnings_are_errors = false;
};

// The findings on one file, in the order they were found. After 100 findings of one code and severity further
// ones are only counted, so that a hostile document cannot fill the memory; sorted() adds one line that says
// how many.
class Diagnostics {
 public:
    explicit Diagnostics(std::string file = {}, DiagnosticPolicy policy = {});

    // Adds a finding. `code` must stand in code_table(); an unknown one is a broken invariant and aborts.
    // The reference stays valid as long as this object.
    Diagnostic& add(Severity severity, std::string_view code, Place place, std::string message);
    Diagnostic& error(std::string_view code, Place place, std::string message);
    Diagnostic& warning(std::string_view code, Place place, std::string message);
    Diagnostic& remark(std::string_view code, Place place, std::string message);

    [[nodiscard]] bool has_errors() const { return errors_ > 0; }
    [[nodiscard]] bool has_findings() const { return findings_ > 0; }  // warnings or errors
    [[nodiscard]] const std::string& file() const { return file_; }
    [[nodiscard]] const DiagnosticPolicy& policy() const { return policy_; }
    // Everything, worst first; within a severity by place, then as found.
    [[nodiscard]] std::vector<Diagnostic> sorted() const;
    // All repairs (diagnostics with a change) in the order they were made, allowed ones included: a repair is
    // never silent, the report names it even where the user does not want to be told.
    [[nodiscard]] std::vector<Diagnostic> repairs() const;

 private:
    std::string file_;
    DiagnosticPolicy policy_;
    struct Entry {
        Diagnostic diagnostic;
        bool allowed = false;  // dropped by the policy; kept for repairs() only
    };
    std::deque<Entry> list_;
    std::map<std::pair<std::string, Severity>, std::size_t> counts_;
    Diagnostic overflow_;  // where findings beyond the limit go
    std::size_t errors_ = 0;
    std::size_t findings_ = 0;
};

// One row a code: what `popupc explain` and `popupc list codes` say.
struct CodeInfo {
    std::string_view code;
    Severity severity;             // as it is first given
    std::string_view summary;      // half a sentence, for the list
    std::string_view explanation;  // a paragraph: what it means, why it matters, what mends it
};
// All codes, sorted by name.
std::span<const CodeInfo> code_table();
// The row of `code`, or null.
const CodeInfo* find_code(std::string_view code);

// An always-on assertion for our own invariants: a crash beats a wrong cut sheet.
[[noreturn]] void broken_invariant(const char* what, const char* file, int line);
#define POPUP_INVARIANT(condition) \
    ((condition) ? void() : ::popup::broken_invariant(#condition, __FILE__, __LINE__))

}  // namespace popup
