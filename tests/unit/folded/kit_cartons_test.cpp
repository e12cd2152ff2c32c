// The cartons of the kit: what their panels are called, and what may be accepted of what is suggested.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "popup/files.h"
#include "popup/language.h"
#include "popup/motion.h"
#include "popup/refinement.h"
#include "support/run_program.h"
#include "support/sanitized.h"

namespace popup {
namespace {

const std::filesystem::path kCartons = std::filesystem::path(POPUP_SOURCE_DIR) / "samples/cartons";

std::optional<CreasePattern> drawing(const std::filesystem::path& path) {
    Diagnostics diagnostics;
    const auto source = read_source(path.string(), diagnostics);
    if (!source) return std::nullopt;
    return read_source_text(*source, {}, diagnostics).creases;
}

struct NamedCarton {
    const char* file;
    const char* names;  // in the order of the sheet's tree
};
constexpr NamedCarton kNamedCartons[]{
    {"auto-lock-bottom",
     "back right left top bottom-flap-back front top-dust-flap-right bottom-flap-right top-dust-flap-left "
     "bottom-flap-left top-tuck glue-flap bottom-flap-front bottom-glue-corner-right "
     "bottom-glue-corner-left"},
    {"fefco-0201",
     "back right left bottom-flap-back top-flap-back front bottom-flap-right top-flap-right "
     "bottom-flap-left top-flap-left glue-flap bottom-flap-front top-flap-front"},
    {"fefco-0215",
     "back right left top bottom-flap-back front top-dust-flap-right bottom-flap-right top-dust-flap-left "
     "bottom-flap-left top-tuck glue-flap bottom-flap-front"},
    {"fefco-0421",
     "base front back left right front-corner-left front-corner-right back-corner-left back-corner-right "
     "left-rim right-rim left-lining right-lining"},
    {"fefco-0427",
     "base front back left right front-corner-left front-corner-right back-corner-left back-corner-right "
     "lid left-rim right-rim lid-tuck left-lining right-lining lid-tuck-ear-left lid-tuck-ear-right"},
    {"gift-bag",
     "back right-1 left-1 top-flap-back bottom-flap-back right-2 top-flap-right-1 bottom-flap-right-1 "
     "left-2 top-flap-left-1 bottom-flap-left-1 front top-flap-right-2 bottom-flap-right-2 top-flap-left-2 "
     "bottom-flap-left-2 glue-flap top-flap-front bottom-flap-front"},
    {"hexagonal-box",
     "bottom back bottom-tuck wall-3 wall-5 top wall-2 bottom-dust-flap-wall-3 top-dust-flap-wall-3 wall-6 "
     "bottom-dust-flap-wall-5 top-dust-flap-wall-5 top-tuck front bottom-dust-flap-wall-2 "
     "top-dust-flap-wall-2 bottom-dust-flap-wall-6 top-dust-flap-wall-6 glue-flap"},
    {"reverse-tuck-end",
     "back right left top front bottom-dust-flap-right top-dust-flap-right bottom-dust-flap-left "
     "top-dust-flap-left top-tuck glue-flap bottom bottom-tuck"},
    {"sleeve", "back right left front glue-flap"},
    {"straight-tuck-end",
     "bottom back bottom-tuck right left top front bottom-dust-flap-right top-dust-flap-right "
     "bottom-dust-flap-left top-dust-flap-left top-tuck glue-flap"},
    {"tray-with-lid",
     "base back front left right left-corner-front left-corner-back right-corner-front right-corner-back "
     "base back front left right left-corner-front left-corner-back right-corner-front right-corner-back"},
};

// However far the folds go in the end, and with last digits that differ.
TEST(KitCartons, HaveTheirPanelsNamed) {
    for (const auto& [file, names] : kNamedCartons) {
        const auto drawn = drawing(kCartons / (std::string(file) + ".fl"));
        ASSERT_TRUE(drawn) << file;
        for (const double share : {1.0, 0.2}) {
            CreasePattern pattern = *drawn;
            for (CreaseLine& line : pattern.lines) {
                if (line.fold_deg) *line.fold_deg *= line.fold_deg < 170.0 ? share : 1.0;
                for (Vec2& point : line.points) point = (1.0 + 1e-9) * point;
            }
            Diagnostics diagnostics;
            const auto assembly = fold_sheet(pattern, {}, diagnostics);
            ASSERT_TRUE(assembly) << file;
            std::string all;
            for (const Plate& plate : assembly->plates)
                all += (all.empty() ? "" : " ") + plate.name.substr(plate.name.find('/') + 1);
            EXPECT_EQ(all, names) << file << " folded to " << share;
        }
    }
}

// What crosses in a sheet while it is folded, by the names of the panels.
Crossings crossings_of(const CreasePattern& pattern, bool whole_way) {
    Diagnostics diagnostics;
    Crossings found;
    auto assembly = fold_sheet(pattern, {}, diagnostics);
    if (!assembly) return found;
    std::optional<Motion> motion;
    if (whole_way) motion = simulate_sheet(*assembly, {}, diagnostics);
    const Examination seen = motion ? motion->examination.value() : examine_folded(*assembly, {});
    for (const Contact& one : seen.contacts) {
        const auto name = [&](int plate) { return assembly->plates[static_cast<std::size_t>(plate)].name; };
        found.insert(std::minmax(name(one.a), name(one.b)));
    }
    return found;
}

// The kit's cartons by their names; under the sanitizers one of so many.
std::vector<std::filesystem::path> cartons(std::size_t of) {
    std::vector<std::filesystem::path> all;
    for (const auto& file : std::filesystem::directory_iterator(kCartons)) {
        if (file.path().extension() == ".fl") all.push_back(file.path());
    }
    EXPECT_EQ(all.size(), 11U);
    std::sort(all.begin(), all.end());
    std::vector<std::filesystem::path> some;
    for (std::size_t i = 0; i < all.size(); i += test::kSanitized ? of : 1) some.push_back(all[i]);
    return some;
}

// All of the kit's cartons: what is accepted of all closes, swings nothing, and brings no crossing.
TEST(KitCartons, MayBeAcceptedWhole) {
    for (const std::filesystem::path& file : cartons(4)) {
        const auto pattern = drawing(file);
        ASSERT_TRUE(pattern) << file;
        Diagnostics diagnostics;
        const auto found = suggest_joins(*pattern, {}, diagnostics);
        ASSERT_TRUE(found) << file;
        for (const Suggestion& row : found->rows) {
            EXPECT_TRUE(row.closes || row.residual_mm < 0.95 * row.apart_mm || row.swings)
                << file << ": " << row.name() << " leaves " << row.residual_mm << " of " << row.apart_mm;
            EXPECT_FALSE(row.closes && row.turn_deg > 180.0) << file << ": " << row.name();
        }
        const auto joins = accept_joins(*pattern, {}, *found, "all", {true, crossings_of}, diagnostics);
        ASSERT_TRUE(joins) << file;
        const auto refined = refine_shape(*pattern, {{}, *joins}, diagnostics);
        ASSERT_TRUE(refined) << file;
        EXPECT_TRUE(refined->closes) << file;
        EXPECT_LE(refined->residual_mm, refined->enough_mm) << file;
        // As they are drawn, nothing crosses in any of them: other tests see to that.
        for (const auto& [a, b] : crossings_of(refined->pattern, true))
            ADD_FAILURE() << file << ": " << a << " crosses " << b;
        EXPECT_FALSE(diagnostics.has_findings()) << file;
    }
}

// Folds by which way and how far they go, and how long they are; rounded, and sorted. Small ones may differ
// in a digit.
std::vector<std::pair<long, long>> folds_of(const CreasePattern& pattern) {
    Diagnostics diagnostics;
    const auto assembly = fold_sheet(pattern, {}, diagnostics);
    std::vector<std::pair<long, long>> folds;
    if (!assembly) return folds;
    for (const Line& line : assembly->lines) {
        if (line.kind != LineKind::mountain && line.kind != LineKind::valley) continue;
        const double deg = line.fold_angle.value_or(0.0) * 180.0 / std::numbers::pi;
        folds.emplace_back(std::lround((line.kind == LineKind::mountain ? -10.0 : 10.0) * deg),
                           std::lround(100.0 * distance(line.at.a, line.at.b)));
    }
    std::sort(folds.begin(), folds.end());
    return folds;
}

// All of the kit's cartons, built as SVG and as FOLD and read again: all folds go as far as they did, and
// nothing collides.
TEST(KitCartons, FoldClosedWhenTheyAreReadBack) {
    for (const std::filesystem::path& file : cartons(6)) {
        const auto pattern = drawing(file);
        ASSERT_TRUE(pattern) << file;
        const test::ScratchDirectory there;
        const test::RunOptions in_there{.directory = there.path(), .input = {}, .environment = {}};
        const test::RunResult built =
            test::popupc({"build", file.string(), "-o", "box.svg", "-o", "box.fold", "-q"}, in_there);
        ASSERT_EQ(built.exit, 0) << file << built.err;
        std::vector<std::pair<long, long>> of_sheets;  // a carton of two pieces has two
        for (const auto& made : std::filesystem::directory_iterator(there.path())) {
            ReadOptions read;
            read.drawing.as = DrawnAs::folded;
            Diagnostics diagnostics;
            const auto source = read_source(made.path().string(), diagnostics);
            ASSERT_TRUE(source);
            const auto again = read_source_text(*source, read, diagnostics).creases;
            ASSERT_TRUE(again) << file << made.path();
            const auto folds = folds_of(*again);
            const bool is_fold = made.path().extension() == ".fold";
            if (is_fold) {
                EXPECT_EQ(folds, folds_of(*pattern)) << file;
            } else {
                of_sheets.insert(of_sheets.end(), folds.begin(), folds.end());
            }
            const test::RunResult checked =
                test::popupc({"check", made.path().string(), "--as", "folded"}, in_there);
            EXPECT_EQ(checked.exit, 0) << file << checked.err;
            EXPECT_EQ(checked.err.find("warning"), std::string::npos) << file << checked.err;
        }
        std::sort(of_sheets.begin(), of_sheets.end());
        EXPECT_EQ(of_sheets, folds_of(*pattern)) << file;
    }
}

// A flap of the bottom and the lid upon it, a board apart: to bring them into one plane the walls would have
// to swing by two thirds of a right angle.
TEST(KitCartons, DoNotCloseByWhatSwingsFar) {
    const auto pattern = drawing(kCartons / "reverse-tuck-end.fl");
    ASSERT_TRUE(pattern);
    Diagnostics diagnostics;
    const auto found = suggest_joins(*pattern, {}, diagnostics);
    ASSERT_TRUE(found);
    int swinging = 0;
    for (const Suggestion& row : found->rows) {
        if (row.join.kind != JoinKind::paste || !row.swings) continue;
        ++swinging;
        EXPECT_FALSE(row.closes);
        EXPECT_GT(row.turn_deg, 60.0);
        const auto refined = refine_shape(*pattern, {{}, {row.join}}, diagnostics);
        ASSERT_TRUE(refined);
        EXPECT_EQ(diagnostics.sorted().front().code, "join-swings");
    }
    EXPECT_EQ(swinging, 1);
}

}  // namespace
}  // namespace popup
