// What the compiler has to say, collected; nothing here prints.
//
// A diagnostic has a severity, a stable kebab-case code, a place in a source, one sentence with the numbers
// in it, and hints that say what would mend it. Stages collect; a stage that must not go on returns nullopt.
#pragma once

#include <cstddef>
#include <list>
#include <map>
#include <memory>
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

// What a document itself says of a finding that is meant to be: findings of this code are dropped, unless
// they are errors or denied by the policy.
struct Allowance {
    std::string code;  // of code_table()
    Place place;       // where it is written
    // The element it is for, from its first character to behind its last. It covers findings that have their
    // place or a related one in there, or that name the element. nullopt: it is for the whole file.
    std::optional<std::pair<Place, Place>> within;
    std::string element;  // that element's id; empty: none, or the whole file
    bool used = false;    // a finding was concerned, even if it stays because the policy denies it
};

// The findings on one file, in the order they were found. After 100 findings of one code and severity further
// ones are only counted, so that a hostile document cannot fill the memory; sorted() adds one line that says
// how many.
class Diagnostics {
 public:
    explicit Diagnostics(std::string file = {});
    Diagnostics(std::string file, DiagnosticPolicy policy);

    // Adds a finding. `code` must stand in code_table(); an unknown one is a broken invariant and aborts.
    // The reference stays valid as long as this object. All findings after the 100th of their code and
    // severity share one place: the next of them overwrites the one before.
    Diagnostic& add(Severity severity, std::string_view code, Place place, std::string message);
    Diagnostic& error(std::string_view code, Place place, std::string message);
    Diagnostic& warning(std::string_view code, Place place, std::string message);
    Diagnostic& remark(std::string_view code, Place place, std::string message);

    [[nodiscard]] bool has_errors() const { return errors_ > 0; }
    // Whether a finding was added as an error, and not made one by the policy. Then a stage must not go on;
    // what the policy alone denies fails the run, and leaves the stages as they are without it.
    [[nodiscard]] bool has_errors_as_given() const { return given_errors_ > 0; }
    [[nodiscard]] bool has_findings() const { return findings_ > 0; }  // warnings or errors
    [[nodiscard]] const std::string& file() const { return file_; }
    // From now on, places are those of `file`, from which file() was made. Findings still name file(); a hint
    // says where in the other file to look.
    void set_places_file(const std::string& file) { places_file_ = file; }
    [[nodiscard]] const DiagnosticPolicy& policy() const { return *policy_; }
    // Takes in what the document allows. What is for the whole file is dropped from now on; what is for an
    // element with the next apply_allowances(), because a finding is complete only after add(). Of several
    // that say the same of the whole file, the first is used.
    void allow(Allowance allowance);
    // Drops the findings that allowances for elements concern. Of what is only counted (see above), nothing
    // is dropped here.
    void apply_allowances();
    [[nodiscard]] const std::vector<Allowance>& allowances() const { return allowances_; }
    // Everything, worst first; within a severity by place, then as found.
    [[nodiscard]] std::vector<Diagnostic> sorted() const;
    // The repairs (diagnostics with a change) in the order they were made, allowed ones included: the report
    // names a repair even where the user does not want to be told. At most 100 of one code and severity;
    // sorted() counts the others.
    [[nodiscard]] std::vector<Diagnostic> repairs() const;

 private:
    struct Entry {
        Diagnostic diagnostic;
        bool may_go = true;      // no error as it was given, and not denied
        bool allowed = false;    // dropped; kept for repairs() only
        bool elsewhere = false;  // its places are of places_file_
    };
    void count(Severity severity, int step);
    [[nodiscard]] Allowance* allowance_for_all(std::string_view code);
    std::string file_;
    std::string places_file_;  // empty: file_
    // Thousands of these are held at once, most of them empty: what is seldom there takes no room here.
    std::shared_ptr<const DiagnosticPolicy> policy_;
    std::list<Entry> list_;
    std::list<Diagnostic> overflow_;  // at most one: where findings beyond the limit go
    std::map<std::pair<std::string, Severity>, std::size_t> counts_;
    std::vector<Allowance> allowances_;
    std::map<std::string, std::size_t, std::less<>> for_all_;  // code → the allowance for the whole file
    std::size_t errors_ = 0;
    std::size_t given_errors_ = 0;  // of these, those that the policy has not made
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
