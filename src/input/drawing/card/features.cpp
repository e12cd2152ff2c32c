#include "input/drawing/card/features.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <utility>

#include "base/geometry/mend_ends.h"
#include "base/nth.h"
#include "input/drawing/card/boundary.h"

namespace popup::drawing::card {
namespace {

class FeatureFinder {
 public:
    FeatureFinder(const SheetGraph& graph, const CardPage& page) : graph_(graph), page_(page) {
        out_.plate_of.assign(static_cast<std::size_t>(graph.faces()), -1);
        folds_.resize(static_cast<std::size_t>(graph.faces()));
        group_faces();
    }

    Features run() {
        add_plate({page_.left});
        add_plate({page_.right});
        Drive gutter;
        gutter.left = 0;
        gutter.right = 1;
        gutter.at = page_.to_drawing({0.0, -0.5 * page_.height});
        gutter.dir = page_.up;
        gutter.hi = page_.height;
        gutter.element = page_.gutter_element;
        add_drive(gutter);
        std::size_t next = 0;
        do {
            for (; next < out_.drives.size(); ++next) stand_on(static_cast<int>(next));
        } while (find_outlined());
        return std::move(out_);
    }

 private:
    // --- faces and plates

    [[nodiscard]] int plate_of(int face) const { return nth(out_.plate_of, face); }

    int add_plate(const std::vector<int>& faces) {
        const int plate = static_cast<int>(plates_.size());
        plates_.push_back(faces);
        for (const int face : faces) nth(out_.plate_of, face) = plate;
        return plate;
    }

    void add_drive(const Drive& drive) {
        drives_of_[std::minmax(drive.left, drive.right)].push_back(static_cast<int>(out_.drives.size()));
        out_.drives.push_back(drive);
    }

    enum class Border { open, cut, cut_on_one_fold };

    // `cut`: all of the face's border is drawn as a cut. Folds that lie on it are those of a feature that was
    // drawn as an outline if they hold it on two sides or more; else `cut_on_one_fold`.
    [[nodiscard]] Border border_of(int face) const {
        std::vector<Segment> folds;
        Segment longest{};
        for (const int half : graph_.halves_of(face)) {
            if ((graph_.edge(half).ink & (kCut | kCutOut)) == 0) return Border::open;
            if (!is_fold(graph_.edge(half))) continue;
            const Segment s = folds.emplace_back(graph_.segment(half));
            if (distance(s.a, s.b) > distance(longest.a, longest.b)) longest = s;
        }
        const auto in_line = [&](const Segment& s) { return on_line(longest, s); };
        const bool one_fold = !folds.empty() && std::all_of(folds.begin(), folds.end(), in_line);
        return one_fold ? Border::cut_on_one_fold : Border::cut;
    }

    // A hole that ends at a fold: what lies beyond is not cut all around.
    [[nodiscard]] static bool is_hole(Border border, Border beyond) {
        return border == Border::cut_on_one_fold && beyond == Border::open;
    }

    // Which faces folds join, and the fold halves of each face.
    void group_faces() {
        std::vector<int>& group = out_.group_of;
        group.resize(static_cast<std::size_t>(graph_.faces()));
        std::iota(group.begin(), group.end(), 0);
        const auto root = [&](int face) {
            while (nth(group, face) != face) face = nth(group, face) = nth(group, nth(group, face));
            return face;
        };
        std::vector<Border> borders{Border::open};
        for (int face = 1; face < graph_.faces(); ++face) borders.push_back(border_of(face));
        std::set<int> holes;
        for (std::size_t i = 0; i < graph_.edges.size(); ++i) {
            const int half = static_cast<int>(2 * i);
            const int a = graph_.face_of(half);
            const int b = graph_.face_of(half ^ 1);
            // Whatever the border is drawn with, paper ends there.
            if (!is_fold(graph_.edges[i]) || a == b || a == 0 || b == 0) continue;
            const bool a_is_hole = is_hole(nth(borders, a), nth(borders, b));
            if (a_is_hole || is_hole(nth(borders, b), nth(borders, a))) {
                holes.insert(a_is_hole ? a : b);
                continue;
            }
            nth(folds_, a).push_back(half);
            nth(folds_, b).push_back(half ^ 1);
            nth(group, std::max(root(a), root(b))) = std::min(root(a), root(b));
        }
        for (int face = 0; face < graph_.faces(); ++face) nth(group, face) = root(face);
        for (const int hole : holes) tell_hole(hole);
    }

    void tell_hole(int face) {
        const std::vector<int>& border = graph_.halves_of(face);
        const auto named = [&](int half) { return (graph_.edge(half).ink & kCutOut) != 0; };
        if (std::any_of(border.begin(), border.end(), named)) return;
        // Where others are drawn on it as well, an edge has the element of the first of them.
        const auto own =
            std::find_if(border.begin(), border.end(), [&](int half) { return !graph_.edge(half).doubled; });
        const int half = own == border.end() ? border.front() : *own;
        out_.beside_folds.push_back({graph_.edge(half).element, {}, {}});
    }

    // Edges as straight folds, the longest first.
    [[nodiscard]] std::vector<FoldLine> lines_of(std::vector<int> edges) const {
        std::sort(edges.begin(), edges.end());
        edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
        const auto segment = [&](int edge) { return graph_.segment(2 * edge); };
        std::stable_sort(edges.begin(), edges.end(), [&](int a, int b) {
            return distance(segment(a).a, segment(a).b) > distance(segment(b).a, segment(b).b) + 1e-6;
        });
        std::vector<FoldLine> lines;
        for (const int edge : edges) {
            const Segment s = segment(edge);
            FoldLine* mine = nullptr;
            for (FoldLine& line : lines) {
                const Vec2 along = unit(line.line.b - line.line.a);
                if (std::max(std::abs(cross(along, s.a - line.line.a)),
                             std::abs(cross(along, s.b - line.line.a))) > kSnapMm)
                    continue;
                mine = &line;
                break;
            }
            if (mine == nullptr) {
                lines.push_back({s, {edge}});
                continue;
            }
            mine->edges.push_back(edge);
            const Vec2 along = unit(mine->line.b - mine->line.a);
            for (const Vec2 p : {s.a, s.b}) {
                if (dot(along, p - mine->line.a) < 0.0) mine->line.a = p;
                if (dot(along, p - mine->line.b) > 0.0) mine->line.b = p;
            }
        }
        return lines;
    }

    template <typename Wanted>
    [[nodiscard]] std::vector<FoldLine> folds_between(int face, Wanted wanted) const {
        std::vector<int> edges;
        for (const int half : nth(folds_, face)) {
            if (wanted(graph_.face_of(half ^ 1))) edges.push_back(half / 2);
        }
        return lines_of(std::move(edges));
    }
    [[nodiscard]] std::vector<FoldLine> folds_to_plate(int face, int plate) const {
        return folds_between(face, [&](int other) { return plate_of(other) == plate; });
    }
    [[nodiscard]] std::vector<FoldLine> folds_to_face(int face, int other) const {
        return folds_between(face, [&](int neighbour) { return neighbour == other; });
    }

    // --- features that hang on folds

    [[nodiscard]] std::size_t folds_of_plate(int plate) const {
        std::size_t count = 0;
        for (const int face : nth(plates_, plate)) count += nth(folds_, face).size();
        return count;
    }

    void stand_on(int number) {
        // Looked for from the plate with fewer folds.
        const Drive drive = nth(out_.drives, number);
        const bool from_left = folds_of_plate(drive.left) <= folds_of_plate(drive.right);
        const int start = from_left ? drive.left : drive.right;
        // In the order in which they are drawn.
        std::set<std::pair<int, int>> beside;
        for (const int face : nth(plates_, start)) {
            for (const int half : nth(folds_, face)) {
                const int next = graph_.face_of(half ^ 1);
                if (plate_of(next) < 0) beside.insert({first_element(graph_, graph_.halves_of(next)), next});
            }
        }
        for (const auto& [element, face] : beside) {
            if (plate_of(face) < 0) try_from(number, from_left, face);
        }
    }

    // Ways from a face over others to the plate on the other side: of one, two or three faces.
    void try_from(int number, bool from_left, int first) {
        std::vector<std::vector<int>> ways{{first}};
        for (std::size_t i = 0; i < ways.size(); ++i) {
            const std::vector<int> way = ways[i];
            if (try_way(number, from_left, way)) return;
            if (way.size() == 3 || ways.size() > kMostWays) continue;
            std::set<int> onwards;
            for (const int half : nth(folds_, way.back())) {
                const int next = graph_.face_of(half ^ 1);
                if (plate_of(next) >= 0 || std::find(way.begin(), way.end(), next) != way.end()) continue;
                onwards.insert(next);
            }
            for (const int next : onwards) {
                ways.push_back(way);
                ways.back().push_back(next);
            }
        }
    }

    bool try_way(int number, bool from_left, std::vector<int> way) {
        const Drive drive = nth(out_.drives, number);
        if (!from_left) std::reverse(way.begin(), way.end());
        const std::vector<FoldLine> lefts = folds_to_plate(way.front(), drive.left);
        const std::vector<FoldLine> rights = folds_to_plate(way.back(), drive.right);
        if (lefts.empty() || rights.empty()) return false;
        std::vector<FoldLine> mids;
        std::vector<Segment> mid_lines;
        for (std::size_t i = 0; i + 1 < way.size(); ++i) {
            std::vector<FoldLine> between = folds_to_face(way[i], way[i + 1]);
            mid_lines.push_back(between.front().line);
            mids.push_back(std::move(between.front()));
        }
        for (const FoldLine& left : lefts) {
            for (const FoldLine& right : rights) {
                const auto linkage = find_linkage(drive, left.line, mid_lines, right.line,
                                                  out_.why[from_left ? way.front() : way.back()]);
                if (!linkage) continue;
                DrawnFeature made;
                made.drive = number;
                made.linkage = *linkage;
                made.left = left;
                made.right = right;
                claim(std::move(made), way, mids);
                return true;
            }
        }
        return false;
    }

    void claim(DrawnFeature feature, const std::vector<int>& way, const std::vector<FoldLine>& mids) {
        std::vector<int> left_faces;
        std::vector<int> right_faces;
        bool over = false;
        bool has_centre = false;
        for (std::size_t i = 0; i < way.size(); ++i) {
            (over ? right_faces : left_faces).push_back(way[i]);
            if (i == mids.size()) break;
            if (feature.linkage.mids[i] == MidFold::centre) {
                over = has_centre = true;
                feature.centre = mids[i];
            } else {
                feature.run_on.insert(feature.run_on.end(), mids[i].edges.begin(), mids[i].edges.end());
            }
        }
        const Drive drive = nth(out_.drives, feature.drive);
        const int left = add_plate(left_faces);
        const int right = has_centre ? add_plate(right_faces) : left;
        grow(feature, left, right, has_centre);
        feature.faces = nth(plates_, left);
        if (has_centre) {
            const std::vector<int>& more = nth(plates_, right);
            feature.faces.insert(feature.faces.end(), more.begin(), more.end());
        }
        gather(feature, drive, left, right);
        add_drives(feature, drive, left, right, has_centre);
        out_.features.push_back(std::move(feature));
    }

    // Takes in parts that lie beside: over a further stretch of the centre fold, or of the drive's line.
    void grow(const DrawnFeature& feature, int left, int right, bool has_centre) {
        const Drive drive = nth(out_.drives, feature.drive);
        const Segment centre =
            has_centre ? feature.linkage.centre_line(drive, feature.centre.line) : Segment{};
        const auto on_centre = [&](const Segment& s) {
            if (!has_centre || distance(centre.a, centre.b) == 0.0) return false;
            const Vec2 along = unit(centre.b - centre.a);
            return std::max(std::abs(cross(along, s.a - centre.a)), std::abs(cross(along, s.b - centre.a))) <=
                   kSnapMm;
        };
        std::vector<int> todo = nth(plates_, left);
        if (has_centre) {
            const std::vector<int>& more = nth(plates_, right);
            todo.insert(todo.end(), more.begin(), more.end());
        }
        while (!todo.empty()) {
            const int face = todo.back();
            todo.pop_back();
            const int plate = plate_of(face);
            const std::vector<int> halves = nth(folds_, face);
            for (const int half : halves) {
                const int next = graph_.face_of(half ^ 1);
                if (plate_of(next) >= 0) continue;
                const Segment s = graph_.segment(half);
                int joins = -1;
                if (on_centre(s))
                    joins = plate == left ? right : left;
                else if (runs_along(drive, s) && hangs(next, drive, feature))
                    joins = plate;
                if (joins < 0) continue;
                nth(plates_, joins).push_back(next);
                nth(out_.plate_of, next) = joins;
                todo.push_back(next);
            }
        }
    }

    // Whether a face hangs on a side fold of the feature.
    [[nodiscard]] bool hangs(int face, const Drive& drive, const DrawnFeature& feature) const {
        for (const auto& [plate, line] :
             {std::pair{drive.left, &feature.left}, std::pair{drive.right, &feature.right}}) {
            for (const FoldLine& found : folds_to_plate(face, plate)) {
                const Vec2 along = unit(line->line.b - line->line.a);
                if (std::abs(cross(along, found.line.a - line->line.a)) <= kSnapMm &&
                    std::abs(cross(along, found.line.b - line->line.a)) <= kSnapMm)
                    return true;
            }
        }
        return false;
    }

    // All stretches of its folds, and what was drawn on through it.
    void gather(DrawnFeature& feature, const Drive& drive, int left, int right) {
        std::vector<int> on_left;
        std::vector<int> on_right;
        std::vector<int> in_centre;
        for (const int face : feature.faces) {
            for (const int half : nth(folds_, face)) {
                const int other = plate_of(graph_.face_of(half ^ 1));
                const int own = plate_of(face);
                const Segment s = graph_.segment(half);
                if (other == drive.left && own == left && on_line(feature.left.line, s))
                    on_left.push_back(half / 2);
                else if (other == drive.right && own == right && on_line(feature.right.line, s))
                    on_right.push_back(half / 2);
                else if (left != right && own != other && (other == left || other == right))
                    in_centre.push_back(half / 2);
                else if (own == other && runs_along(drive, s))
                    feature.run_on.push_back(half / 2);
            }
        }
        const auto take = [&](FoldLine& line, const std::vector<int>& edges) {
            auto lines = lines_of(edges);
            if (!lines.empty()) line = std::move(lines.front());
        };
        take(feature.left, on_left);
        take(feature.right, on_right);
        take(feature.centre, in_centre);
        std::sort(feature.run_on.begin(), feature.run_on.end());
        feature.run_on.erase(std::unique(feature.run_on.begin(), feature.run_on.end()), feature.run_on.end());
    }

    static bool on_line(const Segment& line, const Segment& s) {
        const Vec2 along = unit(line.b - line.a);
        return std::max(std::abs(cross(along, s.a - line.a)), std::abs(cross(along, s.b - line.a))) <=
               kSnapMm;
    }

    void add_drives(const DrawnFeature& feature, const Drive& drive, int left, int right, bool has_centre) {
        const auto add = [&](const Segment& line, int on_left, int on_right, bool mountain,
                             const FoldLine& drawn) {
            Drive made;
            made.left = on_left;
            made.right = on_right;
            made.at = line.a;
            made.hi = distance(line.a, line.b);
            if (made.hi < kSnapMm) return;
            made.dir = unit(line.b - line.a);
            made.mountain = mountain;
            if (!drawn.edges.empty()) made.element = nth(graph_.edges, drawn.edges.front()).element;
            add_drive(made);
        };
        const Linkage& linkage = feature.linkage;
        if (feature.has_left)
            add(linkage.left_line(drive, feature.left.line), drive.left, left, drive.mountain, feature.left);
        if (has_centre)
            add(linkage.centre_line(drive, feature.centre.line), left, right, !drive.mountain,
                feature.centre);
        if (feature.has_right)
            add(linkage.right_line(drive, feature.right.line), right, drive.right, drive.mountain,
                feature.right);
    }

    // --- features that are cut all around

    // A drive that the ring crosses twice, between its two plates.
    [[nodiscard]] std::vector<int> crossed_drives(const std::vector<int>& ring) const {
        const std::set<int> around = plates_around(graph_, out_, ring);
        std::vector<int> found;
        for (const int left : around) {
            for (const int right : around) {
                if (left < 0 || right <= left) continue;
                const auto drives = drives_of_.find({left, right});
                if (drives == drives_of_.end()) continue;
                for (const int drive : drives->second) {
                    if (crosses(nth(out_.drives, drive), ring)) found.push_back(drive);
                }
            }
        }
        return found;
    }

    [[nodiscard]] bool crosses(const Drive& drive, const std::vector<int>& ring) const {
        bool left = false;
        bool right = false;
        for (const int half : ring) {
            const Vec2 a = drive.there(graph_.segment(half).a);
            const Vec2 b = drive.there(graph_.segment(half).b);
            left = left || a.y > kSnapMm;
            right = right || a.y < -kSnapMm;
            if ((a.y > 0.0) == (b.y > 0.0)) continue;
            const double s = a.x + (b.x - a.x) * a.y / (a.y - b.y);
            if (s < drive.lo - kSnapMm || s > drive.hi + kSnapMm) return false;
        }
        return left && right;
    }

    // True when there was one: its folds may have others standing on them.
    bool find_outlined() {
        bool any = false;
        for (const auto& [group, faces] : loose_groups(graph_, out_)) {
            if (out_.refused.count(group) > 0) continue;
            const std::vector<int> ring = outer_boundary(graph_, faces);
            const bool named_hole = std::any_of(
                ring.begin(), ring.end(), [&](int half) { return (graph_.edge(half).ink & kCutOut) != 0; });
            if (ring.empty() || named_hole) continue;
            const std::vector<int> drives = crossed_drives(ring);
            if (drives.empty()) continue;
            // Without any fold in it, it is cut out of the fold.
            if (std::all_of(faces.begin(), faces.end(),
                            [&](int face) { return nth(folds_, face).empty(); })) {
                if (out_.holes_over_folds.insert(group).second)
                    out_.over_folds.push_back({first_element(graph_, ring), {}, {}});
                continue;
            }
            if (drives.size() > 1) {
                refuse(group, ring,
                       fmt::format("this outline lies across {} folds, and can stand on one only",
                                   drives.size()));
                continue;
            }
            any = take_outlined(group, faces, ring, drives.front()) || any;
        }
        return any;
    }

    void refuse(int group, const std::vector<int>& ring, std::string what) {
        out_.refused.insert(group);
        out_.faults.push_back(
            {first_element(graph_, ring), std::move(what), graph_.at(graph_.from(ring.front()))});
    }

    bool take_outlined(int group, const std::vector<int>& faces, const std::vector<int>& ring, int number) {
        const Drive drive = nth(out_.drives, number);
        DrawnFeature made;
        made.drive = number;
        made.outlined = true;
        made.faces = faces;
        made.has_left = made.has_right = false;
        std::vector<int> inner;
        for (const int face : faces) {
            for (const int half : nth(folds_, face)) {
                if (runs_along(drive, graph_.segment(half)))
                    made.run_on.push_back(half / 2);
                else
                    inner.push_back(half / 2);
            }
        }
        std::sort(made.run_on.begin(), made.run_on.end());
        made.run_on.erase(std::unique(made.run_on.begin(), made.run_on.end()), made.run_on.end());
        // The outermost fold on either side holds it, unless it is drawn as the centre fold must be.
        const unsigned centre_ink = drive.mountain ? kValley : kMountain;
        for (FoldLine& line : lines_of(inner)) {
            const Vec2 a = drive.there(line.line.a);
            const Vec2 b = drive.there(line.line.b);
            const double level = 0.5 * (a.y + b.y);
            unsigned ink = 0;
            for (const int edge : line.edges) ink |= nth(graph_.edges, edge).ink & kAnyFold;
            if (std::abs(a.y - b.y) > 2.0 * kSnapMm) {
                refuse(group, ring, "its folds are not parallel to the fold that it lies across");
                return false;
            }
            if (ink == centre_ink) {
                made.centre = std::move(line);
                continue;
            }
            const bool left = level > 0.0;
            bool& has = left ? made.has_left : made.has_right;
            double& known = left ? made.linkage.left : made.linkage.right;
            FoldLine& mine = left ? made.left : made.right;
            if (has && known >= std::abs(level)) {
                made.centre = std::move(line);
                continue;
            }
            if (has) made.centre = std::move(mine);
            has = true;
            known = std::abs(level);
            mine = std::move(line);
        }
        // In the drive's own line there is a centre fold, too.
        if (made.centre.edges.empty() && made.has_left && made.has_right &&
            std::abs(made.linkage.left - made.linkage.right) <= kSnapMm && !made.run_on.empty()) {
            made.centre = lines_of(std::exchange(made.run_on, {})).front();
        }
        claim_outlined(std::move(made), drive);
        return true;
    }

    void claim_outlined(DrawnFeature made, const Drive& drive) {
        const bool known = made.has_left && made.has_right;
        const double centre = made.linkage.left - made.linkage.right;
        std::vector<int> left_faces;
        std::vector<int> right_faces;
        for (const int face : made.faces) {
            const double level = drive.there(inside_of(face)).y;
            if (made.has_left && level > made.linkage.left)
                nth(out_.plate_of, face) = drive.left;
            else if (made.has_right && level < -made.linkage.right)
                nth(out_.plate_of, face) = drive.right;
            else
                (level > centre ? left_faces : right_faces).push_back(face);
        }
        const int left = add_plate(left_faces);
        const int right = known && !made.centre.edges.empty() ? add_plate(right_faces) : left;
        for (const int face : right_faces) nth(out_.plate_of, face) = right;
        if (right == left) {
            nth(plates_, left).insert(nth(plates_, left).end(), right_faces.begin(), right_faces.end());
        }
        add_drives(made, drive, left, right, right != left);
        out_.features.push_back(std::move(made));
    }

    // A point of a face, just inside of its longest edge.
    [[nodiscard]] Vec2 inside_of(int face) const {
        Segment longest{};
        for (const int half : graph_.halves_of(face)) {
            const Segment s = graph_.segment(half);
            if (graph_.face_of(half ^ 1) == face) continue;
            if (distance(s.a, s.b) > distance(longest.a, longest.b)) longest = s;
        }
        if (longest == Segment{}) return {};
        return lerp(longest.a, longest.b, 0.5) + kOnePointMm * left_of(unit(longest.b - longest.a));
    }

    static constexpr std::size_t kMostWays = 200;

    const SheetGraph& graph_;
    const CardPage& page_;
    std::vector<std::vector<int>> folds_;  // halves of folds on each face
    std::vector<std::vector<int>> plates_;
    std::map<std::pair<int, int>, std::vector<int>> drives_of_;
    Features out_;
};

}  // namespace

std::map<int, std::vector<int>> loose_groups(const SheetGraph& graph, const Features& features) {
    std::set<int> held;
    for (int face = 1; face < graph.faces(); ++face) {
        if (nth(features.plate_of, face) >= 0) held.insert(nth(features.group_of, face));
    }
    std::map<int, std::vector<int>> loose;
    for (int face = 1; face < graph.faces(); ++face) {
        const int group = nth(features.group_of, face);
        if (nth(features.plate_of, face) < 0 && held.count(group) == 0) loose[group].push_back(face);
    }
    return loose;
}

std::set<int> plates_around(const SheetGraph& graph, const Features& features, const std::vector<int>& ring) {
    std::set<int> around;
    for (const int half : ring) around.insert(nth(features.plate_of, graph.face_of(half ^ 1)));
    return around;
}

int first_element(const SheetGraph& graph, const std::vector<int>& halves) {
    int first = graph.edge(halves.front()).element;
    for (const int half : halves) first = std::min(first, graph.edge(half).element);
    return first;
}

Features find_features(const SheetGraph& graph, const CardPage& page) {
    return FeatureFinder(graph, page).run();
}

}  // namespace popup::drawing::card
