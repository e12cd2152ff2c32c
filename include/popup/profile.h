// Machine profiles: how cut files are drawn for a machine and its program. Data, one row a profile.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "popup/files.h"
#include "popup/layout.h"

namespace popup {

// What is done along a line, or with an area, of a sheet; in the order in which it is done. What is printed
// comes first, then marks, then folds, then cuts from the inside outwards, so that a piece is not loose
// before it is finished. Closed set.
enum class Operation {
    fill,
    draw,
    glue,
    label,
    legend,        // what lines mean, in free space of the sheet
    registration,  // marks by which a sheet is found again, and the bar to measure
    mark,          // what tells how to glue, where nothing prints it: a light engraving or a fine score
    valley,
    mountain,
    seam,
    perforation,
    slit,  // a cut that takes nothing out of the paper, where inner cuts are moved for the kerf
    inner_cut,
    outer_cut
};
inline constexpr std::array kOperations{
    Operation::fill,         Operation::draw, Operation::glue,      Operation::label,    Operation::legend,
    Operation::registration, Operation::mark, Operation::valley,    Operation::mountain, Operation::seam,
    Operation::perforation,  Operation::slit, Operation::inner_cut, Operation::outer_cut};
std::string_view to_string(Operation operation);  // "inner-cut"
constexpr bool is_printed(Operation operation) { return operation <= Operation::registration; }
constexpr bool is_fold(Operation operation) {
    return operation >= Operation::valley && operation <= Operation::seam;
}
constexpr bool is_cut(Operation operation) { return operation >= Operation::slit; }

// How the lines of an operation are drawn. Neighbours in the order of operations that name the same layer
// share it.
struct Pen {
    std::string layer;           // empty: what this is about is left out
    Color color;                 // fill and draw: each area and line brings its own
    double width_mm = 0.0;       // fill, draw and label: not used
    double kerf_mm = 0.0;        // inner and outer cuts: the whole width of what the tool burns away; 0: the
                                 // lines are as drawn
    double speed_mm_s = 0.0;     // 0: not known
    double power_percent = 0.0;  // for programs that take it from the file; 0: not known
    std::string spot = {};       // of a production PDF: the spot colour's name; empty: process colour
};

struct Profile;
// What is done along a line of a pattern. A seam along which another piece is glued on is a place (glue), no
// fold: the paper stays whole there.
Operation operation_of(const PatternLine& line, const Profile& profile);
// Of a contour: an outer cut when it is closed and lies in no other of its piece. Open ones are slits where
// inner cuts are moved for the kerf, so that the two can be told apart, else inner cuts.
Operation operation_of(const Contour& cut, const Profile& profile);
// What is done with print of a piece: areas and images are filled, strokes and texts of a colour drawn; other
// texts are labels.
Operation operation_of(const Print& print);

// What becomes of valley folds, mountain folds and seams.
enum class FoldStyle {
    dashed,      // whole lines, dashed for the eye; a machine may take them as whole
    score,       // whole lines
    perforated,  // cuts with bridges between them, each a line of its own
    both         // scored whole, and perforated
};
inline constexpr std::array kFoldStyles{FoldStyle::dashed, FoldStyle::score, FoldStyle::perforated,
                                        FoldStyle::both};
std::string_view to_string(FoldStyle style);

// A perforated line: cuts and gaps in turn, beginning and ending with a cut, fitted to the line.
struct Perforation {
    static constexpr double kLeastMm = 0.01;  // of cut and gap
    double cut_mm = 2.0;                      // > 0
    double gap_mm = 1.0;                      // > 0
    double clear_mm = 1.0;                    // uncut at each end, so that no cut ends in a corner; ≥ 0
};

// Marks at the corners of a sheet, by which a printed sheet is found again for cutting.
enum class Marks {
    none,
    corners,    // a cross in each corner, the first with a ring
    silhouette  // a square and two brackets, as Silhouette's cutters look for them
};
inline constexpr std::array kMarks{Marks::none, Marks::corners, Marks::silhouette};
std::string_view to_string(Marks marks);
// How far from the edges of the sheet pieces must stay clear of the marks, in mm.
double clear_of(Marks marks);

// Where the machine marks what tells how to glue: targets as ticks in their corners, and the numbers of tabs,
// targets and pieces in letters of single lines.
enum class MarksOn {
    front,   // all of it, names of pieces too
    back,    // all of it, on the back of the sheet
    hidden,  // what a glued tab or piece covers later, on both sides; the rest on the back if the machine
             // works there anyway, else it is left out. A piece's name then stands in one of its tabs with
             // room, the number of one that is glued flat where it is glued
    none
};
inline constexpr std::array kMarksOn{MarksOn::front, MarksOn::back, MarksOn::hidden, MarksOn::none};
std::string_view to_string(MarksOn side);

// How scores of folds look that go away from who looks at them, on sheets that are scored from one side.
enum class AwayFolds {
    whole,  // as those that come towards one
    broken  // with short gaps, so that whoever has only the cut pieces tells the two apart
};
inline constexpr std::array kAwayFolds{AwayFolds::whole, AwayFolds::broken};
std::string_view to_string(AwayFolds look);

// From which side of the sheet a machine works.
enum class ScoreSide {
    front,
    back,  // all of it, the sheet lying on its face
    both   // valley folds from the back, all else from the front: paper folds away from a score
};

struct Profile {
    std::string name;
    std::string about;
    // What is known comes from makers and programs; false: from forums, or from single users.
    bool verified = true;
    FoldStyle folds = FoldStyle::dashed;
    Perforation perforation;
    // Folds are made from one side of the paper only, so that mountain and valley folds come out alike.
    bool one_sided = false;
    // Every path of an SVG says its colour by itself, in a style attribute, for programs that look nowhere
    // else.
    bool styled_paths = false;
    // Lines are drawn in the order in which the machine does best to follow them, lines that pieces share
    // once, without segments too short for it. Else piece by piece, every piece whole.
    bool machine_order = false;
    bool outlined_text = false;  // text is drawn as the outlines of its letters
    Marks marks = Marks::none;
    MarksOn marks_on = MarksOn::hidden;
    AwayFolds away_folds = AwayFolds::whole;
    // Of the bridges that hold a piece in its sheet until it is broken out, along its outer cut; 0: none.
    // What the kerf of outer cuts takes away comes on top. Else 0.05 to 10.
    double joint_mm = 0.0;
    double bed_width_mm = 0.0;  // the largest sheet that goes into the machine, either way round; 0: any
    double bed_height_mm = 0.0;
    double travel_mm_s = 0.0;          // of the head between lines; 0: not known
    double pierce_s = 0.0;             // at the beginning of each line
    std::vector<std::string> formats;  // that the machine or its program takes: "svg"; empty: any
    std::array<Pen, kOperations.size()> pens;

    [[nodiscard]] const Pen& pen(Operation operation) const {
        return pens[static_cast<std::size_t>(operation)];
    }
    // True for folds that are drawn as dashed whole lines.
    [[nodiscard]] bool dashes(Operation operation) const;
    // False for what the profile leaves out, and for what its fold style has no use for.
    [[nodiscard]] bool draws(Operation operation) const;
    // Whether the machine has to mark glue targets and numbers: it can, and no pen prints them.
    [[nodiscard]] bool marks_glue() const;
    // True for valley, mountain and seam where such folds are perforated.
    [[nodiscard]] bool perforates(Operation fold) const;
};

// All profiles; the first, workshop, is the default.
std::span<const Profile> profile_table();
std::vector<std::string_view> profile_names();
// The profile of this name; null: there is none.
const Profile* find_profile(std::string_view name);

// A profile of the user's own, in TOML as schemas/profile.schema.json has it; lengths in mm. What it does not
// say is as in the profile that `base` names, or in workshop. A name that is not given is the file's stem.
// Errors, with their places: `bad-profile`, for what is not TOML, for unknown keys, and for values that are
// not what their keys take. `formats` are the names of those that there are, as "svg"; where it is not empty,
// a profile names no others.
std::optional<Profile> read_profile(const Source& source, Diagnostics& diagnostics,
                                    std::span<const std::string_view> formats = {});

// What the profile does to these sheets that one would not expect. Warning: `lines-left-out`, of cuts and
// folds that no pen draws. Remarks: `one-sided-folds`, `kerf-shares-color`. Cost: linear in cuts and folds.
void examine_profile(const Layout& layout, const Profile& profile, ScoreSide side, Diagnostics& diagnostics);
// Remark: `unusual-format`, of a format (".svg") that the profile's machine is not known to take. Pictures
// are for eyes, and none.
void examine_format(std::string_view suffix, const Profile& profile, Diagnostics& diagnostics);

// The cuts of a perforated line: at least one, and never its whole length. Cuts and gaps are by at most a
// half longer or shorter than asked, all alike. A line with no room for two cuts between its clear ends has
// one in its middle, as long as asked but no longer than a third of the line. Cost: linear in cuts.
// Precondition: the line has a length.
std::vector<Segment> perforated(const Segment& line, const Perforation& perforation);

}  // namespace popup
