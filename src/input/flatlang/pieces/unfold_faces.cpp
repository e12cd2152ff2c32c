#include "input/flatlang/pieces/unfold_faces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <deque>
#include <map>
#include <unordered_map>
#include <utility>

#include "base/geometry/cells.h"
#include "base/geometry/edge_index.h"
#include "base/geometry/regions.h"
#include "input/flatlang/pieces/shared_edges.h"
#include "parts/contours.h"

namespace popup::flatlang {
namespace {

// Folds by less are flat, in radians.
constexpr double kFlat = 1e-6;
// Faces are joined where their edges stand this near to each other, in mm, on the page and in space.
constexpr double kTogetherMm = 3.0 * kMeetMm;

std::size_t at(int number) { return static_cast<std::size_t>(number); }

template <class Function>
void each_ring(const std::vector<Polygon>& regions, Function&& function) {
    for (const Polygon& region : regions) {
        function(region.outer);
        for (const Ring& hole : region.holes) function(hole);
    }
}

template <class Function>
void each_edge(const std::vector<Polygon>& regions, Function&& function) {
    each_ring(regions, [&](const Ring& ring) {
        for (std::size_t i = 0; i < ring.size(); ++i)
            function(ring[i], ring[i + 1 == ring.size() ? 0 : i + 1]);
    });
}

Box box_of(const std::vector<Polygon>& regions) {
    Box box;
    for (const Polygon& region : regions) {
        for (const Vec2 p : region.outer) box.extend(p);
    }
    return box;
}

Vec2 on_page(const Frame& frame, Vec3 p) {
    return {dot(frame.axes[0], p - frame.origin), dot(frame.axes[1], p - frame.origin)};
}

// True when a straight line along one of a's edges has all of a on one side and all of b on the other.
bool apart(const Ring& a, const Ring& b) {
    constexpr std::size_t kFew = 16;
    if (a.size() > kFew) return false;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const Vec2 edge = a[i + 1 == a.size() ? 0 : i + 1] - a[i];
        const double span = length(edge);
        if (span < kMeetMm) continue;
        const auto side = [&](Vec2 p) { return cross(edge, p - a[i]) / span; };
        if (std::all_of(b.begin(), b.end(), [&](Vec2 p) { return side(p) <= kDeepMm; }) &&
            std::all_of(a.begin(), a.end(), [&](Vec2 p) { return side(p) >= -kDeepMm; })) {
            return true;
        }
    }
    return false;
}

// A stretch that two faces share, as one of them sees it.
struct Join {
    int other = 0;  // face
    Vec3 from, to;
    // Into which direction the paper of each lies from there.
    Vec3 own_side, other_side;
};

class Unfolder {
 public:
    Unfolder(std::span<const Face> faces, bool join_flat, Work& work)
        : faces_(faces), join_flat_(join_flat), work_(work) {}

    std::optional<std::vector<Unfolded>> run() {
        if (!find_joins()) return std::nullopt;
        piece_of_.assign(faces_.size(), -1);
        for (std::size_t i = 0; i < faces_.size(); ++i) {
            if (piece_of_[i] < 0 && !grow(static_cast<int>(i))) return std::nullopt;
        }
        for (std::size_t i = 0; i < pieces_.size(); ++i) {
            if (!finish(static_cast<int>(i))) return std::nullopt;
        }
        return std::move(pieces_);
    }

 private:
    // --- which faces meet

    bool find_joins() {
        std::vector<FaceEdge> edges;
        for (std::size_t i = 0; i < faces_.size(); ++i) {
            const Frame& frame = faces_[i].frame;
            each_edge(faces_[i].paper, [&](Vec2 p, Vec2 q) {
                edges.push_back({frame.point(p), frame.point(q), static_cast<int>(i)});
            });
        }
        const auto shared = find_shared(edges, work_);
        if (!shared) return false;
        joins_.resize(faces_.size());
        for (const SharedStretch& one : *shared) {
            const Vec3 along = unit(one.to - one.from);
            const Vec3 a = cross(faces_[at(one.a)].frame.normal(), one.along_a ? along : -along);
            const Vec3 b = cross(faces_[at(one.b)].frame.normal(), one.along_b ? along : -along);
            if (faces_[at(one.a)].plane == faces_[at(one.b)].plane && (!join_flat_ || dot(a, b) > 0.0)) {
                continue;
            }
            joins_[at(one.a)].push_back({one.b, one.from, one.to, a, b});
            joins_[at(one.b)].push_back({one.a, one.from, one.to, b, a});
        }
        return true;
    }

    // --- hanging them on each other

    bool grow(int first) {
        pieces_.emplace_back();
        boxes_ = EdgeIndex();
        corners_.clear();
        const Face& face = faces_[at(first)];
        hang({first, face.frame, face.paper});
        std::deque<int> waiting{0};
        while (!waiting.empty()) {
            const int place = waiting.front();
            waiting.pop_front();
            const int from = pieces_.back().faces[at(place)].face;
            for (const Join& join : joins_[at(from)]) {
                if (piece_of_[at(join.other)] >= 0) continue;
                const Frame frame = unfolded(pieces_.back().faces[at(place)].frame, join);
                UnfoldedFace next{join.other, frame, placed(faces_[at(join.other)], frame)};
                bool free = true;
                if (!finds_room(next, free)) return false;
                if (!free) continue;
                waiting.push_back(static_cast<int>(pieces_.back().faces.size()));
                hang(std::move(next));
            }
        }
        return true;
    }

    // Where the page lies in space when the other face is laid flat beside its neighbour on it.
    static Frame unfolded(const Frame& page, const Join& join) {
        const Vec2 p = on_page(page, join.from);
        const Vec2 q = on_page(page, join.to);
        const Vec2 along = unit(q - p);
        // On the page the other's paper lies where the neighbour's does not.
        const Vec2 in_page{dot(page.axes[0], join.own_side), dot(page.axes[1], join.own_side)};
        const bool own_left = cross(along, in_page) > 0.0;
        Vec3 e = unit(join.to - join.from);
        const Vec3 other = unit(join.other_side - dot(join.other_side, e) * e);
        // left of `along` in space
        const Vec3 left = own_left ? -other : other;
        Frame frame;
        frame.axes[0] = along.x * e - along.y * left;
        frame.axes[1] = along.y * e + along.x * left;
        frame.axes[2] = cross(frame.axes[0], frame.axes[1]);
        frame.origin = 0.5 * (join.from + join.to) - frame.direction(0.5 * (p + q));
        return frame;
    }

    // The face's paper on the page; corners near others of the piece become those.
    [[nodiscard]] std::vector<Polygon> placed(const Face& face, const Frame& page) const {
        const bool turned_over = dot(face.frame.normal(), page.normal()) < 0.0;
        const auto put = [&](const Ring& ring) {
            Ring result;
            result.reserve(ring.size());
            for (const Vec2 p : ring) result.push_back(snapped(on_grid(on_page(page, face.frame.point(p)))));
            if (turned_over) std::reverse(result.begin(), result.end());
            return result;
        };
        std::vector<Polygon> result;
        for (const Polygon& region : face.paper) {
            Polygon one{put(region.outer), {}};
            for (const Ring& hole : region.holes) one.holes.push_back(put(hole));
            result.push_back(std::move(one));
        }
        return result;
    }

    static PlaneCell cell_of(double x, double y) {
        return {static_cast<std::int64_t>(std::floor(x)), static_cast<std::int64_t>(std::floor(y))};
    }

    [[nodiscard]] Vec2 snapped(Vec2 p) const {
        constexpr double kCell = 4.0 * kMeetMm;
        const double x = p.x / kCell - 0.5;
        const double y = p.y / kCell - 0.5;
        Vec2 best = p;
        double nearest = kMeetMm;
        for (const double dx : {0.0, 1.0}) {
            for (const double dy : {0.0, 1.0}) {
                const auto [begin, end] = corners_.equal_range(cell_of(x + dx, y + dy));
                for (auto one = begin; one != end; ++one) {
                    const double off = distance(one->second, p);
                    if (off < nearest) {
                        nearest = off;
                        best = one->second;
                    }
                }
            }
        }
        return best;
    }

    void hang(UnfoldedFace face) {
        constexpr double kCell = 4.0 * kMeetMm;
        piece_of_[at(face.face)] = static_cast<int>(pieces_.size()) - 1;
        each_ring(face.paper, [&](const Ring& ring) {
            for (const Vec2 p : ring) {
                // What is there already is what others are moved to.
                if (snapped(p) == p && corners_.contains(cell_of(p.x / kCell, p.y / kCell))) {
                    const auto [begin, end] = corners_.equal_range(cell_of(p.x / kCell, p.y / kCell));
                    if (std::any_of(begin, end, [&](const auto& one) { return one.second == p; })) continue;
                }
                corners_.emplace(cell_of(p.x / kCell, p.y / kCell), p);
            }
        });
        const Box box = box_of(face.paper);
        boxes_.insert({box.min, box.max}, false);
        pieces_.back().faces.push_back(std::move(face));
    }

    // False: too much work.
    bool finds_room(const UnfoldedFace& face, bool& free) {
        const Box box = box_of(face.paper);
        const Vec2 margin{kDeepMm, kDeepMm};
        if (box.width() <= 2.0 * kDeepMm || box.height() <= 2.0 * kDeepMm) return true;
        std::vector<int> near;
        boxes_.query({box.min + margin, box.max - margin}, near);
        for (const int i : near) {
            const UnfoldedFace& other = pieces_.back().faces[at(i)];
            if (!work_.looks(other.paper.size() + face.paper.size())) return false;
            if (other.paper.size() == 1 && face.paper.size() == 1 &&
                (apart(other.paper[0].outer, face.paper[0].outer) ||
                 apart(face.paper[0].outer, other.paper[0].outer))) {
                continue;
            }
            if (!work_.sweep(other.paper) || !work_.sweep(face.paper)) return false;
            if (is_deep(intersect(other.paper, face.paper))) {
                free = false;
                return true;
            }
        }
        return true;
    }

    // --- what the page shows

    bool finish(int number) {
        Unfolded& piece = pieces_[at(number)];
        if (piece.faces.size() == 1) {
            piece.paper = piece.faces.front().paper;
            return true;
        }
        std::map<int, const UnfoldedFace*> placed_faces;
        for (const UnfoldedFace& one : piece.faces) placed_faces[one.face] = &one;
        std::map<std::pair<int, int>, std::vector<Segment>> joined;
        for (const UnfoldedFace& one : piece.faces) {
            for (const Join& join : joins_[at(one.face)]) {
                if (join.other < one.face) continue;
                const auto other = placed_faces.find(join.other);
                if (other == placed_faces.end()) continue;
                add_crease(piece, one, *other->second, join, joined[{one.face, join.other}]);
            }
        }
        return add_slits(piece, joined) && unite_paper(piece);
    }

    static void add_crease(Unfolded& piece, const UnfoldedFace& a, const UnfoldedFace& b, const Join& join,
                           std::vector<Segment>& joined) {
        const Segment in_a{on_page(a.frame, join.from), on_page(a.frame, join.to)};
        const Segment in_b{on_page(b.frame, join.from), on_page(b.frame, join.to)};
        if (distance(in_a.a, in_b.a) > kTogetherMm || distance(in_a.b, in_b.b) > kTogetherMm) return;
        const double angle =
            std::atan2(dot(a.frame.normal(), join.other_side), -dot(join.own_side, join.other_side));
        piece.creases.push_back({in_a.a, in_a.b, std::abs(angle) < kFlat ? 0.0 : angle});
        joined.push_back(in_a);
    }

    // Where edges lie on each other on the page and are not joined.
    bool add_slits(Unfolded& piece, const std::map<std::pair<int, int>, std::vector<Segment>>& joined) {
        std::vector<FaceEdge> edges;
        for (const UnfoldedFace& one : piece.faces) {
            each_edge(one.paper, [&](Vec2 p, Vec2 q) {
                edges.push_back({{p.x, p.y, 0.0}, {q.x, q.y, 0.0}, one.face});
            });
        }
        const auto shared = find_shared(edges, work_);
        if (!shared) return false;
        for (const SharedStretch& one : *shared) {
            const Segment line{{one.from.x, one.from.y}, {one.to.x, one.to.y}};
            touching_.emplace_back(line, one.b);
            const auto folds = joined.find({one.a, one.b});
            add_rest(piece, line, folds == joined.end() ? std::vector<Segment>{} : folds->second);
        }
        return true;
    }

    // The line without what is folded of it.
    static void add_rest(Unfolded& piece, const Segment& line, const std::vector<Segment>& folds) {
        const Vec2 along = unit(line.b - line.a);
        const double span = distance(line.a, line.b);
        std::vector<std::pair<double, double>> taken;
        for (const Segment& fold : folds) {
            if (std::abs(cross(along, fold.a - line.a)) > kTogetherMm ||
                std::abs(cross(along, fold.b - line.a)) > kTogetherMm) {
                continue;
            }
            const double s = dot(along, fold.a - line.a);
            const double t = dot(along, fold.b - line.a);
            taken.emplace_back(std::min(s, t), std::max(s, t));
        }
        std::sort(taken.begin(), taken.end());
        taken.emplace_back(span, span);
        double from = 0.0;
        for (const auto& [begin, end] : taken) {
            const double to = std::min(begin, span);
            if (to - from >= kShortestMm) piece.slits.push_back({line.a + from * along, line.a + to * along});
            from = std::max(from, end);
        }
    }

    // Edges that should lie on each other are off by what the turtle's numbers are rounded to: thin paper
    // over them, pointed so that it stays within the outline, makes one area of the faces.
    static Polygon bridge(const Segment& line) {
        const Vec2 along = unit(line.b - line.a);
        const Vec2 aside = kMeetMm * left_of(along);
        const double point = std::min(10.0 * kMeetMm, 0.25 * distance(line.a, line.b));
        return {{line.a, line.a + point * along - aside, line.b - point * along - aside, line.b,
                 line.b - point * along + aside, line.a + point * along + aside},
                {}};
    }

    // A few at a time: a boolean of all at once takes long where many have corners at the same height, and
    // what is united has fewer.
    bool unite_paper(Unfolded& piece) {
        std::map<int, std::size_t> place;
        std::vector<std::vector<Polygon>> areas;
        for (const UnfoldedFace& one : piece.faces) {
            place[one.face] = areas.size();
            areas.push_back(one.paper);
        }
        for (const auto& [line, face] : touching_) areas[place.at(face)].push_back(bridge(line));
        touching_.clear();
        constexpr std::size_t kFew = 16;
        while (areas.size() > 1) {
            std::vector<std::vector<Polygon>> fewer;
            for (std::size_t i = 0; i < areas.size(); i += kFew) {
                std::vector<Polygon> some;
                for (std::size_t j = i; j < std::min(areas.size(), i + kFew); ++j) {
                    some.insert(some.end(), areas[j].begin(), areas[j].end());
                }
                if (!work_.sweep(some)) return false;
                fewer.push_back(unite(some));
            }
            areas = std::move(fewer);
        }
        piece.paper = std::move(areas.front());
        return true;
    }

    std::span<const Face> faces_;
    bool join_flat_;
    Work& work_;
    std::vector<std::vector<Join>> joins_;  // of each face, by the others
    std::vector<int> piece_of_;
    std::vector<Unfolded> pieces_;
    // Of the piece that grows:
    EdgeIndex boxes_;
    std::unordered_multimap<PlaneCell, Vec2, PlaneCellHash> corners_;
    // Of the piece that is finished:
    std::vector<std::pair<Segment, int>> touching_;  // where faces meet on the page; one of them
};

}  // namespace

std::optional<std::vector<Unfolded>> unfold_faces(std::span<const Face> faces, bool join_flat, Work& work) {
    return Unfolder(faces, join_flat, work).run();
}

}  // namespace popup::flatlang
