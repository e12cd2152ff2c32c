#include "folded/carton/vertices.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <map>
#include <set>
#include <utility>

#include "base/nth.h"

namespace popup::folded {
namespace {

constexpr double kAllowancesMm = 10.0;  // allowances for board of 3 mm part corners by about so much
constexpr double kMeetShare = 0.01;     // of the sheet
constexpr std::string_view kPiece = "sheet/";
constexpr double kLeastTurn = 0.26;  // sine: an outline that turns by less has no corner there

}  // namespace

// Numbers by their places.
class Vertices::Grid {
 public:
    explicit Grid(double size) : size_(size) {}
    void add(Vec3 at, int number) { cells_[cell_of(at)].push_back(number); }
    template <typename Visit>
    void near(Vec3 at, const Visit& visit) const {
        const Cell middle = cell_of(at);
        for (long x = middle[0] - 1; x <= middle[0] + 1; ++x) {
            for (long y = middle[1] - 1; y <= middle[1] + 1; ++y) {
                for (long z = middle[2] - 1; z <= middle[2] + 1; ++z) {
                    const auto found = cells_.find({x, y, z});
                    if (found == cells_.end()) continue;
                    for (const int number : found->second) visit(number);
                }
            }
        }
    }

 private:
    using Cell = std::array<long, 3>;
    [[nodiscard]] Cell cell_of(Vec3 at) const {
        return {std::lround(std::floor(at.x / size_)), std::lround(std::floor(at.y / size_)),
                std::lround(std::floor(at.z / size_))};
    }

    double size_;
    std::map<Cell, std::vector<int>> cells_;
};

Vertices::Vertices(ApartShape apart) : apart_(std::move(apart)), state_(apart_.shape.state()) {
    meet_mm_ = std::min(kAllowancesMm, kMeetShare * sheet().size());
    places_.assign(sheet().corners.size(), Vec3{});
    double whole = 0.0;
    for (const int panel : tree().order) {
        const std::vector<int>& own = nth(corners(), panel);
        for (auto one = own.rbegin(); one != own.rend(); ++one)
            nth(places_, *one) = state_.place({panel, *one});
        const Box box = bounds(sheet().outline_of(nth(sheet().panels, panel)).outer);
        const double size = area(sheet().outline_of(nth(sheet().panels, panel)));
        middle_ = middle_ + size * state_.frame(panel).point({box.centre().x, box.centre().y, 0.0});
        whole += size;
    }
    if (whole > 0.0) middle_ = (1.0 / whole) * middle_;
    const std::vector<std::string>& names = apart_.shape.names;
    const bool one_piece = std::all_of(names.begin(), names.end(),
                                       [](const std::string& name) { return name.starts_with(kPiece); });
    for (const std::string& name : names) names_.push_back(one_piece ? name.substr(kPiece.size()) : name);
    find_vertices();
    name_corners();
}

const std::string& Vertices::name_of(int panel) const { return nth(names_, panel); }
const std::string& Vertices::full_name_of(int panel) const { return nth(apart_.shape.names, panel); }
int Vertices::vertex_of(int corner) const { return nth(vertex_of_, corner); }
const std::vector<int>& Vertices::named(int panel) const { return nth(named_, panel); }
Vec3 Vertices::place(int corner) const { return nth(places_, corner); }

bool Vertices::is_free(int vertex) const { return nth(free_, vertex) != 0; }

int Vertices::parent(int panel) const {
    const int number = nth(tree().fold_of, panel);
    if (number < 0) return -1;
    const Fold& fold = nth(sheet().folds, number);
    return fold.left == panel ? fold.right : fold.left;
}

int Vertices::find(std::string_view name) const {
    for (std::size_t i = 0; i < names_.size(); ++i) {
        if (names_[i] == name || apart_.shape.names[i] == name) return static_cast<int>(i);
    }
    return -1;
}

Vec3 Vertices::out(int panel) const {
    const Box box = bounds(sheet().outline_of(nth(sheet().panels, panel)).outer);
    const Vec3 from = state_.frame(panel).point({box.centre().x, box.centre().y, 0.0}) - middle_;
    const Vec3 normal = state_.normal(panel);
    return dot(from, normal) < 0.0 ? -normal : normal;
}

void Vertices::find_vertices() {
    std::set<int> in_hole;
    for (const Panel& panel : sheet().panels) {
        for (const std::vector<int>& hole : panel.holes) in_hole.insert(hole.begin(), hole.end());
    }
    std::vector<int> ends;
    for (const Fold& fold : sheet().folds) {
        for (const int corner : {fold.stretches.front().a, fold.stretches.back().b}) {
            if (!in_hole.contains(corner)) ends.push_back(corner);
        }
    }
    std::sort(ends.begin(), ends.end());
    ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
    vertex_of_.assign(sheet().corners.size(), -1);
    int count = 0;
    const Grid grid = join_near(ends, count, [](int, int) { return true; });
    // Other corners of outlines that are where a vertex is.
    std::vector<int> joined = vertex_of_;
    for (const Panel& panel : sheet().panels) {
        for (const int corner : panel.outer) {
            if (nth(vertex_of_, corner) >= 0 || in_hole.contains(corner)) continue;
            double nearest = meet_mm_;
            grid.near(place(corner), [&](int end) {
                const double far = distance(place(corner), place(end));
                if (far > nearest) return;
                nearest = far;
                nth(joined, corner) = nth(vertex_of_, end);
            });
        }
    }
    vertex_of_ = std::move(joined);
    // Those at which outlines turn, such as where the rims of two walls meet. Tips of flaps that come near
    // one another from different sides do not.
    std::vector<int> turns;
    std::vector<std::set<int>> around(sheet().panels.size());  // vertices, by panel
    std::vector<int> panel_of(sheet().corners.size(), -1);
    for (std::size_t number = 0; number < around.size(); ++number) {
        const Panel& panel = sheet().panels[number];
        for (const int corner : panel.outer) {
            nth(panel_of, corner) = static_cast<int>(number);
            if (nth(vertex_of_, corner) >= 0) around[number].insert(nth(vertex_of_, corner));
        }
        for (std::size_t i = 0; i < panel.outer.size(); ++i) {
            const int corner = panel.outer[i];
            if (nth(vertex_of_, corner) >= 0 || in_hole.contains(corner)) continue;
            const Vec2 at = sheet().at(corner);
            const Vec2 in = at - sheet().at(panel.outer[(i + panel.outer.size() - 1) % panel.outer.size()]);
            const Vec2 out = sheet().at(panel.outer[(i + 1) % panel.outer.size()]) - at;
            if (dot(in, out) < 0.0 || std::abs(cross(in, out)) > kLeastTurn * length(in) * length(out))
                turns.push_back(corner);
        }
    }
    std::sort(turns.begin(), turns.end());
    turns.erase(std::unique(turns.begin(), turns.end()), turns.end());
    const int of_folds = count;
    join_near(turns, count, [&](int a, int b) {
        if (distance(place(a), place(b)) <= kMeetsMm) return true;
        const std::set<int>& of_a = nth(around, nth(panel_of, a));
        const std::set<int>& of_b = nth(around, nth(panel_of, b));
        return std::any_of(of_a.begin(), of_a.end(), [&](int vertex) { return of_b.contains(vertex); });
    });
    members_.resize(static_cast<std::size_t>(count));
    for (const int panel : tree().order) {
        for (const int corner : nth(sheet().panels, panel).outer) {
            if (vertex_of(corner) >= 0) nth(members_, vertex_of(corner)).push_back({panel, corner});
        }
    }
    free_.assign(members_.size(), 0);
    for (std::size_t i = static_cast<std::size_t>(of_folds); i < members_.size(); ++i) {
        const std::vector<CornerOf>& own = members_[i];
        free_[i] =
            std::all_of(own.begin(), own.end(), [&](CornerOf one) { return one.panel == own.front().panel; })
                ? 1
                : 0;
    }
}

// Makes vertices of corners, which are none yet, and counts them. Those that are near, and go together, are
// one.
Vertices::Grid Vertices::join_near(const std::vector<int>& some, int& count,
                                   const std::function<bool(int, int)>& go_together) {
    Grid grid(meet_mm_);
    std::map<int, int> root;
    const auto find_root = [&](int one) {
        while (root.at(one) != one) one = root.at(one) = root.at(root.at(one));
        return one;
    };
    for (const int one : some) root[one] = one;
    for (const int one : some) {
        grid.near(place(one), [&](int other) {
            if (distance(place(one), place(other)) > meet_mm_ || !go_together(one, other)) return;
            const auto [low, high] = std::minmax({find_root(one), find_root(other)});
            root[high] = low;
        });
        grid.add(place(one), one);
    }
    std::map<int, int> number_of;
    for (const int one : some) {
        const auto [at, fresh] = number_of.try_emplace(find_root(one), count);
        if (fresh) ++count;
        nth(vertex_of_, one) = at->second;
    }
    return grid;
}

void Vertices::name_corners() {
    std::set<int> ends;
    for (const Fold& fold : sheet().folds) {
        ends.insert(fold.stretches.front().a);
        ends.insert(fold.stretches.back().b);
    }
    for (const Panel& panel : sheet().panels) {
        std::map<int, int> corner_of;  // by vertex: an end of a fold, if there is one
        for (const int corner : panel.outer) {
            if (vertex_of(corner) < 0) continue;
            const auto [at, fresh] = corner_of.try_emplace(vertex_of(corner), corner);
            if (!fresh && !ends.contains(at->second) && ends.contains(corner)) at->second = corner;
        }
        std::vector<int>& named = named_.emplace_back();
        for (const int corner : panel.outer) {
            if (vertex_of(corner) >= 0 && corner_of.at(vertex_of(corner)) == corner) named.push_back(corner);
        }
        if (named.empty()) continue;
        // The first is that at the bottom left of the drawing.
        const auto key = [&](int corner) {
            const Vec2 at = sheet().at(corner);
            return std::pair(std::round((at.x + at.y) * 1e3), std::round(at.x * 1e3));
        };
        std::rotate(
            named.begin(),
            std::min_element(named.begin(), named.end(), [&](int a, int b) { return key(a) < key(b); }),
            named.end());
    }
}

std::unique_ptr<const Vertices> vertices_of(const CreasePattern& pattern, const FoldOptions& options,
                                            const std::vector<Join>& joins, Diagnostics& diagnostics) {
    const auto rough = rough_shape(pattern, options, diagnostics);
    if (!rough) return nullptr;
    RoughShape refined = *rough;
    if (!joins.empty()) {
        const auto numbers = resolve(*rough, joins, pattern, diagnostics);
        if (!numbers) return nullptr;
        refined.angles = close_joins(rough->state(), *numbers, true).angles;
    }
    return std::make_unique<const Vertices>(cut_apart(refined));
}

}  // namespace popup::folded
