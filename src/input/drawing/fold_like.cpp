#include "input/drawing/fold_like.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "base/nth.h"
#include "input/drawing/notation.h"
#include "parts/joining.h"

namespace popup::drawing {
namespace {

// How a line was drawn, for counts.
using StrokeKey = std::tuple<Dash, std::uint8_t, std::uint8_t, std::uint8_t>;
StrokeKey key_of(const TracedLine& line) { return {line.dash, line.color.r, line.color.g, line.color.b}; }

bool is_fold(Named named) {
    return named == Named::fold || named == Named::mountain || named == Named::valley;
}

bool is_fold_hue(Hue hue) { return hue == Hue::red || hue == Hue::blue || hue == Hue::magenta; }

bool closes(std::vector<OpenLine> lines) {
    const Joined joined = join_lines(std::move(lines));
    return std::any_of(joined.lines.begin(), joined.lines.end(),
                       [](const JoinedLine& line) { return line.closed; });
}

// The strokes in which outlines are drawn: those of closed lines, and solid ones of open lines that make a
// loop together. Folds make loops as well, so these colours of open lines count only where no others do.
class Outlines {
 public:
    explicit Outlines(const Tracing& tracing) {
        std::map<StrokeKey, std::vector<OpenLine>> open;
        for (const TracedLine& line : tracing.lines) {
            if (line.owner > 0 || line.use == Use::shape) continue;
            if (line.closed) {
                if (line.use == Use::cut && !line.ruled) any_ = true;
                closed_.push_back(&line);
            } else if (line.use == Use::cut && line.dash == Dash::none && !is_fold(line.named) &&
                       !line.ruled) {
                open[key_of(line)].push_back({line.points, line.element});
            }
        }
        if (!any_) look_for_loops(std::move(open));
    }
    // An outline of any stroke, or lines of a colour that folds do not have, of which outlines may be.
    [[nodiscard]] bool any() const { return any_; }
    [[nodiscard]] bool is_loop(const TracedLine& line) const {
        return loops_.find(key_of(line)) != loops_.end();
    }
    [[nodiscard]] const std::vector<const TracedLine*>& closed() const { return closed_; }

 private:
    void look_for_loops(std::map<StrokeKey, std::vector<OpenLine>>&& open) {
        const auto look = [&](bool fold_hue) {
            for (auto& [key, lines] : open) {
                const auto& [dash, r, g, b] = key;
                if (is_fold_hue(hue_of({r, g, b})) != fold_hue) continue;
                if (!fold_hue) any_ = true;
                if (closes(std::move(lines))) loops_.insert(key);
            }
        };
        look(false);
        if (loops_.empty()) look(true);
        any_ = any_ || !loops_.empty();
    }
    std::vector<const TracedLine*> closed_;
    std::set<StrokeKey> loops_;
    bool any_ = false;
};

// Strokes that are broken or have a fold's colour, and never make an outline.
class FoldLike {
 public:
    explicit FoldLike(const Tracing& tracing) : outlines_(tracing) {
        for (const TracedLine* line : outlines_.closed()) {
            if (line->use == Use::cut && !line->ruled && line->named != Named::fold)
                closed_.insert(key_of(*line));
        }
    }
    [[nodiscard]] bool is(const TracedLine& line) const {
        if (line.owner > 0 || line.use != Use::cut || line.ruled) return false;
        if (line.named != Named::nothing) return is_fold(line.named);
        if (closed_.find(key_of(line)) != closed_.end() || outlines_.is_loop(line)) return false;
        return line.dash != Dash::none || (outlines_.any() && is_fold_hue(hue_of(line.color)));
    }

 private:
    Outlines outlines_;
    std::set<StrokeKey> closed_;
};

// True where dashed blue and magenta are this program's own folds, so that dashed black is its seam.
bool has_own_folds(const Tracing& tracing) {
    return tracing.own_sheet ||
           std::any_of(tracing.lines.begin(), tracing.lines.end(), [](const TracedLine& line) {
               const Hue hue = hue_of(line.color);
               return line.dash != Dash::none && !line.ruled &&
                      (hue == Hue::magenta || (hue == Hue::blue && line.use == Use::mountain));
           });
}

// "mountain=#ff0000,valley=#0000ff" of the colours that no other line has; empty when there are none.
std::string rules_for(const std::vector<const TracedLine*>& folds, const Tracing& tracing) {
    const auto number = [](Color c) { return std::tuple(c.r, c.g, c.b); };
    std::set<const TracedLine*> are(folds.begin(), folds.end());
    std::set<std::tuple<std::uint8_t, std::uint8_t, std::uint8_t>> taken;
    for (const TracedLine& line : tracing.lines) {
        if (line.use != Use::shape && are.find(&line) == are.end()) taken.insert(number(line.color));
    }
    constexpr std::size_t kMostRules = 3;
    std::vector<std::string> rules;
    for (const TracedLine* line : folds) {
        if (rules.size() == kMostRules || !taken.insert(number(line->color)).second) continue;
        const Hue hue = hue_of(line->color);
        const std::string_view use = hue == Hue::red ? "mountain" : hue == Hue::blue ? "valley" : "fold";
        rules.push_back(fmt::format("{}={}", use, to_string(line->color)));
    }
    return fmt::format("{}", fmt::join(rules, ","));
}

// "2 solid red (#ff0000) lines, 1 dashed green (#00aa00) line".
std::string counted(const std::vector<const TracedLine*>& lines) {
    struct Row {
        std::string stroke;
        int count = 0;
    };
    std::vector<Row> rows;
    std::map<StrokeKey, std::size_t> row_of;
    for (const TracedLine* line : lines) {
        const auto [at, fresh] = row_of.try_emplace(key_of(*line), rows.size());
        if (fresh) rows.push_back({shown_stroke(*line)});
        ++nth(rows, at->second).count;
    }
    constexpr std::size_t kMostKinds = 4;
    std::vector<std::string> kinds;
    for (const Row& row : rows) {
        if (kinds.size() < kMostKinds)
            kinds.push_back(fmt::format("{} {} line{}", row.count, row.stroke, row.count == 1 ? "" : "s"));
    }
    if (rows.size() > kMostKinds) kinds.push_back(fmt::format("{} other kinds", rows.size() - kMostKinds));
    return fmt::format("{}", fmt::join(kinds, ", "));
}

void tell(const std::vector<const TracedLine*>& folds, std::string_view one, std::string_view many,
          const Tracing& tracing, Diagnostics& diagnostics) {
    if (folds.empty()) return;
    const bool single = folds.size() == 1;
    const std::string rules = rules_for(folds, tracing);
    diagnostics
        .warning("folds-as-cuts", nth(tracing.elements, folds.front()->element).place,
                 fmt::format("{} look{} like folds, and {} read as {}", counted(folds), single ? "s" : "",
                             single ? "is" : "are", single ? one : many))
        .hint("--as card reads them as the folds of a pop-up card that is cut from one sheet")
        .hint("--as folded reads them as the folds of a carton, or of another folded sheet")
        .hint(rules.empty() ? "--lines says which lines are what, by their layer, class, id or colour"
                            : "--lines says which lines are what: --lines " + rules);
}

}  // namespace

bool has_simulator_colors(const Tracing& tracing) {
    const Outlines outlines(tracing);
    std::set<Hue> around;
    std::set<Hue> others;
    for (const TracedLine& line : tracing.lines) {
        if (line.owner > 0 || line.use == Use::shape) continue;
        const Hue hue = hue_of(line.color);
        if (hue == Hue::magenta && line.dash != Dash::none) return false;
        const bool outline = line.dash == Dash::none && (line.closed || outlines.is_loop(line));
        (outline ? around : others).insert(hue);
    }
    if (around.empty() || around.count(Hue::red) > 0) return false;
    return others.count(Hue::red) > 0 || others.count(Hue::green) > 0;
}

bool has_folds(const Tracing& tracing) {
    const FoldLike fold_like(tracing);
    return std::any_of(tracing.lines.begin(), tracing.lines.end(), [&](const TracedLine& line) {
        return line.use == Use::mountain || line.use == Use::valley || is_fold(line.named) ||
               fold_like.is(line);
    });
}

void tell_fold_like(const Tracing& tracing, Diagnostics& diagnostics) {
    const FoldLike fold_like(tracing);
    const bool own = has_own_folds(tracing);
    std::vector<const TracedLine*> cuts;
    std::vector<const TracedLine*> seams;
    for (const TracedLine& line : tracing.lines) {
        if (fold_like.is(line)) cuts.push_back(&line);
        if (!own && line.use == Use::seam && line.owner == 0 && !line.ruled) seams.push_back(&line);
    }
    tell(cuts, "a cut", "cuts", tracing, diagnostics);
    tell(seams, "a seam, where paper is glued", "seams, where paper is glued", tracing, diagnostics);
}

}  // namespace popup::drawing
