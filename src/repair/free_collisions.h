// Documents whose elements are moved until they no longer go through, or lie on, each other.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "popup/compile.h"
#include "repair/move_element.h"

namespace popup {

// A move that was made.
struct MadeMove {
    FreeingMove move;
    std::string before, after;  // the points that moved, by their letters, in the document's unit
};

struct FreedDocument {
    std::string text;             // with the moves
    std::vector<MadeMove> moves;  // in the order in which they were made
    // Of what is left: pairs of elements that still collide or lie on one another, and that no comment
    // allows.
    std::vector<std::pair<std::string, std::string>> left;
};

// Makes the moves that the examination has tried (Motion::moves), the shortest first, one after the other,
// each on the document as the moves before have left it, until nothing collides and nothing lies on anything
// else, or nothing helps. A move is made if the document that it gives is accepted without a repair, this
// pair neither collides nor lies on one another any more, no other does that did not before, and there are no
// more warnings of any other kind; else all of it is left out. What a comment or the policy allows stays as
// it is. Preconditions: `source` compiles with these options without errors and repairs, `language` can be
// written back. Cost: up to a dozen compilations a pair. Guarantee: `text` compiles without errors and
// repairs, and with no more pairs that collide than the source.
FreedDocument free_collisions(const Source& source, const Language& language, const CompileOptions& options,
                              const DiagnosticPolicy& policy);

// The findings on a design, without those of pairs that were moved apart, and with the moves.
// Warning: `moved-clear`, at the element, with what changed.
Diagnostics with_moves(const Diagnostics& found, const Design& design, const FreedDocument& freed);

}  // namespace popup
