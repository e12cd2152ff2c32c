// What stands on a structure, and moves with it.
#include <algorithm>

#include "edit/session.h"
#include "mechanism/measures.h"

namespace popup::edit {
namespace {

using measure::moved_to;
using measure::spot_of;

Vec2 image_of(const Placed& m, Vec2 p) {
    return {m[0] * p.x + m[2] * p.y + m[4], m[1] * p.x + m[3] * p.y + m[5]};
}

Segment image_of(const Placed& m, const Segment& s) { return {image_of(m, s.a), image_of(m, s.b)}; }

// A line with its middle and direction to another: it is not stretched.
Placed line_moved(const Segment& from, const Segment& to) {
    return moved_to(spot_of(from.a, from.b), spot_of(to.a, to.b));
}

constexpr Placed kStays{1, 0, 0, 1, 0, 0};

// How the pages beside a fold have moved.
struct Moved {
    int left_page = 0, right_page = 0;
    Placed left = kStays, right = kStays;

    [[nodiscard]] const Placed& of(int page) const { return page == left_page ? left : right; }
};

Moved moved_fold(const PageFold& before, const PageFold& after) {
    return {before.left_page, before.right_page, line_moved(before.on_left, after.on_left),
            line_moved(before.on_right, after.on_right)};
}

void move_point(DesignPoint& point, const Placed& by) {
    const Vec2 to = image_of(by, point.at);
    if (distance(to, point.at) <= 1e-9) return;
    point.at = to;
    point.changed = true;
}

// Gives the points of a structure, and what it stands on, to where the pages have moved.
void carry(Structure& structure, const Moved& moved) {
    const ElementInfo& info = Session::info_of(structure);
    const int ground = structure.ground_page();
    for (std::size_t i = 0; i < structure.points.size(); ++i) {
        if (info.points[i].page == PointPage::extra) continue;
        DesignPoint& point = structure.points[i];
        move_point(point, moved.of(point.page.value_or(ground)));
    }
    for (std::size_t i = 0; i < structure.arguments.size(); ++i) {
        Argument& argument = structure.arguments[i];
        if (info.parameters[i].page == PointPage::extra || !is_drawn(argument)) continue;
        move_argument(argument, moved.of(argument.page.value_or(ground)));
        argument.changed = true;
    }
    if (structure.plate) {
        move_point(structure.plate->at, moved.of(ground));
    } else if (!structure.finds_ground) {
        move_point(structure.fold.begin, moved.of(ground));
        move_point(structure.fold.end, moved.of(ground));
    }
}

// The number of the plate that a structure stands on, in the row of its owner.
std::optional<std::size_t> plate_number(const Structure& owner, const std::string& name) {
    const ElementInfo& info = Session::info_of(owner);
    for (std::size_t i = 0; i < info.plates.size(); ++i) {
        if (plate_name(owner.id, info.plates[i]) == name) return i;
    }
    return std::nullopt;
}

}  // namespace

std::vector<PageFold> folds_on_pages(Session& session, std::size_t n) {
    const Structure& structure = session.design.structures[n];
    const ElementInfo& info = Session::info_of(structure);
    const Standing standing = session.standing(n);
    if (info.folds.empty() || standing.on.empty()) return {};
    int page = 0;
    for (std::size_t i = 0; i <= n; ++i) page += Session::info_of(session.design.structures[i]).glued ? 1 : 0;
    auto made = folds_of(info, standing.seen, page, Session::points_of(structure, standing.seen),
                         structure.arguments);
    if (!made) return {};
    if (!structure.named().given() || !standing.fold) return *made;
    // They lie beside the fold that is named; on pages the piece's own folds stay where they are.
    const PageFold& ground = session.card().folds[*standing.fold].at;
    const Placed left = line_moved(standing.seen.on_left, ground.on_left);
    const Placed right = line_moved(standing.seen.on_right, ground.on_right);
    for (std::size_t i = 0; i < made->size(); ++i) {
        PageFold& fold = (*made)[i];
        const bool cut = !info.glued;
        if (cut || info.folds[i].on_left == PointPage::fold) {
            fold.on_left = image_of(left, fold.on_left);
            fold.left_page = ground.left_page;
        }
        if (cut || info.folds[i].on_right == PointPage::fold) {
            fold.on_right = image_of(cut ? left : right, fold.on_right);
            fold.right_page = cut ? ground.left_page : ground.right_page;
        }
    }
    return *made;
}

Followers::Followers(Session& session, std::size_t n) {
    const CardFolds card = session.card();
    std::vector<bool> on_it(session.design.structures.size(), false);
    on_it[n] = true;
    for (std::size_t i = n; i < on_it.size(); ++i) {
        const auto owner = card.standing[i].owner;
        if (i != n && !(owner && on_it[*owner])) continue;
        on_it[i] = true;
        all_.push_back({i, folds_on_pages(session, i)});
    }
}

void Followers::follow(Session& session) const {
    // What has been moved is where its own have moved it: nothing is looked at anew in between.
    CardFolds* card = session.known();
    if (card == nullptr) return;
    session.kept_up();
    std::vector<std::optional<std::vector<PageFold>>> after(session.design.structures.size());
    std::vector<const One*> before(session.design.structures.size(), nullptr);
    for (const One& one : all_) {
        before[one.number] = &one;
        Structure& structure = session.design.structures[one.number];
        Standing& standing = card->standing[one.number];
        if (&one != all_.data() && standing.owner && after[*standing.owner] && !structure.named().given()) {
            const std::vector<PageFold>& was = before[*standing.owner]->before;
            const std::vector<PageFold>& is = *after[*standing.owner];
            std::optional<Moved> moved;
            if (standing.fold && card->folds[*standing.fold].which < was.size() && was.size() == is.size()) {
                const std::size_t which = card->folds[*standing.fold].which;
                moved = moved_fold(was[which], is[which]);
            } else if (structure.plate) {
                const Structure& owner = session.design.structures[*standing.owner];
                const auto plate = plate_number(owner, standing.on);
                const int fold = plate ? Session::info_of(owner).plates[*plate].fold : -1;
                if (fold >= 0 && static_cast<std::size_t>(fold) < was.size() && was.size() == is.size()) {
                    const auto k = static_cast<std::size_t>(fold);
                    const bool right = Session::info_of(owner).plates[*plate].right;
                    const Placed by = right ? line_moved(was[k].on_right, is[k].on_right)
                                            : line_moved(was[k].on_left, is[k].on_left);
                    moved = Moved{structure.plate->page, structure.plate->page, by, by};
                }
            }
            if (moved) {
                carry(structure, *moved);
                standing.seen.on_left = image_of(moved->of(standing.seen.left_page), standing.seen.on_left);
                standing.seen.on_right =
                    image_of(moved->of(standing.seen.right_page), standing.seen.on_right);
            }
        }
        after[one.number] = folds_on_pages(session, one.number);
        for (CardFold& fold : card->folds) {
            if (fold.owner == one.number && fold.which < after[one.number]->size())
                fold.at = (*after[one.number])[fold.which];
        }
    }
}

}  // namespace popup::edit
