#include "folded/carton/names.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>
#include <string_view>

#include "base/nth.h"

namespace popup::folded {
namespace {

constexpr double kParallel = 0.02;  // sine of the angle between folds that are called parallel
constexpr double kAsLong = 0.6;     // of the first wall: so long are the folds between the walls
constexpr double kFull = 0.6;       // of its width and height: a wall has more area
constexpr double kNarrow = 0.5;     // of the narrowest wall: a glue flap is narrower
constexpr double kOddNarrow = 0.9;
constexpr double kCloses = 0.85;        // of the depth of the box: what is as deep closes it
constexpr double kLockShare = 0.1;      // of the panel that it hangs on: a lock is smaller
constexpr double kAsLargeAsBase = 0.7;  // a lid
constexpr double kUprightRad = 0.17;
constexpr std::size_t kMostWalls = 64;

class Namer {
 public:
    Namer(const Sheet& sheet, const Tree& tree)
        : sheet_(sheet), tree_(tree), folds_(folds_by_panel(sheet)), names_(sheet.panels.size()) {}

    std::vector<std::string> run() {
        std::vector<char> has_loop(sheet_.cuts.size(), 0);
        for (const Loop& loop : sheet_.loops) {
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
        double width = 0.0;  // across the folds between the walls
    };

    void name_piece(int root) {
        taken_.clear();
        // A box may be drawn from its inside or from its outside, as valleys or as mountains.
        front_ = 1.0;
        bool is_carton = name_tube(root) || name_tray(root);
        if (!is_carton) {
            front_ = -1.0;
            is_carton = name_tube(root) || name_tray(root);
        }
        if (!is_carton) return;
        // Parents come before what hangs on them.
        std::size_t number = 0;
        for (const int panel : tree_.order) {
            if (nth(sheet_.panels, panel).piece != nth(sheet_.panels, root).piece) continue;
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

    [[nodiscard]] int other_side(int fold, int panel) const {
        const Fold& one = nth(sheet_.folds, fold);
        return one.left == panel ? one.right : one.left;
    }
    [[nodiscard]] int parent_of(int panel) const {
        const int fold = nth(tree_.fold_of, panel);
        return fold < 0 ? -1 : other_side(fold, panel);
    }
    [[nodiscard]] double area_of(int panel) const {
        return area(sheet_.outline_of(nth(sheet_.panels, panel)));
    }
    // From the least to the most along a direction.
    [[nodiscard]] Vec2 extent(int panel, Vec2 dir) const {
        Vec2 reach{HUGE_VAL, -HUGE_VAL};
        for (const int corner : nth(sheet_.panels, panel).outer) {
            const double at = dot(dir, sheet_.at(corner));
            reach = {std::min(reach.x, at), std::max(reach.y, at)};
        }
        return reach;
    }
    // How far a panel reaches from the fold that it hangs on.
    [[nodiscard]] double depth_from(int fold, int panel) const {
        const Segment line = sheet_.line_of(nth(sheet_.folds, fold));
        const Vec2 out = left_of(unit(line.b - line.a));
        const Vec2 reach = extent(panel, out);
        const double at = dot(out, line.a);
        return std::max(reach.y - at, at - reach.x);
    }

    // What is folded to the front, neither hardly nor flat: a box's walls are.
    [[nodiscard]] bool stands_up(int fold) const {
        const double target = nth(sheet_.folds, fold).target * front_;
        return target > kUprightRad && target < std::numbers::pi - kUprightRad;
    }

    // The longest fold of a panel that is parallel to `along`, `length` long at least, on the side of
    // `across` beyond its middle; -1 for none.
    [[nodiscard]] int fold_on(int panel, Vec2 along, Vec2 across, double least, int but) const {
        const Vec2 reach = extent(panel, across);
        int best = -1;
        double longest = least;
        for (const int number : nth(folds_, panel)) {
            if (number == but || !stands_up(number)) continue;
            const Segment line = sheet_.line_of(nth(sheet_.folds, number));
            const Vec2 way = line.b - line.a;
            if (std::abs(cross(along, way)) > kParallel * length(way)) continue;
            if (dot(across, line.a) < 0.5 * (reach.x + reach.y)) continue;
            if (length(way) < longest * (1.0 + 1e-9)) continue;
            longest = length(way);
            best = number;
        }
        return best;
    }

    // Walls side by side from one on, itself left out.
    [[nodiscard]] std::vector<Wall> walls_from(int first, Vec2 along, Vec2 across) const {
        const Vec2 reach = extent(first, along);
        const double least = kAsLong * (reach.y - reach.x);
        std::vector<Wall> walls;
        int panel = first;
        int came_by = -1;
        while (walls.size() < kMostWalls) {
            const int by = fold_on(panel, along, across, least, came_by);
            if (by < 0) break;
            panel = other_side(by, panel);
            came_by = by;
            const Vec2 wide = extent(panel, across);
            const Vec2 high = extent(panel, along);
            // What tapers is a lid or a tip, and no wall.
            if (area_of(panel) < kFull * (wide.y - wide.x) * (high.y - high.x)) break;
            walls.push_back({panel, wide.y - wide.x});
        }
        return walls;
    }

    [[nodiscard]] std::vector<Wall> walls_along(int root, Vec2 along) const {
        const Vec2 across = right_of(along);
        std::vector<Wall> walls = walls_from(root, along, -across);
        std::reverse(walls.begin(), walls.end());
        const Vec2 own = extent(root, across);
        walls.push_back({root, own.y - own.x});
        for (const Wall& wall : walls_from(root, along, across)) walls.push_back(wall);
        return walls;
    }

    // A direction for each set of parallel folds of a panel, upwards, or to the right.
    [[nodiscard]] std::vector<Vec2> directions_of(int panel) const {
        std::vector<Vec2> found;
        for (const int number : nth(folds_, panel)) {
            const Segment line = sheet_.line_of(nth(sheet_.folds, number));
            Vec2 dir = unit(line.b - line.a);
            if (dir.y < -kParallel || (dir.y < kParallel && dir.x < 0.0)) dir = -dir;
            const auto like = [&](Vec2 other) { return std::abs(cross(dir, other)) <= kParallel; };
            if (std::none_of(found.begin(), found.end(), like)) found.push_back(dir);
        }
        return found;
    }

    [[nodiscard]] double area_of_all(const std::vector<Wall>& walls) const {
        double sum = 0.0;
        for (const Wall& wall : walls) sum += area_of(wall.panel);
        return sum;
    }

    bool name_tube(int root) {
        std::vector<Wall> walls;
        Vec2 along;
        for (const Vec2 dir : directions_of(root)) {
            std::vector<Wall> found = walls_along(root, dir);
            // A tube whose ends have tucks is as many panels long as around.
            if (area_of_all(found) <= area_of_all(walls)) continue;
            walls = std::move(found);
            along = dir;
        }
        if (walls.size() < 4) return false;
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
            if (walls[end].panel == root || walls[end].width >= narrow * narrowest_but(end)) continue;
            give(walls[end].panel, "glue-flap");
            walls.erase(walls.begin() + static_cast<std::ptrdiff_t>(end));
            break;
        }
        name_walls(root, walls);
        name_end(walls, along, "top");
        name_end(walls, -along, "bottom");
        return true;
    }

    void name_walls(int root, const std::vector<Wall>& walls) {
        const std::size_t count = walls.size();
        std::size_t front = 0;
        while (walls[front].panel != root) ++front;
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
            give(walls[i].panel, std::move(name));
        }
    }

    // What hangs at one end of the walls: on their side of `up`.
    void name_end(const std::vector<Wall>& walls, Vec2 up, std::string_view end) {
        const Vec2 along = right_of(up);
        struct Flap {
            int panel = 0, fold = 0;
            std::size_t wall = 0;
            bool closes = false;
        };
        std::vector<Flap> flaps;
        for (std::size_t i = 0; i < walls.size(); ++i) {
            const int fold = fold_on(walls[i].panel, along, up, kNarrow * walls[i].width, -1);
            if (fold < 0) continue;
            const int panel = other_side(fold, walls[i].panel);
            // As deep as the box is there: the walls beside it say how deep that is.
            const double beside = std::min(walls[(i + 1) % walls.size()].width,
                                           walls[(i + walls.size() - 1) % walls.size()].width);
            flaps.push_back({panel, fold, i, depth_from(fold, panel) >= kCloses * beside});
        }
        const auto closing =
            std::find_if(flaps.begin(), flaps.end(), [](const Flap& one) { return one.closes; });
        const auto others =
            std::count_if(flaps.begin(), flaps.end(), [](const Flap& one) { return one.closes; });
        const bool one_closes = walls.size() == 4 && others == 1;
        for (const Flap& flap : flaps) {
            const std::string& wall = nth(names_, walls[flap.wall].panel);
            if (one_closes && &flap == &*closing) {
                give(flap.panel, std::string(end));
                name_far_edge(flap.panel, flap.fold, fmt::format("{}-tuck", end));
            } else {
                const bool opposite = one_closes && (flap.wall + closing->wall) % 2 == 0;
                give(flap.panel, one_closes && !opposite ? fmt::format("{}-dust-flap-{}", end, wall)
                                                         : fmt::format("{}-flap-{}", end, wall));
                name_far_edge(flap.panel, flap.fold, fmt::format("{}-tuck", nth(names_, flap.panel)));
            }
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

    bool name_tray(int root) {
        static constexpr std::array<std::string_view, 4> kSides{"front", "right", "back", "left"};
        const std::vector<Vec2> directions = directions_of(root);
        if (directions.empty()) return false;
        // The direction that is nearest to that of the drawing's y.
        const Vec2 up = *std::max_element(directions.begin(), directions.end(), [](Vec2 a, Vec2 b) {
            return std::abs(a.y) < std::abs(b.y) - 1e-9;
        });
        const std::array<Vec2, 4> out{-up, right_of(up), up, left_of(up)};
        std::array<int, 4> folds{};
        int count = 0;
        for (std::size_t i = 0; i < 4; ++i) {
            const Vec2 along = right_of(out[i]);
            const Vec2 reach = extent(root, along);
            folds[i] = fold_on(root, along, out[i], kAsLong * (reach.y - reach.x), -1);
            if (folds[i] >= 0) ++count;
        }
        if (count < 3) return false;
        give(root, "base");
        for (std::size_t i = 0; i < 4; ++i) {
            if (folds[i] >= 0) give(other_side(folds[i], root), std::string(kSides[i]));
        }
        for (std::size_t i = 0; i < 4; ++i) {
            if (folds[i] >= 0) name_wall_of_tray(root, other_side(folds[i], root), folds[i], out[i]);
        }
        return true;
    }

    void name_wall_of_tray(int root, int wall, int fold, Vec2 out) {
        const std::string name = nth(names_, wall);
        const Vec2 along = right_of(out);
        const int far =
            fold_on(wall, along, out, 0.3 * (extent(wall, along).y - extent(wall, along).x), fold);
        if (far >= 0) {
            const int next = other_side(far, wall);
            if (area_of(next) >= kAsLargeAsBase * area_of(root)) {
                if (give(next, "lid")) name_far_edge(next, far, "lid-tuck");
            } else {
                give(next, name + "-lining");
            }
        }
        const bool upright = std::abs(along.x) < std::abs(along.y);
        for (const double side : {1.0, -1.0}) {
            const int end = fold_on(wall, out, side * along, 0.3 * depth_from(fold, wall), fold);
            if (end < 0) continue;
            const double way = side * (upright ? along.y : along.x);
            const std::string_view where =
                upright ? (way < 0.0 ? "front" : "back") : (way < 0.0 ? "left" : "right");
            give(other_side(end, wall), fmt::format("{}-corner-{}", name, where));
        }
    }

    const Sheet& sheet_;
    const Tree& tree_;
    std::vector<std::vector<int>> folds_;
    std::vector<std::string> names_;
    std::set<std::string> taken_;
    double front_ = 1.0;  // -1: walls stand up to the back
};

}  // namespace

std::vector<std::string> name_panels(const Sheet& sheet, const Tree& tree) {
    return Namer(sheet, tree).run();
}

}  // namespace popup::folded
