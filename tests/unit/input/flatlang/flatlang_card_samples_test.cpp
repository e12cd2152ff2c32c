// The shipped programs that write cards, with other values of their variables.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "support/run_program.h"

namespace popup {
namespace {

TEST(FlatLangCardSamples, CheckWithoutFindingsWithTheirFamilies) {
    const std::filesystem::path samples = std::filesystem::path(POPUP_SOURCE_DIR) / "samples";
    const std::vector<std::vector<std::string>> runs{
        {"staircase.fl"},
        {"staircase.fl", "-D", "steps=9", "-D", "width=6"},
        {"street.fl"},
        {"street.fl", "-D", "houses=8", "-D", "floors=6"},
        {"street.fl", "-D", "houses=3", "-D", "floors=2", "-D", "seed=3"},
        {"valley.fl"},
        {"valley.fl", "-D", "peaks=4", "-D", "long=10"},
    };
    for (const auto& words : runs) {
        std::vector<std::string> arguments{"check", (samples / words[0]).string()};
        arguments.insert(arguments.end(), words.begin() + 1, words.end());
        const auto result = test::popupc(arguments);
        EXPECT_EQ(result.exit, 0) << words[0];
        EXPECT_EQ(result.out + result.err, "") << words[0];
    }
}

}  // namespace
}  // namespace popup
