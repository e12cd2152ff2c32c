#include "fabrication/joints.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace popup {
namespace {

constexpr double kJointEveryMm = 150.0;
constexpr double kClearMm = 0.5;      // at least, from the gap's end
constexpr double kWellClearMm = 5.0;  // more is no better
constexpr double kJointsApartMm = 2.0;
constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kCorner = 15.0 * kDegree;   // sharper turns are corners
constexpr double kStraight = 1.0 * kDegree;  // over a gap and what is clear of it
constexpr double kNearlyStraight = 12.0 * kDegree;
constexpr int kPlaces = 32;  // looked at for each joint

// A path by the length along it.
class Track {
 public:
    explicit Track(const OuterCut& cut) : closed_(cut.closed) {
        for (const Vec2 p : cut.points) {
            if (points_.empty() || distance(points_.back(), p) > 1e-9) points_.push_back(p);
        }
        if (closed_ && points_.size() > 1) points_.push_back(points_.front());
        at_.push_back(0.0);
        for (std::size_t i = 1; i < points_.size(); ++i)
            at_.push_back(at_.back() + distance(points_[i - 1], points_[i]));
        find_turns();
    }

    [[nodiscard]] double length() const { return at_.back(); }
    [[nodiscard]] bool closed() const { return closed_; }
    [[nodiscard]] Vec2 point(double place) const {
        const std::size_t i = segment_of(place);
        const double whole = at_[i + 1] - at_[i];
        return lerp(points_[i], points_[i + 1], whole > 0.0 ? (place - at_[i]) / whole : 0.0);
    }
    // How much the path turns between two places, 0 ≤ from ≤ to ≤ length().
    [[nodiscard]] double turn(double from, double to) const {
        const auto first = std::lower_bound(at_.begin(), at_.end(), from) - at_.begin();
        const auto last = std::upper_bound(at_.begin(), at_.end(), to) - at_.begin();
        if (first >= last) return 0.0;
        return turned_[static_cast<std::size_t>(last)] - turned_[static_cast<std::size_t>(first)];
    }
    // To the nearest corner or end of the path, along it; no more than the path is long.
    [[nodiscard]] double clear_of_corners(double place) const {
        if (corners_.empty()) return length();
        const auto next = std::lower_bound(corners_.begin(), corners_.end(), place);
        const double after = next != corners_.end() ? *next - place : corners_.front() + length() - place;
        const double before =
            next != corners_.begin() ? place - *(next - 1) : place + length() - corners_.back();
        return std::min(before, after);
    }
    // What lies between two places.
    [[nodiscard]] std::vector<Vec2> part(double from, double to) const {
        std::vector<Vec2> part{point(from)};
        for (std::size_t i = 0; i < at_.size(); ++i) {
            if (at_[i] > from + 1e-9 && at_[i] < to - 1e-9) part.push_back(points_[i]);
        }
        part.push_back(point(to));
        return part;
    }

 private:
    [[nodiscard]] std::size_t segment_of(double place) const {
        const auto next = std::upper_bound(at_.begin(), at_.end(), place) - at_.begin();
        return static_cast<std::size_t>(
            std::clamp<std::ptrdiff_t>(next - 1, 0, static_cast<std::ptrdiff_t>(at_.size()) - 2));
    }
    void find_turns() {
        const std::size_t n = points_.size();
        turned_.assign(n + 1, 0.0);
        for (std::size_t i = 0; i < n; ++i) {
            const bool end = i == 0 || i + 1 == n;
            double turn = std::numbers::pi;
            if (!end || closed_) {
                const Vec2 in = points_[i] - points_[i == 0 ? n - 2 : i - 1];
                const Vec2 out = points_[i + 1 == n ? 1 : i + 1] - points_[i];
                turn = std::abs(std::atan2(cross(in, out), dot(in, out)));
            }
            turned_[i + 1] = turned_[i] + turn;
            if (turn > kCorner) corners_.push_back(at_[i]);
        }
    }

    bool closed_;
    std::vector<Vec2> points_;    // of a closed path the first again at the end
    std::vector<double> at_;      // of each point, along the path
    std::vector<double> turned_;  // before each point, in all
    std::vector<double> corners_;
};

struct JointPlace {
    std::size_t track = 0;
    double at = 0.0;  // of the gap's middle, along the track
};

class JointPlacing {
 public:
    JointPlacing(const std::vector<Track>& tracks, double gap, const EdgeIndex& torn)
        : tracks_(tracks), half_(0.5 * gap), torn_(torn) {
        for (const Track& track : tracks) {
            starts_.push_back(whole_);
            whole_ += track.length();
        }
    }

    std::vector<JointPlace> run() {
        const int wanted = std::max(2, static_cast<int>(std::lround(whole_ / kJointEveryMm)));
        for (int i = 0; i < wanted; ++i) add(whole_ * i / wanted, whole_ * (i + 1) / wanted, kPlaces);
        // Stretches without a place are made up for elsewhere.
        while (chosen_.size() < 2 && add(0.0, whole_, 4 * kPlaces)) {
        }
        return std::move(chosen_);
    }

 private:
    // The best place between two lengths along all paths.
    bool add(double from, double to, int places) {
        std::optional<JointPlace> best;
        double most = 0.0;
        for (int i = 0; i < places; ++i) {
            const double share = (i + 0.5) / places;
            const JointPlace place = place_at(from + share * (to - from));
            // Of places as good as each other the middle one.
            const double worth = worth_of(place) - std::abs(share - 0.5);
            if (worth <= most) continue;
            most = worth;
            best = place;
        }
        if (best) chosen_.push_back(*best);
        return best.has_value();
    }
    [[nodiscard]] JointPlace place_at(double along) const {
        const auto next = std::upper_bound(starts_.begin(), starts_.end(), along) - starts_.begin();
        const auto track = static_cast<std::size_t>(std::max<std::ptrdiff_t>(next - 1, 0));
        return {track, std::min(along - starts_[track], tracks_[track].length())};
    }
    // Above 1 where a gap may be; more where it is better.
    [[nodiscard]] double worth_of(const JointPlace& place) const {
        constexpr double kMuch = 100.0;
        constexpr double kEach = 10.0;
        const Track& track = tracks_[place.track];
        const double reach = half_ + kClearMm;
        if (place.at < reach || place.at > track.length() - reach) return 0.0;
        const double turn = track.turn(place.at - reach, place.at + reach);
        if (turn > kNearlyStraight) return 0.0;
        const double clear = std::min(track.clear_of_corners(place.at),
                                      torn_.clearance(track.point(place.at), half_ + kWellClearMm)) -
                             half_;
        if (clear < kClearMm) return 0.0;
        const Vec2 here = track.point(place.at);
        for (const JointPlace& other : chosen_) {
            if (distance(tracks_[other.track].point(other.at), here) < 2.0 * half_ + kJointsApartMm)
                return 0.0;
        }
        return (turn <= kStraight ? kMuch : 1.0) + kEach * std::min(clear, kWellClearMm);
    }

    const std::vector<Track>& tracks_;
    double half_;
    const EdgeIndex& torn_;
    std::vector<double> starts_;
    double whole_ = 0.0;
    std::vector<JointPlace> chosen_;
};

std::vector<PathPart> parts_between(const Track& track, std::vector<double> gaps, double half) {
    std::sort(gaps.begin(), gaps.end());
    std::vector<PathPart> parts;
    double from = 0.0;
    for (const double gap : gaps) {
        parts.push_back({track.part(from, gap - half), false});
        from = gap + half;
    }
    parts.push_back({track.part(from, track.length()), false});
    if (!track.closed()) return parts;
    // What goes on round the corner where the contour begins is one part.
    std::vector<Vec2>& last = parts.back().points;
    last.insert(last.end(), parts.front().points.begin() + 1, parts.front().points.end());
    parts.erase(parts.begin());
    return parts;
}

}  // namespace

JointedCuts with_joints(std::span<const OuterCut> paths, double gap_mm, const EdgeIndex& torn) {
    JointedCuts made;
    std::vector<Track> tracks;
    std::vector<std::size_t> numbers;  // of the paths that have a length
    for (std::size_t i = 0; i < paths.size(); ++i) {
        const OuterCut& path = paths[i];
        made.parts.push_back({{{path.points.begin(), path.points.end()}, path.closed}});
        Track track(path);
        if (track.length() <= 0.0) continue;
        tracks.push_back(std::move(track));
        numbers.push_back(i);
    }
    if (tracks.empty()) return made;
    std::vector<std::vector<double>> gaps(tracks.size());
    for (const JointPlace& place : JointPlacing(tracks, gap_mm, torn).run()) {
        gaps[place.track].push_back(place.at);
        ++made.joints;
    }
    for (std::size_t i = 0; i < tracks.size(); ++i) {
        if (!gaps[i].empty()) made.parts[numbers[i]] = parts_between(tracks[i], gaps[i], 0.5 * gap_mm);
    }
    return made;
}

}  // namespace popup
