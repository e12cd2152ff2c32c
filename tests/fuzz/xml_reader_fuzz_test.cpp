// The reader against documents that nobody would write. Seeded, so that a failure comes again.
//
// Whatever the bytes, reading ends, crashes nothing, and says what is wrong where it stands; and whatever is
// read patches to itself and survives being written and read.
#include <gtest/gtest.h>
#include <tinyxml2.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "output/xml.h"
#include "popup/diagnostics.h"
#include "popup/files.h"
#include "popup/language.h"
#include "support/random.h"
#include "support/sanitized.h"

namespace popup {
namespace {

using test::Random;

const std::array<std::string, 3> kSeeds{
    R"(<?xml version="1.0" encoding="UTF-8"?>
<popup version="2.0" units="in">
  <mainpage width="11" height="8.5"><leftcolor>#ffffff</leftcolor></mainpage>
  <!-- structures -->
  <structurelist>
    <structure type="beak" id="bird">
      <outerpoints><point x="0" y="1.5"/><point x="-1.25" y="0.5" page="0"/><point>1.25,0.5</point></outerpoints>
      <leftcolor>255,204,0</leftcolor>
      <parentfold page="0"><begin x="0" y="-4.25"/><end x="0" y="4.25"/></parentfold>
    </structure>
  </structurelist>
  <drawnlinelist><drawnline page="0" thickness="2" color="blue">-3,-2 -2,-2.5</drawnline></drawnlinelist>
</popup>
)",
    "\xEF\xBB\xBF<Popup units='mm'>\r\n<?note?><structurelist><structure type='8'>"
    "<outerpoints>-20,10 -20,-10 <!--x--> 20,10 20,-10\r\n-40,10 -40,-10 40,10 40,-10</outerpoints>"
    "<left_tab_color><![CDATA[-65536]]></left_tab_color><parentfold begin='0,-9' end='0,&#57;'/></structure>"
    "</structurelist></Popup>",
    "<popup><version>3.0</version><units value='cm'/><structurelist><structure><type>2</type><id>a</id>"
    "<point><x>0</x><y>1</y></point><point value='-1,0'/><point y='0'><x> 1 </x></point>"
    "<parentfold><page>0</page><begin>0,-4</begin><end>0,4</end></parentfold></structure></structurelist></"
    "popup>",
};

constexpr std::array<std::string_view, 44> kPieces{"<",         ">",
                                                   "/>",        "</",
                                                   "\"",        "'",
                                                   "=",         "&",
                                                   "&amp;",     "&#49;",
                                                   "&#0;",      "&lol;",
                                                   "<!--",      "-->",
                                                   "<![CDATA[", "]]>",
                                                   "<?",        "?>",
                                                   "<!DOCTYPE", "\0",
                                                   "\xC3\xA4",  "\xFF",
                                                   "\r\n",      "\n",
                                                   " ",         "nan",
                                                   "1e308",     "-",
                                                   ",",         "0x1",
                                                   "1e-9",      "page=\"1\"",
                                                   "<point/>",  "<x>1</x>",
                                                   "</popup>",  "<a>",
                                                   "</a>",      "<structure>",
                                                   "id='bird'", "<point x='1' y='2'/>",
                                                   "type='99'", "\xEF\xBB\xBF",
                                                   "<popup>",   "999999999"};

std::string mutated(const std::string& seed, Random& random) {
    std::string text = seed;
    const std::size_t changes = 1 + random.below(4);
    for (std::size_t i = 0; i < changes; ++i) {
        const std::size_t at = random.below(text.size() + 1);
        const std::size_t length = std::min(random.below(12), text.size() - at);
        switch (random.below(6)) {
            case 0:
                text.erase(at, length);
                break;
            case 1:
                text.insert(at, kPieces[random.below(kPieces.size())]);
                break;
            case 2:
                if (at < text.size()) text[at] = static_cast<char>(random.below(256));
                break;
            case 3:
                text.insert(random.below(text.size() + 1), text.substr(at, random.below(80)));
                break;
            case 4:
                text.resize(at);
                break;
            default:
                text.replace(at, length, kPieces[random.below(kPieces.size())]);
                break;
        }
    }
    return text;
}

// Changes that mostly leave a document what it is: other digits, and things between tags that mean nothing.
std::string mutated_gently(const std::string& seed, Random& random) {
    constexpr std::array<std::string_view, 8> kBetween{" ",  "\r\n",    "<!-- 1,2 -->", "<?p 1?>",
                                                       "\t", "<!---->", "\n\n",         "<a/>"};
    constexpr std::array<std::string_view, 8> kDigits{"0", "7", "12", "&#53;", "&#x39;", "1.", "3e-1", ".25"};
    std::string text = seed;
    const std::size_t changes = 1 + random.below(8);
    for (std::size_t i = 0; i < changes; ++i) {
        const bool between = random.below(2) == 0;
        const std::size_t at = text.find_first_of(between ? ">" : "0123456789", random.below(text.size()));
        if (at == std::string::npos) continue;
        if (between) {
            text.insert(at + 1, kBetween[random.below(kBetween.size())]);
        } else {
            text.replace(at, 1, kDigits[random.below(kDigits.size())]);
        }
    }
    return text;
}

// True when tinyxml2 takes the whole text as one document.
bool well_formed(const std::string& text) {
    tinyxml2::XMLDocument document;
    return document.Parse(text.data(), text.size()) == tinyxml2::XML_SUCCESS &&
           document.RootElement() != nullptr;
}

void check_one(const std::string& text, std::size_t& read) {
    Diagnostics diagnostics("fuzz.xml");
    const Source source{"fuzz.xml", text};
    const auto design = read_design(source, {}, diagnostics);
    ASSERT_EQ(design.has_value(), !diagnostics.has_errors());
    const auto lines = static_cast<int>(std::count(text.begin(), text.end(), '\n')) + 1;
    for (const Diagnostic& d : diagnostics.sorted()) {
        ASSERT_FALSE(d.message.empty());
        ASSERT_LE(d.place.line, lines);
        ASSERT_TRUE(d.place.line >= 1 || d.code == "empty-input") << d.code;
        ASSERT_EQ(d.place.line >= 1, d.place.column >= 1);
    }
    if (!design) return;
    ++read;
    const Language& xml = language_table().front();
    ASSERT_EQ(xml.patch(source, *design), text);

    // Moved points land where they should, and nowhere else.
    Design moved = *design;
    for (Structure& structure : moved.structures) {
        for (DesignPoint& point : structure.points) {
            point.at = point.at + Vec2{moved.unit.mm, -2 * moved.unit.mm};
            point.changed = true;
        }
    }
    Diagnostics again_diagnostics("fuzz.xml");
    const auto again = read_design(Source{"fuzz.xml", xml.patch(source, moved)}, {}, again_diagnostics);
    if (!again) {
        // Only for having left the world.
        for (const Diagnostic& d : again_diagnostics.sorted()) {
            if (d.severity != Severity::error) continue;
            ASSERT_EQ(d.code, "bad-number") << d.message;
        }
    } else {
        ASSERT_EQ(again->structures.size(), moved.structures.size());
        for (std::size_t i = 0; i < moved.structures.size(); ++i) {
            for (std::size_t j = 0; j < moved.structures[i].points.size(); ++j) {
                const Vec2 want = moved.structures[i].points[j].at;
                const Vec2 got = again->structures[i].points[j].at;
                ASSERT_LE(distance(want, got), 1e-6 * moved.unit.mm + 1e-12 * length(want));
            }
        }
    }

    Diagnostics written_diagnostics("fuzz.xml");
    const std::string written = write_document(*design);
    ASSERT_TRUE(well_formed(written));
    const auto rewritten = read_design(Source{"fuzz.xml", written}, {true, {}, {}}, written_diagnostics);
    ASSERT_TRUE(rewritten);
    ASSERT_EQ(write_document(*rewritten), written);
}

void fuzz(std::uint64_t seed, int rounds) {
    Random random(seed);
    std::size_t read = 0;
    for (int i = 0; i < rounds; ++i) {
        const std::string& start = kSeeds[random.below(kSeeds.size())];
        const std::string text = i % 2 == 0 ? mutated(start, random) : mutated_gently(start, random);
        check_one(text, read);
        if (testing::Test::HasFatalFailure()) {
            ADD_FAILURE() << "seed " << seed << ", round " << i << ":\n" << text;
            return;
        }
    }
    // Refused documents test only half of the reader.
    EXPECT_GT(read, static_cast<std::size_t>(rounds) / 20);
}

TEST(XmlReaderFuzz, SeedsThemselvesAreRead) {
    for (const std::string& text : kSeeds) {
        std::size_t read = 0;
        check_one(text, read);
        EXPECT_EQ(read, 1U) << text;
        EXPECT_TRUE(well_formed(text) || text.find("<?note") != std::string::npos);
    }
}

TEST(XmlReaderFuzz, EveryTruncationIsRefusedOrRead) {
    for (const std::string& text : kSeeds) {
        std::size_t read = 0;
        for (std::size_t length = 0; length < text.size(); ++length) check_one(text.substr(0, length), read);
        // Only blanks behind the root may be missing.
        EXPECT_LE(read, 1U);
    }
}

TEST(XmlReaderFuzz, MutatedDocuments) { fuzz(1, test::sanitized_count(20'000)); }

TEST(LongXmlReaderFuzz, ManyMutatedDocuments) {
    for (std::uint64_t seed = 2; seed < 60; ++seed) fuzz(seed, 20'000);
}

}  // namespace
}  // namespace popup
