// One searcher: it shrinks the room that the pieces have, lets them overlap, and takes them apart again.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "nest/task.h"

namespace popup {

// What a lane is after.
enum class Aim {
    fit,       // place what overlaps, on the sheets there are
    fewer,     // one sheet less
    shorter,   // a shorter last sheet, by large steps, then by small ones from many layouts
    compress,  // a shorter last sheet, by small steps from the best
};

// With little work to spend, larger steps and less patience come further.
struct Pace {
    double first_step = 0.01;  // by which the last sheet is shortened at first, as a share of its length
    double patience = 1.0;     // as a share of what the search for a shorter sheet has
    double content = 0.0;      // of the least there can be, by how much more the last sheet may take
};
inline constexpr Pace kHasty{0.03, 0.5, 0.015};

// Works in slices of work, so that lanes can be compared, and run side by side, without a clock.
class Lane {
 public:
    // Precondition: the task outlives the lane.
    Lane(NestTask& task, std::uint64_t seed, Pace pace);

    // Goes on from this layout, which holds (except under `fit`). As long as aim and sheets stay, what the
    // lane is about is gone on with if it may still come to something better.
    void begin(const Arrangement& from, Aim aim);
    // What known_last() says of layouts on sheets of these rows.
    void know(std::vector<int> rows, std::vector<char> on_last);
    // Drops what the lane is about: what it goes on from next is all it knows.
    void forget();
    // Looks for so much work more. Ends early when `done()`.
    void run(double work);
    // The best layout so far: `from`, or better. Under `fit` only once done().
    [[nodiscard]] const Arrangement& best() const { return best_; }
    // fit and fewer: it was found. shorter and compress: it cannot get shorter, or not by what would count.
    [[nodiscard]] bool done() const { return done_; }
    [[nodiscard]] double work() const { return board_.work; }
    [[nodiscard]] Dice& dice() { return dice_; }

 private:
    struct Failure {
        double loss;
        std::vector<Stand> stands;
    };

    [[nodiscard]] bool useful() const;
    [[nodiscard]] double least() const;
    [[nodiscard]] double length_of(const Arrangement& arrangement) const;
    [[nodiscard]] bool shortens() const { return aim_ == Aim::shorter || aim_ == Aim::compress; }
    [[nodiscard]] int last() const { return static_cast<int>(board_.rooms().size()) - 1; }
    void attempt();
    void attempt_to_fit();
    void attempt_to_shorten();
    void attempt_again();
    void set_off(Persistence persistence);
    void set_out(const std::vector<Stand>& stands);
    bool set_out_shorter();
    void finish(Separator::State state);
    void succeed();
    void fail();
    bool dissolve();
    bool shorten(double length);
    void throw_in(const std::vector<int>& items, int sheet);
    void disturb();
    void exchange(int a, int b);
    bool move_lot(int item, int sheet);

    NestTask& task_;
    Pace pace_;
    Board board_;
    Dice dice_;
    Aim aim_ = Aim::shorter;
    Arrangement best_;
    bool exploring_ = false;  // under `shorter`: large steps have come to their end
    std::vector<int> rows_;   // of the attempt
    Freedom freedom_;
    std::unique_ptr<Separator> separator_;
    bool loose_ = false;         // the attempt has come to the table with room for rounding
    std::vector<Failure> pool_;  // what was tried in vain, the least overlap first
    double target_ = 0.0;        // length of the last sheet, steps
    double step_ = 0.0;
    double least_ = 0.0;           // no last sheet is shorter
    std::vector<int> known_rows_;  // what on_last_ is about
    std::vector<char> on_last_;
    bool done_ = false;
    std::vector<int> by_size_;
};

}  // namespace popup
