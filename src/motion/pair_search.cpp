#include "motion/pair_search.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "motion/joints/joint.h"

namespace popup {
namespace {

constexpr double kLeastDeg = 2e-6;      // no plate moves by more than 0.0001 mm in this
constexpr double kLeastHitDeg = 1e-3;   // crossing in the middle of so little is crossing in all of it
constexpr double kLeastNearDeg = 1e-3;  // for approaches
// What is firmer than this may be called crossing, what is softer than kFirmMm touching: so that what stays
// in between can be called something.
constexpr double kNearlyFirmMm = 0.5 * kFirmMm;
constexpr int kMostPoses = 20000;  // of one pair in one cell

double degrees_between(double from, double to) { return 0.5 * (from + to); }

}  // namespace

PairSearch::PairSearch(const Assembly& assembly, Linkage& linkage, std::span<const PlateShape> shapes)
    : assembly_(assembly),
      linkage_(linkage),
      shapes_(shapes),
      slot_(linkage.turns().size(), -1),
      frames_(assembly.plates.size()) {}

void PairSearch::begin(const Cell& cell, int a, int b) {
    a_ = a;
    b_ = b;
    joints_known_ = false;
    linkage_.way(linkage_.twin(a), linkage_.twin(b), way_);
    for (const int turn : needed_) slot_[static_cast<std::size_t>(turn)] = -1;
    needed_.clear();
    const auto need = [this](int turn) {
        if (slot_[static_cast<std::size_t>(turn)] >= 0) return;
        slot_[static_cast<std::size_t>(turn)] = static_cast<int>(needed_.size());
        needed_.push_back(turn);
    };
    for (const int turn : way_) travel_needs(linkage_.turns(), turn, need);
    ranges_.clear();
    pool_.clear();
    for (const int turn : needed_) pool_.push_back(cell.first[static_cast<std::size_t>(turn)]);
    for (const int turn : needed_) pool_.push_back(cell.last[static_cast<std::size_t>(turn)]);
    ranges_.push_back({cell.from, cell.to, 0});
}

bool PairSearch::place_pair(double deg) {
    if (!joints_known_) {
        linkage_.joints_under(std::array{a_, b_, linkage_.twin(a_), linkage_.twin(b_)}, joints_);
        joints_known_ = true;
    }
    return std::all_of(joints_.begin(), joints_.end(), [&](std::size_t joint) {
        return place_plates(assembly_.joints[joint], Angle::degrees(deg), frames_);
    });
}

bool PairSearch::next(Range& range, const Cell& cell) {
    if (ranges_.empty()) return false;
    range = ranges_.back();
    ranges_.pop_back();
    ++poses_;
    work_ += way_.size();
    middle_.clear();
    reached_ = true;
    if (range.from == cell.from && range.to == cell.to) {
        pose_frames_ = cell.frames;
        for (const int turn : needed_) middle_.push_back(cell.middle[static_cast<std::size_t>(turn)]);
    } else {
        reached_ = place_pair(degrees_between(range.from, range.to));
        pose_frames_ = frames_;
        for (const int turn : needed_) middle_.push_back(linkage_.bend(turn, frames_));
    }
    set_pose(range, middle_);
    return true;
}

void PairSearch::set_pose(const Range& range, std::span<const double> middle) {
    const Frame& a = pose_frames_[static_cast<std::size_t>(a_)];
    pose_.a = &shapes_[static_cast<std::size_t>(a_)];
    pose_.b = &shapes_[static_cast<std::size_t>(b_)];
    pose_.b_in_a = relative(a, pose_frames_[static_cast<std::size_t>(b_)]);
    const double half = 0.5 * (range.to - range.from);
    const double* first = pool_.data() + range.bends;
    const double* last = first + needed_.size();
    from_a_.clear();
    for (const int turn : way_) {
        const Turn& t = linkage_.turns()[static_cast<std::size_t>(turn)];
        const auto slot = [this](int number) {
            return static_cast<std::size_t>(slot_[static_cast<std::size_t>(number)]);
        };
        const auto before = [&](int n) { return Bends{first[slot(n)], middle[slot(n)]}; };
        const auto after = [&](int n) { return Bends{middle[slot(n)], last[slot(n)]}; };
        const Frame& frame = pose_frames_[static_cast<std::size_t>(t.plate)];
        from_a_.push_back({in_frame(a, frame.point(t.at)), direction_in_frame(a, frame.direction(t.dir)),
                           std::max(travel(linkage_.turns(), turn, half, before),
                                    travel(linkage_.turns(), turn, half, after))});
    }
    from_b_.assign(from_a_.rbegin(), from_a_.rend());
    pose_.from_a = from_a_;
    pose_.from_b = from_b_;
}

void PairSearch::split(const Range& range) {
    // What the halves need takes the place of what the whole needed, which stood last.
    const std::size_t n = needed_.size();
    const double middle = degrees_between(range.from, range.to);
    pool_.resize(range.bends + 4 * n);
    double* at = pool_.data() + range.bends;
    std::copy_n(at + n, n, at + 3 * n);
    std::copy_n(at, n, at + 2 * n);
    // The lower half is looked at first, so it stands last: [middle last] [first middle].
    std::copy_n(middle_.begin(), n, at);
    std::copy_n(at + 3 * n, n, at + n);
    std::copy_n(middle_.begin(), n, at + 3 * n);
    ranges_.push_back({middle, range.to, range.bends});
    ranges_.push_back({range.from, middle, range.bends + 2 * n});
}

void PairSearch::contacts(const Cell& cell, int a, int b, std::vector<ContactRange>& found) {
    found.clear();
    begin(cell, a, b);
    const std::size_t start = poses_;
    const auto add = [&found](const Range& range, ContactRange::Kind kind, bool firm = false) {
        if (found.empty() || found.back().kind != kind || found.back().to != range.from) {
            found.push_back({range.from, range.to, kind, firm});
        }
        found.back().to = range.to;
        found.back().firm = found.back().firm || firm;
    };
    Range range{};
    while (next(range, cell)) {
        if (!reached_) {
            add(range, ContactRange::undecided);
            continue;
        }
        const Sides sides = one_hinge_keeps_apart(range) ? Sides::one : sides_of(pose_);
        if (sides == Sides::one) continue;
        if (sides == Sides::one_nearly) {
            add(range, ContactRange::touching);
            continue;
        }
        const Found near = nearness_(pose_, 0.0, false);
        if (near.nearness == Nearness::clear) continue;
        const double width = range.to - range.from;
        const auto here = crossing(*pose_.a, *pose_.b, pose_.b_in_a);
        const bool firm = here && here->firm();
        double turns = 0.0;
        for (const Arm& arm : from_b_) turns += arm.turn;
        if (here && here->firmness_mm() > kNearlyFirmMm &&
            (width <= kLeastHitDeg || crosses_throughout(*here, turns))) {
            add(range, ContactRange::crossing, firm);
        } else if (only_touches(here ? here->inside_at_most_mm : 0.0, turns) || width <= kLeastDeg) {
            add(range, ContactRange::touching, firm);
        } else if (poses_ - start > kMostPoses) {
            add(range, ContactRange::undecided);
        } else {
            split(range);
        }
    }
}

// Plates that turn about one line stand on the side to which they are bent, as long as they pass neither flat
// nor folded and one of them lies on one side of the line.
bool PairSearch::one_hinge_keeps_apart(const Range& range) const {
    if (way_.size() != 1) return false;
    const auto turn = static_cast<std::size_t>(way_[0]);
    const Turn& t = linkage_.turns()[turn];
    if (t.other < 0) return false;
    // The only turn is the first that was needed.
    const double first = pool_[range.bends];
    const double middle = middle_[0];
    const double last = pool_[range.bends + needed_.size()];
    if (Bends{first, middle}.passes() || Bends{middle, last}.passes()) return false;
    // Where the turn opposite passes, this one may have turned back on the way.
    if (t.opposite >= 0) {
        const auto n = static_cast<std::size_t>(slot_[static_cast<std::size_t>(t.opposite)]);
        if (Bends{pool_[range.bends + n], pool_[range.bends + needed_.size() + n]}.passes()) return false;
    }
    // The line is on the page of the turn's plate. A plate that is glued on that one, or moves as it does,
    // may reach further.
    const int plate = linkage_.twin(a_) == t.plate ? a_ : b_;
    const Frame& page = pose_frames_[static_cast<std::size_t>(t.plate)];
    const Frame& frame = pose_frames_[static_cast<std::size_t>(plate)];
    double left = 0.0;
    double right = 0.0;
    for (const Vec2 p : shapes_[static_cast<std::size_t>(plate)].hull) {
        const Vec2 at = plate == t.plate ? p : on_page(page, frame.point(p));
        const double across = cross(t.dir, at - t.at);
        left = std::max(left, across);
        right = std::max(right, -across);
    }
    return std::min(left, right) <= kRoundingMm;
}

// A straight line of half the length d to either side of the point, steepest against the other plate, stays
// inside the edges of its own. Until points have moved as far as its ends stand off the other plate it goes
// through that, and where it does, that one's edges are still ahead.
bool PairSearch::crosses_throughout(const Crossing& here, double turns) const {
    const double d = here.inside_mm;
    const double moved = std::max(stray(here.point, from_b_), stray(here.point, from_a_)) + turns * d;
    return moved < 0.5 * d * here.sine;
}

// Say the plates had a common point x at some angle of the range, with circles of radius r round it on both.
// In this pose the point of one is then within `strayed` of that of the other, so the line in which the
// planes meet passes x within strayed / sine, and where it does the edges of both are further away than r
// less that and less strayed. So r exceeds how far inside common points are in this pose by no more, and its
// sine exceeds that of this pose by no more than the turns.
bool PairSearch::only_touches(double inside_mm, double turns) {
    const double sine = sine_between(pose_.b_in_a) + turns;
    if (std::min(pose_.a->radius, pose_.b->radius) * sine <= kFirmMm) return true;
    if (inside_mm * sine > kFirmMm || turns >= 0.5 * sine) return false;
    const double strayed = nearness_.stray_of_near(pose_);
    return (inside_mm + strayed / (sine - turns) + strayed) * sine <= kFirmMm;
}

void PairSearch::approaches(const Cell& cell, int a, int b, double distance_mm,
                            std::vector<ContactRange>& found) {
    found.clear();
    begin(cell, a, b);
    Range range{};
    while (next(range, cell)) {
        if (!reached_) continue;
        const Found near = nearness_(pose_, distance_mm, true);
        if (near.nearness == Nearness::clear) continue;
        if (near.nearness == Nearness::unknown) {
            if (range.to - range.from > kLeastNearDeg) {
                split(range);
                continue;
            }
            if (near.least_mm >= distance_mm) continue;
        }
        if (!found.empty() && found.back().to == range.from) {
            found.back().to = range.to;
        } else {
            found.push_back({range.from, range.to, ContactRange::crossing, false});
        }
    }
}

PairSearch::At PairSearch::at(int a, int b, double deg) {
    ++poses_;
    a_ = a;
    b_ = b;
    joints_known_ = false;
    At result;
    if (!place_pair(deg)) return result;
    result.a = frames_[static_cast<std::size_t>(a)];
    result.b_in_a = relative(result.a, frames_[static_cast<std::size_t>(b)]);
    result.crossing =
        crossing(shapes_[static_cast<std::size_t>(a)], shapes_[static_cast<std::size_t>(b)], result.b_in_a);
    return result;
}

PairSearch::Distance PairSearch::distance(int a, int b, double deg, double limit_mm) {
    ++poses_;
    a_ = a;
    b_ = b;
    joints_known_ = false;
    if (!place_pair(deg)) return {limit_mm, {}};
    const Frame& frame = frames_[static_cast<std::size_t>(a)];
    PairPose pose;
    pose.a = &shapes_[static_cast<std::size_t>(a)];
    pose.b = &shapes_[static_cast<std::size_t>(b)];
    pose.b_in_a = relative(frame, frames_[static_cast<std::size_t>(b)]);
    const ClosestPoints found = nearness_.least(pose, limit_mm);
    return {found.distance, frame.point({found.on_a.x, found.on_a.y})};
}

}  // namespace popup
