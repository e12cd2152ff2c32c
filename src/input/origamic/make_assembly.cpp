#include "input/origamic/make_assembly.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <utility>

namespace popup::origamic {
namespace {

std::size_t at(int number) { return static_cast<std::size_t>(number); }

constexpr Vec2 kAlong{0.0, 1.0};  // the direction of all folds, on the page and on every plate

class Maker {
 public:
    Maker(const Card& card, const std::vector<Region>& regions, const std::vector<Fold>& folds,
          const Holding& held, const std::vector<Named>& named)
        : card_(card), regions_(regions), folds_(folds), held_(held), named_(named) {}

    Assembly run() {
        plate_of_.assign(regions_.size(), -1);
        out_.pieces.push_back({.name = "page"});
        for (const Holding::Step& step : held_.order) {
            plate_of_[at(step.region)] = static_cast<int>(out_.plates.size());
            add_plate(step.region);
        }
        for (const Holding::Step& step : held_.order) add_joint(step);
        add_cuts();
        add_folds();
        out_.sweep.to_deg = card_.opens_deg;
        out_.covers = {plate_of_[at(held_.back)], plate_of_[at(held_.floor)]};
        for (const Joint& joint : out_.joints) hang_plates(joint, out_.plates);
        return std::move(out_);
    }

 private:
    void add_plate(int number) {
        const Region& region = regions_[at(number)];
        Plate plate;
        plate.name = named_[at(number)].plate;
        plate.outline = region.area;
        plate.uncut = region.area.outer;
        // Of the covers what they had before anything was cut: nothing of the closed card sticks out there.
        const double w = 0.5 * card_.width;
        if (number == held_.back)
            plate.uncut = {{-card_.height, -w}, {0.0, -w}, {0.0, w}, {-card_.height, w}};
        if (number == held_.floor) plate.uncut = {{0.0, -w}, {card_.height, -w}, {card_.height, w}, {0.0, w}};
        out_.pieces[0].plates.push_back(static_cast<int>(out_.plates.size()));
        out_.plates.push_back(std::move(plate));
    }

    void add_joint(const Holding::Step& step) {
        const Region& region = regions_[at(step.region)];
        const int plate = plate_of_[at(step.region)];
        if (step.fold < 0) {
            out_.joints.push_back(
                {"page", {}, Drive{plate, {0.0, -0.5 * card_.width}, kAlong, region.upright ? -1 : 1}});
            return;
        }
        const Fold& fold = folds_[at(step.fold)];
        const int other = fold.above == step.region ? fold.below : fold.above;
        Parallel how;
        how.plate = plate;
        how.base = plate_of_[at(other)];
        how.base_at = {fold.x, fold.y0};
        how.like = plate_of_[at(region.upright ? held_.back : held_.floor)];
        how.carrier = plate_of_[at(region.upright ? held_.floor : held_.back)];
        // What stands meets the floor at its depth, what lies meets the back at its height.
        how.carrier_at = how.own_at = {region.upright ? region.offset : -region.offset, 0.0};
        how.carrier_dir = how.own_dir = kAlong;
        const Named& named = named_[at(step.region)];
        out_.joints.push_back({named.joint, named.place, how});
    }

    // Every edge of a plate is cut, but where it is folded.
    void add_cuts() {
        std::map<double, std::vector<std::pair<double, double>>> folded;  // by x: from y to y
        for (const Fold& fold : folds_) {
            if (plate_of_[at(fold.above)] < 0) continue;
            folded[fold.x].emplace_back(fold.y0, fold.y1);
        }
        for (auto& [x, stretches] : folded) std::sort(stretches.begin(), stretches.end());
        const auto cut = [this](Vec2 a, Vec2 b) { out_.lines.push_back({LineKind::cut, {a, b}, 0, -1, -1}); };
        const auto cut_ring = [&](const Ring& ring) {
            for (std::size_t i = 0; i < ring.size(); ++i) {
                const Vec2 a = ring[i];
                const Vec2 b = ring[i + 1 == ring.size() ? 0 : i + 1];
                const auto stretches = a.x == b.x ? folded.find(a.x) : folded.end();
                if (stretches == folded.end()) {
                    cut(a, b);
                    continue;
                }
                double from = std::min(a.y, b.y);
                const double to = std::max(a.y, b.y);
                for (const auto& [y0, y1] : stretches->second) {
                    if (y1 <= from || y0 >= to) continue;
                    if (y0 > from) cut({a.x, from}, {a.x, y0});
                    from = std::max(from, y1);
                }
                if (to > from) cut({a.x, from}, {a.x, to});
            }
        };
        for (const Plate& plate : out_.plates) {
            cut_ring(plate.outline.outer);
            for (const Ring& hole : plate.outline.holes) cut_ring(hole);
        }
    }

    // The gutter first, then by the order of the plates that they lead to.
    void add_folds() {
        std::vector<const Fold*> all;
        for (const Fold& fold : folds_) {
            if (plate_of_[at(fold.above)] >= 0) all.push_back(&fold);
        }
        const auto rank = [this](const Fold& fold) {
            return std::max(plate_of_[at(fold.above)], plate_of_[at(fold.below)]);
        };
        std::stable_sort(all.begin(), all.end(),
                         [&](const Fold* a, const Fold* b) { return rank(*a) < rank(*b); });
        for (const Fold* fold : all) {
            const Segment line{{fold->x, fold->y0}, {fold->x, fold->y1}};
            const int above = plate_of_[at(fold->above)];
            const int below = plate_of_[at(fold->below)];
            out_.lines.push_back(
                {fold->valley ? LineKind::valley : LineKind::mountain, line, 0, above, below});
            out_.hinges.push_back({above, below, line, line, false});
        }
    }

    const Card& card_;
    const std::vector<Region>& regions_;
    const std::vector<Fold>& folds_;
    const Holding& held_;
    const std::vector<Named>& named_;
    std::vector<int> plate_of_;  // by region; -1: it falls out
    Assembly out_;
};

}  // namespace

Assembly make_assembly(const Card& card, const std::vector<Region>& regions, const std::vector<Fold>& folds,
                       const Holding& held, const std::vector<Named>& named) {
    return Maker(card, regions, folds, held, named).run();
}

}  // namespace popup::origamic
