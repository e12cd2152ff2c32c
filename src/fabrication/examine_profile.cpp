#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

#include "base/nth.h"
#include "fabrication/broken_score.h"
#include "fabrication/count_operations.h"
#include "popup/diagnostics.h"
#include "popup/profile.h"

namespace popup {
namespace {

std::string counted(std::size_t n, std::string_view what) {
    return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s");
}

std::size_t at(const OperationCounts& counts, Operation operation) { return nth(counts, operation); }

void examine_left_out(const OperationCounts& counts, const Profile& profile, Diagnostics& diagnostics) {
    std::size_t folds = 0;
    std::size_t cuts = 0;
    for (const Operation operation : kOperations) {
        if (profile.draws(operation) || profile.perforates(operation)) continue;
        if (is_fold(operation)) folds += at(counts, operation);
        if (is_cut(operation)) cuts += at(counts, operation);
    }
    if (folds == 0 && cuts == 0) return;
    diagnostics
        .warning("lines-left-out", {},
                 fmt::format("the profile {} leaves out {}{}{}", profile.name,
                             cuts > 0 ? counted(cuts, "cut") : "", cuts > 0 && folds > 0 ? " and " : "",
                             folds > 0 ? counted(folds, "fold") : ""))
        .hint("give the pens of what is to be drawn a layer");
}

void examine_sides(const OperationCounts& counts, const Profile& profile, ScoreSide side,
                   Diagnostics& diagnostics) {
    // Perforated lines fold either way.
    if (!profile.one_sided || profile.folds == FoldStyle::perforated) return;
    if (!profile.draws(Operation::mountain) || !profile.draws(Operation::valley)) return;
    const std::size_t mountains = at(counts, Operation::mountain);
    const std::size_t valleys = at(counts, Operation::valley);
    if (mountains == 0 || valleys == 0) return;
    Diagnostic& finding = diagnostics.remark(
        "one-sided-folds", {},
        fmt::format("the sheets have {} mountain and {}, and the profile {} scores all of them from one side",
                    mountains, counted(valleys, "valley fold"), profile.name));
    if (is_broken(Operation::mountain, profile, side) || is_broken(Operation::valley, profile, side))
        finding.hint("a score with gaps is of a fold away from you, a whole one of a fold towards you");
    finding.hint(
        "paper folds best away from its score: take --score-side both, which puts valley folds on a mirrored "
        "sheet for the back, or --fold-style perforated, which folds either way, or crease them by hand");
}

// Programs that move cuts themselves do so by layer or colour.
void examine_kerf(const OperationCounts& counts, const Profile& profile, Diagnostics& diagnostics) {
    for (const Operation moved : {Operation::inner_cut, Operation::outer_cut}) {
        const Pen& pen = profile.pen(moved);
        if (pen.kerf_mm <= 0.0 || at(counts, moved) == 0) continue;
        for (const Operation other : {Operation::slit, Operation::inner_cut, Operation::outer_cut}) {
            const Pen& unmoved = profile.pen(other);
            if (unmoved.kerf_mm > 0.0 || at(counts, other) == 0 || unmoved.color != pen.color) continue;
            diagnostics
                .remark("kerf-shares-color", {},
                        fmt::format(
                            "{} of kind {} are moved by half a kerf of {} mm, and {} of kind {}, which are "
                            "not, have the same colour {}",
                            counted(at(counts, moved), "cut"), to_string(moved), pen.kerf_mm,
                            counted(at(counts, other), "cut"), to_string(other), to_string(pen.color)))
                .hint("see to it that the machine's program does not move cuts of this colour once more");
            return;
        }
    }
}

}  // namespace

void examine_profile(const Layout& layout, const Profile& profile, ScoreSide side, Diagnostics& diagnostics) {
    const OperationCounts counts = count_operations(layout, profile);
    examine_left_out(counts, profile, diagnostics);
    if (side != ScoreSide::both) examine_sides(counts, profile, side, diagnostics);
    examine_kerf(counts, profile, diagnostics);
}

void examine_format(std::string_view suffix, const Profile& profile, Diagnostics& diagnostics) {
    if (profile.formats.empty()) return;
    const std::string_view name = suffix.substr(suffix.starts_with('.') ? 1 : 0);
    if (name == "png" || name == "jpg") return;  // for eyes
    if (std::find(profile.formats.begin(), profile.formats.end(), name) != profile.formats.end()) return;
    diagnostics
        .remark("unusual-format", {},
                fmt::format("what the profile {} is for takes {}, as far as is known, and not {}",
                            profile.name, fmt::join(profile.formats, ", "), name))
        .hint("the file is written all the same");
}

}  // namespace popup
