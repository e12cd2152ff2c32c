// What only the interpreter itself knows of a running program.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <set>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "input/flatlang/run/interpreter.h"
#include "input/flatlang/run/scopes.h"
#include "input/flatlang/syntax/parse.h"

namespace popup::flatlang {

// Thrown by Interpreter::fail() once the finding has been told; never leaves run_program().
struct Stopped {
    RunStatus status = RunStatus::runtime_fail;
};

// A call that is going on: who called, and where.
struct Caller {
    const Syntax* unit = nullptr;
    Place place;
    const Node* call = nullptr;  // null: a text is run
    int function = -1;           // the symbol of what is called
};

struct Interpreter::State {
    State(const Source& source_, const ReadOptions& options_, Diagnostics& diagnostics_);

    const Source& source;
    const ReadOptions& options;
    Diagnostics& diagnostics;
    Folders folders;
    std::deque<Syntax> units;  // texts that were read; functions refer to them
    // Files that were loaded: one that is loaded again is not read again.
    struct Loaded {
        std::string text;
        const Syntax* syntax = nullptr;
    };
    std::map<std::string, Loaded> loaded;
    const Syntax* prelude = nullptr;
    const Syntax* program = nullptr;
    const Syntax* unit = nullptr;  // in which the evaluation is
    std::vector<Caller> callers;
    Scopes scopes;
    // Objects whose methods run, and values whose members are read: the newest is the first place for reads
    // and the only one for writes.
    std::vector<Value> objects;

    std::uint64_t steps = 0;
    std::uint64_t copies = 0;  // of elements of lists, some of which are a step
    std::uint64_t nodes = 0;   // of loaded files and evaluated texts that are kept: they count as values
    std::uint64_t turtle_looks = 0;  // that were counted as steps
    std::uint64_t nesting = 0;       // of evaluations in each other
    std::uint64_t calls = 0;
    int running = 0;           // texts that run in each other, the program the first of them
    int evaluating = 0;        // of these, texts given to eval()
    const Node* at = nullptr;  // what is evaluated
    // The innermost loop that goes on, and the text it stands in.
    struct Loop {
        const Syntax* unit = nullptr;
        const Node* node = nullptr;
    };
    Loop loop;
    std::set<std::tuple<std::string, int, int>> warned;
    struct Definition {
        int symbol = -1;
        bool fixed = true;  // its first assignment at the top level is still to come
        bool used = false;
    };
    std::vector<Definition> definitions;

    // Symbols that mean something.
    int returned = -1;  // __return__
    int count = -1;     // n
    int x = -1, y = -1, z = -1;
    int text = -1;  // __str__
    int quote = -1;
    int arguments = -1;  // __arguments: a function whose only parameter is this takes any number
    int at_end = -1;     // __at_end: a function of this name is called when the program has ended
    bool failed = false;

    // Null: none is of this name.
    const Builtin* builtin_of(int symbol, const Symbols& symbols);
    std::vector<std::optional<const Builtin*>> builtins;  // by symbol, as far as they were asked for
};

// Levels of evaluations in each other for each call that is allowed: what the stack must hold.
inline constexpr std::uint64_t kLevelsPerCall = 20;
inline constexpr std::uint64_t kLevelsBesides = 1000;
inline constexpr std::uint64_t kMostCalls = 100'000;
// Loaded files and evaluated texts within each other.
inline constexpr int kMostTextsWithin = 100;
// What reading costs in steps, about as long as these take: looking for a file; a byte of it; a text to be
// evaluated; a byte of it.
inline constexpr std::uint64_t kStepsPerLoad = 500;
inline constexpr std::uint64_t kStepsPerLoadedByte = 1;
inline constexpr std::uint64_t kStepsPerEval = 50;
inline constexpr std::uint64_t kStepsPerEvaluatedByte = 4;
// Bytes of a text that are compared or copied in one step, operations of the turtle that are looked at,
// elements of lists that are copied, and members.
inline constexpr std::uint64_t kBytesPerStep = 32;
inline constexpr std::uint64_t kLooksPerStep = 4;
inline constexpr std::uint64_t kCopiesPerStep = 8;
inline constexpr std::uint64_t kMembersPerStep = 16;

// Runs a block of `unit`, or evaluates an expression of it. Throws Stopped.
class Evaluation {
 public:
    Evaluation(Interpreter& in, Interpreter::State& state) : in_(in), state_(state) {}
    void run_statements(const Syntax& unit, int block);
    // What loaded files have left for the end of the program, if they have.
    void run_at_end();

 private:
    // One evaluation within others.
    struct Level {
        explicit Level(Interpreter::State& state_) : state(state_) { ++state.nesting; }
        ~Level() { --state.nesting; }
        Level(const Level&) = delete;
        Level& operator=(const Level&) = delete;
        Interpreter::State& state;
    };
    [[nodiscard]] const Node& node(int index) const;
    void tick(const Node& at);
    int need(const Node& parent, std::size_t child);

    // Goes round within a loop: what ends there is told with it.
    struct Round {
        Round(Interpreter::State& state_, const Node& loop)
            : state(state_), around(std::exchange(state_.loop, {state_.unit, &loop})) {}
        ~Round() { state.loop = around; }
        Round(const Round&) = delete;
        Round& operator=(const Round&) = delete;
        Interpreter::State& state;
        Interpreter::State::Loop around;
    };

    void run(int index);
    void run_block(int index);
    void choose(const Node& at);
    void loop_while(const Node& at);
    void repeat(const Node& at);
    void for_each(const Node& at);
    void shape(const Node& at);
    void from(const Node& at);
    void replace(const Node& at);
    void define(int index);

    Value evaluate(int index);
    Value assign(const Node& at);
    Value call(const Node& at);
    Value call_function(const Node& at, const Value& function, std::span<Value> arguments);
    Value run_function(const Node& at, const FunctionBody& body, std::span<const Value> arguments);
    Value element(const Node& at);
    Value list(const Node& at);
    Value list_of(std::span<const Value> values, Place place);
    Value member(const Node& at);
    Value negated(const Node& at);
    Value arithmetic(const Node& at);
    Value comparison(const Node& at);
    double number_of(int index);
    std::string text_of(int index);
    bool truth_text(int index);

    Interpreter& in_;
    Interpreter::State& state_;
};

}  // namespace popup::flatlang
