// Places of bytes: those that a table tells are those that counting tells, and lead back to their bytes.
#include <gtest/gtest.h>

#include <string>

#include "input/xml/encoding.h"

namespace popup::xml {
namespace {

bool continues(char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; }

TEST(PlaceTable, TellsWhatCountingTells) {
    const std::string lines = "<a>\n\n  <ä x=\"€\"/>\r\n\xEF\xBB\xBF<b/>\n\xF0\x9F\x90\xA6";
    for (const std::string& text :
         {lines, std::string(kByteOrderMark) + lines, lines + "\n", std::string(), std::string("x")}) {
        const PlaceTable table(text);
        PlaceCounter counter(text);
        const std::size_t first = text.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0;
        for (std::size_t at = first; at <= text.size(); ++at) {
            if (at < text.size() && continues(text[at])) continue;
            const Place place = counter.at(at);
            EXPECT_EQ(table.place_of(at), place) << at;
            EXPECT_EQ(table.offset_of(place), at) << at;
        }
        EXPECT_EQ(table.place_of(text.size() + 1), std::nullopt);
        EXPECT_EQ(table.offset_of({counter.at(text.size()).line + 1, 1}), std::nullopt);
        EXPECT_EQ(table.offset_of({}), std::nullopt);
    }
    EXPECT_EQ(PlaceTable("ab\ncd").offset_of({1, 9}), 2U) << "the end of the line";
}

}  // namespace
}  // namespace popup::xml
