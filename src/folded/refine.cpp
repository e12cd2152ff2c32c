#include "folded/refine.h"

#include <fmt/format.h>

#include <Eigen/SparseCore>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/geometry/edge_index.h"
#include "base/nth.h"
#include "folded/closure.h"
#include "folded/least_step.h"
#include "folded/rigid.h"

namespace popup::folded {
namespace {

// Corners that move by no more are not told of.
constexpr double kToldMm = 1e-4;
// Shares at which all loops are closed; the second set is for sheets that fold only a part of the way.
constexpr std::array kShares{0.1, 0.25, 0.45, 0.7, 0.92, 1.0};
constexpr std::array kFirstShares{0.04, 0.1, 0.2};
// A corner that moves by this share of the sheet counts as much as an angle by a radian.
constexpr double kCornersPerRadian = 0.003;
constexpr std::size_t kMostConditions = 1000;
// Of sheets with more, so many shares are looked at before all are: at one or two closure costs little, but
// what does not close at all does not close at these, which take a quarter of the work.
constexpr std::size_t kLookedAtFirst = 3;
constexpr double kRegular = 1e-13;
constexpr int kMostSteps = 15;
constexpr int kMostIdle = 3;  // steps that do not halve what is open
constexpr double kClosed = 1e-13;
// Angles come as near to closure as this times their share before corners are moved. Sheets that are rigid
// but for corners would come nearer by not folding at all, others need it; so several are tried.
constexpr std::array kNear{0.0, 3e-6, 3e-4, 0.02};
// So far they go towards the final angles at a time.
constexpr double kWay = 0.05;
constexpr double kNearlyClosed = 2e-11;  // where steps do not help any more
constexpr double kBentMm = 1e-9;
// A second solution counts where its corners move by less than this share of the first's.
constexpr double kClearlyLess = 0.7;
constexpr double kMovedMm = 1e-6;
// Steps that move a corner by so many times what it may be moved by do not come back.
constexpr double kTooFar = 5.0;
// Folds that are left with less of their share were closed by not folding them.
constexpr double kStays = 0.05;

// A velocity of rigid bodies: turning about the origin, and the origin's own.
struct Twist {
    Vec3 turn, shift;
    friend Twist operator-(const Twist& a, const Twist& b) { return {a.turn - b.turn, a.shift - b.shift}; }
};

// The twist as a motion carries it.
Twist carried(const Rigid3& motion, const Twist& twist) {
    const Vec3 turn = motion.direction(twist.turn);
    return {turn, motion.direction(twist.shift) + cross(motion.shift, turn)};
}

// What does not depend on how near to closure the angles begin: equations of loops with corners as they are,
// and of steps, by how many shares they are of.
struct Equations {
    std::optional<Closure> closure;
    std::map<std::size_t, LeastStep> steps;
};

class Solver {
 public:
    // `equations` are those of this sheet, and outlive this object.
    Solver(const Sheet& sheet, const Paths& paths, std::span<const double> shares, double near,
           double most_mm, Equations& equations, Work& work)
        : sheet_(sheet),
          paths_(paths),
          shares_(shares),
          near_(near),
          most_mm_(most_mm),
          equations_(equations),
          work_(work) {
        size_ = sheet.size();
        std::vector<char> in_loop(sheet.folds.size(), 0);
        for (const Loop& loop : sheet.loops) {
            for (const Step& step : loop.steps) nth(in_loop, step.fold) = 1;
        }
        unknown_of_.assign(sheet.corners.size(), -1);
        fold_of_.assign(sheet.folds.size(), -1);
        for (std::size_t i = 0; i < sheet.folds.size(); ++i) {
            const Fold& fold = sheet.folds[i];
            if (in_loop[i] != 0) fold_of_[i] = folds_++;
            if (in_loop[i] == 0 && fold.stretches.size() < 2) continue;
            for (const Stretch one : fold.stretches) {
                for (const int end : {one.a, one.b}) {
                    if (nth(unknown_of_, end) < 0) nth(unknown_of_, end) = corners_++;
                }
            }
        }
        corner_of_.resize(static_cast<std::size_t>(corners_));
        for (std::size_t i = 0; i < unknown_of_.size(); ++i) {
            if (unknown_of_[i] >= 0) nth(corner_of_, unknown_of_[i]) = static_cast<int>(i);
        }
        unknowns_ = 2 * corners_ + folds_ * static_cast<int>(shares.size());
        x_ = Eigen::VectorXd::Zero(unknowns_);
        begins_ = begin();
    }

    bool run() {
        if (!begins_) return false;
        double here = evaluate();
        const double first = here;
        int idle = 0;
        for (int i = 0; i < kMostSteps && here > kClosed && idle < kMostIdle; ++i) {
            const double before = here;
            if (!step() || furthest() > kTooFar * most_mm_) return false;
            here = evaluate();
            // What is near comes nearer with each step; what is not, is not mended by a corner's rounding.
            if (!(here <= first)) return false;
            idle = here < 0.5 * before ? 0 : idle + 1;
        }
        return here <= kNearlyClosed && all_fold();
    }

    // False if a step moves a corner too far: what closes at more shares than these moves it further yet.
    bool may_close() {
        if (!begins_) return false;
        evaluate();
        return step() && furthest() <= kTooFar * most_mm_;
    }

    // How far a corner is moved at most, mm.
    [[nodiscard]] double furthest() const {
        double by = 0.0;
        for (const int corner : corner_of_) by = std::max(by, length(moved_by(corner)));
        return by;
    }

    [[nodiscard]] Vec2 moved_by(int corner) const {
        const int unknown = nth(unknown_of_, corner);
        return unknown < 0 ? Vec2{} : Vec2{size_ * x_[2 * unknown], size_ * x_[2 * unknown + 1]};
    }

 private:
    // Angles near to closure at all shares, with corners as they are: those of the paths as far as they lead,
    // and then from share to share straight towards the final angles.
    bool begin() {
        std::vector<int> folds;
        std::vector<int> loops(sheet_.loops.size());
        std::iota(loops.begin(), loops.end(), 0);
        for (std::size_t i = 0; i < sheet_.folds.size(); ++i) {
            if (fold_of_[i] >= 0) folds.push_back(static_cast<int>(i));
        }
        if (!equations_.closure) equations_.closure.emplace(sheet_, folds, loops, work_);
        Closure& closure = *equations_.closure;
        if (!closure.is_affordable()) return false;
        Eigen::VectorXd target(folds_);
        for (int i = 0; i < folds_; ++i) target[i] = nth(sheet_.folds, nth(folds, i)).target;
        std::vector<double> reached_of(sheet_.folds.size(), 0.0);
        for (const Cluster& cluster : paths_.clusters) {
            for (const int fold : cluster.folds)
                nth(reached_of, fold) = cluster.other_way ? 0.0 : cluster.reached;
        }
        Eigen::VectorXd here = Eigen::VectorXd::Zero(folds_);
        double share = 0.0;
        for (std::size_t k = 0; k < shares_.size(); ++k) {
            while (share < shares_[k]) {
                const double to = std::min(share + kWay, shares_[k]);
                here += ((to - share) / (1.0 - share)) * (target - here);
                share = to;
                for (int i = 0; i < folds_; ++i) {
                    const std::vector<SharePoint>& law = nth(paths_.laws, nth(folds, i));
                    const double reached = nth(reached_of, nth(folds, i));
                    if (share <= reached) here[i] = angle_at(law, share);
                }
                // Steps towards where nothing is folded are many, and what comes near to it stays there.
                const auto stays = [&](const Eigen::VectorXd& there, double) {
                    return there.lpNorm<Eigen::Infinity>() <
                           kStays * share * target.lpNorm<Eigen::Infinity>();
                };
                closure.approach(here, near_ * share, stays);
                if (work_.is_spent() || stays(here, 0.0)) return false;
            }
            x_.segment(angle(k, 0), folds_) = here;
        }
        return true;
    }

    [[nodiscard]] int angle(std::size_t share, int fold) const {
        return 2 * corners_ + static_cast<int>(share) * folds_ + fold;
    }
    [[nodiscard]] Vec2 at(int corner) const { return sheet_.at(corner) + moved_by(corner); }
    [[nodiscard]] Segment line_of(const Fold& fold) const {
        return {at(fold.stretches.front().a), at(fold.stretches.back().b)};
    }

    void enter(int row, int column, double value) {
        // Corners are scaled, so that they are dear.
        entries_.emplace_back(row, column, column < 2 * corners_ ? kCornersPerRadian * value : value);
    }
    void enter_corner(int row, int corner, Vec2 slope) {
        const int unknown = nth(unknown_of_, corner);
        enter(row, 2 * unknown, slope.x);
        enter(row, 2 * unknown + 1, slope.y);
    }

    // Residuals and slopes; the largest residual.
    double evaluate() {
        entries_.clear();
        residual_.clear();
        for (const Fold& fold : sheet_.folds) add_line(fold);
        for (std::size_t k = 0; k < shares_.size(); ++k) {
            for (const Loop& loop : sheet_.loops) add_loop(k, loop);
        }
        double largest = 0.0;
        for (const double r : residual_) largest = std::max(largest, std::abs(r));
        return largest;
    }

    // The corners between the first and the last one lie on the line of these.
    void add_line(const Fold& fold) {
        if (fold.stretches.size() < 2) return;
        const Segment line = line_of(fold);
        const double length = distance(line.a, line.b);
        const Vec2 dir = (1.0 / length) * (line.b - line.a);
        const Vec2 n = left_of(dir);
        const auto add = [&](int corner) {
            const int row = static_cast<int>(residual_.size());
            const double t = dot(dir, at(corner) - line.a) / length;
            residual_.push_back(dot(n, at(corner) - line.a) / size_);
            enter_corner(row, corner, n);
            enter_corner(row, fold.stretches.front().a, (t - 1.0) * n);
            enter_corner(row, fold.stretches.back().b, -t * n);
        };
        for (std::size_t i = 0; i + 1 < fold.stretches.size(); ++i) {
            add(fold.stretches[i].b);
            if (fold.stretches[i + 1].a != fold.stretches[i].b) add(fold.stretches[i + 1].a);
        }
    }

    void add_loop(std::size_t share, const Loop& loop) {
        const int row = static_cast<int>(residual_.size());
        const int rows = loop.corner ? 3 : 6;
        const Vec2 origin = loop.corner ? at(loop.corner_number) : loop.at;
        Rigid3 motion;
        for (const Step& one : loop.steps) {
            const Fold& fold = nth(sheet_.folds, one.fold);
            const Segment line = line_of(fold);
            const double length = distance(line.a, line.b);
            const Vec2 dir = (1.0 / length) * (line.b - line.a);
            const Vec2 from = (1.0 / loop.size) * (line.a - origin);
            const Vec3 axis{dir.x, dir.y, 0.0};
            const Vec3 point = loop.corner ? Vec3{} : Vec3{from.x, from.y, 0.0};
            const int column = angle(share, nth(fold_of_, one.fold));
            const Vec3 turned = one.sign * motion.direction(axis);
            const Rigid3 before = motion;
            motion = motion.after_turn(point, axis, one.sign * x_[column]);
            enter_twist(row, rows, column, {turned, cross(before.point(point), turned)}, 1.0);
            // The line follows its ends across: a turn in the sheet about one while the other moves.
            const Vec2 n = left_of(dir);
            const auto follow = [&](int corner, double turn, double across) {
                const Vec2 still = across * n - turn * left_of(from);  // of the origin
                Twist twist{{0.0, 0.0, turn}, {still.x, still.y, 0.0}};
                if (loop.corner) twist.shift = {};
                const Twist by = carried(before, twist) - carried(motion, twist);
                const int unknown = nth(unknown_of_, corner);
                // Unknowns are shares of the sheet, lengths of the loop shares of its size.
                enter_twist(row, rows, 2 * unknown, by, n.x * size_ / loop.size);
                enter_twist(row, rows, 2 * unknown + 1, by, n.y * size_ / loop.size);
            };
            const double own = length / loop.size;
            follow(fold.stretches.front().a, -1.0 / own, 1.0);
            follow(fold.stretches.back().b, 1.0 / own, 0.0);
        }
        const Vec3 turn = turn_of(motion);
        residual_.insert(residual_.end(), {turn.x, turn.y, turn.z});
        if (!loop.corner) residual_.insert(residual_.end(), {motion.shift.x, motion.shift.y, motion.shift.z});
    }

    void enter_twist(int row, int rows, int column, const Twist& twist, double by) {
        const std::array<double, 6> values{twist.turn.x,  twist.turn.y,  twist.turn.z,
                                           twist.shift.x, twist.shift.y, twist.shift.z};
        for (int i = 0; i < rows; ++i) enter(row + i, column, by * nth(values, i));
    }

    bool step() {
        const Eigen::Map<const Eigen::VectorXd> residual(residual_.data(),
                                                         static_cast<Eigen::Index>(residual_.size()));
        std::optional<Eigen::VectorXd> by =
            equations_.steps[shares_.size()].find(entries_, unknowns_, residual, kRegular, work_);
        if (!by) return false;
        by->head(2 * corners_) *= kCornersPerRadian;
        x_ += *by;
        return true;
    }

    [[nodiscard]] bool all_fold() const {
        for (std::size_t k = 0; k < shares_.size(); ++k) {
            double largest = 0.0;
            double wanted = 0.0;
            for (std::size_t i = 0; i < sheet_.folds.size(); ++i) {
                if (fold_of_[i] < 0) continue;
                largest = std::max(largest, std::abs(x_[angle(k, fold_of_[i])]));
                wanted = std::max(wanted, std::abs(shares_[k] * sheet_.folds[i].target));
            }
            if (largest < kStays * wanted) return false;
        }
        return true;
    }

    const Sheet& sheet_;
    const Paths& paths_;
    std::span<const double> shares_;
    double near_;
    double most_mm_;
    Equations& equations_;
    Work& work_;
    bool begins_ = false;  // there are angles to begin with
    double size_ = 1.0;
    std::vector<int> unknown_of_;  // by corner: its number among those that move; -1: it stays
    std::vector<int> corner_of_;
    std::vector<int> fold_of_;  // by fold: its number among those in loops
    int corners_ = 0, folds_ = 0, unknowns_ = 0;
    Eigen::VectorXd x_;  // moves of corners as shares of the sheet, then the angles at each share
    std::vector<Eigen::Triplet<double>> entries_;
    std::vector<double> residual_;
};

}  // namespace

Refined refine(Sheet& sheet, const Paths& paths, double most_mm, Work& work) {
    Refined best;
    Equations equations;
    std::vector<Vec2> corners;
    std::size_t conditions = 0;
    for (const Loop& loop : sheet.loops) conditions += loop.corner ? 3 : 6;
    for (const std::span<const double> shares :
         {std::span<const double>(kShares), std::span<const double>(kFirstShares)}) {
        for (const double near : kNear) {
            // Large sheets are tried with what helps most of them.
            if (conditions > kMostConditions &&
                (shares.size() != kShares.size() || (near != 0.0 && near != kNear.back())))
                continue;
            if (conditions > kMostConditions) {
                Solver first(sheet, paths, shares.first(kLookedAtFirst), near, most_mm, equations, work);
                if (!first.may_close()) continue;
            }
            Solver solver(sheet, paths, shares, near, most_mm, equations, work);
            if (!solver.run()) continue;
            Refined result;
            result.closes = true;
            for (std::size_t i = 0; i < sheet.corners.size(); ++i) {
                const double by = length(solver.moved_by(static_cast<int>(i)));
                if (by > kMovedMm) ++result.moved;
                if (by <= result.most_mm) continue;
                result.most_mm = by;
                result.corner = static_cast<int>(i);
            }
            if (result.most_mm > most_mm || (best.closes && result.most_mm >= kClearlyLess * best.most_mm))
                continue;
            std::vector<Vec2> moved = sheet.corners;
            for (std::size_t i = 0; i < moved.size(); ++i)
                moved[i] = moved[i] + solver.moved_by(static_cast<int>(i));
            if (!keeps_panels(sheet, moved)) continue;
            best = result;
            corners = std::move(moved);
        }
        if (best.closes) break;
    }
    if (!best.closes) return best;
    move_corners(sheet, std::move(corners));
    return best;
}

namespace {

// Whether edges of panels cross with corners in these places.
bool any_cross(const Sheet& sheet, const std::vector<Vec2>& corners) {
    std::vector<Stretch> edges;
    for (const Fold& fold : sheet.folds)
        edges.insert(edges.end(), fold.stretches.begin(), fold.stretches.end());
    for (const std::vector<Stretch>& cuts : sheet.cuts) edges.insert(edges.end(), cuts.begin(), cuts.end());
    std::vector<Segment> placed;
    placed.reserve(edges.size());
    for (const Stretch& one : edges) placed.push_back({nth(corners, one.a), nth(corners, one.b)});
    const EdgeIndex index({}, placed);
    std::vector<int> found;
    for (std::size_t i = 0; i < placed.size(); ++i) {
        const Segment& s = placed[i];
        Box box;
        box.extend(s.a);
        box.extend(s.b);
        index.query(box, found);
        for (const int number : found) {
            const Segment& t = nth(placed, number);
            const Vec2 along_s = s.b - s.a;
            const Vec2 along_t = t.b - t.a;
            if (cross(along_s, t.a - s.a) * cross(along_s, t.b - s.a) < 0.0 &&
                cross(along_t, s.a - t.a) * cross(along_t, s.b - t.a) < 0.0) {
                const Stretch& other = nth(edges, number);
                const Stretch& own = edges[i];
                if (own.a != other.a && own.a != other.b && own.b != other.a && own.b != other.b) return true;
            }
        }
    }
    return false;
}

}  // namespace

bool keeps_panels(const Sheet& sheet, const std::vector<Vec2>& corners) {
    constexpr double kLeastLeft = 1e-3;
    const bool have_areas = std::all_of(sheet.panels.begin(), sheet.panels.end(), [&](const Panel& panel) {
        Ring before;
        Ring after;
        for (const int corner : panel.outer) {
            before.push_back(sheet.at(corner));
            after.push_back(nth(corners, corner));
        }
        return signed_area(after) > kLeastLeft * signed_area(before);
    });
    const bool have_lengths = std::all_of(sheet.folds.begin(), sheet.folds.end(), [&](const Fold& fold) {
        return std::all_of(fold.stretches.begin(), fold.stretches.end(), [&](const Stretch& one) {
            return distance(nth(corners, one.a), nth(corners, one.b)) >
                   kLeastLeft * distance(sheet.at(one.a), sheet.at(one.b));
        });
    });
    return have_areas && have_lengths && !any_cross(sheet, corners);
}

void move_corners(Sheet& sheet, std::vector<Vec2> corners) {
    sheet.corners = std::move(corners);
    for (Loop& loop : sheet.loops) {
        if (loop.corner) loop.at = sheet.at(loop.corner_number);
    }
}

bool has_bent_folds(const Sheet& sheet) {
    for (const Fold& fold : sheet.folds) {
        const Segment line = sheet.line_of(fold);
        const Vec2 dir = unit(line.b - line.a);
        for (const Stretch one : fold.stretches) {
            for (const int end : {one.a, one.b}) {
                if (std::abs(cross(dir, sheet.at(end) - line.a)) > kBentMm) return true;
            }
        }
    }
    return false;
}

void tell(const Refined& refined, const CreasePattern& pattern, const Sheet& sheet,
          Diagnostics& diagnostics) {
    if (refined.most_mm <= kToldMm) return;
    diagnostics
        .remark(
            "corners-refined", {},
            fmt::format("{} corners were moved so that the folds close, by {:.2g} mm at most, at {}",
                        refined.moved, refined.most_mm, shown_point(pattern.ruler, sheet.at(refined.corner))))
        .hint("a drawing with more decimals needs none of it");
}

}  // namespace popup::folded
