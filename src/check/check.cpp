// The walk over the build order: find the fold or plate, look along it, constrain, lower.
#include "popup/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>
#include <vector>

#include "base/geometry/regions.h"
#include "base/nth.h"
#include "check/checker.h"
#include "check/crossed.h"
#include "check/named_place.h"
#include "check/pierce.h"
#include "mechanism/site_lines.h"
#include "mechanism/spread_prints.h"

namespace popup {

namespace {

constexpr double kSpeckMm2 = 1e-3;

FoldLines lines_of(const ElementRow& row, const Element& element) { return row.fold_lines(element); }

bool finite(const FoldLines& lines) {
    return std::all_of(lines.begin(), lines.end(), [](const FoldLine& line) {
        const auto ok = [](Vec2 p) { return std::isfinite(p.x) && std::isfinite(p.y); };
        return ok(line.on_left.a) && ok(line.on_left.b) && ok(line.on_right.a) && ok(line.on_right.b);
    });
}

}  // namespace

// The middle of what an element covers of a fold that it is placed on, mm along it: there it has to be.
double Checker::middle_on(const Placing& placing, const Fold& fold) {
    const auto [lo, hi] = element_row(*placing.element.info).stands_on(placing.element);
    const double from = std::max(0.0, std::min(lo, hi));
    const double to = std::min(fold.length(), std::max(lo, hi));
    const double middle = std::clamp(0.5 * (from + to), 0.0, fold.length());
    return placing.element.site.reversed ? fold.length() - middle : middle;
}

// Looks along a fold, and says whether the element lies beside an end of it, by more than `slack` mm.
Checker::Foothold Checker::look(Placing& placing, const FoldMatch& match, double slack) const {
    const Fold& fold = fold_of(match);
    placing.look_along(match, fold);
    const auto [lo, hi] = element_row(*placing.element.info).stands_on(placing.element);
    const double from = std::max(0.0, std::min(lo, hi));
    const double to = std::min(fold.length(), std::max(lo, hi));
    if (!(from <= to + slack)) return Foothold::beside;  // or not a number
    if (match.ghost) return Foothold::stands;
    const auto alive = fold.alive_around(middle_on(placing, fold));
    if (!alive) return Foothold::cut_away;
    placing.stand_between(*alive, fold.length());
    return Foothold::stands;
}

// Where a line lies beside all folds, and is one that an element has made there before it was moved, what
// stands on it needs to follow, as a whole.
void Checker::follow(const Placing& placing, int page, std::vector<FoldMatch>& matches) const {
    constexpr double kFollowsMm = 50.0;
    if (!matches.empty() && matches.front().off <= options.tolerances.rounding_mm) return;
    const Element& element = placing.element;
    const auto suits = [&](int number) {
        const Fold& fold = skeleton->folds[static_cast<std::size_t>(number)];
        // Of a seam it is not known how it has moved on its other page.
        if (fold.seam || fold.owner == "page") return false;
        const bool any_form = element.info->glued || !has_inverse(*element.info);
        return any_form || element.inverted == (fold.closed_deg == 360);
    };
    const auto moved = index.moved_from(page, placing.begin, placing.end, kFollowsMm, suits);
    if (!moved) return;
    // One that is near, but another one, was meant rather than one that is far.
    if (!matches.empty() && matches.front().fold != moved->fold) return;
    FoldMatch match = *moved;
    match.follows_mm = std::exchange(match.off, 0.0);
    matches.assign(1, match);
}

std::optional<FoldMatch> Checker::find_fold(const Structure& structure, Placing& placing) {
    std::vector<FoldMatch> matches;
    if (structure.finds_ground) {
        const auto crossed = find_crossed({*skeleton, ghosts, index, design, options.tolerances}, structure,
                                          placing, diagnostics);
        if (!crossed || crossed->ghost) return crossed;
        matches.push_back(*crossed);
    } else if (structure.named().given()) {
        matches.push_back(*named_fold(structure));
    } else {
        matches = index.matches(structure.fold.page, placing.begin, placing.end, placing.place_on_line(),
                                options.tolerances.snap_mm);
        follow(placing, structure.fold.page, matches);
    }
    // A fold that the element stands on wins over one that it nearly reaches: neighbours often share a line.
    const FoldMatch* dead = nullptr;
    for (const double slack : {options.tolerances.rounding_mm, options.tolerances.snap_mm}) {
        for (const FoldMatch& match : matches) {
            const Foothold standing = look(placing, match, slack);
            if (standing == Foothold::beside) continue;
            placing.found = match;
            if (standing == Foothold::stands) return match;
            if (dead == nullptr) dead = &match;
        }
    }
    no_fold(structure, placing, dead);
    return std::nullopt;
}

bool Checker::may_stand(const Structure& structure, const Placing& placing) {
    const Site& site = placing.element.site;
    const Fold& fold = skeleton->folds[static_cast<std::size_t>(site.fold)];
    if (site.seam && !placing.element.info->grounds.seam) {
        diagnostics
            .error("cut-on-seam", structure.place,
                   fmt::format("\"{}\" ({}) would cut the glued seam of \"{}\" it stands on", structure.id,
                               placing.element.info->name, fold.owner))
            .hint("put a tent or a v-fold on the seam, or cut a fold instead")
            .about(structure.id);
        return false;
    }
    if (fold.closed_deg == 180) {
        diagnostics
            .error("seam-stays-flat", structure.place,
                   fmt::format("\"{}\" stands on a {} of \"{}\" that is flat (180°) when the card is "
                               "closed, so nothing on it can fold",
                               structure.id, fold.seam ? "seam" : "fold", fold.owner))
            .hint(fold.seam ? "only seams of v-folds and tents on valley folds, and of inverted v-folds on "
                              "mountain folds, open and close"
                            : "choose a fold that is folded when the card is closed")
            .about(structure.id);
        return false;
    }
    return true;
}

void Checker::keep_ghost(const Element& before) {
    const ElementInfo& info = *before.info;
    if (info.glued) plates.add_ghost_page(before.extra_page);
    const FoldLines lines = lines_of(element_row(info), before);
    if (!finite(lines)) return;
    made[current].ghost = static_cast<int>(ghosts.size());
    for (std::size_t i = 0; i < lines.size(); ++i) {
        Fold ghost;
        ghost.owner = before.paint.id;
        ghost.on_left = lines[i].on_left;
        ghost.on_right = lines[i].on_right;
        std::tie(ghost.left_page, ghost.right_page) = pages_of_fold(before, info.folds[i]);
        ghost.seam = is_seam(info, info.folds[i]);
        ghosts.push_back(ghost);
        index.add(static_cast<int>(ghosts.size()) - 1, ghost, lines[i], true, options.tolerances.rounding_mm);
        // What is cut from the page lies between its folds.
        if (info.glued || i == 0) continue;
        const Segment& from = lines[i - 1].on_right;
        const Segment& to = lines[i].on_left;
        plates.add_ghost(before.site.left_page, {from.a, from.b, to.b, to.a});
    }
}

void Checker::drop(Structure& structure) {
    structure.dropped = true;
    diagnostics
        .warning("dropped", structure.place,
                 fmt::format("\"{}\" cannot fold, or stands on something that cannot; it was taken out",
                             structure.id))
        .about(structure.id)
        .changed(structure.id, "");
}

// The page is there, and what is named can be what such an element stands on.
bool Checker::ground_is_named(const Structure& structure, const ElementInfo& info, const Placing& placing) {
    const Place place = structure.plate ? structure.plate->place : structure.fold.place;
    const int page = structure.ground_page();
    const Grounds& grounds = info.grounds;
    const bool finds = structure.finds_ground && (grounds.found || grounds.page);
    if (!finds && (structure.plate ? !grounds.plate : !grounds.fold && !grounds.seam)) {
        diagnostics
            .error("wrong-ground", place,
                   fmt::format("\"{}\" ({}) stands on a {}, and a {} is given", structure.id, info.name,
                               grounds.page      ? "page"
                               : structure.plate ? "fold"
                                                 : "plate",
                               structure.plate ? "plate" : "fold"))
            .hint(grounds.page ? "leave it out: its outline names its page"
                  : structure.plate
                      ? "write parentfold in place of parentplate"
                      : "write parentplate, with any point of the plate, in place of parentfold")
            .about(structure.id);
        return false;
    }
    if (structure.named().given()) return true;
    if (page < 0 || page >= pages - (info.glued ? 1 : 0)) {
        diagnostics
            .error("page-not-there", place,
                   fmt::format("\"{}\" stands on page {}, but when it is built there are pages 0 to {} only",
                               structure.id, page, pages - (info.glued ? 2 : 1)))
            .hint("list the structure whose piece is that page first: every glued element adds one page")
            .hint(
                fmt::format("if that structure was taken out, the fold \"{}\" stood on is gone: take \"{}\" "
                            "out too, or stand it on another page",
                            structure.id, structure.id))
            .about(structure.id);
        return false;
    }
    if (!structure.plate && !finds &&
        distance(placing.begin, placing.end) <= options.tolerances.rounding_mm) {
        diagnostics
            .error("fold-without-direction", place,
                   fmt::format("the parent fold of \"{}\" begins and ends in the same point", structure.id))
            .hint("give two distinct points of the fold")
            .about(structure.id);
        return false;
    }
    return true;
}

void Checker::no_plate(const Structure& structure, const Placing& placing) {
    std::string nearest = "no plate is on that page";
    if (const auto near = plates.nearest(*skeleton, structure.ground_page(), placing.begin)) {
        nearest = fmt::format("the nearest edge of a plate is one of \"{}\", {} away", near->owner,
                              mm(near->distance));
    }
    diagnostics
        .error("plate-not-found", structure.plate->place,
               fmt::format("there is no plate where \"{}\" should stand, on page {} at {}; {}", structure.id,
                           structure.ground_page(), placing.text(placing.begin), nearest))
        .hint(
            "give a point of a plate that the page or an earlier structure makes, off what is cut out of it")
        .about(structure.id);
}

std::string Checker::owner_of(int plate) const {
    const std::string& name = skeleton->draft.plates[static_cast<std::size_t>(plate)].name;
    return name.substr(0, name.rfind('/'));
}

std::optional<PlateMatch> Checker::plate_of(const Structure& structure, const Placing& placing) const {
    if (structure.named().given()) return named_plate(structure);
    return plates.find(*skeleton, structure.ground_page(), placing.begin, options.tolerances.rounding_mm);
}

bool Checker::stand_on_plate(Structure& structure, Placing& placing) {
    const auto match = plate_of(structure, placing);
    if (!match) {
        no_plate(structure, placing);
        placing.look_along_given_line();
    } else {
        placing.look_on(*match);
    }
    if (!match || match->ghost) {
        keep_ghost(placing.authored_element());
        if (match && options.drop) drop(structure);
        return false;
    }
    if (placing.settle(*match, owner_of(match->plate), options.tolerances, diagnostics)) return true;
    keep_ghost(placing.authored_element());
    return false;
}

// Finds what it stands on and settles it there. When that cannot be had everything is said and kept that
// follows, and false returned.
bool Checker::stand(Structure& structure, Placing& placing) {
    if (structure.plate) return stand_on_plate(structure, placing);
    if (placing.element.info->grounds.page) {
        placing.look_on_page();
        return placing.settle_on_page(diagnostics);
    }
    const auto match = find_fold(structure, placing);
    if (!match) {
        placing.look_along_given_line();
        keep_ghost(placing.authored_element());
        return false;
    }
    if (match->ghost) {
        keep_ghost(placing.authored_element());
        if (options.drop) drop(structure);
        return false;
    }
    if (placing.settle(*match, skeleton->folds[static_cast<std::size_t>(match->fold)], options.tolerances,
                       diagnostics) &&
        may_stand(structure, placing))
        return true;
    keep_ghost(placing.authored_element());
    return false;
}

PaperQuery Checker::query_of(const Element& element) const {
    const auto ask = [&site = element.site](Side side, const auto& question) {
        return side == Side::left ? question(site.left_plate, site.left_page, site.left)
                                  : question(site.right_plate, site.right_page, site.right);
    };
    return {[this, ask, &site = element.site](Side side, const Ring& ring, Fit fit) {
                return ask(side, [&](int plate, int page, const DirectedLine& line) {
                    return paper.may_cut(plate, page, line, site.seam, ring, fit);
                });
            },
            [this, ask, &site = element.site](Side side, const Ring& ring, const Segment& edge, Fit fit) {
                return ask(side, [&](int plate, int page, const DirectedLine& line) {
                    return paper.may_cut(plate, page, line, site.seam, ring, fit, &edge);
                });
            },
            [this, ask](Side side, const Segment& at) {
                return ask(side, [&](int plate, int page, const DirectedLine&) {
                    return paper.edge_along(plate, page, at);
                });
            },
            [this, ask, &site = element.site](Side side, const Segment& seam, Fit fit) {
                return ask(side, [&](int plate, int page, const DirectedLine& line) {
                    return paper.may_glue(plate, page, site.on_plate ? nullptr : &line, seam, fit);
                });
            },
            [this, ask](Side side, double inset, const Box& near) {
                return ask(side, [&](int plate, int page, const DirectedLine&) {
                    return paper.paper_near(plate, page, inset, near);
                });
            },
            [this, ask](Side side, const Ring& ring) {
                return ask(side, [&](int, int page, const DirectedLine&) {
                    if (paper.seam_near(page, ring)) return true;
                    // The border of an area may be far away.
                    const std::vector<int> areas = paper.glued_near(page, bounds(ring));
                    return std::any_of(areas.begin(), areas.end(), [&](int number) {
                        const GluedArea& glued = nth(skeleton->draft.glued_areas, number);
                        return area(intersect(glued.on_base, {{ring, {}}})) > kSpeckMm2;
                    });
                });
            },
            [this, &site = element.site](const Ring& ring) {
                return pierce({*skeleton, plates, index, paper, options.tolerances}, site.left_page, ring);
            }};
}

// Settles and constrains an element; false when it cannot be made.
bool Checker::make(Structure& structure, Placing& placing) {
    Element& element = placing.element;
    element.tolerances = &options.tolerances;
    const PaperQuery query = query_of(element);
    element.paper = &query;
    bool degenerate = false;
    bool failed = false;
    std::vector<Told> findings;
    element.failed = [&](std::string_view code, std::string what, std::string hint) {
        degenerate = code == "degenerate";
        if (degenerate && options.drop) return;
        failed = true;
        findings.push_back({Severity::error, std::string(code), std::move(what), std::move(hint), {}});
    };
    element.repaired = [&](std::string_view code, std::string what, std::string hint) {
        const Severity severity = options.repair ? Severity::warning : Severity::error;
        findings.push_back({severity, std::string(code), std::move(what), std::move(hint),
                            placing.take_change(options.tolerances)});
    };
    element.warned = [&](std::string_view code, std::string what, std::string hint) {
        findings.push_back({Severity::warning, std::string(code), std::move(what), std::move(hint), {}});
    };
    element.remarked = [&](std::string_view code, std::string what, std::string hint) {
        findings.push_back({Severity::remark, std::string(code), std::move(what), std::move(hint), {}});
    };
    if (!stand(structure, placing)) {
        tell(structure, placing, std::move(findings), false);
        return false;
    }
    const Element before = placing.authored_element();
    const bool made = element_row(*element.info).constrain(element);
    tell(structure, placing, std::move(findings), failed);
    if (!made) {
        keep_ghost(before);
        if (degenerate && options.drop) drop(structure);
        return false;
    }
    lower(placing, before);
    placing.write_back(structure);
    return true;
}

// Puts the element's plates and folds where others find them; `before` is it as its author drew it.
void Checker::lower(const Placing& placing, const Element& before) {
    const Element& element = placing.element;
    const ElementInfo& info = *element.info;
    if (info.glued) {
        skeleton->page_mirrored[static_cast<std::size_t>(element.extra_page)] = placing.turned;
        redrawn[static_cast<std::size_t>(element.extra_page)] = element.piece_mirrored;
    }
    const std::size_t first_fold = skeleton->folds.size();
    const std::size_t first_plate = skeleton->draft.plates.size();
    made[current].fold = static_cast<int>(first_fold);
    made[current].plate = static_cast<int>(first_plate);
    element_row(info).lower(element, builder);
    POPUP_INVARIANT(skeleton->folds.size() >= first_fold + info.folds.size());
    paper.update(*skeleton, static_cast<int>(current));
    const FoldLines was = lines_of(element_row(info), before);
    const bool known = finite(was);
    std::vector<RigidMove> moves(skeleton->draft.plates.size() - first_plate);
    for (std::size_t i = 0; first_fold + i < skeleton->folds.size(); ++i) {
        const Fold& fold = skeleton->folds[first_fold + i];
        // Further stretches of the row's folds are where their outline was drawn.
        const FoldLine authored_line =
            known && i < was.size() ? was[i] : FoldLine{fold.on_left, fold.on_right};
        index.add(static_cast<int>(first_fold + i), fold, authored_line, false,
                  options.tolerances.rounding_mm);
        // A plate moves as the first of its folds does.
        for (const auto& [plate, from, to] :
             {std::tuple{fold.left_plate, authored_line.on_left, fold.on_left},
              {fold.right_plate, authored_line.on_right, fold.on_right}}) {
            if (plate < static_cast<int>(first_plate) || !known) continue;
            RigidMove& move = moves[static_cast<std::size_t>(plate) - first_plate];
            const double off = std::max(distance(from.a, to.a), distance(from.b, to.b));
            if (move.identity && off > options.tolerances.rounding_mm) move = move_of(from, to);
        }
    }
    plates.add(*skeleton, first_plate, moves, element.paint.id);
}

void Checker::check_structure(std::size_t number) {
    current = number;
    Structure& structure = design.structures[number];
    if (structure.dropped) return;
    const ElementInfo* info = find_element(structure.type);
    POPUP_INVARIANT(info != nullptr && structure.points.size() == info->points.size());
    const int extra_page = info->glued ? pages++ : -1;
    if (!info->glued && !structure.points.empty())
        same_points.emplace(hash_of_points(authored.structures[number]), number);
    if (info->glued) {
        skeleton->page_mirrored.push_back(false);
        redrawn.push_back(false);
    }
    const PageTurns turns{skeleton->page_mirrored, redrawn};
    std::optional<NamedPlace> place;
    if (structure.named().given()) {
        const auto fold = beside(structure);
        if (!fold) {  // what carries it could not be made, and that has been said
            if (info->glued) plates.add_ghost_page(extra_page);
            if (options.drop) drop(structure);
            return;
        }
        place.emplace(structure, *info, *fold, turns);
        place->lay(structure);
    }
    Placing placing(design, structure, *info, extra_page, turns);
    if (place) placing.beside = &*place;
    if (ground_is_named(structure, *info, placing)) make(structure, placing);
    if (names != nullptr) note(number, placing);
    if (place) place->take_up(structure);
}

// What is printed lies on a page that some piece has.
bool Checker::page_is_there(int page, Place place, std::string_view what) {
    if (page >= 0 && page < pages) return true;
    diagnostics
        .error("page-not-there", place,
               fmt::format("{} page {}, but there are pages 0 to {} only", what, page, pages - 1))
        .hint("page 0 is the base page; every glued element adds one page");
    return false;
}

std::optional<CheckedDesign> Checker::run() {
    builder.add_base_page(design.width_mm, design.height_mm, design.left, design.right);
    skeleton->draft.file = design.file;
    skeleton->draft.stem = design.stem;
    skeleton->draft.units = design.unit.name == "in" ? UnitSystem::inches : UnitSystem::metric;
    skeleton->draft.orientation = design.orientation;
    const Fold& gutter = skeleton->folds.front();
    index.add(0, gutter, {gutter.on_left, gutter.on_right}, false, options.tolerances.rounding_mm);
    paper.update(*skeleton, -1);
    plates.add(*skeleton, 0, std::vector<RigidMove>(skeleton->draft.plates.size()), "page");
    for (std::size_t i = 0; i < design.structures.size(); ++i) check_structure(i);
    for (DrawnLine& line : design.lines) {
        if (!page_is_there(line.page, line.place, "a line is drawn on")) continue;
        if (!redrawn[static_cast<std::size_t>(line.page)]) continue;
        for (DesignPoint& point : line.points) {
            point.at.x = -point.at.x;
            point.changed = true;
        }
    }
    for (DrawnPrint& print : design.prints) {
        constexpr std::array kWhat{"a picture is on", "a text is on", "an area is on"};
        if (page_is_there(print.page, print.place, kWhat.at(print.what.index())) &&
            redrawn[static_cast<std::size_t>(print.page)])
            mirror(print);
    }
    if (names != nullptr) note_folds();
    if (options.drop) close_up_pages(design);
    if (diagnostics.has_errors_as_given()) return std::nullopt;
    return CheckedDesign(std::move(design), std::move(skeleton));
}

std::optional<CheckedDesign> check(const Design& design, const CheckOptions& options,
                                   Diagnostics& diagnostics) {
    return Checker(design, options, diagnostics).run();
}

}  // namespace popup
