#include "check/pierce.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

#include "base/geometry/regions.h"
#include "base/nth.h"
#include "mechanism/site_lines.h"
#include "mechanism/thin_places.h"

namespace popup {
namespace {

// Parts smaller than this are rounding.
constexpr double kSpeckMm2 = 1e-3;

std::string name_of(const Sheet& sheet, int plate) { return nth(sheet.skeleton.draft.plates, plate).name; }

double furthest(const std::vector<Polygon>& what, const std::vector<Polygon>& from) {
    double most = 0.0;
    for (const Polygon& part : what) {
        for (const Vec2 p : part.outer) {
            double off = HUGE_VAL;
            for (const Polygon& other : from) {
                if (contains(other, p)) off = 0.0;
                for (const Segment& edge : edges_of(other)) off = std::min(off, distance(p, edge));
            }
            if (std::isfinite(off)) most = std::max(most, off);
        }
    }
    return most;
}

Pierced refused(std::string_view code, std::string what, std::string hint) {
    Pierced made;
    made.code = code;
    made.what = std::move(what);
    made.hint = std::move(hint);
    return made;
}

// The stretches of the fold inside of the area that are still there.
std::vector<Pierced::Span> lost_of(const Fold& fold, int number, const Polygon& area) {
    std::vector<Pierced::Span> lost;
    const auto inside = clip_line({fold.on_left.a, fold.on_left.b}, area);
    for (const std::vector<Vec2>& part : inside) {
        double from = distance(fold.on_left.a, part.front());
        const double to = distance(fold.on_left.a, part.back());
        const auto add = [&](double lo, double hi) {
            if (hi - lo > kGridMm) lost.push_back({number, lo, hi});
        };
        for (const auto& [begin, span] : fold.gone) {
            if (span.end <= from || begin >= to) continue;
            add(from, std::min(begin, to));
            from = std::max(from, span.end);
        }
        add(from, to);
    }
    return lost;
}

// The longest stretch of the fold that stays.
double longest_left(const Fold& fold, const std::vector<Pierced::Span>& lost) {
    std::vector<std::pair<double, double>> gone;
    for (const auto& [begin, span] : fold.gone) gone.emplace_back(begin, span.end);
    for (const Pierced::Span& one : lost) gone.emplace_back(one.from, one.to);
    std::sort(gone.begin(), gone.end());
    double most = 0.0;
    double at = 0.0;
    for (const auto& [begin, end] : gone) {
        most = std::max(most, begin - at);
        at = std::max(at, end);
    }
    return std::max(most, fold.length() - at);
}

// The fault of a hole that leaves the plates, or comes nearer than `around` mm to where they end; nullopt:
// none.
std::optional<Pierced> leaves_page(const Sheet& sheet, const std::vector<int>& plates, const Ring& ring,
                                   double around) {
    std::vector<Polygon> sheets;
    sheets.reserve(plates.size());
    for (const int plate : plates) sheets.push_back(nth(sheet.skeleton.draft.plates, plate).outline);
    sheets = unite(sheets);
    const std::vector<Polygon> hole{{ring, {}}};
    if (const auto out = subtract(hole, sheets); area(out) > kSpeckMm2) {
        return refused("does-not-fit", fmt::format("it leaves the page by {}", mm(furthest(out, sheets))),
                       "draw it on the page; what opens to an edge of the page cannot be a hole");
    }
    if (area(subtract(offset(hole, around, Corners::rounded), sheets)) > kSpeckMm2) {
        return refused(
            "does-not-fit",
            fmt::format("it comes nearer than {} to an edge of the page", mm(sheet.tolerances.paper_mm)),
            "move it away from the edge, or make it smaller");
    }
    return std::nullopt;
}

// What is left of the paper, specks aside.
std::vector<Polygon> left_of(const std::vector<Polygon>& paper, const std::vector<Polygon>& hole) {
    std::vector<Polygon> left = subtract(paper, hole);
    std::erase_if(left, [](const Polygon& part) { return area(part) <= kSpeckMm2; });
    return left;
}

// True if the paper just round the hole is one part, and still is one without the hole: what was joined
// through there stays joined, and no plate comes apart. False proves nothing.
bool stays_whole_near(const std::vector<Polygon>& near, const std::vector<Polygon>& reach) {
    const auto parts =
        std::count_if(near.begin(), near.end(), [](const Polygon& part) { return area(part) > kSpeckMm2; });
    return parts == 1 && left_of(near, reach).size() == 1;
}

// The fault of a hole that cuts a plate into parts, or leaves nothing of it; nullopt: none. `reach`: the hole
// with half of kTouchMm around it. Adds the plates that lose paper to `made`.
std::optional<Pierced> leaves_parts(const Sheet& sheet, const std::vector<int>& plates, int page,
                                    const Ring& ring, const std::vector<Polygon>& reach, Pierced& made) {
    constexpr std::string_view kHint = "make it smaller, so that every part of the card stays in one piece";
    constexpr double kRoundHoleMm = 10.0 * kTouchMm;
    const std::vector<Polygon> hole{{ring, {}}};
    const Box box = bounds(ring);
    const Vec2 low = box.min - Vec2{kRoundHoleMm, kRoundHoleMm};
    const Vec2 high = box.max + Vec2{kRoundHoleMm, kRoundHoleMm};
    const std::vector<Polygon> window{{{low, {high.x, low.y}, high, {low.x, high.y}}, {}}};
    for (const int plate : plates) {
        const std::vector<Polygon> near =
            intersect(sheet.paper.paper_near(plate, page, 0.0, {low, high}), window);
        if (area(intersect(near, hole)) <= kSpeckMm2) continue;
        made.plates.push_back(plate);
        if (stays_whole_near(near, reach)) continue;
        const auto fault = [&](std::string what) {
            return refused("hole-off-piece", std::move(what), std::string(kHint));
        };
        const std::vector<Polygon> paper = paper_of(sheet.skeleton, plate, 0.0);
        const std::size_t parts = left_of(paper, hole).size();
        if (parts > 1)
            return fault(fmt::format("it cuts \"{}\" into {} parts", name_of(sheet, plate), parts));
        const std::size_t held = left_of(paper, reach).size();
        if (held == 1) continue;
        if (held == 0) return fault(fmt::format("it leaves nothing of \"{}\"", name_of(sheet, plate)));
        return fault(fmt::format("it leaves two parts of \"{}\" that hang together by less than {}",
                                 name_of(sheet, plate), mm(kTouchMm)));
    }
    return std::nullopt;
}

}  // namespace

Pierced pierce(const Sheet& sheet, int page, const Ring& ring) {
    const double around = sheet.tolerances.paper_mm - sheet.tolerances.rounding_mm;
    Box box = bounds(ring);
    box.min = box.min - Vec2{around, around};
    box.max = box.max + Vec2{around, around};
    const std::vector<int> plates = sheet.plates.in(page, box);
    // Most holes have nothing but paper round them, of one plate: that takes no look at all the others.
    const Vec2 at = ring.front();
    const Vec2 margin{std::max(around, kTearsMm), std::max(around, kTearsMm)};
    const Box wide{bounds(ring).min - margin, bounds(ring).max + margin};
    const bool alone = std::abs(signed_area(ring)) > kSpeckMm2 && sheet.paper.is_clear(page, wide) &&
                       std::any_of(plates.begin(), plates.end(), [&](int plate) {
                           return contains(nth(sheet.skeleton.draft.plates, plate).outline, at);
                       });
    if (!alone) {
        if (auto fault = leaves_page(sheet, plates, ring, around)) return std::move(*fault);
    }
    const std::vector<Polygon> hole{{ring, {}}};
    // The border of an area may be far away: what lies inside of it is found by the area itself.
    for (const int number : sheet.paper.glued_near(page, bounds(ring))) {
        const GluedArea& glued = nth(sheet.skeleton.draft.glued_areas, number);
        const std::vector<Polygon> lost = intersect(glued.on_base, hole);
        const double lost_mm2 = area(lost);
        if (lost_mm2 <= kSpeckMm2) continue;
        return refused(
            "does-not-fit",
            fmt::format("it would cut {:.2f} mm² out of the {:.2f} mm² that \"{}\" is glued to, at {}",
                        lost_mm2, area(glued.on_base), glued.element,
                        at_mm(bounds(lost.front().outer).centre())),
            "move it off what is glued to the page, or list it before that, which then keeps off "
            "the hole");
    }
    if (sheet.paper.seam_near(page, ring)) {
        return refused("does-not-fit", "a seam or a glued area lies where it would be cut",
                       "move it off what is glued to the page");
    }
    Pierced made;
    // Paper narrower than kTouchMm holds nothing: half of that is taken from it on either side.
    const std::vector<Polygon> reach = offset(hole, 0.5 * kTouchMm, Corners::rounded);
    if (alone) {
        if (area(reach) + kSpeckMm2 < std::abs(signed_area(reach.front().outer))) {
            return refused("hole-off-piece",
                           fmt::format("it surrounds paper that is held by less than {}", mm(kTouchMm)),
                           "cut that paper out as well, or leave it a wider bridge");
        }
        std::copy_if(plates.begin(), plates.end(), std::back_inserter(made.plates),
                     [&](int plate) { return sheet.paper.has_paper(plate, page, at); });
    } else {
        if (auto fault = leaves_parts(sheet, plates, page, ring, reach, made)) return std::move(*fault);
        made.narrow = sheet.paper.narrow_beside_hole(page, ring, kTearsMm);
        // A third hole may have taken what was between the two.
        if (made.narrow && std::none_of(plates.begin(), plates.end(), [&](int plate) {
                return sheet.paper.has_paper(plate, page, made.narrow->at);
            }))
            made.narrow.reset();
    }
    std::vector<int> seen;
    for (const FoldMatch& match : sheet.folds.crossed(page, box)) {
        if (match.ghost || std::find(seen.begin(), seen.end(), match.fold) != seen.end()) continue;
        seen.push_back(match.fold);
        const Fold& fold = nth(sheet.skeleton.folds, match.fold);
        if (fold.seam) continue;
        std::vector<Pierced::Span> near;
        for (const Polygon& one : reach) {
            const auto part = lost_of(fold, match.fold, one);
            near.insert(near.end(), part.begin(), part.end());
        }
        if (near.empty()) continue;
        if (const double left = longest_left(fold, near); left < sheet.tolerances.min_length_mm) {
            return refused("hole-off-piece",
                           fmt::format("it leaves {} of a fold of \"{}\" in one stretch; the least is {}",
                                       mm(left), fold.owner, mm(sheet.tolerances.min_length_mm)),
                           "make it smaller along the fold");
        }
        const std::vector<Pierced::Span> lost = lost_of(fold, match.fold, hole.front());
        made.folds.insert(made.folds.end(), lost.begin(), lost.end());
    }
    return made;
}

}  // namespace popup
