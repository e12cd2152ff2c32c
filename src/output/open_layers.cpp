#include "output/open_layers.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/geometry/near_boxes.h"
#include "base/geometry/pages.h"
#include "base/geometry/regions.h"
#include "base/nth.h"
#include "output/common_paper.h"
#include "output/poses.h"

namespace popup {
namespace {

constexpr double kLyingMm = 1e-3;     // this near to a page a corner lies on it
constexpr double kBeforeDeg = 1.0;    // where it is looked which of two plates is higher
constexpr double kAboveMm = 0.04;     // between what lies on one another
constexpr double kMostAboveMm = 1.0;  // all of that together
constexpr double kParallel = 1.0 - 1e-9;
// Of boxes that touch on a page. What lies in a heap of more is told apart as far as it was looked at.
constexpr std::size_t kMostTouching = 200'000;

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
    if (nth(assembly.plates, plate).lying != Lying::free) return -1;
    for (const int page : assembly.covers) {
        if (page == plate) return -1;
    }
    for (const int page : assembly.covers) {
        const Frame& on = nth(frames, page);
        const Frame& frame = nth(frames, plate);
        if (std::abs(dot(on.normal(), frame.normal())) < kParallel) continue;
        if (heights_of(nth(assembly.plates, plate), frame, on).farthest <= kLyingMm) return page;
    }
    return -1;
}

// What lies on one page: where, on that page.
struct Flat {
    int plate = 0;
    Polygon outline;
    Box box;
};
std::vector<Flat> flats_on(int page, const Assembly& assembly, std::span<const Frame> frames,
                           std::span<const OpenLayer> layers, std::span<const int> lying) {
    std::vector<Flat> flats;
    for (const int plate : lying) {
        if (nth(layers, plate).page != page) continue;
        Polygon outline =
            on_other_page(nth(assembly.plates, plate).outline, nth(frames, plate), nth(frames, page));
        const Box box = bounds(outline.outer);
        flats.push_back({plate, std::move(outline), box});
    }
    return flats;
}

// Marks those that share paper with the page. It may have a hole for each of them: only those near one count.
void share_with_page(const Polygon& page, const std::vector<Flat>& flats, std::vector<char>& shares) {
    std::vector<Box> holes;
    holes.reserve(page.holes.size());
    for (const Ring& hole : page.holes) holes.push_back(bounds(hole));
    for (const Flat& flat : flats) {
        Polygon near{page.outer, {}};
        for (std::size_t i = 0; i < holes.size(); ++i) {
            if (touch(holes[i], flat.box)) near.holes.push_back(page.holes[i]);
        }
        if (!common_paper(near, flat.outline).empty()) nth(shares, flat.plate) = 1;
    }
}

void share_with_others(const std::vector<Flat>& flats, std::vector<char>& shares) {
    std::vector<SpaceBox> boxes;
    boxes.reserve(flats.size());
    for (const auto& [plate, outline, box] : flats)
        boxes.push_back({{box.min.x, box.min.y, 0.0}, {box.max.x, box.max.y, 0.0}});
    for (const auto& [first, second] : near_pairs(boxes, kMostTouching)) {
        const Flat& a = nth(flats, first);
        const Flat& b = nth(flats, second);
        if (nth(shares, a.plate) != 0 && nth(shares, b.plate) != 0) continue;
        if (!common_paper(a.outline, b.outline).empty()) nth(shares, a.plate) = nth(shares, b.plate) = 1;
    }
}

// Takes away the pages of plates that share paper neither with their page nor with what lies there, too.
void leave_out_alone(const Assembly& assembly, std::span<const Frame> frames, std::vector<OpenLayer>& layers,
                     std::vector<int>& lying) {
    std::vector<char> shares(layers.size(), 0);
    for (const int page : assembly.covers) {
        const std::vector<Flat> flats = flats_on(page, assembly, frames, layers, lying);
        share_with_page(nth(assembly.plates, page).outline, flats, shares);
        share_with_others(flats, shares);
    }
    std::erase_if(lying, [&](int plate) {
        if (nth(shares, plate) != 0) return false;
        nth(layers, plate).page = -1;
        return true;
    });
}

// How far two pages are open, degrees; pages that face the same way are 180° apart.
double opening_of(const Assembly& assembly, std::span<const Frame> frames) {
    const Vec3 one = nth(frames, assembly.covers.front()).normal();
    const Vec3 other = nth(frames, assembly.covers.back()).normal();
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
        nth(layers, i).page = page_under(assembly, i, frames);
        if (nth(layers, i).page >= 0) lying.push_back(i);
    }
    leave_out_alone(assembly, frames, layers, lying);
    if (lying.empty() || !place_card(assembly, assembly.sweep.to_deg - kBeforeDeg, frames, unheard))
        return {};
    std::vector<double> height(layers.size(), 0.0);
    for (const int i : lying) {
        nth(height, i) =
            heights_of(nth(assembly.plates, i), nth(frames, i), nth(frames, nth(layers, i).page)).mean;
    }
    // Halves of one element are as high as each other but for rounding: it must not say which comes first.
    for (double& one : height) one = std::round(one * 1e6) / 1e6;
    std::stable_sort(lying.begin(), lying.end(),
                     [&](int a, int b) { return nth(height, a) < nth(height, b); });
    const double step = std::min(kAboveMm, kMostAboveMm / static_cast<double>(lying.size()));
    for (std::size_t rank = 0; rank < lying.size(); ++rank)
        nth(layers, lying[rank]).mm = kOpenLayerMm + step * static_cast<double>(rank);
    return layers;
}

double share_of_open(const Assembly& assembly, std::span<const Frame> frames) {
    if (assembly.covers.size() != 2) return 0.0;
    const double left_deg = assembly.sweep.to_deg - opening_of(assembly, frames);
    return std::clamp(1.0 - left_deg / kOpenedDeg, 0.0, 1.0);
}

}  // namespace popup
