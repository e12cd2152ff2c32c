// What is remembered of pairs of plates while an order of folds is sought.
#include "motion/seen_pairs.h"

#include <gtest/gtest.h>

#include <random>
#include <variant>
#include <vector>

#include "motion/examine.h"
#include "motion/linkage.h"
#include "popup/crease_pattern.h"
#include "popup/language.h"
#include "support/designs.h"
#include "support/dielines.h"

namespace popup {
namespace {

constexpr double kFlatDeg = 180.0;

// What a fold does: lies flat, goes, or stands folded.
enum Doing { flat, goes, stands };
const std::vector<char> kStill{1, 0, 1};

// A sheet of which each fold does what it is told, in straight laws.
class Folds {
 public:
    explicit Folds(const std::string& drawing) {
        Diagnostics diagnostics("sheet.svg");
        ReadOptions options;
        options.drawing.as = DrawnAs::folded;
        const Reading reading = read_source_text({"sheet.svg", drawing}, options, diagnostics);
        EXPECT_TRUE(reading.creases) << test::findings(diagnostics);
        if (reading.creases) assembly_ = fold_sheet(*reading.creases, {}, diagnostics).value_or(Assembly{});
        shapes_ = plate_shapes(assembly_, {});
        base_.assign(assembly_.plates.size(), -1);
        mover_.assign(assembly_.plates.size(), -1);
        for (std::size_t i = 0; i < assembly_.joints.size(); ++i) {
            const auto* const folded = std::get_if<Folded>(&assembly_.joints[i].how);
            if (folded == nullptr) continue;
            base_[static_cast<std::size_t>(folded->plate)] = folded->base;
            mover_[static_cast<std::size_t>(folded->plate)] = static_cast<int>(joints_.size());
            joints_.push_back(i);
            folded_.push_back(folded->law.front().y);
        }
    }

    [[nodiscard]] std::size_t count() const { return joints_.size(); }
    [[nodiscard]] SeenPairs nothing_seen() const { return {base_, mover_}; }

    // Of is_clear(), what it says and at how many poses it has looked.
    struct Answer {
        bool clear;
        std::size_t poses;
    };
    Answer ask(const std::vector<int>& doing, SeenPairs& seen) {
        for (std::size_t i = 0; i < joints_.size(); ++i) {
            const double last = doing[i] == flat ? 0.0 : folded_[i];
            const double first = doing[i] == stands ? folded_[i] : 0.0;
            std::get<Folded>(assembly_.joints[joints_[i]].how).law = {{0.0, last}, {kFlatDeg, first}};
        }
        Linkage linkage(assembly_);
        seen.set(doing, kStill);
        Answer answer{false, 0};
        answer.clear = is_clear(assembly_, linkage, shapes_, {}, {}, seen, answer.poses);
        return answer;
    }

 private:
    Assembly assembly_;
    std::vector<PlateShape> shapes_;
    std::vector<std::size_t> joints_;
    std::vector<double> folded_;
    std::vector<int> base_, mover_;
};

TEST(SeenPairs, NothingIsLookedAtTwice) {
    Folds folds(test::pointed_tube(7));
    SeenPairs seen = folds.nothing_seen();
    std::vector<int> doing(folds.count(), stands);
    for (const int one : {goes, flat}) {
        doing.back() = one;
        const auto first = folds.ask(doing, seen);
        const auto again = folds.ask(doing, seen);
        EXPECT_EQ(first.clear, again.clear);
        EXPECT_GT(first.poses, 0U);
        EXPECT_EQ(again.poses, 0U);
    }
}

// Whatever has been seen before, the answer is that of a first look.
TEST(SeenPairs, AnswerAsAFirstLook) {
    int clear = 0;
    int crossed = 0;
    for (const std::string& drawing : {test::pointed_tube(5), test::locked_tube(4)}) {
        Folds folds(drawing);
        SeenPairs seen = folds.nothing_seen();
        std::mt19937 random(7);
        std::vector<int> doing(folds.count(), stands);
        for (int round = 0; round < 120; ++round) {
            // Mostly it is as it was before.
            for (int i = 0; i < 4; ++i) doing[random() % folds.count()] = static_cast<int>(random() % 3);
            SeenPairs nothing = folds.nothing_seen();
            const bool expected = folds.ask(doing, nothing).clear;
            EXPECT_EQ(folds.ask(doing, seen).clear, expected) << round;
            (expected ? clear : crossed) += 1;
        }
    }
    EXPECT_GT(clear, 20);
    EXPECT_GT(crossed, 20);
}

}  // namespace
}  // namespace popup
