#include "input/drawing/card/lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>
#include <tuple>

#include "base/geometry/mend_ends.h"
#include "base/nth.h"
#include "input/color.h"
#include "input/drawing/notation.h"

namespace popup::drawing::card {
namespace {

using StrokeKey = std::tuple<Dash, std::uint8_t, std::uint8_t, std::uint8_t>;
StrokeKey key_of(const TracedLine& line) { return {line.dash, line.color.r, line.color.g, line.color.b}; }

// Lines within this of the sides of all that is drawn make its frame.
constexpr double kFrameMm = 0.5;

enum class Meaning { cut, mountain, valley, fold, hole, print, ignore };
constexpr std::array<std::string_view, 7> kMeanings{"cuts",  "mountain folds", "valley folds",        "folds",
                                                    "holes", "printed",        "nothing of the sheet"};

constexpr std::string_view kByName = "by their layer, class or id";

struct Guess {
    Meaning meaning = Meaning::cut;
    std::string_view by;  // empty: nothing needs to be said of it
};

// How the lines along all four sides of the drawing are drawn: these are cuts.
std::set<StrokeKey> frame_strokes(const Tracing& tracing) {
    Box box;
    for (const TracedLine& line : tracing.lines) {
        for (const Vec2 p : line.points) box.extend(p);
    }
    std::map<StrokeKey, std::array<bool, 4>> sides;
    for (const TracedLine& line : tracing.lines) {
        if (line.use == Use::shape) continue;
        const std::size_t count = line.points.size();
        for (std::size_t i = 0; i + (line.closed ? 0 : 1) < count; ++i) {
            const Vec2 a = line.points[i];
            const Vec2 b = line.points[(i + 1) % count];
            const auto along = [&](double p, double q, double side) {
                return std::abs(p - side) <= kFrameMm && std::abs(q - side) <= kFrameMm;
            };
            const bool wide = std::abs(b.x - a.x) > 0.5 * box.width();
            const bool high = std::abs(b.y - a.y) > 0.5 * box.height();
            std::array<bool, 4>& of = sides[key_of(line)];
            of[0] = of[0] || (wide && along(a.y, b.y, box.min.y));
            of[1] = of[1] || (wide && along(a.y, b.y, box.max.y));
            of[2] = of[2] || (high && along(a.x, b.x, box.min.x));
            of[3] = of[3] || (high && along(a.x, b.x, box.max.x));
        }
    }
    std::set<StrokeKey> found;
    for (const auto& [key, of] : sides) {
        if (of[0] && of[1] && of[2] && of[3]) found.insert(key);
    }
    return found;
}

Guess by_name(const TracedLine& line) {
    const std::string_view by = line.ruled ? std::string_view() : kByName;
    switch (line.named) {
        case Named::nothing:
        case Named::cut:
            return {Meaning::cut, by};
        case Named::fold:
            return {Meaning::fold, by};
        case Named::mountain:
            return {Meaning::mountain, by};
        case Named::valley:
            return {Meaning::valley, by};
        case Named::hole:
            return {Meaning::hole, by};
        case Named::print:
            return {Meaning::print, by};
        case Named::ignore:
            return {Meaning::ignore, by};
    }
    return {};
}

// Of a sheet that this program made.
Guess by_layer(Use use) {
    switch (use) {
        case Use::mountain:
            return {Meaning::mountain, {}};
        case Use::valley:
            return {Meaning::valley, {}};
        case Use::cut:
            return {Meaning::cut, {}};
        case Use::seam:
        case Use::shape:
        case Use::print:
            return {Meaning::ignore, {}};
    }
    return {};
}

// True of the notation `workshop`, in which this program draws sheets: only there valleys are dashed magenta.
bool is_workshop(const Tracing& tracing) {
    return std::any_of(tracing.lines.begin(), tracing.lines.end(), [](const TracedLine& line) {
        return line.use != Use::shape && line.dash != Dash::none && hue_of(line.color) == Hue::magenta;
    });
}

Guess by_stroke(const TracedLine& line, bool workshop) {
    constexpr std::string_view kColor = "by their colour";
    constexpr std::string_view kDashes = "by their dashes";
    const bool broken = line.dash != Dash::none;
    if (workshop && broken && hue_of(line.color) == Hue::magenta) return {Meaning::valley, kColor};
    if (workshop && broken && hue_of(line.color) == Hue::blue) return {Meaning::mountain, kColor};
    switch (hue_of(line.color)) {
        case Hue::red:
            return {Meaning::mountain, kColor};
        case Hue::blue:
            return {Meaning::valley, kColor};
        case Hue::magenta:
            return {Meaning::fold, kColor};
        case Hue::yellow:
            return {Meaning::ignore, kColor};
        case Hue::dark:
        case Hue::green:
        case Hue::other:
            if (line.dash == Dash::mixed) return {Meaning::mountain, kDashes};
            if (broken) return {Meaning::fold, kDashes};
            return {Meaning::cut, {}};
    }
    return {};
}

// For a hint: what lines are that are not what was guessed.
std::string_view other_than(Meaning meaning) { return meaning == Meaning::cut ? "fold" : "cut"; }

class Sorter {
 public:
    Sorter(const Tracing& tracing, Diagnostics& diagnostics)
        : tracing_(tracing),
          diagnostics_(diagnostics),
          frame_(frame_strokes(tracing)),
          workshop_(is_workshop(tracing)) {}

    CardLines run() {
        for (const TracedLine& line : tracing_.lines) {
            if (line.use == Use::shape) continue;
            const Guess guess = guess_of(line);
            take(line, guess.meaning);
            if (!guess.by.empty()) count(line, guess);
        }
        // Fills are outlines where nothing else is cut.
        if (out_.lines.empty()) {
            for (const TracedLine& line : tracing_.lines) {
                if (line.use == Use::shape) take(line, Meaning::cut);
            }
        }
        tell();
        return std::move(out_);
    }

 private:
    struct Row {
        const TracedLine* first = nullptr;
        Guess guess;
        int count = 0;
    };

    [[nodiscard]] Guess guess_of(const TracedLine& line) const {
        if (line.ruled) return by_name(line);
        if (line.owner > 0) return by_layer(line.use);
        if (line.named != Named::nothing) return by_name(line);
        if (frame_.find(key_of(line)) != frame_.end()) return {Meaning::cut, {}};
        return by_stroke(line, workshop_);
    }

    void take(const TracedLine& line, Meaning meaning) {
        constexpr std::array<unsigned, 5> kInks{kCut, kMountain, kValley, kFold, kCutOut};
        if (meaning == Meaning::print) out_.printed.push_back(&line);
        if (meaning == Meaning::print || meaning == Meaning::ignore) return;
        out_.lines.push_back({line.points, line.closed, nth(kInks, meaning), line.element});
        out_.drawn_by.push_back(&line);
    }

    void count(const TracedLine& line, const Guess& guess) {
        const auto key = std::tuple(key_of(line), guess.meaning, guess.by, line.perforated);
        const auto [at, fresh] = row_of_.try_emplace(key, rows_.size());
        if (fresh) rows_.push_back({&line, guess, 0});
        ++rows_[at->second].count;
    }

    void tell() {
        for (const Row& row : rows_) {
            Diagnostic& told = diagnostics_.remark(
                "line-meaning", nth(tracing_.elements, row.first->element).place,
                fmt::format("{} {} line{} taken for {}, {}{}", row.count, shown_stroke(*row.first),
                            row.count == 1 ? " is" : "s are", nth(kMeanings, row.guess.meaning), row.guess.by,
                            row.first->perforated ? ", which is that of a perforation" : ""));
            if (row.first->perforated) {
                told.hint(
                    "where it is torn and not folded it is no fold: --lines print=NAME prints it, and "
                    "--lines cut=NAME cuts it through; --fold-style perforated perforates folds");
                continue;
            }
            told.hint(row.guess.by == kByName
                          ? fmt::format("--lines says otherwise: --lines {}=NAME, of a layer, class or id",
                                        other_than(row.guess.meaning))
                          : fmt::format("--lines says otherwise: --lines {}={}",
                                        other_than(row.guess.meaning), to_string(row.first->color)));
        }
    }

    const Tracing& tracing_;
    Diagnostics& diagnostics_;
    std::set<StrokeKey> frame_;
    bool workshop_;
    std::vector<Row> rows_;
    std::map<std::tuple<StrokeKey, Meaning, std::string_view, bool>, std::size_t> row_of_;
    CardLines out_;
};

}  // namespace

CardLines card_lines(const Tracing& tracing, Diagnostics& diagnostics) {
    return Sorter(tracing, diagnostics).run();
}

std::optional<SheetGraph> join_ends(const Tracing& tracing, std::vector<SheetLine>& lines,
                                    std::vector<Segment>& moves, Diagnostics& diagnostics) {
    std::vector<MovedEnd> moved;
    std::optional<SheetGraph> graph = mend_ends(lines, {.gathers_folds = true}, moved);
    if (!graph) {
        diagnostics.error("document-too-large", {},
                          "the lines of the drawing cross one another too often to be looked at");
        return std::nullopt;
    }
    for (const MovedEnd& end : moved) {
        moves.push_back({end.from, end.to});
        const double size = distance(end.from, end.to);
        if (size <= kSilentMm) continue;
        const SheetLine& line = nth(lines, end.line);
        diagnostics
            .warning(
                "end-moved", nth(tracing.elements, line.element).place,
                fmt::format("the end of this {} misses what it meets by {:.2f} mm at {}; it was moved there",
                            (line.ink & kAnyFold) != 0 ? "fold" : "cut", size,
                            shown_point(tracing.ruler, end.to)))
            .hint("let ends snap to the lines that they meet in the drawing program")
            .changed(shown_point(tracing.ruler, end.from), shown_point(tracing.ruler, end.to));
    }
    return graph;
}

std::vector<SheetLine> without(const std::vector<SheetLine>& lines, const SheetGraph& graph,
                               const std::vector<int>& edges) {
    const std::set<int> left_out(edges.begin(), edges.end());
    // Of what is drawn twice, edges name one line.
    const auto draws = [&](const SheetLine& line, int edge) {
        const Segment s = graph.segment(2 * edge);
        for (std::size_t i = 0; i + 1 < line.points.size(); ++i) {
            if (distance(0.5 * (s.a + s.b), Segment{line.points[i], line.points[i + 1]}) <= kOnePointMm)
                return true;
        }
        return false;
    };
    std::vector<SheetLine> made;
    for (const SheetLine& line : lines) {
        const bool breaks =
            (line.ink & kAnyFold) != 0 &&
            std::any_of(edges.begin(), edges.end(), [&](int edge) { return draws(line, edge); });
        if (!breaks) {
            made.push_back(line);
            continue;
        }
        for (std::size_t i = 0; i < graph.edges.size(); ++i) {
            const GraphEdge& edge = graph.edges[i];
            const int number = static_cast<int>(i);
            if ((edge.ink & line.ink) == 0 || left_out.contains(number) || !draws(line, number)) continue;
            made.push_back({{graph.at(edge.a), graph.at(edge.b)}, false, line.ink, line.element});
        }
    }
    return made;
}

}  // namespace popup::drawing::card
