// Elements moved apart: what is promised of the document that comes out, by the examination and by brute
// force.
#include "repair/free_collisions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

#include "mechanism/footings.h"
#include "output/xml.h"
#include "support/brute_force.h"
#include "support/designs.h"
#include "support/random.h"

namespace popup {
namespace {

using Pairs = std::set<std::pair<std::string, std::string>>;

CompiledDesign compiled(const std::string& text) {
    CompileOptions options;
    options.until = Stage::motion;
    Compilation run = compile({{"card.xml", text}}, options, {});
    return std::move(run.designs.front());
}

std::string owner(const Assembly& assembly, int plate) {
    const std::string& name = assembly.plates[static_cast<std::size_t>(plate)].name;
    return name.substr(0, name.rfind('/'));
}

Pairs colliding(const CompiledDesign& design) {
    Pairs pairs;
    for (const Contact& one : design.motion->examination->contacts)
        pairs.insert(std::minmax(owner(*design.assembly, one.a), owner(*design.assembly, one.b)));
    return pairs;
}

// Tents and v-folds at random places of the gutter, and a tent on the first one's centre fold: most of them
// collide.
Design crowd(std::uint64_t seed) {
    test::Random random(seed);
    Design design = test::card(240, 300);
    const std::size_t count = 2 + random.below(3);
    for (std::size_t i = 0; i < count; ++i) {
        const double at = -90 + 180 * random.unit();
        const double half = 8 + 14 * random.unit();
        const double out = 12 + 20 * random.unit();
        Structure* made = nullptr;
        if (random.below(2) == 0) {
            const double wide = out + 10 * random.unit();
            made = &test::add_tent(design, at, half, out, wide);
        } else {
            const double far = 10 + 15 * random.unit();
            made = &test::add(design, "v-fold",
                              {{-far, at + far},
                               {0, at},
                               {far, at + far},
                               {-far - 6, 10},
                               {0, 0},
                               {far + 6, 10},
                               {-far, 10 + out},
                               {far, 10 + out}});
        }
        made->id = "m" + std::to_string(i);
        made->id_given = true;
    }
    return design;
}

TEST(FreeCollisions, KeepsItsPromises) {
    const Language* xml = find_language({}, "xml");
    int collided = 0;
    int moved = 0;
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        const std::string text = write_document(crowd(seed));
        const CompiledDesign before = compiled(text);
        if (!before.motion || !before.diagnostics.repairs().empty()) continue;
        const Pairs had = colliding(before);
        collided += had.empty() ? 0 : 1;
        const FreedDocument freed = free_collisions({"card.xml", text}, *xml, {}, {});
        if (freed.moves.empty()) {
            EXPECT_EQ(freed.text, text) << "seed " << seed << ": nothing moved, and the text is another";
            continue;
        }
        ++moved;
        const CompiledDesign after = compiled(freed.text);
        ASSERT_FALSE(after.diagnostics.has_errors()) << "seed " << seed << "\n"
                                                     << test::findings(after.diagnostics);
        EXPECT_TRUE(after.diagnostics.repairs().empty()) << "seed " << seed;
        const Pairs has = colliding(after);
        EXPECT_LT(has.size(), had.size()) << "seed " << seed;
        EXPECT_TRUE(std::includes(had.begin(), had.end(), has.begin(), has.end())) << "seed " << seed;
        EXPECT_EQ(freed.left.size(), has.size()) << "seed " << seed;
        Pairs gone;
        for (const MadeMove& one : freed.moves) {
            gone.insert(std::minmax(one.move.element, one.move.other));
            EXPECT_NE(one.before, one.after);
        }
        for (const auto& pair : gone)
            EXPECT_FALSE(has.contains(pair)) << "seed " << seed << ": " << pair.first;
        if (!test::BruteForce::available()) continue;
        // What is said to be clear is clear of what looks at triangles alone, angle by angle.
        const test::BruteForce brute(*after.assembly);
        for (double deg = 1.0; deg <= 180.0; deg += 3.7) {
            for (const test::BruteContact& one : brute.crossing_at(deg)) {
                const auto pair = std::minmax(owner(*after.assembly, one.a), owner(*after.assembly, one.b));
                EXPECT_FALSE(gone.contains(pair)) << "seed " << seed << ": at " << deg << "°";
            }
        }
        // A second time finds nothing more to do.
        EXPECT_EQ(free_collisions({"card.xml", freed.text}, *xml, {}, {}).text, freed.text)
            << "seed " << seed;
    }
    EXPECT_GT(collided, 3);
    EXPECT_GT(moved, 1);
}

// What stands on an element goes with it where its paper does, and stays on its own piece.
TEST(MoveElement, TakesAlongWhatStandsOnIt) {
    Design design = test::card(200, 200);
    test::add(design, "step", {{-20, -10}, {-20, 10}, {20, -10}, {20, 10}}).id = "floor";
    // On the step's left fold: all of it is on the page, and moves.
    test::add(design, "step", {{-25, -5}, {-25, 5}, {-15, -5}, {-15, 5}}, {-20, -10}, {-20, 10}).id = "box";
    const Footings standing = footings_of(design);
    EXPECT_EQ(standing.ground[1].owner, 0);
    FreeingMove move;
    move.element = "floor";
    move.by = {0, 7.004};
    ASSERT_TRUE(move_element(design, standing, move));
    EXPECT_DOUBLE_EQ(moved_mm(move), 7.01);
    EXPECT_NEAR(design.structures[0].points[0].at.y, -2.99, 1e-9);
    EXPECT_NEAR(design.structures[1].points[0].at.y, 2.01, 1e-9);
    EXPECT_NEAR(design.structures[1].fold.begin.at.y, -2.99, 1e-9);
    EXPECT_FALSE(design.structures[0].fold.begin.changed) << "it stays on its own fold";
    move.element = "nobody";
    EXPECT_FALSE(move_element(design, standing, move));
}

TEST(Footings, FindsWhatStandsOnWhat) {
    Design design = test::card(200, 200);
    test::add(design, "tent",
              {{-20, -20}, {-20, 20}, {20, -20}, {20, 20}, {-25, -20}, {-25, 20}, {25, -20}, {25, 20}})
        .id = "tent";
    test::add(design, "inverted-beak", {{0, 10}, {-8, 2}, {8, 2}}, {0, -20}, {0, 20}, 1).id = "flag";
    test::add(design, "beak", {{0, 10}, {-8, 2}, {8, 2}}, {0, 20}, {0, -20}, 7).id = "lost";
    const Footings standing = footings_of(design);
    ASSERT_EQ(standing.ground.size(), 3U);
    EXPECT_EQ(standing.folds[static_cast<std::size_t>(standing.ground[0].fold)].name, "gutter");
    EXPECT_EQ(standing.ground[0].extra_page, 1);
    EXPECT_EQ(standing.ground[1].owner, 0);
    EXPECT_EQ(standing.folds[static_cast<std::size_t>(standing.ground[1].fold)].name, "centre");
    EXPECT_EQ(standing.ground[2].fold, -1);
}

}  // namespace
}  // namespace popup
