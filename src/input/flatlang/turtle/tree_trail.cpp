#include "input/flatlang/turtle/tree_trail.h"

#include <algorithm>

#include "input/flatlang/turtle/polygons.h"

namespace popup::flatlang {

const Pose* KnownPoses::find(int node) const {
    const auto i = static_cast<std::size_t>(node);
    return i < index_.size() && index_[i] >= 0 ? &poses_[static_cast<std::size_t>(index_[i])] : nullptr;
}

void KnownPoses::set(int node, const Pose& pose) {
    const auto i = static_cast<std::size_t>(node);
    if (i >= index_.size()) index_.resize(std::max(i + 1, index_.size() * 2), -1);
    if (index_[i] < 0 && !free_.empty()) {
        index_[i] = free_.back();
        free_.pop_back();
    } else if (index_[i] < 0) {
        index_[i] = static_cast<int>(poses_.size());
        poses_.emplace_back();
    }
    poses_[static_cast<std::size_t>(index_[i])] = pose;
}

void KnownPoses::forget(int node) {
    const auto i = static_cast<std::size_t>(node);
    if (i >= index_.size() || index_[i] < 0) return;
    free_.push_back(index_[i]);
    index_[i] = -1;
}

void KnownPoses::clear() {
    index_.clear();
    poses_.clear();
    free_.clear();
}

namespace {

// Segments, parts and the cursor's pose. The part of each node goes to `parts` unless there is only one.
void draw(const TurtleTree& tree, int root, int cursor, bool as_2008, Trail& trail, std::vector<int>& parts) {
    // A line that rounding alone has made is none.
    constexpr double no_line = 1e-9;
    const bool one_part = tree.parts().empty();
    if (!one_part) parts.assign(tree.size(), 0);
    bool down = true;
    int part = 0;
    tree.walk(root, false, Pose{}, [&](int node, Pose& pose) {
        const Operation& operation = tree.operation(node);
        const Vec3 from = pose.at;
        perform(pose, operation, tree.changes());
        if (!as_2008) keep_square(pose);
        switch (operation.kind) {
            case OperationKind::pen:
                down = operation.detail != 0;
                break;
            case OperationKind::part:
                trail.parts.push_back(tree.parts()[static_cast<std::size_t>(operation.detail)]);
                part = static_cast<int>(trail.parts.size()) - 1;
                break;
            case OperationKind::forward:
                if (down && from != pose.at) trail.segments.push_back({from, pose.at, part});
                break;
            case OperationKind::change:
                if (down && distance(from, pose.at) > no_line) {
                    trail.segments.push_back({from, pose.at, part});
                }
                break;
            case OperationKind::nothing:
            case OperationKind::left:
            case OperationKind::roll:
            case OperationKind::pitch:
            case OperationKind::mark:
                break;
        }
        if (!one_part) parts[static_cast<std::size_t>(node)] = part;
        if (node == cursor) trail.last = pose;
    });
}

void find_polygons(const TurtleTree& tree, int root, bool as_2008, const KnownPoses& known,
                   const std::vector<int>& parts, Trail& trail) {
    struct Standing {
        Pose pose;
        bool down = true;
    };
    PolygonFinder finder;
    tree.walk(root, true, Standing{}, [&](int node, Standing& standing) {
        const Operation& operation = tree.operation(node);
        const Pose* stays = as_2008 ? known.find(node) : nullptr;
        if (stays != nullptr) {
            standing = {*stays, true};
        } else {
            perform(standing.pose, operation, tree.changes());
            if (!as_2008) keep_square(standing.pose);
            if (operation.kind == OperationKind::pen) standing.down = operation.detail != 0;
        }
        if (!standing.down) {
            finder.lift();
        } else if (finder.add(standing.pose.at)) {
            trail.polygons.push_back(
                {finder.polygon(), parts.empty() ? 0 : parts[static_cast<std::size_t>(node)]});
        }
    });
}

}  // namespace

Trail tree_trail(const TurtleTree& tree, int root, int cursor, bool as_2008, const KnownPoses& known,
                 bool polygons) {
    Trail trail;
    trail.parts.emplace_back();
    std::vector<int> parts;
    draw(tree, root, cursor, as_2008, trail, parts);
    if (polygons) find_polygons(tree, root, as_2008, known, parts, trail);
    return trail;
}

}  // namespace popup::flatlang
