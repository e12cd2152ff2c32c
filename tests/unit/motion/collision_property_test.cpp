// What must hold of any design: properties of the motion, and collisions that agree with brute force.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <random>
#include <set>
#include <string>
#include <tuple>

#include "motion/plate_shape.h"
#include "popup/check.h"
#include "popup/crease_pattern.h"
#include "popup/files.h"
#include "popup/motion.h"
#include "support/brute_force.h"
#include "support/designs.h"
#include "support/sanitized.h"

namespace popup::test {
namespace {

namespace fs = std::filesystem;
using PlatePair = std::pair<int, int>;

const int kDesigns = test::sanitized_count(200);
constexpr int kLongDesigns = 3000;
constexpr double kEndDeg = 0.02;         // so near the end of a contact either answer will do
constexpr double kSlackMm = 2e-5;        // the same, for contacts that end slowly
constexpr double kInsideSlackMm = 2e-4;  // the same, for how far inside both plates common points lie
constexpr double kUndecided = 1e-3;      // the most of all crossings that may be undecided
constexpr double kCutShort = 4e-3;       // the most of all designs that may be cut short
constexpr std::size_t kTold = 3;         // failures of one design that are told
constexpr int kLooks = 1024;             // at most, for the plates to cross in a contact
constexpr std::size_t kRandomly = 40;    // angles looked at where they are random

Design generated(int seed) { return generate(static_cast<std::uint64_t>(seed), 2 + seed % 13); }

// Opening angles, the same on every machine: both ends, and some in between.
std::vector<double> random_angles(int seed) {
    std::mt19937 random(static_cast<unsigned>(seed));
    std::vector<double> angles{0.0, 180.0};
    while (angles.size() < kRandomly) angles.push_back(180.0 * static_cast<double>(random()) * 0x1p-32);
    return angles;
}

std::vector<Frame> frames_at(const Assembly& assembly, double deg) {
    std::vector<Frame> frames(assembly.plates.size());
    EXPECT_TRUE(place(assembly, Angle::degrees(deg), frames)) << deg;
    return frames;
}

// Calls back with every corner of every plate, holes included.
template <typename Use>
void each_corner(const Assembly& assembly, const Use& use) {
    for (std::size_t i = 0; i < assembly.plates.size(); ++i) {
        const Polygon& outline = assembly.plates[i].outline;
        for (const Vec2 p : outline.outer) use(i, p);
        for (const Ring& hole : outline.holes) {
            for (const Vec2 p : hole) use(i, p);
        }
    }
}

// ---- Motion ----

TEST(MotionOfAnyDesign, HingesStayClosed) {
    for (int seed = 1; seed <= kDesigns; ++seed) {
        const Built built = build(generated(seed));
        ASSERT_TRUE(built.assembly) << seed;
        for (const double deg : random_angles(seed)) {
            const auto frames = frames_at(*built.assembly, deg);
            ASSERT_LE(closure_error(*built.assembly, frames), 1e-6) << "seed " << seed << " at " << deg;
        }
    }
}

TEST(MotionOfAnyDesign, PlatesAreRigid) {
    for (int seed = 1; seed <= kDesigns; ++seed) {
        const Built built = build(generated(seed));
        ASSERT_TRUE(built.assembly) << seed;
        for (const double deg : random_angles(seed)) {
            const auto frames = frames_at(*built.assembly, deg);
            each_corner(*built.assembly, [&](std::size_t i, Vec2 p) {
                for (const Vec2 q : built.assembly->plates[i].outline.outer) {
                    const double moved = distance(frames[i].point(p), frames[i].point(q));
                    ASSERT_NEAR(moved, distance(p, q), 1e-9)
                        << "seed " << seed << ", " << built.assembly->plates[i].name << " at " << deg;
                }
            });
            if (HasFatalFailure()) return;
        }
    }
}

TEST(MotionOfAnyDesign, ClosedCardIsFlat) {
    for (int seed = 1; seed <= kDesigns; ++seed) {
        const Built built = build(generated(seed));
        ASSERT_TRUE(built.assembly) << seed;
        const auto frames = frames_at(*built.assembly, 0.0);
        each_corner(*built.assembly, [&](std::size_t i, Vec2 p) {
            ASSERT_NEAR(frames[i].point(p).x, 0.0, 1e-6)
                << "seed " << seed << ", " << built.assembly->plates[i].name;
        });
        if (HasFatalFailure()) return;
    }
}

// The furthest that any corner moves from one pose to another.
double largest_move(const Assembly& assembly, const std::vector<Frame>& before,
                    const std::vector<Frame>& after) {
    double most = 0.0;
    each_corner(assembly, [&](std::size_t i, Vec2 p) {
        most = std::max(most, distance(before[i].point(p), after[i].point(p)));
    });
    return most;
}

// How far corners move in `width` degrees where they are fastest, or jump, between two angles: these are
// halved again and again, each time into the half in which more happens.
double fastest_move(const Assembly& assembly, double from, double to, double width) {
    auto low = frames_at(assembly, from);
    auto high = frames_at(assembly, to);
    while (to - from > width) {
        const double middle = 0.5 * (from + to);
        auto between = frames_at(assembly, middle);
        if (largest_move(assembly, low, between) > largest_move(assembly, between, high)) {
            to = middle;
            high = std::move(between);
        } else {
            from = middle;
            low = std::move(between);
        }
    }
    return largest_move(assembly, low, high);
}

// A card's edge, 140 mm from the gutter, moves by 0.12 mm in 0.1° and by 0.00012 mm in 0.0001°; each element
// that stands on another may multiply that. So 1 mm, then 0.05 mm, are far more than any but a linkage near
// where it locks. Its angle goes there as the square root of the way: in a 4096th of the step it moves by a
// 64th, where a jump to its mirror image stays as large.
TEST(MotionOfAnyDesign, PlatesDoNotJump) {
    for (int seed = 1; seed <= kDesigns; ++seed) {
        const Built built = build(generated(seed));
        ASSERT_TRUE(built.assembly) << seed;
        auto before = frames_at(*built.assembly, 0.0);
        for (int i = 0; i < 1800; ++i) {
            const double from = 180.0 * i / 1800;
            const double to = 180.0 * (i + 1) / 1800;
            auto after = frames_at(*built.assembly, to);
            if (largest_move(*built.assembly, before, after) > 1.0 &&
                fastest_move(*built.assembly, from, to, 1e-4) > 0.05) {
                ASSERT_LE(fastest_move(*built.assembly, from, to, 1e-4 / 4096), 0.05)
                    << "seed " << seed << " from " << from << " to " << to;
            }
            before = std::move(after);
        }
    }
}

// ---- Mirror images ----

// Which point of a structure becomes which in its mirror image: left and right exchanged.
const std::vector<std::size_t>& mirror_partners(const std::string& type) {
    static const std::vector<std::size_t> v_fold{2, 1, 0, 5, 4, 3, 7, 6};
    static const std::vector<std::size_t> tent{2, 3, 0, 1, 6, 7, 4, 5};
    static const std::vector<std::size_t> beak{0, 2, 1};
    static const std::vector<std::size_t> step{2, 3, 0, 1};
    if (type.ends_with("v-fold")) return v_fold;
    if (type.ends_with("tent")) return tent;
    return type.ends_with("beak") ? beak : step;
}

Design mirrored(const Design& design) {
    const auto flip = [](Vec2& p) { p.x = -p.x; };
    Design result = design;
    for (std::size_t i = 0; i < design.structures.size(); ++i) {
        const auto& points = design.structures[i].points;
        Structure& image = result.structures[i];
        const auto& partners = mirror_partners(image.type);
        EXPECT_EQ(partners.size(), points.size()) << image.type;
        for (std::size_t k = 0; k < points.size(); ++k) {
            image.points[k] = points[partners[k]];
            flip(image.points[k].at);
        }
        flip(image.fold.begin.at);
        flip(image.fold.end.at);
    }
    return result;
}

// The plate of the mirror image of each plate: "e1/left" is "e1/right" there.
std::vector<int> mirror_plates(const Assembly& assembly, const Assembly& image) {
    std::map<std::string, int> numbers;
    for (std::size_t i = 0; i < image.plates.size(); ++i) numbers[image.plates[i].name] = static_cast<int>(i);
    std::vector<int> result;
    for (const Plate& plate : assembly.plates) {
        const std::string owner = plate.name.substr(0, plate.name.rfind('/'));
        const bool left = plate.name.ends_with("/left");
        const auto found = numbers.find(owner + (left ? "/right" : "/left"));
        EXPECT_NE(found, numbers.end()) << plate.name;
        result.push_back(found == numbers.end() ? 0 : found->second);
    }
    return result;
}

struct MirrorCase {
    Built built, image;
    std::vector<int> plates;
};

MirrorCase mirror_case(int seed) {
    MirrorCase made;
    const Design design = generated(seed);
    made.built = build(design);
    made.image = build(mirrored(design));
    EXPECT_FALSE(made.image.diagnostics.has_findings()) << seed << "\n" << findings(made.image.diagnostics);
    made.plates = mirror_plates(*made.built.assembly, *made.image.assembly);
    return made;
}

TEST(MirroredDesign, MovesMirrored) {
    for (int seed = 1; seed <= kDesigns; ++seed) {
        const MirrorCase made = mirror_case(seed);
        if (HasFailure()) return;
        for (const double deg : random_angles(seed)) {
            const auto frames = frames_at(*made.built.assembly, deg);
            const auto images = frames_at(*made.image.assembly, deg);
            each_corner(*made.built.assembly, [&](std::size_t i, Vec2 p) {
                const Vec3 at = frames[i].point(p);
                const Vec3 image = images[static_cast<std::size_t>(made.plates[i])].point({-p.x, p.y});
                ASSERT_LE(distance(Vec3{-at.x, at.y, at.z}, image), 1e-6)
                    << "seed " << seed << ", " << made.built.assembly->plates[i].name << " at " << deg;
            });
            if (HasFatalFailure()) return;
        }
    }
}

TEST(MirroredDesign, HasMirroredContacts) {
    std::size_t contacts = 0;
    for (int seed = 1; seed <= kDesigns / 2; ++seed) {
        SCOPED_TRACE(fmt::format("seed {}", seed));
        const MirrorCase made = mirror_case(seed);
        if (HasFailure()) return;
        std::vector<Contact> expected = examine(*made.built.assembly, {}).contacts;
        const std::vector<Contact> found = examine(*made.image.assembly, {}).contacts;
        for (Contact& one : expected) {
            const int a = made.plates[static_cast<std::size_t>(one.a)];
            const int b = made.plates[static_cast<std::size_t>(one.b)];
            std::tie(one.a, one.b) = std::minmax(a, b);
        }
        std::sort(expected.begin(), expected.end(), [](const Contact& one, const Contact& other) {
            return std::tie(one.a, one.b, one.from_deg) < std::tie(other.a, other.b, other.from_deg);
        });
        ASSERT_EQ(found.size(), expected.size());
        for (std::size_t i = 0; i < found.size(); ++i) {
            const std::string names =
                made.image.assembly->plates[static_cast<std::size_t>(expected[i].a)].name + " and " +
                made.image.assembly->plates[static_cast<std::size_t>(expected[i].b)].name;
            ASSERT_EQ(PlatePair(found[i].a, found[i].b), PlatePair(expected[i].a, expected[i].b)) << names;
            EXPECT_NEAR(found[i].from_deg, expected[i].from_deg, 0.005) << names;
            EXPECT_NEAR(found[i].to_deg, expected[i].to_deg, 0.005) << names;
            EXPECT_NEAR(found[i].depth_mm, expected[i].depth_mm, 0.01) << names;
        }
        contacts += found.size();
    }
    EXPECT_GE(contacts, 3U * static_cast<std::size_t>(kDesigns / 2));
}

// ---- Brute force ----

struct Tally {
    std::size_t crossings = 0;  // pairs that cross by one of the two at least, over all angles
    std::size_t undecided = 0;  // of these, those that examine() leaves undecided
    int cut_short = 0;          // designs for which its work was spent before the last opening; it says so
};

// One design's plates in both eyes.
class Comparison {
 public:
    Comparison(std::string name, const Assembly& assembly, Tally& tally)
        : name_(std::move(name)),
          assembly_(assembly),
          tally_(tally),
          found_(examine(assembly, {})),
          brute_(assembly) {
        for (const Contact& one : found_.contacts) {
            if (one.at_fold) {
                at_folds_.push_back(one);
            } else {
                contacts_[{one.a, one.b}].push_back(one);
            }
        }
        for (const Undecided& one : found_.undecided) undecided_[{one.a, one.b}].push_back(one);
        if (found_.decided_up_to_deg < assembly.sweep.to_deg) ++tally.cut_short;
    }

    // At steps over the whole opening, and at both sides of every end of a contact.
    void at_every(double step) {
        std::vector<double> angles;
        const int steps = static_cast<int>(std::lround(180.0 / step));
        for (int i = 1; i < steps; ++i) angles.push_back(i * 180.0 / steps);
        for (const Contact& one : found_.contacts) {
            for (const double end : {one.from_deg, one.to_deg}) {
                angles.push_back(end - kEndDeg);
                angles.push_back(end + kEndDeg);
            }
        }
        std::erase_if(angles, [this](double deg) { return !looked_at(deg); });
        std::sort(angles.begin(), angles.end());
        angles.erase(std::unique(angles.begin(), angles.end()), angles.end());
        for (const double deg : angles) at(deg);
        for (const auto& [pair, contacts] : contacts_) {
            for (const Contact& one : contacts) is_contact(pair, one);
        }
        through_folds();
    }

 private:
    // Moved a little to one side, what goes through a fold crosses one of its two plates, and moved to the
    // other side the other; so does nothing that only lies on the fold.
    void through_folds() {
        std::map<std::tuple<int, double, double>, std::set<int>> sides;
        for (const Contact& one : at_folds_) {
            const double deg = 0.5 * (one.from_deg + one.to_deg);
            const Vec3 normal = frames_at(assembly_, deg)[static_cast<std::size_t>(one.longer)].normal();
            std::set<int>& seen = sides[{one.longer, one.from_deg, one.to_deg}];
            for (const int side : {1, -1}) {
                const double by = 0.1 * side * (one.longer == one.b ? 1.0 : -1.0);
                if (brute_.meet_when_moved(one.a, one.b, deg, by * normal, true)) seen.insert(side);
            }
        }
        for (const auto& [which, seen] : sides) {
            EXPECT_EQ(seen.size(), 2U) << name_ << ": plate " << std::get<0>(which) << " at its fold from "
                                       << std::get<1>(which) << "° to " << std::get<2>(which) << "°";
        }
    }

    [[nodiscard]] bool looked_at(double deg) const {
        return deg > found_.undecided_below_deg && deg < found_.decided_up_to_deg;
    }

    template <typename Kind>
    static bool holds(const std::map<PlatePair, std::vector<Kind>>& all, PlatePair pair, double deg) {
        const auto of_pair = all.find(pair);
        return of_pair != all.end() &&
               std::any_of(of_pair->second.begin(), of_pair->second.end(),
                           [deg](const Kind& one) { return one.from_deg <= deg && deg <= one.to_deg; });
    }
    [[nodiscard]] bool near_end(PlatePair pair, double deg) const {
        const auto of_pair = contacts_.find(pair);
        const auto near = [deg](double end) { return std::abs(deg - end) < kEndDeg - 1e-9; };
        return of_pair != contacts_.end() &&
               std::any_of(of_pair->second.begin(), of_pair->second.end(),
                           [&](const Contact& one) { return near(one.from_deg) || near(one.to_deg); });
    }

    // What crosses is reported, and what is reported has not come out of each other.
    void at(double deg) {
        std::set<PlatePair> crossing;
        for (const BruteContact& one : brute_.crossing_at(deg)) crossing.insert({one.a, one.b});
        std::set<PlatePair> pairs = crossing;
        for (const auto& [pair, contacts] : contacts_) {
            if (holds(contacts_, pair, deg)) pairs.insert(pair);
        }
        for (const PlatePair& pair : pairs) {
            ++tally_.crossings;
            if (holds(undecided_, pair, deg)) {
                ++tally_.undecided;
                continue;
            }
            const bool reported = holds(contacts_, pair, deg);
            if (reported == (crossing.count(pair) > 0) || near_end(pair, deg)) continue;
            const double through = brute_.through(pair.first, pair.second, deg);
            const double inside = through / sine_between(pair, deg);
            if (!reported && through > kThroughMm + kSlackMm && inside > kInsideMm + kInsideSlackMm) {
                differs(pair, deg, "examine() has no contact here");
            } else if (reported && through < end_mm(deg) - kSlackMm * std::min(deg, 1.0)) {
                differs(pair, deg, "examine() has a contact here");
            }
        }
    }

    [[nodiscard]] double sine_between(PlatePair pair, double deg) const {
        const auto frames = frames_at(assembly_, deg);
        return length(cross(frames[static_cast<std::size_t>(pair.first)].normal(),
                            frames[static_cast<std::size_t>(pair.second)].normal()));
    }

    // The plates do cross somewhere in it, and are clear on both sides of it. Contacts as short as the margin
    // at their ends are let pass; so may be the moment in which plates go through each other face to face.
    void is_contact(PlatePair pair, const Contact& one) {
        if (one.to_deg - one.from_deg < 2.0 * kEndDeg) return;
        const auto crosses = [&](double deg) { return brute_.crosses(pair.first, pair.second, deg); };
        bool somewhere = crosses(one.deepest_deg);
        for (int i = 1; i < kLooks && !somewhere; ++i) {
            somewhere = crosses(one.from_deg + i * (one.to_deg - one.from_deg) / kLooks);
        }
        if (!somewhere) differs(pair, one.deepest_deg, "nowhere in the contact that examine() has here");
        for (const auto& [end, way] : {std::pair{one.from_deg, -kEndDeg}, std::pair{one.to_deg, kEndDeg}}) {
            const double deg = end + way;
            if (end == 0.0 || !looked_at(deg) || near_end(pair, deg) || holds(contacts_, pair, deg) ||
                holds(undecided_, pair, deg))
                continue;
            if (brute_.through(pair.first, pair.second, deg) > end_mm(deg) + kSlackMm * std::min(deg, 1.0)) {
                differs(pair, deg, "the contact that examine() has ended goes on");
            }
        }
    }

    void differs(PlatePair pair, double deg, const std::string& how) {
        if (++told_ > kTold) return;
        const auto name = [this](int plate) {
            return assembly_.plates[static_cast<std::size_t>(plate)].name;
        };
        std::string what = fmt::format(
            "{}: {} and {} at {:.4f}°: {}; by brute force they are {:.6f} mm through each other", name_,
            name(pair.first), name(pair.second), deg, how, brute_.through(pair.first, pair.second, deg));
        if (const auto around = brute_.contact_around(pair.first, pair.second, deg)) {
            what += fmt::format(", from {:.4f}° to {:.4f}°", around->first, around->second);
        }
        for (const Contact& one : contacts_[pair]) {
            what += fmt::format("; reported from {:.3f}° to {:.3f}°", one.from_deg, one.to_deg);
        }
        ADD_FAILURE() << what;
    }

    std::string name_;
    const Assembly& assembly_;
    Tally& tally_;
    Examination found_;
    BruteForce brute_;
    std::map<PlatePair, std::vector<Contact>> contacts_;  // but for those at folds
    std::vector<Contact> at_folds_;
    std::map<PlatePair, std::vector<Undecided>> undecided_;
    std::size_t told_ = 0;
};

void compare_generated(int designs, double step) {
    Tally tally;
    for (int seed = 1; seed <= designs; ++seed) {
        const Built built = build(generated(seed));
        ASSERT_TRUE(built.assembly) << seed;
        Comparison(fmt::format("seed {}", seed), *built.assembly, tally).at_every(step);
    }
    EXPECT_GT(tally.crossings, 900U * static_cast<std::size_t>(designs)) << "there must be much to find";
    EXPECT_LE(static_cast<double>(tally.undecided), kUndecided * static_cast<double>(tally.crossings));
    EXPECT_LE(tally.cut_short, kCutShort * designs);
}

// What discs sweep as they are turned, in place of the discs.
Assembly with_reaches(Assembly assembly) {
    for (Plate& plate : assembly.plates) {
        if (plate.rivet) plate.outline = reach_of(plate);
        plate.rivet.reset();
    }
    return assembly;
}

// All elements of the table, with drawn outlines.
void compare_of_every_row(int designs, double step) {
    Tally tally;
    std::map<std::string, int> made;
    for (int seed = 1; seed <= designs; ++seed) {
        const Design design = generate_any(static_cast<std::uint64_t>(seed), 2 + seed % 11);
        for (const Structure& one : design.structures) ++made[one.type];
        const Built built = build(design);
        ASSERT_TRUE(built.assembly) << seed;
        Diagnostics diagnostics;
        MotionOptions options;
        options.examine = false;
        ASSERT_TRUE(simulate(*built.assembly, options, diagnostics)) << seed << "\n" << findings(diagnostics);
        Comparison(fmt::format("seed {}", seed), with_reaches(*built.assembly), tally).at_every(step);
    }
    // Of few designs each kind need not be in one.
    if (designs >= 30) {
        for (const ElementInfo& info : element_table())
            EXPECT_GT(made[std::string(info.name)], designs / 30) << info.name;
    }
    EXPECT_GT(tally.crossings, 100U * static_cast<std::size_t>(designs)) << "there must be much to find";
    EXPECT_LE(static_cast<double>(tally.undecided), kUndecided * static_cast<double>(tally.crossings));
    EXPECT_LE(tally.cut_short, kCutShort * designs);
}

// The work is spent at 85.5° here, and plates cross from 107.5° on.
void compare_where_cut_short() {
    Tally tally;
    const Built built = build(generate_any(1164, 11));
    ASSERT_TRUE(built.assembly);
    const Assembly assembly = with_reaches(*built.assembly);
    Comparison("seed 1164", assembly, tally).at_every(1.0);
    EXPECT_EQ(tally.cut_short, 1);
    Diagnostics diagnostics;
    ASSERT_TRUE(simulate(assembly, {}, diagnostics));
    EXPECT_NE(findings(diagnostics).find("undecided"), std::string::npos) << findings(diagnostics);
}

void compare_samples(double step) {
    Tally tally;
    int samples = 0;
    for (const auto& entry : fs::directory_iterator(fs::path(POPUP_SOURCE_DIR) / "samples")) {
        if (entry.path().extension() != ".xml") continue;
        ++samples;
        SCOPED_TRACE(entry.path().filename().string());
        Diagnostics diagnostics;
        const auto source = read_source(entry.path().string(), diagnostics);
        ASSERT_TRUE(source);
        const auto design = read_design(*source, {}, diagnostics);
        ASSERT_TRUE(design) << findings(diagnostics);
        const Built built = build(*design);
        ASSERT_TRUE(built.assembly);
        Comparison(entry.path().filename().string(), *built.assembly, tally).at_every(step);
    }
    EXPECT_GE(samples, 12);
    EXPECT_EQ(tally.crossings, 0U) << "no sample may collide";
}

// A strip of panels between slanted folds, each with a flap on one side or both: long chains, in which folds
// undo one another, and much that meets.
CreasePattern random_strip(int seed) {
    std::mt19937 random(static_cast<unsigned>(seed));
    const auto unit = [&] { return static_cast<double>(random()) * 0x1p-32; };
    CreasePattern pattern;
    const auto fold = [&](Vec2 a, Vec2 b) {
        const CreaseUse use = unit() < 0.5 ? CreaseUse::mountain : CreaseUse::valley;
        pattern.lines.push_back({{a, b}, false, use, 30.0 + 140.0 * unit()});
    };
    const int panels = 4 + seed % 9;
    Vec2 low{0.0, 0.0};
    Vec2 high{0.0, 30.0};
    pattern.lines.push_back({{low, high}});
    for (int i = 1; i <= panels; ++i) {
        const double lean = 8.0 * (unit() - 0.5);
        const Vec2 next_low{20.0 * i - lean, 0.0};
        const Vec2 next_high{20.0 * i + lean, 30.0};
        for (const bool above : {false, true}) {
            const Vec2 a = above ? high : low;
            const Vec2 b = above ? next_high : next_low;
            if (unit() < 0.4) {
                pattern.lines.push_back({{a, b}});
                continue;
            }
            const double out = (above ? 1.0 : -1.0) * (10.0 + 30.0 * unit());
            fold(a, b);
            pattern.lines.push_back({{a, a + Vec2{3.0, out}, b + Vec2{-3.0, out}, b}});
        }
        low = next_low;
        high = next_high;
        if (i < panels) {
            fold(low, high);
        } else {
            pattern.lines.push_back({{low, high}});
        }
    }
    return pattern;
}

void compare_folded(int sheets, double step) {
    Tally tally;
    for (int seed = 1; seed <= sheets; ++seed) {
        Diagnostics diagnostics;
        const auto sheet = fold_sheet(random_strip(seed), {}, diagnostics);
        ASSERT_TRUE(sheet) << seed;
        ASSERT_EQ(findings(diagnostics), "") << seed;
        Comparison(fmt::format("strip {}", seed), *sheet, tally).at_every(step);
    }
    EXPECT_GT(tally.crossings, 500U * static_cast<std::size_t>(sheets)) << "there must be much to find";
    EXPECT_LE(static_cast<double>(tally.undecided), kUndecided * static_cast<double>(tally.crossings));
    EXPECT_LE(tally.cut_short, kCutShort * sheets);
}

class Collisions : public testing::Test {
 protected:
    void SetUp() override {
        if (!BruteForce::available()) GTEST_SKIP() << BruteForce::kMissing;
    }
};
class LongCollisions : public Collisions {};

TEST_F(Collisions, CollisionsAgreeWithBruteForce) { compare_generated(kDesigns, 0.5); }
TEST_F(Collisions, OfEveryRowAgreeWithBruteForce) { compare_of_every_row(kDesigns / 4, 1.0); }
TEST_F(Collisions, OfFoldedSheetsAgreeWithBruteForce) { compare_folded(kDesigns / 4, 1.0); }
TEST_F(Collisions, UpToWhereTheWorkIsSpentAgreeWithBruteForce) { compare_where_cut_short(); }
TEST_F(Collisions, Samples) { compare_samples(kSanitized ? 0.5 : 0.05); }
TEST_F(LongCollisions, CollisionsAgreeWithBruteForce) { compare_generated(kLongDesigns, 0.25); }
TEST_F(LongCollisions, OfEveryRowAgreeWithBruteForce) { compare_of_every_row(kLongDesigns, 1.0); }
TEST_F(LongCollisions, OfFoldedSheetsAgreeWithBruteForce) { compare_folded(kLongDesigns, 0.5); }

}  // namespace
}  // namespace popup::test
