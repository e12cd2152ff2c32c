// Two plates over a range of opening angles: where they are certainly clear, where they cross.
//
// A range is judged from its middle; what cannot be told is halved.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "motion/crossing.h"
#include "motion/linkage.h"
#include "motion/nearness.h"
#include "motion/poses.h"
#include "popup/motion.h"

namespace popup {

// A stretch of angles in which two plates are not certainly clear.
struct ContactRange {
    enum Kind {
        touching,  // they come so near that the smallest range does not tell them apart; they do not cross in
                   // it
        crossing,  // they cross
        undecided,  // the work allowed was used up
    };
    double from = 0.0, to = 0.0;
    Kind kind = touching;
    bool firm = false;  // a firm crossing was seen in it
    friend bool operator==(const ContactRange&, const ContactRange&) = default;
};
// Whether find_contacts() makes a contact of it for certain.
inline bool is_certain(const ContactRange& one) { return one.firm && one.kind == ContactRange::crossing; }

// All plates in the middle and at the ends of a range of angles.
struct Cell {
    double from = 0.0, to = 0.0;
    std::vector<Frame> frames;                // in the middle, by plate
    std::vector<double> first, middle, last;  // bends, by turn
};

// Looks at pairs of one assembly. Holds memory that calls share: one caller at a time.
class PairSearch {
 public:
    // All must outlive the search; shapes by plate.
    PairSearch(const Assembly& assembly, Linkage& linkage, std::span<const PlateShape> shapes);

    // Where plates a and b are not certainly clear within the cell: ascending, no two overlap.
    void contacts(const Cell& cell, int a, int b, std::vector<ContactRange>& found);
    // Where they are nearer than `distance_mm`, to 0.001°: stretches of kind crossing.
    void approaches(const Cell& cell, int a, int b, double distance_mm, std::vector<ContactRange>& found);

    // The crossing of two plates at one angle, and a's frame there.
    struct At {
        bool reached = false;  // else there is no crossing, and the frames say nothing
        std::optional<Crossing> crossing;
        Frame a, b_in_a;
    };
    At at(int a, int b, double deg);
    // The same without the crossing, which costs the most.
    At frames_at(int a, int b, double deg);
    // Their distance there, or `limit_mm` when it is not less, and the point of a in the world.
    struct Distance {
        double mm = 0.0;
        Vec3 point;
    };
    Distance distance(int a, int b, double deg, double limit_mm);

    [[nodiscard]] const Sweep& sweep() const { return assembly_.sweep; }
    [[nodiscard]] const PlateShape& shape(int plate) const {
        return shapes_[static_cast<std::size_t>(plate)];
    }
    // Poses looked at, and turns between the plates of each in all.
    [[nodiscard]] std::size_t poses() const { return poses_; }
    [[nodiscard]] std::size_t work() const { return work_; }

 private:
    struct Range {
        double from, to;
        std::size_t bends;   // where those of its two ends begin
        std::size_t number;  // of Poses
    };
    void begin(const Cell& cell, int a, int b);
    const TurnRate& rate_in_cell(int turn);
    void find_rates(const Range& range);
    void drift(const Range& range);
    void set_pose(const Range& range, std::span<const double> middle);
    bool next(Range& range, const Cell& cell);
    void split(const Range& range);
    bool place_pair(std::size_t number, double deg);
    bool place_only(int a, int b, double deg);
    [[nodiscard]] bool one_hinge_keeps_apart(const Range& range) const;
    [[nodiscard]] bool crosses_throughout(const Crossing& here, double turns) const;
    [[nodiscard]] bool only_touches(double inside_mm, double turns);

    const Assembly& assembly_;
    Linkage& linkage_;
    std::span<const PlateShape> shapes_;
    NearnessTest nearness_;
    CrossingTest crossing_;
    std::size_t poses_ = 0;
    std::size_t work_ = 0;

    int a_ = 0, b_ = 0;
    std::vector<int> way_;     // turns from a's end on
    std::vector<int> needed_;  // turns whose bends are kept: those of the way and their four-bars'
    std::vector<int> slot_;    // by turn: where in needed_
    std::vector<int> under_;   // plates that are placed
    std::vector<std::size_t> joints_;
    bool joints_known_ = false;
    bool reached_ = true;  // the linkages get to the pose
    Poses poses_at_;
    std::vector<double> middle_, pool_;
    std::vector<Range> ranges_;
    bool have_laws_ = false;  // all turns of the way
    std::vector<Arm> from_a_, from_b_;
    struct TurnNow {
        double sign;  // 1: the way goes from its other plate to its own
        TurnRate rate;
    };
    std::vector<TurnNow> rates_;  // by turn of the way, where all have laws
    // Rates of turns over the whole cell, which most pairs are only looked at in: by turn, of the cell of
    // this number.
    double cell_from_ = 0.0, cell_to_ = 0.0;
    int cell_number_ = 0;
    std::vector<TurnRate> cell_rates_;
    std::vector<int> cell_of_;
    std::span<const Frame> pose_frames_;
    PairPose pose_;
};

}  // namespace popup
