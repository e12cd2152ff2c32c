#include "base/text/nearest.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <random>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace popup {
namespace {

// What the header says, without a thought of what it costs.
std::vector<std::string> ranked(std::string_view word, const std::vector<std::string>& candidates) {
    std::vector<std::pair<std::size_t, std::string>> all;
    for (const std::string& one : candidates) {
        const bool begins = word.size() >= 2 && (one.starts_with(word) || word.starts_with(one));
        const std::size_t changes = begins ? 1 : edit_distance(word, one);
        const bool is_answer = changes <= std::max<std::size_t>(2, one.size() / 3) && changes < one.size();
        if (is_answer) all.emplace_back(changes, one);
    }
    std::ranges::stable_sort(all, {}, &std::pair<std::size_t, std::string>::first);
    std::vector<std::string> words;
    for (const auto& [changes, one] : all) words.push_back(one);
    return words;
}

// Of few letters and all lengths, so that words of other lengths are near, too.
TEST(Nearest, LeavesOutNoWordThatIsNear) {
    std::mt19937 random(7);
    const auto word_of = [&](std::size_t most) {
        std::string word(1 + random() % most, 'a');
        for (char& letter : word) letter = static_cast<char>('a' + random() % 3);
        return word;
    };
    std::size_t answers_of_other_length = 0;
    for (int i = 0; i < 300; ++i) {
        const std::string word = word_of(14);
        std::vector<std::string> candidates;
        for (int k = 0; k < 30; ++k) candidates.push_back(word_of(14));
        const std::vector<std::string> expected = ranked(word, candidates);
        for (const std::string& one : expected) answers_of_other_length += one.size() != word.size() ? 1 : 0;
        const std::vector<std::string_view> views(candidates.begin(), candidates.end());
        EXPECT_EQ(nearest(word, views, candidates.size()), expected) << word;
    }
    EXPECT_GT(answers_of_other_length, 300U);
}

}  // namespace
}  // namespace popup
