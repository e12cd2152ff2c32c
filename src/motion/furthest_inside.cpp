#include "motion/furthest_inside.h"

#include <algorithm>
#include <cmath>

namespace popup {
namespace {

// How exactly the point is found, if that does not take too many looks.
constexpr double kInsideMm = 1e-6;
constexpr double kInsideShare = 0.002;
constexpr int kMostLooks = 400;
constexpr double kLevelMm = 1e-9;   // a chord that rises by less than this is level
constexpr double kLeastPart = 0.1;  // of what is split

}  // namespace

double FurthestInside::Wall::distance(double t) const {
    const double before = t - at;
    const double foot = cosine * before - sine * off;
    if (foot <= 0.0) return std::sqrt(before * before + off * off);
    if (foot < length) return std::abs(cosine * off + sine * before);
    const double behind = before - length * cosine;
    const double over = off + length * sine;
    return std::sqrt(behind * behind + over * over);
}

void FurthestInside::add(Segment edge) {
    const Vec2 along = edge.b - edge.a;
    const double size = std::sqrt(dot(along, along));
    if (size > 0.0) {
        walls_.push_back({edge.a.x, edge.a.y, along.x / size, along.y / size, size});
    } else {
        walls_.push_back({edge.a.x, edge.a.y, 1.0, 0.0, 0.0});
    }
}

double FurthestInside::inside(double t, double far_mm) const {
    for (const Wall& wall : near_) far_mm = std::min(far_mm, wall.distance(t));
    return far_mm;
}

std::size_t FurthestInside::lowest(double share) const {
    std::size_t lowest = 0;
    for (std::size_t i = 1; i < chords_.size(); ++i) {
        if (chords_[i].mm(share) < chords_[lowest].mm(share)) lowest = i;
    }
    return lowest;
}

FurthestInside::Part FurthestInside::look(double from, double to, double far_mm) {
    const auto part = [&](double share, double bound) {
        return Part{from, to, std::lerp(from, to, std::clamp(share, 0.0, 1.0)), bound};
    };
    chords_.clear();
    chords_.push_back({far_mm, far_mm});
    for (const Wall& wall : near_) chords_.push_back({wall.distance(from), wall.distance(to)});
    // From both ends to the chords that are lowest in between.
    Chord rising = chords_[lowest(0.0)];
    if (rising.rise() <= kLevelMm) return part(0.0, std::max(rising.first, rising.last));
    Chord falling = chords_[lowest(1.0)];
    if (falling.rise() >= -kLevelMm) return part(1.0, std::max(falling.first, falling.last));
    const auto meet = [](const Chord& one, const Chord& other) {
        return (other.first - one.first) / (one.rise() - other.rise());
    };
    for (std::size_t looks = 0;; ++looks) {
        const double share = std::clamp(meet(rising, falling), 0.0, 1.0);
        const double bound = std::max(rising.mm(share), falling.mm(share));
        const Chord low = chords_[lowest(share)];
        if (low.mm(share) >= bound - kLevelMm || looks == chords_.size()) return part(share, bound);
        if (std::abs(low.rise()) <= kLevelMm)
            return part(0.5 * (meet(rising, low) + meet(low, falling)), std::max(low.first, low.last));
        (low.rise() > 0.0 ? rising : falling) = low;
    }
}

FurthestInside::Found FurthestInside::find(double from, double to, double far_mm) {
    const double middle = 0.5 * (from + to);
    near_ = walls_;
    Found best{middle, inside(middle, far_mm), 0.0};
    // What is further away than this is nowhere the nearest.
    const double most = best.inside_mm + (to - from);
    std::erase_if(near_, [&](const Wall& wall) { return wall.distance(middle) > most; });
    const auto enough = [&] { return best.inside_mm + std::max(kInsideMm, kInsideShare * best.inside_mm); };
    const auto lower = [](const Part& p, const Part& q) { return p.bound < q.bound; };
    parts_.assign(1, look(from, to, far_mm));
    for (int looks = 1; looks < kMostLooks && parts_.front().bound > enough(); ++looks) {
        std::pop_heap(parts_.begin(), parts_.end(), lower);
        const Part part = parts_.back();
        parts_.pop_back();
        const double here = inside(part.peak, far_mm);
        if (here > best.inside_mm) {
            best.at = part.peak;
            best.inside_mm = here;
        }
        const double least = kLeastPart * (part.to - part.from);
        const double split = std::clamp(part.peak, part.from + least, part.to - least);
        for (const Part& half : {look(part.from, split, far_mm), look(split, part.to, far_mm)}) {
            parts_.push_back(half);
            std::push_heap(parts_.begin(), parts_.end(), lower);
        }
    }
    best.at_most_mm = std::max(best.inside_mm, parts_.front().bound);
    return best;
}

}  // namespace popup
