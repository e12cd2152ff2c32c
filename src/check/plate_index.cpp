#include "check/plate_index.h"

#include <algorithm>

#include "base/geometry/regions.h"

namespace popup {
namespace {

double edge_distance(const Ring& ring, Vec2 p) {
    double best = HUGE_VAL;
    for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
        best = std::min(best, distance(p, Segment{ring[j], ring[i]}));
    }
    return best;
}

bool on_paper(const Skeleton& skeleton, int plate, Vec2 p, double slack) {
    const auto number = static_cast<std::size_t>(plate);
    const Polygon& outline = skeleton.draft.plates[number].outline;
    if (!contains(outline, p) && edge_distance(outline.outer, p) > slack) return false;
    const auto& cuts = skeleton.cut_outs[number];
    for (const int hole : skeleton.holes_of[number]) {
        const Ring& ring = skeleton.holes[static_cast<std::size_t>(hole)].ring;
        if (contains({ring, {}}, p) && edge_distance(ring, p) > slack) return false;
    }
    return std::none_of(cuts.begin(), cuts.end(), [&](const CutOut& cut) {
        return contains({cut.path, {}}, p) && edge_distance(cut.path, p) > slack;
    });
}

}  // namespace

PlateIndex::PagePlates& PlateIndex::page(int number) {
    while (pages_.size() <= static_cast<std::size_t>(number)) pages_.emplace_back();
    return pages_[static_cast<std::size_t>(number)];
}

void PlateIndex::insert(PagePlates& plates, const Ring& around, Entry entry) {
    const Box box = bounds(around);
    plates.boxes.insert({box.min, box.max}, false);
    plates.entries.push_back(std::move(entry));
}

void PlateIndex::add(const Skeleton& skeleton, std::size_t first, const std::vector<RigidMove>& moves,
                     const std::string& owner) {
    for (std::size_t i = first; i < skeleton.draft.plates.size(); ++i) {
        PagePlates& plates = page(skeleton.plate_page[i]);
        const RigidMove& move = moves[i - first];
        Ring around = skeleton.draft.plates[i].outline.outer;
        insert(plates, around, {static_cast<int>(i), {}, {}, owner});
        if (move.identity) continue;
        for (Vec2& p : around) p = move.undone(p);
        insert(plates, around, {static_cast<int>(i), {}, move, owner});
    }
}

void PlateIndex::add_ghost(int number, const Ring& area) {
    if (area.size() > 2) insert(page(number), area, {-1, area, {}, {}});
}

void PlateIndex::add_ghost_page(int number) { page(number).ghost = true; }

std::optional<PlateMatch> PlateIndex::find(const Skeleton& skeleton, int number, Vec2 at,
                                           double slack) const {
    if (number < 0 || static_cast<std::size_t>(number) >= pages_.size()) return std::nullopt;
    const PagePlates& plates = pages_[static_cast<std::size_t>(number)];
    if (plates.ghost) return PlateMatch{-1, true, {}};
    std::vector<int> found;
    plates.boxes.query({at - Vec2{slack, slack}, at + Vec2{slack, slack}}, found);
    std::sort(found.begin(), found.end(), std::greater<>());
    // Where its author saw a plate counts before where a repair has put it.
    for (const bool moved : {true, false}) {
        for (const int i : found) {
            const Entry& entry = plates.entries[static_cast<std::size_t>(i)];
            if (entry.plate < 0) {
                if (contains({entry.ghost, {}}, at)) return PlateMatch{-1, true, {}};
                continue;
            }
            if (entry.move.identity == moved) continue;
            if (on_paper(skeleton, entry.plate, entry.move.apply(at), slack))
                return PlateMatch{entry.plate, false, entry.move};
        }
    }
    return std::nullopt;
}

std::vector<int> PlateIndex::in(int number, const Box& box) const {
    std::vector<int> plates;
    if (number < 0 || static_cast<std::size_t>(number) >= pages_.size()) return plates;
    const PagePlates& page = pages_[static_cast<std::size_t>(number)];
    std::vector<int> found;
    page.boxes.query(box, found);
    for (const int i : found) {
        const Entry& entry = page.entries[static_cast<std::size_t>(i)];
        if (entry.plate >= 0 && entry.move.identity) plates.push_back(entry.plate);
    }
    std::sort(plates.begin(), plates.end());
    return plates;
}

std::optional<PlateIndex::Nearest> PlateIndex::nearest(const Skeleton& skeleton, int number, Vec2 at) const {
    if (number < 0 || static_cast<std::size_t>(number) >= pages_.size()) return std::nullopt;
    std::optional<Nearest> best;
    for (const Entry& entry : pages_[static_cast<std::size_t>(number)].entries) {
        if (entry.plate < 0 || !entry.move.identity) continue;
        const double off =
            edge_distance(skeleton.draft.plates[static_cast<std::size_t>(entry.plate)].outline.outer, at);
        if (!best || off < best->distance) best = Nearest{entry.owner, off};
    }
    return best;
}

std::vector<Polygon> paper_of(const Skeleton& skeleton, int plate, double inset) {
    const auto number = static_cast<std::size_t>(plate);
    std::vector<Polygon> cuts;
    for (const CutOut& cut : skeleton.cut_outs[number]) cuts.push_back({cut.path, {}});
    for (const int hole : skeleton.holes_of[number]) {
        const Ring& ring = skeleton.holes[static_cast<std::size_t>(hole)].ring;
        cuts.push_back({{ring.rbegin(), ring.rend()}, {}});
    }
    std::vector<Polygon> paper = subtract({skeleton.draft.plates[number].outline}, cuts);
    return inset > 0.0 ? offset(paper, -inset, Corners::sharp) : paper;
}

}  // namespace popup
