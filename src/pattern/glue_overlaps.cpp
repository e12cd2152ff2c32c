#include "pattern/glue_overlaps.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "base/geometry/edge_index.h"
#include "base/geometry/regions.h"

namespace popup {
namespace {

// Less of a seam than this, and than this share of it, its tab can do without.
constexpr double kMostCoveredMm = 5.0;
constexpr double kMostShare = 0.25;
constexpr double kBeside = 0.01;  // looks past an edge that the seam lies on

struct WantedPlace {
    const Glue* glue;
    Ring outline;  // on the page of the plate it is glued to, counter-clockwise
};

struct SharedPlace {
    const Glue* first = nullptr;
    const Glue* second = nullptr;
    double area_mm2 = 0.0;
    Box box;
};

WantedPlace wanted_place(const Glue& glue, const TabRules& rules) {
    const SeamFrame frame(glue.on_base, glue.on_back);
    WantedPlace made{&glue, {}};
    for (const Vec2 p : full_tab(frame.length(), rules)) made.outline.push_back(frame.to_page(p));
    if (signed_area(made.outline) < 0.0) std::reverse(made.outline.begin(), made.outline.end());
    return made;
}

// How much of the seam has its tab's first paper in the area.
double seam_within(const Glue& glue, const Ring& area) {
    const SeamFrame frame(glue.on_base, glue.on_back);
    double most = 0.0;
    for (const auto& part :
         clip_line({frame.to_page({0.0, kBeside}), frame.to_page({frame.length(), kBeside})}, {area, {}}))
        most = std::max(most, distance(part.front(), part.back()));
    return most;
}

// One side of one plate: what is wanted there so far, found by where it is.
class PlateSide {
 public:
    // Tells of every earlier place that the new one shares enough with.
    template <typename Tell>
    void add(WantedPlace place, const Tell& tell) {
        const Box box = bounds(place.outline);
        boxes_.query(box, near_);
        for (const int number : near_) {
            const WantedPlace& other = places_[static_cast<std::size_t>(number)];
            if (other.glue->element == place.glue->element) continue;
            const std::vector<Polygon> common = intersect({{place.outline, {}}}, {{other.outline, {}}});
            const double here = area(common);
            const double most =
                std::min(kMostCoveredMm, kMostShare * distance(place.glue->on_base.a, place.glue->on_base.b));
            if (seam_within(*place.glue, other.outline) <= most) continue;
            SharedPlace one{other.glue, place.glue, here, {}};
            for (const Polygon& part : common) {
                for (const Vec2 p : part.outer) one.box.extend(p);
            }
            tell(one);
        }
        boxes_.insert({box.min, box.max}, false);
        places_.push_back(std::move(place));
    }

 private:
    EdgeIndex boxes_;  // diagonals
    std::vector<WantedPlace> places_;
    std::vector<int> near_;
};

}  // namespace

void report_glue_overlaps(const Assembly& assembly, const TabRules& rules, Diagnostics& diagnostics) {
    std::map<std::pair<int, bool>, PlateSide> sides;
    std::map<std::pair<std::string, std::string>, SharedPlace> worst;
    std::vector<std::pair<std::string, std::string>> order;
    for (const Glue& glue : assembly.glue) {
        sides[{glue.base_plate, glue.on_back}].add(wanted_place(glue, rules), [&](const SharedPlace& one) {
            const std::pair key(one.first->element, one.second->element);
            const auto [at, is_new] = worst.try_emplace(key, one);
            if (is_new) order.push_back(key);
            if (one.area_mm2 > at->second.area_mm2) at->second = one;
        });
    }
    for (const auto& key : order) {
        const SharedPlace& one = worst.at(key);
        const Vec2 middle = one.box.centre();
        diagnostics
            .warning(
                "glue-overlaps", one.second->place,
                fmt::format("tab {} of \"{}\" and tab {} of \"{}\" are glued in one place on \"{}\", over "
                            "{:.2f} × {:.2f} mm round ({:.2f}, {:.2f}) mm of its page",
                            one.second->label, one.second->element, one.first->label, one.first->element,
                            assembly.plates[static_cast<std::size_t>(one.second->base_plate)].name,
                            one.box.width(), one.box.height(), middle.x + 0.0, middle.y + 0.0))
            .about(one.second->element)
            .with(one.first->place, fmt::format("\"{}\"", one.first->element));
    }
}

}  // namespace popup
