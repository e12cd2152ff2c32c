// The examination of what has changed, and what an examination leaves for that.
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "motion/pair_search.h"
#include "motion/recall.h"

namespace popup {

// Cells of a sweep beyond which nothing is kept: each is a bit of PairFindings::cells.
inline constexpr std::size_t kMostKeptCells = 64;

struct ExamineJob {
    const Assembly& assembly;
    Linkage& linkage;
    std::span<const PlateShape> shapes;
    const MotionOptions& options;
    std::span<const double> ends;  // of the cells
    // What ends an examination early: work of all pairs, and pairs of one cell.
    struct Most {
        std::size_t work = 0, pairs = 0;
    } most;
};

// Looks at the pairs of plates that have changed, and takes the findings of all others from what is kept:
// contacts, undecided, approaches, pairs and poses of the result, which are those of an examination of
// everything. False, with nothing kept or written, if that would have ended early, or a linkage does not get
// to an opening. Precondition: recall.helps(). Cost: that of the pairs looked at, and linear in plates and in
// kept pairs.
bool examine_again(const ExamineJob& job, PairSearch& search, Recall& recall, Examination& result);

// Writes down what an examination of everything finds.
class Recorder {
 public:
    explicit Recorder(Recall* recall);  // null: it does nothing
    // Round all that is looked for of one pair in the cell.
    void begin(const PairSearch& search);
    void end(int a, int b, const PairSearch& search);
    void next_cell(std::vector<SpaceBox>&& boxes);
    void take(const Examination& result);

 private:
    Recall* recall_;
    std::size_t cell_ = 0;
    std::size_t work_ = 0, looks_ = 0;  // before the pair
};

}  // namespace popup
