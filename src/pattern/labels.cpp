#include "pattern/labels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <vector>

#include "pattern/tabs.h"

namespace popup {
namespace {

constexpr std::array kHeights{4.0, 3.5, 3.0, 2.5, 2.0, 1.5};
// How much wider texts are tried.
constexpr std::array kWidenings{1.25, 1.5, 2.0, 3.0, 4.0, 6.0};
constexpr double kTabPadMm = 0.4;
constexpr double kPlatePadMm = 1.0;

// Whether a segment comes into the box about the origin that reaches `half` to each side.
bool meets_box(const Segment& s, Vec2 half) {
    double from = 0.0;
    double to = 1.0;
    const Vec2 along = s.b - s.a;
    const auto narrow = [&](double start, double step, double reach) {
        if (step == 0.0) return std::abs(start) <= reach;
        const double t0 = (-reach - start) / step;
        const double t1 = (reach - start) / step;
        from = std::max(from, std::min(t0, t1));
        to = std::min(to, std::max(t0, t1));
        return from <= to;
    };
    return narrow(s.a.x, along.x, half.x) && narrow(s.a.y, along.y, half.y);
}

}  // namespace

std::string upright_number(std::string_view number) {
    constexpr std::string_view kDigits = "01689";
    constexpr std::string_view kTurned = "01986";
    std::string turned;
    for (const char c : number) {
        const std::size_t digit = kDigits.find(c);
        if (digit == std::string_view::npos) return std::string(number);
        turned.insert(turned.begin(), kTurned[digit]);
    }
    const bool another = turned != number && !turned.starts_with('0');
    return std::string(number) + (another ? "." : "");
}

namespace {

// The place with the most depth for the largest text that fits, with letters that reach `below` its line, as
// a share of their height; if none does, for the smallest.
struct TabPlace {
    std::optional<TextSpot> spot;
    bool fits = false;
};
TabPlace deepest_place(std::span<const Ring> parts, std::string_view text, double below) {
    constexpr int kPlaces = 16;
    TabPlace place;
    for (const double height : kHeights) {
        double best_room = -1.0;
        const double half = 0.5 * text_width(text, height) + kTabPadMm;
        for (const Ring& part : parts) {
            const Box box = bounds(part);
            for (int i = 1; i < kPlaces; ++i) {
                const double at = box.min.x + box.width() * i / kPlaces;
                // Ties go to the middle.
                const double depth = least_depth(part, at - half, at + half);
                const double room = depth - 1e-3 * std::abs(i - kPlaces / 2);
                if (room > best_room) {
                    best_room = room;
                    place.spot = TextSpot{{at, 0.5 * depth}, height};
                }
            }
        }
        place.fits = place.spot && best_room >= (1.0 + 2.0 * below) * height + 2.0 * kTabPadMm - 0.01;
        if (place.fits) return place;
    }
    return place;
}

}  // namespace

std::optional<TextSpot> place_if_it_fits(std::span<const Ring> parts, std::string_view text) {
    // Names have letters that reach below the line, and stand in the middle of the tab by their capitals.
    constexpr double kDescent = 0.34;  // of the capitals' height
    const TabPlace place = deepest_place(parts, text, kDescent);
    return place.fits ? place.spot : std::nullopt;
}

std::optional<TextSpot> place_in_tab(std::span<const Ring> parts, std::string_view text) {
    const TabPlace place = deepest_place(parts, text, 0.0);
    if (place.fits) return place.spot;
    std::optional<TextSpot> best = place.spot;
    if (best && best->at.y > 0.0) return best;
    // No room at all: the smallest text, in the middle of the largest part.
    double largest = 0.0;
    for (const Ring& part : parts) {
        if (signed_area(part) <= largest) continue;
        largest = signed_area(part);
        Vec2 sum{};
        for (const Vec2 p : part) sum = sum + p;
        best = TextSpot{(1.0 / static_cast<double>(part.size())) * sum, kHeights.back()};
    }
    return best;
}

namespace {

struct Candidate {
    double room;
    Vec2 at;
    double clear;  // the distance to the plate's edges
};

constexpr int kGrid = 7;

void sort_by_room(std::vector<Candidate>& candidates) {
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Candidate& a, const Candidate& b) { return a.room > b.room; });
}

std::optional<Candidate> candidate_at(const EdgeIndex& plate, const DrawnLines* drawing, const Box& bounds,
                                      Vec2 at) {
    if (plate.winding(at) != 1) return std::nullopt;
    const double limit = 0.5 * std::max(bounds.width(), bounds.height());
    const double clear = plate.clearance(at, limit);
    double room = clear;
    if (drawing) room = std::min(room, drawing->at.clearance(at, limit) - drawing->half_width);
    if (room <= 0.0) return std::nullopt;
    return Candidate{std::round(1e3 * room), at, clear};
}

// Places on the plate in a grid over its box, the roomiest first.
std::vector<Candidate> candidates_on(const EdgeIndex& plate, const DrawnLines* drawing, const Box& bounds) {
    constexpr std::size_t kTried = 12;
    std::vector<Candidate> candidates;
    for (int row = 0; row < kGrid; ++row) {
        for (int column = 0; column < kGrid; ++column) {
            const Vec2 at{bounds.min.x + bounds.width() * (column + 0.5) / kGrid,
                          bounds.min.y + bounds.height() * (row + 0.5) / kGrid};
            if (const auto one = candidate_at(plate, drawing, bounds, at)) candidates.push_back(*one);
        }
    }
    sort_by_room(candidates);
    if (candidates.size() > kTried) candidates.resize(kTried);
    return candidates;
}

// The first of them moved to where there is more room, as between the edges of a ring that the grid misses.
std::vector<Candidate> climbed(std::vector<Candidate> candidates, const EdgeIndex& plate,
                               const DrawnLines* drawing, const Box& bounds) {
    constexpr std::size_t kMoved = 8;
    constexpr int kHalvings = 5;
    constexpr std::array<Vec2, 8> kWays{
        {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {1, -1}, {-1, 1}, {-1, -1}}};
    if (candidates.size() > kMoved) candidates.resize(kMoved);
    for (Candidate& one : candidates) {
        Vec2 step{0.5 * bounds.width() / kGrid, 0.5 * bounds.height() / kGrid};
        for (int i = 0; i < kHalvings; ++i, step = 0.5 * step) {
            const Vec2 from = one.at;
            for (const Vec2 way : kWays) {
                const auto there =
                    candidate_at(plate, drawing, bounds, from + Vec2{step.x * way.x, step.y * way.y});
                if (there && there->room > one.room) one = *there;
            }
        }
    }
    sort_by_room(candidates);
    return candidates;
}

std::optional<TextSpot> place_among(const EdgeIndex& plate, const DrawnLines* drawing, const Box& bounds,
                                    std::string_view text) {
    std::vector<int> found;
    const auto clear_of = [&](const EdgeIndex& index, Vec2 at, Vec2 half) {
        index.query({at - half, at + half}, found);
        return std::none_of(found.begin(), found.end(), [&](int i) {
            return meets_box({index[i].a - at, index[i].b - at}, half);
        });
    };
    const auto is_free = [&](const Candidate& place, Vec2 half) {
        const Vec2 at = place.at;
        // Most places are too near to an edge, or far from all of them: then nothing has to be looked for.
        constexpr double kSurelyMm = 1e-6;
        if (place.clear < std::min(half.x, half.y) - kSurelyMm) return false;
        const Vec2 low = at - half - bounds.min;
        const Vec2 high = bounds.max - at - half;
        if (std::min({low.x, low.y, high.x, high.y}) < -kSurelyMm) return false;
        if (place.clear < length(half) + kSurelyMm && !clear_of(plate, at, half)) return false;
        return !drawing || clear_of(drawing->at, at, half + Vec2{drawing->half_width, drawing->half_width});
    };
    const auto half_of = [text](double height, double times) {
        return Vec2{0.5 * times * text_width(text, height) + kPlatePadMm, 0.5 * height + kPlatePadMm};
    };
    const auto room_at = [&](const Candidate& place, double height, bool upward) {
        double room = 1.0;
        for (const double times : kWidenings) {
            const Vec2 half = half_of(height, times);
            if (!is_free(place, upward ? Vec2{half.y, half.x} : half)) break;
            room = times;
        }
        return room;
    };
    const auto largest = [&](const std::vector<Candidate>& candidates, double above) {
        for (const double height : kHeights) {
            if (height <= above) break;
            const Vec2 half = half_of(height, 1.0);
            for (const Candidate& candidate : candidates) {
                if (is_free(candidate, half))
                    return std::optional(
                        TextSpot{candidate.at, height, 0.0, room_at(candidate, height, false)});
            }
            for (const Candidate& candidate : candidates) {
                if (is_free(candidate, {half.y, half.x}))
                    return std::optional(TextSpot{candidate.at, height, 0.5 * std::numbers::pi,
                                                  room_at(candidate, height, true)});
            }
        }
        return std::optional<TextSpot>();
    };
    const std::vector<Candidate> candidates = candidates_on(plate, drawing, bounds);
    const std::optional<TextSpot> spot = largest(candidates, 0.0);
    if (candidates.empty() || (spot && spot->height == kHeights.front())) return spot;
    const auto larger = largest(climbed(candidates, plate, drawing, bounds), spot ? spot->height : 0.0);
    return larger ? larger : spot;
}

}  // namespace

std::optional<TextSpot> place_on_plate(const EdgeIndex& plate, const Drawing& drawing, const Box& bounds,
                                       std::string_view text) {
    if (drawing.all.at.size() > 0) {
        if (const auto spot = place_among(plate, &drawing.all, bounds, text)) return spot;
    }
    return place_among(plate, drawing.texts.at.size() > 0 ? &drawing.texts : nullptr, bounds, text);
}

}  // namespace popup
