#include "parts/joining.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "base/geometry/cells.h"

namespace popup::drawing {
namespace {

std::size_t at(int number) { return static_cast<std::size_t>(number); }

// Numbers points; those within kJoinMm of the first of a number get that number.
class Spots {
 public:
    int number(Vec2 p) {
        const PlaneCell home{std::llround(p.x / kJoinMm), std::llround(p.y / kJoinMm)};
        for (std::int64_t dx = -1; dx <= 1; ++dx) {
            for (std::int64_t dy = -1; dy <= 1; ++dy) {
                const auto found = cells_.find({home.x + dx, home.y + dy});
                if (found == cells_.end()) continue;
                for (const int spot : found->second) {
                    if (distance(spots_[at(spot)].first, p) <= kJoinMm) return add(spot, p);
                }
            }
        }
        cells_[home].push_back(static_cast<int>(spots_.size()));
        spots_.push_back({p, {}, 0});
        return add(static_cast<int>(spots_.size()) - 1, p);
    }
    // The mean of all points of the number.
    [[nodiscard]] Vec2 middle(int spot) const {
        const Spot& s = spots_[at(spot)];
        return s.first + (1.0 / s.count) * s.sum;
    }
    [[nodiscard]] std::size_t size() const { return spots_.size(); }

 private:
    struct Spot {
        Vec2 first, sum;  // the sum of how far points are from the first
        int count = 0;
    };
    int add(int spot, Vec2 p) {
        Spot& s = spots_[at(spot)];
        s.sum = s.sum + (p - s.first);
        ++s.count;
        return spot;
    }
    std::unordered_map<PlaneCell, std::vector<int>, PlaneCellHash> cells_;  // only ever asked, never walked
    std::vector<Spot> spots_;
};

bool same_points(const std::vector<Vec2>& a, const std::vector<Vec2>& b, bool back) {
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (distance(a[i], b[back ? b.size() - 1 - i : i]) > kJoinMm) return false;
    }
    return true;
}

// Line i leaves its first point as end 2i, and its last as end 2i + 1.
class Joiner {
 public:
    explicit Joiner(std::vector<OpenLine> lines) : lines_(std::move(lines)) {}

    Joined run() {
        for (const OpenLine& line : lines_) {
            spot_of_.push_back(spots_.number(line.points.front()));
            spot_of_.push_back(spots_.number(line.points.back()));
        }
        free_.assign(lines_.size(), 1);
        drop_doubles();
        take_single_loops();
        std::vector<char> core = without_dead_ends();
        follow(core, true);
        core = free_;
        follow(core, false);
        std::stable_sort(out_.lines.begin(), out_.lines.end(), [](const JoinedLine& a, const JoinedLine& b) {
            return a.elements.front() < b.elements.front();
        });
        return std::move(out_);
    }

 private:
    struct Step {
        int line = 0;
        bool back = false;
    };

    [[nodiscard]] int spot(std::size_t end) const { return spot_of_[end]; }

    void drop_doubles() {
        constexpr std::size_t kCompared = 32;
        std::map<std::tuple<int, int, std::size_t>, std::vector<int>> alike;
        for (std::size_t i = 0; i < lines_.size(); ++i) {
            const int first = spot(2 * i);
            const int last = spot(2 * i + 1);
            std::vector<int>& others =
                alike[{std::min(first, last), std::max(first, last), lines_[i].points.size()}];
            const bool twice =
                std::any_of(others.begin(),
                            others.begin() + static_cast<std::ptrdiff_t>(std::min(others.size(), kCompared)),
                            [&](int other) {
                                return same_points(lines_[at(other)].points, lines_[i].points, false) ||
                                       same_points(lines_[at(other)].points, lines_[i].points, true);
                            });
            if (twice) {
                free_[i] = 0;
                out_.doubled.push_back(lines_[i].element);
            } else {
                others.push_back(static_cast<int>(i));
            }
        }
    }

    // Lines that end where they begin; those without an extent are none.
    void take_single_loops() {
        for (std::size_t i = 0; i < lines_.size(); ++i) {
            if (free_[i] == 0 || spot(2 * i) != spot(2 * i + 1)) continue;
            free_[i] = 0;
            if (length_of(lines_[i].points) <= 2.0 * kJoinMm) continue;
            emit({{static_cast<int>(i), false}}, true);
        }
    }

    // Which lines are left when those that end at nothing are taken away, again and again.
    [[nodiscard]] std::vector<char> without_dead_ends() const {
        std::vector<char> core = free_;
        std::vector<std::vector<int>> ends(spots_.size());
        std::vector<int> degree(spots_.size(), 0);
        for (std::size_t end = 0; end < spot_of_.size(); ++end) {
            if (core[end / 2] == 0) continue;
            ends[at(spot(end))].push_back(static_cast<int>(end));
            ++degree[at(spot(end))];
        }
        std::vector<int> waiting;
        for (std::size_t i = 0; i < degree.size(); ++i) {
            if (degree[i] == 1) waiting.push_back(static_cast<int>(i));
        }
        while (!waiting.empty()) {
            const int dead = waiting.back();
            waiting.pop_back();
            for (const int end : ends[at(dead)]) {
                const std::size_t line = at(end) / 2;
                if (core[line] == 0) continue;
                core[line] = 0;
                --degree[at(dead)];
                const int other = spot(at(end) ^ 1U);
                if (--degree[at(other)] == 1) waiting.push_back(other);
            }
        }
        return core;
    }

    // The direction in which a line leaves an end, seen from some way along it.
    [[nodiscard]] Vec2 direction(std::size_t end) const {
        const std::vector<Vec2>& points = lines_[end / 2].points;
        const bool back = end % 2 == 1;
        const Vec2 here = back ? points.back() : points.front();
        Vec2 there = here;
        for (std::size_t i = 1; i < points.size() && distance(here, there) <= kJoinMm; ++i) {
            there = back ? points[points.size() - 1 - i] : points[i];
        }
        return here == there ? Vec2{} : unit(there - here);
    }

    // Joins the ends that meet two and two, the straightest first.
    void pair_ends(const std::vector<char>& lines) {
        partner_.assign(spot_of_.size(), -1);
        std::vector<std::vector<int>> ends(spots_.size());
        for (std::size_t end = 0; end < spot_of_.size(); ++end) {
            if (lines[end / 2] != 0) ends[at(spot(end))].push_back(static_cast<int>(end));
        }
        for (const std::vector<int>& meeting : ends) pair_meeting(meeting);
    }

    void pair_meeting(const std::vector<int>& ends) {
        const auto join = [&](int a, int b) {
            partner_[at(a)] = b;
            partner_[at(b)] = a;
        };
        // A star of very many ends has no straightest pair worth looking for.
        constexpr std::size_t kMany = 16;
        if (ends.size() == 2 || ends.size() > kMany) {
            for (std::size_t i = 0; i + 1 < ends.size(); i += 2) join(ends[i], ends[i + 1]);
            return;
        }
        std::vector<std::tuple<double, int, int>> pairs;
        for (std::size_t i = 0; i < ends.size(); ++i) {
            for (std::size_t j = i + 1; j < ends.size(); ++j) {
                const double bend = dot(direction(at(ends[i])), direction(at(ends[j])));
                pairs.emplace_back(std::round(1e6 * bend), ends[i], ends[j]);
            }
        }
        std::sort(pairs.begin(), pairs.end());
        for (const auto& [bend, a, b] : pairs) {
            if (partner_[at(a)] < 0 && partner_[at(b)] < 0) join(a, b);
        }
    }

    // Walks along the lines named. With `loops_only`, what does not close is left for later.
    void follow(const std::vector<char>& lines, bool loops_only) {
        pair_ends(lines);
        std::vector<char> used(lines_.size(), 0);
        std::vector<int> place(spots_.size(), -1);
        const auto walk = [&](std::size_t end) {
            std::vector<Step> steps;
            std::vector<int> stops{spot(end)};  // of the path that is open now
            place[at(stops[0])] = 0;
            while (used[end / 2] == 0) {
                used[end / 2] = 1;
                steps.push_back({static_cast<int>(end / 2), end % 2 == 1});
                const int stop = spot(end ^ 1U);
                if (const int seen = place[at(stop)]; seen >= 0) {
                    const auto first = steps.begin() + seen;
                    emit({first, steps.end()}, true);
                    steps.erase(first, steps.end());
                    for (std::size_t i = at(seen) + 1; i < stops.size(); ++i) place[at(stops[i])] = -1;
                    stops.resize(at(seen) + 1);
                } else {
                    place[at(stop)] = static_cast<int>(stops.size());
                    stops.push_back(stop);
                }
                const int next = partner_[end ^ 1U];
                if (next < 0) break;
                end = at(next);
            }
            for (const int stop : stops) place[at(stop)] = -1;
            if (!steps.empty() && !loops_only) emit(steps, false);
        };
        const auto waiting = [&](std::size_t end) { return lines[end / 2] != 0 && used[end / 2] == 0; };
        for (std::size_t end = 0; end < spot_of_.size(); ++end) {
            if (waiting(end) && partner_[end] < 0) walk(end);
        }
        for (std::size_t end = 0; end < spot_of_.size(); ++end) {
            if (waiting(end)) walk(end);
        }
    }

    void emit(const std::vector<Step>& steps, bool closed) {
        JoinedLine made;
        made.closed = closed;
        const auto add = [&](Vec2 p) {
            if (made.points.empty() || made.points.back() != p) made.points.push_back(p);
        };
        for (const Step& step : steps) {
            free_[at(step.line)] = 0;
            const OpenLine& line = lines_[at(step.line)];
            made.elements.push_back(line.element);
            const std::size_t first_end = 2 * at(step.line) + (step.back ? 1U : 0U);
            const std::size_t count = line.points.size();
            for (std::size_t i = 0; i < count; ++i) {
                Vec2 p = line.points[step.back ? count - 1 - i : i];
                if (i == 0) p = spots_.middle(spot(first_end));
                if (i + 1 == count) p = spots_.middle(spot(first_end ^ 1U));
                add(p);
            }
        }
        if (closed && made.points.size() > 1 && made.points.front() == made.points.back()) {
            made.points.pop_back();
        }
        std::sort(made.elements.begin(), made.elements.end());
        made.elements.erase(std::unique(made.elements.begin(), made.elements.end()), made.elements.end());
        if (made.points.size() >= 2) out_.lines.push_back(std::move(made));
    }

    std::vector<OpenLine> lines_;
    Spots spots_;
    std::vector<int> spot_of_;  // of each end
    std::vector<int> partner_;  // the end a walk goes on with, or -1
    std::vector<char> free_;    // lines that nothing is made of yet
    Joined out_;
};

}  // namespace

Joined join_lines(std::vector<OpenLine> lines) { return Joiner(std::move(lines)).run(); }

double length_of(const std::vector<Vec2>& points) {
    double sum = 0.0;
    for (std::size_t i = 1; i < points.size(); ++i) sum += distance(points[i - 1], points[i]);
    return sum;
}

}  // namespace popup::drawing
