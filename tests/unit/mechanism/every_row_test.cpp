// Guarantees that every element of the table keeps that stands on folds, whatever its points: what check()
// has mended stays as it is, and closes flat with its seams closed at every angle.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <set>
#include <string>

#include "motion/linkage.h"
#include "popup/motion.h"
#include "support/designs.h"
#include "support/sanitized.h"

namespace popup::test {
namespace {

const auto kSeeds = sanitized_count<std::uint64_t>(5);
// A prime number: whatever the number of rows, each of them comes to stand on some other.
const std::size_t kOneInPairs = kSanitized ? 11 : 1;

// It needs no repair, its seams are closed at every degree, and it closes flat.
void expect_folds(const Design& design) {
    const Built built = build(design);
    ASSERT_TRUE(built.assembly);
    EXPECT_EQ(findings(built.diagnostics), "");
    MotionOptions options;
    for (int deg = 0; deg <= 180; ++deg) options.angles.push_back(Angle::degrees(deg));
    options.examine = false;
    Diagnostics diagnostics;
    const auto motion = simulate(*built.assembly, options, diagnostics);
    ASSERT_TRUE(motion) << findings(diagnostics);
    EXPECT_LE(motion->max_closure_mm, 1e-6);
    EXPECT_LE(motion->flat_error_deg, 1e-6);
}

// Whether random elements of a row stand, after repair, on each fold of some element of another row, or on
// one of its plates. Vacuous where there is no such fold.
bool stands_on_all(const ElementInfo& info, const ElementInfo& ground) {
    constexpr int kTries = 400;
    constexpr int kLeast = 8;     // to know which folds there are
    constexpr int kVacuous = 40;  // to know that there are none
    std::set<std::size_t> wanted;
    std::set<std::size_t> done;
    for (int seed = 1; seed <= kTries; ++seed) {
        const OnAnother made = generate_on(info, ground, static_cast<std::uint64_t>(seed));
        wanted.insert(made.wanted.begin(), made.wanted.end());
        if (made.stands_on) done.insert(*made.stands_on);
        if (seed >= kLeast && (!wanted.empty() || seed >= kVacuous) && done == wanted) return true;
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
        for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
            SCOPED_TRACE(std::string(info.name) + " " + std::to_string(seed));
            const Design design = generate_of(info, seed, 4);
            made += design.structures.size();
            expect_folds(design);
        }
        EXPECT_GT(made, 0U) << info.name;
    }
}

// Everything stands on everything: each element on each fold of each other that is folded in the closed card,
// and each that stands on plates on a plate of each other.
TEST(EveryRow, StandsOnEveryOther) {
    std::size_t pairs = 0;
    for (const ElementInfo& ground : element_table()) {
        for (const ElementInfo& info : element_table()) {
            if (++pairs % kOneInPairs != 0) continue;
            SCOPED_TRACE(std::string(info.name) + " on " + std::string(ground.name));
            EXPECT_TRUE(stands_on_all(info, ground)) << "in some tries";
        }
    }
}

// One on another, eight times: what carries is always what was made last.
TEST(EveryRow, ComposesToDepthEight) {
    constexpr int kDepth = 8;
    const auto kTowers = sanitized_count<std::uint64_t>(8, 4);
    std::set<std::string_view> top;
    int reached = 0;
    for (std::uint64_t seed = 1; seed <= kTowers; ++seed) {
        SCOPED_TRACE(seed);
        const Design design = generate_tower(seed, kDepth);
        if (static_cast<int>(design.structures.size()) < kDepth) continue;
        ++reached;
        for (const Structure& one : design.structures) top.insert(find_element(one.type)->family);
        expect_folds(design);
    }
    EXPECT_GE(reached, kTowers - kTowers / 4);
    EXPECT_GE(top.size(), sanitized_count(8U, 4U)) << "of all kinds";
}

// What the examination takes for one body is one: of equal elements beside one another, the plates that are
// known to move alike keep their distances at every angle.
TEST(EveryRow, TwinsMoveAsOneBody) {
    std::size_t twins = 0;
    for (const ElementInfo& info : element_table()) {
        if (!info.grounds.fold && !info.grounds.seam) continue;
        SCOPED_TRACE(info.name);
        // As far along the gutter as there is room for three.
        std::optional<Assembly> row;
        for (std::uint64_t seed = 1; seed <= 60 && !row; ++seed) {
            Design design = generate_of(info, seed, 1);
            if (design.structures.empty()) continue;
            const Structure first = design.structures[0];
            for (const double along : {-61.0, 66.0}) {
                Structure next = first;
                next.id = "e" + std::to_string(design.structures.size() + 1);
                for (std::size_t i = 0; i < next.points.size(); ++i) {
                    if (info.points[i].page == PointPage::fold) next.points[i].at.y += along;
                }
                for (Argument& argument : next.arguments) {
                    const auto* drawn = std::get_if<DrawnPath>(&argument.value);
                    if (drawn != nullptr && info.grounds.found)
                        argument = path_argument(drawn->path.mapped([&](Vec2 p) {
                            return Vec2{p.x, p.y + along};
                        }));
                }
                design.structures.push_back(std::move(next));
            }
            Diagnostics diagnostics;
            const auto checked = check(design, {}, diagnostics);
            if (checked && !diagnostics.has_findings()) row = assemble(*checked, {}, diagnostics);
        }
        if (!row) continue;
        const Assembly& assembly = *row;
        const Linkage linkage(assembly);
        std::vector<Frame> here(assembly.plates.size());
        std::vector<Frame> there(here.size());
        ASSERT_TRUE(place(assembly, Angle::degrees(41.0), here));
        for (const double deg : {0.0, 90.0, 133.0, 180.0}) {
            ASSERT_TRUE(place(assembly, Angle::degrees(deg), there));
            for (std::size_t i = 0; i < here.size(); ++i) {
                const auto twin = static_cast<std::size_t>(linkage.twin(static_cast<int>(i)));
                if (twin == i) continue;
                ++twins;
                for (const Vec2 p : {Vec2{0, 0}, Vec2{50, 0}, Vec2{0, 50}}) {
                    for (const Vec2 q : {Vec2{0, 0}, Vec2{50, 0}, Vec2{0, 50}}) {
                        EXPECT_NEAR(distance(here[i].point(p), here[twin].point(q)),
                                    distance(there[i].point(p), there[twin].point(q)), 1e-6)
                            << assembly.plates[i].name << " at " << deg;
                    }
                }
            }
        }
    }
    EXPECT_GT(twins, 20U);
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
