#include "input/oa/sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <utility>

#include "base/geometry/edge_index.h"
#include "base/geometry/regions.h"
#include "input/oa/come_apart.h"
#include "parts/work.h"

namespace popup::oa {
namespace {

// An edge that misses what it would stand on by less does so by mistake: webOAcard's grids are coarser.
constexpr double kMissMm = 0.5;
// A difference up to this is the rounding of a file.
constexpr double kFileRoundingMm = 0.02;

double grid(double value) { return on_grid({value, 0.0}).x; }

Polygon rectangle(double x0, double y0, double x1, double y1) {
    return {{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}, {}};
}

// An edge along the gutter: at x from y0 to y1, y0 < y1.
struct Edge {
    double x = 0.0, y0 = 0.0, y1 = 0.0;
};

// An edge that a plate runs back from, as wide as from `from` to `to`.
struct Upper {
    Edge at;
    double from = 0.0, to = 0.0;
};

enum class Side { upper, lower };

// The edges along the gutter that have their area on the one side: below upper edges, above lower ones.
template <typename Take>
void edges_along(const Ring& ring, Side side, const Take& take) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Vec2 a = ring[i];
        const Vec2 b = ring[i + 1 == ring.size() ? 0 : i + 1];
        if (a.x != b.x || a.y == b.y) continue;
        // The area is on the left.
        if ((b.y < a.y) == (side == Side::upper)) take(Edge{a.x, std::min(a.y, b.y), std::max(a.y, b.y)});
    }
}

// Polygons found by their boxes.
class Boxes {
 public:
    int add(const Polygon& polygon) {
        const Box box = bounds(polygon.outer);
        boxes_.push_back(box);
        index_.insert({box.min, box.max}, false);
        return index_.size() - 1;
    }
    template <typename Take>
    void near(const Box& box, const Take& take) {
        index_.query(box, found_);
        for (const int number : found_) take(static_cast<std::size_t>(number));
    }
    [[nodiscard]] const Box& box(std::size_t number) const { return boxes_[number]; }

 private:
    EdgeIndex index_;
    std::vector<Box> boxes_;
    std::vector<int> found_;
};

// What stands at one depth.
struct Plane {
    std::vector<Polygon> faces;  // without texts
    std::vector<Polygon> texts;  // by contour
    std::vector<Polygon> pulls;
    std::vector<Polygon> material;  // all of them
    std::vector<Upper> uppers;
    std::vector<std::pair<int, Polygon>> owners;  // which face each part came from
    Boxes owner_boxes;
};

class Layer {
 public:
    Layer(const Card& card, Diagnostics& diagnostics) : card_(card), diagnostics_(diagnostics) {}

    std::optional<Sheet> run() {
        index_holes();
        for (const Face& face : card_.faces) {
            if (face.mode != Mode::hole) add(face);
        }
        for (auto& [depth, plane] : planes_) join(depth, plane);
        for (auto& [depth, plane] : planes_) snap(depth, plane);
        for (auto& [depth, plane] : planes_) run_back(depth, plane);
        for (auto& [height, level] : levels_) level = united(std::move(level));
        cut_texts();
        share_out();
        if (!afforded_) {
            diagnostics_.error("document-too-large", {}, "too many faces overlap to lay out the sheet");
            return std::nullopt;
        }
        tell_hidden();
        return std::move(sheet_);
    }

 private:
    // --- booleans, as long as there is work left

    bool afford(const std::vector<Polygon>& a, const std::vector<Polygon>& b) {
        return afforded_ = afforded_ && work_.sweep(a) && work_.sweep(b);
    }
    std::vector<Polygon> united(std::vector<Polygon> all) {
        if (all.empty() || !afford(all, {})) return all;
        return come_apart(unite(all));
    }
    std::vector<Polygon> without(std::vector<Polygon> from, const std::vector<Polygon>& what) {
        if (from.empty() || what.empty() || !afford(from, what)) return from;
        // What only touches along an edge is one ring until it is united.
        return come_apart(unite(subtract(from, what)));
    }
    std::vector<Polygon> common(const std::vector<Polygon>& a, const std::vector<Polygon>& b) {
        if (a.empty() || b.empty() || !afford(a, b)) return {};
        return intersect(a, b);
    }

    [[nodiscard]] double half() const { return 0.5 * card_.width; }
    [[nodiscard]] static std::string path_of(int face) { return fmt::format("faces[{}]", face); }

    // --- faces and holes

    void index_holes() {
        for (const Face& face : card_.faces) {
            if (face.mode != Mode::hole) continue;
            for (const Contour& contour : face.contours) {
                for (const Polygon& part : contour.area) {
                    hole_boxes_.add(part);
                    holes_.push_back({&face, part});
                }
            }
        }
    }

    static bool cuts(const Face& hole, const Face& face) {
        if (face.depth != hole.depth) return face.depth < hole.depth;
        return face.timestamp == 0.0 || face.timestamp < hole.timestamp;
    }

    void add(const Face& face) {
        const Polygon room =
            rectangle(-card_.height, grid(-half()), std::min(face.depth, card_.height), grid(half()));
        double beyond = 0.0;
        bool any = false;
        for (const Contour& contour : face.contours) {
            for (const Polygon& part : contour.area) {
                const Box box = bounds(part.outer);
                beyond =
                    std::max({beyond, -card_.height - box.min.x, box.max.y - half(), -half() - box.min.y});
            }
            std::vector<Polygon> area = common(contour.area, {room});
            for (const Polygon& part : area) {
                std::vector<Polygon> cut;
                hole_boxes_.near(bounds(part.outer), [&](std::size_t number) {
                    const auto& [hole, shape] = holes_[number];
                    if (!hole->text && cuts(*hole, face)) cut.push_back(shape);
                });
                for (Polygon& left : without({part}, cut)) {
                    any = true;
                    take(face, std::move(left));
                }
            }
        }
        if (!any) {
            diagnostics_
                .warning(
                    "oa-hidden", face.place,
                    fmt::format("nothing is left of {}: it lies outside of the card, below the floor, or "
                                "where a hole is",
                                path_of(face.number)))
                .hint("of a plate that stands at t only what has Y below t is above the floor");
            shown_[face.number] = true;  // told already
            return;
        }
        shown_[face.number] = false;
        if (beyond > kFileRoundingMm) {
            diagnostics_.remark("oa-clipped", face.place,
                                fmt::format("{} reaches {:.2f} mm beyond the edge of the card, and is cut "
                                            "off there",
                                            path_of(face.number), beyond));
        }
    }

    void take(const Face& face, Polygon part) {
        Plane& plane = planes_[face.depth];
        plane.owner_boxes.add(part);
        plane.owners.emplace_back(face.number, part);
        auto& into = face.mode == Mode::pull ? plane.pulls : face.text ? plane.texts : plane.faces;
        into.push_back(std::move(part));
    }

    // --- planes, and the edges that plates run back from

    void join(double depth, Plane& plane) {
        plane.faces = united(std::move(plane.faces));
        for (const Polygon& pull : plane.pulls) {
            for (const Ring& hole : pull.holes) add_uppers(depth, plane, hole, true);
        }
        if (plane.texts.empty()) {
            for (const Polygon& part : plane.faces) {
                add_uppers(depth, plane, part.outer, false);
                for (const Ring& hole : part.holes) add_uppers(depth, plane, hole, true);
            }
        } else {
            join_texts(depth, plane);
        }
        plane.material = plane.faces;
        plane.material.insert(plane.material.end(), plane.pulls.begin(), plane.pulls.end());
        plane.material = united(std::move(plane.material));
    }

    void add_uppers(double depth, Plane& plane, const Ring& ring, bool opening) {
        const Box box = bounds(ring);
        edges_along(ring, Side::upper, [&](const Edge& edge) {
            plane.uppers.push_back({edge, opening ? box.min.y : edge.y0, opening ? box.max.y : edge.y1});
            by_height_[grid(depth - edge.x)].emplace_back(depth, edge);
        });
    }

    // Edges of the whole that are edges of a face, or the topmost of a text's contour.
    void join_texts(double depth, Plane& plane) {
        std::map<double, std::vector<std::pair<double, double>>> hold;
        const auto note = [&hold](const Edge& edge) { hold[edge.x].emplace_back(edge.y0, edge.y1); };
        for (const Polygon& part : plane.faces) {
            edges_along(part.outer, Side::upper, note);
            for (const Ring& hole : part.holes) edges_along(hole, Side::upper, note);
        }
        for (const Polygon& text : plane.texts) {
            std::vector<Edge> edges;
            edges_along(text.outer, Side::upper, [&edges](const Edge& edge) { edges.push_back(edge); });
            double top = HUGE_VAL;
            for (const Edge& edge : edges) top = std::min(top, edge.x);
            for (const Edge& edge : edges) {
                if (edge.x == top) note(edge);
            }
        }
        plane.faces.insert(plane.faces.end(), plane.texts.begin(), plane.texts.end());
        plane.faces = united(std::move(plane.faces));
        const auto keep = [&](const Ring& ring, bool opening) {
            const Box box = bounds(ring);
            edges_along(ring, Side::upper, [&](const Edge& edge) {
                const auto found = hold.find(edge.x);
                if (found == hold.end()) return;
                for (const auto& [from, to] : found->second) {
                    const Edge both{edge.x, std::max(edge.y0, from), std::min(edge.y1, to)};
                    if (!(both.y1 - both.y0 > kTouchMm)) continue;
                    plane.uppers.push_back(
                        {both, opening ? box.min.y : both.y0, opening ? box.max.y : both.y1});
                    by_height_[grid(depth - edge.x)].emplace_back(depth, both);
                }
            });
        };
        for (const Polygon& part : plane.faces) {
            keep(part.outer, false);
            for (const Ring& hole : part.holes) keep(hole, true);
        }
    }

    // Lower edges that miss the floor, or a plate that runs back below them, are drawn down to it.
    void snap(double depth, Plane& plane) {
        std::vector<Polygon> grown;
        for (const Polygon& part : plane.material) {
            edges_along(part.outer, Side::lower, [&](const Edge& edge) {
                const double gap = gap_below(depth, edge);
                // A gap of one step counts: with rounding on top of it the fold would come apart.
                if (!(gap > 0.5 * kGridMm)) return;
                grown.push_back(rectangle(edge.x, edge.y0, grid(edge.x + gap), edge.y1));
                const int face = owner(plane, {edge.x, 0.5 * (edge.y0 + edge.y1)});
                if (gap <= kFileRoundingMm || !snapped_.emplace(face, edge.x).second) return;
                const double height = depth - edge.x;
                diagnostics_
                    .warning("oa-snapped", card_.place_of(face),
                             fmt::format("the lower edge of {} at Y {:.3f} ends {:.3f} mm above {}; it was "
                                         "drawn down to it",
                                         path_of(face), edge.x, gap,
                                         height - gap <= kGridMm ? "the floor" : "the plate below it"))
                    .hint(fmt::format("give that edge Y {:.3f}", edge.x + gap))
                    .changed(fmt::format("Y {:.3f} mm", edge.x), fmt::format("Y {:.3f} mm", edge.x + gap));
            });
        }
        if (grown.empty()) return;
        grown.insert(grown.end(), plane.material.begin(), plane.material.end());
        plane.material = united(std::move(grown));
    }

    // How far below the edge something lies that it should stand on; 0: nothing, or it stands.
    double gap_below(double depth, const Edge& edge) {
        const double height = grid(depth - edge.x);
        if (!(height > 0.0)) return 0.0;
        double gap = HUGE_VAL;
        if (height <= kMissMm) gap = height;
        for (auto level = by_height_.lower_bound(height - kMissMm);
             level != by_height_.end() && level->first <= height; ++level) {
            for (const auto& [from, upper] : level->second) {
                const bool below =
                    from > depth && upper.y0 < edge.y1 - kTouchMm && upper.y1 > edge.y0 + kTouchMm;
                if (below) gap = std::min(gap, height - level->first);
            }
        }
        return gap <= kMissMm ? gap : 0.0;
    }

    static int owner(Plane& plane, Vec2 at) {
        int first = -1;
        plane.owner_boxes.near({at, at}, [&](std::size_t number) {
            const auto& [face, part] = plane.owners[number];
            if (contains(part, at) && (first < 0 || face < first)) first = face;
        });
        return first < 0 ? plane.owners.front().first : first;
    }

    // --- what lies

    // What stands, by boxes, from all planes; made anew where there is more.
    void index_planes() {
        if (indexed_) return;
        indexed_ = true;
        for (const auto& [depth, plane] : planes_) {
            for (const Polygon& part : plane.material) {
                standing_boxes_.add(part);
                standing_.emplace_back(depth, &part);
            }
        }
    }

    void run_back(double depth, const Plane& plane) {
        index_planes();
        for (const Upper& upper : plane.uppers) {
            const double x = upper.at.x;
            const double behind = std::max(grid(x - depth), -card_.height);
            if (!(x > behind)) continue;
            const Polygon whole = rectangle(behind, upper.from, x, upper.to);
            std::vector<Polygon> blocked;
            standing_boxes_.near(bounds(whole.outer), [&](std::size_t number) {
                const auto& [other, part] = standing_[number];
                if (other >= depth) {
                    blocked.push_back(*part);
                    return;
                }
                // It passes before what stands nearer to the back, and ends there.
                const double there = grid(x - (depth - other));
                if (!(there > behind) || standing_boxes_.box(number).min.x >= there) return;
                for (Polygon& rest : common({*part}, {rectangle(behind, upper.from, there, upper.to)}))
                    blocked.push_back(std::move(rest));
            });
            for (Polygon& part : without({whole}, blocked)) {
                if (holds(part, upper.at)) levels_[grid(depth - x)].push_back(std::move(part));
            }
        }
    }

    static bool holds(const Polygon& part, const Edge& upper) {
        bool does = false;
        edges_along(part.outer, Side::lower, [&](const Edge& edge) {
            does = does || (edge.x == upper.x &&
                            std::min(edge.y1, upper.y1) - std::max(edge.y0, upper.y0) > kTouchMm);
        });
        return does;
    }

    // Openings that are texts are cut at last: nothing runs back from their edges.
    void cut_texts() {
        for (auto& [depth, plane] : planes_) {
            std::vector<Polygon> left;
            for (const Polygon& part : plane.material) {
                std::vector<Polygon> cut;
                const double own = depth;
                hole_boxes_.near(bounds(part.outer), [&](std::size_t number) {
                    const auto& [hole, shape] = holes_[number];
                    if (hole->text && own <= hole->depth) cut.push_back(shape);
                });
                for (Polygon& rest : without({part}, cut)) left.push_back(std::move(rest));
            }
            plane.material = std::move(left);
        }
    }

    // --- who has the paper

    struct Claim {
        bool upright;
        double offset;
        const Polygon* area;
    };

    void share_out() {
        std::vector<Claim> claims;  // what comes later gives way
        for (auto level = levels_.rbegin(); level != levels_.rend(); ++level) {
            for (const Polygon& part : level->second) claims.push_back({false, level->first, &part});
        }
        for (auto plane = planes_.rbegin(); plane != planes_.rend(); ++plane) {
            for (const Polygon& part : plane->second.material) claims.push_back({true, plane->first, &part});
        }
        Boxes boxes;
        for (const Claim& claim : claims) boxes.add(*claim.area);
        std::vector<Polygon> all;
        all.reserve(claims.size());
        for (const Claim& claim : claims) all.push_back(*claim.area);
        const double w = grid(half());
        rest(true, rectangle(-card_.height, -w, 0.0, w), all);
        rest(false, rectangle(0.0, -w, card_.height, w), all);

        std::vector<std::vector<Polygon>> left(claims.size());
        for (std::size_t i = 0; i < claims.size(); ++i) {
            const Claim& own = claims[i];
            std::vector<Polygon> before;
            boxes.near(boxes.box(i), [&](std::size_t number) {
                const Claim& other = claims[number];
                if (number < i && (other.upright != own.upright || other.offset != own.offset))
                    before.push_back(*other.area);
            });
            left[i] = without({*own.area}, before);
        }
        // From the farthest to the nearest, and from the lowest up.
        std::vector<std::size_t> order(claims.size());
        for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
        std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
            return std::pair(!claims[a].upright, claims[a].offset) <
                   std::pair(!claims[b].upright, claims[b].offset);
        });
        for (const std::size_t i : order) {
            for (Polygon& part : left[i]) {
                if (popup::area(part) < kSpeckMm * kSpeckMm) continue;
                const int face = claims[i].upright ? owner_of(claims[i].offset, part) : -1;
                if (face >= 0) shown_[face] = true;
                sheet_.regions.push_back(
                    {claims[i].upright, claims[i].offset, std::move(part), face, !claims[i].upright});
            }
        }
    }

    // What back or floor keep, and how much of each part lies in holes.
    void rest(bool upright, const Polygon& whole, const std::vector<Polygon>& taken) {
        for (Polygon& part : without({whole}, taken)) {
            std::vector<Polygon> cut;
            hole_boxes_.near(bounds(part.outer),
                             [&](std::size_t number) { cut.push_back(holes_[number].second); });
            const double open = popup::area(common({part}, cut));
            sheet_.regions.push_back({upright, 0.0, std::move(part), -1, false, open});
        }
    }

    // A plate is named after the first face that it shows a part of.
    int owner_of(double depth, const Polygon& part) {
        Plane& plane = planes_.at(depth);
        int first = -1;
        plane.owner_boxes.near(bounds(part.outer), [&](std::size_t number) {
            const auto& [face, shape] = plane.owners[number];
            if (popup::area(common({part}, {shape})) < kTouchMm * kTouchMm) return;
            shown_[face] = true;
            if (first < 0 || face < first) first = face;
        });
        return first < 0 ? plane.owners.front().first : first;
    }

    void tell_hidden() {
        for (const auto& [face, is_shown] : shown_) {
            if (is_shown) continue;
            diagnostics_
                .warning("oa-hidden", card_.place_of(face),
                         fmt::format("nothing is seen of {}: plates before and above it have all its paper",
                                     path_of(face)))
                .hint("take it out, or move it to where nothing covers it on the sheet");
        }
    }

    const Card& card_;
    Diagnostics& diagnostics_;
    Work work_;
    bool afforded_ = true;
    std::vector<std::pair<const Face*, Polygon>> holes_;
    Boxes hole_boxes_;
    std::map<double, Plane> planes_;                 // by depth
    std::map<double, std::vector<Polygon>> levels_;  // what lies, by height
    // The edges that plates run back from, by the height of these: their depth, and where they are.
    std::map<double, std::vector<std::pair<double, Edge>>> by_height_;
    bool indexed_ = false;
    std::vector<std::pair<double, const Polygon*>> standing_;
    Boxes standing_boxes_;
    std::set<std::pair<int, double>> snapped_;  // faces, and which of their lower edges
    std::map<int, bool> shown_;                 // of faces and pulls: whether a part of it is seen
    Sheet sheet_;
};

}  // namespace

std::optional<Sheet> lay_out_sheet(const Card& card, Diagnostics& diagnostics) {
    return Layer(card, diagnostics).run();
}

}  // namespace popup::oa
