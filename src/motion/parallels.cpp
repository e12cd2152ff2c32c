#include "motion/parallels.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "base/geometry/tolerances.h"
#include "motion/joints/joint.h"
#include "motion/sweep.h"
#include "popup/motion.h"

namespace popup {
namespace {

// Below this the planes are as good as parallel, and where they cross is not known.
constexpr double kLeastSine = 1e-3;
// Points of a plate deeper than kTouchMm inside its edges have those this far to either side on it, too.
constexpr double kLineAsideMm = 0.5 * kTouchMm;

std::size_t at(int number) { return static_cast<std::size_t>(number); }

struct Stretch {
    double from, to;
};

// Where a line of the page, p + s * along, runs on the plate: ascending.
std::vector<Stretch> stretches(const PlateShape& shape, Vec2 p, Vec2 along) {
    std::vector<double> ends;
    for (const std::vector<Vec2>& ring : shape.rings) {
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const Vec2 a = ring[i] - p;
            const Vec2 b = ring[i + 1 == ring.size() ? 0 : i + 1] - p;
            const double from = cross(along, a);
            const double to = cross(along, b);
            if ((from > 0.0) == (to > 0.0)) continue;
            ends.push_back(dot(along, lerp(a, b, from / (from - to))));
        }
    }
    std::sort(ends.begin(), ends.end());
    std::vector<Stretch> result;
    for (std::size_t i = 0; i + 1 < ends.size(); i += 2) result.push_back({ends[i], ends[i + 1]});
    return result;
}

std::vector<Stretch> common(const std::vector<Stretch>& a, const std::vector<Stretch>& b) {
    std::vector<Stretch> result;
    for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
        const Stretch both{std::max(a[i].from, b[j].from), std::min(a[i].to, b[j].to)};
        if (both.from < both.to) result.push_back(both);
        (a[i].to < b[j].to ? i : j)++;
    }
    return result;
}

// Where points of the line may lie deeper than kTouchMm inside the edges.
std::vector<Stretch> deep(const PlateShape& shape, Vec2 p, Vec2 along) {
    const Vec2 beside = kLineAsideMm * left_of(along);
    return common(stretches(shape, p + beside, along), stretches(shape, p - beside, along));
}

}  // namespace

Parallels::Parallels(const Assembly& assembly, std::span<const PlateShape> shapes)
    : assembly_(assembly), shapes_(shapes) {
    found_families();
}

// Whether both turn about one line of each: a hinge, or the line that drives them.
bool Parallels::share_a_line(int a, int b) const {
    const auto joins = [&](const Hinge& hinge) {
        return (hinge.a == a && hinge.b == b) || (hinge.a == b && hinge.b == a);
    };
    if (std::any_of(assembly_.hinges.begin(), assembly_.hinges.end(), joins)) return true;
    // What the world drives has its page in the world as the open card lies.
    std::vector<JointTurn> driven;
    for (const Joint& joint : assembly_.joints) {
        for (const JointTurn& turn : turns_of(joint).turns) {
            if (turn.other < 0 && (turn.plate == a || turn.plate == b)) driven.push_back(turn);
        }
    }
    return driven.size() == 2 && std::abs(cross(driven[0].dir, driven[1].dir)) < kRoundingMm &&
           std::abs(cross(driven[0].dir, driven[1].at - driven[0].at)) < kRoundingMm;
}

void Parallels::found_families() {
    members_.resize(assembly_.plates.size());
    std::map<std::pair<int, int>, int> families;  // by the lower plate of the two; -1: they share no line
    const auto join = [this](int plate, int family, bool of_back) {
        Member& member = members_[at(plate)];
        if (assembly_.plates[at(plate)].rivet || member.family >= 0) return;
        member = {family, of_back};
    };
    for (const Joint& joint : assembly_.joints) {
        const std::optional<Parallelism> how = parallelism(joint);
        if (!how) continue;
        const std::pair<int, int> pair = std::minmax(how->like, how->carrier);
        const auto [known, fresh] = families.try_emplace(pair, -1);
        if (fresh && share_a_line(pair.first, pair.second)) known->second = pair.first;
        if (known->second < 0) continue;
        // The lower of the two stands for the back.
        join(how->plate, known->second, how->like == pair.first);
        join(how->like, known->second, how->like == pair.first);
        join(how->carrier, known->second, how->carrier == pair.first);
    }
    if (families.empty()) return;
    frames_.resize(assembly_.plates.size());
    if (!place(assembly_, Angle::degrees(opening_at(assembly_.sweep, kTellingDegs[0])), frames_))
        frames_.clear();
}

bool Parallels::keep_apart(int a, int b) {
    if (frames_.empty()) return false;
    const Member& one = members_[at(a)];
    const Member& other = members_[at(b)];
    if (one.family < 0 || one.family != other.family) return false;
    if (one.of_back == other.of_back) return true;
    const auto [known, fresh] = known_.try_emplace(std::minmax(a, b), false);
    if (fresh) known->second = look(a, b);
    return known->second;
}

bool Parallels::look(int a, int b) const {
    const Frame& one = frames_[at(a)];
    const Frame& other = frames_[at(b)];
    const Vec3 line = cross(one.normal(), other.normal());
    const double sine = length(line);
    if (sine < kLeastSine) return false;
    const Vec3 along = (1.0 / sine) * line;
    // A point of both planes: from a's origin square to the line, until it is in b's plane.
    const Vec3 across = cross(along, one.normal());
    const double away = dot(other.origin - one.origin, other.normal()) / dot(across, other.normal());
    const Vec3 point = one.origin + away * across;
    const auto on = [&](const Frame& frame, int plate) {
        const Vec3 from = point - frame.origin;
        const Vec2 p{dot(from, frame.axes[0]), dot(from, frame.axes[1])};
        const Vec2 direction = unit(Vec2{dot(along, frame.axes[0]), dot(along, frame.axes[1])});
        return deep(shapes_[at(plate)], p, direction);
    };
    // What is shorter has no point further than kTouchMm inside the edges of both.
    for (const Stretch& both : common(on(one, a), on(other, b))) {
        if (both.to - both.from > 2.0 * kTouchMm) return false;
    }
    return true;
}

}  // namespace popup
