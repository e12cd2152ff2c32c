// FlatLang programs that nobody would write, run. Seeded, so that a failure comes again.
//
// Whatever the text, in both modes: the run ends within its limits and says what is wrong where it stands,
// gives the same bytes each time, and what it drew goes on to become parts or a design, or is refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "input/flatlang/read.h"
#include "input/flatlang/run/interpreter.h"
#include "input/flatlang/trail_json.h"
#include "support/random.h"
#include "support/sanitized.h"
#include "support/text_columns.h"

namespace popup::flatlang {
namespace {

namespace fs = std::filesystem;
using test::columns;
using test::Random;

constexpr std::string_view kOther =
    "define helper(x) forward(x) left(90) mark(\"h\") done loaded = 1 5 % unknown\n";

// The programs beside this file, by name.
const std::map<std::string, std::string>& corpus() {
    static const std::map<std::string, std::string> all = [] {
        std::map<std::string, std::string> read;
        for (const auto& entry : fs::directory_iterator(fs::path(POPUP_SOURCE_DIR) / "tests/fuzz/flatlang")) {
            std::ifstream file(entry.path(), std::ios::binary);
            std::ostringstream text;
            text << file.rdbuf();
            read[entry.path().filename()] = text.str();
        }
        return read;
    }();
    return all;
}

ReadOptions options(bool as_2008) {
    ReadOptions made;
    made.program.as_2008 = as_2008;
    made.program.limits = {.steps = 20'000, .depth = 60, .values = 20'000, .text = 100'000, .trail = 20'000};
    made.program.definitions = {{"sides", "5"}, {"a", "true"}, {"s", "text"}};
    made.program.read_file = [](const std::string& path) -> std::optional<Source> {
        if (path == "other.fl") return Source{path, std::string(kOther)};
        if (path == "self.fl") return Source{path, "load(\"self.fl\")"};
        if (path == "bad.fl") return Source{path, "mark(\"m\") forward("};
        return std::nullopt;
    };
    return made;
}

constexpr std::array<std::string_view, 78> kPieces{"(",
                                                   ")",
                                                   "[",
                                                   "]",
                                                   ",",
                                                   ".",
                                                   "=",
                                                   " == ",
                                                   " - ",
                                                   " + ",
                                                   " * ",
                                                   " / ",
                                                   " % ",
                                                   "\"",
                                                   "\n",
                                                   " done ",
                                                   "define f(a) ",
                                                   "safe ",
                                                   "if (",
                                                   "alt (",
                                                   "else ",
                                                   "while (true) ",
                                                   "repeat (3) ",
                                                   "repeat (infinity) ",
                                                   "for each (e : l) ",
                                                   "shape(\"s\") ",
                                                   "from (\"a\", \"b\") ",
                                                   "replace (\"a\", \"b\") ",
                                                   "replaceAll (\"a\", \"b\") ",
                                                   " and ",
                                                   "true",
                                                   "nil",
                                                   "infinity",
                                                   "__object__",
                                                   "l",
                                                   "o",
                                                   "o.width",
                                                   "l.n",
                                                   "f(1)",
                                                   "0",
                                                   "-1",
                                                   "0.00001",
                                                   "1000000",
                                                   "1 / 0",
                                                   "0 / 0",
                                                   "\"a\"",
                                                   "\"b\"",
                                                   "[]",
                                                   "[1, [2], \"a\"]",
                                                   "pos()",
                                                   "dir()",
                                                   "pos().x",
                                                   "forward(1)",
                                                   "left(90)",
                                                   "roll(45)",
                                                   "pitch(90)",
                                                   "up()",
                                                   "down()",
                                                   "mark(\"a\")",
                                                   "mark(\"b\")",
                                                   "backto(\"a\")",
                                                   "part(\"p\")",
                                                   "draw(\"s\")",
                                                   "draw(\"s\", \"a\")",
                                                   "drawto(pos() + pos())",
                                                   "facedir(dir())",
                                                   "clear()",
                                                   "print(l, o)",
                                                   "debug(o)",
                                                   "cons(l, l)",
                                                   "l = append(l, l)",
                                                   "sub(1, l, l)",
                                                   "ins(1, 1, l)",
                                                   "eval(source(f))",
                                                   "load(\"other.fl\")",
                                                   "load(\"bad.fl\")",
                                                   "load(\"self.fl\")",
                                                   "popup(8, 6)"};

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) lines.push_back(line + "\n");
    return lines;
}

// Where a word, a number or a sign begins.
std::size_t word_begin(const std::string& text, std::size_t at) {
    const auto is_letter = [&](std::size_t i) {
        return std::isalnum(static_cast<unsigned char>(text[i])) != 0 || text[i] == '_' || text[i] == '.';
    };
    while (at > 0 && at < text.size() && is_letter(at) && is_letter(at - 1)) --at;
    return at;
}

std::size_t word_end(const std::string& text, std::size_t at) {
    if (at >= text.size()) return at;
    std::size_t end = at + 1;
    while (end < text.size() && word_begin(text, end) == at && end != word_begin(text, end)) ++end;
    return end;
}

void change_bytes(std::string& text, Random& random) {
    const std::size_t at = random.below(text.size() + 1);
    switch (random.below(4)) {
        case 0:
            text.erase(at, random.below(10));
            break;
        case 1:
            if (at < text.size()) text[at] = static_cast<char>(random.below(256));
            break;
        case 2:
            text.insert(random.below(text.size() + 1), text.substr(at, random.below(100)));
            break;
        default:
            text.resize(at);
            break;
    }
}

// Words for words: most of what comes out is still a program.
void change_words(std::string& text, Random& random) {
    const std::size_t at = word_begin(text, random.below(text.size()));
    const std::size_t end = word_end(text, at);
    const std::string word = text.substr(at, end - at);
    const std::size_t other = word_begin(text, random.below(text.size()));
    switch (random.below(5)) {
        case 0:
            text.erase(at, end - at);
            break;
        case 1:
            text.insert(other, word + " ");
            break;
        case 2:
            text.replace(at, end - at, text.substr(other, word_end(text, other) - other));
            break;
        case 3:
            text.insert(at, kPieces[random.below(kPieces.size())]);
            break;
        default:
            text.replace(at, end - at, kPieces[random.below(kPieces.size())]);
            break;
    }
}

// Numbers for numbers, and calls for calls: what comes out is a program, mostly.
void change_numbers(std::string& text, Random& random) {
    constexpr std::array<std::string_view, 9> kNumbers{"0",       "1",      "(-1)",     "2.5",  "90",
                                                       "0.00003", "100000", "infinity", "(0/0)"};
    const std::size_t at = text.find_first_of("0123456789", random.below(text.size()));
    if (at == std::string::npos) return;
    const std::size_t begin = word_begin(text, at);
    if (std::isdigit(static_cast<unsigned char>(text[begin])) == 0) return;
    text.replace(begin, word_end(text, begin) - begin, kNumbers[random.below(kNumbers.size())]);
}

void change_lines(std::string& text, Random& random) {
    std::vector<std::string> lines = lines_of(text);
    if (lines.empty()) return;
    const std::size_t a = random.below(lines.size());
    const std::size_t b = random.below(lines.size());
    switch (random.below(4)) {
        case 0:
            lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(a));
            break;
        case 1:
            std::swap(lines[a], lines[b]);
            break;
        case 2:
            lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(a), lines[b]);
            break;
        default: {
            const auto other =
                std::next(corpus().begin(), static_cast<std::ptrdiff_t>(random.below(corpus().size())));
            const std::vector<std::string> others = lines_of(other->second);
            lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(a), others[random.below(others.size())]);
            break;
        }
    }
    text.clear();
    for (const std::string& line : lines) text += line;
}

std::string mutated(std::string text, Random& random) {
    const std::size_t changes = 1 + random.below(4);
    const std::size_t kind = random.below(5);
    for (std::size_t i = 0; i < changes && !text.empty(); ++i) {
        switch (kind == 4 ? random.below(4) : kind) {
            case 0:
                change_bytes(text, random);
                break;
            case 1:
                change_words(text, random);
                break;
            case 2:
                change_numbers(text, random);
                break;
            default:
                change_lines(text, random);
                break;
        }
    }
    return text;
}

void check_places(const std::string& text, const Diagnostics& diagnostics) {
    const std::vector<int> lines = columns(text);
    for (const Diagnostic& d : diagnostics.sorted()) {
        ASSERT_FALSE(d.message.empty());
        ASSERT_NE(find_code(d.code), nullptr) << d.code;
        if (d.place.line == 0) continue;  // of the whole program
        ASSERT_LE(d.place.line, static_cast<int>(lines.size())) << d.message;
        ASSERT_GE(d.place.column, 1) << d.message;
        ASSERT_LE(d.place.column, lines[static_cast<std::size_t>(d.place.line) - 1]) << d.message;
    }
}

struct Counts {
    std::size_t ran = 0, drew = 0, read = 0;
};

void check_one(const std::string& text, Counts& counts) {
    const Source source{"fuzz.fl", text};
    for (const bool as_2008 : {false, true}) {
        const ReadOptions wanted = options(as_2008);
        const ProgramLimits& limits = wanted.program.limits;
        Diagnostics diagnostics("fuzz.fl");
        const ProgramRun run = run_program(source, wanted, diagnostics);
        ASSERT_NO_FATAL_FAILURE(check_places(text, diagnostics));
        ASSERT_LE(run.steps, limits.steps);
        ASSERT_LE(run.printed.size(), limits.text);
        ASSERT_LE(run.trail.segments.size(), limits.trail + 1);
        const bool failed = run.status != RunStatus::ok;
        if (!as_2008) {
            ASSERT_EQ(failed, diagnostics.has_errors());
        } else if (run.status == RunStatus::runtime_fail || run.status == RunStatus::timeout) {
            ASSERT_TRUE(diagnostics.has_errors());
        }
        if (run.status == RunStatus::runtime_fail || run.status == RunStatus::timeout) {
            ASSERT_TRUE(run.trail.polygons.empty());
        }

        Diagnostics again("fuzz.fl");
        const ProgramRun same = run_program(source, wanted, again);
        ASSERT_EQ(trail_json(run), trail_json(same));
        ASSERT_EQ(diagnostics.sorted().size(), again.sorted().size());

        Diagnostics of_reading("fuzz.fl");
        const Reading reading = read(source, wanted, of_reading);
        ASSERT_NO_FATAL_FAILURE(check_places(text, of_reading));
        ASSERT_EQ(reading.printed, run.printed);
        // Definitions alone are neither, and no error.
        const bool nothing = run.defines && run.trail.segments.empty();
        ASSERT_EQ(reading.assembly || reading.design || (nothing && !of_reading.has_errors()),
                  !of_reading.has_errors());
        counts.ran += failed ? 0 : 1;
        counts.drew += run.trail.polygons.empty() ? 0 : 1;
        counts.read += reading.assembly || reading.design ? 1 : 0;
    }
}

void fuzz(std::uint64_t seed, int rounds) {
    Random random(seed);
    Counts counts;
    for (int i = 0; i < rounds; ++i) {
        const auto start =
            std::next(corpus().begin(), static_cast<std::ptrdiff_t>(random.below(corpus().size())));
        const std::string text = mutated(start->second, random);
        check_one(text, counts);
        if (testing::Test::HasFatalFailure()) {
            ADD_FAILURE() << "seed " << seed << ", round " << i << ", of " << start->first << ":\n" << text;
            return;
        }
    }
    // Programs that are not run, and those that draw nothing, test only half of it.
    const auto all = static_cast<std::size_t>(2 * rounds);
    EXPECT_GT(counts.ran, all / 5);
    EXPECT_GT(counts.drew, all / 20);
    EXPECT_GT(counts.read, all / 40);
}

TEST(FlatLangRunFuzz, TheCorpusIsRun) {
    ASSERT_GE(corpus().size(), 10U);
    for (const auto& [name, text] : corpus()) {
        Counts counts;
        check_one(text, counts);
        EXPECT_EQ(counts.ran > 0, name != "endless.fl") << name;
        if (testing::Test::HasFatalFailure()) ADD_FAILURE() << name;
    }
}

TEST(FlatLangRunFuzz, MutatedPrograms) { fuzz(1, test::sanitized_count(600)); }

TEST(LongFlatLangRunFuzz, ManyMutatedPrograms) {
    for (std::uint64_t seed = 2; seed < 12; ++seed) fuzz(seed, 3'000);
}

}  // namespace
}  // namespace popup::flatlang
