// What `popupc suggest` writes is of the sheet as the options say it once.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "support/run_program.h"

namespace popup {
namespace {

const std::filesystem::path kCases = std::filesystem::path(POPUP_SOURCE_DIR) / "tests/cases";

// The angles of the folds in the crease pattern of a FOLD file, to a tenth of a degree.
std::set<double> angles_of(const std::filesystem::path& file) {
    const auto fold = nlohmann::json::parse(test::read_file(file));
    std::set<double> angles;
    for (const auto& one : fold.at("edges_foldAngle")) {
        const double deg = one.is_null() ? 0.0 : one.get<double>();
        if (deg != 0.0) angles.insert(std::round(std::abs(deg) * 10.0) / 10.0);
    }
    return angles;
}

// Refining folds the sheet to that share, and the refined sheet is folded again, all the way.
TEST(SuggestVerb, FoldsToTheShareOfTheirAnglesOnce) {
    const test::ScratchDirectory there;
    std::filesystem::copy(kCases / "suggest/gift.svg", there / "gift.svg");
    test::write_file(there / "none.json", R"({"joins": []})");
    const test::RunResult run = test::popupc({"suggest", "gift.svg", "--fold-to", "0.5", "--refinement",
                                              "none.json", "-o", "gift.fold", "--quiet"},
                                             {.directory = there.path(), .input = {}, .environment = {}});
    ASSERT_EQ(run.exit, 0) << run.err;
    EXPECT_EQ(angles_of(there / "gift.fold"), std::set<double>{45.0});
}

// The sheet that was made has its allowances: for the same board nothing of it is moved again.
TEST(SuggestVerb, AllowsForTheBoardOnce) {
    const test::ScratchDirectory there;
    std::filesystem::copy(kCases / "board/tube.svg", there / "tube.svg");
    test::write_file(there / "none.json", R"({"joins": []})");
    const test::RunOptions here{.directory = there.path(), .input = {}, .environment = {}};
    const test::RunResult run = test::popupc(
        {"suggest", "tube.svg", "--board", "0.5mm", "--refinement", "none.json", "-o", "thick.fold"}, here);
    ASSERT_EQ(run.exit, 0) << run.err;
    std::size_t moved = 0;
    for (std::size_t at = run.err.find("[crease-moved]"); at != std::string::npos;
         at = run.err.find("[crease-moved]", at + 1))
        ++moved;
    EXPECT_EQ(moved, 4U) << run.err;
    const test::RunResult again = test::popupc({"check", "thick.fold", "--board", "0.5mm"}, here);
    EXPECT_EQ(again.err.find("[crease-moved]"), std::string::npos) << again.err;
    EXPECT_NE(again.err.find("the blank is 211.50 × 111.25 mm"), std::string::npos) << again.err;
}

}  // namespace
}  // namespace popup
