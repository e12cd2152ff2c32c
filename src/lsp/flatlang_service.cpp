// FlatLang programs, as an editor asks about them.
//
// The language's scope is dynamic: a name means whatever was set last, wherever that was, and members of an
// object are names of its methods. So equal names are one name: all of them are referred to, and renamed,
// together.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <set>

#include "input/flatlang/kit_table.h"
#include "input/flatlang/run/builtin.h"
#include "lsp/features.h"
#include "lsp/flatlang_words.h"
#include "popup/mechanism.h"

namespace popup::lsp {
namespace {

using flatlang::Token;
using flatlang::TokenKind;

bool is_ours(std::string_view /*text*/) { return true; }

// A program and the files that it loads.
struct Unit {
    std::string path;
    std::string text;
    ProgramText words;
};

// The document first. Kept in place: words refer to texts. `readers`: with those that load it.
std::vector<std::unique_ptr<Unit>> units_of(const View& view, bool readers = false) {
    std::vector<std::unique_ptr<Unit>> units;
    const auto add = [&](std::string path, std::string text) {
        auto unit = std::make_unique<Unit>();
        unit->path = std::move(path);
        unit->text = std::move(text);
        unit->words = program_text(unit->text);
        units.push_back(std::move(unit));
    };
    add(view.path, view.text.bytes());
    if (!view.read) return units;
    for (const std::vector<std::string>* list : {&view.loaded, &view.readers}) {
        if (list == &view.readers && !readers) break;
        for (const std::string& path : *list) {
            if (std::optional<std::string> text = view.read(path)) add(path, std::move(*text));
        }
    }
    return units;
}

std::string function_markdown(std::string_view call, std::string_view about, std::string_view from) {
    std::string text = fmt::format("```flatlang\n{}\n```", call);
    if (!from.empty()) text += fmt::format("\n\nfrom `{}`", from);
    if (!about.empty()) text += fmt::format("\n\n{}", about);
    return text;
}

std::string call_of(const FunctionText& one) {
    return fmt::format("define {}({})", one.name, fmt::join(one.parameters, ", "));
}

std::optional<Hover> hover(const View& view, std::size_t at) {
    const auto units = units_of(view);
    const ProgramText& own = units.front()->words;
    const auto number = own.name_at(at);
    if (!number) return std::nullopt;
    const Token& token = own.tokens[*number];
    const Span span{token.begin, token.end};
    const std::string_view name = own.word(token);
    // A program's own function takes the place of one that is built in.
    for (const auto& unit : units) {
        for (const FunctionText& one : unit->words.functions) {
            if (one.name == name)
                return Hover{span,
                             function_markdown(call_of(one), one.about,
                                               unit == units.front() ? std::string_view() : unit->path)};
        }
    }
    if (const KnownFunction* known = find_known_function(name)) {
        const flatlang::Builtin* row = flatlang::find_builtin(name);
        std::string said =
            function_markdown(known->call, known->about,
                              known->kit.empty() ? std::string() : fmt::format("kit/{}", known->kit));
        // Rows that are made of elements tell of these.
        if (row != nullptr && row->data != nullptr) {
            for (const ElementInfo& info : element_table()) {
                if (row->data != &info) continue;
                std::string points;
                for (const PointInfo& point : info.points)
                    points += fmt::format("{}{}", points.empty() ? "" : " ", point.letter);
                said += fmt::format(
                    "\n\nStands on a fold (or a plate, a page), then points {}; the folds that it makes: {}",
                    points, [&] {
                        std::string folds;
                        for (const FoldInfo& fold : info.folds)
                            folds += fmt::format("{}.{}", folds.empty() ? "" : ", ", fold.name);
                        return folds.empty() ? std::string("none") : folds;
                    }());
            }
        }
        return Hover{span, said};
    }
    const std::size_t uses = own.all_of(name).size();
    return Hover{span, fmt::format("`{}`: a name, {} {} here", name, uses, uses == 1 ? "time" : "times")};
}

Span word_before(std::string_view text, std::size_t at) {
    std::size_t begin = at;
    const auto in_name = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
    };
    while (begin > 0 && in_name(text[begin - 1])) --begin;
    return {begin, at};
}

// What may stand in the text of load().
std::vector<Completion> files(std::string_view text, const Token& token, std::size_t at) {
    std::vector<Completion> found;
    const Span inside{
        token.begin + 1,
        std::max(at, token.end > token.begin + 1 && text[token.end - 1] == '"' ? token.end - 1 : at)};
    for (const flatlang::KitFile& file : flatlang::kit_table())
        found.push_back({fmt::format("kit/{}", file.name),
                         ItemKind::file,
                         "of the kit",
                         {},
                         inside,
                         fmt::format("kit/{}", file.name),
                         false});
    return found;
}

// What cards and their elements have behind a full stop.
std::set<std::string> card_members() {
    std::set<std::string> names{"gutter", "page", "draw"};
    for (const ElementInfo& info : element_table()) {
        for (const FoldInfo& fold : info.folds) names.emplace(fold.name);
    }
    return names;
}

std::vector<Completion> members(const ProgramText& words, Span word) {
    std::set<std::string> names = card_members();
    for (std::size_t i = 1; i < words.tokens.size(); ++i) {
        const Token& token = words.tokens[i];
        if (token.kind == TokenKind::name && words.tokens[i - 1].kind == TokenKind::dot &&
            token.begin != word.begin)
            names.emplace(words.word(token));
    }
    std::vector<Completion> found;
    found.reserve(names.size());
    for (const std::string& name : names)
        found.push_back({name, ItemKind::property, {}, {}, word, name, false});
    return found;
}

std::vector<Completion> complete(const View& view, std::size_t at) {
    const auto units = units_of(view);
    const ProgramText& own = units.front()->words;
    const std::string_view text = own.text;
    for (const Token& token : own.tokens) {
        if (token.kind == TokenKind::text && token.begin < at && at < token.end)
            return files(text, token, at);
    }
    // In a comment nothing is offered.
    const std::size_t line = at == 0 ? 0 : text.rfind('\n', at - 1) + 1;
    const std::string_view before = text.substr(line, at - line);
    bool quoted = false;
    for (const char c : before) {
        if (c == '"') quoted = !quoted;
        if (c == ';' && !quoted) return {};
    }
    if (quoted) {
        const std::size_t quote = line + before.rfind('"');
        return files(text, {TokenKind::text, {}, quote, at}, at);
    }
    const Span word = word_before(text, at);
    if (word.begin > 0 && text[word.begin - 1] == '.') return members(own, word);
    std::vector<Completion> found;
    std::set<std::string> names;
    const auto add = [&](Completion one) {
        if (names.insert(one.label).second) found.push_back(std::move(one));
    };
    for (const auto& unit : units) {
        for (const FunctionText& one : unit->words.functions) {
            add({one.name, ItemKind::function, call_of(one), function_markdown(call_of(one), one.about, {}),
                 word, one.name, false});
        }
    }
    for (const Span variable : own.variables) {
        const std::string name(text.substr(variable.begin, variable.size()));
        if (variable.begin != word.begin) add({name, ItemKind::variable, {}, {}, word, name, false});
    }
    for (const KnownFunction& one : known_functions()) {
        add({one.name, ItemKind::function,
             one.kit.empty() ? one.call : fmt::format("{}: load(\"kit/{}\")", one.call, one.kit),
             function_markdown(one.call, one.about,
                               one.kit.empty() ? std::string() : fmt::format("kit/{}", one.kit)),
             word, one.name, false});
    }
    for (int kind = static_cast<int>(TokenKind::kw_define); kind <= static_cast<int>(TokenKind::kw_infinity);
         ++kind) {
        const std::string name(flatlang::to_string(static_cast<TokenKind>(kind)));
        add({name, ItemKind::word, {}, {}, word, name, false});
    }
    return found;
}

std::vector<Symbol> symbols(const View& view) {
    const ProgramText words = program_text(view.text.bytes());
    std::vector<Symbol> all;
    for (const FunctionText& one : words.functions)
        all.push_back({one.name, fmt::format("({})", fmt::join(one.parameters, ", ")), SymbolKind::function,
                       one.all, one.name_at, -1});
    // Variables of the program itself; those of functions live no longer than a call.
    for (const Span variable : words.variables) {
        if (words.around(variable.begin) != nullptr) continue;
        all.push_back({std::string(words.text.substr(variable.begin, variable.size())),
                       {},
                       SymbolKind::variable,
                       variable,
                       variable,
                       -1});
    }
    std::stable_sort(all.begin(), all.end(),
                     [](const Symbol& a, const Symbol& b) { return a.all.begin < b.all.begin; });
    return all;
}

std::optional<Target> definition(const View& view, std::size_t at) {
    const auto units = units_of(view);
    const ProgramText& own = units.front()->words;
    const auto number = own.name_at(at);
    if (!number) return std::nullopt;
    const std::string_view name = own.word(own.tokens[*number]);
    for (const auto& unit : units) {
        for (const FunctionText& one : unit->words.functions) {
            if (one.name == name) return Target{unit->path, one.name_at};
        }
    }
    // The first place of a variable in its function, else in the program, else in what it loads.
    if (const FunctionText* function = own.around(at)) {
        const auto& parameters = function->parameters;
        if (std::find(parameters.begin(), parameters.end(), name) != parameters.end()) {
            for (const Span one : own.all_of(name)) {
                if (function->all.contains(one.begin)) return Target{view.path, one};
            }
        }
    }
    for (const auto& unit : units) {
        for (const Span variable : unit->words.variables) {
            if (unit->words.text.substr(variable.begin, variable.size()) == name)
                return Target{unit->path, variable};
        }
    }
    return std::nullopt;
}

std::vector<Target> references(const View& view, std::size_t at) {
    const auto units = units_of(view, true);
    const ProgramText& own = units.front()->words;
    const auto number = own.name_at(at);
    if (!number) return {};
    const std::string_view name = own.word(own.tokens[*number]);
    std::vector<Target> all;
    if (const auto first = definition(view, at)) all.push_back(*first);
    for (const auto& unit : units) {
        for (const Span one : unit->words.all_of(name)) {
            if (!all.empty() && all.front().path == unit->path && all.front().at == one) continue;
            all.push_back({unit->path, one});
        }
    }
    return all;
}

// Names that programs share with what is not theirs: builtins, members of cards, and all that the prelude and
// the kit call so, but for parameters, which are of a call alone.
bool is_taken(std::string_view name) {
    static const std::set<std::string, std::less<>> names = [] {
        std::set<std::string, std::less<>> all;
        for (const std::string_view one : flatlang::builtin_names()) all.emplace(one);
        for (const std::string& one : card_members()) all.insert(one);
        const auto add = [&all](std::string_view text) {
            const ProgramText words = program_text(text);
            for (const Token& token : words.tokens) {
                if (token.kind != TokenKind::name) continue;
                const FunctionText* function = words.around(token.begin);
                const std::string word(words.word(token));
                const bool parameter =
                    function != nullptr && std::find(function->parameters.begin(), function->parameters.end(),
                                                     word) != function->parameters.end();
                if (!parameter) all.insert(word);
            }
        };
        add(flatlang::prelude());
        for (const flatlang::KitFile& file : flatlang::kit_table()) add(file.text);
        return all;
    }();
    return names.contains(name);
}

std::optional<Span> renameable(const View& view, std::size_t at) {
    const ProgramText words = program_text(view.text.bytes());
    const auto number = words.name_at(at);
    if (!number || is_taken(words.word(words.tokens[*number]))) return std::nullopt;
    return Span{words.tokens[*number].begin, words.tokens[*number].end};
}

Renaming rename(const View& view, std::size_t at, std::string_view name) {
    const auto units = units_of(view, true);
    const ProgramText& own = units.front()->words;
    const auto number = own.name_at(at);
    if (!number) return {{}, "there is no name to change here"};
    const std::string_view old = own.word(own.tokens[*number]);
    if (is_taken(old)) return {{}, fmt::format("\"{}\" is a name of the language or of its kit", old)};
    const flatlang::Lexed lexed = flatlang::lex(name, false);
    if (!lexed.errors.empty() || lexed.tokens.size() != 2 || lexed.tokens.front().kind != TokenKind::name ||
        lexed.tokens.front().end != name.size() || lexed.tokens.front().begin != 0)
        return {{},
                "a name is letters, digits and \"_\", does not begin with a digit, and is no word of the "
                "language"};
    if (is_taken(name)) return {{}, fmt::format("\"{}\" is a name of the language or of its kit", name)};
    if (!view.doubtful.empty())
        return {{},
                fmt::format("{} has an error that hides which files it loads: mend it first", view.doubtful)};
    Renaming made;
    for (const auto& unit : units) {
        if (name != old && !unit->words.all_of(name).empty())
            return {{}, fmt::format("\"{}\" is in use already, in {}", name, unit->path)};
        FileEdits edits{unit->path, {}};
        for (const Span one : unit->words.all_of(old)) edits.edits.push_back({one, std::string(name)});
        if (!edits.edits.empty()) made.files.push_back(std::move(edits));
    }
    return made;
}

// Programs have no comments that allow.
std::optional<Fix> allow(const View& /*view*/, const Finding& /*finding*/) { return std::nullopt; }

std::vector<ColorAt> colors(const View& /*view*/) { return {}; }

}  // namespace

Service flatlang_service() {
    return {"flatlang", is_ours,    hover,  complete, symbols, definition,
            references, renameable, rename, allow,    colors};
}

}  // namespace popup::lsp
