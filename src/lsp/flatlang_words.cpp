#include "lsp/flatlang_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "input/flatlang/kit_table.h"
#include "input/flatlang/run/builtin.h"
#include "input/text.h"

namespace popup::lsp {
namespace {

using flatlang::Token;
using flatlang::TokenKind;

bool opens_block(TokenKind kind) {
    switch (kind) {
        case TokenKind::kw_define:
        case TokenKind::kw_if:
        case TokenKind::kw_while:
        case TokenKind::kw_repeat:
        case TokenKind::kw_for_each:
        case TokenKind::kw_shape:
        case TokenKind::kw_from:
        case TokenKind::kw_replace:
        case TokenKind::kw_replace_all:
            return true;
        default:
            return false;
    }
}

std::string_view line_at(std::string_view text, std::size_t at) {
    const std::size_t before = at == 0 ? std::string_view::npos : text.rfind('\n', at - 1);
    const std::size_t begin = before == std::string_view::npos ? 0 : before + 1;
    return trimmed(text.substr(begin, std::min(text.find('\n', at), text.size()) - begin));
}

// The text of a comment without its semicolons; lines are joined.
void append_line(std::string& about, std::string_view line) {
    while (line.starts_with(';')) line.remove_prefix(1);
    line = trimmed(line);
    if (!about.empty()) about += about.ends_with(':') || line.empty() ? "\n\n" : " ";
    about += line;
}

std::string comment_above(std::string_view text, std::size_t at) {
    std::vector<std::string_view> lines;
    std::size_t begin = at == 0 ? std::string_view::npos : text.rfind('\n', at - 1);
    while (begin != std::string_view::npos && begin > 0) {
        const std::string_view line = line_at(text, begin - 1);
        if (!line.starts_with(';')) break;
        lines.push_back(line);
        begin = text.rfind('\n', begin - 1);
    }
    std::string about;
    for (auto line = lines.rbegin(); line != lines.rend(); ++line) append_line(about, *line);
    return about;
}

std::string comment_behind(std::string_view text, std::size_t end) {
    const std::string_view rest = text.substr(end, std::min(text.find('\n', end), text.size()) - end);
    const std::size_t mark = rest.find(';');
    if (mark == std::string_view::npos || !trimmed(rest.substr(0, mark)).empty()) return {};
    std::string about;
    append_line(about, trimmed(rest.substr(mark)));
    return about;
}

// The first line of each name that begins with its call, "; gear(teeth), gear(teeth, pitch): a gear …".
using CallLines = std::unordered_map<std::string_view, std::size_t>;
CallLines call_lines(std::string_view text) {
    CallLines lines;
    for (std::size_t at = 0; at < text.size(); at = std::min(text.find('\n', at), text.size() - 1) + 1) {
        if (text[at] != ';') continue;
        const std::string_view line = line_at(text, at);
        const std::size_t bracket = line.find('(');
        if (!line.starts_with("; ") || bracket == std::string_view::npos) continue;
        lines.emplace(line.substr(2, bracket - 2), at);
    }
    return lines;
}

// Up to the end of the comment or its first empty line.
std::string comment_at(std::string_view text, std::size_t at) {
    std::string about;
    while (at < text.size()) {
        const std::string_view line = line_at(text, at);
        if (!line.starts_with(';') || line == ";") break;
        append_line(about, line);
        at = std::min(text.find('\n', at), text.size() - 1) + 1;
    }
    return about;
}

class Reader {
 public:
    explicit Reader(std::string_view text) : made_{text, flatlang::lex(text, false).tokens, {}, {}} {
        if (!made_.tokens.empty()) made_.tokens.pop_back();
    }

    ProgramText run() {
        const auto& tokens = made_.tokens;
        for (std::size_t i = 0; i < tokens.size(); ++i) {
            const TokenKind kind = tokens[i].kind;
            if (kind == TokenKind::kw_define) {
                define(i);
            } else if (opens_block(kind)) {
                open_.push_back(-1);
            } else if (kind == TokenKind::kw_done && !open_.empty()) {
                close(tokens[i].end);
            }
            if (kind == TokenKind::kw_for_each && is(i + 1, TokenKind::open) && is(i + 2, TokenKind::name))
                variable(tokens[i + 2]);
            if (kind == TokenKind::name && is(i + 1, TokenKind::assign) &&
                !(i > 0 && tokens[i - 1].kind == TokenKind::dot))
                variable(tokens[i]);
        }
        while (!open_.empty()) close(made_.text.size());
        const CallLines calls = call_lines(made_.text);
        for (FunctionText& one : made_.functions) tell(one, calls);
        return std::move(made_);
    }

 private:
    [[nodiscard]] bool is(std::size_t i, TokenKind kind) const {
        return i < made_.tokens.size() && made_.tokens[i].kind == kind;
    }

    void define(std::size_t i) {
        open_.push_back(-1);
        if (!is(i + 1, TokenKind::name)) return;
        open_.back() = static_cast<int>(made_.functions.size());
        const Token& name = made_.tokens[i + 1];
        FunctionText& made = made_.functions.emplace_back();
        made.name = made_.word(name);
        made.name_at = {name.begin, name.end};
        made.all = {made_.tokens[i].begin, name.end};
        if (!is(i + 2, TokenKind::open)) return;
        for (std::size_t k = i + 3; is(k, TokenKind::name); ++k) {
            made.parameters.emplace_back(made_.word(made_.tokens[k]));
            variable(made_.tokens[k]);
            if (!is(k + 1, TokenKind::comma)) break;
            ++k;
        }
    }

    void close(std::size_t end) {
        if (open_.back() >= 0) made_.functions[static_cast<std::size_t>(open_.back())].all.end = end;
        open_.pop_back();
    }

    void variable(const Token& token) {
        const auto in =
            std::find_if(open_.rbegin(), open_.rend(), [](int function) { return function >= 0; });
        const int function = in == open_.rend() ? -1 : *in;
        if (seen_.emplace(function, made_.word(token)).second)
            made_.variables.push_back({token.begin, token.end});
    }

    void tell(FunctionText& one, const CallLines& calls) const {
        one.about = comment_above(made_.text, one.all.begin);
        if (one.about.empty()) one.about = comment_behind(made_.text, one.all.end);
        const auto elsewhere = calls.find(one.name);
        if (one.about.empty() && elsewhere != calls.end())
            one.about = comment_at(made_.text, elsewhere->second);
    }

    ProgramText made_;
    std::vector<int> open_;                            // blocks: the function that each is the body of, or -1
    std::set<std::pair<int, std::string_view>> seen_;  // by function; -1: in none
};

std::string call_of(const FunctionText& one) {
    return fmt::format("{}({})", one.name, fmt::join(one.parameters, ", "));
}

bool is_private(std::string_view name) { return name.starts_with("__"); }

// A builtin's text begins with its call.
KnownFunction known(const flatlang::Builtin& row) {
    const std::string_view about = row.about;
    const std::size_t colon = about.find("): ");
    const bool tells = about.starts_with(row.name) && colon != std::string_view::npos;
    return {std::string(row.name),
            tells ? std::string(about.substr(0, colon + 1)) : fmt::format("{}(...)", row.name),
            std::string(tells ? about.substr(colon + 3) : about),
            {}};
}

std::vector<KnownFunction> all_known() {
    std::vector<KnownFunction> all;
    std::set<std::string> names;
    const auto add = [&](KnownFunction one) {
        if (!is_private(one.name) && names.insert(one.name).second) all.push_back(std::move(one));
    };
    for (const FunctionText& one : program_text(flatlang::prelude()).functions)
        add({one.name, call_of(one), one.about, {}});
    for (const std::string_view name : flatlang::builtin_names()) add(known(*flatlang::find_builtin(name)));
    for (const flatlang::KitFile& file : flatlang::kit_table()) {
        for (const FunctionText& one : program_text(file.text).functions) {
            // What takes any number of arguments names none of them.
            const bool any = one.parameters.size() == 1 && is_private(one.parameters.front());
            add({one.name, any ? fmt::format("{}(...)", one.name) : call_of(one), one.about, file.name});
        }
    }
    std::sort(all.begin(), all.end(),
              [](const KnownFunction& a, const KnownFunction& b) { return a.name < b.name; });
    return all;
}

}  // namespace

std::optional<std::size_t> ProgramText::name_at(std::size_t at) const {
    const auto behind = std::partition_point(tokens.begin(), tokens.end(),
                                             [at](const Token& token) { return token.begin <= at; });
    // Where two words touch, the name counts.
    for (auto token = behind; token != tokens.begin() && behind - token < 2;) {
        --token;
        if (token->kind == TokenKind::name && token->begin <= at && at <= token->end)
            return static_cast<std::size_t>(token - tokens.begin());
    }
    return std::nullopt;
}

std::vector<Span> ProgramText::all_of(std::string_view name) const {
    std::vector<Span> found;
    for (const Token& token : tokens) {
        if (token.kind == TokenKind::name && word(token) == name) found.push_back({token.begin, token.end});
    }
    return found;
}

const FunctionText* ProgramText::around(std::size_t at) const {
    const auto found = std::find_if(functions.rbegin(), functions.rend(),
                                    [at](const FunctionText& one) { return one.all.contains(at); });
    return found == functions.rend() ? nullptr : &*found;
}

ProgramText program_text(std::string_view text) { return Reader(text).run(); }

const std::vector<KnownFunction>& known_functions() {
    static const std::vector<KnownFunction> all = all_known();
    return all;
}

const KnownFunction* find_known_function(std::string_view name) {
    const std::vector<KnownFunction>& all = known_functions();
    const auto at =
        std::lower_bound(all.begin(), all.end(), name,
                         [](const KnownFunction& one, std::string_view wanted) { return one.name < wanted; });
    return at != all.end() && at->name == name ? &*at : nullptr;
}

}  // namespace popup::lsp
