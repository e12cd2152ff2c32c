// What an examination with a memory promises: findings of a changed design are those that an examination of
// all of it has, and little of it is looked at.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>
#include <variant>

#include "output/xml.h"
#include "popup/compile.h"
#include "support/designs.h"
#include "support/proposals.h"
#include "support/sanitized.h"

namespace popup {
namespace {

std::string numbers(const Contact& one) {
    return fmt::format("contact {} {} {} {} depth {} at {} excess {} of {} ({} {} {}) ({} {})\n", one.a,
                       one.b, one.from_deg, one.to_deg, one.depth_mm, one.deepest_deg, one.excess_mm,
                       one.longer, one.point.x, one.point.y, one.point.z, one.corner.x, one.corner.y);
}

// All that was found, in full digits; empty: nothing was examined.
std::string found(const Compilation& run) {
    const CompiledDesign& one = run.designs.front();
    std::string text = test::findings(one.diagnostics);
    if (!one.motion || !one.motion->examination) return text;
    const Examination& all = *one.motion->examination;
    text += fmt::format("open {} mm, off {}°\n", one.motion->max_closure_mm, one.motion->flat_error_deg);
    text += fmt::format("up to {}, {} pairs\n", all.decided_up_to_deg, all.pairs > 0);
    for (const Contact& contact : all.contacts) text += numbers(contact);
    for (const Undecided& two : all.undecided)
        text += fmt::format("undecided {} {} {} {}\n", two.a, two.b, two.from_deg, two.to_deg);
    if (all.approaches) {
        for (const Approach& two : *all.approaches)
            text += fmt::format("near {} {} {} {} {} {} ({} {} {})\n", two.a, two.b, two.from_deg, two.to_deg,
                                two.least_mm, two.least_deg, two.point.x, two.point.y, two.point.z);
    }
    for (const Protrusion& out : all.closed.protrusions)
        text += fmt::format("out {} {} {} {}\n", out.plate, out.by_mm, out.point.y, out.point.z);
    text += fmt::format("{} layers\n", all.closed.max_layers);
    if (all.closed.order) {
        for (const int plate : *all.closed.order) text += fmt::format("{} ", plate);
    }
    for (const int plate : all.closed.cycle) text += fmt::format("cycle {} ", plate);
    return text;
}

Compilation compiled(const Design& design, const MotionOptions& motion) {
    CompileOptions options;
    options.until = Stage::motion;
    options.motion = motion;
    return compile({{"card.xml", write_document(design)}}, options, {});
}

// Moves, shapes, takes out and copies something of a design, as a person who types does.
void change(Design& design, test::Dice& random) {
    if (design.structures.empty()) return;
    Structure& one = design.structures[random.below(design.structures.size())];
    switch (random.below(7)) {
        case 0: {
            // Along the gutter, all of it.
            const double by = random.uniform(-15.0, 15.0);
            for (DesignPoint& point : one.points) {
                if (point.page.value_or(one.fold.page) == 0) point.at.y += by;
            }
            break;
        }
        case 1:
        case 2: {
            if (one.points.empty()) break;
            DesignPoint& point = one.points[random.below(one.points.size())];
            point.at = point.at + Vec2{random.uniform(-4.0, 4.0), random.uniform(-4.0, 4.0)};
            break;
        }
        case 3:
            design.structures.pop_back();
            break;
        case 4:
            design.structures.push_back(one);
            design.structures.back().id_given = false;
            break;
        case 5:
            design.height_mm += random.uniform(-3.0, 3.0);
            break;
        default:
            design.left = Color{1, 2, 3};  // nothing moves
            break;
    }
}

Design crowded(test::Dice& random, int elements) {
    Design design = test::card(240, 300);
    for (int i = 0; i < elements; ++i) {
        const double at = random.uniform(-120.0, 120.0);
        const double half = random.uniform(8.0, 22.0);
        const double out = random.uniform(12.0, 32.0);
        const double wide = out + random.uniform(0.0, 10.0);
        test::add_tent(design, at, half, out, wide);
    }
    return design;
}

TEST(ExaminationMemory, FindsWhatAnExaminationOfEverythingFinds) {
    const auto seeds = test::sanitized_count<std::uint64_t>(8, 4);
    std::size_t compared = 0;
    std::size_t remembered = 0;
    std::size_t with_contacts = 0;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        test::Dice random{seed * 191};
        Design design = seed % 3 == 0   ? crowded(random, 4)
                        : seed % 3 == 1 ? test::generate_any(seed, 6)
                                        : test::generate(seed, 7);
        ExaminationMemory memory;
        MotionOptions with;
        if (seed % 4 == 0) with.clearance_mm = 1.5;
        MotionOptions without = with;
        with.memory = &memory;
        for (int step = 0; step < 6; ++step) {
            SCOPED_TRACE(fmt::format("seed {} step {}", seed, step));
            const Compilation fresh = compiled(design, without);
            const Compilation again = compiled(design, with);
            ASSERT_EQ(found(again), found(fresh)) << write_document(design);
            const auto& motion = fresh.designs.front().motion;
            if (motion && motion->examination) {
                ++compared;
                const auto& share = memory.share();
                remembered += share.examined_pairs < share.pairs ? 1 : 0;
                with_contacts += motion->examination->contacts.empty() ? 0 : 1;
                EXPECT_LE(share.examined_pairs, share.pairs);
            }
            const Design was = design;
            change(design, random);
            // What cannot be built any more has nothing to remember.
            MotionOptions unexamined;
            unexamined.examine = false;
            if (!compiled(design, unexamined).has_errors()) continue;
            ASSERT_EQ(found(compiled(design, with)), found(compiled(design, without)));
            design = was;
        }
    }
    EXPECT_GT(compared, 4 * seeds);
    EXPECT_GT(remembered, 2 * seeds);
    EXPECT_GT(with_contacts, seeds / 2);
}

std::string passed(const Assembly& assembly, const MotionOptions& options) {
    Diagnostics diagnostics;
    const auto motion = simulate(assembly, options, diagnostics);
    return test::findings(diagnostics) +
           (motion ? fmt::format("open {} mm, off {}°", motion->max_closure_mm, motion->flat_error_deg) : "");
}

// Bends a linkage or a hinge by a little or by much.
void bend(Assembly& assembly, test::Dice& random) {
    const double by = random.below(2) == 0 ? random.uniform(-1e-6, 1e-6) : random.uniform(-0.4, 0.4);
    if (random.below(3) == 0) {
        Hinge& hinge = assembly.hinges[random.below(assembly.hinges.size())];
        hinge.a_line.a.x += by;
        return;
    }
    Joint& joint = assembly.joints[random.below(assembly.joints.size())];
    FourBar* bars = std::get_if<FourBar>(&joint.how);
    if (bars == nullptr) return;
    if (random.below(2) == 0) {
        // Both sides, so that it still closes: a piece that is too narrow holds the card.
        const double less = random.uniform(0.0, bars->parallel ? 40.0 : 1.2);
        for (Bar* bar : {&bars->left, &bars->right}) bar->far = std::max(0.01, bar->far - less);
        return;
    }
    Bar& bar = random.below(2) == 0 ? bars->left : bars->right;
    (random.below(2) == 0 ? bar.near : bar.far) += by * (bars->parallel ? 10.0 : 1.0);
}

// What does not get through the whole way is told as without a memory, and what was known before stays known.
TEST(ExaminationMemory, FindsWhatDoesNotPassTheWholeWay) {
    const auto seeds = test::sanitized_count<std::uint64_t>(6, 2);
    std::map<std::string, int> codes;
    int remembered = 0;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        test::Dice random{seed * 977};
        const auto built = test::build(test::generate(seed, 9));
        ASSERT_TRUE(built.assembly.has_value());
        ExaminationMemory memory;
        MotionOptions with;
        with.memory = &memory;
        if (seed % 3 == 0) with.angles = {Angle::degrees(0), Angle::degrees(62.5), Angle::degrees(77)};
        MotionOptions without = with;
        without.memory = nullptr;
        Assembly now = *built.assembly;
        for (int step = 0; step < 10; ++step) {
            SCOPED_TRACE(fmt::format("seed {} step {}", seed, step));
            if (step == 7) with.tolerances.closure_mm = without.tolerances.closure_mm = 1e-14;
            if (step == 8) with.tolerances = without.tolerances = {};
            const std::string found = passed(now, without);
            ASSERT_EQ(passed(now, with), found);
            const bool is_error = found.find("error ") != std::string::npos;
            const bool little = memory.share().changed_plates < memory.share().plates;
            remembered += !is_error && little ? 1 : 0;
            for (const char* code : {"locks", "seam-open"})
                codes[code] += found.find(code) != std::string::npos ? 1 : 0;
            if (is_error) now = *built.assembly;
            bend(now, random);
        }
    }
    EXPECT_GT(codes["locks"], 0);
    EXPECT_GT(codes["seam-open"], 0);
    EXPECT_GT(remembered, static_cast<int>(seeds));
}

// One element of many changes: less than a twentieth of all pairs is looked at again.
TEST(ExaminationMemory, LooksAtLittle) {
    Design design = test::row(200);
    ExaminationMemory memory;
    MotionOptions with;
    with.memory = &memory;
    compiled(design, with);
    EXPECT_EQ(memory.share().examined_pairs, memory.share().pairs);
    const std::size_t pairs = memory.share().pairs;
    for (DesignPoint& point : design.structures[100].points) point.at.y += 0.5;
    compiled(design, with);
    EXPECT_NEAR(static_cast<double>(memory.share().pairs), static_cast<double>(pairs), 20.0);
    EXPECT_LT(20 * memory.share().examined_pairs, memory.share().pairs);
    EXPECT_LT(20 * memory.share().examined_layers, memory.share().layers);
    EXPECT_GT(memory.share().examined_pairs, 0U);
    compiled(design, with);
    EXPECT_EQ(memory.share().examined_pairs, 0U);
    EXPECT_EQ(memory.share().changed_plates, 0U);
    // Another question is another examination.
    with.clearance_mm = 2.0;
    compiled(design, with);
    EXPECT_EQ(memory.share().examined_pairs, memory.share().pairs);
}

}  // namespace
}  // namespace popup
