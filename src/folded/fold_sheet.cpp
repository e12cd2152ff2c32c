// From panels, folds and their laws to an assembly.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "assembly/settle.h"
#include "base/nth.h"
#include "base/text/quoted_words.h"
#include "folded/asked.h"
#include "folded/bend.h"
#include "folded/flat/flat_corners.h"
#include "folded/lower.h"
#include "folded/path.h"
#include "folded/refine.h"
#include "folded/sheet.h"
#include "folded/straighten.h"
#include "folded/work.h"
#include "popup/flat_folding.h"

namespace popup {
namespace {

using folded::Fold;
using folded::Paths;
using folded::SharePoint;
using folded::Sheet;

constexpr double kMendedMm = 0.02;
constexpr double kPi = std::numbers::pi;
constexpr double kFlatDeg = 180.0;   // the opening at which the sheet is flat
constexpr double kFoldedRad = 1e-6;  // so near to 0 or half a turn a panel lies flat
// A fold that goes the other way by less than this is hardly folded, degrees.
constexpr double kOtherWayDeg = 0.1;
constexpr std::size_t kToldAtMost = 10;
constexpr double kBoxDeg = 90.0;  // CreasePattern::fold_deg where nothing says how far folds go
// A fold that gets no further than this share of its way stays flat.
constexpr double kStaysFlat = 0.01;
// What is folded flat comes as near to it as the square root of what its corners are rounded to: a share of
// this or more is the whole way, to the digits that were drawn.
constexpr double kNearlyThere = 0.998;
// On large sheets corners may be moved by this share of the sheet.
constexpr double kRefineShare = 1e-3;

double degrees(double radians) { return radians * 180.0 / kPi; }

// A loop that does not close all the way. `bends`: how the panels of one that does not leave the flat sheet
// are shown; empty if they stay flat.
Diagnostic& tell_open(const folded::Cluster& cluster, const std::string& bends, const CreasePattern& pattern,
                      const Sheet& sheet, Diagnostics& diagnostics) {
    const folded::Loop& loop = nth(sheet.loops, cluster.worst_loop);
    const std::string where =
        fmt::format("the loop of {} folds around {} at {}", loop.steps.size(),
                    loop.corner ? "the corner" : "the hole", shown_point(pattern.ruler, loop.at));
    const Place place = nth(pattern.lines, loop.line).place;
    // Two folds around a corner are one that bends there, as the chords of a curve do.
    const std::string_view hint =
        loop.corner && loop.steps.size() == 2
            ? "panels on both sides of a fold that is no straight line would have to bend: draw it straight, "
              "or with creases that lead away from its bends"
            : "its panels would have to bend, or its folds to be folded one after another: add creases, or "
              "change which folds are mountains";
    if (cluster.reached > 0.0) {
        return diagnostics
            .warning(
                "not-rigid", place,
                fmt::format("{} closes only until {:.0f} % of the way; the sheet is folded as far as that",
                            where, std::floor(100.0 * cluster.reached)))
            .hint(std::string(hint));
    }
    const std::string by = loop.corner ? fmt::format("{:.1f}°", degrees(cluster.residual))
                                       : fmt::format("{:.2f} mm", cluster.residual * loop.size);
    return diagnostics
        .warning("not-rigid", place,
                 fmt::format("{} closes only while nothing is folded: half way it would be open by {}; {}",
                             where, by, bends.empty() ? "its folds stay flat" : bends))
        .hint(bends.empty() ? std::string(hint)
                            : fmt::format("{}; collisions are not looked for while panels bend", hint));
}

// Clusters for which the work was spent before it was known how they go.
void tell_given_up(const Paths& paths, double most, const CreasePattern& pattern, const Sheet& sheet,
                   Diagnostics& diagnostics) {
    std::size_t told = 0;
    for (const folded::Cluster& cluster : paths.clusters) {
        if (!cluster.given_up) continue;
        if (++told > kToldAtMost) return;
        const folded::Loop& loop = nth(sheet.loops, cluster.loops.front());
        const std::string went = cluster.reached > 0.0
                                     ? fmt::format("go beyond {:.0f} % of the way, as far as they are folded",
                                                   std::floor(100.0 * cluster.reached))
                                     : std::string("go, and so they stay flat");
        diagnostics
            .warning(
                "folding-undecided", nth(pattern.lines, loop.line).place,
                fmt::format("it was not found how the {} folds around {} corners and holes, the first at "
                            "{}, {}: to look for it takes more than the {:.0f} million steps that are "
                            "spent on a sheet",
                            cluster.folds.size(), cluster.loops.size(), shown_point(pattern.ruler, loop.at),
                            went, most / 1e6))
            .hint(
                "leave out lines that are no folds, fold the pattern part by part, or ask with --flat "
                "whether "
                "it folds flat");
    }
}

class Lowering {
 public:
    Lowering(const CreasePattern& pattern, const FoldOptions& options, const Sheet& sheet, const Paths& paths,
             double most_work, Diagnostics& diagnostics)
        : pattern_(pattern),
          options_(options),
          sheet_(sheet),
          paths_(paths),
          most_work_(most_work),
          diagnostics_(diagnostics),
          tree_(folded::make_tree(pattern, sheet)),
          reached_(options.to),
          out_(folded::assembly_of_panels(pattern, sheet, tree_)) {}

    Assembly run() {
        tell_given_up(paths_, most_work_, pattern_, sheet_, diagnostics_);
        for (const folded::Cluster& cluster : paths_.clusters) {
            if (cluster.reached >= 1.0) continue;
            if (!cluster.given_up && cluster.reached < kNearlyThere && cluster.worst_loop >= 0 &&
                !sheet_.bends())
                ask_flat(tell_open(cluster, {}, pattern_, sheet_, diagnostics_));
            // What cannot be folded stays flat, and holds nothing else up.
            if (cluster.reached > 0.0) reached_ = std::min(reached_, cluster.reached);
        }
        for (std::size_t i = 0; i < out_.plates.size(); ++i) add_joint(static_cast<int>(i));
        for (std::size_t i = 0; i < sheet_.folds.size(); ++i) add_fold(static_cast<int>(i));
        tell_other_ways();
        tell_flat_folds();
        tell_jumps();
        tell_other_angles();
        out_.sweep.from_deg = kFlatDeg * (1.0 - reached_);
        out_.sweep.to_deg = kFlatDeg;
        // What was given up is shown flat, and is not; what jumps is torn on the way.
        out_.sweep.bends = sheet_.bends() || paths_.any_given_up() || paths_.any_jumps();
        out_.sweep.closed_flat = reached_ == 1.0 && folds_flat();
        settle_numbers(out_);
        return std::move(out_);
    }

 private:
    void add_joint(int plate) {
        const int panel = nth(tree_.order, plate);
        const int number = nth(tree_.fold_of, panel);
        Joint joint;
        joint.name = nth(out_.plates, plate).name;
        if (number < 0) {
            joint.how = Still{plate};
        } else {
            const Fold& fold = nth(sheet_.folds, number);
            joint.place = nth(pattern_.lines, fold.line).place;
            const bool onwards = fold.left == panel;  // its base is on the right
            Folded how;
            how.plate = plate;
            how.base = nth(tree_.plate_of, onwards ? fold.right : fold.left);
            const Segment line = sheet_.line_of(fold);
            how.at = line.a;
            how.dir = unit(onwards ? line.b - line.a : line.a - line.b);
            how.law = law_of(number);
            joint.how = std::move(how);
        }
        hang_plates(joint, out_.plates);
        out_.joints.push_back(std::move(joint));
    }

    // The point of the fold's line next to p, which may be off it where corners could not be refined.
    [[nodiscard]] Vec2 on_line_of(const Fold& fold, Vec2 p) const {
        const Segment line = sheet_.line_of(fold);
        const Vec2 dir = unit(line.b - line.a);
        return line.a + dot(dir, p - line.a) * dir;
    }

    void add_closing(int number, int left, int right) {
        const Fold& fold = nth(sheet_.folds, number);
        const Segment line = sheet_.line_of(fold);
        Joint joint;
        joint.name = fmt::format("{}|{}", nth(out_.plates, left).name, nth(out_.plates, right).name);
        joint.place = nth(pattern_.lines, fold.line).place;
        joint.how = LoopFold{left, right, line.a, unit(line.b - line.a), law_of(number)};
        out_.joints.push_back(std::move(joint));
    }

    // Over the opening, which falls as the share rises.
    [[nodiscard]] std::vector<Vec2> law_of(int fold) const {
        const std::vector<SharePoint>& law = nth(paths_.laws, fold);
        std::vector<Vec2> result;
        result.reserve(law.size());
        for (auto at = law.rbegin(); at != law.rend(); ++at)
            result.push_back({kFlatDeg * (1.0 - at->share), degrees(at->angle)});
        return result;
    }

    // Where the sweep ends, in radians.
    [[nodiscard]] double final_angle(int fold) const {
        return fold_angle_deg(law_of(fold), kFlatDeg * (1.0 - reached_)) * kPi / 180.0;
    }

    void add_fold(int number) {
        const Fold& fold = nth(sheet_.folds, number);
        const double angle = final_angle(number);
        const bool is_mountain = std::abs(angle) > kFoldedRad ? angle < 0.0 : (fold.ink & kMountain) != 0;
        const int left = nth(tree_.plate_of, fold.left);
        const int right = nth(tree_.plate_of, fold.right);
        const bool in_tree =
            nth(tree_.fold_of, fold.left) == number || nth(tree_.fold_of, fold.right) == number;
        if (!in_tree) add_closing(number, left, right);
        for (const Segment& stretch : sheet_.stretches_of(fold)) {
            const Segment on_line{on_line_of(fold, stretch.a), on_line_of(fold, stretch.b)};
            out_.hinges.push_back({left, right, on_line, on_line});
            if (fold.is_bend()) continue;  // nothing to cut or to score
            Line line{is_mountain ? LineKind::mountain : LineKind::valley, stretch,
                      nth(sheet_.panels, fold.left).piece, left, right};
            const bool to_lie_flat = fold.target == 0.0 && (fold.ink & (kMountain | kValley)) != 0;
            if (std::abs(angle) > kFoldedRad) {
                line.fold_angle = std::min(std::abs(angle), kPi);
            } else if (to_lie_flat) {
                line.fold_angle = 0.0;
            }
            out_.lines.push_back(line);
        }
    }

    // Folds that the loops turn the other way than they are drawn.
    void tell_other_ways() {
        std::size_t told = 0;
        for (std::size_t i = 0; i < sheet_.folds.size(); ++i) {
            const Fold& fold = sheet_.folds[i];
            if (fold.target == 0.0 || (fold.ink & (kMountain | kValley)) == 0) continue;
            const double deg = degrees(final_angle(static_cast<int>(i)));
            if (deg * fold.target > -kOtherWayDeg * std::abs(fold.target)) continue;
            if (++told > kToldAtMost) return;
            ask_flat(diagnostics_
                         .warning("fold-other-way", nth(pattern_.lines, fold.line).place,
                                  fmt::format(
                                      "this fold is drawn as a {}, and its loops turn it the other way, by "
                                      "{:.1f}°, at {}",
                                      fold.target < 0.0 ? "mountain" : "valley", std::abs(deg),
                                      shown_point(pattern_.ruler, sheet_.line_of(fold).a)))
                         .hint("draw it as the other kind, or look at the folds around its ends"));
        }
    }

    // Folds that are to be folded, and that their loops keep flat though others move.
    void tell_flat_folds() {
        std::size_t told = 0;
        for (const folded::Cluster& cluster : paths_.clusters) {
            if (cluster.reached < kNearlyThere) continue;
            for (const int number : cluster.folds) {
                const Fold& fold = nth(sheet_.folds, number);
                if (fold.target == 0.0 || std::abs(final_angle(number)) >= kStaysFlat * std::abs(fold.target))
                    continue;
                if (++told > kToldAtMost) return;
                Diagnostic& flat = diagnostics_.warning(
                    "fold-stays-flat", nth(pattern_.lines, fold.line).place,
                    fmt::format("this fold is to be folded by {:.1f}°, and its loops keep it flat, "
                                "at {}",
                                degrees(std::abs(fold.target)),
                                shown_point(pattern_.ruler, sheet_.line_of(fold).a)));
                flat.hint(what_frees(number));
                ask_flat(flat);
            }
        }
    }
    // Once in a sheet.
    void ask_flat(Diagnostic& told) {
        if (!std::exchange(asked_flat_, true)) folded::ask_flat(sheet_, told);
    }
    [[nodiscard]] std::string what_frees(int number) const {
        std::size_t fewest = 0;
        for (const folded::Loop& loop : sheet_.loops) {
            const bool has = std::any_of(loop.steps.begin(), loop.steps.end(),
                                         [&](const folded::Step& one) { return one.fold == number; });
            if (has && loop.corner && (fewest == 0 || loop.steps.size() < fewest)) fewest = loop.steps.size();
        }
        if (fewest == 4)
            return "look at the corners at its ends: where four folds meet, opposite ones must agree";
        if (fewest == 0)
            return "look at the holes that it leads to: all folds around each must close together";
        return fmt::format(
            "look at the corners at its ends: all {} folds that meet there must close together", fewest);
    }

    // Sets of folds that get to the angles that are asked for, and not without bending.
    void tell_jumps() {
        std::size_t told = 0;
        for (const folded::Cluster& cluster : paths_.clusters) {
            if (cluster.jumps_from < 0.0) continue;
            if (++told > kToldAtMost) return;
            const folded::Loop& loop = nth(sheet_.loops, cluster.loops.front());
            const std::string until = cluster.jumps_from > 0.0
                                          ? fmt::format("the one that was found ends at {:.0f} % of it, and",
                                                        std::floor(100.0 * cluster.jumps_from))
                                          : std::string("none leaves the flat sheet, and");
            diagnostics_
                .warning("no-rigid-way", nth(pattern_.lines, loop.line).place,
                         fmt::format(
                             "the {} folds around {} corner{}, the first at {}, close at the angles "
                             "that are written for them, but no way there was found on which no panel "
                             "bends: {} from there they go to these angles at once",
                             cluster.folds.size(), cluster.loops.size(), cluster.loops.size() == 1 ? "" : "s",
                             shown_point(pattern_.ruler, loop.at), until))
                .hint(
                    "board bends a little on such a way, or creases are missing along which it could; "
                    "collisions are not looked for");
        }
    }

    // Folds that go the way they are drawn, and end elsewhere than they are to.
    void tell_other_angles() {
        if (sheet_.bends()) return;  // that is told already
        int count = 0;
        int worst = -1;
        double most = folded::kOtherAngleDeg;
        bool any_asked = !options_.fold_angles.empty();
        for (const folded::Cluster& cluster : paths_.clusters) {
            if (cluster.reached < kNearlyThere || cluster.other_way) continue;
            for (const int number : cluster.folds) {
                const Fold& fold = nth(sheet_.folds, number);
                any_asked = any_asked || folded::is_asked(pattern_, options_, fold);
                const double end = nth(paths_.laws, number).back().angle;
                // Those that stay flat or go the other way are told one by one.
                if (fold.target == 0.0 || end / fold.target < kStaysFlat) continue;
                const double off = degrees(std::abs(end - fold.target));
                if (off <= folded::kOtherAngleDeg) continue;
                ++count;
                if (off <= most + 1e-6) continue;
                most = off;
                worst = number;
            }
        }
        if (worst < 0) return;
        const Fold& fold = nth(sheet_.folds, worst);
        const Segment line = sheet_.line_of(fold);
        ask_flat(
            diagnostics_
                .warning(
                    "other-angle", nth(pattern_.lines, fold.line).place,
                    fmt::format(
                        "{}, for the loops there close so: that from {} to {} at {:.1f}° instead of {:.1f}°",
                        count == 1 ? std::string("1 fold ends at another angle than it is to")
                                   : fmt::format("{} folds end at other angles than they are to", count),
                        shown_point(pattern_.ruler, line.a), shown_point(pattern_.ruler, line.b),
                        degrees(std::abs(nth(paths_.laws, worst).back().angle)),
                        degrees(std::abs(fold.target))))
                .hint(
                    any_asked || pattern_.fold_deg != kBoxDeg
                        ? "write the angles of a shape that closes for all folds around these corners, or "
                          "for none of those that are to follow: -o NAME.fold shows those that it has now"
                        : "nothing says how far these folds go, so they were to go to 90° as those of boxes; "
                          "where they are those of origami, --fold-angle 180 says so"));
    }

    [[nodiscard]] bool folds_flat() const {
        for (std::size_t i = 0; i < sheet_.folds.size(); ++i) {
            const double angle = std::abs(final_angle(static_cast<int>(i)));
            if (angle > kFoldedRad && std::abs(angle - kPi) > kFoldedRad) return false;
        }
        return true;
    }

    const CreasePattern& pattern_;
    const FoldOptions& options_;
    const Sheet& sheet_;
    const Paths& paths_;
    double most_work_;
    Diagnostics& diagnostics_;
    folded::Tree tree_;
    double reached_;  // where the sweep ends
    bool asked_flat_ = false;
    Assembly out_;
};

// What is told of a sheet whose panels bend: where most, in any state of the motion.
void tell_bends(const folded::Bent& bent, const Paths& rigid, const CreasePattern& pattern,
                const Sheet& sheet, Diagnostics& diagnostics) {
    const Fold* most = nullptr;
    double by = 0.0;
    for (std::size_t i = 0; i < bent.sheet.folds.size(); ++i) {
        const Fold& fold = bent.sheet.folds[i];
        if (!fold.is_bend()) continue;
        for (const SharePoint& at : bent.paths.laws[i]) {
            if (most != nullptr && std::abs(at.angle) <= by) continue;
            by = std::abs(at.angle);
            most = &fold;
        }
    }
    const double reached = bent.paths.reached;
    std::string bends = reached < kNearlyThere
                            ? fmt::format("as far as {:.0f} % of the way its panels are shown bent",
                                          std::floor(100.0 * reached))
                            : "its panels are shown bent";
    if (most != nullptr) {
        const Segment line = bent.sheet.line_of(*most);
        bends += fmt::format(", by {:.1f}° at most, from {} to {}", degrees(by),
                             shown_point(pattern.ruler, line.a), shown_point(pattern.ruler, line.b));
    }
    bool asked_flat = false;
    for (const folded::Cluster& cluster : rigid.clusters) {
        if (cluster.reached != 0.0 || cluster.given_up) continue;
        Diagnostic& told = tell_open(cluster, bends, pattern, sheet, diagnostics);
        if (!std::exchange(asked_flat, true)) folded::ask_flat(sheet, told);
    }
}

// Mostly folds that were taken for cuts.
void tell_no_folds(const CreasePattern& pattern, Diagnostics& diagnostics) {
    const bool any = std::any_of(pattern.lines.begin(), pattern.lines.end(), [](const CreaseLine& line) {
        return line.use != CreaseUse::cut && line.use != CreaseUse::flat;
    });
    if (any) {
        diagnostics.remark("no-folds", {}, "no fold has paper on both sides, so nothing of this sheet folds")
            .hint("lead folds from edge to edge, and close the border around them");
        return;
    }
    std::vector<std::string> names;
    for (const CreaseLine& line : pattern.lines) {
        const std::string name = typed_word(line.name);
        if (line.name.empty() || std::find(names.begin(), names.end(), name) != names.end()) continue;
        names.push_back(name);
    }
    Diagnostic& told =
        diagnostics.remark("no-folds", {}, "no line of this sheet is a fold, so nothing of it folds");
    if (names.empty()) return;
    const bool all = names.size() <= kToldAtMost;
    if (!all) names.resize(kToldAtMost);
    told.hint(fmt::format("say which lines are folds, as --lines fold={}; lines here are called {}{}",
                          names.back(), fmt::join(names, ", "), all ? "" : " and so on"));
}

bool is_sound(const Paths& paths) {
    return paths.reached >= kNearlyThere &&
           std::none_of(paths.clusters.begin(), paths.clusters.end(),
                        [](const folded::Cluster& one) { return one.other_way || !one.all_fold; });
}

std::optional<Assembly> folded_as_asked(const CreasePattern& pattern, const FoldOptions& options,
                                        Diagnostics& diagnostics) {
    if (options.flat) {
        std::optional<FlatFolding> flat = fold_flat(pattern, options, diagnostics);
        if (!flat) return std::nullopt;
        return std::move(flat->assembly);
    }
    if (options.board_mm) {
        FoldOptions rest = options;
        rest.board_mm.reset();
        const auto allowed = allow_for_board(pattern, options, *options.board_mm, diagnostics);
        if (!allowed) {
            diagnostics.remark("board-left-out", {},
                               "allowances for the board are looked for where a sheet folds as it is drawn, "
                               "and this one does not");
            return folded_as_asked(pattern, rest, diagnostics);
        }
        if (allowed->moved) {
            rest.fold_angles.clear();
            rest.snap_mm = kMendedMm;  // what lies beside a crease that was moved is not to snap to it
        }
        return folded_as_asked(allowed->pattern, rest, diagnostics);
    }
    const std::optional<Sheet> drawn = folded::make_sheet(pattern, options, diagnostics);
    if (!drawn) return std::nullopt;
    if (drawn->folds.empty()) tell_no_folds(pattern, diagnostics);
    std::optional<Sheet> sheet = drawn;
    const bool has_bent_folds = folded::has_bent_folds(*sheet);
    const folded::PathOptions path{options.closure_mm};
    folded::Work work;
    Paths paths = folded::find_paths(*sheet, path, work);
    const double most_mm = std::max(options.refine_mm, kRefineShare * sheet->size());
    const auto refine_whole = [&] {
        if (const folded::Refined refined = folded::refine(*sheet, paths, most_mm, work); refined.closes) {
            folded::tell(refined, pattern, *sheet, diagnostics);
            paths = folded::find_paths(*sheet, path, work);
        }
    };
    if (!is_sound(paths)) {
        Sheet straight = *sheet;
        const folded::Refined refined = folded::straighten(straight, most_mm, work);
        Paths straight_on = refined.closes ? folded::find_paths(straight, path, work) : Paths{};
        if (refined.closes && is_sound(straight_on)) {
            sheet = std::move(straight);
            paths = std::move(straight_on);
            folded::tell(refined, pattern, *sheet, diagnostics);
        } else {
            refine_whole();
        }
    } else if (has_bent_folds) {
        refine_whole();
    }
    if (paths.any_stays()) {
        if (const std::optional<folded::Bent> bent = bend_panels(pattern, options, *drawn, paths, work)) {
            tell_bends(*bent, paths, pattern, *drawn, diagnostics);
            return Lowering(pattern, options, bent->sheet, bent->paths, work.most(), diagnostics).run();
        }
    }
    static_cast<void>(folded::end_as_asked(pattern, options, *sheet, paths, work));
    return Lowering(pattern, options, *sheet, paths, work.most(), diagnostics).run();
}

}  // namespace

std::optional<Assembly> fold_sheet(const CreasePattern& pattern, const FoldOptions& options,
                                   Diagnostics& diagnostics) {
    folded::tell_unused_angles(pattern, options, diagnostics);
    return folded_as_asked(pattern, options, diagnostics);
}

}  // namespace popup
