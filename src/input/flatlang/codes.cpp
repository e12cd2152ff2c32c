#include "input/flatlang/codes.h"

#include <array>

namespace popup {
namespace {

constexpr std::array kFlatlangCodes = std::to_array<CodeInfo>({
    {"flatlang-argument-count", Severity::warning, "a function is called with too few or too many arguments",
     "A FlatLang function takes exactly the arguments that its definition names; a builtin may have some "
     "that can be left out. A call with another number of them does nothing, and its value is nil: so the "
     "language has it. What was to be drawn there is missing. Correct the call, or the definition."},
    {"flatlang-bad-outline", Severity::error, "an outline that cannot be cut",
     "A closed loop of the turtle's trail crosses itself or another loop of its part, runs over the same "
     "line twice, or has no area. It says nothing of what is paper and what is hole there. The place given "
     "is the call that began the part. Lift the pen with up() on the way from one outline to the next, and "
     "let loops that belong to different pieces be different parts."},
    {"flatlang-card-and-parts", Severity::error, "a program makes a card and draws parts besides",
     "A FlatLang program makes either a pop-up card, from its call of popup() on, or a sheet of cuts and "
     "folds, from its call of sheet() on, or the parts that its turtle draws: outputs differ, and so does "
     "what is checked. Write two programs, which may load() what "
     "they have in common."},
    {"flatlang-limit", Severity::error, "a program uses up what it may",
     "Programs are run within limits, so that one that never ends, or that makes ever more, does not take "
     "the machine with it: the number of steps, of calls within calls, of values, the length of texts and "
     "of the turtle's trail. Usually a loop's condition never becomes false at the place given, or a "
     "function calls itself without an end. If the program is right and only large, raise the limit with "
     "the option that the message names."},
    {"flatlang-no-parts", Severity::error, "a program draws no closed outline",
     "Parts are cut along closed loops of the turtle's trail whose points lie in one plane, and there is "
     "none. The pen may have been up, the turtle may have missed its beginning by more than 0.0001 inches, "
     "or functions were defined but never called. --emit trail prints what was drawn."},
    {"flatlang-no-such-mark", Severity::warning, "a turtle is sent back to a mark that is not there",
     "backto() looks for the mark from where the turtle stands back along its way to the beginning; what "
     "was drawn after going back before is another branch, and is not looked at. There is no such mark, so "
     "the turtle stays where it is: so the language has it. Correct the name, or set the mark with mark() "
     "before."},
    {"flatlang-not-a-list", Severity::warning, "a loop goes over what is not a list",
     "\"for each\" takes the elements of a list, one after the other. Of anything else its block is never "
     "run, "
     "and the program goes on: so the language has it. Give it a list, such as [1, 2, 3], or "
     "count with repeat (N)."},
    {"flatlang-not-loaded", Severity::warning, "a file to load was not found, or may not be read",
     "load() looks below the program's own folder, then in the folders that -I names, and for names that "
     "begin with kit/ in the kit that comes with popupc; nothing else is read, wherever links or .. lead. "
     "The program went on without the file. Correct the name, or name its folder with -I."},
    {"flatlang-open-lines", Severity::remark, "lines that are no part of a closed outline are not cut",
     "Only closed loops in one plane are outlines. What else the turtle drew with its pen down stands in "
     "the model, but on no sheet; of a part that has nothing else this is a warning. Where lines were to "
     "be cut, close them; where they only lead from one outline to the next, lift the pen with up() and "
     "the message goes."},
    {"flatlang-outlines-overlap", Severity::warning, "loops drawn before the first part cross one another",
     "A closed loop of the turtle's trail crosses or touches itself, or overlaps another in part. Within a "
     "part that begins with part() this is an error. Before the first part each outermost loop is a piece "
     "of its own, so nothing is in doubt but whether it is meant: overlapping pieces are cut apart from "
     "each other, and of a loop that crosses itself all that it goes round is paper. A loop in which "
     "others lie side by side until nothing is left makes no piece: these are holes. Often it is the "
     "turtle's own arrow, drawn with the pen down."},
    {"flatlang-output-ignored", Severity::remark, "a program asks for a file of its own",
     "hpgl() and laser() wrote files from within a program. Programs are not trusted with that here: what "
     "is written, and where, is said on the command line alone, with -o. The calls have no effect; take "
     "them out, or leave them for other interpreters."},
    {"flatlang-runtime", Severity::error, "a program does what cannot be done",
     "The program was ended at the place given: it went back to a mark that is not there, drew a shape "
     "that was never recorded, took an element beyond the end of a list, divided whole numbers by zero, or "
     "used a value of the wrong type. What it did so far is of no use, so nothing is made of it. --emit "
     "trail prints what was drawn until then."},
    {"flatlang-syntax", Severity::error, "a text that is not a FlatLang program",
     "What stands at the place given cannot stand there; the message says what could. Statements are not "
     "separated by anything, so the mistake may lie before: a missing bracket or quotation mark, or a "
     "missing done, shows only where the next thing begins. Comments begin with a semicolon. Nothing was "
     "run."},
    {"flatlang-too-deep", Severity::error, "brackets or blocks nested too deep",
     "Brackets and blocks of a FlatLang program stand at most 250 deep within each other, and at most "
     "about 1000 operators hang on one another, as in a + a + a. No program written by hand comes near to "
     "that; one made by another program may. Give parts of the expression names, or move inner blocks into "
     "functions."},
    {"flatlang-unknown-function", Severity::warning, "a function is called that there is not",
     "There is no builtin of this name, and no definition of it has been run yet: a function exists once "
     "its define has been passed, and a file once it has been loaded. The call does nothing, and its value "
     "is nil: so the language has it. Correct the name, load the file that has the function, or move the "
     "call below the definition."},
    {"flatlang-unknown-variable", Severity::warning, "a variable is read that nothing sets",
     "Neither the program nor a file that it loads assigns a variable of this name, has a parameter, a "
     "function or a member that is called so, or is given it with -D. Its value is nil, and where a number "
     "is wanted nil is 0: so the language has it. Mostly the name is misspelt; where nil is meant, write "
     "nil."},
    {"flatlang-unused-definition", Severity::warning, "a value given with -D is not used",
     "-D NAME=VALUE sets a global variable before the program begins, and keeps the value when the program "
     "gives the variable its own at the top level. This program neither reads nor sets a variable of that "
     "name, so the output does not depend on it. The name may be misspelt; case counts."},
});

}  // namespace

std::span<const CodeInfo> flatlang_codes() { return kFlatlangCodes; }

}  // namespace popup
