#include "repair/move_element.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "mechanism/arguments.h"
#include "mechanism/footings.h"

namespace popup {
namespace {

// By how much what lies beside a fold moves on its left and on its right page.
struct Shift {
    Vec2 left, right;
    [[nodiscard]] bool none() const { return length(left) == 0.0 && length(right) == 0.0; }
};

class Mover {
 public:
    Mover(Design& design, const Footings& standing)
        : design_(design), standing_(standing), shifts_(design.structures.size()) {}

    void run(std::size_t first, Shift shift) {
        shifts_[first] = shift;
        move_points(first, shift);
        for (std::size_t i = first + 1; i < shifts_.size(); ++i) follow(i);
    }

 private:
    // What stands on something that has moved.
    void follow(std::size_t number) {
        const Ground& ground = standing_.ground[number];
        if (ground.owner < 0) return;
        const auto owner = static_cast<std::size_t>(ground.owner);
        const Shift moved = shifts_[owner];
        if (moved.none()) return;
        Structure& structure = design_.structures[number];
        const ElementInfo* below = find_element(design_.structures[owner].type);
        if (ground.fold < 0 || below == nullptr) return;
        const StandingFold& fold = standing_.folds[static_cast<std::size_t>(ground.fold)];
        const auto row = std::find_if(below->folds.begin(), below->folds.end(),
                                      [&](const FoldInfo& info) { return info.name == fold.name; });
        if (row == below->folds.end()) return;
        // A cut element takes its page's paper along; of a glued one its own piece is where it was.
        Shift shift = moved;
        if (below->glued) {
            if (row->on_left == PointPage::extra) shift.left = {};
            if (row->on_right == PointPage::extra) shift.right = {};
        }
        if (ground.reversed) std::swap(shift.left, shift.right);
        if (shift.none()) return;
        shifts_[number] = shift;
        // What names its fold follows by itself.
        if (structure.named().given()) return;
        move_points(number, shift);
        const Vec2 by = is_right(number, structure.fold.page) ? shift.right : shift.left;
        move(structure.fold.begin, by);
        move(structure.fold.end, by);
    }

    // Whether a page of what it stands on is that on the right of a seam.
    [[nodiscard]] bool is_right(std::size_t number, int page) const {
        const Ground& ground = standing_.ground[number];
        if (ground.fold < 0) return false;
        const PageFold& fold = standing_.folds[static_cast<std::size_t>(ground.fold)].at;
        const int left = ground.reversed ? fold.right_page : fold.left_page;
        return page != left;
    }

    static void move(DesignPoint& point, Vec2 by) {
        if (length(by) == 0.0) return;
        point.at = point.at + by;
        point.changed = true;
    }

    void move_points(std::size_t number, const Shift& shift) {
        Structure& structure = design_.structures[number];
        const ElementInfo* info = find_element(structure.type);
        if (info == nullptr || structure.points.size() != info->points.size()) return;
        const int ground = structure.ground_page();
        const auto by = [&](std::optional<int> page) {
            return is_right(number, page.value_or(ground)) ? shift.right : shift.left;
        };
        for (std::size_t i = 0; i < structure.points.size(); ++i) {
            if (info->points[i].page == PointPage::fold)
                move(structure.points[i], by(structure.points[i].page));
        }
        for (std::size_t i = 0; i < structure.arguments.size(); ++i) {
            Argument& argument = structure.arguments[i];
            if (!is_drawn(argument) || info->parameters[i].page != PointPage::fold) continue;
            const Vec2 d = by(argument.page);
            if (length(d) == 0.0) continue;
            move_argument(argument, {1, 0, 0, 1, d.x, d.y});
            argument.changed = true;
        }
    }

    Design& design_;
    const Footings& standing_;
    std::vector<Shift> shifts_;
};

}  // namespace

double moved_mm(const FreeingMove& move) { return std::ceil(length(move.by) * 100.0 - 1e-6) / 100.0; }

bool move_element(Design& design, const Footings& standing, const FreeingMove& move) {
    const auto& all = design.structures;
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const Structure& s) { return s.id == move.element; });
    const double mm = length(move.by);
    if (found == all.end() || !(mm > 0.0)) return false;
    const auto number = static_cast<std::size_t>(found - all.begin());
    const Vec2 by = (moved_mm(move) / mm) * move.by;
    Shift shift{by, by};
    const Ground& ground = standing.ground[number];
    if (found->plate && found->plate->on.given()) return false;
    if (!found->plate && !found->finds_ground) {
        if (ground.fold < 0) return false;
        const StandingFold& fold = standing.folds[static_cast<std::size_t>(ground.fold)];
        const Vec2 left = along_left(fold, ground.reversed);
        shift.right = dot(by, left) * along_right(fold, ground.reversed);
        // Beside a fold that is named, y runs along it.
        if (found->fold.on.given()) shift.left = shift.right = {0.0, dot(by, left)};
    }
    Mover(design, standing).run(number, shift);
    return true;
}

}  // namespace popup
