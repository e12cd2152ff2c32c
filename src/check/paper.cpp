#include "check/paper.h"

#include <algorithm>
#include <array>
#include <map>

#include "base/geometry/regions.h"
#include "mechanism/site_lines.h"
#include "mechanism/thin_places.h"

namespace popup {
namespace {

constexpr double kOnLine = 1e-6;  // mm: edges this close to the fold's line lie along it

bool along_line(const DirectedLine& line, const Segment& s) {
    return std::abs(cross(line.dir, s.a - line.at)) < kOnLine &&
           std::abs(cross(line.dir, s.b - line.at)) < kOnLine;
}

Box box_around(std::span<const Vec2> points, double margin) {
    Box box;
    for (const Vec2 p : points) {
        box.extend(p + Vec2{margin, margin});
        box.extend(p - Vec2{margin, margin});
    }
    return box;
}

// Distance from a segment to a region; 0 when it enters it.
double region_distance(const Ring& ring, const Segment& s) {
    if (contains({ring, {}}, s.a)) return 0.0;
    double best = HUGE_VAL;
    for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
        best = std::min(best, distance(Segment{ring[j], ring[i]}, s));
    }
    return best;
}

bool near_ring(const Ring& ring, Vec2 p, double slack) {
    for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
        if (distance(p, Segment{ring[j], ring[i]}) <= slack) return true;
    }
    return false;
}

bool inside(const Polygon& outline, Vec2 p, double slack) {
    return contains(outline, p) || near_ring(outline.outer, p, slack) ||
           std::any_of(outline.holes.begin(), outline.holes.end(),
                       [&](const Ring& hole) { return near_ring(hole, p, slack); });
}

}  // namespace

PaperMap::PageEdges& PaperMap::page(int number) {
    while (pages_.size() <= static_cast<std::size_t>(number)) pages_.emplace_back();
    return pages_[static_cast<std::size_t>(number)];
}

void PaperMap::PageEdges::query(const Box& box, std::vector<int>& found) const {
    found.clear();
    std::vector<int> near;
    runs.query(box, near);
    for (const int run : near) {
        const auto number = static_cast<std::size_t>(run);
        const std::size_t end = number + 1 < run_begins.size() ? run_begins[number + 1] : edges.size();
        for (std::size_t i = run_begins[number]; i < end; ++i) {
            const Segment& s = edges[i];
            if (std::max(s.a.x, s.b.x) >= box.min.x && std::min(s.a.x, s.b.x) <= box.max.x &&
                std::max(s.a.y, s.b.y) >= box.min.y && std::min(s.a.y, s.b.y) <= box.max.y)
                found.push_back(static_cast<int>(i));
        }
    }
}

void PaperMap::add(int page_number, std::span<const Segment> edges, int plate, bool seam, int hole) {
    constexpr std::size_t kRun = 8;
    PageEdges& there = page(page_number);
    if (there.edges.capacity() == 0) {
        // Most pages are of one piece, with two plates and their seams.
        constexpr std::size_t kPiece = 16;
        there.edges.reserve(kPiece);
        there.obstacles.reserve(kPiece);
        there.run_begins.reserve(kPiece / 2);
    }
    for (std::size_t begin = 0; begin < edges.size(); begin += kRun) {
        there.run_begins.push_back(there.edges.size());
        Box box;
        for (const Segment& edge : edges.subspan(begin, std::min(kRun, edges.size() - begin))) {
            box.extend(edge.a);
            box.extend(edge.b);
            there.edges.push_back(edge);
            there.obstacles.push_back({plate, seam, owner_, hole});
        }
        there.runs.insert({box.min, box.max}, false);
    }
}

void PaperMap::update(const Skeleton& skeleton, int owner) {
    owner_ = owner;
    std::vector<Segment> edges;
    const auto add_ring = [&](int number, const Ring& ring, int plate, int hole = -1) {
        edges.clear();
        for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++)
            edges.push_back({ring[j], ring[i]});
        add(number, edges, plate, false, hole);
    };
    for (std::size_t plate = outlines_.size(); plate < skeleton.draft.plates.size(); ++plate) {
        outlines_.push_back(skeleton.draft.plates[plate].outline);
        cuts_seen_.push_back(0);
        add_ring(skeleton.plate_page[plate], outlines_.back().outer, static_cast<int>(plate));
        for (const Ring& hole : outlines_.back().holes)
            add_ring(skeleton.plate_page[plate], hole, static_cast<int>(plate));
    }
    for (; areas_seen_ < skeleton.draft.glued_areas.size(); ++areas_seen_) {
        const GluedArea& area = skeleton.draft.glued_areas[areas_seen_];
        const int number = skeleton.plate_page[static_cast<std::size_t>(area.base_plate)];
        for (const Polygon& part : area.on_base) {
            add(number, edges_of(part), area.base_plate, true);
            const Box box = bounds(part.outer);
            page(number).glued_boxes.insert({box.min, box.max}, false);
            page(number).glued.push_back(static_cast<int>(areas_seen_));
        }
    }
    for (; feet_seen_ < skeleton.feet.size(); ++feet_seen_) {
        const Foot& foot = skeleton.feet[feet_seen_];
        add(skeleton.plate_page[static_cast<std::size_t>(foot.plate)], std::array{foot.seam, foot.inside},
            foot.plate, true);
    }
    for (; holes_seen_ < skeleton.holes.size(); ++holes_seen_) {
        const Hole& hole = skeleton.holes[holes_seen_];
        const int number = skeleton.plate_page[static_cast<std::size_t>(hole.plate)];
        PageEdges& there = page(number);
        add_ring(number, hole.ring, hole.plate, static_cast<int>(there.cuts.size()));
        const Box box = bounds(hole.ring);
        there.cut_boxes.insert({box.min, box.max}, false);
        there.cuts.emplace_back(hole.plate, hole.ring);
    }
    for (; folds_seen_ < skeleton.folds.size(); ++folds_seen_) {
        const Fold& fold = skeleton.folds[folds_seen_];
        // Only the plates that lost paper or got a seam have changed: those on either side of a new fold.
        for (const auto& [plate, number, at] :
             {std::tuple{fold.left_plate, fold.left_page, fold.on_left},
              std::tuple{fold.right_plate, fold.right_page, fold.on_right}}) {
            const auto index = static_cast<std::size_t>(plate);
            if (fold.seam) add(number, {&at, 1}, plate, true);
            for (std::size_t& seen = cuts_seen_[index]; seen < skeleton.cut_outs[index].size(); ++seen) {
                const Ring& ring = skeleton.cut_outs[index][seen].path;
                add_ring(number, ring, plate);
                const Box box = bounds(ring);
                PageEdges& there = page(number);
                there.cut_boxes.insert({box.min, box.max}, false);
                there.cuts.emplace_back(plate, ring);
            }
        }
    }
}

bool PaperMap::may_cut(int plate, int page_number, const DirectedLine& line, bool is_seam,
                       const Ring& footprint, Fit fit, const Segment* open) const {
    const PageEdges& page_edges = pages_[static_cast<std::size_t>(page_number)];
    const Polygon& outline = outlines_[static_cast<std::size_t>(plate)];
    if (!std::all_of(footprint.begin(), footprint.end(), [&](Vec2 p) { return inside(outline, p, kOnLine); }))
        return false;
    const double around = tolerances_.paper_mm - (fit == Fit::exact ? 0.0 : tolerances_.rounding_mm);
    const double off_seams = (fit == Fit::exact ? 2.0 : 1.0) * tolerances_.rounding_mm;
    std::vector<int> found;
    page_edges.query(box_around(footprint, tolerances_.paper_mm), found);
    return std::none_of(found.begin(), found.end(), [&](int number) {
        const Obstacle& obstacle = page_edges.obstacles[static_cast<std::size_t>(number)];
        const Segment& edge = page_edges.edges[static_cast<std::size_t>(number)];
        if (obstacle.plate != plate) return false;
        if ((is_seam || !obstacle.seam) && along_line(line, edge)) return false;
        if (open != nullptr && along_line({open->a, unit(open->b - open->a)}, edge)) return false;
        return region_distance(footprint, edge) < (obstacle.seam ? off_seams : around);
    });
}

std::vector<Polygon> PaperMap::paper_near(int plate, int page_number, double inset, const Box& near) const {
    const PageEdges& page_edges = pages_[static_cast<std::size_t>(page_number)];
    const double around = inset + tolerances_.rounding_mm;
    std::vector<int> found;
    if (!near.empty())
        page_edges.cut_boxes.query({near.min - Vec2{around, around}, near.max + Vec2{around, around}}, found);
    std::sort(found.begin(), found.end());
    std::vector<Polygon> cuts;
    for (const int number : found) {
        const auto& [owner, ring] = page_edges.cuts[static_cast<std::size_t>(number)];
        if (owner != plate) continue;
        cuts.push_back({ring, {}});
        if (signed_area(ring) < 0.0) std::reverse(cuts.back().outer.begin(), cuts.back().outer.end());
    }
    std::vector<Polygon> paper = subtract({outlines_[static_cast<std::size_t>(plate)]}, cuts);
    return inset > 0.0 ? offset(paper, -inset, Corners::sharp) : paper;
}

std::vector<int> PaperMap::glued_near(int page_number, const Box& box) const {
    const PageEdges& page_edges = pages_[static_cast<std::size_t>(page_number)];
    std::vector<int> found;
    page_edges.glued_boxes.query(box, found);
    for (int& number : found) number = page_edges.glued[static_cast<std::size_t>(number)];
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
}

bool PaperMap::seam_near(int page_number, const Ring& ring) const {
    const PageEdges& page_edges = pages_[static_cast<std::size_t>(page_number)];
    std::vector<int> found;
    page_edges.query(box_around(ring, tolerances_.rounding_mm), found);
    return std::any_of(found.begin(), found.end(), [&](int number) {
        return page_edges.obstacles[static_cast<std::size_t>(number)].seam &&
               region_distance(ring, page_edges.edges[static_cast<std::size_t>(number)]) <=
                   tolerances_.rounding_mm;
    });
}

bool PaperMap::is_clear(int page_number, const Box& box) const {
    std::vector<int> found;
    pages_[static_cast<std::size_t>(page_number)].query(box, found);
    return found.empty();
}

bool PaperMap::has_paper(int plate, int page_number, Vec2 at) const {
    if (!contains(outlines_[static_cast<std::size_t>(plate)], at)) return false;
    const PageEdges& page_edges = pages_[static_cast<std::size_t>(page_number)];
    std::vector<int> found;
    page_edges.cut_boxes.query({at, at}, found);
    return std::none_of(found.begin(), found.end(), [&](int number) {
        const auto& [owner, ring] = page_edges.cuts[static_cast<std::size_t>(number)];
        return owner == plate && contains({ring, {}}, at);
    });
}

std::optional<Pierced::Narrow> PaperMap::narrow_beside_hole(int page_number, const Ring& ring,
                                                            double below) const {
    const PageEdges& page_edges = pages_[static_cast<std::size_t>(page_number)];
    struct Beside {
        bool meets = false;
        Pierced::Narrow narrow;
    };
    std::map<int, Beside> holes;
    std::vector<int> found;
    for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
        const Segment own{ring[j], ring[i]};
        page_edges.query(box_around(std::array{own.a, own.b}, below), found);
        for (const int number : found) {
            const int hole = page_edges.obstacles[static_cast<std::size_t>(number)].hole;
            if (hole < 0) continue;
            const Segment& edge = page_edges.edges[static_cast<std::size_t>(number)];
            const auto [at, fresh] = holes.try_emplace(hole, Beside{false, {{}, below}});
            Beside& beside = at->second;
            beside.meets = beside.meets || distance(own, edge) <= kGridMm;
            if (beside.meets) continue;
            for (const auto& [p, q] : end_spots(own, edge)) {
                if (distance(p, q) < beside.narrow.width_mm)
                    beside.narrow = {lerp(p, q, 0.5), distance(p, q)};
            }
        }
    }
    std::optional<Pierced::Narrow> best;
    for (const auto& [hole, beside] : holes) {
        const Ring& other = page_edges.cuts[static_cast<std::size_t>(hole)].second;
        if (beside.meets || beside.narrow.width_mm >= (best ? best->width_mm : below)) continue;
        // One within the other has no paper between them, but inside of the outer one.
        if (contains({other, {}}, ring.front()) || contains({ring, {}}, other.front())) continue;
        best = beside.narrow;
    }
    return best;
}

void PaperMap::owners_near(int page_number, const Ring& ring, std::vector<int>& owners) const {
    if (page_number < 0 || static_cast<std::size_t>(page_number) >= pages_.size() || ring.size() < 3) return;
    const PageEdges& page_edges = pages_[static_cast<std::size_t>(page_number)];
    std::vector<int> found;
    page_edges.query(box_around(ring, tolerances_.paper_mm), found);
    for (const int number : found) {
        if (region_distance(ring, page_edges.edges[static_cast<std::size_t>(number)]) < tolerances_.paper_mm)
            owners.push_back(page_edges.obstacles[static_cast<std::size_t>(number)].owner);
    }
}

std::optional<Segment> PaperMap::edge_along(int plate, int page_number, const Segment& at) const {
    const PageEdges& page_edges = pages_[static_cast<std::size_t>(page_number)];
    std::vector<int> found;
    page_edges.query(box_around(std::array{at.a, at.b}, tolerances_.rounding_mm), found);
    for (const int number : found) {
        const Obstacle& obstacle = page_edges.obstacles[static_cast<std::size_t>(number)];
        const Segment& edge = page_edges.edges[static_cast<std::size_t>(number)];
        if (obstacle.plate != plate || obstacle.seam || edge.a == edge.b) continue;
        if (distance(at.a, edge) <= tolerances_.rounding_mm &&
            distance(at.b, edge) <= tolerances_.rounding_mm)
            return edge;
    }
    return std::nullopt;
}

bool PaperMap::may_glue(int plate, int page_number, const DirectedLine* line, const Segment& seam,
                        Fit fit) const {
    const PageEdges& page_edges = pages_[static_cast<std::size_t>(page_number)];
    const Polygon& outline = outlines_[static_cast<std::size_t>(plate)];
    const double slack = fit == Fit::exact ? kOnLine : tolerances_.rounding_mm;
    if (!inside(outline, seam.a, slack) || !inside(outline, seam.b, slack)) return false;
    const double size = distance(seam.a, seam.b);
    const Vec2 trim = size > 4.0 * slack ? (slack / size) * (seam.b - seam.a) : Vec2{};
    const Segment core{seam.a + trim, seam.b - trim};
    std::vector<int> found;
    page_edges.query(box_around(std::array{seam.a, seam.b}, slack), found);
    const bool crosses = std::any_of(found.begin(), found.end(), [&](int number) {
        const Obstacle& obstacle = page_edges.obstacles[static_cast<std::size_t>(number)];
        const Segment& edge = page_edges.edges[static_cast<std::size_t>(number)];
        if (obstacle.plate != plate || obstacle.seam || (line != nullptr && along_line(*line, edge)))
            return false;
        return proper_crossing(core, edge).has_value();
    });
    if (crosses) return false;
    const double near = tolerances_.rounding_mm;
    found.clear();
    page_edges.cut_boxes.query(box_around(std::array{seam.a, seam.b}, near), found);
    std::erase_if(
        found, [&](int number) { return page_edges.cuts[static_cast<std::size_t>(number)].first != plate; });
    const auto is_cut = [&](Vec2 at) {
        return std::any_of(found.begin(), found.end(), [&](int number) {
            return contains({page_edges.cuts[static_cast<std::size_t>(number)].second, {}}, at);
        });
    };
    if (is_cut(0.5 * (seam.a + seam.b))) return false;
    // Between where something is cut out beside it, each stretch has paper on one side at least: it may run
    // along an edge, but not past what is cut out of that.
    std::vector<double> ends{0.0, 1.0};
    for (const int number : found) {
        for (const Vec2 corner : page_edges.cuts[static_cast<std::size_t>(number)].second) {
            if (size > 0.0 && distance(corner, seam) <= near)
                ends.push_back(std::clamp(dot(corner - seam.a, seam.b - seam.a) / (size * size), 0.0, 1.0));
        }
    }
    std::sort(ends.begin(), ends.end());
    // A seam may be up to `slack` off the edge: the look is a little beyond that.
    const double aside = fit == Fit::exact ? 4.0 * kOnLine : 1.5 * slack;
    const Vec2 step = size > 0.0 ? aside * left_of(unit(seam.b - seam.a)) : Vec2{};
    const auto has_paper = [&](Vec2 at) { return contains(outline, at) && !is_cut(at); };
    for (std::size_t i = 1; i < ends.size(); ++i) {
        if ((ends[i] - ends[i - 1]) * size <= 2.0 * near && ends.size() > 2) continue;
        const Vec2 middle = seam.a + 0.5 * (ends[i - 1] + ends[i]) * (seam.b - seam.a);
        if (!has_paper(middle + step) && !has_paper(middle - step)) return false;
    }
    return true;
}

}  // namespace popup
