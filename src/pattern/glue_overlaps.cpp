#include "pattern/glue_overlaps.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/geometry/edge_index.h"
#include "base/geometry/regions.h"
#include "base/text/numbers.h"

namespace popup {
namespace {

// Less of a seam than this, and than this share of it, its tab can do without.
constexpr double kMostCoveredMm = 5.0;
constexpr double kMostShare = 0.25;
constexpr double kBeside = 0.01;  // looks past an edge that the seam lies on
constexpr double kAll = 0.999;    // nothing that follows can cover more
constexpr double kSamePointMm = 1e-6;

// What a tab or a glued area asks of the plate it is glued to, on the page of that plate.
struct WantedPlace {
    std::string_view element, label;
    Place place;
    int base_plate = 0;
    const Glue* glue = nullptr;  // none: an area
    std::vector<Polygon> paper;
};

// Where an element is glued on what an earlier one is glued on, of its worst tab or area.
struct SharedPlace {
    WantedPlace first, second;
    double share = 0.0;                 // of what `second` needs
    std::set<std::string_view> others;  // earlier elements that it meets besides, as far as was looked
};

WantedPlace wanted_place(const Glue& glue, const TabRules& rules) {
    const SeamFrame frame(glue.on_base, glue.on_back);
    Ring outline;
    for (const Vec2 p : full_tab(frame.length(), rules)) outline.push_back(frame.to_page(p));
    if (signed_area(outline) < 0.0) std::reverse(outline.begin(), outline.end());
    return {glue.element, glue.label, glue.place, glue.base_plate, &glue, {{std::move(outline), {}}}};
}

WantedPlace wanted_place(const GluedArea& area) {
    return {area.element, area.label, area.place, area.base_plate, nullptr, area.on_base};
}

// How much of the seam has its tab's first paper there.
double seam_within(const Glue& glue, const std::vector<Polygon>& paper) {
    const SeamFrame frame(glue.on_base, glue.on_back);
    double most = 0.0;
    for (const Polygon& one : paper) {
        for (const auto& part :
             clip_line({frame.to_page({0.0, kBeside}), frame.to_page({frame.length(), kBeside})}, one))
            most = std::max(most, distance(part.front(), part.back()));
    }
    return most;
}

// Which share of what a place needs is in another; 0: one that it can do without.
double share_within(const WantedPlace& place, const WantedPlace& other) {
    if (place.glue == nullptr) {
        const double share = area(intersect(place.paper, other.paper)) / area(place.paper);
        return share <= kMostShare ? 0.0 : share;
    }
    const double seam = distance(place.glue->on_base.a, place.glue->on_base.b);
    const double covered = seam_within(*place.glue, other.paper);
    if (covered <= std::min(kMostCoveredMm, kMostShare * seam)) return 0.0;
    return covered >= kAll * seam - 2.0 * kBeside ? 1.0 : covered / seam;
}

// One side of one plate: what is wanted there so far, found by where it is.
class PlateSide {
 public:
    // Tells of earlier places that the new one shares enough with, and of the share; of none after one that
    // takes all of its seam.
    template <typename Tell>
    void add(WantedPlace place, const Tell& tell) {
        Box box;
        for (const Polygon& part : place.paper) {
            for (const Vec2 p : part.outer) box.extend(p);
        }
        boxes_.query(box, near_);
        std::sort(near_.begin(), near_.end());
        for (const int number : near_) {
            const WantedPlace& other = places_[static_cast<std::size_t>(number)];
            if (other.element == place.element) continue;
            const double share = share_within(place, other);
            if (share <= 0.0) continue;
            tell(other, place, share);
            if (share >= kAll) break;
        }
        boxes_.insert({box.min, box.max}, false);
        places_.push_back(std::move(place));
    }

 private:
    EdgeIndex boxes_;  // diagonals
    std::vector<WantedPlace> places_;
    std::vector<int> near_;
};

bool same(const Segment& a, const Segment& b) {
    return distance(a.a, b.a) <= kSamePointMm && distance(a.b, b.b) <= kSamePointMm;
}

bool same(const Ring& a, const Ring& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](Vec2 p, Vec2 q) { return distance(p, q) <= kSamePointMm; });
}

bool same(const std::vector<Polygon>& a, const std::vector<Polygon>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const Polygon& p, const Polygon& q) { return same(p.outer, q.outer); });
}

class GlueOverlaps {
 public:
    GlueOverlaps(const Assembly& assembly, const TabRules& rules, Diagnostics& diagnostics)
        : in_(assembly), diagnostics_(diagnostics) {
        const auto tell = [&](const WantedPlace& first, const WantedPlace& second, double share) {
            add(first, second, share);
        };
        for (const Glue& glue : in_.glue) {
            tabs_of_[glue.element].push_back(&glue);
            sides_[{glue.base_plate, glue.on_back}].add(wanted_place(glue, rules), tell);
        }
        for (const GluedArea& area : in_.glued_areas) {
            areas_of_[area.element].push_back(&area);
            const bool back = plate(area.plate).lying == Lying::on_back;
            sides_[{area.base_plate, back}].add(wanted_place(area), tell);
        }
    }

    void report() {
        for (const std::string_view element : order_) report(worst_.at(element));
    }

 private:
    void add(const WantedPlace& first, const WantedPlace& second, double share) {
        const auto [at, is_new] = worst_.try_emplace(second.element);
        if (is_new) order_.push_back(second.element);
        SharedPlace& worst = at->second;
        worst.others.insert(first.element);
        if (share <= worst.share) return;
        worst.first = first;
        worst.second = second;
        worst.share = share;
    }

    [[nodiscard]] const Plate& plate(int number) const {
        return in_.plates[static_cast<std::size_t>(number)];
    }
    [[nodiscard]] const Ring& outline(int number) const { return plate(number).outline.outer; }

    // Whether all that is known of where they are glued and of the plates that these are on is the same.
    [[nodiscard]] bool are_the_same(std::string_view one, std::string_view other) const {
        const auto all = [](const auto& of, std::string_view element) {
            const auto found = of.find(element);
            return found == of.end() ? typename std::decay_t<decltype(of)>::mapped_type{} : found->second;
        };
        const std::vector<const Glue*> a = all(tabs_of_, one);
        const std::vector<const Glue*> b = all(tabs_of_, other);
        const std::vector<const GluedArea*> c = all(areas_of_, one);
        const std::vector<const GluedArea*> d = all(areas_of_, other);
        return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                          [this](const Glue* p, const Glue* q) {
                              return p->base_plate == q->base_plate && p->on_back == q->on_back &&
                                     same(p->on_base, q->on_base) && same(p->on_piece, q->on_piece) &&
                                     same(outline(p->piece_plate), outline(q->piece_plate));
                          }) &&
               std::equal(c.begin(), c.end(), d.begin(), d.end(),
                          [this](const GluedArea* p, const GluedArea* q) {
                              return p->base_plate == q->base_plate && same(p->on_base, q->on_base) &&
                                     same(outline(p->plate), outline(q->plate));
                          });
    }

    static std::string name(const WantedPlace& one) {
        return fmt::format("{} {} of \"{}\"", one.glue != nullptr ? "tab" : "area", one.label, one.element);
    }

    void report(const SharedPlace& one) {
        const Glue* glue = one.second.glue;
        Box on_page;
        Box by_seam;
        for (const Polygon& part : intersect(one.first.paper, one.second.paper)) {
            for (const Vec2 p : part.outer) {
                on_page.extend(p);
                if (glue != nullptr) by_seam.extend(SeamFrame(glue->on_base, glue->on_back).to_seam(p));
            }
        }
        const std::string size = glue != nullptr
                                     ? fmt::format("{:.2f} mm along the seam and {:.2f} mm across it",
                                                   by_seam.width(), by_seam.height())
                                     : fmt::format("{:.2f} × {:.2f} mm", on_page.width(), on_page.height());
        const Vec2 middle = on_page.centre();
        const std::size_t more = one.others.size() - 1;
        Diagnostic& finding = diagnostics_.warning(
            "glue-overlaps", one.second.place,
            fmt::format("{} and {} are glued in one place on \"{}\", over {}, round ({:.2f}, {:.2f}) mm of "
                        "its page{}",
                        name(one.second), name(one.first), plate(one.second.base_plate).name, size,
                        rounded(middle.x, 2), rounded(middle.y, 2),
                        more == 0 ? ""
                                  : fmt::format("; {} more element{} in the way of \"{}\"", more,
                                                more == 1 ? " is" : "s are", one.second.element)));
        finding.about(std::string(one.second.element))
            .with(one.first.place, fmt::format("\"{}\"", one.first.element));
        if (are_the_same(one.first.element, one.second.element)) {
            finding.hint(fmt::format("\"{}\" is the same as \"{}\" in all points: take one of the two out",
                                     one.second.element, one.first.element));
        } else if (glue != nullptr) {
            finding.hint(
                fmt::format("move \"{}\" along the fold it stands on until its tab {} is clear of {}",
                            one.second.element, one.second.label, name(one.first)));
        } else {
            finding.hint(
                fmt::format("move \"{}\" clear of {}, or glue it on the other side or on \"{}\" itself",
                            one.second.element, name(one.first), one.first.element));
        }
    }

    const Assembly& in_;
    Diagnostics& diagnostics_;
    std::map<std::pair<int, bool>, PlateSide> sides_;
    // By element; names are those of the assembly.
    std::map<std::string_view, std::vector<const Glue*>> tabs_of_;
    std::map<std::string_view, std::vector<const GluedArea*>> areas_of_;
    std::map<std::string_view, SharedPlace> worst_;  // of the later
    std::vector<std::string_view> order_;
};

}  // namespace

void report_glue_overlaps(const Assembly& assembly, const TabRules& rules, Diagnostics& diagnostics) {
    GlueOverlaps(assembly, rules, diagnostics).report();
}

}  // namespace popup
