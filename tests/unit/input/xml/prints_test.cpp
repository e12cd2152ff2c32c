// Pictures, texts and areas of documents: every spelling gives the same design, everything keeps its place,
// and no file is read but those below the document's folder.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "input/xml/read.h"
#include "output/xml.h"
#include "popup/check.h"
#include "popup/image.h"
#include "support/designs.h"
#include "support/pictures.h"
#include "support/run_program.h"

namespace popup::test {
namespace {

namespace fs = std::filesystem;

std::string document(const std::string& prints, const std::string& structures = "") {
    return "<popup version='3.0' units='cm'>\n<mainpage width='20' height='15'/>\n<structurelist>" +
           structures + "</structurelist>\n<drawnlinelist>\n" + prints + "\n</drawnlinelist>\n</popup>\n";
}

struct Outcome {
    Reading reading;
    std::string text;
    [[nodiscard]] const Design& design() const { return *reading.design; }
};

// With a folder of one picture, sea.png, of 40 × 20 pixels.
Outcome read(const std::string& prints) {
    Outcome outcome;
    Diagnostics diagnostics;
    ReadOptions options;
    options.program.read_file = [](const std::string& name) -> std::optional<Source> {
        if (name != "cards/sea.png" && name != "cards/a/sea.png") return std::nullopt;
        return Source{name, png_of(40, 20)};
    };
    outcome.reading = xml::read_document({"cards/card.xml", document(prints)}, options, diagnostics);
    outcome.text = findings(diagnostics);
    return outcome;
}

// As any XML parser has it: what stands between the pieces of a text adds nothing to it.
TEST(Prints, ATextInPiecesIsOneText) {
    const Outcome outcome = read(
        "<text x='0' y='0'>Caf<![CDATA[\u00e9]]>s<!-- plural --> &amp;<![CDATA[ ]]>Bar\n "
        "<height>1</height></text>");
    ASSERT_TRUE(outcome.reading.design) << outcome.text;
    ASSERT_EQ(outcome.design().prints.size(), 1U);
    EXPECT_EQ(std::get<DrawnText>(outcome.design().prints[0].what).text, "Caf\u00e9s & Bar");
}

TEST(Prints, AnImageIsReadWithAllItsValues) {
    const Outcome outcome = read(
        "<image page='0' href='sea.png' x='1' y='-2' width='4' height='3' rotate='30' fit='cover' "
        "horizon='0.25' horizonheight='1.5'/>");
    ASSERT_TRUE(outcome.reading.design) << outcome.text;
    EXPECT_EQ(outcome.text, "");
    ASSERT_EQ(outcome.design().prints.size(), 1U);
    const DrawnPrint& print = outcome.design().prints[0];
    EXPECT_EQ(print.place.line, 5);
    EXPECT_EQ(print.at.at, (Vec2{10.0, -20.0}));
    EXPECT_EQ(print.rotate_deg, 30.0);
    const auto& image = std::get<DrawnImage>(print.what);
    EXPECT_EQ(image.href, "sea.png");
    EXPECT_EQ(image.width_mm, 40.0);
    EXPECT_EQ(image.height_mm, 30.0);
    EXPECT_EQ(image.fit, PictureFit::cover);
    EXPECT_EQ(image.horizon, 0.25);
    EXPECT_EQ(image.horizon_mm, 15.0);
    EXPECT_EQ(image.picture.width, 40);
    EXPECT_EQ(image.picture.height, 20);
    EXPECT_EQ(outcome.reading.files, std::vector<std::string>{"cards/sea.png"});
}

TEST(Prints, EverySpellingGivesTheSame) {
    const std::string canonical = write_document(read("<image href='sea.png' x='1' y='2' width='4'/>"
                                                      "<text x='0' y='1' height='0.5' font='serif-bold' "
                                                      "fill='#ff0000'>Ahoy, you</text>"
                                                      "<area d='M 0 0 H 2 V 1 Z' fill='#0000ff'/>")
                                                     .design());
    for (const std::string other :
         {"<Picture SRC='sea.png' x='1' y='2' width='4'/><caption x='0' y='1' height='0.5' "
          "font-family='Serif-Bold' "
          "colour='red'>\n  Ahoy,\n  you </caption><region fill_color='blue' d='M 0 0 H 2 V 1 Z'/>",
          "<img><file>sea.png</file><x>1</x><y value='2'/><width> 4 </width><height>2</height></img>"
          "<text value='Ahoy, you' "
          "fill='255,0,0'><x>0</x><y>1</y><height>0.5</height><font>serif-bold</font></text>"
          "<area page='0'><d>M 0 0 H 2 V 1 Z</d><color>#00f</color></area>"}) {
        const Outcome outcome = read(other);
        ASSERT_TRUE(outcome.reading.design) << outcome.text;
        EXPECT_EQ(outcome.text, "");
        EXPECT_EQ(write_document(outcome.design()), canonical);
    }
}

TEST(Prints, OneSideOfAnImageFollowsFromThePicture) {
    const Outcome wide = read("<image href='sea.png' x='0' y='0' width='4'/>");
    EXPECT_EQ(std::get<DrawnImage>(wide.design().prints[0].what).height_mm, 20.0);
    const Outcome high = read("<image href='sea.png' x='0' y='0' height='4'/>");
    EXPECT_EQ(std::get<DrawnImage>(high.design().prints[0].what).width_mm, 80.0);
}

TEST(Prints, AFileIsReadAndDecodedOnce) {
    std::string prints;
    for (int i = 0; i < 10; ++i)
        prints += std::string("<image href='") + (i % 2 == 0 ? "sea.png" : "./x/../sea.png") +
                  "' x='0' y='0' width='4'/>";
    const Outcome outcome = read(prints);
    ASSERT_TRUE(outcome.reading.design) << outcome.text;
    EXPECT_EQ(outcome.reading.files, std::vector<std::string>{"cards/sea.png"});
    const auto bytes = std::get<DrawnImage>(outcome.design().prints[0].what).picture.bytes;
    for (const DrawnPrint& print : outcome.design().prints)
        EXPECT_EQ(std::get<DrawnImage>(print.what).picture.bytes, bytes) << "one copy of the file is shared";
}

TEST(Prints, WhatIsWrongIsToldWhereItStands) {
    const std::vector<std::pair<std::string, std::string>> table{
        {"<image href='sea.png' x='0' width='4'/>", "missing-value: this image has no y"},
        {"<image x='0' y='0' width='4'/>", "missing-value: this image has no href"},
        {"<image href='sea.png' x='0' y='0'/>", "missing-value: this image has no width and no height"},
        {"<image href='' x='0' y='0' width='4'/>", "missing-value: 'href' is empty"},
        {"<image href='sea.png' x='0' y='0' width='0'/>",
         "bad-number: width is 0 mm, and must be above 0 and at most 10000 mm"},
        {"<image href='sea.png' x='0' y='0' width='1001'/>",
         "bad-number: width is 10010 mm, and must be above 0 and at most 10000 mm"},
        {"<image href='sea.png' x='0' y='0' height='900'/>",
         "bad-number: by the sides of the picture its width is 18000 mm, and must be at most 10000 mm"},
        {"<image href='sea.png' x='0' y='0' width='4' fit='tile'/>",
         "bad-choice: fit is 'tile', which is not one of its words"},
        {"<image href='sea.png' x='0' y='0' width='4' rotate='361'/>",
         "bad-number: rotate is 361, and must be from -360 to 360 degrees"},
        {"<image href='sea.png' x='0' y='0' width='4' horizon='1.5'/>",
         "bad-number: horizon is 1.5, and must be from 0 to 1"},
        {"<image href='sea.png' x='0' y='0' width='4' horizonheight='1'/>",
         "missing-value: this image has a horizonheight, and no horizon"},
        {"<text x='0' y='0'/>", "missing-value: 'text' is empty"},
        {"<text x='0' y='0'><!-- nothing --></text>", "missing-value: 'text' is empty"},
        {"<text x='0' y='0'> \n </text>", "missing-value: 'text' is empty"},
        {"<text x='0' y='0' font='comic'>a</text>",
         "bad-choice: font is 'comic', which is not one of its words"},
        {"<text x='0' y='0' height='-1'>a</text>",
         "bad-number: height is -10 mm, and must be above 0 and at most 10000 mm"},
        {"<text x='0' y='0'>" + std::string(2001, 'a') + "</text>",
         "document-too-large: this text has more than 2000 bytes"},
        {"<area fill='red'/>", "missing-value: this area has no d"},
        {"<area d='M 0 0 L 1 1'/>", "bad-path: the path data of this area encloses nothing"},
        {"<area d='M 0 0 H 2 V 1 Z' fill='rainbow'/>", "bad-color: fill is 'rainbow', which is not a colour"},
    };
    for (const auto& [prints, expected] : table) {
        const Outcome outcome = read(prints);
        EXPECT_FALSE(outcome.reading.design) << prints;
        EXPECT_NE(outcome.text.find("error " + expected), std::string::npos) << prints << "\n"
                                                                             << outcome.text;
    }
}

TEST(Prints, NamesThatComeBackIntoTheFolderAreLookedForThere) {
    const std::vector<std::pair<std::string, std::string>> table{
        {"sub/../sea.png", "cards/sea.png"}, {"./a/b/../../a/sea.png", "cards/a/sea.png"}};
    for (const auto& [href, wanted] : table) {
        std::string asked;
        Diagnostics diagnostics;
        ReadOptions options;
        options.program.read_file = [&asked](const std::string& name) -> std::optional<Source> {
            asked = name;
            return Source{name, png_of(4, 4)};
        };
        const Reading reading = xml::read_document(
            {"cards/card.xml", document("<image x='0' y='0' width='4' href='" + href + "'/>")}, options,
            diagnostics);
        EXPECT_TRUE(reading.design) << href;
        EXPECT_EQ(asked, wanted);
    }
}

TEST(Prints, NamesThatLeadOutAreNeverLookedFor) {
    for (const std::string href :
         {"/etc/hostname.png", "../sea.png", "a/../../sea.png", "a/b/./../../../sea.png",
          "a\\b/../../sea.png", "..\\sea.png", "\\\\host\\sea.png", "http://example.org/sea.png",
          "file:///etc/sea.png", "data:image/png;base64,AAAA", "C:\\sea.png", "c:sea.png", "HTTPS:x"}) {
        bool asked = false;
        Diagnostics diagnostics;
        ReadOptions options;
        options.program.read_file = [&asked](const std::string& name) -> std::optional<Source> {
            asked = true;
            return Source{name, png_of(4, 4)};
        };
        const Reading reading = xml::read_document(
            {"cards/card.xml", document("<image x='0' y='0' width='4' href='" + href + "'/>")}, options,
            diagnostics);
        EXPECT_FALSE(reading.design);
        EXPECT_FALSE(asked) << href;
        const auto all = diagnostics.sorted();
        ASSERT_EQ(all.size(), 1U);
        EXPECT_EQ(all[0].code, "picture-outside");
        EXPECT_EQ(all[0].place.line, 5);
        EXPECT_EQ(all[0].place.column, 30) << "the href, not the image";
    }
}

TEST(Prints, OfTheDiskNothingIsReadButRegularFilesBelowTheFolder) {
    const ScratchDirectory scratch;
    const fs::path folder = scratch / "cards";
    fs::create_directories(folder / "directory.png");
    write_file(scratch / "out.png", png_of(4, 4));
    fs::create_symlink(scratch / "out.png", folder / "link.png");
    fs::create_directory_symlink(scratch.path(), folder / "up");
    write_file(folder / "sea.png", png_of(40, 20));
    fs::create_symlink("sea.png", folder / "inside.png");
    fs::create_symlink("loop.png", folder / "loop.png");
    write_file(folder / "half.png", png_of(40, 20).substr(0, 60));
    write_file(folder / "half.jpg", jpeg_of(40, 20).substr(0, 400));
    write_file(folder / "cmyk.jpg", jpeg_of(16, 16, 4));
    write_file(folder / "text.png", "no picture");
    write_file(folder / "empty.png", "");
    // A header that promises 20000 × 20000 pixels.
    std::string large = png_of(4, 4);
    large.replace(16, 8, std::string("\0\0\x4e\x20\0\0\x4e\x20", 8));
    write_file(folder / "large.png", large);
    fs::create_symlink("/dev/zero", folder / "zero.png");
    fs::create_symlink("/dev/stdin", folder / "stdin.png");
    ASSERT_EQ(run({"mkfifo", folder / "pipe.png"}).exit, 0);
    const std::vector<std::pair<std::string, std::string>> table{
        {"sea.png", ""},
        {"inside.png", ""},
        {"link.png", "picture-outside"},
        {"up/out.png", "picture-outside"},
        {"zero.png", "picture-outside"},
        {"stdin.png", "picture-outside"},
        {"pipe.png", "picture-unreadable"},
        {"directory.png", "picture-unreadable"},
        {"loop.png", "picture-unreadable"},
        {"half.png", "picture-unreadable"},
        {"half.jpg", "picture-unreadable"},
        {"cmyk.jpg", "picture-unreadable"},
        {"text.png", "picture-unreadable"},
        {"empty.png", "picture-unreadable"},
        {"large.png", "picture-unreadable"},
        {"none.png", "picture-missing"},
        {"sea.png/none.png", "picture-missing"},
        {"Sea.png", "picture-missing"},
        {std::string(5000, 'a') + ".png", "picture-missing"},
    };
    for (const auto& [href, code] : table) {
        // A test may be started with nothing there.
        if (href == "stdin.png" && !fs::exists("/dev/stdin")) continue;
        Diagnostics diagnostics;
        const Source source{folder / "card.xml",
                            document("<image x='0' y='0' width='4' href='" + href + "'/>")};
        const Reading reading = xml::read_document(source, {}, diagnostics);
        EXPECT_EQ(reading.design.has_value(), code.empty()) << href;
        const auto all = diagnostics.sorted();
        EXPECT_EQ(all.empty() ? "" : all[0].code, code) << href << "\n" << findings(diagnostics);
        const std::string path = (folder / href).string();
        EXPECT_EQ(reading.missing,
                  code == "picture-missing" ? std::vector{path} : std::vector<std::string>{});
    }
}

TEST(Prints, BelongToVersionThree) {
    Diagnostics diagnostics;
    const Reading reading = xml::read_document(
        {"card.xml",
         "<popup units='mm'><drawnlinelist><text x='0' y='0'>a</text><text x='0' y='0'>b</text>"
         "</drawnlinelist></popup>"},
        {}, diagnostics);
    ASSERT_TRUE(reading.design);
    EXPECT_EQ(findings(diagnostics), "warning newer-element: 'text' is not an element of version 2.0\n");
    EXPECT_NE(write_document(*reading.design).find("version=\"3.0\""), std::string::npos);
}

TEST(Prints, WhatIsWrittenIsReadAgain) {
    const Outcome outcome = read(
        "<image page='0' href='a/sea.png' x='1' y='-2' width='4' height='3' rotate='-30.5' fit='contain' "
        "horizon='0.25' horizonheight='1.5'/><text x='0' y='1' rotate='90'>&lt;Ahoy&gt; &amp; \"so\" "
        "on</text>"
        "<area d='M 0 0 C 1 1 2 1 2 0 Z' fill='#123456'/>");
    ASSERT_TRUE(outcome.reading.design) << outcome.text;
    const std::string text = write_document(outcome.design());
    EXPECT_NE(text.find("&lt;Ahoy&gt; &amp; &quot;so&quot; on"), std::string::npos) << text;
    Diagnostics diagnostics;
    ReadOptions options;
    options.program.read_file = [](const std::string& name) -> std::optional<Source> {
        return Source{name, png_of(40, 20)};
    };
    const auto again = xml::read({"cards/card.xml", text}, options, diagnostics);
    ASSERT_TRUE(again) << findings(diagnostics) << text;
    EXPECT_EQ(write_document(*again), text);
    EXPECT_EQ(again->prints[0].rotate_deg, -30.5);
}

}  // namespace
}  // namespace popup::test
