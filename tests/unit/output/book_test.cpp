// The assembly book: its words on known cards, what readers of PDF and HTML find in it, and its pictures.
#include "output/book/book.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <regex>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/nth.h"
#include "base/system/digest.h"
#include "base/text/base64.h"
#include "output/book/pictures.h"
#include "popup/compile.h"
#include "popup/write.h"
#include "support/designs.h"
#include "support/made_book.h"
#include "support/run_program.h"
#include "support/viewer_page.h"

namespace popup {
namespace {

using Lines = std::vector<std::string>;
using test::between;
using Made = test::MadeBook;
using test::need;
using test::sample_source;
using test::step_named;
using test::titles;

// Of a document of a card of 200 × 140 mm.
Made card_of(const std::string& structures) {
    Source source;
    source.name = "card.xml";
    source.text = R"(<popup version="3.0" units="mm"><mainpage width="200" height="140"/><structurelist>)" +
                  structures + "</structurelist></popup>";
    std::vector<Source> sources;
    sources.push_back(std::move(source));
    Made made;
    made.make(std::move(sources), {});
    return made;
}

std::string written(const Made& run, const std::string& format, const OutputOptions& options = {}) {
    Diagnostics diagnostics("book");
    const auto write = std::get<PageWriter>(find_format("a" + format)->write);
    const auto bytes = write(run.page(), options, diagnostics);
    EXPECT_TRUE(bytes) << test::findings(diagnostics);
    return bytes.value_or("");
}

std::size_t count_of(const std::string& text, const std::string& what) {
    std::size_t count = 0;
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++count;
    return count;
}

TEST(Book, HasTheStepsOfAHouse) {
    const book::Book book = Made({"house.xml"}).made();
    EXPECT_EQ(titles(book),
              (Lines{"Fold", "  Step 1: crease page", "Sub-assembly: 2. roof", "  Step 2: crease 2. roof",
                     "  Step 3: glue on 3. chimney", "Glue on page", "  Step 4: glue on 6. tree-behind",
                     "  Step 5: glue on 1. front", "  Step 6: glue on 2. roof",
                     "  Step 7: glue on 4. tree-left", "  Step 8: glue on 5. tree-right"}));
    EXPECT_FALSE(book.letter);
    EXPECT_EQ(book.cards.front().parts.size(), 7U);
    EXPECT_EQ(book.cards.front().parts[2].number, "2");
    EXPECT_EQ(book.cards.front().parts[2].tabs, "2L, 2R");
}

TEST(Book, SaysWhatIsDoneInWords) {
    const book::Book house = Made({"house.xml"}).made();
    const book::Step& front = step_named(house, "Step 5: glue on 1. front");
    EXPECT_EQ(front.lies, "The card lies open on the table.");
    EXPECT_EQ(front.actions,
              (Lines{"Mountain fold between left and right: folded right over on the closed card, folded by "
                     "62° on the open card.",
                     "Put glue on tab 1L, and press it onto target 1L on the left part of page.",
                     "When that holds, fold the piece flat onto that side, so that tab 1R faces up. Put glue "
                     "on it, close "
                     "the card over it and press: the glue finds target 1R on the right part of page. Open "
                     "it again when "
                     "it holds."}));
    EXPECT_EQ(front.captions, (Lines{"before", "after"}));
    const book::Step& chimney = step_named(house, "Step 3: glue on 3. chimney");
    EXPECT_EQ(chimney.lies, "Piece 2. roof lies on the table, printed side up.");
    EXPECT_EQ(chimney.actions.back(),
              "Put glue on tab 3R, bend the piece until it lies on target 3R on the right part of "
              "roof, and hold until the glue does.");
    EXPECT_EQ(step_named(house, "Step 6: glue on 2. roof").notes,
              Lines{"It comes with what is glued on it: 3. chimney."});

    const book::Book cake = Made({"cake.xml"}).made();
    const book::Step& pillar = step_named(cake, "Step 12: glue on 2. low-top/pillar");
    EXPECT_EQ(pillar.notes, Lines{"Leave tab 2T free: 2. low-top comes on it later."});
    const book::Step& wall = step_named(cake, "Step 13: glue on 1. low-wall");
    EXPECT_EQ(wall.actions.at(wall.actions.size() - 3),
              "Bend the piece into a ring: put glue on tab 1B and press it behind the left part of "
              "low-wall, edge on edge. Press the ring flat while the glue sets.");
    const book::Step& top = step_named(cake, "Step 14: glue on 2. low-top");
    EXPECT_EQ(top.actions.at(1),
              "Put glue on tab 2T of 2. low-top/pillar, and let the top-left part of low-top down on it, "
              "so that the tab is under it, along the fold.");
}

// "Folded flat" would be read as folded right over.
TEST(Book, SaysOfAFoldThatIsStraightThatItIsNotFolded) {
    const book::Book book = card_of(R"(<structure type="box" id="b" height="20" ends="out"><outerpoints>
        <point x="-25" y="-20"/><point x="-25" y="20"/><point x="25" y="-20"/><point x="25" y="20"/>
        </outerpoints><parentfold on="gutter"/></structure>)")
                                .made();
    const Lines& actions = book.cards.front().chapters.back().steps.front().actions;
    EXPECT_TRUE(std::any_of(actions.begin(), actions.end(), [](const std::string& text) {
        return text.find(": not folded on the closed card, folded by 90° on the open card.") !=
               std::string::npos;
    }));
    for (const std::string& text : actions) EXPECT_EQ(text.find("folded flat"), std::string::npos) << text;
}

// Nothing is left of 1P: it lies on the target of 1L, as wide as both are.
const char* const kLowLayer = R"(<structure type="floating-layer" id="fl" height="10"><outerpoints>
        <point x="-6" y="-15"/><point x="-6" y="15"/><point x="6" y="-15"/><point x="6" y="15"/>
        </outerpoints><parentfold on="gutter"/></structure>)";

TEST(Book, TellsOfNoTabThatNoSheetHas) {
    const Made run = card_of(kLowLayer);
    const book::Book book = run.made();
    EXPECT_EQ(need(book, "To glue"), "3 tabs");
    for (const book::PartRow& part : book.cards.front().parts)
        EXPECT_EQ(part.tabs.find("1P"), std::string::npos) << part.tabs;
    std::size_t told = 0;
    for (const book::Chapter& chapter : book.cards.front().chapters) {
        for (const book::Step& step : chapter.steps) {
            for (const std::string& text : step.actions)
                EXPECT_EQ(text.find("1P"), std::string::npos) << text;
            for (const std::string& note : step.notes) {
                told += note ==
                        "No sheet has a tab 1P, for which there was no room: glue a strip of paper, folded "
                        "along its "
                        "middle, into that edge instead.";
            }
            for (const book::Scene& scene : step.scenes) {
                for (const Bond& bond : scene.bonds)
                    EXPECT_NE(
                        run.cards.front().assembly->glue.at(static_cast<std::size_t>(bond.number)).label,
                        "1P");
            }
        }
    }
    EXPECT_EQ(told, 1U);
}

TEST(Book, SaysWhatDoesNotStandUpByItself) {
    const std::string layer = R"(<structure type="layer" id="a"><outerpoints>
        <point x="-45" y="30"/><point x="-45" y="60"/><point x="45" y="30"/><point x="45" y="60"/>
        <point x="-45" y="25"/><point x="-45" y="55"/><point x="45" y="25"/><point x="45" y="55"/>
        </outerpoints><parentfold on="gutter"/></structure>)";
    const std::string box = R"(<structure type="box" id="b" height="20"><outerpoints>
        <point x="-25" y="-60"/><point x="-25" y="-30"/><point x="25" y="-60"/><point x="25" y="-30"/>
        </outerpoints><parentfold on="gutter"/></structure>)";
    const std::string glue =
        "Let the glue dry with the card closed, under a book. Then open it slowly, to 180°";
    const std::string push =
        "Nothing forces fl to stand: it can lean to one side while the card stands still. Set it upright "
        "with a finger when the card is open, and see before it closes that it leans the way that its folds "
        "go.";
    const auto opens = [](const std::string& structures) {
        return card_of(structures).made().cards.front().opens;
    };
    EXPECT_EQ(opens(box),
              Lines{glue + ": everything stands up by itself, and lies flat again when it closes."});
    EXPECT_EQ(
        opens(layer),
        Lines{glue + ": a rises on the way, and lies flat when it is wide open and when it is closed."});
    EXPECT_EQ(opens(kLowLayer), (Lines{glue + ".", push}));
    EXPECT_EQ(
        opens(box + layer + kLowLayer),
        (Lines{glue + ": b stands up by itself, and lies flat again when it closes; a rises on the way, "
                      "and lies flat when it is wide open and when it is closed.",
               push}));
}

TEST(Book, OfOneSheetIsPushedOutByLevels) {
    const book::Book book = Made({"castle.xml"}).made();
    EXPECT_EQ(titles(book),
              (Lines{"Fold", "  Step 1: crease page",
                     "  Step 2: push out keep, south-wall, south-tower, north-wall and north-tower",
                     "  Step 3: push out turret, gatehouse, keep-gap-1, keep-gap-2 and 14 more",
                     "  Step 4: push out door, turret-gap-1, turret-gap-2, gatehouse-gap-1 and 3 more"}));
    for (const auto& [name, value] : book.needs) EXPECT_NE(name, "To glue") << value;
    for (const std::string& text : book.cards.front().opens) EXPECT_EQ(text.find("glue"), std::string::npos);
}

TEST(Book, OfACartonHasItsFoldsInOrder) {
    const book::Book book = Made({"folded/carton.svg"}).made();
    const std::string first = "Step 1: fold up panels glue-flap, right, back and left";
    const std::string last = "Step 5: fold up panels top-flap-front and top-flap-back";
    EXPECT_EQ(titles(book),
              (Lines{"Fold", "  " + first, "  Step 2: fold up panels bottom-flap-right and bottom-flap-left",
                     "  Step 3: fold up panels bottom-flap-front and bottom-flap-back",
                     "  Step 4: fold up panels top-flap-right and top-flap-left", "  " + last}));
    EXPECT_EQ(step_named(book, first).actions.back(),
              "Put glue on glue-flap, and press it onto the inside of left until it holds.");
    EXPECT_EQ(step_named(book, last).actions,
              Lines{"Valley folds, to 90°: between front | top-flap-front and back | top-flap-back."});
    EXPECT_EQ(need(book, "To glue"), "1 flap");
    EXPECT_NE(need(book, "Tools").find("glue that does not warp paper"), std::string::npos);
    EXPECT_EQ(book.cards.front().opens,
              Lines{"Folded, it looks like the last picture. glue-flap holds it together, glued; whether its "
                    "other flaps are glued or tucked, its drawing does not say."});
    EXPECT_EQ(book.cards.front().closing_title, "How it must look");
    // The panels' names are on the drawing.
    std::set<std::string> labels;
    for (const auto& label : step_named(book, last).figures.front().labels) labels.insert(label.text);
    EXPECT_EQ(labels.size(), 13U);
    EXPECT_TRUE(labels.contains("top-flap-left"));
}

// A sleeve has no flap but the one that is glued.
TEST(Book, OfASleeveTellsOfNoOtherFlaps) {
    const book::Book book = Made({"sleeve.dxf"}).made();
    EXPECT_EQ(book.cards.front().opens,
              Lines{"Folded, it looks like the last picture. glue-flap holds it together, glued."});
}

TEST(Book, TellsOfBacksRivetsAndWhatIsInTheWay) {
    const book::Book book = Made({"seasons.xml"}).made();
    const book::Step& first = step_named(book, "Step 3: glue on 4. leaf-3, 5. leaf-4, 6. leaf-5 and 3 more");
    EXPECT_EQ(first.lies, "Turn piece 1. tree over: its back is up.");
    EXPECT_EQ(
        first.actions.front(),
        "4. leaf-3: Glue the piece on the back of the left part of tree. These sheets do not mark area 4 "
        "there; it lies 20.3 to 34.7 mm away from the fold between left and right, and 37.2 to 44.4 mm "
        "below the upper end of it, as it is printed.");
    OutputOptions on_backs;
    on_backs.backs = true;
    const Made made({"seasons.xml"});
    const book::Book marked = book::make_book(made.page(), on_backs);
    EXPECT_EQ(step_named(marked, first.title).actions.front(),
              "4. leaf-3: Glue the piece on the back of the left part of tree, on area 4, which is marked "
              "there.");
    const auto tells_to_prick = [](const book::Book& one) {
        return std::any_of(one.first.begin(), one.first.end(), [](const std::string& text) {
            return text.find("prick the corners") != std::string::npos;
        });
    };
    EXPECT_TRUE(tells_to_prick(marked));
    EXPECT_FALSE(tells_to_prick(book));
    EXPECT_EQ(first.figures.size(), 6U);
    EXPECT_EQ(step_named(book, "Step 4: glue on 16. leaf-15, 17. leaf-16, 24. leaf-23 and 25. leaf-24")
                  .notes.front(),
              "Other pieces cover a part of area 16 already: glue over them.");
    const book::Step& disc = step_named(book, "Step 8: fasten season with a brad");
    EXPECT_EQ(disc.lies, "Turn the card over: it lies open, its back up.");
    EXPECT_EQ(
        disc.actions,
        Lines{"Lay the piece behind the right part of page, its printed side towards the window, the round "
              "holes "
              "over each other. Push a brad through both and bend its legs. The piece must turn freely: glue "
              "nothing here."});
}

TEST(Book, CountsWhatIsNeeded) {
    CompileOptions options;
    options.layout.copies = 2;
    const book::Book book = Made({"house.xml"}, options).made();
    EXPECT_EQ(need(book, "To glue"), "24 tabs");
    EXPECT_NE(need(Made({"seasons.xml"}, options).made(), "Tools").find("2 brads (paper fasteners)"),
              std::string::npos);
    EXPECT_NE(need(Made({"seasons.xml"}).made(), "Tools").find("1 brad (a paper fastener)"),
              std::string::npos);
    EXPECT_EQ(need(book, "Copies").substr(0, 34), "the sheets have 2 of each piece, a");
    EXPECT_EQ(need(book, "To fold"), "14 folds");
    EXPECT_NE(need(book, "Paper").find("letter (279.4 × 215.9 mm)"), std::string::npos)
        << need(book, "Paper");
}

// The first picture of a step has what is there and what comes; the second differs. What is new has its
// colours, what is there is washed out.
TEST(Book, PicturesShowWhatIsThere) {
    const Made run({"house.xml"});
    const book::Book book = run.made();
    const Assembly& in = *run.cards.front().assembly;
    const book::Step& step = step_named(book, "Step 5: glue on 1. front");
    ASSERT_EQ(step.scenes.size(), 2U);
    for (const book::Scene& scene : step.scenes) {
        for (std::size_t i = 0; i < in.plates.size(); ++i) {
            const std::string& piece = nth(in.pieces, in.plates[i].piece).name;
            const float fade = scene.fades[i];
            if (piece == "front") {
                EXPECT_EQ(fade, 0.0F);
            } else if (piece == "page" || piece == "tree-behind") {
                EXPECT_GT(fade, 0.3F) << piece;
            } else {
                EXPECT_LT(fade, 0.0F) << piece;
            }
        }
    }
    EXPECT_EQ(step.scenes[0].lifted.size(), 2U);
    EXPECT_TRUE(step.scenes[1].lifted.empty());
    Diagnostics diagnostics("book");
    book::Pictures pictures(run.cards, false, diagnostics);
    const auto shown = pictures.draw(step.scenes, book::kStepPicture);
    ASSERT_TRUE(shown);
    EXPECT_NE((*shown)[0].picture.pixels.rgb, (*shown)[1].picture.pixels.rgb);
    Lines marks;
    for (const book::PictureMark& mark : (*shown)[0].picture.marks) {
        marks.push_back(mark.text);
        EXPECT_TRUE(mark.x > 0.0 && mark.x < 1.0 && mark.y > 0.0 && mark.y < 1.0);
    }
    EXPECT_EQ(marks, (Lines{"1L", "1R"}));
    EXPECT_TRUE((*shown)[1].picture.marks.empty());
    // Its targets are orange before, and covered after.
    const auto orange = [&](std::size_t picture) {
        const std::vector<unsigned char>& rgb = (*shown)[picture].picture.pixels.rgb;
        std::size_t count = 0;
        for (std::size_t i = 0; i + 2 < rgb.size(); i += 3)
            count += rgb[i] > 200 && rgb[i + 1] > 110 && rgb[i + 2] < 70;
        return count;
    };
    EXPECT_GT(orange(0), 200U);
    EXPECT_LT(orange(1), 20U);
}

// A v-fold with a green plane on its right half, a red one on the back of its left half, and a crest on its
// fold.
const char* const kBird = R"(<structure type="v-fold" id="bird"><outerpoints>
        <point x="-30" y="5.752608"/><point x="0" y="-30"/><point x="30" y="5.752608"/>
        <point x="-40.418891" y="23.335857"/><point x="0" y="0"/><point x="40.418891" y="23.335857"/>
        <point x="30" y="50"/><point x="-30" y="50"/></outerpoints>
        <leftcolor>#88aaff</leftcolor><rightcolor>#88aaff</rightcolor><parentfold on="gutter"/></structure>
        <structure type="attached-plane" id="wing" side="front"><outerpoints>
        <point x="-11.545912" y="-2.333964"/><point x="-11.545912" y="15.666036"/>
        <point x="0" y="-9"/><point x="0" y="9"/></outerpoints><color>#008000</color>
        <outline d="M -6 -6 H 6 V 6 H -6 Z"/><parentplate on="bird.right"/></structure>
        <structure type="attached-plane" id="back" side="back"><outerpoints>
        <point x="11.545912" y="-2.333964"/><point x="11.545912" y="15.666036"/>
        <point x="0" y="-9"/><point x="0" y="9"/></outerpoints><color>#ff0000</color>
        <outline d="M -6 -6 H 6 V 6 H -6 Z"/><parentplate on="bird.left"/></structure>
        <structure type="v-fold" id="crest"><outerpoints>
        <point x="-8" y="9.534029"/><point x="0" y="0"/><point x="8" y="9.534029"/>
        <point x="-10.778371" y="6.222895"/><point x="0" y="0"/><point x="10.778371" y="6.222895"/>
        <point x="8" y="14"/><point x="-8" y="14"/></outerpoints><parentfold on="bird.centre"/></structure>)";

// How many pixels of a picture have more of one of red, green and blue than of the others, washed out or not.
std::size_t coloured(const book::ShownPicture& shown, std::size_t channel) {
    const std::vector<unsigned char>& rgb = shown.picture.pixels.rgb;
    constexpr int kMore = 5;
    std::size_t count = 0;
    for (std::size_t i = 0; i + 2 < rgb.size(); i += 3) {
        const int own = rgb[i + channel];
        count += own > rgb[i + (channel + 1) % 3] + kMore && own > rgb[i + (channel + 2) % 3] + kMore;
    }
    return count;
}

TEST(Book, PicturesOfABentSubAssemblyHaveItsFlatPiecesInTheirPlaces) {
    const Made run = card_of(kBird);
    const book::Book book = run.made();
    Diagnostics diagnostics("book");
    book::Pictures pictures(run.cards, false, diagnostics);
    constexpr std::size_t kRed = 0;
    constexpr std::size_t kGreen = 1;
    const auto drawn = [&](const std::string& title) {
        auto shown = pictures.draw(step_named(book, title).scenes, book::kStepPicture);
        POPUP_INVARIANT(shown.has_value());
        return std::move(*shown);
    };
    // While nothing stands on the piece, it lies as it is cut: turned over, and then its front up.
    const auto back = drawn("Step 3: glue on 3. back");
    EXPECT_GT(coloured(back[1], kRed), 2000U);
    const auto wing = drawn("Step 4: glue on 2. wing");
    EXPECT_GT(coloured(wing[1], kGreen), 2000U);
    EXPECT_EQ(coloured(wing[1], kRed), 0U);
    // The crest bends it: what is on its front stays there, and what is on its back.
    const auto crest = drawn("Step 5: glue on 4. crest");
    EXPECT_GT(coloured(crest[1], kGreen), 200U);
    EXPECT_EQ(coloured(crest[1], kRed), 0U);
}

class BookOfASample : public testing::TestWithParam<std::string> {};

TEST_P(BookOfASample, HasEveryPieceAndTabForReadersOfPdf) {
    if (!test::have_program("pdftotext")) GTEST_SKIP() << "there is no pdftotext";
    const Made run({GetParam()});
    const test::ScratchDirectory scratch;
    test::write_file(scratch / "a.book.pdf", written(run, ".book.pdf"));
    const test::RunResult text = test::run({"pdftotext", scratch / "a.book.pdf", "-"});
    ASSERT_EQ(text.exit, 0) << text.err;
    std::string said = text.out;
    said.erase(std::remove_if(said.begin(), said.end(), [](char c) { return c == ' ' || c == '\n'; }),
               said.end());
    const book::Book book = run.made();
    const Assembly& in = *run.cards.front().assembly;
    for (const Piece& piece : in.pieces) EXPECT_NE(said.find(piece.name), std::string::npos) << piece.name;
    for (const Glue& glue : in.glue) EXPECT_GE(count_of(said, glue.label), 2U) << glue.label;
    std::size_t steps = 0;
    for (const book::Chapter& chapter : book.cards.front().chapters) {
        for (const book::Step& step : chapter.steps) {
            ++steps;
            std::string title = step.title;
            title.erase(std::remove(title.begin(), title.end(), ' '), title.end());
            EXPECT_NE(said.find(title), std::string::npos) << title;
        }
    }
    EXPECT_EQ(count_of(text.out, "\nStep ") + (text.out.starts_with("Step ") ? 1U : 0U) +
                  count_of(text.out, "\fStep "),
              steps);
    const test::RunResult info = test::run({"pdfinfo", scratch / "a.book.pdf"});
    EXPECT_NE(info.out.find("595.276 x 841.89 pts (A4)"), std::string::npos) << info.out;
    const std::size_t pages = count_of(text.out, "\f");
    // What is to be known before is on one page.
    const std::size_t begin = said.find("Beforeyoubegin");
    ASSERT_NE(begin, std::string::npos);
    std::string last = book.first.back();
    last.erase(std::remove(last.begin(), last.end(), ' '), last.end());
    const std::size_t end = said.find(last, begin);
    ASSERT_NE(end, std::string::npos);
    EXPECT_EQ(said.substr(begin, end - begin).find('\f'), std::string::npos);
    EXPECT_NE(info.out.find(fmt::format("Pages:           {}\n", pages)), std::string::npos) << info.out;
    // No page without anything, and two steps on most.
    EXPECT_LE(pages, steps + 6);
    const test::RunResult fonts = test::run({"pdffonts", scratch / "a.book.pdf"});
    EXPECT_EQ(count_of(fonts.out, "DejaVuSans"), count_of(fonts.out, "yes yes yes")) << fonts.out;
    EXPECT_EQ(test::run({"qpdf", "--check", scratch / "a.book.pdf"}).exit, 0);
}

TEST_P(BookOfASample, IsTheSameEachTime) {
    const Made run({GetParam()});
    for (const char* format : {".book.pdf", ".book.html"}) {
        const std::string once = written(run, format);
        EXPECT_GT(once.size(), 10000U);
        EXPECT_EQ(sha256(once), sha256(written(Made({GetParam()}), format))) << format;
    }
}

TEST_P(BookOfASample, IsAPageWithoutScripts) {
    const std::string page = written(Made({GetParam()}), ".book.html");
    EXPECT_EQ(page.find("<script"), std::string::npos);
    EXPECT_EQ(page.find(" style="), std::string::npos);
    EXPECT_EQ(page.find("http"), page.find("http-equiv"));
    const std::string style = between(page, "<style>", "</style>");
    EXPECT_EQ(between(page, "<meta http-equiv=\"Content-Security-Policy\" content=\"", "\">"),
              "default-src 'none'; style-src 'sha256-" + base64(sha256_bytes(style)) +
                  "'; img-src data:; base-uri 'none'; form-action 'none'");
    EXPECT_EQ(count_of(page, "role=\"img\""), count_of(page, "role=\"img\" aria-label=\""));
    EXPECT_EQ(count_of(page, "aria-label=\"\""), 0U);
}

INSTANTIATE_TEST_SUITE_P(Samples, BookOfASample,
                         testing::Values("house.xml", "cake.xml", "castle.xml", "seasons.xml",
                                         "folded/carton.svg", "folded/map.fold", "villa.oa", "cascade.xml",
                                         "swallow.xml"),
                         [](const auto& info) {
                             std::string name = info.param;
                             for (char& c : name)
                                 c = std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
                             return name;
                         });

TEST(Book, HasAPartForEachCard) {
    const Made run({"house.xml", "whale.xml"});
    const book::Book book = run.made();
    EXPECT_EQ(book.title, "house and whale");
    ASSERT_EQ(book.cards.size(), 2U);
    EXPECT_EQ(book.cards[1].chapters.back().steps.back().title.substr(0, 7), "Step 4:");
    EXPECT_EQ(book.cover.size(), 2U);
    const std::string page = written(run, ".book.html");
    EXPECT_NE(page.find("whale: Pieces"), std::string::npos);
}

TEST(Book, IsOnLetterPaperWhereThatIsAskedFor) {
    CompileOptions options;
    fit_layout(options);
    EXPECT_FALSE(options.output.letter_pages.has_value());
    options.layout.sheet = {"tabloid", 0.0, 0.0};
    fit_layout(options);
    EXPECT_EQ(options.output.letter_pages, true);
    options.output.letter_pages.reset();
    options.layout.sheet = {"a3", 0.0, 0.0};
    fit_layout(options);
    EXPECT_EQ(options.output.letter_pages, false);
    const Made run({"house.xml"});
    RunPage page = run.page();
    page.inches = true;
    EXPECT_TRUE(book::make_book(page, {}).letter);
    EXPECT_FALSE(book::make_book(page, options.output).letter);
}

// Names are texts, whatever stands in them.
TEST(Book, NoNameOfADocumentBecomesMarkup) {
    const Made plain({"house.xml"});
    Assembly named = *plain.cards.front().assembly;
    const std::string hostile = "<b onclick='x'>&\"\xff\x01";
    for (Piece& piece : named.pieces) piece.name += hostile;
    for (Plate& plate : named.plates) plate.name += hostile;
    named.stem = hostile;
    SceneCard card = plain.cards.front();
    card.assembly = &named;
    Diagnostics diagnostics("book");
    const RunPage page{{&card, 1}, &*plain.run.layout, {}, false};
    const auto write = std::get<PageWriter>(find_format("a.book.html")->write);
    const auto html = write(page, {}, diagnostics);
    ASSERT_TRUE(html);
    EXPECT_EQ(html->find("<b "), std::string::npos);
    EXPECT_NE(html->find("&lt;b onclick"), std::string::npos);
    EXPECT_EQ(html->find('\x01'), std::string::npos);
    const auto pdf = std::get<PageWriter>(find_format("a.book.pdf")->write)(page, {}, diagnostics);
    EXPECT_TRUE(pdf) << test::findings(diagnostics);
}

TEST(Book, ABrowserHasNothingToSayOfIt) {
    if (!test::have_browser()) GTEST_SKIP() << test::kNoBrowser;
    const test::ScratchDirectory scratch;
    test::write_file(scratch / "a.html", written(Made({"house.xml"}), ".book.html"));
    const auto driven = test::drive(
        scratch, scratch / "a.html", "-",
        {"document.querySelectorAll('article').length", "document.querySelectorAll('image').length",
         "getComputedStyle(document.querySelector('article')).borderTopLeftRadius",
         "document.documentElement.scrollWidth <= innerWidth"});
    EXPECT_EQ(test::messages_of(driven), Lines{});
    EXPECT_EQ(driven.at("values")[0], 8);
    EXPECT_EQ(driven.at("values")[1], 16);
    EXPECT_EQ(driven.at("values")[2], "10px");  // the style is let in
    EXPECT_EQ(driven.at("values")[3], true);
}

// An assembly bears the name of the document that it was made from, and findings about it that of its own
// file.
TEST(Book, OfAnAssemblySaysWhatWasFound) {
    const test::ScratchDirectory scratch;
    const std::string card = std::string(POPUP_SOURCE_DIR) + "/tests/cases/collisions/apart.xml";
    const auto found_in = [&](const std::string& input, const std::string& name) {
        EXPECT_EQ(test::popupc({"build", input, "-o", scratch / name}).exit, 0);
        const std::string page = test::read_file(scratch / name);
        const std::size_t at = page.find("What popupc found");
        return at == std::string::npos ? std::string() : page.substr(at, page.find("</ul>", at) - at);
    };
    const std::string of_card = found_in(card, "card.book.html");
    EXPECT_NE(of_card.find("goes through"), std::string::npos) << of_card;
    test::write_file(scratch / "card.assembly.json", test::popupc({"build", card, "--emit", "assembly"}).out);
    EXPECT_EQ(found_in(scratch / "card.assembly.json", "read.book.html"), of_card);
}

}  // namespace
}  // namespace popup
