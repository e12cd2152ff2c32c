#include "motion/trials.h"

#include <algorithm>
#include <array>

#include "base/geometry/edge_index.h"
#include "motion/cells.h"
#include "motion/closed_card.h"
#include "motion/contacts.h"
#include "motion/crossing.h"
#include "motion/joints/joint.h"
#include "motion/lying.h"

namespace popup {
namespace {

constexpr std::size_t kMostPoses = 2'000;  // of one examination
// Nearer to the closed card examinations are cheap, and glances are not.
constexpr double kGlancesAboveDeg = 0.5;
constexpr double kOnPaperMm = 0.02;

SpaceBox box_of(const PlateShape& shape, const Frame& frame) {
    SpaceBox box;
    for (const Vec2 corner : shape.hull) box.extend(frame.point(corner));
    return box;
}

bool is_on_edge(const Polygon& paper, Vec2 p) {
    const std::vector<Segment> edges = edges_of(paper);
    return std::any_of(edges.begin(), edges.end(),
                       [p](const Segment& edge) { return distance(p, edge) <= kOnPaperMm; });
}

}  // namespace

Trials::Trials(const Assembly& assembly, const Linkage& linkage, std::span<const PlateShape> shapes,
               std::span<const std::pair<int, int>> pairs, std::span<const Contact> contacts,
               MoveBudget& budget)
    : shapes_(shapes), pairs_(pairs), budget_(budget), frames_(assembly.plates.size()) {
    std::vector<int> plates;
    for (const auto& [a, b] : pairs) plates.insert(plates.end(), {a, b});
    Linkage(linkage).joints_under(plates, joints_);
    for (const Contact& one : contacts) {
        if (std::find(pairs.begin(), pairs.end(), std::pair{one.a, one.b}) != pairs.end())
            openings_.push_back(one.deepest_deg);
    }
    const std::vector<double> ends = cell_ends(assembly.sweep, linkage.range_ends());
    for (std::size_t i = ends.size() - 1; i > 0; --i) {
        const double middle = 0.5 * (ends[i - 1] + ends[i]);
        if (middle > assembly.sweep.from_deg + kGlancesAboveDeg) openings_.push_back(middle);
    }
}

bool Trials::crosses_at_a_glance(const Assembly& trial) {
    for (std::size_t i = 0; i < openings_.size(); ++i) {
        if (!crosses_at(trial, openings_[i])) continue;
        // Moves that are like it cross there as well.
        std::rotate(openings_.begin(), openings_.begin() + static_cast<std::ptrdiff_t>(i),
                    openings_.begin() + static_cast<std::ptrdiff_t>(i) + 1);
        return true;
    }
    return any_lies(trial, shapes_, pairs_);
}

bool Trials::in_contact(const Assembly& trial, bool& lesson) {
    lesson = false;
    Linkage linkage(trial);
    PairSearch search(trial, linkage, shapes_);
    std::optional<double> crossing;
    const bool result = examine(trial, linkage, search, crossing);
    spend(search.poses() + trial.plates.size());
    if (crossing) {
        openings_.insert(openings_.begin(), *crossing);
        lesson = crosses_at(trial, *crossing);
        if (!lesson) openings_.erase(openings_.begin());
    }
    return result;
}

bool Trials::crosses_at(const Assembly& trial, double deg) {
    for (const std::size_t joint : joints_) {
        if (!place_plates(trial.joints[joint], Angle::degrees(deg), frames_)) return true;
    }
    int boxed = -1;  // pairs of one plate stand together
    SpaceBox box;
    for (const auto& [a, b] : pairs_) {
        const Frame& frame = frames_[static_cast<std::size_t>(a)];
        const PlateShape& shape = shapes_[static_cast<std::size_t>(a)];
        if (boxed != a) box = box_of(shape, frame);
        boxed = a;
        const Frame& other = frames_[static_cast<std::size_t>(b)];
        const PlateShape& other_shape = shapes_[static_cast<std::size_t>(b)];
        if (!box.meets(box_of(other_shape, other))) continue;
        spend(1);
        const auto found = crossing_(shape, other_shape, relative(frame, other));
        if (found && found->firm()) return true;
    }
    return false;
}

bool Trials::examine(const Assembly& trial, Linkage& linkage, PairSearch& search,
                     std::optional<double>& crossing) const {
    const std::vector<double> ends = cell_ends(trial.sweep, linkage.range_ends());
    std::vector<std::vector<ContactRange>> stretches(pairs_.size());
    std::vector<ContactRange> found;
    Cell cell;
    const std::size_t most = std::min(kMostPoses, budget_.poses);
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
        if (!fill_cell(trial, linkage, ends[i], ends[i + 1], cell)) return true;
        for (std::size_t k = 0; k < pairs_.size(); ++k) {
            search.contacts(cell, pairs_[k].first, pairs_[k].second, found);
            stretches[k].insert(stretches[k].end(), found.begin(), found.end());
            for (const ContactRange& one : found) {
                if (one.firm) crossing = 0.5 * (one.from + one.to);
            }
            // What grazes takes most poses, and is no mend.
            if (crossing || search.poses() >= most) return true;
        }
    }
    Contacts contacts;
    for (std::size_t k = 0; k < pairs_.size(); ++k) {
        find_contacts(pairs_[k].first, pairs_[k].second, stretches[k], search, contacts);
    }
    return !contacts.contacts.empty() || !contacts.undecided.empty() || any_lies(trial, shapes_, pairs_);
}

std::optional<Objection> Surroundings::objection(const Assembly& trial, int joint, Vec2 by,
                                                 bool lies_nowhere) {
    if (!is_on_paper(joint, by) || sticks_out(trial)) return Objection{};
    if (const auto pair = lain_on(trial, joint, lies_nowhere)) return Objection{pair};
    if (auto objection = met(trial, joint)) return objection;
    const std::string& element = assembly_.joints[static_cast<std::size_t>(joint)].name;
    if (holds_ && !holds_(element, by)) return Objection{};
    return std::nullopt;
}

// Folds and seams by which the element stands on others, moved, lie on the paper of these.
bool Surroundings::is_on_paper(int joint, Vec2 by) const {
    const auto is_own = [&](int plate) { return linkage_.joint_of(plate) == joint; };
    int piece = -1;
    for (const Hinge& hinge : assembly_.hinges) {
        if (is_own(hinge.a) == is_own(hinge.b)) continue;
        const Plate& ground = assembly_.plates[static_cast<std::size_t>(is_own(hinge.a) ? hinge.b : hinge.a)];
        const Segment& line = is_own(hinge.a) ? hinge.b_line : hinge.a_line;
        // What stands on the element in its turn goes along with it.
        if (linkage_.joint_of(is_own(hinge.a) ? hinge.b : hinge.a) > joint) continue;
        // On the page of another piece the way is another.
        if (piece < 0) piece = ground.piece;
        if (ground.piece != piece || ground.uncut.empty()) continue;
        const Polygon paper{ground.uncut, {}};
        for (const Vec2 end : {line.a + by, line.b + by}) {
            if (!contains(paper, end) && !is_on_edge(paper, end)) return false;
        }
    }
    return true;
}

bool Surroundings::sticks_out(const Assembly& trial) {
    if (assembly_.covers.empty() || !assembly_.sweep.closed_flat) return false;
    if (!out_) {
        out_.emplace();
        for (const Protrusion& one : find_protrusions(assembly_)) out_->push_back(one.plate);
    }
    const std::vector<Protrusion> now = find_protrusions(trial);
    return std::any_of(now.begin(), now.end(), [&](const Protrusion& one) {
        return std::find(out_->begin(), out_->end(), one.plate) == out_->end();
    });
}

const std::vector<char>& Surroundings::plates_moved_by(int joint) {
    const auto [at, is_new] = moved_by_.try_emplace(joint);
    if (!is_new) return at->second;
    Linkage linkage(linkage_);
    std::vector<std::size_t> under;
    for (std::size_t plate = 0; plate < assembly_.plates.size(); ++plate) {
        const std::array one{static_cast<int>(plate)};
        linkage.joints_under(one, under);
        at->second.push_back(
            std::find(under.begin(), under.end(), static_cast<std::size_t>(joint)) != under.end() ? 1 : 0);
    }
    return at->second;
}

bool Surroundings::lies_elsewhere(int joint, int besides) {
    const std::vector<char> own = plates_moved_by(joint);
    const std::vector<char>& others = plates_moved_by(besides);
    const auto pairs = lying_with(assembly_, linkage_, shapes_, own);
    return std::any_of(pairs.begin(), pairs.end(), [&](const std::pair<int, int>& one) {
        const int other = own[static_cast<std::size_t>(one.first)] != 0 ? one.second : one.first;
        return others[static_cast<std::size_t>(other)] == 0;
    });
}

std::optional<std::pair<int, int>> Surroundings::lain_on(const Assembly& trial, int joint,
                                                         bool lies_nowhere) {
    const std::vector<char>& moved = plates_moved_by(joint);
    const auto now = lying_with(trial, linkage_, shapes_, moved);
    if (now.empty()) return std::nullopt;
    if (lies_nowhere) return now.front();
    const auto [at, is_new] = lying_.try_emplace(joint);
    if (is_new) at->second = lying_with(assembly_, linkage_, shapes_, moved);
    for (const std::pair<int, int>& one : now) {
        if (!std::binary_search(at->second.begin(), at->second.end(), one)) return one;
    }
    return std::nullopt;
}

std::optional<Objection> Surroundings::met(const Assembly& trial, int joint) {
    const std::vector<char>& moved = plates_moved_by(joint);
    const auto meets_already = [&](int a, int b) {
        return std::any_of(contacts_.begin(), contacts_.end(),
                           [&](const Contact& one) { return one.a == a && one.b == b; });
    };
    Linkage linkage(trial);
    PairSearch search(trial, linkage, shapes_);
    const std::vector<double> ends = cell_ends(trial.sweep, linkage.range_ends());
    std::vector<ContactRange> found;
    Cell cell;
    const int count = static_cast<int>(moved.size());
    const auto is_moved = [&](int plate) { return moved[static_cast<std::size_t>(plate)] != 0; };
    const auto find = [&]() -> std::optional<Objection> {
        for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
            if (!fill_cell(trial, linkage, ends[i], ends[i + 1], cell)) return Objection{};
            const std::vector<SpaceBox> boxes = reach_boxes(cell, linkage, shapes_, 0.0);
            for (int a = 0; a < count; ++a) {
                if (!is_moved(a)) continue;
                for (int b = 0; b < count; ++b) {
                    if (is_moved(b) ||
                        !boxes[static_cast<std::size_t>(a)].meets(boxes[static_cast<std::size_t>(b)]))
                        continue;
                    const auto [low, high] = std::minmax(a, b);
                    if (meets_already(low, high)) continue;
                    search.contacts(cell, low, high, found);
                    if (search.poses() >= kMostPoses ||
                        std::any_of(found.begin(), found.end(),
                                    [](const ContactRange& one) { return one.firm; }))
                        return Objection{std::pair{low, high}};
                }
            }
        }
        return std::nullopt;
    };
    const auto result = find();
    budget_.poses -= std::min(budget_.poses, search.poses() + trial.plates.size());
    return result;
}

}  // namespace popup
