#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <span>
#include <utility>

#include "base/text/shown.h"
#include "folded/carton/names.h"
#include "folded/carton/rough.h"
#include "popup/refinement.h"

namespace popup {
namespace {

using folded::PanelJoin;

constexpr double kDegree = std::numbers::pi / 180.0;

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
    while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
    return text;
}

class Accepter {
 public:
    Accepter(const CreasePattern& pattern, const folded::RoughShape& rough, const Suggestions& found,
             std::vector<PanelJoin> before, std::vector<PanelJoin> rows, std::vector<PanelJoin> met,
             const AcceptOptions& options)
        : pattern_(pattern),
          rough_(rough),
          found_(found),
          options_(options),
          joins_(std::move(before)),
          rows_(std::move(rows)),
          met_(std::move(met)) {}

    void take(std::size_t row) {
        if (!taken_.insert(row).second) return;
        joins_.push_back(rows_[row]);
        order_.push_back(row);
    }

    // Those that leave nothing open together with what is taken, and bring no crossing: seams before all that
    // closes ends, for tips that meet while the walls are open keep these apart; else the nearest first.
    // `most_turn_deg` is how far folds may turn.
    void try_all(std::vector<std::size_t> rows, double most_turn_deg) {
        most_turn_rad_ = most_turn_deg * kDegree;
        begin_ = joins_.empty() ? rough_.angles : close_joins(rough_.state(), joins_, true).angles;
        const bool begins_far = folded::furthest_turn(rough_, begin_).by_deg() > most_turn_deg;
        std::erase_if(rows, [&](std::size_t row) {
            if (taken_.contains(row)) return true;
            const Suggestion& one = found_.rows[row];
            if (!one.closes || flattens(row)) {
                left_.push_back(row);
            } else if (!begins_far && one.furthest.by_deg() > most_turn_deg) {
                turning_.push_back(row);
            } else {
                return false;
            }
            return true;
        });
        if (rows.empty()) return;
        std::stable_sort(rows.begin(), rows.end(), [&](std::size_t a, std::size_t b) {
            if (is_seam(a) != is_seam(b)) return is_seam(a);
            return found_.rows[a].apart_mm < found_.rows[b].apart_mm - 1e-6;
        });
        const std::vector<PanelJoin> before = joins_;
        allowed_ = {};
        // Mostly all of them fit; where they do not, halves are tried, the nearer one first.
        std::vector<std::vector<std::size_t>> groups{rows};
        std::vector<std::size_t> fitting;
        while (!groups.empty() && looks_ + kKeptForWays < most_looks()) {
            const std::vector<std::size_t> group = std::move(groups.back());
            groups.pop_back();
            if (fits(with(before, fitting, group), false)) {
                fitting.insert(fitting.end(), group.begin(), group.end());
            } else if (group.size() > 1) {
                const auto middle = group.begin() + static_cast<std::ptrdiff_t>(group.size() + 1) / 2;
                groups.emplace_back(middle, group.end());
                groups.emplace_back(group.begin(), middle);
            }
        }
        leave_turning(before, fitting);
        keep_ways_clear(before, fitting);
        for (const std::size_t row : rows) {
            if (std::find(fitting.begin(), fitting.end(), row) == fitting.end()) left_.push_back(row);
        }
        for (const std::size_t row : fitting) take(row);
    }

    // Those of what has met that can stay so; numbers, ascending.
    std::vector<std::size_t> kept() {
        if (!kept_) kept_ = keep(joins_);
        return *kept_;
    }

    [[nodiscard]] const std::vector<std::size_t>& order() const { return order_; }
    std::vector<std::size_t> left() {
        std::sort(left_.begin(), left_.end());
        return left_;
    }
    // Of what was not taken that which by itself turns a fold too far.
    std::vector<std::size_t> turning() {
        std::sort(turning_.begin(), turning_.end());
        return turning_;
    }

 private:
    // Whether it makes one plane of panels that are meant to stand at an angle, as walls of a tube of many
    // sides are, or the tongues of a lock and their flap.
    [[nodiscard]] bool flattens(std::size_t row) const {
        const Suggestion& one = found_.rows[row];
        return one.join.kind == JoinKind::coplanar && one.turn_deg > kMostFlattenedDeg;
    }
    // Whether it brings walls together, and what is glued to them, alone.
    [[nodiscard]] bool is_seam(std::size_t row) const {
        if (found_.rows[row].join.kind == JoinKind::coplanar) return false;
        const std::vector<JoinPart>& parts = found_.rows[row].join.parts;
        return std::all_of(parts.begin(), parts.end(),
                           [](const JoinPart& part) { return folded::is_of_walls(part.panel); });
    }

    [[nodiscard]] bool closes(const std::vector<PanelJoin>& joins) const {
        return joins.empty() || is_sound(close_joins(rough_.state(), joins, true));
    }
    [[nodiscard]] bool is_sound(const folded::Closed& closed) const {
        return closed.residual_mm <= rough_.enough_mm() && !closed.swings;
    }
    // Together, joins may turn a fold further than each does. One that what is named has turned too far
    // already may turn as much again.
    [[nodiscard]] bool turns_far(const std::vector<double>& angles) const {
        for (std::size_t i = 0; i < angles.size() && i < begin_.size(); ++i) {
            const bool is_far = std::abs(begin_[i] - rough_.angles[i]) > most_turn_rad_;
            const double from = is_far ? begin_[i] : rough_.angles[i];
            if (std::abs(angles[i] - from) > most_turn_rad_) return true;
        }
        return false;
    }

    // Those of what has met that leave nothing open with these.
    std::vector<std::size_t> keep(std::vector<PanelJoin> joins) {
        std::vector<PanelJoin> whole = joins;
        whole.insert(whole.end(), met_.begin(), met_.end());
        const bool all_fit = closes(whole);
        std::vector<std::size_t> kept;
        for (std::size_t i = 0; i < met_.size(); ++i) {
            joins.push_back(met_[i]);
            if (all_fit || (may_look() && closes(joins))) {
                kept.push_back(i);
            } else {
                joins.pop_back();
            }
        }
        return kept;
    }

    [[nodiscard]] std::vector<PanelJoin> with(std::vector<PanelJoin> joins,
                                              const std::vector<std::size_t>& some,
                                              const std::vector<std::size_t>& more) const {
        for (const std::size_t row : some) joins.push_back(rows_[row]);
        for (const std::size_t row : more) joins.push_back(rows_[row]);
        return joins;
    }

    [[nodiscard]] Crossings crossings(const std::vector<double>& angles, bool whole_way) const {
        return options_.crossings(folded::pattern_of(pattern_, rough_, angles), whole_way);
    }
    // False when that has been done often enough: each time, all panels are moved.
    bool may_look() { return ++looks_ <= most_looks(); }
    [[nodiscard]] std::size_t most_looks() const {
        const std::size_t panels = std::max<std::size_t>(rough_.sheet.panels.size(), 1);
        return std::min(kMostLooks, kMostMoved / panels);
    }
    // What crosses as it is drawn, and with what was named, is not the fault of what is tried. It is looked
    // for when something crosses, which seldom is.
    [[nodiscard]] const Crossings& allowed(bool whole_way) {
        std::optional<Crossings>& now = allowed_.at(whole_way ? 1 : 0);
        if (now) return *now;
        now = crossings(begin_, whole_way);
        if (whole_way) now->insert(allowed(false).begin(), allowed(false).end());
        return *now;
    }

    // Whether these joins close, and what they bring crosses nowhere.
    bool fits(const std::vector<PanelJoin>& joins, bool whole_way) {
        new_.clear();
        if (!may_look()) return false;
        const folded::Closed closed = close_joins(rough_.state(), joins, true);
        if (!is_sound(closed) || turns_far(closed.angles)) return false;
        if (!options_.crossings) return true;
        for (const auto& pair : crossings(closed.angles, whole_way)) {
            if (!allowed(whole_way).contains(pair)) new_.insert(pair);
        }
        return new_.empty();
    }

    // Leaves out the last ones until no fold turns too far when what has met stays together, too.
    void leave_turning(const std::vector<PanelJoin>& before, std::vector<std::size_t>& fitting) {
        while (!fitting.empty()) {
            std::vector<PanelJoin> joins = with(before, fitting, {});
            kept_ = keep(joins);
            for (const std::size_t one : *kept_) joins.push_back(met_[one]);
            if (!turns_far(close_joins(rough_.state(), joins, true).angles)) return;
            fitting.pop_back();
            kept_.reset();
        }
    }

    // Leaves out what concerns panels that cross while the sheet is folded; in the end, all of it. What has
    // met is looked at with the rest, for it is kept with that, and is the first to be left out.
    void keep_ways_clear(const std::vector<PanelJoin>& before, std::vector<std::size_t>& fitting) {
        for (int i = 0; i < kMostWaysLookedAt && !fitting.empty() && options_.crossings; ++i) {
            std::vector<PanelJoin> joins = with(before, fitting, {});
            if (!is_met_in_the_way_ && (i > 0 || !kept_)) kept_ = keep(joins);
            for (const std::size_t one : *kept_) joins.push_back(met_[one]);
            if (fits(joins, true)) return;
            if (!kept_->empty()) {
                is_met_in_the_way_ = true;
                kept_->clear();
                continue;
            }
            const auto crosses = [&](const std::string& panel) {
                return std::any_of(new_.begin(), new_.end(), [&](const auto& pair) {
                    return pair.first == panel || pair.second == panel;
                });
            };
            const auto concerns = [&](std::size_t row) {
                const std::vector<JoinPart>& parts = found_.rows[row].join.parts;
                return std::any_of(parts.begin(), parts.end(),
                                   [&](const JoinPart& part) { return crosses(part.panel); });
            };
            // A seam is the last to be left out: without it nothing else closes a box.
            if (std::erase_if(fitting, [&](std::size_t row) { return concerns(row) && !is_seam(row); }) > 0)
                continue;
            if (std::erase_if(fitting, [&](std::size_t row) { return !is_seam(row); }) > 0) continue;
            if (std::erase_if(fitting, concerns) == 0) break;
        }
        if (options_.crossings) fitting.clear();
        kept_.reset();
    }

    static constexpr double kMostFlattenedDeg = 5.0;
    static constexpr std::size_t kMostLooks = 100;
    static constexpr std::size_t kKeptForWays = 10;    // looks
    static constexpr std::size_t kMostMoved = 20'000;  // panels
    static constexpr int kMostWaysLookedAt = 7;
    const CreasePattern& pattern_;
    const folded::RoughShape& rough_;
    const Suggestions& found_;
    const AcceptOptions& options_;
    std::vector<PanelJoin> joins_;
    std::vector<PanelJoin> rows_;
    std::vector<PanelJoin> met_;
    std::optional<std::vector<std::size_t>> kept_;  // of these; none: not known yet
    bool is_met_in_the_way_ = false;
    std::set<std::size_t> taken_;
    std::vector<std::size_t> order_;
    std::vector<std::size_t> left_, turning_;
    double most_turn_rad_ = HUGE_VAL;
    std::vector<double> begin_;  // by fold: where what is named leaves it, radians; empty: nothing is tried
    std::array<std::optional<Crossings>, 2> allowed_;  // folded, and on the whole way; none: not asked yet
    Crossings new_;                                    // what fits() has found
    std::size_t looks_ = 0;
};

// "merge 1 to 4, merge 6, paste 1".
std::string names_of(const std::vector<Suggestion>& rows) {
    std::string names;
    for (std::size_t i = 0; i < rows.size();) {
        std::size_t last = i;
        while (last + 1 < rows.size() && rows[last + 1].join.kind == rows[i].join.kind &&
               rows[last + 1].number == rows[last].number + 1) {
            ++last;
        }
        names += (names.empty() ? "" : ", ") + rows[i].name();
        if (last > i) names += fmt::format(" to {}", rows[last].number);
        i = last + 1;
    }
    return names;
}

// Rows that the words name, without what was accepted before; `all` is set where they say so. nullopt: a word
// names none.
std::optional<std::vector<std::size_t>> rows_named(const Suggestions& found, std::span<const Join> before,
                                                   std::string_view words, bool& all,
                                                   Diagnostics& diagnostics) {
    const std::string_view whole = words;
    std::vector<std::size_t> rows;
    while (true) {
        const std::size_t comma = words.find(',');
        const std::string_view word = trimmed(words.substr(0, comma));
        const auto row = std::find_if(found.rows.begin(), found.rows.end(),
                                      [&](const Suggestion& one) { return one.name() == word; });
        const bool is_old = std::any_of(before.begin(), before.end(), [&](const Join& one) {
            return one.number > 0 && Suggestion{one, one.number}.name() == word;
        });
        if (word == "all") {
            all = true;
        } else if (is_old) {
            // It is in the refinement file since it was accepted.
        } else if (word.empty()) {
            diagnostics
                .error("no-such-suggestion", {},
                       fmt::format("\"{}\" names nothing before or behind a comma", shown(whole)))
                .hint("leave the comma out");
            return std::nullopt;
        } else if (row != found.rows.end()) {
            rows.push_back(static_cast<std::size_t>(row - found.rows.begin()));
        } else {
            const std::string names = names_of(found.rows);
            diagnostics
                .error("no-such-suggestion", {}, fmt::format("there is no suggestion \"{}\"", shown(word)))
                .hint(names.empty() ? "there are none" : "there are " + names);
            return std::nullopt;
        }
        if (comma == std::string_view::npos) return rows;
        words.remove_prefix(comma + 1);
    }
}

void tell_left(const Suggestions& found, const std::vector<std::size_t>& left,
               const std::vector<std::size_t>& turning, double most_turn_deg, Diagnostics& diagnostics) {
    if (!left.empty()) {
        std::string names;
        for (const std::size_t row : left) names += (names.empty() ? "" : ", ") + found.rows[row].name();
        diagnostics
            .remark("join-left", {},
                    fmt::format(
                        "not accepted, because panels would have to bend, swing far, turn too far with the "
                        "others or cross: {}",
                        names))
            .hint("--accept with its name takes one nevertheless, as near as it comes");
    }
    if (turning.empty()) return;
    std::string names;
    double least = HUGE_VAL;
    for (const std::size_t row : turning) {
        const Suggestion& one = found.rows[row];
        const double by = one.furthest.by_deg();
        least = std::min(least, by);
        names += fmt::format("{}{} by {:.1f}°", names.empty() ? "" : ", ", one.name(), by);
    }
    diagnostics
        .remark("join-left", {},
                fmt::format("not accepted, because a fold would turn by more than {:g}°: {}", most_turn_deg,
                            names))
        .hint(fmt::format(
            "--accept with its name takes one nevertheless, and --most-turn {:.0f} those that turn no "
            "fold further",
            std::floor(least) + 1.0));
}

// Precondition: there is one.
std::size_t merge_numbered(const Suggestions& found, int number) {
    const auto row = std::find_if(found.rows.begin(), found.rows.end(), [number](const Suggestion& one) {
        return one.join.kind == JoinKind::merge && one.number == number;
    });
    return static_cast<std::size_t>(row - found.rows.begin());
}

}  // namespace

std::optional<std::vector<Join>> accept_joins(const CreasePattern& pattern, const SuggestOptions& options,
                                              const Suggestions& found, std::string_view words,
                                              const AcceptOptions& accept, Diagnostics& diagnostics) {
    bool all = false;
    const auto named = rows_named(found, options.joins, words, all, diagnostics);
    if (!named) return std::nullopt;
    Diagnostics heard;  // the sheet has told what it had to tell when the suggestions were found
    const auto rough = folded::rough_shape(pattern, options.fold, heard);
    if (!rough) return std::nullopt;
    auto before = folded::resolve(*rough, options.joins, pattern,
                                  options.of_joins != nullptr ? *options.of_joins : diagnostics);
    std::vector<Join> joins;
    for (const Suggestion& row : found.rows) joins.push_back(row.join);
    auto rows = folded::resolve(*rough, joins, pattern, diagnostics);
    const auto met = folded::resolve(*rough, found.met, pattern, diagnostics);
    if (!before || !rows || !met) return std::nullopt;
    Accepter accepter(pattern, *rough, found, std::move(*before), std::move(*rows), *met, accept);
    for (const std::size_t row : *named) accepter.take(row);
    std::vector<std::size_t> more;
    if (all) {
        for (std::size_t i = 0; i < found.rows.size(); ++i) {
            if (!found.rows[i].lies()) more.push_back(i);
        }
    } else if (accept.alike) {
        std::set<std::size_t> alike;
        for (const std::size_t row : *named) {
            for (const int number : found.rows[row].like) alike.insert(merge_numbered(found, number));
        }
        more.assign(alike.begin(), alike.end());
    }
    // What is like a join that is named turns folds as far as that does.
    accepter.try_all(std::move(more), all ? accept.most_turn_deg : HUGE_VAL);
    tell_left(found, accepter.left(), accepter.turning(), accept.most_turn_deg, diagnostics);
    std::vector<Join> result = options.joins;
    // The same words make the same file again.
    if (!result.empty() && accepter.order().empty()) return result;
    for (const std::size_t row : accepter.order()) result.push_back(found.rows[row].join);
    const auto is_new = [&](const Join& join) {
        return std::none_of(options.joins.begin(), options.joins.end(), [&](const Join& old) {
            return shown_join(old, pattern.ruler) == shown_join(join, pattern.ruler);
        });
    };
    for (const std::size_t one : accepter.kept()) {
        if (is_new(found.met[one])) result.push_back(found.met[one]);
    }
    return result;
}

}  // namespace popup
