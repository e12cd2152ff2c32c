#include "output/examination_json.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/text/numbers.h"

namespace popup {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kAngle = 3;      // decimals of a degree
constexpr int kLength = 4;     // of a millimetre
constexpr int kPoint = 3;      // of a millimetre
constexpr int kDirection = 6;  // of a unit vector

Json vector(Vec3 v, int decimals) {
    return Json::array({rounded(v.x, decimals), rounded(v.y, decimals), rounded(v.z, decimals)});
}

Json vector(Vec2 v, int decimals) { return Json::array({rounded(v.x, decimals), rounded(v.y, decimals)}); }

// What is 1e-9 above a whole thousandth is that thousandth.
double rounded_up_deg(double angle) { return rounded(std::ceil(angle * 1e3 - 1e-6) / 1e3, kAngle); }

// Writes rows about plates of one assembly.
class Rows {
 public:
    explicit Rows(const Assembly& assembly) : assembly_(assembly) {}

    [[nodiscard]] Json name(int plate) const {
        return assembly_.plates.at(static_cast<std::size_t>(plate)).name;
    }
    [[nodiscard]] Json names(const std::vector<int>& plates) const {
        Json list = Json::array();
        for (const int plate : plates) list.push_back(name(plate));
        return list;
    }
    template <typename Finding>
    [[nodiscard]] Json pair(const Finding& one) const {
        return {{"plates", names({one.a, one.b})},
                {"from_deg", told_deg(one.from_deg)},
                {"to_deg", told_deg(one.to_deg)}};
    }
    [[nodiscard]] Json row(const Contact& one) const {
        Json row = pair(one);
        row["angle_deg"] = told_deg(one.to_deg);
        row["depth_mm"] = told_mm(one.depth_mm);
        row["deepest_deg"] = told_deg(one.deepest_deg);
        row["excess_mm"] = told_mm(one.excess_mm);
        row["longer"] = name(one.longer);
        row["at_fold"] = one.at_fold;
        row["corner_mm"] = vector(one.corner, kPoint);
        row["point_mm"] = vector(one.point, kPoint);
        return row;
    }
    [[nodiscard]] Json row(const FreePlates& one) const {
        return {{"plates", names(one.plates)}, {"free", one.ways}};
    }
    [[nodiscard]] Json row(const Undecided& one) const { return pair(one); }
    [[nodiscard]] Json row(const Approach& one) const {
        Json row = pair(one);
        row["least_mm"] = told_mm(one.least_mm);
        row["least_deg"] = told_deg(one.least_deg);
        row["point_mm"] = vector(one.point, kPoint);
        return row;
    }
    [[nodiscard]] Json row(const Protrusion& one) const {
        return {{"plate", name(one.plate)},
                {"by_mm", told_mm(one.by_mm)},
                {"direction", vector(one.direction, kDirection)},
                {"point_mm", vector(one.point, kPoint)},
                {"corner_mm", vector(one.corner, kPoint)}};
    }
    template <typename Finding>
    [[nodiscard]] Json list(const std::vector<Finding>& findings) const {
        Json all = Json::array();
        for (const Finding& one : findings) all.push_back(row(one));
        return all;
    }

 private:
    const Assembly& assembly_;
};

}  // namespace

double told_deg(double angle_deg) { return rounded(angle_deg, kAngle); }
double told_mm(double length_mm) { return rounded(length_mm, kLength); }

Json not_forced_json(const Assembly& assembly, const std::vector<FreePlates>& all) {
    return Rows(assembly).list(all);
}

Json examination_json(const Assembly& assembly, const std::optional<Examination>& examination) {
    if (!examination) {
        Json nothing;
        for (const char* member :
             {"collisions", "undecided_below_deg", "decided_up_to_deg", "undecided", "clearance",
              "protrusion_mm", "protrusions", "max_layers", "layer_order", "closed_thickness_mm"}) {
            nothing[member] = nullptr;
        }
        return nothing;
    }
    const Examination& found = *examination;
    const ClosedCard& closed = found.closed;
    const Rows rows(assembly);
    double protrusion = 0.0;
    for (const Protrusion& one : closed.protrusions) protrusion = std::max(protrusion, one.by_mm);
    Json result{{"collisions", rows.list(found.contacts)},
                {"undecided_below_deg", rounded_up_deg(found.undecided_below_deg)},
                {"decided_up_to_deg", rounded(found.decided_up_to_deg, kAngle)},
                {"undecided", rows.list(found.undecided)},
                {"clearance", found.approaches ? rows.list(*found.approaches) : Json()},
                {"protrusion_mm", told_mm(protrusion)},
                {"protrusions", rows.list(closed.protrusions)},
                {"max_layers", closed.max_layers > 0 ? Json(closed.max_layers) : Json()},
                {"layer_order", closed.order ? rows.names(*closed.order) : Json()}};
    if (!closed.cycle.empty()) result["layer_cycle"] = rows.names(closed.cycle);
    result["closed_thickness_mm"] = closed.thickness_mm ? Json(told_mm(*closed.thickness_mm)) : Json();
    return result;
}

}  // namespace popup
