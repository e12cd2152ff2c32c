#include "base/text/quoted_words.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace popup {
namespace {

TEST(QuotedWords, AreTypedPlainWhereTheyCanBe) {
    EXPECT_EQ(typed_word("roof"), "roof");
    EXPECT_EQ(typed_word("--along=-3.5mm"), "--along=-3.5mm");
    EXPECT_EQ(typed_word("Türme"), "Türme");
    EXPECT_EQ(typed_word("my roof"), "'my roof'");
    EXPECT_EQ(typed_word("#0000cc=60"), "'#0000cc=60'");
    EXPECT_EQ(typed_word("it's"), "'it'\\''s'");
    EXPECT_EQ(typed_word(""), "''");
}

TEST(QuotedWords, AreReadAsTheyWereBeforeTheyWereTyped) {
    const std::vector<std::string> words{"a",  "my roof", "it's", "\"x\"", "a\nb",  "$HOME", "`ls`",
                                         "\\", "*",       "~",    "'",     "--x='", "äö ü",  ""};
    std::string line;
    for (const std::string& word : words) line += typed_word(word) + " ";
    Diagnostics trouble;
    std::vector<std::string> read;
    for (const QuotedWord& word : quoted_words(line, "bad-option", trouble)) read.push_back(word.text);
    EXPECT_EQ(read, words);
    EXPECT_FALSE(trouble.has_findings());
}

}  // namespace
}  // namespace popup
