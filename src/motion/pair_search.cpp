#include "motion/pair_search.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace popup {
namespace {

constexpr double kLeastDeg = 2e-6;      // no plate moves by more than 0.0001 mm in this
constexpr double kLeastHitDeg = 1e-3;   // crossing in the middle of so little is crossing in all of it
constexpr double kLeastNearDeg = 1e-3;  // for approaches
// What is firmer than this may be called crossing, what is softer than kFirmMm touching: so that what stays
// in between can be called something.
constexpr double kNearlyFirmMm = 0.5 * kFirmMm;
constexpr double kInBothMm = 1.1 * kTouchMm;  // inside: in both cores, whatever these are rounded to
constexpr double kSurely = 0.999;             // of what is enough
constexpr int kMostPoses = 20000;             // of one pair in one cell
constexpr std::size_t kCrossingWork = 100;    // of one look, in turns of a way
constexpr std::size_t kVisitsPerTurn = 64;    // plates looked at for a way take as long as one of its turns
constexpr std::size_t kLongWay = 3;           // turns, from which their directions are looked at

double degrees_between(double from, double to) { return 0.5 * (from + to); }

}  // namespace

PairSearch::PairSearch(const Assembly& assembly, Linkage& linkage, std::span<const PlateShape> shapes)
    : assembly_(assembly),
      linkage_(linkage),
      shapes_(shapes),
      slot_(linkage.turns().size(), -1),
      poses_at_(assembly, linkage),
      cell_rates_(linkage.turns().size()),
      cell_of_(linkage.turns().size(), 0) {}

void PairSearch::begin(const Cell& cell, int a, int b) {
    a_ = a;
    b_ = b;
    joints_known_ = false;
    work_ += linkage_.way(linkage_.twin(a), linkage_.twin(b), way_) / kVisitsPerTurn;
    if (cell_number_ == 0 || cell.from != cell_from_ || cell.to != cell_to_) {
        ++cell_number_;
        cell_from_ = cell.from;
        cell_to_ = cell.to;
    }
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
    ranges_.push_back({cell.from, cell.to, 0, 1});
    poses_at_.begin(cell.from, cell.to);
    have_laws_ = way_.size() >= kLongWay && std::all_of(way_.begin(), way_.end(), [&](int turn) {
                     const Turn& t = linkage_.turns()[static_cast<std::size_t>(turn)];
                     return t.law >= 0 || t.still;
                 });
}

// Of a turn that has one.
const TurnRate& PairSearch::rate_in_cell(int turn) {
    const auto number = static_cast<std::size_t>(turn);
    if (cell_of_[number] != cell_number_) {
        cell_of_[number] = cell_number_;
        cell_rates_[number] = *linkage_.rate(turn, cell_from_, cell_to_);
    }
    return cell_rates_[number];
}

void PairSearch::find_rates(const Range& range) {
    rates_.clear();
    if (!have_laws_) return;
    const bool whole = range.from == cell_from_ && range.to == cell_to_;
    int at = linkage_.twin(a_);
    for (const int turn : way_) {
        const Turn& t = linkage_.turns()[static_cast<std::size_t>(turn)];
        const bool onwards = at != t.plate;
        at = onwards ? t.plate : t.other;
        rates_.push_back(
            {onwards ? 1.0 : -1.0, whole ? rate_in_cell(turn) : *linkage_.rate(turn, range.from, range.to)});
    }
}

bool PairSearch::place_pair(std::size_t number, double deg) {
    if (!joints_known_) {
        // A way may lead over plates on which neither stands: folds that close loops are shortcuts.
        under_ = {a_, b_, linkage_.twin(a_), linkage_.twin(b_)};
        for (const int turn : needed_) {
            const Turn& t = linkage_.turns()[static_cast<std::size_t>(turn)];
            under_.push_back(t.plate);
            if (t.other >= 0) under_.push_back(t.other);
        }
        linkage_.joints_under(under_, joints_);
        joints_known_ = true;
    }
    return poses_at_.place(number, deg, joints_);
}

bool PairSearch::place_only(int a, int b, double deg) {
    linkage_.joints_under(std::array{a, b}, joints_);
    joints_known_ = false;
    return poses_at_.place(0, deg, joints_);
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
        reached_ = place_pair(range.number, degrees_between(range.from, range.to));
        pose_frames_ = poses_at_.frames();
        // Where a linkage does not get to, not all plates are placed.
        for (const int turn : needed_) middle_.push_back(reached_ ? poses_at_.bend(turn) : 0.0);
    }
    set_pose(range, middle_);
    return true;
}

void PairSearch::set_pose(const Range& range, std::span<const double> middle) {
    const Frame& a = pose_frames_[static_cast<std::size_t>(a_)];
    pose_.a = &shapes_[static_cast<std::size_t>(a_)];
    pose_.b = &shapes_[static_cast<std::size_t>(b_)];
    pose_.b_in_a = relative(a, pose_frames_[static_cast<std::size_t>(b_)]);
    const double* first = pool_.data() + range.bends;
    const double* last = first + needed_.size();
    from_a_.clear();
    find_rates(range);
    for (const int turn : way_) {
        const Turn& t = linkage_.turns()[static_cast<std::size_t>(turn)];
        const auto slot = [this](int number) {
            return static_cast<std::size_t>(slot_[static_cast<std::size_t>(number)]);
        };
        const auto before = [&](int n) { return Bends{first[slot(n)], middle[slot(n)]}; };
        const auto after = [&](int n) { return Bends{middle[slot(n)], last[slot(n)]}; };
        const double turned = have_laws_ && t.law >= 0
                                  ? travel_by_law(rates_[from_a_.size()].rate, 0.5 * (range.to - range.from),
                                                  before(turn), after(turn))
                                  : travel_from_middle(linkage_, turn, range.from, range.to, before, after);
        const Frame& frame = pose_frames_[static_cast<std::size_t>(t.plate)];
        from_a_.push_back(
            {in_frame(a, frame.point(t.at)), direction_in_frame(a, frame.direction(t.dir)), turned});
    }
    from_b_.assign(from_a_.rbegin(), from_a_.rend());
    pose_.from_a = {from_a_, std::nullopt};
    pose_.from_b = {from_b_, std::nullopt};
    if (have_laws_) drift(range);
}

void PairSearch::drift(const Range& range) {
    const double half = Angle::degrees(0.5 * (range.to - range.from)).rad();
    Drift& of_b = pose_.from_b.drift.emplace(half);
    for (std::size_t i = 0; i < way_.size(); ++i)
        of_b.turn(from_a_[i].at, from_a_[i].dir, rates_[i].rate, rates_[i].sign);
    Drift& of_a = pose_.from_a.drift.emplace(half);
    for (std::size_t i = way_.size(); i-- > 0;)
        of_a.turn(from_a_[i].at, from_a_[i].dir, rates_[i].rate, -rates_[i].sign);
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
    ranges_.push_back({middle, range.to, range.bends, poses_at_.upper(range.number)});
    ranges_.push_back({range.from, middle, range.bends + 2 * n, poses_at_.lower(range.number)});
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
    bool crossed = false;
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
        // Where plates cross in what was looked at last, they mostly do here, which is seen at less cost than
        // that they are not clear. Points so far inside are of both cores.
        std::optional<Crossing> here;
        if (crossed) here = crossing_(*pose_.a, *pose_.b, pose_.b_in_a);
        const bool looked = crossed;
        crossed = here && here->inside_mm > kInBothMm;
        if (!crossed && nearness_.clear(pose_)) continue;
        if (!looked) here = crossing_(*pose_.a, *pose_.b, pose_.b_in_a);
        crossed = here && here->inside_mm > kInBothMm;
        const double width = range.to - range.from;
        work_ += kCrossingWork;
        const bool firm = here && here->firm();
        const double turns = std::min(pose_.from_a.turns(), pose_.from_b.turns());
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
    if (t.law >= 0) {
        const TurnRate rate = *linkage_.rate(way_[0], range.from, range.to);
        const double half = Angle::degrees(0.5 * (range.to - range.from)).rad();
        if (!rate.one_way && std::abs(middle) <= half * rate.most) return false;
    }
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

// A straight line on one plate through the point, steepest against the other plate, that reaches l to either
// side of it. Until its points have moved by l * sine, which is how far its ends stand off the other plate,
// it goes through the plane of that. Where it does is within l * cosine of the point, and as much further as
// it has moved: on the other plate, if that is no more than d, by which the point is inside. The longest such
// line has l = d / (sine + cosine), and may be on either plate.
bool PairSearch::crosses_throughout(const Crossing& here, double turns) const {
    const double d = here.inside_mm;
    const double moved =
        std::min(stray(here.point, pose_.from_b), stray(here.point, pose_.from_a)) + turns * d;
    const double cosine = std::sqrt(std::max(0.0, 1.0 - here.sine * here.sine));
    return moved < kSurely * d * here.sine / (here.sine + cosine);
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

PairSearch::At PairSearch::frames_at(int a, int b, double deg) {
    ++poses_;
    At result;
    result.reached = place_only(a, b, deg);
    if (!result.reached) return result;
    const std::span<const Frame> frames = poses_at_.frames();
    result.a = frames[static_cast<std::size_t>(a)];
    result.b_in_a = relative(result.a, frames[static_cast<std::size_t>(b)]);
    return result;
}

PairSearch::At PairSearch::at(int a, int b, double deg) {
    At result = frames_at(a, b, deg);
    if (result.reached) {
        result.crossing = crossing_(shapes_[static_cast<std::size_t>(a)],
                                    shapes_[static_cast<std::size_t>(b)], result.b_in_a);
    }
    return result;
}

PairSearch::Distance PairSearch::distance(int a, int b, double deg, double limit_mm) {
    ++poses_;
    if (!place_only(a, b, deg)) return {limit_mm, {}};
    const std::span<const Frame> frames = poses_at_.frames();
    const Frame& frame = frames[static_cast<std::size_t>(a)];
    PairPose pose;
    pose.a = &shapes_[static_cast<std::size_t>(a)];
    pose.b = &shapes_[static_cast<std::size_t>(b)];
    pose.b_in_a = relative(frame, frames[static_cast<std::size_t>(b)]);
    const ClosestPoints found = nearness_.least(pose, limit_mm);
    return {found.distance, frame.point({found.on_a.x, found.on_a.y})};
}

}  // namespace popup
