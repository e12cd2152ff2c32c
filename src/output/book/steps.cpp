#include "output/book/steps.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "base/nth.h"
#include "output/book/panel_labels.h"
#include "output/book/sheet_steps.h"
#include "output/book/words.h"
#include "popup/motion.h"

namespace popup::book {
namespace {

constexpr float kWashed = 0.62F;
constexpr std::size_t kMostTogether = 6;  // flat pieces that are glued in one step
constexpr std::size_t kMostNames = 12;
constexpr double kOpensFlatDeg = 170.0;
constexpr double kSameMm2 = 1e-6;  // the first of plates as large is named

class CardSteps {
 public:
    CardSteps(const SceneCard& card, std::size_t number, bool backs_are_marked)
        : card_(card),
          in_(*card.assembly),
          number_(number),
          words_(card, backs_are_marked),
          order_(gluing_order(in_)) {
        borne_.resize(in_.pieces.size());
        for (std::size_t i = 0; i < in_.pieces.size(); ++i) {
            if (order_.bearers[i] >= 0) nth(borne_, order_.bearers[i]).push_back(static_cast<int>(i));
        }
        there_.assign(in_.pieces.size(), false);
        for (const PushedOut& one : pushed_out(in_)) pushed_[one.piece].push_back(one);
        leave_out_missing_tabs(tabs_on_sheets(card));
    }

    std::vector<Chapter> run() {
        if (!folding_steps(in_).empty()) {
            chapters_ = sheet_chapters(card_, number_, steps_);
        } else if (!moves(in_) && in_.glue.empty() && in_.glued_areas.empty()) {
            fold_flat();
        } else {
            fold_card();
        }
        glue();
        return std::move(chapters_);
    }

 private:
    // Nobody glues tabs that no sheet has: the steps keep their order, and a note tells of those edges.
    void leave_out_missing_tabs(const std::vector<bool>& there) {
        const auto is_missing = [&](const Bond& bond) {
            return bond.kind == Bond::Kind::tab && !there[static_cast<std::size_t>(bond.number)];
        };
        for (GluingStep& step : order_.steps) {
            const auto clear = [&](std::vector<Bond>& bonds) {
                for (const Bond& bond : bonds) {
                    if (is_missing(bond)) missing_[step.piece].push_back(words_.label(bond));
                }
                std::erase_if(bonds, is_missing);
            };
            std::erase_if(step.under, is_missing);
            std::erase_if(step.onto, [&](const auto& one) { return is_missing(one.first); });
            clear(step.ring);
            for (BondTurn& turn : step.turns) clear(turn.bonds);
            std::erase_if(step.turns, [](const BondTurn& turn) { return turn.bonds.empty(); });
        }
    }

    [[nodiscard]] double opening(double share) const {
        return in_.sweep.from_deg + share * (in_.sweep.to_deg - in_.sweep.from_deg);
    }
    [[nodiscard]] std::string numbered(const std::string& what) {
        return fmt::format("Step {}: {}", ++steps_, what);
    }
    [[nodiscard]] bool shows() const { return has_model(in_); }

    // Of a scene: what of it is washed out; none of it is there.
    [[nodiscard]] Scene scene(double share, std::string alt) const {
        Scene one;
        one.card = number_;
        one.opening_deg = opening(share);
        one.fades.assign(in_.plates.size(), -1.0F);
        one.alt = std::move(alt);
        return one;
    }
    void show(Scene& scene, int piece, float fade) const {
        for (const int plate : nth(in_.pieces, piece).plates) nth(scene.fades, plate) = fade;
    }

    [[nodiscard]] const PatternPiece* pattern_of(int piece) const {
        return card_.pattern == nullptr ? nullptr : &nth(card_.pattern->pieces, piece);
    }
    void add_figure(int piece, const std::vector<std::string>& wanted, Step& step) const {
        if (const PatternPiece* const from = pattern_of(piece))
            step.figures.push_back(piece_figure(*from, wanted));
    }

    // Which of several it is.
    void name_figure(int piece, Figure& figure) const {
        figure.labels.push_back(
            {words_.number(piece), {0.5 * figure.width_mm, 0.5 * figure.height_mm}, {}, 0.0});
    }

    // What is cut out of a piece and hangs on its folds.
    void add_pushes(int piece, Step& step) const {
        const auto all = pushed_.find(piece);
        if (all == pushed_.end()) return;
        std::map<int, std::vector<std::string>> levels;
        for (const PushedOut& one : all->second) levels[one.level].push_back(one.name);
        std::string text = "Push out ";
        bool first = true;
        for (const auto& [level, names] : levels) {
            text += (first ? "" : "; then ") + listed(names, kMostNames) + (first ? " from behind" : "");
            first = false;
        }
        const bool is_one = all->second.size() == 1;
        step.actions.push_back(fmt::format("{}, so that {} folds turn the other way than those beside {}.",
                                           text, is_one ? "its" : "their", is_one ? "it" : "them"));
    }

    // The card's own piece, before anything is glued on it.
    void fold_card() {
        if (words_.fold_count(order_.card).empty()) return;
        Chapter& chapter = chapters_.emplace_back();
        chapter.title = "Fold";
        Step step;
        step.title = numbered(fmt::format("crease {}", words_.piece(order_.card)));
        step.actions = words_.folds(order_.card);
        add_figure(order_.card, {}, step);
        step.large_figures = pushed_.contains(order_.card);
        const auto pushes = pushed_.find(order_.card);
        const bool glued = !order_.steps.empty();
        if (pushes == pushed_.end()) {
            step.actions.emplace_back("Close the card, press the fold with a fingernail, and open it again.");
        } else {
            step.actions.emplace_back(
                "Fold each line once, only a little, the way it goes: then all move easily later.");
        }
        chapter.steps.push_back(std::move(step));
        if (pushes != pushed_.end()) push_out(pushes->second, chapter);
        if (glued && pushes != pushed_.end())
            chapter.steps.back().notes.emplace_back(
                "Before you glue, open the card flat again: what was pushed out lies "
                "flat, and its folds remember their ways.");
    }

    [[nodiscard]] bool opens_flat() const { return in_.sweep.to_deg > kOpensFlatDeg; }

    // The drawing says which those are, by their names.
    void add_pushed_figure(const std::vector<const PushedOut*>& here, Step& step) const {
        const PatternPiece* const from = pattern_of(order_.card);
        if (from == nullptr) return;
        FoldedSheet sheet;
        for (const PushedOut* const one : here) {
            const auto paper = [this](int plate) { return area(nth(in_.plates, plate).outline); };
            for (const int plate : one->plates) sheet.marked.push_back(nth(in_.plates, plate).outline);
            const int largest = *std::max_element(one->plates.begin(), one->plates.end(), [&](int a, int b) {
                return paper(a) < paper(b) - kSameMm2;
            });
            sheet.panels.emplace_back(one->name, nth(in_.plates, largest).outline);
        }
        Figure figure = fold_figure(*from, sheet);
        step.key = settle_labels(figure);
        step.figures.push_back(std::move(figure));
        step.large_figures = true;
    }

    // Flat, and half open. What does not open flat is flat as it is cut, and stands when it is open.
    void add_pushed_scenes(const std::vector<const PushedOut*>& here, Step& step) const {
        Scene before = scene(1.0, "Before: flat, with what is pushed out in its colours");
        Scene after =
            scene(opens_flat() ? 0.5 : 1.0, fmt::format("After: {}, with what is pushed out in its colours",
                                                        opens_flat() ? "half open" : "open"));
        before.as_still = after.as_still = true;
        if (!opens_flat()) {
            before.on_table = order_.card;
            before.unfolded = true;
        }
        for (Scene* const one : {&before, &after}) {
            show(*one, order_.card, kWashed);
            for (const PushedOut* const pushed : here) {
                for (const int plate : pushed->plates) {
                    nth(one->fades, plate) = 0.0F;
                    const Plate& paper = nth(in_.plates, plate);
                    // Bare paper looks the same, washed out or not.
                    if (!paper.fill && paper.prints.empty()) one->painted.push_back(plate);
                }
            }
        }
        step.scenes = {std::move(before), std::move(after)};
        step.captions = {"before", "after"};
    }

    // A level at a time: what hangs on the card, then what hangs on that.
    void push_out(const std::vector<PushedOut>& all, Chapter& chapter) {
        const int levels = all.back().level;
        for (int level = 1; level <= levels; ++level) {
            std::vector<std::string> names;
            std::vector<const PushedOut*> here;
            for (const PushedOut& one : all) {
                if (one.level != level) continue;
                names.push_back(one.name);
                here.push_back(&one);
            }
            Step step;
            step.title = numbered("push out " + listed(names, 4));
            if (names.size() > 5) step.actions.push_back(fmt::format("These: {}.", listed(names, 60)));
            step.actions.push_back(level == 1 ? fmt::format("{} Put a finger behind each of these "
                                                            "and push it towards you, until its middle fold "
                                                            "stands out and its outer folds turn inwards.",
                                                            opens_flat() ? "Open the card about half."
                                                                         : "Fold the sheet a little.")
                                              : "Likewise with these, which hang on what stands out already. "
                                                "Where one sinks in instead, push "
                                                "it away from you: its middle fold is a valley.");
            if (level == levels)
                step.actions.emplace_back(
                    "Close the card slowly, and help with a finger wherever a fold does not know its "
                    "way. Press it flat, and open it.");
            add_pushed_figure(here, step);
            if (shows()) add_pushed_scenes(here, step);
            chapter.steps.push_back(std::move(step));
        }
    }

    // A sheet that is known as it lies in the end.
    void fold_flat() {
        Chapter& chapter = chapters_.emplace_back();
        chapter.title = "Fold";
        Step step;
        step.title = numbered("fold the sheet");
        for (std::size_t i = 0; i < in_.pieces.size(); ++i) {
            const std::string folds = words_.fold_count(static_cast<int>(i));
            if (!folds.empty())
                step.actions.push_back(fmt::format("Crease the folds of {}: {}.", in_.pieces[i].name, folds));
            if (std::string flat = flat_creases(in_, static_cast<int>(i)); !flat.empty())
                step.actions.push_back(std::move(flat));
            add_figure(static_cast<int>(i), {}, step);
        }
        step.large_figures = true;
        step.actions.emplace_back(
            "Fold it until it lies as the picture shows. In which order its folds go is not known.");
        if (shows()) {
            Scene after = scene(0.0, "The sheet as it lies folded");
            std::fill(after.fades.begin(), after.fades.end(), 0.0F);
            step.scenes = {std::move(after)};
            step.captions = {"after"};
        }
        chapter.steps.push_back(std::move(step));
    }

    void glue() {
        const Chapter* of_ground = nullptr;
        int ground = -1;
        for (std::size_t i = 0; i < order_.steps.size();) {
            const GluingStep& first = order_.steps[i];
            if (of_ground == nullptr || first.ground != ground) {
                ground = first.ground;
                of_ground = &begin_chapter(ground);
            }
            std::size_t last = i + 1;
            while (last < order_.steps.size() && last - i < kMostTogether &&
                   are_alike(first, order_.steps[last]))
                ++last;
            chapters_.back().steps.push_back(step_of(std::span(order_.steps).subspan(i, last - i)));
            i = last;
        }
    }

    Chapter& begin_chapter(int ground) {
        Chapter& chapter = chapters_.emplace_back();
        if (ground == order_.card) {
            chapter.title = fmt::format("Glue on {}", words_.piece(ground));
            return chapter;
        }
        chapter.title = fmt::format("Sub-assembly: {}", words_.piece(ground));
        chapter.intro = "Made on the table, before it is glued to anything else.";
        if (words_.fold_count(ground).empty() && !pushed_.contains(ground)) return chapter;
        Step step;
        step.title = numbered(fmt::format("crease {}", words_.piece(ground)));
        step.actions = words_.folds(ground);
        add_pushes(ground, step);
        step.actions.emplace_back("Open the folds again, so that the piece lies on the table.");
        add_figure(ground, {}, step);
        creased_.insert(ground);
        chapter.steps.push_back(std::move(step));
        return chapter;
    }

    // Flat pieces are glued on one after another, and one picture shows them.
    [[nodiscard]] bool are_alike(const GluingStep& a, const GluingStep& b) const {
        const auto is_flat = [&](const GluingStep& step) {
            return step.ring.empty() && step.turns.size() == 1 && nth(borne_, step.piece).empty() &&
                   step.turns.front().bonds.size() == 1 &&
                   step.turns.front().bonds.front().kind == Bond::Kind::area;
        };
        return is_flat(a) && is_flat(b) && a.ground == b.ground && a.lie == b.lie;
    }

    [[nodiscard]] static std::vector<Bond> bonds_of(const GluingStep& step) {
        std::vector<Bond> bonds;
        for (const BondTurn& turn : step.turns)
            bonds.insert(bonds.end(), turn.bonds.begin(), turn.bonds.end());
        return bonds;
    }

    [[nodiscard]] std::vector<Bond> later_bonds() const {
        std::vector<Bond> all;
        for (const GluingStep& step : order_.steps) {
            const std::vector<Bond> bonds = bonds_of(step);
            all.insert(all.end(), bonds.begin(), bonds.end());
        }
        return all;
    }

    // All pieces that come with a piece.
    [[nodiscard]] std::vector<int> with_borne(int piece) const {
        std::vector<int> all{piece};
        for (std::size_t i = 0; i < all.size(); ++i) {
            const std::vector<int>& more = nth(borne_, all[i]);
            all.insert(all.end(), more.begin(), more.end());
        }
        return all;
    }

    Step step_of(std::span<const GluingStep> together) {
        const GluingStep& first = together.front();
        Step step;
        std::vector<std::string> names;
        for (const GluingStep& one : together) names.push_back(words_.piece(one.piece));
        const std::vector<Bond> bonds = bonds_of(first);
        const bool by_brad = std::all_of(bonds.begin(), bonds.end(),
                                         [](const Bond& bond) { return bond.kind == Bond::Kind::rivet; });
        step.title = numbered(by_brad ? fmt::format("fasten {} with a brad", listed(names, 3))
                                      : "glue on " + listed(names, 3));
        step.lies = words_.lies(first, order_.card);
        const bool several = together.size() > 1;
        for (const GluingStep& one : together) {
            if (!creased_.contains(one.piece)) {
                for (std::string& text : words_.folds(one.piece)) step.actions.push_back(std::move(text));
                add_pushes(one.piece, step);
            }
            for (std::string& text : words_.actions(one))
                step.actions.push_back(several ? fmt::format("{}: {}", words_.piece(one.piece), text)
                                               : std::move(text));
            add_notes(one, step);
            add_figure(one.piece, {}, step);
            if (several && !step.figures.empty()) name_figure(one.piece, step.figures.back());
        }
        if (shows()) add_scenes(together, step);
        for (const GluingStep& one : together) there_.at(static_cast<std::size_t>(one.piece)) = true;
        return step;
    }

    void add_notes(const GluingStep& one, Step& step) const {
        const std::vector<int>& borne = nth(borne_, one.piece);
        if (!borne.empty()) {
            std::vector<std::string> names;
            names.reserve(borne.size());
            for (const int piece : borne) names.push_back(words_.piece(piece));
            step.notes.push_back(
                fmt::format("It comes with what is glued on it: {}.", listed(names, kMostNames)));
        }
        if (std::string free = words_.left_free(one.piece, later_bonds()); !free.empty())
            step.notes.push_back(std::move(free));
        for (const auto& [bond, flat] : one.onto) {
            const Segment& seam = nth(in_.glue, bond.number).on_base;
            step.notes.push_back(fmt::format(
                "Piece {} lies over target {}: glue the tab onto it, its fold {}.", words_.piece(flat),
                words_.label(bond), words_.measured(bond.mate, {seam.a, seam.b})));
        }
        if (const auto missing = missing_.find(one.piece); missing != missing_.end()) {
            const bool single = missing->second.size() == 1;
            step.notes.push_back(fmt::format(
                "No sheet has {} {}, for which there was no room: glue {} of paper, folded along {} "
                "middle, into {} instead.",
                single ? "a tab" : "the tabs", listed(missing->second), single ? "a strip" : "strips",
                single ? "its" : "their", single ? "that edge" : "those edges"));
        }
        if (one.under.empty()) return;
        std::vector<std::string> labels;
        for (const Bond& bond : one.under) labels.push_back(words_.label(bond));
        const bool is_area = one.under.front().kind == Bond::Kind::area;
        step.notes.push_back(
            is_area
                ? fmt::format("Other pieces cover a part of area {} already: glue over them.", listed(labels))
                : fmt::format("Something stands above target {} already: slip the {} in below it. Closing "
                              "the card presses it.",
                              listed(labels), one.under.size() == 1 ? "tab" : "tabs"));
    }

    void add_scenes(std::span<const GluingStep> together, Step& step) const {
        const GluingStep& first = together.front();
        const bool on_card = first.ground == order_.card;
        double share = 0.84;
        if (!on_card) share = 0.75;
        if (on_card && first.lie == Lie::half_open) share = 0.62;
        if (on_card && first.lie == Lie::turned) share = 0.97;
        Scene before = scene(share, "Before: the piece above its place");
        Scene after = scene(share, "After: the piece in its place");
        for (Scene* const one : {&before, &after}) {
            one->back_up = first.lie == Lie::turned;
            if (!on_card) one->on_table = first.ground;
            if (!on_card) one->lying = plate_under(first);
            one->unfolded = !on_card && lies_unfolded(first.ground, together);
            for (const int piece : with_borne(first.ground)) {
                if (is_on(piece, first.ground)) show(*one, piece, kWashed);
            }
            for (const GluingStep& glued : together) {
                for (const int piece : with_borne(glued.piece)) show(*one, piece, 0.0F);
            }
        }
        for (const GluingStep& glued : together) {
            const std::vector<Bond> bonds = bonds_of(glued);
            before.bonds.insert(before.bonds.end(), bonds.begin(), bonds.end());
            for (const int piece : with_borne(glued.piece)) {
                const std::vector<int>& plates = nth(in_.pieces, piece).plates;
                before.lifted.insert(before.lifted.end(), plates.begin(), plates.end());
            }
        }
        step.scenes = {std::move(before), std::move(after)};
        step.captions = {"before", "after"};
    }

    // What something flat comes onto is seen best where it lies itself.
    [[nodiscard]] std::optional<int> plate_under(const GluingStep& step) const {
        for (const Bond& bond : bonds_of(step)) {
            if (bond.kind != Bond::Kind::tab && nth(in_.plates, bond.mate).piece == step.ground)
                return bond.mate;
        }
        return std::nullopt;
    }

    // Whether all that is glued on a piece, up to these steps, lies flat on it: then it is shown as it is
    // cut.
    [[nodiscard]] bool lies_unfolded(int ground, std::span<const GluingStep> together) const {
        return std::all_of(order_.steps.begin(), order_.steps.end(), [&](const GluingStep& step) {
            const bool comes = std::any_of(together.begin(), together.end(), [&step](const GluingStep& one) {
                return one.piece == step.piece;
            });
            if (step.ground != ground || (!comes && !there_.at(static_cast<std::size_t>(step.piece))))
                return true;
            const std::vector<Bond> bonds = bonds_of(step);
            return std::all_of(bonds.begin(), bonds.end(),
                               [](const Bond& bond) { return bond.kind != Bond::Kind::tab; });
        });
    }

    // Whether all that bears the piece, up to the ground, is there.
    [[nodiscard]] bool is_on(int piece, int ground) const {
        while (piece >= 0 && piece != ground) {
            if (!there_.at(static_cast<std::size_t>(piece))) return false;
            piece = nth(order_.bearers, piece);
        }
        return piece == ground;
    }

    const SceneCard& card_;
    const Assembly& in_;
    std::size_t number_;
    Words words_;
    GluingOrder order_;
    std::vector<std::vector<int>> borne_;  // of each piece those that are glued on it
    std::map<int, std::vector<PushedOut>> pushed_;
    std::map<int, std::vector<std::string>> missing_;  // of each piece the tabs that no sheet has
    std::vector<bool> there_;                          // pieces that are glued on already
    std::set<int> creased_;
    int steps_ = 0;
    std::vector<Chapter> chapters_;
};

}  // namespace

std::vector<Chapter> chapters_of(const SceneCard& card, std::size_t number, bool backs_are_marked) {
    return CardSteps(card, number, backs_are_marked).run();
}

}  // namespace popup::book
