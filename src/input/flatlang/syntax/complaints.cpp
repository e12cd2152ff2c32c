#include "input/flatlang/syntax/complaints.h"

#include <fmt/format.h>

#include "input/flatlang/syntax/kinds.h"
#include "input/text.h"

namespace popup::flatlang {
namespace {

std::string_view word(std::string_view text, const Token& token) {
    return text.substr(token.begin, token.end - token.begin);
}

// Long words are cut, and what may not be printed is not.
std::string piece(std::string_view text, const Token& token) { return popup::shown(word(text, token)); }

bool over_lines(std::string_view text, const Token& token) {
    return token.kind == TokenKind::text && word(text, token).find('\n') != std::string_view::npos;
}

std::string missing_quote(const Token& token) {
    return fmt::format(
        "the text that begins at {} goes over the end of its line; its closing '\"' may be missing",
        shown(token.place));
}

bool is_word(TokenKind kind) {
    return (one(kind) & (kCompound | kDefinition | kBlockEnd |
                         kinds(TokenKind::kw_and, TokenKind::kw_or, TokenKind::kw_true, TokenKind::kw_false,
                               TokenKind::kw_infinity, TokenKind::kw_object))) != 0;
}

}  // namespace

std::string found(std::string_view text, const Token& token) {
    switch (token.kind) {
        case TokenKind::end:
            return "the end of the file";
        case TokenKind::text:
            return fmt::format("the text {}", piece(text, token));
        case TokenKind::number:
            return fmt::format("the number {}", piece(text, token));
        default:
            return fmt::format("'{}'", piece(text, token));
    }
}

std::string wanted(TokenKind kind) {
    if (kind == TokenKind::name || kind == TokenKind::text || kind == TokenKind::number) {
        return std::string(to_string(kind));
    }
    return fmt::format("'{}'", to_string(kind));
}

std::string shown(Place place) { return fmt::format("{}:{}", place.line, place.column); }

Complaint lexical_complaint(std::string_view text, const Lexed& lexed, const LexicalError& error) {
    const std::string what = piece(text, error.concern);
    switch (error.fault) {
        case LexicalFault::bad_character: {
            const char first = text[error.concern.begin];
            const auto byte = static_cast<unsigned char>(first);
            Complaint told{error.place, fmt::format("'{}' has no meaning in the language", what), {}, {}};
            if (byte < 0x20 || byte == 0x7F) {
                told.message = fmt::format("the byte 0x{:02x} has no meaning in the language", byte);
            }
            if (first == '#') told.hints.emplace_back("comments begin with ;");
            if (first == '\'' || first == '`') told.hints.emplace_back("texts stand in \" marks");
            if (first == '{' || first == '}')
                told.hints.emplace_back("blocks end with done, and begin without a mark");
            if (first == '&') told.hints.emplace_back("write 'and'");
            if (first == '|') told.hints.emplace_back("write 'or'");
            return told;
        }
        case LexicalFault::half_keyword:
            return {error.place,
                    "'for' must be followed by 'each', with exactly one blank between them",
                    {"a loop over a list is written: for each (item : list) ... done"},
                    {}};
        case LexicalFault::half_operator:
            return {error.place,
                    "'!' stands alone",
                    {"'!=' is unequal; to negate a condition, write (...) == false"},
                    {}};
        case LexicalFault::unfinished: {
            Complaint told{
                error.place, "the text that begins here is not closed before the end of the file", {}, {}};
            const std::size_t suspect = first_text_over_lines(text, lexed.tokens);
            if (suspect < lexed.tokens.size()) told.hints.push_back(missing_quote(lexed.tokens[suspect]));
            return told;
        }
        case LexicalFault::digits_missing: {
            const std::string digits = what.substr(0, what.size() - 1);
            return {error.place,
                    fmt::format("digits are missing after the dot of the number {}", what),
                    {fmt::format("write {} or {}.0", digits, digits)},
                    {}};
        }
        case LexicalFault::glued_name:
            return {
                error.place,
                fmt::format("'{}' stands directly after a number", what),
                {"names begin with a letter or _, products are written with *, and numbers have no exponent"},
                {}};
    }
    return {};
}

std::size_t first_text_over_lines(std::string_view text, const std::vector<Token>& tokens) {
    std::size_t at = 0;
    while (at < tokens.size() && !over_lines(text, tokens[at])) ++at;
    return at;
}

std::vector<std::string> hints_at(std::string_view text, const std::vector<Token>& tokens,
                                  std::size_t wrong) {
    std::vector<std::string> hints;
    const Token none;
    const Token& here = tokens[wrong];
    const Token& before = wrong > 0 ? tokens[wrong - 1] : none;
    const Token& after = wrong + 1 < tokens.size() ? tokens[wrong + 1] : none;
    if (over_lines(text, before)) hints.push_back(missing_quote(before));
    if (over_lines(text, here)) hints.push_back(missing_quote(here));
    if (before.kind == TokenKind::name && word(text, before) == "not") {
        hints.emplace_back("there is no 'not'; to negate a condition, write (...) == false");
    }
    if (here.kind == TokenKind::minus && before.kind == TokenKind::minus) {
        hints.emplace_back("a second minus needs a bracket: -(-3)");
    }
    if (here.kind == TokenKind::slash && (after.kind == TokenKind::slash || after.kind == TokenKind::star)) {
        hints.emplace_back("comments begin with ;");
    }
    if (here.kind == TokenKind::colon && wrong >= 3 && tokens[wrong - 2].kind == TokenKind::open &&
        word(text, tokens[wrong - 3]) == "for") {
        hints.emplace_back(
            "a loop over a list begins with 'for each', and exactly one blank between the words");
    }
    if (here.kind == TokenKind::open_list &&
        (before.kind == TokenKind::close || before.kind == TokenKind::close_list)) {
        hints.emplace_back("only names and calls have indices: give the list a name first");
    }
    // A bracket that was meant to begin a statement.
    for (std::size_t i = wrong, brackets = 0; i > 0 && i + 20 > wrong; --i) {
        const TokenKind kind = tokens[i - 1].kind;
        if (kind == TokenKind::close_list || kind == TokenKind::close) ++brackets;
        if (kind != TokenKind::open_list && kind != TokenKind::open) continue;
        if (brackets-- > 0) continue;
        if (i >= 2 && tokens[i - 1].place.line > tokens[i - 2].place.line) {
            hints.push_back(fmt::format("the '{}' at {} goes on with what stands in the line before",
                                        to_string(kind), shown(tokens[i - 1].place)));
        }
        break;
    }
    const bool compound = (one(before.kind) & kCompound) != 0;
    if (here.kind == TokenKind::assign) {
        if (is_word(before.kind)) {
            hints.push_back(
                fmt::format("'{}' is a word of the language and cannot name a variable", word(text, before)));
        } else {
            hints.emplace_back("a statement assigns once: write one for each name, or == to compare");
        }
    } else if (compound &&
               (one(here.kind) & kinds(TokenKind::number, TokenKind::name, TokenKind::text)) != 0) {
        hints.push_back(fmt::format(
            "what belongs to '{0}' stands in brackets, and its block ends with done: {0} ({1}{2}) ... done",
            to_string(before.kind), piece(text, here), here.kind == TokenKind::name ? " ..." : ""));
    } else if (is_word(here.kind) && (before.kind == TokenKind::kw_define ||
                                      before.kind == TokenKind::comma || before.kind == TokenKind::dot)) {
        hints.push_back(fmt::format("'{}' is a word of the language and cannot be a name", word(text, here)));
    }
    return hints;
}

}  // namespace popup::flatlang
