#include "input/flatlang/turtle/turtle.h"

#include <algorithm>
#include <map>
#include <utility>

#include "input/flatlang/turtle/replacements.h"
#include "input/flatlang/turtle/tree_trail.h"
#include "input/flatlang/turtle/turtle_tree.h"

namespace popup::flatlang {

namespace {

constexpr int none = TurtleTree::none;

// A tree, and where it grows.
struct Recording {
    int root = none, cursor = none;
    std::vector<int> uncalculated;  // only as_2008: what was recorded since poses were calculated last
};

enum class BlockKind { shape, replacement };

// A shape or a replacement that has begun and not ended.
struct Block {
    BlockKind kind = BlockKind::shape;
    Recording recording;
    std::string name;        // of a shape
    std::string start, end;  // of a replacement
    bool all = false;        // of a replacement
};

struct Shape {
    int root = none;
};

// What the original called an operation. One that does nothing it could not tell.
std::string_view short_word(const Operation& operation) {
    switch (operation.kind) {
        case OperationKind::forward:
            return operation.amount != 0 ? "move" : "?";
        case OperationKind::left:
            return operation.amount != 0 ? "turn" : "?";
        case OperationKind::roll:
            return operation.amount != 0 ? "roll" : "?";
        case OperationKind::pitch:
            return operation.amount != 0 ? "pitch" : "?";
        case OperationKind::pen:
            return operation.detail != 0 ? "down" : "up";
        case OperationKind::nothing:
        case OperationKind::mark:
        case OperationKind::part:
        case OperationKind::change:
            break;
    }
    return "?";
}

// A line each, indented by depth; until `out` is too long to be printed anyway.
void describe_tree(const TurtleTree& tree, int root, int cursor, std::string_view beginning,
                   std::string& out) {
    constexpr std::size_t longest = std::size_t{64} << 20U;
    tree.walk(root, false, std::size_t{0}, [&](int node, std::size_t& depth) {
        if (out.size() > longest) return;
        if (node != root) out += '\n';
        out.append(4 * depth, ' ');
        if (node == cursor) out += "<<<";
        const Operation& operation = tree.operation(node);
        if (node == root || operation.kind == OperationKind::mark) {
            out.append("-- ").append(node == root ? beginning : tree.name_of(operation.detail)).append(" --");
        } else if (operation.kind == OperationKind::part) {
            out.append("Part ").append(tree.parts()[static_cast<std::size_t>(operation.detail)].name);
        } else {
            out += short_word(operation);
        }
        // It printed an address here.
        out += node == cursor ? ">>>(#)" : "(#)";
        ++depth;
    });
}

}  // namespace

struct Turtle::State {
    State(bool as_2008, std::uint64_t most) : as_2008(as_2008), most(most) {
        drawing = plant("__program_begin");
        last_recorded_shape = plant("__shape_turtles");
    }

    bool as_2008;
    std::uint64_t most;
    std::uint64_t number = 0;  // how many drawings were forgotten before this one
    std::uint64_t recorded = 0;
    TurtleTree tree;
    Recording drawing;
    // The innermost is last. The original had at most one of each kind.
    std::vector<Block> blocks;
    std::map<std::string, Shape, std::less<>> shapes;
    std::string last_shape;         // only as_2008: that was begun last
    Recording last_recorded_shape;  // that has ended
    KnownPoses known;
    std::vector<int> path;  // scratch

    Recording plant(std::string_view name_in_2008) {
        // The original began each tree with a mark, which can be gone back to.
        Operation beginning;
        if (as_2008) beginning = {OperationKind::mark, tree.name(name_in_2008), 0};
        const int root = tree.plant(beginning);
        Recording recording{root, root, {}};
        if (as_2008) recording.uncalculated.push_back(root);
        return recording;
    }

    // What operations are appended to.
    Recording& recorder() {
        if (as_2008) {
            if (Block* block = find(BlockKind::replacement)) return block->recording;
            return source();
        }
        return blocks.empty() ? drawing : blocks.back().recording;
    }
    // What is looked up, gone back in and replaced in.
    Recording& source() {
        Block* block = find(BlockKind::shape);
        return block != nullptr ? block->recording : drawing;
    }

    // The innermost of its kind, or null.
    Block* find(BlockKind kind) {
        const auto found = std::find_if(blocks.rbegin(), blocks.rend(),
                                        [kind](const Block& block) { return block.kind == kind; });
        return found == blocks.rend() ? nullptr : &*found;
    }
    // Takes it out. Null: there is none.
    std::optional<Block> take(BlockKind kind) {
        Block* block = find(kind);
        if (block == nullptr) return std::nullopt;
        Block taken = std::move(*block);
        blocks.erase(blocks.begin() + (block - blocks.data()));
        return taken;
    }

    void add(const Operation& operation) {
        Recording& recording = recorder();
        recording.cursor = tree.append(recording.cursor, operation);
        if (as_2008) recording.uncalculated.push_back(recording.cursor);
        ++recorded;
    }

    // Brings the poses of what the recording holds up to date, as the original did: each is calculated once.
    void calculate(Recording& recording) {
        for (const int node : recording.uncalculated) pose_of(node);
        recording.uncalculated.clear();
    }

    // By way of the nearest known pose above it.
    Pose pose_of(int node) {
        path.clear();
        int above = node;
        while (above != none && known.find(above) == nullptr) {
            path.push_back(above);
            above = tree.parent(above);
        }
        Pose pose = above != none ? *known.find(above) : Pose{};
        // Poses are large: on the way to one, some are kept, so that others near are not far.
        constexpr std::size_t kept_every = 32;
        for (std::size_t i = path.size(); i-- > 0;) {
            perform(pose, tree.operation(path[i]), tree.changes());
            if (!as_2008) keep_square(pose);
            if (as_2008 || i % kept_every == 0) known.set(path[i], pose);
        }
        return pose;
    }

    void forget_poses_below(int node) {
        if (as_2008 || known.empty()) return;
        tree.walk(node, false, 0, [this](int each, int /*state*/) { known.forget(each); });
    }

    void add_change(const Pose& to) {
        const Pose here = pose_of(source().cursor);
        tree.changes().push_back(as_2008 ? change_of_2008(here, to) : change(here, to));
        add({OperationKind::change, static_cast<int>(tree.changes().size()) - 1, 0});
    }
};

Turtle::Turtle(bool as_2008, std::uint64_t most_operations)
    : state_(std::make_unique<State>(as_2008, most_operations)) {}
Turtle::~Turtle() = default;

void Turtle::forward(double inches) { state_->add({OperationKind::forward, 0, inches}); }
void Turtle::left(double degrees) { state_->add({OperationKind::left, 0, degrees}); }
void Turtle::roll(double degrees) { state_->add({OperationKind::roll, 0, degrees}); }
void Turtle::pitch(double degrees) { state_->add({OperationKind::pitch, 0, degrees}); }
void Turtle::pen(bool down) { state_->add({OperationKind::pen, down ? 1 : 0, 0}); }
void Turtle::mark(std::string_view name) { state_->add({OperationKind::mark, state_->tree.name(name), 0}); }

void Turtle::part(std::string name, Place place) {
    state_->tree.parts().push_back({std::move(name), place});
    state_->add({OperationKind::part, static_cast<int>(state_->tree.parts().size()) - 1, 0});
}

bool Turtle::back_to(std::string_view name) {
    const std::optional<Cursor> found = find_above(name);
    if (found) set_cursor(*found);
    return found.has_value();
}

Pose Turtle::pose() {
    recalculate();
    Pose pose = state_->pose_of(state_->source().cursor);
    if (state_->as_2008) {
        // What follows from them hangs on it to the last bit.
        for (Vec3* axis : {&pose.right, &pose.heading, &pose.up}) {
            const double size = length(*axis);
            *axis = {axis->x / size, axis->y / size, axis->z / size};
        }
    }
    return pose;
}

void Turtle::recalculate() {
    if (state_->as_2008) state_->calculate(state_->source());
}

void Turtle::draw_to(Vec3 place, double fraction) {
    const Vec3 here = pose().at;
    Pose there;
    there.at = here + fraction * (place - here);
    state_->add_change(there);
}

void Turtle::face(const Pose& pose) {
    Pose there = pose;
    there.at = this->pose().at;
    if (!state_->as_2008) square_up(there);
    state_->add_change(there);
    state_->tree.changes().back().at = {};
}

void Turtle::clear() {
    const std::uint64_t number = state_->number + 1;
    state_ = std::make_unique<State>(state_->as_2008, state_->most);
    state_->number = number;
}

void Turtle::begin_shape(std::string name) {
    if (state_->as_2008) {
        state_->take(BlockKind::shape);
        state_->last_shape = name;
    }
    Block block;
    block.kind = BlockKind::shape;
    block.recording = state_->plant("__shape_turtles");
    ++state_->recorded;
    block.name = std::move(name);
    state_->blocks.push_back(std::move(block));
}

void Turtle::end_shape() {
    std::optional<Block> block = state_->take(BlockKind::shape);
    if (!block) return;
    state_->shapes[block->name] = {block->recording.root};
    state_->last_recorded_shape = std::move(block->recording);
}

Outcome Turtle::draw(std::string_view shape, const std::optional<std::string>& start) {
    TurtleTree& tree = state_->tree;
    const auto found = state_->shapes.find(state_->as_2008 ? std::string_view(state_->last_shape) : shape);
    if (found == state_->shapes.end()) return Outcome::no_such_shape;
    std::vector<Operation> branch;
    std::size_t begin = 0;
    const int start_name = start ? tree.find_name(*start) : none;
    bool begun = !start;
    for (int node = found->second.root; node != none; node = tree.first_child(node)) {
        Operation operation = tree.operation(node);
        if (!begun && operation.kind == OperationKind::mark && operation.detail == start_name) {
            begun = true;
            begin = branch.size();
        }
        if (operation.kind == OperationKind::change && state_->as_2008) operation = {};
        branch.push_back(operation);
    }
    if (!begun) return Outcome::no_such_mark;
    if (state_->recorded + branch.size() > state_->most) return Outcome::too_large;
    std::rotate(branch.begin(), branch.begin() + static_cast<std::ptrdiff_t>(begin), branch.end());
    for (const Operation& operation : branch) state_->add(operation);
    return Outcome::done;
}

Turtle::Cursor Turtle::cursor() const { return {state_->source().cursor, state_->number}; }

std::optional<Turtle::Cursor> Turtle::find_above(std::string_view mark) const {
    const int name = state_->tree.find_name(mark);
    if (name == none) return std::nullopt;
    const int found = state_->tree.mark_at_or_above(state_->source().cursor, name);
    if (found == none) return std::nullopt;
    return Cursor{found, state_->number};
}

void Turtle::set_cursor(Cursor cursor) {
    if (cursor.drawing != state_->number) return;
    int node = cursor.node;
    // What was replaced meanwhile is left at the mark before it.
    while (state_->tree.gone(node)) node = state_->tree.parent(node);
    state_->source().cursor = node;
}

void Turtle::begin_replacement(std::string start, std::string end, bool all) {
    if (state_->as_2008) state_->take(BlockKind::replacement);
    Block block;
    block.kind = BlockKind::replacement;
    block.recording = state_->plant("__replacement_turtles");
    ++state_->recorded;
    block.start = std::move(start);
    block.end = std::move(end);
    block.all = all;
    state_->blocks.push_back(std::move(block));
}

Outcome Turtle::end_replacement() {
    std::optional<Block> block = state_->take(BlockKind::replacement);
    // Ended by clear(), or, in the original, by a replacement within.
    if (!block) return state_->as_2008 ? Outcome::no_such_mark : Outcome::done;
    TurtleTree& tree = state_->tree;
    Recording& source = state_->source();
    const Chain chain{block->recording.root, block->recording.cursor};
    const int start = tree.find_name(block->start);
    const int end = tree.find_name(block->end);
    std::vector<int>& added = block->recording.uncalculated;
    if (!block->all) {
        const std::optional<Stretch> stretch =
            start == none || end == none ? std::nullopt : nearest_stretch(tree, source.cursor, start, end);
        if (!stretch) return Outcome::no_such_mark;
        put_between(tree, *stretch, chain);
        state_->forget_poses_below(stretch->end);
    } else if (start == none || end == none) {
        return Outcome::done;
    } else if (state_->as_2008) {
        added.clear();
        const bool finished = replace_all_of_2008(tree, source.root, start, end, chain, state_->most, added);
        state_->recorded += added.size();
        if (!finished) return Outcome::too_large;
    } else {
        const std::vector<Stretch> stretches = all_stretches(tree, source.root, start, end);
        std::uint64_t size = 0;
        for (int node = chain.root; node != none; node = tree.first_child(node)) ++size;
        if (state_->recorded + size * stretches.size() > state_->most) return Outcome::too_large;
        added.clear();
        for (const Stretch& stretch : stretches) {
            put_between(tree, stretch, copy_chain(tree, chain.root, false, added));
        }
        state_->recorded += added.size();
        if (!stretches.empty()) state_->forget_poses_below(source.root);
    }
    set_cursor(cursor());
    if (state_->as_2008) {
        source.uncalculated.insert(source.uncalculated.end(), added.begin(), added.end());
    }
    return Outcome::done;
}

std::string Turtle::describe() const {
    State& state = *state_;
    std::string out;
    const auto append = [&](std::string_view title, std::string_view beginning, const Recording* recording) {
        out += title;
        out += "----------------\n";
        if (recording == nullptr) {
            out += "null";
        } else {
            describe_tree(state.tree, recording->root, recording->cursor, beginning, out);
        }
        out += "\n";
    };
    const Block* replacement = state.find(BlockKind::replacement);
    const Block* shape = state.find(BlockKind::shape);
    append("display list:", "__program_begin", &state.drawing);
    append("replacement list:", "__replacement_turtles",
           replacement != nullptr ? &replacement->recording : nullptr);
    append("shape list:", "__shape_turtles",
           shape != nullptr ? &shape->recording : &state.last_recorded_shape);
    return out;
}

std::uint64_t Turtle::operations() const { return state_->recorded; }

std::uint64_t Turtle::looks() const { return state_->tree.looks(); }

Trail Turtle::trail(bool polygons) {
    return tree_trail(state_->tree, state_->drawing.root, state_->drawing.cursor, state_->as_2008,
                      state_->known, polygons);
}

}  // namespace popup::flatlang
