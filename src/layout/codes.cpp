#include "layout/codes.h"

#include <array>

namespace popup {
namespace {

constexpr std::array kLayoutCodes = std::to_array<CodeInfo>({
    {"group-too-large", Severity::error, "the pieces of a design do not fit on one sheet together",
     "Under --group design all pieces of one copy of a design are put on the same sheet, so that a kit can "
     "be handed out as one. No arrangement of these pieces was found that fits on a single sheet. Take a "
     "larger sheet, a smaller --scale, or leave --group out."},
    {"lock-impossible", Severity::error, "a piece cannot stay where it is locked",
     "--lock keeps a piece in a place, given as a report gives it: where the origin of the piece's page "
     "goes on the sheet, in millimetres from its lower left corner, and by how much the piece is turned. "
     "There, the piece would reach over the margin or come too close to another locked piece, or it is "
     "locked twice, or apart from what --group or --grain puts with it. Lock it elsewhere, or leave it "
     "free."},
    {"nest-stopped", Severity::remark, "the search for places was interrupted",
     "With --nest-time an interrupt (Ctrl-C) ends the search and the best layout found so far is written, "
     "checked as any other. Let it run on for a tighter one, or use --nest-effort for one that is the same "
     "every time."},
    {"piece-too-large", Severity::error, "a piece does not fit on the sheet",
     "A piece of the design, tabs included, is larger than what is left of the sheet inside its margins, "
     "in every way it may be turned. Pieces are never cut apart, so nothing was written. Choose a larger "
     "sheet, a smaller margin, or a smaller --scale; the message gives both sizes, and the hint a paper or "
     "a scale that would do. A piece that is a little too long may also fit across the sheet with --rotate "
     "any."},
    {"sheet-too-large", Severity::error, "a sheet is larger than the machine's bed",
     "The machine profile says how large a sheet the machine takes, either way round, and the sheet that "
     "was chosen is larger. Choose a smaller --sheet; with --sheet auto the largest paper that goes into "
     "the machine is taken, or its whole bed."},
    {"sheet-too-small", Severity::error, "the margins leave nothing of the sheet",
     "The margin is kept free along all four edges of a sheet. When twice the margin is as much as the "
     "sheet's width or height, no paper is left to put pieces on. Choose a larger --sheet or a smaller "
     "--margin."},
    {"stock-used-up", Severity::error, "there are not enough sheets in the stock",
     "--stock says how many sheets of which sizes there are. All of them were filled and pieces were left, "
     "even after a search for a tighter arrangement. Add sheets, or let the search look longer with a "
     "higher --nest-effort; it may find room if only little is missing."},
    {"too-many-pieces", Severity::error, "the run has more pieces than can be laid out",
     "One run lays out at most a million pieces, all copies of all designs together; more is nearly always "
     "a slip in --copies. Ask for fewer copies, or split the run."},
    {"unknown-piece", Severity::error, "an option names a piece that is not there",
     "--lock and --rotate PIECE=… name pieces as the outputs do: \"page\" for the base page, the id of an "
     "element for its extra piece, the name of a part of a drawing, and with several inputs the file's "
     "stem before a colon, such as \"castle:roof\". No piece of the run has this name, or not so many "
     "copies. The labels on the sheets and the report list the names."},
});

}  // namespace

std::span<const CodeInfo> layout_codes() { return kLayoutCodes; }

}  // namespace popup
