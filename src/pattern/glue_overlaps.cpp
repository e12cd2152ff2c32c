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
constexpr double kInside = 0.5;         // mm: a wall that is nearer to an edge stands beside it
constexpr double kHidden = 0.9;         // of an area: what is left of it shows nobody where it is
constexpr std::size_t kMostNear = 200;  // earlier areas that one is held against
constexpr int kMostTried = 3;           // elements of which moves are tried

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

// How much of the seam has the paper beside it, so far towards its tab, in the area.
double seam_within(const Glue& glue, const Polygon& area, double beside) {
    const SeamFrame frame(glue.on_base, glue.on_back);
    double most = 0.0;
    for (const auto& part :
         clip_line({frame.to_page({0.0, beside}), frame.to_page({frame.length(), beside})}, area))
        most = std::max(most, distance(part.front(), part.back()));
    return most;
}
// How much of it has its tab's first paper there.
double seam_within(const Glue& glue, const Ring& area) { return seam_within(glue, {area, {}}, kBeside); }

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

// What is glued flat, held against what is glued on the same side of the same plate. Paper may be glued on
// paper that lies flat there: what is told is what is there twice, and what nobody can find.
class FlatPlaces {
 public:
    FlatPlaces(const Assembly& assembly, Diagnostics& diagnostics)
        : in_(assembly), diagnostics_(diagnostics) {
        for (const GluedArea& area : in_.glued_areas) {
            Box box;
            for (const Polygon& part : area.on_base) {
                for (const Vec2 p : part.outer) box.extend(p);
            }
            Bed& bed = beds_[{area.base_plate, is_on_back(area)}];
            bed.boxes.insert({box.min, box.max}, false);
            bed.areas.push_back(&area);
        }
    }

    void report() {
        for (auto& [side, bed] : beds_) {
            for (std::size_t i = 1; i < bed.areas.size(); ++i) look_beneath(bed, i);
        }
        std::set<std::string> told;
        for (const Glue& glue : in_.glue) {
            if (!told.contains(glue.element) && look_beneath(glue)) told.insert(glue.element);
        }
    }

 private:
    struct Bed {
        EdgeIndex boxes;  // diagonals
        std::vector<const GluedArea*> areas;
    };

    [[nodiscard]] const Plate& plate(int number) const {
        return in_.plates[static_cast<std::size_t>(number)];
    }
    [[nodiscard]] bool is_on_back(const GluedArea& area) const {
        return plate(area.plate).lying == Lying::on_back;
    }
    [[nodiscard]] bool are_the_same(const GluedArea& one, const GluedArea& other) const {
        const auto all = [](const std::vector<Polygon>& a, const std::vector<Polygon>& b) {
            return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                              [](const Polygon& p, const Polygon& q) { return same(p.outer, q.outer); });
        };
        return all(one.on_base, other.on_base) &&
               same(plate(one.plate).outline.outer, plate(other.plate).outline.outer);
    }

    // An area and the earlier ones, the last of them first: that one is seen.
    void look_beneath(const Bed& bed, std::size_t number) {
        const GluedArea& one = *bed.areas[number];
        bed.boxes.query(box_of(one.on_base), near_);
        std::sort(near_.rbegin(), near_.rend());
        std::size_t looked = 0;
        for (const int earlier : near_) {
            if (static_cast<std::size_t>(earlier) >= number) continue;
            const GluedArea& other = *bed.areas[static_cast<std::size_t>(earlier)];
            if (other.element == one.element) continue;
            if (are_the_same(one, other)) return tell_twice(one, other);
            if (++looked > kMostNear) return;
            const std::vector<Polygon> shared = intersect(one.on_base, other.on_base);
            if (area(shared) >= kHidden * area(one.on_base)) return tell_hidden(one, other);
        }
    }

    void tell_twice(const GluedArea& one, const GluedArea& other) {
        diagnostics_
            .warning("glue-overlaps", one.place,
                     fmt::format("area {} of \"{}\" and area {} of \"{}\" are glued in one place on \"{}\", "
                                 "{}",
                                 one.label, one.element, other.label, other.element,
                                 plate(one.base_plate).name, where(box_of(one.on_base))))
            .about(one.element)
            .with(other.place, fmt::format("\"{}\"", other.element))
            .hint(fmt::format("\"{}\" is the same as \"{}\" in all points: take one of the two out",
                              one.element, other.element));
    }

    void tell_hidden(const GluedArea& one, const GluedArea& other) {
        diagnostics_
            .remark("target-covered", one.place,
                    fmt::format("area {} of \"{}\" on \"{}\", {}, is covered by \"{}\", which is glued "
                                "flat there before",
                                one.label, one.element, plate(one.base_plate).name,
                                where(box_of(one.on_base)), other.element))
            .about(one.element)
            .with(other.place, fmt::format("\"{}\"", other.element))
            .hint(fmt::format("let \"{}\" stand on the plate \"{}\", on which its area is marked then, or "
                              "move one of the two",
                              one.element, plate(other.plate).name));
    }

    // Whether a wall rises out of what is glued flat where its tab goes.
    bool look_beneath(const Glue& glue) {
        const auto bed = beds_.find({glue.base_plate, glue.on_back});
        if (bed == beds_.end()) return false;
        const Plate& wall = plate(glue.piece_plate);
        if (wall.lying != Lying::free && wall.parent == glue.base_plate) return false;
        const double seam = distance(glue.on_base.a, glue.on_base.b);
        const double least = std::min(kMostCoveredMm, kMostShare * seam);
        bed->second.boxes.query(box_of({{{glue.on_base.a, glue.on_base.b}, {}}}), near_);
        std::sort(near_.begin(), near_.end());
        for (const int number : near_) {
            const GluedArea& area = *bed->second.areas[static_cast<std::size_t>(number)];
            if (area.element == glue.element) continue;
            for (const Polygon& part : area.on_base) {
                if (std::min(seam_within(glue, part, kInside), seam_within(glue, part, -kInside)) <= least)
                    continue;
                tell_covered(glue, area, seam_within(glue, part, kInside));
                return true;
            }
        }
        return false;
    }

    void tell_covered(const Glue& glue, const GluedArea& area, double covered) {
        Box seam;
        seam.extend(glue.on_base.a);
        seam.extend(glue.on_base.b);
        const Vec2 middle = seam.centre();
        diagnostics_
            .remark(
                "target-covered", glue.place,
                fmt::format("target {} of \"{}\" on \"{}\", round ({:.2f}, {:.2f}) mm of its page, is "
                            "covered over {:.2f} mm of its seam by \"{}\", which must be glued flat there "
                            "before",
                            glue.label, glue.element, plate(glue.base_plate).name, rounded(middle.x, 2),
                            rounded(middle.y, 2), covered, area.element))
            .about(glue.element)
            .with(area.place, fmt::format("\"{}\"", area.element))
            .hint(fmt::format("move \"{}\" or \"{}\" until they are clear of each other, or glue the tab "
                              "onto \"{}\", which moves with the same plate",
                              glue.element, area.element, area.element));
    }

    static Box box_of(const std::vector<Polygon>& parts) {
        Box box;
        for (const Polygon& part : parts) {
            for (const Vec2 p : part.outer) box.extend(p);
        }
        return box;
    }
    static std::string where(const Box& box) {
        return fmt::format("over {:.2f} × {:.2f} mm, round ({:.2f}, {:.2f}) mm of its page", box.width(),
                           box.height(), rounded(box.centre().x, 2), rounded(box.centre().y, 2));
    }

    const Assembly& in_;
    Diagnostics& diagnostics_;
    std::map<std::pair<int, bool>, Bed> beds_;  // by plate and side
    std::vector<int> near_;
};

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
        FlatPlaces(in_, diagnostics_).report();
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
