// Folds and plates by their names: what structures stand on that name it, and the names of a whole card.
#include <fmt/format.h>

#include <algorithm>

#include "check/checker.h"

namespace popup {
namespace {

FoldMatch match_of(int fold, bool ghost = false) {
    FoldMatch match;
    match.fold = fold;
    match.ghost = ghost;
    return match;
}

// "bird/front-left" as documents call it: "bird.frontleft"; of a piece with one plate "flag.plate".
std::string plate_named(const std::string& name) {
    const std::size_t slash = name.rfind('/');
    if (slash == std::string::npos) return name + ".plate";
    std::string made = name.substr(0, slash) + ".";
    for (const char c : name.substr(slash + 1)) {
        if (c != '-') made += c;
    }
    return made;
}

}  // namespace

std::optional<FoldMatch> Checker::named_fold(const Structure& structure) const {
    const NamedGround& on = structure.named();
    if (!on.owner) return match_of(0);
    const Made& owner = made[*on.owner];
    if (owner.fold < 0 && owner.ghost < 0) return std::nullopt;
    const bool ghost = owner.fold < 0;
    return match_of((ghost ? owner.ghost : owner.fold) + static_cast<int>(on.which), ghost);
}

std::optional<PlateMatch> Checker::named_plate(const Structure& structure) const {
    const NamedGround& on = structure.named();
    PlateMatch match;
    match.plate = static_cast<int>(on.which);
    if (!on.owner) return match;
    const ElementInfo& info = *find_element(design.structures[*on.owner].type);
    const std::string wanted = plate_name(design.structures[*on.owner].id, info.plates[on.which]);
    const auto& all = skeleton->draft.plates;
    const int first = made[*on.owner].plate;
    for (auto i = static_cast<std::size_t>(std::max(first, 0)); first >= 0 && i < all.size(); ++i) {
        match.plate = static_cast<int>(i);
        if (plate_named(all[i].name) == wanted) return match;
        if (owner_of(match.plate) != design.structures[*on.owner].id &&
            all[i].name != design.structures[*on.owner].id)
            break;
    }
    match.plate = -1;
    match.ghost = true;
    return match;
}

PageFold Checker::fold_lines_of(const FoldMatch& match) const {
    const Fold& fold = fold_of(match);
    return {fold.left_page, fold.right_page, fold.on_left, fold.on_right, fold.seam, fold.closed_deg};
}

// The fold beside which the points of what is named lie; nullopt where there is none.
std::optional<PageFold> Checker::beside(const Structure& structure) const {
    const NamedGround& on = structure.named();
    if (!structure.plate) {
        const auto match = named_fold(structure);
        if (!match) return std::nullopt;
        return fold_lines_of(*match);
    }
    if (!on.owner) return fold_lines_of(match_of(0));
    const ElementInfo& info = *find_element(design.structures[*on.owner].type);
    const PlateInfo& plate = info.plates[on.which];
    const Made& owner = made[*on.owner];
    if (owner.fold < 0 || owner.plate < 0) return std::nullopt;
    const int number = named_plate(structure)->plate;
    POPUP_INVARIANT(number >= 0);
    const int page = skeleton->plate_page[static_cast<std::size_t>(number)];
    if (plate.fold < 0) {
        const Segment up{{0, -1}, {0, 1}};
        return PageFold{page, page, up, up, false, 0};
    }
    PageFold fold = fold_lines_of(match_of(owner.fold + plate.fold));
    (plate.right ? fold.on_left : fold.on_right) = plate.right ? fold.on_right : fold.on_left;
    fold.left_page = fold.right_page = page;
    return fold;
}

// What the structure stands on, for folds_of_card().
void Checker::note(std::size_t number, const Placing& placing) {
    const Structure& structure = design.structures[number];
    const Site& site = placing.element.site;
    Standing& standing = names->standing[number];
    const Segment up{{0, 0}, {0, 1}};
    standing.seen = {structure.ground_page(), structure.ground_page(), up, up, false, 0};
    if (structure.plate) {
        if (site.left_plate < 0) return;
        const std::string& plate = skeleton->draft.plates[static_cast<std::size_t>(site.left_plate)].name;
        standing.on = plate_named(plate);
        standing.owner = owner_number(plate.substr(0, plate.rfind('/')));
        return;
    }
    if (placing.element.info->grounds.page) {
        standing.on = fmt::format("page {}", structure.ground_page());
        return;
    }
    // Where there is no fold, the line that was given stands for it.
    if (site.length > 0.0) standing.seen = placing.seen();
    if (site.length <= 0.0 || !placing.found) return;
    const FoldMatch& match = *placing.found;
    standing.fold = 0;
    if (match.ghost || match.fold > 0) {
        const Fold& fold = fold_of(match);
        standing.owner = owner_number(fold.owner);
        if (!standing.owner) {
            standing.fold.reset();
            return;
        }
        const Made& owner = made[*standing.owner];
        const ElementInfo& info = *find_element(design.structures[*standing.owner].type);
        const auto which = static_cast<std::size_t>(match.fold - (match.ghost ? owner.ghost : owner.fold));
        standing.fold.reset();
        standing.on = design.structures[*standing.owner].id;
        if (which < info.folds.size()) {
            standing.on = fold_name(standing.on, info.folds[which]);
            which_of[number] = which;
        }
    } else {
        standing.on = kGutter;
    }
    standing.seen = placing.seen();
}

std::optional<std::size_t> Checker::owner_number(const std::string& id) const {
    const auto found = numbers.find(id);
    if (found == numbers.end()) return std::nullopt;
    return found->second;
}

// All names, once everything is there.
void Checker::note_folds() {
    names->folds.push_back({std::string(kGutter), std::nullopt, 0, fold_lines_of(match_of(0))});
    std::vector<std::size_t> first(design.structures.size(), 0);
    for (const std::string_view plate : kPagePlates) names->plates.emplace_back(plate);
    for (std::size_t n = 0; n < design.structures.size(); ++n) {
        const Structure& structure = design.structures[n];
        const ElementInfo& info = *find_element(structure.type);
        first[n] = names->folds.size();
        for (const PlateInfo& plate : info.plates) names->plates.push_back(plate_name(structure.id, plate));
        if (made[n].fold < 0 && made[n].ghost < 0) continue;
        for (std::size_t i = 0; i < info.folds.size(); ++i) {
            const bool ghost = made[n].fold < 0;
            const FoldMatch match =
                match_of((ghost ? made[n].ghost : made[n].fold) + static_cast<int>(i), ghost);
            names->folds.push_back({fold_name(structure.id, info.folds[i]), n, i, fold_lines_of(match)});
        }
    }
    for (std::size_t n = 0; n < design.structures.size(); ++n) {
        Standing& standing = names->standing[n];
        if (which_of[n]) standing.fold = first[*standing.owner] + *which_of[n];
    }
}

CardFolds folds_of_card(const Design& design, const Tolerances& tolerances) {
    CardFolds names;
    names.standing.resize(design.structures.size());
    Diagnostics unheard(design.file);
    CheckOptions options;
    options.tolerances = tolerances;
    Checker checker(design, options, unheard);
    checker.names = &names;
    checker.which_of.resize(design.structures.size());
    for (std::size_t i = 0; i < design.structures.size(); ++i)
        checker.numbers.emplace(design.structures[i].id, i);
    names.as_written = checker.run() && unheard.repairs().empty();
    return names;
}

}  // namespace popup
