// Where what stood in a text stands once it has been edited.
#include "edit/moved_places.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace popup::edit {
namespace {

// A change of the first place in the text where `was` stands.
xml::PatchEdit change(const std::string& text, const std::string& was, const std::string& now) {
    const std::size_t at = text.find(was);
    EXPECT_NE(at, std::string::npos) << was;
    return {at, at + was.size(), now};
}

TEST(MovedPlaces, FollowWhatStandsThere) {
    const std::string before = "<a>\n  <ä x=\"1\" y=\"2\"/>\n  <gone/>\n  <c z=\"3\"/> <d/>\n</a>\n";
    const std::vector<xml::PatchEdit> changes{change(before, "1", "one\n"), change(before, "  <gone/>\n", ""),
                                              change(before, "3", "33")};
    const std::string after = xml::patched(before, changes);
    ASSERT_EQ(after, "<a>\n  <ä x=\"one\n\" y=\"2\"/>\n  <c z=\"33\"/> <d/>\n</a>\n");
    const MovedPlaces moved(before, changes, after);
    EXPECT_EQ(moved.of({1, 1}), (Place{1, 1}));
    EXPECT_EQ(moved.of({2, 6}), (Place{2, 6})) << "before the change, behind a letter of two bytes";
    EXPECT_EQ(moved.of({2, 9}), (Place{2, 9})) << "what was changed begins where it began";
    EXPECT_EQ(moved.of({2, 12}), (Place{3, 3})) << "behind a new line";
    EXPECT_EQ(moved.of({3, 3}), std::nullopt) << "taken out";
    EXPECT_EQ(moved.of({4, 3}), (Place{4, 3})) << "one line more, one less";
    EXPECT_EQ(moved.of({4, 14}), (Place{4, 15})) << "on the line of a change, behind it";
    EXPECT_EQ(moved.of({5, 1}), (Place{5, 1}));
    EXPECT_EQ(moved.of({}), Place{}) << "none";
    EXPECT_EQ(moved.of({9, 1}), std::nullopt) << "no such line";
}

TEST(MovedPlaces, OfAFindingAreAllMovedOrItIsNot) {
    const std::string before = "<a/>\n<b/>\n<c/>\n";
    const std::vector<xml::PatchEdit> changes{change(before, "<b/>\n", "")};
    const std::string after = xml::patched(before, changes);
    const MovedPlaces moved(before, changes, after);
    Diagnostic one;
    one.place = {3, 1};
    one.related = {{{1, 1}, "a"}};
    EXPECT_TRUE(moved.move(one));
    EXPECT_EQ(one.place, (Place{2, 1}));
    EXPECT_EQ(one.related.front().place, (Place{1, 1}));
    one.related = {{{2, 1}, "b"}};
    EXPECT_FALSE(moved.move(one));
}

}  // namespace
}  // namespace popup::edit
