// Plates of one architecture that cannot meet, however far it is open.
//
// What stays parallel to the back B is B moved along the floor F, and what stays parallel to F is F moved
// along B (motion/joints/parallel.cpp). So the planes of two that are parallel to the same one never cross.
// The planes of one of each cross in a line that keeps its place on both, as the fold of B and F does on
// them. On that line, then, it is decided once for all openings whether the two have a point in common.
#pragma once

#include <map>
#include <span>
#include <utility>
#include <vector>

#include "motion/plate_shape.h"
#include "popup/assembly.h"

namespace popup {

class Parallels {
 public:
    // Both must outlive it; shapes by plate.
    Parallels(const Assembly& assembly, std::span<const PlateShape> shapes);

    // True: they do not cross (Contact of popup/motion.h) at any opening that the joints reach. False:
    // nothing is known of them. Cost: edges of both, once a pair.
    bool keep_apart(int a, int b);

 private:
    struct Member {
        int family = -1;  // which back and floor; -1: none
        bool of_back = false;
    };
    void found_families();
    [[nodiscard]] bool share_a_line(int a, int b) const;
    [[nodiscard]] bool look(int a, int b) const;

    const Assembly& assembly_;
    std::span<const PlateShape> shapes_;
    std::vector<Member> members_;  // by plate
    std::vector<Frame> frames_;    // at an opening where nothing is flat; empty: there are no families
    std::map<std::pair<int, int>, bool> known_;
};

}  // namespace popup
