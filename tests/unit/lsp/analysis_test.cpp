// What is found after a change of a text, with all that is known of the text before, is what is found in it
// by who knows nothing.
#include "lsp/analysis.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cctype>
#include <map>
#include <string>

#include "output/xml.h"
#include "support/designs.h"
#include "support/proposals.h"
#include "support/sanitized.h"

namespace popup::lsp {
namespace {

std::string told(const Span& at) { return fmt::format("[{} {}]", at.begin, at.end); }

std::string told(const Analysis& analysis) {
    std::string text;
    for (const Finding& one : analysis.findings) {
        text += fmt::format("{} {} {}: {}", told(one.at), one.diagnostic.code, one.diagnostic.element,
                            one.diagnostic.message);
        for (const std::string& hint : one.diagnostic.hints) text += " hint " + hint;
        for (const FindingPlace& place : one.related) text += " with " + told(place.at) + place.text;
        for (const Fix& fix : one.fixes) {
            text += " fix " + fix.title;
            for (const TextEdit& edit : fix.edits) text += told(edit.at) + edit.text;
        }
        text += '\n';
    }
    return text;
}

// Tents that come near each other, over one another's tabs, and stick out.
Design crowded(test::Dice& random) {
    Design design = test::card(200, 240);
    for (int i = 0; i < 6; ++i) {
        const double out = random.uniform(12.0, 40.0);
        test::add_tent(design, random.uniform(-100.0, 100.0), random.uniform(5.0, 20.0), out,
                       out + random.uniform(0.0, 12.0));
    }
    return design;
}

// Another digit, a structure more or less, a comment, a broken tag: what typing does.
void type(std::string& text, test::Dice& random) {
    const std::string end = "</structure>";
    const std::size_t first = text.find("<structure ");
    const std::size_t at = first == std::string::npos ? std::string::npos : text.find(end, first);
    switch (at == std::string::npos ? 4 : random.below(6)) {
        case 0:
            text.erase(first, at + end.size() - first);
            return;
        case 1:
            text.insert(at + end.size(), "\n<!-- popupc: allow glue-overlaps -->");
            return;
        case 2:
            text.insert(at + end.size(), text.substr(first, at + end.size() - first));
            return;
        default:
            break;
    }
    std::size_t digit = text.find("<point ");
    if (digit == std::string::npos) return;
    digit += random.below(text.size() - digit);
    while (digit < text.size() && std::isdigit(static_cast<unsigned char>(text[digit])) == 0) ++digit;
    if (digit < text.size()) text[digit] = static_cast<char>('0' + random.below(10));
}

TEST(Analysis, AfterEachChangeIsThatOfWhoKnowsNothing) {
    const auto seeds = test::sanitized_count<std::uint64_t>(6, 3);
    std::map<std::string, int> codes;
    int remembered = 0;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        test::Dice random{seed * 389};
        std::string text = write_document(seed % 2 == 0 ? crowded(random) : test::generate(seed, 8));
        std::string good = text;
        ExaminationMemory memory;
        const AnalysisOptions fresh{{}, {}, find_language({}, "xml")};
        AnalysisOptions kept = fresh;
        kept.compile.motion.memory = &memory;
        for (int step = 0; step < 12; ++step) {
            SCOPED_TRACE(fmt::format("seed {} step {}", seed, step));
            const Source source{"card.xml", text};
            const Analysis checked = analyse(source, fresh, Depth::check);
            const Analysis whole = analyse(source, kept, Depth::whole, checked.stages);
            ASSERT_EQ(told(whole), told(analyse(source, fresh, Depth::whole))) << text;
            for (const Finding& one : whole.findings) ++codes[one.diagnostic.code];
            if (whole.examined && whole.examined->examined_pairs < whole.examined->pairs) ++remembered;
            // Behind an error nothing is looked at: it is mended before more is typed.
            if (checked.stages) good = text;
            text = good;
            type(text, random);
        }
    }
    EXPECT_GT(remembered, static_cast<int>(2 * seeds));
    if (test::kSanitized) return;  // half of the documents have not all of these
    for (const char* code : {"collision", "protrusion", "tab-too-small", "glue-overlaps", "unused-allow"})
        EXPECT_GT(codes[code], 0) << code;
}

// Nobody looks for the folds of a card twice: neither behind its check nor behind its motion.
TEST(Analysis, FindsTheFoldsOfACardOnce) {
    const AnalysisOptions options{{}, {}, find_language({}, "xml")};
    const Source source{"card.xml", write_document(test::generate(3, 8))};
    const Analysis checked = analyse(source, options, Depth::check);
    ASSERT_TRUE(checked.stages);
    const CardFolds* card = &checked.card->of(*checked.design);
    EXPECT_EQ(card->standing.size(), checked.design->structures.size());
    EXPECT_EQ(&checked.card->of(*checked.design), card);
    const Analysis whole = analyse(source, options, Depth::whole, checked.stages);
    EXPECT_EQ(&whole.card->of(*whole.design), card);
}

// A fix makes the move that the hint of elements in one place tells.
TEST(Analysis, OffersTheMoveThatPartsWhatLiesOnOneAnother) {
    Design design = test::card(200, 240);
    test::add_tent(design, 0, 15, 20, 25);
    test::add_tent(design, 10, 15, 20, 25);
    const AnalysisOptions options{{}, {}, find_language({}, "xml")};
    const Analysis whole = analyse({"card.xml", write_document(design)}, options, Depth::whole);
    int offered = 0;
    for (const Finding& one : whole.findings) {
        if (one.diagnostic.code != "lies-on-another") continue;
        ASSERT_EQ(one.fixes.size(), 1U) << one.diagnostic.message;
        EXPECT_TRUE(one.fixes[0].title.starts_with("Move \"")) << one.fixes[0].title;
        EXPECT_FALSE(one.fixes[0].edits.empty());
        ++offered;
    }
    EXPECT_EQ(offered, 1) << told(whole);
}

}  // namespace
}  // namespace popup::lsp
