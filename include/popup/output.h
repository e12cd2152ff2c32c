// Writers: pure functions from a stage's value to bytes. One file and one table row a format.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "popup/assembly.h"
#include "popup/layout.h"
#include "popup/motion.h"
#include "popup/profile.h"

namespace popup {

class CheckedDesign;
struct Compilation;
struct CreasePattern;

// How FOLD files say what programs disagree on; src/output/fold.h has what each writes.
enum class FoldDialect {
    simulator,  // letters B, M, V and F only, which every program that folds FOLD files knows
    strict,     // all letters of FOLD 1.2, each for what it means: slits are C, joins J, unknown folds U
};

// The side from which pictures show a model, in the words of someone who sits in front of it.
enum class View { iso, front, top, left, right, back };
inline constexpr std::array<std::string_view, 6> kViewNames{"iso", "front", "top", "left", "right", "back"};

struct PictureSize {
    int width = 0, height = 0;  // pixels, at least 16
};

// Pictures of the model. There is one still for each view and opening, and one moving picture for each view.
struct StillOptions {
    std::vector<View> views{View::iso};  // each once, at least one
    std::vector<double> openings_deg;    // 0 to 180, as far as a card opens; empty: where it is seen best
    std::optional<PictureSize> size;     // none: 800 × 600, of animations 480 × 360
    std::optional<double> paper_mm;      // > 0: shows paper this thick; none: as thin as a line
};

// Paper of a printer on which larger sheets are printed in parts, to be glued together.
struct TileOptions {
    double width_mm = 0.0, height_mm = 0.0;  // > 0; pages lie upright or across
    double margin_mm = 10.0;  // ≥ 5: the edge of a page that stays free of the drawing; marks and labels are
                              // in its inner 5 mm
};

// Whether sheets say what their lines mean, how they are printed and which side is up, in space that no piece
// lies on. Formats for machines never do, nor do profiles whose pen of legends has no layer. The program's
// own default is automatic.
enum class Legend {
    automatic,  // where something is folded or glued, and there is room; not in SVG, which others may cut
    always,     // a sheet without room is told of
    never
};

struct OutputOptions {
    Legend legend = Legend::never;
    double fps = 0.0;  // scene: > 0 adds keys so that there are at least this many a second; of animations 0
                       // is 15, and no more than 50 (.gif) or 100 (.webp) are made
    double duration_s = 4.0;                    // scene: length of the animation, > 0
    Profile profile = profile_table().front();  // how lines of sheets are drawn
    bool backs = false;  // sheets have printed backs: colours on both sides, glue targets and labels there;
                         // where they have none, models and pictures show bare paper from behind
    bool edge_lines = true;  // of .glb and .gltf: lines along the edges of plates
    ScoreSide score_side = ScoreSide::front;
    bool print_and_cut = false;  // what is printed and what is cut are files of their own
    double reference_mm = 0.0;   // > 0: a bar of this length on each sheet, to measure
    double dpi = 300.0;          // of raster pictures, 0.01 to 10 000; else the nearer end
    FoldDialect fold_dialect = FoldDialect::simulator;
    StillOptions still;
    std::optional<TileOptions> tile;  // of .pdf: on pages of this paper; none: a page a sheet
    // Books: pages of letter paper, 8.5 × 11 in, or of A4; none: letter for designs in inches, else A4.
    std::optional<bool> letter_pages = {};
    // Sheets: printed texts, those with a colour of their own, are outlines even where labels are text.
    bool outlined_print = false;
    int threads = 1;  // begin_files(): 2 and more let it make models while sheets are laid out; ≥ 1
    std::vector<std::string> files;  // report: the files of this run, every sheet's; empty: not known
};

// One design as a scene: how it is built and how it moves, or where it stands. `prefix` ("castle:") goes
// before every name, may be empty.
struct SceneCard {
    const Assembly* assembly = nullptr;  // has_model() holds
    const Motion* motion = nullptr;      // of what moves; else there is none
    std::string prefix;
    const CreasePattern* creases = nullptr;  // what it was folded from, for what its file says beside
    const Pattern* pattern = nullptr;        // its pieces as they are made, whatever the scale of the layout
    std::string input = {};                  // the file that findings about it name; empty: the assembly's
};

// How wide the margin of sheets must be, in mm, so that marks and bar lie clear of pieces.
double margin_needed(const OutputOptions& options);

// Whether .pdf can be tiled under these options; true where no tiles are wanted. Errors: `tiles-impossible`,
// of printed backs, of lines on backs, of print_and_cut, and of profiles of machines or with spot colours,
// which all need their sheet in one piece; `tile-too-small`, of margins below 5 mm, and of paper with less
// than 30 mm inside them either way.
bool can_tile(const OutputOptions& options, Diagnostics& diagnostics);

// What these options and the designs ask for and the sheets do not have. Remark: `glue-marks-left-out`, of
// targets and numbers that nothing prints or marks, and `backs-to-mark`. Warnings: `too-few-joints`, of
// pieces whose outer cuts have no room for two, and `legend-left-out`, of sheets without room for one that is
// always wanted. Remark: `prints-left-out`, of pictures, of printed texts, of marks, of the bar, of a legend
// that is always wanted, and of backs; under print_and_cut only of what cut files lack. Colours of plates and
// drawn lines are left out without a word.
void examine_prints(const Layout& layout, const OutputOptions& options, Diagnostics& diagnostics);

// One file of a format: `suffix` goes between the stem and the format's own suffix ("-2": "card-2.svg").
struct SheetFile {
    std::string suffix;
    std::string bytes;
};
// A file a sheet and side, or one that holds all sheets.
using SheetWriter = std::optional<std::vector<SheetFile>> (*)(const Layout&, const OutputOptions&,
                                                              Diagnostics&);
using SceneWriter = std::optional<std::string> (*)(std::span<const SceneCard>, const OutputOptions&,
                                                   Diagnostics&);
// Gives one file for each picture.
using StillWriter = std::optional<std::vector<SheetFile>> (*)(std::span<const SceneCard>,
                                                              const OutputOptions&, Diagnostics&);
// What of a page needs no sheets, made by a thread of its own meanwhile. Its destructor waits for that
// thread.
struct BegunPage;
// What people are shown of a run in one file: the model, the sheets, and what was found.
struct RunPage {
    std::span<const SceneCard> cards;
    const Layout* layout = nullptr;         // null: there are no sheets
    std::vector<Diagnostic> findings = {};  // in the order in which they are told
    bool inches = false;                    // the first design is written in inches
    std::shared_ptr<BegunPage> begun = {};  // of these cards, by the row's `begin`; null: nothing is
};
using PageWriter = std::optional<std::string> (*)(const RunPage&, const OutputOptions&, Diagnostics&);
// What the cards point to must outlive what is returned, unchanged. The page is the same with it and without.
using PageBeginner = std::shared_ptr<BegunPage> (*)(std::vector<SceneCard>, const OutputOptions&);
using DocumentWriter = std::optional<std::string> (*)(const CheckedDesign&, const OutputOptions&,
                                                      Diagnostics&);
using ReportWriter = std::optional<std::string> (*)(const Compilation&, const OutputOptions&, Diagnostics&);

// Which designs a format takes that do not move.
enum class Stills {
    none,
    sheets,  // a sheet that lies folded: it has hinges
    made,    // that, and parts that are glued together
    all,     // whatever stands somewhere
};

// Output options that only some formats use. A run that gets one and has no such format says so.
struct OptionUses {
    bool view = false, size = false;         // StillOptions::views and size
    bool openings = false;                   // StillOptions::openings_deg
    bool rate = false;                       // fps and duration_s
    bool dpi = false, fold_dialect = false;  // the options of these names
    bool speeds = false;                     // those of the profile
    bool legend = false;                     // OutputOptions::legend
    bool edge_lines = false;                 // OutputOptions::edge_lines
};

struct Format {
    std::string_view suffix;  // ".svg"
    std::string_view about;
    std::variant<SheetWriter, SceneWriter, StillWriter, PageWriter, DocumentWriter, ReportWriter> write;
    Stills stills = Stills::none;  // of models and their pictures
    OptionUses uses = {};
    PageBeginner begin = nullptr;  // null: nothing can be made before there are sheets
};
std::span<const Format> format_table();
// The row whose suffix ends `path` (case disregarded), or whose suffix without its dot is `path`; null: none.
const Format* find_format(std::string_view path);

}  // namespace popup
