#include "input/flatlang/syntax/lexer.h"

#include <algorithm>
#include <array>
#include <utility>

#include "base/text/utf8.h"

namespace popup::flatlang {
namespace {

constexpr std::array kWords = std::to_array<std::pair<std::string_view, TokenKind>>({
    {"define", TokenKind::kw_define},
    {"safe", TokenKind::kw_safe},
    {"if", TokenKind::kw_if},
    {"alt", TokenKind::kw_alt},
    {"else", TokenKind::kw_else},
    {"done", TokenKind::kw_done},
    {"while", TokenKind::kw_while},
    {"repeat", TokenKind::kw_repeat},
    {"for each", TokenKind::kw_for_each},
    {"from", TokenKind::kw_from},
    {"shape", TokenKind::kw_shape},
    {"replace", TokenKind::kw_replace},
    {"replaceAll", TokenKind::kw_replace_all},
    {"and", TokenKind::kw_and},
    {"or", TokenKind::kw_or},
    {"true", TokenKind::kw_true},
    {"false", TokenKind::kw_false},
    {"infinity", TokenKind::kw_infinity},
    {"__object__", TokenKind::kw_object},
});

// The longer of two that begin alike stands first.
constexpr std::array kSigns = std::to_array<std::pair<std::string_view, TokenKind>>({
    {"==", TokenKind::equal},      {"!=", TokenKind::unequal},
    {"<=", TokenKind::less_equal}, {">=", TokenKind::greater_equal},
    {"(", TokenKind::open},        {")", TokenKind::close},
    {"[", TokenKind::open_list},   {"]", TokenKind::close_list},
    {",", TokenKind::comma},       {".", TokenKind::dot},
    {":", TokenKind::colon},       {"=", TokenKind::assign},
    {"<", TokenKind::less},        {">", TokenKind::greater},
    {"+", TokenKind::plus},        {"-", TokenKind::minus},
    {"*", TokenKind::star},        {"/", TokenKind::slash},
    {"%", TokenKind::percent},
});

constexpr std::string_view kForEach = "for each";

constexpr bool is_digit(char c) { return c >= '0' && c <= '9'; }
constexpr bool begins_name(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
constexpr bool in_name(char c) { return begins_name(c) || is_digit(c); }
constexpr bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f'; }
class Lexer {
 public:
    Lexer(std::string_view text, bool as_2008) : text_(text), as_2008_(as_2008) {}

    Lexed run() {
        if (text_.substr(0, 3) == "\xEF\xBB\xBF") at_ = 3;
        while (true) {
            skip_space();
            token_ = {TokenKind::end, place_, at_, at_};
            if (at_ == text_.size()) break;
            word();
        }
        result_.tokens.push_back(token_);
        return std::move(result_);
    }

 private:
    [[nodiscard]] char peek(std::size_t ahead = 0) const {
        return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0';
    }

    // Goes over one character; a byte that is no UTF-8 is one, too.
    void step() {
        const auto byte = static_cast<unsigned char>(text_[at_]);
        if (byte == '\n') {
            ++place_.line;
            place_.column = 0;
        }
        at_ += byte < 0x80 ? 1 : first_character(text_.substr(at_)).bytes;
        ++place_.column;
    }
    // The same, where there may be none.
    void step_if_any() {
        if (at_ < text_.size()) step();
    }

    void skip_space() {
        while (at_ < text_.size()) {
            if (is_space(text_[at_])) {
                step();
            } else if (text_[at_] == ';') {
                while (at_ < text_.size() && text_[at_] != '\n' && text_[at_] != '\r') step();
            } else {
                return;
            }
        }
    }

    void emit(TokenKind kind) {
        token_.kind = kind;
        token_.end = at_;
        result_.tokens.push_back(token_);
    }

    void fault(LexicalFault fault, Place place) {
        token_.end = at_;
        result_.errors.push_back({fault, place, token_});
    }

    void word() {
        const char c = peek();
        if (begins_name(c)) return name();
        if (is_digit(c) || (c == '.' && is_digit(peek(1)))) return number();
        if (c == '"') return quoted();
        for (const auto& [sign, kind] : kSigns) {
            if (text_.substr(at_, sign.size()) != sign) continue;
            for (std::size_t i = 0; i < sign.size(); ++i) step();
            return emit(kind);
        }
        if (c == '!') return half_operator();
        bad_characters();
    }

    void name() {
        if (text_.substr(at_, 4) == "for ") return for_each();
        while (at_ < text_.size() && in_name(text_[at_])) step();
        const std::string_view word = text_.substr(token_.begin, at_ - token_.begin);
        const auto* const found =
            std::find_if(kWords.begin(), kWords.end(), [&](const auto& row) { return row.first == word; });
        emit(found == kWords.end() ? TokenKind::name : found->second);
    }

    // `for` with a blank behind it is no name: the word must go on.
    void for_each() {
        if (text_.substr(at_, kForEach.size()) == kForEach) {
            for (std::size_t i = 0; i < kForEach.size(); ++i) step();
            return emit(TokenKind::kw_for_each);
        }
        if (as_2008_) {
            for (const char expected : kForEach) {
                if (peek() != expected || at_ == text_.size()) break;
                step();
            }
            fault(LexicalFault::half_keyword, place_);
            step_if_any();
            step_if_any();
            return;
        }
        for (int i = 0; i < 3; ++i) step();
        std::size_t after = at_;
        while (after < text_.size() && is_space(text_[after])) ++after;
        const bool each =
            text_.substr(after, 4) == "each" && (after + 4 == text_.size() || !in_name(text_[after + 4]));
        if (each) {
            while (at_ < after + 4) step();
        }
        fault(LexicalFault::half_keyword, token_.place);
        emit(TokenKind::kw_for_each);
    }

    void number() {
        while (is_digit(peek())) step();
        if (peek() == '.') {
            step();
            if (!is_digit(peek())) {
                fault(LexicalFault::digits_missing, as_2008_ ? place_ : token_.place);
                if (as_2008_) return step_if_any();
                // Its value is that of the digits.
                token_.kind = TokenKind::number;
                token_.end = at_ - 1;
                result_.tokens.push_back(token_);
                return;
            }
            while (is_digit(peek())) step();
        }
        emit(TokenKind::number);
        if (as_2008_ || !begins_name(peek())) return;
        token_ = {TokenKind::name, place_, at_, at_};
        name();
        if (result_.tokens.back().kind != TokenKind::name) return;
        token_ = result_.tokens.back();
        result_.tokens.pop_back();
        fault(LexicalFault::glued_name, token_.place);
    }

    void quoted() {
        step();
        while (at_ < text_.size() && text_[at_] != '"') {
            if (text_[at_] == '\\') step();
            step_if_any();
        }
        if (at_ == text_.size()) return fault(LexicalFault::unfinished, as_2008_ ? place_ : token_.place);
        step();
        emit(TokenKind::text);
    }

    void half_operator() {
        step();
        if (!as_2008_) return fault(LexicalFault::half_operator, token_.place);
        fault(LexicalFault::half_operator, place_);
        step_if_any();
        step_if_any();
    }

    void bad_characters() {
        const Place place = place_;
        step_if_any();
        if (!as_2008_) {
            while (at_ < text_.size() && is_bad(text_[at_])) step_if_any();
        }
        fault(LexicalFault::bad_character, place);
    }

    static bool is_bad(char c) {
        return !is_space(c) && !in_name(c) && c != '"' && c != ';' && c != '!' &&
               std::none_of(kSigns.begin(), kSigns.end(), [&](const auto& row) { return row.first[0] == c; });
    }

    std::string_view text_;
    bool as_2008_;
    std::size_t at_ = 0;
    Place place_{1, 1};
    Token token_;
    Lexed result_;
};

}  // namespace

Lexed lex(std::string_view text, bool as_2008) { return Lexer(text, as_2008).run(); }

std::string_view to_string(TokenKind kind) {
    for (const auto& [word, of] : kWords) {
        if (of == kind) return word;
    }
    for (const auto& [sign, of] : kSigns) {
        if (of == kind) return sign;
    }
    if (kind == TokenKind::number) return "a number";
    if (kind == TokenKind::text) return "a text in quotation marks";
    if (kind == TokenKind::name) return "a name";
    return "the end of the file";
}

}  // namespace popup::flatlang
