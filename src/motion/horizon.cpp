// Pictures that are printed so that their horizon is straight where it stands.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "assembly/settle.h"
#include "base/geometry/regions.h"
#include "popup/image.h"
#include "popup/motion.h"

namespace popup {
namespace {

// Less than a degree: planes and folds that rise less are taken for flat, directions for one.
constexpr double kLeast = 0.0175;
// A picture that is sheared further than this is no picture any more.
constexpr double kMostShear = 10.0;

std::size_t at(int index) { return static_cast<std::size_t>(index); }

// p ↦ p + along * (slope * dot(across, p - from)): points of the line through `from` along `along` stay.
struct Shear {
    Vec2 from, along, across;
    double slope = 0.0;
    [[nodiscard]] Vec2 point(Vec2 p) const { return p + (slope * dot(across, p - from)) * along; }
};

// The shear along a fold that gives `row` the direction `level`; nullopt: there is none that is of use.
std::optional<Shear> levelling(Vec2 from, Vec2 along, Vec2 across, Vec2 row, Vec2 level) {
    const double reach = dot(across, unit(row));
    const double rise = cross(level, along);
    if (std::abs(reach) < kLeast || std::abs(rise) < kLeast) return std::nullopt;
    const double slope = -cross(level, unit(row)) / (reach * rise);
    if (std::abs(slope) > kMostShear) return std::nullopt;
    return Shear{from, along, across, slope};
}

Affine sheared(const Affine& map, const Shear& shear) {
    Affine made;
    made.origin = shear.point(map.origin);
    made.x = shear.point(map.origin + map.x) - made.origin;
    made.y = shear.point(map.origin + map.y) - made.origin;
    return made;
}

// A plate on the open card.
struct Slope {
    double base = 0.0;  // height of the page's origin
    Vec2 rise;          // of the height, in page coordinates
    bool flat = true;
    Vec2 level;  // of a plate that is not flat: unit, along which the height does not change
    [[nodiscard]] double height(Vec2 p) const { return base + dot(rise, p); }
};

Slope slope_of(const Frame& frame) {
    Slope slope;
    slope.base = frame.origin.z;
    slope.rise = {frame.axes[0].z, frame.axes[1].z};
    slope.flat = length(slope.rise) < kLeast;
    if (!slope.flat) slope.level = right_of(unit(slope.rise));
    return slope;
}

// How a piece is levelled: from its centre fold on, over folds that rise.
struct Way {
    struct Step {
        int plate = 0;
        int from = -1;  // the step of the plate on the other side of the fold, before this one; -1: none is
        Segment fold;
    };
    std::vector<Step> steps;  // the first two are the plates of the centre fold, unless there is none
};

class Leveller {
 public:
    Leveller(Assembly& assembly, Diagnostics& diagnostics)
        : assembly_(assembly), diagnostics_(diagnostics), hinges_on_(assembly.plates.size()) {}

    void run(const std::vector<Frame>& frames) {
        for (const Frame& frame : frames) slopes_.push_back(slope_of(frame));
        for (std::size_t i = 0; i < assembly_.hinges.size(); ++i) {
            for (const int plate : {assembly_.hinges[i].a, assembly_.hinges[i].b})
                hinges_on_[at(plate)].push_back(static_cast<int>(i));
        }
        steps_of_.assign(assembly_.plates.size(), -1);
        for (const Piece& piece : assembly_.pieces) level(piece);
    }

 private:
    [[nodiscard]] bool rises(const Hinge& hinge) const {
        const Slope& a = slopes_[at(hinge.a)];
        return !hinge.glued && !a.flat && !slopes_[at(hinge.b)].flat &&
               std::abs(dot(a.rise, unit(hinge.a_line.b - hinge.a_line.a))) >= kLeast &&
               assembly_.plates[at(hinge.a)].piece == assembly_.plates[at(hinge.b)].piece;
    }

    // Also says of each plate which step leads to it.
    Way way_over(const Piece& piece) {
        int first = -1;
        for (const int plate : piece.plates) {
            for (const int number : hinges_on_[at(plate)]) {
                if (rises(assembly_.hinges[at(number)]) && (first < 0 || number < first)) first = number;
            }
        }
        Way way;
        if (first < 0) return way;
        const auto step = [&](int plate, int from, const Segment& fold) {
            steps_of_[at(plate)] = static_cast<int>(way.steps.size());
            way.steps.push_back({plate, from, fold});
        };
        const Hinge& centre = assembly_.hinges[at(first)];
        for (const int plate : {centre.a, centre.b}) step(plate, -1, centre.a_line);
        for (std::size_t next = 0; next < way.steps.size(); ++next) {
            const int from = way.steps[next].plate;
            for (const int number : hinges_on_[at(from)]) {
                const Hinge& hinge = assembly_.hinges[at(number)];
                const int to = hinge.a == from ? hinge.b : hinge.a;
                if (rises(hinge) && steps_of_[at(to)] < 0) step(to, static_cast<int>(next), hinge.a_line);
            }
        }
        return way;
    }

    void level(const Piece& piece) {
        // The copies of each picture, by its number, in the order of the plates.
        std::map<int, std::vector<std::pair<int, Image*>>> pictures;
        for (const int plate : piece.plates) {
            for (Print& print : assembly_.plates[at(plate)].prints) {
                auto* image = std::get_if<Image>(&print);
                if (image != nullptr && image->horizon)
                    pictures[image->horizon->number].emplace_back(plate, image);
            }
        }
        if (pictures.empty()) return;
        const Way way = way_over(piece);
        for (auto& [number, copies] : pictures) level_copies(piece, way, copies);
        for (const int plate : piece.plates) drop_unseen(assembly_.plates[at(plate)]);
    }

    // One picture, on all plates of its page.
    void level_copies(const Piece& piece, const Way& way, std::vector<std::pair<int, Image*>>& copies) {
        const Image drawn = *copies.front().second;
        const Horizon horizon = *drawn.horizon;
        const std::vector<std::optional<Affine>> maps = maps_of(drawn, horizon, way);
        std::string flat;
        std::string upright;
        for (auto& [plate, image] : copies) {
            const Slope& slope = slopes_[at(plate)];
            const int step = steps_of_[at(plate)];
            std::optional<Affine> map;
            if (step >= 0) {
                map = maps[at(step)];
            } else if (!slope.flat) {
                map = alone(drawn, horizon, slope);
            }
            if (map) {
                move(*image, *map);
            } else if (shows(*image, assembly_.plates[at(plate)])) {
                std::string& first = slope.flat ? flat : upright;
                if (first.empty()) first = assembly_.plates[at(plate)].name;
            }
            image->horizon = Horizon{};  // done; drop_unseen() takes it off
        }
        if (!flat.empty()) {
            diagnostics_
                .remark("horizon-flat", horizon.place,
                        fmt::format("\"{}\" lies flat on the open card, so the picture on it has no horizon "
                                    "there and stays as it is",
                                    flat))
                .about(piece.name);
        }
        if (!upright.empty()) {
            diagnostics_
                .remark("horizon-upright", horizon.place,
                        fmt::format("the rows of the picture run too steeply on \"{}\" to be levelled, so it "
                                    "stays as it is there",
                                    upright))
                .hint("turn the picture, so that its rows run across the centre fold")
                .about(piece.name);
        }
    }

    // The map of page points for each step; none where the rows cannot be levelled.
    [[nodiscard]] std::vector<std::optional<Affine>> maps_of(const Image& image, const Horizon& horizon,
                                                             const Way& way) const {
        std::vector<std::optional<Affine>> maps(way.steps.size());
        const Vec2 row = image.place.x;
        for (std::size_t i = 0; i < maps.size(); ++i) {
            const Way::Step& step = way.steps[i];
            const std::optional<Affine> before = step.from < 0 ? Affine{} : maps[at(step.from)];
            if (!before) continue;
            const Vec2 along = unit(step.fold.b - step.fold.a);
            const auto shear = levelling(step.fold.a, along, left_of(along),
                                         before->point(row) - before->origin, slopes_[at(step.plate)].level);
            if (!shear) {
                // Else half of it would break away over the centre fold.
                if (step.from < 0) return std::vector<std::optional<Affine>>(way.steps.size());
                continue;
            }
            maps[i] = sheared(*before, *shear);
            if (step.from < 0 && horizon.row && horizon.height_mm) {
                const Vec2 on_row = row_begin(image, *horizon.row);
                // Where the row meets the fold, whose points stay.
                const double t = dot(left_of(along), step.fold.a - on_row) / dot(left_of(along), row);
                // The same on both sides of the fold.
                const Slope& slope = slopes_[at(way.steps.front().plate)];
                const double up = *horizon.height_mm - slope.height(on_row + t * row);
                maps[i]->origin = maps[i]->origin + (up / dot(slope.rise, along)) * along;
            }
        }
        return maps;
    }

    static Vec2 row_begin(const Image& image, double row) {
        return image.place.point({0.0, (1.0 - row) * image.height});
    }

    // Of a plate without a centre fold that rises.
    static std::optional<Affine> alone(const Image& image, const Horizon& horizon, const Slope& slope) {
        const Vec2 up = unit(slope.rise);
        const Vec2 middle = row_begin(image, horizon.row.value_or(0.5)) + 0.5 * image.width * image.place.x;
        const auto shear = levelling(middle, up, slope.level, image.place.x, slope.level);
        if (!shear) return std::nullopt;
        Affine map = sheared({}, *shear);
        if (horizon.row && horizon.height_mm) {
            map.origin = map.origin + ((*horizon.height_mm - slope.height(middle)) / length(slope.rise)) * up;
        }
        return map;
    }

    static void move(Image& image, const Affine& map) {
        Affine place;
        place.origin = map.point(image.place.origin);
        place.x = map.point(image.place.origin + image.place.x) - place.origin;
        place.y = map.point(image.place.origin + image.place.y) - place.origin;
        image.place = place;
        for (Polygon& clip : image.clip) {
            for (Vec2& p : clip.outer) p = map.point(p);
            for (Ring& hole : clip.holes) {
                for (Vec2& p : hole) p = map.point(p);
            }
        }
    }

    static bool shows(const Image& image, const Plate& plate) {
        return !intersect(shown_regions(image), {plate.outline}).empty();
    }

    static void drop_unseen(Plate& plate) {
        std::erase_if(plate.prints, [&plate](Print& print) {
            auto* image = std::get_if<Image>(&print);
            if (image == nullptr || !image->horizon) return false;
            image->horizon.reset();
            return !shows(*image, plate);
        });
    }

    Assembly& assembly_;
    Diagnostics& diagnostics_;
    std::vector<std::vector<int>> hinges_on_;  // of each plate
    std::vector<Slope> slopes_;
    std::vector<int> steps_of_;  // of each plate: the step of its piece's way that leads to it; -1: none
};

bool has_horizon(const Assembly& assembly) {
    return std::any_of(assembly.plates.begin(), assembly.plates.end(), [](const Plate& plate) {
        return std::any_of(plate.prints.begin(), plate.prints.end(), [](const Print& print) {
            const auto* image = std::get_if<Image>(&print);
            return image != nullptr && image->horizon;
        });
    });
}

}  // namespace

void level_horizons(Assembly& assembly, Diagnostics& diagnostics) {
    if (!has_horizon(assembly)) return;
    // A card that cannot be opened so far, as simulate() tells, has no open card to be seen on.
    std::vector<Frame> frames(assembly.plates.size());
    if (!moves(assembly) || !place(assembly, Angle::degrees(assembly.sweep.to_deg), frames))
        frames.assign(assembly.plates.size(), Frame{});
    Leveller(assembly, diagnostics).run(frames);
    settle_numbers(assembly);
}

}  // namespace popup
