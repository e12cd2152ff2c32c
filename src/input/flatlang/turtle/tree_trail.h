// What a turtle's tree draws.
#pragma once

#include <vector>

#include "input/flatlang/turtle/trail.h"
#include "input/flatlang/turtle/turtle_tree.h"

namespace popup::flatlang {

// Where operations of a tree leave the turtle, for those that were calculated.
class KnownPoses {
 public:
    // Null: not known.
    [[nodiscard]] const Pose* find(int node) const;
    void set(int node, const Pose& pose);
    void forget(int node);
    void clear();
    [[nodiscard]] bool empty() const { return poses_.size() == free_.size(); }

 private:
    std::vector<int> index_;  // by node; -1: not known
    std::vector<Pose> poses_;
    std::vector<int> free_;
};

// Everything that grows from `root`, and where `cursor` stands. Pen and part are those of the order of
// drawing. To the finder of polygons the tree is walked with the youngest children first, and there a branch
// begins with the pen of the operation it grows from.
//
// With as_2008 operations whose poses are `known` count as drawn with the pen down for that, and stay where
// they were; new ones follow from them. Without `polygons` none are looked for.
Trail tree_trail(const TurtleTree& tree, int root, int cursor, bool as_2008, const KnownPoses& known,
                 bool polygons);

}  // namespace popup::flatlang
