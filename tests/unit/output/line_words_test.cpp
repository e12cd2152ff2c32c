// How a book names the lines of the sheets that it is read with.
#include "output/book/line_words.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <string>

#include "popup/profile.h"

namespace popup::book {
namespace {

std::string all_of(const Profile& profile, const LinesThere& lines) {
    std::string text;
    for (const std::string& one : line_words(profile, lines)) text += one + "\n";
    return text;
}

TEST(LineWords, AreThoseOfTheWorkshop) {
    const std::string said = all_of(profile_table().front(), {true, true});
    EXPECT_EQ(
        said,
        "Print the sheets at 100 %, without fitting them to the page.\n"
        "Score the dashed lines before you cut: a ruler, and a blunt point that presses a groove without "
        "cutting. Blue lines (long and short dashes) are mountains: they fold away from you. Magenta lines "
        "(even dashes) are valleys: they fold towards you.\n"
        "Cut the solid red lines: first those inside of a piece, with the knife, then its outline.\n");
    EXPECT_EQ(all_of(profile_table().front(), {false, false}),
              "Print the sheets at 100 %, without fitting them to the page.\nCut the solid red lines.\n");
}

// LightBurn's scores are red: whoever cuts what is red cuts the folds.
TEST(LineWords, OfAMachineNameItsColours) {
    const std::string said = all_of(*find_profile("lightburn"), {true, true});
    EXPECT_TRUE(said.starts_with("The lines of the sheets are drawn for lightburn.")) << said;
    EXPECT_NE(said.find("Folds are red lines: the drawings of the steps show which way they go."),
              std::string::npos)
        << said;
    EXPECT_NE(
        said.find(
            "first those inside of a piece, which are blue or orange, with the knife, then its outline, "
            "which is black."),
        std::string::npos)
        << said;
    EXPECT_EQ(said.find("dashed"), std::string::npos) << said;
}

TEST(LineWords, OfEveryProfileSayWhatIsCutAndWhatIsFolded) {
    for (const Profile& profile : profile_table()) {
        SCOPED_TRACE(profile.name);
        const std::string said = all_of(profile, {true, true});
        EXPECT_NE(said.find("Cut the solid"), std::string::npos) << said;
        EXPECT_TRUE(said.find("mountains") != std::string::npos ||
                    said.find("Folds are") != std::string::npos)
            << said;
        EXPECT_EQ(profile.name == "workshop", said.find(profile.name) == std::string::npos) << said;
    }
}

TEST(LineWords, OfOnesOwnProfileFollowItsPens) {
    Profile own = profile_table().front();
    own.name = "mine";
    own.folds = FoldStyle::score;
    const auto pen = [&own](Operation operation) -> Pen& {
        return own.pens[static_cast<std::size_t>(operation)];
    };
    pen(Operation::mountain).color = {255, 0, 0};
    pen(Operation::valley).color = {0, 0, 255};
    for (const Operation operation : {Operation::slit, Operation::inner_cut, Operation::outer_cut})
        pen(operation).color = {0, 0, 0};
    const std::string said = all_of(own, {true, true});
    EXPECT_NE(said.find("Red lines are mountains: they fold away from you. Blue lines are valleys"),
              std::string::npos)
        << said;
    EXPECT_NE(said.find("Cut the solid black lines: first those"), std::string::npos) << said;
    pen(Operation::slit).layer.clear();
    pen(Operation::inner_cut).layer.clear();
    EXPECT_NE(all_of(own, {true, true}).find("Cut the solid black lines.\n"), std::string::npos)
        << all_of(own, {true, true});
    pen(Operation::outer_cut).layer.clear();
    EXPECT_NE(all_of(own, {true, true}).find("Not all cuts are on the sheets"), std::string::npos);
    pen(Operation::valley).layer.clear();
    EXPECT_NE(all_of(own, {true, true}).find("Not all folds are on the sheets"), std::string::npos);
}

}  // namespace
}  // namespace popup::book
