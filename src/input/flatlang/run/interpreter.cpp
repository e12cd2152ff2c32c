#include "input/flatlang/run/interpreter.h"

#include <fmt/format.h>
#include <pthread.h>

#include <algorithm>
#include <exception>
#include <tuple>
#include <utility>

#include "input/flatlang/run/state.h"
#include "input/flatlang/run/unknown_names.h"
#include "input/text.h"

namespace popup::flatlang {
namespace {

// What one level of evaluation takes of the stack, at the most; sanitizers need more.
#if defined(__SANITIZE_ADDRESS__)
constexpr std::size_t kStackPerLevel = 6144;
#else
constexpr std::size_t kStackPerLevel = 1280;
#endif
constexpr std::size_t kStackBesides = 16U << 20;

constexpr std::string_view kPreludeName = "prelude";
// What evaluated texts are called in findings.
constexpr std::string_view kEvaluated = "eval";

Value definition_value(Heap& heap, const std::string& text) {
    if (text == "true" || text == "false") return heap.truth(text == "true");
    const bool number = text.find_first_not_of("+-.0123456789eE") == std::string::npos &&
                        text.find_first_of("0123456789") != std::string::npos;
    return number ? heap.number(text_number(text)) : heap.text(text);
}

}  // namespace

std::string_view to_string(RunStatus status) {
    switch (status) {
        case RunStatus::ok:
            return "ok";
        case RunStatus::parse_fail:
            return "parse-fail";
        case RunStatus::runtime_fail:
            return "runtime-fail";
        case RunStatus::timeout:
            return "timeout";
    }
    return "";
}

Interpreter::State::State(const Source& source_, const ReadOptions& options_, Diagnostics& diagnostics_)
    : source(source_), options(options_), diagnostics(diagnostics_), folders(source_, options_.program) {}

const Builtin* Interpreter::State::builtin_of(int symbol, const Symbols& symbols) {
    const auto index = static_cast<std::size_t>(symbol);
    if (index >= builtins.size()) builtins.resize(index + 1);
    if (!builtins[index]) builtins[index] = find_builtin(symbols.name(symbol));
    return *builtins[index];
}

Interpreter::Interpreter(const Source& source, const ReadOptions& options, Diagnostics& diagnostics)
    : turtle(options.program.as_2008, options.program.limits.trail),
      state_(std::make_unique<State>(source, options, diagnostics)) {
    State& s = *state_;
    s.returned = symbols.of("__return__");
    s.count = symbols.of("n");
    s.x = symbols.of("x");
    s.y = symbols.of("y");
    s.z = symbols.of("z");
    s.text = symbols.of("__str__");
    s.quote = symbols.of("quote");
    s.arguments = symbols.of("__arguments");
    s.at_end = symbols.of("__at_end");
}

Interpreter::~Interpreter() = default;

bool Interpreter::as_2008() const { return state_->options.program.as_2008; }

// What happens in other texts is told at the call in the program that led there; what happens in the prelude
// at the call of its function, wherever that is.
std::pair<Place, std::string> Interpreter::located(Position at) const {
    const State& s = *state_;
    const auto go_up = [&] {
        const Caller& caller = s.callers[--at.callers];
        at.unit = caller.unit;
        at.place = caller.place;
    };
    while (at.unit == s.prelude && at.callers > 0) go_up();
    if (at.unit == nullptr || at.unit == s.program) return {at.place, {}};
    const auto told = [&at] {
        return fmt::format("{}:{}:{}: ", at.unit->file, at.place.line, at.place.column);
    };
    std::string where = told();
    const Position inner = at;
    // Nobody can look up an evaluated text, so the call that evaluated it is named before it.
    while (at.unit->file == kEvaluated && at.callers > 0) {
        go_up();
        while (at.unit == s.prelude && at.callers > 0) go_up();
        if (at.unit == s.program || at.unit == s.prelude) break;
        where.insert(0, told());
    }
    while (at.unit != s.program && at.callers > 0) go_up();
    // A program that loads itself comes by the same place again.
    if (at.unit == s.program && inner.unit->file == at.unit->file && inner.place == at.place) where.clear();
    return {at.unit == s.program ? at.place : Place{}, std::move(where)};
}

std::pair<Place, std::string> Interpreter::located(Place place) const {
    return located({state_->unit, state_->callers.size(), place});
}

Value Interpreter::fail(Place place, const std::string& what, std::string hint) {
    const auto [at, where] = located(place);
    fail_at(at, where + what, std::move(hint));
}

Value Interpreter::fail_argument(const Call& call, std::size_t argument, const std::string& what,
                                 std::string hint) {
    const State& s = *state_;
    Position position{s.unit, s.callers.size(), call.place};
    const Node* node = &call.node;
    // The prelude's functions hand on their arguments as they come.
    if (position.unit == s.prelude && !s.callers.empty() && s.callers.back().call != nullptr) {
        --position.callers;
        position.unit = s.callers.back().unit;
        node = s.callers.back().call;
    }
    position.place = node->place;
    if (argument < node->children.size() && node->children[argument] != kMissing) {
        position.place = position.unit->nodes[static_cast<std::size_t>(node->children[argument])].place;
    }
    const auto [at, where] = located(position);
    fail_at(at, where + what, std::move(hint));
}

Value Interpreter::fail_type(const Call& call, std::size_t argument, std::string_view wanted,
                             std::string hint) {
    fail_argument(call, argument,
                  fmt::format("argument {} of {}() is {}, where {} is expected", argument + 1, call.name,
                              type_name(call.arguments[argument]->type), wanted),
                  std::move(hint));
}

Value Interpreter::fail_program(Place place, std::string what, std::string hint) {
    fail_at(program_place(place), std::move(what), std::move(hint));
}

void Interpreter::blame(Place place) {
    if (!state_->callers.empty()) state_->callers.front().place = place;
}

Value Interpreter::fail_at(Place place, std::string what, std::string hint) {
    State& s = *state_;
    // What the original swallowed is no error of the program.
    const Severity severity = as_2008() && s.running > 1 ? Severity::warning : Severity::error;
    Diagnostic& told = s.diagnostics.add(severity, "flatlang-runtime", place, std::move(what));
    if (!hint.empty()) told.hint(std::move(hint));
    throw Stopped{RunStatus::runtime_fail};
}

Value Interpreter::fail_limit(Place place, const std::string& what, std::string_view option) {
    const auto [at, where] = located(place);
    Diagnostic& told = state_->diagnostics.error("flatlang-limit", at, where + what);
    const State::Loop& loop = state_->loop;
    if (loop.node != nullptr && loop.unit == state_->program) {
        told.hint(fmt::format("the innermost loop that goes on begins at {}:{}", loop.node->place.line,
                              loop.node->place.column));
    }
    if (!option.empty()) told.hint(fmt::format("if it shall do so, {} N allows more", option));
    throw Stopped{RunStatus::timeout};
}

void Interpreter::spend(std::uint64_t steps) {
    State& s = *state_;
    const std::uint64_t most = s.options.program.limits.steps;
    s.steps += steps;
    if (s.steps <= most) return;
    s.steps = most;
    const Place place = s.at != nullptr ? s.at->place : Place{};
    fail_limit(place, fmt::format("the program has taken {} steps", most), "--max-steps");
}

void Interpreter::spend_looks() {
    State& s = *state_;
    const std::uint64_t looks = turtle.looks();
    if (looks < s.turtle_looks) s.turtle_looks = 0;  // it was cleared
    const std::uint64_t steps = (looks - s.turtle_looks) / kLooksPerStep;
    s.turtle_looks += steps * kLooksPerStep;
    spend(steps);
}

void Interpreter::warn(std::string_view code, Place place, const std::string& what, std::string hint) {
    if (as_2008()) return;
    State& s = *state_;
    const auto [at, where] = located(place);
    if (!s.warned.insert({std::string(code) + where, at.line, at.column}).second) return;
    Diagnostic& told = s.diagnostics.warning(code, at, where + what);
    if (!hint.empty()) told.hint(std::move(hint));
}

void Interpreter::warn_unknown_function(int symbol, Place place) {
    if (as_2008()) return;
    const std::string name = shown(symbols.name(symbol));
    const bool variable = lookup(symbol)->type != Type::nil;
    const std::vector<std::string> like = functions_like(symbols.name(symbol), state_->units, symbols);
    std::string hint;
    if (!variable && kit_file(symbols.name(symbol) + ".fl") != nullptr) {
        hint = fmt::format("load(\"kit/{}.fl\") has it", symbols.name(symbol));
    } else if (!variable && !like.empty() && like.front() != symbols.name(symbol)) {
        hint = fmt::format("did you mean {}()?", fmt::join(like, "() or "));
    } else if (!variable) {
        hint = "a function exists once its define has been run, or its file been loaded";
    }
    warn("flatlang-unknown-function", place,
         variable ? fmt::format("{} is a variable, not a function", name)
                  : fmt::format("there is no function {}() here; the call does nothing", name),
         std::move(hint));
}

void Interpreter::check_text(std::string_view text, Place place) {
    const std::uint64_t most = state_->options.program.limits.text;
    if (text.size() > most) {
        fail_limit(place, fmt::format("a text grows beyond {} bytes", most), "--max-text");
    }
}

std::uint64_t Interpreter::longest_text() const { return state_->options.program.limits.text; }

std::string Interpreter::text_of(const Value& value, Place place) {
    std::string text = to_text(value, symbols, longest_text() + 1);
    check_text(text, place);
    spend(text.size() / kBytesPerStep);
    return text;
}

bool Interpreter::same_text(const Value& a, const Value& b, Place place) {
    if (a->type == Type::text && b->type == Type::text) {
        if (a->text.size() != b->text.size()) return false;
        spend(a->text.size() / kBytesPerStep);
        return a->text == b->text;
    }
    return text_of(a, place) == text_of(b, place);
}

void Interpreter::print(std::string_view line, Place place) {
    check_text(line, place);
    spend(line.size() / kBytesPerStep);
    if (result.printed.size() + line.size() + 1 > state_->options.program.limits.text) {
        fail_limit(place, fmt::format("more than {} bytes are printed", state_->options.program.limits.text),
                   "--max-text");
    }
    result.printed += line;
    result.printed += '\n';
}

void Interpreter::check_trail(Place place) {
    const std::uint64_t most = state_->options.program.limits.trail;
    if (turtle.operations() <= most) return;
    fail_limit(place, fmt::format("the turtle's trail has {} operations", most), "--max-trail");
}

Value Interpreter::member(const Value& of, int symbol) {
    State& s = *state_;
    if (const auto& extras = of->owner().extras) {
        if (extras->members.size() >= kMembersPerStep) spend(extras->members.size() / kMembersPerStep);
        if (const Value* found = of->owner().member(symbol)) return *found;
    }
    if (of->type == Type::list && symbol == s.count) {
        const std::uint64_t n = length(of);
        spend(n / 8);
        return heap.number(static_cast<double>(n));
    }
    if (of->type == Type::vec) {
        const std::array<double, 9>& v = of->extras->numbers;
        if (symbol == s.x) return heap.number(v[0]);
        if (symbol == s.y) return heap.number(v[1]);
        if (symbol == s.z) return heap.number(v[2]);
    }
    return {};
}

Value Interpreter::lookup(int symbol) {
    State& s = *state_;
    if (!s.objects.empty()) {
        if (Value found = member(s.objects.back(), symbol)) return found;
    }
    for (State::Definition& one : s.definitions) {
        if (one.symbol == symbol) one.used = true;
    }
    const Value* found = s.scopes.find(symbol);
    return found != nullptr ? *found : heap.nil();
}

void Interpreter::assign(int symbol, Value value) {
    State& s = *state_;
    if (value->type == Type::function) return s.scopes.bind_function(symbol, std::move(value));
    if (!s.objects.empty()) return set_member(s.objects.back()->owner(), symbol, std::move(value));
    s.scopes.assign(symbol, std::move(value));
}

void Interpreter::set_member(Cell& of, int symbol, Value value) {
    if (of.extras) spend(of.extras->members.size() / kMembersPerStep);
    of.set_member(symbol, std::move(value));
}

bool Interpreter::keeps_definition(int symbol) {
    State& s = *state_;
    if (!s.objects.empty() || !s.callers.empty() || s.running > 1) return false;
    for (State::Definition& one : s.definitions) {
        if (one.symbol != symbol) continue;
        one.used = true;
        return std::exchange(one.fixed, false);
    }
    return false;
}

Value Interpreter::lookup_returned() { return lookup(state_->returned); }

Value Interpreter::copied(const Value& value, Place place) {
    State& s = *state_;
    const ProgramLimits& limits = s.options.program.limits;
    if (value->type != Type::list) {
        // A function of lists may copy one that has millions of elements, or put in as many, between two
        // evaluations.
        if (++s.copies % kCopiesPerStep == 0) spend(1);
        if (heap.size() + s.nodes >= limits.values)
            return fail_limit(place, "a list grows too long", "--max-values");
        std::uint64_t one = 1;
        return heap.copy(value, one);
    }
    const std::uint64_t steps = limits.steps > s.steps ? limits.steps - s.steps : 0;
    const std::uint64_t held = heap.size() + s.nodes;
    const std::uint64_t budget = std::min(steps, limits.values > held ? limits.values - held : 0) + 1;
    std::uint64_t left = budget;
    Value made = heap.copy(value, left);
    if (left == 0) {
        if (budget > steps) spend(budget);
        return fail_limit(place, "a list grows too long, or too deep, to be copied", "--max-values");
    }
    spend(budget - left);
    return made;
}

const Syntax& Interpreter::read_text(std::string name, const std::string& text, Place place, bool& complete) {
    State& s = *state_;
    Diagnostics findings(name);
    Parsed parsed = parse(name, text, {.as_2008 = as_2008()}, symbols, findings);
    const auto [at, where] = located(place);
    for (const Diagnostic& one : findings.sorted()) {
        Diagnostic& told = s.diagnostics.add(
            one.severity, one.code, at,
            fmt::format("{}{}:{}:{}: {}", where, name, one.place.line, one.place.column, one.message));
        for (const std::string& hint : one.hints) told.hint(hint);
    }
    complete = parsed.complete;
    if (!complete && !as_2008()) throw Stopped{RunStatus::runtime_fail};
    s.units.push_back(std::move(parsed.syntax));
    s.nodes += s.units.back().nodes.size();
    return s.units.back();
}

Value Interpreter::run_unit(const Syntax& unit, Place place) {
    State& s = *state_;
    const Node* at = s.at;
    s.callers.push_back({s.unit, place});
    const auto kept = std::make_tuple(s.unit, s.callers.size(), s.objects.size(), s.calls, s.scopes.depth());
    if (++s.running > kMostTextsWithin) {
        fail_limit(
            place,
            fmt::format("loaded files and evaluated texts stand {} deep within each other", kMostTextsWithin),
            {});
    }
    try {
        Evaluation(*this, s).run_statements(unit, unit.root);
    } catch (const Stopped& stopped) {
        if (!as_2008() || stopped.status == RunStatus::timeout) throw;
        s.unit = std::get<0>(kept);
        s.callers.resize(std::get<1>(kept));
        s.objects.resize(std::get<2>(kept));
        s.calls = std::get<3>(kept);
        while (s.scopes.depth() > std::get<4>(kept)) s.scopes.pop();
    }
    --s.running;
    s.callers.pop_back();
    s.at = at;
    turtle.recalculate();
    return lookup_returned();
}

void Interpreter::load(std::string_view name, Place place) {
    State& s = *state_;
    spend(kStepsPerLoad);
    std::string why;
    std::optional<LoadedFile> file = s.folders.find(name, why, &result.missing);
    if (!file) {
        warn("flatlang-not-loaded", place, fmt::format("\"{}\" is not loaded: {}", shown(name), why),
             name.starts_with("kit/") ? "" : "-I DIR names a further folder to look in");
        return;
    }
    if (!file->of_kit &&
        std::find(result.files.begin(), result.files.end(), file->name) == result.files.end()) {
        result.files.push_back(file->name);
    }
    const auto before = s.loaded.find(file->name);
    if (before != s.loaded.end() && before->second.text == file->text) {
        spend(file->text.size() / kBytesPerStep);
        run_unit(*before->second.syntax, place);
        return;
    }
    spend(file->text.size() * kStepsPerLoadedByte);
    bool complete = false;
    const Syntax& unit = read_text(file->name, file->text, place, complete);
    if (complete) s.loaded[file->name] = {std::move(file->text), &unit};
    run_unit(unit, place);
}

Value Interpreter::evaluate_text(const std::string& text, Place place) {
    State& s = *state_;
    spend(kStepsPerEval + text.size() * kStepsPerEvaluatedByte);
    bool complete = false;
    const Syntax& unit = read_text(std::string(kEvaluated), text, place, complete);
    ++s.evaluating;
    Value value = run_unit(unit, place);
    --s.evaluating;
    // What defines nothing is not needed any more.
    const bool defines = std::any_of(unit.nodes.begin(), unit.nodes.end(),
                                     [](const Node& node) { return node.kind == NodeKind::define; });
    if (!defines && &unit == &s.units.back()) {
        s.nodes -= unit.nodes.size();
        s.units.pop_back();
    }
    return value;
}

void Interpreter::define_globals() {
    State& s = *state_;
    for (const auto& [name, value] : s.options.program.definitions) {
        const int symbol = symbols.of(name);
        s.scopes.assign(symbol, definition_value(heap, value));
        const auto known = std::find_if(s.definitions.begin(), s.definitions.end(),
                                        [&](const State::Definition& one) { return one.symbol == symbol; });
        if (known == s.definitions.end()) s.definitions.push_back({symbol, true, false});
    }
}

void Interpreter::tell_unused_definitions() {
    for (const State::Definition& one : state_->definitions) {
        if (one.used) continue;
        const std::string& name = symbols.name(one.symbol);
        Diagnostic& told =
            state_->diagnostics.warning("flatlang-unused-definition", {},
                                        fmt::format("the program has no variable {}, which -D sets", name));
        const std::vector<std::string> like = variables_like(name, state_->units, symbols);
        told.hint(like.empty() ? std::string("names are case-sensitive")
                               : fmt::format("did you mean {}?", fmt::join(like, " or ")));
    }
}

void Interpreter::run_program_text() {
    State& s = *state_;
    Diagnostics none;
    Parsed first = parse(kPreludeName, prelude(), {}, symbols, none);
    if (!first.complete) broken_invariant("the prelude is a program", __FILE__, __LINE__);
    s.units.push_back(std::move(first.syntax));
    s.prelude = &s.units.back();
    Evaluation(*this, s).run_statements(s.units.back(), s.units.back().root);
    s.scopes.push();  // globals
    define_globals();

    Parsed parsed = parse(s.source.name, s.source.text, {.as_2008 = as_2008()}, symbols, s.diagnostics);
    if (!parsed.complete) result.status = RunStatus::parse_fail;
    if (!parsed.complete && !as_2008()) return;
    s.units.push_back(std::move(parsed.syntax));
    s.program = &s.units.back();
    s.running = 1;
    s.steps = 0;
    Evaluation(*this, s).run_statements(*s.program, s.program->root);
    Evaluation(*this, s).run_at_end();
    if (!as_2008()) tell_unused_definitions();
}

void Interpreter::tell_unknown_names() {
    const State& s = *state_;
    if (as_2008() || s.program == nullptr) return;
    std::vector<int> defined;
    for (const State::Definition& one : s.definitions) defined.push_back(one.symbol);
    for (const UnknownName& one : unknown_names(*s.program, s.units, defined, symbols)) {
        Diagnostic& told = s.diagnostics.warning(
            "flatlang-unknown-variable", one.place,
            fmt::format("nothing gives {} a value, so it is nil", shown(symbols.name(one.symbol))));
        if (!one.like.empty()) told.hint(fmt::format("did you mean {}?", fmt::join(one.like, " or ")));
    }
}

ProgramRun Interpreter::run() {
    // Limits may be too narrow for what comes before the program, too.
    try {
        run_program_text();
    } catch (const Stopped& stopped) {
        state_->failed = true;
        if (result.status == RunStatus::ok) result.status = stopped.status;
    }
    tell_unknown_names();
    result.steps = state_->steps;
    result.trail = turtle.trail(!state_->failed);
    // The first of the texts is the prelude.
    result.defines = std::any_of(state_->units.begin() + 1, state_->units.end(), [](const Syntax& unit) {
        return std::any_of(unit.nodes.begin(), unit.nodes.end(),
                           [](const Node& node) { return node.kind == NodeKind::define; });
    });
    if (card.design) result.card = std::move(card);
    heap.abandon();
    return std::move(result);
}

namespace {

struct Errand {
    const Source& source;
    const ReadOptions& options;
    Diagnostics& diagnostics;
    ProgramRun result;
    std::exception_ptr thrown;
};

void* run_errand(void* argument) {
    Errand& errand = *static_cast<Errand*>(argument);
    try {
        Interpreter in(errand.source, errand.options, errand.diagnostics);
        errand.result = in.run();
    } catch (...) {
        errand.thrown = std::current_exception();
    }
    return nullptr;
}

}  // namespace

// Evaluation recurses as deep as the program calls, so it has a stack of its own that the limits fit into.
ProgramRun run_program(const Source& source, const ReadOptions& options, Diagnostics& diagnostics) {
    Errand errand{source, options, diagnostics, {}, nullptr};
    const std::uint64_t depth = std::clamp<std::uint64_t>(options.program.limits.depth, 1, kMostCalls);
    pthread_attr_t attributes;
    pthread_attr_init(&attributes);
    pthread_attr_setstacksize(&attributes,
                              kStackBesides + (kLevelsPerCall * depth + kLevelsBesides) * kStackPerLevel);
    pthread_t thread{};
    const int failed = pthread_create(&thread, &attributes, run_errand, &errand);
    pthread_attr_destroy(&attributes);
    if (failed != 0) {
        diagnostics
            .error("flatlang-limit", {},
                   fmt::format("there is no memory for calls {} deep within each other", depth))
            .hint("--max-depth N asks for less");
        errand.result.status = RunStatus::timeout;
        return std::move(errand.result);
    }
    pthread_join(thread, nullptr);
    if (errand.thrown) std::rethrow_exception(errand.thrown);
    return std::move(errand.result);
}

}  // namespace popup::flatlang
