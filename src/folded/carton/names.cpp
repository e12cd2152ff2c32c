#include "folded/carton/names.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <string_view>

#include "assembly/folded_sheets.h"
#include "base/nth.h"
#include "folded/carton/closing_angles.h"
#include "folded/carton/drawn_folds.h"
#include "folded/carton/web_corners.h"

namespace popup::folded {
namespace {

constexpr double kAsLong = 0.6;  // of the first wall: so long are the folds between the walls
constexpr double kFull = 0.6;    // of its width and height: a wall has more area
constexpr double kNarrow = 0.5;  // of the narrowest wall: a glue flap is narrower
constexpr double kOddNarrow = 0.9;
constexpr double kCloses = 0.85;        // of the depth of the box: what is as deep closes it
constexpr double kLockShare = 0.1;      // of the panel that it hangs on: a lock is smaller
constexpr double kAsLargeAsBase = 0.7;  // a lid
constexpr double kRim = 0.3;            // of the height of a wall: what is between it and its lining is less
constexpr double kOblique = 0.3;        // sine and cosine of what is neither along nor across
constexpr double kAsWide = 0.08;        // walls of a ring differ by less: by boards
constexpr double kAsHigh = 0.15;
constexpr double kAsLarge = 0.01;   // areas that differ by less are one
constexpr double kBaseShare = 0.5;  // of the largest panel: a base has more
constexpr std::size_t kMostWalls = 64;

class Namer : private DrawnFolds {
 public:
    Namer(const CreasePattern& pattern, const Sheet& sheet, const Tree& tree)
        : DrawnFolds(pattern, sheet), sheet_(sheet), tree_(tree), names_(sheet.panels.size()) {
        panels_of_.resize(sheet.cuts.size());
        for (const int panel : tree.order) nth(panels_of_, nth(sheet.panels, panel).piece).push_back(panel);
    }

    std::vector<std::string> run() {
        std::vector<char> has_loop(sheet_.cuts.size(), 0);
        // Corners that are closed by webs are what trays have; other loops are of other things.
        std::vector<char> is_web(sheet_.loops.size(), 0);
        for (const WebCorner& web : find_web_corners(sheet_)) nth(is_web, web.loop) = 1;
        for (std::size_t i = 0; i < sheet_.loops.size(); ++i) {
            if (is_web[i] != 0) continue;
            const Loop& loop = sheet_.loops[i];
            const Fold& fold = nth(sheet_.folds, loop.steps.front().fold);
            nth(has_loop, nth(sheet_.panels, fold.left).piece) = 1;
        }
        for (const int root : tree_.order) {
            if (nth(tree_.fold_of, root) < 0 && nth(has_loop, nth(sheet_.panels, root).piece) == 0)
                name_piece(root);
        }
        return std::move(names_);
    }

 private:
    struct Wall {
        int panel = 0;
        double width = 0.0;   // across the folds between the walls
        double height = 0.0;  // of these folds: one wall may reach further, as a header does
        int other_half = -1;  // of a wall that a crease parts
    };
    struct Tray {
        int root = 0;
        std::array<Vec2, 4> out;     // to the front, the right, the back and the left of the drawing
        std::array<int, 4> folds{};  // there; -1: none
    };
    struct Tube {
        std::vector<Wall> walls;  // without the glue flap
        Vec2 along;
        double front = 1.0;       // as look_from() has it
        int glue_flap = -1;       // panel
        bool glue_first = false;  // it is before the first wall
        bool is_ring = false;
        double area = 0.0;
    };

    void name_piece(int root) {
        taken_.clear();
        const std::vector<int>& panels = nth(panels_of_, nth(sheet_.panels, root).piece);
        // A box may be drawn from its inside or from its outside, as valleys or as mountains.
        std::optional<Tube> tube;
        for (const double front : {1.0, -1.0}) {
            look_from(front);
            for (const int panel : panels) {
                for (const Vec2 dir : directions_of(panel)) consider(panel, dir, root, tube);
            }
        }
        if (tube) look_from(tube->front);
        bool is_carton = tube && tube->is_ring && !is_mailer(*tube);
        for (const double front : {1.0, -1.0}) {
            look_from(front);
            is_carton = is_carton || name_tray(panels);
            if (is_carton) break;
        }
        is_carton = is_carton || tube;
        if (is_carton && taken_.empty()) name_tube(*tube);
        if (!is_carton) return;
        // Parents come before what hangs on them.
        std::size_t number = 0;
        for (const int panel : panels) {
            ++number;
            if (!nth(names_, panel).empty()) continue;
            const int parent = parent_of(panel);
            const bool lock = parent >= 0 && area_of(panel) < kLockShare * area_of(parent) &&
                              !nth(names_, parent).starts_with("panel-");
            if (!lock || !give(panel, nth(names_, parent) + "-lock"))
                give(panel, fmt::format("panel-{}", number));
        }
    }

    // False where another has the name.
    bool give(int panel, std::string name) {
        if (!nth(names_, panel).empty() || !taken_.insert(name).second) return false;
        nth(names_, panel) = std::move(name);
        return true;
    }

    [[nodiscard]] int parent_of(int panel) const {
        const int fold = nth(tree_.fold_of, panel);
        return fold < 0 ? -1 : other_side(fold, panel);
    }
    [[nodiscard]] bool is_full(int panel, Vec2 along, Vec2 across) const {
        return area_of(panel) >= kFull * width_of(panel, across) * width_of(panel, along);
    }

    // Walls side by side from one on, itself left out.
    [[nodiscard]] std::vector<Wall> walls_from(int first, Vec2 along, Vec2 across) const {
        const double least = kAsLong * width_of(first, along);
        std::vector<Wall> walls;
        int panel = first;
        int came_by = -1;
        while (walls.size() < kMostWalls) {
            const int by = fold_on(panel, along, across, least, came_by);
            if (by < 0) break;
            panel = other_side(by, panel);
            came_by = by;
            // What tapers is a lid or a tip, and no wall.
            if (!is_full(panel, along, across)) break;
            walls.push_back({panel, width_of(panel, across), length_of(by)});
            const int crease = fold_on(panel, along, across, least, came_by, Folded::gusset);
            if (crease < 0) continue;
            const int half = other_side(crease, panel);
            if (!is_full(half, along, across)) continue;
            walls.back().other_half = half;
            walls.back().width += width_of(half, across);
            panel = half;
            came_by = crease;
        }
        return walls;
    }

    [[nodiscard]] std::vector<Wall> walls_along(int root, Vec2 along) const {
        const Vec2 across = right_of(along);
        std::vector<Wall> walls = walls_from(root, along, -across);
        std::reverse(walls.begin(), walls.end());
        const std::vector<Wall> after = walls_from(root, along, across);
        walls.push_back({root, width_of(root, across), walls.empty() ? 0.0 : walls.back().height});
        if (!after.empty()) walls.back().height = std::max(walls.back().height, after.front().height);
        walls.insert(walls.end(), after.begin(), after.end());
        return walls;
    }

    // Of rings rather one with a glue flap, then the larger one; else what is around the root is best.
    [[nodiscard]] static bool is_better(const Tube& one, const Tube& other) {
        if (one.is_ring != other.is_ring) return one.is_ring;
        if (one.is_ring && (one.glue_flap >= 0) != (other.glue_flap >= 0)) return one.glue_flap >= 0;
        return one.area > other.area * (1.0 + kAsLarge);
    }

    void consider(int first, Vec2 along, int root, std::optional<Tube>& best) const {
        Tube tube;
        tube.along = along;
        tube.front = front();
        tube.walls = walls_along(first, along);
        if (tube.walls.size() < 4) return;
        for (const Wall& wall : tube.walls) tube.area += area_of(wall.panel);
        find_glue_flap(tube);
        tube.is_ring = is_ring(tube);
        if (!tube.is_ring && first != root) return;
        if (!best || is_better(tube, *best)) best = std::move(tube);
    }

    void find_glue_flap(Tube& tube) const {
        std::vector<Wall>& walls = tube.walls;
        const auto narrowest_but = [&](std::size_t one) {
            double width = HUGE_VAL;
            for (std::size_t i = 0; i < walls.size(); ++i) {
                if (i != one) width = std::min(width, walls[i].width);
            }
            return width;
        };
        // Walls that go around are even in number mostly, so that one too many is to be glued.
        const double narrow = walls.size() % 2 == 1 ? kOddNarrow : kNarrow;
        for (const std::size_t end : {walls.size() - 1, std::size_t{0}}) {
            if (folds_of(walls[end].panel).size() != 1) continue;
            if (walls[end].width >= narrow * narrowest_but(end)) continue;
            tube.glue_flap = walls[end].panel;
            tube.glue_first = end == 0;
            walls.erase(walls.begin() + static_cast<std::ptrdiff_t>(end));
            return;
        }
    }

    // Whether a panel on the end of a wall has the walls' widths for its sides.
    [[nodiscard]] bool has_end_of_its_shape(const Tube& tube) const {
        std::vector<double> widths;
        for (const Wall& wall : tube.walls) widths.push_back(wall.width);
        for (std::size_t i = 0; i < widths.size(); ++i) {
            const int wall = tube.walls[i].panel;
            for (const int fold : folds_of(wall)) {
                const Segment line = sheet_.line_of(nth(sheet_.folds, fold));
                const Ring end = sheet_.outline_of(nth(sheet_.panels, other_side(fold, wall))).outer;
                if (fold_angles_of_end(end, line, widths, i)) return true;
            }
        }
        return false;
    }

    // Walls that go around: as high as one another, and opposite ones as wide, or as their end has it.
    [[nodiscard]] bool is_ring(const Tube& tube) const {
        const std::size_t count = tube.walls.size();
        if (count < 3 || (count % 2 == 1 && tube.glue_flap < 0)) return false;
        const auto like = [](double a, double b, double share) {
            return std::abs(a - b) <= share * std::max(a, b);
        };
        const double height = tube.walls.front().height;
        bool opposite_alike = true;
        for (std::size_t i = 0; i < count; ++i) {
            if (!like(tube.walls[i].height, height, kAsHigh)) return false;
            const Wall& other = tube.walls[count % 2 == 0 ? (i + count / 2) % count : 0];
            opposite_alike = opposite_alike && like(tube.walls[i].width, other.width, kAsWide);
        }
        return opposite_alike || (tube.glue_flap >= 0 && has_end_of_its_shape(tube));
    }

    void name_tube(const Tube& tube) {
        look_from(tube.front);
        if (tube.glue_flap >= 0) give(tube.glue_flap, std::string(kGlueFlapName));
        std::size_t front = 0;
        if (tube.glue_flap >= 0) {
            front = tube.glue_first ? 0 : tube.walls.size() - 1;
        } else {
            for (std::size_t i = 1; i < tube.walls.size(); ++i) {
                if (area_of(tube.walls[i].panel) > area_of(tube.walls[front].panel) * (1.0 + kAsLarge))
                    front = i;
            }
        }
        name_walls(front, tube.walls);
        name_end(tube.walls, tube.along, kTopName);
        name_end(tube.walls, -tube.along, kBottomName);
    }

    void name_walls(std::size_t front, const std::vector<Wall>& walls) {
        const std::size_t count = walls.size();
        static constexpr std::array<std::string_view, 4> kFour{"front", "right", "back", "left"};
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t turn = (i + count - front) % count;
            std::string name = fmt::format("wall-{}", turn + 1);
            if (count == 4) {
                name = kFour.at(turn);
            } else if (turn == 0) {
                name = "front";
            } else if (2 * turn == count) {
                name = "back";
            }
            if (walls[i].other_half >= 0) {
                give(walls[i].other_half, name + "-2");
                name += "-1";
            }
            give(walls[i].panel, std::move(name));
        }
    }

    // Whether what goes around is a tray with its lid: bottom, back, lid and a tuck in front that is no wider
    // than its walls, as a glue flap would be. There the sides are rolled in, a narrow strip between two
    // walls; or they have no tucks, which lids of tubes close with, and the tuck is wider than glue flaps
    // are.
    [[nodiscard]] bool is_mailer(const Tube& tube) const {
        if (tube.walls.size() != 4) return false;
        double narrowest = HUGE_VAL;
        for (const Wall& wall : tube.walls) narrowest = std::min(narrowest, wall.width);
        const Vec2 across = right_of(tube.along);
        const bool wide = tube.glue_flap >= 0 && width_of(tube.glue_flap, across) >= kNarrow * narrowest;
        return std::any_of(tube.walls.begin(), tube.walls.end(), [&](const Wall& wall) {
            const std::optional<Side> one = side_at(wall.panel, tube.along);
            const std::optional<Side> other = side_at(wall.panel, -tube.along);
            if (!one || !other) return false;
            return (one->is_rolled && other->is_rolled) || (wide && one->is_bare && other->is_bare);
        });
    }

    // What hangs at the far edge of a panel: the fold there, and the panel; -1: nothing.
    struct Next {
        int fold = -1, panel = -1;
    };
    [[nodiscard]] Next next_at(int panel, int own, Vec2 out) const {
        const Vec2 along = right_of(out);
        const int far = fold_on(panel, along, out, 0.3 * width_of(panel, along), own);
        return far < 0 ? Next{} : Next{far, other_side(far, panel)};
    }
    // The wall that a strip leads to over which it is rolled in; -1: this is no such strip.
    [[nodiscard]] int rolled_in(int fold, int wall, const Next& strip, Vec2 out) const {
        if (strip.panel < 0 || depth_from(strip.fold, strip.panel) > kRim * depth_from(fold, wall)) return -1;
        const Next inner = next_at(strip.panel, strip.fold, out);
        return inner.panel >= 0 && depth_from(inner.fold, inner.panel) >= kNarrow * depth_from(fold, wall)
                   ? inner.panel
                   : -1;
    }
    struct Side {
        bool is_rolled = false;
        bool is_bare = false;  // nothing hangs on its far edge
    };
    [[nodiscard]] std::optional<Side> side_at(int panel, Vec2 out) const {
        const Vec2 along = right_of(out);
        const int fold = fold_on(panel, along, out, kAsLong * width_of(panel, along), -1);
        if (fold < 0) return std::nullopt;
        const int side = other_side(fold, panel);
        const Next far = next_at(side, fold, out);
        return Side{rolled_in(fold, side, far, out) >= 0, far.panel < 0};
    }

    // What hangs at one end of the walls: on their side of `up`.
    void name_end(const std::vector<Wall>& walls, Vec2 up, std::string_view end) {
        const Vec2 along = right_of(up);
        struct Flap {
            int panel = 0, fold = 0;
            std::size_t wall = 0;
            int on = 0;  // the panel of that wall
            bool closes = false;
        };
        std::vector<Flap> flaps;
        for (std::size_t i = 0; i < walls.size(); ++i) {
            for (const int wall : {walls[i].panel, walls[i].other_half}) {
                if (wall < 0) continue;
                const int fold = fold_on(wall, along, up, kNarrow * width_of(wall, along), -1, Folded::over);
                if (fold < 0) continue;
                const int panel = other_side(fold, wall);
                // As deep as the box is there: the walls beside it say how deep that is.
                const double beside = std::min(walls[(i + 1) % walls.size()].width,
                                               walls[(i + walls.size() - 1) % walls.size()].width);
                flaps.push_back({panel, fold, i, wall, depth_from(fold, panel) >= kCloses * beside});
            }
        }
        const auto closing =
            std::find_if(flaps.begin(), flaps.end(), [](const Flap& one) { return one.closes; });
        const auto others =
            std::count_if(flaps.begin(), flaps.end(), [](const Flap& one) { return one.closes; });
        const bool one_closes = walls.size() >= 4 && others == 1;
        for (const Flap& flap : flaps) {
            const std::string& wall = nth(names_, flap.on);
            if (one_closes && &flap == &*closing) {
                give(flap.panel, std::string(end));
                name_far_edge(flap.panel, flap.fold, fmt::format("{}-tuck", end));
            } else {
                const bool opposite =
                    one_closes && (flap.wall + walls.size() / 2) % walls.size() == closing->wall;
                give(flap.panel, one_closes && !opposite ? fmt::format("{}-dust-flap-{}", end, wall)
                                                         : fmt::format("{}-flap-{}", end, wall));
                name_far_edge(flap.panel, flap.fold, fmt::format("{}-tuck", nth(names_, flap.panel)));
                name_glue_corner(flap.panel, flap.fold, fmt::format("{}-{}-{}", end, kGlueCornerName, wall));
            }
        }
    }

    // The corner of a flap beyond an oblique crease that lies flat in the end: only what is glued to the next
    // flap has a use for such a crease, for by it a bottom locks when the flat tube is opened.
    void name_glue_corner(int flap, int own, const std::string& name) {
        const Segment line = sheet_.line_of(nth(sheet_.folds, own));
        const Vec2 along = unit(line.b - line.a);
        for (const int number : folds_of(flap)) {
            if (number == own || drawn_deg(nth(sheet_.folds, number)) >= kGussetDeg) continue;
            const Segment crease = sheet_.line_of(nth(sheet_.folds, number));
            const Vec2 way = unit(crease.b - crease.a);
            if (std::abs(cross(along, way)) < kOblique || std::abs(dot(along, way)) < kOblique) continue;
            give(other_side(number, flap), name);
        }
    }

    // What hangs at the edge of a panel opposite to its own fold.
    int name_far_edge(int panel, int fold, std::string name) {
        const Segment line = sheet_.line_of(nth(sheet_.folds, fold));
        const Vec2 along = unit(line.b - line.a);
        Vec2 out = left_of(along);
        const Vec2 reach = extent(panel, out);
        if (reach.y - dot(out, line.a) < dot(out, line.a) - reach.x) out = -out;
        const int far = fold_on(panel, along, out, 0.3 * distance(line.a, line.b), fold);
        if (far < 0) return -1;
        const int next = other_side(far, panel);
        return give(next, std::move(name)) ? next : -1;
    }

    // The first of the panels that has walls around it, and is large enough; where its lid has walls, too,
    // the one of the two whose walls are the larger ones, with what is rolled in.
    bool name_tray(const std::vector<int>& panels) {
        double largest = 0.0;
        for (const int panel : panels) largest = std::max(largest, area_of(panel));
        std::optional<Tray> best;
        for (const int panel : panels) {
            if (area_of(panel) < kBaseShare * largest) continue;
            const std::optional<Tray> tray = tray_around(panel);
            if (!tray || (best && !is_lid_of(*tray, *best))) continue;
            if (!best || walls_of(*tray) > walls_of(*best) * (1.0 + kAsLarge)) best = tray;
        }
        if (best) name_tray(stands_on(*best));
        return best.has_value();
    }

    // A wall of a deep tray, with its corners and the bottom, looks like a tray that is open on one side.
    [[nodiscard]] Tray stands_on(const Tray& tray) const {
        for (const int fold : tray.folds) {
            const auto other = fold < 0 ? std::nullopt : tray_around(other_side(fold, tray.root));
            if (other && is_wall_of(tray.root, *other) && sides_of(*other) > sides_of(tray)) return *other;
        }
        return tray;
    }

    [[nodiscard]] bool is_wall_of(int panel, const Tray& tray) const {
        return std::any_of(tray.folds.begin(), tray.folds.end(),
                           [&](int fold) { return fold >= 0 && other_side(fold, tray.root) == panel; });
    }
    static std::ptrdiff_t sides_of(const Tray& tray) {
        return std::count_if(tray.folds.begin(), tray.folds.end(), [](int fold) { return fold >= 0; });
    }

    // As large, and beyond one of its walls.
    [[nodiscard]] bool is_lid_of(const Tray& lid, const Tray& tray) const {
        if (area_of(lid.root) < kAsLargeAsBase * area_of(tray.root)) return false;
        return std::any_of(lid.folds.begin(), lid.folds.end(), [&](int fold) {
            return fold >= 0 && is_wall_of(other_side(fold, lid.root), tray);
        });
    }

    // The area of what stands around the base of a tray, and is rolled over there.
    [[nodiscard]] double walls_of(const Tray& tray) const {
        double sum = 0.0;
        for (std::size_t i = 0; i < 4; ++i) {
            if (tray.folds[i] < 0) continue;
            int panel = other_side(tray.folds[i], tray.root);
            int by = tray.folds[i];
            const Vec2 along = right_of(tray.out[i]);
            while (by >= 0 && area_of(panel) < kAsLargeAsBase * area_of(tray.root)) {
                sum += area_of(panel);
                by = fold_on(panel, along, tray.out[i], 0.3 * width_of(panel, along), by);
                if (by >= 0) panel = other_side(by, panel);
            }
        }
        return sum;
    }

    [[nodiscard]] std::optional<Tray> tray_around(int root) const {
        const std::vector<Vec2> directions = directions_of(root);
        if (directions.empty()) return std::nullopt;
        // The direction that is nearest to that of the drawing's y.
        const Vec2 up = *std::max_element(directions.begin(), directions.end(), [](Vec2 a, Vec2 b) {
            return std::abs(a.y) < std::abs(b.y) - 1e-9;
        });
        Tray tray;
        tray.root = root;
        tray.out = {-up, right_of(up), up, left_of(up)};
        int count = 0;
        for (std::size_t i = 0; i < 4; ++i) {
            const Vec2 along = right_of(tray.out[i]);
            tray.folds[i] = fold_on(root, along, tray.out[i], kAsLong * width_of(root, along), -1);
            if (tray.folds[i] >= 0) ++count;
        }
        if (count < 3) return std::nullopt;
        return tray;
    }

    void name_tray(const Tray& tray) {
        static constexpr std::array<std::string_view, 4> kSides{"front", "right", "back", "left"};
        give(tray.root, std::string(kBaseName));
        for (std::size_t i = 0; i < 4; ++i) {
            if (tray.folds[i] >= 0) give(other_side(tray.folds[i], tray.root), std::string(kSides[i]));
        }
        for (std::size_t i = 0; i < 4; ++i) {
            if (tray.folds[i] < 0) continue;
            const int wall = other_side(tray.folds[i], tray.root);
            name_wall_of_tray(tray.root, wall, tray.folds[i], tray.out[i]);
        }
    }

    void name_wall_of_tray(int root, int wall, int fold, Vec2 out) {
        const std::string name = nth(names_, wall);
        const Next far = next_at(wall, fold, out);
        const int inner = rolled_in(fold, wall, far, out);
        if (far.panel >= 0 && area_of(far.panel) >= kAsLargeAsBase * area_of(root)) {
            if (give(far.panel, std::string(kLidName))) name_lid(far, out);
        } else if (inner >= 0) {
            give(far.panel, name + "-rim");
            give(inner, name + "-lining");
        } else if (far.panel >= 0) {
            give(far.panel, name + "-lining");
        }
        name_beside(wall, fold, out, name + "-corner");
    }

    void name_lid(const Next& lid, Vec2 out) {
        name_beside(lid.panel, lid.fold, out, fmt::format("{}-ear", kLidName));
        const Next tuck = next_at(lid.panel, lid.fold, out);
        if (tuck.panel < 0 || !give(tuck.panel, fmt::format("{}-tuck", kLidName))) return;
        name_beside(tuck.panel, tuck.fold, out, fmt::format("{}-tuck-ear", kLidName));
    }

    // What hangs on the edges of a panel beside its own fold: "back-corner-left" for "back-corner".
    void name_beside(int panel, int fold, Vec2 out, const std::string& stem) {
        const Vec2 along = right_of(out);
        const bool upright = std::abs(along.x) < std::abs(along.y);
        for (const double side : {1.0, -1.0}) {
            const int end = fold_on(panel, out, side * along, 0.3 * depth_from(fold, panel), fold);
            if (end < 0) continue;
            const double way = side * (upright ? along.y : along.x);
            const std::string_view where =
                upright ? (way < 0.0 ? "front" : "back") : (way < 0.0 ? "left" : "right");
            give(other_side(end, panel), fmt::format("{}-{}", stem, where));
        }
    }

    const Sheet& sheet_;
    const Tree& tree_;
    std::vector<std::vector<int>> panels_of_;  // by piece, in the order of the tree
    std::vector<std::string> names_;
    std::set<std::string> taken_;
};

}  // namespace

std::vector<std::string> name_panels(const CreasePattern& pattern, const Sheet& sheet, const Tree& tree) {
    return Namer(pattern, sheet, tree).run();
}

bool is_of_walls(std::string_view name) {
    constexpr std::array<std::string_view, 7> kWalls{"front", "back",    "left",       "right",
                                                     "wall",  kBaseName, kGlueFlapName};
    name.remove_prefix(name.rfind('/') + 1);                      // none: 0
    const std::size_t end = name.find_last_not_of("0123456789");  // "wall-3", "left-1"
    if (end != std::string_view::npos && end + 1 < name.size() && name[end] == '-')
        name = name.substr(0, end);
    return std::find(kWalls.begin(), kWalls.end(), name) != kWalls.end();
}

}  // namespace popup::folded
