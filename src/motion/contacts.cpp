#include "motion/contacts.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/geometry/regions.h"
#include "base/geometry/tolerances.h"
#include "motion/cells.h"
#include "motion/depth.h"
#include "motion/touching.h"

namespace popup {
namespace {

constexpr double kEdgeMm = 1e-4;  // softer crossing than this is not even contact
constexpr double kFirstStepDeg = 0.005;
constexpr double kMostStepDeg = 0.02;  // a shorter gap between two contacts may go unseen
constexpr double kPreciseDeg = 1e-5;
constexpr double kSameDeg = 2e-3;  // as far as rounding sets the same angle apart
constexpr int kSamples = 24;       // where the depth is looked at
// How far from a touch plates may have a side again, if they get as far as kTouchMm from each other.
constexpr std::array kAsideDegs{0.001, 0.01, 0.1, 1.0};

constexpr double kDeepestDeg = 1e-3;     // to which the angle of the greatest depth is found
constexpr double kNearlyParallel = 0.1;  // sine of the angle between plates
constexpr double kInnerMm = 0.1;

double rounded_deg(double deg) { return std::round(deg * 1000.0) / 1000.0; }

struct Range {
    double least = 0.0, most = 0.0;
};

struct Pair {
    int a, b;
    PairSearch& search;

    [[nodiscard]] bool meet(double deg) const {
        const auto at = search.at(a, b, deg);
        // Near the closed card everything shrinks as the angle does, and so does what counts.
        return at.crossing && at.crossing->firmness_mm() > kEdgeMm * std::min(deg, 1.0);
    }

    // The end of the contact that holds at `deg`, looked for up to `limit` (below or above).
    [[nodiscard]] double end_of_contact(double deg, double limit) const {
        const double way = limit < deg ? -1.0 : 1.0;
        double inside = deg;
        double step = kFirstStepDeg;
        double outside = limit;
        while (way * (limit - inside) > 0.0) {
            const double next = way * (limit - (inside + way * step)) > 0.0 ? inside + way * step : limit;
            if (!meet(next)) {
                outside = next;
                break;
            }
            inside = next;
            step = std::min(2.0 * step, kMostStepDeg);
        }
        if (inside == limit) return limit;
        while (std::abs(outside - inside) > kPreciseDeg) {
            const double middle = 0.5 * (inside + outside);
            (meet(middle) ? inside : outside) = middle;
        }
        return inside;
    }

    // Whether they cross firmly anywhere in stretches that hold together.
    [[nodiscard]] bool firm(std::span<const ContactRange> stretches) const {
        for (const ContactRange& one : stretches) {
            if (one.firm) return true;
            if (one.kind != ContactRange::crossing) continue;
            const double step = (one.to - one.from) / kSamples;
            for (int i = 0; i <= kSamples; ++i) {
                const auto at = search.at(a, b, one.from + i * step);
                if (at.crossing && at.crossing->firm()) return true;
            }
        }
        return false;
    }

    [[nodiscard]] double depth_of(const PairSearch::At& at) const {
        return depth_mm(search.shape(a), search.shape(b), at.b_in_a);
    }

    // Where they are deepest; `excess` becomes the most there is anywhere.
    [[nodiscard]] double deepest(double from, double to, double& excess) const {
        double best = 0.5 * (from + to);
        double most = -1.0;
        const auto look = [&](double deg) {
            const auto at = search.at(a, b, deg);
            if (!at.crossing) return;
            excess = std::max(excess, at.crossing->excess_mm);
            const double depth = depth_of(at);
            if (depth <= most) return;
            most = depth;
            best = deg;
        };
        look(best);
        double step = (to - from) / kSamples;
        for (int i = 0; i <= kSamples; ++i) look(from + i * step);
        while (step > kDeepestDeg) {
            step *= 0.5;
            const double centre = best;
            if (centre - step > from) look(centre - step);
            if (centre + step < to) look(centre + step);
        }
        return best;
    }

    // The corner of the longer plate that stands as far out of the other as it reaches; of several the
    // nearest one.
    [[nodiscard]] Vec2 furthest_corner(const PairSearch::At& at) const {
        const Crossing& here = *at.crossing;
        const bool of_b = here.b_is_longer;
        const Vec2 meeting = of_b ? on_page(at.b_in_a, here.point) : Vec2{here.point.x, here.point.y};
        Vec2 best;
        std::pair<double, double> least{HUGE_VAL, HUGE_VAL};
        for (const Ring& ring : search.shape(of_b ? b : a).rings) {
            for (const Vec2 p : ring) {
                const double height = of_b ? at.b_in_a.point(p).z
                                           : dot(Vec3{p.x, p.y, 0.0} - at.b_in_a.origin, at.b_in_a.normal());
                const double off = std::abs(std::abs(height) - here.excess_mm * here.sine);
                const std::pair<double, double> order{off < kSameHeightMm ? 0.0 : off, distance(p, meeting)};
                if (order >= least) continue;
                least = order;
                best = p;
            }
        }
        return best;
    }

    [[nodiscard]] Contact contact(double from, double to) const {
        Contact found;
        found.a = a;
        found.b = b;
        found.deepest_deg = deepest(from, to, found.excess_mm);
        const auto deep = search.at(a, b, found.deepest_deg);
        if (deep.crossing) {
            found.depth_mm = depth_of(deep);
            found.longer = deep.crossing->b_is_longer ? b : a;
            found.corner = furthest_corner(deep);
        }
        const auto last = search.at(a, b, to);
        const auto& there = last.crossing ? last : deep;
        if (there.crossing) {
            const Vec3 p = there.crossing->point;
            found.point = there.a.point({p.x, p.y});
        }
        found.from_deg = from <= least_opening(search.sweep()) ? search.sweep().from_deg : rounded_deg(from);
        found.to_deg = rounded_deg(to);
        found.deepest_deg = rounded_deg(found.deepest_deg);
        return found;
    }

    // Which side of a the point of b is on that touches it, and of b the point of a; 0: neither for certain.
    [[nodiscard]] int side(double deg, Vec2 of_a, Vec2 of_b) const {
        const auto at = search.frames_at(a, b, deg);
        return side_of(search.shape(a), search.shape(b), at.b_in_a, of_a, of_b);
    }

    // Adds how far b reaches below and above a at an angle.
    void heights(double deg, Range& range) const {
        const auto at = search.frames_at(a, b, deg);
        if (!at.reached) return;
        for (const Vec2 p : search.shape(b).hull) {
            const double height = at.b_in_a.point(p).z;
            range = {std::min(range.least, height), std::max(range.most, height)};
        }
    }

    // Whether any point of b is on one side of a before it touches, and any on the other side afterwards.
    // Plates that lie on one another need no closer look.
    [[nodiscard]] bool may_pass(double from, double to) const {
        constexpr double kSideMm = 0.5 * kTouchMm;  // less than what side() asks for
        Range before;
        Range after;
        for (const double aside : kAsideDegs) {
            heights(std::max(from - aside, least_opening(search.sweep())), before);
            heights(std::min(to + aside, search.sweep().to_deg), after);
            if ((before.most > kSideMm && after.least < -kSideMm) ||
                (before.least < -kSideMm && after.most > kSideMm))
                return true;
        }
        return false;
    }

    // The middle of what lies over one another, seen square to a.
    [[nodiscard]] std::optional<Vec2> middle_of_common(const PairSearch::At& at) const {
        const auto polygon = [](std::vector<Ring> rings) {
            Polygon result{std::move(rings.front()), {}};
            result.holes.assign(rings.begin() + 1, rings.end());
            return result;
        };
        std::vector<Ring> of_b = search.shape(b).rings;
        for (Ring& ring : of_b) {
            for (Vec2& p : ring) {
                const Vec3 there = at.b_in_a.point(p);
                p = {there.x, there.y};
            }
        }
        std::optional<InnerPoint> best;
        for (const Polygon& part : intersect({polygon(search.shape(a).rings)}, {polygon(std::move(of_b))})) {
            const InnerPoint inner = inner_point(part, kInnerMm);
            if (!best || inner.clearance > best->clearance) best = inner;
        }
        return best ? std::optional(best->at) : std::nullopt;
    }

    // Whether plates that touch from … to have changed sides.
    [[nodiscard]] std::optional<Contact> passing(double from, double to) const {
        const double first = least_opening(search.sweep());
        const double last = search.sweep().to_deg;
        if (from <= first || to >= last) return std::nullopt;
        // Only plates that are nearly parallel do that without crossing along a line.
        const auto at = search.frames_at(a, b, 0.5 * (from + to));
        if (sine_between(at.b_in_a) > kNearlyParallel || !may_pass(from, to)) return std::nullopt;
        const auto common = middle_of_common(at);
        if (!common) return std::nullopt;
        const Vec2 of_a = *common;
        const Vec2 of_b = on_page(at.b_in_a, {of_a.x, of_a.y, 0.0});
        int before = 0;
        int after = 0;
        double low = from;
        double high = to;
        for (const double aside : kAsideDegs) {
            if (before == 0) before = side(low = std::max(from - aside, first), of_a, of_b);
            if (after == 0) after = side(high = std::min(to + aside, last), of_a, of_b);
        }
        if (before * after >= 0) return std::nullopt;
        while (high - low > kPreciseDeg) {
            const double middle = 0.5 * (low + high);
            const double height = search.frames_at(a, b, middle).b_in_a.point(of_b).z;
            ((height > 0.0) == (before > 0) ? low : high) = middle;
        }
        Contact found;
        found.a = a;
        found.b = b;
        found.from_deg = found.to_deg = found.deepest_deg = rounded_deg(low);
        found.longer = b;
        found.point = at.a.point(of_a);
        return found;
    }
};

}  // namespace

void find_contacts(int a, int b, std::span<const ContactRange> stretches, PairSearch& search,
                   Contacts& result) {
    const Pair pair{a, b, search};
    double limit = least_opening(search.sweep());  // where the contact before this one ends
    double begin = limit;                          // and where it began
    std::optional<std::size_t> before;             // and where it stands in the result
    for (std::size_t i = 0; i < stretches.size();) {
        std::size_t end = i + 1;
        while (end < stretches.size() && stretches[end].from == stretches[end - 1].to) ++end;
        const ContactRange* first = nullptr;
        const ContactRange* last = nullptr;
        for (std::size_t k = i; k < end; ++k) {
            const ContactRange& one = stretches[k];
            if (one.kind == ContactRange::crossing) {
                if (first == nullptr) first = &one;
                last = &one;
            }
            if (one.kind != ContactRange::undecided) continue;
            result.undecided.push_back({a, b, rounded_deg(one.from), rounded_deg(one.to)});
        }
        if (first != nullptr && !pair.firm(stretches.subspan(i, end - i))) first = nullptr;
        if (first != nullptr) {
            const auto start = [&](double end, double middle) { return pair.meet(end) ? end : middle; };
            const double from =
                pair.end_of_contact(start(first->from, 0.5 * (first->from + first->to)), limit);
            const double to =
                pair.end_of_contact(start(last->to, 0.5 * (last->from + last->to)), search.sweep().to_deg);
            if (before && from <= limit) {
                // It is the same contact as the one before: shallow in between.
                result.contacts.resize(*before);
            } else {
                before = result.contacts.size();
                begin = from;
            }
            result.contacts.push_back(pair.contact(begin, to));
            limit = to;
            while (end < stretches.size() && stretches[end].to <= to) ++end;
        } else if (const auto passing = pair.passing(stretches[i].from, stretches[end - 1].to)) {
            // They may touch in several stretches round the angle at which they pass.
            const bool told = !result.contacts.empty() && result.contacts.back().a == a &&
                              result.contacts.back().b == b &&
                              passing->from_deg - result.contacts.back().to_deg < kSameDeg;
            if (!told) result.contacts.push_back(*passing);
        }
        i = end;
    }
}

}  // namespace popup
