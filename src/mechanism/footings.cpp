#include "mechanism/footings.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <utility>

#include "base/geometry/edge_index.h"
#include "mechanism/given_points.h"

namespace popup {
namespace {

constexpr double kSnapMm = 0.5;

struct Match {
    int fold = -1;
    bool reversed = false;
};

// A fold's image on a page.
struct Image {
    int fold = -1;
    Vec2 at, dir;  // its begin, and its direction of length 1
    double size = 0.0;
};

// How a line lies on a fold's image: nullopt, or whether it runs the other way.
std::optional<bool> lies_on(const Image& fold, Vec2 begin, Vec2 end) {
    if (std::abs(cross(fold.dir, begin - fold.at)) > kSnapMm ||
        std::abs(cross(fold.dir, end - fold.at)) > kSnapMm)
        return std::nullopt;
    const double first = dot(fold.dir, begin - fold.at);
    const double last = dot(fold.dir, end - fold.at);
    if (std::min(first, last) > fold.size + kSnapMm || std::max(first, last) < -kSnapMm || first == last)
        return std::nullopt;
    return last < first;
}

PageFold turned(PageFold fold) {
    std::swap(fold.left_page, fold.right_page);
    std::swap(fold.on_left, fold.on_right);
    std::swap(fold.on_left.a, fold.on_left.b);
    std::swap(fold.on_right.a, fold.on_right.b);
    return fold;
}

class Finder {
 public:
    explicit Finder(const Design& design) : design_(design) {}

    Footings run() {
        const double half = design_.height_mm / 2;
        const Segment gutter{{0, -half}, {0, half}};
        add({-1, "gutter", {0, 0, gutter, gutter, false, 0}});
        for (std::size_t i = 0; i < design_.structures.size(); ++i) find(static_cast<int>(i));
        return std::move(out_);
    }

 private:
    void add(StandingFold fold) {
        const int number = static_cast<int>(out_.folds.size());
        add_image(number, fold.at.left_page, fold.at.on_left);
        if (fold.at.right_page != fold.at.left_page) add_image(number, fold.at.right_page, fold.at.on_right);
        out_.folds.push_back(fold);
    }

    void add_image(int number, int page, const Segment& line) {
        const double size = distance(line.a, line.b);
        if (size == 0.0) return;
        PageImages& there = on_page_[page];
        there.images.push_back({number, line.a, (1.0 / size) * (line.b - line.a), size});
        there.lines.insert(line, false);
    }

    // The youngest that the line lies on, and that the element's points lie beside.
    [[nodiscard]] Match fold_of(const Structure& structure, const ElementInfo& info) {
        const auto there = on_page_.find(structure.fold.page);
        if (there == on_page_.end()) return {};
        const std::vector<Vec2> points = points_on(structure, info);
        there->second.lines.query(place_on_line(structure, points), found_);
        for (auto number = found_.rbegin(); number != found_.rend(); ++number) {
            const Image& image = there->second.images[static_cast<std::size_t>(*number)];
            const auto reversed = lies_on(image, structure.fold.begin.at, structure.fold.end.at);
            if (reversed && stands_beside(image, points)) return {image.fold, *reversed};
        }
        return {};
    }

    // Its points on the page of the fold that it names.
    static std::vector<Vec2> points_on(const Structure& structure, const ElementInfo& info) {
        std::vector<Vec2> made;
        for (std::size_t i = 0; i < std::min(structure.points.size(), info.points.size()); ++i) {
            const DesignPoint& point = structure.points[i];
            if (info.points[i].page == PointPage::fold &&
                point.page.value_or(structure.fold.page) == structure.fold.page)
                made.push_back(point.at);
        }
        return made;
    }

    // Round all places where a fold can be that the line lies on, and that the points lie beside.
    static Box place_on_line(const Structure& structure, std::span<const Vec2> points) {
        const Vec2 begin = structure.fold.begin.at;
        const Vec2 end = structure.fold.end.at;
        const double size = distance(begin, end);
        // Such a fold is at most a snap across and a snap along away from the line. It may run askew to it,
        // by a snap at either end; so much further away from where the points lie beside the line it may be.
        double reach = 2.0 * kSnapMm;
        Box box;
        for (const Vec2 point : points) {
            if (size == 0.0) break;
            const Vec2 along = (1.0 / size) * (end - begin);
            box.extend(begin + dot(along, point - begin) * along);
            reach = std::max(reach, 2.0 * kSnapMm + 4.0 * kSnapMm / size * distance(begin, point));
        }
        if (box.empty()) {
            box.extend(begin);
            box.extend(end);
        }
        return {box.min - Vec2{reach, reach}, box.max + Vec2{reach, reach}};
    }

    // Folds often lie in one line; that one counts beside which the element's points are.
    static bool stands_beside(const Image& fold, std::span<const Vec2> points) {
        double low = std::numeric_limits<double>::infinity();
        double high = -low;
        for (const Vec2 point : points) {
            low = std::min(low, dot(fold.dir, point - fold.at));
            high = std::max(high, dot(fold.dir, point - fold.at));
        }
        return low > high || (low < fold.size + kSnapMm && high > -kSnapMm);
    }

    // The number of a fold of that owner; -1: it is not known where it is.
    [[nodiscard]] int fold_named(int owner, std::size_t which) const {
        if (owner < 0) return 0;
        // They are in build order.
        const auto first =
            std::lower_bound(out_.folds.begin(), out_.folds.end(), owner,
                             [](const StandingFold& fold, int number) { return fold.owner < number; });
        return first == out_.folds.end() || first->owner != owner
                   ? -1
                   : static_cast<int>(first - out_.folds.begin()) + static_cast<int>(which);
    }

    void find(int number) {
        const Structure& structure = design_.structures[static_cast<std::size_t>(number)];
        Ground& ground = out_.ground.emplace_back();
        const ElementInfo* info = find_element(structure.type);
        if (info == nullptr) return;
        if (info->glued) {
            ground.extra_page = ++pages_;
            owner_of_page_[ground.extra_page] = number;
        }
        PageFold parent;
        if (const NamedGround& named = structure.named(); named.given()) {
            ground.owner = named.owner ? static_cast<int>(*named.owner) : -1;
            if (structure.plate) {
                ground.plate_owner = ground.owner;
                return;
            }
            ground.fold = fold_named(ground.owner, named.which);
            // Its points are those of a page only beside the gutter.
            if (ground.fold != 0) return;
            parent = out_.folds.front().at;
        } else if (structure.plate) {
            const auto owner = owner_of_page_.find(structure.plate->page);
            if (owner != owner_of_page_.end()) ground.plate_owner = owner->second;
            ground.owner = ground.plate_owner;
            parent.left_page = parent.right_page = structure.plate->page;
            const Vec2 at = structure.plate->at.at;
            parent.on_left = parent.on_right = {at, at + Vec2{1, 0}};
        } else if (!structure.finds_ground) {
            const Match match = fold_of(structure, *info);
            if (match.fold < 0) return;
            ground.fold = match.fold;
            ground.reversed = match.reversed;
            const StandingFold& fold = out_.folds[static_cast<std::size_t>(match.fold)];
            ground.owner = fold.owner;
            parent = match.reversed ? turned(fold.at) : fold.at;
        } else {
            return;
        }
        if (structure.points.size() != info->points.size()) return;
        const std::vector<Vec2> points = points_seen(structure, *info, parent);
        const auto made = folds_of(*info, parent, ground.extra_page, points, structure.arguments);
        if (!made) return;
        for (std::size_t i = 0; i < made->size(); ++i) add({number, info->folds[i].name, (*made)[i]});
    }

    const Design& design_;
    Footings out_;
    struct PageImages {
        std::vector<Image> images;
        EdgeIndex lines;  // of each
    };
    std::map<int, PageImages> on_page_;
    std::vector<int> found_;
    std::map<int, int> owner_of_page_;
    int pages_ = 0;
};

Vec2 direction(const Segment& line, bool reversed) {
    const double size = distance(line.a, line.b);
    return (reversed ? -1.0 / size : 1.0 / size) * (line.b - line.a);
}

}  // namespace

Footings footings_of(const Design& design) { return Finder(design).run(); }

Vec2 along_left(const StandingFold& fold, bool reversed) {
    return direction(reversed ? fold.at.on_right : fold.at.on_left, reversed);
}
Vec2 along_right(const StandingFold& fold, bool reversed) {
    return direction(reversed ? fold.at.on_left : fold.at.on_right, reversed);
}

}  // namespace popup
