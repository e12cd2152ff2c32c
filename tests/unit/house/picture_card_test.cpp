// The card that benchmarks of pictures compile: what it is made of, and that it folds without a fault.
#include "support/picture_card.h"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>

#include "popup/image.h"
#include "popup/print.h"
#include "support/designs.h"

namespace popup::test {
namespace {

TEST(PictureCard, IsOfFortyPiecesOfAllKindsWithTenPicturesAndHasRemarksAlone) {
    const Compilation c = compile({{"card.xml", picture_card()}}, picture_card_options(), {});
    ASSERT_TRUE(c.layout.has_value()) << findings(c.designs[0].diagnostics);
    std::map<std::string, int> kinds;
    for (const Structure& one : c.designs[0].design->structures) ++kinds[std::string(one.type)];
    const std::map<std::string, int> expected{
        {"layer", 5}, {"attached-plane", 5}, {"v-fold", 5}, {"box", 5},
        {"tent", 5},  {"floating-layer", 5}, {"pivot", 5},  {"disc", 5}};
    EXPECT_EQ(kinds, expected);
    for (const Diagnostic& one : c.designs[0].diagnostics.sorted()) EXPECT_EQ(one.severity, Severity::remark);
    EXPECT_EQ(c.designs[0].further_files.size(), std::size_t{kCardPictures});
    std::set<const std::string*> shown;
    for (const Plate& plate : c.designs[0].assembly->plates) {
        for (const Print& print : plate.prints) {
            if (const auto* image = std::get_if<Image>(&print)) shown.insert(image->bytes.get());
        }
    }
    EXPECT_EQ(shown.size(), std::size_t{kCardPictures});
}

}  // namespace
}  // namespace popup::test
