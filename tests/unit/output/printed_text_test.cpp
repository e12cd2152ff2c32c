// Texts that are printed in a colour of their own, in every format.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "output/mesh.h"
#include "output/text_outlines.h"
#include "popup/output.h"
#include "popup/pattern.h"
#include "support/designs.h"
#include "support/sheet_example.h"

namespace popup {
namespace {

using test::bytes_of;

// A card with "AHOY" across its gutter, red, in letters of 10 mm.
struct Card {
    Assembly assembly;
    std::optional<Layout> layout;

    explicit Card(TextFont font = TextFont::sans) {
        const test::Built built = test::build(test::card(120, 80));
        assembly = *built.assembly;
        assembly.pieces[0].prints.emplace_back(
            Text{"AHOY", {0.0, 10.0}, 10.0, 0.0, Color{0xd1, 0x49, 0x3a}, font});
        Diagnostics diagnostics;
        const auto pattern = make_pattern(assembly, {}, diagnostics);
        layout = lay_out({{"card.xml", "card", *pattern}}, {}, diagnostics);
    }
    [[nodiscard]] std::string file(std::string_view suffix, const OutputOptions& options = {}) const {
        Diagnostics diagnostics;
        const auto files =
            std::get<SheetWriter>(find_format(suffix)->write)(layout.value(), options, diagnostics);
        EXPECT_TRUE(files) << test::findings(diagnostics);
        return files ? bytes_of(files).at(0) : std::string();
    }
};

std::size_t count(const std::string& text, std::string_view part) {
    std::size_t found = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
    return found;
}

OutputOptions with_profile(std::string_view name) {
    OutputOptions options;
    options.profile = *find_profile(name);
    return options;
}

double area_of(const std::vector<MeshPart>& parts, Color color) {
    double sum = 0.0;
    for (const MeshPart& part : parts) {
        if (!(part.color == color) || !part.drawn) continue;
        for (std::size_t i = 0; i + 2 < part.indices.size(); i += 3) {
            const Vec2 a = part.points[part.indices[i]];
            sum += 0.5 * cross(part.points[part.indices[i + 1]] - a, part.points[part.indices[i + 2]] - a);
        }
    }
    return sum;
}

TEST(PrintedText, IsTextInItsColourAndFont) {
    const std::string svg = Card(TextFont::serif_bold).file(".svg");
    EXPECT_EQ(count(svg, ">AHOY</text>"), 1U) << "one text, though it lies on two plates";
    const std::size_t at = svg.rfind("<text", svg.find(">AHOY<"));
    const std::string tag = svg.substr(at, svg.find('>', at) - at);
    EXPECT_NE(tag.find("fill=\"#d1493a\""), std::string::npos) << tag;
    EXPECT_NE(tag.find("font-family=\"DejaVu Serif\" font-weight=\"bold\""), std::string::npos) << tag;
    EXPECT_NE(tag.find("text-anchor=\"middle\""), std::string::npos) << tag;
    // No other piece is there that a name would tell it from.
    EXPECT_EQ(count(svg, ">page</text>"), 0U);

    const std::string dxf = Card().file(".dxf");
    EXPECT_EQ(count(dxf, "AHOY"), 1U);
    EXPECT_NE(Card().file(".pdf"), Card(TextFont::serif).file(".pdf"));
    EXPECT_NE(Card().file(".png"), Card(TextFont::mono).file(".png"));
}

TEST(PrintedText, IsOutlinedWhereAMachineDrawsIt) {
    const OutputOptions cutter = with_profile("workshop");
    // A plotter has no letters: what is printed is drawn as its outlines, labels are left out as ever.
    Card card;
    const std::string with = card.file(".plt", cutter);
    card.layout->designs[0].pattern.pieces[0].prints.clear();
    const std::string without = card.file(".plt", cutter);
    // A, H, O (twice), Y and the hole of the A: six contours.
    const auto lines = [](const std::string& plot) { return count(plot, "PU") - count(plot, "PU;"); };
    EXPECT_EQ(lines(with) - lines(without), 6U);
    OutputOptions outlined = cutter;
    outlined.profile.outlined_text = true;
    const std::string svg = Card().file(".svg", outlined);
    EXPECT_EQ(count(svg, "AHOY"), 0U);
    EXPECT_NE(svg.find("stroke=\"none\" fill=\"#d1493a\""), std::string::npos);
}

// Else it would be printed on the piece that lies beside it on the sheet.
TEST(PrintedText, IsCutOffAtTheEdgeOfThePaper) {
    Card card;
    std::vector<PatternPrint>& prints = card.layout->designs[0].pattern.pieces[0].prints;
    for (PatternPrint& print : prints) {
        if (auto* text = std::get_if<Text>(&print.print)) text->at = {60.0, 10.0};  // on the right edge
    }
    const std::string svg = card.file(".svg");
    EXPECT_EQ(count(svg, "AHOY"), 0U);
    EXPECT_EQ(count(svg, "#d1493a"), 1U);
    for (PatternPrint& print : prints) {
        if (auto* text = std::get_if<Text>(&print.print)) text->at = {160.0, 10.0};
    }
    EXPECT_EQ(count(card.file(".svg"), "#d1493a"), 0U) << "it is off the paper";
}

TEST(PrintedText, IsOnTheFrontAlone) {
    OutputOptions backs;
    backs.backs = true;
    const Card card;
    Diagnostics diagnostics;
    const auto files =
        bytes_of(std::get<SheetWriter>(find_format(".svg")->write)(*card.layout, backs, diagnostics));
    ASSERT_EQ(files.size(), 2U);
    EXPECT_EQ(count(files[0], "AHOY"), 1U);
    EXPECT_EQ(count(files[1], "AHOY"), 0U);
}

// In models each plate shows its part of the letters, and together they are the letters.
TEST(PrintedText, IsOnEveryPlateOfAModelThatItLiesOn) {
    const Card card;
    const Color red{0xd1, 0x49, 0x3a};
    const double left =
        area_of(plate_mesh(card.assembly.plates[0], false, card.assembly.pieces[0].prints), red);
    const double right =
        area_of(plate_mesh(card.assembly.plates[1], false, card.assembly.pieces[0].prints), red);
    EXPECT_GT(left, 20.0);
    EXPECT_GT(right, 20.0);
    double letters = 0.0;
    for (const Ring& ring : text_outlines("AHOY", {0.0, 10.0}, 10.0, 0.0)) letters -= signed_area(ring);
    EXPECT_NEAR(left + right, letters, 1e-2 * letters);
    // Beside the plate there is nothing.
    std::vector<Print> beside{Text{"AHOY", {500.0, 10.0}, 10.0, 0.0, red}};
    EXPECT_EQ(area_of(plate_mesh(card.assembly.plates[0], false, beside), red), 0.0);
    // Labels are no part of the model.
    std::vector<Print> label{Text{"AHOY", {0.0, 10.0}, 10.0, 0.0}};
    EXPECT_EQ(plate_mesh(card.assembly.plates[0], false, label).size(),
              plate_mesh(card.assembly.plates[0], false).size());
}

TEST(PrintedText, EveryFontIsThereAndDiffers) {
    std::vector<std::vector<Ring>> seen;
    for (std::size_t i = 0; i < kTextFontNames.size(); ++i) {
        const auto font = static_cast<TextFont>(i);
        ASSERT_TRUE(can_outline_text(font)) << to_string(font);
        const std::vector<Ring> letters = text_outlines("Hg", {}, 10.0, 0.0, font);
        ASSERT_FALSE(letters.empty());
        EXPECT_EQ(std::count(seen.begin(), seen.end(), letters), 0) << to_string(font);
        // The capital is as high as is asked for, whatever the font.
        Box box;
        const std::vector<Ring> capital = text_outlines("H", {}, 10.0, 0.0, font);
        for (const Vec2 p : capital.front()) box.extend(p);
        EXPECT_NEAR(box.max.y - box.min.y, 10.0, 0.05) << to_string(font);
        seen.push_back(letters);
    }
}

}  // namespace
}  // namespace popup
