#include "folded/carton/rough.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include "base/nth.h"
#include "base/text/shown.h"
#include "folded/asked.h"
#include "folded/path.h"
#include "folded/refine.h"
#include "folded/work.h"

namespace popup::folded {
namespace {

constexpr double kWholeWay = 0.998;   // as fold_sheet() has it
constexpr double kMovedShare = 1e-3;  // of the sheet: so far may corners be moved to close loops

// Of a fold of those that get the least far.
Place place_of_worst(const CreasePattern& pattern, const Sheet& sheet, const Paths& paths) {
    const auto worst =
        std::min_element(paths.clusters.begin(), paths.clusters.end(),
                         [](const Cluster& a, const Cluster& b) { return a.reached < b.reached; });
    if (worst == paths.clusters.end() || worst->folds.empty()) return {};
    return nth(pattern.lines, nth(sheet.folds, worst->folds.front()).line).place;
}

}  // namespace

std::unique_ptr<const RoughShape> rough_shape(const CreasePattern& pattern, const FoldOptions& options,
                                              Diagnostics& diagnostics) {
    std::optional<Sheet> sheet = make_sheet(pattern, options, diagnostics);
    if (!sheet) return nullptr;
    const PathOptions path{options.closure_mm};
    Work work;
    Paths paths = find_paths(*sheet, path, work);
    if (paths.reached < kWholeWay) {
        if (refine(*sheet, paths, std::max(options.refine_mm, kMovedShare * sheet->size()), work).closes)
            paths = find_paths(*sheet, path, work);
    }
    static_cast<void>(end_as_asked(pattern, options, *sheet, paths, work));
    if (paths.reached < kWholeWay) {
        diagnostics
            .error("not-refined", place_of_worst(pattern, *sheet, paths),
                   "loops of this sheet do not close, so that its shape cannot be refined")
            .hint("popupc check says which loop stays open");
        return nullptr;
    }
    auto rough = std::make_unique<RoughShape>();
    rough->sheet = std::move(*sheet);
    rough->tree = make_tree(pattern, rough->sheet);
    for (const std::vector<SharePoint>& law : paths.laws) rough->angles.push_back(angle_at(law, options.to));
    rough->names.resize(rough->sheet.panels.size());
    const Assembly named = assembly_of_panels(pattern, rough->sheet, rough->tree);
    for (std::size_t i = 0; i < named.plates.size(); ++i)
        nth(rough->names, rough->tree.order[i]) = named.plates[i].name;
    return rough;
}

namespace {

class Resolver {
 public:
    Resolver(const RoughShape& rough, const CreasePattern& pattern, Diagnostics& diagnostics)
        : rough_(rough), pattern_(pattern), diagnostics_(diagnostics) {
        for (std::size_t i = 0; i < rough.names.size(); ++i)
            numbers_.emplace(rough.names[i], static_cast<int>(i));
    }

    bool add(const Join& join, std::size_t number, PanelJoin& to) {
        join_ = &join;
        const bool merges = join.kind == JoinKind::merge;
        what_ = fmt::format("join {}: a {}", number, kJoinKindNames.at(static_cast<std::size_t>(join.kind)));
        if (join.parts.size() < 2 || (!merges && join.parts.size() != 2)) {
            refuse(fmt::format("{} joins {}, and this one names {}", what_,
                               merges ? "two corners or more" : "two panels", join.parts.size()));
            return false;
        }
        std::set<int> seen;
        std::vector<int> panels;
        for (const JoinPart& part : join.parts) {
            const auto found = numbers_.find(part.panel);
            if (found == numbers_.end()) {
                refuse(
                    fmt::format("{} names \"{}\", and the sheet has no such panel", what_, shown(part.panel)))
                    .hint(all_names());
                return false;
            }
            if (!seen.insert(found->second).second) {
                refuse(fmt::format("{} names \"{}\" twice: what is joined is of different panels", what_,
                                   shown(part.panel)));
                return false;
            }
            panels.push_back(found->second);
            if (!merges) continue;
            const std::vector<int>& outer = nth(rough_.sheet.panels, found->second).outer;
            const int corner = *std::min_element(outer.begin(), outer.end(), [&](int a, int b) {
                return distance(rough_.sheet.at(a), part.corner) < distance(rough_.sheet.at(b), part.corner);
            });
            if (const double off = distance(rough_.sheet.at(corner), part.corner); off > kCornerMm) {
                refuse(
                    fmt::format("join {}: \"{}\" has no corner at {}; the nearest is at {}, {:.2f} mm away",
                                number, shown(part.panel), shown_point(pattern_.ruler, part.corner),
                                shown_point(pattern_.ruler, rough_.sheet.at(corner)), off))
                    .hint("if the drawing has changed, popupc suggest finds its corners anew");
                return false;
            }
            to.merged.push_back({found->second, corner});
        }
        if (!merges) {
            to.stays = join.kind == JoinKind::glue;
            to.a = panels[0];
            to.b = panels[1];
        }
        return true;
    }

 private:
    Diagnostic& refuse(std::string why) {
        return diagnostics_.error("no-such-panel", join_->place, std::move(why));
    }
    // The first ones, of sheets that have thousands.
    [[nodiscard]] std::string all_names() const {
        static constexpr std::size_t kMostNames = 40;
        std::string names = "its panels:";
        for (std::size_t i = 0; i < rough_.names.size() && i < kMostNames; ++i)
            names += " " + shown(rough_.names[i]);
        if (rough_.names.size() > kMostNames)
            names += fmt::format(" and {} more", rough_.names.size() - kMostNames);
        return names;
    }

    static constexpr double kCornerMm = 0.1;
    const RoughShape& rough_;
    const CreasePattern& pattern_;
    Diagnostics& diagnostics_;
    std::map<std::string, int, std::less<>> numbers_;
    const Join* join_ = nullptr;
    std::string what_;  // "join 3: a merge"
};

}  // namespace

std::optional<std::vector<PanelJoin>> resolve(const RoughShape& rough, std::span<const Join> joins,
                                              const CreasePattern& pattern, Diagnostics& diagnostics) {
    Resolver resolver(rough, pattern, diagnostics);
    std::vector<PanelJoin> result;
    for (const Join& join : joins) {
        const std::size_t number = result.size() + 1;
        if (!resolver.add(join, number, result.emplace_back())) return std::nullopt;
    }
    return result;
}

}  // namespace popup::folded
