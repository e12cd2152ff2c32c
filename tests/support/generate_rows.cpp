// Random elements from their rows alone, and designs of them.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "popup/check.h"
#include "popup/path.h"
#include "support/designs.h"
#include "support/proposals.h"

namespace popup::test {
namespace {

Site site_on(const Fold& fold) {
    Site site;
    site.left = {fold.on_left.a, unit(fold.on_left.b - fold.on_left.a)};
    site.right = {fold.on_right.a, unit(fold.on_right.b - fold.on_right.a)};
    site.left_page = fold.left_page;
    site.right_page = fold.right_page;
    return site;
}

// A cut across the fold, from its left to its right, some way from a point of it.
Argument cut_path(Dice& random, const Site& site, double apex, double reach) {
    const double way = random.chance(0.5) ? 1.0 : -1.0;
    const auto at = [&](double along, double aside) {
        return site.on_page(Side::left, {apex + way * along * reach, aside * reach});
    };
    const double most = random.uniform(0.5, 1.0);
    Path path;
    path.move(at(random.uniform(0.2, 0.6), most));
    path.cubic(at(random.uniform(0.4, 1.0), 0.5 * most), at(random.uniform(0.6, 1.2), 0.3 * most),
               at(random.uniform(0.6, 1.0), 0.1));
    path.cubic(at(random.uniform(0.6, 1.2), -0.3), at(random.uniform(0.4, 1.0), -0.5),
               at(random.uniform(0.2, 0.6), -random.uniform(0.5, 1.0)));
    return path_argument(path);
}

}  // namespace

bool stands_on(const ElementInfo& info, const Fold& fold) {
    return fold.seam ? info.grounds.seam : info.grounds.fold;
}

// Points of any element that stands on folds, from its row alone: even ones as likely as not, each letter
// further out or along than the one before. check() then mends them into an element.
Proposal propose_of(Dice& random, const Fold& fold, const ElementInfo& info) {
    const double size = fold.length();
    const double middle = random.uniform(0.25, 0.75) * size;
    const double reach = random.uniform(0.1, 0.5) * size;
    const bool even = random.chance(0.5);
    Proposal made;
    made.type = info.name;
    std::vector<SitePoint> at(info.points.size());
    std::array<double, 2> along{-0.2 * size, -0.2 * size};
    for (std::size_t i = 0; i < at.size(); ++i) {
        const PointInfo& point = info.points[i];
        const auto partner = static_cast<std::size_t>(info.partners[i]);
        double& s = along[point.page == PointPage::extra ? 1 : 0];
        if (point.side == 'R' && partner < i) {
            at[i] = even ? at[partner] : SitePoint{at[partner].s, at[partner].w * random.uniform(0.7, 1.4)};
        } else {
            // Points of either side, of rows that find their fold, are corners across it.
            const bool corner = point.side == '-' && info.grounds.found && at.size() > 1;
            const double off = point.side == '-' && !corner ? 0.0 : reach * random.uniform(0.5, 1.0);
            at[i] = {s, corner && i % 2 == 1 ? -off : off};
            s += random.uniform(0.1, 0.4) * size;
        }
    }
    const double way = random.chance(0.5) ? 1.0 : -1.0;
    for (std::size_t i = 0; i < at.size(); ++i) {
        const bool right = info.points[i].side == 'R';
        if (info.points[i].page == PointPage::extra) {
            made.extra.push_back({right ? at[i].w : -at[i].w, at[i].s});
        } else {
            made.on.emplace_back(right ? Side::right : Side::left,
                                 SitePoint{middle + way * at[i].s, at[i].w});
        }
    }
    for (const ParameterInfo& parameter : info.parameters) {
        Argument& argument = made.arguments.emplace_back();
        if (parameter.kind == ParameterKind::path && info.grounds.found) {
            argument =
                info.points.empty()
                    ? star_path(random, site_on(fold).on_page(Side::left, {middle, 0.0}), 0.3 * reach, reach)
                    : cut_path(random, site_on(fold), made.on.front().second.s, reach);
            made.finds_ground = random.chance(0.5);
            continue;
        }
        if (parameter.kind == ParameterKind::path && parameter.required)
            argument = star_path(random, lerp(made.extra[0], made.extra[1], 0.5), 0.3 * reach, reach);
        // Side folds well inside of the star are long enough for others.
        if (parameter.kind == ParameterKind::length && parameter.group == "folds" && random.chance(0.7))
            argument.value = std::clamp(reach * random.uniform(0.1, 0.25), parameter.least, parameter.most);
        if (parameter.kind == ParameterKind::length && parameter.required)
            argument.value = std::clamp(reach * random.uniform(0.3, 1.5), parameter.least, parameter.most);
        if (parameter.kind == ParameterKind::choice && random.chance(0.5))
            argument.value = std::string(parameter.words[random.below(parameter.words.size())]);
    }
    return made;
}

void put(Design& design, const Fold& fold, const Proposal& made) {
    const Site site = site_on(fold);
    std::vector<Vec2> points;
    for (const auto& [side, at] : made.on) points.push_back(site.on_page(side, at));
    points.insert(points.end(), made.extra.begin(), made.extra.end());
    Structure& structure = add(design, made.type, points, fold.on_left.a, fold.on_left.b, fold.left_page);
    structure.id = "e" + std::to_string(design.structures.size());
    structure.arguments = made.arguments;
    structure.finds_ground = made.finds_ground;
    for (std::size_t i = 0; i < made.on.size(); ++i) {
        const int page = made.on[i].first == Side::left ? site.left_page : site.right_page;
        if (page != fold.left_page) structure.points[i].page = page;
    }
}

Argument star_path(Dice& random, Vec2 middle, double least, double most) {
    const auto corners = static_cast<int>(4 + random.below(5));
    Path path;
    Vec2 first;
    for (int i = 0; i < corners; ++i) {
        const double turn = 2.0 * std::numbers::pi * (i + random.uniform(0.0, 0.6)) / corners;
        const Vec2 at = middle + random.uniform(least, most) * Vec2{std::cos(turn), std::sin(turn)};
        if (i == 0) {
            path.move(first = at);
        } else if (random.chance(0.3)) {
            path.quadratic(lerp(path.at(), at, 0.5) + random.uniform(0.0, 0.3) * (at - middle), at);
        } else {
            path.line(at);
        }
    }
    path.close();
    return path_argument(path);
}

Design generate_of(const ElementInfo& info, std::uint64_t seed, int elements) {
    Dice random{seed * 0x2545f4914f6cdd1dull + 7};
    Design design = card(279.4, 215.9);
    design.version = info.since;
    Diagnostics first;
    auto checked = check(design, {}, first);
    for (int tries = 60 * elements; tries > 0 && static_cast<int>(design.structures.size()) < elements;
         --tries) {
        const auto& folds = checked->skeleton().folds;
        const Fold& fold = folds[random.below(folds.size())];
        if (fold.closed_deg == 180 || fold.length() < 14.0 || !stands_on(info, fold)) continue;
        Design trial = design;
        put(trial, fold, propose_of(random, fold, info));
        Diagnostics mended;
        auto repaired = check(trial, {}, mended);
        if (!repaired) continue;
        Diagnostics diagnostics;
        auto result = check(repaired->design(), {}, diagnostics);
        if (!result || diagnostics.has_findings()) continue;
        design = repaired->design();
        checked = std::move(result);
    }
    return design;
}

namespace {

// On a plate, or anywhere on the paper of a page.
bool stands_on_paper(const ElementInfo& info) { return info.grounds.plate || info.grounds.page; }

// A point on one of the plates, if a few tries find one.
struct Spot {
    int page = 0;
    Vec2 at;
    double room = 0.0;  // of the plate's box
};
std::optional<Spot> spot_on_plate(Dice& random, const Skeleton& skeleton, std::size_t first = 0) {
    const std::size_t plate = first + random.below(skeleton.draft.plates.size() - first);
    const Polygon& outline = skeleton.draft.plates[plate].outline;
    const Box box = bounds(outline.outer);
    for (int tries = 0; tries < 8; ++tries) {
        const Vec2 at{random.uniform(box.min.x, box.max.x), random.uniform(box.min.y, box.max.y)};
        if (contains(outline, at))
            return Spot{skeleton.plate_page[plate], at, std::min(box.width(), box.height())};
    }
    return std::nullopt;
}

// An element that stands on a plate: its first two points near the spot, a shape of its own.
void put_on_plate(Dice& random, Design& design, const ElementInfo& info, const Spot& spot) {
    const double turn = random.uniform(0.0, 2.0 * std::numbers::pi);
    const Vec2 along{std::cos(turn), std::sin(turn)};
    const double reach = random.uniform(0.2, 1.2) * spot.room;
    const double line = random.uniform(0.05, 0.3) * spot.room;
    std::vector<Vec2> points{spot.at, spot.at + line * along};
    if (info.points.size() == 4) points.insert(points.end(), {{0.0, 0.0}, {0.0, line}});
    Structure& structure = add(design, std::string(info.name), points, spot.at, spot.at, spot.page);
    structure.id = "e" + std::to_string(design.structures.size());
    if (info.grounds.page) {
        structure.finds_ground = true;
        structure.points.clear();
        structure.arguments.push_back(star_path(random, spot.at, 0.1 * reach, 0.3 * reach));
        return;
    }
    structure.plate.emplace();
    structure.plate->page = spot.page;
    structure.plate->at.at = spot.at;
    for (const ParameterInfo& parameter : info.parameters) {
        Argument& argument = structure.arguments.emplace_back();
        if (parameter.kind == ParameterKind::path && parameter.page == PointPage::extra)
            argument = star_path(random, {0.0, 0.0}, 0.3 * reach, reach);
        if (parameter.kind == ParameterKind::choice && random.chance(0.5))
            argument.value = std::string(parameter.words[random.below(parameter.words.size())]);
    }
}

// The free edges of a piece drawn in place of its straight ones: lines and curves through points beside them.
Argument silhouette(Dice& random, const std::vector<Vec2>& corners, std::size_t first_free) {
    Path path;
    path.move(corners.front());
    for (std::size_t i = 1; i <= corners.size(); ++i) {
        const Vec2 from = path.at();
        const Vec2 to = corners[i % corners.size()];
        const auto aside = [&](double t) {
            return lerp(from, to, t) + random.uniform(-0.3, 0.3) * left_of(to - from);
        };
        if (i < first_free) {
            path.line(to);
        } else if (random.chance(0.5)) {
            path.cubic(aside(0.3), aside(0.7), to);
        } else {
            path.line(aside(0.5));
            path.line(to);
        }
    }
    path.close();
    return path_argument(path);
}

// Draws the outline of the last element, where its row lets it; check() judges it.
void draw_outline(Dice& random, Design& design) {
    Structure& made = design.structures.back();
    const ElementInfo& info = *find_element(made.type);
    const auto outline = find_parameter(info, "outline");
    if (!outline || info.parameters[*outline].required || made.points.size() != 8) return;
    const auto at = [&](std::size_t i) { return made.points[i].at; };
    if (info.family == "v-fold") {
        made.argument(*outline) = silhouette(random, {at(3), at(4), at(5), at(6), at(7)}, 3);
    } else {
        // Its seams are the first edge and the third.
        Path path;
        const auto free_edge = [&](Vec2 to) {
            const Vec2 middle =
                lerp(path.at(), to, 0.5) + random.uniform(-0.3, 0.3) * left_of(to - path.at());
            path.quadratic(middle, to);
        };
        path.move(at(4));
        path.line(at(5));
        free_edge(at(7));
        path.line(at(6));
        free_edge(at(4));
        path.close();
        made.argument(*outline) = path_argument(path);
    }
}

// The same of holes: one round the middle of its piece.
void draw_hole(Dice& random, Design& design) {
    Structure& made = design.structures.back();
    const auto hole = find_parameter(*find_element(made.type), "hole");
    if (!hole || made.points.size() != 8) return;
    Vec2 middle;
    for (std::size_t i = 3; i < 8; ++i) middle = middle + 0.2 * made.points[i].at;
    const double size = distance(made.points[6].at, made.points[7].at);
    made.argument(*hole) = star_path(random, middle, 0.05 * size, 0.3 * size);
}

}  // namespace

Design generate_any(std::uint64_t seed, int elements) {
    Dice random{seed * 0x9e3779b97f4a7c15ull + 11};
    Design design = card(279.4, 215.9);
    design.version = "3.0";
    Diagnostics first;
    auto checked = check(design, {}, first);
    const auto take = [&](const Design& trial) {
        Diagnostics diagnostics;
        auto result = check(trial, {}, diagnostics);
        if (!result || diagnostics.has_findings()) return false;
        design = trial;
        checked = std::move(result);
        return true;
    };
    for (int tries = 60 * elements; tries > 0 && static_cast<int>(design.structures.size()) < elements;
         --tries) {
        const ElementInfo& info = element_table()[random.below(element_table().size())];
        Design trial = design;
        if (stands_on_paper(info)) {
            const auto spot = spot_on_plate(random, checked->skeleton());
            if (!spot) continue;
            put_on_plate(random, trial, info, *spot);
        } else {
            const auto& folds = checked->skeleton().folds;
            const std::size_t young = folds.size() - 1 - random.below(std::min<std::size_t>(folds.size(), 8));
            const Fold& fold = folds[random.chance(0.5) ? young : random.below(folds.size())];
            if (fold.closed_deg == 180 || fold.length() < 14.0 || !stands_on(info, fold)) continue;
            put(trial, fold, propose_of(random, fold, info));
        }
        Diagnostics mended;
        const auto repaired = check(trial, {}, mended);
        if (!repaired || !take(repaired->design())) continue;
        if (!random.chance(0.5)) continue;
        trial = design;
        draw_outline(random, trial);
        take(trial);
        trial = design;
        draw_hole(random, trial);
        take(trial);
    }
    return design;
}

namespace {

// A card with room for what stands on what stands on it: lengths shrink with each.
constexpr double kLargeMm = 2000.0;

// An element of that row put on a fold or a plate of the skeleton, mended; nullopt if it cannot be.
std::optional<Design> with_one_on(Dice& random, const Design& design, const Skeleton& skeleton,
                                  const ElementInfo& info, std::optional<std::size_t> fold,
                                  std::size_t first_plate) {
    Design trial = design;
    trial.version = "3.0";
    if (fold) {
        put(trial, skeleton.folds[*fold], propose_of(random, skeleton.folds[*fold], info));
    } else {
        const auto spot = spot_on_plate(random, skeleton, first_plate);
        if (!spot) return std::nullopt;
        put_on_plate(random, trial, info, *spot);
    }
    Diagnostics mended;
    const auto repaired = check(trial, {}, mended);
    if (!repaired) return std::nullopt;
    Diagnostics diagnostics;
    if (!check(repaired->design(), {}, diagnostics) || diagnostics.has_findings()) return std::nullopt;
    return repaired->design();
}

}  // namespace

OnAnother generate_on(const ElementInfo& info, const ElementInfo& ground, std::uint64_t seed) {
    Dice random{seed * 0xd1342543de82ef95ull + 3};
    OnAnother made;
    made.design = card(kLargeMm, kLargeMm);
    Diagnostics ignored;
    // Mountain folds are the centre folds of tents: inverted elements that are cut need one.
    std::optional<Design> below = made.design;
    const bool on_tent = ground.inverted && !ground.glued;
    if (on_tent) {
        const auto bare = check(made.design, {}, ignored);
        below = with_one_on(random, made.design, bare->skeleton(), *find_element("tent"), 0, 0);
        if (!below) return made;
    }
    const auto under = check(*below, {}, ignored);
    const std::size_t parent = on_tent ? 2 : 0;
    const auto first = with_one_on(random, *below, under->skeleton(), ground,
                                   stands_on_paper(ground) ? std::nullopt : std::optional(parent), 0);
    if (!first) return made;
    const auto checked = check(*first, {}, ignored);
    const Skeleton& skeleton = checked->skeleton();
    const std::size_t own = skeleton.folds.size() - ground.folds.size();
    if (stands_on_paper(info)) {
        made.wanted.push_back(0);
        std::size_t plate = skeleton.draft.plates.size() - 1;
        while (plate > 0 &&
               skeleton.draft.plates[plate - 1].name.starts_with(first->structures.back().id + "/"))
            --plate;
        if (auto both = with_one_on(random, *first, skeleton, info, std::nullopt, plate)) {
            made.design = std::move(*both);
            made.stands_on = 0;
        }
        return made;
    }
    for (std::size_t i = 0; i < ground.folds.size(); ++i) {
        const Fold& fold = skeleton.folds[own + i];
        const bool inverse = info.inverted != (fold.closed_deg == 360) && !info.glued &&
                             info.family != "pivot" && !info.grounds.found;
        // The pillar of a floating layer stands under all of its centre fold: nothing is cut from there.
        const bool taken = ground.name == "floating-layer" && fold.closed_deg == 0 && !info.grounds.seam;
        if (fold.closed_deg != 180 && !inverse && !taken && stands_on(info, fold)) made.wanted.push_back(i);
    }
    if (made.wanted.empty()) return made;
    const std::size_t chosen = made.wanted[random.below(made.wanted.size())];
    if (auto both = with_one_on(random, *first, skeleton, info, own + chosen, 0)) {
        made.design = std::move(*both);
        made.stands_on = chosen;
    }
    return made;
}

Design generate_tower(std::uint64_t seed, int depth) {
    constexpr int kKinds = 12;  // tried, until one stands
    constexpr int kTries = 20;  // of one kind: the largest is taken
    Dice random{seed * 0xaf251af3b0f025b5ull + 5};
    Design design = card(kLargeMm, kLargeMm);
    Diagnostics ignored;
    auto checked = check(design, {}, ignored);
    std::size_t first_fold = 0;
    std::size_t first_plate = 0;
    const auto longest = [&](const Design& made) {
        const auto here = check(made, {}, ignored);
        double size = 0.0;
        for (std::size_t i = checked->skeleton().folds.size(); i < here->skeleton().folds.size(); ++i) {
            const Fold& fold = here->skeleton().folds[i];
            if (fold.closed_deg != 180) size = std::max(size, fold.length());
        }
        return size;
    };
    for (int level = 0; level < depth; ++level) {
        const Skeleton& skeleton = checked->skeleton();
        std::optional<Design> best;
        for (int kind = 0; kind < kKinds && !best; ++kind) {
            const ElementInfo& info = element_table()[random.below(element_table().size())];
            // What has no folds ends a tower.
            if (info.folds.empty() && level + 1 < depth) continue;
            double size = 0.0;
            for (int tries = 0; tries < kTries; ++tries) {
                std::optional<std::size_t> fold;
                if (!stands_on_paper(info)) {
                    fold = first_fold + random.below(skeleton.folds.size() - first_fold);
                    const Fold& on = skeleton.folds[*fold];
                    if (on.closed_deg == 180 || !stands_on(info, on)) continue;
                }
                auto taller = with_one_on(random, design, skeleton, info, fold, first_plate);
                if (!taller) continue;
                const double own = longest(*taller);
                if (best && own <= size) continue;
                size = own;
                best = std::move(taller);
            }
        }
        if (!best) break;
        first_fold = skeleton.folds.size();
        first_plate = skeleton.draft.plates.size();
        design = std::move(*best);
        checked = check(design, {}, ignored);
    }
    return design;
}

}  // namespace popup::test
