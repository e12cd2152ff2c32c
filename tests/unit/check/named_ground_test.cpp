// Guarantees of folds and plates by name: a name means the fold itself, and what stands on it follows it.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>
#include <string>

#include "popup/check.h"
#include "support/designs.h"
#include "support/sanitized.h"

namespace popup::test {
namespace {

const auto kSeeds = sanitized_count<std::uint64_t>(40, 8);

// Seen from the middle of a line: x to its right, y along it.
Vec2 beside(const Segment& line, Vec2 p) {
    const Vec2 along = (1.0 / distance(line.a, line.b)) * (line.b - line.a);
    const Vec2 from = p - 0.5 * (line.a + line.b);
    return {from.x * along.y - from.y * along.x, from.x * along.x + from.y * along.y};
}

// The same design with every fold by its name; how many there are that could be named.
std::size_t name_all(Design& design) {
    const CardFolds card = folds_of_card(design);
    std::size_t named = 0;
    for (std::size_t n = 0; n < design.structures.size(); ++n) {
        Structure& one = design.structures[n];
        const Standing& standing = card.standing[n];
        if (one.plate || one.finds_ground || !standing.fold) continue;
        const CardFold& fold = card.folds[*standing.fold];
        // Given the other way round, left is right.
        const Vec2 given = one.fold.end.at - one.fold.begin.at;
        const Segment& line = one.fold.page == fold.at.left_page ? fold.at.on_left : fold.at.on_right;
        if (dot(given, line.b - line.a) < 0.0) continue;
        const ElementInfo& info = *find_element(one.type);
        for (std::size_t i = 0; i < one.points.size(); ++i) {
            if (info.points[i].page == PointPage::extra) continue;
            const bool right = info.points[i].side == 'R';
            one.points[i].at = beside(right ? fold.at.on_right : fold.at.on_left, one.points[i].at);
            one.points[i].page.reset();
        }
        for (std::size_t i = 0; i < one.arguments.size(); ++i) {
            const auto* drawn = std::get_if<DrawnPath>(&one.arguments[i].value);
            if (drawn == nullptr || info.parameters[i].page == PointPage::extra) continue;
            one.arguments[i] =
                path_argument(drawn->path.mapped([&](Vec2 p) { return beside(fold.at.on_left, p); }));
        }
        one.fold = {};
        one.fold.on.text = standing.on;
        one.fold.on.owner = fold.owner;
        one.fold.on.which = fold.which;
        ++named;
    }
    return named;
}

void expect_same_card(const Design& one, const Design& other) {
    const Built a = build(one);
    const Built b = build(other);
    ASSERT_TRUE(a.assembly && b.assembly);
    EXPECT_EQ(findings(a.diagnostics), findings(b.diagnostics));
    ASSERT_EQ(a.assembly->plates.size(), b.assembly->plates.size());
    for (std::size_t i = 0; i < a.assembly->plates.size(); ++i) {
        const Plate& p = a.assembly->plates[i];
        const Plate& q = b.assembly->plates[i];
        EXPECT_EQ(p.name, q.name);
        ASSERT_EQ(p.outline.outer.size(), q.outline.outer.size()) << p.name;
        for (std::size_t k = 0; k < p.outline.outer.size(); ++k)
            EXPECT_LE(distance(p.outline.outer[k], q.outline.outer[k]), 2e-6) << p.name;
    }
}

TEST(NamedGround, IsTheFoldItself) {
    std::size_t named = 0;
    std::set<std::string> folds;
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
        SCOPED_TRACE(seed);
        const Design design = seed % 2 == 0 ? generate(seed, 8) : generate_any(seed, 8);
        Design by_name = design;
        named += name_all(by_name);
        expect_same_card(design, by_name);
        for (const Structure& one : by_name.structures)
            folds.insert(one.fold.on.text.substr(one.fold.on.text.rfind('.') + 1));
    }
    EXPECT_GT(named, 3U * kSeeds);
    EXPECT_GE(folds.size(), 4U) << "gutter, left, centre, right";
}

// Repairs of what is named are written beside the fold, and settle: mended once, nothing is left to mend.
TEST(NamedGround, RepairsStayBesideIt) {
    std::size_t repaired = 0;
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
        SCOPED_TRACE(seed);
        Design design = generate(seed, 8);
        name_all(design);
        // Each is made a little crooked, and children stay where they are on what moves under them.
        double off = 0.3;
        for (Structure& one : design.structures) {
            if (one.fold.on.given() && !one.points.empty()) one.points.front().at.y += (off = -off);
        }
        Diagnostics first;
        const auto mended = check(design, {}, first);
        if (!mended) continue;
        repaired += first.repairs().size();
        for (const Diagnostic& one : first.repairs()) EXPECT_NE(one.code, "moved-with-fold") << one.message;
        Diagnostics second;
        const auto again = check(mended->design(), {}, second);
        ASSERT_TRUE(again) << findings(second);
        EXPECT_EQ(findings(second), "");
        for (std::size_t n = 0; n < design.structures.size(); ++n) {
            EXPECT_EQ(mended->design().structures[n].fold.on.text, design.structures[n].fold.on.text);
            for (std::size_t i = 0; i < design.structures[n].points.size(); ++i) {
                const DesignPoint& is = mended->design().structures[n].points[i];
                if (!is.changed) {
                    EXPECT_EQ(is.at, design.structures[n].points[i].at);
                }
            }
        }
    }
    EXPECT_GT(repaired, kSeeds / 2);
}

// Each fold and plate that a row names is there under that name, of every element that can be made.
TEST(NamedGround, HasAllNamesOfRows) {
    std::set<std::string_view> seen;
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
        const Design design = generate_any(seed, 12);
        const CardFolds card = folds_of_card(design);
        std::map<std::string, const CardFold*> folds;
        for (const CardFold& fold : card.folds)
            EXPECT_TRUE(folds.emplace(fold.name, &fold).second) << fold.name;
        EXPECT_TRUE(folds.contains("gutter"));
        ASSERT_EQ(card.standing.size(), design.structures.size());
        for (std::size_t n = 0; n < design.structures.size(); ++n) {
            const Structure& one = design.structures[n];
            const ElementInfo& info = *find_element(one.type);
            seen.insert(info.name);
            EXPECT_NE(card.standing[n].on, "") << one.id;
            for (const FoldInfo& fold : info.folds) EXPECT_TRUE(folds.contains(fold_name(one.id, fold)));
            // A disc stands on each of its plates.
            for (std::size_t i = 0; i < info.plates.size(); ++i) {
                SCOPED_TRACE(plate_name(one.id, info.plates[i]));
                Design more = design;
                more.version = "3.0";
                Structure disc;
                disc.type = "disc";
                disc.id = "disc-on-it";
                disc.points.resize(2);
                ParentPlate& plate = disc.plate.emplace();
                plate.on = {plate_name(one.id, info.plates[i]), n, i, {}, false};
                more.structures.push_back(disc);
                EXPECT_EQ(folds_of_card(more).standing.back().on, plate.on.text);
            }
        }
    }
    // Few designs need not have all of them.
    EXPECT_TRUE(kSanitized || seen.size() == element_table().size()) << seen.size();
}

}  // namespace
}  // namespace popup::test
