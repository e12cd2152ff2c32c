#include "output/apart.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "base/nth.h"
#include "base/text/numbers.h"
#include "output/space_mesh.h"

namespace popup {
namespace {

constexpr double kBetweenMm = 0.02;   // two papers that lie on one another
constexpr double kOneAboveMm = 0.04;  // between plates that are glued on one plate, perhaps over one another
constexpr double kClosedDeg = 2.0;    // less is as good as closed
constexpr double kClosedLayerMm = 0.2;  // between plates on the closed card
constexpr double kMostClosedMm = 3.0;   // of all of them

// Of each plate where it lies among the others on the closed card.
std::vector<double> closed_layers(const SceneCard& card) {
    const Assembly& assembly = *card.assembly;
    const std::size_t count = assembly.plates.size();
    if (assembly.covers.empty() || assembly.sweep.from_deg != 0.0 || !assembly.sweep.closed_flat) return {};
    const double step = std::min(kClosedLayerMm, kMostClosedMm / static_cast<double>(count));
    const double middle = 0.5 * static_cast<double>(count - 1);
    const auto place_of = [&](double number) { return rounded(step * (number - middle), 3); };
    std::vector<double> layers(count, 0.0);
    if (card.motion != nullptr && card.motion->examination && card.motion->examination->closed.order) {
        const std::vector<int>& order = *card.motion->examination->closed.order;
        for (std::size_t i = 0; i < order.size(); ++i)
            nth(layers, order[i]) = place_of(static_cast<double>(i));
    } else {
        nth(layers, assembly.covers.front()) = place_of(0.0);
        nth(layers, assembly.covers.back()) = place_of(static_cast<double>(count - 1));
    }
    return layers;
}

std::vector<int> parents_first(const Assembly& assembly) {
    std::vector<int> order;
    std::vector<char> done(assembly.plates.size(), 0);
    std::vector<int> way;
    for (std::size_t i = 0; i < done.size(); ++i) {
        way.clear();
        for (int k = static_cast<int>(i); k >= 0 && nth(done, k) == 0; k = nth(assembly.plates, k).parent) {
            nth(done, k) = 1;
            way.push_back(k);
        }
        order.insert(order.end(), way.rbegin(), way.rend());
    }
    return order;
}

}  // namespace

Apart::Apart(const SceneCard& card)
    : assembly_(*card.assembly), sheet_(*card.assembly), order_(parents_first(assembly_)) {
    if (!moves(assembly_)) return;
    open_ = open_layers(assembly_);
    closed_ = closed_layers(card);
    std::map<std::pair<int, Lying>, int> lying;  // how many lie on this side of a plate so far
    glued_.assign(assembly_.plates.size(), 0);
    for (std::size_t i = 0; i < glued_.size(); ++i) {
        const Plate& plate = assembly_.plates[i];
        if (plate.lying == Lying::free || plate.parent < 0) continue;
        const int above = ++lying[{plate.parent, plate.lying}];
        glued_[i] = plate.lying == Lying::on_front ? above : -above;
    }
}

std::vector<Vec3> Apart::lifts(const State& state) {
    const std::span<const Frame> frames = state.frames;
    std::vector<Vec3> lifts(frames.size());
    if (!moves(assembly_)) return lifts;
    if (sheet_.any()) {
        if (!state.opening_deg) return lifts;
        const double layer_mm = std::max(sheet_.layer_mm(), state.paper_mm + kBetweenMm);
        const std::vector<double> levels = sheet_.at(*state.opening_deg, frames);
        for (std::size_t i = 0; i < levels.size(); ++i) lifts[i] = layer_mm * levels[i] * frames[i].normal();
        return lifts;
    }
    const double layer_mm = std::max(kLayerMm, state.paper_mm + kBetweenMm);
    const double open = open_.empty() ? 0.0 : share_of_open(assembly_, frames);
    const bool closes = !closed_.empty() && state.opening_deg && !state.in_model;
    const double closed = closes ? std::max(0.0, 1.0 - *state.opening_deg / kClosedDeg) : 0.0;
    for (const int plate : order_) {
        Vec3& lift = nth(lifts, plate);
        const int parent = nth(assembly_.plates, plate).parent;
        if (parent >= 0) lift = nth(lifts, parent);
        if (const int glued = nth(glued_, plate); glued != 0 && !state.in_model) {
            const double by = layer_mm + kOneAboveMm * (std::abs(glued) - 1);
            lift = lift + (glued > 0 ? by : -by) * nth(frames, parent).normal();
        }
        if (open <= 0.0 || nth(open_, plate).page < 0) continue;
        lift = open * (layer_mm / kLayerMm) * nth(open_, plate).mm *
               nth(frames, nth(open_, plate).page).normal();
    }
    if (closed <= 0.0) return lifts;
    const double thick = std::max(1.0, layer_mm / kClosedLayerMm);
    const Vec3 across = closed * thick * nth(frames, assembly_.covers.front()).normal();
    for (std::size_t i = 0; i < lifts.size(); ++i) lifts[i] = lifts[i] + closed_[i] * across;
    return lifts;
}

}  // namespace popup
