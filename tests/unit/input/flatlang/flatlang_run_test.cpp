// What programs do when they are run, as popupc-flatlang(7) has it.
#include "support/flatlang_run.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "input/flatlang/read.h"
#include "input/flatlang/run/interpreter.h"
#include "input/flatlang/trail_json.h"

namespace popup::flatlang {
namespace {

using test::Files;
using test::Ran;
using test::run;
using test::run_2008;
using test::run_with;
using test::with_files;

// What print() writes of expressions, without the end of the line; no finding may come of it.
std::string value(const std::string& expression) {
    const Ran made = run("print(" + expression + ")");
    EXPECT_EQ(made.told(), "") << expression;
    return made.printed().substr(0, made.printed().size() - 1);
}

// --- values

TEST(FlatLangRun, NumbersAreSinglePrecisionAndPrintAsTheyAre) {
    EXPECT_EQ(value("5"), "5.0");
    EXPECT_EQ(value("0.1"), "0.10000000149011612");
    EXPECT_EQ(value("0.1 + 0.2"), "0.30000001192092896");
    EXPECT_EQ(value("100000000"), "1.0E8");
    EXPECT_EQ(value("9999999"), "9999999.0");
    EXPECT_EQ(value("0.001"), "0.0010000000474974513");
    EXPECT_EQ(value("0.0005"), "5.000000237487257E-4");
    EXPECT_EQ(value("1 / 0"), "Infinity");
    EXPECT_EQ(value("-1 / 0"), "-Infinity");
    EXPECT_EQ(value("0 / 0"), "NaN");
    EXPECT_EQ(value("infinity"), "1.7976931348623157E308");
    EXPECT_EQ(value("7 % 4"), "3.0");
    EXPECT_EQ(value("-7.9 % 4.9"), "-3.0");
    EXPECT_EQ(value("1 + 2 * 3 - 4 / 2"), "5.0");
    EXPECT_EQ(value("10 - 4 - 3"), "3.0");
}

TEST(FlatLangRun, AMinusTurnsTheSign) {
    EXPECT_EQ(value("-(0 - 5)"), "5.0");
    EXPECT_EQ(value("-\"7\""), "-7.0");
    EXPECT_EQ(value("-\"-7\""), "7.0");
    EXPECT_EQ(value("-nil"), "0.0");
    EXPECT_EQ(value("+4"), "4.0");
    EXPECT_EQ(run_2008("print(-(0 - 5))").printed(), "0.0\n");
}

TEST(FlatLangRun, PlusJoinsTextsAndOtherOperatorsOfOtherValuesGiveNil) {
    EXPECT_EQ(value("\"n = \" + 5"), "n = 5.0");
    EXPECT_EQ(value("1 + \"2\""), "1.02");
    EXPECT_EQ(value("[1] + true"), "[1.0]true");
    EXPECT_EQ(value("\"6\" * 2"), "nil");
    EXPECT_EQ(value("[1] - [1]"), "nil");
    EXPECT_EQ(value("true / 2"), "nil");
}

TEST(FlatLangRun, VectorsAreAddedAndScaled) {
    const std::string here = "forward(2) v = pos() print(";
    EXPECT_EQ(run(here + "v, v + v, v - v)").printed(), "{0.0, 2.0, 0.0} {0.0, 4.0, 0.0} {0.0, 0.0, 0.0}\n");
    EXPECT_EQ(run(here + "v * 3, 3 * v, v / 4)").printed(),
              "{0.0, 6.0, 0.0} {0.0, 6.0, 0.0} {0.0, 0.5, 0.0}\n");
    EXPECT_EQ(run(here + "v.x, v.y, v.z, v * v)").printed(), "0.0 2.0 0.0 nil\n");
}

TEST(FlatLangRun, ComparisonsKnowNumbersTextsTruthsAndObjects) {
    EXPECT_EQ(value("[1 < 2, 2 <= 2, 1 > 2, 2 >= 3, 1 == 1, 1 != 1]"),
              "[true, true, false, false, true, false]");
    EXPECT_EQ(value("[\"a\" == \"a\", \"a\" != \"a\", \"a\" < \"b\", true == true, true != false]"),
              "[true, false, false, true, true]");
    EXPECT_EQ(value("[nil == 1, nil != 1, nil == nil, nil != nil, [1] == [1], [1] != [1], 1 == \"1\"]"),
              "[false, true, false, false, false, false, false]");
    EXPECT_EQ(run("a = object(\"a\") b = a c = object(\"a\") print(a == b, a == c, a != c)").printed(),
              "true false true\n");
}

TEST(FlatLangRun, ThereAreTwoKindsOfTruth) {
    const std::string program =
        "for each (v : [nil, false, 0, \"\", [], true, 1, \"a\", [0], \"true\"])\n"
        "  n = 0 while (v and true) if (n == 0) n = 1 v = false else v = false done done\n"
        "  if (v) k = \"yes\" else k = \"no\" done print(k, n)\n"
        "done";
    EXPECT_EQ(run(program).printed(),
              "no 0.0\nno 0.0\nno 0.0\nno 0.0\nno 0.0\nno 1.0\nyes 0.0\nyes 0.0\nyes 0.0\nno 1.0\n");
    EXPECT_EQ(run("while (1) print(1) done print(1 and 1, \"true\" or 0)").printed(), "false true\n");
}

TEST(FlatLangRun, AndAndOrEvaluateBothSides) {
    EXPECT_EQ(run("define f() print(\"f\") true done a = true or f() b = false and f()").printed(), "f\nf\n");
}

// --- statements

TEST(FlatLangRun, StatementsAreChosenAndRepeated) {
    EXPECT_EQ(run("for each (i : [1, 2, 3]) if (i == 1) print(\"a\") alt (i == 2) print(\"b\") else "
                  "print(\"c\") done done")
                  .printed(),
              "a\nb\nc\n");
    EXPECT_EQ(run("n = 0 repeat (2.9) n = n + 1 done repeat (-1) n = 9 done print(n)").printed(), "2.0\n");
    EXPECT_EQ(run("n = 3 while (n > 0) n = n - 1 print(n) done").printed(), "2.0\n1.0\n0.0\n");
    EXPECT_EQ(run("for each (i : [1, 2, 3, 4]) (i % 2 == 0) print(i) done").printed(), "2.0\n4.0\n");
    const auto none = run("print(1)\nfor each (i : 5) print(i) done");
    EXPECT_EQ(none.printed(), "1.0\nexpected list in foreach but got NUMBER\n");
    ASSERT_EQ(none.findings.size(), 1U);
    EXPECT_EQ(none.findings[0].code, "flatlang-not-a-list");
    EXPECT_EQ(none.findings[0].place.line, 2);
}

TEST(FlatLangRun, NothingSeparatesStatementsSoALineGoesOn) {
    EXPECT_EQ(run("a = 10\n-3 print(a)").printed(), "7.0\n");
    EXPECT_EQ(run("define f(x) print(x) done f\n(3)").printed(), "3.0\n");
}

// --- functions and variables

TEST(FlatLangRun, AFunctionIsWorthItsLastExpression) {
    EXPECT_EQ(run("define f(n) if (n > 1) \"many\" else \"few\" done done print(f(1), f(2))").printed(),
              "few many\n");
    EXPECT_EQ(run("define f() x = 4 repeat (2) x = x + 1 done done print(f())").printed(), "6.0\n");
}

TEST(FlatLangRun, ScopeIsDynamic) {
    EXPECT_EQ(run("define g() seen = a a = 2 b = 3 print(seen) done\n"
                  "define f() a = 1 g() print(a, b) done f() print(a, b)")
                  .printed(),
              "1.0\n2.0 nil\nnil nil\n");
    EXPECT_EQ(run("a = 1 define f(a) a = a + 1 a done print(f(5), a)").printed(), "6.0 1.0\n");
    EXPECT_EQ(
        run("if (true) inside = 1 done for each (e : [1]) lost = e done print(inside, lost, e)").printed(),
        "1.0 nil nil\n");
}

TEST(FlatLangRun, SafeFunctionsSeeTheirOwnVariablesAloneUntilTheyEnd) {
    const std::string program =
        "a = 1\nsafe define f(n) forward(1) for each (e : [n]) n = n + e done print(a, n) a = 5 a done\n"
        "print(f(2), a)";
    EXPECT_EQ(run(program).printed(), "nil 4.0\n5.0 1.0\n");
    // It ended with the first call.
    EXPECT_EQ(run_2008(program).printed(), "1.0 4.0\n5.0 5.0\n");
    EXPECT_EQ(run("safe define f() g() done define g() x = 1 x done x = 0 print(f(), x)").printed(),
              "1.0 1.0\n");
}

TEST(FlatLangRun, FunctionsAreGlobalByTheirNames) {
    EXPECT_EQ(run("define f() 1 done define f() 2 done print(f())").printed(), "2.0\n");
    EXPECT_EQ(run("define sqrt(x) \"mine\" done print(sqrt(4))").printed(), "mine\n");
    EXPECT_EQ(run("define f() 1 done define g(h) h done print(g(f))").printed(), "nil\n");
    EXPECT_EQ(run("f = 3 define f() 1 done print(f)").printed(), "3.0\n");
}

TEST(FlatLangRun, VariablesThatNothingSetsAreTold) {
    EXPECT_EQ(run("width = 2\nforward(widht) left(widht)").told(),
              "2:9 warning flatlang-unknown-variable: nothing gives widht a value, so it is nil\n"
              "  did you mean width?\n");
    // What is set somewhere, or may be, is known: later, by a member, a parameter, a loop, -D or eval().
    EXPECT_EQ(run("print(later) later = 1").told(), "");
    EXPECT_EQ(run("o = object(\"o\") o.size = 1 define get() size done print(o.get())").told(), "");
    EXPECT_EQ(run("define f(a) a done for each (b: [1]) print(f(b), nil) done").told(), "");
    EXPECT_EQ(run("o = object(\"o\") if (o.missing) print(1) done").told(), "");
    EXPECT_EQ(run("eval(\"made = 1\") print(made)").told(), "");
    EXPECT_EQ(run_with("print(given)", {{"given", "2"}}).told(), "");
    EXPECT_EQ(run_2008("print(nowhere)").told(), "");
}

TEST(FlatLangRun, UnknownFunctionsAndWrongCountsAreWarnedOfOnce) {
    const Ran unknown = run("repeat (3) fordward(1) done\nx = 1 x()");
    EXPECT_EQ(unknown.told(),
              "1:12 warning flatlang-unknown-function: there is no function fordward() here; the call does "
              "nothing\n  did you mean forward()?\n"
              "2:7 warning flatlang-unknown-function: x is a variable, not a function\n");
    EXPECT_EQ(unknown.result.status, RunStatus::ok);
    EXPECT_EQ(run("define f(a, b) 1 done\nprint(f(1))").told(),
              "2:7 warning flatlang-argument-count: f() takes 2 arguments, not 1; it is not called\n");
    EXPECT_EQ(run("forward()").told(),
              "1:1 warning flatlang-argument-count: forward() takes 1 argument, not 0; it is not called\n");
    EXPECT_EQ(run("print(sqrt(4, 5))").told(),
              "1:7 warning flatlang-argument-count: sqrt() takes 1 argument, not 2; those beyond are "
              "disregarded\n");
    EXPECT_EQ(run("x = sqrt()").told(), "1:5 error flatlang-runtime: sqrt() takes 1 argument, not 0\n");
    EXPECT_EQ(run_2008("fordward(1) forward()").told(), "");
}

TEST(FlatLangRun, AFunctionWithoutABodyCannotBeCalled) {
    EXPECT_EQ(run("define f() done\nf()").sentences(),
              "1:1 f() is called, and there is nothing between its name and done\n");
}

// --- objects and lists

TEST(FlatLangRun, MembersAreSetAndRead) {
    EXPECT_EQ(
        run("o = object(\"box\") o.a = 1 o.b = o.a + 1 p = o p.a = 5 print(o, o.a, o.b, o.none)").printed(),
        "box 5.0 2.0 nil\n");
    EXPECT_EQ(run("t = \"text\" t.size = 4 print(t, t.size) made.up = 1 print(made, made.up)").printed(),
              "text 4.0\n{object} 1.0\n");
    EXPECT_EQ(run("a = 7 o = object(\"o\") print(o.a)").printed(), "7.0\n");
}

TEST(FlatLangRun, InAMethodNamesMeanMembers) {
    EXPECT_EQ(run("define area(by) width * width * by done\nw = object(\"w\") w.width = 3 w.area = area\n"
                  "print(w.area(2), w.by, by)")
                  .printed(),
              "18.0 2.0 nil\n");
    EXPECT_EQ(
        run("define rename(to) name = to done o = object(\"o\") name = \"g\" o.rename(\"m\") print(o.name, "
            "name)")
            .printed(),
        "m g\n");
}

TEST(FlatLangRun, ListsHandOutTheirElementsAndTakeInCopies) {
    EXPECT_EQ(run("l = [1, [2, 3]] print(l[0], l[1][1], l.n, l[5], l[0 - 3])").printed(),
              "1.0 3.0 2.0 nil 1.0\n");
    EXPECT_EQ(run("l = [1] m = [l, l] x = first(l) x.tag = \"t\" y = l[0] print(y.tag, m)").printed(),
              "t [[1.0], [1.0]]\n");
    EXPECT_EQ(run("l = [1, 2]\nprint(l[2])").sentences(),
              "2:7 there is no element 2: the list has 2, counted from 0\n");
    EXPECT_EQ(run("l = [1, 2]\nprint(l[1][0])").sentences(),
              "2:7 only a list has elements, and this is a number (2.0)\n");
}

// --- each builtin

TEST(FlatLangRun, Mathematics) {
    EXPECT_EQ(value("[sqrt(4), sin(0), cos(0), tan(0), asin(1), acos(1), atan(0), pi()]"),
              "[2.0, 0.0, 1.0, 0.0, 1.5707963267948966, 0.0, 0.0, 3.141592653589793]");
    EXPECT_EQ(value("sqrt(\"16\")"), "4.0");
    EXPECT_EQ(value("sqrt(0 - 1)"), "NaN");
}

TEST(FlatLangRun, BuiltinsOfLists) {
    const std::map<std::string, std::string> wanted{
        {"cons(0, [1, 2])", "[0.0, 1.0, 2.0]"},
        {"first([1, 2])", "1.0"},
        {"first([])", "nil"},
        {"rest([1, 2, 3])", "[2.0, 3.0]"},
        {"rest([])", "[]"},
        {"last([1, 2])", "2.0"},
        {"last([])", "nil"},
        {"element([4, 5, 6], 1)", "5.0"},
        {"element([4], 7)", "nil"},
        {"append([1], [2])", "[1.0, 2.0]"},
        {"append2([1], 2)", "[1.0, 2.0]"},
        {"join(1, [2, 3])", "[1.0, 2.0, 3.0]"},
        {"rev([1, 2, 3])", "[3.0, 2.0, 1.0]"},
        {"flatten([1, [2, [3]], []])", "[1.0, 2.0, 3.0]"},
        {"eq([1, \"a\"], [1.0, \"a\"])", "true"},
        {"eq(1, 2)", "false"},
        {"find(2, [1, 2, 3, 2, 4], 0)", "[2.0, 3.0, 2.0, 4.0]"},
        {"find(2, [1, 2, 3, 2, 4], 1)", "[2.0, 4.0]"},
        {"findIndexOfListWithFirst(2, [[1], [2, 5], [2, 6]], 0, 0)", "1.0"},
        {"findIndexOfListWithFirst(2, [[1], [2, 5], [2, 6]], 0, 2)", "2.0"},
        {"findIndexOfListWithFirst(3, [[1]], 0, 0)", "-1.0"},
        {"split(2, [1, 2, 3], 0)", "[[1.0], [2.0, 3.0]]"},
        {"splitAtIndex(1, [1, 2, 3])", "[[1.0], [2.0, 3.0]]"},
        {"copyList(1, 3, [1, 2, 3, 4])", "[2.0, 3.0]"},
        {"remove(2, [2, 1, 2, 2], 2)", "[1.0, 2.0]"},
        {"sub(2, 9, [1, 2, 3, 2])", "[1.0, 9.0, 3.0, 9.0]"},
        {"subList(2, [8, 9], [1, 2, 3])", "[1.0, 8.0, 9.0, 3.0]"},
        {"ins(2, 9, [1, 2, 3])", "[1.0, 9.0, 2.0, 3.0]"},
        {"insList(2, [8, 9], [1, 2, 3])", "[1.0, 8.0, 9.0, 2.0, 3.0]"},
    };
    for (const auto& [expression, text] : wanted) EXPECT_EQ(value(expression), text) << expression;
    EXPECT_EQ(run("l = [1, 2] m = cons(0, l) sub(2, 5, l) print(m)").printed(), "[0.0, 1.0, 5.0]\n");
    EXPECT_EQ(run("print(findListWithFirst(2, [[1], [2, 5]], 0))").printed(),
              "index is 1.0\nevals to true\n[2.0, 5.0]\n");
}

TEST(FlatLangRun, BuiltinsOfPrograms) {
    EXPECT_EQ(
        run("define f(a, b) repeat (a) b + \"x\" done done print(f, source(f)) print(source(source(f)))")
            .printed(),
        "f(a, b) [define, f, [(, a, , , b, )], [[repeat, (, a, ), [[(, b,  + , \"x\", )]], done]], done]\n"
        "define f ( a ,  b ) repeat ( a ) ( b  +  \"x\" ) done done\n");
    EXPECT_EQ(run("define f(a) if (a) a + 1 else f(-a, [2]) done done pprint(f)").printed(),
              "define f(a)\n  if (a)\n    (a+1)\n  else \n    f(-a, [2])\n  done\ndone\n\n");
    EXPECT_EQ(run("a = 3 print(eval(\"a = a + 1 a * 2\"), a)").printed(), "8.0 4.0\n");
    EXPECT_EQ(run("eval(\"define f() 5 done new = 1\") print(f(), new)").printed(),
              "Defined function 'f'\n5.0 nil\n");
    EXPECT_EQ(run("print(quote(1 + x), object(\"o\"))").printed(), "nil o\n");
    EXPECT_EQ(run("n = 1 n.m = 2 debug(n)").printed(), "1.0(#/Register$Num)_members={{m = 2.0} }\n");
    EXPECT_EQ(run("print(\"  a\", 1, \"\")").printed(), "a 1.0\n");
    EXPECT_EQ(run("part(\"lid\")").printed(), "Beginning a new part named lid\n");
}

TEST(FlatLangRun, WhatWasWrittenForAWindowDoesNothing) {
    const Ran made =
        run("hpgl(\"a\") laser(\"b\") setPartMode(true) showPolygons(true) showMachine() "
            "jitter(1, 2) outputMatrix(\"x\") pause(5) redraw() sketchup(\"s\") turtlexor(1)");
    EXPECT_EQ(made.told(), "");
    EXPECT_EQ(made.printed(), "");
    ASSERT_EQ(made.result.hpgl.size(), 1U);
    EXPECT_EQ(made.result.hpgl.front().name, "a");
    EXPECT_EQ(made.result.laser.front().name, "b");
    EXPECT_TRUE(made.result.part_mode);
}

TEST(FlatLangRun, TheTurtleDraws) {
    const Ran square = run("part(\"s\") repeat (4) forward(1) right(90) done up() backward(2)");
    EXPECT_EQ(square.result.trail.segments.size(), 4U);
    ASSERT_EQ(square.result.trail.polygons.size(), 1U);
    EXPECT_EQ(square.result.trail.polygons.front().points.size(), 4U);
    EXPECT_NEAR(square.result.trail.last.at.y, -2.0, 1e-12);
    EXPECT_EQ(run("left(90) forward(1) print(pos())").printed().substr(0, 5), "{-1.0");
    EXPECT_EQ(run("pitch(90) forward(2) v = pos() print(v.z)").printed(), "2.0\n");
    EXPECT_EQ(run("roll(90) print(dir())").printed(),
              "0.0 0.0 -1.0 0.0\n0.0 1.0 0.0 0.0\n1.0 0.0 0.0 0.0\n0.0 0.0 0.0 1.0\n");
    EXPECT_EQ(run("mark(\"m\") forward(1) backto(\"m\") print(pos())").printed(), "{0.0, 0.0, 0.0}\n");
    EXPECT_EQ(
        run("a = pos() forward(4) right(90) d = dir() drawto(a, 0.25) print(pos()) facedir(d) forward(1) "
            "v = pos() print(v.x, v.y)")
            .printed(),
        "{0.0, 3.0, 0.0}\n1.0 3.0\n");
    EXPECT_EQ(run("forward(1) clear() forward(2)").result.trail.segments.size(), 1U);
    EXPECT_EQ(
        run("shape(\"a\") forward(1) done shape(\"b\") forward(2) done draw(\"a\") v = pos() print(v.y)")
            .printed(),
        "1.0\n");
    EXPECT_EQ(
        run("mark(\"a\") forward(1) mark(\"b\") replace (\"a\", \"b\") forward(5) done v = pos() print(v.y)")
            .printed(),
        "5.0\n");
    EXPECT_EQ(
        run("mark(\"a\") forward(1) mark(\"b\") from (\"a\", \"b\") v = pos() print(v.y) done").printed(),
        "0.0\n1.0\n");
}

// --- what cannot be done

TEST(FlatLangRun, WhatCannotBeDoneIsToldWhereItStands) {
    const std::vector<std::pair<std::string, std::string>> wanted{
        {"x = 5 % 0", "1:5 the remainder of a division by zero is asked for\n"},
        {"forward(1) from (\"no\") up() done",
         "1:18 there is no mark \"no\" on the way back to the beginning\n"},
        {"replace (\"a\", \"b\") up() done",
         "1:1 there is no mark \"b\" with a mark \"a\" before it, on the way back to the beginning\n"},
        {"draw(\"no\")", "1:6 there is no shape \"no\"\n"},
        {"shape(\"s\") up() done draw(\"s\", \"m\")", "1:32 the shape \"s\" has no mark \"m\" to begin at\n"},
        {"drawto(5)",
         "1:8 argument 1 of drawto() is a number, where a vector, such as pos() gives, is expected\n"},
        {"drawto(pos(), \"x\")",
         "1:15 argument 2 of drawto() is a text, where a number, the fraction of the way, is expected\n"},
        {"facedir(pos())",
         "1:9 argument 1 of facedir() is a vector, where a matrix, such as dir() gives, is expected\n"},
        {"x = find(1, 2, 3)", "1:13 argument 2 of find() is a number, where a list is expected\n"},
        {"x = split(1, nil, 3)", "1:14 argument 2 of split() is nil, where a list is expected\n"},
        {"x = splitAtIndex(1, \"a\")",
         "1:21 argument 2 of splitAtIndex() is a text, where a list is expected\n"},
        {"x = remove(1, true, 3)", "1:15 argument 2 of remove() is a boolean, where a list is expected\n"},
        {"x = copyList(1, 2, 3)", "1:20 argument 3 of copyList() is a number, where a list is expected\n"},
        {"x = subList(1, [], [1])",
         "1:16 argument 2 of subList() is an empty list: there is nothing to put into the other\n"},
        {"x = findIndexOfListWithFirst(1, 2, 3, 4)",
         "1:33 argument 2 of findIndexOfListWithFirst() is a number, where a list is expected\n"},
        {"setPartMode(1)", "1:13 argument 1 of setPartMode() is a number, where true or false is expected\n"},
    };
    for (const auto& [program, sentence] : wanted) {
        const Ran made = run("; first\n" + program + "\nprint(\"not reached\")");
        EXPECT_EQ(made.sentences(), "2" + sentence.substr(1)) << program;
        EXPECT_EQ(made.printed(), "");
        EXPECT_EQ(made.result.status, RunStatus::runtime_fail);
    }
}

TEST(FlatLangRun, GoingBackToAMarkThatIsNotThereIsAWarning) {
    EXPECT_EQ(
        run("backto(\"no\") print(1)").told(),
        "1:1 warning flatlang-no-such-mark: there is no mark \"no\" on the way back to the beginning; the "
        "turtle stays\n");
}

TEST(FlatLangRun, LongTextsAreCutInMessages) {
    const Ran made = run("s = \"abcdefgh\" repeat (8) s = s + s done draw(s)");
    EXPECT_LT(made.told().size(), 300U) << made.told();
}

TEST(FlatLangRun, ATextThatIsNoProgramIsNotRun) {
    const Ran made = run("print(1)\nforward(");
    EXPECT_EQ(made.printed(), "");
    EXPECT_EQ(made.result.status, RunStatus::parse_fail);
    EXPECT_EQ(run_2008("print(1)\n)").printed(), "1.0\n");
}

// --- loaded files and evaluated texts

TEST(FlatLangRun, LoadedFilesDefineFunctions) {
    const Files files{{"lib.fl", "define twice(x) x * 2 done here = 1 print(\"loaded\")"}};
    const Ran made = run("load(\"lib.fl\") load(\"lib.fl\") print(twice(4), here)", with_files(files));
    EXPECT_EQ(made.printed(), "loaded\nloaded\n8.0 nil\n");
    EXPECT_EQ(made.result.files, std::vector<std::string>{"lib.fl"});
    EXPECT_EQ(made.told(), "");
}

TEST(FlatLangRun, FoldersAreLookedThroughInTheirOrder) {
    ReadOptions options = with_files({{"b/x.fl", "print(\"b\")"}, {"c/x.fl", "print(\"c\")"}});
    options.program.folders = {"a", "b", "c"};
    const Ran made = run("load(\"x.fl\") load(\"../c/x.fl\") load(\"../d.fl\")", options);
    EXPECT_EQ(made.printed(), "b\nc\n");
    ASSERT_EQ(made.findings.size(), 1U);
    EXPECT_EQ(made.findings[0].code, "flatlang-not-loaded");
    EXPECT_EQ(made.findings[0].place.column, 32);
}

TEST(FlatLangRun, FindingsInLoadedFilesNameThemAndStandAtTheCallInTheProgram) {
    const Files files{{"lib.fl", "\n\nx = = 3"},
                      {"run.fl", "define bad(l)\n  x = find(1, l, 0)\ndone"},
                      {"now.fl", "load(\"run.fl\")\n  nothing()\nbad(3)"}};
    EXPECT_EQ(run("\n load(\"lib.fl\")", with_files(files)).sentences().substr(0, 15), "2:2 lib.fl:3:5:");
    EXPECT_EQ(run("load(\"run.fl\")\n  bad([1]) bad(2)", with_files(files)).sentences(),
              "2:12 run.fl:2:15: argument 2 of find() is a number, where a list is expected\n");
    EXPECT_EQ(run("load(\"now.fl\")", with_files(files)).sentences(),
              "1:1 run.fl:2:15: argument 2 of find() is a number, where a list is expected\n"
              "1:1 now.fl:2:3: there is no function nothing() here; the call does nothing\n");
    EXPECT_EQ(run("x = 1\neval(\"1 + \\n\")").sentences().substr(0, 12), "2:1 eval:1:5");
    // A text that was evaluated cannot be looked up: what had it evaluated can.
    const Files evaluating{{"in.fl", "\n eval(\"5 % 0\")"}, {"out.fl", "load(\"in.fl\")"}};
    EXPECT_EQ(run("load(\"out.fl\")", with_files(evaluating)).sentences(),
              "1:1 in.fl:2:2: eval:1:1: the remainder of a division by zero is asked for\n");
    EXPECT_EQ(run("print(eval(\"forward(1) 5 % 0\"))").sentences(),
              "1:7 eval:1:12: the remainder of a division by zero is asked for\n");
}

TEST(FlatLangRun, In2008ModeAMistakeInATextEndsThatAlone) {
    const Files files{{"lib.fl", "print(\"a\") x = 5 % 0 print(\"b\")"}};
    const Ran made = run_2008("load(\"lib.fl\") print(\"c\")", files);
    EXPECT_EQ(made.printed(), "a\nc\n");
    EXPECT_EQ(made.result.status, RunStatus::ok);
    EXPECT_EQ(
        made.told(),
        "1:1 warning flatlang-runtime: lib.fl:1:16: the remainder of a division by zero is asked for\n");
}

TEST(FlatLangRun, TheKitIsAlwaysThere) {
    const Ran made = run("load(\"kit/wheel.fl\") w = wheel(1) w.draw()");
    EXPECT_EQ(made.told(), "");
    EXPECT_FALSE(made.result.trail.polygons.empty());
    EXPECT_TRUE(made.result.files.empty());
}

// --- definitions

TEST(FlatLangRun, DefinitionsStandInForTheFirstAssignmentAtTheTopLevel) {
    const std::string program = "teeth = 12 print(teeth) teeth = 7 print(teeth)";
    EXPECT_EQ(run(program).printed(), "12.0\n7.0\n");
    EXPECT_EQ(run_with(program, {{"teeth", "24"}}).printed(), "24.0\n7.0\n");
    EXPECT_EQ(run_with("print(x)", {{"x", "1"}, {"x", "2"}}).printed(), "2.0\n");
}

TEST(FlatLangRun, DefinitionsAreNumbersTruthsOrTexts) {
    EXPECT_EQ(run_with("print(a + 1, b == true, c, d, e)",
                       {{"a", "-2.5e1"}, {"b", "true"}, {"c", "12 mm"}, {"d", ""}, {"e", "false"}})
                  .printed(),
              "-24.0 true 12 mm  false\n");
}

// A parameter, the variable of a for each, and assignments in functions and files are not the program's
// default.
TEST(FlatLangRun, DefinitionsReplaceNothingElse) {
    EXPECT_EQ(
        run_with("define f(size) size + 1 done print(f(1)) size = 3 print(size)", {{"size", "9"}}).printed(),
        "2.0\n9.0\n");
    EXPECT_EQ(run_with("for each (e : [1, 2]) print(e) done e = 3 print(e)", {{"e", "9"}}).printed(),
              "1.0\n2.0\n9.0\n");
    EXPECT_EQ(run_with("define f() a = a + 1 a done print(f()) a = 3 print(a)", {{"a", "9"}}).printed(),
              "10.0\n10.0\n");
    EXPECT_EQ(run_with("o = object(\"o\") o.w = 1 w = 2 print(o.w, w)", {{"w", "9"}}).printed(), "1.0 9.0\n");
}

TEST(FlatLangRun, ADefinitionThatIsNotLookedAtIsAWarning) {
    EXPECT_EQ(run_with("teeth = 12", {{"Teeth", "24"}, {"teeth", "2"}}).told(),
              "0:0 warning flatlang-unused-definition: the program has no variable Teeth, which -D sets\n"
              "  did you mean teeth?\n");
}

// --- sameness

TEST(FlatLangRun, TheSameProgramGivesTheSameBytes) {
    const std::string program =
        "load(\"kit/gear.fl\") g = gear(12) g.draw() o = object(\"x\") o.b = 1 o.a = 2 o.c = 3 debug(o) "
        "print(pos())";
    const Ran first = run(program);
    EXPECT_EQ(first.told(), "");
    for (int i = 0; i < 3; ++i) {
        const Ran again = run(program);
        EXPECT_EQ(trail_json(first.result), trail_json(again.result));
        EXPECT_EQ(first.result.steps, again.result.steps);
    }
}

}  // namespace
}  // namespace popup::flatlang
