// What every assembly holds, and stages after it rely on: checked of those that others wrote.
//
//     for (const AssemblyFault& fault : faults_of(assembly)) ...    // none: it may be compiled
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "popup/assembly.h"

namespace popup {

// A part of an assembly that breaks a guarantee.
struct AssemblyFault {
    enum class Of { assembly, piece, plate, line, hinge, glue, glued_area, joint, layer };
    Of part = Of::assembly;
    std::size_t number = 0;  // in its list; nothing of the assembly itself
    std::string what;        // one sentence with its numbers; names the part
};

// Corners further out than this, in mm, are mistakes; points of joints, such as an apex, may lie a thousand
// times as far.
inline constexpr double kAssemblyReachMm = 1e6;

// Everything that docs/assembly.md promises under "What is guaranteed", in the order of the parts; at most
// 100. Whether hinges stay closed is not among it: the simulation finds that out. Precondition: indices are
// within their lists, or -1 where there may be none. Cost: near linear.
std::vector<AssemblyFault> faults_of(const Assembly& assembly);

}  // namespace popup
