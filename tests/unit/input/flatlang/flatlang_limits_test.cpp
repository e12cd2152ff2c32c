// Programs that are not trusted: what ends them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "input/flatlang/read.h"
#include "support/flatlang_run.h"
#include "support/sanitized.h"

namespace popup::flatlang {
namespace {

using test::Ran;
using test::run;
using test::with_files;

ProgramLimits small() { return {.steps = 20'000, .depth = 50, .values = 2'000, .text = 1'000, .trail = 200}; }

TEST(FlatLangLimits, LimitsEndProgramsWithAnErrorThatNamesTheOption) {
    const std::vector<std::pair<std::string, std::string>> wanted{
        {"while (true) x = 1 done", "--max-steps"},
        {"repeat (infinity) done", "--max-steps"},
        {"define f() f() done f()", "--max-depth"},
        {"l = [1] while (true) l = append(l, l) done", "--max-values"},
        {"l = [] repeat (900) l = cons(2, l) done subList(2, l, [2, 2])", "--max-values"},
        {"s = \"ab\" while (true) s = s + s done", "--max-text"},
        {"while (true) print(\"line\") done", "--max-text"},
        {"while (true) forward(1) done", "--max-trail"},
        {"shape(\"s\") repeat (90) forward(1) done done repeat (9) draw(\"s\") done", "--max-trail"},
    };
    for (const auto& [program, option] : wanted) {
        ReadOptions options = with_files({});
        options.program.limits = small();
        const Ran made = run("\n" + program, options);
        ASSERT_EQ(made.findings.size(), 1U) << program << made.told();
        EXPECT_EQ(made.findings[0].code, "flatlang-limit") << program;
        EXPECT_EQ(made.findings[0].place.line, 2) << program;
        ASSERT_FALSE(made.findings[0].hints.empty());
        EXPECT_NE(made.findings[0].hints.back().find(option + " N"), std::string::npos) << made.told();
        EXPECT_EQ(made.result.status, RunStatus::timeout);
        EXPECT_LE(made.result.steps, options.program.limits.steps);
    }
    EXPECT_EQ(run("while (true) done").result.steps, 10'000'000U);
}

TEST(FlatLangLimits, CopiesOfElementsAreSteps) {
    const std::string program = "l = [] repeat (800) l = cons(1, l) done repeat (400) rev(l) done";
    EXPECT_GE(run(program).result.steps, 400U * 800U / 8U);
}

const std::uint64_t kSlower = popup::test::kSanitized ? 10 : 1;
// AddressSanitizer takes an exception that leaves more than 64 MB of stack for a fault.
const std::uint64_t kDeepest = popup::test::kSanitized ? 3'000 : 100'000;

TEST(FlatLangLimits, CallsMayStandAHundredThousandDeep) {
    ReadOptions options = with_files({});
    options.program.limits.depth = kDeepest;
    const std::string program = "define f(n) if (n > 0) a = ((1 + f(n - 1))) else 0 done done print(f(";
    EXPECT_EQ(run(fmt::format("{}{}))", program, kDeepest - 2), options).printed(),
              fmt::format("{}.0\n", kDeepest - 2));
    EXPECT_EQ(run(program + "infinity))", options).sentences(),
              fmt::format("1:34 calls stand {} deep within each other\n", kDeepest));
}

// What hides much work, or much memory, in few steps.
const std::vector<std::pair<std::string, std::string>>& hostile_programs() {
    static const std::vector<std::pair<std::string, std::string>> all{
        {"loop", "while (true) done"},
        {"repeat", "repeat (infinity) i = 1 done"},
        {"texts", "s = \"abcdefgh\" while (true) s = s + s done"},
        {"lists", "l = [1] while (true) l = append(l, l) done"},
        {"lists within lists", "l = [1] while (true) l = [l, l] done"},
        {"lists deep within lists", "l = [1] while (true) l = [l] done"},
        {"recursion", "define f(n) f(n + 1) done f(1)"},
        {"eval", "while (true) eval(\"1\") done"},
        {"eval of itself", "s = \"eval(s)\" eval(s)"},
        {"definitions", "i = 0 while (true) i = i + 1 eval(\"define f(x) x + x done a = \" + i) done"},
        {"new names", "i = 0 while (true) i = i + 1 eval(\"v\" + i) done"},
        {"new members",
         "o = object(\"o\") while (true) i = i + 1 o.m = eval(\"o.m\" + (i % 9999) + \" = 1\") done"},
        {"a long text evaluated", "s = \"1 + 1 \" repeat (20) s = s + s done eval(s)"},
        {"load of itself", "load(\"self.fl\")"},
        {"load for ever", "while (true) load(\"other.fl\") done"},
        {"load of nothing", "while (true) load(\"nothing.fl\") done"},
        {"load of the kit", "while (true) load(\"kit/all.fl\") done"},
        {"shapes", "while (true) shape(\"s\") done done"},
        {"growing shapes",
         "shape(\"s\") forward(1) done while (true) shape(\"s\") draw(\"s\") draw(\"s\") done done"},
        {"shapes within shapes", "define f() shape(\"a\") f() done done f()"},
        {"replaceAll that grows",
         "mark(\"a\") forward(1) mark(\"b\") while (true) replaceAll (\"a\", \"b\") mark(\"b\") "
         "forward(1) mark(\"a\") forward(2) mark(\"b\") done done"},
        {"replaceAll that looks",
         "mark(\"a\") forward(1) mark(\"b\") mark(\"c\") repeat (30000) forward(1) done "
         "while (true) replaceAll (\"a\", \"b\") forward(2) done done"},
        {"replace and look",
         "mark(\"a\") forward(1) mark(\"b\") repeat (30000) forward(1) done while (true) replace "
         "(\"a\", \"b\") forward(2) done pos() done"},
        {"marks",
         "shape(\"s\") mark(\"b\") done repeat (30000) mark(\"a\") done while (true) backto(\"b\") done"},
        {"from", "mark(\"a\") define f() from (\"a\", \"a\") f() done done f()"},
        {"a text of itself", "o = object(\"x\") o.__str__ = [o, o] print(o)"},
        {"texts of itself compared", "o = object(\"x\") o.__str__ = [o, o] while (true) eq(o, o) done"},
        {"long texts compared",
         "s = \"abcdefgh\" repeat (14) s = s + s done t = s + \"\" while (s == t) done"},
        {"long texts kept",
         "s = \"abcdefgh\" repeat (14) s = s + s done l = [] while (true) l = cons(s, l) done"},
        {"long marks", "s = \"abcdefgh\" repeat (14) s = s + s done while (true) mark(s) done"},
        {"a long number", "s = \"1\" repeat (18) s = s + s done while (true) forward(s) done"},
        {"one object in debug",
         "o = object(\"x\") s = \"abc\" repeat (14) s = s + s done o.__str__ = s l = [o] "
         "repeat (12) l = append(l, l) done debug(l)"},
        {"files asked for", "s = \"a\" repeat (14) s = s + s done while (true) hpgl(s) done"},
        {"elements put in", "l = [1, 1] while (true) insList(1, [1, 1], l) done"},
        {"source", "define f(a) repeat (3) a + a * a done done while (true) source(source(f)) done"},
        {"printing", "while (true) print(\"hello\") done"},
        {"showSoup", "mark(\"a\") repeat (9000) forward(1) backto(\"a\") done while (true) showSoup() done"},
        {"forward", "while (true) forward(1) left(1) done"},
        {"far away", "repeat (infinity) forward(infinity) left(90) done"},
        {"no place", "forward(1 / 0) left(0 / 0) while (true) drawto(pos() * infinity) facedir(dir()) done"},
        {"clear", "while (true) clear() done"},
        {"a large card", "c = popup(infinity, 1)"},
        {"lines on a card", "c = popup(8, 6) while (true) drawline(0, [-1, 0], [1, 1]) done"},
        {"steps on steps",
         "c = popup(8, 6) b = step(c, [-1, 1], [-1, -1], [1, 1], [1, -1]) while (true) "
         "b = step(b.left, [-1, 1], [-1, -1], [1, 1], [1, -1]) done"},
        {"points of a line",
         "c = popup(8, 6) l = [[0, 0]] repeat (14) l = append(l, l) done while (true) drawline(0, "
         "l) done"},
        {"at the end", "define __at_end() while (true) done done"},
    };
    return all;
}

void expect_ends(std::uint64_t divisor, bool as_2008) {
    for (const auto& [name, program] : hostile_programs()) {
        ReadOptions options = with_files({{"self.fl", "load(\"self.fl\")"}, {"other.fl", "x = 1"}});
        options.program.as_2008 = as_2008;
        ProgramLimits& limits = options.program.limits;
        limits.steps /= divisor;
        limits.values /= divisor;
        limits.text /= divisor;
        limits.trail /= divisor;
        Diagnostics diagnostics("main.fl");
        const Reading reading = read({"main.fl", program}, options, diagnostics);
        if (as_2008) continue;  // what is wrong in texts is no error there, and there are no cards
        EXPECT_FALSE(reading.assembly || reading.design) << name;
        std::size_t located = 0;
        for (const Diagnostic& one : diagnostics.sorted()) {
            if (one.severity == Severity::error && one.place.line == 1) ++located;
        }
        EXPECT_EQ(located, 1U) << name;
    }
}

TEST(FlatLangHostile, ProgramsEndWithALocatedError) { expect_ends(20 * kSlower, false); }
TEST(FlatLangHostile, ProgramsEndIn2008Mode) { expect_ends(50 * kSlower, true); }
TEST(LongFlatLangHostile, ProgramsEndWithinTheUsualLimits) { expect_ends(kSlower, false); }

}  // namespace
}  // namespace popup::flatlang
