// Edits of documents by command: what a person does with a mouse, for scripts, makefiles and editors.
//
//     const std::vector<EditLine> edits{{{"set", "bird", "--angle", "70"}, {}}, {{"delete", "tent"}, {}}};
//     Diagnostics of_edits("edits.txt"), of_document(source.name);
//     if (const auto edited = edit_document(source, edits, {}, of_edits, of_document))
//         source.text = edited->text;  // what no edit concerns is there byte for byte
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "popup/check.h"
#include "popup/compile.h"
#include "popup/language.h"

namespace popup {

// One edit, in words: a verb and what it takes.
struct EditLine {
    std::vector<std::string> words;
    Place place;  // where it stands in a file of edits
};

// The edits of a file, one a line: words as a shell reads them. A line that begins with `#` is a comment, and
// so is what follows a `#` that stands alone. Quotes that do not end are errors.
std::vector<EditLine> read_edits(std::string_view text, Diagnostics& diagnostics);

// One row an edit, for help and manuals.
struct EditVerb {
    std::string_view name;
    std::string_view usage;  // "ID --NAME VALUE..."
    std::string_view about;  // one line
};
std::span<const EditVerb> edit_verbs();

struct EditOptions {
    bool force = false;  // also what adds an error
    ReadOptions read;
    CheckOptions check;
    // Given: all is looked at that compile() finds with these up to the pattern, collisions and tabs too, in
    // the document as it was and as it is then.
    const CompileOptions* all = nullptr;
};

struct Edited {
    std::string text;                // of the whole document; places of `of_document` are in it
    bool refused = false;            // it would have a new error: nothing is to be written
    bool examined = false;           // all was looked at, or no edit changed anything that is looked at
    std::vector<std::string> files;  // others that the document reads
};

// All edits, in their order, or none. Each sees what those before it made. Then the document is read and
// checked as always; when it has an error that it did not have before, that is refused: `edit-refused` in
// `of_edits`, at an edit that brings it, and the errors in `of_document`, unless it is forced. What else the
// checks newly find is in `of_document` too. What the policy of `of_document` makes an error is one: it is
// refused. The two may be one object. nullopt, with errors in them: the document cannot be read, or an edit
// cannot be carried out. Cost: one reading of the document, one look at what stands on what, and a check of
// what it becomes. Where that finds anything, both documents are read, checked and moved as a whole; edits
// that change what a later one stands on cost another look; what is refused of n edits costs log2(n) times
// that. With `all`: two compilations, and log2(n) more where it is refused.
std::optional<Edited> edit_document(const Source& source, std::span<const EditLine> edits,
                                    const EditOptions& options, Diagnostics& of_edits,
                                    Diagnostics& of_document);

// A size that keeps an element inside the closed card, out of which it sticks by so many mm, as the words of
// a hint, with the edit that makes it so: "a height of 63.2 mm, not 84.9 mm, keeps it inside the closed card:
// popupc edit … set tower --height 63.2mm". That edit was carried out, read, checked and closed:
// nothing of the element sticks out any more, no plate that did not before, and the checks find nothing new.
// Collisions are not looked at. Of the sizes that were found to do, the one that changes by the smallest
// share; in the document's unit, to a tenth of a millimetre or so. nullopt: none of those that were tried
// does, or the design is no document, or has more than 300 elements. Precondition: the design has been
// assembled, with these options. Cost: up to 20 trials, most often two or three, fewer if the document has
// more than 50 elements; each checks and assembles the design. What is told is read from the edited document,
// too.
std::optional<std::string> fitting_size(const CompiledDesign& design, const CompileOptions& options,
                                        const std::string& element, double by_mm);

// A move along its fold that keeps the tabs of an element clear of those of all others, as the words of a
// hint: "moving "b" 10.00 mm along its fold, by (0.00, 10.00) mm on the page, keeps its tabs clear of all
// others: popupc edit … move b --along=10.00mm --follow". That edit was made, and the document read, checked,
// moved and unfolded: it has no `glue-overlaps` of the element any more, and no finding that it did not have.
// The shortest move of those that were tried, one way or the other, up to 100 mm; lengths are rounded up to
// the hundredth. nullopt: none of them does, or the design is no document, has more than 150 elements, or
// elements that do not move straight along their fold. Precondition: the design has been assembled, and moved
// if it moves, with these options. Cost: a look at its tabs for each half a millimetre, and up to eight
// compilations as far as what is found of tabs, fewer if the document has more than 20 elements.
std::optional<std::string> clearing_move(const CompiledDesign& design, const CompileOptions& options,
                                         const std::string& element);

// What to type for a move of an element by so many mm on the page of the left plate that drives it, and of
// everything that stands on it: "popupc edit … move b --along=-5.00mm --follow". That edit was made in the
// design as it was read. nullopt: none moves it so, or the design is no document. Precondition: the design
// has been checked. Cost: that of a check().
std::optional<std::string> move_command(const CompiledDesign& design, const CompileOptions& options,
                                        const std::string& element, Vec2 by);

// Whether moving the element in the document, by so many mm on the page of the left plate that drives it,
// does what moving its plates does: the design, changed so and checked, has no error, and all plates are as
// large as before. It need not be so: an element that is too large for where it stands is made smaller, by
// how much depends on the place; and where it comes to stand the fold may have been cut away. False where no
// edit moves the element so; true where nothing can be edited, as the design is no document. Precondition:
// the design has been assembled with these options. Cost: that of a check() and an assemble().
bool move_holds(const CompiledDesign& design, const CompileOptions& options, const std::string& element,
                Vec2 by);

// What `popupc show` tells of a design.
struct ShowOptions {
    std::string id;    // of one structure alone, and what stands on it; empty: everything
    bool all = false;  // measures that go without saying, colours and defaults, too
};
// A tree of elements with their measures and folds, lengths in the document's unit; one line an element.
// nullopt after an error: there is no such id.
std::optional<std::string> show_tree(const Design& design, const ShowOptions& options,
                                     Diagnostics& diagnostics);
// The same of a design whose folds are known: `card` is folds_of_card(design), which is most of the cost.
std::optional<std::string> show_tree(const Design& design, const CardFolds& card, const ShowOptions& options,
                                     Diagnostics& diagnostics);
// The same as JSON, with all measures, points and values.
std::optional<std::string> show_json(const Design& design, const ShowOptions& options,
                                     Diagnostics& diagnostics);

// The document in its canonical spelling, as the writer has it, with its comments: each before what it stood
// before, or behind what it stood behind on a line. What it means stays as it is, nothing is repaired.
// nullopt after an error: it cannot be read, or has something in it that has no meaning and would be lost.
std::optional<std::string> format_document(const Source& source, Diagnostics& diagnostics);

// A card to begin with.
struct CardTemplate {
    std::string_view name;   // "castle"
    std::string_view about;  // one line
    std::string_view text;   // the document
};
std::span<const CardTemplate> card_templates();  // by name

struct NewCard {
    std::optional<double> width_mm, height_mm;  // both or none: 200 × 140 mm, or as the template has it
    std::vector<std::string> with;              // kinds of elements, which share the gutter
    std::string pattern;  // the name of a template; it is made larger or smaller to fit the size
    // That of the document where a size is given: "in". Empty, or none that there is: millimetres, or that of
    // the template.
    std::string unit = {};
};
// The document; nullopt after an error: an element that there is not, or that has no room, and `page-size`.
// Precondition: there is a template of that name.
std::optional<std::string> new_document(const NewCard& wanted, Diagnostics& diagnostics);

}  // namespace popup
