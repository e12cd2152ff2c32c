#include "folded/carton/ring.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "base/nth.h"
#include "base/text/quoted_words.h"
#include "folded/carton/closing_angles.h"
#include "folded/lower.h"
#include "folded/sheet.h"

namespace popup::folded {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kParallel = 0.02;    // sine of the angle between folds that are called parallel
constexpr double kAsLong = 0.6;       // of the longest of them: so long are folds between walls
constexpr double kFlapWidth = 0.9;    // of the narrowest wall: a glue flap is narrower
constexpr double kAsItIsDeg = 0.5;    // folds that are to go otherwise by less go as they should
constexpr double kColourDeg = 180.0;  // of folds in the colours of Origami Simulator
constexpr double kOfBoxesDeg = 90.0;
constexpr std::size_t kMostPanels = 400;
constexpr std::size_t kMostWalls = 64;
constexpr std::size_t kLeastWalls = 3;
constexpr std::size_t kLeastCoiled = 5;
constexpr double kAsWide = 0.02;  // of the wider: walls that differ by less are as wide as each other

// Panels side by side: fold i is between panels i and i + 1.
struct Row {
    std::vector<int> panels, folds;
    std::vector<double> widths;  // of the panels
    bool goes_on = false;        // by a fold the other way, or round to one of its panels
};

class RowFinder {
 public:
    explicit RowFinder(const Sheet& sheet) : sheet_(sheet), folds_(folds_by_panel(sheet)) {}

    // Rows that go on no further, in both directions.
    [[nodiscard]] std::vector<Row> rows() const {
        std::vector<Row> found;
        for (std::size_t i = 0; i < sheet_.folds.size(); ++i) {
            const Fold& fold = sheet_.folds[i];
            const int number = static_cast<int>(i);
            for (const auto& [from, to] : {std::pair{fold.left, fold.right}, {fold.right, fold.left}}) {
                if (next(number, from) < 0) found.push_back(row_from(number, from, to));
            }
        }
        return found;
    }

 private:
    [[nodiscard]] Segment line_of(int fold) const { return sheet_.line_of(nth(sheet_.folds, fold)); }

    // How far a panel reaches from a fold that it ends at.
    [[nodiscard]] double depth(int panel, int fold) const {
        const Segment line = line_of(fold);
        const Vec2 out = left_of(unit(line.b - line.a));
        double most = 0.0;
        for (const int corner : nth(sheet_.panels, panel).outer)
            most = std::max(most, std::abs(dot(out, sheet_.at(corner) - line.a)));
        return most;
    }
    // The fold at which a panel ends on the far side of this one, whichever way it goes; -1: there is none.
    [[nodiscard]] int next(int fold, int panel) const {
        const Segment line = line_of(fold);
        const Vec2 along = unit(line.b - line.a);
        const Vec2 out = left_of(along);
        const double far = 0.5 * depth(panel, fold);
        int best = -1;
        double longest = 0.0;
        for (const int number : nth(folds_, panel)) {
            const Segment other = line_of(number);
            const Vec2 way = other.b - other.a;
            if (number == fold || std::abs(cross(along, way)) > kParallel * length(way) ||
                std::abs(dot(out, other.a - line.a)) < far || length(way) <= longest)
                continue;
            best = number;
            longest = length(way);
        }
        return longest >= kAsLong * distance(line.a, line.b) ? best : -1;
    }
    [[nodiscard]] bool same_way(int one, int other) const {
        return nth(sheet_.folds, one).target * nth(sheet_.folds, other).target > 0.0;
    }
    [[nodiscard]] Row row_from(int fold, int from, int to) const {
        Row row{{from, to}, {fold}, {depth(from, fold)}};
        for (int more = next(fold, to); more >= 0; more = next(fold, to)) {
            const Segment line = line_of(fold);
            row.widths.push_back(std::abs(dot(left_of(unit(line.b - line.a)), line_of(more).a - line.a)));
            const Fold& crossed = nth(sheet_.folds, more);
            to = crossed.left == to ? crossed.right : crossed.left;
            row.goes_on = !same_way(fold, more) || row.folds.size() > kMostWalls ||
                          std::find(row.panels.begin(), row.panels.end(), to) != row.panels.end();
            if (row.goes_on) break;
            fold = more;
            row.panels.push_back(to);
            row.folds.push_back(fold);
        }
        row.widths.push_back(depth(to, fold));
        return row;
    }

    const Sheet& sheet_;
    std::vector<std::vector<int>> folds_;
};

class RingFinder {
 public:
    RingFinder(const CreasePattern& pattern, const Sheet& sheet) : pattern_(pattern), sheet_(sheet) {}

    // The ways in which the longest closes, best first.
    [[nodiscard]] std::vector<OpenRing> longest() const {
        std::vector<OpenRing> best;
        for (const Row& row : RowFinder(sheet_).rows()) {
            if (!best.empty() && row.folds.size() <= best.front().lines.size()) continue;
            if (std::vector<OpenRing> rings = rings_of(row); !rings.empty()) best = std::move(rings);
        }
        return best;
    }

 private:
    [[nodiscard]] std::vector<OpenRing> rings_of(const Row& row) const {
        const std::vector<double> walls(row.widths.begin(), row.widths.end() - 1);
        if (row.goes_on || walls.size() < kLeastWalls || walls.size() != row.folds.size()) return {};
        if (row.widths.back() >= kFlapWidth * *std::min_element(walls.begin(), walls.end())) return {};
        OpenRing ring;
        std::vector<double> is;
        for (const int number : row.folds) {
            const Fold& fold = nth(sheet_.folds, number);
            if (nth(pattern_.lines, fold.line).fold_deg.value_or(kColourDeg) != kColourDeg ||
                !stands_for_itself(row, fold.line))
                return {};
            is.push_back(std::abs(fold.target) / kDegree);
            ring.lines.push_back(fold.line);
        }
        ring.is_deg = is.front();
        const Ends ends = ends_of(row, walls);
        ring.hangs_open = coils(walls, is) ||
                          ((ends.fold_deg || !ends.any) &&
                           gap_of(walls, is) > kMeets * std::accumulate(walls.begin(), walls.end(), 0.0));
        std::vector<OpenRing> rings;
        for (ClosingAngles& way : closing_angles(walls, ends.fold_deg)) {
            bool is_so = true;
            for (std::size_t i = 0; i < is.size(); ++i)
                is_so = is_so && std::abs(is[i] - way.deg[i]) < kAsItIsDeg;
            if (is_so) return {};
            rings.push_back(ring);
            rings.back().deg = std::move(way.deg);
            rings.back().why = way.why;
        }
        return rings;
    }
    // Whether walls as wide as each other go around more than once. No tray has five such panels in a row.
    [[nodiscard]] static bool coils(const std::vector<double>& walls, const std::vector<double>& deg) {
        const auto [least, most] = std::minmax_element(walls.begin(), walls.end());
        return walls.size() >= kLeastCoiled && *most - *least <= kAsWide * *most &&
               std::accumulate(deg.begin(), deg.end(), 0.0) > 360.0 + kAsItIsDeg;
    }
    // What hangs on the ends of the walls, and how far one of them has it that the walls' folds go.
    struct Ends {
        bool any = false;
        std::optional<std::vector<double>> fold_deg;
    };
    [[nodiscard]] Ends ends_of(const Row& row, const std::vector<double>& walls) const {
        Ends ends;
        for (std::size_t i = 0; i < sheet_.folds.size(); ++i) {
            const Fold& fold = sheet_.folds[i];
            for (const auto& [wall, end] :
                 {std::pair{fold.left, fold.right}, std::pair{fold.right, fold.left}}) {
                const auto found = std::find(row.panels.begin(), row.panels.end() - 1, wall);
                const auto number = static_cast<std::size_t>(found - row.panels.begin());
                if (number == walls.size() ||
                    std::find(row.panels.begin(), row.panels.end(), end) != row.panels.end())
                    continue;
                ends.any = true;
                if (ends.fold_deg) continue;
                ends.fold_deg = fold_angles_of_end(sheet_.outline_of(nth(sheet_.panels, end)).outer,
                                                   sheet_.line_of(fold), walls, number);
            }
        }
        return ends;
    }
    // Whether a line draws no fold but one of the row.
    [[nodiscard]] bool stands_for_itself(const Row& row, int line) const {
        std::size_t of_line = 0;
        for (const Fold& fold : sheet_.folds) of_line += fold.line == line ? 1 : 0;
        std::size_t of_row = 0;
        for (const int fold : row.folds) of_row += nth(sheet_.folds, fold).line == line ? 1 : 0;
        return of_line == of_row && of_row == 1;
    }

    const CreasePattern& pattern_;
    const Sheet& sheet_;
};

// What becomes of other folds: those of 180°, which are in the colours of Origami Simulator, may be meant to
// go to 90°.
enum class Others { as_they_are, of_boxes };

bool is_of(const OpenRing& ring, std::size_t line) {
    return std::find(ring.lines.begin(), ring.lines.end(), static_cast<int>(line)) != ring.lines.end();
}
bool is_folded(const CreaseLine& line) { return line.use != CreaseUse::cut && line.use != CreaseUse::flat; }

// As a drawing or an option says it: walls of 200 mm are then 0.001 mm off at most.
double rounded_deg(double deg) { return std::round(deg * 1e4) / 1e4; }
std::string exact_deg(double deg) { return fmt::format("{:.8g}", rounded_deg(deg)); }

// nullopt: there are no others.
std::optional<CreasePattern> folded_so(const CreasePattern& pattern, const OpenRing& ring, Others others) {
    CreasePattern made = pattern;
    for (std::size_t i = 0; i < ring.lines.size(); ++i)
        nth(made.lines, ring.lines[i]).fold_deg = rounded_deg(ring.deg[i]);
    if (others == Others::as_they_are) return made;
    bool any = false;
    for (CreaseLine& line : made.lines) {
        if (!is_folded(line) || line.fold_deg != kColourDeg) continue;
        line.fold_deg = kOfBoxesDeg;
        any = true;
    }
    return any ? std::optional(std::move(made)) : std::nullopt;
}

// Whether all other folds go to 90° if all are told to, and none to less or more than is meant.
bool may_tell_all(const CreasePattern& pattern, const OpenRing& ring) {
    for (std::size_t i = 0; i < pattern.lines.size(); ++i) {
        const CreaseLine& line = pattern.lines[i];
        if (is_folded(line) && !is_of(ring, i) && line.fold_deg.value_or(pattern.fold_deg) != kColourDeg &&
            line.fold_deg.value_or(pattern.fold_deg) != kOfBoxesDeg)
            return false;
    }
    return true;
}

std::string shown_deg(double deg) { return fmt::format("{:.6g}", std::round(deg * 100.0) / 100.0); }

// Angles by what they are given to, as --fold-angle takes them; empty: no such name is of these lines alone.
std::string as_options(const CreasePattern& pattern, const OpenRing& ring) {
    const bool alike = std::all_of(ring.deg.begin(), ring.deg.end(),
                                   [&](double deg) { return shown_deg(deg) == shown_deg(ring.deg[0]); });
    const auto may_name = [&](const auto& has_name) {
        for (std::size_t i = 0; i < pattern.lines.size(); ++i) {
            if (is_folded(pattern.lines[i]) && has_name(pattern.lines[i]) && !is_of(ring, i)) return false;
        }
        return true;
    };
    std::set<std::string> names;
    for (const int line : ring.lines) names.insert(nth(pattern.lines, line).name);
    const bool by_name = std::all_of(names.begin(), names.end(), [&](const std::string& name) {
        return !name.empty() && may_name([&](const CreaseLine& line) { return line.name == name; });
    });
    const auto told = [](std::string_view name, double deg) {
        return "--fold-angle " + typed_word(fmt::format("{}={}", name, exact_deg(deg)));
    };
    std::vector<std::string> options;
    if (by_name && alike) {
        for (const std::string& name : names) options.push_back(told(name, ring.deg[0]));
    } else if (by_name && names.size() == ring.lines.size()) {
        for (std::size_t i = 0; i < ring.lines.size(); ++i)
            options.push_back(told(nth(pattern.lines, ring.lines[i]).name, ring.deg[i]));
    } else if (alike) {
        const CreaseUse use = nth(pattern.lines, ring.lines[0]).use;
        // Folds that say no direction are folded as valleys where they are free to.
        const auto is_told = [&](const CreaseLine& line) {
            return line.use == use || (use == CreaseUse::valley && line.use == CreaseUse::fold);
        };
        if (use != CreaseUse::fold && may_name(is_told))
            options.push_back(told(kCreaseUseNames.at(static_cast<std::size_t>(use)), ring.deg[0]));
    }
    return fmt::format("{}", fmt::join(options, " "));
}

// "1, 2 and 3".
std::string listed(const std::vector<std::string>& words) {
    if (words.size() == 1) return words[0];
    return fmt::format("{} and {}", fmt::join(words.begin(), words.end() - 1, ", "), words.back());
}

std::string angles_of(const OpenRing& ring) {
    std::vector<std::string> deg;
    for (const double one : ring.deg) deg.push_back(shown_deg(one) + "°");
    if (std::set<std::string>(deg.begin(), deg.end()).size() == 1) return deg[0];
    return listed(deg) + ", in this order";
}

// Whether the elements that draw these folds draw no other.
bool have_own_elements(const CreasePattern& pattern, const OpenRing& ring) {
    for (std::size_t i = 0; i < pattern.lines.size(); ++i) {
        if (is_of(ring, i)) continue;
        for (const int line : ring.lines) {
            if (nth(pattern.lines, line).place == pattern.lines[i].place) return false;
        }
    }
    return true;
}

// The options that fold the sheet so; empty: none can.
std::string all_options(const CreasePattern& pattern, const OpenRing& ring, Others others) {
    std::string options = as_options(pattern, ring);
    if (others == Others::as_they_are) return options;
    if (!may_tell_all(pattern, ring)) return {};
    if (angles_of(ring) == "90°") return "--fold-angle 90";
    return options.empty() ? options : "--fold-angle 90 " + options;
}

// Whether people can read its lines and write into them.
bool is_markup(const CreasePattern& pattern) {
    std::string end =
        pattern.file.substr(pattern.file.size() - std::min<std::size_t>(4, pattern.file.size()));
    std::transform(end.begin(), end.end(), end.begin(), [](unsigned char c) {
        return static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
    });
    return end != ".dxf";
}

// For people: by the lines of a text that they can read, else by where the folds are.
std::string where_drawn(const CreasePattern& pattern, const OpenRing& ring) {
    std::set<int> places;
    std::vector<std::string> middles;
    for (const int number : ring.lines) {
        const CreaseLine& line = nth(pattern.lines, number);
        places.insert(line.place.line);
        middles.push_back(shown_point(pattern.ruler, lerp(line.points.front(), line.points.back(), 0.5)));
    }
    if (!is_markup(pattern)) return "their middles at " + listed(middles);
    std::vector<std::string> words;
    words.reserve(places.size());
    for (const int line : places) words.push_back(std::to_string(line));
    return fmt::format("in line{} {}", words.size() == 1 ? "" : "s", listed(words));
}

// What the elements that draw these folds are to say, by where they begin.
std::string with_attributes(const CreasePattern& pattern, const OpenRing& ring, bool of_boxes) {
    std::vector<std::string> words;
    std::set<std::pair<int, int>> told;
    for (const int number : ring.lines) {
        const Place place = nth(pattern.lines, number).place;
        if (!told.insert({place.line, place.column}).second) continue;
        std::vector<std::string> angles;
        for (std::size_t i = 0; i < pattern.lines.size(); ++i) {
            if (pattern.lines[i].place != place) continue;
            const auto found = std::find(ring.lines.begin(), ring.lines.end(), static_cast<int>(i));
            angles.push_back(found != ring.lines.end()
                                 ? exact_deg(nth(ring.deg, static_cast<int>(found - ring.lines.begin())))
                             : of_boxes ? shown_deg(kOfBoxesDeg)
                                        : "auto");
        }
        words.push_back(fmt::format("data-fold-angle=\"{}\" in line {}", fmt::join(angles, " "), place.line));
    }
    return fmt::format("write {} into {}{}", listed(words),
                       words.size() == 1 ? "its element" : "their elements",
                       of_boxes ? ", and data-fold-angle=\"90\" into those of the others" : "");
}

std::string what_mends(const CreasePattern& pattern, const OpenRing& ring, Others others) {
    const std::string options = all_options(pattern, ring, others);
    if (!options.empty()) return "fold them so: " + options;
    const std::string where = where_drawn(pattern, ring);
    const bool of_boxes = others == Others::of_boxes;
    const std::string own_colour =
        fmt::format("in a colour that no other fold has, and give --fold-angle {}for that colour",
                    of_boxes ? "90 for all and then one " : "");
    const bool alike = angles_of(ring).find(' ') == std::string::npos;
    if (is_markup(pattern) && !alike) return with_attributes(pattern, ring, of_boxes);
    if (!alike) {
        return fmt::format(
            "draw them, {}, each in a colour that no other fold has, and give {}--fold-angle "
            "for each of these colours",
            where, of_boxes ? "--fold-angle 90 for all and then one " : "");
    }
    if (!is_markup(pattern) || !have_own_elements(pattern, ring))
        return fmt::format("draw them, {}, {}", where, own_colour);
    return fmt::format("write data-fold-angle=\"{}\" into their elements, {}{}, or draw them {}",
                       exact_deg(ring.deg[0]), where,
                       of_boxes ? ", and data-fold-angle=\"90\" into those of the others" : "", own_colour);
}

}  // namespace

std::vector<OpenRing> open_rings(const CreasePattern& pattern, const FoldOptions& options) {
    if (!options.fold_angles.empty() || options.to < 1.0 || options.flat) return {};
    Diagnostics unheard;
    const std::optional<Sheet> sheet = make_sheet(pattern, options, unheard);
    if (!sheet || sheet->panels.size() > kMostPanels) return {};
    return RingFinder(pattern, *sheet).longest();
}

void tell_open_ring(const CreasePattern& pattern, const FoldOptions& options, bool collides,
                    const Simulated& simulated, Diagnostics& diagnostics) {
    for (const OpenRing& ring : open_rings(pattern, options)) {
        if (!collides && !ring.hangs_open) return;
        for (const Others others : {Others::of_boxes, Others::as_they_are}) {
            const std::optional<CreasePattern> trial = folded_so(pattern, ring, others);
            if (!trial) continue;
            Diagnostics unheard;
            std::optional<Assembly> folded = fold_sheet(*trial, options, unheard);
            if (!folded || !simulated(*folded, unheard) || unheard.has_findings()) continue;
            diagnostics
                .remark(
                    "ring-open", nth(pattern.lines, ring.lines[0]).place,
                    fmt::format("{0} walls side by side, with a glue flap at their end, meet if their {0} "
                                "folds go by {1} instead of {2}°{3}{4}; nothing goes through anything then",
                                ring.lines.size(), angles_of(ring), shown_deg(ring.is_deg),
                                others == Others::of_boxes ? ", and all other folds by 90°" : "",
                                ring.why.empty() ? "" : fmt::format(", {}", ring.why)))
                .hint(what_mends(pattern, ring, others));
            return;
        }
    }
}

}  // namespace popup::folded
