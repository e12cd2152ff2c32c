// Collisions whose angles are known on paper: formulas of a card seen along its gutter, and nothing of what
// is tested.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "motion/examine.h"
#include "motion/mend.h"
#include "popup/compile.h"
#include "popup/files.h"
#include "support/designs.h"

namespace popup::test {
namespace {

constexpr double kDeg = std::numbers::pi / 180.0;

struct Examined {
    Built built;
    Examination found;

    [[nodiscard]] std::string name(int plate) const {
        return built.assembly->plates[static_cast<std::size_t>(plate)].name;
    }
    // Contacts of two plates, "a b from to" a line; of all when no names are given.
    [[nodiscard]] std::vector<Contact> contacts(const std::string& a, const std::string& b) const {
        std::vector<Contact> result;
        for (const Contact& one : found.contacts) {
            if ((name(one.a) == a && name(one.b) == b) || (name(one.a) == b && name(one.b) == a))
                result.push_back(one);
        }
        return result;
    }
    [[nodiscard]] std::string all() const {
        std::string text;
        for (const Contact& one : found.contacts) {
            text += name(one.a) + " " + name(one.b) + " " + std::to_string(one.from_deg) + " " +
                    std::to_string(one.to_deg) + " " + std::to_string(one.depth_mm) + "\n";
        }
        return text;
    }
};

Examined examined(const Design& design, const MotionOptions& options = {}) {
    Examined result{build(design), {}};
    if (result.built.assembly) result.found = examine(*result.built.assembly, options);
    return result;
}

// Where a function of the angle is nought, seen at every hundredth of a degree and halved from there.
std::vector<double> roots(const std::function<double(double)>& f, double from = 0.01, double to = 180.0) {
    std::vector<double> result;
    for (double lo = from; lo < to; lo += 0.01) {
        double a = lo;
        double b = std::min(lo + 0.01, to);
        if ((f(a) > 0.0) == (f(b) > 0.0)) continue;
        const bool rising = f(b) > 0.0;
        for (int i = 0; i < 60; ++i) {
            const double mid = 0.5 * (a + b);
            ((f(mid) > 0.0) == rising ? b : a) = mid;
        }
        result.push_back(0.5 * (a + b));
    }
    return result;
}

// A tent over a v-fold, both on the gutter: the tent of sides s, its seams p from the gutter; the v-fold of
// angle a to each seam on the page, g on its piece, which ends t from the apex in an edge w wide across its
// centre fold. Its top corners swing up to the tent's faces.
struct TipUnderTent {
    double a = 75, g = 81, t = 51.5, w = 1, p = 40, s = 60;

    [[nodiscard]] Design design() const {
        Design made = card(4.0 * s + 40.0, 4.0 * s + 40.0);
        const double seam = 0.4 * p;
        const Vec2 left{-seam * std::sin(a * kDeg), seam * std::cos(a * kDeg)};
        const Vec2 g_point{-seam * std::sin(g * kDeg), seam * std::cos(g * kDeg)};
        add(made, "v-fold",
            {left,
             {0, 0},
             {-left.x, left.y},
             g_point,
             {0, 0},
             {-g_point.x, g_point.y},
             {0.5 * w, t},
             {-0.5 * w, t}});
        const double half = 1.2 * s;
        add(made, "tent",
            {{-p, -half}, {-p, half}, {p, -half}, {p, half}, {-s, -half}, {-s, half}, {s, -half}, {s, half}});
        return made;
    }

    // How far the left top corner stands out of the tent's left face, mm. Seen along the gutter: the pages go
    // from (0, 0) to (∓sin, cos) of half the angle, the ridge is at (0, h), the left seam at p on the left
    // page.
    [[nodiscard]] double out(double deg) const {
        const double c = std::cos(0.5 * deg * kDeg);
        const double sn = std::sin(0.5 * deg * kDeg);
        const double h = p * c + std::sqrt(s * s - p * p * sn * sn);
        // The v-fold's centre fold rises by φ from the gutter: cos a cos φ + sin a c sin φ = cos g.
        const double r = std::hypot(std::cos(a * kDeg), std::sin(a * kDeg) * c);
        const double phi =
            std::atan2(std::sin(a * kDeg) * c, std::cos(a * kDeg)) + std::acos(std::cos(g * kDeg) / r);
        // The corner: t along the centre fold, w / 2 square to it on the left plate, towards the left seam.
        const double seam_x = -std::sin(a * kDeg) * sn;
        const double seam_z = std::sin(a * kDeg) * c;
        const double across_x = seam_x / std::sin(g * kDeg);
        const double across_z = (seam_z - std::cos(g * kDeg) * std::sin(phi)) / std::sin(g * kDeg);
        const double x = 0.5 * w * across_x;
        const double z = t * std::sin(phi) + 0.5 * w * across_z;
        // The face runs from the ridge by (-p sn, p c - h), which is s long.
        return (x * (p * c - h) - (z - h) * (-p * sn)) / s;
    }
    [[nodiscard]] double most_out() const {
        double most = -1e9;
        for (double deg = 20.0; deg <= 180.0; deg += 0.01) most = std::max(most, out(deg));
        return most;
    }
    // The same with the length at which the tip stands out by `mm` at most.
    [[nodiscard]] TipUnderTent reaching(double mm) const {
        TipUnderTent result = *this;
        double lo = 0.0;
        double hi = 2.0 * s;
        for (int i = 0; i < 60; ++i) {
            result.t = 0.5 * (lo + hi);
            (result.most_out() < mm ? lo : hi) = result.t;
        }
        return result;
    }
};

TEST(Collision, TipThatHitsOnlyBetweenClosedAndOpenIsFoundToAHundredthOfADegree) {
    const TipUnderTent tip;
    const auto expected = roots([&](double deg) { return tip.out(deg); });
    ASSERT_EQ(expected.size(), 2u);
    EXPECT_LT(tip.out(1.0), 0.0);
    EXPECT_LT(tip.out(180.0), 0.0);
    const Examined card = examined(tip.design());
    for (const std::string side : {"left", "right"}) {
        const auto contacts = card.contacts("e1/" + side, "e2/" + side);
        ASSERT_EQ(contacts.size(), 1u) << card.all();
        EXPECT_NEAR(contacts[0].from_deg, expected[0], 0.01);
        EXPECT_NEAR(contacts[0].to_deg, expected[1], 0.01);
        // It gets out square to the tent, or sooner square to itself; depth_test.cpp has the exact way.
        EXPECT_LE(contacts[0].depth_mm, tip.most_out() + 0.01);
        EXPECT_GE(contacts[0].depth_mm, 0.5 * tip.most_out());
        EXPECT_EQ(card.name(contacts[0].longer), "e1/" + side);
        EXPECT_GE(contacts[0].excess_mm, contacts[0].depth_mm);
    }
    EXPECT_EQ(card.found.contacts.size(), 2u) << card.all();
    EXPECT_TRUE(card.found.undecided.empty());
}

// The excess is measured square to the line in which the plates meet, which is askew to the edge that is cut
// back.
TEST(Collision, ExcessSaysHowMuchShorterThePieceMustBe) {
    const TipUnderTent tip;
    const Examined card = examined(tip.design());
    ASSERT_FALSE(card.found.contacts.empty());
    const double excess = card.found.contacts[0].excess_mm;
    TipUnderTent shorter = tip;
    shorter.t = tip.t - 1.5 * excess;
    EXPECT_EQ(examined(shorter.design()).all(), "");
    shorter.t = tip.t - 0.8 * excess;
    EXPECT_NE(examined(shorter.design()).all(), "");
}

// Moved as the hint says, and no less, the two are free.
TEST(Collision, MoveThatIsSaidToFreeTwoElementsDoes) {
    const TipUnderTent tip;
    const Built built = build(tip.design());
    const std::vector<PlateShape> shapes = plate_shapes(*built.assembly, {});
    // The page's two plates come first, then those of each element.
    const std::vector<std::pair<int, int>> pairs{{2, 4}, {2, 5}, {3, 4}, {3, 5}};
    MoveBudget budget;
    const auto move = freeing_move(*built.assembly, Linkage(*built.assembly), shapes, pairs, {}, budget);
    ASSERT_TRUE(move.has_value());
    const auto contacts_when_moved = [&](double share) {
        Design design = tip.design();
        const std::size_t element =
            built.assembly->joints[static_cast<std::size_t>(move->joint)].name == "e1" ? 0 : 1;
        // The points on the page are the first three of a v-fold, the first four of a tent.
        for (std::size_t i = 0; i < 3 + element; ++i) {
            Vec2& at = design.structures[element].points[i].at;
            at = at + share * move->by;
        }
        return examined(design).all();
    };
    EXPECT_EQ(contacts_when_moved(1.0), "");
    EXPECT_NE(contacts_when_moved(0.95), "");
}

TEST(Collision, HitOfLessThanHalfADegreeIsFound) {
    TipUnderTent large{80, 86, 745, 16, 640, 960};
    const TipUnderTent tip = large.reaching(0.03);
    const auto expected = roots([&](double deg) { return tip.out(deg); });
    ASSERT_EQ(expected.size(), 2u);
    ASSERT_LT(expected[1] - expected[0], 0.5);
    const Examined card = examined(tip.design());
    const auto contacts = card.contacts("e1/left", "e2/left");
    ASSERT_EQ(contacts.size(), 1u) << card.all();
    EXPECT_NEAR(contacts[0].from_deg, expected[0], 0.01);
    EXPECT_NEAR(contacts[0].to_deg, expected[1], 0.01);
}

TEST(Collision, NearMissOfATwentiethOfAMillimetreIsClear) {
    const Examined miss = examined(TipUnderTent{}.reaching(-0.05).design());
    EXPECT_EQ(miss.all(), "");
    EXPECT_TRUE(miss.found.undecided.empty());
    const Examined hit = examined(TipUnderTent{}.reaching(0.05).design());
    EXPECT_EQ(hit.found.contacts.size(), 2u) << hit.all();
}

TEST(Collision, ClearanceNamesHowNearTheMissIs) {
    MotionOptions options;
    options.clearance_mm = 0.2;
    const TipUnderTent tip = TipUnderTent{}.reaching(-0.05);
    const Examined card = examined(tip.design(), options);
    ASSERT_TRUE(card.found.approaches.has_value());
    ASSERT_EQ(card.found.approaches->size(), 2u);
    const Approach& near = card.found.approaches->front();
    EXPECT_NEAR(near.least_mm, 0.05, 0.001);
    const auto reached = roots([&](double deg) { return tip.out(deg) + 0.2; }, 20.0);
    ASSERT_EQ(reached.size(), 2u);
    EXPECT_NEAR(near.from_deg, reached[0], 0.01);
    EXPECT_NEAR(near.to_deg, reached[1], 0.01);
    options.clearance_mm = 0.04;
    EXPECT_TRUE(examined(tip.design(), options).found.approaches->empty());
    EXPECT_FALSE(examined(tip.design()).found.approaches.has_value()) << "not asked for";
}

// What stays together, is glued on, or stands on the page of the open card is not near: it is there.
TEST(Collision, ClearanceIsSilentAboutWhatBelongsTogether) {
    MotionOptions options;
    options.clearance_mm = 0.01;
    for (const std::string name :
         {"house", "tree", "stage", "tent-village", "cake", "high-street", "layers"}) {
        SCOPED_TRACE(name);
        Diagnostics diagnostics;
        const auto source =
            read_source(std::string(POPUP_SOURCE_DIR) + "/samples/" + name + ".xml", diagnostics);
        ASSERT_TRUE(source);
        CompileOptions compiling;
        compiling.until = Stage::motion;
        compiling.motion = options;
        const Compilation run = compile({*source}, compiling, {});
        ASSERT_TRUE(run.designs.front().motion);
        for (const Approach& one : *run.designs.front().motion->examination->approaches) {
            const auto& plates = run.designs.front().assembly->plates;
            ADD_FAILURE() << plates.at(static_cast<std::size_t>(one.a)).name << " and "
                          << plates.at(static_cast<std::size_t>(one.b)).name << " at " << one.least_deg;
        }
    }
}

// A box on the gutter, sides d, and on each of its side folds a tent, mirror images: their ridges lean
// towards each other and meet over the gutter.
struct TwoTents {
    double d = 40, p = 5, q = 38, left_far = 53, right_far = 20;

    [[nodiscard]] Design design() const {
        Design made = card(400, 300);
        add(made, "step", {{-d, -60}, {-d, 60}, {d, -60}, {d, 60}});
        const double w = left_far + right_far;
        add(made, "tent",
            {{-d - p, -40}, {-d - p, 40}, {-d + q, -40}, {-d + q, 40}, {0, -40}, {0, 40}, {w, -40}, {w, 40}},
            {-d, -60}, {-d, 60});
        add(made, "tent",
            {{d - q, -40}, {d - q, 40}, {d + p, -40}, {d + p, 40}, {0, -40}, {0, 40}, {w, -40}, {w, 40}},
            {d, -60}, {d, 60});
        return made;
    }

    // Where the left tent's ridge is, seen along the gutter: x. Its seams are p outwards on the left page,
    // and q on the box's left wall, which is parallel to the right page.
    [[nodiscard]] double ridge_x(double deg) const {
        const double c = std::cos(0.5 * deg * kDeg);
        const double s = std::sin(0.5 * deg * kDeg);
        const Vec2 fold{-d * s, d * c};
        const Vec2 m = fold + p * Vec2{-s, c};
        const Vec2 n = fold + q * Vec2{s, c};
        const double apart = distance(m, n);
        const double along = (left_far * left_far - right_far * right_far + apart * apart) / (2.0 * apart);
        const double up = std::sqrt(left_far * left_far - along * along);
        const Vec2 way = (1.0 / apart) * (n - m);
        return (m + along * way + up * left_of(way)).x;
    }
};

TEST(Collision, TwoTentsWhoseRidgesMeetCollideFromThereOn) {
    const TwoTents tents;
    const auto expected = roots([&](double deg) { return tents.ridge_x(deg); }, 1.0);
    ASSERT_EQ(expected.size(), 1u);
    ASSERT_GT(tents.ridge_x(180.0), 4.0);
    const Examined card = examined(tents.design());
    double first = 180.0;
    for (const Contact& one : card.found.contacts) {
        EXPECT_EQ(one.to_deg, 180.0) << card.all();
        first = std::min(first, one.from_deg);
    }
    EXPECT_NEAR(first, expected[0], 0.01) << card.all();
    EXPECT_FALSE(card.contacts("e2/right", "e3/left").empty()) << card.all();
}

// A v-fold that leans back over the end of a box: its centre fold goes through the end of the box's ridge
// until it is steep enough to pass over it.
TEST(Collision, VFoldAgainstTheEndOfABoxCollidesFromTheClosedCardOn) {
    const double a = 50;
    const double g = 80;
    const double d = 30;
    const double away = 30;
    Design design = card(400, 300);
    const Vec2 seam{-30 * std::sin(a * kDeg), 30 * std::cos(a * kDeg)};
    const Vec2 own{-30 * std::sin(g * kDeg), 30 * std::cos(g * kDeg)};
    add(design, "v-fold",
        {seam, {0, 0}, {-seam.x, seam.y}, own, {0, 0}, {-own.x, own.y}, {20, 120}, {-20, 120}});
    add(design, "step", {{-d, -120}, {-d, -away}, {d, -120}, {d, -away}});
    // The centre fold rises by φ; at the box's end it is `away` tan(180° − φ) high, and the ridge 2 d cos(θ /
    // 2).
    const auto through = [&](double deg) {
        const double c = std::cos(0.5 * deg * kDeg);
        const double r = std::hypot(std::cos(a * kDeg), std::sin(a * kDeg) * c);
        const double phi =
            std::atan2(std::sin(a * kDeg) * c, std::cos(a * kDeg)) + std::acos(std::cos(g * kDeg) / r);
        return phi <= 0.5 * std::numbers::pi ? -1.0 : 2.0 * d * c - away * std::tan(std::numbers::pi - phi);
    };
    const auto expected = roots(through);
    ASSERT_EQ(expected.size(), 1u);
    const Examined card = examined(design);
    for (const std::string side : {"left", "right"}) {
        const auto contacts = card.contacts("e1/" + side, "e2/" + side);
        ASSERT_EQ(contacts.size(), 1u) << card.all();
        EXPECT_EQ(contacts[0].from_deg, 0.0);
        EXPECT_NEAR(contacts[0].to_deg, expected[0], 0.01);
    }
    EXPECT_FALSE(card.found.closed.order.has_value()) << "what crosses in the closed card has no order";
}

TEST(Collision, WhatTouchesByRightDoesNotCollide) {
    // Folds, seams and apexes of every element; a tent that lies on the page at 180°; edges along cuts.
    Design design = card();
    add(design, "tent",
        {{-30, -60}, {-30, -40}, {40, -60}, {40, -40}, {-35, -60}, {-35, -40}, {35, -60}, {35, -40}});
    add(design, "step", {{-40, -30}, {-40, -10}, {25, -30}, {25, -10}});
    add(design, "beak", {{0, 0}, {-30, 25}, {20, 30}});
    add(design, "angled-step", {{-15, 50}, {-30, 70}, {15, 50}, {30, 70}});
    const Examined card = examined(design);
    EXPECT_EQ(card.all(), "");
    EXPECT_TRUE(card.found.undecided.empty());
    EXPECT_TRUE(card.found.closed.order.has_value());
}

// Two tents of nearly one shape on a card of two metres, a hair apart at every angle: more poses than are
// spent on a pair. Then that is said, of these two and these angles, and neither of the other answers is
// given.
TEST(Collision, WhatCannotBeDecidedIsSaidToBeSo) {
    Design design = card(2000, 2000);
    for (const double less : {0.0, 0.001}) {
        const double p = 400 - less;
        const double s = 600 - less;
        add(design, "tent",
            {{-p, -900}, {-p, 900}, {p, -900}, {p, 900}, {-s, -900}, {-s, 900}, {s, -900}, {s, 900}});
    }
    const Examined card = examined(design);
    EXPECT_EQ(card.all(), "");
    ASSERT_FALSE(card.found.undecided.empty());
    for (const Undecided& one : card.found.undecided) {
        EXPECT_EQ(card.name(one.a).substr(0, 2), "e1");
        EXPECT_EQ(card.name(one.b).substr(0, 2), "e2");
        EXPECT_LT(one.from_deg, one.to_deg);
    }
}

// Two cards as one assembly, the second one's gutter at `shift` mm beside the first's.
Assembly beside(Assembly first, const Assembly& second, double shift) {
    const Vec2 by{shift, 0.0};
    const int plates = static_cast<int>(first.plates.size());
    for (Plate plate : second.plates) {
        plate.name = "second/" + plate.name;
        for (Vec2& p : plate.outline.outer) p = p + by;
        for (Vec2& p : plate.uncut) p = p + by;
        plate.pivot = plate.pivot + by;
        if (plate.parent >= 0) plate.parent += plates;
        first.plates.push_back(plate);
    }
    for (Joint joint : second.joints) {
        if (auto* drive = std::get_if<Drive>(&joint.how)) {
            drive->plate += plates;
            drive->axis_at = drive->axis_at + by;
        } else {
            auto& bars = std::get<FourBar>(joint.how);
            for (Bar* bar : {&bars.left, &bars.right}) {
                bar->plate += plates;
                bar->drive += plates;
                for (Vec2* at : {&bar->fold_at, &bar->seam_at, &bar->own_at}) *at = *at + by;
            }
        }
        first.joints.push_back(joint);
    }
    for (const int cover : second.covers) first.covers.push_back(cover + plates);
    return first;
}

// The left walls of two boxes on cards side by side stay parallel to the right pages. Over the first card's
// right page they are 2 p sin cos of half the angle high, and cos (2 p' sin - 100): equal where 2 (p' - p)
// sin = 100. At no other angle have they a point in common, so at none do they cross along a line.
TEST(Collision, WallsThatPassThroughEachOtherFaceToFaceAreFound) {
    Design first = card(400, 200);
    add(first, "step", {{-20, -80}, {-20, 80}, {90, -80}, {90, 80}});
    Design second = card(400, 200);
    add(second, "step", {{-80, -70}, {-80, 70}, {40, -70}, {40, 70}});
    Examined cards{build(first), {}};
    cards.built.assembly = beside(*cards.built.assembly, *build(second).assembly, 100.0);
    cards.found = examine(*cards.built.assembly, {});
    const auto contacts = cards.contacts("e1/left", "second/e1/left");
    ASSERT_EQ(contacts.size(), 1u) << cards.all();
    EXPECT_NEAR(contacts[0].from_deg, 2.0 * std::asin(100.0 / 120.0) / kDeg, 0.01);
    EXPECT_NEAR(contacts[0].to_deg, contacts[0].from_deg, 0.01);
}

TEST(Collision, OutcomeDoesNotDependOnWhichPlateComesFirst) {
    // The mirrored design has the mirrored contacts.
    TipUnderTent tip;
    const Examined card = examined(tip.design());
    const auto left = card.contacts("e1/left", "e2/left");
    const auto right = card.contacts("e1/right", "e2/right");
    ASSERT_EQ(left.size(), right.size());
    for (std::size_t i = 0; i < left.size(); ++i) {
        EXPECT_NEAR(left[i].from_deg, right[i].from_deg, 0.0011);
        EXPECT_NEAR(left[i].to_deg, right[i].to_deg, 0.0011);
        EXPECT_NEAR(left[i].depth_mm, right[i].depth_mm, 1e-6);
        EXPECT_NEAR(left[i].point.x, -right[i].point.x, 1e-3);
    }
}

}  // namespace
}  // namespace popup::test
