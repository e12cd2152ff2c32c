// The Pattern: flat pieces with tagged lines, tabs, labels and colours, ready to be laid out.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "popup/assembly.h"
#include "popup/units.h"

namespace popup {

// A path of cuts. Closed: the last point joins the first.
struct Contour {
    std::vector<Vec2> points;
    bool closed = false;
    int depth = 0;  // of how many closed contours of the piece it lies inside
};

struct PatternLine {
    LineKind kind = LineKind::valley;  // mountain, valley, seam or mark; cuts are contours
    Segment at;
    int plate = -1;  // index into Pattern::plate_names, -1: none
    // A seam along which another piece is glued on: a place, where nothing is folded. Other seams are folds
    // of tabs.
    bool glued_on = false;
    // Of a fold: how far it is folded in the finished piece, [0, pi]; where that is known.
    std::optional<double> fold_angle = {};
};

// What is printed on a piece, and on which of its plates. Images are cut to their plate: Image::clip says
// how.
struct PatternPrint {
    Print print;
    int plate = -1;  // -1: a tab's, or of no single plate
};

// A glue target: the tab's own shape on the plate it is glued to.
struct GlueTarget {
    Ring outline;
    int plate = -1;
    std::string label = {};  // the number on it
    bool on_back = false;    // of the plate, where only who looks at the back sees it
};

enum class LabelKind { piece, tab, target };

// Text of this program's own, by which pieces and joints are told apart; printed, never cut. No Print, for it
// has a meaning: it may stand on the back, beside glue targets, and emitted patterns name its kind. `at` is
// the middle of the text.
struct Label {
    LabelKind kind = LabelKind::piece;
    std::string text;
    Vec2 at;
    double height_mm = 4.0;  // of the capitals
    double angle = 0.0;      // radians, counter-clockwise
    bool on_back = false;    // of what is there: shown on backs alone
    double room = 1.0;       // ≥ 1; a text this many times as wide has room there too
};

// A tab with room for its piece's name: "2L castle" instead of the number alone.
struct NamedTab {
    std::size_t label = 0;  // index into PatternPiece::labels, of the tab's number
    Label named;
};

struct PatternPiece {
    std::string name;
    std::string number;                // of its tabs or its glued areas: "3" of 3L and 3R; empty: it has none
    std::vector<Contour> cuts;         // inner before outer
    std::vector<PatternLine> lines;    // folds and seams
    std::vector<PatternPrint> prints;  // in the order in which they are painted, as print.h has it
    std::vector<GlueTarget> targets;
    std::vector<Label> labels;
    std::optional<NamedTab> named_tab;  // for marks that may only stand where something is glued
    // Of a piece that is glued flat: its number, where it is glued and nobody sees it later; `on_back` says
    // on which side. For such marks, too.
    std::optional<Label> hidden_number;
    std::vector<Polygon>
        silhouette;  // the piece's paper, tabs included, slits ignored; what layout must keep apart
    Box bounds;      // of the silhouette
};

struct Pattern {
    std::vector<std::string> plate_names;
    std::vector<PatternPiece> pieces;
    CurveTable curves;  // that chords of all pieces stand for
};

struct PatternOptions {
    Length tab_depth = Length::millimetres(10.0);  // > 0
    Angle tab_taper = Angle::degrees(30.0);        // of a tab's ends, off the perpendicular; [0°, 80°]
    Tolerances tolerances;
    // Asked of an element of which a tab is glued where one of an earlier element is: a move that was tried
    // and keeps its tabs clear of all others, as the words of a hint; nullopt: none does. Asked of three
    // elements at most. Empty: nobody knows of moves.
    std::function<std::optional<std::string>(const std::string& element)> clearing_move = {};
};

// By how much the tabs of an element and those of others take one another's seams, before anything is
// trimmed: mm of seams, added up. 0: they are clear of one another. Cost: linear in tabs, for each of its
// own.
double shared_seams(const Assembly& assembly, const std::string& element, const PatternOptions& options);

// Unfolds the assembly: a piece of each of its pieces, in their order. Tabs are trimmed so that none crosses
// another, a fold, a cut-out or an edge; what is left of each is drawn, as its target, with the same number
// on the plate it is glued to; what is glued to a back has its target there. Pieces are labelled with their
// names where those fit, glued ones after the number of their tabs, in the order of which they are glued: "2.
// castle"; pieces with texts of their own are not. `glue-overlaps` warns of tabs of two elements that want
// one place, and `tab-too-small` of a tab that has under 3 mm of depth along half its seam or more.
// Guarantees: cuts chained into as few paths as possible, but those of a piece's own `paper`, which are its
// rings and slits as they are, inner ones before outer ones; no segment twice; every target inside its plate.
// Never nullopt: it is a stage like others. Cost: near linear in lines.
std::optional<Pattern> make_pattern(const Assembly& assembly, const PatternOptions& options,
                                    Diagnostics& diagnostics);

// Finds what make_pattern() finds, in the same order, for callers that need no pattern. Cost: that of the
// tabs alone; no piece is drawn.
void judge_tabs(const Assembly& assembly, const PatternOptions& options, Diagnostics& diagnostics);

}  // namespace popup
