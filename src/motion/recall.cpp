#include "motion/recall.h"

#include <algorithm>
#include <array>
#include <set>
#include <utility>

#include "motion/joints/joint.h"

namespace popup {
namespace {

// More plates than one in so many have changed: then all are looked at.
constexpr std::size_t kFewChanged = 4;

bool same_points(const Ring& a, const Ring& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](Vec2 p, Vec2 q) { return p.x == q.x && p.y == q.y; });
}

bool same_outline(const Polygon& a, const Polygon& b) {
    return same_points(a.outer, b.outer) &&
           std::equal(a.holes.begin(), a.holes.end(), b.holes.begin(), b.holes.end(), same_points);
}

using EdgeKey = std::array<double, 4>;

std::vector<EdgeKey> sorted_edges(const Polygon& polygon) {
    std::vector<EdgeKey> keys;
    for (const Segment& edge : edges_of(polygon)) keys.push_back({edge.a.x, edge.a.y, edge.b.x, edge.b.y});
    std::sort(keys.begin(), keys.end());
    return keys;
}

// Where one of two outlines has paper and the other has none, there is an edge round it that only one of them
// has.
Box difference_of(const Polygon& a, const Polygon& b) {
    const std::vector<EdgeKey> of_a = sorted_edges(a);
    const std::vector<EdgeKey> of_b = sorted_edges(b);
    std::vector<EdgeKey> of_one;
    std::set_symmetric_difference(of_a.begin(), of_a.end(), of_b.begin(), of_b.end(),
                                  std::back_inserter(of_one));
    Box box;
    for (const EdgeKey& edge : of_one) {
        box.extend({edge[0], edge[1]});
        box.extend({edge[2], edge[3]});
    }
    return box;
}

bool is_lawful(const Linkage& linkage) {
    const auto turns = linkage.turns();
    return std::any_of(turns.begin(), turns.end(), [](const Turn& turn) { return turn.law >= 0; });
}

}  // namespace

ExaminationMemory::ExaminationMemory() : kept_(std::make_unique<Kept>()) {}
ExaminationMemory::~ExaminationMemory() = default;
ExaminationMemory::ExaminationMemory(ExaminationMemory&&) noexcept = default;
ExaminationMemory& ExaminationMemory::operator=(ExaminationMemory&&) noexcept = default;

Recall::Recall(ExaminationMemory& memory, const Assembly& assembly, const Linkage& linkage,
               const MotionOptions& options)
    : memory_(memory), kept_(*memory.kept_), assembly_(assembly), options_(options) {
    memory_.share_ = {};
    can_keep_ = assembly.sweep.closed_flat && !is_lawful(linkage) &&
                std::none_of(assembly.joints.begin(), assembly.joints.end(),
                             [](const Joint& joint) { return parallelism(joint).has_value(); });
    if (!can_keep_) {
        kept_ = {};
        return;
    }
    std::vector<int> chains = kept_.chains.of(assembly, linkage);
    if (knows_nothing(options)) kept_.known = false;
    std::unordered_map<int, int> before;
    if (kept_.known) {
        for (std::size_t i = 0; i < kept_.plate_chains.size(); ++i)
            before.emplace(kept_.plate_chains[i], static_cast<int>(i));
    }
    for (std::size_t i = 0; i < assembly.plates.size(); ++i) {
        const Plate& plate = assembly.plates[i];
        PlateNow& now = plates_.emplace_back();
        now.chain = chains[i];
        by_chain_.emplace(now.chain, static_cast<int>(i));
        reaches_.push_back(reach_of(plate));
        const auto found = before.find(now.chain);
        if (found == before.end()) {
            touched_.push_back(static_cast<int>(i));
            continue;
        }
        now.before = found->second;
        const auto k = static_cast<std::size_t>(now.before);
        now.state = State::same;
        if (same_outline(reaches_[i], kept_.reaches[k])) continue;
        now.state = State::redrawn;
        now.redrawn = difference_of(reaches_[i], kept_.reaches[k]);
        touched_.push_back(static_cast<int>(i));
    }
    helps_ = kept_.known && kFewChanged * touched_.size() <= plates_.size();
    memory_.share_.plates = plates_.size();
    memory_.share_.changed_plates = touched_.size();
}

bool Recall::knows_nothing(const MotionOptions& options) const {
    const Sweep& was = kept_.sweep;
    const Sweep& is = assembly_.sweep;
    return kept_.clearance_mm != options.clearance_mm || kept_.angles != options.angles ||
           was.from_deg != is.from_deg || was.to_deg != is.to_deg || was.closed_flat != is.closed_flat;
}

std::vector<PlateShape> Recall::take_shapes() {
    kept_.known = false;  // until keep()
    std::vector<PlateShape> shapes;
    shapes.reserve(assembly_.plates.size());
    for (std::size_t i = 0; i < assembly_.plates.size(); ++i) {
        const bool same = i < plates_.size() && plates_[i].state == State::same;
        shapes.push_back(same ? std::move(kept_.shapes[static_cast<std::size_t>(plates_[i].before)])
                              : plate_shape(assembly_.plates[i], options_.clearance_mm.has_value()));
    }
    return shapes;
}

void Recall::keep(std::vector<PlateShape> shapes) {
    if (!can_keep_ || !whole_) {
        kept_ = {};
        return;
    }
    kept_.clearance_mm = options_.clearance_mm;
    kept_.angles = options_.angles;
    kept_.sweep = assembly_.sweep;
    kept_.plate_chains.clear();
    for (const PlateNow& one : plates_) kept_.plate_chains.push_back(one.chain);
    kept_.reaches = std::move(reaches_);
    kept_.shapes = std::move(shapes);
    kept_.gaps = std::move(gaps_);
    kept_.known = true;
}

}  // namespace popup
