// The turtle of FlatLang: where it goes, what its shapes and replacements draw, and which loops are polygons.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "input/flatlang/turtle/turtle.h"
#include "support/turtle_script.h"

namespace popup::flatlang {
namespace {

using test::Script;

constexpr std::uint64_t plenty = 1'000'000;

std::string text(Vec3 p) {
    const auto number = [](double v) {
        std::string digits = fmt::format("{:.4f}", v);
        digits.erase(digits.find_last_not_of('0') + 1);
        if (digits.back() == '.') digits.pop_back();
        return digits == "-0" ? "0" : digits;
    };
    return number(p.x) + " " + number(p.y) + " " + number(p.z);
}

// A line for what is drawn without a gap: "0 0 0 > 0 1 0 [part]".
std::string segments(const Trail& trail) {
    std::string out;
    std::string last;
    for (const TrailSegment& segment : trail.segments) {
        const std::string from = text(segment.from);
        if (from != last) out += (out.empty() ? "" : "\n") + from;
        last = text(segment.to);
        out += " > " + last;
        if (segment.part != 0) out += " [" + trail.parts[static_cast<std::size_t>(segment.part)].name + "]";
    }
    return out;
}

std::string polygons(const Trail& trail) {
    std::string out;
    for (const TrailPolygon& polygon : trail.polygons) {
        if (!out.empty()) out += "\n";
        for (std::size_t i = 0; i < polygon.points.size(); ++i) {
            out += (i == 0 ? "" : ", ") + text(polygon.points[i]);
        }
    }
    return out;
}

std::string shown(const Pose& pose) {
    return text(pose.at) + " | " + text(pose.right) + " | " + text(pose.heading) + " | " + text(pose.up);
}

Trail drawn(std::string_view calls, bool as_2008 = false) {
    Turtle turtle(as_2008, plenty);
    const Script script(turtle, calls);
    return turtle.trail();
}

// What the original interpreter drew, found and where it ended.
struct Probe {
    const char* name;
    const char* calls;
    const char* segments;
    const char* polygons;
    // As they would be had it calculated the drawing only once: what is found but in 2008 mode.
    const char* polygons_once;
    const char* pose;
};
constexpr const char* same = "same";
constexpr const char* only_2008 = "only 2008";

const Probe kProbes[] = {
    {"backto branches",
     "mark a f 1 mark b l 45 f 1 back b l -45 f 1 back a l 90 f 2 back b f 0.5 mark a f 1 back a l 90 "
     "f 1",
     "0 0 0 > 0 1 0 > -0.7071 1.7071 0\n"
     "0 1 0 > 0.7071 1.7071 0\n"
     "0 0 0 > -2 0 0 > -2.5 0 0 > -3.5 0 0\n"
     "-2.5 0 0 > -2.5 -1 0",
     "", same, "-2.5 -1 0 | -1 0 0 | 0 -1 0 | 0 0 1"},
    {"drawto frame", "f 1 l 90 f 2 pitch 40 note v drawto v 0 l 30 note v f 1 drawto v 0.5",
     "0 0 0 > 0 1 0 > -2 1 0 > -2.5 1.866 0 > -2.25 1.433 0", "", same,
     "-2.25 1.433 0 | 1 0 0 | 0 1 0 | 0 0 1"},
    {"from block", "f 1 mark p l 90 f 1 mark q l 90 f 1 from p,q { l -90 f 0.5 l -90 f 0.25 } f 3",
     "0 0 0 > 0 1 0 > -1 1 0 > -1 0 0 > -1 -3 0\n"
     "-1 1 0 > -1 1.5 0 > -0.75 1.5 0\n"
     "0 1 0 > 0.5 1 0 > 0.5 0.75 0",
     "0.5 0.75 0, 0.5 1 0, 0 1 0\n"
     "-0.75 1.5 0, -1 1.5 0, -1 1 0",
     same, "-1 -3 0 | -1 0 0 | 0 -1 0 | 0 0 1"},
    {"from shape",
     "shape arm { f 1 l 30 f 0.5 } mark hub f 2 l -120 mark hub f 2 l -120 mark hub f 2 l -120 from "
     "hub { draw arm } mark x f 1 mark y f 1 from x,y,hub { l 90 draw arm }",
     "0 0 0 > 0 2 0 > 1.7321 1 0 > 0 0 0 > 0 1 0 > 0 2 0\n"
     "0 1 0 > -1 1 0 > -1.433 0.75 0\n"
     "0 0 0 > -1 0 0 > -1.433 -0.25 0\n"
     "1.7321 1 0 > 0.866 0.5 0 > 0.616 0.067 0\n"
     "1.7321 1 0 > 2.2321 0.134 0 > 2.6651 -0.116 0",
     "2.6651 -0.116 0, 2.2321 0.134 0, 1.7321 1 0\n"
     "0.616 0.067 0, 0.866 0.5 0, 1.7321 1 0, 0 2 0, 0 0 0",
     same, "0 2 0 | 1 0 0 | 0 1 0 | 0 0 1"},
    {"pen", "f 1 up f 1 down l 90 f 1 mark m up f 1 back m l -90 f 1 note p down f 0.5 back nosuch f 0.25",
     "0 0 0 > 0 1 0\n"
     "0 2 0 > -1 2 0\n"
     "-1 3 0 > -1 3.5 0 > -1 3.75 0",
     "-1 3.75 0, -1 3.5 0, -1 3 0, -1 2 0", "", "-1 3.75 0 | 1 0 0 | 0 1 0 | 0 0 1"},
    {"polygons penup", "f 1 l 90 f 1 l 90 f 1 l 90 f 1 l 90 up f 3 down f 2 l 90 f 2 l 90 f 2 l 90 f 2 l 90",
     "0 0 0 > 0 1 0 > -1 1 0 > -1 0 0 > 0 0 0\n"
     "0 3 0 > 0 5 0 > -2 5 0 > -2 3 0 > 0 3 0",
     "-1 0 0, -1 1 0, 0 1 0, 0 0 0\n"
     "-2 3 0, -2 5 0, 0 5 0, 0 3 0",
     same, "0 3 0 | 1 0 0 | 0 1 0 | 0 0 1"},
    {"polygons penup pos",
     "f 1 l 90 f 1 l 90 f 1 l 90 f 1 l 90 up f 3 note p down f 2 l 90 f 2 l 90 f 2 l 90 f 2 l 90",
     "0 0 0 > 0 1 0 > -1 1 0 > -1 0 0 > 0 0 0\n"
     "0 3 0 > 0 5 0 > -2 5 0 > -2 3 0 > 0 3 0",
     "-1 0 0, -1 1 0, 0 1 0, 0 0 0\n"
     "-2 3 0, -2 5 0, 0 5 0, 0 3 0",
     same, "0 3 0 | 1 0 0 | 0 1 0 | 0 0 1"},
    {"polygon collinear end", "f 2 l 90 f 2 l 90 f 2 l 90 f 0.5 f 0.5 f 1",
     "0 0 0 > 0 2 0 > -2 2 0 > -2 0 0 > -1.5 0 0 > -1 0 0 > 0 0 0",
     "-1 0 0, -1.5 0 0, -2 0 0, -2 2 0, 0 2 0, 0 0 0", same, "0 0 0 | 0 -1 0 | 1 0 0 | 0 0 1"},
    {"polygon collinear start",
     "f 1 f 1 f 1 l 90 f 2 l 90 f 3 l 90 f 2 up f 5 down l 90 f 1 l 90 f 1 pitch 90 f 1 pitch -90 l "
     "-90 f 1",
     "0 0 0 > 0 1 0 > 0 2 0 > 0 3 0 > -2 3 0 > -2 0 0 > 0 0 0\n"
     "5 0 0 > 5 1 0 > 4 1 0 > 4 1 1 > 4 2 1",
     "-2 0 0, -2 3 0, 0 3 0, 0 2 0, 0 1 0, 0 0 0", same, "4 2 1 | 1 0 0 | 0 1 0 | 0 0 1"},
    {"replace1",
     "mark A f 1 mark B l 90 mark A f 1 mark B l 90 mark A f 1 mark B l 90 mark A f 1 mark B l 90 "
     "replace A B { l 45 f 0.5 l -90 f 0.5 l 45 } note p f 0.1",
     "0 0 0 > 0 1 0 > -1 1 0 > -1 0 0 > -0.6464 0.3536 0 > -0.2929 0 0 > -0.2929 0.1 0", "", same,
     "-0.2929 0.1 0 | 1 0 0 | 0 1 0 | 0 0 1"},
    {"replace all",
     "mark A f 1 mark B l 90 mark A f 1 mark B l 90 mark A f 1 mark B l 90 mark A f 1 mark B l 90 "
     "replaceall A B { f 0.25 l 90 f 0.25 l -90 f 0.5 } f 0.1 note p",
     "0 0 0 > 0 0.25 0 > -0.25 0.25 0 > -0.25 0.75 0 > -0.5 0.75 0 > -0.5 0.5 0 > -1 0.5 0 > -1 0.25 0 > "
     "-0.75 0.25 0 > -0.75 -0.25 0 > -0.5 -0.25 0 > -0.5 0 0 > 0 0 0 > 0 0.1 0",
     "-0.5 0 0, -0.5 -0.25 0, -0.75 -0.25 0, -0.75 0.25 0, -1 0.25 0, -1 0.5 0, -0.5 0.5 0, -0.5 0.75 0, "
     "-0.25 0.75 0, -0.25 0.25 0, 0 0.25 0, 0 0 0",
     same, "0 0.1 0 | 1 0 0 | 0 1 0 | 0 0 1"},
    {"replace branch",
     "f 1 mark A l 90 f 1 mark B f 1 mark C l -90 f 1 replace A B { l -90 f 2 mark newmark } note p "
     "back newmark note p l 45 f 1",
     "0 0 0 > 0 1 0 > 2 1 0 > 3 1 0 > 3 0 0\n"
     "2 1 0 > 2.7071 1.7071 0",
     "", same, "2.7071 1.7071 0 | 0.7071 -0.7071 0 | 0.7071 0.7071 0 | 0 0 1"},
    {"replace after pos", "mark A f 1 mark B l 90 f 1 l 90 f 1 l 90 f 1 note p replace A B { f 3 } note p",
     "0 0 0 > 0 3 0 > -1 3 0 > -1 2 0 > 0 2 0", "-1 0 0, -1 1 0, 0 1 0, 0 3 0, 0 0 0", "",
     "0 2 0 | 0 -1 0 | 1 0 0 | 0 0 1"},
    {"replace nested draw",
     "shape zig { l 60 f 0.5 l -120 f 0.5 l 60 } mark s f 1 mark e l -120 mark s f 1 mark e l -120 "
     "mark s f 1 mark e l -120 replaceall s e { draw zig } f 0.2 note p",
     "0 0 0 > -0.433 0.25 0 > 0 0.5 0 > 0.433 0.75 0 > 0.433 0.25 0 > 0.433 -0.25 0 > 0 0 0 > 0 0.2 0",
     "0.433 -0.25 0, 0.433 0.25 0, 0.433 0.75 0, 0 0.5 0, -0.433 0.25 0, 0 0 0", same,
     "0 0.2 0 | 1 0 0 | 0 1 0 | 0 0 1"},
    {"shape draw",
     "shape sq { mark s1 f 1 l 90 f 1 l 90 f 1 l 90 f 1 l 90 } shape tri { mark t1 f 2 mark side l 120 "
     "f 2 mark side l 120 f 2 mark side l 120 } draw sq f 5 drawfrom tri side note p",
     "0 0 0 > 0 2 0 > -1.7321 1 0 > 0 0 0 > 0 5 0 > -1.7321 4 0 > 0 3 0 > 0 5 0",
     "-1.7321 1 0, 0 2 0, 0 0 0\n"
     "0 3 0, -1.7321 4 0, 0 5 0",
     only_2008, "0 5 0 | 1 0 0 | 0 1 0 | 0 0 1"},
    {"shape drawto", "shape s { f 1 note v l 90 f 1 drawto v 1 f 2 } draw s note p",
     "0 0 0 > 0 1 0 > -1 1 0 > -3 1 0", "", only_2008, "-3 1 0 | 0 1 0 | -1 0 0 | 0 0 1"},
    {"shape nested", "shape outer { f 1 shape inner { f 10 l 90 } f 2 } draw outer draw anything",
     "0 0 0 > 0 2 0 > 0 12 0 > -10 12 0", "", only_2008, "-10 12 0 | -1 0 0 | 0 -1 0 | 0 0 1"},
    {"shape rules",
     "shape sq { mark in f 1 mark corner l 90 f 1 mark corner l 90 f 1 mark corner l 90 f 1 mark "
     "corner l 90 back in l 45 f 5 } f 2 draw sq note p drawfrom sq corner",
     "0 0 0 > 0 2 0 > 0 3 0 > -1 3 0 > -1 2 0 > 0 2 0 > -1 2 0 > -1 1 0 > 0 1 0 > 0 2 0",
     "-1 2 0, -1 3 0, 0 3 0, 0 2 0\n"
     "0 1 0, -1 1 0, -1 2 0, 0 2 0",
     same, "0 2 0 | 1 0 0 | 0 1 0 | 0 0 1"},
    {"star",
     "up l 90 f 2 l -90 down f 3 l 144 f 3 l 144 f 3 l 144 f 3 l 144 f 3 l 144 roll 35 pitch 15 f 1 l "
     "144 f 1 l 144 f 1 l 144 f 1 l 144 f 1 l 144",
     "-2 0 0 > -2 3 0 > -3.7634 0.5729 0 > -0.9102 1.5 0 > -3.7634 2.4271 0 > -2 0 0 > -1.8515 0.9659 0.212 "
     "> -2.4531 0.1845 0.3776 > -1.6282 0.483 -0.1024 > -2.3614 0.7815 0.5087 > -2 0 0",
     "-3.7634 2.4271 0, -0.9102 1.5 0, -3.7634 0.5729 0, -2 3 0, -2 0 0\n"
     "-2.3614 0.7815 0.5087, -1.6282 0.483 -0.1024, -2.4531 0.1845 0.3776, -1.8515 0.9659 0.212, -2 0 0",
     same, "-2 0 0 | 0.8192 0 -0.5736 | 0.1485 0.9659 0.212 | 0.554 -0.2588 0.7912"},
    {"turtle 3d box",
     "f 2 l 90 f 2 l 90 f 2 l 90 f 2 l 90 f 2 l 90 roll 90 roll -90 l -90 pitch 90 f 2 l 90 f 2 l 90 f "
     "2 l 90 f 2 l 90 f 2 l 90 roll 90 roll -90 l -90 pitch 90 f 2 l 90 f 2 l 90 f 2 l 90 f 2 l 90 f 2 "
     "l 90 roll 90 roll -90 l -90 pitch 90 f 2 l 90 f 2 l 90 f 2 l 90 f 2 l 90 f 2 l 90 roll 90 roll "
     "-90 l -90 pitch 90 roll 90 f 2 l 90 f 2 l 90 f 2 l 90 f 2 l 90",
     "0 0 0 > 0 2 0 > -2 2 0 > -2 0 0 > 0 0 0 > 0 2 0 > 0 2 2 > -2 2 2 > -2 2 0 > 0 2 0 > 0 2 2 > 0 0 2 > -2 "
     "0 2 > -2 2 2 > 0 2 2 > 0 0 2 > 0 0 0 > -2 0 0 > -2 0 2 > 0 0 2 > 0 0 0 > 0 2 0 > 0 2 2 > 0 0 2 > 0 0 0",
     "-2 0 0, -2 2 0, 0 2 0, 0 0 0\n"
     "-2 2 0, -2 2 2, 0 2 2, 0 2 0\n"
     "-2 2 2, -2 0 2, 0 0 2, 0 2 2\n"
     "0 0 2, 0 2 2, 0 2 0, 0 0 0\n"
     "0 0 2, -2 0 2, -2 0 0, 0 0 0\n"
     "0 0 2, 0 2 2, 0 2 0, 0 0 0",
     same, "0 0 0 | 0 0 -1 | 0 1 0 | 1 0 0"},
    {"hpgl layout",
     "f 5 l 90 f 5 l 90 f 5 l 90 f 5 l 90 f 4 l -120 f 4 l -120 f 4 l -120 roll 90 f 6 l 90 f 6 l 90 f "
     "6 l 90 f 6 l 90 pitch 30 f 3 l -120 f 3 l -120 f 3 l -120 f 2 l 90 f 2 l 90 f 2 l 90 f 2 l 90",
     "0 0 0 > 0 5 0 > -5 5 0 > -5 0 0 > 0 0 0 > 0 4 0 > 3.4641 2 0 > 0 0 0 > 0 6 0 > 0 6 6 > 0 0 6 > 0 0 0 > "
     "1.5 2.5981 0 > 0.75 1.299 -2.5981 > 0 0 0 > 1 1.7321 0 > 1 1.7321 2 > 0 0 2 > 0 0 0",
     "-5 0 0, -5 5 0, 0 5 0, 0 0 0\n"
     "3.4641 2 0, 0 4 0, 0 0 0\n"
     "0 0 6, 0 6 6, 0 6 0, 0 0 0\n"
     "0.75 1.299 -2.5981, 1.5 2.5981 0, 0 0 0\n"
     "0 0 2, 1 1.7321 2, 1 1.7321 0, 0 0 0",
     same, "0 0 0 | 0 0 -1 | 0.5 0.866 0 | 0.866 -0.5 0"},
    {"parts",
     "f 0.5 part alpha f 1 l 90 f 1 l 90 f 1 l 90 f 1 l 90 up f 2 down part beta f 2 l 90 f 2 l 90 f 2 "
     "l 90 f 2 l 90 part part f 0.5 l 90 f 0.5 l 90 f 0.5 l 90 f 0.5 l 90",
     "0 0 0 > 0 0.5 0 > 0 1.5 0 [alpha] > -1 1.5 0 [alpha] > -1 0.5 0 [alpha] > 0 0.5 0 [alpha]\n"
     "0 2.5 0 > 0 4.5 0 [beta] > -2 4.5 0 [beta] > -2 2.5 0 [beta] > 0 2.5 0 [beta] > 0 3 0 [part] > -0.5 3 "
     "0 [part] > -0.5 2.5 0 [part] > 0 2.5 0 [part]",
     "-1 0.5 0, -1 1.5 0, 0 1.5 0, 0 0.5 0\n"
     "-2 2.5 0, -2 4.5 0, 0 4.5 0, 0 2.5 0\n"
     "-0.5 2.5 0, -0.5 3 0, 0 3 0, 0 2.5 0",
     same, "0 2.5 0 | 1 0 0 | 0 1 0 | 0 0 1"}};

TEST(FlatlangTurtle, DrawsWhatTheOriginalDrew) {
    for (const Probe& probe : kProbes) {
        SCOPED_TRACE(probe.name);
        const Trail trail = drawn(probe.calls, true);
        EXPECT_EQ(segments(trail), probe.segments);
        EXPECT_EQ(polygons(trail), probe.polygons);
        EXPECT_EQ(shown(trail.last), probe.pose);
        if (probe.polygons_once == only_2008) continue;
        const Trail mended = drawn(probe.calls);
        EXPECT_EQ(segments(mended), probe.segments);
        EXPECT_EQ(polygons(mended), probe.polygons_once == same ? probe.polygons : probe.polygons_once);
        EXPECT_EQ(shown(mended.last), probe.pose);
    }
}

void tree(Turtle& turtle, int depth, double length) {
    if (depth == 0) return;
    const std::string mark = "node" + std::to_string(depth);
    turtle.forward(length);
    turtle.mark(mark);
    turtle.left(30);
    tree(turtle, depth - 1, length * 0.7);
    turtle.back_to(mark);
    turtle.left(-30);
    tree(turtle, depth - 1, length * 0.7);
    turtle.back_to(mark);
}

TEST(FlatlangTurtle, DrawsOldestBranchesFirstAndLooksForLoopsInTheYoungestFirst) {
    for (const bool as_2008 : {false, true}) {
        Turtle turtle(as_2008, plenty);
        tree(turtle, 4, 1);
        const Trail trail = turtle.trail();
        EXPECT_EQ(segments(trail),
                  "0 0 0 > 0 1 0 > -0.35 1.6062 0 > -0.7744 1.8512 0 > -1.1174 1.8512 0\n"
                  "-0.7744 1.8512 0 > -0.9459 2.1483 0\n"
                  "-0.35 1.6062 0 > -0.35 2.0962 0 > -0.5215 2.3933 0\n"
                  "-0.35 2.0962 0 > -0.1785 2.3933 0\n"
                  "0 1 0 > 0.35 1.6062 0 > 0.35 2.0962 0 > 0.1785 2.3933 0\n"
                  "0.35 2.0962 0 > 0.5215 2.3933 0\n"
                  "0.35 1.6062 0 > 0.7744 1.8512 0 > 0.9459 2.1483 0\n"
                  "0.7744 1.8512 0 > 1.1174 1.8512 0");
        EXPECT_EQ(polygons(trail),
                  "0.9459 2.1483 0, 0.7744 1.8512 0, 1.1174 1.8512 0, 0.7744 1.8512 0, 0.35 1.6062 0\n"
                  "0.1785 2.3933 0, 0.35 2.0962 0, 0.5215 2.3933 0, 0.35 2.0962 0, 0.35 1.6062 0, 0 1 0\n"
                  "-0.5215 2.3933 0, -0.35 2.0962 0, -0.1785 2.3933 0, -0.35 2.0962 0, -0.35 1.6062 0");
        EXPECT_EQ(shown(trail.last), "0 1 0 | 1 0 0 | 0 1 0 | 0 0 1");
    }
}

TEST(FlatlangTurtle, TurnsAreRightHandedAboutItsOwnAxes) {
    Turtle turtle(false, plenty);
    EXPECT_EQ(shown(turtle.pose()), "0 0 0 | 1 0 0 | 0 1 0 | 0 0 1");
    const Script first(turtle, "f 1 l 90 f 1");
    EXPECT_EQ(text(turtle.pose().at), "-1 1 0");
    const Script second(turtle, "l -90 roll 90 l 90 f 1");
    EXPECT_EQ(text(turtle.pose().at), "-1 1 1");
    const Script third(turtle, "l -90 roll -90 pitch 90 f 1");
    EXPECT_EQ(text(turtle.pose().at), "-1 1 2");
    const Script last(turtle, "pitch -90 f -2 l 30 roll 20 pitch 10 f 1.5");
    EXPECT_EQ(shown(turtle.pose()),
              "-1.6615 0.3238 2.2448 | 0.8138 0.4698 -0.342 | -0.441 0.8826 0.1632 | 0.3785 0.018 0.9254");
}

TEST(FlatlangTurtle, ThePenIsNotRestoredByGoingBack) {
    const Trail trail = drawn("mark a f 1 up back a l 90 f 1 down f 1");
    EXPECT_EQ(segments(trail), "0 0 0 > 0 1 0\n-1 0 0 > -2 0 0");
}

TEST(FlatlangTurtle, FindsTheNearestMarkAboveOnly) {
    Turtle turtle(false, plenty);
    const Script script(turtle, "mark a f 1 mark b f 1 mark a f 1 back b");
    EXPECT_EQ(text(turtle.pose().at), "0 1 0");
    EXPECT_TRUE(turtle.back_to("a"));
    EXPECT_EQ(text(turtle.pose().at), "0 0 0");
    EXPECT_FALSE(turtle.back_to("b"));
    EXPECT_FALSE(turtle.find_above("never"));
    EXPECT_EQ(text(turtle.pose().at), "0 0 0");
}

TEST(FlatlangTurtle, DrawsTheShapeOfThatNameWithItsDrawnLines) {
    const char* calls = "shape a { f 1 note v l 90 f 1 drawto v 1 f 2 } shape b { f 5 } draw a";
    EXPECT_EQ(segments(drawn(calls)), "0 0 0 > 0 1 0 > -1 1 0 > 0 1 0 > 0 3 0");
    EXPECT_EQ(segments(drawn(calls, true)), "0 0 0 > 0 5 0");
}

TEST(FlatlangTurtle, ADrawnLineOfAShapeIsTakenAlongWithIt) {
    const Trail trail = drawn("shape a { f 1 note v l 90 f 1 drawto v 0.5 } roll 90 l 90 f 1 draw a");
    EXPECT_EQ(segments(trail), "0 0 0 > 0 0 1 > 0 0 2 > 0 -1 2 > 0 -0.5 2");
    // As a new turtle in the shape, turned as the shape is.
    EXPECT_EQ(shown(trail.last), "0 -0.5 2 | 0 1 0 | 0 0 1 | 1 0 0");
}

TEST(FlatlangTurtle, AShapeMayBeBegunAtAMark) {
    EXPECT_EQ(segments(drawn("shape a { f 1 mark m l 90 f 2 back m f 9 } drawfrom a m")),
              "0 0 0 > -2 0 0 > -3 0 0");
    Turtle turtle(false, plenty);
    EXPECT_EQ(Script(turtle, "shape a { f 1 } drawfrom a m").last(), Outcome::no_such_mark);
    EXPECT_EQ(Script(turtle, "draw b").last(), Outcome::no_such_shape);
    EXPECT_TRUE(turtle.trail().segments.empty());
    Turtle old(true, plenty);
    EXPECT_EQ(Script(old, "draw b").last(), Outcome::no_such_shape);
}

TEST(FlatlangTurtle, ShapesWithinShapesAreShapesOfTheirOwn) {
    const char* calls = "shape a { f 1 shape b { l 90 f 3 } draw b f 1 } draw a";
    EXPECT_EQ(segments(drawn(calls)), "0 0 0 > 0 1 0 > -3 1 0 > -4 1 0");
    EXPECT_EQ(segments(drawn("shape a { f 1 shape b { f 7 note v } } draw a")), "0 0 0 > 0 1 0");
}

TEST(FlatlangTurtle, AShapeHasAFrameAndMarksOfItsOwn) {
    Turtle turtle(false, plenty);
    turtle.mark("m");
    turtle.forward(3);
    turtle.begin_shape("a");
    EXPECT_EQ(text(turtle.pose().at), "0 0 0");
    EXPECT_FALSE(turtle.back_to("m"));
    turtle.end_shape();
    EXPECT_EQ(text(turtle.pose().at), "0 3 0");
}

TEST(FlatlangTurtle, AReplacementLeavesItsMarksAndWhatFollows) {
    EXPECT_EQ(segments(drawn("mark a f 1 mark b l 90 f 1 replace a b { f 2 l 90 } f 1")),
              "0 0 0 > 0 2 0 > 0 1 0 > 0 0 0");
    // Nothing in between, and nothing in its place.
    EXPECT_EQ(segments(drawn("mark a mark b f 1 replace a b { l 90 f 1 }")), "0 0 0 > -1 0 0 > -2 0 0");
    EXPECT_EQ(segments(drawn("mark a f 1 mark b f 1 replace a b { }")), "0 0 0 > 0 1 0");
    // It keeps its place among branches, and takes with it what branches off in between.
    EXPECT_EQ(
        segments(drawn("mark a l 90 f 1 back a f 1 mark m f 9 back m f 1 mark b back a l -90 f 1 back a "
                       "l 180 mark b f 1 replace a b { f 0.5 }")),
        "0 0 0 > -1 0 0\n0 0 0 > 0 1 0 > 0 10 0\n0 1 0 > 0 2 0\n0 0 0 > 1 0 0\n0 0 0 > 0 0.5 0 > 0 1.5 0");
    Turtle turtle(false, plenty);
    EXPECT_EQ(Script(turtle, "mark a f 1 replace a b { f 2 }").last(), Outcome::no_such_mark);
    EXPECT_EQ(Script(turtle, "mark b f 1 replace c b { f 2 }").last(), Outcome::no_such_mark);
    EXPECT_EQ(segments(turtle.trail()), "0 0 0 > 0 1 0 > 0 2 0");
}

TEST(FlatlangTurtle, PosesFollowAReplacement) {
    const Trail trail = drawn("mark a f 1 mark b f 1 note v replace a b { f 5 } note v l 90 drawto v 0.5");
    EXPECT_EQ(shown(trail.last), "0 6 0 | 1 0 0 | 0 1 0 | 0 0 1");
}

TEST(FlatlangTurtle, AllStretchesAreReplacedAlsoOnBranchesAndBetweenMarksOfOneName) {
    const char* cross =
        "mark o mark s f 1 mark e f 1 back o l 90 mark s f 1 mark e f 1 back o l 180 mark s f 1 back s l 90 "
        "f 1 "
        "mark e replaceall s e { f 3 }";
    // The third has a branch between its marks.
    EXPECT_EQ(segments(drawn(cross)),
              "0 0 0 > 0 3 0 > 0 4 0\n0 0 0 > -3 0 0 > -4 0 0\n0 0 0 > 0 -1 0\n0 0 0 > 1 0 0");
    EXPECT_EQ(segments(drawn("mark m f 1 mark m f 1 mark m f 1 replaceall m m { f 2 }")),
              "0 0 0 > 0 2 0 > 0 4 0 > 0 5 0");
    Turtle turtle(false, plenty);
    EXPECT_EQ(Script(turtle, "f 1 replaceall a b { f 1 }").last(), Outcome::done);
    EXPECT_EQ(segments(turtle.trail()), "0 0 0 > 0 1 0");
}

TEST(FlatlangTurtle, ACursorInWhatIsForgottenStaysWhereTheTurtleStands) {
    for (const bool as_2008 : {false, true}) {
        Turtle turtle(as_2008, plenty);
        turtle.forward(1);
        const Turtle::Cursor forgotten = turtle.cursor();
        turtle.clear();
        turtle.set_cursor(forgotten);
        EXPECT_EQ(text(turtle.pose().at), "0 0 0");
        turtle.left(90);
        turtle.forward(2);
        turtle.set_cursor(forgotten);
        turtle.forward(1);
        EXPECT_EQ(segments(turtle.trail()), "0 0 0 > -2 0 0 > -3 0 0");
    }
}

TEST(FlatlangTurtle, ACursorInWhatIsReplacedStaysAtTheMarkBefore) {
    Turtle turtle(false, plenty);
    const Script script(turtle, "mark a f 1 mark m f 1 mark b f 1 back m");
    const Turtle::Cursor within = turtle.cursor();
    const Script replace(turtle, "replaceall a b { f 5 }");
    EXPECT_EQ(text(turtle.pose().at), "0 0 0");
    turtle.set_cursor(within);
    turtle.left(90);
    turtle.forward(1);
    EXPECT_EQ(segments(turtle.trail()), "0 0 0 > 0 5 0 > 0 6 0\n0 0 0 > -1 0 0");
}

TEST(FlatlangTurtle, BlocksWithinBlocksEndInTheirOrder) {
    EXPECT_EQ(segments(drawn("shape a { mark s f 1 mark e replace s e { l 90 f 2 } f 3 } f 1 draw a")),
              "0 0 0 > 0 1 0 > -2 1 0 > -5 1 0");
    EXPECT_EQ(segments(drawn("mark s f 1 mark e replace s e { shape a { f 7 } f 2 draw a }")),
              "0 0 0 > 0 2 0 > 0 9 0");
    EXPECT_EQ(
        segments(drawn("mark s f 1 mark e f 1 mark t replace e t { f 3 replace s e { l 90 f 4 } f 3 }")),
        "0 0 0 > -4 0 0 > -7 0 0 > -10 0 0");
}

TEST(FlatlangTurtle, ClearForgetsAlsoWhatIsBegun) {
    Turtle turtle(false, plenty);
    EXPECT_EQ(Script(turtle, "shape a { f 1 } f 1 shape b { f 2 clear f 3 } draw a").last(),
              Outcome::no_such_shape);
    EXPECT_EQ(segments(turtle.trail()), "0 0 0 > 0 3 0");
    EXPECT_EQ(turtle.operations(), 1U);
    EXPECT_EQ(Script(turtle, "mark a f 1 mark b replace a b { clear f 4 }").last(), Outcome::done);
    EXPECT_EQ(segments(turtle.trail()), "0 0 0 > 0 4 0");
}

TEST(FlatlangTurtle, PartsAreThoseOfTheOrderOfDrawing) {
    const Trail trail =
        drawn("shape s { part p f 1 } f 1 mark m part a f 1 back m l 90 f 1 draw s draw s part a l 90 f 1");
    EXPECT_EQ(segments(trail),
              "0 0 0 > 0 1 0 > 0 2 0 [a]\n0 1 0 > -1 1 0 [a] > -2 1 0 [p] > -3 1 0 [p] > -3 0 0 [a]");
    ASSERT_EQ(trail.parts.size(), 5U);
    EXPECT_EQ(trail.parts[0].name, "");
    EXPECT_EQ(trail.parts[1].name, "a");
    EXPECT_EQ(trail.parts[2].name, "p");
    EXPECT_EQ(trail.parts[3].name, "p");
    EXPECT_EQ(trail.parts[2].place, trail.parts[3].place);
    EXPECT_EQ(trail.segments.back().part, 4);
}

TEST(FlatlangTurtle, APolygonBelongsToThePartInWhichItWasClosed) {
    const Trail trail = drawn(
        "f 1 l 90 part a f 1 l 90 f 1 l 90 f 1 up f 1 l -90 down part b f 1 l 90 f 1 l 90 f 1 l 90 f 1");
    ASSERT_EQ(trail.polygons.size(), 2U);
    EXPECT_EQ(trail.parts[static_cast<std::size_t>(trail.polygons[0].part)].name, "a");
    EXPECT_EQ(trail.parts[static_cast<std::size_t>(trail.polygons[1].part)].name, "b");
}

TEST(FlatlangTurtle, CopiesStopAtTheLimitAndLeaveTheDrawingAsItWas) {
    Turtle turtle(false, 50);
    const Script script(turtle, "shape a { f 1 f 1 f 1 f 1 f 1 f 1 f 1 f 1 f 1 }");
    Outcome outcome = Outcome::done;
    int copies = 0;
    while ((outcome = turtle.draw("a", std::nullopt)) == Outcome::done) ++copies;
    EXPECT_EQ(outcome, Outcome::too_large);
    EXPECT_EQ(turtle.trail().segments.size(), 9U * static_cast<std::size_t>(copies));
    EXPECT_LE(turtle.operations(), 50U);

    Turtle other(false, 12);
    EXPECT_EQ(
        Script(other, "mark a mark b mark a mark b mark a mark b replaceall a b { f 1 f 1 f 1 }").last(),
        Outcome::too_large);
    EXPECT_TRUE(other.trail().segments.empty());
}

TEST(FlatlangTurtle, ShapesThatGrowByThemselvesMeetTheLimit) {
    for (const bool as_2008 : {false, true}) {
        Turtle turtle(as_2008, 10'000);
        const Script script(turtle, "shape a { f 1 }");
        Outcome outcome = Outcome::done;
        for (int i = 0; i < 100 && outcome == Outcome::done; ++i) {
            turtle.begin_shape("b");
            for (int k = 0; k < 10; ++k) turtle.draw("a", std::nullopt);
            turtle.end_shape();
            turtle.begin_shape("a");
            for (int k = 0; k < 10 && outcome == Outcome::done; ++k) outcome = turtle.draw("b", std::nullopt);
            turtle.end_shape();
        }
        EXPECT_EQ(outcome, Outcome::too_large);
    }
}

TEST(FlatlangTurtle, In2008ReplacingWithinMarksOfOneNameIsGivenUp) {
    Turtle turtle(true, 1000);
    EXPECT_EQ(Script(turtle, "mark m f 1 mark m f 1 replaceall m m { f 2 }").last(), Outcome::too_large);
    EXPECT_EQ(Script(turtle, "replace a b { f 2 }").last(), Outcome::no_such_mark);
}

TEST(FlatlangTurtle, TreesAreDescribedAsTheOriginalDid) {
    Turtle turtle(false, plenty);
    const Script script(turtle, "mark a l 10 f 1 back a roll 5 up part p pitch 1 down f 0 back a");
    EXPECT_EQ(turtle.describe(),
              "display list:----------------\n"
              "-- __program_begin --(#)\n"
              "    <<<-- a -->>>(#)\n"
              "        turn(#)\n"
              "            move(#)\n"
              "        roll(#)\n"
              "            up(#)\n"
              "                Part p(#)\n"
              "                    pitch(#)\n"
              "                        down(#)\n"
              "                            ?(#)\n"
              "replacement list:----------------\n"
              "null\n"
              "shape list:----------------\n"
              "<<<-- __shape_turtles -->>>(#)\n");
}

}  // namespace
}  // namespace popup::flatlang
