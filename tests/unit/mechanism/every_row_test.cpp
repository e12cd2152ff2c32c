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

// Whether random elements of a row stand, after repair, on each fold of some element of another row, or on
// one of its plates. Vacuous where there is no such fold.
bool stands_on_all(const ElementInfo& info, const ElementInfo& ground) {
    constexpr int kTries = 400;
    std::set<std::size_t> wanted;
    std::set<std::size_t> done;
    for (int seed = 1; seed <= kTries; ++seed) {
        const OnAnother made = generate_on(info, ground, static_cast<std::uint64_t>(seed));
        wanted.insert(made.wanted.begin(), made.wanted.end());
        if (made.stands_on) done.insert(*made.stands_on);
        if (seed >= 40 && done == wanted) return true;
    }
    std::string missing;
    for (const std::size_t fold : wanted) {
        if (!done.contains(fold))
            missing += " " + std::string(ground.folds.empty() ? "plate" : ground.folds[fold].name);
    }
    ADD_FAILURE() << "never on:" << missing;
    return false;
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

// Everything stands on everything: each element on each fold of each other that is folded in the closed card,
// and each that stands on plates on a plate of each other.
TEST(EveryRow, StandsOnEveryOther) {
    for (const ElementInfo& ground : element_table()) {
        for (const ElementInfo& info : element_table()) {
            SCOPED_TRACE(std::string(info.name) + " on " + std::string(ground.name));
            EXPECT_TRUE(stands_on_all(info, ground)) << "in some tries";
        }
    }
}

// One on another, eight times: what carries is always what was made last.
TEST(EveryRow, ComposesToDepthEight) {
    constexpr int kDepth = 8;
    std::set<std::string_view> top;
    int reached = 0;
    for (std::uint64_t seed = 1; seed <= 24; ++seed) {
        SCOPED_TRACE(seed);
        const Design design = generate_tower(seed, kDepth);
        if (static_cast<int>(design.structures.size()) < kDepth) continue;
        ++reached;
        for (const Structure& one : design.structures) top.insert(find_element(one.type)->family);
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
        EXPECT_LE(motion->flat_error_deg, 1e-6);
    }
    EXPECT_GE(reached, 12);
    EXPECT_GE(top.size(), 8U) << "of all kinds";
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
