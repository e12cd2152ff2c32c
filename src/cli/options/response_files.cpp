#include "cli/options/response_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "base/text/quoted_words.h"
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
        std::vector<QuotedWord> read = quoted_words(file->text, kBadFile, trouble);
        if (trouble.has_errors()) throw UsageError(trouble, file->text);
        for (QuotedWord& word : read) {
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
