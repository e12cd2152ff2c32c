// The kit: its boxes fit, its assemblies stand where they should, and it leaves programs alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

#include "support/flatlang_runs.h"
#include "support/random.h"
#include "support/run_program.h"

namespace popup::flatlang {
namespace {

namespace fs = std::filesystem;

constexpr double kPi = std::numbers::pi;

const TrailPolygon* polygon_of(const Trail& trail, const std::string& part, std::size_t which = 0) {
    for (const TrailPolygon& polygon : trail.polygons) {
        if (trail.parts[static_cast<std::size_t>(polygon.part)].name == part && which-- == 0) return &polygon;
    }
    ADD_FAILURE() << "there is no " << part;
    return nullptr;
}

TEST(FlatlangKitAssembly, CoaxialPartsAreStackedByTheirThickness) {
    const ProgramRun run = ran(R"(
        load("kit/all.fl")
        up() forward(2) right(90)
        thick = wheel(0.5) thick.thickness = 0.25 thick.label = "thick"
        coaxial(wheel(2), thick, axle(3), gear(20), coaxial(collar(), wheel(0.7)))
    )");
    const auto height = [&](const char* part, std::size_t which) {
        const TrailPolygon* polygon = polygon_of(run.trail, part, which);
        return polygon != nullptr ? polygon->points.front().z : NAN;
    };
    EXPECT_NEAR(height("wheel", 0), 0.0, 1e-6);
    EXPECT_NEAR(height("thick", 0), 0.1, 1e-6);
    EXPECT_NEAR(height("gear", 0), 0.35, 1e-6);
    EXPECT_NEAR(height("collar", 0), 0.45, 1e-6);
    EXPECT_NEAR(height("wheel", 2), 0.55, 1e-6);
    // The axle stands on the axis, from the bottom.
    const TrailPolygon* strip = polygon_of(run.trail, "axle");
    ASSERT_NE(strip, nullptr);
    for (const Vec3& p : strip->points) {
        EXPECT_NEAR(std::abs(p.z - 1.5), 1.5, 1e-6);
        EXPECT_LT(std::hypot(p.x, p.y - 2), 0.15);
    }
}

TEST(FlatlangKitAssembly, AMeshIsAnArgumentLikeAnyOther) {
    // As in figure 3: the gears lie in one layer, the piston wheel above the second of them, the last wheel
    // above it all, on the first axis.
    const ProgramRun run = ran(R"(
        load("kit/all.fl")
        define parametric_automaton
          (g1_teeth, g2_teeth, offset)
          wheel_1 = wheel()
          wheel_2 = wheel()
          gear_1 = gear(g1_teeth)
          gear_2 = gear(g2_teeth)
          piston = piston_wheel(offset)
          strut = link()
          piston.offcenter_object = strut
          coaxial(wheel_1, mesh(gear_1,
                  coaxial(gear_2, piston_wheel)),
                  wheel_2)
        done
        parametric_automaton(24, 12, 0.6)
    )");
    const auto bore = [&](const char* part, std::size_t which) {
        const TrailPolygon* polygon = polygon_of(run.trail, part, which);
        return polygon != nullptr ? std::pair{middle_of_bore(*polygon), polygon->points.front().z}
                                  : std::pair{Vec2{}, 0.0};
    };
    EXPECT_EQ(run.trail.polygons.size(), 2 + 2 + 2 + 3 + 2U);
    EXPECT_NEAR(bore("wheel", 1).second, 0.0, 1e-6);
    EXPECT_NEAR(bore("gear", 1).second, 0.1, 1e-6);
    EXPECT_NEAR(bore("gear", 3).second, 0.1, 1e-6);
    EXPECT_NEAR(bore("piston wheel", 1).second, 0.2, 1e-6);
    EXPECT_NEAR(bore("wheel", 3).second, 0.3, 1e-6);
    EXPECT_NEAR(bore("wheel", 3).first.y, 0.0, 1e-6);
    EXPECT_NEAR(bore("gear", 3).first.y, 36 / 8.0 / 2, 1e-5);
    EXPECT_NEAR(bore("piston wheel", 1).first.y, 36 / 8.0 / 2, 1e-5);
}

TEST(FlatlangKitAssembly, TrainsMeshFromTheFirstGearToTheLast) {
    const ProgramRun run = ran(R"(
        load("kit/all.fl")
        last = coaxial(gear(31), collar())
        second = coaxial(gear(29), mesh(gear(11), last))
        m = mesh(gear(14), second)
        m.direction = 40
    )");
    // 14 with 29, and in the layer above 11 with 31.
    ASSERT_EQ(run.trail.polygons.size(), 10U);
    const auto outline = [&](std::size_t i) { return flat(run.trail.polygons[i]); };
    EXPECT_LT(overlap(outline(0), outline(2)), 1e-9);
    EXPECT_LT(overlap(outline(4), outline(6)), 1e-9);
    EXPECT_NEAR(run.trail.polygons[2].points.front().z, 0.0, 1e-6);
    EXPECT_NEAR(run.trail.polygons[4].points.front().z, 0.1, 1e-6);
    EXPECT_NEAR(run.trail.polygons[6].points.front().z, 0.1, 1e-6);
    const Vec2 second = middle_of_bore(run.trail.polygons[3]);
    const Vec2 pinion = middle_of_bore(run.trail.polygons[5]);
    const Vec2 last = middle_of_bore(run.trail.polygons[7]);
    EXPECT_NEAR(std::hypot(pinion.x - second.x, pinion.y - second.y), 0.0, 1e-5);
    EXPECT_NEAR(std::hypot(last.x - pinion.x, last.y - pinion.y), 42 / 16.0, 1e-5);
    EXPECT_NEAR(std::atan2(-second.x, second.y), 40 * kPi / 180, 1e-5);
}

TEST(FlatlangKitAssembly, IsDrawnOnceWhereItWasMadeOrWhereDrawIsCalled) {
    const auto count = [](const std::string& text) {
        return ran("load(\"kit/all.fl\")\n" + text).trail.polygons.size();
    };
    EXPECT_EQ(count("coaxial(wheel(), wheel())"), 4U);
    EXPECT_EQ(count("c = coaxial(wheel(), wheel()) c.draw()"), 4U);
    EXPECT_EQ(count("c = coaxial(wheel(), wheel()) coaxial(c, collar())"), 6U);
    EXPECT_EQ(count("p = piston_wheel() p.offcenter_object = coaxial(bearing()) coaxial(p)"), 5U);
    EXPECT_EQ(count("coaxial(wheel()) repeat (3) coaxial(wheel(0.5)) done"), 8U);
    // Where the turtle stood; and the turtle stays where the program left it.
    const ProgramRun run = ran(R"(
        load("kit/all.fl") up() forward(3) coaxial(wheel(0.5)) forward(4) pitch(90)
    )");
    EXPECT_NEAR(middle_of_bore(run.trail.polygons[1]).y, 3.0, 1e-6);
    EXPECT_NEAR(run.trail.last.at.y, 7.0, 1e-6);
    EXPECT_NEAR(run.trail.last.heading.z, 1.0, 1e-6);
}

TEST(FlatlangKitAssembly, ALinkHangsOnTheOffCenterAxleAndPointsAsItWasMade) {
    const ProgramRun run = ran(R"(
        load("kit/all.fl")
        piston = piston_wheel(0.9)
        left(90) strut = link(4) right(90)
        piston.offcenter_object = strut
        coaxial(piston)
    )");
    const TrailPolygon* link = polygon_of(run.trail, "link");
    ASSERT_NE(link, nullptr);
    const auto [low, high] = std::minmax_element(link->points.begin(), link->points.end(),
                                                 [](const Vec3& a, const Vec3& b) { return a.x < b.x; });
    EXPECT_NEAR(low->x, -4.45, 1e-3);
    EXPECT_NEAR(high->x, 0.45, 1e-3);
    EXPECT_NEAR(high->y, 0.9, 0.06);
    EXPECT_NEAR(high->z, 0.1, 1e-6);
    EXPECT_NEAR(middle_of_bore(*polygon_of(run.trail, "piston wheel", 2)).y, 0.9, 1e-6);
}

TEST(FlatlangKitAssembly, ObjectsOfProgramsAreTakenToo) {
    const ProgramRun run = ran(R"(
        load("kit/all.fl")
        define plate() p = object("plate") p.draw = plate_draw p done
        define plate_draw() part("plate") centered_polygon(5, 1) done
        coaxial(wheel(), plate(), plate)
    )");
    ASSERT_EQ(run.trail.polygons.size(), 4U);
    EXPECT_NEAR(run.trail.polygons[3].points.front().z, 0.2, 1e-6);
}

// Every point of the material lies in exactly one of the faces, each as thick as it is.
void expect_box_fits(const std::string& setup, Vec3 size, double thick, std::size_t faces) {
    SCOPED_TRACE(setup);
    const ProgramRun run = ran("load(\"kit/box.fl\")\n" + setup + "\nb.draw()");
    ASSERT_EQ(run.trail.polygons.size(), faces);
    struct Slab {
        int axis;     // across it
        double from;  // along the axis
        Points outline;
    };
    const auto coordinate = [](const Vec3& p, int axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; };
    std::vector<Slab> slabs;
    for (const TrailPolygon& polygon : run.trail.polygons) {
        Slab slab{-1, 0.0, {}};
        for (int axis = 0; axis < 3; ++axis) {
            const double at = coordinate(polygon.points.front(), axis);
            if (std::all_of(polygon.points.begin(), polygon.points.end(),
                            [&](const Vec3& p) { return std::abs(coordinate(p, axis) - at) < 1e-5; })) {
                slab.axis = axis;
                slab.from = at < 1e-5 ? 0.0 : coordinate(size, axis) - thick;
                EXPECT_TRUE(at < 1e-5 || std::abs(at - coordinate(size, axis)) < 1e-5);
            }
        }
        ASSERT_GE(slab.axis, 0);
        for (const Vec3& p : polygon.points) {
            slab.outline.push_back({coordinate(p, (slab.axis + 1) % 3), coordinate(p, (slab.axis + 2) % 3)});
        }
        slabs.push_back(std::move(slab));
    }
    const auto within = [](const Points& outline, double x, double y) {
        bool inside = false;
        for (std::size_t i = 0, j = outline.size() - 1; i < outline.size(); j = i++) {
            if ((outline[i].y > y) != (outline[j].y > y) &&
                x < outline[i].x +
                        (outline[j].x - outline[i].x) * (y - outline[i].y) / (outline[j].y - outline[i].y)) {
                inside = !inside;
            }
        }
        return inside;
    };
    test::Random random(7);
    int seen = 0;
    for (int i = 0; i < 40'000; ++i) {
        const Vec3 p{size.x * random.unit(), size.y * random.unit(), size.z * random.unit()};
        const bool open_above = faces == 5;
        const bool material = p.x < thick || p.x > size.x - thick || p.y < thick || p.y > size.y - thick ||
                              p.z < thick || (!open_above && p.z > size.z - thick);
        int held = 0;
        for (const Slab& slab : slabs) {
            const double depth = coordinate(p, slab.axis) - slab.from;
            held += depth > 0 && depth < thick &&
                            within(slab.outline, coordinate(p, (slab.axis + 1) % 3),
                                   coordinate(p, (slab.axis + 2) % 3))
                        ? 1
                        : 0;
        }
        EXPECT_EQ(held, material ? 1 : 0) << p.x << " " << p.y << " " << p.z;
        seen += material ? 1 : 0;
    }
    EXPECT_GT(seen, 3000);
}

TEST(FlatlangKitBox, FacesFitTabIntoSlot) {
    expect_box_fits("b = box(4, 2, 3, 0.125, 0.4)", {4, 3, 2}, 0.125, 6);
    expect_box_fits("b = box(1, 1.5, 2, 0.25, 0.3)", {1, 2, 1.5}, 0.25, 6);
    expect_box_fits("b = box(5, 0.7, 0.9, 0.2, 9)", {5, 0.9, 0.7}, 0.2, 6);
    expect_box_fits("b = box(3, 2, 2.5, 0.1, 0.25) b.lid = false", {3, 2.5, 2}, 0.1, 5);
}

TEST(FlatlangKitJoints, TabsGoIntoSlots) {
    const auto edge = [](const std::string& call) {
        const ProgramRun run = ran("load(\"kit/joints.fl\")\n" + call);
        Points points{{0, 0}};
        for (const TrailSegment& segment : run.trail.segments) {
            points.push_back({segment.to.x, segment.to.y});
        }
        return points;
    };
    // They go up along x = 0, what is inside on their left: tabs reach to +x, slots to -x.
    const Points tabs = edge("finger_tabs(4, 0.2, 0.5)");
    const Points slots = edge("finger_slots(4, 0.2, 0.5)");
    ASSERT_EQ(tabs.size(), slots.size());
    EXPECT_EQ(tabs.size(), 2U + 4 * 4);
    double widest = 0.0;
    for (std::size_t i = 0; i < tabs.size(); ++i) {
        EXPECT_NEAR(tabs[i].y, slots[i].y, 1e-5);
        EXPECT_NEAR(tabs[i].x, -slots[i].x, 1e-5);
        widest = std::max(widest, tabs[i].x);
    }
    EXPECT_NEAR(widest, 0.2, 1e-5);
    EXPECT_NEAR(tabs.back().y, 4.0, 1e-5);
}

// What the kit needs of the language.
TEST(FlatlangKit, FunctionsOfArgumentsTakeAnyNumberAndTheEndIsCalledOnce) {
    EXPECT_EQ(
        ran("define f(__arguments) print(__arguments.n, __arguments) done f() f(1) f(\"a\", [2], f)").printed,
        "0.0 []\n1.0 [1.0]\n3.0 [a, [2.0], f(__arguments)]\n");
    EXPECT_EQ(ran("x = 1 define __at_end() print(\"end\", x) done x = 2 print(\"text\")").printed,
              "text\nend 2.0\n");
    EXPECT_EQ(
        ran("print(__type(1), __type(\"\"), __type([]), __type(nil), __type(object(\"x\")), __shown(0.1))")
            .printed,
        "number text list nil object 0.1\n");
    Diagnostics diagnostics("test.fl");
    const ProgramRun failed = run_program(
        {"test.fl", "define __at_end() print(\"end\") done\n__fail(\"no\", \"hint\")"}, {}, diagnostics);
    EXPECT_EQ(failed.printed, "");
    EXPECT_EQ(failed.status, RunStatus::runtime_fail);
    EXPECT_EQ(diagnostics.sorted().front().message, "no");
    EXPECT_EQ(diagnostics.sorted().front().place.line, 2);
}

TEST(FlatlangKit, EveryFileCanBeLoadedAlone) {
    for (const std::string_view file : kit_files()) {
        ran("load(\"kit/" + std::string(file) + "\") load(\"kit/" + std::string(file) + "\")");
    }
    // Assemblies that were made before outlive loading.
    EXPECT_EQ(ran("load(\"kit/all.fl\") coaxial(wheel()) load(\"kit/all.fl\") load(\"kit/assembly.fl\")")
                  .trail.polygons.size(),
              2U);
}

TEST(FlatlangKit, LeavesWhatProgramsHoldAlone) {
    const std::string names =
        "i n a b x y z p o g at dir_ plane points sides radius angle count turn name list index element "
        "value "
        "amt teeth pitch bore thickness width height depth length label items low high parts offset inner "
        "outer finger lid made held result skip size text file";
    std::string program = "load(\"kit/all.fl\")\n";
    std::string check;
    std::string word;
    int number = 100;
    std::string expected;
    for (const char c : names + " ") {
        if (c != ' ') {
            word += c;
            continue;
        }
        program += word + " = " + std::to_string(++number) + "\n";
        check += "print(\"" + word + "\", " + word + ")\n";
        expected += word + " " + std::to_string(number) + ".0\n";
        word.clear();
    }
    const std::string use = R"(
        __g = gear(12) __g.draw() __p = piston_wheel() __p.offcenter_object = link() coaxial(__p, axle(), bearing())
        mesh(gear(10), coaxial(gear(12), collar())).draw()
        wheel().draw() link(4).draw() collar().draw() axle().draw() box(3, 3, 3, 0.2, 0.5).draw()
        notch(3, 0.5, 0.2, "X") finger_tabs(3, 0.2, 0.3) finger_slots(3, 0.2, 0.3) centered_polygon(5, 1)
    )";
    const auto printed = [](const ProgramRun& run) {
        std::string kept;
        std::size_t at = 0;
        while (at < run.printed.size()) {
            const std::size_t end = run.printed.find('\n', at) + 1;
            if (!run.printed.substr(at, end - at).starts_with("Beginning a new part")) {
                kept += run.printed.substr(at, end - at);
            }
            at = end;
        }
        return kept;
    };
    EXPECT_EQ(printed(ran(program + use + check)), expected);
    // In a function, and in a method, whose names are members.
    EXPECT_EQ(printed(ran("load(\"kit/all.fl\")\ndefine f()\n" + program.substr(program.find('\n')) + use +
                          check + "done\nf()")),
              expected);
    EXPECT_EQ(printed(ran("load(\"kit/all.fl\")\ndefine f()\n" + program.substr(program.find('\n')) + use +
                          check + "done\nthing = object(\"thing\") thing.f = f thing.f()")),
              expected);
}

TEST(FlatlangKit, TheTurtleComesBackAndItsPenIsUp) {
    for (const char* what :
         {"gear(10).draw()", "wheel().draw()", "piston_wheel().draw()", "link().draw()", "collar().draw()",
          "axle().draw()", "bearing().draw()", "centered_polygon(7, 1)", "box(2, 2, 2, 0.1, 0.3).draw()",
          "coaxial(wheel(), gear(20)).draw()", "mesh(gear(9), gear(20)).draw()", "coaxial(wheel())"}) {
        SCOPED_TRACE(what);
        const std::string before = "load(\"kit/all.fl\") up() forward(2) left(30) pitch(20) roll(10)\n";
        const Pose expected = ran(before).trail.last;
        const ProgramRun run = ran(before + what);
        const std::size_t segments = run.trail.segments.size();
        EXPECT_GT(segments, 0U);
        const Pose last = run.trail.last;
        for (const auto& [a, b] : std::vector<std::pair<Vec3, Vec3>>{
                 {expected.at, last.at}, {expected.heading, last.heading}, {expected.up, last.up}}) {
            EXPECT_NEAR(a.x, b.x, 1e-6);
            EXPECT_NEAR(a.y, b.y, 1e-6);
            EXPECT_NEAR(a.z, b.z, 1e-6);
        }
        EXPECT_EQ(ran(before + what + std::string(" forward(3)")).trail.segments.size(), segments);
    }
}

TEST(FlatlangKit, MistakesAreToldAtTheCallThatMadeThem) {
    EXPECT_EQ(trouble("x = 1\ng = gear(3)"),
              "3: the number of teeth of a gear is 3; it lies between 6 and 1000");
    EXPECT_EQ(trouble("g = gear(\"many\")"), "2: the number of teeth of a gear is a number, not many");
    EXPECT_EQ(trouble("gear(10.5).draw()"), "2: a gear has a whole number of teeth, not 10.5");
    EXPECT_EQ(trouble("gear(10, 8, 3)"), "2: gear(teeth, pitch) is given 3 arguments");
    EXPECT_EQ(trouble("g = gear(10)\ng.profile = \"round\"\ng.draw()"),
              "4: the profile of a gear is involute or trapezoid, not round");
    EXPECT_EQ(trouble("mesh(gear(10))"), "2: mesh() puts together at least 2 and is given 1");
    EXPECT_EQ(trouble("coaxial(3)"), "2: coaxial() puts parts together, and this is none: 3");
    EXPECT_EQ(trouble("m = mesh(gear(10), wheel())\nm.draw()"),
              "3: mesh() is given a part without a gear on its axis");
    EXPECT_EQ(trouble("m = mesh(gear(10, 8), gear(10, 6))\nm.draw()").substr(0, 67),
              "3: gears that mesh have the same pitch and pressure angle; here the");
    // What is drawn when the program ends is told where it was put together.
    EXPECT_EQ(trouble("x = 0\ng = gear(10)\ncoaxial(g)\ng.bore = 4"),
              "4: the bore of a gear is 4; it lies between 0 and 0.65625");
    EXPECT_EQ(trouble("p = piston_wheel()\np.offcenter_object = coaxial(p)"),
              "3: a part stands in an assembly, or hangs on a wheel, that is part of itself");
    EXPECT_EQ(trouble("g = gear(6, 64)\ng.pressure_angle = 30 g.bore = 0\ng.draw()"),
              "4: the teeth of this gear would end in points");
    EXPECT_EQ(trouble("p = piston_wheel(0.1)\np.draw()").substr(0, 43),
              "3: the two holes of a piston wheel meet: it");
    EXPECT_EQ(trouble("box(0.1, 2, 2, 0.2, 0.3).draw()").substr(0, 33), "2: the width of a box is 0.1; it ");
    EXPECT_EQ(trouble("w = wheel()\nw.tolerance = 0\nw.draw()"),
              "4: the tolerance of a part is 0; it lies between 0.0001 and 0.1");
    EXPECT_EQ(trouble("w = wheel()\nw.thickness = \"1\"\ncoaxial(w)"),
              "4: the thickness of a part is a number, not 1");
    EXPECT_EQ(trouble("gear(0 / 0)").substr(0, 34), "2: the number of teeth of a gear i");
    EXPECT_EQ(trouble("link(0.1).draw()").substr(0, 30), "2: the length of a link is 0.1");
}

std::vector<std::string> sample_names() {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(fs::path(POPUP_SOURCE_DIR) / "samples/flatlang")) {
        if (entry.path().extension() == ".fl") names.push_back(entry.path().stem());
    }
    std::sort(names.begin(), names.end());
    return names;
}

class FlatlangSample : public testing::TestWithParam<std::string> {};

TEST_P(FlatlangSample, BuildsWithNothingDoubtfulTheSameTwice) {
    const fs::path program = fs::path(POPUP_SOURCE_DIR) / "samples/flatlang" / (GetParam() + ".fl");
    const test::ScratchDirectory out;
    const test::RunResult checked = test::popupc({"check", program});
    EXPECT_EQ(checked.exit, 0) << checked.err;
    std::string first;
    for (const std::string run : {"1", "2"}) {
        // Processors without FMA round their sines otherwise.
        test::RunOptions options;
        if (run == "2")
            options.environment["GLIBC_TUNABLES"] = "glibc.cpu.hwcaps=-FMA,-AVX2_Usable,-FMA4,-AVX2";
        const test::RunResult result =
            test::popupc({"build", program, "-j", run, "--nest-effort", "0.1", "-o", out / "a.svg", "-o",
                          out / "a.dxf", "-o", out / "a.glb"},
                         options);
        ASSERT_EQ(result.exit, 0) << result.err;
        EXPECT_EQ(result.err.find("warning"), std::string::npos) << result.err;
        std::string all;
        for (const char* file : {"a.svg", "a.dxf", "a.glb"}) {
            const std::string bytes = test::read_file(out / file);
            EXPECT_GT(bytes.size(), 1000U) << file;
            all += bytes;
        }
        if (first.empty()) first = all;
        EXPECT_TRUE(first == all);
    }
    const test::RunResult measured =
        test::run({std::string(POPUP_TOOLS_DIR) + "/glb_view", "measure", out / "a.glb"});
    EXPECT_EQ(measured.exit, 0) << measured.out << measured.err;
}

INSTANTIATE_TEST_SUITE_P(Shipped, FlatlangSample, testing::ValuesIn(sample_names()), [](const auto& info) {
    std::string name = info.param;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
});

}  // namespace
}  // namespace popup::flatlang
