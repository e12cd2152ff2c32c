// Guarantees that every element of the table keeps that stands on folds, whatever its points: what check()
// has mended stays as it is, and closes flat with its seams closed at every angle.
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "popup/motion.h"
#include "support/designs.h"

namespace popup::test {
namespace {

std::vector<Angle> whole_degrees() {
    std::vector<Angle> angles;
    for (int deg = 0; deg <= 180; ++deg) angles.push_back(Angle::degrees(deg));
    return angles;
}

TEST(EveryRow, OfRandomPointsComesAnElementThatFolds) {
    for (const ElementInfo& info : element_table()) {
        if (!info.grounds.fold && !info.grounds.seam) continue;
        std::size_t made = 0;
        for (std::uint64_t seed = 1; seed <= 5; ++seed) {
            SCOPED_TRACE(std::string(info.name) + " " + std::to_string(seed));
            const Design design = generate_of(info, seed, 4);
            made += design.structures.size();
            const Built built = build(design);
            ASSERT_TRUE(built.assembly);
            EXPECT_EQ(findings(built.diagnostics), "");
            MotionOptions options;
            options.angles = whole_degrees();
            options.examine = false;
            Diagnostics diagnostics;
            const auto motion = simulate(*built.assembly, options, diagnostics);
            ASSERT_TRUE(motion) << findings(diagnostics);
            EXPECT_LE(motion->max_closure_mm, 1e-6);
            EXPECT_TRUE(motion->flat_closed);
        }
        EXPECT_GT(made, 0U) << info.name;
    }
}

// On each of the folds that it names an element makes one, and check() knows it by the same line.
TEST(EveryRow, NamesItsFolds) {
    for (const ElementInfo& info : element_table()) {
        std::set<std::string_view> names;
        for (const FoldInfo& fold : info.folds) EXPECT_TRUE(names.insert(fold.name).second) << info.name;
        ASSERT_EQ(info.partners.size(), info.points.size()) << info.name;
        std::set<std::string_view> parameters;
        for (const ParameterInfo& parameter : info.parameters) {
            EXPECT_TRUE(parameters.insert(parameter.name).second) << info.name;
            EXPECT_FALSE(parameter.about.empty()) << info.name << " " << parameter.name;
            EXPECT_EQ(parameter.name.find_first_not_of("abcdefghijklmnopqrstuvwxyz"), std::string_view::npos);
            EXPECT_EQ(parameter.kind == ParameterKind::choice, !parameter.words.empty()) << parameter.name;
            if (!parameter.partner.empty()) {
                EXPECT_TRUE(find_parameter(info, parameter.partner));
            }
        }
    }
}

}  // namespace
}  // namespace popup::test
