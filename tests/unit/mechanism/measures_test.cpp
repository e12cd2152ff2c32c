// Guarantees of measures: they say all of where an element's points are, and nothing is lost on the way there
// and back.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <string>

#include "mechanism/element.h"
#include "popup/check.h"
#include "support/designs.h"
#include "support/proposals.h"
#include "support/run_program.h"
#include "support/sanitized.h"

namespace popup::test {
namespace {

constexpr double kSame = 1e-9;

// An element with the fold that it stands on.
struct Standing {
    const ElementInfo* info;
    PageFold parent;
    std::vector<Vec2> points;
    std::vector<Argument> arguments;
};

PageFold page_fold(const Fold& fold) {
    return {fold.left_page, fold.right_page, fold.on_left, fold.on_right, fold.seam, fold.closed_deg};
}

// All elements of a design that stand on folds, each with the fold under it.
std::vector<Standing> standing_in(const Design& design) {
    std::vector<Standing> made;
    Diagnostics diagnostics;
    const auto checked = check(design, {}, diagnostics);
    if (!checked) return made;
    for (const Structure& one : design.structures) {
        const ElementInfo& info = *find_element(one.type);
        Standing here{&info, {}, {}, one.arguments};
        here.arguments.resize(info.parameters.size());
        for (const DesignPoint& point : one.points) here.points.push_back(point.at);
        const Segment up{{0, 0}, {0, 1}};
        here.parent = {0, 0, up, up, false, 0};
        if (!one.plate && !info.grounds.page) {
            const Fold* found = nullptr;
            for (const Fold& fold : checked->skeleton().folds) {
                const bool left = fold.left_page == one.fold.page && fold.on_left.a == one.fold.begin.at &&
                                  fold.on_left.b == one.fold.end.at;
                if (left) found = &fold;
            }
            if (found == nullptr) continue;
            here.parent = page_fold(*found);
        }
        made.push_back(std::move(here));
    }
    return made;
}

std::vector<Vec2> corners(const Argument& argument) {
    std::vector<Vec2> made;
    if (const auto* path = std::get_if<DrawnPath>(&argument.value)) {
        for (const Subpath& line : path->path.subpaths()) {
            made.push_back(line.start);
            for (const PathStep& step : line.steps) made.push_back(step.to);
        }
    }
    if (const auto* points = std::get_if<std::vector<DesignPoint>>(&argument.value)) {
        for (const DesignPoint& point : *points) made.push_back(point.at);
    }
    return made;
}

void expect_same(const std::vector<Vec2>& is, const std::vector<Vec2>& was, const std::string& what) {
    ASSERT_EQ(is.size(), was.size()) << what;
    for (std::size_t i = 0; i < is.size(); ++i) EXPECT_LE(distance(is[i], was[i]), kSame) << what << " " << i;
}

void expect_same(const Shaped& is, const Standing& was) {
    expect_same(is.points, was.points, "points");
    for (std::size_t i = 0; i < was.arguments.size(); ++i)
        expect_same(corners(is.arguments[i]), corners(was.arguments[i]),
                    std::string(was.info->parameters[i].name));
}

// What no measure tells: which way the letters of points that have a side run along the fold.
std::vector<bool> ways(const Standing& one) {
    const Element e = element_on(*one.info, one.parent, 1, one.points, one.arguments);
    std::vector<bool> made;
    if (e.on.size() == 4 || (e.on.size() == 2 && one.info->name == "box-fold")) {
        made.push_back(e.on[1].s >= e.on[0].s);
        made.push_back(e.on[1].w > e.on[0].w && e.on.size() == 2);
    }
    if (one.info->family == "v-fold") made.push_back(one.info->inverted);
    return made;
}

// Its points as seen from the middle of its fold, and those of its piece.
std::vector<Vec2> seen_along(const Standing& one, const std::vector<Vec2>& points) {
    const Element e = element_on(*one.info, one.parent, 1, points, one.arguments);
    std::vector<Vec2> made = e.extra;
    for (const SitePoint p : e.on) made.push_back({p.s - 0.5 * e.site.length, p.w});
    return made;
}

bool is_drawn_on(const Standing& one) {
    return std::any_of(one.arguments.begin(), one.arguments.end(),
                       [](const Argument& argument) { return !corners(argument).empty(); });
}

std::size_t outline_of(const ElementInfo& info) { return find_parameter(info, "outline").value(); }

// Measures that are as good as the element's own, and differ in each.
std::vector<double> others(const Standing& one, const std::vector<double>& values, Dice& random) {
    std::vector<double> made = values;
    for (std::size_t i = 0; i < made.size(); ++i) {
        const MeasureInfo& measure = one.info->measures[i];
        if (measure.kind == MeasureKind::choice) {
            made[i] = 1.0 - made[i];
        } else if (measure.said == Said::always) {
            made[i] *= random.uniform(0.9, 1.0);
        } else if (made[i] != 0.0 || measure.relative || measure.said == Said::drawing ||
                   one.info->family != "disc") {
            made[i] += random.uniform(-0.3, 0.3);
        }
    }
    return made;
}

// There is a design of each row with elements enough of it.
std::vector<Standing> elements_of(const ElementInfo& info, std::uint64_t seed) {
    Design design;
    if (info.grounds.fold || info.grounds.seam) {
        design = generate_of(info, seed, 4);
    } else {
        design = generate_any(seed, 14);
    }
    std::vector<Standing> made = standing_in(design);
    std::erase_if(made, [&](const Standing& one) { return one.info != &info; });
    return made;
}

const auto kSeeds = sanitized_count<std::uint64_t>(24, 6);

// Points to measures to points, and by way of other measures back; and put on another element of the same
// kind.
TEST(Measures, SayAllOfWherePointsAre) {
    for (const ElementInfo& info : element_table()) {
        std::size_t seen = 0;
        std::size_t crossed = 0;
        Dice random{7};
        for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
            const std::vector<Standing> all = elements_of(info, seed);
            for (std::size_t k = 0; k < all.size(); ++k) {
                const Standing& one = all[k];
                SCOPED_TRACE(std::string(info.name) + " " + std::to_string(seed) + " " + std::to_string(k));
                const auto values = measures_of(info, one.parent, 1, one.points, one.arguments);
                ASSERT_TRUE(values);
                ++seen;
                const auto same = shaped(info, one.parent, 1, one.points, one.arguments, *values);
                ASSERT_TRUE(same);
                expect_same(*same, one);
                for (const Argument& argument : same->arguments) EXPECT_FALSE(argument.changed);

                const std::vector<double> wanted = others(one, *values, random);
                const auto other = shaped(info, one.parent, 1, one.points, one.arguments, wanted);
                ASSERT_TRUE(other);
                const auto again = measures_of(info, one.parent, 1, other->points, other->arguments);
                ASSERT_TRUE(again);
                bool by = false;
                for (std::size_t i = 0; i < wanted.size(); ++i) {
                    if (info.measures[i].relative) {
                        by = true;
                        continue;
                    }
                    // What is turned fills another box. Angles a full turn apart are the same. Points that
                    // stray within rounding from what the constraints want still do.
                    if (!by && info.measures.back().relative) continue;
                    EXPECT_NEAR(std::remainder((*again)[i] - wanted[i], 360.0), 0.0, 1e-4)
                        << info.measures[i].name;
                }
                std::vector<double> undone = *values;
                for (std::size_t i = 0; i < undone.size(); ++i) {
                    if (info.measures[i].relative) undone[i] = -wanted[i];
                }
                if (!by) {
                    const auto back = shaped(info, one.parent, 1, other->points, other->arguments, undone);
                    ASSERT_TRUE(back);
                    expect_same(*back, one);
                }
                // Put on another, that runs the same way, they make the same element: no point was left out.
                if (is_drawn_on(one)) continue;
                for (const Standing& twin : all) {
                    if (&twin == &one || is_drawn_on(twin) || ways(twin) != ways(one)) continue;
                    const auto moved = shaped(info, twin.parent, 1, twin.points, twin.arguments, *values);
                    ASSERT_TRUE(moved);
                    expect_same(seen_along(twin, moved->points), seen_along(one, one.points),
                                "put on another");
                    ++crossed;
                }
            }
        }
        // Few designs need not have all of them.
        if (kSanitized) continue;
        EXPECT_GE(seen, 4U) << info.name;
        if (!info.points.empty() && !find_parameter(info, "outline")) {
            EXPECT_GE(crossed, 2U) << info.name;
        }
    }
}

// What is drawn turns about the middle of its corners, or its apex: the opposite turn brings it back.
TEST(Measures, ATurnIsUndoneByItsOpposite) {
    for (const ElementInfo& info : element_table()) {
        if (info.measures.empty() || !info.measures.back().relative) continue;
        std::size_t seen = 0;
        for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
            for (const Standing& one : elements_of(info, seed)) {
                SCOPED_TRACE(std::string(info.name) + " " + std::to_string(seed));
                const auto turned = [&](const std::vector<Vec2>& points, const std::vector<Argument>& given,
                                        double by) {
                    std::vector<double> values = measures_of(info, one.parent, 1, points, given).value();
                    values.back() = by;
                    return shaped(info, one.parent, 1, points, given, values).value();
                };
                const Shaped there = turned(one.points, one.arguments, 17.0);
                EXPECT_GT(distance(corners(there.arguments[outline_of(info)])[0],
                                   corners(one.arguments[outline_of(info)])[0]),
                          0.1);
                expect_same(turned(there.points, there.arguments, -17.0), one);
                ++seen;
            }
        }
        EXPECT_GE(seen, 1U) << info.name;
    }
}

// docs/elements.md has a row for each element, or for its upright form, with the names of all of its
// measures.
TEST(Measures, AreOnThePageOfElements) {
    const std::string page = read_file(std::filesystem::path(POPUP_SOURCE_DIR) / "docs/elements.md");
    const std::string text = page.substr(page.find("## In the words of people"));
    for (const ElementInfo& info : element_table()) {
        if (info.inverted) continue;
        const std::size_t at = text.find("`" + std::string(info.name) + "`");
        ASSERT_NE(at, std::string::npos) << info.name;
        std::string row = text.substr(at, text.find('\n', at) - at);
        if (row.find("those of the beak") != std::string::npos)
            row += text.substr(text.find("| `beak`"), 100);
        for (const MeasureInfo& measure : info.measures)
            EXPECT_NE(row.find("`" + std::string(measure.name) + "`"), std::string::npos)
                << info.name << " " << measure.name;
    }
}

TEST(Measures, HaveNamesOfTheirOwn) {
    for (const ElementInfo& info : element_table()) {
        EXPECT_FALSE(info.measures.empty()) << info.name;
        std::set<std::string_view> names;
        for (const MeasureInfo& measure : info.measures) {
            EXPECT_TRUE(names.insert(measure.name).second) << info.name << " " << measure.name;
            EXPECT_FALSE(find_parameter(info, measure.name)) << info.name << " " << measure.name;
            EXPECT_FALSE(measure.about.empty());
            EXPECT_EQ(measure.name.find_first_not_of("abcdefghijklmnopqrstuvwxyz"), std::string_view::npos);
            EXPECT_EQ(measure.kind == MeasureKind::choice, !measure.words.empty());
        }
        EXPECT_EQ(find_measure(info, "no-such"), std::nullopt);
    }
    EXPECT_EQ(find_measure(*find_element("v-fold"), "Piece-X"),
              find_measure(*find_element("v-fold"), "piecex"));
}

}  // namespace
}  // namespace popup::test
