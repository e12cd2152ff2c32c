// Refinement: from the rough shape of a carton, every fold at its angle, to one that closes.
//
// After Folding Cartons: folded by right angles, or by what its drawing says, a sheet is nearly the box that
// it is meant to be. Corners that should be in one place, flaps that should lie on a wall, are found and
// offered as suggestions; those that are accepted are joins, and the shape is refined until they close.
//
//     SuggestOptions options;
//     const std::optional<Suggestions> found = suggest_joins(pattern, options, diagnostics);
//     const RefineOptions refine{options.fold, {found->rows[0].join}};
//     const std::optional<Refined> box = refine_shape(pattern, refine, diagnostics);
//     if (box && box->closes) fold_sheet(box->pattern, {}, diagnostics);  // ends closed
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "popup/crease_pattern.h"
#include "popup/diagnostics.h"
#include "popup/files.h"
#include "popup/geometry.h"

namespace popup {

enum class JoinKind {
    merge,     // corners are in one place
    paste,     // a panel lies on another
    coplanar,  // two panels lie in one plane, beside each other
    glue,      // a panel is glued to another, on which it lies already: nothing moves for it
};
inline constexpr std::array<std::string_view, 4> kJoinKindNames{"merge", "paste", "coplanar", "glue"};
// So far may a panel be from what it is glued to: boards have a thickness, and drawings allow for it.
inline constexpr double kMostGlueGapMm = 4.2;

// A panel by its name ("sheet/glue-flap", as findings call it), and where a corner of it is drawn: mm, y up.
struct JoinPart {
    std::string panel;
    Vec2 corner = {};  // of merges; the nearest corner of the panel is meant
};

struct Join {
    JoinKind kind = JoinKind::merge;
    std::vector<JoinPart> parts;  // of a merge two or more, no panel twice; else two panels
    // Of the suggestion that it was, so that the same words accept nothing twice; 0: it was none.
    int number = 0;
    Place place = {};  // in the refinement file
};

// Three digits, without exponents: "28.5 mm", "0.000209 mm".
std::string shown_gap(double mm);

// "merge sheet/front (20.00, 40.00) mm, sheet/lid (20.00, 120.00) mm".
std::string shown_join(const Join& join, const Ruler& ruler);

// How far a fold ends from where the motion of fold_sheet() leaves it, which is the angle that the drawing
// says or that folds have which say none. Degrees, those of mountains less than 0.
struct FoldTurn {
    std::array<std::string, 2> panels = {};  // by their names; empty: no fold turns at all
    double from_deg = 0.0;
    double to_deg = 0.0;
    [[nodiscard]] double by_deg() const { return from_deg < to_deg ? to_deg - from_deg : from_deg - to_deg; }
};

// "the fold sheet/front+sheet/lid turns by 13.9°, from 90.0° to 76.1°"; "no fold turns". Mountains are told
// without a sign, unless the fold goes over to the other side.
std::string shown_turn(const FoldTurn& turn);

struct RefineOptions {
    FoldOptions fold = {};
    std::vector<Join> joins = {};
    // What is wrong with joins is told here, where they have places; null: with all the rest.
    Diagnostics* of_joins = nullptr;
};

struct Refined {
    // The sheet with every fold at the angle that closes the joins: as cuts and folds of its own, mended as
    // fold_sheet() mends them. fold_sheet() folds it so that its motion ends in the refined shape; its
    // FoldOptions must not name angles, nor a share of them.
    CreasePattern pattern;
    // By join that pastes or glues: a point of the sheet within the panel that has the glue on it, which is
    // the smaller of the two.
    std::vector<Vec2> glued;
    std::vector<double> apart_mm;  // by join: what it is left open by, while all panels are rigid
    double residual_mm = 0.0;      // the most of these, and of what loops of folds gape
    double enough_mm = 0.0;        // kRefined of the sheet's longer side: what closes leaves no more open
    bool closes = false;           // residual_mm <= enough_mm
    FoldTurn furthest = {};        // the fold that turns most
};
inline constexpr double kRefined = 1e-6;

// Calls the panels that the joins paste or glue so that whoever makes something of the folded sheet knows
// that they are glued: "sheet/8" is "sheet/8-glue-flap" then, unless it is a glue flap or glue corner by name
// already. `assembly` is what fold_sheet() made of the refined pattern.
void name_glue_flaps(const Refined& refined, Assembly& assembly);

// Refines the shape in which the motion of fold_sheet() ends. All panels stay rigid: only angles of folds
// change, each as little as the joins let it. Joins that cannot all close are left open by a compromise, and
// the warning `join-open` names the one that is open most, and by how much. The warning `join-swings` says
// that a fold turns by more than 15° although little is open: the joins hardly say where it should be. Errors
// `no-such-panel` (a join names a panel or corner that the sheet does not have), `not-refined` (the sheet
// does not fold rigidly), and those of fold_sheet() give nullopt. Cost: that of some dozens of sparse
// factorisations with three unknowns a corner.
std::optional<Refined> refine_shape(const CreasePattern& pattern, const RefineOptions& options,
                                    Diagnostics& diagnostics);

struct SuggestOptions {
    FoldOptions fold = {};
    std::vector<Join> joins = {};  // accepted before: suggestions are for the shape that these give
    // Corners this near are to be merged; > 0. None: a tenth of the sheet's longer side, and not more than 50
    // mm (the paper's).
    std::optional<double> near_mm = {};
    Diagnostics* of_joins = nullptr;  // as RefineOptions has it
};

struct Suggestion {
    Join join;
    int number = 0;            // within its kind, from 1; none that an accepted join has
    double apart_mm = 0.0;     // now
    double residual_mm = 0.0;  // what accepting it, and what was accepted before, would leave open
    bool settled = true;       // false: or less, for the search has ended before it could tell
    double turn_deg = 0.0;     // the most that a fold turns for it, from what was accepted before
    // The fold that ends furthest from where it was before all joins, when what has met stays together, too,
    // where it can.
    FoldTurn furthest = {};
    bool swings = false;  // as the warning `join-swings` has it
    bool closes = false;  // as Refined::closes, and swings nothing
    // What is to be glued lies there already, and nothing is to be moved for it.
    [[nodiscard]] bool lies() const { return join.kind == JoinKind::glue; }
    // Merges that are like this one: as many corners, with as many edges, as long (the paper's symmetric
    // groups); numbers, ascending.
    std::vector<int> like = {};
    [[nodiscard]] std::string name() const;  // "merge 3"
};

// "lies there already", "closes", "closes, turning a fold by 32°" (more than kMostTurnDeg), "leaves 0.31 mm
// or less", "swings a fold by 27°".
std::string shown_outcome(const Suggestion& suggestion);

struct Suggestions {
    double near_mm = 0.0;
    // Merges, then pastes, coplanar ones, and what may be glued; each in the order of the drawing.
    std::vector<Suggestion> rows;
    // Merges of corners that go together as above and are in one place already, to 0.01 mm. Accepting keeps
    // them there.
    std::vector<Join> met;
    std::size_t left_out = 0;  // candidates beyond kMostSuggestions, or beyond the work that is done at most
};
inline constexpr std::size_t kMostSuggestions = 200;

// Finds what might be joined:
//
// * merge: corners of different panels nearer than near_mm that have an edge of the same length (to a
//   hundredth); groups grow by the nearest corner that goes with one of theirs, and have no panel twice;
// * paste: a panel whose middle lies over a larger one, no corner further from its plane than near_mm, their
//   fronts the same way (their normals' product is more than 0.5);
// * coplanar: panels with corners as near to each other, neither over the other, no corner of the smaller
//   further from the larger's plane, their fronts nearly the same way (0.85);
// * glue: a panel that lies on a larger one, parallel to it, at most kMostGlueGapMm away; of several on the
//   nearest. Whether glue holds it there, or it is tucked in or folded under, no drawing says, so that "all"
//   does not accept it. Panels that are called glue flaps and glue corners are known to be glued.
//
// Not suggested is what would stay open by more than a twentieth of near_mm, what refinement can hardly bring
// nearer, as panels that are a board apart, and, but for glue, what is joined already, by a fold or in place
// to 0.01 mm. The same drawing has the same numbers. nullopt as refine_shape(). Cost: near linear in corners,
// as long as few are near one another, and a refinement of the panels in between for each suggestion.
std::optional<Suggestions> suggest_joins(const CreasePattern& pattern, const SuggestOptions& options,
                                         Diagnostics& diagnostics);

// Pairs of panels, by their names, that pass through each other.
using Crossings = std::set<std::pair<std::string, std::string>>;

// "all" leaves out joins that turn a fold further than this; their names accept them. The strip of a roll
// that comes undone turns by 90°, tabs that are drawn to one another by 47°; but the flaps of a pointed lid
// by 45°, too.
inline constexpr double kMostTurnDeg = 15.0;

struct AcceptOptions {
    bool alike = true;  // accepts what is like an accepted merge, too, where it closes
    // What crosses in a refined sheet, folded, and if `whole_way` while it is folded. Called a hundred times
    // at most, a few of them for the whole way. Empty: nobody looks.
    std::function<Crossings(const CreasePattern& refined, bool whole_way)> crossings = {};
    double most_turn_deg = kMostTurnDeg;  // of "all", as below; more than 0
};

// The joins of `options`, and the suggestions that `words` name: "merge 3, paste 1", or "all": each, seams of
// walls first, then the nearest, that leaves nothing open with those before, swings nothing, flattens no
// corner of more than 5°, turns no fold by more than most_turn_deg from where it was before all joins (a fold
// that what is named turns further by itself, from there), and brings no crossing that was not there. Then
// those of Suggestions::met that leave nothing open either, so that what is joined does not part what has
// met. The remark `join-left` names those that do not fit, of "all" and of what is alike; what is named
// itself is accepted whatever it leaves. What was accepted before is not accepted twice. Error
// `no-such-suggestion`: nullopt.
std::optional<std::vector<Join>> accept_joins(const CreasePattern& pattern, const SuggestOptions& options,
                                              const Suggestions& found, std::string_view words,
                                              const AcceptOptions& accept, Diagnostics& diagnostics);

// A refinement file: JSON, {"joins": [{"merge": [{"panel": "sheet/front", "corner": [20, 40]}, …], "number":
// 1}, {"paste": ["sheet/glue-flap", "sheet/front"]}, …]}. Corners are as the ruler shows them, with five
// decimals. What is written is read as the same joins. Error `bad-refinement`, with its place: nullopt.
std::string write_refinement(const std::vector<Join>& joins, const Ruler& ruler);
std::optional<std::vector<Join>> read_refinement(const Source& source, const Ruler& ruler,
                                                 Diagnostics& diagnostics);
// A corner as the ruler shows it, to five decimals.
Vec2 corner_as_shown(const Ruler& ruler, Vec2 at);

}  // namespace popup
