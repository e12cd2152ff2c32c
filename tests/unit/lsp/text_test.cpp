// Texts and their positions; messages out of a stream of bytes.
#include "lsp/text.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "lsp/frames.h"
#include "lsp/uri.h"
#include "support/random.h"

namespace popup::lsp {
namespace {

constexpr Encoding kEncodings[] = {Encoding::utf16, Encoding::utf8, Encoding::utf32};

// Characters of one to four bytes, and all ends of lines.
std::string random_text(test::Random& random, std::size_t characters) {
    static const std::vector<std::string> kPieces{"a", "<", "\"", " ",    "ä",  "€",
                                                  "𝄞", "🎪", "\n", "\r\n", "\r", "\t"};
    std::string text;
    for (std::size_t i = 0; i < characters; ++i) text += kPieces[random.below(kPieces.size())];
    return text;
}

std::size_t boundary(test::Random& random, const std::string& text) {
    std::size_t at = random.below(text.size() + 1);
    while (at < text.size() && (static_cast<unsigned char>(text[at]) & 0xC0U) == 0x80U) ++at;
    // Within "\r\n" there is no position.
    if (at > 0 && at < text.size() && text[at - 1] == '\r' && text[at] == '\n') ++at;
    return at;
}

TEST(Text, PositionsCountUnitsOfTheEncoding) {
    const Text text("a𝄞b\r\nä€\rx\n");
    EXPECT_EQ(text.position(5, Encoding::utf16), (Position{0, 3}));  // behind the clef
    EXPECT_EQ(text.position(5, Encoding::utf8), (Position{0, 5}));
    EXPECT_EQ(text.position(5, Encoding::utf32), (Position{0, 2}));
    EXPECT_EQ(text.position(8, Encoding::utf16), (Position{1, 0}));
    EXPECT_EQ(text.position(13, Encoding::utf16), (Position{1, 2}));
    EXPECT_EQ(text.position(14, Encoding::utf16), (Position{2, 0}));
    EXPECT_EQ(text.position(text.size(), Encoding::utf16), (Position{3, 0}));
    EXPECT_EQ(text.offset({0, 2}, Encoding::utf16), 1U) << "half of a character is its beginning";
    EXPECT_EQ(text.offset({0, 99}, Encoding::utf16), 6U) << "behind a line is its end";
    EXPECT_EQ(text.offset({99, 0}, Encoding::utf16), text.size());
    EXPECT_EQ(text.offset({-1, -1}, Encoding::utf16), 0U);
}

TEST(Text, PlacesOfFindingsCountCharactersAndLineFeeds) {
    const Text text("\xEF\xBB\xBF<ä𝄞x/>\r<y/>\n  <z/>");
    EXPECT_EQ(text.offset(Place{1, 1}), 3U) << "a byte order mark is no character";
    EXPECT_EQ(text.offset(Place{1, 4}), 10U);
    EXPECT_EQ(text.offset(Place{1, 8}), 14U) << "a carriage return alone ends no line of a finding";
    EXPECT_EQ(text.offset(Place{2, 3}), text.bytes().find("<z"));
    EXPECT_EQ(text.offset(Place{0, 0}), 0U);
    EXPECT_EQ(text.offset(Place{9, 9}), text.size());
}

TEST(Text, EveryPositionComesBack) {
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        test::Random random(seed);
        const Text text(random_text(random, 60));
        for (const Encoding encoding : kEncodings) {
            for (int i = 0; i < 40; ++i) {
                const std::size_t at = boundary(random, text.bytes());
                EXPECT_EQ(text.offset(text.position(at, encoding), encoding), at)
                    << "seed " << seed << ", " << to_string(encoding);
            }
        }
    }
}

// Held against a count from the beginning, in a line of many thousand bytes.
TEST(Text, LongLinesAreCountedToTheUnit) {
    test::Random random(7);
    std::string bytes = "x\r\n";
    std::vector<std::string> pieces{"a", "<", "ä", "€", "𝄞", "🎪", "\xFF"};
    std::vector<std::size_t> starts;
    std::vector<int> utf16{0};
    for (int i = 0; i < 6000; ++i) {
        const std::string& piece = pieces[random.below(pieces.size())];
        starts.push_back(bytes.size());
        bytes += piece;
        utf16.push_back(utf16.back() + (piece.size() == 4 ? 2 : 1));
    }
    starts.push_back(bytes.size());
    const Text text(bytes);
    for (std::size_t i = 0; i < starts.size(); i += 7) {
        const auto at = static_cast<int>(i);
        EXPECT_EQ(text.position(starts[i], Encoding::utf16), (Position{1, utf16[i]}));
        EXPECT_EQ(text.position(starts[i], Encoding::utf32), (Position{1, at}));
        EXPECT_EQ(text.offset({1, utf16[i]}, Encoding::utf16), starts[i]);
        EXPECT_EQ(text.offset(Place{2, at + 1}), starts[i]);
    }
    EXPECT_EQ(text.offset({1, 1000000}, Encoding::utf16), bytes.size());
}

// "\r" and "\n" of one line end have one position between them and the text before.
TEST(Text, EditsHaveTheWholeOfALineEnd) {
    for (const auto& [before, after] :
         std::vector<std::pair<std::string, std::string>>{{"a\r\nb\r\n", "a\nb\n"},
                                                          {"a\nb\n", "a\r\nb\r\n"},
                                                          {"a\r\n", "a\r\n\r\n"},
                                                          {"a\rb", "a\r\nb"}}) {
        const Text text(before);
        std::string made = before;
        const TextEdit edit = difference(before, after);
        const std::size_t begin = text.offset(text.position(edit.at.begin, Encoding::utf16), Encoding::utf16);
        const std::size_t end = text.offset(text.position(edit.at.end, Encoding::utf16), Encoding::utf16);
        made.replace(begin, end - begin, edit.text);
        EXPECT_EQ(made, after);
    }
}

// What a client sends in pieces is the text that it has.
TEST(Text, EditsInPiecesGiveTheWholeText) {
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        test::Random random(seed);
        std::string whole = random_text(random, 50);
        Text text(whole);
        for (int step = 0; step < 30; ++step) {
            Span at{boundary(random, whole), boundary(random, whole)};
            if (at.begin > at.end) std::swap(at.begin, at.end);
            const std::string with = random_text(random, random.below(6));
            const Encoding encoding = kEncodings[random.below(3)];
            const Position begin = text.position(at.begin, encoding);
            const Position end = text.position(at.end, encoding);
            whole.replace(at.begin, at.size(), with);
            text.replace({text.offset(begin, encoding), text.offset(end, encoding)}, with);
            ASSERT_EQ(text.bytes(), whole) << "seed " << seed << ", step " << step;
            // The lines are those of the whole.
            const Text fresh(whole);
            for (int i = 0; i < 10; ++i) {
                const std::size_t look = boundary(random, whole);
                ASSERT_EQ(text.position(look, encoding), fresh.position(look, encoding)) << "seed " << seed;
            }
        }
    }
}

TEST(Text, DifferencesMakeTheSecondOfTheFirst) {
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        test::Random random(seed);
        std::string before;
        for (int i = 0; i < 40; ++i) before += random_text(random, 5) + "\n";
        std::string after = before;
        for (std::size_t i = 0; i < random.below(6); ++i) {
            const std::size_t at = boundary(random, after);
            after.replace(at, boundary(random, after) > at ? 0 : 0, random_text(random, 4));
        }
        if (random.below(4) == 0) after = random_text(random, 80);
        EXPECT_EQ(with_edits(before, differences(before, after)), after) << "seed " << seed;
        EXPECT_EQ(with_edits(before, {difference(before, after)}), after) << "seed " << seed;
    }
    EXPECT_TRUE(differences("a\nb\n", "a\nb\n").empty());
    const std::vector<TextEdit> two = differences("x=1\nsame\ny=1\n", "x=2\nsame\ny=3\n");
    ASSERT_EQ(two.size(), 2U) << "one edit a line that differs";
    EXPECT_EQ(two[1], (TextEdit{{11, 12}, "3"}));
}

TEST(Uris, PathsComeBack) {
    EXPECT_EQ(path_of("file:///a%20b/%C3%A4.xml"), "/a b/ä.xml");
    EXPECT_EQ(path_of("file://localhost/a.xml"), "/a.xml");
    EXPECT_EQ(path_of("file:///a%zz.xml"), "/a%zz.xml");
    EXPECT_EQ(path_of("file:///a%00.xml"), std::nullopt);
    EXPECT_EQ(path_of("file://elsewhere/a.xml"), std::nullopt);
    EXPECT_EQ(path_of("untitled:Untitled-1"), std::nullopt);
    for (const char* path : {"/a/b.xml", "/with blank/ä𝄞#?%.xml"}) EXPECT_EQ(path_of(uri_of(path)), path);
}

std::vector<Frame> all_frames(std::string_view bytes, std::size_t piece) {
    FrameReader reader;
    std::vector<Frame> frames;
    for (std::size_t i = 0; i < bytes.size(); i += piece) {
        reader.push(bytes.substr(i, piece));
        while (auto frame = reader.next()) frames.push_back(std::move(*frame));
    }
    return frames;
}

TEST(Frames, ComeInWhateverPieces) {
    const std::string bytes =
        framed("one") + framed("") + "content-length:  3 \ncontent-type: x\n\ntwo" + framed("ä");
    for (const std::size_t piece : {1U, 2U, 7U, 1000U}) {
        const std::vector<Frame> frames = all_frames(bytes, piece);
        ASSERT_EQ(frames.size(), 4U);
        EXPECT_EQ(frames[0].body, "one");
        EXPECT_EQ(frames[1].body, "");
        EXPECT_EQ(frames[2].body, "two");
        EXPECT_EQ(frames[3].body, "ä");
    }
}

TEST(Frames, WhatIsNoHeadIsPassedOverAndToldOnce) {
    struct Case {
        std::string bytes;
        std::vector<std::string> expected;  // "!" is a fault
    };
    const std::vector<Case> cases{
        {"GET / HTTP/1.1\r\nHost: x\r\n\r\n" + framed("a"), {"!", "a"}},
        {"Content-Length: many\r\n\r\n" + framed("a"), {"!", "a"}},
        {"Content-Length: -3\r\n\r\n" + framed("a"), {"!", "a"}},
        {"Content-Length: 99999999999999999999999\r\n\r\nabc", {"!"}},
        {"Content-Length: 2\r\n\r\n{}}}}}" + framed("a"), {"{}", "a"}},  // too short
        {"Content-Length: 30\r\n\r\n{}" + framed("ab") + framed("c") + framed("d"),
         {"#", "!", "d"}},  // too long: eats the next
        {std::string(50'000, 'x') + framed("a"), {"!", "a"}},
        {"\r\n\r\n\r\n\r\n" + framed("a"), {"!", "a"}},
    };
    for (const Case& one : cases) {
        for (const std::size_t piece : {1U, 64U, 100'000U}) {
            std::vector<std::string> got;
            for (const Frame& frame : all_frames(one.bytes, piece))
                got.push_back(frame.fault.empty() ? frame.body.size() > 20 ? "#" : frame.body : "!");
            EXPECT_EQ(got, one.expected) << one.bytes.substr(0, 60) << " in pieces of " << piece;
        }
    }
}

TEST(Frames, AMessageThatIsTooLongIsSkipped) {
    FrameReader reader;
    reader.push("Content-Length: 100000000\r\n\r\n");
    const auto refused = reader.next();
    ASSERT_TRUE(refused);
    EXPECT_EQ(refused->fault, "a message has 100000000 bytes, and the most are 67108864");
    const std::string part(1'000'000, '[');
    for (int i = 0; i < 100; ++i) {
        reader.push(part);
        ASSERT_FALSE(reader.next());
    }
    reader.push(framed("after"));
    const auto next = reader.next();
    ASSERT_TRUE(next);
    EXPECT_EQ(next->body, "after");
}

}  // namespace
}  // namespace popup::lsp
