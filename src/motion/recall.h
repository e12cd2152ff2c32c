// What one examination leaves for the next one of the same design, which has changed a little.
//
// What moves as it did has passed the whole way then, and its hinges open as far as they did.
// A pair of plates whose chains (motion/chains.h) and outlines are as they were has the findings that it had.
// A plate that moves as before, but has another outline, is redrawn: as a base page is from which something
// is cut. Whoever was clear of it and does not come near the part that was redrawn is clear of it still,
// because what crosses does so at paper that both have there.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "motion/cells.h"
#include "motion/chains.h"
#include "motion/linkage.h"
#include "motion/plate_shape.h"
#include "popup/motion.h"

namespace popup {

// Of one pair of plates, over the whole sweep.
struct PairFindings {
    std::uint64_t cells = 0;          // bits of those in which they were near enough to be looked at
    std::size_t work = 0, looks = 0;  // PairSearch::work(), poses()
    std::vector<Contact> contacts;    // numbers of plates as they were
    std::vector<Undecided> undecided;
    std::vector<Approach> approaches;

    [[nodiscard]] bool is_clear() const {
        return contacts.empty() && undecided.empty() && approaches.empty();
    }
};

// Of the closed card.
struct LayersKept {
    // How b lies over a: the least and the most height, as far as they say whether above or below.
    struct Heights {
        double least = 0.0, most = 0.0;
    };
    bool known = false;
    std::vector<double> plane;                            // the numbers of the plane that all lies in
    std::vector<Box> boxes;                               // of the plates, seen from the side
    std::unordered_map<std::uint64_t, Heights> overlaps;  // by chains
    int most = 0;
    Vec2 thickest;
    std::size_t work = 0;
};

// Of hinges, by the chains of their plates and their lines: how far each opens at most, mm, at the angles
// asked for that lie on the way from closed to open.
using HingeKey = std::array<double, 10>;
using HingeGaps = std::map<HingeKey, double>;

struct ExaminationMemory::Kept {
    Chains chains;
    bool known = false;  // what follows is of a whole examination
    std::optional<double> clearance_mm;
    std::vector<Angle> angles;
    Sweep sweep;
    std::vector<int> plate_chains;  // by plate, as all that follows
    std::vector<Polygon> reaches;   // reach_of()
    std::vector<PlateShape> shapes;
    std::vector<std::vector<SpaceBox>> boxes;               // of each cell
    std::unordered_map<std::uint64_t, PairFindings> pairs;  // by chains; those that were near
    LayersKept layers;
    HingeGaps gaps;
};

// Plates in the order in which they are numbered.
inline std::uint64_t pair_key(int chain_a, int chain_b) {
    return static_cast<std::uint64_t>(static_cast<std::uint32_t>(chain_a)) << 32U |
           static_cast<std::uint32_t>(chain_b);
}

// One examination with a memory.
//
//     Recall recall(memory, assembly, linkage, options);
//     std::vector<PlateShape> shapes = recall.take_shapes();
//     examine(assembly, linkage, shapes, options, &recall);
//     recall.keep(std::move(shapes));   // else the memory is empty
class Recall {
 public:
    // All must outlive it.
    Recall(ExaminationMemory& memory, const Assembly& assembly, const Linkage& linkage,
           const MotionOptions& options);

    // Whether the design is one of which anything can be kept: no fold moves by a law, no plate is held
    // parallel to others.
    [[nodiscard]] bool can_keep() const { return can_keep_; }
    // Whether so much is as it was that only the rest need be looked at.
    [[nodiscard]] bool helps() const { return helps_; }
    // Of all plates; those of plates that have not changed are as they were kept.
    std::vector<PlateShape> take_shapes();
    // Ends it. The memory knows this assembly from now on.
    void keep(std::vector<PlateShape> shapes);

    enum class State { same, redrawn, changed };
    struct PlateNow {
        int chain = -1;
        int before = -1;  // its number in what is kept; -1: it moves otherwise than anything there
        State state = State::changed;
        Box redrawn;  // where its outline has changed
    };
    [[nodiscard]] std::span<const PlateNow> plates() const { return plates_; }
    // Those that are redrawn or changed.
    [[nodiscard]] std::span<const int> touched() const { return touched_; }
    // The number of the plate of that chain; -1: there is none any more.
    [[nodiscard]] int plate_of(int chain) const {
        const auto found = by_chain_.find(chain);
        return found == by_chain_.end() ? -1 : found->second;
    }
    [[nodiscard]] std::uint64_t key(int a, int b) const {
        return pair_key(plates_[static_cast<std::size_t>(a)].chain,
                        plates_[static_cast<std::size_t>(b)].chain);
    }

    // Of pairs: those that are looked at, and all.
    struct Counts {
        std::size_t examined = 0, all = 0;
    };
    // What is kept, to be read and then to be written anew.
    [[nodiscard]] ExaminationMemory::Kept& kept() const { return kept_; }
    ExaminationMemory::Share& share() const { return memory_.share_; }
    // What was found is not whole, and not kept.
    void drop() { whole_ = false; }
    void keep_gaps(HingeGaps gaps) { gaps_ = std::move(gaps); }
    [[nodiscard]] bool keeps() const { return can_keep_ && whole_; }

 private:
    [[nodiscard]] bool knows_nothing(const MotionOptions& options) const;

    ExaminationMemory& memory_;
    ExaminationMemory::Kept& kept_;
    const Assembly& assembly_;
    const MotionOptions& options_;
    bool can_keep_ = true;
    bool helps_ = false;
    bool whole_ = true;
    std::vector<PlateNow> plates_;
    std::vector<int> touched_;
    std::unordered_map<int, int> by_chain_;
    std::vector<Polygon> reaches_;
    HingeGaps gaps_;
};

}  // namespace popup
