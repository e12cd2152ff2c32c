// Pages of suggestions: what entries say, what is marked in their pictures, and what the files are made of.
#include "output/book/suggestions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/nth.h"
#include "output/book/book.h"
#include "output/book/scene.h"
#include "popup/crease_pattern.h"
#include "popup/refinement.h"

namespace popup {
namespace {

constexpr double kSide = 60.0;

// A tray whose walls are as long as its ground, and of which each has a triangle on it: four corners that
// should meet over the middle.
struct Gift {
    Gift() {
        CreasePattern pattern;
        pattern.stem = "gift";
        const double s = kSide;
        const double tip = 42.0;
        const auto turned = [s](Vec2 p, int quarter) {
            for (int i = 0; i < quarter; ++i) p = {s - p.y, p.x};
            return p;
        };
        for (int i = 0; i < 4; ++i) {
            const auto line = [&](std::vector<Vec2> points, CreaseUse use) {
                for (Vec2& p : points) p = turned(p, i);
                CreaseLine made;
                made.points = std::move(points);
                made.use = use;
                pattern.lines.push_back(std::move(made));
            };
            line({{0, 0}, {0, -s}, {s / 2, -s - tip}, {s, -s}, {s, 0}}, CreaseUse::cut);
            line({{0, 0}, {s, 0}}, CreaseUse::valley);
            line({{0, -s}, {s, -s}}, CreaseUse::valley);
        }
        Diagnostics diagnostics;
        assembly = fold_sheet(pattern, {}, diagnostics);
        SuggestOptions options;
        options.near_mm = 40.0;
        found = suggest_joins(pattern, options, diagnostics);
        card.assembly = &*assembly;
    }
    [[nodiscard]] book::SuggestionsOf of() const { return {*found, card, {}, "gift <1>"}; }

    std::optional<Assembly> assembly;
    std::optional<Suggestions> found;
    SceneCard card;
};

TEST(Suggestions, EachHasAnEntryThatSaysWhatItJoinsAndWhatItLeaves) {
    const Gift gift;
    ASSERT_EQ(gift.found->rows.size(), 1U);
    const book::Book book = book::book_of(gift.of());
    ASSERT_EQ(book.cards.size(), 1U);
    ASSERT_EQ(book.cards[0].chapters.size(), 1U);
    EXPECT_EQ(book.cards[0].chapters[0].title, "Corners to merge");
    ASSERT_EQ(book.cards[0].chapters[0].steps.size(), 1U);
    const book::Step& step = book.cards[0].chapters[0].steps[0];
    EXPECT_EQ(step.title, "merge 1");
    // Opposite tips reach 42 of 60 mm: they are 2 * 42 - 60 apart.
    EXPECT_EQ(step.lies, "24.0 mm apart; accepting it closes, turning a fold by 44°");
    ASSERT_EQ(step.actions.size(), 4U);
    EXPECT_TRUE(std::any_of(step.actions.begin(), step.actions.end(), [](const std::string& text) {
        return text.ends_with("the corner at (30.00, -102.00) mm");
    })) << step.actions[0];
}

TEST(Suggestions, PicturesMarkWhatIsJoinedAndNothingElse) {
    const Gift gift;
    const book::Book book = book::book_of(gift.of());
    const book::Scene& scene = book.cards[0].chapters[0].steps[0].scenes.at(0);
    std::set<std::string> marked, letters;
    for (const book::Scene::Marked& one : scene.marked) {
        const Plate& plate = nth(gift.assembly->plates, one.plate);
        marked.insert(plate.name);
        letters.insert(one.text);
        ASSERT_TRUE(one.corner);
        EXPECT_TRUE(std::any_of(plate.outline.outer.begin(), plate.outline.outer.end(),
                                [&](Vec2 p) { return distance(p, *one.corner) < 1e-6; }));
    }
    std::set<std::string> joined;
    for (const JoinPart& part : gift.found->rows[0].join.parts) joined.insert(part.panel);
    EXPECT_EQ(marked, joined);
    EXPECT_EQ(letters, (std::set<std::string>{"a", "b", "c", "d"}));
}

// A wall between the eye and a marked panel would hide it from everywhere: it is left out of the picture.
TEST(Suggestions, MarkedPanelsAreSeen) {
    const Gift gift;
    const auto& plates = gift.assembly->plates;
    const auto ground = std::find_if(plates.begin(), plates.end(), [](const Plate& plate) {
        return contains(plate.outline, {kSide / 2, kSide / 2});
    });
    ASSERT_NE(ground, plates.end());
    book::Scene scene;
    scene.opening_deg = 0.0;
    scene.marked.push_back({static_cast<int>(ground - plates.begin()), "a", {}});
    book::Illustrator illustrator({&gift.card, 1}, false);
    Diagnostics diagnostics;
    const auto pictures = illustrator.draw({&scene, 1}, {240, 180}, diagnostics);
    ASSERT_TRUE(pictures);
    const Pixels& pixels = pictures->front().pixels;
    int orange = 0;
    for (std::size_t i = 0; i + 2 < pixels.rgb.size(); i += 3) {
        if (pixels.rgb[i] > pixels.rgb[i + 2] + 60) ++orange;
    }
    EXPECT_GT(orange, 240 * 180 / 50);
}

TEST(Suggestions, PageHasNoScriptAndLoadsNothing) {
    const Gift gift;
    Diagnostics diagnostics;
    const auto html = book::suggestions_html(gift.of(), diagnostics);
    ASSERT_TRUE(html);
    EXPECT_EQ(html->find("<script"), std::string::npos);
    EXPECT_NE(html->find("default-src 'none'; style-src 'sha256-"), std::string::npos);
    EXPECT_NE(html->find("<title>gift &lt;1&gt;: suggestions</title>"), std::string::npos);
    EXPECT_EQ(html->find("What is needed"), std::string::npos);
    EXPECT_EQ(html->find("://"), std::string::npos);
    EXPECT_EQ(html, book::suggestions_html(gift.of(), diagnostics));
}

TEST(Suggestions, PdfHasAPictureOfEach) {
    const Gift gift;
    Diagnostics diagnostics;
    const auto pdf = book::suggestions_pdf(gift.of(), diagnostics);
    ASSERT_TRUE(pdf);
    std::size_t pictures = 0;
    for (std::size_t at = pdf->find("/DCTDecode"); at != std::string::npos;
         at = pdf->find("/DCTDecode", at + 1))
        ++pictures;
    EXPECT_EQ(pictures, 2U);  // the cover, and that of the suggestion
}

}  // namespace
}  // namespace popup
