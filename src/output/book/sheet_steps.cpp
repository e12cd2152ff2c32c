#include "output/book/sheet_steps.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "base/nth.h"
#include "base/text/numbers.h"
#include "gluing/glue_flaps.h"
#include "output/book/panel_labels.h"
#include "output/book/words.h"
#include "popup/motion.h"

namespace popup::book {
namespace {

constexpr float kWashed = 0.62F;
constexpr std::size_t kMostNames = 12;
constexpr std::size_t kMostTitled = 8;
constexpr double kSameDeg = 0.5;     // angles that are told alike
constexpr double kFlatRad = 0.01;    // creases that end flat
constexpr double kSharpDeg = 179.5;  // "right over"

std::string panel_of(const Assembly& in, int plate) {
    const std::string& name = nth(in.plates, plate).name;
    const std::string start = nth(in.pieces, nth(in.plates, plate).piece).name + "/";
    return name.starts_with(start) ? name.substr(start.size()) : name;
}

std::string degrees_text(double deg) { return number_text(std::round(std::abs(deg)), 0) + "°"; }

bool is_flat_crease(const Line& line) {
    return (line.kind == LineKind::mountain || line.kind == LineKind::valley) && line.fold_angle &&
           *line.fold_angle < kFlatRad;
}

// Of a fold in a step: how far it is folded before, after, and when all is folded, degrees.
struct Turn {
    int hinge = 0;
    double from = 0.0, to = 0.0, end = 0.0;
    [[nodiscard]] bool is_told() const { return std::abs(to - from) > kSameDeg; }
    [[nodiscard]] bool is_mountain() const { return (std::abs(to) > kSameDeg ? to : from) < 0.0; }
};

// "Mountain folds, on from 80° to 90°".
std::string way_of(const Turn& turn) {
    const std::string kind = turn.is_mountain() ? "Mountain" : "Valley";
    if (std::abs(turn.to) < kSameDeg)
        return fmt::format("{} folds, back from {} until they are flat", kind, degrees_text(turn.from));
    const std::string to = std::abs(turn.to) > kSharpDeg ? "right over" : "to " + degrees_text(turn.to);
    std::string from;
    if (std::abs(turn.from) > kSameDeg && turn.from * turn.to > 0.0)
        from = fmt::format("{} from {} ", std::abs(turn.to) < std::abs(turn.from) ? "back" : "on",
                           degrees_text(turn.from));
    std::string later;
    if (std::abs(turn.to - turn.end) > kSameDeg)
        later = std::abs(turn.to) > std::abs(turn.end) ? ", for now further than they stay"
                                                       : ", for now not all the way";
    return fmt::format("{} folds, {}{}{}", kind, from, to, later);
}

class SheetSteps {
 public:
    SheetSteps(const SceneCard& card, std::size_t number, int& steps)
        : card_(card),
          in_(*card.assembly),
          number_(number),
          steps_(steps),
          folding_(folding_steps(in_)),
          flaps_(glue_flaps(in_)),
          end_(frames_at(in_.sweep.from_deg)) {}

    std::vector<Chapter> run() {
        std::vector<int> folded;
        for (std::size_t i = 0; i < in_.pieces.size(); ++i) {
            const auto piece = static_cast<int>(i);
            if (std::any_of(folding_.begin(), folding_.end(),
                            [&](const FoldingStep& fold) { return has_folds_of(fold, piece); }))
                folded.push_back(piece);
        }
        std::vector<Chapter> chapters;
        chapters.reserve(folded.size());
        for (const int piece : folded) chapters.push_back(chapter_of(piece, folded.size() > 1));
        return chapters;
    }

 private:
    [[nodiscard]] int piece_of(int plate) const { return nth(in_.plates, plate).piece; }
    [[nodiscard]] bool is_of(int hinge, int piece) const {
        return piece_of(nth(in_.hinges, hinge).a) == piece;
    }
    [[nodiscard]] bool has_folds_of(const FoldingStep& fold, int piece) const {
        return std::any_of(fold.hinges.begin(), fold.hinges.end(),
                           [&](int hinge) { return is_of(hinge, piece); });
    }
    [[nodiscard]] std::vector<Frame> frames_at(double opening_deg) const {
        std::vector<Frame> frames(in_.plates.size());
        if (!place(in_, Angle::degrees(opening_deg), frames)) frames.clear();
        return frames;
    }
    [[nodiscard]] std::string panel(int plate) const { return panel_of(in_, plate); }

    // Nothing is in the way only where that was examined.
    [[nodiscard]] bool is_clear() const {
        if (card_.motion == nullptr || !card_.motion->examination) return false;
        const Examination& found = *card_.motion->examination;
        return found.contacts.empty() && found.undecided.empty();
    }

    Chapter chapter_of(int piece, bool is_one_of_several) {
        const std::string& name = nth(in_.pieces, piece).name;
        std::vector<std::size_t> own;
        for (std::size_t i = 0; i < folding_.size(); ++i) {
            if (has_folds_of(folding_[i], piece)) own.push_back(i);
        }
        Chapter chapter;
        chapter.title = is_one_of_several ? "Fold " + name : "Fold";
        if (own.size() > 1)
            chapter.intro =
                fmt::format("{}Let what is folded stay folded.",
                            is_clear() ? "In this order nothing is in the way of anything. " : "");
        for (std::size_t i = 0; i < own.size(); ++i) {
            const std::size_t next = i + 1 < own.size() ? own[i + 1] : folding_.size();
            chapter.steps.push_back(step_of(piece, own, i, is_one_of_several));
            add_flaps(piece, i == 0 ? 0 : own[i], next, chapter.steps.back());
        }
        return chapter;
    }

    Step step_of(int piece, const std::vector<std::size_t>& own, std::size_t which, bool is_one_of_several) {
        const FoldingStep& fold = folding_[own[which]];
        const std::vector<Turn> turns = turns_of(fold, piece);
        Step step;
        const std::string& name = nth(in_.pieces, piece).name;
        std::string what = is_one_of_several ? "fold " + name : "fold the sheet";
        if (own.size() > 1)
            what = title_of(fold, piece, turns) + (is_one_of_several ? " of " + name : std::string());
        step.title = fmt::format("Step {}: {}", ++steps_, what);
        if (which == 0) {
            if (std::string flat = flat_creases(in_, piece); !flat.empty())
                step.actions.push_back(std::move(flat));
        }
        add_ways(turns, step);
        if (turns.size() > kMostNames)
            step.actions.emplace_back(
                "Crease each fold by itself first. Then take the sheet in both hands and move all "
                "of them a little further, again and again, until they are where they end.");
        add_figure(piece, turns, which == 0, step);
        step.large_figures = true;
        add_scenes(fold, piece, own.size() == 1, step);
        return step;
    }

    [[nodiscard]] std::vector<Turn> turns_of(const FoldingStep& fold, int piece) const {
        const std::vector<Frame> from = frames_at(fold.from_deg);
        const std::vector<Frame> to = frames_at(fold.to_deg);
        std::vector<Turn> turns;
        if (from.empty() || to.empty() || end_.empty()) return turns;
        for (const int number : fold.hinges) {
            if (!is_of(number, piece)) continue;
            const Hinge& hinge = nth(in_.hinges, number);
            const auto folded = [&hinge](const std::vector<Frame>& frames) {
                return folded_deg(hinge, nth(frames, hinge.a), nth(frames, hinge.b));
            };
            const Turn turn{number, folded(from), folded(to), folded(end_)};
            if (turn.is_told()) turns.push_back(turn);
        }
        return turns;
    }

    // Mountains go away from whoever looks at the print that lies there, valleys towards them.
    [[nodiscard]] std::string title_of(const FoldingStep& fold, int piece,
                                       const std::vector<Turn>& turns) const {
        std::vector<std::string> moved;
        for (const int plate : fold.plates) {
            if (piece_of(plate) == piece) moved.push_back(panel(plate));
        }
        const auto goes_on = [](const Turn& turn) { return std::abs(turn.to) > std::abs(turn.from); };
        const auto goes_down = [&](const Turn& turn) { return turn.is_mountain() == goes_on(turn); };
        const bool all_down = std::all_of(turns.begin(), turns.end(), goes_down);
        const bool all_up = std::none_of(turns.begin(), turns.end(), goes_down);
        return fmt::format("fold {}{} {}",
                           all_down ? "down "
                           : all_up ? "up "
                                    : "",
                           moved.size() == 1 ? "panel" : "panels", listed(moved, kMostTitled));
    }

    // "Mountain folds, to 90°: between a | b and a | c."
    void add_ways(const std::vector<Turn>& turns, Step& step) const {
        std::vector<std::pair<std::string, std::vector<std::string>>> alike;
        for (const Turn& turn : turns) {
            std::string how = way_of(turn);
            const Hinge& hinge = nth(in_.hinges, turn.hinge);
            const std::string where = fmt::format("{} | {}", panel(hinge.a), panel(hinge.b));
            const auto same = std::find_if(alike.begin(), alike.end(),
                                           [&how](const auto& one) { return one.first == how; });
            if (same == alike.end()) {
                alike.emplace_back(std::move(how), std::vector<std::string>{where});
            } else if (std::find(same->second.begin(), same->second.end(), where) == same->second.end()) {
                same->second.push_back(where);  // of a fold in several stretches once
            }
        }
        for (const auto& [how, where] : alike)
            step.actions.push_back(fmt::format("{}: between {}.", how, listed(where, kMostNames)));
    }

    // The sheet with its panels' names, and the folds of one step.
    void add_figure(int piece, const std::vector<Turn>& turns, bool with_flat, Step& step) const {
        if (card_.pattern == nullptr) return;
        FoldedSheet sheet;
        for (const Turn& turn : turns)
            sheet.folds.push_back({nth(in_.hinges, turn.hinge).a_line, turn.is_mountain()});
        for (const Line& line : in_.lines) {
            if (with_flat && line.piece == piece && is_flat_crease(line))
                sheet.folds.push_back({line.at, line.kind == LineKind::mountain});
        }
        if (sheet.folds.empty()) return;
        for (const int plate : nth(in_.pieces, piece).plates)
            sheet.panels.push_back({panel(plate), nth(in_.plates, plate).outline});
        Figure figure = fold_figure(nth(card_.pattern->pieces, piece), sheet);
        step.key = settle_labels(figure);
        step.figures.push_back(std::move(figure));
    }

    void add_scenes(const FoldingStep& fold, int piece, bool all, Step& step) const {
        const auto scene = [&](double opening_deg, const char* alt) {
            Scene one;
            one.card = number_;
            one.opening_deg = opening_deg;
            one.alt = alt;
            one.fades.assign(in_.plates.size(), -1.0F);
            for (const int plate : nth(in_.pieces, piece).plates)
                nth(one.fades, plate) = all ? 0.0F : kWashed;
            for (const int plate : fold.plates) {
                if (piece_of(plate) == piece) nth(one.fades, plate) = 0.0F;
            }
            return one;
        };
        step.scenes = {scene(fold.from_deg, "Before"), scene(fold.to_deg, "After")};
        step.captions = {"before", "after"};
    }

    // Of flaps of the piece that lie there after one of these steps.
    void add_flaps(int piece, std::size_t from, std::size_t end, Step& step) const {
        for (const GlueFlap& one : flaps_) {
            const auto after = static_cast<std::size_t>(std::max(one.step, 0));
            if (piece_of(one.flap) != piece || after < from || after >= end) continue;
            step.actions.push_back(
                one.panel < 0
                    ? fmt::format("Put glue on {}, and press it onto what it comes to lie on.",
                                  panel(one.flap))
                    : fmt::format("Put glue on {}, and press it onto the {} of {} until it holds.",
                                  panel(one.flap), one.inside ? "inside" : "outside", panel(one.panel)));
        }
    }

    const SceneCard& card_;
    const Assembly& in_;
    std::size_t number_;
    int& steps_;
    std::vector<FoldingStep> folding_;
    std::vector<GlueFlap> flaps_;
    std::vector<Frame> end_;  // all folded
};

}  // namespace

std::string flat_creases(const Assembly& assembly, int piece) {
    std::vector<std::string> where;
    for (const Line& line : assembly.lines) {
        if (line.piece != piece || !is_flat_crease(line) || line.plate < 0 || line.other_plate < 0) continue;
        std::string one =
            fmt::format("{} | {}", panel_of(assembly, line.plate), panel_of(assembly, line.other_plate));
        if (std::find(where.begin(), where.end(), one) == where.end()) where.push_back(std::move(one));
    }
    if (where.empty()) return {};
    const bool is_one = where.size() == 1;
    return fmt::format("Score the {} between {}, fold {} once, and open {} again: {} flat when it stands.",
                       is_one ? "fold" : "folds", listed(where, kMostNames), is_one ? "it" : "them",
                       is_one ? "it" : "them", is_one ? "it stays" : "they stay");
}

std::vector<Chapter> sheet_chapters(const SceneCard& card, std::size_t number, int& steps) {
    return SheetSteps(card, number, steps).run();
}

}  // namespace popup::book
