// FlatLang's parser against texts that nobody would write. Seeded, so that a failure comes again.
//
// Whatever the bytes, in both modes: reading ends, places lie in the text, and the tree is one that an
// evaluator may walk.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "input/flatlang/syntax/parse.h"
#include "popup/diagnostics.h"
#include "support/random.h"
#include "support/sanitized.h"
#include "support/text_columns.h"

namespace popup::flatlang {
namespace {

using test::columns;
using test::Random;

const std::array<std::string, 4> kPrograms{
    R"(; a wheel with spokes
define spoke(len, width)
  forward(len) right(90) forward(width) right(90) forward(len)
  backto("hub")
done
safe define wheel(spokes)
  mark("hub")
  repeat (spokes)
    spoke(1.5, .25)
    left(360 / spokes)
  done
done
part("wheel") wheel(7)
)",
    R"(l = [1, 2.5, "three", [4, -5], true, infinity]
o = object("box") o.width = 3 o.depth = o.width * 2 + 1
for each (e : l) (e != 2.5)
  if (e == "three" or e < 2 and e >= 0)
    print(e, l[0], o.depth % 4, -o.width)
  alt (e) print("alt;", first(rest(l))[1])
  else
    x = +3 - -4
  done
done
while (x > 0) x = x - 1 done
)",
    "shape (\"leaf\")\r\n  from (\"a\", name)\r\n    up() forward(2) down()\r\n  done\r\ndone ; \xC3\xA4\r\n"
    "draw(\"leaf\", \"a\")\r\nreplace (\"a\", \"b\") left(45) done replaceAll (\"b\", \"a\") done\r\n",
    "a.b.c(1, f(2, [[3]])).d[4][5].e = (((6 + 7) * 8))\nx = __object__ y = false define none() done none()",
};

const std::array<std::string_view, 56> kPieces{"(",
                                               ")",
                                               "[",
                                               "]",
                                               ",",
                                               ".",
                                               ":",
                                               "=",
                                               "==",
                                               "!=",
                                               "<",
                                               "<=",
                                               ">",
                                               ">=",
                                               "+",
                                               "-",
                                               "*",
                                               "/",
                                               "%",
                                               "!",
                                               "\"",
                                               "\\",
                                               ";",
                                               "\n",
                                               "\r\n",
                                               " ",
                                               "\t",
                                               "define",
                                               "safe ",
                                               "if (",
                                               "alt (",
                                               "else ",
                                               " done ",
                                               "while (1)",
                                               "repeat (",
                                               "for ",
                                               "for each",
                                               "for  each",
                                               "from (",
                                               "shape (\"s\")",
                                               "replace (",
                                               "replaceAll",
                                               " and ",
                                               " or ",
                                               "true",
                                               "infinity",
                                               "x",
                                               "f(",
                                               "12",
                                               "2.",
                                               ".5",
                                               "1e5",
                                               "\xC3\xA4",
                                               "\xFF",
                                               "\xEF\xBB\xBF",
                                               std::string_view("\0", 1)};

std::string mutated(const std::string& seed, Random& random) {
    std::string text = seed;
    const std::size_t changes = 1 + random.below(5);
    for (std::size_t i = 0; i < changes; ++i) {
        const std::size_t at = random.below(text.size() + 1);
        const std::size_t length = std::min(random.below(16), text.size() - at);
        const std::string_view piece = kPieces[random.below(kPieces.size())];
        switch (random.below(7)) {
            case 0:
                text.erase(at, length);
                break;
            case 1:
                text.insert(at, piece);
                break;
            case 2:
                if (at < text.size()) text[at] = static_cast<char>(random.below(256));
                break;
            case 3:
                text.insert(random.below(text.size() + 1), text.substr(at, random.below(120)));
                break;
            case 4:
                text.resize(at);
                break;
            case 5: {
                const std::size_t times = random.below(400);
                for (std::size_t k = 0; k < times; ++k) text.insert(at, piece);
                break;
            }
            default:
                text.replace(at, length, piece);
                break;
        }
    }
    return text;
}

// Words of the language in any order.
std::string words(Random& random) {
    std::string text;
    const std::size_t count = random.below(60);
    for (std::size_t i = 0; i < count; ++i) text += kPieces[random.below(kPieces.size())];
    return text;
}

void check_tree(const Parsed& parsed, const Symbols& symbols, const std::vector<int>& lines, int deepest) {
    const auto known = [&](int symbol) { return symbol >= 0 && !symbols.name(symbol).empty(); };
    const std::vector<Node>& nodes = parsed.syntax.nodes;
    ASSERT_EQ(parsed.syntax.root, static_cast<int>(nodes.size()) - 1);
    ASSERT_EQ(nodes.back().kind, NodeKind::block);
    std::vector<int> heights;
    std::vector<int> parents(nodes.size(), 0);
    for (const Node& node : nodes) {
        ASSERT_TRUE(node.place.line >= 1 && node.place.line <= static_cast<int>(lines.size()));
        ASSERT_TRUE(node.place.column >= 1 &&
                    node.place.column <= lines[static_cast<std::size_t>(node.place.line) - 1]);
        int height = 1;
        for (const int child : node.children) {
            if (child == kMissing) continue;
            ASSERT_TRUE(child >= 0 && child < static_cast<int>(heights.size()));
            height = std::max(height, heights[static_cast<std::size_t>(child)] + 1);
            ++parents[static_cast<std::size_t>(child)];
        }
        ASSERT_LE(height, kTreeLevels * deepest);
        heights.push_back(height);
        if (!parsed.complete) continue;
        // What runs has all its parts: only blocks, and the condition of a `for each`, may be missing.
        const std::size_t count = node.children.size();
        for (std::size_t i = 0; i < count; ++i) {
            const bool block = node.children[i] == kMissing ||
                               nodes[static_cast<std::size_t>(node.children[i])].kind == NodeKind::block;
            switch (node.kind) {
                case NodeKind::define:
                    ASSERT_TRUE(block && count == 1 && known(node.symbol));
                    break;
                case NodeKind::choose:
                    ASSERT_EQ(block, i % 2 == 1 || (node.has_else && i + 1 == count));
                    ASSERT_EQ(count % 2 == 1, node.has_else);
                    break;
                case NodeKind::for_each:
                    ASSERT_TRUE(count == 3 && known(node.symbol));
                    ASSERT_TRUE(i == 1 ? !block || node.children[i] == kMissing : block == (i == 2));
                    break;
                case NodeKind::loop_while:
                case NodeKind::repeat:
                case NodeKind::shape:
                    ASSERT_TRUE(count == 2 && block == (i == 1));
                    break;
                case NodeKind::replace:
                case NodeKind::replace_all:
                    ASSERT_TRUE(count == 3 && block == (i == 2));
                    break;
                case NodeKind::from:
                    ASSERT_TRUE(count >= 2 && block == (i + 1 == count));
                    break;
                case NodeKind::call:
                case NodeKind::index:
                    ASSERT_TRUE(!block && (node.kind == NodeKind::index ? count >= 2 : known(node.symbol)));
                    break;
                case NodeKind::negate:
                case NodeKind::plus:
                case NodeKind::expression:
                    ASSERT_TRUE(count == 1 && !block);
                    break;
                default:
                    ASSERT_FALSE(block);
                    ASSERT_TRUE(count == 2 || node.kind == NodeKind::list || node.kind == NodeKind::block);
            }
        }
    }
    // A tree: nothing hangs in two places.
    for (const int count : parents) ASSERT_LE(count, 1);
}

void check_one(const std::string& text, std::size_t& complete) {
    const std::vector<int> lines = columns(text);
    for (const bool as_2008 : {false, true}) {
        for (const int deepest : {250, 8}) {
            Symbols symbols;
            Diagnostics diagnostics("fuzz.fl");
            const Parsed parsed = parse("fuzz.fl", text, {as_2008, deepest}, symbols, diagnostics);
            ASSERT_EQ(parsed.complete, !diagnostics.has_findings());
            std::size_t mistakes = 0;
            for (const Diagnostic& d : diagnostics.sorted()) {
                if (d.place.line == 0) continue;  // how many more there are
                ASSERT_FALSE(d.message.empty());
                ASSERT_LE(d.place.line, static_cast<int>(lines.size())) << d.message;
                ASSERT_GE(d.place.column, 1);
                ASSERT_LE(d.place.column, lines[static_cast<std::size_t>(d.place.line) - 1]) << d.message;
                mistakes += d.code == "flatlang-syntax" ? 1 : 0;
                ASSERT_EQ(d.severity,
                          as_2008 && d.code == "flatlang-syntax" ? Severity::warning : Severity::error);
            }
            ASSERT_TRUE(as_2008 || mistakes <= 20U);
            ASSERT_NO_FATAL_FAILURE(check_tree(parsed, symbols, lines, deepest));
            if (parsed.complete && deepest == 250) ++complete;
        }
    }
}

void fuzz(std::uint64_t seed, int rounds) {
    Random random(seed);
    std::size_t complete = 0;
    for (int i = 0; i < rounds; ++i) {
        const std::string text =
            i % 4 == 0 ? words(random) : mutated(kPrograms[random.below(kPrograms.size())], random);
        check_one(text, complete);
        if (testing::Test::HasFatalFailure()) {
            ADD_FAILURE() << "seed " << seed << ", round " << i << ":\n" << text;
            return;
        }
    }
    // Refused texts test only half of the parser.
    EXPECT_GT(complete, static_cast<std::size_t>(rounds) / 20);
}

TEST(FlatLangParserFuzz, SeedsThemselvesAreRead) {
    for (const std::string& text : kPrograms) {
        std::size_t complete = 0;
        check_one(text, complete);
        EXPECT_EQ(complete, 2U) << text;
    }
}

TEST(FlatLangParserFuzz, EveryTruncationIsReadOrRefused) {
    for (const std::string& text : kPrograms) {
        std::size_t complete = 0;
        for (std::size_t length = 0; length < text.size(); ++length)
            check_one(text.substr(0, length), complete);
        EXPECT_GT(complete, 2U);
    }
}

TEST(FlatLangParserFuzz, MutatedPrograms) { fuzz(1, test::sanitized_count(5'000)); }

TEST(LongFlatLangParserFuzz, ManyMutatedPrograms) {
    for (std::uint64_t seed = 2; seed < 14; ++seed) fuzz(seed, 20'000);
}

}  // namespace
}  // namespace popup::flatlang
