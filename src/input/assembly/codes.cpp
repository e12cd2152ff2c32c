#include "input/assembly/codes.h"

#include <array>

namespace popup {
namespace {

constexpr std::array kAssemblyCodes = std::to_array<CodeInfo>({
    {"assembly-fault", Severity::error, "an assembly that does not hold what assemblies promise",
     "Every value of the assembly can be read, but together they make no paper: an outline crosses itself, "
     "the "
     "two sides of a hinge differ in length, a joint needs a plate that nothing has placed before, a seam "
     "has "
     "no glue, the sides of a four-bar do not fold flat. All later stages rely on these promises, so nothing "
     "is built. Correct what the message names; docs/assembly.md lists the promises."},
    {"assembly-name", Severity::error, "an assembly names what it does not have",
     "Plates and pieces are named by their names, and pictures by their digests. This name is none of those "
     "in the document's own lists. Correct its spelling, or add what it names."},
    {"assembly-syntax", Severity::error, "an assembly that is not JSON",
     "The text of an assembly is one JSON object, as popupc build --emit assembly prints it. This text "
     "breaks "
     "the rules of JSON at the place named, has two members of one name in an object, or is nested deeper "
     "than any assembly. Correct it there, or print the assembly anew."},
    {"assembly-value", Severity::error, "a value of an assembly that is missing or of the wrong sort",
     "Each part of an assembly has members of fixed names and sorts, such as points [x, y] in millimetres "
     "and "
     "colours \"#rrggbb\". This one is missing, is something else, or is out of range. The message says what "
     "belongs there; docs/assembly.md describes all members."},
});

}  // namespace

std::span<const CodeInfo> assembly_codes() { return kAssemblyCodes; }

}  // namespace popup
