// Elements moved apart: what is promised of the document that comes out, by the examination and by brute
// force.
#include "repair/free_collisions.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "mechanism/footings.h"
#include "output/xml.h"
#include "popup/check.h"
#include "popup/edit.h"
#include "support/brute_force.h"
#include "support/designs.h"
#include "support/random.h"
#include "support/run_program.h"
#include "support/sanitized.h"

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

// Tents and v-folds close behind one another on the gutter, and high ones that lean on what is behind them:
// most of them collide. Folds by two points, or by name, with v-folds on the tents' centre folds.
std::string crowd(std::uint64_t seed, bool named) {
    test::Random random(seed * 2 + (named ? 1 : 0));
    const auto within = [&random](double least, double most) {
        return least + (most - least) * random.unit();
    };
    NewCard card;
    card.width_mm = 260;
    card.height_mm = 360;
    Diagnostics trouble("card.xml");
    std::string text = new_document(card, trouble).value();
    std::vector<EditLine> edits;
    double at = -110;
    const std::size_t count = 2 + random.below(3);
    for (std::size_t i = 0; i < count; ++i) {
        const std::string id = fmt::format("m{}", i);
        const bool tent = random.below(2) == 0;
        const double length = within(16, 44);
        const double middle = tent ? at + length / 2 : at;
        const double width = within(24, 60);
        edits.push_back({{"add", tent ? "tent" : "v-fold", "--id", id, "--on", "gutter", "--at",
                          fmt::format("{:.2f}", middle), "--width", fmt::format("{:.2f}", width), "--height",
                          fmt::format("{:.2f}", tent ? within(20, 40) : within(45, 90))},
                         {}});
        std::vector<std::string>& words = edits.back().words;
        if (tent) {
            words.insert(words.end(), {"--length", fmt::format("{:.2f}", length)});
            if (random.below(3) != 0) {
                edits.push_back({{"add", "v-fold", "--id", id + "-flag", "--on", id + ".centre", "--at",
                                  fmt::format("{:.2f}", within(-0.3, 0.3) * length), "--width", "10",
                                  "--height", fmt::format("{:.2f}", within(25, 60)), "--angle", "100",
                                  "--lean", fmt::format("{:.2f}", within(20, 80))},
                                 {}});
            }
            at += length + within(0.5, 3);
        } else {
            const double angle = within(70, 140);
            words.insert(words.end(), {"--angle", fmt::format("{:.2f}", angle), "--lean",
                                       fmt::format("{:.2f}", within(40, 100))});
            at += 0.5 * width / std::tan(angle * std::numbers::pi / 360.0) + within(0.5, 3);
        }
    }
    Diagnostics of_document("card.xml");
    const auto edited = edit_document({"card.xml", text}, edits, {}, trouble, of_document);
    if (!edited || edited->refused) return {};
    text = edited->text;
    if (named) return text;
    // The same on the gutter by two points: what its reading makes of the name.
    const std::string on = R"(<parentfold on="gutter"/>)";
    for (std::size_t found = 0; (found = text.find(on)) != std::string::npos;)
        text.replace(found, on.size(),
                     R"(<parentfold><begin x="0" y="-180"/><end x="0" y="180"/></parentfold>)");
    return text;
}

// The pairs that cross at one of many angles, by brute force: triangle against triangle.
Pairs brute_pairs(const Assembly& assembly) {
    Pairs pairs;
    const test::BruteForce brute(assembly);
    for (double deg = 1.0; deg <= 180.0; deg += 7.3) {
        for (const test::BruteContact& one : brute.crossing_at(deg))
            pairs.insert(std::minmax(owner(assembly, one.a), owner(assembly, one.b)));
    }
    return pairs;
}

struct CrowdTally {
    int cards = 0, collided = 0, moved = 0, cleared = 0;
};

void free_one(std::uint64_t seed, bool named, CrowdTally& tally) {
    const Language* xml = find_language({}, "xml");
    const std::string text = crowd(seed, named);
    if (text.empty()) return;
    const CompiledDesign before = compiled(text);
    if (!before.motion || !before.diagnostics.repairs().empty()) return;
    ++tally.cards;
    const Pairs had = colliding(before);
    tally.collided += had.empty() ? 0 : 1;
    const FreedDocument freed = free_collisions({"card.xml", text}, *xml, {}, {});
    if (freed.moves.empty()) {
        EXPECT_EQ(freed.text, text) << "nothing moved, and the text is another";
        return;
    }
    ++tally.moved;
    const CompiledDesign after = compiled(freed.text);
    ASSERT_FALSE(after.diagnostics.has_errors()) << test::findings(after.diagnostics);
    EXPECT_TRUE(after.diagnostics.repairs().empty());
    const Pairs has = colliding(after);
    tally.cleared += has.empty() ? 1 : 0;
    EXPECT_LT(has.size(), had.size());
    EXPECT_TRUE(std::includes(had.begin(), had.end(), has.begin(), has.end()));
    EXPECT_EQ(freed.left.size(), has.size());
    Pairs gone;
    for (const MadeMove& one : freed.moves) {
        gone.insert(std::minmax(one.move.element, one.move.other));
        EXPECT_NE(one.before, one.after);
    }
    for (const auto& pair : gone) EXPECT_FALSE(has.contains(pair)) << pair.first;
    // What stands by name stands on the same fold as before.
    EXPECT_EQ(std::count(text.begin(), text.end(), '<'),
              std::count(freed.text.begin(), freed.text.end(), '<'));
    if (test::BruteForce::available()) {
        // What is said to be clear is clear of what looks at triangles alone, angle by angle; and no pair
        // has come that did not cross before.
        const Pairs cross_now = brute_pairs(*after.assembly);
        for (const auto& pair : cross_now) {
            EXPECT_FALSE(gone.contains(pair)) << pair.first << " and " << pair.second;
            EXPECT_TRUE(had.contains(pair)) << pair.first << " and " << pair.second;
        }
        const Pairs crossed = brute_pairs(*before.assembly);
        EXPECT_TRUE(std::includes(had.begin(), had.end(), crossed.begin(), crossed.end()));
    }
    // A second time finds nothing more to do.
    EXPECT_EQ(free_collisions({"card.xml", freed.text}, *xml, {}, {}).text, freed.text);
}

void expect_freed(bool named) {
    CrowdTally tally;
    const std::uint64_t seeds = test::sanitized_count<std::uint64_t>(30, 6);
    for (std::uint64_t seed = 0; seed < seeds; ++seed) {
        SCOPED_TRACE(fmt::format("seed {}", seed));
        free_one(seed, named, tally);
    }
    ::testing::Test::RecordProperty("cards", tally.cards);
    ::testing::Test::RecordProperty("collided", tally.collided);
    ::testing::Test::RecordProperty("moved", tally.moved);
    ::testing::Test::RecordProperty("cleared", tally.cleared);
    EXPECT_GT(tally.collided, tally.cards / 2) << "of " << tally.cards;
    EXPECT_GT(2 * tally.cards, static_cast<int>(seeds));
    EXPECT_GT(tally.moved, tally.collided / 4);
}

TEST(FreeCollisions, KeepsItsPromises) { expect_freed(false); }

TEST(FreeCollisions, KeepsThemOnNamedFolds) { expect_freed(true); }

// What a hint tells of a move, obeyed to the letter: the two are free, nothing collides that did not, nothing
// sticks out that did not, and the document is accepted.
TEST(FreeCollisions, EachMoveThatIsToldFreesItsTwoAndHarmsNothing) {
    int obeyed = 0;
    const std::uint64_t seeds = test::sanitized_count<std::uint64_t>(40, 4);
    for (std::uint64_t seed = 0; seed < seeds; ++seed) {
        SCOPED_TRACE(fmt::format("seed {}", seed));
        const std::string text = crowd(seed, true);
        if (text.empty()) continue;
        const CompiledDesign before = compiled(text);
        if (!before.motion || !before.diagnostics.repairs().empty()) continue;
        const Pairs had = colliding(before);
        const auto sticks_out = [](const CompiledDesign& design) {
            std::set<int> plates;
            for (const Protrusion& one : design.motion->examination->closed.protrusions)
                plates.insert(one.plate);
            return plates;
        };
        const std::set<int> out = sticks_out(before);
        for (const FreeingMove& move : before.motion->moves) {
            Diagnostics unheard;
            Design design = read_design({"card.xml", text}, {}, unheard).value();
            ASSERT_TRUE(move_element(design, footings_of(design), move));
            const CompiledDesign after = compiled(write_document(design));
            ASSERT_TRUE(after.motion) << test::findings(after.diagnostics);
            EXPECT_TRUE(after.diagnostics.repairs().empty()) << test::findings(after.diagnostics);
            const Pairs has = colliding(after);
            EXPECT_FALSE(has.contains(std::minmax(move.element, move.other)))
                << move.element << " and " << move.other;
            EXPECT_TRUE(std::includes(had.begin(), had.end(), has.begin(), has.end()));
            const std::set<int> still_out = sticks_out(after);
            EXPECT_TRUE(std::includes(out.begin(), out.end(), still_out.begin(), still_out.end()));
            ++obeyed;
        }
    }
    EXPECT_GE(obeyed, static_cast<int>(seeds / 4));
}

// Two tents in one place, and a third beside them, which the shortest move would bring one onto.
TEST(FreeCollisions, PartsWhatLiesOnOneAnother) {
    NewCard card;
    card.width_mm = 200;
    card.height_mm = 300;
    Diagnostics trouble("card.xml");
    std::string text = new_document(card, trouble).value();
    const auto tent = [](const char* id, double from, double to) {
        return EditLine{{"add", "tent", "--id", id, "--at", fmt::format("{}", (from + to) / 2), "--length",
                         fmt::format("{}", to - from), "--width", "50", "--height", "24"},
                        {}};
    };
    const std::vector<EditLine> edits{tent("a", 0, 40), tent("b", 62, 100), tent("c", 20, 60)};
    const auto edited = edit_document({"card.xml", text}, edits, {}, trouble, trouble);
    ASSERT_TRUE(edited && !edited->refused) << test::findings(trouble);
    text = edited->text;
    const CompiledDesign before = compiled(text);
    EXPECT_NE(test::findings(before.diagnostics).find("lie on one another"), std::string::npos);
    const FreedDocument freed = free_collisions({"card.xml", text}, *find_language({}, "xml"), {}, {});
    ASSERT_EQ(freed.moves.size(), 1U);
    EXPECT_TRUE(freed.left.empty());
    const CompiledDesign after = compiled(freed.text);
    EXPECT_EQ(test::findings(after.diagnostics), "");
    const std::string told = test::findings(with_moves(before.diagnostics, *before.design, freed));
    EXPECT_NE(told.find("moved-clear"), std::string::npos) << told;
    EXPECT_NE(told.find(" lay on "), std::string::npos) << told;
    EXPECT_EQ(told.find("lie on one another"), std::string::npos) << told;
}

// The sail's shortest move would cost it glue tabs; the hull can be moved as far, and costs none.
TEST(FreeCollisions, MovesTheOtherWhereTheFirstWouldLoseItsTabs) {
    const Source boat{"boat.xml", test::read_file(std::string(POPUP_SOURCE_DIR) + "/samples/boat.xml")};
    Diagnostics trouble("boat.xml");
    const EditLine leaning{{"set", "mainsail", "--angle=79.1478"}, {}};
    const auto edited = edit_document(boat, {&leaning, 1}, {}, trouble, trouble);
    ASSERT_TRUE(edited && !edited->refused) << test::findings(trouble);
    const CompiledDesign before = compiled(edited->text);
    ASSERT_EQ(colliding(before), (Pairs{{"hull-far", "mainsail"}}));
    ASSERT_FALSE(before.motion->moves.empty());
    EXPECT_EQ(before.motion->moves.front().element, "mainsail");
    const FreedDocument freed =
        free_collisions({"boat.xml", edited->text}, *find_language({}, "xml"), {}, {});
    EXPECT_TRUE(freed.left.empty());
    ASSERT_EQ(freed.moves.size(), 1U);
    EXPECT_EQ(freed.moves.front().move.element, "hull-far");
    CompileOptions options;
    options.until = Stage::pattern;
    const Compilation after = compile({{"boat.xml", freed.text}}, options, {});
    EXPECT_EQ(test::findings(after.designs.front().diagnostics), "");
}

// Points are as they are written, and say so where that is not in millimetres.
TEST(FreeCollisions, TellsTheUnitOfWhatMoved) {
    const auto points = [](const Unit& unit) {
        Design design = test::card(200, 240);
        design.unit = unit;
        test::add_tent(design, 0, 15, 20, 25);
        test::add_tent(design, 10, 15, 20, 25);
        const FreedDocument freed =
            free_collisions({"card.xml", write_document(design)}, *find_language({}, "xml"), {}, {});
        return freed.moves.empty() ? std::string() : freed.moves[0].after;
    };
    EXPECT_TRUE(points({"in", 25.4}).ends_with(") in")) << points({"in", 25.4});
    EXPECT_TRUE(points({"mm", 1.0}).ends_with(")")) << points({"mm", 1.0});
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

// On the seam of a v-fold whose right side is the page, the apex is given on that page.
TEST(Footings, FindsWhatStandsOnBothSeams) {
    const std::string path = std::string(POPUP_SOURCE_DIR) + "/samples/cascade.xml";
    Diagnostics diagnostics(path);
    const auto design = read_design({path, test::read_file(path)}, {}, diagnostics);
    ASSERT_TRUE(design);
    const Footings standing = footings_of(*design);
    const CardFolds checked = folds_of_card(*design);
    for (std::size_t i = 0; i < design->structures.size(); ++i) {
        const auto& owner = checked.standing[i].owner;
        EXPECT_EQ(standing.ground[i].owner, owner ? static_cast<int>(*owner) : -1)
            << design->structures[i].id;
        if (standing.ground[i].fold < 0) continue;
        const StandingFold& fold = standing.folds[static_cast<std::size_t>(standing.ground[i].fold)];
        const CardFold& is = checked.folds[*checked.standing[i].fold];
        EXPECT_NEAR(distance(fold.at.on_left.a, is.at.on_left.a), 0.0, 0.01) << design->structures[i].id;
        EXPECT_NEAR(distance(fold.at.on_right.b, is.at.on_right.b), 0.0, 0.01) << design->structures[i].id;
    }
}

}  // namespace
}  // namespace popup
