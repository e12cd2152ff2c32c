// The parser of FlatLang: trees, complaints, and what the original parser made of other people's programs.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "input/flatlang/syntax/parse.h"
#include "popup/diagnostics.h"

namespace popup::flatlang {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kNoData =
    "no FlatLang programs: POPUP_FLATLANG_DATA names no directory with vectors in it";

// Other people's programs, with what the original interpreter made of them.
fs::path data_directory() {
    const char* named = std::getenv("POPUP_FLATLANG_DATA");
    return named != nullptr ? fs::path(named)
                            : fs::path(POPUP_SOURCE_DIR).parent_path() / "shared/data/flatlang";
}

std::string slurp(const fs::path& path) {
    const std::ifstream in(path, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

struct Read {
    Symbols symbols;
    Diagnostics diagnostics{"test.fl"};
    Parsed parsed;
    std::vector<std::string> said;  // "line:column message"
};

Read read(std::string_view text, bool as_2008 = false) {
    Read result;
    result.parsed = parse("test.fl", text, {as_2008, 250}, result.symbols, result.diagnostics);
    for (const Diagnostic& d : result.diagnostics.sorted()) {
        result.said.push_back(fmt::format("{}:{} {}", d.place.line, d.place.column, d.message));
    }
    return result;
}

// The tree as text: operators and statements by name, then their children; ? for what is missing.
void dump(const Read& read, int index, std::string& out) {
    static constexpr std::array<std::string_view, 37> kNames{
        "",       "",    "",      "infinity", "object",  "",           "call", "index",  "list", "member",
        "neg",    "pos", "+",     "-",        "*",       "/",          "%",    "<",      "<=",   ">",
        ">=",     "==",  "!=",    "and",      "or",      "=",          "do",   "define", "if",   "while",
        "repeat", "for", "shape", "from",     "replace", "replaceAll", "block"};
    if (index == kMissing) {
        out += '?';
        return;
    }
    const Node& node = read.parsed.syntax.nodes[static_cast<std::size_t>(index)];
    switch (node.kind) {
        case NodeKind::number:
            out += fmt::format("{}", node.number);
            return;
        case NodeKind::truth:
            out += node.number == 1 ? "true" : "false";
            return;
        case NodeKind::text:
            out += '"' + node.text + '"';
            return;
        case NodeKind::name:
            out += read.symbols.name(node.symbol);
            return;
        default:
            break;
    }
    out += '(';
    if (node.safe) out += "safe ";
    out += kNames[static_cast<std::size_t>(node.kind)];
    if (node.has_else) out += "-else";
    if (node.symbol >= 0) out += " " + read.symbols.name(node.symbol);
    for (const int parameter : node.parameters) out += " $" + read.symbols.name(parameter);
    for (const int child : node.children) {
        out += ' ';
        dump(read, child, out);
    }
    out += ')';
}

std::string tree(std::string_view text, bool as_2008 = false) {
    const Read got = read(text, as_2008);
    std::string out;
    dump(got, got.parsed.syntax.root, out);
    return out;
}

std::vector<std::string> said(std::string_view text) { return read(text).said; }

// What is said, with hints and related places.
std::string everything_said(std::string_view text) {
    std::string out;
    const Read got = read(text);
    for (const Diagnostic& d : got.diagnostics.sorted()) {
        out += fmt::format("{}:{} {}\n", d.place.line, d.place.column, d.message);
        for (const std::string& hint : d.hints) out += fmt::format("  hint: {}\n", hint);
        for (const Related& r : d.related)
            out += fmt::format("  {}:{} {}\n", r.place.line, r.place.column, r.text);
    }
    return out;
}

using Lines = std::vector<std::string>;

TEST(FlatLangParse, OperatorsBindAsTheLanguageHasIt) {
    EXPECT_EQ(tree("x = a or b and c == d < e + f * -g.h"),
              "(block (do (= x (or a (and b (== c (< d (+ e (* f (neg (member g h)))))))))))");
    EXPECT_EQ(tree("1 - 2 - 3"), "(block (do (- (- 1 2) 3)))");
    EXPECT_EQ(tree("a.b.c"), "(block (do (member (member a b) c)))");
    EXPECT_EQ(tree("+4 * -(1 + 2)"), "(block (do (* (pos 4) (neg (+ 1 2)))))");
    EXPECT_EQ(tree("a <= b != c >= d > e % f / g"), "(block (do (!= (<= a b) (> (>= c d) (/ (% e f) g)))))");
}

TEST(FlatLangParse, StatementsNeedNothingBetweenThem) {
    EXPECT_EQ(tree("a = 10\n-3"), "(block (do (= a (- 10 3))))");
    EXPECT_EQ(tree("f\n(3)"), "(block (do (call f 3)))");
    EXPECT_EQ(tree("l\n[1]"), "(block (do (index l 1)))");
    EXPECT_EQ(tree("a = 1 b = 2 f()g(1, [])"),
              "(block (do (= a 1)) (do (= b 2)) (do (call f)) (do (call g 1 (list))))");
    EXPECT_EQ(tree("o.f(x)[1][2].y"), "(block (do (member (member o (index (call f x) 1 2)) y)))");
    EXPECT_EQ(tree(""), "(block)");
    EXPECT_EQ(tree("; nothing"), "(block)");
}

TEST(FlatLangParse, EveryStatementHasItsParts) {
    EXPECT_EQ(tree("safe define f(a, b) a done define g() done"),
              "(block (safe define f $a $b (block (do a))) (define g ?))");
    EXPECT_EQ(tree("if (a) 1 alt (b) 2 alt (c) else 3 done if (d) done"),
              "(block (if-else a (block (do 1)) b (block (do 2)) c ? (block (do 3))) (if d ?))");
    EXPECT_EQ(tree("if (a) else done"), "(block (if-else a ? ?))");
    EXPECT_EQ(tree("while (a) b done repeat (3) done"), "(block (while a (block (do b))) (repeat 3 ?))");
    EXPECT_EQ(tree("for each (i : [1]) print(i) done for each (j : l) (j > 2) done"),
              "(block (for i (list 1) ? (block (do (call print i)))) (for j l (> j 2) ?))");
    EXPECT_EQ(tree("shape (\"s\") f() done from (\"a\", b) done"),
              "(block (shape \"s\" (block (do (call f)))) (from \"a\" b ?))");
    EXPECT_EQ(tree("replace (a, b) c done replaceAll (\"a\", \"b\") done"),
              "(block (replace a b (block (do c))) (replaceAll \"a\" \"b\" ?))");
    EXPECT_EQ(tree("x = true y = false z = infinity o = __object__"),
              "(block (do (= x true)) (do (= y false)) (do (= z (infinity))) (do (= o (object))))");
}

TEST(FlatLangParse, LiteralsAreRoundedToFloatAndTextsStandAsWritten) {
    const auto number = [](const std::string& digits) {
        return read(digits).parsed.syntax.nodes.front().number;
    };
    EXPECT_EQ(number("0.1"), 0.10000000149011612);
    EXPECT_EQ(number(".5"), 0.5);
    EXPECT_EQ(number("007.250"), 7.25);
    EXPECT_EQ(number("16777217"), 16777216.0);
    EXPECT_EQ(number("340282356779733661637539395458142568447"), 3.4028234663852886e38);
    EXPECT_EQ(number("1" + std::string(60, '0')), std::numeric_limits<double>::infinity());
    EXPECT_EQ(number("0." + std::string(60, '0') + "1"), 0.0);
    EXPECT_EQ(number(std::string(60, '0') + "3"), 3.0);
    EXPECT_EQ(tree("x = \"a\\n\\\"b\\\"\n;c\""), "(block (do (= x \"a\\n\\\"b\\\"\n;c\")))");
}

TEST(FlatLangParse, PlacesCountCharactersAndLineEndsOfAnyKind) {
    const Read got = read("\xEF\xBB\xBFx = \"\xC3\xA4\xE2\x82\xAC\" y = 2\r\n\tz = 3");
    ASSERT_TRUE(got.parsed.complete);
    std::vector<std::pair<int, int>> statements;
    for (const Node& node : got.parsed.syntax.nodes) {
        if (node.kind == NodeKind::expression) statements.emplace_back(node.place.line, node.place.column);
    }
    EXPECT_EQ(statements, (std::vector<std::pair<int, int>>{{1, 1}, {1, 10}, {2, 2}}));
}

TEST(FlatLangParse, AMistakeIsToldOnceWithWhatWasExpected) {
    EXPECT_EQ(said("print(\"one\"\nprint(\"two\")\nif (true) x done"),
              Lines{"2:1 expected ')' to close the arguments of 'print', but found 'print'"});
    EXPECT_EQ(said("print(\"a\" \"b\")"),
              Lines{"1:11 expected ',' or ')' in the arguments of 'print', but found the text \"b\""});
    EXPECT_EQ(said("f(a, , b)"), Lines{"1:6 expected a value, but found ','"});
    EXPECT_EQ(said("x = [1, 2\ny = 3"), Lines{"2:1 expected ']' to close the list after '[', but found 'y'"});
    EXPECT_EQ(said("f(a,\n  b c,\n  d)\nx = 1"),
              Lines{"2:5 expected ',' or ')' in the arguments of 'f', but found 'c'"});
    EXPECT_EQ(said("replace (\"a\") x done"),
              Lines{"1:13 expected ',' between the values of 'replace', but found ')'"});
    EXPECT_EQ(said("shape (a) x done"),
              Lines{"1:8 expected a text in quotation marks for the name of 'shape', but found 'a'"});
    EXPECT_EQ(said("safe x = 1"), Lines{"1:6 expected 'define' after 'safe', but found 'x'"});
    EXPECT_EQ(said("x = 1 +"), Lines{"1:8 expected a value, but found the end of the file"});
    EXPECT_EQ(said("x )\ny = 2"), Lines{"1:3 this ')' closes nothing"});
}

TEST(FlatLangParse, MistakesThatHaveNothingToDoWithEachOtherAreAllTold) {
    EXPECT_EQ(
        said("define f(x)\n"
             "  while (true)\n"
             "    print(x) )\n"
             "    print(]\n"
             "    x = 1 +\n"
             "  done\n"
             "  print(3 4)\n"
             "done\n"
             "done\n"
             "repeat 4\n"
             "  print((1)\n"
             "done\n"
             "x = @ 2.\n"),
        (Lines{"3:14 this ')' closes nothing", "4:11 expected a value, but found ']'",
               "6:3 expected a value, but found 'done'",
               "7:11 expected ',' or ')' in the arguments of 'print', but found the number 4",
               "9:1 this 'done' closes nothing", "10:8 expected '(' after 'repeat', but found the number 4",
               "12:1 expected ')' to close the arguments of 'print', but found 'done'",
               "13:5 '@' has no meaning in the language",
               "13:7 digits are missing after the dot of the number 2."}));
}

TEST(FlatLangParse, AtMostTwentyMistakesAreTold) {
    std::string text;
    for (int i = 0; i < 1000; ++i) text += "x = )\n";
    EXPECT_EQ(said(text).size(), 20U);
    EXPECT_EQ(said(std::string(1000, '!')).size(), 20U);
    // What follows from a quotation mark that is missing is not told, and is not looked for without end.
    text.clear();
    for (int i = 0; i < 20'000; ++i) text += "x = ( =\n";
    EXPECT_EQ(said("print(\"\n\")\n" + text + '"'),
              Lines{"20003:1 the text that begins here is not closed before the end of the file"});
}

TEST(FlatLangParse, AMissingDoneIsToldWhereTheStatementBegins) {
    EXPECT_EQ(everything_said("repeat (3)\n  f(1)\n  if (x)\n    g(3)\ndone\nh()"),
              "1:1 this 'repeat' has no 'done' before the end of the file\n"
              "  hint: the 'done' at 5:1 ends the 'if' at 3:3, but stands below what is around that; one may "
              "be missing "
              "before it\n");
    EXPECT_EQ(everything_said("define f()\n  while (a)\n    b\ndone\n\ndefine g()\ndone"),
              "1:1 this 'define' has no 'done' before 'define'\n"
              "  hint: the 'done' at 4:1 ends the 'while' at 2:3, but stands below what is around that; one "
              "may be missing "
              "before it\n"
              "  6:1 define\n");
    EXPECT_EQ(said("while (a) while (b) while (c) x"),
              Lines{"1:21 this 'while' has no 'done' before the end of the file"});
}

TEST(FlatLangParse, WhatIsOftenWrittenWronglyGetsAHint) {
    struct Case {
        std::string_view text, where, hint;
    };
    for (const Case& c : {
             Case{"x = - -3", "1:7 expected a value, but found '-'", "-(-3)"},
             Case{"a = b = 3", "1:7 '=' begins no statement", "assigns once"},
             Case{"if (a = b = 3) x done", "1:11 expected ')'", "assigns once"},
             Case{"if (not x) y done", "1:9 expected ')'", "there is no 'not'"},
             Case{"if (!x) y done", "1:5 '!' stands alone", "== false"},
             Case{"for  each (i : l) x done", "1:1 'for' must be followed by 'each'",
                  "for each (item : list)"},
             Case{"for (i : l) x done", "1:1", "for each"},
             Case{"for(i : l) x done", "1:7 expected ',' or ')'", "begins with 'for each'"},
             Case{"for i in l x done", "1:1 'for' must be followed by 'each'", "for each (item : list)"},
             Case{"repeat 4 x done", "1:8 expected '(' after 'repeat', but found the number 4", "repeat (4)"},
             Case{"define f(:x) print(:x) done", "1:10 a ':' stands before the name 'x'", "1 further place"},
             Case{"begin part :size", "1:12 a ':' stands before the name 'size'", "without a mark"},
             Case{"# x", "1:1 '#' has no meaning", "comments begin with ;"},
             Case{"x // y", "1:4 expected a value", ""},
             Case{"// y", "1:1 '/' begins no statement", "comments begin with ;"},
             Case{"x = 1e5", "1:6 'e5' stands directly after a number", "no exponent"},
             Case{"x = 2.", "1:5 digits are missing", "write 2 or 2.0"},
             Case{"shape = 3", "1:7 expected '('", "cannot name a variable"},
             Case{"define from() x done", "1:8 expected a name", "cannot be a name"},
             Case{"b = 1 print(b)\n[1,2]", "2:3 expected ']'",
                  "the '[' at 2:1 goes on with what stands in the line before"},
             Case{"f([1][0])", "1:6 expected ',' or ')'", "give the list a name first"},
             Case{"if (x)\n  define f() y done\ndone", "2:3 functions are defined outside of all blocks",
                  "'if' at 1:1"},

             Case{"print(\"one)\nprint(\"two)\nx = 1", "2:8 expected ')' to close", "may be missing"},
             Case{"print(\"one)\nprint(\"two\")\nf(", "2:11 the text that begins here is not closed",
                  "begins at 1:7"},
         }) {
        const std::string got = everything_said(c.text);
        EXPECT_EQ(got.substr(0, c.where.size()), c.where) << c.text << "\n" << got;
        EXPECT_NE(got.find(c.hint), std::string::npos) << c.text << "\n" << got;
        EXPECT_LE(said(c.text).size(), 1U) << got;
        EXPECT_FALSE(read(c.text).parsed.complete);
    }
}

TEST(FlatLangParse, BrokenTreesOf2008AreThoseTheOriginalRan) {
    EXPECT_EQ(tree("print(:a)\n", true), "(block (do ?) (do ?) (do ?))");
    EXPECT_EQ(tree("x = - -3", true), "(block (do (= x (- (neg ?) 3))))");
    EXPECT_EQ(tree("f([1][0])\ng()", true), "(block (do (index (call f (list 1)) 0)))");
    EXPECT_EQ(tree("y = 2.\nprint(y)", true), "(block (do (= y (call print y))))");
    EXPECT_EQ(tree("print(\"two\"\nprint(3)", true), "(block (do (call print \"two\")) (do (call print 3)))");
    EXPECT_EQ(tree("print(5abc)", true), "(block (do (call print 5)))");
    EXPECT_EQ(tree("print(a, , b)", true), "(block (do (call print a b)))");
    EXPECT_EQ(tree("print(\"b)\nprint(\"c\")", true), "(block (do (call print \"b)\nprint(\")) (do c))");
    EXPECT_EQ(tree("for  each (i : [1,2]) x done", true), "(block (do (call ach)) (do 2))");
    EXPECT_EQ(tree("print(b)\n[1,2]", true), "(block (do (call print b)) (do 2))");
    EXPECT_EQ(tree("a = b = c print(1)", true), "(block (do (= a b)))");
    EXPECT_EQ(tree("if (a)\n define g() 5 done\ndone x", true), "(block (if a ?) (define g (block (do 5))))");
}

// The longest way from the root to a leaf, in nodes; and that children stand before their parents.
int height(const Syntax& syntax) {
    std::vector<int> heights;
    for (const Node& node : syntax.nodes) {
        int height = 1;
        for (const int child : node.children) {
            if (child == kMissing) continue;
            EXPECT_GE(child, 0);
            EXPECT_LT(child, static_cast<int>(heights.size()));
            height = std::max(height, heights[static_cast<std::size_t>(child)] + 1);
        }
        heights.push_back(height);
    }
    EXPECT_EQ(syntax.root, static_cast<int>(syntax.nodes.size()) - 1);
    return heights.empty() ? 0 : *std::max_element(heights.begin(), heights.end());
}

std::string repeated(std::string_view text, int times) {
    std::string out;
    for (int i = 0; i < times; ++i) out += text;
    return out;
}

TEST(FlatLangParse, DeepTextsAreRefusedAndNoTreeIsDeep) {
    const std::vector<std::string> endless{
        repeated("(", 20'000),           repeated("[", 20'000),
        repeated("f(", 20'000),          repeated("a[", 20'000),
        repeated("-(", 20'000),          repeated("a+", 20'000) + "a",
        "a" + repeated(".b", 20'000),    "a" + repeated(" or a", 20'000),
        repeated("if (a) ", 20'000),     repeated("repeat (1) ", 20'000),
        repeated("define f() ", 20'000), repeated("while (a) shape (\"s\") ", 20'000)};
    for (const std::string& text : endless) {
        for (const bool as_2008 : {false, true}) {
            const Read got = read(text, as_2008);
            const auto all = got.diagnostics.sorted();
            EXPECT_TRUE(std::any_of(all.begin(), all.end(),
                                    [](const Diagnostic& d) { return d.code == "flatlang-too-deep"; }) ||
                        text.substr(0, 6) == "define")
                << text.substr(0, 30);
            EXPECT_FALSE(got.parsed.complete);
            EXPECT_LE(height(got.parsed.syntax), 250 * kTreeLevels + 1);
        }
    }
    const std::string fits = repeated("(", 250) + "1" + repeated(")", 250);
    EXPECT_TRUE(read(fits).parsed.complete);
    EXPECT_FALSE(read("(" + fits + ")").parsed.complete);
    const std::string blocks = repeated("if (a) ", 250) + "x" + repeated(" done", 250);
    EXPECT_TRUE(read(blocks).parsed.complete);
    EXPECT_FALSE(read("repeat (1) " + blocks + " done").parsed.complete);
    // Long is not deep.
    EXPECT_TRUE(read(repeated("x = [1, 2] ", 50'000)).parsed.complete);
    EXPECT_TRUE(read("x = [0" + repeated(", 1", 50'000) + "]").parsed.complete);
    EXPECT_TRUE(read("x = 1" + repeated(" + 1", 990)).parsed.complete);
}

TEST(FlatLangParse, SymbolsOfEqualNamesAreEqualAcrossPrograms) {
    Symbols symbols;
    Diagnostics diagnostics;
    const Parsed one = parse("a.fl", "x y", {}, symbols, diagnostics);
    const Parsed two = parse("b.fl", "y x", {}, symbols, diagnostics);
    EXPECT_EQ(one.syntax.nodes[0].symbol, two.syntax.nodes[2].symbol);
    EXPECT_EQ(one.syntax.nodes[2].symbol, two.syntax.nodes[0].symbol);
    EXPECT_EQ(symbols.name(one.syntax.nodes[0].symbol), "x");
    EXPECT_EQ(two.syntax.file, "b.fl");
}

// A line and column from 1, as the original counts from 1 and from 0. The end of the file it calls 0:-1.
using At = std::pair<int, int>;

At end_of(std::string_view text) {
    const auto lines = static_cast<int>(std::count(text.begin(), text.end(), '\n'));
    const std::size_t last = text.rfind('\n');
    return {lines + 1, static_cast<int>(text.size() - (last == std::string_view::npos ? 0 : last + 1)) + 1};
}

std::set<At> places_2008(const nlohmann::json& parse, std::string_view text) {
    std::set<At> places;
    for (const std::string error : parse.value("errors", nlohmann::json::array())) {
        // "line 3:17 mismatched input ..."
        const std::size_t colon = error.find(':');
        if (error.substr(0, 5) != "line " || colon == std::string::npos) {
            ADD_FAILURE() << error;
            continue;
        }
        const int line = std::stoi(error.substr(5));
        places.insert(line == 0 ? end_of(text) : At{line, std::stoi(error.substr(colon + 1)) + 1});
    }
    if (parse.value("stopped_before_eof", false)) {
        places.insert({parse["stop_line"], parse["stop_col"].get<int>() + 1});
    }
    return places;
}

TEST(FlatLangParse, ComplaintsIn2008ModeStandWhereTheOriginalHadThem) {
    if (!fs::is_directory(data_directory() / "vectors")) GTEST_SKIP() << kNoData;
    int programs = 0;
    int failing = 0;
    for (const auto& [vectors, sources] :
         {std::pair{"vectors", "programs"}, std::pair{"probe-vectors", "probes"}}) {
        for (const auto& entry : fs::directory_iterator(data_directory() / vectors)) {
            if (entry.path().stem() == "INDEX") continue;
            const nlohmann::json vector = nlohmann::json::parse(slurp(entry.path()));
            const std::string program = vector["program"];
            const std::string text = slurp(data_directory() / sources / program);
            SCOPED_TRACE(program);
            const Read got = read(text, true);
            std::set<At> places;
            for (const Diagnostic& d : got.diagnostics.sorted()) {
                EXPECT_EQ(d.severity, Severity::warning);
                places.insert({d.place.line, d.place.column});
            }
            const std::set<At> expected = places_2008(vector["parse"], text);
            EXPECT_EQ(places, expected) << fmt::format("{}", fmt::join(got.said, "\n"));
            EXPECT_EQ(got.parsed.complete, expected.empty());
            // And where the original found nothing, the default mode does not either.
            EXPECT_EQ(read(text).parsed.complete, expected.empty());
            ++programs;
            failing += expected.empty() ? 0 : 1;
        }
    }
    EXPECT_GT(programs, 200);
    EXPECT_GT(failing, 30);
    fmt::print("{} programs, {} of them with mistakes\n", programs, failing);
}

}  // namespace
}  // namespace popup::flatlang
