// Runs a FlatLang program.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "input/flatlang/builtin.h"
#include "input/flatlang/card.h"
#include "input/flatlang/folders.h"
#include "input/flatlang/trail.h"
#include "input/flatlang/turtle.h"
#include "input/flatlang/value.h"
#include "popup/language.h"

namespace popup::flatlang {

// How a program ended.
enum class RunStatus {
    ok,
    parse_fail,    // its text has errors; in 2008 mode what could be read was run
    runtime_fail,  // it was ended by an error
    timeout,       // it was ended by a limit
};

// A file that a program asked for, which is not written.
struct AskedFile {
    std::string name;
    Place place;
};

struct ProgramRun {
    RunStatus status = RunStatus::ok;
    std::string printed;
    Trail trail;  // without polygons when it was ended early
    std::optional<Card> card;
    std::vector<AskedFile> hpgl,
        laser;  // in the order of the calls; the last of each is what the original wrote
    bool part_mode = false;
    std::vector<std::string> files;  // that were loaded, but for the kit's
    std::set<std::string> missing;   // that were looked for in vain
};

// Runs the program within its limits; when its own text has been run to the end, the function __at_end() that
// a file of the kit may have defined. Errors, located, also in loaded files (by their names): those of
// parse(), `flatlang-runtime` (what cannot be done), `flatlang-limit` (which limit, and the option that moves
// it). Warnings: `flatlang-unknown-function`, `flatlang-argument-count`, `flatlang-not-loaded`, each place
// once. Remarks: none. In 2008 mode a failure within a loaded file or evaluated text ends only that, as it
// did.
ProgramRun run_program(const Source& source, const ReadOptions& options, Diagnostics& diagnostics);

// A program while it runs: what builtins see of it.
class Interpreter {
 public:
    Interpreter(const Source& source, const ReadOptions& options, Diagnostics& diagnostics);
    ~Interpreter();
    Interpreter(const Interpreter&) = delete;
    Interpreter& operator=(const Interpreter&) = delete;
    ProgramRun run();

    Heap heap;
    Symbols symbols;
    Turtle turtle;
    Card card;
    ProgramRun result;

    [[nodiscard]] bool as_2008() const;
    // Counts work beside evaluation: elements copied or compared. The program fails at the limit.
    void spend(std::uint64_t steps);
    // Ends the program with an error at this place; returns nil, for `return in.fail(…)`. Later failures
    // while the program winds up are not told.
    Value fail(Place place, std::string what, std::string hint = {});
    // Likewise, for what the kit finds wrong: told of the program's own call alone.
    Value fail_program(Place place, std::string what, std::string hint);
    // Where in the program the outermost call that goes on is said to stand, for findings.
    void blame(Place place);
    // Ends the program: `what` is used up. `option` is the one that moves the limit.
    [[noreturn]] Value fail_limit(Place place, std::string what, std::string_view option);
    // Once a place and code. Nothing in 2008 mode, where there were none.
    void warn(std::string_view code, Place place, std::string what, std::string hint = {});
    // Appends a line to what is printed; counts it against the limit.
    void print(std::string_view line, Place place);
    // Checks the trail against its limit. The program fails beyond it.
    void check_trail(Place place);

    // The same for a text that is about to be kept; its length counts as steps, too.
    void check_text(std::string_view text, Place place);

    // Variables, as assignments and names in the program see them. lookup() is nil when there is none.
    Value lookup(int symbol);
    void assign(int symbol, Value value);
    // The value of the last expression that was a statement, as a function returns it.
    Value lookup_returned();
    // A copy as lists take elements in; its cells count as steps.
    Value copied(const Value& value, Place place);
    void warn_unknown_function(int symbol, Place place);
    // The place in the program itself that a place in any of its texts comes down to.
    [[nodiscard]] Place program_place(Place place) const { return located(place).first; }
    // The member of that name, or what stands in its place (n of lists, x, y and z of vectors); empty: none.
    Value member(const Value& of, int symbol);
    // load(): finds, reads and runs a file; a warning where there is none.
    void load(std::string_view name, Place place);
    // eval(): runs a text; returns what its last expression was.
    Value evaluate_text(const std::string& text, Place place);

    struct State;  // state.h

 private:
    [[nodiscard]] std::pair<Place, std::string> located(Place place) const;
    Value fail_at(Place place, std::string what, std::string hint);
    Value run_text(std::string name, const std::string& text, Place place);
    void define_globals();
    void tell_unused_definitions();
    void run_program_text();
    std::unique_ptr<State> state_;
};

}  // namespace popup::flatlang
