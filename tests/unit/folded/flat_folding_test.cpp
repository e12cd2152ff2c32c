// Patterns that are known to fold flat, or not to, and orders of layers against all permutations.
#include "popup/flat_folding.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "miura.h"
#include "support/designs.h"
#include "support/random.h"

namespace popup {
namespace {

using test::Random;

struct Answer {
    bool flat = false;
    std::size_t layers = 0;
    std::string told;
};

Answer ask(const CreasePattern& pattern) {
    Diagnostics diagnostics("flat");
    const auto flat = fold_flat(pattern, {}, diagnostics);
    return {flat.has_value(), flat ? flat->layers : 0, test::findings(diagnostics)};
}

CreaseLine border(double width, double height) {
    return {{{0, 0}, {width, 0}, {width, height}, {0, height}}, true, CreaseUse::cut};
}

CreaseUse kind(bool mountain) { return mountain ? CreaseUse::mountain : CreaseUse::valley; }

// ---- Strips: folds across, some panels longer than others ----

struct Strip {
    std::vector<double> widths;
    std::vector<bool> mountains;  // one less
};

CreasePattern drawn(const Strip& strip) {
    CreasePattern pattern;
    double x = 0.0;
    for (std::size_t i = 0; i < strip.widths.size(); ++i) {
        x += strip.widths[i];
        if (i < strip.mountains.size())
            pattern.lines.push_back({{{x, 0}, {x, 10}}, false, kind(strip.mountains[i])});
    }
    pattern.lines.push_back(border(x, 10));
    return pattern;
}

// By trying all orders of the panels: of each two that are neighbours the fold says who is above, and at no
// place of the strip where it is folded does a panel pass through a fold, or two folds through each other.
bool folds_by_permutations(const Strip& strip) {
    const std::size_t n = strip.widths.size();
    std::vector<double> at{0.0};
    for (std::size_t i = 0; i < n; ++i)
        at.push_back(at.back() + (i % 2 == 0 ? strip.widths[i] : -strip.widths[i]));
    const auto low = [&](std::size_t i) { return std::min(at[i], at[i + 1]); };
    const auto high = [&](std::size_t i) { return std::max(at[i], at[i + 1]); };
    std::vector<std::size_t> level(n);
    std::iota(level.begin(), level.end(), 0);
    do {
        bool good = true;
        for (std::size_t i = 0; i + 1 < n && good; ++i) {
            // The fronts of even panels are up.
            const bool next_above = (i % 2 == 0) != strip.mountains[i];
            good = next_above == (level[i + 1] > level[i]);
            const double fold = at[i + 1];
            const auto between = [&](std::size_t k) {
                return level[k] > std::min(level[i], level[i + 1]) &&
                       level[k] < std::max(level[i], level[i + 1]);
            };
            for (std::size_t k = 0; k < n && good; ++k) {
                if (k != i && k != i + 1 && low(k) < fold - 1e-9 && high(k) > fold + 1e-9) good = !between(k);
            }
            // Folds on one line, whose panels lie on the same side of it.
            for (std::size_t k = 0; k + 1 < n && good; ++k) {
                if (k + 1 == i || k == i || k == i + 1 || std::abs(at[k + 1] - fold) > 1e-9) continue;
                const bool same_side = (std::min(low(k), low(k + 1)) < fold - 1e-9) ==
                                       (std::min(low(i), low(i + 1)) < fold - 1e-9);
                if (same_side) good = between(k) == between(k + 1);
            }
        }
        if (good) return true;
    } while (std::next_permutation(level.begin(), level.end()));
    return false;
}

TEST(FlatFolding, StripsAgreeWithAllPermutations) {
    Random random(5);
    int flat = 0;
    int not_flat = 0;
    for (int round = 0; round < 300; ++round) {
        Strip strip;
        const std::size_t panels = 2 + random.below(6);
        for (std::size_t i = 0; i < panels; ++i) {
            // Few widths, so that folds come to lie on one line.
            strip.widths.push_back(10.0 * static_cast<double>(1 + random.below(3)));
            if (i + 1 < panels) strip.mountains.push_back(random.below(2) == 0);
        }
        const Answer answer = ask(drawn(strip));
        const bool expected = folds_by_permutations(strip);
        EXPECT_EQ(answer.flat, expected) << round << "\n" << answer.told;
        EXPECT_EQ(answer.told.find("flat-order") != std::string::npos, !expected) << answer.told;
        ++(expected ? flat : not_flat);
    }
    EXPECT_GT(flat, 50);
    EXPECT_GT(not_flat, 50);
}

// Every assignment of equal panels folds flat.
TEST(FlatFolding, StripsOfEqualPanelsAlwaysFold) {
    for (unsigned kinds = 0; kinds < 64; ++kinds) {
        Strip strip;
        strip.widths.assign(7, 10.0);
        for (unsigned i = 0; i < 6; ++i) strip.mountains.push_back((kinds >> i & 1U) != 0);
        const Answer answer = ask(drawn(strip));
        EXPECT_TRUE(answer.flat) << kinds << "\n" << answer.told;
        EXPECT_EQ(answer.layers, 7U);
    }
}

// ---- Paper folded by simple folds: what comes out folds flat by how it was made ----

// A convex sheet folded along random lines, all layers at once, and opened again.
CreasePattern folded_at_random(Random& random, int folds) {
    struct Panel {
        Ring sheet;            // on the sheet
        std::vector<Vec2> at;  // where its corners lie
        bool front_up;
    };
    const Ring square{{0, 0}, {100, 0}, {100, 100}, {0, 100}};
    std::vector<Panel> panels{{square, square, true}};
    CreasePattern pattern;
    pattern.lines.push_back({square, true, CreaseUse::cut});
    for (int i = 0; i < folds; ++i) {
        const double way = 6.283185307179586 * random.unit();
        const Vec2 dir{std::cos(way), std::sin(way)};
        const Vec2 through{20.0 + 60.0 * random.unit(), 20.0 + 60.0 * random.unit()};
        std::vector<Panel> next;
        for (const Panel& panel : panels) {
            Panel left{{}, {}, panel.front_up};
            Panel right{{}, {}, !panel.front_up};
            std::vector<Vec2> crease;
            for (std::size_t k = 0; k < panel.at.size(); ++k) {
                const std::size_t m = (k + 1) % panel.at.size();
                const double a = cross(dir, panel.at[k] - through);
                const double b = cross(dir, panel.at[m] - through);
                Panel& side = a >= 0.0 ? left : right;
                side.sheet.push_back(panel.sheet[k]);
                side.at.push_back(panel.at[k]);
                if ((a >= 0.0) == (b >= 0.0)) continue;
                const double t = a / (a - b);
                const Vec2 on_sheet = panel.sheet[k] + t * (panel.sheet[m] - panel.sheet[k]);
                const Vec2 there = panel.at[k] + t * (panel.at[m] - panel.at[k]);
                crease.push_back(on_sheet);
                for (Panel* one : {&left, &right}) {
                    one->sheet.push_back(on_sheet);
                    one->at.push_back(there);
                }
            }
            for (Vec2& p : right.at) {
                const double off = cross(dir, p - through);
                p = p - 2.0 * off * left_of(dir);
            }
            // What lies right of the line comes up and over: a valley for what shows its front.
            if (crease.size() == 2) pattern.lines.push_back({crease, false, kind(!panel.front_up)});
            if (left.at.size() > 2) next.push_back(std::move(left));
            if (right.at.size() > 2) next.push_back(std::move(right));
        }
        panels = std::move(next);
    }
    return pattern;
}

TEST(FlatFolding, FindsAnOrderOfWhatWasFolded) {
    Random random(11);
    for (int round = 0; round < 60; ++round) {
        const int folds = 1 + static_cast<int>(random.below(6));
        const CreasePattern pattern = folded_at_random(random, folds);
        const Answer answer = ask(pattern);
        EXPECT_TRUE(answer.flat) << round << ", " << folds << " folds\n" << answer.told;
    }
}

TEST(FlatFolding, FoldsMapsAndMiuraSheets) {
    const Answer sheet = ask(test::miura(7, 6, 12.0, 15.0, 0.35));
    EXPECT_TRUE(sheet.flat) << sheet.told;
    EXPECT_GE(sheet.layers, 4U);
}

// ---- The order that was found, looked at where panels lie ----

// The stack at a point, lowest first, by the pairs alone; empty if they are no order of what lies there.
class Stack {
 public:
    explicit Stack(const Assembly& assembly) : assembly_(assembly) {
        for (const PlateOrder& order : assembly.layers) {
            const bool base_up = assembly.plates[index(order.base)].stands->normal().z > 0.0;
            const bool above = order.on_front == base_up;
            above_[{order.plate, order.base}] = above;
            above_[{order.base, order.plate}] = !above;
        }
        for (const Plate& plate : assembly.plates) {
            Ring& ring = outlines_.emplace_back();
            for (const Vec2 p : plate.outline.outer) {
                const Vec3 at = plate.stands->point(p);
                EXPECT_EQ(at.z, 0.0);
                ring.push_back({at.x, at.y});
            }
            if (signed_area(ring) < 0.0) std::reverse(ring.begin(), ring.end());
        }
    }

    // Of convex panels: 1 inside by `clear`, -1 outside by as much, else 0.
    [[nodiscard]] int side(int plate, Vec2 p, double clear) const {
        const Ring& ring = outlines_[index(plate)];
        double least = 1e9;
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const Vec2 a = ring[i];
            const Vec2 way = unit(ring[(i + 1) % ring.size()] - a);
            least = std::min(least, cross(way, p - a));
        }
        return least > clear ? 1 : least < -clear ? -1 : 0;
    }

    [[nodiscard]] bool is_above(int a, int b) const { return above_.at({a, b}); }
    [[nodiscard]] bool known(int a, int b) const { return above_.count({a, b}) != 0; }

    // Whether those at a point are in an order: as many as lie below each are all different numbers.
    [[nodiscard]] bool ordered(const std::vector<int>& plates) const {
        std::vector<std::size_t> levels;
        for (const int a : plates) {
            std::size_t below = 0;
            for (const int b : plates) {
                if (a == b) continue;
                if (!known(a, b)) return false;
                below += is_above(a, b) ? 1U : 0U;
            }
            levels.push_back(below);
        }
        std::sort(levels.begin(), levels.end());
        return std::adjacent_find(levels.begin(), levels.end()) == levels.end();
    }

 private:
    static std::size_t index(int number) { return static_cast<std::size_t>(number); }
    const Assembly& assembly_;
    std::map<std::pair<int, int>, bool> above_;
    std::vector<Ring> outlines_;
};

// Looks at random points of the sheet, and at points of all folds.
void expect_stacked(const Assembly& assembly, Random& random) {
    const Stack stack(assembly);
    const int count = static_cast<int>(assembly.plates.size());
    const auto lie_at = [&](Vec2 p, int except_a, int except_b) {
        std::vector<int> found;
        for (int i = 0; i < count; ++i) {
            if (i != except_a && i != except_b && stack.side(i, p, 1e-6) > 0) found.push_back(i);
        }
        return found;
    };
    for (int i = 0; i < 200; ++i) {
        const Vec2 p{-50.0 + 200.0 * random.unit(), -50.0 + 200.0 * random.unit()};
        EXPECT_TRUE(stack.ordered(lie_at(p, -1, -1))) << p.x << ", " << p.y;
    }
    std::map<std::pair<int, int>, LineKind> kinds;
    for (const Line& line : assembly.lines) {
        if (line.kind == LineKind::cut) continue;
        kinds[{std::min(line.plate, line.other_plate), std::max(line.plate, line.other_plate)}] = line.kind;
        EXPECT_NEAR(*line.fold_angle, 3.14159265358979, 1e-9);
    }
    for (const Hinge& hinge : assembly.hinges) {
        const Frame& a = *assembly.plates[static_cast<std::size_t>(hinge.a)].stands;
        const Frame& b = *assembly.plates[static_cast<std::size_t>(hinge.b)].stands;
        EXPECT_LT(dot(a.normal(), b.normal()), -0.999);
        ASSERT_TRUE(stack.known(hinge.a, hinge.b));
        // The fronts of a valley's panels look at each other.
        const bool valley =
            kinds.at({std::min(hinge.a, hinge.b), std::max(hinge.a, hinge.b)}) == LineKind::valley;
        EXPECT_EQ(valley, stack.is_above(hinge.a, hinge.b) == (b.normal().z > 0.0));
        for (int i = 0; i < 10; ++i) {
            const double t = 0.05 + 0.9 * random.unit();
            const Vec2 on = hinge.a_line.a + t * (hinge.a_line.b - hinge.a_line.a);
            EXPECT_LT(distance(a.point(on), b.point(on)), 1e-6);
            const Vec3 at = a.point(on);
            // What lies on both sides of the fold is not between its panels.
            for (const int other : lie_at({at.x, at.y}, hinge.a, hinge.b)) {
                if (!stack.known(other, hinge.a) || !stack.known(other, hinge.b)) continue;
                EXPECT_EQ(stack.is_above(other, hinge.a), stack.is_above(other, hinge.b))
                    << "plate " << other << " between " << hinge.a << " and " << hinge.b;
            }
        }
    }
}

TEST(FlatFolding, StacksPanelsSoThatNonePassesThroughAnother) {
    Random random(23);
    for (int round = 0; round < 40; ++round) {
        CreasePattern pattern = folded_at_random(random, 1 + static_cast<int>(random.below(5)));
        // In every other one the order says which way all folds go.
        if (round % 2 == 0) {
            for (CreaseLine& line : pattern.lines) {
                if (line.use != CreaseUse::cut) line.use = CreaseUse::fold;
            }
        }
        Diagnostics diagnostics("flat");
        const auto flat = fold_flat(pattern, {}, diagnostics);
        ASSERT_TRUE(flat) << test::findings(diagnostics);
        EXPECT_EQ(flat->assembly.layers.size(), flat->overlaps);
        EXPECT_EQ(flat->assembly.plates.size(), flat->panels);
        expect_stacked(flat->assembly, random);
    }
}

// ---- What does not fold ----

// A corner in the middle of a square, with folds of these directions and kinds.
CreasePattern corner(const std::vector<std::pair<double, CreaseUse>>& folds) {
    CreasePattern pattern;
    pattern.lines.push_back({{{-50, -50}, {50, -50}, {50, 50}, {-50, 50}}, true, CreaseUse::cut});
    for (const auto& [deg, use] : folds) {
        const double way = deg * 3.14159265358979 / 180.0;
        const double reach = 50.0 / std::max(std::abs(std::cos(way)), std::abs(std::sin(way)));
        pattern.lines.push_back({{{0, 0}, {reach * std::cos(way), reach * std::sin(way)}}, false, use});
    }
    return pattern;
}

TEST(FlatFolding, NamesWhatIsWrongAtACorner) {
    const auto m = CreaseUse::mountain;
    const auto v = CreaseUse::valley;
    EXPECT_TRUE(ask(corner({{0, m}, {90, m}, {180, m}, {270, v}})).flat);
    EXPECT_TRUE(ask(corner({{0, m}, {60, v}, {135, m}, {255, m}})).flat);
    const Answer odd = ask(corner({{0, m}, {120, v}, {240, m}}));
    EXPECT_NE(odd.told.find("flat-odd: 3 folds meet at (0.00, 0.00) mm"), std::string::npos) << odd.told;
    const Answer angles = ask(corner({{0, m}, {70, m}, {180, m}, {270, v}}));
    EXPECT_NE(angles.told.find("add up to 160.00° and 200.00°"), std::string::npos) << angles.told;
    const Answer kinds = ask(corner({{0, m}, {90, v}, {180, m}, {270, v}}));
    EXPECT_NE(kinds.told.find("flat-kinds: 2 mountains and 2 valleys"), std::string::npos) << kinds.told;
    // Those that do not say may go either way.
    EXPECT_TRUE(ask(corner({{0, m}, {90, v}, {180, CreaseUse::fold}, {270, CreaseUse::fold}})).flat);
    EXPECT_FALSE(ask(corner({{0, m}, {90, m}, {180, m}, {270, m}})).flat);
    // The smallest angle between two folds of one kind: what lies beside it is in the way (big-little-big).
    const Answer order = ask(corner({{0, m}, {40, v}, {150, m}, {290, m}}));
    EXPECT_TRUE(order.flat) << order.told;
    const Answer little = ask(corner({{0, m}, {40, m}, {150, v}, {290, m}}));
    EXPECT_NE(little.told.find("flat-order"), std::string::npos) << little.told;
}

TEST(FlatFolding, NamesThePanelsThatHaveNoOrder) {
    // A long panel between two short ones that are folded over it the same way: each is in the other's way.
    Strip strip{{30.0, 10.0, 30.0}, {true, true}};
    ASSERT_FALSE(folds_by_permutations(strip));
    const Answer answer = ask(drawn(strip));
    EXPECT_FALSE(answer.flat);
    EXPECT_NE(answer.told.find("flat-order: folded flat, 3 panels"), std::string::npos) << answer.told;
    // Panels beside them have nothing to do with it.
    strip = {{30.0, 30.0, 30.0, 10.0, 30.0, 30.0}, {true, false, true, true, false}};
    ASSERT_FALSE(folds_by_permutations(strip));
    const Answer longer = ask(drawn(strip));
    EXPECT_NE(longer.told.find("flat-order: folded flat, 3 panels"), std::string::npos) << longer.told;
}

}  // namespace
}  // namespace popup
