// The assembly book of folded sheets: its steps are those that were found, each of one piece, and what is on
// their drawings can be read.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <regex>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "output/book/book.h"
#include "output/book/panel_labels.h"
#include "output/emit.h"
#include "popup/crease_pattern.h"
#include "popup/language.h"
#include "popup/refinement.h"
#include "support/dielines.h"
#include "support/made_book.h"

namespace popup {
namespace {

using test::MadeBook;

const std::vector<book::Chapter>& chapters_of(const book::Book& book) { return book.cards.front().chapters; }

std::vector<book::Step> steps_of(const book::Book& book) {
    std::vector<book::Step> all;
    for (const book::Chapter& chapter : chapters_of(book))
        all.insert(all.end(), chapter.steps.begin(), chapter.steps.end());
    return all;
}

// "they go in 5 steps"; 0: nothing was told.
std::size_t steps_that_were_found(const MadeBook& made) {
    for (const Diagnostic& one : made.run.designs.front().diagnostics.sorted()) {
        std::smatch count;
        if (one.code == "folds-in-order" &&
            std::regex_search(one.message, count, std::regex("they go in ([0-9]+) steps")))
            return std::stoul(count[1]);
    }
    return 0;
}

bool says(const book::Step& step, const std::string& text) {
    return std::any_of(step.actions.begin(), step.actions.end(),
                       [&text](const std::string& action) { return action.find(text) != std::string::npos; });
}

std::size_t first_that_says(const std::vector<book::Step>& steps, const std::string& text) {
    const auto found = std::find_if(steps.begin(), steps.end(),
                                    [&text](const book::Step& step) { return says(step, text); });
    return static_cast<std::size_t>(found - steps.begin());
}

class BookOfATuck : public testing::TestWithParam<std::pair<std::string, std::string>> {};

// A tuck turns further than it stays, its lid comes down, and both end together: these are three steps.
TEST_P(BookOfATuck, HasTheStepsThatWereFound) {
    const auto& [sample, lid] = GetParam();
    const MadeBook made({sample});
    const std::vector<book::Step> steps = steps_of(made.made());
    ASSERT_GT(steps_that_were_found(made), 3U);
    EXPECT_EQ(steps.size(), steps_that_were_found(made));
    const std::size_t over =
        first_that_says(steps, "for now further than they stay: between " + lid + " | " + lid + "-tuck");
    const std::size_t half = first_that_says(steps, ", for now not all the way: between back | " + lid);
    const std::size_t back = first_that_says(steps, "Mountain folds, back from 100° to 90°: between " + lid);
    EXPECT_LT(over, half);
    EXPECT_LT(half, back);
    ASSERT_LT(back, steps.size());
    EXPECT_TRUE(says(steps[back], "Mountain folds, on from 80° to 90°: between back | " + lid));
    // Each picture begins where the one before ends.
    for (std::size_t i = 1; i < steps.size(); ++i) {
        ASSERT_EQ(steps[i].scenes.size(), 2U);
        EXPECT_EQ(steps[i].scenes[0].opening_deg, steps[i - 1].scenes[1].opening_deg);
    }
    // A flap is glued before the lid closes over it.
    if (test::need(made.made(), "To glue").empty()) return;
    EXPECT_LT(first_that_says(steps, "Put glue on glue-flap, and press it onto the inside of"), half);
}

INSTANTIATE_TEST_SUITE_P(Cartons, BookOfATuck,
                         testing::Values(std::pair("cartons/straight-tuck-end.fl", "top"),
                                         std::pair("cartons/fefco-0427.fl", "lid")),
                         [](const auto& info) { return std::string(info.param.second); });

TEST(BookOfASheet, SaysWhichCreasesEndFlat) {
    const MadeBook made({"cartons/gift-bag.fl"});
    const book::Book book = made.made();
    EXPECT_EQ(test::need(book, "To fold"), "18 folds");
    EXPECT_EQ(book.cards.front().parts.front().folds, "16 mountain and 2 valley");
    const std::vector<book::Step> steps = steps_of(book);
    EXPECT_EQ(steps.front().actions.front(),
              "Score the folds between right-2 | right-1 and left-1 | left-2, fold them once, and open them "
              "again: they stay flat when it stands.");
    for (std::size_t i = 1; i < steps.size(); ++i) EXPECT_FALSE(says(steps[i], "Score the fold"));
    // They are on the first drawing, in their ink.
    const auto valleys = [](const book::Step& step) {
        const std::vector<book::Figure::Shape>& shapes = step.figures.front().shapes;
        return std::count_if(shapes.begin(), shapes.end(),
                             [](const book::Figure::Shape& shape) { return shape.ink == book::Ink::valley; });
    };
    EXPECT_EQ(valleys(steps.front()), 2);
    EXPECT_EQ(valleys(steps.back()), 0);
}

TEST(BookOfASheet, HasStepsOfOnePieceEach) {
    const MadeBook made({"cartons/tray-with-lid.fl"});
    const book::Book book = made.made();
    const Assembly& in = *made.cards.front().assembly;
    ASSERT_EQ(in.pieces.size(), 2U);
    ASSERT_EQ(chapters_of(book).size(), 2U);
    for (std::size_t i = 0; i < in.pieces.size(); ++i) {
        const book::Chapter& chapter = chapters_of(book)[i];
        EXPECT_EQ(chapter.title, "Fold " + in.pieces[i].name);
        EXPECT_GT(chapter.steps.size(), 1U);
        for (const book::Step& step : chapter.steps) {
            EXPECT_NE(step.title.find(" of " + in.pieces[i].name), std::string::npos) << step.title;
            EXPECT_EQ(step.figures.size(), 1U);
            for (const book::Scene& scene : step.scenes) {
                for (std::size_t k = 0; k < in.plates.size(); ++k)
                    EXPECT_EQ(scene.fades[k] >= 0.0F, in.plates[k].piece == static_cast<int>(i)) << k;
            }
        }
    }
}

// "down" goes with mountains, "up" with valleys; what crosses in the end is in the way of something.
TEST(BookOfASheet, SaysNoMoreThanIsSo) {
    const MadeBook clear({"cartons/straight-tuck-end.fl"});
    const std::string nothing = "In this order nothing is in the way of anything. ";
    const std::string stay = "Let what is folded stay folded.";
    EXPECT_EQ(chapters_of(clear.made()).front().intro, nothing + stay);
    EXPECT_TRUE(steps_of(clear.made()).front().title.starts_with("Step 1: fold down panels "));
    MadeBook crossing({"cartons/straight-tuck-end.fl"});
    Motion motion = *crossing.cards.front().motion;
    motion.examination->contacts.push_back({});
    crossing.cards.front().motion = &motion;
    EXPECT_EQ(chapters_of(crossing.made()).front().intro, stay);
    EXPECT_TRUE(
        steps_of(MadeBook({"folded/carton.svg"}).made()).front().title.starts_with("Step 1: fold up "));
}

// Which corners of a tray are glued only its refinement says; the names of the panels say it to whoever makes
// a book of the assembly, or of its text.
TEST(BookOfASheet, TellsWhatARefinementPastes) {
    Diagnostics diagnostics("tray.svg");
    ReadOptions options;
    options.drawing.as = DrawnAs::folded;
    const Reading reading = read_source_text({"tray.svg", test::tray_with_corners()}, options, diagnostics);
    ASSERT_TRUE(reading.creases) << test::findings(diagnostics);
    const std::vector<Join> joins{
        {JoinKind::paste, {{"sheet/front-corner-left", {}}, {"sheet/left", {}}}},
        {JoinKind::paste, {{"sheet/back-corner-left", {}}, {"sheet/left", {}}}},
    };
    for (const bool refined : {true, false}) {
        const auto shape =
            refine_shape(*reading.creases, {{}, refined ? joins : std::vector<Join>{}, nullptr}, diagnostics);
        ASSERT_TRUE(shape) << test::findings(diagnostics);
        auto tray = fold_sheet(shape->pattern, {}, diagnostics);
        ASSERT_TRUE(tray) << test::findings(diagnostics);
        name_glue_flaps(*shape, *tray);
        MadeBook made;
        made.make({{"tray.assembly.json", emit_assembly(*tray)}}, {});
        const book::Book book = made.made();
        EXPECT_EQ(test::need(book, "To glue"), refined ? "2 flaps" : "");
        const std::vector<book::Step> steps = steps_of(book);
        for (const std::string corner : {"front-corner-left", "back-corner-left"}) {
            const std::size_t step = first_that_says(
                steps,
                "Put glue on " + corner + "-glue-flap, and press it onto the inside of left until it holds.");
            EXPECT_EQ(step < steps.size(), refined) << corner;
        }
        EXPECT_EQ(first_that_says(steps, "Put glue on front-corner-right"), steps.size());
    }
}

class BookOfNarrowPanels : public testing::TestWithParam<std::string> {};

// In the drawings, or in the lists of their numbers, and none over another.
TEST_P(BookOfNarrowPanels, NamesEachWhereItCanBeRead) {
    const MadeBook made({GetParam()});
    const Assembly& in = *made.cards.front().assembly;
    for (const book::Step& step : steps_of(made.made())) {
        const book::Figure& figure = step.figures.front();
        // As wide as the letters of a page are at least.
        constexpr double kLetterMm = 1.2;
        constexpr double kHighMm = 1.9;
        const double scale = std::min({1.0, 150.0 / figure.width_mm, 110.0 / figure.height_mm});
        std::set<std::string> names;
        for (std::size_t i = 0; i < figure.labels.size(); ++i) {
            names.insert(figure.labels[i].text);
            for (std::size_t k = 0; k < i; ++k) {
                const auto letters =
                    static_cast<double>(figure.labels[i].text.size() + figure.labels[k].text.size());
                const Vec2 apart = scale * (figure.labels[i].at - figure.labels[k].at);
                EXPECT_TRUE(std::abs(apart.x) > 0.5 * kLetterMm * letters || std::abs(apart.y) > kHighMm)
                    << figure.labels[i].text << ", " << figure.labels[k].text;
            }
        }
        const std::string listed = step.key + " ";
        EXPECT_EQ(names.size(), in.plates.size());
        for (const Plate& plate : in.plates) {
            const std::string name = plate.name.substr(plate.name.find('/') + 1);
            if (names.contains(name)) continue;
            std::smatch number;
            ASSERT_TRUE(std::regex_search(listed, number, std::regex("([0-9]+) = " + name + "[,.]"))) << name;
            EXPECT_TRUE(names.contains(number[1])) << number[1];
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Cartons, BookOfNarrowPanels,
                         testing::Values("cartons/gift-bag.fl", "cartons/fefco-0427.fl"),
                         [](const auto& info) {
                             return std::string(info.param == "cartons/gift-bag.fl" ? "bag" : "box");
                         });

TEST(PanelLabels, GiveWayToNumbersThatWouldHaveNoPlace) {
    book::Figure figure;
    figure.width_mm = 100.0;
    figure.height_mm = 50.0;
    // 14 mm wide as it is written; the long names are 2 mm beside it, and have no other place.
    figure.labels = {{"panel-7", {50.0, 20.0}, {}, 0.0},
                     {"left-lining", {52.0, 20.0}, {}, 0.0},
                     {"right", {50.0, 40.0}, {}, 0.0}};
    EXPECT_EQ(book::settle_labels(figure), "In the drawing: 1 = panel-7.");
    ASSERT_EQ(figure.labels.size(), 2U);
    EXPECT_EQ(figure.labels[0].text, "1");
    EXPECT_EQ(figure.labels[1].text, "right");
    // Where there is another place, both are there.
    figure.labels = {{"panel-7", {50.0, 20.0}, {}, 0.0},
                     {"left-lining", {52.0, 20.0}, {}, 0.0, {{52.0, 30.0}}}};
    EXPECT_EQ(book::settle_labels(figure), "In the drawing: 1 = left-lining.");
    ASSERT_EQ(figure.labels.size(), 2U);
    EXPECT_EQ(figure.labels[0].text, "panel-7");
    EXPECT_EQ(figure.labels[1].at.y, 30.0);
}

// Of several designs each has a piece 1: a number would be taken for another's.
TEST(PanelLabels, AreLettersWhereNumbersWouldBeTakenForOthers) {
    book::Figure figure;
    figure.width_mm = 150.0;
    figure.height_mm = 100.0;
    figure.letters_only = true;
    figure.labels = {{"boat: 1. far", {20.0, 20.0}, {}, 5.0}, {"boat: 2. near", {90.0, 20.0}, {}, 60.0}};
    EXPECT_EQ(book::settle_labels(figure), "In the drawing: a = boat: 1. far.");
}

// "2. castle" is "2" where it is wider than its piece, and what has no number of its own has a letter then.
TEST(PanelLabels, GiveWayToNumbersOfPiecesAndToLetters) {
    book::Figure figure;
    figure.width_mm = 150.0;
    figure.height_mm = 100.0;
    figure.labels = {{"1. left-strip", {20.0, 20.0}, "1", 5.0},
                     {"2. next-strip", {26.0, 20.0}, "2", 5.0},
                     {"3. wide-strip", {90.0, 20.0}, "3", 60.0},
                     {"long-unnumbered", {88.0, 21.0}, {}, 0.0, {{88.0, 40.0}}},
                     {"narrow-unnumbered", {30.0, 70.0}, {}, 9.0}};
    EXPECT_EQ(book::settle_labels(figure), "In the drawing: a = long-unnumbered, b = narrow-unnumbered.");
    ASSERT_EQ(figure.labels.size(), 5U);
    EXPECT_EQ(figure.labels[0].text, "1");
    EXPECT_EQ(figure.labels[1].text, "2");
    EXPECT_EQ(figure.labels[2].text, "3. wide-strip");
    EXPECT_EQ(figure.labels[3].text, "a");
    EXPECT_EQ(figure.labels[3].at.y, 40.0);
}

// A card that opens to 90° is cut flat, and stands when it is open.
TEST(BookOfASheet, ShowsWhatIsPushedOutOfAnUprightCard) {
    const MadeBook made({"villa.oa"});
    const Assembly& in = *made.cards.front().assembly;
    const std::vector<book::Step> steps = steps_of(made.made());
    const auto found = std::find_if(steps.begin(), steps.end(), [](const book::Step& step) {
        return step.title.find("push out") != std::string::npos;
    });
    ASSERT_NE(found, steps.end());
    ASSERT_EQ(found->scenes.size(), 2U);
    EXPECT_TRUE(found->scenes[0].unfolded);
    EXPECT_FALSE(found->scenes[1].unfolded);
    EXPECT_EQ(found->scenes[1].opening_deg, in.sweep.to_deg);
    // Bare paper is painted where it is meant.
    EXPECT_FALSE(found->scenes[0].painted.empty());
    EXPECT_EQ(found->scenes[0].painted, found->scenes[1].painted);
    EXPECT_LT(found->scenes[0].painted.size(), in.plates.size());
    EXPECT_TRUE(says(*found, "Fold the sheet a little."));
    // The names are on the drawing, or listed.
    ASSERT_EQ(found->figures.size(), 1U);
    std::string shown;
    for (const book::Figure::Label& label : found->figures.front().labels) shown += label.text + " ";
    shown += found->key + " ";
    for (const PushedOut& one : pushed_out(in))
        EXPECT_NE(shown.find(one.name), std::string::npos) << one.name;
}

}  // namespace
}  // namespace popup
