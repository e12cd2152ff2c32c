#include "output/open_layers.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/geometry/pages.h"
#include "base/geometry/regions.h"
#include "output/poses.h"

namespace popup {
namespace {

constexpr double kLyingMm = 1e-3;     // this near to a page a corner lies on it
constexpr double kBeforeDeg = 1.0;    // where it is looked which of two plates is higher
constexpr double kAboveMm = 0.04;     // between what lies on one another
constexpr double kMostAboveMm = 1.0;  // all of that together
constexpr double kLeastMm2 = 1.0;     // of paper on paper
constexpr double kParallel = 1.0 - 1e-9;

std::size_t index(int number) { return static_cast<std::size_t>(number); }

// How high the corners of a plate are above a page, on the whole, and the height of the farthest.
struct Heights {
    double mean = 0.0, farthest = 0.0;
};
Heights heights_of(const Plate& plate, const Frame& frame, const Frame& page) {
    Heights heights;
    const Vec3 up = page.normal();
    for (const Vec2 p : plate.outline.outer) {
        const double height = dot(frame.point(p) - page.origin, up);
        heights.mean += height / static_cast<double>(plate.outline.outer.size());
        heights.farthest = std::max(heights.farthest, std::abs(height));
    }
    return heights;
}

// The page on which a plate lies; -1: none.
int page_under(const Assembly& assembly, int plate, std::span<const Frame> frames) {
    if (assembly.plates[index(plate)].lying != Lying::free) return -1;
    for (const int page : assembly.covers) {
        if (page == plate) return -1;
    }
    for (const int page : assembly.covers) {
        const Frame& on = frames[index(page)];
        const Frame& frame = frames[index(plate)];
        if (std::abs(dot(on.normal(), frame.normal())) < kParallel) continue;
        if (heights_of(assembly.plates[index(plate)], frame, on).farthest <= kLyingMm) return page;
    }
    return -1;
}

// Whether two plates of one plane have paper in one place.
bool share_paper(const Assembly& assembly, int a, int b, std::span<const Frame> frames) {
    const Polygon& outline = assembly.plates[index(b)].outline;
    const Polygon other =
        on_other_page(assembly.plates[index(a)].outline, frames[index(a)], frames[index(b)]);
    const Box one = bounds(other.outer);
    const Box two = bounds(outline.outer);
    if (one.max.x < two.min.x || two.max.x < one.min.x || one.max.y < two.min.y || two.max.y < one.min.y)
        return false;
    double paper = 0.0;
    for (const Polygon& part : intersect({other}, {outline})) paper += area(part);
    return paper > kLeastMm2;
}

// Takes away the pages of plates that share paper neither with their page nor with what lies there, too.
void leave_out_alone(const Assembly& assembly, std::span<const Frame> frames, std::vector<OpenLayer>& layers,
                     std::vector<int>& lying) {
    std::vector<char> shares(layers.size(), 0);
    for (std::size_t i = 0; i < lying.size(); ++i) {
        const int plate = lying[i];
        const int page = layers[index(plate)].page;
        if (shares[index(plate)] == 0 && share_paper(assembly, plate, page, frames)) shares[index(plate)] = 1;
        for (std::size_t k = 0; k < i; ++k) {
            const int other = lying[k];
            if (layers[index(other)].page != page || (shares[index(plate)] != 0 && shares[index(other)] != 0))
                continue;
            if (share_paper(assembly, plate, other, frames)) shares[index(plate)] = shares[index(other)] = 1;
        }
    }
    std::erase_if(lying, [&](int plate) {
        if (shares[index(plate)] != 0) return false;
        layers[index(plate)].page = -1;
        return true;
    });
}

// How far two pages are open, degrees; pages that face the same way are 180° apart.
double opening_of(const Assembly& assembly, std::span<const Frame> frames) {
    const Vec3 one = frames[index(assembly.covers.front())].normal();
    const Vec3 other = frames[index(assembly.covers.back())].normal();
    const Vec3 across = cross(one, other);
    const double turned = std::atan2(std::sqrt(dot(across, across)), dot(one, other));
    return 180.0 - turned * 180.0 / std::numbers::pi;
}

}  // namespace

std::vector<OpenLayer> open_layers(const Assembly& assembly) {
    if (assembly.covers.size() != 2 || assembly.sweep.to_deg < 90.0) return {};
    Diagnostics unheard;
    std::vector<Frame> frames(assembly.plates.size());
    if (!place_card(assembly, assembly.sweep.to_deg, frames, unheard)) return {};
    std::vector<OpenLayer> layers(assembly.plates.size());
    std::vector<int> lying;
    for (int i = 0; i < static_cast<int>(layers.size()); ++i) {
        layers[index(i)].page = page_under(assembly, i, frames);
        if (layers[index(i)].page >= 0) lying.push_back(i);
    }
    leave_out_alone(assembly, frames, layers, lying);
    if (lying.empty() || !place_card(assembly, assembly.sweep.to_deg - kBeforeDeg, frames, unheard))
        return {};
    std::vector<double> height(layers.size(), 0.0);
    for (const int i : lying) {
        height[index(i)] =
            heights_of(assembly.plates[index(i)], frames[index(i)], frames[index(layers[index(i)].page)])
                .mean;
    }
    // Halves of one element are as high as each other but for rounding: it must not say which comes first.
    for (double& one : height) one = std::round(one * 1e6) / 1e6;
    std::stable_sort(lying.begin(), lying.end(),
                     [&](int a, int b) { return height[index(a)] < height[index(b)]; });
    const double step = std::min(kAboveMm, kMostAboveMm / static_cast<double>(lying.size()));
    for (std::size_t rank = 0; rank < lying.size(); ++rank)
        layers[index(lying[rank])].mm = kOpenLayerMm + step * static_cast<double>(rank);
    return layers;
}

double share_of_open(const Assembly& assembly, std::span<const Frame> frames) {
    if (assembly.covers.size() != 2) return 0.0;
    const double left_deg = assembly.sweep.to_deg - opening_of(assembly, frames);
    return std::clamp(1.0 - left_deg / kOpenedDeg, 0.0, 1.0);
}

}  // namespace popup
