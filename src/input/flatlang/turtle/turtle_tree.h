// The operations of turtles as trees: each continues where its parent ended.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "input/flatlang/turtle/poses.h"
#include "input/flatlang/turtle/trail.h"

namespace popup::flatlang {

enum class OperationKind : std::uint8_t {
    nothing,  // the beginning of a tree or of what was put into one
    forward,  // amount: inches
    left,     // amount: degrees
    roll,     // amount: degrees
    pitch,    // amount: degrees
    pen,      // detail: 1 down, 0 up
    mark,     // detail: the number of its name
    part,     // detail: index into parts()
    change,   // detail: index into changes(); of the pose, with a line
};

struct Operation {
    OperationKind kind = OperationKind::nothing;
    int detail = 0;
    double amount = 0;
};

// What `operation` does to where the turtle stands.
void perform(Pose& pose, const Operation& operation, const std::vector<Pose>& changes);

// A forest in one store; nodes are known by their number, which stays. Nothing recurses.
class TurtleTree {
 public:
    static constexpr int none = -1;

    // A mark's name as a number; the same for the same name.
    int name(std::string_view name);
    // `none` when no mark was ever called so.
    [[nodiscard]] int find_name(std::string_view name) const;
    [[nodiscard]] const std::string& name_of(int number) const {
        return *name_list_[static_cast<std::size_t>(number)];
    }

    // A tree of its own, that begins with this operation.
    int plant(const Operation& operation);
    // The youngest child of `parent`.
    int append(int parent, const Operation& operation);
    // `root`, the first of a tree, takes the place of `child` among its siblings. `child` is left loose; its
    // parent() stays known.
    void replace(int child, int root);
    // Takes `child` from its siblings; it is left loose likewise.
    void loosen(int child);
    // A loose node becomes the youngest child of `parent`.
    void attach(int node, int parent);
    // `node` and what grows from it are gone() from now on, but still to be read.
    void drop(int node);

    [[nodiscard]] std::size_t size() const { return nodes_.size(); }
    [[nodiscard]] const Operation& operation(int node) const { return at(node).operation; }
    [[nodiscard]] int parent(int node) const {
        ++looks_;
        return at(node).parent;
    }
    [[nodiscard]] int first_child(int node) const {
        ++looks_;
        return at(node).first_child;
    }
    [[nodiscard]] int next_sibling(int node) const {
        ++looks_;
        return at(node).next_sibling;
    }
    // The only child, or `none`.
    [[nodiscard]] int only_child(int node) const;
    [[nodiscard]] bool gone(int node) const { return at(node).gone; }
    [[nodiscard]] bool is_mark(int node, int name) const {
        return operation(node).kind == OperationKind::mark && operation(node).detail == name;
    }
    // The nearest mark of this name at `node` or above it, or `none`. Cost: the marks between.
    [[nodiscard]] int mark_at_or_above(int node, int name) const;
    [[nodiscard]] int mark_above(int node, int name) const;

    // How often nodes were looked at: what looking up, replacing and walking cost.
    [[nodiscard]] std::uint64_t looks() const { return looks_; }

    std::vector<TrailPart>& parts() { return parts_; }
    [[nodiscard]] const std::vector<TrailPart>& parts() const { return parts_; }
    std::vector<Pose>& changes() { return changes_; }
    [[nodiscard]] const std::vector<Pose>& changes() const { return changes_; }

    // Visits `root` and all that grows from it, parents first, children in their order or `youngest_first`.
    // visit(node, state): `state` comes as its parent left it. A State is copied where the tree branches.
    template <class State, class Visit>
    void walk(int root, bool youngest_first, State state, Visit visit) const;

 private:
    struct Node {
        Operation operation;
        int parent = none, first_child = none, last_child = none, next_sibling = none;
        int above = none;  // the nearest node above that is a mark, or the beginning of what was put in there
        bool gone = false;
    };
    [[nodiscard]] const Node& at(int node) const { return nodes_[static_cast<std::size_t>(node)]; }
    Node& at(int node) { return nodes_[static_cast<std::size_t>(node)]; }
    // Whether links to what is above lead here.
    [[nodiscard]] bool is_linked(int node) const;
    // `none`: it is the first.
    [[nodiscard]] int older_sibling(int child) const;
    [[nodiscard]] int link_from(int parent) const { return is_linked(parent) ? parent : at(parent).above; }

    std::vector<Node> nodes_;
    std::unordered_map<std::string, int> names_;
    std::vector<const std::string*> name_list_;  // by number
    std::vector<TrailPart> parts_;
    std::vector<Pose> changes_;
    mutable std::uint64_t looks_ = 0;
};

template <class State, class Visit>
void TurtleTree::walk(int root, bool youngest_first, State state, Visit visit) const {
    struct Waiting {
        int node;
        bool last;  // of its siblings: nobody needs the parent's state after it
    };
    std::vector<Waiting> waiting;
    std::vector<State> left_by_parents;
    int node = root;
    while (true) {
        visit(node, state);
        const int child = first_child(node);
        if (child != none && next_sibling(child) == none) {
            node = child;
            continue;
        }
        if (child != none) {
            left_by_parents.push_back(state);
            const std::size_t begin = waiting.size();
            for (int each = child; each != none; each = next_sibling(each)) waiting.push_back({each, false});
            if (!youngest_first) {
                for (std::size_t i = begin, j = waiting.size() - 1; i < j; ++i, --j) {
                    std::swap(waiting[i], waiting[j]);
                }
            }
            waiting[begin].last = true;
        }
        if (waiting.empty()) return;
        node = waiting.back().node;
        state = left_by_parents.back();
        if (waiting.back().last) left_by_parents.pop_back();
        waiting.pop_back();
    }
}

}  // namespace popup::flatlang
