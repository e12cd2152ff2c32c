#include "cli/response_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "popup/files.h"

namespace popup::cli {
namespace {

constexpr std::size_t kMostBytes = 16u << 20;
constexpr std::size_t kMostWords = 1'000'000;
constexpr std::size_t kDeepest = 16;
constexpr std::string_view kBadFile = "bad-response-file";

bool names_file(std::string_view word) { return word.starts_with('@'); }

struct Word {
    std::string text;
    Place place;         // where it begins
    bool plain = false;  // begins with neither a quote nor a backslash
};

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
Word read_word(Cursor& cursor, Diagnostics& trouble) {
    Word word{{}, cursor.place(), cursor.peek() != '\\' && cursor.peek() != '"' && cursor.peek() != '\''};
    char quote = 0;
    Place opened;
    while (!cursor.done() && (quote != 0 || !is_blank(cursor.peek()))) {
        const Place place = cursor.place();
        const char c = cursor.take();
        if (c == '\\') {
            if (cursor.done()) {
                trouble.error(kBadFile, place, "nothing follows this backslash");
                return word;
            }
            word.text += cursor.take();
        } else if (c == '\0') {
            trouble.error(kBadFile, place, "this is a NUL byte; a response file is a text");
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
    if (quote != 0) trouble.error(kBadFile, opened, "this quote is not closed");
    return word;
}

class Expansion {
 public:
    explicit Expansion(std::vector<std::string>& files) : files_(files) {}

    void add(std::string word) {
        if (words.size() == kMostWords) {
            throw UsageError(fmt::format("response files make more than {} arguments", kMostWords));
        }
        words.push_back(std::move(word));
    }

    // `outer` tells where the name stands; null on the command line.
    struct Mention {
        const Source& file;
        Place place;
    };
    void add_file(const std::string& name, const Mention* outer) {
        const auto refuse = [outer](const std::string& message, const std::string& hint) {
            if (outer == nullptr) throw UsageError(message, {hint});
            Diagnostics trouble(outer->file.name);
            trouble.error(kBadFile, outer->place, message).hint(hint);
            throw UsageError(trouble, outer->file.text);
        };
        const std::string literal =
            fmt::format("an argument that begins with @ itself is written ./@{}", name);
        if (name.empty()) refuse("@ names no response file", "write @FILE, or ./@ for a file of that name");
        if (name == "-")
            refuse("a response file is not read from standard input", "xargs makes arguments of it");
        if (std::find(open_.begin(), open_.end(), name) != open_.end()) {
            refuse(fmt::format("the response file {} names itself", name),
                   fmt::format("{} -> {}", fmt::join(open_, " -> "), name));
        }
        if (open_.size() == kDeepest) {
            refuse(fmt::format("more than {} response files are in each other", kDeepest),
                   "put their words into fewer files");
        }
        Diagnostics trouble(name);
        const std::optional<Source> file = read_source(name, trouble, kMostBytes);
        if (!file)
            refuse(fmt::format("the response file {} {}", name, trouble.sorted().front().message), literal);
        if (std::find(files_.begin(), files_.end(), name) == files_.end()) files_.push_back(name);
        open_.push_back(name);
        Cursor cursor(file->text);
        while (!cursor.done()) {
            if (is_blank(cursor.peek())) {
                cursor.take();
                continue;
            }
            Word word = read_word(cursor, trouble);
            if (trouble.has_errors()) throw UsageError(trouble, file->text);
            if (word.plain && names_file(word.text)) {
                const Mention mention{*file, word.place};
                add_file(word.text.substr(1), &mention);
            } else {
                add(std::move(word.text));
            }
        }
        open_.pop_back();
    }

    std::vector<std::string> words;

 private:
    std::vector<std::string>& files_;
    std::vector<std::string> open_;  // being read, outermost first
};

}  // namespace

std::vector<std::string> expand_response_files(const std::vector<std::string>& arguments,
                                               std::vector<std::string>& files) {
    if (std::none_of(arguments.begin(), arguments.end(), names_file)) return arguments;
    Expansion expansion(files);
    for (const std::string& argument : arguments) {
        if (names_file(argument)) {
            expansion.add_file(argument.substr(1), nullptr);
        } else {
            expansion.add(argument);
        }
    }
    return std::move(expansion.words);
}

}  // namespace popup::cli
