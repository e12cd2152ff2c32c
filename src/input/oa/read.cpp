#include "input/oa/read.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "assembly/settle.h"
#include "base/geometry/tolerances.h"
#include "input/oa/card.h"
#include "input/oa/folds.h"
#include "input/oa/sheet.h"

namespace popup::oa {
namespace {

constexpr double kOpensDeg = 90.0;
// Paper that falls out and is smaller is dust.
constexpr double kDustMm2 = 0.5;

std::size_t at(int number) { return static_cast<std::size_t>(number); }

constexpr Vec2 kAlong{0.0, 1.0};  // the direction of all folds, on the page and on every plate

class Maker {
 public:
    Maker(const Card& card, const std::vector<Region>& regions, const std::vector<Fold>& folds,
          const Holding& held)
        : card_(card), regions_(regions), folds_(folds), held_(held) {}

    Assembly run() {
        name_all();
        plate_of_.assign(regions_.size(), -1);
        out_.pieces.push_back({.name = "page"});
        for (const Holding::Step& step : held_.order) {
            plate_of_[at(step.region)] = static_cast<int>(out_.plates.size());
            add_plate(step.region);
        }
        for (const Holding::Step& step : held_.order) add_joint(step);
        add_cuts();
        add_folds();
        out_.sweep.to_deg = kOpensDeg;
        out_.covers = {plate_of_[at(held_.back)], plate_of_[at(held_.floor)]};
        for (const Joint& joint : out_.joints) hang_plates(joint, out_.plates);
        return std::move(out_);
    }

 private:
    // What runs back is named after the face that carries it: the one it has the longest fold with.
    [[nodiscard]] std::vector<int> carriers() const {
        std::vector<std::map<int, double>> lengths(regions_.size());
        for (const Fold& fold : folds_) {
            if (fold.valley) continue;
            const int face = regions_[at(fold.below)].face;
            if (face >= 0) lengths[at(fold.above)][face] += fold.y1 - fold.y0;
        }
        std::vector<int> result(regions_.size(), -1);
        for (std::size_t i = 0; i < regions_.size(); ++i) {
            double most = 0.0;
            for (const auto& [face, length] : lengths[i]) {
                if (length > most + kTouchMm) {
                    most = length;
                    result[i] = face;
                }
            }
        }
        return result;
    }

    void name_all() {
        const std::vector<int> carrier = carriers();
        faces_.resize(regions_.size());
        std::map<std::string, int> count;
        for (const Holding::Step& step : held_.order) {
            const Region& region = regions_[at(step.region)];
            const int face = region.top ? carrier[at(step.region)] : region.face;
            faces_[at(step.region)] = face;
            std::string name = region.upright ? "back" : "floor";
            if (region.top) {
                name = face >= 0 ? fmt::format("face-{}/top", face) : fmt::format("shelf-{}", step.region);
            } else if (face >= 0) {
                name = fmt::format("face-{}", face);
            }
            const int number = ++count[name];
            names_.push_back(number == 1 ? name : fmt::format("{}/{}", name, number));
        }
    }

    void add_plate(int number) {
        const Region& region = regions_[at(number)];
        Plate plate;
        plate.name = names_[out_.plates.size()];
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
        const int face = faces_[at(step.region)];
        out_.joints.push_back({face < 0 ? "page" : fmt::format("face-{}", face), card_.place_of(face), how});
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
    std::vector<int> plate_of_;       // by region; -1: it falls out
    std::vector<int> faces_;          // by region: the face that it is named after
    std::vector<std::string> names_;  // in the order of the plates
    Assembly out_;
};

// What no fold leads to.
void tell_loose(const Card& card, const Sheet& sheet, const Holding& held, Diagnostics& diagnostics) {
    for (std::size_t i = 0; i < sheet.regions.size(); ++i) {
        const Region& region = sheet.regions[i];
        const double size = area(region.area);
        if (held.held[i] || size - region.cut_mm2 < kDustMm2) continue;
        const Vec2 inside = inner_point(region.area, 0.1).at;
        const std::string where =
            fmt::format("{:.1f} mm² at X {:.1f}, Y {:.1f}", size, inside.y + 0.5 * card.width, inside.x);
        if (region.face < 0 && !region.top) {
            diagnostics
                .warning("oa-loose", {},
                         fmt::format("paper of the {} falls out: no fold holds {}",
                                     region.upright ? "back" : "floor", where))
                .hint("a hole there says that it is meant; else leave a way to the rest of it");
        } else if (region.top) {
            diagnostics
                .warning(
                    "oa-loose", {},
                    fmt::format("a horizontal plate, {:.2f} mm above the floor, falls out: no fold holds "
                                "{}",
                                region.offset, where))
                .hint("what carries it must reach the floor or another plate");
        } else {
            diagnostics
                .warning("oa-loose", card.place_of(region.face),
                         fmt::format("a part of faces[{}] falls out: no fold holds {}", region.face, where))
                .hint(
                    fmt::format("let it reach the floor (Y {:g}) or a horizontal plate, or give it an upper "
                                "edge along the gutter",
                                region.offset));
        }
    }
}

}  // namespace

std::optional<Assembly> read(const Source& source, const ReadOptions& options, Diagnostics& diagnostics) {
    const std::optional<Card> card = read_card(source, options, diagnostics);
    if (!card) return std::nullopt;
    const std::optional<Sheet> sheet = lay_out_sheet(*card, diagnostics);
    if (!sheet) return std::nullopt;
    const std::vector<Fold> folds = folds_between(sheet->regions);
    const Holding held = holding(sheet->regions, folds);
    if (held.back < 0 || held.floor < 0) {
        diagnostics
            .error("oa-no-card", {},
                   fmt::format("nothing is left of the {}: the plates take all its paper",
                               held.back < 0 ? "back" : "floor"))
            .hint("make the card higher than what stands on it");
        return std::nullopt;
    }
    tell_loose(*card, *sheet, held, diagnostics);
    Assembly assembly = Maker(*card, sheet->regions, folds, held).run();
    settle_numbers(assembly);
    return assembly;
}

bool recognises(std::string_view text) {
    constexpr std::string_view kBlanks = " \t\r\n";
    const auto skip = [&] { text.remove_prefix(std::min(text.find_first_not_of(kBlanks), text.size())); };
    skip();
    if (!text.starts_with('{')) return false;
    text.remove_prefix(1);
    skip();
    return text.starts_with("\"settings\"") || text.starts_with("\"faces\"");
}

}  // namespace popup::oa
