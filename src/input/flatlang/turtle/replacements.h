// Stretches between two marks of a turtle's tree, and others in their place.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "input/flatlang/turtle/turtle_tree.h"

namespace popup::flatlang {

// From mark to mark; both stay when it is replaced. `end` grows from `start`.
struct Stretch {
    int start = TurtleTree::none, end = TurtleTree::none;
};

// The nearest `end` at or above the cursor, and the nearest `start` above that.
std::optional<Stretch> nearest_stretch(const TurtleTree& tree, int cursor, int start_name, int end_name);

// Every stretch from a `start` to the next `end` on a path without branches, in the order of drawing; they do
// not overlap. Cost: linear in the tree.
std::vector<Stretch> all_stretches(const TurtleTree& tree, int root, int start_name, int end_name);

// A chain of operations, as a tree of its own.
struct Chain {
    int root = TurtleTree::none, last = TurtleTree::none;
};
// The chain takes the place of what stands between the marks; what branches off in between goes with it.
void put_between(TurtleTree& tree, const Stretch& stretch, const Chain& chain);
// Copies it; new nodes are appended to `copied`. With as_2008 changes of the pose are not copied.
Chain copy_chain(TurtleTree& tree, int root, bool as_2008, std::vector<int>& copied);

// What the original interpreter did for replaceAll. From the tree's root on: for every child that the root
// has, look for the first `start` (in the whole tree each time), for the `end` below it, put a copy of the
// chain between them, and begin again with that `end` as the root. False: given up after `most` steps or
// nodes; then the tree is changed in parts.
bool replace_all_of_2008(TurtleTree& tree, int root, int start_name, int end_name, const Chain& chain,
                         std::uint64_t most, std::vector<int>& copied);

}  // namespace popup::flatlang
