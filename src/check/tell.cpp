// What check() says of elements that cannot be made as they are drawn: where their fold is, what explains it,
// and who stands in the way.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/geometry/hull.h"
#include "check/checker.h"
#include "check/exchange.h"
#include "check/named_place.h"
#include "mechanism/site_lines.h"

namespace popup {
namespace {

constexpr std::size_t kNamedPages = 3;       // of more, none is likely
constexpr std::size_t kNamedNeighbours = 3;  // more in the way are not named

bool same_place(const Structure& a, const Structure& b) {
    const auto same = [](const DesignPoint& p, const DesignPoint& q) {
        return p.at.x == q.at.x && p.at.y == q.at.y && p.page == q.page;
    };
    return a.ground_page() == b.ground_page() && a.named().text == b.named().text &&
           std::equal(a.points.begin(), a.points.end(), b.points.begin(), b.points.end(), same);
}

// Whether a line where there is no fold lies as one that an element on `fold` would make: along it, beside a
// part of it. A line nearly as long as the whole fold is a slip in its points rather.
bool lies_where_a_fold_was(const Fold& fold, int page, Vec2 begin, Vec2 end, double snap_mm) {
    constexpr double kAlong = 0.02;  // the sine of the angle between them
    constexpr double kMostOfIt = 0.75;
    const Segment& line = page == fold.left_page ? fold.on_left : fold.on_right;
    const double long_mm = distance(line.a, line.b);
    const double given_mm = distance(begin, end);
    if (given_mm == 0.0 || given_mm > kMostOfIt * long_mm) return false;
    const Vec2 along = unit(line.b - line.a);
    if (std::abs(cross(along, end - begin)) > kAlong * given_mm) return false;
    const double one = dot(along, begin - line.a);
    const double other = dot(along, end - line.a);
    return std::min(one, other) > -snap_mm && std::max(one, other) < long_mm + snap_mm;
}

}  // namespace

std::size_t hash_of_points(const Structure& structure) {
    std::size_t hash = 0;
    const auto mix = [&](double value) {
        hash = hash * 1099511628211U + std::hash<double>{}(value);  // the prime of FNV-1a
    };
    for (const DesignPoint& point : structure.points) {
        mix(point.at.x);
        mix(point.at.y);
    }
    return hash;
}

void Checker::no_fold(const Structure& structure, const Placing& placing, const FoldMatch* dead) {
    if (dead != nullptr) {
        const Fold& fold = fold_of(*dead);
        Placing there = placing;
        there.look_along(*dead, fold);
        const double middle = middle_on(there, fold);
        const CutSpan* cut = fold.cut_within(middle - 1e-6, middle + 1e-6);
        const std::string& by = cut != nullptr ? cut->by : fold.owner;
        diagnostics
            .error("fold-cut-away", structure.fold.place,
                   fmt::format("where \"{}\" stands, its parent fold has been cut away by \"{}\"",
                               structure.id, by))
            .hint(fmt::format(
                "stand it on a fold of \"{0}\", or move it along the fold{1}", by,
                placing.element.info->glued
                    ? fmt::format("; to stand over the hole, it comes before \"{}\" in the document", by)
                    : ""))
            .about(structure.id);
        return;
    }
    if (structure.named().given()) {
        const Fold& fold = fold_of(*named_fold(structure));
        const auto [lo, hi] = element_row(*placing.element.info).stands_on(placing.element);
        const double over = std::max(-std::max(lo, hi), std::min(lo, hi) - fold.length());
        diagnostics
            .error("fold-not-found", structure.fold.place,
                   fmt::format("\"{}\" lies {} beyond the end of {}, which is {} long", structure.id,
                               mm(over), structure.named().text, mm(fold.length())))
            .hint("y of its points is measured along the fold from its middle")
            .about(structure.id);
        return;
    }
    if (beyond_its_fold(structure, placing)) return;
    const std::vector<int> elsewhere = pages_with_its_fold(structure, placing);
    std::string nearest = "there is no fold within 500 mm of it";
    if (const auto near = index.nearest(structure.fold.page, placing.begin, placing.end, 500.0)) {
        const Fold& fold = near->ghost ? ghosts[static_cast<std::size_t>(near->fold)]
                                       : skeleton->folds[static_cast<std::size_t>(near->fold)];
        if (elsewhere.empty() && lies_where_a_fold_was(fold, structure.fold.page, placing.begin, placing.end,
                                                       options.tolerances.snap_mm)) {
            const std::string on = fold.owner == "page"
                                       ? "gutter"
                                       : fmt::format("{} of \"{}\"", fold.seam ? "seam" : "fold", fold.owner);
            diagnostics
                .error(
                    "fold-not-found", structure.fold.place,
                    fmt::format("the fold that \"{}\" stood on is gone: on page {} there is none within {} "
                                "of the line from {} to {}; most likely an element on the {} "
                                "made it, {} from there and {} long",
                                structure.id, structure.fold.page, mm(options.tolerances.snap_mm),
                                placing.text(placing.begin), placing.text(placing.end), on,
                                mm(near->distance), mm(distance(placing.begin, placing.end))))
                .hint(fmt::format("put that element back before \"{}\", take \"{}\" out too, or give two "
                                  "points of another fold or seam",
                                  structure.id, structure.id))
                .about(structure.id);
            return;
        }
        nearest = fmt::format("the nearest is a {} of \"{}\", {} away", fold.seam ? "seam" : "fold",
                              fold.owner, mm(near->distance));
    }
    Diagnostic& made = diagnostics.error(
        "fold-not-found", structure.fold.place,
        fmt::format("there is no fold where \"{}\" should stand, on page {} within {} of the line "
                    "from {} to {}; {}",
                    structure.id, structure.fold.page, mm(options.tolerances.snap_mm),
                    placing.text(placing.begin), placing.text(placing.end), nearest));
    for (const int page : elsewhere) {
        made.hint(fmt::format(
            "page {0} has such a fold; if that is meant, write page=\"{0}\" (a glued element that is "
            "added before changes the numbers of pages)",
            page_word(page)));
    }
    made.hint("give two points of a fold or seam that an earlier structure, or the page, makes")
        .about(structure.id);
}

// The line that it names is a fold, but the element lies beyond an end of it; then that is said.
bool Checker::beyond_its_fold(const Structure& structure, const Placing& placing) {
    Box named;
    named.extend(placing.begin);
    named.extend(placing.end);
    for (const FoldMatch& match :
         index.matches(structure.fold.page, placing.begin, placing.end, named, options.tolerances.snap_mm)) {
        const Fold& fold = fold_of(match);
        Placing there = placing;
        there.look_along(match, fold);
        const auto [lo, hi] = element_row(*placing.element.info).stands_on(there.element);
        const double over = std::max(-std::max(lo, hi), std::min(lo, hi) - fold.length());
        if (!(over > 0.0)) continue;
        if (points_are_exchanged(structure, placing, &match)) return true;
        diagnostics
            .error("fold-not-found", structure.fold.place,
                   fmt::format(
                       "\"{}\" lies {} beyond the end of the {} of \"{}\" that its parent fold names, "
                       "which is {} long",
                       structure.id, mm(over), fold.seam ? "seam" : "fold", fold.owner, mm(fold.length())))
            .hint("move it along the fold until it lies beside it, or name another fold")
            .about(structure.id);
        return true;
    }
    return false;
}

// True when the structure, were its points as they are here, could be made on this ground (a fold, unless it
// stands on a plate or page), and no point would have to move for it. Nothing is reported, and nothing made.
bool Checker::needs_no_repair(const Structure& trial, const Placing& of, const FoldMatch* match) {
    Structure structure = trial;
    const ElementInfo& info = *of.element.info;
    const PageTurns turns{skeleton->page_mirrored, redrawn};
    std::optional<NamedPlace> place;
    if (structure.named().given()) {
        place.emplace(structure, info, *beside(structure), turns);
        place->lay(structure);
    }
    Placing placing(design, structure, info, of.element.extra_page, turns);
    if (place) placing.beside = &*place;
    Element& element = placing.element;
    element.tolerances = &options.tolerances;
    const PaperQuery query = query_of(element);
    element.paper = &query;
    bool good = true;
    element.failed = [&](std::string_view, const std::string&, const std::string&) { good = false; };
    element.repaired = [&](std::string_view code, const std::string&, const std::string&) {
        good = good && (code == "fold-snapped" || code == "moved-with-fold");
    };
    element.warned = element.remarked = [](std::string_view, const std::string&, const std::string&) {};
    Diagnostics unheard(diagnostics.file());
    if (structure.plate) {
        const auto plate = plate_of(structure, placing);
        if (!plate) return false;
        placing.look_on(*plate);
        good = placing.settle(*plate, owner_of(plate->plate), options.tolerances, unheard) && good;
    } else if (match == nullptr) {
        placing.look_on_page();
        good = placing.settle_on_page(unheard) && good;
    } else {
        const Fold& fold = fold_of(*match);
        if (match->ghost || look(placing, *match, options.tolerances.rounding_mm) != Foothold::stands)
            return false;
        good = placing.settle(*match, fold, options.tolerances, unheard) && good;
    }
    return good && element_row(info).constrain(element) && good;
}

// When exchanged points explain why the element cannot be made, says so, and is true.
bool Checker::points_are_exchanged(const Structure& structure, const Placing& placing,
                                   const FoldMatch* match) {
    const ElementInfo& info = *placing.element.info;
    const auto exchanges =
        exchanges_that_help(info, authored.structures[current], [&](const Structure& trial) {
            if (trials_left == 0) return false;
            --trials_left;
            return needs_no_repair(trial, placing, match);
        });
    if (exchanges.empty()) return false;
    diagnostics
        .error("points-exchanged", structure.place,
               fmt::format("\"{}\": points of this {} are exchanged, so it cannot be made", structure.id,
                           info.family))
        .hint(fmt::format("exchange {}; then no point has to move", to_text(exchanges, info)))
        .about(structure.id);
    return true;
}

// What is said of it besides its numbers: whose fold it stands on, and who has taken the paper there.
std::string Checker::neighbours(const Placing& placing, std::vector<Related>& related) const {
    const Element drawn = placing.authored_element();
    const Site& site = drawn.site;
    std::string text;
    std::string owner;
    if (placing.found) owner = fold_of(*placing.found).owner;
    if (placing.found && placing.found->fold != 0) text = fmt::format("it stands on a fold of \"{}\"", owner);
    std::vector<int> owners;
    const auto [lo, hi] = element_row(*drawn.info).stands_on(drawn);
    for (const Side side : {Side::left, Side::right}) {
        if (drawn.on.empty() || !std::isfinite(lo) || !std::isfinite(hi)) break;
        std::vector<Vec2> corners;
        if (!site.on_plate) corners = {site.on_page(side, {lo, 0.0}), site.on_page(side, {hi, 0.0})};
        for (std::size_t i = 0, on = 0; i < drawn.info->points.size(); ++i) {
            const PointInfo& point = drawn.info->points[i];
            if (point.page == PointPage::extra) continue;
            if (point.side == '-' || (point.side == 'L') == (side == Side::left))
                corners.push_back(site.on_page(side, drawn.on[on]));
            ++on;
        }
        paper.owners_near(side == Side::left ? site.left_page : site.right_page, convex_hull(corners),
                          owners);
    }
    std::sort(owners.begin(), owners.end());
    owners.erase(std::unique(owners.begin(), owners.end()), owners.end());
    std::string others;
    for (const int number : owners) {
        if (number < 0) continue;  // the page itself
        const Structure& other = design.structures[static_cast<std::size_t>(number)];
        if (other.id == owner || related.size() >= kNamedNeighbours) continue;
        others += fmt::format("{}\"{}\"", others.empty() ? "" : " and ", other.id);
        related.push_back({other.place, fmt::format("\"{}\"", other.id)});
    }
    if (!others.empty()) {
        text += fmt::format("{}{} {} in its way", text.empty() ? "" : "; ", others,
                            related.size() > 1 ? "are" : "is");
    }
    return text.empty() ? text : fmt::format(" ({})", text);
}

// What a document would write for a page: in version 3.0 the id of the element whose piece it is.
std::string Checker::page_word(int page) const {
    int number = 0;
    for (const Structure& structure : design.structures) {
        const ElementInfo* info = structure.dropped ? nullptr : find_element(structure.type);
        if (info == nullptr || !info->glued || ++number != page) continue;
        if (structure.id_given && design.version >= "3.0") return structure.id;
    }
    return fmt::format("{}", page);
}

// Other pages that have exactly this fold, on which it would keep its form; none where there are many.
std::vector<int> Checker::pages_with_its_fold(const Structure& structure, const Placing& placing) {
    std::vector<int> found;
    // Only who writes a document writes pages: programs and drawings have folds.
    const bool writes_page = structure.start_tag.present() && !structure.named().given();
    if (structure.plate || structure.finds_ground || !writes_page) return found;
    const ElementInfo& info = *placing.element.info;
    for (int page = 0; page < pages - (info.glued ? 1 : 0); ++page) {
        if (page == structure.fold.page) continue;
        if (page_looks_left == 0) return {};
        --page_looks_left;
        for (const FoldMatch& match : index.matches(page, placing.begin, placing.end, placing.place_on_line(),
                                                    options.tolerances.rounding_mm)) {
            if (match.ghost) continue;
            const bool mountain = fold_of(match).closed_deg == 360;
            if (!info.glued && has_inverse(info) && mountain != info.inverted) continue;
            Placing there = placing;
            if (look(there, match, options.tolerances.rounding_mm) != Foothold::stands) continue;
            if (found.size() == kNamedPages) return {};
            found.push_back(page);
            break;
        }
    }
    return found;
}

// An earlier structure of which this is a copy that was not moved: same kind, same points, same ground. Only
// of what is cut from its page, where two cannot be in one place.
const Structure* Checker::original_of(const Structure& structure) const {
    const auto [first, last] = same_points.equal_range(hash_of_points(authored.structures[current]));
    for (auto it = first; it != last; ++it) {
        const Structure& other = authored.structures[it->second];
        if (it->second < current && find_element(structure.type) == find_element(other.type) &&
            same_place(authored.structures[current], other))
            return &other;
    }
    return nullptr;
}

// Tells what was found while an element was made. What explains the rest is told alone: exchanged points, or
// that it lies on its original.
void Checker::tell(const Structure& structure, const Placing& placing, std::vector<Told> findings,
                   bool failed) {
    if (findings.empty()) return;
    const ElementInfo& info = *placing.element.info;
    // What merely finds no room may find it the other way round by chance.
    const bool misshapen = failed && findings.back().code != "does-not-fit";
    if (const Structure* original = info.glued ? nullptr : original_of(structure)) {
        diagnostics
            .add(failed ? Severity::error : Severity::warning, "copy-on-original", structure.place,
                 fmt::format(
                     "\"{0}\" has the same points as \"{1}\", so it stands on \"{1}\" and not on the page",
                     structure.id, original->id))
            .hint("move it along the fold, or delete it")
            .about(structure.id)
            .with(original->place, fmt::format("\"{}\"", original->id));
        if (failed) return;
    } else if (misshapen &&
               points_are_exchanged(structure, placing, placing.found ? &*placing.found : nullptr)) {
        return;
    }
    for (Told& told : findings) {
        std::vector<Related> related;
        if (told.code == "does-not-fit" || told.code == "wrong-form")
            told.what += neighbours(placing, related);
        Diagnostic& made = diagnostics.add(told.severity, told.code, structure.place,
                                           fmt::format("\"{}\": {}", structure.id, told.what));
        if (told.code == "wrong-form" || told.code == "fold-snapped") {
            for (const int page : pages_with_its_fold(structure, placing)) {
                made.hint(fmt::format("page {0} has exactly this fold; if that is meant, write page=\"{0}\"",
                                      page_word(page)));
            }
        }
        made.hint(told.hint).about(structure.id);
        if (told.change) made.changed(told.change->before, told.change->after);
        made.related = std::move(related);
    }
}

}  // namespace popup
