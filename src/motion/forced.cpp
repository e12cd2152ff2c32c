#include "motion/forced.h"

#include <algorithm>
#include <array>

#include "base/sets.h"
#include "motion/bodies.h"
#include "motion/joints/joint.h"
#include "motion/rates.h"
#include "motion/sweep.h"

namespace popup {
namespace {

constexpr double kShortMm = 1e-9;  // a line below has no direction

std::size_t at(int index) { return static_cast<std::size_t>(index); }

// A line that two nodes turn about. Nodes are bodies, that is plates that are glued flat on one another, and
// the ground.
struct Line {
    Vec3 at, along;
    double size = 0.0;
    int from = -1, to = -1;  // nodes; equal: it decides nothing
    bool in_tree = false;
};

struct Velocity {
    Vec3 turning, moving;  // of the body's point `at`
    Vec3 at;
    // The largest that was added up, so that what rounding leaves of it is known.
    double most_turning = 0.0, most_moving = 0.0;
    [[nodiscard]] bool is_nought() const {
        return length(turning) <= kHolds * most_turning && length(moving) <= kHolds * most_moving;
    }
};

// A body that hangs on nothing may move anyhow.
constexpr int kLooseWays = 6;
constexpr Velocity kLoose{{0.7, -1.1, 0.9}, {1.3, 0.6, -0.8}, {}, 1.0, 1.0};

// What the assembly says of bodies, whatever the pose.
struct Bodies {
    std::vector<int> of;       // by plate: the body, known by its first plate
    std::vector<char> forced;  // by body
    std::size_t open = 0;      // bodies that are not known to be forced

    explicit Bodies(const Assembly& assembly) : of(bodies_of(assembly)), forced(assembly.plates.size()) {
        for (const Joint& joint : assembly.joints) {
            for (const PlacedPlate& one : plates_of(joint).places) {
                if (one.parent < 0) forced[at(of[at(one.plate)])] = 1;
            }
        }
        for (std::size_t i = 0; i < of.size(); ++i) open += is_open(static_cast<int>(i)) ? 1U : 0U;
    }
    // Of a body or anything else: whether it is a body, and not known to be forced.
    [[nodiscard]] bool is_open(int body) const { return of[at(body)] == body && forced[at(body)] == 0; }
};

// The linkage at one pose: a tree of lines that all bodies hang on, and of each further line the loop that it
// closes.
class Look {
 public:
    Look(const Assembly& assembly, const Bodies& bodies, std::span<const Frame> frames)
        : assembly_(assembly), bodies_(bodies), ground_(static_cast<int>(assembly.plates.size())) {
        set_lines(frames);
        hang();
        Rates rates(lines_.size());
        for (std::size_t i = 0; i < lines_.size(); ++i) {
            if (lines_[i].from != lines_[i].to && !lines_[i].in_tree) close(static_cast<int>(i), rates);
        }
        find_moving(rates);
        find_groups(rates);
    }

    // By body: it moves in some of the ways that are open.
    [[nodiscard]] const std::vector<char>& moving() const { return moving_; }
    [[nodiscard]] std::vector<FreePlates> take_groups() { return std::move(groups_); }

 private:
    void set_lines(std::span<const Frame> frames) {
        const auto node = [this](int plate) {
            const int body = bodies_.of[at(plate)];
            return bodies_.forced[at(body)] != 0 ? ground_ : body;
        };
        Sets hanging(at(ground_) + 1);
        const auto set = [&](Line& line, int a, int b, Vec3 from, Vec3 to) {
            const double size = distance(from, to);
            if (node(a) == node(b) || !(size > kShortMm)) return;
            line.at = from;
            line.size = size;
            line.along = (1.0 / size) * (to - from);
            line.from = node(a);
            line.to = node(b);
            line.in_tree = hanging.unite(line.from, line.to);
        };
        lines_.resize(assembly_.hinges.size());
        for (std::size_t i = 0; i < lines_.size(); ++i) {
            const Hinge& hinge = assembly_.hinges[i];
            const Frame& frame = frames[at(hinge.a)];
            set(lines_[i], hinge.a, hinge.b, frame.point(hinge.a_line.a), frame.point(hinge.a_line.b));
        }
        // A rivet is a hinge across its plate.
        for (std::size_t i = 0; i < assembly_.plates.size(); ++i) {
            const Plate& plate = assembly_.plates[i];
            if (!plate.rivet || plate.parent < 0) continue;
            const Vec3 from = frames[i].point(*plate.rivet);
            set(lines_.emplace_back(), static_cast<int>(i), plate.parent, from, from + frames[i].normal());
        }
    }

    // Every body gets the one that it hangs on, along the lines of the tree.
    void hang() {
        const std::size_t nodes = at(ground_) + 1;
        std::vector<int> begin(nodes + 1);
        for (const Line& line : lines_) {
            if (!line.in_tree) continue;
            ++begin[at(line.from) + 1];
            ++begin[at(line.to) + 1];
        }
        std::partial_sum(begin.begin(), begin.end(), begin.begin());
        std::vector<int> touching(at(begin.back()));
        std::vector<int> next(begin.begin(), begin.end() - 1);
        for (std::size_t i = 0; i < lines_.size(); ++i) {
            if (!lines_[i].in_tree) continue;
            touching[at(next[at(lines_[i].from)]++)] = static_cast<int>(i);
            touching[at(next[at(lines_[i].to)]++)] = static_cast<int>(i);
        }
        up_.assign(nodes, -1);
        up_line_.assign(nodes, -1);
        depth_.assign(nodes, -1);
        top_.resize(nodes);
        std::iota(top_.begin(), top_.end(), 0);
        const auto grow = [&](int root) {
            depth_[at(root)] = 0;
            order_.push_back(root);
            for (std::size_t done = order_.size() - 1; done < order_.size(); ++done) {
                const int node = order_[done];
                for (int i = begin[at(node)]; i < begin[at(node) + 1]; ++i) {
                    const int line = touching[at(i)];
                    const int other = other_end(line, node);
                    if (depth_[at(other)] >= 0) continue;
                    depth_[at(other)] = depth_[at(node)] + 1;
                    up_[at(other)] = node;
                    up_line_[at(other)] = line;
                    order_.push_back(other);
                }
            }
        };
        grow(ground_);
        for (int body = 0; body < ground_; ++body) {
            if (bodies_.is_open(body) && depth_[at(body)] < 0) grow(body);
        }
    }

    [[nodiscard]] int other_end(int line, int node) const {
        return lines_[at(line)].from == node ? lines_[at(line)].to : lines_[at(line)].from;
    }

    // The highest of the nodes that are known to move as one with it, of those that it hangs on.
    int top(int node) {
        while (top_[at(node)] != node) node = top_[at(node)] = top_[at(top_[at(node)])];
        return node;
    }

    // The loop goes along the line, and back by what both its ends hang on.
    void close(int chord, Rates& rates) {
        way_.clear();
        way_.push_back({chord, 1.0});
        int there = top(lines_[at(chord)].to);
        int here = top(lines_[at(chord)].from);
        while (there != here) {
            const bool from_there = depth_[at(there)] >= depth_[at(here)];
            int& node = from_there ? there : here;
            const int line = up_line_[at(node)];
            // Twists of the ends add up on the way up from `there` and, seen backwards, down to `here`.
            const double up = lines_[at(line)].from == node ? 1.0 : -1.0;
            way_.push_back({line, from_there ? up : -up});
            node = top(up_[at(node)]);
        }
        const Vec3 middle = lines_[at(chord)].at;
        double size = 0.0;
        for (const auto& [line, sign] : way_)
            size = std::max(size, distance(middle, lines_[at(line)].at) + lines_[at(line)].size);
        loop_.clear();
        for (const auto& [line, sign] : way_) {
            const Line& l = lines_[at(line)];
            const Vec3 turn = sign * l.along;
            const Vec3 moment = (1.0 / size) * cross(turn, middle - l.at);
            loop_.push_back({line, {turn.x, turn.y, turn.z, moment.x, moment.y, moment.z}});
        }
        rates.close(loop_);
        for (const auto& [line, sign] : way_) {
            if (!lines_[at(line)].in_tree || !rates.is_nought(line)) continue;
            const Line& l = lines_[at(line)];
            const int lower = up_line_[at(l.from)] == line ? l.from : l.to;
            top_[at(lower)] = up_[at(lower)];
        }
    }

    void find_moving(Rates& rates) {
        rate_ = rates.example();
        moving_.assign(at(ground_) + 1, 0);
        std::vector<Velocity> velocity(moving_.size());
        for (const int node : order_) {
            if (up_[at(node)] < 0) {
                if (node != ground_) velocity[at(node)] = kLoose;
            } else {
                velocity[at(node)] = hung(node, velocity[at(up_[at(node)])]);
            }
            moving_[at(node)] = velocity[at(node)].is_nought() ? 0 : 1;
        }
    }

    [[nodiscard]] Velocity hung(int node, const Velocity& up) const {
        const int number = up_line_[at(node)];
        const Line& line = lines_[at(number)];
        const double rate = line.to == node ? rate_[at(number)] : -rate_[at(number)];
        const bool at_ground = up_[at(node)] == ground_;
        const Vec3 way = at_ground ? Vec3{} : line.at - up.at;
        Velocity own;
        own.at = line.at;
        own.turning = up.turning + rate * line.along;
        own.moving = up.moving + cross(up.turning, way);
        own.most_turning = std::max(up.most_turning, std::abs(rate));
        own.most_moving = std::max(up.most_moving, up.most_turning * length(way));
        return own;
    }

    void find_groups(const Rates& rates) {
        Sets together(moving_.size());
        const auto moves = [this](int node) { return node >= 0 && moving_[at(node)] != 0; };
        for (const Line& line : lines_) {
            if (moves(line.from) && moves(line.to)) together.unite(line.from, line.to);
        }
        std::vector<int> group(moving_.size(), -1);
        const auto group_of = [&](int node) -> FreePlates& {
            int& number = group[at(together.find(node))];
            if (number < 0) {
                number = static_cast<int>(groups_.size());
                groups_.emplace_back().ways = 0;
            }
            return groups_[at(number)];
        };
        for (int plate = 0; plate < ground_; ++plate) {
            const int body = bodies_.of[at(plate)];
            if (moves(body)) group_of(body).plates.push_back(plate);
        }
        for (const int node : order_) {
            if (up_[at(node)] < 0 && node != ground_) group_of(node).ways += kLooseWays;
        }
        std::vector<Vec3> along(groups_.size());
        for (std::size_t i = 0; i < lines_.size(); ++i) {
            const Line& line = lines_[i];
            if (!moves(line.from) && !moves(line.to)) continue;
            FreePlates& one = group_of(moves(line.from) ? line.from : line.to);
            Vec3& first = along[at(static_cast<int>(&one - groups_.data()))];
            if (one.lines++ == 0) {
                first = line.along;
                one.parallel = true;
            }
            if (length(cross(first, line.along)) > kHolds) one.parallel = false;
            if (rates.is_open(static_cast<int>(i))) ++one.ways;
        }
    }

    struct Step {
        int line;
        double sign;
    };

    const Assembly& assembly_;
    const Bodies& bodies_;
    int ground_;
    std::vector<Line> lines_;        // by hinge, then those of rivets
    std::vector<int> order_;         // nodes, each after the one that it hangs on
    std::vector<int> up_, up_line_;  // by node; -1: a root
    std::vector<int> depth_;         // by node
    std::vector<int> top_;           // by node: towards top()
    std::vector<Step> way_;          // of a loop
    std::vector<LoopStep> loop_;
    std::vector<double> rate_;  // by line: an example of how they may turn
    std::vector<char> moving_;  // by node
    std::vector<FreePlates> groups_;
};

}  // namespace

std::vector<FreePlates> free_plates(const Assembly& assembly, std::size_t poses, const PoseAt& pose_at) {
    Bodies bodies(assembly);
    std::vector<std::vector<Frame>> known(poses);  // empty: not asked for, or not reached
    std::vector<char> asked(poses);
    std::vector<FreePlates> found;
    // Until all poses have been looked at with the same plates as ground.
    std::size_t alike = 0;
    for (std::size_t pose = 0; alike < poses && bodies.open > 0; pose = (pose + 1) % poses) {
        ++alike;
        if (asked[pose] == 0) {
            asked[pose] = 1;
            known[pose].resize(assembly.plates.size());
            if (!pose_at(pose, known[pose])) known[pose].clear();
        }
        if (known[pose].empty()) continue;
        Look look(assembly, bodies, known[pose]);
        bool forces = false;
        for (std::size_t body = 0; body < bodies.of.size(); ++body) {
            if (!bodies.is_open(static_cast<int>(body)) || look.moving()[body] != 0) continue;
            bodies.forced[body] = 1;
            --bodies.open;
            forces = true;
        }
        std::vector<FreePlates> here = look.take_groups();
        if (forces) {
            alike = 1;
        } else {
            for (std::size_t i = 0; i < found.size(); ++i)
                here[i].ways = std::min(here[i].ways, found[i].ways);
        }
        found = std::move(here);
    }
    return found;
}

std::vector<FreePlates> free_plates(const Assembly& assembly) {
    return free_plates(assembly, kTellingDegs.size(), [&](std::size_t pose, std::span<Frame> frames) {
        return place(assembly, Angle::degrees(opening_at(assembly.sweep, kTellingDegs.at(pose))), frames);
    });
}

}  // namespace popup
