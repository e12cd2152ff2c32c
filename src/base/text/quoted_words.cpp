#include "base/text/quoted_words.h"

#include <fmt/format.h>

#include <algorithm>

namespace popup {
namespace {

// Goes through a text by characters, which may have several bytes.
class Cursor {
 public:
    explicit Cursor(std::string_view text) : text_(text) {}
    [[nodiscard]] bool done() const { return at_ == text_.size(); }
    [[nodiscard]] char peek() const { return text_[at_]; }
    [[nodiscard]] Place place() const { return place_; }
    char take() {
        const char c = text_[at_++];
        if (c == '\n') {
            place_ = {place_.line + 1, 1};
        } else if (done() || (static_cast<unsigned char>(peek()) & 0xC0U) != 0x80U) {
            ++place_.column;  // the character has ended
        }
        return c;
    }

 private:
    std::string_view text_;
    std::size_t at_ = 0;
    Place place_{1, 1};
};

bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

// One word from where the cursor is; adds an error where it does not end.
QuotedWord read_word(Cursor& cursor, std::string_view code, Diagnostics& trouble) {
    QuotedWord word{
        {}, cursor.place(), cursor.peek() != '\\' && cursor.peek() != '"' && cursor.peek() != '\''};
    char quote = 0;
    Place opened;
    while (!cursor.done() && (quote != 0 || !is_blank(cursor.peek()))) {
        const Place place = cursor.place();
        const char c = cursor.take();
        if (c == '\\') {
            if (cursor.done()) {
                trouble.error(code, place, "nothing follows this backslash");
                return word;
            }
            word.text += cursor.take();
        } else if (c == '\0') {
            trouble.error(code, place, "this is a NUL byte, which no text holds");
            return word;
        } else if (quote == 0 && (c == '"' || c == '\'')) {
            quote = c;
            opened = place;
        } else if (c == quote) {
            quote = 0;
        } else {
            word.text += c;
        }
    }
    if (quote != 0) trouble.error(code, opened, "this quote is not closed");
    return word;
}

}  // namespace

std::vector<QuotedWord> quoted_words(std::string_view text, std::string_view code, Diagnostics& trouble) {
    std::vector<QuotedWord> words;
    Cursor cursor(text);
    while (!cursor.done() && !trouble.has_errors()) {
        if (is_blank(cursor.peek())) {
            cursor.take();
            continue;
        }
        QuotedWord word = read_word(cursor, code, trouble);
        if (!trouble.has_errors()) words.push_back(std::move(word));
    }
    return words;
}

std::string typed_word(std::string_view word) {
    const auto is_plain = [](char c) {
        return static_cast<unsigned char>(c) >= 0x80U || (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') ||
               (c >= 'A' && c <= 'Z') || std::string_view("-_./=:,+@%").find(c) != std::string_view::npos;
    };
    if (!word.empty() && std::all_of(word.begin(), word.end(), is_plain)) return std::string(word);
    std::string typed = "'";
    for (const char c : word) {
        // Shells take a backslash in single quotes as it is, files of arguments do not.
        const bool apart = c == '\'' || c == '\\';
        typed += apart ? fmt::format("'\\{}'", c) : std::string(1, c);
    }
    return typed + "'";
}

}  // namespace popup
