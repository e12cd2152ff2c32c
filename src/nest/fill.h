// Filling sheets: what lies on the emptiest of them goes to the others, piece by piece.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "nest/task.h"

namespace popup {

// The lots of a sheet: its pieces, those of a group together.
std::vector<std::vector<int>> lots_on(const NestTask& task, const Arrangement& layout, int sheet);

// One of several that fill the sheets of a layout side by side. Each has sheets of its own to fill, and
// pieces of its own to move, so that what they find goes together whatever the others do.
//
// An attempt throws a lot of the victim (a piece, or the pieces of a group) onto one other sheet, where it
// overlaps least of some random places, and takes the pieces of that sheet apart. That is a small search
// beside one of all sheets. A sheet that refuses lots is tried less often, and for longer. Where a sheet
// refuses again and again, a piece of it may change places with a larger one of the victim.
class Filler {
 public:
    // Precondition: the task outlives the filler.
    Filler(NestTask& task, std::uint64_t seed);

    // Fills every `parts`th of the sheets that are not the victim, from number `part` on, with every
    // `parts`th of the victim's lots. Preconditions: the layout holds but for what lies on the victim, of
    // which nothing is locked, and each of whose groups lies wholly on it.
    void begin(const Arrangement& from, int victim, int part, int parts);
    // Looks for so much work more. Ends early when `done()`.
    void run(double work);
    // Nothing is left to move, or the sheets have refused very often since they took the last.
    [[nodiscard]] bool done() const { return done_; }
    // Whether anything has moved since it began.
    [[nodiscard]] bool moved() const { return moved_; }
    // Writes into the layout where the items of its own sheets and of its own lots are now. What came to the
    // victim in exchange has no place on it yet, and is where it was on its own sheet.
    void put_into(Arrangement& layout) const;
    [[nodiscard]] double work() const { return board_.work; }

 private:
    // A sheet to fill.
    struct Receiver {
        int sheet = 0;
        double free = 0.0;  // mm² that no piece covers
        int refusals = 0;   // since it took the last
        std::vector<int> items = {};
    };

    [[nodiscard]] double area_of(int item) const { return nth(task_.set.areas, nth(task_.kinds, item)); }
    [[nodiscard]] double area_of(const std::vector<int>& items) const;
    void choose_receivers(int part, int parts);
    [[nodiscard]] int any_receiver();
    [[nodiscard]] bool fits_on_victim(int item) const;
    [[nodiscard]] std::optional<int> for_exchange(const Receiver& receiver, const std::vector<int>& lot);
    bool throw_on(int item);
    bool attempt();
    void set_off();
    void finish(Separator::State state);
    void succeed();
    [[nodiscard]] bool holds() const;

    NestTask& task_;
    Board board_;  // with the sheet of the attempt alone
    Dice dice_;
    int victim_ = 0;
    Arrangement layout_;
    Freedom freedom_;
    std::vector<Receiver> receivers_;
    std::vector<std::vector<int>> lots_;  // that are left to move
    bool moved_ = false;                  // anything since it began
    int refusals_ = 0;                    // of all receivers, since one took a lot
    bool done_ = false;
    // The attempt.
    std::unique_ptr<Separator> separator_;
    bool loose_ = false;        // it has come to the table with room for rounding
    int receiver_ = 0;          // its number in receivers_
    int lot_ = 0;               // its number in lots_
    std::optional<int> given_;  // the item that goes to the victim in exchange
};

}  // namespace popup
