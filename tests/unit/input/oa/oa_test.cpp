// Designs of webOAcard: every point of the sheet is in the plate that its rules say, folds are where plates
// meet, and what is wrong with a file is said where it stands.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

#include "input/oa/read.h"
#include "input/oa/sheet.h"
#include "output/emit.h"
#include "popup/compile.h"
#include "popup/motion.h"
#include "support/brute_force.h"
#include "support/designs.h"
#include "support/oa_rules.h"
#include "support/random.h"
#include "support/run_program.h"
#include "unit/input/oa/oa_reading.h"

namespace popup {
namespace {

using test::OaPlane;
using test::OaRules;
using test::Read;
using test::read;
using Json = nlohmann::ordered_json;

// --- files made in code, by X and heights above the floor

struct Card {
    Json json{{"settings", {{"cardW", 100}, {"cardH", 80}}}, {"faces", Json::array()}};

    static Json points(double t, const std::vector<std::pair<double, double>>& x_and_height) {
        Json ring = Json::array();
        for (const auto& [x, height] : x_and_height) ring.push_back({{"X", x}, {"Y", t - height}});
        return ring;
    }
    Json& add(int mode, double t, const std::vector<std::pair<double, double>>& x_and_height) {
        json["faces"].push_back(
            {{"contours", {{{"outer", points(t, x_and_height)}, {"holes", Json::array()}}}},
             {"type", "VFACE"},
             {"mode", mode},
             {"t", t}});
        return json["faces"].back();
    }
    Json& box(double t, double x0, double x1, double from, double to, int mode = 0) {
        return add(mode, t, {{x0, from}, {x1, from}, {x1, to}, {x0, to}});
    }
    [[nodiscard]] std::string text() const { return json.dump(); }
};

// --- the assembly against the rules

// The planes of the plates, from where the motion puts them at 90°.
std::vector<OaPlane> planes_of(const Assembly& assembly) {
    std::vector<Frame> frames(assembly.plates.size());
    EXPECT_TRUE(place(assembly, Angle::degrees(90.0), frames));
    const Frame& back = frames[static_cast<std::size_t>(assembly.covers.at(0))];
    const Frame& floor = frames[static_cast<std::size_t>(assembly.covers.at(1))];
    const Vec3 up = back.direction({-1.0, 0.0});
    const Vec3 out = floor.direction({1.0, 0.0});
    EXPECT_NEAR(dot(up, out), 0.0, 1e-12);
    std::vector<OaPlane> planes;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const Vec2 corner = assembly.plates[i].outline.outer[0];
        const Vec3 from = frames[i].point(corner) - back.point({0.0, corner.y});
        const bool upright = std::abs(dot(frames[i].normal(), out)) > 0.5;
        // On the open card a point has depth - height = its x, whatever plate it is in.
        EXPECT_NEAR(dot(from, out) - dot(from, up), corner.x, 1e-6);
        EXPECT_NEAR(dot(from, Vec3{0, 1, 0}), 0.0, 1e-6);
        planes.push_back({upright, upright ? dot(from, out) : dot(from, up)});
    }
    return planes;
}

bool same(const OaPlane& a, const OaPlane& b) {
    return a.upright == b.upright && std::abs(a.offset - b.offset) < 0.02;
}

struct Compared {
    std::size_t cells = 0, wrong = 0, loose = 0;
    std::size_t folds = 0, missing = 0, extra = 0;
    std::string first;
};

// Which plate each point is in, and where folds are. `near_mm`: edges that a repair moved lie no further off.
Compared compare(const Assembly& assembly, const OaRules& rules, double near_mm = 0.0) {
    Compared result;
    const std::vector<OaPlane> planes = planes_of(assembly);
    const double half = 0.5 * rules.width();
    const auto page = [half](double x, double y) { return Vec2{y, x - half}; };
    std::vector<Box> boxes;
    for (const Plate& plate : assembly.plates) boxes.push_back(bounds(plate.outline.outer));
    const auto plate_at = [&](Vec2 p) {
        int found = -1;
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            const Box& b = boxes[i];
            if (p.x < b.min.x || p.x > b.max.x || p.y < b.min.y || p.y > b.max.y) continue;
            if (contains(assembly.plates[i].outline, p)) found = static_cast<int>(i);
        }
        return found;
    };
    const auto note = [&](std::size_t c, std::size_t r, const std::string& what) {
        if (result.first.empty())
            result.first =
                "X " + std::to_string(rules.x(c)) + " Y " + std::to_string(rules.y(r)) + ": " + what;
    };
    for (std::size_t r = 0; r < rules.rows(); ++r) {
        for (std::size_t c = 0; c < rules.columns(); ++c) {
            if (!rules.clear(c, r, 2)) continue;
            ++result.cells;
            const OaPlane wanted = rules.plane(c, r);
            const int plate = plate_at(page(rules.x(c), rules.y(r)));
            if (plate < 0) {
                ++result.loose;
            } else if (!same(planes[static_cast<std::size_t>(plate)], wanted)) {
                ++result.wrong;
                note(c, r,
                     assembly.plates[static_cast<std::size_t>(plate)].name + ", and not " +
                         (wanted.upright ? "depth " : "height ") + std::to_string(wanted.offset));
            }
        }
    }
    // Folds, by the columns: where one plane ends and the next begins in one line of space.
    std::multimap<double, const Line*> lines;
    for (const Line& line : assembly.lines) {
        if (line.kind == LineKind::valley || line.kind == LineKind::mountain)
            lines.emplace(line.at.a.x, &line);
    }
    const double step = rules.y(1) - rules.y(0);
    const auto held = [&](std::size_t c, std::size_t r) {
        return plate_at(page(rules.x(c), rules.y(r))) >= 0;
    };
    for (std::size_t c = 2; c + 2 < rules.columns(); ++c) {
        for (std::size_t r = 3; r + 4 < rules.rows(); ++r) {
            // Two calm stretches of two rows each, and between them the border.
            const OaPlane above = rules.plane(c, r - 1);
            const OaPlane below = rules.plane(c, r + 1);
            bool calm = true;
            for (const std::size_t beside : {c - 2, c - 1, c, c + 1, c + 2}) {
                const OaPlane between = rules.plane(beside, r);
                calm = calm && (between == above || between == below);
                for (const std::size_t n : {1U, 2U, 3U}) {
                    calm = calm && rules.plane(beside, r - n) == above && rules.plane(beside, r + n) == below;
                }
            }
            if (!calm || (above == below) || !held(c, r - 2) || !held(c, r + 2)) continue;
            const double at =
                (above.upright ? above.offset : below.offset) - (above.upright ? below.offset : above.offset);
            const bool meet = above.upright != below.upright && std::abs(at - rules.y(r)) < 1.01 * step;
            const LineKind kind = above.upright ? LineKind::valley : LineKind::mountain;
            const double y = rules.x(c) - half;
            bool is_there = false;
            bool another = false;
            for (auto line = lines.lower_bound(rules.y(r) - 1.01 * step - near_mm);
                 line != lines.end() && line->first < rules.y(r) + 1.01 * step + near_mm; ++line) {
                const Line& one = *line->second;
                if (std::min(one.at.a.y, one.at.b.y) > y || std::max(one.at.a.y, one.at.b.y) < y) continue;
                (meet && one.kind == kind && std::abs(line->first - at) < 1e-6 ? is_there : another) = true;
            }
            if (meet) ++result.folds;
            if (meet && !is_there) {
                ++result.missing;
                note(c, r, "a fold is missing");
            }
            if (!meet && another && near_mm == 0.0) {
                ++result.extra;
                note(c, r, "a fold that is none");
            }
        }
    }
    return result;
}

void expect_by_the_rules(const std::string& text, const Assembly& assembly, double cell_mm = 0.5) {
    const Compared result = compare(assembly, OaRules(text, cell_mm));
    EXPECT_GT(result.cells, 1000U);
    EXPECT_EQ(result.wrong, 0U) << result.first;
    EXPECT_EQ(result.missing, 0U) << result.first;
    EXPECT_EQ(result.extra, 0U) << result.first;
}

double paper(const Assembly& assembly) {
    double sum = 0.0;
    for (const Plate& plate : assembly.plates) sum += area(plate.outline);
    return sum;
}

// Every hinge closes at every opening, and every plate is placed.
void expect_closed(const Assembly& assembly) {
    std::vector<Frame> frames(assembly.plates.size());
    for (const double deg : {0.0, 1.0, 30.0, 60.0, 90.0, 135.0, 180.0}) {
        ASSERT_TRUE(place(assembly, Angle::degrees(deg), frames));
        EXPECT_LT(closure_error(assembly, frames), 1e-9) << deg;
    }
}

// --- single rules

TEST(Oa, ABoxStandsOnTheFloorAndItsTopRunsBackToTheBack) {
    Card card;
    card.box(30, 20, 60, 0, 25);
    const Read made = read(card.text());
    ASSERT_TRUE(made.assembly) << made.told();
    EXPECT_EQ(made.told(), "");
    const Assembly& assembly = *made.assembly;
    ASSERT_EQ(assembly.plates.size(), 4U);
    EXPECT_EQ(assembly.pieces.size(), 1U);
    std::vector<std::string> names;
    for (const Plate& plate : assembly.plates) names.push_back(plate.name);
    EXPECT_EQ(names, (std::vector<std::string>{"back", "floor", "face-0/top", "face-0"}));
    EXPECT_EQ(assembly.sweep.from_deg, 0.0);
    EXPECT_EQ(assembly.sweep.to_deg, 90.0);
    EXPECT_EQ(assembly.covers, (std::vector<int>{0, 1}));
    // The gutter beside it, top to back, foot, and the edge between top and face.
    std::map<LineKind, std::vector<double>> folds;
    for (const Line& line : assembly.lines) folds[line.kind].push_back(line.at.a.x);
    EXPECT_EQ(folds[LineKind::mountain], (std::vector<double>{5.0}));
    std::sort(folds[LineKind::valley].begin(), folds[LineKind::valley].end());
    EXPECT_EQ(folds[LineKind::valley], (std::vector<double>{-25.0, 0.0, 0.0, 30.0}));
    EXPECT_NEAR(paper(assembly), 100.0 * 160.0, 1e-6);
    expect_by_the_rules(card.text(), assembly);
    expect_closed(assembly);
    // At 90° the upper front edge is 30 mm before the back and 25 mm above the floor.
    std::vector<Frame> frames(4);
    ASSERT_TRUE(place(assembly, Angle::degrees(90.0), frames));
    const double r = std::sqrt(0.5);
    EXPECT_LT(distance(frames[3].point({5.0, -30.0}), Vec3{r * 30 - r * 25, -30.0, r * 30 + r * 25}), 1e-9);
}

TEST(Oa, StairsBesideEachOtherAreFoldedToEachOther) {
    Card card;
    card.box(40, 10, 90, 0, 10);
    card.box(30, 20, 80, 0, 20);
    card.box(20, 30, 70, 0, 30);
    const Read made = read(card.text());
    ASSERT_TRUE(made.assembly) << made.told();
    EXPECT_EQ(made.told(), "");
    EXPECT_EQ(made.assembly->plates.size(), 8U);
    expect_by_the_rules(card.text(), *made.assembly);
    expect_closed(*made.assembly);
    EXPECT_TRUE(free_plates(*made.assembly).empty());
}

TEST(Oa, ADoorLetsTheFloorThroughAndAnOpeningHasASill) {
    Card card;
    card.box(30, 20, 80, 0, 40);
    card.box(30, 30, 40, 0, 15, 1);                             // a door, down to the floor
    card.box(30, 55, 65, 20, 30, 1);                            // a window: its lower edge holds a plate
    card.add(1, 30, {{70, 25}, {73, 28}, {70, 31}, {67, 28}});  // none with a corner below: it falls out
    const Read made = read(card.text());
    ASSERT_TRUE(made.assembly) << made.told();
    EXPECT_EQ(made.told(), "");
    expect_by_the_rules(card.text(), *made.assembly);
    // The square on its corner is gone, and nothing else.
    EXPECT_NEAR(paper(*made.assembly), 100.0 * 160.0 - 18.0, 1e-6);
    const auto free = free_plates(*made.assembly);
    ASSERT_EQ(free.size(), 1U);
    EXPECT_EQ(made.assembly->plates[static_cast<std::size_t>(free[0].plates[0])].name, "face-0/top/2");
}

TEST(Oa, NothingRunsBackFromAPull) {
    Card card;
    card.box(30, 20, 60, 0, 20);
    card.add(2, 30, {{25, 20}, {55, 20}, {40, 35}});
    const Read made = read(card.text());
    ASSERT_TRUE(made.assembly) << made.told();
    EXPECT_EQ(made.told(), "");
    EXPECT_EQ(made.assembly->plates.size(), 4U);
    expect_by_the_rules(card.text(), *made.assembly);
}

TEST(Oa, HolesCutWhatStandsFartherBackAndOfOneDepthWhatIsOlder) {
    const auto with_times = [](double face, double hole) {
        Card card;
        card.box(30, 20, 60, 0, 30)["timestamp"] = face;
        card.add(1, 30, {{40, 5}, {45, 10}, {40, 15}, {35, 10}})["timestamp"] = hole;
        card.box(15, 70, 90, 0, 40);
        card.add(1, 30,
                 {{80, -10}, {85, -5}, {80, 0}, {75, -5}});  // Y 30 to 40: below the floor of the other
        card.add(1, 30, {{80, 25}, {85, 30}, {80, 35}, {75, 30}});  // Y -5 to 5, in the one behind
        const Read made = read(card.text());
        EXPECT_TRUE(made.assembly) << made.told();
        expect_by_the_rules(card.text(), *made.assembly);
        return paper(*made.assembly);
    };
    const double whole = 100.0 * 160.0;
    EXPECT_NEAR(with_times(0, 0), whole - 100.0, 1e-6);  // no times: both are cut
    EXPECT_NEAR(with_times(5, 9), whole - 100.0, 1e-6);  // the face is older
    EXPECT_NEAR(with_times(9, 5), whole - 50.0, 1e-6);   // the face is younger
    EXPECT_NEAR(with_times(5, 5), whole - 50.0, 1e-6);
    EXPECT_NEAR(with_times(5, 0), whole - 50.0, 1e-6);
}

TEST(Oa, OfATextOnlyTheTopmostEdgeOfEachContourHoldsAPlate) {
    // An E on its back, as it were: three upper edges, of which one is the topmost.
    const std::vector<std::pair<double, double>> shape{{20, 0}, {60, 0}, {60, 20}, {50, 20},
                                                       {50, 8}, {44, 8}, {44, 26}, {36, 26},
                                                       {36, 8}, {30, 8}, {30, 20}, {20, 20}};
    Card plain;
    plain.add(0, 30, shape);
    Card text;
    text.add(0, 30, shape)["contoursType"] = "expolygons";
    const Read as_face = read(plain.text());
    const Read as_text = read(text.text());
    ASSERT_TRUE(as_face.assembly && as_text.assembly);
    EXPECT_EQ(as_face.assembly->plates.size(), 8U);
    EXPECT_EQ(as_text.assembly->plates.size(), 4U);
    expect_by_the_rules(plain.text(), *as_face.assembly);
    expect_by_the_rules(text.text(), *as_text.assembly);
}

TEST(Oa, TextsThatAreCutOutHaveNoSills) {
    Card card;
    card.box(30, 20, 80, 0, 40);
    card.box(30, 40, 60, 10, 25, 1)["contoursType"] = "expolygons";
    const Read made = read(card.text());
    ASSERT_TRUE(made.assembly) << made.told();
    EXPECT_EQ(made.assembly->plates.size(), 4U);
    EXPECT_NEAR(paper(*made.assembly), 100.0 * 160.0 - 300.0, 1e-6);
    expect_by_the_rules(card.text(), *made.assembly);
}

// --- findings

TEST(Oa, PaperThatNothingHoldsIsNamed) {
    Card card;
    card.box(30, 20, 60, 0, 30);
    card.add(0, 50, {{30, 5}, {50, 5}, {40, 15}});  // floats: its lower edge misses the floor by 5 mm
    const Read made = read(card.text());
    ASSERT_TRUE(made.assembly);
    ASSERT_EQ(made.count("oa-loose"), 1U) << made.told();
    EXPECT_EQ(made.findings[0].message,
              "a part of faces[1] falls out: no fold holds 100.0 mm² at X 40.0, Y 40.9");
    EXPECT_GT(made.findings[0].place.column, 100);
    EXPECT_NEAR(paper(*made.assembly), 100.0 * 160.0 - 100.0, 1e-6);
}

TEST(Oa, EdgesThatJustMissWhatTheyStandOnAreDrawnDown) {
    Card card;
    card.box(50, 10, 90, 0, 10);
    card.box(30, 30, 60, 10.2, 40);  // on the top of the first, but for 0.2 mm
    card.box(60, 40, 50, 0.4, 20);   // on the floor, but for 0.4 mm
    const Read made = read(card.text());
    ASSERT_TRUE(made.assembly);
    ASSERT_EQ(made.count("oa-snapped"), 2U) << made.told();
    EXPECT_EQ(made.findings[0].message,
              "the lower edge of faces[1] at Y 19.800 ends 0.200 mm above the plate below it; it was drawn "
              "down to it");
    ASSERT_TRUE(made.findings[0].change);
    EXPECT_EQ(made.findings[0].change->after, "Y 20.000 mm");
    EXPECT_TRUE(free_plates(*made.assembly).empty());
    Card sound;
    sound.box(50, 10, 90, 0, 10);
    sound.box(30, 30, 60, 10, 40);
    sound.box(60, 40, 50, 0, 20);
    expect_by_the_rules(sound.text(), *made.assembly);
    // Half a millimetre and more is meant.
    Card apart;
    apart.box(50, 10, 90, 0, 10);
    apart.box(30, 30, 60, 10.6, 40);
    EXPECT_EQ(read(apart.text()).count("oa-snapped"), 0U);
}

// Rounded to the grid, the edge of such a face is a step off the depth that it stands at.
TEST(Oa, DepthsOfManyDecimalsCloseUp) {
    std::mt19937 random(3);
    for (int round = 0; round < 60; ++round) {
        const double depth = 20.0 + static_cast<double>(random()) / 4294967295.0 * 30.0;
        const std::string text = fmt::format(
            R"({{"settings": {{"cardW": 100, "cardH": 70}}, "faces": [{{"mode": 0, "t": {}, "contours": [{{"outer": )"
            R"([{{"X": 39, "Y": {:.5f}}}, {{"X": 70, "Y": {:.5f}}}, {{"X": 70, "Y": 15}}, {{"X": 39, "Y": 15}}], )"
            R"("holes": []}}]}}]}})",
            depth, depth, depth);
        const Read made = read(text);
        ASSERT_TRUE(made.assembly) << made.told();
        Diagnostics diagnostics("card.oa");
        EXPECT_TRUE(simulate(*made.assembly, {}, diagnostics)) << depth;
        EXPECT_FALSE(diagnostics.has_errors()) << depth << ": " << diagnostics.sorted().front().message;
    }
}

TEST(Oa, ContoursThatCrossThemselvesAreTakenWhole) {
    Card card;
    card.add(0, 30, {{20, 0}, {60, 0}, {60, 20}, {38, 20}, {44, 30}, {36, 30}, {42, 20}, {20, 20}});
    const Read made = read(card.text());
    ASSERT_TRUE(made.assembly);
    ASSERT_EQ(made.count("contour-crosses-itself"), 1U) << made.told();
    EXPECT_EQ(made.findings[2].message,
              "faces[0].contours[0].outer crosses itself at X 40.00, Y 6.67: all 833.33 mm² that it goes "
              "round were taken");
    expect_by_the_rules(card.text(), *made.assembly);
    expect_closed(*made.assembly);
}

TEST(Oa, FacesThatAreNowhereSeenAreNamed) {
    Card card;
    card.box(40, 20, 60, 0, 40);
    card.box(10, 30, 50, 0, 5);           // behind the first, whose paper it has
    card.box(20, 200, 220, 0, 20);        // beside the card
    card.box(30, 90, 110, 0, 20);         // partly beside it
    card.add(0, 25, {{70, 5}, {80, 5}});  // no area
    card.box(0, 70, 80, 0, 20);           // the back itself
    card.box(81, 70, 80, 0, 20);          // beyond the floor
    card.box(200, 70, 80, 0, 20, 1);      // a hole may be anywhere
    const Read made = read(card.text());
    ASSERT_TRUE(made.assembly) << made.told();
    EXPECT_EQ(made.count("oa-hidden"), 2U) << made.told();
    EXPECT_EQ(made.count("oa-clipped"), 1U) << made.told();
    EXPECT_EQ(made.count("oa-contour-empty"), 1U) << made.told();
    EXPECT_EQ(made.count("oa-depth"), 2U) << made.told();
}

// --- random cards

TEST(Oa, RandomCardsAreByTheRules) {
    test::Random random(20261123);
    std::size_t folds = 0;
    for (int n = 0; n < 100; ++n) {
        Card card;
        const std::size_t count = 1 + random.below(9);
        const auto pick = [&](int least, int most) {
            return static_cast<double>(
                       least + static_cast<int>(random.below(static_cast<std::size_t>(most - least + 1)))) *
                   4.0;
        };
        for (std::size_t i = 0; i < count; ++i) {
            const double t = pick(1, 14);
            const double x0 = pick(0, 20);
            const double x1 = x0 + pick(1, 10);
            const double from = random.below(3) == 0 ? pick(0, 5) : 0.0;
            const double to = from + pick(1, 10);
            const std::size_t kind = random.below(6);
            const int mode = kind < 4 ? 0 : static_cast<int>(kind) - 3;
            Json& face = random.below(4) == 0 ? card.add(mode, t,
                                                         {{x0, from},
                                                          {x1, from},
                                                          {x1, to},
                                                          {0.5 * (x0 + x1), to},
                                                          {0.5 * (x0 + x1), to + 8},
                                                          {x0, to + 4}})
                                              : card.box(t, x0, x1, from, to, mode);
            if (random.below(3) == 0) face["timestamp"] = static_cast<double>(random.below(3));
            if (mode != 1 && random.below(4) == 0 && x1 - x0 >= 12.0 && to - from >= 12.0) {
                face["contours"][0]["holes"].push_back(Card::points(
                    t, {{x0 + 4, from + 4}, {x1 - 4, from + 4}, {x1 - 4, to - 4}, {x0 + 4, to - 4}}));
            }
            if (random.below(6) == 0) face["contoursType"] = "expolygons";
        }
        const Read made = read(card.text());
        if (!made.assembly) {
            EXPECT_EQ(made.count("oa-no-card"), 1U) << made.told();
            continue;
        }
        const OaRules rules(card.text(), 0.5);
        const Compared result = compare(*made.assembly, rules);
        EXPECT_EQ(result.wrong, 0U) << n << " " << result.first << "\n" << card.text();
        EXPECT_EQ(result.missing, 0U) << n << " " << result.first << "\n" << card.text();
        EXPECT_EQ(result.extra, 0U) << n << " " << result.first << "\n" << card.text();
        folds += result.folds;
        expect_closed(*made.assembly);
        // All paper is in a plate, or fell out and was told of unless a hole was there.
        Diagnostics diagnostics("card.oa");
        const auto file = oa::read_card(Source{"card.oa", card.text()}, {}, diagnostics);
        const auto sheet = oa::lay_out_sheet(*file, diagnostics);
        double all = 0.0;
        for (const oa::Region& region : sheet->regions) all += area(region.area);
        EXPECT_NEAR(all, 100.0 * 160.0, 1e-3);
        EXPECT_LE(paper(*made.assembly), all + 1e-6);
        if (made.count("oa-loose") == 0) {
            double open = 0.0;
            for (const oa::Region& region : sheet->regions) open += region.cut_mm2;
            EXPECT_GE(paper(*made.assembly) + open, all - 10.0) << card.text();
        }
    }
    EXPECT_GT(folds, 5000U);
}

// --- other people's designs, which are read where they lie

std::filesystem::path shared_data() {
    return std::filesystem::path(POPUP_SOURCE_DIR).parent_path() / "shared/data/oa";
}

class OaShared : public testing::TestWithParam<std::string> {
 protected:
    void SetUp() override {
        path_ = shared_data() / (GetParam() + ".oa");
        if (!std::filesystem::exists(path_)) GTEST_SKIP() << "the shared designs are not here";
        text_ = test::read_file(path_.string());
    }
    std::filesystem::path path_;
    std::string text_;
};

TEST_P(OaShared, IsCutAndFoldedByTheRules) {
    const Read made = read(text_);
    ASSERT_TRUE(made.assembly) << made.told();
    EXPECT_FALSE(made.has_errors());
    const OaRules rules(text_, 0.25);
    const Compared result = compare(*made.assembly, rules, made.count("oa-snapped") > 0 ? 0.5 : 0.0);
    EXPECT_GT(result.cells, 50'000U);
    EXPECT_EQ(result.wrong, 0U) << result.first;
    EXPECT_EQ(result.missing, 0U) << result.first;
    EXPECT_EQ(result.extra, 0U) << result.first;
    EXPECT_GT(result.folds, 100U);
    // What is in no plate lies in a hole.
    const double cell =
        rules.width() * 2.0 * rules.height() / static_cast<double>(rules.columns() * rules.rows());
    double holes = 0.0;
    for (std::size_t r = 0; r < rules.rows(); ++r) {
        for (std::size_t c = 0; c < rules.columns(); ++c) holes += rules.in_hole(c, r) ? cell : 0.0;
    }
    const double whole = rules.width() * 2.0 * rules.height();
    EXPECT_LE(paper(*made.assembly), whole + 1e-6);
    EXPECT_GE(paper(*made.assembly), whole - holes);
    expect_closed(*made.assembly);
}

TEST_P(OaShared, OpensWithoutACollision) {
    const Read made = read(text_);
    ASSERT_TRUE(made.assembly) << made.told();
    Diagnostics diagnostics(path_.string());
    const auto motion = simulate(*made.assembly, {}, diagnostics);
    ASSERT_TRUE(motion && motion->examination) << test::findings(diagnostics);
    EXPECT_TRUE(motion->examination->contacts.empty()) << test::findings(diagnostics);
    EXPECT_TRUE(motion->examination->undecided.empty());
    EXPECT_EQ(motion->examination->decided_up_to_deg, 90.0);
    EXPECT_LT(motion->max_closure_mm, 1e-9);
    if (!test::BruteForce::available()) GTEST_SKIP() << test::BruteForce::kMissing;
    const test::BruteForce brute(*made.assembly);
    for (const double deg : {0.5, 20.0, 45.0, 70.0, 89.5}) EXPECT_TRUE(brute.crossing_at(deg).empty()) << deg;
}

TEST_P(OaShared, IsTheSameWhenItsAssemblyIsRead) {
    const Read made = read(text_);
    ASSERT_TRUE(made.assembly) << made.told();
    Assembly assembly = *made.assembly;
    assembly.file = "card.oa";
    assembly.stem = "card";
    const std::string emitted = emit_assembly(assembly);
    Diagnostics diagnostics("card.assembly.json");
    const Reading again = read_source_text(Source{"card.assembly.json", emitted}, {}, diagnostics);
    ASSERT_TRUE(again.assembly) << test::findings(diagnostics);
    EXPECT_EQ(emit_assembly(*again.assembly), emitted);
}

INSTANTIATE_TEST_SUITE_P(Oa, OaShared, testing::Values("house", "chair", "castle", "bad-fail3"),
                         [](const testing::TestParamInfo<std::string>& one) {
                             std::string name = one.param;
                             std::replace(name.begin(), name.end(), '-', '_');
                             return name;
                         });

}  // namespace
}  // namespace popup
