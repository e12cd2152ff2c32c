// What moves the turtle, and asks where it is.
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "input/flatlang/run/interpreter.h"
#include "input/text.h"

namespace popup::flatlang {
namespace {

double number(const Call& call, std::size_t i) { return to_number(call.arguments[i], call.in.symbols); }

std::string text(const Call& call, std::size_t i) { return call.in.text_of(call.arguments[i], call.place); }

Value done(const Call& call) {
    call.in.spend_looks();
    call.in.check_trail(call.place);
    return call.in.heap.nil();
}

template <void (Turtle::*kMove)(double), int kSign>
Value moved(const Call& call) {
    (call.in.turtle.*kMove)(kSign * number(call, 0));
    return done(call);
}

template <bool kDown>
Value pen(const Call& call) {
    call.in.turtle.pen(kDown);
    return done(call);
}

Value mark(const Call& call) {
    call.in.turtle.mark(text(call, 0));
    return done(call);
}

Value back_to(const Call& call) {
    const std::string name = text(call, 0);
    const bool there = call.in.turtle.back_to(name);
    call.in.spend_looks();
    if (!there) {
        call.in.warn("flatlang-no-such-mark", call.place,
                     fmt::format("there is no mark \"{}\" on the way back to the beginning; the turtle stays",
                                 shown(name)));
    }
    return call.in.heap.nil();
}

Value part(const Call& call) {
    if (call.arguments.empty()) {
        call.in.turtle.part("part", call.in.program_place(call.place));
        return done(call);
    }
    std::string name = text(call, 0);
    call.in.print("Beginning a new part named " + name, call.place);
    call.in.turtle.part(std::move(name), call.in.program_place(call.place));
    return done(call);
}

Value draw(const Call& call) {
    const std::string shape = text(call, 0);
    std::optional<std::string> start;
    if (call.arguments.size() > 1) start = text(call, 1);
    switch (call.in.turtle.draw(shape, start)) {
        case Outcome::done:
            break;
        case Outcome::no_such_shape:
            return call.in.fail_argument(call, 0, fmt::format("there is no shape \"{}\"", shown(shape)),
                                         "a shape is recorded by shape(\"…\") … done before it is drawn");
        case Outcome::no_such_mark:
            return call.in.fail_argument(call, 1,
                                         fmt::format("the shape \"{}\" has no mark \"{}\" to begin at",
                                                     shown(shape), shown(start.value_or(""))));
        case Outcome::too_large:
            return call.in.fail_limit(call.place, "the turtle's trail would grow too long", "--max-trail");
    }
    return done(call);
}

Value pos(const Call& call) {
    const Pose pose = call.in.turtle.pose();
    call.in.spend_looks();
    return call.in.heap.vec(pose.at);
}

Value dir(const Call& call) {
    const Pose pose = call.in.turtle.pose();
    call.in.spend_looks();
    return call.in.heap.matrix({pose.right.x, pose.right.y, pose.right.z, pose.heading.x, pose.heading.y,
                                pose.heading.z, pose.up.x, pose.up.y, pose.up.z});
}

const std::array<double, 9>& numbers_of(const Call& call, Type type, std::string_view wanted) {
    const Value& value = call.arguments[0];
    if (value->type != type) call.in.fail_type(call, 0, wanted);
    return value->extras->numbers;
}

Value draw_to(const Call& call) {
    const std::array<double, 9>& v = numbers_of(call, Type::vec, "a vector, such as pos() gives,");
    double fraction = 1.0;
    if (call.arguments.size() > 1) {
        if (call.arguments[1]->type != Type::number) {
            return call.in.fail_type(call, 1, "a number, the fraction of the way,");
        }
        fraction = call.arguments[1]->number;
    }
    call.in.turtle.draw_to({v[0], v[1], v[2]}, fraction);
    return done(call);
}

Value face(const Call& call) {
    const std::array<double, 9>& m = numbers_of(call, Type::matrix, "a matrix, such as dir() gives,");
    Pose pose;
    pose.right = {m[0], m[1], m[2]};
    pose.heading = {m[3], m[4], m[5]};
    pose.up = {m[6], m[7], m[8]};
    call.in.turtle.face(pose);
    return done(call);
}

Value nothing(const Call& call) { return call.in.heap.nil(); }

constexpr std::array kBuiltins{
    Builtin{"__forward", 1, 1, moved<&Turtle::forward, 1>},
    Builtin{"__backward", 1, 1, moved<&Turtle::forward, -1>},
    Builtin{"__left", 1, 1, moved<&Turtle::left, 1>},
    Builtin{"__right", 1, 1, moved<&Turtle::left, -1>},
    Builtin{"__roll", 1, 1, moved<&Turtle::roll, 1>},
    Builtin{"__pitch", 1, 1, moved<&Turtle::pitch, 1>},
    Builtin{"__up", 0, 0, pen<false>},
    Builtin{"__down", 0, 0, pen<true>},
    Builtin{"__mark", 1, 1, mark},
    Builtin{"__backto", 1, 1, back_to},
    Builtin{"__part", 0, 1, part},
    Builtin{"draw", 1, 2, draw, nullptr,
            "draw(shape), draw(shape, mark): draws a shape, from its beginning or from a mark in it"},
    Builtin{"pos", 0, 0, pos, nullptr, "pos(): the place of the turtle, a vector"},
    Builtin{"dir", 0, 0, dir, nullptr, "dir(): which ways are right, ahead and up for the turtle, a matrix"},
    Builtin{"drawto", 1, 2, draw_to, nullptr,
            "drawto(v), drawto(v, fraction): draws a line to a place, or a part of it; the turtle then faces "
            "as at the beginning"},
    Builtin{"facedir", 1, 1, face, nullptr, "facedir(m): turns as dir() said"},
    Builtin{"turtlexor", 0, -1, nothing, nullptr, "turtlexor(...): is accepted, and does nothing"},
};

}  // namespace

std::span<const Builtin> turtle_builtins() { return kBuiltins; }

}  // namespace popup::flatlang
