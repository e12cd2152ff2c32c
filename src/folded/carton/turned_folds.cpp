#include "folded/carton/turned_folds.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>

#include "base/nth.h"

namespace popup::folded {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kToldDeg = 0.01;
constexpr double kSameDeg = 1e-6;     // as drawings write angles
constexpr double kLeftOverMm = 0.05;  // of a line beside its folds

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
        bool unparted = false;   // a line is more than its folds, and they differ
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
                "a line that is more than its folds cannot have the angles of each: draw folds and cuts as "
                "lines of their own");
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

    bool give(const CreaseLine& line, const std::vector<std::size_t>& folds, EditedSheet::Line& made) const {
        const double first = degrees_of(line, folds.front());
        const bool alike = std::all_of(folds.begin(), folds.end(), [&](std::size_t fold) {
            return std::abs(degrees_of(line, fold) - first) <= kSameDeg;
        });
        if (alike) {
            made.fold_deg = {first};
            return true;
        }
        double left = 0.0;
        for (std::size_t i = 0; i + (line.closed ? 0 : 1) < line.points.size(); ++i)
            left += distance(line.points[i], line.points[(i + 1) % line.points.size()]);
        std::vector<Segment> parts;
        std::vector<double> degrees;
        for (const std::size_t fold : folds) {
            for (const Segment& one : shape_.sheet().stretches_of(shape_.sheet().folds[fold]))
                left -= distance(one.a, one.b);
            for (const Segment& one : examined_.sheet.stretches_of(examined_.sheet.folds[fold])) {
                parts.push_back(one);
                degrees.push_back(degrees_of(line, fold));
            }
        }
        if (std::abs(left) > kLeftOverMm * static_cast<double>(parts.size())) return false;
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
