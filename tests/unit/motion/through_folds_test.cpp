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

// A layer on a pillar in the plane over the gutter, y from -65 to -35, and a v-fold whose middle fold leans
// over the gutter from y = -30 on, into the pillar.
std::string card(double pillar_end, const std::string& skew) {
    return fmt::format(
        "<popup version='3.0' units='mm'><mainpage width='240' height='200'/><structurelist>"
        "<structure type='floating-layer' id='fl' height='60'><outerpoints>"
        "<point x='-40' y='-65'/><point x='-40' y='{0}'/><point x='40' y='-65'/><point x='40' y='{0}'/>"
        "</outerpoints><parentfold on='gutter'/></structure>"
        "<structure type='v-fold' id='vf'><outerpoints>"
        "<point x='-15' y='-17.413506'/><point x='0' y='-30'/><point x='15' y='-17.413506'/>"
        "<point x='-19.283628' y='3.400224'/><point x='0' y='0'/><point x='19.283628' y='3.400224'/>"
        "<point x='15' y='30'/><point x='-15' y='30'/></outerpoints><parentfold on='gutter'/>{1}"
        "</structure></structurelist></popup>",
        pillar_end, skew);
}

Compilation compiled(const std::string& text) {
    CompileOptions options;
    options.until = Stage::motion;
    return compile({Source{"card.xml", text}}, options, {});
}

// How much of the middle fold is in the paper of the pillar, from its points alone: the fold starts at
// (0, -30, 0) and is 30 mm long; the pillar is the plane over the gutter, from y = -65 to its end, and as
// high as the fold reaches.
double inside_mm(const Assembly& assembly, double deg, double pillar_end) {
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
        const double low = std::min(p.y, q.y);
        const double share = std::max(0.0, std::min(1.0, (pillar_end - low) / std::abs(q.y - p.y)));
        return share * distance(p, q);
    }
    ADD_FAILURE() << "no middle fold";
    return 0.0;
}

TEST(ThroughFolds, AreFoundWhereNoTwoPlatesCross) {
    const Compilation run = compiled(card(-35.0, ""));
    const CompiledDesign& one = run.designs.front();
    ASSERT_TRUE(one.motion && one.motion->examination) << test::findings(one.diagnostics);
    const std::vector<Contact>& contacts = one.motion->examination->contacts;
    ASSERT_EQ(contacts.size(), 2U) << test::findings(one.diagnostics);
    for (const Contact& contact : contacts) {
        EXPECT_TRUE(contact.at_fold);
        EXPECT_EQ(contact.from_deg, 0.0);
        EXPECT_EQ(one.assembly->plates.at(static_cast<std::size_t>(contact.longer)).name, "fl/pillar");
        // It begins where the fold's end comes to the pillar's edge.
        EXPECT_LT(inside_mm(*one.assembly, contact.to_deg + 0.05, -35.0), 0.06);
        EXPECT_GT(inside_mm(*one.assembly, contact.to_deg - 0.5, -35.0), 0.06);
    }
    const std::string said = test::findings(one.diagnostics);
    EXPECT_NE(said.find("\"fl/pillar\" goes through \"vf/left\" at its fold from an opening of"),
              std::string::npos)
        << said;
    EXPECT_NE(said.find("until the card is closed"), std::string::npos) << said;
}

TEST(ThroughFolds, AreNoneWhereTheFoldStaysBesideThePaper) {
    for (const double end : {-55.0, -60.0}) {
        const Compilation run = compiled(card(end, ""));
        const CompiledDesign& one = run.designs.front();
        ASSERT_TRUE(one.motion && one.motion->examination) << test::findings(one.diagnostics);
        double most = 0.0;
        for (int deg = 1; deg < 180; ++deg) most = std::max(most, inside_mm(*one.assembly, deg, end));
        EXPECT_EQ(one.motion->examination->contacts.empty(), most < 0.02) << end << " " << most;
    }
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
