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
// comes first, then folds, then cuts from the inside outwards, so that a piece is not loose before it is
// finished. Closed set.
enum class Operation { fill, draw, glue, label, valley, mountain, seam, perforation, inner_cut, outer_cut };
inline constexpr std::array kOperations{
    Operation::fill,     Operation::draw, Operation::glue,        Operation::label,     Operation::valley,
    Operation::mountain, Operation::seam, Operation::perforation, Operation::inner_cut, Operation::outer_cut};
std::string_view to_string(Operation operation);  // "inner-cut"

// How the lines of an operation are drawn. Neighbours in the order of operations that name the same layer
// share it.
struct Pen {
    std::string layer;      // empty: what this is about is left out
    Color color;            // fill and draw: each area and line brings its own
    double width_mm = 0.0;  // fill, draw and label: not used
};

struct Profile;
// What is done along a line of a pattern. Where folds are not dashed for the eye, a seam along which another
// piece is glued on is a place (glue), no fold: the paper stays whole there.
Operation operation_of(const PatternLine& line, const Profile& profile);
// Of a contour: an outer cut when it is closed and lies in no other of its piece.
Operation operation_of(const Contour& cut);

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
    std::array<Pen, kOperations.size()> pens;

    [[nodiscard]] const Pen& pen(Operation operation) const {
        return pens[static_cast<std::size_t>(operation)];
    }
    // True for folds that are drawn as dashed whole lines.
    [[nodiscard]] bool dashes(Operation operation) const;
    // False for what the profile leaves out, and for what its fold style has no use for.
    [[nodiscard]] bool draws(Operation operation) const;
    // True for valley, mountain and seam where such folds are perforated.
    [[nodiscard]] bool perforates(Operation fold) const;
};

// All profiles; the first, workshop, is the default.
std::span<const Profile> profile_table();
std::vector<std::string_view> profile_names();
// The profile of this name; null: there is none.
const Profile* find_profile(std::string_view name);

// A profile of the user's own, in TOML as schemas/profile.schema.json has it: name, about, base, folds,
// one-sided, styled-paths, perforation {cut, gap, clear}, pens.OPERATION {layer, color, width}; lengths in
// mm. What it does not say is as in the profile that `base` names, or in workshop. A name that is not given
// is the file's stem. Errors, with their places: `bad-profile`, for what is not TOML, for unknown keys, and
// for values that are not what their keys take.
std::optional<Profile> read_profile(const Source& source, Diagnostics& diagnostics);

// What the profile does to these sheets that one would not expect. Warning: `lines-left-out`, of cuts and
// folds that no pen draws. Remark: `one-sided-folds`. Cost: linear in cuts and folds.
void examine_profile(const Layout& layout, const Profile& profile, Diagnostics& diagnostics);

// The cuts of a perforated line: at least one, and never its whole length. Cuts and gaps are by at most a
// half longer or shorter than asked, all alike. A line with no room for two cuts between its clear ends has
// one in its middle, as long as asked but no longer than a third of the line. Cost: linear in cuts.
// Precondition: the line has a length.
std::vector<Segment> perforated(const Segment& line, const Perforation& perforation);

}  // namespace popup
