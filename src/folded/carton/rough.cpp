#include "folded/carton/rough.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <string_view>

#include "base/nth.h"
#include "folded/path.h"
#include "folded/refine.h"

namespace popup::folded {
namespace {

constexpr double kWholeWay = 0.998;   // as fold_sheet() has it
constexpr double kMovedShare = 1e-3;  // of the sheet: so far may corners be moved to close loops

}  // namespace

std::unique_ptr<const RoughShape> rough_shape(const CreasePattern& pattern, const FoldOptions& options,
                                              Diagnostics& diagnostics) {
    std::optional<Sheet> sheet = make_sheet(pattern, options, diagnostics);
    if (!sheet) return nullptr;
    const PathOptions path{options.closure_mm};
    Paths paths = find_paths(*sheet, path);
    if (paths.reached < kWholeWay) {
        if (refine(*sheet, paths, std::max(options.refine_mm, kMovedShare * sheet->size())).closes)
            paths = find_paths(*sheet, path);
    }
    if (paths.reached < kWholeWay) {
        diagnostics
            .error("not-refined", {}, "loops of this sheet do not close, so that its shape cannot be refined")
            .hint("popupc check says which loop stays open");
        return nullptr;
    }
    auto rough = std::make_unique<RoughShape>();
    rough->sheet = std::move(*sheet);
    rough->tree = make_tree(rough->sheet);
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

    bool add(const Join& join, PanelJoin& to) {
        const bool merges = join.kind == JoinKind::merge;
        const std::string_view kind = kJoinKindNames.at(static_cast<std::size_t>(join.kind));
        if (join.parts.size() < 2 || (!merges && join.parts.size() != 2)) {
            diagnostics_.error("no-such-panel", {},
                               fmt::format("a {} joins {}, and this one names {}", kind,
                                           merges ? "two corners or more" : "two panels", join.parts.size()));
            return false;
        }
        std::set<int> seen;
        std::vector<int> panels;
        for (const JoinPart& part : join.parts) {
            const auto found = numbers_.find(part.panel);
            if (found == numbers_.end()) {
                refuse(kind, part);
                return false;
            }
            if (!seen.insert(found->second).second) {
                diagnostics_.error(
                    "no-such-panel", {},
                    fmt::format("a {} names \"{}\" twice: what is joined is of different panels", kind,
                                part.panel));
                return false;
            }
            panels.push_back(found->second);
            if (!merges) continue;
            const std::vector<int>& outer = nth(rough_.sheet.panels, found->second).outer;
            const int corner = *std::min_element(outer.begin(), outer.end(), [&](int a, int b) {
                return distance(rough_.sheet.at(a), part.corner) < distance(rough_.sheet.at(b), part.corner);
            });
            if (const double off = distance(rough_.sheet.at(corner), part.corner); off > kCornerMm) {
                diagnostics_
                    .error("no-such-panel", {},
                           fmt::format("\"{}\" has no corner at {}; the nearest is at {}, {:.2f} mm away",
                                       part.panel, shown_point(pattern_.ruler, part.corner),
                                       shown_point(pattern_.ruler, rough_.sheet.at(corner)), off))
                    .hint("if the drawing has changed, popupc suggest finds its corners anew");
                return false;
            }
            to.merged.push_back({found->second, corner});
        }
        if (!merges) {
            to.a = panels[0];
            to.b = panels[1];
        }
        return true;
    }

 private:
    void refuse(std::string_view kind, const JoinPart& part) {
        std::string names;
        for (const std::string& name : rough_.names) names += (names.empty() ? "" : " ") + name;
        diagnostics_
            .error("no-such-panel", {},
                   fmt::format("a {} names \"{}\", and the sheet has no such panel", kind, part.panel))
            .hint("its panels: " + names);
    }

    static constexpr double kCornerMm = 0.1;
    const RoughShape& rough_;
    const CreasePattern& pattern_;
    Diagnostics& diagnostics_;
    std::map<std::string, int, std::less<>> numbers_;
};

}  // namespace

std::optional<std::vector<PanelJoin>> resolve(const RoughShape& rough, std::span<const Join> joins,
                                              const CreasePattern& pattern, Diagnostics& diagnostics) {
    Resolver resolver(rough, pattern, diagnostics);
    std::vector<PanelJoin> result;
    for (const Join& join : joins) {
        if (!resolver.add(join, result.emplace_back())) return std::nullopt;
    }
    return result;
}

}  // namespace popup::folded
