#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "edit/session.h"
#include "edit/trial.h"
#include "input/xml/read.h"
#include "popup/edit.h"

namespace popup {
namespace {

constexpr std::size_t kMostElements = 150;
constexpr std::size_t kElementsTried = 160;  // elements times compilations
constexpr std::size_t kMostTrials = 8;
// Poses of pairs looked at in all trials; after so many there is no other. Most designs take some hundreds
// each.
constexpr std::size_t kMostPoses = 20'000;
constexpr double kFurthestMm = 100.0;
constexpr double kTabStepMm = 0.5;
constexpr double kTabPreciseMm = 0.002;  // before lengths are rounded up to the hundredth
constexpr double kStillSharedMm = 0.01;  // of seams: less is shared by none
constexpr double kMovedAlikeMm = 1e-6;   // both ends of a seam move alike
// Where a move that clears the tabs does something else, one a little longer may not: so much longer.
constexpr double kFurther[] = {0.0, 1.0, 3.0, 7.0, 15.0};

double rounded_up(double mm) { return std::ceil(mm * 100.0 - 1e-9) / 100.0; }
// What is printed with two decimals: never "-0.00".
double in_hundredths(double mm) { return std::round(mm * 100.0) / 100.0 + 0.0; }

// Where a design's seams are glued, if one of its elements is moved by so much along its fold.
class SlidGlue {
 public:
    SlidGlue(const Assembly& assembly, std::vector<Vec2> by) : trial_(assembly), by_(std::move(by)) {
        for (const Glue& glue : assembly.glue) places_.push_back(glue.on_base);
    }
    const Assembly& at(double mm) {
        for (std::size_t i = 0; i < places_.size(); ++i) {
            trial_.glue[i].on_base = {places_[i].a + mm * by_[i], places_[i].b + mm * by_[i]};
        }
        return trial_;
    }

 private:
    Assembly trial_;
    std::vector<Vec2> by_;  // of each glue, for each millimetre
    std::vector<Segment> places_;
};

class MoveSearch {
 public:
    MoveSearch(const CompiledDesign& one, const CompileOptions& options, const std::string& element)
        : one_(one), options_(options), element_(element) {
        const std::vector<Structure>& all = one.checked->design().structures;
        if (all.size() <= kMostElements)
            trials_ = std::clamp(kElementsTried / std::max<std::size_t>(all.size(), 1), std::size_t{1},
                                 kMostTrials);
    }

    std::optional<std::string> shortest() {
        if (trials_ == 0) return std::nullopt;
        for (const double mm : clear_moves()) {
            if (trials_ == 0 || poses_ > kMostPoses) break;
            const auto by = tried(mm);
            if (!by) continue;
            return fmt::format(
                "moving \"{}\" {:.2f} mm along its fold, by ({:.2f}, {:.2f}) mm on the page, keeps its tabs "
                "clear of all others: popupc edit … {}",
                element_, std::abs(mm), in_hundredths(by->x), in_hundredths(by->y),
                fmt::join(words_of(mm), " "));
        }
        return std::nullopt;
    }

 private:
    [[nodiscard]] std::vector<std::string> words_of(double mm) const {
        return {"move", element_, fmt::format("--along={:.2f}mm", mm), "--follow"};
    }

    // How far the seams of all elements move on what they are glued on, if the element is moved by 1 mm.
    // nullopt: it cannot be moved so, or they do not move straight.
    [[nodiscard]] std::optional<std::vector<Vec2>> seams_moved() const {
        Diagnostics unheard(one_.source.name);
        edit::Session session(*one_.design, one_.source.name, options_.check.tolerances, unheard);
        if (!edit::move(session, {"move", {element_}, {{"along", "1mm"}, {"follow", ""}}}))
            return std::nullopt;
        Source source = one_.source;
        source.text = xml::patch(one_.source, session.design, session.gone);
        const auto moved = edit::assembled(source, options_, unheard);
        const std::vector<Glue>& before = one_.assembly->glue;
        if (!moved || moved->glue.size() != before.size()) return std::nullopt;
        std::vector<Vec2> by;
        for (std::size_t i = 0; i < before.size(); ++i) {
            const Glue& glue = moved->glue[i];
            by.push_back(glue.on_base.a - before[i].on_base.a);
            if (glue.element != before[i].element || glue.base_plate != before[i].base_plate ||
                length(glue.on_base.b - before[i].on_base.b - by.back()) > kMovedAlikeMm)
                return std::nullopt;
        }
        return by;
    }

    // The moves to be tried, the shortest first; those back along the fold are negative.
    [[nodiscard]] std::vector<double> clear_moves() const {
        const auto by = seams_moved();
        if (!by) return {};
        SlidGlue glue(*one_.assembly, *by);
        std::vector<double> moves;
        for (const double sense : {1.0, -1.0}) {
            const auto is_clear = [&](double mm) {
                return mm <= kFurthestMm &&
                       shared_seams(glue.at(sense * mm), element_, options_.pattern) <= kStillSharedMm;
            };
            double clear = kTabStepMm;
            while (clear <= kFurthestMm && !is_clear(clear)) clear += kTabStepMm;
            for (double shared = clear - kTabStepMm;
                 clear <= kFurthestMm && clear - shared > kTabPreciseMm;) {
                const double middle = 0.5 * (shared + clear);
                (is_clear(middle) ? clear : shared) = middle;
            }
            for (const double more : kFurther) {
                if (is_clear(rounded_up(clear + more))) moves.push_back(sense * rounded_up(clear + more));
            }
        }
        std::stable_sort(moves.begin(), moves.end(),
                         [](double a, double b) { return std::abs(a) < std::abs(b); });
        return moves;
    }

    // By how much the edit, carried out in the document, moves the element on its page; nullopt: it cannot
    // be, or something is found that is not found in the design as it is.
    std::optional<Vec2> tried(double mm) {
        const EditLine edit{words_of(mm), {}};
        Diagnostics unheard;
        const auto edited =
            edit_document(one_.source, {&edit, 1}, {false, options_.read, options_.check}, unheard, unheard);
        if (!edited || edited->refused || unheard.has_findings()) return std::nullopt;
        --trials_;
        CompileOptions options = edit::without_hints(options_);
        options.until = Stage::check;
        Source source = one_.source;
        source.text = edited->text;
        Compilation trial = compile({source}, options, one_.diagnostics.policy());
        CompiledDesign& moved = trial.designs.front();
        find_further(moved, options);
        if (moved.motion && moved.motion->examination) poses_ += moved.motion->examination->poses;
        if (!moved.assembly || (moves(*moved.assembly) && !moved.motion)) return std::nullopt;
        const edit::FindingCounts found = edit::count_findings(moved.diagnostics);
        if (found.contains({"glue-overlaps", element_}) || edit::finds_more(before(), found))
            return std::nullopt;
        const auto n = number();
        return n ? std::optional(moved.design->structures[*n].points.front().at -
                                 one_.design->structures[*n].points.front().at)
                 : std::nullopt;
    }

    // What is found in the design as it is, with what is not found yet: its pattern is being made.
    const edit::FindingCounts& before() {
        if (!before_) {
            before_ = edit::count_findings(one_.diagnostics);
            Diagnostics of_pattern(one_.source.name, one_.diagnostics.policy());
            PatternOptions options = options_.pattern;
            options.clearing_move = {};
            judge_tabs(*one_.assembly, options, of_pattern);
            for (const auto& [finding, count] : edit::count_findings(of_pattern))
                (*before_)[finding] = std::max((*before_)[finding], count);
        }
        return *before_;
    }

    [[nodiscard]] std::optional<std::size_t> number() const {
        const std::vector<Structure>& all = one_.design->structures;
        const auto found =
            std::find_if(all.begin(), all.end(), [&](const Structure& s) { return s.id == element_; });
        if (found == all.end() || found->points.empty()) return std::nullopt;
        return static_cast<std::size_t>(found - all.begin());
    }

    const CompiledDesign& one_;
    const CompileOptions& options_;
    const std::string& element_;
    std::size_t trials_ = 0;
    std::size_t poses_ = 0;
    std::optional<edit::FindingCounts> before_;
};

}  // namespace

std::optional<std::string> clearing_move(const CompiledDesign& design, const CompileOptions& options,
                                         const std::string& element) {
    if (!edit::can_be_tried(design, options)) return std::nullopt;
    return MoveSearch(design, options, element).shortest();
}

}  // namespace popup
