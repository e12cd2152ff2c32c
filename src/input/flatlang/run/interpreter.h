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

#include "input/flatlang/folders.h"
#include "input/flatlang/run/builtin.h"
#include "input/flatlang/run/card.h"
#include "input/flatlang/run/value.h"
#include "input/flatlang/turtle/trail.h"
#include "input/flatlang/turtle/turtle.h"
#include "popup/language.h"

namespace popup::flatlang {

// How a program ended.
enum class RunStatus {
    ok,
    parse_fail,    // its text has errors; in 2008 mode what could be read was run
    runtime_fail,  // it was ended by an error
    timeout,       // it was ended by a limit
};

// "ok", "parse-fail", "runtime-fail", "timeout".
std::string_view to_string(RunStatus status);

// A file that a program asked for, which is not written.
struct AskedFile {
    std::string name;
    Place place;
};

// The sheet of cuts and folds that a program draws.
struct ProgramSheet {
    CreasePattern pattern;  // without file and stem
    Place place;            // of the call that began it
    double unit_mm = 25.4;  // of its points
    std::size_t points = 0;
};

struct ProgramRun {
    RunStatus status = RunStatus::ok;
    std::string printed;
    Trail trail;  // without polygons when it was ended early
    std::optional<Card> card;
    std::optional<ProgramSheet> sheet;
    std::vector<AskedFile> hpgl,
        laser;  // in the order of the calls; the last of each is what the original wrote
    bool part_mode = false;
    bool defines = false;            // functions, itself or what it loads
    std::uint64_t steps = 0;         // that it took
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
    // The same for what the turtle has looked up since.
    void spend_looks();
    // Ends the program with an error at this place. Does not return; the type is for `return in.fail(…)`.
    [[noreturn]] Value fail(Place place, const std::string& what, std::string hint = {});
    // Likewise, at an argument of a call: "argument 2 of find() is nil, where a list is expected".
    [[noreturn]] Value fail_argument(const Call& call, std::size_t argument, const std::string& what,
                                     std::string hint = {});
    [[noreturn]] Value fail_type(const Call& call, std::size_t argument, std::string_view wanted,
                                 std::string hint = {});
    // Likewise, for what the kit finds wrong: told of the program's own call alone.
    [[noreturn]] Value fail_program(Place place, std::string what, std::string hint);
    // Where in the program the outermost call that goes on is said to stand, for findings.
    void blame(Place place);
    // Ends the program: `what` is used up. `option` is the one that moves the limit; empty: none does.
    [[noreturn]] Value fail_limit(Place place, const std::string& what, std::string_view option);
    // Once a place and code. Nothing in 2008 mode, where there were none.
    void warn(std::string_view code, Place place, const std::string& what, std::string hint = {});
    // Appends a line to what is printed; counts it against the limit.
    void print(std::string_view line, Place place);
    // Checks the trail against its limit. The program fails beyond it.
    void check_trail(Place place);
    // The same for a text, as long as one may be.
    void check_text(std::string_view text, Place place);
    [[nodiscard]] std::uint64_t longest_text() const;
    // What a value is as text; its length counts as steps. The program fails where it is too long.
    std::string text_of(const Value& value, Place place);
    // Equal texts; what is compared counts as steps.
    bool same_text(const Value& a, const Value& b, Place place);

    // Variables, as assignments and names in the program see them. lookup() is nil when there is none.
    Value lookup(int symbol);
    void assign(int symbol, Value value);
    void set_member(Cell& of, int symbol, Value value);
    // True of the program's first assignment at its top level to what -D has set: it is not to be done.
    bool keeps_definition(int symbol);
    // The value of the last expression that was a statement, as a function returns it.
    Value lookup_returned();
    // A copy as lists take elements in. The cells of a list count as steps, of other values every eighth
    // does.
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
    // A place in a text, as `callers` have led there.
    struct Position {
        const Syntax* unit = nullptr;
        std::size_t callers = 0;
        Place place;
    };
    // Where a finding stands for the user, and what its message begins with.
    [[nodiscard]] std::pair<Place, std::string> located(Position at) const;
    [[nodiscard]] std::pair<Place, std::string> located(Place place) const;
    [[noreturn]] Value fail_at(Place place, std::string what, std::string hint);
    // Reads a loaded file or an evaluated text; ends the program where it is none, but for 2008 mode.
    const Syntax& read_text(std::string name, const std::string& text, Place place, bool& complete);
    Value run_unit(const Syntax& unit, Place place);
    void define_globals();
    void tell_unused_definitions();
    void tell_unknown_names();
    void run_program_text();
    std::unique_ptr<State> state_;
};

}  // namespace popup::flatlang
