// What has been moved along its fold comes back by the opposite move, byte for byte.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "popup/check.h"
#include "popup/edit.h"
#include "popup/language.h"
#include "support/designs.h"

namespace popup::test {
namespace {

// A step with sides that are not parallel, which reaches over the edge of the page, with a box that stands
// on its left fold. The step is mended, and 11 mm shorter then.
constexpr const char* kMendedStep = R"(<popup version="2.0" units="mm">
  <mainpage width="200" height="140"/>
  <structurelist>
    <structure type="step" id="step">
      <outerpoints>
        <point x="-20" y="-80"/>
        <point x="-20.02" y="20"/>
        <point x="22" y="-80"/>
        <point x="22" y="20"/>
      </outerpoints>
      <parentfold>
        <begin x="0" y="-70"/>
        <end x="0" y="70"/>
      </parentfold>
    </structure>
    <structure type="box" id="box" height="5">
      <outerpoints>
        <point x="-24" y="5"/>
        <point x="-24" y="17"/>
        <point x="-16" y="5"/>
        <point x="-16" y="17"/>
      </outerpoints>
      <parentfold>
        <begin x="-20" y="-80"/>
        <end x="-20.02" y="20"/>
      </parentfold>
    </structure>
  </structurelist>
</popup>
)";

std::string edited(const std::string& document, const std::string& line) {
    Diagnostics of_edits("edits.txt");
    Diagnostics of_document("card.xml");
    const std::vector<EditLine> edits = read_edits(line, of_edits);
    const auto made = edit_document({"card.xml", document}, edits, {}, of_edits, of_document);
    EXPECT_TRUE(made && !made->refused) << findings(of_edits) << findings(of_document);
    return made ? made->text : std::string();
}

// The fold of the box as check() sees it: where it is, or where its author saw it.
PageFold fold_of_box(const std::string& document) {
    Diagnostics said("card.xml");
    const auto design = read_design({"card.xml", document}, {}, said);
    EXPECT_TRUE(design) << findings(said);
    const CardFolds card = folds_of_card(*design);
    EXPECT_EQ(card.standing[1].on, "step.left");
    return card.standing[1].seen;
}

TEST(MovedBack, FromWhereItsFoldIsToWhereItsAuthorSawIt) {
    const std::string moved = edited(kMendedStep, "move box --along=-9");
    // Near the end of the fold the box is beyond its end where its author saw it.
    EXPECT_GT(distance(fold_of_box(kMendedStep).on_left.a, fold_of_box(moved).on_left.a), 1.0);
    EXPECT_EQ(edited(moved, "move box --along=9"), kMendedStep);
}

}  // namespace
}  // namespace popup::test
