// Plates told apart by how they move, from one state of a design to the next.
//
// The chain of a plate is all that its motion follows from: the values of its joint, the chains of the plates
// that this stands on, and that of its twin. Plates of two assemblies that have one chain are in the same
// place at every opening, and their ways to others are the same, to the last bit.
//
//     Chains chains;
//     const std::vector<int> before = chains.of(assembly, linkage);
//     const std::vector<int> after = chains.of(changed, linkage_of_changed);
//     // after[i] == before[k]: plate i moves as plate k did
#pragma once

#include <string>
#include <unordered_map>
#include <vector>

#include "motion/linkage.h"
#include "popup/assembly.h"

namespace popup {

class Chains {
 public:
    // A number for the chain of each plate, no two of them equal. Values are compared as they are, byte for
    // byte; of joints that are equal the first has the number that the first of them had in the assembly
    // before, and so on. Remembers the chains of the last assembly only. Cost: linear in joints.
    std::vector<int> of(const Assembly& assembly, const Linkage& linkage);

 private:
    int number_of(std::string&& values);

    std::unordered_map<std::string, int> known_, next_;
    int numbers_ = 0;
};

}  // namespace popup
