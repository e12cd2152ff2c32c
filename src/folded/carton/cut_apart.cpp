#include "folded/carton/cut_apart.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <utility>

#include "base/nth.h"

namespace popup::folded {
namespace {

class ApartSheet {
 public:
    explicit ApartSheet(const RoughShape& rough) : from_(rough.sheet) {
        for (std::size_t i = 0; i < from_.panels.size(); ++i) {
            const auto panel = static_cast<int>(i);
            each_ring(from_.panels[i], [&](const std::vector<int>& ring) {
                for (std::size_t k = 0; k < ring.size(); ++k) {
                    number({panel, ring[k]});
                    edges_.insert(std::minmax(ring[k], ring[(k + 1) % ring.size()]));
                }
            });
        }
        for (const Fold& fold : from_.folds) {
            for (const Stretch one : fold.stretches) {
                for (const int corner : {one.a, one.b}) unite({fold.left, corner}, {fold.right, corner});
                folds_.insert(std::minmax(one.a, one.b));
            }
        }
        find_inner_slits();
        out_.sheet = from_;
        out_.tree = rough.tree;
        out_.angles = rough.angles;
        out_.names = rough.names;
        out_.sheet.loops.clear();  // their corners have other numbers
        renumber();
    }
    ApartShape take() { return {std::move(out_), std::move(corners_)}; }

 private:
    template <typename Visit>
    static void each_ring(const Panel& panel, const Visit& visit) {
        visit(panel.outer);
        for (const std::vector<int>& hole : panel.holes) visit(hole);
    }

    int number(CornerOf one) {
        const auto [at, fresh] = numbers_.try_emplace(one, static_cast<int>(roots_.size()));
        if (fresh) roots_.push_back(at->second);
        return at->second;
    }
    int root(int one) {
        while (nth(roots_, one) != one) one = nth(roots_, one) = nth(roots_, nth(roots_, one));
        return one;
    }
    void unite(CornerOf a, CornerOf b) {
        const int one = root(number(a));
        const int other = root(number(b));
        nth(roots_, std::max(one, other)) = std::min(one, other);
    }

    // Slits that are no edge of a panel belong to the one that they lie in.
    void find_inner_slits() {
        for (std::size_t piece = 0; piece < from_.cuts.size(); ++piece) {
            for (const Stretch cut : from_.cuts[piece]) {
                if (edges_.contains(std::minmax(cut.a, cut.b))) continue;
                const Vec2 middle = lerp(from_.at(cut.a), from_.at(cut.b), 0.5);
                for (std::size_t i = 0; i < from_.panels.size(); ++i) {
                    if (!contains(from_.outline_of(from_.panels[i]), middle)) continue;
                    const auto panel = static_cast<int>(i);
                    number({panel, cut.a});
                    number({panel, cut.b});
                    slits_.emplace_back(panel, cut);
                    break;
                }
            }
        }
    }

    void renumber() {
        std::map<int, int> fresh;  // of roots
        out_.sheet.corners.clear();
        const auto now = [&](CornerOf one) {
            const auto [at, is_new] =
                fresh.try_emplace(root(number(one)), static_cast<int>(out_.sheet.corners.size()));
            if (is_new) out_.sheet.corners.push_back(from_.at(one.corner));
            return at->second;
        };
        corners_.resize(from_.panels.size());
        for (std::vector<Stretch>& cuts : out_.sheet.cuts) cuts.clear();
        for (std::size_t i = 0; i < from_.panels.size(); ++i) {
            const auto panel = static_cast<int>(i);
            const auto ring_of = [&](const std::vector<int>& ring) {
                std::vector<int> made;
                made.reserve(ring.size());
                for (const int corner : ring) made.push_back(now({panel, corner}));
                for (std::size_t k = 0; k < ring.size(); ++k) {
                    const std::size_t next = (k + 1) % ring.size();
                    if (folds_.contains(std::minmax(ring[k], ring[next]))) continue;
                    nth(out_.sheet.cuts, from_.panels[i].piece).push_back({made[k], made[next]});
                }
                corners_[i].insert(corners_[i].end(), made.begin(), made.end());
                return made;
            };
            out_.sheet.panels[i].outer = ring_of(from_.panels[i].outer);
            for (std::size_t k = 0; k < from_.panels[i].holes.size(); ++k)
                out_.sheet.panels[i].holes[k] = ring_of(from_.panels[i].holes[k]);
        }
        for (const auto& [panel, cut] : slits_) {
            const Stretch made{now({panel, cut.a}), now({panel, cut.b})};
            nth(out_.sheet.cuts, nth(from_.panels, panel).piece).push_back(made);
            nth(corners_, panel).insert(nth(corners_, panel).end(), {made.a, made.b});
        }
        for (std::size_t i = 0; i < from_.folds.size(); ++i) {
            for (std::size_t k = 0; k < from_.folds[i].stretches.size(); ++k) {
                const Stretch one = from_.folds[i].stretches[k];
                out_.sheet.folds[i].stretches[k] = {now({from_.folds[i].left, one.a}),
                                                    now({from_.folds[i].left, one.b})};
            }
        }
    }

    const Sheet& from_;
    RoughShape out_;
    std::map<CornerOf, int> numbers_;
    std::vector<int> roots_;
    std::set<std::pair<int, int>> edges_, folds_;
    std::vector<std::pair<int, Stretch>> slits_;
    std::vector<std::vector<int>> corners_;
};

}  // namespace

ApartShape cut_apart(const RoughShape& rough) { return ApartSheet(rough).take(); }

}  // namespace popup::folded
