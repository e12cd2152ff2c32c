// What a book says of pieces, folds and bonds.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "popup/gluing.h"
#include "popup/output.h"

namespace popup::book {

// "1 fold", "3 folds".
std::string counted(std::size_t count, std::string_view one, std::string_view more);
// "a", "a and b", "a, b and c"; at most `most` of them, then "and 7 more".
std::string listed(const std::vector<std::string>& items, std::size_t most = 12);

// Of each Assembly::glue whether the sheets have its tab: trimming may leave nothing of it. Where it is not
// known what they have, all are there. Cost: n log n in tabs and targets.
std::vector<bool> tabs_on_sheets(const SceneCard& card);

class Words {
 public:
    // `backs_are_marked`: sheets show on backs what is glued there.
    explicit Words(const SceneCard& card, bool backs_are_marked = true);

    // The number on the piece and before its name: "3" of tabs 3L and 3R; empty: it has none.
    [[nodiscard]] std::string number(int piece) const;
    // As it is printed on it: "3. roof".
    [[nodiscard]] std::string piece(int piece) const;
    // "the left part of page", of a piece of one plate its name alone.
    [[nodiscard]] std::string plate(int plate) const;
    // The number of a tab or of an area.
    [[nodiscard]] std::string label(const Bond& bond) const;

    // Its folds, a sentence for those alike, or how many there are where they are many; none that stay flat.
    [[nodiscard]] std::vector<std::string> folds(int piece) const;
    // "2 mountain, 1 valley".
    [[nodiscard]] std::string fold_count(int piece) const;
    // Where points of a plate's page are, to be measured on either side of it, such as "5 to 20 mm away from
    // the fold between left and right, and 12 to 35 mm below the upper end of it, as it is printed": from the
    // longest fold that it shares with another plate of its piece, else from its longest edge. Precondition:
    // there is a point.
    [[nodiscard]] std::string measured(int plate, const std::vector<Vec2>& points) const;
    // What is done for a step, and what is to be kept in mind.
    [[nodiscard]] std::vector<std::string> actions(const GluingStep& step) const;
    // Which of its tabs wait for pieces that are laid over them; `later`: bonds of later steps. Empty: none.
    [[nodiscard]] std::string left_free(int piece, const std::vector<Bond>& later) const;
    [[nodiscard]] std::string lies(const GluingStep& step, int card) const;

 private:
    struct FoldWay {
        int hinge = 0;
        bool mountain = false;
        double open_deg = 0.0, closed_deg = 0.0;  // how far it is folded then
    };
    [[nodiscard]] std::vector<FoldWay> fold_ways(int piece) const;
    [[nodiscard]] std::string labels(const std::vector<Bond>& bonds) const;
    [[nodiscard]] std::string places(const std::vector<Bond>& bonds) const;
    void press(const BondTurn& turn, std::vector<std::string>& said) const;
    void then(const GluingStep& step, const BondTurn& turn, std::vector<std::string>& said) const;

    const Assembly& in_;
    bool backs_are_marked_ = true;
    std::vector<std::string> numbers_;         // of each piece
    std::vector<Frame> open_, half_, closed_;  // none: nothing moves
};

}  // namespace popup::book
