#include "input/flatlang/turtle/replacements.h"

namespace popup::flatlang {

namespace {

constexpr int none = TurtleTree::none;

// The node after `node` in the order of drawing, below `root`.
int next_in_drawing(const TurtleTree& tree, int node, int root) {
    if (tree.first_child(node) != none) return tree.first_child(node);
    while (node != root && tree.next_sibling(node) == none) node = tree.parent(node);
    return node == root ? none : tree.next_sibling(node);
}

}  // namespace

std::optional<Stretch> nearest_stretch(const TurtleTree& tree, int cursor, int start_name, int end_name) {
    const int end = tree.mark_at_or_above(cursor, end_name);
    if (end == none) return std::nullopt;
    const int start = tree.mark_above(end, start_name);
    if (start == none) return std::nullopt;
    return Stretch{start, end};
}

std::vector<Stretch> all_stretches(const TurtleTree& tree, int root, int start_name, int end_name) {
    std::vector<Stretch> stretches;
    int node = root;
    while (node != none) {
        if (!tree.is_mark(node, start_name)) {
            node = next_in_drawing(tree, node, root);
            continue;
        }
        int end = node;
        int last = node;
        do {
            last = end;
            end = tree.only_child(end);
        } while (end != none && !tree.is_mark(end, end_name));
        if (end != none) {
            stretches.push_back({node, end});
            node = end;  // which may begin the next
            if (start_name != end_name) node = next_in_drawing(tree, node, root);
        } else {
            // No other start on the way there meets an end either.
            node = next_in_drawing(tree, last, root);
        }
    }
    return stretches;
}

void put_between(TurtleTree& tree, const Stretch& stretch, const Chain& chain) {
    int first = stretch.end;
    while (tree.parent(first) != stretch.start) first = tree.parent(first);
    tree.replace(first, chain.root);
    if (first != stretch.end) {
        tree.loosen(stretch.end);
        tree.drop(first);
    }
    tree.attach(stretch.end, chain.last);
}

Chain copy_chain(TurtleTree& tree, int root, bool as_2008, std::vector<int>& copied) {
    Chain copy;
    for (int node = root; node != none; node = tree.first_child(node)) {
        Operation operation = tree.operation(node);
        if (as_2008 && operation.kind == OperationKind::change) operation = {};
        copy.last = copy.root == none ? tree.plant(operation) : tree.append(copy.last, operation);
        if (copy.root == none) copy.root = copy.last;
        copied.push_back(copy.last);
    }
    return copy;
}

bool replace_all_of_2008(TurtleTree& tree, int root, int start_name, int end_name, const Chain& chain,
                         std::uint64_t most, std::vector<int>& copied) {
    struct Frame {
        int root, begun;  // how many of its children were begun with
    };
    // It never came back from marks of one name: it made a ring of them.
    if (start_name == end_name) return tree.first_child(root) == none;
    std::uint64_t steps = 0;
    std::vector<Frame> frames{{root, 0}};
    while (!frames.empty()) {
        const int top = frames.back().root;
        int child = tree.first_child(top);
        for (int i = 0; i < frames.back().begun && child != none; ++i) child = tree.next_sibling(child);
        if (child == none) {
            frames.pop_back();
            continue;
        }
        ++frames.back().begun;
        int start = top;
        while (start != none && !tree.is_mark(start, start_name)) {
            start = next_in_drawing(tree, start, top);
            if (++steps > most) return false;
        }
        if (start == none) continue;
        int end = start;
        do {
            end = tree.only_child(end);
            if (++steps > most) return false;
        } while (end != none && !tree.is_mark(end, end_name));
        if (end == none) continue;
        put_between(tree, {start, end}, copy_chain(tree, chain.root, true, copied));
        if (tree.size() > most) return false;
        frames.push_back({end, 0});
    }
    return true;
}

}  // namespace popup::flatlang
