// Edits of folded sheets that are drawings, in space; the drawing is written anew.
//
//     const std::vector<EditLine> edits{{{"extrude", "top", "--by", "10mm"}, {}}};
//     DrawingEditOptions options;
//     if (const auto edited = edit_drawing(source, edits, options, diagnostics, diagnostics))
//         write(edited->text);
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "popup/compile.h"
#include "popup/crease_pattern.h"
#include "popup/diagnostics.h"
#include "popup/edit.h"
#include "popup/files.h"
#include "popup/language.h"
#include "popup/motion.h"
#include "popup/refinement.h"

namespace popup {

// "vertex front.2 --by 0,0,5", "edge front.2-3 --to 10,0,40", "extrude top --by 5mm" (popup/sheet_edit.h).
std::span<const EditVerb> sheet_edit_verbs();

struct DrawingEditOptions {
    ReadOptions read = {};
    FoldOptions fold = {};
    std::vector<Join> joins = {};  // of the refinement; they are those of the drawing before the edits
    MotionOptions motion = {};     // for what passes through what
    Ruler ruler = {};    // out: that of the drawing after the edits, in which corners of joins are then
    bool force = false;  // carries it out also where panels pass through each other that did not, and denied
    // Of a compilation, which looks for what the policy of the document denies. Null: what edits themselves
    // find is all that is looked at.
    const CompileOptions* all = nullptr;
};
// Whether it is a drawing, or a crease pattern, and no document: what is shown and edited so.
bool is_sheet_drawing(const Source& source, const ReadOptions& options);
// All edits, in their order, or none. Elements whose lines do not move stay byte for byte; of the others only
// the numbers are written anew, to six decimals: curves stay curves, arcs become cubic ones. A page that the
// drawing grows out of grows with it. `joins` follow their corners and panels. What is written has been read
// again. nullopt after an error: those of edit_sheet(), `bad-edit`, and `edit-refused` where an element
// cannot be written anew, as one that use elements draw, where what is written would not be read as it is
// meant, or where panels pass through each other on the way to the folded shape that did not before. What the
// policy of `of_document` denies refuses an edit that brings it: then Edited says so, and `edit-refused` is
// in `of_edits`. Cost: two readings of the drawing an edit, that of edit_sheet(), and two of
// simulate_sheet(); with a policy that denies, two compilations more.
std::optional<Edited> edit_drawing(const Source& source, std::span<const EditLine> edits,
                                   DrawingEditOptions& options, Diagnostics& of_edits,
                                   Diagnostics& of_document);
// Pairs of panels that pass through each other in a folded sheet, or on the `whole_way` there. One that stops
// on its way has the pair of "" and "stops".
Crossings crossings_in(const CreasePattern& sheet, bool whole_way, FoldOptions fold,
                       const MotionOptions& motion);

// The panels of a folded sheet with their vertices and edges, one line each, or as JSON; nullopt after an
// error.
std::optional<std::string> show_drawing(const Source& source, const DrawingEditOptions& options, bool json,
                                        Diagnostics& diagnostics);

}  // namespace popup
