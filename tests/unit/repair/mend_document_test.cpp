// Repaired documents: their numbers are as short as can be, and mean what the repairs were.
#include "repair/mend_document.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "repair/short_numbers.h"
#include "support/run_program.h"

namespace popup {
namespace {

namespace fs = std::filesystem;

CompiledDesign checked(const std::string& text) {
    CompileOptions options;
    options.until = Stage::check;
    Compilation run = compile({{"card.xml", text}}, options, {});
    return std::move(run.designs.front());
}

std::string mended(const CompiledDesign& one) {
    const auto text = mended_document(one, *find_language({}, "xml"), {});
    EXPECT_TRUE(text.has_value());
    return text.value_or("");
}

// The digits behind the point of all numbers that stand in quotes.
std::vector<std::string> fractions(const std::string& text) {
    std::vector<std::string> found;
    for (std::size_t at = text.find('"'); at != std::string::npos; at = text.find('"', at + 1)) {
        const std::size_t end = text.find_first_not_of("-.0123456789", at + 1);
        const std::size_t point = text.find('.', at + 1);
        if (end == std::string::npos || text[end] != '"' || point >= end) continue;
        found.push_back(text.substr(point + 1, end - point - 1));
    }
    return found;
}

std::vector<Vec2> points_of(const CompiledDesign& design) {
    std::vector<Vec2> points;
    for (const Structure& one : design.checked->design().structures) {
        for (const DesignPoint& point : one.points) points.push_back(point.at);
        points.push_back(one.fold.begin.at);
        points.push_back(one.fold.end.at);
    }
    return points;
}

TEST(MendedDocument, IsWrittenInFewDigitsAndMeansTheSame) {
    const fs::path repairs = fs::path(POPUP_SOURCE_DIR) / "tests/cases/repair";
    std::size_t rounded = 0;
    for (const auto& entry : fs::recursive_directory_iterator(repairs)) {
        if (entry.path().extension() != ".xml" || entry.path().filename().string().starts_with("bad-"))
            continue;
        SCOPED_TRACE(entry.path());
        const std::string text = test::read_file(entry.path());
        const CompiledDesign before = checked(text);
        if (!before.checked || before.diagnostics.repairs().empty()) continue;
        const std::string written = mended(before);
        const CompiledDesign after = checked(written);
        EXPECT_TRUE(after.diagnostics.repairs().empty()) << written;
        EXPECT_FALSE(after.diagnostics.has_errors());
        const std::vector<Vec2> meant = points_of(before);
        const std::vector<Vec2> are = points_of(after);
        ASSERT_EQ(meant.size(), are.size());
        for (std::size_t i = 0; i < meant.size(); ++i)
            EXPECT_LE(distance(meant[i], are[i]), std::sqrt(2.0) * 0.005 + 1e-6) << i;
        // As long as they were written, or as short as their unit allows.
        const std::vector<std::string> old = fractions(text);
        const auto few = static_cast<std::size_t>(short_decimals(before.checked->design().unit));
        for (const std::string& digits : fractions(written)) {
            if (std::find(old.begin(), old.end(), digits) != old.end()) continue;
            EXPECT_LE(digits.size(), few) << digits << " in\n" << written;
            ++rounded;
        }
    }
    EXPECT_GT(rounded, 5U);
}

TEST(MendedDocument, CountsDecimalsByTheUnit) {
    EXPECT_EQ(short_decimals({"mm", 1.0}), 2);
    EXPECT_EQ(short_decimals({"in", 25.4}), 4);
    EXPECT_EQ(short_decimals({"cm", 10.0}), 3);
}

// What is not repaired keeps its digits, and where rounding breaks a repair it is written exactly.
TEST(MendedDocument, KeepsWhatIsNotRepairedAsItIsWritten) {
    Design design;
    design.unit = {"mm", 1.0};
    const std::string text = "-74.00012345 20.123456789";
    Structure& one = design.structures.emplace_back();
    one.type = "step";
    one.id = "a";
    DesignPoint point;
    point.at = {-73.000046, 20.123456789};
    point.x_text = {0, 12};
    point.y_text = {13, 12};
    point.changed = true;
    one.points = {point, point};
    one.points[1].changed = false;
    DesignPoint& end = one.fold.begin;
    end = point;
    Design exact = design;
    shorten_numbers(design, text, {});
    EXPECT_EQ(one.points[0].at, (Vec2{-73.0, 20.123456789}));
    EXPECT_EQ(one.points[1].at, (Vec2{-73.000046, 20.123456789}));
    EXPECT_EQ(one.fold.begin.at, (Vec2{-73.0, 20.123456789}));
    shorten_numbers(exact, text, {{"a", 6}});
    EXPECT_EQ(exact.structures[0].points[0].at, (Vec2{-73.000046, 20.123456789}));
}

}  // namespace
}  // namespace popup
