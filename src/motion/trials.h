// What a move that is tried must do, and what it must not: two elements come free, and nothing else gets
// worse.
#pragma once

#include <algorithm>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "motion/linkage.h"
#include "motion/mend.h"
#include "motion/pair_search.h"
#include "motion/plate_shape.h"
#include "popup/motion.h"

namespace popup {

// Whether some pairs of plates are in contact, for one trial after the other. A glance at some openings is a
// hundredth of the work of an examination, and rejects most trials; only what passes is examined, and where
// that finds a crossing, glances look there too from then on. All must outlive it.
class Trials {
 public:
    // `contacts`: of the card as it is; glances look first where the pairs cross deepest.
    Trials(const Assembly& assembly, const Linkage& linkage, std::span<const PlateShape> shapes,
           std::span<const std::pair<int, int>> pairs, std::span<const Contact> contacts, MoveBudget& budget);

    [[nodiscard]] bool any_left() const { return budget_.poses > 0; }
    // Whether a pair crosses at one of the openings, or lies on one another.
    bool crosses_at_a_glance(const Assembly& trial);
    // Whether a pair is in contact at any opening. `lesson`: whether glances have learnt to see it.
    bool in_contact(const Assembly& trial, bool& lesson);

 private:
    bool crosses_at(const Assembly& trial, double deg);
    bool examine(const Assembly& trial, Linkage& linkage, PairSearch& search,
                 std::optional<double>& crossing) const;
    void spend(std::size_t poses) { budget_.poses -= std::min(budget_.poses, poses); }

    std::span<const PlateShape> shapes_;
    std::span<const std::pair<int, int>> pairs_;
    MoveBudget& budget_;
    std::vector<std::size_t> joints_;  // under the plates of the pairs
    std::vector<double> openings_;     // for glances: first where the last trial crossed
    std::vector<Frame> frames_;
    CrossingTest crossing_;
};

// What speaks against a trial. `with`: what the moved element meets or lies on, of each of the two a plate;
// none where it is something else.
struct Objection {
    std::optional<std::pair<int, int>> with;  // the smaller number first
};

// What is round an element: a move must leave it on its paper, let nothing stick out of the closed card that
// does not, and let it meet nothing that it does not meet, nor lie on it. All must outlive it.
class Surroundings {
 public:
    // `contacts`: all of the card as it is.
    Surroundings(const Assembly& assembly, const Linkage& linkage, std::span<const PlateShape> shapes,
                 std::span<const Contact> contacts, MoveBudget& budget, const MoveTest& holds)
        : assembly_(assembly),
          linkage_(linkage),
          shapes_(shapes),
          contacts_(contacts),
          budget_(budget),
          holds_(holds) {}

    // Nothing, where the trial, in which a joint is moved by so much on the page of its grounds, is no worse.
    // `lies_nowhere`: the element may not lie even on what it lies on as it is. Cost: that of examining what
    // comes near the moved plates, and of asking `holds` where that finds nothing.
    std::optional<Objection> objection(const Assembly& trial, int joint, Vec2 by, bool lies_nowhere);
    // Whether a joint lies on anything as it is, besides what moves with another one.
    bool lies_elsewhere(int joint, int besides);

 private:
    [[nodiscard]] bool is_on_paper(int joint, Vec2 by) const;
    bool sticks_out(const Assembly& trial);
    std::optional<Objection> met(const Assembly& trial, int joint);
    std::optional<std::pair<int, int>> lain_on(const Assembly& trial, int joint, bool lies_nowhere);
    const std::vector<char>& plates_moved_by(int joint);

    const Assembly& assembly_;
    const Linkage& linkage_;
    std::span<const PlateShape> shapes_;
    std::span<const Contact> contacts_;
    MoveBudget& budget_;
    const MoveTest& holds_;
    std::optional<std::vector<int>> out_;                    // plates that stick out as it is
    std::map<int, std::vector<char>> moved_by_;              // by joint: whether each plate goes along
    std::map<int, std::vector<std::pair<int, int>>> lying_;  // by joint: pairs as it is, ascending
};

}  // namespace popup
