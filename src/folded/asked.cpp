#include "folded/asked.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "base/nth.h"
#include "base/text/numbers.h"
#include "folded/closure.h"
#include "popup/joints.h"

namespace popup::folded {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr std::size_t kSteps = Folded::kLawSteps;
constexpr double kRoundedRad = 2e-4;  // asked angles are rounded by less
constexpr double kClosed = 1e-9;      // radians, or shares of a loop's size
constexpr int kLooks = 256;           // so often it is looked whether a fold is beyond its angle
constexpr double kHardly = 0.02;      // of the way: not worth to be shown

// The angles that are asked for, brought to closure as far as they are rounded; nullopt: they do not close.
std::optional<Eigen::VectorXd> closed_as_asked(const Sheet& sheet, const Cluster& cluster, Work& work) {
    Closure closure(sheet, cluster.folds, cluster.loops, work);
    if (!closure.is_affordable()) return std::nullopt;
    Eigen::VectorXd asked(static_cast<Eigen::Index>(cluster.folds.size()));
    for (std::size_t i = 0; i < cluster.folds.size(); ++i)
        asked[static_cast<Eigen::Index>(i)] = nth(sheet.folds, cluster.folds[i]).target;
    Eigen::VectorXd closed = asked;
    if (closure.residual(closed) > kRoundedRad) return std::nullopt;
    if (closure.approach(closed) > kClosed) return std::nullopt;
    if ((closed - asked).lpNorm<Eigen::Infinity>() > kRoundedRad) return std::nullopt;
    return closed.cwiseMax(-std::numbers::pi).cwiseMin(std::numbers::pi);
}

// The share up to which no fold of a cluster is beyond its angle, or goes the other way.
double kept_share(const Sheet& sheet, const Cluster& cluster, const Paths& paths) {
    for (int look = 1; look <= kLooks; ++look) {
        const double share = cluster.reached * look / kLooks;
        for (const int number : cluster.folds) {
            const double target = nth(sheet.folds, number).target;
            const double low = std::min(0.0, target) - kOtherAngleDeg * kDegree;
            const double high = std::max(0.0, target) + kOtherAngleDeg * kDegree;
            const double here = angle_at(nth(paths.laws, number), share);
            if (here < low || here > high) return cluster.reached * (look - 1) / kLooks;
        }
    }
    return cluster.reached;
}

// The law up to a share, in all of the motion but the jump, and the jump.
std::vector<SharePoint> jumping(const std::vector<SharePoint>& law, double kept, double to) {
    const double before = 1.0 - kJump;
    std::vector<SharePoint> made{{0.0, 0.0}};
    const auto add = [&](double from, double end, const auto& angle) {
        for (std::size_t k = 1; k <= kSteps; ++k) {
            const double part = k == kSteps ? 1.0 : chebyshev_share(k);
            made.push_back({from + part * (end - from), angle(part)});
        }
    };
    double last = 0.0;
    if (kept < kHardly) {
        add(0.0, before, [](double) { return 0.0; });
    } else {
        double from = 0.0;
        for (std::size_t i = kSteps; i < law.size() && from < kept; i += kSteps) {
            const double end = std::min(kept, law[i].share);
            add(from * before / kept, end == kept ? before : end * before / kept,
                [&](double part) { return angle_at(law, from + part * (end - from)); });
            from = end;
        }
        last = made.back().angle;
    }
    add(before, 1.0, [&](double part) { return last + part * (to - last); });
    return made;
}

bool is_for(const FoldOptions::NamedAngle& angle, const CreaseLine& line) {
    return angle.name == line.name || angle.name == kCreaseUseNames.at(static_cast<std::size_t>(line.use));
}

}  // namespace

bool is_asked(const CreasePattern& pattern, const FoldOptions& options, const Fold& fold) {
    const CreaseLine& line = nth(pattern.lines, fold.line);
    return line.fold_deg || std::any_of(options.fold_angles.begin(), options.fold_angles.end(),
                                        [&](const FoldOptions::NamedAngle& one) {
                                            return !one.name.empty() && is_for(one, line);
                                        });
}

void tell_unused_angles(const CreasePattern& pattern, const FoldOptions& options, Diagnostics& diagnostics) {
    for (const FoldOptions::NamedAngle& one : options.fold_angles) {
        if (one.name.empty() || one.name == kCreaseUseNames[1] || one.name == kCreaseUseNames[2]) continue;
        const bool used =
            std::any_of(pattern.lines.begin(), pattern.lines.end(), [&one](const CreaseLine& line) {
                return line.use != CreaseUse::cut && line.use != CreaseUse::flat && is_for(one, line);
            });
        if (used) continue;
        diagnostics
            .remark("angle-not-found", {},
                    fmt::format("--fold-angle {}={}: no fold of this sheet is called so", one.name,
                                number_text(one.angle.deg, 6)))
            .hint(
                "folds are called by their colour, such as #ff0000, or by the number of their edge in a FOLD "
                "file");
    }
}

bool end_as_asked(const CreasePattern& pattern, const FoldOptions& options, const Sheet& sheet, Paths& paths,
                  Work& work) {
    bool any = false;
    for (Cluster& cluster : paths.clusters) {
        if (cluster.reached == 0.0 || cluster.given_up) continue;
        const bool all_asked = std::all_of(cluster.folds.begin(), cluster.folds.end(), [&](int number) {
            return is_asked(pattern, options, nth(sheet.folds, number));
        });
        const bool elsewhere = std::any_of(cluster.folds.begin(), cluster.folds.end(), [&](int number) {
            return std::abs(nth(paths.laws, number).back().angle - nth(sheet.folds, number).target) >
                   kOtherAngleDeg * kDegree;
        });
        if (!all_asked || !elsewhere) continue;
        const std::optional<Eigen::VectorXd> closed = closed_as_asked(sheet, cluster, work);
        if (!closed) continue;
        const double kept = kept_share(sheet, cluster, paths);
        for (std::size_t i = 0; i < cluster.folds.size(); ++i) {
            std::vector<SharePoint>& law = nth(paths.laws, cluster.folds[i]);
            law = jumping(law, kept, (*closed)[static_cast<Eigen::Index>(i)]);
        }
        cluster.reached = 1.0;
        cluster.all_fold = true;
        cluster.other_way = false;
        cluster.jumps_from = kept < kHardly ? 0.0 : kept;
        any = true;
    }
    paths.reached = 1.0;
    for (const Cluster& cluster : paths.clusters) paths.reached = std::min(paths.reached, cluster.reached);
    return any;
}

}  // namespace popup::folded
