#include "output/fold_mesh.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "base/geometry/cells.h"
#include "base/geometry/edge_index.h"
#include "base/geometry/tolerances.h"
#include "base/geometry/triangulate.h"

namespace popup {
namespace {

// Corners of plates this near to the end of a fold are its end.
constexpr double kFoldEndMm = 1e-4;

std::size_t at(int number) { return static_cast<std::size_t>(number); }

// The corners of one page, numbered on in `points`, with those that are the same up to rounding as one.
class PointTable {
 public:
    explicit PointTable(std::vector<Vec2>& points) : points_(points) {}

    int number_of(Vec2 p) {
        const PlaneCell cell = cell_of(p);
        int best = -1;
        for (std::int64_t dx = -1; dx <= 1; ++dx) {
            for (std::int64_t dy = -1; dy <= 1; ++dy) {
                const auto found = cells_.find({cell.x + dx, cell.y + dy});
                if (found == cells_.end()) continue;
                for (const int i : found->second) {
                    const double d = distance(points_[at(i)], p);
                    if (d <= kSameVertexMm && (best < 0 || d < distance(points_[at(best)], p))) best = i;
                }
            }
        }
        if (best >= 0) return best;
        cells_[cell].push_back(static_cast<int>(points_.size()));
        points_.push_back(p);
        return static_cast<int>(points_.size()) - 1;
    }

 private:
    static PlaneCell cell_of(Vec2 p) {
        return {static_cast<std::int64_t>(std::floor(p.x / kSameVertexMm)),
                static_cast<std::int64_t>(std::floor(p.y / kSameVertexMm))};
    }

    std::vector<Vec2>& points_;
    std::unordered_map<PlaneCell, std::vector<int>, PlaneCellHash> cells_;
};

// The ring without doubled corners and without ways there and back.
std::vector<int> cleaned(const std::vector<int>& ring) {
    std::vector<int> way;
    for (const int p : ring) {
        if (!way.empty() && way.back() == p) continue;
        if (way.size() > 1 && way[way.size() - 2] == p) {
            way.pop_back();
            continue;
        }
        way.push_back(p);
    }
    // The same where the ring closes.
    std::size_t begin = 0;
    while (way.size() - begin > 2) {
        const std::size_t size = way.size();
        if (way[size - 1] == way[begin] || way[size - 2] == way[begin]) {
            way.pop_back();
        } else if (way[size - 1] == way[begin + 1]) {
            ++begin;
        } else {
            break;
        }
    }
    way.erase(way.begin(), way.begin() + static_cast<std::ptrdiff_t>(begin));
    return way;
}

class MeshBuilder {
 public:
    MeshBuilder(const Assembly& assembly, FoldSlits slits)
        : in_(assembly), slits_(slits), sides_of_(in_.plates.size()), faces_of_(in_.plates.size(), 0) {}

    FoldMesh build() {
        mesh_.first.push_back(0);
        for (const Piece& piece : in_.pieces) add_piece(piece);
        indices_.resize(in_.plates.size());
        find_folds();
        find_joins();
        if (slits_ == FoldSlits::drawn) split_slits();
        split_sides();
        join_sides();
        if (slits_ == FoldSlits::drawn) join_slits();
        number_vertices_and_edges();
        return std::move(mesh_);
    }

 private:
    struct Fold {
        std::vector<int> a, b;  // sides of the two plates on its line, before they are split
        Segment at;             // beyond it they are not held together
        char letter = 'U';
    };
    struct Split {
        int side;
        double along;
        int point;
    };
    struct Side {
        int from, to, number;
        bool operator<(const Side& other) const {
            return std::tie(from, to, number) < std::tie(other.from, other.to, other.number);
        }
    };

    void add_piece(const Piece& piece) {
        PointTable table(mesh_.points);
        const auto ring_of = [&table](const Ring& ring) {
            std::vector<int> numbers;
            numbers.reserve(ring.size());
            for (const Vec2 p : ring) numbers.push_back(table.number_of(p));
            return numbers;
        };
        for (const int plate : piece.plates) {
            const Polygon& outline = in_.plates[at(plate)].outline;
            auto& [begin, end] = sides_of_[at(plate)];
            begin = static_cast<int>(mesh_.point.size());
            const std::vector<int> outer = ring_of(outline.outer);
            if (outline.holes.empty()) {
                add_face(plate, outer);
            } else {
                // The outline's own corners come first: triangles of large polygons stand on a grid.
                for (const Ring& hole : outline.holes) ring_of(hole);
                // Where it is not cut up first no corner stands in the middle of another triangle's side.
                constexpr std::size_t kUncut = 4000;
                const Triangulation cut = triangulate(outline, kUncut);
                for (const auto& t : cut.triangles) {
                    add_face(plate, ring_of({cut.points[t[0]], cut.points[t[1]], cut.points[t[2]]}));
                }
            }
            end = static_cast<int>(mesh_.point.size());
        }
    }

    void append_face(int plate, const std::vector<int>& ring) {
        for (const int p : ring) {
            mesh_.face.push_back(static_cast<int>(mesh_.face_plate.size()));
            mesh_.point.push_back(p);
        }
        mesh_.face_plate.push_back(plate);
        mesh_.first.push_back(mesh_.point.size());
    }

    void add_face(int plate, const std::vector<int>& ring) {
        const std::vector<int> way = cleaned(ring);
        if (way.size() < 3) return;
        append_face(plate, way);
        ++faces_of_[at(plate)];
    }

    // The sides of a plate's faces; their numbers there count from the plate's first side.
    const EdgeIndex& index_of(int plate) {
        std::optional<EdgeIndex>& index = indices_[at(plate)];
        if (!index) {
            std::vector<Segment> sides;
            for (int i = sides_of_[at(plate)].first; i < sides_of_[at(plate)].second; ++i) {
                sides.push_back({mesh_.place(i), mesh_.place(mesh_.next(i))});
            }
            index.emplace(std::vector<Segment>{}, sides);
        }
        return *index;
    }

    std::vector<int> sides_near(int plate, const Segment& s) {
        Box box;
        box.extend(s.a);
        box.extend(s.b);
        const Vec2 margin{kSameVertexMm, kSameVertexMm};
        std::vector<int> found;
        index_of(plate).query({box.min - margin, box.max + margin}, found);
        for (int& side : found) side += sides_of_[at(plate)].first;
        return found;
    }

    // The points where a side begins and ends.
    [[nodiscard]] int from(int side) const { return mesh_.point[at(side)]; }
    [[nodiscard]] int to(int side) const { return mesh_.point[at(mesh_.next(side))]; }

    void find_folds() {
        std::vector<std::tuple<int, int, char>> letters;
        for (const Line& line : in_.lines) {
            if (line.kind != LineKind::mountain && line.kind != LineKind::valley) continue;
            const auto [a, b] = std::minmax({line.plate, line.other_plate});
            letters.emplace_back(a, b, line.kind == LineKind::mountain ? 'M' : 'V');
        }
        std::sort(letters.begin(), letters.end());
        for (const Hinge& hinge : in_.hinges) {
            const double size = distance(hinge.a_line.a, hinge.a_line.b);
            if (hinge.glued || size <= kSameVertexMm) continue;
            const Vec2 direction = unit(hinge.a_line.b - hinge.a_line.a);
            const auto along = [&](int p) { return dot(direction, mesh_.points[at(p)] - hinge.a_line.a); };
            const auto on_line = [&](int side) {
                for (const int p : {from(side), to(side)}) {
                    const double off = cross(direction, mesh_.points[at(p)] - hinge.a_line.a);
                    if (std::abs(off) > kSameVertexMm) return false;
                }
                return true;
            };
            Fold fold;
            fold.at = hinge.a_line;
            std::vector<std::pair<double, int>> ends;
            for (const auto& [plate, sides] : {std::pair{hinge.a, &fold.a}, std::pair{hinge.b, &fold.b}}) {
                for (const int side : sides_near(plate, hinge.a_line)) {
                    if (!on_line(side)) continue;
                    sides->push_back(side);
                    for (const int p : {from(side), to(side)}) ends.emplace_back(along(p), p);
                }
            }
            std::sort(ends.begin(), ends.end());
            ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
            end_at(0.0, hinge.a_line.a, ends);
            end_at(size, hinge.a_line.b, ends);
            for (const auto* sides : {&fold.a, &fold.b}) {
                for (const int side : *sides) split_at(side, ends, along);
            }
            const auto [a, b] = std::minmax({hinge.a, hinge.b});
            const auto found = std::lower_bound(letters.begin(), letters.end(), std::tuple{a, b, '\0'});
            if (found != letters.end() && std::get<0>(*found) == a && std::get<1>(*found) == b) {
                fold.letter = std::get<2>(*found);
            } else if (in_.sweep.bends) {
                fold.letter = 'F';
            }
            folds_.push_back(std::move(fold));
        }
    }

    // Where a fold goes on as a slit no plate has a corner: makes one there.
    void end_at(double along, Vec2 p, std::vector<std::pair<double, int>>& ends) {
        const auto next = std::lower_bound(ends.begin(), ends.end(), std::pair{along - kFoldEndMm, -1});
        if (next == ends.begin() || next == ends.end() || next->first <= along + kFoldEndMm) return;
        ends.insert(next, {along, static_cast<int>(mesh_.points.size())});
        mesh_.points.push_back(p);
    }

    // Notes the splits of a side at the ends that lie inside it; `ends` ascend along the fold.
    template <typename Along>
    void split_at(int side, const std::vector<std::pair<double, int>>& ends, const Along& along) {
        const double begin = along(from(side));
        const double end = along(to(side));
        for (auto i = std::lower_bound(ends.begin(), ends.end(), std::pair{std::min(begin, end), -1});
             i != ends.end() && i->first < std::max(begin, end); ++i) {
            if (i->second == from(side) || i->second == to(side)) continue;
            splits_.push_back({side, std::abs(i->first - begin), i->second});
        }
    }

    // In a plate of several triangles a corner of one may lie inside a side of another.
    void find_joins() {
        for (std::size_t plate = 0; plate < faces_of_.size(); ++plate) {
            if (faces_of_[plate] < 2) continue;
            const auto [begin, end] = sides_of_[plate];
            for (int corner = begin; corner < end; ++corner) {
                const Vec2 p = mesh_.place(corner);
                for (const int side : sides_near(static_cast<int>(plate), {p, p})) {
                    const Segment s{mesh_.place(side), mesh_.place(mesh_.next(side))};
                    const int first = static_cast<int>(mesh_.first[at(mesh_.face[at(side)])]);
                    const int number = from(corner);
                    // A corner of the very triangle would fold it onto itself.
                    if (number == from(first) || number == from(first + 1) || number == from(first + 2) ||
                        distance(p, s) > kSameVertexMm) {
                        continue;
                    }
                    splits_.push_back({side, dot(unit(s.b - s.a), p - s.a), number});
                }
            }
        }
    }

    // Plates have no corners where nothing turns, and so the two sides of a slit differ in theirs.
    void split_slits() {
        for (const Piece& piece : in_.pieces) {
            std::vector<Segment> sides;
            std::vector<int> numbers;
            for (const int plate : piece.plates) {
                for (int i = sides_of_[at(plate)].first; i < sides_of_[at(plate)].second; ++i) {
                    sides.push_back({mesh_.place(i), mesh_.place(mesh_.next(i))});
                    numbers.push_back(i);
                }
            }
            const EdgeIndex index({}, sides);
            std::vector<int> found;
            for (const int corner : numbers) {
                const Vec2 p = mesh_.place(corner);
                const Vec2 margin{kSameVertexMm, kSameVertexMm};
                index.query({p - margin, p + margin}, found);
                for (const int i : found) {
                    const Segment& s = sides[at(i)];
                    const int side = numbers[at(i)];
                    if (from(side) == from(corner) || to(side) == from(corner) ||
                        mesh_.face[at(side)] == mesh_.face[at(corner)] || distance(p, s) > kSameVertexMm) {
                        continue;
                    }
                    splits_.push_back({side, dot(unit(s.b - s.a), p - s.a), from(corner)});
                }
            }
        }
    }

    void join_slits() {
        for (const Piece& piece : in_.pieces) {
            std::vector<Side> all;
            for (const int plate : piece.plates) {
                for (int i = sides_of_[at(plate)].first; i < sides_of_[at(plate)].second; ++i)
                    append_parts(i, all);
            }
            std::erase_if(all, [this](const Side& side) { return mesh_.twin[at(side.number)] >= 0; });
            const std::vector<Side> others = all;
            pair_up(all, others, 'C');
        }
    }

    void split_sides() {
        std::sort(splits_.begin(), splits_.end(), [](const Split& a, const Split& b) {
            return std::tie(a.side, a.along, a.point) < std::tie(b.side, b.along, b.point);
        });
        const auto same = [](const Split& a, const Split& b) {
            return a.side == b.side && a.point == b.point;
        };
        splits_.erase(std::unique(splits_.begin(), splits_.end(), same), splits_.end());
        FoldMesh whole = std::exchange(mesh_, {});
        mesh_.points = std::move(whole.points);
        mesh_.first.push_back(0);
        auto split = splits_.begin();
        std::vector<int> ring;
        for (std::size_t f = 0; f < whole.face_plate.size(); ++f) {
            ring.clear();
            for (std::size_t side = whole.first[f]; side < whole.first[f + 1]; ++side) {
                parts_.push_back(static_cast<int>(mesh_.point.size() + ring.size()));
                ring.push_back(whole.point[side]);
                for (; split != splits_.end() && at(split->side) == side; ++split)
                    ring.push_back(split->point);
            }
            append_face(whole.face_plate[f], ring);
        }
        parts_.push_back(static_cast<int>(mesh_.point.size()));
    }

    // Whether the part of a side is a part of the fold, too.
    [[nodiscard]] bool is_folded(const Fold& fold, const Side& part) const {
        const Vec2 along = fold.at.b - fold.at.a;
        const Vec2 middle = 0.5 * (mesh_.points[at(part.from)] + mesh_.points[at(part.to)]);
        const double where = dot(along, middle - fold.at.a);
        return where > 0.0 && where < dot(along, along);
    }

    void append_parts(int side, std::vector<Side>& parts) const {
        for (int i = parts_[at(side)]; i < parts_[at(side) + 1]; ++i) {
            parts.push_back({from(i), to(i), i});
        }
    }

    // Makes twins of sides that run between the same points in opposite directions.
    void pair_up(std::vector<Side>& ones, const std::vector<Side>& others, char letter) {
        std::sort(ones.begin(), ones.end());
        for (const Side& other : others) {
            if (mesh_.twin[at(other.number)] >= 0) continue;
            const Side key{other.to, other.from, -1};
            for (auto i = std::lower_bound(ones.begin(), ones.end(), key);
                 i != ones.end() && i->from == other.to && i->to == other.from; ++i) {
                if (mesh_.twin[at(i->number)] >= 0) continue;
                mesh_.twin[at(i->number)] = other.number;
                mesh_.twin[at(other.number)] = i->number;
                mesh_.letter[at(i->number)] = mesh_.letter[at(other.number)] = letter;
                break;
            }
        }
    }

    void join_sides() {
        mesh_.twin.assign(mesh_.point.size(), -1);
        mesh_.letter.assign(mesh_.point.size(), 'B');
        for (const Fold& fold : folds_) {
            std::vector<Side> a;
            std::vector<Side> b;
            for (const int side : fold.a) append_parts(side, a);
            for (const int side : fold.b) append_parts(side, b);
            const auto beyond = [&](const Side& part) { return !is_folded(fold, part); };
            std::erase_if(a, beyond);
            std::erase_if(b, beyond);
            pair_up(a, b, fold.letter);
        }
        for (std::size_t plate = 0; plate < faces_of_.size(); ++plate) {
            if (faces_of_[plate] < 2) continue;
            std::vector<Side> all;
            for (int i = sides_of_[plate].first; i < sides_of_[plate].second; ++i) append_parts(i, all);
            const std::vector<Side> others = all;
            pair_up(all, others, 'J');
        }
    }

    // Corners are one vertex where edges with two faces lead from one to the other.
    void number_vertices_and_edges() {
        std::vector<int> same(mesh_.point.size());
        for (std::size_t i = 0; i < same.size(); ++i) same[i] = static_cast<int>(i);
        const auto root = [&same](int i) {
            while (same[at(i)] != i) {
                same[at(i)] = same[at(same[at(i)])];
                i = same[at(i)];
            }
            return i;
        };
        const auto unite = [&](int a, int b) {
            const auto [low, high] = std::minmax({root(a), root(b)});
            same[at(high)] = low;
        };
        std::vector<int> first_at(mesh_.points.size(), -1);
        for (std::size_t i = 0; i < same.size() && slits_ == FoldSlits::drawn; ++i) {
            int& first = first_at[at(mesh_.point[i])];
            if (first < 0) first = static_cast<int>(i);
            unite(first, static_cast<int>(i));
        }
        for (std::size_t i = 0; i < same.size(); ++i) {
            const int side = static_cast<int>(i);
            const int twin = mesh_.twin[i];
            if (twin < side) continue;
            unite(side, mesh_.next(twin));
            unite(mesh_.next(side), twin);
        }
        mesh_.vertex.resize(same.size());
        for (std::size_t i = 0; i < same.size(); ++i) {
            const int corner = static_cast<int>(i);
            // A class is known by its lowest corner, which therefore comes first.
            if (root(corner) == corner) {
                mesh_.vertex[i] = static_cast<int>(mesh_.vertex_corner.size());
                mesh_.vertex_corner.push_back(corner);
            } else {
                mesh_.vertex[i] = mesh_.vertex[at(root(corner))];
            }
            if (mesh_.twin[i] < 0 || mesh_.twin[i] > corner) mesh_.edge_side.push_back(corner);
        }
    }

    const Assembly& in_;
    FoldSlits slits_;
    std::vector<std::pair<int, int>> sides_of_;  // of each plate: its first side and the one after its last
    std::vector<int> faces_of_;
    std::vector<std::optional<EdgeIndex>> indices_;
    std::vector<Fold> folds_;
    std::vector<Split> splits_;
    std::vector<int> parts_;  // of each side before the splits: its first part after them
    FoldMesh mesh_;
};

}  // namespace

int FoldMesh::next(int corner) const {
    const std::size_t f = at(face[at(corner)]);
    return at(corner) + 1 < first[f + 1] ? corner + 1 : static_cast<int>(first[f]);
}

Vec2 FoldMesh::place(int corner) const { return points[at(point[at(corner)])]; }

int FoldMesh::plate(int corner) const { return face_plate[at(face[at(corner)])]; }

FoldMesh fold_mesh(const Assembly& assembly, FoldSlits slits) { return MeshBuilder(assembly, slits).build(); }

}  // namespace popup
