#include "input/drawing/card/linkage.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/geometry/mend_ends.h"

namespace popup::drawing::card {
namespace {

constexpr double kPi = std::numbers::pi;
// Folds that lean less over the drive do not meet it, in radians.
constexpr double kLeastLean = 0.01;
// At less than the first of these angles no step folds (angled-step); at less than the second its side folds
// are meant to be parallel, unless they meet in one point of the drive to the rounding of a drawing.
constexpr double kLeastAngle = kPi / 180.0;
constexpr double kMeantAngle = 3.0 * kPi / 180.0;

// A line in coordinates of the drive: x along it, y to its left.
struct Seen {
    Vec2 a, b;
    [[nodiscard]] double middle() const { return 0.5 * (a.y + b.y); }
    [[nodiscard]] double lean() const { return std::abs(a.y - b.y); }
    // The end further from a point of the drive.
    [[nodiscard]] Vec2 far(double s) const {
        return length(a - Vec2{s, 0.0}) >= length(b - Vec2{s, 0.0}) ? a : b;
    }
};

Seen seen(const Drive& drive, const Segment& s) { return {drive.there(s.a), drive.there(s.b)}; }

double off_level(const Seen& line, double level) {
    return std::max(std::abs(line.a.y - level), std::abs(line.b.y - level));
}

// How far a line is from a ray out of (s, 0).
double off_ray(const Seen& line, double s, Vec2 way) {
    const Vec2 from{s, 0.0};
    return std::max(std::abs(cross(way, line.a - from)), std::abs(cross(way, line.b - from)));
}

// What the lines in the middle are, the nearest way; how far they are from it.
template <typename Off>
double name_mids(const std::vector<Seen>& mids, Off off_centre, std::vector<MidFold>& named) {
    named.clear();
    const auto off_drive = [](const Seen& line) { return off_level(line, 0.0); };
    if (mids.empty()) return 0.0;
    if (mids.size() == 1) {
        const double centre = off_centre(mids[0]);
        const bool is_drive = centre > kSnapMm && off_drive(mids[0]) < centre;
        named = {is_drive ? MidFold::drive : MidFold::centre};
        return is_drive ? off_drive(mids[0]) : centre;
    }
    if (mids.size() > 2) return HUGE_VAL;
    const double first = std::max(off_centre(mids[0]), off_drive(mids[1]));
    const double second = std::max(off_drive(mids[0]), off_centre(mids[1]));
    named = first <= second ? std::vector{MidFold::centre, MidFold::drive}
                            : std::vector{MidFold::drive, MidFold::centre};
    return std::min(first, second);
}

Linkage as_parallel(const Seen& left, const std::vector<Seen>& mids, const Seen& right) {
    Linkage made;
    made.left = left.middle();
    made.right = -right.middle();
    const double centre = made.left - made.right;
    made.off = name_mids(
        mids, [&](const Seen& line) { return off_level(line, centre); }, made.mids);
    made.off = std::max({made.off, 0.5 * left.lean(), 0.5 * right.lean()});
    if (made.left <= kSnapMm || made.right <= kSnapMm) made.off = HUGE_VAL;
    return made;
}

Linkage as_meeting(const Seen& left, const std::vector<Seen>& mids, const Seen& right) {
    Linkage made;
    made.parallel = false;
    made.off = HUGE_VAL;
    const auto meets = [](const Seen& line) -> std::optional<double> {
        const Vec2 along = line.b - line.a;
        if (std::abs(along.y) < kLeastLean * length(along)) return std::nullopt;
        return line.a.x - line.a.y / along.y * along.x;
    };
    const auto l = meets(left);
    const auto r = meets(right);
    if (!l || !r) return made;
    made.apex = 0.5 * (*l + *r);
    const Vec2 at{made.apex, 0.0};
    const Vec2 to_left = left.far(made.apex) - at;
    const Vec2 to_right = right.far(made.apex) - at;
    double a = std::atan2(to_left.y, to_left.x);
    double b = std::atan2(-to_right.y, to_right.x);
    if (a <= 0.0 || b <= 0.0 || a >= kPi || b >= kPi) return made;
    made.way = a + b <= kPi ? 1 : -1;
    if (made.way < 0) {
        a = kPi - a;
        b = kPi - b;
    }
    made.left_angle = a;
    made.right_angle = b;
    const Vec2 centre{made.way * std::cos(a - b), std::sin(a - b)};
    const double off = name_mids(
        mids, [&](const Seen& line) { return off_ray(line, made.apex, centre); }, made.mids);
    made.off =
        std::max({off, off_ray(left, made.apex, unit(to_left)), off_ray(right, made.apex, unit(to_right))});
    return made;
}

std::string reason(const Linkage& nearest, const std::vector<Seen>& mids) {
    if (!std::isfinite(nearest.off))
        return "its folds are neither parallel to the fold that it stands on nor meet in one point of it";
    if (nearest.mids.size() == 1 && mids.size() == 1 && nearest.parallel) {
        return fmt::format(
            "its middle fold lies {:.2f} mm from the fold it stands on, and folds flat only at {:.2f} mm",
            std::abs(mids[0].middle()), std::abs(nearest.left - nearest.right));
    }
    return fmt::format("its folds are {:.2f} mm off what would fold flat", nearest.off);
}

// The line through a point of the drive's coordinates, between where the ends of `drawn` are nearest to it.
Segment along(const Drive& drive, Vec2 at, Vec2 way, const Segment& drawn) {
    const auto onto = [&](Vec2 p) { return dot(way, drive.there(p) - at); };
    const auto [lo, hi] = std::minmax({onto(drawn.a), onto(drawn.b)});
    return {drive.back(at + lo * way), drive.back(at + hi * way)};
}

}  // namespace

Segment Linkage::left_line(const Drive& drive, const Segment& drawn) const {
    if (parallel) return along(drive, {0.0, left}, {1.0, 0.0}, drawn);
    // Away from where they meet, or towards it: its left plate is further from the drive.
    return along(drive, {apex, 0.0}, {std::cos(left_angle), way * std::sin(left_angle)}, drawn);
}

Segment Linkage::right_line(const Drive& drive, const Segment& drawn) const {
    if (parallel) return along(drive, {0.0, -right}, {1.0, 0.0}, drawn);
    return along(drive, {apex, 0.0}, {std::cos(right_angle), -way * std::sin(right_angle)}, drawn);
}

Segment Linkage::centre_line(const Drive& drive, const Segment& drawn) const {
    if (parallel) return along(drive, {0.0, left - right}, {1.0, 0.0}, drawn);
    const double turn = left_angle - right_angle;
    return along(drive, {apex, 0.0}, {std::cos(turn), way * std::sin(turn)}, drawn);
}

std::optional<Linkage> find_linkage(const Drive& drive, const Segment& left, const std::vector<Segment>& mids,
                                    const Segment& right, NoLinkage& why) {
    const Seen l = seen(drive, left);
    const Seen r = seen(drive, right);
    std::vector<Seen> between;
    between.reserve(mids.size());
    for (const Segment& s : mids) between.push_back(seen(drive, s));
    Linkage parallel = as_parallel(l, between, r);
    Linkage meeting = as_meeting(l, between, r);
    const double angle = std::max(meeting.left_angle, meeting.right_angle);
    const bool meant = angle < kLeastAngle || (angle < kMeantAngle && meeting.off > kSilentMm);
    const bool askew = parallel.off <= kSnapMm && meeting.off < HUGE_VAL && meant;
    Linkage& best = askew || parallel.off <= meeting.off ? parallel : meeting;
    if (best.off <= kSnapMm) return std::move(best);
    if (best.off < why.off || why.what.empty()) why = {reason(best, between), best.off};
    return std::nullopt;
}

bool runs_along(const Drive& drive, const Segment& line) {
    return off_level(seen(drive, line), 0.0) <= kSnapMm;
}

}  // namespace popup::drawing::card
