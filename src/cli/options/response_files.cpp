#include "cli/options/response_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <optional>
#include <utility>

#include "base/text/quoted_words.h"
#include "base/text/utf8.h"
#include "cli/options/dependency_options.h"
#include "popup/files.h"

namespace popup::cli {
namespace {

constexpr std::size_t kMostBytes = 16u << 20;
constexpr std::size_t kMostWords = 1'000'000;
constexpr std::size_t kDeepest = 16;
constexpr std::string_view kBadFile = "bad-response-file";

bool names_file(std::string_view word) { return word.starts_with('@'); }

class Expansion {
 public:
    explicit Expansion(std::vector<std::string>& files) : files_(files) {}

    void add(std::string word, ExpandedWords::Origin origin) {
        if (expanded.words.size() == kMostWords) {
            throw UsageError(fmt::format("response files make more than {} arguments", kMostWords));
        }
        expanded.words.push_back(std::move(word));
        expanded.origins.push_back(origin);
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
        std::optional<Source> file = read_source(name, trouble, kMostBytes);
        if (!file)
            refuse(fmt::format("the response file {} {}", name, trouble.sorted().front().message), literal);
        if (std::find(files_.begin(), files_.end(), name) == files_.end()) files_.push_back(name);
        open_.push_back(name);
        const std::size_t number = expanded.files.size() + 1;
        expanded.files.push_back(*file);
        std::vector<QuotedWord> read = quoted_words(without_mark(file->text), kBadFile, trouble);
        if (trouble.has_errors()) throw UsageError(trouble, file->text);
        for (QuotedWord& word : read) {
            if (word.plain && names_file(word.text)) {
                const Mention mention{*file, word.place};
                add_file(word.text.substr(1), &mention);
            } else {
                add(std::move(word.text), {number, word.place});
            }
        }
        open_.pop_back();
    }

    ExpandedWords expanded;

 private:
    std::vector<std::string>& files_;
    std::vector<std::string> open_;  // being read, outermost first
};

// The names of an option, as they are given: "-o,--output" is "-o" and "--output", "--MF" is "-MF".
std::vector<std::string> given_names(std::string_view declared) {
    std::vector<std::string> names;
    while (!declared.empty()) {
        const std::string_view name = declared.substr(0, declared.find(','));
        names.push_back(name.starts_with("--") ? shown_option(std::string(name.substr(2)))
                                               : std::string(name));
        declared.remove_prefix(std::min(name.size() + 1, declared.size()));
    }
    return names;
}

// The word that is the value, or holds it, of an option of one of these names; the last one counts.
std::optional<std::size_t> value_at(const std::vector<std::string>& words,
                                    const std::vector<std::string>& names, const std::string& value) {
    for (std::size_t i = words.size(); i-- > 0;) {
        for (const std::string& name : names) {
            if (words[i] == value && i > 0 && words[i - 1] == name) return i;
            if (words[i] == fmt::format("{}={}", name, value)) return i;
            const bool joins = name.size() == 2 || !name.starts_with("--");  // -oFILE, -MFFILE
            if (joins && words[i] == name + value) return i;
        }
    }
    return std::nullopt;
}

// The last option that a message names, such as "--diff excludes --in-place".
std::optional<std::size_t> named_in(std::string_view message, const std::vector<std::string>& words) {
    const auto ends = [message](std::size_t at) {
        return at >= message.size() ||
               (message[at] != '-' && std::isalnum(static_cast<unsigned char>(message[at])) == 0);
    };
    for (std::size_t i = words.size(); i-- > 0;) {
        const std::string_view word = std::string_view(words[i]).substr(0, words[i].find('='));
        if (word.size() < 2 || word.front() != '-' || word == "--") continue;
        const std::size_t at = message.find(word);
        if (at == std::string_view::npos || !ends(at + word.size())) continue;
        if (at == 0 || ends(at - 1)) return i;
    }
    return std::nullopt;
}

}  // namespace

UsageError placed(const UsageError& error, const ExpandedWords& expanded) {
    if (expanded.files.empty() || error.in_file() != nullptr) return error;
    const std::vector<std::string>& words = expanded.words;
    const auto& [option, value] = error.culprit();
    std::optional<std::size_t> at;
    if (!option.empty()) {
        at = value_at(words, given_names(option), value);
    } else if (!value.empty()) {
        const auto found = std::find(words.begin(), words.end(), value);
        if (found != words.end()) at = static_cast<std::size_t>(found - words.begin());
    } else {
        at = named_in(error.what(), words);
    }
    if (!at || expanded.origins[*at].file == 0) return error;
    const auto& [number, place] = expanded.origins[*at];
    const Source& file = expanded.files[number - 1];
    Diagnostics trouble(file.name);
    Diagnostic& told = trouble.error(kBadFile, place, error.what());
    for (const std::string& hint : error.hints()) told.hint(hint);
    return {trouble, file.text};
}

ExpandedWords expand_response_files(const std::vector<std::string>& arguments,
                                    std::vector<std::string>& files) {
    if (std::none_of(arguments.begin(), arguments.end(), names_file)) return {arguments, {}, {}};
    Expansion expansion(files);
    for (const std::string& argument : arguments) {
        if (names_file(argument)) {
            expansion.add_file(argument.substr(1), nullptr);
        } else {
            expansion.add(argument, {});
        }
    }
    return std::move(expansion.expanded);
}

}  // namespace popup::cli
