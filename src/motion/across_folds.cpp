#include "motion/across_folds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

#include "base/geometry/edge_index.h"
#include "base/geometry/pages.h"
#include "base/geometry/regions.h"
#include "base/geometry/tolerances.h"
#include "base/nth.h"
#include "motion/sweep.h"
#include "popup/motion.h"

namespace popup {
namespace {

// Openings, of 180°, at which it is looked to which side folds turn.
constexpr std::array kLooksDeg{150.0, 90.0, 20.0};
constexpr double kBesideFoldMm = 0.02;    // of a line, where there must be paper
constexpr double kLeastStretchMm = 0.02;  // of a line
constexpr int kRoundCorners = 90;         // of what is reached at any turn; less than 0.1 % of it is left out

using Line = std::vector<Vec2>;

// All that it reaches while it is turned.
Polygon turned_about(Vec2 rivet, const Polygon& outline) {
    double radius = 0.0;
    for (const Vec2 p : outline.outer) radius = std::max(radius, distance(p, rivet));
    Polygon made;
    for (int i = 0; i < kRoundCorners; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / kRoundCorners;
        made.outer.push_back(rivet + radius * Vec2{std::cos(angle), std::sin(angle)});
    }
    return made;
}

std::vector<Line> clipped(const std::vector<Line>& lines, const std::vector<Polygon>& areas) {
    std::vector<Line> result;
    for (const Polygon& area : areas) {
        for (const Line& line : lines) {
            for (Line& part : clip_line(line, area)) result.push_back(std::move(part));
        }
    }
    return result;
}

std::vector<Line> shifted(std::vector<Line> lines, Vec2 by) {
    for (Line& line : lines) {
        for (Vec2& p : line) p = p + by;
    }
    return lines;
}

// The longest of them, if it counts.
std::optional<Segment> longest(const std::vector<Line>& lines) {
    std::optional<Segment> found;
    double most = kLeastStretchMm;
    for (const Line& line : lines) {
        const double here = distance(line.front(), line.back());
        if (here < most) continue;
        most = here;
        found = Segment{line.front(), line.back()};
    }
    return found;
}

// Folds and seams of a plate, on its page.
struct Edge {
    int other = 0;
    Segment at;
    bool glued = false;
    bool on_back = false;  // of a seam: on that side of the plate
};
struct Edges {
    std::vector<Edge> all;
    EdgeIndex index;
};

class Search {
 public:
    explicit Search(const Assembly& assembly) : assembly_(assembly) {}

    std::vector<AcrossFold> run() {
        const std::vector<Plate>& plates = assembly_.plates;
        for (std::size_t i = 0; i < plates.size(); ++i) {
            if (lies_flat(plates[i])) flat_.push_back(static_cast<int>(i));
        }
        if (flat_.empty() || !place_all()) return {};
        gather_edges();
        for (const int plate : flat_) look_at(plate);
        std::sort(found_.begin(), found_.end(), [](const AcrossFold& a, const AcrossFold& b) {
            return std::pair(a.plate, a.through) < std::pair(b.plate, b.through);
        });
        return std::move(found_);
    }

 private:
    static bool lies_flat(const Plate& plate) {
        return plate.parent >= 0 && (plate.lying == Lying::on_front || plate.lying == Lying::on_back);
    }
    [[nodiscard]] const Plate& plate(int number) const { return nth(assembly_.plates, number); }

    bool place_all() {
        for (std::size_t i = 0; i < kLooksDeg.size(); ++i) {
            looks_[i].resize(assembly_.plates.size());
            if (!place(assembly_, Angle::degrees(opening_at(assembly_.sweep, kLooksDeg[i])), looks_[i]))
                return false;
        }
        return true;
    }

    // Of plates on which something lies, and of those below.
    void gather_edges() {
        for (const int number : flat_) {
            for (int at = number; lies_flat(plate(at)); at = plate(at).parent) edges_[plate(at).parent];
        }
        const auto add = [this](int on, Edge edge) {
            if (const auto found = edges_.find(on); found != edges_.end()) {
                found->second.index.insert(edge.at, false);
                found->second.all.push_back(edge);
            }
        };
        for (const Hinge& hinge : assembly_.hinges) {
            if (hinge.glued) continue;
            add(hinge.a, {hinge.b, hinge.a_line});
            add(hinge.b, {hinge.a, hinge.b_line});
        }
        for (const Glue& glue : assembly_.glue)
            add(glue.base_plate, {glue.piece_plate, glue.on_base, true, glue.on_back});
    }

    // It is held against the folds of all that it lies on, one below the other.
    void look_at(int number) {
        const Plate& flat = plate(number);
        const Polygon reached = flat.rivet ? turned_about(*flat.rivet, flat.outline) : flat.outline;
        for (int at = number; lies_flat(plate(at)); at = plate(at).parent) {
            const int on = plate(at).parent;
            const std::vector<Frame>& frames = looks_.front();
            const Polygon here = on_other_page(reached, nth(frames, number), nth(frames, on));
            std::vector<int> near;
            const Edges& edges = edges_.at(on);
            edges.index.query(bounds(here.outer), near);
            if (near.empty()) continue;
            // What only touches a fold ends there.
            const std::vector<Polygon> inner = offset({here}, -kTouchMm, Corners::sharp);
            const bool on_back = plate(at).lying == Lying::on_back;
            for (const int edge : near) look_at(number, on, on_back, inner, nth(edges.all, edge));
        }
    }

    void look_at(int number, int on, bool on_back, const std::vector<Polygon>& inner, const Edge& edge) {
        if (edge.other == number) return;
        if (edge.glued) {
            if (!plate(number).rivet || edge.on_back != on_back) return;
            if (const auto at = longest(clipped({{edge.at.a, edge.at.b}}, inner)))
                keep({number, on, edge.other, *at, 0.0, true});
            return;
        }
        const Vec2 along = unit(edge.at.b - edge.at.a);
        for (const Vec2 beyond : {Vec2{-along.y, along.x}, Vec2{along.y, -along.x}}) {
            const auto beside = [&](Vec2 by, std::vector<Line> lines, int paper) {
                return clipped(clipped(shifted(std::move(lines), by), {plate(paper).outline}), inner);
            };
            const std::vector<Line> there =
                beside(kBesideFoldMm * beyond, {{edge.at.a, edge.at.b}}, edge.other);
            if (there.empty()) continue;
            auto at = longest(beside(-2.0 * kBesideFoldMm * beyond, there, on));
            if (!at || !turns_to(on, edge, beyond, on_back)) continue;
            at = Segment{at->a + kBesideFoldMm * beyond, at->b + kBesideFoldMm * beyond};
            double by = 0.0;
            for (const Polygon& part : intersect(inner, {plate(edge.other).outline})) {
                for (const Vec2 p : part.outer) by = std::max(by, dot(p - edge.at.a, beyond));
            }
            keep({number, on, edge.other, *at, by + kTouchMm, false});
            return;
        }
    }

    // Whether the paper beyond a fold is turned to one side of a plate.
    [[nodiscard]] bool turns_to(int on, const Edge& edge, Vec2 beyond, bool back) const {
        const Ring& ring = plate(edge.other).outline.outer;
        const Vec2 furthest = *std::max_element(
            ring.begin(), ring.end(), [&](Vec2 p, Vec2 q) { return dot(p, beyond) < dot(q, beyond); });
        return std::any_of(looks_.begin(), looks_.end(), [&](const std::vector<Frame>& frames) {
            const Frame& page = nth(frames, on);
            const double rises = dot(nth(frames, edge.other).point(furthest) - page.origin, page.normal());
            return (back ? -rises : rises) > kTouchMm;
        });
    }

    void keep(const AcrossFold& one) {
        const auto same = std::find_if(found_.begin(), found_.end(), [&](const AcrossFold& other) {
            return other.plate == one.plate && other.through == one.through;
        });
        if (same == found_.end()) {
            found_.push_back(one);
        } else if (distance(one.at.a, one.at.b) > distance(same->at.a, same->at.b)) {
            *same = one;
        }
    }

    const Assembly& assembly_;
    std::vector<int> flat_;
    std::array<std::vector<Frame>, kLooksDeg.size()> looks_;
    std::map<int, Edges> edges_;
    std::vector<AcrossFold> found_;
};

}  // namespace

std::vector<AcrossFold> find_across_folds(const Assembly& assembly) { return Search(assembly).run(); }

}  // namespace popup
