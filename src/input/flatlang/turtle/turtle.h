// The turtle and its tree: what a program draws, as operations that can be gone back to.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "input/flatlang/turtle/trail.h"

namespace popup::flatlang {

// How an operation ended that looks for something, or copies much.
enum class Outcome { done, no_such_mark, no_such_shape, too_large };

// All that a program has drawn. Operations are appended at the cursor of what is being recorded: the
// replacement of a replace block, else the shape of a shape block, else the drawing itself. Lengths are
// inches, angles degrees, right-handed about the turtle's own axes.
//
// A new turtle stands at the origin, heads along +y, has +x on its right, and its pen is down. The pen and
// the part are one each for the whole drawing, in the order in which it is drawn: depth first, children in
// the order in which they were added. Going back does not restore them.
//
// With as_2008 the oddities of the original interpreter are kept: draw() ignores the name and draws the
// shape begun last without its draw_to() and face(), a second calculation of poses leaves computed nodes in
// place with their pens down, and shapes within shapes end the outer one.
//
// Cost: amortised constant an operation, but for what looks up the tree (the path to the root) or copies
// (what is copied). Nothing recurses over the depth of the tree.
class Turtle {
 public:
    // `most_operations`: of all that is recorded; drawing and replacing stop with too_large beyond. Single
    // operations are always taken: who calls them asks operations().
    Turtle(bool as_2008, std::uint64_t most_operations);
    ~Turtle();
    Turtle(const Turtle&) = delete;
    Turtle& operator=(const Turtle&) = delete;

    void forward(double inches);
    void left(double degrees);   // about up
    void roll(double degrees);   // about heading; the right side dips
    void pitch(double degrees);  // about right; the nose goes up
    void pen(bool down);
    void mark(std::string_view name);
    void part(std::string name, Place place);

    // The cursor goes to the nearest operation above it, itself included, that is a mark of this name. False:
    // there is none, and it stays.
    bool back_to(std::string_view name);

    // Where the cursor stands, in the frame of what is being recorded (but for replacements: of the drawing).
    Pose pose();
    // What loading and evaluating text do to poses that are known already; only with as_2008.
    void recalculate();
    // A line to `fraction` of the way to that place (drawn if the pen is down). The turtle then faces along
    // the axes of the world, as a new one does.
    void draw_to(Vec3 place, double fraction);
    // Turns without moving.
    void face(const Pose& pose);

    // Forgets all that was drawn, and all shapes.
    void clear();

    // What is done from now on is recorded as a shape, from a frame of its own.
    void begin_shape(std::string name);
    void end_shape();
    // Appends a copy of the shape's first branch: from its beginning; or from its first mark of that name to
    // the end, then from the beginning to that mark.
    Outcome draw(std::string_view shape, const std::optional<std::string>& start);

    // For blocks that run at several places: marks are looked for upwards from the cursor. A cursor in what
    // is replaced later means the mark before it; one in what was forgotten means where the turtle stands.
    struct Cursor {
        int node = 0;
        std::uint64_t drawing = 0;  // how often everything had been forgotten
    };
    [[nodiscard]] Cursor cursor() const;
    [[nodiscard]] std::optional<Cursor> find_above(std::string_view mark) const;
    void set_cursor(Cursor cursor);

    // What is done from now on replaces what stands between two marks: `end`, the nearest above the cursor,
    // and `start`, the nearest above that; both stay. With `all`, every stretch from a `start` to the `end`
    // that follows it on an unbranched path is replaced by a copy.
    void begin_replacement(std::string start, std::string end, bool all);
    // Marks are looked for when it ends. too_large leaves the drawing as it was (with as_2008 and `all`, in
    // parts); no_such_mark likewise, and with `all` that is no failure. Blocks that clear() has dropped end
    // without doing anything.
    Outcome end_replacement();

    // The trees as the original's showSoup() printed them; a # stands for each address. Cut off beyond 64 MB.
    [[nodiscard]] std::string describe() const;

    // Of all that is recorded, the beginnings of shapes and replacements among them.
    [[nodiscard]] std::uint64_t operations() const;
    // How often operations were looked at beside being recorded; only grows, but for clear().
    [[nodiscard]] std::uint64_t looks() const;

    // What was drawn so far, with its polygons unless they are not wanted. Cost: near linear in operations.
    Trail trail(bool polygons = true);

 private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace popup::flatlang
