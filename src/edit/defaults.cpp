#include "edit/defaults.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "mechanism/measures.h"
#include "popup/assembly.h"

namespace popup::edit {
namespace {

// The length of fold that new elements need at least, for tabs and glued areas that hold: their sizes are
// shares of it.
struct LeastRoom {
    std::string_view family;
    double mm = 0.0;
    std::string_view measure = {};  // which is that large; empty: all are that no row before tells
    double most = 2.0;  // times as large, and no more: on shorter folds it would stick out everywhere
};
constexpr std::array<LeastRoom, 7> kLeastRooms{{{"tent", 30.0},
                                                {"layer", 30.0},
                                                {"box", 50.0, "", 2.5},
                                                {"v-fold", 60.0},
                                                {"pivot", 70.0},
                                                {"floating-layer", 110.0, "width", 4.0},
                                                {"floating-layer", 40.0}}};

// What bounds the free places of a plate: its edges, the seams on it, and the edges of what is glued flat on
// it.
std::vector<Segment> borders_on(const Assembly& assembly, int plate) {
    std::vector<Segment> made;
    const auto ring = [&made](const Ring& r) {
        for (std::size_t i = 0; i < r.size(); ++i) made.push_back({r[i], r[(i + 1) % r.size()]});
    };
    const auto add = [&](const Polygon& polygon) {
        ring(polygon.outer);
        for (const Ring& hole : polygon.holes) ring(hole);
    };
    add(assembly.plates[static_cast<std::size_t>(plate)].outline);
    for (const Glue& glue : assembly.glue) {
        if (glue.base_plate == plate) made.push_back(glue.on_base);
    }
    for (const GluedArea& area : assembly.glued_areas) {
        if (area.base_plate == plate) std::for_each(area.on_base.begin(), area.on_base.end(), add);
    }
    return made;
}

// A place on a plate, and how far it is to what bounds it.
struct FreePlace {
    Vec2 at;  // on the plate's page
    double radius_mm = 0.0;
};

double room_at(const Assembly& assembly, int plate, std::span<const Segment> borders, Vec2 p) {
    if (!contains(assembly.plates[static_cast<std::size_t>(plate)].outline, p)) return 0.0;
    for (const GluedArea& area : assembly.glued_areas) {
        const bool taken =
            area.base_plate == plate && std::any_of(area.on_base.begin(), area.on_base.end(),
                                                    [&](const Polygon& one) { return contains(one, p); });
        if (taken) return 0.0;
    }
    double room = std::numeric_limits<double>::infinity();
    for (const Segment& border : borders) room = std::min(room, distance(p, border));
    return room;
}

// Of a grid of places the one nearest to the middle that has so much room, or else the one that has most.
// With a coordinate that is given only places there are looked at.
FreePlace free_place(const Assembly& assembly, int plate, double wanted_mm, std::optional<double> x,
                     std::optional<double> y) {
    constexpr int kSteps = 40;
    const Ring& outer = assembly.plates[static_cast<std::size_t>(plate)].outline.outer;
    Vec2 low = outer.front();
    Vec2 high = low;
    for (const Vec2 p : outer) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
    if (x) low.x = high.x = *x;
    if (y) low.y = high.y = *y;
    const std::vector<Segment> borders = borders_on(assembly, plate);
    const Vec2 middle = 0.5 * (low + high);
    FreePlace best{middle, 0.0};
    double nearest_mm = std::numeric_limits<double>::infinity();
    for (int i = 0; i <= kSteps; ++i) {
        for (int k = 0; k <= kSteps; ++k) {
            const Vec2 p{low.x + (high.x - low.x) * i / kSteps, low.y + (high.y - low.y) * k / kSteps};
            const double far_mm = distance(p, middle);
            const double room = std::min(room_at(assembly, plate, borders, p), wanted_mm);
            if (room < best.radius_mm || (room == best.radius_mm && far_mm >= nearest_mm)) continue;
            best = {p, room};
            nearest_mm = far_mm;
        }
    }
    return best;
}

// Plates that a document calls "bird.left" and "box.frontleft" are "bird/left" and "box/front-left" in the
// assembly, and "sign" where they are all that there is of it: each of these as "box/frontleft".
std::string name_there(std::string name) {
    const std::size_t at = name.find_last_of("./");
    if (at == std::string::npos) return name;
    name[at] = '/';
    name.erase(std::remove(name.begin() + static_cast<std::ptrdiff_t>(at), name.end(), '-'), name.end());
    return name;
}

// The line beside which the points of what stands on a plate lie; nullopt: they lie on its page.
std::optional<Segment> line_of_plate(Session& session, const NamedGround& on) {
    if (!on.owner) return std::nullopt;
    const PlateInfo& plate = Session::info_of(session.design.structures[*on.owner]).plates[on.which];
    for (const CardFold& fold : session.card().folds) {
        if (plate.fold >= 0 && fold.owner == on.owner && fold.which == static_cast<std::size_t>(plate.fold))
            return plate.right ? fold.at.on_right : fold.at.on_left;
    }
    return std::nullopt;
}

}  // namespace

const ElementInfo& form_on(const ElementInfo& info, const PageFold& fold) {
    if (info.glued || fold.seam || fold.closed_deg == 180 || info.inverted == (fold.closed_deg == 360))
        return info;
    const auto table = element_table();
    const auto other = std::find_if(table.begin(), table.end(), [&](const ElementInfo& one) {
        return one.family == info.family && one.inverted != info.inverted;
    });
    return other == table.end() ? info : *other;
}

double room_for(const ElementInfo& info, std::string_view measure, double fold_mm) {
    for (const LeastRoom& least : kLeastRooms) {
        if (least.family == info.family && (least.measure.empty() || least.measure == measure))
            return std::max(fold_mm, std::min(least.mm, least.most * fold_mm));
    }
    return fold_mm;
}

double smaller_on(const ElementInfo& info, std::string_view measure, const PageFold& fold) {
    if (info.family != "pivot" || fold.closed_deg != 360) return 1.0;
    // Beside its apex the strip is as wide as half its angle lets it be; what is left still holds on it.
    return measure == "piecewidth" ? 0.5 : measure == "pieceheight" ? 2.0 / 3.0 : 1.0;
}

void put_on_plate(Session& session, Structure& made, const ElementInfo& info, const std::vector<bool>& given,
                  std::vector<double>& measures) {
    constexpr double kShareOfRoom = 0.9;
    const auto x = find_measure(info, "x");
    const auto y = find_measure(info, "y");
    if (!x || !y || (given[*x] && given[*y])) return;
    const auto line = line_of_plate(session, made.plate->on);
    if (line && (given[*x] || given[*y])) return;
    Diagnostics unheard;
    const auto checked = check(session.design, {}, unheard);
    const auto assembly = checked ? assemble(*checked, {}, unheard) : std::nullopt;
    if (!assembly) return;
    const std::string name = name_there(made.plate->on.text);
    const auto plate = std::find_if(assembly->plates.begin(), assembly->plates.end(), [&](const Plate& one) {
        const std::string there = name_there(one.name);
        return there == name || there + "/plate" == name;
    });
    if (plate == assembly->plates.end()) return;
    const auto width = find_measure(info, "width");
    const auto height = find_measure(info, "height");
    double wanted = width && height ? 0.5 * std::hypot(measures[*width], measures[*height]) : 0.0;
    const auto number = find_parameter(info, "radius");
    double radius = 0.0;
    const bool drawn = std::any_of(made.arguments.begin(), made.arguments.end(), is_drawn);
    if (number && !drawn) {
        const auto* own = std::get_if<double>(&made.argument(*number).value);
        radius = own != nullptr ? *own : info.parameters[*number].standard;
    }
    wanted = std::max(wanted, radius);
    const auto fixed = [&](std::size_t i) {
        return given[i] ? std::optional<double>(measures[i]) : std::nullopt;
    };
    const FreePlace place = free_place(*assembly, static_cast<int>(plate - assembly->plates.begin()),
                                       wanted / kShareOfRoom, fixed(*x), fixed(*y));
    if (place.radius_mm <= 0.0) return;
    Vec2 at = place.at;
    if (line) {
        const measure::Spot spot = measure::spot_of(line->a, line->b);
        at = {dot(place.at - spot.at, spot.right()), dot(place.at - spot.at, spot.up())};
    }
    measures[*x] = at.x;
    measures[*y] = at.y;
    const double smaller = kShareOfRoom * place.radius_mm / wanted;
    if (smaller >= 1.0) return;
    for (std::size_t i = 0; i < measures.size(); ++i) {
        if (!given[i] && info.measures[i].kind == MeasureKind::length && info.measures[i].share > 0.0)
            measures[i] *= smaller;
    }
    if (number && !drawn && !made.argument(*number).given())
        made.argument(*number).value = std::max(radius * smaller, info.parameters[*number].least);
}

}  // namespace popup::edit
