#include "motion/mend.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>
#include <vector>

#include "motion/closed_card.h"
#include "motion/joints/joint.h"
#include "motion/trials.h"

namespace popup {
namespace {

constexpr double kFirstMm = 0.5;
constexpr double kFurthestMm = 100.0;
constexpr double kPreciseMm = 0.02;
constexpr double kPastGrazeMm = 0.04;
constexpr int kMostLessons = 12;
constexpr int kMostThirds = 4;  // that a move is to go past

// To the hundredth, as it is told: who obeys has moved far enough.
double rounded_up(double mm) { return std::ceil(mm * 100.0 - 1e-9) / 100.0; }

// A card of which one element is moved along its line.
class Slide {
 public:
    explicit Slide(const Assembly& assembly) : assembly_(assembly), trial_(assembly) {}

    const Assembly& moved(int joint, double mm) {
        back();
        const auto number = static_cast<std::size_t>(joint);
        trial_.joints[number].how = slid(assembly_.joints[number], mm)->how;
        moved_ = joint;
        return trial_;
    }
    [[nodiscard]] ElementMove as_move(int joint, double mm) const {
        const auto there = slid(assembly_.joints[static_cast<std::size_t>(joint)], mm);
        return {joint, there->by, there->along};
    }

 private:
    void back() {
        const auto number = static_cast<std::size_t>(moved_);
        if (moved_ >= 0) trial_.joints[number] = assembly_.joints[number];
    }

    const Assembly& assembly_;
    Assembly trial_;
    int moved_ = -1;
};

// The shortest move beyond `low` mm, and up to `high`, of a joint in one sense that frees the pairs.
std::optional<double> shortest_that_frees(Slide& slide, Trials& trials, int joint, double sense, double low,
                                          double high) {
    const auto glance = [&](double mm) {
        return !trials.crosses_at_a_glance(slide.moved(joint, sense * mm));
    };
    bool lesson = false;
    const auto examined = [&](double mm) {
        return !trials.in_contact(slide.moved(joint, sense * mm), lesson);
    };
    double tried = low;
    for (int i = 0; i < kMostLessons && trials.any_left(); ++i) {
        if (!glance(high)) return std::nullopt;
        tried = high;
        for (double not_free = low; tried - not_free > kPreciseMm;) {
            const double middle = 0.5 * (not_free + tried);
            (glance(middle) ? tried : not_free) = middle;
        }
        tried = rounded_up(tried);
        if (examined(tried)) return tried;
        if (!lesson) break;
    }
    // What only grazes is seen by no glance, and takes most poses; a little further it is clear at once.
    for (double more = kPastGrazeMm; !lesson && trials.any_left(); more *= 2.0) {
        const double further = std::min(rounded_up(tried + more), high);
        if (examined(further)) return further;
        if (further >= high) break;
    }
    return std::nullopt;
}

// One of the senses in which an element may be moved, and what must come free then: third elements that turn
// out to be in the way are added.
struct Way {
    int joint = 0;
    int still = 0;  // the other one
    double sense = 1.0;
    std::vector<std::pair<int, int>> pairs;
    int thirds = 0;
};

class FreeingSearch {
 public:
    FreeingSearch(const Assembly& assembly, const Linkage& linkage, std::span<const PlateShape> shapes,
                  std::span<const Contact> contacts, MoveBudget& budget, const MoveTest& holds,
                  bool lies_nowhere)
        : assembly_(assembly),
          linkage_(linkage),
          shapes_(shapes),
          contacts_(contacts),
          budget_(budget),
          lies_nowhere_(lies_nowhere),
          surroundings_(assembly, linkage, shapes, contacts, budget, holds),
          slide_(assembly) {}

    // The shortest move beyond `low` mm, and up to `high`, that frees the pairs and to which nothing objects.
    std::optional<double> shortest(Way& way, Trials& trials, double low, double high) {
        const auto found = shortest_that_frees(slide_, trials, way.joint, way.sense, low, high);
        if (!found) return std::nullopt;
        const double mm = way.sense * *found;
        const auto objection = surroundings_.objection(slide_.moved(way.joint, mm), way.joint,
                                                       slide_.as_move(way.joint, mm).by, lies_nowhere_);
        if (!objection) return found;
        if (!objection->with || !add_third(way, *objection->with)) return std::nullopt;
        Trials with_third(assembly_, linkage_, shapes_, way.pairs, contacts_, budget_);
        return shortest(way, with_third, std::min(*found, high), high);
    }

    // Further and further in all ways at once; of those that are free first, the shortest. All ways learn
    // from one another while they have the same pairs.
    std::optional<ElementMove> shortest(std::vector<Way> ways, Trials& trials) {
        std::optional<ElementMove> best;
        double before = 0.0;
        while (!ways.empty() && !best && before < kFurthestMm && trials.any_left()) {
            double furthest = std::clamp(2.0 * before, kFirstMm, kFurthestMm);
            for (Way& way : ways) {
                std::optional<Trials> own;
                if (way.thirds > 0) own.emplace(assembly_, linkage_, shapes_, way.pairs, contacts_, budget_);
                const auto found = shortest(way, own ? *own : trials, before, furthest);
                if (!found) continue;
                furthest = *found;
                best = slide_.as_move(way.joint, way.sense * *found);
            }
            before = furthest;
        }
        return best;
    }

    // Whether nothing lies on the one that stays where it is, once the other is moved.
    bool frees_both(const Way& way) { return !surroundings_.lies_elsewhere(way.still, way.joint); }

 private:
    // False: its pairs are looked at already, there were enough of them, or no joint places it.
    bool add_third(Way& way, std::pair<int, int> with) {
        const int one_joint = linkage_.joint_of(with.first);
        const int other_joint = linkage_.joint_of(with.second);
        if (++way.thirds > kMostThirds || one_joint < 0 || other_joint < 0) return false;
        const auto pairs = pairs_between(assembly_, one_joint, other_joint);
        const std::size_t before = way.pairs.size();
        for (const auto& one : pairs) {
            if (std::find(way.pairs.begin(), way.pairs.end(), one) == way.pairs.end())
                way.pairs.push_back(one);
        }
        return way.pairs.size() > before;
    }

    const Assembly& assembly_;
    const Linkage& linkage_;
    std::span<const PlateShape> shapes_;
    std::span<const Contact> contacts_;
    MoveBudget& budget_;
    bool lies_nowhere_;
    Surroundings surroundings_;
    Slide slide_;
};

}  // namespace

std::vector<std::pair<int, int>> pairs_between(const Assembly& assembly, int joint, int other) {
    const auto plates = [&](int number) {
        return plates_of(assembly.joints[static_cast<std::size_t>(number)]).places;
    };
    std::vector<std::pair<int, int>> pairs;
    for (const PlacedPlate& a : plates(joint)) {
        for (const PlacedPlate& b : plates(other)) pairs.emplace_back(std::minmax(a.plate, b.plate));
    }
    return pairs;
}

std::optional<ElementMove> freeing_move(const Assembly& assembly, const Linkage& linkage,
                                        std::span<const PlateShape> shapes,
                                        std::span<const std::pair<int, int>> pairs,
                                        std::span<const Contact> contacts, MoveBudget& budget,
                                        const MoveTest& holds, bool lies_nowhere) {
    const int first = linkage.joint_of(pairs[0].first);
    const int second = linkage.joint_of(pairs[0].second);
    std::vector<Way> ways;
    for (const auto& [joint, still] : {std::pair{first, second}, std::pair{second, first}}) {
        if (!slid(assembly.joints[static_cast<std::size_t>(joint)], kFirstMm)) continue;
        for (const double sense : {1.0, -1.0})
            ways.push_back({joint, still, sense, {pairs.begin(), pairs.end()}, 0});
    }
    Trials trials(assembly, linkage, shapes, pairs, contacts, budget);
    FreeingSearch search(assembly, linkage, shapes, contacts, budget, holds, lies_nowhere);
    if (lies_nowhere) {
        std::vector<Way> good;
        std::copy_if(ways.begin(), ways.end(), std::back_inserter(good),
                     [&](const Way& way) { return search.frees_both(way); });
        if (const auto best = search.shortest(good, trials)) return best;
        if (good.size() == ways.size()) return std::nullopt;
    }
    return search.shortest(std::move(ways), trials);
}

std::optional<ElementMove> tucking_move(const Assembly& assembly, const Linkage& linkage,
                                        std::span<const PlateShape> shapes, int joint,
                                        std::span<const Protrusion> before, std::span<const Contact> contacts,
                                        MoveBudget& budget, const MoveTest& holds) {
    if (!slid(assembly.joints[static_cast<std::size_t>(joint)], kFirstMm)) return std::nullopt;
    std::vector<int> out;  // plates that may stick out
    for (const Protrusion& one : before) {
        if (linkage.joint_of(one.plate) != joint) out.push_back(one.plate);
    }
    Slide slide(assembly);
    Surroundings surroundings(assembly, linkage, shapes, contacts, budget, holds);
    const auto is_tucked = [&](double mm) {
        const std::vector<Protrusion> left = find_protrusions(slide.moved(joint, mm));
        return std::all_of(left.begin(), left.end(), [&](const Protrusion& one) {
            return std::find(out.begin(), out.end(), one.plate) != out.end();
        });
    };
    double low = 0.0;
    for (double high = kFirstMm; low < kFurthestMm; low = high, high = std::min(2.0 * high, kFurthestMm)) {
        for (const double sense : {1.0, -1.0}) {
            if (!is_tucked(sense * high)) continue;
            double shortest = high;
            for (double not_tucked = low; shortest - not_tucked > kPreciseMm;) {
                const double middle = 0.5 * (not_tucked + shortest);
                (is_tucked(sense * middle) ? shortest : not_tucked) = middle;
            }
            shortest = rounded_up(shortest);
            const ElementMove move = slide.as_move(joint, sense * shortest);
            if (!surroundings.objection(slide.moved(joint, sense * shortest), joint, move.by, false))
                return move;
        }
    }
    return std::nullopt;
}

}  // namespace popup
