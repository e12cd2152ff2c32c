// The input languages: what can be read, and what is known when it has been.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "popup/assembly.h"
#include "popup/crease_pattern.h"
#include "popup/design.h"

namespace popup {

// What a program may use up before it is stopped. All are at least 1.
struct ProgramLimits {
    std::uint64_t steps = 10'000'000;  // evaluations, and elements that are copied or compared
    std::uint64_t depth = 1'000;       // calls within calls; at most 100'000
    std::uint64_t values = 5'000'000;  // elements of lists, members and variables that live at a time
    std::uint64_t text = 64u << 20;    // bytes of one text, and of all that is printed
    std::uint64_t trail = 2'000'000;   // operations of the turtle
};

// Of inputs that are programs.
struct ProgramOptions {
    // Global variables that stand before the program begins, and replace what it gives them first at its top
    // level. A value that is a number is one, `true` and `false` are booleans, all else is text.
    std::vector<std::pair<std::string, std::string>> definitions;
    std::vector<std::string> folders;  // where `load` looks after the program's own folder, in this order
    bool as_2008 = false;              // the original interpreter's behaviour, oddities included
    ProgramLimits limits;
    // How a file that `load` names is read, and a picture that a document names: the disk, where it is empty.
    // nullopt: there is none.
    std::function<std::optional<Source>(const std::string& path)> read_file;
    // What such a file holds in place of what the disk has, as when an editor has it open: asked before the
    // disk, and before read_file. nullopt: nothing; the disk. May be empty.
    std::function<std::optional<std::string>(const std::string& path)> overlay = {};
};

// What a line of a drawing was drawn for.
enum class DrawnUse {
    cut,
    fold,  // a mountain or a valley fold, as it turns out
    mountain,
    valley,
    print,   // not cut, but on the paper
    ignore,  // nothing of the sheet
};
inline constexpr std::array<std::string_view, 6> kDrawnUseNames{"cut",    "fold",  "mountain",
                                                                "valley", "print", "ignore"};

// What is drawn that way means that.
struct LineRule {
    // A colour of strokes, or a word of the name of a layer, a class or an id, whatever its case.
    std::string name;
    DrawnUse use = DrawnUse::cut;
};

// What a drawing shows.
enum class DrawnAs {
    parts,   // flat parts
    card,    // the sheet of a pop-up card, with its cuts and folds, whose elements are found
    folded,  // a sheet with cuts and folds, of which nothing else is known
};

// Of inputs that are drawings.
struct DrawingOptions {
    // None: parts; of formats whose layers say what lines are (DXF) a folded sheet where any is a fold.
    std::optional<DrawnAs> as = {};
    std::vector<LineRule> lines;  // above all that the drawing itself tells; the first that fits counts
};

struct ReadOptions {
    bool strict = false;   // unknown markup is an error, not a warning
    std::string language;  // name of a row of language_table(); empty: by the source's suffix
    ProgramOptions program;
    DrawingOptions drawing = {};
    std::optional<int> frame = {};  // of files with several (FOLD): 0 is the first; none: the crease pattern
};

// What a source describes: the design of a card, which is still to be checked and assembled; a crease
// pattern, which is still to be folded; or an assembly that needs neither: flat parts, and assemblies that
// were written as such. At most one of them; none where there are errors, or only definitions for others.
struct Reading {
    std::optional<Design> design;
    std::optional<CreasePattern> creases;
    std::optional<Assembly> assembly;  // its pieces have paper; file and stem are not set
    std::string printed;               // what a program printed, also before an error; each line ends with \n
    std::vector<std::string> files;    // others that were read, once each, in the order in which they were
    // Others that were looked for in vain, once each, sorted: were they there, the reading might be another.
    std::vector<std::string> missing;
};

// One row an input language.
struct Language {
    std::string_view name;
    std::string_view suffix;  // ".xml"
    std::string_view about;
    Reading (*read)(const Source&, const ReadOptions&, Diagnostics&) = nullptr;
    bool drawn = false;  // DrawingOptions say what a source of it describes
    // Of these: every source describes flat parts where DrawingOptions::as does not say otherwise.
    bool only_parts = false;
    // Directories that are walked are searched for it. Not of what others may have put there as pictures.
    bool walked = true;
    // The source's own text with the design's changed values written over the old ones and what is dropped
    // taken out; everything else, comments and layout included, stays byte for byte. Precondition: `design`
    // came from read() of this very source. Null: it cannot be written back.
    std::string (*patch)(const Source&, const Design&) = nullptr;
    // True of a text that cannot be in another language; for standard input, which has no suffix. May be
    // null.
    bool (*recognises)(std::string_view text) = nullptr;
    // What the source draws before anything is made of it, as JSON, for `--emit trail`; also of sources with
    // errors, as far as they were run. Others that were read are added to `files`, as in Reading. Null: it
    // has no trail.
    std::string (*trail)(const Source&, const ReadOptions&, Diagnostics&,
                         std::vector<std::string>& files) = nullptr;
};
std::vector<Language> const& language_table();

// The row that `language` names; if it is empty, the row of the source's suffix, and for standard input the
// row that recognises its text, else the first. Null: none.
const Language* find_language(const Source& source, std::string_view language);
// "xml (.xml), svg (.svg)": what there is, for hints.
std::string known_languages();

// Reads a source. Every syntax or content problem is a located diagnostic; also when the source's language is
// not known. Cost: linear in bytes, of programs in the steps they take. Never recurses over the depth of a
// document.
Reading read_source_text(const Source& source, const ReadOptions& options, Diagnostics& diagnostics);
// The same of sources that must be designs: others are a `no-design` error.
std::optional<Design> read_design(const Source& source, const ReadOptions& options, Diagnostics& diagnostics);

}  // namespace popup
