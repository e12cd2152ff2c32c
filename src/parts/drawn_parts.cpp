#include "parts/drawn_parts.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "parts/joining.h"
#include "parts/part_maker.h"

namespace popup::drawing {
namespace {

// Of equal names the second becomes "name~2"; those that are missing are numbers. A name that a part really
// has is never given to another.
void name_parts(std::vector<FlatPart>& parts) {
    std::set<std::string> taken;
    for (const FlatPart& part : parts) taken.insert(part.name);
    std::set<std::string> given;
    std::map<std::string, int> last;
    const auto fresh = [&](const std::string& name) {
        int& number = last.try_emplace(name, 1).first->second;
        std::string made;
        do {
            made = fmt::format("{}~{}", name, ++number);
        } while (!taken.insert(made).second);
        return made;
    };
    for (std::size_t i = 0; i < parts.size(); ++i) {
        std::string& name = parts[i].name;
        if (name.empty()) {
            name = fmt::format("part-{}", i + 1);
            if (!taken.insert(name).second) name = fresh(name);
        } else if (!given.insert(name).second) {
            name = fresh(name);
        }
    }
}

// The two ends of open lines that are nearest to each other without being one; nothing for very many lines.
struct Gap {
    double width = HUGE_VAL;
    Vec2 at;
};
Gap narrowest_gap(const Tracing& tracing) {
    constexpr std::size_t kMostEnds = 2000;
    std::vector<Vec2> ends;
    for (const TracedLine& line : tracing.lines) {
        if (line.closed) continue;
        ends.push_back(line.points.front());
        ends.push_back(line.points.back());
    }
    Gap gap;
    if (ends.size() > kMostEnds) return gap;
    for (std::size_t i = 0; i < ends.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            const double width = distance(ends[i], ends[j]);
            if (width > kJoinMm && width < gap.width) gap = {width, ends[i]};
        }
    }
    return gap;
}

void tell_empty(const Tracing& tracing, Diagnostics& diagnostics) {
    std::size_t open = 0;
    for (const TracedLine& line : tracing.lines) open += line.closed ? 0U : 1U;
    Diagnostic& told =
        diagnostics.error("no-contours", {}, "the drawing has no closed contour, so there is no part to cut");
    if (open > 0) {
        told.hint(fmt::format("{} open line{} not close: ends must be within {} mm of each other", open,
                              open == 1 ? " does" : "s do", kJoinMm));
        const Gap gap = narrowest_gap(tracing);
        if (gap.width < HUGE_VAL) {
            told.hint(fmt::format("the narrowest gap is {:.2f} mm wide, at {}", gap.width,
                                  shown_point(tracing.ruler, gap.at)));
        }
    }
    if (tracing.invisible > 0) {
        told.hint(fmt::format("{} shape{} neither a stroke nor a fill that can be seen", tracing.invisible,
                              tracing.invisible == 1 ? " has" : "s have"));
    }
}

}  // namespace

std::optional<FlatParts> make_parts(const Tracing& tracing, Diagnostics& diagnostics) {
    const auto at = [](int owner) { return static_cast<std::size_t>(owner); };
    std::vector<OwnedLines> owners(tracing.owners.size());
    for (const TracedLine& line : tracing.lines) owners[at(line.owner)].lines.push_back(&line);
    for (const TracedFill& fill : tracing.fills) owners[at(fill.owner)].fills.push_back(&fill);
    for (const TracedText& text : tracing.texts) owners[at(text.owner)].texts.push_back(&text);
    Work work;
    FlatParts list;
    list.curves = tracing.curves;
    std::vector<Segment> moves;
    for (std::size_t i = 0; i < owners.size(); ++i) {
        std::vector<FlatPart> parts =
            make_parts_of(tracing, static_cast<int>(i), owners[i], work, moves, diagnostics);
        list.parts.insert(list.parts.end(), std::make_move_iterator(parts.begin()),
                          std::make_move_iterator(parts.end()));
    }
    if (diagnostics.has_errors_as_given()) return std::nullopt;
    if (list.parts.empty()) {
        tell_empty(tracing, diagnostics);
        return std::nullopt;
    }
    list.curves.move(moves);
    name_parts(list.parts);
    return list;
}

}  // namespace popup::drawing
