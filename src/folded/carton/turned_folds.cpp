#include "folded/carton/turned_folds.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/nth.h"

namespace popup::folded {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kToldDeg = 0.01;
constexpr double kSameDeg = 1e-6;     // as drawings write angles
constexpr double kLeftOverMm = 0.05;  // of a line beside its folds, and of these beside it

class TurnedFolds {
 public:
    TurnedFolds(const CreasePattern& pattern, const FoldOptions& options, const Vertices& shape,
                const ExaminedEdit& examined)
        : pattern_(pattern),
          options_(options),
          shape_(shape),
          examined_(examined),
          before_(shape.state().angles()) {}

    // What keeps lines from having their angles, or the angles from counting.
    struct Lacks {
        bool unparted = false;   // folds of a line differ, and it goes apart or is elsewhere
        bool overruled = false;  // the options say other angles
    };
    Lacks give(EditedSheet& made) const {
        std::vector<std::vector<std::size_t>> folds_of(pattern_.lines.size());
        for (std::size_t i = 0; i < before_.size(); ++i)
            nth(folds_of, shape_.sheet().folds[i].line).push_back(i);
        Lacks lacks;
        for (std::size_t i = 0; i < folds_of.size(); ++i) {
            const bool turned = std::any_of(folds_of[i].begin(), folds_of[i].end(), [&](std::size_t fold) {
                return std::abs(examined_.angles[fold] - before_[fold]) > kSameDeg * kDegree;
            });
            if (!turned) continue;
            if (options_.to < 1.0) continue;
            lacks.unparted |= !give(pattern_.lines[i], folds_of[i], made.lines[i]);
            lacks.overruled |= is_overruled(pattern_.lines[i]);
        }
        return lacks;
    }

    void tell(const Lacks& lacks, Diagnostics& diagnostics) const {
        if (examined_.turn_deg <= kToldDeg) return;
        std::size_t most = 0;
        for (std::size_t i = 0; i < before_.size(); ++i) {
            if (turn(i) > turn(most)) most = i;
        }
        const Fold& fold = shape_.sheet().folds[most];
        Diagnostic& told = diagnostics.remark(
            "folds-turn", nth(pattern_.lines, fold.line).place,
            fmt::format("for the shape to close, folds go by other angles than the drawing said: that "
                        "between {} and {} by {:.2f}°, and not by {:.2f}°",
                        shape_.name_of(fold.left), shape_.name_of(fold.right),
                        std::abs(examined_.angles[most]) / kDegree, std::abs(before_[most]) / kDegree));
        if (options_.to < 1.0) {
            told.hint(
                "with --fold-to it is not known how far they go in the end; edit the whole shape, without "
                "--fold-to");
        }
        if (lacks.overruled)
            told.hint("leave --fold-angle out next time: it counts before what drawings say");
        if (lacks.unparted)
            told.hint(
                "a line that is cut, too, and goes apart there cannot have the angles of each of its folds: "
                "draw folds and cuts as lines of their own");
    }

 private:
    [[nodiscard]] double turn(std::size_t fold) const {
        return std::abs(examined_.angles[fold] - before_[fold]);
    }
    [[nodiscard]] bool is_overruled(const CreaseLine& line) const {
        return std::any_of(options_.fold_angles.begin(), options_.fold_angles.end(), [&](const auto& one) {
            return one.name.empty() || one.name == line.name ||
                   one.name == kCreaseUseNames.at(static_cast<std::size_t>(line.use));
        });
    }

    // By the way that the line is drawn, or that the fold went.
    [[nodiscard]] double degrees_of(const CreaseLine& line, std::size_t fold) const {
        const double deg = std::abs(examined_.angles[fold]) / kDegree;
        if (deg <= kSameDeg) return 0.0;
        // What is drawn as a fold that goes as the others let it stays so, unless it becomes a mountain.
        const bool was_mountain =
            line.use == CreaseUse::mountain ||
            (line.use == CreaseUse::fold && before_[fold] < 0.0 && examined_.angles[fold] < 0.0);
        return was_mountain == (examined_.angles[fold] < 0.0) ? deg : -deg;
    }

    // What of a line, where it goes, is none of these parts of it; nullopt: they are not on it.
    static std::optional<std::vector<Segment>> rest_of(const CreaseLine& line, const EditedSheet::Line& made,
                                                       const std::vector<Segment>& parts) {
        std::vector<Segment> rest;
        std::size_t placed = 0;
        auto next = made.through.begin();
        for (std::size_t i = 0; i + (line.closed ? 0 : 1) < made.points.size(); ++i) {
            Vec2 from = made.points[i];
            for (; next != made.through.end() && next->first == static_cast<int>(i); ++next)
                placed += add_rest({std::exchange(from, next->second), next->second}, parts, rest);
            placed += add_rest({from, made.points[(i + 1) % made.points.size()]}, parts, rest);
        }
        return placed == parts.size() ? std::optional(rest) : std::nullopt;
    }

    // Adds what is left of one side of a line. Returns how many parts lie on it.
    static std::size_t add_rest(Segment side, const std::vector<Segment>& parts, std::vector<Segment>& rest) {
        const double size = distance(side.a, side.b);
        if (size <= 0.0) return 0;
        const Vec2 way = unit(side.b - side.a);
        std::vector<std::pair<double, double>> taken;  // mm along it
        for (const Segment& one : parts) {
            const auto along = [&](Vec2 p) { return dot(way, p - side.a); };
            const auto is_on = [&](Vec2 p) {
                return std::abs(cross(way, p - side.a)) <= kLeftOverMm && along(p) >= -kLeftOverMm &&
                       along(p) <= size + kLeftOverMm;
            };
            if (is_on(one.a) && is_on(one.b)) taken.push_back(std::minmax(along(one.a), along(one.b)));
        }
        std::sort(taken.begin(), taken.end());
        double done = 0.0;
        const auto leave = [&](double up_to) {
            if (up_to - done > kLeftOverMm) rest.push_back({side.a + done * way, side.a + up_to * way});
        };
        for (const auto& [begin, end] : taken) {
            leave(begin);
            done = std::max(done, end);
        }
        leave(size);
        return taken.size();
    }

    bool give(const CreaseLine& line, const std::vector<std::size_t>& folds, EditedSheet::Line& made) const {
        if (!made.parted.empty()) return false;  // what is cut by it goes apart
        const double first = degrees_of(line, folds.front());
        const bool alike = std::all_of(folds.begin(), folds.end(), [&](std::size_t fold) {
            return std::abs(degrees_of(line, fold) - first) <= kSameDeg;
        });
        if (alike) {
            made.fold_deg = {first};
            return true;
        }
        std::vector<Segment> parts;
        std::vector<double> degrees;
        for (const std::size_t fold : folds) {
            for (const Segment& one : examined_.sheet.stretches_of(examined_.sheet.folds[fold])) {
                parts.push_back(one);
                degrees.push_back(degrees_of(line, fold));
            }
        }
        const auto rest = rest_of(line, made, parts);
        if (!rest) return false;
        parts.insert(parts.end(), rest->begin(), rest->end());
        made.parted = std::move(parts);
        made.fold_deg = std::move(degrees);
        return true;
    }

    const CreasePattern& pattern_;
    const FoldOptions& options_;
    const Vertices& shape_;
    const ExaminedEdit& examined_;
    const std::vector<double>& before_;  // by fold, radians
};

}  // namespace

void turn_folds(const CreasePattern& pattern, const FoldOptions& options, const Vertices& shape,
                const ExaminedEdit& examined, EditedSheet& made, Diagnostics& diagnostics) {
    const TurnedFolds turned(pattern, options, shape, examined);
    turned.tell(turned.give(made), diagnostics);
}

}  // namespace popup::folded
