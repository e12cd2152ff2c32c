#include "pattern/glue_overlaps.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/geometry/edge_index.h"
#include "base/geometry/regions.h"
#include "base/text/numbers.h"
#include "pattern/tab_places.h"

namespace popup {
namespace {

// Less of a seam than this, and than this share of it, its tab can do without.
constexpr double kMostCoveredMm = 5.0;
constexpr double kMostShare = 0.25;
constexpr double kBeside = 0.01;  // looks past an edge that the seam lies on
constexpr double kAll = 0.999;    // of a seam: nothing that follows can cover more of it
constexpr double kSamePointMm = 1e-6;
constexpr int kMostTried = 3;  // elements of which moves are tried

struct WantedPlace {
    const Glue* glue;
    Ring outline;  // on the page of the plate it is glued to, counter-clockwise
};

bool meet(const Box& a, const Box& b) {
    return a.min.x <= b.max.x && b.min.x <= a.max.x && a.min.y <= b.max.y && b.min.y <= a.max.y;
}

// Where an element is glued on what an earlier one is glued on, of its worst tab.
struct SharedPlace {
    const Glue* first = nullptr;
    const Glue* second = nullptr;
    double share = 0.0;  // of the seam of `second`
    Ring first_outline, second_outline;
    std::set<std::string> others;  // earlier elements that it meets besides, as far as was looked
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
    // Tells of earlier places that the new one shares enough with, and of the share; of none after one that
    // takes all of its seam.
    template <typename Tell>
    void add(WantedPlace place, const Tell& tell) {
        const Box box = bounds(place.outline);
        boxes_.query(box, near_);
        std::sort(near_.begin(), near_.end());
        const double seam = distance(place.glue->on_base.a, place.glue->on_base.b);
        for (const int number : near_) {
            const WantedPlace& other = places_[static_cast<std::size_t>(number)];
            if (other.glue->element == place.glue->element) continue;
            const double covered = seam_within(*place.glue, other.outline);
            if (covered <= std::min(kMostCoveredMm, kMostShare * seam)) continue;
            tell(other, place, covered / seam);
            if (covered >= kAll * seam - 2.0 * kBeside) break;
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

class GlueOverlaps {
 public:
    GlueOverlaps(const Assembly& assembly, const PatternOptions& options, Diagnostics& diagnostics)
        : in_(assembly), options_(options), diagnostics_(diagnostics) {
        const TabRules rules = tab_rules(options);
        for (const Glue& glue : in_.glue) {
            tabs_of_[glue.element].push_back(&glue);
            sides_[{glue.base_plate, glue.on_back}].add(
                wanted_place(glue, rules), [&](const WantedPlace& first, const WantedPlace& second,
                                               double share) { add(first, second, share); });
        }
    }

    void report() {
        for (const std::string& element : order_) report(worst_.at(element));
    }

 private:
    void add(const WantedPlace& first, const WantedPlace& second, double share) {
        const auto [at, is_new] = worst_.try_emplace(second.glue->element);
        if (is_new) order_.push_back(second.glue->element);
        SharedPlace& worst = at->second;
        worst.others.insert(first.glue->element);
        if (share <= worst.share) return;
        worst.first = first.glue;
        worst.second = second.glue;
        worst.share = share;
        worst.first_outline = first.outline;
        worst.second_outline = second.outline;
    }

    [[nodiscard]] const Plate& plate(int number) const {
        return in_.plates[static_cast<std::size_t>(number)];
    }

    // Whether all that is known of their tabs and of the plates that these are on is the same.
    [[nodiscard]] bool are_the_same(const std::string& one, const std::string& other) const {
        const std::vector<const Glue*>& a = tabs_of_.at(one);
        const std::vector<const Glue*>& b = tabs_of_.at(other);
        return std::equal(a.begin(), a.end(), b.begin(), b.end(), [this](const Glue* p, const Glue* q) {
            return p->base_plate == q->base_plate && p->on_back == q->on_back &&
                   same(p->on_base, q->on_base) && same(p->on_piece, q->on_piece) &&
                   same(plate(p->piece_plate).outline.outer, plate(q->piece_plate).outline.outer);
        });
    }

    std::optional<std::string> tried_move(const std::string& element) {
        if (!options_.clearing_move || tried_++ >= kMostTried) return std::nullopt;
        return options_.clearing_move(element);
    }

    void report(const SharedPlace& one) {
        const SeamFrame frame(one.second->on_base, one.second->on_back);
        Box on_page;
        Box by_seam;
        for (const Polygon& part : intersect({{one.first_outline, {}}}, {{one.second_outline, {}}})) {
            for (const Vec2 p : part.outer) {
                on_page.extend(p);
                by_seam.extend(frame.to_seam(p));
            }
        }
        const Vec2 middle = on_page.centre();
        const std::size_t more = one.others.size() - 1;
        Diagnostic& finding = diagnostics_.warning(
            "glue-overlaps", one.second->place,
            fmt::format("tab {} of \"{}\" and tab {} of \"{}\" are glued in one place on \"{}\", over "
                        "{:.2f} mm along the seam and {:.2f} mm across it, round ({:.2f}, {:.2f}) mm of its "
                        "page{}",
                        one.second->label, one.second->element, one.first->label, one.first->element,
                        plate(one.second->base_plate).name, by_seam.width(), by_seam.height(),
                        rounded(middle.x, 2), rounded(middle.y, 2),
                        more == 0 ? ""
                                  : fmt::format("; {} more element{} in the way of \"{}\"", more,
                                                more == 1 ? " is" : "s are", one.second->element)));
        finding.about(one.second->element).with(one.first->place, fmt::format("\"{}\"", one.first->element));
        if (are_the_same(one.first->element, one.second->element)) {
            finding.hint(fmt::format("\"{}\" is the same as \"{}\" in all points: take one of the two out",
                                     one.second->element, one.first->element));
        } else if (const auto move = tried_move(one.second->element)) {
            finding.hint(*move);
        } else {
            finding.hint(
                fmt::format("move \"{}\" along the fold it stands on until its tab {} is clear of tab {} of "
                            "\"{}\" and of those of all others",
                            one.second->element, one.second->label, one.first->label, one.first->element));
        }
    }

    const Assembly& in_;
    const PatternOptions& options_;
    Diagnostics& diagnostics_;
    int tried_ = 0;
    std::map<std::pair<int, bool>, PlateSide> sides_;
    std::map<std::string, std::vector<const Glue*>> tabs_of_;
    std::map<std::string, SharedPlace> worst_;  // by the later element
    std::vector<std::string> order_;
};

}  // namespace

double shared_seams(const Assembly& assembly, const std::string& element, const PatternOptions& options) {
    const TabRules rules = tab_rules(options);
    double shared = 0.0;
    for (const Glue& own : assembly.glue) {
        if (own.element != element) continue;
        const WantedPlace place = wanted_place(own, rules);
        const Box box = bounds(place.outline);
        for (const Glue& other : assembly.glue) {
            if (other.element == element || other.base_plate != own.base_plate ||
                other.on_back != own.on_back)
                continue;
            const WantedPlace others = wanted_place(other, rules);
            if (!meet(box, bounds(others.outline))) continue;
            shared += seam_within(own, others.outline) + seam_within(other, place.outline);
        }
    }
    return shared;
}

void report_glue_overlaps(const Assembly& assembly, const PatternOptions& options, Diagnostics& diagnostics) {
    GlueOverlaps(assembly, options, diagnostics).report();
}

}  // namespace popup
