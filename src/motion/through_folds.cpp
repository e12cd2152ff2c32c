#include "motion/through_folds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>

#include "base/geometry/near_boxes.h"
#include "base/geometry/tolerances.h"
#include "base/nth.h"
#include "motion/bodies.h"
#include "motion/nearness.h"
#include "motion/sweep.h"

namespace popup {
namespace {

constexpr double kInPlaneMm = 1e-3;       // that a fold is off a plane it lies in
constexpr double kLeastThroughMm = 0.02;  // of a fold inside of a plate
constexpr double kLeastSine = 1e-3;       // of planes that are not one
constexpr double kBetween =
    0.02;  // of the sine of the fold's angle: what is nearer to one of its plates lies on it
constexpr double kJustBesideMm = 0.05;  // from a fold, where its plate is looked for
constexpr double kExactDeg = 5e-4;
constexpr std::size_t kFewPlates = 300;
constexpr std::size_t kMostNear = 200;
constexpr int kSteps = 45;
constexpr std::array kNearlyClosed{0.02, 0.1, 0.3, 0.8, 1.5, 2.5};

struct Candidate {
    int hinge = 0;
    int plate = 0;
};

class Search {
 public:
    Search(const Assembly& assembly, std::span<const PlateShape> shapes)
        : assembly_(assembly), shapes_(shapes), frames_(assembly.plates.size()) {}

    std::vector<Contact> run() {
        find_candidates();
        if (candidates_.empty()) return {};
        const std::vector<double> looks = openings();
        std::vector<std::vector<bool>> seen(candidates_.size());
        for (const double deg : looks) {
            const bool reached = put(deg);
            for (std::size_t i = 0; i < candidates_.size(); ++i)
                seen[i].push_back(reached && through(candidates_[i]));
        }
        for (std::size_t i = 0; i < candidates_.size(); ++i) gather(candidates_[i], looks, seen[i]);
        std::sort(found_.begin(), found_.end(), [](const Contact& p, const Contact& q) {
            return std::tuple(p.a, p.b, p.from_deg) < std::tuple(q.a, q.b, q.from_deg);
        });
        return std::move(found_);
    }

 private:
    bool put(double deg) { return place(assembly_, Angle::degrees(deg), frames_); }
    [[nodiscard]] const Hinge& hinge(const Candidate& one) const { return nth(assembly_.hinges, one.hinge); }

    // Whether the line of the fold lies in the plate's plane.
    [[nodiscard]] bool lies_in(const Candidate& one) const {
        const Hinge& fold = hinge(one);
        const Frame& of = nth(frames_, fold.a);
        const Frame& plane = nth(frames_, one.plate);
        const Vec3 normal = plane.normal();
        for (const Vec2 end : {fold.a_line.a, fold.a_line.b}) {
            if (std::abs(dot(of.point(end) - plane.origin, normal)) > kInPlaneMm) return false;
        }
        return true;
    }
    // Whether neither of its plates does. On a card that is nearly closed all do.
    [[nodiscard]] bool parts(const Candidate& one) const {
        const Hinge& fold = hinge(one);
        const Vec3 normal = nth(frames_, one.plate).normal();
        const auto is_other = [&](int plate) {
            return length(cross(nth(frames_, plate).normal(), normal)) > kLeastSine;
        };
        return is_other(fold.a) && is_other(fold.b);
    }

    void find_candidates() {
        const std::vector<int> bodies = bodies_of(assembly_);
        std::vector<Candidate> all;
        const auto offer = [&](int number, int plate) {
            const Hinge& fold = nth(assembly_.hinges, number);
            const int body = nth(bodies, plate);
            if (fold.glued || body == nth(bodies, fold.a) || body == nth(bodies, fold.b)) return;
            const Candidate one{number, plate};
            if (lies_in(one) && parts(one)) all.push_back(one);
        };
        const auto telling = [this](double deg) { return put(opening_at(assembly_.sweep, deg)); };
        if (!offer_near(offer) && telling(kTellingDegs[1])) {
            for (int i = 0; i < static_cast<int>(assembly_.hinges.size()); ++i) {
                for (int k = 0; k < static_cast<int>(assembly_.plates.size()); ++k) offer(i, k);
            }
        }
        for (const double deg : {kTellingDegs[0], kTellingDegs[2]}) {
            if (all.empty() || !telling(deg)) return;
            std::erase_if(all, [this](const Candidate& one) { return !lies_in(one) || !parts(one); });
        }
        candidates_ = std::move(all);
    }

    // Of many plates only those that come near each other. False: there are few.
    template <typename Offer>
    bool offer_near(const Offer& offer) {
        if (assembly_.plates.size() <= kFewPlates) return false;
        std::vector<SpaceBox> boxes(shapes_.size());
        constexpr int kPoses = 8;
        bool any = false;
        for (int pose = 0; pose < kPoses; ++pose) {
            if (!put(opening_at(assembly_.sweep, 180.0 * (pose + 0.5) / kPoses))) continue;
            any = true;
            for (std::size_t i = 0; i < shapes_.size(); ++i) {
                // None may be empty, and between two poses a plate reaches a little further.
                if (shapes_[i].hull.empty()) boxes[i].extend(frames_[i].origin);
                for (const Vec2 corner : shapes_[i].hull)
                    boxes[i].extend(frames_[i].point(corner), 0.2 * shapes_[i].radius + kTouchMm);
            }
        }
        std::vector<std::vector<int>> folds(assembly_.plates.size());
        for (std::size_t i = 0; i < assembly_.hinges.size(); ++i) {
            nth(folds, assembly_.hinges[i].a).push_back(static_cast<int>(i));
            nth(folds, assembly_.hinges[i].b).push_back(static_cast<int>(i));
        }
        if (!any || !put(opening_at(assembly_.sweep, kTellingDegs[1]))) return true;
        for (const auto& [a, b] : near_earlier(boxes, kMostNear)) {
            for (const int fold : nth(folds, a)) offer(fold, b);
            for (const int fold : nth(folds, b)) offer(fold, a);
        }
        return true;
    }

    [[nodiscard]] std::vector<double> openings() const {
        const Sweep& sweep = assembly_.sweep;
        std::vector<double> looks{least_opening(sweep)};
        for (const double deg : kNearlyClosed) looks.push_back(opening_at(sweep, deg));
        for (int i = 1; i <= kSteps; ++i) looks.push_back(opening_at(sweep, 180.0 * i / kSteps));
        return looks;
    }

    // Where a line enters or leaves an outline, as shares of the line; corners beside it, too.
    static void cut(const Segment& line, const PlateShape& shape, std::vector<double>& cuts) {
        const Vec2 along = line.b - line.a;
        const double size = length(along);
        const auto offer = [&](double t) {
            if (t > 0.0 && t < 1.0) cuts.push_back(t);
        };
        for (const std::vector<Vec2>& ring : shape.rings) {
            for (std::size_t i = 0; i < ring.size(); ++i) {
                const Vec2 p = ring[i] - line.a;
                const Vec2 q = ring[(i + 1) % ring.size()] - line.a;
                const double beside = cross(along, p) / size;
                const double next = cross(along, q) / size;
                if (std::abs(beside) <= kInPlaneMm) offer(dot(p, along) / (size * size));
                if ((beside > 0.0) != (next > 0.0)) {
                    const double share = beside / (beside - next);
                    offer(dot(lerp(p, q, share), along) / (size * size));
                }
            }
        }
    }

    // From a point of the fold into one of its plates, square to it; nullopt where there is paper on both
    // sides of the point, or on none.
    [[nodiscard]] std::optional<Vec3> into(int plate, const Segment& line, double share) const {
        const Vec2 side = unit(left_of(line.b - line.a));
        const Vec2 at = lerp(line.a, line.b, share);
        const PlateShape& shape = nth(shapes_, plate);
        const bool left = shape.covers(at + kJustBesideMm * side);
        if (left == shape.covers(at - kJustBesideMm * side)) return std::nullopt;
        return nth(frames_, plate).direction(left ? side : -side);
    }

    // Whether paper is folded at a point of the fold, and the plate lies between its two sides on one side of
    // the fold and outside on the other.
    [[nodiscard]] bool parts_paper(const Candidate& one, double share) const {
        const Hinge& fold = hinge(one);
        const auto to_a = into(fold.a, fold.a_line, share);
        const auto to_b = into(fold.b, fold.b_line, share);
        if (!to_a || !to_b) return false;
        const Vec3 along = nth(frames_, fold.a).direction(unit(fold.a_line.b - fold.a_line.a));
        const Vec3 across = cross(nth(frames_, one.plate).normal(), along);
        // All are square to the fold: angles about it.
        const auto turn = [&along](Vec3 p, Vec3 q) { return dot(cross(p, q), along); };
        const double wedge = turn(*to_a, *to_b);
        // Of a fold that is flat, or shut.
        if (std::abs(wedge) < kLeastSine * kLeastSine)
            return dot(*to_a, *to_b) < 0.0 && std::abs(turn(*to_a, across)) > kLeastSine;
        for (const Vec3 way : {across, -1.0 * across}) {
            if (turn(*to_a, way) / wedge > kBetween && turn(way, *to_b) / wedge > kBetween) return true;
        }
        return false;
    }

    // Where the plate goes through the fold, if it does for more than kLeastThroughMm: the middle of the
    // longest stretch.
    [[nodiscard]] std::optional<Vec3> through(const Candidate& one) const {
        if (!lies_in(one)) return std::nullopt;
        const Hinge& fold = hinge(one);
        const Frame& plane = nth(frames_, one.plate);
        const Vec3 from = nth(frames_, fold.a).point(fold.a_line.a);
        const Vec3 to = nth(frames_, fold.a).point(fold.a_line.b);
        const Segment seen{on_page(plane, from), on_page(plane, to)};
        const double size = length(seen.b - seen.a);
        if (size < kLeastThroughMm) return std::nullopt;
        const PlateShape& shape = nth(shapes_, one.plate);
        std::vector<double> cuts{0.0, 1.0};
        cut(seen, shape, cuts);
        if (cuts.size() == 2 && !shape.covers(lerp(seen.a, seen.b, 0.5))) return std::nullopt;
        cut(fold.a_line, nth(shapes_, fold.a), cuts);
        cut(fold.b_line, nth(shapes_, fold.b), cuts);
        std::sort(cuts.begin(), cuts.end());
        double sum = 0.0;
        double most = 0.0;
        std::optional<Vec3> middle;
        for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
            const double share = 0.5 * (cuts[i] + cuts[i + 1]);
            const double here = (cuts[i + 1] - cuts[i]) * size;
            const Vec2 at = lerp(seen.a, seen.b, share);
            if (!shape.covers(at) || shape.to_edge(at, 2.0 * kTouchMm) < kTouchMm || !parts_paper(one, share))
                continue;
            sum += here;
            if (here > most) middle = from + share * (to - from);
            most = std::max(most, here);
        }
        return sum > kLeastThroughMm ? middle : std::nullopt;
    }

    // The angle between the two at which it changes, to kExactDeg.
    double change(const Candidate& one, double without, double with) {
        while (std::abs(with - without) > kExactDeg) {
            const double middle = 0.5 * (without + with);
            (put(middle) && through(one) ? with : without) = middle;
        }
        return with;
    }

    void gather(const Candidate& one, const std::vector<double>& looks, const std::vector<bool>& seen) {
        for (std::size_t i = 0; i < looks.size(); ++i) {
            if (!seen[i]) continue;
            std::size_t last = i;
            while (last + 1 < looks.size() && seen[last + 1]) ++last;
            const double from = i == 0 ? assembly_.sweep.from_deg : change(one, looks[i - 1], looks[i]);
            const double to =
                last + 1 == looks.size() ? looks[last] : change(one, looks[last + 1], looks[last]);
            add(one, from, to);
            i = last;
        }
    }

    void add(const Candidate& one, double from, double to) {
        const Hinge& fold = hinge(one);
        const auto rounded = [](double deg) { return std::round(1000.0 * deg) / 1000.0; };
        put(to);
        const Vec3 point = through(one).value_or(nth(frames_, fold.a).point(fold.a_line.a));
        for (const int other : {fold.a, fold.b}) {
            Contact contact;
            std::tie(contact.a, contact.b) = std::minmax(one.plate, other);
            contact.from_deg = rounded(from);
            contact.to_deg = rounded(to);
            contact.deepest_deg = contact.from_deg;
            contact.longer = one.plate;
            contact.point = point;
            contact.at_fold = true;
            found_.push_back(contact);
        }
    }

    const Assembly& assembly_;
    std::span<const PlateShape> shapes_;
    std::vector<Frame> frames_;
    std::vector<Candidate> candidates_;
    std::vector<Contact> found_;
};

}  // namespace

std::vector<Contact> find_through_folds(const Assembly& assembly, std::span<const PlateShape> shapes) {
    return Search(assembly, shapes).run();
}

}  // namespace popup
