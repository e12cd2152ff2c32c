#include "input/flatlang/turtle/turtle_tree.h"

namespace popup::flatlang {

void perform(Pose& pose, const Operation& operation, const std::vector<Pose>& changes) {
    switch (operation.kind) {
        case OperationKind::forward:
            move(pose, operation.amount);
            return;
        case OperationKind::left:
            turn(pose, Axis::up, operation.amount);
            return;
        case OperationKind::roll:
            turn(pose, Axis::heading, operation.amount);
            return;
        case OperationKind::pitch:
            turn(pose, Axis::right, operation.amount);
            return;
        case OperationKind::change:
            apply(pose, changes[static_cast<std::size_t>(operation.detail)]);
            return;
        case OperationKind::nothing:
        case OperationKind::pen:
        case OperationKind::mark:
        case OperationKind::part:
            return;
    }
}

int TurtleTree::name(std::string_view name) {
    const auto [entry, added] = names_.try_emplace(std::string(name), static_cast<int>(names_.size()));
    if (added) name_list_.push_back(&entry->first);
    return entry->second;
}

int TurtleTree::find_name(std::string_view name) const {
    const auto found = names_.find(std::string(name));
    return found == names_.end() ? none : found->second;
}

int TurtleTree::plant(const Operation& operation) {
    nodes_.emplace_back();
    nodes_.back().operation = operation;
    return static_cast<int>(nodes_.size()) - 1;
}

int TurtleTree::append(int parent, const Operation& operation) {
    const int node = plant(operation);
    attach(node, parent);
    return node;
}

bool TurtleTree::is_linked(int node) const {
    return operation(node).kind == OperationKind::mark || operation(node).kind == OperationKind::nothing;
}

int TurtleTree::only_child(int node) const {
    const int child = first_child(node);
    return child != none && next_sibling(child) == none ? child : none;
}

int TurtleTree::mark_at_or_above(int node, int name) const {
    return is_mark(node, name) ? node : mark_above(node, name);
}

int TurtleTree::mark_above(int node, int name) const {
    int link = at(node).above;
    while (link != none && !is_mark(link, name)) {
        ++looks_;
        link = at(link).above;
    }
    return link;
}

int TurtleTree::older_sibling(int child) const {
    int older = none;
    for (int each = first_child(parent(child)); each != child; each = next_sibling(each)) older = each;
    return older;
}

void TurtleTree::replace(int child, int root) {
    const int parent = at(child).parent;
    const int older = older_sibling(child);
    (older == none ? at(parent).first_child : at(older).next_sibling) = root;
    at(root).next_sibling = at(child).next_sibling;
    if (at(parent).last_child == child) at(parent).last_child = root;
    at(child).next_sibling = none;
    at(root).parent = parent;
    at(root).above = link_from(parent);
}

void TurtleTree::loosen(int child) {
    const int parent = at(child).parent;
    const int older = older_sibling(child);
    (older == none ? at(parent).first_child : at(older).next_sibling) = at(child).next_sibling;
    if (at(parent).last_child == child) at(parent).last_child = older;
    at(child).next_sibling = none;
}

void TurtleTree::attach(int node, int parent) {
    at(node).parent = parent;
    at(node).above = link_from(parent);
    const int older = at(parent).last_child;
    (older == none ? at(parent).first_child : at(older).next_sibling) = node;
    at(parent).last_child = node;
}

void TurtleTree::drop(int node) {
    walk(node, false, 0, [this](int each, int /*state*/) { at(each).gone = true; });
}

}  // namespace popup::flatlang
