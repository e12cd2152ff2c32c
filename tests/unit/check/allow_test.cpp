// What a document allows is not told, and nothing else is kept back; what it need not allow is told.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <string>
#include <vector>

#include "popup/compile.h"
#include "support/designs.h"
#include "support/run_program.h"

namespace popup {
namespace {

const std::string kTwoTents =
    test::read_file(std::string(POPUP_SOURCE_DIR) + "/tests/cases/found/collide.xml");

// A cheaper finding: one tent that sticks out of the closed card.
const std::string kTower =
    test::read_file(std::string(POPUP_SOURCE_DIR) + "/tests/cases/found/sticks-out.xml");

// The document with `text` put in before the first `mark`.
std::string with(std::string document, const std::string& mark, const std::string& text) {
    const std::size_t at = document.find(mark);
    EXPECT_NE(at, std::string::npos) << mark;
    return document.insert(at, text);
}

std::string commented(const std::string& document, const std::string& mark, const std::string& comment) {
    return with(document, mark, "<!-- popupc: " + comment + " -->");
}
std::string commented(const std::string& mark, const std::string& comment) {
    return commented(kTower, mark, comment);
}

Diagnostics checked(const std::string& document, const DiagnosticPolicy& policy = {},
                    CompileOptions options = {}) {
    options.until = Stage::pattern;
    Diagnostics found = compile({Source{"card.xml", document}}, options, policy).designs.front().diagnostics;
    // Without its pattern the same is found.
    options.until = Stage::check;
    CompiledDesign further = compile({Source{"card.xml", document}}, options, policy).designs.front();
    find_further(further, options);
    EXPECT_EQ(test::findings(further.diagnostics), test::findings(found));
    EXPECT_FALSE(further.pattern.has_value());
    return found;
}

std::vector<std::string> codes(const Diagnostics& found) {
    std::vector<std::string> list;
    for (const Diagnostic& one : found.sorted()) list.push_back(one.code);
    return list;
}

using Codes = std::vector<std::string>;

TEST(Allow, AFindingIsDroppedWhereItsElementOrARelatedOneAllowsIt) {
    const std::string comment = "allow collision";
    const std::string back = "<structure type=\"tent\" id=\"back\"";
    ASSERT_EQ(codes(checked(kTwoTents)), Codes{"collision"});
    EXPECT_EQ(codes(checked(commented(kTwoTents, "<outerpoints>", comment))), Codes{});
    EXPECT_EQ(codes(checked(commented(kTwoTents, back, comment))), Codes{});
}

TEST(Allow, AnywhereElseACommentIsForTheWholeDocument) {
    ASSERT_EQ(codes(checked(kTower)), Codes{"protrusion"});
    for (const char* mark :
         {"<popup", "<mainpage", "<structurelist>", "<structure ", "</structurelist>", "</popup>"}) {
        EXPECT_EQ(codes(checked(commented(mark, "allow protrusion"))), Codes{}) << mark;
    }
    EXPECT_EQ(codes(checked(kTower + "<!-- popupc: allow protrusion -->")), Codes{});
    EXPECT_EQ(codes(checked("\xEF\xBB\xBF" + kTower + "<!--popupc:allow protrusion-->")), Codes{});
}

TEST(Allow, ReasonsAndSeparatorsAreAsTheyCome) {
    for (const char* comment :
         {"allow protrusion: why not, unknown-type", "allow  layer-order,protrusion , layer-order",
          "allow\nprotrusion\n", "allow protrusion:", "allow ,protrusion,"}) {
        const Codes found = codes(checked(commented("<mainpage", comment)));
        EXPECT_EQ(std::count(found.begin(), found.end(), "protrusion"), 0) << comment;
        EXPECT_EQ(std::count(found.begin(), found.end(), "bad-allow"), 0) << comment;
    }
}

TEST(Allow, OtherElementsGoOnBeingTold) {
    const std::string beak =
        "<structure type=\"beak\" id=\"fire\"><outerpoints><point x=\"0\" y=\"-50\"/><point x=\"-8\" "
        "y=\"-60\"/>"
        "<point x=\"8\" y=\"-60\"/></outerpoints><parentfold><begin x=\"0\" y=\"-70\"/><end x=\"0\" "
        "y=\"70\"/>"
        "</parentfold></structure>";
    const std::string inside =
        with(kTwoTents, "</structurelist>", with(beak, "<outerpoints>", "<!-- popupc: allow collision -->"));
    EXPECT_EQ(codes(checked(inside)), (Codes{"collision", "unused-allow"}));
    // A text between, or the end of the list, and it is not before an element.
    const std::string strict = with(kTwoTents, "</structurelist>", "<!-- popupc: allow collision -->");
    EXPECT_EQ(codes(checked(strict)), Codes{});
}

TEST(Allow, APolicyThatDeniesIsStrongerAndWerrorIsWeaker) {
    const std::string allowed = commented("<outerpoints>", "allow protrusion");
    DiagnosticPolicy deny;
    deny.deny.insert("protrusion");
    const Diagnostics denied = checked(allowed, deny);
    EXPECT_EQ(codes(denied), Codes{"protrusion"});
    EXPECT_TRUE(denied.has_errors());
    DiagnosticPolicy strict;
    strict.warnings_are_errors = true;
    const Diagnostics fine = checked(allowed, strict);
    EXPECT_EQ(codes(fine), Codes{});
    EXPECT_FALSE(fine.has_errors() || fine.has_findings());
    // A warning of the reader that is allowed does not end the reading either.
    const std::string markup = with(allowed, "id=\"tower\"", "colour=\"red\" ");
    EXPECT_EQ(codes(checked(with(markup, "<outerpoints>", "<!-- popupc: allow unknown-markup -->"), strict)),
              Codes{});
    EXPECT_EQ(codes(checked(with(markup, "<mainpage", "<!-- popupc: allow unknown-markup -->"), strict)),
              Codes{});
    EXPECT_EQ(codes(checked(markup, strict)), Codes{"unknown-markup"});
    // What the command line allows as well shows what the comment is for.
    DiagnosticPolicy both;
    both.allow.insert("protrusion");
    EXPECT_EQ(codes(checked(allowed, both)), Codes{});
}

TEST(Allow, UnusedIsToldOnlyWhenItWasLookedFor) {
    const std::string beside = commented("<mainpage", "allow clearance-low, protrusion, layer-order");
    EXPECT_EQ(codes(checked(beside)), Codes{"unused-allow"});  // layer-order
    CompileOptions near;
    near.motion.clearance_mm = 0.001;
    EXPECT_EQ(codes(checked(beside, {}, near)), (Codes{"unused-allow", "unused-allow"}));
    CompileOptions iterative;
    iterative.motion.solver = Solver::iterative;
    EXPECT_EQ(codes(checked(beside, {}, iterative)), Codes{});
    CompileOptions unexamined;
    unexamined.motion.examine = false;
    EXPECT_EQ(codes(checked(beside, {}, unexamined)), Codes{});
    const std::string broken = with(beside, "type=\"tent\"", "id=\"tower\" ");
    EXPECT_EQ(codes(checked(broken)), Codes{"xml-syntax"});
    CompileOptions short_way;
    short_way.until = Stage::motion;
    EXPECT_EQ(codes(compile({Source{"card.xml", beside}}, short_way, {}).designs.front().diagnostics),
              Codes{});
}

TEST(Allow, UnusedStandsAtItsCodeAndCanBeAllowed) {
    const Diagnostics found = checked(commented("<outerpoints>", "allow protrusion, layer-order"));
    ASSERT_EQ(codes(found), Codes{"unused-allow"});
    const Diagnostic one = found.sorted().front();
    EXPECT_EQ(one.place,
              (Place{5, 7 + static_cast<int>(std::string("<!-- popupc: allow protrusion, ").size())}));
    EXPECT_EQ(one.element, "tower");
    EXPECT_NE(one.message.find("layer-order"), std::string::npos);
    EXPECT_FALSE(one.hints.empty());
    EXPECT_EQ(codes(checked(commented("<mainpage", "allow protrusion layer-order unused-allow"))), Codes{});
    // For such a one nobody is asked: what it is for comes and goes with the options.
    EXPECT_EQ(codes(checked(commented("<mainpage", "allow protrusion unused-allow"))), Codes{});
    EXPECT_EQ(codes(checked(commented("<outerpoints>", "allow protrusion unused-allow"))), Codes{});
}

TEST(Allow, RepairsAreMadeAndStayInTheReport) {
    std::string narrow = kTower;
    for (std::size_t at = narrow.find("90\""); at != std::string::npos; at = narrow.find("90\"")) {
        narrow.replace(at, 2, "29");
    }
    const Diagnostics plain = checked(narrow);
    const auto repairs = plain.repairs().size();
    ASSERT_GT(repairs, 0U);
    const Diagnostics allowed = checked(with(narrow, "<mainpage", "<!-- popupc: allow tent-too-narrow -->"));
    EXPECT_EQ(allowed.repairs().size(), repairs);
    EXPECT_EQ(codes(allowed).size() + repairs, codes(plain).size());
}

TEST(Allow, ErrorsAreNeverDropped) {
    const std::string document = commented("<mainpage", "allow duplicate-id protrusion");
    const Codes found = codes(checked(with(document, "type=\"tent\"", "page-id=\"x\" ")));
    EXPECT_NE(std::find(found.begin(), found.end(), "bad-allow"), found.end());
    CompileOptions strict;
    strict.read.strict = true;
    const std::string markup = commented("<mainpage", "allow unknown-markup protrusion");
    EXPECT_EQ(codes(checked(with(markup, "type=\"tent\"", "colour=\"red\" "), {}, strict)),
              Codes{"unknown-markup"});
}

TEST(Allow, WhatIsNotUnderstoodIsTold) {
    for (const char* comment : {"allow", "allow:", "allow : x", "", "disallow protrusion",
                                "allow protrusionn", "Allow protrusion", "allowprotrusion"}) {
        const Codes found = codes(checked(commented("<mainpage", comment)));
        EXPECT_EQ(std::count(found.begin(), found.end(), "bad-allow"), 1) << comment;
        EXPECT_EQ(std::count(found.begin(), found.end(), "protrusion"), 1) << comment;
    }
    // A reason without its colon is told once.
    const Diagnostics found = checked(commented("<mainpage", "allow protrusion they are meant to touch"));
    EXPECT_EQ(codes(found), Codes{"bad-allow"});
    // Comments that only look like it are comments.
    EXPECT_EQ(codes(checked(with(kTower, "<mainpage", "<!-- popupc is fine, popupc: allow -->"))),
              Codes{"protrusion"});
}

TEST(Allow, ManyFindingsOfOneKindAreAllDropped) {
    std::string document = with(kTower, "<mainpage", "<!-- popupc: allow unknown-markup protrusion -->");
    std::string junk;
    for (int i = 0; i < 500; ++i) junk += "<junk/>";
    const Diagnostics found = checked(with(document, "<mainpage", junk));
    EXPECT_EQ(codes(found), Codes{});
    EXPECT_FALSE(found.has_findings());
}

TEST(Allow, HostileNumbersOfCommentsEndInALocatedError) {
    std::string comments;
    for (int i = 0; i < 11'000; ++i) comments += "<!--popupc:allow protrusion-->";
    EXPECT_EQ(codes(checked(with(kTower, "<outerpoints>", comments))), Codes{"document-too-large"});
    comments.resize(std::string("<!--popupc:allow protrusion-->").size() * 9'000);
    const Diagnostics found = checked(with(kTower, "<outerpoints>", comments));
    EXPECT_EQ(codes(found), Codes{});
}

TEST(Allow, ADrawingIsAllowedAsAWhole) {
    const std::string drawing =
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"100\" height=\"80\"><!-- popupc: allow "
        "size-missing -->"
        "<rect x=\"10\" y=\"10\" width=\"40\" height=\"30\" fill=\"none\" stroke=\"red\"/></svg>";
    CompileOptions options;
    options.until = Stage::pattern;
    DiagnosticPolicy strict;
    strict.warnings_are_errors = true;
    const Compilation run = compile({Source{"parts.svg", drawing}}, options, strict);
    EXPECT_TRUE(run.designs.front().pattern.has_value());
    for (const std::string& code : codes(run.designs.front().diagnostics)) EXPECT_NE(code, "size-missing");
}

TEST(CompileEach, FindsWhatCompilingTogetherFindsWithAnyNumberOfThreads) {
    std::vector<Source> sources;
    for (int i = 0; i < 24; ++i) {
        const std::string comment = i % 3 == 0 ? "allow protrusion" : "allow layer-order";
        sources.push_back(
            {"card" + std::to_string(i) + ".xml", i % 5 == 0 ? kTower : commented("<mainpage", comment)});
    }
    CompileOptions options;
    options.until = Stage::pattern;
    const Compilation together = compile(sources, options, {});
    for (const int threads : {1, 3, 8}) {
        options.threads = threads;
        std::vector<Codes> found(sources.size() + 1);
        std::size_t told = 0;
        std::size_t last = 0;
        options.progress = [&](std::size_t done, std::size_t total) {
            EXPECT_EQ(total, sources.size() + 1);
            EXPECT_GE(done, last);
            EXPECT_LT(last, total) << "told after the end";
            last = done;
            ++told;
        };
        std::atomic<int> in_memory{0};
        compile_each(
            sources.size() + 1,
            [&](std::size_t i) {
                if (i == sources.size()) return std::optional<Source>();
                EXPECT_LE(++in_memory, threads) << "a source is asked for before its turn";
                return std::optional(sources[i]);
            },
            [&](std::size_t i, CompiledDesign&& one) {
                --in_memory;
                EXPECT_EQ(one.source.name, sources[i].name);
                found[i] = codes(one.diagnostics);
            },
            options, {});
        for (std::size_t i = 0; i < sources.size(); ++i) {
            EXPECT_EQ(found[i], codes(together.designs[i].diagnostics)) << i;
        }
        EXPECT_EQ(last, sources.size() + 1);
        EXPECT_GT(told, 0U);
    }
}

}  // namespace
}  // namespace popup
