// What fuzzing found once, looked at as fuzzing does: fuzz/finds/TARGET holds the inputs, fuzz/targets what
// is expected of them. Each crashed, hung or broke a promise when it was found.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <string>
#include <string_view>

#include "fuzz/targets/target.h"
#include "support/run_program.h"

namespace popup::fuzz {
namespace {

namespace fs = std::filesystem;

struct Row {
    std::string_view name;
    void (*look)(std::string_view bytes);
};

constexpr auto kTargets = std::to_array<Row>({
#define POPUP_FUZZ_TARGET(name, longest, seeds, dictionary) {#name, look_at_##name},
#include "fuzz/targets/targets.inc"
#undef POPUP_FUZZ_TARGET
});

const fs::path kFolder = fs::path(POPUP_SOURCE_DIR) / "tests/fuzz";

class FuzzFinds : public testing::TestWithParam<Row> {};

TEST_P(FuzzFinds, HoldWhatIsPromised) {
    const Row& target = GetParam();
    for (const std::string_view little : {"", "-", "\n", "{}", "[]", "<a/>", "\xef\xbb\xbf"})
        EXPECT_NO_THROW(target.look(little)) << '"' << little << '"';
    for (const std::string folder : {"finds", "seeds"}) {
        const fs::path inputs = kFolder / folder / target.name;
        if (!fs::exists(inputs)) continue;
        for (const fs::directory_entry& input : fs::directory_iterator(inputs)) {
            SCOPED_TRACE(input.path().string());
            EXPECT_NO_THROW(target.look(test::read_file(input.path())));
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Targets, FuzzFinds, testing::ValuesIn(kTargets),
                         [](const testing::TestParamInfo<Row>& row) { return std::string(row.param.name); });

// A folder that no target has would never be looked at.
TEST(FuzzFindsFolders, AreThoseOfTargets) {
    for (const std::string folder : {"finds", "seeds"}) {
        if (!fs::exists(kFolder / folder)) continue;
        for (const fs::directory_entry& one : fs::directory_iterator(kFolder / folder)) {
            const std::string name = one.path().filename().string();
            EXPECT_TRUE(std::any_of(kTargets.begin(), kTargets.end(),
                                    [&](const Row& row) { return row.name == name; }))
                << folder << "/" << name;
        }
    }
}

}  // namespace
}  // namespace popup::fuzz
