// Plates that go through paper where it is folded, in cards that are their own mirror images.
#include "motion/through_folds.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "motion/examine.h"
#include "output/xml.h"
#include "popup/compile.h"
#include "support/designs.h"

namespace popup {
namespace {

struct Range {
    double from = 0.0, to = 0.0;
};

// A layer on a pillar in the plane over the gutter, as long as `pillar` says in y, and a v-fold whose middle
// fold leans over the gutter from y = -30 on, is 30 mm long, and has a hole along `hole`, from its foot on.
std::string card(const Range& pillar, const Range& hole = {}) {
    const std::string cut = fmt::format("<hole d='M -3 {0} H 3 V {1} H -3 Z'/>", hole.from, hole.to);
    return fmt::format(
        "<popup version='3.0' units='mm'><mainpage width='240' height='200'/><structurelist>"
        "<structure type='floating-layer' id='fl' height='60'><outerpoints>"
        "<point x='-40' y='{0}'/><point x='-40' y='{1}'/><point x='40' y='{0}'/><point x='40' y='{1}'/>"
        "</outerpoints><parentfold on='gutter'/></structure>"
        "<structure type='v-fold' id='vf'><outerpoints>"
        "<point x='-15' y='-17.413506'/><point x='0' y='-30'/><point x='15' y='-17.413506'/>"
        "<point x='-19.283628' y='3.400224'/><point x='0' y='0'/><point x='19.283628' y='3.400224'/>"
        "<point x='15' y='30'/><point x='-15' y='30'/></outerpoints><parentfold on='gutter'/>{2}"
        "</structure></structurelist></popup>",
        pillar.from, pillar.to, hole.to > hole.from ? cut : "");
}

Compilation compiled(const std::string& text) {
    CompileOptions options;
    options.until = Stage::motion;
    return compile({Source{"card.xml", text}}, options, {});
}

// How much paper of the middle fold is in the pillar: from where the fold's ends are, and what stands above.
double inside_mm(const Assembly& assembly, double deg, const Range& pillar, const Range& hole) {
    std::vector<Frame> frames(assembly.plates.size());
    EXPECT_TRUE(place(assembly, Angle::degrees(deg), frames));
    for (const Hinge& hinge : assembly.hinges) {
        const auto& a = assembly.plates.at(static_cast<std::size_t>(hinge.a)).name;
        const auto& b = assembly.plates.at(static_cast<std::size_t>(hinge.b)).name;
        const bool is_middle = (a == "vf/left" && b == "vf/right") || (a == "vf/right" && b == "vf/left");
        if (hinge.glued || !is_middle) continue;
        const Frame& frame = frames.at(static_cast<std::size_t>(hinge.a));
        const Vec3 p = frame.point(hinge.a_line.a);
        const Vec3 q = frame.point(hinge.a_line.b);
        const bool stands_on_p = std::abs(p.z) < std::abs(q.z);
        // How far it goes towards the pillar, of its length; past upright, it leans away.
        const double rise = (stands_on_p ? p.y - q.y : q.y - p.y) / distance(p, q);
        if (rise <= 0.0) return 0.0;
        const auto within = [](const Range& one, const Range& other) {
            return std::max(0.0, std::min(one.to, other.to) - std::max(one.from, other.from));
        };
        // From its foot on.
        const Range in_pillar{(-30.0 - pillar.to) / rise, (-30.0 - pillar.from) / rise};
        const Range on_fold{std::max(0.0, in_pillar.from), std::min(30.0, in_pillar.to)};
        return std::max(0.0, within(on_fold, {0.0, 30.0}) - within(on_fold, hole));
    }
    ADD_FAILURE() << "no middle fold";
    return 0.0;
}

// At every opening there is a contact where there is paper, and none where there is not.
void expect_contacts(const Range& pillar, const Range& hole) {
    const Compilation run = compiled(card(pillar, hole));
    const CompiledDesign& one = run.designs.front();
    ASSERT_TRUE(one.motion && one.motion->examination) << test::findings(one.diagnostics);
    int with = 0;
    for (double deg = 0.5; deg < 180.0; deg += 0.5) {
        const double inside = inside_mm(*one.assembly, deg, pillar, hole);
        if (inside > 0.001 && inside < 0.06) continue;
        int seen = 0;
        for (const Contact& contact : one.motion->examination->contacts) {
            EXPECT_TRUE(contact.at_fold) << test::findings(one.diagnostics);
            seen += contact.from_deg <= deg && deg <= contact.to_deg ? 1 : 0;
        }
        EXPECT_EQ(seen, inside > 0.0 ? 2 : 0) << deg << "° " << inside << " mm";
        with += inside > 0.0 ? 1 : 0;
    }
    EXPECT_GT(with, 0);
}

TEST(ThroughFolds, AreFoundWhereThereIsPaper) {
    for (const Range& pillar : {Range{-65.0, -35.0}, Range{-50.0, -45.0}, Range{-34.0, -31.0}})
        ASSERT_NO_FATAL_FAILURE(expect_contacts(pillar, {}));
}

TEST(ThroughFolds, AreNoneWhereTheFoldIsCutAway) {
    // Across the fold's middle, beside it, and over most of it.
    for (const Range& hole : {Range{13.0, 17.0}, Range{18.0, 22.0}, Range{15.5, 28.5}}) {
        ASSERT_NO_FATAL_FAILURE(expect_contacts({-65.0, -35.0}, hole));
        ASSERT_NO_FATAL_FAILURE(expect_contacts({-48.0, -45.0}, hole));
    }
}

TEST(ThroughFolds, AreToldWithoutADepth) {
    const Compilation run = compiled(card({-65.0, -35.0}));
    const std::string said = test::findings(run.designs.front().diagnostics);
    EXPECT_NE(
        said.find("\"fl/pillar\" goes through \"vf/left\" at its fold from an opening of 136.28° until the "
                  "card is closed; so do \"fl/pillar\" through \"vf/right\""),
        std::string::npos)
        << said;
}

TEST(ThroughFolds, AreNoneWhereTheFoldStaysBesideThePaper) {
    const Range pillar{-90.0, -61.0};
    const Compilation run = compiled(card(pillar));
    const CompiledDesign& one = run.designs.front();
    ASSERT_TRUE(one.motion && one.motion->examination) << test::findings(one.diagnostics);
    for (int deg = 1; deg < 180; ++deg) EXPECT_EQ(inside_mm(*one.assembly, deg, pillar, {}), 0.0);
    EXPECT_TRUE(one.motion->examination->contacts.empty()) << test::findings(one.diagnostics);
}

// What stands on a fold, or has its own fold there, ends at it.
TEST(ThroughFolds, AreNoneInGeneratedCards) {
    std::size_t plates = 0;
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        const Compilation run = compiled(write_document(test::generate(seed, 8)));
        const CompiledDesign& one = run.designs.front();
        if (!one.assembly) continue;
        plates += one.assembly->plates.size();
        EXPECT_TRUE(find_through_folds(*one.assembly, plate_shapes(*one.assembly, {})).empty()) << seed;
    }
    EXPECT_GT(plates, 500U);
}

}  // namespace
}  // namespace popup
